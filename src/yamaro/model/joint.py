"""Joints: how a link moves on another one, within which limits, and which joint it follows."""

from __future__ import annotations

from math import pi

from .schema import ELEMENTS, TEXT
from .values import ReadLater, Written, attribute_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..diagnostics import Frame as Step
    from ..xml.tree import Element
    from .pose import Pose, Vector

REVOLUTE, CONTINUOUS, PRISMATIC, FIXED = "revolute", "continuous", "prismatic", "fixed"
PLANAR, FLOATING = "planar", "floating"
TURNING = (REVOLUTE, CONTINUOUS)
"""The types of joints that turn about their axis."""
LIMITED = (REVOLUTE, PRISMATIC)
"""The types of joints that have a lower and an upper limit."""
SINGLE = (REVOLUTE, CONTINUOUS, PRISMATIC)
"""The types of joints whose position is one number."""
UNLIMITED = 1e15
"""Limits beyond it mean none, such as those of 1e16 that simulators write."""
DEGREES_OF_FREEDOM = {REVOLUTE: 1, CONTINUOUS: 1, PRISMATIC: 1, PLANAR: 3, FLOATING: 6}
"""Degrees of freedom by joint type, as pinocchio counts them (nv of its joint models)."""


class Record(Written):
    """What an element in a joint says: a slot for each of its fields in the schema.

    What URDF has no attributes for is only in a note, which is the whole element.
    """

    __slots__ = ()

    def __init__(
        self,
        element: Element,
        number: Callable[[Element, str], float | None],
        *,
        is_note: bool = False,
    ) -> None:
        """Take the values of an element; `number` reads one, or returns None."""
        self.element = element
        for name, field in ELEMENTS[element.name].fields.items():
            if not (field.in_urdf or is_note):
                setattr(self, name, field.default)
                continue
            found: object = number(element, name) if field.count != TEXT else None
            if field.count == TEXT:
                found = attribute_text(element, name) or ""
            setattr(self, name, field.default if found is None else found)


class Limit(Record):
    """How far, how strongly and how fast a joint moves; None for what is not said.

    Attributes:
        lower, upper: in radians or metres; 0 where they are left out, as in URDF.
        effort: in N·m or N.
        velocity: in rad/s or m/s.
        acceleration, deceleration: in rad/s² or m/s².
        jerk: in rad/s³ or m/s³.
    """

    __slots__ = tuple(ELEMENTS["limit"].fields)

    lower: float
    upper: float
    effort: float | None
    velocity: float | None
    acceleration: float | None
    deceleration: float | None
    jerk: float | None


class Mimic(Record):
    """How a joint follows another: its position is multiplier·position + offset.

    Attributes:
        joint: the name of the joint that it follows, or "".
        multiplier: 1 by default.
        offset: in radians or metres; 0 by default.
    """

    __slots__ = tuple(ELEMENTS["mimic"].fields)

    joint: str
    multiplier: float
    offset: float


class Dynamics(Record):
    """What resists a joint; all 0 by default.

    Attributes:
        damping: in N·m·s/rad or N·s/m.
        friction: in N·m or N.
        armature: of a joint without an actuator, in kg·m² or kg.
    """

    __slots__ = tuple(ELEMENTS["dynamics"].fields)

    damping: float
    friction: float
    armature: float


class SafetyController(Record):
    """The limits that a controller keeps to; see http://wiki.ros.org/pr2_controller_manager."""

    __slots__ = tuple(ELEMENTS["safety_controller"].fields)

    soft_lower_limit: float
    soft_upper_limit: float
    k_position: float
    k_velocity: float


class Calibration(Record):
    """The positions, in radians or metres, that a joint is calibrated at, or None.

    Attributes:
        rising, falling: where a reference switch rises or falls.
        reference_position: the reference; older files have it, and urdfdom's schema.
    """

    __slots__ = tuple(ELEMENTS["calibration"].fields)

    rising: float | None
    falling: float | None
    reference_position: float | None


class Joint(ReadLater):
    """A joint.

    Attributes:
        name: its name, or "".
        type: revolute, continuous, prismatic, fixed, floating or planar; anything else as it is
            written, and fixed where it is left out.
        parent, child: names of links, or "".
        origin: T_parent_joint.
        axis: a unit vector in the joint's frame; x by default.
        limit, mimic, dynamics, safety_controller, calibration: None where they are left out.
        trace: the calls and includes that led to it, innermost first.
    """

    __slots__ = (
        "axis", "calibration", "child", "dynamics", "limit", "mimic", "name", "origin", "parent",
        "safety_controller", "trace", "type",
    )  # fmt: skip

    name: str
    type: str
    parent: str
    child: str
    origin: Pose
    axis: Vector
    limit: Limit | None
    mimic: Mimic | None
    dynamics: Dynamics | None
    safety_controller: SafetyController | None
    calibration: Calibration | None
    trace: Step | None

    def __init__(
        self,
        element: Element,
        *,
        name: str,
        parent: str,
        child: str,
        mimic: Mimic | None,
        trace: Step | None,
        read_rest: Callable[[Joint], None],
    ) -> None:
        self.element = element
        self.name = name
        self.parent = parent
        self.child = child
        self.mimic = mimic
        self.trace = trace
        self.read_rest = read_rest

    @property
    def is_fixed(self) -> bool:
        """Return whether it holds its child still."""
        return self.type == FIXED

    @property
    def is_free(self) -> bool:
        """Return whether its position is one number, and its own."""
        return self.mimic is None and self.type in SINGLE

    @property
    def lower(self) -> float | None:
        """Return its lower limit in radians or metres, None if its type has none or none is given.

        The soft limits of a safety controller are not looked at.
        """
        return self.limit.lower if self.limit is not None and self.type in LIMITED else None

    @property
    def upper(self) -> float | None:
        """Return its upper limit in radians or metres; see `lower`."""
        return self.limit.upper if self.limit is not None and self.type in LIMITED else None

    @property
    def range(self) -> tuple[float, float]:
        """Return the lowest and highest position to show: its limits, or one turn, or 1 m."""
        lower, upper = self.lower, self.upper
        if lower is None or upper is None or lower >= upper:
            return (-0.5, 0.5) if self.type == PRISMATIC else (-pi, pi)
        return (lower, upper)

    @property
    def rest(self) -> float:
        """Return where to show it if nothing else is asked for: at 0, or between its limits.

        If the limits exclude 0 it is the middle between them, as in ROS's joint_state_publisher.
        """
        lower, upper = self.lower, self.upper
        if lower is None or upper is None or lower <= 0 <= upper:
            return 0.0
        return (lower + upper) / 2

    def __repr__(self) -> str:
        return f"<Joint '{self.name}' at {self.span.place()}>"
