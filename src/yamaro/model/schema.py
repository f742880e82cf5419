"""The schema of a robot: each value of each thing that a robot has, said once.

A `Thing` is an element of URDF, such as `limit`, or what words of YAML add to it, such as an
actuator; a `Field` is one of its values. A field has one name everywhere: it is the key in YAML,
the attribute in URDF, and the attribute of the object in the model. Code that deals with all
fields loops over these rows: the readers of parts and of URDF, the check of values, `diff`, mirrors
and the editor. What deals with one field, such as the inertia of a shape, is code of its own.

Sources: urdfdom's parser and its `xsd/urdf.xsd`; URDF 1.1 adds `capsule` and `quat_xyzw`, 1.2 the
acceleration, deceleration and jerk limits.
"""

from __future__ import annotations

from math import pi, tau

from ..diagnostics import did_you_mean, suggest
from .shapes import SHAPE_WORDS, SIMPLE_SHAPES

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..xml.tree import Element
    from .shapes import SimpleShape

TEXT = 0
"""The `count` of a field that is not made of numbers."""

ANY = "any"
NOT_NEGATIVE = "not negative"
POSITIVE = "positive"
NOT_ZERO = "not zero"
PART = "from 0 to 1"
WHOLE = "whole, from 1"
COUNT = "whole, from 0"

KEPT, NEGATED = "kept", "negated"

ONCE = "once"
OFTEN = "often"


class Field:
    """One value of a thing.

    Attributes:
        name: its name in YAML, in URDF and in the model.
        count: how many numbers it holds, or TEXT.
        kind: what the numbers measure: a word of `model/quantities.py`.
        sign: which numbers make sense: ANY, NOT_NEGATIVE, POSITIVE, NOT_ZERO, PART,
            WHOLE or COUNT.
        required: whether parsers refuse or drop the thing without it.
        default: what the model has where it is left out.
        reversal: how it changes where the positions of its joint count the other way: it is KEPT,
            NEGATED, or changes places, negated, with the field of this name.
        choices: the words that it may be, if only some may.
        help: what the editor and the docs say of it, beside its unit and default.
        example: a value, for hints.
        parts: what each of several numbers is, in words.
        in_urdf: whether URDF has it, if it has the thing; what it has not is in a note at the end.
    """

    __slots__ = (
        "choices", "count", "default", "example", "help", "in_urdf", "kind", "name", "parts",
        "required", "reversal", "sign",
    )  # fmt: skip

    def __init__(
        self,
        name: str,
        count: int = 1,
        kind: str = "number",
        *,
        sign: str = ANY,
        required: bool = False,
        default: float | tuple[float, ...] | str | None = None,
        reversal: str = KEPT,
        choices: tuple[str, ...] = (),
        help: str = "",
        example: str = "",
        parts: str = "",
        in_urdf: bool = True,
    ) -> None:
        """Describe a field; see the class."""
        self.name = name
        self.count = count
        self.kind = kind
        self.sign = sign
        self.required = required
        self.default = default
        self.reversal = reversal
        self.choices = choices
        self.help = help
        self.example = example
        self.parts = parts
        self.in_urdf = in_urdf

    def __repr__(self) -> str:
        return f"<Field '{self.name}'>"


class Thing:
    """Something that a robot has: an element of URDF, or what words of YAML say besides.

    Attributes:
        name: its name: that of the element or of the word.
        fields: its values by name, in the order in which they are listed and compared.
        attributes: those that its element has in URDF.
        children: the elements that may be in it, each ONCE or OFTEN.
        required: the names of the fields that it must have.
        required_children: the elements that it must have.
        extensions: further elements and attributes that known tools read there; their content is
            theirs.
        scalar: the field that a bare value sets, as in `axis: 0 0 1`; None if it takes none.
    """

    __slots__ = (
        "attributes", "children", "extensions", "fields", "name", "required", "required_children",
        "scalar",
    )  # fmt: skip

    def __init__(
        self,
        name: str,
        *fields: Field,
        children: dict[str, str] | None = None,
        required_children: tuple[str, ...] = (),
        extensions: tuple[str, ...] = (),
        scalar: str | None = None,
    ) -> None:
        """Describe a thing; see the class."""
        self.name = name
        self.fields = {field.name: field for field in fields}
        self.attributes = {field.name: field for field in fields if field.in_urdf}
        self.children = children if children is not None else {}
        self.required = tuple([field.name for field in fields if field.required])
        self.required_children = required_children
        self.extensions = frozenset(extensions)
        self.scalar = scalar

    def numbers(self) -> dict[str, int]:
        """Return the fields that are made of numbers, each with how many."""
        return {name: field.count for name, field in self.fields.items() if field.count != TEXT}

    def __repr__(self) -> str:
        return f"<Thing '{self.name}'>"


JOINT_TYPES = ("revolute", "continuous", "prismatic", "fixed", "floating", "planar")
OTHER_JOINT_TYPES = {
    "hinge": "revolute",
    "rotary": "revolute",
    "rotational": "revolute",
    "slider": "prismatic",
    "linear": "prismatic",
    "sliding": "prismatic",
    "weld": "fixed",
    "free": "floating",
}
"""What other formats call the types of joints."""
VERSIONS = ("1.0", "1.1", "1.2")
MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
"""The fields of `inertia`, in the order of `Inertia`."""
AXES = ("x", "y", "z", "-x", "-y", "-z")
"""The words for an axis."""
COMMANDS = ("position", "velocity", "effort")
"""The commands of an actuator; of several, the first of these is the usual one."""
FITS = ("box", "cylinder", "sphere", "capsule", "hull", "best")
"""The shapes that are fitted to meshes."""
MOST_SHAPES = 1_000
"""Pieces or spheres that one mesh can become."""
DEFAULT_SAMPLES, DEFAULT_SEED = 10_000, 1
"""How the pairs of links that never collide are found."""

# --- URDF -------------------------------------------------------------------------------------

_NAME = Field("name", TEXT, required=True, help="its name", example="my_name")
_OPTIONAL_NAME = Field("name", TEXT, help="its name")
_SHAPED = {"origin": ONCE, "geometry": ONCE}
_SHAPE_HELP = {
    "size": "the lengths of a box's sides, x y z",
    "radius": "the radius of a cylinder, sphere or capsule",
    "length": "the length of a cylinder, or of the cylinder in a capsule",
}


def _shape(kind: str, shape: type[SimpleShape]) -> Thing:
    """Return a simple shape, whose sizes are in one field or in one for each."""
    count = len(shape.sizes) // len(shape.attributes)
    examples = shape.example.split() if count == 1 else [shape.example]
    fields = [
        Field(name, count, "length", sign=POSITIVE, required=True, help=_SHAPE_HELP[name],
              example=example, parts="x y z" if count == 3 else "")
        for name, example in zip(shape.attributes, examples, strict=True)
    ]  # fmt: skip
    return Thing(kind, *fields)


_THINGS = (
    Thing(
        "robot",
        _NAME,
        Field("version", TEXT, help="the version of URDF", example="1.0"),
        children={"link": OFTEN, "joint": OFTEN, "material": OFTEN},
    ),
    Thing(
        "link",
        _NAME,
        # Not documented, but used by the PR2 and allowed by urdf.xsd.
        Field("type", TEXT, help="a word that some programs read"),
        children={"inertial": ONCE, "visual": OFTEN, "collision": OFTEN},
        # PyBullet reads `contact` and `concave`, HPP and RobCoGen `self_collision_checking`.
        extensions=("contact", "sensor", "self_collision_checking", "concave"),
    ),
    Thing(
        "visual",
        _OPTIONAL_NAME,
        children={**_SHAPED, "material": ONCE},
        required_children=("geometry",),
    ),
    Thing(
        "collision",
        _OPTIONAL_NAME,
        children=_SHAPED,
        required_children=("geometry",),
        extensions=("verbose", "group", "concave"),
    ),
    Thing(
        "inertial",
        children={"origin": ONCE, "mass": ONCE, "inertia": ONCE},
        required_children=("mass", "inertia"),
    ),
    Thing(
        "mass",
        Field("value", 1, "mass", required=True, default=0.0, help="the mass",
              example="1.0"),
    ),
    Thing(
        "inertia",
        *[
            Field(name, 1, "inertia", required=True, default=0.0,
                  help="a moment or product of inertia about the centre of mass",
                  example="0.01" if name[1] == name[2] else "0")
            for name in MOMENTS
        ],
    ),
    Thing(
        "origin",
        Field("xyz", 3, "length", default=(0.0, 0.0, 0.0), example="0 0 1", parts="x y z",
              help="the position x y z"),
        Field("rpy", 3, "angle", default=(0.0, 0.0, 0.0), example="0 0 1.57",
              parts="roll pitch yaw",
              help="roll, pitch and yaw about fixed axes"),
        Field("quat_xyzw", 4, example="0 0 0 1", parts="x y z w",
              help="the rotation as a quaternion; URDF 1.1"),
    ),
    Thing("geometry", children=dict.fromkeys(SHAPE_WORDS, ONCE)),
    *[_shape(kind, shape) for kind, shape in SIMPLE_SHAPES.items()],
    Thing(
        "mesh",
        Field("filename", TEXT, required=True, help="the file of the mesh",
              example="package://my_robot/meshes/arm.stl"),
        Field("scale", 3, default=(1.0, 1.0, 1.0), help="the factors of the mesh",
              example="0.001 0.001 0.001", parts="x y z"),
    ),
    Thing(
        "material",
        Field("name", TEXT, required=True, help="the name of the material", example="my_name"),
        children={"color": ONCE, "texture": ONCE},
        scalar="name",
    ),
    Thing(
        "color",
        Field("rgba", 4, required=True, help="red, green, blue and alpha, from 0 to 1",
              example="0.8 0.8 0.8 1", parts="red green blue alpha"),
        scalar="rgba",
    ),
    Thing(
        "texture",
        Field("filename", TEXT, required=True, help="an image file",
              example="package://my_robot/meshes/arm.stl"),
        scalar="filename",
    ),
    Thing(
        "joint",
        _NAME,
        Field("type", TEXT, required=True, choices=JOINT_TYPES, example="fixed",
              help="revolute, continuous, prismatic, fixed, floating or planar"),
        children=dict.fromkeys(
            ("origin", "parent", "child", "axis", "calibration", "dynamics", "limit", "mimic",
             "safety_controller"),
            ONCE,
        ),
        required_children=("parent", "child"),
    ),
    Thing(
        "parent",
        Field("link", TEXT, required=True, help="the name of a link", example="base"),
        scalar="link",
    ),
    Thing("child", Field("link", TEXT, required=True, help="the name of a link", example="base")),
    Thing(
        "axis",
        Field("xyz", 3, required=True, default=(1.0, 0.0, 0.0), example="0 0 1", parts="x y z",
              help="the joint's axis: three numbers, or x, y, z, -x, -y, -z"),
        scalar="xyz",
    ),
    Thing(
        "limit",
        Field("lower", 1, "position", default=0.0, reversal="upper", example="-1.57",
              help="the least position"),
        Field("upper", 1, "position", default=0.0, reversal="lower", example="1.57",
              help="the greatest position"),
        Field("effort", 1, "effort", sign=NOT_NEGATIVE, required=True, example="10",
              help="the greatest torque or force"),
        Field("velocity", 1, "velocity", sign=NOT_NEGATIVE, required=True, example="2",
              help="the greatest speed"),
        Field("acceleration", 1, "acceleration of a joint", sign=NOT_NEGATIVE, example="5",
              help="the greatest acceleration (URDF 1.2)"),
        Field("deceleration", 1, "acceleration of a joint", sign=NOT_NEGATIVE, example="5",
              help="the greatest deceleration (URDF 1.2)"),
        Field("jerk", 1, "jerk", sign=NOT_NEGATIVE, example="50",
              help="the greatest jerk (URDF 1.2)"),
    ),
    Thing(
        "dynamics",
        Field("damping", 1, "damping", sign=NOT_NEGATIVE, default=0.0, example="0.1",
              help="the viscous friction"),
        Field("friction", 1, "effort", sign=NOT_NEGATIVE, default=0.0, example="0.1",
              help="the static friction"),
        Field("armature", 1, "armature", sign=NOT_NEGATIVE, default=0.0, example="0.01",
              in_urdf=False,
              help="the inertia of a rotor at the joint, which an `actuator` may give as well"),
    ),
    Thing(
        "mimic",
        Field("joint", TEXT, required=True, example="left_finger_joint",
              help="the joint, or part, that is followed"),
        Field("multiplier", 1, "ratio", default=1.0, example="-1",
              help="position = multiplier · position of the other + offset"),
        Field("offset", 1, "position", default=0.0, example="0.1",
              help="what is added to the position"),
        scalar="joint",
    ),
    Thing(
        "safety_controller",
        Field("soft_lower_limit", 1, "position", default=0.0, reversal="soft_upper_limit",
              example="-1.5", help="where the lower limit of the controller begins"),
        Field("soft_upper_limit", 1, "position", default=0.0, reversal="soft_lower_limit",
              example="1.5", help="where the upper limit of the controller begins"),
        Field("k_position", 1, "rate", default=0.0, example="15", help="the position gain"),
        Field("k_velocity", 1, "damping", required=True, default=0.0, example="10",
              help="the velocity gain"),
    ),
    Thing(
        "calibration",
        Field("rising", 1, "position", reversal=NEGATED, example="0.1",
              help="the position of a rising edge"),
        Field("falling", 1, "position", reversal=NEGATED, example="0.1",
              help="the position of a falling edge"),
        Field("reference_position", 1, "position", reversal=NEGATED, example="0.1",
              help="the position of the reference"),
    ),
)  # fmt: skip

ELEMENTS = {thing.name: thing for thing in _THINGS}
"""The elements of URDF by name; URDF never uses a name for two things."""

RECORDS = ("axis", "limit", "dynamics", "mimic", "safety_controller", "calibration")
"""The elements of a joint that a part writes as keys with fields."""
OF_1_2 = ("acceleration", "deceleration", "jerk")
"""Limits that came with URDF 1.2."""
OPTIONAL_SINCE_1_2 = frozenset(("effort", "velocity"))
"""Limits that URDF 1.2 takes as unbounded when they are left out."""

# --- what words of YAML say besides -----------------------------------------------------------

ACTUATOR = Thing(
    "actuator",
    Field("command", TEXT, choices=COMMANDS, default="position", example="position",
          help="position, velocity or effort"),
    Field("kp", 1, "stiffness", sign=NOT_NEGATIVE, example="50", help="the position gain"),
    Field("kd", 1, "damping", sign=NOT_NEGATIVE, example="2", help="the velocity gain"),
    Field("frequency", 1, "frequency", sign=POSITIVE, example="10",
          help="the natural frequency of the joint with its armature, in place of `kp` and `kd`"),
    Field("damping_ratio", 1, sign=NOT_NEGATIVE, default=1.0, example="2",
          help="the damping ratio with `frequency`; 1 is critical damping"),
    Field("armature", 1, "armature", sign=NOT_NEGATIVE, example="0.01",
          help="the inertia of the rotor at the joint"),
    Field("rotor_inertia", 1, "inertia", sign=NOT_NEGATIVE, example="1e-05",
          help="the inertia of the rotor at the motor, in place of `armature`"),
    Field("gear", 1, sign=NOT_ZERO, default=1.0, example="50",
          help="how often the motor turns for one turn of the joint"),
    Field("stall_torque", 1, "effort", sign=POSITIVE, example="4",
          help="the greatest torque or force at the joint, at rest"),
    Field("no_load_speed", 1, "velocity", sign=POSITIVE, example="5",
          help="the speed of the joint at which no torque or force is left"),
    Field("delay", 1, "time", sign=NOT_NEGATIVE, example="0.005",
          help="how long after a command it is obeyed"),
    Field("motor", TEXT, example="xm430_w350",
          help="a motor of the catalogue, or a mapping of entries that it has"),
)  # fmt: skip

OF_MOTOR = tuple([name for name in ACTUATOR.fields if name not in ("command", "kp", "kd", "motor")])
"""The entries of an actuator that its motor can have."""

SURFACE = Thing(
    "surface",
    Field("friction", 1, sign=NOT_NEGATIVE, example="0.8", help="the coefficient of friction"),
    Field("friction2", 1, sign=NOT_NEGATIVE, example="0.8",
          help="the coefficient in the second direction"),
    Field("restitution", 1, sign=PART, example="0.5",
          help="how much of the speed is kept at a bounce, from 0 to 1"),
    Field("stiffness", 1, "contact stiffness", sign=NOT_NEGATIVE, example="100000",
          help="the stiffness of the contact"),
    Field("damping", 1, "contact damping", sign=NOT_NEGATIVE, example="10",
          help="the damping of the contact"),
)  # fmt: skip

FITTING = Thing(
    "fitting",
    Field("fit", TEXT, choices=FITS, example="capsule",
          help="a shape fitted to the mesh: box, cylinder, sphere or capsule, `best` of these, or "
          "the convex `hull`"),
    Field("decompose", 1, sign=WHOLE, example="8",
          help="the greatest number of convex pieces that make up the mesh"),
    Field("spheres", 1, sign=WHOLE, example="24",
          help="the greatest number of spheres that fill the mesh"),
    Field("cover", TEXT, choices=("true", "false"), default="false",
          help="whether `fit`, `decompose` or `spheres` have to contain the mesh"),
    Field("triangles", 1, sign=WHOLE, example="20000",
          help="of a visual: the greatest number of triangles, with which the mesh is simplified"),
)  # fmt: skip
"""What a collision or visual says of a shape that is worked out from its mesh."""

SENSOR = Thing(
    "sensor",
    Field("type", TEXT, required=True, example="imu",
          help="imu, lidar, camera, depth_camera, gps, contact, magnetometer, range; or "
          "force_torque in a joint"),
    Field("rate", 1, "frequency", sign=NOT_NEGATIVE, example="30",
          help="measurements per second"),
    Field("noise", 1, sign=NOT_NEGATIVE, example="0.01", help="the standard deviation"),
    Field("topic", TEXT, example="scan", help="the topic of the measurements"),
)  # fmt: skip
"""What all sensors have."""

_IMAGE = (
    Field("size", 2, "pixels", sign=WHOLE, default=(640.0, 480.0), example="640 480",
          help="width and height of the image"),
    Field("fov", 1, "angle", sign=NOT_NEGATIVE, default=pi / 3, example="1.05",
          help="the horizontal field of view"),
    Field("clip", 2, "length", sign=NOT_NEGATIVE, default=(0.05, 100.0), example="0.05 100",
          help="the nearest and the farthest distance that is seen"),
)  # fmt: skip
_RANGE_HELP = "the least and the greatest distance"

LINK_SENSORS = {
    "imu": Thing("imu"),
    "lidar": Thing(
        "lidar",
        Field("rays", 1, sign=WHOLE, default=360.0, example="720",
              help="the rays in a row"),
        Field("angle", 1, "angle", sign=NOT_NEGATIVE, default=tau, example="6.28",
              help="the angle that it sees"),
        Field("range", 2, "length", sign=NOT_NEGATIVE, default=(0.1, 10.0), example="0.1 12",
              help=_RANGE_HELP),
        Field("rows", 1, sign=WHOLE, default=1.0, example="16", help="the rows of rays"),
        Field("tilt", 1, "angle", sign=NOT_NEGATIVE, default=0.0, example="0.5",
              help="the vertical angle that the rows cover"),
    ),
    "camera": Thing("camera", *_IMAGE),
    "depth_camera": Thing("depth_camera", *_IMAGE),
    "gps": Thing("gps"),
    "contact": Thing("contact"),
    "magnetometer": Thing("magnetometer"),
    "range": Thing(
        "range",
        Field("range", 2, "length", sign=NOT_NEGATIVE, default=(0.02, 4.0), example="0.1 12",
              help=_RANGE_HELP),
        Field("fov", 1, "angle", sign=NOT_NEGATIVE, default=0.0, example="0.3",
              help="the angle of its cone"),
    ),
}  # fmt: skip
"""What each type of sensor in a link has of its own."""
JOINT_SENSORS = {"force_torque": Thing("force_torque")}
"""What each type of sensor in a joint has of its own."""
SENSORS = {**LINK_SENSORS, **JOINT_SENSORS}
"""The types of sensors, each with what it has of its own."""

LOOP = Thing(
    "loop",
    Field("name", TEXT, required=True, help="the name of the joint that closes the loop"),
    Field("type", TEXT, required=True, choices=("fixed", "ball", "revolute"),
          help="fixed, ball or revolute"),
    Field("between", TEXT, required=True, help="two links or frames"),
    Field("axis", 3, default=(1.0, 0.0, 0.0), help="the axis of a revolute joint", example="0 0 1"),
)  # fmt: skip

GROUP = Thing(
    "group",
    Field("chain", TEXT, help="two links: the base and the tip"),
    Field("links", TEXT, help="names of links"),
    Field("joints", TEXT, help="names of joints"),
    Field("groups", TEXT, help="names of other groups"),
    Field("parent", TEXT, help="the link that an end effector is joined to"),
    Field("end_effector", TEXT, choices=("true", "false"), default="false",
          help="whether the group is an end effector"),
    Field("kinematics", TEXT, default="kdl", example="trac_ik",
          help="the solver of a chain in MoveIt: kdl, lma, trac_ik, pick_ik, bio_ik, none, the "
          "class of a plugin, or a mapping with `solver` and its parameters"),
)  # fmt: skip

COLLISIONS = Thing(
    "collisions",
    Field("samples", 1, sign=COUNT, default=DEFAULT_SAMPLES, example="10000",
          help="how many random positions are tried"),
    Field("seed", 1, sign=COUNT, default=DEFAULT_SEED, example="1",
          help="the seed of these positions"),
    Field("keep", TEXT, help="pairs that stay enabled"),
)  # fmt: skip

CONTROL = Thing(
    "control",
    Field("name", TEXT, help="the name of the block; by default that of the robot"),
    Field("type", TEXT, choices=("system", "actuator", "sensor"), default="system",
          help="system, actuator or sensor"),
    Field("plugin", TEXT, required=True, help="the hardware plugin"),
    Field("joints", TEXT, help="names, or patterns such as `left_*`, of joints or parts; by "
          "default those with an actuator, but none with `type: sensor`"),
    Field("sensors", TEXT, help="names or patterns of sensors; by default all of the types `imu` "
          "and `force_torque`"),
    Field("params", TEXT, help="parameters of the hardware"),
    Field("gpio", TEXT, help="`NAME: {command: […], state: […]}`"),
    Field("transmissions", TEXT, choices=("true", "false"), default="false",
          help="whether to add a simple transmission for each joint, and one for Drake where its "
          "armature or gains are given"),
    Field("state", TEXT, help="the state that gives the initial values"),
)  # fmt: skip

CONTROLLERS = Thing(
    "controllers",
    Field("update_rate", 1, "frequency", sign=WHOLE, default=100.0, example="100",
          help="the rate of the controller manager"),
    Field("distro", TEXT, choices=("humble", "jazzy", "kilted", "lyrical", "rolling"),
          default="jazzy", help="the distribution of ROS 2"),
)  # fmt: skip
"""What the section `controllers` says besides its controllers."""

CONTROLLER = Thing(
    "controller",
    Field("type", TEXT, required=True, example="joint_trajectory",
          help="a word such as `joint_trajectory` or `diff_drive`, or the class of a plugin"),
    Field("joints", TEXT, help="names, or patterns such as `left_*`, of joints or parts"),
    Field("group", TEXT, help="the group whose joints it takes, in place of `joints`"),
)  # fmt: skip
"""What a controller has besides the parameters of its type."""

WORDS = {
    thing.name: thing
    for thing in (
        *(ACTUATOR, SURFACE, SENSOR, LOOP, GROUP, COLLISIONS, CONTROL, CONTROLLERS, CONTROLLER),
    )
}
"""What words of YAML say that URDF has no elements for, by name."""

# --- the outermost elements -------------------------------------------------------------------

SRDF_ELEMENTS = frozenset(
    ("group", "group_state", "end_effector", "virtual_joint", "disable_collisions")
)
"""Elements of the Semantic Robot Description Format, whose root is a `<robot>` too."""


def is_semantic(root: Element) -> bool:
    """Return whether a `<robot>` is an SRDF: it has no links of its own, and elements of SRDF."""
    found = {child.name for child in root.elements()}
    return "link" not in found and (
        not found.isdisjoint(SRDF_ELEMENTS) or root.span.source.path.lower().endswith(".srdf")
    )


OTHER_FORMATS = {"sdf": "SDF", "world": "SDF", "model": "SDF", "mujoco": "MJCF"}
"""The outermost elements of other formats for robots."""

OUTERMOST = ("link", "joint", "material", "gazebo", "transmission", "ros2_control", "sensor")
"""Element names well known directly under `robot`, where any other name may stand as well."""


def joint_type_meant(word: str) -> str | None:
    """Return the type of joint that `word` is probably meant to be, or None."""
    return OTHER_JOINT_TYPES.get(word.lower()) or suggest(word, JOINT_TYPES)


_SEVERAL_AXES = {"ball": "three", "spherical": "three", "universal": "two"}
"""Joints about several axes, of which URDF has none, and the number of the axes."""


def joint_type_hint(word: str) -> str:
    """Return the hint for `word`, which is not a type of joint: which type may be meant."""
    other = OTHER_JOINT_TYPES.get(word.lower())
    if other is not None:
        return f"URDF calls it '{other}'"
    axes = _SEVERAL_AXES.get(word.lower())
    if axes is not None:
        return f"URDF has no such joint: chain {axes} revolute joints at one point"
    return did_you_mean(word, JOINT_TYPES) or f"the types are {', '.join(JOINT_TYPES)}"
