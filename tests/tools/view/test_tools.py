"""What the page of `yamaro view` offers besides the robot: poses, measures, pictures, colours."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import PIL.Image
import pytest

from tests.tools.view.conftest import Page
from tests.tools.view.scene import place_of, pose_of, value_of
from tests.tools.view.test_page import LAMP, Start, reds
from tests.waiting import wait_for
from yamaro import build
from yamaro.picture.request import Request, read_positions

SHIFT = 8
STATES = """\
states:
  up: {left_joint: 0.5, right_joint: -1.1}
  half: {left_joint: -0.4}
"""


@pytest.fixture
def lamp(page: Page, view: Start, tmp_path: Path) -> Page:
    """The page with a lamp on it that has states; the page may copy."""
    path = tmp_path / "lamp.yaml"
    path.write_text(LAMP + STATES, encoding="utf-8")
    page.show(view(path))
    return page


@pytest.fixture
def copied(lamp: Page) -> Any:
    """Return what the page has copied last."""
    lamp.run(
        "navigator.clipboard.writeText = async (text) => { window.copiedText = text; };"
        " window.copiedText = null"
    )

    def last() -> str:
        text: str = lamp.wait_for("window.copiedText")
        lamp.run("window.copiedText = null")
        return text

    return last


def choose(page: Page, selector: str, value: str) -> None:
    """Choose from a menu."""
    page.run(
        f"(e => {{ e.value = {json.dumps(value)}; e.dispatchEvent(new Event('change')); }})"
        f"(document.querySelector({json.dumps(selector)}))"
    )


# --- poses --------------------------------------------------------------------------------------


def test_a_state_of_the_robot_is_chosen_from_a_menu(lamp: Page) -> None:
    names = "[...document.querySelectorAll('#states option:not([hidden])')].map(o => o.text)"
    assert lamp.run(names) == ["initial pose", "up", "half"]
    choose(lamp, "#states", "=up")
    lamp.wait_for("yamaro.robot.joints.get('left_joint').angle === 0.5")
    assert value_of(lamp, "right_joint") == -1.1
    choose(lamp, "#states", "=half")
    lamp.wait_for("yamaro.robot.joints.get('left_joint').angle === -0.4")
    assert value_of(lamp, "right_joint") == 0  # which the state does not name
    lamp.run("yamaro.setJoint('left_joint', 0.1)")
    assert lamp.run("document.getElementById('states').selectedOptions[0].text") == "changed"
    choose(lamp, "#states", "")
    lamp.wait_for("yamaro.robot.joints.get('left_joint').angle === 0")
    lamp.save(LAMP + "states: {low: {left_joint: -1}}\n")
    assert lamp.run(names) == ["initial pose", "low"]


def test_the_robot_is_shown_in_its_state_home_at_first(lamp: Page) -> None:
    names = "[...document.querySelectorAll('#states option:not([hidden])')].map(o => o.text)"
    chosen = "document.getElementById('states').selectedOptions[0].text"
    lamp.save(LAMP + "states: {home: {left_joint: 0.5}, up: {right_joint: -1.1}}\n")
    assert lamp.run(names) == ["home", "up", "all joints at 0"]
    assert (value_of(lamp, "left_joint"), value_of(lamp, "right_joint")) == (0.5, 0)
    assert lamp.run(chosen) == "home"
    lamp.run("yamaro.setJoint('left_joint', 0.1)")
    assert lamp.run(chosen) == "changed"
    lamp.press("#joint-reset")
    assert value_of(lamp, "left_joint") == 0.5
    choose(lamp, "#states", "=up")  # which does not name the other joint
    lamp.wait_for("yamaro.robot.joints.get('right_joint').angle === -1.1")
    assert value_of(lamp, "left_joint") == 0
    choose(lamp, "#states", "zero")
    lamp.wait_for("yamaro.robot.joints.get('right_joint').angle === 0")
    choose(lamp, "#states", "=home")
    lamp.wait_for("yamaro.robot.joints.get('left_joint').angle === 0.5")
    lamp.save(LAMP + "states: {home: {left_joint: -0.5}}\n")
    assert value_of(lamp, "left_joint") == -0.5  # the new home: the user has moved nothing


def test_the_camera_shows_all_of_another_robot_and_stays_with_the_same_one(lamp: Page) -> None:
    sees = "yamaro.stage.sees(yamaro.robot.outermostPoints())"
    camera = "yamaro.stage.camera.position.toArray()"
    lamp.save(LAMP.replace("height: 0.4", "height: 4"))
    assert lamp.run(sees)  # the user has not moved the camera
    lamp.run("yamaro.stage.isMoved = true; yamaro.stage.camera.position.multiplyScalar(0.5)")
    moved = lamp.run(camera)
    lamp.save(LAMP.replace("height: 0.4", "height: 8"))
    assert lamp.run(camera) == moved
    assert not lamp.run(sees)
    tower = "{name: tower, link: {geometry: box, scale: 9 9 90, visual: }}"
    lamp.save(f"robot: tower\nmodel:\n- part: {tower}\n")
    assert lamp.run(sees)


def test_a_pose_is_copied_as_yaml_that_gives_the_same_pose(lamp: Page, copied: Any) -> None:
    lamp.run("yamaro.setJoint('left_joint', 0.7123456789)")
    lamp.press("#pose-copy")
    lamp.press("#pose-formats [data-format=state]")
    path = lamp.viewer.path.parent / "posed.yaml"
    path.write_text(LAMP + copied(), encoding="utf-8")
    state = build(path).robot.states["pose"]
    assert state.positions == pytest.approx({"left_joint": 0.712346, "right_joint": 0}, abs=1e-9)


def test_a_pose_is_copied_as_arguments_of_yamaro_picture(lamp: Page, copied: Any) -> None:
    lamp.run("yamaro.setJoint('right_joint', -0.25)")
    lamp.press("#pose-copy")
    lamp.press("#pose-formats [data-format=picture]")
    option, _, value = copied().partition(" ")
    assert option == "--joints"
    request = Request("out.png", {}, {"joints": [value]})
    robot = build(lamp.viewer.path).robot
    assert read_positions(request, robot) == {"left_joint": 0, "right_joint": -0.25}


def test_a_text_that_may_not_be_copied_is_shown_to_be_copied(lamp: Page) -> None:
    lamp.run(
        "navigator.clipboard.writeText = () => Promise.reject(new Error('no'));"
        " document.execCommand = () => false; 0"
    )
    lamp.press("#pose-copy")
    lamp.press("#pose-formats [data-format=json]")
    lamp.wait_for("document.querySelector('dialog[open] textarea')?.value")
    text = lamp.run("document.querySelector('dialog textarea').value")
    assert json.loads(text) == {"left_joint": 0, "right_joint": 0}
    selected = "(e => e.selectionEnd - e.selectionStart)(document.querySelector('dialog textarea'))"
    assert lamp.run(selected) == len(text)
    lamp.press("dialog button")
    lamp.wait_for("!document.querySelector('dialog')")


# --- between two links --------------------------------------------------------------------------


def numbers_of(page: Page, name: str) -> list[float]:
    return [float(each) for each in page.text(f"#between [data-name={name}] .numbers").split()]


def test_the_pose_of_one_link_in_the_frame_of_another_is_shown(lamp: Page, copied: Any) -> None:
    lamp.run("yamaro.setJoint('left_joint', 0.5); yamaro.setJoint('right_joint', -0.8)")
    lamp.press("#tree [data-link=left_link]")
    choose(lamp, "#between-to", "right_link")
    T = np.linalg.inv(pose_of(lamp, "left_link")) @ pose_of(lamp, "right_link")
    assert numbers_of(lamp, "xyz") == pytest.approx(T[:3, 3], abs=1e-6)
    assert numbers_of(lamp, "distance") == [pytest.approx(np.linalg.norm(T[:3, 3]), abs=1e-6)]
    # Both turn about y, by 0.5 and -0.8: the one is turned by -1.3 from the other.
    assert numbers_of(lamp, "rpy") == pytest.approx([0, -1.3, 0], abs=1e-6)
    assert numbers_of(lamp, "degrees") == pytest.approx([0, math.degrees(-1.3), 0], abs=1e-2)
    half = 1.3 / 2
    quaternion = [0, -math.sin(half), 0, math.cos(half)]
    assert numbers_of(lamp, "quaternion") == pytest.approx(quaternion, abs=1e-6)
    lamp.run("yamaro.setJoint('right_joint', 0.5)")
    assert numbers_of(lamp, "rpy") == [0, 0, 0]
    lamp.press("#between [data-name=distance]")
    assert float(copied()) == numbers_of(lamp, "distance")[0] == pytest.approx(0.4)
    lamp.press("#between-copy")
    assert "# right_link in the frame of left_link\nxyz: 0 -0.4 0\n" in copied()


def test_a_line_is_drawn_between_the_links_and_goes_away(lamp: Page) -> None:
    lamp.press("#tree [data-link=left_link]")
    choose(lamp, "#between-to", "right_link")
    lamp.press("#show-visual")
    lamp.run("document.getElementById('origin').style.visibility = 'hidden'")
    ends = np.array([place_of(lamp, name, (0, 0, 0)) for name in ("left_link", "right_link")])
    x, y = map(round, ends.mean(axis=0))
    assert reds(lamp.picture((x - 8, y - 8, 16, 16))) > 4
    lamp.run("document.getElementById('between-close').click()")
    lamp.run("yamaro.stage.drawNow()")
    assert reds(lamp.picture((x - 8, y - 8, 16, 16))) == 0


def test_a_click_with_shift_measures_to_the_other_link(lamp: Page) -> None:
    lamp.press("#tree [data-link=left_link]")
    x, y = place_of(lamp, "right_link", (0.03, 0, 0.1))
    lamp.drag_through((x, y), keys=SHIFT)
    lamp.wait_for("!document.getElementById('between-result').hidden")
    assert lamp.run("document.getElementById('between-to').value") == "right_link"
    assert lamp.text("#origin-title") == "left_link"
    lamp.press("#between-swap")
    assert lamp.text("#origin-title") == "right_link"
    assert lamp.run("document.getElementById('between-to').value") == "left_link"


# --- pictures -----------------------------------------------------------------------------------


def test_a_picture_of_the_scene_is_saved_without_the_panels(lamp: Page, tmp_path: Path) -> None:
    folder = tmp_path / "saved"
    lamp.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(folder))
    lamp.press("#tree [data-link=left_link]")  # a card lies over the scene
    lamp.press("#picture")
    path = folder / "lamp.png"
    wait_for(path.exists)
    with PIL.Image.open(path) as image:
        pixels = np.asarray(image.convert("RGB")).astype(int)
    width, height = lamp.run(
        "(c => [c.clientWidth, c.clientHeight])(document.getElementById('canvas'))"
    )
    rows, columns = pixels.shape[:2]
    assert max(rows, columns) == 1600
    assert columns / rows == pytest.approx(width / height, rel=0.01)
    lamp.press("#origin-close")
    share = reds(lamp.stage()) / (width * height)
    assert reds(pixels) / (rows * columns) == pytest.approx(share, rel=0.15)
    assert pixels[:40, :200].min() > 200  # where the card is, there is the sky


def test_a_frame_shows_the_picture_since_it_may_not_save(lamp: Page) -> None:
    lamp.call("Browser.setDownloadBehavior", behavior="deny")
    lamp.run("window.parent = {}; 0")
    lamp.key("p")
    lamp.wait_for("document.getElementById('picture-image').naturalHeight === 1600")
    assert lamp.text("#picture-link") == "lamp.png"
    lamp.key("Escape")
    assert lamp.text("#picture-card") == ""


# --- colours ------------------------------------------------------------------------------------

# Walks over all texts that are seen, and gives those whose contrast (WCAG 2) is below 4.5.
FAINT = """
(() => {
  const canvas = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  const rgba = (color) => {
    canvas.clearRect(0, 0, 1, 1); canvas.fillStyle = color; canvas.fillRect(0, 0, 1, 1);
    return [...canvas.getImageData(0, 0, 1, 1).data].map((part) => part / 255);
  };
  const over = ([r, g, b, a], below) => [r, g, b].map((part, i) => part * a + below[i] * (1 - a));
  const behind = (element) => {
    const layers = [];
    for (let at = element; at; at = at.parentElement) {
      const style = getComputedStyle(at);
      const stops = style.backgroundImage.match(/(rgba?|color)\\([^)]*\\)/g);
      layers.push(rgba(stops ? stops[stops.length - 1] : style.backgroundColor));
    }
    return layers.reverse().reduce((below, layer) => over(layer, below), [1, 1, 1]);
  };
  const light = (color) => color
    .map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4))
    .reduce((sum, part, i) => sum + part * [0.2126, 0.7152, 0.0722][i], 0);
  const found = [];
  let count = 0;
  for (const element of document.body.querySelectorAll("*")) {
    const own = [...element.childNodes].filter((node) => node.nodeType === Node.TEXT_NODE);
    const text = own.map((node) => node.data).join("").trim();
    const isSeen = element.checkVisibility({ visibilityProperty: true });
    if (!text || !isSeen || element.matches("option, :disabled")) continue;
    count += 1;
    const back = behind(element);
    const [a, b] = [light(over(rgba(getComputedStyle(element).color), back)), light(back)];
    const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    const name = element.className || element.id || element.tagName;
    if (contrast < 4.5) found.push([name, text.slice(0, 20), contrast.toFixed(2)]);
  }
  return [count, found];
})()
"""


@pytest.fixture
def system(page: Page) -> Iterator[Any]:
    """Set the colours of the system."""
    yield lambda name: page.call(
        "Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": name}]
    )
    page.call("Emulation.setEmulatedMedia", features=[])


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_all_texts_can_be_read_in_light_and_dark(
    page: Page, view: Start, tmp_path: Path, theme: str
) -> None:
    text = LAMP.replace(
        "          collision:\nmodel",
        "          collision:\n            geometry: meshes/$(name).stl\nmodel",
    )
    path = tmp_path / "lamp.yaml"
    text = text.replace("  label: plain\n", "  label: plain\n  twice: $(2 * height)\n")
    path.write_text(text + STATES, encoding="utf-8")
    viewer = view(path)
    viewer.url += f"#theme={theme}"
    page.show(viewer)
    for selector in ("#warnings .title", "#download", "#downloads [data-format=sdf]"):
        page.run(f"document.querySelector('{selector}').click()")
    page.wait_for("Boolean(document.querySelector('#download-result:not(.busy) p'))")
    choose(page, "#between-to", "right_link")
    page.run("document.getElementById('included').open = true")
    page.wait_for("Boolean(document.querySelector('#included-files > *'))")
    page.run("document.querySelectorAll('.file-group').forEach((e) => { e.open = true; })")
    page.run("document.getElementById('pose-formats').hidden = false")
    count, faint = page.run(FAINT)
    assert count > 60 and faint == []
    assert page.stage()[5, 5].mean() > 200 if theme == "light" else page.stage()[5, 5].mean() < 80


def test_the_colours_are_those_of_the_system_or_chosen_and_kept(lamp: Page, system: Any) -> None:
    def brightness() -> float:
        return float(lamp.stage()[5, 5].mean())

    system("dark")
    lamp.wait_for("yamaro.stage.theme.shadow > 0.3")
    assert brightness() < 80
    system("light")
    lamp.wait_for("yamaro.stage.theme.shadow < 0.3")
    assert brightness() > 200
    lamp.press("#theme")  # auto, light, dark
    assert lamp.run("document.documentElement.dataset.theme") == "light"
    lamp.key("t")
    assert brightness() < 80
    lamp.show(lamp.viewer)
    assert lamp.run("document.documentElement.dataset.theme") == "dark"
    lamp.press("#theme")
    assert lamp.run("localStorage.getItem('yamaro.theme')") == "auto"


def test_an_editor_around_the_page_gives_its_colours(lamp: Page, system: Any) -> None:
    system("light")
    lamp.run("window.postMessage({type: 'yamaro.theme', theme: 'dark'})")
    lamp.wait_for("document.documentElement.dataset.theme === 'dark'")
    assert lamp.stage()[5, 5].mean() < 80
    lamp.press("#theme")  # what is chosen goes first
    assert lamp.stage()[5, 5].mean() > 200


# --- panels -------------------------------------------------------------------------------------


def width_of(page: Page, panel: str) -> float:
    width: float = page.run(f"document.getElementById('{panel}').getBoundingClientRect().width")
    return width


def test_panels_are_widened_by_pointer_and_by_keys_and_stay_so(lamp: Page) -> None:
    left, right = width_of(lamp, "left"), width_of(lamp, "right")
    x, y = lamp.middle_of("#left-handle")
    lamp.drag_through((x, y), (x + 20, y), (x + 40, y))
    assert width_of(lamp, "left") == left + 40
    lamp.run("document.getElementById('right-handle').focus()")
    lamp.key("ArrowLeft")
    assert width_of(lamp, "right") == right + 16
    lamp.key("ArrowRight")
    lamp.key("ArrowRight", keys=SHIFT)
    assert width_of(lamp, "right") == right - 64
    assert lamp.run("document.activeElement.ariaValueNow") == str(right - 64)
    lamp.show(lamp.viewer)
    assert (width_of(lamp, "left"), width_of(lamp, "right")) == (left + 40, right - 64)
    x, y = lamp.middle_of("#left-handle")
    lamp.drag_through((x, y), (x + 800, y))  # the scene keeps its room
    assert width_of(lamp, "left") == 900 - (right - 64) - 240
    lamp.run("document.getElementById('left-handle').dispatchEvent(new Event('dblclick'))")
    assert width_of(lamp, "left") == left


# --- for all ------------------------------------------------------------------------------------


def test_every_control_has_a_name_and_is_reached_by_keys(lamp: Page) -> None:
    lamp.press("#tree [data-link=left_link]")
    unnamed = lamp.run(
        "[...document.querySelectorAll('button, input, select, textarea, [role=separator]')]"
        ".filter((e) => e.checkVisibility({ visibilityProperty: true }))"
        ".filter((e) => !(e.ariaLabel || e.innerText.trim() || e.labels?.[0]?.innerText.trim()))"
        ".map((e) => e.outerHTML)"
    )
    assert unnamed == []
    unreachable = lamp.run(
        "[...document.querySelectorAll('button, input, select, [role=separator]')]"
        ".filter((e) => e.checkVisibility({ visibilityProperty: true }) && e.tabIndex < 0)"
        ".filter((e) => e.className !== 'fold').map((e) => e.outerHTML)"
    )
    assert unreachable == []


def test_the_page_is_of_use_on_a_phone(lamp: Page) -> None:
    lamp.resize(390, 844)
    try:
        assert lamp.run("document.documentElement.scrollWidth") <= 390
        for selector in ("#drag", "#picture", "#theme", "#states", "#pose-copy"):
            x, y = lamp.middle_of(selector)
            assert 0 <= x <= 390 and 0 <= y <= 844
            assert lamp.run(
                f"document.elementFromPoint({x}, {y}).closest({selector!r}) !== null"
            ), selector
        lamp.press("#pose-copy")
        assert "states:" in lamp.text("#pose-formats")
        box = lamp.run("document.getElementById('pose-formats').getBoundingClientRect().toJSON()")
        assert box["left"] >= 0 and box["right"] <= 390
        assert box["bottom"] <= 844
    finally:
        lamp.resize(900, 600)
