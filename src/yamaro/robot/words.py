"""Lowers the words that a robot has beside `part`: which module knows which."""

from __future__ import annotations

from ..diagnostics import failure

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..xml.tree import Element, Node, RobotWord
    from .lowering import Lowering


def lower_word(lowering: Lowering, word: RobotWord, out: list[Node]) -> None:
    """Append what a word makes; record what is wrong, and go on."""
    if word.name == "mirror":
        from .mirror import lower_mirror

        lower_mirror(lowering, word, out)
        return
    if word.name == "attach":
        from .attach import lower_attach

        lower_attach(lowering, word, out)
        return
    lowering.absorb(
        failure(
            "misplaced-statement",
            f"`{word.name}` is not known to this version",
            word.span,
            hint=f"write <{word.name}>: for an XML element of that name",
            trace=word.trace,
        )
    )


def finish_words(lowering: Lowering, robot: Element) -> None:
    """Work out what needs the whole robot, with the names in it resolved."""
    if lowering.pending:
        from .mirror import make_images

        make_images(lowering, robot)
