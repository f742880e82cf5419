"""The joints of bodies, and which number of `qpos` is whose."""

from __future__ import annotations

from ...model.joint import CONTINUOUS, FLOATING, PLANAR, PRISMATIC, REVOLUTE, UNLIMITED
from ...model.pose import UNTURNED, Pose, quaternion_from_rotation, rotate, rotation_from_z
from ..elements import element, number
from .model import JOINT, Places, Writing, pose_attributes, quiet

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.extras import Actuator
    from ...model.joint import Joint
    from ...model.pose import Vector
    from ...model.positions import Position
    from ...model.values import Written
    from ...xml.tree import Element
    from ..elements import Attributes

    Sources = dict[str, tuple[Written, str]]

LEAST_ROOM = 1e-9
"""Half the range of a joint whose limits leave no room, in radians or metres: MuJoCo takes equal
limits for none, or refuses them."""
TYPES = {REVOLUTE: "hinge", CONTINUOUS: "hinge", PRISMATIC: "slide"}
_PLANE = ("x", "y", "yaw")


def add_joints(writing: Writing, joint: Joint, body: Element, place: Pose) -> None:
    """Append what lets a body move on the one that it is in; nothing for a fixed joint.

    Args:
        writing: the run.
        joint: the joint.
        body: the body that has it.
        place: T_body_joint, before any joint moves.
    """
    found: list[Element] = []
    if joint.type in TYPES:
        found = [_single(writing, joint, place)]
    elif joint.type == PLANAR:
        turn = rotation_from_z(joint.axis)
        axes = [rotate(turn, (1.0, 0.0, 0.0)), rotate(turn, (0.0, 1.0, 0.0)), joint.axis]
        for part, axis in zip(_PLANE, axes, strict=True):
            kind = None if part == "yaw" else "slide"
            found.append(_part(writing, joint, part, kind, axis))
        _rename(writing, joint, found)
    elif joint.type == FLOATING:
        found = _floating(writing, joint)
    body.children += found
    writing.joints[joint.name] = found


def _single(writing: Writing, joint: Joint, place: Pose) -> Element:
    """Return the joint of one number."""
    limit, ends, effort = joint.limit, range_of(joint), effort_of(joint)
    if writing.blocks.text("joint", joint.name, "limited") == "false":
        ends = None
    if writing.blocks.text("joint", joint.name, "actuatorfrclimited") == "false":
        effort = None
    places: Sources = {"name": (joint, "name"), "type": (joint, "type")}
    if limit is not None:
        places |= {"range": (limit, "upper"), "actuatorfrcrange": (limit, "effort")}
        if ends is None and _is_reversed(joint):
            writing.losses.lose("limits in the wrong order", joint, part=limit)
        elif ends is not None and limit.lower == limit.upper:
            how = f"limits {number(2 * LEAST_ROOM)} rad or m apart"
            writing.losses.approximate("limits that leave no room", joint, part=limit, how=how)
        if limit.effort is not None and limit.effort <= 0:
            writing.losses.lose("effort limits that are not greater than 0", joint, part=limit)
    attributes: Attributes = {
        "name": writing.joint_name(joint.name),
        "type": TYPES[joint.type] if joint.type == PRISMATIC else None,
        "pos": pose_attributes(place)["pos"],
        "axis": _turned(place, joint.axis),
        "range": ends if limit is not None else None,
        **_dynamics(joint, places, writing.robot.actuators.get(joint.name)),
        "actuatorfrcrange": (-effort, effort) if effort is not None else None,
    }
    writing.motions[writing.joint_name(joint.name)] = (joint.name, "single")
    return element("joint", attributes, owner=joint, places=Places(places))


def _turned(place: Pose, axis: Vector) -> Vector:
    """Return the axis of a joint in its body."""
    if place.rotation == UNTURNED:
        return axis
    x, y, z = (quiet(part) for part in rotate(place.rotation, axis))
    return (x, y, z)


def range_of(joint: Joint) -> tuple[float, float] | None:
    """Return the range of a joint in MJCF, or None if it is not limited."""
    lower, upper = joint.lower, joint.upper
    if lower is None or upper is None or _is_reversed(joint):
        return None
    if lower == upper:
        return lower - LEAST_ROOM, upper + LEAST_ROOM
    return None if lower <= -UNLIMITED and upper >= UNLIMITED else (lower, upper)


def _is_reversed(joint: Joint) -> bool:
    lower, upper = joint.lower, joint.upper
    return lower is not None and upper is not None and lower > upper


def effort_of(joint: Joint) -> float | None:
    """Return the greatest effort of a joint, in N·m or N, or None if MJCF has none for it."""
    effort = joint.limit.effort if joint.limit is not None else None
    return effort if effort is not None and 0 < effort < UNLIMITED else None


def _dynamics(joint: Joint, places: Sources, actuator: Actuator | None = None) -> Attributes:
    """Return the damping, friction and armature of a joint, as far as there are any."""
    dynamics = joint.dynamics
    found: Attributes = {}
    if dynamics is not None:
        names = {"damping": "damping", "frictionloss": "friction", "armature": "armature"}
        places |= {name: (dynamics, own) for name, own in names.items()}
        found = {name: getattr(dynamics, own) or None for name, own in names.items()}
    if actuator is not None and actuator.armature:
        places["armature"], found["armature"] = (actuator, "armature"), actuator.armature
    return found


# --- joints of several numbers ------------------------------------------------------------------


def _floating(writing: Writing, joint: Joint) -> list[Element]:
    """Return a free joint; below a body that moves, where there is none, slides and a ball."""
    dynamics = _dynamics(joint, {})
    if writing.plan.is_floating_in_world(joint):
        writing.motions[joint.name] = (joint.name, "free")
        if dynamics:  # which `<freejoint>` has not
            attributes: Attributes = {"name": joint.name, "type": "free", **dynamics}
            return [element("joint", attributes, owner=joint)]
        return [element("freejoint", {"name": joint.name}, owner=joint)]
    axes = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
    found = [_part(writing, joint, part, "slide", axis) for part, axis in axes.items()]
    found.append(_part(writing, joint, "ball", "ball", None))
    _rename(writing, joint, found)
    return found


def _part(
    writing: Writing, joint: Joint, part: str, kind: str | None, axis: Vector | None
) -> Element:
    """Return one of the joints that a joint of several numbers is made of."""
    name = writing.names.fresh(JOINT, f"{joint.name}_{part}")
    writing.motions[name] = (joint.name, part)
    attributes: Attributes = {"name": name, "type": kind, "axis": axis, **_dynamics(joint, {})}
    return element("joint", attributes, owner=joint)


def _rename(writing: Writing, joint: Joint, parts: list[Element]) -> None:
    names = ", ".join(str(part.attributes["name"]) for part in parts)
    writing.losses.rename(f"{joint.type} joints", joint, new=names)


# --- positions ----------------------------------------------------------------------------------


def numbers_at(part: str, position: Position, origin: Pose) -> list[float]:
    """Return the numbers of `qpos` of one joint in MJCF.

    Args:
        part: which of the joints it is that a joint is made of.
        position: of the whole joint, as `joint_positions` gives it.
        origin: T_world_joint of a joint that is free in the world; else any pose.
    """
    if part == "base":
        return [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]
    if isinstance(position, Pose):
        place = origin @ position if part == "free" else position
        turn = [1.0, 0.0, 0.0, 0.0]
        if place.rotation != UNTURNED:
            turn = [*quaternion_from_rotation(place.rotation)]
        if part == "free":
            return [*place.position, *turn]
        return turn if part == "ball" else [place.position["xyz".index(part)]]
    if part in _PLANE and not isinstance(position, float):
        return [float(position[_PLANE.index(part)])]
    return [position if isinstance(position, float) else 0.0]
