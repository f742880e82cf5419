"""Inlay hints, which the user turns on: values behind variables, masses behind parts."""

from __future__ import annotations

from ...syntax.nodes import Constant, VariableEntry
from .hover import values_set
from .positions import offset_at
from .robots import links_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .texts import Text
    from .wire import Json
    from .workspace import Workspace

LONGEST = 40


def answer(workspace: Workspace, parameters: Json) -> Json:
    """Return the hints in a range."""
    text = workspace.text_at(parameters)
    if not workspace.settings.has_hints or not text.is_yaml:
        return []
    asked = parameters["range"]
    start = offset_at(text.source, asked["start"], workspace.encoding)
    end = offset_at(text.source, asked["end"], workspace.encoding)
    found = [*_values(workspace, text), *_masses(workspace, text)]
    return [
        {"position": workspace.position(text, at), "label": label, "paddingLeft": True}
        for at, label in found
        if start <= at <= end
    ]


def _line_end(text: Text, offset: int) -> int:
    line, _ = text.source.location(offset)
    return text.source.line_starts()[line - 1] + len(text.source.line_text(line).rstrip())


def _values(workspace: Workspace, text: Text) -> list[tuple[int, str]]:
    """Return the values of variables that are computed, as they were in the last build."""
    found = []
    for declared in text.names.declarations:
        node = declared.node
        if not isinstance(node, VariableEntry) or isinstance(node.values[0], Constant):
            continue
        values: dict[str, None] = {}
        for result in workspace.results_of(text.path):
            values.update(values_set(result, text, declared))
        if values:
            label = ", ".join(values)
            label = label if len(label) <= LONGEST else f"{label[: LONGEST - 1]}…"
            found.append((_line_end(text, node.span.start), f"= {label}"))
    return found


def _masses(workspace: Workspace, text: Text) -> list[tuple[int, str]]:
    found = []
    for part in text.parts.named:
        masses = dict.fromkeys(
            f"{link.mass:.4g} kg" for _, link in links_of(workspace, text, part) if link.mass
        )
        if masses:
            found.append((_line_end(text, part.span.start), ", ".join(list(masses)[:3])))
    return found
