"""What the quick run, `scripts/test`, leaves out: examples of properties, and many of a kind."""

from __future__ import annotations

import zlib
from collections.abc import Iterable
from typing import Any

import pytest
from hypothesis import settings

USUAL = 100
QUICK = 20


def is_quick() -> bool:
    """Tell whether this is the quick run."""
    return examples(USUAL) < USUAL


def examples(count: int) -> int:
    """Return how many of `count` examples the run asks for; call it where a module begins."""
    profile: Any = settings.default
    return count * profile.max_examples // USUAL


def is_drawn(name: str, *, of: int) -> bool:
    """Tell whether a name is among those that the quick run tries, about one of so many.

    Which these are depends on the name alone: another case more does not change it.
    """
    return zlib.crc32(name.encode()) % of == 0


def sample(values: Iterable[Any], *, every: int) -> list[Any]:
    """Return parameters of a test; only the first of `every` so many is not slow."""
    return [
        pytest.param(value, marks=[pytest.mark.slow] * (number % every > 0))
        for number, value in enumerate(values)
    ]
