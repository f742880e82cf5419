"""`yamaro picture FILE -o FILE.png`: draws the robot."""

from __future__ import annotations

from .conversion import convert_file
from .reports import display_name
from .usage import WrongUsage

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..compiler import Build
    from ..output import Streams
    from ..tools.picture.request import Request
    from .arguments import Arguments


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the picture; return the exit status."""
    return convert_file(
        arguments,
        streams,
        lambda build: [_picture(build, arguments, streams)],
        prepare=lambda: _request(arguments),
        has_root=True,
    )


def _request(arguments: Arguments) -> Request:
    """Return what to draw; raise WrongUsage if that makes no sense, YamaroError if it cannot be."""
    from ..compiler import UsageError
    from ..tools.picture.command import check_packages
    from ..tools.picture.request import Request

    output = arguments.options.get("output")
    if output is None:
        raise WrongUsage("'yamaro picture' needs a file to write: -o robot.png")
    try:
        request = Request(output, arguments.options, arguments.lists)
    except UsageError as error:
        raise WrongUsage(str(error)) from None
    check_packages(display_name(arguments), request)
    return request


def _picture(build: Build, arguments: Arguments, streams: Streams) -> bytes:
    from ..diagnostics import ERROR, YamaroError
    from ..tools.picture.command import draw

    if build.root.name != "robot":
        raise WrongUsage(f"'yamaro picture' draws robots, and this is a <{build.root.name}>")
    result = draw(build, display_name(arguments), _request(arguments))
    build.warnings.extend(result.warnings)
    if arguments.has("strict") and result.warnings:
        for warning in result.warnings:
            warning.severity = ERROR
        raise YamaroError(result.warnings)
    if not streams.quiet:
        for remark in result.remarks:
            streams.say(f"{display_name(arguments)}: {remark}")
    return result.data
