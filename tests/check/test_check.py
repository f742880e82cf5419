"""The structural check: bad robots get exactly their one finding, good robots get none."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path
from typing import TYPE_CHECKING
from xml.parsers import expat

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.counting import calls_of
from tests.later import Later
from yamaro.check.robot import check
from yamaro.check.semantics import findings_against
from yamaro.diagnostics import WARNING, Diagnostic, Reporter
from yamaro.meshes.triangles import mesh_extent
from yamaro.model.reading import read_robot
from yamaro.model.schema import ELEMENTS
from yamaro.model.values import read_numbers
from yamaro.rendering import render
from yamaro.source import Source, Span
from yamaro.xml.tree import Comment, Element, Text

if TYPE_CHECKING:
    import trimesh
else:
    trimesh = Later("trimesh")


class UrdfReader:
    """Reads URDF into elements whose spans are real: the source is the URDF text itself."""

    def __init__(self, text: str, *, name: str = "robot.urdf") -> None:
        self.source = Source(text, name=name)
        self.source.is_xml = True
        self.stack: list[Element] = []
        self.root: Element | None = None
        self.parser = expat.ParserCreate()
        self.parser.ordered_attributes = True
        self.parser.StartElementHandler = self.start
        self.parser.EndElementHandler = self.end
        self.parser.CharacterDataHandler = self.text
        self.parser.CommentHandler = self.comment
        self.encoded = text.encode()
        self.parser.Parse(self.encoded, True)

    def offset(self) -> int:
        return len(self.encoded[: self.parser.CurrentByteIndex].decode())

    def start(self, name: str, attributes: list[str]) -> None:
        start = self.offset()
        position = start + 1 + len(name)
        span = Span(self.source, start, position)
        values: dict[str, object] = {}
        spans = {}
        for key, value in zip(attributes[::2], attributes[1::2], strict=True):
            values[key] = value
            equals = self.source.text.index("=", self.source.text.index(key, position))
            while self.source.text[equals] not in "\"'":
                equals += 1
            close = self.source.text.index(self.source.text[equals], equals + 1)
            spans[key] = Span(self.source, equals + 1, close)
            position = close
        element = Element(name, span, attributes=values, value_spans=spans)
        if self.stack:
            self.stack[-1].children.append(element)
        else:
            self.root = element
        self.stack.append(element)

    def end(self, name: str) -> None:
        self.stack.pop()

    def text(self, data: str) -> None:
        if data.strip():
            span = Span(self.source, self.offset(), self.offset() + len(data))
            self.stack[-1].children.append(Text(data, span))

    def comment(self, data: str) -> None:
        if self.stack:
            self.stack[-1].children.append(Comment(data, self.stack[-1].span))


def read(text: str) -> Element:
    root = UrdfReader(text).root
    assert root is not None
    return root


# --- bad robots -------------------------------------------------------------------------------

BAD_ROBOTS = Path(__file__).parent / "bad_robots"
SHORTHANDS = {
    "{links}": '<link name="a"/><link name="b"/>',
    "{body}": '<link name="a"/><link name="b"><inertial><mass value="1"/>'
    '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>',
    "{ends}": '<parent link="a"/><child link="b"/>',
    "{limit}": '<limit lower="-1" upper="1" effort="1" velocity="1"/>',
    "{inertia}": '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>',
    "{box}": '<geometry><box size="1 1 1"/></geometry>',
    "{arm}": '<link name="a"/><link name="b"><inertial><mass value="1"/>{inertia}</inertial></link>'
    '<joint name="j" type="revolute">{ends}{limit}</joint>',
    "{two}": '{arm}{third}<joint name="k" type="continuous">{below}</joint>',
    "{two0}": '{arm}{third}<joint name="k" type="continuous">{below}',
    "{two0e}": '{arm}{third}<joint name="k" type="revolute">{below}{limit}',
    "{follower}": '{arm}{third}<joint name="k" type="continuous">{below}<mimic joint="j"/></joint>',
    "{third}": '<link name="c"><inertial><mass value="1"/>{inertia}</inertial></link>',
    "{below}": '<parent link="b"/><child link="c"/>',
    "{hw}": "<hardware><plugin>mock_components/GenericSystem</plugin></hardware>",
    "{pos}": '<command_interface name="position"/><state_interface name="position"/>',
    "{simple}": "<plugin>transmission_interface/SimpleTransmission</plugin>",
    "{type}": "<type>transmission_interface/SimpleTransmission</type>",
    "{driven}": '<joint name="j"><hardwareInterface>hardware_interface/EffortJointInterface'
    "</hardwareInterface></joint>",
    "{driven1}": '<joint name="j"><role>joint1</role><hardwareInterface>'
    "hardware_interface/EffortJointInterface</hardwareInterface></joint>",
    "{motor}": '<actuator name="m"/>',
    "{reach}": "<range><min>0.1</min><max>9</max></range>",
    "{moving}": '<link name="a"/><joint name="j" type="fixed"><parent link="a"/>'
    '<child link="b"/></joint><link name="b">',
}


class BadRobot:
    """A robot with one fault: the marks « and » stand around the places to be underlined."""

    def __init__(self, name: str, codes: list[str], marked: str) -> None:
        self.name = name
        self.codes = codes
        for _ in range(3):  # some have others in them
            for short, full in SHORTHANDS.items():
                marked = marked.replace(short, full)
        if not marked.lstrip("«").startswith("<robot"):
            marked = f'<robot name="r">\n{marked}\n</robot>'
        self.places = []
        text = ""
        for piece in re.split("([«»])", marked):
            if piece == "«":
                start = len(text)
            elif piece == "»":
                self.places.append((start, len(text)))
            else:
                text += piece
        self.text = text


def bad_robots(group: str) -> list[BadRobot]:
    robots = []
    for entry in (BAD_ROBOTS / f"{group}.txt").read_text(encoding="utf-8").split("### ")[1:]:
        head, _, body = entry.partition("\n")
        name, _, codes = head.partition(" | ")
        robots.append(BadRobot(name, codes.split(", "), body.strip()))
    return robots


GROUPS = ("tree", "joints", "links", "references")
FAULTY = [robot for group in GROUPS for robot in bad_robots(group)]
EXTENSIONS = ("ros2_control", "transmissions", "gazebo")
ADVISED = [robot for group in EXTENSIONS for robot in bad_robots(group)]
"""Robots whose fault is what `yamaro check` alone reports."""


def found(text: str, *, advice: bool = False) -> list[Diagnostic]:
    """Return the findings, or the advice, in order of place."""
    faults, hints = Reporter(), Reporter()
    check(read(text), reporter=faults, advice=hints if advice else None)
    return sorted((hints if advice else faults).diagnostics, key=lambda d: d.span.start)


@pytest.mark.parametrize("robot", FAULTY, ids=lambda robot: robot.name)
def test_a_bad_robot_gets_its_finding_at_the_very_place(robot: BadRobot) -> None:
    findings = found(robot.text)
    assert sorted(d.code for d in findings) == sorted(robot.codes)
    assert [(d.span.start, d.span.end) for d in findings] == robot.places


@pytest.mark.parametrize("robot", FAULTY, ids=lambda robot: robot.name)
def test_a_finding_says_what_to_do(robot: BadRobot) -> None:
    for diagnostic in found(robot.text):
        assert diagnostic.hint
        assert diagnostic.severity == WARNING
        assert diagnostic.message[0].islower() or diagnostic.message.startswith(("'", "URDF"))
        assert "\n" not in render(diagnostic).split("\n")[0]


@pytest.mark.parametrize("robot", bad_robots("advice"), ids=lambda robot: robot.name)
def test_an_odd_robot_gets_advice_and_no_warning(robot: BadRobot) -> None:
    assert found(robot.text) == []
    findings = [d for d in found(robot.text, advice=True) if d.code in robot.codes]
    assert [d.code for d in findings] == robot.codes
    assert [(d.span.start, d.span.end) for d in findings] == robot.places


@pytest.mark.parametrize("robot", ADVISED, ids=lambda robot: robot.name)
def test_a_fault_in_an_extension_is_found_at_the_very_place(robot: BadRobot) -> None:
    assert found(robot.text) == []
    findings = [d for d in found(robot.text, advice=True) if d.code != "missing-axis"]
    assert [d.code for d in findings] == robot.codes
    assert [(d.span.start, d.span.end) for d in findings] == robot.places
    assert all(d.hint and d.severity == WARNING for d in findings)


# The robot of the SRDF in bad_robots/srdf.txt.
DESCRIBED = """<robot name="r"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
<joint name="k" type="continuous"><parent link="b"/><child link="c"/></joint>
<joint name="f" type="fixed"><parent link="c"/><child link="d"/></joint></robot>"""


def found_in_srdf(text: str) -> list[Diagnostic]:
    root, faults, hints = read(text), Reporter(), Reporter()
    check(root, reporter=faults, advice=hints)
    findings_against(root, read_robot(read(DESCRIBED)), hints)
    assert faults.diagnostics == []
    return sorted(hints.diagnostics, key=lambda d: d.span.start)


@pytest.mark.parametrize("robot", bad_robots("srdf"), ids=lambda robot: robot.name)
def test_a_fault_in_an_srdf_is_found_at_the_very_place(robot: BadRobot) -> None:
    findings = found_in_srdf(robot.text)
    assert [d.code for d in findings] == robot.codes
    assert [(d.span.start, d.span.end) for d in findings] == robot.places
    assert all(d.hint and d.severity == WARNING for d in findings)


@pytest.mark.parametrize("robot", bad_robots("fine"), ids=lambda robot: robot.name)
def test_what_is_near_a_fault_is_fine(robot: BadRobot) -> None:
    told = {each.code for each in found(robot.text) + found(robot.text, advice=True)}
    assert told.isdisjoint(robot.codes)


def test_there_are_at_least_as_many_bad_robots_as_promised() -> None:
    assert len(FAULTY) >= 60
    assert len({robot.name for robot in FAULTY}) == len(FAULTY)


def test_every_code_is_explained() -> None:
    page = (Path(__file__).parents[2] / "docs" / "checks.md").read_text(encoding="utf-8")
    explained = set(re.findall(r"\[`([a-z0-9.-]+)`\]\(diagnostics\.md#", page))
    everything = FAULTY + ADVISED + bad_robots("advice") + bad_robots("srdf")
    used = {code for robot in everything for code in robot.codes}
    used |= {"missing-mesh-file", "unknown-package", "large-mesh", "long-chain", "not-urdf"}
    used |= {"hidden-package", "unused-allow", "effort-above-stall", "poor-fit", "fits-overlap"}
    assert used == explained


# --- good robots ------------------------------------------------------------------------------

ARM = """<?xml version="1.0"?>
<robot name="my arm" xmlns:drake="https://drake.mit.edu">
  <!-- a comment -->
  <material name="steel"><color rgba="0.5 0.5 0.5 1"/></material>
  <link name="base"/>
  <link name="arm" type="laser">
    <inertial>
      <origin xyz="0 0 0.1" rpy="0 3.1416 -6.2832"/>
      <mass value="1.5"/>
      <inertia ixx="1e-2" ixy="0" ixz="0" iyy="1.e-2" iyz="0" izz="+.001"/>
    </inertial>
    <visual name="shell"><geometry><cylinder radius="0.05" length="0.2"/></geometry>
      <material name="steel"/></visual>
    <visual><geometry><mesh filename="package://x/y.dae" scale="1 -1 1"/></geometry>
      <material name=""><color rgba="0 0 0 1"/></material></visual>
    <collision><origin/><geometry><sphere radius="0.05"/></geometry>
      <drake:proximity_properties/></collision>
    <contact><lateral_friction value="1"/></contact>
    <sensor name="s"/>
  </link>
  <link name="plate"><visual><geometry><box size="1 1 1e-3"/></geometry>
    <material name="blue"><color rgba="0 0 1 1"/></material></visual></link>
  <link name="tip"><visual><geometry><box size="1 1 1"/></geometry>
    <material name="blue"/></visual></link>
  <joint name="shoulder" type="revolute">
    <origin xyz="0 0  1 "/><parent link="base"/><child link="arm"/>
    <axis xyz="0.707 0 0.707"/>
    <limit lower="-1" upper="1" effort="10" velocity="2"/>
    <dynamics damping="0.1"/><calibration rising="0.5"/>
    <safety_controller k_velocity="10" soft_lower_limit="-0.9" soft_upper_limit="0.9"/>
  </joint>
  <joint name="slide" type="prismatic"><parent link="arm"/><child link="plate"/>
    <limit upper="1" effort="10" velocity="2"/><mimic joint="shoulder" multiplier="-0.5"/></joint>
  <joint name="end" type="fixed"><parent link="plate"/><child link="tip"/>
    <axis xyz="0 0 0"/></joint>
  <gazebo reference="arm"><visual><anything/></visual></gazebo>
  <transmission name="t"><joint name="shoulder"/></transmission>
  <ros2_control name="c"><joint name="shoulder"/></ros2_control>
  <sensor name="camera"><parent link="arm"/><origin xyz="0 0 0"/></sensor>
  <joints/><point name="p"/><line name="l"/><group name="g"/><mujoco/>
</robot>"""
TWO_LINKS = '<link name="a"/><link name="b"/>'
GOOD_ROBOTS = {
    "an arm with extensions": ARM,
    "one link": '<robot name="r"><link name="a"/></robot>',
    "version 1.0": '<robot name="r" version="1.0"><link name="a"/></robot>',
    "zero axis of a fixed joint": f'<robot name="r">{TWO_LINKS}<joint name="j" type="fixed">'
    '<parent link="a"/><child link="b"/><axis xyz="0 0 0"/></joint></robot>',
    "plate, whose moments just meet the triangle inequality": '<robot name="r"><link name="a">'
    '<inertial><mass value="1"/><inertia ixx="0.0833" ixy="0" ixz="0" iyy="0.0833" iyz="0" '
    'izz="0.1667"/></inertial></link></robot>',
    "inertia turned by 45 degrees": '<robot name="r"><link name="a"><inertial><mass value="1"/>'
    '<inertia ixx="1.5" ixy="0.5" ixz="0" iyy="1.5" iyz="0" izz="2"/></inertial></link></robot>',
}
NEWER_ROBOTS = {
    "1.1": '<robot name="r" version="1.1"><link name="a"><visual>'
    '<origin quat_xyzw="0 0 0.7071 0.7071"/><geometry><capsule radius="1" length="1"/></geometry>'
    "</visual></link></robot>",
    "1.2": f'<robot name="r" version="1.2">{TWO_LINKS}<joint name="j" type="revolute">'
    '<parent link="a"/><child link="b"/><limit lower="-1" upper="1" acceleration="3" jerk="9"/>'
    "</joint></robot>",
}


@pytest.mark.parametrize("name", [*GOOD_ROBOTS, *NEWER_ROBOTS])
def test_a_good_robot_is_met_with_silence(name: str) -> None:
    assert found({**GOOD_ROBOTS, **NEWER_ROBOTS}[name]) == []


def urdfdom_accepts(text: str, folder: Path) -> bool:
    path = folder / "robot.urdf"
    path.write_text(text, encoding="utf-8")
    run = subprocess.run(["check_urdf", str(path)], capture_output=True, text=True, check=False)
    return run.returncode == 0 and "rror:" not in run.stdout + run.stderr


needs_urdfdom = pytest.mark.skipif(shutil.which("check_urdf") is None, reason="no check_urdf")


@needs_urdfdom
@pytest.mark.parametrize("name", GOOD_ROBOTS)
def test_urdfdom_accepts_the_good_robots(name: str, tmp_path: Path) -> None:
    assert urdfdom_accepts(GOOD_ROBOTS[name], tmp_path)


@needs_urdfdom
def test_what_is_said_of_urdfdom_is_so(tmp_path: Path) -> None:
    refused = (
        "mass with a space behind",
        "origin separated by tabs",
        "dynamics without content",
        "limit of a continuous joint without effort",
        "safety controller without k_velocity",
        "capsule in URDF 1.0",
        "no link",
        "material without name",
        "inertia without ixy",
        "origin with 1e400",
    )
    texts = {robot.name: robot.text for robot in FAULTY}
    for name in refused:
        assert not urdfdom_accepts(texts[name], tmp_path), name


# --- what is said -----------------------------------------------------------------------------


def only(text: str, *, advice: bool = False) -> Diagnostic:
    findings = found(text, advice=advice)
    assert len(findings) == 1
    return findings[0]


def case(name: str) -> str:
    return next(robot.text for robot in FAULTY if robot.name == name)


def test_an_impossible_inertia_is_told_with_its_eigenvalues() -> None:
    message = only(case("inertia with off-diagonals too large")).message
    assert "eigenvalues are -1, 1 and 3" in message


def test_a_circle_is_told_with_its_path() -> None:
    links = "".join(f'<link name="l{i}"/>' for i in range(3))
    joints = "".join(
        f'<joint name="j{i}" type="fixed"><parent link="l{i}"/>'
        f'<child link="l{(i + 1) % 3}"/></joint>'
        for i in range(3)
    )
    assert "l0 → l1 → l2 → l0" in only(f'<robot name="r">{links}{joints}</robot>').message


def test_a_duplicate_is_told_with_both_places() -> None:
    finding = only('<robot name="r">\n<link name="a"/>\n  <link name="a"/>\n</robot>')
    assert finding.span.location() == (3, 15)
    assert finding.notes == ("first defined at robot.urdf:2:13",)


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("unknown parent", "did you mean 'a'?"),
        ("joint type misspelt", "did you mean 'continuous'?"),
        ("joint type unknown", "URDF calls it 'revolute'"),
        ("rgba 255", "divide by 255: `1 0.502 0 1`"),
        ("rgba with three numbers", "add the opacity as the fourth number: 1 0 0 1"),
        ("axis diagonal", "write 0.707107 0.707107 0; some parsers scale the motion by the length"),
        ("mass as text", "in URDF it is an attribute: `mass/value=1.0:`"),
        ("name as an element", "in URDF it is an attribute: `link/name=arm:`"),
        ("misspelt visual", "did you mean 'visual'?"),
        ("limit outside of a joint", "it belongs in a joint"),
        ("upper alone below zero", "also write 'lower', which defaults to 0"),
        ("lower above upper", "swap the two"),
        ("origin with a xacro expression", "write `$(…)` for an expression; `${…}` is xacro's"),
        ("rpy in degrees", "angles are in radians; 90 degrees are 1.5708"),
        ("inertia with iyx", "remove it: the matrix is symmetric, and 'ixy' has the same value"),
    ],
)
def test_a_hint_holds_the_remedy(name: str, hint: str) -> None:
    assert hint in [finding.hint for finding in found(case(name))]


def test_the_same_fault_from_one_place_is_told_once() -> None:
    source = Source("mass: -1", name="robot.yaml")
    span = Span(source, 6, 8)
    root = read('<robot name="r"><link name="base"/></robot>')
    for i in range(3):
        extra = read(
            f'<robot name="r"><link name="l{i}"><inertial><mass value="-1"/>'
            f"{SHORTHANDS['{inertia}']}</inertial></link><joint name='j{i}' type='fixed'>"
            f"<parent link='base'/><child link='l{i}'/></joint></robot>"
        )
        extra.elements()[0].elements()[0].elements()[0].value_spans = {"value": span}
        root.children += extra.children
    reporter = Reporter()
    check(root, reporter=reporter)
    (finding,) = reporter.diagnostics
    assert (finding.code, finding.span.key()) == ("bad-mass", span.key())
    assert finding.notes == ("3 elements made here have this fault",)


def test_values_may_be_python_objects() -> None:
    root = read(ARM)
    arm = root.elements()[2]
    arm.elements()[0].elements()[1].attributes["value"] = float("nan")
    root.elements()[5].elements()[0].attributes["xyz"] = [0, 0.5, 1]
    root.elements()[5].elements()[4].attributes["effort"] = None
    reporter = Reporter()
    check(root, reporter=reporter)
    assert sorted(d.code for d in reporter.diagnostics) == ["missing-attribute", "not-a-number"]


def test_a_capsule_that_a_part_has_warned_of_is_not_told_again() -> None:
    root = read(case("capsule in URDF 1.0"))
    reporter = Reporter()
    reporter.report("capsule-needs-urdf-1.1", "told", root.span)
    check(root, reporter=reporter)
    assert [d.message for d in reporter.diagnostics] == ["told"]


def density_told(shape: str, mass: float) -> str:
    text = (
        SHORTHANDS["{moving}"] + f'<inertial><mass value="{mass}"/>{SHORTHANDS["{inertia}"]}'
        f"</inertial><visual><geometry>{shape}</geometry></visual></link>"
    )
    message = only(f'<robot name="r" version="1.1">{text}</robot>', advice=True).message
    return message.split("density ")[1].split(" ")[0]


def test_the_density_is_mass_over_the_volume_of_the_shape() -> None:
    shapes = {
        '<box size="0.1 0.2 0.3"/>': trimesh.creation.box(extents=(0.1, 0.2, 0.3)),
        '<sphere radius="0.2"/>': trimesh.primitives.Sphere(radius=0.2),
        '<cylinder radius="0.1" length="0.5"/>': trimesh.primitives.Cylinder(
            radius=0.1, height=0.5
        ),
        '<capsule radius="0.1" length="0.5"/>': trimesh.primitives.Capsule(radius=0.1, height=0.5),
    }
    for shape, solid in shapes.items():
        assert float(density_told(shape, 1e4)) == pytest.approx(1e4 / solid.volume, rel=0.02)


def test_a_link_with_a_mesh_gets_no_advice_on_its_density() -> None:
    text = SHORTHANDS["{moving}"] + (
        f'<inertial><mass value="1000"/>{SHORTHANDS["{inertia}"]}</inertial>'
        '<visual><geometry><mesh filename="a.stl"/></geometry></visual></link>'
    )
    assert found(f'<robot name="r">{text}</robot>', advice=True) == []


# --- numbers ----------------------------------------------------------------------------------


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_every_finite_number_is_read_as_it_is(number: float) -> None:
    assert read_numbers(f"{number!r} 0") == (number, 0.0)


# --- files ------------------------------------------------------------------------------------


def mesh_robot(*filenames: str, attributes: str = "") -> str:
    visuals = "".join(
        f'<visual><geometry><mesh filename="{name}"{attributes}/></geometry></visual>'
        for name in filenames
    )
    return f'<robot name="r"><link name="a">{visuals}</link></robot>'


def file_findings(text: str, *, there: dict[str, str], packages: set[str]) -> list[Diagnostic]:
    reporter = Reporter()
    check(
        read(text),
        reporter=reporter,
        resolve_mesh=lambda filename, span: there.get(filename),
        package_fault=lambda name, span: (
            None if name in packages else ("install it", ["/opt/a", "/opt/b"])
        ),
    )
    return reporter.diagnostics


def test_a_mesh_that_is_there_is_met_with_silence() -> None:
    text = mesh_robot("a.stl", "http://example.org/a.stl", "model://a/a.stl")
    assert file_findings(text, there={"a.stl": "/a.stl"}, packages=set()) == []


def test_a_missing_mesh_is_told_once_at_its_first_use() -> None:
    text = mesh_robot("a.stl", "b.stl", "b.stl")
    (finding,) = file_findings(text, there={"a.stl": "/a.stl"}, packages=set())
    assert finding.code == "missing-mesh-file"
    assert finding.span.start == text.index("b.stl")


def test_a_missing_file_of_a_known_package_is_missing() -> None:
    (finding,) = file_findings(mesh_robot("package://p/a.stl"), there={}, packages={"p"})
    assert finding.code == "missing-mesh-file"


def test_an_unknown_package_is_told_once_with_the_places_looked_at() -> None:
    text = mesh_robot("package://p/a.stl", "package://p/b.stl")
    (finding,) = file_findings(text, there={}, packages=set())
    assert finding.code == "unknown-package"
    assert finding.span.written() == "package://p/a.stl"
    assert finding.hint is not None
    assert finding.hint == "install it; searched in /opt/a, /opt/b"


def test_a_missing_texture_is_told() -> None:
    material = '<material name="m"><texture filename="t.png"/></material>'
    text = f'<robot name="r">{material}<link name="a"/></robot>'
    (finding,) = file_findings(text, there={}, packages=set())
    assert (finding.code, finding.span.written()) == ("missing-mesh-file", "t.png")


def test_an_empty_filename_is_told() -> None:
    (finding,) = file_findings(mesh_robot(""), there={}, packages=set())
    assert finding.code == "missing-mesh-file"


def test_files_are_not_looked_at_unless_asked() -> None:
    assert found(mesh_robot("nowhere.stl")) == []


@pytest.mark.parametrize(
    ("name", "form"), [("box.stl", "stl"), ("box.stl", "stl_ascii"), ("box.obj", "obj")]
)
def test_a_mesh_in_millimetres_gets_advice(name: str, form: str, tmp_path: Path) -> None:
    path = tmp_path / name
    trimesh.creation.box(extents=(100, 400, 300)).export(path, file_type=form)
    assert mesh_extent(str(path), (1.0, 1.0, 2.0)) == pytest.approx(600, rel=1e-6)
    for attributes, codes in (("", ["large-mesh"]), (' scale="0.001 0.001 0.001"', [])):
        faults, advice = Reporter(), Reporter()
        check(
            read(mesh_robot("box.stl", attributes=attributes)),
            reporter=faults,
            advice=advice,
            resolve_mesh=lambda filename, span: str(path),
        )
        assert faults.diagnostics == []
        assert [d.code for d in advice.diagnostics] == codes


@pytest.mark.parametrize("name", ["odd.stl", "odd.obj"])
@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"solid ascii",
        b"x" * 200,
        b"v 0 0 0\nv 1 a 3\n",
        b"v 0 0 0\nv 1 inf 3\n",
        b"v 0 0 0\nv nan 1 3\n",
        b"vn 0 0 0\nvn 900 0 0\n",
        b"# v 0 0 0\n",
    ],
)
def test_a_mesh_that_cannot_be_measured_gets_no_advice(
    name: str, content: bytes, tmp_path: Path
) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    assert mesh_extent(str(path), (1.0, 1.0, 1.0)) is None
    assert mesh_extent(str(tmp_path / "none.stl"), (1.0, 1.0, 1.0)) is None


# --- size -------------------------------------------------------------------------------------


def chain(length: int) -> Element:
    source = Source("robot", name="robot.yaml")
    span = Span(source, 0, 5)
    root = Element("robot", span, attributes={"name": "r"})
    for i in range(length):
        root.children.append(Element("link", span, attributes={"name": f"l{i}"}))
    for i in range(length - 1, 0, -1):
        parent = Element("parent", span, attributes={"link": f"l{i - 1}"})
        child = Element("child", span, attributes={"link": f"l{i}"})
        root.children.append(
            Element(
                "joint",
                span,
                attributes={"name": f"j{i}", "type": "fixed"},
                children=[parent, child],
            )
        )
    return root


def test_a_chain_of_a_thousand_links_is_silent_and_of_5000_is_warned_of() -> None:
    for length, codes in ((1001, []), (5000, ["long-chain"])):
        reporter = Reporter()
        check(chain(length), reporter=reporter)
        assert [d.code for d in reporter.diagnostics] == codes


def test_the_work_grows_with_the_size_and_no_faster() -> None:
    def work(length: int) -> int:
        root = chain(length)
        for joint in root.elements()[length:]:
            attributes = joint.elements()[0].attributes
            attributes["link"] = f"{attributes['link']}x"
        return calls_of(lambda: check(root, reporter=Reporter()))

    work(10)  # imports what is imported when used
    assert work(2_000) < 11 * work(200)


# --- anything at all --------------------------------------------------------------------------

NAMES = st.sampled_from([*ELEMENTS, "gazebo", "a:b", "jonit", "contact"])
ATTRIBUTES = st.sampled_from(
    [*sorted({name for rule in ELEMENTS.values() for name in rule.fields}), "iyx", "x:y"]
)
VALUES = st.one_of(
    st.sampled_from(["a", "b", "revolute", "fixed", "1", "-1", "0 0 0", "1 2 3", "nan", "", " "]),
    st.text(max_size=5),
    st.floats(),
    st.none(),
    st.booleans(),
    st.lists(st.integers(), max_size=4),
)
SPAN = Span(Source("anything", name="robot.yaml"), 0, 3)


def elements(names: st.SearchStrategy[str], depth: int) -> st.SearchStrategy[Element]:
    children: st.SearchStrategy[list[Element]] = (
        st.lists(elements(NAMES, depth - 1), max_size=4) if depth else st.just([])
    )
    return st.builds(
        lambda name, attributes, inner: Element(
            name, SPAN, attributes=attributes, children=[*inner]
        ),
        names,
        st.dictionaries(ATTRIBUTES, VALUES, max_size=5),
        children,
    )


@settings(max_examples=80, suppress_health_check=list(HealthCheck), deadline=None)
@given(elements(st.just("robot"), 4))
def test_no_tree_at_all_makes_the_check_fail(root: Element) -> None:
    reporter, advice = Reporter(), Reporter()
    check(
        root,
        reporter=reporter,
        advice=advice,
        resolve_mesh=lambda filename, span: None,
        package_fault=lambda name, span: ("install it", []),
    )
    for diagnostic in reporter.diagnostics + advice.diagnostics:
        assert diagnostic.hint
        assert render(diagnostic).startswith(("warning[", "error["))
