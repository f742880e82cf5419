"""Metrics that cannot be computed for a robot."""

from __future__ import annotations

from ....diagnostics import YamaroError, failure

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ....model.robot import Robot
    from ....source import Span


def metric_failure(message: str, span: Span, *, hint: str | None = None) -> YamaroError:
    """Return the error of a metric that a robot has no value for."""
    return failure("metric-failed", message, span, hint=hint)


def named_link(robot: Robot, name: str) -> str:
    """Return the name of a link or frame, which may be given as that of its part.

    Raises:
        YamaroError: there is none.
    """
    from ....model.positions import link_named

    try:
        return link_named(robot, name).name
    except ValueError as error:
        message, _, hint = str(error).partition("; ")
        hint = hint or f"it has {', '.join(list(robot.links)[:8])}"
        raise metric_failure(message, robot.span, hint=hint) from None
