"""Names that have the same number wherever they are read, such as `pi` and `deg_to_rad`."""

from __future__ import annotations

import math

from ....xml.values import format_value
from ..degrees import Degrees

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .program import XacroProgram

_PREDEFINED = {"pi": math.pi, "tau": math.tau}


def known_numbers(program: XacroProgram) -> dict[str, float]:
    """Return `pi`, `tau` and the properties of files that are defined once, as numbers."""
    others = {*program.arguments, *program.assigned_from_inside}
    others = others.union(*(macro.values() for macro in program.definitions.values()))
    found = {
        name: number
        for name, number in _PREDEFINED.items()
        if name not in others and name not in program.properties
    }
    pending = {
        name: text
        for name, text in _properties(program).items()
        if program.times_defined[name] == 1 and name not in others
    }
    count = -1
    while len(found) > count:
        count = len(found)
        degrees = Degrees(found)
        for name, text in list(pending.items()):
            is_expression = text.startswith("${") and text.find("}") == len(text) - 1
            number = degrees.value(f"$({text[2:-1]})" if is_expression else text)
            if number is not None:
                found[name] = number
                del pending[name]
    return found


def _properties(program: XacroProgram) -> dict[str, str]:
    """Return the values of the properties that are at the top of a file."""
    return {
        format_value(element.attributes["name"]): format_value(element.attributes["value"]).strip()
        for root in program.roots.values()
        for element in root.elements()
        if element.name == "xacro:property" and {"name", "value"} <= element.attributes.keys()
    }
