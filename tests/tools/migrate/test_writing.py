"""Which statements have a short head in migrated sources."""

from __future__ import annotations

import textwrap

import pytest

from yamaro import build
from yamaro.tools.migrate.document import Body, Entry, Row
from yamaro.tools.migrate.writing import write_document


def written(*entries: Entry) -> str:
    """Return a model with these statements; what is written is a file that has no errors."""
    functions = Body([Entry("Leg", Body([Entry("input", Row(["x", "y=1"])), body("foot")]))])
    text = write_document(
        Body([Entry("functions", functions), Entry("launch", Body(entries))])
    ).partition("launch:\n")
    build("robot.yaml", text="".join(text))
    return textwrap.dedent(text[2])


def body(*names: str) -> Entry:
    return Entry("body", Body([Entry(name) for name in names]))


def condition(text: str, *names: str) -> Entry:
    return Entry("if", Body([Entry("condition", text), body(*(names or ("a",)))]))


def function(name: str, inputs: list[str], *names: str) -> str:
    """Return what a file with a function begins with."""
    parts = [Entry("input", Row(inputs))] if inputs else []
    functions = Body([Entry(name, Body([*parts, body(*names)]))])
    text = write_document(Body([Entry("functions", functions), Entry("launch", None)]))
    build("robot.yaml", text=text)
    return text.removeprefix("functions:\n").partition("launch")[0]


@pytest.mark.parametrize("text", ["1 > 0", "true", "0", "'a' == \"b\"", "not (1 > 2)"])
def test_conditions_are_in_the_head(text: str) -> None:
    assert written(condition(text)) == f"if {text}:\n  a:\n"


@pytest.mark.parametrize(
    "text", ["'a: b' == 'c'", "'a #' == 'b'", "$(1 > 0)", " or ".join(["1 > 0"] * 12)]
)
def test_what_needs_quotes_or_is_too_wide_has_the_long_form(text: str) -> None:
    assert written(condition(text)).startswith("if:\n  condition:")


@pytest.mark.parametrize("name", ["body", "condition", "in", "range", "input", "iterator"])
def test_elements_named_like_entries_of_the_long_forms_keep_it(name: str) -> None:
    assert written(condition("1 > 0", name)).startswith("if:\n  condition: 1 > 0\n  body:\n")
    assert function("Leg", ["x"], name).startswith("  Leg:\n    input: x\n    body:\n")


def test_else_stays_in_the_item_of_its_if_where_other_keys_are_beside_them() -> None:
    other = Entry("else", Body([Entry("b")]))
    both = [condition("1 > 0"), other, condition("2 > 0"), other]
    made = written(*map(Entry, "xyz"), *both)
    assert made == (
        "- x:\n  y:\n  z:\n  if 1 > 0:\n    a:\n  else:\n    b:\n"
        "- if 2 > 0:\n    a:\n  else:\n    b:\n"
    )


def test_functions_have_their_parameters_in_the_head() -> None:
    assert function("Leg", ["side", "y=0", "**Foot"], "a") == "  Leg(side, y=0, **Foot):\n    a:\n"
    assert function("Leg/parent", ["side"], "a") == "  Leg(side)/parent:\n    a:\n"
    assert function("Leg", [], "a") == "  Leg():\n    a:\n"


@pytest.mark.parametrize("default", ["''''", "'('", "')'", "': '", "' #'"])
def test_defaults_of_any_kind_are_read_as_they_were(default: str) -> None:
    function("Leg", [f"a={default}", "b=1"], "x")


def test_many_parameters_are_below_the_name() -> None:
    names = [f"parameter_{number}" for number in range(12)]
    assert function("Leg", names, "a").startswith("  Leg:\n    input:\n      parameter_0, ")


def test_loops_have_what_they_run_over_in_the_head() -> None:
    loop = Entry("for", Body([Entry("iterator", "i"), Entry("in", "range(2)"), body("a")]))
    assert written(loop) == "for i in range(2):\n  a:\n"


def test_comments_in_the_head_of_the_long_form_are_above_the_short_one() -> None:
    statement = condition("1 > 0")
    statement.comment = "one"
    assert isinstance(statement.value, Body)
    statement.value.entries[0].comment = "two"
    statement.value.opening = "three"
    assert written(statement) == "# one\n# two\nif 1 > 0:  # three\n  a:\n"
