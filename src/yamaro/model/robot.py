"""A robot: its links, joints, shapes and materials, with the place where each is written.

`reading.read_robot` makes it from a finished `<robot>`, whether YAML, xacro or URDF gave that, and
whatever is wrong with it: what is missing or cannot be read takes its default, and is listed in
`Robot.findings`. `yamaro.Robot.from_urdf` and `build(...).robot` are the ways to one.

**How a check reads it.** `robot.all_links` and `robot.all_joints` are all that are written, those
of a repeated or missing name too; `robot.links` and `robot.joints` hold the first of each name. A
default looks like the same value written out: where that matters, ask for what is written.
Everything that is read is `Written`: `written("upper")` is the text of an attribute or None,
`inner("mass")` the element of that name inside, `span_of("upper")` the place of a value. Values
inside of a link or joint, such as `Limit` and `Visual`, are one object wherever the same element
is used again, so a check can keep by `id` what it found sound. Such an object does not know its
calls and includes; those are the `trace` of its link or joint, which `trace_in(owner)` gives.

The objects are not to be changed, since they are shared. The names, and the links and the mimic of
a joint, are read at once; the rest of a link or joint is read when it is first used. Checks that
run in every build should avoid it where they can: reading the origins of all joints takes time.
"""

from __future__ import annotations

from math import fsum

from ..source import Public
from .joint import FIXED
from .values import ByName, Written, attribute_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterator, Mapping, Sequence
    from typing import TypeVar

    from ..diagnostics import Diagnostic
    from ..files.mesh_files import MeshFinder
    from ..source import Span
    from ..xml.tree import Element
    from .changes.change import Changes
    from .changes.context import SameFile
    from .compare import Difference
    from .controllers import Controller, ControllerManager
    from .extras import (
        Actuator,
        Base,
        CollisionSettings,
        Control,
        Extras,
        Fitted,
        Group,
        Loop,
        RawXml,
        Sensor,
        State,
        Surface,
    )
    from .joint import Joint
    from .link import Collision, Link, Material, Visual
    from .pose import Pose, Vector
    from .positions import GivenPositions

    Overlay = str | os.PathLike[str] | Mapping[str, object]
    Overlays = Overlay | Sequence[Overlay] | None
    Named = TypeVar("Named", Link, Joint)

CONVEX = ("hull", "pieces")
"""What is made of a mesh and is convex."""
NAMING = "naming"
"""The name of a note that says what the joints and links of parts are called."""


class Frame(Public):
    """A named pose in a link. In URDF it is an empty link on a fixed joint.

    Attributes:
        name: its name, that of the empty link.
        link: the name of the link that it is in.
        pose: T_link_frame.
        joint: the fixed joint.
    """

    __slots__ = ("joint", "link", "name", "pose")

    def __init__(self, joint: Joint) -> None:
        """Take the joint for a frame's."""
        self.joint = joint
        self.name = joint.child
        self.link = joint.parent
        self.pose = joint.origin

    @property
    def span(self) -> Span:
        """Return where it is written."""
        return self.joint.span


class Robot(Written):
    """A robot.

    Attributes:
        name: its name, or "".
        version: its version of URDF as written, or None.
        links: by name, in the order written; the first of each name. A name that is not there is a
            KeyError that suggests one, as in all that are by name.
        joints: by name, in the order written; the first of each name.
        all_links, all_joints: all that are written, those of a repeated or missing name too.
        own_materials: those written directly under the robot; see `materials`.
        finder: finds the files of meshes and textures; None if the robot was not built.
    """

    __slots__ = (
        "_extras", "_find", "_findings", "_joints_below", "_materials", "_notes", "_parent_joints",
        "_recognizes",
        "all_joints", "all_links", "finder", "joints", "links", "name", "own_materials", "version",
    )  # fmt: skip
    _internal = frozenset((
        "all_joints", "all_links", "finder", "is_convex", "name_patterns", "need_joint",
        "need_link", "noted", "own_materials", "raw", "visuals",
    ))  # fmt: skip

    def __init__(
        self,
        element: Element,
        *,
        links: list[Link],
        joints: list[Joint],
        materials: list[Material],
        find: Callable[[], list[Diagnostic]],
        notes: Sequence[Element] = (),
        recognizes: bool = True,
    ) -> None:
        """Put together what was read; see `reading.read_robot`.

        Args:
            element: the `<robot>`.
            links: all links.
            joints: all joints.
            materials: its own, which are not those of visuals.
            find: reads the whole robot, and returns what could not be read.
            notes: what words say that it has besides links and joints.
            recognizes: whether elements such as `<gazebo>` say it as well.
        """
        self.element = element
        self.finder: MeshFinder | None = None
        self.name = attribute_text(element, "name") or ""
        self.version = attribute_text(element, "version")
        self.all_links = tuple(links)
        self.all_joints = tuple(joints)
        self._notes = notes
        self.links: Mapping[str, Link] = ByName(
            "link", _first_of_each_name(links), self.name_patterns("link")
        )
        self.joints: Mapping[str, Joint] = ByName(
            "joint", _first_of_each_name(joints), self.name_patterns("joint")
        )
        self.own_materials = tuple(materials)
        self._materials: dict[str, Material] | None = None
        self._find = find
        self._findings: tuple[Diagnostic, ...] | None = None
        self._recognizes = recognizes
        self._extras: Extras | None = None
        self._parent_joints: dict[str, Joint] | None = None
        self._joints_below: dict[str, list[Joint]] | None = None

    @classmethod
    def from_urdf(cls, path: str | os.PathLike[str], *, overlay: Overlays = None) -> Robot:
        """Return the robot of a URDF file, read as it is: xacro is not run, files are not included.

        Args:
            path: the file.
            overlay: what changes values of it, as `yamaro.build` takes it, which then reads the
                file.

        Raises:
            FileNotFoundError: the file does not exist; other OSErrors if it cannot be read.
            YamaroError: it is not XML, or not a `<robot>`.
        """
        if overlay is not None:
            return _built(path, "robot", None, overlay)
        from .reading import read_file

        return read_file(path)

    @classmethod
    def from_xml(cls, text: str, *, name: str = "<text>") -> Robot:
        """Return the robot of a URDF that is given as text.

        Args:
            text: the XML.
            name: what the text is called in messages and places.

        Raises:
            YamaroError: it is not XML, or not a `<robot>`.
        """
        from .reading import read_text

        return read_text(text, name=name)

    @classmethod
    def from_mjcf(
        cls, path: str | os.PathLike[str], *, model: str | None = None, overlay: Overlays = None
    ) -> Robot:
        """Return the robot of an MJCF file, with those that it includes and attaches.

        Args:
            path: the file.
            model: the name that the model has to have; by default any.
            overlay: what changes values of it, as `yamaro.build` takes it.

        Raises:
            FileNotFoundError: the file does not exist; other OSErrors if it cannot be read.
            YamaroError: it has errors, or is not MJCF.
        """
        return _built(path, "mujoco", model, overlay)

    @classmethod
    def from_sdf(
        cls, path: str | os.PathLike[str], *, model: str | None = None, overlay: Overlays = None
    ) -> Robot:
        """Return the robot of an SDF file: its first model, or the one of a name.

        Args:
            path: the file.
            model: the name of the model; by default that of the first.
            overlay: what changes values of it, as `yamaro.build` takes it.

        Raises:
            FileNotFoundError: the file does not exist; other OSErrors if it cannot be read.
            YamaroError: it has errors, or is not SDF.
        """
        return _built(path, "model", model, overlay)

    @property
    def findings(self) -> tuple[Diagnostic, ...]:
        """Return what could not be read, as warnings, in the order written."""
        if self._findings is None:
            self._findings = tuple(self._find())
        return self._findings

    # --- structure ---

    @property
    def materials(self) -> Mapping[str, Material]:
        """Return the definition that counts of each name, as in urdfdom.

        It is the first that belongs to the robot, or else the first in a visual.
        """
        if self._materials is None:
            found: dict[str, Material] = {}
            for material in self.own_materials:
                if material.name and material.is_defined:
                    found.setdefault(material.name, material)
            seen: set[int] = set()
            for link in self.all_links:
                visuals = link.visuals
                if not visuals or id(visuals) in seen:
                    continue
                seen.add(id(visuals))
                for visual in visuals:
                    inner = visual.material
                    if inner is not None and inner.name and inner.is_defined:
                        found.setdefault(inner.name, inner)
            self._materials = ByName("material", found)
        return self._materials

    @property
    def roots(self) -> list[Link]:
        """Return the links that are not a child, in order; a valid robot has exactly one."""
        parent_joints = self._parents()
        return [link for name, link in self.links.items() if name not in parent_joints]

    @property
    def frames(self) -> dict[str, Frame]:
        """Return the frames by name, in order: the empty links at fixed joints."""
        found = {
            name: Frame(joint)
            for name, joint in self._parents().items()
            if joint.type == FIXED and self.links[name].is_empty
        }
        return ByName("frame", found, self.name_patterns("link"))

    def parent_joint(self, link: str) -> Joint | None:
        """Return the joint whose child a link is, the first one written; None for a root."""
        return self._parents().get(link)

    def joints_below(self, link: str) -> list[Joint]:
        """Return the joints whose parent is a link, in order."""
        if self._joints_below is None:
            below: dict[str, list[Joint]] = {}
            for joint in self._parents().values():
                below.setdefault(joint.parent, []).append(joint)
            self._joints_below = below
        return self._joints_below.get(link, [])

    def _parents(self) -> dict[str, Joint]:
        """Return the joint above each link that has one; both of its links must be there."""
        found = self._parent_joints
        if found is None:
            found, links = {}, self.links
            for joint in self.joints.values():
                if joint.child in links and joint.parent in links:
                    found.setdefault(joint.child, joint)
            self._parent_joints = found
        return found

    def visuals(self) -> Iterator[tuple[Link, Visual]]:
        """Yield the visuals of all links, each with its link."""
        for link in self.links.values():
            for visual in link.visuals:
                yield link, visual

    def free_joints(self) -> list[Joint]:
        """Return the joints whose position is one number, and their own."""
        return [joint for joint in self.joints.values() if joint.is_free]

    def material_of(self, visual: Visual) -> Material | None:
        """Return the material that a visual is shown with, as urdfdom finds it, or None."""
        material = visual.material
        if material is None:
            return None
        return self.materials.get(material.name, material)

    # --- what URDF has no elements for ---

    def _more(self) -> Extras:
        """Return what it has besides links and joints, which is read when it is first used."""
        if self._extras is None:
            from .extras import Extras

            notes = list(self._notes)
            if self._recognizes:
                from .recognition import recognized

                notes += recognized(self, self._notes)
            self._extras = Extras(notes)
        return self._extras

    def noted(self) -> Extras:
        """Return what words of YAML say besides links and joints, and not what elements say."""
        from .extras import Extras

        return Extras(self._notes)

    @property
    def sensors(self) -> Mapping[str, Sensor]:
        """Return the sensors by name, in order: those of words, then those in `<gazebo>`."""
        return self._more().sensors

    @property
    def actuators(self) -> Mapping[str, Actuator]:
        """Return the actuators by the names of their joints, in order.

        Those of words come first, then those in `<ros2_control>` and in `<transmission>`.
        """
        return self._more().actuators

    @property
    def fits(self) -> tuple[Fitted, ...]:
        """Return the shapes that were worked out from meshes, in order."""
        return self._more().fits

    def is_convex(self, link: Link, collision: Collision) -> bool:
        """Return whether a collision is a mesh that was made as a convex piece of another one."""
        return any(
            fitted.link == link.name
            and fitted.section == "collision"
            and fitted.made in CONVEX
            and any(
                each is collision
                for each in link.collisions[fitted.index : fitted.index + fitted.count]
            )
            for fitted in self.fits
        )

    @property
    def surfaces(self) -> tuple[Surface, ...]:
        """Return the surfaces of collisions, in order: those of words, then those in `<gazebo>`."""
        return self._more().surfaces

    @property
    def states(self) -> Mapping[str, State]:
        """Return the named positions of joints; those of an attached robot are merged."""
        return self._more().states

    @property
    def groups(self) -> Mapping[str, Group]:
        """Return the named groups of links and joints."""
        return self._more().groups

    @property
    def loops(self) -> Mapping[str, Loop]:
        """Return the joints that close loops, by name."""
        return self._more().loops

    @property
    def controls(self) -> tuple[Control, ...]:
        """Return the hardware that drives the joints: of words, then of `<ros2_control>`."""
        return self._more().controls

    @property
    def controllers(self) -> Mapping[str, Controller]:
        """Return the controllers that the section `controllers` names."""
        return self._more().controllers

    @property
    def controller_manager(self) -> ControllerManager | None:
        """Return what that section says of the controller manager, or None."""
        return self._more().controller_manager

    @property
    def collision_settings(self) -> CollisionSettings | None:
        """Return how pairs of links that never collide are found, or None if nothing says it."""
        return self._more().collision_settings

    @property
    def base(self) -> Base | None:
        """Return how the robot is placed in the world, as the main file says it, or None."""
        return self._more().base

    def raw(self, format: str | None = None) -> list[RawXml]:
        """Return the XML that is for one output format, such as `mjcf`; by default for any."""
        return [each for each in self._more().raw if format in (None, each.format)]

    def _repr_html_(self) -> str | None:
        """Return what a notebook shows: the robot in 3D."""
        from ..source import html_of

        return html_of(self)

    # --- kinematics and mass ---

    def pose(
        self,
        name: str,
        positions: GivenPositions | None = None,
        *,
        base: str | None = None,
    ) -> Pose:
        """Return T_root_link of a link or frame, for given positions of joints.

        Args:
            name: the link's or frame's, or that of the part whose link it is.
            positions: a state or its name, such as `"home"`; or positions by the names of joints
                or of their parts: a number in radians or metres for a revolute, continuous or
                prismatic joint, or a text with a unit, such as `"90deg"`; three of them for a
                planar one, x, y and an angle in the plane across its axis; a `Pose` for a
                floating one. Joints that are left out are at 0. Joints that mimic others follow
                them.
            base: the link or frame in whose frame the pose is, T_base_link; by default the root.

        Raises:
            ValueError: there is no such link, no such state, or no such joint that can be given a
                position, or a position is not of its joint's type.
        """
        from .kinematics import pose_of

        pose = pose_of(self, name, positions)
        return pose if base is None else pose_of(self, base, positions).inverse() @ pose

    def poses(self, positions: GivenPositions | None = None) -> dict[str, Pose]:
        """Return T_root_link of every link by name, in order; see `pose`.

        A robot with faults may have several roots, or links in a circle. Each pose is then
        relative to the root that the link is below, or to one link of the circle.
        """
        from .kinematics import link_poses

        return link_poses(self, positions)

    @property
    def mass(self) -> float:
        """Return the sum of all links' masses in kg."""
        return fsum(link.mass for link in self.links.values())

    def center_of_mass(self, positions: GivenPositions | None = None) -> Vector:
        """Return the centre of mass in the frame of the root, in metres.

        Args:
            positions: see `pose`.

        Raises:
            ValueError: the robot has no mass, or see `pose`.
        """
        from .kinematics import center_of_mass

        return center_of_mass(self, positions)

    def differences(self, other: Robot) -> list[Difference]:
        """Return how another robot differs from this one; none if they mean the same.

        All that is written counts, that of simulators too, except for comments, white space, the
        spelling of numbers (they are equal up to 1e-9 of their size), poses of zeros and the order
        in which URDF does not read.
        """
        from .compare import compare

        return compare(self.element, other.element)

    def changes(
        self,
        other: Robot,
        *,
        tolerance: float = 1e-9,
        same_file: SameFile | None = None,
        has_extras: bool = True,
    ) -> Changes:
        """Return what changed from this robot to another one, by meaning, as `yamaro diff` does.

        Links and joints are compared by name, or as renamed where the content is the same;
        rotations as rotations, inertias along the axes of the link, materials by their look.

        Args:
            other: the robot after the changes.
            tolerance: how far numbers may differ, as a part of the larger one; rotations in
                radians.
            same_file: called with the name of a mesh or texture and its place, in this robot and
                in the other; says whether the files have the same content, None if it is not
                known. By default files are compared by name.
            has_extras: whether to compare what URDF has no elements for, such as sensors.
        """
        from .changes.robots import compare_robots

        return compare_robots(
            self, other, tolerance=tolerance, same_file=same_file, has_extras=has_extras
        )

    def need_link(self, name: str) -> Link:
        """Return the link of a name, or of a part; else raise ValueError with a suggestion."""
        link = self.links.get(name)
        if link is None:
            from .positions import link_named

            return link_named(self, name)
        return link

    def need_joint(self, name: str) -> Joint:
        """Return the joint of a name, or of a part; else raise ValueError with a suggestion."""
        joint = self.joints.get(name)
        if joint is None:
            from .positions import joint_named

            return joint_named(self, name)
        return joint

    def name_patterns(self, kind: str) -> tuple[str, ...]:
        """Return what the joints or links of parts are called: `*_joint`, then as `naming` says."""
        patterns = [attribute_text(note, f"{kind}s") for note in self._notes if note.name == NAMING]
        return tuple(dict.fromkeys([f"*_{kind}", *filter(None, patterns)]))

    def __repr__(self) -> str:
        return f"<Robot '{self.name}': {len(self.links)} links, {len(self.joints)} joints>"


def _first_of_each_name(things: Sequence[Named]) -> dict[str, Named]:
    found = {thing.name: thing for thing in things}
    if len(found) < len(things):
        found = {}
        for thing in things:
            found.setdefault(thing.name, thing)
    return found


def _built(path: str | os.PathLike[str], head: str, model: str | None, overlay: Overlays) -> Robot:
    """Return the robot of a file, read as a build reads it.

    Args:
        path: the file.
        head: the element that is a robot in its format.
        model: the name of the model that is wanted.
        overlay: what changes values of it.
    """
    import os
    from importlib import import_module  # a build is made above the model

    from ..diagnostics import failure_of_all

    os.stat(path)
    # URDF is what holds the model, and it does not have to hold the loops.
    allow = ["lost-in-urdf"]
    build = import_module("yamaro.api").build(
        os.fspath(path), model=model, overlay=overlay, allow=allow, on_message=lambda line: None
    )
    robot: Robot = build.robot
    if robot.span.written() != head:
        name = os.fspath(path)
        known, root = {
            "mujoco": ("MJCF", "mujoco"), "model": ("SDF", "sdf"), "robot": ("URDF", "robot")
        }[head]  # fmt: skip
        raise failure_of_all(
            "not-urdf",
            f"this is not {known}: its root is not '{root}'",
            name,
            "read it with Robot.from_urdf, or with yamaro.build, which reads any of them",
        )
    return robot
