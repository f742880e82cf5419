"""Reads a robot from the elements of a finished `<robot>`, as leniently as it can.

What is missing or cannot be read takes its default, since a robot is looked at while it is being
written. An element that is in several places is read once; what it gives is shared.
"""

from __future__ import annotations

from math import inf, isfinite

from ..diagnostics import WARNING, Diagnostic, failure
from ..xml.tree import Element
from ..xml.values import format_value
from .joint import Calibration, Dynamics, Joint, Limit, Mimic, SafetyController
from .link import Collision, Inertial, Link, Material, Visual
from .pose import (
    IDENTITY,
    UNTURNED,
    X_AXIS,
    ZERO,
    Pose,
    rotation_from_quaternion,
    rotation_from_rpy,
    unit_vector,
)
from .robot import Robot
from .schema import JOINT_TYPES, MOMENTS, joint_type_hint
from .shapes import COUNTS, SHAPE_WORDS, SIMPLE_SHAPES, SIZES, UNSCALED, Mesh
from .values import NumberFault, NumberReader, attribute_text, child_named

TYPE_CHECKING = False
if TYPE_CHECKING:
    import os
    from collections.abc import Sequence
    from typing import Any, TypeVar

    from ..diagnostics import Frame as Step
    from .pose import Vector
    from .shapes import Inertia, Shape

    Part = TypeVar("Part", Limit, Mimic, Dynamics, SafetyController, Calibration)
    Numbers = tuple[float, ...]
    Contents = tuple[Inertial | None, tuple[Visual, ...], tuple[Collision, ...]]

DYNAMICS = "dynamics"
"""A note that is all of what resists a joint, where URDF does not have all of it."""
COUNT_WORDS = {1: "one number", 3: "three numbers", 4: "four numbers"}


def read_file(path: str | os.PathLike[str]) -> Robot:
    """Return the robot of a URDF file; see `Robot.from_urdf`."""
    import os

    from ..files.regular import open_regular
    from ..xml.reader import decode_xml, read_xml

    path = os.fspath(path)
    with open_regular(path) as file:
        data = file.read()
    source = decode_xml(data, name=path, path=os.path.abspath(path))
    return read_robot(read_xml(source).root)


def read_text(text: str, *, name: str) -> Robot:
    """Return the robot of a URDF in a text; see `Robot.from_xml`."""
    from ..source import Source
    from ..xml.reader import read_xml

    return read_robot(read_xml(Source(text, name=name)).root)


def read_robot(
    root: Element,
    *,
    notes: Sequence[Element] = (),
    largest: float = inf,
    numbers: NumberReader | None = None,
    whole: bool = False,
    recognizes: bool = True,
) -> Robot:
    """Return the robot of a finished tree, which must not be changed afterwards.

    Most of a link or joint is read when it is first used, unless `whole` asks for all of it now.

    Args:
        root: a `<robot>` without parts; elements may be in several places of it.
        notes: what else the robot has: such as sensors and states; see `extras.py`.
        largest: numbers beyond it are treated like those that cannot be read.
        numbers: reads numbers, and has read some already; by default a new one.
        whole: whether all of it is read at once.
        recognizes: whether `<gazebo>`, `<ros2_control>` and `<transmission>` are read for what
            the notes do not say, when that is first used.

    Raises:
        YamaroError: `not-urdf`: the root is another element.
    """
    if root.name != "robot":
        raise failure(
            "not-urdf",
            f"this is not a robot: its root is '{root.name}'",
            root.span,
            hint="the root of a URDF is 'robot'",
        )
    reader = _Reader(root, largest, numbers or NumberReader(largest))
    return reader.robot(notes, whole=whole, recognizes=recognizes)


class _Reader:
    """Reads one robot.

    What is read of an element is kept by the identity of the element, and what a link holds by
    that of its list of children: the tree keeps both alive.
    """

    def __init__(self, root: Element, largest: float, numbers: NumberReader) -> None:
        self._root = root
        self._largest = largest
        self._trace: Step | None = None  # of the link, joint or material being read
        self._findings: list[Diagnostic] = []
        self._number_reader = numbers
        self._contents: dict[int, Contents] = {}
        self._origins: dict[int, Pose] = {}
        self._axes: dict[int, Vector] = {}
        self._parts: dict[int, Any] = {}
        self._dynamics: dict[object, Element] = {}  # notes of joints, by name
        self._visuals: dict[int, Visual] = {}
        self._collisions: dict[int, Collision] = {}
        self._link_reader, self._joint_reader = self._read_link, self._read_joint  # bound once

    def robot(
        self, notes: Sequence[Element] = (), *, whole: bool = False, recognizes: bool = True
    ) -> Robot:
        """Return the robot; `whole` reads all of it now."""
        links: list[Link] = []
        joints: list[Joint] = []
        materials: list[Material] = []
        above = self._root.trace_within(None)
        self._dynamics = {each.attributes["joint"]: each for each in notes if each.name == DYNAMICS}
        for element in self._root.children:
            if not isinstance(element, Element):
                continue
            self._trace = element.trace_within(above)
            name = element.name
            if name == "link":
                links.append(self._link(element))
                if whole:
                    self._read_link(links[-1])
            elif name == "joint":
                joints.append(self._joint(element))
                if whole:
                    self._read_joint(joints[-1])
            elif name == "material":
                materials.append(self._material(element))
        return Robot(
            self._root,
            links=links,
            joints=joints,
            materials=materials,
            find=self._find_all,
            notes=notes,
            recognizes=recognizes,
        )

    def _find_all(self) -> list[Diagnostic]:
        """Return what cannot be read, in the order written, by reading all once more."""
        reader = _Reader(self._root, self._largest, self._number_reader)
        reader.robot(whole=True)
        return reader._findings

    # --- links ---

    def _link(self, element: Element) -> Link:
        return Link(
            element, name=self._name(element), trace=self._trace, read_rest=self._link_reader
        )

    def _read_link(self, link: Link) -> None:
        children = link.element.children
        contents = self._contents.get(id(children))
        if contents is None:
            contents = self._contents[id(children)] = self._read_contents(link.element)
        link.inertial, link.visuals, link.collisions = contents

    def _read_contents(self, link: Element) -> Contents:
        inertial: Inertial | None = None
        visuals: list[Visual] = []
        collisions: list[Collision] = []
        for child in link.children:
            if not isinstance(child, Element):
                continue
            if child.name == "visual":
                visual = self._visuals.get(id(child))
                if visual is None:
                    material = child_named(child, "material")
                    visual = self._visuals[id(child)] = Visual(
                        child,
                        name=attribute_text(child, "name") or "",
                        pose=self._origin_in(child),
                        shape=self._shape_in(child),
                        material=self._material(material) if material is not None else None,
                    )
                visuals.append(visual)
            elif child.name == "collision":
                collision = self._collisions.get(id(child))
                if collision is None:
                    collision = self._collisions[id(child)] = Collision(
                        child,
                        name=attribute_text(child, "name") or "",
                        pose=self._origin_in(child),
                        shape=self._shape_in(child),
                    )
                collisions.append(collision)
            elif child.name == "inertial" and inertial is None:
                inertial = self._inertial(child)
        return inertial, tuple(visuals), tuple(collisions)

    def _inertial(self, element: Element) -> Inertial:
        mass = self._number(child_named(element, "mass"), "value")
        inertia = child_named(element, "inertia")
        xx, xy, xz, yy, yz, zz = (self._number(inertia, name) or 0.0 for name in MOMENTS)
        moments: Inertia = (xx, xy, xz, yy, yz, zz)
        return Inertial(element, mass=mass or 0.0, pose=self._origin_in(element), inertia=moments)

    def _material(self, element: Element) -> Material:
        color = child_named(element, "color")
        rgba = self._numbers(color, "rgba", 4) if color is not None else None
        texture = child_named(element, "texture")
        return Material(
            element,
            name=attribute_text(element, "name") or "",
            color=(rgba[0], rgba[1], rgba[2], rgba[3]) if rgba is not None else None,
            texture=attribute_text(texture, "filename"),
        )

    # --- shapes and poses ---

    def _shape_in(self, section: Element) -> Shape | None:
        """Return the shape of a visual or collision: the first one in its geometry."""
        geometry = child_named(section, "geometry")
        if geometry is None:
            self._find("missing-element", f"a {section.name} has no geometry", section)
            return None
        for child in geometry.children:
            if isinstance(child, Element) and child.name in SHAPE_WORDS:
                kind = child.name
                if kind == Mesh.kind:
                    filename = attribute_text(child, "filename") or ""
                    return Mesh(filename, self._vector(child, "scale", UNSCALED), element=child)
                attributes = SIZES[kind]
                sizes: list[float] = []
                if len(attributes) == 1 and COUNTS[kind] > 1:
                    sizes += (
                        self._numbers(child, attributes[0], COUNTS[kind]) or (0.0,) * COUNTS[kind]
                    )
                else:
                    sizes += [self._number(child, attribute) or 0.0 for attribute in attributes]
                return SIMPLE_SHAPES[kind](*sizes, element=child)
        self._find("missing-element", f"the geometry of a {section.name} has no shape", geometry)
        return None

    def _origin_in(self, element: Element) -> Pose:
        origin = child_named(element, "origin")
        return self._origin(origin) if origin is not None else IDENTITY

    def _origin(self, element: Element) -> Pose:
        pose = self._origins.get(id(element))
        if pose is None:
            quaternion = None
            if "quat_xyzw" in element.attributes:
                quaternion = self._numbers(element, "quat_xyzw", 4)
            if quaternion is not None:
                rotation = rotation_from_quaternion(*quaternion)
            else:
                rpy = self._vector(element, "rpy", ZERO)
                rotation = rotation_from_rpy(*rpy) if any(rpy) else UNTURNED
            pose = Pose(rotation, self._vector(element, "xyz", ZERO), element)
            self._origins[id(element)] = pose
        return pose

    # --- joints ---

    def _joint(self, element: Element) -> Joint:
        parent: Element | None = None
        child: Element | None = None
        mimic: Element | None = None
        for inner in element.children:
            if isinstance(inner, Element):
                name = inner.name
                if name == "parent":
                    parent = parent or inner
                elif name == "child":
                    child = child or inner
                elif name == "mimic":
                    mimic = mimic or inner
        return Joint(
            element,
            name=self._name(element),
            parent=attribute_text(parent, "link") or "",
            child=attribute_text(child, "link") or "",
            mimic=self._part(Mimic, mimic) if mimic is not None else None,
            trace=self._trace,
            read_rest=self._joint_reader,
        )

    def _read_joint(self, joint: Joint) -> None:
        first: dict[str, Element] = {}
        for child in joint.element.children:
            if isinstance(child, Element) and child.name not in first:
                first[child.name] = child
        get = first.get
        joint.type = self._joint_type(joint.element)
        origin = get("origin")
        joint.origin = self._origin(origin) if origin is not None else IDENTITY
        joint.limit = joint.dynamics = None
        joint.safety_controller = joint.calibration = None
        axis, limit, dynamics = get("axis"), get("limit"), get("dynamics")
        joint.axis = X_AXIS if axis is None else self._axes.get(id(axis)) or self._axis(axis)
        if limit is not None:
            joint.limit = self._part(Limit, limit)
        note = self._dynamics.get(joint.name)
        if note is not None:
            joint.dynamics = Dynamics(note, self._number, is_note=True)
        elif dynamics is not None:
            joint.dynamics = self._part(Dynamics, dynamics)
        safety, calibration = get("safety_controller"), get("calibration")
        if safety is not None:
            joint.safety_controller = self._part(SafetyController, safety)
        if calibration is not None:
            joint.calibration = self._part(Calibration, calibration)

    def _joint_type(self, joint: Element) -> str:
        kind = attribute_text(joint, "type")
        if kind in JOINT_TYPES:
            return kind
        if kind is None:
            self._find("missing-attribute", "a joint has no 'type'", joint)
            return "fixed"
        message = f"the type '{kind}' of a joint is not known"
        self._find("unknown-joint-type", message, joint, "type", hint=joint_type_hint(kind))
        return kind

    def _axis(self, element: Element) -> Vector:
        axis = self._axes[id(element)] = unit_vector(self._vector(element, "xyz", X_AXIS))
        return axis

    def _part(self, kind: type[Part], element: Element) -> Part:
        """Return the limit, mimic, … of an element, with the values that the schema lists."""
        known: Part | None = self._parts.get(id(element))
        if known is not None:
            return known
        part = self._parts[id(element)] = kind(element, self._number)
        return part

    # --- values ---

    def _name(self, element: Element) -> str:
        name = element.attributes.get("name")
        if type(name) is str and name:
            return name
        text = attribute_text(element, "name")
        if not text:
            self._find("missing-attribute", f"a {element.name} has no name", element)
        return text or ""

    def _vector(self, element: Element, attribute: str, default: Vector) -> Vector:
        """Return the three numbers of an attribute, or the default."""
        numbers = self._numbers(element, attribute, 3)
        return (numbers[0], numbers[1], numbers[2]) if numbers is not None else default

    def _number(self, element: Element | None, attribute: str) -> float | None:
        """Return the number in an attribute, or None; of several numbers the first."""
        numbers = self._numbers(element, attribute, 1)
        return numbers[0] if numbers else None

    def _numbers(self, element: Element | None, attribute: str, count: int) -> Numbers | None:
        """Return the numbers in an attribute, or None if it is left out or cannot be read."""
        value = element.attributes.get(attribute) if element is not None else None
        if element is None or value is None:
            return None
        found = self._number_reader.of(value)
        if type(found) is tuple and len(found) == count:
            return found
        text = format_value(value)
        wanted = COUNT_WORDS[count]
        message = f"'{attribute}' of '{element.name}' takes {wanted}, not '{text}'"
        if isinstance(found, NumberFault):
            self._find("not-a-number", message, element, attribute)
            found = _despite_spelling(text, self._largest)
        else:
            self._find("wrong-count", message, element, attribute)
        if len(found) == count or (count == 1 and found):
            return found[:count]
        return None

    def _find(
        self,
        code: str,
        message: str,
        element: Element,
        attribute: str | None = None,
        *,
        hint: str | None = None,
    ) -> None:
        """Note what cannot be read."""
        span = element.span if attribute is None else element.value_span(attribute)
        trace = element.trace_within(self._trace)
        self._findings.append(
            Diagnostic(code, message, span, severity=WARNING, trace=trace, hint=hint)
        )


def _despite_spelling(text: str, largest: float) -> Numbers:
    """Return the numbers of a text that some parsers would not read; none if none would."""
    try:
        numbers = tuple(map(float, text.split()))
    except ValueError:
        return ()
    return numbers if all(isfinite(n) and abs(n) <= largest for n in numbers) else ()
