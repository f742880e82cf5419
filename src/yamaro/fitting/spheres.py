"""Spheres that together have the shape of a mesh, for planners that know only spheres.

Points of the surface are shared among spheres, each with the sphere that is nearest to it, and
each sphere moves to where it holds its points and reaches out of the mesh the least; then points
are shared again. Source: R. Wang et al., Variational sphere set approximation for solid objects,
The Visual Computer 22, 2006. A sphere reaches out by its radius less the distance from its middle
to the surface, if the middle is inside. The first spheres are large ones in the mesh, one after the
other at the point that is farthest from those before. In the end spheres that are hardly needed are
taken away, and put where others reach out the farthest.
"""

from __future__ import annotations

from math import floor, log10
from typing import TYPE_CHECKING

import numpy as np

from .sampling import Solid, arrays_of

if TYPE_CHECKING:
    from ..meshes.triangles import TriangleMesh
    from ..model.pose import Vector
    from .sampling import Floats, Whole

SHARINGS = 8
"""How often points are shared again."""
STEPS = 16
"""How often a sphere moves before points are shared again."""
TRIES = 16
"""How often a sphere is taken away and put elsewhere."""
SAVING = 1e-5
"""By how much of the size that has to be better."""
FINEST = 0.004
"""The edges of the triangles into which the surface is cut to see that it is held, by its size."""
DIGITS = 7
"""Digits of a comparison, as a part of the size of the mesh: the rest differs between machines."""
_STEPS = [(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if x or y or z]
WAYS: Floats = np.array(_STEPS, float) / np.linalg.norm(_STEPS, axis=1)[:, None]


def spheres_of(mesh: TriangleMesh, count: int, *, cover: bool) -> list[tuple[Vector, float]]:
    """Return the middles and radii of at most `count` spheres, in metres, the largest first.

    Args:
        mesh: the mesh; it may be open.
        count: the greatest number of spheres.
        cover: whether they have to hold all of the surface. Otherwise a sphere reaches out of the
            mesh as far as points of the surface are out of the sphere.

    Raises:
        MeshFileError: the mesh has no triangles.
    """
    points, triangles = arrays_of(mesh)
    solid = Solid(points, triangles)
    best = min(
        _improved(solid, *_begin(solid, count)),
        _divided(solid, count),
        key=lambda found: found.cost,
    )
    best = _rearranged(solid, best)
    radii: Floats = best.radii
    if cover:
        radii = _covering(points[triangles], best.centers, radii, FINEST * solid.size)
    else:
        radii = radii - best.outside / 2
    order = np.argsort(-np.round(radii / solid.size, DIGITS), kind="stable")
    decimals = max(9, 6 - floor(log10(solid.size)))
    slack = 10.0**-decimals if cover else 0.0
    found = []
    for index in order:
        x, y, z = (round(float(each), decimals) for each in best.centers[index])
        found.append(((x, y, z), round(float(radii[index]) + 2 * slack, decimals)))
    return found


class Spheres:
    """Spheres, each with the points that it holds.

    Attributes:
        centers: their middles, N×3.
        radii: the distances to the farthest of their points.
        outside: how far each reaches out of the mesh.
        owners: the sphere of each point.
        cost: what is to be small: the greatest of `outside`, and its mean over the points.
    """

    __slots__ = ("centers", "cost", "outside", "owners", "radii")

    def __init__(self, solid: Solid, centers: Floats, owners: Whole) -> None:
        self.centers = centers
        self.owners = owners
        apart = np.linalg.norm(solid.points - centers[owners], axis=1)
        self.radii: Floats = np.zeros(len(centers))
        np.maximum.at(self.radii, owners, apart)
        self.outside = np.maximum(self.radii + solid.distances(centers), 0.0)
        held = np.bincount(owners, minlength=len(centers))
        self.cost = float(self.outside.max()) + float(self.outside @ held) / len(owners)


def _begin(solid: Solid, count: int) -> tuple[Floats, Floats]:
    """Return the middles and radii of the first spheres."""
    rounded = np.round(solid.depths / solid.size, DIGITS)
    chosen = [int(rounded.argmax())]
    gap = np.linalg.norm(solid.points - solid.inner[chosen[0]], axis=1) - solid.depths[chosen[0]]
    while len(chosen) < count:
        point = solid.points[int(np.round(gap / solid.size, DIGITS).argmax())]
        missed = np.linalg.norm(solid.inner - point, axis=1) - solid.depths
        worth = np.round((solid.depths - 4 * missed) / solid.size, DIGITS)
        worth[chosen] = -np.inf
        index = int(worth.argmax())
        if worth[index] == -np.inf:
            break
        chosen.append(index)
        apart = np.linalg.norm(solid.points - solid.inner[index], axis=1) - solid.depths[index]
        gap = np.minimum(gap, apart)
    return solid.inner[chosen], solid.depths[chosen]


def _improved(solid: Solid, centers: Floats, radii: Floats) -> Spheres:
    """Return the best spheres that sharing and moving in turn lead to."""
    best: Spheres | None = None
    for _ in range(SHARINGS):
        apart = np.linalg.norm(solid.points[:, None] - centers[None], axis=2) - radii
        owners = np.round(apart / solid.size, DIGITS).argmin(axis=1)
        used, owners = np.unique(owners, return_inverse=True)
        found = Spheres(solid, _settled(solid, centers[used], owners), owners)
        if best is not None and not found.cost < best.cost - 10.0**-DIGITS * solid.size:
            break
        best = found
        centers, radii = found.centers, found.radii - found.outside / 2
    assert best is not None
    return best


def _settled(solid: Solid, centers: Floats, owners: Whole) -> Floats:
    """Return the middles moved to where each sphere holds its points and reaches out the least.

    A step goes in the best of some directions; if there is none, the next one is half as long.
    """
    order = np.argsort(owners, kind="stable")
    starts = np.searchsorted(owners[order], np.arange(len(centers)))
    held = np.split(solid.points[order], starts[1:])
    held = [_farthest(each) for each in held]
    steps = np.array([float(np.ptp(each, axis=0).max()) / 4 for each in held])
    ways = np.concatenate([np.zeros((1, 3)), WAYS])
    for _ in range(STEPS):
        tried = centers[:, None] + ways[None] * steps[:, None, None]
        reach = solid.distances(tried.reshape(-1, 3)).reshape(len(centers), -1)
        for index, points in enumerate(held):
            reach[index] += np.linalg.norm(tried[index][:, None] - points[None], axis=2).max(axis=1)
        best = np.round(reach / solid.size, DIGITS).argmin(axis=1)
        centers = tried[np.arange(len(centers)), best]
        steps = np.where(best == 0, steps / 2, steps)
    return centers


def _farthest(points: Floats) -> Floats:
    """Return the points that are the farthest ones in some direction.

    Another point may be the farthest from a middle: radii are worked out with all of them.
    """
    if len(points) <= 2 * len(DIRECTIONS):
        return points
    found: Floats = points[np.unique((points @ DIRECTIONS.T).argmax(axis=0))]
    return found


def _ball(count: int) -> Floats:
    """Return directions spread evenly over a sphere, by the golden angle."""
    turns = np.arange(count) * (np.pi * (3 - 5**0.5))
    z = 1 - (2 * np.arange(count) + 1) / count
    side = np.sqrt(1 - z * z)
    return np.column_stack([np.cos(turns) * side, np.sin(turns) * side, z])


DIRECTIONS = _ball(40)


def _divided(solid: Solid, count: int) -> Spheres:
    """Return spheres made of one, each time by two in place of one that reaches out much."""
    found = _improved(solid, *_begin(solid, 1))
    while (size := len(found.centers)) < count:
        for worst in np.argsort(-np.round(found.outside / solid.size, DIGITS), kind="stable")[:4]:
            more = _improved(solid, *_halved(solid, found, int(worst), size))
            if len(more.centers) > size:
                break
        else:
            break
        found = more
    return found


def _rearranged(solid: Solid, best: Spheres) -> Spheres:
    """Return the spheres after those hardly needed went to where others reach out the most."""
    tries = 0
    while tries < TRIES and len(best.centers) > 1:
        apart = np.linalg.norm(best.centers[:, None] - best.centers, axis=2) + best.radii[:, None]
        np.fill_diagonal(apart, np.inf)
        # How far another sphere reaches out if it holds this one too.
        without = np.round((apart - best.radii + best.outside).min(axis=1) / solid.size, DIGITS)
        worst = np.argsort(-np.round(best.outside / solid.size, DIGITS), kind="stable")[:3]
        least = np.argsort(without, kind="stable")[:5]
        pairs = [(one, other) for one in worst for other in least if one != other]
        pairs.sort(key=lambda pair: without[pair[1]] - best.outside[pair[0]] / solid.size)
        for one, other in pairs[: TRIES - tries]:
            tries += 1
            found = _improved(solid, *_halved(solid, best, one, other))
            if found.cost < best.cost - SAVING * solid.size:
                best = found
                break
        else:
            break
    return best


def _halved(solid: Solid, spheres: Spheres, one: int, other: int) -> tuple[Floats, Floats]:
    """Return middles and radii in which a sphere is two: itself and another one, or a new one."""
    points = solid.points[spheres.owners == one]
    offsets = points - points.mean(axis=0)
    axis = np.linalg.eigh(offsets.T @ offsets)[1][:, 2]
    axis = np.round(axis * np.sign(axis[np.abs(np.round(axis, 6)).argmax()]), 6)
    shift = axis * float((offsets @ axis).std())
    radii = spheres.radii - spheres.outside / 2
    centers = spheres.centers
    if other == len(centers):
        centers, radii = np.concatenate([centers, centers[:1]]), np.append(radii, 0.0)
    centers, radii = centers.copy(), radii.copy()
    centers[one], centers[other] = points.mean(axis=0) - shift, points.mean(axis=0) + shift
    radii[one] = radii[other] = 0.7 * radii[one]
    return centers, radii


def _covering(triangles: Floats, centers: Floats, radii: Floats, finest: float) -> Floats:
    """Return the radii with which the spheres hold all triangles, N×3×3.

    A triangle whose corners are all in one sphere is held. Others are cut in four as long as they
    are large; then the sphere that has to grow the least grows.
    """
    radii = radii.copy()
    pending = triangles
    while len(pending):
        left, needs = [], []
        for start in range(0, len(pending), 4096):
            some = pending[start : start + 4096]
            reach = np.linalg.norm(some[:, :, None] - centers, axis=3).max(axis=1) - radii
            is_out = reach.min(axis=1) > 0
            left.append(some[is_out])
            needs.append(reach[is_out])
        pending, reach = np.concatenate(left), np.concatenate(needs)
        sides = np.linalg.norm(pending - np.roll(pending, 1, axis=1), axis=2).max(axis=1)
        is_small = sides <= finest
        for index in np.flatnonzero(is_small):
            far = np.linalg.norm(pending[index][:, None] - centers, axis=2).max(axis=0) - radii
            if far.min() > 0:
                radii[far.argmin()] += far.min()
        a, b, c = np.moveaxis(pending[~is_small], 1, 0)
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        pending = np.concatenate([np.stack(part, axis=1) for part in parts])
    return radii
