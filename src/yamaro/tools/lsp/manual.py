"""What the manual says of each word, in a line: for hovers and completion.

The words of a place are its keys. What can stand everywhere in statements is in `statement`.
"""

from __future__ import annotations

from ...model.schema import AXES, ELEMENTS, RECORDS, SENSOR, SENSORS, WORDS
from ...model.shapes import SIMPLE_SHAPES

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.schema import Thing

_POSE = {
    **{name: ELEMENTS["origin"].fields[name].help for name in ("xyz", "rpy")},
    "pivot": "the point, in the rotated axes, that is placed at `xyz`",
}
_ORIGIN = {"origin": "the pose as attributes: `{xyz: 0 0 1, rpy: 0 0 0}`"}
_SIZES = {
    "geometry": "the shape: box, cylinder, sphere, capsule, or a mesh file",
    "size": "the lengths of a box's sides, x y z",
    "radius": "the radius of a cylinder, sphere or capsule",
    "length": "the length of a cylinder, or of the cylinder in a capsule",
    "scale": "the size of the shape as one row, or the factors of a mesh",
}
_MASS = {"mass": "the mass in kilograms", "density": "kilograms per cubic metre"}
_BODY = {"body": "the statements"}


def _fields(thing: Thing) -> dict[str, str]:
    """Return the fields of a thing, each with its help."""
    return {name: field.help for name, field in thing.fields.items()}


_SENSOR = {name: about for each in SENSORS.values() for name, about in _fields(each).items()}
MANUAL: dict[str, dict[str, str]] = {
    **{name: _fields(ELEMENTS[name]) for name in RECORDS if name != "axis"},
    **{name: _fields(thing) for name, thing in WORDS.items()},
    "root": {
        "robot": "names the robot; the default is the name of the file",
        "import": "Python modules for the expressions of this file",
        "arguments": "what may be passed to the file, with types, ranges and defaults",
        "variables": "variables: `name: value`, `name/scope: value`",
        "functions": "functions, whose names begin with a capital: `Leg(side, length=0.3):`",
        "model": "the content of the robot: parts, elements and statements",
        "naming": "how the joint and the link of a part are named",
        "control": "the hardware for ros2_control",
        "states": "named positions of joints",
        "groups": "named groups of links and joints, for planning",
        "collisions": "how the pairs of links that never collide are found",
        "base": "how the robot is placed in the world: `fixed` or `free`",
        "print": "a message on standard error",
        "process": "Python statements",
        "if": "statements that run if a condition is true: `if length > 1:`",
        "elif": "another condition, tried if those before are false",
        "else": "what runs if no condition is true",
        "for": "a loop: `for i in range(3):`",
    },
    "statement": {
        "part": "a joint and a link, with geometry, poses and inertia worked out",
        "if": "statements that run if a condition is true: `if length > 1:`",
        "elif": "another condition, tried if those before are false",
        "else": "what runs if no condition is true",
        "for": "a loop: `for i in range(3):`, `for side, y in sides:`",
        "include": "another file: its path, or `path:` and the variables passed to it",
        "variables": "variables, declared from here on",
        "functions": "functions, declared from here on",
        "print": "a message on standard error",
        "process": "Python statements: one line, or `|` and the lines below",
        "attach": "another robot, joined to a link of this one",
        "mirror": "its body, and the mirror image of it",
        "loop": "a joint that closes a loop",
    },
    "part": {
        "name": "one name for both, `wheel` giving `wheel_joint`, `wheel_link`; or two",
        "joint": "the joint to the parent; without it the link is a root",
        "link": "the link: shape, mass, sections; without it the link is empty",
    },
    "joint": {
        "type": ELEMENTS["joint"].fields["type"].help,
        "parent": "the name of a link, or of a part, whose link is meant; required",
        "child": "the name of the child link; by default that of the part",
        **_POSE,
        **_ORIGIN,
        "axis": ELEMENTS["axis"].fields["xyz"].help,
        "limit": "lower, upper, effort and velocity",
        "dynamics": "damping and friction",
        "mimic": "the joint that this one follows: `joint`, `multiplier`, `offset`",
        "safety_controller": "k_velocity, k_position, soft_lower_limit, soft_upper_limit",
        "calibration": "rising, falling, reference_position",
        "actuator": "what drives the joint: command, gains, armature",
        "sensor": "a force-torque sensor: `sensor/name=wrist: {type: force_torque}`",
    },
    "link": {
        **_SIZES,
        **_MASS,
        **_POSE,
        **_ORIGIN,
        "visual": "what is seen; by default of the link's shape",
        "collision": "what collides; by default of the link's shape",
        "inertial": "mass and inertia; computed from shape and mass by default",
        "frame": "a named pose in the link: `frame/name=tool0: {xyz: 0 0 0.1}`",
        "sensor": "a sensor: `sensor/name=eye: {type: camera}`",
    },
    "visual": {
        **_SIZES,
        **_POSE,
        **_ORIGIN,
        "material": "a material: its name, or `{name: …, color: …, texture: …}`",
        "color": "red, green, blue and alpha, from 0 to 1",
    },
    "collision": {
        **_SIZES,
        **_POSE,
        **_ORIGIN,
        "material": "a material, which some parsers read here",
        "surface": "friction, restitution, stiffness and damping",
    },
    "inertial": {
        **_MASS,
        "inertia": "ixx ixy ixz iyy iyz izz in kg·m²; computed by default",
        **_SIZES,
        **_POSE,
        **_ORIGIN,
    },
    "material": {
        **_fields(ELEMENTS["material"]),
        "color": ELEMENTS["color"].fields["rgba"].help,
        "texture": ELEMENTS["texture"].fields["filename"].help,
    },
    "frame": dict(_POSE),
    "sensor": {**_fields(SENSOR), **_POSE, "frame": "the frame that it measures in", **_SENSOR},
    "variables": {},
    "functions": {},
    "function": {
        "input": "the parameters: `side, length=1.0, **Payload`",
        **_BODY,
    },
    "if": {"condition": "a Python expression: `length > 1.0`", **_BODY},
    "for": {
        "iterator": "the name that takes each value; or several",
        "in": "a list, a mapping, or an expression",
        "range": "one to three numbers, as Python's `range` takes them",
        **_BODY,
    },
    "include": {
        "path": "the file: relative to this one, `package://name/path`, `$(find name)/path`",
        "namespace": "a name: what the file hands back is `Name.function` and `Name.variable`",
        "arguments": "variables passed to the file, if their names are words of `include`",
    },
    "attach": {
        "path": "the robot's file: YAML, URDF or xacro",
        "body": "statements in place of a file",
        "to": "the link, part or frame of this robot that it is joined to",
        "at": "the link or frame of the attached robot; by default its root",
        **_POSE,
        "prefix": "is put before all names of the attached robot",
        "joint": "the joint between them; by default `{type: fixed}`",
        "arguments": "what is passed to the file",
    },
    "mirror": {
        "plane": "xz (the default), xy or yz",
        "of": "the link whose plane it is",
        "rename": "words of names that are replaced: `{left: right}`; required",
        "axes": "keep (the default) or mirror",
        "meshes": "scale (the default), same, or files by files",
        **_BODY,
    },
    "argument": {
        "default": "the value if nothing is passed; without it the argument is required",
        "type": "number, integer, text, boolean, list, mapping or path",
        "choices": "the values that are allowed",
        "range": "the least and the greatest number",
        "unit": "the unit of a number that is passed without one",
        "help": "what the argument is for",
        "step": "by how much a slider changes it",
        "log": "whether a slider is logarithmic",
    },
    "naming": {
        "joint": "a pattern such as `*_joint`",
        "link": "a pattern such as `*_link`",
    },
}

_SHAPES = tuple(SIMPLE_SHAPES)
VALUES: dict[tuple[str, str], tuple[str, ...]] = {
    **{
        (thing.name, name): field.choices
        for thing in (ELEMENTS["joint"], *WORDS.values())
        for name, field in thing.fields.items()
        if field.choices
    },
    ("joint", "axis"): AXES,
    ("loop", "axis"): AXES,
    **{(place, "geometry"): _SHAPES for place in ("link", "visual", "collision", "inertial")},
    ("sensor", "type"): tuple(SENSORS),
    ("mirror", "plane"): ("xz", "xy", "yz"),
    ("mirror", "axes"): ("keep", "mirror"),
    ("mirror", "meshes"): ("scale", "same"),
    ("argument", "type"): ("number", "integer", "text", "boolean", "list", "mapping", "path"),
    ("argument", "unit"): ("m", "mm", "cm", "rad", "deg", "kg", "g", "s", "N", "Nm", "Hz"),
    ("argument", "log"): ("true", "false"),
    ("root", "base"): ("fixed", "free"),
}
"""The words that a value may be, by the place and the key."""

PREDEFINED = {
    **dict.fromkeys(("pi", "tau", "e"), "a constant of mathematics"),
    **dict.fromkeys(
        "sin cos tan asin acos atan atan2 sqrt hypot radians degrees floor ceil fabs log "
        "exp".split(),
        "a function of Python's `math`; angles are in radians",
    ),
    **dict.fromkeys(
        ("deg", "mm", "cm", "inch", "gram", "lb", "rpm", "Nm"),
        "the factor of a unit to SI: `350 * mm`",
    ),
    "load_yaml": "`load_yaml(path)`: the data in a YAML file, as dicts and lists",
    "find": "`find(package)`: the folder of a ROS package",
    "env": "`env(name[, default])`: an environment variable",
    "file_dir": "`file_dir()`: the folder of this file",
    "dirname": "the folder of this file",
    "cwd": "the working directory",
    "target": "the output format: `'urdf'`",
    **dict.fromkeys(("true", "false", "null"), "Python's True, False and None"),
}
"""The names that every expression sees, except for Python's own."""

USEFUL_BUILTINS = (
    "abs all any bool dict enumerate float int len list max min range reversed round set sorted "
    "str sum tuple zip"
).split()


def about(place: str, word: str) -> str | None:
    """Return the line on a word in a place, or on the statement of that name."""
    found = MANUAL.get(place, {}).get(word)
    if found is None and place != "root":
        found = MANUAL["statement"].get(word)
    return found
