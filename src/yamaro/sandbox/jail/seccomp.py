"""seccomp: the filter by which the kernel judges each system call of a jailed process."""

from __future__ import annotations

import ctypes
import errno
import struct

from .calls import Architecture, call, check

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

_SET_MODE_FILTER = 1
_GET_ACTION_AVAIL = 2
_PR_SET_NAME, _PR_GET_NAME = 15, 16

_LOW, _HIGH = 0, 4  # the two halves of an argument; both architectures are little-endian
_ALL_BITS = 0xFFFFFFFF
# write only, read and write, create, truncate, append, O_TMPFILE; and O_PATH, which opens what
# may not be read
_OPEN_FOR_MORE = 0o1 | 0o2 | 0o100 | 0o1000 | 0o2000 | 0o20000000 | 0o10000000
_CLONE_THREAD = 0x00010000
# what the C libraries ask for a thread: VM, FS, FILES, SIGHAND, THREAD, SYSVSEM, SETTLS,
# PARENT_SETTID, CHILD_CLEARTID, DETACHED, CHILD_SETTID
_CLONE_FLAGS = 0x100 | 0x200 | 0x400 | 0x800 | _CLONE_THREAD | 0x40000 | 0x80000
_CLONE_FLAGS |= 0x100000 | 0x200000 | 0x400000 | 0x1000000
_TERMINAL_QUESTIONS = (0x5401, 0x802C542A, 0x5413)  # TCGETS, TCGETS2, TIOCGWINSZ: is it one?
_CLOSE_ON_EXEC = (0x5450, 0x5451)  # FIONCLEX, FIOCLEX
_FCNTL_COMMANDS = (0, 1, 2, 3, 1030)  # F_DUPFD, F_GETFD, F_SETFD, F_GETFL, F_DUPFD_CLOEXEC
_FUTEX_COMMANDS = (0, 1, 3, 4, 5, 9, 10)  # wait, wake, requeue …, without the PI family
_FUTEX_COMMAND = 0x7F

# What the arguments of a call have to be: for each condition which argument, which half of it,
# which bits, and the values these may have. Addresses cannot be looked behind, so paths are for
# Landlock to judge.
_CONDITIONS: dict[str, list[tuple[int, int, int, tuple[int, ...]]]] = {
    "open": [(1, _LOW, _OPEN_FOR_MORE, (0,))],
    "openat": [(2, _LOW, _OPEN_FOR_MORE, (0,))],
    "fcntl": [(1, _LOW, _ALL_BITS, _FCNTL_COMMANDS)],
    "ioctl": [(1, _LOW, _ALL_BITS, (*_TERMINAL_QUESTIONS, *_CLOSE_ON_EXEC))],
    "clone": [(0, _LOW, _ALL_BITS & ~_CLONE_FLAGS | _CLONE_THREAD, (_CLONE_THREAD,))],
    "futex": [(1, _LOW, _FUTEX_COMMAND, _FUTEX_COMMANDS)],
    "prctl": [(0, _LOW, _ALL_BITS, (_PR_SET_NAME, _PR_GET_NAME))],
    # to ask for the process's own limits, and not to set them
    "prlimit64": [
        (0, _LOW, _ALL_BITS, (0,)),
        (2, _LOW, _ALL_BITS, (0,)),
        (2, _HIGH, _ALL_BITS, (0,)),
    ],
}

# Refused as unknown: the C library then does it another way. clone3 and openat2 have their flags
# behind an address, where no filter sees them. What is newer than the oldest kernel with Landlock,
# 5.13, a program has to do without on that kernel anyway.
_UNKNOWN_CALLS = (435, 437)  # clone3, openat2
_NEWEST_CALL = 446

_INSTRUCTION = struct.Struct("=HBBI")
_LOAD, _AND, _IF_EQUAL, _IF_GREATER, _IF_AT_LEAST, _RETURN = 0x20, 0x54, 0x15, 0x25, 0x35, 0x06
_AT_NUMBER, _AT_ARCHITECTURE, _AT_ARGUMENTS = 0, 4, 16  # in struct seccomp_data
_ALLOW = 0x7FFF0000
_KILL = 0x80000000
_REFUSE = 0x00050000 | errno.EPERM
_SAY_UNKNOWN = 0x00050000 | errno.ENOSYS
_X32 = 0x40000000


def why_unavailable(architecture: Architecture) -> int:
    """Return the number of the error that forbids filters, or 0."""
    action = ctypes.c_uint32(_ALLOW)
    question = (_GET_ACTION_AVAIL, 0, ctypes.addressof(action))
    return ctypes.get_errno() if call(architecture.seccomp, *question) else 0


def install(architecture: Architecture, program: bytes) -> None:  # pragma: no cover - in a child
    """Put this process under a filter for good."""
    instructions = ctypes.create_string_buffer(program, len(program))
    count = len(program) // _INSTRUCTION.size
    header = ctypes.create_string_buffer(
        struct.pack("HP", count, ctypes.addressof(instructions)), 16
    )
    check(
        call(architecture.seccomp, _SET_MODE_FILTER, 0, ctypes.addressof(header)),
        "the seccomp filter",
    )


def program(architecture: Architecture) -> bytes:
    """Return the program by which the kernel judges system calls.

    A call of another architecture, whose numbers mean other things, ends the process.
    """
    instructions = [
        (_LOAD, 0, 0, _AT_ARCHITECTURE),
        (_IF_EQUAL, 1, 0, architecture.audit),
        (_RETURN, 0, 0, _KILL),
        (_LOAD, 0, 0, _AT_NUMBER),
    ]
    if architecture.has_x32:
        instructions += [(_IF_AT_LEAST, 0, 1, _X32), (_RETURN, 0, 0, _KILL)]
    for name, number in architecture.allowed.items():
        judgement = list(_judgement(name))
        instructions += [(_IF_EQUAL, 0, len(judgement), number), *judgement]
    for number in _UNKNOWN_CALLS:
        instructions += [(_IF_EQUAL, 0, 1, number), (_RETURN, 0, 0, _SAY_UNKNOWN)]
    instructions += [
        (_IF_GREATER, 0, 1, _NEWEST_CALL),
        (_RETURN, 0, 0, _SAY_UNKNOWN),
        (_RETURN, 0, 0, _REFUSE),
    ]
    return b"".join(_INSTRUCTION.pack(*instruction) for instruction in instructions)


def _judgement(name: str) -> Iterator[tuple[int, int, int, int]]:
    """Give the instructions that allow a call if its arguments are as they have to be."""
    for argument, half, bits, values in _CONDITIONS.get(name, ()):
        yield _LOAD, 0, 0, _AT_ARGUMENTS + 8 * argument + half
        yield _AND, 0, 0, bits
        for index, value in enumerate(values):
            yield _IF_EQUAL, len(values) - index, 0, value
        yield _RETURN, 0, 0, _REFUSE
    yield _RETURN, 0, 0, _ALLOW
