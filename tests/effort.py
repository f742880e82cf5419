"""How many examples a property is tried with: fewer in the quick run, `scripts/test`."""

from __future__ import annotations

from typing import Any

from hypothesis import settings

USUAL = 100
QUICK = 20


def examples(count: int) -> int:
    """Return how many of `count` examples the run asks for; call it where a module begins."""
    profile: Any = settings.default
    return count * profile.max_examples // USUAL
