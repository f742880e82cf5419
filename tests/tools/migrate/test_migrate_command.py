"""`yamaro migrate`: what it reads and writes, what it says, and its exit status."""

from __future__ import annotations

import io
import os
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from tests.same_robot import is_same_robot
from tests.waiting import PATIENCE
from yamaro import api
from yamaro.commands.main import main
from yamaro.commands.reports import usage_told
from yamaro.model.compare import Difference
from yamaro.tools.migrate.urdf import Migration, report
from yamaro.xml.tree import Element

URDF = """\
<?xml version="1.0"?>
<robot name="arm">
  <link name="base"/>
  <joint name="tip_joint" type="fixed">
    <parent link="base"/>
    <child link="tip_link"/>
    <origin xyz="0 0 1" rpy="0 0 0"/>
  </joint>
  <link name="tip_link"/>
</robot>
"""
YAML = """\
robot: arm
model:
  link/name=base:
  part: {name: tip, joint: {type: fixed, parent: base, xyz: 0 0 1}}
"""
USAGE = usage_told("migrate") + "\n"


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("arm.urdf").write_text(URDF)
    return tmp_path


def outcome(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    """Run the command; return exit status, standard output and error."""
    status = main(["migrate", *words])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def give(monkeypatch: pytest.MonkeyPatch, data: bytes) -> None:
    """Put this into standard input."""
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data)))


# --- where it goes --------------------------------------------------------------------------------


def test_the_source_goes_to_standard_output(capsys: pytest.CaptureFixture[str]) -> None:
    told = "arm.urdf: identical: 2 links, 1 joint\n"
    assert outcome(capsys, "arm.urdf") == (0, YAML, told)


def test_the_source_goes_to_a_file(capsys: pytest.CaptureFixture[str]) -> None:
    told = "arm.urdf: identical: 2 links, 1 joint\n"
    assert outcome(capsys, "arm.urdf", "-o", "new/arm.yaml") == (0, "", told)
    assert Path("new/arm.yaml").read_text() == YAML


def test_what_the_source_makes_is_what_it_came_from(capsys: pytest.CaptureFixture[str]) -> None:
    outcome(capsys, "arm.urdf", "-o", "arm.yaml")
    assert is_same_robot(URDF.encode(), api.convert("arm.yaml").encode())


def test_quiet_says_nothing_if_all_is_well(capsys: pytest.CaptureFixture[str]) -> None:
    assert outcome(capsys, "-q", "arm.urdf") == (0, YAML, "")


def test_a_file_that_is_there_is_not_replaced(capsys: pytest.CaptureFixture[str]) -> None:
    Path("arm.yaml").write_text("mine\n")
    told = f"yamaro: error: 'arm.yaml' already exists; --force replaces it\n{USAGE}"
    assert outcome(capsys, "arm.urdf", "-o", "arm.yaml") == (2, "", told)
    assert Path("arm.yaml").read_text() == "mine\n"


def test_force_replaces_it(capsys: pytest.CaptureFixture[str]) -> None:
    Path("arm.yaml").write_text("mine\n")
    assert outcome(capsys, "arm.urdf", "-q", "-o", "arm.yaml", "--force") == (0, "", "")
    assert Path("arm.yaml").read_text() == YAML


@pytest.mark.parametrize("output", ["-", "/dev/stdout", "/dev/null"])
def test_what_is_no_regular_file_needs_no_force(
    output: str, capsys: pytest.CaptureFixture[str]
) -> None:
    status, out, err = outcome(capsys, "-q", "arm.urdf", "-o", output)
    assert (status, out, err) == (0, "" if output == "/dev/null" else YAML, "")


def test_the_file_itself_is_never_replaced(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = outcome(capsys, "arm.urdf", "-o", "./arm.urdf", "--force")
    assert (status, out) == (2, "")
    assert err.startswith("yamaro: error: the output './arm.urdf' is one of the input files")
    assert Path("arm.urdf").read_text() == URDF


def test_a_place_that_cannot_be_written_to_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    Path("file").write_text("")
    status, out, err = outcome(capsys, "arm.urdf", "-o", "file/arm.yaml")
    assert (status, out) == (1, "")
    assert err.startswith("yamaro: error: cannot write 'file/arm.yaml': ")


# --- where it comes from --------------------------------------------------------------------------


def test_standard_input_is_read(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    give(monkeypatch, URDF.encode())
    told = "<standard input>: identical: 2 links, 1 joint\n"
    assert outcome(capsys, "-") == (0, YAML, told)


@pytest.mark.parametrize("mode", ["--safe", "--trust"])
def test_a_robot_in_xacro_from_standard_input_is_refused(
    mode: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    robot = (
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
        '<xacro:property name="n" value="a"/><link name="${n}"/></robot>'
    )
    give(monkeypatch, robot.encode())
    status, out, err = outcome(capsys, mode, "-")
    told = "yamaro: error: a robot in xacro is migrated from a file, not from a pipe\n"
    if mode == "--safe" and "unsafe-code" in err:  # there is no jail
        assert (status, out) == (1, "")
    else:
        assert (status, out, err) == (2, "", told + USAGE)


def test_closed_standard_input_is_told(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "stdin", None)
    told = f"yamaro: error: standard input is closed\n{USAGE}"
    assert outcome(capsys, "-") == (2, "", told)


def test_standard_input_that_cannot_be_read_is_told(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    class Broken(io.RawIOBase):
        def read(self, size: int = -1) -> bytes:
            raise OSError(5, "Input/output error")

    class Stream:
        buffer = Broken()

    monkeypatch.setattr(sys, "stdin", Stream())
    told = f"yamaro: error: cannot read standard input: Input/output error\n{USAGE}"
    assert outcome(capsys, "-") == (2, "", told)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no named pipes")
def test_a_named_pipe_is_read(capsys: pytest.CaptureFixture[str]) -> None:
    os.mkfifo("pipe")
    writer = threading.Thread(target=lambda: Path("pipe").write_text(URDF))
    writer.start()
    status, out, _ = outcome(capsys, "pipe")
    writer.join()
    assert (status, out) == (0, YAML)


@pytest.mark.parametrize("path", ["-", "arm.urdf"])
def test_a_file_may_be_too_large(
    path: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    give(monkeypatch, URDF.encode())
    status, out, err = outcome(capsys, path, "--limit", "file=100")
    assert (status, out) == (1, "")
    assert err.startswith("error[limit-file]: the file cannot be read: it has more than 100 bytes")


@pytest.mark.parametrize(
    ("path", "problem"),
    [("leg.urdf", "the file does not exist"), (".", "it is a folder")],
)
def test_what_cannot_be_read_is_wrong_usage(
    path: str, problem: str, capsys: pytest.CaptureFixture[str]
) -> None:
    told = f"yamaro: error: cannot read '{path}': {problem}\n{USAGE}"
    assert outcome(capsys, path) == (2, "", told)


def test_an_empty_file_name_is_wrong_usage(capsys: pytest.CaptureFixture[str]) -> None:
    assert outcome(capsys, "") == (2, "", f"yamaro: error: the file name is empty\n{USAGE}")


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        ([], "'yamaro migrate' needs a FILE"),
        (["arm.urdf", "leg.urdf"], "unexpected argument 'leg.urdf' after 'arm.urdf'"),
        (["arm.urdf", "n:=1"], "a URDF has no argument to set: 'n:=1'"),
        (["arm.urdf", "--strict"], "'--strict' cannot be used with 'yamaro migrate'"),
        (["arm.urdf", "--jail", "--safe"], "'--jail' and '--safe' cannot be combined"),
    ],
)
def test_wrong_usage_is_told(
    words: list[str], problem: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert outcome(capsys, *words) == (2, "", f"yamaro: error: {problem}\n{USAGE}")


def test_force_is_for_migrate_only(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--force", "arm.yaml"]) == 2
    told = f"yamaro: error: '--force' cannot be used with 'yamaro FILE'\n{usage_told('build')}\n"
    assert capsys.readouterr().err == told


@pytest.mark.parametrize(
    ("encoding", "declared"),
    [
        ("utf-16", "UTF-16"),
        ("utf-8-sig", "UTF-8"),
        ("latin-1", "ISO-8859-1"),
        ("cp1252", "windows-1252"),
    ],
)
def test_a_file_may_be_in_other_encodings(
    encoding: str, declared: str, capsys: pytest.CaptureFixture[str]
) -> None:
    xml = f'<?xml version="1.0" encoding="{declared}"?>\n<!-- für Zoë -->\n<robot name="grün"/>\n'
    Path("arm.urdf").write_bytes(xml.encode(encoding))
    status, out, err = outcome(capsys, "-q", "arm.urdf", "-o", "arm.yaml")
    assert (status, out, err) == (0, "", "")
    assert Path("arm.yaml").read_bytes().decode() == "# für Zoë\nrobot: grün\nmodel:\n"


def test_line_ends_of_windows_do_not_come_along(capsys: pytest.CaptureFixture[str]) -> None:
    Path("arm.urdf").write_bytes(URDF.replace("\n", "\r\n").encode())
    assert outcome(capsys, "-q", "arm.urdf") == (0, YAML, "")


def test_no_xml_is_an_error(capsys: pytest.CaptureFixture[str]) -> None:
    Path("arm.urdf").write_text("robot: arm\n")
    told = (
        "error[xml-syntax]: this is not XML\n"
        " --> arm.urdf:1:1\n"
        "  |\n"
        "1 | robot: arm\n"
        "  | ^\n"
        '  = hint: it begins with a tag, such as <robot name="arm">\n'
    )
    assert outcome(capsys, "arm.urdf", "-o", "arm.yaml") == (1, "", told)
    assert not Path("arm.yaml").exists()


def test_an_error_of_standard_input_names_it(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    give(monkeypatch, b"<robot")
    status, out, err = outcome(capsys, "-", "-q")
    assert (status, out) == (1, "")
    assert err.startswith("error[xml-syntax]: this is not well-formed XML: ")
    assert " --> <standard input>:1:" in err


@pytest.mark.parametrize(
    "xml",
    [
        '<scene version="1.7"><model name="a"><link name="b"><at>0 0 1</at></link></model></scene>',
        '<launch><arg name="a" default="1"/><node pkg="p" args="$(find p)/a $(arg a)"/></launch>',
        "<package><name>p</name><depend>a</depend><depend>b</depend></package>",
    ],
)
def test_other_xml_is_brought_over(xml: str, capsys: pytest.CaptureFixture[str]) -> None:
    Path("other.xml").write_text(xml)
    status, out, err = outcome(capsys, "other.xml", "-o", "other.yaml")
    assert (status, out, err) == (0, "", "other.xml: identical\n")
    assert is_same_robot(xml.encode(), api.convert("other.yaml").encode())


def test_differences_are_told_and_fail_though_the_sources_are_written(
    capsys: pytest.CaptureFixture[str],
) -> None:
    Path("arm.xacro").write_text(
        '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
        '  <xacro:macro name="m" params=""><a/></xacro:macro>\n'
        '  <xacro:macro name="use" params=""><xacro:m/></xacro:macro>\n  <xacro:use/>\n'
        '  <xacro:macro name="m" params=""><b/></xacro:macro>\n  <xacro:use/>\n'
        "</robot>\n"
    )
    status, out, err = outcome(capsys, "-q", "arm.xacro", "-o", "arm")
    assert (status, out) == (1, "")
    assert "different: robot 'arm', a: is missing\n" in err
    assert "a/" not in Path("arm/arm.yaml").read_text()


def test_what_has_no_counterpart_in_a_xacro_file_is_told(
    capsys: pytest.CaptureFixture[str],
) -> None:
    Path("arm.xacro").write_text(
        '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
        '  <xacro:property name="reach" value="0.8"/>\n'
        '  <xacro:property name="reach" remove="true"/>\n'
        "</robot>\n"
    )
    status, out, err = outcome(capsys, "arm.xacro", "-o", "arm")
    code = "not-migrated"
    assert (status, out) == (0, "")
    assert err.startswith(f"warning[{code}]: the property 'reach' is removed\n --> arm.xacro:3:4\n")
    assert "# not migrated: " in Path("arm/arm.yaml").read_text()


def test_it_runs_as_a_process_of_its_own() -> None:
    process = subprocess.run(
        [sys.executable, "-m", "yamaro", "migrate", "-"],
        input=URDF.encode(),
        capture_output=True,
        timeout=PATIENCE,
        check=False,
    )
    assert process.returncode == 0
    assert process.stdout.decode() == YAML
    assert process.stderr.decode() == "<standard input>: identical: 2 links, 1 joint\n"


# --- what is said ---------------------------------------------------------------------------------


def told_of(root: str, *children: str, differences: tuple[str, ...] = ()) -> str:
    element = Element(root, None)  # type: ignore[arg-type]
    element.children += [Element(name, None) for name in children]  # type: ignore[arg-type]
    return report(Migration("", element, [Difference(("robot",), text) for text in differences]))


def test_a_report_counts_links_and_joints() -> None:
    assert told_of("robot") == "identical: 0 links, 0 joints"
    assert told_of("robot", "link", "gazebo") == "identical: 1 link, 0 joints"
    many = told_of("robot", *["link"] * 1200, *["joint"] * 2)
    assert many == "identical: 1,200 links, 2 joints"
    assert told_of("sdf", "link") == "identical"


def test_a_report_lists_differences() -> None:
    told = told_of("robot", "link", differences=("one", "two"))
    assert told == "different: robot: one\ndifferent: robot: two"


def test_a_report_counts_the_poses_that_only_the_source_writes_out(
    capsys: pytest.CaptureFixture[str],
) -> None:
    text = URDF.replace(' rpy="0 0 0"', "")
    Path("arm.urdf").write_text(text)
    status, _, told = outcome(capsys, "arm.urdf", "-o", "arm.yaml")
    assert (status, told) == (
        0,
        "arm.urdf: identical: 2 links, 1 joint; 1 default written out\n",
    )
    assert Path("arm.yaml").read_text() == YAML


PREFIXED = """\
<robot name="arm" xmlns:sensor="http://playerstage.sourceforge.net/gazebo">
  <link name="base"/>
  <joint name="tip_joint" type="fixed">
    <parent link="base"/>
    <child link="tip_link"/>
    <origin xyz="0 0 1"/>
  </joint>
  <link name="tip_link"/>
</robot>
"""


@pytest.mark.parametrize("xacro", ["", ' xmlns:xacro="http://www.ros.org/wiki/xacro"'])
def test_exact_keeps_poses_as_they_are(capsys: pytest.CaptureFixture[str], xacro: str) -> None:
    text = PREFIXED.replace("<robot", f"<robot{xacro}")
    if xacro:
        text = text.replace("</robot>", '<xacro:property name="n" value="1"/></robot>')
    Path("arm.urdf").write_text(text)
    for options, is_exact in ((["--exact"], True), ([], False)):
        status, _, told = outcome(capsys, "arm.urdf", "-o", "out", "--force", *options)
        assert status == 0
        assert told.startswith("arm.urdf: identical: 2 links, 1 joint")
        assert ("default written out" in told) is not is_exact
        made = Path("out/arm.yaml") if xacro else Path("out")
        assert ("<origin/xyz=0 0 1>:" in made.read_text()) is is_exact
        assert ("xmlns:sensor" in made.read_text()) is is_exact
        built = api.build(made, on_message=print).xml()
        assert is_same_robot(PREFIXED.encode(), built.encode(), exact=is_exact)


# --- robots that parsers refuse -------------------------------------------------------------------


def test_the_faults_of_a_urdf_are_migrated_too_and_it_is_said_how_to_build_it(
    capsys: pytest.CaptureFixture[str],
) -> None:
    Path("two.urdf").write_text(
        URDF.replace("</robot>", '<link name="b"/><link name="b"/></robot>')
    )
    status, _, told = outcome(capsys, "two.urdf", "-o", "two.yaml")
    allow = "--allow duplicate-link --allow several-roots"
    assert status == 0
    assert told == (
        f"two.urdf: identical: 4 links, 1 joint; parsers refuse it: build it with {allow}\n"
    )
    assert "part: {name: tip" in Path("two.yaml").read_text()
    assert main(["two.yaml", "-o", "out.urdf"]) == 1
    assert main(["two.yaml", "-o", "out.urdf", *allow.split()]) == 0


def test_the_faults_of_a_robot_in_xacro_are_migrated_too(
    capsys: pytest.CaptureFixture[str],
) -> None:
    text = '<robot xmlns:xacro="http://ros.org/wiki/xacro" name="r">{}</robot>'
    macro = '<xacro:macro name="l" params="n"><link name="${n}"/></xacro:macro>'
    Path("two.xacro").write_text(text.format(macro + '<xacro:l n="a"/><xacro:l n="b"/>'))
    status, _, told = outcome(capsys, "two.xacro", "-o", "two")
    assert status == 0
    assert "identical: 2 links, 0 joints; parsers refuse it: build it with" in told
    assert main(["two/two.yaml", "-q", "--allow", "several-roots"]) == 0


def test_sources_are_not_written_through_links_out_of_the_folder(
    tmp_path_factory: pytest.TempPathFactory, capsys: pytest.CaptureFixture[str]
) -> None:
    away = tmp_path_factory.mktemp("away")
    Path("sub").mkdir()
    Path("sub/link.xacro").write_text('<robot><link name="a"/></robot>')
    include = '<xacro:include filename="sub/link.xacro"/>'
    Path("r.xacro").write_text(
        f'<robot xmlns:xacro="http://ros.org/wiki/xacro" name="r">{include}</robot>'
    )
    Path("r.urdf").write_text(URDF)
    Path("out").mkdir()
    Path("out/sub").symlink_to(away)
    Path("out/r.yaml").symlink_to(away / "new.yaml")
    for name in ("r.xacro", "r.urdf"):
        for options in ([], ["--force"]):
            status, _, told = outcome(capsys, name, "-o", "out/", *options)
            assert status == 2
            assert "links lead out of the output folder" in told
    assert list(away.iterdir()) == []
