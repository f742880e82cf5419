"""Runs of sweeps on this machine: the table, going on after a stop, one variant again."""

from __future__ import annotations

import hashlib
import io
import os
import signal
import subprocess
import sys
import tarfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import yamaro
from tests.consumers.oracles import require_module
from tests.waiting import PATIENCE, wait_for
from yamaro.options import UsageError
from yamaro.tools.sweep import table

LEG = """\
robot: leg
arguments:
  thigh: {default: 0.3, unit: m, range: [0.1, 0.5]}
  legs: {type: integer, range: [2, 8], default: 4}
  tag: {type: text, default: x}
variables: {fault: $(1 / (legs - 3) if tag == 'fail' else 0)}
model:
- part:
    name: base
    link: {geometry: box, scale: $(thigh) 0.1 0.1, mass: $(legs + 1), visual: , collision: }
"""
AXES: dict[str, Any] = {"thigh": [0.2, 0.4], "legs": None}


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("leg.yaml").write_text(LEG)


def swept(folder: str = "runs", **options: Any) -> yamaro.Sweep:
    wanted = {"vary": AXES, "samples": 10, "chunk": 4, "engine": "local:1", **options}
    return yamaro.sweep("leg.yaml", folder, **wanted)


def files(folder: str, inner: str = "table") -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(Path(folder, inner).iterdir())}


def test_the_table_has_a_row_for_each_variant_and_a_file_for_each_chunk() -> None:
    columns = swept().columns()
    assert list(files("runs")) == [f"part-{number:06d}.parquet" for number in range(3)]
    assert columns["id"] == list(range(10))
    assert columns["status"] == ["ok"] * 10
    assert all(0.2 <= value <= 0.4 for value in columns["thigh"])
    assert set(columns["legs"]) <= set(range(2, 9))
    for index in range(10):
        arguments = {name: columns[name][index] for name in ("thigh", "legs")}
        document = yamaro.convert("leg.yaml", **arguments)
        assert columns["sha256_urdf"][index] == hashlib.sha256(document.encode()).hexdigest()


def test_types_of_columns_are_those_of_the_arguments() -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    vary = {**AXES, "tag": {"choices": ["a", "b"]}}
    swept(vary=vary, metrics=["mass"])
    types = {
        each.name: str(each.type) for each in parquet.read_schema("runs/table/part-000000.parquet")
    }
    assert (types["id"], types["thigh"], types["legs"], types["tag"]) == (
        "int64", "double", "int64", "string"
    )  # fmt: skip
    assert types["mass"] == "double"


def test_the_same_study_gives_the_same_bytes_with_more_workers() -> None:
    swept("one")
    swept("four", engine="local:4")
    assert files("one") == files("four")


def test_csv_says_what_parquet_does(monkeypatch: pytest.MonkeyPatch) -> None:
    in_parquet = swept("parquet", metrics=["mass"]).columns()
    monkeypatch.setattr("yamaro.tools.sweep.api.has_parquet", lambda: False)
    in_csv = swept("csv", metrics=["mass"]).columns()
    assert list(files("csv")) == [f"part-{number:06d}.csv" for number in range(3)]
    assert in_csv == in_parquet


def test_rejected_variants_are_in_the_table() -> None:
    sweep = swept(
        vary={"thigh": "0.2..0.4/3", "legs": None}, samples=None, keep="legs * thigh < 1.5"
    )
    columns = sweep.columns()
    products = [thigh * legs for thigh, legs in zip(columns["thigh"], columns["legs"], strict=True)]
    assert columns["status"] == ["ok" if each < 1.5 else "rejected" for each in products]
    assert sweep.summary().counts["rejected"] == sum(each >= 1.5 for each in products)


def test_failures_are_grouped_by_code_and_place() -> None:
    sweep = swept(samples=None, vary={"legs": None}, fixed={"tag": "fail"})
    assert sweep.columns("code", "place")["code"] == ["", "python-error", "", "", "", "", ""]
    (group,) = sweep.summary().groups
    assert (group.code, group.place, group.count, group.first) == (
        "python-error", "leg.yaml:6:22", 1, 1
    )  # fmt: skip
    assert "zero" in "\n".join(sweep.summary().lines())


def test_a_variant_is_built_again_byte_for_byte() -> None:
    sweep = swept(to=["mjcf", "urdf"])
    shown = sweep.variant(7)
    for format, build in shown.build.outputs.items():
        digest = hashlib.sha256(build.xml().encode()).hexdigest()
        assert digest == sweep.columns(f"sha256_{format}")[f"sha256_{format}"][7]
    assert shown.arguments["thigh"] == sweep.columns("thigh")["thigh"][7]
    assert shown.changed == []
    Path("leg.yaml").write_text(LEG + "# changed\n")
    assert sweep.variant(7).changed == [str(Path("leg.yaml").absolute())]
    with pytest.raises(UsageError, match="from 0 to 9"):
        sweep.variant(10)


# --- folders ---


def test_a_folder_that_holds_a_sweep_is_not_overwritten() -> None:
    swept()
    before = files("runs")
    with pytest.raises(UsageError, match="--resume"):
        swept(seed=1)
    assert files("runs") == before


def test_a_folder_that_holds_something_else_is_left_alone() -> None:
    Path("runs").mkdir()
    Path("runs/thesis.tex").write_text("x")
    with pytest.raises(UsageError, match="not empty"):
        swept(resume=True)
    assert os.listdir("runs") == ["thesis.tex"]
    with pytest.raises(UsageError, match="is a file"):
        swept("leg.yaml")


def test_a_folder_is_for_one_sweep_at_a_time() -> None:
    fcntl = pytest.importorskip("fcntl")
    swept()
    with open("runs/.lock") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        with pytest.raises(UsageError, match="another sweep"):
            swept(resume=True)


@pytest.mark.parametrize(
    ("options", "note"),
    [
        ({"seed": 1}, "seed was 0, and is 1 now"),
        ({"samples": 12}, "samples was 10, and is 12 now"),
        ({"vary": {**AXES, "thigh": [0.2, 0.3]}}, "axes.thigh.high was 0.4, and is 0.3 now"),
        ({"to": "mjcf"}, 'formats was [], and is ["mjcf"] now'),
        ({"keep": "legs > 2"}, 'keep was [], and is ["legs > 2"] now'),
        ({"policy": yamaro.Policy("safe")}, 'trust was "trusted", and is "safe" now'),
    ],
)
def test_another_study_does_not_go_on_and_says_what_differs(
    options: dict[str, Any], note: str
) -> None:
    swept()
    with pytest.raises(yamaro.YamaroError) as caught:
        swept(resume=True, **options)
    (error,) = caught.value.diagnostics
    assert error.code == "sweep-differs"
    assert note in error.notes


def test_other_files_and_versions_do_not_go_on(monkeypatch: pytest.MonkeyPatch) -> None:
    swept()
    Path("leg.yaml").write_text(LEG + "# changed\n")
    monkeypatch.setattr("yamaro.__version__", "9.9")
    with pytest.raises(yamaro.YamaroError) as caught:
        swept(resume=True)
    notes = "\n".join(caught.value.diagnostics[0].notes)
    assert "leg.yaml' has changed" in notes
    assert 'versions.yamaro was "' in notes


def test_missing_chunks_are_built_and_others_are_left(monkeypatch: pytest.MonkeyPatch) -> None:
    swept()
    whole = files("runs")
    first, middle, _ = (Path("runs/table", name) for name in whole)
    middle.unlink()
    Path("runs/table/.yamaro-00.tmp").write_text("cut off")
    kept = first.stat().st_mtime_ns
    swept(resume=True, chunk=None)
    assert files("runs") == whole
    assert first.stat().st_mtime_ns == kept


def test_a_file_that_changes_while_the_sweep_runs_stops_it() -> None:
    Path("leg.yaml").write_text(
        LEG + "- process: |\n    import os\n    if legs == 5:\n"
        "        open('leg.yaml', 'a').write('# more')\n        os._exit(1)\n"
    )
    with pytest.raises(yamaro.YamaroError, match="sweep-differs"):
        swept(samples=None, vary={"legs": None}, chunk=1)


# --- killed ---

RUN = """
import sys, yamaro
yamaro.sweep("leg.yaml", sys.argv[1], vary={"thigh": None}, fixed={"tag": "slow"}, samples=40,
             chunk=5, engine="local:2", resume=True)
"""


@pytest.fixture
def started() -> Iterator[Any]:
    processes: list[subprocess.Popen[bytes]] = []

    def start(folder: str) -> subprocess.Popen[bytes]:
        processes.append(subprocess.Popen([sys.executable, "-c", RUN, folder]))
        return processes[-1]

    yield start
    for process in processes:
        process.kill()
        process.wait()


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")
def test_a_killed_sweep_goes_on_and_its_table_is_that_of_an_undisturbed_one(started: Any) -> None:
    Path("leg.yaml").write_text(LEG + "- process: |\n    import time\n    time.sleep(0.02)\n")
    assert started("whole").wait(PATIENCE) == 0
    process = started("runs")
    parts = Path("runs/table")
    wait_for(lambda: len(list(parts.glob("part-*"))) >= 2)
    children = Path(f"/proc/{process.pid}/task").glob("*/children")
    workers = [int(pid) for path in children for pid in path.read_text().split()]
    os.kill(workers[0], signal.SIGKILL)
    wait_for(lambda: len(list(parts.glob("part-*"))) >= 4)
    process.kill()
    process.wait()
    wait_for(lambda: not any(Path(f"/proc/{pid}").exists() for pid in workers))
    done = {path: path.stat().st_mtime_ns for path in parts.glob("part-*")}
    assert started("runs").wait(PATIENCE) == 0
    assert files("runs") == files("whole")
    assert all(path.stat().st_mtime_ns == time for path, time in done.items())


# --- models ---


def test_models_are_in_shards_and_the_table_says_where() -> None:
    mujoco = require_module("mujoco")
    sweep = swept(to=["mjcf", "urdf"], models=True)
    columns = sweep.columns()
    assert sorted(path.name for path in Path("runs/models").iterdir()) == [
        f"shard-{number:06d}.tar" for number in range(3)
    ]
    for index in range(10):
        shard = Path(f"runs/models/shard-{index // 4:06d}.tar").read_bytes()
        for format, end in (("mjcf", "xml"), ("urdf", "urdf")):
            start = columns[f"offset_{end}"][index]
            data = shard[start : start + columns[f"size_{end}"][index]]
            assert hashlib.sha256(data).hexdigest() == columns[f"sha256_{format}"][index]
            with tarfile.open(fileobj=io.BytesIO(shard)) as tar:
                member = tar.extractfile(f"{index:09d}.{end}")
                assert member is not None
                assert member.read() == data
            if format == "mjcf":
                model = mujoco.MjModel.from_xml_string(data.decode())
                assert model.body_mass.sum() == pytest.approx(columns["legs"][index] + 1)


@pytest.mark.slow
def test_the_meshes_of_models_are_there_once() -> None:
    trimesh = require_module("trimesh")
    mujoco = require_module("mujoco")
    trimesh.creation.box((1, 2, 3)).export("shell.stl")
    Path("leg.yaml").write_text(
        LEG + "    # a mesh besides\n"
        "- part:\n"
        "    name: shell\n"
        "    joint: {type: fixed, parent: base, xyz: 0 0 $(thigh)}\n"
        "    link: {geometry: shell.stl, mass: 1, visual: , collision: }\n"
    )
    columns = swept(to="mjcf", models=True).columns()
    (asset,) = Path("runs/models/assets").iterdir()
    shard = Path("runs/models/shard-000000.tar").read_bytes()
    start = columns["offset_xml"][2]
    Path("runs/models/variant.xml").write_bytes(shard[start : start + columns["size_xml"][2]])
    model = mujoco.MjModel.from_xml_path("runs/models/variant.xml")
    assert model.nmesh == 1
    assert asset.stat().st_size == Path("shell.stl").stat().st_size


# --- reading ---


def test_columns_that_a_chunk_does_not_have_are_none() -> None:
    swept(samples=None, vary={"legs": None}, fixed={"tag": "fail"}, metrics=["mass"], chunk=1)
    masses = yamaro.Sweep("runs").columns("mass")["mass"]
    assert masses == [3.0, None, 5.0, 6.0, 7.0, 8.0, 9.0]


def test_arguments_and_metrics_named_like_other_columns_get_another_name() -> None:
    columns = table.Columns({"id": "integer", "status": "text", "mass": "number"}, ["urdf"])
    assert columns.names == {"id": "id_argument", "status": "status_argument", "mass": "mass"}


def test_the_summary_counts_variants_without_a_value_of_a_result() -> None:
    Path("odd.py").write_text(
        "def score(index):\n    return {'a': 1, 'b': 2} if index % 2 else {'a': 1}\n"
    )
    sweep = swept(evaluate="odd.py:score")
    assert sweep.columns("b")["b"] == [None, 2.0] * 5
    assert sweep.summary().lacking == {"b": 5}
    assert sweep.summary().lines()[-1] == "  5 ok without a value of 'b'"
