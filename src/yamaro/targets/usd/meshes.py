"""Meshes of USD, and the prototypes that shapes are instances of.

A prototype is a class in `meshes`, with a mesh for each surface. All shapes of one file and scale
are instances of it, or of that of collisions, which has the same triangles. So are boxes,
cylinders and spheres that are seen: renderers and validators of assets take meshes, and collisions
stay exact shapes. A round shape has `SIDES` sides, whose corners are on it.
"""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

from pxr import Gf, Sdf, UsdGeom, Vt

from ...model.shapes import Box, Capsule, Cylinder, Sphere

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from typing import Any

    from numpy.typing import NDArray
    from pxr import Usd

    from ...meshes.surfaces import Surface
    from ...model.shapes import Mesh, SimpleShape
    from .prims import Writing

    Array = NDArray[Any]
    Faces = Sequence[Sequence[int]]

SIDES = 32
"""Sides around a round shape, which are at most 0.5 % of its radius off it."""


class Prototypes:
    """Makes the prototypes of one robot when they are asked for."""

    __slots__ = ("_folder", "_known", "_names", "_root", "_stage")

    def __init__(self, writing: Writing) -> None:
        self._stage, self._names, self._root = writing.stage, writing.names, writing.root
        self._folder = ""
        self._known: dict[tuple[object, ...], str] = {}

    def of_mesh(
        self,
        shape: Mesh,
        stem: str,
        surfaces: Iterable[Surface],
        *,
        key: tuple[str, ...],
        finish: Callable[[Usd.Prim, Surface], None],
    ) -> str:
        """Return the path of the prototype of a file at a scale.

        Args:
            shape: the shape.
            stem: what the prototype is called.
            surfaces: what is in the file.
            key: what else makes it another prototype.
            finish: gives a new mesh what it has besides its triangles.
        """
        known = (shape.filename, shape.scale, *key)
        if known not in self._known:
            path = self._known[known] = self._new(stem)
            for index, surface in enumerate(surfaces):
                mesh = UsdGeom.Mesh.Define(self._stage, self._names.new(path, "mesh"))
                shared = self._triangles(stem, shape, index, surface)
                mesh.GetPrim().GetReferences().AddInternalReference(shared)
                finish(mesh.GetPrim(), surface)
        return self._known[known]

    def of_simple(
        self, shape: SimpleShape, *, has_texture: bool
    ) -> tuple[str, tuple[float, float, float]]:
        """Return the path of the prototype of a simple shape, and the scale of its instance.

        Args:
            shape: the shape.
            has_texture: whether it needs to know where a texture is on it.
        """
        key: tuple[object, ...]
        scale: tuple[float, float, float]
        if isinstance(shape, Box):
            key, scale = (shape.kind,), (shape.size[0], shape.size[1], shape.size[2])
        elif isinstance(shape, Sphere):
            key, scale = (shape.kind,), (shape.radius, shape.radius, shape.radius)
        elif isinstance(shape, Cylinder):
            key, scale = (shape.kind,), (shape.radius, shape.radius, shape.length)
        else:
            key, scale = (
                (shape.kind, shape.length / shape.radius),
                (shape.radius, shape.radius, shape.radius),
            )
        key = (*key, has_texture)
        if key not in self._known:
            path = self._known[key] = self._new(shape.kind)
            self._simple(self._names.new(path, "mesh"), shape, has_texture=has_texture)
            prim = self._stage.GetPrimAtPath(path)
            prim.SetCustomDataByKey("shape", shape.kind)
            if isinstance(shape, Capsule):
                prim.SetCustomDataByKey("lengthOfRadius", shape.length / shape.radius)
        return self._known[key], scale

    def _new(self, name: str) -> str:
        if not self._folder:
            self._folder = self._names.new(self._root, "meshes")
            self._stage.DefinePrim(self._folder, "Scope")
        path = self._names.new(self._folder, name)
        self._stage.CreateClassPrim(path).SetTypeName("Xform")
        return path

    def _triangles(self, stem: str, shape: Mesh, index: int, surface: Surface) -> str:
        """Return the path of a class with the triangles of a surface of a file at a scale."""
        import numpy as np

        key = (shape.filename, shape.scale, index)
        if key in self._known:
            return self._known[key]
        path = self._known[key] = self._names.new(self._folder, f"{stem}_triangles")
        prim = self._stage.CreateClassPrim(path)
        prim.SetTypeName("Mesh")
        mesh = UsdGeom.Mesh(prim)
        where, colors = surface.texture_points, surface.point_colors
        rows = [surface.points * shape.scale]
        if where is not None:
            rows.append(where)
        if colors is not None:
            rows.append(colors[:, :3] / 255)
        # Triangles of STL have corners of their own; those at one place become one point.
        table = np.hstack(rows).astype("float32")
        points, indices = np.unique(table, axis=0, return_inverse=True)
        triangles = indices.reshape(-1)[surface.triangles]
        x, y, z = shape.scale
        if x * y * z < 0:  # mirrored
            triangles = triangles[:, ::-1]
        _fill(mesh, points[:, :3], triangles.astype("int32").ravel(), [3] * len(triangles))
        first, second, third = (points[triangles[:, each], :3].astype(float) for each in range(3))
        normals = np.cross(second - first, third - first)
        length = np.linalg.norm(normals, axis=1, keepdims=True)
        flat = np.where(length > 0, normals / np.where(length > 0, length, 1.0), [0.0, 0.0, 1.0])
        mesh.CreateNormalsAttr(Vt.Vec3fArray.FromNumpy(flat.astype("float32")))
        mesh.SetNormalsInterpolation(UsdGeom.Tokens.uniform)
        if where is not None:
            _coordinates(mesh, points[:, 3:5], UsdGeom.Tokens.vertex)
        if colors is not None:
            shown = mesh.CreateDisplayColorPrimvar(UsdGeom.Tokens.vertex)
            shown.Set(Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(points[:, -3:])))
        return path

    def _simple(self, path: str, shape: SimpleShape, *, has_texture: bool) -> None:
        """Define the mesh of a simple shape; all sizes but those of capsules are 1."""
        import numpy as np

        mesh = UsdGeom.Mesh.Define(self._stage, path)
        faces: Faces
        if isinstance(shape, Box):
            points = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) / 2
            faces = [
                [0, 1, 3, 2],
                [4, 6, 7, 5],
                [0, 4, 5, 1],
                [2, 3, 7, 6],
                [0, 2, 6, 4],
                [1, 5, 7, 3],
            ]
            signs = np.tile([-1, 1], 3)[:, None]
            normals, kind = np.repeat(np.eye(3), 2, axis=0) * signs, UsdGeom.Tokens.uniform
        elif isinstance(shape, Cylinder):
            around = _around(SIDES)
            points = np.vstack([np.hstack([around, np.full((SIDES, 1), z)]) for z in (-0.5, 0.5)])
            bands = [[i, (i + 1) % SIDES, (i + 1) % SIDES + SIDES, i + SIDES] for i in range(SIDES)]
            ends = [list(range(SIDES))[::-1], list(range(SIDES, 2 * SIDES))]
            faces = [*bands, *ends]
            out = np.hstack([around, np.zeros((SIDES, 1))])
            sides = out[[each % SIDES for face in bands for each in face]]
            caps = np.repeat([[0, 0, -1], [0, 0, 1]], SIDES, axis=0)
            normals, kind = np.vstack([sides, caps]), UsdGeom.Tokens.faceVarying
        else:
            half = shape.length / shape.radius / 2 if isinstance(shape, Capsule) else 0.0
            normals, faces = _ball(has_belt=half > 0)
            points = normals + np.sign(np.round(normals[:, 2:], 9)) * [0, 0, half]
            if half > 0:  # the equator is there twice: first below
                lower = SIDES * (SIDES // 4 - 1) + 1
                points[lower : lower + SIDES, 2] = -half
                points[lower + SIDES : lower + 2 * SIDES, 2] = half
            kind = UsdGeom.Tokens.vertex
        _fill(
            mesh, points, [each for face in faces for each in face], [len(face) for face in faces]
        )
        mesh.CreateNormalsAttr(Vt.Vec3fArray.FromNumpy(normals.astype("float32")))
        mesh.SetNormalsInterpolation(kind)
        if has_texture:
            heights = points[:, 2].min(), points[:, 2].max()
            where = np.vstack([_unrolled(points[face], *heights) for face in faces])
            _coordinates(mesh, where, UsdGeom.Tokens.faceVarying)


def _around(count: int) -> Array:
    """Return points on the unit circle."""
    import numpy as np

    angles = 2 * pi * np.arange(count) / count
    return np.stack([np.cos(angles), np.sin(angles)], axis=1).round(12)


def _ball(*, has_belt: bool) -> tuple[Array, Faces]:
    """Return the points and faces of a unit sphere, with the equator twice for a belt."""
    import numpy as np

    half = SIDES // 2
    angles = [pi * each / half - pi / 2 for each in range(1, half)]
    if has_belt:
        angles.insert(half // 2, 0.0)
    around = _around(SIDES)
    rings = [np.hstack([around * np.cos(a), np.full((SIDES, 1), np.sin(a))]) for a in angles]
    points = np.vstack([[0, 0, -1], *rings, [0, 0, 1]])
    faces: list[list[int]] = []
    last = len(points) - 1
    for i in range(SIDES):
        j = (i + 1) % SIDES
        faces.append([0, 1 + j, 1 + i])
        for ring in range(len(rings) - 1):
            low, high = 1 + ring * SIDES, 1 + (ring + 1) * SIDES
            faces.append([low + i, low + j, high + j, high + i])
        top = last - SIDES
        faces.append([last, top + i, top + j])
    return points, faces


def _unrolled(corners: Array, bottom: float, top: float) -> Array:
    """Return where in a texture the corners of a face are.

    Faces across an axis have all of it, others are unrolled around z.

    Args:
        corners: the corners.
        bottom: the least z of the shape.
        top: its greatest z.
    """
    import numpy as np

    low, high = corners.min(axis=0), corners.max(axis=0)
    flat = np.flatnonzero(high - low < 1e-9)
    if len(flat):
        across = [axis for axis in range(3) if axis != flat[0]]
        size = np.where(high - low < 1e-9, 1.0, high - low)
        return np.asarray(((corners - low) / size)[:, across])
    turn = np.arctan2(corners[:, 1], corners[:, 0]) / (2 * pi) % 1.0
    turn = np.where(turn < turn.max() - 0.5, turn + 1.0, turn)
    return np.stack([turn, (corners[:, 2] - bottom) / (top - bottom)], axis=1)


def _coordinates(mesh: UsdGeom.Mesh, where: Array, interpolation: str) -> None:
    """Say where in a texture the points or corners of a mesh are."""
    import numpy as np

    kind = Sdf.ValueTypeNames.TexCoord2fArray
    shown = UsdGeom.PrimvarsAPI(mesh).CreatePrimvar("st", kind, interpolation)
    shown.Set(Vt.Vec2fArray.FromNumpy(np.ascontiguousarray(where, dtype="float32")))


def _fill(mesh: UsdGeom.Mesh, points: Array, indices: Any, counts: list[int]) -> None:
    """Give a mesh its points and faces."""
    import numpy as np

    points = np.ascontiguousarray(points, dtype="float32")
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray(list(map(int, indices))))
    mesh.CreateFaceVertexCountsAttr(counts)
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    low, high = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    mesh.CreateExtentAttr([Gf.Vec3f(*low), Gf.Vec3f(*high)])
