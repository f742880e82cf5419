"""Notices when files change, by looking at them again and again.

Looking works wherever files can be read: in containers, on network drives, and with editors that
put a new file in the place of the old one, all of which leave gaps in what systems report by
themselves. A look at some dozen files takes a fraction of a millisecond.
"""

from __future__ import annotations

import os
import time

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    Stamp = tuple[int, int, int] | None

INTERVAL = 0.03
"""Seconds between two looks."""
SETTLING = 0.01
"""Seconds in which a changed file has to stay as it is before it is taken for written."""
MOST_SETTLING = 20
"""How many times to wait for that: a file that is written without end is read as it is."""
MOST_SURROUNDINGS = 500
"""Files and folders to look at around one that could not be built."""
SOURCE_ENDINGS = (".yaml", ".yml", ".urdf", ".xacro", ".xml", ".py", ".json", ".csv")


class FileWatch:
    """A set of files, and how each was when it was last looked at."""

    __slots__ = ("_stamps",)

    def __init__(self) -> None:
        """Begin without files."""
        self._stamps: dict[str, Stamp] = {}

    @property
    def paths(self) -> list[str]:
        """Return the files that are looked at."""
        return list(self._stamps)

    def follow(self, paths: Iterable[str], *, since: int) -> None:
        """Look at these files and no others from now on.

        Args:
            paths: absolute; those that are not there are waited for.
            since: when the work with the files was begun, in ns since the epoch. A file that is new
                here and was changed after that counts as changed: nobody knows which text was read.
        """
        stamps: dict[str, Stamp] = {}
        for path in paths:
            if path in self._stamps:
                stamps[path] = self._stamps[path]
                continue
            stamp = _stamp(path)
            is_older = stamp is None or stamp[0] < since
            stamps[path] = stamp if is_older else (0, 0, 0)
        self._stamps = stamps

    def changed(self) -> list[str]:
        """Return the files that are not as they were at the last look, once they hold still."""
        found = self._look()
        if found:
            for _ in range(MOST_SETTLING):
                time.sleep(SETTLING)
                more = self._look()
                if not more:
                    break
                found += more
        return list(dict.fromkeys(found))

    def _look(self) -> list[str]:
        found = []
        for path, before in self._stamps.items():
            now = _stamp(path)
            if now != before:
                self._stamps[path] = now
                found.append(path)
        return found


def surroundings(path: str) -> list[str]:
    """Return the folders around a main file, and the sources in them.

    When a build fails, nobody knows which file it wanted: one that is missing may appear in any of
    the folders, and the fault may be in a module that was never listed as read.
    """
    found: list[str] = []
    pending = [os.path.dirname(path)]
    while pending and len(found) < MOST_SURROUNDINGS:
        folder = pending.pop(0)
        found.append(folder)
        try:
            with os.scandir(folder) as entries:
                inner = sorted(entries, key=lambda entry: entry.name)
        except OSError:
            continue
        for entry in inner:
            if entry.name.startswith("."):
                continue
            if entry.name.endswith(SOURCE_ENDINGS):
                found.append(entry.path)
            elif _is_folder(entry):
                pending.append(entry.path)
    return found[:MOST_SURROUNDINGS]


def _is_folder(entry: os.DirEntry[str]) -> bool:
    try:
        return entry.is_dir(follow_symlinks=False)
    except OSError:
        return False


def _stamp(path: str) -> Stamp:
    """Return what changes when a file does: time, size, and which file it is."""
    try:
        status = os.stat(path)
    except (OSError, ValueError):
        return None
    return status.st_mtime_ns, status.st_size, status.st_ino
