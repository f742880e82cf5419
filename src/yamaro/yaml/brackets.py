"""Finds where a `$(…)` ends, by Python's own rules for brackets and strings."""

from __future__ import annotations

_OPENING = {")": "(", "]": "[", "}": "{"}


def find_close(text: str, start: int) -> int:
    """Return the index of the parenthesis that closes one opened just before `start`, or -1.

    Follows Python's own rules: brackets nest, and strings and comments do not count.
    """
    stack = ["("]
    at = start
    length = len(text)
    while at < length:
        char = text[at]
        if char in "([{":
            stack.append(char)
        elif char in ")]}":
            if stack[-1] != _OPENING[char]:
                return -1
            stack.pop()
            if not stack:
                return at
        elif char in "'\"":
            at = end_of_string(text, at)
            if at < 0:
                return -1
            continue
        elif char == "#":
            at = text.find("\n", at)
            if at < 0:
                return -1
        at += 1
    return -1


def end_of_string(text: str, start: int) -> int:
    """Return the index behind a Python string literal that begins at `start`, or -1."""
    quote = text[start]
    if text.startswith(quote * 3, start):
        quote *= 3
    at = start + len(quote)
    while at < len(text):
        if text[at] == "\\":
            at += 2
        elif text.startswith(quote, at):
            return at + len(quote)
        elif text[at] == "\n" and len(quote) == 1:
            return -1
        else:
            at += 1
    return -1


def start_of_flow_value(text: str, begin: int, end: int) -> int:
    """Return where the value or key begins that goes on at `end`, in brackets opened at `begin`."""
    at = start = begin + 1
    while at < end:
        char = text[at]
        if text.startswith("$(", at):
            close = find_close(text, at + 2)
            at = close if close >= 0 else at + 1
        elif char in "'\"" and not text[start:at].strip():
            close = text.find(char, at + 1)
            at = close if 0 <= close < end else at
        elif char in ",[{" or (char == ":" and text[at + 1 : at + 2] in ("", " ", "\n")):
            start = at + 1
        at += 1
    return start + len(text[start:end]) - len(text[start:end].lstrip())


def end_of_flow_value(text: str, start: int) -> int:
    """Return where the value or key ends, in brackets, that goes on at `start`."""
    at = start
    while at < len(text):
        char = text[at]
        if text.startswith("$(", at):
            close = find_close(text, at + 2)
            at = close if close >= 0 else at + 1
        elif char in ",]}\n" or text.startswith((": ", " #"), at):
            break
        at += 1
    return start + len(text[start:at].rstrip())
