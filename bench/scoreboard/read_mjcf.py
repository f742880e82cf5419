"""MJCF as MuJoCo compiles it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from .facts import Array, Body, Facts, Joint, ball, box, cylinder, moved, plain, pose


def read(path: Path) -> Facts:
    """Return what is in an MJCF."""
    import mujoco

    return _Reading(mujoco, mujoco.MjModel.from_xml_path(str(path))).facts


class _Reading:
    """The facts of one compiled model."""

    def __init__(self, mujoco: Any, model: Any) -> None:
        self.mujoco, self.model, self.data = mujoco, model, mujoco.MjData(model)
        self.facts = Facts("mjcf")
        self.moves: list[str] = []
        self.heads: dict[str, int] = {}
        self.free = [
            n for n in range(model.njnt) if model.jnt_type[n] == mujoco.mjtJoint.mjJNT_FREE
        ]
        self._tree()
        mujoco.mj_kinematics(model, self.data)
        mujoco.mj_comPos(model, self.data)
        self._masses()
        self._joints()
        self._control()
        self.facts.place = self.place

    def place(self, positions: Mapping[str, float]) -> dict[str, Array]:
        model, data = self.model, self.data
        data.qpos[:] = model.qpos0
        for number in range(model.njnt):
            name = plain(model.joint(number).name)
            if name in positions and self._is_single(number):
                data.qpos[model.jnt_qposadr[number]] = positions[name]
        self.mujoco.mj_kinematics(model, data)
        return {name: self._body(number) for name, number in self.heads.items()}

    def _is_single(self, joint: int) -> bool:
        kinds = self.mujoco.mjtJoint
        return int(self.model.jnt_type[joint]) in (int(kinds.mjJNT_HINGE), int(kinds.mjJNT_SLIDE))

    def _body(self, number: int) -> Array:
        return pose(self.data.xmat[number], self.data.xpos[number])

    def _tree(self) -> None:
        """Find which joint moves each body, and which body leads those that it moves."""
        model = self.model
        for number in range(model.nbody):
            first, count = model.body_jntadr[number], model.body_jntnum[number]
            name = self.moves[model.body_parentid[number]] if number else ""
            if count and first not in self.free:
                name = plain(model.joint(first + count - 1).name)
                self.heads[name] = number
            elif count:
                self.heads.setdefault("", number)
            self.moves.append(name)
        self.heads.setdefault("", 0)
        self.facts.bodies = {name: Body() for name in self.heads}

    def _masses(self) -> None:
        """Read bodies, frames and collision shapes, at the first position."""
        mujoco, model, data, facts = self.mujoco, self.model, self.data, self.facts
        into = {name: np.linalg.inv(self._body(at)) for name, at in self.heads.items()}
        for number in range(1, model.nbody):
            name = self.moves[number]
            at = into[name] @ pose(data.ximat[number], data.xipos[number])
            inertia = at[:3, :3] @ np.diag(model.body_inertia[number]) @ at[:3, :3].T
            facts.bodies[name].add(float(model.body_mass[number]), at[:3, 3], inertia)
            link = plain(model.body(number).name)
            facts.frames[link] = name, into[name] @ self._body(number)
            facts.root = facts.root or link
        for number in range(model.nsite):
            name = self.moves[model.site_bodyid[number]]
            at = into[name] @ pose(data.site_xmat[number], data.site_xpos[number])
            facts.frames.setdefault(plain(model.site(number).name), (name, at))
            if not model.site_bodyid[number]:
                facts.scene.add(plain(model.site(number).name))
        for number in range(model.ngeom):
            body = model.geom_bodyid[number]
            if not (model.geom_contype[number] or model.geom_conaffinity[number]):
                continue
            if model.geom_type[number] == mujoco.mjtGeom.mjGEOM_PLANE or (self.free and not body):
                continue
            name = self.moves[body]
            at = into[name] @ pose(data.geom_xmat[number], data.geom_xpos[number])
            facts.bodies[name].touch(moved(self._points(number), at))

    def _points(self, geom: int) -> Array:
        kinds, model = self.mujoco.mjtGeom, self.model
        size = model.geom_size[geom]
        kind = model.geom_type[geom]
        if kind == kinds.mjGEOM_BOX:
            return box(*size)
        if kind == kinds.mjGEOM_CYLINDER:
            return cylinder(size[0], size[1])
        if kind == kinds.mjGEOM_CAPSULE:
            return ball(size[0], half=size[1])
        if kind == kinds.mjGEOM_MESH:
            mesh = model.geom_dataid[geom]
            first = model.mesh_vertadr[mesh]
            return np.array(model.mesh_vert[first : first + model.mesh_vertnum[mesh]], dtype=float)
        return ball(size[0]) if kind == kinds.mjGEOM_SPHERE else ball(*size)

    def _joints(self) -> None:
        mujoco, model = self.mujoco, self.model
        for number in range(model.njnt):
            if not self._is_single(number):
                continue
            dof = model.jnt_dofadr[number]
            slides = model.jnt_type[number] == mujoco.mjtJoint.mjJNT_SLIDE
            joint = Joint("prismatic" if slides else "revolute")
            if model.jnt_limited[number]:
                joint.lower, joint.upper = map(float, model.jnt_range[number])
            if model.jnt_actfrclimited[number]:
                joint.effort = float(model.jnt_actfrcrange[number][1])
            joint.damping = float(np.ravel(model.dof_damping[dof])[0])
            joint.friction = float(model.dof_frictionloss[dof])
            joint.armature = float(model.dof_armature[dof])
            self.facts.joints[plain(model.joint(number).name)] = joint

    def _control(self) -> None:
        mujoco, model, facts = self.mujoco, self.model, self.facts
        for number in range(model.nu):
            if model.actuator_trntype[number] != mujoco.mjtTrn.mjTRN_JOINT:
                continue
            name = plain(model.joint(model.actuator_trnid[number][0]).name)
            if name not in facts.joints:
                continue
            gear = abs(float(model.actuator_gear[number][0]))
            gain = -float(model.actuator_biasprm[number][1]) * gear * gear
            facts.drives[name] = gain if gain > 0 else facts.drives.get(name)
            joint = facts.joints[name]
            if joint.effort is None and model.actuator_forcelimited[number]:
                joint.effort = float(model.actuator_forcerange[number][1]) * gear
            elif joint.effort is None and not gain and model.actuator_ctrllimited[number]:
                most = float(model.actuator_ctrlrange[number][1])
                joint.effort = most * gear * float(model.actuator_gainprm[number][0])
        for number in range(model.neq):
            if model.eq_type[number] == mujoco.mjtEq.mjEQ_JOINT and model.eq_obj2id[number] >= 0:
                pair = model.eq_obj1id[number], model.eq_obj2id[number]
                follower, leader = (plain(model.joint(each).name) for each in pair)
                offset, multiplier = map(float, model.eq_data[number][:2])
                facts.mimics[follower] = leader, multiplier, offset
        for number in range(model.ncam):
            if not model.cam_bodyid[number]:
                continue  # of the scene
            facts.sensors.append(("camera", self.moves[model.cam_bodyid[number]]))
        seen = set()
        kinds = {
            "GYRO": "imu", "ACCELEROMETER": "imu", "TOUCH": "contact", "FORCE": "force_torque",
            "TORQUE": "force_torque", "RANGEFINDER": "lidar", "MAGNETOMETER": "magnetometer",
        }  # fmt: skip
        for number in range(model.nsensor):
            kind = mujoco.mjtSensor(model.sensor_type[number]).name.removeprefix("mjSENS_")
            if kind in kinds and model.sensor_objtype[number] == mujoco.mjtObj.mjOBJ_SITE:
                site = int(model.sensor_objid[number])
                if (kinds[kind], site) not in seen:
                    seen.add((kinds[kind], site))
                    facts.sensors.append((kinds[kind], self.moves[model.site_bodyid[site]]))
