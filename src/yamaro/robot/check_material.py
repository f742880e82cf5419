"""Check of the materials: colours in range, names that are defined, and defined once."""

from __future__ import annotations

from ..xmltree import Element
from .check_context import CheckContext, attribute_text, child_named, label, shown


def check_materials(materials: list[Element], links: list[Element], context: CheckContext) -> None:
    """Check the robot's own materials and those in the visuals of its links."""
    known: dict[str, Element] = {}
    for material in materials:
        _check_global(material, known, context)
    uses = list(_materials_of(links))
    inline: set[str] = set()
    for _, material in uses:
        _check_color(material, context)
        if _is_defined(material):
            inline.add(attribute_text(material, "name") or "")
    told: set[str] = set()
    for link, material in uses:
        name = attribute_text(material, "name")
        if not name or name in known or name in inline or name in told:
            continue
        told.add(name)
        context.warn(
            "unknown-material",
            f"the material '{name}' of {label(link)} is not defined",
            material,
            attribute="name",
            hint=context.near(name, [*known, *sorted(inline)])
            or f"define it: `material/name={name}:` with `color/rgba=0.8 0.8 0.8 1:` in it",
        )


def _materials_of(links: list[Element]) -> list[tuple[Element, Element]]:
    """Return the materials of the visuals, each with its link."""
    found = []
    for link in links:
        for visual in link.children:
            if isinstance(visual, Element) and visual.name == "visual":
                material = child_named(visual, "material")
                if material is not None:
                    found.append((link, material))
    return found


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
        context.warn(
            "bad-name",
            "the name of a material is empty, so no visual can refer to it",
            material,
            attribute="name",
            hint="name it by its look, as in dark_grey",
        )
        return
    first = known.setdefault(name, material)
    if first is not material:
        context.warn(
            "duplicate-material",
            f"there are two materials named '{name}'",
            material,
            attribute="name",
            hint="define it once, and refer to it by its name",
            notes=(f"first defined at {first.value_span('name').place()}",),
        )
        return
    if not _is_defined(material):
        context.warn(
            "missing-element",
            f"material '{name}' has neither a color nor a texture",
            material,
            hint="add `color/rgba=0.8 0.8 0.8 1:`",
        )


def _check_color(material: Element, context: CheckContext) -> None:
    color = child_named(material, "color")
    if color is None:
        return
    rgba = context.numbers(color, "rgba", 4)
    if not rgba or all(0 <= part <= 1 for part in rgba):
        return
    worst = max(rgba, key=lambda part: abs(part - 0.5))
    context.warn(
        "bad-color",
        f"the color of {label(material)} holds {shown(worst)}, but its four numbers go from 0 to 1",
        color,
        attribute="rgba",
        hint=_color_hint(rgba),
    )


def _color_hint(rgba: tuple[float, ...]) -> str:
    if min(rgba) < 0 or max(rgba) > 255 or max(rgba) < 2:
        return "write red green blue alpha, such as `0.8 0.8 0.8 1`"
    alpha = rgba[3] if rgba[3] <= 1 else rgba[3] / 255
    parts = [*(part / 255 for part in rgba[:3]), alpha]
    return f"divide by 255: `{' '.join(f'{part:.3g}' for part in parts)}`"
