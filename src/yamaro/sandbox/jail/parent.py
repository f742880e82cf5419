"""The parent's side of a jail: it forks the child, listens to it, and ends it."""

from __future__ import annotations

import errno
import fcntl
import os
import platform
import select
import signal
import sys
import time
import warnings

from . import landlock, seccomp
from .calls import architecture, here, lift
from .child import Cell, live_in_jail
from .landlock import Ruleset
from .protocol import (
    ANSWER,
    FAILED,
    HEADER,
    LONGEST_REASON,
    MEMORY,
    NO_JAIL,
    READY,
    JailAbandoned,
    JailAnswerBroken,
    JailAnswerTooLong,
    JailCpuTimeOver,
    JailCrashed,
    JailError,
    JailOutOfMemory,
    JailTimeOver,
    JailTooManyThreads,
    JailUnavailable,
    JailWorkFailed,
    unpack,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from .protocol import JailLimits

_WATCH_INTERVAL = 0.02
"""Seconds between two looks at how many threads the child has: Linux has no limit of its own for
that but RLIMIT_NPROC, which counts all processes of the user and lets root pass."""
_GRACE = 1.0
"""Seconds that a child has to die in once it has closed its end of the pipe."""
_PIPE_SIZE = 1 << 20
_ALL_SIGNALS = signal.valid_signals()
_FORK_WARNING = r"This process .* is multi-threaded, use of fork"


def why_unavailable() -> str | None:
    """Return why this Linux can have no jail, or None."""
    found = architecture()
    if found is None:
        return f"the jail knows x86-64 and aarch64, not {platform.machine()}"
    version = landlock.version()
    if version == -errno.ENOSYS:
        return "the kernel has no Landlock, which Linux 5.13 brought"
    if version == -errno.EOPNOTSUPP:
        return "Landlock is turned off; name it in the kernel's option lsm="
    if version < 1:
        return f"Landlock is refused here, perhaps by a container: {os.strerror(-version)}"
    error = seccomp.why_unavailable(found)
    if error:
        return f"the kernel takes no seccomp filters: {os.strerror(error)}"
    if not os.path.exists("/proc/self/statm"):
        return "/proc is not mounted, which shows how much memory and how many threads there are"
    return None


def run(
    work: Callable[[], bytes],
    *,
    readable: Sequence[str],
    limits: JailLimits,
    environment: Sequence[str],
) -> bytes:
    """Return what `work` returns, having run it in a jail that `why_unavailable` sees no bar to.

    Signals wait while descriptors are opened and the child is forked, so that no Ctrl-C loses one
    of them, and no handler of the parent's runs in the child. Where there are other threads they
    may take a signal meanwhile, and Python then interrupts the main thread anyway; a child
    that is lost like that ends with its parent, or at a limit.
    """
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except (AttributeError, OSError, ValueError):  # there is none, or it is closed or broken
            pass
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, _ALL_SIGNALS)
    try:
        with Ruleset(readable) as ruleset, Child(limits) as child:
            child.start(ruleset.descriptor, environment, work)
            try:
                signal.pthread_sigmask(signal.SIG_SETMASK, mask)
                return child.listen()
            finally:
                signal.pthread_sigmask(signal.SIG_BLOCK, _ALL_SIGNALS)
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)


class Child:
    """The jailed process as its parent sees it; gone when its `with` block ends."""

    def __init__(self, limits: JailLimits) -> None:
        """Hold the limits; time runs from here."""
        self._limits = limits
        self._deadline = time.monotonic() + limits.seconds
        self._pid = 0
        self._reader = -1
        self._writer = -1
        self._state = -1  # of /proc/…/stat

    def __enter__(self) -> Child:
        self._reader, writer = os.pipe()
        self._writer = lift(writer)
        try:
            fcntl.fcntl(self._writer, fcntl.F_SETPIPE_SZ, _PIPE_SIZE)
        except OSError:  # the user's pipes are as large as they may be; a small one is only slower
            pass
        return self

    def __exit__(self, *_: object) -> None:
        self._end()
        descriptors = (self._reader, self._writer, self._state)
        self._reader = self._writer = self._state = -1
        for descriptor in descriptors:
            if descriptor >= 0:
                os.close(descriptor)

    def start(self, ruleset: int, environment: Sequence[str], work: Callable[[], bytes]) -> None:
        """Fork.

        A parent with threads can fork well as long as none of its other threads holds a lock that
        the work needs, and no library waits for threads of its own when Python frees in the child
        what other threads had. Otherwise the child hangs until the wall clock ends it. That is
        known, so the warning about it is turned off; for good, since to turn it on again would
        race with other threads.
        """
        warnings.filterwarnings("ignore", message=_FORK_WARNING, category=DeprecationWarning)
        cell = Cell(
            writer=self._writer,
            parent=os.getpid(),
            ruleset=ruleset,
            program=seccomp.program(here()),
            limits=self._limits,
            environment=environment,
        )
        self._pid = os.fork()
        if self._pid == 0:
            live_in_jail(cell, work)
        writer, self._writer = self._writer, -1
        os.close(writer)
        try:
            self._state = os.open(f"/proc/{self._pid}/stat", os.O_RDONLY | os.O_CLOEXEC)
        except FileNotFoundError:  # it has ended, and the kernel was set to forget such children
            pass
        except OSError as error:
            raise JailUnavailable(f"threads cannot be counted: {error}") from None

    def listen(self) -> bytes:
        """Return the answer."""
        try:
            kind, length = self._header()
        except (JailCrashed, JailAnswerBroken) as error:
            raise JailUnavailable(f"the jail could not be set up: {error}") from None
        if kind == NO_JAIL:
            raise JailUnavailable(self._text(length))
        if kind != READY:
            raise JailUnavailable("the jail could not be set up")
        kind, length = self._header()
        if kind == ANSWER:
            if length > self._limits.answer:
                raise JailAnswerTooLong(f"the answer has {length} bytes")
            return self._read(length)
        if kind == MEMORY:
            raise JailOutOfMemory("the memory does not suffice")
        if kind == FAILED:
            raise _failure(self._read(min(length, 5 * LONGEST_REASON)))
        raise JailAnswerBroken("the answer is not valid")

    def _header(self) -> tuple[bytes, int]:
        kind, length = HEADER.unpack(self._read(HEADER.size))
        return kind, length

    def _text(self, length: int) -> str:
        return _text(self._read(min(length, LONGEST_REASON)))

    def _read(self, length: int) -> bytes:
        """Return `length` bytes from the child, watching it meanwhile."""
        chunks = []
        missing = length
        poll = select.poll()
        poll.register(self._reader, select.POLLIN)
        next_look = 0.0
        while missing:
            now = time.monotonic()
            if now >= self._deadline:
                raise JailTimeOver(f"it takes longer than {self._limits.seconds:g} s")
            if now >= next_look:
                if self._limits.is_abandoned is not None and self._limits.is_abandoned():
                    raise JailAbandoned("the answer is not wanted any more")
                self._look_at_threads()
                next_look = now + _WATCH_INTERVAL
            if not poll.poll(1000 * min(_WATCH_INTERVAL, self._deadline - now)):
                continue
            chunk = os.read(self._reader, min(missing, _PIPE_SIZE))
            if not chunk:
                raise self._why_it_ended()
            chunks.append(chunk)
            missing -= len(chunk)
        return b"".join(chunks)

    def _look_at_threads(self) -> None:
        try:
            fields = os.pread(self._state, 1000, 0).rpartition(b")")[2].split()
        except OSError:  # it has ended
            return
        if int(fields[17]) > self._limits.threads:  # the 20th field, num_threads
            raise JailTooManyThreads(f"it runs more than {self._limits.threads} threads")

    def _why_it_ended(self) -> JailError:
        """Return the error for a child that has closed its end of the pipe too early."""
        give_up = time.monotonic() + _GRACE
        while (is_running := self._is_running()) and time.monotonic() < give_up:
            time.sleep(0.001)
        cpu_seconds, status = self._end()
        if is_running or status is None or not os.WIFSIGNALED(status):
            return JailAnswerBroken("the answer was cut short")
        ended_by = os.WTERMSIG(status)
        if ended_by == signal.SIGXCPU:
            return JailCpuTimeOver(f"it computes for more than {self._limits.cpu_seconds} s")
        if ended_by == signal.SIGKILL:
            if cpu_seconds >= self._limits.cpu_seconds:
                return JailCpuTimeOver(f"it computes for more than {self._limits.cpu_seconds} s")
            return JailCrashed("it was killed; perhaps the machine has no memory left")
        if ended_by == signal.SIGSYS:
            return JailCrashed("it made a system call of another architecture")
        return JailCrashed(f"it crashed ({signal.Signals(ended_by).name})")

    def _is_running(self) -> bool:
        try:
            return _look_at(self._pid) is None
        except ChildProcessError:  # someone else has asked for its status
            return False

    def _end(self) -> tuple[float, int | None]:
        """Kill the child if it lives, and return its processor time and its status.

        An exception that a signal handler raises waits until the child is gone.
        """
        if not self._pid:
            return 0.0, None
        pid, self._pid = self._pid, 0
        interruption: BaseException | None = None
        result: tuple[float, int | None] = (0.0, None)
        is_killed = False
        while True:
            try:
                if not is_killed:
                    _look_at(pid)  # for the number may be another's by now
                    os.kill(pid, signal.SIGKILL)
                    is_killed = True
                _, status, usage = os.wait4(pid, 0)
                result = (usage.ru_utime + usage.ru_stime, status)
                break
            except OSError:  # someone else has asked for its status
                break
            except BaseException as error:
                interruption = error
        if interruption is not None:
            raise interruption
        return result


def _failure(data: bytes) -> JailError:
    """Return the error for an exception that the child describes."""
    try:
        kind, text, place, is_fault = map(_text, unpack(data))
    except ValueError:
        return JailAnswerBroken("the answer is not valid")
    except JailAnswerBroken as error:
        return error
    return JailWorkFailed(kind, text, place, is_fault=bool(is_fault))


def _text(data: bytes) -> str:
    return data.decode("utf-8", "backslashreplace")


def _look_at(pid: int) -> object:
    """Return how a child ended, or None if it runs; its status stays to be asked for.

    Raises:
        ChildProcessError: there is no such child.
    """
    return os.waitid(os.P_PID, pid, os.WEXITED | os.WNOHANG | os.WNOWAIT)
