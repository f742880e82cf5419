"""What the numbers of a robot measure: the dimension of each kind, and its unit in SI.

The kinds are the words of `Field.kind` in `schema.py`. Loaded for the first number with a unit.
"""

from __future__ import annotations

from math import degrees

from ..units import (
    ACCELERATION,
    ANGLE,
    ANGULAR_ACCELERATION,
    ANGULAR_SPEED,
    DENSITY,
    FORCE,
    INERTIA,
    LENGTH,
    MASS,
    NUMBER,
    RATE,
    SPEED,
    TIME,
    TORQUE,
    si_of,
)
from .joint import PRISMATIC

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..units import Dimension
    from .schema import Field

DIMENSIONS: dict[str, Dimension] = {
    "number": NUMBER,
    "length": LENGTH,
    "angle": ANGLE,
    "mass": MASS,
    "time": TIME,
    "rate": RATE,
    "frequency": RATE,
    "pixels": NUMBER,
    "speed": SPEED,
    "angular speed": ANGULAR_SPEED,
    "acceleration": ACCELERATION,
    "angular acceleration": ANGULAR_ACCELERATION,
    "force": FORCE,
    "torque": TORQUE,
    "density": DENSITY,
    "inertia": INERTIA,
    "contact stiffness": (0, 1, -2, 0),
    "contact damping": (0, 1, -1, 0),
}
"""The kinds of numbers that are the same wherever they are."""

BY_JOINT: dict[str, tuple[tuple[Dimension, ...], tuple[Dimension, ...]]] = {
    "position": ((ANGLE,), (LENGTH,)),
    "velocity": ((ANGULAR_SPEED,), (SPEED,)),
    "acceleration of a joint": ((ANGULAR_ACCELERATION,), (ACCELERATION,)),
    "jerk": (((0, 0, -3, 1),), ((1, 0, -3, 0),)),
    "effort": ((TORQUE,), (FORCE,)),
    "damping": (((2, 1, -1, -1),), ((0, 1, -1, 0),)),
    "stiffness": (((2, 1, -2, -1),), ((0, 1, -2, 0),)),
    "armature": ((INERTIA,), (MASS,)),
    "ratio": ((NUMBER, (-1, 0, 0, 1)), (NUMBER, (1, 0, 0, -1))),
}
"""The kinds of numbers that depend on the joint: for one that turns, and for one that slides.

A ratio is between two joints, of which the other may turn or slide.
"""
_CALLED = {"pixels": "pixels", "frequency": "Hz"}


def unit_of(kind: str, joint_type: str = "") -> str:
    """Return the SI unit of a kind as messages write it, such as "N·m·s/rad"; "" for a number.

    Args:
        kind: the kind.
        joint_type: that of the joint, where the kind depends on it; by default one that turns.
    """
    if kind in _CALLED:
        return _CALLED[kind]
    if kind in BY_JOINT:
        turning, sliding = BY_JOINT[kind]
        dimension = (sliding if joint_type == PRISMATIC else turning)[0]
    else:
        dimension = DIMENSIONS[kind]
    if dimension == NUMBER:
        return ""
    return si_of(dimension).replace("*", "·").replace("^2", "²").replace("^3", "³")


def si_units_of(kind: str) -> tuple[str, ...]:
    """Return the SI units of a kind: where a joint turns, and where it slides."""
    units = (unit_of(kind), unit_of(kind, PRISMATIC))
    return tuple([unit for unit in dict.fromkeys(units) if unit])


def default_of(field: Field) -> str:
    """Return the default of a field as YAML has it, angles in degrees; "" if it has none."""
    default = field.default
    if default is None or isinstance(default, str):
        return default or ""
    numbers = default if isinstance(default, tuple) else (default,)
    if field.kind == "angle":
        return " ".join(f"{degrees(number):g}deg" if number else "0" for number in numbers)
    return " ".join(f"{number:.15g}" for number in numbers)


def described(field: Field, *, has_default: bool = True) -> str:
    """Return what a field is: "the position gain, in 1/s; 0 by default"."""
    unit = " or ".join(si_units_of(field.kind))
    text = f"{field.help}, in {unit}" if unit else field.help
    if has_default and field.required:
        return f"{text}; required"
    default = default_of(field) if has_default else ""
    return f"{text}; {default} by default" if default else text
