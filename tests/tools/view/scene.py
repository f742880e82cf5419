"""Where points of a robot are on the page, from the camera and the poses of its links."""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.tools.view.conftest import Page

Point = tuple[float, float]


def matrix(page: Page, script: str) -> Any:
    """Return a matrix of three.js, which has its columns one after another."""
    return np.array(page.run(f"{script}.toArray()")).reshape(4, 4).T


def pose_of(page: Page, link: str) -> Any:
    """Return the pose of a link, 4×4."""
    return np.array(page.run(f"yamaro.pose({link!r})")).reshape(4, 4)


def place_on_page(page: Page, point: Any) -> Point:
    """Return where a point in the world is seen, in pixels of the page."""
    page.run("yamaro.stage.drawNow()")
    view = matrix(page, "yamaro.stage.camera.matrixWorldInverse")
    clip = matrix(page, "yamaro.stage.camera.projectionMatrix") @ view @ [*point, 1]
    x, y, width, height = page.run(
        "(r => [r.x, r.y, r.width, r.height])(document.getElementById('canvas')"
        ".getBoundingClientRect())"
    )
    across, up = clip[0] / clip[3], clip[1] / clip[3]
    return float(x + (1 + across) / 2 * width), float(y + (1 - up) / 2 * height)


def place_of(page: Page, link: str, point: tuple[float, float, float]) -> Point:
    """Return where a point in a link's frame is seen, in pixels of the page."""
    return place_on_page(page, (pose_of(page, link) @ [*point, 1])[:3])


def value_of(page: Page, joint: str) -> float:
    """Return the position of a joint."""
    value: float = page.run(f"yamaro.robot.joints.get({joint!r}).jointValue[0]")
    return value
