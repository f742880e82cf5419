"""Numbers with units in the keys of parts: values, dimensions by place, and start-up."""

from __future__ import annotations

import math
import subprocess
import sys

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.effort import examples
from tests.golden import CASES
from tests.robot.part_builder import error_of, lower_text

# Factors from the SI brochure and NIST SP 811; not from the table under test.
UNITS = {
    "length": {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "um": 1e-6, "km": 1e3, "in": 0.0254, "ft": 0.3048},
    "angle": {"rad": 1.0, "mrad": 1e-3, "deg": math.pi / 180, "rev": 2 * math.pi},
    "mass": {"kg": 1.0, "g": 1e-3, "t": 1e3, "lb": 0.45359237, "oz": 0.028349523125},
    "density": {"kg/m3": 1.0, "g/cm^3": 1e3},
    "inertia": {"kg*m2": 1.0, "g*cm^2": 1e-7},
    "angular speed": {"rad/s": 1.0, "rpm": math.pi / 30, "deg/s": math.pi / 180},
    "speed": {"m/s": 1.0, "mm/s": 1e-3, "m/min": 1 / 60, "km/h": 1 / 3.6},
    "angular acceleration": {"rad/s^2": 1.0, "deg/s2": math.pi / 180},
    "acceleration": {"m/s2": 1.0, "mm/s^2": 1e-3},
    "angular jerk": {"rad/s^3": 1.0},
    "jerk": {"m/s3": 1.0},
    "torque": {"N*m": 1.0, "Nm": 1.0, "N*cm": 1e-2, "Nm/rad": 1.0, "lbf*in": 0.112984829027616},
    "force": {"N": 1.0, "kN": 1e3, "lbf": 4.4482216152605, "kgf": 9.80665, "N/rad": 1.0},
    "rotary damping": {"N*m*s/rad": 1.0, "Nm*s": 1.0, "N*m*s/deg": 180 / math.pi},
    "damping": {"N*s/m": 1.0, "N*s/mm": 1e3},
    "rate": {"Hz": 1.0},
    "time": {"s": 1.0, "ms": 1e-3, "min": 60.0},
}  # fmt: skip

LINK = "part:\n  name: a\n  link:\n"
MASS = f"{LINK}    mass: 1\n"
JOINT = "part: {name: a}\npart:\n  name: b\n  joint:\n    parent: a\n    type: "
HERE = "@"
"""The place of the number in a part below."""


def in_joint(kind, key, attribute):
    """Return a part whose joint of a type has a number in an attribute."""
    rest = [name for name in ("lower", "upper", "effort", "velocity") if name != attribute]
    more = {"limit": "".join(f", {name}: 1" for name in rest), "mimic": ", joint: a"}.get(key, "")
    if key == "safety_controller" and attribute != "k_velocity":
        more = ", k_velocity: 1"
    return f"{JOINT}{kind}\n    {key}: {{{attribute}: @{more}}}\n"


def with_shape(shape, row):
    """Return a part with a shape of a scale."""
    return f"{LINK}    visual: {{geometry: {shape}, scale: {row}}}\n"


TURNS_AND_SLIDES = {
    ("limit", "lower"): ("angle", "length"),
    ("limit", "upper"): ("angle", "length"),
    ("limit", "effort"): ("torque", "force"),
    ("limit", "velocity"): ("angular speed", "speed"),
    ("limit", "acceleration"): ("angular acceleration", "acceleration"),
    ("limit", "deceleration"): ("angular acceleration", "acceleration"),
    ("limit", "jerk"): ("angular jerk", "jerk"),
    ("dynamics", "damping"): ("rotary damping", "damping"),
    ("dynamics", "friction"): ("torque", "force"),
    ("mimic", "offset"): ("angle", "length"),
    ("safety_controller", "soft_lower_limit"): ("angle", "length"),
    ("safety_controller", "soft_upper_limit"): ("angle", "length"),
    ("safety_controller", "k_position"): ("rate", "rate"),
    ("safety_controller", "k_velocity"): ("rotary damping", "damping"),
    ("calibration", "rising"): ("angle", "length"),
    ("calibration", "falling"): ("angle", "length"),
    ("calibration", "reference_position"): ("angle", "length"),
}
KINDS_OF_JOINTS = {"revolute": 0, "continuous": 0, "prismatic": 1}

PLACES = {
    "xyz": (f"{JOINT}fixed\n    xyz: @ 0 0\n", "length"),
    "rpy": (f"{JOINT}fixed\n    rpy: 0 @ 0\n", "angle"),
    "pivot": (f"{JOINT}fixed\n    pivot: 0 0 @\n", "length"),
    "origin": (f"{JOINT}fixed\n    origin: {{xyz: @ 0 0}}\n", "length"),
    "axis": (f"{JOINT}continuous\n    axis: @ 0 0\n", None),
    "multiplier": (in_joint("revolute", "mimic", "multiplier"), None),
    "limit of a planar joint": (in_joint("planar", "limit", "upper"), None),
    "limit of a floating joint": (in_joint("floating", "limit", "effort"), None),
    "mass": (f"{LINK}    mass: @\n    inertial: {{inertia: 1 0 0 1 0 1}}\n", "mass"),
    "density": (f"{LINK}    density: @\n    geometry: box\n    scale: 1 1 1\n", "density"),
    "inertia": (f"{MASS}    inertial: {{inertia: 1 0 0 @ 0 1}}\n", "inertia"),
    "ixx": (
        f"{MASS}    inertial:\n      inertia: {{ixx: @, ixy: 0, ixz: 0, iyy: 1, iyz: 0, izz: 1}}\n",
        "inertia",
    ),
    "box": (with_shape("box", "1 @ 1"), "length"),
    "cylinder": (with_shape("cylinder", "1 @"), "length"),
    "sphere": (with_shape("sphere", "@"), "length"),
    "capsule": (with_shape("capsule", "@ 1"), "length"),
    "mesh": (with_shape("a.stl", "1 @ 1"), None),
    "color": (
        (
            f"{LINK}    visual:\n      geometry: sphere\n      scale: 1\n"
            "      material: {name: m, color: 1 0 0 @}\n"
        ),
        None,
    ),
    **{
        f"{attribute} of a {kind} joint": (in_joint(kind, key, attribute), kinds[place])
        for (key, attribute), kinds in TURNS_AND_SLIDES.items()
        for kind, place in KINDS_OF_JOINTS.items()
    },
}


def values_in(text):
    """Return every number that is written for a part."""
    found = []
    stack = lower_text(text).tree.elements()
    while stack:
        element = stack.pop()
        stack += element.elements()
        for attribute, value in element.attributes.items():
            if attribute not in ("name", "type", "link", "joint", "filename"):
                found += [float(word) for word in str(value).split()]
    return found


WITH_A_UNIT = [
    pytest.param(text, unit, factor, id=f"{place}-{unit}")
    for place, (text, kind) in PLACES.items()
    if kind is not None
    for unit, factor in UNITS[kind].items()
]
WRONG = [
    (text, next(iter(units)))
    for text, own in PLACES.values()
    for kind, units in UNITS.items()
    if kind != own
]


@pytest.mark.parametrize(("text", "unit", "factor"), WITH_A_UNIT)
def test_each_key_takes_every_unit_of_its_dimension(text, unit, factor):
    wanted = float(f"{0.375 * factor:.14g}")
    written = values_in(text.replace(HERE, f"0.375{unit}"))
    assert any(math.isclose(value, wanted, rel_tol=1e-13) for value in map(abs, written))


@given(st.sampled_from(WRONG))
@settings(max_examples=examples(len(WRONG)))
def test_each_key_refuses_every_other_dimension(place_and_unit):
    text, unit = place_and_unit
    error = error_of(text.replace(HERE, f"1{unit}"))
    assert error.code == "unit-dimension"
    assert error.span.written() == unit
    assert f"'{unit}'" in error.message


@given(
    number=st.floats(1e-6, 1e6) | st.integers(-(10**6), 10**6),
    unit=st.sampled_from(sorted(UNITS["length"])),
    gap=st.sampled_from(["", " "]),
)
@settings(max_examples=examples(200))
def test_a_value_is_the_number_times_the_factor(number, unit, gap):
    text = with_shape("sphere", f"{number!r}{gap}{unit}")
    (written,) = [value for value in values_in(text) if value] or [0.0]
    wanted = number * UNITS["length"][unit]
    # 15 significant digits are written; the product may be off by an ulp.
    assert abs(written - wanted) <= 5.1e-15 * abs(wanted) + math.ulp(wanted)


@pytest.mark.parametrize("word", ["0.50", "1e-3", "-.5", "7"])
def test_a_number_beside_one_with_a_unit_keeps_its_spelling(word):
    joint = lower_text(f"{JOINT}fixed\n    xyz: 1mm {word} 0\n").tree.elements()[1]
    origin = next(each for each in joint.elements() if each.name == "origin")
    assert origin.attributes["xyz"] == f"0.001 {word} 0"


def test_a_robot_without_units_is_built_without_the_table_of_units():
    program = (
        "import sys\n"
        "from yamaro.commands.main import main\n"
        "status = main([sys.argv[1]])\n"
        "print(status, [name for name in sys.modules if 'quantities' in name "
        "or name == 'yamaro.units'], file=sys.stderr)\n"
    )
    run = subprocess.run(
        [sys.executable, "-c", program, str(CASES / "part" / "axis-forms.yaml")],
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    assert run.stderr == "0 []\n"
