"""Links to the files that a file names."""

from __future__ import annotations

from .paths import paths_in
from .uris import uri_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .wire import Json
    from .workspace import Workspace


def answer(workspace: Workspace, parameters: Json) -> Json:
    """Return the links whose files are there."""
    text = workspace.text_at(parameters)
    return [
        {"range": workspace.range(each.span), "target": uri_of(each.path)}
        for each in paths_in(workspace, text)
    ]
