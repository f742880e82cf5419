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
    from typing import Any

_FLAGS = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
_TYPE = 0o170000
_FOLDER = 0o040000
_REGULAR = 0o100000
_DEVICES = (0o020000, 0o060000)
_OTHER = "it is not a regular file"


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


def read_start(path: str, most: int) -> bytes:
    """Return the first bytes of a regular file, at most `most`; see `open_regular` for errors."""
    with open_regular(path) as file:
        return file.read(most)


def _is_device(path: str) -> bool:
    try:
        return os.stat(path).st_mode & _TYPE in _DEVICES
    except OSError:  # opening it says why
        return False
