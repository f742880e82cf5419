"""Landlock, the part of the kernel that knows which files a process may touch."""

from __future__ import annotations

import ctypes
import os
import struct

from .calls import call, check, lift
from .protocol import JailUnavailable, covers

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

_CREATE_RULESET, _ADD_RULE, _RESTRICT_SELF = 444, 445, 446
_VERSION_QUESTION = 1
_PATH_BENEATH = 1
_READ_FILE = 1 << 2
_READ_DIR = 1 << 3
# How many kinds of access to files a version knows, which are numbered from 0: execute, write,
# read, list, remove, make, …; since version 2 moving to another folder, 3 truncating, 5 what
# devices do on ioctl, 9 connecting to sockets that have a path.
_FILE_ACCESSES = {1: 13, 2: 14, 3: 15, 5: 16, 9: 17}
_TCP = 0b11  # bind and connect, since version 4
_SCOPES = 0b11  # abstract sockets and signals, since version 6


class Ruleset:
    """A ruleset of Landlock: files below some paths may be read."""

    def __init__(self, readable: Sequence[str]) -> None:
        self._readable = readable
        self.descriptor = -1

    def __enter__(self) -> Ruleset:
        attributes = ruleset_attributes(version())
        buffer = ctypes.create_string_buffer(attributes, len(attributes))
        created = call(_CREATE_RULESET, ctypes.addressof(buffer), len(attributes))
        self.descriptor = lift(check(created, "Landlock"))
        try:
            for path in self._readable:
                self._allow(path)
        except BaseException:
            os.close(self.descriptor)
            raise
        return self

    def __exit__(self, *_: object) -> None:
        os.close(self.descriptor)

    def _allow(self, path: str) -> None:
        try:
            descriptor = os.open(path, os.O_PATH | os.O_CLOEXEC)
        except OSError:  # it does not exist, or we may not even look at it
            return
        try:
            real = os.readlink(f"/proc/self/fd/{descriptor}")
            # Landlock can allow a folder, but not all of it except one below.
            for pseudo in ("/proc", "/sys", "/dev"):
                if covers(real, pseudo) or covers(pseudo, real):
                    raise JailUnavailable(f"'{path}' may not be read in a jail: it opens {pseudo}")
            is_folder = (os.fstat(descriptor).st_mode & 0o170000) == 0o040000
            rights = _READ_FILE | _READ_DIR if is_folder else _READ_FILE
            rule = ctypes.create_string_buffer(struct.pack("=Qi", rights, descriptor), 12)
            check(
                call(
                    _ADD_RULE,
                    self.descriptor,
                    _PATH_BENEATH,
                    ctypes.addressof(rule),
                ),
                "a rule of Landlock's",
            )
        finally:
            os.close(descriptor)


def restrict(ruleset: int) -> None:  # pragma: no cover - in a child
    """Put this process under a ruleset for good."""
    check(call(_RESTRICT_SELF, ruleset), "Landlock")


def ruleset_attributes(version: int) -> bytes:
    """Return the struct that asks Landlock to deny all that its version can deny."""
    count = max(n for first, n in _FILE_ACCESSES.items() if first <= version)
    attributes = struct.pack("=Q", (1 << count) - 1)
    if version >= 4:
        attributes += struct.pack("=Q", _TCP)
    if version >= 6:
        attributes += struct.pack("=Q", _SCOPES)
    return attributes


def version() -> int:
    """Return the version of Landlock, from 1, or the negative number of an error."""
    found = call(_CREATE_RULESET, 0, 0, _VERSION_QUESTION)
    return found if found >= 0 else -ctypes.get_errno()
