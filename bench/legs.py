"""Compares Yamaro with xacro and a hand-written script on a robot with many legs.

The robot of bench/legs/ has n legs of three revolute parts each. Every run is a process of its own,
as people start it; the programs take turns, and medians are compared, so that what else the machine
does falls on all of them alike. Outputs are compared first.
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from xml.etree import ElementTree

FOLDER = Path(__file__).parent / "legs"
BIN = Path(sys.executable).parent
RUNS = 5


def xacro_source(legs: int, folder: Path) -> Path:
    """Write the xacro file with a call for each leg, and return its path."""
    calls = "".join(f'  <xacro:leg i="{i}" angle="${{2*pi*{i}/n}}"/>\n' for i in range(legs))
    text = (FOLDER / "legs.xacro").read_text(encoding="utf-8")
    text = text.replace('name="n" value="6"', f'name="n" value="{legs}"')
    path = folder / f"legs_{legs}.xacro"
    path.write_text(text.replace("</robot>", f"{calls}</robot>"), encoding="utf-8")
    return path


def commands(legs: int, folder: Path, *, with_xacro: bool) -> dict[str, list[str]]:
    """Return the command line of each program."""
    found = {
        "yamaro": [str(BIN / "yamaro"), str(FOLDER / "legs.yaml"), f"n:={legs}"],
        "script": [sys.executable, str(FOLDER / "legs_script.py"), str(legs)],
    }
    if with_xacro:
        found["xacro"] = [str(BIN / "xacro"), str(xacro_source(legs, folder))]
    return found


def run(command: list[str]) -> tuple[float, bytes]:
    """Return the seconds a command takes, and what it writes."""
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    started = time.perf_counter()
    done = subprocess.run(command, stdout=subprocess.PIPE, env=environment, check=True)
    return time.perf_counter() - started, done.stdout


def is_same(first: ElementTree.Element, second: ElementTree.Element) -> bool:
    """Tell whether two trees say the same; the order of links and joints does not matter."""
    return sorted(map(_content, first)) == sorted(map(_content, second))


def _content(element: ElementTree.Element) -> tuple[object, ...]:
    attributes = tuple(sorted((name, _rounded(value)) for name, value in element.attrib.items()))
    return (element.tag, attributes, tuple(sorted(map(_content, element))))


def _rounded(text: str) -> str:
    """Return a text with its numbers at twelve digits, which is beyond what the sums differ by."""
    words = []
    for word in text.split():
        try:
            words.append(f"{float(word) + 0.0:.9f}")
        except ValueError:
            words.append(word)
    return " ".join(words)


def measure(legs: int, *, with_xacro: bool) -> dict[str, float]:
    """Return the median seconds of each program, having compared what they write."""
    with tempfile.TemporaryDirectory() as folder:
        programs = commands(legs, Path(folder), with_xacro=with_xacro)
        trees = {
            name: ElementTree.fromstring(run(command)[1]) for name, command in programs.items()
        }
        for name, tree in trees.items():
            if not is_same(trees["script"], tree):
                raise SystemExit(f"{name} and the script write different robots for {legs} legs")
        times: dict[str, list[float]] = {name: [] for name in programs}
        for _ in range(RUNS):
            for name, command in programs.items():
                times[name].append(run(command)[0])
    return {name: statistics.median(seconds) for name, seconds in times.items()}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("legs", nargs="*", type=int, default=[6, 1000, 10000])
    parser.add_argument("--xacro-up-to", type=int, default=1000, help="too slow beyond")
    arguments = parser.parse_args()
    print(f"{'legs':>6}  {'yamaro':>9}  {'script':>9}  {'xacro':>9}  yamaro/script  xacro/yamaro")
    for legs in arguments.legs:
        found = measure(legs, with_xacro=legs <= arguments.xacro_up_to)
        xacro = found.get("xacro")
        print(
            f"{legs:>6}  {found['yamaro'] * 1e3:>6.0f} ms  {found['script'] * 1e3:>6.0f} ms  "
            + (f"{xacro * 1e3:>6.0f} ms" if xacro else f"{'':>9}")
            + f"  {found['yamaro'] / found['script']:>13.1f}  "
            + (f"{xacro / found['yamaro']:>12.1f}" if xacro else ""),
            flush=True,
        )


if __name__ == "__main__":
    main()
