"""Leaves out of finished sources what nothing reads.

A macro that computed the inertia of a solid is not called any more, and then nobody reads the
parameters that were handed to it; a file of which nothing is left needs no include.
"""

from __future__ import annotations

import os
import re
from collections import Counter

from ....xacro.templates import guess_value
from ..document import Body, Entry, Row, pieces_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Iterator

    from .program import XacroProgram

_WORD = re.compile(r"[^\W\d]\w*")


def tidy(files: dict[str, Body], main: str, program: XacroProgram) -> None:
    """Tidy the sources of a robot.

    Args:
        files: their sections, by path; those that are not needed are taken out.
        main: the path of the main file.
        program: the robot that they were made of.
    """
    _drop_aliases(list(files.values()), {f"arg_{name}" for name in program.arguments})
    _drop_parameters(list(files.values()), program)
    _drop_empty_files(files, main)
    _make_local(files, program)


# --- what nothing reads ---------------------------------------------------------------------------


def _drop_aliases(files: list[Body], names: set[str]) -> None:
    """Leave out arguments under names of their own that nothing reads."""
    used = {word for sections in files for word in _words_of_values(sections)}
    for sections in files:
        for body in bodies_in(sections):
            for entry in [entry for entry in body if entry.key == "variables"]:
                if isinstance(entry.value, Body):
                    _keep(
                        entry.value, lambda own: stem_of(own) not in names or stem_of(own) in used
                    )
                if isinstance(entry.value, Body) and not entry.value:
                    body.entries.remove(entry)


def _drop_parameters(files: list[Body], program: XacroProgram) -> None:
    """Leave out parameters that only macros read that are not called any more."""
    functions = _functions_in(files)
    read = {
        macro.function: _words_in_macro(macro.element) for macro in program.definitions.values()
    }
    computed = {
        word
        for sections in files
        for entry in entries_in(sections)
        if entry.key.startswith("$(")
        for word in _WORD.findall(entry.key)
    }
    is_new = True
    while is_new:
        is_new = False
        for name, function in functions.items():
            inputs = function.entries[0] if function.entries else None
            if inputs is None or inputs.key != "input" or not isinstance(inputs.value, Row):
                continue
            if name in computed or name not in read:
                continue
            used = set(_words_in(Body(function.entries[1:])))
            for piece in inputs.value.pieces:
                used.update(_WORD.findall(piece.partition("=")[2]))
            dropped = {
                own
                for piece in inputs.value.pieces
                if (own := _name_of_input(piece)) not in used and own in read[name]
            }
            if dropped:
                is_new = True
                _drop_inputs(function, dropped)
                for sections in files:
                    _drop_arguments(sections, name, dropped)


def _drop_inputs(function: Body, names: set[str]) -> None:
    inputs = function.entries[0]
    assert isinstance(inputs.value, Row)
    pieces = [piece for piece in inputs.value.pieces if _name_of_input(piece) not in names]
    if pieces:
        inputs.value = Row(pieces)
    else:
        del function.entries[0]


def _drop_arguments(sections: Body, function: str, names: set[str]) -> None:
    for entry in entries_in(sections):
        if entry.key.rpartition(".")[2] == function and isinstance(entry.value, Body):
            _keep(entry.value, lambda own: own.key not in names)
            entry.value = entry.value or None


def _name_of_input(piece: str) -> str:
    return piece.partition("=")[0].strip()


def _functions_in(files: list[Body]) -> dict[str, Body]:
    """Return the functions by name, without those of which there are several of a name."""
    found: dict[str, list[Body]] = {}
    for sections in files:
        for entry in entries_in(sections):
            if entry.key == "functions" and isinstance(entry.value, Body):
                for function in entry.value:
                    if isinstance(function.value, Body):
                        found.setdefault(stem_of(function), []).append(function.value)
    return {name: bodies[0] for name, bodies in found.items() if len(bodies) == 1}


# --- scopes ---------------------------------------------------------------------------------------


def _make_local(files: dict[str, Body], program: XacroProgram) -> None:
    """Take the scope from variables that are declared once, and read in that file only."""
    words = {path: set(words_read(sections)) for path, sections in files.items()}
    others = {word for text in program.files.data.values() for word in _WORD.findall(text)}
    if len(program.roots) > len(files):
        for root in program.roots.values():
            others |= _words_in_macro(root)
    times = Counter(
        stem_of(own)
        for sections in files.values()
        for entry in entries_in(sections)
        if entry.key == "variables" and isinstance(entry.value, Body)
        for own in entry.value
    )
    for path, sections in files.items():
        read = others.union(*(own for other, own in words.items() if other != path))
        for variables in [entry.value for entry in sections if entry.key == "variables"]:
            assert isinstance(variables, Body)
            for entry in variables:
                name, _, scope = entry.key.partition("/")
                if scope == "global" and name not in read and times[name] == 1:
                    entry.key = name


# --- files ----------------------------------------------------------------------------------------


def _drop_empty_files(files: dict[str, Body], main: str) -> None:
    """Leave out files with nothing in them, and their includes."""
    includes = [
        path_of_include(entry)
        for sections in files.values()
        for entry in entries_in(sections)
        if entry.key == "include"
    ]
    if any("$(" in path for path in includes):
        return  # it may be any file
    while empty := [path for path, body in files.items() if path != main and _is_empty(body)]:
        for path in empty:
            del files[path]
        for own, sections in files.items():
            for body in bodies_in(sections):
                body.entries[:] = [
                    entry
                    for entry in body
                    if entry.key != "include" or file_meant(entry, own) not in empty
                ]


def file_meant(include: Entry, path: str) -> str:
    """Return the path of the source that an include in a source names."""
    return os.path.normpath(os.path.join(os.path.dirname(path), path_of_include(include)))


def _is_empty(sections: Body) -> bool:
    return not sections.remark and all(
        entry.key == "model" and not entry.value and not entry.comment for entry in sections
    )


def path_of_include(entry: Entry) -> str:
    """Return the path in an include, as it is written."""
    if isinstance(entry.value, Body):
        return next((str(own.value) for own in entry.value if own.key == "path"), "")
    return str(entry.value)


# --- comparisons ----------------------------------------------------------------------------------


_LITERAL = r"""('[^'\\]*'|"[^"\\]*")"""
_TEXT_OF = r"str\((\w+)\)(\.lower\(\))?"
_COMPARED = re.compile(rf"\b{_TEXT_OF} (==|!=) {_LITERAL}|{_LITERAL} (==|!=) {_TEXT_OF}")


def simplify_comparisons(files: Iterable[Body], truths: Collection[str]) -> None:
    """Write `x == 'left'` for `str(x) == 'left'`, and `x` for `str(x).lower() == 'true'`.

    Args:
        files: the sections of all files.
        truths: the names that are always true or false.
    """

    def simplified(found: re.Match[str]) -> str:
        name, lower, operator, literal = found.group(1, 2, 3, 4)
        if name is None:
            literal, operator, name, lower = found.group(5, 6, 7, 8)
        text = literal[1:-1]
        if lower and name in truths and text in ("true", "false"):
            return name if (text == "true") == (operator == "==") else f"not {name}"
        is_told_apart = isinstance(guess_value(text), str) and text.lower() not in _SHOWN
        return f"{name} {operator} {literal}" if is_told_apart and not lower else found[0]

    for sections in files:
        for entry in entries_in(sections):
            if entry.key == "condition" and isinstance(entry.value, str):
                entry.value = type(entry.value)(_COMPARED.sub(simplified, entry.value))
            elif "$(" in entry.key:
                entry.key = _in_expressions(entry.key, simplified)
            if isinstance(entry.value, str) and not isinstance(entry.value, Row):
                entry.value = type(entry.value)(_in_expressions(entry.value, simplified))


_SHOWN = ("none", "true", "false", "nan", "inf", "-inf")
"""Texts that Python shows for something that is not a text."""


def _in_expressions(text: str, simplified: Callable[[re.Match[str]], str]) -> str:
    return "".join(
        _COMPARED.sub(simplified, piece) if is_expression else piece
        for piece, is_expression in pieces_of(text)
    )


# --- walking --------------------------------------------------------------------------------------


def bodies_in(body: Body) -> Iterator[Body]:
    """Return a body and all in it."""
    yield body
    for entry in list(body):
        if isinstance(entry.value, Body):
            yield from bodies_in(entry.value)


def entries_in(body: Body) -> Iterator[Entry]:
    """Return the entries of a body and of all in it."""
    for own in bodies_in(body):
        yield from list(own)


def _words_in(body: Body) -> Iterator[str]:
    """Return all words in keys and values."""
    for entry in entries_in(body):
        yield from _WORD.findall(entry.key)
        if isinstance(entry.value, str):
            yield from _WORD.findall(entry.value)


def _words_of_values(body: Body) -> Iterator[str]:
    """Return all words in values, and in keys where these are expressions."""
    for entry in entries_in(body):
        if "$(" in entry.key:
            yield from _WORD.findall(entry.key)
        if isinstance(entry.value, str):
            yield from _WORD.findall(entry.value)


def words_read(body: Body) -> Iterator[str]:
    """Return the same without the names of parameters."""
    for entry in entries_in(body):
        if "$(" in entry.key:
            yield from _WORD.findall(entry.key)
        if entry.key == "input" and isinstance(entry.value, Row):
            for piece in entry.value.pieces:
                yield from _WORD.findall(piece.partition("=")[2])
        elif isinstance(entry.value, str):
            yield from _WORD.findall(entry.value)


def _words_in_macro(element: object) -> set[str]:
    from ....xml.tree import Element
    from ....xml.values import format_value

    assert isinstance(element, Element)
    return {
        word
        for inner in element.iter()
        for text in (
            *(format_value(v) for k, v in inner.attributes.items() if k != "params"),
            inner.text(),
        )
        for word in _WORD.findall(text)
    }


def stem_of(entry: Entry) -> str:
    """Return the name in a key without its scope."""
    return entry.key.partition("/")[0]


def _keep(body: Body, is_kept: Callable[[Entry], bool]) -> None:
    """Leave out entries, with the comments on them."""
    body.entries[:] = [entry for entry in body.entries if is_kept(entry)]
