"""Documents of variants that are not built: those that took the same way were recorded.

A document that is replayed is that of a build, byte for byte, and so is the model that MuJoCo makes
of it. This does not have to be believed: each recording is compared with builds of two variants,
and some variants of a batch, the extremes of each argument among them, are built as well.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from .molds import Mold
from .plan import Plan, Space, import_extra
from .recording import Replay, record

CHECKED = 8
"""Variants of a batch, evenly spaced, that are built as well; the extremes come on top."""
LEAST = 24
"""Variants of a batch from which on recording is worth its time."""
MOLDED = 16
"""Documents of one way from which on MuJoCo does not read them."""
FREE, COST = 4, 24
"""Recordings that are made in any case, and the builds that each takes the time of."""


Finding = tuple[str, str, str]
"""Code, place and message of a warning."""


class Document:
    """The document of a variant.

    Attributes:
        text: the document.
        files: what belongs beside it, by path.
        warnings: what was found.
    """

    __slots__ = ("files", "text", "warnings")

    def __init__(self, text: str, files: Mapping[str, bytes], warnings: Sequence[Finding]) -> None:
        self.text = text
        self.files = files
        self.warnings = warnings

    def model(self) -> Any:
        """Return what MuJoCo compiles of it; raise ValueError if it refuses it."""
        mujoco = import_extra("mujoco", "sim")
        return mujoco.MjModel.from_xml_string(self.text, dict(self.files))


class Replayed(Document):
    """A document that was not built."""

    __slots__ = ("_pieces", "_way", "is_to_check")

    def __init__(self, pieces: tuple[str, ...], way: _Way, *, is_to_check: bool) -> None:
        super().__init__("".join(pieces), way.document.files, way.document.warnings)
        self._pieces = pieces
        self._way = way
        self.is_to_check = is_to_check

    def model(self) -> Any:
        """Return what MuJoCo compiles of it; raise ValueError if it refuses it."""
        mold = self._way.mold_for(self._pieces)
        if mold is not None:
            try:
                return mold.model(self._pieces)
            except ValueError:  # after which nobody knows what the mold holds
                self._way.mold = None
        return super().model()


class _Way:
    """What variants have in common that are built in the same way.

    Attributes:
        function: gives the document of each of them, and None for others.
        document: that of the one that was recorded.
        hits: how many documents it has given.
        mold: gives their models; None before there are some, and if it cannot.
    """

    __slots__ = ("document", "function", "hits", "mold")

    def __init__(self, function: Replay, document: Document) -> None:
        self.function = function
        self.document = document
        self.hits = 0
        self.mold: Mold | None = None

    def mold_for(self, pieces: tuple[str, ...]) -> Mold | None:
        """Return a model with other numbers, or None if there is none."""
        if self.hits == MOLDED:
            try:
                self.mold = Mold(pieces, self.document.files)
            except Exception:  # then MuJoCo reads each document
                self.mold = None
        return self.mold


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

    def find(self, index: int, arguments: Mapping[str, Any]) -> Replayed | None:
        """Return the document of a variant, if it is known."""
        numbers = [value for value in arguments.values() if type(value) in (int, float)]
        ways = self._ways.get(_kind_of(arguments), [])
        for at, way in enumerate(ways):
            try:
                pieces = way.function(*numbers)
            except Exception:  # a build says what is wrong
                continue
            if pieces is None:
                continue
            self._hits += 1
            way.hits += 1
            if at:  # those taken often come first
                ways[at - 1], ways[at] = way, ways[at - 1]
            is_new = way.hits in (1, MOLDED + 1)
            return Replayed(pieces, way, is_to_check=is_new or index in self.checked)
        return None

    def learn(self, arguments: Mapping[str, Any], document: Document) -> None:
        """Record the way in which a variant is built; `document` is what came out."""
        if self._is_off or self._hits < COST * (self._tries - FREE):
            return
        names = [name for name, value in arguments.items() if type(value) in (int, float)]
        self._tries += 1
        function = record(dict(arguments), names, self._build) if names else None
        if function is None:
            return
        pieces = function(*[arguments[name] for name in names])
        if pieces is not None and "".join(pieces) == document.text:
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
