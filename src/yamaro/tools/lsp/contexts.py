"""The keys around an offset, the place of the language that they lead to, and its words."""

from __future__ import annotations

from ...model.controllers import MANAGER, SOLVERS, TYPES
from ...model.quantities import described, unit_of
from ...model.schema import (
    AXES,
    ELEMENTS,
    FITS,
    FITTING,
    MOMENTS,
    OF_MOTOR,
    RECORDS,
    SENSOR,
    SENSORS,
    WORDS,
)
from ...model.shapes import SIMPLE_SHAPES
from ...motors import MOTORS
from ...source import Span
from ...yaml.nodes import MappingNode, ScalarNode, SequenceNode

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...model.schema import Thing
    from ...yaml.nodes import ScalarNode, YamlNode


# --- the keys around an offset ----------------------------------------------------------------


class Cursor:
    """An offset in the tree of a file.

    Attributes:
        keys: the keys around it, outermost first; with `is_key` without the scalar itself.
        nodes: the value under each of `keys`.
        mapping: the innermost mapping around it, or None.
        scalar: the scalar it is in, or None.
        is_key: whether that is a key.
        value: what is under the key, if it is one.
    """

    __slots__ = ("is_key", "keys", "mapping", "nodes", "scalar", "value")

    def __init__(self) -> None:
        self.keys: list[ScalarNode] = []
        self.nodes: list[YamlNode] = []
        self.mapping: MappingNode | None = None
        self.scalar: ScalarNode | None = None
        self.value: YamlNode | None = None
        self.is_key = False

    def words(self) -> list[str]:
        """Return the keys around it without their attributes, `<name>` as `name`."""
        return [word_of(key.text) for key in self.keys]

    def parent(self) -> str:
        """Return the innermost of these words, "" at the root."""
        return word_of(self.keys[-1].text) if self.keys else ""


def word_of(key: str) -> str:
    """Return the name in a key `name/attribute=value`, or the statement of a short head."""
    word = key.partition("/")[0].strip().strip("<>")
    for head in ("if", "elif", "for"):
        if word.startswith((f"{head} ", f"{head}(")):
            return head
    return word


def cursor_at(root: YamlNode | None, offset: int) -> Cursor:
    """Return where an offset is; the end of a scalar belongs to it."""
    cursor = Cursor()
    node = root
    while node is not None and not isinstance(node, ScalarNode):
        if isinstance(node, SequenceNode):
            node = next((item for item in node.items if _holds(item, offset)), None)
            continue
        cursor.mapping = node
        pair = next((pair for pair in node.pairs if _holds(pair[0], offset)), None)
        for each in node.pairs if pair is None else ():
            if each[0].start <= offset and _holds(each[1], offset):
                pair = each
                break
        if pair is None:
            return cursor
        key, value = pair
        if key.start <= offset <= key.end:
            cursor.scalar, cursor.is_key, cursor.value = key, True, value
            return cursor
        cursor.keys.append(key)
        cursor.nodes.append(value)
        node = value
    cursor.scalar = node
    return cursor


def _holds(node: YamlNode, offset: int) -> bool:
    return node.start <= offset <= node.end


def pairs_of_mappings(node: YamlNode | None) -> Sequence[tuple[ScalarNode, YamlNode]]:
    """Return the pairs of a mapping, or of all mappings in a list."""
    if isinstance(node, MappingNode):
        return node.pairs
    items = node.items if isinstance(node, SequenceNode) else ()
    return [pair for item in items if isinstance(item, MappingNode) for pair in item.pairs]


def span_inside(node: ScalarNode) -> Span:
    """Return the place of a scalar without its quotes."""
    if not node.style or not node.text:
        return node.span()
    return Span(node.source, node.offset(0), node.offset(len(node.text) - 1) + 1)


# --- places -----------------------------------------------------------------------------------


ROOT, BODY, ANY, VALUE, DATA, XML = "root", "body", "any", "value", "data", "xml"
"""Places that have no row of their own in the manual: a body of statements; one that may be
inserted anywhere; a value; data whose keys are names; the content of an XML element."""

_OF_ROOT = {
    "variables": "variables",
    "functions": "functions",
    "arguments": "arguments",
    "model": BODY,
    "naming": "naming",
    "control": "control",
    "controllers": "controllers",
    "states": DATA,
    "groups": "groups",
    "collisions": "collisions",
    "import": "import",
    "print": VALUE,
    "process": VALUE,
    "base": VALUE,
    "overlay": "overlay",
}
_INNER = {
    "part": {"joint": "joint", "link": "link"},
    "joint": {word: word for word in (*RECORDS, "actuator") if word != "axis"},
    "link": {word: word for word in ("visual", "collision", "inertial", "frame")},
    "visual": {"material": "material"},
    "collision": {"material": "material", "surface": "surface"},
    "actuator": {"motor": "motor"},
    "attach": {"joint": "joint", "arguments": DATA, "body": BODY, "overlay": "overlay"},
    "mirror": {"body": BODY, "rename": DATA, "meshes": DATA},
    "include": {"arguments": DATA, "overlay": "overlay"},
    "groups": {},
    "controllers": {},
    "argument": {},
    "control": {"params": DATA, "gpio": DATA},
    "overlay": {"joints": "joints of an overlay", "links": "links of an overlay"},
    "joint of an overlay": {word: word for word in (*RECORDS, "actuator") if word != "axis"},
    "link of an overlay": {"inertia": "inertia", "inertial": "inertial of an overlay"},
    "inertial of an overlay": {"inertia": "inertia"},
}
_STATEMENTS = {
    "part": "part",
    "include": "include",
    "attach": "attach",
    "mirror": "mirror",
    "loop": "loop",
    "variables": "variables",
    "functions": "functions",
    "print": VALUE,
    "process": VALUE,
}
_TRANSPARENT = ("if", "elif", "else", "for")
_NAMED = {
    "arguments": "argument",
    "controllers": "controller",
    "groups": "group",
    "functions": "function",
    "variables": VALUE,
    "joints of an overlay": "joint of an overlay",
    "links of an overlay": "link of an overlay",
}
CONTENTS = frozenset((ROOT, BODY, ANY, "part", "joint", "link", "visual", "collision", "inertial"))
"""Places in which statements may be."""


class Place:
    """Where keys are: what they mean there.

    Attributes:
        name: a place of the manual, or one of those above.
        call: the name of the function whose arguments they are, or "".
        element: the name of the XML element around them, or "".
    """

    __slots__ = ("call", "element", "name")

    def __init__(self, name: str) -> None:
        self.name = name
        self.call = ""
        self.element = ""


def place_below(keys: Sequence[ScalarNode]) -> Place:
    """Return the place below some keys, the outermost first."""
    place, content = Place(ROOT), ROOT
    for key in keys:
        place, content = _below(place, content, key.text)
    return place


def _below(place: Place, content: str, key: str) -> tuple[Place, str]:
    """Return the place below a key, and the place of the statements in it."""
    word, name = word_of(key), place.name
    if key.startswith("<"):
        return _element(word), XML
    if name in ("if", "for"):
        return (Place(content), content) if word == "body" else (Place(VALUE), content)
    if name in CONTENTS and word in _TRANSPARENT:
        is_long = key in ("if", "elif", "for")
        return (
            (Place("for" if word == "for" else "if"), content)
            if is_long
            else (
                Place(content),
                content,
            )
        )
    if name == "function":
        return (Place(ANY), ANY) if word == "body" else (Place(VALUE), VALUE)
    if name == "functions" and "(" in key:
        return Place(ANY), ANY
    if name in _NAMED:
        return Place(_NAMED[name]), content
    if name == "call":
        return (Place(ANY), ANY) if word[:1].isupper() else (Place(VALUE), VALUE)
    found = _inner(name, word, key)
    return found, (found.name if found.name in CONTENTS else content)


def _inner(name: str, word: str, key: str) -> Place:
    if name == ROOT and word in _OF_ROOT and "/" not in key:
        return Place(_OF_ROOT[word])
    if name in _INNER and word in _INNER[name]:
        return Place(_INNER[name][word])
    if name in ("link", "joint", ANY) and word == "sensor":
        return Place("sensor")
    if name == ANY and any(word in inner for inner in _INNER.values()):
        return Place(next(inner[word] for inner in _INNER.values() if word in inner))
    if name in CONTENTS and word in _STATEMENTS and "/" not in key:
        return Place(_STATEMENTS[word])
    if name in CONTENTS and word[:1].isupper() and "/" not in key:
        place = Place("call")
        place.call = key.strip()
        return place
    if name in (DATA, VALUE, "controller", "group"):
        return Place(DATA)
    return Place(BODY) if name == ROOT else _element(word)


def _element(word: str) -> Place:
    place = Place(XML)
    place.element = word
    return place


# --- the manual: a line on each word ----------------------------------------------------------


def _about(element: str, field: str) -> str:
    """Return the help of a field of an element of URDF, with its unit."""
    return described(ELEMENTS[element].fields[field], has_default=False)


def _fields(thing: Thing) -> dict[str, str]:
    """Return the fields of a thing, each with its help; limits that are left out are assumed."""
    has_default = thing.name != "limit"
    return {name: described(field, has_default=has_default) for name, field in thing.fields.items()}


def _listed(thing: Thing) -> str:
    return ", ".join(thing.fields)


_POSE = {
    "xyz": f"{_about('origin', 'xyz')}; units such as `350mm` are allowed",
    "rpy": f"{_about('origin', 'rpy')}; units such as `90deg` are allowed",
    "quat": "the rotation as a quaternion w x y z, in place of `rpy`",
    "pivot": "the point, in the rotated axes, that is placed at `xyz`",
}
_ROWS = {name: _POSE[name] for name in ("xyz", "rpy")}
_OVERLAY = "changes values of what the file makes: a file, or `{joints: …, links: …}`"
_ORIGIN = {"origin": "the pose as attributes: `{xyz: 0 0 1, rpy: 0 0 0}`"}
_SIZES = {
    "geometry": f"the shape: {', '.join(SIMPLE_SHAPES)}, or a mesh file",
    "size": _about("box", "size"),
    "radius": _about("cylinder", "radius"),
    "length": _about("cylinder", "length"),
    "scale": "the size of the shape as one row, or the factors of a mesh",
}
_MASS = {"mass": _about("mass", "value"), "density": "the density, in kg/m³"}
_BODY = {"body": "the statements"}


def _of_sensors() -> dict[str, str]:
    """Return the fields of all types of sensors; of which type it is where they differ."""
    found: dict[str, dict[str, str]] = {}
    for thing in SENSORS.values():
        for name, text in _fields(thing).items():
            found.setdefault(name, {}).setdefault(text, thing.name)
    return {
        name: "; ".join(
            f"{text} ({kind})" if len(texts) > 1 else text for text, kind in texts.items()
        )
        for name, texts in found.items()
    }


MANUAL: dict[str, dict[str, str]] = {
    **{name: _fields(ELEMENTS[name]) for name in RECORDS if name != "axis"},
    **{name: _fields(thing) for name, thing in WORDS.items()},
    "controllers": {
        **_fields(WORDS["controllers"]),
        **{
            name: "a parameter of the controller manager"
            for name in MANAGER
            if name not in WORDS["controllers"].fields
        },
    },
    **{
        f"controller {each.word}": {
            name: f"a parameter of {each.plugin.partition('/')[2]}"
            for name in each.parameters
            if name not in WORDS["controller"].fields
        }
        for each in TYPES.values()
    },
    "motor": {name: text for name, text in _fields(WORDS["actuator"]).items() if name in OF_MOTOR},
    "root": {
        "robot": "names the robot; the default is the name of the file",
        "import": "Python modules for the expressions of this file",
        "arguments": "what may be passed to the file, with types, ranges and defaults",
        "variables": "variables: `name: value`, `name/scope: value`",
        "functions": "functions, whose names begin with a capital: `Leg(side, length=0.3):`",
        "model": "the content of the robot: parts, elements and statements",
        "naming": "how the joint and the link of a part are named",
        "control": "the hardware for ros2_control",
        "controllers": "the controllers of ros2_control: `arm: {type: joint_trajectory}`",
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
        "type": described(ELEMENTS["joint"].fields["type"]),
        "parent": "the name of a link, or of a part, whose link is meant; required",
        "child": "the name of the child link; by default that of the part",
        **_POSE,
        **_ORIGIN,
        "axis": _about("axis", "xyz"),
        **{name: _listed(ELEMENTS[name]) for name in RECORDS if name != "axis"},
        "mimic": f"the joint that this one follows: {_listed(ELEMENTS['mimic'])}",
        "actuator": f"what drives the joint: {_listed(WORDS['actuator'])}",
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
        "color": _about("color", "rgba"),
        "triangles": described(FITTING.fields["triangles"]),
    },
    "collision": {
        **_SIZES,
        **_POSE,
        **_ORIGIN,
        **{name: described(field) for name, field in FITTING.fields.items() if name != "triangles"},
        "material": "a material, which some parsers read here",
        "surface": _listed(WORDS["surface"]),
    },
    "inertial": {
        **_MASS,
        "inertia": f"{' '.join(MOMENTS)}, in {unit_of('inertia')}; computed by default",
        **_SIZES,
        **_POSE,
        **_ORIGIN,
    },
    "material": {
        **_fields(ELEMENTS["material"]),
        "color": _about("color", "rgba"),
        "texture": _about("texture", "filename"),
    },
    "frame": dict(_POSE),
    "sensor": {
        **_fields(SENSOR),
        **_POSE,
        "frame": "the frame that it measures in",
        **_of_sensors(),
    },
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
        "overlay": _OVERLAY,
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
        "overlay": _OVERLAY,
    },
    "overlay": {
        "joints": "names of joints, and under each the values that change",
        "links": "names of links, and under each the values that change",
    },
    "joint of an overlay": {
        **_ROWS,
        "type": described(ELEMENTS["joint"].fields["type"], has_default=False),
        "zero": "the position of the file at which this robot's joint reads 0",
        "axis": _about("axis", "xyz"),
        **{name: _listed(ELEMENTS[name]) for name in RECORDS if name != "axis"},
        "actuator": f"what drives the joint: {_listed(WORDS['actuator'])}",
    },
    "link of an overlay": {
        "mass": f"{_MASS['mass']}; the inertia stays as it is",
        "inertia": f"{' '.join(MOMENTS)}, in {unit_of('inertia')}, or some of them by name",
        "inertial": "mass and inertia, and with `xyz` and `rpy` where the centre of mass is",
    },
    "inertial of an overlay": {
        **_ROWS,
        "mass": _MASS["mass"],
        "inertia": f"{' '.join(MOMENTS)}, in {unit_of('inertia')}, or some of them by name",
    },
    "inertia": _fields(ELEMENTS["inertia"]),
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
    ("actuator", "motor"): tuple(MOTORS),
    ("collision", "fit"): FITS,
    ("collision", "cover"): ("true", "false"),
    ("controller", "type"): tuple(TYPES),
    ("group", "kinematics"): tuple(SOLVERS),
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
