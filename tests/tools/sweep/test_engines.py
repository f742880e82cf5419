"""Engines: which words name one, what happens when one loses work, and a cluster of dask."""

from __future__ import annotations

from concurrent.futures import Executor, Future
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import Any

import pytest

import yamaro
from yamaro.options import Options, UsageError
from yamaro.tools.sweep import running as engines
from yamaro.tools.sweep.api import run_sweep
from yamaro.tools.sweep.plan import Plan
from yamaro.tools.sweep.running import Engine, engine_of
from yamaro.tools.sweep.study import Study, planned

ROBOT = """\
robot: box
arguments:
  n: {type: integer, range: [0, 9], default: 0}
model:
- part: {name: base, link: {geometry: box, scale: 1 1 1, mass: $(1 / (n - 3) + 1)}}
"""


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("robot.yaml").write_text(ROBOT)


def plan() -> Plan:
    made = planned(Study("robot.yaml"), Options(), axes={})
    made.chunk = 3
    return made


def files(folder: str) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(Path(folder, "table").iterdir())}


class Losing(Executor):
    """Calls functions at once, and loses the first results."""

    def __init__(self, lost: int) -> None:
        self.lost = lost
        self.calls = 0

    def submit(self, function: Any, /, *arguments: Any, **named: Any) -> Future[Any]:
        future: Future[Any] = Future()
        self.calls += 1
        if self.calls <= self.lost:
            future.set_exception(BrokenProcessPool("a worker was killed"))
        else:
            future.set_result(function(*arguments, **named))
        return future


def run_with(executor: Executor, folder: str = "runs") -> None:
    run_sweep(
        plan(), folder, lambda: Engine(executor, 1, "losing"), resumes=False,
        on_progress=lambda status: None,
    )  # fmt: skip


def test_chunks_whose_workers_are_lost_are_given_again() -> None:
    yamaro.sweep("robot.yaml", "whole", chunk=3, engine="local:1")
    executor = Losing(5)
    run_with(executor)
    assert executor.calls == 5 + 4
    assert files("runs") == files("whole")


def test_an_engine_that_loses_all_is_given_up() -> None:
    with pytest.raises(
        yamaro.YamaroError, match=r"losing.*loses its workers: BrokenProcessPool"
    ) as e:
        run_with(Losing(1000))
    assert e.value.diagnostics[0].code == "sweep-engine"
    assert "--resume" in str(e.value)


def test_workers_with_other_versions_are_refused() -> None:
    made = plan()
    made.versions = {**made.versions, "yamaro": "9.9"}
    with pytest.raises(yamaro.YamaroError, match=r"yamaro .* instead of 9\.9") as caught:
        run_sweep(
            made, "runs", engine_of("local:1"), resumes=False,
            on_progress=lambda status: None,
        )  # fmt: skip
    assert caught.value.diagnostics[0].code == "sweep-engine"
    assert not Path("runs/table").exists()


@pytest.mark.parametrize(
    "word", ["spark", "local:0", "local:x", "local://host:1", "dask:x", "ray:2", "dask:-1"]
)
def test_words_that_name_no_engine_are_wrong_usage(word: str) -> None:
    with pytest.raises(UsageError):
        engine_of(word)


def test_an_extra_that_is_missing_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(yamaro.YamaroError, match=r"pip install 'yamaro\[dask\]'"):
        engine_of("dask:2")()


def test_a_cluster_that_is_not_there_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr(engines, "CONNECTING_SECONDS", 0.2)
    with pytest.raises(yamaro.YamaroError, match="cannot be reached"):
        engine_of("dask://127.0.0.1:1")()


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_a_cluster_of_dask_gives_the_same_bytes() -> None:
    pytest.importorskip("distributed")
    yamaro.sweep("robot.yaml", "local", chunk=3, engine="local:4")
    yamaro.sweep("robot.yaml", "dask", chunk=3, engine="dask:2")
    assert files("dask") == files("local")
    assert yamaro.Sweep("dask").summary().counts == {"ok": 9, "rejected": 0, "failed": 1}
