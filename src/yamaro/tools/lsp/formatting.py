"""Formatting: what `yamaro fmt` makes of a file, as edits of the lines that differ."""

from __future__ import annotations

from ...diagnostics import YamaroError
from ..format.formatting import LayoutFault, formatted
from .wire import RequestFailed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .texts import Text
    from .wire import Json
    from .workspace import Workspace


def answer(workspace: Workspace, parameters: Json) -> Json:
    """Return the edits; raise RequestFailed for a file that is not YAML."""
    text = workspace.text_at(parameters)
    if not text.is_yaml:
        raise RequestFailed("only YAML files are formatted")
    if not text.text.strip():  # each editor formats when it saves, also a file that just begins
        return []
    try:
        new = formatted(text.source)
    except YamaroError as error:
        first = error.diagnostics[0]
        line, _ = first.span.location()
        raise RequestFailed(f"line {line}: {first.message}") from None
    except LayoutFault as error:
        raise RequestFailed(str(error)) from None
    return _edits(workspace, text, new)


def _edits(workspace: Workspace, text: Text, new: str) -> list[Json]:
    """Return an edit for each stretch of lines that differ, so that the cursor stays."""
    from difflib import SequenceMatcher

    old_lines, new_lines = text.text.splitlines(keepends=True), new.splitlines(keepends=True)
    starts = [0]
    for line in old_lines:
        starts.append(starts[-1] + len(line))
    if len(old_lines) == len(new_lines):  # the usual case, for which no search is needed
        changed = [
            (i, i + 1, i, i + 1)
            for i, (old, other) in enumerate(zip(old_lines, new_lines, strict=True))
            if old != other
        ]
    else:
        matcher = SequenceMatcher(None, old_lines, new_lines, autojunk=False)
        changed = [codes[1:] for codes in matcher.get_opcodes() if codes[0] != "equal"]
    return [
        {
            "range": {
                "start": workspace.position(text, starts[first]),
                "end": workspace.position(text, starts[last]),
            },
            "newText": "".join(new_lines[other_first:other_last]),
        }
        for first, last, other_first, other_last in changed
    ]
