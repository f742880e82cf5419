"""Changes as JSON; docs/diff.md describes it."""

from __future__ import annotations

from math import isfinite

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ...model.changes.change import Changes, Moved
    from ...source import Span

VERSION = 1
"""Of the form of the JSON: another one if what is there changes its meaning."""


def changes_data(
    changes: Changes, labels: tuple[str, str], *, name: Callable[[Span], str]
) -> dict[str, object]:
    """Return the changes between two robots as plain data.

    Args:
        changes: what changed.
        labels: what the two files are called.
        name: gives the name of the file that a place is in.
    """
    motion = changes.motion
    return {
        "version": VERSION,
        "first": labels[0],
        "second": labels[1],
        "same": not changes.changes,
        "changes": [
            {
                "kind": change.kind,
                "of": change.of,
                "name": change.name,
                "new_name": change.new_name,
                "what": change.what or None,
                "before": _plain(change.before),
                "after": _plain(change.after),
                "unit": change.unit or None,
                "remark": change.remark or None,
                "first": _place(change.first, name),
                "second": _place(change.second, name),
                "moved": _moved(change.moved),
            }
            for change in changes.changes
        ],
        "motion": {
            "same": motion.is_same,
            "reason": motion.reason or None,
            "reference": motion.reference or None,
            "opposite": list(motion.opposite),
            "ranges": list(motion.ranges),
        },
        "mass": {"before": _plain(changes.mass[0]), "after": _plain(changes.mass[1])},
        "center_of_mass": {
            "before": _plain(changes.center[0]),
            "after": _plain(changes.center[1]),
        },
        "skipped": changes.skipped,
    }


def _place(span: Span | None, name: Callable[[Span], str]) -> dict[str, object] | None:
    if span is None:
        return None
    line, column = span.location()
    return {"file": name(span), "line": line, "column": column}


def _moved(moved: Moved | None) -> dict[str, object] | None:
    if moved is None:
        return None
    return {
        "links": moved.links,
        "furthest": moved.link,
        "distance": _plain(moved.distance),
        "angle": _plain(moved.angle),
        "at_zero": moved.is_at_zero,
    }


def _plain(value: object) -> object:
    """Return a value that JSON has; numbers that it does not have as text."""
    if isinstance(value, float) and not isfinite(value):
        return str(value)
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    return value
