"""What expectations may read of a robot: safe mode's guards, and a table of the model's attributes.

Expectations are evaluated in safe mode whatever the robot is trusted with: they only compute.
"""

from __future__ import annotations

from math import isclose

from ...model.extras import (
    Actuator,
    Base,
    Camera,
    CollisionSettings,
    Control,
    Group,
    Lidar,
    Loop,
    Ranger,
    Sensor,
    State,
    Surface,
)
from ...model.joint import Calibration, Dynamics, Joint, Limit, Mimic, SafetyController
from ...model.link import Collision, Inertial, Link, Material, Visual
from ...model.pose import Pose
from ...model.robot import Frame, Robot
from ...model.shapes import Box, Capsule, Cylinder, Mesh, Sphere
from ...model.values import ByName
from ...safe.runtime import SafeRuntime
from ...safe.values import Function, a_type, function

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from ...safe.limits import SafeLimits

HIDDEN = frozenset(("element", "findings", "read_rest", "span", "trace"))
"""Attributes that are about the files, and not about the robot."""
CLASSES: tuple[type, ...] = (
    *(Robot, Frame, Link, Inertial, Visual, Collision, Material, Pose),
    *(Joint, Limit, Mimic, Dynamics, SafetyController, Calibration),
    *(Box, Capsule, Cylinder, Mesh, Sphere),
    *(Sensor, Camera, Lidar, Ranger, Actuator, Surface, State, Group, Loop, Control),
    *(Base, CollisionSettings),
)
METHODS: dict[type, frozenset[str]] = {
    Robot: frozenset(
        "center_of_mass free_joints joints_below material_of parent_joint pose poses".split()
    ),
    Pose: frozenset(("apply", "inverse", "matrix")),
    Inertial: frozenset(("matrix",)),
    **dict.fromkeys((Box, Capsule, Cylinder, Sphere), frozenset(("inertia", "volume"))),
}
STEPS = 1000
"""What a call of a method counts at least."""


def _readable(kind: type) -> frozenset[str]:
    """Return the attributes of a class that hold or work out values."""
    names: set[str] = set()
    for base in kind.__mro__:
        names.update(getattr(base, "__slots__", ()))
        names.update(name for name, each in vars(base).items() if isinstance(each, property))
        names.update(name for name in ("kind",) if name in vars(base))
    return frozenset(name for name in names if name[0] != "_") - HIDDEN


READABLE = {kind: _readable(kind) for kind in CLASSES}


class Approximate:
    """A number, or a row of numbers, that others are compared with up to rounding."""

    __slots__ = ("_rel", "_value", "_within")

    def __init__(self, value: Any, *, rel: float, within: float) -> None:
        self._value = value
        self._rel = rel
        self._within = within

    def __eq__(self, other: object) -> bool:
        return self._is_near(other, self._value)

    def __ne__(self, other: object) -> bool:
        return not self == other

    __hash__ = None  # type: ignore[assignment]

    def _is_near(self, one: Any, other: Any) -> bool:
        if isinstance(one, (list, tuple)) and isinstance(other, (list, tuple)):
            return len(one) == len(other) and all(map(self._is_near, one, other))
        if isinstance(one, (int, float)) and isinstance(other, (int, float)):
            return isclose(one, other, rel_tol=self._rel, abs_tol=self._within)
        return bool(one == other)

    def __repr__(self) -> str:
        return f"{self._value!r} within {self._rel:g} of it or {self._within:g}"


class ModelRuntime(SafeRuntime):
    """Safe mode's guards, which let robots in."""

    def __init__(self, limits: SafeLimits) -> None:
        super().__init__(limits)
        self.foreign.update(dict.fromkeys((*CLASSES, Approximate), _one))
        self._names["approx"] = function(self._approx, "<function approx>")

    def expose(self, robot: Robot) -> dict[str, Any]:
        """Return what expectations see of a robot, by the names that they use."""
        return {
            "robot": robot,
            "link": function(robot.need_link, "<function link>"),
            "joint": function(robot.need_joint, "<function joint>"),
        }

    def _approx(self, value: Any, /, *, rel: Any = 1e-6, within: Any = 1e-9) -> Approximate:
        """Return a value that is equal to all that is near it."""
        self.measured(value)
        if not all(type(each) in (int, float) and each >= 0 for each in (rel, within)):
            raise TypeError("`rel` and `within` of approx are numbers")
        return Approximate(value, rel=rel, within=within)

    def attribute(self, owner: Any, name: str) -> Any:
        """Return `owner.name`, for reading."""
        kind = type(owner)
        known = READABLE.get(kind)
        if known is None:
            return super().attribute(owner, name)
        if name in known:
            value = getattr(owner, name)  # safe mode knows what things are by name as a dict
            return dict(value) if isinstance(value, ByName) else value
        methods = METHODS.get(kind, frozenset())
        if name in methods:
            return self._method(owner, name)
        from ...diagnostics import did_you_mean

        message = f"{a_type(owner)} has no attribute '{name}'"
        hint = did_you_mean(name, [*known, *methods])
        raise AttributeError(message + (f"; {hint}" if hint else ""))

    def _method(self, owner: Any, name: str) -> Function:
        method: Callable[..., Any] = getattr(owner, name)
        cost = STEPS + (len(owner.links) if isinstance(owner, Robot) else 0)

        def run(*args: Any, **named: Any) -> Any:
            self.charge(cost)
            for value in (*args, *named.values()):
                self.measured(value)
            return method(*args, **named)

        return function(run, f"<method {name} of {a_type(owner)}>")

    def _iterate(self, source: Any) -> Any:
        if type(source) in READABLE:
            raise TypeError(f"{a_type(source)} cannot be iterated over")
        return super()._iterate(source)


def _one(value: object) -> int:
    return 1
