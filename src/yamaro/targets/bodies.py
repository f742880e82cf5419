"""Which links become bodies of a simulator, and which are only frames in one.

A simulator wants mass in each of its bodies. A link without mass that a fixed joint holds is part
of the body at the other end: of the one above it, or else of the first one below it.
"""

from __future__ import annotations

from ..model.joint import FIXED
from ..model.kinematics import WORLD, from_the_roots
from ..model.pose import IDENTITY, Pose

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..model.joint import Joint
    from ..model.link import Link
    from ..model.robot import Robot


def has_mass(link: Link) -> bool:
    """Return whether a link has mass of its own."""
    return link.mass > 0


def is_world(robot: Robot, link: Link) -> bool:
    """Return whether a link is the world: an empty root of that name."""
    return link.name == WORLD and link.is_empty and robot.parent_joint(WORLD) is None


class Bodies:
    """The bodies of a robot.

    Attributes:
        carriers: by the name of each link, the link whose body it is part of; None for the world.
        poses: by the name of each link, T_carrier_link.
        without_mass: the links that are bodies of their own although they have no mass, since
            nothing that is rigidly joined to them has any.
        order: the links from the roots to the leaves.
    """

    __slots__ = ("_robot", "carriers", "order", "poses", "without_mass")

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self.carriers: dict[str, str | None] = {}
        self.poses: dict[str, Pose] = {}
        self.without_mass: list[str] = []
        self.order = from_the_roots(robot)
        for link in self.order:
            if link.name not in self.carriers:
                self._place(link)

    def is_body(self, link: str) -> bool:
        """Return whether a link is a body of its own."""
        return self.carriers[link] == link

    def is_dissolved(self, joint: Joint) -> bool:
        """Return whether both ends of a joint are in one body."""
        return joint.type == FIXED and self.carriers[joint.parent] == self.carriers[joint.child]

    def _place(self, link: Link) -> None:
        """Find the carrier of a link, and those of the links between them."""
        name, above = link.name, self._robot.parent_joint(link.name)
        if is_world(self._robot, link):
            self._carry(name, None, IDENTITY)
            return
        if has_mass(link):
            self._carry(name, name, IDENTITY)
            return
        if above is not None and above.type == FIXED:
            carrier = self.carriers[above.parent]
            if carrier is not None:
                self._carry(name, carrier, self.poses[above.parent] @ above.origin)
                return
        way = self._way_down(link)
        if not way:
            self.without_mass.append(name)
            self._carry(name, name, IDENTITY)
            return
        carrier, pose = way[-1].child, IDENTITY
        self._carry(carrier, carrier, pose)
        for joint in reversed(way):
            pose = pose @ joint.origin.inverse()
            self._carry(joint.parent, carrier, pose)

    def _carry(self, link: str, carrier: str | None, pose: Pose) -> None:
        self.carriers[link] = carrier
        self.poses[link] = pose

    def _way_down(self, link: Link) -> list[Joint]:
        """Return the fixed joints that lead to the nearest link with mass below, or none."""
        links = self._robot.links
        ways: list[list[Joint]] = [[]]
        for way in ways:
            end = way[-1].child if way else link.name
            for joint in self._robot.joints_below(end):
                if joint.type == FIXED:
                    longer = [*way, joint]
                    if has_mass(links[joint.child]):
                        return longer
                    ways.append(longer)
        return []
