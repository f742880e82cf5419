"""`yamaro FILE`: compiles a file."""

from __future__ import annotations

import os

from ..streams import NAMES
from .conversion import convert_file
from .delivery import goes_to_standard_output

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..result import Build
    from ..streams import Streams
    from .arguments import Arguments


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the XML, or with `--deps` the files it is made of; return the exit status."""
    if arguments.has("help-args"):
        from . import args

        return args.run(arguments, streams)
    if arguments.has("deps"):
        return convert_file(arguments, streams, _dependencies, form=NAMES)

    def conclude(build: Build) -> None:
        """Sum up what was written, for people: programs take what is said for complaints."""
        if not streams.quiet and not goes_to_standard_output(arguments) and streams.is_terminal():
            from ..tools.summary import summary_of

            streams.say(f"{arguments.options['output']}: {summary_of(build.encoded())}")

    return convert_file(arguments, streams, _document, conclude=conclude)


def _document(build: Build) -> Iterable[bytes]:
    return build.encoded()


def _dependencies(build: Build) -> list[bytes]:
    """Return a line for each file; refuse a name that programs would read as several."""
    from ..diagnostics import failure_of_all

    names = dict.fromkeys(filter(os.path.isabs, build.files + build.meshes))
    for name in names:
        if name.splitlines() != [name]:
            raise failure_of_all(
                "name-with-line-break",
                f"--deps lists one name a line, and '{name}' has a line break in it",
                build.files[0],
                "rename the file, or have it named without --deps",
            )
    return [os.fsencode(name) + b"\n" for name in names]
