"""`yamaro tree FILE`: shows links, joints and masses as a tree."""

from __future__ import annotations

from ...commands.command_table import ENDINGS, FILE_WORDS, Command
from ...commands.conversion import convert_file
from ...commands.option_table import BUILDING
from ...commands.reports import WrongUsage, has_color

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...commands.arguments import Arguments
    from ...result import Build
    from ...streams import Streams

COMMAND = Command(
    "tree",
    ("FILE [name:=value ...]",),
    "show links, joints and masses as a tree",
    "Show the links of a robot as a tree, with their masses and joints.",
    words=FILE_WORDS,
    looks=True,
    endings=ENDINGS,
    place=2,
    options=(*BUILDING,),
)


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the tree to standard output; return the exit status."""
    return convert_file(
        arguments, streams, lambda build: [_tree(build, arguments, streams)], has_root=True
    )


def _tree(build: Build, arguments: Arguments, streams: Streams) -> str:
    from .text import render_tree

    if build.root_name != "robot":
        raise WrongUsage(f"'yamaro tree' shows robots, and this is a <{build.root_name}>")
    try:
        "└─├│…".encode(streams.result_encoding())
        has_lines = True
    except UnicodeEncodeError:
        has_lines = False
    color = has_color(arguments, is_terminal=streams.is_terminal(result=True))
    return render_tree(build.robot, ascii=not has_lines, color=color)
