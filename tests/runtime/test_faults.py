"""What is said of a fault that shows while a file runs, and which place is underlined."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

import yamaro
from tests.runtime.test_details import fault, place, run
from yamaro import Policy, YamaroError
from yamaro.files.loader import MemoryLoader

# --- the user's Python ------------------------------------------------------------------------


def test_a_recursion_that_python_ends_is_told() -> None:
    error = fault("process: |\n  def f(): raise RecursionError\nout: $(f())")
    assert (error.code, error.message) == ("too-deep", "this calls itself endlessly")


def test_of_a_recursion_only_the_first_call_is_told() -> None:
    error = fault("process: |\n  def f(): raise RecursionError\n  def g(): return f()\nout: $(g())")
    assert error.trace is not None
    assert (error.trace.name, error.trace.parent) == ("g", None)


def test_of_several_lines_the_one_that_does_not_hold_is_underlined() -> None:
    assert place(fault("process: |\n  assert 1 > 2\n  x = 1\nout:")) == "2:3 assert 1 > 2"


def test_in_an_expression_of_several_lines_the_one_that_calls_without_end_is_underlined() -> None:
    def recurse() -> None:
        raise RecursionError

    with pytest.raises(YamaroError) as caught:
        yamaro.build("-", text="out: |\n  $([1,\n  f()])\n", variables={"f": recurse})
    assert place(caught.value.diagnostics[-1]) == "3:3 f()]"


def test_a_name_that_is_declared_elsewhere_gets_no_suggestion_but_its_place() -> None:
    error = fault(
        "variables: {length: 1}\n"
        "functions: {Make: {body: {variables: {lenght: 2}}}}\n"
        "out: $(lenght)"
    )
    assert error.hint is None
    assert error.notes[0].startswith("'lenght' at /t.yaml:2:39 is local to its function or block")


@pytest.mark.skipif(sys.version_info < (3, 11), reason="Python knows columns from 3.11 on")
def test_a_name_that_inner_python_misses_is_shown_where_that_is_run() -> None:
    """The name stands in front of it as well, where nobody reads it."""
    error = fault("out: $(nope if False else eval('nope'))")
    assert (error.code, place(error)) == ("undefined-name", "1:27 eval('nope')")


def test_a_key_that_the_names_in_sight_lack_is_named() -> None:
    assert fault("out: $(globals()['nope'])").message == "there is no key 'nope' (KeyError)"


def test_an_attribute_that_is_private_is_not_suggested() -> None:
    text = "process: |\n  class Box: {0} = 1\nout: $(Box.size)"
    assert fault(text.replace("{0}", "size_")).hint == "did you mean 'size_'?"
    assert fault(text.replace("{0}", "_size")).hint is None


def test_a_trusted_file_that_is_not_permitted_something_is_told_of_no_jail() -> None:
    error = fault("process: raise PermissionError('locked')\nout:")
    assert (error.message, error.hint) == ("locked (PermissionError)", None)


def test_the_items_of_inner_lists_count_too() -> None:
    text = "out: {a: '$([1, [2, {3: [4]}]])'}"
    assert "<a>" in run(text, policy=Policy(limits={"sequence": 6})).xml()
    error = fault(text, policy=Policy(limits={"sequence": 5}))
    assert (error.code, error.message) == (
        "limit-sequence",
        "with the lists in it, this value has more than 5 items, which is the limit",
    )


def test_a_text_behind_a_computed_name_may_be_as_long_as_the_limit_says() -> None:
    text = "out: {$('a'): $('x' * 6)}"
    assert "<a>xxxxxx</a>" in run(text, policy=Policy(limits={"text": 6})).xml()
    assert fault(text, policy=Policy(limits={"text": 5})).code == "limit-text"


@pytest.mark.parametrize("path", ["/t.yaml", "-"])
def test_a_value_that_safe_mode_does_not_take_is_told_at_the_start_of_the_file(path: str) -> None:
    loader = MemoryLoader({"/t.yaml": "out: $(x)"})
    text = "out: $(x)" if path == "-" else None
    with pytest.raises(YamaroError) as caught:
        yamaro.build(path, text=text, loader=loader, variables={"x": len}, policy=Policy("safe"))
    (error,) = caught.value.diagnostics
    assert (error.code, place(error)) == ("unsafe-code", "1:1 ")
    assert error.message.startswith("the value of the variable 'x': ")


# --- calls, ranges, content -------------------------------------------------------------------


@pytest.mark.parametrize("name", ["n.Make", "n.inner.Make", "none.inner.Make"])
def test_a_function_in_what_is_no_namespace_is_not_defined(name: str) -> None:
    error = fault(f"variables: {{n: 5}}\nout: {{{name}: }}")
    assert (error.code, error.message) == (
        "undefined-function",
        f"function '{name}' is not defined",
    )


@pytest.mark.parametrize(
    ("inside", "note"),
    [
        (
            "functions: {Make: {body: }}\n  Make:",
            "the function 'Make' at /t.yaml:5:19 is local to its function or block",
        ),
        (
            "Make:\n      functions: {Make: {body: }}",
            "the function 'Make' is declared later, at /t.yaml:6:19",
        ),
    ],
    ids=["right behind a block", "at the start of a block"],
)
def test_a_block_begins_and_ends_exactly_for_what_is_declared_in_it(inside: str, note: str) -> None:
    error = fault(
        "functions: {Do: {input: '**Inside', body: {Inside: }}}\n"
        f"out:\n  Do:\n    Inside:\n      {inside}\n"
    )
    assert error.code == "undefined-function"
    assert [told.partition(";")[0] for told in error.notes] == [note]


def test_a_bound_of_a_range_that_is_no_number_is_underlined() -> None:
    error = fault("out: {for: {iterator: i, range: [0, null]}}")
    assert (error.code, place(error)) == ("bad-range", "1:37 null")
    assert error.message == "`range` needs integers, not empty (null)"
    assert error.hint == "write range: 6, or range: 0, 6, or in: for the items of a list"


def test_no_more_than_the_start_of_a_long_text_is_shown() -> None:
    error = fault("out: {for: {iterator: i, range: $('abcd' * 11)}}")
    assert error.message == f"`range` needs integers, not the text '{'abcd' * 10}'"


def test_behind_a_part_a_list_is_no_content_again() -> None:
    link = "link: {geometry: box, scale: [1, 2, 3], mass: 1}"
    error = fault(f"model:\n  part: {{name: p, if: {{condition: 1, body: {{{link}}}}}}}\n  a: [1]")
    assert (error.code, place(error)) == ("list-as-text", "3:6 [1]")


def test_expressions_in_a_list_of_a_part_are_evaluated_where_it_stands() -> None:
    link = "link: {geometry: box, scale: [1, $(n), 2.50], visual: }"
    text = (
        f"variables: {{n: 3}}\nmodel: {{part: {{name: p, if: {{condition: 1, body: {{{link}}}}}}}}}"
    )
    assert '<box size="1 3 2.50"/>' in run(text).xml()


# --- files ------------------------------------------------------------------------------------


def test_of_an_address_with_another_one_in_it_the_first_scheme_is_told() -> None:
    error = fault("out: {include: 'https://a/b.yaml?c=http://d'}")
    assert error.message == "'https://' cannot be included: files are not downloaded"


@pytest.mark.parametrize("ending", ["yaml", "yml"])
def test_a_misspelt_file_is_taken_for_one_with_an_ending_of_yaml(ending: str) -> None:
    loader = MemoryLoader({"/t.yaml": "out: {include: prt.y}", f"/part.{ending}": "", "/prt.z": ""})
    with pytest.raises(YamaroError) as caught:
        yamaro.build("/t.yaml", loader=loader)
    assert caught.value.diagnostics[0].hint == f"did you mean 'part.{ending}'?"


def test_a_package_that_is_nowhere_is_told_by_its_name_alone() -> None:
    error = fault("out: {include: package://none/deep/a.yaml}")
    assert (error.code, error.message) == ("unknown-package", "the package 'none' is not found")
    assert error.hint is not None and error.hint.endswith("--package none:=FOLDER")


def test_a_file_that_is_named_from_the_root_or_the_home_is_shown_by_its_whole_path(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("USERPROFILE", str(tmp_path))
    faulty = tmp_path / "faulty.yaml"
    faulty.write_text("a: $(x)")
    for name in (faulty.as_uri(), str(faulty), "~/faulty.yaml"):
        with pytest.raises(YamaroError) as caught:
            yamaro.build("-", text=f"out: {{include: '{name}'}}")
        assert caught.value.diagnostics[-1].span.place() == f"{faulty}:1:6"


def test_a_text_in_no_file_stands_in_the_folder_of_the_process(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "data.yaml").write_text("7")
    text = "out: {a: $(file_dir()), b: \"$(load_yaml('data.yaml'))\", c: $(cwd)}"
    xml = yamaro.build("-", text=text).xml()
    assert f"<a>{tmp_path}</a>" in xml and "<b>7</b>" in xml and f"<c>{tmp_path}</c>" in xml


def test_safe_mode_tells_which_module_beside_the_file_it_does_not_run(tmp_path: Path) -> None:
    (tmp_path / "own.py").write_text("x = 1")
    path = tmp_path / "t.yaml"
    path.write_text("import: own\nout:")
    with pytest.raises(YamaroError) as caught:
        yamaro.build(path, policy=Policy("safe"))
    (error,) = caught.value.diagnostics
    assert (error.code, error.message) == (
        "unsafe-code",
        "the module `own` is not allowed in safe mode: it is Python code beside this file",
    )
