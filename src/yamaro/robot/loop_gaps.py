"""How far the loops of a robot are open where it starts."""

from __future__ import annotations

from math import acos, dist

from ..model.pose import rotate, transposed
from ..model.positions import HOME
from ..model.reading import read_robot

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..model.extras import Loop
    from ..model.pose import Pose
    from ..model.robot import Robot
    from ..xml.tree import Element
    from .lowering import Lowering
    from .notes import RobotNote

LARGEST_GAP = 1e-6
"""In metres and radians: simulators close gaps of this size without a jerk."""


def warn_of_open_loops(lowering: Lowering, root: Element, notes: Sequence[RobotNote]) -> None:
    """Warn of loops that are open at `home`, with the distance and the angle.

    Args:
        lowering: the run.
        root: the `<robot>`.
        notes: what it has besides URDF.
    """
    robot = read_robot(root, notes=notes, recognizes=False)
    home = robot.states.get(HOME)
    free = {joint.name for joint in robot.free_joints()}
    given = home.positions if home is not None else {}
    poses = robot.poses({name: given[name] for name in given if name in free})
    for loop in robot.loops.values():
        if all(name in poses for name in loop.between):
            distance, angle = gap_of(loop, *(poses[name] for name in loop.between))
            if distance > LARGEST_GAP or angle > LARGEST_GAP:
                _warn(lowering, robot, loop, distance, angle)


def gap_of(loop: Loop, one: Pose, other: Pose) -> tuple[float, float]:
    """Return how far two frames are from where a loop holds them: in metres and in radians.

    A ball leaves all angles free; a revolute one that about its axis, which both frames have.

    Args:
        loop: the loop.
        one: T_root_frame of its first frame.
        other: T_root_frame of its second frame.
    """
    distance = dist(one.position, other.position)
    if loop.type == "ball":
        return distance, 0.0
    if loop.type == "revolute" and loop.axis is not None:
        first, second = rotate(one.rotation, loop.axis), rotate(other.rotation, loop.axis)
        length = sum(x * x for x in loop.axis)
        cosine = sum(a * b for a, b in zip(first, second, strict=True)) / length if length else 1.0
        return distance, _angle(cosine)
    turned = [rotate(transposed(one.rotation), column) for column in transposed(other.rotation)]
    trace = sum(turned[index][index] for index in range(3))
    return distance, _angle((trace - 1) / 2)


def _angle(cosine: float) -> float:
    """Return the angle of a cosine; acos is exact to 1e-8 only, and 0 below that."""
    return acos(max(-1.0, min(1.0, cosine))) if cosine < 1 - 1e-12 else 0.0


def _warn(lowering: Lowering, robot: Robot, loop: Loop, distance: float, angle: float) -> None:
    where = f"in the state '{HOME}'" if HOME in robot.states else "with all joints at 0"
    size = [f"{distance:.3g} m"] if distance > LARGEST_GAP else []
    size += [f"{angle:.3g} rad"] if angle > LARGEST_GAP else []
    lowering.warn(
        "open-loop",
        f"the loop '{loop.name}' is open by {' and '.join(size)} {where}",
        loop.span,
        hint=f"give the positions in which it is closed: states: {{{HOME}: {{…}}}}",
        trace=loop.trace,
    )
