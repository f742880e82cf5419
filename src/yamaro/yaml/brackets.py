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
