"""Scopes: what a name in an expression means, and macros by name.

A scope is the dict that Python looks names up in. It finds a scope's own names without our help;
`__missing__` evaluates those that are evaluated when they are first needed, and looks into the
scopes around.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import Any

    from ..diagnostics import Frame
    from ..xml.tree import Element
    from .parameters import Parameter
    from .places import XacroPlace

_MISSING = object()


class Lazy:
    """The value of a property as text, to be evaluated when it is needed."""

    __slots__ = ("place", "text")

    def __init__(self, text: str, place: XacroPlace) -> None:
        self.text = text
        self.place = place


class XacroBlock:
    """An element that `insert_block` puts in.

    Attributes:
        element: what is put in, evaluated or not.
        is_content: whether its content is put in, without itself.
    """

    __slots__ = ("element", "is_content")

    def __init__(self, element: Element, is_content: bool) -> None:
        self.element = element
        self.is_content = is_content


class Scope(dict[str, "Any"]):
    """The names of a file, a macro call, or a namespace.

    Attributes:
        parent: the scope around; the outermost of all is a plain dict, the names that are
            predefined.
        lazy: what is not evaluated yet.
        blocks: blocks by name, and with `**` before it where their content is meant.
        resolving: the names that are being evaluated.
    """

    __slots__ = ("_resolve", "blocks", "lazy", "parent", "resolving")

    def __init__(self, parent: dict[str, Any], resolve: Callable[[Scope, str, Lazy], Any]) -> None:
        dict.__setitem__(self, "__builtins__", {})
        self.parent = parent
        self.lazy: dict[str, Lazy] = {}
        self.blocks: dict[str, Element] = {}
        self.resolving: list[str] = []
        self._resolve = resolve

    def __missing__(self, name: str) -> Any:
        scope: Any = self
        while isinstance(scope, Scope):
            value = dict.get(scope, name, _MISSING)
            if value is not _MISSING:
                return value
            if name in scope.lazy:
                return scope._resolve(scope, name, scope.lazy[name])
            scope = scope.parent
        return scope[name]

    def __setitem__(self, name: str, value: Any) -> None:
        self.put(name, value)  # `:=` in an expression

    def has(self, name: str) -> bool:
        """Return whether the name has a meaning here."""
        scope: Any = self
        while isinstance(scope, Scope):
            if dict.__contains__(scope, name) or name in scope.lazy:
                return True
            scope = scope.parent
        return name in scope

    def put(self, name: str, value: Any) -> None:
        """Give a name a value."""
        self.lazy.pop(name, None)
        dict.__setitem__(self, name, value)

    def set_lazy(self, name: str, lazy: Lazy) -> None:
        """Give a name a value that is evaluated when it is needed."""
        dict.pop(self, name, None)
        self.lazy[name] = lazy

    def remove(self, name: str) -> None:
        """Take a name out of this and all scopes around."""
        for own in self.chain():
            dict.pop(own, name, None)
            own.lazy.pop(name, None)

    def block(self, name: str) -> XacroBlock | None:
        """Return the block of that name; one whose content is meant comes first."""
        for key, is_content in (("**" + name, True), ("*" + name, False)):
            for own in self.chain():
                if key in own.blocks:
                    return XacroBlock(own.blocks[key], is_content)
        return None

    def block_names(self) -> set[str]:
        """Return the names of all blocks."""
        return {key.lstrip("*") for own in self.chain() for key in own.blocks}

    def chain(self) -> Iterator[Scope]:
        """Return this scope and those around, from the inside."""
        scope: Any = self
        while isinstance(scope, Scope):
            yield scope
            scope = scope.parent

    def root(self) -> dict[str, Any]:
        """Return the names that are predefined."""
        return self.top().parent

    def top(self) -> Scope:
        """Return the outermost scope."""
        scope = self
        while isinstance(scope.parent, Scope):
            scope = scope.parent
        return scope

    def own_names(self) -> list[str]:
        """Return the names that the file defines, for suggestions."""
        known = {name for own in self.chain() for name in (*own, *own.lazy)}
        return [name for name in known if not name.startswith("__")]


class Namespace(Scope):
    """The names of a file that was included with `ns`; `ns.name` is one of them."""

    __slots__ = ()

    def __getattr__(self, name: str) -> Any:
        return attribute(self, name)


class Names(dict[str, "Any"]):
    """Names that are predefined under one name: math, python, xacro."""

    __slots__ = ()

    def __getattr__(self, name: str) -> Any:
        return attribute(self, name)


def attribute(names: dict[str, Any], name: str) -> Any:
    """Return the value of `names.name`."""
    if name.startswith("__"):
        raise AttributeError(name)
    try:
        return names[name]
    except KeyError:
        raise NameError(f"name '{name}' is not defined", name=name) from None


class Macro:
    """A macro. When its name is defined again in the same scope, it becomes the new one.

    Attributes:
        element: its definition.
        parameters: in the order in which they are listed.
        home: the include that brought in the file it is written in.
    """

    __slots__ = ("element", "home", "parameters")

    def __init__(self, element: Element, parameters: list[Parameter], home: Frame | None) -> None:
        self.element = element
        self.parameters = parameters
        self.home = home


class Macros(dict[str, "Macro | Macros"]):
    """Macros by name, with those of the calls around, and namespaces by name."""

    __slots__ = ("parent",)

    def __init__(self, parent: Macros | None = None) -> None:
        self.parent = parent

    def find(self, name: str) -> Macro | Macros | None:
        """Return what a name means here or in the scopes around."""
        macros: Macros | None = self
        while macros is not None:
            found = macros.get(name)
            if found is not None:
                return found
            macros = macros.parent
        return None

    def names(self) -> list[str]:
        """Return all names, with those in namespaces, for suggestions."""
        found: list[str] = []
        macros: Macros | None = self
        while macros is not None:
            for name, value in macros.items():
                if isinstance(value, Macro):
                    found.append(name)
                else:
                    found += [f"{name}.{inner}" for inner in value.names()]
            macros = macros.parent
        return found
