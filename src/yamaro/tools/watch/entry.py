"""`yamaro watch FILE -o FILE`: compiles again at each save, and says in a line the result."""

from __future__ import annotations

import time

from ...commands.command_table import ENDINGS, FILE_WORDS, Command
from ...commands.option_table import BUILDING, WRITING
from ...commands.repetition import repeat
from ...commands.reports import (
    DONE,
    WrongUsage,
    deliver,
    deliver_assets,
    goes_to_standard_output,
    refuse_overwriting,
    sayer,
    show,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...commands.arguments import Arguments
    from ...rebuilding import Rebuilder, Turn
    from ...streams import Streams

COMMAND = Command(
    "watch",
    ("FILE -o FILE [name:=value ...]",),
    "compile at each save, and report each build",
    "Compile a file now and whenever one of its input files is saved. Press Ctrl-C to stop.",
    words=FILE_WORDS,
    endings=ENDINGS,
    examples=("yamaro watch robot.yaml -o robot.urdf",),
    place=4,
    options=(
        "output",
        "meshes",
        "to",
        *WRITING,
        "gazebo",
        "quiet",
        "verbose",
        *BUILDING[1:],
    ),
    help_of={"output": "the file to write, or a folder: out/"},
    writes_document=True,
)


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the XML at each save until Ctrl-C; return the exit status."""
    return repeat(
        arguments,
        streams,
        lambda rebuilder: _watch(arguments, streams, rebuilder),
        looks=False,
    )


def _watch(arguments: Arguments, streams: Streams, rebuilder: Rebuilder) -> None:
    """Build now and after each change, and say in a line the result, until Ctrl-C."""
    if goes_to_standard_output(arguments):
        raise WrongUsage("'yamaro watch' needs a file to write, as in '-o robot.urdf'")
    refuse_overwriting(arguments, lambda: arguments.words)
    say = sayer(streams)
    last: Turn | None = None
    while True:
        turn = rebuilder.build()
        if not turn.fails_as(last):
            say(f"{time.strftime('%H:%M:%S')}  {_outcome(turn, arguments, streams)}")
            if not turn.is_told_as(last):
                show(turn.diagnostics, arguments, streams)
        last = turn
        rebuilder.wait()


def _outcome(turn: Turn, arguments: Arguments, streams: Streams) -> str:
    """Write what was built; return the result in a few words."""
    from ...rebuilding import count_told

    counted, output = count_told(turn.diagnostics), arguments.options["output"]
    if turn.build is None:
        return f"{turn.fault or counted}; {output} is unchanged"
    build, milliseconds = turn.build, f"{1000 * turn.seconds:.0f} ms"
    refuse_overwriting(arguments, lambda: [*build.files, *build.meshes])
    if arguments.has("to"):
        from ...commands.formats import deliver_formats

        status = deliver_formats(build, (), arguments, streams)
    else:
        status = deliver_assets(build, arguments, streams)
        if status == DONE:
            status = deliver(build.encoded(), arguments, streams)
    if status != DONE:
        return f"built in {milliseconds}, and not written"
    return f"{output} written, {milliseconds}" + (f", {counted}" if counted else "")
