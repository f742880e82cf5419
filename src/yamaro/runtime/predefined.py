"""The names every expression sees: mathematics, and helpers that depend on the file."""

from __future__ import annotations

import builtins
import math
import os

from ..diagnostics import InputFault, Reporter, did_you_mean
from ..files.loader import LoadError, decode
from ..files.packages import MOST_PLACES
from ..syntax.context import ParseContext
from ..syntax.names import FACTORS
from ..syntax.nodes import Constant, DictValue, ListValue
from ..syntax.values import parse_value
from ..yaml.nodes import type_plain
from ..yaml.reader import read

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from ..files.packages import PackageFinder
    from ..syntax.nodes import Value
    from .files import Library

MATHEMATICS = (
    "pi tau e sin cos tan asin acos atan atan2 sqrt hypot radians degrees floor ceil fabs log exp"
).split()
CONSTANTS = {
    **vars(builtins),
    "true": True,
    "false": False,
    "null": None,
    **{name: getattr(math, name) for name in MATHEMATICS},
    **FACTORS,
}
TARGET = "urdf"
"""The output format that is written by default; expressions read it as `target`."""
_REQUIRED: Any = object()


class Helpers:
    """The helpers of one file: relative paths start at its folder."""

    __slots__ = ("_directory", "_library", "_note_file", "_packages", "_target")

    def __init__(
        self,
        directory: str,
        library: Library,
        packages: PackageFinder,
        note_file: Callable[[str], None],
        *,
        target: str = TARGET,
    ) -> None:
        """Serve a file in `directory`; `note_file` is called with every file read."""
        self._directory = directory
        self._library = library
        self._packages = packages
        self._note_file = note_file
        self._target = target

    def names(self) -> dict[str, Any]:
        """Return the helpers by the names expressions call them."""
        return {
            "load_yaml": self.load_yaml,
            "find": self.find,
            "env": self.env,
            "file_dir": lambda: self._directory,
            "dirname": self._directory,
            "cwd": os.getcwd(),
            "target": self._target,
            "__find__": self.find,
            "__env__": self.env,
        }

    def load_yaml(self, path: str) -> Any:
        """Return the data in a YAML file as dicts, lists and scalars; nothing is evaluated.

        Numbers with a unit, such as `!degrees 90`, are converted. Where a key comes again, its last
        value counts, as for other readers of YAML.
        """
        text = os.fspath(path)
        absolute = self._packages.resolve_uri(text, self._directory)
        if absolute is None:
            raise self._nowhere(text)
        try:
            data = self._library.loader.read(absolute)
        except LoadError as error:
            hint: str | None = error.hint
            if hint is None:
                neighbours = self._library.loader.neighbours(absolute)
                near = did_you_mean(os.path.basename(absolute), neighbours)
                hint = near or f"searched for {absolute}"
            message = f"the file '{text}' cannot be read: {error}"
            raise InputFault(error.code, message, hint) from None
        self._note_file(absolute)
        source = decode(data, name=text, path=absolute)
        reporter = Reporter()
        rules = self._library.rules
        root = read(source, reporter=reporter, limits=rules.limits, units=True)
        value = parse_value(root, ParseContext(reporter, rules), is_literal=True)
        return plain_data(value, gather=dict)

    def _nowhere(self, uri: str) -> InputFault:
        """Return the fault of a URI that leads nowhere."""
        scheme, _, rest = uri.partition("://")
        if scheme.lower() in ("package", "model"):
            return self._unknown_package(rest.partition("/")[0])
        return InputFault(
            "missing-file",
            f"'{scheme}://' cannot be read: files are not downloaded",
            "save the file locally and read it with a path or package://",
        )

    def find(self, package: str) -> str:
        """Return the folder of a ROS package."""
        found = self._packages.find(package, self._directory)
        if found is None:
            raise self._unknown_package(package)
        return found

    def _unknown_package(self, package: str) -> InputFault:
        """Return the fault of a package that is nowhere."""
        places = self._packages.looked_at(package, self._directory)[:MOST_PLACES]
        hint = self._packages.hint_for(package, self._directory)
        return InputFault(
            "unknown-package",
            f"the package '{package}' is not found",
            (f"searched in {', '.join(places)}; " if places else "") + hint,
        )

    def env(self, name: str, default: Any = _REQUIRED) -> Any:
        """Return an environment variable, or the default if there is one.

        With a default that is a number or truth value, such a text is read as one.
        """
        value: Any = os.environ.get(name)
        if value is None:
            value = default
        elif value and isinstance(default, (bool, int, float)):
            value = type_plain(value)
        if value is _REQUIRED:
            raise InputFault(
                "unset-environment",
                f"the environment variable '{name}' is not set",
                f"set it, or give a default: env('{name}', 'default')",
            )
        return value


def gather_pairs(pairs: list[tuple[Any, Any]]) -> dict[Any, Any]:
    """Return a dict of pairs; a key that stands several times has the list of its values."""
    gathered: dict[Any, list[Any]] = {}
    for key, value in pairs:
        gathered.setdefault(key, []).append(value)
    return {key: values[0] if len(values) == 1 else values for key, values in gathered.items()}


def plain_data(
    value: Value, gather: Callable[[list[tuple[Any, Any]]], dict[Any, Any]] = gather_pairs
) -> Any:
    """Return a value without expressions as Python data; `gather` makes a dict of pairs."""
    if isinstance(value, Constant):
        return value.value
    if isinstance(value, ListValue):
        return [plain_data(item, gather) for item in value.items]
    assert isinstance(value, DictValue)
    pairs = [(plain_data(key, gather), plain_data(item, gather)) for key, item in value.pairs]
    return gather(pairs)
