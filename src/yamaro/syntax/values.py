"""Parses values: scalars, lists and mappings that become Python objects, inline values, entries.

An inline value is one in the middle of a text: a parameter's default, an argument in a short
call, a `name:=value` of the command line. It reads as a YAML scalar or flow collection.
"""

from __future__ import annotations

from ..diagnostics import failure, given_twice, unknown_word
from ..source import Span
from ..yaml.brackets import find_close
from ..yaml.nodes import DOUBLE, PLAIN, MappingNode, ScalarNode, SequenceNode, is_null, type_plain
from ..yaml.reader import read_fragment
from .context import ParseContext
from .keys import find_outside
from .names import is_function_name, is_identifier
from .nodes import Constant, DictValue, ListValue, Value
from .python import (
    PythonCode,
    compile_expression,
    expression_without_dollars,
    parse_expression,
    parse_template,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..diagnostics import YamaroError
    from ..fixes import Fix
    from ..yaml.nodes import YamlNode


# --- mappings: repeated keys or lists, and the entries of statements --------------------------


Pairs = list[tuple[ScalarNode, "YamlNode"]]


def pairs_of(node: YamlNode, what: str, context: ParseContext) -> Pairs:
    """Return the pairs of a mapping, a list of mappings, or nothing at all.

    A list with an item that is something else gives the pairs of the others; the error is kept.

    Raises:
        YamaroError: it is something else.
    """
    if isinstance(node, MappingNode):
        return node.pairs
    if isinstance(node, ScalarNode):
        if is_empty(node):
            warn_of_hidden_value(node, context)
            return []
        raise failure(
            "not-a-body",
            f"{what} needs entries such as `name: value`, not a text",
            node.span(),
            hint=body_hint(node.text),
            fix=_fix_of_text(node),
        )
    pairs: Pairs = []
    fault: YamaroError | None = None
    for item in node.items:
        if isinstance(item, MappingNode):
            pairs.extend(item.pairs)
        elif fault is None:
            fault = failure(
                "not-a-body",
                f"in {what}, each item of the list must be an entry such as `name: value`",
                item.span(),
                hint=item_hint(item),
                fix=_fix_of_text(item) if isinstance(item, ScalarNode) else None,
            )
    if fault is not None:
        if not pairs:
            raise fault
        context.keep(fault)  # the others are looked at, and an editor knows what they declare
    return pairs


def is_mapping(node: YamlNode) -> bool:
    """Return whether a node is a mapping, or a list of mappings, which means the same."""
    if isinstance(node, SequenceNode):
        return bool(node.items) and all(isinstance(item, MappingNode) for item in node.items)
    return isinstance(node, MappingNode)


# Statements that are never empty, with the entries they take.
_OWN_ENTRIES = {
    "part": ("name", "joint", "link"),
    "for": ("iterator", "range", "in", "body"),
    "if": ("condition", "body"),
    "elif": ("condition", "body"),
    "include": ("path", "namespace"),
}


def refuse_not_indented(node: YamlNode, *, functions: bool = False) -> None:
    """Refuse a list item such as `- part:` whose entries are beside it instead of below it.

    With `functions`, the items are definitions of functions, not statements.

    Raises:
        YamaroError: an item is like that.
    """
    for item in () if isinstance(node, (ScalarNode, MappingNode)) else node.items:
        if not isinstance(item, MappingNode) or len(item.pairs) < 2:
            continue
        (key, value), (beside, _) = item.pairs[:2]
        own = ("input", "body") if functions else _OWN_ENTRIES.get(key.text, ())
        if isinstance(value, ScalarNode) and is_empty(value) and beside.text in own:
            raise failure(
                "not-indented",
                f"'{beside.text}' is beside '{key.text}', not below it",
                beside.span(),
                hint=f"indent `{beside.text}` and the lines below it by two more columns",
            )


def item_hint(item: YamlNode) -> str:
    """Return what a list item in place of an entry was probably meant to be."""
    if not isinstance(item, ScalarNode):
        return "write the entries of an inner list as items of this one: - name: value"
    if is_empty(item):
        return "delete this dash, or write an entry after it: - name: value"
    return body_hint(item.text)


def body_hint(text: str) -> str:
    """Return how to write the entry that a text means."""
    name, colon, value = text.partition(":")
    if is_function_name(text):
        return f"write `{text}:` with a colon to call a function"
    if text.startswith("<"):
        return 'this looks like XML; in YAML <link name="base"/> is written link/name=base:'
    variable, equals, value_of_variable = text.partition("=")
    if equals and is_identifier(variable.strip()) and value_of_variable[:1] != "=":
        return f"write {variable.strip()}: {value_of_variable.strip()}"
    if colon and is_identifier(name) and value:
        return f"put a space after the colon: {name}: {value}"
    if find_outside(text, " ", 0, len(text)) < 0 or "/" in text:
        return f"write `{text}:` with a colon for an entry without a value"
    return "write each entry as `name: value`, on a separate line"


def _fix_of_text(node: ScalarNode) -> Fix | None:
    """Return the fix that makes an entry of a text, as `body_hint` says."""
    from ..fixes import replacement

    text, span = node.text, node.span()
    if node.style or span.written() != text:
        return None
    if is_function_name(text):
        return replacement(span, f"{text}:", is_safe=True)
    variable, equals, value = text.partition("=")
    if equals and is_identifier(variable.strip()) and value[:1] != "=":
        return replacement(span, f"{variable.strip()}: {value.strip()}", is_safe=True)
    name, colon, value = text.partition(":")
    if colon and is_identifier(name) and value:
        return replacement(span, f"{name}: {value}", is_safe=value[:1] != "/")
    return None


class Entries:
    """The entries of a statement, each meant once, taken out one by one."""

    __slots__ = ("_known", "_pairs", "span", "what")

    def __init__(self, what: str, pairs: Pairs, known: Sequence[str], span: Span) -> None:
        """Check the entries of the statement `what`, written at `span`.

        Raises:
            YamaroError: a key is unknown, or given twice.
        """
        self.what = what
        self.span = span
        self._known = known
        self._pairs: dict[str, tuple[ScalarNode, YamlNode]] = {}
        for key, node in pairs:
            if key.text not in known:
                word = key.text
                names = [f"`{name}`" for name in known if name != "body"]
                rest = f"it takes {', '.join(names)}; statements and elements go under `body:`"
                if "condition" in known and find_outside(word, " ", 0, len(word)) >= 0:
                    rest = f"write condition: {word}, and the statements under `body:`"
                message = f"`{what}` has no entry '{word}'"
                raise unknown_word("unknown-key", message, key.span(), word, known, hint=rest)
            refuse_twice(self._pairs.get(key.text), key, what)
            self._pairs[key.text] = (key, node)

    def get(self, name: str) -> YamlNode | None:
        """Return the value of an entry, or None if it is not there."""
        pair = self._pairs.get(name)
        return pair[1] if pair else None

    def key(self, name: str) -> ScalarNode:
        """Return the key of an entry that is there."""
        return self._pairs[name][0]

    def need(self, name: str, example: str) -> YamlNode:
        """Return the value of an entry, or raise YamaroError if it is not there."""
        node = self.get(name)
        if node is None:
            raise failure(
                "missing-key",
                f"`{self.what}` needs an entry `{name}`",
                self.span,
                hint=f"write {name}: {example}",
            )
        return node


def refuse_twice(first: tuple[ScalarNode, YamlNode] | None, key: ScalarNode, what: str) -> None:
    """Raise YamaroError if an entry that is meant once was there before."""
    if first is not None:
        raise given_twice(
            f"'{key.text}' is given twice in this `{what}`",
            key.span(),
            first[0].span(),
            hint="keep one of the two",
        )


# --- values -----------------------------------------------------------------------------------


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
            name, _, rest = key.text.partition(":")
            is_missing = isinstance(value, ScalarNode) and value.style == PLAIN and not value.text
            if is_missing and key.style == PLAIN and name.isidentifier() and rest:
                from ..fixes import replacement

                context.report(
                    "hidden-value",
                    f"'{key.text}' is a YAML key with an empty value",
                    key.span(),
                    hint=f"put a space after the colon: {name}: {rest}",
                    fix=replacement(key.span(), f"{name}: {rest}"),
                )
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
    context.report(
        "hidden-value",
        f"'{hidden}' is a YAML comment, so the value is empty",
        span,
        hint=f"quote the value: '{hidden}'; put a space after # if it is a comment",
        fix=replacement(span, f"'{hidden}'") if "'" not in hidden else None,
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
        context.report(
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
        context.report(
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
