"""What SDFormat and Gazebo read in `<gazebo>`: the elements, and which values each of them takes.

Sources: the descriptions of SDFormat 1.9 (sensor.sdf, camera.sdf, lidar.sdf, imu.sdf, noise.sdf,
surface.sdf, light.sdf …) with their least and greatest values, `parser_urdf.cc` of libsdformat for
what is directly in `<gazebo>`, and gazebo.material of Gazebo classic. The table is data;
`check/gazebo.py` applies it.
"""

from __future__ import annotations

from math import inf

TYPE_CHECKING = False
if TYPE_CHECKING:
    Table = dict[str, "Value | Table"]
    """The elements in an element: the value of each, or what is in it."""

NUMBER, INTEGER, COLOR, TRUTH, WORD, POSE = "number", "integer", "color", "truth", "word", "pose"


class Value:
    """Which values an element or attribute takes."""

    __slots__ = ("above", "count", "kind", "least", "most", "words")

    def __init__(
        self,
        kind: str = NUMBER,
        *,
        count: int = 1,
        least: float = -inf,
        most: float = inf,
        above: float = -inf,
        words: tuple[str, ...] = (),
    ) -> None:
        """Describe a value.

        Args:
            kind: NUMBER, INTEGER, COLOR (which may leave out the opacity), TRUTH, WORD or POSE.
            count: how many numbers it has.
            least: the least that each of them can be.
            most: the greatest.
            above: what each of them has to be greater than.
            words: the words that are known, of a WORD.
        """
        self.kind = kind
        self.count = count
        self.least = least
        self.most = most
        self.above = above
        self.words = words


ANY = Value()
NOT_NEGATIVE = Value(least=0.0)
POSITIVE = Value(above=0.0)
TRUE_OR_FALSE = Value(TRUTH)
THREE = Value(count=3)
COUNT = Value(INTEGER, least=0)
AT_LEAST_ONE = Value(INTEGER, least=1)
RGBA = Value(COLOR, count=4, least=0.0)
NOISES = Value(WORD, words=("none", "gaussian", "gaussian_quantized"))

NOISE: Table = {
    "@type": NOISES,
    "type": NOISES,
    "mean": ANY,
    "stddev": NOT_NEGATIVE,
    "bias_mean": ANY,
    "bias_stddev": NOT_NEGATIVE,
    "dynamic_bias_stddev": NOT_NEGATIVE,
    "dynamic_bias_correlation_time": NOT_NEGATIVE,
    "precision": NOT_NEGATIVE,
}
NOISY: Table = {"noise": NOISE}
AXES: Table = {"x": NOISY, "y": NOISY, "z": NOISY}
DIRECTIONS: Table = {"horizontal": NOISY, "vertical": NOISY}
POSITION: Table = {"position_sensing": DIRECTIONS, "velocity_sensing": DIRECTIONS}
SCAN: Table = {
    "samples": AT_LEAST_ONE,
    "resolution": POSITIVE,
    "min_angle": ANY,
    "max_angle": ANY,
}
RAYS: Table = {
    "scan": {"horizontal": SCAN, "vertical": SCAN},
    "range": {"min": NOT_NEGATIVE, "max": POSITIVE, "resolution": NOT_NEGATIVE},
    "noise": NOISE,
    "visibility_mask": COUNT,
}
CLIP: Table = {"near": NOT_NEGATIVE, "far": Value(least=0.1)}
FORMATS = (
    *("R8G8B8", "B8G8R8", "L8", "L16", "L_INT8", "L_INT16", "RGB_INT8", "RGBA_INT8", "BGRA_INT8"),
    *("RGB_INT16", "RGB_INT32", "BGR_INT8", "BGR_INT16", "BGR_INT32", "R_FLOAT16", "RGB_FLOAT16"),
    *("R_FLOAT32", "RGB_FLOAT32", "BAYER_RGGB8", "BAYER_BGGR8", "BAYER_GBRG8", "BAYER_GRBG8"),
)
CAMERA: Table = {
    "horizontal_fov": Value(least=0.1, most=6.283186),
    "image": {
        "width": AT_LEAST_ONE,
        "height": AT_LEAST_ONE,
        "format": Value(WORD, words=FORMATS),
        "anti_aliasing": COUNT,
    },
    "clip": CLIP,
    "depth_camera": {"clip": CLIP},
    "noise": NOISE,
    "distortion": {**dict.fromkeys(("k1", "k2", "k3", "p1", "p2"), ANY), "center": Value(count=2)},
    "lens": {
        "scale_to_hfov": TRUE_OR_FALSE,
        "cutoff_angle": Value(least=0.0, most=3.141592653),
        "env_texture_size": Value(INTEGER, least=4, most=2048),
        "intrinsics": {
            **dict.fromkeys(("fx", "fy"), POSITIVE),
            **dict.fromkeys(("cx", "cy", "s"), ANY),
        },
    },
    "pose": Value(POSE),
    "visibility_mask": COUNT,
}
SENSOR: Table = {
    "always_on": TRUE_OR_FALSE,
    "update_rate": NOT_NEGATIVE,
    "visualize": TRUE_OR_FALSE,
    "enable_metrics": TRUE_OR_FALSE,
    "topic": Value(WORD),
    "pose": Value(POSE),
    "air_pressure": {"reference_altitude": ANY, "pressure": NOISY},
    "altimeter": {"vertical_position": NOISY, "vertical_velocity": NOISY},
    "camera": CAMERA,
    "contact": {"collision": Value(WORD), "topic": Value(WORD)},
    "force_torque": {
        "frame": Value(WORD, words=("child", "parent", "sensor")),
        "measure_direction": Value(WORD, words=("child_to_parent", "parent_to_child")),
        "force": AXES,
        "torque": AXES,
    },
    "gps": POSITION,
    "navsat": POSITION,
    "imu": {
        "orientation_reference_frame": {"custom_rpy": THREE, "grav_dir_x": THREE},
        "angular_velocity": AXES,
        "linear_acceleration": AXES,
        "enable_orientation": TRUE_OR_FALSE,
        "noise": {"type": NOISES, "rate": NOISE, "accel": NOISE},  # SDFormat 1.4
    },
    "lidar": RAYS,
    "ray": RAYS,
    "logical_camera": {
        "near": NOT_NEGATIVE,
        "far": POSITIVE,
        "aspect_ratio": POSITIVE,
        "horizontal_fov": POSITIVE,
    },
    "magnetometer": AXES,
    "sonar": {"min": NOT_NEGATIVE, "max": POSITIVE, "radius": NOT_NEGATIVE},
    "plugin": Value(WORD),
}
SENSOR_TYPES = (
    *("air_pressure", "air_speed", "altimeter", "boundingbox", "boundingbox_camera", "camera"),
    *("contact", "custom", "depth", "depth_camera", "force_torque", "gps", "gpu_lidar", "gpu_ray"),
    *("imu", "lidar", "logical_camera", "magnetometer", "multicamera", "navsat", "ray", "rfid"),
    *("rfidtag", "rgbd", "rgbd_camera", "segmentation", "segmentation_camera", "sonar", "thermal"),
    *("thermal_camera", "wide_angle_camera", "wideanglecamera"),
    *("wireless_receiver", "wireless_transmitter"),
)
CONTENTS = {
    **{kind: (kind,) for kind in ("air_pressure", "altimeter", "contact", "force_torque", "imu")},
    **{kind: (kind,) for kind in ("logical_camera", "magnetometer", "sonar")},
    **dict.fromkeys(("gps", "navsat"), ("gps", "navsat")),
    **dict.fromkeys(("lidar", "ray"), ("lidar", "gpu_lidar", "ray", "gpu_ray")),
    "camera": (
        *("boundingbox", "boundingbox_camera", "camera", "depth", "depth_camera", "multicamera"),
        *("rgbd", "rgbd_camera", "segmentation", "segmentation_camera", "thermal"),
        *("thermal_camera", "wide_angle_camera", "wideanglecamera", "custom"),
    ),
}
"""The types of sensors that an element in a sensor is for."""
LIDARS = ("lidar", "gpu_lidar", "ray", "gpu_ray")
"""The types of sensors that are nothing without `<lidar>` or `<ray>`."""

FRICTION: Table = {
    "ode": {
        "mu": NOT_NEGATIVE,
        "mu2": NOT_NEGATIVE,
        "fdir1": THREE,
        "slip1": ANY,
        "slip2": ANY,
    },
    "bullet": {
        "friction": NOT_NEGATIVE,
        "friction2": NOT_NEGATIVE,
        "fdir1": THREE,
        "rolling_friction": ANY,
    },
    "torsional": {
        "coefficient": NOT_NEGATIVE,
        "use_patch_radius": TRUE_OR_FALSE,
        "patch_radius": NOT_NEGATIVE,
        "surface_radius": NOT_NEGATIVE,
    },
}
_ENGINE: Table = {
    "soft_cfm": ANY,
    "soft_erp": ANY,
    "kp": NOT_NEGATIVE,
    "kd": NOT_NEGATIVE,
}
SURFACE: Table = {
    "bounce": {
        "restitution_coefficient": Value(least=0.0, most=1.0),
        "threshold": NOT_NEGATIVE,
    },
    "friction": FRICTION,
    "contact": {
        "collide_without_contact": TRUE_OR_FALSE,
        "collide_bitmask": Value(WORD),
        "poissons_ratio": ANY,
        "ode": {**_ENGINE, "max_vel": ANY, "min_depth": ANY},
        "bullet": {**_ENGINE, "split_impulse": TRUE_OR_FALSE},
    },
}
COLLISION: Table = {
    "laser_retro": ANY,
    "max_contacts": COUNT,
    "pose": Value(POSE),
    "surface": SURFACE,
}
MATERIAL: Table = {
    **dict.fromkeys(("ambient", "diffuse", "specular", "emissive"), RGBA),
    "lighting": TRUE_OR_FALSE,
    "double_sided": TRUE_OR_FALSE,
}
VISUAL: Table = {
    "cast_shadows": TRUE_OR_FALSE,
    "laser_retro": ANY,
    "transparency": Value(least=0.0, most=1.0),
    "visibility_flags": COUNT,
    "pose": Value(POSE),
    "material": MATERIAL,
}
LIGHT: Table = {
    "@type": Value(WORD, words=("point", "spot", "directional")),
    "cast_shadows": TRUE_OR_FALSE,
    "intensity": NOT_NEGATIVE,
    "pose": Value(POSE),
    "diffuse": RGBA,
    "specular": RGBA,
    "direction": THREE,
    "attenuation": dict.fromkeys(("range", "linear", "constant", "quadratic"), NOT_NEGATIVE),
    "spot": dict.fromkeys(("inner_angle", "outer_angle", "falloff"), NOT_NEGATIVE),
}

RANGES = (
    ("min_angle", "max_angle"),
    ("min", "max"),
    ("near", "far"),
    ("inner_angle", "outer_angle"),
)
"""Elements beside each other of which the first must not be greater than the second."""

OF_LINKS: Table = {
    **dict.fromkeys(("mu1", "mu2", "kp", "kd", "maxVel", "minDepth"), NOT_NEGATIVE),
    "dampingFactor": NOT_NEGATIVE,
    "maxContacts": COUNT,
    "laserRetro": ANY,
    "fdir1": THREE,
    **dict.fromkeys(("gravity", "turnGravityOff", "selfCollide", "self_collide"), TRUE_OR_FALSE),
    **dict.fromkeys(("kinematic", "enable_wind"), TRUE_OR_FALSE),
    "material": Value(WORD),
    "sensor": SENSOR,
    "collision": COLLISION,
    "visual": VISUAL,
    "light": LIGHT,
}
"""What `<gazebo reference="…">` says about a link."""
OF_JOINTS: Table = {
    **dict.fromkeys(("stopCfm", "stopErp", "fudgeFactor"), ANY),
    **dict.fromkeys(("springReference", "springStiffness"), ANY),
    **dict.fromkeys(("provideFeedback", "implicitSpringDamper", "cfmDamping"), TRUE_OR_FALSE),
    **dict.fromkeys(("disableFixedJointLumping", "preserveFixedJoint"), TRUE_OR_FALSE),
    "sensor": SENSOR,
}
"""What it says about a joint."""
OF_MODELS: Table = {
    **dict.fromkeys(("static", "self_collide", "allow_auto_disable", "enable_wind"), TRUE_OR_FALSE),
    "plugin": Value(WORD),
}
"""What `<gazebo>` without a reference says about the robot as a whole."""
LENIENT = frozenset(
    """
    cfmDamping disableFixedJointLumping implicitSpringDamper preserveFixedJoint provideFeedback
    selfCollide static turnGravityOff
    """.split()
)
"""Truth values that libsdformat itself converts: of these it takes `yes` and `no` as well."""

MATERIALS = frozenset(
    """
    Black BlackTransparent Blue BlueGlow BlueLaser BlueTransparent BlueTransparentOverlay Bricks
    BuildingFrame CeilingTiled CloudySky CoM DarkGrey DarkMagentaTransparent
    DarkOrangeTransparentOverlay DarkYellow Editor EditorPlane FlatBlack Footway Gold Grass Green
    GreenGlow GreenTransparent GreenTransparentOverlay Grey GreyGradientSky GreyTransparent Indigo
    JointAnchor Lane_1 Lanes_2 Lanes_4 Lanes_6 LightBlueLaser LightOff LightOn Motorway Orange
    OrangeTransparent OrangeTransparentOverlay PaintedWall Pedestrian Pioneer2Body PioneerBody
    Primary Purple PurpleGlow Red RedBright RedGlow RedTransparent RedTransparentOverlay
    Residential Road Runway Secondary SkyBlue Steps Tertiary Trunk Turquoise TurquoiseGlow
    TurquoiseGlowOutline White WhiteGlow WindowFrame Wood WoodFloor WoodPallet Yellow YellowGlow
    YellowTransparent ZincYellow
    """.split()
)
"""The materials `Gazebo/…` that come with Gazebo."""

PLUGIN_JOINTS = frozenset(
    """
    front_left_joint front_right_joint jointName joint_name leftJoint left_joint
    left_wheel_joint_name rightJoint right_joint right_wheel_joint_name
    """.split()
)
PLUGIN_LINKS = frozenset(("bodyName", "body_name", "linkName", "link_name"))
"""Elements in which the plugins of gazebo_ros_pkgs and Gazebo name a joint or a link."""
