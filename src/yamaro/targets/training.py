"""What frameworks for training take of a robot: what drives its joints, in groups, as Python.

All values are those at the joint, as MJCF and USD have them too. Frameworks select joints by
regular expressions: each name is escaped, so that it matches that joint alone.
"""

from __future__ import annotations

import json
import re
from math import isfinite

from ..diagnostics import WARNING, Diagnostic
from ..model.joint import UNLIMITED
from ..model.positions import HOME
from ..xml.values import format_value
from .gains import EFFORT, POSITION, VELOCITY, Gains
from .output import FOLDER, Output

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from ..model.extras import Actuator
    from ..model.joint import Joint
    from ..model.robot import Robot
    from .losses import Losses

TIME_STEP = 0.005
"""The time step in s of the tasks of both frameworks, by default, in which delays are counted."""
SOFT_LIMITS = 0.9
"""The part of a joint's range that both frameworks let their own robots use."""
STRENGTH = 0.25
"""The part of its greatest effort for which an action of 1 asks at first, as for G1 in mjlab and in
whole_body_tracking (HybridRobotics)."""
UNFIT = "unfit-for-training"
"""The code of what a framework would refuse."""
LINE = 100
"""The length of lines."""


class Drive:
    """What drives a joint.

    Attributes:
        name: what the framework calls the joint.
        joint: the joint.
        actuator: what the robot says of its actuator.
        command: `position`, `velocity` or `effort`.
        stiffness, damping: the gains, in N·m/rad and N·m·s/rad, or N/m and N·s/m.
        is_chosen: whether one of them is not given, and chosen.
        effort: the greatest effort, in N·m or N; None without limit.
        fastest: the limit of its velocity, in rad/s or m/s; None without.
        line: the stall torque and the no-load speed of the motor; None if one is not given.
        armature, friction, viscous: what resists, 0 if nothing.
        delay: in s.
    """

    __slots__ = (
        "actuator", "armature", "command", "damping", "delay", "effort", "fastest", "friction",
        "is_chosen", "joint", "line", "name", "stiffness", "viscous",
    )  # fmt: skip

    def __init__(self, name: str, joint: Joint, actuator: Actuator, gains: Gains) -> None:
        self.name = name
        self.joint = joint
        self.actuator = actuator
        self.command = actuator.command if actuator.command in (POSITION, VELOCITY) else EFFORT
        self.stiffness = self.damping = 0.0
        self.is_chosen = False
        if self.command == POSITION:
            kp, kd = actuator.kp, actuator.kd
            self.is_chosen = kp is None or kd is None
            self.stiffness = kp if kp is not None else gains.of_position(joint)
            self.damping = kd if kd is not None else gains.damping(joint, self.stiffness)
        elif self.command == VELOCITY:
            self.is_chosen = actuator.kp is None and actuator.kd is None
            self.damping = gains.of_velocity(joint, actuator)
        limit, dynamics = joint.limit, joint.dynamics
        stall, speed = actuator.stall_torque, actuator.no_load_speed
        efforts = [_positive(limit.effort) if limit is not None else None, stall]
        self.effort = min((each for each in efforts if each is not None), default=None)
        self.fastest = _positive(limit.velocity) if limit is not None else None
        self.line = (stall, speed) if stall is not None and speed is not None else None
        self.armature = actuator.armature or 0.0
        self.friction = dynamics.friction if dynamics is not None else 0.0
        self.viscous = dynamics.damping if dynamics is not None else 0.0
        self.delay = actuator.delay or 0.0


def _positive(value: float | None) -> float | None:
    return value if value is not None and 0 < value < UNLIMITED else None


def drives_of(robot: Robot, names: Mapping[str, str], *, is_fixed: bool) -> list[Drive]:
    """Return what drives the independent joints of a robot, in the order of the joints.

    Args:
        robot: the robot.
        names: what the framework calls its joints.
        is_fixed: whether its root is fixed in the world.
    """
    gains = Gains(robot, is_fixed=is_fixed)
    return [
        Drive(names[name], robot.joints[name], actuator, gains)
        for name, actuator in robot.actuators.items()
        if name in names and is_independent(robot, name)
    ]


def is_independent(robot: Robot, name: str) -> bool:
    """Return whether a joint of the tree has one position, and follows no other joint."""
    joint = robot.joints.get(name)
    return joint is not None and joint.is_free and robot.parent_joint(joint.child) is joint


def _undriven(robot: Robot, title: str) -> list[Diagnostic]:
    """Return a warning if a policy has nothing to move; else nothing."""
    if any(is_independent(robot, name) for name in robot.actuators):
        return []
    movable = [each.name for each in robot.joints.values() if is_independent(robot, each.name)]
    hint = "write `actuator: {command: position}` in the joints that have motors"
    if movable:
        hint += f", such as '{movable[0]}'"
    return [
        Diagnostic(
            "nothing-driven",
            f"no joint has an actuator, so that a policy in {title} has nothing to move",
            robot.span,
            hint=hint,
            severity=WARNING,
        )
    ]


def steps(delay: float) -> Code | int:
    """Return the steps of a delay in s as Python, counted where the time step is known."""
    return Code(f"round({delay!r} / timestep)") if delay else 0


def lose_parts_of_steps(losses: Losses, drives: Iterable[Drive]) -> None:
    """Note the delays that are not a number of steps, with the default time step."""
    for drive in drives:
        count = drive.delay / TIME_STEP
        if abs(count - round(count)) > 1e-9 * max(count, 1.0):
            losses.approximate(
                "delays of actuators", drive.actuator, field="delay", how="whole time steps"
            )


def scales_of(drives: Iterable[Drive]) -> dict[str, float]:
    """Return by which angle or length an action of 1 moves the target of each joint."""
    return {
        pattern(drive.name): STRENGTH * drive.effort / drive.stiffness
        for drive in drives
        if drive.command == POSITION and drive.effort is not None and drive.stiffness > 0
    }


def pattern(name: str) -> str:
    """Return the regular expression that matches a name alone, if it has to match whole names."""
    return re.escape(name)


def grouped(drives: Iterable[Drive], make: Callable[[Drive], Call]) -> list[tuple[str, Call]]:
    """Return the calls that configure drives, one for all with equal values, each with a name.

    Args:
        drives: what drives the joints.
        make: returns the call for one joint, without the joints that it is for.
    """
    found: dict[str, tuple[Call, list[Drive]]] = {}
    for drive in drives:
        call = make(drive)
        found.setdefault(python(call), (call, []))[1].append(drive)
    names: dict[str, Call] = {}
    for call, alike in found.values():
        first = alike[0]
        stem = first.actuator.motor or first.name.removesuffix("_joint") or first.name
        name, count = stem, 2
        while name in names:
            name, count = f"{stem}_{count}", count + 1
        selector, rest = next(iter(call.arguments)), call.arguments
        rest[selector] = type(rest[selector])(pattern(each.name) for each in alike)  # type: ignore[call-arg]
        if any(each.is_chosen for each in alike):
            call.comment = "Yamaro has chosen gains that the robot does not say."
        names[name] = call
    return list(names.items())


# --- Python -----------------------------------------------------------------------------------


class Code:
    """Python as it is."""

    __slots__ = ("text",)

    def __init__(self, text: str) -> None:
        self.text = text


class Call:
    """A call in Python, with named arguments.

    Attributes:
        function: the name of the function or class.
        arguments: by name; one named `**` is written in front of a call that gives more of them.
        comment: above the call, or "".
    """

    __slots__ = ("arguments", "comment", "function")

    def __init__(self, function: str, arguments: Mapping[str, object]) -> None:
        self.function = function
        self.arguments = dict(arguments)
        self.comment = ""


def python(value: object, before: str = "", indent: str = "") -> str:
    """Return a value as Python: a call, a collection, a text, a number or `Code`.

    Args:
        value: the value.
        before: what is before it in its line, after the indent.
        indent: the indent of the line.
    """
    line = _in_a_line(value)
    if line is not None and len(indent) + len(before) + len(line) < LINE:
        return before + line
    found = _pieces(value)
    if found is None:
        return before + (line or "")
    begin, items, end = found
    inner = f"{indent}    "
    lines = [before + begin]
    for prefix, item in items:
        if isinstance(item, Call) and item.comment:
            lines.append(f"{inner}# {item.comment}")
        lines.append(f"{inner}{python(item, prefix, inner)},")
    return "\n".join((*lines, indent + end))


def _pieces(value: object) -> tuple[str, Sequence[tuple[str, object]], str] | None:
    """Return how a collection or a call begins, what is in it, and how it ends."""
    match value:
        case Call():
            named = value.arguments.items()
            items = [("**" if key == "**" else f"{key}=", each) for key, each in named]
            return f"{value.function}(", items, ")"
        case dict():
            return "{", [(f"{_in_a_line(key)}: ", each) for key, each in value.items()], "}"
        case list():
            return "[", [("", each) for each in value], "]"
        case tuple():
            return "(", [("", each) for each in value], ")"
    return None


def _in_a_line(value: object) -> str | None:
    """Return a value as Python in one line, or None if a comment is in it."""
    match value:
        case Code():
            return value.text
        case str():
            return json.dumps(value, ensure_ascii=False)
        case float():
            return format_value(value) if isfinite(value) else f'float("{value}")'
    found = _pieces(value)
    if found is None:
        return repr(value)
    begin, items, end = found
    if any(isinstance(item, Call) and item.comment for _, item in items):
        return None
    inner = [(prefix, _in_a_line(item)) for prefix, item in items]
    if any(text is None for _, text in inner):
        return None
    comma = "," if isinstance(value, tuple) and len(inner) == 1 else ""
    return begin + ", ".join(f"{prefix}{text}" for prefix, text in inner) + comma + end


def imported(module: str, names: Iterable[str]) -> str:
    """Return the import of names from a module, or "" if there are none."""
    given = sorted(set(names))
    line = f"from {module} import {', '.join(given)}"
    if len(line) > LINE:
        inner = "".join(f"    {name},\n" for name in given)
        line = f"from {module} import (\n{inner})"
    return f"{line}\n" if given else ""


# --- files ------------------------------------------------------------------------------------


def configured(
    robot: Robot,
    name: str,
    title: str,
    losses: Losses,
    ending: str,
    model: str,
    assets: Mapping[str, bytes],
    text_of: Callable[[str], str],
) -> Output:
    """Return the configuration of a robot, with the model that it loads beside it.

    Of the states it has `home` alone.

    Args:
        robot: the robot.
        name: of its file, for a robot without a name.
        title: of the framework.
        losses: those so far.
        ending: of the file of the model, which is named by its content.
        model: its text.
        assets: the files that the model refers to.
        text_of: returns the configuration, given the path of the model.
    """
    from ..files.made import named_by_content
    from .table import module_stem

    for state in robot.states.values():
        if state.name != HOME:
            losses.lose("states", state)
    data = model.encode()
    path = f"{FOLDER}/{named_by_content(module_stem(robot.name or name), ending, [data])}"
    warnings = _undriven(robot, title)
    return Output(None, losses, {path: data, **assets}, text=text_of(path), warnings=warnings)


def path_beside(path: str) -> str:
    """Return a path beside the file as Python."""
    parts = " / ".join(json.dumps(part) for part in path.split("/"))
    return f"Path(__file__).parent / {parts}"
