"""`yamaro view FILE`: shows the robot in the browser."""

from __future__ import annotations

from .repetition import repeat
from .reports import sayer, show
from .usage import WrongUsage, quote

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..streams import Streams
    from ..tools.rebuilding import Rebuilder
    from .arguments import Arguments


def run(arguments: Arguments, streams: Streams) -> int:
    """Serve the page until Ctrl-C; return the exit status."""
    return repeat(
        arguments, streams, lambda rebuilder: _view(arguments, streams, rebuilder), looks=True
    )


def _view(arguments: Arguments, streams: Streams, rebuilder: Rebuilder) -> None:
    from ..tools.view.command import ViewOptions, view

    options = ViewOptions(
        port=_read_port(arguments),
        has_browser=not arguments.has("no-browser"),
        is_embedded=arguments.has("embed"),
        editor=arguments.options.get("editor"),
    )
    view(
        rebuilder,
        options,
        say=sayer(streams),
        show=lambda turn: show(turn.diagnostics, arguments, streams),
        tell_url=lambda url: streams.write_result([f"{url}\n"]),
    )


def _read_port(arguments: Arguments) -> int:
    text = arguments.options.get("port", "0")
    if not (text.isascii() and text.isdigit() and int(text) <= 65535):
        raise WrongUsage(f"'--port' takes a number from 0 to 65535, not {quote(text)}")
    return int(text)
