"""Parts of one form and equal values: what they have in common is lowered once.

Most parts that a loop or a function makes differ in their name, their parent and their pose alone.
Where all else has the same values as in a part that was lowered before, and nothing was reported of
that one, its joint and link are taken over with what is the part's own put in, and have the memos
of that joint and link. Any other part is lowered separately.
"""

from __future__ import annotations

from operator import itemgetter

from ..diagnostics import YamaroError
from ..xml.forms import Form, filled, key_of
from ..xml.tree import Element, Text, inheriting
from .fields import POSE_ROWS
from .notes import JOINT_WORDS, LINK_WORDS
from .pose import origin_element, pose_of_values

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from ..source import Span
    from ..xml.forms import FormText
    from ..xml.tree import Node, PartElement
    from .lowering import Lowering
    from .naming import Naming

MAX_KNOWN = 64
"""How many parts of one form are kept to take over from, and how many origins."""

OWN_CHILDREN = 3
"""The first children of a joint, which are its own: parent, child and origin."""


OwnKey = tuple["FormText", "Span", "Span"]
"""A key with a value of its own in each part: the text, the place of the key, and of the value."""


class LoweredPart:
    """A part that was lowered, to take over from.

    Attributes:
        joint: its joint.
        parent: the joint's parent.
        child: the joint's child.
        rest: what is in the joint after parent, child and origin.
        has_mimic: whether a mimic is among it.
        link: its link.
    """

    __slots__ = ("child", "has_mimic", "joint", "link", "parent", "rest")

    def __init__(self, joint: Element, link: Element, *, has_mimic: bool) -> None:
        """Hold a joint and a link of which nothing was reported."""
        parent, child = joint.children[:2]
        assert isinstance(parent, Element)
        assert isinstance(child, Element)
        self.joint = joint
        self.parent = parent
        self.child = child
        self.rest = joint.children[OWN_CHILDREN:]
        self.has_mimic = has_mimic
        self.link = link


class Pattern:
    """How to lower the parts of one form.

    Attributes:
        name: the text of the part's name.
        parent: the `parent` key.
        pose: the keys of the pose, by name.
        pose_of: takes the values in these out of those of the part.
        common_of: takes out all values but those in the name, the parent and the pose.
        is_joint_first: whether the joint is before the link.
        lowered: parts that were lowered, by the values of the common holes.
        origins: the origins of the joints, by the values of the pose.
    """

    __slots__ = (
        "common_of",
        "is_joint_first",
        "lowered",
        "name",
        "origins",
        "parent",
        "pose",
        "pose_of",
    )

    def __init__(self, reader: _Reader) -> None:
        self.name = reader.name
        self.parent = reader.keys.pop("parent")
        self.pose = {name: reader.keys[name] for name in POSE_ROWS if name in reader.keys}
        self.pose_of = _taker(reader.pose_holes)
        self.common_of = _taker(reader.common_holes)
        self.is_joint_first = reader.is_joint_first
        self.lowered: dict[object, LoweredPart] = {}
        self.origins: dict[object, Element] = {}


# --- reading a form ---------------------------------------------------------------------------


class _Unusual(Exception):
    """The form is not that of a part with a name, a joint and a link, written as most are."""


class _Reader:
    """Reads what a form says about name, joint and link."""

    def __init__(self, form: Form) -> None:
        self.name: FormText = ""
        self.keys: dict[str, OwnKey] = {}
        self.pose_holes: list[int] = []
        self.common_holes: list[int] = []
        seen: list[str] = []
        for node, inner, first, end, _, _ in form.content:
            key = _plain_key(node, inner)
            if key in seen:
                raise _Unusual
            seen.append(key)
            if key == "name":
                self.name = _own_key(node, inner, first)[0]
            elif key == "joint" and inner is not None and not inner.attributes:
                self._read_joint(inner, first)
            elif key == "link" and not (inner.attributes if inner else node.attributes):  # type: ignore[union-attr]
                _refuse_words(node, inner)
                self.common_holes += range(first, end)
            else:
                raise _Unusual
        if len(seen) != 3 or "parent" not in self.keys:
            raise _Unusual
        self.is_joint_first = seen.index("joint") < seen.index("link")

    def _read_joint(self, form: Form, start: int) -> None:
        seen: set[str] = set()
        for node, inner, first, end, _, _ in form.content:
            key = _plain_key(node, inner)
            if key in seen or key == "origin" or key in JOINT_WORDS:
                raise _Unusual
            seen.add(key)
            holes = range(start + first, start + end)
            if key == "parent" or key in POSE_ROWS:
                self.keys[key] = _own_key(node, inner, start + first)
                if key in POSE_ROWS:
                    self.pose_holes += holes
            else:
                self.common_holes += holes


def _refuse_words(node: Node | None, form: Form | None) -> None:
    """Raise _Unusual if a link holds a word that is worked out beside it."""
    children = form.content if form is not None else ()
    names = {each.name for each, inner, *_ in children if isinstance(each, Element)}
    names |= {inner.name for _, inner, *_ in children if inner is not None}
    if isinstance(node, Element):
        names |= {each.name for each in node.elements()}
    if not LINK_WORDS.isdisjoint(names):
        raise _Unusual


def _plain_key(node: Node | None, form: Form | None) -> str:
    """Return the name of a key; raise _Unusual if it is anything else, or in angle brackets."""
    key = node if form is None else form
    if not isinstance(key, (Element, Form)) or key.verbatim:
        raise _Unusual
    return key.name


def _own_key(node: Node | None, form: Form | None, first: int) -> OwnKey:
    """Return a key that holds a text and nothing else, with its holes numbered in the whole."""
    if form is not None:
        if form.text is None:
            raise _Unusual
        text, span = form.text
        return _shifted(text, first), form.span, span
    if not isinstance(node, Element) or node.attributes or len(node.children) != 1:
        raise _Unusual
    only = node.children[0]
    if not isinstance(only, Text) or not isinstance(only.value, str):
        raise _Unusual
    return only.value, node.span, only.span


def _shifted(text: FormText, by: int) -> FormText:
    """Return a text whose holes have higher numbers."""
    if isinstance(text, str):
        return text
    if isinstance(text, int):
        return text + by
    return tuple([piece if isinstance(piece, str) else piece + by for piece in text])


def _taker(holes: list[int]) -> Callable[[tuple[Any, ...]], tuple[Any, ...]]:
    """Return a function that takes the values of some holes out of all values."""
    if len(holes) > 1:
        return itemgetter(*holes)
    return itemgetter(slice(holes[0], holes[0] + 1) if holes else slice(0))


# --- lowering by a pattern --------------------------------------------------------------------


def take_over(lowering: Lowering, part: PartElement, out: list[Node]) -> bool:
    """Append the joint and link of a part made after one that was lowered before.

    Returns:
        Whether there is one, and the part has no fault.
    """
    form = part.form
    assert form is not None
    pattern = lowering.patterns.get(form)
    if pattern is None:
        return False
    common = key_of(pattern.common_of(part.values))
    known = pattern.lowered.get(common)
    if known is None:
        return False
    trace = part.trace_within(lowering.trace)
    values = part.values
    parent = filled(pattern.parent[0], values)
    if type(parent) is not str:
        return False
    parent = parent.strip()
    naming = lowering.namings.get(part.span.source) if lowering.namings else None
    names = _names(filled(pattern.name, values), naming)
    if names is None or not parent:
        return False
    origin = _origin(lowering, pattern, known.joint, values)
    if origin is None:
        return False
    joint_name, link_name, part_name = names
    if part_name:
        lowering.part_links.setdefault(part_name, link_name)
        lowering.part_joints.setdefault(part_name, joint_name)
    above, below = known.parent, known.child
    children: list[Node] = [
        inheriting("parent", above.span, {"link": parent}, _NOTHING, above.value_spans),
        inheriting("child", below.span, {"link": link_name}, _NOTHING, below.value_spans),
        origin,
        *known.rest,
    ]
    before = known.joint
    joint = before.like({**before.attributes, "name": joint_name}, children, trace)
    link = known.link.like({"name": link_name}, known.link.children, trace)
    out += (joint, link) if pattern.is_joint_first else (link, joint)
    lowering.parents.append(joint)
    if known.has_mimic:
        lowering.mimics.append(joint)
    return True


def lower_formed(
    lowering: Lowering,
    part: PartElement,
    out: list[Node],
    lower: Callable[[Lowering, Element, list[Node]], None],
) -> None:
    """Append the joint and link of a part by `lower`, and keep them to take over from."""
    form = part.form
    assert form is not None
    if form not in lowering.patterns:
        try:
            lowering.patterns[form] = Pattern(_Reader(form))
        except _Unusual:
            lowering.patterns[form] = None
    pattern = lowering.patterns[form]
    reported, before = lowering.reports, len(out)
    lower(lowering, part, out)
    if pattern is None or reported != lowering.reports:
        return
    if len(out) - before != 2:  # there are notes beside its joint and link
        lowering.patterns[form] = None
        return
    common = key_of(pattern.common_of(part.values))
    if common is not None and common not in pattern.lowered:
        joint, link = out[before:] if pattern.is_joint_first else reversed(out[before:])
        assert isinstance(joint, Element)
        assert isinstance(link, Element)
        if len(pattern.lowered) >= MAX_KNOWN:
            pattern.lowered.clear()
        has_mimic = bool(lowering.mimics) and lowering.mimics[-1] is joint
        pattern.lowered[common] = LoweredPart(joint, link, has_mimic=has_mimic)
        joint.share(own=OWN_CHILDREN)
        link.share(own=0)


_NOTHING: list[Node] = []
"""What a `<parent>` or `<child>` holds."""


def _names(name: object, naming: Naming | None) -> tuple[str, str, str] | None:
    """Return the names of a part's joint and link, and its own or ""; None if they are faulty."""
    if type(name) is not str:
        return None
    if not name.isidentifier():  # as most are
        words = name.replace(",", " ").split()
        if len(words) == 2:
            return words[0], words[1], ""
        if len(words) != 1:
            return None
        name = words[0]
    if naming is not None:
        return naming.joint(name), naming.link(name), name
    return f"{name}_joint", f"{name}_link", name


def _origin(
    lowering: Lowering, pattern: Pattern, joint: Element, values: tuple[Any, ...]
) -> Element | None:
    """Return the origin of a joint, or None if its pose has a fault."""
    key = key_of(pattern.pose_of(values))
    if key is None:
        return None
    origin = pattern.origins.get(key)
    if origin is not None:
        return origin.share()
    rows: dict[str, tuple[object, Span, Span]] = {}
    for name, (text, key_span, span) in pattern.pose.items():
        value = filled(text, values)
        if value == "":
            return None
        if value is not None:  # which leaves the key out
            rows[name] = value, key_span, span
    reported = lowering.reports
    try:
        origin = origin_element(pose_of_values(lowering, rows), joint)
    except YamaroError:
        return None
    if origin is None or reported != lowering.reports:
        return None
    origin = inheriting(origin.name, origin.span, origin.attributes, [], origin.value_spans)
    if len(pattern.origins) >= MAX_KNOWN:
        pattern.origins.clear()
    pattern.origins[key] = origin
    return origin
