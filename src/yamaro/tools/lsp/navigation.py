"""Definitions, references and links: from a name to the places that mean the same."""

from __future__ import annotations

import os
import re

from ...source import Source, Span
from ...yaml.nodes import MappingNode, ScalarNode, SequenceNode
from .bindings import Place, Program
from .contexts import span_inside, word_of
from .parts import Named, Reference
from .protocol import path_of, uri_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ...yaml.nodes import YamlNode
    from .protocol import Json
    from .workspace import Text, Workspace

_ALIAS = re.compile(r"(?<![\w$)\]'\"])\*([^\s,\[\]{}]+)")


def definition(workspace: Workspace, parameters: Json) -> Json:
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
    if found:
        return found
    for result in workspace.results_of(text.path):  # where the last build made it: computed names
        robot = result.robot
        if robot is None:
            continue
        for name in (part.name, f"{part.name}_link"):
            for each in (robot.links.get(name), robot.joints.get(name)):
                if each is not None and each.span.source.path:
                    return [each.span]
    return []


# --- references -------------------------------------------------------------------------------


def references(workspace: Workspace, parameters: Json) -> Json:
    """Return the places, with the declaration if that is asked for."""
    text = workspace.text_at(parameters)
    offset = workspace.offset_in(text, parameters)
    is_whole = bool((parameters.get("context") or {}).get("includeDeclaration", True))
    found = places_at(workspace, text, offset)
    return [workspace.location(span) for span, declares in found if is_whole or not declares]


def places_at(workspace: Workspace, text: Text, offset: int) -> list[tuple[Span, bool]]:
    """Return the places that mean what is at an offset, and whether each declares it."""
    if not text.is_yaml:
        from .robot_xml import places_in_robot

        return places_in_robot(workspace, text, offset)
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
        own = [
            (each.span, True)
            for each in text.parts.named
            if each.name is not None and names & {each.name, each.link, each.joint}
        ]
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


def is_written(place: Place) -> bool:
    """Return whether a place sets what it names."""
    return place.declaration is not None or (place.use is not None and place.use.is_assigned)


_READ, _WRITE = 2, 3


def highlights(workspace: Workspace, parameters: Json) -> Json:
    """Return the places with how each is meant: read or written."""
    text = workspace.text_at(parameters)
    found = places_at(workspace, text, workspace.offset_in(text, parameters))
    return [
        {"range": workspace.range(span), "kind": _WRITE if declares else _READ}
        for span, declares in found
        if span.source.path == text.path
    ]


# --- paths of files ---------------------------------------------------------------------------


_FILENAME = re.compile(r"(?:[/,]\s*)(?:filename|path)\s*:?=\s*['\"]?([^,'\"]*[^,'\"\s])")
_PATH_KEYS = ("include", "path", "texture", "filename")


class PathPlace:
    """A path in a file, and the file that it means."""

    __slots__ = ("path", "span")

    def __init__(self, path: str, span: Span) -> None:
        self.path = path
        self.span = span


def paths_in(workspace: Workspace, text: Text) -> list[PathPlace]:
    """Return the paths in a file whose files are there."""
    if not text.is_yaml:
        from .xml_names import files_named_in

        resolutions = files_named_in(workspace, text)
    else:
        written = _written(text.root, [], set())
        resolutions = [(workspace.resolve(text, path), span) for path, span in written]
    found = []
    for resolved, span in resolutions:
        if resolved is not None and os.path.isfile(resolved):
            found.append(PathPlace(resolved, span))
    return found


def _written(node: YamlNode | None, path: list[str], seen: set[int]) -> Iterator[tuple[str, Span]]:
    """Yield the paths that are written in a file, with their places."""
    if node is None or isinstance(node, ScalarNode) or id(node) in seen:
        return
    seen.add(id(node))
    if isinstance(node, SequenceNode):
        for item in node.items:
            yield from _written(item, path, seen)
        return
    for key, value in node.pairs:
        word = word_of(key.text)
        if "=" in key.text:
            for found in _FILENAME.finditer(key.text):
                yield found[1], key.span(found.start(1), found.end(1))
        if isinstance(value, ScalarNode):
            is_mesh = word == "geometry" and "." in value.text
            if (word in _PATH_KEYS or is_mesh) and value.text:
                yield value.text.strip(), span_inside(value)
            elif word == "import":
                yield from _modules(value)
        elif word == "import" and isinstance(value, SequenceNode):
            for item in value.items:
                if isinstance(item, ScalarNode):
                    yield from _modules(item)
        if isinstance(value, (MappingNode, SequenceNode)):
            yield from _written(value, [*path, word], seen)


def _modules(node: ScalarNode) -> Iterator[tuple[str, Span]]:
    """Yield the file of the module that an import names, if it were beside the file."""
    words = node.text.split()
    name = words[1] if words[:1] == ["from"] and len(words) > 1 else "".join(words[:1])
    if name.replace(".", "").isidentifier():
        at = node.text.find(name)
        yield name.replace(".", "/") + ".py", node.span(at, at + len(name))


def document_links(workspace: Workspace, parameters: Json) -> Json:
    """Return the links whose files are there."""
    text = workspace.text_at(parameters)
    return [
        {"range": workspace.range(each.span), "target": uri_of(each.path)}
        for each in paths_in(workspace, text)
    ]


_PACKAGE = re.compile(r"(?:package://|\$\(find(?:-pkg-share)?\s+)([A-Za-z0-9_-]+)")


def main_file(workspace: Workspace, parameters: Json) -> Json:
    """Return the main file of the program that a file is in, and what a command is to be given.

    These are the arguments that the user has set, those without which there is no robot, and the
    folders of the packages that are named.
    """
    path = path_of(parameters["textDocument"]["uri"])
    mains = workspace.mains_of(path)
    main = next((each for each in mains if each in workspace.good), mains[0])
    names = {name for text in workspace.program_of(path) for name in _PACKAGE.findall(text.text)}
    packages = workspace.settings.all_packages
    supplied = workspace.good[main].supplied if main in workspace.good else []
    words = [*workspace.settings.arguments_of(main), *supplied]
    for name in sorted(names & packages.keys()):
        words += ["--package", f"{name}:={packages[name]}"]
    return {"main": main, "words": words}


def file_text(workspace: Workspace, parameters: Json) -> Json:
    """Return the text, without a byte order mark."""
    return workspace.text_at(parameters).text
