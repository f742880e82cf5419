"""The output tree: elements that remember where in the YAML they were made.

Values stay Python objects (or the text as it was spelled) until they are written.
"""

from __future__ import annotations

from ..diagnostics import INHERITED, Frame
from ..source import Public, Span
from .values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Container, Iterator
    from typing import Any, Protocol

    from .forms import Form

    class ValueSpans(Protocol):
        """Where the values of an element's attributes are written; a dict is one."""

        def get(self, attribute: str, /) -> Span | None:
            """Return the place of an attribute's value, or None where there is none."""


class Text(Public):
    """Text between tags; `value` is the spelling as written, or what an expression gave."""

    __slots__ = ("span", "value")

    def __init__(self, value: object, span: Span) -> None:
        self.value = value
        self.span = span


class Comment(Public):
    """An XML comment."""

    __slots__ = ("span", "text")

    def __init__(self, text: str, span: Span) -> None:
        """Hold the comment's text, which must not contain `--`."""
        self.text = text
        self.span = span


class Memo:
    """Notes on the elements that have it. These never change, or else in the same way.

    Elements that are equal share a `Memo`: one element that is in several places, or several that
    differ in a name and in a few children of their own only. Lowering, the checks and the writer
    note in it what they have worked out, each of them for the next time. There is nothing else by
    which they know what they have seen before, so elements without a memo are each worked out
    separately.

    Attributes:
        own: None if it is one element; else these have names of their own, and this number of their
            first children.
        lowered: what the element is lowered to.
        resolved: the element with the name that a reference in it means.
        checked: the run of the checks that found nothing wrong in it, if one did.
        written: the text of it, or of what is in it except for its own children.
        renamed: what it becomes where meshes are named in another way.
    """

    __slots__ = ("checked", "lowered", "own", "renamed", "resolved", "written")

    def __init__(self, own: int | None = None) -> None:
        """Begin with nothing worked out."""
        self.own = own
        self.lowered: Any = None
        self.resolved: Any = None
        self.checked: Any = None
        self.written: Any = None
        self.renamed: Any = None


class Element:
    """An XML element with its provenance."""

    __slots__ = (
        "attributes",
        "body",
        "children",
        "memo",
        "name",
        "span",
        "trace",
        "value_spans",
        "verbatim",
    )

    def __init__(
        self,
        name: str,
        span: Span,
        attributes: dict[str, object] | None = None,
        children: list[Node] | None = None,
        trace: Frame | None = None,
        value_spans: ValueSpans | None = None,
        verbatim: bool = False,
        body: object = None,
    ) -> None:
        """Make an element.

        Args:
            name: a checked XML name.
            span: the place of the key that made the element.
            attributes: names and values in the order of output; None values are not written.
            children: elements, text and comments in order.
            trace: the calls and includes that led here; see `trace_within`.
            value_spans: where the attributes' values are written; `span` is used for the rest.
            verbatim: written in angle brackets: plain XML, whatever its name.
            body: identity of the mapping the element's key was written in.

        Attributes:
            memo: what is worked out once for all elements that are equal to this one; None if there
                are no others.
        """
        self.name = name
        self.span = span
        self.attributes = attributes if attributes is not None else {}
        self.children = children if children is not None else []
        self.trace = trace
        self.value_spans = value_spans
        self.verbatim = verbatim
        self.body = body
        self.memo: Memo | None = None

    def with_children(self, children: list[Node]) -> Element:
        """Return the same element with other children; attributes are shared, not copied."""
        return type(self)(
            self.name,
            self.span,
            self.attributes,
            children,
            self.trace,
            self.value_spans,
            self.verbatim,
            self.body,
        )

    def trace_within(self, around: Frame | None) -> Frame | None:
        """Return the calls and includes that led to it; `around` are those of what it is in.

        An element that is in several places does not know its own: the same calls led to it as to
        the part it is in, or, outside of parts, to the child of the root that it is in.
        """
        return around if self.trace is INHERITED else self.trace

    def inherits_trace(self) -> bool:
        """Return whether the same calls led to it as to what it is in; see `trace_within`."""
        return self.trace is INHERITED

    def settled(self, around: Frame | None) -> Element:
        """Return it for a place where it can inherit no trace: itself, or a copy with a trace."""
        if self.trace is not INHERITED or around is None:
            return self
        copy = with_trace(self, around)
        copy.memo = self.memo
        return copy

    def share(self, own: int | None = None) -> Element:
        """Let it have a memo, as one that is in several places or has likes; return it."""
        if self.memo is None:
            self.memo = Memo(own)
        return self

    def like(
        self, attributes: dict[str, object], children: list[Node], trace: Frame | None
    ) -> Element:
        """Return an element of the same origin that has the same memo; see `Memo.own`."""
        alike = Element(self.name, self.span, attributes, children, trace, self.value_spans)
        alike.memo = self.memo
        return alike

    def value_span(self, attribute: str) -> Span:
        """Return where the attribute's value was written, or else the element's own place."""
        if self.value_spans is not None:
            return self.value_spans.get(attribute) or self.span
        return self.span

    def name_span(self, attribute: str) -> Span:
        """Return where the attribute's name was written, or its value where that is unknown."""
        value = self.value_span(attribute)
        text, end = value.source.text, value.start
        if self.attributes.get(attribute) == "" and text.startswith(attribute, end):
            # The place of an empty value is its name.
            return Span(value.source, end, end + len(attribute))
        while end > 0 and text[end - 1] in " \t\r\n:='\"":
            end -= 1
        if not text.endswith(attribute, 0, end):
            return value
        return Span(value.source, end - len(attribute), end)

    def elements(self) -> list[Element]:
        """Return the child elements, without text and comments."""
        return [child for child in self.children if isinstance(child, Element)]

    def iter(self, without: Container[int] = ()) -> Iterator[Element]:
        """Yield it and all elements in it, in the order of the document.

        What is done to the children of an element that was yielded is seen by the walk. Elements
        in it whose identities `without` has are left out, with all in them.
        """
        pending = [self]
        while pending:
            element = pending.pop()
            yield element
            children = element.children
            if children:
                inner = [each for each in reversed(children) if isinstance(each, Element)]
                pending += [each for each in inner if id(each) not in without] if without else inner

    def text(self) -> str:
        """Return the text children joined, as it would be written, unescaped."""
        return "".join(format_value(c.value) for c in self.children if isinstance(c, Text))

    def __repr__(self) -> str:
        return f"<Element {self.name} at {self.span.place()}>"


class PartElement(Element):
    """A `part` as evaluated, before it is lowered to a joint and a link.

    Attributes:
        form: its form, if it is of fixed shape.
        values: the value of each hole of the form.
    """

    __slots__ = ("_children", "_fill", "form", "values")

    form: Form | None
    values: tuple[Any, ...]
    _children: list[Node] | None
    _fill: Callable[[Form, tuple[Any, ...]], list[Node]]

    @classmethod
    def of_form(
        cls,
        form: Form,
        values: tuple[Any, ...],
        trace: Frame | None,
        fill: Callable[[Form, tuple[Any, ...]], list[Node]],
    ) -> PartElement:
        """Return a part of fixed shape; `fill` makes what it holds, if that is asked for."""
        part = cls.__new__(cls)
        part.name = form.name
        part.span = form.span
        part.attributes = _NO_ATTRIBUTES
        part.trace = trace
        part.value_spans = part.memo = None
        part.verbatim = False
        part.body = form.body
        part.form = form
        part.values = values
        part._fill = fill
        part._children = None
        return part

    @property
    def children(self) -> list[Node]:  # type: ignore[override]
        """The keys and elements of the part."""
        if self._children is None:
            assert self.form is not None
            self._children = self._fill(self.form, self.values)
        return self._children

    @children.setter
    def children(self, children: list[Node]) -> None:
        self._children = children
        self.form = None


class RobotWord(PartElement):
    """A robot's statement or section as evaluated, before it is lowered: `mirror`, `states`.

    Its children are its own keys, whose names are as written and not always names in XML. A
    list under a key is one `LiteralList`; an item that is a mapping or list is an element `-`. The
    last child is an element `body` if it has one: what the body made, or the file it attaches.
    """

    __slots__ = ()


class RawBlock(Element):
    """XML for one output format other than URDF, in a link, a joint or the robot.

    Its name is the format. It is taken out of the robot at the end of lowering, so that it is
    renamed with what it is in.
    """

    __slots__ = ()


class RobotNote(Element):
    """Something about a robot that is not an element of URDF, such as a sensor or a state.

    Its attributes are texts and numbers as they are read; those that name a link, a joint or a
    frame are called `link`, `joint` and `frame`, so that they are renamed with it.
    """

    __slots__ = ()


SAID = "said"
"""The `body` of an element in a block for a format which notes of the robot say as well."""
OF_ATTACHED = "attached"
"""The `body` of one that an attached robot has, which does not decide for the robot around it."""

Node = Element | Text | Comment


class IncludedRobot:
    """The `body` of what stands under the root of a robot that is included as XML or attached.

    Attributes:
        prefix: what is put before the names of its links and joints.
    """

    __slots__ = ("_inner", "prefix")

    def __init__(self, prefix: str) -> None:
        """Begin with nothing in it."""
        self.prefix = prefix
        self._inner: dict[str, IncludedRobot] = {}

    def within(self, prefix: str) -> IncludedRobot:
        """Return the same robot as part of one that has a prefix of its own; one for each."""
        if not prefix:
            return self
        inner = self._inner.get(prefix)
        if inner is None:
            inner = self._inner[prefix] = IncludedRobot(prefix + self.prefix)
        return inner


class OverlaidInclude:
    """The `body` of the word that an include with overlays leaves: what of the robot is its own.

    Attributes:
        frame: the step of the include.
        prefix: what the include has put before the names of links and joints.
    """

    __slots__ = ("frame", "prefix")

    def __init__(self, frame: Frame, prefix: str) -> None:
        self.frame = frame
        self.prefix = prefix

    def holds(self, element: Element) -> bool:
        """Return whether the include made an element of the robot."""
        step: Frame | None = element.trace
        while step is not None and step is not self.frame:
            step = step.parent
        return step is not None


_NO_ATTRIBUTES: dict[str, object] = {}


def unshared(root: Element, trace: Frame | None = None) -> Element:
    """Return a copy of a tree in which no element stands twice, each with a trace of its own.

    The copy may be changed. `trace` is that of a root which inherits its own.
    """
    top = with_trace(root, root.trace_within(trace))
    pending = [(top, top.trace)]
    while pending:
        element, inherited = pending.pop()
        element.attributes = dict(element.attributes)
        children = element.children = list(element.children)
        for index, child in enumerate(children):
            if isinstance(child, Element):
                own = child.trace_within(inherited)
                copy = children[index] = with_trace(child, own)
                begins = element is top or isinstance(child, PartElement)
                pending.append((copy, own if begins else inherited))
    return top


def inheriting(
    name: str,
    span: Span,
    attributes: dict[str, object],
    children: list[Node],
    value_spans: ValueSpans | None,
    verbatim: bool = False,
    body: object = None,
) -> Element:
    """Return an element that inherits its trace, so that it can be in several places."""
    return Element(name, span, attributes, children, INHERITED, value_spans, verbatim, body)


def with_trace(element: Element, trace: Frame | None) -> Element:
    """Return an element that is the same except for its trace; its children are shared."""
    copy = element.with_children(element.children)
    copy.trace = trace
    return copy
