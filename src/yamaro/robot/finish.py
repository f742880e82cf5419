"""The end of lowering: what the notes of a robot say is checked, and made into URDF."""

from __future__ import annotations

from ..diagnostics import ERROR, Diagnostic, YamaroError, failure
from ..xml.tree import Element
from ..xml.values import format_value
from .control_block import ControlWriter
from .notes import RobotNote, take_notes
from .rigid import link_of, name_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..fixes import Fix
    from .control_block import States
    from .lowering import Lowering

_TOLERANCE = 1e-9


def finish_notes(lowering: Lowering, robot: Element) -> tuple[Element, list[RobotNote]]:
    """Return a robot without its notes but with what URDF has of them, and the notes.

    Errors are recorded.
    """
    robot, notes = take_notes(robot)
    if not notes:
        return robot, notes
    names = _Names(robot)
    states = merged_states(notes)
    for note in notes:
        _check(lowering, names, note)
    writer = ControlWriter(robot, notes, states)
    for note in notes:
        if note.name == "ros2_control":
            try:
                robot.children.append(writer.element(note))
            except YamaroError as error:
                lowering.absorb(error)
    return robot, notes


def merged_states(notes: Iterable[RobotNote]) -> States:
    """Return the value of each joint in each state; what comes later, from further out, wins."""
    states: States = {}
    for note in notes:
        if note.name == "state":
            values = states.setdefault(str(note.attributes["name"]), {})
            for joint in note.elements():
                values[str(joint.attributes["joint"])] = str(joint.attributes["value"])
    return states


class _Names:
    """The links and joints of a robot by name, and how its links are joined."""

    __slots__ = ("joints", "links", "parents")

    def __init__(self, robot: Element) -> None:
        self.links = {name_of(each) for each in robot.elements() if each.name == "link"}
        self.joints = {name_of(each): each for each in robot.elements() if each.name == "joint"}
        self.parents: dict[str, str] = {}
        for joint in self.joints.values():
            ends = {each.name: link_of(each) for each in joint.elements()}
            if "parent" in ends and "child" in ends:
                self.parents[ends["child"]] = ends["parent"]

    def has_chain(self, base: str, tip: str) -> bool:
        """Return whether one link is above another."""
        seen: set[str] = set()
        while tip != base:
            if tip not in self.parents or tip in seen:
                return False
            seen.add(tip)
            tip = self.parents[tip]
        return True


def _check(lowering: Lowering, names: _Names, note: RobotNote) -> None:
    """Record what a note says of links and joints that the robot does not have."""
    if note.name == "state":
        for joint in note.elements():
            _check_state(lowering, names, joint)
        return
    for each in (note, *note.elements()):
        for attribute, value in each.attributes.items():
            if attribute == "joint" and note.name != "actuator":
                _check_joint(lowering, names, each)
            elif attribute in _LINK_ATTRIBUTES and value not in names.links:
                _unknown_link(lowering, each, attribute, names.links)
        if each.name == "chain" and _is_known(names, each):
            base, tip = str(each.attributes["base_link"]), str(each.attributes["tip_link"])
            if not names.has_chain(base, tip):
                lowering.absorb(_no_chain(each, base, tip))
    if note.name == "robot-loop":
        _error(
            lowering,
            "lost-in-urdf",
            f"URDF cannot hold the loop '{note.attributes['name']}'",
            note,
            "name",
            hint="--allow lost-in-urdf writes the robot without it",
        )


def _no_chain(chain: Element, base: str, tip: str) -> YamaroError:
    return failure(
        "not-a-chain",
        f"no joints lead from '{base}' down to '{tip}'",
        chain.value_span("tip_link"),
        hint="name the link at the base first, and one of those below it last",
        trace=chain.trace,
    )


_LINK_ATTRIBUTES = frozenset(
    ("link", "parent_link", "base_link", "tip_link", "frame", "frame_1", "frame_2")
) | {"link_1", "link_2"}


def _is_known(names: _Names, chain: Element) -> bool:
    ends = (chain.attributes["base_link"], chain.attributes["tip_link"])
    return all(end in names.links for end in ends)


def _check_state(lowering: Lowering, names: _Names, value: Element) -> None:
    if not _check_joint(lowering, names, value):
        return
    joint = names.joints[str(value.attributes["joint"])]
    limit = next((each for each in joint.elements() if each.name == "limit"), None)
    if limit is None or joint.attributes.get("type") not in ("revolute", "prismatic"):
        return
    number = float(str(value.attributes["value"]))
    try:
        lower = float(format_value(limit.attributes.get("lower") or "0"))
        upper = float(format_value(limit.attributes.get("upper") or "0"))
    except ValueError:
        return
    if not lower - _TOLERANCE <= number <= upper + _TOLERANCE:
        _error(
            lowering,
            "state-outside-limit",
            f"the position {format_value(number)} of '{name_of(joint)}' is outside of its limits, "
            f"{format_value(lower)} and {format_value(upper)}",
            value,
            "value",
            hint="positions are in radians or metres",
        )


def _check_joint(lowering: Lowering, names: _Names, note: Element) -> bool:
    """Return whether a note names a joint that can have a position of its own."""
    name = str(note.attributes["joint"])
    joint = names.joints.get(name)
    if joint is None:
        from ..suggestions import meant

        hint, fix = meant(name, list(names.joints), note.value_span("joint"))
        _error(
            lowering,
            "unknown-joint",
            f"there is no joint '{name}' in the robot",
            note,
            "joint",
            hint=hint or "name a joint or a part of the robot",
            fix=fix,
        )
        return False
    if note.name != "joint":
        return True
    is_fixed = joint.attributes.get("type") == "fixed"
    if is_fixed or any(each.name == "mimic" for each in joint.elements()):
        _error(
            lowering,
            "unknown-joint",
            f"the joint '{name}' is fixed"
            if is_fixed
            else f"the joint '{name}' follows another, whose position it has",
            note,
            "joint",
            hint="leave it out; name joints that move independently",
        )
        return False
    return True


def _unknown_link(lowering: Lowering, note: Element, attribute: str, known: set[str]) -> None:
    name = str(note.attributes[attribute])
    from ..suggestions import meant

    span = note.value_span(attribute)
    hint, fix = meant(name, list(known), span)
    lowering.absorb(
        failure(
            "unknown-link",
            f"there is no link '{name}' in the robot",
            span,
            hint=hint or "name a link, a frame or a part of the robot",
            trace=note.trace,
            fix=fix,
        )
    )


def _error(
    lowering: Lowering,
    code: str,
    message: str,
    note: Element,
    attribute: str,
    *,
    hint: str,
    fix: Fix | None = None,
) -> None:
    """Report an error that can be allowed: the robot can be written anyway."""
    lowering.reports += 1
    span = note.value_span(attribute)
    lowering.reporter.add(
        Diagnostic(code, message, span, hint=hint, severity=ERROR, trace=note.trace, fix=fix)
    )
