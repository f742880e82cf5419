"""The joint of a part: its type, its parent and child, its pose, and its limits."""

from __future__ import annotations

from math import pi

from ..diagnostics import YamaroError, failure, given_twice
from ..model.joint import CONTINUOUS
from ..model.schema import (
    ELEMENTS,
    JOINT_TYPES,
    RECORDS,
    TEXT,
    joint_type_hint,
    joint_type_meant,
)
from ..xml.tree import Element
from ..xml.values import Numbers, format_value
from .fields import (
    JOINT,
    read_record,
    read_value,
    refuse_misspelt,
    sort_fields,
    with_attributes,
    word_of,
)
from .numbers import read_attribute
from .pose import origin_element, read_pose

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..diagnostics import Diagnostic
    from ..source import Span
    from ..xml.tree import Node
    from .actuator import Values
    from .fields import Fields
    from .lowering import Lowering

ASSUMED_RANGES = {
    "revolute": Numbers.of(-pi, pi).one_by_one(),
    "prismatic": Numbers.spelled(("-1", "1")).one_by_one(),
}
ASSUMED_EFFORT, ASSUMED_VELOCITY = Numbers.spelled(("100", "10")).one_by_one()


class JointType:
    """The type of a joint, and where it is written."""

    __slots__ = ("key_span", "name", "span")

    def __init__(self, name: str, span: Span, key_span: Span) -> None:
        """Hold the type, the place of its value, and that of its key."""
        self.name = name
        self.span = span
        self.key_span = key_span


def lower_joint(
    lowering: Lowering, key: Element, name: str, *, child: str, words: Sequence[Element] = ()
) -> Element:
    """Return `<joint>`: parent, child, origin, then the rest as written.

    Args:
        lowering: the run; errors are recorded there, and lowering goes on.
        key: the `joint` key.
        name: the joint's name.
        child: the name of the part's link.
        words: what is worked out beside the joint, such as an actuator.
    """
    fields = sort_fields(lowering, key, JOINT)
    children: list[Node] = []
    if fields.has_text:
        return _joint_element(key, name, None, children)
    joint_type: JointType | None = None
    try:
        joint_type = _read_type(lowering, key, fields)
    except YamaroError as error:
        lowering.absorb(error)
    lowering.joint_type = joint_type.name if joint_type is not None else None
    for make in (_parent_element, _child_element, _origin_element):
        try:
            generated = make(lowering, key, fields, child)
        except YamaroError as error:
            lowering.absorb(error)
            continue
        if generated is not None:
            children.append(generated)
    for node in fields.rest:  # what is output where it is written
        if type(node) is Element and node.name in RECORDS and not node.verbatim:
            try:
                children.append(lowering.once(node, _lower_record))
            except YamaroError as error:
                lowering.absorb(error)
        else:
            children.append(node)
    if joint_type is not None and joint_type.name in (CONTINUOUS, *ASSUMED_RANGES):
        actuators = [word for word in words if word.name == "actuator"]
        motor: Values = {}
        if actuators:
            from .actuator import limits_of_motor

            motor = limits_of_motor(lowering, actuators[-1])
        if motor or joint_type.name != CONTINUOUS:
            _complete_limit(lowering, key, name, joint_type, fields, children, motor)
    joint = _joint_element(key, name, joint_type, children)
    lowering.give_trace(joint)
    if "parent" not in fields.plain:
        lowering.parents.append(joint)
    if "mimic" in fields.keys:
        lowering.mimics.append(joint)
    return joint


def _joint_element(
    key: Element, name: str, joint_type: JointType | None, children: list[Node]
) -> Element:
    attributes: dict[str, object]
    if joint_type is None:
        attributes, spans = {"name": name}, {}
    else:
        attributes, spans = {"name": name, "type": joint_type.name}, {"type": joint_type.span}
    for attribute, value in key.attributes.items():
        attributes.setdefault(attribute, value)
        spans.setdefault(attribute, key.value_span(attribute))
    return Element("joint", key.span, attributes, children, key.trace, spans)


def _read_type(lowering: Lowering, key: Element, fields: Fields) -> JointType:
    attribute = key.attributes.get("type")
    type_key = fields.keys.get("type")
    if attribute is not None and type_key is not None:
        raise given_twice(
            "the joint's 'type' is given twice",
            type_key.span,
            key.value_span("type"),
            trace=type_key.trace,
        )
    if type_key is not None:
        value, span = read_value(type_key)
        key_span = type_key.span
    elif attribute is not None:
        value, span = attribute, key.value_span("type")
        key_span = span
    else:
        raise failure(
            "missing-type",
            "this joint has no 'type'",
            key.span,
            hint=f"write type: with one of {', '.join(JOINT_TYPES)}",
            trace=key.trace,
        )
    word = word_of("type", value, span, owner=key)
    if word in JOINT_TYPES:
        return JointType(word, span, key_span)
    from ..fixes import respelling

    raise failure(
        "joint-type",
        f"'{word}' is not a joint type",
        span,
        hint=joint_type_hint(word),
        trace=key.trace,
        fix=respelling(span, word, joint_type_meant(word), is_safe=True),
    )


def _parent_element(lowering: Lowering, key: Element, fields: Fields, child: str) -> Element:
    if "parent" in fields.plain:
        return fields.plain["parent"]
    parent_key = fields.keys.get("parent")
    if parent_key is None:
        raise failure(
            "missing-parent",
            "this joint has no 'parent'",
            key.span,
            hint="write parent: with the name of a link or of a part; a part without a joint is "
            "the root",
            trace=key.trace,
        )
    return lowering.once(parent_key, _lower_parent)


def _lower_parent(lowering: Lowering, parent_key: Element) -> Element:
    record = read_record(lowering, parent_key, "link")
    refuse_misspelt(record, ("link",))
    if "link" not in record.values:
        raise failure(
            "missing-parent",
            "the 'parent' of this joint is empty",
            parent_key.span,
            hint="write parent: with the name of a link or of a part",
            trace=parent_key.trace,
        )
    record.values["link"] = word_of(
        "parent", record.values["link"], record.span("link"), owner=parent_key
    )
    return record.element()


def _child_element(lowering: Lowering, key: Element, fields: Fields, child: str) -> Element:
    if "child" in fields.plain:
        return fields.plain["child"]
    child_key = fields.keys.get("child")
    if child_key is not None:
        raise failure(
            "child-given",
            "the child of a part's joint is the part's own link",
            child_key.span,
            hint="remove 'child'; to set the name of the link, write link/name=…",
            trace=child_key.trace,
        )
    return Element("child", key.span, {"link": child}, [], key.trace)


def _origin_element(lowering: Lowering, key: Element, fields: Fields, child: str) -> Element | None:
    return fields.plain.get("origin") or origin_element(read_pose(lowering, fields), key)


# --- axis, limit and similar elements ---------------------------------------------------------


def _lower_record(lowering: Lowering, key: Element) -> Element:
    """Return an element such as `axis` or `limit` with attributes, numbers checked."""
    thing = ELEMENTS[key.name]
    record = read_record(lowering, key, thing.scalar)
    refuse_misspelt(record, thing.fields)
    faults: list[Diagnostic] = []
    for attribute, value in record.values.items():
        field = thing.fields.get(attribute)
        label = thing.name if attribute == thing.scalar else attribute
        try:
            if field is not None and field.count != TEXT:
                lowering.has_armatures |= not field.in_urdf
                record.values[attribute] = read_attribute(
                    lowering, record, attribute, count=field.count, name=label, kind=field.kind
                )
            else:
                span = record.span(attribute)
                record.values[attribute] = word_of(label, value, span, owner=key)
        except YamaroError as error:
            faults += error.diagnostics
    if faults:
        raise YamaroError(faults)
    if thing.scalar is not None and thing.scalar not in record.values:
        raise failure(
            "empty-value",
            f"'{thing.name}' has no '{thing.scalar}'",
            key.span,
            hint="write axis: 0 0 1"
            if thing.name == "axis"
            else "write mimic: {joint: NAME, multiplier: 1}",
            trace=key.trace,
        )
    return record.element()


def _complete_limit(
    lowering: Lowering,
    key: Element,
    joint: str,
    joint_type: JointType,
    fields: Fields,
    children: list[Node],
    motor: Values,
) -> None:
    """Fill in what a limit lacks: what the motor has, and what URDF needs, with one warning.

    URDF needs limits of revolute and prismatic joints. A continuous joint without any has those of
    the motor if both are known, since URDF takes none alone.
    """
    is_needed = joint_type.name in ASSUMED_RANGES
    limit: Element | None = None
    for node in children:
        if isinstance(node, Element) and node.name == "limit":
            if node.verbatim:
                return
            limit = node
    if limit is None and "limit" in fields.keys:
        return  # it is faulty, which has been reported
    given = limit.attributes if limit is not None else {}
    assumed: dict[str, object] = {}
    if is_needed and "lower" not in given and "upper" not in given:
        assumed["lower"], assumed["upper"] = ASSUMED_RANGES[joint_type.name]
    places: dict[str, Span] = {}
    added = dict(assumed)
    for attribute, usual in (("effort", ASSUMED_EFFORT), ("velocity", ASSUMED_VELOCITY)):
        if attribute in given:
            continue
        if attribute in motor:
            added[attribute], places[attribute] = motor[attribute]
        elif is_needed:
            added[attribute] = assumed[attribute] = usual
    if not added or (limit is None and not is_needed and len(added) < 2):
        return
    if limit is not None:
        span = limit.span
        full = {**added, **given} if "lower" in added else {**given, **added}
        completed = with_attributes(limit, full)
        places |= {name: limit.value_span(name) for name in given}
        children[children.index(limit)] = completed
    else:
        span = joint_type.key_span
        completed = Element("limit", span, attributes=added, trace=key.trace)
        children.append(completed)
    if motor:
        completed.value_spans = places
    if not assumed:
        return
    filled = " ".join(f"{name}={format_value(value)}" for name, value in assumed.items())
    lowering.report(
        "assumed-limit",
        f"the {joint_type.name} joint '{joint}' needs a limit; assumed {filled}",
        span,
        hint="write limit: {lower: …, upper: …, effort: …, velocity: …} in the joint",
        trace=key.trace,
    )
