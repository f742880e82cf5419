"""Where each link, joint and shape of a robot was written, in a form the page can show."""

from __future__ import annotations

import re

from ...diagnostics import INHERITED
from ...rendering import trace_lines

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ...diagnostics import Diagnostic, Frame
    from ...model.joint import Joint
    from ...model.link import Link
    from ...model.robot import Robot
    from ...source import Span

    Json = dict[str, object]

MOST_CALLS = 12
"""Steps of calls and includes that are shown for one place, innermost first."""

_QUOTED_OWNER = re.compile(r"\b(link|joint) '([^']+)'")


class Places:
    """The places a page can ask to open, by number; what it shows of each is their text."""

    __slots__ = ("_numbers", "texts", "where")

    def __init__(self) -> None:
        self._numbers: dict[object, int] = {}
        self.texts: list[str] = []
        self.where: list[tuple[str, int, int]] = []

    def number(self, span: Span) -> int:
        """Return the number of a place."""
        key = (span.source.path, span.source.name, span.start)
        number = self._numbers.get(key)
        if number is None:
            number = self._numbers[key] = len(self.texts)
            self.texts.append(span.place())
            self.where.append((span.source.path, *span.location()))
        return number

    def origin(self, span: Span, trace: Frame | None) -> Json:
        """Return where something is written, and the calls and includes that led there."""
        return {"place": self.number(span), "calls": self.calls(trace)}

    def calls(self, trace: Frame | None) -> list[Json]:
        """Return the steps that led to a place, innermost first."""
        steps: list[Json] = []
        frame = trace
        while frame is not None and len(steps) < MOST_CALLS:
            steps.append({"kind": frame.kind, "name": frame.name, "place": self.number(frame.span)})
            frame = frame.parent
        return steps


class Owners:
    """Finds the link or joint that a diagnostic is about."""

    __slots__ = ("_by_place", "_names")

    def __init__(self, robot: Robot) -> None:
        self._by_place: dict[object, list[tuple[list[str], str, str]]] = {}
        self._names: set[tuple[str, str]] = set()
        owners: list[Link | Joint] = [*robot.all_links, *robot.all_joints]
        for owner in owners:
            kind = owner.element.name
            self._names.add((kind, owner.name))
            for span, trace in _places_in(owner):
                found = self._by_place.setdefault(span.key(), [])
                found.append((trace_lines(trace), kind, owner.name))

    def of(self, diagnostic: Diagnostic) -> tuple[str, str] | None:
        """Return "link" or "joint" and its name; None if it is about neither, or about many.

        A message that names one decides. Otherwise the place does, and where a function
        was called more than once, the calls.
        """
        named = _QUOTED_OWNER.search(diagnostic.message)
        if named and (named[1], named[2]) in self._names:
            return named[1], named[2]
        found = self._by_place.get(diagnostic.span.key(), [])
        if len(found) > 1:
            calls = trace_lines(diagnostic.trace)
            found = [each for each in found if each[0] == calls]
        owners = {(kind, name) for _, kind, name in found}
        return owners.pop() if len(owners) == 1 else None


def _places_in(owner: Link | Joint) -> Iterator[tuple[Span, Frame | None]]:
    """Yield the place of each element and attribute in a link or joint, with what led there."""
    for element in owner.element.iter():
        trace = owner.trace if element.trace is INHERITED else element.trace
        yield element.span, trace
        for attribute in element.attributes:
            span = element.value_span(attribute)
            if span is not element.span:
                yield span, trace
