"""What a robot in xacro consists of: its files, macros, properties and arguments, and their names.

The robot is expanded once, which shows which files its includes mean and which expressions are
truth values. All else is read from the files.
"""

from __future__ import annotations

import ast
import math
import re

from ....xacro.statements import Parameter
from ....xacro.symbol_table import (
    BLOCK,
    MACRO,
    Definition,
    arguments_of,
    assigned_in,
    computed_with,
    defined_in,
    definition_of,
    names_in,
    outside_expressions,
    properties_in,
    texts_in,
    texts_of,
    used_in,
    words_in,
)
from ....xacro.templates import guess_value
from ....xml.tree import Comment, Element
from ....xml.values import format_value
from ..document import spaced
from ..elements import comments_at_ends, name_of, tidy_text
from ..formulas import Degrees
from .choices import MARK, Truths, name_alone
from .names import (
    Callers,
    HiddenArguments,
    Passing,
    Readers,
    camel,
    names_of_callers,
    reached_from,
)
from .robot_files import RobotFiles

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Container, Iterator, Mapping

    from ....source import Source, Span
    from ....xacro.host import Host


# --- macros and arguments ---------------------------------------------------------------------


class Macro:
    """A macro and the function it becomes.

    Attributes:
        name, function: what they are called.
        parameters: of the macro.
        file: the path of the file it is defined in.
        element: its tag.
        from_caller: the names in defaults of its parameters that only its callers have.
    """

    def __init__(self, definition: Definition, file: str, function: str) -> None:
        """Read its name and parameters."""
        self.element = definition.element
        self.name = definition.name
        self.parameters: list[Parameter] = [
            own
            for own in definition.parameters()
            if not own.name[:1].isdigit()  # nothing can read it, and no call can give it
        ]
        self.file = file
        self.function = function
        self.from_caller: set[str] = set()

    def values(self) -> list[str]:
        """Return the names of the parameters that are values."""
        return [own.name for own in self.parameters if not own.is_block]

    def is_default_of_caller(self, own: Parameter) -> bool:
        """Return whether a default reads a property of the caller."""
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


# --- the robot --------------------------------------------------------------------------------


_CHANGE = re.compile(r"\.(?:pop|append|insert|remove|extend|clear|sort|reverse)\(")
_NAME = re.compile(r"[A-Za-z_]\w*")


class XacroProgram:
    """The files of a robot, and what is defined in them.

    Attributes:
        files: its files.
        main: the path of the main file.
        roots: the root elements of the files, by path.
        runs: its expansions, the first with the arguments given.
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
        computed: the names that conditions or expressions take for more than texts.
        copied: the expressions that give a list out of data, if there are lists that change.
        has_computed_calls: whether it calls macros whose names are computed.
        known_numbers: the numbers that names always have.
        result: what the robot expands to.
        given: the arguments given.
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
        self.files = RobotFiles(source, host, arguments, with_others=with_others)
        self.main = self.files.main
        self.roots = self.files.roots
        self.runs = self.files.runs
        self.included = self.files.included
        self.result = self.runs.done[0].result
        self.exact = exact
        self.given = arguments
        self._asked = source, host
        self._take_values()
        self._gather_names()
        self._settle_arguments()
        # find the arguments and expressions that may be true or false
        self.truth_arguments = {
            name
            for name, value in self.values_of_arguments.items()
            if value.lower() in ("true", "false")
        }
        self._maybe_truths = Truths(self.roots.values(), self.truth_arguments)
        Passing(self).add_parameters()
        self.spelled = self._spelled()
        # the properties whose definitions all are the same constant
        found: dict[str, set[str]] = {}
        for file, each in self.roots.items():
            for own in properties_in(each):
                value = f"{file}: {own.value}" if "$" in own.value else own.value
                found.setdefault(own.name, set()).add(value)
        several = {name for name, paths in self.properties.items() if len(paths) > 1}
        self._constants = {name for name, texts in found.items() if len(texts) == 1} & several
        # the properties that several files set, other than to the same constant
        files: dict[str, int] = {}
        for path in self.roots.keys() - self.namespaces.inside:
            for name in defined_in(self.roots[path]):
                files[name] = files.get(name, 0) + 1
        self._set_by_several = {
            name for name, count in files.items() if count > 1
        } - self._constants
        self._callers = Callers(self)
        self.inherited = names_of_callers(self)
        self.hidden = HiddenArguments(
            self.roots, self.main, self.definitions.values(), self.inherited
        )
        # note the given arguments that the files may read and do not declare
        undeclared = [name for name in arguments if name not in self.arguments]
        if undeclared:
            roots = self.roots.values()
            words = set().union(*map(words_in, roots), *map(self.forwarded_in, roots))
            for name in filter(words.__contains__, undeclared):
                span = self.roots[self.main].span
                self.arguments[name] = Argument(span, "to be given: it has no default")
        self.included_by_macros = {
            path
            for macro in self.definitions.values()
            for element in macro.element.iter()
            if element.name == "xacro:include"
            for path in self.files.files_of(element)
        }
        self._readers = Readers(self)
        self.known_numbers = known_numbers(self)

    def _take_values(self) -> None:
        """Note what the expansions showed of expressions."""
        python = self.runs.python
        self.values_of_arguments = self.runs.done[0].values
        self.truths = python.truths
        self._evaluated = python.evaluated
        self._structures = python.structures
        self.truth_texts = python.truth_texts - python.other_texts
        self.numbers = {text: kind for text, kind in python.numbers.items() if kind != "text"}
        self.floats = python.floats
        changes = any(_CHANGE.search(text) for text in python.evaluated)
        self.copied = (
            {own for own in python.lists if own[-1:] == "]" or "." in own} if changes else set()
        )
        self._others = python.others

    def _gather_names(self) -> None:
        """Find the macros, properties, arguments and blocks of all files."""
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
        self.has_computed_calls = False
        self.namespaces = Namespaces(self.main, self.roots, self.included)
        for path, root in self.roots.items():
            self._gather(path, root)
        # give a function of its own to each definition of a macro that is redefined in a row.
        # That is where all definitions stand at the top of one file, and all calls outside of
        # macros: the last definition above a call is meant
        for name, versions in self._macros_of_name.items():
            if len(versions) < 2 or len({own.file for own in versions}) > 1:
                continue
            root = self.roots[versions[0].file]
            top = {id(element) for element in root.elements()}
            tag = f"xacro:{name}"
            calls = [
                own for other in self.roots.values() for own in other.iter() if own.name == tag
            ]
            inside = [own for own in root.iter() if own.name == "xacro:macro"]
            if (
                self.has_computed_calls
                or not all(id(own.element) in top for own in versions)
                or any(own.span.source.path != versions[0].file for own in calls)
                or any(own.name == tag for macro in inside for own in macro.iter())
            ):
                continue
            self._in_a_row.add(name)
            for own in versions[1:]:
                own.function = self._function_name(name)
        self.at_top = set().union(*map(defined_in, self.roots.values()))
        self.read = set().union(*map(used_in, self.roots.values()))
        self.computed = set().union(*map(computed_with, self.roots.values()))

    def names_of_includers(self, path: str) -> set[str]:
        """Return the names that the macros have which include a file."""
        includers = self.macros_including(path)
        return set().union(*(set(own.values()) | defined_in(own.element) for own in includers))

    def macros_including(self, path: str) -> list[Macro]:
        """Return the macros that include a file."""
        if path not in self.included_by_macros:
            return []
        return [
            macro
            for macro in self.definitions.values()
            if any(
                path in self.files.files_of(element)
                for element in macro.element.iter()
                if element.name == "xacro:include"
            )
        ]

    def is_scalar(self, text: str) -> bool:
        """Return whether all expressions in a text were seen to give texts, numbers and truths."""
        inside = {found.strip() for found in re.findall(r"\$\{([^}]*)\}", text)}
        return inside <= self._evaluated - self._structures

    def arguments_read(self, root: Element) -> set[str]:
        """Return the arguments that a file reads, also where `$(eval …)` has them as names."""
        names: set[str] = set()
        for text in texts_in(root):
            names |= arguments_of(text)
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

    def _gather(self, path: str, root: Element) -> None:
        for element in root.iter():
            self._gather_arguments(element)
            if "$" in format_value(element.attributes.get("macro")):
                self.has_computed_calls |= element.name == "xacro:call"
            own = definition_of(element)
            if own is None or "name" not in element.attributes:
                continue
            if own.kind == MACRO:
                known = self.macros.get(own.name)
                function = known.function if known else self._function_name(own.name)
                macro = Macro(own, path, function)
                self.macros.setdefault(own.name, macro)
                self.definitions[path, element.span.start] = macro
                self._macros_of_name.setdefault(own.name, []).append(macro)
            elif own.is_property:
                self.times_defined[own.name] = self.times_defined.get(own.name, 0) + 1
                self.properties.setdefault(own.name, set()).add(path)
                if own.kind == BLOCK:
                    self.blocks.add(own.name)
        self.assigned_globally |= assigned_in(root, "global")
        self.assigned_from_inside |= assigned_in(root, "global", "parent")

    def _gather_arguments(self, element: Element) -> None:
        """Note the arguments that are declared in an element, with the comments above them."""
        remarks: list[str] = []
        latest: Argument | None = None
        endings = comments_at_ends(element.children)
        for child in element.children:
            if isinstance(child, Element):
                latest = None
                if child.name == "xacro:arg" and child.attributes.get("name"):  # "" cannot be given
                    # only the first declaration takes the comments
                    remark = "\n".join(remarks)
                    name = name_of(child)
                    is_new = name not in self.arguments
                    known = self.arguments.setdefault(name, Argument(child.span, remark))
                    if "default" in child.attributes:
                        known.add(format_value(child.attributes["default"]))
                    latest = known if is_new else None
                remarks = []
            elif not isinstance(child, Comment):
                continue
            elif id(child) not in endings:
                remarks.append(tidy_text(child.text))
            elif latest is not None:
                latest.ending = spaced(latest.ending, tidy_text(child.text))

    def visible_in(self, macro: Macro) -> set[str]:
        """Return the names that a macro may see: its own, and those of all who may call it."""
        return self._callers.visible_in(macro)

    def has_one_definition(self, macro: Macro) -> bool:
        """Return whether a macro is the only one of its name, and all of its calls say that."""
        return len(self._macros_of_name[macro.name]) == 1 and not self.has_computed_calls

    def forwarded_in(self, root: Element, without: Container[int] = ()) -> set[str]:
        """Return the names that calls in an element forward to macros without saying so."""
        names: set[str] = set()
        for called in root.iter(without):
            macro = self.macro_called(called)
            if macro is not None:
                own = {each.name for each in macro.parameters if each.is_forwarded}
                names |= own - set(called.attributes)
        return names

    def handed_to(self, element: Element) -> set[str]:
        """Return the properties that the macros called in an element hand to it."""
        handed: set[str] = set()
        for called in element.iter():
            macro = self.macro_called(called)
            if macro is not None:
                handed |= assigned_in(macro.element, "parent")
        return handed

    def reached_from(self, root: Element, without: Container[int] = ()) -> Iterator[Macro | str]:
        """Yield the macros that an element calls, and the paths of the files that it includes."""
        for element in root.iter(without):
            macro = self.macro_called(element)
            if macro is not None:
                yield macro
            elif element.name == "xacro:include":
                yield from self.files.files_of(element)

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
        """Return if an argument may be declared by an element, or what it includes or calls."""
        if any(element is macro.element for macro in self.definitions.values()):
            return False
        inside = list(element.iter())
        files = self.namespaces.reached_by([own for own in inside if own.name == "xacro:include"])
        places = [*inside, *(own for path in files for own in self.roots[path].iter())]
        if any(self.macro_called(own) is not None for own in places):
            places += [own for macro in self.definitions.values() for own in macro.element.iter()]
        return any(own.name == "xacro:arg" and name_of(own) == name for own in places)

    def is_shared_argument(self, name: str) -> bool:
        """Return whether an argument, or a property that has its name, is read in other files."""
        if name in self.hidden.replaced:
            return True
        if name in self.hidden.everywhere:
            return False
        return any(
            (path != self.main and name in self.arguments_read(root))
            or any(own.name == name and own.is_of_argument for own in properties_in(root))
            for path, root in self.roots.items()
        )

    def is_typed_argument(self, name: str) -> bool:
        """Return whether the default of an argument is a number or truth value, and no text."""
        argument = self.arguments.get(name)
        if argument is None or name in self.spelled:
            return False
        return not isinstance(guess_value(argument.default), str)

    def alone(self) -> XacroProgram:
        """Return the robot as it is with the arguments given, without a look at others."""
        source, host = self._asked
        return XacroProgram(source, host, self.given, exact=self.exact, with_others=False)

    def values_tried(self, name: str) -> set[str]:
        """Return the values that an argument had in the expansions, or was to have in others."""
        found = {run.values[name] for run in self.runs.done if name in run.values}
        return found | {changed[name] for changed in self.files.untried if name in changed}

    def shown_as_values(self) -> set[str]:
        """Return the arguments that xacro reads as values before it puts them into a text.

        With `true` it writes True then. Left out are those that were true or false in some
        expansion, which the sources write as xacro does.
        """
        choices = self.files.choices()
        shown = {
            name
            for root in self.roots.values()
            for element in root.iter()
            if element.name not in ("xacro:if", "xacro:unless", "xacro:macro")
            for text in texts_of(element)
            if not (name_alone(text) and element.name.startswith("xacro:"))
            for name in names_in(text)
            if not self.is_shown_as_truth(name)
        }
        return {name for name in self.arguments if choices.aliases(MARK + name) & shown}

    def _spelled(self) -> dict[str, str]:
        """Return the arguments whose texts say more than the numbers that they mean.

        These are whole numbers such as 01, and others that are in quotes somewhere.
        """
        found = {}
        texts = [text for root in self.roots.values() for text in texts_in(root)]
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
        """Return whether an argument is a value such as a list, only put into expressions."""
        try:
            value = ast.literal_eval(self.arguments[name].default.strip())
        except (SyntaxError, ValueError):
            return False
        if not isinstance(value, (list, tuple, dict)):
            return False
        used = f"$(arg {name})"
        texts = [text for root in self.roots.values() for text in texts_in(root) if used in text]
        return all(outside_expressions(text).count(used) == 0 for text in texts)

    def _function_name(self, name: str) -> str:
        stem = camel(name)
        taken = {macro.function for macro in self.definitions.values()}
        unique, number = stem, 2
        while unique in taken:
            unique, number = f"{stem}{number}", number + 1
        return unique

    def is_shown_as_truth(self, expression: str) -> bool:
        """Return if an expression gives a truth value or list, or may, if it was not reached."""
        own = expression.strip()
        if own in self._evaluated:
            return own in self.truths or own in self._maybe_truths.flags
        return self._maybe_truths.may_give(own)

    def is_number(self, expression: str) -> bool:
        """Return whether an expression gave numbers whenever it was evaluated."""
        own = expression.strip()
        return own in self._evaluated and own not in self._others

    def is_text(self, expression: str) -> bool:
        """Return whether an expression gave texts whenever it was evaluated, if it was."""
        return expression.strip() not in self.runs.python.no_texts

    def is_defined_again(self, macro: Macro) -> bool:
        """Return whether a macro of a file is replaced by one further down in it."""
        return macro.name not in self._in_a_row and any(
            other.name == macro.name and path == macro.file and start > macro.element.span.start
            for (path, start), other in self.definitions.items()
        )

    def is_used_elsewhere(self, name: str, path: str) -> bool:
        """Return if another file has a name in an expression or tag, or any sets it globally."""
        if name in self.assigned_globally or name in self._set_by_several:
            return True
        if self.has_computed_calls and name.startswith("xacro:"):
            return True
        return bool(self._readers.files.get(name, set()) - {path})


# --- namespaces: files that are included with `ns`, and what is in them -----------------------


class Namespaces:
    """Which files are in a namespace.

    Attributes:
        inside: the paths of the files whose names are seen in namespaces only.
        mixed: the paths of those that are included without one as well.
    """

    def __init__(
        self, main: str, roots: Mapping[str, Element], included: Mapping[tuple[str, int], list[str]]
    ) -> None:
        """Look at the includes of all files.

        Args:
            main: the path of the main file.
            roots: the root elements of all files, by path.
            included: the paths that an include means, by the place of its `filename`.
        """
        self._roots = roots
        self._included = included
        self._files: dict[tuple[str, str], list[str]] = {}
        """The files of a namespace, by the file that includes them and its name."""
        named: list[str] = []
        for path, root in roots.items():
            for element in _includes_of(root):
                if "ns" in element.attributes:
                    name = format_value(element.attributes["ns"])
                    self._files.setdefault((path, name), []).extend(self._meant_by(element))
                    named += self._meant_by(element)
        inside = self._reached_from(named)
        outside = self._reached_from([main])
        self.inside = inside - outside
        self.mixed = inside & outside

    def names(self, path: str) -> set[str]:
        """Return the names of the namespaces that a file makes."""
        return {name for includer, name in self._files if includer == path}

    def files(self, path: str, names: list[str]) -> list[str]:
        """Return the files of a namespace, as names of namespaces lead to it from a file."""
        paths = [path]
        for name in names:
            around = self._reached_from(paths)
            paths = [own for each in around for own in self._files.get((each, name), ())]
        return sorted(self._reached_from(paths))

    def reached_by(self, includes: list[Element]) -> set[str]:
        """Return the files that includes bring in, in namespaces or not."""
        paths = [path for element in includes for path in self._meant_by(element)]
        return reached_from(paths, self._included_by)

    def _meant_by(self, include: Element) -> list[str]:
        span = include.value_span("filename")
        paths = self._included.get((span.source.path, span.start), [])
        return [path for path in paths if path in self._roots]

    def _reached_from(self, paths: list[str]) -> set[str]:
        """Return files, with those that they include without a namespace."""
        return reached_from(paths, lambda path: self._included_by(path, in_namespaces=False))

    def _included_by(self, path: str, *, in_namespaces: bool = True) -> list[str]:
        includes = _includes_of(self._roots[path])
        wanted = [each for each in includes if in_namespaces or "ns" not in each.attributes]
        return [path for each in wanted for path in self._meant_by(each)]


def _includes_of(root: Element) -> list[Element]:
    return [element for element in root.iter() if element.name == "xacro:include"]


# --- names that have the same number wherever they are read, such as `pi` ---------------------


_WORD = re.compile(r"[^\W\d]\w*")
_PREDEFINED = {"pi": math.pi, "tau": math.tau}


def known_numbers(program: XacroProgram) -> dict[str, float]:
    """Return `pi`, `tau` and the properties of files that are defined once, as numbers."""
    others = {*program.arguments, *program.assigned_from_inside}
    others = others.union(*(macro.values() for macro in program.definitions.values()))
    found = {
        name: number
        for name, number in _PREDEFINED.items()
        if name not in others and name not in program.properties
    }
    at_top = {
        own.name: own.value.strip()
        for root in program.roots.values()
        for own in filter(None, map(definition_of, root.elements()))
        if own.is_property and {"name", "value"} <= own.element.attributes.keys()
    }
    pending = {
        name: text
        for name, text in at_top.items()
        if program.times_defined[name] == 1 and name not in others
    }
    made_of = {name: pending.keys() & set(_WORD.findall(text)) for name, text in pending.items()}
    readers: dict[str, list[str]] = {}
    for name, others in made_of.items():
        for other in others:
            readers.setdefault(other, []).append(name)
    degrees = Degrees(found)
    ready = [name for name in pending if not made_of[name]]
    for name in ready:  # grows meanwhile, by what is made of numbers that are known
        text = pending[name]
        is_expression = text.startswith("${") and text.find("}") == len(text) - 1
        number = degrees.value(f"$({text[2:-1]})" if is_expression else text)
        if number is None:
            continue
        found[name] = number
        for reader in readers.get(name, ()):
            made_of[reader].discard(name)
            if not made_of[reader]:
                ready.append(reader)
    return found
