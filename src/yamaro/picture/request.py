"""The request for a picture, as the command line has it: what is shown, and how it moves."""

from __future__ import annotations

import os
from math import isfinite, pi, sin

from ..diagnostics import did_you_mean
from ..model.joint import CONTINUOUS
from ..options import UsageError
from ..terminal import shortened

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ..model.joint import Joint
    from ..model.robot import Robot


# --- words of options -------------------------------------------------------------------------


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


# --- request ----------------------------------------------------------------------------------


LARGEST = 1e9
"""The largest number that is taken for a measure: beyond it, sums of squares overflow."""
ZERO = "zero"
"""The state in which all joints are at 0, if the robot does not call another one so."""

STILLS = (".png", ".jpg", ".jpeg")
FILM = ".gif"
LEAST_PIXELS, MOST_PIXELS = 16, 4096
"""Pixels along a side of a picture."""

STILL_SIZE = (800, 600)
FILM_SIZE = (480, 360)
MOST_FRAMES = 3000
TURN_SECONDS = 6.0
SWEEP_SECONDS = 4.0
EACH_SECONDS = 2.0


class View:
    """A direction to look from.

    Attributes:
        azimuth: of the camera in degrees, from the x axis, which robots have in front, to the y
            axis, on their left.
        elevation: of the camera in degrees above the ground.
        is_flat: whether parallel lines stay parallel, as in drawings.
    """

    __slots__ = ("azimuth", "elevation", "is_flat")

    def __init__(self, azimuth: float, elevation: float, *, is_flat: bool) -> None:
        self.azimuth = azimuth
        self.elevation = elevation
        self.is_flat = is_flat

    def turned(self, degrees: float) -> View:
        """Return the view from a camera that went on around the robot, by an angle in degrees."""
        return View(self.azimuth + degrees, self.elevation, is_flat=self.is_flat)


class Request:
    """What a picture is to be.

    Attributes:
        ending: of the file, in lower case with its dot.
        width, height: of each view, in pixels.
        views: from where the robot is seen; several make a sheet.
        state: the name of the state that is shown; "" for `home`, if there is one.
        joints: the values of `--joints`, by name; these joints are not as in the state.
        shows: some of SHOWN.
        is_transparent: whether the background is transparent.
        turns: whether the camera goes around the robot.
        sweep: which joints move: ALL, EACH, names with commas between them, or "" for none.
        rate: frames per second of a film.
        seconds: how long a film is, or None for the usual time.
    """

    __slots__ = (
        "ending", "height", "is_transparent", "joints", "rate", "seconds", "shows", "state",
        "sweep", "turns", "views", "width",
    )  # fmt: skip

    def __init__(
        self, output: str, options: Mapping[str, str], lists: Mapping[str, Sequence[str]]
    ) -> None:
        """Read options.

        Args:
            output: where the picture goes, or "-" for a PNG on standard output.
            options: the options that are given, by their names without dashes.
            lists: the values of those that may be given several times.

        Raises:
            UsageError: they make no sense.
        """
        self.ending = _ending_of(output)
        self.turns = "turn" in options
        self.sweep = options.get("sweep", "")
        self._check_film(options)
        usual = FILM_SIZE if self.is_film else STILL_SIZE
        self.width, self.height = _size(options["size"]) if "size" in options else usual
        self.views = [view for text in lists.get("view", ["iso"]) for view in _views(text)]
        self.state = options.get("state", "")
        self.joints = [pair for text in lists.get("joints", []) for pair in _pairs(text)]
        self.shows = {word for text in lists.get("show", [VISUAL]) for word in _words(text)}
        self.is_transparent = "transparent" in options
        if self.is_transparent and self.ending not in (".png", ".gif"):
            raise UsageError(f"a {self.ending} cannot be transparent: name it .png or .gif")
        self.rate = _number(options, "frames-per-second", 20)
        self.seconds = _number(options, "seconds") if "seconds" in options else None

    @property
    def is_film(self) -> bool:
        """Return whether it is a film."""
        return self.ending == FILM

    def _check_film(self, options: Mapping[str, str]) -> None:
        moves = self.turns or self.sweep
        if self.is_film and not moves:
            raise UsageError(f"a {self.ending} is a film: add '--turn' or '--sweep all'")
        if self.is_film:
            return
        for option in ("turn", "sweep", "seconds", "frames-per-second"):
            if option in options:
                raise UsageError(f"'--{option}' makes a film: name it .gif")


def read_positions(request: Request, robot: Robot) -> dict[str, float]:
    """Return the positions of all joints that move independently, as they are asked for.

    Raises:
        UsageError: a state or joint is named that there is not, or a position is not of its joint.
    """
    from ..model.positions import home_positions, positions_in, read_position, state_named

    try:
        if not request.state:
            positions = home_positions(robot)
        elif request.state == ZERO and ZERO not in robot.states:
            positions = positions_in(robot, None)
        else:
            positions = positions_in(robot, state_named(robot, request.state))
        for name, text in request.joints:
            joint = find_joint(name, robot)
            position = read_position(joint, text)
            if not isinstance(position, float) or abs(position) > LARGEST:
                raise ValueError(f"the joint '{name}' cannot be drawn at '{shortened(text)}'")
            positions[joint.name] = position
    except ValueError as error:
        raise UsageError(str(error)) from None
    return positions


def find_joint(name: str, robot: Robot) -> Joint:
    """Return a joint that can be moved; raise UsageError if the robot has no such joint."""
    from ..model.positions import joint_named

    try:
        joint = joint_named(robot, name)
    except ValueError as error:
        raise UsageError(str(error)) from None
    if joint.mimic is not None:
        raise UsageError(f"the joint '{joint.name}' mimics '{joint.mimic.joint}': move that one")
    if not joint.is_free:
        raise UsageError(f"the joint '{joint.name}' is {joint.type}: it has no position to set")
    return joint


def _ending_of(output: str) -> str:
    if output == "-":
        return ".png"
    ending = os.path.splitext(output)[1].lower()
    if ending not in (*STILLS, FILM):
        known = ", ".join((*STILLS[:2], FILM))
        raise UsageError(f"the ending of '{shortened(output)}' names no kind of picture: {known}")
    return ending


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.lower().partition("x")
    try:
        size = int(width), int(height)
    except ValueError:
        wrong = shortened(text)
        raise UsageError(f"'--size' takes WIDTHxHEIGHT, as in 800x600, not '{wrong}'") from None
    if not all(LEAST_PIXELS <= each <= MOST_PIXELS for each in size):
        raise UsageError(f"'--size' takes {LEAST_PIXELS} to {MOST_PIXELS} pixels along a side")
    return size


def _views(text: str) -> list[View]:
    """Return the views of `iso`, `front,left,top` or `30,20`."""
    words = [word.strip() for word in text.split(",")]
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        return [_named_view(word) for word in words]
    if len(numbers) != 2 or not all(map(isfinite, numbers)) or not -90 <= numbers[1] <= 90:
        raise UsageError(
            "'--view' takes names, or azimuth and elevation in degrees, as in 30,20; "
            "the elevation is from -90 to 90"
        )
    return [View(numbers[0], numbers[1], is_flat=False)]


def _named_view(word: str) -> View:
    if word not in NAMED_VIEWS:
        known = ", ".join(NAMED_VIEWS)
        hint = did_you_mean(word, list(NAMED_VIEWS)) or f"there are {known}, and angles: 30,20"
        raise UsageError(f"there is no view '{shortened(word)}'; {hint}")
    return View(*NAMED_VIEWS[word], is_flat=word != "iso")


def _pairs(text: str) -> list[tuple[str, str]]:
    """Return names and values of `name=value,name=value`."""
    pairs = []
    for each in text.split(","):
        name, separator, value = each.strip().rpartition("=")
        if not separator or not name:
            wrong = shortened(each)
            hint = f"; '--state {wrong}' shows a named state" if wrong.isidentifier() else ""
            raise UsageError(f"'--joints' takes NAME=POSITION, not '{wrong}'{hint}")
        pairs.append((name, value))
    return pairs


def _words(text: str) -> list[str]:
    words = [word.strip() for word in text.split(",")]
    for word in words:
        if word not in SHOWN:
            hint = did_you_mean(word, list(SHOWN)) or f"it takes {', '.join(SHOWN)}"
            raise UsageError(f"'--show' knows no '{shortened(word)}'; {hint}")
    return words


def _number(options: Mapping[str, str], option: str, default: float = 0.0) -> float:
    text = options.get(option)
    if text is None:
        return default
    try:
        number = float(text)
    except ValueError:
        number = 0.0
    if not 0 < number <= MOST_FRAMES:
        raise UsageError(f"'--{option}' takes a number above 0, not '{shortened(text)}'")
    return number


# --- frames of a film -------------------------------------------------------------------------


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
