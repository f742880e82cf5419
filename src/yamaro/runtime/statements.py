"""Runs conditions, loops, declarations, messages and Python; and the table of all statements."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure
from ..namespace import MISSING
from ..policy import Limits
from ..source import Span
from ..syntax.nodes import (
    BRIDGE,
    GLOBAL,
    LOCAL,
    Body,
    CallNode,
    CommentNode,
    Constant,
    DynamicNode,
    ElementNode,
    ForNode,
    FunctionsNode,
    IfNode,
    IncludeNode,
    InsertNode,
    ListValue,
    PartNode,
    PrintNode,
    ProcessNode,
    RobotWordNode,
    TextNode,
    VariablesNode,
)
from ..syntax.python import PythonCode
from ..syntax.signatures import refuse_second_function, variable_name
from ..syntax.statements import check_range_count
from ..xml.tree import Comment, Element, Text
from ..yaml.nodes import ScalarPiece
from .calls import (
    Function,
    run_call,
    run_insert,
)
from .expressions import Evaluator, Values, a_kind_of, count, evaluate_bare, span_of
from .interpreter import Interpreter
from .markup import run_comment, run_dynamic, run_element, run_part, run_ready, run_static, run_text
from .scope import Scope, function_key

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any

    from ..xml.tree import Node
    from .interpreter import Handlers


# --- conditions -------------------------------------------------------------------------------


_TESTS = ("not ", "not(", "and ", "or ", "if ")
"""What an expression has in it that asks whether one of its parts is true."""


def run_if(
    interpreter: Interpreter, node: IfNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Run the first branch whose condition holds."""
    for condition, branch in node.branches:
        if condition is None or holds(condition, scope, interpreter.evaluator):
            interpreter.run_body(branch, scope, out)
            return


def holds(condition: PythonCode | Constant, scope: Scope, evaluator: Evaluator) -> bool:
    """Return whether a condition is true, by Python's rules for the value it has.

    Raises:
        YamaroError: it is a text or a function, which Python would mostly take for true.
    """
    if isinstance(condition, Constant):
        return bool(condition.value)
    if condition.name is None and any(word in condition.text for word in _TESTS):
        _check_operands(condition, scope, evaluator)
    hint = "a text in a comparison needs quotes: '{name}'"
    value = evaluate_bare(condition, scope, evaluator, hint=hint)
    if value is True or value is False:
        return bool(value)
    kind = type(value)
    is_always_true = (  # a function or class is true, whatever it would return
        callable(value) and not hasattr(kind, "__bool__") and not hasattr(kind, "__len__")
    )
    if isinstance(value, (str, bytes, bytearray)) or is_always_true:
        raise _refusal(value, condition, scope, evaluator)
    return bool(evaluator.guard(bool, value, condition.span()))


def _check_operands(condition: PythonCode, scope: Scope, evaluator: Evaluator) -> None:
    """Raise YamaroError for a text such as 'no' that `not`, `and`, `or` or `if` takes for true."""
    from .python_errors import names_in, names_tested, notes_on_names

    if not any(_means_false(scope.find(name)) for name in names_in(condition.text)):
        return
    for name in names_tested(condition.text):
        value = scope.find(name)
        if _means_false(value):
            raise failure(
                "bad-condition",
                f"'{name}' is used as a condition here, but is {a_kind_of(value)}",
                condition.span(),
                hint=_hint_for_condition(value, name),
                notes=notes_on_names([name], scope),
                trace=evaluator.frame,
            )


def _means_false(value: Any) -> bool:
    """Return whether a value is a text that means false, which Python takes for true."""
    if not isinstance(value, str):
        return False
    from .python_errors import YAML_1_1_BOOLEANS

    word = value.strip().lower()
    return word == "0" or YAML_1_1_BOOLEANS.get(word) == "false"


def _refusal(value: Any, condition: PythonCode, scope: Scope, evaluator: Evaluator) -> YamaroError:
    from ..fixes import replacement
    from .python_errors import YAML_1_1_BOOLEANS, names_of_value, notes_on_names

    written = condition.span().written()
    meant = None  # for `no`, `off` and their like, which YAML 1.1 took for truth values
    if isinstance(value, str) and written == value:
        meant = YAML_1_1_BOOLEANS.get(written.lower())
    written = written.strip()
    names = names_of_value(condition, scope, value)
    asked = names[0] if names else written if " " not in written else "name"
    return failure(
        "bad-condition",
        f"a condition must be true, false or a number, not {a_kind_of(value)}",
        condition.span(),
        hint=_hint_for_condition(value, asked) if isinstance(value, str) else f"call it: {asked}()",
        notes=notes_on_names(names, scope),
        trace=evaluator.frame,
        fix=replacement(condition.span(), meant, is_safe=True) if meant is not None else None,
    )


def _hint_for_condition(text: str, asked: str) -> str:
    """Return what to write for a text, or for what `asked` names, whose value it is."""
    from .python_errors import YAML_1_1_BOOLEANS

    word = text.strip()
    meant = YAML_1_1_BOOLEANS.get(word.lower())
    if word.isdigit() or word.lower() in ("true", "false"):
        return f"write {meant or word} without quotes; in quotes it is a text"
    if meant is not None:
        return f"write {meant}: in YAML 1.2 '{word}' is a text"
    if not word:
        return f"to test whether a text is not empty, write {asked} != ''"
    return f"compare the text: {asked} == 'left'"


# --- what a `for` runs over -------------------------------------------------------------------


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
        hint = "write in: [left, right], or the name of a list"
        if isinstance(values, (int, float)):
            hint = "write range: for a number of iterations"
            if isinstance(iterable, PythonCode) and isinstance(iterable.node, ScalarPiece):
                hint = f"write range({iterable.text.strip()}) for a number of turns"

        raise failure(
            "not-iterable",
            f"`in` needs a list, not {a_kind_of(values)}",
            span,
            hint=hint,
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
        assert isinstance(node.iterable, list)
        given = []
        for item in node.iterable:
            if isinstance(item, PythonCode):
                given.append(_RangeNumber(evaluator.evaluate(item, scope), item.span(), item))
            else:
                given.append(_RangeNumber(item.value, item.node.span(), item))
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


def _range_number(given: _RangeNumber, whole: list[Any] | None, node: ForNode, scope: Scope) -> int:
    """Return a number of a `range`; raise YamaroError if it is not a whole number."""
    value = given.value
    if type(value) is int:
        return value
    if not isinstance(value, bool) and hasattr(type(value), "__index__"):
        try:
            return int(type(value).__index__(value))
        except Exception:  # an array of several numbers has no index
            pass

    raise failure(
        "bad-range",
        f"`range` needs integers, not {a_kind_of(whole or given.value)}",
        given.span,
        hint=_range_hint_for_condition(given.value, node),
        notes=_origins(given.code, given.value, scope) or _origins(node.iterable, whole, scope),
    )


def _origins(code: object, value: Any, scope: Scope) -> list[str]:
    """Return notes on the variables of a piece of Python that have its value."""
    from .python_errors import names_of_value, notes_on_names

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


def too_many_turns(span: Span, limits: Limits) -> YamaroError:
    """Return the error for a `for` that goes on for too long."""
    return failure(
        "limit-turns",
        f"this `for` takes more than {limits.turns:,} turns, which is the limit",
        span,
        hint=limits.hint("turns"),
    )


def _range_hint_for_condition(value: object, node: ForNode) -> str:
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
        found = a_kind_of(item) if values is None else count(len(values), "value")
        if isinstance(node.iterable, PythonCode):
            span = node.iterable.span()
        else:
            assert not isinstance(node.iterable, list), "a range has single numbers"
            written = node.iterable
            span = span_of(written.items[index] if isinstance(written, ListValue) else written)
        raise failure(
            "bad-iterator",
            f"the iterator names {wanted} variables "
            f"({', '.join(node.names)}), but an item is {found}",
            span,
            hint="write each item as a list: in: [[a, 1.0], [b, 2.0]]",
        )
    return values


def _next(iterator: Iterator[Any]) -> Any:
    return next(iterator, MISSING)


# --- the statements ---------------------------------------------------------------------------


def run_for(
    interpreter: Interpreter, node: ForNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Run the body of a loop for each item.

    Raises:
        YamaroError: there are too many turns.
    """
    context = scope.context
    names = node.names
    single = names[0] if len(names) == 1 else None
    most, noted = interpreter.limits.turns, interpreter.noted
    for index, item in enumerate(iterate(node, scope, interpreter.values)):
        if index >= most:
            raise too_many_turns(node.span, interpreter.limits)
        interpreter.statements_left -= 1  # an empty body would count as none
        if interpreter.statements_left < 0:
            raise interpreter.too_many_statements(node.span)
        if single is not None:
            context.declare(single, item, place=node.span)
        else:
            values = unpack(item, index, node, interpreter.evaluator)
            for name, value in zip(names, values, strict=True):
                context.declare(name, value, place=node.span)
        if noted is not None:
            noted.take(context, names, node.span)
        interpreter.run_body(node.body, scope, out)


def run_variables(
    interpreter: Interpreter, node: VariablesNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Declare variables; what was passed in replaces what the file declares."""
    for entry in node.entries:
        name = entry.name
        if not isinstance(name, str):
            name = interpreter.values.joined(name, scope)
            if not name:
                continue
            name = variable_name(name, entry.span)
        place: Span | None = entry.span
        if node.is_root and scope.is_passed_in(name):
            if entry.scope == LOCAL and name in interpreter.shared_names.bridges:
                continue
            value, place = scope.find(name), scope.place_of(name)
        elif len(entry.values) == 1:
            value = interpreter.values.value(entry.values[0], scope)
        else:
            value = [interpreter.values.value(item, scope) for item in entry.values]
        scope.declare(name, value, entry.scope, place)


def run_functions(
    interpreter: Interpreter, node: FunctionsNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Define functions.

    Raises:
        YamaroError: there are two of one name.
    """
    for function in node.functions:
        key = function_key(function.name)
        earlier = scope.find(key)
        if (
            isinstance(earlier, Function)
            and earlier.closure is scope
            and earlier.node is not function
        ):
            refuse_second_function(earlier.node, function)
        defined = Function(function, scope)
        if function.scope in (GLOBAL, BRIDGE):
            interpreter.warn_of_replacement(
                interpreter.shared_names.find(key), defined, key, function.span
            )
        scope.declare(key, defined, function.scope)


def run_print(
    interpreter: Interpreter, node: PrintNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Pass on a message."""
    text = interpreter.values.message(node.value, scope, node.span)
    interpreter.evaluator.guard(interpreter.messages.say, text.removesuffix("\n") + "\n", node.span)


def run_process(
    interpreter: Interpreter, node: ProcessNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Run Python."""
    interpreter.evaluator.execute(node.code, scope)


def _run_include_late(
    interpreter: Interpreter, node: IncludeNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    from .includes import run_include

    run_include(interpreter, node, scope, out, body)


def _run_robot_word_late(
    interpreter: Interpreter, node: RobotWordNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    from .robot_words import run_robot_word

    run_robot_word(interpreter, node, scope, out, body)


HANDLERS: Handlers = {
    ElementNode: run_element,
    Element: run_static,
    Text: run_ready,
    Comment: run_ready,
    TextNode: run_text,
    CommentNode: run_comment,
    PartNode: run_part,
    RobotWordNode: _run_robot_word_late,
    CallNode: run_call,
    InsertNode: run_insert,
    DynamicNode: run_dynamic,
    IfNode: run_if,
    ForNode: run_for,
    IncludeNode: _run_include_late,
    VariablesNode: run_variables,
    FunctionsNode: run_functions,
    PrintNode: run_print,
    ProcessNode: run_process,
}
"""What runs each kind of statement: it is given the conversion, the statement, the scope, the list
that takes what is made, and the body around it."""
