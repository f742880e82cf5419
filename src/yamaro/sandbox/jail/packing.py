"""A list of byte strings as one, whose lengths are checked when it is taken apart."""

from __future__ import annotations

import struct

from .limits import JailAnswerBroken

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

_LENGTH = struct.Struct("<Q")


def pack(parts: Sequence[bytes]) -> bytes:
    """Return byte strings as one, each behind its length."""
    pieces = []
    for part in parts:
        pieces.append(_LENGTH.pack(len(part)))
        pieces.append(part)
    return b"".join(pieces)


def unpack(data: bytes) -> list[bytes]:
    """Return the byte strings that `pack` made one of; `data` may come from an enemy.

    Raises:
        JailAnswerBroken: it was not made by `pack`.
    """
    parts = []
    position = 0
    while position < len(data):
        start = position + _LENGTH.size
        if start > len(data):
            raise JailAnswerBroken("the answer ends within a length")
        (length,) = _LENGTH.unpack_from(data, position)
        if length > len(data) - start:
            raise JailAnswerBroken("a part of the answer is longer than the answer")
        position = start + length
        parts.append(data[start:position])
    return parts
