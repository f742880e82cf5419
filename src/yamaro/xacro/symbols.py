"""The names that every expression of a xacro file sees."""

from __future__ import annotations

import builtins
import math

from .scope import Names
from .yaml_values import YamlDict

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any, Protocol

    class Actions(Protocol):
        """What the functions of the namespace `xacro` do."""

        def load_yaml(self, filename: str) -> Any:
            """Return what a YAML file holds."""

        def abs_filename(self, filename: str) -> str:
            """Return a path that is relative to the file being read."""

        def argument(self, name: str) -> str:
            """Return an argument of the file."""

        def tell(self, kind: str, text: str) -> None:
            """Show a message, a warning or an error."""

        def tell_location(self) -> None:
            """Show which macros and files led here."""

        def give_up(self, text: str) -> Any:
            """Raise an error."""

        def tell_deprecated(self, name: str, replacement: str) -> None:
            """Warn of a name that is going out of use."""


_EVERYWHERE = (
    "list dict map len str float int bool True False min max round".split()  # in xacro's order
)
_IN_PYTHON = (
    "abs all any complex divmod enumerate filter frozenset hash isinstance issubclass ord repr "
    "reversed slice set sum tuple type vars zip sorted range"
).split()
_DEPRECATED = ("sorted", "range")


def predefined(actions: Actions) -> dict[str, Any]:
    """Return the names, most of them in the namespaces math, python and xacro as well."""
    mathematics = {name: value for name, value in vars(math).items() if name[0] != "_"}
    python: dict[str, Any] = {
        name: getattr(builtins, name, None) for name in _EVERYWHERE + _IN_PYTHON
    }
    python["True"], python["False"] = True, False
    own = _functions(actions)
    names: dict[str, Any] = {"__builtins__": {}}
    names.update({name: python[name] for name in _EVERYWHERE})
    names.update(mathematics)
    for name in _DEPRECATED:
        names[name] = _deprecated(python[name], name, f"python.{name}", actions)
    for name in ("load_yaml", "abs_filename", "dotify"):
        names[name] = _deprecated(own[name], name, f"xacro.{name}", actions)
    names.update(math=Names(mathematics), python=Names(python), xacro=Names(own))
    return names


def _deprecated(
    function: Callable[..., Any], name: str, replacement: str, actions: Actions
) -> Callable[..., Any]:
    def call(*args: Any, **keywords: Any) -> Any:
        actions.tell_deprecated(name, replacement)
        return function(*args, **keywords)

    return call


def _functions(actions: Actions) -> dict[str, Any]:
    def teller(kind: str, with_location: bool) -> Callable[..., str]:
        def tell(*args: Any, print_location: bool = with_location, **_style: Any) -> str:
            actions.tell(kind, " ".join(map(str, args)))
            if print_location:
                actions.tell_location()
            return ""

        return tell

    def print_location() -> str:
        actions.tell_location()
        return ""

    def fatal(*args: Any) -> Any:
        return actions.give_up(" ".join(map(str, args)))

    return {
        "load_yaml": actions.load_yaml,
        "abs_filename": actions.abs_filename,
        "arg": actions.argument,
        "dotify": YamlDict,
        "tokenize": tokenize,
        "message": teller("message", False),
        "warning": teller("warning", True),
        "error": teller("error", True),
        "print_location": print_location,
        "fatal": fatal,
    }


def tokenize(s: str, sep: str = ",; ", skip_empty: bool = True) -> list[str]:
    """Return a text split at each of the characters `sep`; the names are those of xacro."""
    import re

    words = re.split(f"[{sep}]", s)
    return [word for word in words if word] if skip_empty else words
