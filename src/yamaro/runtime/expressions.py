"""Runs the Python in a file, and turns what goes wrong in it into diagnostics.

The only module that calls `eval` and `exec` for Yamaro's own files; for those of xacro it is
`xacro/python.py`. An error is shown at the innermost place in the YAML that its traceback goes
through: the expression, or the line of the process block whose function it called.
"""

from __future__ import annotations

from ..diagnostics import Frame, InputFault, YamaroError, did_you_mean, failure
from ..policy import Limits
from ..safe.namespace import MISSING, Namespace
from ..sandbox.deadline import TimeOver
from ..source import Span
from ..syntax.python import TOO_MANY_DIGITS, PythonCode, expression_without_dollars
from .declared import Declaration, notes_on
from .scope import Scope

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from types import CodeType, TracebackType
    from typing import Any, NoReturn

    from ..safe.runtime import SafeRuntime


_OWN_FOLDER = __file__[: -len("runtime/expressions.py")]


TIME_IS_OVER = "the time is over, and this is where it was spent"
JAIL_HINT = (
    "in a jail a file reads its own folder, its packages and what --allow-path adds, "
    "writes nothing, and reaches no network and no other process; --trust runs it with all "
    "your rights"
)
TIME_HINT = "--timeout SECONDS gives it more time"
_CONTAINERS = frozenset((list, tuple, dict))
YAML_1_1_BOOLEANS = {
    **dict.fromkeys(("yes", "on", "y", "true"), "true"),
    **dict.fromkeys(("no", "off", "n", "false"), "false"),
}
"""What YAML 1.1 took for a boolean, in lower case, and what to write for it."""


def run_module(code: CodeType, names: dict[str, Any]) -> None:
    """Run the code of a module in its names; whatever it raises comes through."""
    exec(code, names)


class Evaluator:
    """Evaluates expressions and runs statements in scopes."""

    __slots__ = ("_where_declared", "codes", "frame", "is_jailed", "limits")

    def __init__(
        self,
        codes: dict[str, PythonCode],
        where_declared: Callable[[str], list[Declaration]],
        limits: Limits,
    ) -> None:
        """Begin.

        Args:
            codes: all code that defines functions, by its file name; may grow later.
            where_declared: gives every declaration of a name.
            limits: how large values may be.
        """
        self.codes = codes
        self.frame: Frame | None = None
        self.is_jailed = False  # so that it can be told why something is not permitted
        self.limits = limits
        self._where_declared = where_declared

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
            self.explain(error, python, scope)

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
            self.explain(error, python, scope)

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
            raise self._failure(error, span, None, _outside(error.__traceback__)) from None

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

    def explain(self, error: BaseException, python: PythonCode, scope: Scope) -> NoReturn:
        """Raise the YamaroError that tells where in the YAML an exception came from, and why."""
        if isinstance(error, YamaroError):  # in a file that `load_yaml` reads
            loaded = error.diagnostics[0].span.source.name
            add_trace(error, Frame("loaded", loaded, python.span(), parent=self.frame))
            raise error
        is_recursion = isinstance(error, RecursionError)
        place = self._innermost(error, python)
        span = place.span
        frame = self.frame
        steps = place.steps[:1] if is_recursion else place.steps
        for function, called_at in steps:
            frame = Frame("called", function, called_at, parent=frame)
        if type(error) is NameError and error.name:
            name_span = _find_name(place.python, error.name, place.index) or span
            raise self._undefined(error.name, name_span, scope, frame) from None
        from .origins import notes_on_error

        notes = notes_on_error(error, span.written(), scope, place.code)
        raise self._failure(error, span, frame, place.outside, notes) from None

    def _failure(
        self,
        error: BaseException,
        span: Span,
        frame: Frame | None,
        outside: str | None = None,
        origins: Sequence[str] = (),
    ) -> YamaroError:
        if isinstance(error, InputFault):
            return failure(error.code, error.message, span, hint=error.hint, trace=frame)
        if isinstance(error, RecursionError):
            return failure(
                "too-deep",
                "this calls itself without end",
                span,
                hint="a function that calls itself needs a condition under which it stops",
                trace=frame,
            )
        if isinstance(error, ValueError) and str(error).startswith(TOO_MANY_DIGITS):
            return failure(
                "number-too-long",
                "this integer has too many digits to be written",
                span,
                trace=frame,
            )
        if isinstance(error, TimeOver):
            return failure("limit-time", TIME_IS_OVER, span, hint=TIME_HINT, trace=frame)
        notes = [*origins, *([f"raised in {outside}"] if outside else [])]
        if isinstance(error, MemoryError):
            return failure(
                "limit-memory",
                "there is not enough memory for this",
                span,
                hint=self.limits.hint("memory"),
                notes=notes,
                trace=frame,
            )
        return failure(
            "python-error",
            _describe(error),
            span,
            hint=JAIL_HINT
            if self.is_jailed and isinstance(error, PermissionError)
            else _hint(error),
            notes=notes,
            trace=frame,
        )

    def _undefined(self, name: str, span: Span, scope: Scope, frame: Frame | None) -> YamaroError:
        # Where the name is declared says more than what other names look like it.
        notes = notes_on(f"'{name}'", self._where_declared(name), span)
        hint = None if notes else did_you_mean(name, variable_names(scope))
        if name.lower() in YAML_1_1_BOOLEANS and len(name) > 1:  # n is the name of a number
            meant = YAML_1_1_BOOLEANS[name.lower()]
            hint = f"write {meant}: in YAML 1.2 '{name}' is a word like any other"
        return failure(
            "undefined-name",
            f"name '{name}' is not defined",
            span,
            hint=hint,
            notes=notes,
            trace=frame,
        )

    def _innermost(self, error: BaseException, python: PythonCode) -> _Place:
        """Return the last place in the YAML that an error's traceback goes through.

        As a line where the piece of it is a matter of chance or of the version of Python: where
        the stack ran out, or a statement `assert` failed.
        """
        traceback = error.__traceback__
        place = _Place(python, python.span(), None, [], python.code)
        own = python.code.co_filename
        while traceback is not None:
            code = traceback.tb_frame.f_code
            found = python if code.co_filename == own else self.codes.get(code.co_filename)
            if found is not None:
                is_line = isinstance(error, RecursionError) or (
                    isinstance(error, AssertionError) and traceback.tb_next is None
                )
                index, span = _traceback_span(traceback, found, is_line=is_line)
                steps = place.steps
                if code.co_name[0] != "<":  # no <module>, <lambda>, <listcomp>
                    steps.append((code.co_name, place.span if steps else python.span()))
                place = _Place(found, span, index, steps, code)
            elif not code.co_filename.startswith((_OWN_FOLDER, "<")):
                place.outside = f"{_base_name(code.co_filename)}:{traceback.tb_lineno}"
            traceback = traceback.tb_next
        return place


class SafeEvaluator(Evaluator):
    """Evaluates what `compile_safe` has compiled."""

    __slots__ = ("_bound", "_runtime")

    def __init__(
        self,
        codes: dict[str, PythonCode],
        where_declared: Callable[[str], list[Declaration]],
        limits: Limits,
        runtime: SafeRuntime,
    ) -> None:
        """Begin; the runtime counts the steps of this one conversion."""
        super().__init__(codes, where_declared, limits)
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
            self.explain(error, python, scope)

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
            self.explain(error, python, scope)

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


class _Place:
    """A place in the YAML found in a traceback."""

    __slots__ = ("code", "index", "outside", "python", "span", "steps")

    def __init__(
        self,
        python: PythonCode,
        span: Span,
        index: int | None,
        steps: list[tuple[str, Span]],
        code: CodeType,
    ) -> None:
        self.python = python
        self.span = span
        self.code = code
        self.index = index  # into the Python text, where the failing piece begins
        self.steps = steps  # the user's functions around it, outermost first, and their calls
        self.outside: str | None = None  # the module's line behind it that raised


def variable_names(scope: Scope) -> list[str]:
    """Return the names of variables, imports and predefined names visible from a scope."""
    return [name for name in scope.visible_names() if name.isidentifier() and name[:2] != "__"]


def function_names(scope: Scope) -> list[str]:
    """Return the names of functions and blocks visible from a scope."""
    names = list(scope.visible_names())
    found = [name[:-2] for name in names if name.endswith("()")]
    for name in names:
        if name.endswith("()") or not name.isidentifier():
            continue
        value = scope.find(name)
        if isinstance(value, Namespace):
            found.extend(f"{name}.{inner[:-2]}" for inner in value._names if inner.endswith("()"))
    return found


def _outside(traceback: TracebackType | None) -> str | None:
    """Return the last line of the user's modules that a traceback goes through."""
    place = None
    while traceback is not None:
        filename = traceback.tb_frame.f_code.co_filename
        if not filename.startswith((_OWN_FOLDER, "<")):
            place = f"{_base_name(filename)}:{traceback.tb_lineno}"
        traceback = traceback.tb_next
    return place


def _base_name(path: str) -> str:
    return path.replace("\\", "/").rpartition("/")[2]


def _traceback_span(
    traceback: TracebackType, python: PythonCode, *, is_line: bool
) -> tuple[int | None, Span]:
    """Return the failing piece of Python: exact where Python tells columns, else its line."""
    code = traceback.tb_frame.f_code
    if hasattr(code, "co_positions") and not is_line:
        from itertools import islice

        positions = next(islice(code.co_positions(), traceback.tb_lasti // 2, None), None)
        if positions is not None and None not in positions:
            line, end_line, column, end_column = positions
            assert line and end_line and column is not None and end_column is not None
            start = python.byte_position(line, column)
            end = python.byte_position(end_line, end_column)
            if start < end and python.text[start:end].strip():
                return start, python.span(start, end)
    line = traceback.tb_lineno
    start = python.position(line, 0 if line > 1 else len(python.opening))
    end = python.text.find("\n", start)
    end = len(python.text) if end < 0 else end
    text = python.text[start:end]
    if not text.strip():
        return None, python.span()
    start += len(text) - len(text.lstrip())
    return start, python.span(start, start + len(text.strip()))


def _find_name(python: PythonCode, name: str, index: int | None) -> Span | None:
    """Return the place where a name is read: at `index` if it is there, else the first one."""
    text = expression_without_dollars(python.text)[0]
    if len(text) != len(python.text):  # with a form of ROS's, places would not be right
        return None
    if index is not None and text.startswith(name, index):
        return python.span(index, index + len(name))
    import ast

    try:
        tree = ast.parse(f"{python.opening}{text}\n{')' if python.opening else ''}")
    except SyntaxError:  # a form of ROS's, such as `arg name`
        at = text.find(name)
        return None if at < 0 else python.span(at, at + len(name))
    places = [
        python.byte_position(node.lineno, node.col_offset)
        for node in ast.walk(tree)
        if isinstance(node, ast.Name) and node.id == name
    ]
    start = min((place for place in places if place >= (index or 0)), default=None)
    return None if start is None else python.span(start, start + len(name))


def _describe(error: BaseException) -> str:
    kind = type(error).__name__
    if isinstance(error, SystemExit):
        return "the program may not be ended from here"
    if isinstance(error, KeyError) and error.args:
        return f"there is no key {error.args[0]!r} ({kind})"
    text = _text_of(error)
    if isinstance(error, AssertionError) and not text:
        text = "this does not hold"
    return f"{text} ({kind})" if text else kind


def _text_of(error: BaseException) -> str:
    """Return an exception's text on one line, or nothing if its own code fails."""
    try:
        return " ".join(str(error).split())
    except Exception:
        return ""


def _hint(error: BaseException) -> str | None:
    text = _text_of(error)
    if isinstance(error, AttributeError) and isinstance(error.obj, dict):
        return f"an entry of a mapping is read as d['{error.name}']"
    if isinstance(error, AttributeError) and error.name and error.obj is not None:
        return did_you_mean(error.name, [name for name in dir(error.obj) if name[:1] != "_"])
    if isinstance(error, KeyError) and error.args:
        return None
    if isinstance(error, TypeError) and "concatenate str" in text:
        return "a text and a number do not add up: write str(…) around the number"
    is_operation = "operand" in text or "not supported between" in text
    if isinstance(error, TypeError) and "'str'" in text and is_operation:
        return "one side is a text; is a number quoted where it is declared?"
    if isinstance(error, TypeError) and "'NoneType'" in text:
        return "one of the values is empty (null)"
    if isinstance(error, SystemExit):
        return "leave out exit(); to stop with an error, raise an exception"
    return None


def add_trace(error: YamaroError, frame: Frame | None) -> None:
    """Note how the run came to an error, unless a step further in has told already."""
    for diagnostic in error.diagnostics:
        if diagnostic.trace is None:
            diagnostic.trace = frame
