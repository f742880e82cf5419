"""Measures what it costs not to trust a file: `--safe` and `--jail` next to neither.

Safe mode has its jail around it, where the kernel has one. Every run is a process of its own, as
people start it. What it writes is compared first: it has to be the same to the byte.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from measuring import YAMARO, Figure, Setting, main, run, run_in_turns, shown

from yamaro.sandbox import jail

FOLDER = Path(__file__).parent
HEXAPOD = FOLDER.parent / "examples" / "hexapod" / "hexapod.yaml"
LEGS = FOLDER / "legs" / "legs.yaml"


def commands(words: list[str]) -> dict[str, list[str]]:
    """Return the command line of each mode that there is here."""
    modes = {"trusted": "--trust", "safe": "--safe", "jail": "--jail"}
    if jail.check_available() is not None:
        del modes["jail"]
    return {name: [*YAMARO, "-q", mode, *words] for name, mode in modes.items()}


def compare(programs: dict[str, list[str]], folder: Path) -> None:
    """End the run if a mode writes other bytes than the trusted one."""
    for name, command in programs.items():
        run(command, folder / name)
        if (folder / name).read_bytes() != (folder / "trusted").read_bytes():
            sys.exit(f"{' '.join(command)} writes other bytes than a trusted run")


def measure(setting: Setting) -> Iterator[Figure]:
    legs = setting.sized(1_000)
    works = {
        "hexapod": [str(HEXAPOD)],
        f"legs {legs:,}": [str(LEGS), f"n:={legs}"],
    }
    for work, words in works.items():
        programs = commands(words)
        with tempfile.TemporaryDirectory() as folder:
            compare(programs, Path(folder))
        found = run_in_turns(programs, setting)
        for mode in list(programs)[1:]:
            ratio = found[mode] / found["trusted"]
            yield Figure(f"{work}: --{mode} / trusted", ratio, " ×", shown(found))


if __name__ == "__main__":
    main(measure, __doc__)
