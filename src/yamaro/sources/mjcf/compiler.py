"""What `<compiler>` says: units of angles, folders, what the mass of a body is taken from."""

from __future__ import annotations

from math import radians

from ...diagnostics import did_you_mean, failure
from ...model.pose import (
    IDENTITY,
    UNTURNED,
    ZERO,
    Pose,
    multiply,
    rotation_about,
    rotation_from_quaternion,
    rotation_from_z,
)
from ...xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.pose import Rotation, Vector
    from ...source import Span
    from ...xml.tree import Element
    from .classes import Given
    from .document import Document

ORIENTATIONS = ("quat", "axisangle", "xyaxes", "zaxis", "euler")
"""The attributes that say how a frame is turned, of which one is given."""
TURN_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
OPEN_ROWS = frozenset(
    """friction solref solimp gear gainprm biasprm dynprm size solreflimit solimplimit
    solreffriction solimpfriction polycoef damping stiffness fluidcoef user""".split()
)
"""The attributes with fewer numbers than they can have."""
LARGEST, MAXVAL = 1e30, 1e10
"""What no number of a model reaches, and MuJoCo's own bound of sizes: mjMAXVAL."""
SMALLEST = 1e-14
"""What MuJoCo takes for 0 in a vector: mjMINVAL."""
TRUTHS = {"true": True, "false": False}


def fault(message: str, span: Span, hint: str) -> Exception:
    """Return the error for a value that MuJoCo refuses."""
    return failure("bad-mjcf", message, span, hint=hint)


def numbers(given: Given, name: str, least: int = 1, most: int | None = None) -> list[float] | None:
    """Return the numbers of an attribute, or None if it is not given.

    Args:
        given: the attributes.
        name: the attribute.
        least: how many there are at least.
        most: how many there are at most; by default as many as at least.

    Raises:
        YamaroError: it is not a row of that many numbers.
    """
    value = given.get(name)
    if value is None:
        return None
    words = value[0].split()
    try:
        found = [*map(float, words)]
    except ValueError:
        word = next(each for each in words if not _is_number(each))
        raise fault(
            f"'{name}' takes numbers, and '{word}' is not one", value[1], f'write {name}="0.1"'
        ) from None
    most = least if most is None else most
    if not least <= len(found) <= most:
        wanted = f"{least}" if least == most else f"{least} to {most}"
        raise fault(
            f"'{name}' takes {wanted} number{'s' if most > 1 else ''}, not {len(found)}",
            value[1],
            f"write {wanted} number{'s' if most > 1 else ''} with spaces in between",
        )
    if not sum(map(abs, found)) < LARGEST:  # not of NaN either
        raise fault(
            f"'{name}' is too large for a model", value[1], f"MuJoCo takes up to {MAXVAL:g}"
        )
    return found


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def number(given: Given, name: str, default: float) -> float:
    """Return the number of an attribute, or a default."""
    if name not in given:
        return default
    found = numbers(given, name)
    return default if found is None else found[0]


def vector(given: Given, name: str, default: Vector = ZERO) -> Vector:
    """Return the three numbers of an attribute, or a default."""
    found = numbers(given, name, 3)
    return default if found is None else (found[0], found[1], found[2])


def chosen(given: Given, name: str, choices: tuple[str, ...], default: str) -> str:
    """Return the word of an attribute, which is one of some.

    Raises:
        YamaroError: it is another one.
    """
    value = given.get(name)
    if value is None:
        return default
    word = value[0].strip()
    if word not in choices:
        raise fault(
            f"'{name}' is one of {', '.join(choices)}, and '{word}' is none of them",
            value[1],
            did_you_mean(word, choices) or f'write {name}="{choices[0]}"',
        )
    return word


def truth(given: Given, name: str, default: bool) -> bool:
    """Return what an attribute of true or false says."""
    return TRUTHS[chosen(given, name, ("true", "false"), "true" if default else "false")]


def completed(own: Given, base: Given) -> Given:
    """Return the attributes of an element or class, with those that a class around it has.

    A row that is shorter than that of the class takes the rest from it, as in MuJoCo.
    """
    merged = {**base, **own}
    for name in OPEN_ROWS & own.keys() & base.keys():
        words, others = own[name][0].split(), base[name][0].split()
        if len(words) < len(others):
            merged[name] = (" ".join([*words, *others[len(words) :]]), own[name][1])
    if any(each in own for each in ORIENTATIONS):
        for each in ORIENTATIONS:
            if each not in own:
                merged.pop(each, None)
    return merged


def given_by(element: Element) -> Given:
    """Return the attributes of an element."""
    place = element.value_span
    return {
        name: (value if type(value) is str else format_value(value), place(name))
        for name, value in element.attributes.items()
        if value is not None
    }


class Compiler:
    """The settings of a document.

    Attributes:
        given: all that the elements `<compiler>` say; what comes later wins.
        has_degrees: whether angles are in degrees.
        sequence: the axes that `euler` turns about.
        autolimits: whether a range makes a limit.
        meshdir, texturedir: the folders of assets, as written.
    """

    __slots__ = ("autolimits", "given", "has_degrees", "meshdir", "sequence", "texturedir")

    def __init__(self, document: Document) -> None:
        """Read the settings.

        Raises:
            YamaroError: a value is faulty.
        """
        given: Given = {}
        for section in document.sections("compiler"):
            given.update(given_by(section))
        self.given = given
        self.has_degrees = chosen(given, "angle", ("degree", "radian"), "degree") == "degree"
        self.autolimits = truth(given, "autolimits", True)
        self.sequence = given.get("eulerseq", ("xyz", None))[0]
        if len(self.sequence) != 3 or not set(self.sequence) <= set("xyzXYZ"):
            raise fault(
                f"'{self.sequence}' is not a sequence of three axes",
                given["eulerseq"][1],
                'write eulerseq="xyz"; capitals are axes that stand still',
            )
        if given.get("coordinate", ("local", None))[0] == "global":
            raise fault(
                "MuJoCo no longer reads global coordinates",
                given["coordinate"][1],
                "convert the file with MuJoCo 2.3.3 or older",
            )
        common = given.get("assetdir", ("", None))[0]
        self.meshdir = given.get("meshdir", (common, None))[0]
        self.texturedir = given.get("texturedir", (common, None))[0]

    def angle(self, value: float) -> float:
        """Return an angle of the document in radians."""
        return radians(value) if self.has_degrees else value

    # --- frames ---

    def pose(self, given: Given) -> Pose:
        """Return the pose that attributes say: `pos`, and one that says how it is turned."""
        position = vector(given, "pos")
        turn = self.rotation(given)
        if turn is UNTURNED and position == ZERO:
            return IDENTITY
        return Pose(turn, position)

    def rotation(self, given: Given) -> Rotation:
        """Return the rotation that attributes say.

        Sources: MuJoCo's manual, "Frame orientations"; ResolveOrientation in user_objects.cc.
        """
        if given.keys().isdisjoint(ORIENTATIONS):
            return UNTURNED
        if (euler := numbers(given, "euler", 3)) is not None:
            return self.euler(euler)
        if (row := numbers(given, "axisangle", 4)) is not None:
            axis = _unit((row[0], row[1], row[2]), "axisangle", given)
            return rotation_about(axis, self.angle(row[3]))
        if (row := numbers(given, "xyaxes", 6)) is not None:
            return _from_axes(row, given)
        if (row := numbers(given, "zaxis", 3)) is not None:
            return rotation_from_z(_unit((row[0], row[1], row[2]), "zaxis", given))
        if (row := numbers(given, "quat", 4)) is not None:
            w, x, y, z = row
            if w * w + x * x + y * y + z * z < SMALLEST * SMALLEST:
                raise fault("a quaternion has no length", given["quat"][1], 'write quat="1 0 0 0"')
            return rotation_from_quaternion(x, y, z, w) if x or y or z else UNTURNED
        return UNTURNED

    def euler(self, angles: list[float]) -> Rotation:
        """Return the rotation of three angles about the axes of the sequence."""
        turn = UNTURNED
        for letter, angle in zip(self.sequence, angles, strict=True):
            if angle:
                step = rotation_about(TURN_AXES[letter.lower()], self.angle(angle))
                turn = multiply(turn, step) if letter.islower() else multiply(step, turn)
        return turn


def _unit(row: Vector, name: str, given: Given) -> Vector:
    x, y, z = row
    length = (x * x + y * y + z * z) ** 0.5
    if length < SMALLEST:
        raise fault(f"'{name}' has no direction", given[name][1], f'write {name}="0 0 1"')
    return (x / length, y / length, z / length)


def _from_axes(row: list[float], given: Given) -> Rotation:
    x = _unit((row[0], row[1], row[2]), "xyaxes", given)
    a, b, c = row[3:]
    along = x[0] * a + x[1] * b + x[2] * c
    y = _unit((a - along * x[0], b - along * x[1], c - along * x[2]), "xyaxes", given)
    z = (
        x[1] * y[2] - x[2] * y[1],
        x[2] * y[0] - x[0] * y[2],
        x[0] * y[1] - x[1] * y[0],
    )
    return ((x[0], y[0], z[0]), (x[1], y[1], z[1]), (x[2], y[2], z[2]))


def unit_axis(given: Given, default: Vector) -> Vector:
    """Return the axis of a joint, of length 1.

    Raises:
        YamaroError: it has no length.
    """
    row = numbers(given, "axis", 3)
    return default if row is None else _unit((row[0], row[1], row[2]), "axis", given)
