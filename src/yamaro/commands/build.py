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
    if arguments.has("to"):
        from .formats import summary_of as summary_of_formats

        summary = summary_of_formats(build, arguments)
    else:
        ending = os.path.splitext(name)[1].lower()
        if ending not in ("", ".urdf", ".xml") and "<robot" in "".join(build.pieces[:8])[:200]:
            from ..targets.table import TARGETS

            for target in TARGETS.values():
                if ending in target.endings:  # it promises another format than URDF
                    says = f"{name} holds URDF; --to {target.name} writes {target.title}"
                    streams.say(f"yamaro: note: {says}")
        if not streams.is_terminal():
            return
        from .summary import summary_of

        summary = summary_of(build.encoded())
    if streams.is_terminal():
        streams.say(f"{name}: {summary}")
