"""Joints that are dragged in the scene of `yamaro view`, by the mouse of a browser."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.tools.view.conftest import Page
from tests.tools.view.scene import Point, matrix, place_of, value_of
from tests.tools.view.test_page import Start

ALT = 1

DEVICE = """\
<robot name="device">
  <link name="base">
    <visual><geometry><box size="0.5 1.2 0.1"/></geometry></visual>
  </link>
  <link name="arm">
    <visual><origin xyz="0 0 0.25"/><geometry><box size="0.08 0.08 0.5"/></geometry></visual>
  </link>
  <link name="tip">
    <visual><geometry><sphere radius="0.07"/></geometry></visual>
  </link>
  <link name="bar">
    <visual><origin xyz="0 0 0.2"/><geometry><box size="0.08 0.08 0.4"/></geometry></visual>
  </link>
  <link name="near">
    <visual><origin xyz="0 0 0.12"/><geometry><box size="0.06 0.06 0.24"/></geometry></visual>
  </link>
  <link name="far">
    <visual><origin xyz="0 0 0.12"/><geometry><box size="0.06 0.06 0.24"/></geometry></visual>
  </link>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="arm"/><origin xyz="0 0.4 0.05"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1.2" effort="1" velocity="1"/>
  </joint>
  <joint name="stay" type="fixed">
    <parent link="arm"/><child link="tip"/><origin xyz="0 0 0.5"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="base"/><child link="bar"/><origin xyz="0 -0.4 0.05"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="0.3" effort="1" velocity="1"/>
  </joint>
  <joint name="bend" type="revolute">
    <parent link="base"/><child link="near"/><origin xyz="0 0 0.05"/><axis xyz="1 0 0"/>
    <limit lower="-1.5" upper="1.5" effort="1" velocity="1"/>
  </joint>
  <joint name="follow" type="revolute">
    <parent link="near"/><child link="far"/><origin xyz="0 0 0.24"/><axis xyz="1 0 0"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/>
    <mimic joint="bend" multiplier="0.5" offset="0.1"/>
  </joint>
</robot>
"""


@pytest.fixture
def device(page: Page, view: Start, tmp_path: Path) -> Page:
    """The page with a robot that has a joint of each kind that is dragged."""
    path = tmp_path / "device.urdf"
    path.write_text(DEVICE, encoding="utf-8")
    page.show(view(path))
    page.run("localStorage.clear()")
    return page


def places_of(
    page: Page, link: str, point: tuple[float, float, float], goal: float, joint: str
) -> list[Point]:
    """Return where a point of a link is as the joint stands, on the way, and at the goal."""
    start = value_of(page, joint)
    found = []
    for share in (0.0, 0.3, 0.6, 1.0):
        page.run(f"yamaro.setJoint({joint!r}, {start + share * (goal - start)})")
        found.append(place_of(page, link, point))
    page.run(f"yamaro.setJoint({joint!r}, {start})")
    return found


# The points are on faces that the camera sees: in front, or on the left for the view from there.
@pytest.mark.parametrize(
    ("view_name", "link", "point", "joint", "goal"),
    [
        ("iso", "arm", (0.04, 0, 0.4), "turn", 0.6),
        ("left", "arm", (0, 0.04, 0.4), "turn", -0.7),
        ("left", "tip", (0, 0.07, 0), "turn", 0.5),  # a fixed joint is between
        ("iso", "bar", (0.04, 0, 0.3), "slide", 0.25),
        ("front", "near", (0.03, 0, 0.2), "bend", 0.4),
        ("front", "far", (0.03, 0, 0.2), "bend", -0.5),  # its joint follows the one that moves
    ],
)
def test_a_joint_follows_the_pointer_that_drags_its_link(
    device: Page, view_name: str, link: str, point: tuple[float, float, float], joint: str,
    goal: float,
) -> None:  # fmt: skip
    if view_name != "iso":
        device.press(f"[data-view={view_name}]")
    places = places_of(device, link, point, goal, joint)
    before = matrix(device, "yamaro.stage.camera.matrixWorld")
    device.drag_through(*places)
    x, y = place_of(device, link, point)
    assert [x, y] == pytest.approx(places[-1], abs=3)  # pixels
    assert value_of(device, joint) == pytest.approx(goal, abs=0.02)
    assert np.array_equal(matrix(device, "yamaro.stage.camera.matrixWorld"), before)
    assert device.text("#origin") == ""  # a drag is no click


def test_a_link_that_turns_towards_the_camera_follows_a_drag_up_or_down(device: Page) -> None:
    """Its end hardly moves on the screen, so the near side of a wheel of its size follows."""
    device.press("[data-view=front]")
    x, y = place_of(device, "arm", (0.04, 0, 0.3))
    lever = y - place_of(device, "arm", (0.04, 0, 0))[1]  # negative: up on the screen
    places = [(x, y - share * 0.7 * lever) for share in (0, 0.25, 0.5, 0.75, 1)]
    device.drag_through(*places)  # down by 0.7 times the lever: towards the camera
    there = value_of(device, "turn")
    assert 0.6 < there < 1.1  # from 30° on, the end itself is followed, which takes more of a turn
    x, y = place_of(device, "arm", (0.04, 0, 0.3))
    device.drag_through((x, y), (x, y + 0.2 * lever), (x, y + 0.4 * lever))  # up
    assert value_of(device, "turn") < there - 0.3


def test_the_value_is_shown_while_a_joint_is_dragged_and_ends_at_the_limit(device: Page) -> None:
    device.press("[data-view=left]")
    places = places_of(device, "arm", (0, 0.04, 0.4), 1.2, "turn")
    device.drag_through(*places[:2], drop=False)
    assert device.text("#drag-value").startswith("turn 2")  # 0.3 of 68.8°
    assert not device.text("#drag-value").endswith("(limit)")
    device.drop(*places[1])
    assert device.text("#drag-value") == ""
    x, y = place_of(device, "arm", (0, 0.04, 0.4))
    centre = place_of(device, "arm", (0, 0.04, 0))
    beyond = (2 * centre[0] - x, 2 * centre[1] - y)  # half a turn
    device.drag_through((x, y), places[2], places[3], (x, centre[1]), beyond, drop=False)
    assert value_of(device, "turn") == pytest.approx(1.2)
    assert device.text("#drag-value") == "turn 68.8° (limit)"
    device.key("Escape")
    assert device.text("#drag-value") == ""
    assert value_of(device, "turn") == pytest.approx(0.3 * 1.2, abs=0.02)
    device.drop(*beyond)
    assert value_of(device, "turn") == pytest.approx(0.3 * 1.2, abs=0.02)


def test_the_background_turns_the_view_and_so_does_alt_or_the_switch(device: Page) -> None:
    def camera() -> list[float]:
        found: list[float] = device.run("yamaro.stage.camera.matrixWorld.toArray()")
        return found

    def is_turned_by_dragging(x: float, y: float, keys: int = 0) -> bool:
        before = camera()
        device.drag_through((x, y), (x + 40, y + 10), (x + 80, y + 10), keys=keys)
        return camera() != before

    left, top = device.run(
        "(r => [r.x, r.y])(document.getElementById('canvas').getBoundingClientRect())"
    )
    assert is_turned_by_dragging(left + 20, top + 200)
    assert is_turned_by_dragging(*place_of(device, "arm", (0.04, 0, 0.4)), keys=ALT)
    assert value_of(device, "turn") == 0
    device.press("#drag")
    assert device.run("document.getElementById('drag').ariaPressed") == "false"
    assert is_turned_by_dragging(*place_of(device, "arm", (0, 0, 0.25)))
    assert value_of(device, "turn") == 0
    device.key("d")
    x, y = place_of(device, "arm", (0, 0, 0.25))
    assert not is_turned_by_dragging(x, y)
    assert value_of(device, "turn") != 0


def test_a_drag_of_what_nothing_moves_turns_the_view(device: Page) -> None:
    x, y = place_of(device, "base", (0.25, -0.1, 0))
    before = device.run("yamaro.stage.camera.matrixWorld.toArray()")
    device.drag_through((x, y), (x + 30, y), (x + 60, y))
    assert device.run("yamaro.stage.camera.matrixWorld.toArray()") != before


def test_a_click_on_a_link_that_can_be_dragged_selects_it(device: Page) -> None:
    device.click(*place_of(device, "bar", (0.04, 0, 0.3)))
    device.wait_for("!document.getElementById('origin').hidden")
    assert device.text("#origin-title") == "bar"
    assert value_of(device, "slide") == 0
