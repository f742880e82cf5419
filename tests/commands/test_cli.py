"""Tests of the command: its arguments, what goes to which stream, and its exit status."""

from __future__ import annotations

import importlib.metadata
import io
import os
import shutil
import signal
import subprocess
import sys
import types
from pathlib import Path
from typing import Any

import pytest

from tests.tools_there import TOOLS, marked, needs
from tests.waiting import PATIENCE
from yamaro import Program
from yamaro.commands.arguments import make_policy, parse_arguments
from yamaro.commands.command_table import all_commands, command_named, named_commands
from yamaro.commands.main import main
from yamaro.commands.option_table import all_options, all_spellings, help_of, options_of
from yamaro.commands.reports import usage_told
from yamaro.commands.shells import SHELLS, script
from yamaro.policy import Limits, limit_names
from yamaro.sandbox import jail

ROBOT = """\
robot: arm
variables:
  length: 1.0
model:
  link/name=base:
  link/name='tool', length='$(length)':
  joint/name=tool_joint, type=fixed:
    parent/link=base:
    child/link=tool:
"""
PLAIN = """\
robot: arm
variables:
  length: 1.0
model:
  link/name=base_$(length):
"""
PLAIN_XML = '<?xml version="1.0"?>\n<robot name="arm">\n  <link name="base_1.0"/>\n</robot>\n'
WARNS = "robot: arm\nmodel:\n  link/name=base:\n  note: ${length}\n"
FAILS = "robot: arm\nmodel:\n  link/name=$(missing):\n"
PRINTS = "robot: arm\nprint: one\nmodel:\n  link/name=base:\n  print: two\n"


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in an empty folder, with nothing set that changes colours."""
    monkeypatch.chdir(tmp_path)
    for name in ("NO_COLOR", "FORCE_COLOR", "YAMARO_TRACEBACK", "PYTHONWARNINGS"):
        monkeypatch.delenv(name, raising=False)
    return tmp_path


def write(text: str, name: str = "robot.yaml") -> str:
    Path(name).parent.mkdir(parents=True, exist_ok=True)
    Path(name).write_text(text, encoding="utf-8")
    return name


def run(*words: str | bytes, python: tuple[str, ...] = (), **options: Any) -> Any:
    """Run the command as a process of its own."""
    command = [sys.executable, *python, "-m", "yamaro", *words]
    options = {"stdin": subprocess.DEVNULL} | options if "input" not in options else options
    return subprocess.run(command, capture_output=True, timeout=PATIENCE, check=False, **options)


def outcome(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    """Run the command in this process; return exit status, standard output and error."""
    status = main(list(words))
    captured = capsys.readouterr()
    return status, captured.out, captured.err


# --- building ---------------------------------------------------------------------------------


def test_xml_goes_to_standard_output_and_nothing_to_standard_error(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert outcome(capsys, write(PLAIN)) == (0, PLAIN_XML, "")


def test_variables_are_set_from_the_command_line(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = outcome(capsys, write(PLAIN), "length:=2.5")
    assert status == 0
    assert 'name="base_2.5"' in out


def test_output_goes_to_a_file_and_its_folders_are_made(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert outcome(capsys, write(PLAIN), "-o", "build/urdf/arm.urdf") == (0, "", "")
    assert Path("build/urdf/arm.urdf").read_text() == PLAIN_XML
    assert os.listdir("build/urdf") == ["arm.urdf"]


@pytest.mark.parametrize("name", ["-", "/dev/stdout"])
def test_output_may_be_standard_output_by_name(
    capsys: pytest.CaptureFixture[str], name: str
) -> None:
    assert outcome(capsys, write(PLAIN), "-o", name) == (0, PLAIN_XML, "")


def test_prints_go_to_standard_error(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = outcome(capsys, write(PRINTS))
    assert (status, err) == (0, "one\ntwo\n")
    assert out.endswith("</robot>\n")


def test_warnings_go_to_standard_error_and_do_not_fail(
    capsys: pytest.CaptureFixture[str],
) -> None:
    status, out, err = outcome(capsys, write(WARNS))
    assert status == 0
    assert out.endswith("</robot>\n")
    assert err.startswith("warning[")
    assert " --> robot.yaml:4:" in err
    assert err.endswith("\n")
    assert not err.endswith("\n\n")


def test_warnings_are_apart_by_a_blank_line(capsys: pytest.CaptureFixture[str]) -> None:
    _, _, err = outcome(capsys, write(WARNS + "  other: ${width}\n"))
    assert err.count("warning[") == 2
    assert "\n\nwarning[" in err


def test_errors_give_no_output_and_leave_the_old_file(
    capsys: pytest.CaptureFixture[str],
) -> None:
    write("old", "arm.urdf")
    status, out, err = outcome(capsys, write(FAILS), "-o", "arm.urdf")
    assert (status, out) == (1, "")
    assert err.startswith("error[")
    assert "'missing'" in err
    assert Path("arm.urdf").read_text() == "old"


def test_quiet_run_says_nothing_but_errors(capsys: pytest.CaptureFixture[str]) -> None:
    assert outcome(capsys, write(PRINTS), "-q")[2] == ""
    assert outcome(capsys, write(WARNS), "--quiet")[2] == ""
    status, _, err = outcome(capsys, write(WARNS + "  link/name=$(missing):\n"), "-q")
    assert status == 1
    assert err.startswith("error[")
    assert "warning[" not in err


def test_strict_run_fails_on_warnings(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = outcome(capsys, write(WARNS), "--strict")
    assert (status, out) == (1, "")
    assert " --> robot.yaml:4:" in err
    assert outcome(capsys, write(PLAIN), "--strict") == (0, PLAIN_XML, "")


def test_deps_lists_the_files_read(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    write("model:\n  link/name=leg:\n", "parts/leg.yaml")
    main_file = write("robot: arm\nmodel:\n  include: parts/leg.yaml\n  print: hello\n")
    expected = f"{folder}/robot.yaml\n{folder}/parts/leg.yaml\n"
    assert outcome(capsys, main_file, "--deps") == (0, expected, "hello\n")
    assert outcome(capsys, main_file, "--deps", "-q", "-o", "arm.d") == (0, "", "")
    assert Path("arm.d").read_text() == expected


def test_deps_lists_meshes_that_are_files_and_each_once(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def build(program: Program, **options: object) -> types.SimpleNamespace:
        return types.SimpleNamespace(
            warnings=[],
            outputs={},
            files=["/r/robot.yaml", "/r/b.yaml"],
            meshes=["/r/m.stl", "package://unknown/n.stl", "/r/b.yaml"],
        )

    monkeypatch.setattr(Program, "build", build)
    expected = "/r/robot.yaml\n/r/b.yaml\n/r/m.stl\n"
    assert outcome(capsys, write(PLAIN), "--deps") == (0, expected, "")


def test_standard_input_is_read_for_a_dash() -> None:
    result = run("-", input=PLAIN.encode())
    assert (result.returncode, result.stdout.decode(), result.stderr) == (0, PLAIN_XML, b"")
    result = run("-", "-o", "x.urdf", input="\ufeffmodel:\n  link/name=é:\n".encode())
    assert result.returncode == 0
    assert "é" in Path("x.urdf").read_text(encoding="utf-8")


def test_named_pipe_is_read_like_standard_input() -> None:
    os.mkfifo("pipe.yaml")
    with subprocess.Popen(["sh", "-c", "cat > pipe.yaml"], stdin=subprocess.PIPE) as writer:
        assert writer.stdin is not None
        writer.stdin.write(PLAIN.encode())
        writer.stdin.close()
        result = run("pipe.yaml")
        writer.kill()  # it would wait for ever if nobody had opened the pipe
    assert (result.returncode, result.stdout.decode(), result.stderr) == (0, PLAIN_XML, b"")
    assert run("/dev/stdin", input=PLAIN.encode()).stdout.decode() == PLAIN_XML


@pytest.mark.parametrize(
    "command",
    marked(
        [
            "pipe.yaml",
            "--safe --timeout 100 pipe.yaml",
            "--jail pipe.yaml",
            "check pipe.yaml",
            "check link.urdf",
            "check --fix pipe.yaml",
            "tree pipe.yaml",
            "args pipe.yaml",
            "why pipe.yaml base",
            "diff pipe.yaml pipe.yaml",
            "migrate pipe.yaml",
            "fmt pipe.yaml",
            "fmt --check pipe.yaml",
            "watch pipe.yaml -o x.urdf",
            "sweep pipe.yaml -o runs",
        ]
    ),
)
def test_a_pipe_that_nothing_writes_to_is_not_waited_for(
    command: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("yamaro.files.regular.PATIENCE", 0.01)
    os.mkfifo("pipe.yaml")
    os.symlink("pipe.yaml", "link.urdf")
    status, out, err = outcome(capsys, *command.split())
    assert (status in (1, 2), out) == (True, "")
    assert "a named pipe that nothing writes to" in err or "not a regular file" in err


def test_a_file_after_two_dashes_sets_no_variable(capsys: pytest.CaptureFixture[str]) -> None:
    text = "robot: r\nvariables: {v: 1}\nmodel:\n- link/name=a$(v):\n"
    for name in ("v:=9.urdf.yaml", "other.urdf.yaml"):
        Path(name).write_text(text)
    assert outcome(capsys, "check", "--", "other.urdf.yaml", "v:=9.urdf.yaml") == (
        0, "other.urdf.yaml: ok\nv:=9.urdf.yaml: ok\n", "",
    )  # fmt: skip
    status, out, _ = outcome(capsys, "--", "v:=9.urdf.yaml", "v:=2")
    assert (status, '"a2"' in out) == (0, True)


@pytest.mark.parametrize(
    ("path", "ran"), [(":", False), ("{x}:", False), (".:", True), ("", False)]
)
def test_an_empty_entry_of_pythonpath_is_not_the_working_directory(path: str, ran: bool) -> None:
    write(PLAIN)
    Path("json.py").write_text("open('RAN', 'w').close()\nraise ImportError")
    environment = {**os.environ, "PYTHONPATH": path.format(x=os.path.abspath("x"))}
    subprocess.run(
        [Path(sys.executable).with_name("yamaro"), "check", "robot.yaml", "--format", "json"],
        env=environment, capture_output=True, check=False,
    )  # fmt: skip
    assert os.path.exists("RAN") == ran


@pytest.mark.parametrize("command", marked(["fmt", "test"]))
def test_folders_are_searched_for_regular_files_only(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("robots").mkdir()
    os.mkfifo("robots/a.urdf.yaml")
    os.mkfifo("robots/a.test.yaml")
    assert outcome(capsys, command, "robots")[0] == 2


@pytest.mark.parametrize("name", ["-", "/dev/stdin", "pipe.yaml"])
def test_a_writer_that_does_not_write_is_waited_for_as_long_as_the_time_out(name: str) -> None:
    os.mkfifo("pipe.yaml")
    writer = os.open("pipe.yaml", os.O_RDWR)  # it never writes
    try:
        result = subprocess.run(
            [sys.executable, "-m", "yamaro", "--safe", "--timeout", "0.1", name],
            stdin=writer, capture_output=True, check=False,
        )  # fmt: skip
    finally:
        os.close(writer)
    assert result.returncode == 1
    assert b"error[limit-time]: timed out: this takes more than 0.1 s" in result.stderr


def test_standard_input_may_be_a_python_stream(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "stdin", io.StringIO(PLAIN))
    assert outcome(capsys, "-") == (0, PLAIN_XML, "")


@pytest.mark.parametrize("words", [["-"], ["check", "-"], ["-", "--safe"], ["-", "--jail"]])
def test_standard_input_is_read_in_each_mode(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, words: list[str]
) -> None:
    if "--jail" in words and jail.check_available() is not None:
        pytest.skip("no jail here")
    monkeypatch.setattr(sys, "stdin", io.StringIO(PLAIN))
    expected = "<standard input>: ok\n" if "check" in words else PLAIN_XML
    assert outcome(capsys, *words) == (0, expected, "")


def test_standard_input_that_is_no_utf8_is_an_error() -> None:
    result = run("-", input=b"robot: \xff\xfe\n")
    assert (result.returncode, result.stdout) == (1, b"")
    assert result.stderr.startswith(b"error[not-utf-8]: ")
    assert b" --> <standard input>:1:8\n" in result.stderr


def test_closed_standard_input_is_wrong_usage(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "stdin", None)
    status, _, err = outcome(capsys, "-")
    assert (status, err.splitlines()[0]) == (2, "yamaro: error: standard input is closed")


# --- check ------------------------------------------------------------------------------------


def test_check_of_a_good_file_says_so(capsys: pytest.CaptureFixture[str]) -> None:
    name = write(ROBOT.replace(", length='$(length)'", "").replace("  length: 1.0\n", "  x: 1\n"))
    status, out, err = outcome(capsys, "check", name)
    assert err == ""
    assert (status, out) == (0, "robot.yaml: ok\n")
    assert outcome(capsys, "check", name, "-q") == (0, "", "")


@pytest.mark.parametrize("quiet", [False, True])
def test_check_fails_on_warnings_and_counts_them(
    capsys: pytest.CaptureFixture[str], quiet: bool
) -> None:
    name = write(WARNS + "  other: ${width}\n")
    status, out, err = outcome(capsys, "check", name, *(["-q"] if quiet else []))
    assert (status, out) == (1, "")
    assert err.count("warning[") >= 2
    assert err.splitlines()[-2] == ""
    assert err.splitlines()[-1].startswith("robot.yaml: ")
    assert err.splitlines()[-1].endswith(" warnings")


def test_check_counts_errors(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = outcome(
        capsys, "check", write("model:\n  iff: 1\n  link/name: 1\n  if: 2\n")
    )
    assert (status, out) == (1, "")
    errors = err.count("error[")
    assert errors >= 1
    plural = "s" if errors > 1 else ""
    assert f"robot.yaml: {errors} error{plural}" in err.splitlines()[-1]


@pytest.mark.parametrize("command", marked(["check", "tree", "completion"]))
def test_file_with_the_name_of_a_command_is_reached_by_its_path(
    capsys: pytest.CaptureFixture[str], command: str
) -> None:
    write(PLAIN, command)
    assert outcome(capsys, f"./{command}") == (0, PLAIN_XML, "")
    assert outcome(capsys, "--", command) == (0, PLAIN_XML, "")
    if command != "completion":
        status, _, err = outcome(capsys, command)
        assert status == 2
        assert f"to compile the file of that name, write './{command}'" in err
        assert outcome(capsys, command, command, "-q")[0] in (0, 1)


# --- trust ------------------------------------------------------------------------------------

# A file that leaves a trace if its Python is run.
RUNS_PYTHON = """\
robot: arm
process: |
  open('ran', 'w').close()
model:
  link/name=base:
"""
COUNTS = """\
robot: arm
variables: {n: 3}
model:
  link/name=base:
  for: {iterator: i, range: n, body: {note: $(i)}}
"""


def codes_of(err: str) -> list[str]:
    """Return the codes of the errors that were said."""
    lines = err.splitlines()
    return [line[6:].partition("]")[0] for line in lines if line.startswith("error[")]


@pytest.mark.parametrize("words", marked([["tree", "--safe"], ["--safe"], ["check", "--safe"]]))
def test_safe_mode_runs_nothing_that_does_more_than_compute(
    capsys: pytest.CaptureFixture[str], words: list[str]
) -> None:
    status, out, err = outcome(capsys, *words, write(RUNS_PYTHON))
    assert (status, out, codes_of(err)) == (1, "", ["unsafe-code"])
    assert "the function `open` is not allowed in safe mode" in err
    assert not os.path.exists("ran")


@pytest.mark.parametrize(
    "words", marked([[], ["--trust"], ["check", "--trust"], ["--trust", "tree"]])
)
def test_a_trusted_file_may_do_what_python_can(
    capsys: pytest.CaptureFixture[str], words: list[str]
) -> None:
    status, _, err = outcome(capsys, *words, write(RUNS_PYTHON))
    assert (status, err) == (0, "")
    assert os.path.exists("ran")


@pytest.mark.skipif(jail.check_available() is not None, reason="no jail here")
@pytest.mark.parametrize("words", marked([["--jail"], ["check", "--jail"], ["tree", "--jail"]]))
def test_a_jailed_file_runs_and_writes_nothing(
    capsys: pytest.CaptureFixture[str], words: list[str]
) -> None:
    status, out, err = outcome(capsys, *words, write(RUNS_PYTHON))
    assert (status, out, codes_of(err)) == (1, "", ["python-error"])
    assert "(PermissionError)" in err
    assert not os.path.exists("ran")


def test_what_is_allowed_gives_the_same_in_every_mode(capsys: pytest.CaptureFixture[str]) -> None:
    modes = ["--trust", "--safe"] + ["--jail"] * (jail.check_available() is None)
    write(ROBOT)
    trusted = outcome(capsys, "robot.yaml", "length:=2")
    for mode in modes:
        assert outcome(capsys, mode, "robot.yaml", "length:=2") == trusted
        assert outcome(capsys, mode, "robot.yaml", "length:=2", "-o", "a.urdf")[0] == 0
        assert Path("a.urdf").read_text() == trusted[1]


def test_paths_can_be_allowed_again_and_again(
    capsys: pytest.CaptureFixture[str], tmp_path_factory: pytest.TempPathFactory
) -> None:
    elsewhere = [tmp_path_factory.mktemp(name) for name in ("one", "two")]
    files = [str(folder / "part.yaml") for folder in elsewhere]
    for file in files:
        write("model:\n  link/name=base:\n", file)
    write("robot: arm\nmodel:\n" + "".join(f"  include: {file}\n" for file in files))
    status, _, err = outcome(capsys, "--safe", "robot.yaml", "--allow-path", files[0])
    assert (status, codes_of(err)) == (1, ["path-outside"])
    assert " --> robot.yaml:4:12\n" in err
    allowed = [f"--allow-path={files[0]}", "--allow-path", str(elsewhere[1])]
    assert "path-outside" not in outcome(capsys, "--safe", "robot.yaml", *allowed)[2]


@pytest.mark.parametrize("spelling", ["3", "1_000", "+3"])
def test_limits_are_whole_numbers_as_python_writes_them(
    capsys: pytest.CaptureFixture[str], spelling: str
) -> None:
    write(COUNTS)
    assert outcome(capsys, "robot.yaml", f"--limit=turns={spelling}")[0] == 0
    assert outcome(capsys, "robot.yaml", "--limit", f"turns={spelling}")[0] == 0


def test_several_limits_can_be_set_and_the_last_of_a_name_counts(
    capsys: pytest.CaptureFixture[str],
) -> None:
    write(COUNTS)
    words = ["--limit", "turns=2", "--limit", "yaml-depth=99", "robot.yaml"]
    status, _, err = outcome(capsys, *words)
    assert (status, codes_of(err)) == (1, ["limit-turns"])
    assert "more than 2 turns" in err
    assert outcome(capsys, *words, "--limit", "turns=3")[0] == 0


@pytest.mark.parametrize("command", marked(["check", "tree"]))
def test_limits_of_safe_mode_can_be_set_where_it_is_the_usual_one(
    capsys: pytest.CaptureFixture[str], command: str
) -> None:
    write(PLAIN.replace("length)", "length + 1)"))
    status, _, err = outcome(capsys, command, "robot.yaml", "--limit", "characters=9")
    assert (status, codes_of(err)) == (1, ["limit-characters"])
    assert codes_of(outcome(capsys, command, "robot.yaml", "--limit", "characters=10")[2]) == []


def test_a_time_out_ends_a_conversion_and_leaves_the_old_file(
    capsys: pytest.CaptureFixture[str],
) -> None:
    write("old", "arm.urdf")
    write("robot: arm\nprocess: |\n  while True: pass\nmodel:\n  link/name=base:\n")
    status, out, err = outcome(capsys, "robot.yaml", "--timeout", "1", "-o", "arm.urdf")
    assert (status, out, codes_of(err)) == (1, "", ["limit-time"])
    assert " --> robot.yaml:3:" in err
    assert Path("arm.urdf").read_text() == "old"


@pytest.mark.parametrize("command", marked(["build", "check", "tree"]))
@pytest.mark.parametrize(
    ("word", "mode"), [(None, None), ("--trust", "trusted"), ("--jail", "jail"), ("--safe", "safe")]
)
def test_the_mode_is_the_one_asked_for_or_that_of_the_command(
    command: str, word: str | None, mode: str | None
) -> None:
    words = [word] if word else []
    arguments = parse_arguments([*([] if command == "build" else [command]), *words, "robot.yaml"])
    policy = make_policy(arguments)
    assert policy.mode == (mode or ("trusted" if command == "build" else "safe"))
    falls_back = command != "build" and mode is None
    assert (policy.fallback.mode if policy.fallback else None) == ("jail" if falls_back else None)
    assert policy.timeout == (None if policy.mode == "trusted" else 60)


def test_the_page_on_safety_tells_every_limit_as_it_is() -> None:
    page = (Path(__file__).parents[2] / "docs" / "safety.md").read_text(encoding="utf-8")
    section = page.partition("\n## Limits\n")[2].partition("\n## ")[0]
    rows = [line.strip("| ").split(" | ") for line in section.splitlines() if line[:3] == "| `"]
    told = {row[0].strip("`"): row[1:3] for row in rows[1:]}  # the first is the head
    assert list(told) == limit_names()
    for name, numbers in told.items():
        field = name.replace("-", "_")
        safe, other = (getattr(Limits(mode), field) for mode in ("safe", "trusted"))
        same = "same" if other == safe else f"{other:,}"
        assert numbers == [f"{safe:,}", same if other else "–"]


def test_options_make_the_policy() -> None:
    words = "--safe r.yaml --timeout 1.5 --allow-path a --allow-path=b --limit xml-depth=7"
    policy = make_policy(parse_arguments(words.split()))
    assert (policy.mode, policy.timeout, policy.allowed_paths) == ("safe", 1.5, ("a", "b"))
    assert policy.limits.xml_depth == 7
    assert policy.limits.turns == Limits("safe").turns


# --- arguments --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "words",
    [
        "robot.yaml -o out -q --strict a:=1 b:=2",
        "-q --output out a:=1 --strict robot.yaml b:=2",
        "a:=1 b:=2 -qo out robot.yaml --strict",
        "--strict a:=1 -qoout -- robot.yaml b:=2",
        "robot.yaml a:=1 --output=out b:=2 -q -q --strict",
    ],
)
def test_options_may_stand_anywhere(words: str) -> None:
    arguments = parse_arguments(words.split())
    assert arguments.command == "build"
    assert arguments.words == ["robot.yaml"]
    assert arguments.assignments == ["a:=1", "b:=2"]
    assert arguments.options == {"output": "out", "quiet": "", "strict": ""}


def test_commands_are_found_behind_options_and_variables() -> None:
    arguments = parse_arguments(["-q", "a:=1", "check", "robot.yaml"])
    assert (arguments.command, arguments.words) == ("check", ["robot.yaml"])


def test_file_names_may_hold_what_looks_like_a_variable() -> None:
    arguments = parse_arguments(["./a:=b.yaml", "c:=d/e", "--", "x:=-1"])
    assert (arguments.words, arguments.assignments) == (["./a:=b.yaml"], ["c:=d/e", "x:=-1"])


def test_words_after_two_dashes_are_no_options() -> None:
    assert parse_arguments(["--", "-q"]).words == ["-q"]


@pytest.mark.parametrize(
    ("words", "message"),
    marked(
        [
            ("", "missing FILE"),
            ("--", "missing FILE"),
            ("a:=1", "missing FILE"),
            ("check", "'yamaro check' needs a FILE"),
            ("new", "'yamaro new' needs a NAME"),
            ("a.yaml b.yaml", "unexpected argument 'b.yaml' after 'a.yaml'"),
            (
                "a.yaml legs=6",
                "unexpected argument 'legs=6' after 'a.yaml'; to set a variable, write 'legs:=6'",
            ),
            ("chekc a.yaml", "unknown command 'chekc'; did you mean 'check'?"),
            ("--strct a.yaml", "unknown option '--strct'; did you mean '--strict'?"),
            ("--colour always a.yaml", "unknown option '--colour'; did you mean '--color'?"),
            ("-strict a.yaml", "unknown option '-strict'; did you mean '--strict'?"),
            ("-qz a.yaml", "unknown option '-z'"),
            ("--xyzzy a.yaml", "unknown option '--xyzzy'"),
            ("a.yaml -o", "'-o' needs a file name after it"),
            ("a.yaml --output=", "'--output' needs a file name after it"),
            ("a.yaml -o x --output y", "'--output' is given twice"),
            ("a.yaml --quiet=yes", "'--quiet' takes no value"),
            ("a.yaml --color", "'--color' needs auto, always or never after it"),
            ("a.yaml --color on", "'--color' takes auto, always or never, not 'on'"),
            ("tree a.yaml -o x", "'--output' cannot be used with 'yamaro tree'"),
            ("tree a.yaml --deps", "'--deps' cannot be used with 'yamaro tree'"),
            ("--safe --jail a.yaml", "'--jail' and '--safe' cannot be combined"),
            ("tree a.yaml --safe --trust", "'--trust' and '--safe' cannot be combined"),
            ("--safe=yes a.yaml", "'--safe' takes no value"),
            ("a.yaml --timeout", "'--timeout' needs a number of seconds after it"),
            ("a.yaml --timeout 1 --timeout 2", "'--timeout' is given twice"),
            ("a.yaml --timeout 0", "'--timeout' takes a number of seconds greater than 0, not '0'"),
            (
                "a.yaml --timeout=1min",
                "'--timeout' takes a number of seconds greater than 0, not '1min'",
            ),
            (
                "a.yaml --timeout nan",
                "'--timeout' takes a number of seconds greater than 0, not 'nan'",
            ),
            (
                "a.yaml --timeout inf",
                "'--timeout' takes a number of seconds greater than 0, not 'inf'",
            ),
            ("--safe a.yaml --allow-path", "'--allow-path' needs a file or folder after it"),
            ("--safe a.yaml --allow-path=", "'--allow-path' needs a file or folder after it"),
            (
                "a.yaml --allow-path /opt",
                "'--allow-path' needs --jail or --safe",
            ),
            (
                "check --trust a.yaml --allow-path /opt",
                "'--allow-path' needs --jail or --safe",
            ),
            ("a.yaml --limit", "'--limit' needs NAME=NUMBER after it"),
            (
                "a.yaml --limit turns",
                "the limit 'turns' needs a whole number, as in '--limit turns=1000'",
            ),
            ("a.yaml --limit turns=", "the limit 'turns' needs a whole number, not ''"),
            ("a.yaml --limit turns=1e6", "the limit 'turns' needs a whole number, not '1e6'"),
            (
                "a.yaml --limit turns=0",
                "the limit 'turns' is a whole number from 1 to 1,125,899,906,842,624",
            ),
            (
                "a.yaml --limit turns=-5",
                "the limit 'turns' is a whole number from 1 to 1,125,899,906,842,624",
            ),
            ("a.yaml --limit turn=9", "unknown limit 'turn'; did you mean 'turns'?"),
            ("a.yaml --limit xml_depth=9", "unknown limit 'xml_depth'; did you mean 'xml-depth'?"),
            ("a.yaml --limit steps=9", "the limit 'steps' applies only in safe mode"),
            ("--jail a.yaml --limit steps=9", "the limit 'steps' applies only in safe mode"),
            ("completion --safe bash", "'--safe' cannot be used with 'yamaro completion'"),
            ("completion", "'yamaro completion' needs a shell: bash, zsh, fish"),
            ("completion tcsh", "'yamaro completion' needs a shell: bash, zsh, fish"),
            ("completion bash zsh", "'yamaro completion' needs a shell: bash, zsh, fish"),
            ("--\x1b[2J", "unknown option '--\\x1b[2J'"),
        ]
    ),
)
def test_wrong_usage_is_told_in_one_line(
    capsys: pytest.CaptureFixture[str], words: str, message: str
) -> None:
    status, out, err = outcome(capsys, *words.split())
    assert (status, out) == (2, "")
    command = next((word for word in words.split() if command_named(word)), "build")
    assert err == f"yamaro: error: {message}\n{usage_told(command)}\n"


def test_wrong_usage_of_a_command_shows_how_that_is_used(
    capsys: pytest.CaptureFixture[str],
) -> None:
    _, _, err = outcome(capsys, "args", "--xyzzy", "a.yaml")
    assert err.splitlines()[1] == ("usage: yamaro args [options] FILE   (see 'yamaro args --help')")


def test_an_unknown_limit_that_is_like_none_lists_them_all(
    capsys: pytest.CaptureFixture[str],
) -> None:
    status, _, err = outcome(capsys, "--limit", "zzz=1", write(PLAIN))
    assert status == 2
    said = err.splitlines()[0]
    assert said.startswith("yamaro: error: unknown limit 'zzz'; the limits are file, files, ")
    assert set(limit_names()) <= set(said.replace(",", "").split())


def test_missing_main_file_is_wrong_usage(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = outcome(capsys, "nowhere.yaml")
    assert (status, out) == (2, "")
    assert err.startswith("yamaro: error: ")
    assert "'nowhere.yaml'" in err
    assert err.endswith(usage_told("build") + "\n")


@pytest.mark.parametrize("command", marked(["build", "check", "tree"]))
def test_an_empty_file_name_is_wrong_usage(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([command, ""]) == 2
    assert "error: the file name is empty\n" in capsys.readouterr().err


@pytest.mark.parametrize("word", ["1x:=2", ":=2", "a b:=2", "for:=1"])
def test_malformed_variables_are_wrong_usage(capsys: pytest.CaptureFixture[str], word: str) -> None:
    status, out, err = outcome(capsys, write(PLAIN), word)
    assert (status, out) == (2, "")
    assert err.startswith("yamaro: error: ")


@pytest.mark.parametrize("words", [["-h"], ["--help"], ["help"], ["a", "b", "--help"]])
def test_help_lists_the_options_of_a_build_and_the_other_commands(
    capsys: pytest.CaptureFixture[str], words: list[str]
) -> None:
    assert outcome(capsys, *words) == (0, help_of("build"), "")
    for command in all_commands():
        assert command == "build" or f"  yamaro {command} " in help_of("build")


@pytest.mark.parametrize("command", all_commands())
def test_a_command_shows_its_own_help(capsys: pytest.CaptureFixture[str], command: str) -> None:
    status, out, err = outcome(capsys, command, "--help")
    assert (status, err) == (0, "")
    name = "yamaro" if command == "build" else f"yamaro {command}"
    assert f"{out.partition(chr(10))[0]} ".startswith(f"usage: {name} ")
    assert max(map(len, out.splitlines())) <= 100
    shown = [line.partition("--")[2].split()[0] for line in out.splitlines() if " --" in line[:8]]
    assert shown == [option.name for option in options_of(all_commands()[command])]
    for words in ([command, "-h"], ["--help", command], ["help", command], ["-q", command, "-h"]):
        assert outcome(capsys, *words) == (0, out, "")


def test_every_option_belongs_to_a_command_and_is_explained() -> None:
    commands, options = all_commands(), all_options()
    taken = {option.name for command in commands.values() for option in options_of(command)}
    for command in commands.values():
        own = {option.name for option in options_of(command)}
        assert set(command.help_of) <= own
    for option in options.values():
        assert option.name in taken
        assert set(option.commands) <= set(commands)
        assert set(option.help_in) <= set(option.commands)
        assert bool(option.value) == bool(option.wants)
        assert option.help.isprintable()
        assert set(option.excludes) <= set(options)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("help chekc", "unknown command 'chekc'; did you mean 'check'?"),
        (
            "help robot.yaml",
            f"unknown command 'robot.yaml'; the commands are {', '.join(named_commands())}",
        ),
        ("help check tree", "unexpected argument 'tree' after 'check'"),
        ("help check --strict", "'--strict' cannot be used with 'yamaro help'"),
    ],
)
def test_help_of_no_command_is_wrong_usage(
    capsys: pytest.CaptureFixture[str], words: str, message: str
) -> None:
    assert outcome(capsys, *words.split()) == (
        2,
        "",
        f"yamaro: error: {message}\n{usage_told('help')}\n",
    )


@needs(*TOOLS)
def test_the_page_on_the_command_lists_its_options() -> None:
    """Each option is in the table of its section, in every spelling and with its value."""
    page = (Path(__file__).parents[2] / "docs" / "cli.md").read_text(encoding="utf-8")
    cells = [line.split(" | ")[0] for line in page.splitlines() if line.startswith("| `-")]
    told = {
        word.strip("`,| ").split("=")[0].split()[0] for cell in cells for word in cell.split(", ")
    }
    assert told == set(all_spellings())
    usage = page.partition("```\n")[2].partition("```")[0].splitlines()
    for command in all_commands().values():
        name = "yamaro" if command.name == "build" else f"yamaro {command.name}"
        for form in command.forms:
            assert any(
                f"{line} ".startswith(name + " ") and line.endswith(form) for line in usage
            ), form


def test_version_is_that_of_the_package(capsys: pytest.CaptureFixture[str]) -> None:
    version = importlib.metadata.version("yamaro")
    assert outcome(capsys, "--version") == (0, f"yamaro {version}\n", "")
    assert outcome(capsys, "-V")[0] == 0


@pytest.mark.parametrize("name", ["robot.yaml", "link.yaml", "hard.yaml", "./sub/../robot.yaml"])
def test_output_that_is_the_main_file_is_refused(
    capsys: pytest.CaptureFixture[str], name: str
) -> None:
    write(PLAIN)
    os.mkdir("sub")
    os.symlink("robot.yaml", "link.yaml")
    os.link("robot.yaml", "hard.yaml")
    status, out, err = outcome(capsys, "robot.yaml", "-o", name)
    assert (status, out) == (2, "")
    assert f"the output '{name}' is one of the input files" in err
    assert Path("robot.yaml").read_text() == PLAIN


def test_output_that_is_an_included_file_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    leg = "model:\n  link/name=leg:\n"
    write(leg, "leg.yaml")
    write("model:\n  include: leg.yaml\n")
    assert outcome(capsys, "robot.yaml", "-o", "leg.yaml")[0] == 2
    assert Path("leg.yaml").read_text() == leg


# --- faults -----------------------------------------------------------------------------------


def test_a_fault_of_ours_is_told_apart_and_shows_no_traceback(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def build(program: Program, **options: object) -> None:
        raise KeyError("oops")

    monkeypatch.setattr(Program, "build", build)
    status, out, err = outcome(capsys, write(PLAIN))
    assert (status, out) == (70, "")
    assert err.startswith("yamaro: internal error: KeyError: 'oops' (test_cli.py:")
    assert "Traceback" not in err
    monkeypatch.setenv("YAMARO_TRACEBACK", "1")
    assert "Traceback" in outcome(capsys, write(PLAIN))[2]


@pytest.mark.parametrize(
    ("fault", "status", "said"),
    [
        (KeyboardInterrupt(), 130, ""),
        (MemoryError(), 1, "yamaro: error: out of memory\n"),
        (SystemExit(0), 1, "yamaro: error: Python code of the file ended the program"),
    ],
)
def test_interrupts_do_not_pass_for_success(
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    fault: BaseException,
    status: int,
    said: str,
) -> None:
    def build(program: Program, **options: object) -> None:
        raise fault

    monkeypatch.setattr(Program, "build", build)
    result = outcome(capsys, write(PLAIN), "-o", "arm.urdf")
    assert result[:2] == (status, "")
    assert result[2].startswith(said)
    assert bool(result[2]) == bool(said)
    assert not os.path.exists("arm.urdf")


def test_sys_exit_in_the_file_is_no_success() -> None:
    result = run(write("import: sys\nmodel:\n  process: sys.exit(0)\n"))
    assert result.returncode == 1
    assert result.stdout == b""
    assert result.stderr != b""
    assert b"Traceback" not in result.stderr


def test_output_does_not_follow_a_change_of_folder(capsys: pytest.CaptureFixture[str]) -> None:
    os.mkdir("elsewhere")
    write("import: os\nprocess: os.chdir('elsewhere')\nmodel:\n  link/name=base:\n")
    assert outcome(capsys, "robot.yaml", "-o", "arm.urdf") == (0, "", "")
    assert os.listdir(".") == []
    assert os.path.exists("../arm.urdf")


def test_working_directory_that_is_gone_is_told() -> None:
    os.mkdir("gone")
    write(PLAIN)
    robot = os.path.abspath("robot.yaml")
    program = 'cd gone && rmdir ../gone && exec "$0" -m yamaro "$1"'
    result = subprocess.run(
        ["sh", "-c", program, sys.executable, robot],
        capture_output=True,
        check=False,
        timeout=PATIENCE,
    )
    assert result.returncode == 2
    assert b"error: the working directory no longer exists" in result.stderr


def test_streams_are_given_back(capsys: pytest.CaptureFixture[str]) -> None:
    before = (sys.stdout, sys.stderr, signal.getsignal(signal.SIGTERM))
    for words in (["-q"], [], ["--strict"]):
        for text in (PLAIN, WARNS, FAILS):
            main([write(text), *words])
    assert (sys.stdout, sys.stderr, signal.getsignal(signal.SIGTERM)) == before
    assert "Traceback" not in capsys.readouterr().err


def test_undecodable_and_odd_file_names_are_shown_escaped() -> None:
    result = run(b"no\xff\x1b\nwhere.yaml")
    assert result.returncode == 2
    assert b"\\x1b\\x0awhere.yaml" in result.stderr
    assert b"\x1b" not in result.stderr
    assert b"Traceback" not in result.stderr


@pytest.mark.skipif(sys.platform == "darwin", reason="macOS refuses such names")
def test_undecodable_file_names_work() -> None:
    name = b"r\xff.yaml"
    with open(name, "w", encoding="utf-8") as file:
        file.write(PLAIN)
    result = run(name, "-o", b"o\xff.urdf")
    assert (result.returncode, result.stderr) == (0, b"")
    with open(b"o\xff.urdf", encoding="utf-8") as file:
        assert file.read() == PLAIN_XML
    assert run(name, "--deps").stdout.endswith(b"/r\xff.yaml\n")


# --- colour -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("words", "environ", "is_colored"),
    [
        ([], {}, False),
        (["--color", "always"], {}, True),
        (["--color=always"], {"NO_COLOR": "1"}, True),
        ([], {"FORCE_COLOR": "1"}, True),
        ([], {"FORCE_COLOR": "1", "NO_COLOR": "1"}, False),
        ([], {"FORCE_COLOR": "1", "NO_COLOR": ""}, True),
        (["--color=never"], {"FORCE_COLOR": "1"}, False),
    ],
)
def test_colour_follows_option_and_environment(
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    words: list[str],
    environ: dict[str, str],
    is_colored: bool,
) -> None:
    for name, value in environ.items():
        monkeypatch.setenv(name, value)
    _, out, err = outcome(capsys, write(WARNS), *words)
    assert ("\033[" in err) == is_colored
    assert "\033[" not in out


@pytest.mark.parametrize(("term", "is_colored"), [("xterm", True), ("dumb", False)])
@pytest.mark.parametrize("stream", [pytest.param("stdout", marks=needs("tree")), "stderr"])
def test_colour_is_for_terminals(term: str, is_colored: bool, stream: str) -> None:
    import pty

    master, slave = pty.openpty()
    words = ["tree", write(ROBOT), "-q"] if stream == "stdout" else [write(WARNS)]
    subprocess.run(
        [sys.executable, "-m", "yamaro", *words],
        env={**os.environ, "TERM": term},
        stdout=slave if stream == "stdout" else subprocess.DEVNULL,
        stderr=slave if stream == "stderr" else subprocess.DEVNULL,
        check=False,
        timeout=PATIENCE,
    )
    os.close(slave)
    shown = os.read(master, 65536)
    os.close(master)
    assert (b"\033[" in shown) == is_colored


# --- the summary ------------------------------------------------------------------------------

WEIGHED = """\
robot: arm
model:
- part: {name: base, link: {inertial: {mass: 2.5, inertia: 1 0 0 1 0 1}}}
- part:
    name: tip
    joint: {type: fixed, parent: base}
    link: {inertial: {mass: 0.25, inertia: 1 0 0 1 0 1}}
- gazebo: {link/name=ghost: {inertial: {mass/value=7: }}}
"""
OTHER = "sdf/version=1.9:\n  world/name=w:\n    gravity: 0 0 -9.8\n"


def on_terminal(*words: str) -> str:
    """Return what the command writes to standard error if that is a terminal."""
    import pty

    master, slave = pty.openpty()
    subprocess.run(
        [sys.executable, "-m", "yamaro", *words],
        env={**os.environ, "TERM": "dumb"},
        stdout=subprocess.DEVNULL,
        stderr=slave,
        check=False,
        timeout=PATIENCE,
    )
    os.write(slave, b".")  # so that there is something to read
    os.close(slave)
    said = os.read(master, 65536).decode()
    os.close(master)
    return said.replace("\r\n", "\n").removesuffix(".")


@pytest.mark.parametrize(
    ("text", "summary"),
    [
        (WEIGHED, "2 links, 1 joint, 2.75 kg"),
        (PLAIN, "1 link, 0 joints"),
        (OTHER, "3 elements, 111 bytes"),
    ],
)
@pytest.mark.parametrize("mode", ["--trust", "--safe"])
def test_a_file_that_is_written_is_summed_up_on_a_terminal(
    text: str, summary: str, mode: str
) -> None:
    write(text)
    assert on_terminal("robot.yaml", "-o", "out/r.xml", mode) == f"out/r.xml: {summary}\n"
    if text == OTHER:
        assert summary.endswith(f", {Path('out/r.xml').stat().st_size} bytes")


@pytest.mark.parametrize(
    "words", [["-q", "-o", "r.urdf"], [], ["-o", "-"], ["--deps", "-o", "deps"], ["-qo", "r.urdf"]]
)
def test_there_is_no_summary_without_an_output_or_if_quiet(words: list[str]) -> None:
    write(PLAIN)
    assert on_terminal("robot.yaml", *words) == ""


def test_there_is_no_summary_of_what_could_not_be_written() -> None:
    write(PLAIN)
    os.mkdir("folder")
    said = on_terminal("robot.yaml", "-o", "folder")
    assert said == "yamaro: error: cannot write 'folder': Is a directory\n"


def test_there_is_no_summary_where_standard_error_is_no_terminal() -> None:
    result = run(write(WEIGHED), "-o", "r.urdf")
    assert (result.returncode, result.stdout, result.stderr) == (0, b"", b"")


# --- a process of its own ---------------------------------------------------------------------

NOISY = """\
import atexit, os, sys, warnings
print("import print")
os.write(1, b"descriptor\\n")
os.system("echo child")
sys.__stdout__.write("late text\\n")
atexit.register(print, "at exit")
warnings.warn("python warning", DeprecationWarning)
exec(compile("x = '\\\\d'; 1 is 1", "user", "exec"))
"""
NOISY_ROBOT = """\
robot: arm
import: noisy
process: print('process print')
model:
  link/name=base_1.0:
"""


def test_nothing_user_code_does_reaches_standard_output() -> None:
    write(NOISY, "noisy.py")
    result = run(write(NOISY_ROBOT))
    assert (result.returncode, result.stdout.decode()) == (0, PLAIN_XML)
    said = result.stderr.decode().splitlines()
    said.remove("late text")  # comes when Python empties its buffer
    assert said == ["import print", "descriptor", "child", "process print", "at exit"]


def test_quiet_run_silences_user_code_on_every_level() -> None:
    write(NOISY + "os.system('echo err >&2')\nprint('x', file=sys.stderr)\n", "noisy.py")
    result = run(write(NOISY_ROBOT), "-q")
    assert (result.returncode, result.stdout.decode(), result.stderr) == (0, PLAIN_XML, b"")
    result = run(write(NOISY_ROBOT + "  link/name=$(missing):\n"), "-q")
    assert (result.returncode, result.stdout) == (1, b"")
    assert result.stderr.startswith(b"error[")


def test_print_lines_come_as_they_are_made() -> None:
    write("print: first\nprocess: |\n  import time\n  time.sleep(600)\nmodel:\n")
    process = subprocess.Popen(
        [sys.executable, "-m", "yamaro", "robot.yaml"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    assert process.stdout is not None
    assert process.stderr is not None
    assert process.stderr.readline() == b"first\n"
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, out, err) == (130, b"", b"")


def test_python_warnings_about_user_code_are_shown_only_when_asked_for() -> None:
    write(PLAIN + "  print: $('\\d')\n")
    code = "import warnings\nwarnings.warn('python warning')\n"
    write(code, "noisy.py")
    write(NOISY_ROBOT.replace("print('process print')", "x = 1"))
    assert run("robot.yaml").stderr == b""
    assert b"python warning" in run("robot.yaml", python=("-W", "default")).stderr


def test_closed_pipe_is_quiet() -> None:
    write("list:\n" + "".join(f"  item: {n}\n" for n in range(5000)))
    read_end, write_end = os.pipe()
    os.close(read_end)
    process = subprocess.run(
        [sys.executable, "-m", "yamaro", "robot.yaml"],
        stdout=write_end,
        stderr=subprocess.PIPE,
        check=False,
        timeout=PATIENCE,
    )
    os.close(write_end)
    assert (process.returncode, process.stderr) == (141, b"")


@pytest.mark.skipif(not shutil.which("bash"), reason="needs bash")
def test_head_gets_its_lines_and_no_complaint() -> None:
    write("list:\n" + "".join(f"  item: {n}\n" for n in range(20000)))
    result = subprocess.run(
        ["bash", "-c", f"'{sys.executable}' -m yamaro robot.yaml | head -1"],
        capture_output=True,
        check=False,
        timeout=PATIENCE,
    )
    assert (result.stdout, result.stderr) == (b'<?xml version="1.0"?>\n', b"")


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
@pytest.mark.parametrize(
    ("words", "name"), [([], "to standard output"), (["-o", "/dev/full"], "'/dev/full'")]
)
def test_full_disk_is_one_line(words: list[str], name: str) -> None:
    write(PLAIN)
    with open("/dev/full", "wb") as full:
        process = subprocess.run(
            [sys.executable, "-m", "yamaro", "robot.yaml", *words],
            stdout=full,
            stderr=subprocess.PIPE,
            check=False,
            timeout=PATIENCE,
        )
    assert process.returncode == 1
    assert process.stderr.decode() == (
        f"yamaro: error: cannot write {name}: No space left on device\n"
    )


def test_output_that_cannot_be_made_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    write(PLAIN)
    os.mkdir("out")
    expected = "yamaro: error: cannot write 'out': Is a directory\n"
    assert outcome(capsys, "robot.yaml", "-o", "out") == (1, "", expected)
    expected = "yamaro: error: cannot write 'robot.yaml/x': Not a directory\n"
    assert outcome(capsys, "robot.yaml", "-o", "robot.yaml/x") == (1, "", expected)


@pytest.mark.parametrize("closed", [(0,), (1,), (2,), (0, 1, 2)])
def test_closed_standard_streams_do_no_harm(closed: tuple[int, ...]) -> None:
    write(PLAIN)
    closing = " ".join(f"{number}>&-" for number in closed)
    result = subprocess.run(
        ["sh", "-c", f"'{sys.executable}' -m yamaro robot.yaml {closing}"],
        capture_output=True,
        check=False,
        timeout=PATIENCE,
    )
    assert result.returncode == (1 if 1 in closed else 0)
    if 1 not in closed:
        assert result.stdout.decode() == PLAIN_XML
    assert result.stderr.decode() == (
        "yamaro: error: cannot write to standard output: Bad file descriptor\n"
        if closed == (1,)
        else ""
    )


def test_module_and_script_are_the_same() -> None:
    script = Path(sys.executable).with_name("yamaro")
    if not script.exists():
        pytest.skip("the script is not installed beside the interpreter")
    write(PRINTS)
    by_script = subprocess.run(
        [str(script), "robot.yaml"], capture_output=True, check=False, timeout=PATIENCE
    )
    by_module = run("robot.yaml")
    assert by_script.stdout == by_module.stdout
    assert by_script.stderr == by_module.stderr == b"one\ntwo\n"


# --- start-up ---------------------------------------------------------------------------------

# Modules that cost start-up time and that a plain conversion must not import.
HEAVY = {"argparse", "re", "pathlib", "dataclasses", "typing", "logging", "enum", "inspect", "ast"}
HEAVY |= {"difflib", "signal", "threading", "importlib.metadata", "numpy", "unicodedata", "json"}
HEAVY |= {"importlib", "collections", "functools", "contextlib", "urllib.parse", "bisect", "yaml"}
RUN = "from yamaro.commands.main import main; assert main() == 0"
ARM = """\
robot: arm
variables: {length: 1.0}
functions:
  Rod:
    input: index
    body:
      part:
        name: rod_$(index)
        joint: {type: continuous, parent: root_link, axis: 0 1 0, dynamics/friction=0.1: }
        link: {geometry: cylinder, scale: 0.1 $(length), mass: 1, visual: , collision: }
model:
  link/name=root_link:
  for: {iterator: i, range: 3, body: {Rod: $(i)}}
"""


def imported(code: str, *words: str, stdin: str = "") -> set[str]:
    """Return the modules loaded after code has run in a process of its own."""
    import yaml

    import yamaro

    paths = [str(Path(module.__file__ or "").parents[1]) for module in (yamaro, yaml)]
    code = f"import sys; {code}; print(*sys.modules, file=sys.stderr)"
    result = subprocess.run(
        [sys.executable, "-S", "-c", code, *words],
        input=stdin.encode(),
        capture_output=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
        check=True,
        timeout=PATIENCE,
    )
    return set(result.stderr.decode().split())


@pytest.mark.parametrize("words", [["robot.yaml"], ["robot.yaml", "-o", "x", "length:=2"], ["-"]])
@pytest.mark.parametrize("text", [PLAIN, ARM], ids=["plain", "parts"])
def test_a_conversion_imports_little(words: list[str], text: str) -> None:
    write(text)
    stdin = text if words == ["-"] else ""
    modules = imported(
        "from yamaro.commands.main import main; assert main() == 0", *words, stdin=stdin
    )
    assert HEAVY.isdisjoint(modules), sorted(HEAVY.intersection(modules))


@pytest.mark.parametrize(
    ("text", "unused"),
    [
        (ARM, "yamaro.model.inertia"),
        (PLAIN, "yamaro.robot.part"),
        ("launch: {node/name=n: }\n", "yamaro.robot"),
        (ARM, "yamaro.syntax.argument_section"),
        (ARM, "yamaro.runtime.argument_values"),
        (ARM, "yamaro.units"),
    ],
    ids=["no meshes", "no parts", "no robot", "no section", "no arguments", "no units"],
)
def test_what_a_document_does_not_need_is_not_imported(text: str, unused: str) -> None:
    write(text)
    modules = imported(RUN, "robot.yaml")
    assert "yamaro.pipeline" in modules
    assert unused not in modules


@pytest.mark.parametrize(
    ("code", "words"),
    [
        ("import yamaro; yamaro.__version__", []),
        ("from yamaro.commands.main import main; main()", ["--version"]),
        ("from yamaro.commands.main import main; main()", ["completion", "bash"]),
    ],
    ids=["package", "version", "completion"],
)
def test_what_compiles_nothing_does_not_import_the_compiler(code: str, words: list[str]) -> None:
    modules = imported(code, *words)
    assert {"yamaro.pipeline", "yaml._yaml"}.isdisjoint(modules)


# --- completion -------------------------------------------------------------------------------


def test_variables_of_a_file_are_listed_without_running_it(
    capsys: pytest.CaptureFixture[str],
) -> None:
    write(
        "import: danger\n"
        "process: open('ran', 'w')\n"
        "variables:\n"
        "  length/global: 1.0\n"
        "  legs: [1,\n    2]\n"
        "  $(dynamic): 1\n"
        "variables:\n"
        "- side: left\n"
        "- text: '" + "x" * 100 + "'\n"
    )
    write("open('ran', 'w')", "danger.py")
    status, out, err = outcome(capsys, "completion", "variables", "robot.yaml")
    assert (status, err) == (0, "")
    shortened = "'" + "x" * 38 + "…"
    assert out == f"length:=\t1.0\nlegs:=\t[1, 2]\nside:=\tleft\ntext:=\t{shortened}\n"
    assert not os.path.exists("ran")


@pytest.mark.parametrize("text", ["", "a: [", "- 1\n", "just text", "variables: 3\n"])
def test_files_without_variables_list_none(capsys: pytest.CaptureFixture[str], text: str) -> None:
    assert outcome(capsys, "completion", "variables", write(text)) == (0, "", "")


def test_what_is_no_file_lists_no_variables(capsys: pytest.CaptureFixture[str]) -> None:
    os.mkfifo("pipe")
    Path("binary").write_bytes(b"\xff\xfe\x00")
    for name in ("missing", ".", "pipe", "binary", "~/missing"):
        assert outcome(capsys, "completion", "variables", name) == (0, "", "")


@pytest.mark.parametrize("shell", SHELLS)
def test_completion_scripts_are_valid_and_name_every_option(
    capsys: pytest.CaptureFixture[str], shell: str
) -> None:
    status, out, err = outcome(capsys, "completion", shell)
    assert (status, err) == (0, "")
    for option in all_spellings():
        if shell == "fish":
            option = f"-l {option[2:]}" if option.startswith("--") else f"-s {option[1:]}"
        assert option in out
    if shutil.which(shell):
        write(out, "script")
        result = subprocess.run([shell, "-n", "script"], capture_output=True, check=False)
        assert (result.returncode, result.stderr) == (0, b"")


def on_path() -> dict[str, str]:
    """Return an environment in which `yamaro` is the one under test."""
    os.makedirs("bin", exist_ok=True)
    write(f"#!/bin/sh\nexec '{sys.executable}' -m yamaro \"$@\"\n", "bin/yamaro")
    os.chmod("bin/yamaro", 0o755)
    return {**os.environ, "PATH": f"{os.getcwd()}/bin{os.pathsep}{os.environ['PATH']}"}


TOOL = """
arguments:
  grip: {default: none, choices: [none, vacuum, two fingers]}
  solid: true
  size: 3
"""


def test_values_of_an_argument_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    path = write(TOOL)
    assert outcome(capsys, "completion", "values", path, "grip") == (0, "none\nvacuum\n", "")
    assert outcome(capsys, "completion", "values", path, "solid") == (0, "true\nfalse\n", "")
    for name in ("size", "nothing"):
        assert outcome(capsys, "completion", "values", path, name) == (0, "", "")
    write("variables: {on: false, n: 3}\n", "other.yaml")
    assert outcome(capsys, "completion", "values", "other.yaml", "on")[1] == "true\nfalse\n"
    assert outcome(capsys, "completion", "values", "missing.yaml", "on") == (0, "", "")


@pytest.mark.skipif(not shutil.which("bash"), reason="needs bash")
@pytest.mark.parametrize(
    ("line", "words", "expected"),
    marked(
        [
            (
                "yamaro ",
                ["yamaro", ""],
                (
                    "a.urdf args bin check completion diff fit fmt guide help lsp mcp migrate new "
                    "picture robot.yaml sweep test tree two.yml view watch why"
                ),
            ),
            ("yamaro ro", ["yamaro", "ro"], "robot.yaml"),
            ("yamaro check ro", ["yamaro", "check", "ro"], "robot.yaml"),
            ("yamaro robot.yaml ", ["yamaro", "robot.yaml", ""], "legs:= length:="),
            ("yamaro robot.yaml le", ["yamaro", "robot.yaml", "le"], "legs:= length:="),
            ("yamaro robot.yaml legs:=", ["yamaro", "robot.yaml", "legs", ":="], ""),
            ("yamaro tool.yaml grip:=", ["yamaro", "tool.yaml", "grip", ":=", ""], "none vacuum"),
            ("yamaro tool.yaml grip:=v", ["yamaro", "tool.yaml", "grip", ":=", "v"], "vacuum"),
            ("yamaro tool.yaml solid:=", ["yamaro", "tool.yaml", "solid", ":=", ""], "false true"),
            ("yamaro tool.yaml size:=", ["yamaro", "tool.yaml", "size", ":=", ""], ""),
            (
                "yamaro robot.yaml legs:=3 len",
                ["yamaro", "robot.yaml", "legs", ":=", "3", "len"],
                "length:=",
            ),
            ("yamaro robot.yaml -o a", ["yamaro", "robot.yaml", "-o", "a"], "a.urdf"),
            ("yamaro --st", ["yamaro", "--st"], "--strict"),
            ("yamaro check --dep", ["yamaro", "check", "--dep"], ""),
            ("yamaro check a", ["yamaro", "check", "a"], "a.urdf"),
            ("yamaro picture --tu", ["yamaro", "picture", "--tu"], "--turn"),
            ("yamaro picture --view le", ["yamaro", "picture", "--view", "le"], "left"),
            ("yamaro picture --show i", ["yamaro", "picture", "--show", "i"], "inertia"),
            ("yamaro picture --size 9x9 ro", "yamaro picture --size 9x9 ro".split(), "robot.yaml"),
            ("yamaro --color=al", ["yamaro", "--color", "=", "al"], "always"),
            ("yamaro tree --sa", ["yamaro", "tree", "--sa"], "--safe"),
            ("yamaro --limit yaml", ["yamaro", "--limit", "yaml"], "yaml-depth="),
            ("yamaro --limit=yaml", ["yamaro", "--limit", "=", "yaml"], "yaml-depth="),
            ("yamaro --limit turns=", ["yamaro", "--limit", "turns", "="], ""),
            ("yamaro --limit=turns=5", ["yamaro", "--limit", "=", "turns", "=", "5"], ""),
            ("yamaro --timeout ", ["yamaro", "--timeout", ""], ""),
            ("yamaro --timeout=1", ["yamaro", "--timeout", "=", "1"], ""),
            ("yamaro --allow-path a", ["yamaro", "--allow-path", "a"], "a.urdf"),
            (
                "yamaro --safe --limit turns=5 --timeout 9 --allow-path bin robot.yaml leg",
                [
                    *"yamaro --safe --limit turns = 5 --timeout 9 --allow-path bin".split(),
                    "robot.yaml",
                    "leg",
                ],
                "legs:=",
            ),
            ("yamaro completion z", ["yamaro", "completion", "z"], "zsh"),
            ("yamaro view a", ["yamaro", "view", "a"], "a.urdf"),
            ("yamaro view --no", ["yamaro", "view", "--no"], "--no-browser"),
            ("yamaro view --port 80 ro", ["yamaro", "view", "--port", "80", "ro"], "robot.yaml"),
            ("yamaro watch --out", ["yamaro", "watch", "--out"], "--output"),
            ("yamaro help pi", ["yamaro", "help", "pi"], "picture"),
            ("yamaro migrate --fo", ["yamaro", "migrate", "--fo"], "--force"),
            ("yamaro tree --fo", ["yamaro", "tree", "--fo"], ""),
        ]
    ),
)
def test_bash_completes(line: str, words: list[str], expected: str) -> None:
    write("variables: {length: 1, legs: 4}\n")
    if "tool.yaml" in words:
        write(TOOL, "tool.yaml")
    write("", "two.yml")
    write("", "a.urdf")
    write(script("bash"), "script")
    program = 'source ./script; COMP_LINE=$1; COMP_POINT=${#1}; shift; COMP_WORDS=("$@")\n'
    program += 'COMP_CWORD=$(($# - 1)); _yamaro; printf "%s\\n" "${COMPREPLY[@]}"'
    result = subprocess.run(
        ["bash", "--norc", "-c", program, "bash", line, *words],
        capture_output=True,
        env=on_path(),
        text=True,
        check=True,
        timeout=PATIENCE,
    )
    assert result.stderr == ""
    found = [word for word in result.stdout.split() if word != "script"]
    assert sorted(found) == expected.split()


@pytest.mark.skipif(not shutil.which("fish"), reason="needs fish")
@pytest.mark.parametrize(
    ("line", "expected"),
    marked(
        [
            ("yamaro ro", "robot.yaml"),
            ("yamaro robot.yaml ", "legs:= length:="),
            ("yamaro check robot.yaml len", "length:="),
            ("yamaro --st", "--strict"),
            ("yamaro tree --sa", "--safe"),
            ("yamaro --limit yaml", "yaml-depth="),
            ("yamaro --limit=yaml", "--limit=yaml-depth="),
            ("yamaro --timeout ", ""),
            ("yamaro --allow-path scr", "script"),
            ("yamaro --safe --limit turns=5 --timeout 9 --allow-path bin robot.yaml leg", "legs:="),
            ("yamaro completion ", "bash fish zsh"),
        ]
    ),
)
def test_fish_completes(line: str, expected: str) -> None:
    write("variables: {length: 1, legs: 4}\n")
    write(script("fish"), "script")
    result = subprocess.run(
        ["fish", "--no-config", "-c", "source ./script; complete -C $argv[1]", line],
        capture_output=True,
        env={**on_path(), "HOME": os.getcwd()},
        text=True,
        check=True,
        timeout=PATIENCE,
    )
    found = [found.partition("\t")[0] for found in result.stdout.splitlines()]
    assert sorted(found) == expected.split()


# --- the severity of messages -----------------------------------------------------------------

TWO_ROOTS = "robot: r\nmodel:\n- link/name=a:\n- link/name=b:\n"


def test_a_robot_that_parsers_refuse_does_not_replace_a_good_file(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("two.yaml").write_text(TWO_ROOTS)
    Path("robot.urdf").write_text("good")
    status, _, said = outcome(capsys, "two.yaml", "-o", "robot.urdf")
    assert status == 1
    assert said.startswith("error[several-roots]")
    assert Path("robot.urdf").read_text() == "good"
    status, _, said = outcome(capsys, "two.yaml", "-o", "robot.urdf", "--allow", "several-roots")
    assert status == 0
    assert said.startswith("warning[several-roots]")
    assert '<link name="b"/>' in Path("robot.urdf").read_text()


@pytest.mark.parametrize("command", marked([[], ["check"], ["tree"]]))
@pytest.mark.parametrize("mode", ["--trust", "--safe", "--jail"])
def test_what_is_allowed_is_a_warning_in_each_command_and_mode(
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    command: list[str],
    mode: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("two.yaml").write_text(TWO_ROOTS)
    words = (*command, "two.yaml", mode)
    assert outcome(capsys, *words)[0] == 1
    status, _, said = outcome(capsys, *words, "--allow=several-roots", "--strict")
    assert (status, said.partition("[")[0]) == (0, "warning")


def test_what_is_denied_is_an_error_also_if_it_is_only_advice(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    box = "    visual:\n      geometry:\n        box/size=1 1 0:\n"
    Path("r.yaml").write_text(f"robot: r\nmodel:\n- link/name=a/b:\n{box}")
    status, _, said = outcome(capsys, "r.yaml")
    assert (status, said.count("slash-in-name")) == (0, 0)
    for codes in (["bad-size"], ["slash-in-name"], ["bad-size", "slash-in-name"]):
        options = [word for code in codes for word in ("--deny", code)]
        status, out, said = outcome(capsys, "r.yaml", *options)
        assert (status, out) == (1, "")
        assert [code for code in codes if f"error[{code}]" not in said] == []
        assert "slash-in-name" in codes or "slash-in-name" not in said


@pytest.mark.parametrize("command", marked(["", "check", "tree", "view", "watch", "picture"]))
@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--allow", "several-rots"], "did you mean 'several-roots'?"),
        (["--deny", "nonsense"], "'nonsense' is not a code that can be allowed or denied"),
        (["--allow", "yaml-syntax"], "'yaml-syntax' is not a code that can be allowed or denied"),
        (
            ["--allow", "no-link", "--deny", "no-link"],
            "'no-link' cannot be both allowed and",
        ),
        (["--allow"], "'--allow' needs the code of a message after it"),
    ],
)
def test_a_code_that_cannot_be_chosen_is_wrong_usage(
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    command: str,
    options: list[str],
    message: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("two.yaml").write_text(TWO_ROOTS)
    words = [command] if command else []
    output = {"watch": ["-o", "a.urdf"], "picture": ["-o", "a.png"]}.get(command, [])
    status, out, said = outcome(capsys, *words, "two.yaml", *output, *options)
    assert (status, out) == (2, "")
    assert message in said
