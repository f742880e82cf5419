"""Compares the interface of a corpus of public robots with what programs find in the documents.

    NEWTON=ENVIRONMENT/bin/python python bench/interface.py [CORPUS] [--only REGEX]

pinocchio reads the URDF, MuJoCo the MJCF, Drake the SDF; Newton the USD, if there is a Python that
has it. The order of Isaac Sim is made of what Newton finds as Isaac Lab 3.0 does it: breadth-first,
the joints of a body in the order in which they are in the file. MuJoCo compiles a site for each ray
of a lidar, which takes minutes for ten thousand: robots with more than `MOST_RAYS` are not given to
it, and the verdict says so.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from bench.verdicts import built, run  # noqa: E402 - after the path

from tests.consumers import interface_judges as judges  # noqa: E402
from yamaro.model.extras import Lidar  # noqa: E402

MOST_RAYS = 5000
DOCUMENTS = {"urdf": "urdf", "mjcf": "xml", "sdf": "sdf", "usd": "usda"}


class Newton:
    """A process that tells what Newton finds."""

    def __init__(self, python: str) -> None:
        script = str(ROOT / "bench" / "newton_orders.py")
        self._process = subprocess.Popen(
            [python, script],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )

    def order(self, path: Path) -> judges.Order:
        """Return what it finds in a file; raise ValueError if it refuses that."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(f"{path}\n")
        self._process.stdin.flush()
        answer: judges.Order = json.loads(self._process.stdout.readline())
        if "error" in answer:
            raise ValueError(answer["error"])
        answer["joints"] = list(map(tuple, answer["joints"]))
        return answer


NEWTON = Newton(os.environ["NEWTON"]) if "NEWTON" in os.environ else None


def of_isaac(path: Path, found: judges.Order) -> judges.Order:
    """Return the order of Isaac Sim, made of what Newton finds."""
    from pxr import Usd, UsdPhysics

    stage = Usd.Stage.Open(str(path))
    joints = [str(each.GetPath()) for each in stage.Traverse() if each.IsA(UsdPhysics.Joint)]
    place = {label: index for index, label in enumerate(joints)}
    labels = [each[0] for each in found["joints"]]
    freedoms = {each[0]: each[4] for each in found["joints"]}
    below: dict[int, list[int]] = {}
    for joint in sorted(range(1, len(labels)), key=lambda each: place.get(labels[each], -1)):
        if (
            labels[joint] in place
            and not UsdPhysics.Joint(stage.GetPrimAtPath(labels[joint]))
            .GetExcludeFromArticulationAttr()
            .Get()
        ):
            below.setdefault(found["parents"][joint], []).append(joint)
    order = [0]
    for joint in order:
        order += below.get(found["children"][joint], [])
    names = []
    for joint in order[1:]:
        name, count = labels[joint].rpartition("/")[2], freedoms[labels[joint]]
        names += [name] if count == 1 else [f"{name}:{each}" for each in range(count)]
    bodies = [found["bodies"][found["children"][joint]].rpartition("/")[2] for joint in order]
    return {
        "positions": len(names),
        "velocities": len(names),
        "joints": [(name, index, 1, index, 1) for index, name in enumerate(names)],
        "bodies": bodies,
    }


def judged(path: Path, folder: Path, positions: int) -> str:
    """Return what is wrong with the interface of a robot, or ""."""
    whole = built(path, target="interface")
    interface = json.loads(whole.xml())
    lidars = [each.details for each in whole.robot.sensors.values()]
    rays = sum(each.rays * each.rows for each in lidars if isinstance(each, Lidar))
    found: dict[str, Any] = {}
    verdicts = []
    for name, listing in interface["consumers"].items():
        if "refused" in listing:
            verdicts.append(f"{name} is not there: {listing['refused'][:60]}")
            continue
        if name == "mujoco" and rays > MOST_RAYS:
            verdicts.append(f"mujoco is not asked: {rays} rays")
            continue
        document = folder / f"robot{len(list(folder.iterdir()))}.{DOCUMENTS[listing['format']]}"
        try:
            build = built(path, target=listing["format"])
            document.write_text(build.xml(), encoding="utf-8")
            if name == "pinocchio":
                order = judges.of_pinocchio(build.xml(), is_fixed=interface["base"] == "fixed")
            elif name == "mujoco":
                order = judges.of_mujoco(document)
            elif name == "drake":
                order = judges.of_drake(document)
            elif NEWTON is None:
                continue
            elif name == "newton":
                order = found["newton"] = NEWTON.order(document)
                order = {k: v for k, v in order.items() if k not in ("parents", "children")}
            elif "newton" not in found:
                continue
            else:
                order = of_isaac(document, found["newton"])
        except (ValueError, RuntimeError, IndexError) as error:
            verdicts.append(f"{name} refuses it: {str(error).splitlines()[0][:90]}")
            continue
        difference = judges.difference(listing, order)
        if difference:
            verdicts.append(f"{name} DIFFERS: {difference}")
    return "; ".join(verdicts)


if __name__ == "__main__":
    run(__doc__, judged)
