"""The content of links and joints as values that are equal for equal content, without names.

They only propose what was renamed. What differs is found by `links.py` and `joints.py`.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..joint import Joint
    from ..link import Collision, Link, Visual
    from ..pose import Pose
    from ..shapes import Shape

DIGITS = 9


def link_signature(link: Link) -> object:
    """Return the masses and shapes of a link."""
    inertial = link.inertial
    mass: object = None
    if inertial is not None:
        mass = (_row([inertial.mass, *inertial.inertia]), pose_signature(inertial.pose))
    return (
        mass,
        tuple(map(shape_signature, link.visuals)),
        tuple(map(shape_signature, link.collisions)),
    )


def shape_signature(body: Visual | Collision) -> object:
    """Return the shape and pose of a visual or collision."""
    return (shape_key(body.shape), pose_signature(body.pose))


def shape_key(shape: Shape | None) -> object:
    """Return the word and the sizes of a shape, and the file of a mesh."""
    if shape is None:
        return None
    return (shape.kind, _row(shape.size), getattr(shape, "filename", ""))


def joint_signature(joint: Joint) -> object:
    """Return the type, pose, axis and limits of a joint."""
    limit = joint.limit
    limits = None if limit is None else _row([limit.lower, limit.upper])
    axis = None if joint.is_fixed else _row(joint.axis)
    return (joint.type, pose_signature(joint.origin), axis, limits)


def pose_signature(pose: Pose) -> object:
    """Return a position and a rotation."""
    return (_row(pose.position), tuple(map(_row, pose.rotation)))


def _row(numbers: Iterable[float]) -> tuple[float, ...]:
    return tuple(round(number, DIGITS) + 0.0 for number in numbers)
