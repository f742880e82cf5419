"""Names in URDF and xacro files: where they are defined, and their hovers."""

from __future__ import annotations

import re

from ...source import Source, Span
from ...xacro.symbol_table import ARGUMENT, BLOCK, MACRO, PROPERTY, definition_of
from ...xml.tree import Element
from .parts import Reference, part_lines

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ...xml.tree import Element
    from .workspace import Text, Workspace

_PATHS = (("xacro:include", "filename"), ("mesh", "filename"), ("texture", "filename"))
_NAMED = ("link", "joint", "material")
_WORD = re.compile(r"[\w.:/-]+")
_REFERRING = {("parent", "link"), ("child", "link"), ("mimic", "joint"), ("gazebo", "reference")}


def elements_in(root: Element | None) -> Iterator[Element]:
    """Return all elements of a tree, in order; none of a file that could not be read."""
    return iter(()) if root is None else root.iter()


def written_paths(text: Text) -> list[tuple[str, Span]]:
    """Return the paths that a file names, with their places."""
    return [
        (str(element.attributes[attribute]), element.value_span(attribute))
        for element in elements_in(text.xml)
        for name, attribute in _PATHS
        if element.name == name and attribute in element.attributes
    ]


def includes_in(text: Text) -> list[str]:
    """Return the paths of the files that a xacro file includes."""
    return [
        str(element.attributes["filename"])
        for element in elements_in(text.xml)
        if element.name == "xacro:include" and "filename" in element.attributes
    ]


def word_at(text: Text, offset: int) -> str:
    """Return the name that an offset is in, or right behind."""
    start = text.text.rfind("\n", 0, offset) + 1
    end = text.text.find("\n", offset)
    line = text.text[start : end if end >= 0 else len(text.text)]
    for found in _WORD.finditer(line):
        if found.start() <= offset - start <= found.end():
            return found[0]
    return ""


def is_in_expression(text: Text, offset: int) -> bool:
    """Return whether an offset is in `${…}` or `$(…)`."""
    line = text.text[text.text.rfind("\n", 0, offset) + 1 : offset]
    opened = max(line.rfind("${"), line.rfind("$("))
    return opened >= 0 and not re.search(r"[})]", line[opened:])


def definitions_in_xml(workspace: Workspace, text: Text, offset: int) -> list[Span]:
    """Return where what is at an offset of an XML file is defined."""
    from .navigation import paths_in

    for path in paths_in(workspace, text):
        if path.span.start <= offset <= path.span.end:
            return [Span(Source("", name=path.path, path=path.path), 0, 0)]
    word = word_at(text, offset)
    if not word:
        return []
    texts = [each for each in workspace.program_of(text.path) if not each.is_yaml]
    if is_in_expression(text, offset):
        names = {word, word.split(".")[-1]}
        return [
            span
            for each in texts
            for name, span, kind in defined_in(each)
            if name in names and kind in (PROPERTY, BLOCK, ARGUMENT)
        ]
    tag = word.removeprefix("xacro:").rpartition(":")[2].rpartition(".")[2]
    start = max(text.text.rfind("<", 0, offset), text.text.rfind("</", 0, offset))
    is_tag = start >= 0 and not re.search(r"[\s>]", text.text[start:offset])
    wanted = (MACRO,) if is_tag else _NAMED
    return [
        span
        for each in texts
        for name, span, kind in defined_in(each)
        if name in (word, tag) and kind in wanted
    ]


def defined_in(text: Text) -> Iterator[tuple[str, Span, str]]:
    """Yield what an XML file defines: the name, its place, and what it is."""
    for element in elements_in(text.xml):
        own = definition_of(element)
        if "name" in element.attributes and (own is not None or element.name in _NAMED):
            name = str(element.attributes["name"]) if own is None else own.name
            kind = element.name if own is None else own.kind
            yield name, element.value_span("name"), kind


# --- hovers -----------------------------------------------------------------------------------


def hover_in_xml(workspace: Workspace, text: Text, offset: int) -> tuple[list[str], Span | None]:
    """Return lines of Markdown on what is at an offset, and its place."""
    word = word_at(text, offset)
    if not word:
        return [], None
    spans = definitions_in_xml(workspace, text, offset)
    if is_in_expression(text, offset) or word.startswith("xacro:"):
        lines = [line for span in spans[:3] for line in _written(workspace, span)]
        return lines, None
    from .bindings import Program

    reference = Reference(word, spans[0] if spans else Span(text.source, offset, offset))
    program = Program(workspace, text.path)
    return part_lines(workspace, program, text, reference), None


def _written(workspace: Workspace, span: Span) -> list[str]:
    """Return the tag that defines a name, as it is written."""
    text = workspace.text_of(span.source.path)
    if text is None:
        return []
    for element in elements_in(text.xml):
        if element.value_span("name").start == span.start:
            attributes = "".join(f' {name}="{value}"' for name, value in element.attributes.items())
            return [f"```xml\n<{element.name}{attributes}>\n```"]
    return []
