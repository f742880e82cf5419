"""Runs a notebook in JupyterLab as a person does, in Chromium, and looks at the robots in it."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from PIL import Image  # noqa: E402

from tests import chromium  # noqa: E402
from tests.chromium import Chromium  # noqa: E402
from tests.waiting import wait_for  # noqa: E402

CELLS = [
    'import yamaro\n\nyamaro.build("examples/quadruped/quadruped.yaml")',
    'yamaro.Robot.from_urdf("robot.urdf")',
    'yamaro.build("launch.yaml")',
]
URDF = """<robot name="red"><link name="base"><visual><geometry><sphere radius="0.3"/></geometry>
<material name="red"><color rgba="1 0 0 1"/></material></visual></link></robot>"""
LAUNCH = "launch:\n  node/name=talker:\n"
PICTURE = ROOT / "docs" / "pictures" / "notebook.png"


def notebook_of(cells: list[str]) -> str:
    """Return a notebook that was not run."""
    told = [
        {"cell_type": "code", "id": f"cell-{number}", "metadata": {}, "source": cell,
         "execution_count": None, "outputs": []}
        for number, cell in enumerate(cells)
    ]  # fmt: skip
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    return json.dumps(
        {"cells": told, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}
    )


def count_of_reds(pixels: Any) -> int:
    red, green, blue = pixels[..., 0], pixels[..., 1], pixels[..., 2]
    return int(((red > 90) & (red > 2.2 * green) & (red > 2.2 * blue)).sum())


def save(browser: Chromium, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    image = Image.fromarray(browser.picture().astype("uint8")).convert("RGB")
    image.quantize(224, dither=Image.Dither.NONE).save(path, optimize=True)
    print(path)


@contextmanager
def running_lab(folder: Path) -> Iterator[str]:
    """Run JupyterLab in a folder; give the address of its notebook."""
    options = ("--no-browser", "--allow-root", "--port=0", "--LabApp.expose_app_in_browser=True")
    server = subprocess.Popen(
        [sys.executable, "-m", "jupyter", "lab", *options, f"--ServerApp.root_dir={folder}"],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "JUPYTER_CONFIG_DIR": str(folder / ".config")},
        cwd=folder,
    )
    assert server.stderr is not None
    try:
        found = None
        while not found:
            line = server.stderr.readline()
            assert line, "JupyterLab has ended"
            found = re.search(r"(http://(?:localhost|127\.0\.0\.1):\d+)/lab\?(token=\w+)", line)
        threading.Thread(target=server.stderr.read, daemon=True).start()
        yield f"{found[1]}/lab/tree/robot.ipynb?{found[2]}"
    finally:
        server.terminate()
        server.wait()
        server.stderr.close()


def run_in_lab(browser: Chromium, url: str) -> None:
    """Open the notebook in JupyterLab, and run all its cells."""
    browser.open(url)
    browser.wait_for("Boolean(document.querySelector('.jp-Notebook .jp-CodeCell'))")
    browser.run(  # which asks whether it may fetch news
        "document.head.appendChild(document.createElement('style')).textContent ="
        " '.Toastify { display: none }'"
    )
    browser.wait_for("Boolean(window.jupyterapp?.shell?.currentWidget?.context?.isReady)")
    browser.run(
        "jupyterapp.shell.currentWidget.sessionContext.ready"
        ".then(() => jupyterapp.commands.execute('notebook:run-all-cells')).then(() => true)"
    )


def wait_for_drawing(browser: Chromium) -> None:
    """Wait until what is seen stays the same: the pages in the frames are closed to scripts."""
    before = browser.picture()
    while True:
        time.sleep(3)
        now = browser.picture()
        if (now == before).all():
            return
        before = now


def try_all(folder: Path, pictures: Path) -> None:
    """Look at the cells in JupyterLab, and in HTML."""
    (folder / "robot.ipynb").write_text(notebook_of(CELLS), encoding="utf-8")
    browser = start_browser(1100, 1400)
    try:
        with running_lab(folder) as url:
            run_in_lab(browser, url)
            browser.wait_for("document.querySelectorAll('.jp-OutputArea iframe').length == 2")
            wait_for(lambda: count_of_reds(browser.picture()) > 5000, pause=1)
            wait_for_drawing(browser)
            save(browser, pictures / "lab.png")
            text = browser.run("document.querySelector('.jp-OutputArea pre').textContent")
            assert '<node name="talker"/>' in text, text
        command = [sys.executable, "-m", "nbconvert", "--execute", "--to", "html", "robot.ipynb"]
        subprocess.run(command, cwd=folder, check=True, stderr=subprocess.DEVNULL)
        browser.open((folder / "robot.html").as_uri())
        browser.wait_for("document.querySelectorAll('iframe').length == 2")
        wait_for(lambda: count_of_reds(browser.picture()) > 5000, pause=1)
        wait_for_drawing(browser)
        save(browser, pictures / "nbconvert.png")
    finally:
        browser.close()


def draw_picture(folder: Path) -> None:
    """Draw the picture of the docs."""
    (folder / "robot.ipynb").write_text(notebook_of(CELLS[:1]), encoding="utf-8")
    browser = start_browser(960, 640)
    try:
        with running_lab(folder) as url:
            run_in_lab(browser, url)
            browser.run("jupyterapp.commands.execute('application:toggle-left-area')")
            browser.wait_for("document.querySelectorAll('.jp-OutputArea iframe').length == 1")
            wait_for_drawing(browser)
            save(browser, PICTURE)
    finally:
        browser.close()


def start_browser(width: int, height: int) -> Chromium:
    program = chromium.find()
    assert program is not None, "Chromium is missing (Debian: apt install chromium)"
    return Chromium(program, width=width, height=height)


def main(arguments: list[str]) -> None:
    with tempfile.TemporaryDirectory(prefix="yamaro-notebook-") as name:
        folder = Path(name)
        (folder / "examples").symlink_to(ROOT / "examples")
        (folder / "robot.urdf").write_text(URDF, encoding="utf-8")
        (folder / "launch.yaml").write_text(LAUNCH, encoding="utf-8")
        if arguments == ["--docs"]:
            draw_picture(folder)
        else:
            try_all(folder, Path(arguments[0] if arguments else ROOT / "build" / "notebook"))


if __name__ == "__main__":
    main(sys.argv[1:])
