"""The catalogue of motors: each number has a source, and what is published follows from it."""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

import yamaro
from yamaro import motors
from yamaro.model.schema import OF_MOTOR
from yamaro.motors import MOTORS

SOURCE = Path(motors.__file__).read_text(encoding="utf-8")


@pytest.mark.parametrize("name", MOTORS)
def test_each_motor_drives_a_joint(name: str) -> None:
    text = f"""
robot: r
model:
- link/name=base:
- part:
    name: arm
    joint: {{type: continuous, parent: base, axis: z, actuator: {{motor: {name}}}}}
    link: {{geometry: sphere, radius: 0.1, mass: 1}}
"""
    actuator = yamaro.build("r.yaml", text=text).robot.actuators["arm_joint"]
    assert actuator.motor == name
    assert MOTORS[name].keys() <= {*OF_MOTOR}
    assert actuator.gear >= 1
    # What is far outside of these is a slip of units.
    for value, least, most in (
        (actuator.armature, 1e-4, 1),
        (actuator.stall_torque, 0.1, 500),
        (actuator.no_load_speed, 1, 100),
    ):
        assert value is None or least <= value <= most


def test_each_number_has_a_source_and_each_source_a_number() -> None:
    table = SOURCE[SOURCE.index("MOTORS:") :]
    sources = set(re.findall(r"^- \[(\w+)\]", SOURCE, re.MULTILINE))
    lines = [line for line in table.split("\n") if re.match(r' +"\w+": "', line)]
    assert len(lines) == sum(map(len, MOTORS.values()))
    used = set()
    for line in lines:
        comment = line.partition("#")[2]
        named = set(re.findall(r"\[(\w+)\]", comment))
        assert named <= sources, line
        assert named or "the same" in comment or "both" in comment or ".com" in comment, line
        used |= named
    assert used == sources


def test_names_are_found_however_they_are_spelled() -> None:
    assert motors.spelled("XM430-W350") in MOTORS
    assert motors.spelled(" DM J4310") in MOTORS


# --- the G1, as whole_body_tracking has it ------------------------------------------------------
# HybridRobotics/whole_body_tracking, g1.py of commit cd65172: armature, effort and velocity of each
# motor, 10 Hz and a damping ratio of 2. The gains are as its Python computes them, with π written
# as 3.1415926535; two motors are at each ankle, and at the waist for roll and pitch.

PUBLISHED = {
    "unitree_5020": (0.003609725, 14.25062309787429, 0.907222843292423),
    "unitree_7520_14": (0.010177520, 40.17923847137318, 2.5578897650279457),
    "unitree_7520_22": (0.025101925, 99.09842777666113, 6.3088018534966395),
    "unitree_4010": (0.00425, 16.77832748089279, 1.06814150219),
    "2 unitree_5020": (0.00721945, 28.50124619574858, 1.814445686584846),
}
JOINTS = {
    **dict.fromkeys(["hip_pitch", "hip_yaw"], ("unitree_7520_14", 88, 32)),
    **dict.fromkeys(["hip_roll", "knee"], ("unitree_7520_22", 139, 20)),
    **dict.fromkeys(["ankle_pitch", "ankle_roll"], ("2 unitree_5020", 50, 37)),
    **dict.fromkeys(
        ["shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow", "wrist_roll"],
        ("unitree_5020", 25, 37),
    ),
    **dict.fromkeys(["wrist_pitch", "wrist_yaw"], ("unitree_4010", 5, 22)),
}
WAIST = {
    "waist_yaw": ("unitree_7520_14", 88, 32),
    **dict.fromkeys(["waist_roll", "waist_pitch"], ("2 unitree_5020", 50, 37)),
}
G1 = {
    **{f"{side}_{name}": row for side in ("left", "right") for name, row in JOINTS.items()},
    **WAIST,
}
ROBOT = """
robot: g1
base: free
functions:
  Driven(name, motor, effort, velocity):
  - part:
      name: $(name)
      joint:
        type: revolute
        parent: pelvis
        axis: y
        limit: {lower: -1, upper: 1, effort: $(effort), velocity: $(velocity)}
        actuator:
        - motor: $(motor.split()[-1])
        - frequency: 10 Hz
        - damping_ratio: 2
        - if motor.startswith('2 '):
          - armature: $(2 * 0.003609725)
      link: {geometry: sphere, radius: 0.1, mass: 1}
model:
- part: {name: pelvis, link: {geometry: sphere, radius: 0.1, mass: 8}}
"""


def test_the_gains_of_the_g1_are_those_that_are_published() -> None:
    calls = "".join(
        f"- Driven: {{name: {name}, motor: {motor}, effort: {effort}, velocity: {velocity}}}\n"
        for name, (motor, effort, velocity) in G1.items()
    )
    outputs = yamaro.build("g1.yaml", text=ROBOT + calls, target=["urdf", "mjcf"]).outputs
    actuators = outputs["urdf"].robot.actuators
    assert len(actuators) == 29
    root = ElementTree.fromstring(outputs["mjcf"].xml())
    written = {each.get("joint"): each for each in root.iterfind("actuator/*")}
    inertias = {each.get("name"): each.get("armature") for each in root.iter("joint")}
    for name, (motor, effort, velocity) in G1.items():
        armature, kp, kd = PUBLISHED[motor]
        actuator = actuators[f"{name}_joint"]
        found = (actuator.armature, actuator.kp, actuator.kd)
        assert found == pytest.approx((armature, kp, kd), rel=1e-9, abs=0)
        limit = outputs["urdf"].robot.joints[f"{name}_joint"].limit
        assert limit is not None
        assert (limit.effort, limit.velocity) == (effort, velocity)
        gains = str(written[f"{name}_joint"].get("controller")).split()
        assert float(gains[0]) == pytest.approx(kp, rel=1e-9, abs=0)
        assert float(gains[2]) == pytest.approx(kd, rel=1e-9, abs=0)
        assert float(str(inertias[f"{name}_joint"])) == pytest.approx(armature, rel=1e-9, abs=0)
