"""Packs what the playground needs of Python: yamaro.zip and examples.json.

    python web/playground/pack.py FOLDER

The first example comes with the robot already built, so that it is seen while Python starts.
"""

from __future__ import annotations

import io
import json
import os
import re
import sys
import tempfile
import zipfile
from collections.abc import Iterator
from contextlib import redirect_stderr
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
EXAMPLES = (
    ("hexapod", "A walking robot, 18 joints", "hexapod.yaml"),
    ("pan_tilt", "Start here: a camera on two servos", "pan_tilt.yaml"),
    ("quadruped", "A robot dog, 12 joints", "quadruped.yaml"),
    ("arm", "A six-axis arm with a gripper", "arm.yaml"),
    ("ur5e", "A real arm, the UR5e", "ur5e.yaml"),
    ("diff_drive", "Two wheels, lidar and camera", "diff_drive.yaml"),
    ("drone", "A quadcopter with its sensors", "drone.yaml"),
    ("dual_arm_cell", "Two arms on a table", "dual_arm_cell.yaml"),
    ("mobile_manipulator", "An arm on four wheels", "mobile_manipulator.yaml"),
    ("hand", "A hand with three fingers", "hand.yaml"),
    ("humanoid", "A humanoid, 23 joints", "humanoid.yaml"),
    ("leg_robot", "A tour of the language", "robot.yaml"),
    ("world", "A world for Gazebo: other XML", "world.yaml"),
)
LEFT_OUT = (
    "commands/",
    "layout.py",
    "picture/",
    "targets/controllers/",
    "targets/interface/",
    "targets/isaaclab/",
    "targets/mjlab/",
    "targets/moveit/",
    "targets/srdf/",
    "targets/training.py",
    "targets/usd/",
    "tools/diff/",
    "tools/fmt/",
    "tools/guide/",
    "tools/lsp/",
    "tools/mcp/",
    "tools/migrate/",
    "tools/new/",
    "tools/picture/",
    "tools/sweep/",
    "tools/test/",
    "tools/tree/",
    "tools/view/notebook.py",
    "tools/view/static/",
    "tools/watch/",
    "tools/why/",
)
"""What a browser has no use for."""
NEIGHBOUR = re.compile(r"\.\./(\w+)/\w+\.yaml")
"""A file of another example."""
_DATE = (1980, 1, 1, 0, 0, 0)


def main(target: Path) -> None:
    """Write both files into a folder."""
    target.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(target / "yamaro.zip", "w", zipfile.ZIP_DEFLATED, compresslevel=9) as file:
        for name, path in modules():
            file.writestr(zipfile.ZipInfo(name, _DATE), path.read_bytes(), zipfile.ZIP_DEFLATED)
    found = [read_example(*one) for one in EXAMPLES]
    found[0]["state"] = first_state(found[0])
    text = json.dumps(found, ensure_ascii=False)
    (target / "examples.json").write_text(text, encoding="utf-8")


def modules() -> Iterator[tuple[str, Path]]:
    """Yield the names in the archive, with their files."""
    package = ROOT / "src" / "yamaro"
    for path in sorted(package.rglob("*.py")):
        name = path.relative_to(package).as_posix()
        if not name.startswith(LEFT_OUT):
            yield f"yamaro/{name}", path
    for path in sorted(Path(yaml.__file__).parent.glob("*.py")):
        yield f"yaml/{path.name}", path
    yield "bridge.py", HERE / "bridge.py"


def read_example(name: str, title: str, main: str) -> dict[str, object]:
    """Return an example or a robot as the page opens it: its files, the main one first.

    If the main file includes files of other examples, the names of all begin with their folders.
    """
    folder = folder_of(name)
    texts = {path.name: path.read_text(encoding="utf-8") for path in _files_of(folder)}
    files = {main: texts.pop(main), **texts}
    others = sorted(set(NEIGHBOUR.findall(files[main])))
    if others:
        files = {f"{name}/{one}": text for one, text in files.items()}
        main = f"{name}/{main}"
    for other in others:
        for path in _files_of(folder.parent / other):
            files[f"{other}/{path.name}"] = path.read_text(encoding="utf-8")
    return {"name": name, "title": title, "main": main, "files": files}


def folder_of(name: str) -> Path:
    """Return the folder of an example, or else of a known robot."""
    folder = ROOT / "examples" / name
    return folder if folder.exists() else ROOT / "robots" / name / "urdf"


def _files_of(folder: Path) -> list[Path]:
    names = (path.name for path in folder.iterdir())
    wanted = (one for one in names if one.endswith((".yaml", ".py")) and ".test." not in one)
    return [folder / one for one in sorted(wanted)]


def first_state(example: dict[str, object]) -> object:
    """Return what the viewer shows of an example."""
    sys.path.insert(0, str(HERE))
    from bridge import Playground

    before = os.getcwd()
    with tempfile.TemporaryDirectory() as folder, redirect_stderr(io.StringIO()):
        playground = Playground(os.path.join(folder, "robot"))
        files: dict[str, str] = example["files"]  # type: ignore[assignment]
        playground.open(files, str(example["main"]), is_trusted=True)
        state = json.loads(playground.build())["state"]
        os.chdir(before)
    # The first build of the page itself has the same number, so it is told as another version.
    return {**state, "version": 0, "robotVersion": -1}


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python web/playground/pack.py FOLDER")
    main(Path(sys.argv[1]))
