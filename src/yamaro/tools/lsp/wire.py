"""Messages of the Language Server Protocol: JSON with a header, on a pair of descriptors."""

from __future__ import annotations

import json
import os

TYPE_CHECKING = False
if TYPE_CHECKING:
    from io import BufferedReader
    from typing import Any

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
