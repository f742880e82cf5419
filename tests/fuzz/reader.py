"""Target: text → YAML nodes. PyYAML's own composer, on the same scanner, is the second opinion.

Any text is read or refused with a diagnostic. What is read has places inside the text, in order,
and is what PyYAML composes. What is refused as no YAML, PyYAML refuses too.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import yaml

from yamaro.diagnostics import Reporter, YamaroError
from yamaro.source import Source
from yamaro.syntax.parser import parse
from yamaro.yaml.nodes import MappingNode, ScalarNode, SequenceNode, quoted
from yamaro.yaml.reader import read, read_fragment

from .checks import require_readable, require_sound

MODULES = (
    "yaml/reader.py",
    "yaml/recovery.py",
    "yaml/comments.py",
    "yaml/nodes.py",
    "yaml/explanations.py",
)
LOADER: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
WHITE = " \t\r\n\x85\u2028\u2029"
BREAK = re.compile("\r\n|[\r\n\x85\u2028\u2029]")


def check(text: str) -> str:
    """Read a text; return what came of it."""
    require_parsed(text)
    reporter = Reporter()
    try:
        root: Any = read(Source(text, name="t.yaml"), reporter=reporter)
    except YamaroError as error:
        code = require_readable(error)
        if code.startswith("yaml-") and code != "yaml-tag":
            assert not isinstance(composed(text), yaml.Node), f"PyYAML reads it, we say {code}"
        return code
    require_sound(reporter.diagnostics)
    require_places(root, text)
    require_scalars(root)
    if "<<" not in text:
        require_order(root)
        other = composed(text)
        if "duplicate anchor" not in str(other):  # legal, since YAML 1.1 already
            assert isinstance(other, yaml.Node), f"PyYAML refuses it: {other}"
            require_same(root, other)
    return "read"


def require_parsed(text: str) -> None:
    """Require that a parse does not raise, and that all it finds has its place in the text."""
    parsed = parse(Source(text, name="t.yaml"))
    for span in (*parsed.hidden, *(found.span for found in parsed.diagnostics)):
        assert 0 <= span.start <= span.end <= len(text) + 1
    assert all(text[comment.start] == "#" for comment in parsed.comments)


def composed(text: str) -> Any:
    """Return the nodes that PyYAML composes, or why it refuses the text."""
    try:
        return yaml.compose(text, Loader=LOADER)
    except (yaml.YAMLError, ValueError) as error:
        return error


def walk(root: Any) -> Iterator[Any]:
    """Give every node once, in order of the document: what an alias repeats was given before."""
    seen: set[int] = set()
    pending = [root]
    while pending:
        node = pending.pop()
        if id(node) in seen:
            continue
        seen.add(id(node))
        yield node
        if isinstance(node, SequenceNode):
            pending.extend(reversed(node.items))
        elif isinstance(node, MappingNode):
            pending.extend(part for pair in reversed(node.pairs) for part in reversed(pair))


def require_places(root: Any, text: str) -> None:
    for node in walk(root):
        assert node.source.text is text
        assert 0 <= node.start <= node.end <= len(text)
        line, column = node.span().location()
        assert text.count("\n", 0, node.start) + 1 <= line
        assert column >= 1


def require_order(root: Any) -> None:
    """Require that nodes begin one after the other, and collections end behind what is in them."""
    start = 0
    for node in walk(root):
        assert node.start >= start
        start = node.start
        for child in children(node):
            assert child.end <= node.end or child.start < node.start  # an alias


def children(node: Any) -> list[Any]:
    if isinstance(node, SequenceNode):
        return node.items
    if isinstance(node, MappingNode):
        return [part for pair in node.pairs for part in pair]
    return []


def require_scalars(root: Any) -> None:
    for number, node in enumerate(walk(root)):
        if not isinstance(node, ScalarNode):
            continue
        require_characters(node)
        if node.anchor is not None:
            assert node.anchor_span().written() == f"&{node.anchor}"
            assert node.anchor_span().end <= node.start
        if number < 40:
            require_read_again(node)
            require_fragment(node)


def require_characters(node: ScalarNode) -> None:
    """Require that each character of a scalar's text is found where it is spelled."""
    written = node.source.text
    last = node.start
    for index, char in enumerate(node.text[:500]):
        at = node.offset(index)
        assert last <= at <= node.end
        last = at
        if char not in WHITE and not (node.style == '"' and written[at] == "\\"):
            assert written[at] == char
        span = node.span(index, index + 1)
        assert node.start <= span.start <= span.end <= max(node.end, span.start)


def require_read_again(node: ScalarNode) -> None:
    """Require that a scalar's spelling, and its text in quotes, read as that text."""
    spelled = node.written()
    if node.style in ("'", '"'):
        assert len(spelled) >= 2
        assert spelled[0] == spelled[-1] == node.style
        again = read_one(f"- {BREAK.sub(lambda found: found[0] + ' ', spelled)}")
        assert again.text == node.text
    elif node.style == "" and not BREAK.search(spelled):
        assert spelled == spelled.strip(WHITE)
        assert spelled == node.text
    if node.text.isprintable() and node.text:
        assert read_one(f"- {quoted(node.text)}").text == node.text


def read_one(text: str) -> ScalarNode:
    root: Any = read(Source(text, name="again.yaml"), reporter=Reporter())
    node = root.items[0]
    assert isinstance(node, ScalarNode)
    return node


def require_fragment(node: ScalarNode) -> None:
    """Require that a scalar's text, read as YAML of its own, has its places inside the scalar.

    What is read so begins with a quote or a bracket.
    """
    if not node.text.startswith(("'", '"', "[", "{")):
        return
    try:
        root = read_fragment(node, 0, len(node.text))
    except YamaroError as error:
        require_readable(error)
        return
    for part in walk(root):
        if part.source is node.source:
            assert node.start <= part.start <= part.end <= max(node.end, part.start)


def require_same(root: Any, other: Any) -> None:
    """Require what PyYAML composes: the same nodes, texts, styles and, without anchors, places."""
    pending = [(root, other)]
    seen: set[tuple[int, int]] = set()
    while pending:
        node, twin = pending.pop()
        if (id(node), id(twin)) in seen:
            continue
        seen.add((id(node), id(twin)))
        if isinstance(node, ScalarNode):
            assert isinstance(twin, yaml.ScalarNode)
            assert node.text == twin.value
            assert node.style == (twin.style or "")
            if node.anchor is None:
                assert (node.start, node.end) == (twin.start_mark.index, twin.end_mark.index)
        elif isinstance(node, SequenceNode):
            assert isinstance(twin, yaml.SequenceNode)
            assert node.is_flow == bool(twin.flow_style)
            pending.extend(zip(node.items, twin.value, strict=True))
        else:
            assert isinstance(twin, yaml.MappingNode)
            assert node.is_flow == bool(twin.flow_style)
            for pair, other_pair in zip(node.pairs, twin.value, strict=True):
                pending.extend(zip(pair, other_pair, strict=True))
