"""The entry: what a robot's joints can do, and in which order each program has them."""

from __future__ import annotations

import json
from math import isfinite

from ...diagnostics import ERROR, YamaroError
from ...model.joint import SINGLE, UNLIMITED
from ...model.kinematics import joint_positions
from ...model.pose import Pose, quaternion_from_rotation
from ...model.positions import home_positions
from ...model.schema import ACTUATOR, ELEMENTS, TEXT
from ..elements import number
from ..gains import POSITION, VELOCITY, Gains
from ..losses import LOST, Loss
from ..output import MARK, Output
from .orders import (
    UnknownOrderError,
    in_drake,
    in_isaac,
    in_mujoco,
    in_newton,
    in_pinocchio,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from ...diagnostics import Diagnostic
    from ...model.joint import Joint
    from ...model.positions import Position
    from ...model.robot import Robot
    from ..output import Wanted
    from .orders import Entry, Listing

LINE = 100
"""The length of lines."""
VERSION = 1
"""Of what the JSON holds, as `docs/interface.schema.json` describes it."""


def write(robot: Robot, wanted: Wanted) -> Output:
    """Return the interface of a robot as JSON.

    A program whose format cannot hold the robot, or which does not read that, is listed with the
    reason, which is reported.
    """
    output_in = wanted.output_in
    assert output_in is not None, "the pipeline writes other formats"
    is_fixed = wanted.is_fixed
    readers: dict[str, tuple[str, str, Callable[[Robot, Output], Listing]]] = {
        "pinocchio": ("pinocchio", "urdf", lambda *_: in_pinocchio(robot, is_fixed=is_fixed)),
        "mujoco": ("MuJoCo", "mjcf", in_mujoco),
        "drake": ("Drake", "sdf", in_drake),
        "newton": ("Newton", "usd", in_newton),
        "isaac": ("Isaac Sim", "usd", in_isaac),
    }
    outputs: dict[str, Output] = {}
    consumers: Entry = {}
    refused: dict[str, list[str]] = {}  # programs by the reason
    causes: dict[str, Diagnostic] = {}
    hints: dict[str, str] = {}
    for name, (title, format, read) in readers.items():
        try:
            if format not in outputs:
                outputs[format] = output_in(format)
            consumers[name] = {"format": format, **read(robot, outputs[format]).data()}
            continue
        except YamaroError as error:
            first = next(each for each in error.diagnostics if each.severity == ERROR)
            reason = first.message
            causes[reason] = first
        except UnknownOrderError as error:
            reason = str(error)
            hints[reason] = error.hint
        consumers[name] = {"format": format, "refused": reason}
        refused.setdefault(reason, []).append(title)
    losses = []
    for reason, titles in refused.items():
        what = f"orders of joints in {', '.join(titles)}"
        cause = causes.get(reason)
        if cause is None:
            losses.append(Loss(LOST, what, reason, robot.span, hint=hints[reason]))
        else:
            hint = cause.hint or ""
            losses.append(Loss(LOST, what, reason, cause.span, trace=cause.trace, hint=hint))
    positions = joint_positions(robot, home_positions(robot))
    gains = Gains(robot, is_fixed=is_fixed)
    data = {
        "about": MARK,
        "version": VERSION,
        "robot": robot.name or wanted.name,
        "base": "fixed" if is_fixed else "free",
        "joints": [
            _joint(robot, joint, positions.get(joint.name), gains)
            for joint in robot.joints.values()
            if robot.parent_joint(joint.child) is joint
        ],
        "links": list(robot.links),
        "sensors": [
            _given(
                name=each.name,
                type=each.type,
                link=each.link,
                joint=each.joint,
                frame=each.frame,
                rate=_plain(each.rate),
            )
            for each in robot.sensors.values()
        ],
        "states": {
            name: {joint: _plain(position) for joint, position in state.positions.items()}
            for name, state in robot.states.items()
        },
        "consumers": consumers,
    }
    return Output(None, losses, text=f"{_text(data)}\n")


def _joint(robot: Robot, joint: Joint, position: Position | None, gains: Gains) -> Entry:
    """Return what a joint can do, in radians and metres."""
    limit, mimic, dynamics = joint.limit, joint.mimic, joint.dynamics
    found = _given(name=joint.name, type=joint.type, parent=joint.parent, child=joint.child)
    if joint.type in SINGLE or joint.type == "planar":
        found["axis"] = _row(joint.axis)
    if limit is not None and joint.type in SINGLE:
        values = {name: _plain(limit.number(name)) for name in ELEMENTS["limit"].fields}
        values |= {"lower": _plain(joint.lower), "upper": _plain(joint.upper)}
        found["limit"] = _given(**values)
    if dynamics is not None:
        names = ELEMENTS["dynamics"].fields
        found["dynamics"] = {name: _plain(getattr(dynamics, name)) for name in names}
    if mimic is not None:
        found["mimic"] = {
            "joint": mimic.joint,
            "multiplier": _plain(mimic.multiplier),
            "offset": _plain(mimic.offset),
        }
    if isinstance(position, Pose):
        w, x, y, z = quaternion_from_rotation(position.rotation)
        found["home"] = _row((*position.position, x, y, z, w))
    elif isinstance(position, float):
        found["home"] = _plain(position)
    elif position is not None:
        found["home"] = _row(position)
    actuator = robot.actuators.get(joint.name)
    if actuator is not None:
        row: Entry = {"command": actuator.command}
        for name, field in ACTUATOR.fields.items():
            if field.count != TEXT:
                row[name] = _plain(actuator.number(name))
        chosen: Entry = {}
        if joint.type in SINGLE and actuator.command == POSITION:
            kp = actuator.kp if actuator.kp is not None else gains.of_position(joint)
            chosen = {"kp": kp, "kd": gains.damping(joint, kp)}
        elif joint.type in SINGLE and actuator.command == VELOCITY and actuator.kp is None:
            chosen = {"kd": gains.of_velocity(joint, actuator)}
        chosen = {name: value for name, value in chosen.items() if row.get(name) is None}
        found["actuator"] = _given(**{**row, **chosen}, chosen=list(chosen) or None)
    return found


def _text(value: object, indent: str = "", key: str = "") -> str:
    """Return a value as JSON after a key, in one line if that is not long."""
    line = json.dumps(value, ensure_ascii=False, allow_nan=False)
    if not isinstance(value, (dict, list)) or len(indent) + len(key) + len(line) < LINE:
        return f"{indent}{key}{line}"
    inner = indent + "  "
    if isinstance(value, list):
        items = [_text(each, inner) for each in value]
    else:
        items = [_text(each, inner, f"{json.dumps(name)}: ") for name, each in value.items()]
    begin, end = ("[", "]") if isinstance(value, list) else ("{", "}")
    return "\n".join((f"{indent}{key}{begin}", ",\n".join(items), indent + end))


def _given(**values: object) -> Entry:
    """Return the values that are not None."""
    return {name: value for name, value in values.items() if value is not None}


def _row(values: Iterable[float]) -> list[int | float | None]:
    return [_plain(float(value)) for value in values]


def _plain(value: float | None) -> int | float | None:
    """Return a number as it is written in other formats; None for what means no limit."""
    if value is None or not isfinite(value) or abs(value) >= UNLIMITED:
        return None
    text = number(value)
    return int(text) if text.lstrip("-").isdigit() else float(text)
