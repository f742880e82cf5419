"""Positions of joints as people name them: by a state, a joint or its part, with or without a unit.

Everything that takes positions from a person reads them here: `Robot.pose`, `yamaro picture`,
expectations of tests and functions that evaluate sweeps.
"""

from __future__ import annotations

from math import pi

from ..diagnostics import did_you_mean, suggest
from ..terminal import shortened
from ..units import ANGLE, LENGTH, UnknownUnit, fits, meant_by, name_of, parse_quantity, units_of
from .extras import State
from .joint import FIXED, FLOATING, PLANAR, PRISMATIC
from .pose import Pose

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence
    from typing import Any, TypeVar

    from ..units import Dimension
    from .joint import Joint
    from .link import Link
    from .robot import Robot

    Position = float | Sequence[float] | Pose
    """Where a joint is: one number, three for a planar joint, a pose for a floating one."""
    GivenPosition = float | str | Sequence[float | str] | Pose
    """A position as it may be given: a text has a unit, such as `90deg`."""
    GivenPositions = str | State | Mapping[str, GivenPosition]
    """The name of a state, a state, or positions by the names of joints or of their parts."""

    Named = TypeVar("Named")

HOME = "home"
"""The name of the state in which a robot is shown and starts."""
MOST_LISTED = 12
REACH = 1.0
"""Metres that a prismatic joint without limits is tried along, either way."""
NO_LIMIT = 1e4
"""Metres or radians beyond which a limit is ignored: some write the greatest number there is."""


def read_positions(robot: Robot, given: GivenPositions | None) -> dict[str, Position]:
    """Return positions by the names of joints, in SI.

    Raises:
        ValueError: there is no such state or joint, the joint cannot be given a position, or the
            position is not of its type; the message suggests what may have been meant.
    """
    if given is None:
        return {}
    if isinstance(given, str):
        given = state_named(robot, given)
    positions: dict[str, Position] = {}
    for name, position in (given.positions if isinstance(given, State) else given).items():
        joint = joint_named(robot, name)
        if joint.name in positions:
            raise ValueError(f"two positions are given for the joint '{joint.name}'")
        positions[joint.name] = read_position(joint, position)
    return positions


def positions_in(robot: Robot, state: State | None) -> dict[str, float]:
    """Return the positions of all joints that move independently, in a state.

    Joints that it does not name, and all where it is None, are at `Joint.rest`.
    """
    said = state.positions if state is not None else {}
    return {joint.name: said.get(joint.name, joint.rest) for joint in robot.free_joints()}


def home_positions(robot: Robot) -> dict[str, float]:
    """Return the positions in which to show a robot: those of the state `home`, if it has one."""
    return positions_in(robot, robot.states.get(HOME))


def tried_range(joint: Joint) -> tuple[float, float]:
    """Return the lowest and highest position, in radians or metres, between which one is tried."""
    low, high = joint.lower, joint.upper
    if low is None or high is None or max(abs(low), abs(high)) > NO_LIMIT:
        reach = REACH if joint.type == PRISMATIC else pi
        return -reach, reach
    return min(low, high), max(low, high)


def state_named(robot: Robot, name: str) -> State:
    """Return a state; raise ValueError if there is none of that name."""
    state = robot.states.get(name)
    if state is None:
        states = list(robot.states)
        hint = did_you_mean(name, states) or _listed("its states are", states, "it has no states")
        raise ValueError(f"the robot has no state '{shortened(name)}'; {hint}")
    return state


def joint_named(robot: Robot, name: str) -> Joint:
    """Return the joint of that name, or that of the part; raise ValueError if there is none."""
    return _named(robot, name, "joint", robot.joints)


def link_named(robot: Robot, name: str) -> Link:
    """Return the link or frame of that name, or that of the part; raise ValueError if none is."""
    return _named(robot, name, "link", robot.links)


def _named(robot: Robot, name: str, kind: str, known: Mapping[str, Named]) -> Named:
    found = known.get(name)
    if found is not None:
        return found
    for candidate in names_of_part(robot, name, kind):
        if candidate in known:
            return known[candidate]
    what = "joint" if kind == "joint" else "link or frame"
    near = meant_name(name, known, robot.name_patterns(kind))
    hint = None if near is None else f"did you mean '{near}'?"
    if hint is None and kind == "joint":
        moving = [joint.name for joint in robot.joints.values() if joint.type != FIXED]
        hint = _listed("those that move are", moving, "none of its joints moves")
    raise ValueError(f"the robot has no {what} '{shortened(name)}'" + (f"; {hint}" if hint else ""))


def names_of_part(robot: Robot, part: str, kind: str) -> Iterable[str]:
    """Yield what the joint or link of a part may be called, as `naming` says or by default.

    A prefix that `attach` puts before names is part of the part's name, but comes before the
    pattern in that of its joint: the part `left_elbow` may have the joint `left_j_elbow`.
    """
    for pattern in robot.name_patterns(kind):
        before, _, after = pattern.partition("*")
        for at in range(len(part) if before else 1):
            yield part[:at] + before + part[at:] + after


def meant_name(name: str, known: Iterable[str], patterns: Sequence[str]) -> str | None:
    """Return the known name that may be meant by one that is not, or by the name of a part.

    Args:
        name: the name.
        known: the names that there are.
        patterns: what they are called if they are those of parts, such as `*_joint`.
    """
    meant = {}
    for whole in known:
        for pattern in patterns:
            before, _, after = pattern.partition("*")
            if whole.startswith(before) and whole.endswith(after) and len(whole) >= len(pattern):
                meant[whole[len(before) : len(whole) - len(after)]] = whole
    near = name if name in meant else suggest(name, [*known, *meant])
    return None if near is None else meant.get(near, near)


def read_position(joint: Joint, given: Any) -> Position:
    """Return a position that is given for a joint; raise ValueError if it cannot be that.

    Args:
        joint: the joint.
        given: a number or a text, which may have a unit; three of them for a planar joint; a `Pose`
            for a floating one.
    """
    what = f"the joint '{joint.name}'"
    if joint.mimic is not None:
        raise ValueError(f"{what} mimics '{joint.mimic.joint}': give the position of that one")
    if joint.type == FIXED:
        raise ValueError(f"{what} is fixed, and has no position")
    if joint.type == FLOATING:
        if not isinstance(given, Pose):
            raise ValueError(f"{what} is floating: give its position as a Pose")
        return given
    if joint.type == PLANAR:
        items = given.replace(",", " ").split() if isinstance(given, str) else given
        try:
            x, y, angle = items
        except (TypeError, ValueError):
            raise _wrong(joint, "x, y and an angle", given) from None
        return (
            _number(joint, x, LENGTH, given),
            _number(joint, y, LENGTH, given),
            _number(joint, angle, ANGLE, given),
        )
    return _number(joint, given, LENGTH if joint.type == PRISMATIC else ANGLE, given)


def _number(joint: Joint, given: Any, wanted: Dimension, whole: Any) -> float:
    """Return a number in SI that is given as one, or as a text with a unit that fits."""
    form = "x, y and an angle" if joint.type == PLANAR else "one number"
    if not isinstance(given, str):
        try:
            return float(given)
        except (TypeError, ValueError):
            raise _wrong(joint, form, whole) from None
    try:
        value, dimension = parse_quantity(given)
    except UnknownUnit as error:
        meant = meant_by(error.unit)
        hint = f"did you mean '{meant}'?" if meant else did_you_mean(error.unit, units_of(wanted))
        raise _wrong(joint, form, whole, f"'{shortened(error.unit)}' is not a unit", hint) from None
    except (ValueError, OverflowError):
        raise _wrong(joint, form, whole) from None
    if dimension is not None and not fits(dimension, wanted):
        reason = f"that is {name_of(dimension)}, and not {name_of(wanted)}"
        raise _wrong(joint, form, whole, reason)
    return float(value)


def _wrong(
    joint: Joint, form: str, given: object, reason: str = "", hint: str | None = None
) -> ValueError:
    units = {
        PRISMATIC: "in metres or as 30mm",
        PLANAR: "in metres and radians, or as 30mm and 90deg",
    }
    how = units.get(joint.type, "in radians or as 90deg")
    message = f"the joint '{joint.name}' is {joint.type}: give its position as {form}, {how}"
    shown = given if isinstance(given, str) else repr(given)
    message += f", not '{shortened(shown)}'"
    return ValueError("; ".join(filter(None, (message, reason, hint))))


def _listed(begin: str, names: list[str], without: str) -> str:
    if not names:
        return without
    more = ", …" if len(names) > MOST_LISTED else ""
    return f"{begin} {', '.join(names[:MOST_LISTED])}{more}"
