"""Ends a piece of work after a time, with an exception raised in the midst of it.

That works where Python runs code: at the next step of it the exception comes up. A single call of a
function written in C, such as a regular expression that never ends, is not interrupted.
"""

from __future__ import annotations

import _thread

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

AGAIN_AFTER = 1.0
"""Seconds after which it is raised again, if code of a file has caught it."""


class TimeOver(BaseException):
    """The time is over. Not an `Exception`, so that `except Exception` does not catch it."""


class Deadline:
    """Raises TimeOver in this thread if its `with` block takes longer than so many seconds."""

    __slots__ = ("_ended", "_is_over", "_lock", "_seconds", "_thread")

    def __init__(self, seconds: float | None) -> None:
        """Allow so many seconds, or any number."""
        self._seconds = seconds
        self._thread = 0
        self._lock = _thread.allocate_lock()  # of the two attributes below
        self._is_over = False
        self._ended = _thread.allocate_lock()  # taken as long as the block runs

    def __enter__(self) -> Deadline:
        if self._seconds is not None:
            self._thread = _thread.get_ident()
            self._ended.acquire()
            _thread.start_new_thread(self._watch, (self._seconds,))
        return self

    def __exit__(self, *_: object) -> None:
        if self._seconds is None:
            return
        while True:
            try:
                with self._lock:
                    self._is_over = True
                    _raise_in(self._thread, None)  # what was raised and has not come up yet
                break
            except TimeOver:  # it came up just here
                continue
        self._ended.release()

    def _watch(self, seconds: float) -> None:
        while not self._ended.acquire(timeout=min(seconds, _thread.TIMEOUT_MAX)):
            with self._lock:
                if self._is_over:
                    return
                _raise_in(self._thread, TimeOver)
            seconds = AGAIN_AFTER


def _raise_in(thread: int, kind: type[BaseException] | None) -> None:
    """Raise an exception in a thread as soon as it runs Python code; None takes it back."""
    import ctypes

    what: Any = ctypes.py_object(kind) if kind is not None else None
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), what)
