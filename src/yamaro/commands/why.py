"""`yamaro why FILE ADDRESS`: where a value in the output comes from."""

from __future__ import annotations

from .conversion import convert_file
from .reports import has_color
from .usage import WrongUsage

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..result import Build
    from ..streams import Streams
    from .arguments import Arguments


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the answer to standard output; return the exit status."""
    address = arguments.words[1]
    return convert_file(
        arguments,
        streams,
        lambda build: [_answer(build, address, arguments, streams)],
        has_root=True,
        records=True,
    )


def _format_in(arguments: Arguments) -> str:
    """Return the format whose document the address is looked up in."""
    formats = arguments.lists.get("to", ["urdf"])
    if len(formats) > 1 or "," in formats[0]:
        raise WrongUsage("'yamaro why' looks an address up in one output format")
    return formats[0].strip().lower()


def _answer(build: Build, address: str, arguments: Arguments, streams: Streams) -> str:
    from ..tools.why import UnknownAddress, answer, answer_data, answer_text
    from ..tools.why_formats import in_formats

    home = _format_in(arguments)
    if home not in build.outputs:
        raise WrongUsage(f"there is no {home} of this robot: {build.refused.get(home, '')}")
    try:
        found = answer(build.outputs[home].root, address, format=home)
        found.formats = in_formats(found, home, build)
    except UnknownAddress as error:
        raise WrongUsage(str(error)) from None
    if arguments.has("json"):
        import json

        return json.dumps(answer_data(found), indent=2) + "\n"
    return answer_text(
        found, color=has_color(arguments, is_terminal=streams.is_terminal(result=True))
    )
