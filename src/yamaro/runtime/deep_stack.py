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
_lock = _thread.allocate_lock()  # stack size and recursion limit are set for the whole process
_limits: list[int] = []  # the recursion limit that was found, once for each function running


def run_on_deep_stack(function: Callable[[], T]) -> T:
    """Return what `function` returns, or raise what it raises, having run it in a thread.

    A debugger, profiler or coverage tool that watches the calling thread watches that one too.
    """
    _raise_recursion_limit()
    try:
        return _run_in_thread(function)
    finally:
        _restore_recursion_limit()


def _raise_recursion_limit() -> None:
    with _lock:
        before = _limits[0] if _limits else sys.getrecursionlimit()
        _limits.append(before)
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


def _run_in_thread(function: Callable[[], T]) -> T:
    outcome: list[tuple[T | None, BaseException | None]] = []
    done = _thread.allocate_lock()
    done.acquire()

    trace, profile = sys.gettrace(), sys.getprofile()

    def run() -> None:
        sys.settrace(trace)
        if callable(profile):  # cProfile's own is not, and sees one thread only
            sys.setprofile(profile)
        try:
            outcome.append((function(), None))
        except BaseException as error:
            outcome.append((None, error))
        finally:
            done.release()

    identity = _start(run)
    if identity is None:
        return function()
    try:
        done.acquire()
    except BaseException:
        _stop(identity, done)
        raise
    value, error = outcome[0]
    if error is not None:
        try:
            raise error
        finally:
            del error, outcome  # a traceback that refers to itself would be kept alive
    return value  # type: ignore[return-value]


def _start(run: Callable[[], None]) -> int | None:
    """Start a thread with the deepest stack there is to have; None if there is none."""
    with _lock:
        for size in STACK_SIZES:
            try:
                before = _thread.stack_size(size)
            except (ValueError, RuntimeError):
                continue
            try:
                return _thread.start_new_thread(run, ())
            except RuntimeError:
                continue
            finally:
                _thread.stack_size(before)
    return None


def _stop(identity: int, done: Any) -> None:
    """End the thread after Ctrl-C, and give it a moment to leave its `finally` clauses."""
    import ctypes

    ctypes.pythonapi.PyThreadState_SetAsyncExc(
        ctypes.c_ulong(identity), ctypes.py_object(KeyboardInterrupt)
    )
    done.acquire(timeout=1.0)
