"""Runs a function on a stack deep enough for recursion, so that none can crash the process.

A conversion runs users' recursive functions and the user's own Python. On a common 8 MB stack the
interpreter itself dies before Python's recursion limit ends the matter with an exception. A thread
may have a stack of any size, of which only what is touched takes memory.
"""

from __future__ import annotations

import _thread
import os
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any, TypeVar

    T = TypeVar("T")

RECURSION_LIMIT = 40_000
STACK_SIZES = (512 << 20, 128 << 20, 32 << 20)
WAKING_INTERVAL = 0.2
"""Seconds after which a wait looks for Ctrl-C, which may have reached another thread."""

_lock = _thread.allocate_lock()  # stack size and recursion limit are set for the whole process
_limits: list[int] = []  # the recursion limit before each function that runs
_idle: list[_Worker] = []  # threads that wait for more to do; to start one takes half a millisecond
MAX_IDLE = 4
_FIRST_IS_MAIN = sys.version_info < (3, 13)
"""Whether the thread that first imports `threading` counts as the main one."""

if hasattr(os, "register_at_fork"):  # a forked process has none of the threads
    os.register_at_fork(after_in_child=_idle.clear)
    os.register_at_fork(after_in_child=_lock._at_fork_reinit)  # type: ignore[attr-defined]


def run_on_deep_stack(function: Callable[[], T]) -> T:
    """Return what `function` returns, or raise what it raises, having run it in a thread.

    It is called directly where a debugger or a coverage tool traces the calling thread, and where
    no thread can be started, as in a browser. There the stack is shallow, and the recursion limit
    stays as it is: with Python's usual 1,000, functions of YAML can call each other 190 deep.
    """
    if sys.gettrace() is not None or sys.getprofile() is not None:
        _raise_recursion_limit()
        try:
            return function()
        finally:
            _restore_recursion_limit()
    job = _Job(function)
    worker = None
    try:
        worker = _idle_worker() or _new_worker()
        if worker is None:
            return function()
        worker.give(job)
        job.wait()
    except BaseException:
        if worker is not None:
            worker.stop(job)
        raise
    try:
        value: T = job.result()
        return value
    finally:
        del job  # a traceback that refers to itself would be kept alive


class _Job:
    """A function to run, and its result."""

    __slots__ = ("_done", "_error", "_function", "_value")

    def __init__(self, function: Callable[[], Any]) -> None:
        self._function = function
        self._value: Any = None
        self._error: BaseException | None = None
        self._done = _thread.allocate_lock()
        self._done.acquire()

    def run(self) -> None:
        """Run the function."""
        _raise_recursion_limit()
        try:
            self._value = self._function()
        except BaseException as error:
            self._error = error
        finally:
            _restore_recursion_limit()

    def end(self) -> None:
        """Let the waiting thread go on."""
        self._done.release()

    def wait(self, longest: float | None = None) -> None:
        """Wait for the end, or for at most `longest` seconds."""
        if longest is not None:
            self._done.acquire(timeout=longest)
            return
        while not self._done.acquire(timeout=WAKING_INTERVAL):
            pass

    def result(self) -> Any:
        """Return what the function returned, or raise what it raised."""
        if self._error is not None:
            raise self._error
        return self._value


class _Worker:
    """A thread with a deep stack, which runs one job after another.

    Up to Python 3.12 the process waits at its end for the thread that first imports `threading`.
    So where that is not imported yet, and a job may do it, there is but one job.
    """

    __slots__ = ("_awake", "_identity", "_is_lasting", "_job", "is_stopped")

    def __init__(self) -> None:
        self._job: _Job | None = None
        self._identity = 0
        self._is_lasting = "threading" in sys.modules
        self._awake = _thread.allocate_lock()
        self._awake.acquire()
        self.is_stopped = False

    def give(self, job: _Job) -> None:
        """Let the thread run a job."""
        self._job = job
        self._awake.release()

    def work(self) -> None:
        """Run what is given, in the thread, until it is stopped."""
        self._identity = _thread.get_ident()
        try:
            while not self.is_stopped:
                self._awake.acquire()
                job, self._job = self._job, None
                if job is None:
                    return
                importer = _await_children()
                job.run()
                if importer is not None and importer in sys.meta_path:
                    sys.meta_path.remove(importer)
                if self._is_lasting and len(_idle) < MAX_IDLE:
                    _idle.append(self)
                else:
                    self.is_stopped = True
                job.end()
                del job  # its result is not to be kept alive
        except BaseException:  # an interruption that came after the job was done
            self.is_stopped = True

    def stop(self, job: _Job) -> None:
        """End the thread after Ctrl-C, and give it a moment to leave its `finally` clauses."""
        import ctypes

        self.is_stopped = True
        if self._identity:
            ctypes.pythonapi.PyThreadState_SetAsyncExc(
                ctypes.c_ulong(self._identity), ctypes.py_object(KeyboardInterrupt)
            )
            job.wait(1.0)
        try:
            self._awake.release()  # where the job was done already, the thread waits for more
        except RuntimeError:  # it has not begun
            pass


class _Importer:
    """Has threads that this one starts waited for, once `threading` is imported, see below."""

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> Any:
        """Find `threading` where it is, and add to what its import does."""
        if name != "threading":
            return None
        if self in sys.meta_path:
            sys.meta_path.remove(self)
        others = [finder for finder in sys.meta_path if hasattr(finder, "find_spec")]
        found = (finder.find_spec(name, path, target) for finder in others)
        spec: Any = next(filter(None, found), None)
        if spec is None or spec.loader is None:
            return spec
        execute = spec.loader.exec_module

        def execute_and_mark(module: Any) -> None:
            execute(module)
            _await_children()

        spec.loader.exec_module = execute_and_mark
        return spec


def _await_children() -> _Importer | None:
    """Have the threads that this one starts waited for at the end, as those of the main thread are.

    A thread takes this from the one that starts it, and a thread that `threading` does not know,
    such as ours, counts as one that is not waited for.

    Returns:
        What does so once `threading` is imported, if it is not yet.
    """
    threading = sys.modules.get("threading")
    if threading is not None:
        threading.current_thread()._daemonic = False
        return None
    if _FIRST_IS_MAIN:
        return None
    importer = _Importer()
    sys.meta_path.insert(0, importer)  # type: ignore[arg-type]
    return importer


def _idle_worker() -> _Worker | None:
    while _idle:
        try:
            worker = _idle.pop()
        except IndexError:  # another thread took the last one
            return None
        if not worker.is_stopped:
            return worker
    return None


def _new_worker() -> _Worker | None:
    """Return a worker whose thread is started, or None if no thread can be."""
    worker = _Worker()
    outcome: list[bool] = []
    done = _thread.allocate_lock()
    done.acquire()

    def begin() -> None:
        # Ctrl-C interrupts the main thread only, so no lock can be left taken here.
        outcome.append(_start(worker.work))
        done.release()

    try:
        _thread.start_new_thread(begin, ())
    except RuntimeError:
        return None
    while not done.acquire(timeout=WAKING_INTERVAL):
        pass
    return worker if outcome[0] else None


def _raise_recursion_limit() -> None:
    with _lock:
        _limits.append(sys.getrecursionlimit())
        if _limits[-1] < RECURSION_LIMIT:
            sys.setrecursionlimit(RECURSION_LIMIT)


def _restore_recursion_limit() -> None:
    """Give back the limit that was found, once nothing runs that needs ours."""
    with _lock:
        before = _limits.pop()  # at last, what the first one found
        if _limits or sys.getrecursionlimit() != RECURSION_LIMIT:
            return
        try:
            sys.setrecursionlimit(before)
        except RecursionError:  # the caller is deeper than its limit already
            return


def _start(run: Callable[[], None]) -> bool:
    """Start a thread with the deepest stack there is to have, and return whether there is one."""
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
