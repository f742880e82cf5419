"""`yamaro view`: builds, serves and builds again until Ctrl-C."""

from __future__ import annotations

import os
import threading
import time

from ...options import UsageError
from ...terminal import shortened
from ..rebuilding import count_told
from ..watching import INTERVAL
from . import server
from .editors import find_editor
from .session import Session

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..rebuilding import Rebuilder, Turn
    from .editors import Editor


class ViewOptions:
    """What the command line asks of `yamaro view`."""

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
    editor = _editor(options)
    session = Session(rebuilder, editor=editor.name if editor is not None else None)
    running = _server(session, options, editor)
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


def _editor(options: ViewOptions) -> Editor | None:
    try:
        return find_editor(options.editor, os.environ)
    except ValueError as error:
        raise UsageError(f"'--editor' takes a command: {error}") from None


def _server(session: Session, options: ViewOptions, editor: Editor | None) -> server.Server:
    try:
        return server.Server(
            session, port=options.port, editor=editor, is_embedded=options.is_embedded
        )
    except OSError as error:
        reason = error.strerror or error
        raise UsageError(f"the port {options.port} is not available: {reason}") from None


def _tell(
    turn: Turn, last: Turn | None, say: Callable[[str], None], show: Callable[[Turn], None]
) -> None:
    """Report the result of a build in a line; show what is wrong unless that was shown before."""
    say(f"{time.strftime('%H:%M:%S')}  {_outcome(turn)}")
    if not turn.is_told_as(last):
        show(turn)


def _outcome(turn: Turn) -> str:
    """Return the result of a build, in a few words."""
    counted = count_told(turn.diagnostics)
    if turn.build is None:
        return shortened(turn.fault) if turn.fault else counted
    return f"built in {1000 * turn.seconds:.0f} ms" + (f", {counted}" if counted else "")


def open_browser(url: str, say: Callable[[str], None]) -> None:
    """Open the page; that may take as long as a browser runs that runs in the terminal."""
    import webbrowser

    try:
        is_open = webbrowser.open(url)
    except (webbrowser.Error, OSError):
        is_open = False
    if not is_open:
        say("no browser could be opened; open the address above in one")
