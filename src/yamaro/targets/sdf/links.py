"""Links and frames of SDFormat: names, poses, mass."""

from __future__ import annotations

from ...model.kinematics import WORLD
from ...model.schema import MOMENTS
from ..elements import element, given, number, unused
from ..inertia import ROUNDING, written_moments
from ..losses import Losses

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ...model.joint import Joint
    from ...model.link import Link
    from ...model.pose import Pose
    from ...model.robot import Robot
    from ...xml.tree import Element
    from ..inertia import Principal


# --- names ------------------------------------------------------------------------------------


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
        self.losses = Losses()
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
        what = f"{kind}s {reason or 'named like a link'}"
        self.losses.rename(what, thing, field="name", new=found)
        return found


def fault_of(name: str) -> str | None:
    """Return what SDFormat has against a name, or None."""
    if name == WORLD:
        return "with the reserved name 'world'"
    if name.startswith("__") and name.endswith("__"):
        return "with a reserved name"
    return "with '::' in their names" if "::" in name else None


# --- poses and mass ---------------------------------------------------------------------------


POINT_RADIUS = 1e-6
"""The radius, in metres, of the ball whose inertia a point mass gets."""
PLACEHOLDER = 1e-3
"""The mass, in kg, of a link that cannot have mass 0: see `inertial_of`."""


def pose_of(pose: Pose | None, relative_to: str | None = None) -> list[Element]:
    """Return a `<pose>`; none if it would change nothing."""
    numbers = numbers_of(pose) if pose is not None else ()
    text = row_of(numbers) if any(numbers) else None
    if text is None and relative_to is None:
        return []
    return [element("pose", {"relative_to": relative_to}, text=text)]


def row_of(numbers: Iterable[float]) -> str:
    """Return numbers in a row.

    The schema of SDFormat wants a point in those with an exponent: 1.0e-05.
    """
    return " ".join(
        text.replace("e", ".0e") if "e" in text and "." not in text else text
        for text in map(number, numbers)
    )


def numbers_of(pose: Pose) -> tuple[float, ...]:
    """Return x, y, z, roll, pitch, yaw, the angles as they are written if they are."""
    origin = pose.element
    if origin is not None and "quat_xyzw" not in origin.attributes:
        text = str(origin.attributes.get("rpy", "0 0 0"))
        try:
            roll, pitch, yaw = map(float, text.split())
        except ValueError:
            return (*pose.position, *pose.rpy)
        return (*pose.position, roll, pitch, yaw)
    return (*pose.position, *pose.rpy)


def inertial_of(link: Link, principal: Principal | None, losses: Losses) -> Element:
    """Return the `<inertial>` of a link; without any, SDFormat takes it for 1 kg.

    Args:
        link: the link.
        principal: its mass and inertia along the principal axes, as a body can have it.
        losses: takes what is approximated.
    """
    inertial = link.inertial
    if inertial is None or inertial.mass <= 0:
        hint = "give the link a mass"
        losses.approximate("links without mass", link, how="links of 1 g", hint=hint)
        moment = 2 / 5 * PLACEHOLDER * 0.01**2
        inertia = _inertia_of((moment, 0, 0, moment, 0, moment))
        return element("inertial", children=[element("mass", text=PLACEHOLDER), inertia])
    values, pose = inertial.inertia, inertial.pose
    if principal is not None and (principal.is_changed or _is_tight(values, principal)):
        first, second, third = written_moments(principal.moments)
        values, pose = (first, 0.0, 0.0, second, 0.0, third), principal.pose
    if not any(values):
        moment = 2 / 5 * inertial.mass * POINT_RADIUS**2
        values = (moment, 0.0, 0.0, moment, 0.0, moment)
        how = "balls with a radius of 1 µm"
        losses.approximate("point masses", link, part=inertial, how=how)
    content = [*pose_of(pose), element("mass", text=inertial.mass), _inertia_of(values)]
    return element("inertial", children=content, owner=link, part=inertial)


def _is_tight(inertia: tuple[float, ...], principal: Principal) -> bool:
    """Return whether rounding decides if a body can have an inertia with products.

    libsdformat refuses some that are just possible, such as those of flat bodies, because of how it
    works out the principal moments. It has nothing to work out where these are written.
    """
    _, xy, xz, _, yz, _ = inertia
    moments = principal.moments
    room = sum(moments) - 2 * max(moments)
    return any((xy, xz, yz)) and room < ROUNDING * max(moments)


def _inertia_of(values: tuple[float, ...]) -> Element:
    return element("inertia", children=given(*zip(MOMENTS, values, strict=True)))
