"""What the work in a jail may use, and the errors for what goes wrong."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable


class JailLimits:
    """What the work may use before it is ended."""

    __slots__ = (
        "answer", "cpu_seconds", "is_abandoned", "memory", "open_files", "seconds", "threads",
    )  # fmt: skip

    def __init__(
        self,
        *,
        seconds: float = 60.0,
        cpu_seconds: int = 60,
        memory: int = 3 << 30,
        open_files: int = 256,
        threads: int = 256,
        answer: int = 256 << 20,
        is_abandoned: Callable[[], bool] | None = None,
    ) -> None:
        """Set the limits.

        Args:
            seconds: of the wall clock, from the call to the last byte of the answer.
            cpu_seconds: of all processors together, in whole seconds.
            memory: bytes of address space on top of what the process has when it is forked. A
                thread's stack counts in full, so the deep stack takes 512 MB of it.
            open_files: open at once.
            threads: at once.
            answer: bytes of the answer.
            is_abandoned: returns whether nobody wants the answer any more; asked while waiting.
        """
        self.seconds = seconds
        self.cpu_seconds = cpu_seconds
        self.memory = memory
        self.open_files = open_files
        self.threads = threads
        self.answer = answer
        self.is_abandoned = is_abandoned


class JailError(Exception):
    """There is no answer; `limit` names the field of JailLimits that ended the work, if one did."""

    limit = ""


class JailUnavailable(JailError):
    """There can be no jail here, so nothing was run."""


class JailTimeOver(JailError):
    """The wall clock ran out."""

    limit = "seconds"


class JailCpuTimeOver(JailError):
    """The work computed for too long."""

    limit = "cpu_seconds"


class JailOutOfMemory(JailError):
    """The work asked for more memory than it may have."""

    limit = "memory"


class JailTooManyThreads(JailError):
    """The work started too many threads."""

    limit = "threads"


class JailAnswerTooLong(JailError):
    """The answer is longer than an answer may be."""

    limit = "answer"


class JailAbandoned(Exception):
    """Nobody wants the answer any more; so this is not an error that anyone should report."""


class JailAnswerBroken(JailError):
    """The answer was cut short, or is not an answer."""


class JailCrashed(JailError):
    """The child died of a signal that no limit explains."""


class JailWorkFailed(JailError):
    """The work raised an exception, or says so: all that is said about it may be a lie.

    Attributes:
        kind: the name of its class.
        text: its text.
        place: where it was raised, as `file.py:line`, or empty.
        is_fault: whether it was an ordinary exception, and none that ends a program.
    """

    def __init__(self, kind: str, text: str, place: str, *, is_fault: bool) -> None:
        """Hold what the child says of an exception."""
        reason = f"{kind}: {text}" if text else kind
        super().__init__(f"{reason} at {place}" if place else reason)
        self.kind = kind
        self.text = text
        self.place = place
        self.is_fault = is_fault
