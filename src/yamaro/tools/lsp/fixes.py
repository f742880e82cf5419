"""Quick fixes: the changes that diagnostics propose."""

from __future__ import annotations

from .findings import diagnostic_json, diagnostics_of
from .positions import offset_at
from .rename import workspace_edit
from .uris import path_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .wire import Json
    from .workspace import Workspace


def answer(workspace: Workspace, parameters: Json) -> Json:
    """Return the fixes of the diagnostics in a range; one that is certain is preferred."""
    text = workspace.text_at(parameters)
    path = path_of(parameters["textDocument"]["uri"])
    asked = parameters["range"]
    start = offset_at(text.source, asked["start"], workspace.encoding)
    end = offset_at(text.source, asked["end"], workspace.encoding)
    only = (parameters.get("context") or {}).get("only")
    if only and not any(kind in ("", "quickfix") for kind in only):
        return []
    actions = []
    for found in diagnostics_of(workspace, path):
        fix, span = found.fix, found.span
        if fix is None or span.end < start or span.start > end:
            continue
        edits = [(edit.span, edit.text) for edit in fix.edits]
        actions.append(
            {
                "title": fix.title,
                "kind": "quickfix",
                "diagnostics": [diagnostic_json(workspace, found, path)],
                "isPreferred": fix.is_safe,
                "edit": workspace_edit(workspace, edits),
            }
        )
    return actions
