"""Sensors and surfaces of SDFormat, in SDF and in the `<gazebo>` elements of URDF.

Those that a file holds for Gazebo are copied with the elements that SDFormat knows.

Source: the specification of SDFormat 1.9 and 1.11, http://sdformat.org/spec: sensor.sdf and what
that includes.
"""

from __future__ import annotations

from ...model.extras import MEASURED, Camera, Lidar, Ranger
from ...model.sdf_schema import SENSOR_TYPES
from ...model.values import attribute_text
from ...xml.tree import Element
from ..elements import UsedNames, element, given, settle
from ..losses import APPROXIMATED, RENAMED, Loss
from .links import fault_of, pose_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from ...diagnostics import Frame as Step
    from ...model.extras import Sensor, Surface
    from ...xml.tree import Node
    from ..elements import Attributes
    from ..losses import Losses


TYPES = {"lidar": "gpu_lidar", "range": "gpu_lidar", "gps": "navsat"}
"""The types of sensors that Gazebo calls otherwise."""


def type_of(sensor: Sensor) -> str:
    """Return the type of a sensor in SDFormat."""
    return TYPES.get(sensor.type, sensor.type)


def times_of(sensor: Sensor) -> list[Element]:
    """Return how often a sensor measures, and where it says what it has measured."""
    return given(("always_on", "true"), ("update_rate", sensor.rate), ("topic", sensor.topic))


def details_of(
    sensor: Sensor, collisions: Sequence[str], *, has_optical: bool = True
) -> list[Element]:
    """Return what a sensor has of its type.

    Args:
        sensor: the sensor.
        collisions: the names of the shapes that a contact sensor feels.
        has_optical: whether the optical frame of a camera is named, which SDFormat 1.9 has not.
    """
    noise, details = _noise(sensor, sensor.noise), sensor.details
    if isinstance(details, Lidar):
        rays = _rays("horizontal", details.rays, details.ends())
        if details.rows > 1:
            rays += _rays("vertical", details.rows, details.tilt_ends())
        scan, ends = element("scan", children=rays), _range(details.range)
        return [element("lidar", children=[scan, ends, *noise])]
    if isinstance(details, Ranger):
        scan = element("scan", children=_rays("horizontal", 1, (0.0, 0.0)))
        return [element("lidar", children=[scan, _range(details.range), *noise])]
    if isinstance(details, Camera):
        optical = given(("optical_frame_id", sensor.optical_frame or "" if has_optical else None))
        return [element("camera", children=[*_camera(sensor, details), *optical, *noise])]
    if sensor.type == "contact":
        felt = given(*(("collision", name) for name in collisions))
        return [element("contact", children=felt)]
    if sensor.type == "force_torque":
        parts = given(("frame", "child"), ("measure_direction", "child_to_parent"))
        parts += _of_quantities(sensor)
        return [element("force_torque", children=parts)]
    if sensor.type == "imu":
        parts = _of_quantities(sensor)
        return [element("imu", children=parts)] if parts else []
    if not noise:
        return []
    if sensor.type == "magnetometer":
        return [_by_axis("magnetometer", noise)]
    both = [element(name, children=noise) for name in ("horizontal", "vertical")]
    return [element("navsat", children=[element("position_sensing", children=both)])]


def _rays(name: str, count: int, ends: tuple[float, float]) -> list[Element]:
    """Return samples from the first to the last angle, which Gazebo both includes."""
    first, last = ends
    rays = given(("samples", count), ("resolution", 1), ("min_angle", first), ("max_angle", last))
    return [element(name, children=rays)]


def _range(ends: tuple[float, float]) -> Element:
    return element("range", children=given(("min", ends[0]), ("max", ends[1])))


def _camera(sensor: Sensor, camera: Camera) -> list[Element]:
    width, height = camera.size
    pixels = "R_FLOAT32" if sensor.type == "depth_camera" else "R8G8B8"
    image = given(("width", width), ("height", height), ("format", pixels))
    clip = given(("near", camera.clip[0]), ("far", camera.clip[1]))
    return [
        element("horizontal_fov", text=camera.fov),
        element("image", children=image),
        element("clip", children=clip),
    ]


def _noise(sensor: Sensor, deviation: float | None) -> list[Element]:
    """Return the noise of a sensor: lidars and cameras have its type as an element in it."""
    if deviation is None:
        return []
    values = given(("mean", 0.0), ("stddev", deviation))
    if sensor.details is not None:
        return [element("noise", children=[*given(("type", "gaussian")), *values])]
    return [element("noise", {"type": "gaussian"}, children=values)]


def _of_quantities(sensor: Sensor) -> list[Element]:
    """Return the noise of each quantity that a sensor measures, along each axis."""
    found = []
    for name in MEASURED[sensor.type]:
        noise = _noise(sensor, sensor.noises.get(name, sensor.noise))
        if noise:
            found.append(_by_axis(name, noise))
    return found


def _by_axis(name: str, noise: list[Element]) -> Element:
    return element(name, children=[element(axis, children=noise) for axis in "xyz"])


def surface_of(surface: Surface | None, more: Iterable[tuple[str, Element]] = ()) -> Element:
    """Return the surface of a collision.

    Args:
        surface: what is known of it.
        more: what else is in it for ODE, each with `friction` or `contact`.
    """
    friction: list[Element] = []
    bounce: list[Element] = []
    contact: list[Element] = []
    if surface is not None:
        friction = given(("mu", surface.friction), ("mu2", surface.friction2))
        bounce = given(("restitution_coefficient", surface.restitution))
        contact = given(("kp", surface.stiffness), ("kd", surface.damping))
    friction += [each for section, each in more if section == "friction"]
    contact += [each for section, each in more if section == "contact"]
    parts = []
    if friction:
        ode = element("ode", children=friction)
        parts.append(element("friction", children=[ode]))
    if bounce:
        parts.append(element("bounce", children=bounce))
    if contact:
        ode = element("ode", children=contact)
        parts.append(element("contact", children=[ode]))
    return element("surface", children=parts, owner=surface)


def sensor_of(sensor: Sensor, *, frame: str | None, collisions: list[str], version: str) -> Element:
    """Return a sensor of a link or joint.

    Args:
        sensor: the sensor.
        frame: the frame that it measures in, if it is not that of its link or joint.
        collisions: the names of its link's collisions.
        version: of SDFormat; 1.12 can name the frame of what is measured.
    """
    content = [
        *pose_of(sensor.pose, frame),
        *times_of(sensor),
        *given(("frame_id", sensor.frame if version == "1.12" else None)),
        *details_of(sensor, collisions, has_optical=version != "1.9"),
    ]
    attributes: Attributes = {"name": sensor.name, "type": type_of(sensor)}
    return element("sensor", attributes, children=content, owner=sensor)


# --- sensors ----------------------------------------------------------------------------------


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

    def __init__(self, version: str, losses: Losses) -> None:
        """Start with a version of SDFormat; `losses` takes what it does not know."""
        self._version = version
        self._words: dict[str, set[str]] = {}  # in which element which ones are known
        for row in WORDS.strip().splitlines():
            parent, _, children = row.partition(":")
            self._words.setdefault(parent, set()).update(children.split())
        self._used = UsedNames()
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
        new = self._used.fresh(body, plain)
        attributes = {"name": new, **self._type_of(sensor, owner, trace)}
        made.attributes = {**made.attributes, **attributes}
        if new != written:
            what = "sensors of one name in one link"
            if plain != written:
                what = "sensors with names that SDFormat does not take"
            self.losses.append(Loss(RENAMED, what, owner, sensor.span, trace=trace, how=new))
        pose = next((each for each in made.elements() if each.name == "pose"), None)
        if pose is None:
            if frame is None:
                return made
            at_frame = element("pose", {"relative_to": frame}, owner=made)
            return made.with_children([at_frame, *made.children])
        placed = pose.with_children(pose.children)
        placed.attributes = {k: v for k, v in pose.attributes.items() if k != "frame"}  # of SDF 1.6
        if frame is not None:
            placed.attributes = {"relative_to": frame, **placed.attributes}
        return made.with_children([placed if each is pose else each for each in made.children])

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

    def _known(self, around: Element, owner: str, trace: Step | None) -> list[Node]:
        children: list[Node] = []
        known = self._words.get(around.name)
        for child in around.children:
            if not isinstance(child, Element) or (
                child.name == "plugin" and child.attributes.get("filename")
            ):
                children.append(child)
                continue
            is_known = known is None or child.name in known
            if child.name == OPTICAL:
                is_known = around.name == "camera" and self._version != "1.9"
            if child.name in FRAME_IDS and self._version == "1.12":
                named = element("frame_id", text=child.text().strip())
                settle([named], child.span, trace)
                children.append(named)
            elif is_known:
                children.append(child.with_children(self._known(child, owner, trace)))
            else:
                what = f"Gazebo's <{child.name}> elements"
                self.losses.lose_xml(what, child, label=owner, trace=trace)
        return children
