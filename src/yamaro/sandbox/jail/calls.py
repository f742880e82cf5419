"""System calls: making them, their numbers, and those that a jailed process may make."""

from __future__ import annotations

import ctypes
import fcntl
import os
import platform
import sys

libc = ctypes.CDLL(None, use_errno=True)
libc.syscall.restype = ctypes.c_long
libc.syscall.argtypes = [ctypes.c_long] * 7
libc.signal.argtypes = [ctypes.c_int, ctypes.c_void_p]


def call(number: int, *arguments: int) -> int:
    """Make a system call; -1 means that `ctypes.get_errno` gives the reason."""
    padding = [0] * (6 - len(arguments))
    result: int = libc.syscall(number, *arguments, *padding)
    return result


def check(result: int, what: str) -> int:
    """Return the result of a system call.

    Raises:
        OSError: it failed; `what` is its subject.
    """
    if result < 0:
        raise OSError(f"{what} is refused: {os.strerror(ctypes.get_errno())}")
    return result


def lift(descriptor: int) -> int:
    """Return a descriptor for the same above those of the standard streams, which are replaced."""
    if descriptor > 2:
        return descriptor
    try:
        return fcntl.fcntl(descriptor, fcntl.F_DUPFD_CLOEXEC, 3)
    finally:
        os.close(descriptor)


class Architecture:
    """The numbers of system calls on one kind of processor."""

    __slots__ = ("allowed", "audit", "capget", "capset", "has_x32", "prctl", "seccomp", "socket")

    def __init__(self, column: int, *, audit: int, has_x32: bool) -> None:
        """Take them from a column of the tables below."""
        self.audit = audit  # the kernel's number for the architecture
        self.has_x32 = has_x32
        self.allowed = numbers(ALLOWED_CALLS, column)
        setup = numbers(SETUP_CALLS, column)
        self.prctl = setup["prctl"]
        self.seccomp = setup["seccomp"]
        self.capget = setup["capget"]
        self.capset = setup["capset"]
        self.socket = setup["socket"]


def numbers(table: str, column: int) -> dict[str, int]:
    """Return what is in a column of a table, by name."""
    rows = [row.split() for row in table.strip().splitlines()]
    return {row[0]: int(row[column]) for row in rows if row[column] != "-"}


# What a jailed process may call: to read and to compute. Each row is a name and its number on
# x86-64 and on aarch64. Whatever is missing here is refused with an error that the C library and
# Python know how to take, so that a table too short costs a feature, and never safety.
ALLOWED_CALLS = """
    read               0    63
    readv             19    65
    pread64           17    67
    preadv           295    69
    preadv2          327   286
    write              1    64
    writev            20    66
    lseek              8    62
    open               2     -
    openat           257    56
    close              3    57
    dup               32    23
    fcntl             72    25
    ioctl             16    29
    stat               4     -
    lstat              6     -
    fstat              5    80
    newfstatat       262    79
    statx            332   291
    access            21     -
    faccessat        269    48
    faccessat2       439   439
    readlink          89     -
    readlinkat       267    78
    getcwd            79    17
    getdents64       217    61
    mmap               9   222
    munmap            11   215
    mremap            25   216
    mprotect          10   226
    madvise           28   233
    brk               12   214
    membarrier       324   283
    clone             56   220
    exit              60    93
    exit_group       231    94
    futex            202    98
    set_robust_list  273    99
    set_tid_address  218    96
    rseq             334   293
    prctl            157   167
    sched_yield       24   124
    sched_getaffinity 204  123
    getcpu           309   168
    rt_sigaction      13   134
    rt_sigprocmask    14   135
    rt_sigreturn      15   139
    sigaltstack      131   132
    restart_syscall  219   128
    poll               7     -
    ppoll            271    73
    select            23     -
    pselect6         270    72
    nanosleep         35   101
    clock_nanosleep  230   115
    clock_gettime    228   113
    clock_getres     229   114
    gettimeofday      96   169
    time             201     -
    times            100   153
    getrusage         98   165
    getrlimit         97   163
    prlimit64        302   261
    sysinfo           99   179
    uname             63   160
    getrandom        318   278
    getpid            39   172
    gettid           186   178
    getppid          110   173
    getuid           102   174
    geteuid          107   175
    getgid           104   176
    getegid          108   177
    getresuid        118   148
    getresgid        120   150
    getgroups        115   158
"""

# What setting up a jail calls, and, with `socket`, what tries whether it holds.
SETUP_CALLS = """
    prctl            157   167
    seccomp          317   277
    capget           125    90
    capset           126    91
    socket            41   198
"""

ARCHITECTURES = {
    "x86_64": Architecture(1, audit=0xC000003E, has_x32=True),
    "aarch64": Architecture(2, audit=0xC00000B7, has_x32=False),
}


def architecture() -> Architecture | None:
    """Return the architecture of this process, or None if it is not one that we know."""
    if sys.maxsize < 1 << 32 or sys.byteorder != "little":  # a 32-bit process, x32 as well
        return None
    return ARCHITECTURES.get(platform.machine())


def here() -> Architecture:
    """Return the architecture of this process, which `why_unavailable` has seen to be one."""
    found = architecture()
    assert found is not None
    return found
