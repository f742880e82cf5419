"""Hostile and broken files: each ends in a diagnostic at its place, and nothing is lost.

tests/hostile/hostile_inputs.py says how they are written down.
"""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from lxml import etree

from tests.hostile.hostile_inputs import OLD_OUTPUT, HostileInput, Place, read_inputs
from tests.waiting import PATIENCE
from yamaro.commands.main import main
from yamaro.commands.option_table import all_spellings
from yamaro.terminal import printable

ROOT = Path(__file__).parent.parent
OPTIONS = all_spellings()
INPUTS = read_inputs()
LONGEST_MESSAGES = 5_000
HEAD = re.compile(r"^(error|warning)\[([a-z0-9.-]+)\]: ", re.MULTILINE)
PLACE = re.compile(r"^ --> (.*):(\d+):(\d+)$", re.MULTILINE)
HERE = {
    "posix": os.name == "posix",
    "linux": sys.platform == "linux",
    "not-root": not hasattr(os, "geteuid") or os.geteuid() != 0,
}
RUN_ALONE = """
import resource, sys
sys.settrace(None)  # with a tool that looks on there is no deep stack
sys.path.pop(0)  # the folder of the robot, where nothing is to be found by chance
resource.setrlimit(resource.RLIMIT_AS, (int(sys.argv[1]),) * 2)
from yamaro.sandbox import process
process.GRACE = float(sys.argv[2])
from yamaro.commands.main import main
sys.argv[:3] = ["yamaro"]
sys.exit(main())
"""


class Outcome:
    """What the command made of an input."""

    def __init__(self, status: int, out: str, err: str) -> None:
        self.status = status
        self.out = out
        self.err = err
        found = HEAD.findall(err)
        self.codes = [code for severity, code in found if severity == "error"]
        self.warnings = [code for severity, code in found if severity == "warning"]

    def first_place(self) -> Place:
        """Return where the first error points, with the text above the carets."""
        block = re.split(r"^error\[", self.err, maxsplit=1, flags=re.MULTILINE)[1]
        found = PLACE.search(block)
        assert found, block
        place = Place(found[1], int(found[2]), int(found[3]), None)
        shown = re.search(r"^ *\d+ \| (.*)\n *\| ([ \t]*)(\^+)$", block, re.MULTILINE)
        if shown and shown[1].strip("…").isascii():  # carets are as wide as what is above them
            start = len(shown[2])
            place.text = shown[1][start : start + len(shown[3])]
        return place


def run_here(hostile: HostileInput, capsys: pytest.CaptureFixture[str]) -> Outcome:
    status = main(hostile.arguments)
    written = capsys.readouterr()
    return Outcome(status, written.out, written.err)


def run_alone(hostile: HostileInput) -> Outcome:
    # Seconds in which an attack may end by itself, before it is ended from outside.
    grace = "1" if "-15" in (hostile.field("status") or "") else str(PATIENCE)
    done = subprocess.run(
        [sys.executable, "-c", RUN_ALONE, str(hostile.memory), grace, *hostile.arguments],
        capture_output=True,
        timeout=PATIENCE,
        check=False,
    )
    return Outcome(done.returncode, done.stdout.decode(), done.stderr.decode("utf-8", "replace"))


@pytest.fixture
def outcome(
    hostile: HostileInput,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> Outcome:
    """What comes of the input, in a folder with its files and an older output."""
    for condition in hostile.only:
        if not HERE[condition]:
            pytest.skip(f"needs to be {condition}")
    monkeypatch.chdir(tmp_path)
    for name, value in hostile.environment.items():
        monkeypatch.setenv(name, value)
    (tmp_path / "out.urdf").write_bytes(OLD_OUTPUT)
    for file in hostile.files:
        file.write(tmp_path)
    outcome = run_alone(hostile) if hostile.memory else run_here(hostile, capsys)
    if printed := hostile.field("prints"):
        assert outcome.err.startswith(printed)
        outcome.err = outcome.err.replace(printed + "\n", "")
    return outcome


def is_there(hostile: HostileInput) -> bool:
    return not hostile.see and all(option in OPTIONS for option in hostile.needs)


RUNNING = [hostile for hostile in INPUTS if is_there(hostile)]
BAD = [hostile for hostile in RUNNING if hostile.codes]
MISCALLED = [hostile for hostile in RUNNING if "usage" in hostile.fields]
FINE = [hostile for hostile in RUNNING if "fine" in hostile.fields]


def check_what_is_said(hostile: HostileInput, outcome: Outcome) -> None:
    """Check what holds for every input."""
    assert "Traceback" not in outcome.err
    assert "internal error" not in outcome.err
    assert len(outcome.err) < LONGEST_MESSAGES
    assert outcome.warnings == hostile.warnings
    for piece in hostile.fields.get("says", ()):
        assert piece in outcome.err
    steering = [char for char in outcome.err if char != "\n" and char != "\t" and char < " "]
    assert not steering, "standard error holds control characters"


def either(found: list[str], expected: list[str]) -> list[str]:
    """Return the codes that are expected; of `one/or/the/other` the one that was found."""
    found = found + [""] * len(expected)
    return [
        code if code in choice.split("/") else choice
        for code, choice in zip(found, expected, strict=False)
    ]


@pytest.mark.parametrize("hostile", BAD, ids=str)
def test_bad_input_ends_in_its_diagnostic(
    hostile: HostileInput, outcome: Outcome, tmp_path: Path
) -> None:
    assert outcome.codes == either(outcome.codes, hostile.codes), outcome.err
    assert outcome.status in [int(word) for word in (hostile.field("status") or "1").split()]
    assert outcome.out == ""
    check_what_is_said(hostile, outcome)
    assert re.match(r"(error|warning)\[", outcome.err)
    if not hostile.fields.get("command"):
        assert (tmp_path / "out.urdf").read_bytes() == OLD_OUTPUT
    assert not list(tmp_path.glob(".yamaro-*"))
    if hostile.field("place") == "anywhere":
        return
    expected, found = hostile.place, outcome.first_place()
    assert expected is not None, f"no place is expected; found {found}"
    if sys.version_info < (3, 11):
        # Python 3.10 knows no columns of what it runs.
        assert (found.name, found.line) == (expected.name, expected.line), outcome.err
        assert found.column <= expected.column, outcome.err
        return
    if hostile.field("place") == "inside":
        assert (found.name, found.line) == (expected.name, expected.line), outcome.err
        assert 0 <= found.column - expected.column < len(expected.text or ""), outcome.err
        return
    assert str(found) == str(expected), outcome.err
    if expected.text and expected.text.isascii() and found.text is not None:
        line = printable(re.split("[\r\n]", expected.text)[0])
        assert found.text == line[: len(found.text)], outcome.err
        assert len(found.text) == len(line) or len(line) > 60


@pytest.mark.parametrize("hostile", MISCALLED, ids=str)
def test_what_cannot_be_begun_is_told_in_a_line(
    hostile: HostileInput, outcome: Outcome, tmp_path: Path
) -> None:
    first, *rest = outcome.err.splitlines()
    assert first.startswith("yamaro: error: "), outcome.err
    assert hostile.field("usage") in first
    assert (outcome.status, outcome.out) == (2 if rest else 1, "")
    check_what_is_said(hostile, outcome)
    old = tmp_path / "out.urdf"
    assert not old.exists() or old.read_bytes() == OLD_OUTPUT


@pytest.mark.parametrize("hostile", FINE, ids=str)
def test_odd_but_legal_input_is_compiled(
    hostile: HostileInput, outcome: Outcome, tmp_path: Path
) -> None:
    assert (outcome.status, outcome.codes, outcome.out) == (0, [], ""), outcome.err
    check_what_is_said(hostile, outcome)
    assert outcome.err == "" or hostile.warnings or hostile.fields.get("says")
    xml = (tmp_path / "out.urdf").read_bytes()
    assert etree.fromstring(xml, etree.XMLParser(huge_tree=True)) is not None
    for piece in hostile.fields["fine"]:
        assert piece in xml.decode(), xml.decode()[:1000]


# --- is all there? ------------------------------------------------------------------------------


def test_every_input_says_what_has_to_come_of_it() -> None:
    for hostile in INPUTS:
        ends = [key for key in ("codes", "usage", "fine", "see") if key in hostile.fields]
        assert len(ends) == 1, f"{hostile}: {ends}"


def test_no_two_inputs_have_one_name() -> None:
    names = [str(hostile) for hostile in INPUTS]
    assert sorted({name for name in names if names.count(name) > 1}) == []


def test_there_are_at_least_as_many_inputs_as_promised() -> None:
    assert len([hostile for hostile in INPUTS if not hostile.see]) >= 250


def test_every_number_of_the_research_is_there() -> None:
    numbers = {number for hostile in INPUTS for number in hostile.numbers}
    assert sorted(set(range(1, 127)) - numbers) == []
    assert max(numbers) == 126


@pytest.mark.parametrize("hostile", [one for one in INPUTS if one.see], ids=str)
def test_what_is_tried_elsewhere_is_there(hostile: HostileInput) -> None:
    file, _, function = hostile.see.partition("::")
    tree = ast.parse((ROOT / file).read_text(encoding="utf-8"))
    assert function in {node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)}


def test_every_option_that_an_input_needs_is_one_of_the_command() -> None:
    known = {"--safe", "--jail", "--trust", "--limit", "--timeout", "--allow-path", *OPTIONS}
    assert {option for hostile in INPUTS for option in hostile.needs} <= known


def test_no_module_of_the_working_directory_is_run(tmp_path: Path) -> None:
    (tmp_path / "robot.yaml").write_text("import: [math]\ndoc: $(math.floor(2.5))\n")
    for name in ("ast", "resource", "yaml"):  # what Python imports for -m it has from there
        (tmp_path / f"{name}.py").write_text("open('harm', 'w')\n")
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(
        [sys.executable, "-m", "yamaro", "robot.yaml"],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.stdout, done.stderr) == ('<?xml version="1.0"?>\n<doc>2</doc>\n', "")
    assert not (tmp_path / "harm").exists()


def test_a_file_that_changes_while_it_is_compiled_is_taken_as_it_was_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "robot.yaml").write_text(
        "model: {include: leg.yaml, process: \"open('leg.yaml', 'w').write('model: {b: }')\"}\n"
        "model: {include: leg.yaml}\n"
    )
    (tmp_path / "leg.yaml").write_text("model: {link/name=a: }")
    monkeypatch.chdir(tmp_path)
    main(["robot.yaml", "-q", "--allow", "duplicate-link"])
    assert capsys.readouterr().out.count('<link name="a"/>') == 2
