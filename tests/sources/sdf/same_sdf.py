"""Whether two files of SDFormat are the same robot: Drake loads both, and their texts are compared.

Drake knows mass, poses, joints, limits, damping, springs, rotors and shapes. What it does not read,
such as friction of joints, sensors, materials and plugins, is compared as text: each value of the
first file has to be in the second, or be one that says nothing.
"""

from __future__ import annotations

import logging
import re
from math import isinf
from pathlib import Path
from typing import Any

import numpy as np
from lxml import etree

TOLERANCE = 1e-9
OF_DRAKE = re.compile("_(parent|child)_[FM]$|_welds_to_")
"""The names of frames that Drake makes for joints."""
Matrix = np.ndarray[Any, Any]


class RefusedError(Exception):
    """Drake does not read a file."""


class Loaded:
    """A model as Drake has it.

    Attributes:
        joints: those that move, by their names, with those of nested models before them.
        frames: all frames and bodies, likewise.
        bodies: likewise.
    """

    def __init__(
        self, path: Path, model: str | None, package_paths: list[Path], *, has_shapes: bool = True
    ) -> None:
        from pydrake.common import configure_logging
        from pydrake.geometry import SceneGraph
        from pydrake.multibody import parsing
        from pydrake.multibody.plant import MultibodyPlant
        from pydrake.multibody.tree import ModelInstanceIndex

        configure_logging()
        logging.getLogger("drake").setLevel(logging.ERROR)
        self.plant: Any = MultibodyPlant(1e-3)
        self.scene: Any = SceneGraph()
        self.has_shapes = has_shapes
        if has_shapes:
            self.plant.RegisterAsSourceForSceneGraph(self.scene)
        parser: Any = parsing.Parser(self.plant)
        for folder in package_paths:
            for manifest in folder.glob("*/model.config"):
                if not parser.package_map().Contains(manifest.parent.name):
                    parser.package_map().Add(manifest.parent.name, str(manifest.parent))
        try:
            parser.AddModels(str(_without_sensors(path.resolve(), package_paths)))
            self.plant.Finalize()
        except (RuntimeError, MemoryError) as error:
            raise RefusedError(str(error).partition("\n")[0][:160]) from None
        self.context = self.plant.CreateDefaultContext()
        names = {
            index: self.plant.GetModelInstanceName(ModelInstanceIndex(index))
            for index in range(2, self.plant.num_model_instances())
        }
        top = model or next(iter(names.values()), "")
        self.instances = {
            index: name.removeprefix(top).removeprefix("::")
            for index, name in names.items()
            if name == top or name.startswith(f"{top}::")
        }
        self.joints = self._named(self.plant.GetJointIndices, self.plant.get_joint)
        self.joints = {name: j for name, j in self.joints.items() if j.num_velocities() > 0}
        self.bodies = self._named(self.plant.GetBodyIndices, self.plant.get_body)
        joints = [self.plant.get_joint(index) for index in self.plant.GetJointIndices()]
        own = {f"{joint.name()}_{end}" for joint in joints for end in ("parent", "child")}
        found = self._named(self.plant.GetFrameIndices, self.plant.get_frame)
        self.frames = {
            name: each
            for name, each in found.items()
            if each.name() not in own and not OF_DRAKE.search(each.name())
        }

    def _named(self, indices: Any, get: Any) -> dict[str, Any]:
        from pydrake.multibody.tree import ModelInstanceIndex

        found = {}
        for number, path in self.instances.items():
            for index in indices(ModelInstanceIndex(number)):
                each = get(index)
                if not each.name().startswith("_"):
                    found["_".join([*path.split("::"), each.name()]).lstrip("_")] = each
        return found

    def mass_matrix(self, names: list[str]) -> Matrix:
        """Return the rows and columns of the mass matrix of some joints."""
        rows = self.rows(names)
        return np.asarray(self.plant.CalcMassMatrix(self.context)[np.ix_(rows, rows)])

    def rows(self, names: list[str]) -> list[int]:
        """Return the numbers of the velocities of some joints."""
        return [
            joint.velocity_start() + index
            for joint in (self.joints[name] for name in names)
            for index in range(joint.num_velocities())
        ]

    def forces(self, names: list[str], accelerations: Matrix) -> Matrix:
        """Return the forces of some joints at given accelerations, with springs and damping."""
        from pydrake.multibody.tree import MultibodyForces

        known = np.zeros(self.plant.num_velocities())
        known[self.rows(names)] = accelerations
        forces = MultibodyForces(self.plant)
        self.plant.CalcForceElementsContribution(self.context, forces)
        return np.asarray(
            self.plant.CalcInverseDynamics(self.context, known, forces)[self.rows(names)]
        )

    def pose(self, frame: Any) -> Matrix:
        """Return the pose of a frame in the world."""
        return np.asarray(frame.CalcPoseInWorld(self.context).GetAsMatrix4())

    def shapes(self, body: Any) -> list[tuple[str, Matrix]]:
        """Return the shapes of a body: what each is, and its pose."""
        from pydrake.geometry import Role

        if not self.has_shapes:
            return []
        inspector = self.scene.model_inspector()
        frame = self.plant.GetBodyFrameIdIfExists(body.index())
        found = []
        for role in (Role.kIllustration, Role.kProximity) if frame is not None else ():
            for geometry in inspector.GetGeometries(frame, role):
                shape = inspector.GetShape(geometry)
                pose = np.asarray(inspector.GetPoseInFrame(geometry).GetAsMatrix4())
                found.append((f"{role} {_kind(shape)}", pose))
        return found


def _without_sensors(path: Path, folders: list[Path]) -> Path:
    """Return a copy without sensors and plugins, which Drake does not use and is strict about.

    Drake finds included files, and no folders of models; the files are copied likewise.
    """
    root = etree.parse(str(path), etree.XMLParser(recover=True)).getroot()
    if root.tag == "gazebo":  # 1.2, to which 1_2.convert of libsdformat changes nothing else
        root.tag = "sdf"
        root.set("version", "1.3")
    for each in [*root.iter("sensor", "plugin", "physics", "scene", "gui", "light")]:
        each.getparent().remove(each)
    for uri in root.iterfind(".//include/uri"):
        name = (uri.text or "").strip().removeprefix("model://")
        for folder in (path.parent, *folders):
            file = folder / name
            if file.is_dir() and (file / "model.config").exists():
                listed = etree.parse(str(file / "model.config")).getroot().findall("sdf")
                file /= max(
                    listed, key=lambda e: [int(n) for n in (e.get("version") or "1.0").split(".")]
                ).text.strip()
            elif file.is_dir():
                file /= "model.sdf"
            if file.is_file():
                uri.text = f"file://{_without_sensors(file.resolve(), folders)}"
                break
    copy = path.with_name(f".{path.stem}-judged.sdf")
    copy.write_bytes(etree.tostring(root))
    return copy


def _kind(shape: Any) -> str:
    kind = type(shape).__name__
    if kind in ("Mesh", "Convex"):
        name = Path(str(shape.source().path())).name
        return f"{kind} {name} {np.asarray(shape.scale3()).round(12)}"
    return re.sub(r"[\d.]+(e-?\d+)?", lambda found: f"{float(found[0]):.11g}", str(shape))


def _call_alike(mine: dict[str, Any], theirs: dict[str, Any]) -> None:
    for name in [each for each in theirs if each not in mine]:
        short = [
            each
            for each in mine
            if each not in theirs
            and (
                each.endswith(f"_{name}")
                or name.endswith(f"_{mine[each].name()}")
                or mine[each].name() == name
            )
        ]
        if len(short) == 1:
            theirs[short[0]] = theirs.pop(name)


class Same:
    """Compares two files.

    Attributes:
        faults: what differs.
    """

    def __init__(
        self, one: Path, other: Path, *, model: str | None = None, folders: list[Path] | None = None
    ) -> None:
        has_shapes = True
        try:
            self.one = Loaded(one, model, folders or [])
        except RefusedError:  # because of a mesh, perhaps
            has_shapes = False
            self.one = Loaded(one, model, folders or [], has_shapes=False)
        self.other = Loaded(other, None, folders or [], has_shapes=has_shapes)
        self.faults: list[str] = []
        tree = etree.parse(str(one), etree.XMLParser(recover=True))
        self.of_world = [each.get("name") for each in tree.iterfind("world/frame")]

    def run(self, states: int = 20) -> list[str]:
        """Return what differs."""
        one, other = self.one, self.other
        # Drake puts joints and frames into the models of the links that they are on.
        _call_alike(one.joints, other.joints)
        _call_alike(one.frames, other.frames)
        for what, mine, theirs in (
            ("joints that move", one.joints, other.joints),
            ("bodies", one.bodies, other.bodies),
        ):
            if set(mine) != set(theirs):
                lost, new = sorted(set(mine) - set(theirs)), sorted(set(theirs) - set(mine))
                self.faults.append(f"{what}: -{lost[:4]} +{new[:4]}")
        for name in list(one.frames):  # those of the world are in the models of their links
            if name.rpartition("_")[2] in self.of_world or name in self.of_world:
                del one.frames[name]
        if set(one.frames) - set(other.frames):
            self.faults.append(f"frames: -{sorted(set(one.frames) - set(other.frames))[:4]}")
        if self.faults:
            return self.faults
        names = list(one.joints)
        for name in names:
            self._compare_joint(name)
        for name, body in one.bodies.items():
            self._compare_shapes(name, body, other.bodies[name])
        self._compare_poses("at the start")
        random = np.random.default_rng(3)
        for _ in range(states if not self.faults else 0):
            self._draw(names, random)
            self._compare_poses("")
            if names:
                self._close("mass matrix", one.mass_matrix(names), other.mass_matrix(names))
                push = random.uniform(-1, 1, len(one.rows(names)))
                self._close("forces", one.forces(names, push), other.forces(names, push))
            if self.faults:
                break
        return self.faults

    def _draw(self, names: list[str], random: Any) -> None:
        both = (self.one, self.other)
        q = [np.array(each.plant.GetPositions(each.context)) for each in both]
        v = [np.zeros(each.plant.num_velocities()) for each in both]
        for name in names:
            count = self.one.joints[name].num_positions()
            values = random.uniform(-1, 1, count)
            if count == 7:
                values[:4] /= np.linalg.norm(values[:4])
            speeds = random.uniform(-1, 1, self.one.joints[name].num_velocities())
            for index, each in enumerate(both):
                joint = each.joints[name]
                q[index][joint.position_start() : joint.position_start() + count] = values
                start = joint.velocity_start()
                v[index][start : start + len(speeds)] = speeds
        for index, each in enumerate(both):
            each.plant.SetPositions(each.context, q[index][:, None])
            each.plant.SetVelocities(each.context, v[index][:, None])

    def _compare_poses(self, when: str) -> None:
        for name, frame in self.one.frames.items():
            mine, theirs = self.one.pose(frame), self.other.pose(self.other.frames[name])
            self._close(f"pose of {name} {when}", mine, theirs)

    def _compare_joint(self, name: str) -> None:
        mine, theirs = self.one.joints[name], self.other.joints[name]
        if type(mine) is not type(theirs):
            self.faults.append(f"{name}: {type(mine).__name__} became {type(theirs).__name__}")
            return
        values = [
            ("position_lower_limits", "lower"), ("position_upper_limits", "upper"),
            ("velocity_upper_limits", "velocity"), ("acceleration_upper_limits", "acceleration"),
            ("default_damping_vector", "damping"),
        ]  # fmt: skip
        for method, what in values:
            self._close(
                f"{what} of {name}",
                np.asarray(getattr(mine, method)()), np.asarray(getattr(theirs, method)()),
            )  # fmt: skip
        actuators = [
            self._actuator(each, joint) for each, joint in ((self.one, mine), (self.other, theirs))
        ]
        if actuators[0] != actuators[1]:
            self.faults.append(f"actuator of {name}: {actuators[0]} became {actuators[1]}")

    def _actuator(self, loaded: Loaded, joint: Any) -> tuple[float, ...] | None:
        for index in loaded.plant.GetJointActuatorIndices():
            each = loaded.plant.get_joint_actuator(index)
            if each.joint() is joint:
                return (
                    each.effort_limit(),
                    each.default_rotor_inertia(),
                    each.default_gear_ratio(),
                )
        return None

    def _compare_shapes(self, name: str, body: Any, other: Any) -> None:
        mine, theirs = self.one.shapes(body), self.other.shapes(other)
        for kind, pose in mine:
            found = [
                index for index, (its, where) in enumerate(theirs)
                if its == kind and np.abs(where - pose).max() <= 1e-9 * max(1, np.abs(pose).max())
            ]  # fmt: skip
            if not found:
                self.faults.append(f"shape of {name}: {kind} is not there")
                return
            theirs.pop(found[0])
        if theirs:
            self.faults.append(f"shape of {name}: {theirs[0][0]} is new")

    def _close(self, what: str, mine: Matrix, theirs: Matrix) -> None:
        if mine.shape != theirs.shape:
            self.faults.append(f"{what}: shape {mine.shape} became {theirs.shape}")
            return
        mine, theirs = (
            np.where(np.abs(each) >= 1e16, np.copysign(np.inf, each), each)
            for each in (mine, theirs)
        )
        same = (mine == theirs) | (np.isinf(mine) & np.isinf(theirs) & (mine * theirs > 0))
        off = np.where(same, 0.0, np.abs(np.where(same, 0.0, mine) - np.where(same, 0.0, theirs)))
        scale = max(1e-9, np.abs(np.where(np.isinf(mine), 0.0, mine)).max(initial=0.0))
        scale = max(scale, 1.0) if what.startswith("pose") else scale
        if off.max(initial=0.0) > TOLERANCE * scale or np.isnan(off).any():
            self.faults.append(f"{what}: off by {off.max() / scale:.1e}")


# --- texts --------------------------------------------------------------------------------------


NOTHING = {
    "always_on": {"1", "true", "0", "false", ""}, "visualize": {"0", "false"}, "mean": {"0", "0.0"},
    "bias_mean": {"0", "0.0"}, "bias_stddev": {"0", "0.0"}, "resolution": {"1", "1.0"},
    "frame": {"child"}, "measure_direction": {"child_to_parent"}, "type": {"gaussian"},
    "topic": {"__default_topic__"}, "update_rate": {"0"},
}  # fmt: skip
"""Values that say nothing, or only what is written anyway."""
TYPES = {"ray": "gpu_lidar", "gpu_ray": "gpu_lidar", "gps": "navsat", "depth": "depth_camera"}
TAGS = {"ray": "lidar", "gps": "navsat"}
UNREAD = {"pose", "inertial", "xyz", "use_parent_model_frame", "parent", "child"}
"""What Drake judges."""


def lost_texts(one: Path, other: Path, model: str | None) -> list[str]:
    """Return the values of a model without nested models that another one does not have."""
    first = _model_in(one, model)
    second = _model_in(other, None)
    if first is None or second is None or first.find("include") is not None:
        return []
    if first.find("model") is not None:
        return []
    found: list[str] = []
    for child in first:
        if not isinstance(child.tag, str) or child.tag in ("pose", "frame"):
            continue
        match = _like(child, second)
        if match is None:
            found.append(f"<{child.tag} {child.get('name') or ''}>")
        else:
            _lost_in(child, match, f"{child.tag} {child.get('name') or ''}", found)
    return found


def _model_in(path: Path, name: str | None) -> etree._Element | None:
    parser = etree.XMLParser(recover=True)
    root = etree.parse(str(path), parser).getroot()
    for model in root.iterfind(".//model"):
        if name is None or model.get("name") == name:
            return model
    return None


def _like(child: etree._Element, around: etree._Element) -> etree._Element | None:
    tag = TAGS.get(child.tag, child.tag)
    if tag.startswith("{") or ":" in tag:
        tag = "{*}" + _plain(tag)
    if tag == "plugin":
        for each in around.iterchildren(tag):
            one, other = (
                [(_plain(e.tag), (e.text or "").split()) for e in tree.iter("*")]
                for tree in (each, child)
            )
            if sorted(one) == sorted(other) and dict(each.attrib) == dict(child.attrib):
                return each
    for each in around.iterchildren(tag):
        if each.get("name") == child.get("name") or not child.get("name"):
            return each
    return None


def _lost_in(one: etree._Element, other: etree._Element, path: str, found: list[str]) -> None:
    theirs = {_plain(name): value for name, value in other.attrib.items()}
    for name, value in one.attrib.items():
        if name in ("name", "relative_to", "expressed_in", "frame", "type"):
            continue
        is_same = _equal(name, value, theirs.get(_plain(name)))
        if not is_same and not name.startswith("xmlns"):
            found.append(f"{path}@{name}={value}")
    kind = one.get("type")
    if kind and other.get("type") not in (kind, TYPES.get(kind)):
        if one.tag != "joint" and not (one.tag == "noise" and one.get("type") == "none"):
            found.append(f"{path}@type={one.get('type')}")
    tags = [child.tag for child in one if isinstance(child.tag, str)]
    repeated = {tag for tag in tags if tags.count(tag) > 1}
    for child in one:
        if not isinstance(child.tag, str) or child.tag in UNREAD:
            continue
        if child.tag in repeated and not child.get("name"):
            texts = {
                (" ".join((each.text or "").split())) for each in other.iterchildren(child.tag)
            }
            if " ".join((child.text or "").split()) not in texts:
                found.append(f"{path}/{child.tag} (one of several)")
            continue
        match = _like(child, other)
        text = (child.text or "").strip()
        if len(child) == 0:
            there = (match.text or "").strip() if match is not None else None
            if not _equal(child.tag, text, there) and (text or child.attrib):
                found.append(f"{path}/{child.tag}={text[:40]}, and there {there}")
                continue
        if match is not None:
            _lost_in(child, match, f"{path}/{child.tag}", found)
        elif len(child) and any(_says(each) for each in child.iter() if len(each) == 0):
            found.append(f"{path}/<{child.tag}>")


def _plain(name: str) -> str:
    return name.rpartition("}")[2].rpartition(":")[2]


def _says(leaf: etree._Element) -> bool:
    if not isinstance(leaf.tag, str) or leaf.tag in UNREAD:
        return False
    return not _equal(leaf.tag, (leaf.text or "").strip(), None)


def _equal(tag: str, one: str, other: str | None) -> bool:
    if other is None:
        if one.lower() in NOTHING.get(tag, ()) or not one:
            return True
        try:
            number = float(one.split()[0])
        except (ValueError, IndexError):
            return False
        if tag == "scale":
            return one.split() == ["1"] * 3 or set(map(float, one.split())) == {1.0}
        if tag in ("lower", "upper"):
            return abs(number) >= 1e16
        if tag in ("effort", "velocity"):
            return number < 0 or number >= 1e16 or isinf(number)
        return tag in ("damping", "friction", "samples", "min_angle", "max_angle") and number in (
            0,
            1,
        )
    if one == other or (tag == "uri" and Path(one).name == Path(other).name):
        return True
    try:
        first, second = ([float(word) for word in text.split()] for text in (one, other))
    except ValueError:
        return (one.lower() in ("true", "1") and other.lower() in ("true", "1")) or (
            one.lower() in ("false", "0") and other.lower() in ("false", "0")
        )
    if len(first) == 3 and len(second) == 4:
        second = second[:3]
    return len(first) == len(second) and all(
        abs(a - b) <= 1e-9 * max(1, abs(a))
        or (tag in ("diffuse", "ambient") and b == min(max(a, 0), 1))
        for a, b in zip(first, second, strict=True)
    )


# --- URDF ---------------------------------------------------------------------------------------


def faults_of_urdf(drake: Loaded, urdf: Path, states: int = 20) -> list[str]:
    """Return where pinocchio, which reads the URDF of a model, disagrees with Drake.

    Compared are the poses of all links and frames from the root, the mass matrix of the joints, and
    the total mass. Joints that float are at their origin.
    """
    import pinocchio as pin

    try:
        model = pin.buildModelFromUrdf(str(urdf))
    except (ValueError, RuntimeError) as error:
        return [f"pinocchio: {str(error).splitlines()[0][:120]}"]
    data = model.createData()
    known = set(model.names)
    _call_alike(drake.joints, dict.fromkeys(known))
    joints = {}
    for name, joint in drake.joints.items():
        if joint.num_velocities() == 1:
            found = name if name in known else joint.name()
            alike = [each for each in known if each.endswith(f"_{joint.name()}")]
            if found not in known and len(alike) == 1:  # Drake has it in the model of its child
                (found,) = alike
            if found not in known:
                return [f"no joint '{name}'"]
            joints[found] = joint
    floating = [each for each in model.joints if each.nv == 6]
    frames = {name: each for name, each in drake.frames.items() if model.existFrame(name)}
    random = np.random.default_rng(5)
    root = model.frames[1].name
    for _ in range(states):
        q, positions = pin.neutral(model), np.zeros(drake.plant.num_positions())
        for body in drake.plant.GetFloatingBaseBodies():
            positions[drake.plant.get_body(body).floating_positions_start()] = 1.0
        for name, joint in joints.items():
            mine = model.joints[model.getJointId(name)]
            value = random.uniform(-1, 1)
            row = [value] if mine.nq == 1 else [np.cos(value), np.sin(value)]
            q[mine.idx_q : mine.idx_q + mine.nq] = row
            positions[joint.position_start()] = value
        drake.plant.SetPositions(drake.context, positions[:, None])
        pin.framesForwardKinematics(model, data, q)
        poses = {
            name: data.oMf[model.getFrameId(name, pin.FrameType.BODY)].homogeneous
            for name in (root, *frames)
        }
        base = np.eye(4) if root not in drake.frames else drake.pose(drake.frames[root])
        for name, frame in frames.items() if not floating else ():
            mine = np.linalg.inv(poses[root]) @ poses[name]
            theirs = np.linalg.inv(base) @ drake.pose(frame)
            off = np.abs(mine - theirs).max()
            if off > TOLERANCE * max(1, np.abs(theirs).max()):
                return [f"pose of {name} in URDF: off by {off:.1e}"]
        if not joints:
            continue
        mass = pin.crba(model, data, q)
        mass = np.triu(mass) + np.triu(mass, 1).T
        order = [model.joints[model.getJointId(name)].idx_v for name in joints]
        rows = [joint.velocity_start() for joint in joints.values()]
        theirs = drake.plant.CalcMassMatrix(drake.context)[np.ix_(rows, rows)]
        rotors = np.diag([_rotor(drake, joint) for joint in joints.values()])
        off = np.abs(mass[np.ix_(order, order)] + rotors - theirs).max()
        if off > TOLERANCE * np.abs(theirs).max():
            return [f"mass matrix in URDF: off by {off:.1e}"]
    return []


def _rotor(drake: Loaded, joint: Any) -> float:
    """Return what the rotor of a joint adds to the mass matrix, which URDF cannot hold."""
    for index in drake.plant.GetJointActuatorIndices():
        each = drake.plant.get_joint_actuator(index)
        if each.joint() is joint:
            return float(each.default_rotor_inertia() * each.default_gear_ratio() ** 2)
    return 0.0
