"""The words that options of `yamaro picture` take."""

from __future__ import annotations

VISUAL, COLLISION, INERTIA, FRAMES, GRID = "visual", "collision", "inertia", "frames", "grid"
SHOWN = (VISUAL, COLLISION, INERTIA, FRAMES, GRID)
"""What can be shown of a robot."""

NAMED_VIEWS: dict[str, tuple[float, float]] = {
    "iso": (35.0, 22.0),
    "front": (0.0, 0.0),
    "left": (90.0, 0.0),
    "back": (180.0, 0.0),
    "right": (-90.0, 0.0),
    "top": (180.0, 90.0),
    "bottom": (0.0, -90.0),
}
"""Azimuth and elevation of the camera in degrees, by name."""

ALL, EACH = "all", "each"
"""What is swept: all joints at once, or each in its turn."""
