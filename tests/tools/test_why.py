"""`yamaro why`: the place, calls and variables that a value in the output comes from."""

from __future__ import annotations

import ast
import json
import math
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from numpy.typing import NDArray

from tests.later import Later
from yamaro import build
from yamaro.commands.main import main
from yamaro.sandbox.transfer import Outcome, from_bytes, to_bytes
from yamaro.source import Reading, RecordedSpan, Source, Span
from yamaro.tools.why.answers import Answer, addresses, answer
from yamaro.xml.tree import Element, Text

if TYPE_CHECKING:
    from trimesh.transformations import euler_matrix
else:
    euler_matrix = Later("trimesh.transformations", "euler_matrix")

EXAMPLES = Path(__file__).parents[2] / "examples"
SUFFIXES = ("", "_link", "_joint", "_optical", "_optical_joint")
"""What is put after the name of a part or sensor."""
PREFIXES = ("", "arm_", "left_", "right_")
"""What `attach` puts before names in the examples."""
ROBOTS = sorted(
    path
    for path in EXAMPLES.glob("*/*.yaml")
    if path.stem in (path.parent.name, "robot")  # the others are included by these
)
FIXED_BY = ("attach", "frame", "sensor")
"""The keys that make fixed joints."""
Row = NDArray[np.float64]
AXES = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}
UNITS = {
    "deg/s": math.pi / 180,
    "deg": math.pi / 180,
    "mm": 0.001,
    "cm": 0.01,
    "g": 0.001,
    "N*m": 1,
    "rpm": math.pi / 30,
}
WORDS = {"true": True, "false": False, "null": None}

ROBOT = """\
robot: crane
variables:
  reach: 0.8
functions:
  Arm(side, length):
  - part:
      name: $(side)_arm
      joint:
        type: revolute
        parent: base
        axis: 0 0 1
        limit: {lower: -1, upper: $(length * 2), effort: 1, velocity: 1}
      link:
        geometry: box
        scale: 1 1 $(length)
        mass: 2
model:
- part:
    name: base
    joint: {type: fixed, parent: root_link}
    link:
- for side in ['left', 'right']:
  - Arm: {side: $(side), length: "$(reach if side == 'left' else 0.5)"}
- gazebo/reference=base_link:
  - mu1: $(reach)
  - mu2: 0.4
"""


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("robot.yaml").write_text(ROBOT)
    return tmp_path


def outcome(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    status = main(list(words))
    captured = capsys.readouterr()
    return status, captured.out, captured.err


# --- the text of the place gives the value ----------------------------------------------------


def evaluated(text: str, variables: dict[str, Any]) -> str:
    """Return a text with each `$(…)` replaced, by Python and the variables of the answer alone."""
    start = text.find("$(")
    if start < 0:
        return text
    depth, end = 1, start + 2
    while depth:
        depth += {"(": 1, ")": -1}.get(text[end], 0)
        end += 1
    value = eval(text[start + 2 : end - 1], {**vars(math), **UNITS, **variables})
    return f"{text[:start]}{value}{evaluated(text[end:], variables)}"


def as_value(text: str) -> Any:
    try:
        return ast.literal_eval(text)
    except (ValueError, SyntaxError):
        return WORDS.get(text, text)


def number(word: str) -> float | None:
    try:
        return float(word)
    except ValueError:
        return None


def is_given(word: str, words: list[str]) -> bool:
    """Tell whether the words of a place give one: as it is, as a number, or as a part's name.

    The sign of a number may be another one: a pivot moves the shape the other way.
    """
    value = number(word)
    if value is not None:
        known = [0.0, *(abs(each) for each in map(number, words) if each is not None)]
        return any(math.isclose(abs(value), each, abs_tol=1e-12) for each in known)
    names = product(PREFIXES, words, SUFFIXES)
    return any(word == "".join(name) for name in names)


def text_at(span: Span) -> str:
    readings = getattr(span, "readings", ())
    text = span.written().strip("\"'")
    return evaluated(text, {each.name: as_value(each.value) for each in readings})


def words_at(span: Span) -> list[str]:
    text = text_at(span)
    for unit in UNITS:
        text = text.replace(f" {unit}", unit)
    words = text.replace(",", " ").replace("[", " ").replace("]", " ").split()
    return [part for word in words for part in AXES.get(word.lstrip("-"), in_si(word)).split()]


def in_si(word: str) -> str:
    """Return a number with a unit without it."""
    for unit, factor in UNITS.items():
        value = number(word.removesuffix(unit)) if word.endswith(unit) else None
        if value is not None:
            return repr(value * factor)
    return word


def gives(found: Answer) -> bool:
    """Tell whether the texts at the places of an answer give the value."""
    assert found.value is not None
    span = found.name_span or found.span
    words = words_at(span)
    if found.mirrors:  # all examples rename so
        words += [word.replace("left", "right") for word in words]
    if text_at(span) == found.value or all(is_given(word, words) for word in found.value.split()):
        return True
    if not found.others:
        return False
    value = np.array(found.value.split(), float)
    image = value * ((1, -1, 1) if found.mirrors else 1)
    return is_composed(image, [span, *found.others])


def is_composed(value: Row, spans: list[Span]) -> bool:
    """Tell whether a position is a sum of positions, some of which are turned by an `rpy`."""
    rows = {True: [], False: []}  # type: dict[bool, list[Row]]
    for span in spans:
        key = span.source.line_text(span.location()[0])[: span.location()[1] - 1]
        rows[key.rstrip().endswith("rpy:")].append(np.array(words_at(span), float))
    turns = [np.eye(3), *(euler_matrix(*row, "sxyz")[:3, :3] for row in rows[True])]
    terms = [[sign * turn @ row for turn in turns for sign in (1, -1)] for row in rows[False]]
    return any(np.allclose(value, sum(chosen), atol=1e-12) for chosen in product(*terms))


@pytest.mark.parametrize("path", ROBOTS, ids=lambda path: path.parent.name)
def test_every_value_of_an_example_has_a_place_whose_text_gives_it(path: Path) -> None:
    root = build(path, records=True, on_message=lambda line: None).root
    count = 0
    for address in addresses(root):
        found = answer(root, address)
        assert found.span.written(), address
        if found.is_derived:  # from the key at that place, which is in this file
            key = found.element.span.written()
            assert found.span.written() in found.span.source.text
            what = found.element.name, found.attribute
            assert what != ("mass", "value") or key == "density"
            assert what != ("joint", "type") or key.startswith(FIXED_BY)
        elif found.value is not None:
            count += 1
            assert gives(found), (address, found.value, found.span)
    assert count > 10


def test_only_computed_values_have_no_text_of_their_own() -> None:
    derived = set()
    for path in ROBOTS:
        root = build(path, records=True, on_message=lambda line: None).root
        answers = [answer(root, address) for address in addresses(root)]
        derived |= {(one.element.name, one.attribute) for one in answers if one.is_derived}
    moments = {("inertia", name) for name in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")}
    assumed = {("limit", name) for name in ("lower", "upper", "effort", "velocity")}
    poses = {("origin", "xyz"), ("origin", "rpy")}
    frames = {("joint", "type"), ("joint", "name"), ("parent", "link"), ("child", "link")}
    interfaces = {"command_interface", "state_interface", "sensor", "ros2_control", "param"}
    controls = {(each, "name") for each in interfaces} | {("ros2_control", "type")}
    others = {("robot", "name"), ("mass", "value")}
    assert derived <= moments | assumed | poses | frames | controls | others
    assert ("mass", "value") in derived  # of the hand, by density


def test_recording_changes_nothing_in_the_document() -> None:
    for path in ROBOTS:
        recorded = build(path, records=True, on_message=lambda line: None).xml()
        assert recorded == build(path, on_message=lambda line: None).xml()


# --- the command ------------------------------------------------------------------------------


def test_the_answer_names_place_variables_calls_and_urdf(
    capsys: pytest.CaptureFixture[str],
) -> None:
    status, out, err = outcome(capsys, "why", "robot.yaml", "left_arm_joint/limit@upper")
    assert (status, err) == (0, "")
    assert out == (
        "left_arm_joint/limit@upper = 1.6\n"
        " --> robot.yaml:12:35\n"
        "   |\n"
        "12 |         limit: {lower: -1, upper: $(length * 2), effort: 1, velocity: 1}\n"
        "   |                                   ^^^^^^^^^^^^^\n"
        "   = length = 0.8, set at robot.yaml:23:26\n"
        "   = in Arm, called at robot.yaml:23:5\n"
        '   = urdf: <joint name="left_arm_joint"> <limit upper="1.6">\n'
        '   = sdf: <joint name="left_arm_joint"> <axis> <limit> <upper> 1.6\n'
        '   = mjcf: <body name="left_arm_link"> <joint range="-1 1.6">\n'
    )


def test_each_turn_of_a_loop_has_its_own_variables(capsys: pytest.CaptureFixture[str]) -> None:
    out = outcome(capsys, "why", "robot.yaml", "right_arm_joint/limit@upper")[1]
    assert "length = 0.5" in out


def test_a_variable_of_the_command_line_is_named(capsys: pytest.CaptureFixture[str]) -> None:
    out = outcome(capsys, "why", "robot.yaml", "/gazebo/mu1", "reach:=3")[1]
    assert "reach = 3, set at <command line>" in out


def test_the_name_of_a_part_is_shown_where_it_is_written(
    capsys: pytest.CaptureFixture[str],
) -> None:
    out = outcome(capsys, "why", "robot.yaml", "left_arm_joint@name")[1]
    assert "name: $(side)_arm, at robot.yaml:7:13" in out
    assert "side = 'left', set at" in out


def test_a_mirrored_limit_leads_to_the_limit_that_it_was(
    capsys: pytest.CaptureFixture[str],
) -> None:
    Path("robot.yaml").write_text("""\
model:
- part:
    name: base
    joint: {type: fixed, parent: root_link}
- mirror:
    rename: {left: right}
    body:
    - part:
        name: left_arm
        joint:
          type: revolute
          parent: base
          axis: 0 0 1
          limit: {lower: -0.1, upper: 0.7, effort: 1, velocity: 1}
        link: {geometry: sphere, radius: 0.1, mass: 1, collision: }
""")
    out = outcome(capsys, "why", "robot.yaml", "right_arm_link/collision")[1]
    assert out.endswith('mjcf: <body name="right_arm_link"> <geom name="right_arm_collision">\n')
    out = outcome(capsys, "why", "robot.yaml", "right_arm_joint/limit@lower")[1]
    assert out == (
        "right_arm_joint/limit@lower = -0.7\n"
        " --> robot.yaml:14:39\n"
        "   |\n"
        "14 |           limit: {lower: -0.1, upper: 0.7, effort: 1, velocity: 1}\n"
        "   |                                       ^^^\n"
        "   = mirrored by 'mirror' at robot.yaml:5:3\n"
        '   = urdf: <joint name="right_arm_joint"> <limit lower="-0.7">\n'
        '   = sdf: <joint name="right_arm_joint"> <axis> <limit> <lower> -0.7\n'
        '   = mjcf: <body name="right_arm_link"> <joint range="-0.7 0.1">\n'
    )
    assert "mirrored" not in outcome(capsys, "why", "robot.yaml", "left_arm_joint/limit@lower")[1]
    out = outcome(capsys, "why", "robot.yaml", "right_arm_joint@name")[1]
    assert "name: left_arm, at robot.yaml:9:15\n" in out
    assert "and:" not in out


@pytest.mark.parametrize(
    ("address", "answer"),
    [
        ("rod_joint/axis@xyz", 'mjcf: <body name="rod_link"> <joint axis="0 1 0">'),
        ("rod_joint@type", 'sdf: <model name="pole"> <joint type="revolute">'),
        ("rod_joint/limit@effort", 'mjcf: <body name="rod_link"> <joint actuatorfrcrange="-5 5">'),
        ("rod_joint/origin", 'mjcf: <body name="base_link"> <body pos="0 0 1">'),
        ("rod_link/visual/origin@xyz", 'sdf: <visual name="rod_link_visual"> <pose> 0 0 0.2 0 0 0'),
    ],
)
def test_values_are_found_by_the_names_that_formats_have_for_them(
    capsys: pytest.CaptureFixture[str], address: str, answer: str
) -> None:
    # Sources: MuJoCo's XML reference (joint: axis, actuatorfrcrange; body: pos; geom: size), and
    # the specification of SDFormat (joint: type; visual: pose).
    Path("robot.yaml").write_text("""
robot: pole
base: fixed
model:
- part: {name: base}
- part:
    name: rod
    joint:
      type: revolute
      parent: base
      xyz: 0 0 1
      axis: y
      limit: {lower: -1, upper: 1, effort: 5, velocity: 2}
    link:
      geometry: cylinder
      scale: 0.02 0.5
      mass: 1
      visual: {xyz: 0 0 0.2}
""")
    out = outcome(capsys, "why", "robot.yaml", address)[1]
    assert answer in out


def test_a_value_that_is_not_written_leads_to_the_key_that_it_follows_from(
    capsys: pytest.CaptureFixture[str],
) -> None:
    out = outcome(capsys, "why", "robot.yaml", "left_arm_link/inertial/inertia@ixx")[1]
    assert "not written in the file; it follows from 'mass' here" in out


def test_an_element_is_answered_with_its_attributes(capsys: pytest.CaptureFixture[str]) -> None:
    out = outcome(capsys, "why", "robot.yaml", "joint:left_arm_joint/limit")[1]
    assert out.startswith("joint:left_arm_joint/limit\n --> robot.yaml:12:9\n")
    assert "  @upper = 1.6   robot.yaml:12:35\n" in out


@pytest.mark.parametrize("trust", [[], ["--jail"], ["--safe"]])
def test_json_is_the_same_however_far_the_file_is_trusted(
    capsys: pytest.CaptureFixture[str], trust: list[str]
) -> None:
    words = ["why", "robot.yaml", "left_arm_joint/limit@upper", "--json", *trust]
    status, out, err = outcome(capsys, *words)
    if "jail is not available" in err:
        pytest.skip("there is no jail here")
    assert (status, err) == (0, "")
    data = json.loads(out)
    assert data["value"] == "1.6"
    assert data["place"] == {
        "file": str(Path("robot.yaml").resolve()),
        "line": 12,
        "column": 35,
        "end_line": 12,
        "end_column": 48,
        "text": "$(length * 2)",
    }
    assert [(each["name"], each["value"]) for each in data["variables"]] == [("length", "0.8")]
    assert [(each["kind"], each["name"]) for each in data["steps"]] == [("called", "Arm")]
    assert data["formats"] == {
        "urdf": '<joint name="left_arm_joint"> <limit upper="1.6">',
        "sdf": '<joint name="left_arm_joint"> <axis> <limit> <upper> 1.6',
        "mjcf": '<body name="left_arm_link"> <joint range="-1 1.6">',
    }
    trusted = outcome(capsys, *words[:4], "--trust")[1]
    assert out == trusted


@pytest.mark.parametrize(
    ("address", "message"),
    [
        ("left_arm_jiont", "there is no link or joint 'left_arm_jiont'; did you mean"),
        ("base", "there is no link or joint 'base'; did you mean 'base_joint' or 'base_link'?"),
        ("link:base_joint", "there is no link 'base_joint'; did you mean 'base_link'?"),
        ("base_joint/limits", "<joint> has no child 'limits'; it has parent, child, origin"),
        ("left_arm_joint@xyz", "<joint> has no attribute 'xyz'; did you mean 'origin@xyz'?"),
        ("left_arm_joint/upper", "<joint> has no child 'upper'; did you mean 'limit@upper'?"),
        ("left_arm_joint/limit@uper", "<limit> has no attribute 'uper'; did you mean 'upper'?"),
        ("/joint[9]", "<robot> has 3 'joint', and '9' is not one of them"),
    ],
)
def test_an_unknown_address_is_wrong_usage(
    capsys: pytest.CaptureFixture[str], address: str, message: str
) -> None:
    status, out, err = outcome(capsys, "why", "robot.yaml", address)
    assert (status, out) == (2, "")
    assert message in err


def test_a_name_of_a_link_and_a_joint_has_to_be_told_apart(
    capsys: pytest.CaptureFixture[str],
) -> None:
    Path("x.urdf").write_text(
        '<robot name="x"><link name="a"/><link name="b"/>\n'
        '<joint name="b" type="fixed"><parent link="a"/><child link="b"/></joint></robot>'
    )
    status, _, err = outcome(capsys, "why", "x.urdf", "b")
    assert status == 2
    assert "'b' is ambiguous; write 'link:b' or 'joint:b'" in err
    assert outcome(capsys, "why", "x.urdf", "joint:b@type")[1].startswith("joint:b@type = fixed\n")


def test_the_address_is_needed(capsys: pytest.CaptureFixture[str]) -> None:
    status, _, err = outcome(capsys, "why", "robot.yaml")
    assert status == 2
    assert "'yamaro why' needs an ADDRESS after the file" in err
    status, _, err = outcome(capsys, "why", "robot.yaml", "base_link", "more")
    assert status == 2
    assert "unexpected argument 'more' after 'base_link'" in err


def test_what_a_place_holds_leaves_a_jail_with_the_tree() -> None:
    source = Source("a: $(b) c", name="robot.yaml")
    inner = RecordedSpan(Span(source, 8, 9), (Reading("c", "1", None),))
    name = RecordedSpan(Span(source, 0, 1), (Reading("d", "'x'", Span(source, 0, 1)),))
    reading = Reading("b", "0.5", Span(source, 3, 7))
    place = RecordedSpan(Span(source, 3, 7), (reading,), name_span=name, others=(inner,))
    root = Element("robot", place, {"name": "x"}, [Text("y", inner)])
    found = from_bytes(to_bytes(Outcome(root=root))).root
    assert found is not None
    span = found.span
    assert isinstance(span, RecordedSpan)
    assert span.written() == "$(b)"
    assert [(each.name, each.value) for each in span.readings] == [("b", "0.5")]
    assert span.readings[0].span is not None
    assert span.readings[0].span.written() == "$(b)"
    assert isinstance(span.name_span, RecordedSpan)
    assert span.name_span.readings[0].value == "'x'"
    assert [each.written() for each in span.others] == ["c"]
    text = found.children[0]
    assert isinstance(text, Text)
    assert isinstance(text.span, RecordedSpan)


def test_a_faulty_robot_is_reported_as_by_a_build(capsys: pytest.CaptureFixture[str]) -> None:
    Path("robot.yaml").write_text("model: {part: {name: $(nowhere)}}")
    status, out, err = outcome(capsys, "why", "robot.yaml", "base_link")
    assert (status, out) == (1, "")
    assert "error[undefined-name]" in err


# --- what formats make of it ------------------------------------------------------------------

IN_FORMATS = """\
model:
- part: {name: base, link: {geometry: sphere, radius: 1, mass: 1}}
- for i in range(2):
  - part:
      name: $(['arm', 'tip'][i])
      joint:
        type: continuous
        parent: $(['base', 'arm'][i])
        axis: z
        limit: {effort: 5, velocity: 2}
        dynamics: {damping: $(i + 0.5)}
      link: {geometry: sphere, radius: 1, mass: $(i + 1)}
"""

POSED = """\
model:
- part: {name: base, link: {geometry: sphere, radius: 1, mass: 1}}
- part:
    name: rod
    joint: {type: continuous, parent: base, xyz: 0 0 1, rpy: 0.5 0 0, axis: y}
    link: {geometry: sphere, radius: 1, xyz: 2 0 0, mass: 1, visual}
"""


@pytest.mark.parametrize(
    ("address", "format", "said"),
    [
        ("tip_joint/dynamics@damping", "mjcf", '<body name="tip_link"> <joint damping="1.5">'),
        ("arm_joint/dynamics@damping", "mjcf", '<body name="arm_link"> <joint damping="0.5">'),
        ("arm_joint/limit@velocity", "mjcf", "lost (velocity limits)"),
        ("tip_joint/limit@effort", "sdf", '<joint name="tip_joint"> <axis> <limit> <effort> 5'),
        ("tip_link/inertial/mass@value", "sdf", '<link name="tip_link"> <inertial> <mass> 2'),
        ("tip_link", "mjcf", '<body name="arm_link"> <body name="tip_link">'),
        ("arm_link", "sdf", '<model name="robot"> <link name="arm_link">'),
    ],
)
def test_each_format_says_what_it_makes_of_an_address(
    capsys: pytest.CaptureFixture[str], address: str, format: str, said: str
) -> None:
    Path("robot.yaml").write_text(IN_FORMATS, encoding="utf-8")
    out = outcome(capsys, "why", "robot.yaml", address)[1]
    assert f"= {format}: {said}\n" in out


@pytest.mark.parametrize("address", ["rod_joint/origin@xyz", "rod_joint/origin@rpy"])
def test_an_origin_is_a_pose_in_other_formats(
    capsys: pytest.CaptureFixture[str], address: str
) -> None:
    Path("robot.yaml").write_text(POSED, encoding="utf-8")
    out = outcome(capsys, "why", "robot.yaml", address)[1]
    assert '= sdf: <joint name="rod_joint"> <pose> 0 0 1 0.5 0 0\n' in out
    attribute = 'pos="0 0 1"' if address.endswith("xyz") else 'quat="'
    assert f'= mjcf: <body name="base_link"> <body {attribute}' in out


def test_the_origin_of_a_shape_is_its_own_pose(capsys: pytest.CaptureFixture[str]) -> None:
    Path("robot.yaml").write_text(POSED, encoding="utf-8")
    out = outcome(capsys, "why", "robot.yaml", "rod_link/visual/origin@xyz")[1]
    assert '= sdf: <visual name="rod_link_visual"> <pose> 2 0 0 0 0 0\n' in out
    assert '= mjcf: <body name="rod_link"> <geom pos="2 0 0">\n' in out


def test_an_address_can_be_one_in_another_format(capsys: pytest.CaptureFixture[str]) -> None:
    Path("robot.yaml").write_text(IN_FORMATS, encoding="utf-8")
    status, out, _ = outcome(
        capsys, "why", "--to", "mjcf", "robot.yaml", "body:tip_link/joint@damping"
    )
    assert status == 0
    assert out.startswith("body:tip_link/joint@damping = 1.5\n --> robot.yaml:11:29\n")
    assert '= urdf: <joint name="tip_joint"> <dynamics damping="1.5">\n' in out
    status, out, _ = outcome(capsys, "why", "--to", "sdf", "robot.yaml", "link:arm_link")
    assert (status, out.splitlines()[1]) == (0, " --> robot.yaml:12:7")


def test_an_address_in_a_format_that_is_not_written_is_wrong_usage(
    capsys: pytest.CaptureFixture[str],
) -> None:
    text = IN_FORMATS.replace("mass: $(i + 1)", "")
    Path("robot.yaml").write_text(text, encoding="utf-8")
    status, _, err = outcome(capsys, "why", "--to", "mjcf", "robot.yaml", "body:tip_link")
    assert status == 2
    assert "there is no mjcf of this robot: the link 'tip_link'" in err
    assert outcome(capsys, "why", "--to", "sdf,mjcf", "robot.yaml", "x")[0] == 2


@pytest.mark.parametrize("model", ["", " ~", " []", " {}"])
def test_why_of_an_empty_model_is_an_error(model: str, capsys: pytest.CaptureFixture[str]) -> None:
    Path("empty.yaml").write_text(f"model:{model}\n")
    status, _, err = outcome(capsys, "why", "empty.yaml", "a")
    assert status in (1, 2)
    assert "internal error" not in err
