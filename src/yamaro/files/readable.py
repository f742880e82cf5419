"""Permission to read, for untrusted files: their own folder, their packages, allowed paths."""

from __future__ import annotations

import os

from .installed import PACKAGE_FOLDERS, InstalledPackages
from .loader import LoadError
from .packages import PackageFinder, surroundings

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


class Reach:
    """Folders and files that may be read, with all that lies in them.

    Attributes:
        roots: their paths, absolute and without symbolic links.
        is_confined: whether this process is one that the kernel confines, which sees none of what
            Python packages bring.
        wanted: the names of packages that a confined process has asked for.
    """

    __slots__ = ("_installed", "_packages", "_within", "is_confined", "roots", "wanted")

    def __init__(self, roots: Sequence[str], within: Sequence[str] = ()) -> None:
        """Allow what lies in `roots`, and if `within` is given, also in one of these.

        A link counts as what it leads to.
        """
        self._within = [os.path.realpath(each) for each in within]
        self.roots: list[str] = []
        self.also_allow([os.path.realpath(root) for root in roots])
        self.is_confined = False
        self.wanted: list[str] = []
        self._installed: InstalledPackages | None = None
        self._packages: dict[str, str] = {}

    def package(self, name: str) -> str | None:
        """Return the folder of a package that a Python package brings, and allow to read it.

        A confined process cannot allow itself anything: it finds what was allowed before, and what
        it wants is noted, for the process that started it.
        """
        folder = self._packages.get(name)
        if folder is not None:
            return folder
        if self.is_confined:
            self.wanted.append(name)
            return None
        if self._installed is None:
            self._installed = InstalledPackages()
        folder = self._installed.folder(name)
        if folder is not None:
            self._packages[name] = folder
            if not _holds_home(folder):
                self.also_allow([os.path.realpath(folder)])
        return folder

    def has_new(self, names: Iterable[str]) -> bool:
        """Return whether packages that a confined process wants are there; they are allowed."""
        count = len(self._packages)
        for name in names:
            self.package(name)
        return len(self._packages) > count

    def also_allow(self, other: Sequence[str]) -> None:
        """Allow the folders and files of another reach, too."""
        if self._within:
            pairs = [(root, limit) for root in other for limit in self._within]
            other = [root for root, limit in pairs if _lies_in(root, limit)]
            other += [limit for root, limit in pairs if _lies_in(limit, root)]
        self.roots += [root for root in dict.fromkeys(other) if root not in self.roots]

    def allows(self, path: str) -> bool:
        """Return whether a path, having followed its links, lies where files may be read."""
        real = os.path.realpath(path)
        return any(_lies_in(real, root) for root in self.roots)

    def check(self, path: str) -> None:
        """Raise LoadError if a path lies elsewhere."""
        if not self.allows(path):
            usual = "by default, a file may read its own folder and its packages"
            bound = "--within allows reading nothing else outside of its folder"
            raise LoadError(
                "it is outside of the folders that this file may read",
                code="path-outside",
                hint=f"--allow-path FOLDER allows reading it; {bound if self._within else usual}",
            )

    def is_of(self, path: str, descriptor: int) -> bool:
        """Return whether an open file is what a path that is allowed leads to."""
        real = os.path.realpath(path)
        try:
            return self.allows(real) and os.path.samestat(os.stat(real), os.fstat(descriptor))
        except OSError:
            return False


def _lies_in(path: str, root: str) -> bool:
    """Return whether a path is a folder or lies in it; both without links."""
    return path == root or path.startswith(root.rstrip(os.sep) + os.sep)


def roots_of(path: str, allowed: Sequence[str], packages: PackageFinder) -> list[str]:
    """Return the folders that a main file may read.

    These are its own folder; where the environment says that packages are; the packages it lies in,
    and those beside them; the Python package that brings it; its repository and the `src` folder of
    its workspace. A folder that holds the user's home is never one of them, whatever is in it: many
    keep settings in a repository.

    Args:
        path: the main file, absolute.
        allowed: further files and folders.
        packages: knows the environment.
    """
    roots = [os.path.abspath(each) for each in allowed]
    found = packages.search_paths()
    for folder in dict.fromkeys((os.path.dirname(path), os.path.dirname(os.path.realpath(path)))):
        roots.append(folder)
        found += packages.around(folder)
        found += [root for root, depth in surroundings(folder) if depth > 1]
        found += _wheels_around(folder)
    return roots + [root for root in found if not _holds_home(root)]


def _wheels_around(folder: str) -> list[str]:
    """Return the folder of the installed Python package that a folder lies in, if any."""
    inner = folder
    while (outer := os.path.dirname(inner)) != inner:
        if os.path.basename(outer) in PACKAGE_FOLDERS:
            return [inner]
        inner = outer
    return []


def _holds_home(folder: str) -> bool:
    return Reach([folder]).allows(os.path.expanduser("~"))
