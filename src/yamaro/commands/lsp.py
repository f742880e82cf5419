"""`yamaro lsp`: a language server for editors, on standard input and output."""

from __future__ import annotations

import os
import sys

from .usage import WrongUsage, quote

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..streams import Streams
    from .arguments import Arguments


def run(arguments: Arguments, streams: Streams) -> int:
    """Serve an editor until it is gone; return the exit status."""
    from ..tools.lsp.protocol import Wire
    from ..tools.lsp.server import Server

    if arguments.words or arguments.assignments:
        extra = (arguments.words or arguments.assignments)[0]
        raise WrongUsage(f"unexpected argument {quote(extra)} after 'lsp'")
    streams.silence_libraries()
    reader = os.fdopen(os.dup(sys.__stdin__.fileno() if sys.__stdin__ else 0), "rb")
    return Server(Wire(reader, streams.result_descriptor())).run()
