"""xacro's expressions are Python: what becomes of them in files that are not trusted."""

from __future__ import annotations

from pathlib import Path

import pytest

import yamaro
from yamaro import Policy, YamaroError
from yamaro.commands.main import main
from yamaro.diagnostics import Diagnostic
from yamaro.sandbox import jail

needs_jail = pytest.mark.skipif(jail.check_available() is not None, reason="no jail here")

ROBOT = "robot: r\nmodel:\n  include: arm.xacro\n"
HEAD = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">\n'


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Have a secret beside the folder of the robot."""
    (tmp_path / "robot").mkdir()
    monkeypatch.chdir(tmp_path / "robot")
    monkeypatch.setenv("SECRET", "s3cret")
    Path("../secret.xacro").write_text('<robot><link name="s3cret"/></robot>')
    Path("../secret.yaml").write_text("s3cret: 1\n")
    Path("robot.yaml").write_text(ROBOT)
    return tmp_path


def built(body: str, mode: str) -> str:
    """Return what a robot becomes that includes a xacro file with this in it."""
    Path("arm.xacro").write_text(f"{HEAD}{body}\n</robot>\n")
    return yamaro.build("robot.yaml", policy=Policy(mode)).xml()


def refusal(body: str, mode: str) -> Diagnostic:
    with pytest.raises(YamaroError) as caught:
        built(body, mode)
    return caught.value.diagnostics[0]


@needs_jail
@pytest.mark.parametrize("mode", ["safe", "jail", "trusted"])
def test_expressions_give_the_same_in_every_mode(mode: str) -> None:
    assert '<link name="arm_3"/>' in built('  <link name="arm_${1 + 2}"/>', mode)


def no_jail(*_: object, **__: object) -> bytes:
    raise jail.JailUnavailable("a container is in the way")


@pytest.mark.parametrize(
    ("name", "value"),
    [("check_available", lambda: "the jail needs Linux"), ("run_jailed", no_jail)],
    ids=["the system has none", "it cannot be set up"],
)
def test_safe_mode_without_a_jail_refuses_them(
    name: str, value: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(jail, name, value)
    body = "  ${xacro.fatal('this was run')}"
    told = refusal(body, "safe")
    assert told.code == "unsafe-code"
    assert told.span.place() == "robot.yaml:3:12"
    Path("arm.urdf").write_text(f"{HEAD}{body}\n</robot>\n")  # xacro by what is in it
    Path("robot.yaml").write_text(ROBOT.replace(".xacro", ".urdf"))
    assert refusal("", "safe").code == "unsafe-code"


def test_check_refuses_them_without_a_jail(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(jail, "check_available", lambda: "the jail needs Linux")
    Path("arm.xacro").write_text(f'{HEAD}  <link name="a"/>\n</robot>\n')
    assert main(["check", "robot.yaml"]) == 1
    assert capsys.readouterr().err == (
        "error[unsafe-code]: "
        "xacro expressions are Python, which safe mode runs only in a jail\n"
        " --> robot.yaml:3:12\n"
        "  |\n"
        "3 |   include: arm.xacro\n"
        "  |            ^^^^^^^^^\n"
        "  = hint: this system has no jail; use --trust if you trust the source of the file\n"
        "\nrobot.yaml: 1 error\n"
    )


def test_a_plain_urdf_needs_no_jail(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(jail, "check_available", lambda: "the jail needs Linux")
    Path("arm.urdf").write_text('<robot><link name="a"/></robot>')
    Path("robot.yaml").write_text(ROBOT.replace(".xacro", ".urdf"))
    assert '<link name="a"/>' in yamaro.build("robot.yaml", policy=Policy("safe")).xml()


@needs_jail
def test_safe_mode_shows_no_environment() -> None:
    assert refusal('  <link name="$(env SECRET)"/>', "safe").code == "unset-environment"
    made = built('  <link name="$(optenv SECRET none)"/>', "safe")
    assert '<link name="none"/>' in made


@needs_jail
@pytest.mark.parametrize("mode", ["safe", "jail"])
@pytest.mark.parametrize(
    "body",
    [
        '<xacro:include filename="../secret.xacro"/>',
        '<xacro:include filename="../secret.xacro" optional="true"/>',
        "<link name=\"${list(xacro.load_yaml('../secret.yaml'))[0]}\"/>",
    ],
)
def test_files_elsewhere_are_out_of_reach(body: str, mode: str) -> None:
    assert refusal(body, mode).code == "path-outside"


@needs_jail
@pytest.mark.parametrize("mode", ["safe", "jail"])
def test_a_pattern_finds_nothing_elsewhere(mode: str) -> None:
    made = built('<xacro:include filename="../*.xacro"/><link name="a"/>', mode)
    assert made == '<?xml version="1.0"?>\n<robot name="r">\n  <link name="a"/>\n</robot>\n'
