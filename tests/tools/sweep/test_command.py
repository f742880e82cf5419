"""`yamaro sweep`: the command line, what is said, and the exit status."""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

import yamaro
from tests.waiting import PATIENCE, wait_for
from yamaro.commands.main import main

LEG = """\
robot: leg
arguments:
  thigh: {default: 0.3, unit: m, range: [0.1, 0.5]}
  legs: {type: integer, range: [2, 8], default: 4}
model:
- part:
    name: base
    link:
    - {geometry: box, scale: $(thigh) 0.1 0.1, mass: $(legs if legs > 3 else 1 / 0)}
    - {visual: , collision: }
"""


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("leg.yaml").write_text(LEG)


def outcome(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    status = main(words)
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def test_a_sweep_says_how_it_went(capsys: pytest.CaptureFixture[str]) -> None:
    command = (
        "sweep",
        "leg.yaml",
        "legs=2..8",
        "thigh:=20cm",
        "--engine",
        "local:1",
        "-o",
        "runs/",
    )
    status, out, err = outcome(capsys, *command)
    assert (status, out) == (0, "")
    first, *rest = err.splitlines()
    assert first.startswith("'runs/': 7 in ")
    assert rest[0] == "7 variants: 5 ok, 2 failed"
    assert rest[1].startswith("  2 × ")
    assert rest[2].startswith("      such as 0: ")
    status, out, err = outcome(capsys, *command, "--resume")
    assert (status, err.splitlines()[0]) == (0, "'runs/': all variants were built before")


def test_a_quiet_sweep_says_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    words = "sweep leg.yaml legs=4..8 -q --engine local:1 -o runs".split()
    assert outcome(capsys, *words) == (0, "", "")


def test_a_sweep_in_which_nothing_is_ok_fails(capsys: pytest.CaptureFixture[str]) -> None:
    words = "sweep leg.yaml thigh=0.2,0.3 legs:=2 --engine local:1 -o runs".split()
    status, _, err = outcome(capsys, *words)
    assert (status, "2 variants: 0 ok, 2 failed" in err) == (1, True)


def test_show_writes_the_document_of_a_variant(capsys: pytest.CaptureFixture[str]) -> None:
    words = "sweep leg.yaml thigh= legs=4,5 --samples 6 --to mjcf,urdf --engine local:1 -q -o runs"
    assert outcome(capsys, *words.split())[0] == 0
    columns = yamaro.Sweep("runs").columns()
    status, out, err = outcome(capsys, *"sweep show runs 3 --to urdf".split())
    assert status == 0
    assert hashlib.sha256(out.encode()).hexdigest() == columns["sha256_urdf"][3]
    thigh, legs = columns["thigh"][3], columns["legs"][3]
    assert err == f"variant 3: thigh:={thigh!r} legs:={legs}\n"
    again = [f"thigh:={thigh!r}", f"legs:={legs}"]
    assert outcome(capsys, "leg.yaml", *again)[1] == out
    assert outcome(capsys, *"sweep show runs 3 -o it.xml -q".split()) == (0, "", "")
    digest = hashlib.sha256(Path("it.xml").read_bytes()).hexdigest()
    assert digest == columns["sha256_mjcf"][3]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("sweep", "'yamaro sweep' needs a FILE"),
        ("sweep leg.yaml legs=2..8", "needs a folder for its table: -o runs/"),
        ("sweep leg.yaml legs -o runs", "is not an axis: write it as legs=0.2..0.4"),
        ("sweep leg.yaml lgs=2..8 -o runs", "did you mean 'legs'?"),
        ("sweep leg.yaml legs=2..9 -o runs", "takes an integer from 2 to 8, not 9"),
        ("sweep leg.yaml legs=2,3 legs=4,5 -o runs", "is given twice"),
        ("sweep leg.yaml legs=2,3 legs:=4 -o runs", "given a value, and an axis as well"),
        ("sweep leg.yaml thigh=0.2..0.3 -o runs", "0.2..0.4/5 has 5; or add --samples N"),
        ("sweep leg.yaml --method latin -o runs", "add --samples 1000"),
        ("sweep leg.yaml --samples 0 -o runs", "a whole number of at least 1"),
        ("sweep leg.yaml legs= --engine spark -o runs", "there is no engine 'spark'"),
        ("sweep leg.yaml legs= --to mjfc -o runs", "did you mean 'mjcf'?"),
        ("sweep leg.yaml legs= --base free -o runs", "'--base' needs an output format"),
        ("sweep show runs", "needs the folder and a number"),
        ("sweep show runs 3", "the folder 'runs' holds no sweep"),
        ("sweep other.yaml legs=2..3 -o runs", "missing-file"),
    ],
)
def test_wrong_usage_says_what_is_wrong(
    capsys: pytest.CaptureFixture[str], words: str, message: str
) -> None:
    status, out, err = outcome(capsys, *words.split())
    assert (status in (1, 2), out) == (True, "")
    assert message in err
    assert sorted(os.listdir()) == ["leg.yaml"]


def test_a_study_with_an_error_shows_its_place(capsys: pytest.CaptureFixture[str]) -> None:
    Path("study.yaml").write_text("sweep:\n  robot: leg.yaml\n  vary: {thigh: [0.4, 0.2]}\n")
    status, _, err = outcome(capsys, "sweep", "study.yaml", "-o", "runs")
    assert status == 1
    assert err.startswith("error[bad-sweep]: the range of 'thigh' has to rise")
    assert " --> study.yaml:3:17\n" in err


SLOW = LEG + "- process: |\n    import time\n    time.sleep(0.05)\n"


@pytest.mark.parametrize("mode", ["--safe", "--jail"])
def test_a_study_does_not_name_what_runs_when_it_is_not_trusted(
    mode: str, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("evil.py").write_text("open('RAN', 'w').close()\ndef f(): return {'x': 1}\n")
    Path("st.yaml").write_text(
        "sweep: {robot: leg.yaml, vary: {legs: 4..5}, samples: 2, evaluate: evil.py:f}"
    )
    status, _, err = outcome(capsys, "sweep", mode, "st.yaml", "-o", "runs")
    assert status == 1
    assert "error[unsafe-code]: the study evaluates with 'evil.py:f', which no mode confines" in err
    assert "st.yaml:1:" in err
    assert not Path("RAN").exists()
    assert not Path("runs").exists()
    named = ("--evaluate", "evil.py:f", "--engine", "local:1")
    assert outcome(capsys, "sweep", mode, "st.yaml", "-o", "runs", *named)[0] == 0
    assert Path("RAN").exists()


def test_show_only_looks_at_the_robot_that_a_folder_names(
    capsys: pytest.CaptureFixture[str],
) -> None:
    code = "import: [os]\n", "robot: $(os.system('touch RAN') or 'leg')\n"
    Path("leg.yaml").write_text(LEG.replace("robot: leg\n", "".join(code)))
    sweep = ("sweep", "leg.yaml", "legs=4..5", "thigh:=20cm", "--engine", "local:1", "-o", "runs/")
    assert outcome(capsys, *sweep)[0] == 0
    Path("RAN").unlink()
    for mode in ([], ["--safe"], ["--jail"]):
        outcome(capsys, "sweep", "show", "runs", "0", *mode)
        assert not Path("RAN").exists()
    assert outcome(capsys, "sweep", "show", "runs", "0", "--trust")[0] == 0
    assert Path("RAN").exists()


@pytest.mark.parametrize(
    ("key", "value"), [("samples", "x"), ("seed", "x"), ("fixed", [1]), ("keep", 1), ("axes", [])]
)
def test_a_plan_that_was_changed_by_hand_is_an_error(
    key: str, value: object, capsys: pytest.CaptureFixture[str]
) -> None:
    sweep = ("sweep", "leg.yaml", "legs=4..5", "thigh:=20cm", "--engine", "local:1", "-o", "runs/")
    assert outcome(capsys, *sweep)[0] == 0
    plan = json.loads(Path("runs/study.json").read_text())
    Path("runs/study.json").write_text(json.dumps({**plan, key: value}))
    status, _, err = outcome(capsys, "sweep", "show", "runs", "0")
    assert status == 1
    assert f"'study.json' is malformed: '{key}' is not of type" in err


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="needs a pseudo-terminal")
def test_a_terminal_shows_how_far_it_is_and_ctrl_c_stops_it() -> None:
    import pty

    Path("leg.yaml").write_text(SLOW)
    own, other = pty.openpty()
    words = "-m yamaro sweep leg.yaml thigh= --samples 2000 --engine local:2 -o runs".split()
    process = subprocess.Popen([sys.executable, *words], stdin=other, stdout=other, stderr=other,
                               start_new_session=True)  # fmt: skip
    os.close(other)
    shown = b""

    def has_shown(text: bytes) -> bool:
        nonlocal shown
        try:
            shown += os.read(own, 1 << 16)
        except OSError:
            pass
        return text in shown

    try:
        wait_for(lambda: has_shown(b" of 2,000, ") and b" left" in shown)
        wait_for(lambda: has_shown(b"") and any(Path("runs/table").glob("part-*")))
        process.send_signal(2)
        wait_for(lambda: has_shown(b"--resume goes on"))
        assert process.wait(PATIENCE) == 130
    finally:
        process.kill()
        os.close(own)
    assert b"stopped after " in shown
    done = yamaro.Sweep("runs").summary().counts
    assert 0 < done["ok"] < 2000
