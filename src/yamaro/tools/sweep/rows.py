"""The rows of the table: a variant each."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ...diagnostics import Diagnostic
    from .plan import Plan

OK, REJECTED, FAILED = "ok", "rejected", "failed"
STATUSES = (OK, REJECTED, FAILED)
CRASH, TIMEOUT, ENDED = "variant-crash", "variant-timeout", "variant-exit"
"""The codes of variants that ended the process in which they were built."""
OUT_OF_MEMORY = "limit-memory"
FAULT = "internal-error"


class Row:
    """What is known of a variant in the end.

    Attributes:
        index: its number.
        arguments: the values of the axes.
        status: one of `STATUSES`.
        code: why it failed: the code of a diagnostic, or "".
        place: where, as `file:line:column`, or "".
        message: the message, or "".
        metrics: what the evaluation found.
        topology: what is the same for variants with the same bodies and joints, or None.
        hashes: the SHA-256 of the documents, by output format.
        documents: the documents and what belongs to each, by the ends of file names; if the models
            are kept.
        assets: the meshes that they share, by path.
    """

    __slots__ = (
        "arguments", "assets", "code", "documents", "hashes", "index", "message", "metrics",
        "place", "status", "topology",
    )  # fmt: skip

    def __init__(self, index: int, arguments: Mapping[str, object], status: str = OK) -> None:
        self.index = index
        self.arguments = dict(arguments)
        self.status = status
        self.code = ""
        self.place = ""
        self.message = ""
        self.metrics: dict[str, float | int | bool | None] = {}
        self.topology: str | None = None
        self.hashes: dict[str, str] = {}
        self.documents: dict[str, bytes] = {}
        self.assets: dict[str, bytes] = {}

    def fail(self, code: str, message: str, place: str = "") -> Row:
        """Note why the variant failed, and return the row."""
        self.status, self.code, self.message, self.place = FAILED, code, message, place
        return self


def row_types(plan: Plan) -> dict[str, str]:
    """Return the type of each argument's column, by the name of the argument."""
    return {axis.name: axis.kind for axis in plan.axes}


def first_error(diagnostics: Sequence[Diagnostic]) -> Diagnostic:
    """Return the first error, or what is there if nothing is one."""
    return next((each for each in diagnostics if each.severity == "error"), diagnostics[0])
