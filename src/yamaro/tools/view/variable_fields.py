"""The variables of a main file that the page shows as fields: those with plain values."""

from __future__ import annotations

import math

from ...diagnostics import Reporter
from ...policy import Limits
from ...source import Source, Span
from ...syntax.includes import holds_xml
from ...syntax.names import python_name
from ...xml.reader import read_xml
from ...xml.values import format_value
from ...yaml.nodes import PLAIN, MappingNode, ScalarNode, SequenceNode
from ...yaml.reader import read
from ...yaml.scalars import type_plain

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ...yaml.nodes import YamlNode

    Value = bool | int | float | str

LONGEST_TEXT = 10_000
"""Characters that a text from the page may have."""


class WrongValue(Exception):
    """A field cannot take a value; the text says why."""


class VariableField:
    """A variable with a plain value.

    Attributes:
        name: as it is written.
        default: the value that the file gives it.
        span: where that is written.
    """

    __slots__ = ("default", "name", "span")

    def __init__(self, name: str, default: Value, span: Span) -> None:
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

    def from_text(self, text: str) -> Value:
        """Return a value from the command line; the default for a value of another kind."""
        value = text if self.kind == "text" else value_of_text(text)
        try:
            return self.read(value)
        except WrongValue:
            return self.default


def read_variable_fields(text: str, name: str) -> dict[str, VariableField]:
    """Return the variables that a main file has with a plain number, truth value or text.

    Those that are computed, and lists, are left out. Of a xacro file these are its arguments.

    Args:
        text: the file.
        name: its name, by which YAML and XML are told apart.

    Returns:
        The fields by the names under which a build knows them, in the order of the file.

    Raises:
        YamaroError: the file cannot be read as YAML or XML.
    """
    source = Source(text, name=name)
    return _xacro_fields(source) if holds_xml(name, text) else _yaml_fields(source)


def _yaml_fields(source: Source) -> dict[str, VariableField]:
    fields: dict[str, VariableField] = {}
    for section, body in _pairs(read(source, reporter=Reporter())):
        if section.text != "variables":
            continue
        for key, value in _pairs(body):
            written = key.text.partition("/")[0].strip()
            if written.isidentifier() and isinstance(value, ScalarNode):
                default = _plain_value(value)
                if default is not None:
                    fields[python_name(written)] = VariableField(written, default, value.span())
    return fields


def _xacro_fields(source: Source) -> dict[str, VariableField]:
    fields: dict[str, VariableField] = {}
    for element in read_xml(source, Limits()).root.elements():
        argument = format_value(element.attributes.get("name"))
        default = format_value(element.attributes.get("default"))
        if element.name == "xacro:arg" and "$" not in default and "default" in element.attributes:
            fields[argument] = VariableField(argument, value_of_text(default), element.span)
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


def _pairs(node: YamlNode) -> Iterator[tuple[ScalarNode, YamlNode]]:
    """Yield key and value of a mapping, or of each mapping in a list of them."""
    if isinstance(node, SequenceNode):
        for item in node.items:
            if isinstance(item, MappingNode):
                yield from _pairs(item)
    elif isinstance(node, MappingNode):
        yield from node


def _plain_value(node: ScalarNode) -> Value | None:
    """Return the value of a scalar, or None if it is empty, computed, or no finite number."""
    if "$" in node.text:
        return None
    if node.style != PLAIN:
        return node.text
    try:
        value = type_plain(node.text)
    except OverflowError:
        return None
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value if isinstance(value, (bool, int, float, str)) else None
