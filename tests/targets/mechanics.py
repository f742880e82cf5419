"""The mechanics of a robot as other programs work them out, to compare formats with.

Each program reads one document and answers for positions, velocities and accelerations that are
given by the URDF's joints. Its own velocities are brought to those of pinocchio: v' = G·v and
a' = G·a + h, so that M = Gᵀ·M'·G and τ = Gᵀ·τ'. pinocchio has the velocity of a floating joint,
and of a free root, along the axes of the body: first linear, then angular; that of a planar joint
likewise.
"""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from lxml import etree

Array = np.ndarray[Any, Any]
ROOT_JOINT = "root_joint"
SINGLE = ("revolute", "continuous", "prismatic")
SIZES = {"planar": 3, "floating": 6}
UNLIMITED = 1e15


class NotJudged(Exception):
    """A judge has no means for something of a robot; the text says what."""


class Description:
    """What a URDF says of its joints and links, as lxml reads it."""

    def __init__(self, urdf: str) -> None:
        root = etree.fromstring(urdf.encode())
        self.joints: dict[str, Any] = {}
        for joint in root.findall("joint"):
            self.joints.setdefault(joint.get("name"), joint)
        self.links = list(dict.fromkeys(link.get("name") for link in root.findall("link")))
        children = {joint.find("child").get("link") for joint in self.joints.values()}
        self.root = next(name for name in self.links if name not in children)
        self.mass = sum(float(each.get("value")) for each in root.findall("link/inertial/mass"))
        world = root.find("link[@name='world']/inertial/mass")
        self.world_mass = float(world.get("value")) if world is not None else 0.0

    def moving(self) -> dict[str, str]:
        """Return the types of the joints that move, by name."""
        types = {name: joint.get("type") for name, joint in self.joints.items()}
        return {name: kind for name, kind in types.items() if kind in (*SINGLE, *SIZES)}

    def number(self, joint: str, path: str, attribute: str) -> float | None:
        element = self.joints[joint].find(path)
        text = element.get(attribute) if element is not None else None
        return float(text) if text is not None else None


class Motion:
    """Random positions, velocities and accelerations of all joints, in pinocchio's convention."""

    def __init__(self, random: np.random.Generator, joints: dict[str, str]) -> None:
        self.positions: dict[str, Any] = {}
        self.velocities: dict[str, Array] = {}
        self.accelerations: dict[str, Array] = {}
        for name, kind in joints.items():
            size = SIZES.get(kind, 1)
            self.velocities[name] = random.uniform(-1, 1, size)
            self.accelerations[name] = random.uniform(-1, 1, size)
            if kind == "floating":
                self.positions[name] = (random.uniform(-1, 1, 3), _quaternion(random))
            else:
                self.positions[name] = random.uniform(-2, 2, size)


def _quaternion(random: np.random.Generator) -> Array:
    """Return a random unit quaternion, w first."""
    found = random.normal(size=4)
    return found / np.linalg.norm(found)


def matrix(quaternion: Array) -> Array:
    """Return the rotation of a unit quaternion, w first."""
    from scipy.spatial.transform import Rotation

    w, x, y, z = quaternion
    return np.array(Rotation.from_quat([x, y, z, w]).as_matrix())


class Answer:
    """What a program says of one motion, in pinocchio's convention."""

    def __init__(self, poses: dict[str, Array], mass_matrix: Array, efforts: Array) -> None:
        self.poses = poses
        self.mass_matrix = mass_matrix
        self.efforts = efforts


# --- pinocchio --------------------------------------------------------------------------------


class Pinocchio:
    """A model of pinocchio; joints keep their names."""

    def __init__(self, model: Any, joints: dict[str, str]) -> None:
        import pinocchio

        self.pinocchio = pinocchio
        self.model = model
        self.data = model.createData()
        self.joints = joints
        self.mass = float(sum(inertia.mass for inertia in model.inertias))

    def answer(self, motion: Motion) -> Answer:
        pin, model, data = self.pinocchio, self.model, self.data
        q = pin.neutral(model)
        v, a = np.zeros(model.nv), np.zeros(model.nv)
        columns: list[int] = []
        for name, kind in self.joints.items():
            joint = model.joints[self._index(name)]
            at, slots = joint.idx_q, list(range(joint.idx_v, joint.idx_v + joint.nv))
            if joint.nv != SIZES.get(kind, 1):
                raise NotJudged(f"pinocchio has {joint.nv} velocities for the joint '{name}'")
            columns += slots
            v[slots], a[slots] = motion.velocities[name], motion.accelerations[name]
            position = motion.positions[name]
            if kind == "floating":
                (w, x, y, z) = position[1]
                q[at : at + 7] = [*position[0], x, y, z, w]
            elif joint.nq == 2:
                q[at : at + 2] = np.cos(position[0]), np.sin(position[0])
            elif joint.nq == 4:
                q[at : at + 4] = [*position[:2], np.cos(position[2]), np.sin(position[2])]
            else:
                q[at] = position[0]
        pin.framesForwardKinematics(model, data, q)
        poses = {}
        for index, frame in enumerate(model.frames):
            if frame.type == pin.FrameType.BODY:
                poses[frame.name] = np.array(data.oMf[index].homogeneous)
        full = np.array(pin.crba(model, data, q))
        full = np.triu(full) + np.triu(full, 1).T - np.diag(model.armature)
        saved, model.armature = np.array(model.armature), np.zeros(model.nv)
        efforts = np.array(pin.rnea(model, data, q, v, a))
        model.armature = saved
        return Answer(poses, full[np.ix_(columns, columns)], efforts[columns])

    def _index(self, name: str) -> int:
        if not self.model.existJointName(name):
            raise NotJudged(f"pinocchio has no joint '{name}'")
        return int(self.model.getJointId(name))


class PinocchioUrdf(Pinocchio):
    """pinocchio's model of a URDF, fixed or with a free root."""

    def __init__(self, urdf: str, *, is_fixed: bool = True) -> None:
        import pinocchio

        self.description = Description(urdf)
        for inertia in etree.fromstring(urdf.encode()).findall("link/inertial/inertia"):
            if not {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"} <= set(inertia.attrib):
                raise NotJudged("urdfdom leaves out an inertia of which numbers are missing")
        joints = self.description.moving()
        if not is_fixed:
            joints = {ROOT_JOINT: "floating", **joints}
            model = pinocchio.buildModelFromXML(urdf, pinocchio.JointModelFreeFlyer())
        else:
            model = pinocchio.buildModelFromXML(urdf)
        super().__init__(model, joints)
        for name, kind in joints.items():
            axis = None
            if kind == "planar":
                axis = self.description.joints[name].find("axis")
                if axis is None or [float(each) for each in axis.get("xyz").split()] != [0, 0, 1]:
                    raise NotJudged("pinocchio has planar joints only across z")


class PinocchioMjcf(Pinocchio):
    """pinocchio's model of an MJCF.

    Sites are not compared: in a body that fixed joints hold, pinocchio 4.1 places them wrongly.
    """

    def __init__(self, mjcf: str, files: dict[str, bytes], joints: dict[str, str]) -> None:
        import pinocchio

        for body in etree.fromstring(mjcf.encode()).findall("worldbody/body"):
            moves = body.find("joint") is not None or body.find("freejoint") is not None
            if not moves and (body.get("pos") or body.get("quat")):
                raise NotJudged("pinocchio 4.1 ignores where a fixed body is in the world")
        with tempfile.TemporaryDirectory() as folder:
            path = written(mjcf, files, Path(folder))
            model = pinocchio.buildModelFromMJCF(str(path))
        if ROOT_JOINT in joints:
            joints = dict(joints)
            free = [name for name in model.names if name.endswith("_free")]
            joints = {
                free[0] if name == ROOT_JOINT else name: kind for name, kind in joints.items()
            }
            self._free = free[0]
        super().__init__(model, joints)

    def answer(self, motion: Motion) -> Answer:
        if hasattr(self, "_free"):
            for each in (motion.positions, motion.velocities, motion.accelerations):
                each[self._free] = each[ROOT_JOINT]
        return super().answer(motion)


def written(mjcf: str, files: dict[str, bytes], folder: Path) -> Path:
    """Write a document and the files beside it, and return its path."""
    path = folder / "robot.xml"
    path.write_text(mjcf, "utf-8")
    for name, content in files.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_bytes(content)
    return path


# --- MuJoCo -----------------------------------------------------------------------------------


class Mujoco:
    """MuJoCo's model of an MJCF."""

    def __init__(self, mjcf: str, files: dict[str, bytes], joints: dict[str, str]) -> None:
        import mujoco

        self.mujoco = mujoco
        with tempfile.TemporaryDirectory() as folder:
            path = written(mjcf, files, Path(folder))
            self.model = mujoco.MjModel.from_xml_path(str(path))
        self.data = mujoco.MjData(self.model)
        self.joints = joints
        self.mass = float(self.model.body_mass.sum())

    def answer(self, motion: Motion) -> Answer:
        mujoco, model, data = self.mujoco, self.model, self.data
        transform, drift = np.zeros((model.nv, model.nv)), np.zeros(model.nv)
        v, a = np.zeros(model.nv), np.zeros(model.nv)
        data.qpos[:] = model.qpos0
        at = 0
        for name, kind in self.joints.items():
            size = SIZES.get(kind, 1)
            columns = slice(at, at + size)
            v[columns], a[columns] = motion.velocities[name], motion.accelerations[name]
            self._place(name, kind, motion, columns, transform, drift)
            at += size
        if at != model.nv:
            raise AssertionError(f"MuJoCo has {model.nv} velocities in place of {at}")
        data.qvel[:] = transform @ v
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_comVel(model, data)
        mujoco.mj_makeM(model, data)
        full = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, full)
        full -= np.diag(model.dof_armature)
        data.qacc[:] = transform @ a + drift
        efforts = np.zeros(model.nv)
        mujoco.mj_rne(model, data, 1, efforts)
        return Answer(self._poses(), transform.T @ full @ transform, transform.T @ efforts)

    def _place(
        self,
        name: str,
        kind: str,
        motion: Motion,
        columns: slice,
        transform: Array,
        drift: Array,
    ) -> None:
        """Set the position of a joint, and its part of the transform of velocities."""
        data, position, velocity = self.data, motion.positions[name], motion.velocities[name]
        if kind in SINGLE:
            joint = self.model.joint(name)
            data.qpos[joint.qposadr[0]] = position[0]
            transform[joint.dofadr[0], columns] = 1
        elif kind == "planar":
            c, s = np.cos(position[2]), np.sin(position[2])
            turn = np.array([[c, -s], [s, c]])
            parts = [self.model.joint(f"{name}_{part}") for part in ("x", "y", "yaw")]
            for part, value in zip(parts, position, strict=True):
                data.qpos[part.qposadr[0]] = value
            rows = [part.dofadr[0] for part in parts]
            transform[rows, columns] = np.block(
                [[turn, np.zeros((2, 1))], [np.zeros((1, 2)), np.eye(1)]]
            )
            x, y, w = velocity
            drift[rows[:2]] = turn @ np.array([-w * y, w * x])
        else:
            self._float(name, motion, columns, transform, drift)

    def _float(
        self, name: str, motion: Motion, columns: slice, transform: Array, drift: Array
    ) -> None:
        data, model = self.data, self.model
        place, turn = motion.positions[name]
        linear, angular = motion.velocities[name][:3], motion.velocities[name][3:]
        names = [model.joint(index).name for index in range(model.njnt)]
        if name in names or name == ROOT_JOINT:
            index = names.index(name) if name in names else 0
            joint = model.joint(index)
            assert joint.type[0] == 0, "not a free joint"
            outer = np.eye(4)  # T_world_joint: qpos0 is the pose at the joint's zero
            start = model.qpos0[joint.qposadr[0] : joint.qposadr[0] + 7].copy()
            if name == ROOT_JOINT:
                start[2] = 0  # the height at which it stands on the floor
            outer[:3, :3], outer[:3, 3] = matrix(start[3:]), start[:3]
            rotation = outer[:3, :3] @ matrix(turn)
            at = joint.qposadr[0]
            data.qpos[at : at + 3] = outer[:3, :3] @ place + outer[:3, 3]
            product = np.zeros(4)
            self.mujoco.mju_mulQuat(product, start[3:], turn)
            data.qpos[at + 3 : at + 7] = product
            rows = list(range(joint.dofadr[0], joint.dofadr[0] + 6))
        else:
            rotation = matrix(turn)
            rows = []
            for part, value in zip("xyz", place, strict=True):
                joint = model.joint(f"{name}_{part}")
                data.qpos[joint.qposadr[0]] = value
                rows.append(joint.dofadr[0])
            joint = model.joint(f"{name}_ball")
            data.qpos[joint.qposadr[0] : joint.qposadr[0] + 4] = turn
            rows += range(joint.dofadr[0], joint.dofadr[0] + 3)
        transform[rows, columns] = np.block(
            [[rotation, np.zeros((3, 3))], [np.zeros((3, 3)), np.eye(3)]]
        )
        drift[rows[:3]] = rotation @ np.cross(angular, linear)

    def _poses(self) -> dict[str, Array]:
        model, data = self.model, self.data
        poses = {}
        for index in range(model.nsite):
            name = model.site(index).name
            poses[name] = _pose(data.site_xmat[index], data.site_xpos[index])
        for index in range(model.nbody):
            poses[model.body(index).name] = _pose(data.xmat[index], data.xpos[index])
        return poses


def _pose(rotation: Array, position: Array) -> Array:
    found = np.eye(4)
    found[:3, :3], found[:3, 3] = rotation.reshape(3, 3), position
    return found


# --- Drake ------------------------------------------------------------------------------------


class DrakeMjcf:
    """Drake's model of an MJCF."""

    def __init__(self, mjcf: str, files: dict[str, bytes], joints: dict[str, str]) -> None:
        from pydrake.multibody.parsing import Parser
        from pydrake.multibody.plant import MultibodyPlant

        if set(joints.values()) & {"planar"} or "floating" in [
            kind for name, kind in joints.items() if name != ROOT_JOINT
        ]:
            raise NotJudged("joints of several numbers have other names in Drake")
        self.plant = MultibodyPlant(0.0)
        with tempfile.TemporaryDirectory() as folder:
            path = written(mjcf, files, Path(folder))
            Parser(self.plant).AddModels(path)
        self.plant.Finalize()
        self.context = self.plant.CreateDefaultContext()
        self.joints = joints
        self.mass = float(self.plant.CalcTotalMass(self.context))

    def answer(self, motion: Motion) -> Answer:
        plant, context = self.plant, self.context
        size = plant.num_velocities()
        transform, drift = np.zeros((size, size)), np.zeros(size)
        v, a = np.zeros(size), np.zeros(size)
        q = plant.GetPositions(context).copy()
        at = 0
        for name, kind in self.joints.items():
            columns = slice(at, at + SIZES.get(kind, 1))
            v[columns], a[columns] = motion.velocities[name], motion.accelerations[name]
            at += SIZES.get(kind, 1)
            if name == ROOT_JOINT:
                self._float(motion, q, transform, drift)
                continue
            joint = plant.GetJointByName(name)
            q[joint.position_start()] = motion.positions[name][0]
            transform[joint.velocity_start(), columns] = 1
        if at != size:
            raise AssertionError(f"Drake has {size} velocities in place of {at}")
        plant.SetPositions(context, q)
        velocities: Any = transform @ v
        plant.SetVelocities(context, velocities)
        from pydrake.multibody.tree import MultibodyForces

        forces = MultibodyForces(plant)
        plant.CalcForceElementsContribution(context, forces)
        inertia = plant.CalcMassMatrixViaInverseDynamics(context)
        acceleration = transform @ a + drift
        gravity = plant.CalcGravityGeneralizedForces(context)
        efforts = inertia @ acceleration + plant.CalcBiasTerm(context) - gravity
        poses = {
            frame.name(): np.array(frame.CalcPoseInWorld(context).GetAsMatrix4())
            for frame in (plant.get_body(index).body_frame() for index in self._bodies())
        }
        return Answer(poses, transform.T @ inertia @ transform, transform.T @ efforts)

    def _bodies(self) -> list[Any]:
        from pydrake.multibody.tree import BodyIndex

        return [BodyIndex(index) for index in range(self.plant.num_bodies())]

    def _float(self, motion: Motion, q: Array, transform: Array, drift: Array) -> None:
        plant = self.plant
        (index,) = plant.GetFloatingBaseBodies()
        body = plant.get_body(index)
        place, turn = motion.positions[ROOT_JOINT]
        at = body.floating_positions_start()
        q[at : at + 4], q[at + 4 : at + 7] = turn, place
        rotation = matrix(turn)
        rows = [body.floating_velocities_start_in_v() + part for part in range(6)]
        zero = np.zeros((3, 3))
        transform[rows, 0:6] = np.block([[zero, rotation], [rotation, zero]])
        linear, angular = motion.velocities[ROOT_JOINT][:3], motion.velocities[ROOT_JOINT][3:]
        drift[rows[3:]] = rotation @ np.cross(angular, linear)


# --- comparing --------------------------------------------------------------------------------


def differences(
    reference: PinocchioUrdf, other: Any, positions: int, seed: int = 1
) -> dict[str, float]:
    """Return the greatest differences of two programs, relative to the greatest value."""
    random = np.random.default_rng(seed)
    found = {"pose": 0.0, "mass matrix": 0.0, "efforts": 0.0}
    description = reference.description
    mass = description.mass
    if abs(reference.mass - mass) <= 1e-9 * max(mass, 1e-300):
        found["mass"] = abs(other.mass - mass) / max(mass, 1e-300)
    for _ in range(positions):
        motion = Motion(random, reference.joints)
        expected, answer = reference.answer(motion), other.answer(motion)
        for name, pose in expected.poses.items():
            if name in answer.poses and name in description.links:
                size = max(1.0, float(np.abs(pose).max()))
                gap = float(np.abs(pose - answer.poses[name]).max()) / size
                found["pose"] = max(found["pose"], gap)
        for what, one, two in (
            ("mass matrix", expected.mass_matrix, answer.mass_matrix),
            ("efforts", expected.efforts, answer.efforts),
        ):
            if one.size:
                size = float(np.abs(one).max()) or 1.0
                found[what] = max(found[what], float(np.abs(one - two).max()) / size)
    return found


def missing_frames(reference: PinocchioUrdf, model: Mujoco) -> set[str]:
    """Return the links that MuJoCo has neither as a body nor as a site."""
    mujoco = model.model
    found = {mujoco.body(index).name for index in range(mujoco.nbody)}
    found |= {mujoco.site(index).name for index in range(mujoco.nsite)}
    return set(reference.description.links) - found


def joint_differences(description: Description, model: Any) -> dict[str, list[str]]:
    """Return which values of joints of one number differ from the URDF, by joint."""
    found: dict[str, list[str]] = {}
    for name, kind in description.moving().items():
        if kind not in SINGLE:
            continue
        joint = model.joint(name)
        lower = description.number(name, "limit", "lower") or 0.0
        upper = description.number(name, "limit", "upper") or 0.0
        effort = description.number(name, "limit", "effort")
        is_limited = kind != "continuous" and not (lower <= -UNLIMITED and upper >= UNLIMITED)
        has_effort = effort is not None and effort < UNLIMITED
        wanted = {
            "limits": (lower, upper) if is_limited else None,
            "effort": (-(effort or 0.0), effort or 0.0) if has_effort else None,
            "damping": description.number(name, "dynamics", "damping") or 0.0,
            "friction": description.number(name, "dynamics", "friction") or 0.0,
        }
        dof = joint.dofadr[0]
        given = {
            "limits": tuple(joint.range) if model.jnt_limited[joint.id] else None,
            "effort": tuple(model.jnt_actfrcrange[joint.id])
            if model.jnt_actfrclimited[joint.id]
            else None,
            "damping": float(np.ravel(model.dof_damping[dof])[0]),
            "friction": float(model.dof_frictionloss[dof]),
        }
        for what, value in wanted.items():
            if not _is_same(value, given[what]):
                found.setdefault(name, []).append(what)
    return found


def _is_same(one: Any, two: Any) -> bool:
    if one is None or two is None:
        return one is two
    return bool(np.allclose(one, two, rtol=1e-9, atol=1e-12))


def mimic_differences(description: Description, model: Any) -> list[str]:
    """Return the joints whose mimic MuJoCo does not have as the URDF."""
    found = {}
    for index in range(model.neq):
        if model.eq_type[index] == 2:
            follower = model.joint(int(model.eq_obj1id[index])).name
            leader = model.joint(int(model.eq_obj2id[index])).name
            found[follower] = (leader, tuple(model.eq_data[index][:2]))
    wrong = []
    for name in description.moving():
        mimic = description.joints[name].find("mimic")
        if mimic is None:
            if name in found:
                wrong.append(name)
            continue
        numbers = (float(mimic.get("offset", 0)), float(mimic.get("multiplier", 1)))
        leader, given = found.get(name, ("", (0.0, 0.0)))
        if leader != mimic.get("joint") or not _is_same(numbers, given):
            wrong.append(name)
    return wrong
