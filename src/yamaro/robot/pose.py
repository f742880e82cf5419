"""The pose of a joint, link or section: reading `xyz`, `rpy` and `pivot`, and making `<origin>`.

Numbers that need no computing keep their spelling; rotations are composed as rotations.
"""

from __future__ import annotations

from math import isfinite
from operator import add

from ..diagnostics import YamaroError, failure
from ..model.pose import (
    ZERO,
    multiply,
    rotate,
    rotation_from_quaternion,
    rotation_from_rpy,
    rpy_from_rotation,
)
from ..source import joined
from ..xml.tree import Element, Text
from ..xml.values import Numbers
from .fields import POSE_ROWS, empty_value, read_record, read_value, refuse_misspelt
from .numbers import NEGLIGIBLE, format_component, read_numbers

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..diagnostics import Diagnostic, Frame
    from ..model.pose import Rotation, Vector
    from ..source import Span
    from .fields import Fields
    from .lowering import Lowering

    Words = tuple[str, ...]

ZERO_ROW = Numbers(("0", "0", "0"), ZERO, ZERO)


class Pose:
    """T_parent_frame with the words it is written as.

    Attributes:
        xyz: the frame's origin in the parent, in metres.
        rpy: the rotation as roll, pitch and yaw, in radians.
        span: the first key of the pose, or None when no pose is written.
        spans: where `xyz` and `rpy` are written, by attribute.
    """

    __slots__ = ("_rotation", "rpy", "span", "spans", "xyz")

    def __init__(
        self,
        xyz: Numbers,
        rpy: Numbers,
        span: Span | None,
        spans: dict[str, Span] | None,
        rotation: Rotation | None = None,
    ) -> None:
        """Hold a pose; `rotation` is the matrix of `rpy`, where it is at hand."""
        self.xyz = xyz
        self.rpy = rpy
        self.span = span
        self.spans = spans
        self._rotation = rotation

    @property
    def rotation(self) -> Rotation | None:
        """The rotation matrix, or None for none at all.

        Most poses stay as they are written and never need it.
        """
        if self._rotation is None and not self.rpy.is_zero():
            self._rotation = rotation_from_rpy(*self.rpy.values)
        return self._rotation


NO_POSE = Pose(ZERO_ROW, ZERO_ROW, span=None, spans=None)
NO_ORIGIN = Pose(ZERO_ROW, ZERO_ROW, span=None, spans=None)
"""The pose of `origin: none`, which is that of the frame around, with no element to say so."""


def pose_at(position: Vector) -> Pose:
    """Return the pose of a frame that is only moved; what is only rounding counts as 0."""
    if position == ZERO:
        return NO_POSE
    values = tuple(0.0 if abs(c) < NEGLIGIBLE else c for c in position)
    return Pose(_computed_row(values), ZERO_ROW, span=None, spans=None)


def read_pose(lowering: Lowering, fields: Fields) -> Pose:
    """Return the pose that the keys of a joint, link or section give.

    Raises:
        YamaroError: faulty numbers, or `origin` beside `xyz`, `rpy` or `pivot`.

    `origin: none` gives NO_ORIGIN.
    """
    keys = fields.keys
    origin = keys.get("origin")
    if origin is not None:
        return _read_origin(lowering, fields, origin)
    xyz_key, rpy_key, pivot_key = keys.get("xyz"), keys.get("rpy"), keys.get("pivot")
    quat_key = keys.get("quat")
    key = xyz_key or rpy_key or quat_key or pivot_key
    if key is None:
        return NO_POSE
    spans: dict[str, Span] = {}
    try:
        xyz = _read_vector(lowering, xyz_key, spans) if xyz_key is not None else None
        rpy = _read_vector(lowering, rpy_key, spans) if rpy_key is not None else None
        if quat_key is not None:
            rpy = _turned(_read_vector(lowering, quat_key, spans), rpy, spans, quat_key.trace)
        pivot = _read_vector(lowering, pivot_key, spans) if pivot_key is not None else None
    except YamaroError as error:
        faults: list[Diagnostic] = []
        for each in (xyz_key, rpy_key, quat_key, pivot_key):
            try:
                if each is not None:
                    _read_vector(lowering, each, spans)
            except YamaroError as own:
                faults += own.diagnostics
        raise YamaroError(faults or error.diagnostics) from None
    return _place(xyz, rpy, pivot, key.span, spans)


def pose_of_values(lowering: Lowering, rows: dict[str, tuple[object, Span, Span]]) -> Pose:
    """Return the pose of `xyz`, `rpy` and `pivot`, each a value with the places of key and value.

    Raises:
        YamaroError: faulty numbers.
    """
    if not rows:
        return NO_POSE
    spans: dict[str, Span] = {}
    numbers: dict[str, Numbers] = {}
    first: Span | None = None
    for name, (value, key_span, span) in rows.items():
        first = first or key_span
        spans[name] = span
        numbers[name] = _numbers(lowering, value, span, name, None)
    assert first is not None
    if "quat" in numbers:
        numbers["rpy"] = _turned(numbers["quat"], numbers.get("rpy"), spans, None)
    return _place(numbers.get("xyz"), numbers.get("rpy"), numbers.get("pivot"), first, spans)


def _read_origin(lowering: Lowering, fields: Fields, origin: Element) -> Pose:
    """Return the pose of an `origin` written as people write it in URDF."""
    for name in POSE_ROWS:
        if name in fields.keys:
            raise failure(
                "given-twice",
                f"the pose is given twice, by 'origin' and by '{name}'",
                fields.keys[name].span,
                hint="write xyz: and rpy: only",
                notes=(f"'origin' is given at {origin.span.place()}",),
                trace=origin.trace,
            )
    children = origin.children
    if (
        len(children) == 1
        and isinstance(children[0], Text)
        and children[0].value == "none"
        and not origin.attributes
    ):
        return NO_ORIGIN
    record = read_record(lowering, origin, None)
    refuse_misspelt(record, POSE_ROWS)
    rows: dict[str, Numbers] = {}
    spans: dict[str, Span] = {}
    for name, value in record.values.items():
        if name not in POSE_ROWS:
            raise failure(
                "unknown-key",
                f"'{name}' is not an attribute of an origin in a part",
                record.span(name),
                hint="write xyz, rpy, quat and pivot, or <origin>: for an XML element",
                trace=origin.trace,
            )
        spans[name] = record.span(name)
        rows[name] = _numbers(lowering, value, spans[name], name, origin.trace)
    if "quat" in rows:
        rows["rpy"] = _turned(rows["quat"], rows.get("rpy"), spans, origin.trace)
    return _place(rows.get("xyz"), rows.get("rpy"), rows.get("pivot"), origin.span, spans)


def _read_vector(lowering: Lowering, key: Element, spans: dict[str, Span]) -> Numbers:
    """Return the numbers of a key of a pose, and note in `spans` where they stand."""
    value, span = read_value(key)
    if type(value) is str and not value:
        raise empty_value(key)
    spans[key.name] = span
    return _numbers(lowering, value, span, key.name, key.trace)


def _numbers(
    lowering: Lowering, value: object, span: Span, name: str, trace: Frame | None
) -> Numbers:
    count = 4 if name == "quat" else 3
    numbers = read_numbers(lowering, value, span, count=count, name=name, trace=trace)
    if type(value) is str:
        return numbers
    words = tuple(
        "0" if number and abs(number) < NEGLIGIBLE else word
        for word, number in zip(numbers.words, numbers.values, strict=True)
    )
    return Numbers(words, numbers.values)


def _turned(
    quat: Numbers, rpy: Numbers | None, spans: dict[str, Span], trace: Frame | None
) -> Numbers:
    """Return roll, pitch and yaw of the quaternion w x y z, which is written in place of `rpy`.

    Raises:
        YamaroError: `rpy` is written as well, or the quaternion is 0.
    """
    span = spans.pop("quat")
    if rpy is not None:
        raise failure(
            "given-twice",
            "the rotation is given twice, by 'rpy' and by 'quat'",
            span,
            hint="remove one of them",
            notes=(f"'rpy' is given at {spans['rpy'].place()}",),
            trace=trace,
        )
    w, x, y, z = quat.values
    if not any(quat.values):
        raise failure(
            "bad-number",
            "a quaternion of zeros is not a rotation",
            span,
            hint="write w x y z, such as 1 0 0 0 for none",
            trace=trace,
        )
    spans["rpy"] = span
    return _computed_row(rpy_from_rotation(rotation_from_quaternion(x, y, z, w)))


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
    pose = Pose(xyz or ZERO_ROW, rpy or ZERO_ROW, span, spans)
    pivot_span = spans.pop("pivot", span)
    if pivot is not None and not pivot.is_zero():
        x, y, z = pivot.values
        back = (-x, -y, -z)
        pose.xyz = _sum(pose.xyz, _rotated(pose, back), None)
        spans["xyz"] = joined(spans["xyz"], pivot_span) if "xyz" in spans else pivot_span
        _note_turn(spans, spans)
    return pose


def compose_poses(outer: Pose, inner: Pose) -> Pose:
    """Return T_outer · T_inner; where one of them is trivial, the other's words are kept."""
    if inner is NO_ORIGIN:
        return inner
    if inner.span is None and inner.xyz.is_zero():
        return outer
    if outer.span is None:
        return inner
    rotation, rpy = _composed_rotation(outer, inner)
    is_turned = outer.rotation is not None
    moved = _rotated(outer, inner.xyz.values)
    xyz = _sum(outer.xyz, moved, None if is_turned else inner.xyz.words)
    spans = {**(outer.spans or {}), **(inner.spans or {})}
    for name, span in (outer.spans or {}).items():
        if spans[name] is not span:
            spans[name] = joined(spans[name], span)
    if not inner.xyz.is_zero():
        _note_turn(spans, outer.spans or {})
    return Pose(xyz, rpy, inner.span or outer.span, spans, rotation)


def _note_turn(spans: dict[str, Span], outer: dict[str, Span]) -> None:
    """Note at the place of a position that the rotation around it is part of it."""
    if "rpy" in outer and "xyz" in spans:
        spans["xyz"] = joined(spans["xyz"], outer["rpy"])


def _composed_rotation(outer: Pose, inner: Pose) -> tuple[Rotation | None, Numbers]:
    if inner.rotation is None:
        return outer.rotation, outer.rpy
    if outer.rotation is None:
        return inner.rotation, inner.rpy
    rotation = multiply(outer.rotation, inner.rotation)
    return rotation, _computed_row(rpy_from_rotation(rotation))


def _rotated(pose: Pose, vector: tuple[float, ...]) -> tuple[float, ...]:
    """Return a vector given in a pose's frame along the axes of its parent."""
    x, y, z = vector
    return vector if pose.rotation is None else rotate(pose.rotation, (x, y, z))


def _computed_row(values: tuple[float, ...]) -> Numbers:
    return Numbers(tuple(map(format_component, values)), values)


def _sum(first: Numbers, second: tuple[float, ...], second_words: Words | None) -> Numbers:
    """Return the sum of two vectors; what is added to 0 keeps its word."""
    words = []
    for axis in range(3):
        if abs(second[axis]) < NEGLIGIBLE:
            words.append(first.words[axis])
        elif first.values[axis] == 0 and second_words is not None:
            words.append(second_words[axis])
        else:
            words.append(format_component(first.values[axis] + second[axis]))
    return Numbers(tuple(words), tuple(map(add, first.values, second)))


def origin_element(pose: Pose, owner: Element) -> Element | None:
    """Return `<origin>` with both attributes, placed at the pose's first key or else its owner.

    None if it is not to be written.

    Raises:
        YamaroError: the position is too large for a number.
    """
    if pose is NO_ORIGIN:
        return None
    if not isfinite(sum(pose.xyz.values)):
        raise failure(
            "bad-number",
            "the computed position is too large for a number",
            pose.span or owner.span,
            hint="positions are in metres",
            trace=owner.trace,
        )
    attributes: dict[str, object] = {"xyz": pose.xyz, "rpy": pose.rpy}
    return Element("origin", pose.span or owner.span, attributes, [], owner.trace, pose.spans)
