"""Which names of a macro are read by what it calls and includes.

xacro looks a name up where a macro is called: what a macro calls, and a file that it includes, see
its parameters and properties. A function of Yamaro shows them only the variables that say so.
"""

from __future__ import annotations

from ....xml.tree import Element
from ....xml.values import format_value
from ..elements import walk
from .program import Program, defined_in, used_in

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .program import Macro


class _Reads:
    """What is read in a macro or file by itself, and where it goes on.

    Attributes:
        own: the names that are defined in it.
        bound: those, and the ones of the macros that it stands in.
        free: the other names that it, or what it reaches, reads.
        reached: the macros it calls and the files it includes.
    """

    __slots__ = ("bound", "free", "own", "reached")

    def __init__(self, own: set[str], used: set[str], reached: set[object]) -> None:
        self.own = own
        self.bound = own
        self.free = used - own
        self.reached = reached


def _read_first(root: Element, inside: set[int]) -> set[str]:
    """Return the names that a file reads before it defines them itself."""
    first: set[str] = set()
    defined: set[str] = set()
    conditional: set[int] = set()
    for element in walk(root, inside):
        first |= used_in(Element(element.name, element.span, element.attributes)) - defined
        first |= used_in(Element("text", element.span, {"text": element.text()})) - defined
        if element.name in ("xacro:if", "xacro:unless"):
            conditional.update(map(id, walk(element)))
        elif element.name == "xacro:property" and id(element) not in conditional:
            defined.add(format_value(element.attributes.get("name")))
    return first & defined_in(root)


class Reach:
    """Tells which names of macros are read elsewhere.

    Attributes:
        hidden: the properties of files that a macro's own names hide from what it calls.
    """

    def __init__(self, program: Program) -> None:
        """Look at all macros and files."""
        self._program = program
        self._reads: dict[object, _Reads] = {}
        inside = {id(macro.element) for macro in program.definitions.values()}
        for macro in program.definitions.values():
            within = inside - {id(macro.element)}
            self._reads[macro] = self._reads_of(macro.element, set(macro.values()), within)
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
        for each in walk(element, inside):
            macro = program.macro_called(each)
            if macro is not None:
                reached.add(macro)
            elif each.name == "xacro:include":
                reached.update(program.files_of(each))
        return _Reads(own, used_in(element, without=inside), reached)

    def _bind_nested(self) -> None:
        """Let macros that stand in others see the names of these, as functions do."""
        by_element = {id(macro.element): macro for macro in self._program.definitions.values()}
        for outer in self._program.definitions.values():
            for element in walk(outer.element):
                inner = by_element.get(id(element))
                if inner is not None and inner is not outer:
                    reads = self._reads[inner]
                    reads.bound = reads.bound | self._reads[outer].own
                    reads.free -= reads.bound

    def _hand_on(self) -> None:
        """Add what is read by what is reached, until nothing is new."""
        is_new = True
        while is_new:
            is_new = False
            for reads in self._reads.values():
                for other in reads.reached:
                    found = self._reads[other].free - reads.bound - reads.free
                    is_new = is_new or bool(found)
                    reads.free |= found

    def read_below(self, macro: Macro) -> set[str]:
        """Return the names of a macro that what it calls or includes reads."""
        reads = self._reads[macro]
        below = set().union(*(self._reads[other].free for other in reads.reached))
        return below & reads.own
