"""Which names of a macro are read by what it calls and includes.

xacro looks a name up where a macro is called: what a macro calls, and a file that it includes, see
its parameters and properties. A function of Yamaro shows them only the variables that say so.
"""

from __future__ import annotations

from ....xml.tree import Element
from ....xml.values import format_value
from .includes import is_plain
from .names import defined_in, used_in
from .program import XacroProgram

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Container

    from .macros import Macro

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


def _read_first(root: Element, inside: set[int]) -> set[str]:
    """Return the names that a file reads before it defines them itself."""
    first: set[str] = set()
    defined: set[str] = set()
    conditional: set[int] = set()
    for element in root.iter(inside):
        first |= used_in(Element(element.name, element.span, element.attributes)) - defined
        first |= used_in(Element("text", element.span, {"text": element.text()})) - defined
        if element.name in ("xacro:if", "xacro:unless"):
            conditional.update(map(id, element.iter()))
        elif (
            element.name == "xacro:property"
            and "default" not in element.attributes
            and id(element) not in conditional
        ):
            defined.add(format_value(element.attributes.get("name")))
    return first & defined_in(root)


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
                reads.free |= _read_first(root, inside)
        self._bind_nested()
        self._hand_on()
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

    def _bind_nested(self) -> None:
        """Let macros that are in others see the names of these, as functions do.

        What they call does not see them.
        """
        by_element = {id(macro.element): macro for macro in self._program.definitions.values()}
        for outer in self._program.definitions.values():
            for element in outer.element.iter():
                inner = by_element.get(id(element))
                if inner is not None and inner is not outer:
                    self._reads[inner].free -= self._reads[outer].own

    def _hand_on(self) -> None:
        """Add what is read by what is reached, until nothing is new."""
        is_new = True
        while is_new:
            is_new = False
            for reads in self._reads.values():
                for other in reads.reached:
                    found = self._reads[other].free - reads.own - reads.free
                    is_new = is_new or bool(found)
                    reads.free |= found

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
