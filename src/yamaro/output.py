"""Writes what the command makes: files replaced in one step, and standard output kept for XML."""

from __future__ import annotations

import os
import stat
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable
    from types import FrameType
    from typing import TextIO

# Names that mean standard output. Opened as files they would lead to wherever descriptor 1 points
# by then, which is standard error during a build.
STANDARD_OUTPUT = frozenset(("-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"))


# --- files ------------------------------------------------------------------------------------


def write_file(path: str, chunks: Iterable[bytes]) -> None:
    """Write a file so that it is seen either whole or as it was before.

    The content goes to a temporary file in the same folder, which then takes the name of the
    target. A symbolic link stays, and its target is replaced; the mode of an old file is kept;
    folders on the way are made. What is no regular file, such as a pipe or `/dev/null`, is
    written to directly.

    The temporary file is removed on any failure, an interrupt included, and in the main thread a
    termination signal. Nothing can do so after `kill -9` or a loss of power: a file named
    `.yamaro-….tmp` is left then. Later writes let it be, since nothing tells it from the file of
    another that writes at the same time, perhaps from another machine.

    Raises:
        OSError: with the reason; an old file is then unchanged.
    """
    if path.endswith((os.sep, os.altsep or os.sep)):
        raise IsADirectoryError(21, os.strerror(21), path)
    try:
        old = os.stat(path)
    except FileNotFoundError:
        old = None
    if old is not None and not stat.S_ISREG(old.st_mode):
        _write_directly(path, chunks)
        return
    if old is not None and not os.access(path, os.W_OK):
        os.close(os.open(path, os.O_WRONLY))  # raises the reason
    target = os.path.realpath(path)
    folder = os.path.dirname(target)
    if old is None:
        os.makedirs(folder, exist_ok=True)
    _replace(target, chunks, old)


def is_input(path: str, inputs: Iterable[str]) -> bool:
    """Tell whether writing to `path` would overwrite one of the regular files `inputs`."""
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


def write_all(descriptor: int, chunks: Iterable[bytes]) -> None:
    """Write all chunks to a file descriptor; raise OSError if that cannot be done."""
    for chunk in chunks:
        _write_chunk(descriptor, chunk)


def _write_chunk(descriptor: int, chunk: bytes) -> None:
    rest = memoryview(chunk)
    while rest:
        try:
            count = os.write(descriptor, rest)
        except BlockingIOError:
            import select

            select.select([], [descriptor], [])
            continue
        if not count:  # rather than try for ever
            raise OSError(5, os.strerror(5))
        rest = rest[count:]


def _write_directly(path: str, chunks: Iterable[bytes]) -> None:
    descriptor = os.open(path, os.O_WRONLY)
    try:
        write_all(descriptor, chunks)
    finally:
        os.close(descriptor)


def _replace(target: str, chunks: Iterable[bytes], old: os.stat_result | None) -> None:
    """Write `target` by way of a temporary file that is gone afterwards, come what may."""
    temporary = os.path.join(os.path.dirname(target), f".yamaro-{os.urandom(8).hex()}.tmp")
    guard = _TerminationGuard(temporary)
    try:
        guard.set()
        _write_new(temporary, chunks, old)
        os.replace(temporary, target)
    except BaseException:
        _remove(temporary)
        raise
    finally:
        guard.reset()


def _write_new(path: str, chunks: Iterable[bytes], old: os.stat_result | None) -> None:
    """Write a new file through to the disk, with the mode and, if allowed, the owner of `old`."""
    descriptor = os.open(
        path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o666
    )
    try:
        if old is not None and hasattr(os, "fchmod"):
            _keep_owner(descriptor, old)
            _keep_mode(descriptor, old)
        write_all(descriptor, chunks)
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


def _keep_mode(descriptor: int, old: os.stat_result) -> None:
    """Set the mode, unless it is right: file systems that have but one refuse to set any."""
    mode = stat.S_IMODE(old.st_mode)
    if stat.S_IMODE(os.fstat(descriptor).st_mode) != mode:
        os.fchmod(descriptor, mode)


def _remove(path: str) -> None:
    try:
        os.unlink(path)
    except OSError:
        return


class _TerminationGuard:
    """Removes a file when a signal that ends the process arrives, and then lets it end."""

    __slots__ = ("_path", "_previous")

    def __init__(self, path: str) -> None:
        self._path = path
        self._previous: list[int] = []

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

    def _end(self, number: int, frame: FrameType | None) -> None:
        _remove(self._path)
        self.reset()
        os.kill(os.getpid(), number)


# --- standard streams -------------------------------------------------------------------------


class Streams:
    """Standard output, for the result alone, and standard error, for all that is said.

    While it is set up, what other code prints goes to standard error; in a quiet run it goes
    nowhere. This class works on `sys.stdout` and `sys.stderr`, for callers inside Python.

    Attributes:
        kept: what has to live as long as the streams do.
    """

    __slots__ = ("_err", "_null", "_out", "kept", "quiet")

    owns_process = False
    """Whether the process is there for this command alone."""

    def __init__(self, *, quiet: bool) -> None:
        """Remember the streams as they are now."""
        self.quiet = quiet
        self._out: TextIO | None = sys.stdout
        self._err: TextIO | None = sys.stderr
        self._null: TextIO | None = None
        self.kept: list[object] = []

    def divert(self) -> None:
        """Send what other code prints from now on away from standard output."""
        if self.quiet:
            self._null = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115
            sys.stdout = sys.stderr = self._null
        elif self._err is not None:
            sys.stdout = self._err

    def restore(self) -> None:
        """Undo `divert`."""
        if self._null is not None:
            self._null.close()
            self._null = None
        sys.stdout, sys.stderr = self._out, self._err

    def write_result(self, chunks: Iterable[bytes]) -> None:
        """Write to standard output; raise OSError if that cannot be done."""
        if self._out is None:
            raise OSError(9, os.strerror(9))
        self._out.flush()
        buffer = getattr(self._out, "buffer", None)
        if buffer is None:
            self._out.write(b"".join(chunks).decode("utf-8", "surrogateescape"))
        else:
            for chunk in chunks:
                buffer.write(chunk)
            buffer.flush()
        self._out.flush()

    def say(self, text: str) -> None:
        """Write text and a line break to standard error, if anyone can still hear it."""
        if self._err is None:
            return
        try:
            self._err.write(_encodable(text, self._err) + "\n")
            self._err.flush()
        except (OSError, ValueError):
            return

    def is_terminal(self, *, result: bool = False) -> bool:
        """Tell whether standard error, or standard output for `result`, is a terminal."""
        stream = self._out if result else self._err
        try:
            return stream is not None and stream.isatty()
        except ValueError:
            return False

    def result_encoding(self) -> str:
        """Return the encoding of standard output."""
        return getattr(self._out, "encoding", None) or "utf-8"


class ProcessStreams(Streams):
    """The streams of the command's own process, kept apart at the level of file descriptors.

    So that nothing that user code does, be it `os.system("echo")` or a C library that prints, can
    get between the lines of the XML. They stay diverted until the process ends: what is printed
    at exit must not land behind the XML either.
    """

    __slots__ = ("_err_fd", "_out_fd")

    owns_process = True

    def __init__(self, *, quiet: bool) -> None:
        """Duplicate the descriptors; the duplicates are not inherited by child processes."""
        super().__init__(quiet=quiet)
        # What refers to itself is freed by the collector alone, and so, once it is frozen, by the
        # end of the process: taking a big tree apart would be a tenth of the time of a build.
        self.kept.append(self.kept)
        _open_closed_descriptors()
        self._out_fd = os.dup(1)
        self._err_fd = os.dup(2)

    def divert(self) -> None:
        """Point descriptor 1 at standard error, or, in a quiet run, 1 and 2 at nothing."""
        if self.quiet:
            null = os.open(os.devnull, os.O_WRONLY)
            os.dup2(null, 1)
            os.dup2(null, 2)
            os.close(null)
        else:
            os.dup2(2, 1)
            if self._err is not None:
                sys.stdout = self._err

    def restore(self) -> None:
        """Leave all as it is, see the class, but for text that still waits in a buffer."""
        try:
            if self._out is not None:
                self._out.flush()
        except (OSError, ValueError):
            return

    def write_result(self, chunks: Iterable[bytes]) -> None:
        """Write to standard output; raise OSError if that cannot be done."""
        if self._out is None:
            raise OSError(9, os.strerror(9))
        write_all(self._out_fd, chunks)

    def say(self, text: str) -> None:
        """Write text and a line break to standard error, if anyone can still hear it."""
        if self._err is None:
            return
        try:
            if not self.quiet:
                self._err.flush()
            encoding = self._err.encoding or "utf-8"
            _write_chunk(self._err_fd, (text + os.linesep).encode(encoding, "backslashreplace"))
        except (OSError, ValueError):
            return

    def is_terminal(self, *, result: bool = False) -> bool:
        """Tell whether standard error, or standard output for `result`, is a terminal."""
        return os.isatty(self._out_fd if result else self._err_fd)


def _open_closed_descriptors() -> None:
    """Open /dev/null on closed standard descriptors, so that no other file gets them."""
    for descriptor in (0, 1, 2):
        try:
            os.fstat(descriptor)
        except OSError:
            if os.open(os.devnull, os.O_RDWR) != descriptor:
                return


def _encodable(text: str, stream: TextIO) -> str:
    """Return text in which what the stream's encoding lacks is escaped."""
    encoding = stream.encoding or "utf-8"
    return text.encode(encoding, "backslashreplace").decode(encoding)
