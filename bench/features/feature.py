"""A feature of a robot: something that an output format can hold or lose."""

from __future__ import annotations

from dataclasses import dataclass

Key = tuple[object, ...]
"""What the feature is: its kind, whose it is, and its value; equal in every format."""


@dataclass(frozen=True)
class Feature:
    """A feature with the places, as offsets, of the elements that it is written in."""

    key: Key
    places: frozenset[int]

    def __str__(self) -> str:
        return " ".join(map(str, self.key))


def rounded(key: Key) -> Key:
    """Return a key in which numbers are rounded to nine digits."""
    return tuple(float(f"{each:.9g}") + 0.0 if isinstance(each, float) else each for each in key)


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
