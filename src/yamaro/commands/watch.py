"""`yamaro watch FILE -o FILE`: compiles again at each save."""

from __future__ import annotations

from .delivery import deliver, deliver_assets, goes_to_standard_output, refuse_overwriting
from .repetition import repeat
from .reports import sayer, show
from .usage import DONE, WrongUsage

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..result import Build
    from ..streams import Streams
    from ..tools.rebuilding import Rebuilder
    from .arguments import Arguments


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the XML at each save until Ctrl-C; return the exit status."""
    return repeat(
        arguments,
        streams,
        lambda rebuilder: _watch(arguments, streams, rebuilder),
        looks=False,
    )


def _watch(arguments: Arguments, streams: Streams, rebuilder: Rebuilder) -> None:
    from ..tools.watch import watch

    if goes_to_standard_output(arguments):
        raise WrongUsage("'yamaro watch' needs a file to write, as in '-o robot.urdf'")

    def write(build: Build) -> bool:
        refuse_overwriting(arguments, lambda: [*build.files, *build.meshes])
        if arguments.has("to"):
            from .formats import deliver_formats

            return deliver_formats(build, (), arguments, streams) == DONE
        status = deliver_assets(lambda: build.assets, arguments, streams)
        return status == DONE and deliver(build.encoded(), arguments, streams) == DONE

    refuse_overwriting(arguments, lambda: arguments.words)
    watch(
        rebuilder,
        write=write,
        output=arguments.options["output"],
        say=sayer(streams),
        show=lambda turn: show(turn.diagnostics, arguments, streams),
    )
