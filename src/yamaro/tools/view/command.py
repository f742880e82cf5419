"""`yamaro view`: builds, serves and builds again until Ctrl-C."""

from __future__ import annotations

import os
import threading
import time

from ...diagnostics import shortened
from ..rebuilding import Rebuilder, Turn, count_told
from ..watching import INTERVAL
from . import server
from .editors import find_editor
from .session import Session

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from ...policy import Policy


class ViewOptions:
    """What the command line asks of `yamaro view`."""

    __slots__ = ("editor", "has_browser", "port")

    def __init__(self, *, port: int, has_browser: bool, editor: str | None) -> None:
        """Hold it; port 0 takes any that is free."""
        self.port = port
        self.has_browser = has_browser
        self.editor = editor


def view(
    path: str,
    options: ViewOptions,
    *,
    policy: Policy,
    packages: Mapping[str, str],
    command_line: Sequence[str],
    say: Callable[[str], None],
    show: Callable[[Turn], None],
    tell_url: Callable[[str], None],
    strict: bool = False,
) -> None:
    """Show a robot in the browser until Ctrl-C.

    Args:
        path: the main file.
        options: those of this command.
        policy: how far the file is trusted.
        packages: folders of ROS packages by name.
        command_line: variables as `name:=value`.
        say: takes a line for the terminal.
        show: shows what is wrong with a build.
        tell_url: takes the address of the page.
        strict: take warnings for errors.

    Raises:
        ValueError: the editor's command makes no sense.
        OSError: the port cannot be had.
    """
    editor = find_editor(options.editor, os.environ)
    rebuilder = Rebuilder(
        path,
        policy=policy,
        packages=packages,
        command_line=command_line,
        on_message=say,
        strict=strict,
        advice=True,
        has_root=True,
        takes_xml=True,
    )
    session = Session(
        path,
        rebuilder=rebuilder,
        policy=policy,
        packages=packages,
        command_line=command_line,
        editor=editor.name if editor is not None else None,
    )
    running = server.Server(session, port=options.port, editor=editor)
    server.start(running)
    try:
        last = _build(session, None, say, show)
        tell_url(running.url)
        if options.has_browser:
            threading.Thread(target=_open_browser, args=(running.url, say), daemon=True).start()
        while True:
            if session.wake.wait(INTERVAL) or rebuilder.has_changed():
                last = _build(session, last, say, show)
    finally:
        server.stop(running)


def _build(
    session: Session, last: Turn | None, say: Callable[[str], None], show: Callable[[Turn], None]
) -> Turn:
    """Build once, and say in a line what came of it; nothing if it failed just as before."""
    turn = session.build()
    if not turn.fails_as(last):
        say(f"{time.strftime('%H:%M:%S')}  {outcome_of(turn)}")
        if not turn.is_told_as(last):
            show(turn)
    return turn


def outcome_of(turn: Turn) -> str:
    """Return what came of a build, in a few words."""
    told = count_told(turn.diagnostics)
    if turn.build is None:
        return shortened(turn.fault) if turn.fault else told
    return f"built in {1000 * turn.seconds:.0f} ms" + (f", {told}" if told else "")


def _open_browser(url: str, say: Callable[[str], None]) -> None:
    """Open the page; that may take as long as a browser runs that runs in the terminal."""
    import webbrowser

    try:
        is_open = webbrowser.open(url)
    except (webbrowser.Error, OSError):
        is_open = False
    if not is_open:
        say("no browser could be opened; open the address above in one")
