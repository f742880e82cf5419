"""The keys of a part, joint, link or section: tables of them, and bodies sorted by these."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure, given_twice, suggest
from ..model.schema import ELEMENTS, RECORDS, SENSORS
from ..model.schema import SENSOR as ANY_SENSOR
from ..xml.tree import Comment, Element, RawBlock, Text
from ..xml.values import LiteralList, bad_name_character, format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Container, Sequence

    from ..fixes import Fix
    from ..source import Span
    from ..xml.tree import Node, ValueSpans
    from .lowering import Lowering


# --- which keys there are ---------------------------------------------------------------------


POSE_ROWS = ("xyz", "rpy", "quat", "pivot")
"""The keys of a pose that take numbers."""
POSE_KEYS = frozenset((*POSE_ROWS, "origin"))
SIZE_KEYS = frozenset(("scale", "radius", "length", "size"))
SHAPE_KEYS = SIZE_KEYS | {"geometry"}
MASS_KEYS = frozenset(("mass", "density"))
FIT_KEYS = frozenset(("fit", "decompose", "spheres"))
"""The keys of a collision that ask for shapes worked out from its mesh."""
LIGHTER_KEYS = frozenset(("triangles",))
"""The same of a visual."""

COMMON_ELEMENTS = frozenset(
    (
        *("gazebo", "transmission", "ros2_control", "sensor", "plugin", "material", "contact"),
        *("verbose", "self_collide", "selfCollide", "kinematic", "gravity"),
        *("visual", "collision"),
    )
)
"""Elements that URDF files hold and that are never warned of as misspelt keys."""


class PartPlace:
    """One place where keys are understood.

    Attributes:
        name: the key that opens the place.
        keys: keys meant once that are worked into generated elements.
        ordered: keys meant once that are output where they are written.
        repeated: keys that may repeat, output where they are written.
        stand_ins: generated elements that one in angle brackets replaces.
        elements: XML elements that are never taken for misspelt or misplaced keys.
        known: the keys meant once.
        all_keys: every key of the place.
        has_parts: whether parts may be in it.
        example: keys to show in a hint.
    """

    __slots__ = (
        "all_keys",
        "elements",
        "example",
        "has_parts",
        "keys",
        "known",
        "name",
        "ordered",
        "repeated",
        "stand_ins",
    )

    def __init__(
        self,
        name: str,
        *,
        keys: frozenset[str],
        example: str,
        ordered: frozenset[str] = frozenset(),
        repeated: frozenset[str] = frozenset(),
        stand_ins: frozenset[str] = frozenset(),
        elements: frozenset[str] = frozenset(),
        has_parts: bool = False,
    ) -> None:
        """Describe a place; see the class."""
        self.name = name
        self.keys = keys
        self.ordered = ordered
        self.repeated = repeated
        self.stand_ins = stand_ins
        self.elements = elements
        self.known = keys | ordered
        self.all_keys = self.known | repeated
        self.has_parts = has_parts
        self.example = example


PART = PartPlace(
    "part",
    keys=frozenset(("name",)),
    ordered=frozenset(("joint", "link")),
    elements=COMMON_ELEMENTS - {"visual", "collision"},
    has_parts=True,
    example="name: wheel",
)
JOINT = PartPlace(
    "joint",
    keys=POSE_KEYS | {"type", "parent", "child"},
    ordered=frozenset(RECORDS),
    stand_ins=frozenset(("parent", "child", "origin")),
    elements=COMMON_ELEMENTS - {"visual", "collision", "material"},
    example="type: fixed",
)
LINK = PartPlace(
    "link",
    keys=POSE_KEYS | SHAPE_KEYS,
    ordered=MASS_KEYS | {"inertial"},
    repeated=frozenset(("visual", "collision")),
    elements=COMMON_ELEMENTS - {"material"},
    example="geometry: box",
)
VISUAL = PartPlace(
    "visual",
    keys=POSE_KEYS | SHAPE_KEYS | LIGHTER_KEYS,
    ordered=frozenset(("material", "color")),
    stand_ins=frozenset(("origin", "geometry")),
    elements=COMMON_ELEMENTS - {"visual", "collision"},
    example="geometry: box",
)
COLLISION = PartPlace(
    "collision",
    keys=POSE_KEYS | SHAPE_KEYS | FIT_KEYS | {"cover"},
    ordered=frozenset(("material",)),
    stand_ins=frozenset(("origin", "geometry")),
    elements=(COMMON_ELEMENTS - {"visual", "collision"}) | {"surface"},
    example="geometry: box",
)
INERTIAL = PartPlace(
    "inertial",
    keys=POSE_KEYS | SHAPE_KEYS | MASS_KEYS | {"inertia"},
    stand_ins=frozenset(("origin", "mass", "inertia")),
    elements=COMMON_ELEMENTS - {"visual", "collision", "material"},
    example="mass: 1.0",
)

FRAME = PartPlace(
    "frame",
    keys=POSE_KEYS - {"origin"},
    elements=frozenset(),
    example="xyz: 0 0 0.1",
)

SENSOR = PartPlace(
    "sensor",
    keys=POSE_KEYS - {"origin"},
    elements=frozenset(
        ("frame", *ANY_SENSOR.fields, *(name for each in SENSORS.values() for name in each.fields))
    ),
    example="type: imu",
)

PLACES = (PART, JOINT, LINK, VISUAL, COLLISION, INERTIAL)
"""The places of a part whose keys are in one table; not those of words such as `sensor`."""

_LINK_HINT = "it belongs under 'link:'"
_JOINT_HINT = "it belongs under 'joint:'"
_SURFACE_HINT = "it belongs in 'collision:'"
_OF_SECTIONS = {
    **dict.fromkeys(("surface", *sorted(FIT_KEYS), "cover"), _SURFACE_HINT),
    **dict.fromkeys(LIGHTER_KEYS, "it belongs in 'visual:'"),
}
_OF_CONTACT = dict.fromkeys(("friction", "restitution"), "write it in 'collision:', in 'surface:'")
_OF_POSES = {
    **dict.fromkeys(("pos", "position"), "the position is 'xyz:'"),
    **dict.fromkeys(("euler", "rotation", "orientation"), "the rotation is 'rpy:', or 'quat:'"),
}
HOMES: dict[str, dict[str, str]] = {
    "part": {
        **_OF_SECTIONS,
        **_OF_POSES,
        **dict.fromkeys((*sorted(SHAPE_KEYS), "mass", "density"), _LINK_HINT),
        **dict.fromkeys(("visual", "collision", "inertial"), _LINK_HINT),
        **dict.fromkeys(("type", "parent", "child", *sorted(RECORDS)), _JOINT_HINT),
        **dict.fromkeys(sorted(POSE_KEYS), "it belongs under 'joint:' or under 'link:'"),
        "inertia": "it belongs under 'link:', in 'inertial:'",
    },
    "joint": {
        **_OF_SECTIONS,
        **_OF_POSES,
        **dict.fromkeys((*sorted(SHAPE_KEYS), "mass", "density"), _LINK_HINT),
        **dict.fromkeys(("visual", "collision", "inertial", "inertia"), _LINK_HINT),
        **dict.fromkeys(("kp", "kd", "armature", "gear", "motor"), "it belongs in 'actuator:'"),
        "frame": _LINK_HINT,
        "name": "write the name beside 'joint:', or as joint/name=…",
        "link": "'link:' belongs beside 'joint:', not in it",
        "joint": "a joint cannot contain a joint",
        **{
            name: f"it belongs in '{record}:'"
            for record in RECORDS
            for name in ELEMENTS[record].fields
            if name not in POSE_ROWS and name not in ("armature", "joint")
        },
    },
    "link": {
        **_OF_SECTIONS,
        **_OF_POSES,
        **_OF_CONTACT,
        **dict.fromkeys(("type", "parent", "child", *sorted(RECORDS)), _JOINT_HINT),
        "actuator": _JOINT_HINT,
        "name": "write the name beside 'link:', or as link/name=…",
        "material": "it belongs in 'visual:'",
        "color": "it belongs in 'visual:'",
        "texture": "it belongs in 'visual:', in 'material:'",
        "inertia": "it belongs in 'inertial:'",
        "joint": "'joint:' belongs beside 'link:', not in it",
        "link": "a link cannot contain a link",
    },
    "section": {
        **_OF_SECTIONS,
        **_OF_POSES,
        **_OF_CONTACT,
        **dict.fromkeys(("mass", "density"), "it belongs in 'link:' or in its 'inertial:'"),
        **dict.fromkeys(("type", "parent", "child", *sorted(RECORDS)), _JOINT_HINT),
        **dict.fromkeys(("visual", "collision", "inertial"), "it belongs directly in 'link:'"),
        "inertia": "it belongs in 'inertial:'",
        "material": "it belongs in 'visual:'",
        "color": "it belongs in 'visual:'",
        "texture": "it belongs in 'material:'",
        "name": "write it as an attribute: visual/name=…",
    },
}
"""Where keys belong that a place does not have, as hints, by the name of the place."""


def home_of(name: str, place_name: str) -> str | None:
    """Return where a key belongs that `place_name` does not have, as a hint, or None."""
    homes = HOMES.get(place_name) or HOMES["section"]
    return homes.get(name)


# --- sorting a body ---------------------------------------------------------------------------


class Fields:
    """The keys of a body, each with the element that counts, and all else in order.

    Attributes:
        has_text: whether a text stands where keys are meant, which has been reported.
        keys: keys meant once, the one run last; those that are output where they are written
            are in `rest` too.
        plain: elements in angle brackets that replace a generated element, by name.
        rest: what is output in order: ordered and repeated keys, elements, comments, parts.
        stray_geometry: a key that looks like a misspelt `geometry`, or None.
    """

    __slots__ = ("has_text", "keys", "plain", "rest", "stray_geometry")

    def __init__(self) -> None:
        """Start empty."""
        self.has_text = False
        self.keys: dict[str, Element] = {}
        self.plain: dict[str, Element] = {}
        self.rest: list[Node] = []
        self.stray_geometry: Element | None = None


def sort_fields(
    lowering: Lowering, owner: Element, place: PartPlace, children: Sequence[Node] | None = None
) -> Fields:
    """Sort the children of `owner` by what `place` knows; record what is wrong, and go on.

    `children` are those to sort, if not all of them.
    """
    fields = Fields()
    keys, rest, known, ordered = fields.keys, fields.rest, place.known, place.ordered
    for child in owner.children if children is None else children:
        if type(child) is Element:
            name = child.name
            if name not in known or child.verbatim:
                _sort_element(lowering, child, place, fields)
            elif len(child.children) == 1 and is_left_out(child):
                continue
            elif name in keys:
                first = keys[name]
                check_once(lowering, first, child)
                keys[name] = child  # the last one counts
                if first in rest:
                    rest.remove(first)
                    rest.append(child)
            else:
                keys[name] = child
                if name in ordered:
                    rest.append(child)
        elif isinstance(child, Text):
            fields.has_text |= _refuse_text(lowering, owner, child, place)
        elif place.has_parts or isinstance(child, (Comment, RawBlock)):
            rest.append(child)
        else:
            refuse_part(lowering, child, place.name)
    if fields.stray_geometry is not None:
        _take_stray_geometry(lowering, fields.stray_geometry, fields)
    return fields


def _take_stray_geometry(lowering: Lowering, stray: Element, fields: Fields) -> None:
    """Record that a link's `geometry` is misspelt, and read it as that: all in it needs a shape."""
    if "geometry" in fields.keys:
        _warn_of_key(lowering, stray, LINK, _GEOMETRY_MEANT)
        return
    lowering.absorb(
        failure(
            "unknown-key",
            f"'{stray.name}' is not a key of a link",
            stray.span,
            hint=f"{_GEOMETRY_MEANT} (<{stray.name}>: is always an element)",
            trace=stray.trace,
            fix=_fix_of_key(stray.span, stray.name, LINK),
        )
    )
    fields.rest.remove(stray)
    fields.keys["geometry"] = Element(
        "geometry", stray.span, stray.attributes, stray.children, stray.trace, stray.value_spans
    )


_GEOMETRY_MEANT = "did you mean 'geometry'?"


def _sort_element(lowering: Lowering, child: Element, place: PartPlace, fields: Fields) -> None:
    """Sort an element that is not a key meant once."""
    name = child.name
    if child.verbatim:
        if not place.has_parts:
            check_plain(lowering, child, place.name)
        if name in place.stand_ins:
            fields.plain[name] = child
        else:
            fields.rest.append(child)
    elif name in place.repeated:
        fields.rest.append(child)
    else:
        hint = _key_hint(lowering, name, place)
        if hint == _GEOMETRY_MEANT and place is LINK and child.children:
            fields.stray_geometry = child
        elif hint is not None:
            _warn_of_key(lowering, child, place, hint)
        if not place.has_parts:
            check_plain(lowering, child, place.name)
        fields.rest.append(child)


def is_left_out(key: Element) -> bool:
    """Return whether a key's value is None, which leaves it out as it does an attribute."""
    children = key.children
    if len(children) != 1:
        return False
    only = children[0]
    return type(only) is Text and only.value is None and not key.attributes


def check_once(lowering: Lowering, first: Element, second: Element) -> None:
    """Record an error if a key meant once is given twice in the same mapping."""
    if (
        second.body is None
        or first.body is not second.body
        or first.trace is not second.trace
        or first.span.key() == second.span.key()
    ):
        return
    lowering.absorb(
        given_twice(f"'{second.name}' is given twice", second.span, first.span, trace=second.trace)
    )


# --- plain XML --------------------------------------------------------------------------------


def check_plain(lowering: Lowering, element: Element, place_name: str | None) -> None:
    """Record what cannot be in an XML element that is passed on: lists, and parts.

    Args:
        lowering: the run.
        element: the element, looked at with all that it holds.
        place_name: where it is, or None where parts may be in it.
    """
    stack = [element]
    while stack:
        current = stack.pop()
        for child in current.children:
            if isinstance(child, Text):
                if type(child.value) is LiteralList:
                    lowering.absorb(
                        failure(
                            "list-as-text",
                            f"a list cannot be the content of <{current.name}>",
                            child.span,
                            hint="write the items as one text, such as 1 0 0, or write a list of "
                            "elements",
                            trace=current.trace,
                        )
                    )
            elif type(child) is Element:
                stack.append(child)
            elif isinstance(child, Element) and place_name is not None:
                refuse_part(lowering, child, place_name)


def refuse_part(lowering: Lowering, part: Element, place_name: str) -> None:
    """Record that a part stands inside a joint, link or section."""
    lowering.absorb(
        failure(
            "misplaced-part",
            f"a part is not allowed inside {_with_article(place_name)}",
            part.span,
            hint="write it beside the outer part, and refer to that part in 'parent'",
            trace=part.trace,
        )
    )


def _refuse_text(lowering: Lowering, owner: Element, text: Text, place: PartPlace) -> bool:
    """Record that a text stands where keys are meant; return whether it is more than space."""
    if type(text.value) is not LiteralList:
        shown = format_value(text.value).strip()
        if not shown:
            return False
        message = f"the text '{shown}' is directly in {_with_article(place.name)}"
    else:
        message = f"a list is directly in {_with_article(place.name)}"
    hint = f"'{place.name}' needs keys, such as {place.example}"
    lowering.absorb(failure("unexpected-text", message, text.span, hint=hint, trace=owner.trace))
    return True


# --- misspelt and misplaced keys --------------------------------------------------------------


def _key_hint(lowering: Lowering, name: str, place: PartPlace) -> str | None:
    """Return what to say of an element that is most likely a misspelt or misplaced key, or None."""
    if name in place.elements:
        return None
    question = (place.name, name)
    if question not in lowering.near_keys:
        hint = home_of(name, place.name)
        near = near_key(name, place.all_keys) if hint is None else None
        lowering.near_keys[question] = f"did you mean '{near}'?" if near else hint
    return lowering.near_keys[question]


def _warn_of_key(lowering: Lowering, child: Element, place: PartPlace, hint: str) -> None:
    """Warn of an element that is most likely a misspelt key, or one that belongs elsewhere."""
    name = child.name
    message = (
        f"'{name}' is not a key of {_with_article(place.name)}, "
        f"and is written as the element <{name}>"
    )
    hint = f"{hint} (<{name}>: is always an element)"
    if hint.startswith("did you mean"):
        fix = _fix_of_key(child.span, name, place)
        lowering.report("unknown-key", message, child.span, hint=hint, trace=child.trace, fix=fix)
    else:
        lowering.report("misplaced-key", message, child.span, hint=hint, trace=child.trace)


def _fix_of_key(span: Span, name: str, place: PartPlace) -> Fix | None:
    from ..fixes import respelling

    return respelling(span, name, near_key(name, place.all_keys), is_safe=True)


def near_key(name: str, keys: frozenset[str]) -> str | None:
    """Return the key that `name` is a misspelling of, or None.

    Words that differ in many letters are dismissed first, which spares most runs the import of
    the comparison.
    """
    if ":" in name or "." in name:
        return None
    letters = set(name.lower())
    likely = [k for k in keys if abs(len(k) - len(name)) <= 2 and len(letters ^ set(k)) <= 3]
    return suggest(name, likely) if likely else None


def _with_article(name: str) -> str:
    return f"an {name}" if name[0] in "aeiou" else f"a {name}"


# --- values -----------------------------------------------------------------------------------


def read_value(key: Element) -> tuple[object, Span]:
    """Return the single value of a key, and where it is written.

    Raises:
        YamaroError: the key is empty, or has elements or attributes in place of a value.
    """
    children = key.children
    if len(children) == 1 and not key.attributes:
        only = children[0]
        if type(only) is Text:
            return only.value, only.span
    texts = [child for child in key.children if isinstance(child, Text)]
    others = [child for child in key.children if isinstance(child, Element)]
    if others or key.attributes:
        span = others[0].span if others else key.span
        what = f"the element <{others[0].name}>" if others else "attributes"
        raise failure(
            "value-expected",
            f"'{key.name}' needs a value, not {what}",
            span,
            hint=f"write {key.name}: … with the value after the colon, or <{key.name}>: for XML",
            trace=key.trace,
        )
    if not texts:
        raise empty_value(key)
    return "".join(format_value(text.value) for text in texts), texts[0].span


def empty_value(key: Element) -> YamaroError:
    """Return the error that a key has no value."""
    return failure(
        "empty-value",
        f"'{key.name}' is empty",
        key.span,
        hint=f"write a value, or remove '{key.name}'",
        trace=key.trace,
    )


def word_of(key: str, value: object, span: Span, *, owner: Element) -> str:
    """Return a value that is a name or a file as text.

    Raises:
        YamaroError: it is a list, or empty.
    """
    if isinstance(value, LiteralList):
        raise failure(
            "value-expected",
            f"'{key}' needs one word, not a list",
            span,
            hint="write the word without brackets",
            trace=owner.trace,
        )
    text = format_value(value).strip()
    if not text:
        raise failure(
            "empty-value",
            f"'{key}' is empty",
            span,
            hint=f"write a value, or remove '{key}'",
            trace=owner.trace,
        )
    return text


def with_attributes(element: Element, attributes: dict[str, object]) -> Element:
    """Return the same element with other attributes; its children are shared."""
    copy = element.with_children(element.children)
    copy.attributes = attributes
    return copy


class Record:
    """An element's attributes, whether written as attributes, as a mapping, or as one value.

    Attributes:
        key: the key that gives the element its name and its place.
        values: the attributes.
        others: what else is in the element.
    """

    __slots__ = ("_spans", "key", "others", "values")

    def __init__(self, key: Element) -> None:
        """Start with the attributes that the key has itself."""
        self.key = key
        self.values: dict[str, object] = {}
        self.others: list[Node] = []
        self._spans: dict[str, Span] = {}
        if key.attributes:
            self.values = {k: v for k, v in key.attributes.items() if v is not None}

    def set(self, name: str, value: object, span: Span) -> None:
        """Set an attribute that is written at a span."""
        self.values[name] = value
        self._spans[name] = span

    def span(self, name: str) -> Span:
        """Return where the value of an attribute is written; finding out may take long."""
        return self._spans.get(name) or self.key.value_span(name)

    def places(self) -> ValueSpans | None:
        """Return where the values are written, for an element that has these attributes."""
        if not self.key.attributes:
            return self._spans
        if not self._spans and len(self.values) == len(self.key.attributes):
            return self.key.value_spans
        return {name: self.span(name) for name in self.values}

    def element(self) -> Element:
        """Return the element with these attributes that the key describes."""
        key = self.key
        return Element(key.name, key.span, self.values, self.others, key.trace, self.places())


def read_record(lowering: Lowering, key: Element, scalar: str | None) -> Record:
    """Return the attributes of an element such as `limit`, `axis`, `mimic` or `material`.

    Args:
        lowering: the run.
        key: the element: with attributes, a mapping of them as children, or both.
        scalar: the attribute that a bare value sets, if the element has one.

    Raises:
        YamaroError: a bare value where none is meant, or an attribute given twice.
    """
    record = Record(key)
    children = key.children
    if len(children) == 1 and type(children[0]) is Text:
        _read_scalar(key, children[0], scalar, record)
    elif children:
        written: dict[str, Element] = {}
        for child in children:
            if type(child) is Element and _is_attribute(child):
                if child.children and not is_left_out(child):
                    name = child.name
                    value, span = read_value(child)
                    if name in record.values:
                        if name not in written:
                            raise _attribute_twice(key, name, child.span, record)
                        check_once(lowering, written[name], child)
                    written[name] = child
                    record.set(name, value, span)
            elif isinstance(child, Text):
                _read_scalar(key, child, scalar, record)
            else:
                if isinstance(child, Element):
                    check_plain(lowering, child, key.name)
                record.others.append(child)
    return record


def refuse_misspelt(record: Record, known: Collection[str]) -> None:
    """Raise YamaroError for attributes that look like misspelt ones.

    Others are passed on, since extensions of URDF have attributes of their own.
    """
    key, found = record.key, []
    for name in record.values:
        if name in known or ":" in name or name in REPEATED_MOMENTS:
            continue
        absent = [each for each in known if each not in record.values]
        near = other_word(name, known) or suggest(name, absent) or suggest(name, known)
        if near is not None:
            span = next(
                (each.span for each in key.elements() if each.name == name),
                key.name_span(name) if name in key.attributes else record.span(name),
            )
            found += misspelt(key, span, name, near, record.values).diagnostics
    if found:
        raise YamaroError(found)


def other_word(name: str, known: Collection[str]) -> str | None:
    """Return the entry that other formats call by a name, if it is one of those known."""
    return next((word for word in _OTHER_WORDS.get(name.lower(), ()) if word in known), None)


_OTHER_WORDS = {
    **dict.fromkeys(("min", "minimum", "low"), ("lower",)),
    **dict.fromkeys(("max", "maximum", "high"), ("upper",)),
    **dict.fromkeys(("force", "torque"), ("effort",)),
    "speed": ("velocity",),
    "accel": ("acceleration",),
    **dict.fromkeys(("ratio", "mult", "factor"), ("multiplier", "gear")),
    **dict.fromkeys(("type", "mode", "interface"), ("command",)),
    **dict.fromkeys(("p", "stiffness"), ("kp",)),
    **dict.fromkeys(("d", "damping"), ("kd",)),
    **dict.fromkeys(("mu", "mu1"), ("friction",)),
    "mu2": ("friction2",),
    **dict.fromkeys(("frequency", "hz", "fps", "update_rate"), ("rate",)),
    "samples": ("rays",),
    "resolution": ("size",),
}
"""What other formats call the entries of limits, mimics, actuators, surfaces and sensors."""


def misspelt(
    key: Element, span: Span, name: str, near: str, present: Container[str]
) -> YamaroError:
    """Return the error that an entry of a key is misspelt; `present` are those beside it."""
    from ..fixes import respelling

    return failure(
        "unknown-key",
        f"'{name}' is not an entry of '{key.name}'",
        span,
        hint=f"did you mean '{near}'?",
        trace=key.trace,
        fix=None if near in present else respelling(span, name, near, is_safe=True),
    )


REPEATED_MOMENTS = ("iyx", "izx", "izy")
"""Moments that the symmetry of the matrix gives; the checks explain it."""


def _is_attribute(child: Element) -> bool:
    """Return whether a child is a key with a value, and not an XML element."""
    if child.verbatim or child.attributes:
        return False
    children = child.children
    if len(children) == 1:
        return not isinstance(children[0], Element)
    return all(not isinstance(grandchild, Element) for grandchild in children)


def _read_scalar(key: Element, text: Text, scalar: str | None, record: Record) -> None:
    value = text.value
    if value is None or (type(value) is str and not value):
        return
    if isinstance(value, dict):  # that an expression gave: `limit: $(limits['knee'])`
        for name, item in value.items():
            if not isinstance(name, str) or bad_name_character(name) is not None:
                raise failure(
                    "bad-name",
                    f"{name!r} in the mapping given to '{key.name}' cannot name an attribute",
                    text.span,
                    hint="the mapping's keys become attributes: {'lower': -1, 'upper': 1}",
                    trace=key.trace,
                )
            if name in record.values:
                raise _attribute_twice(key, name, text.span, record)
            if item is not None:
                record.set(name, item, text.span)
        return
    if scalar is None:
        raise failure(
            "attributes-expected",
            f"'{key.name}' needs attributes, not a value",
            text.span,
            hint=f"write {_RECORD_EXAMPLES[key.name]}" if key.name in _RECORD_EXAMPLES else None,
            trace=key.trace,
        )
    if scalar in record.values:
        raise _attribute_twice(key, scalar, text.span, record)
    record.set(scalar, value, text.span)


_RECORD_EXAMPLES = {
    "limit": "limit: {lower: -1, upper: 1, effort: 10, velocity: 2}",
    "dynamics": "dynamics: {damping: 0.1, friction: 0.2}",
    "safety_controller": "safety_controller: {k_velocity: 10}",
    "calibration": "calibration: {rising: 0.0}",
    "origin": "xyz: 0 0 0 and rpy: 0 0 0 instead of 'origin', or origin: none",
}


def _attribute_twice(key: Element, name: str, span: Span, record: Record) -> YamaroError:
    return given_twice(
        f"'{name}' of '{key.name}' is given twice", span, record.span(name), trace=key.trace
    )
