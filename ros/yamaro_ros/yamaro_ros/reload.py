"""`ros2 run yamaro_ros reload FILE`: gives a running robot_state_publisher each good build."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Sequence
from typing import Any, Protocol

from yamaro import UsageError
from yamaro.options import Options
from yamaro.rebuilding import Rebuilder

from .robots import MODES, PACKAGES, RobotError, errors_in, policy_for, tell_warnings

PAUSE = 0.05
"""Seconds between two looks at the files."""


class Answer(Protocol):
    """What comes of setting a parameter: a future of rclpy."""

    def done(self) -> bool:
        """Return whether the node has answered."""

    def result(self) -> object:
        """Return its answer."""


class Parameter(Protocol):
    """A parameter of another node."""

    def is_there(self) -> bool:
        """Return whether the node can be reached."""

    def set(self, value: str) -> Answer:
        """Ask for another value."""

    def refusal(self, answer: Any) -> str:
        """Return why the node did not take a value, or "" if it did."""


class Logger(Protocol):
    """A logger of rclpy."""

    def info(self, message: str) -> None:
        """Log what went well."""

    def warning(self, message: str) -> None:
        """Log a warning."""

    def error(self, message: str) -> None:
        """Log an error."""


class Reload:
    """Builds a robot whenever its files change, and sets a parameter to each good one.

    After a bad build the node keeps the robot that it has. A robot that has not changed is not sent
    again, and one that was overtaken while the node was busy or away is not sent at all.
    """

    def __init__(self, rebuilder: Rebuilder, parameter: Parameter, logger: Logger) -> None:
        """Begin with nothing built."""
        self._rebuilder = rebuilder
        self._parameter = parameter
        self._logger = logger
        self._is_first = True
        self._given: str | None = None  # the robot that was built last
        self._wanted: str | None = None  # the robot to send
        self._answer: Answer | None = None

    def step(self) -> None:
        """Look at the files, build if one has changed, send, and read the answer; never wait."""
        if self._is_first or self._rebuilder.has_changed():
            self._is_first = False
            self._build()
        if self._answer is not None and self._answer.done():
            refusal = self._parameter.refusal(self._answer)
            self._answer = None
            if refusal:
                self._logger.error(f"the node did not take the robot: {refusal}")
            else:
                self._logger.info("the node has the new robot")
        if self._wanted is not None and self._answer is None and self._parameter.is_there():
            self._answer = self._parameter.set(self._wanted)
            self._wanted = None

    def _build(self) -> None:
        turn = self._rebuilder.build()
        tell_warnings(turn.diagnostics, self._logger.warning)
        if turn.build is None:
            reason = turn.fault or errors_in(turn.diagnostics)
            self._logger.error(f"{reason}\nthe node keeps the robot that it has")
            return
        xml = turn.build.xml()
        if xml != self._given:
            self._given = self._wanted = xml


def read_arguments(words: Sequence[str]) -> argparse.Namespace:
    """Return what the command line says."""
    parser = argparse.ArgumentParser(
        prog="ros2 run yamaro_ros reload",
        description="Build a robot at each save, and give it to a running node.",
    )
    parser.add_argument("file", help="the robot: YAML, URDF or xacro")
    parser.add_argument("variables", nargs="*", metavar="name:=value", help="sets a variable")
    parser.add_argument("--node", default="/robot_state_publisher", help="the node")
    parser.add_argument("--parameter", default="robot_description", help="its parameter")
    parser.add_argument(
        "--trust", default="trust", choices=MODES, help="how far the file is trusted"
    )
    parser.add_argument(
        "--meshes", default=PACKAGES, help="how meshes are named, as for yamaro --meshes"
    )
    return parser.parse_args(words)


def make_rebuilder(arguments: argparse.Namespace, say: Callable[[str], None]) -> Rebuilder:
    """Return what builds the robot."""
    return Rebuilder(
        arguments.file,
        Options(
            policy=policy_for(arguments.trust),
            command_line=arguments.variables,
            on_message=say,
            meshes=arguments.meshes,
        ),
    )


def main(words: Sequence[str] | None = None) -> int:
    """Run the node until Ctrl-C; return the exit status."""
    try:
        import rclpy
        from rclpy.utilities import remove_ros_args
    except ImportError as error:
        print(f"reload: {error}; source the set-up of ROS 2 first", file=sys.stderr)
        return 2
    words = sys.argv if words is None else [sys.argv[0], *words]
    arguments = read_arguments(remove_ros_args(list(words))[1:])
    rclpy.init(args=list(words))
    node = rclpy.create_node("yamaro_reload")
    logger = node.get_logger()
    try:
        from .remote import RemoteParameter

        parameter = RemoteParameter(node, arguments.node, arguments.parameter)
        reload = Reload(make_rebuilder(arguments, logger.info), parameter, logger)
        logger.info(f"watching {os.path.abspath(arguments.file)} for {arguments.node}")
        while rclpy.ok():
            reload.step()
            rclpy.spin_once(node, timeout_sec=PAUSE)
    except (UsageError, RobotError) as error:
        logger.error(str(error))
        return 1
    except KeyboardInterrupt:
        return 0
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
    return 0


if __name__ == "__main__":
    sys.exit(main())
