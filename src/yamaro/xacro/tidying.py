"""Finishes an expansion: texts, comments and prefixes as they are when xacro writes them.

xacro puts each child on a line of its own. So space between elements counts for nothing, texts that
meet have space between them, and only a text that is the one child stays as it is. Comments right
above what is expanded go with it.
"""

from __future__ import annotations

from ..source import Span
from ..xml.reader import CData
from ..xml.tree import Comment, Element, Text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..xml.tree import Node
    from .expansion import Expansion


def tidy(root: Element) -> None:
    """Tidy the children of an element, and of all in it."""
    for element in root.iter():
        children = element.children
        if not children or (len(children) == 1 and type(children[0]) is Text):
            continue
        kept = element.children = []
        last: Node | None = None
        for child in children:
            if not isinstance(child, Text):
                kept.append(child)
            elif _is_space(child):
                continue
            else:
                value = str(child.value)
                if kept and isinstance(kept[-1], Text):
                    are_cdata = isinstance(child, CData) and isinstance(last, CData)
                    space = "" if are_cdata else "\n"
                    kept[-1] = Text(f"{kept[-1].value}{space}{value}", kept[-1].span)
                else:
                    kept.append(child if type(child) is Text else Text(value, child.span))
            last = child
        if not kept:
            there = [child for child in children if not is_gone(child)]
            element.children = there if len(there) == 1 and type(there[0]) is Text else []


def _is_space(text: Text) -> bool:
    value = str(text.value)
    return not isinstance(text, CData) and (not value or value.isspace())


# --- which comments xacro removes: those right above what is expanded -------------------------


class Mark(Text):
    """The space that an expanded tag leaves, as long as no other tag has left one since.

    Attributes:
        is_alive: whether it is still there.
    """

    __slots__ = ("is_alive",)

    def __init__(self, span: Span) -> None:
        super().__init__("\n\n", span)
        self.is_alive = True


class Comments:
    """Takes comments away, for one expansion."""

    __slots__ = ("_mark",)

    def __init__(self) -> None:
        self._mark: Mark | None = None

    def take_away(self, before: list[Node], span: Span, is_last: bool) -> Mark | None:
        """Take away the comments that belong to a tag, and return the mark it leaves, if any.

        Args:
            before: the nodes before the tag.
            span: the place of the tag.
            is_last: whether nothing follows in the element around.
        """
        index = _previous(before, len(before))
        while index >= 0:
            node = before[index]
            if isinstance(node, Text) and _is_margin(node):
                index = _previous(before, index)
            if index < 0 or not isinstance(before[index], Comment):
                return None if is_last else self._moved(span)
            del before[index]
            index = _previous(before, index)
        return None

    def _moved(self, span: Span) -> Mark:
        if self._mark is not None:
            self._mark.is_alive = False
        self._mark = Mark(span)
        return self._mark


def is_gone(node: Node) -> bool:
    """Return whether a node is a mark that has moved on."""
    return type(node) is Mark and not node.is_alive


def _previous(nodes: list[Node], index: int) -> int:
    index -= 1
    while index >= 0 and is_gone(nodes[index]):
        index -= 1
    return index


def _is_margin(text: Text) -> bool:
    value = str(text.value)
    return value.isspace() and value.count("\n") <= 1


# --- prefixes of XML that go to the element around --------------------------------------------


def lift_prefixes(expansion: Expansion, inner: Element, outer: Element) -> None:
    """Declare in one element what another declares, unless the prefix has another meaning."""
    for name, value in inner.attributes.items():
        if not name.startswith("xmlns:"):
            continue
        old = outer.attributes.get(name)
        if old is None or old == value:
            outer.attributes[name] = value
            continue
        expansion.reporter.report(
            "xacro-prefix",
            f"the prefix '{name[6:]}' means '{value}' here, and '{old}' around",
            inner.value_span(name),
            hint="declare it with the same address in all files",
            trace=expansion.frame,
        )


def declare_lost(root: Element, lost: dict[str, object]) -> None:
    """Declare prefixes at the root that are used in it, and declared nowhere around their use.

    A file that is included in a condition leads to that: xacro forgets what it declares.
    """
    pending = [(root, frozenset(root.attributes))]
    while pending:
        element, declared = pending.pop()
        for name in (element.name, *element.attributes):
            declaration = f"xmlns:{name.partition(':')[0]}"
            if ":" in name and declaration in lost and declaration not in declared:
                root.attributes.setdefault(declaration, lost[declaration])
        pending += [(own, declared.union(own.attributes)) for own in element.elements()]
