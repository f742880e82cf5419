"""Writes what a command makes to where it is wanted."""

from __future__ import annotations

import os

from ..files.regular import read_start
from ..output import STANDARD_OUTPUT, is_input, leads_out, write_file
from ..streams import XML, NotForTerminal
from .usage import DONE, INPUT_ERROR, WrongUsage, quote

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from ..streams import Streams
    from .arguments import Arguments


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
            write_file(arguments.output_path, map(_in_file, chunks))
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


def _in_file(chunk: bytes | str) -> bytes:
    return chunk.encode() if isinstance(chunk, str) else chunk


def deliver_files(files: dict[str, bytes], streams: Streams) -> int:
    """Write files by their paths; the first that cannot be written is an error."""
    for path, data in files.items():
        try:
            write_file(path, [data])
        except OSError as error:
            streams.say(f"yamaro: error: cannot write {quote(path)}: {error.strerror or error}")
            return INPUT_ERROR
    return DONE


def deliver_assets(
    find: Callable[[], dict[str, bytes]], arguments: Arguments, streams: Streams
) -> int:
    """Write files beside the output, such as copies of meshes; replace none that differs."""
    if arguments.options.get("meshes") != "copy" or arguments.has("deps"):
        return DONE
    output = arguments.output_path
    if os.path.exists(output) and not os.path.isfile(output):
        raise WrongUsage(
            "'--meshes copy' needs '-o' with a regular file; the copies are written beside it"
        )
    try:
        folder = os.path.dirname(output)
        files = {os.path.join(folder, name): data for name, data in find().items()}
        new = {path: data for path, data in files.items() if not is_written(path, data)}
    except OSError as error:
        name = os.fspath(error.filename or "a mesh")
        streams.say(f"yamaro: error: cannot copy {quote(name)}: {error.strerror or error}")
        return INPUT_ERROR
    refuse_leading_out(folder, new)
    return deliver_files(new, streams)


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
