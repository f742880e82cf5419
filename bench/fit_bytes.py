"""Compares the bytes of shapes between Pythons, and between a cold and a warm cache.

    python bench/fit_bytes.py MESH.stl [PYTHON ...]

Each PYTHON is an interpreter that has Yamaro with the extra `fit`, such as one of another version
and with other versions of numpy and scipy. Prints a line for each of them and each word, and ends
with status 1 if any differ.
"""

from __future__ import annotations

import hashlib
import subprocess
import sys
import tempfile
from pathlib import Path

WORDS = (
    "--shape=best", "--shape=box", "--shape=capsule", "--shape=hull", "--decompose=8",
    "--spheres=8", "--spheres=8 --cover", "--triangles=500",
)  # fmt: skip
ROBOT = """<robot name="one"><link name="base">
  <visual><geometry><mesh filename="{mesh}"/></geometry></visual>
  <collision><geometry><mesh filename="{mesh}"/></geometry></collision>
</link></robot>
"""


def digest(python: str, robot: Path, words: str, cache: Path) -> str:
    """Return a hash of all files that `yamaro fit` writes."""
    with tempfile.TemporaryDirectory() as name:
        target = Path(name) / "robot.urdf"
        subprocess.run(
            [python, "-m", "yamaro", "fit", "-q", str(robot), "-o", str(target), *words.split()],
            check=True,
            stderr=subprocess.DEVNULL,
            env={"YAMARO_CACHE": str(cache), "PATH": ""},
        )
        found = hashlib.sha256()
        for path in sorted(Path(name).rglob("*")):
            if path.is_file():
                found.update(str(path.relative_to(name)).encode() + path.read_bytes())
        return found.hexdigest()[:12]


def main() -> None:
    """Print the hashes, and say which differ."""
    mesh, *pythons = sys.argv[1:]
    differ = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        robot = folder / "robot.urdf"
        robot.write_text(ROBOT.format(mesh=Path(mesh).resolve().as_posix()))
        for words in WORDS:
            hashes = {}
            for number, python in enumerate(pythons or [sys.executable]):
                cache = folder / f"cache-{number}"
                for state in ("cold", "warm"):
                    hashes[python, state] = digest(python, robot, words, cache)
            is_same = len(set(hashes.values())) == 1
            differ += not is_same
            for (python, state), found in hashes.items():
                print(f"{words:20} {found} {state} {python}{'' if is_same else '  DIFFERS'}")
    sys.exit(1 if differ else 0)


if __name__ == "__main__":
    main()
