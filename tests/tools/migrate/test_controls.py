"""Blocks for ros2_control become the words that make them, and others stay as they are."""

from __future__ import annotations

import pytest

from tests.tools.migrate.migrating import migrated
from tests.tools.migrate.test_xacro_migration import migrated as migrated_xacro

TYPE_CHECKING = False
if TYPE_CHECKING:
    from pathlib import Path

ROBOT = """
<link name="base_link"/>
<joint name="arm_joint" type="revolute">
  <origin xyz="0 0 0" rpy="0 0 0"/>
  <parent link="base_link"/><child link="arm_link"/><axis xyz="0 1 0"/>
  <limit lower="-1.5" upper="1.5" effort="10" velocity="3"/>
</joint>
<link name="arm_link"/>
<joint name="to_wheel" type="continuous">
  <origin xyz="0 0 0" rpy="0 0 0"/>
  <parent link="base_link"/><child link="wheel"/><axis xyz="0 1 0"/>
  <limit effort="10" velocity="3"/>
</joint>
<link name="wheel"/>
"""
ARM = """
<joint name="arm_joint">
  <command_interface name="position">
    <param name="min">-1.5</param><param name="max">1.5</param>
  </command_interface>
  <state_interface name="position"><param name="initial_value">0.5</param></state_interface>
  <state_interface name="velocity"/>
</joint>
"""
WHEEL = """
<joint name="to_wheel">
  <command_interface name="velocity">
    <param name="min">-3</param><param name="max">3</param>
  </command_interface>
  <state_interface name="position"/><state_interface name="velocity"/>
</joint>
"""
HARDWARE = '<hardware><plugin>a/B</plugin><param name="port">3</param></hardware>'


def block(*inside: str, name: str = "arms") -> str:
    return f'<ros2_control name="{name}" type="system">{"".join(inside)}</ros2_control>'


def robot(*blocks: str) -> str:
    return f'<robot name="r">{ROBOT}{"".join(blocks)}<gazebo/></robot>'


def test_a_block_becomes_control_and_actuators() -> None:
    text = migrated(robot(block(HARDWARE, ARM, WHEEL)))
    assert "ros2_control" not in text
    assert "actuator: {command: position}" in text
    assert "actuator: {command: velocity}" in text
    assert text.endswith(
        "states:\n  initial: {arm: 0.5}\n"
        "control:\n  name: arms\n  plugin: a/B\n  params: {port: 3}\n  state: initial\n"
    )


def test_a_joint_may_take_several_commands() -> None:
    commands = ARM.replace(
        '<state_interface name="position">',
        """
      <command_interface name="effort"><param name="min">-10</param><param name="max">10</param>
      </command_interface><state_interface name="position">""",
    )
    commands = commands.replace("\n</joint>", '<state_interface name="effort"/></joint>')
    text = migrated(robot(block(HARDWARE, commands)))
    assert "actuator:\n        command: position, effort\n" in text


def test_several_blocks_stay() -> None:
    text = migrated(robot(block(HARDWARE, ARM, name="one"), block(HARDWARE, WHEEL, name="two")))
    assert text.count("ros2_control/name=") == 2


@pytest.mark.parametrize(
    "inside",
    [
        HARDWARE + ARM.replace("1.5", "1.4") + WHEEL,  # other limits
        HARDWARE + ARM.replace('<param name="min">-1.5</param>', "") + WHEEL,
        HARDWARE + ARM.replace('<state_interface name="velocity"/>', "") + WHEEL,
        HARDWARE + WHEEL + ARM,  # another order
        HARDWARE + ARM.replace("arm_joint", "other_joint"),
        HARDWARE + ARM + '<sensor name="imu"><state_interface name="orientation.x"/></sensor>',
        HARDWARE + "<!-- the arm -->" + ARM,
        HARDWARE,
        ARM,
    ],
)
def test_what_the_words_do_not_make_stays(inside: str) -> None:
    text = migrated(robot(block(inside)))
    assert "ros2_control/name=arms, type=system:" in text
    assert "control:\n  name" not in text


def test_a_block_in_xacro_without_expressions_does_too(tmp_path: Path) -> None:
    text = migrated_xacro(tmp_path, ROBOT + block(HARDWARE, ARM, WHEEL))["r.yaml"]
    assert "control:\n  name: arms\n" in text
    computed = block(HARDWARE, ARM, WHEEL).replace(">3<", ">${3}<")
    assert "ros2_control/" in migrated_xacro(tmp_path, ROBOT + computed)["r.yaml"]
