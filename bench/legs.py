"""Compares Yamaro with xacro and a hand-written script on a robot with many legs.

The robot of bench/legs/ has n legs of three revolute parts each, with geometry, inertia and poses
by trigonometry. Every run is a process of its own, as people start it. What the programs write is
compared first.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

from measuring import XACRO, YAMARO, Figure, Setting, main, peak_memory, run, run_in_turns, shown

FOLDER = Path(__file__).parent / "legs"


def xacro_source(legs: int, folder: Path) -> Path:
    """Write the xacro file with a call for each leg, and return its path."""
    calls = "".join(f'  <xacro:leg i="{i}" angle="${{2*pi*{i}/n}}"/>\n' for i in range(legs))
    text = (FOLDER / "legs.xacro").read_text(encoding="utf-8")
    text = text.replace('name="n" value="6"', f'name="n" value="{legs}"')
    path = folder / f"legs_{legs}.xacro"
    path.write_text(text.replace("</robot>", f"{calls}</robot>"), encoding="utf-8")
    return path


def yamaro_command(legs: int) -> list[str]:
    return [*YAMARO, str(FOLDER / "legs.yaml"), f"n:={legs}"]


def commands(legs: int, folder: Path, *, with_xacro: bool) -> dict[str, list[str]]:
    """Return the command line of each program."""
    found = {
        "yamaro": yamaro_command(legs),
        "script": [sys.executable, str(FOLDER / "legs_script.py"), str(legs)],
    }
    if with_xacro:
        found["xacro"] = [*XACRO, str(xacro_source(legs, folder))]
    return found


def compare(programs: dict[str, list[str]], folder: Path) -> None:
    """End the run if a program writes another robot than the script does."""
    contents = {}
    for name, command in programs.items():
        run(command, folder / f"{name}.urdf")
        contents[name] = content(ElementTree.parse(folder / f"{name}.urdf").getroot())
    for name, found in contents.items():
        if found != contents["script"]:
            sys.exit(f"{' '.join(programs[name])} writes another robot than the script")


def content(element: ElementTree.Element) -> tuple[object, ...]:
    """Return what an element says; the order of its children does not matter."""
    attributes = tuple(sorted((name, rounded(value)) for name, value in element.attrib.items()))
    return (element.tag, attributes, tuple(sorted(map(content, element))))


def rounded(text: str) -> str:
    """Return a text with its numbers at nine decimals, which is beyond what the sums differ by."""
    words = []
    for word in text.split():
        try:
            words.append(f"{float(word) + 0.0:.9f}")
        except ValueError:
            words.append(word)
    return " ".join(words)


def medians(legs: int, folder: Path, setting: Setting, *, with_xacro: bool) -> dict[str, float]:
    """Return the median seconds of each program, having compared what they write."""
    programs = commands(legs, folder, with_xacro=with_xacro)
    compare(programs, folder)
    return run_in_turns(programs, setting)


def measure(setting: Setting) -> Iterator[Figure]:
    few, many, very_many = 6, setting.sized(1_000), setting.sized(10_000)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        found = medians(few, folder, setting, with_xacro=True)
        ratio = found["yamaro"] / found["xacro"]
        yield Figure(f"legs {few}: Yamaro / xacro", ratio, " ×", shown(found), most=0.8)

        found = medians(many, folder, setting, with_xacro=True)
        ratio = found["xacro"] / found["yamaro"]
        yield Figure(f"legs {many:,}: xacro / Yamaro", ratio, " ×", shown(found), least=20)

        found = medians(very_many, folder, setting, with_xacro=False)
        ratio = found["yamaro"] / found["script"]
        yield Figure(f"legs {very_many:,}: Yamaro / script", ratio, " ×", shown(found), most=5)

        peak = peak_memory(yamaro_command(very_many))
        size = os.path.getsize(folder / "yamaro.urdf")
        sizes = f"memory {peak / 1e6:,.0f} MB, output {size / 1e6:,.1f} MB"
        work = f"legs {very_many:,}: peak memory / output"
        yield Figure(work, peak / size, " ×", sizes, most=10)


if __name__ == "__main__":
    main(measure, __doc__)
