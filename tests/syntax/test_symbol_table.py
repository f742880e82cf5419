"""The symbol table of a file: what is declared, read and assigned, and in which context."""

from __future__ import annotations

from yamaro.source import Source
from yamaro.syntax.parser import parse
from yamaro.syntax.symbol_table import (
    ARGUMENT,
    ASSIGNED,
    BLOCK,
    BLOCK_NAME,
    FILE,
    FUNCTION,
    FUNCTION_NAME,
    IMPORTED,
    ITERATOR,
    NAMESPACE,
    PARAMETER,
    PASSED,
    VARIABLE,
    SymbolTable,
)

ROBOT = """\
import: numpy as np, os.path
arguments:
  count: 6
variables:
  length: $(count * 2)
  width/global: 1
functions:
  Leg(side, long=$(length), **Foot):
  - variables: {half: $(long / 2)}
  - Foot:
model:
- include: {path: other.yaml, namespace: parts, size: $(width)}
- for i, name in enumerate(names):
  - Leg:
      side: $(name)
      Foot:
      - variables: {inner: 1}
- process: total = sum(x for x in range(i))
- parts.Arm: $(parts.size)
"""


def table_of(text: str) -> SymbolTable:
    return parse(Source(text, name="t.yaml")).require().symbols


def at(text: str, word: str, *, after: str = "") -> int:
    return text.index(word, text.index(after))


def test_each_name_is_declared_where_it_is_written() -> None:
    table = table_of(ROBOT)
    found = [
        (each.name, each.kind, each.context.kind)
        for each in sorted(table.declarations, key=lambda each: each.span.start)
    ]
    assert found == [
        ("np", IMPORTED, FILE),
        ("os", IMPORTED, FILE),
        ("count", ARGUMENT, FILE),
        ("length", VARIABLE, FILE),
        ("width", VARIABLE, FILE),
        ("Leg", FUNCTION_NAME, FILE),
        ("side", PARAMETER, FUNCTION),
        ("long", PARAMETER, FUNCTION),
        ("Foot", BLOCK_NAME, FUNCTION),
        ("half", VARIABLE, FUNCTION),
        ("parts", NAMESPACE, FILE),
        ("i", ITERATOR, FILE),
        ("name", ITERATOR, FILE),
        ("inner", VARIABLE, BLOCK),
        ("total", ASSIGNED, FILE),
    ]
    assert all(each.span.written() == each.name for each in table.declarations)


def test_each_name_is_used_where_it_is_written() -> None:
    table = table_of(ROBOT)
    assert all(each.span.written() == each.name for each in table.uses)
    assert [each.name for each in table.uses if each.is_assigned] == ["total"]
    assert [each.name for each in table.uses if each.is_called] == ["Foot", "Leg", "Foot", "Arm"]
    read = [each.name for each in table.uses if not each.is_called and not each.is_assigned]
    assert read == [
        *("count", "length", "long"),
        *("size", "width", "enumerate", "names", "side", "name"),
        *("sum", "range", "i"),
        *("parts", "parts", "size"),
    ]


def test_the_context_at_a_place_is_the_innermost_around_it() -> None:
    table = table_of(ROBOT)
    assert table.context_at(at(ROBOT, "half")).kind == FUNCTION
    assert table.context_at(at(ROBOT, "side")).kind == FUNCTION
    assert table.context_at(at(ROBOT, "inner")).kind == BLOCK
    assert table.context_at(at(ROBOT, "process")).kind == FILE


def test_names_passed_to_included_files_are_found_beside_the_declared_ones() -> None:
    text = "variables:\n  size: 1\nmodel:\n- include: {path: other.yaml, size: 2}\n"
    assert [each.kind for each in table_of(text).where_declared("size")] == [VARIABLE, PASSED]


def test_a_file_that_computes_names_or_includes_may_declare_any() -> None:
    assert not table_of(ROBOT).is_open
    assert table_of("variables: {$('a' + 'b'): 1}\nmodel:\n").is_open
    assert table_of("model:\n- include: $(name).yaml\n").is_open
    assert not table_of("model:\n- include: $(find robots)/arm.yaml\n").is_open
