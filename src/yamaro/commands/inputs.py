"""Reads what can be read only once: standard input and named pipes."""

from __future__ import annotations

import os
import sys

from ..source import STANDARD_INPUT, STANDARD_INPUT_NAME
from .usage import WrongUsage

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..policy import Limits


def read_pipe(path: str, limits: Limits) -> str | None:
    """Return the text of standard input or of a named pipe, None for what can be read by name."""
    from ..files.loader import LoadError, check_size, decode

    data = read_bytes(path, limits.file + 1)
    if data is None:
        return None
    if path == STANDARD_INPUT:
        name, absolute = STANDARD_INPUT_NAME, ""
    else:
        name, absolute = path, os.path.abspath(path)
    try:
        check_size(len(data), limits)
    except LoadError as error:
        from ..main_file import refusal_of_main

        raise refusal_of_main(name, error) from None
    return decode(data, name=name, path=absolute).text


def read_bytes(path: str, most: int) -> bytes | None:
    """Return `most` bytes of standard input or a pipe, None for what can be read by name."""
    if path == STANDARD_INPUT:
        if sys.stdin is None:
            raise WrongUsage("standard input is closed")
        buffer = getattr(sys.stdin, "buffer", None)
        try:
            return sys.stdin.read(most).encode() if buffer is None else buffer.read(most)
        except OSError as error:
            raise WrongUsage(f"cannot read standard input: {error.strerror}") from None
    try:
        if os.stat(path).st_mode & 0o170000 != 0o010000:
            return None
        with open(path, "rb") as file:
            return file.read(most)
    except OSError:
        return None
