"""`yamaro FILE`: compiles a file."""

from __future__ import annotations

import os

from ..streams import NAMES
from .conversion import convert_file
from .reports import goes_to_standard_output

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..result import Build
    from ..streams import Streams
    from .arguments import Arguments


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the XML, or with `--deps` the files it is made of; return the exit status."""
    if arguments.has("help-args"):
        from .args import run as run_args

        return run_args(arguments, streams)
    if arguments.has("deps"):
        from .dependencies import listed

        return convert_file(arguments, streams, listed, form=NAMES)

    def conclude(build: Build) -> None:
        if not streams.quiet and not goes_to_standard_output(arguments):
            _sum_up(build, arguments, streams)

    return convert_file(arguments, streams, lambda build: build.encoded(), conclude=conclude)


def _sum_up(build: Build, arguments: Arguments, streams: Streams) -> None:
    """Sum up what was written, for people: programs take what is said for complaints."""
    name = arguments.options["output"]
    ending = os.path.splitext(name)[1].lower()
    has_to = arguments.has("to")
    if has_to or (ending != ".urdf" and "<robot" in "".join(build.pieces[:8])[:200]):
        note_ending(name, build.format if has_to else "urdf", streams)
    if has_to:
        from .formats import summary_of as summary_of_formats

        summary = summary_of_formats(build, arguments)
    else:
        if not streams.is_terminal():
            return
        from .summary import summary_of

        summary = summary_of(build.encoded())
    if streams.is_terminal():
        streams.say(f"{name}: {summary}")


def note_ending(
    name: str, written: str, streams: Streams, how: str = "--to {0.name} writes {0.title}"
) -> None:
    """Note that the ending of a file name promises another format than the one written, and how."""
    ending = os.path.splitext(name)[1].lower()
    if ending in ("", ".xml") or os.path.isdir(name):
        return
    from ..targets.table import TARGETS

    if ending not in TARGETS[written].endings:
        for target in TARGETS.values():
            if ending in target.endings:
                holds = f"{name} holds {TARGETS[written].title}"
                streams.say(f"yamaro: note: {holds}; {how.format(target)}")
                return
