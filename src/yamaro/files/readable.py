"""What a file that is not trusted may read: its own folder, its packages, and what is allowed."""

from __future__ import annotations

import os

from .loader import LoadError
from .packages import PackageFinder, surroundings

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence


class Reach:
    """Folders and files that may be read, with all that lies in them.

    Attributes:
        roots: their paths, absolute and without symbolic links.
    """

    __slots__ = ("roots",)

    def __init__(self, roots: Sequence[str]) -> None:
        """Allow what lies in `roots`; a link counts as what it leads to."""
        self.roots = list(dict.fromkeys(os.path.realpath(root) for root in roots))

    def allows(self, path: str) -> bool:
        """Return whether a path, having followed its links, lies where files may be read."""
        real = os.path.realpath(path)
        return any(
            real == root or real.startswith(root.rstrip(os.sep) + os.sep) for root in self.roots
        )

    def check(self, path: str) -> None:
        """Raise LoadError if a path lies elsewhere."""
        if not self.allows(path):
            raise LoadError(
                "it is outside of the folders that this file may read",
                code="path-outside",
                hint="--allow-path FOLDER allows reading it; by default, a file "
                "may read its own folder and its packages",
            )

    def is_of(self, path: str, descriptor: int) -> bool:
        """Return whether an open file is what a path that is allowed leads to."""
        real = os.path.realpath(path)
        try:
            return self.allows(real) and os.path.samestat(os.stat(real), os.fstat(descriptor))
        except OSError:
            return False


def roots_of(path: str, allowed: Sequence[str], packages: PackageFinder) -> list[str]:
    """Return the folders that a main file may read.

    These are its own folder; where the environment says that packages are; the packages it lies in,
    and those beside them; its repository and the `src` folder of its workspace. A folder that holds
    the user's home is never one of them, whatever is in it: many keep settings in a repository.

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
    home = os.path.realpath(os.path.expanduser("~"))
    roots += [root for root in found if not Reach([root]).allows(home)]
    return roots
