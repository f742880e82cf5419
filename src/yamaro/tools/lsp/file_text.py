"""The text of a file as the server has it: shows whether it is that of the editor."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .wire import Json
    from .workspace import Workspace


def answer(workspace: Workspace, parameters: Json) -> Json:
    """Return the text, without a byte order mark."""
    return workspace.text_at(parameters).text
