"""The section `naming`: what the joint and the link of a part are called in one file."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure
from ..xml.tree import Element, Text
from .fields import read_value, word_of
from .notes import RobotNote, check_keys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..source import Span
    from ..xml.tree import Node, RobotWord
    from .lowering import Lowering

PATTERNS = {"joint": "*_joint", "link": "*_link"}
"""The names by default; `*` is that of the part."""


class Naming:
    """How the names of the joints and links of a file are made of those of parts."""

    __slots__ = ("joints", "links")

    def __init__(self, joint: str, link: str) -> None:
        """Take two patterns, each with one `*`."""
        self.joints = joint
        self.links = link

    def joint(self, part: str) -> str:
        """Return the name of a part's joint."""
        return self.joints.replace("*", part)

    def link(self, part: str) -> str:
        """Return the name of a part's link."""
        return self.links.replace("*", part)


def note_naming(lowering: Lowering, word: RobotWord) -> None:
    """Note what a section says about the parts of the file that it is in; record what is wrong."""
    try:
        lowering.namings[word.span.source] = _read(word)
    except YamaroError as error:
        lowering.absorb(error)


def lower_naming(lowering: Lowering, word: RobotWord, out: list[Node]) -> None:
    """Append a note of the patterns, by which the finished robot knows joints by their parts."""
    naming = lowering.namings.get(word.span.source)
    if naming is not None:
        patterns: dict[str, object] = {"joints": naming.joints, "links": naming.links}
        out.append(RobotNote("naming", word.span, patterns, trace=word.trace))


def _read(word: RobotWord) -> Naming:
    check_keys(word, PATTERNS)
    for child in word.children:
        if isinstance(child, Text):
            raise _bad(f"'{word.text()}' does not say of what", child.span, word)
    patterns = dict(PATTERNS)
    for key in word.elements():
        value, span = read_value(key)
        pattern = patterns[key.name] = word_of(key.name, value, span, owner=key)
        if pattern.count("*") != 1 or len(pattern.split()) != 1:
            raise _bad(f"'{pattern}' does not contain one '*' for the part's name", span, word)
    return Naming(**patterns)


def _bad(message: str, span: Span, owner: Element) -> YamaroError:
    return failure(
        "bad-naming",
        message,
        span,
        hint='write naming: {joint: "*_joint", link: "*_link"}, which is the default',
        trace=owner.trace,
    )
