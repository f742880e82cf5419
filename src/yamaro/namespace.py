"""What an include with `namespace:` gives: the names of a file, as attributes of one name.

Code in safe mode may hold one, so it is among the values that safe mode knows by their exact types.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

MISSING: Any = type("Missing", (), {"__repr__": lambda self: "MISSING"})()
"""The value of a name that nothing has."""


class Namespace:
    """What an include with `namespace:` brought back; read as `$(Legs.index)`, `Legs.BuildLeg:`."""

    def __init__(self, name: str, find: Callable[[str], Any]) -> None:
        """Start empty; `find` looks up global and bridge names."""
        self.__dict__["_name"] = name
        self.__dict__["_find"] = find
        self.__dict__["_names"] = {}

    def _add(self, name: str, value: Any) -> None:
        """Add a name with its value; MISSING for a global or bridge name, looked up later."""
        self._names[name] = value

    def _get(self, name: str) -> Any:
        """Return the value of a name, or MISSING."""
        value = self._names.get(name, MISSING)
        if value is MISSING and name in self._names:
            value = self._find(name)
        return value

    def __getattr__(self, name: str) -> Any:
        value = self._get(name)
        if value is MISSING:
            raise AttributeError(
                f"the namespace '{self._name}' has no '{name}'", name=name, obj=self
            )
        return value

    def __dir__(self) -> list[str]:
        return [name for name in self._names if not name.endswith("()")]

    def __repr__(self) -> str:
        return f"<namespace {self._name}>"
