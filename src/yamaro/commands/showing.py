"""The commands that show what a file describes: `yamaro args`, `tree`, `why` and `picture`."""

from __future__ import annotations

from time import monotonic

from ..streams import BINARY
from .arguments import make_policy, read_adjustment, read_packages
from .conversion import convert_file, end_process, read_pipe
from .reports import INPUT_ERROR, WrongUsage, deliver, display_name, has_color, show

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..policy import Policy
    from ..result import Build
    from ..streams import Streams
    from ..tools.declared_arguments import Listing
    from ..tools.picture.command import Result
    from ..tools.picture.request import Request
    from .arguments import Arguments


# --- `yamaro args FILE` and `yamaro FILE --help-args`: what may be passed to a file -----------


def run_args(arguments: Arguments, streams: Streams) -> int:
    """Write the listing of the file to standard output; return the exit status."""
    from ..diagnostics import YamaroError
    from ..options import UsageError

    if arguments.assignments:
        raise WrongUsage("a list of arguments does not depend on 'name:=value'")
    policy = make_policy(arguments)
    if streams.owns_process:
        from ..sandbox.process import bound_memory

        bound_memory(policy.limits.memory)
        if policy.timeout is not None:
            end_process(arguments, streams, policy, policy.timeout)
    try:
        listing = _listing(arguments, policy)
    except YamaroError as error:
        show(error.diagnostics, arguments, streams)
        return INPUT_ERROR
    except UsageError as error:
        raise WrongUsage(str(error)) from None
    if arguments.has("json"):
        from ..tools.argument_schema import schema_text

        return deliver([schema_text(listing)], arguments, streams)
    from ..tools.declared_arguments import listing_text

    return deliver([listing_text(listing)], arguments, streams)


def _listing(arguments: Arguments, policy: Policy) -> Listing:
    from ..files.loader import FileLoader
    from ..request import finder_for, reach_of, read_main
    from ..runtime.files import Library
    from ..tools.declared_arguments import listing_of

    path = arguments.words[0]
    packages = read_packages(arguments)
    reach = reach_of(path, policy, packages)
    loader = FileLoader(policy.limits, reach)
    source = read_main(path, read_pipe(path, policy), Library(loader))
    finder = finder_for(path, reach, packages)
    return listing_of(source, loader=loader, packages=finder, limits=policy.limits)


# --- `yamaro tree FILE`: shows links, joints and masses as a tree -----------------------------


def run_tree(arguments: Arguments, streams: Streams) -> int:
    """Write the tree to standard output; return the exit status."""

    def tree(build: Build) -> list[str]:
        from ..tools.tree import render_tree

        if build.root_name != "robot":
            raise WrongUsage(f"'yamaro tree' shows robots, and this is a <{build.root_name}>")
        try:
            "└─├│…".encode(streams.result_encoding())
            has_lines = True
        except UnicodeEncodeError:
            has_lines = False
        color = has_color(arguments, is_terminal=streams.is_terminal(result=True))
        return [render_tree(build.robot, ascii=not has_lines, color=color)]

    return convert_file(arguments, streams, tree, has_root=True)


# --- `yamaro why FILE ADDRESS`: where a value in the output comes from ------------------------


def run_why(arguments: Arguments, streams: Streams) -> int:
    """Write the answer to standard output; return the exit status."""

    def why(build: Build) -> list[str]:
        from ..tools.why import UnknownAddress, answer, answer_data, answer_text
        from ..tools.why_formats import in_formats

        formats = arguments.lists.get("to", ["urdf"])
        if len(formats) > 1 or "," in formats[0]:
            raise WrongUsage("'yamaro why' looks an address up in one output format")
        home = formats[0].strip().lower()
        if home not in build.outputs:
            raise WrongUsage(f"there is no {home} of this robot: {build.refused.get(home, '')}")
        try:
            found = answer(build.outputs[home].root, arguments.words[1], format=home)
            found.formats = in_formats(found, home, build)
        except UnknownAddress as error:
            raise WrongUsage(str(error)) from None
        if arguments.has("json"):
            import json

            return [json.dumps(answer_data(found), indent=2) + "\n"]
        color = has_color(arguments, is_terminal=streams.is_terminal(result=True))
        return [answer_text(found, color=color)]

    return convert_file(arguments, streams, why, has_root=True, records=True)


# --- `yamaro picture FILE -o FILE.png`: draws the robot ---------------------------------------


def run_picture(arguments: Arguments, streams: Streams) -> int:
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
