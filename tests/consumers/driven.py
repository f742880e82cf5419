"""A robot with one joint that is driven, for programs that have to drive it alike."""

from __future__ import annotations

from pathlib import Path

ONE_JOINT = """
robot: kinds
base: fixed
model:
- part: {{name: base, link: {{geometry: box, size: 1 1 1, mass: 1}}}}
- part:
    name: arm
    joint:
      type: revolute
      parent: base
      axis: z
      limit: {{lower: -1, upper: 1, effort: 5, velocity: 2}}
      actuator: {actuator}
    link: {{geometry: box, size: 0.1 0.2 0.3, mass: 1}}
"""


def saved(folder: Path, text: str) -> Path:
    path = folder / ("robot.urdf" if text.startswith("<") else "robot.yaml")
    path.write_text(text, encoding="utf-8")
    return path
