"""`yamaro diff --git`: what git calls in place of its own comparison of two files.

Git gives seven words: the path, and for each side a file, the name of its content and its mode. It
does not say which revisions are compared, so that a side which is not a file of the working tree
is looked up by its content, to find the files that it includes.
"""

from __future__ import annotations

import os

from ...files.regular import open_regular
from .git import GitError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from .sides import Origin, Origins

NO_FILE = "/dev/null"
NINE = 9
"""How many words git gives for a file that was renamed; seven for others."""


class Called:
    """How git called.

    Attributes:
        path, new_path: of the file, in both revisions, below the root of the repository.
        files: where git has put its content; `NO_FILE` on a side that has none.
        blobs: the names of the contents; zeros for a file of the working tree.
    """

    __slots__ = ("blobs", "files", "new_path", "path")

    def __init__(self, words: Sequence[str]) -> None:
        """Take the seven or nine words apart."""
        self.path = words[0]
        self.new_path = words[7] if len(words) == NINE else words[0]
        self.files = (words[1], words[4])
        self.blobs = (words[2], words[5])

    @property
    def labels(self) -> tuple[str, str]:
        """Return what git calls both sides."""
        paths = (self.path, self.new_path)
        names = [
            file if file == NO_FILE else f"{letter}/{path}"
            for letter, path, file in zip("ab", paths, self.files, strict=True)
        ]
        return names[0], names[1]

    @property
    def is_of_both(self) -> bool:
        """Return whether both sides have the file."""
        return NO_FILE not in self.files

    def origin(self, index: int, origins: Origins) -> Origin:
        """Return where one side is read from; raise GitError if git cannot give its files."""
        from .sides import Origin

        repository = origins.repository()
        path = (self.path, self.new_path)[index]
        file, blob = self.files[index], self.blobs[index]
        here = os.path.join(repository.root, path)
        if not blob.strip("0") or os.path.abspath(file) == here:
            return Origin(os.path.relpath(here), self.labels[index])
        revision = repository.revision_with(path, blob)
        if revision is None:
            raise GitError(f"no revision has this version of '{path}'")
        found = origins.at_revision(revision, path)
        return Origin(found.path, self.labels[index], found.checkout)

    def plain(self) -> str:
        """Return the differences of the two texts, for files that are not robots."""
        from difflib import unified_diff

        old, new = self.labels
        head = f"diff --git a/{self.path} b/{self.new_path}\n"
        texts = [_lines(file) for file in self.files]
        if texts[0] is None or texts[1] is None:
            return f"{head}Binary files {old} and {new} differ\n"
        lines = unified_diff(texts[0], texts[1], old, new)
        body = (line if line.endswith("\n") else f"{line}\n" for line in lines)
        return head + "".join(body)


def _lines(path: str) -> list[str] | None:
    """Return the lines of a file, or None if it is not text."""
    if path == NO_FILE:
        return []
    try:
        with open_regular(path) as file:
            return file.read().decode().splitlines(keepends=True)
    except (OSError, UnicodeDecodeError):
        return None
