"""Keyframes: the robot's states, and where it rests if it says nothing of `home`."""

from __future__ import annotations

from ...model.kinematics import joint_positions, link_poses
from ...model.pose import IDENTITY
from ...model.positions import HOME, positions_in
from ..output import LOST
from .joints import numbers_of
from .solids import heights_at
from .writing import Writing, made, row

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.extras import State
    from ...model.pose import Pose
    from ...model.positions import Position
    from ...xml.tree import Element

_JOINTS = ("joint", "freejoint")


def add_keyframes(writing: Writing, raw: list[Element]) -> None:
    """Append a keyframe for each state, `home` first.

    Args:
        writing: the run.
        raw: the XML that the file holds for the model; its actuators come after ours.
    """
    order = _joints_in(writing.sections["worldbody"])
    if not order:
        return
    if not writing.motions.keys() >= set(order):  # of joints that the file has for MJCF alone
        for state in writing.robot.states.values():
            owner, what = f"'{state.name}'", "states of robots with joints of their own in MJCF"
            writing.lose(LOST, what, owner, state.span, trace=state.trace)
        return
    others = sum(len(each.elements()) for each in raw if each.name == "actuator")
    states = dict(writing.robot.states)
    home = states.pop(HOME, None)
    _add(writing, HOME, home, order, others)
    for name, state in states.items():
        _add(writing, name, state, order, others)


def _add(writing: Writing, name: str, state: State | None, order: list[str], others: int) -> None:
    """Append a keyframe: a number for each of `qpos`, and for each actuator, also for others."""
    given = positions_in(writing.robot, state)
    positions = joint_positions(writing.robot, given)
    heights = heights_at(writing, link_poses(writing.robot, given))
    numbers: list[float] = []
    for joint in order:
        source, part = writing.motions[joint]
        found = numbers_of(part, positions.get(source, 0.0), _origin(writing, source))
        if part in ("base", "free"):
            link = source if part == "base" else writing.robot.joints[source].child
            found[2] += heights.get(link, 0.0)
        numbers += found
    controls = [
        _number(positions.get(joint)) * gear if command == "position" else 0.0
        for joint, command, gear in writing.controls
    ]
    controls += [0.0] * others
    attributes = {
        "name": name,
        "qpos": row(numbers),
        "ctrl": row(controls) if controls else None,
    }
    owner = state or writing.robot
    trace = state.trace if state is not None else None
    writing.add("keyframe", made("key", owner, attributes, trace))


def _number(position: Position | None) -> float:
    return position if isinstance(position, float) else 0.0


def _origin(writing: Writing, source: str) -> Pose:
    """Return T_world_joint of a joint that is free in the world."""
    joint = writing.robot.joints.get(source)
    if joint is None or joint.parent not in writing.plan.static:
        return IDENTITY
    return writing.plan.static[joint.parent] @ joint.origin


def _joints_in(worldbody: Element) -> list[str]:
    """Return the names of the joints in the order in which `qpos` has them."""
    found: list[str] = []
    pending = [worldbody]
    while pending:
        element = pending.pop()
        inner = element.elements()
        found += [str(each.attributes.get("name")) for each in inner if each.name in _JOINTS]
        pending += [each for each in reversed(inner) if each.name == "body"]
    return found
