"""`yamaro why FILE ADDRESS`: where a value in the output comes from."""

from __future__ import annotations

from ...commands.command_table import ENDINGS, FILE_WORDS, Command
from ...commands.conversion import convert_file
from ...commands.option_table import BUILDING
from ...commands.reports import WrongUsage, has_color

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...commands.arguments import Arguments
    from ...options import AllOptions
    from ...result import Build
    from ...streams import Streams

SHAPES = ("visual", "collision", "geom", "mesh", "material")
"""Words in an address that is about shapes."""


def _targets(arguments: Arguments) -> AllOptions:
    """Return the options of a build in all formats that show what is made of something."""
    from ...commands.formats import formats_in
    from ...targets.table import TARGETS

    shown = [each.name for each in TARGETS.values() if each.has_places]
    is_about_shapes = any(word in arguments.words[1] for word in SHAPES)
    return {
        "target": list(dict.fromkeys([*shown, *formats_in(arguments)])),
        "partial": True,
        "meshes": "relative" if is_about_shapes else "none",  # reading them takes time
        "gazebo": arguments.has("gazebo"),
    }


ADDRESS_WORD = ("ADDRESS", "elbow_joint/limit@upper, link:arm/visual[2], /gazebo[3] from the root")
COMMAND = Command(
    "why",
    ("FILE ADDRESS [name:=value ...]",),
    "show where a value in the output comes from",
    "Show where in the YAML an element or attribute of the output comes from.",
    words=(FILE_WORDS[0], ADDRESS_WORD, FILE_WORDS[1]),
    looks=True,
    endings=ENDINGS,
    examples=("yamaro why robot.yaml elbow_joint/limit@upper",),
    second="an ADDRESS after the file: elbow_joint/limit@upper",
    place=8,
    options=(
        "json",
        "to",
        "quiet",
        "verbose",
        *BUILDING[1:],
    ),
    help_of={
        "json": ("write the answer as JSON"),
        "to": ("look ADDRESS up in the document of that output format"),
    },
    targets=_targets,
)


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the answer to standard output; return the exit status."""

    def answered(build: Build) -> list[str]:
        from .answers import UnknownAddress, answer, answer_data, answer_text, fit_of, in_formats

        formats = arguments.lists.get("to", ["urdf"])
        if len(formats) > 1 or "," in formats[0]:
            raise WrongUsage("'yamaro why' looks an address up in one output format")
        home = formats[0].strip().lower()
        if home not in build.outputs:
            raise WrongUsage(f"there is no {home} of this robot: {build.refused.get(home, '')}")
        try:
            found = answer(build.outputs[home].root, arguments.words[1], format=home)
            found.formats = in_formats(found, home, build)
            found.fit = fit_of(found, build)
        except UnknownAddress as error:
            raise WrongUsage(str(error)) from None
        if arguments.has("json"):
            import json

            return [json.dumps(answer_data(found), indent=2) + "\n"]
        is_terminal = streams.is_terminal(result=True)
        return [answer_text(found, color=has_color(arguments, is_terminal=is_terminal))]

    return convert_file(arguments, streams, answered, has_root=True, records=True)
