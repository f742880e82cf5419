"""Properties, arguments and macros: what defines a name."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure
from .literals import guess_value, is_property_name, truth
from .places import XacroPlace
from .scope import Lazy, Macro, Namespace, Scope

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ..xml.tree import Element
    from .expansion import Expansion
    from .site import Site
    from .statements import Property


def declare_argument(expansion: Expansion, node: Element, site: Site) -> None:
    """Give an argument its default, if it has no value."""
    given = expansion.statements.attributes(node, ("name", "default"))
    arguments = expansion.evaluator.arguments
    arguments.used.add(given["name"])
    if given["name"] not in arguments:
        place = expansion.place(node, "default")
        arguments[given["name"]] = expansion.evaluator.text(given["default"], site.scope, place)
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
        _remove(expansion, name, given, scope)
        return
    text, attribute = given.value, "value"
    if given.default is not None:
        if given.scope is not None:
            _warn_of_scope(expansion, name, node)
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
        _make_lazy(target, name, text, place)


def _warn_of_scope(expansion: Expansion, name: str, node: Element) -> None:
    expansion.reporter.warn(
        "xacro-scope",
        f"the default of '{name}' is looked at in this scope only",
        node.value_span("scope"),
        hint="leave scope out",
        trace=expansion.frame,
    )


def assign(expansion: Expansion, scope: Scope, name: str, value: Any, place: XacroPlace) -> None:
    """Give a name a value, which is a number if its text is one."""
    warn_if_hiding(expansion, name, place)
    scope.put(name, guess_value(value))


def warn_if_hiding(expansion: Expansion, name: str, place: XacroPlace) -> None:
    """Warn of a new name that all expressions know as something else."""
    if name in expansion.evaluator.names:
        expansion.reporter.warn(
            "xacro-redefined",
            f"'{name}' has a meaning in all expressions, which is hidden here",
            place.span(),
            hint="choose another name",
            trace=expansion.frame,
        )


def _make_lazy(scope: Scope, name: str, text: str, place: XacroPlace) -> None:
    """Have a value evaluated when it is needed, if it is a text still."""
    value = dict.__getitem__(scope, name)
    if not isinstance(value, str):
        return
    if "$" in value:
        place.shift = len(value) < len(text)  # the quote that was taken off
        scope.set_lazy(name, Lazy(value, place))
    else:
        scope.put(name, guess_value(value))


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


def _remove(expansion: Expansion, name: str, given: Property, scope: Scope) -> None:
    scope.remove(name)
    if name in expansion.evaluator.names:
        expansion.reporter.warn(
            "xacro-redefined",
            f"'{name}' has a meaning in all expressions, which cannot be removed",
            given.element.value_span("name"),
            trace=expansion.frame,
        )


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
