"""The values of changes as text: before and after, with as many digits as they differ in."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.changes.change import Change

DIGITS = (6, 9, 12, 17)
MOMENTS = ("ixx", "iyy", "izz")
FILES = ("mesh", "texture")
"""How the values are called that name files."""
NONE = "none"
ARROW = " → "


def values_text(change: Change) -> str:
    """Return what a value was and is: `1.2 → 1.57 rad`."""
    before, after = change.before, change.after
    if change.what == "inertia" and isinstance(before, dict) and isinstance(after, dict):
        text = _inertia_text(before, after)
    elif isinstance(before, dict) and isinstance(after, dict):
        text = _dicts_text(before, after)
    elif folders := _folders_of(change):
        text = f"in {_pair_text(*folders)}"
    else:
        text = _pair_text(before, after)
    if change.unit and after is not None:
        text += f" {change.unit}"
    elif change.unit:
        text = text.replace(ARROW, f" {change.unit}{ARROW}")
    percent = _percent(before, after) if change.what == "mass" else ""
    remarks = [part for part in (percent, change.remark) if part]
    return f"{text} ({', '.join(remarks)})" if remarks else text


def _inertia_text(before: dict[str, object], after: dict[str, object]) -> str:
    """Return the moments of inertia; if all of them differ, the products by name alone."""
    moments = [name for name in MOMENTS if name in before]
    products = [name for name in before if name not in MOMENTS]
    if len(moments) < len(MOMENTS) or not products:
        return _dicts_text(before, after)
    text = _dicts_text(*({name: each[name] for name in MOMENTS} for each in (before, after)))
    return f"{text}, and {', '.join(products)}"


def _folders_of(change: Change) -> tuple[str, str] | None:
    """Return the folders of two files that have the same name in different folders, or None."""
    before, after = change.before, change.after
    if not change.what.endswith(FILES) or before == after:
        return None
    if not isinstance(before, str) or not isinstance(after, str):
        return None
    (folder, slash, name), (other, also, new_name) = before.rpartition("/"), after.rpartition("/")
    return (folder + slash, other + also) if name == new_name and slash and also else None


def _dicts_text(before: dict[str, object], after: dict[str, object]) -> str:
    pairs = [
        f"{name} {_pair_text(before.get(name), after.get(name))}"
        for name in dict.fromkeys((*before, *after))
    ]
    return ", ".join(pairs)


def _pair_text(before: object, after: object) -> str:
    """Return both values, with more digits if they look the same."""
    for digits in DIGITS:
        one, other = value_text(before, digits), value_text(after, digits)
        if one != other:
            break
    return one if one == other else f"{one}{ARROW}{other}"


def value_text(value: object, digits: int = DIGITS[0]) -> str:
    """Return one value as text."""
    if value is None:
        return NONE
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        text = f"{value:.{digits}g}"
        return "0" if text == "-0" else text
    if isinstance(value, (list, tuple)):
        return " ".join(value_text(item, digits) for item in value) or NONE
    if isinstance(value, dict):
        return ", ".join(f"{name} {value_text(item, digits)}" for name, item in value.items())
    return " ".join(str(value).split()) or '""'


def _percent(before: object, after: object) -> str:
    if not isinstance(before, float) or not isinstance(after, float) or before <= 0:
        return ""
    return f"{100 * (after / before - 1):+.3g} %"
