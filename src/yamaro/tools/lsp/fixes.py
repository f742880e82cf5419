"""Quick fixes: the changes that diagnostics propose."""

from __future__ import annotations

from ...allowances import acceptance
from .findings import diagnostic_json, diagnostics_of
from .positions import offset_at
from .rename import workspace_edit
from .uris import path_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .wire import Json
    from .workspace import Workspace


def answer(workspace: Workspace, parameters: Json) -> Json:
    """Return the fixes of the diagnostics in a range; one that is certain is preferred.

    Those that only accept a finding come last.
    """
    text = workspace.text_at(parameters)
    path = path_of(parameters["textDocument"]["uri"])
    asked = parameters["range"]
    start = offset_at(text.source, asked["start"], workspace.encoding)
    end = offset_at(text.source, asked["end"], workspace.encoding)
    only = (parameters.get("context") or {}).get("only")
    if only and not any(kind in ("", "quickfix") for kind in only):
        return []
    actions: list[Json] = []
    acceptances: list[Json] = []
    for found in diagnostics_of(workspace, path):
        span = found.span
        if span.end < start or span.start > end:
            continue
        for fix in (found.fix, acceptance(found)):
            if fix is None:
                continue
            edits = [(edit.span, edit.text) for edit in fix.edits]
            action = {
                "title": fix.title,
                "kind": "quickfix",
                "diagnostics": [diagnostic_json(workspace, found, path)],
                "isPreferred": fix.is_safe,
                "edit": workspace_edit(workspace, edits),
            }
            (actions if fix is found.fix else acceptances).append(action)
    return [*actions, *acceptances]
