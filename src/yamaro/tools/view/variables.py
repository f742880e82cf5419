"""The variables on the page: fields of the main file, and values in included files."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Collection, Iterable, Mapping

from ...declared_arguments import (
    Declared,
    declared_names,
    declared_of,
    variables_of,
    xacro_arguments,
)
from ...diagnostics import InputFault, YamaroError
from ...files.loader import LoadError, MemoryLoader, decode
from ...files.packages import PackageFinder
from ...policy import Limits
from ...source import Reading, Source, Span, holds_xml
from ...syntax.argument_section import (
    ANY,
    BOOLEAN,
    INTEGER,
    NUMBER,
    NUMERIC,
    TEXT,
    ArgumentEntry,
    arguments_of,
    checked,
)
from ...syntax.names import python_name
from ...yaml.nodes import type_plain
from .description import Places

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...files.loader import Loader

    Value = bool | int | float | str
    Json = dict[str, object]

LONGEST_TEXT = 10_000
"""Characters that a text from the page may have."""
_SHOWN = (NUMBER, INTEGER, TEXT, BOOLEAN, ANY)
"""The types of arguments that can be shown as fields."""


class WrongValue(Exception):
    """A field cannot take a value; the text says why."""


class VariableField:
    """A variable with a plain value.

    Attributes:
        name: as it is written.
        default: the value that the file gives it; None if that is for the user to give.
        span: where that is written.
    """

    __slots__ = ("default", "name", "span")

    def __init__(self, name: str, default: Value | None, span: Span) -> None:
        self.name = name
        self.default = default
        self.span = span

    @property
    def kind(self) -> str:
        """Return what the page lets one enter: "boolean", "number" or "text"."""
        if isinstance(self.default, bool):
            return "boolean"
        return "text" if isinstance(self.default, str) else "number"

    def read(self, value: object) -> Value:
        """Return what the page sent as a value of this variable.

        A whole number stays one where the file has a whole number: it may count something.

        Raises:
            WrongValue: it is of another kind, or too long.
        """
        kind = self.kind
        if kind == "boolean" and isinstance(value, bool):
            return value
        if kind == "text" and isinstance(value, str) and len(value) <= LONGEST_TEXT:
            return value
        if kind == "number" and isinstance(value, (int, float)) and not isinstance(value, bool):
            if not math.isfinite(value):
                raise WrongValue(f"'{self.name}' takes a finite number")
            return int(value) if isinstance(self.default, int) and value == int(value) else value
        raise WrongValue(f"'{self.name}' takes a {kind}")

    @property
    def is_whole(self) -> bool:
        """Return whether a slider goes by whole numbers."""
        return isinstance(self.default, int)

    def about(self) -> Json:
        """Return what the page has to know besides."""
        return {}

    def from_text(self, text: str) -> Value | None:
        """Return a value from the command line; the default for a value of another kind."""
        value = text if self.kind == "text" else value_of_text(text)
        try:
            return self.read(value)
        except WrongValue:
            return self.default


class ArgumentField(VariableField):
    """An argument with a plain value, which is in the argument's unit.

    Attributes:
        entry: what the file says of it.
    """

    __slots__ = ("entry",)

    def __init__(self, entry: ArgumentEntry, default: Value | None, span: Span) -> None:
        """Describe an argument; one that is required has no default."""
        super().__init__(entry.name, default, span)
        self.entry = entry

    @property
    def kind(self) -> str:
        """Return what the page lets one enter: a choice too."""
        if self.entry.choices is not None:
            return "choice"
        kinds = {NUMBER: "number", INTEGER: "number", TEXT: "text", BOOLEAN: "boolean"}
        return kinds.get(self.entry.kind) or super().kind

    @property
    def is_whole(self) -> bool:
        """Return whether a slider goes by whole numbers."""
        entry = self.entry
        if entry.kind == INTEGER:
            return True
        is_open = entry.low is None and entry.high is None and entry.step is None
        return super().is_whole and is_open and entry.unit is None

    def read(self, value: object) -> Value:
        """Return what the page sent, or what the command line has, as a value in the unit.

        Raises:
            WrongValue: the argument does not take it.
        """
        if isinstance(value, str) and len(value) > LONGEST_TEXT:
            raise WrongValue(f"'{self.name}' takes a shorter text")
        try:
            found = checked(self.entry, value)
        except InputFault as fault:
            raise WrongValue(fault.message) from None
        if self.entry.kind in NUMERIC and isinstance(found, (int, float)):
            return self.entry.in_unit(found)
        if not isinstance(found, (bool, int, float, str)):
            raise WrongValue(f"'{self.name}' takes a plain value here")
        return found

    def about(self) -> Json:
        """Return what the page has to know besides: range, choices, unit, help."""
        entry = self.entry
        bounds = {"least": entry.low, "most": entry.high, "step": entry.step}
        told: Json = {
            name: entry.in_unit(number) for name, number in bounds.items() if number is not None
        }
        if entry.choices is not None:
            told["choices"] = [
                entry.in_unit(choice)
                if entry.kind in NUMERIC and isinstance(choice, (int, float))
                else choice
                for choice in entry.choices
            ]
        if entry.is_log:
            told["isLog"] = True
        if entry.unit_text:
            told["unit"] = entry.unit_text
        if entry.help:
            told["help"] = entry.help
        return told


def read_variable_fields(
    text: str,
    name: str,
    *,
    path: str = "",
    loader: Loader | None = None,
    packages: PackageFinder | None = None,
) -> dict[str, VariableField]:
    """Return the variables that a main file has with a plain number, truth value or text.

    Those that are computed, and lists, are left out. Of a xacro file these are its arguments, and
    those of the files that it includes.

    Args:
        text: the file.
        name: its name, by which YAML and XML are distinguished.
        path: its absolute path, if it has one.
        loader: gives the files that a xacro file includes, whose arguments a build takes too; none
            without it.
        packages: finds the packages that they are in.

    Returns:
        The fields by the names under which a build knows them, in the order of the file.

    Raises:
        YamaroError: the file cannot be read as YAML or XML.
    """
    source = Source(text, name=name, path=path)
    if holds_xml(name, text):
        found, _ = xacro_arguments(
            source, loader or MemoryLoader({}), packages or PackageFinder(), Limits()
        )
        return {
            each.name: VariableField(each.name, value_of_text(each.default_text), each.span)
            for each in found
            if each.default_text is not None and each.has_value
        }
    entries = arguments_of(source)
    if entries is None:
        return {
            each.key: VariableField(each.name, each.default, each.default_span)
            for each in variables_of(source)
            if isinstance(each.default, (bool, int, float, str))
        }
    fields: dict[str, VariableField] = {}
    for entry in entries:
        declared = declared_of(entry)
        is_plain = isinstance(declared.default, (bool, int, float, str))
        if entry.kind in _SHOWN and (is_plain or declared.is_required):
            default = declared.default if is_plain else None
            fields[entry.name] = ArgumentField(entry, default, declared.default_span)  # type: ignore[arg-type]
    return fields


def value_of_text(text: str) -> Value:
    """Return a text as the number or truth value it may be, else as it is."""
    try:
        value = type_plain(text) if text else text
    except OverflowError:
        return text
    if isinstance(value, float) and not math.isfinite(value):
        return text
    return value if isinstance(value, (bool, int, float)) else text


# --- included variables -----------------------------------------------------------------------


_PASSED_ON = re.compile(r"\s*:\s*(['\"]?)\$\(\s*([^\W\d]\w*)\s*\)\1\s*(?:[,}\n#]|$)")
"""What follows the name of an include's argument whose value is a variable as it is."""
LONGEST_EXPRESSION = 200
"""Characters of an expression that are shown."""
MOST_STEPS = 20
"""Includes through which a variable is followed to the main file."""


class IncludedVariables:
    """The variables in the roots of files, with the values that they had in a build."""

    def __init__(
        self, noted: Iterable[Reading], main: str, fields: Mapping[str, VariableField]
    ) -> None:
        """Take what a build noted.

        Args:
            noted: the values of names where they are declared.
            main: the path of the main file.
            fields: the variables of the main file that a build takes, as it knows them.
        """
        self._main = main
        self._fields = fields
        self._has_arguments = any(isinstance(each, ArgumentField) for each in fields.values())
        self._noted: dict[str, list[Reading]] = {}
        for reading in noted:
            if reading.span is not None and reading.span.source.path:
                self._noted.setdefault(reading.span.source.path, []).append(reading)

    def data(self, loader: Loader, places: Places) -> list[Json]:
        """Return the variables by file, the main file first, as data for JSON."""
        found: list[Json] = []
        for path in sorted(self._noted, key=lambda each: each != self._main):
            rows = []
            for declared in _declared_in(path, loader):
                if path == self._main and declared.key in self._fields:
                    continue
                readings = [
                    reading
                    for reading in self._noted[path]
                    if python_name(reading.name) == declared.key
                    and reading.span is not None
                    and reading.span.start == declared.span.start
                ]
                if readings:
                    given = {
                        id(each.given): each.given for each in readings if each.given is not None
                    }
                    follows = {self._followed(span) for span in given.values()}
                    follow = follows.pop() if len(follows) == 1 else None
                    row: Json = {
                        "name": declared.name,
                        "values": list(dict.fromkeys(reading.value for reading in readings)),
                        "why": self._why_fixed(declared, list(given.values())),
                        "place": places.number(declared.span),
                        "text": declared.span.place(),
                    }
                    rows.append(row if follow is None else {**row, "follows": follow})
            if rows:
                found.append({"file": _shown(path, self._main), "variables": rows})
        return found

    def _why_fixed(self, declared: Declared, given: list[Span]) -> str:
        """Return why a build cannot be given a value of a variable."""
        name, file = declared.name, os.path.basename(declared.span.source.path)
        is_main = declared.span.source.path == self._main
        is_computed = declared.default_text is not None and not declared.has_value
        if given:
            places = [
                f"{os.path.basename(span.source.path or span.source.name)}:{span.location()[0]}"
                for span in given
            ]
            return f"set at {', '.join(places)}"
        if is_main and self._has_arguments:
            return f"{file} declares arguments, and a build takes no other names: declare it there"
        if is_computed:
            replaced = f"; {name}:=… on the command line replaces that" if is_main else ""
            text = declared.default_text or ""
            cut = text if len(text) <= LONGEST_EXPRESSION else f"{text[:LONGEST_EXPRESSION]}…"
            return f"computed: {cut}{replaced}"
        if is_main:
            return f"{name}:=… on the command line sets it"
        return f"private to {file}: the file that includes it can pass {name}: …"

    def _followed(self, span: Span | None) -> str | None:
        """Return the field of the main file that decides what is given at a place, or None."""
        for _ in range(MOST_STEPS):
            if span is None:
                return None
            text, path = span.source.text, span.source.path
            name = text[span.start : span.end].partition("/")[0].strip()
            passed = _PASSED_ON.match(text, span.end)
            if passed is not None:
                name = passed.group(2)
            elif not self._is_declaration(span):
                return None
            if path == self._main:
                return name if python_name(name) in self._fields else None
            noted = self._noted.get(path, ())
            span = next((each.given for each in noted if each.name == name and each.given), None)
        return None

    def _is_declaration(self, span: Span) -> bool:
        """Return whether a variable is declared at a place, rather than passed there."""
        noted = self._noted.get(span.source.path, ())
        return any(each.span is not None and each.span.start == span.start for each in noted)


def has_others(source: Source, fields: Collection[str]) -> bool:
    """Return whether a YAML file declares more in its root than the fields of a page.

    Raises:
        YamaroError: the file cannot be read.
    """
    return any(each.key not in fields for each in declared_names(source))


def _declared_in(path: str, loader: Loader) -> list[Declared]:
    """Return what a YAML file declares in its root; nothing of a file that is gone."""
    try:
        text = decode(loader.read(path), name=path, path=path).text
        return declared_names(Source(text, name=path, path=path))
    except (LoadError, YamaroError):
        return []


def _shown(path: str, main: str) -> str:
    """Return a path relative to the main file's folder where that is not longer."""
    try:
        relative = os.path.relpath(path, os.path.dirname(main))
    except ValueError:  # on another drive
        return path
    return min(relative, path, key=len)
