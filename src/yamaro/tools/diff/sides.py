"""One side of a comparison: a robot out of a file, or out of a revision in git.

Git is only asked to list and to give what is stored. It runs no hook, no filter and no program that
the repository's configuration names, and writes nothing. A tree is written to a temporary folder,
where includes, packages and meshes are found as in a checkout.

To a diff driver, git gives seven words: the path, and for each side a file, the name of its content
and its mode. It does not say which revisions are compared, so that a side which is not a file of
the working tree is looked up by its content, to find the files that it includes.
"""

from __future__ import annotations

import os
import subprocess
import tempfile

from ...files.loader import LoadError
from ...files.packages import PackageFinder, surroundings
from ...files.regular import find_program, open_regular

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from typing import IO

    from ...diagnostics import Diagnostic, Frame
    from ...files.mesh_files import MeshFinder
    from ...model.robot import Robot
    from ...result import Build
    from ...source import Source, Span


# --- files out of git -------------------------------------------------------------------------


_SETTINGS = (
    "core.fsmonitor=false",
    f"core.hooksPath={os.devnull}",
    "core.sshCommand=false",
    "core.askPass=",
    "core.gitProxy=",
    "credential.helper=",
    "diff.external=",
    "gc.auto=0",
    "maintenance.auto=false",
    "protocol.allow=never",
    "safe.bareRepository=explicit",
)
"""What overrides the configuration of a repository, which may name programs to run."""
MOST_BYTES = 2 << 30
"""The bytes that the files of one revision may have."""
_FILE, _PROGRAM, _LINK = "100644", "100755", "120000"


class GitError(Exception):
    """Git cannot give what was asked for; the text says why."""


class Entry:
    """A file in a tree: its mode, the name of its content, and its path."""

    __slots__ = ("blob", "mode", "path", "size")

    def __init__(self, mode: str, blob: str, path: str, size: int) -> None:
        self.mode = mode
        self.blob = blob
        self.path = path
        self.size = size


class Repository:
    """The repository that a folder is in.

    Attributes:
        root: its working tree.
        inner: the path of the folder below the root, with "/" at its end; or "".
    """

    __slots__ = ("_folder", "inner", "root")

    def __init__(self, folder: str) -> None:
        """Find it; raise GitError if there is none."""
        self._folder = folder
        lines = _text(self.run("rev-parse", "--show-toplevel", "--show-prefix")).split("\n")
        self.root = os.path.abspath(lines[0])
        self.inner = lines[1] if len(lines) > 1 else ""

    def run(self, *words: str, data: bytes | None = None) -> bytes:
        """Return what git writes; raise GitError if it fails."""
        try:
            done = subprocess.run(
                _git(self._folder, *words),
                input=data,
                stdin=subprocess.DEVNULL if data is None else None,
                capture_output=True,
                check=False,
                env=_environment(),
            )
        except (OSError, ValueError) as error:
            raise GitError(f"git cannot be run: {error}") from None
        if done.returncode:
            lines = _text(done.stderr).strip().splitlines()
            raise GitError(lines[0] if lines else f"git {words[0]} failed")
        return done.stdout

    def tree_of(self, revision: str) -> str:
        """Return the name of the tree of a revision; "" for the index."""
        if not revision:
            return ""
        if revision.startswith("-"):
            raise GitError(f"'{revision}' is not a revision")
        try:
            found = self.run("rev-parse", "--verify", "--quiet", revision + "^{tree}")
        except GitError:
            raise GitError(f"git knows no revision '{revision}'") from None
        return _text(found).strip()

    def entries(self, tree: str) -> list[Entry]:
        """Return the files of a tree, or of the index for ""."""
        if tree:
            rows = self.run("ls-tree", "-r", "-z", "-l", "--full-tree", tree).split(b"\0")
        else:
            rows = self.run("ls-files", "-z", "--stage", "--full-name", self.root).split(b"\0")
        found = []
        for row in rows:
            head, tab, path = row.partition(b"\t")
            words = head.decode("ascii", "replace").split()
            if not tab or words[0] not in (_FILE, _PROGRAM, _LINK):
                continue  # another repository in this one
            if tree:
                size = int(words[3]) if words[3].isdigit() else 0
                found.append(Entry(words[0], words[2], os.fsdecode(path), size))
            elif words[2] == "0":  # not one side of a merge
                found.append(Entry(words[0], words[1], os.fsdecode(path), 0))
        return found

    def blob_at(self, revision: str, path: str) -> str | None:
        """Return the name of the content of a file at a revision, or None if it is not there."""
        try:
            found = self.run("rev-parse", "--verify", "--quiet", f"{revision}:{path}")
        except GitError:
            return None
        return _text(found).strip()

    def revision_with(self, path: str, blob: str) -> str | None:
        """Return a revision at which a file has some content: the newest one that is found.

        The index comes first, "", then HEAD and what led to it, and then all other branches.
        """
        for revision in ("", "HEAD"):
            if self.blob_at(revision, path) == blob:
                return revision
        for which in ("HEAD", "--all"):
            words = ("rev-list", "--max-count=500", which, "--", os.path.join(self.root, path))
            try:
                commits = _text(self.run(*words)).split()
            except GitError:
                continue
            for commit in commits:
                for revision in (f"{commit}^", commit):
                    if self.blob_at(revision, path) == blob:
                        return revision
        return None

    def write_tree(self, tree: str, folder: str) -> None:
        """Write the files of a tree to a folder, which looks like a repository then."""
        entries = self.entries(tree)
        size = sum(entry.size for entry in entries)
        if size > MOST_BYTES:
            raise GitError(
                f"the files of the revision have {size:,} bytes; the limit is {MOST_BYTES:,}"
            )
        os.mkdir(os.path.join(folder, ".git"))  # marks the root, as packages are found from it
        links: list[tuple[str, str]] = []
        with _Blobs(self._folder) as blobs:
            for entry in entries:
                path = _path_below(folder, entry.path)
                if path is None:
                    continue
                data = blobs.read(entry.blob)
                if entry.mode == _LINK:
                    links.append((os.fsdecode(data), path))
                    continue
                os.makedirs(os.path.dirname(path), exist_ok=True)
                with open(path, "xb") as file:
                    file.write(data)
        for target, path in links:  # last, so that nothing is written through one
            _make_link(target, path, folder)


def _git(folder: str, *words: str) -> list[str]:
    """Return a command of git; raise GitError if that is not installed."""
    program = find_program("git")
    if program is None:
        raise GitError("git is not installed")
    settings = [word for each in _SETTINGS for word in ("-c", each)]
    options = ("--no-pager", "--no-optional-locks", "--literal-pathspecs")
    return [program, "-C", folder, *options, *settings, *words]


def _environment() -> dict[str, str]:
    """Return variables with which git fetches nothing that is missing: that may start programs."""
    return {**os.environ, "GIT_ALLOW_PROTOCOL": "none", "GIT_NO_LAZY_FETCH": "1"}


class _Blobs:
    """Gives the content of files, from one process of git."""

    def __init__(self, folder: str) -> None:
        self._folder = folder
        self._process: subprocess.Popen[bytes] | None = None

    def __enter__(self) -> _Blobs:
        self._process = subprocess.Popen(
            _git(self._folder, "cat-file", "--batch"),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=_environment(),
        )
        return self

    def __exit__(self, *_: object) -> None:
        process = self._process
        assert process is not None
        for pipe in (process.stdin, process.stdout):
            assert pipe is not None
            pipe.close()
        process.wait()

    def read(self, blob: str) -> bytes:
        """Return the content of that name; raise GitError if it is not there."""
        assert self._process is not None
        ask: IO[bytes] | None = self._process.stdin
        answer: IO[bytes] | None = self._process.stdout
        assert ask is not None and answer is not None
        ask.write(blob.encode() + b"\n")
        ask.flush()
        words = answer.readline().split()
        if len(words) != 3:
            raise GitError(f"the repository has no content '{blob}'")
        size = int(words[2])
        data = answer.read(size)
        answer.read(1)
        if len(data) != size:
            raise GitError("git ended early")
        return data


def _path_below(folder: str, path: str) -> str | None:
    """Return the absolute path of a file in a folder, or None for one that leads out of it."""
    parts = path.split("/")
    if any(part in ("", ".", "..") or part.lower() == ".git" for part in parts):
        return None
    if os.sep != "/" and any(os.sep in part or ":" in part for part in parts):
        return None
    return os.path.join(folder, *parts)


def _make_link(target: str, path: str, folder: str) -> None:
    """Make a symbolic link, unless it leads out of the folder or cannot be made."""
    meant = os.path.normpath(os.path.join(os.path.dirname(path), target))
    root = folder.rstrip(os.sep) + os.sep
    if os.path.isabs(target) or not meant.startswith(root):
        return
    try:
        os.makedirs(os.path.dirname(path), exist_ok=True)
        os.symlink(target, path)
    except OSError:
        return


class Checkout:
    """The files of a revision in a temporary folder.

    Attributes:
        revision: as it was asked for; "" for the index.
        folder: where they are.
        repository: where they come from.
    """

    __slots__ = ("_temporary", "folder", "repository", "revision")

    def __init__(self, repository: Repository, revision: str) -> None:
        """Write them; raise GitError if git cannot give them."""
        self.repository = repository
        self.revision = revision
        tree = repository.tree_of(revision)
        self._temporary = tempfile.TemporaryDirectory(prefix="yamaro-")
        try:
            self.folder = os.path.realpath(self._temporary.name)
            repository.write_tree(tree, self.folder)
        except BaseException:
            self._temporary.cleanup()
            raise

    def path_of(self, path: str) -> str:
        """Return where a file of the revision is.

        Args:
            path: below the root of the repository, or if it begins with `./` or `../`, relative to
                the folder that the repository was found from; as git reads `REV:path`.

        Raises:
            GitError: there is no such file.
        """
        inner = path
        if path.startswith(("./", "../")):
            inner = os.path.normpath(os.path.join(self.repository.inner, path))
        found = _path_below(self.folder, inner.replace(os.sep, "/"))
        if found is not None and os.path.isfile(found):
            return found
        where = f"'{self.revision}'" if self.revision else "the index"
        message = f"there is no file '{inner}' in {where}"
        nearer = self.repository.inner + path
        if nearer != path and os.path.isfile(os.path.join(self.folder, nearer)):
            message += f"; for a path from this folder write '{self.revision}:./{path}'"
        raise GitError(message)

    def close(self) -> None:
        """Remove the folder."""
        self._temporary.cleanup()


def split_revision(word: str) -> tuple[str, str] | None:
    """Return revision and path of `REV:path`, or None for the name of a file."""
    revision, colon, path = word.partition(":")
    if not colon or not path or os.path.lexists(word):
        return None
    if os.name == "nt" and len(revision) == 1 and path[:1] in "\\/":
        return None
    return revision, path


def _text(data: bytes) -> str:
    return data.decode("utf-8", "surrogateescape")


# --- sides ------------------------------------------------------------------------------------


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
            found: dict[int, Frame] = {}
            pending = [diagnostic.trace]
            while pending:
                step = pending.pop()
                if step is not None and id(step) not in found:
                    found[id(step)] = step
                    pending += [step.parent, step.home]
            for step in found.values():
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

        span = self.robot.span
        if span.written() in ("mujoco", "model") and span.source.text[span.start - 1] == "<":
            return True
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


# --- a diff driver: what git calls in place of its own comparison of two files ----------------


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
