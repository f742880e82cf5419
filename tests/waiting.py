"""How tests wait for something to happen. No test asks how long something took."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

PATIENCE = 600.0
"""Seconds after which a test gives up: only what hangs takes so long, on a busy machine too."""

Value = TypeVar("Value")


def wait_for(condition: Callable[[], Value], *, pause: float = 0.005) -> Value:
    """Return the value of a condition as soon as it is true.

    Raises:
        AssertionError: It did not become true.
    """
    give_up = time.monotonic() + PATIENCE
    while not (value := condition()):
        assert time.monotonic() < give_up, "waited in vain"
        time.sleep(pause)
    return value
