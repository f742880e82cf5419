"""Expansions of a robot in xacro with several sets of arguments, and what they show of it.

What no run reaches is only read. So the robot is expanded with other values of its arguments, too:
that shows which files computed includes mean, and which expressions give truth values.
"""

from __future__ import annotations

import os

from ....diagnostics import Reporter, YamaroError
from ....xacro.evaluator import Python, XacroEvaluator, YamlList
from ....xacro.expansion import Expansion
from ....xacro.scope import Lazy, Scope
from ....xacro.templates import guess_value
from ....xml.values import format_number

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from typing import Any

    from ....source import Source, Span
    from ....xacro.host import Host
    from ....xml.reader import XmlDocument
    from ....xml.tree import Element

MOST_RUNS = 48
"""How many sets of arguments are tried."""
MOST_ELEMENTS = 400_000
"""How many elements and texts all of them may walk through together."""

_TRUTH_TEXTS = ("true", "True", "1", "false", "False", "0")

FileOffset = tuple[str, int]


class Run:
    """One expansion.

    Attributes:
        changed: the arguments whose values are not those of the first run.
        arguments: all that are given.
        values: what the arguments are, with their defaults.
        result: what the robot expands to.
    """

    __slots__ = ("arguments", "changed", "result", "values")

    def __init__(
        self,
        changed: Mapping[str, str],
        arguments: Mapping[str, str],
        values: Mapping[str, str],
        result: Element,
    ) -> None:
        self.changed = dict(changed)
        self.arguments = dict(arguments)
        self.values = dict(values)
        self.result = result


class Runs:
    """The expansions of a robot.

    Attributes:
        done: those without an error; the first is that with the arguments given.
        documents: the files that were included, by path.
        included: the paths that each include meant, by the place of its `filename`.
        named: those paths by the names they were given there.
        python: evaluates the expressions, and notes what they gave.
        texts: all that was read, by path.
        packages: the folders of the packages that were asked for, by name.
        bases: the folders that names of data are relative to, by the file that names them.
        relative: the data that is named so.
        evaluated: the places of properties that could be evaluated in some run.
        failing: those of properties that could not, and were read in none.
        refused: the paths that were included where that ended in an error, whatever the arguments.
        loaded: the texts in the data that was loaded.
        names: those that are predefined.
    """

    def __init__(self, document: XmlDocument, host: Host, given: Mapping[str, str]) -> None:
        """Expand the robot with the arguments given; raise YamaroError if that fails."""
        self._root = document.root
        self._source = document.root.span.source
        self._given = dict(given)
        self._watch = Watch(host)
        self._left = MOST_ELEMENTS
        self.python = WatchedPython(host.limits)
        self.texts = self._watch.texts
        self.packages = self._watch.packages
        self.bases: dict[str, set[str]] = {}
        self.relative: set[str] = set()
        self.evaluated: set[FileOffset] = set()
        self.failing: set[FileOffset] = set()
        self.refused: set[str] = set()
        self.loaded: dict[str, None] = {}
        self.documents: dict[str, XmlDocument] = {self._source.path: document}
        self.included: dict[FileOffset, list[str]] = {}
        self.named: dict[FileOffset, dict[str, str]] = {}
        self.done: list[Run] = []
        self._parsed: dict[str, XmlDocument] = {self._source.path: document}
        self._expand({})

    @property
    def is_spent(self) -> bool:
        """Return whether no further set of arguments may be tried."""
        return len(self.done) >= MOST_RUNS or self._left <= 0

    def add(self, changed: Mapping[str, str]) -> Run | None:
        """Expand the robot with some arguments changed; None if that fails."""
        try:
            return self._expand(changed)
        except YamaroError:
            return None

    def _expand(self, changed: Mapping[str, str]) -> Run:
        reporter = Reporter()
        given = self._given | dict(changed)
        evaluator = WatchedEvaluator(self._watch, reporter, self.python, given)
        evaluator.bases, evaluator.relative = self.bases, self.relative
        expansion = WatchedExpansion(self._watch, reporter, evaluator)
        expansion.documents.update(self._parsed)
        try:
            result = expansion.expand(self._source, self._root)
        except YamaroError as error:
            if all(each.code != "xacro-undefined" for each in error.diagnostics):
                paths = [path for own in expansion.included.values() for path in own]
                self.refused.update(map(os.path.abspath, paths))
            raise
        finally:
            self._left -= expansion.walked
            self.loaded |= evaluator.loaded
        self._evaluate_the_rest(expansion)
        self.names = evaluator.names
        self._parsed |= expansion.documents
        for document in expansion.documents.values():
            self.documents.setdefault(document.root.span.source.path, document)
        for place, names in expansion.named.items():
            meant = {name: os.path.abspath(path) for name, path in names.items()}
            self.named.setdefault(place, {}).update(meant)
        for place, paths in expansion.included.items():
            known = self.included.setdefault(place, [])
            known += [path for path in map(os.path.abspath, paths) if path not in known]
        values = {
            name: own for name, own in evaluator.arguments.items() if name
        }  # none can be given as ""
        self.done.append(Run(changed, given, values, result))
        return self.done[-1]

    def _evaluate_the_rest(self, expansion: WatchedExpansion) -> None:
        """Evaluate the properties that nothing has read, as the language does."""
        for scope in expansion.scopes:
            for name in list(scope.lazy):
                if name not in scope.lazy:  # another one has read it meanwhile
                    continue
                span = scope.lazy[name].place.node.span
                try:
                    scope[name]
                except (YamaroError, RecursionError):
                    self.failing.add((span.source.path, span.start))
        self.evaluated |= expansion.evaluator.evaluated
        self.failing -= self.evaluated


class WatchedExpansion(Expansion):
    """An expansion that keeps the scopes it makes."""

    evaluator: WatchedEvaluator

    def scope(self, parent: dict[str, object]) -> Scope:
        """Return a new scope in another."""
        made = super().scope(parent)
        self.scopes.append(made)
        return made

    @property
    def scopes(self) -> list[Scope]:
        """Return the scopes that were made."""
        return self.evaluator.scopes


class Watch:
    """A host that keeps the texts of the files that are read."""

    def __init__(self, host: Host) -> None:
        """Ask another host."""
        self._host = host
        self.limits = host.limits
        self.texts: dict[str, str] = {}
        self.packages: dict[str, str] = {}

    def read(self, path: str, span: Span) -> Source:
        """Return the text of a file."""
        source = self._host.read(path, span)
        self.texts[source.path] = source.text
        return source

    def glob(self, pattern: str) -> list[str]:
        """Return the paths that a pattern of the shell matches."""
        return self._host.glob(pattern)

    def find_package(self, name: str, span: Span) -> str:
        """Return the folder of a package."""
        folder = self.packages[name] = self._host.find_package(name, span)
        return folder

    def environment(self, name: str) -> str | None:
        """Return a variable of the environment, or None if it is not set."""
        return self._host.environment(name)

    def folder(self) -> str:
        """Return the current folder."""
        return self._host.folder()

    def say(self, text: str, span: Span) -> None:
        """Take what the robot says."""
        self._host.say(text, span)


class WatchedEvaluator(XacroEvaluator):
    """An evaluator that notes which data is named by relative paths; see `Runs`."""

    bases: dict[str, set[str]]
    relative: set[str]

    def __init__(
        self, host: Host, reporter: Reporter, python: Python, arguments: Mapping[str, str]
    ) -> None:
        """Begin outside of all files."""
        super().__init__(host, reporter, python, arguments)
        self.scopes: list[Scope] = []
        self.evaluated: set[FileOffset] = set()
        self.loaded: dict[str, None] = {}

    def resolve(self, scope: Scope, name: str, lazy: Lazy) -> Any:
        """Return the value of a property that is needed for the first time, and keep it."""
        value = super().resolve(scope, name, lazy)
        span = lazy.place.node.span
        self.evaluated.add((span.source.path, span.start))
        return value

    def load_yaml(self, filename: str) -> Any:
        """Return what a YAML file holds."""
        if not os.path.isabs(filename):
            written = self.place.node.span.source.path
            folder = os.path.dirname(os.path.abspath(self.files[-1]))
            self.bases.setdefault(written, set()).add(folder)
            self.relative.add(os.path.abspath(self.abs_filename(filename)))
        value = super().load_yaml(filename)
        self.loaded |= dict.fromkeys(_texts_in(value))
        return value


def _texts_in(value: object) -> Iterator[str]:
    """Return the texts in data, and its numbers as texts."""
    if isinstance(value, dict):
        value = [*value.values()]
    if isinstance(value, list):
        for each in value:
            yield from _texts_in(each)
    elif isinstance(value, (str, int)):
        yield str(value)


class WatchedPython(Python):
    """Python that notes which expressions are truth values, or numbers of some kind.

    Attributes:
        evaluated: all expressions.
        truths: those that were truth values or lists, which Python shows in its own way.
        floats: those that gave a float.
        long_floats: those of them that the language writes with fewer digits.
        others: those that gave something else than a number.
        numbers: those that gave a text, with what xacro takes it for: float, int or text.
        truth_texts, other_texts: those that gave a text that xacro takes for a truth value, and
            those that gave another.
        structures: those that gave no text, number or truth value, but a list or a dict.
        lists: those that gave a list out of data, of which xacro makes a copy each time.
        no_texts: those that gave something else than a text.
    """

    __slots__ = (
        "evaluated",
        "floats",
        "lists",
        "long_floats",
        "no_texts",
        "numbers",
        "other_texts",
        "others",
        "structures",
        "truth_texts",
        "truths",
    )

    def __init__(self, limits: Any) -> None:
        super().__init__(limits)
        self.evaluated: set[str] = set()
        self.truths: set[str] = set()
        self.floats: set[str] = set()
        self.long_floats: set[str] = set()
        self.others: set[str] = set()
        self.numbers: dict[str, str] = {}
        self.truth_texts: set[str] = set()
        self.other_texts: set[str] = set()
        self.structures: set[str] = set()
        self.lists: set[str] = set()
        self.no_texts: set[str] = set()

    def evaluate(self, text: str, names: dict[str, Any]) -> Any:
        """Return the value of an expression."""
        value = super().evaluate(text, names)
        self.evaluated.add(text.strip())
        if not isinstance(value, (int, float)) or isinstance(value, bool):
            self.others.add(text.strip())
        if not isinstance(value, (str, int, float)):
            self.structures.add(text.strip())
        if isinstance(value, YamlList):
            self.lists.add(text.strip())
        if not isinstance(value, str):
            self.no_texts.add(text.strip())
        if isinstance(value, (bool, list, tuple)):
            self.truths.add(text.strip())
        elif isinstance(value, float):
            self.floats.add(text.strip())
            if format_number(value) != str(value):
                self.long_floats.add(text.strip())
        elif isinstance(value, str):
            self._note_kind(text.strip(), guess_value(value))
            is_truth = value in _TRUTH_TEXTS
            (self.truth_texts if is_truth else self.other_texts).add(text.strip())
        return value

    def _note_kind(self, text: str, meant: object) -> None:
        kind = {float: "float", int: "int"}.get(type(meant), "text")
        known = self.numbers.setdefault(text, kind)
        if kind != known:
            self.numbers[text] = "text" if "text" in (kind, known) else "float"
