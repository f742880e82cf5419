"""What holds for all texts: edits, positions, completion at every prefix."""

from __future__ import annotations

import json
import random
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from tests.effort import examples
from tests.tools.lsp.editing import PIECES, random_edit
from yamaro.tools.lsp import FEATURES, feature
from yamaro.tools.lsp.protocol import UTF_16, UTF_32, RequestFailed, offset_at, position_at
from yamaro.tools.lsp.workspace import Text, Workspace

ROOT = Path(__file__).parents[3]
EXAMPLES = sorted((ROOT / "examples").rglob("*.yaml"))
HOSTILE = sorted((ROOT / "tests" / "hostile").rglob("*.txt"))


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
    """Of each example, prefixes that are drawn at random."""
    text = path.read_text(encoding="utf-8")
    count = examples(125)
    chosen = random.Random(path.stem).sample(range(len(text) + 1), min(count, len(text)))
    for offset in chosen:
        workspace, opened = _open(path, text[:offset])
        parameters = _parameters(workspace, opened, offset)
        parameters["textDocument"] = {"uri": path.as_uri()}
        assert isinstance(feature("textDocument/completion")(workspace, parameters)["items"], list)


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_every_feature_answers_anywhere_in_broken_examples(path):
    chooser = random.Random(path.stem)
    text = path.read_text(encoding="utf-8")
    for _ in range(4):
        start = chooser.randrange(len(text))
        broken = text[:start] + chooser.choice(PIECES) + text[start + chooser.randrange(9) :]
        workspace, opened = _open(path, broken)
        for method in FEATURES:
            parameters = _parameters(workspace, opened, chooser.randrange(len(broken)))
            parameters["textDocument"] = {"uri": path.as_uri()}
            with suppress(RequestFailed):
                json.dumps(feature(method)(workspace, parameters))


def test_the_document_equals_the_editors_after_any_edits():
    """10,000 edits in the whole run."""
    chooser = random.Random(11)
    path = ROOT / "examples" / "any.yaml"
    text = EXAMPLES[0].read_text(encoding="utf-8")
    workspace, _ = _open(path, text)
    for version in range(examples(10_000)):
        if len(text) < 1_000:
            text = EXAMPLES[0].read_text(encoding="utf-8")
            workspace.change(path.as_uri(), version, [{"text": text}])
        edit = random_edit(chooser, text)
        opened = workspace.change(path.as_uri(), version, [edit.change(text)])
        text = edit.applied(text)
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


@pytest.mark.parametrize("path", HOSTILE, ids=lambda path: path.name)
def test_every_feature_answers_for_hostile_files(path):
    data = path.read_bytes()
    if len(data) > 100_000:
        pytest.skip("is long")
    text = data.decode("utf-8", "replace")
    workspace, opened = _open(path, text)
    for method in FEATURES:
        parameters = _parameters(workspace, opened, len(text) // 2)
        parameters["textDocument"] = {"uri": path.as_uri()}
        with suppress(RequestFailed):
            feature(method)(workspace, parameters)
