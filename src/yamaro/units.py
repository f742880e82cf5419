"""Units of measurement: a table of exact factors to SI, and the grammar of `350mm` and `20 N*m`.

A factor is a ratio of two integers times a power of π. A value is worked out in integers and
divided once, so the result is the float nearest to the exact product.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    Dimension = tuple[int, int, int, int]
    """The exponents of metre, kilogram, second and radian."""

NUMBER: Dimension = (0, 0, 0, 0)
LENGTH: Dimension = (1, 0, 0, 0)
MASS: Dimension = (0, 1, 0, 0)
TIME: Dimension = (0, 0, 1, 0)
ANGLE: Dimension = (0, 0, 0, 1)
RATE: Dimension = (0, 0, -1, 0)
SPEED: Dimension = (1, 0, -1, 0)
ANGULAR_SPEED: Dimension = (0, 0, -1, 1)
FORCE: Dimension = (1, 1, -2, 0)
TORQUE: Dimension = (2, 1, -2, 0)
DENSITY: Dimension = (-3, 1, 0, 0)
ACCELERATION: Dimension = (1, 0, -2, 0)
ANGULAR_ACCELERATION: Dimension = (0, 0, -2, 1)
INERTIA: Dimension = (2, 1, 0, 0)

_NAMES: dict[Dimension, tuple[str, str]] = {
    NUMBER: ("a number", "numbers"),
    LENGTH: ("a length", "lengths"),
    (2, 0, 0, 0): ("an area", "areas"),
    (3, 0, 0, 0): ("a volume", "volumes"),
    MASS: ("a mass", "masses"),
    TIME: ("a time", "times"),
    ANGLE: ("an angle", "angles"),
    RATE: ("a rate", "rates"),
    SPEED: ("a speed", "speeds"),
    ANGULAR_SPEED: ("an angular speed", "angular speeds"),
    ACCELERATION: ("an acceleration", "accelerations"),
    ANGULAR_ACCELERATION: ("an angular acceleration", "angular accelerations"),
    FORCE: ("a force", "forces"),
    TORQUE: ("a torque", "torques"),
    DENSITY: ("a density", "densities"),
    INERTIA: ("a moment of inertia", "moments of inertia"),
}
_SYMBOLS = ("kg", "m", "rad", "s")
_COMPOSED: dict[Dimension, str] = {
    FORCE: "N",
    TORQUE: "N*m",
    (2, 1, -1, -1): "N*m*s/rad",
    (0, 1, -1, 0): "N*s/m",
    (2, 1, -2, -1): "N*m/rad",
    (0, 1, -2, 0): "N/m",
}
"""The SI units of dimensions that nobody writes in kilograms."""


class Unit:
    """A unit: `numerator / denominator · π^pi` of the SI unit of its dimension.

    Attributes:
        dimension: the exponents of metre, kilogram, second and radian.
    """

    __slots__ = ("denominator", "dimension", "numerator", "pi")

    def __init__(
        self, dimension: Dimension, numerator: int = 1, denominator: int = 1, pi: int = 0
    ) -> None:
        self.dimension = dimension
        self.numerator = numerator
        self.denominator = denominator
        self.pi = pi

    def __mul__(self, other: Unit) -> Unit:
        return self._combined(other, 1)

    def __truediv__(self, other: Unit) -> Unit:
        return self._combined(other, -1)

    def _combined(self, other: Unit, power: int) -> Unit:
        length, mass, time, angle = self.dimension
        by_length, by_mass, by_time, by_angle = other.dimension
        above, below = other.numerator, other.denominator
        if power < 0:
            above, below = below, above
        return Unit(
            (
                length + power * by_length,
                mass + power * by_mass,
                time + power * by_time,
                angle + power * by_angle,
            ),
            self.numerator * above,
            self.denominator * below,
            self.pi + power * other.pi,
        )

    def __pow__(self, exponent: int) -> Unit:
        result = Unit(NUMBER)
        for _ in range(abs(exponent)):
            result = result * self if exponent > 0 else result / self
        return result

    @property
    def is_si(self) -> bool:
        """Return whether a number in this unit is the same in SI."""
        return self.numerator == self.denominator and not self.pi

    def to_si(self, number: float) -> float:
        """Return a number in this unit as one in SI; an integer stays one if nothing changes.

        Raises:
            OverflowError: the result is larger than any float.
        """
        if self.is_si:
            return number
        above, below = number.as_integer_ratio()
        return self._divided(above, below)

    def from_si(self, number: float) -> float:
        """Return a number in SI as one in this unit.

        Raises:
            OverflowError: the result is larger than any float.
        """
        return (Unit(NUMBER) / self).to_si(number)

    def _divided(self, above: int, below: int) -> float:
        """Return the float nearest to `above / below` of this unit, in SI."""
        above *= self.numerator
        below *= self.denominator
        if self.pi > 0:
            above, below = above * _PI**self.pi, below * _PI_SCALE**self.pi
        elif self.pi < 0:
            above, below = above * _PI_SCALE**-self.pi, below * _PI**-self.pi
        return above / below


_PI = 31415926535897932384626433832795028841971693993751
_PI_SCALE = 10**49

_KILOGRAM_OF_POUND = (45359237, 100000000)
_GRAVITY = (980665, 100000)
"""Standard gravity in m/s², by which a pound-force and a kilogram-force are defined."""

UNITS: dict[str, Unit] = {
    "m": Unit(LENGTH),
    "mm": Unit(LENGTH, 1, 1000),
    "cm": Unit(LENGTH, 1, 100),
    "um": Unit(LENGTH, 1, 1000000),
    "km": Unit(LENGTH, 1000),
    "in": Unit(LENGTH, 254, 10000),
    "ft": Unit(LENGTH, 3048, 10000),
    "rad": Unit(ANGLE),
    "mrad": Unit(ANGLE, 1, 1000),
    "deg": Unit(ANGLE, 1, 180, 1),
    "rev": Unit(ANGLE, 2, 1, 1),
    "kg": Unit(MASS),
    "g": Unit(MASS, 1, 1000),
    "t": Unit(MASS, 1000),
    "lb": Unit(MASS, *_KILOGRAM_OF_POUND),
    "oz": Unit(MASS, _KILOGRAM_OF_POUND[0], 16 * _KILOGRAM_OF_POUND[1]),
    "s": Unit(TIME),
    "ms": Unit(TIME, 1, 1000),
    "min": Unit(TIME, 60),
    "h": Unit(TIME, 3600),
    "N": Unit(FORCE),
    "kN": Unit(FORCE, 1000),
    "lbf": Unit(FORCE, _KILOGRAM_OF_POUND[0] * _GRAVITY[0], _KILOGRAM_OF_POUND[1] * _GRAVITY[1]),
    "kgf": Unit(FORCE, *_GRAVITY),
    "Nm": Unit(TORQUE),
    "rpm": Unit(ANGULAR_SPEED, 1, 30, 1),
    "Hz": Unit(RATE),
}

IN_PYTHON = {
    "deg": "deg",
    "mm": "mm",
    "cm": "cm",
    "in": "inch",
    "g": "gram",
    "lb": "lb",
    "rpm": "rpm",
    "Nm": "Nm",
}
"""The units that have a name in expressions, where it is their factor."""

_MEANT = {
    **dict.fromkeys(("degree", "degrees", "degs", "°"), "deg"),
    **dict.fromkeys(("radian", "radians", "rads"), "rad"),
    **dict.fromkeys(("meter", "meters", "metre", "metres"), "m"),
    **dict.fromkeys(("millimeter", "millimeters", "millimetre", "millimetres"), "mm"),
    **dict.fromkeys(("inch", "inches"), "in"),
    **dict.fromkeys(("foot", "feet"), "ft"),
    **dict.fromkeys(("\u00b5m", "\u03bcm", "micron", "microns"), "um"),
    **dict.fromkeys(("gram", "grams", "gr"), "g"),
    **dict.fromkeys(("kilogram", "kilograms", "kgs"), "kg"),
    **dict.fromkeys(("pound", "pounds", "lbs"), "lb"),
    **dict.fromkeys(("ton", "tons", "tonne", "tonnes"), "t"),
    **dict.fromkeys(("sec", "secs", "second", "seconds"), "s"),
    **dict.fromkeys(("minute", "minutes"), "min"),
    **dict.fromkeys(("hour", "hours", "hr"), "h"),
    **dict.fromkeys(("newton", "newtons"), "N"),
    **dict.fromkeys(("turn", "turns", "revolution", "revolutions"), "rev"),
}
"""What units are called elsewhere."""

MOST_FACTORS = 8
"""Units that one quantity may be composed of."""
LARGEST_POWER = 9
LONGEST_NUMBER = 400
"""Characters of a number: any float can be written with fewer."""


class UnknownUnit(ValueError):
    """A quantity names a unit that is not in the table.

    Attributes:
        unit: the word.
        start: where it begins in the text.
    """

    def __init__(self, unit: str, start: int) -> None:
        super().__init__(f"'{unit}' is not a unit")
        self.unit = unit
        self.start = start


def parse_quantity(text: str) -> tuple[float, Dimension | None]:
    """Return the value of a number with or without a unit, in SI, and its dimension.

    The dimension is None without a unit. An integer that no factor changes stays an integer.

    Raises:
        UnknownUnit: what follows the number is written like a unit, and is not in the table.
        ValueError: the text is not a quantity.
        OverflowError: the value is larger than any float.
    """
    text = text.strip()
    end = _end_of_number(text)
    number, rest = text[:end], text[end:].lstrip()
    if not number:
        raise ValueError(f"'{text[:20]}' is not a quantity")
    if not rest:
        return _plain(number), None
    unit = parse_unit(rest, len(text) - len(rest))
    if unit.is_si:
        return _plain(number), unit.dimension
    above, below = _ratio(number)
    value = unit._divided(above, below)
    return value, unit.dimension


def parse_unit(text: str, offset: int = 0) -> Unit:
    """Return a unit, such as `mm`, `N*m`, `kg/m3` or `m/s^2`.

    Args:
        text: the unit, without spaces around.
        offset: where it begins, for the place in UnknownUnit.

    Raises:
        UnknownUnit: a word is not in the table.
        ValueError: the text does not have the form of a unit.
    """
    result = Unit(NUMBER)
    at, operator = 0, "*"
    for _ in range(MOST_FACTORS):
        start = at
        while at < len(text) and text[at].isalpha():
            at += 1
        word = text[start:at]
        if not word:
            raise ValueError(f"'{text}' is not a unit")
        at, power = _power(text, at)
        unit = UNITS.get(word)
        if unit is None:
            raise UnknownUnit(word, offset + start)
        unit = unit**power
        result = result * unit if operator == "*" else result / unit
        if at == len(text):
            return result
        operator = text[at]
        if operator not in "*/":
            raise ValueError(f"'{text}' is not a unit")
        at += 1
    raise ValueError(f"'{text}' is composed of too many units")


def fits(dimension: Dimension, wanted: Dimension) -> bool:
    """Return whether a quantity can stand where one of another dimension is wanted.

    Angles count for nothing in what has to do with force: N·m/rad is as good as N·m.
    """
    if dimension == wanted:
        return True
    return dimension[1] != 0 and dimension[:3] == wanted[:3]


def name_of(dimension: Dimension) -> str:
    """Return what a quantity of that dimension is called: "a length"."""
    return _NAMES[dimension][0] if dimension in _NAMES else f"in {si_of(dimension)}"


def plural_of(dimension: Dimension) -> str:
    """Return what quantities of that dimension are called: "lengths"."""
    if dimension in _NAMES:
        return _NAMES[dimension][1]
    return f"numbers in {si_of(dimension)}"


def units_of(dimension: Dimension) -> list[str]:
    """Return the units of the table that fit where a dimension is wanted."""
    return [word for word, unit in UNITS.items() if fits(unit.dimension, dimension)]


def meant_by(word: str) -> str | None:
    """Return the unit that a word means elsewhere, or None: `lb` for `lbs`, `mm` for `MM`."""
    if word in _MEANT:
        return _MEANT[word]
    small = word.lower()
    near = [unit for unit in UNITS if unit.lower() == small and unit != word]
    return near[0] if near else _MEANT.get(small)


def factor_of(word: str) -> str:
    """Return what to write in an expression for a unit: the name of its factor, or a number."""
    if word in IN_PYTHON:
        return IN_PYTHON[word]
    unit = UNITS[word]
    return "2 * pi" if word == "rev" else f"{unit.to_si(1.0):.15g}"


def in_python(text: str) -> str | None:
    """Return what to write in an expression for a text such as `350mm`; None for any other text."""
    text = text.strip()
    try:
        value, dimension = parse_quantity(text)
    except (ValueError, OverflowError):
        return None
    if dimension is None:
        return None
    end = _end_of_number(text)
    number, unit = text[:end], text[end:].strip()
    if unit not in UNITS:
        return f"{value:.15g}"
    factor = factor_of(unit)
    return number if factor == "1" else f"{number} * {factor}"


def si_of(dimension: Dimension) -> str:
    """Return the SI unit of a dimension: "m/s"."""
    if dimension in _COMPOSED:
        return _COMPOSED[dimension]
    length, mass, time, angle = dimension
    powers = list(zip(_SYMBOLS, (mass, length, angle, time), strict=True))
    above = "*".join(_symbol(symbol, power) for symbol, power in powers if power > 0)
    below = "".join(f"/{_symbol(symbol, -power)}" for symbol, power in powers if power < 0)
    return (above or "1") + below


def _symbol(symbol: str, power: int) -> str:
    return symbol if power == 1 else f"{symbol}^{power}"


def _end_of_number(text: str) -> int:
    """Return where the number ends that a text begins with; 0 if it begins with none."""
    at = 1 if text[:1] in ("+", "-") else 0
    start, digits = at, 0
    while at < len(text) and (
        _is_digit(text[at]) or (text[at] == "." and "." not in text[start:at])
    ):
        digits += text[at] != "."
        at += 1
    if not digits:
        return 0
    if text[at : at + 1] in ("e", "E"):
        power = at + 1
        if text[power : power + 1] in ("+", "-"):
            power += 1
        end = power
        while end < len(text) and _is_digit(text[end]):
            end += 1
        if end > power:
            at = end
    return at


def _power(text: str, at: int) -> tuple[int, int]:
    """Return where the power of a unit ends, and the power: 1 if there is none."""
    start = at
    if text[at : at + 1] == "^":
        start = at = at + 1
        if text[at : at + 1] == "-":
            at += 1
    first = at
    while at < len(text) and _is_digit(text[at]):
        at += 1
    if at == first:
        if start != at or text[start - 1 : start] == "^":
            raise ValueError(f"'{text}' is not a unit")
        return at, 1
    power = int(text[start:at]) if at - first < 3 else LARGEST_POWER + 1
    if abs(power) > LARGEST_POWER:
        raise ValueError(f"'{text}' is not a unit")
    return at, power


def _is_digit(character: str) -> bool:
    return character in "0123456789"


def _plain(number: str) -> float:
    if not number or len(number) > LONGEST_NUMBER:
        raise ValueError(f"'{number[:20]}' is not a number")
    value = float(number)
    if value - value != 0:
        raise OverflowError(number)
    return int(number) if number.lstrip("+-").isdigit() else value


def _ratio(number: str) -> tuple[int, int]:
    """Return a number as a ratio of integers, without any rounding."""
    value = _plain(number)
    mantissa, _, exponent = number.lower().partition("e")
    whole, _, fraction = mantissa.partition(".")
    shift = int(exponent or 0) - len(fraction)
    if not value or shift < -2 * LONGEST_NUMBER:
        return value.as_integer_ratio()
    digits = int(whole + fraction)
    return (digits * 10**shift, 1) if shift >= 0 else (digits, 10**-shift)
