"""Builds the sources of robots that parsers refuse, since their faults are migrated too."""

from __future__ import annotations

from ...codes import ADJUSTABLE
from ...diagnostics import ERROR, YamaroError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import TypeVar

    T = TypeVar("T")


def build_allowing(build: Callable[[Sequence[str]], T]) -> tuple[T, list[str]]:
    """Return what is built, and the codes that had to be allowed.

    Args:
        build: builds with these codes allowed.

    Raises:
        YamaroError: there are errors that cannot be allowed.
    """
    try:
        return build(()), []
    except YamaroError as error:
        errors = [each for each in error.diagnostics if each.severity == ERROR]
        codes = sorted({each.code for each in errors})
        if not ADJUSTABLE.issuperset(codes):
            raise
    return build(codes), codes


def options_to_allow(codes: Sequence[str]) -> str:
    """Return the options with which the sources are built."""
    return " ".join(f"--allow {code}" for code in codes)
