"""Sensors of SDF: those that the model has, and what it does not hold of them."""

from __future__ import annotations

from ...model.recognition import DEFAULT_TOPIC, GazeboSensors
from ...model.values import attribute_text, content
from ...xml.tree import Element, RobotNote
from .kept import kept_of, leaf, placed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.pose import Pose
    from ...model.robot import Robot
    from ...xml.tree import Node
    from .kept import Held
    from .values import Reading

WRITTEN_TYPES = {"row": "gpu_lidar", "lidar": "gpu_lidar", "range": "gpu_lidar", "gps": "navsat"}
"""What SDF calls the types of the model that have another name there."""
SAME_TYPES = {"gpu_ray": "gpu_lidar", "gps": "navsat", "depth": "depth_camera"}
"""Older names of types, and what they are called now."""
SAME_NOISE = ("gaussian", "none", "", None)
"""Types of noise that the model has, or that say there is no noise; another one is kept."""
_SCAN: Held = {"samples": True, "min_angle": True, "max_angle": True}
_RANGE: Held = {"min": True, "max": True}
_ONE: Held = {"scan": {"horizontal": {"samples": True}}, "range": _RANGE}
_ROW: Held = {"scan": {"horizontal": _SCAN}, "range": _RANGE}
_ROWS: Held = {"scan": {"horizontal": _SCAN, "vertical": _SCAN}, "range": _RANGE}
DETAILS: dict[str, Held] = {
    "lidar": {"lidar": _ROWS, "ray": _ROWS},
    "row": {"lidar": _ROW, "ray": _ROW},
    "range": {"lidar": _ONE, "ray": _ONE, "sonar": {"min": True, "max": True}},
    "camera": {
        "camera": {
            "horizontal_fov": True,
            "image": {"width": True, "height": True},
            "clip": {"near": True, "far": True},
            "pose": True,
        }
    },
    "force_torque": {"force_torque": {}},
    "imu": {},
    "gps": {},
    "contact": {"contact": {}},
    "magnetometer": {},
}
"""What the model holds of the sensors of each of its types, besides their noise."""
DETAILS["depth_camera"] = DETAILS["camera"]
USUAL = {
    "always_on": ("1", "true"),
    "visualize": ("0", "false"),
    "resolution": ("1", "1.0", "1.000000"),
    **dict.fromkeys(("min_angle", "max_angle"), ("0", "0.0", "0.000000")),
    "samples": ("1",),
    "mean": ("0", "0.0"),
    "bias_mean": ("0", "0.0"),
    "bias_stddev": ("0", "0.0"),
    "frame": ("child",),
    "measure_direction": ("child_to_parent",),
    "topic": (DEFAULT_TOPIC,),
}
"""What is written, or the default, and so does not have to be kept."""


class Sensors:
    """Reads the sensors of a robot."""

    __slots__ = ("_reader", "_reading")

    def __init__(self, reading: Reading, robot: Robot) -> None:
        """Begin with a robot that has all links and joints."""
        self._reading = reading
        self._reader = GazeboSensors(robot, set())

    def add(
        self, sensor: Element, pose: Pose, home: str, name: str
    ) -> tuple[RobotNote | None, Element | None]:
        """Read a sensor; return its note, and what is kept of it for SDF.

        Args:
            sensor: the `<sensor>`.
            pose: where it is in its link or joint.
            home: the name of its link or joint.
            name: what it is called.
        """
        moved = placed(sensor, pose)
        moved.attributes = {**sensor.attributes, "name": name}
        before = len(self._reader.notes)
        self._reader.add(moved, self._reading.trace(sensor.span), home)
        made = self._reader.notes[before:]
        if len(made) != 1:
            del self._reader.notes[before:]
            moved.attributes = sensor.attributes
            return None, moved
        given = made[0].attributes
        has_noise = given.pop("noises", None) is None and "noise" in given
        kind = str(given["type"])
        if kind == "lidar" and given.get("rows") == "1":
            kind = "row"
        del given["written_name"]
        note = RobotNote("sensor", made[0].span, given, [], made[0].trace, made[0].value_spans)
        kept = self._kept(sensor, kind, name, has_noise=has_noise)
        written = (attribute_text(sensor, "name") or "").strip()
        if written and written != name:  # it is called so in SDF, where names are of a link
            if kept is None:
                kept = Element("sensor", sensor.span, {"name": name})
            kept.children.append(leaf("name", written, sensor.value_span("name")))
        return note, kept

    def _kept(self, sensor: Element, kind: str, name: str, *, has_noise: bool) -> Element | None:
        held: dict[str, bool | Held] = {
            "@name": True, "pose": True, "update_rate": True, "topic": True, **DETAILS[kind],
        }  # fmt: skip
        written = (attribute_text(sensor, "type") or "").strip()
        if SAME_TYPES.get(written, written) == WRITTEN_TYPES.get(kind, kind):
            held["@type"] = True
        rest = kept_of(sensor, held, name=name)
        if rest is None:
            return None
        rest = _without_usual(rest, has_noise=has_noise)
        if rest is None or (not rest.children and "type" not in rest.attributes):
            return None
        for child in rest.elements():
            if child.name == "ray":  # as the writer calls it
                child.name = "lidar"
            elif child.name == "gps":
                child.name = "navsat"
        return rest


def _without_usual(element: Element, *, has_noise: bool) -> Element | None:
    """Return what is not written anyway; None if nothing is left.

    Args:
        element: what is kept of a sensor.
        has_noise: whether the model holds the standard deviation.
    """
    children: list[Node] = []
    is_noise = element.name == "noise"
    for child in element.elements():
        if child.name == "plugin":
            children.append(child)
            continue
        if child.elements():
            inner = _without_usual(child, has_noise=has_noise)
            if inner is not None and (inner.children or inner.attributes):
                children.append(inner)
            continue
        text = (content(child) or "").lower()
        if text in USUAL.get(child.name, ()) or (not text and not child.attributes):
            continue
        if is_noise and has_noise and child.name in ("stddev", "type"):
            continue
        children.append(child)
    attributes = dict(element.attributes)
    if is_noise and (has_noise or not children) and attributes.get("type") in SAME_NOISE:
        attributes.pop("type", None)
    if not children and not attributes:
        return None
    return Element(
        element.name, element.span, attributes, children, element.trace, element.value_spans
    )
