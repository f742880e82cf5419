"""The pipeline as programs use it: `build`, `convert`, and what is passed in."""

from __future__ import annotations

from pathlib import Path

import pytest

import yamaro
from yamaro import YamaroError, YamaroWarning, build, convert
from yamaro.files.loader import MemoryLoader
from yamaro.options import UsageError

ECHO = "variables: {n: 1}\nout: $(repr(n))\n"


def built(text: str, *command_line: str, **variables: object) -> yamaro.Build:
    loader = MemoryLoader({"/r/t.yaml": text})
    return build("/r/t.yaml", loader=loader, command_line=command_line, variables=variables)


def content(xml: str) -> str:
    return xml.split("<out>")[1].split("</out>")[0]


@pytest.mark.parametrize(
    ("assignment", "value"),
    [
        ("n:=3", "3"), ("n:=3.50", "3.5"), ("n:=", "''"), ("n:=a b", "'a b'"), ("n:='3'", "'3'"),
        ("n:=[l, r]", "['l', 'r']"), ("n:={a: 1}", "{'a': 1}"), ("n:=null", "None"),
        ("n:=true", "True"), ("n:=$(1 + 1)", "'$(1 + 1)'"), ("n:=a:=b", "'a:=b'"),
        ("n:=0x10", "16"), ("n:=no", "'no'"), ("n:= 7 ", "7"),
    ],
)  # fmt: skip
def test_values_of_the_command_line_are_read_as_yaml(assignment: str, value: str) -> None:
    assert content(built(ECHO, assignment).xml()).replace("&gt;", ">") == value


@pytest.mark.parametrize(
    "argument", ["n", "n=1", ":=1", "1a:=1", "if:=1", "a-b:=1", "n:=[1", "n:='"]
)
def test_a_malformed_assignment_is_wrong_usage(argument: str) -> None:
    with pytest.raises(UsageError, match="'"):
        built(ECHO, argument)
    with pytest.raises(ValueError, match="'"):
        convert(Path(__file__), argument)


def test_variables_given_as_objects_win_over_the_command_line() -> None:
    assert content(built(ECHO, "n:=1", n=[1, "x"]).xml()) == "[1, 'x']"


def test_a_variable_nobody_knows_is_a_warning_with_a_suggestion() -> None:
    text = "variables: {length: 1}\nout: $(width_of if False else 0)\n"
    (warning,) = built(text, "lenght:=2", "width_of:=2").warnings
    assert (warning.code, warning.hint) == ("unknown-variable", "did you mean 'length'?")
    assert warning.span.written() == "lenght"


def test_strict_makes_warnings_errors() -> None:
    loader = MemoryLoader({"/t.yaml": "out: '${x}'\n"})
    assert [w.code for w in build("/t.yaml", loader=loader).warnings] == ["xacro-syntax"]
    with pytest.raises(YamaroError) as caught:
        build("/t.yaml", loader=loader, strict=True)
    assert [(d.code, d.severity) for d in caught.value.diagnostics] == [("xacro-syntax", "error")]


def test_an_error_brings_the_warnings_before_it() -> None:
    with pytest.raises(YamaroError) as caught:
        built("out: {a: '${x}', b: $(no_such)}\n")
    found = [(d.code, d.severity) for d in caught.value.diagnostics]
    assert found == [("xacro-syntax", "warning"), ("undefined-name", "error")]


def test_text_in_no_file_is_named_after_standard_input() -> None:
    with pytest.raises(YamaroError) as caught:
        build("-", text="out: $(x)\n")
    assert caught.value.diagnostics[0].span.place() == "<standard input>:1:8"
    assert (
        build("-", text="\ufeffmodel:\n", allow="no-link").xml().endswith('<robot name="robot"/>\n')
    )


@pytest.mark.parametrize(
    ("path", "name"), [("/r/arm.yaml", "arm"), ("/r/a.b.yaml", "a"), ("/r/.yaml", "robot")]
)
def test_a_robot_is_named_after_its_file(path: str, name: str) -> None:
    xml = build(path, loader=MemoryLoader({path: "model:\n"}), allow="no-link").xml()
    assert xml.endswith(f'<robot name="{name}"/>\n')


def test_convert_gives_xml_and_issues_warnings(tmp_path: Path) -> None:
    path = tmp_path / "t.yaml"
    path.write_text("variables: {n: 1}\nout: '${n} $(n)'\n")
    with pytest.warns(YamaroWarning, match="xacro-syntax"):
        assert content(convert(path, "n:=5")) == "${n} 5"


def test_convert_tells_a_missing_file_from_a_wrong_use(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="the file does not exist"):
        convert(tmp_path / "none.yaml")


def test_prints_go_to_standard_error(capsys: pytest.CaptureFixture[str]) -> None:
    built("print: $(1 / 4)\nprocess: print('a', 'b', sep='-')\nout:\n")
    assert capsys.readouterr() == ("", "0.25\na-b\n")


def test_print_with_a_file_of_its_own_goes_there(tmp_path: Path) -> None:
    path = tmp_path / "note.txt"
    text = f"process: |\n  with open({str(path)!r}, 'w') as f: print('x', file=f)\nout:\n"
    messages: list[str] = []
    loader = MemoryLoader({"/t.yaml": text})
    build("/t.yaml", loader=loader, on_message=messages.append)
    assert (path.read_text(), messages) == ("x\n", [])


def test_a_build_knows_its_files_and_meshes(tmp_path: Path) -> None:
    (tmp_path / "a.stl").write_text("solid a\nendsolid a\n")
    joint = "joint/name=j, type=fixed: {parent/link=a: , child/link=b: }"
    inner = f"model:\n  link/name=b:\n  {joint}\n"
    (tmp_path / "inner.yaml").write_text(inner)
    (tmp_path / "data.yaml").write_text("k: [1, 2]\n")
    (tmp_path / "t.yaml").write_text(
        "variables: {d: $(load_yaml('data.yaml'))}\n"
        "model:\n  include: inner.yaml\n  link/name=a:\n    visual:\n      geometry:\n"
        "        mesh/filename=a.stl:\n    visual: {geometry: {mesh/filename=none.stl: }}\n"
    )
    result = build(str(tmp_path / "t.yaml"))
    assert [Path(file).name for file in result.files] == ["t.yaml", "data.yaml", "inner.yaml"]
    assert result.meshes == [str(tmp_path / "a.stl"), "none.stl"]
    assert result.root.name == "robot"
