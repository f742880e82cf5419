"""Runs a function on a stack deep enough for recursion, so that none can crash the process.

A conversion runs users' recursive functions and the user's own Python. On a common 8 MB stack the
interpreter itself dies before Python's recursion limit ends the matter with an exception. A thread
may have a stack of any size, of which only what is touched takes memory.
"""

from __future__ import annotations

import _thread
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any, TypeVar

    T = TypeVar("T")

RECURSION_LIMIT = 40_000 if sys.version_info >= (3, 11) else 20_000
STACK_SIZES = (512 << 20, 128 << 20, 32 << 20)
WAKING_INTERVAL = 0.2
"""Seconds after which a wait looks for Ctrl-C, which may have reached another thread."""

_lock = _thread.allocate_lock()  # stack size and recursion limit are set for the whole process
_limits: list[int] = []  # the recursion limit that was found, once for each function running


def run_on_deep_stack(function: Callable[[], T]) -> T:
    """Return what `function` returns, or raise what it raises, having run it in a thread.

    It is called directly where a debugger or a coverage tool traces the calling thread.
    """
    if sys.gettrace() is not None or sys.getprofile() is not None:
        return _run_here(function)
    outcome: list[tuple[T | None, BaseException | None]] = []
    identity: list[int] = []
    done = _thread.allocate_lock()
    done.acquire()

    def run() -> None:
        identity.append(_thread.get_ident())
        try:
            outcome.append((function(), None))
        except BaseException as error:
            outcome.append((None, error))
        finally:
            _restore_recursion_limit()
            done.release()

    def begin() -> None:
        # Ctrl-C interrupts the main thread only, so no lock can be left taken here.
        _raise_recursion_limit()
        if not _start(run):
            _restore_recursion_limit()
            done.release()

    try:
        _thread.start_new_thread(begin, ())
        while not done.acquire(timeout=WAKING_INTERVAL):
            pass
    except RuntimeError:  # no thread can be started
        return _run_here(function)
    except BaseException:
        if identity:
            _stop(identity[0], done)
        raise
    if not outcome:
        return _run_here(function)
    value, error = outcome[0]
    if error is not None:
        try:
            raise error
        finally:
            del error, outcome  # a traceback that refers to itself would be kept alive
    return value  # type: ignore[return-value]


def _run_here(function: Callable[[], T]) -> T:
    _raise_recursion_limit()
    try:
        return function()
    finally:
        _restore_recursion_limit()


def _raise_recursion_limit() -> None:
    with _lock:
        _limits.append(_limits[0] if _limits else sys.getrecursionlimit())
        if sys.getrecursionlimit() < RECURSION_LIMIT:
            sys.setrecursionlimit(RECURSION_LIMIT)


def _restore_recursion_limit() -> None:
    """Give back the limit that was found, once nothing runs that needs ours."""
    with _lock:
        before = _limits.pop()
        if _limits or sys.getrecursionlimit() != RECURSION_LIMIT:
            return
        try:
            sys.setrecursionlimit(before)
        except RecursionError:  # the caller is deeper than its limit already
            return


def _start(run: Callable[[], None]) -> bool:
    """Start a thread with the deepest stack there is to have, and tell whether there is one."""
    with _lock:
        for size in STACK_SIZES:
            try:
                before = _thread.stack_size(size)
            except (ValueError, RuntimeError):
                continue
            try:
                _thread.start_new_thread(run, ())
                return True
            except RuntimeError:
                continue
            finally:
                _thread.stack_size(before)
    return False


def _stop(identity: int, done: Any) -> None:
    """End the thread after Ctrl-C, and give it a moment to leave its `finally` clauses."""
    import ctypes

    ctypes.pythonapi.PyThreadState_SetAsyncExc(
        ctypes.c_ulong(identity), ctypes.py_object(KeyboardInterrupt)
    )
    done.acquire(timeout=1.0)
