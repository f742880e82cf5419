"""Limbs that a robot has several times, such as legs and fingers, as a function that is called.

Limbs are alike if their parts have the same entries. What differs becomes a parameter: a word in
all names (`left`), a sign (`$(left * 0.05)`), or the text of an entry.
"""

from __future__ import annotations

import builtins
import re
from math import isclose, pi

from ...model.compare import NEGLIGIBLE, TOLERANCE
from ...runtime.predefined import CONSTANTS
from ...syntax.names import is_identifier
from ...xml.values import format_number
from .document import RECORD_WIDTH, Body, Entry, Row, element_key, joined

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from .document import Value

MOST_PARAMETERS = 16
FEW_PARAMETERS, LINES_FOR_ONE = 4, 5
"""Parameters that any function may have; with more, the lines that each has to be worth."""
BRACED = 90
"""Characters that a mapping in braces has at most, about."""
MOST_TRIED = 50
"""Groups of limbs that are looked at, those first that would save most."""
LEAST_SAVED = 3
"""Lines that a function has to save."""
_WORDS = re.compile(r"[^\W\d_]+|\d+|[\W_]+")
_PARAMETER = re.compile(r"[$][(](\w+)[)]")
_NUMBER = re.compile(r"([-+]?)((?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)(deg)?")
_PLAIN = re.compile(r"(?:0|[1-9]\d*)?\.?\d*(?:[eE][-+]?\d+)?")
_SIDES = frozenset("left right l r front rear back fl fr rl rr lf rf lh rh hl hr".split())
_ENDS = frozenset("front rear hind back".split())
_LIMBS = (
    ("Leg", ("leg", "foot", "calf", "shin", "knee", "ankle", "thigh", "tibia", "shank", "hip")),
    ("Finger", ("finger", "thumb", "knuckle", "phalanx", "proximal", "distal", "fingertip")),
    ("Arm", ("arm", "elbow", "shoulder", "forearm", "wrist", "hand", "gripper")),
    ("Wheel", ("wheel", "tire", "rim")),
)
"""What a limb is called by words in the names of its parts."""
_DIRECTIONS = {"xyz": ("front", "left", "up")}
"""Names of signs by the number that has them first: x is forward and y left (REP 103)."""


class _NotAlike(Exception):
    """Limbs differ in too much."""


class _Hole:
    """A text of a limb that may differ from limb to limb.

    Attributes:
        key: the key or attribute that it belongs to.
        part: which of the limb's parts it is in.
        texts: what it is in each limb.
    """

    __slots__ = ("key", "part", "texts")

    def __init__(self, key: str, part: int, texts: list[str]) -> None:
        self.key = key
        self.part = part
        self.texts = texts


def share_limbs(model: Body, taken: set[str]) -> Body:
    """Replace limbs that are alike by calls; return the functions.

    Args:
        model: the model.
        taken: the names of functions and variables that there are.
    """
    functions = Body()
    parents: dict[str, str] = {}
    bodies = [model]
    while bodies:
        body = bodies.pop(0)
        while (found := _best_group(body, parents)) is not None:
            function, calls, blocks = _function_of(body, found, taken)
            for (first, last), call in sorted(zip(blocks, calls, strict=True), reverse=True,
                                              key=lambda pair: pair[0]):  # fmt: skip
                body.entries[first:last] = [call]
            functions.append(function)
            assert isinstance(function.value, Body)
            inner = function.value.entries[-1].value
            assert isinstance(inner, Body)
            bodies.append(inner)
            parents[function.key] = _parent(inner.entries[0], parents) or ""
    return functions


# --- which limbs are alike --------------------------------------------------------------------


def _best_group(body: Body, parents: Mapping[str, str]) -> list[tuple[int, int]] | None:
    """Return the places of limbs that are worth a function most, or None.

    Args:
        body: the parts, and calls of functions.
        parents: what the first part of each function is on.
    """
    groups: dict[object, list[tuple[int, int]]] = {}
    known: dict[object, int] = {}
    shapes = [known.setdefault(_shape(entry), len(known)) for entry in body.entries]
    for first, last in _limbs(body, parents):
        groups.setdefault(tuple(shapes[first:last]), []).append((first, last))
    several = [places for places in groups.values() if len(places) > 1]
    ranked = sorted(
        ((_size(body, places) * (len(places) - 1), places) for places in several),
        key=lambda pair: -pair[0],
    )
    for _, places in ranked[:MOST_TRIED]:
        try:
            if _Alike(body, places).saved() >= LEAST_SAVED:
                return places
        except _NotAlike:
            continue
    return None


def _size(body: Body, places: Sequence[tuple[int, int]]) -> int:
    first, last = places[0]
    return sum(_lines(entry) for entry in body.entries[first:last])


def _lines(entry: Entry) -> int:
    """Return about how many lines an entry takes."""
    value = entry.value
    if not isinstance(value, Body) or (value.in_braces and _width(entry) <= BRACED):
        return 1
    return 1 + sum(_lines(each) for each in value)


def _width(entry: Entry) -> int:
    """Return about how many characters an entry takes on one line."""
    value = entry.value
    inner = sum(_width(each) + 2 for each in value) if isinstance(value, Body) else len(value or "")
    return len(entry.key) + 2 + inner


def _limbs(body: Body, of_functions: Mapping[str, str]) -> Iterator[tuple[int, int]]:
    """Yield where each part begins, and where the parts and calls below it end."""
    entries = body.entries
    names = [_names_in(entry) for entry in entries]
    parents = [_parent(entry, of_functions) for entry in entries]
    for first in range(len(entries)):
        if parents[first] is None or entries[first].key != "part":
            continue
        known, last = set(names[first]), first + 1
        while last < len(entries) and parents[last] in known:
            known |= names[last]
            last += 1
        yield first, last


def _names_in(entry: Entry) -> set[str]:
    """Return the names by which others may call what a part makes; none for another entry."""
    if entry.key != "part" or not isinstance(entry.value, Body):
        return set()
    found: set[str] = set()
    for own in entry.value:
        if own.key == "name" and isinstance(own.value, str):
            words = own.value.split()
            found |= {*words, *(f"{word}_link" for word in words)}
        elif own.key.startswith("link"):
            found |= {word for word in [_attributes(own.key)[1].get("name")] if word}
            if isinstance(own.value, Body):
                for each in own.value:
                    if each.key.startswith(("frame/", "sensor/")):
                        found.add(_attributes(each.key)[1].get("name", ""))
    return found


def _parent(entry: Entry, of_functions: Mapping[str, str]) -> str | None:
    """Return what a part, or the first part that a call makes, is on."""
    if not isinstance(entry.value, Body):
        return None
    if entry.key in of_functions:
        given = {own.key: str(own.value) for own in entry.value}
        return _PARAMETER.sub(lambda own: given.get(own[1], own[0]), of_functions[entry.key])
    for own in entry.value if entry.key == "part" else ():
        if own.key.partition("/")[0] == "joint" and isinstance(own.value, Body):
            for each in own.value:
                if each.key == "parent" and isinstance(each.value, str):
                    return each.value
    return None


def _attributes(key: str) -> tuple[str, dict[str, str]]:
    """Return the name in a key, and its attributes if they are plain; else the whole key."""
    name, slash, rest = key.partition("/")
    if not slash or any(mark in key for mark in "$'\"<"):
        return key, {}
    pairs = [piece.partition("=") for piece in rest.split(", ")]
    if any(not equals for _, equals, _ in pairs):
        return key, {}
    return name, {attribute: value for attribute, _, value in pairs}


def _shape(entry: Entry) -> object:
    """Return what limbs that are alike have in common: all but texts."""
    name, attributes = _attributes(entry.key)
    value = entry.value
    inner: object = type(value).__name__
    if isinstance(value, Body):
        inner = tuple(_shape(each) for each in value)
    elif isinstance(value, str):
        inner = len(value.split())
    return name, tuple(attributes), inner


def _texts(entry: Entry) -> Iterator[tuple[str, str]]:
    """Yield the texts of an entry in the order of `_rebuilt`, each with its key."""
    name, attributes = _attributes(entry.key)
    yield from attributes.items()
    if isinstance(entry.value, Body):
        for each in entry.value:
            yield from _texts(each)
    elif isinstance(entry.value, str):
        yield name, entry.value


def _rebuilt(entry: Entry, texts: Iterator[str]) -> Entry:
    """Return an entry with other texts."""
    name, attributes = _attributes(entry.key)
    key = entry.key
    if attributes:
        key = element_key(name, {attribute: next(texts) for attribute in attributes})
    value: Value = entry.value
    if isinstance(value, Body):
        inner = Body([_rebuilt(each, texts) for each in value], in_braces=value.in_braces,
                     width=value.width)  # fmt: skip
        inner.remark, inner.opening, inner.span = value.remark, value.opening, value.span
        value = inner
    elif isinstance(value, str):
        text = next(texts)
        value = type(value)(text) if not isinstance(value, Row) and text == value else text
    made = Entry(key, value, entry.comment)
    made.ending = entry.ending
    return made


# --- what differs -----------------------------------------------------------------------------


class _Alike:
    """Limbs that are alike, with what differs in them.

    Attributes:
        parameters: the values of each parameter, one for each limb, by its name.
        texts: the texts of the function.
    """

    def __init__(self, body: Body, places: Sequence[tuple[int, int]]) -> None:
        """Look at limbs.

        Raises:
            _NotAlike: too much differs.
        """
        self._limbs = [body.entries[first:last] for first, last in places]
        self.parameters: dict[str, list[str]] = {}
        self._words: dict[tuple[str, ...], str] = {}
        self._signs: dict[tuple[int, ...], str] = {}
        self._whole: dict[tuple[str, ...], str] = {}
        rows = [
            [
                (number, key, text)
                for number, entry in enumerate(limb)
                for key, text in _texts(entry)
            ]
            for limb in self._limbs
        ]
        self._name = self._called(rows)
        self._find_words()
        self._find_other_words([[text for _, _, text in row] for row in zip(*rows, strict=True)])
        self.texts = [
            self._text(_Hole(row[0][1], row[0][0], [text for _, _, text in row]))
            for row in zip(*rows, strict=True)
        ]

    @property
    def name(self) -> str:
        """Return what to call the function."""
        return self._name

    @property
    def own_name(self) -> str:
        """Return what to call the function after the words that the limbs' first names share."""
        split = [_WORDS.findall(_first_name(limb[0])) for limb in self._limbs]
        common = [word for word in split[0] if all(word in other for other in split)]
        words = [word for word in common if word.isalpha() and word.isascii()]
        telling = [word for word in words if word.lower() not in ("joint", "link")]
        return "".join(word[:1].upper() + word[1:] for word in telling or words)

    def _called(self, rows: list[list[tuple[int, str, str]]]) -> str:
        if len(self._limbs[0]) > 1:
            texts = [[text for _, _, text in row] for row in zip(*rows, strict=True)]
            keys = [key for _, key, _ in rows[0]]
            for key, row in zip(keys, texts, strict=True):
                if key != "name":
                    continue
                columns = _columns([text.lower() for text in row]) or ()
                words = {each for column in columns for each in column}
                for name, known in _LIMBS:
                    if not words.isdisjoint(known):
                        return name
        return self.own_name or "Limb"

    def saved(self) -> int:
        """Return how many lines a function saves."""
        lines = sum(_lines(entry) for entry in self._limbs[0])
        if len(self.parameters) > max(FEW_PARAMETERS, lines // LINES_FOR_ONE):
            return 0
        calls = 1 + len(self.parameters) // 5
        return (len(self._limbs) - 1) * lines - len(self._limbs) * calls - 3

    def _find_words(self) -> None:
        """Find the words in the names of the limbs' first parts that differ."""
        names = [_first_name(limb[0]) for limb in self._limbs]
        columns = _columns(names)
        if columns is None:
            raise _NotAlike
        for column in columns:
            if len(set(column)) > 1 and tuple(column) not in self._words:
                is_side = {word.lower() for word in column} <= _SIDES
                stem = "side" if is_side else "number" if column[0].isdigit() else "name"
                if stem == "name" and self._name == "Finger":
                    stem = "finger"
                if stem == "side" and self._name.lower() in ("leg", "wheel") and len(column) > 2:
                    stem = self._name.lower()
                self._words[tuple(column)] = self._new(stem, list(column))
        if len({*names}) < len(names):
            raise _NotAlike

    def _find_other_words(self, holes: list[list[str]]) -> None:
        """Find words that differ in several texts in the same way, such as in names of meshes."""
        times: dict[tuple[str, ...], int] = {}
        for texts in holes:
            columns = None if any("$(" in text for text in texts) else _columns(texts)
            for column in columns or ():
                if len(set(column)) > 1 and all(word.isalpha() for word in column):
                    times[column] = times.get(column, 0) + 1
        for column, count in times.items():
            if column in self._words:
                continue
            for known, name in list(self._words.items()):
                if column == tuple(word.upper() for word in known):
                    self._words[column] = f"{name}.upper()"
            if column not in self._words and count > 1:
                words = {word.lower() for word in column}
                stem = "side" if words == {"left", "right"} else "end" if words <= _ENDS else "word"
                self._words[column] = self._new(stem, list(column))

    def _new(self, stem: str, values: list[str]) -> str:
        """Add a parameter, and return its name.

        Raises:
            _NotAlike: there are too many.
        """
        if len(self.parameters) >= MOST_PARAMETERS:
            raise _NotAlike
        stem = "".join(char if char.isalnum() else "_" for char in stem)
        name, number = stem if _is_free(stem) else f"{stem}_", 2
        unique = name
        while unique in self.parameters:
            unique, number = f"{name}_{number}", number + 1
        self.parameters[unique] = values
        return unique

    def _text(self, hole: _Hole) -> str:
        """Return the text of the function for a text of the limbs."""
        first, *others = hole.texts
        if all(other == first for other in others):
            return first
        numbers = self._numbers(hole)
        if numbers is not None:
            return numbers
        words = self._in_words(hole.texts)
        if words is not None:
            return words
        start, end = _common_ends(hole.texts)
        key = tuple(text[len(start) : len(text) - len(end)] for text in hole.texts)
        if key not in self._whole:
            if any("$(" in text for text in key):
                raise _NotAlike
            stem = {"geometry": "mesh", "name": "name"}.get(hole.key, hole.key)
            if hole.part or stem in self.parameters or stem == "name":
                part = hole.part if self._limbs[0][hole.part].key == "part" else 0
                names = [_first_name(limb[part]) for limb in self._limbs]
                shared = [column[0] for column in _columns(names) or () if len({*column}) == 1]
                letters = [word.lower() for word in shared if word.isalpha() and word.isascii()]
                stem = "_".join([*[word for word in letters if word != "link"], stem])
            self._whole[key] = self._new(stem, list(key))
        return f"{start}$({self._whole[key]}){end}"

    def _in_words(self, texts: list[str]) -> str | None:
        """Return names in which only words differ that differ in all names."""
        columns = _columns(texts)
        if columns is None:
            return None
        pieces = []
        for column in columns:
            if len(set(column)) == 1:
                pieces.append(column[0])
            elif column in self._words:
                pieces.append(f"$({self._words[column]})")
            else:
                return None
        return "".join(pieces)

    def _numbers(self, hole: _Hole) -> str | None:
        """Return numbers that differ at most in signs, or None."""
        rows = [[_NUMBER.fullmatch(word) for word in text.split()] for text in hole.texts]
        if len({len(row) for row in rows}) > 1 or not rows[0]:
            return None
        pieces = []
        signs: list[tuple[tuple[int, ...], int]] = []
        for index, column in enumerate(zip(*rows, strict=True)):
            found = [match for match in column if match is not None]
            if len(found) < len(column) or len({match[3] for match in found}) > 1:
                return None
            values = [float(match[1] + match[2]) for match in found]
            if all(_is_close(values[0], value) for value in values):
                pieces.append(found[0][0])
                continue
            base = 0.0
            if hole.key == "rpy" and not found[0][3]:  # mirrored angles may add up to π
                total = values[0] + next(v for v in values if not _is_close(values[0], v))
                base = pi / 2 if _is_close(total, pi) else -pi / 2 if _is_close(total, -pi) else 0.0
            rest = [value - base for value in values]
            if not all(_is_close(abs(rest[0]), abs(value)) for value in rest):
                return None
            signs.append((tuple(1 if value > 0 else -1 for value in rest), index))
            is_plain = not base and _PLAIN.fullmatch(found[0][2])
            digits = found[0][2] if is_plain else format_number(abs(rest[0]))
            added = "" if not base else "pi / 2" if base > 0 else "-pi / 2"
            pieces.append(f"{len(signs) - 1}|{digits}|{found[0][3] or ''}|{added}")
        for number, (pattern, index) in enumerate(signs):
            name, factor = self._sign(pattern, hole.key, index)
            for place, piece in enumerate(pieces):
                if piece.startswith(f"{number}|"):
                    _, digits, unit, added = piece.split("|")
                    product = name if float(digits) == 1 and not unit else f"{digits} * {name}"
                    if added:
                        product = f"{added} {factor or '+'} {product}"
                    pieces[place] = f"$({'' if added else factor}{product}){unit}"
        return " ".join(pieces)

    def _sign(self, pattern: tuple[int, ...], key: str, index: int) -> tuple[str, str]:
        """Return the parameter for a pattern of signs, and `-` if it has the opposite signs."""
        opposite = tuple(-sign for sign in pattern)
        if pattern in self._signs:
            return self._signs[pattern], ""
        if opposite in self._signs:
            return self._signs[opposite], "-"
        stem = _DIRECTIONS.get(key, ("sign",) * 6)[min(index, 2)]
        name = self._new(stem, [str(sign) for sign in pattern])
        self._signs[pattern] = name
        return name, ""


def _common_ends(texts: Sequence[str]) -> tuple[str, str]:
    """Return the folder with a variable, and the ending of a file, that texts have in common."""
    folder, _, _ = texts[0].rpartition("/")
    start = f"{folder}/" if "$(" in folder else ""
    end = f".{texts[0].rpartition('.')[2]}" if start else ""
    if not all(text.startswith(start) and text.endswith(end) for text in texts):
        return "", ""
    return start, end


def _columns(texts: Sequence[str]) -> list[tuple[str, ...]] | None:
    """Return the words of texts side by side, or None if these are not as many in each.

    The end that the words of a place have in common is a word of its own: `ff` and `knuckle`.
    """
    split = [_WORDS.findall(text) for text in texts]
    if len({len(words) for words in split}) > 1:
        return None
    found: list[tuple[str, ...]] = []
    for column in zip(*split, strict=True):
        size = 0
        if len({*column}) > 1 and all(word.isalpha() for word in column):
            least = min(map(len, column))
            while size < least and len({word[-size - 1 :] for word in column}) == 1:
                size += 1
            longest = max(map(len, column)) - size
            size -= longest < SHORTEST_WORD  # `ff` and `mf` are words, and `f` and `m` are not
            is_upper = all(word.isupper() for word in column)
            if size < (1 if is_upper else SHORTEST_END) or size >= least:
                size = 0
        if size:
            found += [
                tuple(word[:-size] for word in column),
                tuple(word[-size:] for word in column),
            ]
        else:
            found.append(column)
    return found


SHORTEST_WORD, SHORTEST_END = 2, 3
"""Letters that a word has by which limbs differ, and an end that they have in common."""


def _function_of(
    body: Body, places: Sequence[tuple[int, int]], taken: set[str]
) -> tuple[Entry, list[Entry], Sequence[tuple[int, int]]]:
    """Return a function that makes limbs, the call of each, and their places."""
    alike = _Alike(body, places)
    column = next(iter(alike.parameters.values()))
    prefix = _common_start(column)
    names = [alike.name, alike.own_name, f"{alike.name}{prefix}"]
    name, number = next((each for each in names if each and each not in taken), alike.name), 2
    unique = name
    while unique in taken:
        unique, number = f"{name}{number}", number + 1
    taken.add(unique)
    first, last = places[0]
    texts = iter(alike.texts)
    inner = Body([_rebuilt(entry, texts) for entry in body.entries[first:last]])
    comment, inner.entries[0].comment = inner.entries[0].comment, ""
    value = Body([Entry("input", Row([*alike.parameters])), Entry("body", inner)])
    calls = []
    for index, (start, end) in enumerate(places):
        arguments = Body(
            [Entry(key, values[index]) for key, values in alike.parameters.items()],
            in_braces=True,
            width=RECORD_WIDTH,
        )
        remarks = _comments(body.entries[start:end]) if index else [comment]
        kept = [each for each in remarks if each not in _comments(inner.entries)]
        calls.append(Entry(unique, arguments, joined(*kept)))
    return Entry(unique, value), calls, places


def _comments(entries: Sequence[Entry]) -> list[str]:
    found = []
    for entry in entries:
        found += [entry.comment, entry.ending]
        if isinstance(entry.value, Body):
            found += [entry.value.opening, *_comments(entry.value.entries), entry.value.remark]
    return [each for each in found if each]


def _first_name(entry: Entry) -> str:
    """Return the name of a part's link, or of its part."""
    assert isinstance(entry.value, Body)
    for own in entry.value:
        if own.key == "name" and isinstance(own.value, str):
            return own.value.split()[-1]
        name = _attributes(own.key)[1].get("name")
        if own.key.startswith("link/") and name:
            return name
    raise _NotAlike


def _common_start(texts: Sequence[str]) -> str:
    first, last = min(texts), max(texts)
    end = next((i for i, char in enumerate(first) if char != last[i]), len(first))
    return first[:end].capitalize()


def _is_close(one: float, other: float) -> bool:
    return isclose(one, other, rel_tol=TOLERANCE / 10, abs_tol=NEGLIGIBLE / 10)


def _is_free(name: str) -> bool:
    """Return whether a name can be that of a parameter and hides nothing."""
    return is_identifier(name) and name not in CONSTANTS and not hasattr(builtins, name)
