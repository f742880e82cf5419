"""Actuators: what drives the joints.

Controls, gains and forces are those of the joint: a gear acts by the armature alone.

A motor with a line from its stall torque to its no-load speed is a `dcmotor` of MuJoCo 3.12 or
newer, whose controller commands torques that the voltage bounds: T = τ·(v − ω/Ω) with the stall
torque τ, the no-load speed Ω and v from −1 to 1. Its nominal voltage is 1 V, since only the line is
known. MuJoCo 3.7 to 3.11 has it for commands of positions, with gains in volts. A delay is a buffer
of controls, of MuJoCo 3.5 or newer.
"""

from __future__ import annotations

from math import ceil, inf

from ...model.joint import SINGLE
from ...model.values import attribute_text, numbers_of
from ..elements import element
from ..gains import EFFORT, POSITION, TIME_STEP, VELOCITY, Gains
from ..holding import lost_lines, lost_of_actuator, lost_values
from .joints import effort_of, range_of
from .model import ACTUATOR, Writing

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.extras import Actuator
    from ...model.joint import Joint
    from ...source import Span
    from ...xml.tree import Element
    from ..elements import Attributes

WORDS = {POSITION: "position", VELOCITY: "velocity", EFFORT: "motor"}
SOURCES = {
    "joint": "joint",
    "kp": "kp",
    "kv": "kd",
    "delay": "delay",
    "controller": "kp",
    "nominal": "stall_torque",
}
"""What the attributes of an actuator are made of."""
INPUTS = {POSITION: "pos", VELOCITY: "vel", EFFORT: "ff"}
"""What the control of a `dcmotor` is."""
DELAYS, POSITION_LINES, LINES = (3, 5), (3, 7), (3, 12)
"""The releases of MuJoCo since which it has delays, and torque-speed lines: of actuators that are
commanded positions, and of all."""
SHORTEST_STEP = TIME_STEP / 4
"""In s: a delay has a buffer that is long enough for time steps down to this one."""
LONGEST_DELAY = 10.0
"""In s: what needs a longer buffer than this is taken for a mistake."""


def add_actuators(writing: Writing) -> set[str]:
    """Append the actuators, in the order of the joints.

    Returns:
        The joints whose motor keeps them below the velocity of their limit.
    """
    bounded = set()
    robot = writing.robot
    gains = Gains(robot, is_fixed=writing.wanted.is_fixed)
    for name, actuator in robot.actuators.items():
        joint = robot.joints.get(name)
        since = POSITION_LINES if actuator.command == POSITION else LINES
        line = _line(actuator) if writing.release >= since else None
        word = "dcmotor" if line is not None else WORDS.get(actuator.command, "motor")
        given = writing.blocks.actuator_of(name, word)
        if joint is None or joint.type not in SINGLE:
            is_driven = False
        else:
            is_driven = joint.mimic is None or given is not None
        if joint is None or not is_driven or robot.parent_joint(joint.child) is not joint:
            writing.losses.lose("actuators of joints that are not independent", actuator)
            continue
        if given is not None and given.name != word:
            continue
        writing.losses += lost_of_actuator(actuator)
        writing.losses += lost_values(actuator, "mjcf")
        command = actuator.command
        effort, stall, speed = effort_of(joint), actuator.stall_torque, actuator.no_load_speed
        if line is None and stall is not None:
            writing.losses += lost_lines(actuator, hint=_hint(since))
        if stall is not None:
            effort = min(effort, stall) if effort is not None else stall
        elif speed is not None:
            what = "no-load speeds of motors without a stall torque"
            writing.losses.lose(what, actuator, field="no_load_speed")
        force = (-effort, effort) if effort is not None else None
        places: dict[str, Span] = {key: actuator.span_of(name) for key, name in SOURCES.items()}
        if joint.limit is not None:
            places["forcerange"] = places["saturation"] = joint.limit.span_of("effort")
        attributes: Attributes = {
            "name": writing.names.fresh(ACTUATOR, joint.name),
            "joint": writing.joint_name(joint.name),
        }
        if line is not None:
            attributes |= {
                "nominal": (1.0, *line),
                **_controller(actuator, joint, gains, line if writing.release < LINES else None),
                "saturation": (effort or line[0], 0.0, 0.0),
            }
            limit = joint.limit.velocity if joint.limit is not None else None
            if limit is not None and limit >= line[1]:
                bounded.add(joint.name)
        else:
            attributes |= _gains(actuator, joint, gains, is_free=given is None)
        if not _is_off(given, "ctrllimited"):
            attributes["ctrlrange"] = _control(joint, command, force)
        if word in ("position", "velocity") and not _is_off(given, "forcelimited"):
            attributes["forcerange"] = force
        if actuator.delay is not None and actuator.delay > LONGEST_DELAY:
            what = f"delays of more than {LONGEST_DELAY:g} s"
            writing.losses.lose(what, actuator, field="delay")
        elif actuator.delay and writing.release < DELAYS:
            hint = _hint(DELAYS)
            writing.losses.lose("delays of actuators", actuator, field="delay", hint=hint)
        elif actuator.delay:
            attributes["nsample"] = ceil(actuator.delay / SHORTEST_STEP)
            attributes["delay"] = actuator.delay
        made = element(word, attributes, owner=actuator, places=places)
        writing.controls[id(made)] = (joint.name, command)
        writing.add("actuator", made)
    return bounded


def _is_off(given: Element | None, attribute: str) -> bool:
    """Return whether a block says that an actuator is not limited."""
    return given is not None and attribute_text(given, attribute) == "false"


def _line(actuator: Actuator) -> tuple[float, float] | None:
    """Return the stall torque and the no-load speed, if there are both."""
    stall, speed = actuator.stall_torque, actuator.no_load_speed
    return None if stall is None or speed is None else (stall, speed)


def _hint(release: tuple[int, int]) -> str:
    return "MuJoCo {0}.{1} or newer has them: --mujoco-version {0}.{1}".format(*release)


def _control(
    joint: Joint, command: str, force: tuple[float, float] | None
) -> tuple[float, float] | None:
    """Return the least and the greatest control, or None for no limits."""
    if command == EFFORT:
        return force
    if command == VELOCITY:
        fastest = joint.limit.velocity if joint.limit is not None else None
        if fastest is None or not 0 < fastest < inf:
            return None
        return (-fastest, fastest)
    return range_of(joint)


def _gains(actuator: Actuator, joint: Joint, gains: Gains, *, is_free: bool) -> Attributes:
    """Return the gains of a servo; `is_free` if damping may be chosen where none is given."""
    if actuator.command == EFFORT:
        return {}
    if actuator.command == VELOCITY:
        return {"kv": gains.of_velocity(joint, actuator)}
    stiffness = actuator.kp if actuator.kp is not None else gains.of_position(joint)
    found: Attributes = {"kp": stiffness}
    if actuator.kd is not None:
        found["kv"] = actuator.kd
    elif is_free:
        found["kv"] = gains.damping(joint, stiffness)
    return found


def _controller(
    actuator: Actuator, joint: Joint, gains: Gains, line: tuple[float, float] | None
) -> Attributes:
    """Return the gains of the servo in a `dcmotor`, and what its control is.

    Args:
        actuator: the actuator.
        joint: its joint.
        gains: chooses those that are not given.
        line: where gains are in volts, the stall torque τ and the no-load speed Ω. There the torque
            is τ·(p·(c − q) − d·ω − ω/Ω), with the command c of a position q.
    """
    kp = kd = 0.0
    if actuator.command == POSITION:
        kp = actuator.kp if actuator.kp is not None else gains.of_position(joint)
        kd = actuator.kd if actuator.kd is not None else gains.damping(joint, kp)
    elif actuator.command == VELOCITY:
        kd = gains.of_velocity(joint, actuator)
    most = 1.0  # V
    if line is not None:
        stall, speed = line
        gains_in_volts = (kp / stall, 0.0, kd / stall - 1 / speed, 0.0, 0.0, most)
        return {"input": "position", "controller": gains_in_volts}
    inputs = INPUTS.get(actuator.command, "ff")
    return {"input": inputs, "controller": (kp, 0.0, kd, 0.0, 0.0, most)}


def leave_out_bounds(writing: Writing) -> None:
    """Leave out the greatest effort of joints that their actuators cannot exceed.

    A block that says it, or whether it holds, keeps it.
    """
    forces: dict[str, float] = {}
    for each in writing.sections["actuator"].elements():
        joint = attribute_text(each, "joint")
        if joint is not None:
            forces[joint] = forces.get(joint, 0.0) + _greatest_force(each)
    for name, elements in writing.joints.items():
        said = writing.blocks.settings("joint", name)
        for each in elements:
            bound = numbers_of(each, "actuatorfrcrange")
            own = forces.get(attribute_text(each, "name") or "", inf)
            if bound and own <= bound[1] * (1 + SAME) and KEEPING.isdisjoint(said):
                del each.attributes["actuatorfrcrange"]


KEEPING = frozenset(("actuatorfrcrange", "actuatorfrclimited", "actuatorgravcomp"))
SAME = 1e-9
"""How far forces may be off that are the same."""


def _greatest_force(actuator: Element) -> float:
    """Return the greatest force of an actuator at its joint; inf if nothing bounds it."""
    gear = abs((*numbers_of(actuator, "gear"), 1.0)[0])
    ends = numbers_of(actuator, "forcerange")
    if ends and not _is_off(actuator, "forcelimited"):
        return gear * max(map(abs, ends))
    ends = numbers_of(actuator, "ctrlrange")
    types = [attribute_text(actuator, f"{each}type") for each in ("gain", "bias", "dyn")]
    is_plain = actuator.name in ("motor", "general") and set(types) <= {None, "fixed", "none"}
    if ends and is_plain and not _is_off(actuator, "ctrllimited"):
        gain = (*numbers_of(actuator, "gainprm"), 1.0)[0]
        return gear * abs(gain) * max(map(abs, ends))
    return inf
