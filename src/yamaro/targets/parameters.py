"""YAML as ROS reads parameters from it, and as PyYAML reads it for MoveIt: both to the same values.

ROS has types: a double is written with a point, and a text that could be read as another type, by
YAML 1.1 too, is in quotes.
"""

from __future__ import annotations

from math import isfinite

from ..xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ..model.controllers import Parameter

_RESERVED = frozenset(("true", "false", "yes", "no", "on", "off", "y", "n", "null", "nan", "inf"))
_PLAIN = frozenset("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./")


class Remark:
    """A value with a comment after it."""

    __slots__ = ("comment", "value")

    def __init__(self, value: Parameter, comment: str) -> None:
        """Hold both; the comment is on one line."""
        self.value = value
        self.comment = comment


def yaml_of(mapping: Mapping[str, object], indent: str = "") -> str:
    """Return a mapping as YAML in block style; rows of numbers are in brackets."""
    if not mapping:
        return f"{indent}{{}}\n"
    lines: list[str] = []
    for name, value in mapping.items():
        comment = ""
        if isinstance(value, Remark):
            comment, value = f"  # {value.comment}", value.value
        key = f"{indent}{text_of(name)}:"
        if isinstance(value, dict) and value:
            lines += [key + comment, yaml_of(value, indent + "  ").rstrip("\n")]
        elif isinstance(value, list) and not _is_row(value):
            lines.append(key + comment)
            lines += [_item(each, indent + "  ") for each in value]
        else:
            lines.append(f"{key} {scalar_of(value)}{comment}")
    return "\n".join(lines) + "\n"


def _is_row(values: Sequence[object]) -> bool:
    """Return whether a list is written in brackets: an empty one, or one of numbers."""
    return all(isinstance(each, (bool, int, float)) for each in values)


def _item(value: object, indent: str) -> str:
    if isinstance(value, dict) and value:
        inner = yaml_of(value, indent + "  ").rstrip("\n")
        return f"{indent}- {inner.lstrip(' ')}"
    return f"{indent}- {scalar_of(value)}"


def scalar_of(value: object) -> str:
    """Return a value on one line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        # A double, with 15 digits and always with a point: YAML 1.1 wants one before `e`.
        if not isfinite(value):
            return ".nan" if value != value else ".inf" if value > 0 else "-.inf"
        text = format_value(value)
        number, mark, exponent = text.partition("e")
        if "." not in number:
            number += ".0"
        if mark and exponent[:1] not in "+-":
            exponent = f"+{exponent}"
        return number + mark + exponent
    if isinstance(value, list):
        return f"[{', '.join(map(scalar_of, value))}]"
    if isinstance(value, dict):
        inner = ", ".join(f"{text_of(name)}: {scalar_of(each)}" for name, each in value.items())
        return f"{{{inner}}}"
    return text_of(str(value))


def text_of(text: str) -> str:
    """Return a text, in double quotes unless all readers take it for that text without."""
    is_plain = (
        text[:1].isalpha()
        and text.isascii()
        and _PLAIN.issuperset(text)
        and text.casefold() not in _RESERVED
    ) or (text[:1] in ("/", "_") and len(text) > 1 and _PLAIN.issuperset(text) and text.isascii())
    if is_plain:
        return text
    import json

    quoted = json.dumps(text, ensure_ascii=False)
    if quoted.isprintable():
        return quoted
    return "".join([each if each.isprintable() else f"\\U{ord(each):08x}" for each in quoted])
