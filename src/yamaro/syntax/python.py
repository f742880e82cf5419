"""Python inside YAML: where an expression ends, its code and places; texts with `$(…)` in them."""

from __future__ import annotations

from ..diagnostics import InputFault, failure
from ..yaml.brackets import end_of_flow_value, end_of_string, find_close
from ..yaml.nodes import PLAIN, quoted
from .names import is_identifier, python_name

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import CodeType

    from ..source import Span
    from ..yaml.nodes import ScalarNode
    from .context import ParseContext, Rules

TOO_MANY_DIGITS = "Exceeds the limit"
"""How Python begins to say that an integer has thousands of digits."""
ROS_WORDS = ("find", "find-pkg-share", "arg", "env", "optenv")
_OPERATOR_WORDS = ("if", "else", "in", "is", "and", "or", "not", "for")


class PythonCode:
    """An expression or block of statements, and where in the YAML it stands.

    Attributes:
        name: if the expression is a single name, that name; else None. Nothing can be wrong with
            it and most are looked up without code, so that it is compiled only if that is needed.
    """

    __slots__ = ("_code", "index", "name", "node", "opening", "rules", "text")

    def __init__(
        self, text: str, node: ScalarNode, index: int, rules: Rules, *, opening: str
    ) -> None:
        """Hold Python text that begins at `node.text[index]`.

        Args:
            text: the Python text, of the length it has in the scalar.
            node: the scalar it is in.
            index: where in the scalar's text it begins.
            rules: say how it is compiled.
            opening: what was put before the text to compile it.
        """
        self.text = text
        self.node = node
        self.index = index
        self.rules = rules
        self.opening = opening
        self.name: str | None = None
        self._code: CodeType | None = None

    @property
    def code(self) -> CodeType:
        """Return the code object."""
        if self._code is None:
            assert self.name is not None, "all but names is compiled when it is parsed"
            self.compile(f"({self.text}\n)", "eval")
            assert self._code is not None
        return self._code

    def compile(self, text: str, mode: str) -> None:
        """Compile what the text means; raise what `Rules.compile` raises."""
        self._code = self.rules.compile(text, self.filename, mode)

    def span(self, start: int = 0, end: int | None = None) -> Span:
        """Return the place of `text[start:end]`; by default of all the text, trimmed."""
        if end is None:
            start = len(self.text) - len(self.text.lstrip())
            end = max(len(self.text.rstrip()), start)
        return self.node.span(self.index + start, self.index + end)

    def position(self, line: int, column: int) -> int:
        """Return the index into `text` of a position in the compiled text.

        Args:
            line: from 1.
            column: from 0, in characters.
        """
        if line <= 1:
            return min(max(column - len(self.opening), 0), len(self.text))
        start = 0
        for _ in range(line - 1):
            following = self.text.find("\n", start)
            if following < 0:
                return len(self.text)
            start = following + 1
        return min(start + column, len(self.text))

    def byte_position(self, line: int, column: int) -> int:
        """Return the index into `text` of a position whose column is counted in UTF-8 bytes."""
        compiled = (self.opening + self.text).split("\n")
        if line > len(compiled):
            return len(self.text)
        before = compiled[line - 1].encode("utf-8", "surrogatepass")[:column]
        return self.position(line, len(before.decode("utf-8", "ignore")))

    @property
    def filename(self) -> str:
        """Return a name for the code object that no other place has."""
        return f"<yamaro {self.node.source.path or self.node.source.name}:{self.span().start}>"


def compile_expression(
    text: str, node: ScalarNode, index: int, rules: Rules, *, meaning: str | None = None
) -> PythonCode:
    """Return the expression that stands at `node.text[index:]`, with nothing wrong in it.

    Args:
        text: the expression as written.
        node: the scalar it is in.
        index: where in the scalar's text it begins.
        rules: say which Python is allowed.
        meaning: the Python it means, where that is not what is written.

    Raises:
        YamaroError: it is empty or no Python expression.
    """
    python = PythonCode(text, node, index, rules, opening="(")
    if not text.strip():
        raise failure(
            "empty-expression",
            "an expression is missing here",
            node.span(max(index - 2, 0), min(index + len(text) + 1, len(node.text)))
            if node.text
            else node.span(),
            hint="write a Python expression between the parentheses, or $$( for a literal $("
            if index
            else "write a Python expression, such as length > 1.0",
        )
    name = text.strip(" ")
    if meaning is not None and meaning != text:
        _compile(python, f"({meaning}\n)", "eval", "this is not a Python expression")
    elif is_identifier(name) and python_name(name) == name and name[:2] != "__":
        python.name = name
    else:
        _compile(python, f"({text}\n)", "eval", "this is not a Python expression")
    return python


def compile_statements(node: ScalarNode, rules: Rules) -> PythonCode:
    """Return the compiled Python statements that are the whole text of a scalar.

    Raises:
        YamaroError: the text is not Python.
    """
    python = PythonCode(node.text, node, 0, rules, opening="")
    _compile(python, node.text, "exec", "this is not Python")
    return python


def _compile(python: PythonCode, text: str, mode: str, message: str) -> None:
    try:
        python.compile(text, mode)
    except SyntaxError as error:
        raise _syntax_failure(python, error, message) from None
    except InputFault as fault:
        span = python.span()
        added = 2 if python.opening else 0
        is_as_written = len(text) == len(python.opening + python.text) + added
        if fault.position is not None and is_as_written:
            line, column, end_line, end_column = fault.position
            start = python.byte_position(line, column)
            end = python.byte_position(end_line, end_column)
            span = python.span(start, end) if start < end else span
        raise failure(fault.code, fault.message, span, hint=fault.hint) from None
    except (ValueError, OverflowError, RecursionError, MemoryError) as error:
        is_deep = isinstance(error, (RecursionError, MemoryError))
        raise failure(
            "python-syntax",
            f"{message}: {'it is nested too deeply' if is_deep else error}",
            python.span(),
            hint="split it into several steps with variables",
        ) from None


def _syntax_failure(python: PythonCode, error: SyntaxError, message: str) -> Exception:
    line, column = error.lineno or 1, max((error.offset or 1) - 1, 0)
    start = python.position(line, column)
    end = start + 1
    if error.end_offset and error.end_offset > 0 and error.end_lineno == error.lineno:
        end = max(python.position(line, error.end_offset - 1), start + 1)
    if isinstance(error, IndentationError):
        # the line without its indentation: versions of Python differ in columns
        start = python.position(line, 0)
        text = python.text[start:].split("\n", 1)[0]
        start += len(text) - len(text.lstrip())
        span = python.span(start, start + max(len(text.strip()), 1))
    elif start >= len(python.text.rstrip()):
        span = python.span()
    else:
        span = python.span(start, min(end, len(python.text)))
    reason = (error.msg or "invalid syntax").strip()
    if reason.startswith(TOO_MANY_DIGITS):
        import re

        # Python's limit can be set down to 640
        found = re.search(r"[0-9][0-9_]{600,}", python.text)
        return failure(
            "number-too-long",
            "this integer has more digits than can be read",
            python.span(*found.span()) if found else python.span(),
            hint="quote it if it is text",
        )
    return failure("python-syntax", f"{message}: {reason}", span, hint=_syntax_hint(python, reason))


def _syntax_hint(python: PythonCode, reason: str) -> str | None:
    text = python.text
    first, *others = text.split() or [""]
    if python.opening and others:  # words of ROS's launch files, or of Python
        rest = " ".join(others)
        if first in ("eval", "arg", "var"):
            return f"remove the word {first}: $({rest})"
        if first == "env":
            return f"an environment variable with a default is $(optenv {rest})"
        if first in ("find", "find-pkg-share"):
            return f"write the name of a package without quotes: $({first} name)"
        if first in ("import", "from"):
            return "list modules at the root of the file: import: [math]"
    if ("unterminated" in reason or "never closed" in reason) and _is_cut_by_comment(python.node):
        return (
            f"' #' begins a YAML comment: write {_whole_value(python.node, len(python.node.text))}"
        )
    if "&&" in text or "||" in text:
        return "Python writes `and`, `or` and `not`"
    if "$" in text:
        return "inside an expression, write names without $"
    if python.opening and text.rstrip().endswith(":"):
        return "remove the colon at the end"
    if "=" in reason and "==" in reason:
        return "compare with =="
    from ..units import UNITS, factor_of, meant_by

    at = 0
    while at < len(text):
        start = at
        while at < len(text) and (text[at].isalnum() or text[at] in "._°"):
            at += 1
        word = text[start:at]
        number = word.rstrip("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ°\u00b5\u03bc")
        unit = word[len(number) :]
        if number[:1].isdigit() and unit:
            known = unit if unit in UNITS else meant_by(unit)
            if known is not None:
                factor = factor_of(known)
                short = number if factor == "1" else f"{number} * {factor}"
                return f"in expressions units are factors: write {short}"
        at += 1
    return None


def unclosed(node: ScalarNode, index: int) -> Exception:
    """Return the error for a `$(` at `node.text[index]` that is never closed."""
    after = node.source.text[node.end : node.end + 200]
    if _is_cut_by_comment(node):
        hint = f"' #' begins a YAML comment: write {_whole_value(node, index)}"
    elif node.style == PLAIN and after.lstrip(" ").startswith((",", "]", "}")):
        hint = f"the commas of {{ }} and [ ] split an expression: write {_whole_value(node, index)}"
    else:
        hint = "write $$( for a literal $("
    return failure(
        "unclosed-expression",
        "this $( is not closed by a )",
        node.span(index, min(index + 2, len(node.text))),
        hint=hint,
    )


def _is_cut_by_comment(node: ScalarNode) -> bool:
    after = node.source.text[node.end : node.end + 200]
    return node.style == PLAIN and after.lstrip(" ").startswith("#")


def _whole_value(node: ScalarNode, index: int) -> str:
    """Return a value that YAML cut short inside the `$(…)` at `index`, quoted."""
    rest = node.source.text[node.start :].split("\n", 1)[0].rstrip()
    close = find_close(rest, index + 2)
    return quoted(rest[: end_of_flow_value(rest, close + 1)] if close >= 0 else rest)


def ros_words(text: str) -> list[str] | None:
    """Return the words of a ROS substitution such as `find pkg`, or None if it is not one."""
    words = text.split()
    if len(words) < 2 or words[0] not in ROS_WORDS or words[1] in _OPERATOR_WORDS:
        return None
    if not (words[1][0].isalnum() or words[1][0] in "_./~"):
        return None
    if len(words) > 2 and words[0] != "optenv":
        return None
    return words


def ros_call(words: list[str]) -> str:
    """Return the Python call a ROS substitution means."""
    form, name = words[0], words[1]
    if form == "arg":
        return name
    if form == "env":
        return f"__env__({name!r})"
    if form == "optenv":
        return f"__env__({name!r}, {' '.join(words[2:])!r})"
    return f"__find__({name!r})"


def expression_without_dollars(text: str) -> tuple[str, list[int]]:
    """Return a text as one expression in which `$(e)` means `(e)`.

    Also returns the index of every `$(` that stands inside a string, where it is plain text.
    The result is as long as the text, so that places stay right, unless it holds ROS's forms.
    """
    if "$(" not in text:
        return text, []
    pieces: list[str] = []
    quoted: list[int] = []
    at = 0
    while at < len(text):
        if text[at] in "'\"":
            end = end_of_string(text, at)
            end = len(text) if end < 0 else end
            inside = text.find("$(", at, end)
            if inside >= 0:
                quoted.append(inside)
            pieces.append(text[at:end])
            at = end
        elif text.startswith("$(", at):
            close = find_close(text, at + 2)
            words = ros_words(text[at + 2 : close]) if close >= 0 else None
            pieces.append(f"({ros_call(words)}" if words else " (")
            at = close if words else at + 2
        else:
            pieces.append(text[at])
            at += 1
    return "".join(pieces), quoted


# --- texts with `$(…)` in them ----------------------------------------------------------------


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
    context.report(
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
