"""An interpreter that builds each element for its place."""

from __future__ import annotations

from typing import Any

from yamaro.runtime.interpreter import Interpreter


def unsharing(*args: Any, **kwargs: Any) -> Interpreter:
    """Return an interpreter that shares no elements, whatever it is asked for."""
    return Interpreter(*args, **{**kwargs, "shares": False})
