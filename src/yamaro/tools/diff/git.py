"""Reads files out of git: those of a revision, without touching the working tree.

Git is only asked to list and to give what is stored. It runs no hook, no filter and no program that
the repository's configuration names, and writes nothing. A tree is written to a temporary folder,
where includes, packages and meshes are found as in a checkout.
"""

from __future__ import annotations

import os
import subprocess
import tempfile

from ...files.regular import find_program

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import IO

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
