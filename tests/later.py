"""Modules of judges that are imported when they are first used.

Each run collects all tests at first, and a large process forks slowly, as for each of thousands of
jails: with simulators in it, a jail takes twice as long.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any


class Later:
    """A module, or what it has under a name."""

    def __init__(self, module: str, name: str = "") -> None:
        self._module = module
        self._name = name

    def _found(self) -> Any:
        module = import_module(self._module)
        return getattr(module, self._name) if self._name else module

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):  # which pytest asks all that is in a file
            raise AttributeError(name)
        return getattr(self._found(), name)

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        return self._found()(*arguments, **named)
