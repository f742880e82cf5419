"""A browser for all tests of the page, and `yamaro view` for each."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tests import chromium
from tests.chromium import Chromium
from tests.consumers.oracles import missing
from tests.waiting import PATIENCE

ROOT = Path(__file__).parents[3]
EXAMPLES = ROOT / "examples"


class Viewer:
    """A running `yamaro view`."""

    def __init__(self, path: Path, *options: str) -> None:
        self.path = path
        self._log = open(path.parent / "view.log", "w+", encoding="utf-8")  # noqa: SIM115
        command = [sys.executable, "-m", "yamaro", "view", "--no-browser", *options, str(path)]
        environ = {**os.environ, "PYTHONPATH": str(ROOT / "src")}
        self.process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=self._log, text=True, env=environ
        )
        assert self.process.stdout is not None
        self.url = self.process.stdout.readline().strip()

    @property
    def said(self) -> str:
        """What it has said on standard error."""
        self._log.seek(0)
        return self._log.read()

    def end(self) -> int:
        """End it as Ctrl-C does, and return its exit status."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        return self.process.wait(PATIENCE)

    def close(self) -> None:
        """End it, and let go of its streams."""
        self.end()
        assert self.process.stdout is not None
        self.process.stdout.close()
        self._log.close()


class Page(Chromium):
    """The page of a running `yamaro view`."""

    viewer: Viewer

    def show(self, viewer: Viewer) -> None:
        """Open the page, and wait until the robot, or what is wrong with it, is there."""
        self.viewer = viewer
        self.open(viewer.url)
        self.wait_for("Boolean(window.yamaro && yamaro.version > 0)")

    @property
    def version(self) -> int:
        number: int = self.run("yamaro.version")
        return number

    def after(self, change: Callable[[], Any]) -> None:
        """Do something that has the robot built anew, and wait until that is shown."""
        before = self.version
        change()
        self.wait_for(f"yamaro.version > {before}")

    def save(self, text: str, name: str | None = None) -> None:
        """Save a file of the robot, and wait until the page shows what comes of it."""
        path = self.viewer.path if name is None else self.viewer.path.parent / name
        self.after(lambda: path.write_text(text, encoding="utf-8"))

    def stage(self) -> Any:
        """Return the pixels of the robot's stage, without what lies over it."""
        box = self.run(
            "(() => { const r = document.getElementById('canvas')"
            ".getBoundingClientRect(); return [r.x, r.y, r.width, r.height]; })()"
        )
        self.run("yamaro.stage.drawNow()")
        return self.picture(tuple(map(round, box)))  # type: ignore[arg-type]

    def text(self, selector: str) -> str:
        """Return the text of an element that is seen, or nothing."""
        found: str = self.run(
            f"[...document.querySelectorAll({selector!r})]"
            ".filter(e => e.checkVisibility()).map(e => e.innerText).join('\\n')"
        )
        return found


@pytest.fixture(scope="session")
def browser() -> Iterator[Page]:
    program = chromium.find()
    if program is None:
        missing("Chromium")
        raise AssertionError
    page = Page(program, width=900, height=600)
    yield page
    page.close()


@pytest.fixture
def view(tmp_path: Path) -> Iterator[Callable[..., Viewer]]:
    """Start `yamaro view` on a file."""
    running: list[Viewer] = []

    def start(path: Path, *options: str) -> Viewer:
        running.append(Viewer(path, *options))
        return running[-1]

    yield start
    for viewer in running:
        viewer.close()


@pytest.fixture
def page(browser: Page) -> Iterator[Page]:
    """The browser's page; afterwards it must have had nothing to complain of."""
    browser.complaints.clear()
    yield browser
    complaints = list(browser.complaints)
    browser.open("about:blank")
    browser.complaints.clear()
    assert complaints == []
