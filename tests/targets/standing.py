"""Whether a robot with actuators holds its home position in MuJoCo."""

from __future__ import annotations

from math import pi
from typing import Any

import numpy as np
from lxml import etree

SINGLE = ("revolute", "continuous", "prismatic")
TRANSMISSION = """<transmission name="{0}_transmission">
  <type>transmission_interface/SimpleTransmission</type>
  <joint name="{0}">
    <hardwareInterface>hardware_interface/PositionJointInterface</hardwareInterface>
  </joint>
  <actuator name="{0}_motor"/>
</transmission>"""


def with_position_actuators(urdf: str) -> str:
    """Return a URDF in which every independent joint has a position actuator, and nothing else."""
    root = etree.fromstring(urdf.encode())
    for name in ("transmission", "ros2_control"):
        for each in root.findall(name):
            root.remove(each)
    for joint in root.findall("joint"):
        if joint.get("type") in SINGLE and joint.find("mimic") is None:
            root.append(etree.fromstring(TRANSMISSION.format(joint.get("name"))))
    return etree.tostring(root).decode()


class Standing:
    """How a model holds its home position for some seconds.

    Attributes:
        warnings: MuJoCo's warnings, by number.
        worst: the greatest way of a joint from its place, as part of its range.
        joint: which joint that is.
        sank: how far a free root went down, in metres.
        weak: the actuators that are at their greatest effort in the end.
    """

    def __init__(self, model: Any, seconds: float = 5.0) -> None:
        import mujoco

        data = mujoco.MjData(model)
        mujoco.mj_resetDataKeyframe(model, data, model.key("home").id)
        start = data.qpos.copy()
        mujoco.mj_forward(model, data)
        while data.time < seconds:
            mujoco.mj_step(model, data)
        self.weak = [
            model.actuator(index).name
            for index in range(model.nu)
            if model.actuator_forcelimited[index]
            and abs(data.actuator_force[index]) >= 0.999 * model.actuator_forcerange[index].max()
        ]
        self.warnings = [index for index, each in enumerate(data.warning) if each.number]
        self.is_finite = bool(np.isfinite(data.qpos).all())
        self.worst, self.joint = 0.0, ""
        self.sank = 0.0
        for index in range(model.njnt):
            joint = model.joint(index)
            at = joint.qposadr[0]
            if joint.type[0] < 2:
                self.sank = max(self.sank, float(start[at + 2] - data.qpos[at + 2]))
                continue
            whole = 2 * pi if joint.type[0] == 3 else 1.0
            if model.jnt_limited[index]:
                whole = min(whole, float(np.ptp(joint.range)))
            part = abs(float(data.qpos[at] - start[at])) / max(whole, 1e-3)
            if part > self.worst:
                self.worst, self.joint = part, joint.name
