"""Applies the safe fixes of several files, all or none of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from ..diagnostics import Diagnostic, YamaroError
from ..files.loader import FileLoader, LoadError, decode
from ..fixes import Edit
from ..policy import Limits

Check = Callable[[Mapping[str, str]], list[Diagnostic]]

MOST_ROUNDS = 50
"""Rounds of fixing and checking again: a fix may uncover what another one is for."""
_MARK = b"\xef\xbb\xbf"


class FixingFailed(Exception):
    """A fix did not remove what it is a fix of; the text says which."""


class Applied:
    """A fix that was applied.

    Attributes:
        place: where, as `name:line:column` in the text that it was applied to.
        title: what it does.
    """

    __slots__ = ("place", "title")

    def __init__(self, place: str, title: str) -> None:
        self.place = place
        self.title = title


class Fixing:
    """The texts of some files while their findings are fixed.

    Attributes:
        texts: the new texts of the files that were changed, by absolute paths.
        applied: the fixes, in the order in which they were applied.
    """

    def __init__(self, paths: Iterable[str], limits: Limits) -> None:
        """Allow changes of the files at some absolute paths."""
        self._paths = frozenset(paths)
        self._loader = FileLoader(limits)
        self._old: dict[str, bytes] = {}
        self.texts: dict[str, str] = {}
        self.applied: list[Applied] = []

    def run(self, check: Check) -> list[Diagnostic]:
        """Fix and check again until nothing is left that can be fixed; return what is found then.

        Args:
            check: gives all findings, with the given texts in place of those of their files.

        Raises:
            FixingFailed: a fix did not remove what it is for, or made a file no YAML.
        """
        found = check(self.texts)
        for _ in range(MOST_ROUNDS):
            chosen = self._choose(found)
            if not chosen:
                break
            edits: dict[str, list[Edit]] = {}
            for diagnostic in chosen:
                assert diagnostic.fix is not None, "only findings with fixes are chosen"
                self.applied.append(Applied(diagnostic.span.place(), diagnostic.fix.title))
                for edit in diagnostic.fix.edits:
                    edits.setdefault(edit.span.source.path, []).append(edit)
            for path, changes in edits.items():
                text = changes[0].span.source.text
                for edit in sorted(changes, key=lambda edit: edit.span.start, reverse=True):
                    text = text[: edit.span.start] + edit.text + text[edit.span.end :]
                self.texts[path] = text
            before, found = found, check(self.texts)
            # a fix has to remove its finding, and leave YAML
            for diagnostic in chosen:
                if _count(diagnostic, found) >= _count(diagnostic, before):
                    assert diagnostic.fix is not None
                    title = diagnostic.fix.title
                    raise FixingFailed(f"{diagnostic.span.place()}: '{title}' does not help")
            was_read = not any(each.code.startswith("yaml-") for each in before)
            if was_read and any(each.code.startswith("yaml-") for each in found):
                raise FixingFailed(f"{chosen[0].span.place()}: the result would not be YAML")
        return found

    def data(self) -> dict[str, bytes]:
        """Return what the changed files have to hold, by their paths."""
        return {
            path: (_MARK if self._old[path].startswith(_MARK) else b"") + text.encode()
            for path, text in self.texts.items()
        }

    def _choose(self, found: Iterable[Diagnostic]) -> list[Diagnostic]:
        """Return findings whose fixes are safe and do not touch each other, one for each place."""
        chosen: list[Diagnostic] = []
        taken: list[Edit] = []
        for diagnostic in found:
            fix = diagnostic.fix
            if fix is None or not fix.is_safe or not all(map(self._is_current, fix.edits)):
                continue
            if any(_touch(edit, other) for edit in fix.edits for other in taken):
                continue
            chosen.append(diagnostic)
            taken += fix.edits
        return chosen

    def _is_current(self, edit: Edit) -> bool:
        """Return whether an edit is of a file that may be changed, as it is now."""
        source = edit.span.source
        if source.path not in self._paths:
            return False
        return self.texts.get(source.path, self._text_of(source.path)) == source.text

    def _text_of(self, path: str) -> str | None:
        try:
            data = self._old.get(path) or self._loader.read(path)
            self._old[path] = data
            return decode(data, name=path, path=path).text
        except (LoadError, YamaroError):
            return None


def _touch(one: Edit, other: Edit) -> bool:
    if one.span.source.path != other.span.source.path:
        return False
    return one.span.start <= other.span.end and other.span.start <= one.span.end


def _count(diagnostic: Diagnostic, found: Iterable[Diagnostic]) -> int:
    kind = (diagnostic.code, diagnostic.message, diagnostic.span.source.path)
    return sum((each.code, each.message, each.span.source.path) == kind for each in found)
