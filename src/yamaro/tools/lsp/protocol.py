"""The Language Server Protocol: messages, addresses, positions, and the server's capabilities."""

from __future__ import annotations

import json
import os
from bisect import bisect_left
from functools import lru_cache

TYPE_CHECKING = False
if TYPE_CHECKING:
    from io import BufferedReader
    from typing import Any

    from ...source import Source

    Json = Any
    """A value that JSON can hold."""

LONGEST_MESSAGE = 256 << 20
"""Bytes of a message; a longer one is not from an editor."""

PARSE_ERROR, INVALID_REQUEST, METHOD_NOT_FOUND = -32700, -32600, -32601
INVALID_PARAMS, INTERNAL_ERROR, NOT_INITIALIZED = -32602, -32603, -32002
REQUEST_FAILED = -32803


class BrokenMessage(Exception):
    """What was read is not JSON; the next message can be read nevertheless."""


class RequestFailed(Exception):
    """A request that has no result, with the reason to show; not a fault of the server."""

    def __init__(self, reason: str, code: int = REQUEST_FAILED) -> None:
        super().__init__(reason)
        self.code = code


class Wire:
    """The connection to an editor. One thread reads; all others may write through the server."""

    def __init__(self, reader: BufferedReader, writer: int) -> None:
        """Read from a file in bytes, and write to a descriptor."""
        self._reader = reader
        self._writer = writer

    def read(self) -> Json | None:
        """Return the next message, or None at the end of the input.

        Raises:
            BrokenMessage: it is not JSON.
        """
        length = -1
        while True:
            line = self._reader.readline(4096)
            if not line:
                return None
            name, colon, value = line.partition(b":")
            if not colon and not line.strip():
                if length < 0:
                    continue
                break
            if name.strip().lower() == b"content-length" and value.strip().isdigit():
                length = int(value)
                if length > LONGEST_MESSAGE:
                    return None
        data = self._reader.read(length)
        if len(data) < length:
            return None
        try:
            return json.loads(data)
        except (ValueError, RecursionError) as error:
            raise BrokenMessage(str(error)) from None

    def write(self, message: Json) -> None:
        """Send a message; raise OSError if the editor is gone."""
        data = json.dumps({"jsonrpc": "2.0", **message}, separators=(",", ":")).encode()
        rest = memoryview(b"Content-Length: %d\r\n\r\n%b" % (len(data), data))
        while rest:
            rest = rest[os.write(self._writer, rest) :]


# --- addresses --------------------------------------------------------------------------------


_KEPT = frozenset(b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/")


def path_of(uri: str) -> str:
    """Return the path that a URI means; one of another scheme is returned as it is."""
    scheme, separator, rest = uri.partition("://")
    if scheme.lower() != "file" or not separator:
        return uri
    slash = rest.find("/")
    host, path = (rest[:slash], rest[slash:]) if slash >= 0 else (rest, "/")
    path = _unquoted(path)
    if os.name == "nt":
        if path[2:3] == ":":  # /c:/robots
            path = path[1:]
        if host and host != "localhost":
            path = f"//{host}{path}"
        return os.path.normcase(os.path.normpath(path))
    return os.path.normpath(path)


def uri_of(path: str) -> str:
    """Return the URI of a path."""
    if "://" in path:
        return path
    if os.name == "nt":
        path = path.replace("\\", "/")
        if path[1:2] == ":":
            path = f"/{path}"
    quoted = [
        chr(byte) if byte in _KEPT else f"%{byte:02X}" for byte in path.encode("utf-8", "replace")
    ]
    return "file://" + "".join(quoted)


def is_file(uri: str) -> bool:
    """Return whether a URI means a file on the disk."""
    return uri[:7].lower() == "file://"


def _unquoted(text: str) -> str:
    if "%" not in text:
        return text
    pieces = text.encode("utf-8", "replace").split(b"%")
    data = pieces[0]
    for piece in pieces[1:]:
        try:
            data += bytes([int(piece[:2], 16)]) + piece[2:]
        except ValueError:
            data += b"%" + piece
    return data.decode("utf-8", "replace")


# --- positions --------------------------------------------------------------------------------


UTF_16, UTF_32 = "utf-16", "utf-32"
"""The encodings that columns may be counted in; UTF-32 counts characters, as spans do."""


def agreed_encoding(offered: Json) -> str:
    """Return the encoding to use with an editor that offers some, or nothing."""
    return UTF_32 if isinstance(offered, list) and UTF_32 in offered else UTF_16


def offset_at(source: Source, position: Json, encoding: str) -> int:
    """Return the offset of a position; one behind the end of a line means its end.

    Raises:
        KeyError, TypeError: it is not a position.
    """
    line, character = int(position["line"]), int(position["character"])
    starts = source.line_starts()
    if line < 0 or character < 0:
        return 0
    if line >= len(starts):
        return len(source.text)
    start = starts[line]
    text = source.line_text(line + 1)
    if encoding == UTF_16 and not text.isascii():
        character = _characters(text, character)
    return start + min(character, len(text))


def _characters(text: str, units: int) -> int:
    """Return how many characters of a text the first `units` of UTF-16 are."""
    for index, char in enumerate(text):
        if units <= 0:
            return index
        units -= 2 if char > "\uffff" else 1
    return len(text)


def position_at(source: Source, offset: int, encoding: str) -> Json:
    """Return the position of an offset."""
    offset = max(0, min(offset, len(source.text)))
    line, column = source.location(offset)
    length, wide = _measured(source, line)
    column = min(column - 1, length)
    if encoding == UTF_16:
        column += bisect_left(wide, column)
    return {"line": line - 1, "character": column}


@lru_cache(maxsize=16)
def _measured(source: Source, line: int) -> tuple[int, list[int]]:
    """Return the length of a line, and where it has characters of two units of UTF-16.

    It is kept, since a robot can be one line, with thousands of elements to show.
    """
    text = source.line_text(line)
    if text.isascii():
        return len(text), []
    return len(text), [index for index, char in enumerate(text) if char > "\uffff"]


def width(text: str, encoding: str) -> int:
    """Return how many columns a text has."""
    if encoding == UTF_32 or text.isascii():
        return len(text)
    return len(text) + sum(char > "\uffff" for char in text)


def range_of(source: Source, start: int, end: int, encoding: str) -> Json:
    """Return the range of a stretch."""
    return {
        "start": position_at(source, start, encoding),
        "end": position_at(source, end, encoding),
    }


# --- capabilities -----------------------------------------------------------------------------


TYPES = ("variable", "parameter", "function", "namespace", "class")
MODIFIERS = ("declaration",)
"""Types and modifiers of semantic tokens, in the order of their numbers."""
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
        "completionProvider": {"triggerCharacters": list(' :/.($=,{<"')},
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
