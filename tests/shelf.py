"""The robots of `robots/`, and how each is compared with its vendor's description.

Both sides are read by other people's programs: URDF by yourdfpy, MJCF by MuJoCo. What a vendor's
file says is kept in `vendor.json`, since the file itself is not here; `scripts/shelf record` writes
it. A record has these keys, in SI units and radians:

- `joints`: by name, each with `type`, `parent`, `child`, the pose `xyz` and `rpy` of the child in
  the parent, and as far as the joint has them `axis`, `lower`, `upper`, `effort`, `velocity`, and
  `mimic` with the joint, the multiplier and the offset;
- `links`: by name, each with `mass`, `com` and `inertia` (ixx ixy ixz iyy iyz izz about the centre
  of mass, along the axes of the link), or nothing without an inertial.

`differences.yaml` is a list of reasons, each with the values that differ for it:

    - why: the vendor rounds a right angle to 1.57
      values:
        joints/wheel_left_joint/rpy: {there: [-1.57, 0, 0], here: [-1.5707963267948966, 0, 0]}

A joint or link that only one side has is `{there: missing}` or `{here: missing}`; a joint of
another name that holds the same link differs in its `name`. Where the vendor has several models,
`of: [MODEL]` says to which a reason applies; without it, values of joints and links that a model
does not have are passed over.
"""

from __future__ import annotations

import json
import math
import re
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np
import yaml

ROBOTS = Path(__file__).parents[1] / "robots"
Record = dict[str, dict[str, dict[str, Any]]]
Matrix = np.ndarray[Any, Any]

TOLERANCE = 1e-6
"""Of masses, lengths and limits, relative where they are more than 1; of inertias, relative to the
greatest moment. Poses are compared to `POSE`."""
POSE = 1e-9
MISSING = "missing"


def names() -> list[str]:
    """Return the names of all robots."""
    return sorted(path.parents[1].name for path in ROBOTS.glob("*/urdf/*.yaml") if _is_main(path))


def _is_main(path: Path) -> bool:
    return path.stem == path.parents[1].name


def main_file(name: str) -> Path:
    """Return the file of a robot."""
    return ROBOTS / name / "urdf" / f"{name}.yaml"


def vendor_files(name: str) -> list[Path]:
    """Return the records of what the vendor says, one for each of its models."""
    return sorted((ROBOTS / name).glob("vendor*.json"))


def model_of(vendor: Path) -> str:
    """Return which of the vendor's models a record is of."""
    return vendor.stem.removeprefix("vendor").lstrip("_")


def lines_of(text: str, *, is_xml: bool) -> int:
    """Return how many lines a text has that are neither blank nor only a comment."""
    if is_xml:
        text = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)
    lines = (line.strip() for line in text.splitlines())
    return sum(bool(line) and (is_xml or not line.startswith("#")) for line in lines)


def parts_of(name: str) -> set[str]:
    """Return the robots that a robot is put together of."""
    files = (ROBOTS / name / "urdf").glob("*.yaml")
    text = "".join(path.read_text(encoding="utf-8") for path in files)
    return set(re.findall(r"package://yamaro_(\w+)/", text))


def own_lines(name: str) -> int:
    """Return how many lines the YAML of a robot has, with that of its parts."""
    files = sorted((ROBOTS / name / "urdf").glob("*.yaml"))
    lines = sum(lines_of(path.read_text(encoding="utf-8"), is_xml=False) for path in files)
    return lines + sum(map(own_lines, parts_of(name)))


# --- what readers say -------------------------------------------------------------------------


def read_urdf(text: str) -> Record:
    """Return what yourdfpy reads in a URDF."""
    import yourdfpy

    with tempfile.NamedTemporaryFile("w", suffix=".urdf", encoding="utf-8") as file:
        file.write(text)
        file.flush()
        robot = yourdfpy.URDF.load(
            file.name,
            build_scene_graph=False,
            load_meshes=False,
            build_collision_scene_graph=False,
            load_collision_meshes=False,
        ).robot
    record: Record = {"joints": {}, "links": {}}
    for joint in robot.joints:
        found: dict[str, Any] = {"type": joint.type, "parent": joint.parent, "child": joint.child}
        found.update(_pose(np.eye(4) if joint.origin is None else joint.origin))
        if joint.type not in ("fixed", "floating"):
            found["axis"] = _row(joint.axis / np.linalg.norm(joint.axis))
        if joint.type != "fixed":
            for key in ("lower", "upper", "effort", "velocity"):
                value = getattr(joint.limit, key, None)
                if value is not None and not (
                    joint.type == "continuous" and key in ("lower", "upper")
                ):
                    found[key] = float(value)
        if joint.mimic is not None:
            multiplier, offset = joint.mimic.multiplier, joint.mimic.offset
            found["mimic"] = [
                joint.mimic.joint,
                1.0 if multiplier is None else float(multiplier),
                0.0 if offset is None else float(offset),
            ]
        record["joints"][joint.name] = found
    for link in robot.links:
        inertial = link.inertial
        record["links"][link.name] = {}
        if inertial is not None and inertial.mass is not None:
            pose = np.eye(4) if inertial.origin is None else inertial.origin
            inertia = np.zeros((3, 3)) if inertial.inertia is None else inertial.inertia
            record["links"][link.name] = _inertial(float(inertial.mass), pose, inertia)
    return record


def read_mjcf(path: Path) -> Record:
    """Return what MuJoCo reads in an MJCF: a body is a link, whose frame is at its joint."""
    import mujoco

    spec = mujoco.MjSpec.from_file(str(path))
    for geom in spec.geoms:  # the meshes are not needed where the inertia is written
        if geom.type == mujoco.mjtGeom.mjGEOM_MESH and geom.parent.explicitinertial:
            spec.delete(geom)
    used = {geom.meshname for geom in spec.geoms}
    for mesh in spec.meshes:
        if mesh.name not in used:
            spec.delete(mesh)
    model = spec.compile()
    record: Record = {"joints": {}, "links": {}}
    kinds = ("floating", "ball", "prismatic", "revolute")
    shifts = {0: np.zeros(3)}
    for index in range(1, model.nbody):
        body, above = model.body(index), int(model.body_parentid[index])
        joint = model.joint(int(body.jntadr[0])) if body.jntnum[0] else None
        kind = "fixed" if joint is None else kinds[int(joint.type[0])]
        shift = joint.pos.copy() if joint is not None and kind != "floating" else np.zeros(3)
        shifts[index] = shift
        rotation = _of_quaternion(body.quat)
        pose = np.eye(4)
        pose[:3, :3] = rotation
        pose[:3, 3] = body.pos + rotation @ shift - shifts[above]
        if joint is not None and kind == "revolute":  # the pose is that at the reference, not at 0
            angle = -float(model.qpos0[joint.qposadr[0]])
            pose[:3, :3] = pose[:3, :3] @ _about(joint.axis, angle)
        inertial = np.eye(4)
        inertial[:3, :3] = _of_quaternion(body.iquat)
        inertial[:3, 3] = body.ipos - shift
        mass = float(body.mass[0])
        record["links"][body.name] = (
            _inertial(mass, inertial, np.diag(body.inertia)) if mass else {}
        )
        if above == 0 and kind in ("floating", "fixed"):
            continue
        parent = model.body(above).name
        name = joint.name if joint is not None else f"{body.name}_joint"
        found: dict[str, Any] = {"type": kind, "parent": parent, "child": body.name, **_pose(pose)}
        if joint is not None and kind != "ball":
            found["axis"] = _row(joint.axis)
            if joint.limited[0]:
                found["lower"], found["upper"] = map(float, joint.range)
            elif kind == "revolute":
                found["type"] = "continuous"
        record["joints"][name] = found
    for index in range(model.nu):
        _add_effort(model, index, record)
    return record


def _add_effort(model: Any, index: int, record: Record) -> None:
    """Add to a joint the greatest effort of its actuator: its force, else what a motor is told."""
    import mujoco

    actuator = model.actuator(index)
    if actuator.trntype[0] != mujoco.mjtTrn.mjTRN_JOINT:
        return
    joint = record["joints"].get(model.joint(int(actuator.trnid[0])).name)
    is_motor = not actuator.biasprm.any()
    if joint is not None and model.actuator_forcelimited[index]:
        joint["effort"] = float(abs(actuator.forcerange).max() * abs(actuator.gear[0]))
    elif joint is not None and is_motor and model.actuator_ctrllimited[index]:
        most = abs(actuator.ctrlrange).max() * actuator.gainprm[0] * abs(actuator.gear[0])
        joint["effort"] = float(most)


def _pose(T_parent_child: Matrix) -> dict[str, list[float]]:
    return {"xyz": _row(T_parent_child[:3, 3]), "rpy": _row(_rpy(T_parent_child[:3, :3]))}


def _inertial(mass: float, T_link_inertial: Matrix, inertia: Matrix) -> dict[str, Any]:
    rotation = T_link_inertial[:3, :3]
    turned = rotation @ np.array(inertia, dtype=float) @ rotation.T
    six = (turned[row, column] for row, column in ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)))
    return {"mass": mass, "com": _row(T_link_inertial[:3, 3]), "inertia": _row(list(six))}


def _row(values: Any) -> list[float]:
    """Return numbers to 15 digits, without what is left of a rotation by a right angle."""
    return [float(f"{value:.15g}") if abs(value) > 1e-16 else 0.0 for value in values]


def _rpy(rotation: Matrix) -> list[float]:
    """Return the angles about fixed axes, of which URDF makes Rz·Ry·Rx."""
    cosine = math.hypot(rotation[0, 0], rotation[1, 0])
    pitch = math.atan2(-rotation[2, 0], cosine)
    if cosine < 1e-12:  # roll and yaw turn about the same axis
        return [math.atan2(-rotation[1, 2], rotation[1, 1]), pitch, 0.0]
    roll = math.atan2(rotation[2, 1], rotation[2, 2])
    return [roll, pitch, math.atan2(rotation[1, 0], rotation[0, 0])]


def _of_rpy(rpy: Any) -> Matrix:
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return np.array(about_z @ about_y @ about_x)


def _about(axis: Any, angle: float) -> Matrix:
    """Return the rotation by an angle in radians about a unit axis."""
    return _of_quaternion([np.cos(angle / 2), *(np.sin(angle / 2) * np.asarray(axis))])


def _of_quaternion(wxyz: Any) -> Matrix:
    w, x, y, z = np.array(wxyz) / np.linalg.norm(wxyz)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


# --- differences ------------------------------------------------------------------------------


def differences(there: Record, here: Record) -> dict[str, dict[str, Any]]:
    """Return what differs between two records: by its path, the values there and here."""
    found: dict[str, dict[str, Any]] = {}
    named = {joint["child"]: name for name, joint in here["joints"].items()}
    for kind in ("joints", "links"):
        pairs = {name: name for name in {**there[kind], **here[kind]}}
        for name, joint in there["joints"].items() if kind == "joints" else ():
            other = named.get(joint["child"], name)
            if name not in here[kind] and other not in there[kind] and other != name:
                found[f"{kind}/{name}/name"] = {"there": name, "here": other}
                pairs[name] = other
                del pairs[other]
        for name, other in pairs.items():
            theirs, mine = there[kind].get(name), here[kind].get(other)
            if mine is None or theirs is None:
                side = "here" if mine is None else "there"
                found[f"{kind}/{name}"] = {side: MISSING}
                continue
            for key in {**theirs, **mine}:
                values = theirs.get(key), mine.get(key)
                if not is_same(key, *values):
                    found[f"{kind}/{name}/{key}"] = {"there": values[0], "here": values[1]}
    return found


def is_same(key: str, one: Any, other: Any) -> bool:
    """Tell whether two values are the same, as far as numbers can be."""
    if one is None or other is None or isinstance(one, str):
        return bool(one == other)
    if key == "mimic":
        return bool(one[0] == other[0] and is_same("", one[1:], other[1:]))
    first, second = np.atleast_1d(one).astype(float), np.atleast_1d(other).astype(float)
    if key == "rpy":
        return bool(abs(_of_rpy(first) - _of_rpy(second)).max() <= POSE)
    if key == "inertia":
        return bool(abs(first - second).max() <= TOLERANCE * max(abs(first).max(), 1e-12))
    within = POSE if key in ("xyz", "axis") else TOLERANCE
    return bool((abs(first - second) <= within * np.maximum(1, abs(first))).all())


def are_same(path: str, one: Mapping[str, Any], other: Mapping[str, Any]) -> bool:
    """Tell whether two differences of a value are the same on both sides."""
    key = path.split("/")[-1]
    return one.keys() == other.keys() and all(is_same(key, one[side], other[side]) for side in one)


def listed(name: str, vendor: Path) -> dict[str, dict[str, Any]]:
    """Return the differences that a robot lists with a reason, of one of the vendor's models."""
    record = json.loads(vendor.read_text(encoding="utf-8"))
    path = ROBOTS / name / "differences.yaml"
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    found: dict[str, dict[str, Any]] = {}
    for reason in yaml.load(text, _Loader) or []:
        assert set(reason) <= {"why", "values", "of"} and len(reason["why"]) > 10, reason
        if model_of(vendor) not in reason.get("of", [model_of(vendor)]):
            continue
        for place, sides in reason["values"].items():
            kind, owner = place.split("/")[:2]
            if "of" not in reason and owner not in record[kind] and MISSING not in sides.values():
                continue  # of another model
            assert place not in found, f"{place} is listed twice"
            found[place] = sides
    return found


class _Loader(yaml.SafeLoader):
    """Reads `1e-05`, which YAML 1.1 takes for a text, as a number."""


_Loader.add_implicit_resolver(
    "tag:yaml.org,2002:float", re.compile(r"[-+]?\d+(\.\d*)?[eE][-+]?\d+$"), list("-+0123456789")
)


def patched(record: Record, changes: Mapping[str, Mapping[str, Any]], ours: Record) -> Record:
    """Return what a vendor says, with the listed values of ours in place of its own.

    A link that only ours has is taken over, with its joint, where it is a listed parent.
    """
    made: Record = json.loads(json.dumps(record))
    for joint, values in ours["joints"].items():
        if any(
            path.endswith("/parent") and sides["here"] == values["child"]
            for path, sides in changes.items()
        ):
            made["joints"].setdefault(joint, values)
            made["links"].setdefault(values["child"], {})
    renamed = {}
    for path, sides in changes.items():
        kind, name, *key = path.split("/")
        if not key:
            if sides.get("here") == MISSING:
                del made[kind][name]
        elif key[0] == "name":
            renamed[name] = sides["here"]
        elif sides.get("here") is None:
            del made[kind][name][key[0]]
        else:
            made[kind][name][key[0]] = sides["here"]
    for name, other in renamed.items():
        made["joints"][other] = made["joints"].pop(name)
    return made


# --- positions --------------------------------------------------------------------------------


def urdf_of(record: Record) -> str:
    """Return a URDF of a record, for pinocchio to read as it reads any other."""
    lines = ['<robot name="record">', *(f"<link name={quoteattr(n)}/>" for n in record["links"])]
    for name, joint in record["joints"].items():
        kind = joint["type"]
        lines += [
            f'<joint name={quoteattr(name)} type="{kind}">',
            f"<parent link={quoteattr(joint['parent'])}/><child link={quoteattr(joint['child'])}/>",
            f'<origin xyz="{_text(joint["xyz"])}" rpy="{_text(joint["rpy"])}"/>',
        ]
        if "axis" in joint:
            lines.append(f'<axis xyz="{_text(joint["axis"])}"/>')
        if kind in ("revolute", "prismatic"):
            low, high = joint.get("lower", 0.0), joint.get("upper", 0.0)
            lines.append(f'<limit lower="{low!r}" upper="{high!r}" effort="1" velocity="1"/>')
        lines.append("</joint>")
    return "\n".join([*lines, "</robot>"])


def _text(values: Any) -> str:
    return " ".join(map(repr, values))


class Placing:
    """Where pinocchio puts the links of a robot."""

    def __init__(self, urdf: str) -> None:
        import pinocchio

        self._pinocchio = pinocchio
        self._model = pinocchio.buildModelFromXML(urdf)
        self._data = self._model.createData()
        frames = enumerate(self._model.frames)
        self._links = [(i, frame.name) for i, frame in frames if frame.type == pinocchio.BODY]

    def __call__(self, positions: Mapping[str, float]) -> dict[str, Matrix]:
        """Return the pose of each link in the root link, as a 4×4 matrix.

        Args:
            positions: those of the joints, rad or m; joints that are not there are at 0.
        """
        model, q = self._model, self._pinocchio.neutral(self._model)
        for joint, name in zip(model.joints, model.names, strict=True):
            value = positions.get(name, 0.0)
            if joint.nq == 1:
                q[joint.idx_q] = value
            elif joint.nq == 2:  # a continuous one
                q[joint.idx_q : joint.idx_q + 2] = math.cos(value), math.sin(value)
        self._pinocchio.framesForwardKinematics(model, self._data, q)
        return {name: np.array(self._data.oMf[i].homogeneous) for i, name in self._links}


def random_positions(record: Record, count: int) -> Iterator[dict[str, float]]:
    """Give positions of the joints of a record, within their limits."""
    random = np.random.default_rng(7)
    for _ in range(count):
        yield {
            name: float(random.uniform(joint.get("lower", -math.pi), joint.get("upper", math.pi)))
            for name, joint in record["joints"].items()
            if joint["type"] in ("revolute", "continuous", "prismatic")
        }
