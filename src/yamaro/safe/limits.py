"""Refusals of safe mode, and limits on what a file may use there."""

from __future__ import annotations

from ..diagnostics import InputFault
from ..policy import SAFE, UNSAFE, Limits

RUN_IT = "--jail runs the file confined (on Linux), --trust with all your rights"


class SafetyError(InputFault):
    """Code that safe mode refuses, or a limit that it reached.

    Attributes:
        code: "unsafe-code", or "limit-" and the name of a field of `SafeLimits`.
        construct: what is refused, in words: "the function `open`". Empty for a limit.
        position: where in the compiled text; None if it is all of the text, and for an error at
            run time, whose place the traceback shows.
    """

    def __init__(
        self,
        code: str,
        message: str,
        hint: str | None = None,
        *,
        construct: str = "",
        position: tuple[int, int, int, int] | None = None,
    ) -> None:
        super().__init__(code, message, hint, position=position)
        self.construct = construct


def refused(
    construct: str,
    why: str = "",
    hint: str = RUN_IT,
    *,
    position: tuple[int, int, int, int] | None = None,
) -> SafetyError:
    """Return the error for a construct, named in words that fit in front of "is not allowed"."""
    message = f"{construct} is not allowed in safe mode{': ' if why else ''}{why}"
    return SafetyError(UNSAFE, message, hint, construct=construct, position=position)


class SafeLimits(Limits):
    """Limits on the code of one conversion; each can be set."""

    __slots__ = ()

    def __init__(self, **others: int) -> None:
        super().__init__(SAFE, **others)

    @classmethod
    def of(cls, limits: Limits) -> SafeLimits:
        """Return the limits of a policy, which says what it lets."""
        made = cls()
        for name in Limits.__slots__:
            setattr(made, name, getattr(limits, name))
        return made

    def passed(
        self,
        name: str,
        message: str,
        hint: str = "",
        position: tuple[int, int, int, int] | None = None,
    ) -> SafetyError:
        """Return the error for a limit; `message` ends where "the limit is" goes on."""
        limit = f"{getattr(self, name):,}"
        way_out = f"--limit {name}=… sets another limit"
        return SafetyError(
            f"limit-{name}",
            f"{message}; the limit in safe mode is {limit}",
            f"{hint}; {way_out}" if hint else way_out,
            position=position,
        )
