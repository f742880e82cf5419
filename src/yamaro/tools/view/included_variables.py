"""The variables of a robot that no build takes: those of included files, and computed ones."""

from __future__ import annotations

import os
import re

from ...diagnostics import YamaroError
from ...files.loader import LoadError, decode
from ...source import Source
from ...syntax.names import python_name
from ..declared_arguments import declared_names
from .variable_fields import ArgumentField

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping

    from ...files.loader import Loader
    from ...source import Reading, Span
    from ..declared_arguments import Declared
    from .origins import Places
    from .variable_fields import VariableField

    Json = dict[str, object]

_PASSED_ON = re.compile(r"\s*:\s*(['\"]?)\$\(\s*([^\W\d]\w*)\s*\)\1\s*(?:[,}\n#]|$)")
"""What follows the name of an include's argument whose value is a variable as it is."""
LONGEST_TEXT = 200
"""Characters of an expression that are shown."""
MOST_STEPS = 20
"""Includes through which a variable is followed to the main file."""


class IncludedVariables:
    """The variables in the roots of files, with the values that they had in a build."""

    def __init__(
        self, noted: Iterable[Reading], main: str, fields: Mapping[str, VariableField]
    ) -> None:
        """Take what a build noted.

        Args:
            noted: the values of names where they are declared.
            main: the path of the main file.
            fields: the variables of the main file that a build takes, as it knows them.
        """
        self._main = main
        self._fields = fields
        self._has_arguments = any(isinstance(each, ArgumentField) for each in fields.values())
        self._noted: dict[str, list[Reading]] = {}
        for reading in noted:
            if reading.span is not None and reading.span.source.path:
                self._noted.setdefault(reading.span.source.path, []).append(reading)

    def data(self, loader: Loader, places: Places) -> list[Json]:
        """Return the variables by file, the main file first, as data for JSON."""
        found: list[Json] = []
        for path in sorted(self._noted, key=lambda each: each != self._main):
            rows = [
                self._row(declared, readings, places)
                for declared in _declared_in(path, loader)
                if not (path == self._main and declared.key in self._fields)
                and (readings := self._readings_of(path, declared))
            ]
            if rows:
                found.append({"file": _shown(path, self._main), "variables": rows})
        return found

    def _readings_of(self, path: str, declared: Declared) -> list[Reading]:
        start = declared.span.start
        return [
            reading
            for reading in self._noted[path]
            if python_name(reading.name) == declared.key
            and reading.span is not None
            and reading.span.start == start
        ]

    def _row(self, declared: Declared, readings: list[Reading], places: Places) -> Json:
        given = {id(each.given): each.given for each in readings if each.given is not None}
        follows = {self._followed(span) for span in given.values()}
        follow = follows.pop() if len(follows) == 1 else None
        row: Json = {
            "name": declared.name,
            "values": list(dict.fromkeys(reading.value for reading in readings)),
            "why": self._why_fixed(declared, list(given.values())),
            **_place(declared.span, places),
        }
        return row if follow is None else {**row, "follows": follow}

    def _why_fixed(self, declared: Declared, given: list[Span]) -> str:
        """Return why a build cannot be given a value of a variable."""
        name, file = declared.name, os.path.basename(declared.span.source.path)
        is_main = declared.span.source.path == self._main
        is_computed = declared.default_text is not None and not declared.has_value
        if given:
            return f"set at {', '.join(map(_place_of, given))}"
        if is_main and self._has_arguments:
            return f"{file} declares arguments, and a build takes no other names: declare it there"
        if is_computed:
            replaced = f"; {name}:=… on the command line replaces that" if is_main else ""
            return f"computed: {_cut(declared.default_text or '')}{replaced}"
        if is_main:
            return f"{name}:=… on the command line sets it"
        return f"private to {file}: the file that includes it can pass {name}: …"

    def _followed(self, span: Span | None) -> str | None:
        """Return the field of the main file that decides what is given at a place, or None."""
        for _ in range(MOST_STEPS):
            if span is None:
                return None
            text, path = span.source.text, span.source.path
            name = text[span.start : span.end].partition("/")[0].strip()
            passed = _PASSED_ON.match(text, span.end)
            if passed is not None:
                name = passed.group(2)
            elif not self._is_declaration(span):
                return None
            if path == self._main:
                return name if python_name(name) in self._fields else None
            noted = self._noted.get(path, ())
            span = next((each.given for each in noted if each.name == name and each.given), None)
        return None

    def _is_declaration(self, span: Span) -> bool:
        """Return whether a variable is declared at a place, rather than passed there."""
        noted = self._noted.get(span.source.path, ())
        return any(each.span is not None and each.span.start == span.start for each in noted)


def has_others(source: Source, fields: Collection[str]) -> bool:
    """Return whether a YAML file declares more in its root than the fields of a page.

    Raises:
        YamaroError: the file cannot be read.
    """
    return any(each.key not in fields for each in declared_names(source))


def _declared_in(path: str, loader: Loader) -> list[Declared]:
    """Return what a YAML file declares in its root; nothing of a file that is gone."""
    try:
        text = decode(loader.read(path), name=path, path=path).text
        return declared_names(Source(text, name=path, path=path))
    except (LoadError, YamaroError):
        return []


def _place(span: Span, places: Places) -> Json:
    return {"place": places.number(span), "text": span.place()}


def _place_of(span: Span) -> str:
    return f"{os.path.basename(span.source.path or span.source.name)}:{span.location()[0]}"


def _cut(text: str) -> str:
    return text if len(text) <= LONGEST_TEXT else f"{text[:LONGEST_TEXT]}…"


def _shown(path: str, main: str) -> str:
    """Return a path relative to the main file's folder where that is not longer."""
    try:
        relative = os.path.relpath(path, os.path.dirname(main))
    except ValueError:  # on another drive
        return path
    return min(relative, path, key=len)
