"""Which output formats there are, and the writer of each."""

from __future__ import annotations

from importlib import import_module

from ..diagnostics import WARNING, Diagnostic, failure
from .output import is_file_stem

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from ..model.robot import Robot
    from .output import Output, Wanted

    Write = Callable[[Robot, Wanted], Output]

ENDINGS = {"urdf": ".urdf", "sdf": ".sdf", "mjcf": ".xml", "srdf": ".srdf", "usd": ".usda"}
"""The output formats, with the ending that the name of a file has."""
TITLES = {"urdf": "URDF", "sdf": "SDF", "mjcf": "MJCF", "srdf": "SRDF", "usd": "USD"}
"""What the formats are called in messages."""
SDF_VERSIONS = ("1.11", "1.9", "1.12")
BASES = ("fixed", "free")
SIMULATORS = ("mjcf", "sdf", "usd")
"""The formats that say whether the root is fixed in the world."""
URDF_ONLY = frozenset(("capsule-needs-urdf-1.1", "lost-in-urdf", "needs-version"))
"""The codes of what concerns a robot only where it is written as URDF."""


def write_target(robot: Robot, wanted: Wanted) -> Output:
    """Return a robot in a format.

    Raises:
        YamaroError: the format cannot hold it.
    """
    name = f"{__package__}.{wanted.format}"
    try:
        write: Write = import_module(name).write
    except ModuleNotFoundError as error:
        if error.name != name:
            raise
        raise failure(
            "missing-extra",
            f"this version cannot write {TITLES[wanted.format]}",
            robot.span,
            hint="update Yamaro",
        ) from None
    return write(robot, wanted)


def found_for(format: str, diagnostics: Sequence[Diagnostic]) -> list[Diagnostic]:
    """Return copies of what was found, except for what concerns URDF alone in another format."""
    left_out = frozenset() if format == "urdf" else URDF_ONLY
    return [each.copy() for each in diagnostics if each.code not in left_out]


def assumed_base(robot: Robot, asked: str | None) -> list[Diagnostic]:
    """Return a warning if nothing says whether the root is fixed; else nothing."""
    from ..model.kinematics import base_of

    base, reason = base_of(robot, asked)
    if not reason:
        return []
    return [
        Diagnostic(
            "base-assumed",
            f"the base is assumed to be {base}, since {reason}",
            robot.span,
            hint="write 'base: fixed' or 'base: free' in the main file, or pass --base",
            severity=WARNING,
        )
    ]


def file_name_for(name: str, format: str, stem: str) -> str:
    """Return what a robot's file in a folder is called: by its name, or else as its source is."""
    if not is_file_stem(name):
        name = stem if is_file_stem(stem) else "robot"
    if format == "mjcf" and name.casefold() == "scene":  # the file beside it has that name
        name += "_robot"
    return name + ENDINGS[format]
