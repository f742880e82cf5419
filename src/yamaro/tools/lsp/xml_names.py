"""Names in MJCF and SDF files: where they are defined, and their hovers; paths in all XML files."""

from __future__ import annotations

import os
import re

from ...model.values import content, content_span
from ...source import Source, Span
from ...sources.table import source_of
from ...xml.tree import Element
from .parts import Reference, part_lines

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ...xml.tree import Element
    from .workspace import Text, Workspace

_PATHS = (("xacro:include", "filename"), ("mesh", "filename"), ("texture", "filename"))
_MJCF_FILES = ("include", "model")
"""The elements of MJCF whose files are MJCF, beside the file."""
_NAMED_IN_SDF = ("link", "joint", "frame", "model")
_WORD = re.compile(r"[\w.:/-]+")


def elements_in(root: Element | None) -> Iterator[Element]:
    """Return all elements of a tree, in order; none of a file that could not be read."""
    return iter(()) if root is None else root.iter()


def format_of(root: Element | None) -> str:
    """Return "mjcf" or "sdf" for a file of these formats, "" for others."""
    source = source_of(root) if root is not None else None
    return source.name if source is not None else ""


def files_named_in(workspace: Workspace, text: Text) -> list[tuple[str | None, Span]]:
    """Return the files that a file names, where they are known, with the places of the paths."""
    format = format_of(text.xml)
    if format == "mjcf":
        return [(workspace.resolve(text, path), span) for path, span in _files_in_mjcf(text.xml)]
    if format == "sdf":
        return [
            (workspace.resolve(text, content(element) or ""), content_span(element))
            for element in elements_in(text.xml)
            if element.name == "uri"
        ]
    from .robot_xml import loaded_files, path_at

    spans = [
        element.value_span(attribute)
        for element in elements_in(text.xml)
        for name, attribute in _PATHS
        if element.name == name and element.attributes.get(attribute)
    ]
    return [(path_at(workspace, text, span), span) for span in (*spans, *loaded_files(text))]


def includes_in(text: Text) -> list[str]:
    """Return the paths of the files that a file includes."""
    format = format_of(text.xml)
    if format == "sdf":
        included = (each for each in elements_in(text.xml) if each.name == "include")
        uris = (each for one in included for each in one.elements() if each.name == "uri")
        return [(content(each) or "").strip() for each in uris]
    names, attribute = (_MJCF_FILES, "file") if format else (("xacro:include",), "filename")
    return [
        str(element.attributes[attribute])
        for element in elements_in(text.xml)
        if element.name in names and attribute in element.attributes
    ]


def _files_in_mjcf(root: Element | None) -> Iterator[tuple[str, Span]]:
    """Yield the paths in MJCF: those of assets are in the folders that `<compiler>` names."""
    folders: dict[str, str] = {}
    for element in elements_in(root):
        if element.name == "compiler":
            folders |= {
                name: str(element.attributes[name])
                for name in ("assetdir", "meshdir", "texturedir")
                if name in element.attributes
            }
    for element in elements_in(root):
        for attribute in element.attributes:
            if attribute.startswith("file") and element.name != "compiler":
                path = str(element.attributes[attribute])
                if element.name not in _MJCF_FILES:
                    own = "texturedir" if element.name == "texture" else "meshdir"
                    path = os.path.join(folders.get(own, folders.get("assetdir", "")), path)
                yield path, element.value_span(attribute)


def word_at(text: Text, offset: int) -> str:
    """Return the name that an offset is in, or right behind."""
    start = text.text.rfind("\n", 0, offset) + 1
    end = text.text.find("\n", offset)
    line = text.text[start : end if end >= 0 else len(text.text)]
    for found in _WORD.finditer(line):
        if found.start() <= offset - start <= found.end():
            return found[0]
    return ""


def definitions_in_xml(workspace: Workspace, text: Text, offset: int) -> list[Span]:
    """Return where what is at an offset of an XML file is defined."""
    from .navigation import paths_in

    for path in paths_in(workspace, text):
        if path.span.start <= offset <= path.span.end:
            return [Span(Source("", name=path.path, path=path.path), 0, 0)]
    format = format_of(text.xml)
    if not format:
        from .robot_xml import definitions_in_robot

        return definitions_in_robot(workspace, text, offset)
    word = word_at(text, offset)
    if not word:
        return []
    texts = [each for each in workspace.program_of(text.path) if not each.is_yaml]
    if format == "sdf":
        return [span for each in texts for span in _named_in_sdf(each.xml, word)]
    kind, name = _meant_in_mjcf(text.xml, offset)
    return [span for each in texts for span in _named_in_mjcf(each.xml, kind, name)]


def _named_in_sdf(root: Element | None, word: str) -> Iterator[Span]:
    """Yield where a file has the link, joint, frame or model of a name: the last after `::`."""
    name = word.rpartition("::")[2]
    for element in elements_in(root):
        if element.name in _NAMED_IN_SDF and _says(element, "name", name):
            yield element.value_span("name")


def _meant_in_mjcf(root: Element | None, offset: int) -> tuple[str, str]:
    """Return the kind and the name of what an attribute at an offset names, or "" twice."""
    from ...sources.mjcf.references import IN_BODIES
    from ...xml.mjcf_references import kind_in

    for element in elements_in(root):
        kinds = ((attribute, kind_in(element, attribute)) for attribute in element.attributes)
        named = [(attribute, kind) for attribute, kind in kinds if kind is not None]
        named += [("class", "class"), ("childclass", "class")]
        named.append(("name", IN_BODIES.get(element.name, element.name)))
        for attribute, kind in named:
            if attribute in element.attributes:
                span = element.value_span(attribute)
                if span.start <= offset <= span.end:
                    return kind, str(element.attributes[attribute])
    return "", ""


def _named_in_mjcf(root: Element | None, kind: str, name: str) -> Iterator[Span]:
    """Yield where a file has a default class, or a body, joint, asset … of a kind."""
    from ...sources.mjcf.references import IN_BODIES, SECTIONS

    pending = [(each, "") for each in elements_in(root) if each is root]
    while pending:
        element, section = pending.pop()
        if element.name == "default" and kind == "class" and _says(element, "class", name):
            yield element.value_span("class")
        own = (section, element.name, IN_BODIES.get(element.name))
        if element.name != "default" and kind in own and _says(element, "name", name):
            yield element.value_span("name")
        if element.name != "default" or kind == "class":
            inside = SECTIONS.get(element.name, "")
            pending += [(each, inside) for each in reversed(element.elements())]


def _says(element: Element, attribute: str, value: str) -> bool:
    return element.attributes.get(attribute) == value


# --- hovers -----------------------------------------------------------------------------------


def hover_in_xml(workspace: Workspace, text: Text, offset: int) -> tuple[list[str], Span | None]:
    """Return lines of Markdown on what is at an offset, and its place."""
    if not format_of(text.xml):
        from .robot_xml import hover_in_robot

        return hover_in_robot(workspace, text, offset)
    word = word_at(text, offset)
    if not word:
        return [], None
    spans = definitions_in_xml(workspace, text, offset)
    reference = Reference(word, spans[0] if spans else Span(text.source, offset, offset))
    lines = part_lines(workspace, text, reference)
    if not lines:  # a default class, an asset, a frame
        lines = [line for span in spans[:3] for line in _written(workspace, span)]
    return lines, None


def _written(workspace: Workspace, span: Span) -> list[str]:
    """Return the tag that defines a name, as it is written; a default class with what is in it."""
    text = workspace.text_of(span.source.path)
    if text is None:
        return []
    for element in elements_in(text.xml):
        own = "class" if element.name == "default" else "name"
        if own in element.attributes and element.value_span(own).start == span.start:
            tags = [_tag(element)]
            if own == "class":
                inner = element.elements()
                tags += [f"  {_tag(each)}" for each in inner if each.name != "default"][:_MOST_TAGS]
            return ["```xml\n" + "\n".join(tags) + "\n```"]
    return []


_MOST_TAGS = 12


def _tag(element: Element) -> str:
    attributes = "".join(f' {name}="{value}"' for name, value in element.attributes.items())
    return f"<{element.name}{attributes}>"
