"""Finds where values come from that an expression or condition failed on."""

from __future__ import annotations

from ..namespace import MISSING
from ..source import COMMAND_LINE, KEYWORD_ARGUMENT, Span
from ..syntax.python import PythonCode
from ..yaml.brackets import find_close
from .scope import Scope
from .words import a_kind_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    import ast
    from collections.abc import Iterable, Mapping
    from types import CodeType
    from typing import Any

    from ..diagnostics import Diagnostic
    from .files import Files

MAX_NOTES = 3
_EXPLAINED = (TypeError, ValueError, AttributeError, LookupError, ArithmeticError)


def notes_on_error(error: BaseException, piece: str, scope: Scope, code: CodeType) -> list[str]:
    """Return notes on the variables in a piece of Python that may be what it failed on.

    Args:
        error: what it raised.
        piece: the piece that failed.
        scope: where it was evaluated.
        code: the code in which it stands, whose local variables are Python's own.
    """
    if not isinstance(error, _EXPLAINED):
        return []
    local = {*code.co_varnames, *code.co_cellvars, *code.co_freevars}
    values = {name: scope.find(name) for name in names_in(piece) if name not in local}
    suspects = _suspects(
        values,
        is_zero_fault=isinstance(error, ZeroDivisionError),
        has_text="'" in piece or '"' in piece,
    )
    return notes_on_names(suspects, scope)


def names_of_value(python: PythonCode, scope: Scope, value: Any) -> list[str]:
    """Return the variables in an expression that have its value."""
    names = [python.name] if python.name is not None else names_in(python.text)
    return [name for name in names if scope.find(name) is value]


def notes_on_names(names: Iterable[str], scope: Scope) -> list[str]:
    """Return notes on where the values of variables come from."""
    places = ((name, scope.place_of(name)) for name in names)
    notes = [note_on(name, scope.find(name), place) for name, place in places if place is not None]
    return notes[:MAX_NOTES]


def note_on(name: str, value: Any, place: Span) -> str:
    """Return the note that a value comes from a variable."""
    kind = "null" if value is None else a_kind_of(value)
    article, _, rest = kind.partition(" ")
    if article in ("a", "an"):
        kind = f"the {rest}"
    return f"{kind} comes from '{name}', {set_at(place)}"


def set_at(place: Span) -> str:
    """Return where a variable was set, in words."""
    if place.source.name == COMMAND_LINE:
        return f"set by {place.source.text} on the command line"
    if place.source.name == KEYWORD_ARGUMENT:
        return "set from Python"
    return f"set at {place.place()}"


def names_in(text: str) -> list[str]:
    """Return the names that a piece of Python reads, each once, in order."""
    import ast

    return _names_of(node for node in _nodes(text) if isinstance(node, ast.Name))


def names_tested(text: str) -> list[str]:
    """Return the names that `not`, `and`, `or` or `if` asks for their truth."""
    import ast

    tested: list[ast.AST] = []
    for node in _nodes(text):
        if isinstance(node, ast.BoolOp):
            tested += node.values
        elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
            tested.append(node.operand)
        elif isinstance(node, ast.IfExp):
            tested.append(node.test)
    return _names_of(node for node in tested if isinstance(node, ast.Name))


def _nodes(text: str) -> Iterable[ast.AST]:
    """Return the syntax of a piece of Python, or nothing if it is not Python."""
    import ast

    text = text.strip().replace("$(", "(")
    try:
        return ast.walk(ast.parse(f"({text}\n)", mode="eval"))
    except SyntaxError:
        try:
            return ast.walk(ast.parse(text))
        except SyntaxError:
            return []


def _names_of(nodes: Iterable[ast.Name]) -> list[str]:
    """Return the names at some places, each once, in the order of the text."""
    ordered = sorted(nodes, key=lambda node: (node.lineno, node.col_offset))
    return list(dict.fromkeys(node.id for node in ordered))


def _suspects(values: dict[str, Any], *, is_zero_fault: bool, has_text: bool) -> list[str]:
    """Return the names of the values that an operation is least likely to be meant for.

    Numbers are suspects only where nothing else is: no other value, and no text in quotes.
    """
    known = {
        name: value
        for name, value in values.items()
        if value is not MISSING and not callable(value) and type(value).__name__ != "module"
    }
    if is_zero_fault:
        return [name for name, value in known.items() if _is_number(value) and value == 0]
    kinds = [_is_text_or_none, lambda value: not _is_number(value), _is_number]
    for is_suspect in kinds[:2] if has_text else kinds:
        found = [name for name, value in known.items() if is_suspect(value)]
        if found:
            return found
    return []


def _is_text_or_none(value: Any) -> bool:
    return value is None or isinstance(value, (str, bytes))


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float))


def add_origins(diagnostic: Diagnostic, files: Files, passed: Mapping[str, Span]) -> None:
    """Note where the variables come from that are written at the place of an error in a part.

    The value is not at hand any more, so this reports only what the text of the program shows: a
    variable that is declared at one place, or given by the call or include that led there.

    Args:
        diagnostic: the error.
        files: the files of the program.
        passed: where the variables of the main file are set.
    """
    span = diagnostic.span
    names = _names_written(span.written())
    places = ((name, _only_place(name, diagnostic, files, passed)) for name in names)
    notes = [
        f"it comes from '{name}', {set_at(place)}"
        if len(names) == 1
        else f"'{name}' is {set_at(place)}"
        for name, place in places
        if place is not None
    ]
    diagnostic.notes = (*diagnostic.notes, *notes[:MAX_NOTES])


def _names_written(text: str) -> list[str]:
    """Return the names that the `$(…)` in a text read."""
    names: list[str] = []
    start = text.find("$(")
    while start >= 0:
        end = find_close(text, start + 2)
        if end < 0:
            break
        names += names_in(text[start + 2 : end])
        start = text.find("$(", end)
    return list(dict.fromkeys(names))


def _only_place(
    name: str, diagnostic: Diagnostic, files: Files, passed: Mapping[str, Span]
) -> Span | None:
    """Return the one place that gives a name its value where it is read, if there is just one."""
    span = diagnostic.span
    near = [
        each
        for each in files.where_declared(name)
        if each.scope not in ("import", "passed") and each.shares_context_with(span)
    ]
    inner = [each for each in near if each.extent is not None] or near
    if len(inner) > 1:
        return None
    is_local = bool(inner) and inner[0].extent is not None
    frame = diagnostic.trace
    while frame is not None and frame.kind != ("called" if is_local else "included"):
        frame = frame.parent
    if frame is not None and name in frame.places:
        return frame.places[name]
    if frame is None and name in passed and not is_local:
        return passed[name]
    return inner[0].span if inner else None
