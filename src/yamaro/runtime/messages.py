"""What a program says: the lines that `print` and `process` print, passed on as they are done."""

from __future__ import annotations

from ..diagnostics import InputFault
from ..policy import Limits

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any


class Messages:
    """Collects printed text into whole lines for the receiver of messages."""

    __slots__ = ("_left", "_limits", "_on_message", "_unfinished")

    def __init__(self, on_message: Callable[[str], None], limits: Limits) -> None:
        """Pass each line, or lines printed at once, to `on_message`, without a final break."""
        self._on_message = on_message
        self._limits = limits
        self._left = limits.printed
        self._unfinished: list[str] = []  # what was printed with another `end` than a line break

    def say(self, text: str) -> None:
        """Take printed text, and pass it on as soon as its line is complete.

        Raises:
            InputFault: it is more than may be printed.
        """
        self._left -= len(text)
        if self._left < 0:
            raise InputFault(
                "limit-printed",
                f"more than {self._limits.printed:,} characters are printed, which is the limit",
                self._limits.hint("printed"),
            )
        lines, has_end, rest = text.rpartition("\n")
        if has_end:
            self._on_message("".join([*self._unfinished, lines]))
            self._unfinished.clear()
        if rest:
            self._unfinished.append(rest)

    def close(self) -> None:
        """Pass on a last line that was never ended."""
        if self._unfinished:
            self._on_message("".join(self._unfinished))
            self._unfinished.clear()

    def print(
        self,
        *values: object,
        sep: str | None = " ",
        end: str | None = "\n",
        file: Any = None,
        flush: bool = False,
    ) -> None:
        """Replace Python's `print` in expressions and process blocks."""
        if file is not None:
            print(*values, sep=sep, end=end, file=file, flush=flush)
            return
        text = (" " if sep is None else sep).join(str(value) for value in values)
        self.say(text + ("\n" if end is None else end))
