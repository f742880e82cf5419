"""Writes files in one step, so that they are seen either whole or as they were before."""

from __future__ import annotations

import os
import stat
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from types import FrameType
    from typing import Any

# Names that mean standard output. Opened as files they would lead to wherever descriptor 1 points
# by then, which is standard error during a build.
STANDARD_OUTPUT = frozenset(("-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"))


# --- files ------------------------------------------------------------------------------------


def write_file(path: str, chunks: Iterable[bytes]) -> None:
    """Write a file so that it is seen either whole or as it was before.

    The content goes to a temporary file in the same folder, which then takes the name of the
    target. A symbolic link stays, and its target is replaced; the mode of an old file is kept, and
    as far as the system allows its owner and extended attributes; folders on the way are made.
    What is not a regular file, such as a pipe or `/dev/null`, is written to directly.

    The temporary file is removed on any failure, an interrupt included, and in the main thread a
    termination signal. Nothing can do so after `kill -9` or a loss of power: a file named
    `.yamaro-….tmp` is left then. Later writes keep it, since it may be the file of
    another that writes at the same time, perhaps from another machine.

    Raises:
        OSError: with the reason; an old file is then unchanged.
    """
    old = _old(path)
    if old is not None and not stat.S_ISREG(old.st_mode):
        _write_directly(path, chunks)
        return
    target = os.path.realpath(path)
    temporary = _temporary(target)
    guard = _TerminationGuard(temporary)
    try:
        guard.set()
        _write_new(temporary, chunks, target, old)
        os.replace(temporary, target)
    except BaseException:
        _remove(temporary)
        raise
    finally:
        guard.reset()


def _old(path: str) -> os.stat_result | None:
    """Return what is in the place of a file to write, or None; its folder is made if there is none.

    Raises:
        OSError: it cannot be written.
    """
    if path.endswith((os.sep, os.altsep or os.sep)):
        raise IsADirectoryError(21, os.strerror(21), path)
    try:
        old = os.stat(path)
    except FileNotFoundError:
        os.makedirs(os.path.dirname(os.path.realpath(path)), exist_ok=True)
        return None
    if stat.S_ISDIR(old.st_mode):
        raise IsADirectoryError(21, os.strerror(21), path)
    if stat.S_ISREG(old.st_mode) and not os.access(path, os.W_OK):
        os.close(os.open(path, os.O_WRONLY))  # raises the reason
    return old


def write_files(files: Mapping[str, bytes]) -> None:
    """Write several files by their paths, as `write_file` does, none before all can be written.

    Then all of them are written, signals notwithstanding; only `kill -9` or a loss of power in
    between can leave some of them as they were.

    Raises:
        OSError: with the reason and the file; all files are then as they were, unless one could not
            take the place of the old one in the end.
    """
    staged: list[tuple[str, str]] = []
    direct: list[str] = []
    guard = _TerminationGuard()
    guard.set()
    try:
        for path, data in files.items():
            old = _old(path)
            if old is not None and not stat.S_ISREG(old.st_mode):
                direct.append(path)
                continue
            target = os.path.realpath(path)
            temporary = _temporary(target)
            guard.paths.append(temporary)
            staged.append((temporary, target))
            _write_new(temporary, [data], target, old)
        guard.hold()
        for temporary, target in staged:
            os.replace(temporary, target)
        guard.let_go()
        for path in direct:
            _write_directly(path, [files[path]])
    except BaseException:
        for temporary, _ in staged:
            _remove(temporary)
        raise
    finally:
        guard.let_go()
        guard.reset()


def write_folder(path: str, files: Mapping[str, bytes]) -> None:
    """Write a new folder with all files in it, so that it is seen whole or not at all.

    Args:
        path: the folder; those around it are made.
        files: the contents by the paths in the folder, which have `/`.

    Raises:
        OSError: with the reason, also if there is something at the path; nothing is left then.
    """
    path = os.path.abspath(path)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    temporary = _temporary(path)
    try:
        for inner, data in files.items():
            file = os.path.join(temporary, *inner.split("/"))
            os.makedirs(os.path.dirname(file), exist_ok=True)
            _write_new(file, [data], file, None)
        os.mkdir(path)  # fails if there is something; `rename` alone would replace an empty folder
        try:
            if os.name == "nt":
                os.rmdir(path)
            os.rename(temporary, path)
        except BaseException:
            if os.path.isdir(path):
                os.rmdir(path)
            raise
    except BaseException:
        from shutil import rmtree

        rmtree(temporary, ignore_errors=True)
        raise


def is_input(path: str, inputs: Iterable[str]) -> bool:
    """Return whether writing to `path` would overwrite one of the regular files `inputs`."""
    try:
        output = os.stat(path)
    except OSError:
        return False
    if not stat.S_ISREG(output.st_mode):
        return False
    for name in inputs:
        try:
            if os.path.samestat(output, os.stat(name)):
                return True
        except OSError:
            continue
    return False


def leads_out(path: str, folder: str) -> bool:
    """Return whether links on the way to a path in a folder lead out of that folder."""
    top = os.path.realpath(folder)
    try:
        return os.path.commonpath([top, os.path.realpath(path)]) != top
    except ValueError:  # another drive
        return True


def write_all(descriptor: int, chunks: Iterable[bytes]) -> None:
    """Write all chunks to a file descriptor; raise OSError if that cannot be done."""
    for chunk in chunks:
        rest = memoryview(chunk)
        while rest:
            try:
                count = os.write(descriptor, rest)
            except BlockingIOError:
                import select

                select.select([], [descriptor], [])
                continue
            if not count:  # rather than try forever
                raise OSError(5, os.strerror(5))
            rest = rest[count:]


def _write_directly(path: str, chunks: Iterable[bytes]) -> None:
    descriptor = os.open(path, os.O_WRONLY)
    try:
        write_all(descriptor, chunks)
    finally:
        os.close(descriptor)


def _temporary(target: str) -> str:
    return os.path.join(os.path.dirname(target), f".yamaro-{os.urandom(8).hex()}.tmp")


def _write_new(path: str, chunks: Iterable[bytes], target: str, old: os.stat_result | None) -> None:
    """Write a new file through to the disk, with what is known of the old one at `target`."""
    descriptor = os.open(
        path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o666
    )
    try:
        if old is not None and hasattr(os, "fchmod"):
            _keep_owner(descriptor, old)
            # File systems that have only one mode refuse to set any.
            mode = stat.S_IMODE(old.st_mode)
            if stat.S_IMODE(os.fstat(descriptor).st_mode) != mode:
                os.fchmod(descriptor, mode)
        write_all(descriptor, chunks)
        if old is not None:
            _keep_attributes(descriptor, target)
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _keep_owner(descriptor: int, old: os.stat_result) -> None:
    new = os.fstat(descriptor)
    if (new.st_uid, new.st_gid) != (old.st_uid, old.st_gid):
        try:
            os.fchown(descriptor, old.st_uid, old.st_gid)
        except OSError:
            return


def _keep_attributes(descriptor: int, target: str) -> None:
    """Copy the extended attributes, access lists among them, that may be read and set."""
    if sys.platform != "linux":
        return
    try:
        names = os.listxattr(target)
    except OSError:
        return
    for name in names:
        try:
            os.setxattr(descriptor, name, os.getxattr(target, name))
        except OSError:
            continue


def _remove(path: str) -> None:
    try:
        os.unlink(path)
    except OSError:
        return


class _TerminationGuard:
    """Removes files when a signal that ends the process arrives, and then lets it end.

    Attributes:
        paths: the files.
    """

    __slots__ = ("_arrived", "_interrupt", "_previous", "paths")

    def __init__(self, *paths: str) -> None:
        self.paths = list(paths)
        self._previous: list[int] = []
        self._arrived: list[int] | None = None
        self._interrupt: Any = None

    def set(self) -> None:
        """Take over the termination signals that nobody else treats."""
        # `signal` would import enum, a fifth of the start-up time.
        import _signal  # type: ignore[import-not-found]

        for name in ("SIGTERM", "SIGHUP"):
            number = getattr(_signal, name, None)
            if number is None or _signal.getsignal(number) != _signal.SIG_DFL:
                continue
            try:
                _signal.signal(number, self._end)
            except ValueError:  # not in the main thread
                return
            self._previous.append(number)

    def reset(self) -> None:
        """Give the signals back."""
        import _signal

        for number in self._previous:
            _signal.signal(number, _signal.SIG_DFL)
        self._previous.clear()

    def hold(self) -> None:
        """Let signals wait, Ctrl-C too, until `let_go`."""
        import _signal

        self._arrived = []
        try:
            self._interrupt = _signal.signal(_signal.SIGINT, self._end)
        except ValueError:  # not in the main thread
            return

    def let_go(self) -> None:
        """Let signals take effect, also those that have arrived meanwhile."""
        import _signal

        arrived, self._arrived = self._arrived or [], None
        if self._interrupt is not None:
            _signal.signal(_signal.SIGINT, self._interrupt)
            self._interrupt = None
        for number in arrived:
            os.kill(os.getpid(), number)

    def _end(self, number: int, frame: FrameType | None) -> None:
        if self._arrived is not None:
            self._arrived.append(number)
            return
        for path in self.paths:
            _remove(path)
        self.reset()
        os.kill(os.getpid(), number)
