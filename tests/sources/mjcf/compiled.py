"""What MuJoCo makes of an MJCF file, compared with the robot that is read from it."""

from __future__ import annotations

import random
from pathlib import Path

import numpy as np

import yamaro

EXACT = 1e-9


def robot_of(path: Path, **options):
    """Return the robot of an MJCF file."""
    build = yamaro.build(str(path), allow=["lost-in-urdf"], on_message=lambda line: None, **options)
    assert build.robot is not None
    return build.robot


def assert_same(path: Path, *, tolerance: float = EXACT, poses: int = 5) -> None:
    """Assert that a robot has the masses and the kinematics of the model that MuJoCo compiles."""
    import mujoco

    model = mujoco.MjModel.from_xml_path(str(path))
    robot = robot_of(path)
    named = {model.body(i).name: i for i in range(1, model.nbody) if model.body(i).name}
    for name, i in named.items():
        link = robot.links[name]
        assert link.mass == close(model.body_mass[i], tolerance), name
        if link.inertial is None:
            continue
        turn = np.array(link.inertial.pose.rotation)
        ours = turn @ np.array(link.inertial.matrix()) @ turn.T
        nine = np.zeros(9)
        mujoco.mju_quat2Mat(nine, model.body_iquat[i])
        frame = nine.reshape(3, 3)
        theirs = frame @ np.diag(model.body_inertia[i]) @ frame.T
        scale = max(np.abs(theirs).max(), 1e-12)
        assert np.abs(ours - theirs).max() <= max(tolerance, 1e-9) * scale * 10, name
        center = np.array(link.inertial.pose.position)
        assert np.abs(center - model.body_ipos[i]).max() <= tolerance, name
    generator = random.Random(1)
    data = mujoco.MjData(model)
    for _ in range(poses):
        given = {}
        for j in range(model.njnt):
            name, address = model.joint(j).name, model.jnt_qposadr[j]
            if name and model.jnt_type[j] in (2, 3):
                data.qpos[address] = given[name] = generator.uniform(-1, 1)
        for joint in robot.joints.values():
            if joint.mimic is not None and given.pop(joint.name, None) is not None:
                value = joint.mimic.multiplier * given[joint.mimic.joint] + joint.mimic.offset
                data.joint(joint.name).qpos[0] = value
        mujoco.mj_kinematics(model, data)
        found = robot.poses(given)
        base = robot.roots[0].name
        origin = pose_in(data.body(base)) if base in named else np.eye(4)
        for name in named:
            ours = origin @ np.array(found[name].matrix())
            assert np.abs(ours - pose_in(data.body(name))).max() <= tolerance, name
        for s in range(model.nsite):
            name = model.site(s).name
            if name in found and name not in named:
                ours = origin @ np.array(found[name].matrix())
                assert np.abs(ours - pose_in(data.site(name))).max() <= tolerance, name


def pose_in(thing) -> np.ndarray:
    """Return T_world_thing of a body or site, 4×4."""
    pose = np.eye(4)
    pose[:3, :3] = np.array(thing.xmat).reshape(3, 3)
    pose[:3, 3] = thing.xpos
    return pose


class close:
    """A number that another one may differ from by a part of itself."""

    def __init__(self, value: float, tolerance: float) -> None:
        self.value = float(value)
        self.tolerance = tolerance

    def __eq__(self, other: object) -> bool:
        assert isinstance(other, float)
        return abs(other - self.value) <= self.tolerance * max(abs(self.value), 1.0)

    def __repr__(self) -> str:
        return f"{self.value!r} ± {self.tolerance}"
