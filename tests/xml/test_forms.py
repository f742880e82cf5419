"""Elements of fixed shape are built once for values that come again, and say where they stand."""

from __future__ import annotations

import pytest

from yamaro.diagnostics import INHERITED, Frame
from yamaro.source import Source, Span
from yamaro.syntax.nodes import Body, ElementNode, PartNode
from yamaro.syntax.parser import parse
from yamaro.xml.forms import MAX_KNOWN, Builder, Form, key_of
from yamaro.xml.tree import Element, Memo, Text


def root_of(text: str) -> Body:
    """Return the body of the root element of a file, with these lines in it."""
    lines = "".join(f"  {line}\n" for line in text.splitlines())
    document = parse(Source(f"robot:\n{lines}", name="t.yaml")).require()
    assert document.root is not None and isinstance(document.root.content, Body)
    return document.root.content


def form_of(text: str) -> Form:
    (node,) = root_of(text).statements
    assert isinstance(node, (ElementNode, PartNode)) and node.form is not None
    return node.form


def memo_of(element: Element) -> Memo | None:
    return element.memo


def frame(name: str) -> Frame:
    return Frame("called", name, Span(Source("", name="t.yaml"), 0, 0), parent=None)


# --- values that are the same -----------------------------------------------------------------


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ((1,), (1.0,)),
        ((1,), (True,)),
        ((0,), (False,)),
        ((0.0,), (-0.0,)),
        ((0,), (0.0,)),
        (("",), (None,)),
        ((1, "a"), (1.0, "a")),
        ((1, "a"), (True, "a")),
        ((0.0, "a"), (-0.0, "a")),
        ((0.0, 0.0), (0.0, -0.0)),
        ((-0.0, 0.0), (0.0, -0.0)),
        ((0, 0.0), (0.0, 0)),
        (("a", "b"), ("b", "a")),
    ],
)
def test_values_that_are_written_in_different_ways_are_told_apart(
    one: tuple[object, ...], other: tuple[object, ...]
) -> None:
    assert key_of(one) is not None
    assert key_of(one) != key_of(other)
    assert key_of(one) == key_of(tuple(one))


@pytest.mark.parametrize(
    "values", [("a",), (1,), (0,), (0.0,), (None,), (True,), (1, 2.5), ("a", 0.0), ()]
)
def test_equal_values_are_the_same(values: tuple[object, ...]) -> None:
    assert key_of(values) == key_of((*values,))
    assert key_of(values) is not None


def test_values_that_may_change_are_never_the_same() -> None:
    class Name(str):
        pass

    values: list[object] = [[1], (1,), Name("a"), {}]
    for value in values:
        assert key_of((value,)) is None
        assert key_of((value, 1)) is None


# --- elements that come again -----------------------------------------------------------------


def test_the_same_values_give_the_same_element() -> None:
    builder = Builder()
    form = form_of("link/name=$(n): $(t)")
    first = builder.element(form, ("a", 1), False)
    assert memo_of(first) is None
    assert builder.element(form, ("a", 1), False) is first
    memo = first.memo
    assert memo is not None and memo.own is None
    others = [builder.element(form, values, False) for values in (("a", 1.0), ("b", 1))]
    assert [other.memo for other in others] == [None, None]
    assert builder.element(form, ("a", 1), False) is first
    assert first.memo is memo


def test_each_way_to_an_element_has_its_own() -> None:
    builder = Builder()
    form = form_of("link: $(t)")
    one, other = frame("One"), frame("Other")
    first = builder.element(form, (1,), False, one)
    second = builder.element(form, (1,), False, other)
    plain = builder.element(form, (1,), False)
    assert [first.trace, second.trace, plain.trace] == [one, other, INHERITED]
    assert builder.element(form, (1,), False, one) is first
    assert builder.element(form, (1,), False, other) is second
    assert builder.element(form, (1,), False) is plain


def test_in_a_part_and_outside_are_two_things() -> None:
    builder = Builder()
    form = form_of("mass: $(t)")
    outside = builder.element(form, (None,), False)
    inside = builder.element(form, (None,), True)
    assert outside is not inside
    assert outside.children == []
    assert [type(child) for child in inside.children] == [Text]  # a key without a value


def test_values_that_may_change_give_an_element_each_time() -> None:
    builder = Builder()
    form = form_of("a: $(t)")
    value = [1]
    assert builder.element(form, (value,), False) is not builder.element(form, (value,), False)


def new_elements(builder: Builder, form: Form, first: int, count: int) -> None:
    for number in range(first, first + count):
        builder.element(form, (number,), False)


def is_kept(builder: Builder, form: Form) -> bool:
    return builder.element(form, ("x",), False) is builder.element(form, ("x",), False)


def test_after_many_new_ones_in_a_row_none_is_kept() -> None:
    builder = Builder()
    form = form_of("a: $(t)")
    new_elements(builder, form, 0, MAX_KNOWN - 1)
    assert is_kept(builder, form)
    new_elements(builder, form, 1000, MAX_KNOWN)
    assert not is_kept(builder, form)


def test_one_that_comes_again_begins_the_row_anew() -> None:
    builder = Builder()
    form = form_of("a: $(t)")
    for turn in range(4):
        assert is_kept(builder, form)
        new_elements(builder, form, 1000 * turn, MAX_KNOWN - 4)
    assert is_kept(builder, form)


def test_no_more_than_some_are_kept() -> None:
    builder = Builder()
    form = form_of("a: $(t)")
    first = builder.element(form, ("first",), False)
    for turn in range(4):
        new_elements(builder, form, 1000 * turn, MAX_KNOWN // 4)
        assert is_kept(builder, form)
    assert builder.element(form, ("first",), False) is not first


def test_what_is_always_the_same_in_an_element_is_in_all_after_the_first() -> None:
    builder = Builder()
    form = form_of("link/name=$(n):\n  visual: {}\n  mass/value=1:")
    first, second, third = (builder.element(form, (name,), False).elements() for name in "abc")
    assert [child.name for child in first] == [child.name for child in second] == ["visual", "mass"]
    assert [child.memo for child in first] == [None, None]  # they are those of all conversions
    assert all(child.memo is not None for child in second)
    assert third == second


def test_inner_elements_are_shared_by_their_own_values() -> None:
    builder = Builder()
    form = form_of("link/name=$(n):\n  mass/value=$(m):")
    first = builder.element(form, ("a", 2), False)
    second = builder.element(form, ("b", 2), False)
    third = builder.element(form, ("c", 3), False)
    assert first.children[0] is second.children[0] is not third.children[0]
    (mass,) = third.children
    assert isinstance(mass, Element) and mass.attributes == {"value": 3}


@pytest.mark.parametrize(
    ("text", "values", "verbatim"),
    [("a: $(t)", (1,), False), ("<a>: $(t)", (1,), True), ("<a/b=$(t)>: x", (1,), True)],
)
def test_an_element_knows_where_it_was_written(
    text: str, values: tuple[object, ...], verbatim: bool
) -> None:
    body = root_of(text)
    (node,) = body.statements
    assert isinstance(node, ElementNode) and node.form is not None
    element = Builder().element(node.form, values, False)
    assert element.body is body
    assert element.verbatim is verbatim
    assert element.span is node.span
    assert element.name == "a"


def test_attributes_without_a_value_are_left_out() -> None:
    form = form_of("a/b=$(x), c=$(y), d=1 $(z):")
    element = Builder().element(form, (None, 2, None), False)
    assert element.attributes == {"c": 2, "d": "1 None"}
    assert element.value_spans is form.value_spans
    assert {name: span.written() for name, span in form.value_spans.items()} == {
        "b": "$(x)",
        "c": "$(y)",
        "d": "1 $(z)",
    }


# --- what the parser has made -----------------------------------------------------------------


def made_element() -> Element:
    (element,) = root_of("a: {b: {}, c: text}").statements
    assert isinstance(element, Element)
    return element


def test_what_is_put_out_a_second_time_is_a_copy_with_a_memo() -> None:
    builder = Builder()
    element = made_element()
    assert builder.emitted(element) is element
    copy = builder.emitted(element)
    assert copy is not element
    assert (copy.name, copy.children) == ("a", element.children)
    assert copy.memo is not None
    assert builder.emitted(element) is copy
    assert element.memo is None, "it is that of other conversions as well"
    assert Builder().emitted(element) is element


def test_the_same_way_gives_the_same_copy() -> None:
    builder = Builder()
    element = made_element()
    one, other = frame("One"), frame("Other")
    copy = builder.traced(element, one)
    assert (copy.trace, copy.name, copy.children) == (one, "a", element.children)
    assert memo_of(copy) is None
    assert builder.traced(element, one) is copy
    assert copy.memo is not None
    second = builder.traced(element, other)
    assert second is not copy and second.trace is other
    assert all(child.memo is not None for child in second.elements())
    assert builder.traced(element, frame("Third")).children == second.children


def test_all_that_is_in_a_copy_can_have_its_trace() -> None:
    builder = Builder()
    way = frame("One")
    copy = builder.traced(made_element(), way, way)
    assert [child.trace for child in copy.elements()] == [way, way]
    form = form_of("a/x=$(v):\n  b/y=$(v): {c: text}\n  d: {}")
    element = builder.element(form, (1, 1), False, way, way)
    pending = [element]
    for inner in pending:
        assert inner.trace is way
        pending += inner.elements()
    assert [inner.name for inner in pending] == ["a", "b", "d", "c"]
    assert builder.element(form, (1, 1), False, way).elements()[1].trace is INHERITED


def test_a_part_holds_what_its_form_says() -> None:
    builder = Builder()
    form = form_of("part:\n  name: $(n)\n  link: {mass: $(m), <a>: {}}")
    part = builder.part(form, ("arm", None), None)
    assert (part.name, part.span, part.attributes) == ("part", form.span, {})
    assert part.body is form.body
    name, link = part.children
    assert isinstance(name, Element) and isinstance(link, Element)
    assert [child.value for child in name.children if isinstance(child, Text)] == ["arm"]
    assert [child.name for child in link.children if isinstance(child, Element)] == ["mass", "a"]
    assert part.children is part.children
    again = builder.part(form, ("arm", None), None)
    assert again.children[0] is name


def test_what_is_always_the_same_in_parts_is_shared_by_those_of_one_form() -> None:
    builder = Builder()
    arm = form_of("part:\n  name: $(n)\n  <a>: {}")
    leg = form_of("part:\n  name: $(n)\n  <b>: {}")
    for form in (arm, leg):
        static = [builder.part(form, (name,), None).elements()[1] for name in ("x", "y", "z")]
        assert static[0].memo is None
        assert static[1] is static[2]
        assert static[1].memo is not None


def test_a_part_with_other_children_is_reached_the_same_way() -> None:
    form = form_of("part: {name: $(n)}")
    way = frame("Make")
    part = Builder().part(form, ("arm",), way)
    empty = part.with_children([])
    assert (empty.children, empty.span, empty.trace) == ([], form.span, way)
    assert empty.body is form.body
