"""Works out what SDF wants to be told of an obstacle."""

from __future__ import annotations

from collections.abc import Sequence


def box_inertia(mass: float, size: Sequence[float]) -> dict[str, float]:
    """Return the inertia of a solid box about its centre, in kg·m²: m/12·(y² + z²) and so on."""
    x, y, z = size
    return {
        "ixx": mass / 12 * (y * y + z * z),
        "iyy": mass / 12 * (x * x + z * z),
        "izz": mass / 12 * (x * x + y * y),
    }
