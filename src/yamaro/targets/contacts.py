"""Pairs of links whose contacts only disturb: adjacent ones, and those that overlap at home.

Simulators that let all links of a robot collide would push these apart. Adjacent links are also
those across links that have no shapes to collide.

Source: MoveIt's setup assistant calls these pairs adjacent, and default; simulators leave out only
adjacent ones, automatically.
"""

from __future__ import annotations

from itertools import combinations

from ..meshes.formats import MeshFileError, MissingLibraryError
from ..model.convex import Convex, outer_points, overlapping
from ..model.joint import FLOATING, PLANAR, SINGLE
from ..model.kinematics import link_poses, rigid_parts
from ..model.positions import home_positions
from ..model.shapes import Mesh
from .mesh_contents import MeshContents

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Container, Iterable, Iterator, Mapping, Sequence

    from ..model.link import Collision, Link
    from ..model.pose import Pose, Vector
    from ..model.robot import Robot
    from .bodies import Bodies
    from .losses import Losses
    from .output import Wanted

    Colliding = Iterable[tuple[Link, Collision, Sequence[Vector]]]
    """What collides: the link, the collision, and of a mesh the outer corners."""

OVERLAPS = "contacts of links that overlap at home"
KEEP_HINT = "`keep` of `collisions` names the pairs that have contacts in any case"


class Solid:
    """A convex shape, and the link that it is of."""

    __slots__ = ("convex", "link")

    def __init__(self, link: Link, convex: Convex) -> None:
        self.link = link
        self.convex = convex


def solids_at(colliding: Colliding, poses: Mapping[str, Pose]) -> list[Solid]:
    """Return what collides where the links have these poses."""
    found = []
    for link, collision, points in colliding:
        shape = collision.shape
        simple = None if shape is None or isinstance(shape, Mesh) else shape
        if simple is not None or points:
            placed = poses[link.name] @ collision.pose
            found.append(Solid(link, Convex(placed, simple, points)))
    return found


def colliding_shapes(order: Iterable[Link], wanted: Wanted) -> Colliding:
    """Return what collides in a format that does not read the meshes of collisions itself.

    Meshes that cannot be read are left out: the program that reads the format reports them.
    """
    contents = MeshContents(wanted.paths)
    corners: dict[str, list[Vector]] = {}
    found: list[tuple[Link, Collision, Sequence[Vector]]] = []
    for link in order:
        for collision in link.collisions:
            shape = collision.shape
            points: list[Vector] = []
            if isinstance(shape, Mesh):
                path = None
                if wanted.has_meshes:
                    path = contents.path_of(shape.filename, shape.span or link.span)
                if path is None:
                    continue
                if path not in corners:
                    corners[path] = _corners(contents, path)
                a, b, c = shape.scale
                points = [(x * a, y * b, z * c) for x, y, z in corners[path]]
            elif shape is None or min(shape.size) <= 0:
                continue
            found.append((link, collision, points))
    return found


def _corners(contents: MeshContents, path: str) -> list[Vector]:
    """Return the outer corners of a mesh; none if it cannot be read."""
    try:
        surfaces = contents.surfaces_of(path, is_kept=True)
        return outer_points(tuple(row) for each in surfaces for row in each.points.tolist())
    except (MeshFileError, MissingLibraryError, ValueError, OverflowError):
        return []


def solids_at_home(robot: Robot, colliding: Colliding) -> list[Solid]:
    """Return what collides at home, in the order of the links, in the axes of the root."""
    return solids_at(colliding, link_poses(robot, home_positions(robot)))


def still_links(robot: Robot, order: Iterable[Link], *, is_fixed: bool) -> set[str]:
    """Return the links that cannot move; `order` has each after those above it."""
    found: set[str] = set()
    for link in order:
        joint = robot.parent_joint(link.name)
        if joint is None:
            if is_fixed:
                found.add(link.name)
        elif joint.type not in (*SINGLE, FLOATING, PLANAR) and joint.parent in found:
            found.add(link.name)
    return found


def disturbing_pairs(
    robot: Robot,
    order: Sequence[Link],
    solids: Sequence[Solid],
    *,
    still: Container[str],
    world: Link | None,
) -> Iterator[tuple[Link, Link, bool]]:
    """Yield the pairs of links that are not to touch, without those that are to be kept.

    Args:
        robot: the robot.
        order: the links from the roots to the leaves, each after those above it.
        solids: what collides, at home.
        still: the names of links that cannot move.
        world: the link that is the world, or None.

    Yields:
        The upper link, the other, and whether they overlap at home without being adjacent.
    """
    rigid = rigid_parts(robot, order)
    settings = robot.collision_settings
    kept = {frozenset(pair) for pair in settings.keep} if settings is not None else set()
    for first, second in _adjacent(robot, order, world):
        if frozenset((first.name, second.name)) not in kept:
            if rigid[first.name] != rigid[second.name]:
                yield first, second, False
    for first, second in _overlapping(robot, solids, rigid, still):
        if frozenset((first.name, second.name)) not in kept:
            yield first, second, True


def filtered_pairs(
    robot: Robot, bodies: Bodies, wanted: Wanted, losses: Losses
) -> list[tuple[str, str, Link]]:
    """Return pairs of bodies that are not to touch, apart from those that a joint connects.

    Simulators have no contacts of those. What is lost by links that overlap is reported.

    Args:
        robot: the robot.
        bodies: its bodies.
        wanted: finds meshes.
        losses: takes what is lost.

    Returns:
        The carriers of both links, and the second link.
    """
    order, carriers = bodies.order, bodies.carriers
    if sum(bool(link.collisions) for link in order) < 2:
        return []
    solids = solids_at_home(robot, colliding_shapes(order, wanted))
    still = still_links(robot, order, is_fixed=wanted.is_fixed)
    world = next((link for link in order if carriers[link.name] is None), None)
    seen = {
        frozenset((carriers[joint.parent], carriers[joint.child]))
        for joint in robot.joints.values()
        if robot.parent_joint(joint.child) is joint and joint.child in carriers
    }
    found = []
    for first, second, overlaps in disturbing_pairs(robot, order, solids, still=still, world=world):
        one, other = carriers[first.name], carriers[second.name]
        pair = frozenset((one, other))
        if one is not None and other is not None and one != other and pair not in seen:
            seen.add(pair)
            found.append((one, other, second))
            if overlaps:
                lose_contacts(losses, first, second)
    return found


def lose_contacts(losses: Losses, first: Link, second: Link) -> None:
    """Report that two links that overlap at home never touch."""
    label = f"links '{first.name}' and '{second.name}'"
    losses.lose(OVERLAPS, second, label=label, hint=KEEP_HINT)


def _overlapping(
    robot: Robot, solids: Sequence[Solid], rigid: Mapping[str, str], still: Container[str]
) -> Iterator[tuple[Link, Link]]:
    """Yield pairs of links that overlap at home, in the order of the robot.

    Links that cannot move against each other are left out, and those of which one carries the other
    and can move: simulators have no contacts of them.
    """
    above: dict[str, str | None] = {}
    for name in dict.fromkeys(rigid.values()):
        joint = robot.parent_joint(name)
        carrier = rigid[joint.parent] if joint is not None else None
        above[name] = carrier if carrier not in still else None

    def may_touch(one: str, two: str) -> bool:
        one, two = rigid[one], rigid[two]
        if one == two or above[one] == two or above[two] == one:
            return False
        return not (one in still and two in still)

    shapes, names = [each.convex for each in solids], [each.link.name for each in solids]
    for first, second in overlapping(shapes, names, may_touch):
        yield solids[first].link, solids[second].link


def _adjacent(
    robot: Robot, order: Sequence[Link], world: Link | None
) -> Iterator[tuple[Link, Link]]:
    """Yield pairs of links with shapes that collide, and nothing but links without between them."""
    around: dict[str, list[Link]] = {}  # by the uppermost of connected links without shapes
    uppermost: dict[str, str] = {}
    for link in order:
        joint = robot.parent_joint(link.name)
        above = robot.links[joint.parent] if joint is not None else None
        if link.collisions:
            if above is None:
                continue
            if above.collisions:
                yield above, link
            elif above is not world:
                around[uppermost[above.name]].append(link)
            continue
        if above is None or above.collisions or above is world:
            uppermost[link.name] = link.name
            around[link.name] = [above] if above is not None and above.collisions else []
        else:
            uppermost[link.name] = uppermost[above.name]
    for links in around.values():
        yield from combinations(links, 2)
