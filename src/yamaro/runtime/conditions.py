"""Runs `if`: decides whether a condition holds, and refuses values that do not say."""

from __future__ import annotations

from ..diagnostics import failure
from ..syntax.nodes import Body, Constant, IfNode
from ..syntax.python import PythonCode
from .expressions import Evaluator, evaluate_bare
from .scope import Scope
from .words import a_kind_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ..diagnostics import YamaroError
    from ..fixes import Fix
    from ..source import Span
    from ..xml.tree import Node
    from .interpreter import Interpreter

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
    if isinstance(value, (str, bytes, bytearray)) or _is_always_true(value):
        raise _refusal(value, condition, scope, evaluator)
    return bool(evaluator.guard(bool, value, condition.span()))


def _check_operands(condition: PythonCode, scope: Scope, evaluator: Evaluator) -> None:
    """Raise YamaroError for a text such as 'no' that `not`, `and`, `or` or `if` takes for true."""
    from .origins import names_in, names_tested, notes_on_names

    if not any(_means_false(scope.find(name)) for name in names_in(condition.text)):
        return
    for name in names_tested(condition.text):
        value = scope.find(name)
        if _means_false(value):
            raise failure(
                "bad-condition",
                f"'{name}' is used as a condition here, but is {a_kind_of(value)}",
                condition.span(),
                hint=_hint(value, name),
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


def _is_always_true(value: Any) -> bool:
    """Return whether a value is a function or class, which is true whatever it would return."""
    kind = type(value)
    return callable(value) and not hasattr(kind, "__bool__") and not hasattr(kind, "__len__")


def _refusal(value: Any, condition: PythonCode, scope: Scope, evaluator: Evaluator) -> YamaroError:
    from .origins import names_of_value, notes_on_names

    written = condition.span().written().strip()
    names = names_of_value(condition, scope, value)
    asked = names[0] if names else written if " " not in written else "name"
    return failure(
        "bad-condition",
        f"a condition must be true, false or a number, not {a_kind_of(value)}",
        condition.span(),
        hint=_hint(value, asked) if isinstance(value, str) else f"call it: {asked}()",
        notes=notes_on_names(names, scope),
        trace=evaluator.frame,
        fix=_fix_of_word(condition.span(), value),
    )


def _fix_of_word(span: Span, value: Any) -> Fix | None:
    """Return the fix for `no`, `off` and their like, which YAML 1.1 took for truth values."""
    from ..fixes import replacement
    from .python_errors import YAML_1_1_BOOLEANS

    word = span.written()
    meant = YAML_1_1_BOOLEANS.get(word.lower())
    if meant is None or word != value:
        return None
    return replacement(span, meant, is_safe=True)


def _hint(text: str, asked: str) -> str:
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
