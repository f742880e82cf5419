"""The entry: the configuration of an articulation, and the USD that it spawns.

What USD holds of actuators and of the state `home` is in the configuration too, which Isaac Lab
prefers. A delay and a torque-speed line together are in none of its actuators.
"""

from __future__ import annotations

from ...diagnostics import failure
from ...model.joint import SINGLE
from ...model.kinematics import joint_positions
from ...model.pose import UNTURNED, quaternion_from_rotation
from ...model.positions import home_positions
from ...model.schema import COMMANDS
from ..holding import lost_of_actuator
from ..interface.orders import UnknownOrderError, in_isaac
from ..losses import Losses
from ..mjcf.scene import free_pose_at_home
from ..output import FOLDER, MARK, Output
from ..training import (
    SOFT_LIMITS,
    TIME_STEP,
    UNFIT,
    Call,
    Code,
    configured,
    drives_of,
    grouped,
    imported,
    is_independent,
    lose_parts_of_steps,
    path_beside,
    pattern,
    python,
    scales_of,
    steps,
)
from ..usd.writer import write as write_usd

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.joint import Joint
    from ...model.robot import Robot
    from ..interface.orders import Listing
    from ..output import Wanted
    from ..training import Drive

TITLE = "Isaac Lab"
IMPLICIT, DELAYED, LINE_MOTOR = "ImplicitActuatorCfg", "DelayedPDActuatorCfg", "DCMotorCfg"
"""The configurations of actuators, in `isaaclab.actuators`."""
HELD = ("delays of actuators", "further commands of actuators", "states")
"""Losses of USD that are worked out again, as the configuration holds them or some of them."""
ROOM = 1e-6
"""How far, in rad or m, a position at a limit is put inside of it: Isaac Lab compares the two in
single precision, after the limit was in degrees."""


def write(robot: Robot, wanted: Wanted) -> Output:
    """Return the configuration of a robot as Python, with the USD beside it.

    Raises:
        YamaroError: Isaac Lab would refuse the robot, or USD cannot hold it.
    """
    model = write_usd(robot, wanted)
    try:
        listing = in_isaac(robot, model)
    except UnknownOrderError as error:
        message = f"{TITLE} takes one articulation: {error}"
        raise failure(UNFIT, message, robot.span, hint=error.hint or None) from None
    names = {
        str(each["yamaro"]): str(each["name"])
        for each in listing.joints
        if robot.joints[str(each["yamaro"])].type in SINGLE
    }
    drives = drives_of(robot, names, is_fixed=wanted.is_fixed)
    losses = Losses(each for each in model.losses if each.what not in HELD)
    _lose_what_is_not_held(robot, drives, losses)
    start = _start(robot, wanted, names, listing)
    output = configured(
        robot, wanted.name, TITLE, losses, ".usda", _spawned(model.text), model.files,
        lambda path: _text(path, start, drives),
    )  # fmt: skip
    output.warnings = [*model.warnings, *output.warnings]
    return output


def _spawned(text: str) -> str:
    """Return a layer of USD as Isaac Lab spawns it from the folder of its textures.

    It is without actuators for Newton, which would act beside those of the configuration.
    """
    from pxr import Sdf, UsdUtils

    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(text)
    UsdUtils.ModifyAssetPaths(layer, lambda path: path.replace(f"./{FOLDER}/", "./", 1))
    robot = layer.GetPrimAtPath(f"/{layer.defaultPrim}")
    for scope in list(robot.nameChildren):
        if any(each.typeName == "NewtonActuator" for each in scope.nameChildren):
            del robot.nameChildren[scope.name]
    return str(layer.ExportToString())


def _lose_what_is_not_held(robot: Robot, drives: list[Drive], losses: Losses) -> None:
    """Note the losses of actuators and states that USD has too, and this has not, and others."""
    lose_parts_of_steps(losses, [each for each in drives if each.line is None])
    for name, actuator in robot.actuators.items():
        if not is_independent(robot, name):
            losses.lose("actuators of joints that are not independent", actuator)
        else:  # gains that Newton has, as actuators beside drives
            losses += lost_of_actuator(actuator, commands=COMMANDS)
    for drive in drives:
        if drive.line is not None and drive.delay:
            what = "delays of motors with a torque-speed line"
            losses.lose(what, drive.actuator, field="delay")


# --- what is written --------------------------------------------------------------------------


def _start(robot: Robot, wanted: Wanted, names: dict[str, str], listing: Listing) -> Call:
    """Return the state that a robot starts in."""
    found: dict[str, object] = {}
    pose = free_pose_at_home(robot, wanted, str(listing.bodies[0]["yamaro"]))
    if pose is not None:
        found["pos"] = tuple(pose.position)
        if pose.rotation != UNTURNED:
            numbers = zip("wxyz", quaternion_from_rotation(pose.rotation), strict=True)
            found["rot"] = Call("quaternion", dict(numbers))
    home = joint_positions(robot, home_positions(robot))
    positions = {}
    for name, new in names.items():
        position = home.get(name, 0.0)
        if isinstance(position, float):
            position = _inside(robot.joints[name], position)
            if position:
                positions[pattern(new)] = position
    if positions:
        found["joint_pos"] = positions
    elif not listing.joints:  # of which `.*` would have to match one
        found["joint_pos"] = found["joint_vel"] = {}
    return Call("ArticulationCfg.InitialStateCfg", found)


def _inside(joint: Joint, position: float) -> float:
    """Return a position, a little inside of a limit that it is at, which is not 0."""
    lower, upper = joint.lower, joint.upper
    if lower is None or upper is None or upper - lower < 4 * ROOM:
        return position
    room = ROOM * max(1.0, abs(position))
    if lower and position < lower + room:
        return lower + room
    return upper - room if upper and position > upper - room else position


def _actuator(drive: Drive) -> Call:
    """Return the configuration of an actuator; the joints that it drives are filled in later."""
    found: dict[str, object] = {
        "joint_names_expr": [], "stiffness": drive.stiffness, "damping": drive.damping
    }  # fmt: skip
    limits: dict[str, object] = {}
    if drive.fastest is not None:
        limits["joint_velocity_limit"] = drive.fastest
    function = IMPLICIT
    if drive.line is not None:
        function = LINE_MOTOR
        found["saturation_effort"], limits["actuator_velocity_limit"] = drive.line
    elif drive.delay:
        function = DELAYED
        found["min_delay"] = found["max_delay"] = steps(drive.delay)
    if drive.effort is not None:
        is_implicit = function == IMPLICIT
        limits["joint_effort_limit" if is_implicit else "actuator_effort_limit"] = drive.effort
    if drive.armature:
        found["armature"] = drive.armature
    if drive.friction:
        found["friction"] = found["dynamic_friction"] = drive.friction
    if drive.viscous:
        found["viscous_friction"] = drive.viscous
    if limits:
        found["**"] = Call("limits", limits)
    return Call(function, found)


QUATERNION = '''

def quaternion(w: float, x: float, y: float, z: float) -> tuple[float, float, float, float]:
    """Return a rotation as this version of Isaac Lab has it: with w at the end in 3.0."""
    if ArticulationCfg.InitialStateCfg().rot[0] == 1.0:
        return (w, x, y, z)
    return (x, y, z, w)
'''
LIMITS = '''
# The names of limits in Isaac Lab 3.0, and in 2.x.
LIMITS = {
    "joint_effort_limit": "effort_limit_sim",
    "joint_velocity_limit": "velocity_limit_sim",
    "actuator_effort_limit": "effort_limit",
    "actuator_velocity_limit": "velocity_limit",
}


def limits(**values: float) -> dict[str, float]:
    """Return limits of an actuator by the names that this version of Isaac Lab has for them."""
    known = {each.name for each in fields(ActuatorBaseCfg)}
    return {name if name in known else LIMITS[name]: value for name, value in values.items()}
'''


def _text(path: str, start: Call, drives: list[Drive]) -> str:
    """Return the file."""
    groups = dict(grouped(drives, _actuator))
    has_delay = any(each.function == DELAYED for each in groups.values())
    argument = f"timestep: float = {TIME_STEP}" if has_delay else ""
    articulation = Call(
        "ArticulationCfg",
        {
            "spawn": Call(
                "UsdFileCfg",
                {"usd_path": Code("str(USD)"), "activate_contact_sensors": Code("True")},
            ),
            "init_state": start,
            "actuators": groups,
            "soft_joint_pos_limit_factor": SOFT_LIMITS,
        },
    )
    functions = {each.function for each in groups.values()}
    has_limits = any("**" in each.arguments for each in groups.values())
    helpers = LIMITS if has_limits else ""
    helpers += QUATERNION if "rot" in start.arguments else ""
    return f'''"""The configuration of a robot for Isaac Lab 2.2 to 3.0, {MARK}."""

{"from dataclasses import fields" + chr(10) if has_limits else ""}\
from pathlib import Path

{imported("isaaclab.actuators", functions | ({"ActuatorBaseCfg"} if has_limits else set()))}\
{imported("isaaclab.assets", ("ArticulationCfg",))}\
{imported("isaaclab.sim", ("UsdFileCfg",))}
USD = {path_beside(path)}
{helpers}

def robot_cfg({argument}) -> ArticulationCfg:
    """Return a new configuration, which may be changed{
        "; delays are counted in time steps" if argument else ""
    }."""
    {python(articulation, "return ", "    ")}


ROBOT_CFG = robot_cfg()

# By how much an action of 1 moves the target of a joint: 0.25 * effort limit / stiffness.
{python(scales_of(drives), "ACTION_SCALE = ")}
'''
