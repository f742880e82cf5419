"""What may be passed to a file, without running it: arguments, variables, xacro's arguments."""

from __future__ import annotations

import math
import os
import re

from .diagnostics import Reporter, YamaroError
from .files.loader import LoadError
from .source import Source, holds_xml
from .syntax.argument_section import (
    ANY,
    NUMERIC,
    ArgumentEntry,
    arguments_of,
    checked,
    is_literal,
    literal_value,
    place_of,
    spelling_of,
)
from .syntax.names import python_name
from .xml.reader import decode_xml, read_xml
from .xml.values import format_value
from .yaml.nodes import PLAIN, MappingNode, ScalarNode, SequenceNode, type_plain
from .yaml.reader import read

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from .files.loader import Loader
    from .files.packages import PackageFinder
    from .policy import Limits
    from .source import Span
    from .xacro.symbol_table import Definition
    from .xml.tree import Element
    from .yaml.nodes import YamlNode

ARGUMENTS, VARIABLES, XACRO = "arguments", "variables", "xacro"
"""What a file is found to declare."""


class Declared:
    """Something that may be passed to a file.

    Attributes:
        name: as it is written.
        key: as a build knows it.
        span: where it is declared.
        default_text: the default as it is written; None if there is none.
        default: the default's value, in the argument's unit.
        has_value: whether that is known without running the file.
        default_span: where the default is written.
        entry: what an `arguments` section says, or None.
    """

    __slots__ = (
        "default", "default_span", "default_text", "entry", "has_value", "key", "name", "span",
    )  # fmt: skip

    def __init__(self, name: str, span: Span) -> None:
        """Declare something without a default."""
        self.name = name
        self.key = python_name(name)
        self.span = span
        self.default_text: str | None = None
        self.default: object = None
        self.has_value = False
        self.default_span = span
        self.entry: ArgumentEntry | None = None

    @property
    def is_required(self) -> bool:
        """Return whether the file cannot be run without it."""
        return self.default_text is None


class Listing:
    """What may be passed to a file.

    Attributes:
        kind: `ARGUMENTS`, `VARIABLES` or `XACRO`.
        declared: in the order in which they are written.
        unread: the includes of a xacro file whose names depend on how it runs.
    """

    __slots__ = ("declared", "kind", "unread")

    def __init__(self, kind: str, declared: list[Declared], unread: list[str]) -> None:
        self.kind = kind
        self.declared = declared
        self.unread = unread


def listing_of(
    source: Source, *, loader: Loader, packages: PackageFinder, limits: Limits
) -> Listing:
    """Return what may be passed to a main file.

    Args:
        source: the file.
        loader: gives the files that a xacro file includes.
        packages: finds the packages that they are in.
        limits: how large they may be.

    Raises:
        YamaroError: the file, or its section `arguments`, cannot be read.
    """
    if source.is_xml or holds_xml(source.path or source.name, source.text):
        declared, unread = xacro_arguments(source, loader, packages, limits)
        return Listing(XACRO, declared, unread)
    entries = arguments_of(source)
    if entries is not None:
        return Listing(ARGUMENTS, [declared_of(entry) for entry in entries], [])
    return Listing(VARIABLES, variables_of(source), [])


def declared_names(source: Source) -> list[Declared]:
    """Return all that a YAML file declares in its root: arguments, then variables.

    Raises:
        YamaroError: the file, or its section `arguments`, cannot be read.
    """
    return [*map(declared_of, arguments_of(source) or ()), *variables_of(source)]


def declared_of(entry: ArgumentEntry) -> Declared:
    """Return an argument with its default as the command line would have it."""
    declared = Declared(entry.name, entry.span)
    declared.entry = entry
    value = entry.default
    if value is None:
        return declared
    declared.default_span = place_of(value)
    if not is_literal(value):
        declared.default_text = " ".join(declared.default_span.written().split())
        return declared
    default = checked(entry, literal_value(value), spelling=spelling_of(value))
    declared.has_value = True
    declared.default_text = entry.value_text(default)
    if entry.kind in NUMERIC and isinstance(default, (int, float)):
        default = entry.in_unit(default)
    declared.default = default
    return declared


# --- variables of files without the section -------------------------------------------------------


def variables_of(source: Source) -> list[Declared]:
    """Return the variables in the root of a file, each as it is declared first.

    Only texts, numbers and truth values have a default that is known.

    Raises:
        YamaroError: the file cannot be read.
    """
    found: dict[str, Declared] = {}
    for section, body in _pairs_in(read(source, reporter=Reporter())):
        if section.text != "variables":
            continue
        for key, value in _pairs_in(body):
            name = key.text.partition("/")[0].strip()
            if not name.isidentifier() or python_name(name) in found:
                continue
            declared = found[python_name(name)] = Declared(name, key.span(0, len(name)))
            declared.default_text = " ".join(source.text[value.start : value.end].split())
            declared.default_span = value if isinstance(value, ScalarNode) else value.span()
            plain = _plain_value(value) if isinstance(value, ScalarNode) else None
            declared.default, declared.has_value = plain, plain is not None
    return list(found.values())


def _pairs_in(node: YamlNode) -> Iterator[tuple[ScalarNode, YamlNode]]:
    """Yield key and value of a mapping, or of each mapping in a list of them."""
    if isinstance(node, SequenceNode):
        for item in node.items:
            if isinstance(item, MappingNode):
                yield from _pairs_in(item)
    elif isinstance(node, MappingNode):
        yield from node.pairs


def _plain_value(node: ScalarNode) -> bool | int | float | str | None:
    """Return the value of a scalar, or None if it is empty, computed, or not a finite number."""
    if "$" in node.text:
        return None
    if node.style != PLAIN:
        return node.text
    try:
        value = type_plain(node.text)
    except OverflowError:
        return None
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value if isinstance(value, (bool, int, float, str)) else None


# --- for people -----------------------------------------------------------------------------------


def listing_text(listing: Listing) -> str:
    """Return the listing as text: a line for each argument, and one for what it is about."""
    lines = []
    for declared in listing.declared:
        lines.append(f"{declared.name}:={declared.default_text or ''}")
        notes = about(declared)
        if notes:
            lines.append(f"    {notes}")
    lines += [f"# not read, as its name is computed: {name}" for name in listing.unread]
    return "".join(f"{line}\n" for line in lines)


def about(declared: Declared) -> str:
    """Return the type, range and help of an argument on one line; nothing for a variable."""
    entry = declared.entry
    if entry is None:
        return ""
    words = []
    if declared.is_required:
        words.append("required")
    if entry.choices is not None:
        words.append(" | ".join(entry.choice_texts()))
    elif entry.kind != ANY:
        words.append(entry.kind)
    bounds = entry.range_text()
    if bounds:
        words[-1:] = [f"{words[-1]} {bounds}"]
    elif entry.unit_text:
        words[-1:] = [f"{words[-1]} in {entry.unit_text}"]
    kind = ", ".join(words)
    text = " ".join(entry.help.split())
    return f"{kind}: {text}" if kind and text else kind or text


# --- the arguments of a xacro file and of those it includes -----------------------------------


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
    from .xacro.symbol_table import ARGUMENT, definition_of

    reading = _Reading(loader, packages, limits, source)
    pending = [source]
    while pending:
        current = pending.pop()
        included: list[Source] = []
        for element in read_xml(current, limits).root.iter():
            own = definition_of(element)
            if own is not None and own.kind == ARGUMENT:
                reading.add(own)
            elif element.name == "xacro:include":
                included += reading.included(element, current)
        pending += reversed(included)
    return list(reading.found.values()), list(reading.unread)


class _Reading:
    """What is gathered from a file and its includes."""

    __slots__ = ("_limits", "_loader", "_main", "_packages", "_seen", "found", "unread")

    def __init__(
        self, loader: Loader, packages: PackageFinder, limits: Limits, main: Source
    ) -> None:
        self._loader = loader
        self._packages = packages
        self._limits = limits
        self._main = main
        self.found: dict[str, Declared] = {}
        self.unread: dict[str, None] = {}
        self._seen: set[str] = set()

    def add(self, argument: Definition) -> None:
        name = argument.name
        if not name or "$" in name:
            return
        declared = self.found.get(name)
        if declared is None:
            declared = self.found[name] = Declared(name, argument.element.span)
            declared.key = name
        if "default" in argument.element.attributes and declared.default_text is None:
            declared.default_text = argument.text
            declared.default = declared.default_text
            declared.has_value = "$" not in declared.default_text

    def included(self, element: Element, includer: Source) -> Iterator[Source]:
        """Give the files of an include that can be read; note one whose name is computed."""
        written = format_value(element.attributes.get("filename"))
        name = self._resolved(written, includer)
        if name is None:
            self.unread[written] = None
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
            command, word = match.group(1), match.group(2) or ""
            if command == "dirname":
                answer: str | None = self._folder(self._main)
            elif command == "find":
                answer = self._packages.find(word, self._folder(includer))
            else:
                answer = self.found[word].default_text if word in self.found else None
            if answer is None:
                return None
            text = text[: match.start()] + answer + text[match.end() :]
        return None if "$" in text or "*" in text else text

    @staticmethod
    def _folder(source: Source) -> str:
        return os.path.dirname(source.path) if source.path else os.getcwd()
