"""`--to`: the formats asked for, and the documents written in them."""

from __future__ import annotations

import os
from collections.abc import Iterable

from ..output import is_input, write_files
from ..result import Build
from ..streams import Streams
from ..targets.output import FOLDER, marked
from ..targets.table import TARGETS
from .arguments import Arguments
from .reports import (
    DONE,
    INPUT_ERROR,
    WrongUsage,
    deliver,
    goes_to_standard_output,
    is_generated,
    is_written,
    near,
    quote,
    refuse_leading_out,
)
from .summary import counted

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..options import AllOptions


def formats_in(arguments: Arguments) -> list[str]:
    """Return the formats that `--to` names; raise WrongUsage if one is unknown."""
    words = [word for text in arguments.lists.get("to", ()) for word in text.split(",")]
    formats = list(dict.fromkeys(word.strip().lower() for word in words if word.strip()))
    for format in formats:
        if format not in TARGETS:
            hint = near(format, TARGETS) or "; choose from " + ", ".join(TARGETS)
            raise WrongUsage(f"unknown output format {quote(format)}{hint}")
    return formats


def targets_in(arguments: Arguments) -> AllOptions:
    """Return what the options ask for.

    Raises:
        WrongUsage: a format is unknown, or options do not go together.
    """
    formats = formats_in(arguments)
    if not formats:
        raise WrongUsage("'--to' needs output formats: " + ", ".join(TARGETS))
    for target in TARGETS.values():
        option = target.version_option.replace("_", "-")
        if option and arguments.has(option) and target.name not in formats:
            raise WrongUsage(f"'--{option}' needs --to {target.name}")
    wanted: AllOptions = {
        "target": formats,
        "base": arguments.options.get("base"),
        "repair_inertia": arguments.has("repair-inertia"),
        "sdf_version": arguments.options.get("sdf-version"),
        "mujoco_version": arguments.options.get("mujoco-version"),
        "meshes": arguments.options.get("meshes", "relative"),
        "gazebo": arguments.has("gazebo"),
    }
    if arguments.command == "check" or arguments.has("deps"):
        return wanted
    if goes_to_standard_output(arguments):
        if len(formats) > 1:
            raise WrongUsage("several output formats need a folder: -o out/")
        if TARGETS[formats[0]].is_folder:
            raise WrongUsage(f"{TARGETS[formats[0]].title} needs a folder: -o out/")
    elif is_folder(arguments, formats):
        wanted["meshes"] = arguments.options.get("meshes", "copy")
    return wanted


def is_folder(arguments: Arguments, formats: list[str]) -> bool:
    """Return whether the output is a folder.

    It is where several formats are written, or one that is a folder; where its name ends in a
    slash; and where one is there.

    Raises:
        WrongUsage: it has to be one, and is a file or is called as one.
    """
    path = arguments.output_path
    has_slash = path.endswith((os.sep, os.altsep or os.sep))
    needs_one = len(formats) > 1 or any(TARGETS[each].is_folder for each in formats)
    is_one = has_slash or needs_one or os.path.isdir(path)
    is_file = os.path.exists(path) and not os.path.isdir(path)
    is_named_so = False
    if needs_one and not is_file and not os.path.isdir(path):
        files = [target for target in TARGETS.values() if not target.is_folder]
        ending = os.path.splitext(path)[1].lower()
        is_named_so = any(ending in (each.ending, *each.endings) for each in files)
    if is_one and (is_file or is_named_so):
        name = quote(arguments.options["output"])
        what = "several output formats need"
        if len(formats) == 1:
            what = f"{TARGETS[formats[0]].title} needs"
        is_called = "is a file" if is_file else "has the name of a file"
        raise WrongUsage(f"{name} {is_called}, and {what} a folder: -o out/")
    return is_one


def path_for_build(arguments: Arguments) -> str:
    """Return the path of the output for `yamaro.build`, where that of a folder ends in a slash."""
    formats = formats_in(arguments)
    path = arguments.output_path
    return os.path.join(path, "") if is_folder(arguments, formats) else path


def deliver_formats(
    build: Build, chunks: Iterable[bytes | str], arguments: Arguments, streams: Streams
) -> int:
    """Write all documents of a build, and what belongs beside them; return the exit status.

    `chunks` are the document for standard output.
    Nothing is written before it is known that each file may be: no file that was read is replaced,
    nor one in `assets/` of other content. What Yamaro has not generated is never replaced by a file
    that the robot names: those beside a document, and in a folder the documents too, which say
    that they were generated.
    """
    if goes_to_standard_output(arguments):
        if any(name.startswith(f"{FOLDER}/") for name in build.assets):
            target = TARGETS[build.format]
            if not target.is_whole:
                raise WrongUsage(f"{target.title} needs files beside the document: -o FILE")
            raise WrongUsage(
                f"the {target.title} of this robot needs files of meshes or textures beside it: "
                "name it with -o FILE, or write --meshes none"
            )
        return deliver(chunks, arguments, streams)
    builds = list(build.outputs.values())
    formats = [each.format for each in builds]
    has_folder = is_folder(arguments, formats)
    if has_folder:
        folder = arguments.output_path
        named = {os.path.join(folder, each.file_name): each for each in builds}
    else:
        folder = os.path.dirname(arguments.output_path)
        named = {arguments.output_path: build}
    documents: dict[str, bytes] = {}
    comments: dict[str, str] = {}
    for path, each in named.items():
        target = TARGETS[each.format]
        if target.is_folder:
            documents |= {os.path.join(path, name): data for name, data in each.assets.items()}
        else:
            documents[path] = b"".join(each.encoded())
            comments[path] = target.comment
    try:
        files = _beside([each for each in builds if not TARGETS[each.format].is_folder], folder)
    except OSError as error:
        name = quote(os.fspath(error.filename or "a mesh"))
        streams.say(f"yamaro: error: cannot write {name}: {error.strerror or error}")
        return INPUT_ERROR
    inputs = [path for each in builds for path in (*each.files, *each.meshes)]
    for path in (*documents, *files):
        if path not in files or not _is_same(path, files[path]):
            if is_input(path, inputs):
                raise WrongUsage(f"the output {quote(path)} is one of the input files")
    if has_folder:
        for path, document in documents.items():
            is_users = not _may_replace(path) and not _is_same(path, document)
            if is_users and not os.path.isdir(path):
                raise WrongUsage(
                    f"{quote(os.path.relpath(path))} exists and does not say that Yamaro has "
                    "generated it: remove it, choose another folder, or name one file with -o"
                )
        documents |= {path: marked(documents[path], each) for path, each in comments.items()}
    names = {path.casefold() for path in documents}  # which may be one file on some systems
    for path in [each for each in files if each.casefold() in names]:
        streams.say(
            f"yamaro: note: no scene is written: {quote(os.path.relpath(path))} is the robot"
        )
        del files[path]
    new = {path: data for path, data in files.items() if not _is_same(path, data)}
    refuse_leading_out(folder, [*new, *(documents if has_folder else ())])
    new |= documents
    try:
        write_files(new)
    except OSError as error:
        name = quote(os.fspath(error.filename or folder))
        streams.say(f"yamaro: error: cannot write {name}: {error.strerror or error}")
        return INPUT_ERROR
    return DONE


def _beside(builds: list[Build], folder: str) -> dict[str, bytes]:
    """Return what belongs beside the documents, by path.

    Raises:
        OSError: a mesh cannot be read, or another file is in the place of one.
    """
    files: dict[str, bytes] = {}
    for build in builds:
        for name, data in build.assets.items():
            path = os.path.join(folder, name)
            if name.startswith(f"{FOLDER}/"):
                is_written(path, data)
            elif not _may_replace(path):
                if name in TARGETS[build.format].beside:  # a help that the robot does without
                    continue
                raise FileExistsError(17, "another file has that name", path)
            files[path] = data
    return files


def _is_same(path: str, data: bytes) -> bool:
    try:
        return is_written(path, data)
    except OSError:
        return False


def _may_replace(path: str) -> bool:
    """Return whether there is no file, or one that says it was generated."""
    return not os.path.lexists(path) or is_generated(path)


def summary_of(build: Build, arguments: Arguments) -> str:
    """Return what was written, in a line."""
    builds = list(build.outputs.values())
    is_one = not is_folder(arguments, [each.format for each in builds])
    listed = TARGETS[build.format].title if is_one else ", ".join(each.file_name for each in builds)
    count = len({name for each in builds for name in each.assets})
    return listed + (f", and {counted(count, 'file')} beside it" if count else "")
