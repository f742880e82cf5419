"""What the command says: diagnostics, wrong usage, and faults of our own."""

from __future__ import annotations

import os

from ..source import STANDARD_INPUT, STANDARD_INPUT_NAME
from ..streams import Streams
from .usage import INTERNAL_ERROR, USAGE, USAGE_ERROR

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from ..diagnostics import Diagnostic
    from .arguments import Arguments


def show(diagnostics: Sequence[Diagnostic], arguments: Arguments, streams: Streams) -> None:
    """Write diagnostics to standard error; a quiet build keeps its warnings to itself.

    What an output format cannot hold has one line, unless all is to be shown.
    """
    from ..diagnostics import ERROR, WARNING

    if streams.quiet and arguments.command != "check":
        diagnostics = [one for one in diagnostics if one.severity == ERROR]
    if not diagnostics:
        return
    from ..codes import LOSSES
    from ..rendering import render_all, render_in_line

    color = has_color(arguments, is_terminal=streams.is_terminal())
    lines = []
    if not arguments.has("verbose"):
        lines = [one for one in diagnostics if one.code in LOSSES and one.severity == WARNING]
    shown = [one for one in diagnostics if one not in lines] if lines else diagnostics
    texts = render_all(shown, color=color)
    if lines:
        texts.append("\n".join(render_in_line(one, color=color) for one in lines))
    streams.say("\n\n".join(texts), colored=color)
    if lines:
        streams.say("-v shows each place; a comment `# yamaro: allow CODE` there accepts it")
    if arguments.command == "check":
        errors = sum(one.severity == ERROR for one in diagnostics)
        counts = [(errors, "error"), (len(diagnostics) - errors, "warning")]
        counted = [f"{count} {word}{'s' if count > 1 else ''}" for count, word in counts if count]
        streams.say(f"\n{display_name(arguments)}: {', '.join(counted)}")


def display_name(arguments: Arguments) -> str:
    """Return what the main file is called in messages."""
    from ..terminal import printable

    path = arguments.words[0]
    return STANDARD_INPUT_NAME if path == STANDARD_INPUT else printable(path)


def sayer(streams: Streams) -> Callable[[str], None]:
    """Return what takes the lines that are not errors: a quiet run drops them."""
    return _drop if streams.quiet else streams.say


def _drop(message: str) -> None:
    """Take a message of a quiet run."""


def has_color(arguments: Arguments, *, is_terminal: bool) -> bool:
    """Return whether to colour: the option, then NO_COLOR, FORCE_COLOR, TERM, then the terminal."""
    when = arguments.options.get("color", "auto")
    if when != "auto":
        return when == "always"
    environ = os.environ
    if environ.get("NO_COLOR"):
        return False
    if environ.get("FORCE_COLOR"):
        return True
    return is_terminal and environ.get("TERM") != "dumb"


def report_usage(message: str, streams: Streams | None) -> int:
    """Say what is wrong with the command line; return the exit status."""
    from ..terminal import shortened

    (streams or Streams(quiet=False)).say(f"yamaro: error: {shortened(message)}\n{USAGE}")
    return USAGE_ERROR


def report_fault(error: Exception, streams: Streams) -> int:
    """Report a fault of Yamaro, not of the input; return the exit status."""
    from ..terminal import shortened

    kind, place = _kind_and_place(error)
    text = f"{kind}: {error}" + (f" ({place})" if place else "")
    streams.say(
        f"yamaro: internal error: {shortened(text)}\n"
        "this is a bug in Yamaro, not in your file; please report it and the command you ran"
    )
    if os.environ.get("YAMARO_TRACEBACK"):
        import traceback

        streams.say("".join(traceback.format_exception(error)).rstrip())
    return INTERNAL_ERROR


def _kind_and_place(error: Exception) -> tuple[str, str]:
    """Return the class of an exception and where it was raised, in a jail or here."""
    from ..confined import FaultInJail

    if isinstance(error, FaultInJail):
        return error.kind, error.place
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    if trace is None:
        return type(error).__name__, ""
    file_name = os.path.basename(trace.tb_frame.f_code.co_filename)
    return type(error).__name__, f"{file_name}:{trace.tb_lineno}"
