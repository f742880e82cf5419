"""Principal axes: the axes along which a matrix of inertia has no products."""

from __future__ import annotations

from math import copysign, hypot, sqrt

from .pose import UNTURNED

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .pose import Rotation, Vector

    Rows = list[list[float]]

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
    a, b, c = (_unit(column) for column in zip(*axes, strict=True))
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


def _unit(column: tuple[float, ...]) -> tuple[float, ...]:
    length = hypot(*column)
    return tuple(part / length for part in column)
