"""Keyframes: the robot's states, where it rests if it says nothing of `home`, and those of blocks.

A `<key>` of a block has whole rows, as in MJCF, or says values by the names of what has them:
`<joint name qpos qvel>`, `<actuator name ctrl act>`, `<body name qpos qvel mpos mquat>` of a body
with a free joint or a ball without a name, or of a mocap body. The others rest, or are where the
state of its name has them.
"""

from __future__ import annotations

from ...model.kinematics import joint_positions, link_poses
from ...model.pose import IDENTITY
from ...model.positions import HOME, positions_in
from ...model.values import attribute_text, numbers_of
from ..elements import element, row
from ..gains import POSITION
from .blocks import merged, names
from .joints import numbers_at
from .model import JOINTS, Writing
from .scene import heights_at

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.extras import State
    from ...xml.tree import Element
    from ..elements import Attributes

WITH_STATE = frozenset(("intvelocity", "muscle", "cylinder"))
"""The words for actuators that have a state of their own."""
OF_KIND = {
    "joint": ("qpos", "qvel"),
    "actuator": ("ctrl", "act"),
    "body": ("qpos", "qvel", "mpos", "mquat"),
}
"""What a key says of a joint, an actuator or a body by its name."""
MADE_BY_MUJOCO = frozenset(("flexcomp", "composite"))
"""What MuJoCo makes bodies with joints of."""
UNTURNED_ROW = (1.0, 0.0, 0.0, 0.0)


class Rows:
    """The rows of a keyframe of what is written.

    Attributes:
        rest: each row where nothing moves, by its attribute.
        slots: where the numbers of something begin in a row and how many it has, by the row, the
            kind of the thing and its name.
        joints: the elements of the joints, in order.
        is_known: whether MuJoCo makes no further joints.
    """

    __slots__ = ("is_known", "joints", "rest", "slots")

    def __init__(self, writing: Writing) -> None:
        self.rest: dict[str, list[float]] = {
            name: [] for name in ("qpos", "qvel", "ctrl", "act", "mpos", "mquat")
        }
        self.slots: dict[tuple[str, str, str], tuple[int, int]] = {}
        self.joints: list[Element] = []
        self.is_known = True
        for body in writing.sections["worldbody"].iter():
            if body.name in MADE_BY_MUJOCO:
                self.is_known = False
            elif body.name == "body":
                self._add_body(body)
        for each in writing.sections["actuator"].elements():
            own = [("actuator", attribute_text(each, "name"))]
            self._add("ctrl", own, (0.0,))
            self._add("act", own, (0.0,) * _states(each))

    def _add_body(self, body: Element) -> None:
        name = attribute_text(body, "name")
        joints = [each for each in body.elements() if each.name in JOINTS]
        kinds = [
            "free" if each.name == "freejoint" else attribute_text(each, "type") for each in joints
        ]
        is_mocap = attribute_text(body, "mocap") == "true"
        place: tuple[float, ...] = (0.0, 0.0, 0.0)
        turn: tuple[float, ...] = UNTURNED_ROW
        if is_mocap or "free" in kinds:
            place = numbers_of(body, "pos") or place
            turn = numbers_of(body, "quat") or turn
        self.joints += joints
        for joint, kind in zip(joints, kinds, strict=True):
            known = [("joint", attribute_text(joint, "name"))]
            if kind == "free":
                known.append(("body", name))
                self._add("qpos", known, (*place, *turn))
                self._add("qvel", known, (0.0,) * 6)
            elif kind == "ball":
                known.append(("body", name))
                self._add("qpos", known, UNTURNED_ROW)
                self._add("qvel", known, (0.0,) * 3)
            else:
                self._add("qpos", known, numbers_of(joint, "ref") or (0.0,))
                self._add("qvel", known, (0.0,))
        if is_mocap:
            self._add("mpos", [("body", name)], place)
            self._add("mquat", [("body", name)], turn)

    def _add(
        self, attribute: str, known: list[tuple[str, str | None]], rest: tuple[float, ...]
    ) -> None:
        start = len(self.rest[attribute])
        self.rest[attribute] += rest
        for kind, name in known:
            if name is not None:
                self.slots.setdefault((attribute, kind, name), (start, len(rest)))


def add_keyframes(writing: Writing) -> None:
    """Append a keyframe for each state, `home` first, and those of blocks.

    Whole rows are for the joints of the file: where others have joined them, they do not fit.
    """
    rows, blocks = Rows(writing), writing.blocks
    given = blocks.in_section("keyframe")
    states = dict(writing.robot.states)
    home = states.pop(HOME, None)
    if rows.joints and rows.is_known:
        if home is not None or not (blocks.is_whole or given):
            add_key(writing, HOME, home, rows)
        for name, state in states.items():
            add_key(writing, name, state, rows)
    elif rows.joints:
        said = {attribute_text(each, "name") for each in given}
        for state in writing.robot.states.values():
            if state.name not in said:
                what = "states of robots with bodies that MuJoCo makes"
                writing.losses.lose(what, state, label=f"'{state.name}'")
    keys = writing.sections["keyframe"]
    fitting: dict[str, Element] = {}
    for number, each in enumerate(given):
        own = attribute_text(each, "name")
        name = f" {number}" if own is None else own
        if each.elements() or each.attributes.keys() <= {"name"}:
            known = fitting.get(name)
            if known is None and own is not None:
                known = next((k for k in keys.elements() if names(k) == names(each)), None)
            fitting[name] = _key_by_names(writing, each, known, rows)
            continue
        wrong = [
            attribute
            for attribute, row in rows.rest.items()
            if attribute in each.attributes and len(numbers_of(each, attribute)) != len(row)
        ]
        if wrong or name in fitting:
            what = "keyframes of other joints" if wrong else "further keyframes of one name"
            trace = each.trace_within(None)
            writing.losses.lose_xml(what, each, label=f"'{own or ''}'", trace=trace)
            continue
        if "qpos" in each.attributes:  # it is whole
            rest = [key for key in keys.elements() if attribute_text(key, "name") != own]
            keys.children = [*rest] if own is not None else keys.children
        fitting[name] = each
    keys.children = merged(keys.children, [*fitting.values()], names)


def _key_by_names(writing: Writing, given: Element, key: Element | None, rows: Rows) -> Element:
    """Return a keyframe with what a block says by the names of joints, actuators and bodies.

    Args:
        writing: the run.
        given: the keyframe of the block.
        key: the keyframe that there is of its name, or None.
        rows: the rows of the model.
    """
    made = given.with_children([])
    made.attributes = {**(key.attributes if key is not None else {}), **given.attributes}
    found: dict[str, list[float]] = {}
    trace = given.trace_within(None)
    for each in given.elements():
        name = attribute_text(each, "name")
        is_there = False
        for attribute in OF_KIND.get(each.name, ()):
            slot = rows.slots.get((attribute, each.name, name or ""))
            numbers = numbers_of(each, attribute)
            is_there |= slot is not None
            if slot is None or not numbers or len(numbers) != slot[1]:
                is_there |= each.name == "body"  # which does not move freely here
                continue
            if attribute not in found:
                known = numbers_of(made, attribute)
                rest = rows.rest[attribute]
                found[attribute] = [*(known if len(known) == len(rest) else rest)]
            found[attribute][slot[0] : slot[0] + slot[1]] = numbers
        if not is_there:
            what = "values of keyframes for what is not there"
            label = f"{each.name} '{name or ''}'"
            writing.losses.lose_xml(what, each, label=label, trace=trace)
    for attribute, values in found.items():
        made.attributes[attribute] = row(values)
    return made


def _states(actuator: Element) -> int:
    """Return how many numbers of its own state an actuator has, as far as its file says it."""
    is_filter = attribute_text(actuator, "dyntype") not in (None, "none")
    if actuator.name in WITH_STATE or is_filter or "timeconst" in actuator.attributes:
        return int((numbers_of(actuator, "actdim") or (1,))[0])
    return 0


def add_key(writing: Writing, name: str, state: State | None, rows: Rows) -> None:
    """Append a keyframe: a number for each of `qpos`, and for each actuator, also for others."""
    given = positions_in(writing.robot, state)
    positions = joint_positions(writing.robot, given)
    heights = heights_at(writing, link_poses(writing.robot, given))
    numbers = [*rows.rest["qpos"]]
    for joint in rows.joints:
        called = attribute_text(joint, "name") or ""
        if called not in writing.motions:  # one that the file has for MJCF alone
            continue
        source, part = writing.motions[called]
        origin, known = IDENTITY, writing.robot.joints.get(source)
        if known is not None and known.parent in writing.plan.static:
            origin = writing.plan.static[known.parent] @ known.origin
        found = numbers_at(part, positions.get(source, 0.0), origin)
        if part in ("base", "free"):
            link = source if part == "base" else writing.robot.joints[source].child
            found[2] += heights.get(link, 0.0)
        start, width = rows.slots["qpos", "joint", called]
        numbers[start : start + width] = found
    controls = []
    for each in writing.sections["actuator"].elements():
        joint_name, command = writing.controls.get(id(each), ("", ""))
        target = positions.get(joint_name) if command == POSITION else None
        controls.append(target if isinstance(target, float) else 0.0)
    attributes: Attributes = {"name": name, "qpos": numbers, "ctrl": controls or None}
    writing.add("keyframe", element("key", attributes, owner=state or writing.robot.element))
