"""Scopes: what a name in an expression means, and macros by name.

A scope is the dict that Python looks names up in. It finds a scope's own names without our help;
`__missing__` evaluates those that are evaluated when they are first needed, and looks into the
scopes around.
"""

from __future__ import annotations

from ..diagnostics import YamaroError, failure
from .places import XacroPlace
from .templates import guess_value, is_property_name, truth

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import Any

    from ..diagnostics import Frame
    from ..xml.tree import Element, Node
    from .expansion import Expansion
    from .places import XacroPlace
    from .statements import Parameter, Property

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


class PredefinedNames(dict[str, "Any"]):
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

    @property
    def name(self) -> str:
        """Return what it is called, without `xacro:`."""
        return str(self.element.attributes["name"]).removeprefix("xacro:")


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


# --- where the expansion of a tag goes --------------------------------------------------------


class Site:
    """The inside of an element that is being built, and what names mean there.

    Attributes:
        out: its content so far.
        holder: takes the attributes and declarations of prefixes meant for the element.
        macros, scope: what names mean.
        is_last: whether nothing follows in the element.
    """

    __slots__ = ("holder", "is_last", "macros", "out", "scope")

    def __init__(self, out: list[Node], holder: Element, macros: Macros, scope: Scope) -> None:
        self.out = out
        self.holder = holder
        self.macros = macros
        self.scope = scope
        self.is_last = False


# --- properties, arguments and macros: what defines a name ------------------------------------


def declare_argument(expansion: Expansion, node: Element, site: Site) -> None:
    """Give an argument its default, if it has no value."""
    given = expansion.statements.attributes(node, ("name", "default"))
    arguments = expansion.evaluator.arguments
    arguments.used.add(given["name"])
    if given["name"] not in arguments:
        place = expansion.place(node, "default")
        arguments[given["name"]] = expansion.evaluator.text(given["default"], site.scope, place)
    if expansion.evaluator.noted is not None:
        expansion.evaluator.noted.take_name(node, given["name"], arguments[given["name"]])
    expansion.leave_mark(node, site)()


def define_macro(expansion: Expansion, node: Element, site: Site) -> None:
    """Define a macro."""
    leave_mark = expansion.leave_mark(node, site)
    macro = expansion.statements.macro(node)
    known = site.macros.get(macro.name)
    if isinstance(known, Macro):
        known.element, known.parameters, known.home = node, macro.parameters, expansion.frame
    else:
        site.macros[macro.name] = Macro(node, macro.parameters, expansion.frame)
    leave_mark()


def define_property(expansion: Expansion, node: Element, site: Site) -> None:
    """Define a property, or remove it."""
    expansion.leave_mark(node, site)()
    given = expansion.statements.property(node)
    scope = site.scope
    name = _name(expansion, given, scope)
    is_removed = _truth(expansion, given, "remove", False, scope)
    if (given.value is not None) + (given.default is not None) + is_removed > 1:
        raise _fault(
            expansion,
            "xacro-property",
            f"the property '{name}' has more than one of value, default and remove",
            node,
        )
    if is_removed and scope.has(name):
        scope.remove(name)
        if name in expansion.evaluator.names:
            expansion.reporter.report(
                "xacro-redefined",
                f"'{name}' has a meaning in all expressions, which cannot be removed",
                given.element.value_span("name"),
                trace=expansion.frame,
            )
        return
    text, attribute = given.value, "value"
    if given.default is not None:
        if given.scope is not None:
            expansion.reporter.report(
                "xacro-scope",
                f"the default of '{name}' is looked at in this scope only",
                node.value_span("scope"),
                hint="leave scope out",
                trace=expansion.frame,
            )
        if scope.has(name):
            return
        text, attribute = given.default, "default"
    is_lazy = _truth(expansion, given, "lazy_eval", True, scope)
    target = scope
    if given.scope == "global":
        target, is_lazy = scope.top(), False
    elif given.scope == "parent":
        target, is_lazy = _parent(expansion, given, scope), False
    if text is None:
        target.blocks["**" + name] = node
        return
    place = expansion.place(node, attribute)
    value: Any = text if is_lazy else expansion.evaluator.value(text, scope, place)
    assign(expansion, target, name, value, place)
    if is_lazy:
        value = dict.__getitem__(target, name)
        if isinstance(value, str) and "$" in value:
            place.shift = len(value) < len(text)  # the quote that was taken off
            target.set_lazy(name, Lazy(value, place))
        elif isinstance(value, str):
            target.put(name, guess_value(value))
    if expansion.evaluator.noted is not None and name not in target.lazy:
        expansion.evaluator.noted.take_name(node, name, dict.__getitem__(target, name))


def assign(expansion: Expansion, scope: Scope, name: str, value: Any, place: XacroPlace) -> None:
    """Give a name a value, which is a number if its text is one."""
    warn_if_hiding(expansion, name, place)
    scope.put(name, guess_value(value))


def warn_if_hiding(expansion: Expansion, name: str, place: XacroPlace) -> None:
    """Warn of a new name that all expressions know as something else."""
    if name in expansion.evaluator.names:
        expansion.reporter.report(
            "xacro-redefined",
            f"'{name}' has a meaning in all expressions, which is hidden here",
            place.span(),
            hint="choose another name",
            trace=expansion.frame,
        )


def _name(expansion: Expansion, given: Property, scope: Scope) -> str:
    place = expansion.place(given.element, "name")
    name = expansion.evaluator.value(given.name, scope, place)
    if not isinstance(name, str) or not is_property_name(name):
        problem = f"'{name}' is not a name that an expression could use"
    elif name.startswith("__"):
        problem = f"the name '{name}' begins with '__', which xacro does not allow"
    else:
        return name
    raise failure(
        "xacro-name",
        problem,
        place.span(),
        hint="a name has letters, digits and _, does not begin with a digit, "
        "and is not a keyword of Python",
        trace=expansion.frame,
    )


def _truth(
    expansion: Expansion, given: Property, attribute: str, default: bool, scope: Scope
) -> bool:
    text = getattr(given, attribute)
    if not text:
        return default
    place = expansion.place(given.element, attribute)
    value = expansion.evaluator.value(text, scope, place)
    try:
        return truth(value)
    except Exception:
        raise failure(
            "xacro-condition",
            f'{attribute}="{value}" is neither true nor false',
            place.span(),
            trace=expansion.frame,
        ) from None


def _parent(expansion: Expansion, given: Property, scope: Scope) -> Scope:
    """Return the scope of the caller, or the one around a namespace."""
    parent = scope.parent
    if not isinstance(scope, Namespace):
        while isinstance(parent, Namespace):
            parent = parent.parent
    if not isinstance(parent, Scope):
        raise _fault(
            expansion,
            "xacro-scope",
            'there is nothing around this place for scope="parent"',
            given.element,
            "scope",
        )
    return parent


def _fault(
    expansion: Expansion, code: str, message: str, node: Element, attribute: str = ""
) -> YamaroError:
    span = node.value_span(attribute) if attribute else node.span
    return failure(code, message, span, trace=expansion.frame)
