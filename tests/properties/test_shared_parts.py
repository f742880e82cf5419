"""Parts that share elements come out as parts with elements of their own do."""

from __future__ import annotations

from collections import Counter
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from tests.robot.part_builder import build, resolve_nothing
from yamaro.diagnostics import INHERITED, Frame, Reporter, YamaroError
from yamaro.robot.part import lower
from yamaro.xml.tree import Element, Memo, Node, PartElement, unshared

NAMES = ["a", "b", "j l", "a b c", "''"]
LINKS = [
    "link: {geometry: cylinder, scale: 0.1 0.5, mass: 1, xyz: 1 0 0, rpy: 0 1.5 0, collision: }",
    "link: {geometry: box, scale: 1 2 3, density: 9, visual: {rpy: 1 2 3, material: {name: red}}}",
    "link: {inertial: {mass: 1, inertia: 1 0 0 1 0 1}, <gazebo>: {x: 1}, '#comment': note}",
    "link/name=b, id=3: {geometry: box, scale: 1 1 1, visual: }",
    "link: {geometry: capsule, scale: 1 1, visual: }",
    "link: {geometry: box, scale: 1 1 1}",
    "link: {visuals: {}, collision: {geometry: sphere, scale: 1, xyz: 1 1 x}}",
    "link: {geometry: bx, scale: 1, visual: }",
]
BESIDE = [
    "material: {name: red, color: 1 0 0 1}",
    "gazebo: {reference: a, <x>: {y: 1}}",
    "<link>/name=b: ",
    "<joint>/name=j: ",
    "material: {color: 1 0 0}",
    "gazebo: {part: {name: inner}}",
]
JOINT_KEYS = {
    "type": ["revolute", "fixed", "prismatic", "fixd"],
    "parent": ["a", "b", "root_link", "{link: a, note: x}", "''"],
    "xyz": ["0.1 0 0", "$([0.1, 1e-13, 2])", "0 x 0", "$(None)"],
    "rpy": ["0 0 1.57", "0 0 0"],
    "pivot": ["0 0 0.5"],
    "axis": ["0 1 0", "{xyz: 0 0 1}", "0 1"],
    "limit": ["{lower: -1, upper: 1, effort: 2, velocity: 3}", "{effort: 5}", "{lower: x}"],
    "mimic": ["a", "{joint: b, multiplier: 2}", "j"],
    "dynamics": ["{damping: $(0.1)}"],
    "<gazebo>": ["{x: 1}"],
    "<limit>/effort=1": [""],
    "'#comment'": ["note"],
}
STRAY_KEYS = ["<parent>/link=a: ", "origin: {xyz: 1 2 3, xyz: 1}", "axes: 1 0 0", "'#text': a"]
JOINT_LINES = {key: [f"{key}: {value}" for value in JOINT_KEYS[key]] for key in JOINT_KEYS}
LINES = [
    *(f"name: {name}" for name in NAMES),
    *LINKS,
    *BESIDE,
    *(line for lines in JOINT_LINES.values() for line in lines),
    *STRAY_KEYS,
]


def inherited(element: Element) -> Element:
    """Return an element after letting it, and all in it, inherit the trace of what is around."""
    element.trace = INHERITED
    for child in element.elements():
        inherited(child)
    return element


WRITTEN = inherited(build("\n".join(LINES)))

Line = tuple[str, bool]
"""A line, and whether the element it makes is one of the place's own."""


def one_of(lines: list[str]) -> st.SearchStrategy[Line]:
    return st.tuples(st.sampled_from(lines), st.sampled_from([False, False, False, True]))


required = {key: one_of(JOINT_LINES[key][:3]) for key in ("type", "parent")}
optional = {key: one_of(lines[:2]) for key, lines in JOINT_LINES.items() if key not in required}
sound_joints = st.fixed_dictionaries(required, optional=optional).map(lambda d: list(d.values()))
sound_parts = st.tuples(
    st.none() | sound_joints,
    st.lists(one_of([f"name: {name}" for name in NAMES[:3]]), min_size=1, max_size=1),
    st.lists(one_of(LINKS[:6]), max_size=1),
    st.lists(one_of(BESIDE[:4]), max_size=2),
)
any_parts = st.tuples(
    st.none() | st.lists(one_of(LINES[len(NAMES) + len(LINKS) + len(BESIDE) :]), max_size=6),
    st.lists(one_of([*(f"name: {name}" for name in NAMES), *LINKS, *BESIDE]), max_size=4),
)
robots = st.lists(sound_parts, max_size=8) | st.lists(sound_parts | any_parts, max_size=8)


def assemble(parts: list[Any]) -> Element:
    """Return a robot in which the same lines are the same elements, with memos."""
    known = dict(zip(LINES, unshared(WRITTEN, INHERITED).children, strict=True))
    used: Counter[int] = Counter()

    def node(line: Line) -> Node:
        text, is_own = line
        found = known[text]
        if is_own and isinstance(found, Element):
            return unshared(found, INHERITED)
        if isinstance(found, Element):
            used[id(found)] += 1
            if used[id(found)] == 2:
                found.memo = Memo()
        return found

    robot = Element("robot", WRITTEN.span, {"name": "r"})
    for joint, *others in parts:
        trace = Frame("called", f"call {len(robot.children)}", WRITTEN.span, parent=None)
        part = PartElement("part", WRITTEN.span, {}, [], trace)
        if joint is not None:
            keys = [node(line) for line in joint]
            part.children.append(Element("joint", WRITTEN.span, {}, keys, INHERITED))
        part.children += [node(line) for lines in others for line in lines]
        robot.children.append(part)
    return robot


def described(node: Node) -> Any:
    """Return all that a node says but for the calls that led to it."""
    place = node.span.key()
    if not isinstance(node, Element):
        return (place, getattr(node, "value", None), getattr(node, "text", None))
    attributes = [(k, v, node.value_span(k).key()) for k, v in node.attributes.items()]
    return (node.name, place, attributes, node.verbatim, [described(c) for c in node.children])


def outcome(robot: Element) -> Any:
    """Return what a robot is lowered to, and what is told of it."""
    reporter = Reporter()
    lowered, errors = None, []
    try:
        lowered, _ = lower(robot, reporter=reporter, resolve_mesh=resolve_nothing)
    except YamaroError as error:
        errors = error.diagnostics
    told = [(d.message, d.span.key(), d.hint, d.notes) for d in [*reporter.diagnostics, *errors]]
    return lowered and described(lowered), told


@given(robots)
def test_sharing_changes_nothing(parts: list[Any]) -> None:
    robot = assemble(parts)
    before = described(robot)
    expected = outcome(unshared(robot))
    assert outcome(robot) == expected
    assert outcome(robot) == expected, "what has been noted is to be of use again"
    assert described(robot) == before


def test_what_shared_keys_come_out_as_is_shared() -> None:
    sound = [(f"type: {kind}", False) for kind in ("revolute", "prismatic")]
    keys = ["parent: b", "xyz: 0.1 0 0", "rpy: 0 0 0", f"limit: {JOINT_KEYS['limit'][0]}"]
    link = [(LINKS[0], False)]
    parts = [([kind, *((key, False) for key in keys)], [("name: a", True)], link) for kind in sound]
    robot = assemble([*parts, (None, [("name: b", False)])])
    lowered, _ = lower(robot, reporter=Reporter(), resolve_mesh=resolve_nothing)
    joint, wheel, other_joint, other_wheel, _ = lowered.elements()
    assert wheel.children is other_wheel.children
    assert wheel.memo is other_wheel.memo is not None
    both = [child for child in joint.elements() if child in other_joint.children]
    assert [child.name for child in both] == ["parent", "limit"]
    assert all(child.memo is not None for child in both)
    assert joint.elements()[0].attributes == {"link": "b_link"}
