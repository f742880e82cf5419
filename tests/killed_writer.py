"""Replaces one file again and again by two versions of it, until the process is killed.

Run as a program, with the name of a way to write and the file: says "ready" and then writes.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

from yamaro.output import write_file

CHUNKS = 400
CHUNK_BYTES = 1 << 16


def chunks_of(version: int) -> list[bytes]:
    """Return a content of 25 MB that tells at each place which version it is of, and which place.

    The second version is longer by one chunk.
    """
    mark = b"<version%d chunk=%03d/>\n"
    lines = CHUNK_BYTES // len(mark % (version, 0)) + 1
    return [(mark % (version, n) * lines)[:CHUNK_BYTES] for n in range(CHUNKS + version)]


def write_in_place(path: str, chunks: Sequence[bytes]) -> None:
    """Write as most programs do."""
    with open(path, "wb") as file:
        file.writelines(chunks)


def write_over(path: str, chunks: Sequence[bytes]) -> None:
    """Write over the old content, and cut off what is left of it in the end."""
    with open(path, "r+b") as file:
        file.writelines(chunks)
        file.truncate()


def rename_too_soon(path: str, chunks: Sequence[bytes]) -> None:
    """Write a temporary file, but let it take the name while its end still waits in a buffer."""
    temporary = f"{path}.tmp"
    with open(temporary, "wb", buffering=CHUNK_BYTES * CHUNKS // 2) as file:
        file.writelines(chunks)
        os.replace(temporary, path)


WAYS = {
    "whole": write_file,
    "in place": write_in_place,
    "over": write_over,
    "too soon": rename_too_soon,
}


def main(way: str, path: str) -> None:
    """Write for ever."""
    write = WAYS[way]
    versions = [chunks_of(0), chunks_of(1)]
    print("ready", flush=True)
    while True:
        for chunks in reversed(versions):
            write(path, chunks)


if __name__ == "__main__":
    main(*sys.argv[1:])
