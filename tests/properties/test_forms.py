"""Repeated keys and lists of entries mean the same: every case and example, in either form.

The YAML nodes are rewritten after they were read, so that all places stay the same, and with them
every message.
"""

from __future__ import annotations

import shlex
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.effort import is_tried
from tests.example_files import PROGRAMS
from tests.golden import case_id, find_cases, read_options
from yamaro.commands.main import main
from yamaro.syntax import parser
from yamaro.syntax.names import is_function_name
from yamaro.yaml.nodes import MappingNode, ScalarNode, SequenceNode, YamlNode
from yamaro.yaml.reader import Reading

Rebuild = Callable[[YamlNode, "list[tuple[ScalarNode, YamlNode]]"], YamlNode]


def as_list(node: YamlNode, pairs: list[tuple[ScalarNode, YamlNode]]) -> YamlNode:
    """Return pairs as a list of entries."""
    sequence = SequenceNode(node.source, node.start, node.end, node_is_flow(node))
    for pair in pairs:
        entry = MappingNode(node.source, pair[0].start, pair[1].end, node_is_flow(node))
        entry.pairs = [pair]
        sequence.items.append(entry)
    return sequence


def as_mapping(node: YamlNode, pairs: list[tuple[ScalarNode, YamlNode]]) -> YamlNode:
    """Return pairs as one mapping with repeated keys."""
    mapping = MappingNode(node.source, node.start, node.end, node_is_flow(node))
    mapping.pairs = pairs
    return mapping


def node_is_flow(node: YamlNode) -> bool:
    return isinstance(node, (MappingNode, SequenceNode)) and node.is_flow


# What holds data: a list in it is a list.
DATA = ("arguments", "loop", "control", "states", "groups", "collisions", "naming", "base")


class Rewriter:
    """Walks the mappings of the language, by the shape that the manual gives to each statement."""

    def __init__(self, rebuild: Rebuild) -> None:
        self.rebuild = rebuild

    def entries(
        self, node: YamlNode, inner: Callable[[str, YamlNode], YamlNode] | None = None
    ) -> YamlNode:
        """Rewrite a mapping or a list of mappings; `inner` rewrites what stands behind a key."""
        if isinstance(node, MappingNode):
            pairs = node.pairs
        elif isinstance(node, SequenceNode) and node.items:
            if not all(isinstance(item, MappingNode) for item in node.items):
                return node
            pairs = [pair for item in node.items for pair in item]  # type: ignore[union-attr]
        else:
            return node
        if inner is not None:
            pairs = [(key, inner(key.text, value)) for key, value in pairs]
        return self.rebuild(node, pairs)

    def body(self, node: YamlNode) -> YamlNode:
        return self.entries(node, self.statement)

    def statement(self, key: str, node: YamlNode) -> YamlNode:
        if key in DATA:
            return node
        if key in ("attach", "mirror"):
            return self.entries(node, lambda own, v: self.body(v) if own == "body" else v)
        if key in ("variables", "include"):
            return self.entries(node)
        if key in ("if", "elif", "for"):
            return self.entries(node, lambda own, v: self.body(v) if own == "body" else v)
        if key == "functions":
            return self.entries(node, self.function)
        if key in ("print", "process", "import", "robot"):
            return node if key != "robot" else self.body(node)
        if is_function_name(key):
            return self.entries(node, lambda own, v: self.body(v) if own[:1].isupper() else v)
        if key.startswith("$") and "/" not in key:
            return self.entries(node)
        return self.body(node)

    def function(self, key: str, node: YamlNode) -> YamlNode:
        return self.body(node) if "(" in key else self.statement("for", node)


def compile_with(
    arguments: list[str], rebuild: Rebuild | None, monkeypatch: pytest.MonkeyPatch
) -> int:
    with monkeypatch.context() as patch:
        if rebuild is not None:
            read_on = parser.read_on  # type: ignore[attr-defined]
            rewriter = Rewriter(rebuild)

            def read_rewritten(*args: Any, **kwargs: Any) -> Reading:
                reading: Reading = read_on(*args, **kwargs)
                reading.root = reading.root and rewriter.body(reading.root)
                return reading

            patch.setattr(parser, "read_on", read_rewritten)
        return main(arguments)


def requires_same(
    path: Path,
    arguments: list[str],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> list[str]:
    """Return what differs between a file as written and in the two forms."""
    monkeypatch.chdir(path.parent)
    results = []
    for rebuild in (None, as_list, as_mapping):
        status = compile_with([path.name, *arguments], rebuild, monkeypatch)
        captured = capsys.readouterr()
        results.append((status, captured.out, captured.err))
    names = ("list form", "repeated keys")
    return [
        f"{path} in {name}:\n{result}\nas written:\n{results[0]}"
        for name, result in zip(names, results[1:], strict=True)
        if result != results[0]
    ]


# One is about how lists are indented, in the other a block's name stands for a value.
ABOUT_THE_FORM = {"list-item-not-indented", "capital-argument-that-is-a-mapping"}


SLOW_AREAS = ("expressions", "functions", "limits", "safe")


def areas() -> list[Any]:
    return [
        pytest.param(area, marks=[pytest.mark.slow] * (area in SLOW_AREAS))
        for area in sorted({case.parent.name for case in find_cases()})
    ]


@pytest.mark.parametrize("area", areas())
def test_cases_give_the_same_in_both_forms(
    area: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    different = []
    for case in find_cases():
        options = read_options(case)
        if case.parent.name != area or case.stem in ABOUT_THE_FORM or "command" in options:
            continue
        if not is_tried(case_id(case), quick=6, usual=3):
            continue
        with monkeypatch.context() as patch:
            for setting in shlex.split(options.get("env", "")):
                name, _, value = setting.partition("=")
                patch.setenv(name, value)
            arguments = shlex.split(options.get("args", ""))
            arguments += ["--strict"] if "strict" in options else []
            different += requires_same(case, arguments, patch, capsys)
    assert not different, "\n\n".join(different)


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.stem)
def test_examples_give_the_same_in_both_forms(
    path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    different = requires_same(path, [], monkeypatch, capsys)
    assert not different, "\n\n".join(different)


def test_the_forms_are_really_rewritten() -> None:
    from yamaro.diagnostics import Reporter
    from yamaro.source import Source
    from yamaro.yaml.reader import read

    text = "model:\n  a: {b: 1, b: 2}\n  variables: {x: {k: v}}\n"
    node = read(Source(text, name="t"), reporter=Reporter())
    listed = Rewriter(as_list).body(node)
    assert shape(listed) == [{"model": [{"a": [{"b": "1"}, {"b": "2"}]}, VARIABLES_AS_LIST]}]
    assert shape(Rewriter(as_mapping).body(listed)) == shape(node)


VARIABLES_AS_LIST = {"variables": [{"x": {"k": "v"}}]}


def shape(node: YamlNode) -> Any:
    if isinstance(node, ScalarNode):
        return node.text
    if isinstance(node, SequenceNode):
        return [shape(item) for item in node.items]
    return {key.text: shape(value) for key, value in node}
