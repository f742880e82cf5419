"""Pictures of variants, all at one scale."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ....confined import Reader
from ...picture.cameras import fitted
from ...picture.draw import Drawing
from ...picture.request import Request
from ..showing import show

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from ....policy import Policy
    from ....result import Build

    Image = NDArray[np.uint8]

SIZE = "640x480"


def pictures(folder: str, indices: Mapping[str, int], policy: Policy) -> dict[str, Image]:
    """Return pictures of variants at home, height×width×4, by the same names.

    Args:
        folder: that of the sweep.
        indices: the numbers of the variants, by any names.
        policy: how far the robot's files are trusted.

    Raises:
        YamaroError: a variant or a mesh of it cannot be built or drawn.
        NoOpenGLError: nothing can be drawn on this system.
    """
    drawings = {
        name: _drawing(show(folder, index, policy, has_root=True).build, policy)
        for name, index in indices.items()
    }
    cameras = {}
    for name, (drawing, request) in drawings.items():
        points = drawing.outline()
        cameras[name] = fitted(request.views[0], points, request.width / request.height)
    farthest = max(np.linalg.norm(camera.position - camera.target) for camera in cameras.values())
    for camera in cameras.values():
        way = camera.position - camera.target
        camera.position = camera.target + way * (farthest / np.linalg.norm(way))
    return {name: drawing.shot(cameras[name]) for name, (drawing, _) in drawings.items()}


def _drawing(build: Build, policy: Policy) -> tuple[Drawing, Request]:
    options = {"size": SIZE, "transparent": ""}
    request = Request("robot.png", options, {})
    name = build.files[0] if build.files else "sweep"
    reader = Reader(policy, readable=build.finder.roots, name=name)
    return Drawing(build, request, reader), request
