"""The files of `config/`: limits, solvers of inverse kinematics, controllers and positions.

Sources: moveit_configs_utils, robot_model_loader, moveit_simple_controller_manager and the setup
assistant of MoveIt 2, August 2026.
"""

from __future__ import annotations

from ...diagnostics import WARNING, Diagnostic
from ...model.controllers import SOLVER, SOLVER_KEYS, SOLVERS
from ...model.joint import SINGLE, UNLIMITED
from ...model.positions import HOME
from ..groups import joints_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.joint import Joint, Limit
    from ...model.robot import Robot
    from ..controllers.planning import Plan

    Document = dict[str, object]

SCALING = 0.1
"""The part of the limits that motions take when they do not say it: the default of MoveIt."""
CARTESIAN = {
    "max_trans_vel": 1.0,
    "max_trans_acc": 2.25,
    "max_trans_dec": -5.0,
    "max_rot_vel": 1.57,
}
"""Limits of the tool for the planner Pilz, in m/s, m/s² and rad/s, as the setup assistant has them.

The builder of configurations needs the file, since it loads that planner by default.
"""
SOLVER_DEFAULTS = {
    SOLVER_KEYS["search_resolution"]: 0.005,
    SOLVER_KEYS["timeout"]: 0.005,
}
"""Of KDL in radians and seconds, as the setup assistant has them."""
ACTIONS = {
    "joint_trajectory": ("FollowJointTrajectory", "follow_joint_trajectory"),
    "parallel_gripper_action_controller/GripperActionController": (
        *("ParallelGripperCommand", "gripper_cmd"),
    ),
    "gripper": ("GripperCommand", "gripper_cmd"),
}
"""The types of action of controllers that MoveIt knows, and their names below the controller's."""


def planned_joints(robot: Robot) -> list[Joint]:
    """Return the joints that MoveIt plans for: those of groups, or without groups all."""
    names = {name for group in robot.groups.values() for name in joints_of(robot, group)}
    return [
        joint
        for joint in robot.joints.values()
        if joint.type in SINGLE and (joint.name in names or not robot.groups)
    ]


def joint_limits(robot: Robot) -> Document:
    """Return the limits of velocity, acceleration and jerk, which are doubles."""
    limits: Document = {}
    for joint in planned_joints(robot):
        own: Document = {}
        for name in ("velocity", "acceleration", "jerk"):
            most = bound_of(joint.limit, name)
            own[f"has_{name}_limits"] = most is not None
            if most is not None:
                own[f"max_{name}"] = most
        most = bound_of(joint.limit, "deceleration")
        if most is not None:  # Pilz takes it as a negative number
            own |= {"has_deceleration_limits": True, "max_deceleration": -most}
        limits[joint.name] = own
    return {
        "default_velocity_scaling_factor": SCALING,
        "default_acceleration_scaling_factor": SCALING,
        "joint_limits": limits,
    }


def bound_of(limit: Limit | None, name: str) -> float | None:
    """Return the largest value that a limit allows, None if it sets none."""
    value = limit.number(name) if limit is not None else None
    return value if value is not None and 0 < value < UNLIMITED else None


def lacking_limits(robot: Robot) -> list[Diagnostic]:
    """Return a warning of the joints for whose trajectories MoveIt cannot compute times."""
    found = []
    for joint in planned_joints(robot):
        names = [
            each for each in ("velocity", "acceleration") if bound_of(joint.limit, each) is None
        ]
        if names and joint.mimic is None:
            found.append((joint, " and ".join(names)))
    if not found:
        return []
    first, what = found[0]
    count = len(found) - 1
    others = f" and {count} other{'s' if count > 1 else ''}" if count else ""
    return [
        Diagnostic(
            "missing-acceleration",
            f"MoveIt computes no times for trajectories of joints without limits: joint "
            f"'{first.name}'{others} without {what}",
            (first.limit or first).span,
            hint="add acceleration: 5 to the limit: in rad/s² or m/s², what the drive allows",
            notes=[
                f"also joint '{joint.name}', without {lack}, at "
                + (joint.limit or joint).span.place()
                for joint, lack in found[1:]
            ],
            severity=WARNING,
            trace=first.trace,
        )
    ]


def kinematics(robot: Robot) -> Document:
    """Return the solver of each group that is a chain, KDL by default."""
    found: Document = {}
    for name, group in robot.groups.items():
        is_chain = len(group.chains) == 1 and not (group.links or group.joints or group.groups)
        given: Document = {**group.kinematics}
        if given.get(SOLVER) == "none" or not (given or (is_chain and not group.is_end_effector)):
            continue
        solver = given.setdefault(SOLVER, SOLVERS["kdl"])
        defaults = SOLVER_DEFAULTS if solver == SOLVERS["kdl"] else {}
        found[name] = {SOLVER: solver, **defaults, **given}
    return found


def moveit_controllers(plan: Plan) -> Document:
    """Return the controllers that MoveIt sends trajectories to, by default the first of a joint."""
    controllers: Document = {}
    taken: set[str] = set()
    for each in plan.controllers:
        action = ACTIONS.get(each.plugin) or ACTIONS.get(each.word)
        if action is None or not each.joints:
            continue
        joints = each.joints
        controllers[each.name] = {
            "type": action[0],
            "action_ns": action[1],
            "default": not taken & set(joints),
            "joints": joints,
        }
        taken |= set(joints)
    return {
        "moveit_controller_manager": "moveit_simple_controller_manager/"
        "MoveItSimpleControllerManager",
        "moveit_simple_controller_manager": {"controller_names": [*controllers], **controllers},
    }


def initial_positions(robot: Robot) -> Document:
    """Return where each joint starts: in the state `home`, or else at rest."""
    state = robot.states.get(HOME)
    given = state.positions if state is not None else {}
    joints = [joint for joint in planned_joints(robot) if joint.mimic is None]
    return {
        "initial_positions": {joint.name: given.get(joint.name, joint.rest) for joint in joints}
    }
