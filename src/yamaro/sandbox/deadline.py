"""Ends a piece of work after a time, with an exception raised in the midst of it.

That works where Python runs code: at the next step of it the exception comes up. A single call of a
function written in C, such as a regular expression that never ends, is not interrupted.

A thread watches the clock. Where none can be started, as in a browser, the code is monitored
instead, which Python can do from 3.12 on; an older Python runs it without a deadline.
"""

from __future__ import annotations

import _thread
import sys
import time

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import TypeVar

    T = TypeVar("T")

AGAIN_AFTER = 1.0
"""Seconds after which it is raised again, if code of a file has caught it."""


class TimeOver(BaseException):
    """The time is over. Not an `Exception`, so that `except Exception` does not catch it."""


def run_within(seconds: float | None, function: Callable[[], T]) -> T:
    """Return what `function` returns; raise TimeOver in it if it takes longer than `seconds`.

    Args:
        seconds: how long it may take; None for as long as it likes.
        function: is called in this thread.
    """
    if seconds is None:
        return function()
    watch: _Watch | _Monitor = _Watch()
    try:
        try:
            watch.begin(seconds)
        except RuntimeError:  # no thread can be started
            watch = _Monitor()
            watch.begin(seconds)
        return function()
    finally:
        # No `with` could do this: the exception may come up at the first step of __exit__.
        while True:
            try:
                watch.end()
                break
            except TimeOver:  # it came up just here
                continue


class _Watch:
    """Raises TimeOver in the thread that made it, after a time and then every second."""

    __slots__ = ("_begun", "_ended", "_is_over", "_lock", "_thread")

    def __init__(self) -> None:
        self._thread = _thread.get_ident()
        self._lock = _thread.allocate_lock()  # is held while it is raised
        self._is_over = False
        self._begun = _thread.allocate_lock()
        self._ended = _thread.allocate_lock()
        self._begun.acquire()
        self._ended.acquire()

    def begin(self, seconds: float) -> None:
        """Begin to count."""
        _thread.start_new_thread(self._run, (seconds,))
        # Up to Python 3.11 a thread that does not run yet goes by the name of the one that made it,
        # and would take what is raised in that.
        self._begun.acquire()

    def end(self) -> None:
        """Raise no more; what was raised before comes up in here at the latest."""
        with self._lock:
            self._is_over = True
        for _step in range(3):  # at each of which Python looks for what was raised
            pass
        self._ended.release()

    def _run(self, seconds: float) -> None:
        self._begun.release()
        while not self._ended.acquire(timeout=min(seconds, _thread.TIMEOUT_MAX)):
            with self._lock:
                if self._is_over:
                    return
                import ctypes

                # It cannot be taken back: Python 3.11 would then look for it forever, and stand
                # still where a debugger or a coverage tool traces.
                thread = ctypes.c_ulong(self._thread)
                ctypes.pythonapi.PyThreadState_SetAsyncExc(thread, ctypes.py_object(TimeOver))
            seconds = AGAIN_AFTER


class _Monitor:
    """Raises TimeOver where monitored code calls a function or jumps, as each loop does.

    It sees all code of the process: there is but one thread.
    """

    __slots__ = ("_tool", "_until")

    def __init__(self) -> None:
        self._tool: int | None = None
        self._until = float("inf")

    def begin(self, seconds: float) -> None:
        """Begin to look at the clock."""
        monitoring = getattr(sys, "monitoring", None)
        if monitoring is None:
            return
        free = [number for number in range(6) if monitoring.get_tool(number) is None]
        if not free:
            return
        self._until = time.monotonic() + seconds
        self._tool = free[-1]  # the first ones are those of debuggers and profilers
        monitoring.use_tool_id(self._tool, "yamaro deadline")
        events = monitoring.events
        for event in (events.JUMP, events.PY_START):
            monitoring.register_callback(self._tool, event, self._look)
        monitoring.set_events(self._tool, events.JUMP | events.PY_START)

    def end(self) -> None:
        """Raise no more."""
        self._until = float("inf")
        if self._tool is not None:
            monitoring = sys.monitoring  # type: ignore[attr-defined,unused-ignore]
            monitoring.set_events(self._tool, 0)
            monitoring.free_tool_id(self._tool)
            self._tool = None

    def _look(self, *_event: object) -> None:
        now = time.monotonic()
        if now >= self._until:
            self._until = now + AGAIN_AFTER
            raise TimeOver
