"""Compiles each golden case and compares all it writes, to the character.

tests/cases/README.md says how a case is written.
"""

from __future__ import annotations

import difflib
import platform
import re
import shlex
import sys
from pathlib import Path
from typing import Any, NamedTuple

import pytest
import yaml
from lxml import etree
from packaging.specifiers import SpecifierSet

from tests import golden
from tests.effort import is_tried, tried
from tests.golden import (
    CASES,
    case_id,
    find_cases,
    read_expected,
    read_options,
    read_page,
    store,
    write_page,
)
from tests.unshared import unsharing
from yamaro import pipeline
from yamaro.commands.command_table import command_named
from yamaro.commands.main import main
from yamaro.sandbox import jail


class Result(NamedTuple):
    """What one run of the command gave."""

    status: int
    xml: str
    messages: str


def expected_of(case: Path) -> Result:
    xml, messages = case.with_suffix(".xml"), case.with_suffix(".err")
    return Result(0 if xml.exists() else 1, read_expected(xml), read_expected(messages))


@pytest.fixture
def compile_case(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Any:
    """Return a function that compiles a case as the command does, in the case's folder."""

    def compile_case(case: Path, options: dict[str, str]) -> Result:
        monkeypatch.chdir(case.parent)
        for setting in shlex.split(options.get("env", "")):
            name, _, value = setting.partition("=")
            monkeypatch.setenv(name, value)
        command = options.get("command", "").split()
        if command and command_named(command[0]) is None:
            pytest.skip(f"without {command[0]}")
        arguments = shlex.split(options.get("args", ""))
        if "strict" in options:
            arguments.append("--strict")
        capsys.readouterr()
        status = main([*command, case.name, *arguments])
        captured = capsys.readouterr()
        return Result(status, _portable(captured.out), _portable(captured.err))

    return compile_case


def _portable(text: str) -> str:
    """Return a text without the place of these tests on this machine."""
    return text.replace(str(CASES), "CASES")


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
        if text != read_expected(path):
            changed.append(path.name)
            store(case, suffix, text)
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
    if is_tried(case_id(case), quick=8, usual=3):
        again = compile_case(case, options)
        assert again == result, "a second run in the same process gives something else"
        with monkeypatch.context() as patch:
            patch.setattr(pipeline, "Interpreter", unsharing)
            plain = compile_case(case, options)
        assert plain == result, "sharing elements between places changes something"
    left = {name for name in set(sys.modules) - modules_before if is_from_a_case(name)}
    assert not left, f"modules stay in sys.modules: {sorted(left)}"


UNSAFE = re.compile(
    r"^error\[(unsafe-code|limit-[a-z]+|path-outside)\]|^yamaro: error: '--", re.MULTILINE
)
"""What safe mode and the jail may say where trusted mode says something else."""


@pytest.mark.parametrize("case", tried(find_cases(), case_id, quick=6, usual=2), ids=case_id)
def test_safe_mode_gives_the_same_or_refuses(
    case: Path, compile_case: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    options = read_options(case)
    if options.get("command") or "--" in options.get("args", ""):
        pytest.skip("has a mode of its own")
    if platform.python_version() not in SpecifierSet(options.get("python", "")):
        pytest.skip(f"is for Python {options['python']}")
    monkeypatch.setattr(jail, "check_available", lambda: "what matters here is the language")
    options["args"] = f"--safe {options.get('args', '')}"
    safe = compile_case(case, options)
    if UNSAFE.search(safe.messages):
        assert safe.status == 1
        assert safe.xml == ""
        return
    assert safe == expected_of(case)


@pytest.mark.skipif(jail.check_available() is not None, reason="there is no jail here")
@pytest.mark.parametrize("case", tried(find_cases(), case_id, quick=40, usual=8), ids=case_id)
def test_what_comes_out_of_a_jail_is_the_same(case: Path, compile_case: Any) -> None:
    options = read_options(case)
    if options.get("command") or "--" in options.get("args", "") or "env" in options:
        pytest.skip("has a mode or an environment of its own")
    if platform.python_version() not in SpecifierSet(options.get("python", "")):
        pytest.skip(f"is for Python {options['python']}")
    options["args"] = f"--jail {options.get('args', '')}"
    jailed = compile_case(case, options)
    if jailed.messages.startswith("error[path-outside]"):
        assert jailed.xml == ""
        return
    assert jailed == expected_of(case)


def is_from_a_case(module_name: str) -> bool:
    file = getattr(sys.modules[module_name], "__file__", None)
    return file is not None and CASES in Path(file).parents


def test_expected_output_is_well_formed() -> None:
    for expected in sorted(CASES.glob("*/[!_]*.xml")):
        options = read_options(expected.with_suffix(".yaml"))
        if options.get("command") == "why":
            assert re.search("^ (-->| *=) ", expected.read_text(encoding="utf-8"), re.MULTILINE)
        elif options.get("command") == "check":  # which found nothing
            assert expected.read_text(encoding="utf-8") == f"{expected.stem}.yaml: ok\n"
        elif "--to controllers" in options.get("args", ""):
            assert "controller_manager" in yaml.safe_load(expected.read_text(encoding="utf-8"))
        elif "--to curobo" in options.get("args", ""):
            assert "robot_cfg" in yaml.safe_load(expected.read_text(encoding="utf-8"))
        else:
            assert etree.parse(expected).getroot() is not None


def test_every_expected_file_belongs_to_a_case() -> None:
    cases = {case.with_suffix("") for case in find_cases()}
    expected = [path for suffix in ("xml", "err") for path in CASES.glob(f"*/[!_]*.{suffix}")]
    assert [path for path in expected if path.with_suffix("") not in cases] == []


def test_options_are_read_from_the_head_only(tmp_path: Path) -> None:
    case = tmp_path / "case.yaml"
    case.write_text("# strict\n# args: a:=1 'b:=x y'\n# a note: kept out\nmodel:\n# python: <3\n")
    assert read_options(case) == {"strict": "", "args": "a:=1 'b:=x y'"}


PAGE = b"""\
### one
# strict
model:
=== xml
<robot name="one"/>
=== err
warning
### two
# has no output yet
"""


def test_a_page_holds_cases_and_what_is_expected_of_them() -> None:
    page = read_page(PAGE)
    assert page["one"] == {
        ".yaml": b"# strict\nmodel:\n",
        ".xml": b'<robot name="one"/>\n',
        ".err": b"warning\n",
    }
    assert page["two"] == {".yaml": b"# has no output yet\n"}
    assert write_page(page) == PAGE


def test_a_case_is_on_one_page_only_once() -> None:
    with pytest.raises(AssertionError, match="one is there twice"):
        read_page(PAGE + PAGE)


def test_what_a_case_gives_is_kept_where_its_input_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(golden, "STORED", tmp_path / "cases")
    (tmp_path / "cases" / "area").mkdir(parents=True)
    (tmp_path / "cases" / "area" / "page.txt").write_bytes(PAGE)
    (tmp_path / "cases" / "area" / "file.yaml").write_bytes(b"model:\n")
    folder = golden.unpack(tmp_path / "unpacked") / "area"
    assert {path.name for path in folder.iterdir()} == {
        *("file.yaml", "one.yaml", "one.xml", "one.err", "two.yaml")
    }
    store(folder / "one.yaml", ".xml", "<new/>\n")
    store(folder / "one.yaml", ".err", "")
    store(folder / "file.yaml", ".err", "error\n")
    kept = (tmp_path / "cases" / "area" / "page.txt").read_bytes()
    assert kept == PAGE.replace(b'<robot name="one"/>', b"<new/>").replace(
        b"=== err\nwarning\n", b""
    )
    before = {path: path.read_bytes() for path in folder.iterdir()}
    golden.unpack(tmp_path / "unpacked")
    assert {path: path.read_bytes() for path in folder.iterdir()} == before
