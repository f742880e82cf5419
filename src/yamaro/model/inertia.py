"""Inertia: the integrals over the body that a mesh encloses, and the principal axes."""

from __future__ import annotations

from math import copysign, hypot, sqrt

from .pose import UNTURNED

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..meshes.triangles import TriangleMesh
    from .pose import Rotation, Vector

    Rows = list[list[float]]

MESH_ENDINGS = (
    "stl", "dae", "obj", "glb", "gltf", "ply", "off", "3mf", "3ds", "fbx", "x3d", "wrl",
    "mesh", "msh", "step", "stp", "usd", "usda", "usdc", "usdz",
)  # fmt: skip
"""File endings by which a geometry is taken for a mesh, in lower case."""


class SolidMoments:
    """Volume integrals of the body that a mesh encloses, for density 1.

    Attributes:
        volume: ∫ dV, in m³, never negative.
        first: ∫ x dV, three numbers, in m⁴.
        second: ∫ x·xᵀ dV as xx, xy, xz, yy, yz, zz, in m⁵.
    """

    __slots__ = ("first", "second", "volume")

    def __init__(self, volume: float, first: Vector, second: tuple[float, ...]) -> None:
        self.volume = volume
        self.first = first
        self.second = second

    def scaled(self, scale: Vector) -> SolidMoments:
        """Return the integrals of the body stretched along its axes; a mirrored body has volume."""
        sx, sy, sz = scale
        factor = abs(sx * sy * sz)
        x, y, z = self.first
        pairs = (sx * sx, sx * sy, sx * sz, sy * sy, sy * sz, sz * sz)
        return SolidMoments(
            factor * self.volume,
            (factor * sx * x, factor * sy * y, factor * sz * z),
            tuple(factor * p * s for p, s in zip(pairs, self.second, strict=True)),
        )

    def center(self) -> Vector:
        """Return the centre of mass of the homogeneous body, in metres."""
        x, y, z = self.first
        return (x / self.volume, y / self.volume, z / self.volume)


def solid_moments(mesh: TriangleMesh) -> SolidMoments:
    """Return the volume integrals of a closed mesh, summed over tetrahedra.

    Every triangle a, b, c makes a tetrahedron with a point o near the mesh. With d = a·(b × c),
    relative to o, and s = a + b + c: ∫dV = d/6, ∫x dV = d/24·s, and
    ∫x·xᵀ dV = d/120·(a·aᵀ + b·bᵀ + c·cᵀ + s·sᵀ). A mesh turned inside out gives the same body.

    Source: J. Blow and A. J. Binstock, How to find the inertia tensor (or other mass properties)
    of a 3D solid body represented by a triangle mesh, 2004.
    """
    # About the middle of the bounding box: far from the origin the sums would lose digits.
    lows = [min(axis) for axis in zip(*mesh.vertices, strict=True)]
    highs = [max(axis) for axis in zip(*mesh.vertices, strict=True)]
    ox, oy, oz = ((low + high) / 2 for low, high in zip(lows, highs, strict=True))
    points = [(x - ox, y - oy, z - oz) for x, y, z in mesh.vertices]
    volume = mx = my = mz = xx = xy = xz = yy = yz = zz = 0.0
    for i, j, k in mesh.triangles:
        ax, ay, az = points[i]
        bx, by, bz = points[j]
        cx, cy, cz = points[k]
        d = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
        sx, sy, sz = ax + bx + cx, ay + by + cy, az + bz + cz
        volume += d
        mx += d * sx
        my += d * sy
        mz += d * sz
        xx += d * (ax * ax + bx * bx + cx * cx + sx * sx)
        xy += d * (ax * ay + bx * by + cx * cy + sx * sy)
        xz += d * (ax * az + bx * bz + cx * cz + sx * sz)
        yy += d * (ay * ay + by * by + cy * cy + sy * sy)
        yz += d * (ay * az + by * bz + cy * cz + sy * sz)
        zz += d * (az * az + bz * bz + cz * cz + sz * sz)
    sign = -1.0 if volume < 0 else 1.0
    second = (xx, xy, xz, yy, yz, zz)
    return _moved(
        sign * volume / 6,
        (sign * mx / 24, sign * my / 24, sign * mz / 24),
        tuple(sign * value / 120 for value in second),
        (ox, oy, oz),
    )


def _moved(volume: float, first: Vector, second: tuple[float, ...], offset: Vector) -> SolidMoments:
    """Return integrals that were taken about `offset`, about the origin (parallel axes)."""
    mx, my, mz = first
    ox, oy, oz = offset
    xx, xy, xz, yy, yz, zz = second
    return SolidMoments(
        volume,
        (mx + volume * ox, my + volume * oy, mz + volume * oz),
        (
            xx + 2 * ox * mx + volume * ox * ox,
            xy + ox * my + oy * mx + volume * ox * oy,
            xz + ox * mz + oz * mx + volume * ox * oz,
            yy + 2 * oy * my + volume * oy * oy,
            yz + oy * mz + oz * my + volume * oy * oz,
            zz + 2 * oz * mz + volume * oz * oz,
        ),
    )


# --- principal axes ---------------------------------------------------------------------------


MOST_SWEEPS = 60
_PLANES = ((0, 1, 2), (0, 2, 1), (1, 2, 0))


def principal_axes(inertia: Rotation) -> tuple[Vector, Rotation]:
    """Return the principal moments of a symmetric matrix, and the rotation R to their axes.

    Args:
        inertia: the 3×3 matrix I, as rows, in kg·m².

    Returns:
        The moments d, in the order of the axes that they are nearest to, and R, whose columns are
        the axes: I = R·diag(d)·Rᵀ. A diagonal matrix gives its own diagonal and no rotation.

    Source: G. H. Golub and C. F. Van Loan, Matrix Computations, 4th edition, 8.5: Jacobi's method,
    cyclic by row, which is accurate to the rounding of the largest moment.
    """
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = inertia
    if not (xy or xz or yz):
        return (xx, yy, zz), UNTURNED
    rows: Rows = [list(row) for row in inertia]
    axes: Rows = [list(row) for row in UNTURNED]
    for _ in range(MOST_SWEEPS):
        turns = [_turn(rows, axes, p, q, other) for p, q, other in _PLANES]
        if not any(turns):
            break
    columns = list(zip(*axes, strict=True))
    a, b, c = (tuple(part / hypot(*column) for part in column) for column in columns)
    rotation = tuple(zip(a, b, c, strict=True))
    return (rows[0][0], rows[1][1], rows[2][2]), rotation  # type: ignore[return-value]


def _turn(rows: Rows, axes: Rows, p: int, q: int, other: int) -> bool:
    """Turn the matrix in the plane of two axes so that their product is 0; return whether it did.

    The angle is the smaller of those that do it, so that the axes stay near their own.
    """
    product, first, second = rows[p][q], rows[p][p], rows[q][q]
    size = abs(first) + abs(second)
    if size + abs(product) == size:  # no longer changes the moments
        rows[p][q] = rows[q][p] = 0.0
        return False
    ratio = (second - first) / (2 * product)
    tangent = copysign(1.0, ratio) / (abs(ratio) + hypot(1.0, ratio))
    cosine = 1 / sqrt(1 + tangent * tangent)
    sine = tangent * cosine
    rows[p][p] = first - tangent * product
    rows[q][q] = second + tangent * product
    rows[p][q] = rows[q][p] = 0.0
    x, y = rows[p][other], rows[q][other]
    rows[p][other] = rows[other][p] = cosine * x - sine * y
    rows[q][other] = rows[other][q] = sine * x + cosine * y
    for row in axes:
        x, y = row[p], row[q]
        row[p], row[q] = cosine * x - sine * y, sine * x + cosine * y
    return True
