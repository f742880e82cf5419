#!/usr/bin/env python3
"""Writes src/yamaro/sources/mjcf/names.py: the names in MJCF, as MuJoCo prints them.

python scripts/mjcf_names.py           # needs the newest mujoco
python scripts/mjcf_names.py --check   # fails if the file differs
"""

import re
import subprocess
import sys
import textwrap
from pathlib import Path

FILE = Path(__file__).parent.parent / "src/yamaro/sources/mjcf/names.py"
POSE = "axisangle euler pos quat xyaxes zaxis"
META = {
    "body/frame": f"childclass name {POSE}",
    "body/replicate": "childclass count euler name offset prefix sep",
}
"""What the compiler takes out of a document before it is one, and so does not print."""
HEAD = '''"""The elements and attributes of MJCF; scripts/mjcf_names.py writes them from MuJoCo."""

VERSION = "{}"
"""The version of MuJoCo that printed them."""

ATTRIBUTES = {{
{}}}
"""The attributes of each element, by the element around it and its own name; `body` is also the
world, and what is around the sections is `mujoco`."""
'''


def main() -> int:
    import mujoco

    found: dict[str, set[str]] = {
        "/mujoco": {"model"},
        **{k: set(v.split()) for k, v in META.items()},
    }
    above: list[str] = ["mujoco"]
    key = "/mujoco"
    for line in mujoco.mj_printSchema(False, False).splitlines()[1:]:
        if begun := re.match(r"( +)(\S+) \((.)\)(.*)", line):
            depth, name, rest = len(begun[1]) // 3, begun[2].replace("(world)", ""), begun[4]
            above[depth:] = [name]
            key = f"{above[depth - 1]}/{name}"
        else:
            rest = line
        found.setdefault(key, set()).update(rest.split())
    rows = []
    for key, names in found.items():
        words = textwrap.wrap(" ".join(sorted(names)), 84)
        if len(words) < 2 and len(f'    "{key}": "{"".join(words)}",') <= 100:
            rows.append(f'    "{key}": "{"".join(words)}",\n')
        else:
            inner = "".join(f'        "{w}{" " if w is not words[-1] else ""}"\n' for w in words)
            rows.append(f'    "{key}": (\n{inner}    ),\n')
    text = HEAD.format(mujoco.__version__, "".join(rows))
    command = ["ruff", "format", "--stdin-filename", str(FILE)]
    text = subprocess.run(command, input=text, capture_output=True, text=True, check=True).stdout
    if "--check" in sys.argv[1:]:
        return int(FILE.read_text(encoding="utf-8") != text)
    FILE.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
