"""The process in which variants are built, and what passes between it and the one that drives it.

It gets a plan and then requests, and sends each row as soon as it is there: so what is lost when it
crashes is one variant. It ends with the process that drives it, in whatever way that ends.
"""

from __future__ import annotations

import os
import pickle
import struct
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, BinaryIO

READY, ROW, DONE, BROKEN = "ready", "row", "done", "broken"
"""What messages are about."""
IDLE_SECONDS = 300.0
"""Seconds after which a process ends for which nobody has work, as when a cluster goes on."""
_LENGTH = struct.Struct("<Q")


def send(stream: BinaryIO, message: Any) -> None:
    """Write a message; raise OSError if nobody reads it any more."""
    data = pickle.dumps(message, protocol=pickle.HIGHEST_PROTOCOL)
    stream.write(_LENGTH.pack(len(data)) + data)
    stream.flush()


def receive(stream: BinaryIO) -> Any:
    """Return the next message; raise EOFError if there is none."""
    head = stream.read(_LENGTH.size)
    if len(head) < _LENGTH.size:
        raise EOFError
    (length,) = _LENGTH.unpack(head)
    data = stream.read(length)
    if len(data) < length:
        raise EOFError
    return pickle.loads(data)


def main() -> None:
    """Serve the process that started this one, until it closes the pipe."""
    requests = os.fdopen(os.dup(0), "rb")
    answers = os.fdopen(os.dup(1), "wb")
    null = os.open(os.devnull, os.O_RDWR)
    for descriptor in (0, 1, 2):  # nothing that a robot or a library prints gets into the messages
        os.dup2(null, descriptor)
    try:
        plan, folder = receive(requests)
        _end_with_driver()
        try:
            builder = _builder(plan, folder)
        except Exception as error:
            send(answers, (BROKEN, _reason(error)))
            return
        send(answers, (READY, None))
        while _is_wanted(requests):
            start, stop = receive(requests)
            for row in builder.rows(start, stop):
                send(answers, (ROW, row))
            send(answers, (DONE, builder.files))
    except (EOFError, OSError):
        return


def _is_wanted(requests: BinaryIO) -> bool:
    """Wait for a request; return False if none has come for long."""
    if os.name != "posix":
        return True
    import select

    return bool(select.select([requests], [], [], IDLE_SECONDS)[0])


def _builder(plan: Any, folder: str) -> Any:
    import threading  # noqa: F401 - lets `deep_stack` keep its thread for the next conversion
    import warnings

    from ...sandbox.process import bound_memory
    from .builder import Builder
    from .plan import versions_for

    warnings.simplefilter("ignore")
    found = versions_for(plan)
    if found != plan.versions:
        raise _other_versions(plan.versions, found)
    if plan.memory:
        bound_memory(plan.memory)
    builder = Builder(plan, folder)
    _freeze()
    return builder


def _freeze() -> None:
    """Keep the garbage collector from looking again and again through what stays."""
    import gc

    gc.collect()
    gc.freeze()


def _other_versions(wanted: dict[str, str], found: dict[str, str]) -> Exception:
    from ...diagnostics import failure_of_all

    differences = [
        f"{name} {found.get(name) or 'none'} instead of {wanted.get(name) or 'none'}"
        for name in {**wanted, **found}
        if wanted.get(name) != found.get(name)
    ]
    message = f"the worker on {_host()} has {', '.join(differences)}"
    hint = "all workers need the versions with which the sweep began"
    return failure_of_all("sweep-engine", message, "sweep", hint)


def _host() -> str:
    import platform

    return platform.node()


def _reason(error: Exception) -> Any:
    """Return what is wrong as something that can be sent: diagnostics, or a text."""
    from ...diagnostics import YamaroError

    if isinstance(error, YamaroError):
        for diagnostic in error.diagnostics:
            diagnostic.trace = None
        return error.diagnostics
    return f"{type(error).__name__}: {error}"


def _end_with_driver() -> None:
    """Let this process end as soon as the one that drives it has ended.

    The kernel signals the end of the pipe from which requests come, also amid a long call of
    a function written in C. Where it cannot, the end is noticed with the next row.
    """
    try:
        import fcntl
        import signal

        life = int(os.environ.pop("YAMARO_SWEEP_LIFE", "-1"))
        if life < 0 or not hasattr(fcntl, "F_SETOWN"):
            return
        signal.signal(signal.SIGIO, signal.SIG_DFL)  # which ends the process
        fcntl.fcntl(life, fcntl.F_SETOWN, os.getpid())
        fcntl.fcntl(life, fcntl.F_SETFL, fcntl.fcntl(life, fcntl.F_GETFL) | os.O_ASYNC)
        import select

        if select.select([life], [], [], 0)[0]:  # it ended before
            sys.exit(0)
    except (ImportError, AttributeError, OSError, ValueError):
        return
