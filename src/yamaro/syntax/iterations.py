"""Parses what a `for` runs over, and the names it gives to it."""

from __future__ import annotations

from ..diagnostics import failure
from ..source import Span
from ..yaml.nodes import ScalarNode, SequenceNode
from .context import ParseContext
from .mappings import Entries
from .names import bad_variable_name, is_identifier, name_hint, python_name
from .nodes import Constant, Value
from .python import PythonCode
from .values import is_empty, parse_bare_expression, parse_condition, parse_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import NoReturn

    from ..yaml.nodes import YamlNode


Iterable = PythonCode | Value | list[PythonCode | Constant]
RANGE_FORMS = "write range: 6, or range: 0, 6, or range: 0, 6, 2"


def parse_iterator(node: YamlNode, context: ParseContext) -> list[str]:
    """Return the names in `iterator`; raise YamaroError if one cannot name a variable."""
    scalars = node.items if isinstance(node, SequenceNode) else [node]
    names: list[str] = []
    for scalar in scalars:
        if not isinstance(scalar, ScalarNode):
            raise failure(
                "bad-iterator", "an iterator is a name", scalar.span(), hint="iterator: i"
            )
        start = 0
        for piece in scalar.text.split(","):
            name = piece.strip()
            first = start + len(piece) - len(piece.lstrip())
            span = scalar.span(first, first + len(name)) if name else scalar.span()
            start += len(piece) + 1
            if name in names:
                raise failure("bad-iterator", f"'{name}' is given twice", span)
            if not is_identifier(name):
                raise failure(
                    "bad-iterator",
                    bad_variable_name(name) if name else "an iterator is a name",
                    span,
                    hint=name_hint(name)
                    if name
                    else "write iterator: i, or iterator: name, length",
                )
            names.append(python_name(name))
            context.declarations.append((names[-1], "local", span))
    if not names:
        raise failure("bad-iterator", "the iterator has no name", node.span(), hint="iterator: i")
    return names


def parse_range(node: YamlNode, context: ParseContext) -> list[PythonCode | Constant] | PythonCode:
    """Return the numbers of a `range`, as one expression or a list of them.

    Raises:
        YamaroError: they are not expressions, are missing, or are more than three.
    """
    if isinstance(node, SequenceNode):
        check_range_count(len(node.items), node.span())
        return [parse_condition(item, context) for item in node.items]
    if not isinstance(node, ScalarNode) or is_empty(node):
        raise failure(
            "bad-range",
            "`range` takes one to three numbers",
            node.span(),
            hint=RANGE_FORMS,
        )
    return parse_bare_expression(node, context)


def check_range_count(count: int, span: Span) -> None:
    """Raise YamaroError unless a `range` has one to three numbers."""
    if not 1 <= count <= 3:
        raise failure(
            "bad-range",
            f"`range` takes one to three numbers, and these are {count}",
            span,
            hint=RANGE_FORMS,
        )


def parse_in(node: YamlNode, context: ParseContext) -> Value | PythonCode:
    """Return what follows `in`: a YAML list or mapping, or an expression.

    Raises:
        YamaroError: it is not an expression.
    """
    if isinstance(node, ScalarNode):
        return parse_bare_expression(node, context)
    return parse_value(node, context)


def refuse_text_of_for(node: ScalarNode) -> NoReturn:
    """Raise YamaroError for a `for` with a text in place of its entries."""
    iterator, word, items = node.text.partition(" in ")
    raise failure(
        "not-a-body",
        "`for` has the entries `iterator`, `range` or `in`, and `body`",
        node.span(),
        hint=f"write `for {iterator.strip()} in {items.strip()}:` with the statements below it"
        if word
        else "write each entry as `name: value`, on a separate line",
    )


def parse_iterable(entries: Entries, names: int, context: ParseContext) -> tuple[Iterable, bool]:
    """Return what a `for` with this number of names runs over, and whether that is a range.

    Raises:
        YamaroError: there is nothing to run over, or two things, or a range for several names.
    """
    range_node, in_node = entries.get("range"), entries.get("in")
    if range_node is not None and in_node is not None:
        raise failure(
            "given-twice",
            "`for` takes `range` or `in`, not both",
            entries.key("in").span(),
            notes=[f"`range` is given at {entries.key('range').span().place()}"],
        )
    if range_node is not None:
        if names > 1:
            raise failure(
                "bad-iterator",
                "a `range` has single numbers, so the iterator has one name",
                entries.key("iterator").span(),
                hint="use `in` for pairs, as in `in: [[a, 1], [b, 2]]`",
            )
        return parse_range(range_node, context), True
    if in_node is None:
        raise failure(
            "missing-key",
            "`for` needs an entry `range` or `in`",
            entries.span,
            hint="write range: 6, or in: [left, right]",
        )
    if is_empty(in_node):
        raise failure(
            "missing-key",
            "`in` is empty",
            entries.key("in").span(),
            hint="write in: [left, right], or the name of a list",
        )
    return parse_in(in_node, context), False
