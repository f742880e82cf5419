"""The process itself: its memory, its end, and how often garbage is collected.

A conversion ends itself when its time is over. But while Python is in a long call of a function
written in C, such as `sum(range(10**12))`, nothing else in the process runs. So another process
looks at the clock as well, and ends the first one.
"""

from __future__ import annotations

import _thread
import gc
import os
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

STACK = 512 << 20
"""Bytes that the deep stack may take."""
FOR_EACH_CORE = 64 << 20
"""Bytes more for each processor: what numerical libraries set aside for their threads."""
GRACE = 1.0
"""Seconds that a process has to end itself, after its time and again after a signal."""
THRESHOLD = 4_000_000
"""New objects after which the collector runs anyway, since users' Python may leave cycles.

A robot of 150,000 lines makes 3 million, in 400 MB.
"""


def bound_memory(size: int) -> None:
    """Let this process have at most `size` bytes of data, where the system can see to that.

    What asks for more gets a MemoryError in place of the machine's last page.
    """
    try:
        import resource
    except ImportError:  # Windows
        return
    most = size + STACK + FOR_EACH_CORE * (os.cpu_count() or 1)
    try:
        soft, hard = resource.getrlimit(resource.RLIMIT_DATA)
        if (soft < 0 or most < soft) and (hard < 0 or most <= hard):
            resource.setrlimit(resource.RLIMIT_DATA, (most, hard))
    except (OSError, ValueError):
        return


def end_after(seconds: float, say_why: Callable[[], None]) -> Callable[[], None]:
    """End this process by force one second after `seconds`, where processes can be forked.

    Args:
        seconds: from now.
        say_why: is called in the other process, just before.

    Returns:
        What calls that off.
    """
    if not hasattr(os, "fork") or sys.platform == "darwin":
        return lambda: None
    reader, writer = os.pipe()  # the writer is closed when this process ends
    parent = os.getpid()
    child = os.fork()
    if child:
        os.close(reader)

        def call_off() -> None:
            os.close(writer)
            os.waitpid(child, 0)

        return call_off
    try:
        os.close(writer)
        _watch(parent, reader, seconds + GRACE, say_why)
    finally:
        os._exit(0)


def _watch(
    parent: int, reader: int, seconds: float, say_why: Callable[[], None]
) -> None:  # pragma: no cover - what measures coverage does not write it down at such an end
    import select
    import signal

    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)  # the parent decides what they mean
    null = os.open(os.devnull, os.O_RDWR)
    os.dup2(null, 0)  # a program that waits for the end of input or output does not wait for us
    os.dup2(null, 1)
    if select.select([reader], [], [], seconds)[0]:
        return
    for number in (signal.SIGTERM, signal.SIGKILL):
        if os.getppid() != parent:
            return
        if number == signal.SIGTERM:
            say_why()
        os.kill(parent, number)
        if select.select([reader], [], [], GRACE)[0]:
            return


# --- garbage collection -----------------------------------------------------------------------


_lock = _thread.allocate_lock()  # the thresholds are set for the whole process
if hasattr(os, "register_at_fork"):  # a thread that holds it is not in the forked process
    os.register_at_fork(after_in_child=_lock._at_fork_reinit)  # type: ignore[attr-defined]
_found: list[tuple[int, int, int]] = []  # the thresholds before each that runs


class RareCollection:
    """While any of these is entered, the collector looks seldom; they may nest, in any thread.

    A conversion makes many objects that live to its end. The collector would go through them again
    and again, and find nothing: that is more than half of the time of a large file.

    A collector that is switched off stays off, and one that looks even less often is let be.
    """

    __slots__ = ()

    def __enter__(self) -> None:
        with _lock:
            _found.append(gc.get_threshold())
            if 0 < _found[-1][0] < THRESHOLD:
                gc.set_threshold(THRESHOLD)

    def __exit__(self, *raised: object) -> None:
        """Give back the thresholds that were found, once nothing runs that needs ours."""
        with _lock:
            before = _found.pop()  # at last, what the first one found
            if not _found and gc.get_threshold()[0] == THRESHOLD:
                gc.set_threshold(*before)
