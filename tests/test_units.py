"""Units of measurement: exact factors, the grammar, and what fits where."""

from __future__ import annotations

import math
import subprocess
import sys
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.effort import examples
from yamaro.syntax.names import FACTORS as FACTORS_IN_PYTHON
from yamaro.units import (
    ANGLE,
    ANGULAR_SPEED,
    DENSITY,
    FORCE,
    IN_PYTHON,
    LENGTH,
    RATE,
    SPEED,
    TORQUE,
    UNITS,
    UnknownUnit,
    factor_of,
    fits,
    in_python,
    meant_by,
    name_of,
    parse_quantity,
    parse_unit,
    plural_of,
    units_of,
)

# From "The International System of Units" (BIPM, 9th edition) and NIST Special Publication 811,
# appendix B.8; not from the table under test.
FACTORS = {
    "m": 1.0, "mm": 1e-3, "cm": 1e-2, "um": 1e-6, "km": 1e3, "in": 0.0254, "ft": 0.3048,
    "rad": 1.0, "mrad": 1e-3, "deg": math.pi / 180, "rev": 2 * math.pi,
    "kg": 1.0, "g": 1e-3, "t": 1e3, "lb": 0.45359237, "oz": 0.028349523125,
    "s": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0,
    "N": 1.0, "kN": 1e3, "lbf": 4.4482216152605, "kgf": 9.80665, "Nm": 1.0,
    "rpm": math.pi / 30, "Hz": 1.0,
}  # fmt: skip

numbers = st.floats(1e-12, 1e12) | st.integers(1, 10**9) | st.floats(-1e9, -1e-9)


def test_the_table_has_the_units_that_are_documented() -> None:
    assert set(UNITS) == set(FACTORS)


@given(number=numbers, unit=st.sampled_from(sorted(FACTORS)), gap=st.sampled_from(["", " "]))
@settings(max_examples=examples(500))
def test_a_value_is_the_number_times_the_factor_to_one_ulp(
    number: float, unit: str, gap: str
) -> None:
    value, dimension = parse_quantity(f"{number!r}{gap}{unit}")
    # A factor that is rounded itself, as that of a degree, may add half an ulp, and so may the
    # product with it: the exact value lies between.
    assert abs(value - number * FACTORS[unit]) <= 2 * math.ulp(number * FACTORS[unit])
    assert dimension == UNITS[unit].dimension


@given(number=numbers, unit=st.sampled_from(sorted(set(FACTORS) - {"deg", "rev", "rpm"})))
@settings(max_examples=examples(500))
def test_a_value_without_pi_is_the_float_nearest_to_the_exact_product(
    number: float, unit: str
) -> None:
    exact = Fraction(repr(number)) * Fraction(repr(FACTORS[unit]))
    assert parse_quantity(f"{number!r}{unit}")[0] == float(exact)


@given(degrees=st.integers(-720, 720))
@settings(max_examples=examples(300))
def test_degrees_are_exact_at_the_quarters_and_near_what_python_gives(degrees: int) -> None:
    value, _ = parse_quantity(f"{degrees}deg")
    assert abs(value - math.radians(degrees)) <= math.ulp(value)
    if degrees % 90 == 0:
        assert value == degrees / 90 * (math.pi / 2)


@given(number=numbers, unit=st.sampled_from(sorted(FACTORS)))
@settings(max_examples=examples(300))
def test_a_number_comes_back_from_si_to_its_unit(number: float, unit: str) -> None:
    there = UNITS[unit].to_si(number)
    assert UNITS[unit].from_si(there) == pytest.approx(number, rel=1e-15)


@given(
    one=st.sampled_from(sorted(FACTORS)),
    other=st.sampled_from(sorted(FACTORS)),
    power=st.integers(1, 3),
)
@settings(max_examples=examples(300))
def test_composed_units_multiply_their_factors_and_add_their_exponents(
    one: str, other: str, power: int
) -> None:
    product, quotient = parse_unit(f"{one}*{other}"), parse_unit(f"{one}/{other}^{power}")
    assert product.to_si(1.0) == pytest.approx(FACTORS[one] * FACTORS[other], rel=1e-15)
    assert quotient.to_si(1.0) == pytest.approx(FACTORS[one] / FACTORS[other] ** power, rel=1e-15)
    exponents = zip(UNITS[one].dimension, UNITS[other].dimension, strict=True)
    assert quotient.dimension == tuple(first - power * second for first, second in exponents)


@pytest.mark.parametrize(
    ("text", "value", "dimension"),
    [
        ("350mm", 0.35, LENGTH),
        ("350 mm", 0.35, LENGTH),
        ("-1in", -0.0254, LENGTH),
        ("+.5m", 0.5, LENGTH),
        ("1e3mm", 1.0, LENGTH),
        ("1E-2km", 10.0, LENGTH),
        ("90deg", math.pi / 2, ANGLE),
        ("180deg/s", math.pi, ANGULAR_SPEED),
        ("60rpm", 2 * math.pi, ANGULAR_SPEED),
        ("20 N*m", 20, TORQUE),
        ("20Nm", 20, TORQUE),
        ("1000kg/m3", 1000, DENSITY),
        ("1g/cm^3", 1000.0, DENSITY),
        ("36km/h", 10.0, SPEED),
        ("200 Hz", 200, RATE),
        ("5s^-1", 5, RATE),
        ("2kgf", 19.6133, FORCE),
        ("0mm", 0.0, LENGTH),
        ("12", 12, None),
        ("-1.5e3", -1500.0, None),
    ],
)
def test_quantities(text: str, value: float, dimension: object) -> None:
    assert parse_quantity(text) == (value, dimension)


@pytest.mark.parametrize("text", ["20N", "20 kg", "20", "20 Nm"])
def test_an_integer_in_an_si_unit_stays_an_integer(text: str) -> None:
    assert type(parse_quantity(text)[0]) is int


@pytest.mark.parametrize(
    "text",
    ["", "mm", "left", "1 2", "1mm 2mm", "1m*", "1m//s", "1*m", "1m^", "1m^x", "1m^99", "1,5mm",
     "1m s", ".", "-", "1e", "nan", "inf", "0x10", "1_000m", "1m*m*m*m*m*m*m*m*m", "1²m"],
)  # fmt: skip
def test_texts_that_are_not_quantities(text: str) -> None:
    with pytest.raises(ValueError, match=r"is not|too many units"):
        parse_quantity(text)


@pytest.mark.parametrize(
    ("text", "unit", "start"), [("5 mmm", "mmm", 2), ("5N*meter", "meter", 3), ("007x", "x", 3)]
)
def test_an_unknown_unit_is_named_with_its_place(text: str, unit: str, start: int) -> None:
    with pytest.raises(UnknownUnit) as caught:
        parse_quantity(text)
    assert (caught.value.unit, caught.value.start) == (unit, start)


def test_numbers_beyond_all_floats_are_refused() -> None:
    for text in ("1e400", "1e306km", "1e400mm"):
        with pytest.raises(OverflowError):
            parse_quantity(text)
    assert parse_quantity("1e-400mm")[0] == 0.0
    assert parse_quantity("0e-99999999mm")[0] == 0.0
    with pytest.raises(ValueError, match="is not a number"):
        parse_quantity("1" * 5000 + "mm")


def test_angles_count_for_nothing_in_torques_and_for_much_elsewhere() -> None:
    assert fits(parse_unit("N*m/rad").dimension, TORQUE)
    assert fits(TORQUE, parse_unit("N*m/rad").dimension)
    assert fits(parse_unit("N*m*s").dimension, parse_unit("N*m*s/rad").dimension)
    assert not fits(RATE, ANGULAR_SPEED)
    assert not fits(ANGULAR_SPEED, RATE)
    assert not fits(LENGTH, ANGLE)
    assert not fits(FORCE, TORQUE)


def test_dimensions_have_names() -> None:
    assert name_of(LENGTH) == "a length"
    assert plural_of(ANGLE) == "angles"
    assert name_of((1, 0, 0, 2)) == "in m*rad^2"
    assert plural_of((1, 0, 0, -1)) == "numbers in m/rad"
    assert units_of(ANGLE) == ["rad", "mrad", "deg", "rev"]


def test_the_module_imports_nothing() -> None:
    code = (
        "import sys, yamaro.source; before = set(sys.modules); import yamaro.units; "
        "print(sorted(set(sys.modules) - before))"
    )
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert told.stdout.strip() == "['yamaro.units']"


@pytest.mark.parametrize(("unit", "name"), sorted(IN_PYTHON.items()))
def test_names_in_expressions_are_factors(unit: str, name: str) -> None:
    assert math.isclose(FACTORS_IN_PYTHON[name], FACTORS[unit], rel_tol=1e-16)


def test_every_factor_in_expressions_is_that_of_a_unit() -> None:
    assert sorted(FACTORS_IN_PYTHON) == sorted(IN_PYTHON.values())


@pytest.mark.parametrize("unit", sorted(FACTORS))
def test_what_to_write_for_a_unit_in_an_expression_has_its_value(unit: str) -> None:
    written = factor_of(unit)
    assert math.isclose(
        eval(written, {"pi": math.pi, **FACTORS_IN_PYTHON}), FACTORS[unit], rel_tol=1e-14
    )


@pytest.mark.parametrize(
    ("text", "expression"),
    [
        ("350mm", "350 * mm"),
        ("-1.5 in", "-1.5 * inch"),
        ("20 N*m", "20"),
        ("3 km", "3 * 1000"),
        ("5 kg", "5"),
        ("1 g/cm3", "1000"),
        ("350", None),
        ("arm", None),
        ("5 parsec", None),
        ("", None),
    ],
)
def test_a_quantity_as_an_expression(text: str, expression: str | None) -> None:
    assert in_python(text) == expression


@pytest.mark.parametrize(
    ("word", "unit"),
    [("lbs", "lb"), ("MM", "mm"), ("Degrees", "deg"), ("°", "deg"), ("kn", "kN"), ("parsec", None)],
)
def test_words_for_units_elsewhere(word: str, unit: str | None) -> None:
    assert meant_by(word) == unit
