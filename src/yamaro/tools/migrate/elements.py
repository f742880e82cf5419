"""XML elements as entries of a body, each as plain XML."""

from __future__ import annotations

from textwrap import dedent

from ...syntax.names import STATEMENTS
from ...xmltree import Comment, Element, Text, format_value
from .compare import values_of
from .document import Body, Entry, element_key, words_of
from .pairing import has_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Container, Iterator

    from ...xmlreader import XmlDocument
    from ...xmltree import Node
    from .document import Value


MOST_TEXTS = 3
"""Elements that hold a text each and stand in one line."""


ROWS = frozenset(("xyz", "rpy", "rgba", "size", "scale"))
"""Attributes of URDF that hold several numbers."""


class ElementWriter:
    """Makes entries of elements; `names` has what stands for a mesh file's folder."""

    __slots__ = ("file_name",)

    def __init__(self, file_name: Callable[[str], str]) -> None:
        """Take what spells the names of mesh files."""
        self.file_name = file_name

    def entry(self, element: Element, *, bracketed: bool = False) -> Entry:
        """Return an element as it is, but for the space between numbers."""
        attributes = {name: tidy_value(name, value) for name, value in values_of(element).items()}
        bracketed = bracketed or needs_brackets(element.name, attributes)
        return Entry(self.key(element.name, attributes, bracketed=bracketed), self.value(element))

    def key(self, name: str, attributes: dict[str, str], *, bracketed: bool = False) -> str:
        """Return the key of an element."""
        if name == "mesh" and "filename" in attributes:
            attributes = {**attributes, "filename": self.file_name(attributes["filename"])}
        return element_key(name, attributes, bracketed=bracketed)

    def value(self, element: Element) -> Value:
        """Return what stands in an element."""
        if not has_text(element):
            return self.body(element.children)
        if all(isinstance(child, Text) for child in element.children):
            return tidy_text(element.text())
        return self.body(element.children)

    def body(self, nodes: list[Node]) -> Body | None:
        """Return elements, texts and comments as a body, None if there are none."""
        body = Body()
        for node in _texts_joined(nodes):
            if isinstance(node, Element):
                body.append(self.entry(node))
            else:
                add_loose(node, body)
        body.in_braces = is_short(body)
        return body or None


def _texts_joined(nodes: list[Node]) -> list[Node]:
    """Return the children of an element with one text where only comments parted several."""
    joined: list[Node] = []
    texts: list[Text] = []
    for node in [*nodes, None]:
        if isinstance(node, Text):
            texts.append(node)
            continue
        if texts and not isinstance(node, Comment):
            value = "".join(format_value(text.value) for text in texts)
            joined.append(Text(value, texts[0].span))
            texts = []
        if node is not None:
            joined.append(node)
    return joined


def tidy_value(name: str, text: str) -> str:
    """Return an attribute's numbers with one space between them, and any other text as it is."""
    if name in ROWS:
        return " ".join(words_of(text))
    words = text.split()
    return " ".join(words) if len(words) > 1 and all(map(_is_number, words)) else text


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def is_short(body: Body) -> bool:
    """Tell whether a body is read as easily in one line: some texts, or one thing only."""
    entries = body.entries
    if len(entries) == 1:
        return "," not in entries[0].key
    return len(entries) <= MOST_TEXTS and all(
        isinstance(entry.value, str) and "/" not in entry.key for entry in entries
    )


def walk(root: Element, without: Container[int] = ()) -> Iterator[Element]:
    """Return an element and all in it, but for elements of some identities."""
    pending = [root]
    while pending:
        element = pending.pop()
        yield element
        pending += [inner for inner in reversed(element.elements()) if id(inner) not in without]


def needs_brackets(name: str, attributes: dict[str, str]) -> bool:
    """Tell whether a key of a name would mean something else than an element."""
    return name in STATEMENTS or (name[0].isupper() and not attributes)


def spelled(element: Element, spell: Callable[[str], str]) -> Element:
    """Return a copy of an element, its values and texts as the language spells them."""
    copy = element.with_children(
        [
            spelled(child, spell)
            if isinstance(child, Element)
            else Text(spell(format_value(child.value)), child.span)
            if isinstance(child, Text)
            else child
            for child in element.children
        ]
    )
    copy.attributes = {name: spell(value) for name, value in values_of(element).items()}
    return copy


def add_loose(node: Comment | Text, body: Body) -> None:
    """Add a comment, or a text between elements if it is more than white space."""
    if isinstance(node, Comment):
        body.note(tidy_text(node.text))
    elif text := tidy_text(format_value(node.value)):
        body.add("<#text>", text)


def comments_above(document: XmlDocument) -> str:
    """Return what the comments above the root say, but for xacro's word that it made the file."""
    texts = [tidy_text(comment.text) for comment in document.before]
    kept = [text for text in texts if text.strip("=- ") and not any(w in text for w in _BANNER)]
    return "\n".join(kept)


_BANNER = ("This document was autogenerated by xacro", "EDITING THIS FILE BY HAND")


def tidy_text(text: str) -> str:
    """Return a text without the space around it and in front of its lines."""
    if not text.strip():
        return ""
    if "\n" not in text.strip():
        return " ".join(text.split()) if "\n" in text else text.strip()
    first, _, rest = text.expandtabs(4).partition("\n")
    lines = [first.strip(), *dedent(rest).split("\n")] if first.strip() else rest.split("\n")
    while not lines[0].strip():
        del lines[0]
    while not lines[-1].strip():
        del lines[-1]
    return "\n".join(line.rstrip() for line in dedent("\n".join(lines)).split("\n"))
