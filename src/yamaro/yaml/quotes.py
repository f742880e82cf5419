"""What has to be quoted in YAML and is not: the errors for it, each with its fix."""

from __future__ import annotations

from ..diagnostics import failure
from ..fixes import replacement
from .nodes import quoted

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Protocol

    from ..fixes import Fix
    from ..source import Span

    class GivenText(Protocol):
        """What is being read: the text, and how its offsets map to the file."""

        text: str

        def span(self, start: int, end: int) -> Span:
            """Return the place of a stretch of the text."""


def line_around(text: str, at: int) -> tuple[int, int]:
    """Return start and end of the line that holds offset `at`."""
    start = max(text.rfind("\n", 0, at), text.rfind("\r", 0, at)) + 1
    ends = [end for end in (text.find("\n", at), text.find("\r", at)) if end >= 0]
    return start, min(ends) if ends else len(text)


def needs_quotes(given: GivenText, at: int) -> Exception:
    """Return the error for a key or value at `at` whose first character YAML reserves."""
    text = given.text
    char = text[at : at + 1]
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


def expression_in_brackets(given: GivenText, found: str, start: int, end: int) -> Exception:
    """Return the error for a `$(max(a, b))` in brackets whose commas separate items."""
    text, span = given.text, given.span(start, end)
    is_whole = text[:start].rstrip()[-1:] in ("[", "{", ",", ":")
    is_whole = is_whole and text[end:].lstrip()[:1] in ("]", "}", ",")
    return failure(
        "yaml-quote",
        f"an expression that contains {found} must be quoted inside {{ }} and [ ]",
        span,
        hint=f"write {quoted(text[start:end])}",
        fix=replacement(span, quoted(text[start:end]), is_safe=True) if is_whole else None,
    )


def colon_in_key(
    given: GivenText, problem: str, context: str, begin: int, at: int
) -> Exception | None:
    """Return the error for `item/a=$({'k': 1}['k']):`, where an expression in a key has a `: `."""
    start, end = line_around(given.text, at)
    line = given.text[start:end]
    before = line.partition(": ")[0]
    key = line.rpartition(":")[0]
    is_open = "$(" in before and before.count("(") > before.count(")")
    if not is_open or before == key or key.count("(") != key.count(")"):
        return None
    where = len(key) - len(key.lstrip(" -"))
    span = given.span(start + where, start + len(key))
    return failure(
        "yaml-quote",
        "a key that contains ': ' must be quoted",
        span,
        hint=f"write {quoted(key[where:])}:",
        fix=quoting(span, key[where:]),
    )


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
