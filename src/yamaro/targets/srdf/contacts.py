"""The collision shapes of a robot in pinocchio and coal, which measure how far apart they are.

Positions are rows of numbers, one for each joint of one degree of freedom that follows no other.
Joints that mimic one follow it; planar and floating ones stay at 0.
"""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING, Any

import coal
import numpy as np
import pinocchio

from ...diagnostics import failure
from ...meshes.formats import MeshFileError, MissingLibraryError
from ...meshes.triangles import read_mesh
from ...model.joint import PRISMATIC, SINGLE
from ...model.positions import tried_range
from ...model.shapes import Box, Capsule, Cylinder, Sphere
from .pairs import ALWAYS, DEFAULT, NEVER

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from ...model.joint import Joint
    from ...model.link import Collision
    from ...model.pose import Pose
    from ...model.robot import Robot
    from ...model.shapes import Mesh
    from ..output import Wanted

    Floats = NDArray[np.float64]
    LinkPair = tuple[str, str]


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
        self.lower, self.upper = np.zeros(len(self.joints)), np.zeros(len(self.joints))
        for column, joint in enumerate(self.joints):
            self.lower[column], self.upper[column] = tried_range(joint)
        self._model = pinocchio.Model()
        self._homes: dict[str, tuple[int, Any]] = {}
        self._columns: dict[str, int] = {}
        self._add_joints()
        # F and o, with which F @ row + o are the positions of all joints of the tree.
        self._factors = np.zeros((self._model.nq, len(self.joints)))
        self._offsets = np.zeros(self._model.nq)
        columns = {joint.name: column for column, joint in enumerate(self.joints)}
        for name, number in self._columns.items():
            leader, factor, self._offsets[number] = self._followed(self._robot.joints[name])
            if leader is not None:
                self._factors[number, columns[leader]] = factor
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
            try:
                mesh = read_mesh(path, self._wanted.paths.finder.allows)
            except (MeshFileError, MissingLibraryError) as error:
                raise failure("bad-mesh", f"'{shape.filename}': {error}", span) from None
            made = coal.BVHModelOBBRSS()
            made.beginModel(len(mesh.triangles), len(mesh.vertices))
            made.addVertices(np.array(mesh.vertices, dtype=float) * np.array(shape.scale))
            made.addTriangles(np.array(mesh.triangles))
            made.endModel()
            self._meshes[path, shape.scale] = made
        if not is_hull:
            return made
        if made.convex is None:
            made.buildConvexHull(True, "Qt")
        return made.convex

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
        nearest = min(found, key=lambda result: float(result.min_distance), default=None)
        if nearest is None or nearest.min_distance <= 0:
            return (np.inf if nearest is None else 0.0), slope
        one, other = nearest.getNearestPoint1(), nearest.getNearestPoint2()
        px, py, pz = one.tolist()
        nx, ny, nz = (other - one).tolist()
        # Far quicker than numpy for so few numbers, which counts in the search.
        length = max(hypot(nx, ny, nz), 1e-12)
        nx, ny, nz = nx / length, ny / length, nz / length
        line = np.array([nx, ny, nz, py * nz - pz * ny, pz * nx - px * nz, px * ny - py * nx])
        pinocchio.computeJointJacobians(self._model, self._data)
        grows = self._sense(self.pairs[number]) * (line @ self._data.J)
        return float(nearest.min_distance), grows @ self._factors

    def _place(self, shapes: _Shapes, row: Floats) -> None:
        positions = np.asarray(self._factors @ row + self._offsets)  # followers too
        pinocchio.updateGeometryPlacements(
            self._model, self._data, shapes.model, shapes.data, positions
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


def _se3(pose: Pose) -> Any:
    return pinocchio.SE3(np.array(pose.rotation), np.array(pose.position))


# --- sampling ---------------------------------------------------------------------------------


CHUNK = 250
"""Samples that one stream of random numbers gives."""
NEARLY_ALWAYS = 0.95
"""The part of positions at which a pair touches that touches always. Source: MoveIt."""
STARTS, STEPS, HALVINGS = 6, 50, 8
"""From how many near positions a contact is searched, in how many steps, each halved how often."""
LONGEST_STEP = 0.5
"""Radians or metres that a joint moves in one step."""
OVERSHOOT = 1.05
"""How far a step goes beyond where the distance would be 0 if it fell evenly."""
FLAT = 1e-12
"""The square of a slope, in m²/rad², that leads nowhere."""


def reasons_for(
    robot: Robot, pairs: Sequence[LinkPair], wanted: Wanted, *, samples: int, seed: int
) -> dict[LinkPair, str]:
    """Return the pairs that need no check, with the reason.

    Args:
        robot: the robot.
        pairs: the pairs that are not adjacent.
        wanted: finds meshes, and takes how far the work is.
        samples: how many random positions are tried.
        seed: of the random numbers.

    Raises:
        YamaroError: pinocchio is not installed, or a mesh cannot be read.
    """
    return _Sampling(robot, pairs, wanted, samples=samples, seed=seed).run()


class _Sampling:
    """The search for pairs of one robot."""

    def __init__(
        self,
        robot: Robot,
        pairs: Sequence[LinkPair],
        wanted: Wanted,
        *,
        samples: int,
        seed: int,
    ) -> None:
        self._scene = Scene(robot, pairs, wanted)
        self._samples = samples
        self._seed = seed
        self._tell = wanted.progress
        states = robot.states
        home = states.get("home") or next(iter(states.values()), None)
        self._home = self._scene.row_of(home.positions if home is not None else {})

    def run(self) -> dict[LinkPair, str]:
        """Return the pairs that need no check, with the reason."""
        scene = self._scene
        touch = scene.touching(self._home)
        found = {pair: DEFAULT for pair, is_so in zip(scene.pairs, touch, strict=True) if is_so}
        scene.keep([pair for pair, is_so in zip(scene.pairs, touch, strict=True) if not is_so])
        counts = self._sample()
        never = []
        for pair, count in zip(scene.pairs, counts, strict=True):
            if count >= NEARLY_ALWAYS * self._samples:
                found[pair] = ALWAYS
            elif count == 0:
                never.append(pair)
        scene.keep(never)
        found |= dict.fromkeys(self._without_contact(), NEVER)
        return found

    def _chunk(self, number: int) -> Floats:
        """Return random positions as rows, always the same ones for a seed and a number."""
        random = np.random.Generator(np.random.PCG64([self._seed, number]))
        first = number * CHUNK
        count = max(min(CHUNK, self._samples - first), 0)
        scene = self._scene
        parts = random.random((count, len(scene.joints)))
        return scene.lower + parts * (scene.upper - scene.lower)

    def _sample(self) -> Floats:
        """Return at how many positions each pair touches; those that do at some leave early."""
        scene = self._scene
        every = scene.pairs
        counts = dict.fromkeys(every, 0)
        chunks = -(-self._samples // CHUNK)
        for number in range(chunks):
            rows = self._chunk(number)
            found = np.array([scene.touching(row) for row in rows])
            for pair, count in zip(scene.pairs, found.sum(axis=0), strict=True):
                counts[pair] += int(count)
            tried = number * CHUNK + len(rows)
            most = self._samples - tried
            still = [
                pair
                for pair in scene.pairs
                if counts[pair] == 0 or counts[pair] + most >= NEARLY_ALWAYS * self._samples
            ]
            if len(still) < len(scene.pairs):
                scene.keep(still)
            self._say(0.8 * (number + 1) / chunks)
        scene.keep(every)
        return np.array([counts[pair] for pair in every])

    def _say(self, part: float) -> None:
        if self._tell is not None:
            self._tell(part)

    # --- the search for rare contacts ---

    def _without_contact(self) -> list[LinkPair]:
        """Return the pairs for which no contact is found from the positions nearest to one."""
        scene = self._scene
        if not scene.pairs:
            return []
        scene.measure()
        rows = np.array([self._home, *self._chunk(0), *self._chunk(1)])
        distances = np.array([scene.distances(row) for row in rows])
        found = []
        for number, pair in enumerate(scene.pairs):
            self._say(0.8 + 0.2 * number / len(scene.pairs))
            starts = np.argsort(distances[:, number], kind="stable")[:STARTS]
            if not scene.moves(pair) or not any(
                self._reaches(number, rows[start]) for start in starts
            ):
                found.append(pair)
        self._say(1.0)
        return found

    def _reaches(self, number: int, row: Floats) -> bool:
        """Return whether going down the distance of a pair ends in a contact."""
        scene = self._scene
        best, slope = scene.distance(number, row)
        for _ in range(STEPS):
            if best <= 0:
                return bool(scene.touching(row)[number])
            at_end = ((row <= scene.lower) & (slope > 0)) | ((row >= scene.upper) & (slope < 0))
            way = np.where(at_end, 0.0, slope)
            steepness = float(way @ way)
            if steepness < FLAT:
                return False
            step = min(OVERSHOOT * best / steepness, LONGEST_STEP / float(np.abs(way).max()))
            for _ in range(HALVINGS):
                tried = np.clip(row - step * way, scene.lower, scene.upper)
                distance, new_slope = scene.distance(number, tried)
                if distance < best:
                    break
                step /= 2
            else:
                return False
            row, best, slope = tried, distance, new_slope
        return False
