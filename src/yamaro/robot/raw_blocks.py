"""Takes the XML that is for one output format out of a finished robot."""

from __future__ import annotations

from ..diagnostics import INHERITED
from ..xml.tree import Element, RawBlock
from .notes import RobotNote
from .rigid import name_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..diagnostics import Frame
    from ..xml.tree import Node

RAW = "raw-block"


def take_raw_blocks(robot: Element) -> tuple[Element, list[Element]]:
    """Return a robot without the blocks for one format, and a note for each of them.

    A note has the `format`, and the `link` or `joint` that the block is in; what it holds is XML of
    the format.
    """
    notes: list[Element] = []
    children: list[Node] = []
    for child in robot.children:
        if isinstance(child, RawBlock):
            notes.append(_note(child, {}, None))
        elif isinstance(child, Element) and child.name in ("link", "joint"):
            children.append(_without_blocks(child, notes))
        else:
            children.append(child)
    return robot.with_children(children), notes


def _without_blocks(owner: Element, notes: list[Element]) -> Element:
    """Return a link or joint without its blocks, of which notes are made."""
    blocks = [child for child in owner.children if isinstance(child, RawBlock)]
    if not blocks:
        return owner
    trace = None if owner.trace is INHERITED else owner.trace
    notes += [_note(block, {owner.name: name_of(owner)}, trace) for block in blocks]
    return owner.with_children(
        [child for child in owner.children if not isinstance(child, RawBlock)]
    )


def _note(block: RawBlock, home: dict[str, str], trace: Frame | None) -> RobotNote:
    own = trace if block.trace is INHERITED else block.trace
    return RobotNote(
        RAW, block.span, {"format": block.name, **home}, children=block.children, trace=own
    )
