"""The folder that a server works in: which files in it a call may read and write."""

from __future__ import annotations

import os

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator


SOURCES = (".yaml", ".yml", ".xacro")
"""Endings of files that people write, which are replaced only by a format of that ending."""


class Refused(Exception):
    """A call asks for what it cannot have; the text says what, and what it can."""


class Folder:
    """A folder, outside of which nothing is read or written.

    Attributes:
        path: its path, absolute and without symbolic links.
    """

    __slots__ = ("path",)

    def __init__(self, path: str) -> None:
        self.path = os.path.realpath(path)

    def file(self, name: str) -> str:
        """Return a file of the folder, as a path from it.

        Raises:
            Refused: there is no such file, or it is elsewhere.
        """
        path = self._inside(name)
        if not os.path.isfile(path):
            raise Refused(f"there is no file '{name}' in the folder of this server")
        return self._from_here(path)

    def new_file(self, name: str, endings: tuple[str, ...] = ()) -> str:
        """Return where a file or, with a slash at the end, a folder is to be written.

        Args:
            name: its path from the folder.
            endings: those of the format that is written.

        Raises:
            Refused: that is elsewhere, is hidden, has links in it that lead out of the folder, or
                may be the source of a robot.
        """
        path = self._inside(name)
        if any(part.startswith(".") and part not in (".", "..") for part in _parts(name)):
            raise Refused(f"'{name}' is hidden: choose a name that does not begin with a dot")
        is_folder = name.endswith(("/", os.sep))
        if os.path.isdir(path) and not is_folder:
            raise Refused(f"'{name}' is a folder: choose another name, or '{name}/' to write in it")
        if name.endswith(SOURCES) and not name.endswith(endings) and os.path.isfile(path):
            raise Refused(f"'{name}' exists, and may be the source of a robot: choose another name")
        beside = path if is_folder else os.path.join(os.path.dirname(path), "assets")
        for each in _all_in(beside):
            if os.path.islink(each) and not self._has(os.path.realpath(each)):
                name = os.path.relpath(each, self.path)
                raise Refused(f"the link '{name}' leads out of the folder")
        return self._from_here(path) + ("/" if is_folder else "")

    def _inside(self, name: str) -> str:
        if "\0" in name:
            raise Refused("a name of a file has no zero byte in it")
        path = os.path.normpath(os.path.join(self.path, name))
        if not self._has(path) or not self._has(os.path.realpath(path)):
            raise Refused(
                f"'{name}' is outside of the folder of this server: give a path from that folder"
            )
        return path

    def _has(self, path: str) -> bool:
        return path == self.path or path.startswith(self.path.rstrip(os.sep) + os.sep)

    def _from_here(self, path: str) -> str:
        """Return a path as the command takes it for a file, whatever it begins with."""
        name = os.path.relpath(path, self.path)
        is_plain = "." in name and not name.startswith("-") and ":" not in name  # as no command is
        return name if is_plain else os.path.join(os.curdir, name)


def _parts(name: str) -> list[str]:
    return name.replace(os.sep, "/").split("/")


def _all_in(folder: str) -> Iterator[str]:
    """Yield a folder and all that is in it, without following links."""
    yield folder
    for root, folders, files in os.walk(folder):
        for name in (*folders, *files):
            yield os.path.join(root, name)
