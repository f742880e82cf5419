"""URDF and xacro as the main file."""

from pathlib import Path

import pytest

from yamaro import Build, UsageError, YamaroError, build, convert, load
from yamaro.commands.main import main
from yamaro.options import Options
from yamaro.policy import Policy
from yamaro.rebuilding import Rebuilder
from yamaro.sandbox import jail
from yamaro.source import Source
from yamaro.xml.reader import XmlReader, read_xml
from yamaro.xml.writer import write

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
    return build(path, command_line=arguments, policy=Policy(mode))


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


def test_a_urdf_is_compiled_to_itself(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "robot.urdf"
    path.write_text(URDF)
    assert main([str(path)]) == 0
    captured = capsys.readouterr()
    first = captured.out
    assert captured.err == ""
    assert '<parent link="a"/>' in first
    path.write_text(first)
    assert main([str(path), "-o", str(tmp_path / "again.urdf")]) == 0
    assert (tmp_path / "again.urdf").read_text() == first


@pytest.mark.parametrize("words", [[], ["--jail"], ["--safe"]])
@needs_jail
def test_a_robot_in_xacro_is_compiled(
    words: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, output = tmp_path / "robot.urdf.xacro", tmp_path / "robot.urdf"
    path.write_text(XACRO)
    assert main([*words, str(path), "-o", str(output), "last:=hand"]) == 0
    assert capsys.readouterr().err == ""
    text = output.read_text()
    assert '<link name="hand"/>' in text
    assert "xacro" not in text


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("world.xml", '<world name="w"><gravity>0 0 -9.8</gravity></world>'),
        ("UPPER.URDF", '<robot name="r"><link name="a"/></robot>'),
    ],
)
def test_other_xml_is_compiled_to_itself(
    name: str, text: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / name).write_text(text)
    assert main([str(tmp_path / name)]) == 0
    captured = capsys.readouterr()
    assert (captured.out, captured.err) == (
        write(read_xml(Source(text, name=name)).root),
        "",
    )


def test_convert_and_load_take_urdf_and_xacro(tmp_path: Path) -> None:
    urdf, xacro = tmp_path / "robot.urdf", tmp_path / "robot.xacro"
    urdf.write_text(URDF)
    xacro.write_text(XACRO)
    assert '<child link="b"/>' in convert(urdf)
    assert '<child link="c"/>' in convert(xacro, "last:=c")
    assert '<child link="d"/>' in convert(xacro, last="d")
    program = load(xacro)
    assert [program.convert(last=name).count(name) for name in ("hand", "foot")] == [3, 3]
    assert program.build(command_line=["last:=z"]).xml() == program.convert("last:=z")


def test_load_tells_what_is_wrong_with_xml(tmp_path: Path) -> None:
    path = tmp_path / "robot.xacro"
    path.write_text("<robot>")
    with pytest.raises(YamaroError, match="no element found"):
        load(path)


@pytest.mark.parametrize("name", ["robot.xacro", "robot.urdf"])
def test_a_robot_in_xacro_is_parsed_once_a_build(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    read, texts = XmlReader.read, []

    def counted(reader: XmlReader) -> object:
        texts.append(reader._source.text)
        return read(reader)

    monkeypatch.setattr(XmlReader, "read", counted)
    opened(tmp_path / name, XACRO)
    assert texts == [XACRO]
    (tmp_path / "robot.yaml").write_text(f"robot: r\nmodel:\n- include: {name}\n")
    build(tmp_path / "robot.yaml")
    assert texts == [XACRO, XACRO]


def test_a_urdf_that_only_mentions_xacro_is_read_as_it_is(tmp_path: Path) -> None:
    text = (
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro"><!-- made by xacro:expand -->'
        '<link name="a"><note><![CDATA[<b> $5]]></note></link></robot>'
    )
    xml = opened(tmp_path / "robot.urdf", text).xml()
    assert "<note>&lt;b&gt; $5</note>" in xml
    as_ever = opened(tmp_path / "robot.urdf", text.replace("xacro:", "xacro."))
    assert as_ever.xml() == xml.replace("xacro:", "xacro.")


def test_an_argument_that_a_xacro_file_does_not_know_is_warned_of(tmp_path: Path) -> None:
    path = tmp_path / "r.xacro"
    path.write_text(
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">'
        '<xacro:arg name="side" default="left"/><link name="$(arg side)"/></robot>'
    )
    built = build(path, command_line=["side:=right", "sied:=up"])
    assert '<link name="right"/>' in built.xml()
    (warning,) = built.warnings
    assert warning.message == "'r.xacro' has no argument 'sied'"
    assert warning.hint == "did you mean 'side'?"


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ('<model name="m"/>', "this is SDF, not URDF: its root is 'model'"),
        ('<Robot name="r"/>', "this is not URDF: its root is 'Robot'"),
    ],
)
def test_another_format_that_is_called_urdf_is_warned_of(
    tmp_path: Path, text: str, what: str
) -> None:
    (warning,) = opened(tmp_path / "m.urdf", text).warnings
    assert (warning.code, warning.message) == ("not-urdf", what)
    assert opened(tmp_path / "m.xml", text).warnings == []


def test_a_robot_in_xacro_is_watched(tmp_path: Path) -> None:
    path = tmp_path / "robot.urdf.xacro"
    path.write_text(XACRO)
    rebuilder = Rebuilder(
        str(path),
        Options(
            policy=Policy(),
            command_line=["last:=hand"],
            on_message=lambda line: None,
        ),
    )
    first = rebuilder.build().build
    assert first is not None and '<link name="hand"/>' in first.xml()
    path.write_text(XACRO.replace('"a"', '"base"'))
    assert rebuilder.has_changed()
    second = rebuilder.build().build
    assert second is not None and '<link name="base"/>' in second.xml()


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_a_main_file_under_another_ending_was_read_as_yaml(encoding: str, tmp_path: Path) -> None:
    path = tmp_path / "two.robot"
    path.write_bytes(URDF.encode(encoding))
    assert build(path).xml() == opened(tmp_path / "two.urdf", URDF).xml()


def test_xml_on_standard_input_was_read_as_yaml(tmp_path: Path) -> None:
    assert build("-", text=URDF).xml() == opened(tmp_path / "two.urdf", URDF).xml()


@pytest.mark.parametrize(("name", "text"), [("robot.xacro", XACRO), ("robot.urdf", URDF)])
def test_a_misspelt_keyword_for_a_main_file_in_xml_is_warned_of(
    tmp_path: Path, name: str, text: str
) -> None:
    (tmp_path / name).write_text(text)
    (warning,) = build(tmp_path / name, variables={"lsat": "hand"}).warnings
    assert (warning.code, warning.span.written()) == ("unknown-variable", "lsat")


def test_a_keyword_that_a_main_file_in_xacro_knows_is_not_warned_of(tmp_path: Path) -> None:
    (tmp_path / "robot.xacro").write_text(XACRO)
    built = build(tmp_path / "robot.xacro", variables={"last": "hand"})
    assert (built.warnings, links(built)) == ([], ["a", "hand"])
