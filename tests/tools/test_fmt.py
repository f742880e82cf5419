"""`yamaro fmt`: which files it changes, what it says, and its exit status."""

from __future__ import annotations

import io
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from tests.waiting import PATIENCE
from yamaro.commands.main import main

MESSY = "robot:   r\nmodel:\n    - link/name=a:\n"
NEAT = "robot: r\nmodel:\n- link/name=a:\n"


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("NO_COLOR", "1")
    return tmp_path


def write(text: str | bytes, name: str = "robot.yaml") -> Path:
    path = Path(name)
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


def outcome(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    status = main(["fmt", *words])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def test_files_are_formatted_and_named(capsys: pytest.CaptureFixture[str]) -> None:
    messy, neat = write(MESSY, "messy.yaml"), write(NEAT, "neat.yaml")
    before = os.stat(neat)
    assert outcome(capsys, "messy.yaml", "neat.yaml") == (0, "", "messy.yaml: formatted\n")
    assert messy.read_text() == neat.read_text() == NEAT
    assert os.stat(neat).st_ino == before.st_ino, "a file in the style is not written again"
    assert outcome(capsys, "messy.yaml") == (0, "", "")


def test_a_quiet_run_names_none(capsys: pytest.CaptureFixture[str]) -> None:
    path = write(MESSY)
    assert outcome(capsys, "-q", "robot.yaml") == (0, "", "")
    assert path.read_text() == NEAT


def test_check_changes_nothing_and_fails(capsys: pytest.CaptureFixture[str]) -> None:
    path = write(MESSY)
    write(NEAT, "neat.yaml")
    status = outcome(capsys, "--check", "neat.yaml", "robot.yaml")
    assert status == (1, "", "robot.yaml: not formatted\n")
    assert outcome(capsys, "--check", "-q", "robot.yaml") == (1, "", "")
    assert path.read_text() == MESSY
    assert outcome(capsys, "--check", "neat.yaml") == (0, "", "")


def test_diff_shows_a_patch_that_applies(capsys: pytest.CaptureFixture[str]) -> None:
    path = write(MESSY.rstrip())
    status, patch, said = outcome(capsys, "--diff", "robot.yaml")
    assert (status, said) == (1, "")
    assert "\\ No newline at end of file" in patch
    assert path.read_text() == MESSY.rstrip()
    subprocess.run(["patch", "-s", "robot.yaml"], input=patch.encode(), check=True)
    assert path.read_text() == NEAT
    assert outcome(capsys, "--diff", "robot.yaml") == (0, "", "")


def test_standard_input_goes_to_standard_output(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for text in (MESSY, NEAT):
        stdin = SimpleNamespace(buffer=io.BytesIO(text.encode()))
        monkeypatch.setattr(sys, "stdin", stdin)
        assert outcome(capsys, "-") == (0, NEAT, "")


def test_mark_and_line_ends_stay(capsys: pytest.CaptureFixture[str]) -> None:
    path = write(b"\xef\xbb\xbfrobot:   r\r\n")
    assert outcome(capsys, "robot.yaml")[0] == 0
    assert path.read_bytes() == b"\xef\xbb\xbfrobot: r\r\n"


def test_what_is_not_yaml_is_reported_and_the_others_are_formatted(
    capsys: pytest.CaptureFixture[str],
) -> None:
    wrong, messy = write("a: [1\n", "wrong.yaml"), write(MESSY, "messy.yaml")
    status, _, said = outcome(capsys, "wrong.yaml", "messy.yaml")
    assert status == 1
    assert said.startswith("error[yaml-open]")
    assert wrong.read_text() == "a: [1\n"
    assert messy.read_text() == NEAT


def test_what_is_wrong_in_yamaro_is_formatted(capsys: pytest.CaptureFixture[str]) -> None:
    path = write("robot:  r\nmodel:\n  if:\n    conditon:  $(1 +)\n")
    assert outcome(capsys, "-q", "robot.yaml") == (0, "", "")
    assert path.read_text() == "robot: r\nmodel:\n  if:\n    conditon: $(1 +)\n"


def test_nothing_in_a_file_is_run(capsys: pytest.CaptureFixture[str]) -> None:
    write("process:   open('made', 'w')\nmodel:\n")
    assert outcome(capsys, "-q", "robot.yaml") == (0, "", "")
    assert not Path("made").exists()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["missing.yaml"], "cannot read 'missing.yaml': the file does not exist"),
        (["robot.urdf"], "'robot.urdf' is XML; 'yamaro fmt' formats YAML files"),
        (["robot.yaml", "a:=1"], "the style of a file does not depend on 'name:=value'"),
        ([], "'yamaro fmt' needs a FILE"),
    ],
)
def test_wrong_usage(words: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    write(NEAT)
    write("<robot/>", "robot.urdf")
    status, out, err = outcome(capsys, *words)
    assert (status, out) == (2, "")
    assert said in err


def test_a_folder_means_the_files_that_are_named_as_those_of_yamaro(
    capsys: pytest.CaptureFixture[str],
) -> None:
    ours = [
        "robots/a.urdf.yaml", "robots/b.yamaro.yml", "robots/deep/c.urdf.yml",
        "robots/deep/d.yamaro.yaml",
    ]  # fmt: skip
    others = [
        "robots/config.yaml", "robots/urdf.yaml", "robots/a.urdf.yaml.orig", "robots/a.test.yaml",
        "robots/.git/e.urdf.yaml", "robots/build/f.urdf.yaml", "outside.urdf.yaml",
    ]  # fmt: skip
    for name in (*ours, *others):
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        write(MESSY, name)
    Path("robots/link.urdf.yaml").symlink_to(Path("outside.urdf.yaml").resolve())
    said = "".join(f"{Path(name)}: not formatted\n" for name in ours)
    assert outcome(capsys, "--check", "robots") == (1, "", said)
    assert outcome(capsys, "robots", ours[0]) == (0, "", said.replace("not formatted", "formatted"))
    assert {Path(name).read_text() for name in ours} == {NEAT}
    assert {Path(name).read_text() for name in others} == {MESSY}
    assert outcome(capsys, "--check", "robots") == (0, "", "")


def test_a_folder_without_such_files_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    Path("robots").mkdir()
    path = write(MESSY, "robots/robot.yaml")
    status, out, err = outcome(capsys, "robots/")
    assert (status, out) == (2, "")
    assert "no file in the folder 'robots/' is named '*.urdf.yaml' or '*.yamaro.yaml'" in err
    assert f"yamaro fmt {Path('robots/*.yaml')}" in err
    assert path.read_text() == MESSY


def test_the_others_are_formatted_when_one_is_missing(capsys: pytest.CaptureFixture[str]) -> None:
    path = write(MESSY)
    assert outcome(capsys, "missing.yaml", "robot.yaml")[0] == 2
    assert path.read_text() == NEAT


def test_limits_hold(capsys: pytest.CaptureFixture[str]) -> None:
    write("a: " + "[" * 60 + "]" * 60 + "\n")
    assert outcome(capsys, "robot.yaml")[0] == 0
    status, _, said = outcome(capsys, "--limit", "yaml-depth=50", "robot.yaml")
    assert (status, "error[too-deep]" in said) == (1, True)


@pytest.mark.skipif(sys.platform == "win32" or os.geteuid() == 0, reason="root may write anywhere")
def test_a_file_that_cannot_be_written_is_reported(capsys: pytest.CaptureFixture[str]) -> None:
    write(MESSY).chmod(0o400)
    status, _, said = outcome(capsys, "robot.yaml")
    assert (status, "cannot write 'robot.yaml'" in said) == (1, True)


@pytest.mark.skipif(sys.platform == "win32", reason="has no named pipes")
def test_a_pipe_is_not_written_to(capsys: pytest.CaptureFixture[str]) -> None:
    reading, writing = os.pipe()
    os.write(writing, MESSY.encode())
    os.close(writing)
    status, out, err = outcome(capsys, f"/dev/fd/{reading}")
    os.close(reading)
    assert (status, out) == (1, "")
    assert "it is not a regular file; 'yamaro fmt -' formats standard input" in err


def test_fmt_loads_no_compiler() -> None:
    write(MESSY)
    code = (
        "import sys; from yamaro.commands.main import main; main(['fmt', 'robot.yaml'])\n"
        "assert not any(name.startswith('yamaro.runtime') for name in sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=PATIENCE)
