"""The agreement of the parent and child of a jail: limits, errors, surroundings, and messages.

Until it has said READY none but our own code runs in the child; what comes later may be lies.
"""

from __future__ import annotations

import os
import struct
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

# --- limits and errors ------------------------------------------------------------------------


class JailLimits:
    """Limits on the work; beyond them it is ended."""

    __slots__ = (
        "answer", "cpu_seconds", "is_abandoned", "memory", "open_files", "seconds", "threads",
    )  # fmt: skip

    def __init__(
        self,
        *,
        seconds: float = 60.0,
        cpu_seconds: int = 60,
        memory: int = 3 << 30,
        open_files: int = 256,
        threads: int = 256,
        answer: int = 256 << 20,
        is_abandoned: Callable[[], bool] | None = None,
    ) -> None:
        """Set the limits.

        Args:
            seconds: of the wall clock, from the call to the last byte of the answer.
            cpu_seconds: of all processors together, in whole seconds.
            memory: bytes of address space on top of what the process has when it is forked. A
                thread's stack counts in full, so the deep stack takes 512 MB of it.
            open_files: open at once.
            threads: at once.
            answer: bytes of the answer.
            is_abandoned: returns whether nobody wants the answer any more; asked while waiting.
        """
        self.seconds = seconds
        self.cpu_seconds = cpu_seconds
        self.memory = memory
        self.open_files = open_files
        self.threads = threads
        self.answer = answer
        self.is_abandoned = is_abandoned


class JailError(Exception):
    """There is no answer; `limit` names the field of JailLimits that ended the work, if one did."""

    limit = ""


class JailUnavailable(JailError):
    """There can be no jail here, so nothing was run."""


class JailTimeOver(JailError):
    """The wall clock ran out."""

    limit = "seconds"


class JailCpuTimeOver(JailError):
    """The work computed for too long."""

    limit = "cpu_seconds"


class JailOutOfMemory(JailError):
    """The work asked for more memory than it may have."""

    limit = "memory"


class JailTooManyThreads(JailError):
    """The work started too many threads."""

    limit = "threads"


class JailAnswerTooLong(JailError):
    """The answer is longer than an answer may be."""

    limit = "answer"


class JailAbandoned(Exception):
    """Nobody wants the answer any more; so this is not an error that anyone should report."""


class JailAnswerBroken(JailError):
    """The answer was cut short, or is not an answer."""


class JailCrashed(JailError):
    """The child died of a signal that no limit explains."""


class JailWorkFailed(JailError):
    """The work raised an exception, or says so: all that is said about it may be a lie.

    Attributes:
        kind: the name of its class.
        text: its text.
        place: where it was raised, as `file.py:line`, or empty.
        is_fault: whether it was an ordinary exception, and none that ends a program.
    """

    def __init__(self, kind: str, text: str, place: str, *, is_fault: bool) -> None:
        """Hold what the child says of an exception."""
        reason = f"{kind}: {text}" if text else kind
        super().__init__(f"{reason} at {place}" if place else reason)
        self.kind = kind
        self.text = text
        self.place = place
        self.is_fault = is_fault


# --- surroundings -----------------------------------------------------------------------------


KEPT_VARIABLES = (
    "LANG LC_ALL LC_COLLATE LC_CTYPE LC_MESSAGES LC_NUMERIC LC_TIME TZ "
    "ROS_DISTRO ROS_VERSION ROS_PYTHON_VERSION ROS_PACKAGE_PATH "
    "AMENT_PREFIX_PATH COLCON_PREFIX_PATH CMAKE_PREFIX_PATH"
).split()
"""The environment variables a jail keeps: language, time zone, and where ROS packages are.

All others are hidden, since an environment holds passwords, and what a robot reads it can print.
"""

_SYSTEM_FOLDERS = (
    "/lib",
    "/lib64",
    "/usr/lib",
    "/usr/lib64",
    "/usr/local/lib",
    "/etc/ld.so.cache",
    "/usr/share/zoneinfo",
)
_PACKAGE_FOLDERS = ("site-packages", "dist-packages")


def python_folders() -> list[str]:
    """Return what importing modules reads: Python's folders, and the system's shared libraries.

    Of Python's path only what lies in Python's installation or is a folder of packages by its
    name. The rest came there by where the program was started, and may hold anything.
    """
    prefixes = {sys.prefix, sys.exec_prefix, sys.base_prefix, sys.base_exec_prefix}
    paths = [entry for entry in sys.path if _holds_packages(entry, prefixes)]
    paths += [os.path.join(prefix, "lib") for prefix in sorted(prefixes)]
    own = os.path.abspath(__file__)
    paths.append(os.path.dirname(os.path.dirname(os.path.dirname(own))))
    found: list[str] = []
    for path in sorted([*paths, *_SYSTEM_FOLDERS]):  # a folder comes before what is in it
        if not any(covers(folder, path) for folder in found):
            found.append(path)
    return found


def _holds_packages(path: str, prefixes: set[str]) -> bool:
    if not os.path.isabs(path):
        return False
    is_inside = any(path != prefix and covers(prefix, path) for prefix in prefixes)
    return is_inside or os.path.basename(os.path.normpath(path)) in _PACKAGE_FOLDERS


def covers(folder: str, path: str) -> bool:
    """Return whether `path` is `folder` or lies below it; both are absolute."""
    return path == folder or path.startswith(folder.rstrip("/") + "/")


# --- a list of byte strings as one, whose lengths are checked when it is taken apart ----------


_LENGTH = struct.Struct("<Q")


def pack(parts: Sequence[bytes]) -> bytes:
    """Return byte strings as one, each behind its length."""
    pieces = []
    for part in parts:
        pieces.append(_LENGTH.pack(len(part)))
        pieces.append(part)
    return b"".join(pieces)


def unpack(data: bytes) -> list[bytes]:
    """Return the byte strings that `pack` made one of; `data` may come from an enemy.

    Raises:
        JailAnswerBroken: it was not made by `pack`.
    """
    parts = []
    position = 0
    while position < len(data):
        start = position + _LENGTH.size
        if start > len(data):
            raise JailAnswerBroken("the answer ends within a length")
        (length,) = _LENGTH.unpack_from(data, position)
        if length > len(data) - start:
            raise JailAnswerBroken("a part of the answer is longer than the answer")
        position = start + length
        parts.append(data[start:position])
    return parts


# --- what a child says: a kind, the length of what follows, and that --------------------------


HEADER = struct.Struct("<cQ")
READY = b"R"
NO_JAIL = b"S"
ANSWER = b"A"
MEMORY = b"M"
FAILED = b"E"
OUT_OF_MEMORY = HEADER.pack(MEMORY, 0)
"""Made beforehand: when it is needed there is no memory to make it."""
LONGEST_REASON = 10_000
"""Bytes of each text that says why there is no answer."""
