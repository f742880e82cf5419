"""A scene for a robot: a floor below it, a light and a sky, in a file that includes the robot's."""

from __future__ import annotations

from math import hypot, inf

from ...model.shapes import Box, Capsule, Cylinder, Sphere
from ...xml.values import escaped_attribute
from ..output import MARK
from .keyframes import home_poses
from .writing import number, row

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.pose import Pose, Vector
    from ...model.shapes import Shape
    from .writing import Writing

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
    """Return the lowest point that collides, and the middle and the size of the robot, in metres.

    Of meshes only the origin counts.
    """
    poses = home_poses(writing)
    lowest = inf
    points: list[Vector] = []
    for link in writing.plan.order:
        pose = poses[link.name]
        points.append(pose.position)
        for collision in link.collisions:
            placed = pose @ collision.pose
            points.append(placed.position)
            lowest = min(lowest, _lowest(placed, collision.shape))
    middle, size = _around(points)
    return lowest, middle, max(size, SMALLEST)


def _lowest(placed: Pose, shape: Shape | None) -> float:
    """Return the height of the lowest point of a shape where it is placed."""
    x, y, z = placed.rotation[2]  # how far up the axes of the shape lead
    height = placed.position[2]
    if isinstance(shape, Box):
        return height - (abs(x) * shape.x + abs(y) * shape.y + abs(z) * shape.z) / 2
    if isinstance(shape, Sphere):
        return height - shape.radius
    if isinstance(shape, Capsule):
        return height - shape.radius - abs(z) * shape.length / 2
    if isinstance(shape, Cylinder):
        return height - shape.radius * hypot(x, y) - abs(z) * shape.length / 2
    return height


def _around(points: list[Vector]) -> tuple[Vector, float]:
    """Return the middle and the longest side of a box around points."""
    if not points:
        return (0.0, 0.0, 0.0), 0.0
    spans = [(min(axis), max(axis)) for axis in zip(*points, strict=True)]
    x, y, z = ((low + high) / 2 for low, high in spans)
    return (x, y, z), max(high - low for low, high in spans)
