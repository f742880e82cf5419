"""Draw docs/view.png and docs/view.gif anew: the page of `yamaro view`.

    python scripts/view_picture.py

The picture shows it while a joint of the hexapod is dragged. The film shows it beside an editor, in
which the spider of the README is changed and saved. Needs Chromium. `scripts/pictures` draws all
other pictures.
"""

from __future__ import annotations

import contextlib
import html
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import PIL.Image

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from tests import chromium  # noqa: E402
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


FILM = ROOT / "docs" / "view.gif"
SPIDER = ROOT / "docs" / "pictures" / "spider.yaml"
EDITOR_WIDTH, VIEW_WIDTH, FILM_HEIGHT = 380, 680, 480
FIRST_LINE, LINES = 5, 20
"""The lines of the spider that the editor shows."""
EDITS = (  # behind what, what is deleted, what is typed; the file is saved after each row
    (("range(", "6", "8"), ("$(i * ", "60", "45")),
    (("color: ", "0.9 0.6 0.2", "0.2 0.6 0.4"),),
    (("parent: b", "o", ""),),
    (("parent: b", "", "o"),),
)
KEY, SAVED, LAST = 130, 1900, 2600
"""How long a frame is seen, in ms: after a key, after a save, at the end."""
EDITOR = """<!DOCTYPE html><meta charset="utf-8"><style>
body { margin: 0; background: #1e222a; color: #d7dae0; overflow: hidden; }
header { font: 14px system-ui, sans-serif; padding: 13px 16px; background: #171a20; height: 18px; }
header b { float: right; font-weight: normal; color: #8bd49c; }
pre { font: 13px/21.5px ui-monospace, "DejaVu Sans Mono", monospace; margin: 8px 12px; }
i { font-style: normal; color: #7cb7ff; } s { text-decoration: none; color: #5a6270; }
u { text-decoration: none; border-left: 2px solid #ffd866; margin: 0 -1px; }
</style><header>spider.yaml<b></b></header><pre></pre>"""


def main() -> None:
    program = chromium.find()
    if program is None:
        sys.exit("Chromium is missing (Debian, Ubuntu: apt install chromium)")
    with viewer(ROOT / "examples" / "hexapod" / "hexapod.yaml") as address:
        page = Page(program, width=WIDTH, height=HEIGHT)
        with contextlib.closing(page):
            open_view(page, address)
            draw(page)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(shutil.copy(SPIDER, folder))
        with viewer(path) as address:
            page = Page(program, width=VIEW_WIDTH, height=2 * FILM_HEIGHT)
            editor = Page(program, width=EDITOR_WIDTH, height=FILM_HEIGHT)
            with contextlib.closing(page), contextlib.closing(editor):
                open_view(page, address)
                (path.parent / "editor.html").write_text(EDITOR, encoding="utf-8")
                editor.open((path.parent / "editor.html").as_uri())
                editor.wait_for("Boolean(document.querySelector('pre'))")
                film(page, editor, path)


@contextlib.contextmanager
def viewer(path: Path) -> Iterator[str]:
    """Run `yamaro view` on a file; the address of its page."""
    command = [sys.executable, "-m", "yamaro", "view", "--no-browser", "--editor", "code {file}"]
    process = subprocess.Popen(
        [*command, path.name],
        cwd=path.parent,
        env={**os.environ, "PYTHONPATH": str(ROOT / "src")},
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    assert process.stdout is not None
    try:
        yield process.stdout.readline().strip()
    finally:
        process.send_signal(signal.SIGINT)
        process.wait()


def open_view(page: Page, address: str) -> None:
    """Open the page of a viewer, and wait for the robot."""
    page.open(address)
    page.wait_for("Boolean(window.yamaro && yamaro.version > 0)")


def film(page: Page, editor: Page, path: Path) -> None:
    """Change the file as a person would, and keep what both show after each key and each save."""
    frames: list[PIL.Image.Image] = []
    times: list[int] = []

    def take(text: str, caret: int, note: str, time: int) -> None:
        editor.run(f"document.querySelector('pre').innerHTML = {coloured(text, caret)!r}")
        editor.run(f"document.querySelector('header b').textContent = {note!r}")
        frame = PIL.Image.new("RGB", (EDITOR_WIDTH + VIEW_WIDTH, FILM_HEIGHT))
        frame.paste(PIL.Image.fromarray(editor.picture().astype("uint8")), (0, 0))
        frame.paste(seen, (EDITOR_WIDTH, 0))
        frames.append(frame)
        times.append(time)

    text = path.read_text(encoding="utf-8")
    seen = picture(page)
    take(text, text.index("range("), "", SAVED)
    for row in EDITS:
        for place, gone, typed in row:
            start = text.index(place, text.index("- for")) + len(place)
            take(text, start + len(gone), "", 3 * KEY)
            before, after = text[:start], text[start:].removeprefix(gone)
            for end in range(0 if gone else 1, len(typed) + 1):
                take(before + typed[:end] + after, start + end, "", KEY)
            text = before + typed + after
        version = page.version
        path.write_text(text, encoding="utf-8")
        page.wait_for(f"yamaro.version > {version}")
        seen = picture(page)
        take(text, start + len(typed), "saved", LAST if row is EDITS[-1] else SAVED)
    colours = frames[0].quantize(256, PIL.Image.Quantize.FASTOCTREE)
    few = [one.quantize(palette=colours, dither=PIL.Image.Dither.NONE) for one in frames]
    few[0].save(FILM, save_all=True, append_images=few[1:], duration=times, loop=0, optimize=True)


def picture(page: Page) -> PIL.Image.Image:
    """Return the upper part of the page of a viewer: its bar and its stage."""
    page.run("yamaro.stage.drawNow()")
    return PIL.Image.fromarray(page.picture((0, 0, VIEW_WIDTH, FILM_HEIGHT)).astype("uint8"))


def coloured(text: str, caret: int) -> str:
    """Return the lines that the editor shows as HTML: keys in colour, a caret, line numbers."""
    marked = f"{text[:caret]}\0{text[caret:]}"
    shown = []
    lines = marked.split("\n")[FIRST_LINE - 1 : FIRST_LINE - 1 + LINES]
    for number, line in enumerate(lines, FIRST_LINE):
        line = re.sub(r"([\w\0]+)(?=:( |$))", r"<i>\1</i>", html.escape(line, quote=False))
        shown.append(f"<s>{number:2}</s>  {line}")
    return "\n".join(shown).replace("\0", "<u></u>")


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
