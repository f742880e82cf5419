"""A model of MJCF while it is written: which links are bodies, names, sections, losses."""

from __future__ import annotations

from ...diagnostics import Diagnostic
from ...model.joint import FIXED, FLOATING, PLANAR, SINGLE
from ...model.kinematics import WORLD, joint_transform
from ...model.pose import IDENTITY, UNTURNED, quaternion_from_rotation
from ...model.values import attribute_text
from ...xml.tree import Element
from ..elements import UsedNames, element
from ..inertia import Inertias
from ..losses import Losses
from ..table import release
from .blocks import ANCHOR, Blocks

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...diagnostics import Frame as Step
    from ...model.extras import RawXml
    from ...model.joint import Joint
    from ...model.link import Collision, Link
    from ...model.pose import Pose, Vector
    from ...model.robot import Robot
    from ...model.values import Written
    from ...source import Span
    from ..contacts import Solid
    from ..elements import Attributes
    from ..output import Wanted


BODY, JOINT, GEOM, SITE, CAMERA = "body", "joint", "geom", "site", "camera"
MESH, MATERIAL, TEXTURE = "mesh", "material", "texture"
ACTUATOR, SENSOR, EQUALITY = "actuator", "sensor", "equality"
"""The types of things, each of which has names of its own."""
MOVING = frozenset((*SINGLE, FLOATING, PLANAR))


class Plan:
    """Where each link of a robot is found in MJCF.

    A root named `world` is the world, if the robot is fixed. An empty link on a fixed joint is a
    site, unless a sensor measures the force in the joint. A link without anything between two
    joints is passed over, since MuJoCo takes no body without mass: the joints are two of one body.
    Every other link is a body.

    Attributes:
        carriers: by the name of each link, the link whose body it is in; None for the world.
        poses: by the name of each link, T_carrier_link.
        order: the links from the roots to the leaves, each after those above it.
        bodies: the names of the links that are bodies, in that order.
        sites: the names of the links that are sites, in that order.
        static: T_world_link of each link that cannot move, by name.
        free: of each link, by name, the one that is free in the world and moves it; None if a joint
            of the robot holds it there.
        world: the link that is the world, or None.
        passed: of each link that is passed over, by name, the link below whose body has its
            joint.
    """

    __slots__ = (
        "_blocks", "_is_fixed", "_needed", "_robot", "bodies", "carriers", "free", "order",
        "passed", "poses", "sites", "static", "world",
    )  # fmt: skip

    def __init__(self, robot: Robot, blocks: Blocks, *, is_fixed: bool) -> None:
        """Sort the links of a robot, whose root is fixed in the world or not."""
        self._robot = robot
        self._blocks = blocks
        self._is_fixed = is_fixed
        given = _given_by_blocks(robot, blocks)
        sensors = [
            each
            for each in robot.sensors.values()
            if each.written("of") != "mjcf" and each.name not in given
        ]
        self._needed = {each.joint for each in sensors} | {each.frame for each in sensors}
        self._needed.update(frame for loop in robot.loops.values() for frame in loop.between)
        self.passed: dict[str, str] = {}
        self.carriers: dict[str, str | None] = {}
        self.poses: dict[str, Pose] = {}
        self.static: dict[str, Pose] = {}
        self.free: dict[str, str | None] = {}
        self.bodies: list[str] = []
        self.sites: list[str] = []
        self.world: Link | None = None
        self.order: list[Link] = []
        pending = list(reversed(robot.roots))
        while pending:
            link = pending.pop()
            self.order.append(link)
            self._place(link)
            joints = robot.joints_below(link.name)
            pending += [robot.links[joint.child] for joint in reversed(joints)]

    def _place(self, link: Link) -> None:
        name, joint = link.name, self._robot.parent_joint(link.name)
        if joint is None:
            self.free[name] = None if self._is_fixed else name
            if self._is_fixed:
                self.static[name] = IDENTITY
            if name == WORLD and self._is_fixed:
                self.world = link
                self.carriers[name] = None
                self.poses[name] = IDENTITY
                return
        else:
            self.free[name] = name if self.is_floating_in_world(joint) else self.free[joint.parent]
            if joint.type not in MOVING and joint.parent in self.static:
                self.static[name] = self.static[joint.parent] @ joint.origin
        below = self._passed_to(link, joint)
        if below is not None:
            self.passed[name] = below
            return
        is_fixed = joint is not None and joint.type == FIXED
        is_empty = link.is_empty and not self._blocks.is_body(name)
        if joint is not None and is_fixed and is_empty and joint.name not in self._needed:
            self.carriers[name] = self.carriers[joint.parent]
            self.poses[name] = self.poses[joint.parent] @ joint.origin
            self.sites.append(name)
            return
        self.carriers[name] = name
        self.poses[name] = IDENTITY
        self.bodies.append(name)

    def _passed_to(self, link: Link, joint: Joint | None) -> str | None:
        """Return the link below whose body has the joint of a link that is passed over.

        Between a joint and a fixed one, a link is a body of its own, unless a block says where the
        joint is in the body below.
        """
        if joint is None or joint.type not in SINGLE or not link.is_empty:
            return None
        below = self._robot.joints_below(link.name)
        if len(below) != 1 or {link.name, joint.name, below[0].name} & self._needed:
            return None
        if not self._blocks.is_plain(link.name):
            return None
        is_anchored = ANCHOR in self._blocks.settings("joint", joint.name)
        takes = below[0].type in SINGLE or (below[0].type == FIXED and is_anchored)
        return below[0].child if takes else None

    def joints_of(self, link: str) -> list[tuple[Joint, Pose]]:
        """Return the joints of the body of a link, from the first, each with T_link_joint.

        The pose is that at the positions that count as unmoved, at which each joint adds nothing.
        """
        found: list[tuple[Joint, Pose]] = []
        joint, pose = self._robot.parent_joint(link), IDENTITY
        while joint is not None:
            found.append((joint, pose))
            pose = pose @ self.unmoved(joint).inverse()
            joint = self._robot.parent_joint(joint.parent) if joint.parent in self.passed else None
        return found[::-1]

    def unmoved(self, joint: Joint) -> Pose:
        """Return T_parent_child of a joint at the position that counts as unmoved."""
        reference = self._blocks.reference(joint.name) if joint.type in SINGLE else 0.0
        return joint_transform(joint, reference) if reference else joint.origin

    def is_floating_in_world(self, joint: Joint) -> bool:
        """Return whether a joint lets a link go in the world: MJCF has it nowhere else."""
        return joint.type == FLOATING and joint.parent in self.static

    def parent_and_pose(self, link: Link) -> tuple[str | None, Pose]:
        """Return the link whose body the body of a link is in, and its pose there.

        None is for the world.
        """
        joint = self._robot.parent_joint(link.name)
        if joint is None:
            return None, IDENTITY
        if self.is_floating_in_world(joint):
            return None, self.static[joint.parent] @ joint.origin
        pose = self.unmoved(joint)
        while joint.parent in self.passed:
            above = self._robot.parent_joint(joint.parent)
            assert above is not None, "it is passed by its joint"
            joint, pose = above, self.unmoved(above) @ pose
        return self.carriers[joint.parent], self.poses[joint.parent] @ pose


def stem_of(link: str) -> str:
    """Return the name of a link without the usual ending: 'base' for 'base_link'."""
    return link.removesuffix("_link") or link


MAIN = "main"
"""The name of the class that every model has."""
JOINTS = ("joint", "freejoint")
"""The elements that are joints of a body."""
NOISE = 1e-16
"""What is smaller in a position or a quaternion comes from rounding."""


def _given_by_blocks(robot: Robot, blocks: Blocks) -> set[str]:
    """Return the names of sensors that a block of the robot has as MuJoCo's, at sites."""
    from .sensors import WORDS

    kinds: dict[str, set[str]] = {}
    for each in blocks.in_section(SENSOR):
        kinds.setdefault(attribute_text(each, "site") or "", set()).add(each.name)
    found: set[str] = set()
    for sensor in robot.sensors.values() if kinds else ():
        joint = robot.joints.get(sensor.joint) if sensor.joint is not None else None
        place = sensor.frame if joint is None else joint.child
        fixed = [each.child for each in robot.joints_below(place or "") if each.type == FIXED]
        words = set(WORDS.get(sensor.type, ()))
        if any(not words.isdisjoint(kinds.get(each, ())) for each in (place or "", *fixed)):
            found.add(sensor.name)
    return found


NEWEST = (1 << 30, 0)
"""The release that is asked for by default."""
SECTIONS = ("asset", "worldbody", "contact", "equality", "actuator", "sensor", "keyframe")
"""The sections whose content is gathered, in the order of the document."""


class Classes:
    """The names of a model's default classes.

    Attributes:
        model: what holds for all of the model.
        visual, collision, frame: what holds for its visuals, collisions and frames.
    """

    __slots__ = ("collision", "frame", "model", "visual")

    def __init__(self, model: str) -> None:
        self.model = model if model != MAIN else f"{MAIN}_robot"
        self.visual = f"{model}_visual"
        self.collision = f"{model}_collision"
        self.frame = f"{model}_frame"


class Writing:
    """One run of the writer.

    Attributes:
        robot: the robot.
        wanted: what is asked for.
        release: that of MuJoCo which reads the document.
        model: the name of the model.
        classes: the default classes: of the model, of its visuals, collisions and frames.
        names: the names that are taken.
        plan: which links are bodies and which are sites.
        inertias: the masses of the links.
        inertias_measured: the names of bodies along the axes of whose inertia sensors measure.
        bodies: the body of each link that is one, by the name of the link.
        sections: the sections of the document, by name.
        losses: what MJCF cannot hold.
        files: what belongs beside the document.
        blocks: what the file says for MJCF alone.
        joints: by the name of each joint, the elements that it is.
        errors: why there is no document.
        motions: of each joint in MJCF, by name, the joint that it is and which part of it; for the
            free joint of a root, that link and `base`.
        controls: the joint and the command of each actuator that is made of one, by the identity of
            its element.
        measured: the sensor of the robot that each one in MJCF is of, by its name.
        collisions: what collides: the link, the collision, and of a mesh the outer corners.
        solids: the same at home, once it is worked out.
        renamed_geoms: the names of geoms by their links and the names in the robot, if these were
            not free.
    """

    __slots__ = (
        "_body_names", "blocks", "bodies", "classes", "collisions", "controls", "errors", "files",
        "inertias", "inertias_measured", "joints", "losses", "measured", "model", "motions",
        "names", "plan", "release", "renamed_geoms", "robot", "sections", "solids", "wanted",
    )  # fmt: skip

    def __init__(self, robot: Robot, wanted: Wanted) -> None:
        self.robot = robot
        self.wanted = wanted
        self.release = release(wanted.version) if wanted.version else NEWEST
        self.model = robot.name or wanted.name
        self.classes = Classes(self.model)
        self.controls: dict[int, tuple[str, str]] = {}
        self.joints: dict[str, list[Element]] = {}
        self.collisions: list[tuple[Link, Collision, Sequence[Vector]]] = []
        self.solids: list[Solid] | None = None
        self.motions: dict[str, tuple[str, str]] = {}
        self.measured: dict[str, str] = {}
        self.renamed_geoms: dict[tuple[str, str], str] = {}
        self.blocks = Blocks(robot)
        self.inertias_measured = self.blocks.measured_bodies()
        self.plan = Plan(robot, self.blocks, is_fixed=wanted.is_fixed)
        self.sections = {name: element(name, owner=robot.element) for name in SECTIONS}
        self.bodies: dict[str, Element] = {}
        self.inertias = Inertias(
            robot,
            is_fixed=wanted.is_fixed,
            repairs=wanted.repairs_inertia,
            passed=self.plan.passed,
            weighed=[raw.link for raw in robot.raw("mjcf") if raw.link and _has_mass(raw)],
        )
        self.losses = Losses(self.inertias.losses)
        self.files: dict[str, bytes] = {}
        self.errors: list[Diagnostic] = list(self.inertias.errors)
        self.names = UsedNames()
        self.names.reserve(BODY, (WORLD,))
        self._body_names: dict[str, str] = {}
        plan = self.plan
        self.names.reserve(BODY, plan.bodies)
        self.names.reserve(SITE, plan.sites)
        self.names.reserve(JOINT, robot.joints)

    def add(self, section: str, element: Element) -> None:
        """Append an element to a section."""
        self.sections[section].children.append(element)

    def joint_name(self, joint: str) -> str:
        """Return the name of a joint of one number."""
        return self.blocks.text("joint", joint, "name") or joint

    def site_name(self, link: str) -> str:
        """Return the name of the site that a link is; one without a name has that of the link."""
        return self.blocks.text("link", link, "name") or link

    def body_name(self, link: str) -> str:
        """Return the name of the body that a link is, or is part of."""
        carrier = self.plan.carriers[link]
        if carrier is None:
            return WORLD
        own = self.blocks.text("link", carrier, "name")
        if own is not None:
            return own
        if carrier != WORLD:
            return carrier
        if carrier not in self._body_names:
            self._body_names[carrier] = self.names.fresh(BODY, f"{WORLD}_link")
        return self._body_names[carrier]

    def body_of(self, link: str) -> Element:
        """Return the body that a link is, or is part of."""
        carrier = self.plan.carriers[link]
        return self.sections["worldbody"] if carrier is None else self.bodies[carrier]

    def own_names(self) -> dict[str, dict[str, str]]:
        """Return by kind and name in MJCF what the robot calls it: see `Output.names`."""
        joints, whole = self.motions, ("base", "single", "free")
        return {
            "link": {self.body_name(link): link for link in self.plan.bodies},
            "joint": {name: joint for name, (joint, part) in joints.items() if part != "base"},
            "part": {name: part for name, (_, part) in joints.items() if part not in whole},
            "sensor": self.measured,
        }

    def fail(
        self, code: str, message: str, hint: str, *, span: Span, trace: Step | None = None
    ) -> None:
        """Note an error, once for each place."""
        if not any(each.code == code and each.span == span for each in self.errors):
            self.errors.append(Diagnostic(code, message, span, hint=hint, trace=trace))


def _has_mass(raw: RawXml) -> bool:
    """Return whether a block in a link has shapes that MuJoCo takes its mass from."""
    return any(
        each.name == "geom" and not each.attributes.keys().isdisjoint(("mass", "density"))
        for each in raw.elements
    )


class Places:
    """Where the values of an element's attributes are written, looked up when that is asked.

    Attributes:
        sources: what each attribute is made of: something that is written, and its attribute.
    """

    __slots__ = ("sources",)

    def __init__(self, sources: dict[str, tuple[Written, str]]) -> None:
        self.sources = sources

    def get(self, attribute: str) -> Span | None:
        """Return the place of an attribute's value; None for that of the element."""
        source = self.sources.get(attribute)
        return source[0].span_of(source[1]) if source is not None else None


def pose_attributes(pose: Pose) -> Attributes:
    """Return `pos` and `quat` of a pose, w first, each None if it changes nothing."""
    position = [quiet(part) for part in pose.position]
    turn: list[float] = []
    if pose.rotation != UNTURNED:
        turn = [quiet(part) for part in quaternion_from_rotation(pose.rotation)]
    return {
        "pos": position if any(position) else None,
        "quat": turn if any(turn[1:]) else None,
    }


def quiet(value: float) -> float:
    """Return a number, or 0 for what comes from rounding."""
    return value if abs(value) > NOISE else 0.0
