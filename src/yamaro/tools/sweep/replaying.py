"""Documents of variants that are not built: those that took the same way were recorded.

A document that is replayed is that of a build, byte for byte, and so is the model that MuJoCo makes
of it. This does not have to be believed: each recording is compared with builds of two variants,
and some variants of a batch, the extremes of each argument among them, are built as well.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from .columns import Columns
from .molds import Mold
from .plan import Plan, Space, import_extra
from .recording import Recording, record

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
        files: what belongs beside it, by path.
        warnings: what was found.
    """

    __slots__ = ("_text", "files", "warnings")

    def __init__(self, text: str, files: Mapping[str, bytes], warnings: Sequence[Finding]) -> None:
        self._text = text
        self.files = files
        self.warnings = warnings

    @property
    def text(self) -> str:
        """Return the document."""
        return self._text

    def read(self) -> Any:
        """Return the model that MuJoCo reads from it; raise ValueError if it refuses it."""
        mujoco = import_extra("mujoco", "sim")
        return mujoco.MjModel.from_xml_string(self.text, dict(self.files))

    def model(self) -> Any:
        """Return this model, perhaps made in another way; it is valid until the next one."""
        return self.read()


class Replayed(Document):
    """A document that was not built.

    Attributes:
        is_to_check: whether it is to be compared with a build.
    """

    __slots__ = ("_columns", "_row", "_way", "is_to_check")

    def __init__(self, way: _Way, columns: Columns, row: int) -> None:
        """Take what was computed of a variant of a way."""
        super().__init__("", way.document.files, way.document.warnings)
        self._way = way
        self._columns = columns
        self._row = row
        self.is_to_check = False

    @property
    def text(self) -> str:
        """Return the document."""
        return "".join(self._columns.pieces(self._row))

    def model(self) -> Any:
        """Return what MuJoCo compiles of it; raise ValueError if it refuses it."""
        mold = self._way.mold
        if mold is not None:
            try:
                return mold.model([float(each[self._row]) for each in self._columns.texts])
            except ValueError:  # after which nobody knows what the mold holds
                self._way.mold = None
        return self.read()


class _Way:
    """What variants have in common that are built in the same way.

    Attributes:
        recording: gives the document of each of them.
        document: that of the one that was recorded.
        hits: how many documents it has given.
        mold: gives their models; None before there are some, and if it cannot.
    """

    __slots__ = ("document", "hits", "mold", "recording")

    def __init__(self, recording: Recording, document: Document) -> None:
        self.recording = recording
        self.document = document
        self.hits = 0
        self.mold: Mold | None = None

    def documents(self, variants: Sequence[Mapping[str, Any]]) -> list[Replayed | None]:
        """Return the documents of variants with numbers at the same arguments, as far as known."""
        numbers = [
            [value for value in arguments.values() if type(value) in (int, float)]
            for arguments in variants
        ]
        columns = Columns(self.recording, [*zip(*numbers, strict=True)])
        found = [
            Replayed(self, columns, row) if is_good else None
            for row, is_good in enumerate(columns.good.tolist())
        ]
        good = [each for each in found if each is not None]
        if not good:
            return found
        good[0].is_to_check = not self.hits
        if self.hits < MOLDED <= self.hits + len(good):
            good[0].is_to_check = True
            try:
                first = int(columns.good.argmax())
                self.mold = Mold(columns.pieces(first), self.document.files)
            except Exception:  # then MuJoCo reads each document
                self.mold = None
        self.hits += len(good)
        return found


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
        self._unknown: dict[object, dict[int, Mapping[str, Any]]] = {}  # by kind and number
        self._known: dict[int, Replayed] = {}
        self._tries = self._hits = 0
        self._is_off = not (plan.is_recorded and plan.options.policy.is_trusted)

    def begin(self, variants: Mapping[int, Mapping[str, Any]]) -> None:
        """Begin with other variants, of which `find` is asked for: their numbers and arguments."""
        self._unknown, self._known = {}, {}
        for index, arguments in variants.items():
            self._unknown.setdefault(_kind_of(arguments), {})[index] = arguments
        for kind, ways in self._ways.items():
            for way in ways:
                self._look(kind, way)

    def _look(self, kind: object, way: _Way) -> None:
        """Find the documents of variants that are of a way."""
        variants = self._unknown.get(kind)
        if not variants:
            return
        for index, document in zip([*variants], way.documents([*variants.values()]), strict=True):
            if document is not None:
                document.is_to_check |= index in self.checked
                self._known[index] = document
                del variants[index]

    def find(self, index: int) -> Replayed | None:
        """Return the document of a variant, if it is known."""
        for variants in self._unknown.values():
            variants.pop(index, None)
        found = self._known.pop(index, None)
        self._hits += found is not None
        return found

    def learn(self, arguments: Mapping[str, Any], document: Document) -> None:
        """Record the way in which a variant is built; `document` is what came out."""
        if self._is_off or self._hits < COST * (self._tries - FREE):
            return
        names = [name for name, value in arguments.items() if type(value) in (int, float)]
        self._tries += 1
        recording = record(dict(arguments), names, self._build) if names else None
        if recording is None:
            return
        way = _Way(recording, document)
        (found,) = way.documents([arguments])
        if found is not None and found.text == document.text:
            way.hits = 0
            kind = _kind_of(arguments)
            self._ways.setdefault(kind, []).append(way)
            self._look(kind, way)


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
