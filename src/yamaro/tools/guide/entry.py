"""`yamaro guide`: prints the language on one page, for programs that write robots."""

from __future__ import annotations

from ...commands.command_table import Command
from ...commands.reports import WrongUsage, deliver, quote

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...commands.arguments import Arguments
    from ...streams import Streams

COMMAND = Command(
    "guide",
    ("",),
    "print the language on one page, for programs",
    "Print a page with the whole language in short, its examples, and how to work with the "
    "command, for assistants and other programs that write robots.",
    examples=("yamaro guide > guide.md",),
    counts_words=False,
    place=15,
)


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the page to standard output; return the exit status."""
    from importlib.resources import files

    if arguments.words or arguments.assignments:
        extra = (arguments.words or arguments.assignments)[0]
        raise WrongUsage(f"unexpected argument {quote(extra)} after 'guide'")
    text = files("yamaro.tools.guide").joinpath("guide.md").read_text(encoding="utf-8")
    return deliver([text], arguments, streams)
