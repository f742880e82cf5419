"""What of a robot has no place in several formats, in the same words for each of them."""

from __future__ import annotations

from ..model.extras import CAMERAS, Ranger
from ..model.joint import SINGLE, UNLIMITED
from ..model.schema import ELEMENTS
from .gains import EFFORT, VELOCITY
from .holding import SRDF_HINT, lost_fields
from .output import APPROXIMATED, LOST, RENAMED, Loss

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Container

    from ..model.extras import Actuator, Noted, Sensor
    from ..model.joint import Dynamics, Joint, Limit
    from ..model.robot import Robot
    from ..model.values import Written


# --- sections -----------------------------------------------------------------------------------


def lost_sections(
    robot: Robot, *, states: bool = False, actuators: bool = False, controls: bool = False
) -> list[Loss]:
    """Return the losses of a format without groups, and without what is named.

    Args:
        robot: the robot.
        states: whether named positions are lost.
        actuators: whether actuators are lost.
        controls: whether the hardware that drives joints is lost.
    """
    found: list[Loss] = []
    if actuators:
        found += [
            _noted("actuators", f"joint '{each.joint}'", each) for each in robot.actuators.values()
        ]
    if controls:
        found += [
            _noted("blocks of ros2_control", f"'{each.name or robot.name}'", each)
            for each in robot.controls
        ]
    if states:
        found += [
            _noted("states", f"state '{each.name}'", each, SRDF_HINT)
            for each in robot.states.values()
        ]
    found += [
        _noted("groups", f"group '{each.name}'", each, SRDF_HINT) for each in robot.groups.values()
    ]
    settings = robot.collision_settings
    if settings is not None:
        found.append(_noted("`collisions` sections", "the robot", settings, SRDF_HINT))
    return found


def _noted(what: str, owner: str, noted: Noted | Sensor, hint: str = "") -> Loss:
    return Loss(LOST, what, owner, noted.span, trace=noted.trace, hint=hint)


# --- joints -------------------------------------------------------------------------------------


def leader_of(robot: Robot, joint: Joint) -> Joint | None:
    """Return the joint that a joint follows; None if it follows none, or one of them cannot."""
    if joint.mimic is None or joint.type not in SINGLE:
        return None
    leader = robot.joints.get(joint.mimic.joint)
    return leader if leader is not None and leader.type in SINGLE else None


def lost_of_joints(
    robot: Robot,
    format: str,
    *,
    has_mimic: bool = True,
    has_dynamics: Container[str] = (),
    mimic_hint: str = "",
) -> list[Loss]:
    """Return what a format has no place for in the joints of the tree, as its rows say.

    Args:
        robot: the robot.
        format: the format.
        has_mimic: whether this version of it has joints that follow others, if the format has.
        has_dynamics: which types of joints of no or several numbers have damping and friction.
        mimic_hint: what to do about joints that follow others.
    """
    has_mimic = has_mimic and not lost_fields(format, "mimic")
    found: list[Loss] = []
    of_dynamics: list[Loss] = []
    for joint in robot.joints.values():
        if robot.parent_joint(joint.child) is not joint:
            continue  # all of it is lost
        if joint.type in SINGLE:
            found += _lost_values(joint, joint.limit, format)
            of_dynamics += _lost_values(joint, joint.dynamics, format)
        else:
            found += _lost_numbers(joint, has_dynamics=joint.type in has_dynamics)
        if joint.mimic is not None and leader_of(robot, joint) is None:
            what = "mimic joints that cannot follow another joint"
            found.append(_lost_in(joint, joint.mimic, what))
        elif joint.mimic is not None and not has_mimic:
            found.append(_lost_in(joint, joint.mimic, "mimic joints", hint=mimic_hint))
        for name, part in (
            ("safety_controller", joint.safety_controller),
            ("calibration", joint.calibration),
        ):
            if part is not None:  # all of it is lost as one
                found += [
                    _lost_in(joint, part, what)
                    for what in dict.fromkeys(
                        each.what for each in lost_fields(format, name).values()
                    )
                ]
    return [*found, *of_dynamics]


def _lost_values(joint: Joint, part: Limit | Dynamics | None, format: str) -> list[Loss]:
    """Return the losses of values of a limit or of dynamics, unless they change nothing."""
    if part is None:
        return []
    thing = "limit" if part is joint.limit else "dynamics"
    lost = lost_fields(format, thing)
    given = {name: part.number(name) for name in lost}
    return [
        _lost_in(joint, part, lost[name].what, attribute=name)
        for name, value in given.items()
        if value is not None and (abs(value) < UNLIMITED if thing == "limit" else value != 0)
    ]


def _lost_numbers(joint: Joint, *, has_dynamics: bool) -> list[Loss]:
    """Return the losses of numbers that a joint has no use for; zeros mean nothing there."""
    found = []
    limit, dynamics = joint.limit, joint.dynamics
    if limit is not None and any(map(limit.number, ELEMENTS["limit"].fields)):
        found.append(_lost_in(joint, limit, f"limits of {joint.type} joints"))
    if dynamics is not None and not has_dynamics and (dynamics.damping or dynamics.friction):
        found.append(_lost_in(joint, dynamics, f"damping and friction of {joint.type} joints"))
    return found


def _lost_in(
    joint: Joint, part: Written, what: str, *, attribute: str = "", hint: str = ""
) -> Loss:
    span = part.span_of(attribute) if attribute else part.span
    owner = f"joint '{joint.name}'"
    return Loss(LOST, what, owner, span, trace=part.trace_in(joint), hint=hint)


# --- actuators ----------------------------------------------------------------------------------


def lost_of_actuator(actuator: Actuator) -> list[Loss]:
    """Return what a format loses whose actuators take one command each, with the gains of that.

    The gains of a velocity actuator are one number, `kp` or else `kd`; an effort actuator has none.
    """
    lost = []
    if set(actuator.commands) - {actuator.command}:
        lost.append(("further commands of actuators", "command"))
    gains = [name for name in ("kp", "kd") if getattr(actuator, name) is not None]
    if actuator.command == EFFORT:
        lost += [("gains of effort actuators", name) for name in gains]
    elif actuator.command == VELOCITY:
        lost += [("second gains of velocity actuators", name) for name in gains[1:]]
    owner, trace = f"joint '{actuator.joint}'", actuator.trace
    return [
        Loss(LOST, what, owner, actuator.span_of(attribute), trace=trace)
        for what, attribute in lost
    ]


# --- sensors ------------------------------------------------------------------------------------


def renamed_sensors(robot: Robot, *, but: Container[str] = ()) -> list[Loss]:
    """Return the sensors that the model calls otherwise, since their names are not unique.

    Args:
        robot: the robot.
        but: the names of sensors that the format calls as they are written.
    """
    return [
        Loss(
            RENAMED,
            "sensors",
            f"sensor '{sensor.written_name}'",
            sensor.span,
            trace=sensor.trace,
            how=sensor.name,
        )
        for sensor in robot.sensors.values()
        if sensor.written_name != sensor.name and sensor.name not in but
    ]


def lost_of_sensor(sensor: Sensor, format: str) -> list[Loss]:
    """Return what a format has no place for in what all sensors have; cameras have no noise."""
    lost = {name: missing.what for name, missing in lost_fields(format, "sensor").items()}
    given = [name for name in lost if getattr(sensor, name) is not None]
    found = [lost_in_sensor(sensor, lost[name], name) for name in given]
    if sensor.noise and sensor.type in CAMERAS:
        found.append(lost_in_sensor(sensor, "noise of cameras", "noise"))
    return found


def cones(robot: Robot, *, but: Container[str] = ()) -> list[Loss]:
    """Return what formats make of the cones of range sensors that measure along one ray.

    Args:
        robot: the robot.
        but: the names of sensors that are written as they are.
    """
    return [
        Loss(
            APPROXIMATED,
            "cones of range sensors",
            f"sensor '{sensor.name}'",
            sensor.span_of("fov"),
            trace=sensor.trace,
            how="one ray",
        )
        for sensor in robot.sensors.values()
        if isinstance(sensor.details, Ranger) and sensor.details.fov and sensor.name not in but
    ]


def lost_in_sensor(sensor: Sensor, what: str, attribute: str = "") -> Loss:
    """Return the loss of a sensor, or of a value of it."""
    span = sensor.span_of(attribute) if attribute else sensor.span
    return Loss(LOST, what, f"sensor '{sensor.name}'", span, trace=sensor.trace)
