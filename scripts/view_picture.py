"""Draw docs/view.png anew: the page of `yamaro view` while a joint of the hexapod is dragged.

    python scripts/view_picture.py

Needs Chromium. `scripts/pictures` draws all other pictures.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import PIL.Image

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from tests.tools.view import chromium  # noqa: E402
from tests.tools.view.conftest import Page  # noqa: E402
from tests.tools.view.scene import place_of  # noqa: E402

PICTURE = ROOT / "docs" / "view.png"
WIDTH, HEIGHT = 1280, 800
SHIFT = """(({camera, controls, radius}) => {
  const way = camera.position.clone().sub(controls.target);
  const right = way.clone().cross(camera.up).normalize().multiplyScalar(0.34 * radius);
  controls.target.add(right);
  camera.position.copy(controls.target).add(way.multiplyScalar(1.35));
  controls.update();
})(yamaro.stage)"""
"""Moves the robot to the right, from behind the card."""
STANCE = {  # rad, of coxa, femur and tibia: three legs stand, three are lifted
    "standing": (-0.15, 0.1, -0.25),
    "lifted": (0.15, 0.6, -0.75),
}
LEGS = {
    "left_front": "standing", "left_middle": "lifted", "left_rear": "standing",
    "right_front": "lifted", "right_middle": "standing", "right_rear": "lifted",
}  # fmt: skip


def main() -> None:
    program = chromium.find()
    if program is None:
        sys.exit("Chromium is missing (Debian, Ubuntu: apt install chromium)")
    command = [sys.executable, "-m", "yamaro", "view", "--no-browser", "--editor", "code {file}"]
    viewer = subprocess.Popen(
        [*command, "hexapod.yaml"],
        cwd=ROOT / "examples" / "hexapod",
        env={**os.environ, "PYTHONPATH": str(ROOT / "src")},
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    assert viewer.stdout is not None
    page = Page(program, width=WIDTH, height=HEIGHT)
    try:
        page.open(viewer.stdout.readline().strip())
        page.wait_for("Boolean(window.yamaro && yamaro.version > 0)")
        draw(page)
    finally:
        page.close()
        viewer.send_signal(signal.SIGINT)
        viewer.wait()


def draw(page: Page) -> None:
    """Pose the robot, measure between two links, and take the picture during a drag."""
    for leg, stance in LEGS.items():
        for part, angle in zip(("coxa", "femur", "tibia"), STANCE[stance], strict=True):
            page.run(f"yamaro.setJoint('{leg}_{part}_joint', {angle})")
    page.press("#tree [data-link=left_rear_femur_link]")
    page.run(
        "(e => { e.value = 'left_rear_foot_link'; e.dispatchEvent(new Event('change')); })"
        "(document.getElementById('between-to'))"
    )
    page.run(SHIFT)
    x, y = place_of(page, "left_front_tibia_link", (0.01, 0, -0.06))
    page.drag_through((x, y), (x + 6, y + 2), (x + 14, y + 3), drop=False)
    page.wait_for("!document.getElementById('drag-value').hidden")
    page.run("yamaro.stage.drawNow()")
    image = PIL.Image.fromarray(page.picture().astype("uint8"))
    few = image.quantize(256, PIL.Image.Quantize.FASTOCTREE, dither=PIL.Image.Dither.NONE)
    few.save(PICTURE, optimize=True)
    page.drop(x + 20, y + 4)


if __name__ == "__main__":
    main()
