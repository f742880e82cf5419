"""Names made of others: the section `naming`, and words replaced as in mirror images."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure
from ..xml.tree import Element, RobotNote, Text
from .fields import read_value, word_of
from .notes import check_keys

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
        lowering.namings[word.span.source] = Naming(**patterns)
    except YamaroError as error:
        lowering.absorb(error)


def lower_naming(lowering: Lowering, word: RobotWord, out: list[Node]) -> None:
    """Append a note of the patterns, by which the finished robot knows joints by their parts."""
    naming = lowering.namings.get(word.span.source)
    if naming is not None:
        patterns: dict[str, object] = {"joints": naming.joints, "links": naming.links}
        out.append(RobotNote("naming", word.span, patterns, trace=word.trace))


def _bad(message: str, span: Span, owner: Element) -> YamaroError:
    return failure(
        "bad-naming",
        message,
        span,
        hint='write naming: {joint: "*_joint", link: "*_link"}, which is the default',
        trace=owner.trace,
    )


# --- words replaced in names ------------------------------------------------------------------


class WordRenaming:
    """Words, each with the word that replaces it.

    A word counts where it is whole: between the ends of the name, anything that is not a letter,
    and the change from a small to a capital letter, as in `leftLeg`. Its case is kept, in the three
    ways in which names are spelled: `left`, `Left` and `LEFT`. One pass replaces all words, so
    `{left: right, right: left}` swaps them.
    """

    __slots__ = ("_spellings",)

    def __init__(self, words: dict[str, str]) -> None:
        """Take the words as they are given."""
        spellings: dict[str, str] = {}
        for change in (str, str.lower, str.upper, _capitalized):
            for old, new in words.items():
                spellings.setdefault(change(old), change(new))
        self._spellings = sorted(spellings.items(), key=lambda pair: -len(pair[0]))

    def apply(self, name: str) -> str:
        """Return a name with its words replaced."""
        pieces: list[str] = []
        at = 0
        while at < len(name):
            found = self._word_at(name, at)
            if found is None:
                pieces.append(name[at])
                at += 1
            else:
                old, new = found
                pieces.append(new)
                at += len(old)
        return "".join(pieces)

    def _word_at(self, name: str, at: int) -> tuple[str, str] | None:
        if at and name[at - 1].isalpha() and not (name[at - 1].islower() and name[at].isupper()):
            return None
        for old, new in self._spellings:
            end = at + len(old)
            if old and name.startswith(old, at) and _ends_word(name, end):
                return old, new
        return None


def _ends_word(name: str, end: int) -> bool:
    if end == len(name) or not name[end].isalpha():
        return True
    return name[end - 1].islower() and name[end].isupper()


def _capitalized(word: str) -> str:
    return word[:1].upper() + word[1:]
