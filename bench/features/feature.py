"""A feature of a robot: something that an output format can hold or lose."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from math import isclose

Key = tuple[object, ...]
"""What the feature is: its kind, whose it is, and its value; equal in every format."""


@dataclass(frozen=True)
class Feature:
    """A feature with the places, as offsets, of the elements that it is written in."""

    key: Key
    places: frozenset[int]

    def __str__(self) -> str:
        return " ".join(map(str, self.key))


def nearest(keys: Iterable[Key], known: Iterable[Key], tolerance: float) -> Iterator[Key]:
    """Yield each key as the known one that differs from it by rounding, if there is one.

    Args:
        keys: what was found in an output.
        known: what was found in the input.
        tolerance: how far a number may be off, as part of it.
    """
    alike: dict[Key, list[Key]] = {}
    for key in known:
        alike.setdefault(_without_numbers(key), []).append(key)
    for key in keys:
        near = (
            each
            for each in alike.get(_without_numbers(key), ())
            if all(map(partial(_is_near, tolerance=tolerance), key, each))
        )
        yield next(near, key)


def _without_numbers(key: Key) -> Key:
    return tuple(None if isinstance(each, float) else each for each in key)


def _is_near(one: object, other: object, *, tolerance: float) -> bool:
    if isinstance(one, float) and isinstance(other, float):
        return isclose(one, other, rel_tol=tolerance, abs_tol=1e-12)
    return one == other


def plain(text: str) -> object:
    """Return a value of SDF: a number, a truth value or a text."""
    if text in ("true", "false"):
        return float(text == "true")
    try:
        return float(text)
    except ValueError:
        return text


def negated(text: str) -> object:
    """Return the opposite of a truth value."""
    return float(plain(text) == 0.0)
