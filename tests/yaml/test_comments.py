"""Comments and their places, against what PyYAML takes for a comment."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

from yamaro.source import Source
from yamaro.yaml.comments import find_comments

ROOT = Path(__file__).parents[2]
FILES = sorted(ROOT.glob("examples/*/*.yaml"))
MARK = "# a mark"


def comments(text: str) -> list[str]:
    return [comment.text for comment in find_comments(Source(text, name="t.yaml"), text)]


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("a: 1 # b\n", ["# b"]),
        ("# a\n# b # c\n\n  # d\na: 1", ["# a", "# b # c", "# d"]),
        ("a: '# no' # yes", ["# yes"]),
        ("a: b#no # yes", ["# yes"]),
        ("a: | # header\n  # text\n  b\n# behind\nc: >- # other\n  # text\n\n  # last\n",
         ["# header", "# behind", "# other"]),
        ("a: [1, # one\n  2 # two\n  ] # three", ["# one", "# two", "# three"]),
        ("a: &x # anchor\n  b: *x # alias\n", ["# anchor", "# alias"]),
        ("%YAML 1.1 # directive\n--- # start\na: 1\n... # end\n",
         ["# directive", "# start", "# end"]),
        ("a: 1 # b\r\nc: 2 # d\r# e\r\n", ["# b", "# d", "# e"]),
        ("a: 1 #", ["#"]),
        ("# only", ["# only"]),
        ("", []),
    ],
)  # fmt: skip
def test_comments_are_found(text: str, found: list[str]) -> None:
    assert comments(text) == found


def test_a_comment_knows_whether_its_line_is_its_own() -> None:
    text = "# a\nb: 1 # c\n  # d\n"
    found = find_comments(Source(text, name="t.yaml"), text)
    assert [comment.has_line for comment in found] == [True, False, True]
    assert [comment.location() for comment in found] == [(1, 1), (2, 6), (3, 3)]


@pytest.mark.parametrize("file", FILES, ids=lambda file: f"{file.parent.name}/{file.stem}")
def test_a_mark_at_the_end_of_a_line_is_found_where_it_is_a_comment(file: Path) -> None:
    text = file.read_text()
    lines = text.splitlines()
    before = shape(text)
    found = {comment.start for comment in find_comments(Source(text, name="t"), text)}
    assert len(found) >= sum(line.startswith("#") for line in lines)
    at = 0
    for number, line in enumerate(lines):
        marked = "\n".join([*lines[:number], f"{line} {MARK}", *lines[number + 1 :], ""])
        if "#" not in line and shape(marked) == before:
            own = {one.start for one in find_comments(Source(marked, name="t"), marked)}
            assert at + len(line) + 1 in own, line
        elif "#" not in line:
            own = {one.start for one in find_comments(Source(marked, name="t"), marked)}
            assert at + len(line) + 1 not in own, line
        at += len(line) + 1


def shape(text: str) -> object:
    """Return what PyYAML composes, or None where it refuses the text."""
    try:
        return plain(yaml.compose(text, Loader=yaml.CSafeLoader))
    except yaml.YAMLError:
        return None


def plain(node: object) -> object:
    if isinstance(node, yaml.MappingNode):
        return [(plain(key), plain(value)) for key, value in node.value]
    if isinstance(node, yaml.SequenceNode):
        return [plain(item) for item in node.value]
    assert isinstance(node, yaml.ScalarNode)
    return node.value
