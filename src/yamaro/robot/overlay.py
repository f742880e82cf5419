"""Overlays: values of the joints and links of a robot that is there, changed by their names.

An overlay is data: `joints` and `links`, names in them, and under each name values that the schema
has. Values are changed one by one, in the elements of URDF and the notes that a robot consists of
once its parts are lowered, whatever it was read from. Each changed value has two places: where it
was given before, and the overlay: `OverlaidSpan`.
"""

from __future__ import annotations

from ..diagnostics import WARNING, Diagnostic, YamaroError, failure, given_twice, unknown_word
from ..model.joint import CONTINUOUS, PRISMATIC
from ..model.pose import ZERO, Pose, rotation_about, rotation_from_quaternion, unit_vector
from ..model.schema import (
    ELEMENTS,
    JOINT_TYPES,
    MOMENTS,
    RECORDS,
    TEXT,
    joint_type_hint,
    joint_type_meant,
)
from ..source import OverlaidSpan, Span
from ..xml.tree import Element, OverlaidInclude, RobotNote
from ..xml.values import Numbers, format_value
from .fields import other_word, read_record, read_value, word_of
from .notes import given_once, refuse_attributes
from .numbers import format_component, read_attribute, read_numbers
from .rigid import name_of, origin_of, pose_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from ..diagnostics import Reporter
    from ..xml.tree import RobotWord
    from .lowering import Lowering

    Values = dict[str, tuple[object, Span]]
    Keys = dict[str, Element]

POSE = ("xyz", "rpy")
JOINT_KEYS = (*POSE, "type", "zero", *RECORDS, "actuator")
LINK_KEYS = ("mass", "inertia", "inertial")
INERTIAL_KEYS = (*POSE, "mass", "inertia")
MOST_LISTED = 12
"""Names that a hint lists."""


def overlay_part(lowering: Lowering, robot: Element, word: RobotWord) -> None:
    """Change what an included file made, as the overlays beside its path say."""
    included = word.body
    assert isinstance(included, OverlaidInclude)
    before, lowering.trace = lowering.trace, word.trace
    for overlay in word.elements():
        Overlaid(lowering, robot, included).change(overlay)
    lowering.trace = before


def check_alone(overlay: Element, reporter: Reporter) -> None:
    """Check an overlay without its robot: on one that has the names in it, and joints of any type.

    Raises:
        YamaroError: it has errors.
    """
    from .calibrations import KINEMATICS, LEROBOT
    from .lowering import Lowering

    lowering = Lowering(reporter, lambda name, span: None, may_read=None, has_capsule=True)
    robot = Element("robot", overlay.span)
    for section in overlay.elements():
        for key in section.elements():
            kind = "link" if section.name == "links" else "joint"
            made = Element(kind, key.span, {"name": key.name})
            if section.name == KINEMATICS:
                ends = {"parent": "", "child": f"{key.name}_link"}
                made.children = [Element(end, key.span, {"link": ends[end]}) for end in ends]
            if section.name not in (KINEMATICS, LEROBOT, "joints", "links"):
                continue
            robot.children.append(made)
    Overlaid(lowering, robot).change(overlay)
    if lowering.errors:
        raise YamaroError(lowering.errors)


class Overlaid:
    """A robot that an overlay changes, or the part of it that comes from one include.

    Attributes:
        lowering: the run; what is wrong is recorded there.
        robot: the robot, whose children are replaced.
        prefix: what is before the names that overlays know.
    """

    __slots__ = ("_places", "lowering", "prefix", "robot")

    def __init__(
        self, lowering: Lowering, robot: Element, included: OverlaidInclude | None = None
    ) -> None:
        """Find the links, joints and actuators that may be changed, by name."""
        self.lowering = lowering
        self.robot = robot
        self.prefix = "" if included is None else included.prefix
        self._places: dict[str, dict[str, int]] = {"joint": {}, "link": {}, "actuator": {}}
        for index, child in enumerate(robot.children):
            if not isinstance(child, Element) or child.name not in self._places:
                continue
            if included is None or included.holds(child):
                named = "joint" if isinstance(child, RobotNote) else "name"
                name = format_value(child.attributes.get(named))
                self._places[child.name].setdefault(name.removeprefix(self.prefix), index)

    def elements(self, kind: str) -> dict[str, Element]:
        """Return the links or joints by the names that overlays know."""
        found = {}
        for name, index in self._places[kind].items():
            child = self.robot.children[index]
            assert isinstance(child, Element)
            found[name] = child
        return found

    def change(self, overlay: Element) -> None:
        """Change what an overlay says; record what is wrong in it."""
        from .calibrations import as_overlay

        try:
            sections = given_once(as_overlay(self, overlay), ("joints", "links"))
        except YamaroError as error:
            self._absorb(error)
            return
        for kind, change in (("joint", self._change_joint), ("link", self._change_link)):
            section = sections.get(f"{kind}s")
            if section is None:
                continue
            try:
                named = given_once(section)
            except YamaroError as error:
                self._absorb(error)
                continue
            found: dict[int, Element] = {}
            for key in named.values():
                try:
                    index = self._find(kind, key)
                    if index in found:
                        raise given_twice(
                            f"'{key.name}' and '{found[index].name}' are the same {kind}",
                            key.span,
                            found[index].span,
                            hint="put its values under one of the two",
                            trace=self.lowering.trace,
                        )
                    found[index] = key
                    element = self.robot.children[index]
                    assert isinstance(element, Element)
                    self.robot.children[index] = change(element, key)
                except YamaroError as error:
                    self._absorb(error)

    def _absorb(self, error: YamaroError) -> None:
        """Record errors; no hint is to write an expression, as it is elsewhere."""
        for diagnostic in error.diagnostics:
            if "$(" in (diagnostic.hint or ""):
                diagnostic.hint = "an overlay holds values: write a number, with its unit"
        self.lowering.absorb(error)

    def _find(self, kind: str, key: Element) -> int:
        """Return where the link or joint is that a key names.

        Raises:
            YamaroError: there is none.
        """
        places = self._places[kind]
        parts = self.lowering.part_joints if kind == "joint" else self.lowering.part_links
        for name in (key.name, parts.get(self.prefix + key.name, "").removeprefix(self.prefix)):
            if name in places:
                return places[name]
        from ..fixes import respelling
        from ..model.positions import meant_name

        near = meant_name(key.name, places, (f"*_{kind}",))
        hint = None if near is None else f"did you mean '{near}'?"
        fix = None if near is None else respelling(key.span, key.name, near)
        other = "link" if kind == "joint" else "joint"
        if key.name in self._places[other]:
            hint, fix = f"there is a {other} of that name: write it under `{other}s`", None
        if hint is None:
            listed = [*places][:MOST_LISTED]
            more = ", …" if len(places) > len(listed) else ""
            hint = f"the {kind}s are {', '.join(listed)}{more}" if listed else None
        raise failure(
            f"unknown-{kind}",
            f"there is no {kind} '{key.name}' in the robot",
            key.span,
            hint=hint,
            trace=self.lowering.trace,
            fix=fix,
        )

    # --- a joint ---

    def _change_joint(self, joint: Element, key: Element) -> Element:
        keys = self._entries(key, JOINT_KEYS)
        lowering = self.lowering
        joint = _own(joint)
        if "type" in keys:
            self._attempt(lambda: self._set(joint, {"type": self._joint_type(keys["type"])}))
        kind = joint.attributes.get("type")
        lowering.joint_type = None if kind is None else format_value(kind)
        for name in POSE:
            if name in keys:
                self._attempt(self._set_row, joint, keys[name])
        # What is after the zero counts from there.
        for name in ("axis", "zero", *[each for each in RECORDS if each != "axis"]):
            if name in keys:
                step = self._set_zero if name == "zero" else self._set_record
                self._attempt(step, joint, keys[name])
        if "actuator" in keys:
            self._attempt(self._change_actuator, joint, keys["actuator"])
        return joint

    def _attempt(self, step: Callable[..., object], *arguments: object) -> None:
        """Do a step; record what is wrong with it, and go on."""
        try:
            step(*arguments)
        except YamaroError as error:
            self._absorb(error)

    def _entries(self, key: Element, known: Collection[str]) -> Keys:
        """Return the entries of a link, joint or inertial by name; record those that are unknown.

        Raises:
            YamaroError: one is given twice, or there are none.
        """
        refuse_attributes(key)
        for entry in key.elements():
            if entry.name not in known:
                from ..diagnostics import meant_word

                hint, fix = meant_word(entry.name, known, entry.span)
                error = failure(
                    "unknown-key",
                    f"'{entry.name}' is not a value of '{key.name}' that an overlay changes",
                    entry.span,
                    hint=hint or f"these are {', '.join(known)}",
                    trace=self.lowering.trace,
                    fix=fix,
                )
                self._absorb(error)
        return given_once(key)

    def _joint_type(self, key: Element) -> tuple[object, Span]:
        value, span = read_value(key)
        word = word_of("type", value, span, owner=key)
        if word not in JOINT_TYPES:
            from ..fixes import respelling

            raise failure(
                "joint-type",
                f"'{word}' is not a joint type",
                span,
                hint=joint_type_hint(word),
                trace=self.lowering.trace,
                fix=respelling(span, word, joint_type_meant(word), is_safe=True),
            )
        return word, span

    def _set_record(self, joint: Element, key: Element) -> None:
        self._set_child(joint, key.name, self._record(key), key.span)

    def _record(self, key: Element) -> Values:
        """Return the values of an entry such as `limit`, by the schema."""
        thing = ELEMENTS[key.name]
        record = read_record(self.lowering, key, thing.scalar)
        values: Values = {}
        for entry in key.elements():
            if entry.name not in thing.fields:
                self._refuse_entry(key, entry, thing.fields)
        for name, value in record.values.items():
            field, span = thing.fields[name], record.span(name)
            label = thing.name if name == thing.scalar else name
            self.lowering.has_armatures |= not field.in_urdf
            if field.count == TEXT:
                word = word_of(label, value, span, owner=key)
                values[name] = self._joint_named(word), span
                continue
            numbers = read_attribute(
                self.lowering, record, name, count=field.count, name=label, kind=field.kind
            )
            values[name] = numbers, span
        return values

    def _joint_named(self, name: str) -> str:
        """Return the joint that a mimic names, without its prefix or by its part."""
        joints = self._places["joint"]
        if name in joints:
            return self.prefix + name
        part = self.lowering.part_joints.get(self.prefix + name, "")
        return part if part.removeprefix(self.prefix) in joints else name

    def _refuse_entry(self, key: Element, entry: Element, known: Collection[str]) -> None:
        raise unknown_word(
            "unknown-key",
            f"'{entry.name}' is not an entry of '{key.name}'",
            entry.span,
            entry.name,
            known,
            hint=f"its entries are {', '.join(known)}",
            trace=self.lowering.trace,
            near=other_word(entry.name, known),
        )

    def _set_row(self, owner: Element, key: Element) -> None:
        """Change one row of the `<origin>` of an element."""
        value, span = read_value(key)
        trace = self.lowering.trace
        numbers = read_numbers(self.lowering, value, span, count=3, name=key.name, trace=trace)
        origin = self._set_child(owner, "origin", {key.name: (numbers, span)}, key.span)
        if key.name == "rpy":
            origin.attributes.pop("quat_xyzw", None)

    def _change_actuator(self, joint: Element, key: Element) -> None:
        from .actuator import changed_actuator

        name = name_of(joint).removeprefix(self.prefix)
        index = self._places["actuator"].get(name)
        before = None if index is None else self.robot.children[index]
        assert before is None or isinstance(before, RobotNote)
        note = changed_actuator(self.lowering, key, joint, before)
        if before is None or index is None:
            note.trace, note.body = joint.trace, joint.body
            self._places["actuator"][name] = len(self.robot.children)
            self.robot.children.append(note)
            return
        changed = _own(before)
        given = note.value_spans
        assert given is not None, "each value of a note has a place"
        values = {
            name: (value, given.get(name) or key.span)
            for name, value in note.attributes.items()
            if before.attributes.get(name) != value
        }
        changed.attributes = {
            name: value for name, value in changed.attributes.items() if name in note.attributes
        }
        self._set(changed, values)
        changed.span = _overlaid_key(key.span, before)
        self.robot.children[index] = changed

    # --- the zero of a joint ---

    def _set_zero(self, joint: Element, key: Element) -> None:
        """Let a joint read 0 where it read another position: T(q) = T_before(q + zero).

        Its origin takes up the motion, and all its positions are counted from there.
        """
        value, span = read_value(key)
        trace, name = self.lowering.trace, name_of(joint)
        zero = read_numbers(
            self.lowering, value, span, count=1, name="zero", trace=trace, kind="position"
        ).values[0]
        kind = self.lowering.joint_type
        if kind is None:  # of an overlay without its robot
            return
        if kind not in ("revolute", CONTINUOUS, PRISMATIC):
            raise failure(
                "bad-zero",
                f"the joint '{name}' is {kind}, which has no zero to move",
                key.span,
                hint="change its pose: xyz and rpy",
                trace=trace,
            )
        axis = _axis_of(joint)
        if axis == ZERO:
            return  # the checks report it
        moved = unit_vector(axis)
        turn = (
            Pose(position=_scaled(moved, zero))
            if kind == PRISMATIC
            else Pose(rotation_about(moved, zero))
        )
        self._move(joint, turn, span)
        for thing in RECORDS:
            child = next((each for each in joint.elements() if each.name == thing), None)
            if child is not None:
                self._count_from(joint, child, zero, span)
        self._count_others(joint, name, zero, span)

    def _count_from(self, joint: Element, child: Element, zero: float, span: Span) -> None:
        """Subtract a zero from the positions in a child of a joint, also from those left out."""
        values: Values = {}
        is_free = child.name == "limit" and self.lowering.joint_type == CONTINUOUS
        for name, field in ELEMENTS[child.name].fields.items():
            is_meant = field.default is not None and not is_free
            if field.kind == "position" and (name in child.attributes or is_meant):
                number = _number(child.attributes.get(name, "0"))
                if number is not None:
                    values[name] = Numbers.of(number - zero), span
        if values:
            self._set_child(joint, child.name, values, span)

    def _count_others(self, joint: Element, name: str, zero: float, span: Span) -> None:
        """Let joints that follow one whose zero moves stay where they are, and states too.

        A follower is at m·q + b = m·(q' + zero) + b.
        """
        for index, other in enumerate(self.robot.children):
            if not isinstance(other, Element):
                continue
            if isinstance(other, RobotNote) and other.name == "state":
                changed = _own(other)
                for number, each in enumerate(changed.children):
                    if isinstance(each, Element) and each.attributes.get("joint") == name:
                        value = _number(each.attributes.get("value"))
                        if value is not None:
                            moved = _own(each)
                            moved.attributes.pop("written", None)
                            self._set(moved, {"value": (format_value(value - zero), span)})
                            changed.children[number] = moved
                self.robot.children[index] = changed
                continue
            mimic = next((each for each in other.elements() if each.name == "mimic"), None)
            if other.name != "joint" or mimic is None or other.attributes.get("name") == name:
                continue
            if format_value(mimic.attributes.get("joint")) != name:
                continue
            factor = _number(mimic.attributes.get("multiplier", "1"))
            offset = _number(mimic.attributes.get("offset", "0"))
            if factor is not None and offset is not None:
                follower = _own(other)
                added = {"offset": (Numbers.of(offset + factor * zero), span)}
                self._set_child(follower, "mimic", added, span)  # type: ignore[arg-type]
                self.robot.children[index] = follower

    # --- a link ---

    def _change_link(self, link: Element, key: Element) -> Element:
        keys = self._entries(key, LINK_KEYS)
        if "inertial" in keys:
            inner = self._entries(keys.pop("inertial"), INERTIAL_KEYS)
            for name in inner:
                if name in keys:
                    first, second = sorted(
                        (keys[name], inner[name]), key=lambda each: each.span.start
                    )
                    raise given_twice(
                        f"'{name}' of '{key.name}' is given twice",
                        second.span,
                        first.span,
                        trace=self.lowering.trace,
                    )
            keys |= inner
        if not keys:
            return link
        link = _own(link)
        inertial, _ = _child(link, "inertial", next(iter(keys.values())).span)
        for name in POSE:
            if name in keys:
                self._attempt(self._set_row, inertial, keys[name])
        if "mass" in keys:
            has_inertia = "inertia" in keys
            self._attempt(self._set_mass, inertial, keys["mass"], has_inertia, key.name)
        if "inertia" in keys:
            self._attempt(self._set_inertia, inertial, keys["inertia"])
        return link

    def _set_inertia(self, inertial: Element, key: Element) -> None:
        self._set_child(inertial, "inertia", self._moments(key), key.span)

    def _set_mass(self, inertial: Element, key: Element, has_inertia: bool, link: str) -> None:
        value, span = read_value(key)
        trace = self.lowering.trace
        numbers = read_numbers(self.lowering, value, span, count=1, name="mass", trace=trace)
        mass = next((each for each in inertial.elements() if each.name == "mass"), None)
        before = None if mass is None else _number(mass.attributes.get("value"))
        self._set_child(inertial, "mass", {"value": (numbers, span)}, key.span)
        if has_inertia or not before or not any(e.name == "inertia" for e in inertial.elements()):
            return
        factor = numbers.values[0] / before
        if abs(factor - 1) > 1e-9:
            self.lowering.advice.append(
                Diagnostic(
                    "overlay-inertia",
                    f"the mass of '{link}' is {factor:.4g} times what it was, and its inertia is "
                    "as it was",
                    span,
                    hint=f"give the inertia too; that of the same shape is {factor:.4g} times as "
                    "large",
                    severity=WARNING,
                    trace=trace,
                )
            )

    def _moments(self, key: Element) -> Values:
        """Return the moments that an `inertia` gives: six numbers, or some of them by name."""
        record = read_record(self.lowering, key, "row")
        if "row" in record.values:
            span = record.span("row")
            numbers = read_numbers(
                self.lowering,
                record.values["row"],
                span,
                count=6,
                name="inertia",
                trace=self.lowering.trace,
            )
            return {
                name: (moment, span)
                for name, moment in zip(MOMENTS, numbers.one_by_one(), strict=True)
            }
        for entry in key.elements():
            if entry.name not in MOMENTS:
                self._refuse_entry(key, entry, MOMENTS)
        return {
            name: (
                read_attribute(self.lowering, record, name, count=1, name=name, kind="inertia"),
                record.span(name),
            )
            for name in record.values
        }

    # --- values with both their places ---

    def _set(self, element: Element, values: Values) -> None:
        """Change attributes of an element that is ours, with both places of each."""
        spans = {name: element.value_span(name) for name in element.attributes}
        for name, (value, span) in values.items():
            before, place = element.attributes.get(name), spans.get(name, element.span)
            element.attributes[name] = value
            if before is None:
                if isinstance(place, OverlaidSpan):  # of an element that is new
                    place = place.replaced or place
                note = f"it was not given before, in what is at {place.place()}"
            else:
                if isinstance(place, OverlaidSpan) and place.replaced is None:
                    place = Span(place.source, place.start, place.end)
                self._note_again(name, place, span)
                note = f"it takes the place of {format_value(before)}, at {place.place()}"
            spans[name] = OverlaidSpan(span, note, place)
        element.value_spans = spans

    def _note_again(self, name: str, before: Span, span: Span) -> None:
        """Advise of a value that an overlay before has changed."""
        is_changed = isinstance(before, OverlaidSpan) and before.replaced is not None
        if is_changed and before.source is not span.source:
            self.lowering.advice.append(
                Diagnostic(
                    "overlay-again",
                    f"'{name}' was changed by '{before.source.name}' before; this later overlay "
                    "counts",
                    span,
                    hint="remove one of the two, or give the overlays in the other order",
                    severity=WARNING,
                    trace=self.lowering.trace,
                )
            )

    def _set_child(self, owner: Element, name: str, values: Values, span: Span) -> Element:
        """Change attributes of a child of an element that is ours; return the child."""
        child, before = _child(owner, name, span)
        self._set(child, values)
        if before is not None and values:
            changed, (_, place) = next(iter(values.items()))
            note = f"'{changed}' beside it is changed at {place.place()}"
            spans = child.value_spans
            assert isinstance(spans, dict)
            for each, known in spans.items():
                if each not in values and not isinstance(known, OverlaidSpan):
                    spans[each] = OverlaidSpan(known, note)
            if not isinstance(before.span, OverlaidSpan) or before.span.source is not span.source:
                child.span = _overlaid_key(span, before)
        return child

    def _move(self, joint: Element, motion: Pose, span: Span) -> None:
        """Compose the pose of a joint with a motion in its own frame."""
        pose = pose_of(joint)
        origin = origin_of(joint)
        quaternion = None if origin is None else origin.attributes.get("quat_xyzw")
        if quaternion is not None:
            try:
                x, y, z, w = map(float, format_value(quaternion).split())
            except ValueError:
                return  # the checks report it
            pose = Pose(rotation_from_quaternion(x, y, z, w), pose.position)
        pose = pose @ motion
        values: Values = {}
        for name, row in (("xyz", pose.position), ("rpy", pose.rpy)):
            values[name] = Numbers(tuple(map(format_component, row)), tuple(row)), span
        origin = self._set_child(joint, "origin", values, span)
        origin.attributes.pop("quat_xyzw", None)


# --- elements --------------------------------------------------------------------------------


def _own(element: Element) -> Element:
    """Return a copy that may be changed; what is in it is shared."""
    copy = element.with_children(list(element.children))
    copy.attributes = dict(element.attributes)
    return copy


def _child(owner: Element, name: str, span: Span) -> tuple[Element, Element | None]:
    """Return a child of an element that is ours, as one that is ours too, and what it was."""
    for index, child in enumerate(owner.children):
        if isinstance(child, Element) and child.name == name:
            copy = owner.children[index] = _own(child)
            return copy, child
    note = f"<{owner.name}> had no <{name}> before, at {owner.span.place()}"
    made = Element(name, OverlaidSpan(span, note, owner.span), trace=owner.trace)
    if name in ("origin", "inertial"):
        owner.children.insert(0, made)
    else:
        owner.children.append(made)
    return made, None


def _overlaid_key(span: Span, before: Element) -> Span:
    return OverlaidSpan(span, f"it changes what is at {before.span.place()}", before.span)


def _axis_of(joint: Element) -> tuple[float, float, float]:
    axis = next((each for each in joint.elements() if each.name == "axis"), None)
    words = "1 0 0" if axis is None else format_value(axis.attributes.get("xyz", "1 0 0"))
    try:
        x, y, z = map(float, words.split())
    except ValueError:
        return ZERO
    return x, y, z


def _scaled(vector: tuple[float, float, float], factor: float) -> tuple[float, float, float]:
    x, y, z = vector
    return factor * x, factor * y, factor * z


def _number(value: object) -> float | None:
    try:
        return float(format_value(value))
    except ValueError:
        return None
