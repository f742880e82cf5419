"""What a file that is not trusted may read: what lies in a folder, and not what is called alike."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from yamaro.files.loader import FileLoader, LoadError
from yamaro.files.packages import PackageFinder
from yamaro.files.readable import Reach, roots_of


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    for name in ("robot", "robot-secrets", "robot2", "robo"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "a.yaml").write_text("a: 1\n")
    (tmp_path / "robot.yaml").write_text("a: 1\n")
    return tmp_path / "robot"


def test_a_folder_and_what_is_in_it_may_be_read(robot: Path) -> None:
    reach = Reach([os.fspath(robot)])
    for path in (robot, robot / "a.yaml", robot / "not" / "there", robot / ".." / "robot"):
        assert reach.allows(os.fspath(path))


@pytest.mark.parametrize(
    "name", ["robot-secrets/a.yaml", "robot2/a.yaml", "robot2", "robot.yaml", "robo/a.yaml", "."]
)
@pytest.mark.parametrize("end", ["", os.sep])
def test_a_folder_whose_name_only_begins_alike_may_not(robot: Path, name: str, end: str) -> None:
    reach = Reach([os.fspath(robot) + end])
    path = os.fspath(robot.parent / name)
    assert not reach.allows(path)
    with pytest.raises(LoadError, match="outside"):
        FileLoader(reach=reach).read(path)


def test_a_single_file_opens_no_file_that_begins_alike(robot: Path) -> None:
    reach = Reach([os.fspath(robot / "a.yaml")])
    assert reach.allows(os.fspath(robot / "a.yaml"))
    assert not reach.allows(os.fspath(robot / "a.yaml.bak"))
    assert not reach.allows(os.fspath(robot))


def test_the_root_opens_everything() -> None:
    reach = Reach([os.sep])
    assert reach.allows(os.sep) and reach.allows(os.path.abspath("a.yaml"))


def test_what_a_link_leads_to_counts(robot: Path) -> None:
    (robot / "out").symlink_to(robot.parent / "robot2")
    (robot.parent / "in").symlink_to(robot)
    reach = Reach([os.fspath(robot.parent / "in")])
    assert reach.allows(os.fspath(robot / "a.yaml"))
    assert not reach.allows(os.fspath(robot / "out" / "a.yaml"))


def test_a_file_of_a_python_package_may_read_that_package_alone(tmp_path: Path) -> None:
    folder = tmp_path / "lib" / "site-packages"
    for name in ("suite/models", "suite/assets", "other", "suites"):
        (folder / name).mkdir(parents=True)
    reach = Reach(roots_of(os.fspath(folder / "suite/models/arm.xml"), (), PackageFinder({})))
    for name, is_allowed in {
        "suite/assets/a.xml": True,
        "suite/models/a.xml": True,
        "other/a.xml": False,
        "suites/a.xml": False,
        "../a.xml": False,
    }.items():
        assert reach.allows(os.fspath(folder / name)) is is_allowed, name
