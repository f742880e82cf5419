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


def check_link(robot: Robot, name: str) -> None:
    """Raise YamaroError if a robot has no link or frame of a name."""
    if name in robot.links:
        return
    from ....diagnostics import did_you_mean

    hint = did_you_mean(name, robot.links) or f"it has {', '.join(list(robot.links)[:8])}"
    raise metric_failure(f"the robot has no link or frame '{name}'", robot.span, hint=hint)
