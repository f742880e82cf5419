"""The arguments of a xacro file and of those it includes, read without running it."""

from __future__ import annotations

import os
import re

from ..diagnostics import YamaroError
from ..files.loader import LoadError
from ..source import Source
from ..xml.reader import decode_xml, read_xml
from ..xml.values import format_value
from .declared_arguments import Declared

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..files.loader import Loader
    from ..files.packages import PackageFinder
    from ..policy import Limits
    from ..xml.tree import Element

_ARGUMENT = "xacro:arg"
_INCLUDE = "xacro:include"
_COMMAND = re.compile(r"\$\((find|arg|dirname)(?: +([\w./-]+))?\)")


def xacro_arguments(
    source: Source, loader: Loader, packages: PackageFinder, limits: Limits
) -> tuple[list[Declared], list[str]]:
    """Return the arguments of a xacro file with their defaults, and the includes not followed.

    Includes are followed whose names are the same in each run, or depend on defaults of arguments.
    As in xacro, the first default of an argument counts.

    Raises:
        YamaroError: the main file is not XML.
    """
    return _Reading(loader, packages, limits, source).run(source)


class _Reading:
    """What is gathered from a file and its includes."""

    __slots__ = ("_found", "_limits", "_loader", "_main", "_packages", "_seen", "_unread")

    def __init__(
        self, loader: Loader, packages: PackageFinder, limits: Limits, main: Source
    ) -> None:
        self._loader = loader
        self._packages = packages
        self._limits = limits
        self._main = main
        self._found: dict[str, Declared] = {}
        self._unread: dict[str, None] = {}
        self._seen: set[str] = set()

    def run(self, source: Source) -> tuple[list[Declared], list[str]]:
        """Read the main file, then what it includes."""
        pending = [source]
        while pending:
            current = pending.pop()
            included: list[Source] = []
            for element in _below(read_xml(current, self._limits).root):
                if element.name == _ARGUMENT:
                    self._add(element)
                elif element.name == _INCLUDE:
                    included += self._included(element, current)
            pending += reversed(included)
        return list(self._found.values()), list(self._unread)

    def _add(self, element: Element) -> None:
        name = format_value(element.attributes.get("name"))
        if not name or "$" in name:
            return
        declared = self._found.get(name)
        if declared is None:
            declared = self._found[name] = Declared(name, element.span)
            declared.key = name
        default = element.attributes.get("default")
        if default is not None and declared.default_text is None:
            declared.default_text = format_value(default)
            declared.default = declared.default_text
            declared.has_value = "$" not in declared.default_text

    def _included(self, element: Element, includer: Source) -> Iterator[Source]:
        """Give the files of an include that can be read; note one whose name is computed."""
        written = format_value(element.attributes.get("filename"))
        name = self._resolved(written, includer)
        if name is None:
            self._unread[written] = None
            return
        path = os.path.normpath(os.path.join(self._folder(includer), name))
        if path in self._seen or len(self._seen) >= self._limits.files:
            return
        self._seen.add(path)
        try:
            source = decode_xml(self._loader.read(path), name=path, path=path)
            read_xml(source, self._limits)
        except (LoadError, YamaroError):
            return  # it may be under a condition; the build reports it
        yield source

    def _resolved(self, text: str, includer: Source) -> str | None:
        """Return the name of a file, or None if it depends on more than packages and defaults."""
        for _ in range(len(text)):
            match = _COMMAND.search(text)
            if match is None:
                break
            answer = self._answer(match.group(1), match.group(2) or "", includer)
            if answer is None:
                return None
            text = text[: match.start()] + answer + text[match.end() :]
        return None if "$" in text or "*" in text else text

    def _answer(self, command: str, word: str, includer: Source) -> str | None:
        if command == "dirname":
            return self._folder(self._main)
        if command == "find":
            return self._packages.find(word, self._folder(includer))
        declared = self._found.get(word)
        return declared.default_text if declared is not None else None

    @staticmethod
    def _folder(source: Source) -> str:
        return os.path.dirname(source.path) if source.path else os.getcwd()


def _below(root: Element) -> Iterator[Element]:
    """Yield the elements below a root, in document order."""
    pending = list(reversed(root.elements()))
    while pending:
        element = pending.pop()
        yield element
        pending += reversed(element.elements())
