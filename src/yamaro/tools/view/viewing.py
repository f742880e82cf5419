"""The command `yamaro view`: builds, serves and builds again; opens places in an editor."""

from __future__ import annotations

import os
import shlex
import subprocess
import threading
import time

from ...files.regular import find_program
from ...options import UsageError
from ...rebuilding import INTERVAL, count_told
from ...terminal import shortened
from . import server
from .session import Session

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from ...rebuilding import Rebuilder, Turn


class ViewOptions:
    """Options of `yamaro view`."""

    __slots__ = ("editor", "has_browser", "is_embedded", "port")

    def __init__(
        self, *, port: int, has_browser: bool, editor: str | None, is_embedded: bool = False
    ) -> None:
        """Hold it; port 0 takes any that is free."""
        self.is_embedded = is_embedded
        self.port = port
        self.has_browser = has_browser
        self.editor = editor


def view(
    rebuilder: Rebuilder,
    options: ViewOptions,
    *,
    say: Callable[[str], None],
    show: Callable[[Turn], None],
    tell_url: Callable[[str], None],
) -> None:
    """Show a robot in the browser until Ctrl-C.

    Args:
        rebuilder: builds it, with a tree.
        options: those of this command.
        say: takes a line for the terminal.
        show: shows what is wrong with a build.
        tell_url: takes the address of the page.

    Raises:
        UsageError: an option makes no sense, or the port or the main file is not available.
    """
    try:
        editor = find_editor(options.editor, os.environ)
    except ValueError as error:
        raise UsageError(f"'--editor' takes a command: {error}") from None
    session = Session(rebuilder, editor=editor.name if editor is not None else None)
    try:
        running = server.Server(
            session, port=options.port, editor=editor, is_embedded=options.is_embedded
        )
    except OSError as error:
        reason = error.strerror or error
        raise UsageError(f"the port {options.port} is not available: {reason}") from None
    server.start(running)
    try:
        last = session.build()
        _tell(last, None, say, show)
        tell_url(running.url)
        if options.has_browser:
            threading.Thread(target=open_browser, args=(running.url, say), daemon=True).start()
        while True:
            is_asked = session.wake.wait(INTERVAL)
            if is_asked or rebuilder.has_changed():
                turn = session.build()
                # While a slider is dragged, only what is new is worth a line.
                if not (turn.is_told_as(last) if is_asked else turn.fails_as(last)):
                    _tell(turn, last, say, show)
                last = turn
    finally:
        server.stop(running)


def _tell(
    turn: Turn, last: Turn | None, say: Callable[[str], None], show: Callable[[Turn], None]
) -> None:
    """Report the result of a build in a line; show what is wrong unless that was shown before."""
    outcome = counted = count_told(turn.diagnostics)
    if turn.build is not None:
        outcome = f"built in {1000 * turn.seconds:.0f} ms" + (f", {counted}" if counted else "")
    elif turn.fault:
        outcome = shortened(turn.fault)
    say(f"{time.strftime('%H:%M:%S')}  {outcome}")
    if not turn.is_told_as(last):
        show(turn)


def open_browser(url: str, say: Callable[[str], None]) -> None:
    """Open the page; that may take as long as a browser runs that runs in the terminal."""
    import webbrowser

    try:
        is_open = webbrowser.open(url)
    except (webbrowser.Error, OSError):
        is_open = False
    if not is_open:
        say("no browser could be opened; open the address above in one")


# --- the user's editor ------------------------------------------------------------------------


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


_IN_TERMINAL = {"-nw", "-t", "-tty", "--tty", "--no-window-system"}
"""Options with which Emacs opens no window of its own."""


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
        if words and _program(words[0]) in _PLACE_FORMS and _IN_TERMINAL.isdisjoint(words):
            return Editor(words)
    for name in SEARCHED:
        if find_program(name, environ.get("PATH", "")):
            return Editor([name])
    return None


def _program(word: str) -> str:
    """Return what a program is called: its file's name, in lower case, without `.exe`."""
    name = os.path.basename(word).lower()
    return os.path.splitext(name)[0] if name.endswith((".exe", ".cmd", ".bat")) else name
