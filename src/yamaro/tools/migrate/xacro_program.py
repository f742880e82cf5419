"""What a robot in xacro consists of: its files, macros, properties and arguments, and their names.

The robot is expanded once, which tells which files its includes mean and which expressions are
truth values. All else is read from the files.
"""

from __future__ import annotations

import os
import re

from ...diagnostics import Frame, Reporter
from ...xacro.evaluator import Evaluator
from ...xacro.expansion import Expansion
from ...xacro.parameters import Parameter, parse_parameters
from ...xacro.python import Python
from ...xmltree import Element, Text, format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from typing import Any

    from ...source import Source, Span
    from ...xacro.host import Host

_NAME = re.compile(r"[A-Za-z_]\w*")


class Macro:
    """A macro and the function it becomes.

    Attributes:
        name, function: what they are called.
        parameters: of the macro.
        file: the path of the file it is defined in.
        element: its tag.
    """

    def __init__(self, element: Element, file: str, function: str) -> None:
        """Hold them."""
        self.element = element
        self.name = format_value(element.attributes.get("name")).removeprefix("xacro:")
        self.parameters: list[Parameter] = parse_parameters(
            format_value(element.attributes.get("params", ""))
        )
        self.file = file
        self.function = function

    def values(self) -> list[str]:
        """Return the names of the parameters that are values."""
        return [own.name for own in self.parameters if not own.is_block]

    def blocks(self) -> list[str]:
        """Return the names of the parameters that are blocks, with their stars."""
        return [own.name for own in self.parameters if own.is_block]


class Program:
    """The files of a robot, and what is defined in them.

    Attributes:
        main: the path of the main file.
        roots: the root elements of the files, by path.
        included: the paths that an include means, by the place of its `filename`.
        truths: expressions that were True or False.
        macros: by name.
        arguments: the defaults of the arguments, by name.
        result: what the robot expands to.
    """

    def __init__(self, source: Source, host: Host, arguments: Mapping[str, str]) -> None:
        """Expand a robot and look at its files.

        Raises:
            YamaroError: it cannot be expanded.
        """
        self.main = source.path
        self.given = dict(arguments)
        watch = _Watch(host)
        python = _WatchedPython(host.limits)
        reporter = Reporter()
        evaluator = Evaluator(watch, reporter, python, dict(arguments))
        expansion = Expansion(watch, reporter, evaluator)
        self.result = expansion.expand(source)
        self.values_of_arguments = evaluator.arguments
        self.roots: dict[str, Element] = {source.path: _read(source, host)}
        for path in watch.order:
            if path in expansion.documents:
                self.roots.setdefault(path, expansion.documents[path])
        self.included = watch.included
        self.truths = python.truths
        self.macros: dict[str, Macro] = {}
        self.arguments: dict[str, str] = {}
        self.properties: dict[str, set[str]] = {}
        self.blocks: set[str] = set()
        self._names: dict[str, set[str]] = {}
        for path, root in self.roots.items():
            self._gather(path, root)

    def _gather(self, path: str, root: Element) -> None:
        names = self._names[path] = set()
        for element in walk(root):
            given = {name: format_value(value) for name, value in element.attributes.items()}
            for text in (*given.values(), _own_text(element)):
                if "$" in text or element.name in ("xacro:if", "xacro:unless"):
                    names.update(_NAME.findall(text))
            if element.name.startswith("xacro:"):
                names.add(element.name)
            if element.name == "xacro:macro" and "name" in given:
                name = given["name"].removeprefix("xacro:")
                if name not in self.macros:
                    self.macros[name] = Macro(element, path, self._function_name(name))
            elif element.name == "xacro:arg" and "name" in given:
                self.arguments.setdefault(given["name"], given.get("default", ""))
            elif element.name == "xacro:property" and "name" in given:
                self.properties.setdefault(given["name"], set()).add(path)
                if "value" not in given and "default" not in given and "remove" not in given:
                    self.blocks.add(given["name"])

    def _function_name(self, name: str) -> str:
        stem = camel(name)
        taken = {macro.function for macro in self.macros.values()}
        unique, number = stem, 2
        while unique in taken:
            unique, number = f"{stem}{number}", number + 1
        return unique

    def is_used_elsewhere(self, name: str, path: str) -> bool:
        """Tell whether a name stands in an expression, or a tag, of another file."""
        return any(name in names for other, names in self._names.items() if other != path)


def camel(name: str) -> str:
    """Return a name as that of a function: `wheel_macro` becomes `WheelMacro`."""
    words = [word for word in re.split(r"[^A-Za-z0-9]+", name) if word]
    joined = "".join(word[0].upper() + word[1:] for word in words)
    return joined if joined[:1].isalpha() else f"F{joined}"


def walk(root: Element) -> Iterator[Element]:
    """Return an element and all in it."""
    pending = [root]
    while pending:
        element = pending.pop()
        yield element
        pending += reversed(element.elements())


def _own_text(element: Element) -> str:
    return "".join(format_value(c.value) for c in element.children if isinstance(c, Text))


def _read(source: Source, host: Host) -> Element:
    from ...xmlreader import read_xml

    return read_xml(source, host.limits, exact=True).root


class _Watch:
    """A host that notes which files are read for which includes."""

    def __init__(self, host: Host) -> None:
        self._host = host
        self.limits = host.limits
        self.order: dict[str, None] = {}
        self.included: dict[tuple[str, int], list[str]] = {}

    def read(self, path: str, span: Span) -> Source:
        source = self._host.read(path, span)
        self.order[path] = None
        paths = self.included.setdefault((span.source.path, span.start), [])
        if path not in paths:
            paths.append(path)
        return source

    def glob(self, pattern: str) -> list[str]:
        return self._host.glob(pattern)

    def find_package(self, name: str, span: Span) -> str:
        return self._host.find_package(name, span)

    def environment(self, name: str) -> str | None:
        return self._host.environment(name)

    def folder(self) -> str:
        return self._host.folder()

    def say(self, text: str, span: Span) -> None:
        """Leave out what the robot says while it is looked at."""


class _WatchedPython(Python):
    """Python that notes which expressions are truth values."""

    __slots__ = ("truths",)

    def __init__(self, limits: Any) -> None:
        super().__init__(limits)
        self.truths: set[str] = set()

    def evaluate(self, text: str, names: dict[str, Any]) -> Any:
        value = super().evaluate(text, names)
        if isinstance(value, bool):
            self.truths.add(text.strip())
        return value


def common_folder(paths: list[str]) -> str:
    """Return the deepest folder that holds all of the files."""
    return os.path.commonpath([os.path.dirname(path) for path in paths])


__all__ = ["Frame", "Macro", "Program", "camel", "common_folder", "walk"]
