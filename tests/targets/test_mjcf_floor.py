"""The floor of the scene beside an MJCF: robots stand on it, roll on it, and slide on it."""

from __future__ import annotations

from math import cos, radians, sin
from pathlib import Path
from typing import Any

import pytest

import yamaro
from tests.consumers.oracles import require_module
from tests.targets.standing import Standing

ROOT = Path(__file__).parents[2]


def scene_of(text: str | Path, folder: Path) -> Any:
    """Return MuJoCo's model of the scene around a robot."""
    mujoco = require_module("mujoco")
    path = text
    if isinstance(text, str):
        path = folder / "robot.yaml"
        path.write_text(text)
    build = yamaro.build(path, target="mjcf", on_message=lambda line: None)
    files = {**build.assets, f"{Path(path).stem}.xml": build.xml().encode()}
    for name, content in files.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_bytes(content)
    return mujoco.MjModel.from_xml_path(str(folder / "scene.xml"))


def gap(model: Any, data: Any) -> float:
    """Return the distance from the floor to the nearest shape that collides."""
    mujoco = require_module("mujoco")
    floor = model.geom("floor").id
    return min(
        mujoco.mj_geomDistance(model, data, floor, geom, 10.0, None)
        for geom in range(model.ngeom)
        if model.geom_contype[geom] and geom != floor
    )


LEG = """
- part:
    name: {0}_thigh
    joint: {{type: revolute, parent: base, xyz: {1} 0, axis: y,
      limit: {{lower: -90deg, upper: 90deg, effort: 40, velocity: 9}}, actuator: {{}}}}
    link: {{geometry: capsule, radius: 0.02, length: 0.2, pivot: 0 0 0.1, mass: 0.4, collision: }}
- part:
    name: {0}_shin
    joint: {{type: revolute, parent: {0}_thigh, xyz: 0 0 -0.2, axis: y,
      limit: {{lower: -150deg, upper: -20deg, effort: 40, velocity: 9}}, actuator: {{}}}}
    link: {{geometry: cylinder, radius: 0.015, length: 0.2, pivot: 0 0 0.1, mass: 0.2, collision: }}
"""
PLACES = {"fl": "0.2 0.1", "fr": "0.2 -0.1", "rl": "-0.2 0.1", "rr": "-0.2 -0.1"}


def bent(thigh: int, shin: int) -> str:
    return ", ".join(f"{leg}_thigh: {thigh}deg, {leg}_shin: {shin}deg" for leg in PLACES)


QUADRUPED = (
    "robot: quad\nbase: free\nmodel:\n"
    "- part: {name: base, link: {geometry: box, size: 0.4 0.2 0.1, mass: 5, collision: }}"
    + "".join(LEG.format(name, place) for name, place in PLACES.items())
    + f"states: {{stand: {{{bent(45, -90)}}}, low: {{{bent(70, -145)}}}}}\n"
)


def test_a_free_robot_stands_on_the_floor_in_each_state(tmp_path: Path) -> None:
    mujoco = require_module("mujoco")
    model = scene_of(QUADRUPED, tmp_path)
    assert model.geom("floor").pos.tolist() == [0, 0, 0]
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert gap(model, data) == pytest.approx(0, abs=1e-9)  # also without a keyframe
    assert [model.key(index).name for index in range(model.nkey)] == ["home", "stand", "low"]
    for index in range(model.nkey):
        mujoco.mj_resetDataKeyframe(model, data, index)
        mujoco.mj_forward(model, data)
        assert gap(model, data) == pytest.approx(0, abs=1e-9)
        while data.time < 2:
            mujoco.mj_step(model, data)
        assert data.qpos[2] == pytest.approx(model.key(index).qpos[2], abs=0.02)
        assert data.xmat[1][8] > 0.99
    height = 0.2 * cos(radians(45)) * 2 + 0.015 * sin(radians(45))
    assert model.key("stand").qpos[2] == pytest.approx(height)


@pytest.mark.parametrize("name", ["hexapod", "quadruped", "humanoid", "mobile_manipulator"])
def test_mobile_examples_stand_at_home(name: str, tmp_path: Path) -> None:
    standing = Standing(scene_of(ROOT / "examples" / name / f"{name}.yaml", tmp_path), 2.0)
    assert standing.is_finite
    assert standing.sank < 0.02
    assert standing.worst < 0.05


def test_a_robot_on_wheels_rolls(tmp_path: Path) -> None:
    mujoco = require_module("mujoco")
    model = scene_of(ROOT / "examples" / "diff_drive" / "diff_drive.yaml", tmp_path)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("home").id)
    data.ctrl[:] = 3.0
    while data.time < 2:
        mujoco.mj_step(model, data)
    radius = model.geom("left_wheel_collision").size[0]
    speed = data.qvel[model.joint("left_wheel_joint").dofadr[0]]
    assert speed == pytest.approx(3.0, rel=0.1)
    assert data.qvel[0] == pytest.approx(speed * radius, rel=0.02)
    assert data.qpos[2] == pytest.approx(model.key("home").qpos[2], abs=5e-3)


BOX = """\
robot: slider
base: free
model:
- part:
    name: body
    link: {{geometry: box, size: 0.2 0.2 0.1, mass: 3, collision: {{surface: {{friction: {}}}}}}}
"""


@pytest.mark.parametrize("friction", [0.2, 0.4, 1.3])
@pytest.mark.parametrize("slope", [10, 25, 35])
def test_a_box_slides_as_its_friction_says(friction: float, slope: int, tmp_path: Path) -> None:
    mujoco = require_module("mujoco")
    model = scene_of(BOX.format(friction), tmp_path)
    data = mujoco.MjData(model)
    angle = radians(slope)
    model.opt.gravity[:] = [9.81 * sin(angle), 0, -9.81 * cos(angle)]
    while data.time < 1:
        mujoco.mj_step(model, data)
    by_hand = max(0.0, 9.81 * (sin(angle) - friction * cos(angle)))
    assert data.qvel[0] == pytest.approx(by_hand, abs=0.05)


def test_contacts_with_the_floor_are_as_soft_as_the_robot_says(tmp_path: Path) -> None:
    mujoco = require_module("mujoco")
    text = BOX.format("1, restitution: 0.5")
    model = scene_of(text, tmp_path)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    data.qpos[2] -= 1e-3
    mujoco.mj_forward(model, data)
    body = model.geom("body_collision").solref
    assert data.contact[0].solref == pytest.approx(body)
    assert body[1] < 1


ARM = """\
robot: arm
base: fixed
model:
- part: {{name: base, link: {{geometry: box, size: 0.2 0.2 0.2, mass: 5, collision: }}}}
- part:
    name: boom
    joint: {{type: revolute, parent: base, axis: y, limit: {{lower: -3.2, upper: 3.2, effort: 9,
      velocity: 1}}}}
    link: {{geometry: box, size: 0.05 0.05 0.6, pivot: 0 0 -0.3, mass: 1, collision: }}
states: {{home: {{boom: {}}}, up: {{boom: 0}}}}
"""


@pytest.mark.parametrize(("home", "floor"), [("0deg", 0.0), ("180deg", -0.6)])
def test_a_fixed_robot_is_at_its_own_place(home: str, floor: float, tmp_path: Path) -> None:
    model = scene_of(ARM.format(home), tmp_path)
    assert model.body("base_link").pos.tolist() == [0, 0, 0]
    assert model.geom("floor").pos[2] == pytest.approx(floor, abs=1e-9)


def test_what_floats_in_the_world_is_not_in_the_floor(tmp_path: Path) -> None:
    text = """\
robot: balls
model:
- link/name=world:
- for name, z in [('low', 0.1), ('high', 2)]:
  - part:
      name: $(name)
      joint: {type: floating, parent: world, xyz: 0 0 $(z)}
      link: {geometry: sphere, radius: 0.3, mass: 1, collision: }
"""
    model = scene_of(text, tmp_path)
    assert model.geom("floor").pos[2] == 0
    assert model.key("home").qpos[[2, 9]] == pytest.approx([0.3, 2])
