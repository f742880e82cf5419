"""Whether a robot holds its home position in MuJoCo."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..simulation import compiled, import_mujoco

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ....result import Build

    Floats = NDArray[np.floating[Any]]

STEPS = 5
"""Steps of the simulation between two looks."""
FREE, HINGE = 0, 3
"""Types of joints, as `mjtJoint` numbers them."""
SPHERE, CAPSULE, ELLIPSOID, CYLINDER, MESH = 2, 3, 4, 5, 7
"""Types of geoms, as `mjtGeom` numbers them."""
JOINT = 0
"""What an actuator acts on, as `mjtTrn` numbers it."""
TILT = np.radians(45)
"""How far a free base may tilt."""
LEAST_HEIGHT = 0.5
"""The part of its height above the floor that the centre of mass must keep."""
MOST_SAG = 0.1
"""The part of its range that a joint with a position actuator may leave its place by."""


class Hold:
    """How a robot held its home position.

    Attributes:
        is_stable: whether it was stable to the end.
        time: how long it was stable, in s.
        tilt: how far its base tilted until then, in rad; 0 if it is fixed.
        sag: how far a joint with a position actuator left its place, as part of its range.
    """

    __slots__ = ("is_stable", "sag", "tilt", "time")

    def __init__(self) -> None:
        self.is_stable = False
        self.time = 0.0
        self.tilt = 0.0
        self.sag = 0.0


def hold(build: Build, seconds: float) -> Hold:
    """Simulate a robot with its actuators at home, on a floor if its base is free.

    Args:
        build: its MJCF.
        seconds: for how long.

    Raises:
        YamaroError: MuJoCo is not installed, or refuses the robot.
    """
    mujoco = import_mujoco()
    has_floor = "<freejoint" in build.xml()
    model = compiled(build, has_floor=has_floor, has_sensors=False)
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, model.key("home").id)
    mujoco.mj_forward(model, data)
    if has_floor:
        floor = model.geom("floor").id
        lowest = [
            lowest_point(model, data, geom)
            for geom in range(model.ngeom)
            if geom != floor and (model.geom_contype[geom] or model.geom_conaffinity[geom])
        ]
        model.geom_pos[floor, 2] = min(lowest, default=0.0)
    watch = _Watch(model, data, floor if has_floor else None)
    steps = max(round(seconds / model.opt.timestep), 1)
    done, result = 0, Hold()
    while done < steps:
        count = min(STEPS, steps - done)
        mujoco.mj_step(model, data, count)
        done += count
        if not watch.is_well(data, result):
            return result
        result.time = done * model.opt.timestep
    result.is_stable = True
    return result


class _Watch:
    """What is compared with the start, from time to time."""

    def __init__(self, model: Any, data: Any, floor: int | None) -> None:
        """Note how a simulation starts.

        Args:
            model: the model.
            data: its state at the start, after `mj_forward`.
            floor: the geom that the robot stands on; None for a robot that is fixed.
        """
        self._floor = 0.0 if floor is None else float(model.geom_pos[floor, 2])
        self._base: int | None = None
        if floor is not None:
            self._base = int(model.jnt_bodyid[(model.jnt_type == FREE).argmax()])
            self._height = data.subtree_com[self._base, 2] - self._floor
            self._up: Floats = data.xmat[self._base].reshape(3, 3)[2].copy()
        driven = _driven_joints(model)
        self._places: Floats = model.jnt_qposadr[driven]
        self._home: Floats = data.qpos[self._places].copy()
        limited = model.jnt_limited[driven].astype(bool)
        whole = np.where(model.jnt_type[driven] == HINGE, 2 * np.pi, 1.0)
        self._ranges = np.where(limited, np.ptp(model.jnt_range[driven], axis=1), whole)

    def is_well(self, data: Any, result: Hold) -> bool:
        """Return whether the robot is as it was; note what there is to note."""
        if data.warning.number.any() or not np.isfinite(data.qpos).all():
            return False
        if len(self._places):
            ways = abs(data.qpos[self._places] - self._home) / self._ranges
            result.sag = max(result.sag, float(ways.max()))
        if self._base is not None:
            upright = data.xmat[self._base].reshape(3, 3)[2] @ self._up
            result.tilt = max(result.tilt, float(np.arccos(np.clip(upright, -1, 1))))
            height = data.subtree_com[self._base, 2] - self._floor
            if result.tilt > TILT or height < LEAST_HEIGHT * self._height:
                return False
        return result.sag <= MOST_SAG


def _driven_joints(model: Any) -> Any:
    """Return the joints that a position actuator holds: its force falls with the position."""
    is_servo = (model.actuator_trntype == JOINT) & (model.actuator_biasprm[:, 1] < 0)
    return np.unique(model.actuator_trnid[is_servo, 0])


def lowest_point(model: Any, data: Any, geom: int) -> float:
    """Return the height of the lowest point of a geom, in metres.

    It is that of the support function of its shape: see `extent`; of an ellipsoid with the half
    axes sᵢ and the vertical r in its frame √Σ(rᵢ·sᵢ)².
    """
    up: Floats = data.geom_xmat[geom].reshape(3, 3)[2]
    height = float(data.geom_xpos[geom, 2])
    size: Floats = model.geom_size[geom]
    kind = int(model.geom_type[geom])
    if kind == SPHERE:
        return height - float(size[0])
    if kind == CAPSULE:
        return height - float(size[0] + abs(up[2]) * size[1])
    if kind == CYLINDER:
        return height - float(size[0] * np.hypot(up[0], up[1]) + abs(up[2]) * size[1])
    if kind == ELLIPSOID:
        return height - float(np.linalg.norm(up * size))
    if kind == MESH:
        mesh = model.geom_dataid[geom]
        start = model.mesh_vertadr[mesh]
        corners = model.mesh_vert[start : start + model.mesh_vertnum[mesh]]
        return height + float((corners @ up).min())
    return height - float(abs(up) @ size)
