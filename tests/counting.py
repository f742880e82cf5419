"""Counts the work a function does, which, unlike time, is the same on every run and machine."""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable
from types import FrameType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from _typeshed import TraceFunction


def calls_of(function: Callable[[], object]) -> int:
    """Return how many functions, Python's and C's, a call of `function` calls.

    The garbage collector rests meanwhile, since it calls what others have hung into it.
    """
    count = 0

    def profile(frame: object, event: str, argument: object) -> None:
        nonlocal count
        if event in ("call", "c_call"):
            count += 1

    before = sys.getprofile()
    was_enabled = gc.isenabled()
    gc.disable()
    sys.setprofile(profile)
    try:
        function()
    finally:
        sys.setprofile(before)
        if was_enabled:
            gc.enable()
    return count


def lines_of(function: Callable[[], object]) -> int:
    """Return how many lines of Python a call of `function` runs, also those that call nothing."""
    count = 0

    def trace(frame: FrameType, event: str, argument: Any) -> TraceFunction:
        nonlocal count
        count += event == "line"
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        function()
    finally:
        sys.settrace(before)
    return count
