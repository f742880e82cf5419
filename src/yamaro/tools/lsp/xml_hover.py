"""What is shown of names in URDF and xacro files."""

from __future__ import annotations

from ...source import Span
from .parts import Reference
from .robots import part_lines
from .xml_names import definitions_in_xml, elements_in, is_in_expression, word_at

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...xml.tree import Element
    from .texts import Text
    from .workspace import Workspace


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
            return [f"```xml\n{_tag(element)}\n```"]
    return []


def _tag(element: Element) -> str:
    attributes = "".join(f' {name}="{value}"' for name, value in element.attributes.items())
    return f"<{element.name}{attributes}>"
