"""The files that a build is made of, for `--deps` and `--depfile`."""

from __future__ import annotations

import os
from collections.abc import Iterable

from ..output import is_input, write_file
from ..result import Build
from ..streams import Streams
from .arguments import Arguments
from .reports import DONE, INPUT_ERROR, WrongUsage, goes_to_standard_output, quote

ESCAPED = {"#": "\\#", "$": "$$", ":": "\\:"}
"""What make and Ninja would not take for letters of a name, besides white space."""


def listed(build: Build) -> list[bytes]:
    """Return a line for each file that a build is made of, for `--deps`.

    Raises:
        YamaroError: a name has a line break in it.
    """
    return [os.fsencode(name) + b"\n" for name in _inputs(build, "--deps")]


def _inputs(build: Build, option: str) -> list[str]:
    """Return the absolute paths of files; refuse a name that programs would read as several."""
    from ..diagnostics import failure_of_all

    builds = _builds(build)
    found = [path for each in builds for path in (*each.files, *each.meshes)]
    names = dict.fromkeys(filter(os.path.isabs, found))
    for name in names:
        if name.splitlines() != [name]:
            raise failure_of_all(
                "name-with-line-break",
                f"{option} lists one name a line, and '{name}' has a line break in it",
                build.files[0],
                f"rename the file, or have it named without {option}",
            )
    return list(names)


def _builds(build: Build) -> list[Build]:
    """Return the builds of all formats."""
    return list(build.outputs.values()) or [build]


# --- for make and Ninja -----------------------------------------------------------------------


def check_depfile(arguments: Arguments) -> None:
    """Raise WrongUsage if no dependencies can be written as `--depfile` asks."""
    if goes_to_standard_output(arguments):
        raise WrongUsage("'--depfile' needs '-o' with a file, which depends on what it lists")
    if _is_same_file(arguments.options["depfile"], arguments.output_path):
        raise WrongUsage("'--depfile' and '-o' name the same file")


def write_depfile(build: Build, arguments: Arguments, streams: Streams) -> int:
    """Write which outputs depend on which files, as a rule of make; return the exit status.

    Raises:
        WrongUsage: that would replace a file that was read, or the output.
        YamaroError: a name has a line break in it.
    """
    path = arguments.options["depfile"]
    outputs = [arguments.options["output"]]  # as the command line names them
    if arguments.has("to"):
        from .formats import is_folder

        builds = _builds(build)
        if is_folder(arguments, [each.format for each in builds]):
            outputs = [os.path.join(outputs[0], each.file_name) for each in builds]
    inputs = _inputs(build, "--depfile")
    if is_input(path, inputs):
        raise WrongUsage(f"the depfile {quote(path)} is one of the input files")
    if any(_is_same_file(path, output) for output in outputs):
        raise WrongUsage(f"the depfile {quote(path)} is one of the output files")
    folders = {os.path.dirname(os.path.abspath(each)) for each in (path, *outputs)}
    inputs += [folder for folder in _folders_of_missing(build) if folder not in folders]
    try:
        write_file(path, [rule(outputs, inputs)])
    except OSError as error:
        streams.say(f"yamaro: error: cannot write {quote(path)}: {error.strerror or error}")
        return INPUT_ERROR
    return DONE


def _folders_of_missing(build: Build) -> list[str]:
    """Return the folders that change when a mesh appears that is not there yet.

    A folder is there in any case, so that tools do not wait for it, or rebuild each time.
    """
    near = dict.fromkeys(map(os.path.dirname, build.files))
    names = dict.fromkeys(name for each in _builds(build) for name in each.meshes)
    places = [
        place
        for name in names
        if not os.path.isabs(name)
        for place in build.finder.places_meant(name, near)
    ]
    return list(dict.fromkeys(map(_nearest_folder, places)))


def _nearest_folder(path: str) -> str:
    while not os.path.isdir(path):
        path = os.path.dirname(path)
    return path


def _is_same_file(one: str, other: str) -> bool:
    return os.path.realpath(one) == os.path.realpath(other)


def rule(outputs: Iterable[str], inputs: Iterable[str]) -> bytes:
    """Return the rule of make that says so.

    Each input but the first, the main file, is also a target on its own: so make does not stop when
    an include is deleted, and rebuilds. That has no spelling for some names.
    """
    names = [_escaped(name) for name in inputs]
    targets = " ".join(map(_escaped, outputs))
    alone = [f"{name}:" for name in names[1:] if "%" not in name and "\t" not in name]
    lines = [f"{targets}: " + " \\\n  ".join(names), *alone]
    return os.fsencode("\n\n".join(lines) + "\n")


def _escaped(name: str) -> str:
    """Return a path as make and Ninja read it: backslashes count only before white space."""
    if os.sep == "\\":
        name = name.replace(os.sep, "/")
    pieces: list[str] = []
    backslashes = 0
    for character in name:
        if character in " \t":
            pieces.append("\\" * (backslashes + 1))
        pieces.append(ESCAPED.get(character, character))
        backslashes = backslashes + 1 if character == "\\" else 0
    return "".join(pieces)
