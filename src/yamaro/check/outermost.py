"""Checks elements directly under `robot`, where the extensions of other programs are as well."""

from __future__ import annotations

from ..model.schema import OTHER_FORMATS
from ..model.shapes import SHAPE_WORDS
from ..xml.tree import Element
from .context import CheckContext

USED_LIKE: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "link": ((), ("inertial", "visual", "collision")),
    "joint": (("type",), ("parent", "child")),
    "material": ((), ("color", "texture")),
    "transmission": ((), ("type", "joint", "actuator")),
    "ros2_control": (("type",), ("hardware", "joint")),
}
"""Attributes and children by which an element of a misspelt name is recognised."""
PARENTS = {
    "origin": "a joint, visual, collision or inertial",
    "geometry": "a visual or collision",
    "visual": "a link",
    "collision": "a link",
    "inertial": "a link",
    "mass": "the inertial of a link",
    "inertia": "the inertial of a link",
    "color": "a material",
    "texture": "a material",
    "material": "a visual",
    **dict.fromkeys(SHAPE_WORDS, "a geometry"),
    **dict.fromkeys(("parent", "child", "axis", "limit", "mimic", "dynamics"), "a joint"),
    **dict.fromkeys(("calibration", "safety_controller"), "a joint"),
}


def check_outermost(child: Element, context: CheckContext) -> None:
    """Check an element directly under `robot`, where everybody's extensions stand as well."""
    name = child.name
    if name in PARENTS:
        context.warn(
            "unknown-element",
            f"'{name}' has no meaning directly under 'robot'; parsers ignore it",
            child,
            hint=f"it belongs in {PARENTS[name]}",
        )
        return
    if OTHER_FORMATS.get(name) == "SDF":  # MuJoCo reads a `mujoco` element in URDF
        context.warn(
            "unknown-element",
            f"'{name}' is an element of {OTHER_FORMATS[name]}; parsers of URDF ignore it",
            child,
            hint="describe links and joints in URDF, or use the file where its format is read",
        )
        return
    near = _near_outermost(child)
    if near is not None:
        from ..fixes import respelling

        context.warn(
            "unknown-element",
            f"URDF has no element '{name}', so parsers ignore it",
            child,
            hint=f"did you mean '{near}'?",
            fix=respelling(child.span, child.name, near),
        )


def _near_outermost(child: Element) -> str | None:
    """Return the element meant, if the name is one slip away from it and it is used like it."""
    if ":" in child.name or "name" not in child.attributes:
        return None
    for known, (attributes, children) in USED_LIKE.items():
        if not is_one_slip_away(child.name, known):
            continue
        is_used_like = any(name in child.attributes for name in attributes) or any(
            inner.name in children for inner in child.elements()
        )
        # `<line name="l"/>` may be anything; `<lnik name="l"/>` has the very letters of a link.
        if is_used_like or sorted(child.name.lower()) == sorted(known):
            return known
    return None


def is_one_slip_away(word: str, known: str) -> bool:
    """Return whether one letter too many, too few, wrong, swapped or of another case separates."""
    if word.lower() == known.lower():
        return word != known
    if abs(len(word) - len(known)) > 1:
        return False
    start = 0
    while start < min(len(word), len(known)) and word[start] == known[start]:
        start += 1
    left, right = word[start:], known[start:]
    if len(word) == len(known):
        swapped = left[:2] == right[:2][::-1] and left[2:] == right[2:]
        return swapped or left[1:] == right[1:]
    return left[1:] == right if len(word) > len(known) else left == right[1:]
