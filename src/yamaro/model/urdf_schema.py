"""The URDF schema as a table: which elements and attributes URDF has, where, and of what kind.

Source: urdfdom's parser and its `xsd/urdf.xsd`; URDF 1.1 adds `capsule` and `quat_xyzw`, 1.2 the
acceleration, deceleration and jerk limits. The table is data; `check_schema` applies it.
"""

from __future__ import annotations

from ..diagnostics import did_you_mean, suggest
from .shapes import SHAPE_WORDS, SIMPLE_SHAPES

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..xml.tree import Element
    from .shapes import SimpleShape

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

TEXT = 0
"""The `count` of an attribute that is not made of numbers."""

ANY = "any"
NOT_NEGATIVE = "not negative"
POSITIVE = "positive"

ONCE = "once"
OFTEN = "often"


class AttributeRule:
    """What URDF says about one attribute."""

    __slots__ = ("count", "required", "sign", "sound")

    def __init__(self, count: int, *, required: bool = False, sign: str = ANY) -> None:
        """Describe an attribute.

        Args:
            count: how many numbers it holds, or TEXT.
            required: whether parsers refuse or drop the element without it.
            sign: which numbers make sense: ANY, NOT_NEGATIVE or POSITIVE.
        """
        self.count = count
        self.required = required
        self.sign = sign


class ElementRule:
    """What URDF says about one element: its attributes and its children."""

    __slots__ = ("attributes", "children", "extensions", "required", "required_children")

    def __init__(
        self,
        attributes: dict[str, AttributeRule],
        children: dict[str, str] | None = None,
        *,
        required_children: tuple[str, ...] = (),
        extensions: tuple[str, ...] = (),
    ) -> None:
        """Describe an element.

        Args:
            attributes: the attributes by name.
            children: the elements that may be in it, each ONCE or OFTEN.
            required_children: those it must have.
            extensions: further elements and attributes that known tools read there; their content
                is theirs.
        """
        self.attributes = attributes
        self.children = children if children is not None else {}
        self.required_children = required_children
        self.extensions = frozenset(extensions)
        self.required = tuple(name for name, rule in attributes.items() if rule.required)


MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
"""The attributes of `inertia`, in the order of `Inertia`."""

_TEXT = AttributeRule(TEXT)
_NEEDED_TEXT = AttributeRule(TEXT, required=True)
_NUMBER = AttributeRule(1)
_NEEDED_NUMBER = AttributeRule(1, required=True)
_NOT_NEGATIVE = AttributeRule(1, sign=NOT_NEGATIVE)
_NEEDED_NOT_NEGATIVE = AttributeRule(1, required=True, sign=NOT_NEGATIVE)
_THREE = AttributeRule(3)

_SHAPED = {"origin": ONCE, "geometry": ONCE}


def _shape_rule(shape: type[SimpleShape]) -> ElementRule:
    """Return the rule of a simple shape, whose sizes are in one attribute or in one for each."""
    count = len(shape.sizes) // len(shape.attributes)
    rule = AttributeRule(count, required=True, sign=POSITIVE)
    return ElementRule(dict.fromkeys(shape.attributes, rule))


ELEMENTS = {
    "robot": ElementRule(
        {"name": _NEEDED_TEXT, "version": _TEXT},
        {"link": OFTEN, "joint": OFTEN, "material": OFTEN},
    ),
    "link": ElementRule(
        # `type` is not documented, but used by the PR2 and allowed by urdf.xsd.
        {"name": _NEEDED_TEXT, "type": _TEXT},
        {"inertial": ONCE, "visual": OFTEN, "collision": OFTEN},
        # PyBullet reads `contact` and `concave`, HPP and RobCoGen `self_collision_checking`.
        extensions=("contact", "sensor", "self_collision_checking", "concave"),
    ),
    "visual": ElementRule(
        {"name": _TEXT}, {**_SHAPED, "material": ONCE}, required_children=("geometry",)
    ),
    "collision": ElementRule(
        {"name": _TEXT},
        _SHAPED,
        required_children=("geometry",),
        extensions=("verbose", "group", "concave"),
    ),
    "inertial": ElementRule(
        {},
        {"origin": ONCE, "mass": ONCE, "inertia": ONCE},
        required_children=("mass", "inertia"),
    ),
    "mass": ElementRule({"value": AttributeRule(1, required=True)}),
    "inertia": ElementRule(dict.fromkeys(MOMENTS, _NEEDED_NUMBER)),
    "origin": ElementRule({"xyz": _THREE, "rpy": _THREE, "quat_xyzw": AttributeRule(4)}),
    "geometry": ElementRule({}, dict.fromkeys(SHAPE_WORDS, ONCE)),
    **{kind: _shape_rule(shape) for kind, shape in SIMPLE_SHAPES.items()},
    "mesh": ElementRule({"filename": _NEEDED_TEXT, "scale": _THREE}),
    "material": ElementRule({"name": _NEEDED_TEXT}, {"color": ONCE, "texture": ONCE}),
    "color": ElementRule({"rgba": AttributeRule(4, required=True)}),
    "texture": ElementRule({"filename": _NEEDED_TEXT}),
    "joint": ElementRule(
        {"name": _NEEDED_TEXT, "type": _NEEDED_TEXT},
        {
            "origin": ONCE,
            "parent": ONCE,
            "child": ONCE,
            "axis": ONCE,
            "calibration": ONCE,
            "dynamics": ONCE,
            "limit": ONCE,
            "mimic": ONCE,
            "safety_controller": ONCE,
        },
        required_children=("parent", "child"),
    ),
    "parent": ElementRule({"link": _NEEDED_TEXT}),
    "child": ElementRule({"link": _NEEDED_TEXT}),
    "axis": ElementRule({"xyz": AttributeRule(3, required=True)}),
    "calibration": ElementRule(
        {"rising": _NUMBER, "falling": _NUMBER, "reference_position": _NUMBER}
    ),
    "dynamics": ElementRule({"damping": _NOT_NEGATIVE, "friction": _NOT_NEGATIVE}),
    "limit": ElementRule(
        {
            "lower": _NUMBER,
            "upper": _NUMBER,
            "effort": _NEEDED_NOT_NEGATIVE,
            "velocity": _NEEDED_NOT_NEGATIVE,
            "acceleration": _NOT_NEGATIVE,
            "deceleration": _NOT_NEGATIVE,
            "jerk": _NOT_NEGATIVE,
        }
    ),
    "mimic": ElementRule({"joint": _NEEDED_TEXT, "multiplier": _NUMBER, "offset": _NUMBER}),
    "safety_controller": ElementRule(
        {
            "soft_lower_limit": _NUMBER,
            "soft_upper_limit": _NUMBER,
            "k_position": _NUMBER,
            "k_velocity": _NEEDED_NUMBER,
        }
    ),
}
"""The rule of each element by its name; URDF never uses a name for two things."""

LIMITS_OF_1_2 = frozenset(("acceleration", "deceleration", "jerk"))
OPTIONAL_SINCE_1_2 = frozenset(("effort", "velocity"))
"""Limits that URDF 1.2 takes as unbounded when they are left out."""

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


def joint_type_hint(word: str) -> str:
    """Return the hint for `word`, which is not a type of joint: which type may be meant."""
    other = OTHER_JOINT_TYPES.get(word.lower())
    if other is not None:
        return f"URDF calls it '{other}'"
    return did_you_mean(word, JOINT_TYPES) or f"the types are {', '.join(JOINT_TYPES)}"
