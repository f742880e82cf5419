"""Batches of variants, against MuJoCo's model of each variant by itself."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import yamaro
from tests.consumers.oracles import require_module
from yamaro.commands.main import main

ROBOT = """\
robot: crawler
base: free
arguments:
  length: {default: 200 mm, unit: mm, range: [100, 300]}
  load: {default: 2 kg, unit: kg, range: [1, 3]}
  gain: {default: 10, range: [5, 50]}
  legs: {type: integer, default: 2, range: [1, 3]}
  shape: {default: box, choices: [box, sphere]}
model:
- part:
    name: trunk
    link:
    - {geometry: sphere, radius: 0.1, mass: $(load)}
    - inertial: {xyz: 0 0.01 0.02, inertia: 1 0.1 0.2 1 0.1 1}
- for i in range(legs):
  - part:
      name: leg$(i)
      joint:
        type: revolute
        parent: trunk
        axis: y
        xyz: $(length * (i + 1)) 0 0
        rpy: 0 0 $(length)
        limit: {lower: -1, upper: $(length), effort: 5, velocity: 3}
        dynamics: {damping: $(gain / 100)}
        actuator: {kp: $(gain), kd: 1, armature: 0.01}
      link:
      - if shape == 'box':
        - {geometry: box, size: 0.1 0.1 $(length)}
        else:
        - {geometry: sphere, radius: 0.1}
      - {mass: 0.1, visual: , collision: }
"""


@pytest.fixture(autouse=True)
def robot(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    require_module("mujoco")
    monkeypatch.chdir(tmp_path)
    Path("robot.yaml").write_text(ROBOT)


def fields_of(model: Any) -> dict[str, Any]:
    parts = {"": model, "stat.": model.stat, "opt.": model.opt}
    return {
        f"{prefix}{name}": np.array(getattr(part, name))
        for prefix, part in parts.items()
        for name in dir(part)
        if name[0] != "_" and isinstance(getattr(part, name), (float, np.ndarray))
    }


def test_the_arrays_are_those_of_each_variant_compiled_by_itself() -> None:
    mujoco = require_module("mujoco")
    words = ["robot.yaml", "length=100..300", "load=1..3", "gain=log:5..50", "legs:=3"]
    options = ["--samples", "40", "--keep", "load < 2.5", "--engine", "local:2"]
    assert main(["sweep", *words, *options, "--batch", "out/legs.npz"]) == 0
    batch = np.load("out/legs.npz")
    assert 0 < len(batch["id"]) < 40  # some have too much load
    own = fields_of(mujoco.MjModel.from_xml_path("out/legs.xml"))
    assert {"body_mass", "body_inertia", "jnt_range", "actuator_gainprm"} <= set(batch.files)
    for row in range(len(batch["id"])):
        given = {
            name: float(batch[f"arguments/{name}"][row]) for name in ("length", "load", "gain")
        }
        build = yamaro.build("robot.yaml", target="mjcf", variables={**given, "legs": 3})
        model = mujoco.MjModel.from_xml_string(build.xml(), dict(build.assets))
        for name, expected in fields_of(model).items():
            found = batch[name][row] if name in batch.files else own[name]
            np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12, err_msg=name)


@pytest.mark.parametrize("axis", ["shift=0,0.1,0.2", "shift=0.1,0,-0.1", "size=0.02..0.5"])
def test_where_shapes_are_is_not_the_model_itself(axis: str) -> None:
    """At an offset of 0, MuJoCo takes shortcuts; and shapes in other places make other trees."""
    mujoco = require_module("mujoco")
    box = "{geometry: box, size: 0.1 0.1 0.1"
    Path("robot.yaml").write_text(
        "robot: boxes\narguments: {shift: {default: 0.1}, size: {default: 0.1}}\nmodel:\n"
        f"- part: {{name: a, link: {{geometry: sphere, radius: 1, mass: 1}}}}\n"
        "- part:\n    name: b\n    joint: {type: continuous, parent: a, axis: z}\n    link:\n"
        f"    - {box}, mass: 1, pivot: $(shift) 0 0, visual: , collision: }}\n"
        f"    - visual: {box}, xyz: $(shift) 0.2 0}}\n"
        f"    - collision: {box}, xyz: 0 $(size) 0}}\n"
        f"    - collision: {{geometry: sphere, radius: $(size), xyz: 0.1 $(shift) 0}}\n"
    )
    name, _, values = axis.partition("=")
    samples = ["--samples", "30"] if ".." in values else []
    assert (
        main(["sweep", "robot.yaml", axis, *samples, "--engine", "local:1", "--batch", "b.npz"])
        == 0
    )
    batch = np.load("b.npz")
    for row in range(0, len(batch["id"]), 4 if samples else 1):
        given = {name: float(batch[f"arguments/{name}"][row])}
        alone = mujoco.MjModel.from_xml_string(
            yamaro.build("robot.yaml", target="mjcf", variables=given).xml()
        )
        found = mujoco.MjModel.from_xml_path("b.xml")
        for each in set(batch.files) & set(dir(found)):
            getattr(found, each)[:] = batch[each][row]
        for each in ("geom_pos", "geom_size", "geom_aabb", "body_inertia", "dof_M0"):
            np.testing.assert_allclose(getattr(found, each), getattr(alone, each), atol=1e-12)
        boxes = found.bvh_aabb.copy()
        mujoco.mj_setConst(found, mujoco.MjData(found))  # which fits the boxes of the same tree
        np.testing.assert_allclose(found.bvh_aabb, boxes, atol=1e-12)


@pytest.mark.parametrize(
    ("axis", "field", "line"), [("legs=2,3", "names", 7), ("shape=box,sphere", "geom_type", 8)]
)
def test_an_argument_that_changes_the_model_itself_is_refused_at_its_line(
    axis: str, field: str, line: int, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["robot.yaml", "gain=5..50", axis, "--samples", "6", "--engine", "local:1"]
    assert main(["sweep", *words, "--batch", "legs.npz"]) == 1
    name = axis.partition("=")[0]
    message = capsys.readouterr().err
    assert f"error[sweep-batch]: the argument '{name}' changes the model itself" in message
    assert f"'{field}'" in message
    assert f"robot.yaml:{line}:3" in message
    assert not Path("legs.npz").exists()


def test_links_that_overlap_in_some_variants_are_what_the_error_names(
    capsys: pytest.CaptureFixture[str],
) -> None:
    shape = "visual: , collision: "
    legs = "".join(
        f"- part:\n    name: {name}\n"
        f"    joint: {{type: continuous, parent: a, axis: y, xyz: 0 {side}$(away) 0}}\n"
        f"    link: {{geometry: sphere, radius: 0.1, mass: 1, {shape}}}\n"
        for name, side in (("b", ""), ("c", "-"))
    )
    Path("near.yaml").write_text(
        "robot: near\nbase: fixed\narguments:\n  away: {default: 0.2, range: [0.05, 0.3]}\n"
        "model:\n- part: {name: a, link: {geometry: sphere, radius: 0.01, mass: 1, "
        f"{shape}}}}}\n{legs}"
    )
    words = ["near.yaml", "away=0.2,0.05", "--engine", "local:1", "--batch", "b.npz"]
    assert main(["sweep", *words]) == 1
    message = capsys.readouterr().err
    assert "near.yaml:4:3" in message
    assert "other links overlap at home, and those have no contact (0.2 and 0.05)" in message


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--batch", "legs.npy"], "name the file as in batch.npz"),
        (["--batch", "legs.npz", "-o", "runs"], "'--batch' and '--output' do not go together"),
        (["--batch", "legs.npz", "--engine", "dask://a:1"], "a batch is built on this machine"),
    ],
)
def test_a_batch_is_one_file_of_this_machine(
    options: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["sweep", "robot.yaml", "gain=5..50", "--samples", "2", *options]) != 0
    assert message in capsys.readouterr().err
