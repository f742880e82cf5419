"""What leaves a jail: an outcome comes through as bytes unchanged, and lies are found out."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.effort import examples
from tests.example_files import PROGRAMS
from yamaro.api import build
from yamaro.diagnostics import Diagnostic, Frame, YamaroError
from yamaro.fixes import Edit, Fix
from yamaro.policy import Limits
from yamaro.rendering import render
from yamaro.sandbox.deep_stack import run_on_deep_stack
from yamaro.sandbox.jail import JailAnswerBroken, pack, unpack
from yamaro.sandbox.transfer import Outcome, from_bytes, to_bytes
from yamaro.source import Source, Span
from yamaro.xml.tree import Comment, Element, Text
from yamaro.xml.writer import write

texts = st.text(max_size=12)
names = st.text(st.characters(exclude_characters="\0", exclude_categories=["Cs"]), max_size=12)
codes = st.sampled_from(["a", "jail-broken", "capsule-needs-urdf-1.1"])


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


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.name)
def test_all_of_an_outcome_comes_through(path: Path) -> None:
    sent = outcome_of(path)
    got = from_bytes(to_bytes(sent))
    assert (got.messages, got.files, got.meshes) == (sent.messages, sent.files, sent.meshes)
    assert "".join(got.pieces) == "".join(sent.pieces)  # made of the tree
    assert [render(each) for each in got.diagnostics] == [render(each) for each in sent.diagnostics]
    assert (got.root is None) == (sent.root is None)
    if got.root is not None and sent.root is not None:
        assert write(got.root) == write(sent.root)
        assert places(got.root) == places(sent.root)


@st.composite
def diagnostics(draw: st.DrawFn) -> Diagnostic:
    path = draw(st.just("") | names.map("/".__add__))
    source = Source(draw(st.text(min_size=1, max_size=30)), name=draw(names), path=path)
    start = draw(st.integers(0, len(source.text)))
    span = Span(source, start, draw(st.integers(start, len(source.text))))
    frame = None
    for name in draw(st.lists(texts, max_size=4)):
        frame = Frame("called", name, span, parent=frame, home=draw(st.sampled_from([None, frame])))
    return Diagnostic(
        draw(codes),
        draw(texts),
        span,
        hint=draw(st.none() | texts),
        notes=draw(st.lists(texts, max_size=2)),
        severity=draw(st.sampled_from(["error", "warning"])),
        trace=frame,
        fix=draw(st.none() | fixes(source)),
    )


@st.composite
def fixes(draw: st.DrawFn, source: Source) -> Fix:
    ends = st.integers(0, len(source.text))
    places = sorted(draw(st.lists(ends, max_size=4)))
    pairs = zip(places[::2], places[1::2], strict=False)
    edits = [Edit(Span(source, start, end), draw(names)) for start, end in pairs]
    return Fix(draw(texts), edits, is_safe=draw(st.booleans()))


def described(fix: Fix | None) -> list[Any]:
    if fix is None:
        return []
    return [fix.title, fix.is_safe, [(each.span.key(), each.text) for each in fix.edits]]


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
        assert described(one.fix) == described(other.fix)


def valid_answer() -> bytes:
    source = Source("variables: {a: 1}\nout: 1\n", name="robot.yaml", path="/robot.yaml")
    root = Element("out", Span(source, 0, 3), attributes={"a": 1.5, "b": None})
    frame = Frame("called", "F", Span(source, 2, 4), parent=None)
    inner = Element("in", Span(source, 1, 3), children=[Text("x", Span(source, 0, 1))], trace=frame)
    root.children = [inner, Comment("c", Span(source, 4, 5))]
    span = Span(source, 3, 9)
    fix = Fix("t", [Edit(span, "x")], is_safe=True)
    diagnostic = Diagnostic("code", "m", span, severity="warning", trace=frame, fix=fix)
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
        assert all(char.isprintable() for char in render(diagnostic) if char not in "\n\t")
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
        forged(3, pack([pack([b"fatal", b"c", b"m", b"0 0 1", pack([]), pack([]), b"0", b""])])),
        forged(3, pack([pack([b"error", b"c", b"m", b"0 -1 1", pack([]), pack([]), b"0", b""])])),
        forged(3, pack([pack([b"error", b"c", b"m", b"0 5 1", pack([]), pack([]), b"0", b""])])),
        forged(3, pack([pack([b"error", b"c", b"m", b"-1 0 1", pack([]), pack([]), b"0", b""])])),
        forged(3, pack([pack([b"error", b"c", b"m", b"0 0 1", pack([]), pack([]), b"-5", b""])])),
        forged(3, pack([pack([b"error", b"c", b"m", b"0 0 " + b"9" * 5000, b"", b"", b"0", b""])])),
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


# --- each thing that crosses --------------------------------------------------------------------

FINE = '<?xml version="1.0"?>\n<robot name="r">\n  <link name="é&#10;"/>\n</robot>\n'


def answer(**parts: bytes) -> bytes:
    """Return an answer without a tree, with some of its parts replaced."""
    names = "messages sources frames diagnostics document files meshes nodes notes documents noted "
    names += "made"
    usual = {"document": FINE.encode()} | parts
    return pack([usual.get(name, b"") for name in names.split()])


def test_a_document_that_is_fine_is_believed() -> None:
    assert from_bytes(answer()).pieces == [FINE]


BEGINNING = '<?xml version="1.0"?>\n'


@pytest.mark.parametrize(
    "document",
    [
        "no xml",
        "\x1b]0;PWNED\x07 <no xml",
        "<robot/>",
        BEGINNING,
        BEGINNING + "\x1b[2J<robot/>",
        BEGINNING + "<robot>\x1b[2J</robot>",
        BEGINNING + "<robot>\0</robot>",
        BEGINNING + "<robot/>\0",
        BEGINNING + "<robot/>\x1b",
        BEGINNING + "<robot/> behind",
        BEGINNING + "<robot/><robot/>",
        BEGINNING + "<robot>",
        BEGINNING + "<robot a='1' a='2'/>",
        BEGINNING + "<robot a=1/>",
        BEGINNING + "<robot a='<'/>",
        BEGINNING + "<robot>&nbsp;</robot>",
        BEGINNING + "<robot>&#0;</robot>",
        BEGINNING + "<robot>&#x1b;</robot>",
        BEGINNING + "<robot>\ud800</robot>",
        BEGINNING + "<robot>\ufffe</robot>",
        BEGINNING + "<robot><!-- a -- b --></robot>",
        BEGINNING + "<x:robot/>",
        BEGINNING + "<robot><a xmlns:x='u'/><x:b/></robot>",
        BEGINNING + "<robot x:a='1'/>",
        BEGINNING + "<?python evil?><robot/>",
        BEGINNING + "<robot/><?python evil?>",
        BEGINNING + "<!DOCTYPE robot [<!ENTITY a 'b'>]><robot>&a;</robot>",
        BEGINNING + "<!DOCTYPE robot SYSTEM 'file:///etc/passwd'><robot/>",
        '<?xml version="1.0" encoding="UTF-7"?>\n<robot/>',
        '<?xml version="1.1"?>\n<robot>&#1;</robot>',
        BEGINNING + "<a>" * 1501 + "</a>" * 1501,
    ],
)
def test_a_forged_document_is_found_out(document: str) -> None:
    with pytest.raises(JailAnswerBroken):
        from_bytes(answer(document=document.encode("utf-8", "surrogatepass")))


def document(**parts: bytes) -> bytes:
    """Return the answer with a document in an output format, with some of its parts replaced."""
    names = "name file_name refusal text root robot notes losses has_assets".split()
    usual = {"name": b"mjcf", "text": FINE.encode(), "has_assets": b"1"} | parts
    packed = [usual.pop(name, b"") for name in names]
    assets = [each for name, data in usual.items() for each in (name.encode(), data)]
    return answer(documents=pack([pack([*packed, *assets])]))


def test_documents_in_formats_come_through() -> None:
    (found,) = from_bytes(document(**{"assets/a.stl": b"\0", "scene.xml": b""})).documents
    assert (found.format, found.text) == ("mjcf", FINE)
    assert found.assets == {"assets/a.stl": b"\0", "scene.xml": b""}
    packed = document(name=b"usd", text=b"#usda 1.0", has_assets=b"0")
    (found,) = from_bytes(packed, texts=("usd",)).documents
    assert (found.text, found.assets, found.root) == ("#usda 1.0", None, None)


@pytest.mark.parametrize(
    "parts",
    [
        {"text": b"#usda 1.0"},
        {"text": FINE.encode("utf-16"), "name": b"usd"},
        {"name": b"MJCF"},
        {"has_assets": b"-1"},
        {"losses": b"x"},
        {"/etc/passwd": b""},
        {"../a": b""},
        {"assets/../../a": b""},
        {"assets/.bashrc": b""},
        {"": b""},
        {"a//b": b""},
        {"a\\b": b""},
        {"C:a": b""},
        {"a\0": b""},
    ],
)
def test_a_forged_document_in_a_format_is_found_out(parts: dict[str, bytes]) -> None:
    with pytest.raises(JailAnswerBroken):
        from_bytes(document(**parts))


def test_a_document_in_no_encoding_is_found_out() -> None:
    for data in (b"\xff\xfe", FINE.encode("utf-16"), FINE.encode("latin-1")):
        with pytest.raises(JailAnswerBroken):
            from_bytes(answer(document=data))


def test_a_document_longer_than_the_limit_is_refused() -> None:
    assert from_bytes(answer(), Limits(output=len(FINE))).pieces == [FINE]
    with pytest.raises(JailAnswerBroken):
        from_bytes(answer(), Limits(output=len(FINE) - 1))


def of_tree(*nodes: bytes) -> bytes:
    source = pack([pack([b"robot.yaml", b"/robot.yaml", b"text"])])
    return answer(sources=source, nodes=pack(nodes))


def element(name: bytes, *attributes: tuple[bytes, bytes]) -> bytes:
    packed = pack([pack([key, value, b"0 0 1"]) for key, value in attributes])
    return node(b"e", b"0", b"0 0 1", name, b"0 0", packed)


def test_the_document_of_a_tree_is_made_of_the_tree() -> None:
    answered = from_bytes(of_tree(element(b"robot", (b"name", b"<r>"))))
    assert answered.pieces == [BEGINNING + '<robot name="&lt;r&gt;"/>\n']


@pytest.mark.parametrize(
    "nodes",
    [
        [element(b"no xml")],
        [element(b"\x1b[2J")],
        [element(b"")],
        [element(b"robot", (b"a b", b"1"))],
        [element(b"robot", (b"a='1' b", b"1"))],
        [element(b"robot", (b"a", b"\x1b[2J"))],
        [element(b"x:robot")],
        [element(b"robot/><robot")],
        [element(b"robot"), node(b"t", b"0", b"0 0 1", b"\0")],
        [element(b"robot"), node(b"c", b"0", b"0 0 1", b"--><evil/><!--")],
        [element(b"robot"), node(b"c", b"0", b"0 0 1", b"ends with -")],
    ],
)
def test_a_tree_that_is_no_document_is_found_out(nodes: list[bytes]) -> None:
    with pytest.raises(JailAnswerBroken):
        from_bytes(of_tree(*nodes))


def test_a_tree_deeper_than_the_limit_is_refused() -> None:
    inner = [node(b"e", b"%d" % n, b"0 0 1", b"a", b"0 0", b"") for n in range(1600)]
    data = of_tree(element(b"robot"), *inner)
    with pytest.raises(JailAnswerBroken):
        run_on_deep_stack(lambda: from_bytes(data))


def of_diagnostic(
    code: bytes, place: bytes = b"0 0 1", *, path: bytes = b"", fix: bytes = b""
) -> bytes:
    told = pack([b"error", code, b"m", place, pack([]), pack([]), b"0", fix])
    sources = pack([pack([b"robot.yaml", path, b"text"])])
    return answer(sources=sources, diagnostics=pack([told]))


@pytest.mark.parametrize(
    "code",
    [
        "",
        "-",
        "a-",
        "a--b",
        "A",
        "a b",
        "a\n",
        "\x1b[31m",
        "é",
        "\u202e",
        "a]: x",
        "a" * 61,
        "a..b",
    ],
)
def test_a_code_is_in_kebab_case(code: str) -> None:
    assert from_bytes(of_diagnostic(b"no-such-code")).has_errors
    with pytest.raises(JailAnswerBroken):
        from_bytes(of_diagnostic(code.encode()))


@pytest.mark.parametrize("path", [b"robot.yaml", b"../robot.yaml", b"/a\0b", b"/" + b"a" * 5000])
def test_a_path_is_absolute_and_one_that_can_be(path: bytes) -> None:
    assert from_bytes(of_diagnostic(b"a", path=b"/robot.yaml")).has_errors
    with pytest.raises(JailAnswerBroken):
        from_bytes(of_diagnostic(b"a", path=path))
    with pytest.raises(JailAnswerBroken):
        from_bytes(answer(files=pack([path])))


@pytest.mark.parametrize("name", [b"a\0b", b"\xed\xa0\x80", b"a" * 5000])
def test_the_name_of_a_mesh_is_one_that_a_file_can_have(name: bytes) -> None:
    assert from_bytes(answer(meshes=pack([b"package://p/m.stl"]))).meshes == ["package://p/m.stl"]
    with pytest.raises(JailAnswerBroken):
        from_bytes(answer(meshes=pack([name])))


@pytest.mark.parametrize("place", [b"0 0 +1", b"0 0 1_0", b"0  1", b"0 0 0x1", b"0 0 -0", b"0 0 "])
def test_a_number_is_written_in_digits(place: bytes) -> None:
    with pytest.raises(JailAnswerBroken):
        from_bytes(of_diagnostic(b"a", place))


def test_a_step_is_one_that_there_is() -> None:
    for kind, is_fine in ((b"called", True), (b"\x1b[2J", False), (b"inherited", False)):
        frame = pack([kind, b"F", b"0 0 1", b"0 0"])
        data = answer(sources=pack([pack([b"a", b"", b"text"])]), frames=pack([frame]))
        if is_fine:
            assert from_bytes(data)
            continue
        with pytest.raises(JailAnswerBroken):
            from_bytes(data)


def test_more_than_may_be_printed_is_refused() -> None:
    data = answer(messages=pack([b"0123456789"] * 3))
    assert len(from_bytes(data, Limits(printed=20)).messages) == 3
    with pytest.raises(JailAnswerBroken):
        from_bytes(data, Limits(printed=10))


def of_fix(*edits: tuple[bytes, bytes], safety: bytes = b"1") -> bytes:
    fix = pack([b"title", safety, pack([pack(each) for each in edits])])
    return of_diagnostic(b"a", fix=fix)


@pytest.mark.parametrize(
    "data",
    [
        of_fix((b"0 0 9", b"x")),
        of_fix((b"1 0 1", b"x")),
        of_fix((b"0 2 1", b"x")),
        of_fix((b"0 0 2", b"x"), (b"0 1 3", b"y")),
        of_fix((b"0 2 3", b"x"), (b"0 0 1", b"y")),
        of_fix((b"0 0 1", b"x" * 20_001)),
        of_fix((b"0 0 1", b"\xff")),
        of_fix(*[(b"0 1 1", b"x")] * 1001),
        of_fix((b"0 0 1", b"x"), safety=b"yes"),
        of_diagnostic(b"a", fix=b"0"),
    ],
)
def test_a_forged_fix_is_found_out(data: bytes) -> None:
    fix = from_bytes(of_fix((b"0 0 1", b"x"), (b"0 1 1", b"y"))).diagnostics[0].fix
    assert fix is not None and [each.text for each in fix.edits] == ["x", "y"]
    with pytest.raises(JailAnswerBroken):
        from_bytes(data)
