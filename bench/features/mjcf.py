"""The features of a robot in MJCF."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from .feature import Key


def read(text: str, names: Mapping[str, str]) -> Iterator[Key]:
    """Yield the features of an MJCF, with the names that things have in the robot."""
    yield from ()
