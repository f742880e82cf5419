"""Check of the materials: colours in range, names that are defined, and defined once."""

from __future__ import annotations

from ..diagnostics import WARNING
from ..model.values import attribute_text, child_named
from ..xml.tree import Element
from .context import COLORS, USES, CheckContext, is_attribute, label, shown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..model.robot import Robot
    from ..source import Span
    from .context import Children


def check_materials(robot: Robot, context: CheckContext) -> None:
    """Check the robot's own materials, and that the materials of its visuals are defined."""
    known: dict[str, Element] = {}
    for each in robot.own_materials:
        context.outermost = each.element
        _check_global(each.element, known, context)
    context.stage = USES
    inside = context.materials_inside
    for name, (link, material) in context.material_uses.items():
        if name in known or name in inside:
            continue
        context.outermost = link
        hint, fix = context.near(name, [*known, *sorted(inside)], material.value_span("name"))
        context.report(
            "unknown-material",
            f"the material '{name}' of {label(link)} is not defined",
            material,
            attribute="name",
            hint=hint or _definition(name, material.value_span("name")),
            fix=fix,
        )


def _definition(name: str, span: Span) -> str:
    """Return how to give a material that is not defined its color."""
    rgba = _COLORS.get(name.casefold(), "0.8 0.8 0.8 1")
    defined = f"define it: `material/name={name}:` with `color/rgba={rgba}:` in it"
    return defined if is_attribute(span) else f"write `color: {rgba}` in its place, or {defined}"


_COLORS = {
    "black": "0 0 0 1",
    "blue": "0 0 1 1",
    "gray": "0.5 0.5 0.5 1",
    "green": "0 1 0 1",
    "grey": "0.5 0.5 0.5 1",
    "orange": "1 0.5 0 1",
    "red": "1 0 0 1",
    "white": "1 1 1 1",
    "yellow": "1 1 0 1",
}


def check_used_material(
    material: Element, children: Children, owner: Element, context: CheckContext
) -> None:
    """Check the material of a visual, and note its name for `check_materials`."""
    if owner is material:
        return  # one of the robot's own, which `check_materials` looks at
    name = attribute_text(material, "name") or ""
    if children:
        context.stage = COLORS
        _check_color(material, context)
        if _is_defined(material):
            context.materials_inside.add(name)
    if name and name not in context.material_uses:
        context.material_uses[name] = (owner, material)


def _is_defined(material: Element) -> bool:
    return child_named(material, "color") is not None or (
        child_named(material, "texture") is not None
    )


def _check_global(material: Element, known: dict[str, Element], context: CheckContext) -> None:
    name = attribute_text(material, "name")
    _check_color(material, context)
    if name is None:
        return
    if not name.strip():
        context.report(
            "bad-name",
            "the name of a material is empty, so no visual can refer to it",
            material,
            attribute="name",
            hint="write a name that describes it, such as dark_grey",
            severity=WARNING,
        )
        return
    first = known.get(name)
    if first is not None:
        context.report(
            "duplicate-material",
            f"there are two materials named '{name}'",
            material,
            attribute="name",
            hint="define it once, and refer to it by its name",
            notes=(f"first defined at {first.value_span('name').place()}",),
            among=(first, material),
        )
        return
    known[name] = material
    if not _is_defined(material):
        context.report(
            "missing-element",
            f"material '{name}' has neither a color nor a texture",
            material,
            hint="add `color/rgba=0.8 0.8 0.8 1:`",
            severity=WARNING,
        )


def _check_color(material: Element, context: CheckContext) -> None:
    color = child_named(material, "color")
    if color is None:
        return
    rgba = context.numbers.row(color, "rgba", 4)
    if not rgba or all(0 <= part <= 1 for part in rgba):
        return
    from ..fixes import renumbering

    worst = max(rgba, key=lambda part: abs(part - 0.5))
    divided = _divided(rgba)
    context.report(
        "bad-color",
        f"the color of {label(material)} holds {shown(worst)}, but its four numbers go from 0 to 1",
        color,
        attribute="rgba",
        hint="write red green blue alpha, such as `0.8 0.8 0.8 1`"
        if divided is None
        else f"divide by 255: `{divided}`",
        fix=None if divided is None else renumbering(color.value_span("rgba"), divided),
    )


def _divided(rgba: tuple[float, ...]) -> str | None:
    """Return a color that goes from 0 to 255 as one from 0 to 1; None if it does not."""
    if min(rgba) < 0 or max(rgba) > 255 or max(rgba) < 2:
        return None
    alpha = rgba[3] if rgba[3] <= 1 else rgba[3] / 255
    return " ".join(f"{part:.3g}" for part in (*(part / 255 for part in rgba[:3]), alpha))
