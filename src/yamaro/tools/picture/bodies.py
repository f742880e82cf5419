"""What is drawn of a robot as VTK's polygons: shapes, meshes, frames, boxes of equal inertia."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkCleanPolyData, vtkPolyDataNormals
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkCylinderSource, vtkSphereSource

from ...model.shapes import Box, Capsule, Cylinder, Sphere
from .shapes import LARGEST

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from ...meshes.surfaces import Surface
    from ...model.link import Inertial
    from ...model.shapes import Shape

    Floats = NDArray[np.floating[Any]]

ROUND = 64
"""Corners of a circle."""

SHARP = 32.0
"""The angle in degrees from which an edge between two triangles is seen as one."""


def shape_body(shape: Shape) -> vtkPolyData:
    """Return the polygons of a shape that is not a mesh, in its own frame."""
    match shape:
        case Box():
            return box_body(shape.size)
        case Sphere():
            return sphere_body(shape.radius)
        case Cylinder():
            return cylinder_body(shape.radius, shape.length)
        case Capsule():
            return cylinder_body(shape.radius, shape.length, is_capsule=True)
        case _:
            raise AssertionError(shape.kind)


def box_body(size: Sequence[float]) -> vtkPolyData:
    """Return a box around the origin, with edges of these lengths in metres."""
    source = vtkCubeSource()
    source.SetXLength(size[0])
    source.SetYLength(size[1])
    source.SetZLength(size[2])
    return _output(source)


def sphere_body(radius: float) -> vtkPolyData:
    """Return a ball around the origin."""
    source = vtkSphereSource()
    source.SetRadius(radius)
    source.SetThetaResolution(ROUND)
    source.SetPhiResolution(ROUND // 2)
    return _output(source)


def cylinder_body(radius: float, length: float, *, is_capsule: bool = False) -> vtkPolyData:
    """Return a cylinder around the origin, along z; a capsule has half a ball at each end."""
    source = vtkCylinderSource()
    source.SetRadius(radius)
    source.SetHeight(length)
    source.SetResolution(ROUND)
    source.SetCapsuleCap(is_capsule)
    return _upright(source)


def surface_body(surface: Surface, scale: Sequence[float]) -> vtkPolyData:
    """Return the polygons of a mesh's surface, scaled along its axes."""
    body = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(surface.points * scale), deep=True))
    body.SetPoints(points)
    is_mirrored = scale[0] * scale[1] * scale[2] < 0
    triangles = surface.triangles[:, ::-1] if is_mirrored else surface.triangles
    body.SetPolys(_cells(triangles))
    if surface.point_colors is not None:
        colors = numpy_to_vtk(np.ascontiguousarray(surface.point_colors), deep=True)
        body.GetPointData().SetScalars(colors)
    if surface.texture_points is None or surface.normals is None:
        return smoothed(body)
    places = numpy_to_vtk(np.ascontiguousarray(surface.texture_points, np.float32), deep=True)
    body.GetPointData().SetTCoords(places)
    directions = surface.normals / np.where(np.array(scale) == 0, 1, scale)
    directions /= np.maximum(np.linalg.norm(directions, axis=1, keepdims=True), 1e-12)
    body.GetPointData().SetNormals(numpy_to_vtk(np.ascontiguousarray(directions), deep=True))
    return body


def smoothed(body: vtkPolyData) -> vtkPolyData:
    """Return polygons with normals that make round what is round, and keep sharp edges sharp."""
    merge = vtkCleanPolyData()
    merge.SetInputData(body)
    merge.SetTolerance(1e-6)
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(merge.GetOutputPort())
    normals.SetFeatureAngle(SHARP)
    normals.ConsistencyOff()
    return _output(normals)


def inertia_box(inertial: Inertial) -> tuple[Floats, Floats] | None:
    """Return the box of even density that has the mass and moments of a link.

    With principal moments I₁ ≤ I₂ ≤ I₃ and edges a, b, c along their axes, I₁ = m/12·(b² + c²) and
    so on; so a² = 6/m·(I₂ + I₃ − I₁). A moment that no body can have gives an edge of 0.

    Returns:
        The edges in metres, and their directions as columns in the frame of the inertial; None
        without mass, or of a size that nothing has.
    """
    if not inertial.mass > 0:
        return None
    moments, axes = np.linalg.eigh(inertial.matrix())
    if np.linalg.det(axes) < 0:
        axes[:, 2] *= -1
    edges = np.sqrt(np.maximum(6 / inertial.mass * (moments.sum() - 2 * moments), 0))
    return (edges, axes) if edges.max() <= LARGEST else None


def axes_bodies(length: float) -> list[tuple[vtkPolyData, tuple[float, float, float]]]:
    """Return three arms along x, y and z with their colours, red, green and blue."""
    thickness = length / 16
    turns = ((90.0, 0.0, 1.0, 0.0), (-90.0, 1.0, 0.0, 0.0), None)
    colors = ((0.86, 0.16, 0.19), (0.18, 0.62, 0.24), (0.16, 0.36, 0.86))
    found = []
    for turn, color in zip(turns, colors, strict=True):
        transform = vtkTransform()
        if turn is not None:
            transform.RotateWXYZ(*turn)
        transform.Translate(0, 0, length / 2)
        found.append((_moved(cylinder_body(thickness, length), transform), color))
    return found


def lines_body(ends: Floats) -> vtkPolyData:
    """Return lines between pairs of points, N×2×3."""
    body = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(ends.reshape(-1, 3)), deep=True))
    body.SetPoints(points)
    body.SetLines(_cells(np.arange(2 * len(ends)).reshape(-1, 2)))
    return body


def joined(bodies: Sequence[vtkPolyData]) -> vtkPolyData:
    """Return several bodies as one."""
    append = vtkAppendPolyData()
    for body in bodies:
        append.AddInputData(body)
    return _output(append)


def corners_of(body: vtkPolyData) -> Floats:
    """Return the points of a body, N×3."""
    if not body.GetNumberOfPoints():
        return np.zeros((0, 3))
    points: Floats = vtk_to_numpy(body.GetPoints().GetData()).astype(float)
    return points


def _cells(indices: NDArray[np.integer[Any]]) -> vtkCellArray:
    count, corners = indices.shape
    cells = vtkCellArray()
    cells.SetData(
        numpy_to_vtkIdTypeArray(np.arange(count + 1) * corners, deep=True),
        numpy_to_vtkIdTypeArray(np.ascontiguousarray(indices, np.int64).ravel(), deep=True),
    )
    return cells


def _upright(source: Any) -> vtkPolyData:
    """Turn a body from VTK's axis, y, to z."""
    turn = vtkTransform()
    turn.RotateX(90)
    return _moved(_output(source), turn)


def _moved(body: vtkPolyData, transform: vtkTransform) -> vtkPolyData:
    move = vtkTransformPolyDataFilter()
    move.SetInputData(body)
    move.SetTransform(transform)
    return _output(move)


def _output(algorithm: Any) -> vtkPolyData:
    algorithm.Update()
    return algorithm.GetOutput()
