"""How much a run tries of what there is many of: examples of properties, cases, robots.

`scripts/test` is the quick run, `--slow` the usual one of CI, and `--whole` tries everything. Which
of many a run tries depends on their names alone: another one more does not change it.
"""

from __future__ import annotations

import zlib
from collections.abc import Callable, Iterable
from typing import Any, TypeVar

import pytest
from hypothesis import settings

Item = TypeVar("Item")

WHOLE, USUAL, QUICK = 100, 40, 20
PROFILES = {"quick": QUICK, "steady": USUAL, "whole": WHOLE}
"""Examples of a property in each run, out of a hundred that it could have."""


def _effort() -> int:
    profile: Any = settings.default
    return int(profile.max_examples)


def is_quick() -> bool:
    """Tell whether this is the quick run."""
    return _effort() < USUAL


def is_whole() -> bool:
    """Tell whether this run tries everything."""
    return _effort() >= WHOLE


def examples(count: int) -> int:
    """Return how many of `count` examples the run asks for; call it where a module begins."""
    return count * _effort() // WHOLE


def is_drawn(name: str, *, of: int) -> bool:
    """Tell whether a name is among about one of so many."""
    return zlib.crc32(name.encode()) % of == 0


def is_tried(name: str, *, quick: int, usual: int) -> bool:
    """Tell whether this run tries what has a name: one of so many, and all in the whole run."""
    of = quick if is_quick() else 1 if is_whole() else usual
    return is_drawn(name, of=of)


def tried(
    values: Iterable[Item], name: Callable[[Any], str], *, quick: int, usual: int
) -> list[Item]:
    """Return those of some values that this run tries."""
    return [each for each in values if is_tried(name(each), quick=quick, usual=usual)]


def sample(values: Iterable[Any], *, every: int) -> list[Any]:
    """Return parameters of a test; only the first of `every` so many is not slow."""
    return [
        pytest.param(value, marks=[pytest.mark.slow] * (number % every > 0))
        for number, value in enumerate(values)
    ]
