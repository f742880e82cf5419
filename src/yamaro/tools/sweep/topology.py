"""Which variants have the same topology, for simulators that load many of one kind at once.

`MultiUsdFileCfg` of Isaac Lab spawns USD files that have to have the same bodies and joints, in the
same order; the sizes, poses, masses, limits and motors may differ.
"""

from __future__ import annotations

import json
import os
from hashlib import sha256

from ...model.kinematics import base_of
from ...output import write_file
from .plan import USD
from .rows import OK
from .table import TOPOLOGY, parts_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ...model.robot import Robot
    from .plan import Plan

INDEX = "index.json"
_DIGITS = 16
_NAMES = ("id", "status", TOPOLOGY)


def topology_of(robot: Robot, base: str | None) -> str:
    """Return a text that is the same for robots with the same bodies and joints in one order.

    Args:
        robot: the robot.
        base: whether the root is asked to be fixed or free.
    """
    links = [[name, link.mass > 0] for name, link in robot.links.items()]
    joints = [
        [joint.name, joint.type, joint.parent, joint.child, bool(joint.mimic)]
        for joint in robot.joints.values()
    ]
    loops = [[name, loop.type, *loop.between] for name, loop in robot.loops.items()]
    parts = [base_of(robot, base)[0], links, joints, loops]
    return sha256(json.dumps(parts, ensure_ascii=False).encode()).hexdigest()[:_DIGITS]


def write_index(plan: Plan, folder: str) -> None:
    """Write which of the USD files that are kept have the same topology.

    Raises:
        OSError: it cannot be written.
    """
    from .builder import MODELS, ends_of, model_name

    groups: dict[str, list[int]] = {}
    for part in parts_of(folder, _NAMES):
        for index, status, topology in zip(*(part[name] for name in _NAMES), strict=True):
            if status == OK:
                groups.setdefault(topology, []).append(index)
    end = ends_of(plan.formats)[plan.formats.index(USD)]
    found: list[dict[str, Any]] = [
        {
            "topology": topology,
            "variants": indices,
            "files": [f"{model_name(index)}.{end}" for index in indices],
        }
        for topology, indices in sorted(groups.items(), key=lambda pair: (-len(pair[1]), pair[1]))
    ]
    text = json.dumps({"format": USD, "topologies": found}, indent=1) + "\n"
    write_file(os.path.join(folder, MODELS, INDEX), [text.encode()])
