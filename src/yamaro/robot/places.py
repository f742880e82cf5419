"""The places in a part and the keys of each, as tables: what is a key where, and what is XML."""

from __future__ import annotations

from ..model.schema import ELEMENTS, RECORDS, SENSORS
from ..model.schema import SENSOR as ANY_SENSOR

POSE_ROWS = ("xyz", "rpy", "pivot")
"""The keys of a pose that take numbers."""
POSE_KEYS = frozenset((*POSE_ROWS, "origin"))
SIZE_KEYS = frozenset(("scale", "radius", "length", "size"))
SHAPE_KEYS = SIZE_KEYS | {"geometry"}
MASS_KEYS = frozenset(("mass", "density"))

COMMON_ELEMENTS = frozenset(
    (
        *("gazebo", "transmission", "ros2_control", "sensor", "plugin", "material", "contact"),
        *("verbose", "self_collide", "selfCollide", "kinematic", "gravity"),
        *("visual", "collision"),
    )
)
"""Elements that URDF files hold and that are never warned of as misspelt keys."""


class PartPlace:
    """One place where keys are understood.

    Attributes:
        name: the key that opens the place.
        keys: keys meant once that are worked into generated elements.
        ordered: keys meant once that are output where they are written.
        repeated: keys that may repeat, output where they are written.
        stand_ins: generated elements that one in angle brackets replaces.
        elements: XML elements that are never taken for misspelt or misplaced keys.
        known: the keys meant once.
        all_keys: every key of the place.
        has_parts: whether parts may be in it.
        example: keys to show in a hint.
    """

    __slots__ = (
        "all_keys",
        "elements",
        "example",
        "has_parts",
        "keys",
        "known",
        "name",
        "ordered",
        "repeated",
        "stand_ins",
    )

    def __init__(
        self,
        name: str,
        *,
        keys: frozenset[str],
        example: str,
        ordered: frozenset[str] = frozenset(),
        repeated: frozenset[str] = frozenset(),
        stand_ins: frozenset[str] = frozenset(),
        elements: frozenset[str] = frozenset(),
        has_parts: bool = False,
    ) -> None:
        """Describe a place; see the class."""
        self.name = name
        self.keys = keys
        self.ordered = ordered
        self.repeated = repeated
        self.stand_ins = stand_ins
        self.elements = elements
        self.known = keys | ordered
        self.all_keys = self.known | repeated
        self.has_parts = has_parts
        self.example = example


PART = PartPlace(
    "part",
    keys=frozenset(("name",)),
    ordered=frozenset(("joint", "link")),
    elements=COMMON_ELEMENTS - {"visual", "collision"},
    has_parts=True,
    example="name: wheel",
)
JOINT = PartPlace(
    "joint",
    keys=POSE_KEYS | {"type", "parent", "child"},
    ordered=frozenset(RECORDS),
    stand_ins=frozenset(("parent", "child", "origin")),
    elements=COMMON_ELEMENTS - {"visual", "collision", "material"},
    example="type: fixed",
)
LINK = PartPlace(
    "link",
    keys=POSE_KEYS | SHAPE_KEYS,
    ordered=MASS_KEYS | {"inertial"},
    repeated=frozenset(("visual", "collision")),
    elements=COMMON_ELEMENTS - {"material"},
    example="geometry: box",
)
VISUAL = PartPlace(
    "visual",
    keys=POSE_KEYS | SHAPE_KEYS,
    ordered=frozenset(("material", "color")),
    stand_ins=frozenset(("origin", "geometry")),
    elements=COMMON_ELEMENTS - {"visual", "collision"},
    example="geometry: box",
)
COLLISION = PartPlace(
    "collision",
    keys=POSE_KEYS | SHAPE_KEYS,
    ordered=frozenset(("material",)),
    stand_ins=frozenset(("origin", "geometry")),
    elements=(COMMON_ELEMENTS - {"visual", "collision"}) | {"surface"},
    example="geometry: box",
)
INERTIAL = PartPlace(
    "inertial",
    keys=POSE_KEYS | SHAPE_KEYS | MASS_KEYS | {"inertia"},
    stand_ins=frozenset(("origin", "mass", "inertia")),
    elements=COMMON_ELEMENTS - {"visual", "collision", "material"},
    example="mass: 1.0",
)

FRAME = PartPlace(
    "frame",
    keys=POSE_KEYS - {"origin"},
    elements=frozenset(),
    example="xyz: 0 0 0.1",
)

SENSOR = PartPlace(
    "sensor",
    keys=POSE_KEYS - {"origin"},
    elements=frozenset(
        ("frame", *ANY_SENSOR.fields, *(name for each in SENSORS.values() for name in each.fields))
    ),
    example="type: imu",
)

_LINK_HINT = "it belongs under 'link:'"
_JOINT_HINT = "it belongs under 'joint:'"
_SURFACE_HINT = "it belongs in 'collision:'"
_HOMES: dict[str, dict[str, str]] = {
    "part": {
        "surface": _SURFACE_HINT,
        **dict.fromkeys((*sorted(SHAPE_KEYS), "mass", "density"), _LINK_HINT),
        **dict.fromkeys(("visual", "collision", "inertial"), _LINK_HINT),
        **dict.fromkeys(("type", "parent", "child", *sorted(RECORDS)), _JOINT_HINT),
        **dict.fromkeys(sorted(POSE_KEYS), "it belongs under 'joint:' or under 'link:'"),
        "inertia": "it belongs under 'link:', in 'inertial:'",
    },
    "joint": {
        "surface": _SURFACE_HINT,
        **dict.fromkeys((*sorted(SHAPE_KEYS), "mass", "density"), _LINK_HINT),
        **dict.fromkeys(("visual", "collision", "inertial", "inertia"), _LINK_HINT),
        "name": "write the name beside 'joint:', or as joint/name=…",
        "link": "'link:' belongs beside 'joint:', not in it",
        "joint": "a joint cannot contain a joint",
        **{
            name: f"it belongs in '{record}:'"
            for record in RECORDS
            for name in ELEMENTS[record].fields
            if name not in POSE_ROWS and name != "joint"
        },
    },
    "link": {
        "surface": _SURFACE_HINT,
        **dict.fromkeys(("type", "parent", "child", *sorted(RECORDS)), _JOINT_HINT),
        "name": "write the name beside 'link:', or as link/name=…",
        "material": "it belongs in 'visual:'",
        "color": "it belongs in 'visual:'",
        "texture": "it belongs in 'visual:', in 'material:'",
        "inertia": "it belongs in 'inertial:'",
        "joint": "'joint:' belongs beside 'link:', not in it",
        "link": "a link cannot contain a link",
    },
    "section": {
        "surface": _SURFACE_HINT,
        **dict.fromkeys(("mass", "density"), "it belongs in 'link:' or in its 'inertial:'"),
        **dict.fromkeys(("type", "parent", "child", *sorted(RECORDS)), _JOINT_HINT),
        **dict.fromkeys(("visual", "collision", "inertial"), "it belongs directly in 'link:'"),
        "inertia": "it belongs in 'inertial:'",
        "material": "it belongs in 'visual:'",
        "color": "it belongs in 'visual:'",
        "texture": "it belongs in 'material:'",
        "name": "write it as an attribute: visual/name=…",
    },
}


def home_of(name: str, place_name: str) -> str | None:
    """Return where a key belongs that `place_name` does not have, as a hint, or None."""
    homes = _HOMES.get(place_name) or _HOMES["section"]
    return homes.get(name)
