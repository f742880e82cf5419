"""Cameras: where they are so that all of a robot is in the picture, as large as possible."""

from __future__ import annotations

from math import radians, tan
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from .request import View

    Floats = NDArray[np.floating[Any]]

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
