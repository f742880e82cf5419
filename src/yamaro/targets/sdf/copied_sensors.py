"""Sensors that are written for Gazebo, copied with the elements that SDFormat knows.

Source: the descriptions of sensors in SDFormat 1.11, sensor.sdf and what that includes.
"""

from __future__ import annotations

from ...xml.tree import Element
from ..output import LOST, Loss
from ..tags import Tag

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...diagnostics import Frame as Step
    from ...xml.tree import Node

WORDS = frozenset(
    """
    air_pressure air_speed altimeter always_on angular_velocity anti_aliasing aspect_ratio
    bias_mean bias_stddev box_type c1 c2 c3 camera camera_info_topic center clip collision contact
    custom_function custom_rpy cutoff_angle cx cy depth_camera distortion
    dynamic_bias_correlation_time dynamic_bias_stddev enable_metrics enable_orientation
    env_texture_size essid f far force force_torque format frame frequency fun fx fy gain geometry
    gps grav_dir_x height horizontal horizontal_fov image imu intrinsics k1 k2 k3 lens lidar
    linear_acceleration localization logical_camera magnetometer max max_angle max_frequency mean
    measure_direction min min_angle min_frequency navsat near noise orientation_reference_frame
    output p1 p2 p_cx p_cy p_fx p_fy path plugin pose position_sensing power precision pressure
    projection radius range ray reference_altitude resolution rfid rfidtag s samples save
    scale_to_hfov scan segmentation_type sensitivity sensor sonar stddev topic torque transceiver
    trigger_topic triggered tx ty type update_rate velocity_sensing vertical vertical_position
    vertical_velocity visibility_mask visualize width x y z
    """.split()
)
"""The elements that SDFormat 1.9 knows in a sensor, at any depth."""
SINCE_1_11 = frozenset(("optical_frame_id",))
FRAME_IDS = frozenset(("gz_frame_id", "ignition_frame_id", "frame_id"))
"""What names the frame of the measurements; SDFormat itself can since 1.12."""


class SensorCopier:
    """Copies sensors.

    Attributes:
        losses: what SDFormat does not know of them.
    """

    __slots__ = ("_version", "_words", "losses")

    def __init__(self, version: str, losses: list[Loss]) -> None:
        """Start with a version of SDFormat; `losses` takes what it does not know."""
        self._version = version
        self._words = WORDS if version == "1.9" else WORDS | SINCE_1_11
        self.losses = losses

    def copied(self, sensor: Element, frame: str | None, trace: Step | None) -> Element:
        """Return a sensor, with its pose in the frame of its link where that is not its body's."""
        owner = f"sensor '{sensor.attributes.get('name')}'"
        made = sensor.with_children(self._known(sensor, owner, trace))
        return made if frame is None else _placed(made, frame)

    def _known(self, element: Element, owner: str, trace: Step | None) -> list[Node]:
        children: list[Node] = []
        for child in element.children:
            if not isinstance(child, Element) or child.name == "plugin":
                children.append(child)
            elif child.name in FRAME_IDS and self._version == "1.12":
                children.append(Tag("frame_id", child.text().strip()).made(child.span, trace))
            elif child.name in self._words:
                children.append(child.with_children(self._known(child, owner, trace)))
            else:
                what = f"Gazebo's <{child.name}>"
                self.losses.append(Loss(LOST, what, owner, child.span, trace=trace))
        return children


def _placed(sensor: Element, frame: str) -> Element:
    """Return a sensor with its pose relative to a frame."""
    pose = next((each for each in sensor.elements() if each.name == "pose"), None)
    if pose is None:
        made = Tag("pose", relative_to=frame).made(sensor.span, sensor.trace)
        return sensor.with_children([made, *sensor.children])
    placed = pose.with_children(pose.children)
    placed.attributes = {"relative_to": frame, **pose.attributes}
    return sensor.with_children([placed if each is pose else each for each in sensor.children])
