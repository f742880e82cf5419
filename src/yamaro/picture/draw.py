"""The drawing of a robot as it is asked for, and its file: PNG, JPEG, GIF."""

from __future__ import annotations

from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np
import PIL.Image
from vtkmodules.vtkCommonCore import vtkObject

from .figure import Figure, drawable_robot, shapes_of
from .meshes import Meshes, read_meshes
from .request import COLLISION, FRAMES, GRID, VISUAL, moments, read_positions
from .stage import Stage, fitted, fitted_around

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from numpy.typing import NDArray

    from ..confined import Reader
    from ..diagnostics import Diagnostic
    from ..model.extras import Fitted
    from ..result import Build
    from .request import Moment, Request
    from .stage import Camera

    Floats = NDArray[np.floating[Any]]
    Image = NDArray[np.uint8]

SHARPNESS = 2
"""How many times as wide and high pictures are drawn before they are made small."""

MOST_FITS = 8
"""Shapes that a remark says how close they are to their mesh; of more, those that are farthest."""

MOST_SHARP_PIXELS = 1 << 22
"""Larger pictures are drawn as they are: drawing takes some 100 bytes for each pixel."""


def _fits(fits: Iterable[Fitted]) -> list[str]:
    """Return how close the collision shapes that were worked out are to their meshes."""
    every = [each for each in fits if each.section == "collision"]
    far = sorted(every, key=lambda each: -each.distance / (each.size or 1.0))[:MOST_FITS]
    said = [f"'{each.link}', {each.asked}: {each.quality()}" for each in every if each in far]
    left = len(every) - len(far)
    return said + ([f"{left} more collision shapes are closer to their meshes"] if left else [])


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
        shows = set(self._request.shows)
        shapes = self._shapes
        if shows <= {VISUAL, GRID} and not any(shape.is_visual for shape in shapes):
            other = COLLISION if shapes else FRAMES
            what = "collision shapes" if shapes else "frames"
            self.remarks.append(f"the robot has no visual shapes; its {what} are shown instead")
            shows.add(other)
        paths = [shape.path for shape in self._shapes if shape.is_shown(shows)]
        meshes = read_meshes([path for path in paths if path], build.finder.allows, reader)
        is_large = request.width * request.height > MOST_SHARP_PIXELS
        sharpness = 1 if is_large else SHARPNESS
        self._stage = Stage(request.width, request.height, sharpness=sharpness)
        self._figure = Figure(self._robot, self._shapes, self._stage, shows, Meshes(meshes))
        if COLLISION in shows:
            self.remarks += _fits(build.robot.fits)

    @property
    def warnings(self) -> list[Diagnostic]:
        """Return the warnings about meshes."""
        return self._figure.warnings

    def frames(self) -> Iterator[Image]:
        """Yield the pictures, height×width×4 from 0 to 255: one, or those of a film."""
        found = []
        before: Moment | None = None
        for moment in self._moments:
            self._reader.check_time()
            if before is None or before.positions != moment.positions:
                self._figure.set_positions(moment.positions)
                found.append(self._figure.outline())
            before = moment
        points = np.concatenate(found)
        low = float(points[:, 2].min())
        extent = float(np.ptp(points, axis=0).max()) or 1.0
        cameras = self._cameras(points)
        before = None
        for moment, row in zip(self._moments, cameras, strict=True):
            self._reader.check_time()
            if before is None or before.positions != moment.positions:
                self._figure.set_positions(moment.positions)
                self._figure.lay_floor(low, extent)
            before = moment
            images = [self.shot(camera) for camera in row]
            # As many rows as columns, or one less.
            columns = int(np.ceil(np.sqrt(len(images))))
            missing = -len(images) % columns
            blank = np.zeros_like(images[0])
            if images[0][..., 3].min() == 255:
                blank[...] = 255
            cells = [*images, *[blank] * missing]
            rows = [
                np.hstack(cells[start : start + columns]) for start in range(0, len(cells), columns)
            ]
            yield np.vstack(rows)

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


# --- files ------------------------------------------------------------------------------------


PALETTE_FRAMES = 8
"""Frames of a GIF that its colours are taken from."""

NEARLY_WHITE = 248

COLORS = 255
"""Colours of a GIF; one more is for what is clear."""


def still(image: Image, ending: str) -> bytes:
    """Return a picture, height×width×4, as a PNG or JPEG."""
    file = BytesIO()
    picture = PIL.Image.fromarray(image)
    is_opaque = bool((image[..., 3] == 255).all())
    if ending == ".png":
        (picture.convert("RGB") if is_opaque else picture).save(file, "PNG", optimize=True)
    else:
        picture.convert("RGB").save(file, "JPEG", quality=92, subsampling=0)
    return file.getvalue()


def gif(frames: Iterable[Image], rate: float) -> bytes:
    """Return pictures as a GIF that repeats; half-transparent pixels become opaque or clear."""
    images = [PIL.Image.fromarray(frame) for frame in frames]
    chosen = images[:: max(len(images) // PALETTE_FRAMES, 1)]
    width, height = images[0].size
    all_chosen = PIL.Image.new("RGB", (width, height * len(chosen)))
    for number, image in enumerate(chosen):
        all_chosen.paste(image.convert("RGB"), (0, number * height))
    palette = all_chosen.quantize(COLORS, PIL.Image.Quantize.MEDIANCUT)
    # The brightest colours become white, as the background of pictures is: Pillow takes colours for
    # the same that differ by less than four.
    colors = np.array(palette.getpalette()).reshape(-1, 3)
    colors[colors.sum(axis=1).argmax()] = 255
    colors[colors.min(axis=1) >= NEARLY_WHITE] = 255
    palette.putpalette(colors.ravel().tolist())
    palette.load()  # which is when Pillow takes the palette over
    pages = [_page(image, palette) for image in images]
    file = BytesIO()
    pages[0].save(
        file,
        "GIF",
        save_all=True,
        append_images=pages[1:],
        # A GIF counts in hundredths of a second; viewers slow down what is faster than two.
        duration=max(round(100 / rate), 2) * 10,
        loop=0,
        disposal=2 if pages[0].info.get("transparency") is not None else 1,
        optimize=False,
    )
    return file.getvalue()


def _page(image: PIL.Image.Image, palette: PIL.Image.Image) -> PIL.Image.Image:
    page = image.convert("RGB").quantize(palette=palette, dither=PIL.Image.Dither.NONE)
    alpha = image.getchannel("A")
    if alpha.getextrema()[0] == 255:
        return page
    page.paste(COLORS, mask=alpha.point([255] * 128 + [0] * 128))
    page.info["transparency"] = COLORS
    return page
