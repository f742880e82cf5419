"""Parses `variables`, and the scopes behind declared names."""

from __future__ import annotations

from ..diagnostics import failure
from ..source import Span
from ..yaml.nodes import ScalarNode
from .context import ParseContext
from .keys import find_outside
from .mappings import pairs_of
from .names import bad_variable_name, is_identifier, name_hint, python_name
from .nodes import SCOPES, VariableEntry, VariablesNode
from .template import parse_template
from .values import parse_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..yaml.nodes import YamlNode


def split_scope(key: ScalarNode, what: str) -> tuple[int, str]:
    """Return where the name in `name/scope` ends, and the scope.

    Raises:
        YamaroError: the scope does not exist.
    """
    text = key.text
    slash = find_outside(text, "/", 0, len(text))
    if slash < 0:
        return len(text), "local"
    scope = text[slash + 1 :].strip()
    if scope not in SCOPES:
        from ..suggestions import meant_word

        span = key.span(slash + 1) if scope else key.span()
        hint, fix = meant_word(scope, SCOPES, span)
        raise failure(
            "unknown-scope",
            f"'{scope}' is not a scope of a {what}",
            span,
            hint=hint or f"the scopes are {', '.join(SCOPES)}",
            fix=fix,
        )
    return slash, scope


def parse_variables(key: ScalarNode, node: YamlNode, context: ParseContext) -> VariablesNode:
    """Return a `variables:` statement; what is wrong with one entry does not hide the others."""
    entries: dict[str, VariableEntry] = {}
    every: list[VariableEntry] = []
    for own, value in pairs_of(node, "`variables`", context):
        entry = context.attempt(_parse_variable, own, value, context)
        if entry is None:
            continue
        if isinstance(entry.name, str):
            earlier = entries.get(entry.name)
            if earlier is not None:
                context.attempt(_join_entries, earlier, entry)
                continue
            entries[entry.name] = entry
            context.declarations.append((entry.name, entry.scope, entry.span))
        else:
            context.declarations.append(("", "computed", entry.span))
        every.append(entry)
    return VariablesNode(every, is_root=False, span=key.span())


def _parse_variable(key: ScalarNode, node: YamlNode, context: ParseContext) -> VariableEntry:
    value = parse_value(node, context)
    end, scope = split_scope(key, "variable")
    while end > 0 and key.text[end - 1].isspace():
        end -= 1
    name = parse_template(key, 0, end, context=context)
    span = key.span(0, end) if end else key.span()
    if isinstance(name, str):
        name = variable_name(name, span)
    return VariableEntry(name, scope, [value], span)


def variable_name(name: str, span: Span) -> str:
    """Return a variable's name as Python spells it.

    Raises:
        YamaroError: it cannot name a variable.
    """
    if not is_identifier(name):
        raise failure("bad-variable-name", bad_variable_name(name), span, hint=name_hint(name))
    return python_name(name)


def _join_entries(earlier: VariableEntry, entry: VariableEntry) -> None:
    if earlier.scope != entry.scope:
        raise failure(
            "given-twice",
            f"'{entry.name}' is declared here with two scopes, {earlier.scope} and {entry.scope}",
            entry.span,
            notes=[f"first declared at {earlier.span.place()}"],
        )
    earlier.values.extend(entry.values)
