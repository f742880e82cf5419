"""The robot of a scene: links, joints, shapes and materials, read from a finished tree.

Reading is as lenient as it can be, since a robot is looked at while it is being written: what is
missing or no number takes its default, and the check tells of it.
"""

from __future__ import annotations

from math import pi

from ...check.context import attribute_text, child_named
from ...model.rotations import ZERO, rotation_from_rpy
from .transforms import IDENTITY, X_AXIS, Transform, rotation_from_quaternion, unit_vector

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

    from ...files.mesh_files import MeshFinder
    from ...model.rotations import Vector
    from ...xml.tree import Element

Color = tuple[float, float, float, float]

BOX, CYLINDER, SPHERE, CAPSULE, MESH = "box", "cylinder", "sphere", "capsule", "mesh"
SHAPES = (BOX, CYLINDER, SPHERE, CAPSULE, MESH)
REVOLUTE, CONTINUOUS, PRISMATIC, FIXED = "revolute", "continuous", "prismatic", "fixed"
MOVING = (REVOLUTE, CONTINUOUS, PRISMATIC)
"""The types of joints that have one position; planar and floating ones stay at their origins."""

LARGEST = 1e9
"""The largest number that is taken for a measure: beyond it, sums of squares overflow."""


class Shape:
    """One shape of a link.

    Attributes:
        kind: BOX, CYLINDER, SPHERE, CAPSULE or MESH.
        size: of a box its three edges, of a sphere its radius, of a cylinder or capsule radius and
            length, in metres; of a mesh its three scales.
        pose: T_link_shape.
        color: red, green, blue, alpha from 0 to 1, or None where none is given.
        filename: of a mesh, its file as written.
        path: of a mesh, its file, or None if that is not found.
        is_visual: whether it is seen, and not for collisions.
        element: the `<visual>` or `<collision>` it was read from, with its place.
        geometry: the element of the shape in it.
    """

    __slots__ = (
        "color", "element", "filename", "geometry", "is_visual", "kind", "path", "pose", "size",
    )  # fmt: skip

    def __init__(self, element: Element, geometry: Element) -> None:
        """Begin with what the elements say; the colour and the path are found afterwards."""
        self.element = element
        self.geometry = geometry
        self.is_visual = element.name == "visual"
        self.kind = geometry.name
        self.size = _size_of(geometry)
        self.pose = read_origin(element)
        self.color: Color | None = None
        self.filename = attribute_text(geometry, "filename") or ""
        self.path: str | None = None

    def is_shown(self, shows: Collection[str]) -> bool:
        """Tell whether it is one of what is shown: visual or collision shapes."""
        return self.element.name in shows


class Inertial:
    """The mass of a link.

    Attributes:
        mass: in kg.
        pose: T_link_inertial; its origin is the centre of mass.
        moments: ixx, ixy, ixz, iyy, iyz, izz about the centre of mass, in kg·m².
        element: the `<inertial>` it was read from.
    """

    __slots__ = ("element", "mass", "moments", "pose")

    def __init__(self, element: Element) -> None:
        """Read an `<inertial>`."""
        inertia = child_named(element, "inertia")
        names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        self.element = element
        self.mass = read_number(child_named(element, "mass"), "value")
        self.pose = read_origin(element)
        self.moments = tuple(read_number(inertia, name) for name in names)


class Link:
    """A link: its name, shapes in order, mass, and element."""

    __slots__ = ("element", "inertial", "name", "shapes")

    def __init__(self, element: Element) -> None:
        """Read a `<link>`."""
        inertial = child_named(element, "inertial")
        self.element = element
        self.name = attribute_text(element, "name") or ""
        self.inertial = Inertial(inertial) if inertial is not None else None
        self.shapes = list(_shapes_of(element))


class Joint:
    """A joint.

    Attributes:
        kind: its type, as URDF calls it.
        parent, child: names of links.
        origin: T_parent_joint.
        axis: a unit vector in the joint's frame.
        lower, upper: its limits in radians or metres, None where it has none.
        mimic: name of the joint it follows, or "".
        multiplier, offset: how it follows that.
        element: the `<joint>` it was read from.
    """

    __slots__ = (
        "axis", "child", "element", "kind", "lower", "mimic", "multiplier", "name", "offset",
        "origin", "parent", "upper",
    )  # fmt: skip

    def __init__(self, element: Element) -> None:
        """Read a `<joint>`."""
        limit, mimic = child_named(element, "limit"), child_named(element, "mimic")
        self.element = element
        self.name = attribute_text(element, "name") or ""
        self.kind = attribute_text(element, "type") or FIXED
        self.parent = attribute_text(child_named(element, "parent"), "link") or ""
        self.child = attribute_text(child_named(element, "child"), "link") or ""
        self.origin = read_origin(element)
        self.axis = unit_vector(read_vector(child_named(element, "axis"), "xyz", X_AXIS))
        has_limits = limit is not None and self.kind in (REVOLUTE, PRISMATIC)
        self.lower = read_number(limit, "lower") if has_limits else None
        self.upper = read_number(limit, "upper") if has_limits else None
        self.mimic = attribute_text(mimic, "joint") or ""
        self.multiplier = read_number(mimic, "multiplier", 1.0)
        self.offset = read_number(mimic, "offset")

    @property
    def is_free(self) -> bool:
        """Tell whether it has a position of its own."""
        return self.kind in MOVING and not self.mimic

    @property
    def range(self) -> tuple[float, float]:
        """Return the lowest and highest position to show: its limits, or one turn."""
        if self.lower is None or self.upper is None or self.lower >= self.upper:
            return (-0.5, 0.5) if self.kind == PRISMATIC else (-pi, pi)
        return (self.lower, self.upper)

    @property
    def rest(self) -> float:
        """Return where it stands by itself: at 0, or in the middle of limits that exclude 0.

        That is what ROS's joint_state_publisher does.
        """
        if self.lower is None or self.upper is None or self.lower <= 0 <= self.upper:
            return 0.0
        return (self.lower + self.upper) / 2


class Robot:
    """A robot as a scene. Of links or joints with the same name the first one counts.

    Attributes:
        name: the robot's name.
        links, joints: by name, in order.
        element: the `<robot>`.
    """

    __slots__ = ("element", "joints", "links", "name")

    def __init__(self, root: Element, finder: MeshFinder) -> None:
        """Read a finished `<robot>`.

        Args:
            root: the root of a build.
            finder: finds the meshes; that of the build.

        Raises:
            YamaroError: a mesh lies where it may not be read.
        """
        self.element = root
        self.name = attribute_text(root, "name") or ""
        self.links: dict[str, Link] = {}
        self.joints: dict[str, Joint] = {}
        for element in root.elements():
            if element.name == "link":
                link = Link(element)
                self.links.setdefault(link.name, link)
            elif element.name == "joint":
                joint = Joint(element)
                self.joints.setdefault(joint.name, joint)
        colors = _named_colors(root)
        for shape in self.shapes():
            if shape.is_visual:
                shape.color = _color_of(shape, colors)
            if shape.kind == MESH:
                span = shape.geometry.value_span("filename")
                shape.path = finder.resolve(shape.filename, span) if shape.filename else None

    def shapes(self) -> Iterator[Shape]:
        """Yield the shapes of all links."""
        for link in self.links.values():
            yield from link.shapes

    def free_joints(self) -> list[Joint]:
        """Return the joints that have a position of their own."""
        return [joint for joint in self.joints.values() if joint.is_free]


# --- values -----------------------------------------------------------------------------------


def read_floats(element: Element | None, attribute: str) -> tuple[float, ...]:
    """Return the numbers of an attribute; none if anything in it is no number or too large."""
    try:
        numbers = tuple(map(float, (attribute_text(element, attribute) or "").split()))
    except ValueError:
        return ()
    return numbers if all(abs(number) <= LARGEST for number in numbers) else ()


def read_number(element: Element | None, attribute: str, default: float = 0.0) -> float:
    """Return the number of an attribute, or the default."""
    numbers = read_floats(element, attribute)
    return numbers[0] if numbers else default


def read_vector(element: Element | None, attribute: str, default: Vector = ZERO) -> Vector:
    """Return the three numbers of an attribute, or the default."""
    numbers = read_floats(element, attribute)
    return (numbers[0], numbers[1], numbers[2]) if len(numbers) == 3 else default


def read_origin(element: Element) -> Transform:
    """Return the pose that the `<origin>` in an element gives."""
    origin = child_named(element, "origin")
    if origin is None:
        return IDENTITY
    quaternion = read_floats(origin, "quat_xyzw")
    if len(quaternion) == 4:
        rotation = rotation_from_quaternion(*quaternion)
    else:
        rotation = rotation_from_rpy(*read_vector(origin, "rpy"))
    return Transform(rotation, read_vector(origin, "xyz"))


def _shapes_of(link: Element) -> Iterator[Shape]:
    for element in link.elements():
        if element.name not in ("visual", "collision"):
            continue
        geometry = child_named(element, "geometry")
        for inner in geometry.elements() if geometry is not None else ():
            if inner.name in SHAPES:
                yield Shape(element, inner)
                break


def _size_of(geometry: Element) -> tuple[float, ...]:
    if geometry.name == BOX:
        return read_vector(geometry, "size")
    if geometry.name == MESH:
        return read_vector(geometry, "scale", (1.0, 1.0, 1.0))
    radius = read_number(geometry, "radius")
    if geometry.name == SPHERE:
        return (radius,)
    return (radius, read_number(geometry, "length"))


def _named_colors(root: Element) -> dict[str, Color]:
    """Return the colours of materials by name: the robot's own, then those inside of visuals.

    Of several materials with one name the first one counts, as in urdfdom.
    """
    colors: dict[str, Color] = {}
    own = [element for element in root.elements() if element.name == "material"]
    links = [element for element in root.elements() if element.name == "link"]
    visuals = [visual for link in links for visual in link.elements() if visual.name == "visual"]
    inside = [child_named(visual, "material") for visual in visuals]
    for material in (*own, *inside):
        name = attribute_text(material, "name")
        color = _own_color(material)
        if name and color is not None:
            colors.setdefault(name, color)
    return colors


def _own_color(material: Element | None) -> Color | None:
    color = child_named(material, "color") if material is not None else None
    numbers = [min(max(number, 0.0), 1.0) for number in read_floats(color, "rgba")]
    return (numbers[0], numbers[1], numbers[2], numbers[3]) if len(numbers) == 4 else None


def _color_of(shape: Shape, colors: dict[str, Color]) -> Color | None:
    material = child_named(shape.element, "material")
    named = colors.get(attribute_text(material, "name") or "")
    return named if named is not None else _own_color(material)
