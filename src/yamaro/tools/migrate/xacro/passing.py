"""Passes names as parameters that macros read from the macros that call them.

A macro of xacro sees the parameters and properties of its callers. Where every caller surely has a
name, the function gets a parameter of that name, and each call passes it on, as in other languages.
"""

from __future__ import annotations

from ....syntax.names import is_identifier
from ....xacro.statements import Parameter
from ....xml.tree import Element
from ....xml.values import format_value
from .names import defined_in, names_in, used_in

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection

    from .macros import Macro
    from .program import XacroProgram


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
            if not self._may_have_parameters(macro):
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
        if self._are_hidden(name, wanted, wanted | defaults):
            return
        for macro in wanted:
            macro.parameters.append(Parameter(name, None, True, 0, 0))
        for macro in defaults:
            macro.from_caller.add(name)

    def _may_have_parameters(self, macro: Macro) -> bool:
        """Return whether all calls of a macro are known."""
        program = self._program
        return (
            program.has_one_definition(macro)
            and macro.file not in program.namespaces.inside
            and id(macro.element) not in self._nested
        )

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

    def _are_hidden(self, name: str, wanted: set[Macro], called: set[Macro]) -> bool:
        """Return if a call is in a block, and a macro that inserts this has such a name too."""
        reached = {own for macro in called for site in self._sites[macro] for own in site.around}
        pending = list(reached)
        while pending:
            new = self._reached[pending.pop()] - reached
            reached |= new
            pending += new
        return any(name in self._own[macro] for macro in reached - wanted)
