"""The places in one file that mean what is under the cursor."""

from __future__ import annotations

from .references import places_at

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .wire import Json
    from .workspace import Workspace

_READ, _WRITE = 2, 3


def answer(workspace: Workspace, parameters: Json) -> Json:
    """Return the places with how each is meant: read or written."""
    text = workspace.text_at(parameters)
    found = places_at(workspace, text, workspace.offset_in(text, parameters))
    return [
        {"range": workspace.range(span), "kind": _WRITE if declares else _READ}
        for span, declares in found
        if span.source.path == text.path
    ]
