"""Tells what Isaac Lab makes of configurations: run it with a Python that can import isaaclab 3.0.

It reads a path and the names of all joints on standard input, as a line of JSON each, and answers
each with a line of JSON. Nothing is simulated, so neither Isaac Sim nor a GPU has to be there.
"""

from __future__ import annotations

import json
import runpy
import sys
import warnings
from importlib import import_module
from typing import Any

VALUES = (
    *("stiffness", "damping", "armature", "friction", "dynamic_friction", "viscous_friction"),
    *("joint_effort_limit", "joint_velocity_limit", "actuator_effort_limit"),
    *("actuator_velocity_limit", "saturation_effort", "min_delay", "max_delay"),
)


def articulation(path: str, names: list[str]) -> dict[str, object]:
    """Return what the robot of a configuration is in Isaac Lab."""
    strings = import_module("isaaclab.utils.string")
    made = runpy.run_path(path)
    config = made["robot_cfg"]()
    config.prim_path = "/World/Robot"
    config.validate()
    joints: dict[str, dict[str, Any]] = {}
    for group in config.actuators.values():
        for name in strings.resolve_matching_names(group.joint_names_expr, names)[1]:
            if name in joints:
                raise ValueError(f"two actuators for {name}")
            joints[name] = {"class": type(group).__name__}
            joints[name] |= {each: getattr(group, each, None) for each in VALUES}
    start = config.init_state
    homes = strings.resolve_matching_names_values(start.joint_pos, names)
    scales = made["ACTION_SCALE"]
    scale = strings.resolve_matching_names_values(scales, [*joints]) if scales else ([], [], [])
    return {
        "joints": joints,
        "home": dict(zip(*homes[1:], strict=True)),
        "scale": dict(zip(*scale[1:], strict=True)),
        "pos": list(start.pos),
        "rot": list(start.rot),
        "usd": config.spawn.usd_path,
    }


def main() -> None:
    warnings.simplefilter("error", DeprecationWarning)
    answers, sys.stdout = sys.stdout, sys.stderr
    for line in sys.stdin:
        try:
            answer: object = articulation(*json.loads(line))
        except Exception as error:
            answer = {"error": f"{type(error).__name__}: {str(error).splitlines()[0][:200]}"}
        print(json.dumps(answer), file=answers, flush=True)


if __name__ == "__main__":
    main()
