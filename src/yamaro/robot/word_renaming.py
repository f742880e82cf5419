"""Replaces whole words in names: `left_leg` becomes `right_leg`, `LeftLeg` becomes `RightLeg`."""

from __future__ import annotations


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
