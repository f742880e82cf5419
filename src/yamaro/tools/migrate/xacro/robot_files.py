"""The files of a robot in xacro: those that its expansions read, and those they do not reach."""

from __future__ import annotations

import os
import re

from ....diagnostics import YamaroError
from ....xml.tree import Element
from ....xml.values import format_value
from .choices import Choices
from .data import with_plain_units
from .includes import ENDINGS, folder_meant
from .runs import Runs
from .setters import without_setters
from .spellings import Spellings

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from ....source import Source, Span
    from ....xacro.host import Host
    from ....xml.reader import XmlDocument

_NAME = re.compile(r"[A-Za-z_]\w*")


class RobotFiles:
    """The files of a robot.

    Attributes:
        main: the path of the main file.
        documents: the files, by path.
        roots: their root elements.
        data: the texts of other files that were read, by path.
        runs: its expansions, the first with the arguments given.
        untried: the arguments that were changed in no run, as there were too many.
        included: the paths that an include means, by the place of its `filename`.
    """

    def __init__(
        self, source: Source, host: Host, arguments: Mapping[str, str], *, with_others: bool
    ) -> None:
        """Expand a robot, and read its other files; raise YamaroError if it cannot be expanded.

        Args:
            source: the main file.
            host: gives other files and packages.
            arguments: those given.
            with_others: whether other values of the arguments are tried as well.
        """
        self.main = source.path
        self._host = host
        self.untried: list[dict[str, str]] = []
        self._left_behind: dict[tuple[str, int], list[str]] = {}
        self.runs = Runs(_read(source, host), host, arguments)
        self.documents = self.runs.documents
        self.included = self.runs.included
        self._read_the_rest(host)
        if with_others:
            self._try_others()
            self._read_computed()
        self.roots = without_setters(self._roots_read())
        python, names = self.runs.python, self.runs.names
        self.data = {
            path: with_plain_units(text, lambda python_text: python.evaluate(python_text, names))
            for path, text in self.runs.texts.items()
            if path not in self.roots and not path.endswith(ENDINGS)  # a file of a failed run
        }

    def _try_others(self) -> None:
        """Expand the robot with other values of its arguments, one at a time.

        Of what only such a value brings in, other values are tried with that.
        """
        first = self.runs.done[0]
        choices = self.choices()
        others = choices.alternatives(first.values)
        pending = [{name: value} for name, values in others.items() for value in values]
        pending += choices.pairs(first.values)
        while pending and not self.runs.is_spent:
            changed = pending.pop(0)
            known = len(self.documents)
            run = self.runs.add(changed)
            if run is None or len(changed) > 1:
                continue
            new = run.values.keys() - first.values.keys()
            if len(self.documents) > known:
                self._read_the_rest(self._host)
            if new:
                inner = self.choices().alternatives(run.values)
                pending += [
                    {**changed, name: value}
                    for name in sorted(new)
                    for value in inner.get(name, ())
                ]
        self.untried = pending

    def _read_computed(self) -> None:
        """Read the files that includes may mean whose names are computed."""
        choices = self.choices()
        pending = list(self.documents)
        while pending:
            path = pending.pop()
            for text, span in self._names_of_includes(path):
                if "$" not in text:
                    continue
                key = (span.source.path, span.start)
                is_new = key not in self.included
                base = self._base_of(self.runs.named.get(key, {}), os.path.dirname(path))
                named = choices.files_named(text, span, base, by_pattern=is_new)
                named |= Spellings(choices, span).items(text, base)
                for name, found in named.items():
                    if found == self.main or not self._read_file(found, span):
                        continue
                    known = self.included.setdefault(key, [])
                    if found not in known:
                        known.append(found)
                    self.runs.named.setdefault(key, {})[name] = found
        self._read_the_rest(self._host)

    def _base_of(self, named: Mapping[str, str], folder: str) -> str:
        """Return the folder that names of files are relative to: in a macro, that of its caller.

        Args:
            named: the paths that they meant, by the names.
            folder: where the file is that has the names.
        """
        for base in dict.fromkeys([folder, *map(os.path.dirname, self.documents)]):
            if all(os.path.normpath(os.path.join(base, own)) == named[own] for own in named):
                return base
        return folder

    def left_behind(self, include: Element) -> list[str]:
        """Return the files that are not read and that a computed include might mean."""
        span = include.value_span("filename")
        place = span.source.path, span.start
        if place not in self._left_behind:
            text = format_value(include.attributes["filename"])
            known = {self.main, span.source.path, *self.documents, *self.runs.refused}
            possible = Spellings(self.choices(), span).files(text)
            self._left_behind[place] = [path for path in possible if path not in known]
        return self._left_behind[place]

    def is_constant(self, include: Element) -> bool:
        """Return whether the name in an include is the same whatever the arguments are."""
        spellings = Spellings(self.choices(), include.value_span("filename"))
        return spellings.is_constant(format_value(include.attributes["filename"]))

    def choices(self) -> Choices:
        """Return what the files that were read show of the values of arguments."""
        return Choices(self._roots_read(), self._host, self.runs.loaded)

    def _roots_read(self) -> dict[str, Element]:
        return {path: document.root for path, document in self.documents.items()}

    def _read_file(self, path: str, span: Span) -> bool:
        """Read a file if it is not known yet; return whether it is there."""
        if path not in self.documents:
            try:
                self.documents[path] = _read(self._host.read(path, span), self._host)
            except YamaroError:
                return False
        return True

    def files_of(self, include: Element) -> list[str]:
        """Return the paths of the files that an `<xacro:include>` means."""
        if "filename" not in include.attributes:
            return []
        span = include.value_span("filename")
        paths = self.included.get((span.source.path, span.start), [])
        return [path for path in paths if path in self.roots]

    def names_of(self, include: Element) -> dict[str, str]:
        """Return the paths of the files that an include means, by the names computed there."""
        span = include.value_span("filename")
        named = self.runs.named.get((span.source.path, span.start), {})
        return {name: path for name, path in named.items() if path in self.roots}

    def can_be_evaluated(self, node: Element) -> bool | None:
        """Return whether the value of a property can be evaluated; None if no run has shown it."""
        place = (node.span.source.path, node.span.start)
        if place in self.runs.evaluated:
            return True
        return False if place in self.runs.failing else None

    def has_what_it_needs(self, default: str) -> bool:
        """Return whether the packages and the environment are there that a default asks for."""
        for command, name in re.findall(r"\$\((find|env)\s+([^()\s]+)\s*\)", default):
            if "$" in name:
                continue
            is_there = self.finds(name) if command == "find" else self._host.environment(name)
            if is_there is None:
                return False
        return True

    def finds(self, package: str) -> str | None:
        """Return the folder in which a package is found from the main file, or None."""
        known = self.runs.packages.get(package)
        if known is not None:
            return known
        try:
            return self._host.find_package(package, self.roots[self.main].span)
        except YamaroError:
            return None

    def _names_of_includes(self, path: str) -> Iterator[tuple[str, Span]]:
        """Yield the name that each include of a file is written with, and where."""
        for element in self.documents[path].root.iter():
            if element.name == "xacro:include" and "filename" in element.attributes:
                text = format_value(element.attributes["filename"])
                yield text, element.value_span("filename")

    def _read_the_rest(self, host: Host) -> None:
        """Read the files that these arguments do not reach, where their names are plain."""
        pending = list(self.documents)
        while pending:
            path = pending.pop()
            for text, span in self._names_of_includes(path):
                key = (span.source.path, span.start)
                if key in self.included:
                    continue
                found = _plain_path(text, path, host, span)
                if found is None:
                    continue
                is_new = found not in self.documents
                if not self._read_file(found, span):
                    continue
                self.included[key] = [found]
                if is_new:
                    pending.append(found)

    def folder_meant(self, start: str, element: Element, base: str = "") -> str | None:
        """Return the folder that the start of a file's name means.

        Args:
            start: of the name.
            element: where it is written.
            base: the folder that names are relative to; by default that of the file.
        """
        base = base or os.path.dirname(element.span.source.path)
        return folder_meant(start, base, self._host, element.span)


def _plain_path(filename: str, includer: str, host: Host, span: Span) -> str | None:
    """Return the path that an include means whatever the names in it mean, or None."""
    packages = re.findall(r"\$\(find ([\w-]+)\)", filename)
    try:
        for name in packages:
            filename = filename.replace(f"$(find {name})", host.find_package(name, span))
    except YamaroError:
        return None
    path = os.path.normpath(os.path.join(os.path.dirname(includer), filename))
    return path if "$" not in path and os.path.isfile(path) else None


def _read(source: Source, host: Host) -> XmlDocument:
    from ....xml.reader import read_xml

    return read_xml(source, host.limits, exact=True)
