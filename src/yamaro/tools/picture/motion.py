"""What moves in a film: where the joints are, and how far the camera is around, frame by frame."""

from __future__ import annotations

from math import pi, sin

from ...model.joint import CONTINUOUS
from ...options import UsageError
from .request import EACH_SECONDS, MOST_FRAMES, SWEEP_SECONDS, TURN_SECONDS, find_joint
from .words import ALL, EACH

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.joint import Joint
    from ...model.robot import Robot
    from .request import Request


class Moment:
    """One frame: the positions of joints by name, and the turn of the camera in degrees."""

    __slots__ = ("positions", "turn")

    def __init__(self, positions: dict[str, float], turn: float) -> None:
        self.positions = positions
        self.turn = turn


def moments(request: Request, robot: Robot, positions: dict[str, float]) -> list[Moment]:
    """Return the frames of a film, or the one of a still.

    Args:
        request: what moves, and how long.
        robot: the robot.
        positions: of the joints that do not move.

    Raises:
        UsageError: a joint that is to move cannot, or the film is too long.
    """
    if not request.is_film:
        return [Moment(positions, 0.0)]
    joints = _swept(request.sweep, robot)
    in_turn = len(joints) if request.sweep == EACH else 1
    seconds = request.seconds or _usual_seconds(request, in_turn)
    count = max(round(seconds * request.rate), 2)
    if count > MOST_FRAMES:
        raise UsageError(f"the film would have {count:,} frames, and {MOST_FRAMES:,} are the most")
    found = []
    for number in range(count):
        time = number / count  # of the whole, from 0 to just below 1: the last leads to the first
        moved = dict(positions)
        part = time * in_turn
        for joint in [joints[int(part)]] if request.sweep == EACH else joints:
            moved[joint.name] = swung(joint, part % 1, positions.get(joint.name, joint.rest))
        found.append(Moment(moved, 360 * time if request.turns else 0.0))
    return found


def swung(joint: Joint, time: float, start: float) -> float:
    """Return where a joint is that goes from its start to its limits, one and the other, and back.

    Args:
        joint: the joint; a continuous one turns once instead.
        time: from 0 to 1.
        start: its position at the times 0 and 1.
    """
    if joint.type == CONTINUOUS:
        return start + 2 * pi * time
    lower, upper = joint.range
    wave = sin(2 * pi * time)
    return start + wave * (upper - start if wave > 0 else start - lower)


def _swept(sweep: str, robot: Robot) -> list[Joint]:
    if not sweep:
        return []
    if sweep not in (ALL, EACH):
        return [find_joint(name.strip(), robot) for name in sweep.split(",")]
    joints = robot.free_joints()
    if not joints:
        raise UsageError("nothing is there to sweep: the robot has no joint that moves")
    return joints


def _usual_seconds(request: Request, in_turn: int) -> float:
    sweep = EACH_SECONDS * in_turn if request.sweep == EACH else SWEEP_SECONDS
    return max(TURN_SECONDS if request.turns else 0.0, sweep if request.sweep else 0.0)
