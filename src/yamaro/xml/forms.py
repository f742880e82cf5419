"""Elements of fixed shape: a form with holes, in place of values that are not known yet."""

from __future__ import annotations

from .values import format_number, format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ..source import Span
    from .tree import Node

FormText = str | int | tuple[str | int, ...]
"""A text as it is written, the number of the hole whose value it is, or pieces to be joined."""

Piece = tuple["Node | None", "Form | None", int, int, FormText, "Any"]
"""A piece of a form's content: a node as it is; an inner form, with where its holes begin and end
among those of the whole; or a text with its span."""


class Form:
    """The shape of one element or part.

    Attributes:
        name: the element's name, or "part".
        span: the place of its key.
        verbatim: whether it is written in angle brackets.
        body: identity of the mapping that its key is in.
        attributes: the name and the text of each attribute.
        value_spans: where the attributes' values are written.
        content: what it holds.
        text: the text that is all there is in it, with its span; None if there is more, or else.
    """

    __slots__ = (
        "attributes",
        "body",
        "content",
        "name",
        "span",
        "text",
        "value_spans",
        "verbatim",
    )

    def __init__(self, name: str, span: Span, *, body: object, verbatim: bool = False) -> None:
        """Begin with nothing in it; see the class."""
        self.name = name
        self.span = span
        self.verbatim = verbatim
        self.body = body
        self.attributes: list[tuple[str, FormText]] = []
        self.value_spans: dict[str, Span] = {}
        self.content: list[Piece] = []
        self.text: tuple[FormText, Span] | None = None


def filled(text: FormText, values: tuple[Any, ...]) -> Any:
    """Return the value of a text: of its one expression, or its pieces joined."""
    kind = type(text)
    if kind is str:
        return text
    if kind is int:
        return values[text]  # type: ignore[index]
    words = []
    for piece in text:  # type: ignore[union-attr]
        if type(piece) is str:
            words.append(piece)
            continue
        value = values[piece]  # type: ignore[index]
        kind = type(value)
        if kind is str:
            words.append(value)
        elif kind is float:
            words.append(format_number(value))
        else:
            words.append("None" if value is None else format_value(value))
    return "".join(words)


_PLAIN = frozenset((str, int, float, bool, type(None)))
"""Types of values that are equal for good once they are equal."""


def key_of(values: tuple[Any, ...]) -> object:
    """Return a key that distinguishes values by all that is visible of them, or None.

    In Python 1, 1.0 and True are equal, and so are 0.0 and -0.0.
    """
    if len(values) == 1:
        value = values[0]
        kind = type(value)
        if kind is str:
            return value
        if kind not in _PLAIN:
            return None
        return (value, kind) if value else (kind, str(value))
    kinds = tuple(map(type, values))
    if not _PLAIN.issuperset(kinds):
        return None
    if 0.0 in values:
        zeros = [str(value) for value in values if type(value) is float and not value]
        if zeros:
            return values, kinds, tuple(zeros)
    return values, kinds
