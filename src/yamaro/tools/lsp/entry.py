"""`yamaro lsp`: a language server for editors, on standard input and output."""

from __future__ import annotations

import os
import sys

from ...commands.command_table import Command
from ...commands.option_table import Option
from ...commands.reports import WrongUsage, quote

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...commands.arguments import Arguments
    from ...streams import Streams

COMMAND = Command(
    "lsp",
    ("[--stdio]",),
    "serve an editor: diagnostics, completion, hover, rename",
    "Run a language server on standard input and output. Editors start it; see docs/editors.md.",
    place=13,
    options=(Option("stdio", "use standard input and output, as by default; editors pass it"),),
)


def run(arguments: Arguments, streams: Streams) -> int:
    """Serve an editor until it is gone; return the exit status."""
    from .protocol import Wire
    from .server import Server

    if arguments.words or arguments.assignments:
        extra = (arguments.words or arguments.assignments)[0]
        raise WrongUsage(f"unexpected argument {quote(extra)} after 'lsp'")
    streams.silence_libraries()
    reader = os.fdopen(os.dup(sys.__stdin__.fileno() if sys.__stdin__ else 0), "rb")
    return Server(Wire(reader, streams.result_descriptor())).run()
