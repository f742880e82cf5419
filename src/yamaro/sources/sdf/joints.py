"""Joints of SDF: axes, limits, dynamics, mimic; where they are in the tree that URDF has.

A joint of URDF is at the frame of its child link. One of SDF can be anywhere in its child. Where a
link turns about an axis beside its frame, a link without mass stands at the joint, and a fixed
joint leads on to the link, so that both frames are what the document says.
"""

from __future__ import annotations

from math import inf, isfinite, sqrt

from ...model import making
from ...model.joint import CONTINUOUS, FIXED, PRISMATIC, REVOLUTE
from ...model.pose import IDENTITY, Pose, Vector, rotate, transposed
from ...model.values import attribute_text, child_named, content, inside
from ...xml.tree import Element, RobotNote
from ...xml.values import Numbers, format_value
from .kept import check_words, clean, kept_of, leaf, pose_element
from .shapes import origin
from .values import UNLIMITED, text_span
from .versions import IN_MODEL_FRAME

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ...source import Span
    from ...xml.tree import Node
    from .kept import Held
    from .scopes import Frames
    from .tree import Edge
    from .values import Reading

TYPES = {
    "revolute": REVOLUTE,
    "continuous": CONTINUOUS,
    "prismatic": PRISMATIC,
    "fixed": FIXED,
}
OTHER_TYPES = frozenset(("ball", "universal", "screw", "gearbox", "revolute2"))
"""Joints that only SDF has: fixed in the model, and kept for SDF."""
NEGLIGIBLE = 1e-12
"""How far, in metres, an axis may pass beside a frame and count as passing through it."""

AXIS: Held = {
    "xyz": True,
    "use_parent_model_frame": True,
    "limit": dict.fromkeys(("lower", "upper", "effort", "velocity", "drake:acceleration"), True),
    "dynamics": dict.fromkeys(("damping", "friction"), True),
}
DIRECTION = frozenset(("xyz", "use_parent_model_frame"))
"""What says where an axis points."""
JOINT: Held = {"@name": True, "@type": True, "parent": True, "child": True, "pose": True}


class Placed:
    """Where a joint is in the tree.

    Attributes:
        origin: T_top_joint.
        rest: T_joint_bottom of a link that is not at the joint; IDENTITY where it is.
        turn: the rotation from the frame that the axis is given in to that of the joint in URDF.
    """

    __slots__ = ("origin", "rest", "turn")

    def __init__(self, origin: Pose, rest: Pose, turn: Pose) -> None:
        self.origin = origin
        self.rest = rest
        self.turn = turn


class JointReader:
    """Reads the joints of one document."""

    __slots__ = ("_frames", "_names", "_reading", "notes")

    def __init__(self, reading: Reading, frames: Frames, names: dict[object, str]) -> None:
        """Begin.

        Args:
            reading: reads the values.
            frames: know where all is.
            names: what links and joints are called in the robot, by their anchors.
        """
        self._reading = reading
        self._frames = frames
        self._names = names
        self.notes: list[RobotNote] = []

    def kind_of(self, edge: Edge) -> str:
        """Return the type of a joint in URDF; one that is not known is an error."""
        element = edge.joint.element
        written = (attribute_text(element, "type") or "").strip()
        drake = attribute_text(element, "drake:type")
        if written in OTHER_TYPES:
            return FIXED
        if written not in TYPES:
            from ...diagnostics import did_you_mean

            known = (*TYPES, *sorted(OTHER_TYPES))
            self._reading.fail(
                "bad-sdf",
                f"'{written}' is not a type of joint" if written else "this joint has no type",
                element.value_span("type"),
                hint=did_you_mean(written, known) or f"the types are {', '.join(known)}",
            )
            return FIXED
        if written == REVOLUTE and drake is None:
            lower, upper = self._bounds(element)
            if lower == -inf and upper == inf:
                return CONTINUOUS
        return TYPES[written]

    def _bounds(self, element: Element) -> tuple[float, float]:
        limit = inside(element, "axis", "limit")
        return (
            self._reading.limit(limit, "lower", -inf),
            self._reading.limit(limit, "upper", inf),
        )

    # --- axes ---

    def axis(self, edge: Edge, name: str = "axis") -> Vector:
        """Return the unit axis of a joint, in the frame of the joint."""
        reading, joint = self._reading, edge.joint
        axis = child_named(joint.element, name)
        written = child_named(axis, "xyz") if axis is not None else None
        x, y, z = reading.vector(axis, "xyz", (0.0, 0.0, 1.0))
        length = sqrt(x * x + y * y + z * z)
        if not length or not isfinite(length):
            reading.fail(
                "bad-sdf",
                f"the axis of the joint '{joint.name}' has no direction",
                text_span(written) if written is not None else joint.element.span,
                hint="write <xyz>0 0 1</xyz>",
            )
            return (0.0, 0.0, 1.0)
        if abs(length - 1) > 1e-15:
            x, y, z = x / length, y / length, z / length
        frame = None
        if written is not None:
            named = (attribute_text(written, "expressed_in") or "").strip()
            if named:
                frame = self._frames.find(named, joint.scope, written.value_span("expressed_in"))
        if frame is None and axis is not None:
            is_old = reading.versions.get(id(joint.element.span.source)) in IN_MODEL_FRAME
            if reading.truth(axis, "use_parent_model_frame", default=is_old):
                frame = joint.scope.anchor
        if frame is None or frame is joint:
            return (x, y, z)
        between = self._frames.between(joint, frame)
        return rotate(between.rotation, (x, y, z))

    # --- places ---

    def place(self, edge: Edge, kind: str, world: Pose) -> Placed:
        """Return where a joint is between the two links of the tree.

        Args:
            edge: the joint.
            kind: its type in URDF.
            world: T_world_model.
        """
        joint, frames = edge.joint, self._frames
        rest = frames.between(joint, edge.bottom)
        top = edge.top
        if top is None:
            at_joint = world if joint is None else _compose(world, frames.pose(joint))
            at_link = _compose(world, frames.pose(edge.bottom))
        else:
            at_joint, at_link = frames.between(top, joint), frames.between(top, edge.bottom)
        if rest == IDENTITY:
            return Placed(at_link if rest is IDENTITY else at_joint, IDENTITY, IDENTITY)
        turn = Pose(transposed(rest.rotation))
        has_sensor = child_named(joint.element, "sensor") is not None
        if kind == FIXED or (kind == PRISMATIC and not has_sensor):
            return Placed(at_link, IDENTITY, turn)
        if not has_sensor:
            x, y, z = rest.position
            a, b, c = self.axis(edge)
            off = (b * z - c * y, c * x - a * z, a * y - b * x)
            if max(map(abs, off)) <= NEGLIGIBLE * max(1.0, *map(abs, rest.position)):
                return Placed(at_link, IDENTITY, turn)
        return Placed(at_joint, rest, IDENTITY)

    # --- the joint in URDF ---

    def made(
        self, edge: Edge, kind: str, placed: Placed, *, top: str, bottom: str
    ) -> tuple[Element, list[Element]]:
        """Return a joint, and what the model does not hold of it.

        Args:
            edge: the joint.
            kind: its type.
            placed: where it is.
            top: the name of the link that it is on.
            bottom: the name of the link that it moves.
        """
        reading, element = self._reading, edge.joint.element
        check_words(reading, element)
        place = reading.place(
            element.span, {"name": element.value_span("name"), "type": element.value_span("type")}
        )
        ends = {name: child_named(element, name) for name in ("parent", "child")}
        if edge.is_reversed:
            ends = {"parent": ends["child"], "child": ends["parent"]}
        children: list[Node] = [
            making.element(
                name,
                reading.place(end.span, {"link": text_span(end)}) if end is not None else place,
                {"link": link},
            )
            for (name, end), link in zip(ends.items(), (top, bottom), strict=True)
        ]
        children[:0] = origin(reading, placed.origin, element)
        kept: list[Element] = []
        held: dict[str, bool | Held] = {**JOINT, "sensor": True}
        if (attribute_text(element, "type") or "").strip() in OTHER_TYPES:
            kept += self._other(edge)
            held |= {"axis": True, "axis2": True}
        elif kind == FIXED:
            held["axis"] = True
        else:
            children += self._movement(edge, kind, placed, held)
            self._note_actuator(edge, held)
        rest = kept_of(element, held)
        if rest is not None:
            kept += rest.elements()
        attributes = {"name": edge.name, "type": kind}
        return making.element("joint", place, attributes, children), kept

    def _movement(
        self, edge: Edge, kind: str, placed: Placed, held: dict[str, bool | Held]
    ) -> list[Element]:
        """Return axis, limit, dynamics and mimic of a joint with one degree of freedom."""
        reading, element = self._reading, edge.joint.element
        axis = child_named(element, "axis")
        if axis is None:
            reading.warn(
                "sdf-assumed",
                f"the joint '{edge.joint.name}' has no <axis>; it is taken for z",
                element.span,
                hint="write <axis><xyz>0 0 1</xyz></axis>",
            )
        else:
            check_words(reading, axis)
            for name in ("limit", "dynamics", "mimic"):
                inner = child_named(axis, name)
                if inner is not None:
                    check_words(reading, inner)
        sign = -1.0 if edge.is_reversed else 1.0
        x, y, z = self.axis(edge)
        if placed.turn is not IDENTITY:
            x, y, z = rotate(placed.turn.rotation, (x, y, z))
        written = child_named(axis, "xyz") if axis is not None else None
        span = text_span(written) if written is not None else element.span
        found = [
            making.element(
                "axis",
                reading.place(span, {"xyz": span}),
                {"xyz": (clean(sign * x), clean(sign * y), clean(sign * z))},
            )
        ]
        limit = inside(axis, "limit")
        found += self._limit(element, kind, limit)
        dynamics = inside(axis, "dynamics")
        values = {
            name: row
            for name in ("damping", "friction")
            if dynamics is not None
            and (child := child_named(dynamics, name)) is not None
            and content(child)
            and (row := reading.spelled(child, 1)) is not None
        }
        if dynamics is not None and values:
            spans = self._spans(dynamics, values)
            found.append(making.element("dynamics", reading.place(dynamics.span, spans), values))
        held["axis"] = dict(AXIS)
        found += self._mimic(edge, axis, held)
        return found

    def _limit(self, element: Element, kind: str, limit: Element | None) -> list[Element]:
        """Return the limits; what is not limited has a number so great that it means none."""
        reading = self._reading
        lower, upper = self._bounds(element)
        effort, velocity = (reading.limit(limit, name, -1.0) for name in ("effort", "velocity"))
        fastest = reading.limit(limit, "drake:acceleration", -1.0)
        values = {
            "effort": effort if 0 <= effort < inf else UNLIMITED,
            "velocity": velocity if 0 <= velocity < inf else UNLIMITED,
        }
        if kind != CONTINUOUS:
            values = {"lower": max(lower, -UNLIMITED), "upper": min(upper, UNLIMITED), **values}
        elif min(values.values()) == UNLIMITED and not 0 <= fastest < inf:
            return []
        if 0 <= fastest < inf:
            values["acceleration"] = fastest
        owner = limit if limit is not None else element
        spans = self._spans(limit, values) if limit is not None else {}
        written = {name: _as_written(limit, name, value) for name, value in values.items()}
        return [making.element("limit", reading.place(owner.span, spans), written)]

    def _spans(self, owner: Element, names: Iterable[str]) -> dict[str, Span]:
        found: dict[str, Span] = {}
        for name in names:
            child = child_named(owner, name) or child_named(owner, f"drake:{name}")
            if child is not None:
                found[name] = text_span(child)
        return found

    def _mimic(
        self, edge: Edge, axis: Element | None, held: dict[str, bool | Held]
    ) -> list[Element]:
        """Return the mimic of a joint: multiplier·(leader − reference) + offset in SDF."""
        reading, joint = self._reading, edge.joint
        mimic = child_named(axis, "mimic") if axis is not None else None
        of_drake = child_named(joint.element, "drake:mimic")
        if mimic is not None:
            values = {
                name: reading.number(mimic, name, default)
                for name, default in (("multiplier", 1.0), ("offset", 0.0), ("reference", 0.0))
            }
        elif of_drake is not None:
            mimic = of_drake
            values = {
                "reference": 0.0,
                "multiplier": self._attribute(mimic, "multiplier", 1.0),
                "offset": self._attribute(mimic, "offset", 0.0),
            }
        else:
            return []
        named = (attribute_text(mimic, "joint") or "").strip()
        leader = self._frames.find(named, joint.scope, mimic.value_span("joint")) if named else None
        if leader is None:
            if not named:
                reading.fail(
                    "bad-sdf", "this <mimic> names no joint", mimic.span,
                    hint='write <mimic joint="…">',
                )  # fmt: skip
            return []
        if (attribute_text(mimic, "axis") or "axis") != "axis":
            return []  # the second axis of the leader: only SDF has it
        if mimic is of_drake:
            held["drake:mimic"] = True
        else:
            inner = held["axis"]
            assert not isinstance(inner, bool)
            held["axis"] = {**inner, "mimic": True}
        offset = values["offset"] - values["multiplier"] * values["reference"]
        name = self._names.get(leader, named)
        place = reading.place(mimic.span, {"joint": mimic.value_span("joint")})
        given: dict[str, making.Value] = {
            "joint": name,
            "multiplier": values["multiplier"],
            "offset": offset,
        }
        return [making.element("mimic", place, given)]

    def _other(self, edge: Edge) -> list[Element]:
        """Return what only SDF has of a joint: its type, its axes, and where it is in its child."""
        element = edge.joint.element
        kind = leaf("type", attribute_text(element, "type") or "", element.value_span("type"))
        pose = self._frames.between(edge.bottom, edge.joint)
        if pose == IDENTITY:
            return [kind, *self.axes(edge)]
        return [kind, pose_element(pose, element, self._names[edge.bottom]), *self.axes(edge)]

    def axes(self, edge: Edge) -> list[Element]:
        """Return the axes of a joint as SDF has them, in the frame of the joint."""
        sign, found = -1.0 if edge.is_reversed else 1.0, []
        for name in ("axis", "axis2"):
            axis = child_named(edge.joint.element, name)
            if axis is None:
                continue
            numbers = [clean(sign * each) for each in self.axis(edge, name)]
            xyz = leaf("xyz", " ".join(map(format_value, numbers)), axis.span)
            rest = [each for each in axis.elements() if each.name not in DIRECTION]
            found.append(Element(name, axis.span, {}, [xyz, *rest]))
        return found

    def _note_actuator(self, edge: Edge, held: dict[str, bool | Held]) -> None:
        """Note what Drake reads of the motor of a joint."""
        reading, element = self._reading, edge.joint.element
        values: dict[str, making.Value] = {"joint": edge.name, "command": "effort"}
        spans = {}
        rotor = reading.number(element, "drake:rotor_inertia", 0.0)
        gear = reading.number(element, "drake:gear_ratio", 1.0)
        if rotor > 0 and gear:
            values |= {"rotor_inertia": rotor, "gear": gear, "armature": rotor * gear * gear}
            spans = self._spans(element, ("rotor_inertia",))
            held |= {"drake:rotor_inertia": True, "drake:gear_ratio": True}
        gains = child_named(element, "drake:controller_gains")
        if gains is not None:
            found = [self._attribute(gains, name, 0.0) for name in ("p", "d")]
            if min(found) >= 0 and max(found) > 0:
                kp, kd = found
                values |= {"command": "position", "kp": kp, "kd": kd}
                if not kp:  # as Drake takes it
                    values |= {"command": "velocity", "kp": kd, "kd": None}
                held["drake:controller_gains"] = True
        if len(values) > 2:
            place = reading.place(element.span, spans)
            self.notes.append(making.note("actuator", place, values))

    def _attribute(self, element: Element, name: str, default: float) -> float:
        """Return the finite number in an attribute, as Drake writes values."""
        text = attribute_text(element, name)
        try:
            number = float(text) if text else default
        except ValueError:
            number = inf
        if isfinite(number):
            return number
        self._reading.fail("bad-sdf", f"'{text}' is not a number", element.value_span(name))
        return default


def _as_written(parent: Element | None, name: str, value: float) -> Numbers:
    """Return a number as the child that says it spells it, else as it is computed."""
    text = content(child_named(parent, name)) if parent is not None else None
    try:
        is_same = text is not None and float(text) == value
    except ValueError:
        is_same = False
    return Numbers((text,), (value,), (value,)) if text and is_same else Numbers.of(value)


def _compose(first: Pose, second: Pose) -> Pose:
    from .values import compose

    return compose(first, second)
