"""Which links of a robot are bodies in MJCF, and which are sites in one."""

from __future__ import annotations

from ...model.joint import FIXED, FLOATING, PLANAR, SINGLE
from ...model.pose import IDENTITY

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.joint import Joint
    from ...model.link import Link
    from ...model.pose import Pose
    from ...model.robot import Robot

WORLD = "world"
MOVING = frozenset((*SINGLE, FLOATING, PLANAR))


class Plan:
    """Where each link of a robot is found in MJCF.

    A root named `world` is the world, if the robot is fixed. An empty link on a fixed joint is a
    site, unless a sensor measures the force in the joint. Every other link is a body.

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
    """

    __slots__ = (
        "_is_fixed", "_measured", "_robot", "bodies", "carriers", "free", "order", "poses", "sites",
        "static", "world",
    )  # fmt: skip

    def __init__(self, robot: Robot, *, is_fixed: bool) -> None:
        """Sort the links of a robot, whose root is fixed in the world or not."""
        self._robot = robot
        self._is_fixed = is_fixed
        self._measured = {each.joint for each in robot.sensors.values()}
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
        if joint is not None and self._is_site(link, joint):
            self.carriers[name] = self.carriers[joint.parent]
            self.poses[name] = self.poses[joint.parent] @ joint.origin
            self.sites.append(name)
            return
        self.carriers[name] = name
        self.poses[name] = IDENTITY
        self.bodies.append(name)

    def _is_site(self, link: Link, joint: Joint) -> bool:
        return joint.type == FIXED and link.is_empty and joint.name not in self._measured

    def is_floating_in_world(self, joint: Joint) -> bool:
        """Return whether a joint lets a link go in the world: MJCF has it nowhere else."""
        return joint.type == FLOATING and joint.parent in self.static

    def place_of(self, link: Link) -> tuple[str | None, Pose]:
        """Return the link whose body the body of a link is in, and its pose there.

        None is for the world.
        """
        joint = self._robot.parent_joint(link.name)
        if joint is None:
            return None, IDENTITY
        if self.is_floating_in_world(joint):
            return None, self.static[joint.parent] @ joint.origin
        return self.carriers[joint.parent], self.poses[joint.parent] @ joint.origin
