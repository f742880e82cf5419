"""What holds for all texts: edits, completion at every prefix, diagnostics equal to `check`."""

from __future__ import annotations

import json
import random
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

import yamaro
from tests.effort import examples
from tests.tools.lsp.client import Client
from yamaro.policy import Policy
from yamaro.tools.lsp import FEATURE_MODULES
from yamaro.tools.lsp.positions import UTF_16, UTF_32, offset_at, position_at
from yamaro.tools.lsp.texts import Text
from yamaro.tools.lsp.wire import RequestFailed
from yamaro.tools.lsp.workspace import Workspace

ROOT = Path(__file__).parents[3]
EXAMPLES = sorted((ROOT / "examples").rglob("*.yaml"))
HOSTILE = sorted((ROOT / "tests" / "hostile").rglob("*.txt"))
PIECES = ["a", "🤖", "é", "\n", "\r\n", "  ", "- ", ": ", "$(", ")", "part:", "{", "}", "x y", "'"]


def _answer(workspace: Workspace, module: str, parameters: Any) -> Any:
    from importlib import import_module

    return import_module(f"yamaro.tools.lsp.{module}").answer(workspace, parameters)


def _parameters(workspace: Workspace, text: Text, offset: int) -> dict[str, Any]:
    position = position_at(text.source, offset, workspace.encoding)
    return {
        "textDocument": {"uri": text.path},
        "position": position,
        "range": {"start": {"line": 0, "character": 0}, "end": position},
        "context": {},
        "newName": "other",
    }


def _open(path: Path, text: str) -> tuple[Workspace, Text]:
    workspace = Workspace()
    opened = workspace.add(path.as_uri(), 1, text)
    return workspace, opened.text


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_completion_answers_at_prefixes_of_the_examples(path):
    """Every prefix of a random sample; all of them with --slow."""
    text = path.read_text(encoding="utf-8")
    count = len(text) if examples(10) > 10 else 25
    chosen = random.Random(path.stem).sample(range(len(text) + 1), min(count, len(text)))
    for offset in chosen:
        workspace, opened = _open(path, text[:offset])
        parameters = _parameters(workspace, opened, offset)
        parameters["textDocument"] = {"uri": path.as_uri()}
        assert isinstance(_answer(workspace, "completion", parameters)["items"], list)


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_every_feature_answers_anywhere_in_broken_examples(path):
    chooser = random.Random(path.stem)
    text = path.read_text(encoding="utf-8")
    for _ in range(4):
        start = chooser.randrange(len(text))
        broken = text[:start] + chooser.choice(PIECES) + text[start + chooser.randrange(9) :]
        workspace, opened = _open(path, broken)
        for module in FEATURE_MODULES:
            parameters = _parameters(workspace, opened, chooser.randrange(len(broken)))
            parameters["textDocument"] = {"uri": path.as_uri()}
            with suppress(RequestFailed):
                json.dumps(_answer(workspace, module, parameters))


def _edit(chooser: random.Random, text: str) -> tuple[int, int, str]:
    start = chooser.randrange(len(text) + 1)
    end = min(len(text), start + chooser.choice((0, 0, 0, 1, 2, 9, 40)))
    while text[start - 1 : start + 1] == "\r\n" and start:
        start -= 1
    while text[end - 1 : end + 1] == "\r\n":
        end += 1
    new = "".join(chooser.choices(PIECES, k=chooser.randrange(3)))
    return start, end, new


def _range_in(text: str, start: int, end: int) -> dict[str, Any]:
    """Return a range as an editor counts it: in UTF-16."""

    def position(offset: int) -> dict[str, int]:
        before = text[:offset].replace("\r\n", "\n").replace("\r", "\n")
        line = before.rpartition("\n")[2]
        return {"line": before.count("\n"), "character": len(line.encode("utf-16-le")) // 2}

    return {"start": position(start), "end": position(end)}


def test_the_document_equals_the_editors_after_any_edits():
    """10,000 edits with --slow, a fifth of them otherwise."""
    chooser = random.Random(11)
    path = ROOT / "examples" / "any.yaml"
    text = EXAMPLES[0].read_text(encoding="utf-8")
    workspace, _ = _open(path, text)
    for version in range(examples(10_000)):
        if len(text) < 1_000:
            text = EXAMPLES[0].read_text(encoding="utf-8")
            workspace.change(path.as_uri(), version, [{"text": text}])
        start, end, new = _edit(chooser, text)
        change = {"range": _range_in(text, start, end), "text": new}
        opened = workspace.change(path.as_uri(), version, [change])
        text = text[:start] + new + text[end:]
        assert opened.text.text == text.removeprefix("\ufeff")
        if len(text) > 20_000:
            text = text[:5_000]
            workspace.change(path.as_uri(), version, [{"text": text}])


@pytest.mark.parametrize("encoding", [UTF_16, UTF_32])
def test_positions_and_offsets_are_inverse(encoding):
    text = Text("/a.yaml", "a: 🤖é\r\nb: x\n🤖🤖: 'c'\r\r\n\n")
    breaks = {i for i, char in enumerate(text.text) if char == "\n" and text.text[i - 1] == "\r"}
    for offset in range(len(text.text) + 1):
        position = position_at(text.source, offset, encoding)
        if offset not in breaks:
            assert offset_at(text.source, position, encoding) == offset


def _told(diagnostics: list[Any]) -> list[tuple[str, str, int, int]]:
    return sorted((each.code, each.message, *each.span.location()) for each in diagnostics)


def _checked(path: Path, text: str) -> list[tuple[str, str, int, int]]:
    """Return what `yamaro check --safe` says of a text in place of a file."""
    try:
        build = yamaro.build(
            path, text=text, advice=True, policy=Policy("safe"), on_message=lambda _: None
        )
    except yamaro.YamaroError as error:
        return _told(error.diagnostics)
    return _told(build.warnings)


@pytest.mark.parametrize("seed", range(6))
def test_after_random_edits_the_diagnostics_are_those_of_check(tmp_path, seed):
    chooser = random.Random(seed)
    example = EXAMPLES[chooser.randrange(len(EXAMPLES))]
    text = example.read_text(encoding="utf-8")
    path = tmp_path / "robot.yaml"
    with Client(None, options={"timeout": 60_000, "pause": 20}) as client:
        uri = client.open(path, text)
        version = 1
        for _ in range(300):
            start, end, new = _edit(chooser, text)
            if chooser.random() < 0.4:  # an edit that is taken back
                wrong = text[:start] + new + text[end:]
                version += 1
                client.change(uri, version, [{"range": _range_in(text, start, end), "text": new}])
                version += 1
                inserted = _range_in(wrong, start, start + len(new))
                client.change(uri, version, [{"range": inserted, "text": text[start:end]}])
                continue
            if chooser.random() < 0.97:
                continue
            version += 1
            client.change(uri, version, [{"range": _range_in(text, start, end), "text": new}])
            text = text[:start] + new + text[end:]
        version += 1
        client.change(uri, version, [{"text": text}])
        wanted = [(code, line, column) for code, _, line, column in _checked(path, text)]
        wanted = sorted({each for each in wanted if each[0] != "unsafe-code"})

        def shown() -> list[tuple[str, int, int]]:
            found = set()
            for each in client.diagnostics.get(uri, []):
                start = each["range"]["start"]
                line = text.split("\n")[start["line"]] if text else ""
                units = line.encode("utf-16-le")[: 2 * start["character"]]
                column = len(units.decode("utf-16-le", "ignore")) + 1
                if each["severity"] != 3:
                    found.add((each["code"], start["line"] + 1, column))
            return sorted(found)

        if "\r" not in text:
            client.wait_for(lambda: client.versions.get(uri) == version and shown() == wanted)
        assert client.logs == []


@pytest.mark.parametrize("path", HOSTILE, ids=lambda path: path.name)
def test_every_feature_answers_for_hostile_files(path):
    data = path.read_bytes()
    if len(data) > 100_000:
        pytest.skip("is long")
    text = data.decode("utf-8", "replace")
    workspace, opened = _open(path, text)
    for module in FEATURE_MODULES:
        parameters = _parameters(workspace, opened, len(text) // 2)
        parameters["textDocument"] = {"uri": path.as_uri()}
        with suppress(RequestFailed):
            _answer(workspace, module, parameters)
