"""`yamaro picture FILE -o FILE.png`: draws the robot."""

from __future__ import annotations

from time import monotonic

from ..streams import BINARY
from .conversion import convert_file, end_process
from .reports import display_name
from .settings import make_policy, read_adjustment
from .usage import WrongUsage

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..result import Build
    from ..streams import Streams
    from ..tools.picture.command import Result
    from ..tools.picture.request import Request
    from .arguments import Arguments


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the picture; return the exit status."""
    began = monotonic()
    return convert_file(
        arguments,
        streams,
        lambda build: [_picture(build, arguments, streams, began)],
        form=BINARY,
        prepare=lambda: _request(arguments),
        has_root=True,
    )


def _request(arguments: Arguments) -> Request:
    """Return what to draw; raise WrongUsage if that makes no sense, YamaroError if it cannot be."""
    from ..options import UsageError
    from ..tools.picture.command import check_packages
    from ..tools.picture.request import Request

    output = arguments.options.get("output")
    if output is None:
        raise WrongUsage("'yamaro picture' needs an output file: -o robot.png")
    try:
        request = Request(output, arguments.options, arguments.lists)
    except UsageError as error:
        raise WrongUsage(str(error)) from None
    check_packages(display_name(arguments), request)
    return request


def _picture(build: Build, arguments: Arguments, streams: Streams, began: float) -> bytes:
    from ..diagnostics import YamaroError

    if build.root_name != "robot":
        raise WrongUsage(
            f"'yamaro picture' needs a robot, but the root element is <{build.root_name}>"
        )
    result = _draw(build, arguments, streams, began)
    build.warnings.extend(result.warnings)
    if read_adjustment(arguments).deny(result.warnings):
        raise YamaroError(result.warnings)
    if not streams.quiet:
        for remark in result.remarks:
            streams.say(f"{display_name(arguments)}: {remark}")
    return result.data


def _draw(build: Build, arguments: Arguments, streams: Streams, began: float) -> Result:
    """Draw the robot in the time that is left."""
    from ..confined import Reader, has_jail
    from ..tools.picture.command import draw

    policy, name = make_policy(arguments), display_name(arguments)
    until = None if policy.timeout is None else began + policy.timeout
    reader = Reader(policy, readable=build.finder.roots, name=name, until=until)
    call_off = None
    if until is not None and streams.owns_process and has_jail(policy, name):
        seconds = max(until - monotonic(), 0)  # until here the jail has seen to it
        call_off = end_process(arguments, streams, policy, seconds)
    try:
        return draw(build, name, _request(arguments), reader)
    finally:
        if call_off is not None:
            call_off()
