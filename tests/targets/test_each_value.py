"""Each value of a robot that says everything in words is in the output, or is reported as lost.

One value after the other is changed, or left out. Then the output has to change, or its losses, or
a loss is at that value, or all that is around it is lost.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml

import yamaro
from tests.consumers import oracles
from yamaro.result import Build
from yamaro.targets.losses import LOST, Loss

PATH = Path(__file__).with_name("full_robot.yaml")
TEXT = PATH.read_text(encoding="utf-8")
COMMANDS = ["position", "velocity", "effort"]
OTHERS = {
    **{axis: ["x", "y", "z"] for axis in "xyz"},
    **dict.fromkeys(COMMANDS, COMMANDS),
    "free": ["fixed"],
    "left_joint": ["slider_joint"],
}
"""What words are changed to; others get a letter more."""
FORMATS = ["urdf", "mjcf", "sdf", "usd"]
ALL_LOST = re.compile(
    r"(\w+ )?sensors|surfaces|actuators|states|groups|`collisions` sections|blocks of ros2_control|"
    r"mimic joints|calibrations|soft limits"
)
"""Losses of all that something says."""
COUNTS = {"rays", "rows", "size", "samples", "seed"}
"""Keys of whole numbers."""
STRUCTURE = {"type", "geometry", "parent", "chain", "keep"}
"""Keys that say what there is: with another value of one, others are wrong."""


class Value:
    """A value of the file.

    Attributes:
        path: the keys that lead to it.
        own: where it begins and ends.
        keys: where the keys that lead to it are, but for those of the whole part.
        is_entry: whether it is all that the last of these keys says.
    """

    def __init__(
        self, path: list[str], own: tuple[int, int], keys: list[int], *, is_entry: bool
    ) -> None:
        self.path = path
        self.own = own
        self.keys = keys
        self.is_entry = is_entry

    def __str__(self) -> str:
        return ".".join(self.path)


def values() -> Iterator[Value]:
    """Yield the values of the file, except those that say what there is."""
    root = yaml.compose(TEXT)
    assert root is not None
    pending: list[tuple[yaml.Node, list[str], list[int]]] = [(root, [], [])]
    while pending:
        node, path, keys = pending.pop()
        if isinstance(node, yaml.MappingNode):
            for key, value in node.value:
                inner, start = [*path, key.value], key.start_mark.index
                around = [] if (path and path[-1] == "part") or key.value == "model" else keys
                if key.value in STRUCTURE or inner[-2:] == ["part", "name"]:
                    continue
                pending.append((value, inner, [*around, start]))
                if "name=" in key.value and key.value != "frame/name=tip":
                    own = (start + key.value.index("name=") + 5, key.end_mark.index)
                    yield Value([*inner, "name"], own, [*around, start], is_entry=False)
        elif isinstance(node, yaml.SequenceNode):
            for index, value in enumerate(node.value):
                pending.append((value, [*path, str(index)], keys))
        elif node.value:
            own = (node.start_mark.index, node.end_mark.index)
            yield Value(path, own, keys, is_entry=not path[-1].isdigit())


def changes_of(value: Value) -> Iterator[list[str]]:
    """Yield the texts of the file with another word in place of one of the value's."""
    start, end = value.own
    words = TEXT[start:end].split(" ")
    for index, word in enumerate(words):
        others = list(_others(word, is_count=value.path[-1] in COUNTS))
        rows = [[*words[:index], other, *words[index + 1 :]] for other in others]
        texts = [TEXT[:start] + " ".join(row) + TEXT[end:] for row in rows]
        yield texts if word[0].isdigit() or word[0] == "-" else [*texts, _without(value)]


def _others(word: str, *, is_count: bool) -> Iterator[str]:
    number = word.rstrip("degmHz/s")
    try:
        changed = int(number) + 1 if is_count and number.isdigit() else float(number) * 0.9 + 0.013
        yield f"{changed:.6g}{word[len(number) :]}"
    except ValueError:
        yield from (each for each in OTHERS.get(word, [f"{word}x"]) if each != word)


def _without(value: Value) -> str:
    """Return the text of the file without a value."""
    start, end = value.own
    before, after = TEXT[: value.keys[-1] if value.is_entry else start], TEXT[end:]
    if after.startswith(", "):
        return before + after.removeprefix(", ")
    return before.removesuffix(", ") + after


@functools.cache
def built(text: str) -> dict[str, Build] | None:
    """Return the robot of a text in each format, or None if it is not one."""
    try:
        return yamaro.build(PATH, text=text, target=FORMATS, on_message=_ignore).outputs
    except yamaro.YamaroError:
        return None


def _ignore(line: str) -> None:
    pass


def shown(build: Build) -> object:
    """Return all that a build gives: the document, the files beside it, and the losses."""
    losses = {(each.kind, each.what, each.owner, each.how) for each in build.losses}
    return build.xml(), build.assets, losses


def is_told(value: Value, build: Build) -> bool:
    """Return whether there is a loss at a value, or all that is around it is lost."""
    inside, around = range(value.keys[-1], value.own[1] + 1), value.keys[:-1]
    return any(
        loss.span.start in inside
        or (loss.span.start in around and ALL_LOST.fullmatch(loss.what) and _is_whole(loss))
        for loss in build.losses
    )


def _is_whole(loss: Loss) -> bool:
    """Return whether nothing else is written; URDF has only the frames of sensors."""
    return loss.kind == LOST or loss.how == "their frames"


VALUES = sorted(values(), key=lambda value: value.own)


@pytest.mark.parametrize("value", VALUES, ids=str)
def test_each_value_is_in_the_output_or_reported(value: Value) -> None:
    oracles.require_module("pxr")
    whole = built(TEXT)
    assert whole is not None
    for texts in changes_of(value):
        robots = [builds for text in texts if (builds := built(text)) is not None]
        assert robots, "no change to it gives a robot"
        silent = [
            format
            for format, build in whole.items()
            if not is_told(value, build)
            and all(shown(robot[format]) == shown(build) for robot in robots)
        ]
        assert not silent
