"""Compiles each tests/cases/<area>/<name>.yaml and compares all it writes, to the character.

tests/cases/README.md says how a case is written.
"""

from __future__ import annotations

import difflib
import platform
import re
import shlex
import sys
from pathlib import Path
from typing import Any

import pytest
from lxml import etree
from packaging.specifiers import SpecifierSet

from tests.effort import sample
from tests.unshared import unsharing
from yamaro import pipeline
from yamaro.commands.main import main
from yamaro.sandbox import jail

CASES = Path(__file__).parent / "cases"
OPTIONS = ("args", "command", "env", "python", "strict")


def find_cases() -> list[Path]:
    return sorted(path for path in CASES.glob("*/*.yaml") if not path.name.startswith("_"))


def case_id(path: Path) -> str:
    return f"{path.parent.name}/{path.stem}"


def read_options(case: Path) -> dict[str, str]:
    """Return the options in the comment lines that a case begins with."""
    options = {}
    # Cases about encodings are no UTF-8, so the head is read as bytes.
    for line in case.read_bytes().removeprefix(b"\xef\xbb\xbf").decode("latin-1").splitlines():
        if not line.startswith("#"):
            break
        name, _, value = line[1:].strip().partition(":")
        if name in OPTIONS:
            options[name] = value.strip()
    return options


class Result:
    """What one run of the command gave."""

    def __init__(self, status: int, xml: str, messages: str) -> None:
        self.status = status
        self.xml = xml
        self.messages = messages


@pytest.fixture
def compile_case(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Any:
    """Return a function that compiles a case as the command does, in the case's folder."""

    def compile_case(case: Path, options: dict[str, str]) -> Result:
        monkeypatch.chdir(case.parent)
        for setting in shlex.split(options.get("env", "")):
            name, _, value = setting.partition("=")
            monkeypatch.setenv(name, value)
        arguments = shlex.split(options.get("args", ""))
        if "strict" in options:
            arguments.append("--strict")
        capsys.readouterr()
        status = main([*options.get("command", "").split(), case.name, *arguments])
        captured = capsys.readouterr()
        return Result(status, _portable(captured.out), _portable(captured.err))

    return compile_case


def _portable(text: str) -> str:
    """Return a text without the place of these tests on this machine."""
    return text.replace(str(CASES), "CASES")


def read_expected(path: Path) -> str:
    return path.read_bytes().decode() if path.exists() else ""


def difference(expected: str, actual: str, name: str) -> str:
    lines = difflib.unified_diff(
        expected.splitlines(), actual.splitlines(), f"{name} expected", "actual", lineterm="", n=5
    )
    # What differs only in line ends shows nothing above.
    return "\n".join(lines) or f"{name}: expected {expected!r}\nactual {actual!r}"


def rewrite(case: Path, result: Result) -> list[str]:
    """Store what a case gives now; return the names of the files that changed."""
    changed = []
    for suffix, text in ((".xml", result.xml), (".err", result.messages)):
        path = case.with_suffix(suffix)
        if text == read_expected(path):
            continue
        changed.append(path.name)
        if text:
            path.write_bytes(text.encode())
        else:
            path.unlink()
    return changed


@pytest.mark.parametrize("case", find_cases(), ids=case_id)
def test_case_gives_exactly_what_is_expected(
    case: Path,
    compile_case: Any,
    request: pytest.FixtureRequest,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    options = read_options(case)
    if platform.python_version() not in SpecifierSet(options.get("python", "")):
        pytest.skip(f"is for Python {options['python']}")
    modules_before = set(sys.modules)
    result = compile_case(case, options)
    again = compile_case(case, options)

    if request.config.getoption("--update-cases"):
        changed = rewrite(case, result)
        assert not changed, f"rewritten, now read it: {', '.join(changed)}"
    xml = case.with_suffix(".xml")
    messages = case.with_suffix(".err")
    assert xml.exists() or messages.exists(), "nothing is expected: see tests/cases/README.md"
    expected_messages = read_expected(messages)
    assert result.messages == expected_messages, difference(
        expected_messages, result.messages, messages.name
    )
    expected_xml = read_expected(xml)
    assert result.xml == expected_xml, difference(expected_xml, result.xml, xml.name)
    assert result.status == (0 if xml.exists() else 1)
    assert (again.status, again.xml, again.messages) == (
        result.status,
        result.xml,
        result.messages,
    ), "a second run in the same process gives something else"
    with monkeypatch.context() as patch:
        patch.setattr(pipeline, "Interpreter", unsharing)
        plain = compile_case(case, options)
    assert (plain.status, plain.xml, plain.messages) == (
        result.status,
        result.xml,
        result.messages,
    ), "sharing elements between places changes something"
    left = {name for name in set(sys.modules) - modules_before if is_from_a_case(name)}
    assert not left, f"modules stay in sys.modules: {sorted(left)}"


UNSAFE = re.compile(
    r"^error\[(unsafe-code|limit-[a-z]+|path-outside)\]|^yamaro: error: '--", re.MULTILINE
)
"""What safe mode and the jail may say where trusted mode says something else."""


@pytest.mark.parametrize("case", find_cases(), ids=case_id)
def test_safe_mode_gives_the_same_or_refuses(
    case: Path, compile_case: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    options = read_options(case)
    if options.get("command") or "--" in options.get("args", ""):
        pytest.skip("has a mode of its own")
    if platform.python_version() not in SpecifierSet(options.get("python", "")):
        pytest.skip(f"is for Python {options['python']}")
    trusted = compile_case(case, options)
    monkeypatch.setattr(jail, "check_available", lambda: "what matters here is the language")
    options["args"] = f"--safe {options.get('args', '')}"
    safe = compile_case(case, options)
    if UNSAFE.search(safe.messages):
        assert safe.status == 1
        assert safe.xml == ""
        return
    assert (safe.status, safe.xml, safe.messages) == (
        trusted.status,
        trusted.xml,
        trusted.messages,
    )


@pytest.mark.skipif(jail.check_available() is not None, reason="there is no jail here")
@pytest.mark.parametrize("case", sample(find_cases()[::3], every=5), ids=case_id)
def test_what_comes_out_of_a_jail_is_the_same(case: Path, compile_case: Any) -> None:
    options = read_options(case)
    if options.get("command") or "--" in options.get("args", "") or "env" in options:
        pytest.skip("has a mode or an environment of its own")
    if platform.python_version() not in SpecifierSet(options.get("python", "")):
        pytest.skip(f"is for Python {options['python']}")
    expected = (
        0 if case.with_suffix(".xml").exists() else 1,
        read_expected(case.with_suffix(".xml")),
        read_expected(case.with_suffix(".err")),
    )
    options["args"] = f"--jail {options.get('args', '')}"
    jailed = compile_case(case, options)
    if jailed.messages.startswith("error[path-outside]"):
        assert jailed.xml == ""
        return
    assert (jailed.status, jailed.xml, jailed.messages) == expected


def is_from_a_case(module_name: str) -> bool:
    file = getattr(sys.modules[module_name], "__file__", None)
    return file is not None and CASES in Path(file).parents


@pytest.mark.parametrize("expected", sorted(CASES.glob("*/*.xml")), ids=case_id)
def test_expected_output_is_well_formed(expected: Path) -> None:
    if read_options(expected.with_suffix(".yaml")).get("command") == "why":
        assert " = " in expected.read_text(encoding="utf-8").partition("\n")[0]
        return
    assert etree.parse(expected).getroot() is not None


def test_every_expected_file_belongs_to_a_case() -> None:
    cases = {case.with_suffix("") for case in find_cases()}
    expected = [path for suffix in ("xml", "err") for path in CASES.glob(f"*/*.{suffix}")]
    assert [path for path in expected if path.with_suffix("") not in cases] == []


def test_options_are_read_from_the_head_only(tmp_path: Path) -> None:
    case = tmp_path / "case.yaml"
    case.write_text("# strict\n# args: a:=1 'b:=x y'\n# a note: kept out\nmodel:\n# python: <3\n")
    assert read_options(case) == {"strict": "", "args": "a:=1 'b:=x y'"}
