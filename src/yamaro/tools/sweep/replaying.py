"""Documents of variants that are not built: those that took the same way were recorded.

A document that is replayed is that of a build, byte for byte. This does not have to be believed:
each recording is compared with builds of two variants, and some variants of a batch, the extremes
of each argument among them, are built as well.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from .plan import Plan, Space
from .recording import record

CHECKED = 8
"""Variants of a batch, evenly spaced, that are built as well; the extremes come on top."""
LEAST = 24
"""Variants of a batch from which on recording is worth its time."""
FREE, COST = 4, 12
"""Recordings that are made in any case, and the builds that each takes the time of."""


class Document:
    """The document of a variant.

    Attributes:
        text: the document.
        files: what belongs beside it, by path.
        warnings: what was found, as code, place and message.
    """

    __slots__ = ("files", "text", "warnings")

    def __init__(
        self, text: str, files: dict[str, bytes], warnings: Sequence[tuple[str, str, str]]
    ) -> None:
        self.text = text
        self.files = files
        self.warnings = warnings


class _Way:
    """What variants have in common that are built in the same way.

    Attributes:
        function: gives the document of each of them, and None for others.
        document: that of the one that was recorded.
        is_checked: whether the document of another one was compared.
    """

    __slots__ = ("document", "function", "is_checked")

    def __init__(self, function: Callable[..., str | None], document: Document) -> None:
        self.function = function
        self.document = document
        self.is_checked = False


class Replays:
    """The ways in which variants were built so far.

    Attributes:
        checked: the numbers of variants that are built in any case.
    """

    def __init__(self, plan: Plan, build: Callable[[dict[str, Any]], str]) -> None:
        """Begin with none; `build` returns the document for some arguments."""
        self.checked = plan.checked
        self._build = build
        self._ways: dict[object, list[_Way]] = {}
        self._tries = self._hits = 0
        self._is_off = not (plan.is_recorded and plan.options.policy.is_trusted)

    def find(self, index: int, arguments: Mapping[str, Any]) -> tuple[Document | None, bool]:
        """Return the document of a variant, if it is known, and whether to compare it."""
        numbers = [value for value in arguments.values() if type(value) in (int, float)]
        ways = self._ways.get(_kind_of(arguments), [])
        for at, way in enumerate(ways):
            try:
                text = way.function(*numbers)
            except Exception:  # a build says what is wrong
                continue
            if text is None:
                continue
            self._hits += 1
            if at:  # those taken often come first
                ways[at - 1], ways[at] = way, ways[at - 1]
            is_new, way.is_checked = not way.is_checked, True
            document = Document(text, way.document.files, way.document.warnings)
            return document, is_new or index in self.checked
        return None, False

    def learn(self, arguments: Mapping[str, Any], document: Document) -> None:
        """Record the way in which a variant is built; `document` is what came out."""
        if self._is_off or self._hits < COST * (self._tries - FREE):
            return
        names = [name for name, value in arguments.items() if type(value) in (int, float)]
        self._tries += 1
        function = record(dict(arguments), names, self._build) if names else None
        if function is None:
            return
        if function(*[arguments[name] for name in names]) == document.text:
            ways = self._ways.setdefault(_kind_of(arguments), [])
            ways.append(_Way(function, document))


def _kind_of(arguments: Mapping[str, Any]) -> object:
    """Return what is the same for variants that may be built in one way."""
    return tuple(
        type(value) if type(value) in (int, float) else repr(value) for value in arguments.values()
    )


def to_check(plan: Plan) -> frozenset[int]:
    """Return the numbers of the variants that are built in any case."""
    found = set(range(0, plan.samples, max(1, plan.samples // CHECKED)))
    least: dict[str, tuple[Any, int]] = {}
    greatest: dict[str, tuple[Any, int]] = {}
    for index, arguments in enumerate(Space(plan).variants(0, plan.samples)):
        for name, value in arguments.items():
            if type(value) in (int, float):
                least[name] = min(least.get(name, (value, index)), (value, index))
                greatest[name] = max(greatest.get(name, (value, index)), (value, index))
    found.update(index for _, index in (*least.values(), *greatest.values()))
    return frozenset(found)
