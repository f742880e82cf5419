"""A variant that crashes, hangs, ends the process or takes too much memory costs that variant."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest

import yamaro
from yamaro.policy import Policy

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="ends processes by signals")

ROBOT = """\
robot: hostile
import: [ctypes, os, sys, time]
arguments:
  n: {type: integer, range: [0, 9], default: 0}
model:
- part: {name: base, link: {geometry: box, scale: 1 1 1, mass: $(1 + n)}}
- process: |
"""
CRASH = "    if n == 3: ctypes.string_at(0)\n"


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def columns_of(code: str, **options: Any) -> dict[str, list[Any]]:
    """Return the table of a sweep of a robot that runs this code, all but `n == 3` being fine."""
    Path("robot.yaml").write_text(ROBOT + code)
    wanted = {"chunk": 5, "engine": "local:1", **options}
    columns = yamaro.sweep("robot.yaml", "runs", **wanted).columns()
    assert [status for n, status in enumerate(columns["status"]) if n != 3] == ["ok"] * 9
    assert columns["n"] == list(range(10))
    assert columns["status"][3] == "failed"
    return columns


@pytest.mark.parametrize(
    ("code", "message"),
    [
        (CRASH, "SIGSEGV"),
        ("    if n == 3: os._exit(7)\n", "exit status 7"),
        ("    if n == 3: os.kill(os.getpid(), 9)\n", "SIGKILL"),
    ],
)
def test_a_variant_that_ends_its_process_costs_that_variant(code: str, message: str) -> None:
    columns = columns_of(code)
    assert columns["code"][3] == "variant-crash"
    assert message in columns["message"][3]


@pytest.mark.parametrize("code", ["time.sleep(1e6)", "while True: pass"])
def test_a_variant_that_hangs_costs_that_variant(code: str) -> None:
    columns = columns_of(f"    if n == 3:\n        {code}\n", timeout=3)
    assert columns["code"][3] == "variant-timeout"
    assert columns["message"][3] == "took longer than 3 s"


def test_what_takes_too_much_memory_costs_that_variant() -> None:
    pytest.importorskip("resource")
    policy = Policy(limits={"memory": 1 << 28})
    columns = columns_of("    if n == 3: x = bytearray(8 << 30)\n", policy=policy)
    assert columns["code"][3] == "limit-memory"


def test_a_crash_that_does_not_come_again_costs_nothing() -> None:
    code = "    if n == 3 and not os.path.exists('seen'):\n"
    code += "        open('seen', 'w').close(); ctypes.string_at(0)\n"
    Path("robot.yaml").write_text(ROBOT + code)
    columns = yamaro.sweep("robot.yaml", "runs", chunk=5).columns()
    assert columns["status"] == ["ok"] * 10


def test_a_function_that_ends_the_program_costs_that_variant() -> None:
    Path("walk.py").write_text(
        "import sys\ndef score(arguments):\n"
        "    if arguments['n'] == 3: sys.exit(1)\n    return {'n2': arguments['n'] ** 2}\n"
    )
    columns = columns_of("    x = n\n", evaluate="walk.py:score")
    assert columns["code"][3] in ("variant-exit", "evaluate-failed")
    assert columns["n2"][:5] == [0.0, 1.0, 4.0, None, 16.0]


def test_trust_is_that_of_the_command_in_all_workers() -> None:
    from yamaro.sandbox.jail import check_available

    Path("safe.yaml").write_text(
        ROBOT.replace("import: [ctypes, os, sys, time]\n", "") + "    x = n\n"
    )
    columns = yamaro.sweep("safe.yaml", "safe", policy=Policy("safe"), chunk=5).columns()
    assert columns["status"] == ["ok"] * 10
    if check_available() is None:
        columns = columns_of("    if n == 3: open('written', 'w')\n", policy=Policy("jail"))
        assert columns["code"][3] == "python-error"
        assert not Path("written").exists()
