"""One side of a comparison: a robot out of a file, or out of a revision in git."""

from __future__ import annotations

import os

from ...files.loader import LoadError
from ...files.packages import PackageFinder, surroundings
from ...files.regular import open_regular
from .git import Checkout, Repository

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ...diagnostics import Diagnostic, Frame
    from ...files.mesh_files import MeshFinder
    from ...model.robot import Robot
    from ...result import Build
    from ...source import Source, Span

LFS_POINTER = b"version https://git-lfs.github.com/spec/v1\n"
LFS_HASH = b"oid sha256:"
CHUNK = 1 << 20


class Origin:
    """Where a side is read from.

    Attributes:
        path: the main file as it is opened.
        label: what the side is called.
        checkout: the revision that it is of, or None for a file as it is.
        prefix: what the names of files of the revision begin with: `REV:`, or "".
    """

    __slots__ = ("checkout", "label", "path", "prefix")

    def __init__(
        self, path: str, label: str, checkout: Checkout | None = None, *, prefix: str = ""
    ) -> None:
        self.path = path
        self.label = label
        self.checkout = checkout
        self.prefix = prefix

    def packages(self, given: dict[str, str]) -> dict[str, str]:
        """Return the folders of packages that are not found around the file itself.

        A package of the revision goes before those that the environment names: they may be the
        same as they are now. One that is given on the command line goes before all.
        """
        if self.checkout is None:
            return given
        root, folder = self.checkout.repository.root, self.checkout.folder
        bare = PackageFinder({})
        outside = os.path.dirname(root)
        around: dict[str, str] = {}
        if surroundings(outside) or os.path.isfile(os.path.join(root, "package.xml")):
            finder = PackageFinder({})
            for name in finder.names(root):
                found = finder.find(name, root)
                if found is not None and not _is_in(found, root):
                    around[name] = found
        own = {name: bare.find(name, folder) for name in bare.names(folder)}
        return {**around, **{name: path for name, path in own.items() if path}, **given}

    def name_of(self, span: Span) -> str:
        """Return what to call the file that a place is in."""
        return self.name_of_source(span.source)

    def name_of_source(self, source: Source) -> str:
        """Return what to call a file: `REV:path` if it is one of the revision."""
        checkout = self.checkout
        if checkout is None or not _is_in(source.path, checkout.folder):
            return source.name
        inner = os.path.relpath(source.path, checkout.folder).replace(os.sep, "/")
        return self.prefix + inner

    def plain_name_of(self, span: Span) -> str | None:
        """Return the path of a file of the revision, without the revision; None for others."""
        name = self.name_of(span)
        return None if name == span.source.name else name.removeprefix(self.prefix)

    @property
    def main(self) -> str:
        """Return what `plain_name_of`, or the name, is for the main file."""
        if self.checkout is None:
            return self.path
        return os.path.relpath(self.path, self.checkout.folder).replace(os.sep, "/")

    def relabel(self, diagnostics: Iterable[Diagnostic]) -> None:
        """Name the files of the revision in messages as they are called in git."""
        if self.checkout is None:
            return
        inside = self.checkout.folder + os.sep
        for diagnostic in diagnostics:
            sources = [diagnostic.span.source]
            for step in _steps(diagnostic.trace):
                sources.append(step.span.source)
                step.name = step.name.replace(inside, self.prefix)
            for source in sources:
                source.name = self.name_of_source(source).replace(inside, self.prefix)
            diagnostic.message = diagnostic.message.replace(inside, self.prefix)
            diagnostic.notes = tuple(note.replace(inside, self.prefix) for note in diagnostic.notes)
            if diagnostic.hint:
                diagnostic.hint = diagnostic.hint.replace(inside, self.prefix)


class Side:
    """A robot with its files.

    Attributes:
        origin: where it is read from.
        build: what was built.
    """

    __slots__ = ("_hashes", "_robot", "build", "origin")

    def __init__(self, origin: Origin, build: Build, *, robot: Robot) -> None:
        self.origin = origin
        self.build = build
        self._robot = robot
        self._hashes: dict[str, str | None] = {}

    @property
    def robot(self) -> Robot:
        """Return the robot."""
        return self._robot

    @property
    def has_extras(self) -> bool:
        """Return whether the file can hold what URDF has no elements for, such as sensors."""
        from ...source import holds_xml

        path = self.build.files[0] if self.build.files else self.origin.path
        return not (holds_xml(path, "") or self.robot.span.source.is_xml)

    def file(self, filename: str, span: Span) -> str | None:
        """Return the path of a mesh or texture, or None if it is not there."""
        finder: MeshFinder = self.build.finder
        return finder.reachable(filename, span)

    def hash(self, path: str) -> str | None:
        """Return the SHA-256 of a file, None if it cannot be read.

        Of a pointer of Git LFS it is that of the file it points to.
        """
        if path not in self._hashes:
            self._hashes[path] = _hash_of(path)
        return self._hashes[path]


def same_file(
    sides: tuple[Side, Side], filename: str, span: Span, new_name: str, new_span: Span
) -> bool | None:
    """Return whether two files that meshes or textures name have the same content.

    None if one of them is not there.
    """
    first, second = sides
    one, other = first.file(filename, span), second.file(new_name, new_span)
    if one is None or other is None:
        return None
    if one == other:
        return True
    hashes = (first.hash(one), second.hash(other))
    return None if None in hashes else hashes[0] == hashes[1]


class Origins:
    """Finds files, also in git, and removes in the end what was written for that."""

    __slots__ = ("_checkouts", "_folder", "_repository")

    def __init__(self, folder: str) -> None:
        """Look for repositories from a folder."""
        self._folder = folder
        self._repository: Repository | None = None
        self._checkouts: dict[str, Checkout] = {}

    def __enter__(self) -> Origins:
        return self

    def __exit__(self, *_: object) -> None:
        for checkout in self._checkouts.values():
            checkout.close()

    def repository(self) -> Repository:
        """Return the repository of the folder; raise GitError if there is none."""
        if self._repository is None:
            self._repository = Repository(self._folder)
        return self._repository

    def at_revision(self, revision: str, path: str) -> Origin:
        """Return a file of a revision.

        Raises:
            GitError: there is no such file or revision.
        """
        checkout = self._checkouts.get(revision)
        if checkout is None:
            checkout = self._checkouts[revision] = Checkout(self.repository(), revision)
        found = checkout.path_of(path)
        return Origin(found, f"{revision}:{path}", checkout, prefix=f"{revision}:")


def _steps(trace: Frame | None) -> Iterable[Frame]:
    """Return the calls and includes that led to a place, and to the files that these are in."""
    found: dict[int, Frame] = {}
    pending = [trace]
    while pending:
        step = pending.pop()
        if step is not None and id(step) not in found:
            found[id(step)] = step
            pending += [step.parent, step.home]
    return found.values()


def _is_in(path: str, folder: str) -> bool:
    return path.startswith(folder.rstrip(os.sep) + os.sep)


def _hash_of(path: str) -> str | None:
    from hashlib import sha256

    digest = sha256()
    try:
        with open_regular(path) as file:
            data = file.read(CHUNK)
            if data.startswith(LFS_POINTER):
                for line in data.splitlines():
                    if line.startswith(LFS_HASH):
                        return line[len(LFS_HASH) :].decode("ascii", "replace")
            while data:
                digest.update(data)
                data = file.read(CHUNK)
    except (OSError, ValueError, LoadError):
        return None
    return digest.hexdigest()
