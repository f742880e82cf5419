"""A robot as a `<model>` of SDFormat."""

from __future__ import annotations

from ...diagnostics import YamaroError
from ...model.joint import FIXED, FLOATING
from ...model.kinematics import WORLD
from ...model.pose import IDENTITY
from ..bodies import Bodies
from ..foreign_xml import foreign_losses
from ..inertia import Inertias
from ..output import APPROXIMATED, Loss, Output
from ..raw_xml import RawXmlOf
from ..shared_losses import cones, lost_in_sensor, lost_sections, renamed_sensors
from ..tags import Tag, row_of
from .copied_sensors import SensorCopier
from .gazebo_blocks import GazeboBlocks, physics_of
from .joints import JointWriter
from .links import inertial_of_nothing, inertial_tag, lost_collisions, pose_tag, sensor_tag
from .names import Names
from .shapes import Shapes

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.extras import Loop, Sensor
    from ...model.joint import Joint
    from ...model.link import Link
    from ...model.robot import Robot
    from ...xml.tree import Element
    from ..output import Wanted

MODEL_FRAME = "__model__"
NAMESPACE = "http://gazebosim.org/schema"
"""Of what Gazebo adds to SDFormat."""


def write(robot: Robot, wanted: Wanted) -> Output:
    """Return a robot in SDFormat."""
    return _Model(robot, wanted).output()


class _Model:
    """Makes the model of one robot."""

    def __init__(self, robot: Robot, wanted: Wanted) -> None:
        self._robot = robot
        self._wanted = wanted
        self._version = wanted.version or "1.11"
        self._bodies = Bodies(robot)
        self._names = Names(robot, has_world=self._bodies.carriers.get(WORLD, "") is None)
        self._losses: list[Loss] = self._names.losses
        self._inertias = Inertias(robot, is_fixed=wanted.is_fixed, repairs=wanted.repairs_inertia)
        self._losses += self._inertias.losses
        self._blocks = GazeboBlocks(robot)
        self._losses += foreign_losses(robot, taken=("gazebo",))
        self._raw = RawXmlOf(robot, "sdf")
        self._copier = SensorCopier(self._version, self._losses)
        self._copied = self._blocks.copied_sensors()
        self._losses += renamed_sensors(robot, but=self._copied)
        self._losses += cones(robot, but=self._copied)
        self._shapes = Shapes(robot, wanted, self._names, self._blocks, self._losses)
        self._joint_writer = JointWriter(robot, self._names.joints, self._version, self._losses)
        self._members: dict[str, list[Link]] = {}
        for link in self._bodies.order:
            carrier = self._bodies.carriers[link.name]
            if carrier is not None:
                self._members.setdefault(carrier, []).append(link)

    def output(self) -> Output:
        """Return the document."""
        robot = self._robot
        if self._inertias.errors:
            raise YamaroError(self._inertias.errors)
        parts: list[Tag | Element] = []
        for link in robot.links.values():
            if link.name in self._members:
                parts += self._link(link)
        for joint in robot.joints.values():
            if robot.parent_joint(joint.child) is joint and joint.child in self._bodies.carriers:
                parts += self._joint(joint)
        parts += self._fixed_roots()
        parts += [self._loop(loop) for loop in robot.loops.values()]
        parts += self._blocks.model
        parts += self._raw.robot
        if not self._members and not any(each.name == "static" for each in parts):
            # SDFormat has a model without links only if it is static.
            parts.insert(0, Tag("static", "true"))
        self._losses += self._raw.left()
        self._losses += self._blocks.left(self._members)
        self._blocks.lose_without_home(self._members)
        self._losses += self._blocks.losses
        canonical = next((self._names.links[name] for name in self._members), None)
        model = Tag("model", parts, name=robot.name or self._wanted.name, canonical_link=canonical)
        root = Tag("sdf", [model], version=self._version).made(robot.span, None)
        if self._copier.has_custom:
            root.attributes["xmlns:gz"] = NAMESPACE
        self._losses += lost_sections(robot, states=True, actuators=True, controls=True)
        return Output(root, self._losses)

    # --- links and frames ---

    def _link(self, link: Link) -> list[Tag]:
        """Return a body, and the frames in it: Drake wants a frame after the one it is in."""
        name, members = link.name, self._members[link.name]
        inertial = link.inertial
        if inertial is not None and inertial.mass > 0:
            principal = self._inertias.by_link.get(name)
            parts: list[Tag | Element] = [inertial_tag(link, inertial, principal, self._losses)]
        else:
            parts = [inertial_of_nothing(link, self._losses)]
        for member in members:
            parts += self._shapes.of(member, name)
        for member in members:
            parts += self._sensors(member, name)
            parts += self._raw.in_link(member.name)
        parts += self._blocks.links.get(name, ())
        body = Tag(
            "link",
            [*self._pose(link), *parts],
            span=link.span,
            trace=link.trace,
            name=self._names.links[name],
        )
        return [body, *(self._frame(each, name) for each in members if each is not link)]

    def _pose(self, link: Link) -> list[Tag]:
        """Return the pose of a body: in its joint, or in the link attached to it."""
        joint = self._robot.parent_joint(link.name)
        if joint is None:
            return []
        if self._bodies.is_dissolved(joint) or joint.type == FLOATING:
            return pose_tag(joint.origin, self._reference(joint.parent))
        return pose_tag(None, self._names.joints[joint.name])

    def _reference(self, link: str) -> str:
        """Return the frame of a link, as poses refer to it."""
        return self._names.links.get(link, MODEL_FRAME)

    def _frame(self, link: Link, carrier: str) -> Tag:
        """Return the frame of a link that is part of another one's body."""
        joint = self._robot.parent_joint(link.name)
        if joint is not None and self._bodies.is_dissolved(joint):
            home, pose = self._reference(joint.parent), pose_tag(joint.origin)
        else:
            home = self._names.links[carrier]
            if joint is None:
                pose = pose_tag(None, MODEL_FRAME)
            elif joint.type == FLOATING:
                pose = pose_tag(joint.origin, self._reference(joint.parent))
            else:
                pose = pose_tag(None, self._names.joints[joint.name])
        return Tag(
            "frame",
            pose,
            span=link.span,
            trace=link.trace,
            name=self._names.links[link.name],
            attached_to=home,
        )

    # --- sensors ---

    def _sensors(self, link: Link, body: str) -> list[Tag | Element]:
        """Return the sensors in a link; those that are written for Gazebo as they are."""
        frame = None if link.name == body else self._names.links[link.name]
        found: list[Tag | Element] = [
            self._copier.copied(sensor, body, frame, link.trace)
            for home, sensor in self._blocks.sensors
            if home == link.name
        ]
        for sensor in self._robot.sensors.values():
            if sensor.link == link.name and sensor.name not in self._copied:
                collisions = self._felt(sensor, link, body)
                home = sensor.frame if sensor.frame in self._robot.links else sensor.link
                found.append(self._sensor(sensor, body, home, collisions))
        return found

    def _felt(self, sensor: Sensor, link: Link, body: str) -> list[str]:
        """Return the collisions that a contact sensor feels: its link's, or else its body's."""
        if sensor.type != "contact":
            return []
        own = self._shapes.collisions.get(link.name, [])
        members = [each.name for each in self._members[body]]
        found = own or [name for each in members for name in self._shapes.collisions.get(each, [])]
        if not found:
            self._losses.append(lost_collisions(sensor, link))
        return found

    def _sensor(self, sensor: Sensor, body: str, home: str | None, collisions: list[str]) -> Tag:
        frame = None if home in (None, body) else self._names.links.get(str(home))
        if sensor.type == "contact" and sensor.noise:
            self._losses.append(lost_in_sensor(sensor, "noise of contact sensors", "noise"))
        return sensor_tag(sensor, frame=frame, collisions=collisions, version=self._version)

    # --- joints ---

    def _joint(self, joint: Joint) -> list[Tag]:
        if self._bodies.is_dissolved(joint):
            return []
        more: list[Tag | Element] = [
            self._copier.copied(sensor, joint.name, None, joint.trace)
            for home, sensor in self._blocks.sensors
            if home == joint.name
        ]
        more += [
            self._sensor(each, joint.child, None, [])
            for each in self._robot.sensors.values()
            if each.joint == joint.name and each.name not in self._copied
        ]
        more += physics_of(self._blocks.joints.get(joint.name, []))
        more += self._raw.in_joint(joint.name)
        tag = self._joint_writer.tag(
            joint,
            parent=self._body_of(joint.parent),
            child=self._body_of(joint.child),
            relative_to=self._reference(joint.parent),
            more=more,
        )
        return [] if tag is None else [tag]

    def _body_of(self, link: str) -> str:
        """Return the name of the body that a link is part of."""
        carrier = self._bodies.carriers[link]
        return WORLD if carrier is None else self._names.links[carrier]

    def _fixed_roots(self) -> list[Tag]:
        """Return the joints that fix the root in the world."""
        if not self._wanted.is_fixed:
            return []
        found = []
        for root in self._robot.roots:
            carrier = self._bodies.carriers[root.name]
            if carrier is not None:
                child = self._names.links[carrier]
                name = self._names.new(f"{child}_world")
                ends = [Tag("parent", WORLD), Tag("child", child)]
                found.append(
                    Tag("joint", ends, span=root.span, trace=root.trace, name=name, type=FIXED)
                )
        return found

    def _loop(self, loop: Loop) -> Tag:
        """Return the joint that closes a loop."""
        first, second = loop.between
        self._losses.append(
            Loss(
                APPROXIMATED,
                "loops",
                f"loop '{loop.name}'",
                loop.span,
                trace=loop.trace,
                how="second joints of a link, which Gazebo's default physics engine leaves out",
            )
        )
        axis = []
        if loop.axis is not None:
            axis = [
                Tag("axis", [Tag("xyz", row_of(loop.axis), expressed_in=self._reference(first))])
            ]
        return Tag(
            "joint",
            [
                *pose_tag(IDENTITY, self._reference(second)),
                Tag("parent", self._body_of(first)),
                Tag("child", self._body_of(second)),
                *axis,
            ],
            span=loop.span,
            trace=loop.trace,
            name=self._names.new(loop.name),
            type=loop.type,
        )
