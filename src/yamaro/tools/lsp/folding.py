"""The stretches of a file that an editor can fold: what is under a key, and comments."""

from __future__ import annotations

from ...yaml.nodes import pairs_below

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .texts import Text
    from .wire import Json
    from .workspace import Workspace

MOST = 5_000


def answer(workspace: Workspace, parameters: Json) -> Json:
    """Return the stretches as lines, from 0."""
    text = workspace.text_at(parameters)
    if not text.is_yaml:
        from .xml_names import elements_in

        stretches = {
            (_line(text, each.span.start), _line(text, child.span.end))
            for each in elements_in(text.xml)
            for child in each.elements()[-1:]
        }
        kinds = dict.fromkeys(stretches, "region")
    else:
        kinds = dict.fromkeys(_keys(text), "region")
        kinds.update(dict.fromkeys(_comments(text), "comment"))
    found = sorted((start, end) for start, end in kinds if end > start)[:MOST]
    return [
        {"startLine": start, "endLine": end, **_kind(kinds[start, end])} for start, end in found
    ]


def _kind(kind: str) -> Json:
    return {"kind": kind} if kind == "comment" else {}


def _line(text: Text, offset: int) -> int:
    return text.source.location(offset)[0] - 1


def _keys(text: Text) -> list[tuple[int, int]]:
    found = []
    for key, value in pairs_below(text.root):
        end = value.end
        while end > key.end and text.text[end - 1 : end].isspace():
            end -= 1
        found.append((_line(text, key.start), _line(text, max(key.start, end - 1))))
    return found


def _comments(text: Text) -> list[tuple[int, int]]:
    """Return the stretches of lines that hold nothing but comments."""
    found = []
    start = -1
    lines = text.text.splitlines()
    for number, line in enumerate([*lines, ""]):
        if line.lstrip().startswith("#"):
            start = number if start < 0 else start
        elif start >= 0:
            found.append((start, number - 1))
            start = -1
    return found
