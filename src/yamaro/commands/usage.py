"""How the command ends: its exit statuses, and what is said of a wrong command line."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

DONE = 0
INPUT_ERROR = 1
USAGE_ERROR = 2
INTERNAL_ERROR = 70  # EX_SOFTWARE of sysexits.h
INTERRUPTED = 130  # 128 + SIGINT, as shells count
PIPE_CLOSED = 141  # 128 + SIGPIPE

USAGE = "usage: yamaro [options] FILE [name:=value ...]   (see 'yamaro --help')"


class WrongUsage(Exception):
    """The command line cannot be understood; the text says why."""


def near(word: str, candidates: Iterable[str]) -> str:
    """Return the end of a message that suggests the candidate most like a word, if there is one."""
    from ..diagnostics import did_you_mean

    hint = did_you_mean(word, list(candidates))
    return f"; {hint}" if hint else ""


def quote(text: str) -> str:
    """Return text in quotes, short and fit for a terminal."""
    from ..terminal import shortened

    return f"'{shortened(text)}'"
