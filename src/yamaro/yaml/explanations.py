"""What was probably meant by text that is not YAML: a function for each way to get it wrong.

Each takes what the YAML parser said and returns the error to show, or None if the case is another.
"""

from __future__ import annotations

import re

from ..diagnostics import failure
from ..fixes import Edit, Fix, replacement
from .brackets import end_of_flow_value, find_close, start_of_flow_value
from .libyaml import Parser, YAMLError
from .nodes import quoted
from .recovery import first_control_character

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, NoReturn, Protocol

    from ..fixes import Fix
    from ..source import Span

    class GivenText(Protocol):
        """What is being read: the text, and how its offsets map to the file."""

        text: str

        def span(self, start: int, end: int) -> Span:
            """Return the place of a stretch of the text."""


# --- what has to be quoted in YAML and is not: the errors for it, each with its fix -----------


def line_around(text: str, at: int) -> tuple[int, int]:
    """Return start and end of the line that holds offset `at`."""
    start = max(text.rfind("\n", 0, at), text.rfind("\r", 0, at)) + 1
    ends = [end for end in (text.find("\n", at), text.find("\r", at)) if end >= 0]
    return start, min(ends) if ends else len(text)


def needs_quotes(given: GivenText, at: int) -> Exception:
    """Return the error for a key or value at `at` whose first character YAML reserves."""
    text = given.text
    char = text[at : at + 1]
    if char == "," and text[:at].endswith(('"', "'")):
        behind_quote = _rest(given, "", "", at, at)
        if behind_quote is not None:
            return behind_quote
    start, end = line_around(text, at)
    comment = text.find(" #", at, end)
    value = text[at : comment if comment >= 0 else end].rstrip()
    before = text[start:at].lstrip()
    what, behind = "value", ""
    if not before.strip("- ") and ": " in f"{value} ":
        value, behind, _ = f"{value} ".partition(": ")
        what, behind = "key", ":"
    elif "{" in before or "[" in before:
        ends = [index for index, each in enumerate(value) if index and each in ",]}"]
        behind = value[ends[0] :] if ends else ""
        value = value[: ends[0]].rstrip() if ends else value
    hint = f"write {before}{quoted(value)}{behind}"
    span = given.span(at, at + max(len(value), 1))
    fix: Fix | None = replacement(span, quoted(value), is_safe=True)
    if char == "%" and before.endswith("{"):
        hint = "conditions and loops are the statements `if:` and `for:`"
        fix = None
    return failure(
        "yaml-quote",
        f"a {what} cannot begin with {char} in YAML unless it is quoted",
        span,
        hint=hint,
        fix=fix if value else None,
    )


def expression_in_brackets(
    given: GivenText, found: str, begin: int, start: int, end: int
) -> Exception:
    """Return the error for `{ size: 1 $(sizes[0]) }`: its brackets end what is around.

    Args:
        given: what is being read.
        found: the bracket that YAML met.
        begin: where the mapping or list around begins.
        start: where the expression begins.
        end: where it ends.
    """
    text = given.text
    first, last = start_of_flow_value(text, begin, start), end_of_flow_value(text, end)
    # A value is quoted as a whole: in the middle of it, quotes mean nothing.
    whole = re.sub(r"""(['"])(\$\([^'"]*\))\1""", r"\2", text[first:last])
    return failure(
        "yaml-quote",
        f"a value with an expression that contains {found} must be quoted inside {{ }} and [ ]",
        given.span(start, end),
        hint=f"write {quoted(whole)}",
        fix=replacement(given.span(first, last), quoted(whole), is_safe=True),
    )


def colon_in_key(
    given: GivenText, problem: str, context: str, begin: int, at: int
) -> Exception | None:
    """Return the error for `for k in {1: 2}:`, where the brackets of an expression have a `: `."""
    start, end = line_around(given.text, at)
    line = given.text[start:end]
    colons = [found.start() for found in re.finditer(r":(?= |$)", line)]
    key = next((line[:colon] for colon in colons if _is_closed(line[:colon])), "")
    where = len(key) - len(key.lstrip(" -"))
    if not key or len(key) == colons[0] or key[where : where + 1] in _NOT_PLAIN:
        return None
    span = given.span(start + where, start + len(key))
    return failure(
        "yaml-quote",
        "a key that contains ': ' must be quoted",
        span,
        hint=f"write {quoted(key[where:])}:",
        fix=quoting(span, key[where:]),
    )


def _is_closed(text: str) -> bool:
    if any(text.count(quote) % 2 for quote in "\"'"):
        return False
    return all(text.count(one) == text.count(other) for one, other in ("()", "[]", "{}"))


def quoting(span: Span, meant: str) -> Fix | None:
    """Return the fix that writes a text in quotes, unless a comment seems to follow it."""
    return None if " #" in meant else replacement(span, quoted(meant), is_safe=True)


def text_behind_quote(given: GivenText, key: str, value: str, where: int, at: int) -> Exception:
    """Return the error for a value whose quotes or brackets close before its end."""
    text = given.text
    closing = text[:at].rstrip()[-1]
    advice, meant = "quote the whole value:", value
    extra = value[len(text[where:at].rstrip()) :].strip()
    if extra and not extra.strip("]}"):
        advice, meant = "delete the extra text, or quote the whole value:", value
    if text[at - 1] == closing == value[0] == value[-1] and text[at].isalnum():
        advice, meant = f"a {closing} inside the text ends it; write", value[1:-1]
    shown = f"{key}: {quoted(meant)}" if key else quoted(meant)
    span = given.span(where, max(where + len(value), where + 1))
    return failure(
        "yaml-quote",
        f"text follows the closing {closing} of this value",
        span,
        hint=f"{advice} {shown}",
        fix=None if advice.startswith("delete") else quoting(span, meant),
    )


# --- explanations -----------------------------------------------------------------------------


MAX_KEY = 1024
MAX_EDITS = 1000
"""Edits of one fix."""
_NO_BREAK_SPACE = "\u00a0"


def _tab(given: GivenText, problem: str, context: str, begin: int, at: int) -> Exception | None:
    text = given.text
    start, end = line_around(text, at)
    margin = text[start:end][: len(text[start:end]) - len(text[start:end].lstrip())]
    if "\t" not in margin or not ("tab" in problem or start <= at <= start + len(margin)):
        return None
    tab = start + margin.index("\t")
    return failure(
        "yaml-tab",
        "YAML does not allow tabs in the indentation",
        given.span(tab, tab + 1),
        hint="replace the tab with spaces",
    )


def _no_break_space(
    given: GivenText, problem: str, context: str, begin: int, at: int
) -> Exception | None:
    """Explain an indentation pasted from a web page, which YAML takes for letters."""
    text = given.text
    found = text.find(_NO_BREAK_SPACE)
    _, end = line_around(text, at)
    while 0 <= found < end:
        start, _ = line_around(text, found)
        if not text[start:found].strip():
            span = given.span(found, found + 1)
            return failure(
                "yaml-tab",
                "YAML does not allow no-break spaces (U+00A0) in the indentation",
                span,
                hint="replace it with a space; it often comes from pasting a web page",
                fix=_without_no_break_spaces(given),
            )
        found = text.find(_NO_BREAK_SPACE, found + 1)
    return None


def _without_no_break_spaces(given: GivenText) -> Fix:
    """Return the fix that makes the indentation of all lines of ordinary spaces."""
    edits: list[Edit] = []
    at = given.text.find(_NO_BREAK_SPACE)
    while at >= 0 and len(edits) < MAX_EDITS:
        start, _ = line_around(given.text, at)
        if not given.text[start:at].strip():
            edits.append(Edit(given.span(at, at + 1), " "))
        at = given.text.find(_NO_BREAK_SPACE, at + 1)
    return Fix("replace the no-break spaces in the indentation", edits, is_safe=True)


def _start_of_value(
    given: GivenText, problem: str, context: str, begin: int, at: int
) -> Exception | None:
    text = given.text
    if "cannot start any token" not in problem and "alphabetic or numeric" not in problem:
        return None
    if "alphabetic" in problem:
        at = begin
    if text[at : at + 1] == "\t":
        span = given.span(at, at + 1)
        return failure(
            "yaml-tab",
            "YAML does not allow a tab here",
            span,
            hint="replace the tab with a space",
            fix=replacement(span, " ", is_safe=True),
        )
    return needs_quotes(given, at)


def _open_quote(
    given: GivenText, problem: str, context: str, begin: int, at: int
) -> Exception | None:
    if "quoted scalar" not in context or "end of stream" not in problem:
        return None
    return failure(
        "yaml-open",
        "this quote is not closed",
        given.span(begin, begin + 1),
        hint="put the same quote after the text; inside '…', write '' for a '",
    )


def _open_bracket(
    given: GivenText, problem: str, context: str, begin: int, at: int
) -> Exception | None:
    text = given.text
    if "flow" not in context or text[begin : begin + 1] not in ("[", "{"):
        return None
    closing = "]" if text[begin] == "[" else "}"
    found = text[at : at + 1].strip()
    key = max(text.rfind(sign, begin, at) for sign in ",[{") + 1
    key += len(text[key:at]) - len(text[key:at].lstrip())
    if found == ":" and at - key > MAX_KEY:
        return _long_key(given, key)
    hint = "quote a text or expression that contains , : # [ ] { }"
    dollar = text.rfind("$(", begin, at)
    close = find_close(text, dollar + 2) if dollar >= 0 else -1
    if close > at:
        return expression_in_brackets(given, found, begin, dollar, close + 1)
    if found and "\n" not in text[begin:at]:
        return failure(
            "yaml-open",
            f"expected , or {closing} here, found {found}",
            given.span(at, at + 1),
            hint=hint,
        )
    return failure(
        "yaml-open",
        f"this {text[begin]} is not closed: '{closing}' is missing",
        given.span(begin, begin + 1),
        hint=f"put a {closing} at its end; {hint}",
    )


def _escape(given: GivenText, problem: str, context: str, begin: int, at: int) -> Exception | None:
    if "escape" not in problem and "expected hex" not in problem:
        return None
    slash = max(given.text.rfind("\\", 0, at + 1), 0)
    if "invalid Unicode" in problem:
        return failure(
            "yaml-escape",
            f"the escape that begins with '{given.text[slash : slash + 2]}' is not a Unicode "
            "character",
            given.span(slash, slash + 2),
            hint="write the character itself",
        )
    lacks_digits = given.text[slash + 1 : slash + 2] in ("x", "u", "U")
    return failure(
        "yaml-escape",
        f"the escape '{given.text[slash : slash + 2]}' has too few hexadecimal digits"
        if lacks_digits
        else f"'{given.text[slash : slash + 2]}' is not a YAML escape",
        given.span(slash, slash + 2),
        hint="use single quotes, in which a backslash is an ordinary "
        "character, or write the backslash twice",
    )


def _tag(given: GivenText, problem: str, context: str, begin: int, at: int) -> Exception | None:
    """Explain a tag that is not spelt like one; those that are get the same code."""
    if "tag handle" not in problem and context not in _READING_TAGS:
        return None
    text = given.text
    start = begin if text[begin : begin + 1] == "!" else at
    _, end = line_around(text, start)
    written = text[start:end].split()[0] if text[start:end].strip() else "!"
    return failure(
        "yaml-tag",
        f"'{written}' begins with !, so it is a YAML tag, which is not supported here",
        given.span(start, start + len(written)),
        hint="quote the value if it is text; in an expression, write `not` instead of !",
    )


def _second_anchor(
    given: GivenText, problem: str, context: str, begin: int, at: int
) -> Exception | None:
    """Explain an anchor behind which YAML allows neither a second one nor an alias."""
    text = given.text
    start, _ = line_around(text, at)
    before = text[start:at].rstrip().rpartition(" ")[2]
    if text[at : at + 1] not in ("&", "*") or not before.startswith("&"):
        return None
    written = text[at:].split(maxsplit=1)[0]
    return failure(
        "yaml-syntax",
        "a value can have one anchor only"
        if written.startswith("&")
        else "an alias cannot have an anchor, since its value already has one",
        given.span(at, at + len(written)),
        hint=f"delete {written if written.startswith('&') else before}",
    )


def _colon(given: GivenText, problem: str, context: str, begin: int, at: int) -> Exception | None:
    text = given.text
    start, end = line_around(text, at)
    if "mapping values are not allowed" in problem:
        return _second_colon(given, start, end, at)
    if "expected ':'" not in problem:
        return None
    first = text[begin:end]
    if len(first.partition(": ")[0]) > MAX_KEY:
        return _long_key(given, begin)
    return _no_colon(given, begin)


def _no_colon(given: GivenText, begin: int) -> Exception:
    """Return the error for the line that begins at `begin` and is not a `key: value`."""
    text = given.text
    _, end = line_around(text, begin)
    key, colon, value = text[begin:end].partition(":")
    if colon and key.isidentifier():
        span = given.span(begin + len(key), begin + len(key) + 1)
        return failure(
            "yaml-syntax",
            "there is no space after the ':', so this is neither a key nor a value",
            span,
            hint=f"write {key}: {value.strip()}",
            fix=replacement(span, ": ", is_safe=value[:1] != "/"),
        )
    line = _without_comment(text[begin:end])
    span = given.span(begin, max(begin + len(line), begin + 1))
    is_key = ":" not in line and _has_lines_below(text, begin)
    return failure(
        "yaml-syntax",
        "this line has no ':' followed by a space, so it is neither a key nor a value"
        if colon
        else "this line has no ':', so it is neither a key nor a value",
        span,
        hint=f"write {line}:"
        if is_key
        else "put a ':' after a key; indent the lines of a long text deeper than its key",
        fix=replacement(span, f"{line}:", is_safe=True) if is_key and line.isidentifier() else None,
    )


def _without_comment(line: str) -> str:
    """Return a line of YAML without a comment at its end, and the space before it."""
    return line.partition(" #")[0].rstrip()


def _has_lines_below(text: str, begin: int) -> bool:
    """Return whether deeper lines, or items of a list, follow the line whose text is at `begin`."""
    start, end = line_around(text, begin)
    for line in text[end:].splitlines():
        content = line.lstrip(" ")
        if content and not content.startswith("#"):
            depth = len(line) - len(content)
            is_item = content.startswith("- ") and depth == begin - start
            return depth > begin - start or is_item
    return False


def _key_above(text: str, start: int) -> int | None:
    """Return where a key begins that lacks its ':' and has the line at `start` below it, or None.

    Of several, one in another, it is the outermost: to YAML they are one text.
    """
    line = text[start : line_around(text, start)[1]]
    content = line.lstrip(" ")
    depth, found = len(line) - len(content), None
    while start > 0:
        start, end = line_around(text, start - (2 if text[start - 2 : start] == "\r\n" else 1))
        content = _without_comment(text[start:end]).lstrip(" ")
        if not content or content.startswith("#"):
            continue
        margin = end - start - len(text[start:end].lstrip(" "))
        is_entry = content.startswith("- ")
        key = content.lstrip("- ") if is_entry else content
        column = margin + len(content) - len(key)
        if ": " in key or key.endswith(":") or key[:1] in _NOT_PLAIN:
            is_value = key[:1] not in _NOT_PLAIN and not key.endswith(":") and column < depth
            return None if is_value else found
        if column > depth:
            return found
        found, depth = start + column, column
        if is_entry:
            return found
    return found


_NOT_PLAIN = frozenset("'\"[{|>&*!%@`#-?,]}")


def _long_key(given: GivenText, at: int) -> Exception:
    return failure(
        "yaml-long-key",
        f"this key is longer than the {MAX_KEY:,} characters that YAML allows",
        given.span(at, at + MAX_KEY),
        hint="store long attribute values in variables: name/attribute=$(variable)",
    )


def _second_colon(given: GivenText, start: int, end: int, at: int) -> Exception:
    text = given.text
    line = text[start:end]
    if at - start > MAX_KEY and ": " not in text[start:at]:
        return _long_key(given, start + len(line) - len(line.lstrip()))
    key, colon, value = line.partition(": ")
    if colon and start + len(key) < at:
        where = start + len(key) + 2
        where += len(value) - len(value.lstrip())
        value = value.strip()
        span = given.span(where, max(where + len(value), where + 1))
        return failure(
            "yaml-quote",
            "a value that contains ': ' must be quoted",
            span,
            hint=f"write {key.strip()}: {quoted(value)}",
            fix=quoting(span, value),
        )
    above = _key_above(text, start)
    if above is not None:
        return _no_colon(given, above)
    return failure(
        "yaml-syntax",
        "a key is not allowed at this indentation",
        given.span(start + len(line) - len(line.lstrip()), at + 1),
        hint="keys of one mapping begin in the same column; a key "
        "with a value cannot contain other keys",
    )


def _misplaced(
    given: GivenText, problem: str, context: str, begin: int, at: int
) -> Exception | None:
    """Explain a sign that stands where YAML gives it another meaning."""
    text = given.text
    start, end = line_around(text, at)
    line = text[start:end]
    if "sequence entries are not allowed" in problem:
        above = _key_above(text, start)
        if above is not None:
            return _no_colon(given, above)
        key, _, item = line.strip().partition(": - ")
        return failure(
            "yaml-syntax",
            "a list cannot begin on the line of its key",
            given.span(at, at + 1),
            hint=f"write {key}: [{item}], or put the dash on the next line",
        )
    if re.search("comment or (a )?line break|indentation indicator", problem):
        return failure(
            "yaml-syntax",
            "a block of text begins on the line after its | or >",
            given.span(at, max(end, at + 1)),
            hint="move this to the next line, indented",
        )
    if line.strip() == ":" or line.lstrip().startswith(": "):
        colon = text.index(":", start)
        return failure(
            "yaml-syntax",
            "the key before this ':' is missing",
            given.span(colon, colon + 1),
            hint="write name: value",
        )
    if text[at : at + 1] in (",", "]", "}") and not line[: at - start].rstrip().endswith(
        ("]", "}")
    ):
        return needs_quotes(given, at)
    return None


def _directive(
    given: GivenText, problem: str, context: str, begin: int, at: int
) -> Exception | None:
    """Explain a line that begins with %, which makes it a directive."""
    start, end = line_around(given.text, at)
    if "incompatible YAML" in problem:
        return failure(
            "yaml-syntax",
            "this version of YAML is not supported",
            given.span(start, end),
            hint="delete the line",
        )
    if "directive" in problem or "directive" in context:
        return failure(
            "yaml-quote",
            "a line cannot begin with % in YAML unless it is quoted",
            given.span(start, end),
            hint=f"write {quoted(given.text[start:end].strip())}",
        )
    return None


def _rest(given: GivenText, problem: str, context: str, begin: int, at: int) -> Exception | None:
    text = given.text
    start, end = line_around(text, at)
    before = text[start:at].rstrip()
    if "document start" in problem and not before:
        return failure(
            "several-documents",
            "this line is after the end of the document",
            given.span(start + len(before), max(end, start + 1)),
            hint="all keys of a file begin in the first column; `...` ends the document",
        )
    if before.endswith(("]", "}", '"', "'")) and text[at:end].strip():
        begun = _quote_over_lines(given, start + len(before))
        if begun is not None:
            return begun
        key, colon, value = text[start:end].partition(": ")
        where = start + len(key) + 2
        if not colon or at < start + len(key):  # it is the key that begins with a quote
            colon = ""
            where, value = start + len(key) - len(key.lstrip(" -")), key.lstrip(" -")
        value = value.strip()
        return text_behind_quote(given, key.strip() if colon else "", value, where, at)
    if "block" not in context and "document start" not in problem:
        return None
    above = _key_above(text, start)
    if above is not None:
        return _no_colon(given, above)
    column = at - start + len(text[at:end]) - len(text[at:end].lstrip())
    return failure(
        "yaml-syntax",
        "the indentation of this line does not match the mapping or list around it",
        given.span(start + column, max(end, start + column + 1)),
        hint="entries of one mapping or list begin in the same column",
    )


def _quote_over_lines(given: GivenText, end: int) -> Exception | None:
    """Explain text behind a quote at `end` that closes one of a line before."""
    text = given.text
    begin = _start_of_quoted(text, end)
    if begin is None or not any(char in text[begin:end] for char in "\r\n"):
        return None
    line, _ = given.span(end - 1, end).location()
    return failure(
        "yaml-open",
        f"this quote is not closed before line {line}, where text follows the closing quote",
        given.span(begin, begin + 1),
        hint=f"put a {text[begin]} at the end of the text that begins here",
    )


def _start_of_quoted(text: str, end: int) -> int | None:
    """Return where the quoted text begins whose closing quote stands just before `end`."""
    parser = Parser(text)
    try:
        while (token := parser.get_token()) is not None:
            if token.end_mark.index == end and getattr(token, "style", None) in ("'", '"'):
                return int(token.start_mark.index)
    except YAMLError:
        return None
    finally:
        parser.dispose()
    return None


_READING_TAGS = ("while parsing a tag", "while scanning a tag")
EXPLANATIONS = (
    colon_in_key,
    _tag,
    _tab,
    _no_break_space,
    _start_of_value,
    _open_quote,
    _open_bracket,
    _escape,
    _second_anchor,
    _colon,
    _directive,
    _misplaced,
    _rest,
)


# --- faults -----------------------------------------------------------------------------------


def refuse_yaml(error: Any, given: GivenText) -> NoReturn:
    """Raise the YamaroError that explains an error of the YAML parser."""
    problem = str(getattr(error, "problem", None) or getattr(error, "reason", None) or error)
    mark = getattr(error, "problem_mark", None)
    if mark is None:
        at = first_control_character(given.text)
        raise failure(
            "control-character",
            f"the character U+{ord(given.text[at]):04X} is not allowed in a YAML file"
            if at < len(given.text)
            else f"the file cannot be read as YAML: {problem}",
            given.span(at, at + 1),
            hint="delete this invisible character",
        )
    context = str(getattr(error, "context", None) or "")
    context_mark = getattr(error, "context_mark", None)
    begin = context_mark.index if context_mark is not None else mark.index
    for explain in EXPLANATIONS:
        found = explain(given, problem, context, begin, mark.index)
        if found is not None:
            raise found
    raise failure(
        "yaml-syntax",
        f"this is not YAML: {problem}",
        given.span(mark.index, mark.index + 1),
        hint="compare the indentation with the lines above and below",
    )
