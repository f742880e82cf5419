"""Explains exceptions of the Python in a file: what is said of them, with which hint and notes."""

from __future__ import annotations

from ..diagnostics import Frame, InputFault, YamaroError, add_trace, did_you_mean, failure
from ..policy import Limits
from ..sandbox.deadline import TimeOver
from ..source import Span
from ..syntax.python import TOO_MANY_DIGITS, PythonCode
from .declared import Declaration, notes_on
from .scope import Scope, variable_names
from .tracebacks import find_name, innermost, line_outside

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

TIME_IS_OVER = "timed out while evaluating this"
JAIL_HINT = (
    "in a jail, a file can read its folder, its packages and the paths of --allow-path, but cannot "
    "write files or access the network and other processes; --trust runs it with all your rights"
)
NOTE_OF_TEXT = "the text '"
"""What a note begins with that says where a text comes from."""
TIME_HINT = "--timeout SECONDS sets a longer time"
YAML_1_1_BOOLEANS = {
    **dict.fromkeys(("yes", "on", "y", "true"), "true"),
    **dict.fromkeys(("no", "off", "n", "false"), "false"),
}
"""What YAML 1.1 took for a boolean, in lower case, and what to write for it."""


class Explainer:
    """Makes diagnostics of exceptions that are raised while a file runs.

    Attributes:
        limits: those of the conversion, which hints name.
        is_jailed: whether it runs in a jail, which may be why something is not permitted.
    """

    __slots__ = ("_codes", "_where_declared", "is_jailed", "limits")

    def __init__(
        self,
        codes: Mapping[str, PythonCode],
        where_declared: Callable[[str], list[Declaration]],
        limits: Limits,
        *,
        is_jailed: bool = False,
    ) -> None:
        """Begin.

        Args:
            codes: all code that defines functions, by its file name; may grow later.
            where_declared: gives every declaration of a name.
            limits: those of the conversion.
            is_jailed: whether it runs in a jail.
        """
        self._codes = codes
        self._where_declared = where_declared
        self.limits = limits
        self.is_jailed = is_jailed

    def explained(
        self, error: BaseException, python: PythonCode, scope: Scope, frame: Frame | None
    ) -> YamaroError:
        """Return the error that shows where in the YAML an exception came from, and why.

        Args:
            error: the exception.
            python: what raised it.
            scope: where that ran.
            frame: the calls and includes that led there.
        """
        if isinstance(error, YamaroError):  # in a file that `load_yaml` reads
            loaded = error.diagnostics[0].span.source.name
            add_trace(error, Frame("loaded", loaded, python.span(), parent=frame))
            return error
        place = innermost(error, python, self._codes)
        span = place.span
        steps = place.steps[:1] if isinstance(error, RecursionError) else place.steps
        for function, called_at in steps:
            frame = Frame("called", function, called_at, parent=frame)
        if type(error) is NameError and error.name:
            name_span = find_name(place.python, error.name, place.index) or span
            return self._undefined(error.name, name_span, scope, frame)
        from .origins import notes_on_error

        notes = notes_on_error(error, span.written(), scope, place.code)
        if place.outside:
            notes = [*notes, f"raised in {place.outside}"]
        return self._failure(error, span, frame, notes)

    def failed(self, error: BaseException, span: Span, frame: Frame | None) -> YamaroError:
        """Return the error for an exception that a method of a user's value raised at a span."""
        outside = line_outside(error.__traceback__)
        return self._failure(error, span, frame, [f"raised in {outside}"] if outside else [])

    def _failure(
        self, error: BaseException, span: Span, frame: Frame | None, notes: Sequence[str]
    ) -> YamaroError:
        told = _told_without_notes(error, span, frame)
        if told is not None:
            return told
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
            else _hint_for_quantity(error, notes) or _hint(error),
            notes=notes,
            trace=frame,
        )

    def _undefined(self, name: str, span: Span, scope: Scope, frame: Frame | None) -> YamaroError:
        # Where the name is declared says more than what other names look like it.
        notes = notes_on(f"'{name}'", self._where_declared(name), span)
        from ..fixes import respelling
        from ..suggestions import meant

        hint, fix = (None, None) if notes else meant(name, variable_names(scope), span)
        if name.lower() in YAML_1_1_BOOLEANS and len(name) > 1:  # n is the name of a number
            boolean = YAML_1_1_BOOLEANS[name.lower()]
            hint = f"write {boolean}: in YAML 1.2 '{name}' is an ordinary word"
            fix = respelling(span, name, boolean, is_safe=True)
        if not notes and (hint is None or name[1:]) and (other := _hint_for_unit(name, span)):
            hint, fix = other, None
        return failure(
            "undefined-name",
            f"name '{name}' is not defined",
            span,
            hint=hint,
            notes=notes,
            trace=frame,
            fix=fix,
        )


def _hint_for_quantity(error: BaseException, notes: Sequence[str]) -> str | None:
    """Return what to write for a text such as `350mm` that an expression computes with."""
    if not isinstance(error, TypeError):
        return None
    from ..units import in_python

    for note in notes:
        text = note.removeprefix(NOTE_OF_TEXT)
        expression = in_python(text.partition("'")[0]) if text != note else None
        if expression is not None:
            return f"a number with a unit is a text: to compute with it, declare $({expression})"
    return None


def _hint_for_unit(name: str, span: Span) -> str | None:
    """Return what to write for a unit in an expression, or None if the name is probably none.

    A word of one letter is a unit only as a factor: `350 * m`.
    """
    from ..units import UNITS, factor_of, meant_by

    unit = name if name in UNITS else meant_by(name) if len(name) > 1 else None
    if unit is None:
        return None
    text = span.source.text
    is_factor = text[: span.start].rstrip(" ")[-1:] in ("*", "/")
    is_factor = is_factor or text[span.end :].lstrip(" ")[:1] in ("*", "/")
    if len(name) == 1 and not is_factor:
        return None
    factor = factor_of(unit)
    doubt = f"if '{name}' is a unit: " if len(name) == 1 else ""
    if factor == "1":
        return f"{doubt}expressions are in SI units, so leave '{name}' out"
    return f"{doubt}in expressions units are factors: write {factor} for '{name}'"


def _told_without_notes(
    error: BaseException, span: Span, frame: Frame | None
) -> YamaroError | None:
    """Return the error for an exception that Yamaro raised, or that Python's own limits did."""
    if isinstance(error, InputFault):
        return failure(error.code, error.message, span, hint=error.hint, trace=frame)
    if isinstance(error, RecursionError):
        return failure(
            "too-deep",
            "this calls itself endlessly",
            span,
            hint="a function that calls itself needs a condition that ends the recursion",
            trace=frame,
        )
    if isinstance(error, ValueError) and str(error).startswith(TOO_MANY_DIGITS):
        return failure(
            "number-too-long",
            "this integer has too many digits",
            span,
            trace=frame,
        )
    if isinstance(error, TimeOver):
        return failure("limit-time", TIME_IS_OVER, span, hint=TIME_HINT, trace=frame)
    return None


def _describe(error: BaseException) -> str:
    kind = type(error).__name__
    if isinstance(error, SystemExit):
        return "code in a file cannot end the program"
    if isinstance(error, KeyError) and error.args:
        return f"there is no key {error.args[0]!r} ({kind})"
    text = _text_of(error)
    if isinstance(error, AssertionError) and not text:
        text = "this assertion is false"
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
        return f"read an entry of a mapping as d['{error.name}']"
    if isinstance(error, AttributeError) and error.name and error.obj is not None:
        return did_you_mean(error.name, [name for name in dir(error.obj) if name[:1] != "_"])
    if isinstance(error, KeyError) and error.args:
        return None
    if isinstance(error, TypeError) and "concatenate str" in text:
        return "a text and a number cannot be added: write str(…) around the number"
    is_operation = "operand" in text or "not supported between" in text
    if isinstance(error, TypeError) and "'str'" in text and is_operation:
        return "one side is a text; is a number quoted where it is declared?"
    if isinstance(error, TypeError) and "'NoneType'" in text:
        return "one of the values is empty (null)"
    if isinstance(error, SystemExit):
        return "remove exit(); to stop with an error, raise an exception"
    return None
