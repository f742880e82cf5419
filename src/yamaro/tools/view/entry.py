"""`yamaro view FILE`: shows the robot in the browser."""

from __future__ import annotations

from ...commands.command_table import ENDINGS, FILE_WORDS, Command
from ...commands.option_table import BUILDING, WRITING, Option
from ...commands.repetition import repeat
from ...commands.reports import WrongUsage, quote, sayer, show

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...commands.arguments import Arguments
    from ...options import AllOptions
    from ...rebuilding import Rebuilder
    from ...streams import Streams


def _downloads(arguments: Arguments) -> AllOptions:
    """Return the options of a build from which downloads are written later."""
    return {
        "base": arguments.options.get("base"),
        "repair_inertia": arguments.has("repair-inertia"),
        "sdf_version": arguments.options.get("sdf-version"),
        "mujoco_version": arguments.options.get("mujoco-version"),
    }


COMMAND = Command(
    "view",
    ("FILE [name:=value ...]",),
    "show the robot in the browser, updated at each save",
    "Show a robot in the browser, and update it whenever one of its files is saved. "
    "Press Ctrl-C to stop.",
    words=FILE_WORDS,
    looks=True,
    endings=ENDINGS,
    place=3,
    options=(
        *WRITING,
        Option(
            "port",
            "serve the page at that port; by default at any free port",
            value="N",
            wants="a number from 0 to 65535",
        ),
        Option("no-browser", "do not open a browser, only print the address of the page"),
        Option("embed", "let editors show the page in a frame; their extensions pass it"),
        Option(
            "editor",
            "open files with that command: 'code -g {file}:{line}:{column}'; by default with "
            "VISUAL or EDITOR, if it opens a window",
            value="COMMAND",
            wants="a command",
            completes="commands",
        ),
        *BUILDING,
    ),
    help_of={
        "base": ("the same for downloads: fix the root, or let it move freely"),
        "repair-inertia": ("balance inertia that no body can have in downloads"),
        "sdf-version": ("version of SDF in downloads: 1.11 (the default), 1.9 or 1.12"),
        "mujoco-version": ("version of MuJoCo that reads downloaded MJCF: 3.3 or newer"),
    },
    targets=_downloads,
)


def run(arguments: Arguments, streams: Streams) -> int:
    """Serve the page until Ctrl-C; return the exit status."""
    return repeat(
        arguments, streams, lambda rebuilder: _view(arguments, streams, rebuilder), looks=True
    )


def _view(arguments: Arguments, streams: Streams, rebuilder: Rebuilder) -> None:
    from .viewing import ViewOptions, view

    port = arguments.options.get("port", "0")
    if not (port.isascii() and port.isdigit() and int(port) <= 65535):
        raise WrongUsage(f"'--port' takes a number from 0 to 65535, not {quote(port)}")
    options = ViewOptions(
        port=int(port),
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
