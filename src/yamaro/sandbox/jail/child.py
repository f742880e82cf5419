"""The child's side of a jail: it confines itself, works, and sends the result."""

from __future__ import annotations

import ctypes
import errno
import gc
import os
import posix
import resource
import signal
import struct
import sys

from . import landlock, seccomp
from .calls import Architecture, call, check, here, libc
from .protocol import (
    ANSWER,
    FAILED,
    HEADER,
    LONGEST_REASON,
    NO_JAIL,
    OUT_OF_MEMORY,
    READY,
    pack,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import NoReturn

    from .protocol import JailLimits

_PR_SET_PDEATHSIG = 1
_PR_SET_NO_NEW_PRIVS = 38
_CAPABILITY_VERSION = 0x20080522
_CAP_DAC_READ_SEARCH = 1 << 2
_CLOSE_RANGE = 436
_LAST_DESCRIPTOR = 0xFFFFFFFF
_LAST_SIGNAL = 64
_DEFAULT, _IGNORE = 0, 1  # SIG_DFL, SIG_IGN


class Cell:
    """The values by which the child confines itself."""

    __slots__ = ("environment", "limits", "parent", "program", "ruleset", "writer")

    def __init__(
        self,
        *,
        writer: int,
        parent: int,
        ruleset: int,
        program: bytes,
        limits: JailLimits,
        environment: Sequence[str],
    ) -> None:
        """Gather it.

        Args:
            writer: the descriptor of the pipe to the parent.
            parent: the number of the parent process.
            ruleset: the descriptor of what Landlock is to allow.
            program: the seccomp filter.
            limits: what the work may use.
            environment: the names of the variables it may see.
        """
        self.writer = writer
        self.parent = parent
        self.ruleset = ruleset
        self.program = program
        self.limits = limits
        self.environment = environment


# Coverage of what follows cannot be measured: what measures is not allowed to write it down.


def live_in_jail(cell: Cell, work: Callable[[], bytes]) -> NoReturn:  # pragma: no cover
    """Be the child: nothing of the parent's code runs after this, not even its `finally`."""
    try:
        if _is_confined(cell):
            try:
                answer = work()
                if not isinstance(answer, bytes):
                    raise TypeError("the work gives no bytes")
                _send(cell.writer, ANSWER, answer)
            except MemoryError:
                os.write(cell.writer, OUT_OF_MEMORY)
            except BaseException as error:
                _send(cell.writer, FAILED, pack([_bytes(text) for text in _describe(error)]))
    finally:
        os._exit(0)


def _is_confined(cell: Cell) -> bool:  # pragma: no cover
    try:
        _leave_parent(cell.parent)
        # Confine this process for good.
        architecture = here()
        _replace_standard_streams()
        _clear_environment(cell.environment)
        _drop_capabilities(architecture)
        _set_limits(cell.limits)
        check(call(architecture.prctl, _PR_SET_NO_NEW_PRIVS, 1), "PR_SET_NO_NEW_PRIVS")
        landlock.restrict(cell.ruleset)
        _close_all_but(cell.writer)
        seccomp.install(architecture, cell.program)
        _prove_confined(architecture)
        _send(cell.writer, READY)
    except BaseException as error:
        text = f"the jail could not be set up: {error}"
        _send(cell.writer, NO_JAIL, _bytes(text))
        return False
    return True


def _describe(error: BaseException) -> tuple[str, str, str, str]:
    """Return an exception's kind, text and place, and a text that is not empty if it is a fault."""
    traceback = error.__traceback__
    while traceback is not None and traceback.tb_next is not None:
        traceback = traceback.tb_next
    place = ""
    if traceback is not None:
        code = traceback.tb_frame.f_code
        place = f"{os.path.basename(code.co_filename)}:{traceback.tb_lineno}"
    try:
        text = f"{error}"
    except Exception:  # its own code fails
        text = ""
    return type(error).__name__, text, place, "fault" if isinstance(error, Exception) else ""


def _bytes(text: str) -> bytes:
    return text.encode("utf-8", "backslashreplace")[:LONGEST_REASON]


def _send(writer: int, kind: bytes, data: bytes = b"") -> None:  # pragma: no cover
    for piece in (HEADER.pack(kind, len(data)), data):
        view = memoryview(piece)
        while view:
            view = view[os.write(writer, view) :]


def _leave_parent(parent: int) -> None:  # pragma: no cover
    """Cut what ties the child to its parent, except for descriptors.

    It ends with the parent. Ctrl-C reaches the whole group of processes, and the parent decides
    what follows from it; all other signals have their usual effect.
    """
    check(call(here().prctl, _PR_SET_PDEATHSIG, signal.SIGKILL), "PR_SET_PDEATHSIG")
    if os.getppid() != parent:
        os._exit(0)
    sys.settrace(None)
    sys.setprofile(None)
    gc.freeze()  # the collector would touch, and so copy, all that there is
    for number in range(1, _LAST_SIGNAL + 1):  # Python does not know of all handlers
        libc.signal(number, _IGNORE if number == signal.SIGINT else _DEFAULT)
    signal.pthread_sigmask(signal.SIG_SETMASK, [])


def _replace_standard_streams() -> None:  # pragma: no cover
    """Make all three /dev/null; Python's objects may be a test runner's or a notebook's."""
    null = os.open("/dev/null", os.O_RDWR)
    for standard in (0, 1, 2):
        os.dup2(null, standard)
    sys.stdin = open(0, encoding="utf-8", closefd=False)  # noqa: SIM115
    sys.stdout = open(1, "w", encoding="utf-8", errors="replace", closefd=False)  # noqa: SIM115
    sys.stderr = open(2, "w", encoding="utf-8", errors="replace", closefd=False)  # noqa: SIM115


def _close_all_but(writer: int) -> None:  # pragma: no cover
    if writer > 3:
        check(call(_CLOSE_RANGE, 3, writer - 1), "close_range")
    check(call(_CLOSE_RANGE, writer + 1, _LAST_DESCRIPTOR), "close_range")


def _clear_environment(kept_names: Sequence[str]) -> None:  # pragma: no cover
    """Forget all variables but a few, and overwrite their text where the C library has it.

    Numeric libraries are set to start no threads, which would be as many as processors.
    """
    kept = {name: os.environ[name] for name in kept_names if name in os.environ}
    strings = ctypes.POINTER(ctypes.c_void_p).in_dll(libc, "environ")
    index = 0
    while strings and (address := strings[index]):
        ctypes.memset(address, 0, len(ctypes.string_at(address)))
        index += 1
    libc.clearenv()
    posix.environ.clear()  # what `os` made its mapping of
    for name in list(os.environ):  # Python's copy; faster than `clear`, which reads each first
        del os.environ[name]
    os.environ.update(kept)
    for library in ("OPENBLAS", "OMP", "MKL"):
        os.environ[f"{library}_NUM_THREADS"] = "1"


def _drop_capabilities(architecture: Architecture) -> None:  # pragma: no cover
    """Give up what root may, except reading: so that root reads in a jail what it reads outside.

    The table of system calls leaves root nothing to do with the others; this is the second wall.
    """
    header = ctypes.create_string_buffer(struct.pack("Ii", _CAPABILITY_VERSION, 0), 8)
    sets = ctypes.create_string_buffer(24)
    check(call(architecture.capget, ctypes.addressof(header), ctypes.addressof(sets)), "capget")
    _, permitted, *_ = struct.unpack("6I", sets.raw)
    kept = permitted & _CAP_DAC_READ_SEARCH
    sets = ctypes.create_string_buffer(struct.pack("6I", kept, kept, 0, 0, 0, 0), 24)
    check(call(architecture.capset, ctypes.addressof(header), ctypes.addressof(sets)), "capset")


def _set_limits(limits: JailLimits) -> None:  # pragma: no cover
    with open("/proc/self/statm", "rb") as file:
        taken = int(file.read().split()[0]) * resource.getpagesize()
    _lower(resource.RLIMIT_CORE, 0)
    _lower(resource.RLIMIT_FSIZE, 0)
    _lower(resource.RLIMIT_MEMLOCK, 0)
    _lower(resource.RLIMIT_NOFILE, limits.open_files)
    _lower(resource.RLIMIT_CPU, limits.cpu_seconds, limits.cpu_seconds + 1)
    _lower(resource.RLIMIT_AS, taken + limits.memory)


def _lower(which: int, soft: int, hard: int | None = None) -> None:  # pragma: no cover
    """Set a limit of the kernel's, unless the process has a lower one already."""
    before = resource.getrlimit(which)
    wanted = (soft, soft if hard is None else hard)
    now = [
        new if old == resource.RLIM_INFINITY else min(old, new)
        for old, new in zip(before, wanted, strict=True)
    ]
    resource.setrlimit(which, (now[0], now[1]))


def _prove_confined(architecture: Architecture) -> None:  # pragma: no cover
    """Raise an error if a wall does not stand, whatever the kernel said when it was built."""
    try:
        os.close(os.open("/", os.O_RDONLY | os.O_DIRECTORY))
    except PermissionError:
        pass
    else:
        raise OSError("Landlock has no effect")
    unix, stream = 1, 1
    if call(architecture.socket, unix, stream) >= 0 or ctypes.get_errno() != errno.EPERM:
        raise OSError("the seccomp filter has no effect")
