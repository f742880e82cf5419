"""Text that a terminal shows and does not obey.

Files, their names and what programs print may hold characters that control a terminal (ESC, C0 and
C1 controls) or hide what a line says (bidirectional and invisible ones). All of them are escaped,
together with what Python does not count as printable.
"""

from __future__ import annotations

MAX_REMARK = 600
"""Characters of a message, hint or note to show."""

BOLD = "\033[1m"
DIM = "\033[2m"
CYAN = "\033[36m"
RED = "\033[1;31m"
YELLOW = "\033[1;33m"
BLUE = "\033[1;34m"
RESET = "\033[0m"
STYLES = (BOLD, DIM, CYAN, RED, YELLOW, BLUE, RESET)
"""All sequences that Yamaro itself sends to a terminal."""


def painted(text: str, style: str) -> str:
    """Return text in one of the styles."""
    return f"{style}{text}{RESET}"


def printable(text: str) -> str:
    """Return text in which all but printable characters, spaces and tabs are escaped."""
    if text.isascii() and text.isprintable():
        return text
    return "".join(c if c.isprintable() or c == "\t" else _escape(c) for c in text)


def shortened(text: str) -> str:
    """Return text as `printable` does; of one that quotes a long value, its ends."""
    if len(text) > MAX_REMARK:
        text = f"{text[: MAX_REMARK // 2]} … {text[-MAX_REMARK // 2 :]}"
    return printable(text)


def harmless(text: str, *, colored: bool = False) -> str:
    """Return lines of text as `printable` does each of them; `colored` lets the styles pass."""
    if colored and "\033" in text:
        head, *others = text.split("\033")
        return harmless(head) + "".join(map(_after_escape, others))
    return "\n".join(map(printable, text.split("\n")))


def harmless_xml(text: str) -> str:
    """Return XML in which what controls a terminal is written as character references."""
    return "\n".join(map(_harmless_xml_line, text.split("\n")))


def unobeyed(text: str, line: str = "") -> str:
    """Return lines of text in which nothing is a command to what runs jobs of CI.

    GitHub's runner obeys lines that begin with `::` after any space, and `##[` anywhere; others
    obey `##vso[` and `##teamcity[`. The last character of these is escaped.

    Args:
        text: the text.
        line: what is in its first line already.
    """
    both = line + text
    if "::" not in both and "##" not in both:
        return text
    import re

    pieces, at = [], len(line)
    for found in re.finditer(r"^[^\S\n]*::|##\w*\[", both, re.MULTILINE):
        last = found.end() - 1
        if last >= at:  # else it has been written, escaped
            pieces += [both[at:last], _escape(both[last])]
            at = last + 1
    return "".join(pieces) + both[at:]


def width(text: str) -> int:
    """Return how many terminal cells a printable text takes, a tab counted as one."""
    if text.isascii():
        return len(text)
    from unicodedata import combining, east_asian_width

    return sum(0 if combining(c) else 2 if east_asian_width(c) in "WF" else 1 for c in text)


def _escape(char: str) -> str:
    code = ord(char)
    if code < 0x100:
        return f"\\x{code:02x}"
    return f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"


def _after_escape(text: str) -> str:
    """Return the text after an ESC, with that ESC: as it is before one of our styles only."""
    for style in STYLES:
        if text.startswith(style[1:]):
            return style + harmless(text[len(style) - 1 :])
    return _escape("\033") + harmless(text)


def _harmless_xml_line(text: str) -> str:
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() or c == "\t" else f"&#x{ord(c):X};" for c in text)
