"""Ten times the work is at most ten times the calls, and what is done once stays done once.

bench/ measures the same in seconds. Calls are counted here, since they are the same on each run.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

import yamaro
from tests.counting import calls_of

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


CASES: dict[str, Callable[[int], str]] = {
    "parts": lambda n: loop(n, PART),
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
    return calls_of(lambda: yamaro.build(os.fspath(path), allow=LOOSE))


@pytest.mark.parametrize("case", CASES)
def test_the_work_grows_with_the_size_and_no_faster(case: str, tmp_path: Path) -> None:
    source = CASES[case]
    calls_to_convert(source(3), tmp_path)  # imports what is needed
    small, large = (calls_to_convert(source(size), tmp_path) for size in (SMALL, LARGE))
    assert large <= LARGE / SMALL * small


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
