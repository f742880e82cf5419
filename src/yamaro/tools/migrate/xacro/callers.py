"""Which names macros see and read of the macros that call them."""

from __future__ import annotations

from .names import defined_in, used_in

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ....xml.tree import Element
    from .macros import Macro
    from .program import XacroProgram


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
