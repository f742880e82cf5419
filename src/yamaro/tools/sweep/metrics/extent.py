"""How much room a robot takes at home: the box around its shapes, along the axes of the root."""

from __future__ import annotations

import os
from math import hypot, inf

from ....model.kinematics import link_poses
from ....model.positions import home_positions
from ....model.shapes import Box, Capsule, Cylinder, Mesh, Sphere
from .failures import metric_failure

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from ....files.mesh_files import MeshFinder
    from ....model.pose import Pose, Vector
    from ....model.robot import Robot
    from ....model.shapes import Shape

_known_corners: dict[tuple[str, int, int], Any] = {}
"""The corners of meshes that were read in this process, by path, time and size of the file."""


def bounding_box(robot: Robot, finder: MeshFinder) -> Vector:
    """Return the lengths of the box along x, y and z of the root, in metres.

    The joints are as in the state `home`; those that it does not name, and all where there is no
    such state, are at 0, or in the middle of limits that exclude 0. The box is around the visual
    shapes, or around the collision shapes of a robot that has no visual ones.

    Args:
        robot: the robot.
        finder: finds the files of meshes.

    Raises:
        YamaroError: the robot has no shapes, or a mesh cannot be read.
    """
    poses = link_poses(robot, home_positions(robot))
    low, high = [inf] * 3, [-inf] * 3
    for name, pose, shape in _shapes(robot):
        if isinstance(shape, Mesh):
            spans = _mesh_spans(poses[name] @ pose, shape, finder)
        else:
            spans = [
                (middle - half, middle + half)
                for middle, half in zip(*_halves(poses[name] @ pose, shape), strict=True)
            ]
        low = [min(known, span[0]) for known, span in zip(low, spans, strict=True)]
        high = [max(known, span[1]) for known, span in zip(high, spans, strict=True)]
    if low[0] == inf:
        raise metric_failure("the robot has no shapes, so there is no box around it", robot.span)
    x, y, z = (end - start for start, end in zip(low, high, strict=True))
    return (x, y, z)


def _shapes(robot: Robot) -> list[tuple[str, Pose, Shape]]:
    """Return the shapes that count, each with its link and its pose there."""
    for kind in ("visuals", "collisions"):
        found = [
            (link.name, each.pose, each.shape)
            for link in robot.links.values()
            for each in getattr(link, kind)
            if each.shape is not None
        ]
        if found:
            return found
    return []


def _halves(placed: Pose, shape: Shape) -> tuple[Vector, tuple[float, ...]]:
    """Return the middle of a shape, and how far it extends from there along each axis.

    These are the support functions of the shapes: of a box Σ|rᵢ|·sizeᵢ/2, of a disc across the
    unit vector a, radius·√(1 − a²).
    """
    if isinstance(shape, Box):
        sizes = (shape.x / 2, shape.y / 2, shape.z / 2)
        rows = placed.rotation
        return placed.position, tuple(
            sum(abs(part) * size for part, size in zip(row, sizes, strict=True)) for row in rows
        )
    if isinstance(shape, Sphere):
        return placed.position, (shape.radius,) * 3
    assert isinstance(shape, (Cylinder, Capsule))
    rim = isinstance(shape, Cylinder)
    return placed.position, tuple(
        abs(z) * shape.length / 2 + shape.radius * (hypot(x, y) if rim else 1)
        for x, y, z in placed.rotation
    )


def _mesh_spans(placed: Pose, shape: Mesh, finder: MeshFinder) -> list[tuple[float, float]]:
    """Return the extent of a mesh along each axis."""
    import numpy as np

    assert shape.element is not None
    span = shape.element.value_span("filename")
    path = finder.resolve(shape.filename, span)
    if path is None:
        raise metric_failure(f"the mesh '{shape.filename}' is not found", span)
    from ....meshes.formats import MeshFileError, MissingLibraryError

    try:
        corners = _corners(path, finder.allows)
    except (MeshFileError, MissingLibraryError, OSError) as error:
        raise metric_failure(f"the mesh '{shape.filename}' cannot be read: {error}", span) from None
    points = corners * np.array(shape.scale) @ np.array(placed.rotation).T + placed.position
    return list(zip(points.min(axis=0).tolist(), points.max(axis=0).tolist(), strict=True))


def _corners(path: str, allows: Callable[[str], bool]) -> Any:
    """Return the corners of a mesh, N×3."""
    state = os.stat(path)
    key = (path, state.st_mtime_ns, state.st_size)
    if key not in _known_corners:
        import numpy as np

        from ....meshes.surfaces import read_surfaces

        points = [surface.points for surface in read_surfaces(path, allows)]
        _known_corners[key] = np.concatenate(points)
    return _known_corners[key]
