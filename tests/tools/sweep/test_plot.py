"""`yamaro sweep plot`: which columns, rows and variants are drawn, and what comes out."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.consumers.oracles import require_module
from yamaro.commands.main import main
from yamaro.options import UsageError
from yamaro.tools.sweep.plot import MOST_POINTS, Plotted

HEAD = "id,length,foot,status,code,place,message,mass,speed,steady,constant,sha256_urdf\n"
STUDY = {
    "form": 1, "axes": {"length": {"is_log": True}, "foot": {}}, "units": {"length": "m"},
}  # fmt: skip


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """Return the folder of a sweep with 60 variants, some without a value."""
    monkeypatch.chdir(tmp_path)
    Path("runs/table").mkdir(parents=True)
    Path("runs/study.json").write_text(json.dumps(STUDY))
    rows = []
    for index in range(60):
        foot = "ball" if index % 2 else "flat"
        status = {5: "rejected", 7: "failed"}.get(index % 10, "ok")
        length = 0.1 * 1.05**index
        speed = "" if index % 10 == 3 else f"{(index - 30) ** 2 / 900}"
        values = f"{2 * length},{speed},{'true' if index > 30 else 'false'},3"
        if status != "ok":
            values = ",,,"
        code = "bad-size" if status == "failed" else ""
        rows.append(f"{index},{length},{foot},{status},{code},,,{values},abc\n")
    Path("runs/table/part-000000.csv").write_text(HEAD + "".join(rows))
    return "runs"


def test_arguments_are_across_and_results_that_vary_are_up(folder) -> None:
    plotted = Plotted(folder)
    assert [column.label for column in plotted.across] == ["length (m)", "foot"]
    assert [column.name for column in plotted.up] == ["mass", "speed", "steady"]
    assert plotted.across[0].is_log
    assert plotted.across[1].categories == ["ball", "flat"]
    assert plotted.up[2].categories == ["no", "yes"]
    assert plotted.remarks == ["'constant' is 3 for all, and is not shown"]
    assert plotted.counts == {"ok": 48, "rejected": 6, "failed": 6}


def test_the_best_the_median_and_the_worst_are_those_of_the_order(folder) -> None:
    by_most = Plotted(folder, metric="speed").ranked
    by_least = Plotted(folder, metric="speed", minimize=True).ranked
    speeds = {row: (row - 30) ** 2 for row in range(60) if row % 10 not in (3, 5, 7)}
    assert speeds[by_most["best"]] == max(speeds.values()) == speeds[by_least["worst"]]
    assert speeds[by_least["best"]] == min(speeds.values()) == speeds[by_most["worst"]]
    below = sum(speed < speeds[by_least["median"]] for speed in speeds.values())
    above = sum(speed > speeds[by_least["median"]] for speed in speeds.values())
    assert max(below, above) <= len(speeds) / 2


def test_columns_can_be_chosen(folder) -> None:
    plotted = Plotted(folder, across=["mass"], up=["speed", "constant"])
    assert [column.name for column in (*plotted.across, *plotted.up)] == [
        "mass", "speed", "constant"
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"up": ["sped"]}, "the table has no column 'sped'; did you mean 'speed'?"),
        ({"metric": "foot"}, "'foot' is not a number, so no variant is the best"),
    ],
)
def test_a_column_that_cannot_be_used_is_told(folder, options: Any, message) -> None:
    with pytest.raises(UsageError) as caught:
        Plotted(folder, **options)
    assert message in str(caught.value)


def test_a_sweep_without_results_says_how_to_get_some(folder) -> None:
    Path("runs/table/part-000000.csv").write_text(
        "id,length,status,code,place,message,sha256_urdf\n0,0.1,ok,,,,abc\n"
    )
    with pytest.raises(UsageError, match="has no results: run it with --metrics or --evaluate"):
        Plotted(folder)


def test_of_very_many_rows_some_are_drawn(folder) -> None:
    count = 2 * MOST_POINTS + 1
    rows = "".join(f"{index},0.1,ok,,,,{index}\n" for index in range(count))
    Path("runs/table/part-000000.csv").write_text(
        "id,length,status,code,place,message,mass\n" + rows
    )
    plotted = Plotted(folder)
    assert plotted.total == count
    assert plotted.rows == list(range(0, count, 3))


@pytest.mark.parametrize("ending", ["png", "svg", "pdf"])
def test_the_picture_is_of_the_kind_that_its_name_says(folder, ending) -> None:
    require_module("matplotlib")
    assert main(["sweep", "plot", folder, "-o", f"plot.{ending}", "-q"]) == 0
    data = Path(f"plot.{ending}").read_bytes()
    assert data.startswith({"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}[ending])
    assert main(["sweep", "plot", folder, "-o", f"again.{ending}", "-q"]) == 0
    assert Path(f"again.{ending}").read_bytes() == data


def test_the_labels_and_the_counts_are_in_the_picture(folder) -> None:
    require_module("matplotlib")
    assert main(["sweep", "plot", folder, "-o", "plot.svg", "--y", "speed"]) == 0
    text = Path("plot.svg").read_text()
    for label in ("60 variants", "length (m)", "foot", "ball", "speed", "48 ok", "6 failed",
                  "6 rejected", "6 no value"):  # fmt: skip
        assert f"<!-- {label} -->" in text


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["runs"], "needs an output file: -o plot.png"),
        (["-o", "plot.png"], "needs the folder of a sweep"),
        (["runs", "-o", "plot.doc"], "names no kind of plot: .png, .svg, .pdf"),
        (["runs", "-o", "plot.png", "--minimize"], "by a '--metric'"),
        (["other", "-o", "plot.png"], "the folder 'other' holds no sweep"),
    ],
)
def test_wrong_usage_is_explained(folder, words, message, capsys) -> None:
    assert main(["sweep", "plot", *words]) == 2
    assert message in capsys.readouterr().err
    assert not Path("plot.png").exists()
