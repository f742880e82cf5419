"""The stage: cameras, lights, the floor with shadow and grid, and a window on no screen."""

from __future__ import annotations

import ctypes
import os
import sys
from math import floor, log10, radians, tan
from typing import TYPE_CHECKING, Any

import numpy as np
import PIL.Image
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 - registers what draws with OpenGL
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkLight,
    vtkPolyDataMapper,
    vtkTexture,
    vtkWindowToImageFilter,
)
from vtkmodules.vtkRenderingOpenGL2 import vtkOpenGLRenderer

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray
    from vtkmodules.vtkCommonDataModel import vtkPolyData

    from .request import View

    Floats = NDArray[np.floating[Any]]
    Image = NDArray[np.uint8]
    Color = tuple[float, float, float]


# --- the floor --------------------------------------------------------------------------------


CELLS = 192
"""Cells of the shadow along each side."""

DARKNESS = 0.5
"""How dark the shadow is where the robot touches the floor, from 0 to 1."""


class Shadow:
    """The shadow that light from everywhere leaves on the floor: dark where something is near it.

    Attributes:
        alpha: how dark each cell is, from 0 to 1; rows along y, columns along x.
        low, high: opposite corners of it on the floor, x and y in metres.
    """

    __slots__ = ("alpha", "high", "low")

    def __init__(self, samples: Floats, level: float, size: float) -> None:
        """Work it out.

        Args:
            samples: points all over the surface of the robot, N×3.
            level: the height of the floor.
            size: how large the robot is, in metres.
        """
        middle = (samples[:, :2].min(axis=0) + samples[:, :2].max(axis=0)) / 2
        extent = float((samples[:, :2].max(axis=0) - samples[:, :2].min(axis=0)).max())
        half = extent / 2 + 0.35 * size
        self.low, self.high = middle - half, middle + half
        cells = ((samples[:, :2] - self.low) / (2 * half) * CELLS).astype(int).clip(0, CELLS - 1)
        near = np.exp(-(samples[:, 2] - level).clip(0) / (0.12 * size))
        dark = np.zeros((CELLS, CELLS))
        np.maximum.at(dark, (cells[:, 1], cells[:, 0]), near)
        soft = 0.02 * size / (2 * half) * CELLS
        contact, around = _blurred(dark, soft), _blurred(dark, 4 * soft)
        self.alpha = (DARKNESS * (0.6 * contact + 0.7 * around)).clip(0, 1)


def surface_samples(points: Floats, triangles: NDArray[np.integer[Any]], count: int) -> Floats:
    """Return points all over a surface, the same each time, count×3."""
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    total = areas.sum()
    if not total > 0:
        return points[:count]
    source = np.random.default_rng(0)
    chosen = source.choice(len(triangles), count, p=areas / total)
    u, v = source.random((2, count, 1))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    samples: Floats = a[chosen] + u * (b - a)[chosen] + v * (c - a)[chosen]
    return samples


def grid_step(size: float) -> float:
    """Return the distance between lines, 1, 2 or 5 times a power of ten, for about ten of them."""
    power = 10.0 ** floor(log10(size / 10))
    return next(factor * power for factor in (1, 2, 5, 10) if factor * power >= size / 10)


def grid_lines(middle: Floats, size: float, level: float) -> Floats:
    """Return lines on the floor around a point, at round coordinates, as pairs of points N×2×3."""
    step = grid_step(size)
    count = int(1.2 * size / step) + 1
    low = (np.round(middle[:2] / step) - count) * step
    along = np.arange(2 * count + 1) * step
    span = along[-1]
    lines = []
    for axis in (0, 1):
        ends = np.zeros((len(along), 2, 3))
        ends[:, :, axis] = (low[axis] + along)[:, None]
        ends[:, 0, 1 - axis] = low[1 - axis]
        ends[:, 1, 1 - axis] = low[1 - axis] + span
        ends[:, :, 2] = level
        lines.append(ends)
    return np.concatenate(lines)


def _blurred(image: Floats, width: float) -> Floats:
    """Return an image blurred by a bell curve of this width, in cells."""
    radius = max(int(3 * width), 1)
    weights = np.exp(-0.5 * (np.arange(-radius, radius + 1) / max(width, 0.3)) ** 2)
    weights /= weights.sum()
    for _ in range(2):
        image = np.stack([np.convolve(row, weights, "same") for row in image]).T
    return image


# --- cameras ----------------------------------------------------------------------------------


VIEW_ANGLE = 24.0
"""The angle between the upper and the lower border of a picture, in degrees."""

MARGIN = 1.12
"""The width of what is seen, in widths of the robot."""


def axes_of(view: View) -> Floats:
    """Return right, up, and the direction to the camera, as rows, 3×3."""
    a, e = radians(view.azimuth), radians(view.elevation)
    right = [-np.sin(a), np.cos(a), 0.0]
    back = [np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)]
    return np.array([right, np.cross(back, right), back])


class Camera:
    """A camera: where it is, what it looks at, and how much of that it sees.

    Attributes:
        position, target: points in metres.
        up: the direction that is up in the picture.
        height: of what is seen in the plane of the target, in metres.
    """

    __slots__ = ("height", "is_flat", "position", "target", "up")

    def __init__(self, view: View, target: Floats, distance: float, radius: float) -> None:
        """Look at a target.

        Args:
            view: from where.
            target: a point in metres.
            distance: how far from it what is seen is as wide as the view angle says, in metres.
            radius: of what is seen, around the target; the camera of a flat view is outside of it.
        """
        _, up, back = axes_of(view)
        self.is_flat = view.is_flat
        self.position = target + (distance + 2 * radius if view.is_flat else distance) * back
        self.target = target
        self.up = up
        self.height = 2 * distance * tan(radians(VIEW_ANGLE / 2))


def fitted(view: View, points: Floats, aspect: float) -> Camera:
    """Return the camera that has all points in its picture, as large as possible.

    Args:
        view: from where.
        points: N×3, in metres.
        aspect: width by height of the picture.
    """
    axes = axes_of(view)
    center = (points.min(axis=0) + points.max(axis=0)) / 2
    right, up, depth = axes @ (points - center).T
    slope = tan(radians(VIEW_ANGLE / 2))
    slopes = (slope * aspect / MARGIN, slope / MARGIN)
    distances, shifts = [], []
    for across, each in zip((right, up), slopes, strict=True):
        # A point is in if its place across is at most `each` times its distance from the camera.
        near = 0.0 if view.is_flat else each
        high, low = (across + near * depth).max(), (near * depth - across).max()
        distances.append((high + low) / (2 * each))
        shifts.append((high - low) / 2)
    target = center + shifts[0] * axes[0] + shifts[1] * axes[1]
    return Camera(view, target, _safe(max(distances)), float(abs(depth).max()))


def fitted_around(views: Sequence[View], points: Floats, aspect: float) -> list[Camera]:
    """Return cameras at one distance, for views of one film, that all have all points in.

    Args:
        views: from where.
        points: N×3, in metres.
        aspect: width by height of the picture.
    """
    center = (points.min(axis=0) + points.max(axis=0)) / 2
    slope = tan(radians(VIEW_ANGLE / 2)) / MARGIN
    distance = 0.0
    for view in views:
        right, up, depth = axes_of(view) @ (points - center).T
        needed = np.maximum(abs(right) / (slope * aspect), abs(up) / slope)
        distance = max(distance, (needed + (0.0 if view.is_flat else depth)).max())
    radius = float(np.linalg.norm(points - center, axis=1).max())
    return [Camera(view, center, _safe(distance), radius) for view in views]


def _safe(distance: float) -> float:
    """Return a distance that is not 0, for a robot without extent."""
    return distance if distance > 1e-6 else 1.0


# --- stage ------------------------------------------------------------------------------------


WHITE: Color = (1.0, 1.0, 1.0)
GRID: Color = (0.62, 0.66, 0.70)
DARKEST = 0.05
"""How bright black is drawn: nothing is so black that its form is not seen."""
LIGHTS = (  # where it is, from the camera, and how bright
    ((-0.7, 0.9, 1.0), 0.76),
    ((1.0, 0.2, 0.7), 0.40),
    ((0.1, 1.0, -0.6), 0.30),
)


class Stage:
    """Draws bodies."""

    def __init__(self, width: int, height: int, *, sharpness: int) -> None:
        """Set up a window and lights.

        Args:
            width: of the pictures, in pixels.
            height: of the pictures, in pixels.
            sharpness: how many times as wide and high they are drawn before they are made small.

        Raises:
            NoOpenGLError: nothing can be drawn on this system.
        """
        self.width, self.height = width, height
        self._sharpness = sharpness
        self._window = make_window()
        self._window.SetMultiSamples(0)
        self._window.SetSize(width * sharpness, height * sharpness)
        self._renderer = vtkOpenGLRenderer()
        self._window.AddRenderer(self._renderer)
        self._renderer.SetUseDepthPeeling(True)
        self._renderer.SetMaximumNumberOfPeels(8)
        self._renderer.UseFXAAOn()
        self._floor: list[vtkActor] = []
        self._renderer.AutomaticLightCreationOff()
        for position, intensity in LIGHTS:
            light = vtkLight()
            light.SetLightTypeToCameraLight()
            light.SetPosition(*position)
            light.SetFocalPoint(0, 0, 0)
            light.SetIntensity(intensity)
            self._renderer.AddLight(light)

    def shade_corners(self, size: float) -> None:
        """Darken corners and gaps, for a robot of this size in metres."""
        self._renderer.UseSSAOOn()
        self._renderer.SetSSAORadius(0.12 * size)
        self._renderer.SetSSAOBias(0.002 * size)
        self._renderer.SetSSAOKernelSize(32)
        self._renderer.SSAOBlurOn()

    def add(
        self, body: vtkPolyData, color: Color, opacity: float = 1.0, *, shine: float = 0.18
    ) -> vtkActor:
        """Add a body and return it, to be moved; colours of its own corners go before `color`."""
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(body)
        actor = vtkActor()
        actor.SetMapper(mapper)
        look = actor.GetProperty()
        look.SetColor(*(DARKEST + (1 - DARKEST) * part for part in color))
        look.SetOpacity(opacity)
        look.SetAmbient(0.27)
        look.SetDiffuse(0.82)
        look.SetSpecular(shine)
        look.SetSpecularPower(28)
        self._renderer.AddActor(actor)
        return actor

    def add_lines(self, ends: Floats, color: Color, width: float, opacity: float = 1.0) -> vtkActor:
        """Add lines between pairs of points, N×2×3, of a width in pixels."""
        body = vtkPolyData()
        body.SetPoints(make_points(ends.reshape(-1, 3)))
        body.SetLines(make_cells(np.arange(2 * len(ends)).reshape(-1, 2)))
        actor = self.add(body, color, opacity)
        actor.GetProperty().LightingOff()
        actor.GetProperty().SetLineWidth(width * self._sharpness)
        return actor

    def remove(self, actor: vtkActor) -> None:
        """Take a body away."""
        self._renderer.RemoveActor(actor)

    def lay_floor(self, shadow: Shadow, level: float, *, size: float, has_grid: bool) -> None:
        """Put a floor under the robot, in place of the last one."""
        for actor in self._floor:
            self._renderer.RemoveActor(actor)
        self._floor = [self._add_shadow(shadow, level - 1e-4 * size)]
        if has_grid:
            middle = (shadow.low + shadow.high) / 2
            lines = grid_lines(middle, size, level - 2e-4 * size)
            self._floor.append(self.add_lines(lines, GRID, 0.8, 0.55))

    def _add_shadow(self, shadow: Shadow, level: float) -> vtkActor:
        (x0, y0), (x1, y1) = shadow.low, shadow.high
        plane = vtkPlaneSource()
        plane.SetOrigin(x0, y0, level)
        plane.SetPoint1(x1, y0, level)
        plane.SetPoint2(x0, y1, level)
        plane.Update()
        pixels = np.zeros((*shadow.alpha.shape, 4), np.uint8)
        pixels[..., :3] = (28, 36, 48)
        pixels[..., 3] = np.round(255 * shadow.alpha)
        actor = self.add(plane.GetOutput(), (1.0, 1.0, 1.0))
        actor.SetTexture(make_texture(pixels))
        actor.GetProperty().LightingOff()
        actor.ForceTranslucentOn()
        return actor

    def picture(
        self, camera: Camera, *, is_transparent: bool = False, has_floor: bool = True
    ) -> Image:
        """Return a picture as height×width×4 from 0 to 255, its first row on top."""
        own = self._renderer.GetActiveCamera()
        own.SetPosition(*camera.position)
        own.SetFocalPoint(*camera.target)
        own.SetViewUp(*camera.up)
        own.SetViewAngle(VIEW_ANGLE)
        own.SetParallelProjection(camera.is_flat)
        own.SetParallelScale(camera.height / 2)
        self._renderer.ResetCameraClippingRange()
        for actor in self._floor:
            actor.SetVisibility(has_floor)
        if not is_transparent:
            self._renderer.SetBackground(*WHITE)
            return _smaller(self._shot(), self._sharpness)
        shots = []
        for brightness in (0.0, 1.0):
            self._renderer.SetBackground(brightness, brightness, brightness)
            shots.append(self._shot())
        return _smaller(_with_alpha(*shots), self._sharpness)

    def _shot(self) -> Image:
        """Return what the window shows, in full size, height×width×3."""
        self._window.Render()
        grab = vtkWindowToImageFilter()
        grab.SetInput(self._window)
        grab.ReadFrontBufferOff()
        grab.ShouldRerenderOff()
        grab.Update()
        pixels = vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars())
        shape = (self.height * self._sharpness, self.width * self._sharpness, 3)
        shot: Image = pixels.reshape(shape)[::-1]
        return shot


def _with_alpha(black: Image, white: Image) -> Image:
    """Return the picture that on black and on white looks like these two."""
    dark = black.astype(np.float32)
    alpha = (255 - (white - dark).mean(axis=2, keepdims=True)).clip(0, 255)
    color = (dark / np.maximum(alpha / 255, 1e-3)).clip(0, 255)
    image: Image = np.round(np.dstack([color, alpha])).astype(np.uint8)
    return image


def _smaller(pixels: Image, times: int) -> Image:
    """Return an image made smaller, with alpha; clear pixels give no colour to others."""
    image = PIL.Image.fromarray(np.ascontiguousarray(pixels))
    if image.mode == "RGBA":
        image = image.convert("RGBa")
    return np.asarray(image.reduce(times).convert("RGBA"))


def make_points(points: Floats) -> vtkPoints:
    """Return points, N×3, as VTK has them."""
    made = vtkPoints()
    made.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    return made


def make_cells(indices: NDArray[np.integer[Any]]) -> vtkCellArray:
    """Return polygons or lines with as many corners each, N×corners, as VTK has them."""
    count, corners = indices.shape
    cells = vtkCellArray()
    cells.SetData(
        numpy_to_vtkIdTypeArray(np.arange(count + 1) * corners, deep=True),
        numpy_to_vtkIdTypeArray(np.ascontiguousarray(indices, np.int64).ravel(), deep=True),
    )
    return cells


def make_texture(pixels: Image) -> vtkTexture:
    """Return an image, its first row at the bottom, as a texture."""
    height, width, depth = pixels.shape
    image = vtkImageData()
    image.SetDimensions(width, height, 1)
    flat = np.ascontiguousarray(pixels).reshape(-1, depth)
    image.GetPointData().SetScalars(numpy_to_vtk(flat, deep=True))
    texture = vtkTexture()
    texture.SetInputData(image)
    texture.InterpolateOn()
    return texture


def make_matrix(rows: list[list[float]] | Floats) -> vtkMatrix4x4:
    """Return a 4×4 matrix as VTK has it."""
    matrix = vtkMatrix4x4()
    for i in range(4):
        for j in range(4):
            matrix.SetElement(i, j, rows[i][j])
    return matrix


# --- the window -------------------------------------------------------------------------------


DEBIAN_PACKAGES = "libegl1 libgl1-mesa-dri"
EGL_LIBRARY = "libEGL.so.1"
SOFTWARE_LIBRARIES = ("libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so")
DEVICE_PLATFORM = 0x313F
"""EGL_PLATFORM_DEVICE_EXT."""
MOST_DEVICES = 8


class NoOpenGLError(Exception):
    """Nothing can be drawn on this system; the text says what to install."""


def make_window() -> Any:
    """Return VTK's window for pictures.

    On Linux that is one of EGL, which needs neither a display nor a graphics card, or else one of
    OSMesa. Without its libraries VTK would end the process, so they are looked for first.

    Raises:
        NoOpenGLError: neither is there.
    """
    if sys.platform != "linux":
        import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 - registers the window of the system
        from vtkmodules.vtkRenderingCore import vtkRenderWindow

        window: Any = vtkRenderWindow()
    else:
        from vtkmodules import vtkRenderingOpenGL2

        if _has_egl():
            window = vtkRenderingOpenGL2.vtkEGLRenderWindow()
        elif any(map(_loads, SOFTWARE_LIBRARIES)):
            window = vtkRenderingOpenGL2.vtkOSOpenGLRenderWindow()
        else:
            raise NoOpenGLError(f"on Debian and Ubuntu: apt install {DEBIAN_PACKAGES}")
    window.SetOffScreenRendering(True)
    return window


def _loads(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def _has_egl() -> bool:
    """Return whether EGL has a device to draw with: the library may be there without a driver.

    Source: the extensions EGL_EXT_device_enumeration and EGL_EXT_platform_device.
    """
    os.environ.setdefault("EGL_LOG_LEVEL", "fatal")  # else it reports each driver it lacks
    try:
        egl = ctypes.CDLL(EGL_LIBRARY)
    except OSError:
        return False
    find = egl.eglGetProcAddress
    find.restype, find.argtypes = ctypes.c_void_p, [ctypes.c_char_p]
    query, get_display = find(b"eglQueryDevicesEXT"), find(b"eglGetPlatformDisplayEXT")
    if not query or not get_display:
        return False
    pointer, integer = ctypes.c_void_p, ctypes.c_int
    devices, count = (pointer * MOST_DEVICES)(), integer(0)
    ask = ctypes.CFUNCTYPE(integer, integer, pointer, pointer)(query)
    if not ask(MOST_DEVICES, devices, ctypes.byref(count)) or not count.value:
        return False
    display_of = ctypes.CFUNCTYPE(pointer, integer, pointer, pointer)(get_display)
    egl.eglInitialize.argtypes = [pointer, pointer, pointer]
    return any(
        egl.eglInitialize(display_of(DEVICE_PLATFORM, device, None), None, None)
        for device in devices[: count.value]
    )
