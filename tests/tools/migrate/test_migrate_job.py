"""`yamaro migrate` of files that are not trusted: what they may do, and what is believed of it."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from yamaro import UsageError, YamaroError, convert
from yamaro.commands.main import main
from yamaro.policy import Policy
from yamaro.sandbox import jail
from yamaro.sandbox.jail.protocol import pack
from yamaro.sandbox.transfer import Outcome, to_bytes
from yamaro.source import Source
from yamaro.tools.migrate.job import Job

needs_jail = pytest.mark.skipif(jail.check_available() is not None, reason="no jail here")

XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
ONE = f"""<robot name="one" {XACRO}>
  <xacro:arg name="side" default="left"/>
  <link name="$(arg side)_hand"/>
</robot>
"""
ESCAPE = (
    "(lambda h: [h.append((h[0].gi_frame.f_back for _ in [1])), [*h[0]][0]][1])([])"
    ".f_back.f_back.f_globals['__builtins__']['__import__']('os')"
)


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def outcome(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    status = main(["migrate", *words])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def ran(command: str) -> str:
    return f'<robot name="r" {XACRO}><link name="a"/><gazebo x="${{{ESCAPE}.{command}}}"/></robot>'


# --- what a file may do ---------------------------------------------------------------------------


@needs_jail
@pytest.mark.parametrize("words", [[], ["--jail"], ["--safe"]])
@pytest.mark.parametrize("name", ["robot.urdf", "robot.xacro"])
@pytest.mark.parametrize("what", ["system('touch RAN')", "mkdir('RAN')", "open('RAN', 64)"])
def test_a_strangers_robot_is_migrated_without_its_rights(
    what: str, name: str, words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    Path(name).write_text(ran(what))
    outcome(capsys, name, "-o", "out/", *words)
    assert not Path("RAN").exists()
    assert not Path("out", "RAN").exists()
    assert sorted(os.listdir()) in ([name], sorted([name, "out"]))


@needs_jail
def test_it_reads_what_a_file_may_read_and_no_more(capsys: pytest.CaptureFixture[str]) -> None:
    os.mkdir("robot")
    Path("secret.xacro").write_text(f'<robot {XACRO}><link name="secret"/></robot>')
    text = f'<robot name="r" {XACRO}><xacro:include filename="../secret.xacro"/></robot>'
    Path("robot/r.xacro").write_text(text)
    status, _, err = outcome(capsys, "robot/r.xacro", "-o", "out/")
    assert status == 1
    assert "error[path-outside]: " in err or "not permitted" in err
    assert not Path("out").exists()
    status, _, err = outcome(capsys, "robot/r.xacro", "-o", "out/", "--allow-path", ".")
    assert (status, "identical: 1 link" in err) == (0, True)


@needs_jail
def test_it_ends_in_time(capsys: pytest.CaptureFixture[str]) -> None:
    Path("r.xacro").write_text(f'<robot name="r" {XACRO}><a b="${{max(range(10**12))}}"/></robot>')
    status, out, err = outcome(capsys, "r.xacro", "--timeout", "0.2")
    assert (status, out) == (1, "")
    assert err.startswith("error[limit-time]: ")


def test_trust_gives_it_all_rights(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(jail, "run_jailed", None)
    monkeypatch.setenv("SIDE", "right")
    Path("r.xacro").write_text(f'<robot name="r" {XACRO}><link name="$(env SIDE)"/></robot>')
    status, out, _ = outcome(capsys, "r.xacro", "--trust")
    assert (status, "SIDE" in out) == (0, True)


@pytest.mark.parametrize("mode", [[], ["--safe"]])
def test_without_a_jail_xacro_asks_for_trust(
    mode: list[str], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(jail, "check_available", lambda: "the jail needs Linux")
    Path("r.xacro").write_text(ONE)
    Path("plain.urdf").write_text('<robot name="r"><link name="$(a)"/></robot>')
    status, out, err = outcome(capsys, "r.xacro", *mode)
    assert (status, out) == (1, "")
    assert "error[unsafe-code]: " in err
    assert "use --trust" in err
    assert outcome(capsys, "r.xacro", "--trust")[0] == 0
    assert outcome(capsys, "plain.urdf", *mode)[0] == 0
    status, _, err = outcome(capsys, "r.xacro", "--jail")
    assert (status, err.startswith("error[no-jail]: ")) == (1, True)


@pytest.mark.parametrize("mode", ["trusted", pytest.param("safe", marks=needs_jail)])
def test_errors_and_wrong_arguments_come_out_of_the_jail(mode: str, folder: Path) -> None:
    path = str(folder / "r.xacro")

    def job(text: str, *arguments: str) -> Job:
        source = Source(text, name="r.xacro", path=path)
        return Job(source, str(folder), arguments=arguments, policy=Policy(mode))

    with pytest.raises(YamaroError) as caught:
        job(f'<robot name="r" {XACRO}><a b="${{c}}"/></robot>').run()
    assert caught.value.diagnostics[0].span.location() == (1, 69)
    with pytest.raises(UsageError, match="a URDF has no argument to set: 'n:=1'"):
        Job(
            Source("<robot/>", name="r.urdf", path=str(folder / "r.urdf")),
            str(folder),
            arguments=["n:=1"],
            policy=Policy(mode),
        ).run()
    assert job(ONE).run().is_same


@needs_jail
def test_a_robot_of_several_packages_is_the_same_with_and_without_a_jail(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("arm", "hand"):
        Path(name).mkdir()
        Path(name, "package.xml").write_text(f"<package><name>{name}</name></package>")
    Path("hand/hand.xacro").write_text(
        f'<robot {XACRO}><xacro:macro name="hand" params="n"><link name="${{n}}"/></xacro:macro>'
        "</robot>"
    )
    Path("arm/d.yaml").write_text("reach: 0.5\n")
    Path("arm/arm.xacro").write_text(
        f'<robot name="arm" {XACRO}><xacro:include filename="$(find hand)/hand.xacro"/>'
        '<xacro:property name="d" value="${xacro.load_yaml(\'d.yaml\')}"/>'
        "<xacro:hand n=\"h${d['reach']}\"/></robot>"
    )
    assert outcome(capsys, "arm/arm.xacro", "-o", "jailed/")[0] == 0
    assert outcome(capsys, "arm/arm.xacro", "-o", "trusted/", "--trust")[0] == 0
    jailed, trusted = (
        {str(p.relative_to(top)): p.read_text() for p in Path(top).rglob("*") if p.is_file()}
        for top in ("jailed", "trusted")
    )
    assert jailed == trusted
    assert len(jailed) >= 2


# --- what is believed of it -----------------------------------------------------------------------


def answer(
    *files: str, main: str = "r.yaml", messages: tuple[str, ...] = ("", "", "same")
) -> bytes:
    said = to_bytes(Outcome(messages=[main, *messages]))
    return pack([said, b"", *[each.encode("utf-8", "surrogatepass") for each in files]])


@needs_jail
@pytest.mark.parametrize(
    "forged",
    [
        lambda: b"",
        lambda: pack([]),
        lambda: pack([to_bytes(Outcome())]),
        lambda: answer(),
        lambda: answer("r.yaml"),
        lambda: answer("s.yaml", "text"),
        lambda: answer("r.yaml", "text", messages=()),
        lambda: answer("r.yaml", "text", "../up.yaml", "text"),
        lambda: answer("r.yaml", "text", "a/../../up.yaml", "text"),
        lambda: answer("r.yaml", "text", "/tmp/up.yaml", "text"),
        lambda: answer("r.yaml", "text", ".bashrc", "text"),
        lambda: answer("r.yaml", "text", ".hidden/a.yaml", "text"),
        lambda: answer("r.yaml", "text", "Makefile", "text"),
        lambda: answer("r.yaml", "text", "a\nb.yaml", "text"),
        lambda: answer("r.yaml", "text", "a\0b.yaml", "text"),
        lambda: answer("r.yaml", "text", "a//b.yaml", "text"),
        lambda: answer("r.yaml", "a \x1b[2J b"),
        lambda: answer("r.yaml", "a \0 b"),
        lambda: answer("r.yaml", "a \ud800 b"),
    ],
)
def test_an_answer_that_lies_is_refused(
    forged: Callable[[], bytes],
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(Job, "_packed", lambda job: forged())
    Path("r.xacro").write_text(ONE)
    status, out, err = outcome(capsys, "r.xacro", "-o", "out/")
    assert (status, out) == (1, "")
    assert err.startswith("error[jail-broken]: ")
    assert os.listdir() == ["r.xacro"]


@needs_jail
def test_what_is_said_of_it_steers_no_terminal(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    lie = answer("r.yaml", "robot: r\n", messages=("fine\x1b[2J", "\x1b]52;c;x\x07", "same"))
    monkeypatch.setattr(Job, "_packed", lambda job: lie)
    Path("r.xacro").write_text(ONE)
    status, _, err = outcome(capsys, "r.xacro", "-o", "out/")
    assert status == 0
    assert "\x1b" not in err
    assert "\x07" not in err


# --- where it goes --------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["one.urdf", "one.urdf.xacro", "one.xacro"])
def test_a_robot_in_one_xacro_file_becomes_one_file(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    Path(name).write_text(ONE)
    status, out, err = outcome(capsys, name, "-o", "burger.yaml", "side:=right")
    assert (status, out, err) == (0, "", f"{name}: identical: 1 link, 0 joints\n")
    assert Path("burger.yaml").is_file()
    assert '<link name="left_hand"/>' in convert("burger.yaml")
    text = Path("burger.yaml").read_text()
    assert outcome(capsys, name, "side:=right") == (0, text, err)
    assert outcome(capsys, "-q", name, "-o", "new/burger.yml", "side:=right") == (0, "", "")
    assert Path("new/burger.yml").read_text() == text
    status, _, err = outcome(capsys, name, "-o", "burger.yaml")
    assert (status, "'burger.yaml' already exists; --force replaces it" in err) == (2, True)
    assert outcome(capsys, "-q", name, "-o", "burger.yaml", "--force", "side:=right")[0] == 0
    assert outcome(capsys, "-q", name, "-o", "burger")[0] == 0
    assert os.listdir("burger") == ["one.yaml"]
    assert outcome(capsys, "-q", name, "-o", "burger.txt", "side:=right")[0] == 0
    assert Path("burger.txt").read_text() == text
    assert outcome(capsys, "-q", name, "-o", "burger_v1.2")[0] == 0
    assert os.listdir("burger_v1.2") == ["one.yaml"]
    os.mkdir("folder.yaml")
    assert outcome(capsys, "-q", name, "-o", "folder.yaml")[0] == 0
    assert os.listdir("folder.yaml") == ["one.yaml"]


@pytest.mark.parametrize(
    ("words", "folder_meant"),
    [
        ([], "robot/"),
        (["-o", "-"], "robot/"),
        (["-o", "burger.yaml"], "burger/"),
        (["-o", "new/burger.yml"], "new/burger/"),
        (["-o", "burger.txt"], "burger/"),
    ],
)
def test_a_robot_in_several_xacro_files_asks_for_a_folder(
    words: list[str], folder_meant: str, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("robot.urdf.xacro").write_text(
        f'<robot name="r" {XACRO}><xacro:include filename="leg.xacro"/><xacro:leg/></robot>'
    )
    Path("leg.xacro").write_text(
        f'<robot {XACRO}><xacro:macro name="leg"><link name="a"/></xacro:macro></robot>'
    )
    status, out, err = outcome(capsys, "robot.urdf.xacro", *words)
    assert (status, out) == (2, "")
    told = f"this robot becomes 2 files: '-o' needs a folder, as in '-o {folder_meant}'"
    assert err.startswith(f"yamaro: error: {told}\n")
    assert sorted(os.listdir()) == ["leg.xacro", "robot.urdf.xacro"]


def test_a_urdf_goes_into_the_folder_that_is_named(capsys: pytest.CaptureFixture[str]) -> None:
    Path("arm.urdf").write_text('<robot name="r"><link name="base"/></robot>')
    os.mkdir("there")
    for folder in ("there", "new/"):
        status, out, err = outcome(capsys, "arm.urdf", "-o", folder)
        path = os.path.join(folder, "arm.yaml")
        assert (status, out) == (0, "")
        assert err == f"arm.urdf: identical: 1 link, 0 joints; {path}\n"
        assert "link/name=base" in Path(path).read_text()
    status, _, err = outcome(capsys, "arm.urdf", "-o", "there/")
    assert (status, "'there/arm.yaml' already exists; --force replaces it" in err) == (2, True)
