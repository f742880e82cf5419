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
WHOLE = {"transmission", "ros2_control", "actuated", "plugin"}
"""What is told of by a place somewhere in it."""
GAZEBO = {
    "mu1": "mu", "selfCollide": "self_collide", "turnGravityOff": "gravity", "maxVel": "max_vel",
    "minDepth": "min_depth", "maxContacts": "max_contacts", "laserRetro": "laser_retro",
    "implicitSpringDamper": "implicit_spring_damper", "cfmDamping": "cfm_damping",
    "fudgeFactor": "fudge_factor", "provideFeedback": "provide_feedback",
}  # fmt: skip
"""What the converter of libsdformat makes of Gazebo's elements in a URDF."""
SURFACE = {"mu", "mu2", "kp", "kd", "max_vel", "min_depth", "max_contacts", "fdir1", "laser_retro"}
SENSORS = {
    "gazebo_ros_ft_sensor", "gazebo_ros_imu", "hector_gazebo_ros_imu", "hector_gazebo_ros_gps",
    "hector_gazebo_ros_magnetic",
}  # fmt: skip
"""The plugins that are sensors."""
SAID_ONCE = {*GAZEBO.values(), "mu2", "kp", "kd", "fdir1", "gravity", "kinematic"}
"""What counts once for a link or joint, as it is said last."""
UNLIMITED = 1e15
LIMITS = ("effort", "velocity", "acceleration", "deceleration", "jerk")
FOR_LUMPING = {
    "preserveFixedJoint", "disableFixedJointLumping", "disableJointLumping",
}  # fmt: skip
"""What is only about how Gazebo reads URDF."""


INTERFACES = {
    "PositionJointInterface": "position", "VelocityJointInterface": "velocity",
    "EffortJointInterface": "effort",
}  # fmt: skip
"""The interfaces of ros_control that command a joint. Source: joint_command_interface.h."""


class Node:
    """An element with its place."""

    def __init__(
        self, name: str, attributes: dict[str, str], place: int, around: Node | None, tag: str
    ) -> None:
        self.tag = tag
        self.name = name
        self.attributes = attributes
        self.place = place
        self.around = around
        self.children: list[Node] = []
        self.alike: list[Node] = []  # what was said before, and counts no more
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
            found |= {node.place, node.text_place, *(each.place for each in node.alike)}
            found |= {each.text_place for each in node.alike}
            node = node.around
        return frozenset(found)

    @property
    def text_place(self) -> int:
        """Return the offset of the text in it."""
        spaces = len(self.text) - len(self.text.lstrip())
        return self.place + len(self.tag) + 1 + spaces

    def value_place(self, name: str) -> frozenset[int]:
        """Return the offset of an attribute's value."""
        match = re.search(rf"\b{name}\s*=\s*['\"]", self.tag)
        return frozenset((self.place + match.end(),)) if match is not None else frozenset()

    def inner(self) -> frozenset[int]:
        """Return the offsets of all elements in the element."""
        found: set[int] = set()
        for child in self.children:
            found |= {child.place, child.text_place} | child.inner()
        return frozenset(found)


def tree(text: str) -> Node:
    """Return the root of a document."""
    data = text.encode()
    parser = expat.ParserCreate("utf-8")
    stack: list[Node] = []
    roots: list[Node] = []

    def start(name: str, attributes: dict[str, str]) -> None:
        place = len(data[: parser.CurrentByteIndex].decode()) + 1  # that of the name
        tag = text[place : text.index(">", place)]
        node = Node(name, attributes, place, stack[-1] if stack else None, tag)
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
        Feature(key, node.places() | _more_places(key, node))
        for key, node in _features(root, has_meshes=has_meshes)
        if has_meshes or key[1] != "mesh"
    ]
    known: set[str] = set()
    for feature in list(found):  # a material of several shapes counts once
        if feature.key[0] == "material":
            name = str(feature.key[2])
            if name in known:
                found.remove(feature)
            known.add(name)
    return found + list(_attributes(root, text))


def _more_places(key: Key, node: Node) -> frozenset[int]:
    """Return the offsets in an element at which something may be said of a feature."""
    if key[0] == "material" or key[:2] == ("optional", "material"):
        own = node.first("texture")
        inner = own.value_place("filename") if own is not None else frozenset()
        return node.inner() | node.value_place("name") | inner
    if key[0] in WHOLE:
        return node.inner()
    if key[0] == "texture":
        return node.value_place("filename")
    if key[0] == "gazebo":
        return node.value_place("value")
    if key[0] == "range":
        return node.value_place("lower") | node.value_place("upper")
    return node.value_place(str(key[0])) if node.name in ("limit", "dynamics") else frozenset()


def _features(root: Node, *, has_meshes: bool) -> Iterator[tuple[Key, Node]]:
    materials = _materials(root)
    links: set[str] = set()
    joints: set[str] = set()
    actuated: set[str] = set()
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
            yield from _link(node, materials, is_painted=name in painted)
        elif node.name == "joint" and name not in joints:
            joints.add(name)
            yield from _joint(node, massive, every)
        elif node.name == "ros2_control":
            yield ("ros2_control", name), node
        elif node.name not in CHILDREN["robot"]:
            yield ("element", node.name), node
    for kind in ("ros2_control", "transmission"):  # the first one wins
        for node in root.children:
            if node.name == kind:
                yield from _actuated(node, actuated)
    yield from _gazebo(root, has_meshes=has_meshes)


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


def _link(
    link: Node, materials: dict[str, Node], *, is_painted: bool
) -> Iterator[tuple[Key, Node]]:
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
            yield from _shape(node, materials, is_painted=is_painted)
    yield from _unknown(link)


def _mass(link: Node) -> Node | None:
    inertial = link.first("inertial")
    mass = inertial.first("mass") if inertial is not None else None
    return mass if mass is not None and (mass.number("value") or 0.0) > 0 else None


def _shape(
    node: Node, materials: dict[str, Node], *, is_painted: bool
) -> Iterator[tuple[Key, Node]]:
    geometry = node.first("geometry")
    shape = (
        next((each for each in geometry.children if each.name in SHAPES), None)
        if geometry
        else None
    )
    if shape is None:
        return
    yield (node.name, shape.name, *_sizes(shape)), shape
    has_volume = all(isinstance(each, float) and each > 0 for each in _sizes(shape))
    if node.get("name") and has_volume:
        yield ("shape name", node.get("name")), node
    material = node.first("material")
    if node.name != "visual" or material is None:
        return
    meant = materials.get(material.get("name"), material)
    if is_painted:  # by Gazebo, in SDFormat
        yield ("optional", "material"), meant
        return
    color, texture = meant.first("color"), meant.first("texture")
    is_mesh = "mesh" if shape.name == "mesh" else "shape"
    if (
        meant.get("name")
        and (has_volume or is_mesh == "mesh")
        and (color is not None or texture is not None)
    ):
        yield ("material", is_mesh, meant.get("name")), meant
    if color is not None and len(color.get("rgba").split()) == 4:
        yield ("color", is_mesh, *map(float, color.get("rgba").split())), material
    if texture is not None:
        yield ("texture", is_mesh, texture.get("filename").rpartition("/")[2]), texture


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
    ends = [
        each.get("link") for name in ("parent", "child") for each in [joint.first(name)] if each
    ]
    # A fixed link without mass is a frame.
    if kind != "fixed" or not links.issuperset(ends):
        yield ("joint", name, kind), joint
    elif massive.issuperset(ends):
        yield ("fixed", ends[-1]), joint
    limit = joint.first("limit")
    dynamics = joint.first("dynamics")
    if kind not in ("revolute", "continuous", "prismatic"):
        for part, node in (("limit", limit), ("dynamics", dynamics)):
            if node is not None and any(map(node.number, node.attributes)):
                yield (part, name), node
        limit = dynamics = None
    if limit is not None:
        if kind in ("revolute", "prismatic"):
            lower, upper = limit.number("lower") or 0.0, limit.number("upper") or 0.0
            if lower > -UNLIMITED or upper < UNLIMITED:
                yield ("range", name, lower, upper), limit
        for each in LIMITS:
            value = limit.number(each)
            if value is not None and value < UNLIMITED:
                yield (each, name, value), limit
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


def _actuated(node: Node, known: set[str]) -> Iterator[tuple[Key, Node]]:
    """Yield the joints that something drives, each once; a transmission without any by itself."""
    before = len(known)
    for joint in (each for each in node.children if each.name == "joint"):
        name = joint.get("name")
        if name not in known:
            yield from _commands(node, joint)
        is_driven = node.name == "transmission" or joint.first("command_interface") is not None
        if is_driven and name not in known:
            known.add(name)
            yield ("actuated", name), node if node.name == "transmission" else joint
    if node.name == "transmission" and len(known) == before:
        yield ("transmission", node.get("name")), node


def _commands(owner: Node, joint: Node) -> Iterator[tuple[Key, Node]]:
    """Yield what is commanded of a joint; older transmissions say it in their actuators."""
    name = joint.get("name")
    if owner.name == "ros2_control":
        for each in joint.children:
            if each.name == "command_interface":
                yield ("command", name, each.get("name")), each
        return
    actuators = [each for each in owner.children if each.name == "actuator"]
    found = [
        [each for each in place.children if each.name == "hardwareInterface"]
        for place in (joint, *actuators)
    ]
    commands = dict.fromkeys(
        INTERFACES.get(each.text.strip().rpartition("/")[2])
        for each in next((each for each in found if each), ())
    )
    yield from ((("command", name, each), joint) for each in commands if each)


def _in_shape(node: Node) -> Iterator[tuple[Key, Node]]:
    for child in node.children:
        if child.name == "plugin":
            yield ("plugin", child.get("filename")), child
        else:
            yield ("in shape", child.name), child
            yield from _in_shape(child)


def _details(sensor: Node) -> Iterator[tuple[Key, Node]]:
    """Yield what a sensor says; its noise, which it may say for each axis, once."""
    noise: list[Node] = []
    for key, node in _in_sensor(sensor, sensor.get("name")):
        if key[0] == "in sensor" and key[2] in ("stddev", "type", "mean"):
            noise.append(node)
            if key[2] == "mean" and float(node.text):
                yield key, node
        else:
            yield key, node
    if any(node.name == "stddev" and node.text.strip() not in ("0", "0.0") for node in noise):
        noise[0].alike = noise[1:]
        yield ("in sensor", sensor.get("name"), "stddev"), noise[0]


def _in_sensor(node: Node, sensor: str) -> Iterator[tuple[Key, Node]]:
    for child in node.children:
        if child.name == "plugin":
            yield ("plugin", child.get("filename")), child
        elif child.children:
            yield from _in_sensor(child, sensor)
        elif child.text.strip() == "__default_topic__":
            continue
        else:
            yield ("in sensor", sensor, child.name), child


def _gazebo(root: Node, *, has_meshes: bool) -> Iterator[tuple[Key, Node]]:
    """Yield what is for Gazebo; what is said twice of a link or joint counts once, as it does."""
    last: dict[tuple[str, str], tuple[Key, Node]] = {}
    replaced: dict[str, set[object]] = {}  # by what is given for the shapes of a link
    shapeless = set() if has_meshes else _links_of_meshes(root)
    for gazebo in root.children:
        reference = gazebo.get("reference")
        for child in gazebo.children if gazebo.name == "gazebo" else ():
            if child.name in FOR_LUMPING:
                continue
            if child.name == "plugin":
                library = child.get("filename").rpartition("/")[2].removeprefix("lib")
                is_sensor = library.removesuffix(".so") in SENSORS
                name = child.get("name" if is_sensor else "filename")
                yield ("sensor" if is_sensor else "plugin", name), child
                if is_sensor:
                    yield from ((("optional", each.name), each) for each in child.children)
            elif child.name == "sensor":
                yield ("sensor", child.get("name")), child
                yield from _details(child)
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
                if name in SURFACE and reference in shapeless:
                    yield ("optional", name), child
                elif name in SAID_ONCE:
                    before = last.get((reference, name))
                    child.alike = [] if before is None else [before[1], *before[1].alike]
                    last[reference, name] = (("gazebo", name, value), child)
                else:
                    yield ("gazebo", name, value), child
    for (reference, name), found in last.items():
        if name not in replaced.get(reference, ()):
            yield found


def _links_of_meshes(root: Node) -> set[str]:
    """Return the links of which all collisions are meshes."""
    found = set()
    for link in root.children:
        shapes = [
            shape.name
            for collision in link.children
            if link.name == "link" and collision.name == "collision"
            for geometry in collision.children
            for shape in geometry.children
            if shape.name in SHAPES
        ]
        if shapes and set(shapes) == {"mesh"}:
            found.add(link.get("name"))
    return found
