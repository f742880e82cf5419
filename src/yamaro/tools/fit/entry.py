"""`yamaro fit FILE -o FILE`: gives a robot shapes to collide with that are worked out from meshes.

The robot is built as any other, and its meshes are replaced between lowering and the checks; so it
is read from and written to every format, in a jail and in safe mode too.
"""

from __future__ import annotations

import os

from ...commands.build import note_ending
from ...commands.command_table import ENDINGS, FILE_WORDS, Command
from ...commands.conversion import convert_file
from ...commands.option_table import BUILDING, WRITING, Option
from ...commands.reports import WrongUsage, goes_to_standard_output, quote
from ...model.schema import FITS, MOST_SHAPES

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...commands.arguments import Arguments
    from ...fitting.fit import Wanted
    from ...model.extras import Fitted
    from ...options import AllOptions
    from ...result import Build
    from ...robot.refitting import Refitting
    from ...streams import Streams

OTHERS = ("decompose", "spheres")
DEFAULT = "best"
KEEPS = "a robot stays in its format, and YAML and xacro become URDF"
PEEKED = 1 << 16
"""Bytes of a file in which the name of its outermost element is looked for."""


def _targets(arguments: Arguments) -> AllOptions:
    """Return the options of the build: what is worked out, and the format, that of the file."""
    return {
        "refitting": _refitting(arguments),
        "target": _format_of(arguments.words[0]),
        "meshes": arguments.options.get("meshes", "relative"),
        "base": arguments.options.get("base"),
        "repair_inertia": arguments.has("repair-inertia"),
        "sdf_version": arguments.options.get("sdf-version"),
    }


COMMAND = Command(
    "fit",
    ("FILE -o FILE [name:=value ...]",),
    "replace the meshes that a robot collides with by simple shapes",
    "Replace the meshes that the links of a robot collide with by shapes that are worked out from "
    "them: boxes, capsules, spheres or convex pieces. The robot is written in the format that it "
    "is in, a xacro or YAML file as URDF, and a table shows how close each shape is to its mesh.",
    words=FILE_WORDS,
    endings=ENDINGS,
    examples=(
        "yamaro fit robot.urdf -o build/robot.urdf",
        "yamaro fit robot.xacro -o robot.urdf --shape capsule --cover --links '*_arm_link'",
        "yamaro fit robot.xml -o robot_spheres.xml --spheres 24",
    ),
    place=7,
    options=(
        "output",
        Option(
            "shape",
            "fit this shape to each mesh: box, cylinder, sphere, capsule, hull (the convex hull), "
            "or best (the one of the first four that is nearest); best by default",
            value="SHAPE",
            wants=f"one of {', '.join(FITS)}",
            choices=FITS,
            excludes=OTHERS,
        ),
        Option(
            "decompose",
            "split each mesh into at most N convex pieces",
            value="N",
            wants="a whole number",
            excludes=("spheres",),
        ),
        Option(
            "spheres", "fill each mesh with at most N spheres", value="N", wants="a whole number"
        ),
        Option("cover", "let the shapes contain their meshes"),
        Option(
            "triangles",
            "simplify the meshes of visuals to at most N triangles",
            value="N",
            wants="a whole number",
        ),
        Option(
            "links",
            "only the links of this name or pattern; after a ! all but these",
            value="PATTERN",
            wants="the name of a link or a pattern",
            is_repeatable=True,
        ),
        "meshes",
        *WRITING,
        *BUILDING,
    ),
    help_of={"output": "write the robot to FILE"},
    writes_document=True,
    targets=_targets,
)


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the robot and the table; return the exit status."""
    if goes_to_standard_output(arguments):
        raise WrongUsage("'yamaro fit' needs the file to write: -o FILE")

    def conclude(build: Build) -> None:
        if not streams.quiet:
            for line in table_of(build.robot.fits):
                streams.say(line)
            name = arguments.options["output"]
            note_ending(name, build.format or "urdf", streams, KEEPS)

    return convert_file(
        arguments, streams, lambda build: build.encoded(), conclude=conclude, has_root=True
    )


# --- what is asked for --------------------------------------------------------------------------


def _refitting(arguments: Arguments) -> Refitting:
    from ...fitting.fit import DECOMPOSE, FIT, SPHERES, Wanted
    from ...robot.refitting import Refitting

    covers = arguments.has("cover")
    triangles = _count(arguments, "triangles")
    asked: Wanted | None = None
    for word in (DECOMPOSE, SPHERES):
        if arguments.has(word):
            asked = Wanted(word, count=_count(arguments, word), covers=covers)
    if asked is None and (arguments.has("shape") or covers or not triangles):
        kind = arguments.options.get("shape", DEFAULT)
        asked = Wanted(FIT, kind=kind, covers=covers)
    return Refitting(asked, triangles=triangles, links=arguments.lists.get("links", ()))


def _count(arguments: Arguments, option: str) -> int:
    """Return the number of an option, 0 without it."""
    text = arguments.options.get(option)
    if text is None:
        return 0
    count = int(text) if text.isascii() and text.isdecimal() and len(text) < 10 else 0
    if count < 1:
        raise WrongUsage(f"'--{option}' takes a whole number from 1, not {quote(text)}")
    if count > MOST_SHAPES and option != "triangles":
        raise WrongUsage(f"'--{option}' takes at most {MOST_SHAPES}, not {text}")
    return count


def _format_of(path: str) -> str | None:
    """Return the output format that a file is in; None for URDF, xacro and YAML."""
    import re

    from ...files.regular import read_start
    from ...sources.table import SOURCES

    try:
        start = read_start(path, PEEKED)
    except (OSError, ValueError):
        return None  # the build says why
    if not start.removeprefix(b"\xef\xbb\xbf").lstrip().startswith(b"<"):
        return None
    found = re.search(rb"<([A-Za-z_][\w.-]*)", re.sub(rb"<!--.*?-->", b"", start, flags=re.DOTALL))
    source = SOURCES.get(found[1].decode()) if found else None
    return None if source is None else source.name


# --- the table ----------------------------------------------------------------------------------


KEPT = "kept"
HEAD = ("link", "mesh", "shape", "distance", "of size", "volume", "seconds")


def table_of(fits: Sequence[Fitted]) -> list[str]:
    """Return what was worked out, in lines: how far each shape is from its mesh."""
    rows = [HEAD]
    for fitted in fits:
        seconds = fitted.number("seconds")
        part = 100 * fitted.distance / fitted.size if fitted.size else 0.0
        rows.append(
            (
                fitted.link,
                os.path.basename(fitted.mesh),
                _shape(fitted),
                f"{1000 * fitted.distance:.1f} mm",
                f"{part:.1f} %",
                "open" if fitted.excess is None else f"{100 * fitted.excess:+.1f} %",
                "" if seconds is None else f"{seconds:.1f}",
            )
        )
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = []
    for row in rows:
        cells = [
            cell.ljust(width) if index < 3 else cell.rjust(width)
            for index, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        lines.append("  ".join(cells).rstrip())
    return lines


def _shape(fitted: Fitted) -> str:
    """Return what was made: the kind of a simple shape, or how many pieces or triangles."""
    if fitted.word == "fit":
        return fitted.made
    if fitted.word == "triangles":
        return "as it is" if fitted.made == KEPT else f"{fitted.wanted} triangles"
    what = "piece" if fitted.word == "decompose" else "sphere"
    return f"{fitted.count} {what}{'' if fitted.count == 1 else 's'}"
