"""The parameters of a macro, as its attribute `params` lists them.

A parameter is a name, `*name` for a block, `**name` for the content of a block; a default follows
`:=` or `=`. A default that begins with `^` is the caller's property of that name, and what comes
after `^|` is the default where there is none. It ends at white space, unless that is in quotes,
in `${…}` or `$(…)`.
"""

from __future__ import annotations

import re

_NAME = re.compile(r"\s*(?P<name>[^\s:=]+)\s*:?=(?P<space>\s*)")
_WORD = re.compile(r"\s*(?P<name>\S+)")
_PLAIN = re.compile(r"[^\s'\"]+")
_OUTER = re.compile(r"\^\|?")


class Parameter:
    """A parameter of a macro.

    Attributes:
        name: with the stars of a block.
        default: the template of its default value, or None.
        is_forwarded: whether the caller's property of the same name comes before the default.
        start, end: where in the list it is.
    """

    __slots__ = ("default", "end", "is_forwarded", "name", "start")

    def __init__(
        self, name: str, default: str | None, is_forwarded: bool, start: int, end: int
    ) -> None:
        self.name = name
        self.default = default
        self.is_forwarded = is_forwarded
        self.start = start
        self.end = end

    @property
    def is_block(self) -> bool:
        """Return whether it takes an element, not a value."""
        return self.name[0] == "*"


def parse_parameters(text: str) -> list[Parameter]:
    """Return the parameters that are listed in a text."""
    parameters = []
    position = 0
    while text[position:].strip():
        parameter = _with_default(text, position) or _without_default(text, position)
        parameters.append(parameter)
        position = parameter.end
    return parameters


def _without_default(text: str, position: int) -> Parameter:
    word = _WORD.match(text, position)
    assert word is not None  # there is more than space
    return Parameter(word["name"], None, False, word.start("name"), word.end())


def _with_default(text: str, position: int) -> Parameter | None:
    head = _NAME.match(text, position)
    if head is None:
        return None
    start, after = head.start("name"), head.end()
    outer = _OUTER.match(text, after)
    # '^|' may also be '^' and a default that begins with '|', or a default as it is.
    for taken in (outer.end(), outer.start() + 1, after) if outer else (after,):
        end = _default_end(text, taken)
        if end is None and _is_border(text, taken) and taken > after:
            end = taken
        if end is not None:
            return Parameter(head["name"], text[taken:end] or None, taken > after, start, end)
    if head["space"] or after == len(text):  # there is no default after all
        return Parameter(head["name"], None, False, start, head.start("space"))
    return None


def _is_border(text: str, position: int) -> bool:
    return position == len(text) or text[position].isspace()


def _default_end(text: str, start: int) -> int | None:
    """Return where a default that begins at `start` ends, or None if there is no default."""
    for opener, closer in (("${", "}"), ("$(", ")")):
        if text.startswith(opener, start):
            end = text.find(closer, start)
            while end >= 0:
                if _is_border(text, end + 1):
                    return end + 1
                end = text.find(closer, end + 1)
    if _is_border(text, start):
        return None
    return _word_end(text, start, set())


def _word_end(text: str, start: int, hopeless: set[int]) -> int | None:
    """Return where a word ends that may have quoted spaces, or None.

    A quote ends as early as the rest allows: what comes after it has to make up the word.
    """
    plain = _PLAIN.match(text, start)
    position = plain.end() if plain else start
    if _is_border(text, position):
        return position
    if position in hopeless:
        return None
    quote = text[position]
    closing = text.find(quote, position + 1)
    while closing >= 0:
        end = _word_end(text, closing + 1, hopeless)
        if end is not None:
            return end
        closing = text.find(quote, closing + 1)
    hopeless.add(position)
    return None
