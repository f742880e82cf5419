"""Names that have the same number wherever they are read, such as `pi` and `deg_to_rad`."""

from __future__ import annotations

import math
import re

from ....xml.values import format_value
from ..degrees import Degrees

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .program import XacroProgram

_NAME = re.compile(r"[^\W\d]\w*")
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
    made_of = {name: pending.keys() & set(_NAME.findall(text)) for name, text in pending.items()}
    readers: dict[str, list[str]] = {}
    for name, others in made_of.items():
        for other in others:
            readers.setdefault(other, []).append(name)
    degrees = Degrees(found)
    ready = [name for name in pending if not made_of[name]]
    for name in ready:  # grows meanwhile, by what is made of numbers that are known
        text = pending[name]
        is_expression = text.startswith("${") and text.find("}") == len(text) - 1
        number = degrees.value(f"$({text[2:-1]})" if is_expression else text)
        if number is None:
            continue
        found[name] = number
        for reader in readers.get(name, ()):
            made_of[reader].discard(name)
            if not made_of[reader]:
                ready.append(reader)
    return found


def _properties(program: XacroProgram) -> dict[str, str]:
    """Return the values of the properties that are at the top of a file."""
    return {
        format_value(element.attributes["name"]): format_value(element.attributes["value"]).strip()
        for root in program.roots.values()
        for element in root.elements()
        if element.name == "xacro:property" and {"name", "value"} <= element.attributes.keys()
    }
