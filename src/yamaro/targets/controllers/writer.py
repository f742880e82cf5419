"""The file of controllers: the controller manager with the types, then each one's parameters."""

from __future__ import annotations

from ..output import Output
from ..parameters import yaml_of
from .planning import Plan

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.robot import Robot
    from ..output import Wanted


def write(robot: Robot, wanted: Wanted) -> Output:
    """Return the parameters of a robot's controllers.

    Raises:
        YamaroError: a controller lacks what it needs.
    """
    plan = Plan(robot, wanted)
    return Output(None, plan.losses, text=text_of(plan), warnings=plan.warnings)


def text_of(plan: Plan) -> str:
    """Return the file of a plan."""
    types = {each.name: {"type": each.plugin, **each.of_manager} for each in plan.controllers}
    document: dict[str, object] = {
        "controller_manager": {"ros__parameters": {**plan.manager, **types}}
    }
    for each in plan.controllers:
        if each.parameters:
            document[each.name] = {"ros__parameters": each.parameters}
    return yaml_of(document)
