"""The arguments or variables of a main file that the page shows as fields."""

from __future__ import annotations

import math

from ...diagnostics import InputFault, Reporter
from ...files.loader import MemoryLoader
from ...files.packages import PackageFinder
from ...policy import Limits
from ...source import Source, Span, holds_xml
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
from ...yaml.nodes import ScalarNode, type_plain
from ...yaml.reader import read
from ..declared_arguments import declared_of, pairs_in, plain_value
from ..xacro_arguments import xacro_arguments

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
        return _xacro_fields(source, loader or MemoryLoader({}), packages or PackageFinder())
    entries = arguments_of(source)
    return _yaml_fields(source) if entries is None else _argument_fields(entries)


def _argument_fields(entries: list[ArgumentEntry]) -> dict[str, VariableField]:
    fields: dict[str, VariableField] = {}
    for entry in entries:
        declared = declared_of(entry)
        is_plain = isinstance(declared.default, (bool, int, float, str))
        if entry.kind in _SHOWN and (is_plain or declared.is_required):
            default = declared.default if is_plain else None
            fields[entry.name] = ArgumentField(entry, default, declared.default_span)  # type: ignore[arg-type]
    return fields


def _yaml_fields(source: Source) -> dict[str, VariableField]:
    fields: dict[str, VariableField] = {}
    for section, body in pairs_in(read(source, reporter=Reporter())):
        if section.text != "variables":
            continue
        for key, value in pairs_in(body):
            written = key.text.partition("/")[0].strip()
            if written.isidentifier() and isinstance(value, ScalarNode):
                default = plain_value(value)
                if default is not None:
                    fields[python_name(written)] = VariableField(written, default, value.span())
    return fields


def _xacro_fields(
    source: Source, loader: Loader, packages: PackageFinder
) -> dict[str, VariableField]:
    declared, _ = xacro_arguments(source, loader, packages, Limits())
    return {
        each.name: VariableField(each.name, value_of_text(each.default_text), each.span)
        for each in declared
        if each.default_text is not None and each.has_value
    }


def value_of_text(text: str) -> Value:
    """Return a text as the number or truth value it may be, else as it is."""
    try:
        value = type_plain(text) if text else text
    except OverflowError:
        return text
    if isinstance(value, float) and not math.isfinite(value):
        return text
    return value if isinstance(value, (bool, int, float)) else text
