"""Reads YAML text into nodes that keep repeated keys, spelling, style and place.

Scalars are typed later, by `scalars.py`.
"""

from __future__ import annotations

import sys

from ..diagnostics import Reporter, YamaroError, failure
from ..policy import Limits
from ..source import Source, Span
from .builder import NodeBuilder, children_of
from .nodes import PLAIN, ScalarNode
from .scalars import is_null

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
    from .characters import refuse_characters

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
                if not _is_in_one(at, scalars):
                    from ..fixes import replacement

                    span, entry = Span(source, at, at + len(word)), f"<{word[:-1]}>:"
                    reporter.warn(
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


def _is_in_one(offset: int, places: list[tuple[int, int]]) -> bool:
    from bisect import bisect_right

    index = bisect_right(places, (offset, sys.maxsize)) - 1
    return index >= 0 and offset < places[index][1]
