"""A stand-in for the names of ROS 2's `launch` that `yamaro_ros.substitutions` uses.

It is our own code, and no proof of how launch behaves: launch is neither on PyPI nor in Debian, so
the tests can only show that our side of the interface does what it should.
"""

from __future__ import annotations

import types
from typing import Any


class Substitution:
    """What is replaced by a text while launch runs."""


class SubstitutionFailure(RuntimeError):
    """There is no text for a substitution."""


class Given(Substitution):
    """A substitution that is known: LaunchConfiguration with its value."""

    def __init__(self, text: str) -> None:
        self.text = text

    def describe(self) -> str:
        return repr(self.text)

    def perform(self, context: object) -> str:
        return self.text


class Logger:
    """Remembers what was logged."""

    def __init__(self) -> None:
        self.lines: list[tuple[str, str]] = []

    def __getattr__(self, level: str) -> Any:
        return lambda message: self.lines.append((level, message))


def normalized(value: Any) -> list[Any]:
    """Return text, a substitution, or several of them, as a list of substitutions."""
    values = value if isinstance(value, (list, tuple)) else [value]
    return [Given(each) if isinstance(each, str) else each for each in values]


def modules(logger: Logger, exposed: dict[str, Any]) -> dict[str, types.ModuleType]:
    """Return the modules to put into `sys.modules`."""
    contents: dict[str, dict[str, Any]] = {
        "launch": {
            "LaunchContext": object, "SomeSubstitutionsType": Any, "Substitution": Substitution,
        },
        "launch.frontend": {
            "expose_substitution": lambda name: lambda cls: exposed.setdefault(name, cls)
        },
        "launch.logging": {"get_logger": lambda name: logger},
        "launch.substitutions": {"SubstitutionFailure": SubstitutionFailure},
        "launch.utilities": {
            "normalize_to_list_of_substitutions": normalized,
            "perform_substitutions": lambda context, parts: "".join(
                part.perform(context) for part in parts
            ),
        },
    }  # fmt: skip
    made = {name: types.ModuleType(name) for name in contents}
    for name, content in contents.items():
        vars(made[name]).update(content)
    return made
