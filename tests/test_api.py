"""The package as Python programs use it: convert, build, loaders, FlexiDict."""

from __future__ import annotations

import importlib
import inspect
import os
import re
import sys
import warnings
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lxml import etree

import yamaro
from yamaro.commands.command_table import command_named
from yamaro.sandbox import jail

needs_jail = pytest.mark.skipif(jail.check_available() is not None, reason="no jail here")

PENDULUM = """\
robot: $(name)
import: [shapes, from math import hypot]
variables:
  name: pendulum
  length: 0.5
  count: 3
functions:
  Rod:
    input: index, parent
    body:
      part:
        name: rod_$(index)
        joint: {type: continuous, parent: $(parent), axis: 0 1 0}
        link:
          geometry: cylinder
          scale: $(shapes.rod(length))
          density: 2700
          pivot: 0 0 $(length / 2)
          collision:
model:
- part: {name: base}
- for:
    iterator: i
    range: count
    body:
      Rod: {index: $(i), parent: "$('base' if i == 0 else f'rod_{i - 1}')"}
"""
SHAPES = "def rod(length):\n    return [length / 50, length]\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "pendulum.yaml").write_text(PENDULUM)
    (tmp_path / "shapes.py").write_text(SHAPES)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def write(folder: Path, text: str, name: str = "robot.yaml") -> str:
    (folder / name).write_text(text, encoding="utf-8")
    return name


def first_texts(xml: str) -> list[str | None]:
    """Return the texts of the elements directly under the root."""
    return [child.text for child in etree.fromstring(xml.encode())]


# --- what goes in and comes out ---------------------------------------------------------------


def test_convert_returns_the_xml(folder: Path) -> None:
    root = etree.fromstring(yamaro.convert("pendulum.yaml").encode())
    assert (root.tag, root.get("name")) == ("robot", "pendulum")
    assert [link.get("name") for link in root.iter("link")] == [
        "base_link",
        "rod_0_link",
        "rod_1_link",
        "rod_2_link",
    ]


def test_convert_takes_path_objects(folder: Path) -> None:
    assert yamaro.convert(folder / "pendulum.yaml") == yamaro.convert("pendulum.yaml")


def test_assignments_are_read_as_yaml(folder: Path) -> None:
    file = write(folder, "launch:\n  for: {iterator: x, in: items, body: {a: $(x)}}\n")
    assert first_texts(yamaro.convert(file, "items:=[a, 1.50, true]")) == ["a", "1.5", "true"]


def test_variables_are_python_objects(folder: Path) -> None:
    file = write(folder, "launch:\n  a: $(points[0])\n  b: $(scale(2))\n  c: $(mapping['k'])\n")
    xml = yamaro.convert(
        file, points=np.array([[0.5, 1.0]]), scale=lambda x: 3 * x, mapping={"k": "v"}
    )
    assert first_texts(xml) == ["0.5 1.0", "6", "v"]


def test_a_variable_may_be_called_path(folder: Path) -> None:
    assert first_texts(yamaro.convert(write(folder, "launch: {a: $(path)}\n"), path="p")) == ["p"]


def test_a_python_object_wins_over_an_assignment(folder: Path) -> None:
    file = write(folder, "launch: {a: $(n)}\n")
    assert first_texts(yamaro.convert(file, "n:=1", n=2)) == ["2"]


@pytest.mark.parametrize("assignment", ["length", "length=2", ":=2", "2nd:=2", "a:=[1"])
def test_a_malformed_assignment_is_a_value_error(folder: Path, assignment: str) -> None:
    with pytest.raises(ValueError, match=r"length|:=2|2nd|a:=\[1"):
        yamaro.convert("pendulum.yaml", assignment)


def test_a_missing_main_file_is_a_file_not_found_error(folder: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"nowhere\.yaml"):
        yamaro.convert("nowhere.yaml")


# --- errors, warnings, prints -----------------------------------------------------------------


def test_errors_carry_diagnostics(folder: Path) -> None:
    file = write(folder, "launch:\n  a: $(lenght)\n")
    with pytest.raises(yamaro.YamaroError) as caught:
        yamaro.convert(file, length=1)
    (diagnostic,) = caught.value.diagnostics
    assert isinstance(diagnostic, yamaro.Diagnostic)
    assert (diagnostic.code, diagnostic.severity) == ("undefined-name", "error")
    assert diagnostic.span.location() == (2, 8)
    assert diagnostic.span.written() == "lenght"
    assert diagnostic.span.source.path == str(folder / "robot.yaml")
    assert diagnostic.hint is not None
    assert "'length'" in diagnostic.hint
    assert str(caught.value).startswith("error[undefined-name]: ")


def test_all_faults_of_grammar_come_together(folder: Path) -> None:
    file = write(folder, "launch:\n  a: $(1 +)\n  b/c: 1\n  else: {d: 1}\n")
    with pytest.raises(yamaro.YamaroError) as caught:
        yamaro.convert(file)
    assert [d.span.location()[0] for d in caught.value.diagnostics] == [2, 3, 4]


def test_the_trace_leads_to_the_call(folder: Path) -> None:
    file = write(folder, "functions:\n  F: {body: {a: $(1 / 0)}}\nlaunch:\n  F:\n")
    with pytest.raises(yamaro.YamaroError) as caught:
        yamaro.convert(file)
    trace = caught.value.diagnostics[0].trace
    assert trace is not None
    assert (trace.kind, trace.name, trace.span.location()) == ("called", "F", (4, 3))


def test_warnings_are_issued_and_point_at_the_caller(folder: Path) -> None:
    file = write(folder, "launch:\n  a: ${x}\n")
    with pytest.warns(yamaro.YamaroWarning, match="xacro-syntax") as caught:
        yamaro.convert(file)
    assert [warning.filename for warning in caught] == [__file__]


def test_no_warning_is_issued_for_a_sound_file(folder: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yamaro.convert("pendulum.yaml")


def test_prints_go_to_standard_error(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = write(folder, "print: one\nprocess: print('two', 3)\nlaunch:\n")
    yamaro.convert(file)
    assert capsys.readouterr() == ("", "one\ntwo 3\n")


def test_build_hands_messages_over(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = write(folder, "print: one\nprocess: print('two', 3)\nlaunch:\n")
    messages: list[str] = []
    yamaro.build(file, on_message=messages.append)
    assert messages == ["one", "two 3"]
    assert capsys.readouterr() == ("", "")


@pytest.mark.parametrize(
    "text",
    [
        "launch: {a: $(stop())}\n",
        "launch:\n  a: $([stop() for i in range(3)])\n",
        "process: stop()\nlaunch:\n",
        "process: |\n  def f():\n    stop()\nlaunch: {if: {condition: f()}}\n",
        "functions: {F: {input: x=$(stop()), body: {a: 1}}}\nlaunch: {F: }\n",
    ],
)
def test_a_keyboard_interrupt_passes_through(folder: Path, text: str) -> None:
    def stop() -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        yamaro.convert(write(folder, text), stop=stop)


@pytest.mark.parametrize(
    ("exception", "code"),
    [
        (SystemExit, "python-error"),
        (GeneratorExit, "python-error"),
        (AssertionError, "python-error"),
        (MemoryError, "limit-memory"),
    ],
)
def test_other_exceptions_are_errors_of_the_file(
    folder: Path, exception: type[BaseException], code: str
) -> None:
    def stop() -> None:
        raise exception

    with pytest.raises(yamaro.YamaroError) as caught:
        yamaro.convert(write(folder, "launch: {a: $(stop())}\n"), stop=stop)
    assert [d.code for d in caught.value.diagnostics] == [code]


# --- no state between calls -------------------------------------------------------------------


def state() -> dict[str, object]:
    return {
        "modules": set(sys.modules),
        "path": list(sys.path),
        "path hooks": list(sys.path_hooks),
        "meta path": list(sys.meta_path),
        "importer cache": set(sys.path_importer_cache),
        "working directory": os.getcwd(),
        "environment": dict(os.environ),
        "recursion limit": sys.getrecursionlimit(),
        "filters": list(warnings.filters),
        "standard streams": (sys.stdin, sys.stdout, sys.stderr),
        "display hook": (sys.displayhook, sys.excepthook),
    }


@pytest.mark.parametrize("fails", [False, True])
def test_convert_leaves_python_as_it_was(folder: Path, fails: bool) -> None:
    if fails:
        (folder / "shapes.py").write_text(SHAPES + "raise ValueError('broken')\n")

    def convert() -> None:
        if fails:
            with pytest.raises(yamaro.YamaroError):
                yamaro.convert("pendulum.yaml")
        else:
            yamaro.convert("pendulum.yaml")

    convert()  # what Yamaro itself imports lazily is loaded now
    before = state()
    convert()
    after = state()
    assert {key for key in before if before[key] != after[key]} == set()
    assert "shapes" not in sys.modules


def test_modules_beside_a_file_are_read_anew(folder: Path) -> None:
    file = write(folder, "import: shapes\nlaunch: {a: '$(shapes.rod(100)[0])'}\n")
    before = yamaro.convert(file)
    (folder / "shapes.py").write_text("def rod(length):\n    return [length * 7]\n")
    assert (first_texts(before), first_texts(yamaro.convert(file))) == (["2.0"], ["700"])


def test_modules_beside_two_files_do_not_meet(folder: Path) -> None:
    text = "import: names\nlaunch: {a: $(names.own)}\n"
    for name in ("one", "two"):
        (folder / name).mkdir()
        (folder / name / "names.py").write_text(f"own = '{name}'\n")
        (folder / name / "robot.yaml").write_text(text)
    assert [
        first_texts(yamaro.convert(f"{name}/robot.yaml")) for name in ("one", "two", "one")
    ] == [["one"], ["two"], ["one"]]


def test_convert_can_be_called_while_it_runs(folder: Path) -> None:
    inner = write(folder, "launch: {b: $(n + 1)}\n", "inner.yaml")
    outer = write(
        folder,
        "process: text = convert('inner.yaml', n=n)\nlaunch: {a: $(n), b: $(text.count('6'))}\n",
    )
    xml = yamaro.convert(outer, n=5, convert=yamaro.convert)
    assert first_texts(xml) == ["5", "1"]
    assert first_texts(yamaro.convert(inner, n=5)) == ["6"]


def test_globals_do_not_outlive_a_conversion(folder: Path) -> None:
    yamaro.convert(write(folder, "variables: {n/global: 1, m/bridge: 2}\nlaunch:\n"))
    for name in ("n", "m"):
        with pytest.raises(yamaro.YamaroError):
            yamaro.convert(write(folder, f"launch: {{a: $({name})}}\n"))


def test_threads_give_the_same_bytes_as_one(folder: Path) -> None:
    jobs = [
        (f"length:={0.1 + index % 20 / 10:.1f}", f"count:={index % 7}", f"name:=p{index}")
        for index in range(200)
    ]
    before = set(sys.modules)  # other tests of this process may have left some
    in_sequence = [yamaro.convert("pendulum.yaml", *job) for job in jobs]
    assert len(set(in_sequence)) == len(jobs)
    limit = sys.getrecursionlimit()
    with ThreadPoolExecutor(8) as pool:
        in_parallel = list(pool.map(lambda job: yamaro.convert("pendulum.yaml", *job), jobs))
    assert in_parallel == in_sequence
    assert sys.getrecursionlimit() == limit
    new = set(sys.modules) - before
    assert {name for name in new if name == "shapes" or name.startswith("_yamaro")} == set()


def test_threads_keep_their_messages_apart(folder: Path) -> None:
    file = write(folder, "for: {iterator: i, range: 20, body: {print: $(own) $(i)}}\nlaunch:\n")

    def messages_of(own: int) -> list[str]:
        messages: list[str] = []
        yamaro.build(file, variables={"own": own}, on_message=messages.append)
        return messages

    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(messages_of, range(40)))
    assert found == [[f"{own} {i}" for i in range(20)] for own in range(40)]


def test_the_output_does_not_depend_on_the_working_directory(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    here = yamaro.convert("pendulum.yaml")
    elsewhere = folder / "elsewhere"
    elsewhere.mkdir()
    (elsewhere / "shapes.py").write_text("raise AssertionError('the wrong module')\n")
    monkeypatch.chdir(elsewhere)
    assert yamaro.convert("../pendulum.yaml") == here
    assert yamaro.convert(folder / "pendulum.yaml") == here


# --- build and its loaders --------------------------------------------------------------------


def test_build_tells_what_it_read_in_order(folder: Path) -> None:
    write(folder, "launch: {a: 1}\n", "b.yaml")
    write(folder, "launch: {b: 1}\n", "a.yaml")
    write(folder, "[1, 2]", "data.yaml")
    file = write(
        folder,
        "import: shapes\nlaunch:\n- include: b.yaml\n- include: a.yaml\n- include: b.yaml\n"
        "- c: $(load_yaml('data.yaml'))\n",
    )
    names = [os.path.relpath(path, folder) for path in yamaro.build(file).files]
    assert names == ["robot.yaml", "shapes.py", "b.yaml", "a.yaml", "data.yaml"]


def test_build_traces_elements_to_their_lines(folder: Path) -> None:
    root = yamaro.build("pendulum.yaml").root
    rod = next(e for e in root.elements() if e.attributes.get("name") == "rod_1_link")
    collision = rod.elements()[-1]
    assert collision.name == "collision"
    line = PENDULUM.splitlines().index("          collision:") + 1
    assert collision.span.place() == f"pendulum.yaml:{line}:11"
    assert collision.trace is not None
    assert collision.trace.name == "Rod"


def test_build_compiles_a_text_in_place_of_a_file(folder: Path) -> None:
    write(folder, "launch: {b: 1}\n", "part.yaml")
    result = yamaro.build("unsaved.yaml", text="launch: {include: part.yaml}\n")
    assert [element.name for element in result.root.elements()] == ["b"]
    built = yamaro.build("-", text="robot:\n", allow="no-link")
    assert built.root.attributes == {"name": "robot"}


def test_strict_raises_warnings(folder: Path) -> None:
    file = write(folder, "launch:\n  a: ${x}\n")
    assert [d.code for d in yamaro.build(file).warnings] == ["xacro-syntax"]
    with pytest.raises(yamaro.YamaroError) as caught:
        yamaro.build(file, strict=True)
    assert [(d.code, d.severity) for d in caught.value.diagnostics] == [("xacro-syntax", "error")]


def test_build_says_why_it_cannot_begin(folder: Path) -> None:
    with pytest.raises(yamaro.UsageError, match=r"nowhere\.yaml"):
        yamaro.build("nowhere.yaml")
    with pytest.raises(yamaro.UsageError, match="length"):
        yamaro.build("pendulum.yaml", command_line=["length"])


def test_a_memory_loader_gives_files_and_suggestions(tmp_path: Path) -> None:
    main, part = str(tmp_path / "robot.yaml"), str(tmp_path / "parts" / "leg.yaml")
    loader = yamaro.MemoryLoader(
        {
            main: "launch: {include: $(file)}\n",
            part: "launch:\n  a: $(load_yaml('data.yaml')['n'])\n",
            str(tmp_path / "parts" / "data.yaml"): "n: 4\n",
        }
    )
    result = yamaro.build(main, variables={"file": "parts/leg.yaml"}, loader=loader)
    assert result.root.elements()[0].text() == "4"
    assert result.files[:2] == [main, part]
    with pytest.raises(yamaro.YamaroError) as caught:
        yamaro.build(main, variables={"file": "parts/lge.yaml"}, loader=loader)
    assert caught.value.diagnostics[0].code == "missing-file"
    assert "leg.yaml" in (caught.value.diagnostics[0].hint or "")


def test_a_loader_of_ones_own_says_why_it_fails(tmp_path: Path) -> None:
    class Refusing:
        def read(self, path: str) -> bytes:
            if path.endswith("robot.yaml"):
                return b"launch: {include: secret.yaml}\n"
            raise yamaro.LoadError("it is secret")

        def neighbours(self, path: str) -> list[str]:
            return []

    with pytest.raises(yamaro.YamaroError, match="it is secret"):
        yamaro.build(str(tmp_path / "robot.yaml"), loader=Refusing())


# --- policies ---------------------------------------------------------------------------------


@needs_jail
def test_a_build_without_its_tree_says_how_to_have_it(tmp_path: Path) -> None:
    path = tmp_path / "robot.yaml"
    path.write_text("robot: r\nmodel:\n- link/name=base:\n")
    built = yamaro.build(path, policy=yamaro.Policy("jail"), has_root=False)
    assert '<link name="base"/>' in built.xml()
    for name in ("root", "robot", "root_name"):
        with pytest.raises(ValueError, match="has_root=True"):
            getattr(built, name)


MODES = ["trusted", "safe", pytest.param("jail", marks=needs_jail)]


@pytest.mark.parametrize("mode", MODES)
def test_a_program_converts_under_its_policy(folder: Path, mode: str) -> None:
    (folder / "shapes.py").unlink()
    text = PENDULUM.replace("shapes, ", "").replace("shapes.rod(length)", "[length / 50, length]")
    program = yamaro.load(write(folder, text), policy=yamaro.Policy(mode))
    for length in (0.5, 2):
        expected = yamaro.convert("robot.yaml", length=length)
        assert program.convert(length=length) == expected
        assert program.build(variables={"length": length}).xml() == expected


@pytest.mark.parametrize("mode", MODES)
def test_what_goes_in_is_taken_under_every_policy(folder: Path, mode: str) -> None:
    program = yamaro.load(
        write(folder, "launch:\n  a: $(n)\n  b: $(x[0])\n  c: $(d['k'])\n"),
        policy=yamaro.Policy(mode),
    )
    xml = program.convert("n:=[1, 2]", x=np.array([0.5]), d={"k": (3, None)})
    assert xml == yamaro.convert("robot.yaml", "n:=[1, 2]", x=np.array([0.5]), d={"k": (3, None)})


def test_functions_that_are_passed_in_are_not_safe(folder: Path) -> None:
    file = write(folder, "launch: {a: $(f(2))}\n")
    program = yamaro.load(file, policy=yamaro.Policy("safe"))
    called: list[int] = []
    with pytest.raises(yamaro.YamaroError) as caught:
        program.convert(f=called.append)
    assert [d.code for d in caught.value.diagnostics] == ["unsafe-code"]
    assert called == []


def test_names_of_limits_may_be_those_of_the_command(folder: Path) -> None:
    for name in ("xml_depth", "xml-depth"):
        assert yamaro.Policy(limits={name: 7}).limits.xml_depth == 7


@pytest.mark.parametrize("mode", MODES)
def test_build_hands_over_what_a_file_that_fails_has_printed(folder: Path, mode: str) -> None:
    file = write(folder, "print: before\nlaunch: {a: $(missing)}\nprint: after\n")
    messages: list[str] = []
    with pytest.raises(yamaro.YamaroError) as caught:
        yamaro.build(file, policy=yamaro.Policy(mode), on_message=messages.append)
    assert [d.code for d in caught.value.diagnostics] == ["undefined-name"]
    assert "before" in messages


# --- FlexiDict --------------------------------------------------------------------------------


def test_a_flexidict_is_an_ordered_multi_map() -> None:
    pairs = [("leg", 1), ("arm", 2), ("leg", 3)]
    d = yamaro.FlexiDict(pairs)
    assert list(d) == pairs
    assert len(d) == 3
    assert d["leg"] == [1, 3]
    assert d["arm"] == [2]
    assert (d[0], d[-1]) == (("leg", 1), ("leg", 3))
    assert d.keys() == ["leg", "arm"]
    assert ("leg" in d, "tail" in d) == (True, False)


def test_a_flexidict_grows_at_its_end() -> None:
    d = yamaro.FlexiDict()
    assert (len(d), list(d), d.keys()) == (0, [], [])
    for value in (1, 1, 2):
        d.add("k", value)
    assert list(d) == [("k", 1), ("k", 1), ("k", 2)]
    assert d["k"] == [1, 1, 2]


def test_a_flexidict_refuses_what_is_not_there() -> None:
    d = yamaro.FlexiDict([("leg", 1)])
    with pytest.raises(KeyError, match="tail"):
        d["tail"]
    with pytest.raises(IndexError):
        d[1]


def test_flexidicts_are_equal_when_pairs_and_order_are() -> None:
    d = yamaro.FlexiDict([("a", 1), ("b", 2)])
    assert d == yamaro.FlexiDict([("a", 1), ("b", 2)])
    assert d != yamaro.FlexiDict([("b", 2), ("a", 1)])
    assert d != {"a": 1, "b": 2}
    with pytest.raises(TypeError):
        hash(d)


def test_a_flexidict_does_not_share_the_list_it_was_made_of() -> None:
    pairs = [("a", 1)]
    d = yamaro.FlexiDict(pairs)
    d.add("b", 2)
    assert pairs == [("a", 1)]


def test_a_for_runs_over_the_pairs_of_a_flexidict(folder: Path) -> None:
    file = write(folder, "launch:\n  for: {iterator: [k, v], in: d, body: {$(k): $(v)}}\n")
    xml = yamaro.convert(file, d=yamaro.FlexiDict([("b", 1), ("a", 2), ("b", 3)]))
    root = etree.fromstring(xml.encode())
    assert [(child.tag, child.text) for child in root] == [("b", "1"), ("a", "2"), ("b", "3")]


# --- the package ------------------------------------------------------------------------------


OFFERED = [name for name in yamaro.__all__ if "sweep" not in name.lower() or command_named("sweep")]
"""The public names, without those of a tool that is not there."""


def test_every_public_name_is_there_and_described() -> None:
    page = (Path(__file__).parents[1] / "docs" / "api.md").read_text(encoding="utf-8")
    for name in OFFERED:
        assert getattr(yamaro, name).__doc__
        assert f"`{name}`" in page or f"`yamaro.{name}`" in page


# --- how variables are passed -----------------------------------------------------------------


@pytest.mark.parametrize("method", ["build", "program"])
def test_build_says_how_variables_are_passed(folder: Path, method: str) -> None:
    file = write(folder, "variables: {upper: 0.1}\nlaunch/upper=$(upper):\n")
    build = partial(yamaro.build, file) if method == "build" else yamaro.load(file).build
    wrong: Any = build
    with pytest.raises(TypeError, match=re.escape("passed by variables={'upper': 0.3}")):
        wrong(upper=0.3)
    with pytest.raises(TypeError, match=re.escape("passed by variables={'upper': 0.3}")):
        wrong("upper:=0.3")
    with pytest.raises(TypeError, match=re.escape("passed by variables={'name': …}")):
        wrong({"upper": 0.3})
    assert 'upper="0.3"' in build(variables={"upper": 0.3}).xml()


def test_a_misspelt_argument_of_build_is_suggested(folder: Path) -> None:
    wrong: Any = yamaro.build
    with pytest.raises(TypeError, match="no argument 'stict'; did you mean 'strict'"):
        wrong(write(folder, "launch:\n"), stict=True)


def test_load_says_which_function_takes_variables(folder: Path) -> None:
    wrong: Any = yamaro.load
    for call in (lambda: wrong("a.yaml", upper=1), lambda: wrong("a.yaml", "upper:=1")):
        with pytest.raises(TypeError, match=re.escape("passed by load(path).convert(upper=1)")):
            call()


def test_convert_takes_variables_as_build_does(folder: Path) -> None:
    file = write(
        folder, "variables: {a: 0, b: 0, variables: 0}\nlaunch/v=$(a) $(b) $(variables):\n"
    )
    given: dict[str, object] = {"a": 1, "b": 1, "variables": 3}
    assert 'v="1 2 3"' in yamaro.convert(file, variables=given, b=2)
    assert 'v="1 2 3"' in yamaro.load(file).convert("a:=0", variables=given, b=2)
    wrong: Any = yamaro.convert
    with pytest.raises(TypeError, match="variables= takes a dict"):
        wrong(file, variables=3)


def test_the_arguments_of_build_are_seen_by_editors() -> None:
    for function in (yamaro.build, yamaro.load, yamaro.Program.build):
        names = list(inspect.signature(function).parameters)
        assert names[0] in ("path", "self")
        assert "positional" not in names and "named" not in names


# --- the names of the package -----------------------------------------------------------------


def test_dir_of_the_package_lists_the_public_names_only() -> None:
    for module in (yamaro, importlib.import_module("yamaro.model")):
        shown = [name for name in dir(module) if not name.startswith("__")]
        assert shown == sorted(module.__all__)


def test_every_public_name_is_there_and_listed() -> None:
    for name in OFFERED:
        assert getattr(yamaro, name).__name__ == name
        assert name in dir(yamaro)
    everything: dict[str, object] = {}
    exec(f"from yamaro import {', '.join(OFFERED)}", everything)
    assert set(OFFERED) <= set(everything)


def test_a_name_that_is_not_public_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="module 'yamaro' has no attribute 'compile'"):
        yamaro.compile  # type: ignore[attr-defined] # noqa: B018


# --- the severity of messages -----------------------------------------------------------------

TWO_ROOTS = "robot: r\nmodel:\n- link/name=a:\n- link/name=b:\n"
TWO_RED = """
robot: r
model:
- link/name=a:
- material/name=red:
    color/rgba=2 0 0 1:
"""


def codes_of(error: pytest.ExceptionInfo[yamaro.YamaroError]) -> list[tuple[str, str]]:
    return [(each.severity, each.code) for each in error.value.diagnostics]


def test_a_robot_that_parsers_refuse_is_an_error_unless_it_is_allowed(folder: Path) -> None:
    file = write(folder, TWO_ROOTS)
    for build in (yamaro.build, yamaro.convert, lambda path: yamaro.load(path).convert()):
        with pytest.raises(yamaro.YamaroError) as caught:
            build(file)
        assert codes_of(caught) == [("error", "several-roots")]
    built = yamaro.build(file, allow=["several-roots"], strict=True)
    assert [(each.severity, each.code) for each in built.warnings] == [("warning", "several-roots")]
    with pytest.warns(yamaro.YamaroWarning, match="several-roots"):
        assert "<link" in yamaro.convert(file, allow=["several-roots"])
    with pytest.warns(yamaro.YamaroWarning, match="several-roots"):
        assert "<link" in yamaro.load(file, allow=["several-roots"]).convert()


@pytest.mark.parametrize("mode", ["safe", "jail"])
def test_codes_are_allowed_and_denied_in_files_that_are_not_trusted(
    folder: Path, mode: str
) -> None:
    file, policy = write(folder, TWO_ROOTS), yamaro.Policy(mode)
    with pytest.raises(yamaro.YamaroError) as caught:
        yamaro.build(file, policy=policy)
    assert codes_of(caught) == [("error", "several-roots")]
    built = yamaro.build(file, policy=policy, allow="several-roots")
    assert [each.severity for each in built.warnings] == ["warning"]
    file = write(folder, TWO_RED)
    with pytest.raises(yamaro.YamaroError) as caught:
        yamaro.build(file, policy=policy, deny="bad-color")
    assert codes_of(caught) == [("error", "bad-color")]


def test_warnings_and_advice_can_be_denied(folder: Path) -> None:
    file = write(folder, TWO_RED)
    assert [each.code for each in yamaro.build(file).warnings] == ["bad-color"]
    with pytest.raises(yamaro.YamaroError) as caught:
        yamaro.build(file, deny=["bad-color"])
    assert codes_of(caught) == [("error", "bad-color")]
    heavy = "model:\n- part: {name: a, link: {geometry: sphere, scale: 1, mass: 1e6}}\n"
    file = write(folder, heavy)
    assert yamaro.build(file).warnings == []
    with pytest.raises(yamaro.YamaroError) as caught:
        yamaro.build(file, deny=["odd-mass"])
    assert codes_of(caught) == [("error", "odd-mass")]  # and no other advice


@pytest.mark.parametrize(
    ("codes", "message"),
    [
        ({"allow": ["several-rots"]}, "did you mean 'several-roots'"),
        ({"deny": "yaml-syntax"}, "'yaml-syntax' is not a code that can be allowed or denied"),
        ({"allow": [""]}, "'' is not a code"),
        ({"allow": [1]}, "must be a text, not 1"),
        ({"deny": ["no-link", None]}, "must be a text, not None"),
        ({"allow": ["no-link"], "deny": ["no-link"]}, "both allowed and denied"),
    ],
)
def test_a_code_that_cannot_be_allowed_or_denied_is_wrong_usage(
    folder: Path, codes: dict[str, Any], message: str
) -> None:
    file = write(folder, TWO_ROOTS)
    with pytest.raises(yamaro.UsageError, match=message):
        yamaro.build(file, **codes)
    for call in (yamaro.convert, yamaro.load):
        with pytest.raises(ValueError, match=message):
            call(file, **codes)


def test_an_error_without_a_document_is_not_allowed_away(folder: Path) -> None:
    text = "model:\n- part: {name: a, link: {geometry: box, scale: 1 2, visual}}\n"
    with pytest.raises(yamaro.YamaroError) as caught:
        yamaro.build(write(folder, text), allow=["wrong-count"])
    assert codes_of(caught) == [("error", "wrong-count")]


def test_urdf_that_is_taken_as_it_is_is_only_warned_of(folder: Path) -> None:
    joint = '<joint name="j" type="fixed"><parent link="x"/><child link="a"/></joint>'
    write(folder, f'<robot name="r"><link name="a"/>{joint}</robot>', "r.urdf")
    built = yamaro.build(folder / "r.urdf")
    assert [(each.severity, each.code) for each in built.warnings] == [
        ("warning", "unknown-parent")
    ]
    once = write(folder, "robot: r\nmodel:\n- include: r.urdf\n")
    assert [each.severity for each in yamaro.build(once).warnings] == ["warning"]
    # What a fault of YAML's own is stays one, beside it too.
    twice = write(folder, "robot: r\nmodel:\n- include: r.urdf\n- include: r.urdf\n")
    with pytest.raises(yamaro.YamaroError) as caught:
        yamaro.build(twice)
    assert ("error", "duplicate-link") in codes_of(caught)
    beside = write(folder, "robot: r\nmodel:\n- include: r.urdf\n- link/name=a:\n")
    with pytest.raises(yamaro.YamaroError) as caught:
        yamaro.build(beside)
    assert ("error", "duplicate-link") in codes_of(caught)


def test_two_roots_of_one_urdf_are_warned_of_and_a_root_beside_it_is_an_error(folder: Path) -> None:
    write(folder, '<robot name="r"><link name="a"/><link name="b"/></robot>', "r.urdf")
    file = write(folder, "robot: r\nmodel:\n- include: r.urdf\n")
    assert [each.severity for each in yamaro.build(file).warnings] == ["warning"]
    for beside in ("link/name=c:", "include: {path: r.urdf, prefix: x_}"):
        file = write(folder, f"robot: r\nmodel:\n- include: r.urdf\n- {beside}\n")
        with pytest.raises(yamaro.YamaroError) as caught:
            yamaro.build(file)
        assert codes_of(caught) == [("error", "several-roots")]


def test_a_variable_given_by_keyword_that_nothing_reads_is_reported(tmp_path: Path) -> None:
    path = tmp_path / "r.yaml"
    path.write_text("variables: {length: 1}\nout: {a: $(length)}\n")
    with pytest.warns(yamaro.YamaroWarning, match="unknown-variable") as caught:
        xml = yamaro.convert(path, lenght=2)
    assert "<a>1</a>" in xml
    assert "did you mean 'length'?" in str(caught[0].message)
    assert "<keyword argument>:1:1" in str(caught[0].message)


def test_a_text_given_by_keyword_is_no_condition(tmp_path: Path) -> None:
    path = tmp_path / "r.yaml"
    path.write_text("variables: {on: true}\nout: {if: {condition: on, body: {a: }}}\n")
    assert "<a/>" not in yamaro.convert(path, on=False)
    with pytest.raises(yamaro.YamaroError) as caught:
        yamaro.convert(path, on="no")
    (error,) = caught.value.diagnostics
    assert error.code == "bad-condition"
    assert error.notes == ("the text 'no' comes from 'on', set from Python",)


def test_every_span_of_a_build_has_what_the_manual_says(tmp_path: Path) -> None:
    path = tmp_path / "robot.yaml"
    path.write_text("doc:\n- link/name=$('a'): {note: text}\n- include: b.yaml\n")
    (tmp_path / "b.yaml").write_text("model:\n  joint/name=b: {x: 1}\n")
    pending = [yamaro.build(path).root]
    while pending:
        element = pending.pop()
        for span in (element.span, *map(element.value_span, element.attributes)):
            line, column = span.location()
            file = Path(span.source.path)
            assert span.place() == f"{file}:{line}:{column}"
            assert file.read_text().splitlines()[line - 1][column - 1 :].startswith(span.written())
        pending += element.elements()
