"""Measures `yamaro lsp`: start, diagnostics and completion in a long robot, memory, many edits."""

from __future__ import annotations

import gc
import random
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from measuring import ENVIRONMENT, Figure, Setting, main

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from tests.tools.lsp.client import Client  # noqa: E402
from tests.tools.lsp.editing import edit_at_random  # noqa: E402
from yamaro.tools.lsp.completion import completion  # noqa: E402
from yamaro.tools.lsp.protocol import position_at  # noqa: E402
from yamaro.tools.lsp.workspace import Workspace  # noqa: E402

LINES_OF_PART = 10
EDITS = 10_000
MAINS = [
    ROOT / "examples" / name
    for name in ("arm/arm.yaml", "diff_drive/diff_drive.yaml", "hexapod/hexapod.yaml",
                 "pan_tilt/pan_tilt.yaml", "quadruped/quadruped.yaml")
]  # fmt: skip
EXAMPLES = sorted((ROOT / "examples").rglob("*.yaml"))


def robot(lines: int) -> str:
    """Return a robot of so many lines: a chain of links, each with computed values."""
    parts = [
        f"""- part:
    name: link{index}
    joint:
      type: revolute
      parent: link{index - 1}
      xyz: 0 0 $(length * {index % 7} / 2)
      limit: {{lower: -1, upper: 1, effort: 10, velocity: 2}}
    link:
      geometry: cylinder
      scale: 0.05 $(length)
"""
        for index in range(1, lines // LINES_OF_PART)
    ]
    head = "robot: chain\nvariables:\n  length: 0.3\nmodel:\n- part:\n    name: link0\n"
    return head + "".join(parts)


def memory_of(process: int) -> float:
    """Return the megabytes of memory that a process has now; 0 where nobody tells."""
    try:
        text = Path(f"/proc/{process}/status").read_text()
    except OSError:
        return 0.0
    return int(text.partition("VmRSS:")[2].split()[0]) / 1024


def processor_time(process: int) -> float:
    """Return the seconds that a process has computed, of which the rest of the machine takes none.

    Where nobody tells it is the time of the wall clock.
    """
    try:
        threads = list(Path(f"/proc/{process}/task").iterdir())
        return sum(int((each / "schedstat").read_text().split()[0]) for each in threads) / 1e9
    except OSError:
        return time.perf_counter()


def starts(setting: Setting) -> Iterator[Figure]:
    seconds, megabytes = [], 0.0
    for _ in range(setting.runs):
        started = time.perf_counter()
        with Client(env=ENVIRONMENT) as client:
            seconds.append(time.perf_counter() - started)
            client.close()
    yield Figure("lsp: start until it is initialized", _median(seconds) * 1e3, " ms", most=120)
    with tempfile.TemporaryDirectory() as folder, Client(env=ENVIRONMENT) as client:
        uri = client.open(Path(folder, "a.yaml"), EXAMPLES[0].read_text(encoding="utf-8"))
        client.wait_for(lambda: sum(each["uri"] == uri for each in client.published) > 1)
        megabytes = memory_of(client.process.pid)
    yield Figure("lsp: memory with one file, idle", megabytes, " MB", most=60)


def long_robot(setting: Setting) -> Iterator[Figure]:
    text = robot(setting.sized(5_000, 100))
    with (
        tempfile.TemporaryDirectory() as folder,
        Client(env=ENVIRONMENT, options={"pause": 3_600_000}) as client,
    ):
        uri = client.open(Path(folder, "a.yaml"), text)
        client.wait_for(lambda: uri in client.diagnostics)
        changes, offers = [], []
        line = text.count("\n") // 2
        for version in range(2, 2 + 4 * setting.runs):
            place = {"line": line, "character": 0}
            broken = {"range": {"start": place, "end": place}, "text": "# $(\n"}
            before = processor_time(client.process.pid)
            client.change(uri, version, [broken])
            client.wait_for(lambda version=version: client.versions[uri] == version)
            parsed = processor_time(client.process.pid)
            parameters = {"textDocument": {"uri": uri}, "position": _end_of(text)}
            client.request("textDocument/completion", parameters)  # also finds the names anew
            changes.append(parsed - before)
            offers.append(processor_time(client.process.pid) - parsed)
    lines = f"{text.count(chr(10)):,} lines"
    detail = "least processor time of all runs"
    yield Figure(f"lsp: diagnostics of {lines}", min(changes) * 1e3, " ms", detail, most=100)
    yield Figure(f"lsp: completion in {lines}", min(offers) * 1e3, " ms", detail, most=50)


def _end_of(text: str) -> dict[str, int]:
    return {"line": text.count("\n"), "character": 0}


def prefixes(setting: Setting) -> Iterator[Figure]:
    """Complete at prefixes of all examples: every one at the scale of 1."""
    chooser = random.Random(1)
    slowest, count = 0.0, 0
    gc.disable()
    for path in EXAMPLES:
        text = path.read_text(encoding="utf-8")
        offsets = range(len(text) + 1)
        for offset in chooser.sample(offsets, setting.sized(len(offsets))):
            workspace = Workspace()
            opened = workspace.add(path.as_uri(), 1, text[:offset]).text
            parameters = {
                "textDocument": {"uri": path.as_uri()},
                "position": position_at(opened.source, offset, workspace.encoding),
            }
            assert opened.names
            started = time.process_time()  # of which the rest of the machine takes no part
            completion(workspace, parameters)
            slowest = max(slowest, time.process_time() - started)
            count += 1
        gc.collect()  # as the server does: when it has nothing else to do
    detail = f"{count:,} prefixes of {len(EXAMPLES)} files"
    yield Figure("lsp: slowest completion of examples", slowest * 1e3, " ms", detail, most=50)


def edits(setting: Setting) -> Iterator[Figure]:
    """Edit at random, and compare text and reports with those of the editor and the command."""
    count, rounds = setting.sized(EDITS // len(MAINS), 50), 0
    started = time.perf_counter()
    for seed, main_file in enumerate(MAINS):
        with tempfile.TemporaryDirectory() as folder:
            rounds += edit_at_random(Path(folder), main_file, count, seed)
    seconds = time.perf_counter() - started
    work = f"lsp: {count * len(MAINS):,} random edits, all right"
    yield Figure(work, seconds * 1e3, " ms", f"compared {rounds:,} times with yamaro check")


def _median(seconds: list[float]) -> float:
    return sorted(seconds)[len(seconds) // 2]


def measure(setting: Setting) -> Iterator[Figure]:
    yield from starts(setting)
    yield from long_robot(setting)
    yield from prefixes(setting)
    yield from edits(setting)


if __name__ == "__main__":
    main(measure, __doc__)
