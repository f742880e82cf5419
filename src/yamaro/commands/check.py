"""`yamaro check FILE`: looks for errors, warnings and doubtful things."""

from __future__ import annotations

from .conversion import convert_file
from .reports import display_name

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..streams import Streams
    from .arguments import Arguments


def run(arguments: Arguments, streams: Streams) -> int:
    """Report all findings, or say that there is none; return the exit status."""
    fine = [] if streams.quiet else [f"{display_name(arguments)}: ok\n"]
    return convert_file(arguments, streams, lambda build: fine, advice=True)
