"""Arguments of xacro that share their names with properties or parameters of macros.

To xacro `$(arg prefix)` and `${prefix}` are two things, to Yamaro they are one variable. Where a
macro has a parameter `prefix`, or a file a property of that name and another value, the argument
is written as `arg_prefix`, which the main file declares beside it.
"""

from __future__ import annotations

import re

from ....xml.tree import Element
from ....xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Container, Iterable, Mapping

    from .macros import Macro

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
            handed = redefined & _handed_out(macro.element)
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
        and (name := format_value(element.attributes.get("name")))
        and not is_argument(format_value(element.attributes.get("value")), name)
    }


def _handed_out(macro: Element) -> set[str]:
    """Return the properties that a macro sets for others."""
    return {
        format_value(element.attributes.get("name"))
        for element in macro.iter()
        if element.name == "xacro:property" and "scope" in element.attributes
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
                name = format_value(element.attributes.get("name"))
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
        own = format_value(element.attributes.get("name"))
        for text in (*map(format_value, given), element.text()):
            found = arguments_of(text)
            is_own = element.name == "xacro:property" and not with_own
            names |= found - {own} if is_own else found
    return names


def arguments_of(text: str) -> set[str]:
    """Return the arguments that a text reads."""
    return {one or other for one, other in _ARGUMENT.findall(text)}
