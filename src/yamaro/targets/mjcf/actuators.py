"""Actuators, and gains for those that are given none."""

from __future__ import annotations

from math import inf

from ...model.joint import SINGLE
from ..gains import EFFORT, POSITION, VELOCITY, Gains
from ..output import LOST
from ..shared_losses import lost_of_actuator
from .joints import effort_of, range_of
from .names import ACTUATOR
from .writing import Writing, made, number, row

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.extras import Actuator
    from ...model.joint import Joint
    from ...source import Span

WORDS = {POSITION: "position", VELOCITY: "velocity", EFFORT: "motor"}


def add_actuators(writing: Writing) -> None:
    """Append the actuators, in the order of the joints."""
    robot = writing.robot
    gains = Gains(robot, is_fixed=writing.wanted.is_fixed, has_armature=True)
    for name, actuator in robot.actuators.items():
        joint = robot.joints.get(name)
        is_driven = joint is not None and joint.type in SINGLE and joint.mimic is None
        if joint is None or not is_driven or robot.parent_joint(joint.child) is not joint:
            owner, what = (
                f"joint '{name}'",
                "actuators of joints that are not independent",
            )
            writing.lose(LOST, what, owner, actuator.span, trace=actuator.trace)
            continue
        _add(writing, actuator, joint, gains)


def _add(writing: Writing, actuator: Actuator, joint: Joint, gains: Gains) -> None:
    """Append an actuator.

    Its control is the position, velocity or effort of the motor: with a gear, not of the joint.
    """
    writing.losses += lost_of_actuator(actuator)
    gear = actuator.gear or 1.0
    command = actuator.command
    effort = effort_of(joint)
    force = (-effort / abs(gear), effort / abs(gear)) if effort is not None else None
    places: dict[str, Span] = {"joint": actuator.span_of("joint")}
    for key, source in (("kp", "kp"), ("kv", "kd"), ("gear", "gear")):
        places[key] = actuator.span_of(source)
    if joint.limit is not None:
        places["forcerange"] = joint.limit.span_of("effort")
    control = _control(joint, command, gear, force)
    attributes = {
        "name": writing.names.fresh(ACTUATOR, joint.name),
        "joint": joint.name,
        **_gains(actuator, joint, gains, gear * gear),
        "gear": number(gear) if gear != 1 else None,
        "ctrlrange": row(control) if control is not None else None,
        "forcerange": row(force) if force is not None and command != EFFORT else None,
    }
    writing.controls.append((joint.name, command, gear))
    element = made(WORDS.get(command, "motor"), actuator, attributes, actuator.trace, places)
    writing.add("actuator", element)


def _control(
    joint: Joint, command: str, gear: float, force: tuple[float, float] | None
) -> tuple[float, float] | None:
    """Return the least and the greatest control, or None for no limits."""
    if command == EFFORT:
        return force
    if command == VELOCITY:
        fastest = joint.limit.velocity if joint.limit is not None else None
        if fastest is None or not 0 < fastest < inf:
            return None
        return (-fastest * abs(gear), fastest * abs(gear))
    ends = range_of(joint)
    if ends is None:
        return None
    lower, upper = sorted((ends[0] * gear, ends[1] * gear))
    return (lower, upper)


def _gains(actuator: Actuator, joint: Joint, gains: Gains, ratio: float) -> dict[str, str | None]:
    """Return the gains of a servo, at the motor; those of the joint are `ratio` times as large."""
    if actuator.command == EFFORT:
        return {}
    if actuator.command == VELOCITY:
        return {"kv": number(gains.of_velocity(joint, actuator) / ratio)}
    stiffness = actuator.kp if actuator.kp is not None else gains.of_position(joint)
    found: dict[str, str | None] = {"kp": number(stiffness / ratio)}
    if actuator.kd is not None:
        found["kv"] = number(actuator.kd / ratio)
    else:
        found["dampratio"] = "1"
    return found
