"""The XML that a file holds for one output format, by what it belongs to."""

from __future__ import annotations

from ..diagnostics import INHERITED
from ..xml.tree import with_trace
from .output import LOST, Loss

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..model.extras import RawXml
    from ..model.robot import Robot
    from ..xml.tree import Element


class RawXmlOf:
    """The elements for a format.

    Attributes:
        robot: those for the robot as a whole.
    """

    __slots__ = ("_left", "robot")

    def __init__(self, robot: Robot, format: str) -> None:
        """Gather the elements for a format of a robot."""
        self._left: dict[tuple[str, str], list[RawXml]] = {}
        self.robot: list[Element] = []
        for raw in robot.raw(format):
            if raw.link is not None:
                self._left.setdefault(("link", raw.link), []).append(raw)
            elif raw.joint is not None:
                self._left.setdefault(("joint", raw.joint), []).append(raw)
            else:
                self.robot += _elements_of(raw)

    def in_link(self, name: str) -> list[Element]:
        """Return the elements for a link, once."""
        return self._taken("link", name)

    def in_joint(self, name: str) -> list[Element]:
        """Return the elements for a joint, once."""
        return self._taken("joint", name)

    def left(self) -> list[Loss]:
        """Return the losses of elements that were not taken: what they are in is not written."""
        return [
            Loss(LOST, "blocks in what is not an element", f"{kind} '{name}'", raw.span,
                 trace=raw.trace, hint="write the block in another link or joint")
            for (kind, name), found in self._left.items()
            for raw in found
        ]  # fmt: skip

    def _taken(self, kind: str, name: str) -> list[Element]:
        found = self._left.pop((kind, name), ())
        return [element for raw in found for element in _elements_of(raw)]


def _elements_of(raw: RawXml) -> list[Element]:
    """Return the elements of a block, each with the calls and includes that led to it."""
    return [
        with_trace(each, raw.trace) if each.trace is INHERITED else each for each in raw.elements
    ]


def settings_in(elements: list[Element]) -> tuple[dict[str, Element], list[Element]]:
    """Return the elements that are an attribute in a format without texts, and the others.

    An element with only a text in it, such as `<armature>0.01</armature>`, says the attribute
    `armature` of what it is in.
    """
    settings: dict[str, Element] = {}
    rest: list[Element] = []
    for element in elements:
        if element.text().strip() and not element.elements() and not element.attributes:
            settings[element.name] = element
        else:
            rest.append(element)
    return settings, rest
