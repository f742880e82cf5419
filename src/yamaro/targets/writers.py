"""Which output formats there are, and the writer of each."""

from __future__ import annotations

from importlib import import_module

from ..diagnostics import failure

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..model.robot import Robot
    from .output import Output, Wanted

    Write = Callable[[Robot, Wanted], Output]

ENDINGS = {"urdf": ".urdf", "sdf": ".sdf", "mjcf": ".xml", "srdf": ".srdf", "usd": ".usda"}
"""The output formats, with the ending that the name of a file has."""
TITLES = {"urdf": "URDF", "sdf": "SDF", "mjcf": "MJCF", "srdf": "SRDF", "usd": "USD"}
"""What the formats are called in messages."""
SDF_VERSIONS = ("1.11", "1.9", "1.12")
BASES = ("fixed", "free")
URDF_ONLY = frozenset(("capsule-needs-urdf-1.1", "lost-in-urdf", "needs-version"))
"""The codes of what concerns a robot only where it is written as URDF."""


def write_target(robot: Robot, wanted: Wanted) -> Output:
    """Return a robot in a format other than URDF.

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
