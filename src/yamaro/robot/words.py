"""Lowers the words that a robot has beside `part`: which module knows which."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..xml.tree import Element, Node, RobotWord
    from .lowering import Lowering


def lower_word(lowering: Lowering, word: RobotWord, out: list[Node]) -> None:
    """Append what a word makes; record what is wrong, and go on."""
    match word.name:
        case "mirror":
            from .mirror import lower_mirror

            lower_mirror(lowering, word, out)
        case "attach":
            from .attach import lower_attach

            lower_attach(lowering, word, out)
        case "control":
            from .control import lower_control

            lower_control(lowering, word, out)
        case "naming":
            from .naming import lower_naming

            lower_naming(lowering, word, out)
        case _:
            from .sections import lower_section

            lower_section(lowering, word, out)


def finish_words(lowering: Lowering, robot: Element) -> None:
    """Work out what needs the whole robot, with the names in it resolved."""
    if lowering.pending:
        from .mirror import make_images

        make_images(lowering, robot)
    if lowering.controls:
        from .control import choose_members

        choose_members(lowering, robot.elements(), lowering.controls)
