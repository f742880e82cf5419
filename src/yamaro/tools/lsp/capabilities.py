"""What the server says that it can do."""

from __future__ import annotations

from .token_types import MODIFIERS, TYPES

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .wire import Json

INCREMENTAL = 2


def capabilities(encoding: str) -> Json:
    """Return the capabilities, with columns in that encoding."""
    return {
        "positionEncoding": encoding,
        "textDocumentSync": {
            "openClose": True,
            "change": INCREMENTAL,
            "save": {"includeText": False},
        },
        "documentSymbolProvider": True,
        "definitionProvider": True,
        "referencesProvider": True,
        "documentHighlightProvider": True,
        "renameProvider": {"prepareProvider": True},
        "hoverProvider": True,
        "completionProvider": {"triggerCharacters": list(" :/.($=,{")},
        "signatureHelpProvider": {"triggerCharacters": [":", ","]},
        "documentLinkProvider": {"resolveProvider": False},
        "foldingRangeProvider": True,
        "semanticTokensProvider": {
            "legend": {"tokenTypes": list(TYPES), "tokenModifiers": list(MODIFIERS)},
            "full": True,
            "range": False,
        },
        "inlayHintProvider": True,
        "documentFormattingProvider": True,
        "codeActionProvider": {"codeActionKinds": ["quickfix"]},
    }
