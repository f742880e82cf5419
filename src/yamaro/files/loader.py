"""Loaders: sources of the text of files, and the errors of reading it."""

from __future__ import annotations

import os

from ..diagnostics import failure
from ..policy import Limits
from ..source import Public, Source, Span
from .regular import open_regular

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Protocol

    from .readable import Reach

    class Loader(Protocol):
        """Gives the bytes of files; paths are absolute."""

        def read(self, path: str) -> bytes:
            """Return a file's content; raise LoadError if there is none."""

        def neighbours(self, path: str) -> list[str]:
            """Return the names of the files in the folder of `path`."""


class LoadError(Exception):
    """A file cannot be read; the text says why, without the path.

    Attributes:
        code: that of the diagnostic.
        hint: what to do about it, if that is known.
    """

    def __init__(self, reason: str, *, code: str = "missing-file", hint: str | None = None) -> None:
        """Hold what a diagnostic needs, except for the path and the place."""
        super().__init__(reason)
        self.code = code
        self.hint = hint


class FileLoader(Public):
    """Reads files from the disk.

    Attributes:
        limits: how large a file may be.
        reach: where files may lie; anywhere if it is None.
    """

    _internal = frozenset(("limits", "reach"))
    limits = Limits()  # for a subclass that does without our __init__
    reach: Reach | None = None

    def __init__(self, limits: Limits | None = None, reach: Reach | None = None) -> None:
        """Read files within the limits, by default those of trusted files, and the reach."""
        self.limits = limits or Limits()
        self.reach = reach

    def read(self, path: str) -> bytes:
        """Return a file's content; raise LoadError if there is none."""
        if self.reach is not None:
            self.reach.check(path)
        try:
            with open_regular(path) as file:
                if self.reach is not None and not self.reach.is_of(path, file.fileno()):
                    raise LoadError("it was replaced by another file meanwhile")
                data = file.read(self.limits.file + 1)  # it may grow while it is read
        except (OSError, ValueError) as error:
            hint = self._folder_installed(path) if isinstance(error, FileNotFoundError) else None
            raise LoadError(_reason(error), hint=hint) from None
        check_size(len(data), self.limits)
        return data

    def _folder_installed(self, path: str) -> str | None:
        """Return a hint if a folder of a package has a file that the package itself does not have.

        A build of ROS may install what is in `description/` right in the folder of the package.
        """
        if self.reach is not None and not self.reach.allows(path):
            return None
        package = os.path.dirname(path)
        while not os.path.isfile(os.path.join(package, "package.xml")):
            if os.path.dirname(package) == package:
                return None
            package = os.path.dirname(package)
        rest = os.path.relpath(path, package)
        for folder in sorted(self.neighbours(os.path.join(package, "package.xml"))):
            within = os.path.join(package, folder)
            found = os.path.join(within, rest)
            if (self.reach is None or self.reach.allows(found)) and os.path.isfile(found):
                from .packages import manifest_name

                name = manifest_name(package) or os.path.basename(package)
                return f"it is in '{folder}' of the package: give --package {name}:={within}"
        return None

    def neighbours(self, path: str) -> list[str]:
        """Return the names of the files in the folder of `path`."""
        if self.reach is not None and not self.reach.allows(path):
            return []
        try:
            return os.listdir(os.path.dirname(path))
        except OSError:
            return []


class OverlayLoader(FileLoader):
    """Reads some files from texts that are not on the disk, such as an editor's."""

    def __init__(self, texts: Mapping[str, str], loader: FileLoader) -> None:
        """Hold the texts that are open, by absolute paths; the rest as another loader reads it."""
        super().__init__(loader.limits, loader.reach)
        self.texts = texts

    def read(self, path: str) -> bytes:
        """Return a file's content; raise LoadError if there is none."""
        text = self.texts.get(path)
        if text is None:
            return super().read(path)
        if self.reach is not None:
            self.reach.check(path)
        data = text.encode("utf-8", "surrogatepass")
        check_size(len(data), self.limits)
        return data


def check_size(size: int, limits: Limits) -> None:
    """Raise LoadError if a file has too many bytes."""
    if size > limits.file:
        raise LoadError(
            f"it has more than {limits.file:,} bytes",
            code="limit-file",
            hint=limits.hint("file"),
        )


class MemoryLoader(Public):
    """Reads files from a mapping of absolute paths to texts; for tests and programs."""

    __slots__ = ("files",)
    _internal = frozenset(("files",))

    def __init__(self, files: Mapping[str, str]) -> None:
        self.files = dict(files)

    def __repr__(self) -> str:
        count = len(self.files)
        return f"<MemoryLoader of {count} file{'' if count == 1 else 's'}>"

    def read(self, path: str) -> bytes:
        """Return a file's content; raise LoadError if there is none."""
        if path not in self.files:
            raise LoadError("the file does not exist")
        return self.files[path].encode("utf-8", "surrogatepass")

    def neighbours(self, path: str) -> list[str]:
        """Return the names of the files in the folder of `path`."""
        folder = os.path.dirname(path)
        return [os.path.basename(own) for own in self.files if os.path.dirname(own) == folder]


def _reason(error: Exception) -> str:
    if isinstance(error, FileNotFoundError):
        return "the file does not exist"
    if isinstance(error, NotADirectoryError):
        return "a part of the path is not a folder"
    if isinstance(error, IsADirectoryError):
        return "it is a folder"
    if isinstance(error, PermissionError):
        return "reading it is not permitted"
    if isinstance(error, OSError) and error.strerror:
        return error.strerror.lower()
    return str(error)


def decode(data: bytes, *, name: str, path: str) -> Source:
    """Return the bytes of a file as a source.

    Raises:
        YamaroError: the text is not UTF-8.
    """
    for mark, encoding in ((b"\xff\xfe\0\0", "utf-32-le"), (b"\0\0\xfe\xff", "utf-32-be")):
        if data.startswith(mark):
            source = Source(data[4:].decode(encoding, "replace"), name=name, path=path)
            raise failure(
                "not-utf-8",
                "the file is in UTF-32",
                Span(source, 0, 1),
                hint="save it as UTF-8",
            )
    if data.startswith((b"\xff\xfe", b"\xfe\xff")) or b"\x00" in data[:2]:
        encoding = "utf-16-be" if data.startswith((b"\xfe\xff", b"\x00")) else "utf-16-le"
        source = Source(data.decode(encoding, "replace").lstrip("\ufeff"), name=name, path=path)
        raise failure(
            "not-utf-8",
            "the file is in UTF-16",
            Span(source, 0, 1),
            hint="save it as UTF-8",
        )
    data = data.removeprefix(b"\xef\xbb\xbf")
    try:
        return Source(data.decode(), name=name, path=path)
    except UnicodeDecodeError as error:
        before = data[: error.start].decode()
        source = Source(data.decode("utf-8", "replace"), name=name, path=path)
        guess = data[error.start : error.start + 1].decode("latin-1")
        raise failure(
            "not-utf-8",
            f"the byte 0x{data[error.start]:02X} is not UTF-8",
            Span(source, len(before), len(before) + 1),
            hint=f"save the file as UTF-8; in Latin-1 this byte is '{guess}'"
            if guess.isprintable()
            else "save the file as UTF-8",
        ) from None
