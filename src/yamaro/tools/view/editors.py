"""Opens a file at a line in the user's editor."""

from __future__ import annotations

import os
import shlex
import subprocess

from ...files.programs import find_program

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

# How the place is passed to editors with a window of their own.
_PLACE_FORMS: dict[str, tuple[str, ...]] = {
    "code": ("-g", "{file}:{line}:{column}"),
    "code-insiders": ("-g", "{file}:{line}:{column}"),
    "codium": ("-g", "{file}:{line}:{column}"),
    "cursor": ("-g", "{file}:{line}:{column}"),
    "windsurf": ("-g", "{file}:{line}:{column}"),
    "subl": ("{file}:{line}:{column}",),
    "zed": ("{file}:{line}:{column}",),
    "kate": ("--line", "{line}", "--column", "{column}", "{file}"),
    "gedit": ("+{line}:{column}", "{file}"),
    "gnome-text-editor": ("{file}",),
    "xed": ("+{line}", "{file}"),
    "pluma": ("+{line}", "{file}"),
    "mousepad": ("--line={line}", "{file}"),
    "geany": ("--line", "{line}", "{file}"),
    "gvim": ("+{line}", "{file}"),
    "emacs": ("+{line}:{column}", "{file}"),
    "emacsclient": ("-n", "+{line}:{column}", "{file}"),
    "idea": ("--line", "{line}", "{file}"),
    "pycharm": ("--line", "{line}", "{file}"),
    "clion": ("--line", "{line}", "{file}"),
    "notepad++": ("-n{line}", "{file}"),
}
SEARCHED = ("code", "codium", "cursor", "zed", "subl", "kate", "gedit", "xed", "pluma")
"""The editors looked for where none is named, the most common first."""


class Editor:
    """A command that opens files.

    Attributes:
        name: what it is called on the page.
    """

    __slots__ = ("_form", "_running", "name")

    def __init__(self, words: Sequence[str]) -> None:
        """Take the words of a command.

        They may have `{file}`, `{line}` and `{column}` in them. Otherwise the place is added after
        them, in the way of an editor that is known, or else the file alone.
        """
        self.name = _program(words[0])
        has_place = any("{file}" in word for word in words)
        self._form = (*words, *(() if has_place else _PLACE_FORMS.get(self.name, ("{file}",))))
        self._running: list[subprocess.Popen[bytes]] = []

    def words(self, path: str, line: int, column: int) -> list[str]:
        """Return the command that opens a place."""
        values = {"{file}": path, "{line}": str(line), "{column}": str(column)}
        words = []
        for word in self._form:
            for name, value in values.items():
                word = word.replace(name, value)
            words.append(word)
        return words

    def open(self, path: str, line: int, column: int) -> None:
        """Open a place, and do not wait for the editor; raise OSError if it cannot be started."""
        program, *rest = self.words(path, line, column)
        found = find_program(program)
        if found is None:
            raise FileNotFoundError(2, os.strerror(2), program)
        self._running = [each for each in self._running if each.poll() is None]
        self._running.append(
            subprocess.Popen(
                [found, *rest],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                start_new_session=True,
            )
        )


def find_editor(command: str | None, environ: Mapping[str, str]) -> Editor | None:
    """Return the editor to use, or None if there is none with a window of its own.

    Args:
        command: what the user names; it is used as it is.
        environ: where VISUAL and EDITOR are looked up. One that runs in a terminal, such as vim,
            is passed over: the terminal is taken.

    Raises:
        ValueError: the command cannot be taken apart into words.
    """
    if command is not None:
        words = shlex.split(command)
        if not words:
            raise ValueError("it is empty")
        return Editor(words)
    for variable in ("VISUAL", "EDITOR"):
        try:
            words = shlex.split(environ.get(variable, ""))
        except ValueError:
            continue
        if words and _program(words[0]) in _PLACE_FORMS and _has_window(words):
            return Editor(words)
    for name in SEARCHED:
        if find_program(name, environ.get("PATH", "")):
            return Editor([name])
    return None


def _program(word: str) -> str:
    """Return what a program is called: its file's name, in lower case, without `.exe`."""
    name = os.path.basename(word).lower()
    return os.path.splitext(name)[0] if name.endswith((".exe", ".cmd", ".bat")) else name


def _has_window(words: Sequence[str]) -> bool:
    return not {"-nw", "-t", "-tty", "--tty", "--no-window-system"}.intersection(words)
