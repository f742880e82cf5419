"""`file://` addresses and paths."""

from __future__ import annotations

import os

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
