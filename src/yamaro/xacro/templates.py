"""Text with `${…}` and `$(…)` in it: where each of them is, and what is in it.

A template is a row of parts: plain text, `Expression` and `Substitution`. Neither knows brackets or
quotes: the first `}` ends an expression, the first `)` a substitution. Both can contain
templates again, which are replaced before the rest is read. `$${` and `$$(` mean `${` and `$(`.
"""

from __future__ import annotations

import re

from .faults import Fault

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

_PART = re.compile(
    r"(?P<plain>[^$]+|\$(?:[^{($]+|\Z))"
    r"|\$(?P<escaped>\$+[{(])"
    r"|\$\{(?P<expression>[^}]*)\}"
    r"|\$\((?P<substitution>[^)]*)\)"
)


class Expression:
    """`${…}`: Python.

    Attributes:
        text: the text between the braces.
        inner: the same as a template, if there is a `$` in it.
        start, end: where in the template's text it is, with its braces.
    """

    __slots__ = ("end", "inner", "start", "text")

    def __init__(self, text: str, start: int, end: int) -> None:
        self.text = text
        self.start = start
        self.end = end
        self.inner = parse_template(text, start + 2) if "$" in text else None


class Substitution:
    """`$(…)`: a command, such as find or arg, and what it is given; slots as in Expression."""

    __slots__ = ("end", "inner", "start", "text")

    def __init__(self, text: str, start: int, end: int) -> None:
        self.text = text
        self.start = start
        self.end = end
        self.inner = parse_template(text, start + 2) if "$" in text else None


Part = str | Expression | Substitution


class Template:
    """A text, in parts.

    Attributes:
        text: as it is written.
        parts: never two plain texts in a row.
    """

    __slots__ = ("parts", "text")

    def __init__(self, text: str, parts: Sequence[Part]) -> None:
        self.text = text
        self.parts = tuple(parts)

    def plain(self) -> str | None:
        """Return the value of a template that depends on no names, or None."""
        if not self.parts:
            return ""
        first = self.parts[0]
        return first if len(self.parts) == 1 and isinstance(first, str) else None


def parse_template(text: str, offset: int = 0) -> Template:
    """Return a text in parts, whose positions are counted from `offset`.

    Raises:
        Fault: a `${` or `$(` does not end, or a `$` begins neither.
    """
    parts: list[Part] = []
    position, length = 0, len(text)
    while position < length:
        found = _PART.match(text, position)
        if found is None:
            raise _unreadable(text, position, offset)
        end = found.end()
        kind = found.lastgroup
        content = found[kind] if kind else ""
        if kind == "expression":
            parts.append(Expression(content, offset + position, offset + end))
        elif kind == "substitution":
            parts.append(Substitution(content, offset + position, offset + end))
        elif parts and isinstance(parts[-1], str):
            parts[-1] += content
        else:
            parts.append(content)
        position = end
    return Template(text, parts)


def _unreadable(text: str, position: int, offset: int) -> Fault:
    opener = text[position : position + 2]
    closer = {"${": "}", "$(": ")"}.get(opener)
    start = offset + position
    if closer is None:
        return Fault(
            "xacro-expression",
            "'$$' is allowed only before '{' and '('",
            "write $${ for the text ${, and a single $ for itself",
            start=start,
            end=start + 2,
        )
    return Fault(
        "xacro-expression",
        f"'{opener}' has no '{closer}'",
        f"write ${opener} if the text {opener} is meant",
        start=start,
        end=start + 2,
    )
