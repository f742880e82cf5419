"""The files of a robot in xacro, and its expansions, which show what they mean.

What no expansion reaches is only read. So the robot is expanded with other values of its arguments,
too: that shows which files computed includes mean, and which expressions give truth values.
"""

from __future__ import annotations

import ast
import os
import re

from ....diagnostics import Reporter, YamaroError
from ....xacro.evaluator import Python, XacroEvaluator, YamlList
from ....xacro.expansion import Expansion
from ....xacro.scope import Lazy, Scope
from ....xacro.symbol_table import MACRO, Definition, called_by, definitions_in
from ....xacro.templates import guess_value
from ....xml.tree import Element, Text
from ....xml.values import format_number, format_value
from ....yaml.reader import UNITS
from ..elements import name_of
from .choices import Choices, Spellings
from .includes import ENDINGS, folder_meant

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from typing import Any

    from ....source import Source, Span
    from ....xacro.host import Host
    from ....xml.reader import XmlDocument
    from ....xml.tree import Element, Node

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
            # read the files that includes may mean whose names are computed
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


# --- expansions -------------------------------------------------------------------------------


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
        # evaluate the properties that nothing has read, as the language does
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
            own = text.strip()
            meant = guess_value(value)
            kind = {float: "float", int: "int"}.get(type(meant), "text")
            known = self.numbers.setdefault(own, kind)
            if kind != known:
                self.numbers[own] = "text" if "text" in (kind, known) else "float"
            is_truth = value in _TRUTH_TEXTS
            (self.truth_texts if is_truth else self.other_texts).add(text.strip())
        return value


# --- macros that set properties whose names they are given ------------------------------------
# A variable has no computed name. But where a macro does nothing but set `${name}` for its caller,
# and a call says `name="tip"`, what the call does is to set `tip`: the call becomes that property.


_HOLE = re.compile(r"\$\{([^}]*)\}")


def without_setters(roots: Mapping[str, Element]) -> dict[str, Element]:
    """Return the root elements of files with properties in place of the calls of such macros."""
    found = [own for root in roots.values() for own in definitions_in(root) if own.kind == MACRO]
    names = [own.name for own in found]
    setters = {
        own.name: own for own in found if names.count(own.name) == 1 and _is_setter(own.element)
    }
    if not setters:
        return dict(roots)
    calls = [own for root in roots.values() for own in root.iter() if called_by(own) in setters]
    replaced = {id(call): _properties(setters[called_by(call)], call) for call in calls}
    kept = {called_by(call) for call in calls if replaced[id(call)] is None}
    gone = {id(own.element) for name, own in setters.items() if name not in kept}
    return {path: _changed(root, replaced, gone) for path, root in roots.items()}


def _is_setter(macro: Element) -> bool:
    """Return whether a macro only sets properties for its caller, one at least by a name given."""
    inside = macro.elements()
    names = [name_of(own) for own in inside]
    return (
        any("$" in name for name in names)
        and all(own.name == "xacro:property" and not own.elements() for own in inside)
        and all({"name", "value", "scope"} == own.attributes.keys() for own in inside)
        and all(own.attributes["scope"] in ("parent", "global") for own in inside)
        and not any(
            isinstance(own, Text) and format_value(own.value).strip() for own in macro.children
        )
    )


def _properties(macro: Definition, call: Element) -> list[Element] | None:
    """Return the properties that a call sets, or None if they are not known."""
    if "." in call.name or call.elements():
        return None
    given = {name: format_value(value) for name, value in call.attributes.items()}
    for parameter in macro.parameters():
        if parameter.is_forwarded or parameter.is_block:
            return None
        if parameter.default is not None:
            given.setdefault(parameter.name, parameter.default)
    made = []
    for own in macro.element.elements():
        text = {key: format_value(value) for key, value in own.attributes.items()}
        name = _HOLE.sub(lambda found: given.get(found[1].strip(), "$"), text["name"])
        value = _with_given(text["value"], given)
        if "$" in name or value is None:
            return None
        attributes: dict[str, object] = {"name": name, "value": value}
        if text["scope"] == "global":
            attributes["scope"] = "global"
        made.append(Element("xacro:property", call.span, attributes))
    return made


def _with_given(text: str, given: Mapping[str, str]) -> str | None:
    """Return a text with the values of parameters in it; None if one cannot be put there."""
    alone = _HOLE.fullmatch(text)
    if alone and alone[1].strip() in given:
        return given[alone[1].strip()]
    pieces = []
    for index, piece in enumerate(_HOLE.split(text)):
        if index % 2 == 0:
            pieces.append(piece)
            continue
        inner = _expression_with(piece, given)
        if inner is None:
            return None
        pieces.append(f"${{{inner}}}")
    return "".join(pieces)


def _expression_with(python: str, given: Mapping[str, str]) -> str | None:
    try:
        tree = ast.parse(python.strip(), mode="eval")
    except (SyntaxError, ValueError):
        return None
    names = [node for node in ast.walk(tree) if isinstance(node, ast.Name) and node.id in given]
    made = python.strip().encode()
    for node in sorted(names, key=lambda own: own.col_offset, reverse=True):
        value = given[node.id]
        whole = _HOLE.fullmatch(value)
        if "$" in value and not whole:
            return None
        inner = whole[1].strip() if whole else repr(guess_value(value))
        own = inner if inner.isidentifier() or not whole else f"({inner})"
        made = made[: node.col_offset] + own.encode() + made[node.end_col_offset :]
    return made.decode()


def _changed(
    element: Element, replaced: Mapping[int, list[Element] | None], gone: set[int]
) -> Element:
    """Return an element with properties in place of calls, and without some macros."""
    children: list[Node] = []
    for child in element.children:
        if not isinstance(child, Element):
            children.append(child)
            continue
        properties = replaced.get(id(child))
        if properties is not None:
            children += properties
        elif id(child) not in gone:
            children.append(_changed(child, replaced, gone))
    return element.with_children(children)


# --- data from YAML files, as the language reads it -------------------------------------------


_TAGGED = re.compile(
    rf"(?P<tag>{'|'.join(UNITS)})(?P<space>[ \t]+)(?P<value>[^\s#,\]}}'\"][^#,\]}}\n]*?)"
    r"(?=[ \t]*(?:[,\]}#\n]|$))"
)


def with_plain_units(text: str, evaluate: Callable[[str], object]) -> str:
    """Return data in which numbers with a unit are numbers, as in `!radians pi/2`.

    Args:
        text: the YAML.
        evaluate: returns the value of an expression of Python.
    """

    def spelled(found: re.Match[str]) -> str:
        value = found["value"]
        try:
            float(value)
            return found[0]
        except ValueError:
            pass
        try:
            number = evaluate(value)
        except Exception:  # of any kind: it is what xacro would run into as well
            return found[0]
        if not isinstance(number, (int, float)):
            return found[0]
        return f"{found['tag']}{found['space']}{float(number)!r}"

    return _TAGGED.sub(spelled, text)
