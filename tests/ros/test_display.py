"""Tests of `display.launch.py` with made-up actions that only remember what they were given.

They show which nodes are asked for, and with what; no node is started, and no RViz.
"""

from __future__ import annotations

import runpy
import sys
import types
from pathlib import Path
from typing import Any

import pytest

from tests.ros.stand_in import Logger, SubstitutionFailure

LAUNCH_FILE = Path(__file__).parents[2] / "ros/yamaro_ros/launch/display.launch.py"
ROBOT = "robot: arm\narguments: {n: 1, root: base}\nmodel:\n- link/name=$(root)$(n):\n"


class Action:
    """Any action or condition: remembers what it was given."""

    def __init__(self, *given: Any, **named: Any) -> None:
        self.given = given
        self.named = named


class Configuration(Action):
    """The value of an argument: those of the context, by its name."""

    def perform(self, context: dict[str, str]) -> str:
        return context[self.given[0]]


@pytest.fixture
def logger() -> Logger:
    return Logger()


@pytest.fixture
def display(monkeypatch: pytest.MonkeyPatch, logger: Logger, tmp_path: Path) -> dict[str, Any]:
    """Return what the launch file defines."""
    contents: dict[str, dict[str, Any]] = {
        "ament_index_python": {},
        "ament_index_python.packages": {
            "get_package_share_directory": lambda name: f"/share/{name}"
        },
        "launch": {"LaunchDescription": Action},
        "launch.actions": {"DeclareLaunchArgument": Action, "OpaqueFunction": Action},
        "launch.conditions": {"IfCondition": Action, "UnlessCondition": Action},
        "launch.logging": {"get_logger": lambda name: logger},
        "launch.substitutions": {
            "LaunchConfiguration": Configuration,
            "SubstitutionFailure": SubstitutionFailure,
        },
        "launch_ros": {},
        "launch_ros.actions": {"Node": Action},
        "launch_ros.parameter_descriptions": {"ParameterValue": Action},
    }
    for name, content in contents.items():
        module = types.ModuleType(name)
        vars(module).update(content)
        monkeypatch.setitem(sys.modules, name, module)
    return runpy.run_path(str(LAUNCH_FILE))


def context_for(display: dict[str, Any], path: Path, **changed: str) -> dict[str, str]:
    """Return the values of all arguments: the defaults, and what was changed."""
    description = display["generate_launch_description"]()
    *arguments, function = description.given[0]
    assert function.named["function"] is display["make_nodes"]
    values = {each.given[0]: each.named["default_value"] for each in arguments}
    return {**values, "model": str(path), **changed}


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    path = tmp_path / "robot.yaml"
    path.write_text(ROBOT)
    return path


def test_it_starts_the_nodes_that_show_a_robot(display: dict[str, Any], robot: Path) -> None:
    context = context_for(display, robot, args="n:=2 'root:=a b'")
    nodes = display["make_nodes"](context)
    publisher, gui, plain, rviz, reload = nodes
    value = publisher.named["parameters"][0]["robot_description"]
    assert value.named == {"value_type": str}
    assert '<link name="a b2"/>' in value.given[0]
    assert [gui.named["executable"], plain.named["executable"]] == [
        "joint_state_publisher_gui", "joint_state_publisher",
    ]  # fmt: skip
    assert rviz.named["arguments"][0] == "-d"
    assert rviz.named["arguments"][2:] == ["-f", "a b2"]
    assert context["rvizconfig"] == "/share/yamaro_ros/rviz/display.rviz"
    assert reload.named["package"] == "yamaro_ros"
    model, *words, trust = reload.named["arguments"]
    assert [model.perform(context), trust.perform(context)] == [str(robot), "trust"]
    assert words == ["n:=2", "root:=a b", "--trust"]
    assert context["reload"] == "false"


def test_a_bad_robot_ends_the_launch_with_place_and_hint(
    display: dict[str, Any], robot: Path
) -> None:
    robot.write_text(ROBOT.replace("$(root)", "$(rot)"))
    with pytest.raises(SubstitutionFailure) as caught:
        display["make_nodes"](context_for(display, robot))
    assert f" --> {robot}:4:" in str(caught.value)
    assert "hint: did you mean 'root'?" in str(caught.value)
    for changed in ({"trust": "no"}, {"args": "'"}):
        with pytest.raises(SubstitutionFailure):
            display["make_nodes"](context_for(display, robot, **changed))
