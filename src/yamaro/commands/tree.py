"""`yamaro tree FILE`: shows links, joints and masses as a tree."""

from __future__ import annotations

from .conversion import convert_file
from .reports import has_color
from .usage import WrongUsage

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..result import Build
    from ..streams import Streams
    from .arguments import Arguments


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the tree to standard output; return the exit status."""
    return convert_file(
        arguments, streams, lambda build: [_tree(build, arguments, streams)], has_root=True
    )


def _tree(build: Build, arguments: Arguments, streams: Streams) -> str:
    from ..tools.tree import render_tree

    if build.root_name != "robot":
        raise WrongUsage(f"'yamaro tree' shows robots, and this is a <{build.root_name}>")
    try:
        "└─├│…".encode(streams.result_encoding())
        has_lines = True
    except UnicodeEncodeError:
        has_lines = False
    color = has_color(arguments, is_terminal=streams.is_terminal(result=True))
    return render_tree(build.robot, ascii=not has_lines, color=color)
