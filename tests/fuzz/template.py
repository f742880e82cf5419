"""Target: `$(…)` in text. Python's own tokenizer is the second opinion on where one ends.

A text is split into literal pieces and expressions, which join to it; or it is refused. Each
expression is Python, and every name in it is found at its place in the YAML. So is each name in a
text that is Python statements.
"""

from __future__ import annotations

import ast
import io
import re
import tokenize

from yamaro.diagnostics import Reporter, YamaroError
from yamaro.source import Source
from yamaro.syntax.context import ParseContext
from yamaro.syntax.python import (
    PythonCode,
    Template,
    compile_statements,
    expression_without_dollars,
    parse_template,
    ros_words,
    skip_expression,
)
from yamaro.syntax.values import parse_condition
from yamaro.yaml.brackets import find_close
from yamaro.yaml.nodes import DOUBLE, PLAIN, ScalarNode

from .checks import require_readable, require_sound

MODULES = ("syntax/python.py", "syntax/python.py", "yaml/brackets.py")
ESCAPED = re.compile(r"\$\$([({])")
CLOSING = {")": "(", "]": "[", "}": "{"}


def check(text: str) -> str:
    """Read a text as a template, a condition and statements; return what came of the first."""
    require_end(text)
    require_statements(text)
    require_cut(text)
    require_without_dollars(text)
    require_condition(text)
    node = node_of(text)
    context = ParseContext(Reporter())
    try:
        template = parse_template(node, context=context)
    except YamaroError as error:
        code = require_readable(error)
        if code == "unclosed-expression":
            start = error.diagnostics[0].span.start - node.start
            if node.style == PLAIN:
                assert text.startswith("$(", start)
                assert close_by_the_tokenizer(text[start + 2 :]) in (-1, None)
        return code
    require_sound(context.reporter.diagnostics)
    if isinstance(template, str):
        assert template == unescaped(text)
        assert not context.codes
        return "text"
    require_joined(template, text)
    for part in template.parts:
        if isinstance(part, PythonCode):
            require_python(part, text)
    assert context.codes == [part for part in template.parts if isinstance(part, PythonCode)]
    return "template" if template.only is None else "expression"


def require_cut(text: str) -> None:
    """Require that what YAML leaves of a text, when it ends it at a sign, is read or refused."""
    for sign in (" #", ","):
        piece, found, _ = text.partition(sign)
        if found and "\n" not in piece:
            source = Source(f"- {text}\n", name="t.yaml")
            node = ScalarNode(piece, PLAIN, source, 2, 2 + len(piece))
            for parse in (parse_template, parse_condition):
                try:
                    parse(node, context=ParseContext(Reporter()))
                except YamaroError as error:
                    require_readable(error)


def node_of(text: str) -> ScalarNode:
    if text.isprintable() or set(text) <= set("\n\t") | set(map(chr, range(32, 127))):
        return ScalarNode(text, PLAIN, Source(f"- {text}\n", name="t.yaml"), 2, 2 + len(text))
    written = "".join(f"\\U{ord(char):08X}" for char in text)
    source = Source(f'- "{written}"\n', name="t.yaml")
    return ScalarNode(text, DOUBLE, source, 2, 4 + len(written))


def unescaped(text: str) -> str:
    return ESCAPED.sub(r"$\1", text)


def require_joined(template: Template, text: str) -> None:
    """Require that the parts of a template, spelled again, are the text."""
    at = 0
    literal = ""
    for part in template.parts:
        if isinstance(part, str):
            assert not literal, "two literal pieces in a row"
            assert part, "an empty piece"
            literal = part
            continue
        assert text[part.index - 2 : part.index] == "$("
        assert unescaped(text[at : part.index - 2]) == literal
        assert text.startswith(f"{part.text})", part.index)
        assert skip_expression(text, part.index - 2) == part.index + len(part.text) + 1
        at = part.index + len(part.text) + 1
        literal = ""
    assert unescaped(text[at:]) == literal


# --- ends -------------------------------------------------------------------------------------


def require_end(text: str) -> None:
    """Require that an expression ends where Python says, and at a parenthesis in any case."""
    found = find_close(text, 0)
    assert found == -1 or text[found] == ")"
    expected = close_by_the_tokenizer(text)
    if expected is not None:
        assert found == expected


def close_by_the_tokenizer(text: str) -> int | None:
    """Return where Python sees the parenthesis before `text` closed; -1 if never or wrongly.

    None: the tokenizer gives up before, so that Python has no opinion; or it goes by rules that
    are not those of all versions: from 3.12 on, brackets inside an f-string are brackets.
    """
    if "\r" in text or "\x0c" in text or "\x00" in text:
        return None  # the tokenizer counts lines otherwise
    written = f"({text}"
    starts = [0]
    for line in written.split("\n"):
        starts.append(starts[-1] + len(line) + 1)
    stack: list[str] = []
    try:
        for token in tokenize.generate_tokens(io.StringIO(written, newline="\n").readline):
            if token.type == tokenize.ERRORTOKEN and token.string.strip():
                return None
            if tokenize.tok_name[token.type] in ("FSTRING_START", "TSTRING_START"):
                return None
            if token.type != tokenize.OP or token.string not in tuple("([{)]}"):
                continue
            if token.string in "([{":
                stack.append(token.string)
                continue
            if stack.pop() != CLOSING[token.string]:
                return -1
            if not stack:
                return starts[token.start[0] - 1] + token.start[1] - 1
    except tokenize.TokenError as error:
        return -1 if "multi-line statement" in str(error) else None
    except (SyntaxError, ValueError):
        return None
    return -1


# --- Python -----------------------------------------------------------------------------------


def require_python(code: PythonCode, text: str) -> None:
    """Require that Python reads an expression, and that its names are found in the text."""
    if ros_words(code.text):
        return
    assert code.code.co_name == "<module>"
    require_names(code, ast.parse(f"({code.text}\n)", mode="eval"), text)


def require_statements(text: str) -> None:
    """Require that a text is statements, whose names are found in it, or refused."""
    try:
        code = compile_statements(node_of(text), ParseContext(Reporter()).rules)
    except YamaroError as error:
        require_readable(error)
        return
    require_names(code, ast.parse(text), text)


def require_names(code: PythonCode, tree: ast.AST, text: str) -> None:
    """Require that the names in Python are found at their places in the text."""
    for node in ast.walk(tree):
        if not isinstance(node, ast.Name):
            continue
        at = code.byte_position(node.lineno, node.col_offset)
        end = code.byte_position(node.end_lineno or 1, node.end_col_offset or 0)
        assert 0 <= at <= end <= len(code.text)
        if node.id.isascii() and code.text.isascii() and not set(code.text) & set("\r\x0c"):
            assert code.text[at:end] == node.id
            assert text[code.index + at : code.index + end] == node.id
        span = code.span(at, end)
        assert code.node.start <= span.start <= span.end <= code.node.end


def require_without_dollars(text: str) -> None:
    """Require that `$(e)` becomes `(e)` at the same place, outside of strings."""
    result, quoted = expression_without_dollars(text)
    assert all(text.startswith("$(", at) for at in quoted)
    if not any(word in text for word in ("find", "arg", "env")):
        assert len(result) == len(text)
        kept = [at for at in range(len(text)) if result[at] != text[at]]
        assert all(text[at : at + 2] == "$(" and result[at : at + 2] == " (" for at in kept)


def require_condition(text: str) -> None:
    """Require that a text is a condition or refused."""
    context = ParseContext(Reporter())
    try:
        parse_condition(node_of(text), context)
    except YamaroError as error:
        require_readable(error)
    require_sound(context.reporter.diagnostics)
