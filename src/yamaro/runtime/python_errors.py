"""Explanations of failed Python: the place in the file, message, hints, origins of values."""

from __future__ import annotations

from ..diagnostics import Frame, InputFault, YamaroError, add_trace, did_you_mean, failure
from ..namespace import MISSING
from ..policy import Limits
from ..sandbox.deadline import TimeOver
from ..source import COMMAND_LINE, KEYWORD_ARGUMENT, Span
from ..syntax.python import TOO_MANY_DIGITS, PythonCode, expression_without_dollars
from ..yaml.brackets import find_close
from .expressions import a_kind_of
from .scope import Scope, variable_names

TYPE_CHECKING = False
if TYPE_CHECKING:
    import ast
    from collections.abc import Callable, Iterable, Mapping, Sequence
    from types import CodeType, TracebackType
    from typing import Any

    from ..diagnostics import Diagnostic
    from ..syntax.symbol_table import Declaration
    from .files import Files

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
        from ..diagnostics import meant
        from ..fixes import respelling

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


# --- the place in the YAML that a Python traceback leads to -----------------------------------


_OWN_FOLDER = __file__.rpartition("runtime")[0]


class TracebackPlace:
    """A place in the YAML found in a traceback.

    Attributes:
        python: the expression or the statements it is in.
        span: the failing piece.
        index: where that begins in the text of the Python, if it is known.
        steps: the user's functions around it, outermost first, each with where it is called.
        code: what failed.
        outside: the line of a module, called from there, that raised, as `file.py:line`.
    """

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
        self.index = index
        self.steps = steps
        self.outside: str | None = None


def innermost(
    error: BaseException, python: PythonCode, codes: Mapping[str, PythonCode]
) -> TracebackPlace:
    """Return the last place in the YAML that an error's traceback goes through.

    As a line where the piece of it depends on chance or on the version of Python: where
    the stack ran out, or a statement `assert` failed.

    Args:
        error: was raised while `python` ran.
        python: the expression or the statements.
        codes: all code that defines functions, by its file name.
    """
    traceback = error.__traceback__
    place = TracebackPlace(python, python.span(), None, [], python.code)
    own = python.code.co_filename
    while traceback is not None:
        code = traceback.tb_frame.f_code
        found = python if code.co_filename == own else codes.get(code.co_filename)
        if found is not None:
            is_line = isinstance(error, RecursionError) or (
                isinstance(error, AssertionError) and traceback.tb_next is None
            )
            index, span = _traceback_span(traceback, found, is_line=is_line)
            steps = place.steps
            if code.co_name[0] != "<":  # no <module>, <lambda>, <listcomp>
                steps.append((code.co_name, place.span if steps else python.span()))
            place = TracebackPlace(found, span, index, steps, code)
        elif not code.co_filename.startswith((_OWN_FOLDER, "<")):
            place.outside = f"{_base_name(code.co_filename)}:{traceback.tb_lineno}"
        traceback = traceback.tb_next
    return place


def line_outside(traceback: TracebackType | None) -> str | None:
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
    """Return the failing piece of Python: exact where Python gives columns, else its line."""
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


def find_name(python: PythonCode, name: str, index: int | None) -> Span | None:
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


# --- where a name that is not seen is declared, and why it is not seen ------------------------


MAX_NOTES = 3


def notes_on(subject: str, declarations: list[Declaration], span: Span) -> list[str]:
    """Return notes on where a name that is not known at `span` is declared.

    Args:
        subject: the name in quotes, and what it names if it is not a variable.
        declarations: all there are of that name.
        span: where it was looked up.
    """
    near_first = sorted(declarations, key=lambda one: not one.shares_context_with(span))
    return [_note_on(subject, declaration, span) for declaration in near_first[:MAX_NOTES]]


def _note_on(subject: str, declaration: Declaration, span: Span) -> str:
    place = declaration.span.place()
    if declaration.kind == "import":
        return f"{subject} is imported at {place}; each file has its own imports"
    if declaration.kind == "passed":
        return f"{subject} at {place} is passed to the file included there, and is local to it"
    if declaration.shares_context_with(span):
        if declaration.span.start > span.start:
            return f"{subject} is declared later, at {place}"
        return f"{subject} is declared at {place}, which has no effect here"
    if declaration.scope == "local":
        where = "function or block" if declaration.is_inner else "file"
        return (
            f"{subject} at {place} is local to its {where}; "
            "declare it as parent, child or global to see it here"
        )
    return f"{subject} is declared at {place} with scope {declaration.scope}"


# --- where values come from that an expression or condition failed on -------------------------


_EXPLAINED = (TypeError, ValueError, AttributeError, LookupError, ArithmeticError)


def notes_on_error(error: BaseException, piece: str, scope: Scope, code: CodeType) -> list[str]:
    """Return notes on the variables in a piece of Python that may be what it failed on.

    Args:
        error: what it raised.
        piece: the piece that failed.
        scope: where it was evaluated.
        code: the code in which it stands, whose local variables are Python's own.
    """
    if not isinstance(error, _EXPLAINED):
        return []
    local = {*code.co_varnames, *code.co_cellvars, *code.co_freevars}
    values = {name: scope.find(name) for name in names_in(piece) if name not in local}
    suspects = _suspects(
        values,
        is_zero_fault=isinstance(error, ZeroDivisionError),
        has_text="'" in piece or '"' in piece,
    )
    return notes_on_names(suspects, scope)


def names_of_value(python: PythonCode, scope: Scope, value: Any) -> list[str]:
    """Return the variables in an expression that have its value."""
    names = [python.name] if python.name is not None else names_in(python.text)
    return [name for name in names if scope.find(name) is value]


def notes_on_names(names: Iterable[str], scope: Scope) -> list[str]:
    """Return notes on where the values of variables come from."""
    places = ((name, scope.place_of(name)) for name in names)
    notes = [note_on(name, scope.find(name), place) for name, place in places if place is not None]
    return notes[:MAX_NOTES]


def note_on(name: str, value: Any, place: Span) -> str:
    """Return the note that a value comes from a variable."""
    kind = "null" if value is None else a_kind_of(value)
    article, _, rest = kind.partition(" ")
    if article in ("a", "an"):
        kind = f"the {rest}"
    return f"{kind} comes from '{name}', {set_at(place)}"


def set_at(place: Span) -> str:
    """Return where a variable was set, in words."""
    if place.source.name == COMMAND_LINE:
        return f"set by {place.source.text} on the command line"
    if place.source.name == KEYWORD_ARGUMENT:
        return "set from Python"
    return f"set at {place.place()}"


def names_in(text: str) -> list[str]:
    """Return the names that a piece of Python reads, each once, in order."""
    import ast

    return _names_of(node for node in _nodes(text) if isinstance(node, ast.Name))


def names_tested(text: str) -> list[str]:
    """Return the names that `not`, `and`, `or` or `if` asks for their truth."""
    import ast

    tested: list[ast.AST] = []
    for node in _nodes(text):
        if isinstance(node, ast.BoolOp):
            tested += node.values
        elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
            tested.append(node.operand)
        elif isinstance(node, ast.IfExp):
            tested.append(node.test)
    return _names_of(node for node in tested if isinstance(node, ast.Name))


def _nodes(text: str) -> Iterable[ast.AST]:
    """Return the syntax of a piece of Python, or nothing if it is not Python."""
    import ast

    text = text.strip().replace("$(", "(")
    try:
        return ast.walk(ast.parse(f"({text}\n)", mode="eval"))
    except SyntaxError:
        try:
            return ast.walk(ast.parse(text))
        except SyntaxError:
            return []


def _names_of(nodes: Iterable[ast.Name]) -> list[str]:
    """Return the names at some places, each once, in the order of the text."""
    ordered = sorted(nodes, key=lambda node: (node.lineno, node.col_offset))
    return list(dict.fromkeys(node.id for node in ordered))


def _suspects(values: dict[str, Any], *, is_zero_fault: bool, has_text: bool) -> list[str]:
    """Return the names of the values that an operation is least likely to be meant for.

    Numbers are suspects only where nothing else is: no other value, and no text in quotes.
    """
    known = {
        name: value
        for name, value in values.items()
        if value is not MISSING and not callable(value) and type(value).__name__ != "module"
    }
    if is_zero_fault:
        return [name for name, value in known.items() if _is_number(value) and value == 0]
    kinds = [
        lambda value: value is None or isinstance(value, (str, bytes)),
        lambda value: not _is_number(value),
        _is_number,
    ]
    for is_suspect in kinds[:2] if has_text else kinds:
        found = [name for name, value in known.items() if is_suspect(value)]
        if found:
            return found
    return []


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float))


def add_origins(diagnostic: Diagnostic, files: Files, passed: Mapping[str, Span]) -> None:
    """Note where the variables come from that are written at the place of an error in a part.

    The value is not at hand any more, so this reports only what the text of the program shows: a
    variable that is declared at one place, or given by the call or include that led there.

    Args:
        diagnostic: the error.
        files: the files of the program.
        passed: where the variables of the main file are set.
    """
    span = diagnostic.span
    text = span.written()
    listed: list[str] = []
    start = text.find("$(")
    while start >= 0:
        end = find_close(text, start + 2)
        if end < 0:
            break
        listed += names_in(text[start + 2 : end])
        start = text.find("$(", end)
    names = list(dict.fromkeys(listed))
    places = ((name, _only_place(name, diagnostic, files, passed)) for name in names)
    notes = [
        f"it comes from '{name}', {set_at(place)}"
        if len(names) == 1
        else f"'{name}' is {set_at(place)}"
        for name, place in places
        if place is not None
    ]
    diagnostic.notes = (*diagnostic.notes, *notes[:MAX_NOTES])


def _only_place(
    name: str, diagnostic: Diagnostic, files: Files, passed: Mapping[str, Span]
) -> Span | None:
    """Return the one place that gives a name its value where it is read, if there is just one."""
    span = diagnostic.span
    near = [
        each
        for each in files.where_declared(name)
        if each.kind not in ("import", "passed") and each.shares_context_with(span)
    ]
    inner = [each for each in near if each.is_inner] or near
    if len(inner) > 1:
        return None
    is_local = bool(inner) and inner[0].is_inner
    frame = diagnostic.trace
    while frame is not None and frame.kind != ("called" if is_local else "included"):
        frame = frame.parent
    if frame is not None and name in frame.places:
        return frame.places[name]
    if frame is None and name in passed and not is_local:
        return passed[name]
    return inner[0].span if inner else None
