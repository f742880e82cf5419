"""The names that a robot in xacro defines and reads, and how functions of Yamaro get them.

To xacro a macro sees the parameters and properties of its callers, and `$(arg prefix)` is another
thing than `${prefix}`. A function sees only its file's variables, its parameters, and what is said
to be for others; and an argument is a variable.
"""

from __future__ import annotations

import ast
import os
import re

from ....syntax.names import is_identifier
from ....xacro.faults import Fault
from ....xacro.statements import Parameter
from ....xacro.templates import Expression, Substitution, parse_template
from ....xml.tree import Element
from ....xml.values import format_value
from ..elements import name_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Container, Iterable, Iterator, Mapping

    from ....xml.tree import Element
    from .program import Macro, XacroProgram


def camel(name: str) -> str:
    """Return a name as that of a function: `wheel_macro` becomes `WheelMacro`."""
    words = [word for word in re.split(r"[^A-Za-z0-9]+", name) if word]
    joined = "".join(word[0].upper() + word[1:] for word in words)
    return joined if joined[:1].isalpha() else f"F{joined}"


def defined_in(root: Element, *, nested: bool = False) -> set[str]:
    """Return the properties defined in an element, those of macros in it only if `nested`."""
    names = set()
    pending = [root]
    while pending:
        element = pending.pop()
        if element.name == "xacro:property":
            names.add(name_of(element))
        if element.name != "xacro:macro" or element is root or nested:
            pending += element.elements()
    return names


def texts_in(root: Element) -> Iterator[str]:
    """Return the values of attributes in an element, and its texts."""
    for element in root.iter():
        yield from map(format_value, element.attributes.values())
        yield element.text()


def outside_expressions(text: str) -> str:
    """Return what of a text is not Python: without `${…}`, but with the texts in it."""
    return re.sub(
        r"\$\{([^}]*)\}", lambda found: " ".join(re.findall(r"'[^']*'|\"[^\"]*\"", found[1])), text
    )


def used_in(root: Element, without: Container[int] = ()) -> set[str]:
    """Return the names in the expressions of an element, except elements of some identities."""
    names: set[str] = set()
    for element in root.iter(without):
        for text in (*map(format_value, element.attributes.values()), element.text()):
            names |= names_in(text)
    return names


def names_in(text: str) -> set[str]:
    """Return the names that the expressions of a text read."""
    names: set[str] = set()
    for tree in _expressions_in(text):
        found = [node for node in ast.walk(tree) if isinstance(node, ast.Name)]
        bound = {node.id for node in found if isinstance(node.ctx, ast.Store)}
        bound |= {node.arg for node in ast.walk(tree) if isinstance(node, ast.arg)}
        names |= {node.id for node in found} - bound
    return names


def _expressions_in(text: str) -> Iterator[ast.expr]:
    """Yield the expressions in a text, those that are Python."""
    for expression in re.findall(r"\$\{([^}]*)\}", text):
        try:
            yield ast.parse(re.sub(r"\$\([^)]*\)", "0", expression).strip(), mode="eval").body
        except (SyntaxError, ValueError):
            continue


def common_folder(paths: list[str]) -> str:
    """Return the deepest folder that holds all of the files."""
    return os.path.commonpath([os.path.dirname(path) for path in paths])


def computed_with(root: Element) -> set[str]:
    """Return the names that conditions are made of, or that expressions take for more than texts.

    A name that stands alone in an expression, or is compared with a text, is not.
    """
    names: set[str] = set()
    for element in root.iter():
        is_condition = element.name in ("xacro:if", "xacro:unless")
        for text in (*map(format_value, element.attributes.values()), element.text()):
            if is_condition:
                names.update(re.findall(r"\$\(arg\s+([\w-]+)\s*\)", text))
            for tree in _expressions_in(text):
                if is_condition or not isinstance(tree, ast.Name):
                    names |= _names_computed_with(tree)
    return names


def _names_computed_with(node: ast.AST) -> set[str]:
    if isinstance(node, ast.Name):
        return {node.id}
    if isinstance(node, ast.Compare):
        sides = [node.left, *node.comparators]
        if any(isinstance(own, ast.Constant) and isinstance(own.value, str) for own in sides):
            return set()
    return set().union(*map(_names_computed_with, ast.iter_child_nodes(node)))


def is_plain(include: Element) -> bool:
    """Return whether an include names one file literally, and no namespace for it."""
    filename = format_value(include.attributes.get("filename"))
    return "ns" not in include.attributes and not any(mark in filename for mark in "$*?[")


# --- arguments that share their names with properties or parameters ---------------------------
# Where a macro has a parameter `prefix`, or a file a property of that name and another value, the
# argument is written as `arg_prefix`, which the main file declares beside it.


_ARGUMENT = re.compile(r"""\$\(arg\s+([^()\s]+)\s*\)|\bxacro\.arg\(\s*['"]([^'"]+)['"]\s*\)""")


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
            inside = {id(child) for child in root.iter() if child.name == "xacro:macro"}
            redefined = _redefined(root, without=inside)
            self.everywhere |= redefined
            self.replaced |= redefined if path != main else set()
            read |= arguments_in(root)
        for macro in macros:
            redefined = _redefined(macro.element)
            hides = set(macro.values()) | redefined
            self._in_macros[id(macro.element)] = hides
            handed = redefined & {
                name_of(element)
                for element in macro.element.iter()
                if element.name == "xacro:property" and "scope" in element.attributes
            }
            self.replaced |= handed
            self.everywhere |= {name for name in hides if name in inherited} | handed
        self.everywhere &= read | _read_again(roots, main, self.replaced)
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
    return {
        name
        for element in root.iter(without)
        if element.name == "xacro:property"
        and (name := name_of(element))
        and not is_argument(format_value(element.attributes.get("value")), name)
    }


def _read_again(roots: Mapping[str, Element], main: str, known: Container[str]) -> set[str]:
    """Return the names whose property is made of the argument after it was something else.

    Args:
        roots: the root elements of the files, by path.
        main: the path of the main file.
        known: the names of the properties that other files or macros set to something else.
    """
    found: set[str] = set()
    for path, root in roots.items():
        defined: set[str] = set()
        for element in root.iter():
            if element.name == "xacro:property":
                name = name_of(element)
                is_first = path == main and name not in defined and name not in known
                if is_property_of(element, name) and not is_first:
                    found.add(name)
                defined.add(name)
    return found


def is_argument(text: str, name: str) -> bool:
    """Return whether a value is the argument of a name and nothing else."""
    return text.strip() == f"$(arg {name})"


def is_property_of(element: Element, name: str) -> bool:
    """Return whether an element makes a property of the argument of a name, under that name."""
    if element.name != "xacro:property" or element.attributes.get("name") != name:
        return False
    return is_argument(format_value(element.attributes.get("value")), name)


def arguments_in(root: Element, *, with_own: bool = False) -> set[str]:
    """Return the arguments that an element reads.

    Args:
        root: the element.
        with_own: whether a property that is made of the argument of its name reads that.
    """
    names: set[str] = set()
    for element in root.iter():
        given = [value for name, value in element.attributes.items() if name != "params"]
        own = name_of(element)
        for text in (*map(format_value, given), element.text()):
            found = arguments_of(text)
            is_own = element.name == "xacro:property" and not with_own
            names |= found - {own} if is_own else found
    return names


def arguments_of(text: str) -> set[str]:
    """Return the arguments that a text reads."""
    return {one or other for one, other in _ARGUMENT.findall(text)}


# --- files that read a name of another file ---------------------------------------------------


_WORD = re.compile(r"[^\W\d]\w*")
_READS_ARGUMENTS = re.compile(r"\$\(\s*(?:arg|eval)\b|\barg\s*\(")


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
            # the properties that a macro always has of its own
            names: set[str] = set()
            for element in macro.element.elements():
                name = name_of(element)
                text = format_value(element.attributes.get("value"))
                if (
                    element.name == "xacro:property"
                    and "value" in element.attributes
                    and "scope" not in element.attributes
                    and not is_argument(text, name)
                    and name not in _names_in(text)
                ):
                    names.add(name)
            own |= names
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
            # the names that an element alone reads
            found: set[str] = set()
            if inner.name.startswith("xacro:"):
                found.add(f"xacro:{inner.name.removeprefix('xacro:').rpartition('.')[2]}")
            if inner.name in ("xacro:insert_block", "xacro:call"):
                given = inner.attributes.get("name", inner.attributes.get("macro"))
                prefix = "xacro:" if inner.name == "xacro:call" else ""
                found.add(f"{prefix}{format_value(given)}")
            for written in (*map(format_value, inner.attributes.values()), inner.text()):
                if "$" in written:
                    found |= _names_in(written)
            names |= found
            for value in (*inner.attributes.values(), inner.text()):
                text = format_value(value)
                if _READS_ARGUMENTS.search(text):
                    arguments.update(_WORD.findall(text))
        for name in (names - own) | (arguments & program.arguments.keys()):
            self.files.setdefault(name, set()).add(path)


def _names_in(text: str) -> set[str]:
    """Return the names that a text reads, and more where that is not known."""
    try:
        parts = parse_template(text).parts
    except Fault:
        return set(_WORD.findall(text))
    names: set[str] = set()
    for part in parts:
        if isinstance(part, Expression):
            names |= _names_of(part.text)
        elif isinstance(part, Substitution) and ("$" in part.text or part.text[:4] != "find"):
            names |= set(_WORD.findall(part.text))
    return names


def _names_of(expression: str) -> set[str]:
    if "$" in expression or _READS_ARGUMENTS.search(expression):
        return set(_WORD.findall(expression))
    try:
        tree = ast.parse(expression.strip(), mode="eval")
    except (SyntaxError, ValueError):
        return set(_WORD.findall(expression))
    names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    in_namespaces = {node.attr for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
    return names | in_namespaces


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
            visible = set(self._at_top)
            pending, seen = [macro.name], {macro.name}
            while pending:
                name = pending.pop()
                visible |= self._own_names.get(name, set())
                new = self._callers.get(name, set()) - seen
                seen |= new
                pending += new
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
        self._nested = {
            id(inner)
            for macro in macros
            for inner in macro.element.iter()
            if inner is not macro.element and inner.name == "xacro:macro"
        }
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
        self._reads = {macro: self._read_by(macro) for macro in macros}

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

    def _read_by(self, macro: Macro) -> set[str]:
        """Return the names in the body of a macro that are not its own."""
        element = macro.element
        body = Element(element.name, element.span, {}, element.children)
        used = used_in(body, self._nested) | self._program.forwarded_in(body, self._nested)
        return used - self._own[macro] - self._program.at_top

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
        reached = {own for macro in called for site in self._sites[macro] for own in site.around}
        pending = list(reached)
        while pending:
            new = self._reached[pending.pop()] - reached
            reached |= new
            pending += new
        if any(name in self._own[macro] for macro in reached - wanted):
            return
        for macro in wanted:
            macro.parameters.append(Parameter(name, None, True, 0, 0))
        for macro in defaults:
            macro.from_caller.add(name)

    def _is_bound(self, name: str, caller: Macro, before: list[Element]) -> bool:
        """Return whether a caller has a name in any case."""
        return name in caller.values() or any(
            element.name == "xacro:property"
            and element.attributes.get("name") == name
            and "scope" not in element.attributes
            and self._is_evaluated(element)
            for element in before
        )

    def _is_evaluated(self, definition: Element) -> bool:
        """Return whether the variable that a property becomes will have a value."""
        text = definition.attributes.get("value", definition.attributes.get("default"))
        if text is not None and "$" not in format_value(text):
            return True
        return bool(text is not None and self._program.files.can_be_evaluated(definition))


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

    def __init__(self, own: set[str], used: set[str], reached: set[object]) -> None:
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
                    first |= used_in(Element(each.name, each.span, each.attributes)) - defined
                    first |= used_in(Element("text", each.span, {"text": each.text()})) - defined
                    if each.name in ("xacro:if", "xacro:unless"):
                        conditional.update(map(id, each.iter()))
                    elif (
                        each.name == "xacro:property"
                        and "default" not in each.attributes
                        and id(each) not in conditional
                    ):
                        defined.add(name_of(each))
                reads.free |= first & defined_in(root)
        # let macros that are in others see the names of these, as functions do. What they call
        # does not see them
        by_element = {id(macro.element): macro for macro in self._program.definitions.values()}
        for outer in self._program.definitions.values():
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
        reached: set[object] = set()
        for each in element.iter(inside):
            macro = program.macro_called(each)
            if macro is not None:
                reached.add(macro)
            elif each.name == "xacro:include":
                reached.update(program.files.files_of(each))
        used = used_in(element, without=inside) | program.forwarded_in(element, inside)
        return _Reads(own, used, reached)

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
        names: set[str] = set()
        pending, known = [macro], {macro}
        while pending:
            own = pending.pop()
            names |= self._reads[own].own | defined_in(own.element, nested=True)
            for element in own.element.iter():
                called = self._program.macro_called(element)
                is_passed = any(inner.name == "xacro:insert_block" for inner in element.iter())
                if called is not None and is_passed and called not in known:
                    known.add(called)
                    pending.append(called)
        return names

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
                each.name == "xacro:property"
                and each.attributes.get("name") == name
                and each.attributes.get("scope") == "parent"
                for each in called.element.elements()
            ):
                return True
            if self._reads_of(child, set(), set()).reached:
                return False
        return False
