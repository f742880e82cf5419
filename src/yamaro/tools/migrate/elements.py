"""XML elements as entries of a source, and which joint and link of a URDF make a part."""

from __future__ import annotations

from textwrap import dedent

from ...model.values import values_of
from ...syntax.names import RAW_BLOCKS, ROBOT_STATEMENTS, STATEMENTS
from ...xml.tree import Comment, Element, Text
from ...xml.values import format_value
from .document import Body, Entry, element_key, joined, spaced, words_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from ...xml.reader import XmlDocument
    from ...xml.tree import Node
    from .document import Value

    Endings = Mapping[int, str]
    Loose = Comment | Text


# --- joints with their links, and in what order all that a robot holds is written -------------


class Item:
    """What becomes one entry of the model: an element, or a joint and its link.

    Attributes:
        element: the element, or the link of a part.
        joint: the joint whose child the link is, or None.
        is_joint_first: whether the joint stands before the link.
        above: the comments, and stray text, that stand above.
        beside: the comments at the ends of its lines.
    """

    __slots__ = ("above", "beside", "element", "is_joint_first", "joint", "position")

    def __init__(self, element: Element, position: int, above: list[Loose]) -> None:
        self.element = element
        self.position = position
        self.above = above
        self.beside: list[Loose] = []
        self.joint: Element | None = None
        self.is_joint_first = True


def pair(nodes: list[Node], endings: Endings) -> tuple[list[Item], list[Loose]]:
    """Return what is in a robot, joints together with their links, and the comments at its end.

    Of these, `endings` has those at the ends of lines.

    URDF gives the order of joints among links no meaning; links keep their order among themselves,
    and so do joints and all the rest. A pair that would change that is left as two elements.
    """
    items: list[Item] = []
    loose: list[Loose] = []  # what is above the next element, or at the end
    for node in nodes:
        if not isinstance(node, Element):
            is_beside = items and endings.get(id(node)) == "following"
            (items[-1].beside if is_beside else loose).append(node)
        else:
            items.append(Item(node, len(items), loose))
            loose = []
    links = [item for item in items if item.element.name == "link"]
    joints = [item for item in items if item.element.name == "joint"]
    # the links with their joints, as many as can stand together with no order changed
    by_name: dict[str, int] = {}
    for index, own in enumerate(links):
        name = name_of(own.element)
        by_name[name] = -1 if name in by_name else index
    candidates: list[tuple[int, int]] = []
    taken: set[int] = set()
    for number, each in enumerate(joints):
        index = by_name.get(child_of(each.element) or "", -1)
        if index >= 0 and index not in taken:
            taken.add(index)
            candidates.append((index, number))
    pairs = [(links[i], joints[j]) for i, j in _longest_rise(candidates)]
    for link, joint in pairs:
        link.joint = joint.element
        link.beside += joint.beside
        link.is_joint_first = joint.position < link.position
        if abs(joint.position - link.position) == 1:
            first, second = (joint, link) if link.is_joint_first else (link, joint)
            link.above = first.above + second.above
        else:
            link.is_joint_first = True
            link.above = link.above + joint.above
    return _ordered(items, {id(joint): link for link, joint in pairs}), loose


def _longest_rise(pairs: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """Return the longest subsequence whose first numbers rise (patience sorting, n log n)."""
    from bisect import bisect_left

    tails: list[int] = []  # the smallest end of a rise of each length
    ends: list[int] = []  # and which pair it is
    before: list[int] = []
    for number, (first, _) in enumerate(pairs):
        length = bisect_left(tails, first)
        before.append(ends[length - 1] if length else -1)
        tails[length : length + 1] = [first]
        ends[length : length + 1] = [number]
    rise = []
    at = ends[-1] if ends else -1
    while at >= 0:
        rise.append(pairs[at])
        at = before[at]
    return rise[::-1]


def _ordered(items: list[Item], parts: dict[int, Item]) -> list[Item]:
    """Return items in an order that keeps that of links, that of joints and that of the rest.

    Args:
        items: all, as they are in the file.
        parts: for a joint that is part of a pair, by identity, the item it went into.
    """
    from heapq import heappop, heappush

    followers: dict[int, list[Item]] = {id(item): [] for item in items}
    waiting: dict[int, int] = {id(item): 0 for item in items}
    last: dict[str, Item] = {}
    for item in items:
        name = item.element.name
        kind = name if name in ("link", "joint") else ""
        node = parts.get(id(item), item)
        if kind in last:
            followers[id(last[kind])].append(node)
            waiting[id(node)] += 1
        last[kind] = node
    ready: list[tuple[int, Item]] = []
    for item in items:
        if id(item) not in parts and not waiting[id(item)]:
            heappush(ready, (item.position, item))
    ordered: list[Item] = []
    while ready:
        item = heappop(ready)[1]
        ordered.append(item)
        for follower in followers[id(item)]:
            waiting[id(follower)] -= 1
            if not waiting[id(follower)]:
                heappush(ready, (follower.position, follower))
    return ordered


def name_of(element: Element) -> str:
    """Return the name that an element has as an attribute, empty if it has none."""
    return format_value(element.attributes.get("name", ""))


def is_bare(item: Item) -> bool:
    """Return whether an item is a link alone with nothing in it, which is not a part."""
    return item.joint is None and not item.element.elements()


def child_of(joint: Element) -> str | None:
    """Return the name of a joint's child link."""
    for child in joint.elements():
        if child.name == "child":
            return format_value(child.attributes.get("link", ""))
    return None


def has_text(element: Element) -> bool:
    """Return whether there is text in an element that is more than white space."""
    return any(isinstance(c, Text) and format_value(c.value).strip() for c in element.children)


# --- elements as plain XML, with their comments -----------------------------------------------


NO_ENDINGS: Endings = {}

MOST_TEXTS = 3
"""Elements that hold a text each and are in one line."""


FILES = frozenset(
    ("file", "filename", *(f"file{side}" for side in "back down front left right up".split()))
)
"""Attributes that name a file, relative to that in which they are."""
ROWS = frozenset(("xyz", "rpy", "rgba", "size", "scale"))
"""Attributes of URDF that hold several numbers."""


class ElementWriter:
    """Makes entries of elements; `file_name` replaces the folder of a mesh or texture."""

    __slots__ = ("file_name",)

    def __init__(self, file_name: Callable[[str], str]) -> None:
        """Take what spells the names of files."""
        self.file_name = file_name

    def entry(self, element: Element, *, bracketed: bool = False) -> Entry:
        """Return an element as it is, except for the space between numbers."""
        attributes = {name: tidy_value(name, value) for name, value in values_of(element).items()}
        bracketed = bracketed or needs_brackets(element.name, attributes)
        entry = Entry(self.key(element.name, attributes, bracketed=bracketed), self.value(element))
        if isinstance(entry.value, str):
            note_comments(element, entry)
        return entry

    def key(self, name: str, attributes: dict[str, str], *, bracketed: bool = False) -> str:
        """Return the key of an element."""
        for file in FILES & attributes.keys():
            attributes = {**attributes, file: self.file_name(attributes[file])}
        return element_key(name, attributes, bracketed=bracketed)

    def value(self, element: Element) -> Value:
        """Return what is in an element."""
        if not has_text(element):
            return self.body(element.children)
        if not element.elements():
            return tidy_text(element.text())
        return self.body(element.children)

    def body(self, nodes: list[Node]) -> Body | None:
        """Return elements, texts and comments as a body, None if there are none."""
        body = Body()
        endings = comments_at_ends(nodes)
        # the children of an element with one text where only comments parted several
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
        for node in joined:
            if isinstance(node, Element):
                body.append(self.entry(node))
            else:
                add_loose(node, body, endings)
        body.in_braces = is_short(body)
        return body or None


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
    """Return whether a body is read as easily in one line: some texts, or one thing only."""
    entries = body.entries
    if len(entries) == 1:
        return "," not in entries[0].key
    return len(entries) <= MOST_TEXTS and all(
        isinstance(entry.value, str) and "/" not in entry.key for entry in entries
    )


_WORDS = frozenset((*STATEMENTS, *ROBOT_STATEMENTS, *RAW_BLOCKS))


def needs_brackets(name: str, attributes: dict[str, str]) -> bool:
    """Return whether a key of a name would mean something else than an element."""
    return name in _WORDS or (name[0].isupper() and not attributes)


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


def add_loose(node: Comment | Text, body: Body, endings: Endings = NO_ENDINGS) -> None:
    """Add a comment, or a text between elements if it is more than white space.

    Args:
        node: to add.
        body: to which it is added.
        endings: the comments at the ends of lines.
    """
    if isinstance(node, Text):
        if text := tidy_text(format_value(node.value)):
            body.add("<#text>", text)
        return
    text = tidy_text(node.text)
    match endings.get(id(node)):
        case None:
            body.note(text)
        case "opening" if "\n" not in text:
            body.opening = spaced(body.opening, text)
        case _:
            body.note_end(text)


def comments_at_ends(nodes: Iterable[Node]) -> Endings:
    """Return, by identity, the comments at the ends of lines on which other things are.

    Each is `opening` if it follows the opening tag around the nodes, and else `following`.
    """
    found: dict[int, str] = {}
    pending: list[Comment] = []  # those after which the line may go on
    kind = "opening"  # what is on the line so far, or nothing
    for node in nodes:
        if isinstance(node, Element):
            kind, pending = "following", []
        elif isinstance(node, Comment):
            if kind:
                pending.append(node)
        else:
            before, end, _ = format_value(node.value).partition("\n")
            after = before if not end else format_value(node.value).rpartition("\n")[2]
            if end and not before.strip():
                found |= {id(comment): kind for comment in pending}
            if end or before.strip():
                kind, pending = "following" if after.strip() else "", []
    found |= {id(comment): kind for comment in pending if kind}
    return found


def note_comments(element: Element, entry: Entry) -> None:
    """Remark at an entry what comments in an element say that is put in other words."""
    endings = comments_at_ends(element.children)
    for child in element.children:
        if not isinstance(child, Comment):
            continue
        text = tidy_text(child.text)
        if id(child) in endings:
            entry.note_end(text)
        else:
            entry.comment = joined(entry.comment, text)


def comments_above(document: XmlDocument) -> str:
    """Return what the comments above the root say, except xacro's note that it made the file."""
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
