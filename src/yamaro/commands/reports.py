"""Output of a command: its result, its messages, its exit status."""

from __future__ import annotations

import os

from ..files.regular import read_start
from ..output import STANDARD_OUTPUT, is_input, leads_out, write_file
from ..source import STANDARD_INPUT, STANDARD_INPUT_NAME
from ..streams import XML, NotForTerminal, Streams

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from ..diagnostics import Diagnostic
    from ..result import Build
    from .arguments import Arguments


# --- exit statuses and wrong usage ------------------------------------------------------------


DONE = 0
INPUT_ERROR = 1
USAGE_ERROR = 2
INTERNAL_ERROR = 70  # EX_SOFTWARE of sysexits.h
INTERRUPTED = 130  # 128 + SIGINT, as shells count
PIPE_CLOSED = 141  # 128 + SIGPIPE


class WrongUsage(Exception):
    """The command line cannot be understood; the text says why."""


def near(word: str, candidates: Iterable[str]) -> str:
    """Return the end of a message that suggests the candidate most like a word, if there is one."""
    from ..diagnostics import did_you_mean

    hint = did_you_mean(word, list(candidates))
    return f"; {hint}" if hint else ""


def quote(text: str) -> str:
    """Return text in quotes, short and fit for a terminal."""
    from ..terminal import shortened

    return f"'{shortened(text)}'"


# --- messages ---------------------------------------------------------------------------------


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
        comment = "yamaro: allow CODE"
        comment = f"<!-- {comment} -->" if lines[0].span.source.is_xml else f"# {comment}"
        streams.say(f"-v shows each place; a comment `{comment}` there accepts it")
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
    return (lambda message: None) if streams.quiet else streams.say


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


def usage_told(name: str) -> str:
    """Return how a command is used; how `yamaro FILE` is for a word that is not a command."""
    from .command_table import BUILD, command_named
    from .option_table import usage_of

    command = command_named(name) or command_named(BUILD)
    assert command is not None
    called = "yamaro" if command.name == BUILD else f"yamaro {command.name}"
    return "\n".join(usage_of(command)) + f"   (see '{called} --help')"


def report_usage(message: str, name: str, streams: Streams | None) -> int:
    """Say what is wrong with the command line of a command; return the exit status."""
    from ..terminal import shortened

    said = f"yamaro: error: {shortened(message)}\n{usage_told(name)}"
    (streams or Streams(quiet=False)).say(said)
    return USAGE_ERROR


def report_fault(error: Exception, streams: Streams) -> int:
    """Report a fault of Yamaro, not of the input; return the exit status."""
    from ..confined import FaultInJail
    from ..terminal import shortened

    kind, place = type(error).__name__, ""
    if isinstance(error, FaultInJail):
        kind, place = error.kind, error.place
    elif (trace := error.__traceback__) is not None:
        while trace.tb_next is not None:
            trace = trace.tb_next
        file_name = os.path.basename(trace.tb_frame.f_code.co_filename)
        place = f"{file_name}:{trace.tb_lineno}"
    text = f"{kind}: {error}" + (f" ({place})" if place else "")
    streams.say(
        f"yamaro: internal error: {shortened(text)}\n"
        "this is a bug in Yamaro, not in your file; please report it and the command you ran"
    )
    if os.environ.get("YAMARO_TRACEBACK"):
        import traceback

        streams.say("".join(traceback.format_exception(error)).rstrip())
    return INTERNAL_ERROR


# --- results ----------------------------------------------------------------------------------


def goes_to_standard_output(arguments: Arguments) -> bool:
    """Return whether no output file is named."""
    return arguments.options.get("output", "-") in STANDARD_OUTPUT


def deliver(
    chunks: Iterable[bytes | str], arguments: Arguments, streams: Streams, form: str = XML
) -> int:
    """Write the result to where it is wanted; a place that cannot be written to is an error.

    Args:
        chunks: see `Streams.write_result`.
        arguments: the command line.
        streams: where everything goes.
        form: that of chunks in bytes.
    """
    try:
        if goes_to_standard_output(arguments):
            streams.write_result(chunks, form)
        else:
            encoded = (each.encode() if isinstance(each, str) else each for each in chunks)
            write_file(arguments.output_path, encoded)
    except NotForTerminal:
        raise WrongUsage(
            "refusing to write binary data to a terminal: name a file, or use a pipe"
        ) from None
    except BrokenPipeError:
        raise
    except OSError as error:
        is_standard = goes_to_standard_output(arguments)
        name = "to standard output" if is_standard else quote(arguments.options["output"])
        streams.say(f"yamaro: error: cannot write {name}: {error.strerror or error}")
        return INPUT_ERROR
    return DONE


def deliver_files(files: dict[str, bytes], streams: Streams) -> int:
    """Write files by their paths; the first that cannot be written is an error."""
    for path, data in files.items():
        try:
            write_file(path, [data])
        except OSError as error:
            streams.say(f"yamaro: error: cannot write {quote(path)}: {error.strerror or error}")
            return INPUT_ERROR
    return DONE


def deliver_assets(build: Build, arguments: Arguments, streams: Streams) -> int:
    """Write files beside the output, such as copies of meshes; replace none that differs."""
    if arguments.has("deps"):
        return DONE
    is_copied = arguments.options.get("meshes") == "copy"
    has_meshes = is_copied or build.finder.has_made
    is_beside = build.beside and not goes_to_standard_output(arguments)
    if not (has_meshes or is_beside):
        return DONE
    output = arguments.output_path
    is_file = os.path.isfile(output) or not os.path.exists(output)
    if not is_file and not has_meshes:  # a device, beside which nothing is
        return DONE
    if goes_to_standard_output(arguments) or not is_file:
        raise WrongUsage(
            "'--meshes copy' needs '-o' with a regular file; the copies are written beside it"
            if is_copied
            else "this robot has meshes that are made of others, and are written beside it: name "
            "it with -o FILE, or write --meshes none"
        )
    try:
        folder = os.path.dirname(output)
        files = {os.path.join(folder, name): data for name, data in build.assets.items()}
        generated = {os.path.join(folder, name) for name in build.beside}
        new = {
            path: data
            for path, data in files.items()
            if (path in generated and is_generated(path)) or not is_written(path, data)
        }
    except OSError as error:
        name = os.fspath(error.filename or "a mesh")
        streams.say(f"yamaro: error: cannot copy {quote(name)}: {error.strerror or error}")
        return INPUT_ERROR
    refuse_leading_out(folder, new)
    return deliver_files(new, streams)


def is_generated(path: str) -> bool:
    """Return whether a file is there that says it was generated, and so may be replaced."""
    from ..targets.output import MARK, START

    return os.path.isfile(path) and MARK.encode() in read_start(path, START)


def is_written(path: str, data: bytes) -> bool:
    """Return whether a file is there with this content; raise OSError if it has another."""
    if not os.path.lexists(path):
        return False
    if os.path.isfile(path) and read_start(path, len(data) + 1) == data:
        return True
    raise FileExistsError(17, "another file has that name", path)


def refuse_leading_out(folder: str, paths: Iterable[str]) -> None:
    """Refuse to write what a file has named through links that lead out of the output folder."""
    for path in paths:
        if leads_out(path, folder or os.curdir):
            name = quote(os.path.relpath(path))
            raise WrongUsage(f"refusing to write {name}: links lead out of the output folder there")


def refuse_overwriting(arguments: Arguments, inputs: Callable[[], Sequence[str]]) -> None:
    """Refuse an output that is one of the files read."""
    if not goes_to_standard_output(arguments) and is_input(arguments.output_path, inputs()):
        output = quote(arguments.options["output"])
        raise WrongUsage(f"the output {output} is one of the input files")


def refuse_replacing(arguments: Arguments, paths: Sequence[str]) -> None:
    """Refuse to replace files without `--force`."""
    if arguments.has("force") or goes_to_standard_output(arguments):
        return
    for path in paths:
        try:
            is_there = os.stat(path).st_mode & 0o170000 == 0o100000
        except OSError:
            continue
        if is_there:
            raise WrongUsage(f"{quote(os.path.relpath(path))} already exists; --force replaces it")
