"""The names of links, frames and joints in a model: in SDFormat they share one scope."""

from __future__ import annotations

from ...model.kinematics import WORLD
from ..output import RENAMED, Loss
from ..tags import unused

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.joint import Joint
    from ...model.link import Link
    from ...model.robot import Robot


class Names:
    """What the links, frames and joints of a robot are called in SDFormat.

    Attributes:
        links: the names of links and frames by those in the robot.
        joints: the names of joints by those in the robot.
        losses: what is renamed.
    """

    __slots__ = ("_taken", "joints", "links", "losses")

    def __init__(self, robot: Robot, *, has_world: bool) -> None:
        """Name all links and joints.

        Args:
            robot: the robot.
            has_world: whether its root is the world, and is not written.
        """
        self.losses: list[Loss] = []
        self._taken: set[str] = set()
        self.links: dict[str, str] = {}
        self.joints: dict[str, str] = {}
        wanted = {name for name in robot.links if fault_of(name) is None}
        for link in robot.links.values():
            if has_world and link.name == WORLD:
                continue
            self.links[link.name] = self._name("link", link, wanted)
        for joint in robot.joints.values():
            self.joints[joint.name] = self._name("joint", joint, set())

    def new(self, name: str) -> str:
        """Return a name for what the robot has no name for: this one, if nothing else has it."""
        return unused(name, self._taken)

    def _name(self, kind: str, thing: Link | Joint, wanted: set[str]) -> str:
        """Return the name of a link or joint, and note it if it is another one."""
        name = thing.name
        reason = fault_of(name)
        if reason is None and name not in self._taken:
            self._taken.add(name)
            return name
        plain = name.replace("::", "_").strip("_")
        found = plain if plain != name and plain not in wanted else f"{plain}_{kind}"
        while found in wanted:
            found += "_"
        found = self.new(found)
        self.losses.append(
            Loss(
                RENAMED,
                f"{kind}s {reason or 'named like a link'}",
                f"{kind} '{name}'",
                thing.span_of("name"),
                trace=thing.trace,
                how=found,
            )
        )
        return found


def fault_of(name: str) -> str | None:
    """Return what SDFormat has against a name, or None."""
    if name == WORLD:
        return "with the reserved name 'world'"
    if name.startswith("__") and name.endswith("__"):
        return "with a reserved name"
    return "with '::' in their names" if "::" in name else None
