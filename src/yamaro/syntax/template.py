"""`$(…)` inside scalars and keys: splits a text into literal pieces and Python expressions."""

from __future__ import annotations

from ..yaml.brackets import find_close
from .python import (
    PythonCode,
    compile_expression,
    ros_call,
    ros_words,
    unclosed,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..source import Span
    from ..yaml.nodes import ScalarNode
    from .context import ParseContext


class Template:
    """A text with expressions in it.

    Attributes:
        only: the expression that is the whole text, whose value keeps its type; else None.
    """

    __slots__ = ("end", "node", "only", "parts", "start")

    def __init__(
        self, parts: tuple[str | PythonCode, ...], node: ScalarNode, start: int, end: int
    ) -> None:
        """Hold the parts of `node.text[start:end]` in order."""
        self.parts = parts
        self.node = node
        self.start = start
        self.end = end
        first = parts[0]
        self.only = first if len(parts) == 1 and isinstance(first, PythonCode) else None

    def span(self) -> Span:
        """Return the place of the text."""
        if self.start == 0 and self.end == len(self.node.text):
            return self.node.span()
        return self.node.span(self.start, self.end)


def parse_template(
    node: ScalarNode, start: int = 0, end: int | None = None, *, context: ParseContext
) -> str | Template:
    """Return `node.text[start:end]` as a template, or as plain text if it holds no expression.

    Raises:
        YamaroError: an expression is not closed, or no Python.
    """
    text = node.text
    end = len(text) if end is None else end
    if text.find("$", start, end) < 0:
        return text if end - start == len(text) else text[start:end]
    parts: list[str | PythonCode] = []
    literal: list[str] = []
    at = start
    while (dollar := text.find("$", at, end)) >= 0:
        literal.append(text[at:dollar])
        if text.startswith(("$$(", "$${"), dollar) and dollar + 2 < end:
            literal.append(text[dollar + 1 : dollar + 3])
            at = dollar + 3
        elif text.startswith("$(", dollar) and dollar + 1 < end:
            close = find_close(text, dollar + 2)
            if close < 0 or close >= end:
                raise unclosed(node, dollar)
            if piece := "".join(literal):
                parts.append(piece)
            literal = []
            parts.append(parse_expression(node, dollar + 2, close, context))
            at = close + 1
        else:
            if text.startswith("${", dollar):
                _warn_of_xacro(node, dollar, context)
            literal.append("$")
            at = dollar + 1
    literal.append(text[at:end])
    if not parts:
        return "".join(literal)
    if piece := "".join(literal):
        parts.append(piece)
    return Template(tuple(parts), node, start, end)


def parse_expression(node: ScalarNode, start: int, end: int, context: ParseContext) -> PythonCode:
    """Return the expression `node.text[start:end]`, ROS's own forms included."""
    text = node.text[start:end]
    words = ros_words(text)
    meaning = ros_call(words) if words else None
    code = compile_expression(text, node, start, context.rules, meaning=meaning)
    context.codes.append(code)
    return code


def _warn_of_xacro(node: ScalarNode, index: int, context: ParseContext) -> None:
    close = node.text.find("}", index)
    inner = node.text[index + 2 : close] if close >= 0 else "…"
    from ..fixes import Edit, Fix

    fix = None
    if close >= 0 and not {"{", "("} & set(inner):
        edits = [Edit(node.span(index, index + 2), "$("), Edit(node.span(close, close + 1), ")")]
        fix = Fix(f"write $({inner})", edits)
    context.warn(
        "xacro-syntax",
        "'${' is xacro syntax and is not evaluated here",
        node.span(index, index + 2),
        hint=f"write $({inner}) for an expression, or $${{ for a literal ${{",
        fix=fix,
    )


def skip_expression(text: str, at: int) -> int:
    """Return the index behind the `$(…)` at `at`, or `at` if there is none or it is not closed."""
    if not text.startswith("$(", at):
        return at
    close = find_close(text, at + 2)
    return close + 1 if close >= 0 else at
