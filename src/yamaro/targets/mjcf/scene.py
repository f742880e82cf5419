"""A scene for a robot: a floor below it, a light and a sky, in a file that includes the robot's."""

from __future__ import annotations

from math import inf

from ...xml.values import escaped_attribute
from ..output import MARK
from .keyframes import home_poses
from .solids import solids_at_home
from .writing import number, row

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.pose import Vector
    from .writing import Writing

DOWN = (0.0, 0.0, -1.0)
SMALLEST = 0.1
"""The least size of a robot, in metres, that the camera is set up for."""
TEXT = """\
<!-- {mark} -->
<mujoco model="{model}">
  <include file="{file}"/>
  <statistic center="{center}" extent="{extent}"/>
  <visual>
    <headlight diffuse="0.6 0.6 0.6" ambient="0.3 0.3 0.3" specular="0 0 0"/>
    <rgba haze="0.15 0.25 0.35 1"/>
    <global azimuth="120" elevation="-20"/>
  </visual>
  <asset>
    <texture type="skybox" builtin="gradient" rgb1="0.3 0.5 0.7" rgb2="0 0 0" width="512" \
height="3072"/>
    <texture type="2d" name="floor" builtin="checker" mark="edge" rgb1="0.2 0.3 0.4" \
rgb2="0.1 0.2 0.3" markrgb="0.8 0.8 0.8" width="300" height="300"/>
    <material name="floor" texture="floor" texuniform="true" texrepeat="5 5" reflectance="0.2"/>
  </asset>
  <worldbody>
    <light pos="0 0 {light}" dir="0 0 -1" directional="true"/>
    <geom name="floor" type="plane" pos="0 0 {floor}" size="0 0 0.05" material="floor"/>
  </worldbody>
</mujoco>
"""


def scene(writing: Writing, file: str) -> bytes:
    """Return a scene with the robot of another file in the same folder.

    The floor touches the lowest point of what collides, at home; under a robot that is fixed it is
    not above the robot's origin.
    """
    lowest, center, extent = _extent(writing)
    floor = lowest if lowest < inf else 0.0
    if writing.wanted.is_fixed:
        floor = min(floor, 0.0)
    text = TEXT.format(
        mark=MARK,
        model=escaped_attribute(f"{writing.model} scene"),
        file=escaped_attribute(file),
        center=row(round(part, 3) for part in center),
        extent=number(round(extent, 3)),
        light=number(round(floor + 3 * extent, 3)),
        floor=number(floor),
    )
    return text.encode()


def _extent(writing: Writing) -> tuple[float, Vector, float]:
    """Return the lowest point that collides, and the robot's middle and size, in metres."""
    solids = solids_at_home(writing)
    lowest = min((solid.convex.farthest(DOWN)[2] for solid in solids), default=inf)
    points = [pose.position for pose in home_poses(writing).values()]
    points += [solid.convex.center for solid in solids]
    middle, size = _around(points)
    return lowest, middle, max(size, SMALLEST)


def _around(points: list[Vector]) -> tuple[Vector, float]:
    """Return the middle and the longest side of a box around points."""
    if not points:
        return (0.0, 0.0, 0.0), 0.0
    spans = [(min(axis), max(axis)) for axis in zip(*points, strict=True)]
    x, y, z = ((low + high) / 2 for low, high in spans)
    return (x, y, z), max(high - low for low, high in spans)
