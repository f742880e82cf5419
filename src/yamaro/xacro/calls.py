"""Calls of macros: which macro is meant, what its parameters are, and the blocks it puts in."""

from __future__ import annotations

from ..diagnostics import Meant, YamaroError, did_you_mean, failure, suggest
from ..xml.tree import Element
from .scope import Macro, Macros, Scope, Site, assign
from .statements import PREFIX
from .tidying import lift_prefixes

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..xml.tree import Node
    from .expansion import Expansion


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
    call = Call(expansion, node, macro, expansion.scope(outer_scope), site)
    body = macro.element
    call.take_values()
    call.take_blocks()
    expansion.enter("called", PREFIX + name, node.span, macro.home)
    call.take_defaults()
    if expansion.evaluator.noted is not None:
        for parameter in macro.parameters:
            if not parameter.is_block:
                value = dict.get(call.scope, parameter.name)
                expansion.evaluator.noted.take_parameter(body, parameter, value)
    produced: list[Node] = []
    attributes: dict[str, object] = {}
    for key, value in body.attributes.items():  # xacro evaluates those of the definition, too
        place = expansion.place(body, key)
        attributes[key] = expansion.evaluator.text(value, call.scope, place)  # type: ignore[arg-type]
    attributes.pop("xmlns:xacro", None)
    holder = Element(body.name, body.span, attributes)
    inside = Site(produced, holder, Macros(outer_macros), call.scope)
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


class Call:
    """A call of a macro, whose parameters get their values.

    Attributes:
        node: the tag that calls.
        macro: what is called.
        scope: that of the macro, which the values are put in.
        site: where the call stands.
        missing: the parameters without a value so far.
    """

    __slots__ = ("expansion", "macro", "missing", "node", "scope", "site")

    def __init__(
        self, expansion: Expansion, node: Element, macro: Macro, scope: Scope, site: Site
    ) -> None:
        self.expansion = expansion
        self.node = node
        self.macro = macro
        self.scope = scope
        self.site = site
        self.missing = list(macro.parameters)

    def take_values(self) -> None:
        """Give the parameters that attributes name their values."""
        expansion = self.expansion
        for name, value in self.node.attributes.items():
            for parameter in self.missing:
                if parameter.name == name:
                    break
            else:
                known = [own.name for own in self.macro.parameters if not own.is_block]
                takes = f"its parameters are {', '.join(known)}" if known else "it takes no values"
                raise failure(
                    "xacro-unknown-parameter",
                    f"the macro '{self.macro.name}' has no parameter '{name}'",
                    self.node.name_span(name),
                    hint=did_you_mean(name, known) or takes,
                    notes=self._notes(),
                    trace=expansion.frame,
                )
            self.missing.remove(parameter)
            place = expansion.place(self.node, name)
            given = expansion.evaluator.value(value, self.site.scope, place)  # type: ignore[arg-type]
            assign(expansion, self.scope, name, given, place)

    def take_blocks(self) -> None:
        """Give the parameters that are blocks the elements in the call, in order."""
        node = self.node
        content: list[Node] = []
        if node.children:
            holder = Element(node.name, node.span)
            inside = Site(content, holder, self.site.macros, self.site.scope)
            self.expansion.children(node.children, inside)
        blocks = [child for child in content if isinstance(child, Element)]
        for parameter in [own for own in self.missing if own.is_block]:
            if not blocks:
                raise failure(
                    "xacro-missing-block",
                    f"the block '{parameter.name.lstrip('*')}' is missing",
                    node.span,
                    hint=f"it is an element in <{node.name}>",
                    notes=self._notes(),
                    trace=self.expansion.frame,
                )
            self.missing.remove(parameter)
            self.scope.blocks[parameter.name] = blocks.pop(0)
        if blocks:
            raise failure(
                "xacro-unused-block",
                f"the macro '{self.macro.name}' takes no block for <{blocks[0].name}>",
                blocks[0].span,
                notes=self._notes(),
                trace=self.expansion.frame,
            )

    def take_defaults(self) -> None:
        """Give the parameters that are left their defaults."""
        expansion, scope = self.expansion, self.site.scope
        defaults = {
            own.name: own
            for own in self.macro.parameters
            if own.default is not None or own.is_forwarded
        }
        for parameter in list(self.missing):
            name = parameter.name
            known = defaults.get(name)
            if known is None or known.is_block:
                continue
            place = expansion.place(self.macro.element, "params")
            place.shift = known.start
            if known.is_forwarded and scope.has(name):
                value = scope[name]
            elif known.default is not None:
                place.shift = known.end - len(known.default)
                value = expansion.evaluator.value(known.default, scope, place)
            else:
                raise self._lacking(
                    f"there is no property '{name}' for the parameter '{name}' "
                    f"of '{self.macro.name}'",
                    f'the caller has to have it, or to give it: {name}="…"',
                )
            self.missing.remove(parameter)
            assign(expansion, self.scope, name, value, place)
        if self.missing:
            names = ", ".join(f"'{own.name}'" for own in self.missing)
            raise self._lacking(f"the macro '{self.macro.name}' is called without {names}")

    def _lacking(self, message: str, hint: str | None = None) -> YamaroError:
        frame = self.expansion.frame
        return failure(
            "xacro-missing-parameter",
            message,
            self.node.span,
            hint=hint,
            notes=self._notes(),
            trace=frame.parent if frame else None,
        )

    def _notes(self) -> tuple[str]:
        return (f"'{self.macro.name}' is defined at {self.macro.element.span.place()}",)
