"""Reads YAML text into nodes that keep repeated keys, spelling, style and place.

Scalars are typed later, by `type_plain`.
"""

from __future__ import annotations

import sys

from ..diagnostics import Reporter, YamaroError, did_you_mean, failure
from ..policy import Limits
from ..source import Source, Span
from .libyaml import (
    AliasEvent,
    DeepParser,
    DocumentStartEvent,
    MappingEndEvent,
    MappingStartEvent,
    Parser,
    ScalarEvent,
    SequenceEndEvent,
    SequenceStartEvent,
    StreamEndEvent,
    YAMLError,
    is_nested_too_deep,
)
from .nodes import PLAIN, MappingNode, ScalarNode, SequenceNode, is_null, quoted

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ..diagnostics import Diagnostic
    from .nodes import YamlNode


def read(
    source: Source,
    *,
    reporter: Reporter,
    limits: Limits | None = None,
    units: bool = False,
) -> YamlNode:
    """Return the root node of a source's one document.

    Args:
        source: the text.
        reporter: takes the warnings.
        limits: how deep it may be, and how far its aliases expand; the usual ones if left out.
        units: convert numbers that have a tag of `UNITS`.

    Raises:
        YamaroError: the text is not YAML, is empty, holds several documents, custom tags, or
            aliases that refer to themselves or expand without measure.
    """
    _refuse_characters(source)
    root = NodeBuilder(source, limits or Limits(), units=units).build()
    if root is None or _is_nothing(root):
        raise _empty(source)
    _warn_of_comments(source, root, reporter)
    return root


def _refuse_characters(source: Source) -> None:
    """Raise YamaroError if the text holds a character that YAML forbids."""
    if source.text.isascii() and "\x00" not in source.text and "\x7f" not in source.text:
        return  # libyaml names the other control characters
    from .recovery import refuse_characters

    refuse_characters(source)


class Reading:
    """What could be read of a text.

    Attributes:
        root: the root node, or None if there is none.
        errors: what is not YAML, or has no meaning here, in order.
        hidden: the stretches that were left out because of that, in order.
        text: the text as it was read at last, with blanks in place of what was left out.
    """

    __slots__ = ("errors", "hidden", "root", "text")

    def __init__(
        self, root: YamlNode | None, errors: list[Diagnostic], hidden: list[Span], text: str
    ) -> None:
        self.root = root
        self.errors = errors
        self.hidden = hidden
        self.text = text


def read_on(source: Source, *, reporter: Reporter, limits: Limits | None = None) -> Reading:
    """Return what can be read of a source; a fault in it hides the lines around it, and no more.

    Args:
        source: the text.
        reporter: takes the warnings.
        limits: how deep it may be, and how far its aliases expand; the usual ones if left out.
    """
    limits = limits or Limits()
    errors: list[Diagnostic] = []
    builder = NodeBuilder(source, limits, errors=errors)
    try:
        _refuse_characters(source)
        root = builder.build()
        hidden = [node.span() for node in builder.absent]
        reading = Reading(root, errors, hidden, source.text)
    except YamaroError as error:
        from .recovery import Recovery

        reading = Recovery(source, limits).run(error.diagnostics[0], builder)
    if reading.root is not None and not _is_nothing(reading.root):
        _warn_of_comments(source, reading.root, reporter)
        return reading
    reading.root = None
    if not reading.errors:
        reading.errors = _empty(source).diagnostics
    return reading


def _empty(source: Source) -> YamaroError:
    return failure(
        "empty-file",
        "the file is empty",
        Span(source, 0, 0),
        hint="write sections such as `variables:` and `model:`",
    )


def _is_nothing(node: YamlNode) -> bool:
    return isinstance(node, ScalarNode) and node.style == PLAIN and is_null(node.text)


def read_fragment(scalar: ScalarNode, start: int, end: int) -> YamlNode:
    """Return the node that `scalar.text[start:end]` is when read as YAML of its own.

    It begins with a quote or a bracket.

    Raises:
        YamaroError: the fragment is not YAML.
    """
    fragment = Source(scalar.text[start:end], name=scalar.source.name, path=scalar.source.path)
    places = [scalar.offset(index) for index in range(start, end)]
    places.append(places[-1] + 1)
    try:
        _refuse_characters(fragment)
    except YamaroError as error:
        for diagnostic in error.diagnostics:
            at = places[diagnostic.span.start]
            diagnostic.span = Span(scalar.source, at, at + 1)
        raise
    root = NodeBuilder(fragment, Limits(), owner=scalar.source, places=places).build()
    assert root is not None, "it begins with a quote or a bracket"
    return root


def _warn_of_comments(source: Source, root: YamlNode, reporter: Reporter) -> None:
    """Warn of comment lines that look like a `<#text>:` or `<#comment>:` entry."""
    text = source.text
    scalars: list[tuple[int, int]] | None = None
    for word in ("#text:", "#comment:"):
        at = text.find(word)
        while at >= 0:
            _, column = source.location(at)
            if not text[at - column + 1 : at].strip(" -"):
                scalars = scalars or _places_of_scalars(root)
                from bisect import bisect_right

                index = bisect_right(scalars, (at, sys.maxsize)) - 1
                if index < 0 or at >= scalars[index][1]:
                    from ..fixes import replacement

                    span, entry = Span(source, at, at + len(word)), f"<{word[:-1]}>:"
                    reporter.report(
                        "comment-entry",
                        f"'{word}' is a YAML comment here, so this line has no effect",
                        span,
                        hint=f"write {entry} or quote the key",
                        fix=replacement(span, entry),
                    )
            at = text.find(word, at + 1)


def _places_of_scalars(root: YamlNode) -> list[tuple[int, int]]:
    """Return start and end of each scalar, in order."""
    places: list[tuple[int, int]] = []
    pending: list[Any] = [root]
    seen: set[int] = set()
    while pending:
        node = pending.pop()
        if isinstance(node, ScalarNode):
            places.append((node.start, node.end))
        elif id(node) not in seen:
            seen.add(id(node))
            pending.extend(children_of(node))
    return sorted(places)


# --- builder ----------------------------------------------------------------------------------


UNITS = {
    "!radians": 1.0,
    "!degrees": 0.017453292519943295,
    "!meters": 1.0,
    "!millimeters": 0.001,
    "!foot": 0.3048,
    "!inches": 0.0254,
}
"""Tags of numbers in data, as xacro knows them, and what one is in radians or metres."""


class NodeBuilder:
    """Turns events into nodes, with an explicit stack so that depth costs no recursion."""

    def __init__(
        self,
        source: Source,
        limits: Limits,
        *,
        owner: Source | None = None,
        places: list[int] | None = None,
        units: bool = False,
        text: str | None = None,
        errors: list[Diagnostic] | None = None,
    ) -> None:
        """Read `source`.

        Args:
            source: what to read.
            limits: how deep it may be, and how far its aliases expand.
            owner: for a fragment, the source it is in.
            places: for a fragment, the offsets of its characters in `owner`.
            units: convert numbers that have a tag of `UNITS`.
            text: what to read in place of the source's text; as long, with some of it hidden.
            errors: takes the errors behind which reading can go on; without it they are raised.
        """
        self.units = units
        self.text = source.text if text is None else text
        self.errors = errors
        self.limits = limits
        self.source = owner or source
        self.places = places
        self._begin()

    def _begin(self) -> None:
        self.absent: list[YamlNode] = []  # placeholders of nodes that could not be read
        self.open_flow: Any = None  # the outermost `[…]` or `{…}` that is open
        self.documents = 0
        self.anchors: dict[str, YamlNode] = {}
        self.open_anchors: dict[str, object] = {}
        self.stack: list[tuple[Any, Any]] = []
        self.merging: list[tuple[MappingNode, int, bool]] = []  # mapping, pair, was it an alias
        self.aliased = 0
        self.is_full = False  # whether aliases have expanded beyond the limit
        self.sizes: dict[int, int] = {}

    def build(self) -> YamlNode | None:
        """Return the document's root, or None if there is none or its aliases expand too far."""
        count = len(self.errors or ())
        try:
            try:
                return self._parse(Parser(self.text))
            except YAMLError as error:
                if not is_nested_too_deep(error):
                    raise
                if self.errors is not None:
                    del self.errors[count:]
                self._begin()
                return self._parse(DeepParser(self.text))
        except YAMLError as error:
            from .explanations import refuse_yaml

            refuse_yaml(error, self)

    def _parse(self, parser: Any) -> YamlNode | None:
        try:
            root = self._build(parser)
            return None if self.is_full else root  # what is below the limit takes long, too
        finally:
            parser.dispose()

    def place(self, offset: int) -> int:
        """Return the offset in the owning source of an offset in the text that is read."""
        if self.places is None:
            return offset
        return self.places[min(offset, len(self.places) - 1)]

    def span(self, start: int, end: int) -> Span:
        """Return the span of a stretch of the text that is read."""
        first = self.place(start)
        return Span(self.source, first, max(first, self.place(end)))

    def _build(self, parser: Any) -> YamlNode | None:
        stack = self.stack
        top = SequenceNode(self.source, 0, 0, is_flow=False)
        container: Any = top  # the innermost open collection
        key: Any = None  # its key that waits for a value, if it is a mapping
        source, is_fragment = self.source, self.places is not None
        end = 0  # of what was read last, which is where a block collection ends
        get_event = parser.get_event
        while True:
            event = get_event()
            kind = type(event)
            if kind is ScalarEvent:
                start, end = event.start_mark.index, event.end_mark.index
                if is_fragment or event.anchor is not None or event.tag is not None:
                    node: Any = self._scalar(event)
                else:  # as `_scalar` would; nearly all of a file is read here
                    node = ScalarNode(event.value, event.style or "", source, start, end)
            elif kind is MappingStartEvent or kind is SequenceStartEvent:
                stack.append((container, key))
                container, key = self._open(event, kind), None
                continue
            elif kind is MappingEndEvent or kind is SequenceEndEvent:
                node = container
                end = self._close(node, event, end)
                container, key = stack.pop()
            elif kind is AliasEvent:
                node, end = self._alias(event), event.end_mark.index
            elif kind is StreamEndEvent or event is None or self._is_second_document(event):
                return top.items[0] if top.items else None
            else:
                continue
            if key is not None:
                if key.text == "<<" and key.style == "":
                    self.merging.append((container, len(container.pairs), kind is AliasEvent))
                container.pairs.append((key, node))
                key = None
            elif type(container) is MappingNode:
                key = node if type(node) is ScalarNode else self._refuse_key(node)
            else:
                container.items.append(node)

    def _scalar(self, event: Any) -> ScalarNode:
        start, end = event.start_mark.index, event.end_mark.index
        anchor = event.anchor
        tag = event.tag
        is_refused = False
        if anchor is not None or tag is not None:
            is_refused = tag is not None and (not self.units or tag not in UNITS)
            if is_refused:
                self._refuse_tag(event)
            elif tag is not None:
                event.value, event.style = self._converted(event), ""
            start = min(self._after_properties(start), end)  # behind an empty scalar is the next
        if self.places is not None:
            end = self.place(end - 1) + 1 if end > start else self.place(start)
            start = self.place(start)
        node = ScalarNode(event.value, event.style or "", self.source, start, end, anchor)
        if anchor is not None:
            self.anchors[anchor] = node
        if is_refused:
            self.absent.append(node)
        return node

    def _open(self, event: Any, kind: Any) -> MappingNode | SequenceNode:
        if len(self.stack) > self.limits.yaml_depth:
            raise failure(
                "too-deep",
                f"lists and mappings are nested more than {self.limits.yaml_depth} deep",
                self.span(event.start_mark.index, event.end_mark.index),
                hint="split the file with functions or `include`; "
                "--limit yaml-depth=… sets another limit",
            )
        if event.tag is not None:
            self._refuse_tag(event)
        make = MappingNode if kind is MappingStartEvent else SequenceNode
        start = event.start_mark.index
        if event.anchor is not None or event.tag is not None:
            start = self._after_properties(start)
        start = self.place(start)
        node = make(self.source, start, start, bool(event.flow_style))
        if event.anchor is not None:
            self.open_anchors[event.anchor] = node
        if node.is_flow and self.open_flow is None:
            self.open_flow = node
        return node

    def _close(self, node: Any, event: Any, end: int) -> int:
        """Complete a collection whose last node ends at `end`; return where it ends itself."""
        if self.merging and self.merging[-1][0] is node:
            self._merge(node)
        if node.is_flow:
            end = event.end_mark.index
        node.end = self.place(end)
        if self.open_anchors:
            for name, opened in list(self.open_anchors.items()):
                if opened is node:
                    del self.open_anchors[name]
                    self.anchors[name] = opened
        if node is self.open_flow:
            self.open_flow = None
        return end

    def _after_properties(self, start: int) -> int:
        """Return where a node's own text begins, after its anchor and comments."""
        text = self.text
        while start < len(text) and text[start] in "&!":
            start += 1
            while start < len(text) and (
                (text[start].isascii() and text[start].isalnum()) or text[start] in "_-"
            ):
                start += 1
            while start < len(text) and (text[start].isspace() or text[start] == "#"):
                start += 1
                if text[start - 1] == "#":
                    while start < len(text) and text[start] not in "\r\n":
                        start += 1
        return start

    def _alias(self, event: Any) -> YamlNode:
        span = self.span(event.start_mark.index, event.end_mark.index)
        name = event.anchor
        if name in self.open_anchors:
            return self._absence(
                "alias-cycle",
                f"the alias '*{name}' refers to itself: it is inside the node it names",
                span,
                hint="an alias can only repeat a node that ends before it",
            )
        node = self.anchors.get(name)
        if node is None:
            return self._absence(
                "undefined-alias",
                f"the alias '*{name}' has no anchor",
                span,
                hint=did_you_mean(name, self.anchors)
                or f"a text that begins with * needs quotes: '*{name}'",
            )
        self.aliased += self._size(node)
        if self.aliased > self.limits.aliases:
            if self.is_full:
                return self._absent(span)
            self.is_full = True
            return self._absence(
                "alias-bomb",
                f"the aliases of this file expand to more than {self.limits.aliases:,} nodes",
                span,
                hint="use a function or a `for` instead of aliases of aliases; "
                "--limit aliases=… sets another limit",
            )
        return node

    def _size(self, node: YamlNode) -> int:
        """Return how many nodes are in `node`, those behind aliases included."""
        pending: list[YamlNode] = [node]
        while pending:
            current = pending[-1]
            if id(current) in self.sizes:
                pending.pop()
                continue
            children = children_of(current)
            unknown = [child for child in children if id(child) not in self.sizes]
            if unknown:
                pending.extend(unknown)
                continue
            self.sizes[id(current)] = 1 + sum(self.sizes[id(child)] for child in children)
            pending.pop()
        return self.sizes[id(node)]

    def _merge(self, mapping: MappingNode) -> None:
        """Put what the mapping's `<<` keys bring in their place."""
        at: dict[int, bool] = {}
        while self.merging and self.merging[-1][0] is mapping:
            _, index, is_alias = self.merging.pop()
            at[index] = is_alias
        own = {key.text for index, (key, _) in enumerate(mapping.pairs) if index not in at}
        spread: list[tuple[Any, Any]] = []
        for index, pair in enumerate(mapping.pairs):
            if index in at:
                spread.extend(self._merged(pair[1], own, is_alias=at[index]))
            else:
                spread.append(pair)
        mapping.pairs = spread

    def _merged(
        self, node: YamlNode, own: set[str], *, is_alias: bool
    ) -> list[tuple[ScalarNode, YamlNode]]:
        """Return what `<<: node` brings, without the keys in `own`; nothing if that is faulty."""
        if any(node is absent for absent in self.absent):
            return []
        try:
            return _merged_pairs(node, own, is_alias=is_alias)
        except YamaroError as error:
            if self.errors is None:
                raise
            self.errors.extend(error.diagnostics)
            return []

    def _converted(self, event: Any) -> str:
        """Return a number with a unit in radians or metres."""
        try:
            return repr(float(event.value) * UNITS[event.tag])
        except ValueError:
            start, end = event.start_mark.index, event.end_mark.index
            raise failure(
                "yaml-tag",
                f"'{event.value}' is not a number, which {event.tag} requires",
                Span(self.source, start, end),
                hint=f"write {event.tag} 90.0; expressions in data are not evaluated",
            ) from None

    def _refuse(self, code: str, message: str, span: Span, *, hint: str) -> None:
        """Note an error behind which reading can go on, or raise it."""
        error = failure(code, message, span, hint=hint)
        if self.errors is None:
            raise error
        self.errors.extend(error.diagnostics)

    def _absence(self, code: str, message: str, span: Span, *, hint: str) -> ScalarNode:
        """Note an error, or raise it; return a placeholder for the missing node."""
        self._refuse(code, message, span, hint=hint)
        return self._absent(span)

    def _absent(self, span: Span) -> ScalarNode:
        node = ScalarNode("", PLAIN, self.source, span.start, span.end)
        self.absent.append(node)
        return node

    def _refuse_tag(self, event: Any) -> None:
        start = event.start_mark.index
        end = start
        if self.text[start : start + 1] == "&":
            start = self.text.find("!", start)
            end = start
        while end < len(self.text) and not self.text[end].isspace() and self.text[end] not in ",]}":
            end += 1
        self._refuse(
            "yaml-tag",
            f"the YAML tag '{self.text[start:end]}' is not supported here",
            self.span(start, end),
            hint="quote the value if it is text; in an expression, write `not` instead of !",
        )

    def _refuse_key(self, node: YamlNode) -> ScalarNode:
        return self._absence(
            "complex-key",
            "a key must be a plain or quoted text, not a list or mapping",
            node.span(),
            hint=_hint_for_key(self.source, node),
        )

    def _is_second_document(self, event: Any) -> bool:
        """Return whether a second document begins, and refuse it."""
        kind = type(event)
        if kind is not DocumentStartEvent:
            return False
        self.documents += 1
        if self.documents == 1:
            return False
        self._refuse(
            "several-documents",
            "a second YAML document begins here; a file holds one",
            self.span(event.start_mark.index, event.end_mark.index),
            hint="put the other document in a separate file and `include` it",
        )
        return True


def _hint_for_key(source: Source, node: YamlNode) -> str:
    written = source.text[node.start : node.end].rstrip()
    if len(written.splitlines()) > 1:
        return "quote the key if it is text, and write it on one line"
    if isinstance(node, MappingNode) and node.is_flow:
        return f"an expression is written $({written.strip('{} ')})"
    return f"quote the key if it is text: {quoted(written)}"


def children_of(node: YamlNode) -> list[Any]:
    """Return the nodes right below a node: items, or keys and values in turn."""
    if isinstance(node, SequenceNode):
        return node.items
    if isinstance(node, MappingNode):
        return [child for pair in node.pairs for child in pair]
    return []


def _merged_pairs(
    node: YamlNode, own: set[str], *, is_alias: bool
) -> list[tuple[ScalarNode, YamlNode]]:
    """Return what `<<: node` brings, without the keys in `own`.

    In `<<: [*a, *b]` the earlier mapping wins, as in YAML. An alias to a body in list form brings
    all its pairs, since there a repeated key is meant.
    """
    mappings = node.items if isinstance(node, SequenceNode) else [node]
    taken = set(own)
    brought: list[tuple[ScalarNode, YamlNode]] = []
    for mapping in mappings:
        if not isinstance(mapping, MappingNode):
            raise failure(
                "bad-merge",
                "`<<` can only merge mappings",
                mapping.span(),
                hint="write `<<: *name`, where &name is before a mapping",
            )
        brought.extend(pair for pair in mapping.pairs if pair[0].text not in taken)
        if not is_alias:
            taken.update(key.text for key, _ in mapping.pairs)
    return brought
