"""The attacks on safe mode, as what they are: files that someone runs with `yamaro --safe`.

tests/safe/test_code.py runs the same attacks while Python watches what they reach.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.effort import tried
from tests.hostile.escape_payloads import Payload, read_payloads
from tests.hostile.hostile_inputs import OLD_OUTPUT
from tests.test_hostile import HEAD, PLACE
from yamaro.commands.main import main

pytest.importorskip("numpy")

LEGS = "variables: {count/parent: 4}\nmodel:\n"
BEFORE = """\
import: [math, statistics, numpy, numpy as np]
variables:
  numbers: [1, 2, 3]
  words: {a: 1, b: [2]}
  pairs: {a: 1, a: 2}
doc:
- include: {path: legs.yaml, namespace: Legs}
"""
STATEMENTS = BEFORE + "- process: |2\n"
KEPT = BEFORE + "- variables:\n    x: |4-\n"
WRITTEN = BEFORE + "- item:\n    x: |4-\n"
SECRET = "canary-in-the-environment"

MANY_STEPS = 1_000_000  # of the usual 50 million, which take their time
# The bracket in it ends the expression, and what is behind is text.
TEXT_IN_A_FILE = ("an expression that closes the bracket around it",)

# What the code of an attack is called when it is written in a file.
CODES = {
    "SyntaxError": {"python-syntax", "unclosed-expression", "empty-expression", "dollar-in-string"},
    "MemoryError": {"too-deep", "python-syntax", "limit-memory"},
    "RecursionError": {"too-deep", "python-syntax"},
    "ValueError": {"python-error", "number-too-long", "python-syntax"},
}


def as_file(payload: Payload) -> tuple[str, int, int]:
    """Return the file with an attack in it, and the first and last line of the attack."""
    is_block = payload.mode == "exec"
    text = payload.text if is_block else f"$({payload.text}\n)"
    margin = " " * (4 if is_block else 8)
    lines = re.split("\r\n|\r|\n", text)
    before = STATEMENTS if is_block else KEPT if payload.code == "harmless" else WRITTEN
    whole = before + "".join(f"{margin}{line}\n" for line in lines)
    first = before.count("\n") + 1
    return whole, first, first + len(lines) - 1


def expected_codes(payload: Payload) -> set[str]:
    codes = set()
    for word in payload.code.split():
        is_exception = word[0].isupper()
        codes |= CODES.get(word, {"python-error"}) if is_exception else {word}
    if "pairs" in payload.text:  # which in a file are a plain dict
        codes.add("python-error")
    return codes if payload.text.isprintable() else codes | {"control-character"}


@pytest.mark.parametrize(
    "payload",
    tried(read_payloads(), lambda payload: payload.name, quick=4, usual=2),
    ids=lambda payload: f"{payload.file}: {payload.name}",
)
def test_the_command_refuses_an_attack_at_its_place(
    payload: Payload,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("SECRET", SECRET)
    text, first, last = as_file(payload)
    (tmp_path / "robot.yaml").write_bytes(text.encode("utf-8", "surrogatepass"))
    (tmp_path / "legs.yaml").write_text(LEGS)
    (tmp_path / "out.urdf").write_bytes(OLD_OUTPUT)
    before = set(tmp_path.iterdir())
    steps = payload.steps or (MANY_STEPS if payload.code == "limit-steps" else None)
    limits = ["--limit", f"steps={steps}"] if steps else []
    status = main(["robot.yaml", "--safe", *limits, "-o", "out.urdf"])
    written = capsys.readouterr()
    assert written.out == ""
    assert SECRET not in written.err
    assert set(tmp_path.iterdir()) == before
    if payload.code == "harmless" or payload.name in TEXT_IN_A_FILE:
        assert status == 0, written.err
        return
    assert status == 1, written.err
    assert (tmp_path / "out.urdf").read_bytes() == OLD_OUTPUT
    codes = [code for severity, code in HEAD.findall(written.err) if severity == "error"]
    assert set(codes) <= expected_codes(payload), written.err
    places = [(name, int(line)) for name, line, _ in PLACE.findall(written.err)]
    assert places
    for name, line in places:
        assert name == "robot.yaml" and first <= line <= last, written.err
