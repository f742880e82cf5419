"""Tests of `ros2 run yamaro_ros reload` with a node that is made up here: rclpy is not installable.

So they show what is built and sent, and when; not that a node of ROS takes it.
"""

from __future__ import annotations

import os
import sys
import types
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.waiting import wait_for
from yamaro_ros.reload import Reload, main, make_rebuilder, read_arguments

ROBOT = "robot: arm\narguments: {length: 1.0}\nmodel:\n- link/name=a$(length):\n"


class Answer:
    """What a node will have answered."""

    def __init__(self, refusal: str) -> None:
        self.is_done = False
        self.refusal = refusal

    def done(self) -> bool:
        return self.is_done

    def result(self) -> str:
        return self.refusal


class Node:
    """A parameter of a node that can be away, be busy, or refuse."""

    def __init__(self) -> None:
        self.is_up = True
        self.refuses = ""
        self.robots: list[str] = []
        self.answer = Answer("")

    def is_there(self) -> bool:
        return self.is_up

    def set(self, value: str) -> Answer:
        self.robots.append(value)
        self.answer = Answer(self.refuses)
        return self.answer

    def refusal(self, answer: Answer) -> str:
        return answer.result()


class Log:
    """Remembers what was logged."""

    def __init__(self) -> None:
        self.lines: list[tuple[str, str]] = []

    def info(self, message: str) -> None:
        self.lines.append(("info", message))

    def warning(self, message: str) -> None:
        self.lines.append(("warning", message))

    def error(self, message: str) -> None:
        self.lines.append(("error", message))


class Scene:
    """A file, a node, and what goes between them."""

    def __init__(self, path: Path) -> None:
        self.path = path
        path.write_text(ROBOT)
        self.node = Node()
        self.log = Log()
        words = [str(path), "length:=2", "--trust", "safe"]
        rebuilder = make_rebuilder(read_arguments(words), self.log.info)
        self.reload = Reload(rebuilder, self.node, self.log)
        self.times = 0

    def save(self, text: str) -> None:
        """Write another text, at a time that no earlier one had."""
        self.path.write_text(text)
        self.times += 1
        time = self.path.stat().st_mtime_ns + self.times * 1_000_000
        os.utime(self.path, ns=(time, time))

    def step_until_sent(self, count: int) -> None:
        """Look at the files until the node was sent so many robots."""

        def is_sent() -> bool:
            self.reload.step()
            return len(self.node.robots) == count

        wait_for(is_sent)

    def links(self) -> list[str]:
        """Return the name of the link in each robot that was sent."""
        return [robot.partition('link name="')[2].partition('"')[0] for robot in self.node.robots]

    def finish(self) -> None:
        """Let the node answer."""
        self.node.answer.is_done = True
        self.reload.step()


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    return Scene(tmp_path / "robot.yaml")


def test_each_good_build_is_sent_once(scene: Scene) -> None:
    scene.reload.step()
    scene.finish()
    scene.reload.step()
    assert scene.links() == ["a2"]
    assert scene.log.lines == [("info", "the node has the new robot")]
    scene.save(ROBOT.replace("=a", "=b"))
    scene.step_until_sent(2)
    scene.finish()
    scene.save(ROBOT.replace("=a", "=b") + "# a comment changes nothing\n")
    for _ in range(3):
        scene.reload.step()
    assert scene.links() == ["a2", "b2"]


def test_a_bad_build_leaves_the_node_its_robot_and_is_explained(scene: Scene) -> None:
    scene.reload.step()
    scene.finish()
    scene.save(ROBOT.replace("$(length)", "$(lenght)"))
    scene.reload.step()
    level, text = scene.log.lines[-1]
    assert level == "error"
    assert f" --> {scene.path}:4:" in text
    assert "hint: did you mean 'length'?" in text
    assert text.endswith("the node keeps the robot that it has")
    assert scene.links() == ["a2"]
    scene.save(ROBOT.replace("=a", "=c"))
    scene.step_until_sent(2)
    assert scene.links() == ["a2", "c2"]


def test_a_node_that_is_away_gets_the_last_robot_when_it_comes(scene: Scene) -> None:
    scene.node.is_up = False
    scene.reload.step()
    scene.save(ROBOT.replace("=a", "=b"))
    for _ in range(3):
        scene.reload.step()
    assert scene.links() == []
    scene.node.is_up = True
    scene.step_until_sent(1)
    assert scene.links() == ["b2"]


def test_a_busy_node_gets_one_robot_at_a_time(scene: Scene) -> None:
    scene.reload.step()
    scene.save(ROBOT.replace("=a", "=b"))
    for _ in range(3):
        scene.reload.step()
    scene.save(ROBOT.replace("=a", "=c"))
    for _ in range(3):
        scene.reload.step()
    assert scene.links() == ["a2"]
    scene.finish()
    assert scene.links() == ["a2", "c2"]


def test_a_refusal_is_reported(scene: Scene) -> None:
    scene.node.refuses = "the URDF has no root"
    scene.reload.step()
    scene.finish()
    assert scene.log.lines == [("error", "the node did not take the robot: the URDF has no root")]


def test_warnings_are_logged(scene: Scene) -> None:
    scene.save(ROBOT + "- note: ${old}\n")
    scene.reload.step()
    assert [level for level, _ in scene.log.lines] == ["warning"]
    assert scene.links() == ["a2"]


class Client:
    """A client of the service that sets parameters, which answers at once."""

    def __init__(self) -> None:
        self.requests: list[Any] = []
        self.service = ""

    def called(self, kind: object, name: str) -> Client:
        """Take the name of the service."""
        self.service = name
        return self

    def service_is_ready(self) -> bool:
        return True

    def call_async(self, request: Any) -> Any:
        self.requests.append(request)
        result = types.SimpleNamespace(successful=len(self.requests) > 1, reason="not today")
        answer = types.SimpleNamespace(results=[result])
        return types.SimpleNamespace(done=lambda: True, result=lambda: answer)


def made_up_rclpy(client: Client, log: Log, turns: Iterator[object]) -> dict[str, Any]:
    """Return modules for what `reload` imports of ROS; `ok` runs a step of `turns` each time."""
    node = types.SimpleNamespace(
        create_client=client.called,
        get_logger=lambda: log,
        destroy_node=lambda: None,
    )
    request = types.SimpleNamespace(Request=types.SimpleNamespace)
    parameter = lambda name, value: types.SimpleNamespace(to_parameter_msg=lambda: (name, value))  # noqa: E731
    contents: dict[str, dict[str, Any]] = {
        "rclpy": {
            "init": lambda args: None, "create_node": lambda name: node,
            "ok": lambda: next(turns, None) is not None, "try_shutdown": lambda: None,
            "spin_once": lambda node, timeout_sec: None,
        },
        "rclpy.utilities": {"remove_ros_args": lambda words: words[: words.index("--ros-args")]},
        "rclpy.parameter": {"Parameter": parameter},
        "rcl_interfaces": {},
        "rcl_interfaces.srv": {"SetParameters": request},
    }  # fmt: skip
    modules = {name: types.ModuleType(name) for name in contents}
    for name, content in contents.items():
        vars(modules[name]).update(content)
    return modules


def test_the_node_calls_the_service_of_the_other_node(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = Scene(tmp_path / "robot.yaml")
    client, log = Client(), Log()

    def turns() -> Iterator[object]:
        yield from range(3)
        scene.save(ROBOT.replace("=a", "=b"))
        yield from range(3)

    for name, module in made_up_rclpy(client, log, turns()).items():
        monkeypatch.setitem(sys.modules, name, module)
    monkeypatch.delitem(sys.modules, "yamaro_ros.remote", raising=False)
    words = [str(scene.path), "length:=3", "--node", "/arm/publisher", "--ros-args", "-r", "x:=y"]
    assert main(words) == 0
    sys.modules.pop("yamaro_ros.remote", None)
    assert client.service == "/arm/publisher/set_parameters"
    sent = [request.parameters for request in client.requests]
    assert [[name for name, _ in parameters] for parameters in sent] == [["robot_description"]] * 2
    assert ['name="a3"' in sent[0][0][1], 'name="b3"' in sent[1][0][1]] == [True, True]
    assert log.lines == [
        ("info", f"watching {scene.path} for /arm/publisher"),
        ("error", "the node did not take the robot: not today"),
        ("info", "the node has the new robot"),
    ]


def test_a_file_that_is_missing_ends_the_node(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    log = Log()
    for name, module in made_up_rclpy(Client(), log, iter(range(3))).items():
        monkeypatch.setitem(sys.modules, name, module)
    assert main([str(tmp_path / "none.yaml"), "--ros-args"]) == 1
    sys.modules.pop("yamaro_ros.remote", None)
    assert log.lines[-1][0] == "error"
    assert "none.yaml" in log.lines[-1][1]


def test_without_rclpy_it_says_what_to_do(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["robot.yaml"]) == 2
    assert "source the set-up of ROS 2 first" in capsys.readouterr().err
