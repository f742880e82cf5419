"""The entry: spheres, pairs of links that are not checked, and the space of the joints.

Source: the keys and types are those of `KinematicsLoaderCfg` and `CSpaceParams` of cuRobo, of the
format version 2.0, and of the files of robots that it comes with.
"""

from __future__ import annotations

from ...model.joint import SINGLE
from ...model.positions import home_positions
from ...model.shapes import Mesh, Sphere
from ..groups import joints_of
from ..losses import Losses
from ..moveit.config import bound_of
from ..output import Output
from ..parameters import yaml_of
from ..srdf.pairs import disabled_pairs
from ..table import file_name_for

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.joint import Joint
    from ...model.robot import Robot
    from ..output import Wanted

    Document = dict[str, object]

FORMAT = 2.0
"""The version of the format."""
MOST = {"acceleration": 10.0, "jerk": 500.0}
"""What cuRobo takes for joints without such a limit, in rad/s² and rad/s³ or m/s² and m/s³."""
HINT = (
    "`collision: {spheres: 24}` makes spheres of a mesh; `yamaro fit --spheres 24` those of a robot"
)


def write(robot: Robot, wanted: Wanted) -> Output:
    """Return the configuration of a robot, whose URDF is beside it.

    Raises:
        YamaroError: what samples for pairs of links is not installed.
    """
    losses = Losses()
    spheres = _spheres(robot, losses)
    effectors = [each for each in robot.groups.values() if each.is_end_effector]
    gripped = {name for group in effectors for name in joints_of(robot, group)}
    kinematics: Document = {
        "format_version": FORMAT,
        "urdf_path": file_name_for(robot.name, "urdf", wanted.name),
        "base_link": next((each.name for each in robot.roots), ""),
        "tool_frames": _tool_frames(robot),
        "collision_link_names": [*spheres],
        "collision_spheres": spheres,
        "collision_sphere_buffer": 0.0,
        "self_collision_buffer": dict.fromkeys(spheres, 0.0),
        "self_collision_ignore": _ignored(robot, wanted, spheres),
    }
    if wanted.has_meshes:
        kinematics["mesh_link_names"] = [
            link.name
            for link in robot.links.values()
            if any(isinstance(each.shape, Mesh) for each in link.visuals)
        ]
    touching = [name for name in spheres if _moved_by(robot, name) in gripped]
    if touching:
        kinematics["grasp_contact_link_names"] = touching
    joints = []
    for joint in robot.joints.values():
        if joint.is_free:
            joints.append(joint)
        elif joint.type not in SINGLE and not joint.is_fixed:
            losses.lose("planar and floating joints", joint)
    home = home_positions(robot)
    positions = {joint.name: home.get(joint.name, joint.rest) for joint in joints}
    locked = {name: value for name, value in positions.items() if name in gripped}
    if locked:
        kinematics["lock_joints"] = locked
    if joints:
        kinematics["cspace"] = {
            "joint_names": [*positions],
            "default_joint_position": [*positions.values()],
            "cspace_distance_weight": [1.0] * len(joints),
            "null_space_weight": [1.0] * len(joints),
            **_limits(joints, losses),
        }
    return Output(None, losses, text=yaml_of({"robot_cfg": {"kinematics": kinematics}}))


def _spheres(robot: Robot, losses: Losses) -> dict[str, list[Document]]:
    """Return the spheres that each link collides with, in the frame of the link, in metres."""
    found: dict[str, list[Document]] = {}
    for link in robot.links.values():
        for each in link.collisions:
            if isinstance(each.shape, Sphere):
                center = [float(value) for value in each.pose.position]
                sphere: Document = {"center": center, "radius": float(each.shape.radius)}
                found.setdefault(link.name, []).append(sphere)
            else:
                what = "collisions that are not spheres"
                losses.lose(what, link, part=each, hint=HINT)
    return found


def _ignored(robot: Robot, wanted: Wanted, links: dict[str, list[Document]]) -> Document:
    """Return for each link those that it needs no check against; a pair is named once."""
    found: dict[str, list[str]] = {}
    for pair in disabled_pairs(robot, wanted, links=[*links]):
        found.setdefault(pair.first, []).append(pair.second)
    return {**found}


def _tool_frames(robot: Robot) -> list[str]:
    """Return the links whose poses are planned.

    They are the tips of the chains of groups and what end effectors are on, or else the links at
    which the branches of the robot end.
    """
    found: dict[str, None] = {}
    for group in robot.groups.values():
        if group.is_end_effector:
            found |= dict.fromkeys([group.parent] if group.parent else [])
        else:
            found |= {tip: None for _, tip in group.chains}
    return [*found] or [name for name in robot.links if not [*robot.joints_below(name)]]


def _moved_by(robot: Robot, link: str) -> str:
    """Return the name of the joint that a link is on, or ""."""
    joint = robot.parent_joint(link)
    return joint.name if joint is not None else ""


def _limits(joints: list[Joint], losses: Losses) -> Document:
    """Return the limits of acceleration and jerk that the robot gives, for each joint."""
    found: Document = {}
    for name, usual in MOST.items():
        given = [bound_of(joint.limit, name) for joint in joints]
        if given.count(None) == len(joints):
            continue
        found[f"max_{name}"] = [usual if value is None else value for value in given]
        for joint, value in zip(joints, given, strict=True):
            if value is None:
                how = f"{usual:g}, which cuRobo takes without one"
                hint = f"add {name} to the limit"
                losses.approximate(
                    f"missing limits of {name}", joint, part=joint.limit, how=how, hint=hint
                )
    return found
