"""Notes the values that names and expressions have while a xacro file is expanded."""

from __future__ import annotations

from ..source import Reading
from .places import XacroPlace
from .scope import Scope

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ..xml.tree import Element
    from .statements import Parameter

LONGEST_VALUE = 2000
"""Characters of a value that are noted."""
MOST_VALUES = 20
"""Values that are noted of one place."""

Key = tuple[int, str, int, str]


class Noted:
    """The values of names where they are defined, and of `${…}` and `$(…)` where they are written.

    The name that is noted of an expression is the expression, as it is written.
    """

    __slots__ = ("_values",)

    def __init__(self) -> None:
        """Begin with nothing noted."""
        self._values: dict[Key, tuple[object, dict[str, Reading]]] = {}

    def take_expression(self, place: XacroPlace, start: int, end: int, value: Any) -> None:
        """Note the value of a stretch of what is being evaluated."""
        self._take((id(place.node), place.attribute, start + place.shift, ""), place, "", value,
                   (start, end))  # fmt: skip

    def take_name(self, element: Element, name: str, value: Any) -> None:
        """Note the value of a property or an argument that a tag defines."""
        place = XacroPlace(element, "name", None)
        self._take((id(element), "name", 0, name), place, name, value, None)

    def take_parameter(self, element: Element, parameter: Parameter, value: Any) -> None:
        """Note the value of a parameter in a call of the macro that a tag defines."""
        name, start = parameter.name, parameter.start
        place = XacroPlace(element, "params", None)
        self._take((id(element), "params", start, name), place, name, value,
                   (start, start + len(name)))  # fmt: skip

    def _take(
        self, key: Key, place: XacroPlace, name: str, value: Any, stretch: tuple[int, int] | None
    ) -> None:
        if isinstance(value, Scope) or callable(value):
            return
        known = self._values.get(key)
        if known is None:  # the node is kept, so that no other one gets its identity
            known = self._values[key] = (place.node, {})
        found = known[1]
        if len(found) >= MOST_VALUES:
            return
        try:
            text = str(value)[:LONGEST_VALUE]
        except Exception:  # of an object that the file has made
            return
        if text not in found:
            span = place.span() if stretch is None else place.span(*stretch)
            found[text] = Reading(name or span.written(), text, span)

    def readings(self) -> list[Reading]:
        """Return all of them: the name, the value, and the place."""
        return [reading for _, found in self._values.values() for reading in found.values()]
