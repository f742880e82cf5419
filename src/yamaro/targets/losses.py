"""What a format cannot hold, as warnings: one for all losses of a kind."""

from __future__ import annotations

from ..diagnostics import ACCEPTED, WARNING, Diagnostic
from .output import APPROXIMATED, LOST, RENAMED, Loss
from .writers import TITLES

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from ..allowances import Allowance

KINDS = (LOST, APPROXIMATED, RENAMED)


def diagnostics_of(losses: Iterable[Loss], format: str) -> list[Diagnostic]:
    """Return a warning for all losses of one kind and one `what`, at the place of the first.

    The places of the others are its notes. Those that comments accept are apart, by the comments,
    so that each of these is known to accept something.
    """
    groups: dict[tuple[str, str, str, tuple[Allowance, ...]], list[Loss]] = {}
    for loss in losses:
        how = "" if loss.kind == RENAMED else loss.how
        comments: tuple[Allowance, ...] = ()
        if loss.span.source.has_remarks or loss.trace is not None:
            from ..allowances import allowing

            comments = tuple(allowing(code_of(loss.kind, format), loss.span, loss.trace))
        groups.setdefault((loss.kind, loss.what, how, comments), []).append(loss)
    return [
        _diagnostic(group, format, ACCEPTED if comments else WARNING)
        for (*_, comments), group in groups.items()
    ]


def code_of(kind: str, format: str) -> str:
    """Return the code of losses: `lost-in-mjcf`."""
    return f"{kind}-in-{format}"


def _diagnostic(group: Sequence[Loss], format: str, severity: str) -> Diagnostic:
    first = group[0]
    return Diagnostic(
        code_of(first.kind, format),
        f"{_said(first, TITLES[format])}: {_named(first)}{_count(len(group) - 1)}",
        first.span,
        hint=next((loss.hint for loss in group if loss.hint), None),
        notes=[f"also {_named(loss)}, at {loss.span.place()}" for loss in group[1:]],
        severity=severity,
        trace=first.trace,
    )


def _said(loss: Loss, title: str) -> str:
    how = loss.how
    if loss.kind == LOST:
        return f"{loss.what} are lost in {title}" + (f"; written instead: {how}" if how else "")
    if loss.kind == APPROXIMATED:
        return f"{loss.what} are approximated in {title}" + (f" by {how}" if how else "")
    return f"{loss.what} are renamed in {title}"


def _named(loss: Loss) -> str:
    is_renamed = loss.kind == RENAMED and loss.how
    return f"{loss.owner} to '{loss.how}'" if is_renamed else loss.owner


def _count(others: int) -> str:
    if not others:
        return ""
    return f" and {others} other{'s' if others > 1 else ''}"


# --- out of a jail ----------------------------------------------------------------------------


def packed(losses: Iterable[Loss], format: str) -> list[Diagnostic]:
    """Return losses as diagnostics, of which `unpacked` makes losses again."""
    return [
        Diagnostic(
            code_of(loss.kind, format),
            loss.what,
            loss.span,
            hint=loss.hint,
            notes=[loss.owner, loss.how],
            severity=WARNING,
            trace=loss.trace,
        )
        for loss in losses
    ]


def unpacked(diagnostics: Iterable[Diagnostic]) -> list[Loss]:
    """Return the losses that `packed` made diagnostics of.

    Raises:
        ValueError: one is not of that form.
    """
    losses = []
    for each in diagnostics:
        kind = each.code.partition("-in-")[0]
        if kind not in KINDS:
            raise ValueError("there is no such kind of loss")
        owner, how = each.notes
        hint = each.hint or ""
        losses.append(
            Loss(kind, each.message, owner, each.span, trace=each.trace, how=how, hint=hint)
        )
    return losses
