"""The values of a file's arguments: passed, reaching it as `child` or `bridge`, or by default."""

from __future__ import annotations

import os

from ..diagnostics import Diagnostic, InputFault, Reporter, YamaroError, failure
from ..namespace import MISSING
from ..source import COMMAND_LINE, Source, Span
from ..syntax.argument_section import PATH, ArgumentEntry, checked, is_literal, spelling_of
from ..syntax.nodes import IncludeNode
from ..syntax.python import Template
from .expressions import Values, span_of
from .scope import Scope

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

MOST_LISTED = 12
"""Arguments that a hint lists."""


class _Given:
    """A value that an argument has, before it is checked.

    Attributes:
        value: the value.
        span: where the value is written.
        place: where the name is written, which messages about expressions show.
        spelling: how a scalar is written that was written for this argument.
        is_si: whether a number without a unit is in SI: it comes from an expression.
    """

    __slots__ = ("is_si", "place", "span", "spelling", "value")

    def __init__(
        self, value: Any, span: Span, place: Span, *, spelling: str | None, is_si: bool
    ) -> None:
        self.value = value
        self.span = span
        self.place = place
        self.spelling = spelling
        self.is_si = is_si


def settle_arguments(
    entries: list[ArgumentEntry],
    scope: Scope,
    values: Values,
    include: IncludeNode | None,
) -> None:
    """Declare the arguments of a file in its scope, which has what is passed to it.

    Args:
        entries: the arguments that the file declares.
        scope: the run of the file.
        values: evaluates defaults.
        include: what includes the file; None for the main file.

    Raises:
        YamaroError: with every argument that is unknown, missing or refused.
    """
    # An error for each name that is passed and not declared.
    from ..diagnostics import meant

    known = {entry.name: None for entry in entries}
    faults = []
    listed = "it has no arguments"
    if known:
        more = ", …" if len(known) > MOST_LISTED else ""
        listed = f"its arguments are {', '.join(list(known)[:MOST_LISTED])}{more}"
    places = {each.name: each.span for each in include.arguments} if include is not None else {}
    for name in [name for name in scope if name in scope.passed and name not in known]:
        span = places.get(name) or scope.place_of(name) or Span(scope.home.source, 0, 0)
        hint, fix = meant(name, known, span)
        faults.append(
            Diagnostic(
                "unknown-argument",
                f"'{scope.home.source.name}' has no argument '{name}'",
                span,
                hint=hint or listed,
                fix=fix,
            )
        )
    for entry in entries:
        try:
            _settle(entry, scope, values, include, is_whole=not faults)
        except YamaroError as error:
            faults += error.diagnostics
    if faults:
        raise YamaroError(faults)


def _settle(
    entry: ArgumentEntry,
    scope: Scope,
    values: Values,
    include: IncludeNode | None,
    *,
    is_whole: bool,
) -> None:
    """Declare one argument; with errors before it (`not is_whole`) only check what is literal."""
    given = _given(entry.name, scope, include)
    if given is not None:
        value = _checked(entry, given)
        is_bridge = entry.name in scope.shared_names.bridges and entry.name not in scope
        if not (is_bridge and value is given.value):  # the bridge is seen, also when it changes
            scope.declare(entry.name, value, place=given.place)
        return
    default = entry.default
    if default is None:
        raise _missing(entry, scope, include)
    if not is_whole and not is_literal(default):
        return
    given = _Given(
        values.value(default, scope),
        span_of(default),
        entry.span,
        spelling=spelling_of(default),
        is_si=isinstance(default, Template),
    )
    scope.declare(entry.name, _checked(entry, given), place=entry.span)


def _checked(entry: ArgumentEntry, given: _Given) -> object:
    """Return a value as the argument has it; raise YamaroError if the argument refuses it."""
    try:
        value = checked(entry, given.value, spelling=given.spelling, is_si=given.is_si)
    except InputFault as fault:
        raise failure(
            fault.code,
            fault.message,
            given.span,
            hint=fault.hint,
            notes=[]
            if given.span.source is entry.span.source
            else [f"the argument is declared at {entry.span.place()}"],
        ) from None
    if entry.kind != PATH or not isinstance(value, str) or not value or "://" in value:
        return value
    written_in = given.span.source.path  # paths are relative to the file they are written in
    folder = os.path.dirname(written_in) if written_in else os.getcwd()
    return os.path.normpath(os.path.join(folder, os.path.expanduser(value)))


def _given(name: str, scope: Scope, include: IncludeNode | None) -> _Given | None:
    """Return what is passed for an argument, or the `child` or `bridge` variable of its name."""
    if name not in scope.passed:
        value = scope.find_child(name)
        if value is MISSING:
            value = scope.shared_names.bridges.get(name, MISSING)
        if value is MISSING:
            return None
        here = scope.place_of(name) or Span(scope.home.source, 0, 0)
        return _Given(value, here, here, spelling=None, is_si=True)
    value = dict.__getitem__(scope, name)
    for argument in include.arguments if include is not None else ():
        if argument.name == name and argument.value is not None:
            return _Given(
                value,
                span_of(argument.value),
                argument.span,
                spelling=spelling_of(argument.value),
                is_si=isinstance(argument.value, Template),
            )
    place = scope.place_of(name)
    assert place is not None, "what is passed to the main file has a place"
    if place.source.name != COMMAND_LINE:
        return _Given(value, place, place, spelling=None, is_si=False)
    text = place.source.text
    start = text.index(":=") + 2
    spelling = None if isinstance(value, (str, list, dict)) else text[start:].strip()
    span = Span(place.source, start, len(text)) if text[start:].strip() else place
    return _Given(value, span, place, spelling=spelling, is_si=False)


# --- faults ---------------------------------------------------------------------------------------


def _missing(entry: ArgumentEntry, scope: Scope, include: IncludeNode | None) -> YamaroError:
    about = f": {entry.help}" if entry.help else ""
    message = f"'{scope.home.source.name}' needs the argument '{entry.name}'{about}"
    if include is None:
        hint = f"write {entry.name}:=VALUE after the file, or give it a default"
        return failure("missing-argument", message, entry.span, hint=hint)
    return failure(
        "missing-argument",
        message,
        include.span,
        hint=f"write {entry.name}: … under this include",
        notes=[f"it is declared at {entry.span.place()}"],
    )


def warn_of_own_prefix(
    node: IncludeNode, prefix: Span, names: list[str], source: Source, reporter: Reporter
) -> None:
    """Warn of an `attach` whose `prefix` may be meant for the argument of that name."""
    is_passed = any(argument.name == "prefix" for argument in node.arguments)
    if "prefix" in names and not is_passed:
        reporter.report(
            "prefix-not-passed",
            f"'{source.name}' has an argument 'prefix', and the `prefix` of `attach` is not passed "
            "to it",
            prefix,
            hint="to pass one, write arguments: {prefix: left_} under this `attach`",
        )
