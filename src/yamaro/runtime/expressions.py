"""Evaluates the Python in a file, and the values, texts and messages that hold it.

The only module that calls `eval` and `exec` for Yamaro's own files; for those of xacro it is
`xacro/evaluator.py`. Exceptions are for `python_errors.py`.
"""

from __future__ import annotations

from ..diagnostics import Frame, InputFault, YamaroError, failure
from ..namespace import MISSING
from ..source import Span
from ..syntax.nodes import Constant, DictValue, ListValue, Value
from ..syntax.python import PythonCode, Template
from ..xml.values import format_number, format_value, is_number, plain_value
from .predefined import gather_pairs
from .scope import Scope

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import CodeType
    from typing import Any

    from ..policy import Limits
    from ..safe.runtime import SafeRuntime
    from .python_errors import Explainer

_CONTAINERS = frozenset((list, tuple, dict))


def run_module(code: CodeType, names: dict[str, Any]) -> None:
    """Run the code of a module in its names; whatever it raises comes through."""
    exec(code, names)


class Evaluator:
    """Evaluates expressions and runs statements in scopes."""

    __slots__ = ("_make_explainer", "frame", "limits")

    def __init__(self, make_explainer: Callable[[], Explainer], limits: Limits) -> None:
        """Begin outside of all calls; the explainer is created when something goes wrong."""
        self._make_explainer = make_explainer
        self.limits = limits
        self.frame: Frame | None = None

    @property
    def explainer(self) -> Explainer:
        """Makes diagnostics of exceptions."""
        return self._make_explainer()

    def evaluate(self, python: PythonCode, scope: Scope) -> Any:
        """Return the value of an expression.

        Raises:
            YamaroError: it raised an exception.
        """
        if python.name is not None:
            value = scope.get(python.name, MISSING)  # most names are the context's own
            if value is MISSING:
                value = scope.find(python.name)
            if value is not MISSING:
                return value
        try:
            return eval(python.code, scope, scope)
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            raise self.explainer.explained(error, python, scope, self.frame) from None

    def execute(self, python: PythonCode, scope: Scope) -> None:
        """Run statements.

        Raises:
            YamaroError: they raised an exception.
        """
        try:
            exec(python.code, scope, scope)
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            raise self.explainer.explained(error, python, scope, self.frame) from None

    def guard(self, function: Callable[[Any], Any], value: Any, span: Span) -> Any:
        """Return `function(value)`, where a method of a user's value may raise anything.

        Raises:
            YamaroError: it raised an exception.
        """
        try:
            return function(value)
        except (KeyboardInterrupt, YamaroError):
            raise
        except BaseException as error:
            raise self.explainer.failed(error, span, None) from None

    def text(self, make: Callable[[Any], str], value: Any, span: Span) -> str:
        """Return the text that `make` makes of a value.

        Raises:
            YamaroError: it would be too long, or making it raised an exception.
        """

        def run(value: Any) -> str:
            self.measure(value)
            return make(value)

        text: str = self.guard(run, value, span)
        if len(text) > self.limits.text:
            raise self.too_long(text, span)
        return text

    def too_long(self, text: str, span: Span) -> YamaroError:
        """Return the error for a text that is longer than the limit."""
        return failure(
            "limit-text",
            f"this text has {len(text):,} characters; the limit is {self.limits.text:,}",
            span,
            hint=self.limits.hint("text"),
            trace=self.frame,
        )

    def measure(self, value: Any) -> None:
        """Look at how much there is in a value that is to be written or hashed.

        `[[[0] * 1000] * 1000] * 1000` takes 24 kB of memory, and has a thousand million items.

        Raises:
            InputFault: it is too much.
        """
        if type(value) not in _CONTAINERS:
            return
        count = len(value)
        around = [value]
        waiting = [_inner(value)]
        while waiting:
            item = next(waiting[-1], None)
            if item is None:
                waiting.pop()
                around.pop()
            elif not any(item is outer for outer in around):  # Python shows a list in itself as […]
                count += len(item)
                around.append(item)
                waiting.append(_inner(item))
            if count > self.limits.sequence:
                raise InputFault(
                    "limit-sequence",
                    f"with the lists in it, this value has more than {self.limits.sequence:,} "
                    "items, which is the limit",
                    self.limits.hint("sequence"),
                )

    def hash(self, value: Any) -> int:
        """Return the hash of a value."""
        return hash(value)


class SafeEvaluator(Evaluator):
    """Evaluates what `compile_safe` has compiled."""

    __slots__ = ("_bound", "_runtime")

    def __init__(
        self, make_explainer: Callable[[], Explainer], limits: Limits, runtime: SafeRuntime
    ) -> None:
        """Begin; the runtime counts the steps of this one conversion."""
        super().__init__(make_explainer, limits)
        self._runtime = runtime
        self._bound: dict[PythonCode, CodeType] = {}

    def _code(self, python: PythonCode) -> CodeType:
        """Return an expression's code with the guards of this conversion in it."""
        code = self._bound.get(python)
        if code is None:
            code = self._bound[python] = self._runtime.bind(python.code)
        return code

    def evaluate(self, python: PythonCode, scope: Scope) -> Any:
        """Return the value of an expression.

        Raises:
            YamaroError: it raised an exception.
        """
        try:
            self._runtime.charge(1)
            if python.name is not None:
                value = scope.find(python.name)
                if value is not MISSING:
                    return value
            return eval(self._code(python), scope, scope)
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            raise self.explainer.explained(error, python, scope, self.frame) from None

    def execute(self, python: PythonCode, scope: Scope) -> None:
        """Run statements.

        Raises:
            YamaroError: they raised an exception.
        """
        try:
            self._runtime.charge(1)
            exec(self._code(python), scope, scope)
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            raise self.explainer.explained(error, python, scope, self.frame) from None

    def measure(self, value: Any) -> None:
        """Count what it costs to write a value.

        Raises:
            InputFault: it is too much, or its text is chance.
        """
        self._runtime.measured(value)
        self._runtime.check_written(value)

    def hash(self, value: Any) -> int:
        """Return the hash of a value."""
        return hash(self._runtime.measured(value))


def _inner(value: Any) -> Iterator[Any]:
    """Give the lists and dicts in a list or dict."""
    items = value.values() if isinstance(value, dict) else value
    return (item for item in items if type(item) in _CONTAINERS)


def evaluate_bare(python: PythonCode, scope: Scope, evaluator: Evaluator, *, hint: str) -> Any:
    """Return the value of an expression that stands without `$( )`, where a word may be a text.

    Args:
        python: the expression.
        scope: where it stands.
        evaluator: evaluates it.
        hint: what to say of a name that is known nowhere; `{name}` in it is the name.
    """
    try:
        return evaluator.evaluate(python, scope)
    except YamaroError as error:
        whole = python.span()
        for diagnostic in error.diagnostics:
            span = diagnostic.span
            is_inside = span.source is whole.source and whole.start <= span.start < whole.end
            if diagnostic.code == "undefined-name" and is_inside:
                if not diagnostic.hint and not diagnostic.notes:
                    name = span.source.text[span.start : span.end]
                    diagnostic.hint = hint.replace("{name}", name)
        raise


# --- values and texts -------------------------------------------------------------------------


ALWAYS_WRITABLE = frozenset((str, float, bool, type(None)))
SHORT = 10**15
"""Python refuses to write integers of thousands of digits; those below this it never does."""


def is_writable(value: Any) -> bool:
    """Return whether writing a value cannot fail."""
    kind = type(value)
    return kind in ALWAYS_WRITABLE or (kind is int and -SHORT < value < SHORT)


class Values:
    """Gives the Python objects that the syntax tree's values describe."""

    __slots__ = ("evaluator",)

    def __init__(self, evaluator: Evaluator) -> None:
        """Evaluate expressions with `evaluator`."""
        self.evaluator = evaluator

    def value(self, value: Value, scope: Scope) -> Any:
        """Return the object a value describes; lists and dicts are new each time."""
        kind = type(value)
        if kind is Constant:
            return value.value  # type: ignore[union-attr]
        if kind is Template:
            return self.text(value, scope)  # type: ignore[arg-type]
        if isinstance(value, ListValue):
            return self.list_of(value, scope)
        assert isinstance(value, DictValue)
        pairs = []
        for key_value, item in value.pairs:
            key = self.value(key_value, scope)
            if isinstance(key_value, Template) and (key is None or key == ""):
                continue
            self.evaluator.guard(self.evaluator.hash, key, span_of(key_value))
            pairs.append((key, self.value(item, scope)))
        return gather_pairs(pairs)

    def list_of(self, value: ListValue, scope: Scope) -> list[Any]:
        """Return the objects in a list."""
        return [self.value(item, scope) for item in value.items]

    def spelled_list(self, value: ListValue, scope: Scope) -> list[Any]:
        """Return the objects in a list that is only passed on: its numbers keep their spelling."""
        return [
            item.node.text
            if isinstance(item, Constant) and is_number(item.value)
            else self.value(item, scope)
            for item in value.items
        ]

    def text(self, value: str | Template, scope: Scope) -> Any:
        """Return a text as written, the typed value of a single `$(…)`, or the parts joined."""
        if isinstance(value, str):
            return value
        if value.only is not None:
            return self.evaluator.evaluate(value.only, scope)
        return self.joined(value, scope)

    def written(self, value: str | Template, scope: Scope) -> Any:
        """Return what `text` does, sure that it can be written: any `__str__` may fail."""
        if isinstance(value, str):
            return value
        if value.only is None:
            return self.joined(value, scope)
        result = self.evaluator.evaluate(value.only, scope)
        if type(result) is str:
            if len(result) > self.evaluator.limits.text:
                raise self.evaluator.too_long(result, value.only.span())
        elif type(result) not in ALWAYS_WRITABLE and not is_writable(result):
            self.evaluator.text(format_value, result, value.only.span())
        return result

    def joined(self, template: Template, scope: Scope) -> str:
        """Return the parts of a template as one text, as in a key."""
        evaluate = self.evaluator.evaluate
        pieces = []
        for part in template.parts:
            if type(part) is str:
                pieces.append(part)
                continue
            assert not isinstance(part, str)
            value = evaluate(part, scope)
            kind = type(value)
            if kind is str:
                pieces.append(value)
            elif kind is float:
                pieces.append(format_number(value))
            elif value is None and template.only is None:
                pieces.append("None")
            elif is_writable(value):
                pieces.append(format_value(value))
            else:
                pieces.append(self.evaluator.text(format_value, value, part.span()))
        text = "".join(pieces)
        if len(text) > self.evaluator.limits.text:
            raise self.evaluator.too_long(text, template.span())
        return text

    def message(self, value: str | Template | Value, scope: Scope, span: Span) -> str:
        """Return the text of a `print`."""
        if isinstance(value, str):
            return value
        if not isinstance(value, Template):
            return self.evaluator.text(print_text, self.value(value, scope), span)
        pieces = []
        for part in value.parts:
            if isinstance(part, str):
                pieces.append(part)
            else:
                result = self.evaluator.evaluate(part, scope)
                pieces.append(self.evaluator.text(print_text, result, part.span()))
        return "".join(pieces)


def print_text(value: Any) -> str:
    """Return the text of a value in `print`: floats as in XML, all else as Python shows it."""
    plain = plain_value(value)
    return format_value(plain) if type(plain) is float else str(plain)


def span_of(value: Value) -> Span:
    """Return where a value is written."""
    if isinstance(value, Constant):
        return value.node.span()
    return value.span() if isinstance(value, Template) else value.span


# --- what values are called in messages -------------------------------------------------------


def count(number: int, noun: str) -> str:
    """Return a number of things, in words for a message."""
    return f"{'no' if number == 0 else number} {noun}{'' if number == 1 else 's'}"


def a_kind_of(value: Any) -> str:
    """Return what a value is, in words for a message."""
    if value is None:
        return "empty (null)"
    if isinstance(value, bool):
        return f"the boolean {'true' if value else 'false'}"
    if isinstance(value, (int, float)):
        return f"the number {format_value(value)}"
    if isinstance(value, str):
        return f"the text '{value[:40]}'"
    if callable(value):  # in safe mode, functions and types have types of their own
        return "a function"
    name = type(value).__name__
    if name in ("ndarray", "Array"):  # numpy's, and its substitute in safe mode
        return "an array"
    return f"{'an' if name[0] in 'AEIOUaeiou' else 'a'} {name}"
