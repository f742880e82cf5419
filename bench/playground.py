"""Measures how long the playground takes until a robot is seen, and until one is built.

    python bench/playground.py [--runs N]

The folder that scripts/playground builds, or the one that PLAYGROUND names, is served on this
machine, and opened in Chromium, which begins each time with an empty cache.
"""

from __future__ import annotations

import os
import statistics
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from measuring import Figure, Setting, main, run

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from tests import chromium  # noqa: E402
from tests.serving import served  # noqa: E402

MOST = 6000.0  # ms
SEEN = "Boolean(document.getElementById('viewer')?.contentWindow?.yamaro?.robot)"
BUILT = "Boolean(window.playground?.built && playground.isReady)"


def measure(setting: Setting) -> Iterator[Figure]:
    program = chromium.find()
    if program is None:
        sys.exit("this needs Chromium")
    with tempfile.TemporaryDirectory() as temporary:
        folder = os.environ.get("PLAYGROUND", temporary)
        if folder == temporary:
            run([str(ROOT / "scripts" / "playground"), folder])
        with served(Path(folder)) as address:
            times = [opened(program, address) for _ in range(setting.runs)]
    names = ("robot seen", "robot built by Python")
    for name, found in zip(names, zip(*times, strict=True), strict=True):
        ms = [f"{one * 1e3:.0f}" for one in found]
        detail = f"of {', '.join(ms)} ms"
        yield Figure(
            f"playground, {name}", statistics.median(found) * 1e3, " ms", detail, most=MOST
        )


def opened(program: str, address: str) -> tuple[float, float]:
    """Return the seconds until a robot is seen, and until Python has built it."""
    page = chromium.Chromium(program, width=1280, height=800)
    try:
        page.open("about:blank")
        started = time.perf_counter()
        page.open(address)
        page.wait_for(SEEN)
        seen = time.perf_counter() - started
        page.wait_for(BUILT)
        return seen, time.perf_counter() - started
    finally:
        page.close()


if __name__ == "__main__":
    main(measure, __doc__)
