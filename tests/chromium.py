"""Drives a headless Chromium over its debugging pipe: no other package is needed for that."""

from __future__ import annotations

import base64
import io
import json
import os
import select
import shutil
import subprocess
import sys
import tempfile
import time
from typing import Any

import numpy as np
from PIL import Image

from tests.waiting import PATIENCE, wait_for

NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
OPTIONS = (
    "--headless",
    "--no-sandbox",  # Docker and CI run as root, which the sandbox refuses
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-dev-shm-usage",
    "--remote-debugging-pipe",
    # WebGL by software, on machines without a graphics card.
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
)
# Chromium reads commands from descriptor 3 and writes answers to 4.
_WITH_PIPES = """
import os, sys
os.dup2(int(sys.argv[1]), 3)
os.dup2(int(sys.argv[2]), 4)
os.execv(sys.argv[3], sys.argv[3:])
"""


class PageLeft(AssertionError):
    """The page was left for another while it worked on a command."""


class Chromium:
    """A browser with one page.

    Attributes:
        complaints: what the page wrote to the console as an error or a warning, and exceptions.
    """

    def __init__(self, program: str, *options: str, width: int, height: int) -> None:
        self._folder = tempfile.mkdtemp(prefix="yamaro-chromium-")
        to_browser, self._writer = os.pipe()
        self._reader, from_browser = os.pipe()
        command = [program, *OPTIONS, *options, f"--user-data-dir={self._folder}", "about:blank"]
        numbers = [str(to_browser), str(from_browser)]
        self._process = subprocess.Popen(
            [sys.executable, "-I", "-S", "-c", _WITH_PIPES, *numbers, *command],
            pass_fds=(to_browser, from_browser),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(to_browser)
        os.close(from_browser)
        self._buffer = b""
        self._last_id = 0
        self._page = ""
        self.complaints: list[str] = []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self._page = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.call(f"{domain}.enable")
        self.resize(width, height)

    def close(self) -> None:
        self._process.terminate()
        self._process.wait(PATIENCE)
        os.close(self._writer)
        os.close(self._reader)
        shutil.rmtree(self._folder, ignore_errors=True)

    # --- the protocol ---------------------------------------------------------------------------

    def call(self, method: str, **parameters: Any) -> Any:
        """Return the answer to a command."""
        self._last_id += 1
        message: dict[str, Any] = {"id": self._last_id, "method": method, "params": parameters}
        if self._page:
            message["sessionId"] = self._page
        os.write(self._writer, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._read()
            if answer.get("id") == message["id"]:
                if "navigated" in answer.get("error", {}).get("message", ""):
                    raise PageLeft(answer["error"])
                assert "error" not in answer, answer["error"]
                return answer["result"]
            self._note(answer)

    def _read(self) -> Any:
        give_up = time.monotonic() + PATIENCE
        while b"\0" not in self._buffer:
            ready, _, _ = select.select([self._reader], [], [], give_up - time.monotonic())
            chunk = os.read(self._reader, 1 << 16) if ready else b""
            assert chunk, "the browser does not answer"
            self._buffer += chunk
        message, _, self._buffer = self._buffer.partition(b"\0")
        return json.loads(message)

    def _note(self, event: Any) -> None:
        parameters = event.get("params", {})
        if event.get("method") == "Runtime.consoleAPICalled":
            if parameters["type"] in ("error", "warning", "assert"):
                self.complaints.append(json.dumps(parameters["args"]))
        elif event.get("method") == "Runtime.exceptionThrown":
            self.complaints.append(json.dumps(parameters["exceptionDetails"]))
        elif event.get("method") == "Log.entryAdded":
            if parameters["entry"]["level"] in ("error", "warning"):
                self.complaints.append(json.dumps(parameters["entry"]))

    # --- the page -------------------------------------------------------------------------------

    def resize(self, width: int, height: int) -> None:
        self.call(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=False,
        )

    def open(self, url: str) -> None:
        self.call("Page.navigate", url=url)

    def run(self, script: str) -> Any:
        """Return the value of an expression in JavaScript."""
        answer = self.call(
            "Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True
        )
        assert "exceptionDetails" not in answer, answer["exceptionDetails"]
        return answer["result"].get("value")

    def wait_for(self, script: str) -> Any:
        """Return the value of an expression once it is true, on this page or the next."""

        def value() -> Any:
            try:
                return self.run(script)
            except PageLeft:
                return None

        try:
            return wait_for(value)
        except AssertionError as error:
            raise AssertionError(f"{script}: {error}; complaints: {self.complaints}") from None

    def picture(self, box: tuple[int, int, int, int] | None = None) -> np.ndarray[Any, Any]:
        """Return the pixels of the page, or of x, y, width, height of it, as rows of RGB."""
        data = base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
        image = Image.open(io.BytesIO(data)).convert("RGB")
        if box is not None:
            image = image.crop((box[0], box[1], box[0] + box[2], box[1] + box[3]))
        return np.asarray(image).astype(int)

    def click(self, x: float, y: float) -> None:
        """Click with the mouse, coming from elsewhere."""
        self._mouse("mouseMoved", x, y, "none")
        self._mouse("mousePressed", x, y, "left")
        self._mouse("mouseReleased", x, y, "left")

    def drag(self, x: float, y: float, *, right: float) -> None:
        self._mouse("mouseMoved", x, y, "none")
        self._mouse("mousePressed", x, y, "left")
        self._mouse("mouseMoved", x + right, y, "left")
        self._mouse("mouseReleased", x + right, y, "left")

    def drag_through(self, *points: tuple[float, float], keys: int = 0, drop: bool = True) -> None:
        """Drag with the mouse from the first point through the others.

        Args:
            points: x and y on the page.
            keys: the modifiers that are held: 1 is Alt, 2 Ctrl, 8 Shift.
            drop: whether the button is let go at the end.
        """
        self._mouse("mouseMoved", *points[0], "none", keys)
        self._mouse("mousePressed", *points[0], "left", keys)
        for x, y in points[1:]:
            self._mouse("mouseMoved", x, y, "left", keys)
        if drop:
            self.drop(*points[-1], keys=keys)

    def drop(self, x: float, y: float, *, keys: int = 0) -> None:
        """Let the mouse button go."""
        self._mouse("mouseReleased", x, y, "left", keys)

    def key(self, key: str, *, keys: int = 0) -> None:
        """Press a key, such as `ArrowLeft`, and let it go."""
        text = {"text": key} if len(key) == 1 else {}
        self.call("Input.dispatchKeyEvent", type="keyDown", key=key, modifiers=keys, **text)
        self.call("Input.dispatchKeyEvent", type="keyUp", key=key, modifiers=keys)

    def _mouse(self, kind: str, x: float, y: float, button: str, keys: int = 0) -> None:
        self.call(
            "Input.dispatchMouseEvent",
            type=kind, x=x, y=y, button=button, clickCount=1, modifiers=keys,
        )  # fmt: skip

    def middle_of(self, selector: str) -> tuple[float, float]:
        """Return where an element is, having scrolled to it."""
        box = self.run(
            f"(() => {{ const e = document.querySelector({json.dumps(selector)});"
            " e.scrollIntoView({block: 'nearest'}); const r = e.getBoundingClientRect();"
            " return [r.x + r.width / 2, r.y + r.height / 2]; })()"
        )
        return box[0], box[1]

    def press(self, selector: str) -> None:
        """Click on an element."""
        self.click(*self.middle_of(selector))

    def type(self, text: str) -> None:
        self.call("Input.insertText", text=text)


def find() -> str | None:
    """Return the path of a Chromium, or None."""
    return next(filter(None, map(shutil.which, NAMES)), None)
