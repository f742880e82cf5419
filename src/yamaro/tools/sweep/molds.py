"""Models of documents that differ in numbers, without reading the documents.

MuJoCo spends more time on reading a document than on compiling it. So one document is read, and its
numbers are replaced in what MuJoCo made of it, an `MjSpec`. Which number goes where is found by a
second document, in which each of them is another one.

Compiling in turn takes twenty times as long as `mj_setConst`, which derives what depends on numbers
of a model. So where a second model shows that numbers of the document are in the model as they are,
and that `mj_setConst` derives all others, they are replaced in the model. Only the statistics are
left to be computed here.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any

from .plan import import_extra

LISTS = (
    "bodies", "frames", "joints", "geoms", "sites", "cameras", "lights", "actuators", "sensors",
    "keys", "equalities", "pairs", "excludes", "tendons", "materials", "textures", "meshes",
    "hfields", "skins", "flexes", "numerics", "texts", "tuples", "option", "stat",
)  # fmt: skip
"""Where an `MjSpec` has the elements of a model."""
INNER = ("alt", "ialt")
"""Objects in elements that have numbers."""
OTHERS = frozenset(("classname", "compiler", "frame", "id", "parent", "plugin", "signature"))
CHANGE = 1e-3
"""By which part of itself, at most, a number is another one in the second document."""


FREE = (
    "_pos", "_ipos", "_qpos", "_qvel", "_ctrl", "_rgba", "qpos0", "qpos_spring",
)  # fmt: skip
"""Endings of fields for which MuJoCo takes any number."""
POSITIONS = ("qpos0", "qpos_spring", "key_qpos")
"""Fields with the positions of all joints."""
RANGE = "range"
"""Ending of fields whose first number has to be less than the second."""
MENDED = ("balanceinertia", "boundinertia", "boundmass", "settotalmass")
"""What a compiler may be asked to do with masses that another document has."""

ROUNDING = 1e-14
"""How much a quaternion's length may differ from 1 without being changed."""

Holes = dict[tuple[type, float], tuple[int, float]]
"""Which number of a document, and with which sign, a value is, by its type."""
FREE_JOINT, BALL = 0, 1
"""The types of joints that have a quaternion: `mjtJoint`."""
ELLIPSOID, BOX, MESH = 4, 6, 7
"""Types of shapes: `mjtGeom`."""


class Row:
    """A row of values in an `MjSpec`, some of which are numbers of the document.

    Attributes:
        element: what has it.
        name: its name there.
        values: all of its values.
    """

    __slots__ = ("_at", "_holes", "_places", "_signs", "element", "name", "values")

    def __init__(
        self, element: Any, name: str, values: Any, places: Sequence[tuple[int, int, float]]
    ) -> None:
        """Take a row; of each number its place, which one of the document it is, and its sign."""
        numpy = import_extra("numpy")
        self.element = element
        self.name = name
        self.values = numpy.array(values, float)
        self._holes = places
        table = numpy.array([*places], float).reshape(-1, 3)
        self._places, self._at = table[:, :2].astype(int).T
        self._signs = table[:, 2]

    def given(self, numbers: Any) -> Any:
        """Return the values for other numbers of the document; they are valid until the next."""
        self.values[self._places] = numbers[self._at] * self._signs
        return self.values

    def part(self, first: int, count: int) -> Row | None:
        """Return some of its values as a row, None if no number is among them."""
        places = [
            (place - first, at, sign)
            for place, at, sign in self._holes
            if first <= place < first + count
        ]
        values = self.values[first : first + count]
        return Row(self.element, self.name, values, places) if places else None


class Unfit(Exception):
    """A number of the document is in the model only as part of something else."""


class Mold:
    """A model whose numbers can be replaced."""

    def __init__(self, pieces: Sequence[str], files: Mapping[str, bytes]) -> None:
        """Read a document.

        Args:
            pieces: it in pieces; every second one is a number.
            files: what belongs beside it, by path.

        Raises:
            Unfit: a number is not in the model as it is.
            Exception: whatever MuJoCo raises for either document.
        """
        mujoco, numpy = import_extra("mujoco", "sim"), import_extra("numpy")
        given = [float(text) for text in pieces[1::2]]
        others = [
            value * (1 + CHANGE * (at + 1) / len(given)) if value else CHANGE**2 * (at + 1)
            for at, value in enumerate(given)
        ]
        changed = list(pieces)
        changed[1::2] = map(repr, others)
        self._spec = mujoco.MjSpec.from_string("".join(pieces), assets=dict(files))
        other = mujoco.MjSpec.from_string("".join(changed), assets=dict(files))
        holes: Holes = {}
        for kind in (float, numpy.float32):  # colours are of the latter
            for at, value in enumerate(others):
                for sign in (1.0, -1.0):
                    key = (kind, float(kind(sign * value)))
                    if key in holes:
                        raise Unfit
                    holes[key] = (at, sign)
        self._places: list[tuple[Any, str, Any, int | None, int, float]] = []
        pairs = zip(_components(self._spec), _components(other), strict=True)
        for (element, name, owner, place, kind, value), (*_, perturbed) in pairs:
            if value == perturbed or (value != value and perturbed != perturbed):
                continue
            at, sign = holes.get((kind, perturbed), (-1, 0.0))
            if at < 0 or value != float(kind(sign * given[at])):
                raise Unfit
            self._places.append((element, name, owner, place, at, sign))
        if {at for *_, at, _ in self._places} != set(range(len(given))):
            raise Unfit
        self._cast: Cast | None = None
        if not any(getattr(self._spec.compiler, name, 0) > 0 for name in MENDED):
            models = self._spec.compile(), other.compile()
            try:
                self._cast = Cast(*models, given, others, holes, self._rows())
            except Unfit:
                pass

    def _rows(self) -> list[Row]:
        """Return the rows of values that numbers of the document are in."""
        found: dict[tuple[int, str], tuple[Any, str, Any, list[tuple[int, int, float]]]] = {}
        for element, name, owner, place, at, sign in self._places:
            if type(place) is int:
                row = found.setdefault((id(element), name), (element, name, owner, []))
                row[3].append((place, at, sign))
        return [Row(*each) for each in found.values()]

    def model(self, values: Sequence[float]) -> Any:
        """Return the model of a document with other numbers; it is valid until the next one.

        Raises:
            ValueError: MuJoCo refuses it.
        """
        if self._cast is not None and self._cast.take(values):
            return self._cast.model
        for element, name, owner, place, at, sign in self._places:
            if place is None:
                setattr(element, name, sign * values[at])
            else:
                owner[place] = sign * values[at]
        return self._spec.compile()


class Cast:
    """A compiled model in which numbers are replaced.

    Attributes:
        model: it.
    """

    def __init__(
        self, base: Any, other: Any, given: Sequence[float], others: Sequence[float],
        holes: Holes, rows: Sequence[Row],
    ) -> None:  # fmt: skip
        """Find the numbers of a document in the model, by that of another document.

        Args:
            base: the model.
            other: that of the other document.
            given: the numbers of the document.
            others: the numbers of the other document.
            holes: which of these a value is.
            rows: where they are in what the model is compiled from.

        Raises:
            Unfit: MuJoCo does not derive all that depends on them.
        """
        mujoco, numpy = import_extra("mujoco", "sim"), import_extra("numpy")
        if base.nflex or not base.geom_rbound.all():  # planes and fields have other sizes
            raise Unfit
        self.model = base
        self._data = mujoco.MjData(base)
        self._frames = base.body_sameframe.copy()
        self._puts: list[tuple[Any, Any, Any, Any]] = []
        self._ranges: list[tuple[Any, Any]] = []
        self._derived = [*derived(base, rows)]
        turns = {
            tuple(_unit(row.given(numpy.array(others))).tolist()): row
            for each in rows
            for row in quaternions_in(base, each)
        }
        signed: set[int] = set()
        for one, two in ((base, other), (base.opt, other.opt)):
            for name in properties(type(one)):
                value = getattr(one, name)
                if not isinstance(value, numpy.ndarray) or value.dtype.kind != "f":
                    continue
                kind = numpy.float32 if value.dtype == numpy.float32 else float
                row, changed = value.reshape(-1), getattr(two, name).reshape(-1)
                if row.shape != changed.shape:
                    raise Unfit
                starts = [*range(0, row.size, 4)] if name.endswith("quat") else []
                if name in POSITIONS:
                    starts = [
                        at + first for at in range(0, row.size, base.nq) for first in turned(base)
                    ]
                for at in starts:
                    turn = turns.get(tuple(changed[at : at + 4].tolist()))
                    if turn is not None:
                        self._derived.append(partial(_put_turn, row[at : at + 4], turn))
                if name.endswith("quat"):
                    continue
                found = [
                    (place, *holes[key])
                    for place in numpy.flatnonzero(row != changed).tolist()
                    if not any(at <= place < at + 4 for at in starts)
                    if (key := (kind, float(changed[place]))) in holes
                ]
                places = [
                    (place, at, sign)
                    for place, at, sign in found
                    if row[place] == kind(sign * given[at])
                ]
                if not places:
                    continue
                self._puts.append((row, *map(numpy.array, zip(*places, strict=True))))
                if name.endswith(RANGE):
                    self._ranges.append((value, value[:, 0] < value[:, 1]))
                elif not name.endswith(FREE):
                    signed.update(at for _, at, _ in places)
        self._least = mujoco.mjMINVAL
        self._signed = numpy.array(sorted(signed), int)
        self._signs = self._signs_of(numpy.array(given))
        for values, expected in ((others, saved(other)), (given, saved(base))):
            if not self.take(values) or not numpy.array_equal(saved(self.model), expected):
                raise Unfit

    def _signs_of(self, values: Any) -> Any:
        numpy = import_extra("numpy")
        signed = values[self._signed]
        return numpy.sign(signed) * (abs(signed) > self._least)

    def take(self, values: Sequence[float]) -> bool:
        """Give the model other numbers; return whether they differ in nothing but size.

        MuJoCo refuses some numbers, and zeros may mean that something is not there. Where signs
        are the same, ranges have a width, and moments of inertia are possible, neither can happen.
        """
        mujoco, numpy = import_extra("mujoco", "sim"), import_extra("numpy")
        numbers = numpy.array(values)
        if not (numpy.isfinite(numbers).all() and (self._signs_of(numbers) == self._signs).all()):
            return False
        for row, places, at, signs in self._puts:
            row[places] = numbers[at] * signs
        try:
            for derive in self._derived:
                derive(numbers)
        except ValueError:
            return False
        x, y, z = self.model.body_inertia.T
        if not ((x + y >= z) & (y + z >= x) & (z + x >= y)).all():
            return False
        if not all(((each[:, 0] < each[:, 1]) == was).all() for each, was in self._ranges):
            return False
        mujoco.mj_setConst(self.model, self._data)
        self._set_statistics()
        return bool((self.model.body_sameframe == self._frames).all())

    def _set_statistics(self) -> None:
        """Set the statistics, which only the compiler of MuJoCo does.

        Source: MuJoCo's documentation of the element `statistic`, and `setStat` of its engine.
        """
        mujoco, numpy = import_extra("mujoco", "sim"), import_extra("numpy")
        model, data = self.model, self._data
        data.qpos[:] = model.qpos0
        mujoco.mj_kinematics(model, data)
        reach = model.geom_rbound[:, None]
        points = (data.xpos[1:], data.xipos[1:], data.xanchor, data.site_xpos)
        low = numpy.concatenate((*points, data.geom_xpos - reach)).min(0)
        high = numpy.concatenate((*points, data.geom_xpos + reach)).max(0)
        sizes = numpy.zeros(model.nbody)
        parents = model.body_parentid[model.jnt_bodyid]
        for bodies, places, radius in (
            (model.jnt_bodyid, data.xanchor, 0.0),
            (parents, data.xanchor, 0.0),
            (model.geom_bodyid, data.geom_xpos, model.geom_rbound),
        ):
            x, y, z = (data.xipos[bodies] - places).T
            numpy.maximum.at(sizes, bodies, radius + numpy.sqrt(x * x + y * y + z * z))
        others = model.nbody - 1
        found = model.stat
        # Sums go from the first to the last, as in MuJoCo, to be the same in all digits.
        found.meansize = (numpy.maximum(sizes[1:], 1e-5) / others).cumsum()[-1]
        found.extent = max(1e-5, *(high - low), 2 * found.meansize)
        found.center[:] = (low + high) * 0.5
        found.meanmass = model.body_mass[1:].cumsum()[-1] / others
        if model.nv:
            found.meaninertia = model.dof_M0.cumsum()[-1] / model.nv


# --- what the compiler of MuJoCo derives from values -------------------------------------------


def turned(model: Any) -> list[int]:
    """Return where quaternions begin in the positions of a model."""
    pairs = zip(model.jnt_type.tolist(), model.jnt_qposadr.tolist(), strict=True)
    return [
        at + 3 if kind == FREE_JOINT else at for kind, at in pairs if kind in (FREE_JOINT, BALL)
    ]


def quaternions_in(model: Any, row: Row) -> list[Row]:
    """Return the quaternions in a row of values that have numbers of the document."""
    if row.name.endswith("quat"):
        return [row]
    if row.name not in ("qpos", "qpos0") or len(row.values) != model.nq:
        return []
    parts = (row.part(first, 4) for first in turned(model))
    return [each for each in parts if each is not None]


def _put_turn(place: Any, quaternion: Row, numbers: Any) -> None:
    place[:] = _unit(quaternion.given(numbers))


def derived(model: Any, rows: Sequence[Row]) -> Iterator[Callable[[Any], None]]:
    """Yield what writes the values of a model that its compiler makes of some rows.

    Raises:
        Unfit: the compiler is as fast.
    """
    inertias = [row for row in rows if row.name == "fullinertia"]
    if inertias:
        if not model.nmesh:
            raise Unfit
        yield PrincipalAxes(model, inertias).put
    placed: dict[int, dict[str, Row]] = {}
    for row in rows:
        element, own = row.element, type(row.element).__name__
        if row.name == "fromto" and own in ("MjsGeom", "MjsSite"):
            names = (f"{own[3:].lower()}_{each}" for each in ("pos", "quat", "size"))
            position, turn, size = (getattr(model, name)[element.id] for name in names)
            yield partial(_put_between, position, turn, size, int(element.type), row)
        elif own == "MjsGeom" and model.geom_type[element.id] == MESH:
            placed.setdefault(element.id, {})[row.name] = row
    for geom, given in placed.items():
        element = next(iter(given.values())).element
        where = [
            given.get(name) or Row(element, name, getattr(element, name), ())
            for name in ("pos", "quat")
        ]
        yield partial(_put_mesh, model, geom, *where)


class PrincipalAxes:
    """The principal moments and axes of inertias, as the compiler of a model of them finds them."""

    __slots__ = ("_bodies", "_model", "_rows", "_spec")

    def __init__(self, model: Any, rows: Sequence[Row]) -> None:
        """Take the model of a document, and the inertias in it."""
        body = '<body><inertial pos="0 0 0" mass="1" fullinertia="1 1 1 0 0 0"/></body>'
        bodies = body * len(rows)
        self._model = model
        self._rows = rows
        self._spec = import_extra("mujoco", "sim").MjSpec.from_string(
            f"<mujoco><worldbody>{bodies}</worldbody></mujoco>"
        )
        self._bodies = self._spec.bodies[1:]

    def put(self, numbers: Any) -> None:
        """Write the moments and axes; raise ValueError if an inertia is refused."""
        for body, row in zip(self._bodies, self._rows, strict=True):
            body.fullinertia = row.given(numbers)
        found, model = self._spec.compile(), self._model
        own = [row.element.id for row in self._rows]
        model.body_inertia[own], model.body_iquat[own] = (
            found.body_inertia[1:],
            found.body_iquat[1:],
        )


def _put_mesh(model: Any, geom: int, position: Row, turn: Row, numbers: Any) -> None:
    """Write where a mesh is, whose frame is that of its principal axes.

    Products are summed in the order in which the compiler has them, to be the same in all digits.
    """
    numpy = import_extra("numpy")
    mesh = model.geom_dataid[geom]
    w, x, y, z = _unit(turn.given(numbers)).tolist()
    matrix = numpy.array((
        (w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z),
    ))  # fmt: skip
    along = matrix * model.mesh_pos[mesh]
    model.geom_pos[geom] = position.given(numbers) + (along[:, 0] + along[:, 1] + along[:, 2])
    a, b, c, d = model.mesh_quat[mesh].tolist()
    model.geom_quat[geom] = _unit(numpy.array((
        w * a - x * b - y * c - z * d,
        w * b + x * a + y * d - z * c,
        w * c - x * d + y * a + z * b,
        w * d + x * c - y * b + z * a,
    )))  # fmt: skip


def _put_between(position: Any, turn: Any, size: Any, kind: int, row: Row, numbers: Any) -> None:
    """Write where a shape between two points is, and half its length, as `fromto` says it."""
    numpy = import_extra("numpy")
    points = row.given(numbers)
    x, y, z = (points[:3] - points[3:]).tolist()
    length = math.sqrt(x * x + y * y + z * z)
    position[:] = (points[:3] + points[3:]) / 2
    size[1:2] = length / 2
    if kind in (BOX, ELLIPSOID):
        size[1:] = size[0], length / 2
    # From z to the line, about what is perpendicular to both.
    x, y, z = x / length, y / length, z / length
    sine = math.sqrt(x * x + y * y)
    axis = (-y / sine, x / sine) if sine >= 1e-10 else (1.0, 0.0)
    angle = math.atan2(sine, z)
    part = math.sin(angle / 2)
    turn[:] = numpy.array((math.cos(angle / 2), axis[0] * part, axis[1] * part, 0.0))


def _unit(quaternion: Any) -> Any:
    """Return a quaternion of length 1, with the digits that MuJoCo's compiler gives it."""
    w, x, y, z = quaternion.tolist()
    length = math.sqrt(w * w + x * x + y * y + z * z)
    return quaternion / length if abs(length - 1) > ROUNDING else quaternion


def saved(model: Any) -> Any:
    """Return all of a model as a row of numbers."""
    mujoco, numpy = import_extra("mujoco", "sim"), import_extra("numpy")
    size = mujoco.mj_sizeModel(model)
    row = numpy.zeros(-(-size // 8) * 8, numpy.uint8)
    mujoco.mj_saveModel(model, None, row[:size])
    return row.view(numpy.uint64)


def _components(spec: Any) -> Iterator[tuple[Any, str, Any, int | None, type, float]]:
    """Yield the floating-point numbers of a model.

    Of each the element, the name of what it is in there, that and its place in it, None for a
    number that is alone, its kind and its value.
    """
    numpy = import_extra("numpy")
    for name in LISTS:
        found = getattr(spec, name, ())
        for element in found if isinstance(found, (list, tuple)) else (found,):
            inner = (getattr(element, each, None) for each in INNER)
            for owner in (element, *(each for each in inner if each is not None)):
                for attribute in properties(type(owner)):
                    value: Any = None if attribute in OTHERS else getattr(owner, attribute)
                    if type(value) is float:
                        yield owner, attribute, value, None, float, value
                    elif isinstance(value, numpy.ndarray) and value.dtype.kind == "f":
                        kind = numpy.float32 if value.dtype == numpy.float32 else float
                        row = value.reshape(-1)
                        for at in range(row.size):
                            yield owner, attribute, row, at, kind, float(row[at])
                    elif type(value).__name__ == "MjDoubleVec":
                        for at in range(len(value)):
                            yield owner, attribute, value, at, float, value[at]


_KNOWN: dict[type, list[str]] = {}


def properties(kind: type) -> list[str]:
    """Return the names of what objects of a kind have."""
    if kind not in _KNOWN:
        known = (name for name in dir(kind) if name[0] != "_")
        _KNOWN[kind] = [name for name in known if isinstance(getattr(kind, name), property)]
    return _KNOWN[kind]
