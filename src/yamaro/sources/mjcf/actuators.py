"""Actuators: which of them drive a joint as the model says it."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .classes import Given


def defaults(kinds: dict[str, Given], kind: str) -> Given:
    """Return what a class says of actuators of a kind."""
    return kinds.get(kind, {})
