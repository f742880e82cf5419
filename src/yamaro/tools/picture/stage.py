"""The stage: a robot's bodies, lights and floor, and pictures of them from a camera."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import PIL.Image
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 - registers what draws with OpenGL
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
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

from .bodies import lines_body
from .cameras import VIEW_ANGLE
from .floor import Shadow, grid_lines
from .window import make_window

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from vtkmodules.vtkCommonDataModel import vtkPolyData

    from .cameras import Camera

    Floats = NDArray[np.floating[Any]]
    Image = NDArray[np.uint8]
    Color = tuple[float, float, float]

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
        self._add_lights()

    def _add_lights(self) -> None:
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
        actor = self.add(lines_body(ends), color, opacity)
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
        self._aim(camera)
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

    def _aim(self, camera: Camera) -> None:
        own = self._renderer.GetActiveCamera()
        own.SetPosition(*camera.position)
        own.SetFocalPoint(*camera.target)
        own.SetViewUp(*camera.up)
        own.SetViewAngle(VIEW_ANGLE)
        own.SetParallelProjection(camera.is_flat)
        own.SetParallelScale(camera.height / 2)
        self._renderer.ResetCameraClippingRange()

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
