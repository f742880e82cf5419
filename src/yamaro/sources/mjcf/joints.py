"""Joints: what moves a body on the one that it is in, as joints of the model.

Several joints of one body are a chain of links without mass. Where the last one is not at the
origin of the body, the body is fixed to the link that it moves.
"""

from __future__ import annotations

from ...model import making
from ...model.joint import CONTINUOUS, FLOATING, PRISMATIC, REVOLUTE
from ...model.making import Place, element
from ...model.pose import IDENTITY, UNTURNED, ZERO, Pose, rotate, rotation_about
from .blocks import block, in_radians, kept, row, setting
from .compiler import chosen, fault, numbers, unit_axis, vector
from .tree import type_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.pose import Vector
    from ...source import Span
    from ...xml.tree import Element, Node
    from .building import Builder
    from .tree import Body, Placed, Thing

Z_AXIS = (0.0, 0.0, 1.0)
UNBOUNDED = 1e16
"""The effort and velocity of a joint that bounds neither: URDF wants a number, and takes it so."""
ANGLES = ("range", "ref", "springref", "springyield")
HELD = frozenset(("type", "pos", "axis", "range", "limited"))
"""What the model has of a joint."""
LIMITED = ("true", "false", "auto")


def add_joints(builder: Builder, body: Body, parent: str) -> None:
    """Add the joints between a body and the one that it is in, with links in between."""
    kinds = [type_of(joint) for joint in body.joints]
    if kinds == ["free"]:
        _add_free(builder, body, parent)
        return
    origin, at = body.pose, ZERO
    moving = [j for j, k in zip(body.joints, kinds, strict=True) if k in ("slide", "hinge")]
    places = [_place(joint, kind) for joint, kind in zip(body.joints, kinds, strict=True)]
    ends_in_body = bool(moving) and _ends_at_origin(kinds, places) and kinds[-1] != "ball"
    for joint, kind, where in zip(body.joints, kinds, places, strict=True):
        if kind == "free":
            raise fault(
                "a body with a free joint has no other joint", joint.span, "remove one of them"
            )
        if kind == "ball":
            builder.keep(body.name, kept(joint, changed=_in_body(joint, where)))
            continue
        if where is not None and where != at:
            dx, dy, dz = (p - q for p, q in zip(where, at, strict=True))
            origin = origin @ Pose(UNTURNED, (dx, dy, dz))
            at = where
        is_last = joint is moving[-1] and ends_in_body
        name = builder.fresh("joint", f"{body.name}_joint") if not joint.name else joint.name
        child = body.name if is_last else builder.fresh("body", f"{name}_link")
        placing = body.thing if joint is moving[0] else joint
        links = parent, child
        _add(builder, joint, kind, name, links, origin, placing=placing, is_marked=not is_last)
        if not is_last:
            place = Place(joint.span, {"name": joint.name_span})
            builder.links.append(making.link(place, child))
        parent, origin = child, IDENTITY
    if not ends_in_body:
        x, y, z = at
        pose = origin @ Pose(UNTURNED, (-x, -y, -z)) if moving else origin
        ball = body.joints[0].name if kinds == ["ball"] else ""
        builder.add_fixed(body.thing, f"{body.name}_fixed", parent, body.name, pose, ball=ball)


def _place(joint: Placed, kind: str) -> Vector | None:
    """Return where the axis of a joint is in its body; None for one that slides."""
    if kind == "slide":
        return None
    where = vector(joint.given, "pos")
    return where if joint.pose is IDENTITY else joint.pose.apply(where)


def _ends_at_origin(kinds: list[str], places: list[Vector | None]) -> bool:
    """Return whether what the last joint moves is at the origin of the body."""
    turning = [p for k, p in zip(kinds, places, strict=True) if k == "hinge"]
    return not turning or turning[-1] == ZERO


def _in_body(joint: Placed, where: Vector | None) -> dict[str, object]:
    """Return the attributes of a ball joint for a block."""
    found: dict[str, object] = in_radians(joint, "range", "springyield")
    found["pos"] = row(where) if where is not None and any(where) else None
    found["axis"] = None
    return found


def _add_free(builder: Builder, body: Body, parent: str) -> None:
    joint = body.joints[0]
    if parent != builder.world.name:
        raise fault(
            "a body with a free joint is a child of the world", joint.span, "move it to <worldbody>"
        )
    name = joint.name or builder.fresh("joint", f"{body.name}_free")
    place = Place(joint.span, {"name": joint.name_span})
    origin = builder.origin(body.thing, body.pose)
    builder.joints.append(making.joint(place, name, FLOATING, parent, body.name, origin))
    builder.keep_free(body, joint)
    builder.above[body.name] = name


def _add(
    builder: Builder,
    thing: Placed,
    kind: str,
    name: str,
    links: tuple[str, str],
    origin: Pose,
    *,
    placing: Thing,
    is_marked: bool,
) -> None:
    """Add one joint.

    Args:
        builder: the robot.
        thing: the joint.
        kind: its type.
        name: its name.
        links: the links that it is between, the parent first.
        origin: where it is in the parent.
        placing: what says where it is: the body, or the joint itself.
        is_marked: whether it is one of several, or beside the body's origin.
    """
    given, compiler = thing.given, thing.context.compiler
    angle = compiler.angle if kind == "hinge" else float
    axis = unit_axis(given, Z_AXIS)
    if thing.pose is not IDENTITY:
        axis = rotate(thing.pose.rotation, axis)
    extras: list[Node] = []
    reference = numbers(given, "ref", 1)
    if reference is not None and reference[0]:
        shift = -angle(reference[0])
        step = (
            Pose(rotation_about(axis, shift), ZERO)
            if kind == "hinge"
            else Pose(UNTURNED, (axis[0] * shift, axis[1] * shift, axis[2] * shift))
        )
        origin = origin @ step
    if is_marked:
        where = _place(thing, "hinge")
        extras.append(setting("pos", row(where or ZERO), thing.where("pos")))
    ends = numbers(given, "range", 2)
    limited = chosen(given, "limited", LIMITED, "auto")
    has_range = ends is not None and any(ends)
    is_limited = limited == "true" or (limited == "auto" and compiler.autolimits and has_range)
    lower, upper = map(angle, ends or (0.0, 0.0))
    if is_limited and lower >= upper:
        raise fault(
            "the first number of 'range' is less than the second",
            given["range"][1] if ends is not None else thing.span,
            'write range="-1 1"',
        )
    if has_range and not is_limited:
        extras.append(setting("range", row((lower, upper)), given["range"][1]))
        extras.append(setting("limited", "false", thing.span))
    room = (lower, upper) if is_limited else None
    if kind == "slide" and room is None:
        room = (-UNBOUNDED, UNBOUNDED)
    limit = _limit(builder, thing, name, room, extras)
    dynamics = _dynamics(thing, extras)
    for key, (value, span) in given.items():
        if key in ("ref", "springref", "springyield"):
            extras.append(setting(key, row(map(angle, numbers(given, key) or ())), span))
        elif key not in HELD and key not in _ELSEWHERE:
            extras.append(setting(key, value, span))
    place = Place(thing.span, {"name": thing.name_span})
    inner: list[Node] = [*builder.origin(placing, origin), element("axis", place, {"xyz": axis})]
    inner += dynamics
    effort = None
    if limit is not None:
        places, values = limit
        effort = values["effort"]
        inner.append(element("limit", Place(thing.span, places), values))
    if name in builder.mimics:
        inner.append(builder.mimics[name])
    extras += builder.drives.elements(name, room, effort)
    if extras:
        inner.append(block(thing.span, extras))
    word = PRISMATIC if kind == "slide" else REVOLUTE if is_limited else CONTINUOUS
    builder.joints.append(making.joint(place, name, word, *links, inner))
    builder.joint_names[id(thing)] = name
    builder.above[links[1]] = name
    if is_limited:
        builder.limits[name] = (lower, upper)


ROUNDING = 1e-9
"""How far forces may be off that are the same."""
_ELSEWHERE = frozenset(
    (
        "armature", "damping", "frictionloss", "actuatorfrcrange", "actuatorfrclimited", "ref",
        "springref", "springyield",
    )
)  # fmt: skip


def _limit(
    builder: Builder,
    thing: Placed,
    name: str,
    ends: tuple[float, float] | None,
    extras: list[Node],
) -> tuple[dict[str, Span], dict[str, float]] | None:
    """Return the places and values of the limit of a joint, or None if it has none.

    Append what it does not hold.

    Where the joint does not bound the effort, it is that of its actuators; the writer of MJCF
    bounds the joint where these could exceed it.
    """
    given = thing.given
    force = numbers(given, "actuatorfrcrange", 2)
    flag = chosen(given, "actuatorfrclimited", LIMITED, "auto")
    is_bounded = flag == "true" or (
        flag == "auto" and thing.context.compiler.autolimits and force is not None and any(force)
    )
    span = thing.where("range")
    places: dict[str, Span] = {"lower": span, "upper": span}
    values: dict[str, float] = {}
    if force is not None and is_bounded:
        values["effort"] = max(map(abs, force))
        places["effort"] = given["actuatorfrcrange"][1]
        own = builder.drives.effort(name)
        if force[0] != -force[1]:
            extras.append(setting("actuatorfrcrange", row(force), places["effort"]))
        elif own is not None and own <= values["effort"] * (1 + ROUNDING):
            extras.append(setting("actuatorfrclimited", "true", places["effort"]))
    else:
        effort = builder.drives.effort(name)
        if effort:
            values["effort"] = effort
        if force is not None:
            extras.append(setting("actuatorfrcrange", row(force), given["actuatorfrcrange"][1]))
            extras.append(setting("actuatorfrclimited", "false", thing.span))
    if ends is None and not values:
        return None
    if ends is not None:
        values |= {"lower": ends[0], "upper": ends[1]}
    return places, {"effort": UNBOUNDED, "velocity": UNBOUNDED, **values}


def _dynamics(thing: Placed, extras: list[Node]) -> list[Element]:
    """Return the damping, friction and armature of a joint; append what they do not hold."""
    values: dict[str, float] = {}
    places: dict[str, Span] = {}
    names = {"damping": "damping", "friction": "frictionloss", "armature": "armature"}
    for name, attribute in names.items():
        found = numbers(thing.given, attribute, 1, 3)
        if found is None:
            continue
        span = thing.given[attribute][1]
        if any(found[1:]) or found[0] < 0:
            extras.append(setting(attribute, row(found), span))
        if found[0] > 0:
            values[name], places[name] = found[0], span
    return [element("dynamics", Place(thing.span, places), values)] if values else []
