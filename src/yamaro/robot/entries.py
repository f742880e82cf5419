"""The entries of a section: each given once, and what their values may be."""

from __future__ import annotations

from ..diagnostics import failure
from ..xml.tree import Element, Text
from ..xml.values import format_value
from .fields import read_value, word_of
from .notes import check_keys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from ..source import Span
    from ..xml.tree import Node

TRUTHS = ("true", "false")
LIST_ITEM = "-"
"""The name of an item in a list that holds mappings or lists."""


def given_once(word: Element, known: Collection[str] | None = None) -> dict[str, Element]:
    """Return the entries of a word by name; one reached again, as by `if`, counts.

    Args:
        word: the word.
        known: the names of its entries; None if the caller looks whether they are known.

    Raises:
        YamaroError: one is unknown, or given twice in the same mapping.
    """
    if known is not None:
        check_keys(word, known)
    keys: dict[str, Element] = {}
    for key in word.elements():
        if key.name in keys and keys[key.name].body is key.body:
            raise failure(
                "given-twice",
                f"'{key.name}' is given twice in this `{word.name}`",
                key.span,
                hint="remove one of the two",
                notes=[f"first given at {keys[key.name].span.place()}"],
                trace=word.trace,
            )
        keys[key.name] = key
    return keys


def entries_of(owner: Element, example: str) -> list[Element]:
    """Return the entries of a mapping, a list of mappings, or of a dict that an expression gave.

    Raises:
        YamaroError: it is a text or a list of texts.
    """
    return _entries_in(owner, owner, example)


def _entries_in(body: Element, owner: Element, example: str) -> list[Element]:
    found: list[Element] = []
    for child in body.children:
        if isinstance(child, Text) and isinstance(child.value, dict):
            found += [_entry(name, value, child) for name, value in child.value.items()]
        elif not isinstance(child, Element):
            raise failure(
                "not-a-body",
                f"'{owner.name}' holds entries such as `name: value`",
                child.span,
                hint=f"write {example}",
                trace=owner.trace,
            )
        elif child.name == LIST_ITEM:
            found += _entries_in(child, owner, example)
        else:
            found.append(child)
    return found


def _entry(name: object, value: object, dictionary: Text) -> Element:
    """Return an entry of a dict as if it was written."""
    children: list[Node] = [] if value is None else [Text(value, dictionary.span)]
    return Element(format_value(name), dictionary.span, {}, children)


def text_of(key: Element | None) -> str:
    """Return the text of an entry, "" without one."""
    return "" if key is None else key.text().strip()


def place_of(key: Element) -> Span:
    """Return where the text of an entry is, or the entry if there is none."""
    return next((child.span for child in key.children if isinstance(child, Text)), key.span)


def one_of(key: Element, choices: Sequence[str]) -> str:
    """Return the one of some words that an entry says.

    Raises:
        YamaroError: it says something else.
    """
    value, span = read_value(key)
    return chosen(word_of(key.name, value, span, owner=key), span, key, choices)


def chosen(word: str, span: Span, key: Element, choices: Sequence[str]) -> str:
    """Return a word that an entry says.

    Raises:
        YamaroError: it is not one of the choices.
    """
    if word in choices:
        return word
    from ..suggestions import meant_word

    hint, fix = meant_word(word, choices, span)
    raise failure(
        "bad-choice",
        f"'{key.name}' is one of {', '.join(choices)}, and '{word}' is none of them",
        span,
        hint=hint or f"write {key.name}: {choices[0]}",
        trace=key.trace,
        fix=fix,
    )
