"""What a picture is to be, as the command line says it; nothing is drawn here."""

from __future__ import annotations

import os
from math import isfinite

from ...diagnostics import did_you_mean
from ...options import UsageError
from ...terminal import shortened
from .shapes import LARGEST
from .words import NAMED_VIEWS, SHOWN, VISUAL

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ...model.joint import Joint
    from ...model.robot import Robot

ZERO = "zero"
"""The state in which all joints are at 0, if the robot does not call another one so."""

STILLS = (".png", ".jpg", ".jpeg")
FILMS = (".gif", ".mp4")
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
        self.rate = _number(options, "frames-per-second", 25 if self.ending == ".mp4" else 20)
        self.seconds = _number(options, "seconds") if "seconds" in options else None

    @property
    def is_film(self) -> bool:
        """Return whether it is a film."""
        return self.ending in FILMS

    def _check_film(self, options: Mapping[str, str]) -> None:
        moves = self.turns or self.sweep
        if self.is_film and not moves:
            raise UsageError(f"a {self.ending} is a film: add '--turn' or '--sweep all'")
        if self.is_film:
            return
        for option in ("turn", "sweep", "seconds", "frames-per-second"):
            if option in options:
                raise UsageError(f"'--{option}' makes a film: name it .gif or .mp4")


def read_positions(request: Request, robot: Robot) -> dict[str, float]:
    """Return the positions of all joints that move independently, as they are asked for.

    Raises:
        UsageError: a state or joint is named that there is not, or a position is not of its joint.
    """
    from ...model.positions import home_positions, positions_in, read_position, state_named

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
    from ...model.positions import joint_named

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
    if ending not in STILLS + FILMS:
        known = ", ".join((*STILLS[:2], *FILMS))
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
