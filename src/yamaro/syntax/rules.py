"""What holds while the files of a program are read and parsed: limits, and which Python."""

from __future__ import annotations

from ..policy import Limits

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from types import CodeType


class Rules:
    """What holds while files are read and parsed.

    Attributes:
        limits: how large they may be.
        compile: makes code of the text, the file name and the mode that Python's `compile` takes;
            raises what that raises, or an InputFault.
    """

    __slots__ = ("compile", "limits")

    def __init__(
        self,
        limits: Limits | None = None,
        compile: Callable[[str, str, str], CodeType] | None = None,
    ) -> None:
        """Set them; by default all of Python is allowed, within the limits of trusted files."""
        self.limits = limits or Limits()
        self.compile = compile or self._compile

    def _compile(self, text: str, filename: str, mode: str) -> CodeType:
        if "**" not in text and "<<" not in text:
            return compile(text, filename, mode, dont_inherit=True)
        from .powers import compile_bounded

        return compile_bounded(text, filename, mode, self.limits)
