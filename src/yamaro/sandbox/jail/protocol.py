"""What a jailed child says to its parent: a kind, the length of what follows, and that.

Until it has said READY none but our own code runs in the child; what comes later may be lies.
"""

from __future__ import annotations

import struct

HEADER = struct.Struct("<cQ")
READY = b"R"
NO_JAIL = b"S"
ANSWER = b"A"
MEMORY = b"M"
FAILED = b"E"
OUT_OF_MEMORY = HEADER.pack(MEMORY, 0)
"""Made beforehand: when it is needed there is no memory to make it."""
LONGEST_REASON = 10_000
"""Bytes of each text that says why there is no answer."""
