"""`yamaro migrate FILE`: writes XML as a source of Yamaro, and says whether it makes the same."""

from __future__ import annotations

import os

from ...commands.arguments import make_policy, read_packages
from ...commands.command_table import Command
from ...commands.conversion import read_bytes
from ...commands.option_table import WORKING, Option
from ...commands.reports import (
    DONE,
    INPUT_ERROR,
    WrongUsage,
    deliver,
    deliver_files,
    display_name,
    goes_to_standard_output,
    quote,
    refuse_leading_out,
    refuse_overwriting,
    refuse_replacing,
    sayer,
    show,
)
from ...source import STANDARD_INPUT

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...commands.arguments import Arguments
    from ...streams import Streams
    from .job import Result

COMMAND = Command(
    "migrate",
    ("FILE [-o FILE]", "FILE -o FOLDER [name:=value ...]"),
    "convert URDF, xacro, MJCF, SDF or other XML to YAML",
    "Convert a robot in URDF, MJCF or SDF, or other XML, to a YAML file; convert a xacro robot "
    "to a folder of YAML files, one for each xacro file. Then build the result, and report any "
    "difference.",
    words=(
        ("FILE", "the XML file, or - for standard input"),
        ("name:=value", "set a xacro argument for the comparison"),
    ),
    looks=True,
    endings=("urdf", "xacro", "xml", "mjcf", "sdf"),
    place=6,
    options=(
        "output",
        Option("force", "replace existing files"),
        Option(
            "exact",
            "keep details without meaning, such as which origins are omitted, instead of writing "
            "the shorter form",
        ),
        Option(
            "with",
            "also migrate the files of that package; by default only the files of the robot's own "
            "package and the files they depend on are migrated",
            value="PACKAGE",
            wants="the name of a package",
            is_repeatable=True,
            excludes=("all",),
        ),
        Option("all", "migrate the files of all packages", excludes=("with",)),
        *WORKING,
        "model",
    ),
    help_of={
        "output": (
            "write to FILE instead of standard output; a xacro robot of several "
            "files needs a folder"
        )
    },
)


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the source or sources; return the exit status."""
    from ...diagnostics import YamaroError
    from ...options import UsageError

    arguments.resolve_output()
    refuse_overwriting(arguments, lambda: arguments.words)
    refuse_replacing(arguments, [arguments.output_path])
    try:
        from . import urdf as command
        from .job import Job
        from .xacro.layout import ALL

        path = arguments.words[0]
        policy = make_policy(arguments)
        data = read_bytes(path, policy.limits.file + 1)
        source = command.read_file(path, policy.limits, data)
        if goes_to_standard_output(arguments):
            folder = os.path.dirname(source.path) or os.getcwd()
        elif _wants_file(arguments):
            folder = os.path.dirname(arguments.output_path)
        else:
            folder = arguments.output_path
        job = Job(
            source,
            os.path.abspath(folder),
            arguments=arguments.assignments,
            packages=read_packages(arguments),
            policy=policy,
            exact=arguments.has("exact"),
            wanted=(ALL,) if arguments.has("all") else arguments.lists.get("with", ()),
            model=arguments.options.get("model"),
        )
        result = job.run()
    except YamaroError as error:
        show(error.diagnostics, arguments, streams)
        return INPUT_ERROR
    except UsageError as error:
        raise WrongUsage(str(error)) from None
    return _deliver(result, arguments, streams)


def _wants_file(arguments: Arguments) -> bool:
    """Return whether the output that is named is a file, and not a folder of files."""
    path = arguments.output_path
    if _is_folder(path):
        return False
    ending = os.path.splitext(path)[1]
    return os.path.exists(path) or ending[1:].isalpha()


def _is_folder(path: str) -> bool:
    """Return whether a path is that of a folder, which may be missing if a slash ends it."""
    return path.endswith(os.sep) or os.path.isdir(path)


def _deliver(result: Result, arguments: Arguments, streams: Streams) -> int:
    """Write a source to where it is wanted, or several into their folder, and report."""
    name, say = display_name(arguments), sayer(streams)
    end = ""
    is_printed = goes_to_standard_output(arguments)
    if "" in result.files:
        show(result.diagnostics, arguments, streams)
    if "" in result.files and not is_printed and _is_folder(arguments.output_path):
        from .xacro.includes import source_name

        written = arguments.words[0]
        stem = source_name(os.path.basename(written))
        own = stem if written != STANDARD_INPUT else "robot.yaml"
        path = os.path.join(arguments.output_path, own)
        refuse_leading_out(arguments.output_path, [path])
        refuse_replacing(arguments, [path])
        status = deliver_files({path: result.files[""].encode()}, streams)
        end = f"; {os.path.relpath(path)}"
    elif "" in result.files:  # a URDF
        status = deliver([result.files[""].encode()], arguments, streams)
    elif is_printed or _wants_file(arguments):
        if len(result.files) > 1:
            path = arguments.options.get("output", "-")
            if goes_to_standard_output(arguments):
                path = os.path.basename(arguments.words[0])
            stem = os.path.splitext(path.removesuffix(".xacro"))[0]
            folder = stem if stem not in ("", "-") else "robot"
            raise WrongUsage(
                f"this robot becomes {len(result.files)} files: '-o' needs a folder, "
                f"as in {quote(f'-o {folder}/')}"
            )
        show(result.diagnostics, arguments, streams)
        status = deliver([result.files[result.main].encode()], arguments, streams)
    else:
        folder = arguments.output_path
        files = {os.path.join(folder, path): text.encode() for path, text in result.files.items()}
        refuse_leading_out(folder, files)
        refuse_replacing(arguments, list(files))
        show(result.diagnostics, arguments, streams)
        status = deliver_files(files, streams)
        main = os.path.normpath(os.path.join(arguments.options["output"], result.main))
        end = f"; {len(files)} file{'s' if len(files) > 1 else ''}, {main}"
    if status != DONE:
        return status
    if result.has_errors:
        streams.say(f"{name}: the sources have errors, shown above")
        return INPUT_ERROR
    if not result.is_same:
        say = streams.say
    say(f"{name}: {result.report}{end}")
    if result.remark:
        say(result.remark)
    return DONE if result.is_same else INPUT_ERROR
