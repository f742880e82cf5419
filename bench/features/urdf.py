"""The features of a URDF, with their places. Source: http://wiki.ros.org/urdf/XML."""

from __future__ import annotations

import re
from collections.abc import Iterator
from xml.parsers import expat

from .feature import Feature, Key, negated, plain

SHAPES = {"box", "cylinder", "sphere", "capsule", "mesh"}
CHILDREN = {
    "robot": {"link", "joint", "material", "gazebo", "transmission", "ros2_control"},
    "link": {"inertial", "visual", "collision"},
    "joint": {"origin", "parent", "child", "axis", "calibration", "dynamics", "limit", "mimic",
              "safety_controller"},
    "visual": {"origin", "geometry", "material"},
    "collision": {"origin", "geometry"},
    "inertial": {"origin", "mass", "inertia"},
    "geometry": SHAPES,
    "material": {"color", "texture"},
}  # fmt: skip
ATTRIBUTES = {
    "link": "name type", "joint": "name type", "visual": "name", "collision": "name",
    "inertial": "", "mass": "value", "inertia": "ixx ixy ixz iyy iyz izz",
    "origin": "xyz rpy quat_xyzw", "geometry": "", "box": "size", "sphere": "radius",
    "cylinder": "radius length", "capsule": "radius length", "mesh": "filename scale",
    "material": "name", "color": "rgba", "texture": "filename", "parent": "link",
    "child": "link", "axis": "xyz", "calibration": "rising falling reference_position",
    "dynamics": "damping friction",
    "limit": "lower upper effort velocity acceleration deceleration jerk",
    "mimic": "joint multiplier offset",
    "safety_controller": "soft_lower_limit soft_upper_limit k_position k_velocity",
}  # fmt: skip
WHOLE = {"transmission", "ros2_control", "ros2_control joint", "ros2_control sensor"}
"""What is told of by a place somewhere in it."""
GAZEBO = {
    "mu1": "mu", "selfCollide": "self_collide", "turnGravityOff": "gravity", "maxVel": "max_vel",
    "minDepth": "min_depth", "maxContacts": "max_contacts", "laserRetro": "laser_retro",
    "implicitSpringDamper": "implicit_spring_damper", "cfmDamping": "cfm_damping",
    "fudgeFactor": "fudge_factor", "provideFeedback": "provide_feedback",
}  # fmt: skip
"""What the converter of libsdformat makes of Gazebo's elements in a URDF."""
SAID_ONCE = {*GAZEBO.values(), "mu2", "kp", "kd", "fdir1", "gravity", "kinematic"}
"""What counts once for a link or joint, as it is said last."""
LIMITS = ("effort", "velocity", "acceleration", "deceleration", "jerk")
FOR_LUMPING = {
    "preserveFixedJoint", "disableFixedJointLumping", "disableJointLumping",
}  # fmt: skip
"""What is only about how Gazebo reads URDF."""


class Node:
    """An element with its place."""

    def __init__(self, name: str, attributes: dict[str, str], place: int, around: Node | None):
        self.name = name
        self.attributes = attributes
        self.place = place
        self.around = around
        self.children: list[Node] = []
        self.text = ""

    def first(self, name: str) -> Node | None:
        return next((each for each in self.children if each.name == name), None)

    def get(self, name: str, default: str = "") -> str:
        return self.attributes.get(name, default)

    def number(self, name: str) -> float | None:
        try:
            return float(self.attributes[name])
        except (KeyError, ValueError):
            return None

    def places(self) -> frozenset[int]:
        """Return the offsets of the element and of those around it, but not of the root."""
        found, node = set(), self
        while node.around is not None:
            found.add(node.place)
            node = node.around
        return frozenset(found)

    def inner(self) -> frozenset[int]:
        """Return the offsets of all elements in the element."""
        found: set[int] = set()
        for child in self.children:
            found |= {child.place} | child.inner()
        return frozenset(found)


def tree(text: str) -> Node:
    """Return the root of a document."""
    data = text.encode()
    parser = expat.ParserCreate("utf-8")
    stack: list[Node] = []
    roots: list[Node] = []

    def start(name: str, attributes: dict[str, str]) -> None:
        place = len(data[: parser.CurrentByteIndex].decode()) + 1  # that of the name
        node = Node(name, attributes, place, stack[-1] if stack else None)
        (stack[-1].children if stack else roots).append(node)
        stack.append(node)

    def data_of(content: str) -> None:
        stack[-1].text += content

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda name: stack.pop()
    parser.CharacterDataHandler = data_of
    parser.Parse(data, True)
    return roots[0]


def is_xacro(text: str) -> bool:
    """Return whether a file that is called a URDF is a xacro file."""
    pending = [tree(text)]
    for node in pending:
        if node.name.startswith("xacro:") or any("${" in each for each in node.attributes.values()):
            return True
        pending += node.children
    return False


def read(text: str, *, has_meshes: bool) -> list[Feature]:
    """Return the features of a URDF."""
    root = tree(text)
    found = [
        Feature(key, node.places() | (node.inner() if key[0] in WHOLE else frozenset()))
        for key, node in _features(root)
        if has_meshes or key[1] != "mesh"
    ]
    return found + list(_attributes(root, text))


def _features(root: Node) -> Iterator[tuple[Key, Node]]:
    materials = _materials(root)
    links: set[str] = set()
    joints: set[str] = set()
    every = {each.get("name") for each in root.children if each.name == "link"}
    painted = {
        each.get("reference")
        for each in root.children
        if each.name == "gazebo"
        for blob in each.children
        if blob.name == "visual" and blob.first("material") is not None
    }
    massive = {each.get("name") for each in root.children if each.name == "link" and _mass(each)}
    for node in root.children:
        name = node.get("name")
        if node.name == "link" and name not in links:
            links.add(name)
            yield from _link(node, {} if name in painted else materials)
        elif node.name == "joint" and name not in joints:
            joints.add(name)
            yield from _joint(node, massive, every)
        elif node.name == "ros2_control":
            yield ("ros2_control", name), node
            for each in node.children:
                if each.name in ("joint", "sensor"):
                    yield (f"ros2_control {each.name}", each.get("name")), each
        elif node.name == "transmission":
            yield ("transmission", name), node
        elif node.name not in CHILDREN["robot"]:
            yield ("element", node.name), node
    yield from _gazebo(root)


def _attributes(root: Node, text: str) -> Iterator[Feature]:
    """Yield the attributes that URDF does not have."""
    pending = [child for child in root.children if child.name in ("link", "joint", "material")]
    for node in pending:
        pending += [child for child in node.children if child.name in CHILDREN.get(node.name, ())]
        tag = text[node.place : text.index(">", node.place)]
        for name in node.attributes:
            if name not in ATTRIBUTES[node.name].split():
                match = re.search(rf"\s({re.escape(name)})\s*=", tag)
                assert match is not None
                yield Feature(
                    ("attribute", node.name, name),
                    node.places() | {node.place + match.start(1)},
                )


def _materials(root: Node) -> dict[str, Node]:
    found: dict[str, Node] = {}
    inner = [
        each
        for link in root.children
        if link.name == "link"
        for visual in link.children
        if visual.name == "visual"
        for each in visual.children
        if each.name == "material"
    ]
    for node in [*(each for each in root.children if each.name == "material"), *inner]:
        if node.get("name") and any(each.name in ("color", "texture") for each in node.children):
            found.setdefault(node.get("name"), node)
    return found


def _link(link: Node, materials: dict[str, Node]) -> Iterator[tuple[Key, Node]]:
    name = link.get("name")
    yield ("link", name), link
    mass = _mass(link)
    if mass is not None:
        yield ("mass", name, mass.number("value")), mass
    else:
        inertial = link.first("inertial")
        inertia = inertial.first("inertia") if inertial is not None else None
        if inertia is not None and any(map(inertia.number, inertia.attributes)):
            yield ("inertia without mass", name), inertia
    for node in link.children:
        if node.name in ("visual", "collision"):
            yield from _shape(node, materials)
    yield from _unknown(link)


def _mass(link: Node) -> Node | None:
    inertial = link.first("inertial")
    mass = inertial.first("mass") if inertial is not None else None
    return mass if mass is not None and (mass.number("value") or 0.0) > 0 else None


def _shape(node: Node, materials: dict[str, Node]) -> Iterator[tuple[Key, Node]]:
    geometry = node.first("geometry")
    shape = (
        next((each for each in geometry.children if each.name in SHAPES), None)
        if geometry
        else None
    )
    if shape is None:
        return
    yield (node.name, shape.name, *_sizes(shape)), shape
    material = node.first("material")
    if node.name != "visual" or material is None:
        return
    if not materials:
        return
    meant = materials.get(material.get("name"), material)
    color, texture = meant.first("color"), meant.first("texture")
    is_mesh = "mesh" if shape.name == "mesh" else "shape"
    if color is not None and len(color.get("rgba").split()) == 4:
        yield ("color", is_mesh, *map(float, color.get("rgba").split())), material
    if texture is not None:
        yield ("texture", is_mesh, texture.get("filename").rpartition("/")[2]), material


def _sizes(shape: Node) -> tuple[object, ...]:
    if shape.name == "box":
        return tuple(map(float, shape.get("size").split()))
    if shape.name == "mesh":
        scale = tuple(map(float, shape.get("scale", "1 1 1").split()))
        return (shape.get("filename").rpartition("/")[2], *scale)
    radius, length = shape.number("radius"), shape.number("length")
    return (radius,) if shape.name == "sphere" else (radius, length)


def _joint(joint: Node, massive: set[str], links: set[str]) -> Iterator[tuple[Key, Node]]:
    name, kind = joint.get("name"), joint.get("type")
    ends = [each.get("link") for each in joint.children if each.name in ("parent", "child")]
    # A fixed link without mass is a frame.
    if kind != "fixed" or massive.issuperset(ends) or not links.issuperset(ends):
        yield ("joint", name, kind), joint
    limit = joint.first("limit")
    if limit is not None:
        if kind in ("revolute", "prismatic"):
            yield ("range", name, limit.number("lower") or 0.0, limit.number("upper") or 0.0), limit
        for each in LIMITS:
            value = limit.number(each)
            if value is not None:
                yield (each, name, value), limit
    dynamics = joint.first("dynamics")
    if dynamics is not None and kind not in ("revolute", "continuous", "prismatic"):
        yield ("dynamics", name), dynamics
    for each in ("damping", "friction"):
        if dynamics is not None and dynamics.number(each):
            yield (each, name, dynamics.number(each)), dynamics
    mimic = joint.first("mimic")
    if mimic is not None:
        multiplier, offset = mimic.number("multiplier"), mimic.number("offset")
        factor = 1.0 if multiplier is None else multiplier
        yield ("mimic", name, mimic.get("joint"), factor, offset or 0.0), mimic
    for each in ("safety_controller", "calibration"):
        node = joint.first(each)
        if node is not None:
            yield (each, name), node
    yield from _unknown(joint)


def _unknown(owner: Node) -> Iterator[tuple[Key, Node]]:
    """Yield the elements that URDF does not have."""
    for child in owner.children:
        if child.name in CHILDREN.get(owner.name, ()):
            yield from _unknown(child)
        else:
            yield ("element", child.name), child


def _in_shape(node: Node) -> Iterator[tuple[Key, Node]]:
    for child in node.children:
        if child.name == "plugin":
            yield ("plugin", child.get("filename")), child
        else:
            yield ("in shape", child.name), child
            yield from _in_shape(child)


def _in_sensor(node: Node, sensor: str) -> Iterator[tuple[Key, Node]]:
    for child in node.children:
        if child.name == "plugin":
            yield ("plugin", child.get("filename")), child
        else:
            yield ("in sensor", sensor, child.name), child
            yield from _in_sensor(child, sensor)


def _gazebo(root: Node) -> Iterator[tuple[Key, Node]]:
    """Yield what is for Gazebo; what is said twice of a link or joint counts once, as it does."""
    last: dict[tuple[str, str], tuple[Key, Node]] = {}
    replaced: dict[str, set[object]] = {}  # by what is given for the shapes of a link
    for gazebo in root.children:
        reference = gazebo.get("reference")
        for child in gazebo.children if gazebo.name == "gazebo" else ():
            if child.name in FOR_LUMPING:
                continue
            if child.name == "plugin":
                yield ("plugin", child.get("filename")), child
            elif child.name == "sensor":
                yield ("sensor", child.get("name")), child
                yield from _in_sensor(child, child.get("name"))
            elif child.name in ("visual", "collision"):
                inner = list(_in_shape(child))
                replaced.setdefault(reference, set()).update(key[1] for key, _ in inner)
                yield from inner
            elif child.children:
                yield ("gazebo", child.name, ""), child
            else:
                name = GAZEBO.get(child.name, child.name)
                text = (child.text.strip() or child.get("value")).lower()
                value = negated(text) if child.name == "turnGravityOff" else plain(text)
                if name in SAID_ONCE:
                    last[reference, name] = (("gazebo", name, value), child)
                else:
                    yield ("gazebo", name, value), child
    for (reference, name), found in last.items():
        if name not in replaced.get(reference, ()):
            yield found
