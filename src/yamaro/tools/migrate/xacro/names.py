"""The names that a robot in xacro defines and reads, and how functions of Yamaro get them.

To xacro a macro sees the parameters and properties of its callers, and `$(arg prefix)` is another
thing than `${prefix}`. A function sees only its file's variables, its parameters, and what is said
to be for others; and an argument is a variable.
"""

from __future__ import annotations

import os
import re

from ....syntax.names import is_identifier
from ....xacro.statements import Parameter
from ....xacro.symbol_table import (
    PROPERTY,
    arguments_in,
    assigned_in,
    called_by,
    defined_in,
    definition_of,
    macros_inside,
    names_in,
    properties_in,
    texts_of,
    used_in,
    words_of_arguments,
    words_read,
)
from ....xml.tree import Element
from ....xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Container, Iterable, Iterator, Mapping
    from typing import TypeVar

    Thing = TypeVar("Thing")

    from ....xml.tree import Element
    from .program import Macro, XacroProgram


def camel(name: str) -> str:
    """Return a name as that of a function: `wheel_macro` becomes `WheelMacro`."""
    words = [word for word in re.split(r"[^A-Za-z0-9]+", name) if word]
    joined = "".join(word[0].upper() + word[1:] for word in words)
    return joined if joined[:1].isalpha() else f"F{joined}"


def common_folder(paths: list[str]) -> str:
    """Return the deepest folder that holds all of the files."""
    return os.path.commonpath([os.path.dirname(path) for path in paths])


def reached_from(
    starts: Iterable[Thing], following: Callable[[Thing], Iterable[Thing]]
) -> set[Thing]:
    """Return things with all that one leads to, `following` each: what is called or included."""
    reached = set(starts)
    pending = list(reached)
    while pending:
        new = set(following(pending.pop())) - reached
        reached |= new
        pending += new
    return reached


def is_plain(include: Element) -> bool:
    """Return whether an include names one file literally, and no namespace for it."""
    filename = format_value(include.attributes.get("filename"))
    return "ns" not in include.attributes and not any(mark in filename for mark in "$*?[")


# --- arguments that share their names with properties or parameters ---------------------------
# Where a macro has a parameter `prefix`, or a file a property of that name and another value, the
# argument is written as `arg_prefix`, which the main file declares beside it.


class HiddenArguments:
    """Finds the arguments that something of the same name hides.

    Attributes:
        everywhere: those that a property of a file hides, or one that macros hand to others.
        used: those, and the ones that a macro reads though it has a parameter of that name.
        replaced: those whose name is that of a property which other files or macros set.
    """

    def __init__(
        self,
        roots: Mapping[str, Element],
        main: str,
        macros: Iterable[Macro],
        inherited: Container[str],
    ) -> None:
        """Look at all files and macros.

        Args:
            roots: the root elements of the files, by path.
            main: the path of the main file.
            macros: all macros.
            inherited: the names that macros read of those who call them.
        """
        self._in_macros: dict[int, set[str]] = {}
        self.everywhere: set[str] = set()
        self.replaced: set[str] = set()
        read: set[str] = set()
        for path, root in roots.items():
            redefined = _redefined(root, without=macros_inside(root))
            self.everywhere |= redefined
            self.replaced |= redefined if path != main else set()
            read |= arguments_in(root)
        for macro in macros:
            redefined = _redefined(macro.element)
            hides = set(macro.values()) | redefined
            self._in_macros[id(macro.element)] = hides
            handed = redefined & assigned_in(macro.element)
            self.replaced |= handed
            self.everywhere |= {name for name in hides if name in inherited} | handed
        for path, root in roots.items():
            # a property that is made of the argument after it was something else reads that, too
            known = self.replaced.copy() if path == main else None
            for own in properties_in(root):
                if own.is_of_argument and (known is None or own.name in known):
                    read.add(own.name)
                if known is not None:
                    known.add(own.name)
        self.everywhere &= read
        inside_macros = set().union(
            *(
                arguments_in(macro.element, with_own=True) & self._in_macros[id(macro.element)]
                for macro in macros
            )
        )
        self.used = self.everywhere | inside_macros

    def in_macro(self, macro: Macro) -> set[str]:
        """Return the names that a macro hides in its body."""
        return self._in_macros[id(macro.element)]


def _redefined(root: Element, without: Container[int] = ()) -> set[str]:
    """Return the properties set in an element to something else than the argument of that name."""
    properties = properties_in(root, without)
    return {own.name for own in properties if own.name and not own.is_of_argument}


# --- files that read a name of another file ---------------------------------------------------


class Readers:
    """Finds the files that read a name of another file.

    Attributes:
        files: the files that read a name or call a macro (`xacro:name`), by that.
    """

    def __init__(self, program: XacroProgram) -> None:
        """Look at all macros, and at what is outside of macros in each file."""
        self.files: dict[str, set[str]] = {}
        macros = list(program.definitions.values())
        inside = {id(macro.element) for macro in macros}
        for macro in macros:
            without = inside - {id(macro.element)}
            own = {each.name.lstrip("*") for each in macro.parameters}
            for each in filter(None, map(definition_of, macro.element.elements())):
                if (  # a property that the macro always has of its own
                    each.kind == PROPERTY
                    and "value" in each.element.attributes
                    and "scope" not in each.element.attributes
                    and not each.is_of_argument
                    and each.name not in words_read(each.value)
                ):
                    own.add(each.name)
            self._add(program, macro.element, macro.file, own, without)
        for path, root in program.roots.items():
            self._add(program, root, path, set(), inside)

    def _add(
        self,
        program: XacroProgram,
        element: Element,
        path: str,
        own: set[str],
        without: Container[int],
    ) -> None:
        """Note what is read in an element and is not its own."""
        names = program.forwarded_in(element, without)
        arguments: set[str] = set()  # which no parameter hides
        for inner in element.iter(without):
            if inner.name.startswith("xacro:"):
                names.add(f"xacro:{called_by(inner)}")
            if inner.name in ("xacro:insert_block", "xacro:call"):
                given = inner.attributes.get("name", inner.attributes.get("macro"))
                prefix = "xacro:" if inner.name == "xacro:call" else ""
                names.add(f"{prefix}{format_value(given)}")
            for text in texts_of(inner):
                if "$" in text:
                    names |= words_read(text)
                arguments |= words_of_arguments(text)
        for name in (names - own) | (arguments & program.arguments.keys()):
            self.files.setdefault(name, set()).add(path)


# --- names that macros see and read of their callers ------------------------------------------


class Callers:
    """Finds the names that a macro may see."""

    def __init__(self, program: XacroProgram) -> None:
        """Note the names that macros have, and which macros call them, by their names."""
        self._at_top = program.at_top
        self._visible: dict[str, set[str]] = {}
        self._own_names: dict[str, set[str]] = {}
        self._callers: dict[str, set[str]] = {}
        for own in program.definitions.values():
            names = set(own.values()) | defined_in(own.element, nested=True)
            names |= program.handed_to(own.element)
            self._own_names.setdefault(own.name, set()).update(names)
            for called in own.element.iter():
                if called.name.startswith("xacro:"):
                    callers = self._callers.setdefault(called.name.removeprefix("xacro:"), set())
                    callers.add(own.name)

    def visible_in(self, macro: Macro) -> set[str]:
        """Return the names that a macro may see: its own, and those of all who may call it."""
        known = self._visible.get(macro.name)
        if known is None:
            names = reached_from([macro.name], lambda name: self._callers.get(name, ()))
            visible = self._at_top.union(*(self._own_names.get(name, ()) for name in names))
            known = self._visible[macro.name] = visible
        return known


def names_of_callers(program: XacroProgram) -> set[str]:
    """Return the names that macros read of those who call them."""
    free: set[str] = set()
    own: set[str] = set()
    for path, root in program.roots.items():
        for macro in _macros_in(program, path, root):
            free |= _unbound_in(program, macro, set(), own)
    return (free - program.at_top) & own


def _macros_in(program: XacroProgram, path: str, element: Element) -> list[Macro]:
    """Return the macros defined in an element, but not those in other macros."""
    found = []
    pending = element.elements()
    while pending:
        inner = pending.pop()
        macro = program.definitions.get((path, inner.span.start))
        if macro is not None and macro.element.name == inner.name:
            found.append(macro)
        else:
            pending += inner.elements()
    return found


def _unbound_in(program: XacroProgram, macro: Macro, around: set[str], own: set[str]) -> set[str]:
    """Return the names that a macro reads and nothing around it in the text defines.

    What is defined in it, and in macros in it, is added to `own`.
    """
    element = macro.element
    local = defined_in(element) | set(macro.values())
    own |= local
    bound = around | local | program.handed_to(element) | macro.from_caller
    nested = _macros_in(program, macro.file, element)
    inside = {id(other.element) for other in nested}
    free = (used_in(element, without=inside) | program.forwarded_in(element, inside)) - bound
    return free.union(*(_unbound_in(program, other, bound, own) for other in nested))


# --- names passed as parameters ---------------------------------------------------------------
# Where every caller surely has a name that a macro reads, the function gets a parameter of that
# name, and each call passes it on, as in other languages.


class _Site:
    """A call of a macro.

    Attributes:
        caller: the innermost macro that it is written in, or None.
        before: the elements of the caller before the one with the call.
        around: the macros that get it as part of a block.
    """

    __slots__ = ("around", "before", "caller")

    def __init__(
        self, caller: Macro | None, before: list[Element], around: Collection[Macro]
    ) -> None:
        self.caller = caller
        self.before = before
        self.around = around


class Passing:
    """Finds the names to pass."""

    def __init__(self, program: XacroProgram) -> None:
        """Look at all macros and calls of a robot."""
        self._program = program
        macros = list(program.definitions.values())
        self._nested = set().union(*(macros_inside(macro.element) for macro in macros))
        self._own = {
            macro: {
                *macro.values(),
                *defined_in(macro.element),
                *program.handed_to(macro.element),
            }
            for macro in macros
        }
        self._sites: dict[Macro, list[_Site]] = {macro: [] for macro in macros}
        self._reached: dict[Macro, set[Macro]] = {macro: set() for macro in macros}
        for macro in macros:
            children = macro.element.elements()
            for index, child in enumerate(children):
                self._find_calls(child, macro, children[:index], ())
        for root in program.roots.values():
            self._find_calls(root, None, [], ())
        self._reads: dict[Macro, set[str]] = {}
        for macro in macros:
            element = macro.element
            body = Element(element.name, element.span, {}, element.children)
            used = used_in(body, self._nested) | program.forwarded_in(body, self._nested)
            self._reads[macro] = used - self._own[macro] - program.at_top

    def _find_calls(
        self,
        element: Element,
        caller: Macro | None,
        before: list[Element],
        around: tuple[Macro, ...],
    ) -> None:
        """Note the calls in an element; macros in it are looked at separately."""
        if element.name == "xacro:macro":
            return
        macro = self._program.macro_called(element)
        if macro is not None:
            self._sites[macro].append(_Site(caller, before, around))
            if caller is not None:
                self._reached[caller].add(macro)
            around = (*around, macro)
        for child in element.elements():
            self._find_calls(child, caller, before, around)

    def add_parameters(self) -> None:
        """Give macros the parameters that they need, and note the defaults that calls pass."""
        program = self._program
        names = {name for own in self._own.values() for name in own}
        names -= program.at_top | program.blocks | program.assigned_from_inside
        for name in sorted(filter(is_identifier, names)):
            self._pass(name)

    def _pass(self, name: str) -> None:
        """Pass a name to all macros that read it, if all of their callers have it."""
        wanted = {macro for macro, read in self._reads.items() if name in read}
        defaults = {
            macro
            for macro, own in self._own.items()
            if name not in own
            and any(name in names_in(each.default or "") for each in macro.parameters)
        }
        pending = [*wanted, *defaults]
        while pending:
            macro = pending.pop()
            # not all calls of the macro are known
            program = self._program
            if not (
                program.has_one_definition(macro)
                and macro.file not in program.namespaces.inside
                and id(macro.element) not in self._nested
            ):
                return
            for site in self._sites[macro]:
                caller = site.caller
                if caller is None:
                    return
                if name not in self._own[caller]:
                    if caller not in wanted:
                        wanted.add(caller)
                        pending.append(caller)
                elif not self._is_bound(name, caller, site.before):
                    return
        # a call may be in a block, and a macro that inserts this may have such a name too
        called = wanted | defaults
        around = {own for macro in called for site in self._sites[macro] for own in site.around}
        reached = reached_from(around, self._reached.__getitem__)
        if any(name in self._own[macro] for macro in reached - wanted):
            return
        for macro in wanted:
            macro.parameters.append(Parameter(name, None, True, 0, 0))
        for macro in defaults:
            macro.from_caller.add(name)

    def _is_bound(self, name: str, caller: Macro, before: list[Element]) -> bool:
        """Return whether a caller has a name in any case."""
        if name in caller.values():
            return True
        for own in filter(None, map(definition_of, before)):
            given = own.element.attributes
            text = given.get("value", given.get("default"))
            if own.is_property and own.name == name and "scope" not in given and text is not None:
                # the variable that the property becomes has to have a value
                is_plain = "$" not in format_value(text)
                if is_plain or self._program.files.can_be_evaluated(own.element):
                    return True
        return False


# --- names of a macro that are read by what it calls and includes -----------------------------
# Such names become variables for what is below, where no parameter passes them.


KEYS_OF_INCLUDES = ("path", "namespace", "prefix")
"""What an include says besides the variables that it passes."""


class _Reads:
    """What is read in a macro or file alone, and where it goes on.

    Attributes:
        used: the names that it reads itself.
        own: the names that are defined in it.
        free: the other names that it, or what it reaches, reads.
        reached: the macros it calls and the files it includes.
    """

    __slots__ = ("free", "own", "reached", "used")

    def __init__(self, own: set[str], used: set[str], reached: set[Macro | str]) -> None:
        self.used = used
        self.own = own
        self.free = used - own
        self.reached = reached


class Callees:
    """Finds the names of macros that are read elsewhere.

    Attributes:
        hidden: the properties of files that a macro's own names hide from what it calls.
    """

    def __init__(self, program: XacroProgram, theirs: Container[str] = ()) -> None:
        """Look at all macros and files.

        Args:
            program: the robot.
            theirs: the paths of files that stay as they are.
        """
        self._program = program
        self._theirs = theirs
        self._reads: dict[object, _Reads] = {}
        inside = {id(macro.element) for macro in program.definitions.values()}
        for macro in program.definitions.values():
            within = inside - {id(macro.element)}
            reads = self._reads_of(macro.element, set(macro.values()), within)
            reads.free -= macro.from_caller
            self._reads[macro] = reads
        for path, root in program.roots.items():
            reads = self._reads[path] = self._reads_of(root, set(), inside)
            if path in program.included_by_macros:
                # the names that a file reads before it defines them itself
                first: set[str] = set()
                defined: set[str] = set()
                conditional: set[int] = set()
                for each in root.iter(inside):
                    first |= set().union(*map(names_in, texts_of(each))) - defined
                    if each.name in ("xacro:if", "xacro:unless"):
                        conditional.update(map(id, each.iter()))
                    elif "default" not in each.attributes and id(each) not in conditional:
                        own = definition_of(each)
                        if own is not None and own.is_property:
                            defined.add(own.name)
                reads.free |= first & defined_in(root)
        # let macros that are in others see the names of these, as functions do. What they call
        # does not see them
        by_element = {id(macro.element): macro for macro in program.definitions.values()}
        for outer in program.definitions.values():
            for element in outer.element.iter():
                inner = by_element.get(id(element))
                if inner is not None and inner is not outer:
                    self._reads[inner].free -= self._reads[outer].own
        # add what is read by what is reached, until nothing is new
        is_new = True
        while is_new:
            is_new = False
            for reads in self._reads.values():
                for other in reads.reached:
                    found = self._reads[other].free - reads.own - reads.free
                    is_new = is_new or bool(found)
                    reads.free |= found
        macros = program.definitions.values()
        self.hidden = program.at_top & set().union(*map(self.read_below, macros))

    def _reads_of(self, element: Element, parameters: set[str], inside: set[int]) -> _Reads:
        program = self._program
        own = parameters | defined_in(element) | program.handed_to(element)
        used = used_in(element, without=inside) | program.forwarded_in(element, inside)
        return _Reads(own, used, set(program.reached_from(element, inside)))

    def read_below(self, macro: Macro) -> set[str]:
        """Return the names of a macro that what it calls or includes reads."""
        reads = self._reads[macro]
        below: set[str] = set()
        for other in reads.reached:
            free = self._reads[other].free
            below |= free - self.passed_to(other, macro) if isinstance(other, str) else free
        return below & reads.own

    def names_around_blocks(self, macro: Macro) -> set[str]:
        """Return the names that a macro, or one it passes its blocks on to, has around them."""

        def given_blocks(own: Macro) -> Iterator[Macro]:
            for element in own.element.iter():
                called = self._program.macro_called(element)
                if called is not None and any(
                    inner.name == "xacro:insert_block" for inner in element.iter()
                ):
                    yield called

        macros = reached_from([macro], given_blocks)
        names = (self._reads[own].own | defined_in(own.element, nested=True) for own in macros)
        return set().union(*names)

    def passed_to(self, path: str, macro: Macro) -> set[str]:
        """Return the parameters of a macro that its includes of a file pass as variables.

        Those are the ones that the file itself reads, and nothing that it calls, includes or
        defines.
        """
        root = self._program.roots[path]
        if path in self._theirs or not all(
            is_plain(element)
            for element in macro.element.iter()
            if element.name == "xacro:include" and path in self._program.files.files_of(element)
        ):
            return set()
        reads = self._reads[path]
        own = [each for each in self._program.definitions.values() if each.file == path]
        deeper = set().union(*(self._reads[other].free for other in [*reads.reached, *own]))
        kept = {*KEYS_OF_INCLUDES, *defined_in(root), *self._program.arguments_read(root)}
        return (reads.used & set(macro.values())) - deeper - kept

    def is_set_for_all(self, name: str, macro: Macro) -> bool:
        """Return whether a macro calls first what sets a name for it and for all that it calls."""
        if name not in self._program.inherited:
            return False
        for child in macro.element.elements():
            called = self._program.macro_called(child)
            if called is not None and any(
                own.is_property and own.name == name and own.scope == "parent"
                for own in filter(None, map(definition_of, called.element.elements()))
            ):
                return True
            if any(self._program.reached_from(child)):
                return False
        return False
