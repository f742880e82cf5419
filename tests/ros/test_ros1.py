"""ROS 1 of Debian takes the robot: roslaunch, robot_state_publisher. `scripts/ros` installs it."""

from __future__ import annotations

import os
import shutil
import socket
import subprocess
from pathlib import Path

import pytest
import yaml

from tests.ros.workspace import YAMARO
from tests.waiting import PATIENCE, wait_for

PUBLISHER = Path("/usr/lib/robot_state_publisher/robot_state_publisher")
ROBOT = """\
robot: arm
arguments: {length: 1.0}
model:
- link/name=base_link:
- part:
    name: arm
    joint: {type: fixed, parent: base_link, xyz: 0 0 $(length)}
    link: {geometry: box, size: 1 1 1, mass: 1, visual: }
"""
LAUNCH = f"""\
<launch>
  <arg name="length" default="0.5"/>
  <param name="robot_description"
    command="{YAMARO} -q '$(dirname)/arm.yaml' length:=$(arg length)"/>
  <node pkg="robot_state_publisher" type="robot_state_publisher" name="publisher" required="true"/>
</launch>
"""

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(
        shutil.which("roslaunch", path="/usr/bin") is None or not PUBLISHER.exists(),
        reason="ROS 1 is not installed; scripts/ros does that",
    ),
]


class Ros:
    """A master at a port that was free, and commands that speak to it."""

    def __init__(self, folder: Path) -> None:
        (folder / "arm.yaml").write_text(ROBOT)
        (folder / "robot.launch").write_text(LAUNCH)
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            self.port = probe.getsockname()[1]
        self.folder = folder
        self.environment = {
            "PATH": "/usr/bin:/bin", "HOME": str(folder), "ROS_IP": "127.0.0.1",
            "ROS_MASTER_URI": f"http://127.0.0.1:{self.port}", "ROS_PACKAGE_PATH": "/usr/share",
        }  # fmt: skip

    def start(self) -> subprocess.Popen[str]:
        """Start roslaunch, with a master of its own."""
        return subprocess.Popen(
            ["roslaunch", "-p", str(self.port), "robot.launch", "length:=0.75"],
            cwd=self.folder, env={**os.environ, **self.environment}, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip

    def ask(self, *words: str) -> str:
        """Return what a command prints, "" if it fails or takes long."""
        try:
            done = subprocess.run(
                words, env=self.environment, capture_output=True, text=True, timeout=10, check=False
            )
        except subprocess.TimeoutExpired:
            return ""
        return done.stdout if done.returncode == 0 else ""


@pytest.fixture
def ros(tmp_path: Path) -> Ros:
    return Ros(tmp_path)


def test_robot_state_publisher_publishes_the_robot(ros: Ros) -> None:
    launched = ros.start()
    try:
        xml = yaml.safe_load(wait_for(lambda: ros.ask("rosparam", "get", "/robot_description")))
        assert '<robot name="arm">' in xml
        message = wait_for(lambda: ros.ask("rostopic", "echo", "-n", "1", "/tf_static"))
        transform = yaml.safe_load(message.partition("---")[0])["transforms"][0]
        assert transform["header"]["frame_id"] == "base_link"
        assert transform["child_frame_id"] == "arm_link"
        assert transform["transform"]["translation"] == {"x": 0.0, "y": 0.0, "z": 0.75}
    finally:
        launched.terminate()
        launched.communicate(timeout=PATIENCE)


def test_a_bad_robot_ends_the_launch_with_its_diagnostic(ros: Ros) -> None:
    (ros.folder / "arm.yaml").write_text(ROBOT.replace("$(length)", "$(lenght)"))
    output = ros.start().communicate(timeout=PATIENCE)[0]
    assert "error[undefined-name]: name 'lenght' is not defined" in output
    assert f"{ros.folder}/arm.yaml:7:" in output
    assert "hint: did you mean 'length'?" in output
