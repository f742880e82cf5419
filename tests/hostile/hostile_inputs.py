"""Reads the inputs in tests/hostile/inputs: files that have to end in one good diagnostic.

=== name of the input
# research 7: where it comes from, or what it tries
codes: alias-bomb           (all errors, in order; several are divided by spaces, and where it
                             depends on the version of Python, one/or/the/other)
warnings: hidden-value      (all warnings, in order)
says: a piece of what stands on standard error; may come several times
---
the file robot.yaml; «the place» of the first error stands between marks
--- leg.yaml
another file

Further lines of the head:

status: 1 -15               how the process may end, if not only with 1
at: leg.yaml:3:1            in place of the marks
place: inside               somewhere between the marks: versions of Python tell it differently
place: anywhere             it is chance
fine: <a piece of the XML>  in place of `codes`, when all is well; may come several times
usage: a piece of the line  in place of `codes`, when the command is called wrongly
prints: hello               a line that is printed, any number of times
args: length:=2 --strict    further arguments
command: check robot.yaml   all arguments, in place of `robot.yaml -o out.urdf` and `args`
env: NAME=value             environment variables
alone: 2                    in a process of its own, with so many GB of memory
needs: --safe               only if the command has that option; several are divided by spaces
only: posix                 a system or a user that the input needs: posix, linux, not-root
see: tests/test_output.py::test_x    the test that tries it, in place of all else

In texts ⟪'['*100000⟫ stands for what Python makes of '['*100000; bytes are put in as they are. A
file whose last line ends in ⟪⟫ ends without a line break. Behind a file's name may stand
`utf-16-le` or another encoding, `cr` or `crlf`, `-> target` for a link, `folder`, `fifo`,
`socket`, `unreadable`, or `huge` for 50 GB of zeros.
"""

from __future__ import annotations

import os
import re
import shlex
import socket
from functools import cache
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).parent / "inputs"
MADE = re.compile("⟪(.*?)⟫", re.DOTALL)
MARKS = re.compile("[«»]")
ENCODED = ("utf-8", "utf-16-le", "utf-16-be", "utf-32-le", "latin-1")
KEYS = frozenset(
    "codes warnings status says at place fine usage prints".split()
    + "args command env alone needs only see".split()
)
HUGE = 50 << 30  # of which nothing lies on the disk
OLD_OUTPUT = b"<robot name='old'/>\n"


class Place:
    """Where a diagnostic points: file, line, column, and the text that it underlines, if known."""

    def __init__(self, name: str, line: int, column: int, text: str | None) -> None:
        self.name = name
        self.line = line
        self.column = column
        self.text = text

    def __str__(self) -> str:
        return f"{self.name}:{self.line}:{self.column}"


class InputFile:
    """A file of an input: its bytes, or what else it is."""

    def __init__(self, head: str, text: str) -> None:
        name, _, kind = (head or "robot.yaml").partition(" ")
        self.name = made(name)
        self.kind = made(kind)
        self._text = re.sub("⟪⟫\n?", "", text)

    def read(self) -> tuple[bytes, Place | None]:
        """Return its bytes, of which there may be many, and the place that is marked in it."""
        place, all_bytes = None, b""
        encoding = self.kind if self.kind in ENCODED else "utf-8"
        line_break = {"cr": "\r", "crlf": "\r\n"}.get(self.kind, "\n")
        before = ""
        opened = None
        for piece in re.split("([«»])", self._text):
            if piece == "«":
                opened = before
            elif piece == "»":
                assert opened is not None, f"{self.name}: » without «"
                place = place_behind(self.name, opened, before[len(opened) :])
            else:
                shown, content = _made_bytes(piece, encoding, line_break)
                before += shown
                all_bytes += content
        return all_bytes, place

    def write(self, folder: Path) -> None:
        """Make the file."""
        path = folder / self.name
        path.parent.mkdir(parents=True, exist_ok=True)
        if self.kind == "folder":
            path.mkdir()
        elif self.kind == "huge":
            path.touch()
            os.truncate(path, HUGE)
        elif self.kind == "fifo":
            os.mkfifo(path)
        elif self.kind == "socket":
            with socket.socket(socket.AF_UNIX) as server:
                server.bind(os.path.relpath(path))  # the whole path may be too long for a socket
        elif self.kind.startswith("-> "):
            path.symlink_to(self.kind.removeprefix("-> "))
        else:
            assert self.kind in ("", "cr", "crlf", "unreadable", *ENCODED), self.kind
            path.write_bytes(self.read()[0])
            if self.kind == "unreadable":
                path.chmod(0)


class HostileInput:
    """One input, and what has to come of it."""

    def __init__(self, group: str, section: str) -> None:
        pieces: list[str] = re.split(r"^---(?: +(.*))?\n", section, flags=re.MULTILINE)
        head, *files = pieces
        self.group = group
        self.name: str
        self.name, *lines = head.rstrip("\n").split("\n")
        assert lines and lines[0].startswith("# "), f"{self.name}: where is it from?"
        self.origin = lines[0].removeprefix("# ")
        self.fields: dict[str, list[str]] = {}
        for line in lines:
            if line and not line.startswith("#"):
                key, _, value = line.partition(":")
                assert key in KEYS, f"{self.name}: {key}?"
                self.fields.setdefault(key, []).append(made(value.strip()))
        self.files = [
            InputFile(name or "", text) for name, text in zip(files[::2], files[1::2], strict=True)
        ]
        assert self.files or self.see, f"{self.name}: no file"

    def __str__(self) -> str:
        return f"{self.group}: {self.name}"

    def field(self, key: str) -> str:
        """Return the only value of a key, or an empty text."""
        (value,) = self.fields.get(key, [""])
        return value

    @property
    def numbers(self) -> list[int]:
        """The numbers that the input has on the page of research."""
        found = re.match(r"research ([\d, ]+)", self.origin)
        return [int(number) for number in found[1].split(",")] if found else []

    @property
    def codes(self) -> list[str]:
        return self.field("codes").split()

    @property
    def warnings(self) -> list[str]:
        return self.field("warnings").split()

    @property
    def needs(self) -> list[str]:
        return self.field("needs").split()

    @property
    def only(self) -> list[str]:
        return self.field("only").split()

    @property
    def see(self) -> str:
        return self.field("see")

    @property
    def memory(self) -> int:
        """The bytes that a process of its own may have, or 0 where it needs none."""
        return int(float(self.field("alone") or 0) * (1 << 30))

    @property
    def environment(self) -> dict[str, str]:
        pairs = (setting.partition("=") for setting in shlex.split(self.field("env")))
        return {name: value for name, _, value in pairs}

    @property
    def arguments(self) -> list[str]:
        """What the command is called with."""
        if self.fields.get("command"):
            return shlex.split(self.field("command"))
        return ["robot.yaml", "-o", "out.urdf", *shlex.split(self.field("args"))]

    @property
    def place(self) -> Place | None:
        """Where the first error has to point."""
        if at := self.field("at"):
            name, line, column = at.rsplit(":", 2)
            return Place(name, int(line), int(column), None)
        places = [place for file in self.files if (place := file.read()[1]) is not None]
        assert len(places) < 2, f"{self.name}: two places"
        return places[0] if places else None


@cache
def read_inputs() -> list[HostileInput]:
    """Return all inputs, in the order of the files."""
    found: list[HostileInput] = []
    for path in sorted(FOLDER.glob("*.txt")):
        sections = re.split("^=== ", path.read_text(encoding="utf-8"), flags=re.MULTILINE)
        found.extend(HostileInput(path.stem, section) for section in sections[1:])
    return found


def place_behind(name: str, before: str, marked: str) -> Place:
    """Return the place that begins behind the text `before`."""
    lines = re.split("\r\n|\r|\n", before.removeprefix("\ufeff"))
    return Place(name, len(lines), len(lines[-1]) + 1, marked)


def made(text: str) -> str:
    """Return a text in which ⟪…⟫ is worked out."""
    return MADE.sub(lambda match: str(_value(match[1])), text)


def _value(code: str) -> Any:
    return eval(code)


def _made_bytes(text: str, encoding: str, line_break: str) -> tuple[str, bytes]:
    """Return a text as it counts for places, and as bytes."""
    shown, content = "", b""
    for index, piece in enumerate(MADE.split(text)):
        value = _value(piece) if index % 2 else piece.replace("\n", line_break)
        if isinstance(value, bytes):
            shown += _shown(value)
            content += value
        else:
            shown += value
            content += value.encode(encoding, "surrogatepass")
    return shown, content


def _shown(content: bytes) -> str:
    try:
        return content.decode()
    except UnicodeDecodeError:
        return content.decode("latin-1")
