"""Finds the place in the YAML that a Python traceback leads to.

It is the innermost one that the traceback goes through: the expression, or the line of the process
block whose function it called.
"""

from __future__ import annotations

from ..syntax.python import PythonCode, expression_without_dollars

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping
    from types import CodeType, TracebackType

    from ..source import Span


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
