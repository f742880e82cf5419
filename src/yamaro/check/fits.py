"""Shapes worked out from meshes that overlap at home, or nearly always, where their meshes do not.

MoveIt leaves out all checks of such a pair of links, and simulators push it apart or let it pass
through each other, though the links do not touch.
"""

from __future__ import annotations

from contextlib import suppress
from itertools import islice

import numpy as np

from ..fitting.crossing import are_crossing
from ..meshes.formats import MeshFileError, MissingLibraryError
from ..meshes.triangles import read_mesh
from ..model.convex import Convex, overlapping, witness
from ..model.kinematics import adjacent_links, from_the_roots, link_poses, rigid_parts
from ..model.pose import IDENTITY
from ..model.positions import home_positions, tried_range
from ..model.shapes import Mesh

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from ..fitting.sampling import Floats
    from ..model.extras import Fitted
    from ..model.link import Link
    from ..model.pose import Pose, Vector
    from ..model.robot import Robot
    from ..source import Span
    from .context import CheckContext

    Read = Callable[[str, Span], Floats]
    """Gives the triangles of a mesh file, N×3×3, as referred to at a place."""

TRIED, EXCEPT = 40, 2
"""How many positions are tried, and at how many of them a pair that always overlaps may not."""
CONVEX = ("fit", "decompose", "spheres")
"""The words whose shapes are convex, whether these are meshes or not."""


class _Whole(Convex):
    """A convex shape that overlaps others also where that is by little, as MoveIt sees it."""

    __slots__ = ()

    def shrunk(self, way: Vector) -> Vector:
        """Return the farthest point."""
        return self.farthest(way)


class _Body:
    """What a link collides with at home, in the axes of the root; all its shapes are convex.

    Attributes:
        link: its name.
        fits: what was worked out of it.
        shapes: what it collides with.
        others: those that were not worked out.
        triangles: those of the meshes that the others were worked out from.
    """

    def __init__(self, link: Link, fits: Sequence[Fitted], pose: Pose, read: Read) -> None:
        """Read the meshes that were made of meshes.

        Raises:
            ValueError: it collides with a mesh as it is, which may not be convex.
        """
        self.link = link.name
        self.fits = fits
        self.shapes: list[Convex] = []
        self.others: list[Convex] = []
        self._pose = pose
        self._read = read
        self._triangles: Floats | None = None
        made = {
            each.index + number
            for each in fits
            if each.word in CONVEX
            for number in range(each.count)
        }
        for index, each in enumerate(link.collisions):
            shape, points = each.shape, []
            if isinstance(shape, Mesh):
                if index not in made:
                    raise ValueError(shape.filename)
                triangles = read(shape.filename, shape.span or each.span)
                points = [*map(tuple, np.unique(triangles.reshape(-1, 3), axis=0).tolist())]
            if shape is not None and (points or min(shape.size) > 0):
                simple = None if isinstance(shape, Mesh) else shape
                self.shapes.append(_Whole(pose @ each.pose, simple, points))
                if index not in made:
                    self.others.append(self.shapes[-1])

    @property
    def triangles(self) -> Floats:
        if self._triangles is None:
            found = []
            for each in self.fits:
                placed = self._pose @ each.pose
                corners = self._read(each.mesh, each.span_of("filename")) * np.array(each.scale)
                found.append(corners @ np.array(placed.rotation).T + np.array(placed.position))
            self._triangles = np.concatenate(found) if found else np.zeros((0, 3, 3))
        return self._triangles

    def with_hulls(self) -> list[Convex]:
        """Return what it collides with if the hulls of the meshes are what is worked out."""
        corners = np.unique(self.triangles.reshape(-1, 3), axis=0)
        return [*self.others, _Whole(IDENTITY, None, [*map(tuple, corners.tolist())])]


def check_fits(
    robot: Robot,
    context: CheckContext,
    *,
    resolve_mesh: Callable[[str, Span], str | None],
    may_read: Callable[[str], bool] | None,
) -> None:
    """Report links that collide at home, or nearly always, only since shapes were worked out.

    Left out are pairs that joints join or that cannot move, and links that also collide with a mesh
    as it is.
    """
    known: dict[str, Floats] = {}

    def read(filename: str, span: Span) -> Floats:
        path = resolve_mesh(filename, span)
        if path is None:
            raise ValueError(filename)
        if path not in known:
            mesh = read_mesh(path, may_read)
            known[path] = np.array(mesh.vertices)[np.array(mesh.triangles)]
        return known[path]

    fits: dict[str, list[Fitted]] = {name: [] for name in robot.links}
    for fitted in robot.fits:
        if fitted.section == "collision" and fitted.link in fits:
            fits[fitted.link].append(fitted)
    solid = {name: link for name, link in robot.links.items() if link.collisions}
    left_out = {frozenset(pair) for pair in adjacent_links(robot, solid)}
    if robot.collision_settings is not None:
        left_out |= {frozenset(pair) for pair in robot.collision_settings.keep}
    rigid = rigid_parts(robot, from_the_roots(robot))  # without links in a circle

    def may(one: str, other: str) -> bool:
        if rigid.get(one, one) == rigid.get(other, other) or not (fits[one] or fits[other]):
            return False
        return frozenset((one, other)) not in left_out

    def overlaps(
        positions: dict[str, float], names: Iterable[str]
    ) -> dict[tuple[str, str], tuple[_Body, _Body]]:
        poses, bodies = link_poses(robot, positions), {}
        for name in names:
            with suppress(MeshFileError, MissingLibraryError, ValueError):
                bodies[name] = _Body(solid[name], fits[name], poses[name], read)
        shapes = [(shape, name) for name, body in bodies.items() for shape in body.shapes]
        found = overlapping([shape for shape, _ in shapes], [name for _, name in shapes], may)
        pairs = [(shapes[first][1], shapes[second][1]) for first, second in found]
        return {pair: (bodies[pair[0]], bodies[pair[1]]) for pair in pairs}

    at_home = overlaps(home_positions(robot), solid)
    often: dict[tuple[str, str], list[tuple[_Body, _Body]]] = {}
    left = [name for name in solid if any(may(name, other) for other in solid)]
    for number, row in enumerate(_random_positions(robot)):
        for pair, bodies in overlaps(row, left).items():
            often.setdefault(pair, []).append(bodies)
        often = {
            pair: found
            for pair, found in often.items()
            if number + 1 - len(found) <= EXCEPT and pair not in at_home
        }
        left = [name for name in left if number < EXCEPT or any(name in pair for pair in often)]
        if not left:
            break
    with suppress(MeshFileError, MissingLibraryError):
        for bodies in at_home.values():
            if not _meet(*bodies):
                _report(*bodies, context, where="at home")
        for found in often.values():
            apart = (bodies for bodies in found if not _meet(*bodies))
            if next(islice(apart, EXCEPT, None), None):
                _report(*found[0], context, where="at nearly all positions")


def _random_positions(robot: Robot) -> Iterator[dict[str, float]]:
    """Yield positions of all joints that move independently, the same ones each time."""
    random = np.random.Generator(np.random.PCG64(1))
    for parts in random.random((TRIED, len(robot.joints))):
        found = {}
        for part, joint in zip(parts.tolist(), robot.free_joints(), strict=False):
            low, high = tried_range(joint)
            found[joint.name] = low + part * (high - low)
        yield found


def _meet(one: _Body, other: _Body) -> bool:
    """Return whether two links touch if they collide with the meshes of their fits."""
    return (
        _overlap(one.others, other.others)
        or any(_reaches(shape, other.triangles) for shape in one.others)
        or any(_reaches(shape, one.triangles) for shape in other.others)
        or are_crossing(one.triangles, other.triangles)
    )


def _overlap(some: Sequence[Convex], others: Sequence[Convex]) -> bool:
    owners = ["one"] * len(some) + ["other"] * len(others)
    return bool(overlapping([*some, *others], owners, str.__ne__))


def _reaches(shape: Convex, triangles: Floats) -> bool:
    """Return whether a convex shape reaches any of some triangles.

    Where it does not, a plane is between it and a triangle, which leaves out most others too.
    """
    while len(triangles):
        triangle = _Whole(IDENTITY, None, [*map(tuple, triangles[0].tolist())])
        is_reached, ways = witness(shape, triangle)
        if is_reached:
            return True
        is_left = np.ones(len(triangles), bool)
        if ways:
            is_left = (triangles @ ways[0]).min(axis=1) < np.dot(shape.farthest(ways[0]), ways[0])
        is_left[0] = False
        triangles = triangles[is_left]
    return False


def _report(one: _Body, other: _Body, context: CheckContext, *, where: str) -> None:
    """Report two links, at the fit that is farthest from its mesh, with fits that are apart."""
    worse, better = sorted(
        (one, other), key=lambda each: -max((fit.distance for fit in each.fits), default=-1.0)
    )
    fitted = max(worse.fits, key=lambda fit: fit.distance)
    if not _overlap(worse.with_hulls(), better.shapes):
        enough = [worse]
    elif better.fits and not _overlap(worse.shapes, better.with_hulls()):
        enough = [better]
    elif better.fits and not _overlap(worse.with_hulls(), better.with_hulls()):
        enough = [worse, better]
    else:
        enough = []
    hull, pieces = "fit: hull", "decompose: 8"
    if fitted.element.span.source.is_xml:
        hull, pieces = "--shape hull", "--decompose 8"
    what = hull if enough else pieces
    names = " and ".join([f"'{each.link}'" for each in enough or (worse, better) if each.fits])
    notes = [f"the shape of '{each.link}' is at {each.span.place()}" for each in better.fits[:1]]
    context.report(
        "fits-overlap",
        f"the links '{worse.link}' and '{better.link}' overlap {where} though their meshes do not, "
        "so MoveIt never checks this pair",
        fitted.element,
        missing=better.link,  # for one shape, each other link is reported
        hint=f"try {what} for {names}{', with which they are apart' if enough else ''}",
        notes=notes,
    )
