"""Where what is under the cursor is defined."""

from __future__ import annotations

import re

from ...source import Source, Span
from .bindings import Program
from .parts import Named, Reference
from .paths import paths_in

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .texts import Text
    from .wire import Json
    from .workspace import Workspace

_ALIAS = re.compile(r"(?<![\w$)\]'\"])\*([^\s,\[\]{}]+)")


def answer(workspace: Workspace, parameters: Json) -> Json:
    """Return the places of the definition, none if it is not known."""
    text = workspace.text_at(parameters)
    offset = workspace.offset_in(text, parameters)
    spans = definitions_at(workspace, text, offset)
    return [workspace.location(span) for span in spans]


def definitions_at(workspace: Workspace, text: Text, offset: int) -> list[Span]:
    """Return where what is at an offset is defined."""
    if not text.is_yaml:
        from .xml_names import definitions_in_xml

        spans = definitions_in_xml(workspace, text, offset)
    else:
        spans = _in_yaml(workspace, text, offset)
    seen = {span.key(): span for span in spans}
    return list(seen.values())


def _in_yaml(workspace: Workspace, text: Text, offset: int) -> list[Span]:
    anchor = _anchor(text, offset)
    if anchor is not None:
        return [anchor]
    program = Program(workspace, text.path)
    place = program.at(text, offset)
    if place is not None:
        found = program.declarations(place)
        if found:
            return [each.span for each in found]
    for path in paths_in(workspace, text):
        if path.span.start <= offset <= path.span.end:
            return [Span(Source("", name=path.path, path=path.path), 0, 0)]
    part = text.parts.at(offset)
    return parts_named(workspace, text, part) if part is not None else []


def _anchor(text: Text, offset: int) -> Span | None:
    """Return the anchor that an alias at an offset means."""
    start = text.text.rfind("\n", 0, offset) + 1
    end = text.text.find("\n", offset)
    line = text.text[start : end if end >= 0 else len(text.text)]
    for found in _ALIAS.finditer(line):
        if found.start() <= offset - start <= found.end():
            at = text.text.rfind(f"&{found[1]}", 0, start + found.start())
            following = text.text[at + len(found[1]) + 1 : at + len(found[1]) + 2]
            if at >= 0 and (not following or following.isspace()):
                return Span(text.source, at, at + len(found[1]) + 1)
    return None


def parts_named(workspace: Workspace, text: Text, part: Named | Reference) -> list[Span]:
    """Return where the parts, links and frames of a name are, in all files of the program."""
    if isinstance(part, Named):
        return [part.span]
    if part.is_computed:
        return []
    found = []
    for other in Program(workspace, text.path).texts:
        own = [each for each in other.parts.named if each.answers_to(part.name)]
        exact = [each for each in own if each.name != part.name or each.kind != "part"]
        found += [each.span for each in exact or own]
    return found or _in_robots(workspace, text, part.name)


def _in_robots(workspace: Workspace, text: Text, name: str) -> list[Span]:
    """Return where a link or joint of the last build was made, for names that are computed."""
    spans: list[Span] = []
    for result in workspace.results_of(text.path):
        robot = result.robot
        if robot is None:
            continue
        for known in (name, f"{name}_link"):
            link, joint = robot.links.get(known), robot.joints.get(known)
            for each in (link, joint):
                if each is not None and each.span.source.path and not spans:
                    spans.append(each.span)
    return spans
