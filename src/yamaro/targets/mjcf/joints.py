"""The joints of bodies, and which number of `qpos` is whose."""

from __future__ import annotations

from ...model.joint import CONTINUOUS, FLOATING, PLANAR, PRISMATIC, REVOLUTE, UNLIMITED
from ...model.pose import UNTURNED, Pose, rotate, rotation_from_z
from ..output import APPROXIMATED, LOST, RENAMED
from .names import JOINT
from .writing import Places, Writing, made, number, row

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.joint import Joint
    from ...model.pose import Vector
    from ...model.positions import Position
    from ...model.values import Written
    from ...xml.tree import Element

    Sources = dict[str, tuple[Written, str]]

LEAST_ROOM = 1e-9
"""Half the range of a joint whose limits leave no room, in radians or metres: MuJoCo takes equal
limits for none, or refuses them."""
TYPES = {REVOLUTE: "hinge", CONTINUOUS: "hinge", PRISMATIC: "slide"}
_PLANE = ("x", "y", "yaw")


def add_joints(writing: Writing, joint: Joint, body: Element) -> None:
    """Append what lets a body move on the one that it is in; nothing for a fixed joint."""
    if joint.type in TYPES:
        body.children.append(_single(writing, joint))
    elif joint.type == PLANAR:
        body.children += _planar(writing, joint)
    elif joint.type == FLOATING:
        body.children += _floating(writing, joint)


def _single(writing: Writing, joint: Joint) -> Element:
    """Return the joint of one number."""
    places: Sources = {"name": (joint, "name"), "type": (joint, "type")}
    attributes = {
        "name": joint.name,
        "type": TYPES[joint.type] if joint.type == PRISMATIC else None,
        "axis": row(joint.axis),
        "range": _range(writing, joint, places),
        **_dynamics(joint, places),
        **_armature(writing, joint, places),
        "actuatorfrcrange": _effort(writing, joint, places),
    }
    writing.motions[joint.name] = (joint.name, "single")
    return made("joint", joint, attributes, joint.trace, Places(places))


def _range(writing: Writing, joint: Joint, places: Sources) -> str | None:
    """Return the limits of a joint; None for none."""
    ends = range_of(joint)
    limit = joint.limit
    if limit is None or ends is None:
        if limit is not None and _is_reversed(joint):
            _lose(writing, joint, limit, "limits in the wrong order")
        return None
    places["range"] = (limit, "upper")
    if limit.lower == limit.upper:
        _lose(
            writing,
            joint,
            limit,
            "limits that leave no room",
            kind=APPROXIMATED,
            how=f"limits {number(2 * LEAST_ROOM)} rad or m apart",
        )
    return row(ends)


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


def _effort(writing: Writing, joint: Joint, places: Sources) -> str | None:
    effort, limit = effort_of(joint), joint.limit
    if limit is None or effort is None:
        if limit is not None and limit.effort is not None and limit.effort <= 0:
            _lose(writing, joint, limit, "effort limits that are not greater than 0")
        return None
    places["actuatorfrcrange"] = (limit, "effort")
    return row((-effort, effort))


def _dynamics(joint: Joint, places: Sources) -> dict[str, str | None]:
    """Return the damping and the friction of a joint, where there are any."""
    dynamics = joint.dynamics
    if dynamics is None:
        return {}
    places["damping"] = (dynamics, "damping")
    places["frictionloss"] = (dynamics, "friction")
    return {
        "damping": number(dynamics.damping) if dynamics.damping else None,
        "frictionloss": number(dynamics.friction) if dynamics.friction else None,
    }


def _armature(writing: Writing, joint: Joint, places: Sources) -> dict[str, str | None]:
    actuator = writing.robot.actuators.get(joint.name)
    if actuator is None or not actuator.armature:
        return {}
    places["armature"] = (actuator, "armature")
    return {"armature": number(actuator.armature)}


# --- joints of several numbers ------------------------------------------------------------------


def _planar(writing: Writing, joint: Joint) -> list[Element]:
    """Return the two slides and the hinge of a planar joint, in the order of its numbers."""
    turn = rotation_from_z(joint.axis)
    axes = [rotate(turn, (1.0, 0.0, 0.0)), rotate(turn, (0.0, 1.0, 0.0)), joint.axis]
    found = []
    for part, axis in zip(_PLANE, axes, strict=True):
        kind = None if part == "yaw" else "slide"
        found.append(_part(writing, joint, part, kind, axis))
    _rename(writing, joint, found)
    return found


def _floating(writing: Writing, joint: Joint) -> list[Element]:
    """Return a free joint; below a body that moves, where there is none, slides and a ball."""
    dynamics = _dynamics(joint, {})
    if writing.plan.is_floating_in_world(joint):
        writing.motions[joint.name] = (joint.name, "free")
        if dynamics:  # which `<freejoint>` has not
            attributes = {"name": joint.name, "type": "free", **dynamics}
            return [made("joint", joint, attributes, joint.trace)]
        return [made("freejoint", joint, {"name": joint.name}, joint.trace)]
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
    attributes = {
        "name": name,
        "type": kind,
        "axis": row(axis) if axis is not None else None,
        **_dynamics(joint, {}),
    }
    return made("joint", joint, attributes, joint.trace)


def _rename(writing: Writing, joint: Joint, parts: list[Element]) -> None:
    writing.lose(
        RENAMED,
        f"{joint.type} joints",
        f"joint '{joint.name}'",
        joint.span,
        trace=joint.trace,
        how=", ".join(str(part.attributes["name"]) for part in parts),
    )


def _lose(
    writing: Writing,
    joint: Joint,
    owner: Written,
    what: str,
    *,
    kind: str = LOST,
    how: str = "",
) -> None:
    name = f"joint '{joint.name}'"
    writing.lose(kind, what, name, owner.span, trace=owner.trace_in(joint), how=how)


# --- positions ----------------------------------------------------------------------------------


def numbers_of(part: str, position: Position, origin: Pose) -> list[float]:
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
        turn = _quaternion(place)
        if part == "free":
            return [*place.position, *turn]
        return turn if part == "ball" else [place.position["xyz".index(part)]]
    if part in _PLANE and not isinstance(position, float):
        return [float(position[_PLANE.index(part)])]
    return [position if isinstance(position, float) else 0.0]


def _quaternion(pose: Pose) -> list[float]:
    from ...model.pose import quaternion_from_rotation

    if pose.rotation == UNTURNED:
        return [1.0, 0.0, 0.0, 0.0]
    return list(quaternion_from_rotation(pose.rotation))
