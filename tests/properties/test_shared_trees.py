"""An element that stands in several places is checked and written as if each place had its own."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.check.test_check import FAULTY, GOOD_ROBOTS, NEWER_ROBOTS, bad_robots, read
from tests.effort import examples
from yamaro.check.robot import check
from yamaro.diagnostics import INHERITED, Diagnostic, Frame, Reporter, YamaroError
from yamaro.source import Source, Span
from yamaro.xml.tree import Comment, Element, Memo, Text, unshared
from yamaro.xml.values import format_number
from yamaro.xml.writer import write_pieces

SPAN = Span(Source("key: value", name="t.yaml"), 0, 3)


def with_memos(root: Element) -> Element:
    """Return a tree after giving a memo to each element that is in several places of it."""
    counts: dict[int, int] = {}
    pending = [root]
    while pending:
        element = pending.pop()
        counts[id(element)] = counts.get(id(element), 0) + 1
        if counts[id(element)] == 2:
            element.memo = Memo()
        if counts[id(element)] < 3:
            pending.extend(element.elements())
    return root


# --- writing ----------------------------------------------------------------------------------

NAMES = st.sampled_from(["a", "b", "gz:c"])
VALUES = st.sampled_from(
    ["x", "a_b", "0 0 1", '<"&', "a:b", "long " * 5, 1.5, True, None, [1, 2.0]]
)
ATTRIBUTES = st.dictionaries(st.sampled_from(["k", "l", "gz:m", "xmlns:gz"]), VALUES, max_size=2)


@st.composite
def trees(draw: Any) -> Element:
    """Return a tree in which any element may stand in several places, however deep."""
    nodes: list[Any] = [Text("text", SPAN), Text("", SPAN), Comment("note", SPAN)]
    for _ in range(draw(st.integers(1, 7))):
        children = draw(st.lists(st.sampled_from(nodes), max_size=4))
        element = Element(draw(NAMES), SPAN, attributes=draw(ATTRIBUTES), children=children)
        nodes += [element, element]
    prefixes = draw(st.sampled_from([{}, {"xmlns:gz": "u"}]))
    return Element("root", SPAN, attributes=prefixes, children=nodes[3:])


def written(root: Element) -> str:
    try:
        return "".join(write_pieces(root))
    except YamaroError as error:
        return str(error)


@settings(max_examples=examples(500))
@given(trees())
def test_shared_elements_are_written_as_if_each_place_had_its_own(root: Element) -> None:
    expected = written(unshared(root))
    assert written(with_memos(root)) == expected
    assert written(root) == expected, "what was noted for one document is not used for another"


@settings(max_examples=examples(500))
@given(trees(), st.integers(0, 3), st.lists(NAMES, min_size=2, max_size=4))
def test_alike_elements_are_written_as_if_each_were_the_only_one(
    inner: Element, own: int, names: list[str]
) -> None:
    memo, children = Memo(own), []
    for name in names:
        keys: list[dict[str, object]] = [{"k": name + str(i)} for i in range(own)]
        first: list[Any] = [Element("own", SPAN, attributes) for attributes in keys]
        alike = Element("alike", SPAN, {"name": name}, [*first, *inner.children])
        alike.memo = memo
        children.append(alike)
    root = Element("root", SPAN, attributes=inner.attributes, children=[*children])
    assert written(root) == written(unshared(root))


@settings(max_examples=examples(2000))
@given(st.floats() | st.integers(-(10**18), 10**18).map(float) | st.floats(-1000, 1000))
def test_a_number_is_the_repr_of_the_float_rounded_to_15_digits(value: float) -> None:
    rounded = float(f"{value:.15g}")
    expected = value if rounded in (float("inf"), -float("inf")) else rounded
    assert format_number(value) == repr(expected + 0.0)


# --- checking ---------------------------------------------------------------------------------

ROBOTS = [
    *(robot.text for group in (FAULTY, bad_robots("advice")) for robot in group),
    *GOOD_ROBOTS.values(),
    *NEWER_ROBOTS.values(),
]


def grafted(draw: Any, element: Element, pool: dict[str, list[Element]], depth: int) -> Element:
    """Return a copy in which children are taken out, doubled, or those of another robot."""
    children = []
    for child in element.children:
        if isinstance(child, Element):
            kind = draw(st.sampled_from(["same", "same", "same", "own", "other", "twice", "none"]))
            if kind == "other":
                child = draw(st.sampled_from(pool[child.name]))
            elif kind == "own" and depth:
                child = grafted(draw, child, pool, depth - 1)
            children += [child] * {"twice": 2, "none": 0}.get(kind, 1)
        else:
            children.append(child)
    return element.with_children(list(children))


@st.composite
def robots(draw: Any) -> Element:
    """Return a robot of pieces of several, most of them faulty, in which pieces come again."""
    roots = [read(text) for text in draw(st.lists(st.sampled_from(ROBOTS), min_size=1, max_size=3))]
    pool: dict[str, list[Element]] = {}
    pending = list(roots)
    while pending:
        element = pending.pop()
        pool.setdefault(element.name, []).append(element)
        pending += element.elements()
    children = [child for root in roots for child in root.children]
    first = roots[0].with_children(children)
    again = [grafted(draw, first, pool, 3) for _ in range(draw(st.integers(1, 2)))]
    return first.with_children([child for root in (first, *again) for child in root.children])


def told(diagnostic: Diagnostic) -> object:
    span, notes = diagnostic.span.key(), diagnostic.notes
    return (diagnostic.code, diagnostic.message, span, diagnostic.hint, notes)


def findings(root: Element) -> list[Diagnostic]:
    faults, advice = Reporter(), Reporter()
    check(
        root,
        reporter=faults,
        advice=advice,
        resolve_mesh=lambda filename, span: None,
        package_fault=lambda package, span: ("install it", ["/opt"]),
    )
    return faults.diagnostics + advice.diagnostics


@settings(max_examples=examples(500))
@given(robots())
def test_shared_elements_are_checked_as_if_each_place_had_its_own(root: Element) -> None:
    expected = [told(finding) for finding in findings(unshared(root))]
    assert [told(finding) for finding in findings(with_memos(root))] == expected
    assert [told(finding) for finding in findings(root)] == expected


def doubled(element: Element, depth: int) -> Element:
    """Return a copy in which each element `depth` levels below stands twice."""
    children: list[Any] = []
    for child in element.children:
        if not isinstance(child, Element):
            children.append(child)
        elif depth == 1:
            children += [child, child]
        else:
            children.append(doubled(child, depth - 1))
    return element.with_children(children)


@pytest.mark.parametrize("depth", [1, 2, 3])
def test_an_element_that_stands_twice_is_reported_as_two_of_them(depth: int) -> None:
    for text in ROBOTS:
        root = doubled(read(text), depth)
        expected = [told(finding) for finding in findings(unshared(root))]
        assert [told(finding) for finding in findings(root)] == expected, text


def test_what_is_under_the_root_and_inherits_its_trace_was_not_called() -> None:
    frame = Frame("called", "Leg", SPAN, parent=None)
    for one, other in ((INHERITED, frame), (frame, INHERITED), (INHERITED, INHERITED)):
        root = read('<robot name="r"><link name="a"/><link name="a"/></robot>')
        root.elements()[0].trace = one
        root.elements()[1].trace = other
        (finding,) = findings(root)
        assert finding.code == "duplicate-link"
        assert finding.trace is (None if other is INHERITED else frame)
        assert finding.notes[0].startswith("first defined at robot.urdf:1:29")
        assert "inherited" not in finding.notes[0]
