"""Which joint and link of a URDF make a part, and in what order all that it holds is written."""

from __future__ import annotations

from ...xml.tree import Comment, Element, Text
from ...xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from ...xml.tree import Node

    Endings = Mapping[int, str]
    Loose = Comment | Text


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
    items, loose = _items(nodes, endings)
    links = [item for item in items if item.element.name == "link"]
    joints = [item for item in items if item.element.name == "joint"]
    pairs = _pairs_in_order(links, joints)
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


def _items(nodes: list[Node], endings: Endings) -> tuple[list[Item], list[Loose]]:
    items: list[Item] = []
    above: list[Loose] = []
    for node in nodes:
        if not isinstance(node, Element):
            is_beside = items and endings.get(id(node)) == "following"
            (items[-1].beside if is_beside else above).append(node)
        else:
            items.append(Item(node, len(items), above))
            above = []
    return items, above


def _pairs_in_order(links: list[Item], joints: list[Item]) -> list[tuple[Item, Item]]:
    """Return the links with their joints, as many as can stand together with no order changed."""
    by_name: dict[str, int] = {}
    for index, link in enumerate(links):
        name = name_of(link.element)
        by_name[name] = -1 if name in by_name else index
    candidates: list[tuple[int, int]] = []
    taken: set[int] = set()
    for number, joint in enumerate(joints):
        index = by_name.get(child_of(joint.element) or "", -1)
        if index >= 0 and index not in taken:
            taken.add(index)
            candidates.append((index, number))
    return [(links[i], joints[j]) for i, j in _longest_rise(candidates)]


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
    """Return the name of a link or joint, empty if it has none."""
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
