"""Mesh files as surfaces to draw: corners, triangles, and the colours or texture on them.

Units and axes are treated as ROS's tools treat them: the unit that a COLLADA file names counts, its
up axis does not, and numbers in all other formats are metres.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from ...robot.mesh import (
    LARGEST_FILE,
    STL_FACET_BYTES,
    STL_HEADER_BYTES,
    MeshFileError,
    MissingLibraryError,
    metres,
    read_by,
    read_mesh,
)
from ..scene.robot import LARGEST

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Floats = NDArray[np.floating[Any]]
    Whole = NDArray[np.integer[Any]]

_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


class Surface:
    """One surface of a mesh.

    Attributes:
        points: corners, N×3, in metres.
        triangles: indices of corners, M×3, counterclockwise seen from outside.
        color: red, green, blue, alpha from 0 to 1 of all of it, or None.
        point_colors: the same for each corner, N×4 from 0 to 255, or None.
        texture: an image, H×W×3 from 0 to 255, the first row on top; or None.
        texture_points: where in the image each corner is, N×2, from the lower left; or None.
        normals: directions of the corners, N×3, where the file's own have to do; or None.
    """

    __slots__ = (
        "color", "normals", "point_colors", "points", "texture", "texture_points", "triangles",
    )  # fmt: skip

    def __init__(self, points: Floats, triangles: Whole) -> None:
        """Hold a surface without colours."""
        self.points = points
        self.triangles = triangles
        self.color: tuple[float, ...] | None = None
        self.point_colors: NDArray[np.uint8] | None = None
        self.texture: NDArray[np.uint8] | None = None
        self.texture_points: Floats | None = None
        self.normals: Floats | None = None


def read_surfaces(path: str, allows: Callable[[str], bool]) -> list[Surface]:
    """Return the surfaces in a mesh file.

    Args:
        path: the file.
        allows: tells whether another file may be read that this one names, such as a texture.

    Raises:
        MeshFileError: the file cannot be opened, or is not what its ending says.
        MissingLibraryError: the format needs a library that is not installed.
    """

    def read(path: str, ending: str) -> list[Surface]:
        return _read_stl(path) if ending == "stl" else _read_with_trimesh(path, allows)

    found = read_by(read, path)
    found = [surface for surface in found if len(surface.triangles)]
    if not found:
        raise MeshFileError("it has no triangles")
    if not all((abs(surface.points) <= LARGEST).all() for surface in found):
        raise MeshFileError("a coordinate is no number, or too large for one")
    return found


def _read_stl(path: str) -> list[Surface]:
    with open(path, "rb") as file:
        header = file.read(STL_HEADER_BYTES)
        count = int.from_bytes(header[80:], "little")
        if os.fstat(file.fileno()).st_size != STL_HEADER_BYTES + STL_FACET_BYTES * count:
            mesh = read_mesh(path)  # a text, or broken
            return [Surface(np.array(mesh.vertices), np.array(mesh.triangles))]
        facets = np.frombuffer(file.read(), _FACET)
    points = facets["corners"].reshape(-1, 3).astype(float)
    return [Surface(points, np.arange(len(points)).reshape(-1, 3))]


def _read_with_trimesh(path: str, allows: Callable[[str], bool]) -> list[Surface]:
    try:
        import trimesh

        scene: Any = trimesh.load_scene(path, process=False, resolver=_resolver(path, allows))
        factor = metres(scene)
        return [
            _surface(scene.geometry[name], place, factor)
            for place, name in map(scene.graph.get, scene.graph.nodes_geometry)
            if isinstance(scene.geometry[name], trimesh.Trimesh)
        ]
    except ImportError as error:
        raise MissingLibraryError(error.name or str(error)) from error
    except (OSError, MemoryError):
        raise
    except Exception as error:
        raise MeshFileError(f"trimesh cannot read it: {error}") from error


def _resolver(path: str, allows: Callable[[str], bool]) -> Any:
    """Return what gives trimesh the files that a mesh names: those that may be read."""
    from trimesh.resolvers import FilePathResolver

    class Resolver(FilePathResolver):  # type: ignore[misc]
        """Gives files from wherever is allowed: textures often lie beside the folder of meshes."""

        def get(self, name: str) -> bytes:
            target = os.path.abspath(os.path.join(self.parent, name.strip()))
            if not allows(target):
                raise FileNotFoundError(2, "it may not be read", name)
            with open(target, "rb") as file:
                return file.read(LARGEST_FILE)

        def namespaced(self, namespace: str) -> Resolver:
            return Resolver(os.path.join(self.parent, namespace))

    return Resolver(path)


def _surface(mesh: Any, place: Any, factor: float) -> Surface:
    """Return a mesh of trimesh as a surface, at its place in the file."""
    points = np.asarray(mesh.vertices, float) @ place[:3, :3].T + place[:3, 3]
    triangles = np.asarray(mesh.faces)
    if np.linalg.det(place[:3, :3]) < 0:
        triangles = triangles[:, ::-1]
    surface = Surface(points * factor, triangles)
    kind = mesh.visual.kind
    if kind == "vertex":
        surface.point_colors = np.asarray(mesh.visual.vertex_colors, np.uint8)
    elif kind == "face":
        surface.points = surface.points[triangles.ravel()]
        surface.triangles = np.arange(triangles.size).reshape(-1, 3)
        surface.point_colors = np.repeat(np.asarray(mesh.visual.face_colors, np.uint8), 3, axis=0)
    elif kind == "texture":
        _add_material(surface, mesh, place)
    return surface


def _add_material(surface: Surface, mesh: Any, place: Any) -> None:
    material = mesh.visual.material
    image = getattr(material, "image", None) or getattr(material, "baseColorTexture", None)
    uv = mesh.visual.uv
    if image is not None and uv is not None and len(uv) == len(surface.points):
        surface.texture = np.asarray(image.convert("RGB"))
        surface.texture_points = np.asarray(uv)[:, :2]
        surface.normals = np.asarray(mesh.vertex_normals) @ np.linalg.inv(place[:3, :3])
        return
    color = np.asarray(material.main_color, float) / 255
    surface.color = tuple(color[:4])
