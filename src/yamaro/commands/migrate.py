"""`yamaro migrate FILE`: writes XML as a source of Yamaro, and says whether it makes the same."""

from __future__ import annotations

import os

from .delivery import (
    deliver,
    deliver_files,
    goes_to_standard_output,
    refuse_overwriting,
    refuse_replacing,
)
from .inputs import read_bytes
from .reports import display_name, show
from .settings import make_policy, read_packages
from .usage import DONE, INPUT_ERROR, WrongUsage, quote

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..policy import Limits
    from ..source import Source
    from ..streams import Streams
    from .arguments import Arguments


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the source or sources; return the exit status."""
    from ..compiler import UsageError
    from ..diagnostics import YamaroError
    from ..tools.migrate import command

    arguments.resolve_output()
    refuse_overwriting(arguments, lambda: arguments.words)
    path = arguments.words[0]
    limits = make_policy(arguments).limits
    data = read_bytes(path, limits.file + 1)
    try:
        source = command.read_file(path, limits, data)
        if command.is_xacro_file(source, limits):
            return _migrate_xacro(source, arguments, streams, limits)
        if arguments.assignments:
            raise WrongUsage(f"a URDF has no argument to set: {quote(arguments.assignments[0])}")
        refuse_replacing(arguments, [arguments.output_path])
        migration = command.migrate_source(source, limits, exact=arguments.has("exact"))
    except YamaroError as error:
        show(error.diagnostics, arguments, streams)
        return INPUT_ERROR
    except UsageError as error:
        raise WrongUsage(str(error)) from None
    status = deliver([migration.text.encode()], arguments, streams)
    if not streams.quiet or migration.differences:
        streams.say(f"{display_name(arguments)}: {command.report(migration)}")
    return status or (INPUT_ERROR if migration.differences else DONE)


def _migrate_xacro(source: Source, arguments: Arguments, streams: Streams, limits: Limits) -> int:
    """Write the files of a robot in xacro into a folder, and say whether it is the same."""
    from ..tools.migrate import command, xacro_command

    folder = arguments.output_path
    if goes_to_standard_output(arguments):
        raise WrongUsage("a robot in xacro becomes several files: give a folder, as in '-o robot/'")
    if os.path.isfile(folder):
        raise WrongUsage(f"{quote(arguments.options['output'])} is a file, and a folder is needed")
    migration = xacro_command.migrate_robot(
        source,
        os.path.abspath(folder),
        arguments=arguments.assignments,
        packages=read_packages(arguments),
        limits=limits,
        exact=arguments.has("exact"),
    )
    files = {os.path.join(folder, name): text.encode() for name, text in migration.files.items()}
    refuse_replacing(arguments, list(files))
    show([*xacro_command.warnings_of(migration), *migration.faults], arguments, streams)
    if deliver_files(files, streams) != DONE:
        return INPUT_ERROR
    count = f"{len(files)} file{'s' if len(files) > 1 else ''}"
    if migration.faults:
        streams.say(f"{display_name(arguments)}: the sources ({count}) have errors; see above")
        return INPUT_ERROR
    if not streams.quiet or migration.differences:
        main = os.path.normpath(os.path.join(arguments.options["output"], migration.main))
        streams.say(f"{display_name(arguments)}: {command.report(migration)}; {count}, {main}")
        if not migration.is_compared_with_xacro:
            streams.say("compared with Yamaro's own expansion; with yamaro[xacro], with xacro's")
    return INPUT_ERROR if migration.differences else DONE
