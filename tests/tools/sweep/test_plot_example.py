"""The example that plots a sweep: examples/quadruped/study/plot.py."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

import yamaro
from tests.consumers.oracles import require_module

PLOT = Path(__file__).parents[3] / "examples/quadruped/study/plot.py"


@pytest.mark.slow
def test_the_example_draws_the_table_of_a_sweep(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    require_module("matplotlib")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    Path("leg.yaml").write_text("arguments: {leg_length: 1}\nmodel:\n- part: {name: a}\n")
    Path("walk.py").write_text(
        "def score(arguments):\n"
        "    leg_length = arguments['leg_length']\n"
        "    rest = dict(thigh_length=1, calf_length=1, work=1, heat=2, frequency=3)\n"
        "    return rest | ({'cost_of_transport': 1 / leg_length} if leg_length > 1 else {})\n"
    )
    yamaro.sweep("leg.yaml", "runs", vary={"leg_length": {"choices": [1, 2, 3]}}, method="grid",
                 evaluate="walk.py:score", engine="local:1")  # fmt: skip
    runpy.run_path(str(PLOT))["main"]("runs", "legs.png")
    assert Path("legs.png").read_bytes()[:4] == b"\x89PNG"
