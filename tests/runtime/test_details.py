"""Details of scopes, blocks, loops and includes: what each means, and what is said of a fault."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from yamaro import Build, Policy, YamaroError, build
from yamaro.diagnostics import Diagnostic
from yamaro.files.loader import MemoryLoader
from yamaro.runtime import files as late


def run(text: str, files: dict[str, str] | None = None, policy: Policy | None = None) -> Build:
    """Compile a text; `files` stand beside it, by their names without the ending."""
    texts = {f"/{name}.yaml": content for name, content in (files or {}).items()}
    return build("/t.yaml", loader=MemoryLoader({"/t.yaml": text, **texts}), policy=policy)


def out(text: str, files: dict[str, str] | None = None) -> str:
    """Return what the root element `out` holds, on one line."""
    lines = run(text, files).xml().splitlines()
    return "".join(line.strip() for line in lines[2:-1])


def fault(
    text: str, files: dict[str, str] | None = None, policy: Policy | None = None
) -> Diagnostic:
    """Return the error in a file."""
    with pytest.raises(YamaroError) as caught:
        run(text, files, policy)
    return next(one for one in caught.value.diagnostics if one.severity == "error")


def place(diagnostic: Diagnostic) -> str:
    line, column = diagnostic.span.location()
    return f"{line}:{column} {diagnostic.span.written()}"


# --- scopes -----------------------------------------------------------------------------------


def test_a_function_defined_in_a_block_sees_the_call_that_inserts_it() -> None:
    text = """
functions:
  Make: {input: "size, **Inside", body: {Inside: }}
out:
  Make:
    size: 7
    Inside:
      functions: {Show: {body: {a: $(size)}}}
      Show:
"""
    assert out(text) == "<a>7</a>"


def test_an_assignment_in_a_function_changes_a_bridge_variable_of_before() -> None:
    text = """
functions:
  Count: {body: {process: "n = n + 1"}}
out:
  variables: {n/bridge: 1}
  Count:
  a: $(n)
"""
    assert out(text) == "<a>2</a>"


CHAIN = """
functions:
  Outer:
    input: "**Inside"
    body:
      variables: {deep/child: 5}
      functions: {Deep/child: {body: {d: }}}
      Middle: {Inside: {Inside: }}
  Middle: {input: "**Inside", body: {Inside: }}
out:
  Outer:
    Inside:
"""


def test_a_block_sees_the_child_variables_of_the_callers_of_its_call() -> None:
    assert out(CHAIN + "      a: $(deep)") == "<a>5</a>"


def test_a_block_does_not_see_the_child_functions_of_the_callers_of_its_call() -> None:
    assert place(fault(CHAIN + "      Deep:")) == "13:7 Deep"


def test_a_block_calls_into_the_namespace_where_it_was_written() -> None:
    text = """
functions:
  Make:
    input: "**Inside"
    body:
      include: {path: second.yaml, namespace: Legs}
      Inside:
out:
  include: {path: first.yaml, namespace: Legs}
  Make:
    Inside: {Legs.Show: }
"""
    assert out(text, {"first": shows("one"), "second": shows("two")}) == "<one/>"


def shows(name: str) -> str:
    return f"functions: {{Show/parent: {{body: {{{name}: }}}}}}"


# --- loops ------------------------------------------------------------------------------------


def test_what_is_indexed_from_zero_can_be_run_over() -> None:
    text = """
process: |
  class Three:
      def __getitem__(self, index):
          if index > 2: raise IndexError
          return index * 10
out:
  for: {iterator: i, in: Three(), body: {a: $(i)}}
"""
    assert out(text) == "<a>0</a><a>10</a><a>20</a>"


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("out:\n  for: {iterator: i, in: len}", "2:26 len"),
        ("out:\n  for: {iterator: i, in: 5}", "2:26 5"),
        ("out:\n  for: {iterator: i, range: 10 ** 12}", "2:29 10 ** 12"),
        ("out:\n  for: {iterator: i, range: [0, 10 ** 12]}", "2:33 10 ** 12"),
        ("out:\n  include: {path: a.yaml, namespace: $('a b')}", "2:38 $('a b')"),
    ],
)
def test_a_fault_is_underlined(text: str, told: str) -> None:
    assert place(fault(text, {"a": "out:"})) == told


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("out:\n  for: {iterator: i, in: len}", "write in: [left, right], or the name of a list"),
        (
            "functions: {Make: {input: a, body: }}\nout:\n  $('Make'): [1]",
            "write Make: left, 2 for values by position, or each as name: value",
        ),
        (
            "out:\n  include: {path: a.yaml, namespace: $('a b')}",
            "write a_b: names are letters, digits and _, and do not begin with a digit",
        ),
    ],
)
def test_a_hint_says(text: str, hint: str) -> None:
    assert fault(text, {"a": "out:"}).hint == hint


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('out:\n  include: "a\\0b"', "the path of this include contains a NUL character"),
        ("out:\n  include: $('')", "the path of this include is empty"),
        (
            "out:\n  for: {iterator: i, range: false}",
            "`range` needs integers, not the boolean false",
        ),
        (
            "out:\n  for: {iterator: i, range: true}",
            "`range` needs integers, not the boolean true",
        ),
        (
            "out:\n  include: {path: a.yaml, namespace: $('a b')}",
            "'a b' cannot be the name of a namespace",
        ),
    ],
)
def test_a_message_says(text: str, message: str) -> None:
    assert fault(text, {"a": "out:"}).message == message


@pytest.mark.parametrize("mode", ["trusted", "safe"])
@pytest.mark.parametrize("name", ["set", "len", "sqrt"])
def test_functions_and_types_have_the_same_name_in_safe_mode(mode: str, name: str) -> None:
    text = f"out:\n  for: {{iterator: i, range: {name}, body: {{a: }}}}"
    with pytest.raises(YamaroError, match="`range` needs integers, not a function"):
        build("main.yaml", text=text, policy=Policy(mode), has_root=False)


# --- what is parsed only while it runs ----------------------------------------------------------

LATE = """
functions:
  Make: {input: Size, body: {a: "$(Size['a'])"}}
  Do: {input: f, body: {a: $(f())}}
out:
"""


def test_a_capitalised_argument_may_be_a_value() -> None:
    assert out(LATE + "  Make: {Size: {a: $(1 + 1)}}") == "<a>2</a>"
    assert out(LATE + "  $('Make'): {Size: {a: $(1 + 1)}}") == "<a>2</a>"


def test_arguments_under_a_computed_key_are_warned_of_once() -> None:
    built = run(LATE + "  $('Make'): {Size: {a: '${x}'}}")
    assert [(one.code, one.span.location()) for one in built.warnings] == [
        ("xacro-syntax", (6, 26))
    ]
    assert "<a>${x}</a>" in built.xml()


@pytest.mark.parametrize(
    ("parser", "call"),
    [
        ("parse_value", "Make: {Size: {a: $(i)}}"),
        ("parse_arguments", "$('Make'): {Size: {a: $(i)}}"),
    ],
)
def test_what_is_parsed_late_is_parsed_once(
    monkeypatch: pytest.MonkeyPatch, parser: str, call: str
) -> None:
    parse, times = getattr(late, parser), list[int]()

    def parse_and_count(*arguments: object) -> object:
        times.append(1)
        return parse(*arguments)

    monkeypatch.setattr(late, parser, parse_and_count)
    text = f"{LATE}  for: {{iterator: i, range: 3, body: {{{call}}}}}"
    assert out(text) == "<a>0</a><a>1</a><a>2</a>"
    assert len(times) == 1


def test_a_text_in_place_of_a_block_is_warned_of_too() -> None:
    text = LATE.replace("Size['a']", "Size") + "  $('Make'): {Size: '${x}'}"
    assert [one.code for one in run(text).warnings] == ["xacro-syntax"]


def test_a_function_of_an_argument_under_a_computed_key_fails_where_it_stands() -> None:
    error = fault(LATE + "  $('Do'): {f: '$(lambda: nope)'}")
    assert (error.code, place(error)) == ("undefined-name", "6:27 nope")


@pytest.mark.parametrize(
    "text",
    [
        "Make: {Size: {a: $(().__class__)}}",
        "Make: {Size: {$(().__class__): 1}}",
        "$('Make'): {Size: {a: $(().__class__)}}",
        "$('Make'): {Size: $(().__class__)}",
        "$('Make'): $(().__class__)",
        "$('Do'): {f: $(().__class__)}",
    ],
)
def test_safe_mode_holds_for_what_is_parsed_late(text: str) -> None:
    error = fault(f"{LATE}  {text}", policy=Policy("safe"))
    assert (error.code, error.span.written()) == ("unsafe-code", "().__class__")


def test_what_is_printed_may_be_a_list_or_a_mapping() -> None:
    text = "variables: {x: 2}\nout:\n  - print: {a: $(x)}\n  - print: [1, $(x)]"
    told: list[str] = []
    build("/t.yaml", loader=MemoryLoader({"/t.yaml": text}), on_message=told.append)
    assert told == ["{'a': 2}", "[1, 2]"]


# --- helpers ----------------------------------------------------------------------------------


def test_a_package_that_is_nowhere_is_told_with_the_places(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("AMENT_PREFIX_PATH", "/opt/a" + os.pathsep + "/opt/b")
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)
    file = tmp_path / "t.yaml"
    file.write_text("out: $(find('nowhere_to_be_found'))")
    with pytest.raises(YamaroError) as caught:
        build(str(file))
    (error,) = caught.value.diagnostics
    assert (error.code, error.message) == (
        "unknown-package",
        "the package 'nowhere_to_be_found' is not found",
    )
    assert error.hint is not None
    assert error.hint.startswith(
        "searched in /opt/a (AMENT_PREFIX_PATH), /opt/b (AMENT_PREFIX_PATH), "
        f"ROS_PACKAGE_PATH (not set), {tmp_path} and the folders that contain it"
    )
    assert "site-packages (entry points 'yamaro.packages')" in error.hint
    assert error.hint.endswith(
        "; source its ROS workspace, install its Python package with pip, or set its folder: "
        "--package nowhere_to_be_found:=FOLDER"
    )


def test_a_name_that_no_package_has_is_looked_for_nowhere() -> None:
    error = fault("out: $(find('a b'))")
    assert error.code == "unknown-package"
    assert error.hint == (
        "source its ROS workspace, install its Python package with pip, or set its folder: "
        "--package a b:=FOLDER"
    )


def test_a_file_of_data_may_be_named_by_its_package_or_scheme() -> None:
    data = {"data": "[1, {a: b}, $(x), 0x10]"}
    assert out("out: {a: \"$(load_yaml('data.yaml')[1]['a'])\"}", data) == "<a>b</a>"
    assert out("out: {a: \"$(load_yaml('file:///data.yaml')[3])\"}", data) == "<a>16</a>"
    assert out("out: {a: \"$(load_yaml('/data.yaml')[2])\"}", data) == "<a>$(x)</a>"


@pytest.mark.parametrize("uri", ["package://none/a.yaml", "Model://none"])
def test_data_of_a_package_that_is_nowhere_is_told_by_the_package(uri: str) -> None:
    error = fault(f"out: {{a: \"$(load_yaml('{uri}'))\"}}")
    assert (error.code, error.message) == ("unknown-package", "the package 'none' is not found")
    assert error.hint is not None and error.hint.startswith("searched in ")


def test_data_is_not_fetched() -> None:
    error = fault("out: {a: \"$(load_yaml('https://a/b.yaml?c=http://d'))\"}")
    assert (error.code, error.message, error.hint) == (
        "missing-file",
        "'https://' cannot be read: files are not downloaded",
        "save the file locally and read it with a path or package://",
    )


def test_data_holds_to_the_limits_of_the_file() -> None:
    text, data = "out: {a: \"$(load_yaml('data.yaml'))\"}", {"data": "[[[1]]]"}
    assert "[[[1]]]" in run(text, data, Policy(limits={"yaml-depth": 3})).xml()
    assert fault(text, data, Policy(limits={"yaml-depth": 2})).code == "too-deep"


def test_data_that_is_no_yaml_is_told_with_its_place() -> None:
    error = fault("out: $(load_yaml('data.yaml'))", {"data": "a: 1\nb: [1"})
    assert (error.span.place(), error.span.source.path) == ("data.yaml:2:4", "/data.yaml")


def test_data_may_look_like_xacro_and_be_warned_of_by_nobody() -> None:
    built = run("out: $(load_yaml('data.yaml')[0])", {"data": "- a\n#text: b\n- ${x}\n- {a:1}"})
    assert built.warnings == []
