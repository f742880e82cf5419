"""Lowers the words that a robot has beside `part`: which module knows which."""

from __future__ import annotations

from ..diagnostics import failure

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..xml.tree import Node, RobotWord
    from .lowering import Lowering


def lower_word(lowering: Lowering, word: RobotWord, out: list[Node]) -> None:
    """Append what a word makes; record what is wrong, and go on."""
    lowering.absorb(
        failure(
            "misplaced-statement",
            f"`{word.name}` is not known to this version",
            word.span,
            hint=f"write <{word.name}>: for an XML element of that name",
            trace=word.trace,
        )
    )
