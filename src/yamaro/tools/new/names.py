"""What a new package may be called: by ROS, by Python, by pip and by Yamaro itself."""

from __future__ import annotations

import keyword
import re
import sys

LONGEST = 64
_VALID = re.compile(r"[a-z][a-z0-9]*(_[a-z0-9]+)*")
_TAKEN = {"yamaro", "yamaro_ros"}
_MODULES = sys.stdlib_module_names | {"test"}


def fault_of_name(name: str) -> str | None:
    """Return what is wrong with the name of a package, and what to write, or None."""
    if not name:
        return "the name is empty"
    if len(name) > LONGEST:
        return f"it has more than {LONGEST} characters"
    if not _VALID.fullmatch(name) or len(name) < 2:
        rule = (
            "the names of ROS packages have lower-case letters, digits and single underscores, "
            "begin with a letter, and have at least two characters"
        )
        near = _nearest(name)
        return f"{rule}; for example '{near}'" if near else rule
    if name in _TAKEN:
        return "Yamaro itself has that name"
    if keyword.iskeyword(name):
        return f"it is a keyword of Python; for example '{name}_robot'"
    if name in _MODULES:
        return f"Python has a module of that name; for example '{name}_robot'"
    return None


def _nearest(name: str) -> str:
    """Return a valid name like one that is not, or "" if there is none."""
    spaced = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name)
    near = re.sub(r"[^a-z0-9]+", "_", spaced.lower()).strip("_").lstrip("0123456789_")
    return near if len(near) > 1 and fault_of_name(near) is None else ""
