"""A fault in a text of a xacro file, whose place in the file only the caller knows."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..diagnostics import Frame, YamaroError


class Fault(Exception):
    """What a diagnostic needs, except for the place.

    Attributes:
        start, end: where in the text the fault lies; `end` is None where it is all of the text.
    """

    def __init__(
        self,
        code: str,
        message: str,
        hint: str | None = None,
        *,
        start: int = 0,
        end: int | None = None,
    ) -> None:
        super().__init__(message)
        self.code = code
        self.message = message
        self.hint = hint
        self.start = start
        self.end = end


def add_trace(error: YamaroError, trace: Frame | None) -> None:
    """Add the trace of an error, if it has none yet."""
    for diagnostic in error.diagnostics:
        if diagnostic.trace is None:
            diagnostic.trace = trace
