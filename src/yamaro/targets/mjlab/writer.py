"""The entry: the configuration of an entity, and the MJCF that it loads.

Actuators and the state `home` are in the configuration, so the MJCF is without them. The gains of
mjlab's `<dcmotor>` are in volts: a motor with a torque-speed line is a `DcMotorActuator` instead,
whose gains are those of the joint.
"""

from __future__ import annotations

from math import inf

from ...diagnostics import failure
from ...model.positions import HOME
from ...xml.writer import write as write_xml
from ..gains import POSITION, VELOCITY
from ..interface.orders import QUATERNION, UnknownOrderError, in_mujoco
from ..losses import Losses
from ..mjcf.keyframes import Rows, add_key
from ..mjcf.writer import document, modelled
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
    lose_parts_of_steps,
    path_beside,
    pattern,
    python,
    scales_of,
    steps,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.robot import Robot
    from ...xml.tree import Element
    from ..interface.orders import Entry
    from ..mjcf.model import Writing
    from ..output import Wanted
    from ..training import Drive

TITLE = "mjlab"
SERVO, VELOCITY_SERVO = "BuiltinPositionActuatorCfg", "BuiltinVelocityActuatorCfg"
MOTOR, LINE_MOTOR = "BuiltinMotorActuatorCfg", "DcMotorActuatorCfg"
"""The configurations of actuators, in `mjlab.actuator`."""


def write(robot: Robot, wanted: Wanted) -> Output:
    """Return the configuration of a robot as Python, with the MJCF and its meshes beside it.

    Raises:
        YamaroError: mjlab would refuse the robot, or MuJoCo.
    """
    writing, top = modelled(robot, wanted)
    actuators, keys = writing.sections["actuator"], writing.sections["keyframe"]
    home = _home(writing)
    keys.children = []
    written, actuators.children = actuators.elements(), []
    own = [each for each in top if each.name != "option"]  # mjlab has options of its own
    compiler = next(each for each in own if each.name == "compiler")
    for folder in ("meshdir", "texturedir"):  # the MJCF is in the folder of its meshes
        if compiler.attributes.get(folder) == FOLDER:
            del compiler.attributes[folder]
    losses = Losses(writing.losses)
    for each in writing.blocks.sections:
        if each.name == "option":
            what = "options in blocks for MJCF"
            losses.lose_xml(what, each, label="the robot", trace=each.trace_within(None))
    joints = _joints(robot, Output(document(writing, own), names=writing.own_names()))
    names = {str(each["yamaro"]): _name(each) for each in joints if each["yamaro"] is not None}
    drives = drives_of(robot, names, is_fixed=wanted.is_fixed)
    # The actuators of blocks that drive something else than what mjlab drives.
    driven = {writing.joint_name(each.joint.name) for each in drives}
    ours = {str(each.attributes["joint"]) for each in written if id(each) in writing.controls}
    others: list[Element] = []
    for each in written:
        joint = str(each.attributes.get("joint"))
        if id(each) in writing.controls or (joint in driven and joint not in ours):
            continue
        what, label = "actuators in blocks for MJCF", f"<{each.name}>"
        losses.lose_xml(what, each, label=label, trace=each.trace_within(None))
        if joint not in driven:
            others.append(each)
    actuators.children += others
    lose_parts_of_steps(losses, drives)
    start = _start(joints, home)
    model = write_xml(document(writing, own))
    return configured(
        robot, wanted.name, TITLE, losses, ".xml", model, writing.files,
        lambda path: _text(path, start, drives),
    )  # fmt: skip


def _home(writing: Writing) -> Element | None:
    """Return the keyframe in which a robot starts; None if it has joints that Yamaro does not know.

    Blocks may have keyframes, so that none of `home` is written for a robot that does not have it.
    """
    keys = writing.sections["keyframe"]
    known = {each.attributes.get("name"): each for each in keys.elements()}
    rows = Rows(writing)
    order = {str(each.attributes.get("name")) for each in rows.joints}
    if HOME not in known and order and writing.motions.keys() >= order:
        add_key(writing, HOME, writing.robot.states.get(HOME), rows)
        known[HOME] = keys.elements()[-1]
    return known.get(HOME)


def _joints(robot: Robot, model: Output) -> list[Entry]:
    """Return the joints of the MJCF: at most one is free, the first, and the others single.

    Raises:
        YamaroError: there are others, or two have one name in mjlab.
    """
    try:
        joints = in_mujoco(robot, model).joints
    except UnknownOrderError as error:
        raise failure(UNFIT, f"mjlab gets no list of joints: {error}", robot.span) from None
    known: dict[str, str] = {}
    for place, entry in enumerate(joints):
        full, name = str(entry["name"]), _name(entry)
        joint = robot.joints.get(str(entry["yamaro"]))
        span, trace = (joint.span, joint.trace) if joint is not None else (robot.span, None)
        if _count(entry) > 1 and not (place == 0 and _count(entry) == QUATERNION[0]):
            raise failure(
                UNFIT,
                f"in mjlab only the root of a robot moves freely, not the child of "
                f"'{entry['yamaro'] or full}'",
                span,
                hint="make the joint another type, or build the child link as a robot of its own",
                trace=trace,
            )
        if name in known:
            raise failure(
                UNFIT,
                f"mjlab has one name for the joints '{known[name]}' and '{full}': '{name}'",
                span,
                hint="rename one: mjlab leaves out what is before the last '/'",
                trace=trace,
            )
        known[name] = full
    return joints


def _name(entry: Entry) -> str:
    """Return what mjlab calls a joint of the MJCF: what is after the last slash."""
    return str(entry["name"]).rpartition("/")[2]


def _count(entry: Entry) -> int:
    """Return how many positions a joint has."""
    first_and_count = entry["q"]
    assert isinstance(first_and_count, list)
    return int(first_and_count[1])


# --- what is written --------------------------------------------------------------------------


def _start(joints: list[Entry], home: Element | None) -> Call:
    """Return the state that a robot starts in, from its keyframe."""
    numbers = [] if home is None else [*map(float, str(home.attributes["qpos"]).split())]
    found: dict[str, object] = {}
    positions: dict[str, float] = {}
    if joints and _count(joints[0]) == QUATERNION[0] and numbers:
        found["pos"] = tuple(numbers[:3])
        if numbers[3:7] != [1.0, 0.0, 0.0, 0.0]:
            found["rot"] = tuple(numbers[3:7])
        numbers, joints = numbers[7:], joints[1:]
    for entry, number in zip(joints, numbers, strict=False):
        if number:
            positions[f"{pattern(_name(entry))}$"] = number  # mjlab matches the start of a name
    if positions:
        found["joint_pos"] = positions
    return Call("EntityCfg.InitialStateCfg", found)


def _actuator(drive: Drive) -> Call:
    """Return the configuration of an actuator; the joints that it drives are filled in later."""
    found: dict[str, object] = {"target_names_expr": ()}
    function = {POSITION: SERVO, VELOCITY: VELOCITY_SERVO}.get(drive.command, MOTOR)
    if drive.line is not None:
        function = LINE_MOTOR
    if function in (SERVO, LINE_MOTOR):
        found["stiffness"] = drive.stiffness
    if function != MOTOR:
        found["damping"] = drive.damping
    if drive.effort is not None or function == MOTOR:
        found["effort_limit"] = drive.effort if drive.effort is not None else inf
    if drive.line is not None:
        found["saturation_effort"], found["velocity_limit"] = drive.line
    resists = {
        "armature": drive.armature,
        "frictionloss": drive.friction,
        "viscous_damping": drive.viscous,
    }
    found |= {name: value for name, value in resists.items() if value}
    if drive.delay:
        found["delay_min_lag"] = found["delay_max_lag"] = steps(drive.delay)
    return Call(function, found)


def _text(path: str, start: Call, drives: list[Drive]) -> str:
    """Return the file."""
    groups = [call for _, call in grouped(drives, _actuator)]
    argument = f"timestep: float = {TIME_STEP}" if any(each.delay for each in drives) else ""
    articulation = Call(
        "EntityArticulationInfoCfg",
        {"actuators": tuple(groups), "soft_joint_pos_limit_factor": SOFT_LIMITS},
    )
    entity = Call(
        "EntityCfg",
        {
            "init_state": start,
            "spec_fn": Code("get_spec"),
            "articulation": articulation,
            "sort_actuators": Code("True"),
        },
    )
    return f'''"""The configuration of a robot for mjlab 1.6, {MARK}."""

from pathlib import Path

import mujoco
{imported("mjlab.actuator", (each.function for each in groups))}\
{imported("mjlab.entity", ("EntityArticulationInfoCfg", "EntityCfg"))}
MJCF = {path_beside(path)}


def get_spec() -> mujoco.MjSpec:
    """Return the robot, to which mjlab adds actuators."""
    return mujoco.MjSpec.from_file(str(MJCF))


def robot_cfg({argument}) -> EntityCfg:
    """Return a new configuration, which may be changed{
        "; lags are counted in time steps" if argument else ""
    }."""
    {python(entity, "return ", "    ")}


ROBOT_CFG = robot_cfg()

# By how much an action of 1 moves the target of a joint: 0.25 * effort_limit / stiffness.
{python(scales_of(drives), "ACTION_SCALE = ")}
'''
