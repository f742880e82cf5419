"""Data that a robot in xacro loads from YAML files, as the language reads it."""

from __future__ import annotations

import re

from ....yaml.reader import UNITS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

_TAGGED = re.compile(
    rf"(?P<tag>{'|'.join(UNITS)})(?P<space>[ \t]+)(?P<value>[^\s#,\]}}'\"][^#,\]}}\n]*?)"
    r"(?=[ \t]*(?:[,\]}#\n]|$))"
)


def with_plain_units(text: str, evaluate: Callable[[str], object]) -> str:
    """Return data in which numbers with a unit are numbers, as in `!radians pi/2`.

    Args:
        text: the YAML.
        evaluate: returns the value of an expression of Python.
    """

    def spelled(found: re.Match[str]) -> str:
        value = found["value"]
        try:
            float(value)
            return found[0]
        except ValueError:
            pass
        try:
            number = evaluate(value)
        except Exception:  # of any kind: it is what xacro would run into as well
            return found[0]
        if not isinstance(number, (int, float)):
            return found[0]
        return f"{found['tag']}{found['space']}{float(number)!r}"

    return _TAGGED.sub(spelled, text)
