"""`yamaro picture FILE -o FILE.png`: draws the robot."""

from __future__ import annotations

from time import monotonic

from ...commands.arguments import make_policy, read_adjustment
from ...commands.command_table import ENDINGS, FILE_WORDS, Command
from ...commands.conversion import convert_file, end_process
from ...commands.option_table import BUILDING, Option
from ...commands.reports import WrongUsage, display_name
from ...streams import BINARY

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...commands.arguments import Arguments
    from ...picture.request import Request
    from ...result import Build
    from ...streams import Streams

COMMAND = Command(
    "picture",
    ("FILE -o FILE.png [name:=value ...]",),
    "render the robot as a PNG or GIF",
    "Render an image or a film of a robot. Requires the Python packages of "
    "yamaro[picture], but no display or browser.",
    words=FILE_WORDS,
    looks=True,
    endings=ENDINGS,
    examples=(
        "yamaro picture robot.yaml -o robot.png",
        "yamaro picture robot.yaml -o sheet.png --view iso,front,left,top --size 400x300",
        "yamaro picture robot.urdf -o waving.gif --sweep shoulder,elbow",
    ),
    place=5,
    options=(
        "output",
        Option(
            "size",
            "width and height of each view, in pixels; 800x600 by default",
            value="800x600",
            wants="WIDTHxHEIGHT",
        ),
        Option(
            "view",
            "viewing direction: iso (the default), front, back, left, right, top, bottom, or "
            "azimuth and elevation of the camera in degrees: 30,20; several are combined in one "
            "image",
            value="VIEW",
            wants="the name of a view, or azimuth,elevation",
            is_repeatable=True,
            completes="iso front left back right top bottom",
        ),
        Option(
            "state",
            "named state in which the robot is shown; home by default, if it has one, or else "
            "zero: all joints at 0",
            value="NAME",
            wants="the name of a state",
        ),
        Option(
            "joints",
            "positions of joints, by their names or those of their parts, in radians, metres or "
            "another unit: elbow=45deg; on top of the state",
            value="NAME=POSITION,...",
            wants="NAME=POSITION",
            is_repeatable=True,
        ),
        Option(
            "show",
            "what to show: visual (the default), collision, inertia, frames, grid; separate "
            "several with commas",
            value="WHAT",
            wants="visual, collision, inertia, frames or grid",
            is_repeatable=True,
            completes="visual collision inertia frames grid",
        ),
        Option(
            "transparent",
            "make the background transparent, except for the robot's shadow; .png and .gif",
        ),
        Option("turn", "make a film in which the camera circles the robot"),
        Option(
            "sweep",
            "make a film in which joints move through their limits; names separated by commas, "
            "'all' for all at once, or 'each' for one after the other",
            value="JOINTS",
            wants="names of joints, all or each",
            completes="all each",
        ),
        Option("seconds", "length of a film", value="N", wants="a number of seconds"),
        Option(
            "frames-per-second",
            "frame rate of a film; 20 by default",
            value="N",
            wants="a number",
        ),
        *BUILDING,
    ),
    help_of={"output": ".png or .jpg; .gif for a film; - for a PNG on standard output"},
)


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
    from ...options import UsageError
    from ...picture.command import check_packages
    from ...picture.request import Request

    output = arguments.options.get("output")
    if output is None:
        raise WrongUsage("'yamaro picture' needs an output file: -o robot.png")
    try:
        request = Request(output, arguments.options, arguments.lists)
    except UsageError as error:
        raise WrongUsage(str(error)) from None
    check_packages(display_name(arguments))
    return request


def _picture(build: Build, arguments: Arguments, streams: Streams, began: float) -> bytes:
    from ...confined import Reader, has_jail
    from ...diagnostics import YamaroError
    from ...picture.command import draw

    if build.root_name != "robot":
        raise WrongUsage(
            f"'yamaro picture' needs a robot, but the root element is <{build.root_name}>"
        )
    policy, name = make_policy(arguments), display_name(arguments)
    until = None if policy.timeout is None else began + policy.timeout
    reader = Reader(policy, readable=build.finder.roots, name=name, until=until)
    call_off = None
    if until is not None and streams.owns_process and has_jail(policy, name):
        seconds = max(until - monotonic(), 0)  # until here the jail has seen to it
        call_off = end_process(arguments, streams, policy, seconds)
    try:
        result = draw(build, name, _request(arguments), reader)
    finally:
        if call_off is not None:
            call_off()
    build.warnings.extend(result.warnings)
    if read_adjustment(arguments).deny(result.warnings):
        raise YamaroError(result.warnings)
    if not streams.quiet:
        for remark in result.remarks:
            streams.say(f"{name}: {remark}")
    return result.data
