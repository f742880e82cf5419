"""What the tests of editors share: the files that are edited, and how an editor is run."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from tests.waiting import PATIENCE

HERE = Path(__file__).parent
ROBOT = """robot: rover
variables:
  length: 0.5
  half: $(length / 2)
functions:
  Arm(side, size=1):
  - print: $(side) $(size)
model:
- part:
    name: base
- part:
    name: arm
    joint: {type: fixed, parent: bse, xyz: 0 0 0}
    link: {geometry: box, size: 1 1 1, mass: 6, xyz: "$('🤖'[:0])0 0 $(length)", rpy: 0 0 $(half)}
- part:
    name: tip
    joint: {type: fixed, parent: base} # here
- include: leg.yaml
- include: gripper.urdf.xacro
- process: made = 3
"""
XACRO = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="gripper">
  <xacro:property name="width" value="0.1"/>
  <xacro:macro name="finger" params="side">
    <link name="${side}_finger"/>
    <joint name="${side}_slide" type="fixed">
      <parent link="base_link"/>
      <child link="${side}_finger"/>
      <origin xyz="0 ${width} 0"/>
    </joint>
  </xacro:macro>
  <xacro:finger side="left"/>
</robot>
"""


FOUND = {
    "arm.urdf.yaml": ("", True),
    "robot.yaml": ("# A robot.\n\nrobot: r\n", True),
    "model.yml": ("model:\n- link/name=a:\n", True),
    "leg.yaml": ("variables: {a: 1}\nfunctions:\n  # One.\n  Leg(side)/parent:\n  - part:\n", True),
    "list.yaml": ("functions:\n- Leg:\n  - print: a\n", True),
    "deploy.yaml": ("service: s\nfunctions:\n  hello:\n    handler: h.Hello\n", False),
    "arm.test.yaml": ("robot: arm.yaml\ncases: []\n", False),
    "other.yaml": ("a: 1\n", False),
}
"""Files with their texts, and whether an editor takes them for Yamaro's."""
YAMAROS = {name for name, (_, is_yamaros) in FOUND.items() if is_yamaros}


def write_found(folder: Path) -> None:
    """Write the files of `FOUND` into a folder."""
    for name, (text, _) in FOUND.items():
        (folder / name).write_text(text)


def found_by(done: subprocess.CompletedProcess[str], word: str) -> set[str]:
    """Return the files of which an editor printed the name and a word, its mode for Yamaro."""
    pairs = [line.split() for line in done.stdout.splitlines() if line.strip()]
    assert {pair[0] for pair in pairs} >= FOUND.keys(), done.stderr  # it has opened all of them
    return {pair[0] for pair in pairs if pair[1:] == [word]}


def write_robot(folder: Path) -> Path:
    """Write the files into a folder; return the main file."""
    (folder / "leg.yaml").write_text("model:\n")
    (folder / "gripper.urdf.xacro").write_text(XACRO)
    path = folder / "rover.urdf.yaml"
    path.write_text(ROBOT)
    return path


def drive(command: Sequence[str], folder: Path, variables: Mapping[str, str]) -> dict[str, Any]:
    """Run an editor whose script writes what its buffers hold; return that.

    Args:
        command: the editor, with its script.
        folder: where it runs, and where it keeps what is its own.
        variables: of the environment, besides those that each script reads.
    """
    result = folder / "result.json"
    done = subprocess.run(
        command,
        cwd=folder,
        env={
            **os.environ,
            "YAMARO_COMMAND": json.dumps([sys.executable, "-m", "yamaro", "lsp"]),
            "YAMARO_RESULT": str(result),
            **variables,
        },
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    assert result.exists(), done.stdout + done.stderr
    told: dict[str, Any] = json.loads(result.read_text(encoding="utf-8"))
    assert "fault" not in told, (told, done.stderr)
    assert [key for key, value in told.items() if key.startswith("reached") and not value] == []
    return told
