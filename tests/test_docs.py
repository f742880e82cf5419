"""Every fenced example of README.md and docs/ does what it says; CONTRIBUTING.md tells how."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.fenced import REPOSITORY, Compile, Document, matches, read_blocks
from yamaro.commands.main import main

GUIDE = REPOSITORY / "src" / "yamaro" / "tools" / "guide" / "guide.md"
DOCUMENTS = [REPOSITORY / "README.md", *sorted((REPOSITORY / "docs").rglob("*.md")), GUIDE]


@pytest.fixture
def compile_in_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Compile:
    monkeypatch.chdir(tmp_path)

    def compile_(arguments: list[str]) -> tuple[int, str, str]:
        capsys.readouterr()
        status = main(arguments)
        captured = capsys.readouterr()
        return status, captured.out, captured.err

    return compile_


@pytest.mark.parametrize(
    "path", DOCUMENTS, ids=lambda path: path.relative_to(REPOSITORY).as_posix()
)
def test_examples_do_what_they_say(path: Path, tmp_path: Path, compile_in_folder: Compile) -> None:
    document = Document(path, tmp_path, compile_in_folder)
    document.run()
    assert not document.failures, "\n\n".join(document.failures)


# --- the runner itself, on examples that are right and wrong -----------------------------------


@pytest.fixture
def failures_of(tmp_path: Path, compile_in_folder: Compile):
    def failures_of(markdown: str) -> list[str]:
        path = tmp_path / "document.md"
        path.write_text(markdown)
        document = Document(path, tmp_path, compile_in_folder)
        document.run()
        return document.failures

    return failures_of


RIGHT = {
    "a whole file": "```yaml\nlaunch:\n  a: 1\n```\n```xml\n<launch>\n  <a>1</a>\n</launch>\n```\n",
    "a fragment": "```yaml fragment\na: 1\n```\nwhich is\n```xml\n<a>1</a>\n```\n",
    "a fragment in list form": "```yaml fragment links=base\n- a: 1\n```\n```xml\n<a>1</a>\n```\n",
    "a fragment with a part": "```yaml fragment links=base\npart:\n  name: tip\n"
    '  joint: {type: fixed, parent: base}\n```\n```xml\n…\n<link name="tip_link"/>\n```\n',
    "an argument": "```yaml fragment n:=3\na: $(n)\n```\n```xml\n<a>3</a>\n```\n",
    "a continued fragment": "```yaml fragment\nvariables: {n: 2}\n```\n"
    "```yaml fragment continued\na: $(n)\n```\n```xml\n<a>2</a>\n```\n",
    "an error": "```yaml error\nlaunch:\n  a: $(oops)\n```\n```text\n…\n2 |   a: $(oops)\n…\n```\n",
    "a print": "```yaml\nlaunch:\n  print: hello\n```\n```text\nhello\n```\n",
    "an included file": "```yaml file=part.yaml included\nmodel:\n  a: $(n)\n```\n"
    "```yaml fragment\ninclude: {path: part.yaml, n: 4}\n```\n```xml\n<a>4</a>\n```\n",
    "a whole file so far": "```yaml\na:\n- b: 1\n```\n```yaml continued\n- c: 2\n```\n"
    "```yaml whole\na:\n- b: 1\n- c: 2\n```\n",
    "python": "```python\nprint(1 + 1)\n```\n```text\n2\n```\n",
    "a session": "```yaml\nlaunch:\n  a: 1\n```\n```console\n$ yamaro robot.yaml\n…\n  <a>1</a>\n"
    "…\n$ echo a\na\n$ ros2 run\n```\n",
    "a script": "```sh\npip install yamaro\nyamaro --version\n```\n",
    "no example": "```xml not-run\n<a/>\n```\n```toml\nx = 1\n```\n",
}

WRONG = {
    "other XML": RIGHT["a whole file"].replace("<a>1", "<a>2"),
    "other content": RIGHT["a fragment"].replace("<a>1", "<a>2"),
    "an error unannounced": "```yaml\nlaunch:\n  a: $(oops)\n```\n",
    "an error that is none": "```yaml error\nlaunch:\n  a: 1\n```\n```text\n…\n```\n",
    "an error not shown": "```yaml error\nlaunch:\n  a: $(oops)\n```\n",
    "a print not shown": "```yaml\nlaunch:\n  print: hello\n```\n",
    "other output": RIGHT["python"].replace("\n2\n", "\n3\n"),
    "a whole file that is another": "```yaml\na: {b: 1}\n```\n```yaml whole\na: {b: 2}\n```\n",
    "a failing program": "```python\nraise SystemExit(3)\n```\n",
    "another session": RIGHT["a session"].replace("\na\n", "\nb\n"),
    "a failing script": "```sh\nyamaro missing.yaml\n```\n",
    "an unknown word": "```yaml fragmnet\na: 1\n```\n",
    "XML from nowhere": "```xml\n<a/>\n```\n",
}


@pytest.mark.parametrize("markdown", RIGHT.values(), ids=RIGHT)
def test_a_right_example_passes(markdown: str, failures_of) -> None:
    assert failures_of(markdown) == []


@pytest.mark.parametrize("markdown", WRONG.values(), ids=WRONG)
def test_a_wrong_example_is_found(markdown: str, failures_of) -> None:
    found = failures_of(markdown)
    assert len(found) == 1
    assert found[0].startswith("document.md:")


def test_blocks_are_read_with_their_lines_also_in_lists() -> None:
    blocks = read_blocks(
        "# x\n\n- item\n  ```yaml fragment file=a.yaml n:=1\n  a:\n    b: 1\n  ```\n"
    )
    assert [(b.line, b.language, b.text) for b in blocks] == [(4, "yaml", "a:\n  b: 1\n")]
    assert (blocks[0].words, blocks[0].settings, blocks[0].arguments) == (
        {"fragment"},
        {"file": "a.yaml"},
        ["n:=1"],
    )


@pytest.mark.parametrize(
    ("expected", "actual", "verdict"),
    [
        ("a\nb\n", "a\nb\n", True),
        ("a\n…\nd\n", "a\nb\nc\nd\n", True),
        ("a\n  <!-- … -->\nb\n", "a\nb\n", True),
        ("…\nc\n…\n", "a\nc\n", True),
        ("a\n…\nd\n", "a\nb\n", False),
        ("…\nx\n…\n", "a\nc\n", False),
        ("b\n…\n", "a\nb\n", False),
        ("a\n…\na\n", "a\n", False),
        ("a\n", "a\nb\n", False),
    ],
)
def test_an_elision_stands_for_any_lines(expected: str, actual: str, verdict: bool) -> None:
    assert matches(expected, actual) is verdict
