"""The table of losses: how each output format holds each field of the schema.

A row is for one field of `model/schema.py`, with a cell for each format: the name by which the
format holds the value, or the loss that is reported for it. What is lost whatever its value is
reported by going through the rows; what is approximated, or lost under some conditions only, is
reported by the writer that meets it, and the row says so. A test fails for a field without a row.
Formats that describe a part of a robot only, such as SRDF, have no cells.

Below the table are the losses that several formats report in the same words.
"""

from __future__ import annotations

from functools import cache

from ..model.extras import CAMERAS, Ranger
from ..model.joint import SINGLE, UNLIMITED
from ..model.schema import (
    ACTUATOR,
    COLLISIONS,
    CONTROL,
    CONTROLLER,
    CONTROLLERS,
    ELEMENTS,
    GROUP,
    MOMENTS,
)
from .gains import EFFORT, VELOCITY
from .losses import APPROXIMATED, LOST, Losses
from .table import TARGETS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Container, Mapping

    from ..model.extras import Actuator, Sensor
    from ..model.joint import Joint
    from ..model.robot import Robot

FORMATS = tuple(each.name for each in TARGETS.values() if each.is_whole)
"""The formats of the cells of a row, in their order."""


class Missing:
    """The cell of a field that a format does not hold as it is.

    Attributes:
        kind: LOST or APPROXIMATED.
        what: what is reported, in the plural.
        hint: what to write instead, or "".
        is_conditional: whether some values of it are held.
    """

    __slots__ = ("hint", "is_conditional", "kind", "what")

    def __init__(
        self, kind: str, what: str, *, hint: str = "", is_conditional: bool = False
    ) -> None:
        self.kind = kind
        self.what = what
        self.hint = hint
        self.is_conditional = is_conditional


Cell = str | Missing


def _lost(what: str, hint: str = "") -> Missing:
    return Missing(LOST, what, hint=hint)


def _partly(kind: str, what: str) -> Missing:
    return Missing(kind, what, is_conditional=True)


SRDF_HINT = "--to srdf writes them"
CONTROLLERS_HINT = "--to controllers writes them"
GEAR_HINT = "`transmissions: true` in the section `control` writes them"
_SENSORS = _partly(APPROXIMATED, "sensors")
_NO_SURFACE = _partly(LOST, "surfaces")
_SOFT = _lost("soft limits")
_CALIBRATION = _lost("calibrations")
_RATES = _lost("rates of sensors")
_TOPICS = _lost("topics of sensors")
_GROUPS = _lost("groups", SRDF_HINT)
_COLLISIONS = _lost("`collisions` sections", SRDF_HINT)
_CONTROLS = _lost("blocks of ros2_control")
_CONTROLLERS = _lost("controllers", CONTROLLERS_HINT)
_MANAGERS = _lost("settings of the controller manager", CONTROLLERS_HINT)
_GAINS = _lost("gains of actuators", GEAR_HINT)
_ARMATURES = _lost("armatures of actuators", GEAR_HINT)
_LINES = _lost("torque-speed lines of motors")
_SOME_LINES = _partly(LOST, "torque-speed lines of motors")
_DELAYS = _lost("delays of actuators")
_CONES = _partly(APPROXIMATED, "cones of range sensors")

ROWS: dict[str, tuple[Cell, Cell, Cell, Cell]] = {
    # field: URDF, SDF, MJCF, USD
    "robot.name": ("name", "name", "model", "defaultPrim"),
    "robot.version": ("version", "", "", ""),
    "link.name": ("name", "name", "name", "name"),
    "link.type": ("type", _lost("attributes"), _lost("attributes"), _lost("attributes")),
    "visual.name": ("name", "name", "name", "name"),
    "collision.name": ("name", "name", "name", "name"),
    "mass.value": ("value", "mass", "mass", "physics:mass"),
    **dict.fromkeys(
        (f"inertia.{name}" for name in MOMENTS),
        ("inertia", "inertia", "fullinertia", "physics:diagonalInertia"),
    ),
    "origin.xyz": ("xyz", "pose", "pos", "xformOp:translate"),
    "origin.rpy": ("rpy", "pose", "quat", "xformOp:orient"),
    "origin.quat_xyzw": ("quat_xyzw", "pose", "quat", "xformOp:orient"),
    "box.size": ("size", "size", "size", "xformOp:scale"),
    "cylinder.radius": ("radius", "radius", "size", "radius"),
    "cylinder.length": ("length", "length", "size", "height"),
    "sphere.radius": ("radius", "radius", "size", "radius"),
    "capsule.radius": ("radius", "radius", "size", "radius"),
    "capsule.length": ("length", "length", "size", "height"),
    "mesh.filename": ("filename", "uri", "file", "points"),
    "mesh.scale": ("scale", "scale", "scale", "points"),
    "material.name": ("name", _lost("names of materials"), "name", "name"),
    "color.rgba": ("rgba", "diffuse", "rgba", "inputs:diffuseColor"),
    "texture.filename": ("filename", "albedo_map", "file", "inputs:file"),
    "joint.name": ("name", "name", "name", "name"),
    "joint.type": ("type", "type", "type", "type"),
    "parent.link": ("link", "parent", "body", "physics:body0"),
    "child.link": ("link", "child", "body", "physics:body1"),
    "axis.xyz": ("xyz", "xyz", "axis", "physics:localRot0"),
    "limit.lower": ("lower", "lower", "range", "physics:lowerLimit"),
    "limit.upper": ("upper", "upper", "range", "physics:upperLimit"),
    "limit.effort": ("effort", "effort", "actuatorfrcrange", "maxForce"),
    "limit.velocity": (
        *("velocity", "velocity"),
        *(_lost("velocity limits"), "newton:velocityLimit"),
    ),
    "limit.acceleration": (
        *("acceleration", "drake:acceleration"),
        *(_lost("acceleration limits"), _lost("acceleration limits")),
    ),
    **{
        f"limit.{name}": (name, lost, lost, lost)
        for name in ("deceleration", "jerk")
        for lost in [_lost(f"{name} limits")]
    },
    "dynamics.damping": ("damping", "damping", "damping", "newton:damping"),
    "dynamics.friction": ("friction", "friction", "frictionloss", "newton:friction"),
    "dynamics.armature": (
        *(_lost("armatures of joints"), _lost("armatures of joints")),
        *("armature", "newton:armature"),
    ),
    "mimic.joint": ("joint", "joint", "joint1", "newton:mimicJoint"),
    "mimic.multiplier": ("multiplier", "multiplier", "polycoef", "newton:mimicCoef1"),
    "mimic.offset": ("offset", "offset", "polycoef", "newton:mimicCoef0"),
    **{
        f"safety_controller.{name}": (name, _SOFT, _SOFT, _SOFT)
        for name in ("soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity")
    },
    **{
        f"calibration.{name}": (name, _CALIBRATION, _CALIBRATION, _CALIBRATION)
        for name in ("rising", "falling", "reference_position")
    },
    "actuator.command": ("command_interface", "controller_gains", "class", "stiffness"),
    "actuator.kp": (_GAINS, "controller_gains", "kp", "stiffness"),
    "actuator.kd": (_GAINS, "controller_gains", "kv", "damping"),
    "actuator.frequency": (_GAINS, "controller_gains", "kp", "stiffness"),
    "actuator.damping_ratio": (_GAINS, "controller_gains", "kv", "damping"),
    **dict.fromkeys(
        ("actuator.armature", "actuator.rotor_inertia"),
        (_ARMATURES, "rotor_inertia", "armature", "newton:armature"),
    ),
    "actuator.gear": (
        *(_lost("gears of actuators", GEAR_HINT), "gear_ratio", "armature", "newton:armature"),
    ),
    **dict.fromkeys(
        ("actuator.stall_torque", "actuator.no_load_speed"),
        (_LINES, _SOME_LINES, "nominal", "newton:saturationEffort"),
    ),
    "actuator.motor": (
        *(_partly(LOST, "armatures of actuators"), "rotor_inertia", "armature", "newton:armature"),
    ),
    "actuator.delay": (
        *(_DELAYS, _DELAYS, "delay"),
        _partly(APPROXIMATED, "delays of actuators"),
    ),
    "surface.friction": (_NO_SURFACE, "mu", "friction", "physics:dynamicFriction"),
    "surface.friction2": (
        *(_NO_SURFACE, "mu2", _lost("second coefficients of friction")),
        _lost("second coefficients of friction"),
    ),
    "surface.restitution": (
        *(_NO_SURFACE, "restitution_coefficient"),
        *(_partly(APPROXIMATED, "restitutions of surfaces"), "physics:restitution"),
    ),
    "surface.stiffness": (
        *(_NO_SURFACE, "kp", _partly(APPROXIMATED, "stiffness of contacts")),
        "newton:contactStiffness",
    ),
    "surface.damping": (
        *(_NO_SURFACE, "kd", _partly(APPROXIMATED, "damping of contacts")),
        "newton:contactDamping",
    ),
    "sensor.type": (_SENSORS, "type", "sensor", _partly(LOST, "sensors")),
    "sensor.rate": (_SENSORS, "update_rate", _RATES, "sensorPeriod"),
    "sensor.noise": (
        *(_SENSORS, _partly(LOST, "noise of contact sensors")),
        *(_partly(LOST, "noise of cameras"), _partly(LOST, "noise of sensors")),
    ),
    "sensor.topic": (_SENSORS, "topic", _TOPICS, _TOPICS),
    "lidar.rays": (_SENSORS, "samples", "rangefinder", "rayDirections"),
    "lidar.angle": (_SENSORS, "min_angle", "rangefinder", "rayDirections"),
    "lidar.range": (_SENSORS, "min", "cutoff", "maxRange"),
    "lidar.rows": (_SENSORS, "samples", "rangefinder", "rayDirections"),
    "lidar.tilt": (_SENSORS, "min_angle", "rangefinder", "rayDirections"),
    **dict.fromkeys(
        ("camera.size", "depth_camera.size"),
        (_SENSORS, "width", "resolution", "resolution"),
    ),
    **dict.fromkeys(
        ("camera.fov", "depth_camera.fov"),
        (_SENSORS, "horizontal_fov", "fovy", "focalLength"),
    ),
    **dict.fromkeys(
        ("camera.clip", "depth_camera.clip"),
        (_SENSORS, "near", _lost("clip distances of cameras"), "clippingRange"),
    ),
    "range.range": (_SENSORS, "min", "cutoff", "maxRange"),
    "range.fov": (_SENSORS, _CONES, _CONES, _CONES),
    **{
        f"loop.{name}": (*(_partly(APPROXIMATED, "loops"),) * 2, "equality", "joint")
        for name in ("name", "type", "between", "axis")
    },
    **{f"group.{name}": (_GROUPS,) * 4 for name in GROUP.fields},
    **{f"collisions.{name}": (_COLLISIONS,) * 4 for name in COLLISIONS.fields},
    **{
        f"control.{name}": ("ros2_control", _CONTROLS, _CONTROLS, _CONTROLS)
        for name in CONTROL.fields
    },
    **{f"controllers.{name}": (_MANAGERS,) * 4 for name in CONTROLLERS.fields},
    **{f"controller.{name}": (_CONTROLLERS,) * 4 for name in CONTROLLER.fields},
}
"""The rows by `thing.field`."""


def cell(format: str, thing: str, field: str) -> Cell:
    """Return how a format holds a field: the name it has there, or the loss."""
    return ROWS[f"{thing}.{field}"][FORMATS.index(format)]


@cache  # it is asked for each joint
def lost_fields(format: str, thing: str) -> Mapping[str, Missing]:
    """Return the fields of a thing that a format loses whatever they are, each with the loss."""
    found = {}
    for name, cells in ROWS.items():
        owner, _, field = name.partition(".")
        own = cells[FORMATS.index(format)]
        if owner == thing and isinstance(own, Missing) and not own.is_conditional:
            found[field] = own
    return found


# --- sections -----------------------------------------------------------------------------------


def lost_sections(robot: Robot, *, states: bool = False, controls: bool = False) -> Losses:
    """Return the losses of a format without groups, and without what is named.

    Args:
        robot: the robot.
        states: whether named positions are lost.
        controls: whether the hardware that drives joints is lost.
    """
    found = Losses()
    for control in robot.controls if controls else ():
        found.lose("blocks of ros2_control", control, label=f"'{control.name or robot.name}'")
    for state in robot.states.values() if states else ():
        found.lose("states", state, hint=SRDF_HINT)
    for group in robot.groups.values():
        found.lose("groups", group, hint=SRDF_HINT)
    for controller in robot.controllers.values():
        found.lose(_CONTROLLERS.what, controller, hint=CONTROLLERS_HINT)
    if robot.controller_manager is not None:
        manager = robot.controller_manager
        found.lose(_MANAGERS.what, manager, label="the robot", hint=CONTROLLERS_HINT)
    if robot.collision_settings is not None:
        what, settings = "`collisions` sections", robot.collision_settings
        found.lose(what, settings, label="the robot", hint=SRDF_HINT)
    return found


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
    bounded: Container[str] = (),
) -> Losses:
    """Return what a format has no place for in the joints of the tree, as its rows say.

    Args:
        robot: the robot.
        format: the format.
        has_mimic: whether this version of it has joints that follow others, if the format has.
        has_dynamics: which types of joints of no or several numbers have damping and friction.
        mimic_hint: what to do about joints that follow others.
        bounded: the names of joints whose motor keeps them below the velocity of their limit.
    """
    has_mimic = has_mimic and not lost_fields(format, "mimic")
    found, of_dynamics = Losses(), Losses()
    for joint in robot.joints.values():
        if robot.parent_joint(joint.child) is not joint:
            continue  # all of it is lost
        limit, dynamics, mimic = joint.limit, joint.dynamics, joint.mimic
        if joint.type in SINGLE:
            if limit is not None:
                for name, missing in lost_fields(format, "limit").items():
                    value = limit.number(name)
                    is_kept = name == "velocity" and joint.name in bounded
                    if value is not None and abs(value) < UNLIMITED and not is_kept:
                        found.lose(missing.what, joint, part=limit, field=name)
            if dynamics is not None:
                for name, missing in lost_fields(format, "dynamics").items():
                    if dynamics.number(name):
                        of_dynamics.lose(missing.what, joint, part=dynamics, field=name)
        else:  # numbers that it has no use for; zeros mean nothing there
            if limit is not None and any(map(limit.number, ELEMENTS["limit"].fields)):
                found.lose(f"limits of {joint.type} joints", joint, part=limit)
            if dynamics is not None and joint.type not in has_dynamics:
                if dynamics.damping or dynamics.friction:
                    what = f"damping and friction of {joint.type} joints"
                    found.lose(what, joint, part=dynamics)
                if dynamics.armature:
                    what = f"armatures of {joint.type} joints"
                    found.lose(what, joint, part=dynamics, field="armature")
        if mimic is not None and leader_of(robot, joint) is None:
            found.lose("mimic joints that cannot follow another joint", joint, part=mimic)
        elif mimic is not None and not has_mimic:
            found.lose("mimic joints", joint, part=mimic, hint=mimic_hint)
        for name, part in (
            ("safety_controller", joint.safety_controller),
            ("calibration", joint.calibration),
        ):
            if part is not None:  # all of it is lost as one
                for what in dict.fromkeys(each.what for each in lost_fields(format, name).values()):
                    found.lose(what, joint, part=part)
    found += of_dynamics
    return found


# --- actuators ----------------------------------------------------------------------------------


def lost_values(actuator: Actuator, format: str, *, but: Container[str] = ()) -> Losses:
    """Return what the rows say is lost of an actuator; values that follow from one place once.

    Args:
        actuator: the actuator.
        format: the format.
        but: the names of values that are held there.
    """
    found = Losses()
    told = set()
    for name, missing in lost_fields(format, "actuator").items():
        usual = ACTUATOR.fields[name].default or 0.0
        place = (missing.what, actuator.span_of(name).key())
        if name not in but and place not in told and getattr(actuator, name) not in (None, usual):
            told.add(place)
            found.lose(missing.what, actuator, field=name, hint=missing.hint)
    return found


def lost_lines(actuator: Actuator, *, hint: str = "") -> Losses:
    """Return what a format loses whose efforts are bounded alike at all speeds.

    A stall torque without a no-load speed is such a bound.

    Args:
        actuator: the actuator.
        hint: what to write instead.
    """
    found = Losses()
    if actuator.no_load_speed is not None:
        for name in ("stall_torque", "no_load_speed"):
            if getattr(actuator, name) is not None:
                found.lose("torque-speed lines of motors", actuator, field=name, hint=hint)
    return found


def lost_of_actuator(
    actuator: Actuator, *, commands: Container[str] = (), gains: Container[str] = ()
) -> Losses:
    """Return what a format loses whose actuators take one command each, with the gains of that.

    The gains of a velocity actuator are one number, `kd` or else `kp`; an effort actuator has none.

    Args:
        actuator: the actuator.
        commands: further commands that its joint takes.
        gains: further gains that the format holds.
    """
    lost = Losses()
    others = set(actuator.commands) - {actuator.command}
    if any(each not in commands for each in others):
        lost.lose("further commands of actuators", actuator, field="command")
    given = [name for name in ("kd", "kp") if getattr(actuator, name) is not None]
    if actuator.command == EFFORT:
        for name in reversed(given):
            if name not in gains:
                lost.lose("gains of effort actuators", actuator, field=name)
    elif actuator.command == VELOCITY:
        for name in given[1:]:
            if name not in gains:
                lost.lose("second gains of velocity actuators", actuator, field=name)
    return lost


# --- sensors ------------------------------------------------------------------------------------


def renamed_sensors(robot: Robot, *, but: Container[str] = ()) -> Losses:
    """Return the sensors that the model calls otherwise, since their names are not unique.

    Args:
        robot: the robot.
        but: the names of sensors that the format calls as they are written.
    """
    found = Losses()
    for sensor in robot.sensors.values():
        if sensor.written_name != sensor.name and sensor.name not in but:
            label = f"sensor '{sensor.written_name}'"
            found.rename("sensors", sensor, label=label, new=sensor.name)
    return found


def lost_of_sensor(sensor: Sensor, format: str) -> Losses:
    """Return what a format has no place for in what all sensors have; cameras have no noise."""
    found = Losses()
    for name, missing in lost_fields(format, "sensor").items():
        if getattr(sensor, name) is not None:
            found.lose(missing.what, sensor, field=name)
    if sensor.noise and sensor.type in CAMERAS:
        found.lose("noise of cameras", sensor, field="noise")
    return found


def cones(robot: Robot, *, but: Container[str] = ()) -> Losses:
    """Return what formats make of the cones of range sensors that measure along one ray.

    Args:
        robot: the robot.
        but: the names of sensors that are written as they are.
    """
    found = Losses()
    for sensor in robot.sensors.values():
        if isinstance(sensor.details, Ranger) and sensor.details.fov and sensor.name not in but:
            found.approximate("cones of range sensors", sensor, field="fov", how="one ray")
    return found
