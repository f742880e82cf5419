"""Runs a piece of work in a forked child that the Linux kernel confines, and returns its bytes.

The child can read below the folders it is given, and compute. It can write no file, start no
program, reach no network and signal nobody, and it has a bounded share of time and memory. Two
walls stand one behind the other: Landlock, which knows paths, and a seccomp filter that lets
through none but the system calls in a table. What comes out is bytes whose length is checked, and
nothing in it is believed.

Setting up fails closed: the work is run in a whole jail or not at all.
"""

from __future__ import annotations

import sys

from .protocol import (
    KEPT_VARIABLES,
    JailAbandoned,
    JailAnswerBroken,
    JailAnswerTooLong,
    JailCpuTimeOver,
    JailCrashed,
    JailError,
    JailLimits,
    JailOutOfMemory,
    JailTimeOver,
    JailTooManyThreads,
    JailUnavailable,
    JailWorkFailed,
    pack,
    python_folders,
    unpack,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

__all__ = [
    "KEPT_VARIABLES",
    "JailAbandoned",
    "JailAnswerBroken",
    "JailAnswerTooLong",
    "JailCpuTimeOver",
    "JailCrashed",
    "JailError",
    "JailLimits",
    "JailOutOfMemory",
    "JailTimeOver",
    "JailTooManyThreads",
    "JailUnavailable",
    "JailWorkFailed",
    "check_available",
    "pack",
    "python_folders",
    "run_jailed",
    "unpack",
]


def run_jailed(
    work: Callable[[], bytes],
    *,
    readable: Sequence[str],
    limits: JailLimits,
    environment: Sequence[str] = KEPT_VARIABLES,
) -> bytes:
    """Return what `work` returns, having run it in a jail.

    The work sees the process as it is at the call, in a copy: what it changes is lost. Its
    standard streams are /dev/null, since a terminal obeys every program that writes to it.

    Args:
        work: what to run. Its answer is untrusted, however harmless the work looks.
        readable: files and folders it may read, besides Python's own; one that does not exist is
            passed over.
        limits: what it may use.
        environment: names of the environment variables it may see.

    Raises:
        JailUnavailable: there can be no jail; nothing was run.
        JailError: one of the other kinds, if there is no answer.
    """
    reason = check_available()
    if reason is not None:
        raise JailUnavailable(reason)
    from .parent import run

    folders = [*python_folders(), *readable]
    return run(work, readable=folders, limits=limits, environment=environment)


def check_available() -> str | None:
    """Return why this machine can have no jail, or None.

    It asks and changes nothing, so that a refusal can still come up when a jail is set up.
    """
    if not sys.platform.startswith("linux"):
        return "the jail needs Linux"
    from .parent import why_unavailable  # other systems do not have what it imports

    return why_unavailable()
