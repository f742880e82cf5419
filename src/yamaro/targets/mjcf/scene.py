"""Where a robot is in its states, how high it stands on the floor, and a scene with that floor."""

from __future__ import annotations

from ...model.kinematics import link_poses
from ...model.pose import Pose
from ...model.positions import HOME, home_positions, positions_in
from ...model.shapes import Mesh
from ...xml.values import escaped_attribute
from ..contacts import solids_at
from ..elements import number, row
from ..output import MARK
from .assets import Looks
from .model import Writing

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ...model.robot import Robot
    from ..contacts import Solid
    from ..output import Wanted


DOWN = (0.0, 0.0, -1.0)
DIGITS = 12
"""Decimals of a height in metres: more is rounding."""


def home_poses(writing: Writing) -> dict[str, Pose]:
    """Return T_root_link of every link at home, by name."""
    return link_poses(writing.robot, home_positions(writing.robot))


def solids_at_home(writing: Writing) -> Sequence[Solid]:
    """Return what collides, in the order of the links, in the axes of the root."""
    if writing.solids is None:
        writing.solids = solids_at(writing.collisions, home_poses(writing))
    return writing.solids


def heights_at(writing: Writing, poses: Mapping[str, Pose]) -> dict[str, float]:
    """Return how much higher links that move freely have to be than in these poses.

    A free root stands on the floor, which is at 0. A link on a floating joint is where that joint
    has it, but not in the floor.
    """
    lowest: dict[str, float] = {}
    carriers = writing.plan.free
    for solid in solids_at(writing.collisions, poses) if any(carriers.values()) else ():
        carrier = carriers[solid.link.name]
        if carrier is not None:
            height = solid.convex.farthest(DOWN)[2]
            lowest[carrier] = min(lowest.get(carrier, height), height)
    return {
        link: round(-height, DIGITS) + 0.0
        for link, height in lowest.items()
        if writing.robot.parent_joint(link) is None or height < 0
    }


def free_pose_at_home(robot: Robot, wanted: Wanted, link: str) -> Pose | None:
    """Return T_world_link at home of a link that stands on the floor; None if it is held there."""
    writing, poses = Writing(robot, wanted), link_poses(robot, home_positions(robot))
    free = writing.plan.free[link]
    if free is None:
        return None
    looks = Looks(writing)
    for each in writing.plan.order:
        for collision in each.collisions:
            shape = collision.shape
            if not isinstance(shape, Mesh):
                writing.collisions.append((each, collision, ()))
            elif looks.collision_mesh(each, collision, shape) is not None:
                writing.collisions.append((each, collision, looks.corners_of(shape)))
    height = heights_at(writing, poses).get(free, 0.0)
    return Pose(position=(0.0, 0.0, height)) @ poses[link]


# --- scene ------------------------------------------------------------------------------------


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
    <geom name="floor" type="plane" pos="0 0 {floor}" size="0 0 0.05" material="floor" \
friction="0 0 0" solmix="0"/>
  </worldbody>
</mujoco>
"""


def scene(writing: Writing, file: str) -> bytes:
    """Return a scene with the robot of another file in the same folder.

    The floor is at 0, on which free robots stand. What a robot moves that is fixed, such as an arm
    that hangs, may reach farther down in one of its states: then the floor is there. A contact
    has the friction and the softness of what touches the floor: MuJoCo takes the greater friction
    of the two, and weighs their softness.
    """
    floor = _floor(writing)
    poses, free = home_poses(writing), writing.plan.free
    heights = heights_at(writing, poses)
    points = [(name, pose.position) for name, pose in poses.items()]
    points += [(each.link.name, each.convex.center) for each in solids_at_home(writing)]
    raised = [(x, y, z + heights.get(free.get(name) or "", 0.0)) for name, (x, y, z) in points]
    spans = [(min(axis), max(axis)) for axis in zip(*raised, strict=True)] or [(0.0, 0.0)] * 3
    center = [(low + high) / 2 for low, high in spans]
    extent = max(SMALLEST, *(high - low for low, high in spans))
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


def _floor(writing: Writing) -> float:
    """Return the height of the floor: 0, or lower where moving links of a fixed robot are."""
    plan, states = writing.plan, writing.robot.states
    held = {name for name in plan.free if plan.free[name] is None and name not in plan.static}
    if not any(link.name in held for link, _, _ in writing.collisions):
        return 0.0
    lowest = 0.0
    for state in (states.get(HOME), *states.values()):
        for solid in solids_at(
            writing.collisions, link_poses(writing.robot, positions_in(writing.robot, state))
        ):
            if solid.link.name in held:
                lowest = min(lowest, solid.convex.farthest(DOWN)[2])
    return round(lowest, DIGITS) + 0.0
