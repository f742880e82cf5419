"""What a `for` runs over: ranges, lists, dicts, and whatever else Python iterates."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure
from ..namespace import MISSING
from ..policy import Limits
from ..source import Span
from ..syntax.nodes import ForNode, ListValue
from ..syntax.python import PythonCode
from ..syntax.statements import check_range_count
from ..yaml.nodes import ScalarPiece
from .expressions import Evaluator, evaluate_bare
from .scope import Scope
from .values import Values, span_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any


def iterate(node: ForNode, scope: Scope, values_of: Values) -> Iterator[Any]:
    """Give the items a `for` runs over; those of a dict as pairs if it names two variables.

    Raises:
        YamaroError: there is nothing to run over.
    """
    evaluator = values_of.evaluator
    if node.is_range:
        yield from _range(node, scope, evaluator)
        return
    iterable = node.iterable
    if isinstance(iterable, PythonCode):
        span = iterable.span()
        hint = _hint_for_texts(iterable)
        values = evaluate_bare(iterable, scope, evaluator, hint=hint)
    else:
        assert not isinstance(iterable, list)
        span = span_of(iterable)
        values = values_of.value(iterable, scope)
    if isinstance(values, dict):
        values = list(values.items() if len(node.names) > 1 else values)
    if not hasattr(type(values), "__iter__") and not hasattr(type(values), "__getitem__"):
        from .words import a_kind_of

        raise failure(
            "not-iterable",
            f"`in` needs a list, not {a_kind_of(values)}",
            span,
            hint=_hint_for_turns(iterable)
            if isinstance(values, (int, float))
            else "write in: [left, right], or the name of a list",
            notes=_origins(iterable, values, scope),
        )
    iterator = evaluator.guard(iter, values, span)
    while True:
        item = evaluator.guard(_next, iterator, span)
        if item is MISSING:
            return
        yield item


class _RangeNumber:
    """A number of a `range` before it is known to be one: its value, and where it is written."""

    __slots__ = ("code", "span", "value")

    def __init__(self, value: Any, span: Span, code: object) -> None:
        self.value = value
        self.span = span
        self.code = code  # what it was evaluated from; None for an item of a variable's list


def _range(node: ForNode, scope: Scope, evaluator: Evaluator) -> range:
    whole: list[Any] | None = None  # a variable's list in place of numbers
    if isinstance(node.iterable, PythonCode):
        result = evaluator.evaluate(node.iterable, scope)
        whole = result if isinstance(result, list) else None
        values = list(result) if isinstance(result, (tuple, list)) else [result]
        code = None if whole is not None else node.iterable
        span = node.iterable.span()
        given = [_RangeNumber(value, span, code) for value in values]
    else:
        given = _written_numbers(node, scope, evaluator)
    check_range_count(len(given), given[0].span if given else node.span)
    numbers = [_range_number(one, whole, node, scope) for one in given]
    if len(numbers) == 3 and numbers[2] == 0:
        raise failure(
            "bad-range",
            "the step of a `range` cannot be 0",
            given[2].span,
            hint="write range: start, stop, step with a step such as 1 or -1",
        )
    turns = range(*numbers)
    most = evaluator.limits.turns
    if turns[:most] != turns:  # len() of a long range is an error
        raise too_many_turns(given[min(1, len(given) - 1)].span, evaluator.limits)
    return turns


def _written_numbers(node: ForNode, scope: Scope, evaluator: Evaluator) -> list[_RangeNumber]:
    """Return the numbers of a `range` that is written as a list."""
    assert isinstance(node.iterable, list)
    found = []
    for item in node.iterable:
        if isinstance(item, PythonCode):
            found.append(_RangeNumber(evaluator.evaluate(item, scope), item.span(), item))
        else:
            found.append(_RangeNumber(item.value, item.node.span(), item))
    return found


def _range_number(given: _RangeNumber, whole: list[Any] | None, node: ForNode, scope: Scope) -> int:
    """Return a number of a `range`; raise YamaroError if it is not a whole number."""
    number = _whole_number(given.value)
    if number is not None:
        return number
    from .words import a_kind_of

    raise failure(
        "bad-range",
        f"`range` needs integers, not {a_kind_of(whole or given.value)}",
        given.span,
        hint=_range_hint(given.value, node),
        notes=_origins(given.code, given.value, scope) or _origins(node.iterable, whole, scope),
    )


def _origins(code: object, value: Any, scope: Scope) -> list[str]:
    """Return notes on the variables of a piece of Python that have its value."""
    from .origins import names_of_value, notes_on_names

    if not isinstance(code, PythonCode):
        return []
    return notes_on_names(names_of_value(code, scope, value), scope)


def _hint_for_texts(iterable: PythonCode) -> str:
    """Return what to write where a name in `in` was meant as a text."""
    text = iterable.text.strip()
    if not isinstance(iterable.node, ScalarPiece):
        return f"this is an expression; write texts as a list: in: [{iterable.text}]"
    words = [word.strip() for word in text.strip("[]").split(",")]
    quoted = ", ".join(f"'{word}'" for word in words)
    return f"Python follows `in`, where texts are quoted: [{quoted}]"


def _hint_for_turns(iterable: object) -> str:
    if isinstance(iterable, PythonCode) and isinstance(iterable.node, ScalarPiece):
        return f"write range({iterable.text.strip()}) for a number of turns"
    return "write range: for a number of iterations"


def _whole_number(value: Any) -> int | None:
    """Return a value as the whole number that it is; None for all else, booleans included."""
    if type(value) is int:
        return value
    if isinstance(value, bool) or not hasattr(type(value), "__index__"):
        return None
    try:
        return int(type(value).__index__(value))
    except Exception:  # an array of several numbers has no index
        return None


def too_many_turns(span: Span, limits: Limits) -> YamaroError:
    """Return the error for a `for` that goes on for too long."""
    return failure(
        "limit-turns",
        f"this `for` takes more than {limits.turns:,} turns, which is the limit",
        span,
        hint=limits.hint("turns"),
    )


def _range_hint(value: object, node: ForNode) -> str:
    if isinstance(value, float) and value - value != 0:
        return "write a number of iterations, such as range: 6"
    if isinstance(value, float):
        return f"write int(…) around it to truncate {value} to an integer"
    if isinstance(value, str) and value.strip().isdigit():
        return "is the number quoted where it is declared? int(…) converts a text to a number"
    written = node.iterable.text.strip() if isinstance(node.iterable, PythonCode) else ","
    if "," not in written and not isinstance(value, bool):
        return f"to iterate over a list, write in: {written}"
    return "write range: 6, or range: 0, 6, or in: for the items of a list"


def unpack(item: Any, index: int, node: ForNode, evaluator: Evaluator) -> list[Any]:
    """Return the values of one item for an iterator of several names.

    Raises:
        YamaroError: it has another number of values.
    """
    wanted = len(node.names)
    if isinstance(item, str) or not hasattr(type(item), "__iter__"):
        values: list[Any] | None = None
    else:
        values = list(evaluator.guard(list, item, node.span))
    if values is None or len(values) != wanted:
        from .words import a_kind_of, count

        found = a_kind_of(item) if values is None else count(len(values), "value")
        raise failure(
            "bad-iterator",
            f"the iterator names {wanted} variables "
            f"({', '.join(node.names)}), but an item is {found}",
            _item_span(node, index),
            hint="write each item as a list: in: [[a, 1.0], [b, 2.0]]",
        )
    return values


def _item_span(node: ForNode, index: int) -> Span:
    """Return where the item of a turn is written, or what it comes from."""
    iterable = node.iterable
    if isinstance(iterable, PythonCode):
        return iterable.span()
    assert not isinstance(iterable, list), "a range has single numbers"
    return span_of(iterable.items[index] if isinstance(iterable, ListValue) else iterable)


def _next(iterator: Iterator[Any]) -> Any:
    return next(iterator, MISSING)
