"""pinocchio, MuJoCo and Drake, asked for the order of what they find in a document.

Each function returns that in the words of the interface of a robot, without the names in the robot.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

Order = dict[str, Any]


def said(listing: Order) -> Order:
    """Return what a listing of the interface says that a program can be asked for."""
    return {
        "positions": listing["positions"],
        "velocities": listing["velocities"],
        "joints": [(each["name"], *each["q"], *each["v"]) for each in listing["joints"]],
        "bodies": [each["name"] for each in listing["bodies"]],
        "actuators": [each["name"] for each in listing["actuators"]],
        "sensors": [(each["name"], each["values"]) for each in listing["sensors"]],
    }


def difference(listing: Order, found: Order) -> str:
    """Return the first difference of a listing from what a program finds, or "".

    What is not in `found` cannot be asked for.
    """
    mine = said(listing)
    for kind, theirs in found.items():
        if mine[kind] == theirs:
            continue
        if isinstance(theirs, int):
            return f"{mine[kind]} {kind}, not {theirs}"
        for index, (one, other) in enumerate(zip(mine[kind], theirs, strict=False)):
            if one != other:
                return f"{kind}: {index} is {one}, not {other}"
        return f"{len(mine[kind])} {kind}, not {len(theirs)}"
    return ""


def of_pinocchio(urdf: str, *, is_fixed: bool) -> Order:
    """Return what pinocchio finds in a URDF."""
    import pinocchio

    root = () if is_fixed else (pinocchio.JointModelFreeFlyer(),)
    model = pinocchio.buildModelFromXML(urdf, *root)
    joints = list(zip(model.names, model.joints, strict=True))[1:]  # the first one is the universe
    frames = [each for each in model.frames if each.type == pinocchio.FrameType.BODY]
    return {
        "positions": model.nq,
        "velocities": model.nv,
        "joints": [(name, own.idx_q, own.nq, own.idx_v, own.nv) for name, own in joints],
        "bodies": [each.name for each in frames],
        "actuators": [],
        "sensors": [],
    }


def of_mujoco(path: Path) -> Order:
    """Return what MuJoCo finds in an MJCF."""
    import mujoco

    model: Any = mujoco.MjModel.from_xml_path(str(path))

    def ends(starts: Any, count: int) -> list[tuple[int, int]]:
        return [
            (int(start), int(end) - int(start))
            for start, end in zip(starts, [*starts, count][1:], strict=True)
        ]

    qs, vs = ends(model.jnt_qposadr, model.nq), ends(model.jnt_dofadr, model.nv)
    values = map(int, model.sensor_dim)
    return {
        "positions": model.nq,
        "velocities": model.nv,
        "joints": [(model.joint(i).name, *qs[i], *vs[i]) for i in range(model.njnt)],
        "bodies": [model.body(i).name for i in range(model.nbody)],
        "actuators": [model.actuator(i).name for i in range(model.nu)],
        "sensors": [(model.sensor(i).name, count) for i, count in enumerate(values)],
    }


def of_drake(path: Path) -> Order:
    """Return what Drake finds in an SDF."""
    from pydrake.common import configure_logging
    from pydrake.multibody import parsing
    from pydrake.multibody.plant import MultibodyPlant

    configure_logging()
    plant: Any = MultibodyPlant(1e-3)
    parser: Any = parsing.Parser(plant)
    (instance,) = parser.AddModels(str(path))
    plant.Finalize()
    joints = []
    for index in plant.GetJointIndices():
        own = plant.get_joint(index)
        q, v = (
            (own.position_start(), own.num_positions()),
            (own.velocity_start(), own.num_velocities()),
        )
        joints.append((own.name(), *q, *v))
    driven = [plant.get_joint_actuator(each) for each in plant.GetJointActuatorIndices()]
    return {
        "positions": plant.num_positions(),
        "velocities": plant.num_velocities(),
        "joints": joints,
        "bodies": [plant.get_body(each).name() for each in plant.GetBodyIndices(instance)],
        "actuators": [each.name() for each in driven],
        "sensors": [],
    }
