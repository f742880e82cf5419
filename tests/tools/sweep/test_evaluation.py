"""What a sweep works out for a variant: words for metrics, and functions of the user's."""

from __future__ import annotations

import math
import pickle
from textwrap import dedent

import pytest

import yamaro
from tests.consumers.oracles import require_module
from tests.tools.sweep.robots import variant_of
from yamaro.source import Source, Span
from yamaro.tools.sweep.evaluation import Evaluation
from yamaro.tools.sweep.metrics import KINDS

QUADRUPED = "quadruped/quadruped.yaml"


@pytest.fixture(scope="module")
def variant():
    return variant_of(QUADRUPED, {"thigh_length": 0.25}, targets=("mjcf", "urdf"), index=7)


def code_in(text: str) -> str:
    """Return the code of the first error of a message."""
    return text.partition("error[")[2].partition("]")[0]


@pytest.fixture
def score(tmp_path, variant):
    """Return what a function of the user's gives for the variant, or the message."""

    def run(text, word="walk.py:score", *, given=variant):
        (tmp_path / "walk.py").write_text(dedent(text))
        try:
            evaluation = Evaluation.parse([], word, str(tmp_path))
            return pickle.loads(pickle.dumps(evaluation))(given)
        except yamaro.YamaroError as error:
            return str(error)

    return run


# --- words ---


@pytest.mark.parametrize(
    ("word", "message"),
    [
        ("mas", "there is no metric 'mas'"),
        ("mas", "hint: did you mean 'mass'?"),
        ("beauty", "hint: there are mass, reach, bounding_box, workspace, stable"),
        ("stable", "the metric 'stable' needs an argument"),
        ("stable(soon)", "the metric 'stable' does not take 'soon'"),
        ("stable(-1)", "hint: write it as in stable(5), with the seconds"),
        ("stable(nan)", "does not take 'nan'"),
        ("mass(3)", "the metric 'mass' does not take '3'"),
        ("workspace(a, b)", "the metric 'workspace' does not take 'a, b'"),
        ("reach(tool0", "'reach(tool0' has no closing parenthesis"),
    ],
)
def test_a_wrong_word_is_explained(word, message) -> None:
    with pytest.raises(yamaro.YamaroError) as caught:
        Evaluation.parse([word], None, "")
    assert message in str(caught.value)
    is_known = word.partition("(")[0] in KINDS
    assert code_in(str(caught.value)) == ("bad-metric" if is_known else "unknown-metric")


def test_all_wrong_words_are_told_where_they_are_written() -> None:
    source = Source("metrics: [mas, reach, reach()]", name="study.yaml")
    spans = [Span(source, start, start + 3) for start in (10, 15, 22)]
    with pytest.raises(yamaro.YamaroError) as caught:
        Evaluation.parse(["mas", "reach", "reach()"], None, "", spans=spans)
    found = [(each.code, each.span.place()) for each in caught.value.diagnostics]
    assert found == [("unknown-metric", "study.yaml:1:11"), ("bad-metric", "study.yaml:1:23")]


def test_columns_and_their_units_are_known_before() -> None:
    words = ["mass", "reach", "reach(imu_link)", "bounding_box", "stable(0.01)"]
    evaluation = Evaluation.parse(words, None, "")
    found = evaluation(variant_of(QUADRUPED))
    assert list(found) == list(evaluation.units)
    assert evaluation.units["reach_imu_link"] == "m"
    assert evaluation.needs == ("mjcf",)
    assert evaluation.packages == ("numpy", "mujoco")


@pytest.mark.parametrize(
    ("word", "message"),
    [
        ("reach(tool)", "the robot has no link or frame 'tool'"),
        ("reach(trunk_lonk)", "did you mean 'trunk_link'?"),
        ("workspace", "the robot has 5 tips"),
        ("workspace", "name one: workspace(imu_link)"),
    ],
)
def test_what_a_robot_has_no_value_of_is_an_error(word, message, variant) -> None:
    with pytest.raises(yamaro.YamaroError) as caught:
        Evaluation.parse([word], None, "")(variant)
    assert caught.value.diagnostics[0].code == "metric-failed"
    assert message in str(caught.value)


def test_what_mujoco_refuses_is_an_error_of_the_variant(tmp_path) -> None:
    (tmp_path / "r.yaml").write_text(
        "robot: r\nmodel:\n- part: {name: a, link: {mass: 1, geometry: sphere, radius: 1,\n"
        "    visual: , collision: , mjcf: {geom/type=sphere: }}}\n"
    )
    given = variant_of(tmp_path / "r.yaml")
    with pytest.raises(yamaro.YamaroError, match="MuJoCo refuses the robot") as caught:
        Evaluation.parse(["stable(1)"], None, "")(given)
    assert code_in(str(caught.value)) == "mujoco-refused"


# --- functions ---


def test_a_function_gets_what_its_parameters_name(score, variant) -> None:
    mujoco = require_module("mujoco")
    text = """
    import mujoco
    import yamaro

    def score(scene, model, robot, arguments, urdf, mjcf, index, weight=2):
        assert isinstance(model, mujoco.MjModel) and isinstance(robot, yamaro.Robot)
        return {
            "bodies": model.nbody, "floors": scene.ngeom - model.ngeom, "links": len(robot.links),
            "thigh": arguments["thigh_length"], "starts": urdf[:5] == mjcf[:5] == "<?xml",
            "index": index, "weight": weight,
        }
    """
    model = mujoco.MjModel.from_xml_string(variant.build.outputs["mjcf"].xml())
    assert score(text) == {
        "bodies": model.nbody, "floors": 1, "links": 19, "thigh": 0.25, "starts": True, "index": 7,
        "weight": 2,
    }  # fmt: skip


def test_it_needs_the_formats_that_it_asks_for(tmp_path) -> None:
    (tmp_path / "walk.py").write_text("def score(model, sdf): ...\ndef other(robot): ...\n")
    evaluation = Evaluation.parse([], "walk.py:score", str(tmp_path))
    assert (evaluation.needs, evaluation.packages) == (("mjcf", "sdf"), ("mujoco",))
    assert Evaluation.parse([], "walk.py:other", str(tmp_path)).needs == ()


def test_meshes_are_found(tmp_path, score) -> None:
    trimesh = require_module("trimesh")
    trimesh.creation.box((1, 1, 1)).export(tmp_path / "box.stl")
    (tmp_path / "robot.yaml").write_text(
        "robot: r\nmodel:\n- part: {name: a, link: {mass: 1, geometry: box.stl, scale: 1 1 1,\n"
        "    visual: , collision: }}\n"
    )
    given = variant_of(tmp_path / "robot.yaml")
    assert score("def score(scene): return {'meshes': scene.nmesh}", given=given) == {"meshes": 1}


def test_numbers_of_numpy_become_numbers_of_python(score) -> None:
    text = """
    import numpy as np

    def score():
        return {"a": np.float32(0.5), "b": np.int64(3), "c": np.bool_(True), "d": np.array(2.0),
                "e": None, "f": True}
    """
    found = score(text)
    assert found == {"a": 0.5, "b": 3, "c": True, "d": 2.0, "e": None, "f": True}
    assert [type(each) for each in found.values()] == [float, int, bool, float, type(None), bool]


def test_modules_beside_the_file_are_found_and_stay_its_own(tmp_path, score) -> None:
    import sys

    (tmp_path / "gaits.py").write_text("SPEED = 0.4\n")
    assert score("import gaits\ndef score(): return {'v': gaits.SPEED}") == {"v": 0.4}
    assert "gaits" not in sys.modules


@pytest.mark.parametrize(
    ("body", "message", "place"),
    [
        ("return 3", "'score' returned 3, which is not a dict", "walk.py:2:1"),
        ("return {'v': 'fast'}", "'score' returned 'fast' as 'v'", "walk.py:2:1"),
        ("return {'v': math.nan}", "'score' returned nan as 'v'", "walk.py:2:1"),
        ("return {'v': -math.inf}", "'score' returned -inf as 'v'", "walk.py:2:1"),
        ("return {3: 1}", "'score' returned a result named 3", "walk.py:2:1"),
        ("return 1 / 0", "ZeroDivisionError: division by zero", "walk.py:3:3"),
        ("raise SystemExit('gone')", "SystemExit: gone", "walk.py:3:3"),
        ("assert 1 > 2", "AssertionError", "walk.py:3:3"),
        ("math.sqrt('x')", "TypeError: must be real number, not str", "walk.py:3:3"),
    ],
)
def test_what_goes_wrong_in_it_is_told_with_its_line(score, body, message, place) -> None:
    text = score(f"import math\ndef score():\n  {body}\n")
    assert message in text
    assert f"--> {place}" in text
    is_result = "returned" in message
    assert code_in(text) == ("evaluate-result" if is_result else "evaluate-failed")


def test_the_way_to_a_fault_is_told(tmp_path, score) -> None:
    (tmp_path / "gaits.py").write_text("def step(x):\n    return 1 / x\n")
    text = score("import gaits\n\ndef score():\n    return {'v': gaits.step(0)}\n")
    assert "--> gaits.py:2:5" in text
    assert "= in step, called at walk.py:4:5" in text


def test_a_line_of_a_library_is_a_note(score) -> None:
    text = score("import json\ndef score():\n    json.loads('{')\n")
    assert "--> walk.py:3:5" in text
    assert "= note: raised at decoder.py:" in text


@pytest.mark.parametrize(
    ("text", "word", "message"),
    [
        ("", "walk.py", "'walk.py' is not a function of a Python file"),
        ("", "run.py:score", "there is no file 'run.py'"),
        ("def scores(): ...", "walk.py:score", "'walk.py' has no function 'score'"),
        ("def scores(): ...", "walk.py:score", "did you mean 'scores'?"),
        ("x = 1", "walk.py:score", "write `def score(model, arguments):`"),
        ("def score(modell): ...", "walk.py:score", "the function 'score' asks for 'modell'"),
        ("def score(modell): ...", "walk.py:score", "did you mean 'model'?"),
        ("def score(model", "walk.py:score", "SyntaxError: '(' was never closed"),
        ("import nope", "walk.py:score", "ModuleNotFoundError: No module named 'nope'"),
        ("UNITS = 3\ndef score(): ...", "walk.py:score", "UNITS in 'walk.py' is not a dict"),
    ],
)
def test_a_function_that_cannot_be_used_is_told_before(score, text, word, message) -> None:
    found = score(text, word)
    assert message in found
    assert " --> " in found
    is_python = "Error: " in found
    assert code_in(found) == ("evaluate-failed" if is_python else "bad-evaluate")


def test_a_result_that_is_named_as_a_metric_is_an_error(tmp_path, variant) -> None:
    (tmp_path / "walk.py").write_text("def score(): return {'mass': 1}\n")
    evaluation = Evaluation.parse(["mass"], "walk.py:score", str(tmp_path))
    with pytest.raises(yamaro.YamaroError, match=r"evaluate-result.*'mass'"):
        evaluation(variant)


def test_the_code_decides_about_the_results(tmp_path) -> None:
    (tmp_path / "gaits.py").write_text("SPEED = 0.4\n")
    (tmp_path / "walk.py").write_text("import gaits\nUNITS = {'v': 'm/s'}\ndef score(): ...\n")

    def described():
        evaluation = Evaluation.parse(["mass"], "walk.py:score", str(tmp_path))
        assert evaluation.units == {"mass": "kg", "v": "m/s"}
        return evaluation.described(str(tmp_path))

    before = described()
    assert before["metrics"] == ["mass"]
    assert before["evaluate"]["function"] == "walk.py:score"
    assert list(before["evaluate"]["files"]) == ["gaits.py", "walk.py"]
    assert described() == before
    (tmp_path / "gaits.py").write_text("SPEED = 0.5\n")
    assert described() != before


def test_a_variant_gives_the_same_results_again() -> None:
    words = ["reach", "workspace(front_left_foot_link)", "stable(0.1)"]
    evaluation = Evaluation.parse(words, None, "")
    first, again = (evaluation(variant_of(QUADRUPED, {"calf_length": 0.3})) for _ in range(2))
    assert first == again
    assert all(math.isfinite(each) for each in first.values() if each is not None)
