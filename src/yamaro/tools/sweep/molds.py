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
from collections.abc import Iterator, Mapping, Sequence
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
RANGE = "range"
"""Ending of fields whose first number has to be less than the second."""
MENDED = ("balanceinertia", "boundinertia", "boundmass", "settotalmass")
"""What a compiler may be asked to do with masses that another document has."""

ROUNDING = 1e-14
"""How much a quaternion's length may differ from 1 without being changed."""

Holes = dict[tuple[type, float], tuple[int, float]]
"""Which number of a document, and with which sign, a value is, by its type."""
Turn = tuple[Any, Any, Any, Any]
"""A quaternion, which of its parts are numbers of a document, which of these, and their signs."""
Turns = dict[tuple[float, ...], Turn]
"""Those in a document, by what MuJoCo makes of them: quaternions of length 1."""


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
        self._places: list[tuple[Any, int | str, int, float]] = []
        pairs = zip(_components(self._spec), _components(other), strict=True)
        for (owner, place, kind, value), (_, _, _, perturbed) in pairs:
            if value == perturbed or (value != value and perturbed != perturbed):
                continue
            at, sign = holes.get((kind, perturbed), (-1, 0.0))
            if at < 0 or value != float(kind(sign * given[at])):
                raise Unfit
            self._places.append((owner, place, at, sign))
        if {at for _, _, at, _ in self._places} != set(range(len(given))):
            raise Unfit
        self._cast: Cast | None = None
        if not any(getattr(self._spec.compiler, name, 0) > 0 for name in MENDED):
            models = self._spec.compile(), other.compile()
            try:
                self._cast = Cast(*models, given, others, holes, self._turns(others))
            except Unfit:
                pass

    def _turns(self, others: Sequence[float]) -> Turns:
        """Return the quaternions of the document that numbers are in."""
        numpy = import_extra("numpy")
        rows: dict[int, list[tuple[Any, int, int, float]]] = {}
        for owner, place, at, sign in self._places:
            if type(place) is int and type(owner) is numpy.ndarray and owner.shape == (4,):
                rows.setdefault(id(owner), []).append((owner, place, at, sign))
        found: Turns = {}
        for each in rows.values():
            raw = each[0][0].copy()
            places, at, signs = (numpy.array(part) for part in [*zip(*each, strict=True)][1:])
            other = raw.copy()
            other[places] = numpy.array(others)[at] * signs
            found[tuple(_unit(other).tolist())] = raw, places, at, signs
        return found

    def model(self, values: Sequence[float]) -> Any:
        """Return the model of a document with other numbers; it is valid until the next one.

        Raises:
            ValueError: MuJoCo refuses it.
        """
        if self._cast is not None and self._cast.take(values):
            return self._cast.model
        for owner, place, at, sign in self._places:
            if type(place) is int:
                owner[place] = sign * values[at]
            else:
                setattr(owner, place, sign * values[at])  # type: ignore[arg-type]
        return self._spec.compile()


class Cast:
    """A compiled model in which numbers are replaced.

    Attributes:
        model: it.
    """

    def __init__(
        self, base: Any, other: Any, given: Sequence[float], others: Sequence[float],
        holes: Holes, turns: Turns,
    ) -> None:  # fmt: skip
        """Find the numbers of a document in the model, by that of another document.

        Args:
            base: the model.
            other: that of the other document.
            given: the numbers of the document.
            others: the numbers of the other document.
            holes: which of these a value is.
            turns: which quaternions it has, of the other document.

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
        self._turns: list[tuple[Any, Turn]] = []
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
                if name.endswith("quat"):
                    pairs = zip(row.reshape(-1, 4), changed.reshape(-1, 4).tolist(), strict=True)
                    self._turns += [
                        (each, turns[key]) for each, new in pairs if (key := tuple(new)) in turns
                    ]
                    continue
                found = [
                    (place, *holes[key])
                    for place in numpy.flatnonzero(row != changed).tolist()
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
        for row, (raw, places, at, signs) in self._turns:
            raw[places] = numbers[at] * signs
            row[:] = _unit(raw)
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


def _components(spec: Any) -> Iterator[tuple[Any, int | str, type, float]]:
    """Yield the floating-point numbers of a model: their owner and place there, kind and value."""
    numpy = import_extra("numpy")
    for name in LISTS:
        found = getattr(spec, name, ())
        for element in found if isinstance(found, (list, tuple)) else (found,):
            inner = (getattr(element, each, None) for each in INNER)
            for owner in (element, *(each for each in inner if each is not None)):
                for attribute in properties(type(owner)):
                    value: Any = None if attribute in OTHERS else getattr(owner, attribute)
                    if type(value) is float:
                        yield owner, attribute, float, value
                    elif isinstance(value, numpy.ndarray) and value.dtype.kind == "f":
                        kind = numpy.float32 if value.dtype == numpy.float32 else float
                        row = value.reshape(-1)
                        for at in range(row.size):
                            yield row, at, kind, float(row[at])
                    elif type(value).__name__ == "MjDoubleVec":
                        for at in range(len(value)):
                            yield value, at, float, value[at]


_KNOWN: dict[type, list[str]] = {}


def properties(kind: type) -> list[str]:
    """Return the names of what objects of a kind have."""
    if kind not in _KNOWN:
        known = (name for name in dir(kind) if name[0] != "_")
        _KNOWN[kind] = [name for name in known if isinstance(getattr(kind, name), property)]
    return _KNOWN[kind]
