"""What leaves a jail: an outcome comes through as bytes unchanged, and lies are found out."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.effort import examples
from yamaro.compiler import build
from yamaro.diagnostics import Diagnostic, Frame, YamaroError, render
from yamaro.jail import JailAnswerBroken, pack, unpack
from yamaro.source import Source, Span
from yamaro.transfer import Outcome, from_bytes, to_bytes
from yamaro.xmltree import Comment, Element, Text, write

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").rglob("*.yaml"))
texts = st.text(max_size=12)


def outcome_of(path: Path) -> Outcome:
    try:
        made = build(str(path), on_message=lambda line: None)
    except YamaroError as error:
        return Outcome(messages=["a", ""], diagnostics=error.diagnostics)
    return Outcome(
        messages=["one", "two"],
        diagnostics=made.warnings,
        pieces=[made.xml()],
        files=made.files,
        meshes=made.meshes,
        root=made.root,
    )


def places(element: Element) -> list[Any]:
    """Return all that an element and what is in it tell about themselves."""
    found: list[Any] = [element.name, element.span.key(), element.verbatim, trace(element.trace)]
    found += [(name, element.value_span(name).key()) for name in element.attributes]
    return found + [
        places(child) if isinstance(child, Element) else child.span.key()
        for child in element.children
    ]


def trace(frame: Frame | None) -> list[Any]:
    if frame is None:
        return []
    return [frame.kind, frame.name, frame.span.key(), trace(frame.parent), trace(frame.home)]


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_all_of_an_outcome_comes_through(path: Path) -> None:
    sent = outcome_of(path)
    got = from_bytes(to_bytes(sent))
    assert (got.messages, got.files, got.meshes) == (sent.messages, sent.files, sent.meshes)
    assert "".join(got.pieces) == "".join(sent.pieces)
    assert [render(each) for each in got.diagnostics] == [render(each) for each in sent.diagnostics]
    assert (got.root is None) == (sent.root is None)
    if got.root is not None and sent.root is not None:
        assert write(got.root) == write(sent.root)
        assert places(got.root) == places(sent.root)


@st.composite
def diagnostics(draw: st.DrawFn) -> Diagnostic:
    source = Source(draw(st.text(min_size=1, max_size=30)), name=draw(texts), path=draw(texts))
    start = draw(st.integers(0, len(source.text)))
    span = Span(source, start, draw(st.integers(start, len(source.text))))
    frame = None
    for name in draw(st.lists(texts, max_size=4)):
        frame = Frame("called", name, span, parent=frame, home=draw(st.sampled_from([None, frame])))
    return Diagnostic(
        draw(texts),
        draw(texts),
        span,
        hint=draw(st.none() | texts),
        notes=draw(st.lists(texts, max_size=2)),
        severity=draw(st.sampled_from(["error", "warning"])),
        trace=frame,
    )


@given(st.lists(diagnostics(), max_size=4), st.lists(texts, max_size=3))
def test_any_diagnostics_come_through(sent: list[Diagnostic], messages: list[str]) -> None:
    got = from_bytes(to_bytes(Outcome(messages=messages, diagnostics=sent)))
    assert got.messages == messages
    assert len(got.diagnostics) == len(sent)
    for one, other in zip(got.diagnostics, sent, strict=True):
        for name in ("code", "message", "hint", "notes", "severity"):
            assert getattr(one, name) == getattr(other, name)
        assert one.span.key() == other.span.key()
        assert trace(one.trace) == trace(other.trace)


def valid_answer() -> bytes:
    source = Source("variables: {a: 1}\nout: 1\n", name="robot.yaml", path="/robot.yaml")
    root = Element("out", Span(source, 0, 3), attributes={"a": 1.5, "b": None})
    frame = Frame("called", "F", Span(source, 2, 4), parent=None)
    inner = Element("in", Span(source, 1, 3), children=[Text("x", Span(source, 0, 1))], trace=frame)
    root.children = [inner, Comment("c", Span(source, 4, 5))]
    diagnostic = Diagnostic("code", "m", Span(source, 3, 9), severity="warning", trace=frame)
    return to_bytes(Outcome(messages=["m"], diagnostics=[diagnostic], pieces=["<out/>"], root=root))


ANSWER = valid_answer()


@settings(max_examples=examples(1500))
@given(
    st.lists(
        st.tuples(st.integers(0, len(ANSWER) - 1), st.integers(0, 255)), min_size=1, max_size=6
    ),
    st.integers(0, len(ANSWER)),
    st.binary(max_size=20),
)
def test_a_forged_answer_is_read_or_refused(
    changes: list[tuple[int, int]], cut: int, added: bytes
) -> None:
    data = bytearray(ANSWER)
    for place, byte in changes:
        data[place] = byte
    if cut % 3 == 0:
        data[cut:cut] = added
    elif cut % 3 == 1:
        del data[cut:]
    try:
        outcome = from_bytes(bytes(data))
    except JailAnswerBroken:
        return
    for diagnostic in outcome.diagnostics:
        assert render(diagnostic).isprintable() or "\n" in render(diagnostic)
        span = diagnostic.span
        assert 0 <= span.start <= span.end <= len(span.source.text)
    if outcome.root is not None:
        assert places(outcome.root)


def forged(index: int, part: bytes) -> bytes:
    """Return the answer with one of its parts replaced."""
    parts = unpack(ANSWER)
    parts[index] = part
    return pack(parts)


def node(kind: bytes, parent: bytes, place: bytes = b"0 0 1", *rest: bytes) -> bytes:
    return pack([kind, parent, place, *rest])


ROOT = node(b"e", b"0", b"0 0 1", b"out", b"0 0", pack([]))


@pytest.mark.parametrize(
    "answer",
    [
        forged(1, pack([pack([b"name", b"path"])])),
        forged(1, pack([])),
        forged(2, pack([pack([b"called", b"F", b"0 0 1", b"1 0"])])),  # a frame within itself
        forged(2, pack([pack([b"called", b"F", b"0 0 99999", b"0 0"])])),
        forged(3, pack([pack([b"fatal", b"c", b"m", b"0 0 1", pack([]), pack([]), b"0"])])),
        forged(3, pack([pack([b"error", b"c", b"m", b"0 -1 1", pack([]), pack([]), b"0"])])),
        forged(3, pack([pack([b"error", b"c", b"m", b"0 5 1", pack([]), pack([]), b"0"])])),
        forged(3, pack([pack([b"error", b"c", b"m", b"-1 0 1", pack([]), pack([]), b"0"])])),
        forged(3, pack([pack([b"error", b"c", b"m", b"0 0 1", pack([]), pack([]), b"-5"])])),
        forged(3, pack([pack([b"error", b"c", b"m", b"0 0 " + b"9" * 5000, b"", b"", b"0"])])),
        forged(4, b"\xff\xfe"),
        forged(7, pack([])[:0] + pack([node(b"t", b"0", b"0 0 1", b"a text")])),
        forged(7, pack([ROOT, node(b"t", b"0", b"0 0 1", b"x"), node(b"t", b"1", b"0 0 1", b"y")])),
        forged(7, pack([ROOT, node(b"t", b"7", b"0 0 1", b"x")])),
        forged(7, pack([ROOT, node(b"t", b"1", b"0 0 1", b"x")])),  # a node within itself
        forged(7, pack([ROOT, node(b"z", b"0", b"0 0 1", b"x")])),
        forged(7, pack([node(b"e", b"0", b"0 0 1", b"out", b"9 0", pack([]))])),
    ],
)
def test_a_lie_in_an_answer_is_found(answer: bytes) -> None:
    assert from_bytes(ANSWER).root is not None
    with pytest.raises(JailAnswerBroken):
        from_bytes(answer)
