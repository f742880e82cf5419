"""The commands that go on until Ctrl-C: `yamaro watch`, `yamaro view` and `yamaro lsp`."""

from __future__ import annotations

import os
import sys

from ..source import STANDARD_INPUT
from .arguments import make_policy, options_of
from .reports import (
    DONE,
    WrongUsage,
    deliver,
    deliver_assets,
    goes_to_standard_output,
    quote,
    refuse_overwriting,
    sayer,
    show,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..result import Build
    from ..streams import Streams
    from ..tools.rebuilding import Rebuilder
    from .arguments import Arguments


def repeat(
    arguments: Arguments,
    streams: Streams,
    run: Callable[[Rebuilder], None],
    *,
    looks: bool,
) -> int:
    """Call `run` with what builds the file; return the exit status.

    Args:
        arguments: the command line.
        streams: where everything goes.
        run: builds until it is interrupted.
        looks: whether advice and the tree are wanted.
    """
    import warnings

    from ..options import UsageError
    from ..tools.rebuilding import Rebuilder

    arguments.resolve_output()
    if arguments.words[0] == STANDARD_INPUT:
        raise WrongUsage(f"'yamaro {arguments.command}' needs a FILE with a name, to see it change")
    policy = make_policy(arguments)
    if not policy.is_trusted:
        streams.silence_libraries()
    if streams.owns_process:
        from ..sandbox import process

        process.bound_memory(policy.limits.memory)
    try:
        with warnings.catch_warnings():
            if not sys.warnoptions:  # user code's warnings, unless asked for with -W
                warnings.simplefilter("ignore")
            options = options_of(arguments, policy=policy, advice=looks, on_message=sayer(streams))
            run(Rebuilder(arguments.words[0], options))
    except UsageError as error:
        raise WrongUsage(str(error)) from None
    except KeyboardInterrupt:
        return DONE
    return DONE


# --- `yamaro watch FILE -o FILE`: compiles again at each save ---------------------------------


def run_watch(arguments: Arguments, streams: Streams) -> int:
    """Write the XML at each save until Ctrl-C; return the exit status."""

    def write(build: Build) -> bool:
        refuse_overwriting(arguments, lambda: [*build.files, *build.meshes])
        if arguments.has("to"):
            from .formats import deliver_formats

            return deliver_formats(build, (), arguments, streams) == DONE
        status = deliver_assets(lambda: build.assets, arguments, streams)
        return status == DONE and deliver(build.encoded(), arguments, streams) == DONE

    def run(rebuilder: Rebuilder) -> None:
        from ..tools.watch import watch

        if goes_to_standard_output(arguments):
            raise WrongUsage("'yamaro watch' needs a file to write, as in '-o robot.urdf'")
        refuse_overwriting(arguments, lambda: arguments.words)
        watch(
            rebuilder,
            write=write,
            output=arguments.options["output"],
            say=sayer(streams),
            show=lambda turn: show(turn.diagnostics, arguments, streams),
        )

    return repeat(arguments, streams, run, looks=False)


# --- `yamaro view FILE`: shows the robot in the browser ---------------------------------------


def run_view(arguments: Arguments, streams: Streams) -> int:
    """Serve the page until Ctrl-C; return the exit status."""

    def run(rebuilder: Rebuilder) -> None:
        from ..tools.view.command import ViewOptions, view

        port = arguments.options.get("port", "0")
        if not (port.isascii() and port.isdigit() and int(port) <= 65535):
            raise WrongUsage(f"'--port' takes a number from 0 to 65535, not {quote(port)}")
        options = ViewOptions(
            port=int(port),
            has_browser=not arguments.has("no-browser"),
            is_embedded=arguments.has("embed"),
            editor=arguments.options.get("editor"),
        )
        view(
            rebuilder,
            options,
            say=sayer(streams),
            show=lambda turn: show(turn.diagnostics, arguments, streams),
            tell_url=lambda url: streams.write_result([f"{url}\n"]),
        )

    return repeat(arguments, streams, run, looks=True)


# --- `yamaro lsp`: a language server for editors, on standard input and output ----------------


def run_lsp(arguments: Arguments, streams: Streams) -> int:
    """Serve an editor until it is gone; return the exit status."""
    from ..tools.lsp.protocol import Wire
    from ..tools.lsp.server import Server

    if arguments.words or arguments.assignments:
        extra = (arguments.words or arguments.assignments)[0]
        raise WrongUsage(f"unexpected argument {quote(extra)} after 'lsp'")
    streams.silence_libraries()
    reader = os.fdopen(os.dup(sys.__stdin__.fileno() if sys.__stdin__ else 0), "rb")
    return Server(Wire(reader, streams.result_descriptor())).run()
