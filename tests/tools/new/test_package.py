"""What ROS finds in a package that `yamaro new` makes: launch files, controllers, RViz, Gazebo.

The launch files are run with ROS's own `launch`, where it can be imported, and with stand-ins for
the nodes. It is neither on PyPI nor in Debian; without it, what they name is compared with what is
there.
"""

from __future__ import annotations

import ast
import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

import pytest
import yaml

import yamaro
from tests.consumers.oracles import require_module, require_program
from tests.waiting import PATIENCE
from yamaro.tools.new.package import files_of

NAME = "rover"
NODES = {
    "display": {"robot_state_publisher", "joint_state_publisher_gui", "rviz2"},
    "bringup": {"robot_state_publisher", "ros2_control_node", "spawner", "rviz2"},
    "gazebo": {"robot_state_publisher", "spawner", "rviz2", "create", "parameter_bridge", "gz"},
}


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("ws") / NAME
    for inner, text in files_of(NAME, has_picture=False).items():
        path = folder / inner
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder


@pytest.fixture(scope="module")
def controllers(package: Path) -> dict[str, dict[str, object]]:
    loaded = yaml.safe_load((package / "config/ros2_controllers.yaml").read_text())
    return {name: each["ros__parameters"] for name, each in loaded.items()}


def launch_files(package: Path) -> Iterator[tuple[Path, ast.Module]]:
    for path in sorted((package / "launch").iterdir()):
        yield path, ast.parse(path.read_text())


def texts(tree: ast.AST) -> set[str]:
    """Return the texts of a launch file."""
    return {
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }


def needed(package: Path) -> set[str]:
    root = ElementTree.parse(package / "package.xml").getroot()
    return {str(each.text) for each in root.iterfind("exec_depend")}


# --- what the files name is there -----------------------------------------------------------------


def test_packages_of_nodes_and_includes_are_dependencies(package: Path) -> None:
    named = {"launch", "launch_ros"}
    for _, tree in launch_files(package):
        for call in ast.walk(tree):
            if not isinstance(call, ast.Call):
                continue
            where = [each.value for each in call.keywords if each.arg == "package"]
            if isinstance(call.func, ast.Name) and call.func.id == "FindPackageShare":
                where += call.args
            named |= {each.value for each in where if isinstance(each, ast.Constant)}  # type: ignore[misc]
    assert {"robot_state_publisher", "controller_manager", "ros_gz_sim"} < named
    assert named - {NAME} <= needed(package)


def test_packages_of_plugins_are_dependencies(
    package: Path, controllers: dict[str, dict[str, object]]
) -> None:
    types = [
        str(each["type"])
        for each in controllers["controller_manager"].values()
        if isinstance(each, dict)
    ]
    plugins = [plugin_of(package, hardware) for hardware in ("mock", "gazebo")]
    owners = {each.partition("/")[0] for each in types + plugins}
    owners = {"hardware_interface" if each == "mock_components" else each for each in owners}
    assert owners <= needed(package)
    assert len(owners) == 5


def plugin_of(package: Path, hardware: str) -> str:
    (control,) = robot_of(package, hardware=hardware).controls
    return str(control.plugin)


def robot_of(package: Path, **variables: object) -> yamaro.Robot:
    return yamaro.build(package / f"urdf/{NAME}.yaml", variables=variables).robot


def test_each_file_that_a_launch_file_names_is_there(package: Path) -> None:
    names = {path.name for path in package.rglob("*")}
    named = {
        each
        for _, tree in launch_files(package)
        for each in texts(tree)
        if re.fullmatch(r"\w+(\.launch\.py|\.yaml|\.rviz|\.sdf)", each)
    }
    assert len(named) == 8
    assert named - {"gz_sim.launch.py"} <= names


def test_arguments_of_launch_files_are_those_of_the_robot(package: Path) -> None:
    tree = ast.parse((package / "launch/description.launch.py").read_text())
    (assigned,) = [each for each in tree.body if isinstance(each, ast.Assign)]
    defaults = {name: value for name, (value, _) in ast.literal_eval(assigned.value).items()}
    command = [sys.executable, "-m", "yamaro", "args", str(package / f"urdf/{NAME}.yaml")]
    told = subprocess.run(command, check=True, text=True, capture_output=True, timeout=PATIENCE)
    assert {f"{name}:={value}" for name, value in defaults.items()} == set(
        re.findall(r"^\S+", told.stdout, re.M)
    )


def test_controllers_fit_the_block_of_ros2_control(
    package: Path, controllers: dict[str, dict[str, object]]
) -> None:
    text = yamaro.build(package / f"urdf/{NAME}.yaml").xml()
    offered = {
        (joint.get("name"), kind, each.get("name"))
        for joint in ElementTree.fromstring(text).iterfind("ros2_control/joint")
        for kind in ("command_interface", "state_interface")
        for each in joint.iterfind(kind)
    }
    drive, head = controllers["diff_drive_controller"], controllers["head_controller"]
    wheels = [*list_of(drive["left_wheel_names"]), *list_of(drive["right_wheel_names"])]
    claimed = [(joint, "command_interface", "velocity") for joint in wheels]
    claimed += [(joint, "state_interface", "position") for joint in wheels]
    for kind in ("command_interface", "state_interface"):
        for joint in list_of(head["joints"]):
            claimed += [(joint, kind, name) for name in list_of(head[f"{kind}s"])]
    assert set(claimed) <= offered
    assert {joint for joint, *_ in claimed} == {joint for joint, *_ in offered}

    robot = robot_of(package)
    left, right = (robot.pose(f"{side}_wheel_link") for side in ("left", "right"))
    assert drive["wheel_separation"] == pytest.approx(left.y - right.y)
    assert drive["wheel_radius"] == pytest.approx(left.z)
    assert drive["base_frame_id"] == robot.roots[0].name


def list_of(value: object) -> list[str]:
    assert isinstance(value, list)
    return value


def test_spawned_controllers_are_configured(
    package: Path, controllers: dict[str, dict[str, object]]
) -> None:
    tree = ast.parse((package / "launch/bringup.launch.py").read_text())
    spawned = {each for each in texts(tree) if re.fullmatch(r"\w+_(controller|broadcaster)", each)}
    manager = controllers["controller_manager"]
    assert spawned == {name for name, each in manager.items() if isinstance(each, dict)}
    assert spawned - {"joint_state_broadcaster"} == set(controllers) - {"controller_manager"}


def test_rviz_shows_the_robot_in_its_root(package: Path) -> None:
    loaded = yaml.safe_load((package / f"rviz/{NAME}.rviz").read_text())["Visualization Manager"]
    assert loaded["Global Options"]["Fixed Frame"] == robot_of(package).roots[0].name
    shown = next(each for each in loaded["Displays"] if each["Name"] == "RobotModel")
    assert shown["Description Topic"]["Value"] == "/robot_description"


# --- simulators -----------------------------------------------------------------------------------


def test_gazebo_takes_the_world_and_the_robot(package: Path, tmp_path: Path) -> None:
    """libsdformat judges, which Gazebo reads both with."""
    ign = require_program("ign")
    urdf = tmp_path / "rover.urdf"
    urdf.write_text(
        yamaro.build(
            package / f"urdf/{NAME}.yaml", variables={"hardware": "gazebo"}, gazebo=True
        ).xml()
    )
    for path in (package / "worlds/flat.sdf", urdf):
        judged = subprocess.run(
            [ign, "sdf", "-k", str(path)], text=True, capture_output=True, timeout=PATIENCE
        )
        assert judged.stdout.strip() == "Valid."
    told = subprocess.run(
        [ign, "sdf", "-p", str(urdf)], text=True, capture_output=True, timeout=PATIENCE
    )
    sdf = ElementTree.fromstring(told.stdout)
    plugin = sdf.find(".//plugin")
    assert plugin is not None and plugin.get("filename") == "gz_ros2_control-system"
    parameters = Path(str(plugin.findtext("parameters")))
    assert parameters.samefile(package / "config/ros2_controllers.yaml")
    bridged = yaml.safe_load((package / "config/ros_gz_bridge.yaml").read_text())
    topics = {each["gz_topic_name"] for each in bridged}
    assert f"/{sdf.findtext('.//sensor/topic')}" in topics


def test_the_scene_of_mujoco_drives_as_the_readme_says(
    package: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    require_module("mujoco")
    readme = (package / "README.md").read_text()
    (command,) = re.findall(r"^yamaro (urdf/.* --to mjcf .*?) +#", readme, re.M)
    words = [sys.executable, "-m", "yamaro", *command.split()]
    words[-1] = f"{tmp_path}/mujoco/"
    done = subprocess.run(
        words, cwd=package, check=True, capture_output=True, text=True, timeout=PATIENCE
    )
    assert done.stderr == ""
    (code,) = re.findall(r"```python\n(.*?)```", readme, re.S)
    monkeypatch.chdir(tmp_path)
    exec(code, {})
    x, y, z = map(float, capsys.readouterr().out.strip("[]\n").split())
    assert x == pytest.approx(5 * 0.06 * 2, rel=0.1)  # m: rad/s, radius, seconds
    assert y == pytest.approx(0, abs=1e-3)
    assert z == pytest.approx(0.06, abs=1e-3)


# --- ROS's own launch -----------------------------------------------------------------------------

NODE = """\
#!{python}
import json, sys
with open({log!r}, "a") as log:
    log.write(json.dumps([{name!r}, sys.argv[1:]]) + "\\n")
"""
RUN = """\
import sys
from launch import LaunchDescription, LaunchService
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource

path, *words = sys.argv[1:]
arguments = [word.split(":=", 1) for word in words]
service = LaunchService(noninteractive=True)
source = PythonLaunchDescriptionSource(path)
service.include_launch_description(
    LaunchDescription([IncludeLaunchDescription(source, launch_arguments=arguments)])
)
sys.exit(service.run())
"""
GAZEBO = """\
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.substitutions import LaunchConfiguration

def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("gz_args"),
        DeclareLaunchArgument("on_exit_shutdown"),
        ExecuteProcess(cmd=[__file__ + ".sh", LaunchConfiguration("gz_args")]),
    ])
"""


class Prefix:
    """A prefix of ament with stand-ins for all nodes, which remember what they were given."""

    def __init__(self, folder: Path, package: Path) -> None:
        self.folder = folder
        self.log = folder / "log"
        for name in (*needed(package), NAME):
            self.write(f"share/ament_index/resource_index/packages/{name}", "")
        (folder / "share" / NAME).symlink_to(package)
        for node in (
            "controller_manager/ros2_control_node", "controller_manager/spawner",
            "joint_state_publisher/joint_state_publisher",
            "joint_state_publisher_gui/joint_state_publisher_gui",
            "robot_state_publisher/robot_state_publisher", "ros_gz_bridge/parameter_bridge",
            "ros_gz_sim/create", "rviz2/rviz2",
        ):  # fmt: skip
            self.program(f"lib/{node}", node.rpartition("/")[2])
        self.write("share/ros_gz_sim/launch/gz_sim.launch.py", GAZEBO)
        self.program("share/ros_gz_sim/launch/gz_sim.launch.py.sh", "gz")

    def write(self, name: str, text: str) -> Path:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def program(self, name: str, shown: str) -> None:
        text = NODE.format(python=sys.executable, log=str(self.log), name=shown)
        self.write(name, text).chmod(0o755)

    def launch(self, name: str, *words: str) -> list[tuple[str, list[str]]]:
        """Run a launch file to its end; return the nodes that it started, and their words."""
        self.log.write_text("")
        folder = Path(sys.executable).parent
        before = os.environ.get("AMENT_PREFIX_PATH", "")
        path = self.folder / "share" / NAME / f"launch/{name}.launch.py"
        done = subprocess.run(
            [sys.executable, "-c", RUN, str(path), *words],
            env={
                **os.environ,
                "AMENT_PREFIX_PATH": f"{self.folder}{os.pathsep}{before}",
                "PATH": f"{folder}{os.pathsep}{os.environ['PATH']}",
                "ROS_LOG_DIR": str(self.folder / "logs"),
            },
            text=True, timeout=PATIENCE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip
        assert done.returncode == 0, done.stdout
        return [tuple(json.loads(line)) for line in self.log.read_text().splitlines()]


@pytest.fixture
def prefix(tmp_path: Path, package: Path) -> Prefix:
    for name in ("launch.actions", "launch_ros.actions"):
        pytest.importorskip(name, reason=f"ROS's {name.partition('.')[0]} is not installed")
    return Prefix(tmp_path / "prefix", package)


@pytest.mark.parametrize("name", NODES)
def test_launch_starts_the_nodes(prefix: Prefix, name: str) -> None:
    assert {node for node, _ in prefix.launch(name)} == NODES[name]


def test_launch_passes_arguments_on(prefix: Prefix) -> None:
    started = prefix.launch("gazebo", "camera:=false", "world:=moon.sdf", "rviz:=false")
    assert ["gz", ["-r moon.sdf"]] in [list(each) for each in started]
    spawned = [words for node, words in started if node == "spawner"]
    assert len(spawned) == 1 and "head_controller" not in spawned[0]
    assert "rviz2" not in {node for node, _ in started}
    plain = {node for node, _ in prefix.launch("display", "gui:=false")}
    assert "joint_state_publisher" in plain and "joint_state_publisher_gui" not in plain
