"""The language server: `yamaro lsp`."""

from __future__ import annotations

FEATURES = {
    "textDocument/documentSymbol": "symbols",
    "textDocument/definition": "definition",
    "textDocument/references": "references",
    "textDocument/documentHighlight": "highlights",
    "textDocument/prepareRename": "rename_range",
    "textDocument/rename": "rename",
    "textDocument/hover": "hover",
    "textDocument/completion": "completion",
    "textDocument/signatureHelp": "signature_help",
    "textDocument/documentLink": "links",
    "textDocument/foldingRange": "folding",
    "textDocument/semanticTokens/full": "tokens",
    "textDocument/inlayHint": "hints",
    "textDocument/codeAction": "fixes",
    "textDocument/formatting": "formatting",
    "yamaro/viewFileText": "file_text",
}
"""The requests that a feature answers: the module with the function `answer`."""
FEATURE_MODULES = tuple(FEATURES.values())
