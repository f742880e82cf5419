"""The collision shapes of a robot in pinocchio and coal, which measure how far apart they are.

Positions are rows of numbers, one for each joint of one degree of freedom that follows no other.
Joints that mimic one follow it; planar and floating ones stay at 0.
"""

from __future__ import annotations

from math import hypot, pi
from typing import TYPE_CHECKING, Any

import coal
import numpy as np
import pinocchio

from ...diagnostics import failure
from ...meshes.formats import MeshFileError, MissingLibraryError
from ...meshes.triangles import read_mesh
from ...model.joint import PRISMATIC, SINGLE
from ...model.shapes import Box, Capsule, Cylinder, Sphere

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from ...model.joint import Joint
    from ...model.link import Collision
    from ...model.pose import Pose
    from ...model.robot import Robot
    from ...model.shapes import Mesh
    from ...source import Span
    from ..output import Wanted

    Floats = NDArray[np.float64]
    LinkPair = tuple[str, str]

REACH = 1.0
"""Metres that a prismatic joint without limits is tried along, either way."""
UNLIMITED = 1e4
"""Metres or radians beyond which a limit is ignored: some write the greatest number there is."""


class Scene:
    """Collision shapes on joints.

    Attributes:
        joints: the joints that follow no other, in the order of a row of positions.
        lower, upper: their limits, in radians or metres.
        pairs: the pairs of links that are looked at.
    """

    def __init__(self, robot: Robot, pairs: Sequence[LinkPair], wanted: Wanted) -> None:
        """Read the shapes of the links in `pairs`.

        Raises:
            YamaroError: a mesh cannot be read.
        """
        self._robot = robot
        self._wanted = wanted
        self.joints = [joint for joint in robot.joints.values() if joint.is_free]
        self.lower, self.upper = _limits(self.joints)
        self._model = pinocchio.Model()
        self._homes: dict[str, tuple[int, Any]] = {}
        self._columns: dict[str, int] = {}
        self._add_joints()
        self._factors, self._offsets = self._following()
        self._senses: dict[LinkPair, Floats] = {}
        self._data = self._model.createData()
        self._meshes: dict[tuple[str, tuple[float, ...]], Any] = {}
        self._exact = _Shapes()
        self._hulls = _Shapes()
        self._fill(self._exact, {link for pair in pairs for link in pair}, is_hull=False)
        self.pairs: list[LinkPair] = []
        self.keep(pairs)

    # --- the tree ---

    def _add_joints(self) -> None:
        """Add the joints that turn or slide; what is fixed between them is in their placement."""
        robot = self._robot
        waiting = [(root.name, 0, pinocchio.SE3.Identity()) for root in robot.roots]
        for link, number, placement in waiting:
            self._homes[link] = (number, placement)
            for joint in robot.joints_below(link):
                at = placement * _se3(joint.origin)
                if joint.type in SINGLE:
                    axis = np.array(joint.axis)
                    kind = (
                        pinocchio.JointModelPrismaticUnaligned(axis)
                        if joint.type == PRISMATIC
                        else pinocchio.JointModelRevoluteUnaligned(axis)
                    )
                    below = self._model.addJoint(number, kind, at, joint.name)
                    self._columns[joint.name] = self._model.joints[below].idx_q
                    waiting.append((joint.child, below, pinocchio.SE3.Identity()))
                else:
                    waiting.append((joint.child, number, at))

    def _following(self) -> tuple[Floats, Floats]:
        """Return F and o, with which F @ row + o are the positions of all joints of the tree."""
        factors = np.zeros((self._model.nq, len(self.joints)))
        offsets = np.zeros(self._model.nq)
        columns = {joint.name: column for column, joint in enumerate(self.joints)}
        for name, number in self._columns.items():
            leader, factor, offsets[number] = self._followed(self._robot.joints[name])
            if leader is not None:
                factors[number, columns[leader]] = factor
        return factors, offsets

    def _followed(self, joint: Joint) -> tuple[str | None, float, float]:
        """Return the joint that decides the position of another, a factor and an offset."""
        factor, offset, seen = 1.0, 0.0, {joint.name}
        while joint.mimic is not None:
            offset += factor * joint.mimic.offset
            factor *= joint.mimic.multiplier
            leader = self._robot.joints.get(joint.mimic.joint)
            if leader is None or leader.name in seen or leader.type not in SINGLE:
                return (None, 0.0, offset)
            seen.add(leader.name)
            joint = leader
        return (joint.name, factor, offset)

    def _full(self, row: Floats) -> Floats:
        """Return the positions of all joints of the tree, followers too."""
        return np.asarray(self._factors @ row + self._offsets)

    def row_of(self, positions: Mapping[str, float]) -> Floats:
        """Return a row for named positions; joints that are left out rest."""
        return np.array([positions.get(joint.name, joint.rest) for joint in self.joints])

    def moves(self, pair: LinkPair) -> bool:
        """Return whether a joint moves one link of a pair against the other."""
        return bool((self._factors[self._sense(pair) != 0] != 0).any())

    def _sense(self, pair: LinkPair) -> Floats:
        """Return for each joint of the tree 1 if it moves the second link only, -1 the first."""
        sense = self._senses.get(pair)
        if sense is None:
            first, second = (self._way_to(link) for link in pair)
            signs = ((name in second) - (name in first) for name in self._columns)
            sense = np.zeros(self._model.nq)
            sense[list(self._columns.values())] = list(signs)
            self._senses[pair] = sense
        return sense

    def _way_to(self, link: str) -> set[str]:
        found: set[str] = set()
        joint = self._robot.parent_joint(link)
        while joint is not None and joint.name not in found:
            found.add(joint.name)
            joint = self._robot.parent_joint(joint.parent)
        return found

    # --- shapes ---

    def _fill(self, shapes: _Shapes, links: set[str], *, is_hull: bool) -> None:
        for name, (number, placement) in self._homes.items():
            for index, collision in enumerate(self._robot.links[name].collisions):
                if name not in links:
                    continue
                shape = self._shape(collision, is_hull=is_hull)
                if shape is not None:
                    at = placement * _se3(collision.pose)
                    each = pinocchio.GeometryObject(f"{name}_{index}", number, 0, at, shape)
                    shapes.add(name, each)

    def _shape(self, collision: Collision, *, is_hull: bool) -> Any:
        shape = collision.shape
        if isinstance(shape, Box):
            return coal.Box(*shape.size)
        if isinstance(shape, Sphere):
            return coal.Sphere(shape.radius)
        if isinstance(shape, Cylinder):
            return coal.Cylinder(shape.radius, shape.length)
        if isinstance(shape, Capsule):
            return coal.Capsule(shape.radius, shape.length)
        if shape is None or not self._wanted.has_meshes:
            return None
        return self._mesh(shape, collision, is_hull=is_hull)

    def _mesh(self, shape: Mesh, collision: Collision, *, is_hull: bool) -> Any:
        finder = self._wanted.paths.finder
        span = shape.span or collision.span
        path = finder.reachable(shape.filename, span)
        if path is None:
            raise failure(
                "missing-mesh-file",
                f"the mesh '{shape.filename}' is not found, so that nothing is known of what it "
                "touches",
                span,
                hint="--meshes none leaves out meshes",
            )
        made = self._meshes.get((path, shape.scale))
        if made is None:  # links often share one, and each is asked for twice: for its hull as well
            made = self._meshes[path, shape.scale] = self._triangles(path, shape, span)
        if not is_hull:
            return made
        if made.convex is None:
            made.buildConvexHull(True, "Qt")
        return made.convex

    def _triangles(self, path: str, shape: Mesh, span: Span) -> Any:
        """Return the triangles in a file, scaled."""
        try:
            mesh = read_mesh(path, self._wanted.paths.finder.allows)
        except (MeshFileError, MissingLibraryError) as error:
            raise failure("bad-mesh", f"'{shape.filename}': {error}", span) from None
        made = coal.BVHModelOBBRSS()
        made.beginModel(len(mesh.triangles), len(mesh.vertices))
        made.addVertices(np.array(mesh.vertices, dtype=float) * np.array(shape.scale))
        made.addTriangles(np.array(mesh.triangles))
        made.endModel()
        return made

    # --- questions ---

    def keep(self, pairs: Sequence[LinkPair]) -> None:
        """Look at these pairs only."""
        self.pairs = list(pairs)
        self._exact.pair(self.pairs)

    def touching(self, row: Floats) -> NDArray[np.bool_]:
        """Return for each pair whether its links touch at a position."""
        found, shapes = np.zeros(len(self.pairs), dtype=bool), self._exact
        if len(shapes.owners):
            self._place(shapes, row)
            if pinocchio.computeCollisions(shapes.model, shapes.data, False):
                flags = [each.isCollision() for each in shapes.data.collisionResults]
                found[shapes.owners[np.array(flags)]] = True
        return found

    def measure(self) -> None:
        """Prepare `distances`: meshes are measured by their hulls, which is quicker."""
        self._hulls = _Shapes()
        self._fill(self._hulls, {link for pair in self.pairs for link in pair}, is_hull=True)
        self._hulls.pair(self.pairs)

    def distances(self, row: Floats) -> Floats:
        """Return how far apart the hulls of each pair are, in metres; not above 0 if they touch."""
        hulls, found = self._hulls, np.full(len(self.pairs), np.inf)
        self._place(hulls, row)
        pinocchio.computeDistances(hulls.model, hulls.data)
        every = [each.min_distance for each in hulls.data.distanceResults]
        np.minimum.at(found, hulls.owners, np.array(every))
        return found

    def distance(self, number: int, row: Floats) -> tuple[float, Floats]:
        """Return the distance of one pair, see `distances`, and how it grows with each column.

        With p1 and p2 the nearest points, n the unit vector from p1 to p2, and v1, v2 how they move
        with a joint, the derivative is n·(v2 - v1). A joint gives a point p the speed v + w×p,
        with v and w its column of the Jacobian; so n·(v + w×p) = n·v + (p×n)·w, and p×n is the
        same for both points, since they lie on a line along n.
        """
        hulls = self._hulls
        self._place(hulls, row)
        slope = np.zeros(len(row))
        found = [
            pinocchio.computeDistance(hulls.model, hulls.data, index)
            for index in hulls.numbers[number]
        ]
        nearest = min(found, key=_min_distance, default=None)
        if nearest is None or nearest.min_distance <= 0:
            return (np.inf if nearest is None else 0.0), slope
        line = _line_through(nearest.getNearestPoint1(), nearest.getNearestPoint2())
        pinocchio.computeJointJacobians(self._model, self._data)
        grows = self._sense(self.pairs[number]) * (line @ self._data.J)
        return float(nearest.min_distance), grows @ self._factors

    def _place(self, shapes: _Shapes, row: Floats) -> None:
        pinocchio.updateGeometryPlacements(
            self._model, self._data, shapes.model, shapes.data, self._full(row)
        )


class _Shapes:
    """Shapes on the links, and the pairs of them that are looked at.

    Attributes:
        model: pinocchio's model of them.
        data: what is computed for a position.
        owners: for each pair of shapes, the number of the pair of links that it is of.
        numbers: for each pair of links, the numbers of its pairs of shapes.
    """

    def __init__(self) -> None:
        self.model = pinocchio.GeometryModel()
        self.data: Any = None
        self.owners: NDArray[np.int_] = np.array([], dtype=int)
        self.numbers: list[list[int]] = []
        self._of: dict[str, list[int]] = {}

    def add(self, link: str, shape: Any) -> None:
        """Add a shape of a link."""
        self._of.setdefault(link, []).append(self.model.addGeometryObject(shape))

    def pair(self, pairs: Sequence[LinkPair]) -> None:
        """Look at these pairs of links."""
        self.model.removeAllCollisionPairs()
        owners: list[int] = []
        self.numbers = []
        for number, (first, second) in enumerate(pairs):
            self.numbers.append([])
            for one in self._of.get(first, ()):
                for other in self._of.get(second, ()):
                    self.model.addCollisionPair(pinocchio.CollisionPair(one, other))
                    self.numbers[-1].append(len(owners))
                    owners.append(number)
        self.owners = np.array(owners, dtype=int)
        self.data = self.model.createData()


def _line_through(one: Floats, other: Floats) -> Floats:
    """Return the unit vector n from a point p to another, and p×n, as a row of six numbers."""
    px, py, pz = one.tolist()
    nx, ny, nz = (other - one).tolist()
    # Far quicker than numpy for so few numbers, which counts in the search.
    length = max(hypot(nx, ny, nz), 1e-12)
    nx, ny, nz = nx / length, ny / length, nz / length
    return np.array([nx, ny, nz, py * nz - pz * ny, pz * nx - px * nz, px * ny - py * nx])


def _min_distance(result: Any) -> float:
    return float(result.min_distance)


def _limits(joints: Sequence[Joint]) -> tuple[Floats, Floats]:
    lower, upper = [], []
    for joint in joints:
        low, high = joint.lower, joint.upper
        if low is None or high is None or max(abs(low), abs(high)) > UNLIMITED:
            reach = REACH if joint.type == PRISMATIC else pi
            low, high = -reach, reach
        lower.append(min(low, high))
        upper.append(max(low, high))
    return np.array(lower), np.array(upper)


def _se3(pose: Pose) -> Any:
    return pinocchio.SE3(np.array(pose.rotation), np.array(pose.position))
