"""The command's standard streams: the one place that all its output passes.

Standard output is kept for the result alone. All that is said to people goes to standard error
with what controls a terminal or a runner of CI escaped, wherever it comes from: messages, file
names, what a program prints, the logs of libraries. A result is escaped only if standard output is
a terminal.
"""

from __future__ import annotations

import os
import sys

from .output import write_all

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from typing import Any, TextIO

XML, NAMES, BINARY = "xml", "names", "binary"
"""The forms of a result in bytes: on a terminal what controls it becomes a character reference in
XML, and is escaped in names of files; binary data is not for terminals."""


MOST_KEPT = 200
"""Characters of a line that is written in pieces which are kept."""


class NotForTerminal(Exception):
    """A result that no terminal can show was to be written to one."""


class Streams:
    """Standard output, for the result alone, and standard error, for all that is said.

    While it is set up, what Python code prints goes to standard error, escaped; in a quiet run it
    is discarded. This class works on `sys.stdout` and `sys.stderr`, for callers inside Python.

    Attributes:
        kept: what has to live as long as the streams do.
    """

    __slots__ = ("_err", "_line", "_null", "_out", "kept", "quiet")

    owns_process = False
    """Whether the process is there for this command alone."""

    def __init__(self, *, quiet: bool) -> None:
        """Remember the streams as they are now."""
        self.quiet = quiet
        self._out: TextIO | None = sys.stdout
        self._err: TextIO | None = sys.stderr
        self._null: TextIO | None = None
        self._line = ""
        self.kept: list[object] = []

    def divert(self) -> None:
        """Send what other code prints from now on away from standard output."""
        if self.quiet:
            self._null = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115
            sys.stdout = sys.stderr = self._null
        elif self._err is not None:
            sys.stdout = sys.stderr = _Escaping(self._err, self._put)  # type: ignore[assignment]

    def silence_libraries(self) -> None:
        """Send what libraries write past Python nowhere, as they may quote untrusted files."""

    def restore(self) -> None:
        """Undo `divert`."""
        if self._null is not None:
            self._null.close()
            self._null = None
        sys.stdout, sys.stderr = self._out, self._err

    def write_result(self, chunks: Iterable[bytes | str], form: str = XML) -> None:
        """Write to standard output.

        Args:
            chunks: text for people, which is escaped in any case; or bytes for programs, which are
                escaped on a terminal only. They are in UTF-8, and none ends within a character.
            form: that of the bytes: XML, NAMES or BINARY.

        Raises:
            OSError: it cannot be written.
            NotForTerminal: it is binary, and standard output is a terminal.
        """
        if self._out is None:
            raise OSError(9, os.strerror(9))
        is_terminal = self.is_terminal(result=True)
        if is_terminal and form == BINARY:
            raise NotForTerminal
        self._write_out(self._encoded(chunks, form, is_terminal=is_terminal))

    def result_descriptor(self) -> int:
        """Return the descriptor of standard output, for a protocol that is written piece by piece.

        Raises:
            OSError: there is none.
        """
        if self._out is None:
            raise OSError(9, os.strerror(9))
        return self._out.fileno()

    def _encoded(
        self, chunks: Iterable[bytes | str], form: str, *, is_terminal: bool
    ) -> Iterable[bytes]:
        encoding = self.result_encoding()
        for chunk in chunks:
            if isinstance(chunk, str):
                text = _harmless(chunk, colored=True)
                if not is_terminal:
                    text = _unobeyed(text)
                yield text.encode(encoding, "backslashreplace")
            elif not is_terminal:
                yield chunk
            elif form == XML:
                from .terminal import harmless_xml

                yield harmless_xml(_decoded(chunk)).encode(encoding, "xmlcharrefreplace")
            else:
                yield _harmless(_decoded(chunk)).encode(encoding, "backslashreplace")

    def _write_out(self, chunks: Iterable[bytes]) -> None:
        assert self._out is not None
        self._out.flush()
        buffer = getattr(self._out, "buffer", None)
        if buffer is None:
            self._out.write(b"".join(chunks).decode("utf-8", "surrogateescape"))
        else:
            for chunk in chunks:
                buffer.write(chunk)
            buffer.flush()
        self._out.flush()

    def say(self, text: str, *, colored: bool = False) -> None:
        """Write text and a line break to standard error, if anyone can still hear it.

        What controls a terminal is escaped; `colored` lets the styles of `terminal.py` pass.
        """
        self._put(_harmless(text, colored=colored) + "\n")

    def put_in_line(self, text: str) -> None:
        """Write text over the line of the terminal in which the cursor is; "" clears it."""
        self._put(f"\r\x1b[K{_harmless(text)}")

    def _logged(self, text: str) -> str:
        """Return text for standard error that is not a command to what reads a log of it."""
        if self.is_terminal():
            return text
        shown = _unobeyed(text, self._line)
        self._line = (self._line + text)[(self._line + text).rfind("\n") + 1 :]
        if len(self._line) > MOST_KEPT:
            self._line = f"… {self._line[-MOST_KEPT // 2 :]}"
        return shown

    def _put(self, text: str) -> None:
        """Write text, which is escaped already, to standard error."""
        if self._err is None:
            return
        text = self._logged(text)
        try:
            encoding = self._err.encoding or "utf-8"
            self._err.write(text.encode(encoding, "backslashreplace").decode(encoding))
            self._err.flush()
        except (OSError, ValueError):
            return

    def is_terminal(self, *, result: bool = False) -> bool:
        """Return whether standard error, or standard output for `result`, is a terminal."""
        stream = self._out if result else self._err
        try:
            return stream is not None and stream.isatty()
        except ValueError:
            return False

    def result_encoding(self) -> str:
        """Return the encoding of standard output, ASCII if nobody knows it."""
        encoding = getattr(self._out, "encoding", None) or "utf-8"
        try:
            "".encode(encoding)
        except LookupError:
            return "ascii"
        return encoding


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
            self.silence_libraries()
        else:
            os.dup2(2, 1)
            super().divert()

    def silence_libraries(self) -> None:
        """Send what libraries write past Python nowhere, as they may quote untrusted files."""
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, 1)
        os.dup2(null, 2)
        os.close(null)

    def restore(self) -> None:
        """Leave all as it is, see the class, except for text that still waits in a buffer."""
        try:
            if self._out is not None:
                self._out.flush()
        except (OSError, ValueError):
            return

    def result_descriptor(self) -> int:
        """Return the descriptor that standard output was kept in."""
        return self._out_fd

    def _write_out(self, chunks: Iterable[bytes]) -> None:
        write_all(self._out_fd, chunks)

    def put_in_line(self, text: str) -> None:
        """Write text over the line of the terminal in which the cursor is; "" clears it."""
        self._put(f"\r\x1b[K{_harmless(text)}")

    def _put(self, text: str) -> None:
        """Write text, which is escaped already, to standard error."""
        if self._err is None:
            return
        text = self._logged(text)
        try:
            if not self.quiet:
                self._err.flush()
            if os.linesep != "\n":
                text = text.replace("\n", os.linesep)
            encoding = self._err.encoding or "utf-8"
            write_all(self._err_fd, [text.encode(encoding, "backslashreplace")])
        except (OSError, ValueError):
            return

    def is_terminal(self, *, result: bool = False) -> bool:
        """Return whether standard error, or standard output for `result`, is a terminal."""
        return os.isatty(self._out_fd if result else self._err_fd)


class _Escaping:
    """Wraps a text stream: what is written is escaped, all else is the stream's own."""

    __slots__ = ("_put", "_stream")

    def __init__(self, stream: TextIO, put: Callable[[str], None]) -> None:
        self._stream = stream
        self._put = put

    def write(self, text: str) -> int:
        """Pass text on; raise TypeError for anything else, as all text streams do."""
        if not isinstance(text, str):
            raise TypeError(f"write() argument must be str, not {type(text).__name__}")
        self._put(_harmless(text))
        return len(text)

    def writelines(self, lines: Iterable[str]) -> None:
        """Pass several texts on."""
        for line in lines:
            self.write(line)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


def _harmless(text: str, *, colored: bool = False) -> str:
    from .terminal import harmless

    return harmless(text, colored=colored)


def _unobeyed(text: str, line: str = "") -> str:
    from .terminal import unobeyed

    return unobeyed(text, line)


def _decoded(chunk: bytes) -> str:
    return chunk.decode("utf-8", "surrogateescape")


def _open_closed_descriptors() -> None:
    """Open /dev/null on closed standard descriptors, so that no other file gets them."""
    for descriptor in (0, 1, 2):
        try:
            os.fstat(descriptor)
        except OSError:
            if os.open(os.devnull, os.O_RDWR) != descriptor:
                return
