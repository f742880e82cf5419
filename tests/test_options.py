"""The options of a build: the same keywords for `build`, `load` and `Program.build`."""

from __future__ import annotations

import ast
import inspect
import pickle
import re
from pathlib import Path

import pytest

import yamaro
from yamaro import options, program
from yamaro.options import DEFAULTS, OF_FILES, Options

TEXT = "variables: {length: 1}\nmodel:\n  link/name=base: {}\n  out: $(length)\n"
API = Path(__file__).parents[1] / "docs" / "api.md"


def typed_keywords(*classes: str) -> set[str]:
    """Return the keys of the typed dictionaries in which type checkers find the keywords."""
    tree = ast.parse(inspect.getsource(options))
    return {
        field.target.id
        for node in ast.walk(tree)
        if isinstance(node, ast.ClassDef) and node.name in classes
        for field in node.body
        if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name)
    }


def test_type_checkers_know_each_keyword() -> None:
    assert typed_keywords("FileOptions", "BuildOptions") == set(DEFAULTS)
    assert typed_keywords("FileOptions") == set(OF_FILES)
    assert typed_keywords("Options") == set(DEFAULTS)


def test_notebooks_see_each_keyword_with_its_default() -> None:
    for function in (yamaro.build, yamaro.load):
        parameters = dict(inspect.signature(function).parameters)
        assert parameters.pop("path").default is inspect.Parameter.empty
        assert {name: each.default for name, each in parameters.items()} == DEFAULTS
    own = inspect.signature(yamaro.Program.build).parameters
    assert set(own) == {"self", *DEFAULTS} - set(OF_FILES)


def test_each_keyword_is_documented() -> None:
    assert yamaro.build.__doc__ is not None
    told = set(re.findall(r"^ {8}(\w+):", yamaro.build.__doc__, re.MULTILINE))
    assert told == {"path", *DEFAULTS, "YamaroError", "UsageError"}


def test_a_program_can_not_be_built_of_other_files() -> None:
    lamp = yamaro.load("-", text=TEXT)
    with pytest.raises(TypeError, match=r"'policy' holds for all builds of a program.*load\(\)"):
        lamp.build(policy=yamaro.Policy())  # type: ignore[call-arg]


def test_options_of_load_hold_for_all_conversions_unless_one_has_others() -> None:
    strict = yamaro.load("-", text=TEXT, variables={"lenght": 2}, strict=True)
    with pytest.raises(yamaro.YamaroError):
        strict.build()
    assert strict.build(strict=False).warnings
    with pytest.raises(yamaro.YamaroError):
        strict.build()


def test_variables_of_a_build_are_not_those_of_the_next() -> None:
    lamp = yamaro.load("-", text=TEXT, variables={"length": 5})
    found = [lamp.build(**each).xml() for each in ({}, {"variables": {"length": 7}}, {})]  # type: ignore[arg-type]
    assert [re.findall(r"<out>(\d)", xml) for xml in found] == [["5"], ["7"], ["5"]]


def test_options_do_not_change() -> None:
    wanted = Options(strict=True)
    with pytest.raises(AttributeError, match="strict"):
        wanted.strict = False  # type: ignore[misc]
    assert wanted.changed(strict=False).strict is False
    assert wanted.strict is True
    assert pickle.loads(pickle.dumps(wanted)).strict is True  # goes to the workers of a study


@pytest.mark.parametrize(
    ("keywords", "message"),
    [
        ({"base": "free-floating"}, "'free-floating' is not a known base"),
        ({"sdf_version": "1.8"}, "'1.8' is not a known version of SDF"),
        ({"mujoco_version": "3.2.7"}, "MuJoCo 3.2.7 is too old; 3.3 or newer"),
        ({"mujoco_version": "3.x"}, "'3.x' is not a version of MuJoCo; write it as 3.3"),
        ({"target": "mjfc"}, "did you mean 'mjcf'"),
        ({"target": []}, "no output format is named"),
        ({"meshes": "copy"}, "'copy' needs an output file"),
        ({"allow": "bad-mas"}, "did you mean 'bad-mass'"),
    ],
)
def test_a_value_that_makes_no_sense_is_refused_before_a_file_is_read(keywords, message) -> None:
    with pytest.raises(yamaro.UsageError, match=message):
        program.Program("not-there.yaml", **keywords)
