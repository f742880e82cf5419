"""Draws a robot as it is asked for: one picture, a sheet of views, or a film."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from vtkmodules.vtkCommonCore import vtkObject

from .cameras import fitted, fitted_around
from .figure import Figure
from .meshes import Meshes, read_meshes
from .motion import moments
from .request import read_positions
from .shapes import drawable_robot, shapes_of
from .stage import Stage
from .words import COLLISION, FRAMES, GRID, VISUAL

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from ...confined import Reader
    from ...diagnostics import Diagnostic
    from ...result import Build
    from .cameras import Camera
    from .motion import Moment
    from .request import Request

    Floats = NDArray[np.floating[Any]]
    Image = NDArray[np.uint8]

SHARPNESS = 2
"""How many times as wide and high pictures are drawn before they are made small."""

MOST_SHARP_PIXELS = 1 << 22
"""Larger pictures are drawn as they are: drawing takes some 100 bytes for each pixel."""


class Drawing:
    """The pictures of a robot that were asked for.

    Attributes:
        warnings: about meshes that cannot be drawn.
        remarks: further lines for the terminal.
    """

    def __init__(self, build: Build, request: Request, reader: Reader) -> None:
        """Set the stage.

        Args:
            build: of a robot.
            request: what to draw.
            reader: reads meshes, and knows when the time is over.

        Raises:
            YamaroError: a mesh lies where it may not be read, or the time is over.
            UsageError: the robot has no joint of a given name.
            NoOpenGLError: nothing can be drawn on this system.
        """
        vtkObject.GlobalWarningDisplayOff()
        self._request = request
        self._robot = drawable_robot(build)
        self._shapes = shapes_of(self._robot, build.finder)
        self.remarks: list[str] = []
        self._moments = moments(request, self._robot, read_positions(request, self._robot))
        self._reader = reader
        shows = self._shows()
        paths = [shape.path for shape in self._shapes if shape.is_shown(shows)]
        meshes = read_meshes([path for path in paths if path], build.finder.allows, reader)
        is_large = request.width * request.height > MOST_SHARP_PIXELS
        sharpness = 1 if is_large else SHARPNESS
        self._stage = Stage(request.width, request.height, sharpness=sharpness)
        self._figure = Figure(self._robot, self._shapes, self._stage, shows, Meshes(meshes))

    @property
    def warnings(self) -> list[Diagnostic]:
        """Return the warnings about meshes."""
        return self._figure.warnings

    def _shows(self) -> set[str]:
        """Return what to show: something else where all that was asked for is not there."""
        shows = set(self._request.shows)
        shapes = self._shapes
        if shows <= {VISUAL, GRID} and not any(shape.is_visual for shape in shapes):
            other = COLLISION if shapes else FRAMES
            what = "collision shapes" if shapes else "frames"
            self.remarks.append(f"the robot has no visual shapes; its {what} are shown instead")
            shows.add(other)
        return shows

    def frames(self) -> Iterator[Image]:
        """Yield the pictures, height×width×4 from 0 to 255: one, or those of a film."""
        points = self._points_of_all()
        low = float(points[:, 2].min())
        extent = float(np.ptp(points, axis=0).max()) or 1.0
        cameras = self._cameras(points)
        before: Moment | None = None
        for moment, row in zip(self._moments, cameras, strict=True):
            self._reader.check_time()
            if before is None or before.positions != moment.positions:
                self._figure.set_positions(moment.positions)
                self._figure.lay_floor(low, extent)
            before = moment
            yield _sheet([self.shot(camera) for camera in row])

    def outline(self) -> Floats:
        """Return the points of the first picture, N×3, with the floor below them."""
        self._figure.set_positions(self._moments[0].positions)
        points = self._figure.outline()
        extent = float(np.ptp(points, axis=0).max()) or 1.0
        self._figure.lay_floor(float(points[:, 2].min()), extent)
        return points

    def shot(self, camera: Camera) -> Image:
        """Return the picture that a camera takes of the robot as it is now, height×width×4."""
        return self._stage.picture(
            camera,
            is_transparent=self._request.is_transparent,
            has_floor=bool(camera.position[2] >= camera.target[2]),
        )

    def _points_of_all(self) -> Floats:
        """Return all points that the robot has at any time, N×3."""
        found = []
        before: Moment | None = None
        for moment in self._moments:
            self._reader.check_time()
            if before is None or before.positions != moment.positions:
                self._figure.set_positions(moment.positions)
                found.append(self._figure.outline())
            before = moment
        return np.concatenate(found)

    def _cameras(self, points: Floats) -> list[list[Camera]]:
        """Return the cameras of each moment, one for each view."""
        aspect = self._request.width / self._request.height
        columns = []
        for view in self._request.views:
            if self._request.turns:
                views = [view.turned(moment.turn) for moment in self._moments]
                columns.append(fitted_around(views, points, aspect))
            else:
                columns.append([fitted(view, points, aspect)] * len(self._moments))
        flat = [camera for column in columns for camera in column if camera.is_flat]
        for camera in flat:  # at one scale, as in drawings
            camera.height = max(each.height for each in flat)
        return [list(row) for row in zip(*columns, strict=True)]


def _sheet(images: list[Image]) -> Image:
    """Return pictures of one size side by side, in as many rows as columns or one less."""
    columns = int(np.ceil(np.sqrt(len(images))))
    missing = -len(images) % columns
    blank = np.zeros_like(images[0])
    if images[0][..., 3].min() == 255:
        blank[...] = 255
    cells = [*images, *[blank] * missing]
    rows = [np.hstack(cells[start : start + columns]) for start in range(0, len(cells), columns)]
    return np.vstack(rows)
