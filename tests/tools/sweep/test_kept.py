"""Models that a sweep keeps: loaded by MuJoCo from the shards, and grouped for Isaac Lab."""

from __future__ import annotations

import json
import tarfile
from pathlib import Path
from typing import Any

import pytest

import yamaro
from tests.consumers.oracles import require_module
from yamaro.options import UsageError

ROBOT = """\
robot: crawler
base: free
arguments:
  length: {default: 0.2, range: [0.1, 0.3]}
  legs: {type: integer, default: 2, range: [1, 3]}
model:
- part:
    name: trunk
    link: {geometry: box.stl, scale: $(length) 1 1, mass: 2, inertial: {inertia: 1 0 0 1 0 1},
      visual: , collision: }
- for i in range(legs):
  - part:
      name: leg$(i)
      joint:
        type: revolute
        parent: trunk
        axis: y
        limit: {lower: -1, upper: 1, effort: 5, velocity: 3}
        actuator: {kp: 10, kd: 1}
      link: {geometry: sphere, radius: $(length / 5), mass: 0.1, visual: , collision: }
"""

# Pythons that lack the filter do not ask for one.
SAFELY: dict[str, Any] = {"filter": "data"} if hasattr(tarfile, "data_filter") else {}


@pytest.fixture
def swept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    trimesh = require_module("trimesh")
    monkeypatch.chdir(tmp_path)
    trimesh.creation.box((1, 1, 1)).export("box.stl")
    Path("robot.yaml").write_text(ROBOT)

    def run(samples: int, folder: str = "runs", **options: Any) -> yamaro.Sweep:
        wanted = {"vary": {"length": None}, "models": True, "engine": "local:1", **options}
        return yamaro.sweep("robot.yaml", folder, samples=samples, **wanted)

    return run


def test_mujoco_loads_the_models_from_the_shards(swept) -> None:
    mujoco = require_module("mujoco")
    sweep = swept(40, to="mjcf", chunk=15)
    lengths = sweep.columns("length")["length"]
    found = []
    for kept in sweep.models():
        model = mujoco.MjModel.from_xml_string(kept.text, kept.files)
        assert model.geom("leg0_collision").size[0] == pytest.approx(lengths[kept.index] / 5)
        found.append(kept.index)
    assert found == list(range(40))


def test_a_scene_holds_its_robot_and_meshes(swept) -> None:
    mujoco = require_module("mujoco")
    sweep = swept(3, to=["urdf", "mjcf"])
    kept = list(sweep.models("mjcf", has_scene=True))[2]
    assert sorted(name.partition("/")[0] for name in kept.files) == ["000000002.xml", "assets"]
    scene = mujoco.MjModel.from_xml_string(kept.text, kept.files)
    assert scene.nmesh == 1
    assert scene.geom("floor").pos[2] == 0


def test_extracted_shards_can_be_loaded_as_files(swept) -> None:
    mujoco = require_module("mujoco")
    swept(3, to="mjcf")
    for path in sorted(Path("runs/models").glob("*.tar")):
        with tarfile.open(path) as shard:
            shard.extractall("runs/models", **SAFELY)
    model = mujoco.MjModel.from_xml_path("runs/models/000000001.mjcf.scene.xml")
    assert model.nmesh == 1


def test_the_file_of_loops_is_called_like_the_urdf_beside_it(swept) -> None:
    limit = "limit: {lower: -1, upper: 1, effort: 1, velocity: 1}"
    Path("four.yaml").write_text(f"""\
robot: four
arguments: {{a: {{default: 0.3}}}}
model:
- part: {{name: base, link: {{geometry: box, size: .1 .1 .1, mass: 1}}}}
- part:
    name: left
    joint: {{type: revolute, parent: base, axis: y, {limit}}}
    link: {{geometry: sphere, radius: 0.1, mass: 1}}
- part:
    name: right
    joint: {{type: revolute, parent: base, xyz: $(a) 0 0, axis: y, {limit}}}
    link: {{geometry: sphere, radius: 0.1, mass: 1}}
- part: {{name: end, joint: {{type: fixed, parent: left, xyz: $(a) 0 0}}}}
- loop: {{name: closing, between: [end, right], type: revolute, axis: y}}
""")
    yamaro.sweep("four.yaml", "runs", vary={"a": [0.2, 0.4]}, samples=1, models=True)
    with tarfile.open("runs/models/shard-000000.tar") as shard:
        assert shard.getnames() == ["000000000.urdf", "000000000.loops.yaml"]


def test_a_sweep_without_models_says_so(swept) -> None:
    with pytest.raises(UsageError, match="has kept no models: run it with --models"):
        list(swept(2, models=False).models())
    with pytest.raises(UsageError, match="has kept urdf, and not what is asked for"):
        list(swept(2, "others").models("mjcf"))


def bodies_and_joints(path: Path) -> list[tuple[str, str, str]]:
    """Return what OpenUSD reads as rigid bodies and joints, in order, with their types."""
    usd = require_module("pxr.Usd")
    physics = require_module("pxr.UsdPhysics")
    stage = usd.Stage.Open(str(path))
    found = []
    for prim in stage.Traverse():
        if prim.HasAPI(physics.RigidBodyAPI):
            found.append((str(prim.GetPath()), "body", ""))
        if prim.IsA(physics.Joint):
            joint = physics.Joint(prim)
            ends = [joint.GetBody0Rel().GetTargets(), joint.GetBody1Rel().GetTargets()]
            found.append((str(prim.GetPath()), str(prim.GetTypeName()), str(ends)))
    return found


def test_usd_files_are_grouped_by_what_openusd_reads_of_their_topology(swept) -> None:
    require_module("pxr.Usd")
    axes = {"length": None, "legs": None}
    sweep = swept(12, to="usd", vary=axes, chunk=5)
    index = json.loads(Path("runs/models/index.json").read_text())
    assert index["format"] == "usd"
    groups = index["topologies"]
    assert sorted(each for group in groups for each in group["variants"]) == list(range(12))
    assert [len(group["files"]) for group in groups] == sorted(
        (len(group["files"]) for group in groups), reverse=True
    )
    for path in sorted(Path("runs/models").glob("*.tar")):
        with tarfile.open(path) as shard:
            shard.extractall("runs/models", **SAFELY)
    read = []
    for group in groups:
        contents = [bodies_and_joints(Path("runs/models", name)) for name in group["files"]]
        assert all(content == contents[0] for content in contents)
        read.append(contents[0])
    assert all(one != other for at, one in enumerate(read) for other in read[:at])
    columns = sweep.columns("legs", "topology")
    assert len(groups) == len(set(columns["legs"])) == len(set(columns["topology"])) == 3


def test_a_rejected_variant_is_in_no_group(swept) -> None:
    sweep = swept(6, to="usd", vary={"legs": [1, 2]}, keep="legs > 1")
    index = json.loads(Path("runs/models/index.json").read_text())
    kept = [i for i, status in enumerate(sweep.columns("status")["status"]) if status == "ok"]
    assert [group["variants"] for group in index["topologies"]] == [kept]
