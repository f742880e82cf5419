"""The pose of a joint, link or section: reading `xyz`, `rpy` and `pivot`, and making `<origin>`.

Numbers that need no computing keep their spelling; rotations are composed as rotations.
"""

from __future__ import annotations

from math import isfinite

from ..diagnostics import failure
from ..xmltree import Element
from .fields import empty_value, read_record, read_value
from .numbers import NEGLIGIBLE, Numbers, format_component, read_numbers
from .transforms import ZERO, multiply, rotate, rotation_from_rpy, rpy_from_rotation

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..diagnostics import Frame
    from ..source import Span
    from .fields import Fields
    from .lowering import Lowering
    from .transforms import Rotation, Vector

Words = tuple[str, ...]

ZERO_WORDS: Words = ("0", "0", "0")


class Pose:
    """T_parent_frame with the words it is written as.

    Attributes:
        position: the frame's origin in the parent, in metres.
        rotation: the rotation matrix, or None for none at all.
        xyz: the words of the position.
        rpy: the words of the rotation.
        span: the first key of the pose, or None when no pose is written.
        spans: where `xyz` and `rpy` are written, by attribute.
    """

    __slots__ = ("position", "rotation", "rpy", "span", "spans", "xyz")

    def __init__(
        self,
        position: Vector,
        rotation: Rotation | None,
        *,
        xyz: Words,
        rpy: Words,
        span: Span | None,
        spans: dict[str, Span] | None,
    ) -> None:
        """Hold a pose; see the class."""
        self.position = position
        self.rotation = rotation
        self.xyz = xyz
        self.rpy = rpy
        self.span = span
        self.spans = spans


NO_POSE = Pose(ZERO, None, xyz=ZERO_WORDS, rpy=ZERO_WORDS, span=None, spans=None)


def pose_at(position: Vector) -> Pose:
    """Return the pose of a frame that is only moved; what is only rounding counts as 0."""
    x, y, z = (0.0 if abs(c) < NEGLIGIBLE else c for c in position)
    words = (format_component(x), format_component(y), format_component(z))
    return Pose((x, y, z), None, xyz=words, rpy=ZERO_WORDS, span=None, spans=None)


def read_pose(lowering: Lowering, fields: Fields) -> Pose:
    """Return the pose that the keys of a joint, link or section give.

    Raises:
        YamaroError: faulty numbers, or `origin` beside `xyz`, `rpy` or `pivot`.
    """
    keys = fields.keys
    origin = keys.get("origin")
    if origin is not None:
        return _read_origin(lowering, fields, origin)
    xyz_key, rpy_key, pivot_key = keys.get("xyz"), keys.get("rpy"), keys.get("pivot")
    key = xyz_key or rpy_key or pivot_key
    if key is None:
        return NO_POSE
    spans: dict[str, Span] = {}
    xyz = _read_vector(lowering, xyz_key, spans) if xyz_key is not None else None
    rpy = _read_vector(lowering, rpy_key, spans) if rpy_key is not None else None
    pivot = _read_vector(lowering, pivot_key, spans) if pivot_key is not None else None
    return _place(xyz, rpy, pivot, key.span, spans)


def _read_origin(lowering: Lowering, fields: Fields, origin: Element) -> Pose:
    """Return the pose of an `origin` written as people write it in URDF."""
    for name in ("xyz", "rpy", "pivot"):
        if name in fields.keys:
            raise failure(
                "given-twice",
                f"the pose is given twice, by 'origin' and by '{name}'",
                fields.keys[name].span,
                hint="write xyz: and rpy: only",
                notes=(f"'origin' is given at {origin.span.place()}",),
                trace=origin.trace,
            )
    record = read_record(lowering, origin, None)
    rows: dict[str, Numbers] = {}
    for name, value in record.values.items():
        if name not in ("xyz", "rpy", "pivot"):
            raise failure(
                "unknown-key",
                f"'{name}' is no attribute of an origin in a part",
                record.spans[name],
                hint="write xyz, rpy and pivot, or <origin>: for an element as it is",
                trace=origin.trace,
            )
        rows[name] = _numbers(lowering, value, record.spans[name], name, origin.trace)
    return _place(rows.get("xyz"), rows.get("rpy"), rows.get("pivot"), origin.span, record.spans)


def _read_vector(lowering: Lowering, key: Element, spans: dict[str, Span]) -> Numbers:
    """Return the numbers of `xyz`, `rpy` or `pivot`, and note in `spans` where they stand."""
    value, span = read_value(key)
    if type(value) is str and not value:
        raise empty_value(key)
    spans[key.name] = span
    return _numbers(lowering, value, span, key.name, key.trace)


def _numbers(
    lowering: Lowering, value: object, span: Span, name: str, trace: Frame | None
) -> Numbers:
    numbers = read_numbers(lowering, value, span, count=3, name=name, trace=trace)
    if type(value) is str:
        return numbers
    words = tuple(
        "0" if number and abs(number) < NEGLIGIBLE else word
        for word, number in zip(numbers.words, numbers.values, strict=True)
    )
    return Numbers(words, numbers.values)


def _place(
    xyz: Numbers | None,
    rpy: Numbers | None,
    pivot: Numbers | None,
    span: Span,
    spans: dict[str, Span],
) -> Pose:
    """Return the pose whose pivot lands on xyz: its origin is xyz − R·pivot.

    Args:
        xyz: where the pivot lands.
        rpy: the rotation.
        pivot: a point in the frame.
        span: the first key of the pose.
        spans: where each of the three is written; becomes the spans of the pose.
    """
    rotation = rotation_from_rpy(*rpy.values) if rpy is not None and not rpy.is_zero() else None
    position = _vector(xyz.values) if xyz is not None else ZERO
    words = xyz.words if xyz is not None else ZERO_WORDS
    pivot_span = spans.pop("pivot", span)
    if pivot is not None and not pivot.is_zero():
        back = _negated(_vector(pivot.values))
        if rotation is not None:
            back = rotate(rotation, back)
        position, words = _sum(position, words, back, None)
        spans.setdefault("xyz", pivot_span)
    return Pose(
        position,
        rotation,
        xyz=words,
        rpy=rpy.words if rpy is not None else ZERO_WORDS,
        span=span,
        spans=spans,
    )


def compose_poses(outer: Pose, inner: Pose) -> Pose:
    """Return T_outer · T_inner; where one of them is trivial, the other's words are kept."""
    if inner.span is None and inner.position == ZERO:
        return outer
    if outer.span is None:
        return inner
    rotation, rpy = _composed_rotation(outer, inner)
    if outer.rotation is None:
        position, xyz = _sum(outer.position, outer.xyz, inner.position, inner.xyz)
    else:
        moved = rotate(outer.rotation, inner.position)
        position, xyz = _sum(outer.position, outer.xyz, moved, None)
    spans = {**(outer.spans or {}), **(inner.spans or {})}
    return Pose(position, rotation, xyz=xyz, rpy=rpy, span=inner.span or outer.span, spans=spans)


def _composed_rotation(outer: Pose, inner: Pose) -> tuple[Rotation | None, Words]:
    if inner.rotation is None:
        return outer.rotation, outer.rpy
    if outer.rotation is None:
        return inner.rotation, inner.rpy
    rotation = multiply(outer.rotation, inner.rotation)
    roll, pitch, yaw = rpy_from_rotation(rotation)
    return rotation, (format_component(roll), format_component(pitch), format_component(yaw))


def _sum(
    first: Vector, first_words: Words, second: Vector, second_words: Words | None
) -> tuple[Vector, Words]:
    """Return the sum of two vectors and its words; what is added to 0 keeps its word."""
    words = []
    for axis in range(3):
        if abs(second[axis]) < NEGLIGIBLE:
            words.append(first_words[axis])
        elif first[axis] == 0 and second_words is not None:
            words.append(second_words[axis])
        else:
            words.append(format_component(first[axis] + second[axis]))
    total = (first[0] + second[0], first[1] + second[1], first[2] + second[2])
    return total, tuple(words)


def _vector(values: tuple[float, ...]) -> Vector:
    x, y, z = values
    return (x, y, z)


def _negated(vector: Vector) -> Vector:
    x, y, z = vector
    return (-x, -y, -z)


def origin_element(pose: Pose, owner: Element) -> Element:
    """Return `<origin>` with both attributes, placed at the pose's first key or else its owner.

    Raises:
        YamaroError: the position is too large for a number.
    """
    if not isfinite(sum(pose.position)):
        raise failure(
            "bad-number",
            "the computed position is too large for a number",
            pose.span or owner.span,
            hint="positions are in metres",
            trace=owner.trace,
        )
    return Element(
        "origin",
        pose.span or owner.span,
        attributes={"xyz": " ".join(pose.xyz), "rpy": " ".join(pose.rpy)},
        value_spans=pose.spans or None,
        trace=owner.trace,
    )
