"""What a build made of what is written: the values of expressions, and of variables where set."""

from __future__ import annotations

from itertools import islice

from ...source import Reading, RecordedSpan, Span
from ...xml.tree import Element, Text
from ...xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

Key = tuple[str, int]
"""A file and the offset at which something is written."""
MOST_ELEMENTS = 200_000


class Values:
    """The values in a finished tree by the places they come from.

    Attributes:
        written: what each value, as a whole, came out as, in order.
        set: the values of names, by where they are declared, and the name.
        read: likewise, by the place of the value that read them.
    """

    def __init__(self, root: Element | None, noted: Sequence[Reading]) -> None:
        """Look through a tree, or nothing, and the values that were noted while it was built."""
        self.written: dict[Key, dict[str, None]] = {}
        self.set: dict[tuple[str, int, str], dict[str, None]] = {}
        self.read: dict[tuple[str, int, str], dict[str, None]] = {}
        for reading in noted:
            if reading.span is not None:
                at = (reading.span.source.path, reading.span.start, reading.name)
                self.set.setdefault(at, {}).setdefault(reading.value)
        for element in islice(root.iter(), MOST_ELEMENTS) if root is not None else ():
            for name, value in element.attributes.items():
                if value is not None:
                    self._note(element.value_span(name), value)
            for child in element.children:
                if isinstance(child, Text):
                    self._note(child.span, child.value)

    def _note(self, span: Span, value: object) -> None:
        if not isinstance(span, RecordedSpan):
            return
        key = (span.source.path, span.start)
        self.written.setdefault(key, {}).setdefault(format_value(value))
        for other in (span, span.name_span, *span.others):
            if not isinstance(other, RecordedSpan):
                continue
            for reading in other.readings:
                where = (other.source.path, other.start, reading.name)
                self.read.setdefault(where, {}).setdefault(reading.value)
