"""All places that mean what is under the cursor."""

from __future__ import annotations

from ...source import Span
from .bindings import Place, Program
from .parts import Named, Reference

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .texts import Text
    from .wire import Json
    from .workspace import Workspace


def answer(workspace: Workspace, parameters: Json) -> Json:
    """Return the places, with the declaration if that is asked for."""
    text = workspace.text_at(parameters)
    offset = workspace.offset_in(text, parameters)
    is_whole = bool((parameters.get("context") or {}).get("includeDeclaration", True))
    found = places_at(workspace, text, offset)
    return [workspace.location(span) for span, declares in found if is_whole or not declares]


def places_at(workspace: Workspace, text: Text, offset: int) -> list[tuple[Span, bool]]:
    """Return the places that mean what is at an offset, and whether each declares it."""
    if not text.is_yaml:
        return []
    program = Program(workspace, text.path)
    place = program.at(text, offset)
    if place is not None:
        return [(each.span, each.declaration is not None) for each in program.places(place)]
    part = text.parts.at(offset)
    return part_places(program, part) if part is not None else []


def part_places(program: Program, part: Named | Reference) -> list[tuple[Span, bool]]:
    """Return where a part is named and where it is referred to, in all files of the program."""
    if part.name is None or (isinstance(part, Reference) and part.is_computed):
        return []
    names = names_of_part(program, part)
    found = []
    for text in program.texts:
        own = [(each.span, True) for each in text.parts.named if _meets(each, names)]
        own += [(each.span, False) for each in text.parts.references if each.name in names]
        found += sorted(own, key=lambda each: each[0].start)
    return found


def names_of_part(program: Program, part: Named | Reference) -> set[str]:
    """Return the names that mean a part: its own, its link's and its joint's."""
    if isinstance(part, Reference):
        every = [named for text in program.texts for named in text.parts.named]
        meant = [named for named in every if named.answers_to(part.name)]
        if not meant:
            return {part.name}
        part = meant[0]
    return {name for name in (part.name, part.link, part.joint) if name is not None}


def _meets(named: Named, names: set[str]) -> bool:
    return named.name is not None and not names.isdisjoint(
        {named.name, named.link, named.joint} - {None}
    )


def is_written(place: Place) -> bool:
    """Return whether a place sets what it names."""
    return place.declaration is not None or (place.use is not None and place.use.is_assigned)
