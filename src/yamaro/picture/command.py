"""The command `yamaro picture`: the packages that it needs, and the picture of a build."""

from __future__ import annotations

from ..diagnostics import failure_of_all

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..confined import Reader
    from ..diagnostics import Diagnostic
    from ..result import Build
    from .request import Request

OLDEST_VTK = (9, 6)
"""Older ones end the process where there is no display."""
HINT = "pip install 'yamaro[picture]'"


class Result:
    """A picture as the bytes of its file, with warnings and remarks."""

    __slots__ = ("data", "remarks", "warnings")

    def __init__(self, data: bytes, warnings: list[Diagnostic], remarks: list[str]) -> None:
        self.data = data
        self.warnings = warnings
        self.remarks = remarks


def check_packages(name: str) -> None:
    """Raise YamaroError if a Python package is missing that a picture needs.

    Args:
        name: of the robot's file, for the message.
    """
    from importlib.util import find_spec

    needed = {"vtk": "vtkmodules", "numpy": "numpy", "pillow": "PIL", "trimesh": "trimesh"}
    for package, module in needed.items():
        if find_spec(module) is None:
            message = f"a picture needs yamaro[picture]: the Python package '{package}' is missing"
            raise failure_of_all("missing-extra", message, name, HINT)
    from importlib.metadata import PackageNotFoundError, version

    try:
        found = tuple(int(part) for part in version("vtk").split(".")[:2])
    except (PackageNotFoundError, ValueError):
        found = (1000, 0)  # it has none
    if found < OLDEST_VTK:
        message = f"a picture needs vtk {_shown(OLDEST_VTK)} or newer, and this is {_shown(found)}"
        raise failure_of_all("missing-extra", message, name, f"{HINT} --upgrade")


def _shown(version: tuple[int, ...]) -> str:
    return ".".join(map(str, version))


def draw(build: Build, name: str, request: Request, reader: Reader) -> Result:
    """Return the picture of a robot.

    Args:
        build: of the robot.
        name: of its file, for messages.
        request: what to draw.
        reader: reads meshes, and knows when the time is over.

    Raises:
        YamaroError: the time is over, a mesh lies where it may not be read, or nothing can be
            drawn on this system.
        UsageError: a joint is named that there is not.
    """
    from .draw import Drawing, gif, still
    from .stage import NoOpenGLError

    try:
        drawing = Drawing(build, request, reader)
    except NoOpenGLError as error:
        message = "nothing can be drawn here: OpenGL is missing, which needs no display"
        raise failure_of_all("no-opengl", message, name, str(error)) from None
    frames = drawing.frames()
    if request.ending == ".gif":
        data = gif(frames, request.rate)
    else:
        data = still(next(frames), request.ending)
    return Result(data, drawing.warnings, drawing.remarks)
