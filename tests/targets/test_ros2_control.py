"""The `<ros2_control>` blocks that `control` writes, by the rules of ros2_control."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest
from lxml import etree

import yamaro
from tests.consumers import oracles
from tests.golden import CASES
from tests.targets.ros2_control_rules import faults_of
from yamaro.codes import ADJUSTABLE

CORPUS = Path(__file__).parents[3] / "shared" / "corpus"
HAND_WRITTEN = {
    "codes/unknown-joint.xml",
    "diagnostics/unknown-joint.xml",
    "include/material-of-another-look-in-a-urdf.xml",
    "include/same-robot-twice.xml",
    "include/urdf.xml",
}
"""Cases with blocks that they or the files they include hold as XML, too short to be whole."""


def block_of(text: str) -> etree._Element:
    """Return a robot with a joint `turn`, a fixed one, a follower, and a block."""
    return etree.fromstring(
        f"""<robot name="r"><link name="a"/><link name="b"/>
          <joint name="turn" type="continuous"><parent link="a"/><child link="b"/></joint>
          <joint name="still" type="fixed"><parent link="b"/><child link="c"/></joint>
          <joint name="follow" type="continuous"><mimic joint="turn"/></joint>
          {text}</robot>"""
    )


BLOCK = """<ros2_control name="r" type="system">
  <hardware><plugin>p/P</plugin><param name="port">3</param></hardware>
  <joint name="turn">
    <command_interface name="velocity">
      <param name="min">-1</param><param name="max">1</param>
    </command_interface>
    <state_interface name="position"><param name="initial_value">0</param></state_interface>
  </joint>
  <sensor name="s"><state_interface name="force.x"/><param name="frame_id">b</param></sensor>
  <gpio name="g"><command_interface name="on"/><state_interface name="on"/></gpio>
  <transmission name="t"><plugin>transmission_interface/SimpleTransmission</plugin>
    <actuator name="m" role="m"/>
    <joint name="turn" role="j"><mechanical_reduction>50</mechanical_reduction></joint>
  </transmission>
</ros2_control>"""


def test_the_rules_accept_a_block() -> None:
    assert faults_of(block_of(BLOCK)) == []


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("<plugin>p/P</plugin>", ""),
        (' type="system"', ""),
        ('type="system"', 'type="sytem"'),
        ('<param name="port">', "<param>"),
        ("<hardware>", "<hardware>text"),
        ('<joint name="turn">', '<joint name="trun">'),
        ('<joint name="turn">', '<joint name="still">'),
        ('<joint name="turn">', '<joint name="follow">'),
        ('<param name="min">-1', '<param name="min">-pi'),
        ('<param name="min">-1', '<param name="min">2'),
        ('<command_interface name="velocity">', "<command_interface>"),
        ("<sensor", '<motor name="m"/><sensor'),
        ('<joint name="turn" role="j">', '<joint name="turn">'),
        ('<joint name="turn" role="j">', '<joint name="still" role="j">'),
        ("<mechanical_reduction>50", "<mechanical_reduction>0"),
        ('<gpio name="g"><command_interface name="on"/>', '<gpio name="g">text'),
        ('<state_interface name="on"/>', '<state_interface name="on"/>' * 2),
        ("</ros2_control>", "</ros2_control>" + BLOCK),
    ],
)
def test_the_rules_refuse(old: str, new: str) -> None:
    assert old in BLOCK
    assert faults_of(block_of(BLOCK.replace(old, new, 1)))


def cases() -> list[str]:
    paths = (path for path in CASES.rglob("*.xml") if "<ros2_control" in path.read_text())
    return sorted(str(path.relative_to(CASES)) for path in paths)


@pytest.mark.parametrize("name", cases())
def test_the_blocks_of_all_cases_keep_the_rules(name: str) -> None:
    if name in HAND_WRITTEN:
        pytest.skip("has blocks of files that are included")
    assert faults_of(etree.parse(CASES / name).getroot()) == []


# --- the robots of the corpus ---------------------------------------------------------------------


def robots() -> list[str]:
    if not CORPUS.exists():
        return []
    with (CORPUS / "urdf.tsv").open(encoding="utf-8") as file:
        paths = [f"src/{row['path']}" for row in csv.DictReader(file, delimiter="\t")]
    with (CORPUS / "xacro.tsv").open(encoding="utf-8") as file:
        rows = csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE)
        return paths + [row["expected"] for row in rows]


def drivable(root: etree._Element) -> list[etree._Element]:
    return [
        joint
        for joint in root.findall("joint")
        if joint.get("type") in ("revolute", "continuous", "prismatic")
        and joint.find("mimic") is None
    ]


def without_blocks(path: Path, tmp_path: Path) -> tuple[etree._Element, Path]:
    """Return a robot without its own blocks, and the file of it."""
    root = etree.parse(path, etree.XMLParser(remove_comments=True)).getroot()
    for block in root.findall("ros2_control"):
        root.remove(block)
    copy = tmp_path / "robot.urdf"
    copy.write_bytes(etree.tostring(root))
    return root, copy


@pytest.mark.slow
@pytest.mark.skipif(not CORPUS.exists(), reason="there is no corpus")
@pytest.mark.parametrize("path", robots())
def test_limits_are_those_of_the_urdf(path: str, tmp_path: Path) -> None:
    root, file = without_blocks(CORPUS / path, tmp_path)
    joints = drivable(root)
    if not joints:
        pytest.skip("no joint can be driven")
    if b"${" in file.read_bytes():
        pytest.skip("it is xacro, which is run when it is included")
    text = f"""robot: r
model: {{include: {{path: {file}}}}}
control: {{plugin: mock_components/GenericSystem, joints: '*'}}
"""
    try:
        made = yamaro.build("-", text=text, allow=sorted(ADJUSTABLE)).xml()
    except yamaro.YamaroError as error:
        pytest.skip(f"the file is faulty: {error.diagnostics[0].code}")
    robot = etree.fromstring(made.encode())
    assert faults_of(robot) == []
    (block,) = robot.findall("ros2_control")
    blocks = {joint.get("name"): joint for joint in block.findall("joint")}
    assert list(blocks) == list(dict.fromkeys(joint.get("name") for joint in joints))
    for joint in joints:
        assert limits_in(blocks[joint.get("name")]) == limits_of(joint), joint.get("name")


def limits_of(joint: etree._Element) -> dict[str, list[float]]:
    limit = joint.find("limit")
    if limit is None or joint.get("type") == "continuous":
        return {"position": []}
    return {"position": [float(limit.get(name, "0")) for name in ("lower", "upper")]}


def limits_in(joint: etree._Element) -> dict[str, list[float]]:
    return {
        interface.get("name"): [float(param.text) for param in interface.findall("param")]
        for interface in joint.findall("command_interface")
    }


def test_drake_reads_the_armature_of_transmissions(tmp_path: Path) -> None:
    oracles.require_module("pydrake")
    from pydrake.multibody.parsing import Parser
    from pydrake.multibody.plant import MultibodyPlant

    rows = {
        "rotor": ("revolute", "rotor_inertia: 1e-5, gear: 30, command: effort", 1e-5 * 900),
        "armature": ("revolute", "armature: 0.2, gear: -8, kp: 30, kd: 2", 0.2),
        "direct": ("continuous", "armature: 0.3", 0.3),
        "slide": ("prismatic", "rotor_inertia: 1e-5, gear: 600", 3.6),
        "none": ("revolute", "gear: 20", None),
    }
    text = "robot: r\nbase: fixed\nmodel:\n- link/name=base:\n"
    for name, (kind, actuator, _) in rows.items():
        limit = "limit: {lower: -1, upper: 1, effort: 5, velocity: 2}"
        text += f"""
- part:
    name: {name}
    joint: {{type: {kind}, parent: base, axis: z, {limit}, actuator: {{{actuator}}}}}
    link: {{geometry: sphere, radius: 0.1, mass: 1}}
"""
    text += "control: {plugin: mock_components/GenericSystem, transmissions: true}\n"
    build = yamaro.build("r.yaml", text=text, target="urdf")
    plant = MultibodyPlant(0.001)
    Parser(plant).AddModelsFromString(build.xml(), "urdf")
    plant.Finalize()
    found = {}
    for index in plant.GetJointActuatorIndices():
        driven = plant.get_joint_actuator(index)
        assert driven.effort_limit() == 5
        found[driven.joint().name()] = driven.default_reflected_inertia()
        assert driven.has_controller() == (driven.joint().name() == "armature_joint")
        if driven.has_controller():
            gains = driven.get_controller_gains()
            assert (gains.p, gains.d) == (30, 2)
    expected = {f"{name}_joint": value for name, (_, _, value) in rows.items() if value}
    assert found == pytest.approx(expected, rel=1e-14)
    # Read again, the URDF says the same.
    again = yamaro.build("r.urdf", text=build.xml()).robot.actuators
    assert {n: again[n].armature for n in found} == pytest.approx(expected, rel=1e-14)
    assert again["none_joint"].armature is None
    assert (again["armature_joint"].kp, again["armature_joint"].kd) == (30, 2)
