"""Counts what the number in `mass: 1.2` passes on its way to MJCF.

    python bench/mass.py

The command counts the functions of Yamaro that run in a new process for a robot of one part. A part
counts the calls that one more part costs, by room, and how often a text is read as numbers after
the first time, where the user wrote it.
"""

from __future__ import annotations

import sys
import tempfile
import threading
from collections import Counter
from pathlib import Path
from types import FrameType

PART = """
  - part:
      name: p{i}
      joint: {{type: {type}, parent: {parent}}}
      link:
        mass: {mass}
        geometry: box
        scale: {size} 0.2 0.3
        collision:
"""
READ = ("model/values.py", "read_numbers")


class Calls(Counter[tuple[str, str, int]]):
    """How often each function of Yamaro was called: its file, its name and its line."""

    def __call__(self, frame: FrameType, event: str, argument: object) -> None:
        """Count a call, as a profiler of Python."""
        code = frame.f_code
        if event == "call" and "/yamaro/" in code.co_filename and code.co_name[0] != "<":
            file = code.co_filename.rpartition("/yamaro/")[2]
            self[file, code.co_name, code.co_firstlineno] += 1

    def of(self, *arguments: str) -> Calls:
        """Count the calls of the command line with these arguments."""
        from yamaro.commands.main import main

        threading.setprofile(self)
        sys.setprofile(self)
        try:
            main(list(arguments))
        finally:
            sys.setprofile(None)
            threading.setprofile(None)  # type: ignore[arg-type]
        return self


def robot(parts: int) -> str:
    """Return a robot of parts that differ in all their numbers."""
    made = [
        PART.format(
            i=i,
            type="fixed",
            parent=f"p{i - 1}" if i else "base",
            mass=1.2 + i / 8,
            size=i + 1,
        )
        for i in range(parts)
    ]
    return f"robot: r\nbase: fixed\nmodel:\n  - link/name=base:\n{''.join(made)}"


def main() -> None:
    """Count and print."""
    with tempfile.TemporaryDirectory() as folder:
        counts = []
        for parts in (1, 2, 3):
            file = Path(folder, f"{parts}.yaml")
            file.write_text(robot(parts), encoding="utf-8")
            arguments = (str(file), "--to", "mjcf", "--quiet", "-o", str(Path(folder, "out.xml")))
            counts.append(Calls().of(*arguments))
    print(f"functions of the command: {len(counts[0])}, called {counts[0].total()} times")
    of_part = counts[2] - counts[1]
    print(f"functions of one more part: {len(of_part)}, called {of_part.total()} times")
    rooms: Counter[str] = Counter()
    for (file, _, _), count in of_part.items():
        rooms[file.partition("/")[0]] += count
    print(", ".join(f"{room} {count}" for room, count in rooms.most_common()))
    read = sum(
        n for (file, name, _), n in of_part.items() if name == "read_numbers" and "model" in file
    )
    print(f"texts read as numbers once more: {read}")


if __name__ == "__main__":
    main()
