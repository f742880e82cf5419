"""A robot as a `<model>` of SDFormat."""

from __future__ import annotations

from ...diagnostics import YamaroError
from ...model.joint import FIXED, FLOATING, SINGLE
from ...model.kinematics import WORLD
from ...model.pose import IDENTITY
from ..bodies import Bodies
from ..contacts import filtered_pairs
from ..elements import element, given, settle
from ..foreign_xml import RawXmlOf, foreign_losses
from ..holding import cones, lost_sections, renamed_sensors
from ..inertia import Inertias, between_joints
from ..output import Output
from ..table import TARGETS
from ..translation import Translation
from .blocks import merged, type_in
from .gazebo import GazeboBlocks, physics_of
from .joints import JointWriter
from .links import Names, inertial_of, pose_of, row_of
from .sensors import SensorCopier, sensor_of
from .shapes import Shapes

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.extras import Loop, Sensor
    from ...model.joint import Joint
    from ...model.link import Link
    from ...model.robot import Robot
    from ...xml.tree import Element
    from ..elements import Attributes
    from ..output import Wanted

MODEL_FRAME = "__model__"
NAMESPACE = "http://gazebosim.org/schema"
"""Of what Gazebo adds to SDFormat."""
OF_BODIES = frozenset(
    """gravity self_collide kinematic enable_wind velocity_decay must_be_base_link inertial
    pose""".split()
)
"""What a `<link>` says of itself, which a frame in it cannot say."""
IGNORED = "ignored_collision_filter_group"
DRAKE = "https://drake.mit.edu"
"""Of what Drake adds to it."""


def write(robot: Robot, wanted: Wanted) -> Output:
    """Return a robot in SDFormat."""
    return _Model(robot, wanted).output()


class _Model:
    """Makes the model of one robot."""

    def __init__(self, robot: Robot, wanted: Wanted) -> None:
        self._robot = robot
        self._wanted = wanted
        self._version = wanted.version or TARGETS["sdf"].versions[0]
        self._bodies = Bodies(robot)
        self._names = Names(robot, has_world=self._bodies.carriers.get(WORLD, "") is None)
        self._losses = self._names.losses
        self._inertias = Inertias(
            robot,
            is_fixed=wanted.is_fixed,
            repairs=wanted.repairs_inertia,
            passed=between_joints(robot),
        )
        self._losses += self._inertias.losses
        self._blocks = GazeboBlocks(robot)
        self._losses += foreign_losses(robot, taken=("gazebo",))
        self._raw = RawXmlOf(robot, "sdf")
        self._moved = {  # joints that a block has elsewhere than in the frame of their child
            raw.joint
            for raw in Translation(robot, "sdf").blocks
            if any(e.name == "pose" for e in raw.elements)
        }
        self._copier = SensorCopier(self._version, self._losses)
        self._copied = self._blocks.copied_sensors()
        self._losses += renamed_sensors(robot, but=self._copied)
        self._losses += cones(robot, but=self._copied)
        self._shapes = Shapes(robot, wanted, self._names, self._blocks, self._losses)
        self._joint_writer = JointWriter(
            robot, self._names.joints, self._version, self._losses, is_fixed=wanted.is_fixed
        )
        self._has_filters = False
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
        parts: list[Element] = []
        for link in robot.links.values():
            if link.name in self._members:
                parts += self._link(link)
        for joint in robot.joints.values():
            if robot.parent_joint(joint.child) is joint and joint.child in self._bodies.carriers:
                parts += self._joint(joint)
        for link in robot.roots if self._wanted.is_fixed else ():
            carrier = self._bodies.carriers[link.name]
            if carrier is not None:
                child = self._names.links[carrier]
                fixed: Attributes = {"name": self._names.new(f"{child}_world"), "type": FIXED}
                ends = given(("parent", WORLD), ("child", child))
                parts.append(element("joint", fixed, children=ends, owner=link))
        parts += [self._loop(loop) for loop in robot.loops.values()]
        parts += self._filters()
        parts += self._blocks.model
        if not self._members and not any(each.name == "static" for each in parts):
            # SDFormat has a model without links only if it is static.
            parts.insert(0, element("static", text="true"))
        self._losses += self._raw.left()
        self._losses += self._blocks.left(self._members)
        self._blocks.lose_without_home(self._members)
        self._losses += self._blocks.losses
        canonical = next((self._names.links[name] for name in self._members), None)
        name = robot.name or self._wanted.name
        model = element("model", {"name": name, "canonical_link": canonical}, children=parts)
        model = merged(model, self._raw.robot)
        if self._wanted.has_gazebo:  # after the merge, by which plugins of a class would be one
            from .systems import joint_systems

            plugins = [each for each in model.elements() if each.name == "plugin"]
            writer, joints = self._joint_writer, self._names.joints
            systems = joint_systems(robot, joints, writer.gains, writer.efforts, plugins)
            settle(systems, model.span, model.trace)
            model = model.with_children([*model.children, *systems])
        attributes: Attributes = {"version": self._version}
        if self._copier.has_custom:
            attributes["xmlns:gz"] = NAMESPACE
        if self._joint_writer.has_drake or self._has_filters:
            attributes["xmlns:drake"] = DRAKE
        root = element("sdf", attributes, children=[model], owner=robot.element)
        for actuator in robot.actuators.values():
            driven = robot.joints.get(actuator.joint)
            is_driven = driven is not None and driven.type in SINGLE and driven.mimic is None
            if driven is None or not is_driven or robot.parent_joint(driven.child) is not driven:
                what = "actuators of joints that are not independent"
                self._losses.lose(what, actuator)
        self._losses += lost_sections(robot, states=True, controls=True)
        names = {
            kind: {new: name for name, new in known.items()}
            for kind, known in (("link", self._names.links), ("joint", self._names.joints))
        }
        finder = self._wanted.paths.finder
        files = finder.made_among(finder.referred_to(robot.element))
        return Output(root, self._losses, files, names=names)

    def _filters(self) -> list[Element]:
        """Return the groups by which Drake, which lets all links touch, leaves out pairs of them.

        Each link that is in a pair is in a group of its own. Gazebo has no contacts within a model
        unless it says `self_collide`.
        """
        ignored: dict[str, list[str]] = {}
        owners: dict[str, Link] = {}
        for one, other, link in filtered_pairs(
            self._robot, self._bodies, self._wanted, self._losses
        ):
            ignored.setdefault(one, []).append(other)
            ignored.setdefault(other, [])
            owners.setdefault(one, link)
            owners.setdefault(other, link)
        self._has_filters = bool(ignored)
        called = {name: self._names.new(f"{self._names.links[name]}_contacts") for name in ignored}
        return [
            element(
                "drake:collision_filter_group",
                {"name": called[name]},
                children=[
                    element("drake:member", text=self._names.links[name]),
                    *(element(f"drake:{IGNORED}", text=called[other]) for other in others),
                ],
                owner=owners[name],
            )
            for name, others in ignored.items()
        ]

    # --- links and frames ---

    def _link(self, link: Link) -> list[Element]:
        """Return a body, and the frames in it: Drake wants a frame after the one it is in."""
        name, members = link.name, self._members[link.name]
        parts = [inertial_of(link, self._inertias.by_link.get(name), self._losses)]
        block: list[Element] = []
        for member in members:
            parts += self._shapes.of(member, name)
        for member in members:
            frame = None if member.name == name else self._names.links[member.name]
            parts += [  # as they are written for Gazebo
                self._copier.copied(sensor, name, frame, member.trace)
                for home, sensor in self._blocks.sensors
                if home == member.name
            ]
            for sensor in self._robot.sensors.values():
                if sensor.link == member.name and sensor.name not in self._copied:
                    collisions: list[str] = []
                    if sensor.type == "contact":  # it feels the collisions of its link, or body
                        known = self._shapes.collisions
                        collisions = known.get(member.name) or [
                            felt for each in members for felt in known.get(each.name, ())
                        ]
                        if not collisions:
                            what = "contact sensors in links without collisions"
                            hint = f"give the link '{member.name}' a collision"
                            self._losses.lose(what, sensor, hint=hint)
                    home = sensor.frame if sensor.frame in self._robot.links else sensor.link
                    parts.append(self._sensor(sensor, name, home, collisions))
            block += self._of_body(member, name)
        parts += self._blocks.links.get(name, ())
        attributes: Attributes = {"name": self._names.links[name]}
        body = element("link", attributes, children=[*self._pose(link), *parts], owner=link)
        return [
            merged(body, block),
            *(self._frame(each, name) for each in members if each is not link),
        ]

    def _of_body(self, member: Link, name: str) -> list[Element]:
        """Return what a block says of a link in a body; what is of a body alone is that of one."""
        block = self._raw.in_link(member.name)
        if member.name == name:
            return block
        label = f"link '{member.name}'"
        for each in block:
            if each.name in OF_BODIES:
                what = f"<{each.name}> of links that are frames"
                self._losses.lose_xml(what, each, label=label, trace=each.trace)
        return [each for each in block if each.name not in OF_BODIES]

    def _pose(self, link: Link) -> list[Element]:
        """Return the pose of a body: in its joint, or in the link attached to it."""
        joint = self._robot.parent_joint(link.name)
        if joint is None:
            return []
        is_apart = joint.type == FLOATING or joint.name in self._moved
        if is_apart or self._bodies.is_dissolved(joint):
            return pose_of(joint.origin, self._reference(joint.parent))
        return pose_of(None, self._names.joints[joint.name])

    def _reference(self, link: str) -> str:
        """Return the frame of a link, as poses refer to it."""
        return self._names.links.get(link, MODEL_FRAME)

    def _frame(self, link: Link, carrier: str) -> Element:
        """Return the frame of a link that is part of another one's body."""
        joint = self._robot.parent_joint(link.name)
        if joint is not None and self._bodies.is_dissolved(joint):
            home, pose = self._reference(joint.parent), pose_of(joint.origin)
        else:
            home = self._names.links[carrier]
            if joint is None:
                pose = pose_of(None, MODEL_FRAME)
            elif joint.type == FLOATING:
                pose = pose_of(joint.origin, self._reference(joint.parent))
            else:
                pose = pose_of(None, self._names.joints[joint.name])
        attributes: Attributes = {"name": self._names.links[link.name], "attached_to": home}
        return element("frame", attributes, children=pose, owner=link)

    # --- sensors ---

    def _sensor(
        self, sensor: Sensor, body: str, home: str | None, collisions: list[str]
    ) -> Element:
        frame = None if home in (None, body) else self._names.links.get(str(home))
        if sensor.type == "contact" and sensor.noise:
            self._losses.lose("noise of contact sensors", sensor, field="noise")
        return sensor_of(sensor, frame=frame, collisions=collisions, version=self._version)

    # --- joints ---

    def _joint(self, joint: Joint) -> list[Element]:
        if self._bodies.is_dissolved(joint):
            return []
        more = [
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
        block = self._raw.in_joint(joint.name)
        made = self._joint_writer.made(
            joint,
            type=type_in(block),
            parent=self._body_of(joint.parent),
            child=self._body_of(joint.child),
            relative_to=self._reference(joint.parent),
            more=more,
        )
        return [] if made is None else [merged(made, [e for e in block if e.name != "type"])]

    def _body_of(self, link: str) -> str:
        """Return the name of the body that a link is part of."""
        carrier = self._bodies.carriers[link]
        return WORLD if carrier is None else self._names.links[carrier]

    def _loop(self, loop: Loop) -> Element:
        """Return the joint that closes a loop."""
        first, second = loop.between
        how = "second joints of a link, which Gazebo's default physics engine leaves out"
        self._losses.approximate("loops", loop, how=how)
        content = pose_of(IDENTITY, self._reference(second))
        content += given(("parent", self._body_of(first)), ("child", self._body_of(second)))
        if loop.axis is not None:
            frame: Attributes = {"expressed_in": self._reference(first)}
            axis = element("xyz", frame, text=row_of(loop.axis))
            content.append(element("axis", children=[axis]))
        attributes: Attributes = {"name": self._names.new(loop.name), "type": loop.type}
        return element("joint", attributes, children=content, owner=loop)
