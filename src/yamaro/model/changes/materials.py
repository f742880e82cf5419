"""What differs between materials, and between the looks of two visuals.

The name of a material that is made of a colour in a visual, `base_color`, means nothing: the colour
is compared where it is used.
"""

from __future__ import annotations

from .change import RENAMED, Change
from .context import Owner

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..link import Material, Visual
    from ..robot import Robot
    from .context import Comparing

MADE = "_color"
"""How the name of a material ends that is made of a colour; see `robot/link.py`."""


def is_made_of_color(name: str, robot: Robot) -> bool:
    """Return whether a material has no name of its own: none, or that of a link's colour."""
    stem, ending, number = name.rpartition(MADE)
    is_numbered = not number or (number[0] == "_" and number[1:].isdigit())
    return not name or (bool(ending) and is_numbered and stem in robot.links)


def compare_materials(comparing: Comparing) -> None:
    """Note in what the definitions of materials differ."""
    first, second = _named(comparing.first), _named(comparing.second)
    removed = [name for name in first if name not in second]
    added = [name for name in second if name not in first]
    for name in removed.copy():
        twin = next((n for n in added if _look(first[name]) == _look(second[n])), None)
        if twin is not None:
            removed.remove(name)
            added.remove(twin)
            one, other = first[name], second[twin]
            comparing.changes.append(
                Change(RENAMED, "material", name, new_name=twin, first=one.span, second=other.span)
            )
    for name, material in first.items():
        if name in removed:
            comparing.add(
                "material", name, is_new=False, value=look_text(material), place=material.span
            )
        elif name in second:
            other = second[name]
            owner = Owner("material", name, new_name=None, places=(material.span, other.span))
            _compare_look(material, other, "", owner, comparing)
    for name in added:
        material = second[name]
        comparing.add("material", name, is_new=True, value=look_text(material), place=material.span)


def _named(robot: Robot) -> dict[str, Material]:
    return {
        name: material
        for name, material in robot.materials.items()
        if not is_made_of_color(name, robot)
    }


def compare_looks(
    one: Visual, other: Visual, what: str, owner: Owner, comparing: Comparing
) -> None:
    """Compare how two visuals look."""
    first, second = comparing.first.material_of(one), comparing.second.material_of(other)
    if first is second:
        return
    places = (
        one.material.span if one.material is not None else one.span,
        other.material.span if other.material is not None else other.span,
    )
    names = (first.name if first else "", second.name if second else "")
    is_made = (
        is_made_of_color(names[0], comparing.first),
        is_made_of_color(names[1], comparing.second),
    )
    if not any(is_made):
        if names[0] != names[1] and not _is_renamed(names, comparing):
            remark = "with the same look" if _look(first) == _look(second) else ""
            comparing.change(owner, f"{what}.material", *names, remark=remark, places=places)
        return
    before, after = (
        look_text(material) if made else (material.name if material else None)
        for material, made in zip((first, second), is_made, strict=True)
    )
    if not all(is_made):
        comparing.change(owner, f"{what}.material", before, after, places=places)
        return
    _compare_look(first, second, f"{what}.", owner, comparing)


def _is_renamed(names: tuple[str, str], comparing: Comparing) -> bool:
    """Return whether a material was renamed, which is noted with the materials."""
    return any(
        change.kind == RENAMED and (change.name, change.new_name) == names
        for change in comparing.changes
        if change.of == "material"
    )


def _compare_look(
    one: Material | None, other: Material | None, what: str, owner: Owner, comparing: Comparing
) -> None:
    """Compare colours and textures."""
    colors = (one.color if one else None, other.color if other else None)
    comparing.row(owner, f"{what}color", colors)
    textures = (one.texture if one else None, other.texture if other else None)
    if textures[0] is not None and textures[1] is not None:
        assert one is not None and other is not None
        comparing.file(owner, f"{what}texture", (textures[0], textures[1]), (one.span, other.span))
    elif textures[0] != textures[1]:
        comparing.change(owner, f"{what}texture", *textures)


def _look(material: Material | None) -> object:
    return None if material is None else (material.color, material.texture)


def look_text(material: Material | None) -> object:
    """Return a colour and a texture, as they are shown."""
    if material is None:
        return None
    color = "" if material.color is None else " ".join(f"{c:.6g}" for c in material.color)
    return " ".join(text for text in (color, material.texture or "") if text) or None
