"""Opens files with untrusted names: regular files only, and never one that blocks.

A name may lead to a FIFO that nobody writes to, or to a device whose mere opening has effects. So
each is looked at before it is opened, and again afterwards.
"""

from __future__ import annotations

import errno
import os
from io import BufferedReader, FileIO

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any

_FLAGS = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
_TYPE = 0o170000
_FOLDER = 0o040000
_REGULAR = 0o100000
_PIPE = 0o010000
_DEVICES = (0o020000, 0o060000)
_OTHER = "it is not a regular file"
UNOPENED = errno.ENXIO
"""The number of the error for a named pipe that nothing writes to."""
PATIENCE = 2.0
"""Seconds to wait for a program to open a named pipe, such as one that was just started."""
_STEP = 0.02
MADE = os.path.join(os.path.abspath(os.sep), "made by yamaro")
"""The folder of files that are only in memory; see `made.py`."""


class _Unblocked(FileIO):
    """A file that is not waited for: some of the system's look regular, as /proc/kmsg does."""

    def readall(self) -> bytes:
        """Return all that is left."""
        data: bytes | None = super().readall()
        if data is None:
            raise OSError(errno.EINVAL, _OTHER)
        return data

    def readinto(self, buffer: Any, /) -> int:
        """Read into a buffer."""
        count: int | None = super().readinto(buffer)
        if count is None:
            raise OSError(errno.EINVAL, _OTHER)
        return count


def open_regular(path: str) -> BufferedReader:
    """Open a regular file for reading its bytes.

    Raises:
        OSError: it cannot be opened, or is not a regular file; `strerror` says what it is.
        ValueError: the path holds a null character.
    """
    if path.startswith(MADE):
        from io import BytesIO

        from .made import content_of

        return BufferedReader(BytesIO(content_of(path)))
    if _is_device(path):
        raise OSError(errno.EINVAL, _OTHER)
    descriptor = os.open(path, _FLAGS)
    try:
        kind = os.fstat(descriptor).st_mode & _TYPE
        if kind == _FOLDER:
            raise IsADirectoryError(errno.EISDIR, "it is a folder")
        if kind != _REGULAR:
            raise OSError(errno.EINVAL, _OTHER)
        return BufferedReader(_Unblocked(descriptor, "rb"))
    except BaseException:
        os.close(descriptor)
        raise


def read_pipe(path: str, most: int, seconds: float | None) -> bytes | None:
    """Return what is written to a named pipe, or None for what is not a pipe.

    A pipe that nothing writes to is not waited for, as it may lie in a folder from anywhere.

    Args:
        path: the pipe; or what a shell hands over for `<(command)`.
        most: the bytes after which reading ends.
        seconds: how long a program that has opened it may take, by default any time.

    Raises:
        TimeoutError: it takes longer.
        OSError: it cannot be read, or nothing has opened it to write to it.
    """
    if os.name == "nt" or os.stat(path).st_mode & _TYPE != _PIPE:
        return None
    descriptor = os.open(path, _FLAGS)
    try:
        if os.fstat(descriptor).st_mode & _TYPE != _PIPE:
            raise OSError(errno.EINVAL, _OTHER)
        return read_within(descriptor, most, seconds, patience=PATIENCE)
    finally:
        os.close(descriptor)


def read_within(
    descriptor: int, most: int, seconds: float | None, *, patience: float = 0.0
) -> bytes:
    """Return the bytes of a descriptor up to its end, at most `most`, within some seconds.

    `patience` is how long a pipe is waited for that nothing has opened to write to it.

    Raises:
        TimeoutError: it takes longer.
        OSError: it cannot be read, or nothing has opened it.
    """
    import select
    from time import monotonic

    start = monotonic()
    poll = select.poll()
    poll.register(descriptor, select.POLLIN)
    found = bytearray()
    is_opened = not patience
    while len(found) < most:
        left = None if seconds is None else start + seconds - monotonic()
        if left is not None and left <= 0:
            raise TimeoutError
        wait = left if is_opened else _STEP
        events = poll.poll(None if wait is None else wait * 1000)
        if not events and is_opened:
            continue
        try:
            data = os.read(descriptor, min(1 << 20, most - len(found)))
        except BlockingIOError:  # it is open, and nothing has been written yet
            is_opened = True
            continue
        if data:
            found += data
            is_opened = True
        elif is_opened or events:
            break
        elif monotonic() - start > patience:
            raise OSError(UNOPENED, "it is a named pipe that nothing writes to")
    return bytes(found)


def read_start(path: str, most: int) -> bytes:
    """Return the first bytes of a regular file, at most `most`; see `open_regular` for errors."""
    with open_regular(path) as file:
        return file.read(most)


def _is_device(path: str) -> bool:
    try:
        return os.stat(path).st_mode & _TYPE in _DEVICES
    except OSError:  # opening it says why
        return False


# --- files below a folder ---------------------------------------------------------------------


ROBOT_ENDINGS = (".urdf.yaml", ".urdf.yml", ".yamaro.yaml", ".yamaro.yml")
"""How the names of files end that are for Yamaro; other YAML files may be for anything."""
SKIPPED_FOLDERS = frozenset(("build", "install", "log", "node_modules", "__pycache__"))
"""Folders of what is built or installed. Hidden ones are skipped as well."""


def files_below(folder: str, endings: tuple[str, ...]) -> Iterator[str]:
    """Yield the files in a folder and below with these endings, in the order of their names."""
    for inner, folders, names in os.walk(folder):
        folders[:] = sorted(
            name for name in folders if name[0] != "." and name not in SKIPPED_FOLDERS
        )
        for name in sorted(names):
            path = os.path.normpath(os.path.join(inner, name))
            if name.endswith(endings) and os.path.isfile(path):  # no pipe, socket or device
                yield path


# --- programs, which are never looked for in the working directory ----------------------------


def find_program(name: str, path: str | None = None) -> str | None:
    """Return the path of a program, or None if there is none.

    Args:
        name: what it is called; a name with a folder is returned as it is.
        path: the folders to search, by default those of PATH; relative ones are passed over.
    """
    if os.path.dirname(name):
        return name
    endings = [""]
    if os.name == "nt":
        known = os.environ.get("PATHEXT", ".COM;.EXE;.BAT;.CMD").lower().split(os.pathsep)
        endings = endings if os.path.splitext(name)[1].lower() in known else known
    for folder in (os.environ.get("PATH", "") if path is None else path).split(os.pathsep):
        for ending in endings if os.path.isabs(folder) else ():
            found = os.path.join(folder, name + ending)
            if os.path.isfile(found) and os.access(found, os.X_OK):
                return found
    return None
