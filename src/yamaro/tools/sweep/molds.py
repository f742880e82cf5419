"""Models of documents that differ in numbers, without reading the documents.

MuJoCo spends more time on reading a document than on compiling it. So one document is read, and its
numbers are replaced in what MuJoCo made of it, an `MjSpec`. Which number goes where is found by a
second document, in which each of them is another one.
"""

from __future__ import annotations

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
        holes: dict[tuple[type, float], tuple[int, float]] = {}
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

    def model(self, pieces: Sequence[str]) -> Any:
        """Return the model of a document that differs in numbers only.

        Raises:
            ValueError: MuJoCo refuses it.
        """
        values = [float(text) for text in pieces[1::2]]
        for owner, place, at, sign in self._places:
            if type(place) is int:
                owner[place] = sign * values[at]
            else:
                setattr(owner, place, sign * values[at])  # type: ignore[arg-type]
        return self._spec.compile()


def _components(spec: Any) -> Iterator[tuple[Any, int | str, type, float]]:
    """Yield the floating-point numbers of a model: their owner and place there, kind and value."""
    numpy = import_extra("numpy")
    for name in LISTS:
        found = getattr(spec, name, ())
        for element in found if isinstance(found, (list, tuple)) else (found,):
            inner = (getattr(element, each, None) for each in INNER)
            for owner in (element, *(each for each in inner if each is not None)):
                for attribute in _attributes(type(owner)):
                    value = getattr(owner, attribute)
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


def _attributes(kind: type) -> list[str]:
    """Return the attributes of a kind of element that may be numbers."""
    if kind not in _KNOWN:
        known = (name for name in dir(kind) if name[0] != "_" and name not in OTHERS)
        _KNOWN[kind] = [name for name in known if isinstance(getattr(kind, name), property)]
    return _KNOWN[kind]
