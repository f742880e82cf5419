"""Short heads such as `if x == {'a': 1}:` that YAML cuts, since they are not quoted."""

from __future__ import annotations

from ..diagnostics import failure
from ..source import Span
from .brackets import end_of_string
from .nodes import PLAIN, quoted

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..diagnostics import YamaroError
    from .explanations import GivenText
    from .nodes import ScalarNode

WORDS = ("if", "elif", "for")
_OPENING, _CLOSING = "([{", ")]}"


def is_head(text: str) -> bool:
    """Return whether a key begins like a short head."""
    word = text.split("(", 1)[0]
    if word.split(" ", 1)[0] in WORDS:
        return len(text) > len(word) or " " in word.strip()
    return len(word) < len(text) and word.isidentifier() and word[0].isupper()


def end_of_head(text: str, start: int) -> int | None:
    """Return the offset of the `:` that ends a head in its line, or None if there is none.

    Python's rules say where: brackets nest, and strings do not count.
    """
    depth = 0
    at = start
    while at < len(text) and text[at] not in "\r\n":
        char = text[at]
        if char in "'\"":
            at = end_of_string(text, at)
            if at < 0:
                return None
            continue
        if char == "#":
            return None
        if char in _OPENING:
            depth += 1
        elif char in _CLOSING:
            depth -= 1
            if depth < 0:
                return None
        elif char == ":" and not depth and text[at + 1 : at + 2] in ("", " ", "\t", "\r", "\n"):
            return at
        at += 1
    return None


def _cut_head(what: str, head: str, span: Span, before: str = "") -> YamaroError:
    return failure(
        "yaml-quote",
        f"a key that contains {what} must be quoted",
        span,
        hint=f"write {before}{quoted(head)}:",
    )


def explain_cut_head(
    given: GivenText, problem: str, context: str, begin: int, at: int
) -> Exception | None:
    """Explain text that is not YAML since it has a head in it."""
    text = given.text
    if "flow" in context:
        return _in_flow(given, begin, at)
    for start, end in _lines_before(text, at):
        line = text[start:end]
        key = start + len(line) - len(line.lstrip(" -"))
        close = end_of_head(text, key) if is_head(text[key:end]) else None
        if close is None:
            continue
        head = text[key:close]
        for sign in (": ", " #"):
            if sign in head:
                span = given.span(key, close)
                return _cut_head(f"'{sign}'", head, span, text[start:key].lstrip())
    return None


def _lines_before(text: str, at: int) -> list[tuple[int, int]]:
    """Return the line at an offset and the one before that has something in it."""
    start = max(text.rfind("\n", 0, at), text.rfind("\r", 0, at)) + 1
    end = len(text[:at]) + len(text[at:].split("\n", 1)[0])
    found = [(start, end)]
    above = len(text[:start].rstrip())
    if above:
        found.append((max(text.rfind("\n", 0, above), text.rfind("\r", 0, above)) + 1, above))
    return found


def _in_flow(given: GivenText, begin: int, at: int) -> Exception | None:
    """Explain a head in `{ }` at whose bracket YAML stops."""
    text = given.text
    key = max(text.rfind(sign, begin, at) for sign in ",{[") + 1
    key += len(text[key:at]) - len(text[key:at].lstrip())
    close = end_of_head(text, key) if is_head(text[key:at]) else None
    if close is None or close < at:
        return None
    return _of_flow(given.text[key:close], given.span(key, close))


def _of_flow(head: str, span: Span) -> YamaroError:
    sign = next((char for char in head if char in ",[]{}"), ":")
    return _cut_head(f"{sign} inside {{ }}", head, span)


def refuse_cut_head(key: ScalarNode) -> None:
    """Raise YamaroError for the beginning of a head which YAML cut at a comma or a comment."""
    if key.style != PLAIN or not is_head(key.text):
        return
    text = key.source.text
    close = end_of_head(text, key.start)
    if close is None or close <= key.end:
        return
    head, span = text[key.start : close], Span(key.source, key.start, close)
    behind = text[key.end : close]
    if behind.lstrip(" \t").startswith("#"):
        raise _cut_head("' #'", head, span)
    if "," in behind:
        raise _of_flow(head, span)
