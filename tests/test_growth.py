"""Ten times the work is at most ten times the calls, and what is done once stays done once.

bench/ measures the same in seconds. Calls are counted here, since they are the same on each run.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

import yamaro
from tests.counting import calls_of, lines_of
from yamaro.rendering import render_all
from yamaro.source import Source
from yamaro.syntax.argument_section import arguments_of
from yamaro.syntax.keys import find_outside
from yamaro.xml import reader as xmlreader
from yamaro.xml.tree import Element

SMALL, LARGE = 20, 200


LOOSE = ("duplicate-link", "several-roots")
"""What is wrong with robots of links alone."""


def loop(count: int, body: str) -> str:
    """Return a model that runs a body so many times."""
    indented = "".join(f"      {line}\n" for line in body.splitlines())
    return (
        "model:\n  link/name=base:\n"
        f"  for:\n    iterator: i\n    range: {count}\n    body:\n{indented}"
    )


PART = """\
part:
  name: p$(i)
  joint: {type: revolute, parent: base, axis: 0 0 1, limit: {effort: 1, velocity: 1}}
  link: {geometry: box, scale: 1 1 $(i + 1), mass: 1, visual, collision}
"""
MIRROR = """\
mirror:
  rename: {left: right}
  of: base
  body:
    part:
      name: left_p$(i)
      joint: {type: fixed, parent: base, xyz: 0 0.1 $(i)}
      link: {geometry: box, scale: 1 1 1, mass: 1}
"""
INCLUDE = "include:\n  path: small.yaml\n  index: $(i)\n"
INCLUDED = """\
variables: {height: 0.1}
model:
  part:
    name: s$(index)
    joint: {type: fixed, parent: base, xyz: 0 0 $(height)}
"""
RECURSION = """\
functions:
  Next:
    input: left
    body:
      link/name=l$(left):
      if:
        condition: left > 1
        body:
          Next: $(left - 1)
"""
FLAT = "  link/name=l{i}:\n    visual:\n      geometry:\n        box/size=1 1 {i}:\n"


def variables(count: int, scope: str) -> str:
    """Return declarations of so many variables, and two functions in which some are read."""
    declared = "".join(f"  v{i}/{scope}: {i}\n" for i in range(count))
    inner = "  Inner: {body: {'link/name=l$(v1), size=$(sqrt(v2))': }}\n"
    return f"variables:\n{declared}functions:\n  Outer: {{body: {{Inner: }}}}\n{inner}"


MANY_URDF: dict[str, Callable[[int], str]] = {
    "attributes": lambda n: (
        "<robot name='r'><link name='a' " + " ".join(f"a{i}='1'" for i in range(n)) + "/></robot>"
    ),
    "empty attributes": lambda n: (
        "<robot name='r'><link name='a' " + " ".join(f"a{i}=''" for i in range(n)) + "/></robot>"
    ),
    "character references after a letter that is not ASCII": lambda n: (
        "<robot name='é'><link name='a'/>" + "<g>&#38;</g>" * n + "</robot>"
    ),
    "CDATA sections": lambda n: (
        "<robot name='é'><link name='a'/><g>" + "<![CDATA[é]]>&amp;" * n + "</g></robot>"
    ),
    "comments between texts": lambda n: (
        "<robot name='é'><link name='a'/><g>" + "é<!--é-->" * n + "</g></robot>"
    ),
    "prefixes": lambda n: (
        "<robot name='r'><link name='a'/>"
        + "".join(f"<a xmlns:a{i}='u'>" for i in range(n))
        + "</a>" * n
        + "</robot>"
    ),
    "doubled links": lambda n: "<robot name='r'>" + "<link name='a'/>" * n + "</robot>",
}
EXPRESSIONS = "expressions in a scalar: "
CASES: dict[str, Callable[[int], str]] = {
    EXPRESSIONS + "folded": lambda n: "out: >\n" + "  a $(1) é\n" * n,
    EXPRESSIONS + "literal": lambda n: "out: |\n" + "  a $(1) é\n" * n,
    EXPRESSIONS + "plain over lines": lambda n: "out: a\n" + "  a $(1) é\n" * n,
    EXPRESSIONS + "with escapes": lambda n: 'out: "' + r"\x41$(1)" * n + '"\n',
    EXPRESSIONS + "with doubled quotes": lambda n: "out: '" + "''$(1)" * n + "'\n",
    "repeated keys": lambda n: "out:\n" + "  a: 1\n" * n,
    "attributes in a key": lambda n: (
        "robot: r\nmodel:\n  ? link/name=a, " + ", ".join(f"b{i}=1" for i in range(n)) + "\n  :\n"
    ),
    "anchors": lambda n: "out:\n" + "".join(f"  a: &x{i} 1\n" for i in range(n)),
    "prints": lambda n: "out:\n" + "  print: a\n" * n,
    "warnings": lambda n: "out:\n" + "  a: ${b}\n" * n,
    "parts": lambda n: loop(n, PART),
    "mirrors": lambda n: loop(n, MIRROR),
    "includes": lambda n: loop(n, INCLUDE),
    "recursion": lambda n: f"{RECURSION}model: {{Next: {n}}}\n",
    "flat": lambda n: "model:\n" + "".join(FLAT.format(i=i + 1) for i in range(n)),
    "list": lambda n: (
        f"variables: {{all: $(list(range({n})))}}\nmodel:\n  for:\n"
        "    iterator: i\n    in: all\n    body:\n      link/name=l$(i):\n"
    ),
}
for scope_word in ("local", "global", "parent", "child", "bridge"):
    CASES[f"{scope_word} variables"] = lambda n, scope=scope_word: (  # type: ignore[misc]
        variables(n, scope) + loop(n, "Outer:")
    )


def calls_to_convert(text: str, folder: Path) -> int:
    """Return how many calls it takes to convert a text that may include small.yaml."""
    (folder / "small.yaml").write_text(INCLUDED)
    path = folder / "main.yaml"
    path.write_text(text)
    return calls_of(
        lambda: yamaro.build(os.fspath(path), allow=LOOSE, on_message=lambda line: None)
    )


@pytest.mark.parametrize("case", CASES)
def test_the_work_grows_with_the_size_and_no_faster(case: str, tmp_path: Path) -> None:
    source = CASES[case]
    calls_to_convert(source(3), tmp_path)  # imports what is needed
    small, large = (calls_to_convert(source(size), tmp_path) for size in (SMALL, LARGE))
    assert large <= LARGE / SMALL * small


@pytest.mark.parametrize("case", MANY_URDF)
def test_reading_and_checking_a_urdf_grows_with_its_size_and_no_faster(
    case: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    looked_through = 0

    def count(data: bytes) -> int:
        nonlocal looked_through
        looked_through += len(data)
        return count_characters(data)

    count_characters = xmlreader._count
    monkeypatch.setattr(xmlreader, "_count", count)

    def work(size: int) -> tuple[int, int]:
        nonlocal looked_through
        looked_through = 0
        path = tmp_path / "robot.urdf"
        path.write_text(MANY_URDF[case](size), encoding="utf-8")

        def run() -> None:
            render_all(yamaro.build(os.fspath(path), advice=True).warnings)

        return calls_of(run), looked_through

    work(3)
    (small, few_bytes), (large, many_bytes) = work(SMALL), work(LARGE)
    assert large <= LARGE / SMALL * small
    # Each look-up goes through one block, whatever the size of the file.
    assert many_bytes <= LARGE / SMALL * max(few_bytes, SMALL * xmlreader.BLOCK * 4)


@pytest.mark.parametrize("outer", ["link", "visual", "geometry"])
def test_what_stands_beside_unknown_elements_is_looked_through_once(
    outer: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    looked_at = 0

    def elements(element: Element) -> list[Element]:
        nonlocal looked_at
        looked_at += len(element.children)
        return elements_of(element)

    elements_of = Element.elements
    monkeypatch.setattr(Element, "elements", elements)
    inner = "".join(f"<x{i}/>" for i in range(200))
    around = {"link": "{}", "visual": "<visual>{}</visual>"}.get(
        outer, "<visual><geometry>{}</geometry></visual>"
    )
    path = tmp_path / "robot.urdf"
    path.write_text(f"<robot name='r'><link name='a'>{around.format(inner)}</link></robot>")
    assert len(yamaro.build(os.fspath(path)).warnings) >= 200
    assert looked_at < 10 * 200


@pytest.mark.parametrize("line_break", ["\n", "\r", "\r\n", "\n\r"])
def test_lines_are_found_in_one_pass(line_break: str) -> None:
    class Watched(str):
        """Counts the characters that are looked through."""

        looked_through = 0

        def find(self, piece: str, start: int = 0, end: int | None = None) -> int:  # type: ignore[override]
            end = len(self) if end is None else end
            found = super().find(piece, start, end)
            Watched.looked_through += (end if found < 0 else found) - start
            return found

        def replace(self, old: str, new: str) -> Watched:  # type: ignore[override]
            return Watched(super().replace(old, new))

    text = Watched(line_break * 5000)
    starts = Source(text, name="r").line_starts()
    if line_break == "\n\r":  # each pair but the first and last is "\r\n"
        assert starts == [0, 1, *range(3, 10_000, 2), 10_000]
    else:
        assert starts == list(range(0, len(text) + 1, len(line_break)))
    assert Watched.looked_through <= 2 * len(text)


@pytest.mark.parametrize(
    "attribute", ["a='1', ", "a=$(f(1, 2)), ", "a='$(1)' , ", "a=1, ", "a$(1)=$(2)$(3), "]
)
def test_the_ends_of_attributes_are_found_in_one_pass(attribute: str) -> None:
    class Watched(str):
        """Counts the characters that are looked through."""

        looked_through = 0

        def find(self, piece: str, start: int = 0, end: int | None = None) -> int:  # type: ignore[override]
            end = len(self) if end is None else end
            found = super().find(piece, start, end)
            Watched.looked_through += max((end if found < 0 else found) - start, 0)
            return found

    count = 300
    text = Watched(attribute * count)
    at = found = 0
    while (at := find_outside(text, ",", at, len(text)) + 1) > 0:
        found += 1
        equals = find_outside(text, "=", at, len(text))
        assert equals < 0 or text[equals] == "="
    assert found == count
    assert Watched.looked_through < 20 * len(text)


def test_variables_that_are_not_read_cost_their_declaration_only(tmp_path: Path) -> None:
    def work(turns: int, count: int) -> int:
        return calls_to_convert(variables(count, "local") + loop(turns, "Outer:"), tmp_path)

    work(1, 3)
    in_few = work(100, 10) - work(50, 10)
    assert work(100, 500) - work(50, 500) == in_few


def test_including_a_file_again_costs_less_than_the_first_time(tmp_path: Path) -> None:
    calls_to_convert(loop(1, INCLUDE), tmp_path)
    none, one, many = (calls_to_convert(loop(n, INCLUDE), tmp_path) for n in (0, 1, 101))
    assert (many - one) / 100 < (one - none) / 2


def test_a_mesh_is_integrated_once_for_all_parts(tmp_path: Path) -> None:
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    faces = "1 2 4 3/5 7 8 6/1 5 6 2/3 4 8 7/1 3 7 5/2 6 8 4"
    (tmp_path / "cube.obj").write_text(
        "".join(f"v {x} {y} {z}\n" for x, y, z in corners)
        + "".join(f"f {face}\n" for face in faces.split("/"))
    )
    part = PART.replace("geometry: box", f"geometry: {tmp_path}/cube.obj")
    calls_to_convert(loop(1, part), tmp_path)
    box, mesh = (calls_to_convert(loop(1, text), tmp_path) for text in (PART, part))
    more_box, more_mesh = (calls_to_convert(loop(51, text), tmp_path) for text in (PART, part))
    first = mesh - box
    later = (more_mesh - mesh - (more_box - box)) / 50
    assert later < first / 2


def calls_a_turn(body: str, folder: Path) -> float:
    """Return how many calls one more turn of a loop costs, once the first turns are over."""
    calls_to_convert(loop(2, body), folder)
    few, many = (calls_to_convert(loop(n, body), folder) for n in (20, 120))
    return (many - few) / 100


def test_elements_that_do_not_change_between_turns_cost_little(tmp_path: Path) -> None:
    body = "visual:\n  origin/xyz=0 0 {z}:\n  geometry:\n    box/size=1 1 {z}:\n"
    as_written, of_few, always_new = (
        calls_a_turn(body.format(z=z), tmp_path) for z in ("1", "$(i % 3)", "$(i)")
    )
    assert as_written < of_few < always_new
    assert as_written < always_new / 3


def test_a_call_costs_less_than_an_include(tmp_path: Path) -> None:
    function = "functions:\n  Frame:\n    input: index\n    body:\n      "
    body = INCLUDED.partition("model:\n  ")[2].replace("\n", "\n    ").replace("$(height)", "0.1")
    (tmp_path / "functions.yaml").write_text(function + body)

    def calls(turns: int) -> int:
        text = function + body.rstrip() + "\n" + loop(turns, "Frame: $(i)")
        return calls_to_convert(text, tmp_path)

    calls(2)
    assert (calls(120) - calls(20)) / 100 < calls_a_turn(INCLUDE, tmp_path)


def test_load_yaml_reads_its_file_at_each_call() -> None:
    read: list[str] = []

    class Loader(yamaro.MemoryLoader):
        def read(self, path: str) -> bytes:
            read.append(path)
            return super().read(path)

    text = loop(3, "link/name=l$(i)_$(load_yaml('data.yaml')['a']):\ninclude: other.yaml")
    files = {"/main.yaml": text, "/data.yaml": "a: 1", "/other.yaml": "model:\n"}
    yamaro.build("/main.yaml", loader=Loader(files), allow=LOOSE)
    assert (read.count("/data.yaml"), read.count("/other.yaml")) == (3, 1)


@pytest.mark.parametrize("section", ["arguments:\n{}", "{}"], ids=["one section", "many sections"])
def test_arguments_are_declared_in_linear_time(section: str) -> None:
    def lines(count: int) -> int:
        entries = "".join(
            ("  " if "arguments" in section else "arguments:\n  ") + f"a{i}: {i}\n"
            for i in range(count)
        )
        source = Source(section.format(entries) + "model:\n", name="")
        found = arguments_of(source)
        assert found is not None and len(found) == count
        return lines_of(lambda: arguments_of(source))

    assert lines(LARGE) < 12 * lines(SMALL)
