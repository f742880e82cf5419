"""Sensors that are written for Gazebo, copied with the elements that SDFormat knows.

Source: the descriptions of sensors in SDFormat 1.11, sensor.sdf and what that includes.
"""

from __future__ import annotations

from ...model.sdf_schema import SENSOR_TYPES
from ...model.values import attribute_text
from ...xml.tree import Element
from ..output import APPROXIMATED, LOST, RENAMED, Loss
from ..tags import Tag, unused
from .names import fault_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...diagnostics import Frame as Step
    from ...xml.tree import Node

WORDS = """
sensor: air_pressure altimeter always_on camera contact enable_metrics force_torque gps imu lidar
sensor: logical_camera magnetometer navsat pose ray rfid rfidtag sonar topic transceiver
sensor: update_rate visualize
air_pressure: pressure reference_altitude
altimeter: vertical_position vertical_velocity
angular_velocity: x y z
camera: box_type camera_info_topic clip depth_camera distortion horizontal_fov image lens noise pose
camera: save segmentation_type trigger_topic triggered visibility_mask
clip: far near
contact: collision topic
custom_function: c1 c2 c3 f fun
depth_camera: clip output
distortion: center k1 k2 k3 p1 p2
force: x y z
force_torque: force frame measure_direction torque
gps: position_sensing velocity_sensing
horizontal: max_angle min_angle noise resolution samples
image: anti_aliasing format height width
imu: angular_velocity enable_orientation linear_acceleration orientation_reference_frame
intrinsics: cx cy fx fy s
lens: custom_function cutoff_angle env_texture_size intrinsics projection scale_to_hfov type
lidar: noise range scan visibility_mask
linear_acceleration: x y z
logical_camera: aspect_ratio far horizontal_fov near
magnetometer: x y z
navsat: position_sensing velocity_sensing
noise: bias_mean bias_stddev dynamic_bias_correlation_time dynamic_bias_stddev mean precision stddev
noise: type
orientation_reference_frame: custom_rpy grav_dir_x localization
position_sensing: horizontal vertical
pressure: noise
projection: p_cx p_cy p_fx p_fy tx ty
range: max min resolution
ray: noise range scan visibility_mask
save: path
scan: horizontal vertical
sonar: geometry max min radius
torque: x y z
transceiver: essid frequency gain max_frequency min_frequency power sensitivity
velocity_sensing: horizontal vertical
vertical: max_angle min_angle noise resolution samples
vertical_position: noise
vertical_velocity: noise
x: noise
y: noise
z: noise
"""
"""What SDFormat 1.9 knows in the elements of a sensor: the element around, and those in it."""
SINCE_1_11 = frozenset(("air_speed",))
CUSTOM, OWN_TYPE = "custom", "gz:type"
"""The type of sensors that SDFormat does not know, and the attribute with their own type.
Source: its tutorial "Custom elements and attributes"."""
OPTICAL = "optical_frame_id"
"""Names a frame of a camera, since 1.11."""
FRAME_IDS = frozenset(("gz_frame_id", "ignition_frame_id", "frame_id"))
"""What names the frame of the measurements; SDFormat itself can since 1.12."""


class SensorCopier:
    """Copies sensors.

    Attributes:
        losses: what SDFormat does not know of them.
        has_custom: whether one has a type of its own, in an attribute of Gazebo's namespace.
    """

    __slots__ = ("_used", "_version", "_words", "has_custom", "losses")

    def __init__(self, version: str, losses: list[Loss]) -> None:
        """Start with a version of SDFormat; `losses` takes what it does not know."""
        self._version = version
        self._words = _table()
        self._used: dict[str, set[str]] = {}
        self.losses = losses
        self.has_custom = False

    def copied(self, sensor: Element, body: str, frame: str | None, trace: Step | None) -> Element:
        """Return a sensor.

        Args:
            sensor: the sensor as it is written.
            body: the link or joint of SDFormat that it goes to.
            frame: the frame that its pose is in, if it is not that of the body.
            trace: the calls and includes that led to it.
        """
        written = attribute_text(sensor, "name") or ""
        name = written or f"{body}_sensor"
        owner = f"sensor '{name}'" if written else f"sensor in '{body}'"
        made = sensor.with_children(self._known(sensor, owner, trace))
        plain = name if fault_of(name) is None else name.replace("::", "_").strip("_")
        new = unused(plain, self._used.setdefault(body, set()))
        attributes = {"name": new, **self._type_of(sensor, owner, trace)}
        made.attributes = {**made.attributes, **attributes}
        if new != written:
            what = "sensors of one name in one link"
            if plain != written:
                what = "sensors with names that SDFormat does not take"
            self.losses.append(Loss(RENAMED, what, owner, sensor.span, trace=trace, how=new))
        return _placed(made, frame)

    def _type_of(self, sensor: Element, owner: str, trace: Step | None) -> dict[str, str]:
        """Return the type in SDFormat, if it is another one: that of a custom sensor."""
        written = attribute_text(sensor, "type") or ""
        if written in SENSOR_TYPES and (written not in SINCE_1_11 or self._version != "1.9"):
            return {}
        what, how = (
            "sensors of other types than those of SDFormat",
            f"sensors of the type '{CUSTOM}'",
        )
        span = sensor.value_span("type")
        self.losses.append(Loss(APPROXIMATED, what, owner, span, trace=trace, how=how))
        if not written:
            return {"type": CUSTOM}
        self.has_custom = True
        return {"type": CUSTOM, OWN_TYPE: written}

    def _known(self, element: Element, owner: str, trace: Step | None) -> list[Node]:
        children: list[Node] = []
        for child in element.children:
            if not isinstance(child, Element) or (
                child.name == "plugin" and child.attributes.get("filename")
            ):
                children.append(child)
            elif child.name in FRAME_IDS and self._version == "1.12":
                children.append(Tag("frame_id", child.text().strip()).made(child.span, trace))
            elif self._knows(element.name, child.name):
                children.append(child.with_children(self._known(child, owner, trace)))
            else:
                what = f"Gazebo's <{child.name}> elements"
                self.losses.append(Loss(LOST, what, owner, child.span, trace=trace))
        return children

    def _knows(self, parent: str, child: str) -> bool:
        if child == OPTICAL:
            return parent == "camera" and self._version != "1.9"
        known = self._words.get(parent)
        return known is None or child in known


def _is_plugin(element: Element) -> bool:
    return element.name == "plugin" and bool(element.attributes.get("filename"))


def _table() -> dict[str, set[str]]:
    """Return the elements that are known, by the name of the element around."""
    found: dict[str, set[str]] = {}
    for row in WORDS.strip().splitlines():
        parent, _, children = row.partition(":")
        found.setdefault(parent, set()).update(children.split())
    return found


def _placed(sensor: Element, frame: str | None) -> Element:
    """Return a sensor with its pose relative to a frame, if one is given."""
    pose = next((each for each in sensor.elements() if each.name == "pose"), None)
    if pose is None:
        if frame is None:
            return sensor
        made = Tag("pose", relative_to=frame).made(sensor.span, sensor.trace)
        return sensor.with_children([made, *sensor.children])
    placed = pose.with_children(pose.children)
    placed.attributes = {k: v for k, v in pose.attributes.items() if k != "frame"}  # of SDF 1.6
    if frame is not None:
        placed.attributes = {"relative_to": frame, **placed.attributes}
    return sensor.with_children([placed if each is pose else each for each in sensor.children])
