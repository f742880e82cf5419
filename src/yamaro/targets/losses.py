"""Losses: what a format cannot hold as it is, gathered by its writer and reported as warnings."""

from __future__ import annotations

from ..diagnostics import ACCEPTED, WARNING, Diagnostic
from ..model.controllers import Controller
from ..model.extras import Actuator, Group, Loop, Sensor, State, Surface
from ..model.joint import Joint
from ..model.link import Link
from ..source import OverlaidSpan, Public
from .elements import written_at
from .table import TARGETS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from ..allowances import Allowance
    from ..diagnostics import Frame as Step
    from ..model.extras import Noted
    from ..model.values import Written
    from ..source import Span
    from ..xml.tree import Element

    Owner = Link | Joint | Sensor | Noted

LOST, APPROXIMATED, RENAMED = "lost", "approximated", "renamed"
KINDS = (LOST, APPROXIMATED, RENAMED)


class Loss(Public):
    """Something of a robot that a format cannot hold as it is.

    Losses of one `kind` and one `what` are reported as one, with a count.

    Attributes:
        kind: `LOST`, `APPROXIMATED` or `RENAMED`.
        what: what cannot be held, in the plural and the same words for all of it: "soft limits".
        owner: whose it is: "joint 'elbow_joint'".
        how: what is written in its place, or ""; the same words for all of one `what`, except for
            what is renamed, where it is the new name.
        hint: what to write instead, or "".
        span: where it is written.
        trace: the calls and includes that led there, innermost first.
    """

    __slots__ = ("hint", "how", "kind", "owner", "span", "trace", "what")

    def __init__(
        self,
        kind: str,
        what: str,
        owner: str,
        span: Span,
        *,
        trace: Step | None = None,
        how: str = "",
        hint: str = "",
    ) -> None:
        self.kind = kind
        self.what = what
        self.owner = owner
        self.span = span
        self.trace = trace
        self.how = how
        self.hint = hint


class Losses(list[Loss]):
    """What a writer could not have a format hold, in the order of the robot.

    An owner is a link, a joint, a sensor, or what else of a robot is written in one place. The loss
    is reported where the owner is written, or its part, or the field of these.
    """

    __slots__ = ()

    def lose(
        self,
        what: str,
        owner: Owner,
        *,
        part: Written | None = None,
        field: str = "",
        label: str = "",
        span: Span | None = None,
        hint: str = "",
        how: str = "",
        kind: str = LOST,
    ) -> None:
        """Note what is lost.

        Args:
            what: what cannot be held, in the plural; see `Loss`.
            owner: whose it is.
            part: the part of the owner, if it is not the whole.
            field: the value of the owner or its part, if it is not the whole.
            label: what messages call the owner, by default by its name.
            span: where it is written, if not there.
            hint: what to write instead.
            how: what is written in its place.
            kind: `LOST`, or another one of `KINDS`.
        """
        at, trace = written_at(owner, part)
        if field:
            at = (part or owner).span_of(field)
        self.append(
            Loss(kind, what, label or label_of(owner), span or at, trace=trace, how=how, hint=hint)
        )

    def lose_xml(
        self, what: str, element: Element, *, label: str, trace: Step | None, field: str = ""
    ) -> None:
        """Note an element that is lost, or an attribute of it; `trace` leads there."""
        span = element.name_span(field) if field else element.span
        self.append(Loss(LOST, what, label, span, trace=trace))

    def approximate(
        self,
        what: str,
        owner: Owner,
        *,
        how: str,
        part: Written | None = None,
        field: str = "",
        label: str = "",
        hint: str = "",
    ) -> None:
        """Note what is written another way; for the arguments see `lose`."""
        self.lose(
            what, owner, part=part, field=field, label=label, how=how, hint=hint, kind=APPROXIMATED
        )

    def rename(
        self,
        what: str,
        owner: Owner,
        *,
        new: str,
        part: Written | None = None,
        field: str = "",
        label: str = "",
    ) -> None:
        """Note what has another name; for the arguments see `lose`."""
        self.lose(what, owner, part=part, field=field, label=label, how=new, kind=RENAMED)


def label_of(owner: Owner) -> str:
    """Return what messages call something of a robot: "joint 'elbow_joint'"."""
    match owner:
        case Actuator():
            return f"joint '{owner.joint}'"
        case Surface():
            return f"link '{owner.link}'"
        case Link() | Joint() | Sensor() | State() | Loop() | Group() | Controller():
            return f"{type(owner).__name__.lower()} '{owner.name}'"
    raise AssertionError(f"{type(owner).__name__} has no name")


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
    first, title = group[0], TARGETS[format].title
    what = f"{first.what} {'is' if first.what.startswith('noise ') else 'are'}"
    how, said = first.how, f"{what} renamed in {title}"
    if first.kind == LOST:
        said = f"{what} lost in {title}"
        said += f"; written instead: {how}" if how else ""
    elif first.kind == APPROXIMATED:
        said = f"{what} approximated in {title}"
        said += f" by {how}" if how else ""
    others = len({loss.owner for loss in group}) - 1
    count = f" and {others} other{'s' if others > 1 else ''}" if others else ""
    return Diagnostic(
        code_of(first.kind, format),
        f"{said}: {_named(first)}{count}",
        first.span,
        hint=next((loss.hint for loss in group if loss.hint), None),
        notes=[f"also {_named(loss)}, at {loss.span.place()}" for loss in group[1:]],
        severity=severity,
        trace=first.trace,
    )


def _named(loss: Loss) -> str:
    is_renamed = loss.kind == RENAMED and loss.how
    return f"{loss.owner} to '{loss.how}'" if is_renamed else loss.owner


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
        owner, how, *overlaid = each.notes
        span = OverlaidSpan(each.span, overlaid[0]) if overlaid else each.span
        hint = each.hint or ""
        losses.append(Loss(kind, each.message, owner, span, trace=each.trace, how=how, hint=hint))
    return losses
