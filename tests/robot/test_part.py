"""How a part becomes a joint and a link: every rule of the language's section on parts."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

import numpy
import pytest

from tests.later import Later
from tests.robot.part_builder import build, error_of, errors_of, lower_text, lower_tree
from yamaro.diagnostics import Frame, Reporter, YamaroError
from yamaro.robot.part import lower
from yamaro.xml.tree import Element, PartElement, Text

if TYPE_CHECKING:
    import trimesh
    from scipy.spatial.transform import Rotation
else:
    trimesh = Later("trimesh")
    Rotation = Later("scipy.spatial.transform", "Rotation")

WHEEL = """
part:
  name: wheel
  joint:
    type: continuous
    parent: base
    xyz: 1 0 0
    axis: 0 1 0
    limit: {lower: -1, upper: 1, effort: 10, velocity: 2}
  link:
    geometry: cylinder
    scale: 0.5 0.2
    mass: 1.0
    xyz: 0 0 0.1
    collision:
    visual/name=shell:
      material: {name: Black, color: 0 0 0 1, texture: tex.png}
"""


def link(body, **options):
    """Lower a part `a` with a link of this body, indented by any amount."""
    lines = "\n".join(f"    {line}" for line in body.strip("\n").splitlines())
    return lower_text(f"part:\n  name: a\n  link:\n{lines}\n", **options)


def joint(body, *, more=""):
    """Lower a part `a` with a joint of this body, and what else is written beside the part."""
    lines = "\n".join(f"    {line}" for line in body.strip("\n").splitlines())
    return lower_text(f"part:\n  name: a\n  joint:\n{lines}\n{more}")


def numbers(element, attribute):
    return [float(word) for word in str(element.attributes[attribute]).split()]


def matrix_of(origin):
    """Return the 4 × 4 matrix of an <origin>, by scipy."""
    matrix = numpy.eye(4)
    matrix[:3, :3] = Rotation.from_euler("xyz", numbers(origin, "rpy")).as_matrix()
    matrix[:3, 3] = numbers(origin, "xyz")
    return matrix


def names(elements):
    return [element.name for element in elements]


# --- the whole --------------------------------------------------------------------------------


def test_a_part_is_written_as_urdf_has_it():
    lowered = lower_text(WHEEL + "part: {name: base}")
    third = 1 / 12 * (3 * 0.5**2 + 0.2**2)
    assert lowered.find("joint").attributes == {"name": "wheel_joint", "type": "continuous"}
    assert names(lowered.find("joint").children) == ["parent", "child", "origin", "axis", "limit"]
    assert lowered.find("joint/parent").attributes == {"link": "base_link"}
    assert lowered.find("joint/child").attributes == {"link": "wheel_link"}
    assert lowered.find("joint/origin").attributes == {"xyz": "1 0 0", "rpy": "0 0 0"}
    assert lowered.find("joint/axis").attributes == {"xyz": "0 1 0"}
    assert list(lowered.find("joint/limit").attributes.items()) == [
        ("lower", "-1"),
        ("upper", "1"),
        ("effort", "10"),
        ("velocity", "2"),
    ]
    assert names(lowered.find("link").children) == ["inertial", "collision", "visual"]
    assert names(lowered.find("link/inertial").children) == ["origin", "mass", "inertia"]
    assert lowered.find("link/inertial/mass").attributes == {"value": "1.0"}
    inertia = lowered.find("link/inertial/inertia").attributes
    assert list(inertia) == ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]
    assert float(str(inertia["ixx"])) == pytest.approx(third)
    assert float(str(inertia["izz"])) == pytest.approx(0.125)
    assert [inertia[name] for name in ("ixy", "ixz", "iyz")] == ["0", "0", "0"]
    assert lowered.find("link/collision").attributes == {}
    assert names(lowered.find("link/collision").children) == ["origin", "geometry"]
    assert lowered.find("link/visual").attributes == {"name": "shell"}
    assert names(lowered.find("link/visual").children) == ["origin", "geometry", "material"]
    assert lowered.find("link/visual/origin").attributes == {"xyz": "0 0 0.1", "rpy": "0 0 0"}
    cylinder = lowered.find("link/visual/geometry/cylinder")
    assert cylinder.attributes == {"radius": "0.5", "length": "0.2"}
    assert lowered.find("link/visual/material").attributes == {"name": "Black"}
    assert lowered.find("link/visual/material/color").attributes == {"rgba": "0 0 0 1"}
    assert lowered.find("link/visual/material/texture").attributes == {"filename": "tex.png"}
    assert lowered.codes() == []


def test_a_tree_without_parts_is_returned_as_it_is():
    tree = build("link/name=a:")
    assert lower_tree(tree).tree is tree


def test_elements_without_parts_are_shared_and_the_input_is_not_changed():
    tree = build("gazebo: {static: true}\n" + WHEEL)
    gazebo, part = tree.children
    lowered = lower_tree(tree)
    assert lowered.tree.children[0] is gazebo
    assert tree.children == [gazebo, part]
    assert lower_tree(tree).xml == lowered.xml


def test_one_part_may_stand_in_a_tree_twice():
    tree = build(WHEEL)
    tree.children *= 2
    assert len(lower_tree(tree).find_all("link")) == 2


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("part: {name: a, joint: {type: fixed, parent: w}, link: }", ["joint", "link"]),
        ("part: {name: a, link: , joint: {type: fixed, parent: w}}", ["link", "joint"]),
        ("part: {link: , joint: {type: fixed, parent: w}, name: a}", ["link", "joint"]),
        ("part: {name: a, joint: {type: fixed, parent: w}}", ["joint", "link"]),
        ("part: {gazebo: , name: a, link: , sensor: }", ["link", "gazebo", "sensor"]),
        ("part: {name: a, gazebo: , joint: {type: fixed, parent: w}}", ["joint", "link", "gazebo"]),
    ],
)
def test_joint_and_link_come_in_the_order_written_then_what_stands_beside(text, expected):
    assert names(lower_text(text).tree.children) == expected


def test_a_part_in_the_list_form_is_the_same():
    text = "part:\n- name: a\n- joint:\n  - type: fixed\n  - parent: b\n- link:\n"
    same = "part: {name: a, joint: {type: fixed, parent: b}, link: }"
    assert lower_text(text).xml == lower_text(same).xml


def test_comments_stay_where_they_stand():
    lowered = link(
        "'#comment': first\ncollision: {'#comment': second, geometry: box, scale: 1 1 1}"
    )
    children = lowered.find("link").children
    assert [type(child).__name__ for child in children] == ["Comment", "Element"]
    assert (
        lowered.xml.index("first") < lowered.xml.index("<collision>") < lowered.xml.index("second")
    )


def test_a_part_under_a_part_follows_beside_it():
    lowered = lower_text("""
part:
  name: outer
  link:
  part: {name: inner, joint: {type: fixed, parent: outer}}
""")
    assert [e.attributes["name"] for e in lowered.tree.children] == [
        "outer_link",
        "inner_joint",
        "inner_link",
    ]


@pytest.mark.parametrize(
    "text",
    [
        "part: {name: a, link: {part: {name: b}}}",
        "part: {name: a, joint: {type: fixed, parent: b, part: {name: b}}}",
        "part: {name: a, link: {geometry: box, scale: 1 1 1, visual: {part: {name: b}}}}",
        "part: {name: a, link: {gazebo: {part: {name: b}}}}",
        "link/name=a: {part: {name: b}}",
    ],
)
def test_a_part_inside_a_joint_link_or_section_is_an_error(text):
    error = error_of(text)
    assert error.code == "misplaced-part"
    assert error.span.written() == "part"
    assert error.span.start == text.rindex("part")


def test_a_part_inside_another_element_is_lowered_with_a_warning():
    lowered = lower_text("group: {part: {name: a}}")
    assert lowered.find("group/link").attributes["name"] == "a_link"
    assert lowered.codes() == ["misplaced-part"]


def test_a_part_needs_a_robot():
    error = error_of("world: {part: {name: a}}", root="sdf")
    assert error.code == "part-outside-robot"
    assert error.span.written() == "part"
    assert "<sdf>" in error.message


def test_errors_of_all_parts_are_reported_together():
    errors = errors_of("""
part: {name: a, joint: {type: fixd, xyz: 1 2}, link: {visual: , collision: {geometry: bxo}}}
part: {name: b c d}
part: {link: }
""")
    assert [error.code for error in errors] == [
        "joint-type",
        "missing-parent",
        "wrong-count",
        "missing-geometry",
        "unknown-shape",
        "wrong-count",
        "missing-name",
    ]


def test_an_error_reached_many_times_is_told_once():
    tree = build("part: {name: a, joint: {type: fixd, parent: b}}")
    tree.children *= 100
    with pytest.raises(YamaroError) as caught:
        lower_tree(tree)
    assert len(caught.value.diagnostics) == 1


# --- names ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("wheel", ("wheel_joint", "wheel_link")),
        ("j l", ("j", "l")),
        ("'j, l'", ("j", "l")),
        ("[j, l]", ("j", "l")),
        ("3", ("3_joint", "3_link")),
        ("$(3)", ("3_joint", "3_link")),
    ],
)
def test_names_of_joint_and_link(name, expected):
    lowered = lower_text(f"part: {{name: {name}, joint: {{type: fixed, parent: w}}}}")
    found = (lowered.find("joint").attributes["name"], lowered.find("link").attributes["name"])
    assert found == expected
    assert lowered.find("joint/child").attributes["link"] == expected[1]


def test_a_joint_and_a_link_may_name_themselves():
    lowered = lower_text("""
part:
  name: a
  joint/name=j, extra=1: {type: fixed, parent: w}
  link/name=l, extra=2:
""")
    assert list(lowered.find("joint").attributes.items()) == [
        ("name", "j"),
        ("type", "fixed"),
        ("extra", "1"),
    ]
    assert lowered.find("link").attributes == {"name": "l", "extra": "2"}
    assert lowered.find("joint/child").attributes == {"link": "l"}


def test_a_part_whose_joint_and_link_name_themselves_needs_no_name():
    lowered = lower_text("part: {joint/name=j: {type: fixed, parent: w}, link/name=l: }")
    assert lowered.find("joint").attributes["name"] == "j"
    assert lower_text("part: {link/name=l: }").find("link").attributes == {"name": "l"}


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("part: {link: }", "missing-name"),
        ("part: {joint: {type: fixed, parent: w}, link/name=l: }", "missing-name"),
        ("part: {name: , link: }", "empty-value"),
        ("part: {name: '', link: }", "missing-name"),
        ("part: {name: a b c, link: }", "wrong-count"),
    ],
)
def test_faulty_names(text, code):
    assert error_of(text).code == code


# --- given once -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text",
    [
        "part: {name: a, name: b}",
        "part: {name: a, link: , link: }",
        "part: {name: a, link: {xyz: 1 0 0, xyz: 2 0 0}}",
        "part: {name: a, joint: {type: fixed, type: fixed, parent: b}}",
        "part: {name: a, joint: {type: fixed, parent: b, axis: 1 0 0, axis: 1 0 0}}",
        "part: {name: a, joint: {type: fixed, parent: b, limit: {effort: 1, effort: 2}}}",
        "part: {name: a, link: {visual: {geometry: sphere, scale: 1, scale: 1}}}",
        "part: {name: a, material: {name: red, texture: b, texture: c}}",
    ],
)
def test_a_key_given_twice_in_one_mapping_names_both_places(text):
    error = error_of(text)
    assert error.code == "given-twice"
    key = error.span.written()
    assert error.span.start == text.rindex(f"{key}:")
    first = text.index(f"{key}:") + 1
    assert error.notes == (f"first given at robot.yaml:1:{first}",)


def test_a_key_reached_twice_by_other_ways_takes_the_last():
    tree = build("part: {name: a, link: {xyz: 1 0 0, visual: {geometry: box, scale: 1 1 1}}}")
    other = build("xyz: 2 0 0").children[0]
    part_link = tree.children[0].children[1]
    part_link.children.append(other)
    origin = lower_tree(tree).find("link/visual/origin")
    assert origin.attributes["xyz"] == "2 0 0"


def test_a_key_reached_again_at_the_same_place_takes_the_last():
    tree = build("part: {name: a, link: {mass: 1, geometry: box, scale: 1 1 1}}")
    part_link = tree.children[0].children[1]
    mass = part_link.children[0]
    again = Element("mass", mass.span, children=[Text("2", mass.span)], body=mass.body)
    part_link.children.append(again)
    lowered = lower_tree(tree)
    assert [e.attributes["value"] for e in lowered.find_all("link/inertial/mass")] == ["2"]


def test_a_key_in_two_calls_of_a_function_is_not_given_twice():
    tree = build("part: {name: a, name: b}")
    span = tree.span
    for child in tree.children[0].children:
        child.trace = Frame("called", "Name", span, parent=None)
    assert lower_tree(tree).find("link").attributes["name"] == "b_link"


def test_collision_and_visual_may_repeat():
    lowered = link("geometry: box\nscale: 1 1 1\nvisual:\nvisual:\ncollision:\ncollision:")
    assert names(lowered.find("link").children) == ["visual", "visual", "collision", "collision"]


def test_a_joint_reached_twice_by_other_ways_is_written_once():
    tree = build("part: {name: a, joint: {type: fixed, parent: b}, link: }")
    other = build("joint: {type: floating, parent: b}").children[0]
    tree.children[0].children.append(other)
    lowered = lower_tree(tree)
    assert [e.attributes["type"] for e in lowered.find_all("joint")] == ["floating"]


def test_a_key_whose_expression_is_none_is_left_out():
    lowered = link("xyz: $(None)\nmass: $(None)\ngeometry: box\nscale: 1 1 1\ncollision:")
    assert names(lowered.find("link").children) == ["collision"]
    assert lowered.find("link/collision/origin").attributes["xyz"] == "0 0 0"


# --- joints -----------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["continuous", "fixed", "floating", "planar"])
def test_joint_types_without_limits(kind):
    lowered = joint(f"type: {kind}\nparent: w")
    assert lowered.find("joint").attributes["type"] == kind
    assert names(lowered.find("joint").children) == ["parent", "child", "origin"]
    assert lowered.codes() == []


def test_urdfs_own_forms_in_a_joint():
    lowered = lower_text("""
part:
  name: a
  joint/type=continuous:
    origin/xyz=1 2 3, rpy=0 0 0.5:
    parent/link=w:
    axis/xyz=0 0 1:
    limit/effort=1, velocity=2:
    dynamics/damping=0.1: {friction: 0.2}
""")
    assert lowered.find("joint").attributes == {"name": "a_joint", "type": "continuous"}
    assert names(lowered.find("joint").children) == [
        "parent",
        "child",
        "origin",
        "axis",
        "limit",
        "dynamics",
    ]
    assert lowered.find("joint/origin").attributes == {"xyz": "1 2 3", "rpy": "0 0 0.5"}
    assert lowered.find("joint/parent").attributes == {"link": "w"}
    assert lowered.find("joint/axis").attributes == {"xyz": "0 0 1"}
    assert lowered.find("joint/limit").attributes == {"effort": "1", "velocity": "2"}
    assert lowered.find("joint/dynamics").attributes == {"damping": "0.1", "friction": "0.2"}


@pytest.mark.parametrize(
    ("body", "code", "underlined", "hint"),
    [
        ("parent: w", "missing-type", "joint", "type: with one of"),
        ("type: fixed", "missing-parent", "joint", "parent:"),
        ("type: fixed\nparent:", "missing-parent", "parent", "parent:"),
        ("type: fixd\nparent: w", "joint-type", "fixd", "did you mean 'fixed'?"),
        ("type: Fixed\nparent: w", "joint-type", "Fixed", "did you mean 'fixed'?"),
        ("type: ball\nparent: w", "joint-type", "ball", "chain three revolute joints"),
        ("type: spring\nparent: w", "joint-type", "spring", "the types are revolute"),
        ("type:\nparent: w", "empty-value", "type", "write a value"),
        ("type: fixed\nparent: w\nchild: x", "child-given", "child", "remove 'child'"),
        ("type: fixed\nparent: w\naxis:", "empty-value", "axis", "axis: 0 0 1"),
        ("type: fixed\nparent: w\naxis: 0 0", "wrong-count", "0 0", "x y z"),
        ("type: fixed\nparent: w\nmimic: {offset: 1}", "empty-value", "mimic", "mimic:"),
        ("type: fixed\nparent: w\nlimit: 1", "attributes-expected", "1", "limit: {lower"),
        ("type: fixed\nparent: w\nlimit: {lower: low}", "bad-number", "low", "$(low)"),
        ("type: fixed\nparent: w\nlimit: {lower: .inf}", "bad-number", ".inf", "NaN"),
        ("type: fixed\nparent: [a, b]", "value-expected", "[a, b]", "without brackets"),
        ("type: fixed\nparent: {x/y=1: }", "missing-parent", "parent", "parent:"),
        ("type: fixed\nparent: w\ntext", "unexpected-text", "text", "type: fixed"),
    ],
)
def test_faulty_joints(body, code, underlined, hint):
    if body.endswith("text"):
        body = body.replace("\ntext", "\n'#text': text")
    try:
        joint(body)
    except YamaroError as error:
        (diagnostic,) = error.diagnostics
    assert diagnostic.code == code
    assert diagnostic.span.written() == underlined
    assert (hint is None and diagnostic.hint is None) or hint in (diagnostic.hint or "")


def test_a_type_given_in_two_ways_is_an_error():
    error = error_of("part: {name: a, joint/type=fixed: {type: fixed, parent: b}}")
    assert error.code == "given-twice"


def test_an_attribute_given_in_two_ways_is_an_error():
    text = "part: {name: a, joint: {type: continuous, parent: b, limit/effort=1: {effort: 2}}}"
    error = error_of(text)
    assert error.code == "given-twice"
    assert error.notes == (f"first given at robot.yaml:1:{text.index('=1') + 2}",)


def test_what_a_mapping_of_attributes_holds_besides_is_kept():
    lowered = joint("type: fixed\nparent: w\ndynamics: {damping: 1, <x>: 2, y: {z: 1}}")
    assert names(lowered.find("joint/dynamics").children) == ["x", "y"]
    assert lowered.find("joint/dynamics").attributes == {"damping": "1"}


# --- parents and mimic ------------------------------------------------------------------------


def test_a_parent_is_resolved_whatever_the_order():
    lowered = lower_text("""
part: {name: arm, joint: {type: fixed, parent: base}}
part: {name: base}
""")
    assert lowered.find("joint/parent").attributes == {"link": "base_link"}


def test_an_exact_link_name_wins_over_a_part():
    lowered = lower_text("""
part: {name: arm, joint: {type: fixed, parent: base}}
part: {name: base}
link/name=base:
""")
    assert lowered.find("joint/parent").attributes == {"link": "base"}


def test_a_part_whose_link_names_itself_is_found_by_its_own_name():
    lowered = lower_text("""
part: {name: base, link/name=chassis: }
part: {name: arm, joint: {type: fixed, parent: base}}
""")
    assert lowered.find("joint/parent").attributes == {"link": "chassis"}


def test_an_unknown_parent_is_kept_as_written():
    lowered = joint("type: fixed\nparent: nowhere")
    assert lowered.find("joint/parent").attributes == {"link": "nowhere"}


def test_a_plain_joints_parent_is_kept_as_written():
    lowered = lower_text("part: {name: base}\njoint/name=j: {parent/link=base: }")
    assert lowered.find("joint/parent").attributes == {"link": "base"}


@pytest.mark.parametrize("mimic", ["mimic: arm", "mimic: {joint: arm}", "mimic/joint=arm:"])
def test_mimic_names_a_joint_or_a_part(mimic):
    body = f"type: continuous\nparent: w\n{mimic}"
    by_part = joint(body, more="part: {name: arm, joint: {type: fixed, parent: w}}")
    assert by_part.find("joint/mimic").attributes == {"joint": "arm_joint"}
    by_joint = joint(body, more="joint/name=arm: {parent/link=w: }")
    assert by_joint.find("joint/mimic").attributes == {"joint": "arm"}
    unknown = joint(body)
    assert unknown.find("joint/mimic").attributes == {"joint": "arm"}


def test_mimic_takes_its_numbers():
    lowered = joint("type: continuous\nparent: w\nmimic: {joint: j, multiplier: -1.0, offset: 0}")
    expected = {"joint": "j", "multiplier": "-1.0", "offset": "0"}
    assert lowered.find("joint/mimic").attributes == expected


def test_root_link_is_put_first_when_a_part_wants_it():
    lowered = lower_text(
        "material/name=m:\npart: {name: a, joint: {type: fixed, parent: root_link}}"
    )
    assert names(lowered.tree.children) == ["link", "material", "joint", "link"]
    assert lowered.find("link").attributes == {"name": "root_link"}
    assert lowered.find("link").span.written() == "root_link"


@pytest.mark.parametrize(
    "more",
    ["link/name=root_link:", "part: {name: root_link}", "part: {name: j root_link}"],
)
def test_root_link_is_not_added_when_it_is_there(more):
    lowered = joint("type: fixed\nparent: root_link", more=more)
    assert len(lowered.find_all("link")) == 2


def test_root_link_is_not_added_for_plain_joints():
    lowered = lower_text("part: {name: a}\njoint/name=j: {parent/link=root_link: }")
    assert len(lowered.find_all("link")) == 1


# --- limits -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("kind", "limit", "expected"),
    [
        ("revolute", "", {"lower": -pi, "upper": pi, "effort": 100, "velocity": 10}),
        ("prismatic", "", {"lower": -1, "upper": 1, "effort": 100, "velocity": 10}),
        ("revolute", "limit:", {"lower": -pi, "upper": pi, "effort": 100, "velocity": 10}),
        ("revolute", "limit: {lower: 0}", {"lower": 0, "effort": 100, "velocity": 10}),
        ("revolute", "limit: {upper: 2, effort: 5}", {"upper": 2, "effort": 5, "velocity": 10}),
        (
            "prismatic",
            "limit/effort=5, velocity=6:",
            {"lower": -1, "upper": 1, "effort": 5, "velocity": 6},
        ),
    ],
)
def test_missing_limits_are_filled_in_with_one_warning(kind, limit, expected):
    lowered = joint(f"type: {kind}\nparent: w\n{limit}")
    found = lowered.find("joint/limit").attributes
    assert {name: float(str(value)) for name, value in found.items()} == pytest.approx(expected)
    (warning,) = lowered.warnings
    assert warning.code == "assumed-limit"
    assert warning.span.written() == (limit.partition(":")[0] if limit else "type")
    for name in ("lower", "upper", "effort", "velocity"):
        was_filled = name in expected and f"{name}:" not in limit and f"{name}=" not in limit
        assert (f"{name}=" in warning.message) == was_filled


@pytest.mark.parametrize(
    "limit",
    [
        "limit: {lower: 0, upper: 1, effort: 1, velocity: 1}",
        "limit/upper=1, effort=1, velocity=1:",
        "<limit/effort=1>:",
    ],
)
def test_a_limit_that_is_given_is_kept_without_warning(limit):
    lowered = joint(f"type: revolute\nparent: w\n{limit}")
    assert lowered.codes() == []
    assert len(lowered.find_all("joint/limit")) == 1


def test_a_faulty_limit_is_not_also_assumed():
    tree = build("part: {name: a, joint: {type: revolute, parent: w, limit: {lower: low}}}")
    with pytest.raises(YamaroError) as caught:
        lower_tree(tree)
    assert [error.code for error in caught.value.diagnostics] == ["bad-number"]


# --- numbers ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ("1.0 0 0.50", "1.0 0 0.50"),
        ("'1.0, 0,0.50'", "1.0 0 0.50"),
        ("[1.0, 0, 0.50]", "1.0 0 0.50"),
        ("'  1   2\t3 '", "1 2 3"),
        ("1e-3 +2 .5", "1e-3 +2 .5"),
        ("0x10 0o17 007", "16 15 007"),
        ("'$([1, 2.5, 3])'", "1 2.5 3"),
        ("$((1, 2, 3))", "1 2 3"),
        ("$(numpy.array([1, 0.5, 0.1 + 0.2]))", "1.0 0.5 0.3"),
        ("$('1 2.50 3')", "1 2.50 3"),
        ("[$(1 / 4), 0, $(numpy.float32(0.5))]", "0.25 0 0.5"),
        ("'$([1e-17, 0, -1e-13])'", "0 0 0"),
        ("$(range(3))", "0 1 2"),
        ("'$([__import__(\"fractions\").Fraction(1, 4), 0, 0])'", "0.25 0 0"),
    ],
)
def test_numbers_in_every_form(value, expected):
    lowered = joint(f"type: fixed\nparent: w\nxyz: {value}")
    assert lowered.find("joint/origin").attributes["xyz"] == expected


@pytest.mark.parametrize(
    ("value", "code", "underlined"),
    [
        ("1 2", "wrong-count", "1 2"),
        ("1 2 3 4", "wrong-count", "1 2 3 4"),
        ("1", "wrong-count", "1"),
        ("$(1.5)", "wrong-count", "$(1.5)"),
        ("''", "empty-value", "xyz"),
        ("1 two 3", "bad-number", "two"),
        ("1 1_0 3", "bad-number", "1_0"),
        ("1 .nan 3", "bad-number", ".nan"),
        ("1 nan 3", "bad-number", "nan"),
        ("1 2 -.Inf", "bad-number", "-.Inf"),
        ("0 0 1e400", "bad-number", "1e400"),
        ("0 0 0x", "bad-number", "0x"),
        ("'0 0 10°'", "bad-number", "10°"),
        ("[1, two, 3]", "bad-number", "two"),
        ("[[1, 2, 3]]", "bad-number", "[[1, 2, 3]]"),
        ("[1, '', 3]", "bad-number", "[1, '', 3]"),
        ("$([1, True, 3])", "bad-number", "$([1, True, 3])"),
        ("$([1, None, 3])", "bad-number", "$([1, None, 3])"),
        ("$([1, float('nan'), 3])", "bad-number", "$([1, float('nan'), 3])"),
        ("$([1, 10 ** 400, 3])", "bad-number", "$([1, 10 ** 400, 3])"),
        ("$(numpy.eye(3))", "bad-number", "$(numpy.eye(3))"),
        ("$(dict(a=1))", "bad-number", "$(dict(a=1))"),
        ("$(1j)", "bad-number", "$(1j)"),
        ("\u0661 2 3", "bad-number", "\u0661"),  # ARABIC-INDIC DIGIT ONE
    ],
)
def test_faulty_numbers_are_underlined(value, code, underlined):
    error = error_of(
        f"part:\n  name: a\n  link:\n    collision:\n    xyz: {value}\n"
        "    geometry: box\n    scale: 1 1 1\n"
    )
    assert error.code == code
    assert error.span.written() == underlined
    assert "xyz" in error.message


@pytest.mark.parametrize(
    ("value", "hint"),
    [
        ("length 0 0", "to use a variable or an expression, write $(length)"),
        ("90° 0 0", "write 90deg"),
        ("pi/2 0 0", "write an expression in $(…): $(pi/2)"),
        ("1,,x 0", "to use a variable or an expression, write $(x)"),
        ("nan 0 0", "URDF parsers reject NaN and infinities; write a number"),
        ("'# 0 0'", "'rpy' takes roll pitch yaw, in radians"),
    ],
)
def test_the_hint_for_a_word_shows_what_to_write(value, hint):
    text = f"part:\n  name: a\n  link:\n    rpy: {value}\n"
    assert error_of(text).hint == hint


def test_an_element_in_place_of_numbers_is_an_error():
    error = error_of("part: {name: a, link: {xyz: {x: 1}}}")
    assert error.code == "value-expected"
    assert error.span.written() == "x"


def test_attributes_in_place_of_numbers_are_an_error():
    error = error_of("part:\n  name: a\n  link:\n    xyz/x=1:\n")
    assert error.code == "value-expected"


# --- poses ------------------------------------------------------------------------------------

BOX = "geometry: box\nscale: 1 1 1\n"


@pytest.mark.parametrize(
    ("link_pose", "section_pose", "xyz", "rpy"),
    [
        ("", "", "0 0 0", "0 0 0"),
        ("xyz: 1.0 0 0.50", "", "1.0 0 0.50", "0 0 0"),
        ("", "xyz: 1.0 0 0.50", "1.0 0 0.50", "0 0 0"),
        ("rpy: 0.10 0 0", "", "0 0 0", "0.10 0 0"),
        ("rpy: 0.10 0 0", "xyz: 0.0 0.0 0.0", "0 0 0", "0.10 0 0"),
        ("xyz: 1.0 0 0", "rpy: 0 0 1.570", "1.0 0 0", "0 0 1.570"),
        ("rpy: 0 0 1.570", "rpy: 0 0 0", "0 0 0", "0 0 1.570"),
        ("xyz: 1.0 0 0", "xyz: 0 2.0 0.250", "1.0 2.0 0.250", "0 0 0"),
        ("xyz: 1.0 0 0", "xyz: 0.5 0 0", "1.5 0 0", "0 0 0"),
        ("xyz: 1.0 0 0", "pivot: 0 0 0", "1.0 0 0", "0 0 0"),
        ("xyz: 0.10 0 0", "pivot: 0 0 -0.25", "0.10 0 0.25", "0 0 0"),
        ("", "pivot: 0 0 -0.25", "0 0 0.25", "0 0 0"),
        ("xyz: 0.1 0 0", "xyz: 0.2 0 0", "0.3 0 0", "0 0 0"),
        ("xyz: 1 0 0", "xyz: -1 0 0", "0 0 0", "0 0 0"),
        ("rpy: 7.0 0 0", "", "0 0 0", "7.0 0 0"),
    ],
)
def test_poses_keep_their_spelling_where_nothing_is_computed(link_pose, section_pose, xyz, rpy):
    section = section_pose.replace("\n", ", ")
    lowered = link(f"{BOX}{link_pose}\ncollision: {{{section}}}")
    assert lowered.find("link/collision/origin").attributes == {"xyz": xyz, "rpy": rpy}


def test_a_cylinder_stands_on_xyz_by_its_pivot():
    lowered = link("geometry: cylinder\nscale: 0.1 0.5\nxyz: 0 0 1\npivot: 0 0 -0.25\nvisual:")
    assert lowered.find("link/visual/origin").attributes["xyz"] == "0 0 1.25"


def test_the_pivot_of_a_joint_is_in_its_own_rotated_axes():
    lowered = joint("type: fixed\nparent: w\nxyz: 1 2 3\nrpy: 0.3 -0.4 1.2\npivot: 0.5 0.6 -0.7")
    matrix = matrix_of(lowered.find("joint/origin"))
    assert matrix @ [0.5, 0.6, -0.7, 1] == pytest.approx([1, 2, 3, 1], abs=1e-12)
    assert lowered.find("joint/origin").attributes["rpy"] == "0.3 -0.4 1.2"


def test_a_sections_pose_is_given_in_the_links_pose():
    lowered = link(
        f"{BOX}xyz: 1 2 3\nrpy: 0.3 -0.4 1.2\npivot: 0.1 0 0\n"
        "visual: {xyz: 0.5 0 0.25, rpy: -1 0.2 0.7, pivot: 0 0.3 0}"
    )

    def by_scipy(xyz, rpy, pivot):
        rotation = Rotation.from_euler("xyz", rpy)
        matrix = numpy.eye(4)
        matrix[:3, :3] = rotation.as_matrix()
        matrix[:3, 3] = numpy.array(xyz) - rotation.apply(pivot)
        return matrix

    T_joint_link = by_scipy([1, 2, 3], [0.3, -0.4, 1.2], [0.1, 0, 0])
    T_link_visual = by_scipy([0.5, 0, 0.25], [-1, 0.2, 0.7], [0, 0.3, 0])
    found = matrix_of(lowered.find("link/visual/origin"))
    numpy.testing.assert_allclose(found, T_joint_link @ T_link_visual, atol=1e-12)


def test_rotations_are_composed_and_not_added():
    lowered = link(f"{BOX}rpy: 1.5707963267948966 0 0\nvisual: {{rpy: 0 0 1.5707963267948966}}")
    matrix = matrix_of(lowered.find("link/visual/origin"))[:3, :3]
    # Rx(90°)·Rz(90°): x goes to z, z goes to -y.
    numpy.testing.assert_allclose(matrix @ [1, 0, 0], [0, 0, 1], atol=1e-12)
    numpy.testing.assert_allclose(matrix @ [0, 0, 1], [0, -1, 0], atol=1e-12)


def test_two_rotations_about_one_axis_add_up_without_noise():
    lowered = link(f"{BOX}rpy: 0 0 0.5\nvisual: {{rpy: 0 0 0.25}}")
    assert lowered.find("link/visual/origin").attributes["rpy"] == "0 0 0.75"


def test_opposite_rotations_give_plain_zeros():
    lowered = link(f"{BOX}rpy: 0.3 0 0\nvisual: {{rpy: -0.3 0 0}}")
    assert lowered.find("link/visual/origin").attributes["rpy"] == "0 0 0"


def test_a_computed_component_of_rounding_size_is_zero():
    lowered = joint("type: fixed\nparent: w\nrpy: 0 0 3.141592653589793\npivot: 1 0 0")
    assert lowered.find("joint/origin").attributes["xyz"] == "1.0 0 0"


def test_an_origin_beside_xyz_is_an_error():
    error = error_of("part:\n  name: a\n  link:\n    origin/xyz=1 0 0:\n    rpy: 1 0 0\n")
    assert error.code == "given-twice"
    assert error.span.written() == "rpy"


def test_an_unknown_attribute_of_an_origin_is_an_error():
    error = error_of("part:\n  name: a\n  link:\n    origin/quat_xyzw=0 0 0 1:\n")
    assert error.code == "unknown-key"
    assert "<origin>:" in (error.hint or "")


def test_an_origin_in_a_section_is_its_pose_in_the_link():
    lowered = link(f"{BOX}xyz: 1 0 0\nvisual: {{origin: {{xyz: 0 2 0}}}}")
    assert lowered.find("link/visual/origin").attributes == {"xyz": "1 2 0", "rpy": "0 0 0"}


def test_a_position_too_large_for_a_number_is_an_error():
    error = error_of(
        "part:\n  name: a\n  joint:\n    type: fixed\n    parent: w\n"
        "    xyz: 1e308 0 0\n    pivot: -1e308 0 0\n"
    )
    assert error.code == "bad-number"


# --- geometry ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("geometry", "scale", "element", "attributes"),
    [
        ("box", "1.0 2 3", "box", {"size": "1.0 2 3"}),
        ("Box", "1 2 3", "box", {"size": "1 2 3"}),
        ("cylinder", "0.5 0.20", "cylinder", {"radius": "0.5", "length": "0.20"}),
        ("SPHERE", "0.10", "sphere", {"radius": "0.10"}),
        ("sphere", "$(1 / 4)", "sphere", {"radius": "0.25"}),
        ("capsule", "0.1 0.5", "capsule", {"radius": "0.1", "length": "0.5"}),
        ("a.stl", "1 1 -1", "mesh", {"filename": "a.stl", "scale": "1 1 -1"}),
        ("package://p/Arm.DAE", None, "mesh", {"filename": "package://p/Arm.DAE"}),
    ],
)
def test_shapes(geometry, scale, element, attributes):
    more = f"\nscale: {scale}" if scale else ""
    lowered = link(f"geometry: {geometry}{more}\ncollision:")
    assert lowered.find(f"link/collision/geometry/{element}").attributes == attributes


@pytest.mark.parametrize(
    ("body", "code", "underlined", "hint"),
    [
        ("geometry: clyinder\nscale: 1 1", "unknown-shape", "clyinder", "did you mean 'cylinder'?"),
        ("geometry: cone\nscale: 1 1", "unknown-shape", "cone", "the shapes are box"),
        ("geometry: arm.xyz", "unknown-shape", "arm.xyz", "the extensions of mesh files are"),
        ("geometry: 3", "unknown-shape", "3", "the shapes are"),
        ("geometry:", "empty-value", "geometry", "write a value"),
        ("geometry: box", "missing-scale", "geometry", "scale: 0.4 0.3 0.2 (x y z)"),
        ("geometry: box\nscale: 1 2", "wrong-count", "1 2", "x y z"),
        ("geometry: sphere\nscale: 1 2", "wrong-count", "1 2", "radius"),
        ("geometry: cylinder\nscale: 1 2 3", "wrong-count", "1 2 3", "radius length"),
        ("geometry: a.stl\nscale: 2 2", "wrong-count", "2 2", "a factor for x, y and z"),
        ("geometry: {box/size=1 2 3: }", "geometry-as-xml", "box/size=1 2 3", "scale: 1 2 3"),
        (
            "geometry:\n  cylinder/radius=1, length=2:",
            "geometry-as-xml",
            "cylinder/radius=1, length=2",
            "geometry: cylinder and scale: 1 2",
        ),
        (
            "geometry: {mesh/filename=a.stl: }",
            "geometry-as-xml",
            "mesh/filename=a.stl",
            "geometry: a.stl",
        ),
        ("geometry: {cone: }", "geometry-as-xml", "cone", "<geometry>:"),
        ("", "missing-geometry", "visual", "geometry: box"),
        ("geometry: [box]\nscale: 1", "value-expected", "[box]", "without brackets"),
    ],
)
def test_faulty_geometry(body, code, underlined, hint):
    with pytest.raises(YamaroError) as caught:
        link(f"{body}\nvisual:")
    (error,) = caught.value.diagnostics
    assert error.code == code
    assert error.span.written() == underlined
    assert hint in (error.hint or "")


def test_a_section_with_its_own_geometry_takes_its_own_scale():
    lowered = link("geometry: box\nscale: 1 2 3\ncollision: {geometry: sphere, scale: 4}\nvisual:")
    assert lowered.find("link/collision/geometry/sphere").attributes == {"radius": "4"}
    assert lowered.find("link/visual/geometry/box").attributes == {"size": "1 2 3"}


def test_a_section_with_its_own_geometry_does_not_inherit_the_scale():
    with pytest.raises(YamaroError) as caught:
        link("geometry: box\nscale: 1 2 3\ncollision: {geometry: box}\nvisual:")
    (error,) = caught.value.diagnostics
    assert error.code == "missing-scale"
    assert error.notes == ("the link's scale at robot.yaml:5:5 belongs to the link's own geometry",)


def test_a_section_with_its_own_mesh_has_the_scale_one():
    lowered = link("geometry: box\nscale: 1 2 3\ncollision:\nvisual: {geometry: a.stl}")
    assert lowered.find("link/visual/geometry/mesh").attributes == {"filename": "a.stl"}


def test_a_section_with_only_a_scale_is_the_links_shape_in_that_size():
    lowered = link("geometry: box\nscale: 1 2 3\ncollision: {scale: 4 5 6}\nvisual:")
    assert lowered.find("link/collision/geometry/box").attributes == {"size": "4 5 6"}


@pytest.mark.parametrize(
    "body",
    [
        "geometry: box\nscale: 1 1 1",
        "geometry: box\nscale: 1 1 1\ncollision: {geometry: sphere, scale: 1}",
        "geometry: box\nscale: 1 1 1\ninertial: {mass: 1, inertia: 1 0 0 1 0 1}",
        "scale: 1 1 1",
    ],
)
def test_a_geometry_that_no_section_uses_is_a_warning(body):
    lowered = link(body)
    assert lowered.codes() == ["unused-geometry"]
    assert lowered.warnings[0].span.written() == body.partition(":")[0]


@pytest.mark.parametrize(
    ("version", "codes"),
    [
        (None, ["capsule-needs-urdf-1.1"]),
        ("1.0", ["capsule-needs-urdf-1.1"]),
        ("1", ["capsule-needs-urdf-1.1"]),
        ("1.1", []),
        (1.1, []),
        ("1.2", []),
        ("1.10", []),
    ],
)
def test_a_capsule_wants_a_robot_of_urdf_1_1(version, codes):
    attributes = {"name": "r"} if version is None else {"name": "r", "version": version}
    text = "part: {name: a, link: {geometry: capsule, scale: 1 1, visual: , collision: }}"
    tree = build(text)
    tree.attributes = attributes
    assert lower_tree(tree).codes() == codes


# --- mass and inertia -------------------------------------------------------------------------


def inertia_of(lowered):
    attributes = lowered.find("link/inertial/inertia").attributes
    order = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    assert tuple(attributes) == order
    return [float(str(attributes[name])) for name in order]


def test_density_gives_the_mass_by_the_volume():
    lowered = link("geometry: box\nscale: 1 2 3\ndensity: 2")
    assert float(str(lowered.find("link/inertial/mass").attributes["value"])) == 12
    assert inertia_of(lowered) == pytest.approx([13, 0, 0, 10, 0, 5])


@pytest.mark.parametrize(
    "body",
    [
        "geometry: box\nscale: 1 2 3\nmass: 12",
        "geometry: box\nscale: 1 2 3\nmass: 12\ninertial:",
        "geometry: box\nscale: 1 2 3\ninertial: {mass: 12}",
        "geometry: box\nscale: 1 2 3\nmass/value=12:",
        "mass: 7\ninertial: {mass: 12, geometry: box, scale: 1 2 3}",
        "inertial: {mass: 12, inertia: 13 0 0 10 0 5}",
        "inertial: {mass: 12, inertia: [13, 0, 0, 10, 0, 5]}",
        "mass: 12\ninertial: {inertia: 13 0 0 10 0 5}",
        "inertial: {mass/value=12: , 'inertia/ixx=13, ixy=0, ixz=0, iyy=10, iyz=0, izz=5': }",
        "inertial: {mass: 12, inertia: {ixx: 13, ixy: 0, ixz: 0, iyy: 10, iyz: 0, izz: 5}}",
    ],
)
def test_mass_and_inertia_in_every_form(body):
    lowered = link(body)
    assert lowered.find("link/inertial/mass").attributes == {"value": "12"}
    assert inertia_of(lowered) == pytest.approx([13, 0, 0, 10, 0, 5])
    assert names(lowered.find("link/inertial").children) == ["origin", "mass", "inertia"]
    assert len(lowered.find_all("link/inertial")) == 1


def test_a_given_inertia_keeps_its_spelling():
    lowered = link("inertial: {mass: 1.00, inertia: 1e-6 0 0.0 1.0e-6 0 1e-13, xyz: 0 0 0.10}")
    assert list(lowered.find("link/inertial/inertia").attributes.values()) == [
        *("1e-6", "0", "0.0", "1.0e-6", "0", "1e-13")
    ]
    assert lowered.find("link/inertial/origin").attributes["xyz"] == "0 0 0.10"


def test_a_tiny_inertia_is_not_rounded_away():
    lowered = link("geometry: sphere\nscale: 1e-4\nmass: 1e-6")
    assert inertia_of(lowered)[0] == pytest.approx(0.4 * 1e-6 * 1e-8, rel=1e-12)


def test_the_inertia_is_in_the_inertials_own_frame():
    lowered = link("geometry: box\nscale: 1 2 3\nmass: 12\nrpy: 0.3 0 0\nxyz: 1 2 3")
    assert inertia_of(lowered) == pytest.approx([13, 0, 0, 10, 0, 5])
    assert lowered.find("link/inertial/origin").attributes == {"xyz": "1 2 3", "rpy": "0.3 0 0"}


def test_an_inertial_keeps_its_attributes_and_other_elements():
    lowered = link("geometry: box\nscale: 1 1 1\ninertial/auto=true: {mass: 1, extra: 2}")
    assert lowered.find("link/inertial").attributes == {"auto": "true"}
    assert names(lowered.find("link/inertial").children) == ["origin", "mass", "inertia", "extra"]


@pytest.mark.parametrize(
    ("body", "code", "underlined"),
    [
        ("mass: 1\ndensity: 2\ngeometry: box\nscale: 1 1 1", "given-twice", "density"),
        ("inertial: {mass: 1, density: 2, inertia: 1 0 0 1 0 1}", "given-twice", "density"),
        ("inertial:\ngeometry: box\nscale: 1 1 1\nvisual:", "missing-mass", "inertial"),
        ("inertial: {inertia: 1 0 0 1 0 1}", "missing-mass", "inertial"),
        ("mass: 1", "missing-geometry", "mass"),
        ("density: 1", "missing-geometry", "density"),
        ("density: 1\ninertial: {inertia: 1 0 0 1 0 1}", "missing-geometry", "inertial"),
        ("inertial: {mass: 1}", "missing-geometry", "inertial"),
        ("inertial: {mass: 1, inertia: 1 0 0 1 0}", "wrong-count", "1 0 0 1 0"),
        ("inertial: {mass: 1, inertia: {ixx: 1, iyy: 1, izz: 1}}", "wrong-count", "inertia"),
        ("inertial: {mass: 1, inertia: }", "wrong-count", "inertia"),
        ("mass: heavy\ngeometry: box\nscale: 1 1 1", "bad-number", "heavy"),
        ("mass:\ngeometry: box\nscale: 1 1 1", "empty-value", "mass"),
        ("mass: 1\ngeometry: box\nscale: 1 0 1", "bad-size", "1 0 1"),
        ("mass: 1\ngeometry: sphere\nscale: -1", "bad-size", "-1"),
        ("mass: 1e300\ngeometry: sphere\nscale: 1e10", "bad-number", "mass"),
        ("density: 1e300\ngeometry: sphere\nscale: 1e10", "bad-number", "density"),
    ],
)
def test_faulty_inertials(body, code, underlined):
    with pytest.raises(YamaroError) as caught:
        link(body)
    (error,) = caught.value.diagnostics
    assert error.code == code
    assert error.span.written() == underlined


# --- meshes -----------------------------------------------------------------------------------


@pytest.fixture
def bracket(tmp_path):
    """A lopsided closed mesh, and a resolver that finds it as `bracket.stl`."""
    mesh = trimesh.creation.box((0.4, 0.3, 0.2))
    mesh.vertices[mesh.vertices[:, 0] > 0] *= (1.5, 1.0, 0.5)
    mesh.apply_translation((0.1, -0.2, 0.3))
    path = tmp_path / "bracket.stl"
    mesh.export(path)
    (tmp_path / "open.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (tmp_path / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n")
    (tmp_path / "bad.stl").write_text("nothing")

    def resolve(filename, span):
        found = tmp_path / filename
        return str(found) if found.exists() else None

    return trimesh.load_mesh(path), resolve


@pytest.mark.parametrize("scale", [(1, 1, 1), (0.5, 2, 3), (1, -1, 1)])
def test_a_mesh_has_its_own_center_of_mass(bracket, scale):
    mesh, resolve = bracket
    words = " ".join(str(factor) for factor in scale)
    lowered = link(
        f"geometry: bracket.stl\nscale: {words}\nmass: 2.0\nxyz: 1 2 3\nrpy: 0.3 -0.4 1.2\nvisual:",
        resolve_mesh=resolve,
    )
    mesh.apply_transform(numpy.diag([*scale, 1.0]))
    T_link_mesh = matrix_of(lowered.find("link/visual/origin"))
    origin = lowered.find("link/inertial/origin")
    expected = T_link_mesh @ [*mesh.center_mass, 1]
    assert numbers(origin, "xyz") == pytest.approx(list(expected[:3]), abs=1e-7)
    assert origin.attributes["rpy"] == "0.3 -0.4 1.2"
    mesh.density = 2.0 / mesh.volume
    tensor = mesh.moment_inertia
    expected = [tensor[0, 0], tensor[0, 1], tensor[0, 2], tensor[1, 1], tensor[1, 2], tensor[2, 2]]
    assert inertia_of(lowered) == pytest.approx(expected, rel=1e-5, abs=1e-9)


def test_a_mesh_and_a_density_give_the_mass(bracket):
    mesh, resolve = bracket
    lowered = link("geometry: bracket.stl\ndensity: 1000", resolve_mesh=resolve)
    mass = float(str(lowered.find("link/inertial/mass").attributes["value"]))
    assert mass == pytest.approx(1000 * mesh.volume, rel=1e-6)


def test_a_given_inertia_does_not_move_the_origin_nor_read_the_mesh():
    lowered = link("geometry: none.stl\nvisual:\ninertial: {mass: 1, inertia: 1 0 0 1 0 1}")
    assert lowered.find("link/inertial/origin").attributes["xyz"] == "0 0 0"


def test_the_mesh_is_looked_for_with_the_place_it_is_written(bracket):
    _, resolve = bracket
    asked = []

    def record(filename, span):
        asked.append((filename, span.written()))
        return resolve(filename, span)

    link("geometry: bracket.stl\nmass: 1\nvisual:\ncollision:", resolve_mesh=record)
    assert asked == [("bracket.stl", "bracket.stl")]


@pytest.mark.parametrize(
    ("body", "code", "underlined"),
    [
        ("geometry: none.stl\nmass: 1", "missing-mesh", "none.stl"),
        ("geometry: open.obj\nmass: 1", "open-mesh", "open.obj"),
        ("geometry: flat.obj\nmass: 1", "open-mesh", "flat.obj"),
        ("geometry: bad.stl\nmass: 1", "bad-mesh", "bad.stl"),
        ("geometry: bracket.stl\nscale: 1 0 1\nmass: 1", "bad-size", "1 0 1"),
    ],
)
def test_faulty_meshes(bracket, body, code, underlined):
    with pytest.raises(YamaroError) as caught:
        link(body, resolve_mesh=bracket[1])
    (error,) = caught.value.diagnostics
    assert error.code == code
    assert error.span.written() == underlined
    assert "inertia" in f"{error.message}{error.hint}" or code == "bad-size"


def test_a_missing_library_tells_what_to_install(tmp_path, monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "trimesh", None)
    (tmp_path / "a.ply").write_text("ply")
    with pytest.raises(YamaroError) as caught:
        link("geometry: a.ply\nmass: 1", resolve_mesh=lambda name, span: str(tmp_path / name))
    (error,) = caught.value.diagnostics
    assert error.code == "missing-extra"
    assert 'pip install "yamaro[mesh]"' in (error.hint or "")


# --- material ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("material: steel", '<material name="steel"/>'),
        ("material: {name: steel}", '<material name="steel"/>'),
        ("material/name=steel:", '<material name="steel"/>'),
        (
            "material: {name: red, color: [1, 0.50, 0, 1]}",
            '<material name="red"><color rgba="1 0.50 0 1"/></material>',
        ),
        (
            "material/name=red: {color: 1 0 0 1}",
            '<material name="red"><color rgba="1 0 0 1"/></material>',
        ),
        (
            "material/name=red: {color/rgba=1 0 0 1: }",
            '<material name="red"><color rgba="1 0 0 1"/></material>',
        ),
        (
            "material: [{name: red}, {color: 1 0 0 1}]",
            '<material name="red"><color rgba="1 0 0 1"/></material>',
        ),
        (
            "material: {name: wood, texture: a.png, extra: 1}",
            '<material name="wood"><texture filename="a.png"/><extra>1</extra></material>',
        ),
        (
            "material: {name: wood, texture/filename=a.png: , color: $(None)}",
            '<material name="wood"><texture filename="a.png"/></material>',
        ),
    ],
)
def test_materials(written, expected):
    lowered = link(f"{BOX}visual:\n  {written}")
    squeezed = "".join(line.strip() for line in lowered.xml.splitlines())
    assert expected in squeezed
    beside = lower_text(f"part:\n  name: a\n  {written}\n")
    assert expected in "".join(line.strip() for line in beside.xml.splitlines())


@pytest.mark.parametrize(
    ("written", "code", "hint"),
    [
        ("material: {color: 1 0 0 1}", "missing-name", "name: red"),
        ("material:", "missing-name", "name: red"),
        ("material: {name: red, color: 1 0 0}", "wrong-count", "add the opacity: 1 0 0 1"),
        ("material: {name: red, color: }", "empty-value", "color: 0.8 0.1 0.1 1"),
        ("material: {name: red, color: red}", "bad-number", "0.8 0.1 0.1 1"),
        ("material: {name: red, texture: }", "empty-value", "texture:"),
        ("material: {name: red, x: [1, 2]}", "list-as-text", "one text"),
    ],
)
def test_faulty_materials(written, code, hint):
    with pytest.raises(YamaroError) as caught:
        link(f"{BOX}visual:\n  {written}")
    (error,) = caught.value.diagnostics
    assert error.code == code
    assert hint in (error.hint or "")


# --- XML among the keys -----------------------------------------------------------------------


def test_other_keys_are_xml_elements_where_they_stand():
    lowered = link(f"{BOX}visual: {{plugin/name=p: {{a: 1}}, material: m, <xyz>: 1}}\n<sensor>:")
    assert names(lowered.find("link").children) == ["visual", "sensor"]
    assert names(lowered.find("link/visual").children) == [
        *("origin", "geometry", "plugin", "material", "xyz")
    ]
    assert lowered.codes() == []


def test_angle_brackets_are_always_plain_xml():
    lowered = lower_text("""
part:
  name: a
  <name>: other
  <joint/name=j>:
  <link/name=l>: {<mass>: 1}
""")
    assert [e.name for e in lowered.tree.children] == ["link", "name", "joint", "link"]
    assert lowered.find("link/mass").text() == "1"


def test_an_element_in_angle_brackets_stands_in_for_the_generated_one():
    lowered = link("""
visual:
  <origin/xyz=9 9 9>:
  <geometry>: {mesh/filename=a.xyz: }
inertial:
  <mass/value=3>:
  inertia: 1 0 0 1 0 1
""")
    assert names(lowered.find("link/visual").children) == ["origin", "geometry"]
    assert lowered.find("link/visual/origin").attributes == {"xyz": "9 9 9"}
    assert lowered.find("link/inertial/mass").attributes == {"value": "3"}


def test_parent_and_child_in_angle_brackets_stand_as_written():
    lowered = joint("type: fixed\n<parent/link=base>:\n<child/link=x>:", more="part: {name: base}")
    assert names(lowered.find("joint").children) == ["parent", "child", "origin"]
    assert lowered.find("joint/parent").attributes == {"link": "base"}
    assert lowered.find("joint/child").attributes == {"link": "x"}


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("part: {name: a, x: [1, 2]}", "x"),
        ("part: {name: a, x: {y: [1, 2]}}", "y"),
        ("part: {name: a, joint: {type: fixed, parent: b, x: [1, 2]}}", "x"),
        ("part: {name: a, link: {x: [1, 2]}}", "x"),
        ("part: {name: a, link: {geometry: box, scale: 1 1 1, visual: {x: {y: [1, 2]}}}}", "y"),
        ("part: {name: a, link: {<mass>: [1, 2]}}", "mass"),
    ],
)
def test_a_list_is_no_content_of_an_element(text, name):
    error = error_of(text)
    assert error.code == "list-as-text"
    assert error.span.written() == "[1, 2]"
    assert f"<{name}>" in error.message


@pytest.mark.parametrize(
    ("text", "underlined"),
    [
        ("part: {name: a, link: box}", "box"),
        ("part: {name: a, link: {geometry: box, scale: 1 1 1, visual: x, collision: }}", "x"),
        ("part: {name: a, '#text': x}", "x"),
        ("part: {name: a, link: [1, 2]}", "[1, 2]"),
    ],
)
def test_text_directly_in_a_place_of_keys_is_an_error(text, underlined):
    error = error_of(text)
    assert error.code == "unexpected-text"
    assert error.span.written() == underlined


@pytest.mark.parametrize(
    ("text", "code", "underlined", "hint"),
    [
        ("part: {name: a, lnik: }", "unknown-key", "lnik", "did you mean 'link'?"),
        ("part: {name: a, link: {visaul: }}", "unknown-key", "visaul", "did you mean 'visual'?"),
        ("part: {name: a, link: {colision: }}", "unknown-key", "colision", "'collision'"),
        ("part: {name: a, link: {geometery: }}", "unknown-key", "geometery", "'geometry'"),
        ("part: {name: a, link: {Visual: }}", "unknown-key", "Visual", "'visual'"),
        (
            "part: {name: a, joint: {type: fixed, parent: b, pivott: 1}}",
            "unknown-key",
            "pivott",
            "'pivot'",
        ),
        ("part: {name: a, geometry: box}", "misplaced-key", "geometry", "'link:'"),
        ("part: {name: a, type: fixed}", "misplaced-key", "type", "'joint:'"),
        ("part: {name: a, xyz: 1 0 0}", "misplaced-key", "xyz", "'joint:' or under 'link:'"),
        ("part: {name: a, link: {type: fixed}}", "misplaced-key", "type", "'joint:'"),
        ("part: {name: a, link: {material: m}}", "misplaced-key", "material", "'visual:'"),
        (
            "part: {name: a, link: {visual: {geometry: box, scale: 1 1 1, mass: 1}}}",
            "misplaced-key",
            "mass",
            "'inertial:'",
        ),
        (
            "part: {name: a, joint: {type: fixed, parent: b, name: j}}",
            "misplaced-key",
            "name",
            "joint/name=…",
        ),
    ],
)
def test_misspelt_and_misplaced_keys_are_warned_of_and_come_out_as_elements(
    text, code, underlined, hint
):
    lowered = lower_text(text)
    (warning,) = lowered.warnings
    assert warning.code == code
    assert warning.span.written() == underlined
    assert hint in (warning.hint or "")


@pytest.mark.parametrize(
    "name", ["gazebo", "plugin", "transmission", "drake:proximity", "mujoco", "contact"]
)
def test_elements_that_robots_hold_are_not_warned_of(name):
    tree = build("part: {name: a, x: , link: {x: }}")
    part = tree.children[0]
    for element in (part.children[1], part.children[2].children[0]):
        element.name = name
    reporter = Reporter()
    lowered, _ = lower(tree, reporter=reporter, resolve_mesh=lambda name, span: None)
    assert names(lowered.children) == ["link", name]
    assert reporter.diagnostics == []


def test_parts_in_elements_beside_a_part():
    lowered = lower_text("part: {name: a, group: {part: {name: b}, x: 1}}")
    assert names(lowered.find("group").children) == ["link", "x"]
    assert lowered.codes() == ["misplaced-part"]
    error = error_of("part: {name: a, <joint/name=j>: {part: {name: b}}}")
    assert error.code == "misplaced-part"
    assert "inside a joint" in error.message


def test_a_mass_in_angle_brackets_serves_for_the_inertia():
    lowered = link("geometry: box\nscale: 1 2 3\ninertial: {<mass/value=12>: }")
    assert inertia_of(lowered) == pytest.approx([13, 0, 0, 10, 0, 5])


@pytest.mark.parametrize("kind", ["joint", "link"])
def test_an_empty_name_of_a_joint_or_link_is_an_error(kind):
    tree = build("part: {name: a, joint: {type: fixed, parent: w}, link: }")
    own = next(child for child in tree.children[0].children if child.name == kind)
    own.attributes = {"name": ""}
    with pytest.raises(YamaroError) as caught:
        lower_tree(tree)
    assert [error.code for error in caught.value.diagnostics] == ["empty-value"]


def test_elements_in_angle_brackets_in_a_material_are_plain():
    lowered = link(f"{BOX}visual: {{material: {{name: m, <color/rgba=1 1 1 1>: }}}}")
    assert names(lowered.find("link/visual/material").children) == ["color"]
    assert lowered.find("link/visual/material/color").attributes == {"rgba": "1 1 1 1"}


def test_texts_among_texts_are_joined_to_one_value():
    tree = build("part: {name: a, link: {xyz: 1 0, geometry: box, scale: 1 1 1, visual: }}")
    xyz = tree.children[0].children[1].children[0]
    xyz.children.append(Text(" 2.0", xyz.span))
    assert lower_tree(tree).find("link/visual/origin").attributes["xyz"] == "1 0 2.0"


# --- provenance -------------------------------------------------------------------------------


def test_every_element_points_at_the_key_that_made_it():
    lowered = lower_text(WHEEL + "part: {name: base}")
    places = {
        "joint": "joint",
        "joint/parent": "parent",
        "joint/child": "joint",
        "joint/origin": "xyz",
        "joint/axis": "axis",
        "joint/limit": "limit",
        "link": "link",
        "link/inertial": "mass",
        "link/inertial/mass": "mass",
        "link/inertial/inertia": "mass",
        "link/inertial/origin": "xyz",
        "link/collision": "collision",
        "link/collision/geometry": "geometry",
        "link/collision/geometry/cylinder": "geometry",
        "link/visual": "visual/name=shell",
        "link/visual/material": "material",
        "link/visual/material/color": "color",
    }
    assert {path: lowered.find(path).span.written() for path in places} == places


def test_every_attribute_points_at_its_value():
    lowered = lower_text(WHEEL + "part: {name: base}")
    places = {
        ("joint", "type"): "continuous",
        ("joint/parent", "link"): "base",
        ("joint/origin", "xyz"): "1 0 0",
        ("joint/axis", "xyz"): "0 1 0",
        ("joint/limit", "effort"): "10",
        ("link/inertial/mass", "value"): "1.0",
        ("link/collision/origin", "xyz"): "0 0 0.1",
        ("link/collision/geometry/cylinder", "length"): "0.5 0.2",
        ("link/visual", "name"): "shell",
        ("link/visual/material", "name"): "Black",
        ("link/visual/material/color", "rgba"): "0 0 0 1",
        ("link/visual/material/texture", "filename"): "tex.png",
    }
    found = {(p, a): lowered.find(p).value_span(a).written() for p, a in places}
    assert found == places


def test_the_trace_is_kept():
    tree = build("part: {name: a, joint: {type: fixd, parent: b}}")
    frame = Frame("called", "MakeArm", tree.span, parent=None)

    def mark(element):
        element.trace = frame
        for child in element.elements():
            mark(child)

    mark(tree)
    with pytest.raises(YamaroError) as caught:
        lower_tree(tree)
    assert caught.value.diagnostics[0].trace is frame
    tree.children[0].children[1].children[0].children[0].value = "fixed"
    lowered = lower_tree(tree)
    assert lowered.find("joint/origin").trace is frame
    assert lowered.find("joint/parent").trace is frame
    assert lowered.find("link").trace is frame


def test_a_part_element_is_an_element():
    assert isinstance(build("part: {name: a}").children[0], PartElement)
