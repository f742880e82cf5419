"""Measures how long a save of the hexapod takes to be seen on the page of `yamaro view`."""

from __future__ import annotations

import itertools
import os
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
import urllib.request
from collections.abc import Iterator
from pathlib import Path

from measuring import ENVIRONMENT, Figure, Setting, main

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from tests import chromium  # noqa: E402

MOST = 300.0  # ms, from the save to the picture
PAUSE = 0.4  # seconds between saves, which come at no fixed moment of the watch
WHEN_SHOWN = """
new Promise(resolve => {
  const look = () => {
    if (yamaro.version <= %d) return setTimeout(look, 1);
    yamaro.stage.renderer.getContext().finish();
    resolve(Date.now());
  };
  look();
})
"""


def measure(setting: Setting) -> Iterator[Figure]:
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(ROOT / "examples" / "hexapod", folder, dirs_exist_ok=True)
        command = [sys.executable, "-m", "yamaro", "view", "--no-browser", "hexapod.yaml"]
        started = time.perf_counter()
        with subprocess.Popen(
            command,
            cwd=folder,
            env=ENVIRONMENT,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        ) as process:
            assert process.stdout is not None
            url = process.stdout.readline().strip()
            yield Figure("view: start", (time.perf_counter() - started) * 1e3, " ms")
            try:
                yield from saves(Path(folder, "leg.yaml"), url, setting)
            finally:
                process.send_signal(signal.SIGINT)


def saves(path: Path, url: str, setting: Setting) -> Iterator[Figure]:
    texts = itertools.cycle(
        path.read_text().replace("femur_length: 0.066", f"femur_length: {length}")
        for length in (0.07, 0.08, 0.09)
    )
    with urllib.request.urlopen(f"{url}events") as events:
        events.readline()
        events.readline()
        seconds = []
        for turn in range(4 * setting.runs):
            time.sleep(PAUSE + 0.007 * turn)
            started = time.perf_counter()
            path.write_text(next(texts))
            while not events.readline().startswith(b"data:"):
                pass
            seconds.append(time.perf_counter() - started)
    yield Figure("view: save of the hexapod until built", statistics.median(seconds) * 1e3, " ms")
    program = chromium.find()
    if program is not None:
        yield until_seen(program, path, url, texts, setting)


def until_seen(
    program: str, path: Path, url: str, texts: Iterator[str], setting: Setting
) -> Figure:
    page = chromium.Chromium(program, width=1280, height=800)
    page.open(url)
    page.wait_for("Boolean(window.yamaro && yamaro.version > 0)")
    seconds = []
    for turn in range(4 * setting.runs + 1):
        version = page.run("yamaro.version")
        page.run(f"window.shown = 0; ({WHEN_SHOWN % version}).then(time => window.shown = time); 0")
        time.sleep(PAUSE + 0.007 * turn)
        started = time.time()
        path.write_text(next(texts))
        seconds.append(page.wait_for("window.shown") / 1e3 - started)
    page.close()
    median = statistics.median(seconds[1:]) * 1e3
    return Figure("view: until seen, drawn by software", median, " ms", most=MOST)


if __name__ == "__main__":
    os.environ.setdefault("NO_COLOR", "1")
    main(measure, __doc__)
