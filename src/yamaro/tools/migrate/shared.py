"""Entries that many joints have, or many shapes, as a function that each of them calls.

A class of MJCF's defaults becomes such a function, named after the class. Limits differ from joint
to joint: they are its parameters, where all else that joints have is the same.
"""

from __future__ import annotations

from collections import Counter

from .document import RECORD_WIDTH, Body, Entry, Row, joined, pieces_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping, Sequence

    Atom = tuple[str, ...]

PLACES = {
    "joint": frozenset(("parent", "xyz", "rpy", "quat", "type/parent")),
    "visual": frozenset(("xyz", "rpy", "quat")),
    "collision": frozenset(("xyz", "rpy", "quat")),
}
"""What may call a function, with the entries that are never in one: the place of each."""
BLOCKS = ("mjcf", "sdf")
"""Entries of which each text can be in a function, and the others beside it."""
FEWEST = 3
"""How many joints or shapes call a function."""
LEAST_SAVED = 40
"""Characters that a function has to save."""
SHORTEST = 30
"""Characters that a function has to hold."""
LINE = 12
"""Characters that a call costs, or the head of a function."""
WORST = 60
"""Kinds of joints or shapes among which all pairs are looked at, the most frequent ones."""


class _Holder:
    """A joint or shape: what is in it, as atoms.

    Attributes:
        body: its entries.
        atoms: what it has, each with how long it is.
        path: the classes that it has in the source, the outermost first.
    """

    __slots__ = ("atoms", "body", "path")

    def __init__(self, kind: str, body: Body, known: Collection[str], path: Sequence[str]) -> None:
        self.body = body
        self.path = path
        self.atoms: dict[Atom, int] = {}
        times = Counter(entry.key for entry in body)
        for entry in body:
            name = entry.key.partition("/")[0]
            if name in PLACES[kind] or times[entry.key] > 1 or entry.comment or entry.ending:
                continue
            if not _is_closed(entry, known):
                continue
            value = entry.value
            if isinstance(value, Body) and entry.key in BLOCKS:
                for own in value:
                    if not own.comment and _is_closed(own, known):
                        said = _content(own)
                        self.atoms[entry.key, own.key, said] = len(own.key) + len(said)
                continue
            text = _said(entry)
            self.atoms["", text] = len(text)
            if isinstance(value, Body) and entry.key == "limit":
                keys = ", ".join([own.key for own in value])
                self.atoms["limit", keys] = len(keys)


def share_entries(
    bodies: Sequence[Body],
    known: Collection[str],
    taken: set[str],
    classes: Mapping[int, Sequence[str]],
    comments: dict[str, list[str]],
) -> list[Entry]:
    """Let joints and shapes call functions for what they have in common; return the functions.

    Args:
        bodies: those of the model and of functions, with the parts in them.
        known: the variables that functions may read.
        taken: the names that functions and variables have; those of the functions are added.
        classes: the classes of joints and shapes in the source, by where each is.
        comments: those on classes, by name; what a function has is taken out.
    """
    functions: list[Entry] = []
    found: dict[str, list[_Holder]] = {kind: [] for kind in PLACES}
    for body in bodies:
        for kind, inner in _holders(body):
            path = classes.get(inner.span.start, ()) if inner.span is not None else ()
            found[kind].append(_Holder(kind, inner, known, path))
    for kind, holders in found.items():
        while (best := _best(holders)) is not None:
            atoms, members = best
            functions.append(_function(kind, atoms, members, taken, comments))
            holders = [each for each in holders if each not in members]
    return functions


def _holders(body: Body) -> Iterator[tuple[str, Body]]:
    """Yield the joints and shapes in the parts of a body: the kind, and what is in it."""
    for entry in body:
        if entry.key != "part" or not isinstance(entry.value, Body):
            continue
        for own in entry.value:
            kind = own.key.partition("/")[0]
            if not isinstance(own.value, Body):
                continue
            if kind == "joint":
                yield kind, own.value
            elif kind == "link":
                for section in own.value:
                    kind = section.key.partition("/")[0]
                    if kind in ("visual", "collision") and isinstance(section.value, Body):
                        yield kind, section.value


def _is_closed(entry: Entry, known: Collection[str]) -> bool:
    """Return whether an entry reads nothing but variables that are known."""
    texts = [entry.key]
    if isinstance(entry.value, str):
        texts.append(entry.value)
    elif isinstance(entry.value, Body):
        if not all(_is_closed(own, known) for own in entry.value):
            return False
    return all(
        piece[2:-1] in known for text in texts for piece, is_expression in pieces_of(text)
        if is_expression
    )  # fmt: skip


def _said(entry: Entry) -> str:
    if isinstance(entry.value, Body):
        return f"{entry.key}: {{{', '.join(map(_said, entry.value))}}}"
    return f"{entry.key}: {entry.value or ''}"


def _content(entry: Entry) -> str:
    return _said(entry) if isinstance(entry.value, Body) else entry.value or ""


def _best(holders: list[_Holder]) -> tuple[set[Atom], list[_Holder]] | None:
    """Return the atoms that save most as a function, and who has them; None if none is worth it."""
    candidates: set[frozenset[Atom]] = set()
    kinds = Counter(frozenset(each.atoms) for each in holders)
    often = [kind for kind, _ in kinds.most_common(WORST)]
    for number, one in enumerate(often):
        candidates.add(one)
        candidates |= {one & other for other in often[number + 1 :]}
    sets = [(kind, count) for kind, count in kinds.items()]
    best: tuple[int, set[Atom], frozenset[Atom]] | None = None
    sizes = {atom: size for each in holders for atom, size in each.atoms.items()}
    for atoms in sorted(candidates, key=sorted):
        number = sum(count for kind, count in sets if atoms <= kind)
        if number < FEWEST:
            continue
        chosen = set(atoms)
        if any(atom[0] == "" and atom[1].startswith("limit: ") for atom in chosen):
            chosen = {atom for atom in chosen if atom[0] != "limit"}
        size = sum(sizes[atom] for atom in chosen)
        if size < SHORTEST:
            continue
        saved = (number - 1) * size - LINE * (number + 2)
        if saved >= LEAST_SAVED and (best is None or saved > best[0]):
            best = saved, chosen, atoms
    if best is None:
        return None
    _, chosen, atoms = best
    return chosen, [each for each in holders if atoms <= each.atoms.keys()]


def _function(
    kind: str,
    atoms: set[Atom],
    members: list[_Holder],
    taken: set[str],
    comments: dict[str, list[str]],
) -> Entry:
    """Return a function for some atoms, and let those that have them call it."""
    # The innermost class that most have in common, or "".
    paths = [member.path for member in members if member.path]
    of_class = ""
    if paths and 2 * len(paths) > len(members):
        depth = 0
        while all(len(path) > depth and path[depth] == paths[0][depth] for path in paths):
            of_class = paths[0][depth]
            depth += 1
    name, number = _name(kind, members, of_class), 2
    unique = name
    while unique in taken:
        unique, number = f"{name}{number}", number + 1
    taken.add(unique)
    varying: list[str] = []
    if _limit_atom(atoms):
        rows = [_bounds(member.body) for member in members]
        varying = [key for key in rows[0] if len({row[key] for row in rows}) > 1]
    inner = Body()
    for entry in members[0].body:
        value = entry.value
        if entry.key in BLOCKS and isinstance(value, Body):
            own = [each for each in value if (entry.key, each.key, _content(each)) in atoms]
            if own:
                is_short = all(isinstance(each.value, str) for each in own)
                inner.add(entry.key, Body(own, in_braces=is_short, width=value.width))
        elif ("", _said(entry)) in atoms:
            inner.append(entry)
        elif entry.key == "limit" and isinstance(value, Body) and _limit_atom(atoms):
            rest = [Entry(own.key, f"$({own.key})") if own.key in varying else own for own in value]
            inner.add("limit", Body(rest, in_braces=True, width=value.width))
    for member in members:
        _call(kind, member.body, unique, atoms, varying)
    parameters = [Entry("input", Row(varying))] if varying else []
    comment = joined(*comments.pop(of_class, ()))
    return Entry(unique, Body([*parameters, Entry("body", inner)]), comment)


def _bounds(body: Body) -> dict[str, str]:
    """Return the values of the limit of a joint."""
    for entry in body:
        if entry.key == "limit" and isinstance(entry.value, Body):
            return {own.key: str(own.value) for own in entry.value}
    return {}


def _limit_atom(atoms: set[Atom]) -> Atom | None:
    return next((atom for atom in atoms if atom[0] == "limit"), None)


def _call(kind: str, body: Body, name: str, atoms: set[Atom], varying: Sequence[str]) -> None:
    """Put a call in the place of what the function gives; at the end of a shape."""
    arguments = ", ".join(_bounds(body)[key] for key in varying)
    call = Entry(name, arguments or None)
    kept: list[Entry] = []
    at: int | None = None
    for entry in body.entries:
        given = ("", _said(entry)) in atoms
        if entry.key == "limit" and _limit_atom(atoms):
            given = True
        if entry.key in BLOCKS and isinstance(entry.value, Body):
            own = [each for each in entry.value
                   if (entry.key, each.key, _content(each)) not in atoms]  # fmt: skip
            given = not own
            if own and len(own) < len(entry.value.entries):
                is_short = all(isinstance(each.value, str) for each in own)
                rest = Body(own, in_braces=is_short, width=entry.value.width)
                entry = Entry(entry.key, rest, entry.comment)
                at = len(kept) if at is None else at
        if given:
            at = len(kept) if at is None else at
        else:
            kept.append(entry)
    kept.insert(len(kept) if at is None or kind != "joint" else at, call)
    body.entries = kept
    body.in_braces = body.in_braces and kind != "joint"
    if kind != "joint":
        body.width = RECORD_WIDTH
        body.has_call = True


def _name(kind: str, members: Sequence[_Holder], of_class: str) -> str:
    """Return what a function is called: as a class, or by its kind."""
    words = [word for word in "".join(c if c.isalnum() else " " for c in of_class).split() if word]
    stem = "".join(word[:1].upper() + word[1:] for word in words if word.isascii())
    if not stem[:1].isalpha():
        stem = ""
    if kind == "joint":
        types = {str(own.value) for each in members for own in each.body if own.key == "type"}
        return f"{stem}Joint" if stem or len(types) != 1 else f"{types.pop().capitalize()}Joint"
    return stem if stem and stem.lower() != kind else f"{stem or kind.capitalize()}Shape"
