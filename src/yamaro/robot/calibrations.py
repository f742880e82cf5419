"""Calibrations as the programs of two makers write them, read as overlays as they are.

Universal Robots: `kinematics.yaml` of ur_calibration and ur_description: the pose of each link in
the one before, in metres and radians, and a hash, which the driver compares with the one in the
arm: https://github.com/UniversalRobots/Universal_Robots_ROS2_Driver, ur_calibration.

LeRobot: a JSON file that `lerobot-calibrate` writes for an arm of Feetech or Dynamixel motors: the
ends of the range of each in steps. LeRobot reads the middle of the range as 0°, and a turn as one
step less than the motor has: https://github.com/huggingface/lerobot, its motors/motors_bus.py
and robots/so_follower.
"""

from __future__ import annotations

from math import tau

from ..diagnostics import failure
from ..source import OverlaidSpan
from ..xml.tree import Element, Text
from ..xml.values import format_value
from .fields import read_value
from .notes import given_once
from .numbers import read_numbers
from .rigid import ends_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..source import Span
    from .overlay import Overlaid

KINEMATICS = "kinematics"
"""The key around a calibration of Universal Robots."""
POSES = {"xyz": ("x", "y", "z"), "rpy": ("roll", "pitch", "yaw")}
HASH = "kinematics/hash"
"""The parameter of the driver of Universal Robots that has the hash of a calibration."""

LEROBOT = "lerobot"
"""What an overlay is called that holds a calibration of LeRobot."""
OF_MOTORS = ("id", "drive_mode", "homing_offset", "range_min", "range_max")
STEPS = 4095
"""Steps in a turn as LeRobot counts them for motors with 12 bits: STS3215, XL330, XL430."""
GRIPPER = "gripper"
"""The joint that LeRobot opens from 0 to 100: its range begins where it is closed."""
LARGEST_SHIFT = 0.26
"""How far from 0 the middle of a model's range may be, in radians, for its zero to be LeRobot's."""


def as_overlay(overlaid: Overlaid, overlay: Element) -> Element:
    """Return an overlay as it is, or the one that a calibration means for a robot.

    Raises:
        YamaroError: the robot is not the one that the calibration is of, or a number is faulty.
    """
    for kind, read in ((KINEMATICS, _kinematics), (LEROBOT, _motors)):
        calibration = next((each for each in overlay.elements() if each.name == kind), None)
        if calibration is not None:
            joints = read(overlaid, calibration)
            section = Element("joints", calibration.span, children=[*joints])
            return Element("overlay", overlay.span, children=[section])
    return overlay


def _entry(name: str, key: Element, words: list[str]) -> Element:
    """Return an entry of an overlay with values of a calibration."""
    span = next((each.span for each in key.children if isinstance(each, Text)), key.span)
    return Element(name, key.span, children=[Text(" ".join(words), span)])


# --- Universal Robots ---------------------------------------------------------------------------


def _kinematics(overlaid: Overlaid, calibration: Element) -> list[Element]:
    """Return the poses of the joints above the links that a calibration names."""
    trace = overlaid.lowering.trace
    keys = given_once(calibration)
    hash_key = keys.pop("hash", None)
    above = {
        ends["child"]: name
        for name, joint in overlaid.elements("joint").items()
        if len(ends := ends_of(joint)) == 2
    }
    above = {link.removeprefix(overlaid.prefix): name for link, name in above.items()}
    first = f"{next(iter(keys))}_link"
    prefixes = [
        link.removesuffix(first)
        for link in above
        if link.endswith(first)
        and all(f"{link.removesuffix(first)}{name}_link" in above for name in keys)
    ]
    if len(prefixes) != 1:
        from ..diagnostics import did_you_mean

        missing = next((name for name in keys if f"{name}_link" not in above), "")
        several = " and ".join(f"'{prefix}'" for prefix in prefixes)
        raise failure(
            "unknown-link",
            f"the robot has several arms that this calibration may be of: {several}"
            if prefixes
            else f"this calibration is of a link '{missing}_link', and no joint leads to such a "
            "link in the robot",
            calibration.span if prefixes else keys[missing].span,
            hint="write overlay: beside the path of the arm, in `include` or `attach`"
            if prefixes
            else did_you_mean(f"{missing}_link", above)
            or "it is for a robot of Universal Robots, whose links have such names",
            trace=trace,
        )
    if hash_key is not None:
        value, span = read_value(hash_key)
        _set_parameter(overlaid, "", HASH, format_value(value), span)
    joints: list[Element] = []
    for name, key in keys.items():
        numbers = given_once(key, [each for row in POSES.values() for each in row])
        entries: list[Element] = []
        for row, names in POSES.items():
            words: list[str] = []
            for each in names:
                if each not in numbers:
                    raise failure(
                        "missing-key",
                        f"'{name}' has no '{each}'",
                        key.span,
                        hint=f"write {each}: 0",
                        trace=trace,
                    )
                value, span = read_value(numbers[each])
                kind = "length" if row == "xyz" else "angle"
                read = read_numbers(
                    overlaid.lowering, value, span, count=1, name=each, trace=trace, kind=kind
                )
                words += read.words
            entries.append(_entry(row, numbers[names[0]], words))
        joints.append(Element(above[f"{prefixes[0]}{name}_link"], key.span, children=[*entries]))
    return joints


# --- LeRobot ------------------------------------------------------------------------------------


def _motors(overlaid: Overlaid, calibration: Element) -> list[Element]:
    """Return the limits of the joints whose motors a calibration has."""
    joints = overlaid.elements("joint")
    made: list[Element] = []
    for name, key in given_once(calibration).items():
        entries = given_once(key, OF_MOTORS)
        values = {each: read_value(entry) for each, entry in entries.items()}
        numbers: dict[str, int] = {}
        for each, (value, span) in values.items():
            try:
                numbers[each] = int(format_value(value))
            except ValueError:
                raise failure(
                    "bad-number",
                    f"'{each}' is a whole number, and this is '{format_value(value)}'",
                    span,
                    hint="run lerobot-calibrate again",
                    trace=overlaid.lowering.trace,
                ) from None
        joint_name = name
        if name not in joints and str(numbers.get("id")) in joints:
            joint_name = str(numbers["id"])  # as the joints of older models are called
        for each, (value, span) in values.items():
            _set_parameter(overlaid, joint_name, each, format_value(value), span)
        joint = joints.get(joint_name)
        low, high = numbers["range_min"], numbers["range_max"]
        if joint is not None and high - low == STEPS:
            continue  # a motor that turns in full, whose range was not measured
        if high <= low:
            raise failure(
                "bad-number",
                f"the range of '{name}' ends at {high}, where it does not begin before",
                values["range_max"][1],
                hint="run lerobot-calibrate again",
                trace=overlaid.lowering.trace,
            )
        travel = (high - low) * tau / STEPS
        lower, upper = -travel / 2, travel / 2
        known = None if joint is None else _range_of(joint)
        if name == GRIPPER and known is not None:
            lower, upper = known[0], known[0] + travel
        elif known is not None and abs(sum(known)) / 2 > LARGEST_SHIFT:
            _warn_of_zero(overlaid, name, sum(known) / 2, key.span)
        limit = Element(
            "limit",
            key.span,
            children=[
                Element(each, entries[end].span, children=[Text(number, values[end][1])])
                for each, end, number in (
                    ("lower", "range_min", lower), ("upper", "range_max", upper)
                )
            ],
        )  # fmt: skip
        made.append(Element(joint_name, key.span, children=[limit]))
    return made


def _range_of(joint: Element) -> tuple[float, float] | None:
    limit = next((each for each in joint.elements() if each.name == "limit"), None)
    if limit is None:
        return None
    try:
        lower, upper = (
            float(format_value(limit.attributes.get(name, "0"))) for name in ("lower", "upper")
        )
    except ValueError:
        return None
    return lower, upper


def _warn_of_zero(overlaid: Overlaid, name: str, middle: float, span: Span) -> None:
    overlaid.lowering.report(
        "calibration-zero",
        f"LeRobot counts from the middle of the range of '{name}', which is at {middle:.4g} rad in "
        "this model",
        span,
        hint=f"move its zero with an overlay before this one: {name}: {{zero: {middle:.4g}}}",
        trace=overlaid.lowering.trace,
    )


# --- parameters of drivers ----------------------------------------------------------------------


def _set_parameter(overlaid: Overlaid, joint: str, name: str, text: str, span: Span) -> None:
    """Change a parameter of `ros2_control` if the robot has it: of the hardware, or of a joint."""
    robot = overlaid.robot
    for index, child in enumerate(robot.children):
        if isinstance(child, Element) and child.name == "ros2_control":
            changed = _with_parameter(child, overlaid.prefix + joint, name, text, span)
            if changed is not None:
                robot.children[index] = changed


def _with_parameter(
    element: Element, joint: str, name: str, text: str, span: Span
) -> Element | None:
    """Return an element with another value of a parameter in it; None if it has no such one."""
    for index, child in enumerate(element.children):
        if not isinstance(child, Element):
            continue
        is_param = child.name == "param" and child.attributes.get("name") == name
        if isinstance(element, Element) and element.name == "params" and child.name == name:
            is_param = True  # as the note of a section `control` has it
        changed: Element | None = None
        if is_param:
            before = next((each.span for each in child.children if isinstance(each, Text)), None)
            place = before or child.span
            note = f"it takes the place of {child.text().strip()}, at {place.place()}"
            changed = child.with_children([Text(text, OverlaidSpan(span, note, place))])
        elif child.name in ("hardware", "params") if not joint else child.name == "joint":
            if not joint or child.attributes.get("name") == joint:
                changed = _with_parameter(child, joint, name, text, span)
        if changed is not None:
            children = list(element.children)
            children[index] = changed
            return element.with_children(children)
    return None
