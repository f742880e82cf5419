"""From the links and joints of a model to the tree that URDF has: its roots, and what closes loops.

A joint leads from a parent to a child, and a link that is the child of several has one joint in the
tree. A joint whose child is reached already is turned around where its parent is not, and else
closes a loop.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .scopes import Anchor


class Edge:
    """A joint between two links.

    Attributes:
        joint: the joint.
        name: what it is called in the robot.
        parent, child: the links; None is the world.
        is_reversed: whether the tree leads from the child to the parent.
    """

    __slots__ = ("child", "is_reversed", "joint", "name", "parent")

    def __init__(self, joint: Anchor, name: str, parent: Anchor | None, child: Anchor) -> None:
        self.joint = joint
        self.name = name
        self.parent = parent
        self.child = child
        self.is_reversed = False

    @property
    def top(self) -> Anchor | None:
        """Return the link that the tree comes from; None is the world."""
        return self.child if self.is_reversed else self.parent

    @property
    def bottom(self) -> Anchor:
        """Return the link that the tree leads to."""
        if self.is_reversed:
            assert self.parent is not None, "the world is a root"
            return self.parent
        return self.child


class Tree:
    """The links of a model as trees.

    Attributes:
        edges: the joints of the trees, by the link that they lead to.
        loops: the joints that close loops.
        roots: the links that no joint leads to, each of a tree of its own.
    """

    __slots__ = ("edges", "loops", "roots")

    def __init__(self, links: list[Anchor], edges: list[Edge], first: Anchor | None) -> None:
        """Build the trees.

        Args:
            links: in the order of the document.
            edges: the joints, likewise.
            first: the link that is a root if it can be.
        """
        self.edges: dict[Anchor, Edge] = {}
        self.roots: list[Anchor] = []
        below: dict[Anchor | None, list[Edge]] = {}
        above: dict[Anchor, list[Edge]] = {}
        for edge in edges:
            below.setdefault(edge.parent, []).append(edge)
            above.setdefault(edge.child, []).append(edge)
        seen: set[Anchor | None] = set()
        used: set[Edge] = set()

        def take(edge: Edge, reached: list[Anchor | None]) -> None:
            self._take(edge, used)
            seen.add(edge.bottom)
            reached.append(edge.bottom)

        def grow(start: Anchor | None) -> None:
            """Take all that is reached: by each link's first joint, by others, and backwards."""
            seen.add(start)
            reached: list[Anchor | None] = [start]
            ahead = others = behind = 0  # how many of those reached were looked at, in each way
            while behind < len(reached):
                if ahead < len(reached):
                    for edge in below.get(reached[ahead], ()):
                        if edge.child not in seen and above[edge.child][0] is edge:
                            take(edge, reached)
                    ahead += 1
                elif others < len(reached):
                    for edge in below.get(reached[others], ()):
                        if edge.child not in seen:
                            take(edge, reached)
                    others += 1
                else:
                    link = reached[behind]
                    for edge in above.get(link, ()) if link is not None else ():
                        if edge not in used and edge.parent not in seen:
                            edge.is_reversed = True
                            take(edge, reached)
                    behind += 1

        if None in below:
            grow(None)
        free = [each for each in links if each not in above]
        for link in (*([first] if first in free else []), *free, *links):
            if link is not None and link not in seen:
                self.roots.append(link)
                grow(link)
        self.loops = [edge for edge in edges if edge not in used]

    def _take(self, edge: Edge, used: set[Edge]) -> None:
        used.add(edge)
        self.edges[edge.bottom] = edge
