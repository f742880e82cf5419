"""Where the expansion of a tag goes."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..xml.tree import Element, Node
    from .scope import Macros, Scope


class Site:
    """The inside of an element that is being built, and what names mean there.

    Attributes:
        out: its content so far.
        holder: takes the attributes and declarations of prefixes meant for the element.
        macros, scope: what names mean.
        is_last: whether nothing follows in the element.
    """

    __slots__ = ("holder", "is_last", "macros", "out", "scope")

    def __init__(self, out: list[Node], holder: Element, macros: Macros, scope: Scope) -> None:
        self.out = out
        self.holder = holder
        self.macros = macros
        self.scope = scope
        self.is_last = False
