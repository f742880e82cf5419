"""Whether what is under the cursor can be renamed, and which stretch of the text it is."""

from __future__ import annotations

from .rename import Renaming

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .wire import Json
    from .workspace import Workspace


def answer(workspace: Workspace, parameters: Json) -> Json:
    """Return the stretch and its name; raise RequestFailed with the reason if it is fixed."""
    text = workspace.text_at(parameters)
    renaming = Renaming(workspace, text, workspace.offset_in(text, parameters))
    return {"range": workspace.range(renaming.span), "placeholder": renaming.name}
