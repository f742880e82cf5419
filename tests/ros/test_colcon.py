"""A workspace of ROS 2, built with Debian's colcon and ament."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
import yaml

from tests.ros.workspace import SYSTEM_PYTHON, YAMARO, Workspace
from yamaro import __version__

PACKAGE = Path(__file__).parents[2] / "ros/yamaro_ros"
INDEX = (
    "import sys; from ament_index_python.packages import get_package_share_directory as find; "
    "print(*map(find, sys.argv[1:]))"
)


@pytest.mark.slow
def test_a_workspace_is_built_installed_found_and_built_again(tmp_path: Path) -> None:
    workspace = Workspace(tmp_path)
    assert built(workspace.build()) == {"rover", "cart"}
    urdf = (workspace.share / "urdf/rover.urdf").read_text()
    assert 'name="wheel_link"' in urdf
    assert 'filename="package://arm_description/meshes/arm.obj"' in urdf
    check_that_packages_are_found(workspace)
    cart = workspace.folder / "install/cart/share/cart"
    for folder in ("config", "launch", "rviz", "urdf", "worlds"):
        made = {path.name for path in (workspace.cart / folder).iterdir()}
        assert made and made <= {path.name for path in (cart / folder).iterdir()}

    robots = ("rover_description", "cart")
    assert built(workspace.build(*robots)) == set()
    wheel = workspace.rover / "urdf/parts/wheel.yaml"
    workspace.change(wheel, "mass: 1", "mass: 2")
    output = workspace.build(*robots)
    assert built(output) == {"rover"}
    assert "Configuring done" not in output
    assert '<mass value="2"/>' in (workspace.share / "urdf/rover.urdf").read_text()
    assert built(workspace.build(*robots)) == set()
    workspace.change(workspace.cart / "urdf/wheel.yaml", "\n", "\n# changed\n")
    assert built(workspace.build(*robots)) == {"cart"}

    assert workspace.run("colcon", "test", "--packages-select", *robots)
    results = workspace.run("colcon", "test-result", "--all")
    for name in ("rover", "cart"):
        assert re.search(rf"yamaro_check_{name}\.xunit\.xml: 1 test, 0 errors, 0 failures", results)

    workspace.change(wheel, "radius", "raduis")
    output = workspace.build("rover_description", check=False)
    assert "hint: did you mean 'radius'?" in output
    assert f"{wheel}:5:" in output


def built(output: str) -> set[str]:
    """Return the robots that were built."""
    return set(re.findall(r"Building (\w+)\.urdf with Yamaro", output))


def check_that_packages_are_found(workspace: Workspace) -> None:
    """Check that ament's index and Yamaro find the packages where they are installed."""
    install = workspace.folder / "install"
    packages = ("rover_description", "arm_description", "cart", "yamaro_ros")
    paths = workspace.sourced(f'{SYSTEM_PYTHON} -c "{INDEX}" {" ".join(packages)}').split()
    assert paths == [str(install / name / "share" / name) for name in packages]
    main_file = workspace.share / "urdf/rover.urdf.yaml"
    expanded = workspace.sourced(f"{YAMARO} -q --meshes package:// {main_file}")
    assert expanded == (workspace.share / "urdf/rover.urdf").read_text()
    files = workspace.sourced(f"{YAMARO} -q --deps {main_file}").split()
    assert all(file.startswith(f"{install}/") for file in files)


def test_versions_agree() -> None:
    (plain,) = re.findall(r"^[\d.]+", __version__)  # a package of ROS has no candidates
    for name, pattern in (
        ("package.xml", "<version>(.*)</version>"),
        ("setup.py", 'version="(.*)"'),
    ):
        assert re.findall(pattern, (PACKAGE / name).read_text()) == [plain]


def test_every_file_of_the_package_is_installed() -> None:
    """So none is forgotten in setup.py."""
    setup = (PACKAGE / "setup.py").read_text()
    for folder in ("cmake", "launch", "rviz"):
        for path in (PACKAGE / folder).iterdir():
            is_of_pip = path.name == "yamaro-config.cmake"
            assert (f'"{folder}/{path.name}"' in setup) != is_of_pip


def test_the_configuration_of_rviz_is_yaml_with_the_topic_of_the_robot() -> None:
    displays = yaml.safe_load((PACKAGE / "rviz/display.rviz").read_text())["Visualization Manager"]
    robot = next(each for each in displays["Displays"] if each["Name"] == "RobotModel")
    assert robot["Description Topic"]["Value"] == "/robot_description"
