"""The end of lowering: what the notes of a robot say is checked, and made into URDF."""

from __future__ import annotations

from ..diagnostics import ERROR, Diagnostic, YamaroError, did_you_mean, failure, given_twice
from ..model.joint import LIMITED
from ..model.positions import HOME
from ..model.reading import read_robot
from ..xml.tree import Element, RobotNote
from ..xml.values import format_value
from .lowering import names_of
from .notes import GROUP, NAMED, take_notes
from .numbers import read_numbers
from .rigid import ends_of, name_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from ..fixes import Fix
    from ..model.extras import State
    from .control import States
    from .lowering import Lowering

_TOLERANCE = 1e-9


def finish_notes(lowering: Lowering, robot: Element) -> tuple[Element, list[RobotNote]]:
    """Return a robot without its notes but with what URDF has of them, and the notes.

    Errors are recorded.
    """
    robot, notes = take_notes(robot)
    if not notes:
        return robot, notes
    names = _LinkTree(robot)
    states = merged_states(notes)
    _refuse_names_twice(lowering, notes)
    _check_groups(lowering, notes)
    for note in notes:
        _check(lowering, names, note)
    if any(note.name == "robot-loop" for note in notes):
        closed = close_home(lowering, robot, notes)
        if closed:
            notes = [*notes, *closed]
            states = merged_states(notes)
    controls = [note for note in notes if note.name == "ros2_control"]
    if controls:
        from .control import DRAKE, ControlWriter

        writer = ControlWriter(robot, notes, states)
        for note in controls:
            try:
                robot.children.append(writer.element(note))
            except YamaroError as error:
                lowering.absorb(error)
                continue
            transmissions = writer.for_drake(note)
            if transmissions:
                robot.children += transmissions
                robot.attributes = {**robot.attributes}
                robot.attributes.setdefault("xmlns:drake", DRAKE)
    return robot, notes


def merged_states(notes: Iterable[RobotNote]) -> States:
    """Return the value of each joint in each state; what comes later, from further out, wins."""
    states: States = {}
    for note in notes:
        if note.name == "state":
            values = states.setdefault(str(note.attributes["name"]), {})
            for joint in note.elements():
                value = str(joint.attributes["value"]), joint.value_span("value")
                values[str(joint.attributes["joint"])] = value
    return states


class _LinkTree:
    """The links and joints of a robot by name, and how its links are joined."""

    __slots__ = ("joints", "links", "parents")

    def __init__(self, robot: Element) -> None:
        self.links = names_of(robot, "link")
        self.joints = {name_of(each): each for each in robot.elements() if each.name == "joint"}
        self.parents: dict[str, str] = {}
        for joint in self.joints.values():
            ends = ends_of(joint)
            if len(ends) == 2:
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


def _refuse_names_twice(lowering: Lowering, notes: Iterable[RobotNote]) -> None:
    seen: dict[tuple[str, str], RobotNote] = {}
    for note in notes:
        kind, name = NAMED.get(note.name), name_of(note)
        if kind is None or kind == "control":  # `control.py` looks at those
            continue
        first = seen.setdefault((kind, name), note)
        # Sensors that both have frames of their name are reported as links.
        have_frames = all(
            n.attributes.get("frame") == n.attributes.get("name") for n in (first, note)
        )
        if first is not note and not have_frames:
            lowering.absorb(
                failure(
                    "duplicate-name",
                    f"there are two {kind}s named '{name}'",
                    note.value_span("name"),
                    hint="give each its own name; `attach` puts a `prefix` before names",
                    notes=[f"the other one is at {first.value_span('name').place()}"],
                    trace=note.trace,
                )
            )


def _check_groups(lowering: Lowering, notes: list[RobotNote]) -> None:
    """Record the groups that others, or controllers, name and that are not there."""
    names = [name_of(note) for note in notes if note.name == GROUP]
    for group in (note for note in notes if note.name in (GROUP, "robot-controller")):
        for member in group.elements():
            name = name_of(member)
            if member.name == GROUP and name not in names:
                lowering.absorb(
                    failure(
                        "unknown-group",
                        f"there is no group '{name}'",
                        member.value_span("name"),
                        hint=did_you_mean(name, names)
                        or f"the groups are {', '.join(names) or 'in the section `groups`'}",
                        trace=group.trace,
                    )
                )


def _check(lowering: Lowering, names: _LinkTree, note: RobotNote) -> None:
    """Record what a note says of links and joints that the robot does not have."""
    if note.name == "state":
        seen: dict[str, Element] = {}
        for joint in note.elements():
            name = str(joint.attributes["joint"])
            first = seen.setdefault(name, joint)
            if first is not joint:  # such as by its part's name too
                lowering.absorb(
                    given_twice(
                        f"the state '{name_of(note)}' has two positions of the joint '{name}'",
                        joint.value_span("joint"),
                        first.value_span("joint"),
                        trace=note.trace,
                    )
                )
        for joint in note.elements():
            _check_state(lowering, names, joint)
        return
    for each in (note, *note.elements()):
        for attribute, value in each.attributes.items():
            if attribute == "joint" and note.name != "actuator":
                _check_joint(lowering, names, each)
            elif attribute in _LINK_ATTRIBUTES and value not in names.links:
                _unknown_link(lowering, each, attribute, names.links)
        if each.name == "chain":
            base, tip = str(each.attributes["base_link"]), str(each.attributes["tip_link"])
            is_known = base in names.links and tip in names.links
            if is_known and not names.has_chain(base, tip):
                lowering.absorb(
                    failure(
                        "not-a-chain",
                        f"no joints lead from '{base}' down to '{tip}'",
                        each.value_span("tip_link"),
                        hint="name the link at the base first, and one of those below it last",
                        trace=each.trace,
                    )
                )


_LINK_ATTRIBUTES = frozenset(
    ("link", "parent_link", "base_link", "tip_link", "frame", "frame_1", "frame_2")
) | {"link_1", "link_2"}


def _check_state(lowering: Lowering, names: _LinkTree, value: Element) -> None:
    if not _check_joint(lowering, names, value):
        return
    joint = names.joints[str(value.attributes["joint"])]
    written = value.attributes.get("written")
    if written is not None:  # its unit has to be one for the joint
        lowering.joint_type = format_value(joint.attributes.get("type"))
        span, name = value.value_span("value"), name_of(joint)
        try:
            read_numbers(
                lowering,
                str(written),
                span,
                count=1,
                name=name,
                trace=value.trace,
                kind="position",
            )
        except YamaroError as error:
            lowering.absorb(error)
            return
    limit = next((each for each in joint.elements() if each.name == "limit"), None)
    if limit is None or joint.attributes.get("type") not in LIMITED:
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


def _check_joint(lowering: Lowering, names: _LinkTree, note: Element) -> bool:
    """Return whether a note names a joint that can have a position of its own."""
    name = str(note.attributes["joint"])
    joint = names.joints.get(name)
    if joint is None:
        from ..diagnostics import meant

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
    from ..diagnostics import meant

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


# --- loops ------------------------------------------------------------------------------------


def close_home(lowering: Lowering, root: Element, notes: Sequence[RobotNote]) -> list[RobotNote]:
    """Return the state that changes `home` so that the loops of a robot are closed in it, if any.

    What is changed, and what is open by too much to be closed, is reported.

    Args:
        lowering: the run.
        root: the `<robot>`.
        notes: what it has besides URDF.
    """
    from ..model.loops import (
        LARGEST_GAP,
        WIDEST,
        WIDEST_TURN,
        closed_near,
        closures,
        driven_joints,
        gap_of,
        size_of,
    )
    from ..model.positions import positions_in

    robot = read_robot(root, notes=notes, recognizes=False)
    home = robot.states.get(HOME)
    positions = positions_in(robot, home)
    size = size_of(robot, positions)
    driven = driven_joints(robot)
    where = f"in the state '{HOME}'" if home is not None else "with all joints at 0"
    added: list[RobotNote] = []
    for closure in closures(robot, size):
        poses = robot.poses(positions)
        gaps = [gap_of(loop, *(poses[name] for name in loop.between)) for loop in closure.loops]
        if max(map(max, gaps)) <= LARGEST_GAP:
            continue
        changed = None
        if all(distance <= WIDEST * size and turn <= WIDEST_TURN for distance, turn in gaps):
            said = home.positions if home is not None else {}
            changed = closed_near(closure, positions, said, driven)
        written = ""
        if changed is not None:
            positions.update(changed)
            values = [
                f"{name}: {float(f'{value:.12f}') + 0.0:.12g}" for name, value in changed.items()
            ]
            written = ", ".join(values)
            if not closure.loops[0].span.source.is_xml:
                written = f"states: {{{HOME}: {{{written}}}}}"
            added.append(_state(closure.loops[0].element, home, changed))
        for loop, (distance, turn) in zip(closure.loops, gaps, strict=True):
            if max(distance, turn) <= LARGEST_GAP:
                continue
            amounts = [f"{distance:.3g} m"] if distance > LARGEST_GAP else []
            amounts += [f"{turn:.3g} rad"] if turn > LARGEST_GAP else []
            open_by = f"the loop '{loop.name}' is open by {' and '.join(amounts)} {where}"
            if changed is None:
                hint = f"give the positions in which it is closed: states: {{{HOME}: {{…}}}}"
                lowering.report("open-loop", open_by, loop.span, hint=hint, trace=loop.trace)
            else:
                lowering.report(
                    "closed-loop",
                    f"{open_by}, and is closed there",
                    loop.span,
                    hint=f"closed, it is at {written}"
                    if loop.span.source.is_xml
                    else f"to say so, write {written}",
                    trace=loop.trace,
                )
    return added


def _state(owner: Element, home: State | None, positions: Mapping[str, float]) -> RobotNote:
    """Return the state `home` with these positions, at their places where it has them."""
    made = []
    for name, value in positions.items():
        span = home.span_of(name) if home is not None and name in home.positions else owner.span
        made.append(RobotNote("joint", span, {"joint": name, "value": repr(value)}))
    return RobotNote("state", owner.span, {"name": HOME}, [*made], trace=owner.trace)
