"""URDF and xacro as the main file of the commands that look at robots."""

from pathlib import Path

import pytest

from yamaro import Build, UsageError, YamaroError, build, jail
from yamaro.commands.main import main
from yamaro.policy import Policy

needs_jail = pytest.mark.skipif(jail.check_available() is not None, reason="no jail here")

URDF = """<?xml version="1.0"?>
<robot name="two">
  <link name="a"/>
  <link name="b"/>
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>
</robot>
"""

XACRO = """<?xml version="1.0"?>
<robot name="chain" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="last" default="b"/>
  <xacro:macro name="hang" params="name">
    <link name="${name}"/>
    <joint name="${name}_joint" type="fixed"><parent link="a"/><child link="${name}"/></joint>
  </xacro:macro>
  <link name="a"/>
  <xacro:hang name="$(arg last)"/>
</robot>
"""


def opened(path: Path, text: str, *arguments: str, mode: str = "trusted") -> Build:
    path.write_text(text)
    return build(path, command_line=arguments, policy=Policy(mode), takes_xml=True)


def links(built: Build) -> list[str]:
    return [str(e.attributes["name"]) for e in built.root.elements() if e.name == "link"]


@pytest.mark.parametrize("mode", ["trusted", "safe"])
def test_a_urdf_is_opened_as_it_is(mode: str, tmp_path: Path) -> None:
    built = opened(tmp_path / "robot.urdf", URDF, mode=mode)
    assert built.root.attributes["name"] == "two"
    assert links(built) == ["a", "b"]
    assert built.files == [str(tmp_path / "robot.urdf")]


@pytest.mark.parametrize("mode", ["trusted", "safe"])
def test_a_link_of_a_urdf_tells_its_line(mode: str, tmp_path: Path) -> None:
    built = opened(tmp_path / "robot.urdf", URDF, mode=mode)
    span = built.root.elements()[1].span
    assert (span.source.path, span.location()[0]) == (str(tmp_path / "robot.urdf"), 4)


@pytest.mark.parametrize("mode", ["trusted", pytest.param("safe", marks=needs_jail)])
def test_a_link_of_a_macro_tells_the_call(mode: str, tmp_path: Path) -> None:
    built = opened(tmp_path / "robot.urdf.xacro", XACRO, "last:=hand", mode=mode)
    assert links(built) == ["a", "hand"]
    hand = built.root.elements()[1]
    assert hand.span.location()[0] == 5
    assert hand.trace is not None
    assert (hand.trace.name, hand.trace.span.location()[0]) == ("xacro:hang", 9)


def test_arguments_of_xacro_are_texts_and_no_yaml(tmp_path: Path) -> None:
    built = opened(tmp_path / "robot.xacro", XACRO, "last:=[b")
    assert links(built) == ["a", "[b"]


def test_a_urdf_is_checked(tmp_path: Path) -> None:
    text = URDF.replace('child link="b"', 'child link="c"')
    codes = [each.code for each in opened(tmp_path / "robot.urdf", text).warnings]
    assert "unknown-child" in codes


def test_a_urdf_has_no_variables_to_set(tmp_path: Path) -> None:
    (warning,) = opened(tmp_path / "robot.urdf", URDF, "length:=3").warnings
    assert warning.code == "unknown-variable"


def test_a_malformed_argument_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="name:=value"):
        opened(tmp_path / "robot.xacro", XACRO, ":=3")


def test_broken_xml_tells_its_place(tmp_path: Path) -> None:
    with pytest.raises(YamaroError) as caught:
        opened(tmp_path / "robot.urdf", "<robot>\n<link></robot>")
    (error,) = caught.value.diagnostics
    assert (error.code, error.span.location()[0]) == ("xml-syntax", 2)


def test_xacro_without_a_jail_asks_for_trust(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("yamaro.confined.has_jail", lambda policy, name: False)
    with pytest.raises(YamaroError, match="use --trust"):
        opened(tmp_path / "robot.xacro", XACRO, mode="safe")


def test_the_tree_of_a_urdf_is_shown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "robot.urdf"
    path.write_text(URDF)
    assert main(["tree", str(path)]) == 0
    assert "2 links, 1 joint" in capsys.readouterr().out


def test_compiling_a_urdf_is_still_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "robot.urdf"
    path.write_text(URDF)
    assert main([str(path)]) == 1
    assert "this looks like XML" in capsys.readouterr().err


def test_an_argument_that_a_xacro_file_does_not_know_is_warned_of(tmp_path: Path) -> None:
    path = tmp_path / "r.xacro"
    path.write_text(
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">'
        '<xacro:arg name="side" default="left"/><link name="$(arg side)"/></robot>'
    )
    built = build(path, command_line=["side:=right", "sied:=up"], takes_xml=True)
    assert '<link name="right"/>' in built.xml()
    (warning,) = built.warnings
    assert warning.message == "'r.xacro' has no argument 'sied'"
    assert warning.hint == "did you mean 'side'?"
