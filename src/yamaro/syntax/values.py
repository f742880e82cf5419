"""Parses values: scalars, lists and mappings that become Python objects, and inline values.

An inline value is one in the middle of a text: a parameter's default, an argument in a short
call, a `name:=value` of the command line. It reads as a YAML scalar or flow collection.
"""

from __future__ import annotations

from ..diagnostics import failure
from ..source import Span
from ..yaml.brackets import find_close
from ..yaml.nodes import DOUBLE, PLAIN, ScalarNode, SequenceNode, is_null, type_plain
from ..yaml.reader import read_fragment
from .context import ParseContext
from .nodes import Constant, DictValue, ListValue, Value
from .python import PythonCode, compile_expression, expression_without_dollars
from .template import parse_expression, parse_template

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..yaml.nodes import YamlNode


def parse_value(node: YamlNode, context: ParseContext, *, is_literal: bool = False) -> Value:
    """Return a node as a value.

    Args:
        node: the YAML node.
        context: where findings go.
        is_literal: leave `$(…)` as it stands, as on the command line.

    Raises:
        YamaroError: an expression or number in it is faulty.
    """
    if isinstance(node, ScalarNode):
        return _parse_scalar(node, context, is_literal=is_literal)
    if isinstance(node, SequenceNode):
        items = [parse_value(item, context, is_literal=is_literal) for item in node.items]
        return ListValue(items, node.span())
    pairs: list[tuple[Value, Value]] = []
    for key, value in node.pairs:
        if node.is_flow:
            _warn_of_missing_space(key, value, context)
        pairs.append(
            (
                _parse_scalar(key, context, is_literal=is_literal),
                parse_value(value, context, is_literal=is_literal),
            )
        )
    return DictValue(pairs, node.span())


def _parse_scalar(node: ScalarNode, context: ParseContext, *, is_literal: bool) -> Value:
    if not is_literal:
        text = parse_template(node, context=context)
        if not isinstance(text, str):
            return text
        if text is not node.text:
            return Constant(text, node)
    if node.style != PLAIN:
        return Constant(node.text, node)
    warn_of_hidden_value(node, context)
    try:
        return Constant(type_plain(node.text), node)
    except OverflowError:
        raise failure(
            "number-too-long",
            f"this integer has {len(node.text):,} digits, more than can be read",
            node.span(),
            hint="quote it if it is text",
        ) from None


def warn_of_hidden_value(node: ScalarNode, context: ParseContext) -> None:
    """Warn of `color: #ff0000`, which YAML reads as an empty value and a comment."""
    if node.text or node.style != PLAIN:
        return
    text = node.source.text
    at = node.start
    if not text.startswith(" ", at):
        return
    while at < len(text) and text[at] == " ":
        at += 1
    if text[at : at + 1] != "#" or not text[at + 1 : at + 2].isalnum():
        return
    end = at
    while end < len(text) and text[end] not in "\r\n":
        end += 1
    from ..fixes import replacement

    hidden = text[at:end].rstrip()
    span = Span(node.source, at, at + len(hidden))
    context.warn(
        "hidden-value",
        f"'{hidden}' is a YAML comment, so the value is empty",
        span,
        hint=f"quote the value: '{hidden}'; put a space after # if it is a comment",
        fix=replacement(span, f"'{hidden}'") if "'" not in hidden else None,
    )


def _warn_of_missing_space(key: ScalarNode, value: YamlNode, context: ParseContext) -> None:
    """Warn of `{x:1}`, where YAML reads a key `x:1` without a value."""
    name, _, rest = key.text.partition(":")
    is_missing = isinstance(value, ScalarNode) and value.style == PLAIN and not value.text
    if is_missing and key.style == PLAIN and name.isidentifier() and rest:
        from ..fixes import replacement

        context.warn(
            "hidden-value",
            f"'{key.text}' is a YAML key with an empty value",
            key.span(),
            hint=f"put a space after the colon: {name}: {rest}",
            fix=replacement(key.span(), f"{name}: {rest}"),
        )


def parse_inline(
    node: ScalarNode, start: int, end: int, context: ParseContext, *, is_literal: bool = False
) -> Value:
    """Return the inline value in `node.text[start:end]`; see `parse_value`."""
    text = node.text
    while start < end and text[start].isspace():
        start += 1
    while end > start and text[end - 1].isspace():
        end -= 1
    if start < end and text[start] in "[{'\"":
        return parse_value(read_fragment(node, start, end), context, is_literal=is_literal)
    first = node.offset(start)
    last = node.offset(end - 1) + 1 if end > start else first
    style = PLAIN if start < end else DOUBLE  # nothing is the empty text, as in `name:=`
    part = ScalarNode(text[start:end], style, node.source, first, last)
    return _parse_scalar(part, context, is_literal=is_literal)


def split_inline(node: ScalarNode) -> list[tuple[int, int]]:
    """Return the stretches of a text between its commas.

    Commas inside quotes, brackets and `$(…)` do not separate.
    """
    text = node.text
    if not text.strip():
        return []
    stretches: list[tuple[int, int]] = []
    depth = 0
    start = at = 0
    opens_value = True  # a quote here begins a quoted text
    while at < len(text):
        char = text[at]
        if text.startswith("$(", at):
            close = find_close(text, at + 2)
            at = close if close >= 0 else at + 1
            opens_value = False
        elif char in "'\"" and opens_value:
            close = text.find(char, at + 1)
            at = close if close >= 0 else len(text)
            opens_value = False
        elif char in "[{":
            depth += 1
            opens_value = True
        elif char in "]}":
            depth -= 1
            opens_value = False
        elif char == "," and depth <= 0:
            stretches.append((start, at))
            start = at + 1
            opens_value = True
        elif char in ",=:":
            opens_value = True
        elif not char.isspace():
            opens_value = False
        at += 1
    stretches.append((start, len(text)))
    return stretches


def parse_condition(node: YamlNode, context: ParseContext) -> PythonCode | Constant:
    """Return a condition: a Python expression, or a YAML boolean, number or null.

    Raises:
        YamaroError: it is not an expression.
    """
    if not isinstance(node, ScalarNode):
        opening = "[" if isinstance(node, SequenceNode) else "{"
        raise failure(
            "bad-condition",
            "a condition is a Python expression, not a YAML list or mapping",
            node.span(),
            hint=f"quote an expression that begins with {opening}",
        )
    if node.style == PLAIN:
        try:
            value = type_plain(node.text)
        except OverflowError:
            value = node.text
        if not isinstance(value, str):
            warn_of_hidden_value(node, context)
            return Constant(value, node)
    return parse_bare_expression(node, context)


def parse_bare_expression(node: ScalarNode, context: ParseContext) -> PythonCode:
    """Return a scalar that is a Python expression as a whole; `$(e)` in it means `(e)`.

    Raises:
        YamaroError: it is not an expression.
    """
    if node.anchor is not None:
        context.warn(
            "anchored-expression",
            f"'&{node.anchor}' is a YAML anchor here, not a part of the expression",
            node.anchor_span(),
            hint="quote the whole expression, or delete the anchor",
        )
    text = node.text
    stripped = text.strip()
    if stripped.startswith("$(") and find_close(stripped, 2) == len(stripped) - 1:
        start = text.index("$(") + 2
        return parse_expression(node, start, text.rindex(")"), context)
    meaning, quoted = expression_without_dollars(text)
    for index in quoted:
        context.warn(
            "dollar-in-string",
            "$( inside a string of an expression is plain text",
            node.span(index, index + 2),
            hint="outside the quotes, write only the name: name == 'left'",
        )
    code = compile_expression(text, node, 0, context.rules, meaning=meaning)
    context.codes.append(code)
    return code


def is_empty(node: YamlNode) -> bool:
    """Return whether a node is null or an empty text."""
    if not isinstance(node, ScalarNode):
        return False
    return not node.text or (node.style == PLAIN and is_null(node.text))
