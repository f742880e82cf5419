"""No recursion crashes the process, Ctrl-C ends it, and threads do not disturb each other."""

from __future__ import annotations

import _thread
import contextlib
import os
import signal
import subprocess
import sys
import threading
import time
import warnings
import weakref
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.waiting import PATIENCE, wait_for
from yamaro import YamaroError, build, convert
from yamaro.files.loader import MemoryLoader
from yamaro.sandbox import deep_stack
from yamaro.sandbox import process as collector
from yamaro.sandbox.deep_stack import run_on_deep_stack

ENDLESS = """
functions:
  Count: {input: n, body: {Count: $(n + 1)}}
out: {Count: 0}
"""


def compile_text(text: str) -> str:
    return build("/t.yaml", loader=MemoryLoader({"/t.yaml": text})).xml()


def run_command(path: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "yamaro", str(path)]
    # A tool that measures coverage in there would keep the build off the deep stack.
    environment = {k: v for k, v in os.environ.items() if not k.startswith("COVERAGE_")}
    return subprocess.run(
        command, capture_output=True, encoding="utf-8", timeout=PATIENCE, env=environment
    )


def write(folder: Path, text: str) -> Path:
    path = folder / "t.yaml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture
def untraced() -> Iterator[None]:
    """Keep a tool that measures coverage out of a test: what is traced runs in its own thread."""
    trace = sys.gettrace()
    sys.settrace(None)
    yield
    sys.settrace(trace)


# --- recursion --------------------------------------------------------------------------------


def test_functions_may_call_themselves_1400_deep(tmp_path: Path) -> None:
    path = write(
        tmp_path,
        """
functions:
  Nest:
    input: n
    body:
      if:
        condition: n > 0
        body:
          for: {iterator: i, range: 1, body: {level: {Nest: $(n - 1)}}}
      else: {deepest: }
out: {Nest: 1400}
""",
    )
    finished = run_command(path)
    assert (finished.returncode, finished.stderr) == (0, "")
    assert finished.stdout.count("<level>") == 1400
    assert finished.stdout.count("<deepest/>") == 1


def test_endless_recursion_is_told_with_its_trace(tmp_path: Path) -> None:
    finished = run_command(write(tmp_path, ENDLESS))
    assert finished.returncode == 1
    assert finished.stderr.startswith("error[too-deep]: ")
    assert "in Count, called at" in finished.stderr
    assert len(finished.stderr.splitlines()) < 30


def test_endless_inclusion_is_told(tmp_path: Path) -> None:
    finished = run_command(write(tmp_path, "out: {include: t.yaml}\n"))
    assert finished.returncode == 1
    assert finished.stderr.startswith("error[too-deep]: ")


def test_blocks_that_pass_each_other_on_without_end_are_told(tmp_path: Path) -> None:
    text = """
functions:
  Again: {input: '**Block', body: {a: {Again: {Block: {b: {Block: }}}}}}
out: {Again: {Block: }}
"""
    finished = run_command(write(tmp_path, text))
    assert finished.returncode == 1
    assert finished.stderr.startswith("error[too-deep]: ")


@pytest.mark.parametrize(
    "python",
    [
        "def f(x): return sorted([x, x], key=f)",
        "def f(x): return list(map(f, [x]))",
        "def f(x): return f(x) + 1",
        "import functools\n  def f(x): return functools.reduce(lambda a, b: f(a), [x, x])",
        "class A:\n    def __repr__(self): return repr(self) + ''\n  f = lambda x: repr(A())",
        "class A:\n    def __getattr__(self, name): return self.z + 1\n  f = lambda x: A().y",
    ],
    ids=["sorted", "map", "plain", "reduce", "repr", "getattr"],
)
def test_endless_recursion_of_the_users_python_does_not_crash(tmp_path: Path, python: str) -> None:
    finished = run_command(write(tmp_path, f"process: |\n  {python}\nout: $(f(1))\n"))
    assert finished.returncode == 1
    # Where Python tells a recursion through C apart, it does so with a message of its own.
    assert finished.stderr.startswith(("error[too-deep]: ", "error[python-error]: "))
    assert "Traceback" not in finished.stderr


def test_deeply_nested_expressions_do_not_crash(tmp_path: Path) -> None:
    for text in ("(" * 5000 + "1" + ")" * 5000, "-" * 50_000 + "1", "[" * 150 + "]" * 150):
        finished = run_command(write(tmp_path, f"process: |\n  x = {text}\nout:\n"))
        assert finished.returncode in (0, 1)
        assert "Traceback" not in finished.stderr


def test_an_element_tree_may_be_deep() -> None:
    text = "functions:\n  N: {input: n, body: {if: {condition: n, body: {a: {N: $(n - 1)}}}}}\n"
    assert compile_text(text + "out: {N: 1000}\n").count("<a") == 1000


# --- what is left behind ----------------------------------------------------------------------


def test_the_recursion_limit_is_given_back() -> None:
    before = sys.getrecursionlimit()
    compile_text("out:\n")
    assert sys.getrecursionlimit() == before
    with pytest.raises(YamaroError):
        compile_text(ENDLESS)
    assert sys.getrecursionlimit() == before


def test_whatever_the_limit_was_it_is_given_back() -> None:
    before = sys.getrecursionlimit()
    try:
        for limit in (1234, 2345):
            sys.setrecursionlimit(limit)
            assert run_on_deep_stack(sys.getrecursionlimit) > limit
            assert sys.getrecursionlimit() == limit
    finally:
        sys.setrecursionlimit(before)


def test_a_higher_recursion_limit_is_kept() -> None:
    before = sys.getrecursionlimit()
    higher = deep_stack.RECURSION_LIMIT + 1
    sys.setrecursionlimit(higher)
    try:
        assert run_on_deep_stack(sys.getrecursionlimit) == higher
        assert sys.getrecursionlimit() == higher
    finally:
        sys.setrecursionlimit(before)


def test_the_stack_size_of_other_threads_is_unchanged() -> None:
    before = threading.stack_size()
    compile_text("out:\n")
    assert threading.stack_size() == before


def test_results_and_exceptions_come_through() -> None:
    def fail() -> None:
        raise LookupError("told")

    assert run_on_deep_stack(lambda: 42) == 42
    with pytest.raises(LookupError, match="told"):
        run_on_deep_stack(fail)


@pytest.mark.usefixtures("untraced")
def test_where_no_thread_can_be_started_the_function_runs_all_the_same(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(deep_stack, "STACK_SIZES", (1,))  # far too small to be allowed
    monkeypatch.setattr(deep_stack, "_idle", [])
    assert run_on_deep_stack(threading.get_ident) == threading.get_ident()


@pytest.mark.usefixtures("untraced")
def test_the_thread_is_used_again_and_holds_on_to_nothing() -> None:
    class Result:
        pass

    first = run_on_deep_stack(threading.get_ident)
    result = run_on_deep_stack(Result)
    assert run_on_deep_stack(threading.get_ident) == first != threading.get_ident()
    gone = weakref.ref(result)
    del result
    assert gone() is None


@pytest.fixture
def no_thread(untraced: None, monkeypatch: pytest.MonkeyPatch) -> list[deep_stack._Worker]:
    """Let no thread wait for work; return the list of those that will."""
    idle: list[deep_stack._Worker] = []
    monkeypatch.setattr(deep_stack, "_idle", idle)
    return idle


def test_a_thread_waits_for_more_to_do(no_thread: list[deep_stack._Worker]) -> None:
    for _ in range(2):
        run_on_deep_stack(lambda: 1)
        assert len(no_thread) == 1
    (worker,) = no_thread
    run_on_deep_stack(lambda: 1)
    assert no_thread == [worker]
    assert not worker.is_stopped


@pytest.mark.parametrize("most", [0, 1])
def test_no_more_threads_wait_than_may(
    no_thread: list[deep_stack._Worker], monkeypatch: pytest.MonkeyPatch, most: int
) -> None:
    monkeypatch.setattr(deep_stack, "MAX_IDLE", most)
    threads = _thread._count()
    both = threading.Barrier(2)
    other = threading.Thread(target=run_on_deep_stack, args=(both.wait,))
    other.start()
    run_on_deep_stack(both.wait)
    other.join()
    assert len(no_thread) == most
    wait_for(lambda: _thread._count() == threads + most)  # the others have ended


def test_no_thread_waits_where_a_job_may_be_the_first_to_import_threading(
    no_thread: list[deep_stack._Worker], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delitem(sys.modules, "threading")
    assert run_on_deep_stack(lambda: 1) == 1
    assert no_thread == []


def test_a_stack_that_cannot_be_had_is_replaced_by_a_smaller_one(
    no_thread: list[deep_stack._Worker], monkeypatch: pytest.MonkeyPatch
) -> None:
    start, sizes = _thread.start_new_thread, list[int]()

    def start_if_small(function: Callable[..., object], arguments: tuple[object, ...]) -> int:
        sizes.append(threading.stack_size())
        if sizes[-1] == deep_stack.STACK_SIZES[0]:
            raise RuntimeError("can't start new thread")
        return start(function, arguments)

    monkeypatch.setattr(_thread, "start_new_thread", start_if_small)
    before = threading.stack_size()
    assert run_on_deep_stack(threading.get_ident) != threading.get_ident()
    assert sizes == [before, *deep_stack.STACK_SIZES[:2]]
    assert threading.stack_size() == before


@pytest.mark.usefixtures("untraced")
def test_what_runs_in_a_thread_can_be_stopped(no_thread: list[deep_stack._Worker]) -> None:
    begun, told = threading.Event(), list[str]()

    def work_for_ever() -> None:
        begun.set()
        try:
            while True:
                time.sleep(0.001)
        finally:
            told.append("ended")

    threads = _thread._count()
    job, worker = deep_stack._Job(work_for_ever), deep_stack._new_worker()
    assert worker is not None
    worker.give(job)
    assert begun.wait(PATIENCE)
    worker.stop(job)
    wait_for(lambda: told == ["ended"])
    assert worker.is_stopped
    with pytest.raises(KeyboardInterrupt):
        job.result()
    wait_for(lambda: _thread._count() == threads)


@pytest.mark.usefixtures("untraced")
def test_a_thread_that_does_not_heed_ctrl_c_is_waited_for_a_second_only() -> None:
    begun, release, over = threading.Event(), threading.Event(), threading.Event()

    def hold_out() -> None:
        begun.set()
        try:
            release.wait(PATIENCE)
        finally:
            over.set()

    job, worker = deep_stack._Job(hold_out), deep_stack._new_worker()
    assert worker is not None
    worker.give(job)
    assert begun.wait(PATIENCE)
    worker.stop(job)
    assert not over.is_set()
    release.set()
    job.wait()


def test_a_thread_that_ended_after_its_job_is_not_used_again(
    no_thread: list[deep_stack._Worker],
) -> None:
    class Interrupted(deep_stack._Job):
        def end(self) -> None:
            super().end()
            raise KeyboardInterrupt

    threads = _thread._count()
    job, worker = Interrupted(lambda: 7), deep_stack._new_worker()
    assert worker is not None
    worker.give(job)
    job.wait()
    assert job.result() == 7
    wait_for(lambda: _thread._count() == threads)
    assert no_thread == [worker]
    assert deep_stack._idle_worker() is None
    assert run_on_deep_stack(threading.get_ident) != threading.get_ident()


def test_a_process_ends_whose_conversion_was_the_first_to_import_threading(tmp_path: Path) -> None:
    path = write(tmp_path, "import: threading\nout: $(threading.active_count())\n")
    code = (
        f"import sys, yamaro; assert 'threading' not in sys.modules; yamaro.convert({str(path)!r})"
    )
    environment = {k: v for k, v in os.environ.items() if not k.startswith("COVERAGE_")}
    subprocess.run(
        [sys.executable, "-I", "-c", code], timeout=PATIENCE, check=True, env=environment
    )


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork here")
@pytest.mark.parametrize("is_locked", [False, True])
def test_a_forked_process_starts_a_thread_of_its_own(is_locked: bool) -> None:
    compile_text("out:\n")
    with contextlib.ExitStack() as stack:
        if is_locked:  # as they are while another thread begins a conversion
            stack.enter_context(deep_stack._lock)
            stack.enter_context(collector._lock)
        stack.enter_context(warnings.catch_warnings())
        warnings.simplefilter("ignore")  # of forking a process that has threads
        process = os.fork()
        if process == 0:
            stack.pop_all()
    if process == 0:
        os._exit(0 if compile_text("out:\n").endswith("<out/>\n") else 1)
    try:
        # If it waited for a thread that only its parent has, it would wait forever.
        wait_for(lambda: os.waitid(os.P_PID, process, os.WEXITED | os.WNOHANG | os.WNOWAIT))
    except AssertionError:
        os.kill(process, signal.SIGKILL)
        os.waitpid(process, 0)
        raise
    assert os.waitpid(process, 0) == (process, 0)


@pytest.mark.usefixtures("untraced")
def test_an_interrupted_thread_is_not_used_again(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(deep_stack, "_idle", [])

    def interrupt(self: object, longest: float | None = None) -> None:
        if longest is None:
            raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(deep_stack._Job, "wait", interrupt)
        with pytest.raises(KeyboardInterrupt):
            run_on_deep_stack(lambda: time.sleep(0.2))
    time.sleep(0.3)
    assert deep_stack._idle_worker() is None
    assert compile_text("out:\n").endswith("<out/>\n")


@pytest.mark.usefixtures("untraced")
def test_a_thread_whose_work_was_done_when_it_is_interrupted_ends(
    no_thread: list[deep_stack._Worker], monkeypatch: pytest.MonkeyPatch
) -> None:
    wait = deep_stack._Job.wait

    def interrupt(self: deep_stack._Job, longest: float | None = None) -> None:
        wait(self, longest)
        if longest is None:
            wait_for(lambda: no_thread)  # it waits for more to do
            raise KeyboardInterrupt

    threads = _thread._count()
    monkeypatch.setattr(deep_stack._Job, "wait", interrupt)
    with pytest.raises(KeyboardInterrupt):
        run_on_deep_stack(int)
    wait_for(lambda: _thread._count() == threads)


# --- interrupts -------------------------------------------------------------------------------


@pytest.mark.skipif(sys.platform == "win32", reason="SIGINT cannot be sent to a process there")
@pytest.mark.parametrize(
    "python",
    [
        "while True: pass",
        "while True:\n    try: 1 / 0\n    except Exception: pass",
        "sum(1 for _ in iter(int, 1))",
        "import time; time.sleep(0.2); print('x'); exec('while 1: 0')",
    ],
    ids=["loop", "loop that catches", "in C", "after more output"],
)
def test_ctrl_c_ends_a_run_at_once(tmp_path: Path, python: str) -> None:
    text = f"process: |\n  print('begun')\n  {python}\nout:\n"
    target = tmp_path / "out.xml"
    command = [sys.executable, "-m", "yamaro", str(write(tmp_path, text)), "-o", str(target)]
    # An interruption in the midst of coverage could leave its lock taken.
    plain = {name: value for name, value in os.environ.items() if "COVERAGE" not in name}
    with subprocess.Popen(command, stderr=subprocess.PIPE, encoding="utf-8", env=plain) as process:
        assert process.stderr is not None
        assert process.stderr.readline() == "begun\n"
        process.send_signal(signal.SIGINT)
        rest = process.stderr.read()
        assert process.wait(timeout=PATIENCE) == 130
    assert "Traceback" not in rest
    assert not target.exists()


# --- threads ----------------------------------------------------------------------------------

DEEP = """
import: own
variables: {n/global: $(own.number)}
functions:
  Deep:
    input: k
    body: {if: {condition: k, body: {Deep: $(k - 1)}}, else: {v: $(n)}}
out: {Deep: 300}
"""


def test_eight_threads_convert_at_once(tmp_path: Path) -> None:
    limit, outcomes = sys.getrecursionlimit(), dict[int, str]()
    together = threading.Barrier(8)

    def work(number: int) -> None:
        folder = tmp_path / str(number)
        folder.mkdir()
        (folder / "own.py").write_text(f"number = {number}\n")
        path = write(folder, DEEP)
        together.wait()
        for _ in range(5):
            outcomes[number] = outcomes.get(number, "") + convert(path)

    threads = [threading.Thread(target=work, args=(number,)) for number in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for number in range(8):
        assert outcomes[number] == f'<?xml version="1.0"?>\n<out>\n  <v>{number}</v>\n</out>\n' * 5
    assert sys.getrecursionlimit() == limit
    assert "own" not in sys.modules


STARTS_A_THREAD = """
import time
{before}
from yamaro import build
work = "lambda: (time.sleep(0.3), print('done', flush=True))"
code = "import threading, time; threading.Thread(target=" + work + ").start()"
with open("robot.yaml", "w") as file:
    file.write("process: |\\n  " + code + "\\nout: {{a: 1}}\\n")
build("robot.yaml")
"""


@pytest.mark.parametrize("before", ["", "import threading"], ids=["first", "imported before"])
def test_threads_that_a_file_starts_are_waited_for(before: str, tmp_path: Path) -> None:
    environment = {k: v for k, v in os.environ.items() if not k.startswith("COVERAGE_")}
    finished = subprocess.run(
        [sys.executable, "-c", STARTS_A_THREAD.format(before=before)],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        env={**environment, "PYTHONPATH": os.pathsep.join(sys.path)},
    )
    assert (finished.returncode, finished.stderr) == (0, "done\n")
