"""The language server: `yamaro lsp`."""

from __future__ import annotations

from importlib import import_module

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from .protocol import Json
    from .workspace import Workspace

FEATURES = {
    "textDocument/documentSymbol": ("outline", "document_symbols"),
    "textDocument/definition": ("navigation", "definition"),
    "textDocument/references": ("navigation", "references"),
    "textDocument/documentHighlight": ("navigation", "highlights"),
    "textDocument/prepareRename": ("edits", "rename_range"),
    "textDocument/rename": ("edits", "rename"),
    "textDocument/hover": ("hover", "hover"),
    "textDocument/completion": ("completion", "completion"),
    "textDocument/signatureHelp": ("completion", "signature_help"),
    "textDocument/documentLink": ("navigation", "document_links"),
    "textDocument/foldingRange": ("outline", "folding_ranges"),
    "textDocument/semanticTokens/full": ("outline", "semantic_tokens"),
    "textDocument/inlayHint": ("hover", "inlay_hints"),
    "textDocument/codeAction": ("edits", "code_actions"),
    "textDocument/formatting": ("edits", "formatting"),
    "yamaro/viewFileText": ("navigation", "file_text"),
    "yamaro/main": ("navigation", "main_file"),
}
"""The requests that a feature answers: the module, and the function in it."""


def feature(method: str) -> Callable[[Workspace, Json], Json]:
    """Return the function that answers a request; what it imports is loaded now."""
    module, name = FEATURES[method]
    function: Callable[[Workspace, Json], Json] = getattr(
        import_module(f".{module}", __package__), name
    )
    return function
