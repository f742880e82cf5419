"""Tests of `$(yamaro FILE)` against a stand-in of `launch`; see `stand_in.py`."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from lxml import etree

from tests.ros import stand_in
from tests.ros.stand_in import Given, Logger, SubstitutionFailure

ROBOT = """\
robot: arm
arguments: {length: 1.0, side: left}
model:
- link/name=$(side): {visual: {geometry: {box/size=$(length * 2) 1 1: }}}
- print: built
"""


@pytest.fixture
def logger() -> Logger:
    return Logger()


@pytest.fixture
def exposed() -> dict[str, Any]:
    return {}


@pytest.fixture
def substitutions(
    monkeypatch: pytest.MonkeyPatch, logger: Logger, exposed: dict[str, Any]
) -> Iterator[ModuleType]:
    for name, module in stand_in.modules(logger, exposed).items():
        monkeypatch.setitem(sys.modules, name, module)
    monkeypatch.delitem(sys.modules, "yamaro_ros.substitutions", raising=False)
    yield importlib.import_module("yamaro_ros.substitutions")
    sys.modules.pop("yamaro_ros.substitutions", None)


@pytest.fixture
def robot(tmp_path: Path) -> str:
    path = tmp_path / "robot.yaml"
    path.write_text(ROBOT)
    return str(path)


def link_and_size(xml: str) -> tuple[str, str]:
    """Return the name of the link, and the size of its box."""
    link = etree.fromstring(xml.encode()).find("link")
    return link.get("name"), link.find(".//box").get("size")


def test_values_keep_their_types_and_substitutions_are_read_as_on_the_command_line(
    substitutions: ModuleType, robot: str
) -> None:
    named = substitutions.Yamaro([Given(robot)], {"length": 2, "side": "1.0"})
    assert link_and_size(named.perform(None)) == ("1.0", "4 1 1")
    given = substitutions.Yamaro(robot, {"length": Given("2.5"), "side": ["r", Given("ight")]})
    assert link_and_size(given.perform(None)) == ("right", "5.0 1 1")
    split = substitutions.Yamaro(robot, arguments="length:=3 'side:=a b' --safe")
    assert link_and_size(split.perform(None)) == ("a b", "6 1 1")


def test_front_ends_of_launch_know_it_as_yamaro(
    substitutions: ModuleType, exposed: dict[str, Any], robot: str
) -> None:
    """So XML writes `$(yamaro FILE 'length:=4' --safe)`: launch gives lists of substitutions."""
    data = [[Given(robot)], [Given("length:="), Given("4")], [Given("--safe")]]
    cls, kwargs = exposed["yamaro"].parse(data)
    assert link_and_size(cls(**kwargs).perform(None)) == ("left", "8 1 1")
    with pytest.raises(ValueError, match="needs a file"):
        exposed["yamaro"].parse([])


def test_a_bad_robot_raises_the_error_of_launch_with_place_and_hint(
    substitutions: ModuleType, robot: str, logger: Logger
) -> None:
    Path(robot).write_text(ROBOT.replace("length * 2", "lenght * 2") + "- note: ${old}\n")
    with pytest.raises(SubstitutionFailure) as caught:
        substitutions.Yamaro(robot).perform(None)
    text = str(caught.value)
    assert f"{robot} cannot be built:\nerror[undefined-name]: name 'lenght' is not defined" in text
    assert f" --> {robot}:4:" in text
    assert "hint: did you mean 'length'?" in text
    assert "warning" not in text
    assert [level for level, _ in logger.lines] == ["warning"]


def test_warnings_and_prints_go_to_the_logger(
    substitutions: ModuleType, robot: str, logger: Logger
) -> None:
    Path(robot).write_text(ROBOT + "- note: ${old}\n")
    assert "<note>" in substitutions.Yamaro(robot).perform(None)
    assert logger.lines[0] == ("info", "built")
    assert logger.lines[1][0] == "warning"
    assert f" --> {robot}:6:" in logger.lines[1][1]
    with pytest.raises(SubstitutionFailure, match="error"):
        substitutions.Yamaro(robot, strict=True).perform(None)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--saef"], "'--saef' is neither name:=value nor an option; options: --trust, --jail"),
        (["--to"], "'--to' needs a value"),
        (["--to=mjcf"], "the format is one of urdf, sdf, srdf, not 'mjcf'"),
        (["lenght:=1"], "did you mean 'length'"),
        (["length:=["], "length:=["),
    ],
)
def test_wrong_words_are_explained(
    substitutions: ModuleType, robot: str, words: list[str], told: str
) -> None:
    with pytest.raises(SubstitutionFailure) as caught:
        substitutions.Yamaro(robot, words=words).perform(None)
    assert told in str(caught.value)


def test_wrong_arguments_are_explained(substitutions: ModuleType, robot: str) -> None:
    for options, told in (
        ({"trust": "safely"}, "trust is one of trust, jail, safe, not 'safely'"),
        ({"arguments": "'a"}, "cannot be split into words: No closing quotation"),
    ):
        with pytest.raises(SubstitutionFailure, match=told):
            substitutions.Yamaro(robot, **options).perform(None)
    with pytest.raises(SubstitutionFailure, match=r"missing\.yaml"):
        substitutions.Yamaro(f"{robot}/../missing.yaml").perform(None)


def test_a_file_that_ends_python_does_not_end_launch(substitutions: ModuleType, robot: str) -> None:
    Path(robot).write_text("robot: a\nmodel:\n- process: 'raise SystemExit(0)'\n- link/name=a:\n")
    with pytest.raises(SubstitutionFailure):
        substitutions.Yamaro(robot).perform(None)


def test_safe_mode_refuses_python_modules(substitutions: ModuleType, robot: str) -> None:
    Path(robot).write_text("robot: a\nimport: os\nmodel:\n- link/name=a:\n")
    with pytest.raises(SubstitutionFailure, match=r"error\[unsafe-code\]"):
        substitutions.Yamaro(robot, trust="safe").perform(None)
    assert "<link" in substitutions.Yamaro(robot).perform(None)


def test_other_formats_and_meshes(substitutions: ModuleType, robot: str, tmp_path: Path) -> None:
    assert "<sdf" in substitutions.Yamaro(robot, words=["--to", "sdf"]).perform(None)
    (tmp_path / "package.xml").write_text("<package><name>arm_description</name></package>")
    (tmp_path / "a.stl").write_text("solid a\nendsolid a\n")
    Path(robot).write_text(
        "robot: a\nmodel: {link/name=a: {visual: {geometry: {mesh/filename=a.stl: }}}}\n"
    )
    assert '"package://arm_description/a.stl"' in substitutions.Yamaro(robot).perform(None)
    assert '"a.stl"' in substitutions.Yamaro(robot, meshes="keep").perform(None)


def test_it_describes_itself_by_its_file(substitutions: ModuleType) -> None:
    assert substitutions.Yamaro("a.yaml").describe() == "Yamaro('a.yaml')"
