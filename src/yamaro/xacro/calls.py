"""Calls of macros: which macro is meant, what its parameters are, and the blocks it puts in."""

from __future__ import annotations

from ..diagnostics import Meant, YamaroError, did_you_mean, failure, suggest
from ..xml.tree import Element
from .scope import Macro, Macros, Scope, Site, assign
from .statements import PREFIX
from .tidying import lift_prefixes

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ..xml.tree import Node
    from .expansion import Expansion
    from .places import XacroPlace
    from .statements import Parameter


def call_macro(expansion: Expansion, node: Element, site: Site) -> None:
    """Add the expansion of the macro that the tag names."""
    _call(expansion, node, node.name[len(PREFIX) :], site)


def call_by_name(expansion: Expansion, node: Element, site: Site) -> None:
    """Add the expansion of the macro that `<xacro:call macro="…">` names."""
    (given,) = expansion.statements.require(node, "macro")
    place = expansion.place(node, "macro")
    name = expansion.evaluator.text(given, site.scope, place)
    if not given:
        raise failure(
            "xacro-unknown-macro", "no macro is named", place.span(), trace=expansion.frame
        )
    others = {key: value for key, value in node.attributes.items() if key != "macro"}
    named = Element(
        PREFIX + name, node.span, others, node.children, node.trace, node.value_spans, True
    )
    _call(expansion, named, name, site)


def insert_block(expansion: Expansion, node: Element, site: Site) -> None:
    """Put in a block: a parameter of a macro, or a property without a value."""
    name = expansion.statements.attributes(node, ("name",))["name"]
    block = site.scope.block(name)
    if block is None:
        raise failure(
            "xacro-unknown-block",
            f"there is no block '{name}'",
            node.value_span("name"),
            hint=did_you_mean(name, site.scope.block_names()) or _block_hint(name, site.scope),
            trace=expansion.frame,
        )
    evaluated = expansion.element(block.element, site.macros, site.scope)
    if block.is_content:
        site.out += evaluated.children
    else:
        site.out.append(evaluated)


def _block_hint(name: str, scope: Scope) -> str:
    if scope.has(name):
        return f"'{name}' is a value; write ${{{name}}}"
    return f'a macro takes a block with params="*{name}"'


def _call(expansion: Expansion, node: Element, name: str, site: Site) -> None:
    found = _find(name, site.macros, site.scope)
    if found is None:
        near = suggest(name, site.macros.names())
        hint = Meant.of(PREFIX + name, PREFIX + near) if near else None
        raise failure(
            "xacro-unknown-macro",
            f"there is no macro '{name}' here",
            node.span,
            hint=hint or "a macro is defined, or its file included, above the place of its call",
            trace=expansion.frame,
        )
    macro, outer_macros, outer_scope = found
    scope = expansion.scope(outer_scope)
    missing = list(macro.parameters)
    body = macro.element
    _take_values(expansion, node, macro, missing, scope, site)
    _take_blocks(expansion, node, macro, missing, scope, site)
    expansion.enter("called", PREFIX + name, node.span, macro.home)
    _take_defaults(expansion, node, macro, missing, scope, site)
    produced: list[Node] = []
    attributes: dict[str, object] = {}
    for key, value in body.attributes.items():  # xacro evaluates those of the definition, too
        place = expansion.place(body, key)
        attributes[key] = expansion.evaluator.text(value, scope, place)  # type: ignore[arg-type]
    attributes.pop("xmlns:xacro", None)
    holder = Element(body.name, body.span, attributes)
    inside = Site(produced, holder, Macros(outer_macros), scope)
    expansion.children(body.children, inside)
    expansion.leave()
    leave_mark = expansion.leave_mark(node, site)
    lift_prefixes(expansion, holder, site.holder)
    site.out += produced
    leave_mark()


def _find(name: str, macros: Macros, scope: Scope) -> tuple[Macro, Macros, Scope] | None:
    """Return a macro with the macros and the scope it sees; those of the call, or a namespace."""
    found = macros.find(name)
    if isinstance(found, Macro):
        return found, macros, scope
    *namespaces, own = name.split(".")
    for namespace in namespaces:
        inner = macros.find(namespace)
        try:
            inner_scope = scope[namespace]
        except KeyError:
            return None
        if not isinstance(inner, Macros) or not isinstance(inner_scope, Scope):
            return None
        macros, scope = inner, inner_scope
    found = macros.find(own) if namespaces else None
    return (found, macros, scope) if isinstance(found, Macro) else None


def _take_values(
    expansion: Expansion,
    node: Element,
    macro: Macro,
    missing: list[Parameter],
    scope: Scope,
    site: Site,
) -> None:
    """Give the parameters that attributes name their values."""
    for name, value in node.attributes.items():
        for parameter in missing:
            if parameter.name == name:
                break
        else:
            known = [own.name for own in macro.parameters if not own.is_block]
            raise failure(
                "xacro-unknown-parameter",
                f"the macro '{_name(macro)}' has no parameter '{name}'",
                node.name_span(name),
                hint=did_you_mean(name, known)
                or (f"its parameters are {', '.join(known)}" if known else "it takes no values"),
                notes=_defined(macro),
                trace=expansion.frame,
            )
        missing.remove(parameter)
        place = expansion.place(node, name)
        given = expansion.evaluator.value(value, site.scope, place)  # type: ignore[arg-type]
        assign(expansion, scope, name, given, place)


def _take_blocks(
    expansion: Expansion,
    node: Element,
    macro: Macro,
    missing: list[Parameter],
    scope: Scope,
    site: Site,
) -> None:
    """Give the parameters that are blocks the elements in the call, in order."""
    content: list[Node] = []
    holder = Element(node.name, node.span)
    if node.children:
        inside = Site(content, holder, site.macros, site.scope)
        expansion.children(node.children, inside)
    blocks = [child for child in content if isinstance(child, Element)]
    for parameter in [own for own in missing if own.is_block]:
        if not blocks:
            raise failure(
                "xacro-missing-block",
                f"the block '{parameter.name.lstrip('*')}' is missing",
                node.span,
                hint=f"it is an element in <{node.name}>",
                notes=_defined(macro),
                trace=expansion.frame,
            )
        missing.remove(parameter)
        scope.blocks[parameter.name] = blocks.pop(0)
    if blocks:
        raise failure(
            "xacro-unused-block",
            f"the macro '{_name(macro)}' takes no block for <{blocks[0].name}>",
            blocks[0].span,
            notes=_defined(macro),
            trace=expansion.frame,
        )


def _take_defaults(
    expansion: Expansion,
    node: Element,
    macro: Macro,
    missing: list[Parameter],
    scope: Scope,
    site: Site,
) -> None:
    """Give the parameters that are left their defaults."""
    defaults = {
        own.name: own for own in macro.parameters if own.default is not None or own.is_forwarded
    }
    for parameter in list(missing):
        known = defaults.get(parameter.name)
        if known is None or known.is_block:
            continue
        place = expansion.place(macro.element, "params")
        value = _default_of(known, place, expansion, node, macro, site)
        missing.remove(parameter)
        assign(expansion, scope, parameter.name, value, place)
    if missing:
        names = ", ".join(f"'{own.name}'" for own in missing)
        raise _missing(
            f"the macro '{_name(macro)}' is called without {names}", expansion, node, macro
        )


def _default_of(
    known: Parameter,
    place: XacroPlace,
    expansion: Expansion,
    node: Element,
    macro: Macro,
    site: Site,
) -> Any:
    """Return the default of a parameter, and move `place` to where it is written."""
    name, default = known.name, known.default
    place.shift = known.start
    if known.is_forwarded and site.scope.has(name):
        return site.scope[name]
    if default is not None:
        place.shift = known.end - len(default)
        return expansion.evaluator.value(default, site.scope, place)
    raise _missing(
        f"there is no property '{name}' for the parameter '{name}' of '{_name(macro)}'",
        expansion,
        node,
        macro,
        hint=f'the caller has to have it, or to give it: {name}="…"',
    )


def _missing(
    message: str, expansion: Expansion, node: Element, macro: Macro, hint: str | None = None
) -> YamaroError:
    return failure(
        "xacro-missing-parameter",
        message,
        node.span,
        hint=hint,
        notes=_defined(macro),
        trace=expansion.frame.parent if expansion.frame else None,
    )


def _defined(macro: Macro) -> tuple[str]:
    return (f"'{_name(macro)}' is defined at {macro.element.span.place()}",)


def _name(macro: Macro) -> str:
    return str(macro.element.attributes["name"]).removeprefix(PREFIX)
