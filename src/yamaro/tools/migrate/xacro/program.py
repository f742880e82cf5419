"""What a robot in xacro consists of: its files, macros, properties and arguments, and their names.

The robot is expanded once, which tells which files its includes mean and which expressions are
truth values. All else is read from the files.
"""

from __future__ import annotations

import os
import re

from ....diagnostics import YamaroError
from ....xacro.literals import guess_value
from ....xacro.parameters import Parameter, parse_parameters
from ....xml.tree import Comment, Element
from ....xml.values import format_value
from ..document import spaced
from ..elements import comments_at_ends, tidy_text, walk
from .arguments import HiddenArguments, arguments_in
from .choices import Choices
from .data import with_plain_units
from .includes import ENDINGS, folder_meant
from .namespaces import Namespaces
from .readers import Readers
from .runs import Runs
from .spellings import Spellings
from .truths import Truths

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Container, Iterable, Iterator, Mapping

    from ....source import Source, Span
    from ....xacro.host import Host
    from ....xml.reader import XmlDocument

_NAME = re.compile(r"[A-Za-z_]\w*")


class Macro:
    """A macro and the function it becomes.

    Attributes:
        name, function: what they are called.
        parameters: of the macro.
        file: the path of the file it is defined in.
        element: its tag.
        from_caller: the names in defaults of its parameters that only its callers have.
    """

    def __init__(self, element: Element, file: str, function: str) -> None:
        """Read its name and parameters."""
        self.element = element
        self.name = format_value(element.attributes.get("name")).removeprefix("xacro:")
        self.parameters: list[Parameter] = parse_parameters(
            format_value(element.attributes.get("params", ""))
        )
        self.file = file
        self.function = function
        self.from_caller: set[str] = set()

    def values(self) -> list[str]:
        """Return the names of the parameters that are values."""
        return [own.name for own in self.parameters if not own.is_block]

    def is_default_of_caller(self, own: Parameter) -> bool:
        """Tell whether a default reads a property of the caller."""
        return bool(names_in(own.default or "") & {*self.values(), *self.from_caller})

    def blocks(self) -> list[str]:
        """Return the names of the parameters that are blocks, with their stars."""
        return [own.name for own in self.parameters if own.is_block]


class Argument:
    """An argument of a robot.

    Attributes:
        span: where it is declared first.
        remark: the comments above that.
        ending: those at the end of its line.
        defaults: what it is if it is not given; several, if it is not known which counts.
        made_of: the names that its defaults read.
    """

    __slots__ = ("defaults", "ending", "made_of", "remark", "span")

    def __init__(self, span: Span, remark: str) -> None:
        """Hold what its first declaration says."""
        self.span = span
        self.remark = remark
        self.ending = ""
        self.defaults: list[str] = []
        self.made_of: set[str] = set()

    def add(self, default: str) -> None:
        """Note a default."""
        if default not in self.defaults:
            self.defaults.append(default)
            self.made_of |= names_in(default)

    def settle(self, default: object) -> None:
        """Say which default counts, if the first declaration has one."""
        if default is not None:
            self.defaults = [format_value(default)]
            self.made_of = names_in(self.defaults[0])

    @property
    def default(self) -> str:
        """Return the default, if there is one that counts."""
        return self.defaults[0] if self.defaults else ""


class Program:
    """The files of a robot, and what is defined in them.

    Attributes:
        main: the path of the main file.
        documents: the files, by path.
        roots: their root elements.
        data: the texts of other files that were read, by path.
        runs: its expansions, the first with the arguments given.
        untried: the arguments that were changed in no run, as there were too many.
        included: the paths that an include means, by the place of its `filename`.
        spelled: the arguments that keep the spelling of their numbers, with what these are.
        truth_arguments: the arguments that are true or false.
        truths: expressions that were truth values or lists, which Python shows in its own way.
        numbers: expressions that gave a text which xacro takes for a number: `float` or `int`.
        truth_texts: expressions that gave only texts which xacro takes for a truth value.
        floats: expressions that gave a float.
        macros: by name.
        namespaces: which files are in one.
        arguments: by name.
        assigned_from_inside: the properties that macros define for those who call them.
        assigned_globally: those of them that are set for all files.
        included_by_macros: the files that macros include: their properties are the macros' own.
        hidden: the arguments that something of the same name hides.
        has_computed_calls: whether it calls macros whose names are computed.
        result: what the robot expands to.
        exact: whether an origin that is missing has to stay missing.
    """

    def __init__(
        self,
        source: Source,
        host: Host,
        arguments: Mapping[str, str],
        *,
        exact: bool = False,
        with_others: bool = True,
    ) -> None:
        """Expand a robot and look at its files.

        Args:
            source: the main file.
            host: gives other files and packages.
            arguments: those given.
            exact: whether an origin that is missing has to stay missing.
            with_others: whether other values of the arguments are tried as well.

        Raises:
            YamaroError: it cannot be expanded.
        """
        self.main = source.path
        self.exact = exact
        self._host = host
        self.untried: list[dict[str, str]] = []
        self._left_behind: dict[tuple[str, int], list[str]] = {}
        self.runs = Runs(_read(source, host), host, arguments)
        self.result = self.runs.done[0].result
        self.values_of_arguments = self.runs.done[0].values
        self.documents = self.runs.documents
        self.included = self.runs.included
        self._read_the_rest(host)
        if with_others:
            self._try_others()
            self._read_computed()
        self.roots = self._roots_read()
        python, names = self.runs.python, self.runs.names
        self.data = {
            path: with_plain_units(text, lambda python_text: python.evaluate(python_text, names))
            for path, text in self.runs.texts.items()
            if path not in self.roots and not path.endswith(ENDINGS)  # a file of a failed run
        }
        self.truths = python.truths
        self._evaluated = python.evaluated
        self.truth_texts = python.truth_texts - python.other_texts
        self.numbers = {text: kind for text, kind in python.numbers.items() if kind != "text"}
        self.floats = python.floats
        self._others = python.others
        self.macros: dict[str, Macro] = {}
        self.definitions: dict[tuple[str, int], Macro] = {}
        self._macros_of_name: dict[str, list[Macro]] = {}
        self._in_a_row: set[str] = set()
        self.arguments: dict[str, Argument] = {}
        self.assigned_from_inside: set[str] = set()
        self.assigned_globally: set[str] = set()
        self.properties: dict[str, set[str]] = {}
        self.times_defined: dict[str, int] = {}
        self.blocks: set[str] = set()
        self._names: dict[str, set[str]] = {}
        self.has_computed_calls = False
        self.namespaces = Namespaces(self.main, self.roots, self.included)
        for path, root in self.roots.items():
            self._gather(path, root)
        self._number_versions()
        self._settle_arguments()
        self.truth_arguments = {
            name
            for name, value in self.values_of_arguments.items()
            if value.lower() in ("true", "false")
        }
        self._maybe_truths = Truths(self.roots.values(), self.truth_arguments)
        self.at_top = set().union(*map(defined_in, self.roots.values()))
        self._pass_names()
        for path, root in self.roots.items():
            self._names[path] |= self.forwarded_in(root)
        self.spelled = self._spelled()
        self._constants = self._named_constants()
        self._visible: dict[str, set[str]] = {}
        self._own_names: dict[str, set[str]] = {}
        self._callers: dict[str, set[str]] = {}
        self._look_at_callers()
        self.read: set[str] = set()
        self.inherited = self._names_of_callers()
        self.hidden = HiddenArguments(
            self.roots.values(), self.definitions.values(), self.inherited
        )
        self._declare_given(arguments)
        self.included_by_macros = self._included_by_macros()
        self._readers = Readers(self)

    def _try_others(self) -> None:
        """Expand the robot with other values of its arguments, one at a time.

        Of what only such a value brings in, other values are tried with that.
        """
        first = self.runs.done[0]
        choices = self._choices()
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
                inner = self._choices().alternatives(run.values)
                pending += [
                    {**changed, name: value}
                    for name in sorted(new)
                    for value in inner.get(name, ())
                ]
        self.untried = pending

    def _read_computed(self) -> None:
        """Read the files that includes may mean whose names are computed."""
        choices = self._choices()
        pending = list(self.documents)
        while pending:
            path = pending.pop()
            for text, span in self._names_of_includes(path):
                if "$" not in text:
                    continue
                key = (span.source.path, span.start)
                is_new = key not in self.included
                for name, found in choices.files_named(text, span, by_pattern=is_new).items():
                    if found == self.main or not self._read_file(found, span):
                        continue
                    known = self.included.setdefault(key, [])
                    if found not in known:
                        known.append(found)
                    self.runs.named.setdefault(key, {})[name] = found
        self._read_the_rest(self._host)

    def left_behind(self, include: Element) -> list[str]:
        """Return the files that are not read and that a computed include might mean."""
        span = include.value_span("filename")
        place = span.source.path, span.start
        if place not in self._left_behind:
            text = format_value(include.attributes["filename"])
            known = {self.main, span.source.path, *self.documents, *self.runs.refused}
            possible = Spellings(self._choices(), span).files(text)
            self._left_behind[place] = [path for path in possible if path not in known]
        return self._left_behind[place]

    def is_constant(self, include: Element) -> bool:
        """Tell whether the name in an include is the same whatever the arguments are."""
        spellings = Spellings(self._choices(), include.value_span("filename"))
        return spellings.is_constant(format_value(include.attributes["filename"]))

    def _choices(self) -> Choices:
        return Choices(self._roots_read(), self._host, self.runs.loaded)

    def _roots_read(self) -> dict[str, Element]:
        return {path: document.root for path, document in self.documents.items()}

    def _read_file(self, path: str, span: Span) -> bool:
        """Read a file if it is not known yet; tell whether it is there."""
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
        """Tell whether the value of a property can be evaluated; None if no run has told."""
        place = (node.span.source.path, node.span.start)
        if place in self.runs.evaluated:
            return True
        return False if place in self.runs.failing else None

    def has_what_it_needs(self, default: str) -> bool:
        """Tell whether the packages and the environment are there that a default asks for."""
        for command, name in re.findall(r"\$\((find|env)\s+([^()\s]+)\s*\)", default):
            if "$" in name:
                continue
            is_there = self.finds(name) if command == "find" else self._host.environment(name)
            if is_there is None:
                return False
        return True

    def names_of_includers(self, path: str) -> set[str]:
        """Return the names that the macros have which include a file."""
        return set().union(
            *(
                set(macro.values()) | defined_in(macro.element)
                for macro in self.definitions.values()
                if path in self.included_by_macros
                and any(
                    path in self.files_of(element)
                    for element in walk(macro.element)
                    if element.name == "xacro:include"
                )
            )
        )

    def finds(self, package: str) -> str | None:
        """Return the folder in which a package is found from the main file, or None."""
        known = self.runs.packages.get(package)
        if known is not None:
            return known
        try:
            return self._host.find_package(package, self.roots[self.main].span)
        except YamaroError:
            return None

    def arguments_read(self, root: Element) -> set[str]:
        """Return the arguments that a file reads, also where `$(eval …)` has them as names."""
        names = arguments_in(root, with_own=True)
        for text in _texts_in(root):
            for inside in re.findall(r"\$\(eval([^)]*)", text):
                names |= set(_NAME.findall(inside)) & self.arguments.keys()
        return names

    def constants(self, inside: set[str]) -> set[str]:
        """Return the properties that files, and others as well, define as the same constant."""
        return {
            name
            for name in self._constants
            if self.properties[name] & inside and self.properties[name] - inside
        }

    def _named_constants(self) -> set[str]:
        """Return the properties whose definitions all are the same constant."""
        found: dict[str, set[str]] = {}
        for path, root in self.roots.items():
            for element in walk(root):
                if element.name == "xacro:property":
                    text = format_value(element.attributes.get("value"))
                    name = format_value(element.attributes.get("name"))
                    value = f"{path}: {text}" if "$" in text else text
                    found.setdefault(name, set()).add(value)
        several = {name for name, paths in self.properties.items() if len(paths) > 1}
        return {name for name, texts in found.items() if len(texts) == 1} & several

    def _included_by_macros(self) -> set[str]:
        return {
            path
            for macro in self.definitions.values()
            for element in walk(macro.element)
            if element.name == "xacro:include"
            for path in self.files_of(element)
        }

    def _declare_given(self, given: Iterable[str]) -> None:
        """Note the given arguments that the files read and do not declare."""
        root = self.roots[self.main]
        for name in given:
            if name not in self.arguments and any(name in names for names in self._names.values()):
                self.arguments[name] = Argument(root.span, "to be given: it has no default")

    def _names_of_includes(self, path: str) -> Iterator[tuple[str, Span]]:
        """Yield the name that each include of a file is written with, and where."""
        for element in walk(self.documents[path].root):
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

    def _gather(self, path: str, root: Element) -> None:
        names = self._names[path] = set()
        for element in walk(root):
            given = {name: format_value(value) for name, value in element.attributes.items()}
            for text in (*given.values(), element.text()):
                if "$" in text or element.name in ("xacro:if", "xacro:unless"):
                    names.update(_NAME.findall(text))
            if element.name.startswith("xacro:"):
                names.add(f"xacro:{element.name.removeprefix('xacro:').rpartition('.')[2]}")
            if element.name == "xacro:call" and "$" in given.get("macro", ""):
                self.has_computed_calls = True
            if element.name == "xacro:insert_block":
                names.add(given.get("name", ""))
            if element.name == "xacro:macro" and "name" in given:
                name = given["name"].removeprefix("xacro:")
                known = self.macros.get(name)
                function = known.function if known else self._function_name(name)
                macro = Macro(element, path, function)
                self.macros.setdefault(name, macro)
                self.definitions[path, element.span.start] = macro
                self._macros_of_name.setdefault(name, []).append(macro)
            elif element.name == "xacro:property" and "name" in given:
                self.times_defined[given["name"]] = self.times_defined.get(given["name"], 0) + 1
                self.properties.setdefault(given["name"], set()).add(path)
                if given.get("scope") in ("parent", "global"):
                    self.assigned_from_inside.add(given["name"])
                if given.get("scope") == "global":
                    self.assigned_globally.add(given["name"])
                if "value" not in given and "default" not in given and "remove" not in given:
                    self.blocks.add(given["name"])
            self._gather_arguments(element)

    def _gather_arguments(self, element: Element) -> None:
        """Note the arguments that are declared in an element, with the comments above them."""
        remarks: list[str] = []
        latest: Argument | None = None
        endings = comments_at_ends(element.children)
        for child in element.children:
            if isinstance(child, Element):
                latest = None
                if child.name == "xacro:arg" and "name" in child.attributes:
                    latest = self._add_argument(child, "\n".join(remarks))
                remarks = []
            elif not isinstance(child, Comment):
                continue
            elif id(child) not in endings:
                remarks.append(tidy_text(child.text))
            elif latest is not None:
                latest.ending = spaced(latest.ending, tidy_text(child.text))

    def _number_versions(self) -> None:
        """Give a function of its own to each definition of a macro that is redefined in a row.

        That is where all definitions stand at the top of one file, and all calls outside of
        macros: the last definition above a call is meant.
        """
        for name, versions in self._macros_of_name.items():
            if len(versions) < 2 or len({own.file for own in versions}) > 1:
                continue
            root = self.roots[versions[0].file]
            top = {id(element) for element in root.elements()}
            tag = f"xacro:{name}"
            calls = [own for other in self.roots.values() for own in walk(other) if own.name == tag]
            inside = [own for own in walk(root) if own.name == "xacro:macro"]
            if (
                self.has_computed_calls
                or not all(id(own.element) in top for own in versions)
                or any(own.span.source.path != versions[0].file for own in calls)
                or any(own.name == tag for macro in inside for own in walk(macro))
            ):
                continue
            self._in_a_row.add(name)
            for own in versions[1:]:
                own.function = self._function_name(name)

    def _names_of_callers(self) -> set[str]:
        """Return the names that macros read of those who call them."""
        free: set[str] = set()
        own: set[str] = set()
        for path, root in self.roots.items():
            for macro in self._macros_in(path, root):
                free |= self._unbound_in(macro, set(), own)
        self.read = set().union(*map(used_in, self.roots.values()))
        return (free - self.at_top) & own

    def _pass_names(self) -> None:
        from .passing import Passing  # it reads this module's types

        Passing(self).add_parameters()

    def has_one_definition(self, macro: Macro) -> bool:
        """Tell whether a macro is the only one of its name, and all of its calls say that."""
        return len(self._macros_of_name[macro.name]) == 1 and not self.has_computed_calls

    def _macros_in(self, path: str, element: Element) -> list[Macro]:
        """Return the macros defined in an element, but for those in other macros."""
        found = []
        pending = element.elements()
        while pending:
            inner = pending.pop()
            macro = self.definitions.get((path, inner.span.start))
            if macro is not None and macro.element.name == inner.name:
                found.append(macro)
            else:
                pending += inner.elements()
        return found

    def _unbound_in(self, macro: Macro, around: set[str], own: set[str]) -> set[str]:
        """Return the names that a macro reads and nothing around it in the text defines.

        What is defined in it, and in macros in it, is added to `own`.
        """
        element = macro.element
        local = defined_in(element) | set(macro.values())
        own |= local
        bound = around | local | self.handed_to(element) | macro.from_caller
        nested = self._macros_in(macro.file, element)
        inside = {id(other.element) for other in nested}
        free = (used_in(element, without=inside) | self.forwarded_in(element, inside)) - bound
        return free.union(*(self._unbound_in(other, bound, own) for other in nested))

    def forwarded_in(self, root: Element, without: Container[int] = ()) -> set[str]:
        """Return the names that calls in an element forward to macros without saying so."""
        names: set[str] = set()
        for called in walk(root, without):
            macro = self.macro_called(called)
            if macro is not None:
                own = {each.name for each in macro.parameters if each.is_forwarded}
                names |= own - set(called.attributes)
        return names

    def visible_in(self, macro: Macro) -> set[str]:
        """Return the names that a macro may see: its own, and those of all who may call it."""
        known = self._visible.get(macro.name)
        if known is None:
            visible = set(self.at_top)
            pending, seen = [macro.name], {macro.name}
            while pending:
                name = pending.pop()
                visible |= self._own_names.get(name, set())
                new = self._callers.get(name, set()) - seen
                seen |= new
                pending += new
            known = self._visible[macro.name] = visible
        return known

    def _look_at_callers(self) -> None:
        """Note the names that macros have, and which macros call them, by their names."""
        for own in self.definitions.values():
            names = set(own.values()) | defined_in(own.element, nested=True)
            names |= self.handed_to(own.element)
            self._own_names.setdefault(own.name, set()).update(names)
            for called in walk(own.element):
                if called.name.startswith("xacro:"):
                    callers = self._callers.setdefault(called.name.removeprefix("xacro:"), set())
                    callers.add(own.name)

    def handed_to(self, element: Element) -> set[str]:
        """Return the properties that the macros called in an element hand to it."""
        handed: set[str] = set()
        for called in walk(element):
            macro = self.macro_called(called)
            if macro is not None:
                handed |= {
                    format_value(own.attributes.get("name"))
                    for own in walk(macro.element)
                    if own.name == "xacro:property" and own.attributes.get("scope") == "parent"
                }
        return handed

    def macro_called(self, element: Element) -> Macro | None:
        """Return the macro that a tag calls: of the namespace it names, its file, or another."""
        if not element.name.startswith("xacro:"):
            return None
        tag = element.name
        if tag == "xacro:call":
            tag = format_value(element.attributes.get("macro", ""))
        *namespaces, name = tag.removeprefix("xacro:").split(".")
        path = element.span.source.path
        near = self.namespaces.files(path, namespaces) if namespaces else [path]
        versions = self._macros_of_name.get(name, [])
        if name in self._in_a_row:
            above = [own for own in versions if own.element.span.start < element.span.start]
            return above[-1] if above else None
        for macro in versions:
            if macro.file in near:
                return macro
        return None if namespaces else self.macros.get(name)

    def _add_argument(self, element: Element, remark: str) -> Argument | None:
        """Note the declaration of an argument, and return it if it is the first one."""
        name = format_value(element.attributes["name"])
        is_new = name not in self.arguments
        known = self.arguments.setdefault(name, Argument(element.span, remark))
        if "default" in element.attributes:
            known.add(format_value(element.attributes["default"]))
        return known if is_new else None

    def _settle_arguments(self) -> None:
        """Find the default of each argument that has several: that of the first declaration.

        Where the main file does not come first whatever the arguments are, it is not known.
        """
        for name, argument in self.arguments.items():
            if len(argument.defaults) < 2:
                continue
            for element in self.roots[self.main].elements():
                if element.name == "xacro:arg" and element.attributes.get("name") == name:
                    argument.settle(element.attributes.get("default"))
                    break
                if self._may_declare(element, name):
                    break

    def _may_declare(self, element: Element, name: str) -> bool:
        """Tell whether an argument may be declared by an element, or what it includes or calls."""
        if any(element is macro.element for macro in self.definitions.values()):
            return False
        inside = list(walk(element))
        files = self.namespaces.reached_by([own for own in inside if own.name == "xacro:include"])
        places = [*inside, *(own for path in files for own in walk(self.roots[path]))]
        if any(self.macro_called(own) is not None for own in places):
            places += [own for macro in self.definitions.values() for own in walk(macro.element)]
        return any(own.name == "xacro:arg" and own.attributes.get("name") == name for own in places)

    def folder_meant(self, start: str, element: Element) -> str | None:
        """Return the folder that the start of a file's name means where an element stands."""
        return folder_meant(start, element.span.source.path, self._host, element.span)

    def is_typed_argument(self, name: str) -> bool:
        """Tell whether the default of an argument is a number or truth value, and no text."""
        argument = self.arguments.get(name)
        if argument is None or name in self.spelled:
            return False
        return not isinstance(guess_value(argument.default), str)

    def _spelled(self) -> dict[str, str]:
        """Return the arguments whose texts say more than the numbers do that they stand for.

        These are whole numbers such as 01, and others that stand in quotes somewhere.
        """
        found = {}
        texts = [text for root in self.roots.values() for text in _texts_in(root)]
        for name, argument in self.arguments.items():
            value = guess_value(argument.default)
            kind = {int: "int", float: "float"}.get(type(value))
            if kind is None or str(value) == argument.default:
                continue
            quoted = (f"'$(arg {name})'", f'"$(arg {name})"')
            if kind == "int" or any(each in text for text in texts for each in quoted):
                found[name] = kind
        return found

    def is_python(self, name: str) -> bool:
        """Tell whether an argument is a list or the like that is put into expressions only."""
        import ast

        try:
            value = ast.literal_eval(self.arguments[name].default.strip())
        except (SyntaxError, ValueError):
            return False
        if not isinstance(value, (list, tuple, dict)):
            return False
        used = f"$(arg {name})"
        texts = [text for root in self.roots.values() for text in _texts_in(root) if used in text]
        return all(_outside_expressions(text).count(used) == 0 for text in texts)

    def _function_name(self, name: str) -> str:
        stem = camel(name)
        taken = {macro.function for macro in self.definitions.values()}
        unique, number = stem, 2
        while unique in taken:
            unique, number = f"{stem}{number}", number + 1
        return unique

    def is_shown_as_truth(self, expression: str) -> bool:
        """Tell whether an expression gives a truth value or list, or may, if it was not reached."""
        own = expression.strip()
        if own in self._evaluated:
            return own in self.truths
        return self._maybe_truths.may_give(own)

    def is_number(self, expression: str) -> bool:
        """Tell whether an expression gave numbers whenever it was evaluated."""
        own = expression.strip()
        return own in self._evaluated and own not in self._others

    def is_defined_again(self, macro: Macro) -> bool:
        """Tell whether a macro of a file is replaced by one further down in it."""
        return macro.name not in self._in_a_row and any(
            other.name == macro.name and path == macro.file and start > macro.element.span.start
            for (path, start), other in self.definitions.items()
        )

    def is_used_elsewhere(self, name: str, path: str) -> bool:
        """Tell whether another file has a name in an expression or tag, or any sets it globally."""
        if name in self.assigned_globally:
            return True
        if self.has_computed_calls and name.startswith("xacro:"):
            return True
        return bool(self._readers.files.get(name, set()) - {path})


def camel(name: str) -> str:
    """Return a name as that of a function: `wheel_macro` becomes `WheelMacro`."""
    words = [word for word in re.split(r"[^A-Za-z0-9]+", name) if word]
    joined = "".join(word[0].upper() + word[1:] for word in words)
    return joined if joined[:1].isalpha() else f"F{joined}"


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


def defined_in(root: Element, *, nested: bool = False) -> set[str]:
    """Return the properties defined in an element, those of macros in it only if `nested`."""
    names = set()
    pending = [root]
    while pending:
        element = pending.pop()
        if element.name == "xacro:property":
            names.add(format_value(element.attributes.get("name")))
        if element.name != "xacro:macro" or element is root or nested:
            pending += element.elements()
    return names


def _texts_in(root: Element) -> Iterator[str]:
    """Return the values of attributes in an element, and its texts."""
    for element in walk(root):
        yield from map(format_value, element.attributes.values())
        yield element.text()


def _outside_expressions(text: str) -> str:
    """Return what of a text is none of Python's: without `${…}`, but with the texts in it."""
    return re.sub(
        r"\$\{([^}]*)\}", lambda found: " ".join(re.findall(r"'[^']*'|\"[^\"]*\"", found[1])), text
    )


def used_in(root: Element, without: Container[int] = ()) -> set[str]:
    """Return the names in the expressions of an element, but for elements of some identities."""
    names: set[str] = set()
    for element in walk(root, without):
        for text in (*map(format_value, element.attributes.values()), element.text()):
            names |= names_in(text)
    return names


def names_in(text: str) -> set[str]:
    """Return the names that the expressions of a text read."""
    import ast

    names: set[str] = set()
    for expression in re.findall(r"\$\{([^}]*)\}", text):
        try:
            tree = ast.parse(re.sub(r"\$\([^)]*\)", "0", expression).strip(), mode="eval")
        except (SyntaxError, ValueError):
            continue
        found = [node for node in ast.walk(tree) if isinstance(node, ast.Name)]
        bound = {node.id for node in found if isinstance(node.ctx, ast.Store)}
        bound |= {node.arg for node in ast.walk(tree) if isinstance(node, ast.arg)}
        names |= {node.id for node in found} - bound
    return names


def _read(source: Source, host: Host) -> XmlDocument:
    from ....xml.reader import read_xml

    return read_xml(source, host.limits, exact=True)


def common_folder(paths: list[str]) -> str:
    """Return the deepest folder that holds all of the files."""
    return os.path.commonpath([os.path.dirname(path) for path in paths])
