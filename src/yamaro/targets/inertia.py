"""Mass and inertia that simulators refuse: reported before they do, or balanced.

Source: the rules are those of a body of any shape, A + B ≥ C for its principal moments, and of
MuJoCo's compiler, which takes no rounding into account.
"""

from __future__ import annotations

from ..diagnostics import Diagnostic
from ..model.inertia import principal_axes
from ..model.joint import FIXED, SINGLE
from ..model.kinematics import from_the_roots
from ..model.pose import Pose, multiply, transposed
from ..xml.values import format_number
from .bodies import Bodies
from .losses import Losses

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Container, Iterable

    from ..model.joint import Joint
    from ..model.link import Inertial, Link
    from ..model.pose import Rotation, Vector
    from ..model.robot import Robot

ROUNDING = 1e-9
"""How far, as part of the greatest moment, moments may break the rule because they are rounded."""
NOISE = 1e-14
"""How far they may because of how they are worked out here; this is not reported."""
LEAST = 1e-15
"""The mass and the moments of a body that moves must be greater. Source: mjMINVAL of MuJoCo."""
REPAIR_HINT = "correct the numbers; --repair-inertia takes the nearest that a body can have"


class Principal:
    """The mass of a link and its principal moments, which a body can have.

    Attributes:
        mass: in kg.
        moments: about the centre of mass, in kg·m².
        pose: T_link_axes: from the centre of mass, along the axes of the moments.
        is_changed: whether the moments are others than those that are written.
    """

    __slots__ = ("is_changed", "mass", "moments", "pose")

    def __init__(self, mass: float, moments: Vector, pose: Pose, *, is_changed: bool) -> None:
        self.mass = mass
        self.moments = moments
        self.pose = pose
        self.is_changed = is_changed


def turned_moments(moments: Vector, turn: Rotation) -> Rotation:
    """Return the matrix of moments along the axes that a rotation gives: R·diag(moments)·Rᵀ."""
    x, y, z = ((a * moments[0], b * moments[1], c * moments[2]) for a, b, c in turn)
    return multiply((x, y, z), transposed(turn))


class Inertias:
    """The masses of a robot.

    Attributes:
        by_link: by the names of links; those without mass and inertia are left out.
        losses: the moments that were changed, or are those of another link.
        errors: what a simulator would refuse.
    """

    __slots__ = ("by_link", "errors", "losses")

    def __init__(
        self,
        robot: Robot,
        *,
        is_fixed: bool,
        repairs: bool,
        passed: Container[str] = (),
        weighed: Iterable[str] = (),
    ) -> None:
        """Work them out.

        Args:
            robot: the robot.
            is_fixed: whether its root is fixed in the world.
            repairs: whether moments that no body can have are changed instead of refused.
            passed: the links without mass between two joints that are allowed.
            weighed: the links whose mass the simulator takes from their shapes.
        """
        self.by_link: dict[str, Principal] = {}
        self.losses = Losses()
        self.errors: list[Diagnostic] = []
        for link in robot.links.values():
            inertial = link.inertial
            if inertial is not None and (inertial.mass or any(inertial.inertia)):
                self.by_link[link.name] = self._read(link, inertial, repairs=repairs)
        massless = [name for name, each in self.by_link.items() if not each.mass]
        # A body without mass has the same moments about any point. So the robot moves as before if
        # the body that it is fixed to has them, while simulators take no body of inertia alone:
        # Drake ends the process.
        bodies: Bodies | None = None
        for name in massless:
            bodies = bodies or Bodies(robot)
            link, own = robot.links[name], self.by_link.pop(name)
            carrier, what = bodies.carriers.get(name), "inertias of links without mass"
            if carrier is None or carrier == name or carrier not in self.by_link:
                self.losses.lose(what, link, part=link.inertial)
                continue
            how = "moments of the links that they are fixed to"
            self.losses.approximate(what, link, part=link.inertial, how=how)
            turn = multiply(bodies.poses[name].rotation, own.pose.rotation)
            body = self.by_link[carrier]
            matrices = (
                turned_moments(body.moments, body.pose.rotation),
                turned_moments(own.moments, turn),
            )
            x, y, z = (
                (one[0] + other[0], one[1] + other[1], one[2] + other[2])
                for one, other in zip(*matrices, strict=True)
            )
            moments, rotation = principal_axes((x, y, z))
            pose = Pose(rotation, body.pose.position)
            self.by_link[carrier] = Principal(body.mass, moments, pose, is_changed=True)
        # What moves without mass, with all that is fixed to it, is refused.
        upper: dict[str, str] = {}
        for link in from_the_roots(robot):
            joint = robot.parent_joint(link.name)
            rests = joint is not None and joint.type == FIXED
            upper[link.name] = upper[joint.parent] if joint is not None and rests else link.name
        heavy = {
            upper[name]
            for name, each in self.by_link.items()
            if name in upper and each.mass > LEAST and min(each.moments) > LEAST
        }
        heavy |= {upper[name] for name in weighed if name in upper}
        for name in dict.fromkeys(upper.values()):
            joint = robot.parent_joint(name)
            if name in passed and not _rests_below(robot, name):
                continue
            if name not in heavy and (joint is not None or not is_fixed):
                self._refuse_massless(robot.links[name], joint)

    def _read(self, link: Link, inertial: Inertial, *, repairs: bool) -> Principal:
        moments, rotation = principal_axes(inertial.matrix())
        turned = multiply(inertial.pose.rotation, rotation)
        pose = Pose(turned, inertial.pose.position)
        size = max(map(abs, moments))
        change = max(0.0, -min(moments), 2 * max(moments) - sum(moments))
        if change <= NOISE * size:
            return Principal(inertial.mass, moments, pose, is_changed=False)
        is_rounding = change <= ROUNDING * size
        if not is_rounding and not repairs:
            shown = ", ".join(f"{moment:.6g}" for moment in sorted(moments))
            rule = "the greatest is more than the sum of the others"
            if min(moments) < 0:
                rule = "one is negative"
            element = inertial.inner("inertia")
            self.errors.append(
                Diagnostic(
                    "inertia-triangle",
                    f"no body has the inertia of the link '{link.name}': its principal moments are "
                    f"{shown}, and {rule}",
                    inertial.span if element is None else element.span,
                    hint=REPAIR_HINT,
                    trace=inertial.trace_in(link),
                )
            )
        else:
            what = "moments of inertia that no body has"
            if is_rounding:
                what = "moments of inertia that no body has because they are rounded"
            how = "the nearest that a body can have"
            self.losses.approximate(what, link, part=inertial, how=how)
        return Principal(inertial.mass, balanced(moments), pose, is_changed=True)

    def _refuse_massless(self, link: Link, joint: Joint | None) -> None:
        lacks = "inertia" if link.mass > 0 else "mass"
        how = f"is moved by the joint '{joint.name}'" if joint is not None else "moves freely"
        hint = f"add the {lacks} that it has, or make the joint fixed"
        if joint is None:
            hint = f"add the {lacks} that it has, or --base fixed"
        self.errors.append(
            Diagnostic(
                "massless-moving",
                f"the link '{link.name}' {how}, but has no {lacks}, and no link that is fixed to "
                "it has",
                link.span_of("name"),
                hint=hint,
                trace=link.trace,
            )
        )


def between_joints(robot: Robot) -> set[str]:
    """Return the empty links between two joints, as where one body has several joints.

    They are exact without mass; a simulator that takes no such body has one of hardly any.
    """
    found = set()
    for link in robot.links.values():
        joint, below = robot.parent_joint(link.name), robot.joints_below(link.name)
        if link.is_empty and joint is not None and len(below) == 1:
            if joint.type in SINGLE and below[0].type in SINGLE:
                found.add(link.name)
    return found


def _rests_below(robot: Robot, link: str) -> bool:
    """Return whether a fixed joint is below a link."""
    return any(joint.type == FIXED for joint in robot.joints_below(link))


def balanced(moments: Vector) -> Vector:
    """Return the nearest moments that a body can have: A + B ≥ C, and none below 0.

    The excess of the greatest is shared out equally, which is the nearest point of the plane
    A + B = C.
    """
    found = [max(moment, 0.0) for moment in moments]
    excess = 2 * max(found) - sum(found)
    if excess > 0:
        greatest = found.index(max(found))
        found = [moment + excess / 3 for moment in found]
        found[greatest] -= 2 * excess / 3
    return (found[0], found[1], found[2])


def written_moments(moments: Vector) -> Vector:
    """Return moments that keep the rule also after they are written with 15 digits."""
    found = [float(format_number(max(moment, 0.0))) for moment in moments]
    greatest = found.index(max(found))
    rest = sum(found[:greatest]) + sum(found[greatest + 1 :])
    moment, step = min(found[greatest], rest), 1e-15
    while float(format_number(moment)) > rest:
        moment, step = rest * (1 - step), 2 * step
    found[greatest] = float(format_number(moment))
    return (found[0], found[1], found[2])
