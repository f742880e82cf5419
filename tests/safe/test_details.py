"""Safe mode in detail: the words of each refusal, each price and limit, and what Python gives too.

The tables are in tests/safe/details. A line that begins with `!` holds statements.
"""

from __future__ import annotations

import ast
import math
import statistics
import sys
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from yamaro.safe.code import Rewriter, compile_safe
from yamaro.safe.limits import RUN_IT, SafeLimits, SafetyError
from yamaro.safe.runtime import SafeRuntime
from yamaro.safe.values import OrderedSet

np = pytest.importorskip("numpy")

FOLDER = Path(__file__).parent / "details"
MODULES = ("math", "numpy", "statistics")
FREE = 1 << 40
UNLIMITED = {"integer": FREE, "sequence": FREE, "steps": FREE, "text": FREE}

pytestmark = pytest.mark.filterwarnings("ignore")


def lines_of(name: str) -> list[str]:
    text = (FOLDER / name).read_text(encoding="utf-8")
    return [line for line in text.splitlines() if not line.startswith("#")]


def values() -> dict[str, Any]:
    """Return the variables that the lines use, new each time."""
    return {
        "group": OrderedSet({1, 2}),
        "items": [1, 2, 3],
        "table": {"a": 1, "b": 2},
        "text": "left leg and right leg",
    }


def many(n: int) -> dict[str, Any]:
    """Return variables with n items, characters or bits."""
    return {
        "array": np.arange(n, dtype=float),
        "deep": [[0] * n],
        "group": OrderedSet(range(n)),
        "halves": [0.5] * n,
        "huge": 1 << n,
        "items": list(range(n)),
        "n": n,
        "pairs": [(i, i) for i in range(n)],
        "row": tuple(range(n)),
        "span": range(n),
        "table": {i: i for i in range(n)},
        "text": "x" * n,
        "texts": ["x"] * n,
        "wide": [10**10 + i for i in range(n)],
        "words": {str(i): i for i in range(n)},
    }


class Run:
    """What comes of a line in safe mode: a value, or variables, and the steps it took."""

    def __init__(
        self,
        line: str,
        variables: dict[str, Any] | None = None,
        limits: dict[str, int] | None = None,
    ) -> None:
        runtime = SafeRuntime(SafeLimits(**limits or {}))
        builtins = runtime.names() | {name: runtime.module(name) for name in MODULES}
        builtins["np"] = builtins["numpy"]
        scope = values() if variables is None else variables
        if "array" in scope:
            scope["array"] = runtime.admit(scope["array"])
        scope["__builtins__"] = builtins
        before = runtime.steps
        if line.startswith("! "):
            code = runtime.bind(compile_safe(line[2:], "<test>", "exec", runtime.limits))
            exec(code, scope, scope)
            del scope["__builtins__"]
            self.value: Any = dict(sorted(scope.items()))
        else:
            code = runtime.bind(compile_safe(f"({line}\n)", "<test>", "eval", runtime.limits))
            self.value = eval(code, scope, scope)
        self.steps = runtime.steps - before


def plainly(line: str) -> Any:
    """Return the same value, or variables, from Python as it is."""
    scope = values() | {"math": math, "np": np, "statistics": statistics}
    scope["group"] = set(scope["group"])
    if not line.startswith("! "):
        return eval(line, scope)
    exec(line[2:], scope)
    return {
        name: scope[name]
        for name in sorted(scope)
        if name not in ("__builtins__", "math", "np", "statistics")
    }


def outcome(run: Any, line: str) -> str:
    """Return what a line gives, or the error it raises."""
    try:
        return repr(run(line))
    except SafetyError:
        raise
    except Exception as error:
        return f"{type(error).__name__}: {error}"


# --- words --------------------------------------------------------------------------------------


def refusals() -> Iterator[tuple[str, str, str]]:
    """Give lines, what is refused and why, and the hint."""
    lines = lines_of("refusals.txt")
    for line, following in zip(lines, [*lines[1:], ""], strict=True):
        if not line.startswith(" "):
            text, _, words = line.partition(" => ")
            hint = following.strip() if following.startswith(" ") else "RUN_IT"
            yield text, words, hint.replace("RUN_IT", RUN_IT)


@pytest.mark.parametrize(("line", "words", "hint"), list(refusals()))
def test_a_refusal_says_what_is_not_allowed_and_what_to_write(
    line: str, words: str, hint: str
) -> None:
    with pytest.raises(SafetyError) as caught:
        Run(line)
    construct, colon, why = words.partition(": ")
    assert caught.value.code == "unsafe-code"
    assert caught.value.construct == construct
    assert caught.value.message == f"{construct} is not allowed in safe mode{colon}{why}"
    assert caught.value.hint == hint


@pytest.mark.parametrize(
    ("line", "at"),
    [
        ("(1, [k async for k in items])", "[k async for k in items]"),
        ("(2, lambda **__x: 1)", "__x"),
        ("print(1, __x=1)", "__x=1"),
        ("[k for items[0] in items]", "items[0]"),
        ("1 + items.__len__()", "items.__len__"),
        ("f'a{items._x}b'", "f'a{items._x}b'"),
        ("'é' + __y", "__y"),
        ("1 if b'x' else ...", "b'x'"),
        ("{**items._x}", "items._x"),
        ("1 + (x := 5)", "x := 5"),
        ("! a = 1; items[0].x += 1", "items[0].x"),
        ("! a, items.x = 3", "items.x"),
        ("! a = 1; raise KeyError('a')", "KeyError('a')"),
        ("! a = b = __c = 1", "__c"),
        ("! __x += 1", "__x"),
        ("! a = 1; import os", "import os"),
    ],
)
def test_a_refusal_points_at_the_smallest_piece_that_is_wrong(line: str, at: str) -> None:
    mode = "exec" if line.startswith("! ") else "eval"
    text = line.removeprefix("! ")
    with pytest.raises(SafetyError) as caught:
        compile_safe(text, "<test>", mode)
    assert caught.value.position is not None
    first, start, last, end = caught.value.position
    assert first == last == 1
    assert text.encode()[start:end].decode() == at


def test_an_operator_of_a_later_python_is_refused() -> None:
    class LogicalXor(ast.operator):
        pass

    one, name = ast.Constant(1), ast.Name("a", ast.Store())
    for node in (ast.BinOp(one, LogicalXor(), one), ast.AugAssign(name, LogicalXor(), one)):
        with pytest.raises(SafetyError, match="`LogicalXor` is not allowed"):
            Rewriter(SafeLimits(), is_statements=True).visit(node)


@pytest.mark.parametrize("line", lines_of("errors.txt"))
def test_where_python_would_name_what_safe_mode_has_not_the_error_is_our_own(line: str) -> None:
    text, _, expected = line.partition(" => ")
    assert outcome(lambda line: Run(line).value, text) == expected


@pytest.mark.parametrize(
    "line", lines_of("same-expressions.txt") + [f"! {x}" for x in lines_of("same-statements.txt")]
)
def test_values_and_errors_are_those_of_python(line: str) -> None:
    assert outcome(lambda line: Run(line).value, line) == outcome(plainly, line)


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("! items.append()", "append() missing 1 required positional argument: 'item'"),
        ("text.join()", "join() missing 1 required positional argument: 'items'"),
        ("! items.sort(by=1)", "sort() got an unexpected keyword argument 'by'"),
        ("text.strip(chars='a')", "strip() got an unexpected keyword argument 'chars'"),
        ("max(items, start=1)", "max() got an unexpected keyword argument 'start'"),
        ("min(items, start=1)", "min() got an unexpected keyword argument 'start'"),
        ("round(1, 2, 3)", "round() takes from 2 to 3 positional arguments but 4 were given"),
    ],
)
def test_messages_about_arguments_name_the_function(line: str, words: str) -> None:
    with pytest.raises(TypeError) as caught:
        Run(line)
    assert str(caught.value) == words


@pytest.mark.parametrize(
    ("line", "shown"),
    [
        ("math", "<module 'math'>"),
        ("np.linalg", "<module 'numpy.linalg'>"),
        ("lambda: 1", "<function <lambda>>"),
        ("text.upper", "<method upper of a text>"),
        ("np.ones(2).sum", "<method sum of an array>"),
        ("statistics.mean", "<function mean>"),
        ("np.sin", "<function sin>"),
        ("np.int64", "<class 'numpy.int64'>"),
        ("env", "<built-in function env>"),
        ("isinstance", "<built-in function isinstance>"),
        ("math.comb", "<built-in function comb>"),
        ("int", "<class 'int'>"),
    ],
)
def test_functions_and_modules_show_what_they_are(line: str, shown: str) -> None:
    assert Run(f"str({line})").value == shown


# --- limits -------------------------------------------------------------------------------------

LIMITED = {
    "calls": "this function calls itself too deeply",
    "integer": "this whole number",
    "sequence": "this makes {size:,} | with the lists in it, | too many numbers are put into",
    "text": "this text has {size:,} characters",
    "width": "the format ' | this rounds to too many digits",
}


@pytest.mark.parametrize("line", lines_of("limits.txt"))
def test_a_limit_holds_wherever_a_value_is_made(line: str) -> None:
    name, lowest, text = line.split(" ", 2)
    size = int(lowest)
    Run(text, limits={name: size})
    with pytest.raises(SafetyError) as caught:
        Run(text, limits={name: size - 1})
    error = caught.value
    assert error.code == f"limit-{name}"
    assert error.message.startswith(tuple(LIMITED[name].format(size=size).split(" | ")))
    assert error.message.endswith(f"; the limit in safe mode is {size - 1:,}")
    assert error.construct == ""
    assert str(error.hint).endswith(f"--limit {name}=… sets another limit")


@pytest.mark.parametrize(
    ("line", "message", "hint"),
    [
        (
            "1 << 5000",
            "this whole number has 5,001 bits",
            "a decimal number, such as 10.0, has no such limit; ",
        ),
        ("round(5, -5000)", "so many digits cannot be rounded off", ""),
        ("'a' * 2000000", "this text has 2,000,000 characters", ""),
        ("range(2000000)", "this makes 2,000,000 items", ""),
        ("np.ones(2000000)", "this makes 2,000,000 numbers", ""),
        ("f'{1:1000}'", "the format '1000' makes long texts", ""),
        (
            "f'{1:\u0661\u0661\u0661\u0661}'",
            "the format '\u0661\u0661\u0661\u0661' makes long texts",
            "",
        ),
        (
            "str([[0] * 999] * 2000)",
            "with the lists in it, this value has more than 1,000,000 items",
            "",
        ),
        (
            "! items.append(items); x = str(items)",
            "lists are nested too deep here",
            "a list cannot contain itself; ",
        ),
        ("(" * 60 + ")" * 60, "too many brackets are open here", ""),
        ("1" + "+1" * 120, "this is nested too deep", "split it into several variables; "),
        (
            "1" * 20001,
            "this Python text has 20,001 characters",
            "split it into several variables; ",
        ),
        (
            "[" + "1," * 19999 + "]",
            "this Python text has 40,000 characters",
            "split it into several variables; ",
        ),
        ("(lambda f: f(f))(lambda f: f(f))", "this function calls itself too deeply", ""),
    ],
)
def test_a_limit_says_what_is_too_large_and_a_way_out(line: str, message: str, hint: str) -> None:
    with pytest.raises(SafetyError) as caught:
        Run(line)
    assert caught.value.message.split("; the limit")[0] == message
    name = caught.value.code.removeprefix("limit-")
    assert caught.value.hint == f"{hint}--limit {name}=… sets another limit"


def test_an_error_for_too_many_steps_says_so() -> None:
    with pytest.raises(SafetyError) as caught:
        Run("[k for k in items]", limits={"steps": 5})
    expected = "the expressions of this file take too many steps; the limit in safe mode is 5"
    assert caught.value.message == expected
    assert caught.value.hint == "--limit steps=… sets another limit"


# --- prices -------------------------------------------------------------------------------------


@pytest.mark.parametrize("line", lines_of("prices.txt"))
def test_what_takes_time_or_memory_has_a_price_by_size(line: str) -> None:
    price, text = line.split(maxsplit=1)
    few, more = (Run(text, many(n), UNLIMITED).steps for n in (1024, 2048))
    assert Fraction(more - few, 1024) == Fraction(price)


def test_a_small_exponent_of_a_large_modulus_has_a_price_too() -> None:
    assert Run("pow(3, 5, huge)", many(30_000), UNLIMITED).steps > 1_000_000


def test_none_between_printed_values_is_a_space() -> None:
    told: list[str] = []
    runtime = SafeRuntime(say=told.append)
    code = runtime.bind(compile_safe("print(1, 2, sep=None, end=None)", "<test>", "eval"))
    eval(code, {"__builtins__": runtime.names()})
    assert told == ["1 2\n"]


# --- values from outside ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("line", "words", "hint"),
    [
        ("map(abs, items)", "the text of an iterator", "write list(…) around it"),
        ("[map(abs, items)]", "the text of an iterator", "write list(…) around it"),
        ("abs", "the text of a function", "call it: name(…)"),
        ("len", "the text of a function", "call it: name(…)"),
        ("{1: [len]}", "the text of a function", "call it: name(…)"),
        ("math", "the text of a module", "write a name in it: math.pi"),
        ("(1, np)", "the text of a module", "write a name in it: math.pi"),
    ],
)
def test_what_has_no_text_is_not_written(line: str, words: str, hint: str) -> None:
    runtime = SafeRuntime()
    scope = {"__builtins__": runtime.names(), **{n: runtime.module(n) for n in MODULES}}
    scope |= {"items": [1], "np": scope["numpy"]}
    value = eval(runtime.bind(compile_safe(line, "<test>", "eval")), scope)
    with pytest.raises(SafetyError) as caught:
        runtime.check_written(value)
    assert caught.value.construct == words
    assert caught.value.hint == hint


@pytest.mark.parametrize("value", [1, "a", None, [1, {"a": (2.5,)}], {1: [True]}, range(3)])
def test_plain_data_is_written(value: Any) -> None:
    SafeRuntime().check_written(value)


def test_what_was_let_in_may_come_in_again() -> None:
    runtime = SafeRuntime()
    runtime.module("numpy")
    kept = [range(3), runtime.admit(np.ones(2))]
    assert runtime.admit(kept) is kept
    assert runtime.admit(kept[1]) is kept[1]


def test_the_order_of_a_set_is_that_of_its_texts() -> None:
    line = "list({'b', 'a', 2, 1.5, None, ('x', 1), ('w', 2)})"
    assert Run(line).value == [1.5, 2, "a", "b", None, ("w", 2), ("x", 1)]


@pytest.mark.parametrize("value", [b"x", [b"x"], {"a": [object]}, (1, iter("")), [np.ones(2)]])
def test_a_refusal_of_a_value_from_outside_names_its_type(value: Any) -> None:
    inner = value
    while type(inner) in (list, dict, tuple):
        inner = (list(inner.values()) if type(inner) is dict else list(inner))[-1]
    with pytest.raises(SafetyError) as caught:
        SafeRuntime().admit(value)
    kind = type(inner).__name__
    expected = (
        f"a value of the type `{kind}` is not allowed in safe mode: only plain data can be used"
    )
    assert caught.value.message == expected


def test_helpers_are_given_plain_values_and_called_by_name() -> None:
    runtime = SafeRuntime()
    asked: list[Any] = []
    names = runtime.names({"load": lambda *a, **k: asked.append((a, k)), "home": "/opt"})
    scope = {"__builtins__": names, "items": [1]}

    def evaluate(text: str) -> Any:
        return eval(runtime.bind(compile_safe(text, "<test>", "eval")), scope)

    assert runtime.steps == 0
    assert evaluate("load(1, 'a', x=None)") is None
    assert runtime.steps == 1000
    assert asked == [((1, "a"), {"x": None})]
    assert evaluate("home") == "/opt"
    assert evaluate("str(load)") == "<function load>"
    assert "__find__" not in names
    for text in ("load(items)", "load(x=items)"):
        with pytest.raises(TypeError, match=r"^a text or a number is needed here$"):
            evaluate(text)


def test_a_module_that_is_not_allowed_is_refused_with_those_that_are() -> None:
    with pytest.raises(SafetyError) as caught:
        SafeRuntime().module("os")
    assert caught.value.construct == "the module `os`"
    assert caught.value.hint == f"safe mode supports math, numpy, statistics; {RUN_IT}"


def test_a_module_is_refused_for_a_reason() -> None:
    error = SafeRuntime().refusal_of_module("legs", "it stands beside the file")
    words = "the module `legs` is not allowed in safe mode: it stands beside the file"
    assert error.message == words


def test_a_module_is_made_once() -> None:
    runtime = SafeRuntime()
    assert [runtime.module(name) is runtime.module(name) for name in MODULES] == [True] * 3


@pytest.mark.parametrize("name", ["arrays", "numpy"])
def test_only_numpy_itself_can_be_missing(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delitem(sys.modules, "yamaro.safe.numpy", raising=False)
    monkeypatch.setitem(sys.modules, f"yamaro.safe.{name}", None)
    with pytest.raises(ModuleNotFoundError, match=f"yamaro.safe.{name}"):
        SafeRuntime().module("numpy")


def test_without_numpy_a_file_is_told_where_it_is_looked_for(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for name in ("arrays", "numpy"):
        monkeypatch.delitem(sys.modules, f"yamaro.safe.{name}", raising=False)
    monkeypatch.setitem(sys.modules, "numpy", None)
    with pytest.raises(SafetyError) as caught:
        SafeRuntime().module("numpy")
    assert caught.value.code == "unknown-module"
    assert caught.value.message == "the Python module 'numpy' is not found"
    hint = "is it installed?"
    assert caught.value.hint == hint
