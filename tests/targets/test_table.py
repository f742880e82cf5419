"""The table of targets: whatever lists the output formats lists those in it."""

from __future__ import annotations

import re
import sys
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

import pytest

from yamaro.codes import LOSSES
from yamaro.commands.command_table import BUILD
from yamaro.commands.main import main
from yamaro.commands.option_table import OPTIONS, help_of
from yamaro.sandbox import jail
from yamaro.syntax.names import RAW_BLOCKS
from yamaro.targets.holding import FORMATS
from yamaro.targets.output import MARK, Output
from yamaro.targets.table import BASES, OLDEST_MUJOCO, TARGETS, Target

if TYPE_CHECKING:
    from yamaro.model.robot import Robot
    from yamaro.targets.output import Wanted

ROOT = Path(__file__).parents[2]
in_jail = pytest.mark.skipif(jail.check_available() is not None, reason="there is no jail here")


@pytest.mark.parametrize("name", TARGETS)
def test_each_target_is_a_package_with_a_writer(name: str) -> None:
    if name == "usd":
        pytest.importorskip("pxr")
    assert callable(import_module(f"yamaro.targets.{name}.writer").write)


def test_each_folder_of_targets_is_in_the_table() -> None:
    folders = {path.parent.name for path in (ROOT / "src/yamaro/targets").glob("*/writer.py")}
    assert folders == set(TARGETS)


@pytest.mark.parametrize(
    ("page", "row"),
    [
        ("docs/cli.md", r"^\| `--to FORMATS` \|.*?outputs\.md\): (.*?), separated"),
        ("docs/api.md", r'^\| `target="mjcf"` \|.*?outputs\.md\): (.*?), or a list'),
        ("docs/cmake.md", r"^\| `TO` \|.*?outputs\.md\): (.*?) \|$"),
        ("docs/cheat-sheet.md", r"^\| `yamaro r\.yaml --to mjcf -o r\.xml` \| (.*?) \|$"),
    ],
)
def test_the_docs_list_the_targets(page: str, row: str) -> None:
    found = re.search(row, (ROOT / page).read_text(encoding="utf-8"), re.MULTILINE)
    assert found is not None
    formats = [
        each.name for each in TARGETS.values() if page != "docs/cmake.md" or not each.is_folder
    ]
    assert re.findall(r"`\"?(\w+)\"?`", found[1]) == formats


def test_the_page_of_output_formats_says_what_their_files_are_called() -> None:
    page = (ROOT / "docs/outputs.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `(\w+)` \|.*\| `NAME(\S+)`", page, re.MULTILINE)
    assert dict(rows) == {each.name: each.ending for each in TARGETS.values()}


def test_options_list_the_targets_and_what_can_be_chosen_for_them() -> None:
    assert f"formats: {', '.join(TARGETS)}, separated" in " ".join(help_of(BUILD).split())
    assert OPTIONS["sdf-version"].choices == TARGETS["sdf"].versions
    oldest = ".".join(map(str, OLDEST_MUJOCO))
    assert f"{oldest} or newer" in OPTIONS["mujoco-version"].help
    assert OPTIONS["base"].choices == BASES


def test_blocks_and_losses_are_of_targets() -> None:
    assert set(RAW_BLOCKS) <= set(TARGETS)
    assert {code.partition("-in-")[2] for code in LOSSES} <= set(TARGETS)
    assert {f"lost-in-{format}" for format in FORMATS} <= LOSSES


def test_a_target_belongs_to_another_or_to_itself() -> None:
    assert {each.run for each in TARGETS.values()} <= set(TARGETS)
    assert all(TARGETS[each.run].run == each.run for each in TARGETS.values())


def test_files_beside_a_document_are_those_of_its_format() -> None:
    assert TARGETS["mjcf"].may_hold("scene.xml")
    assert TARGETS["mjcf"].may_hold("assets/arm-12.stl")
    assert not TARGETS["sdf"].may_hold("scene.xml")
    assert not TARGETS["mjcf"].may_hold("../scene.xml")


# --- formats that are not XML, or not one file -------------------------------------------------


@pytest.fixture
def _others(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Have a format `list` that is a text, and a format `package` that is a folder."""

    def write(robot: Robot, wanted: Wanted) -> Output:
        text = f"{MARK}: {' '.join(robot.links)}\n"
        if wanted.format == "list":
            return Output(None, text=text)
        return Output(None, files={"package.xml": text.encode(), "config/links": text.encode()})

    list_target = Target("list", "a list", ".txt", comment="", run="urdf")
    package = Target("package", "a package", "_config", run="urdf", is_folder=True)
    for target in (list_target, package):
        monkeypatch.setitem(TARGETS, target.name, target)
        module = ModuleType(f"yamaro.targets.{target.name}.writer")
        module.write = write  # type: ignore[attr-defined]
        monkeypatch.setitem(sys.modules, module.__name__, module)
    monkeypatch.chdir(tmp_path)
    Path("arm.yaml").write_text("robot: arm\nmodel:\n- link/name=base:\n", encoding="utf-8")


@pytest.mark.usefixtures("_others")
@pytest.mark.parametrize("trust", [[], pytest.param(["--jail"], marks=in_jail)])
def test_a_format_can_be_a_text(trust: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*trust, "arm.yaml", "--to", "list"]) == 0
    assert capsys.readouterr().out == f"{MARK}: base\n"
    for _ in range(2):
        assert main([*trust, "arm.yaml", "--to", "list,urdf", "-o", "out/"]) == 0
    assert Path("out/arm.txt").read_text() == f"{MARK}: base\n"


@pytest.mark.usefixtures("_others")
@pytest.mark.parametrize("trust", [[], pytest.param(["--jail"], marks=in_jail)])
def test_a_format_can_be_a_folder(trust: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    for _ in range(2):
        assert main([*trust, "arm.yaml", "--to", "package", "-o", "out"]) == 0
    files = {str(path.relative_to("out")) for path in Path("out").rglob("*") if path.is_file()}
    assert files == {"arm_config/package.xml", "arm_config/config/links"}
    Path("out/arm_config/package.xml").write_text("mine")
    assert main([*trust, "arm.yaml", "--to", "package,urdf", "-o", "out"]) == 2
    assert "does not say that Yamaro has generated it" in capsys.readouterr().err
    assert Path("out/arm_config/package.xml").read_text() == "mine"


@pytest.mark.usefixtures("_others")
def test_a_format_that_is_a_folder_needs_one(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["arm.yaml", "--to", "package"]) == 2
    assert "a package needs a folder: -o out/" in capsys.readouterr().err
    Path("there").touch()
    assert main(["arm.yaml", "--to", "package", "-o", "there"]) == 2
    assert "'there' is a file, and a package needs a folder" in capsys.readouterr().err
