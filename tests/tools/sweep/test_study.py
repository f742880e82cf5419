"""Studies: what a file may say, and how it is told what is wrong with it."""

from __future__ import annotations

import json
from pathlib import Path
from textwrap import dedent

import pytest

import yamaro
from yamaro.options import Options, UsageError
from yamaro.policy import Policy
from yamaro.tools.sweep.plan import Plan, Space
from yamaro.tools.sweep.study import planned, read_study

LEG = """\
robot: leg
arguments:
  thigh: {default: 0.3, unit: m, range: [0.1, 0.5]}
  shank: {default: 0.3, unit: m, range: [0.1, 0.5]}
  legs: {type: integer, range: [2, 8], default: 4}
  tag: {type: text, default: x}
  mesh: {type: path, default: null}
model:
- part: {name: base, link: {geometry: box, scale: $(thigh) 0.1 0.1, mass: 1, visual: }}
"""


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("leg.yaml").write_text(LEG)


def plan_of(text: str, **axes: str) -> Plan:
    Path("studies").mkdir(exist_ok=True)
    Path("studies/study.yaml").write_text(dedent(text))
    study = read_study("studies/study.yaml", Policy().limits)
    return planned(study, Options(), axes=axes)


def test_a_study_says_all_that_the_command_line_can() -> None:
    plan = plan_of("""\
        sweep:
          robot: ../leg.yaml
          samples: 1000
          method: sobol
          seed: 7
          vary: {thigh: [0.2, 0.4], shank: 15cm..40cm, legs: {choices: [4, 6]}}
          fixed: {tag: 007, mesh: shell.stl}
          keep: [thigh + shank < 0.7, legs != 6 or thigh < 0.3]
          to: [mjcf, sdf]
          models: true
        """)
    assert (plan.samples, plan.method, plan.seed) == (1000, "sobol", 7)
    assert plan.robot == str(Path("leg.yaml").absolute())
    assert [axis.name for axis in plan.axes] == ["thigh", "shank", "legs"]
    assert plan.fixed == {"tag": "007", "mesh": str(Path("studies/shell.stl").absolute())}
    assert (plan.formats, plan.models) == (["mjcf", "sdf"], True)
    space = Space(plan)
    for variant in space.variants(0, 200):
        assert 0.2 <= variant["thigh"] <= 0.4
        assert 0.15 <= variant["shank"] <= 0.4
        holds = variant["thigh"] + variant["shank"] < 0.7
        holds = holds and (variant["legs"] != 6 or variant["thigh"] < 0.3)
        assert space.is_kept(variant) == holds


def test_by_default_all_arguments_vary_that_have_a_range() -> None:
    plan = plan_of("sweep: {robot: ../leg.yaml, samples: 3, fixed: {shank: 0.2}}")
    assert [axis.name for axis in plan.axes] == ["thigh", "legs"]


def test_an_axis_of_the_command_line_takes_the_place_of_that_of_the_study() -> None:
    study = "sweep: {robot: ../leg.yaml, vary: {thigh: [0.2, 0.4], legs: }}"
    plan = plan_of(study, thigh="0.3..0.4/2")
    assert {axis.name: axis.count for axis in plan.axes} == {"legs": 7, "thigh": 2}
    assert plan.samples == 14


WRONG = [
    ("{robot: ../leg.yaml, vary: {thigh: [0.4, 0.2]}}", "bad-sweep", "has to rise"),
    ("{robot: ../leg.yaml, vary: {thigh: [0.2, 0.9]}}", "argument-range", "not 0.9"),
    ("{robot: ../leg.yaml, vary: {thih: [0.2, 0.4]}}", "unknown-argument", "'thigh'"),
    ("{robot: ../leg.yaml, fixed: {legs: 4.5}}", "argument-type", "an integer"),
    ("{robot: ../leg.yaml, smaples: 3}", "unknown-key", "did you mean 'samples'"),
    ("{robot: ../leg.yaml, method: lation}", "bad-sweep", "did you mean 'latin'"),
    ("{robot: ../leg.yaml, samples: 0}", "bad-sweep", "at least 1"),
    ("{robot: ../leg.yaml, samples: 3, samples: 4}", "bad-sweep", "given twice"),
    ("{robot: ../leg.yaml, seed: x}", "bad-sweep", "an integer"),
    ("{robot: ../leg.yaml, method: random}", "bad-sweep", "how many variants"),
    ("{robot: ../leg.yaml, vary: {thigh: [0.2, 0.4]}}", "bad-sweep", "`step` or `points`"),
    ("{robot: ../leg.yaml, method: grid, samples: 3, vary: {legs: }}", "bad-sweep", "7 points"),
    ("{robot: ../leg.yaml, vary: {legs: }, keep: legs <}", "python-syntax", "not a Python"),
    ("{robot: ../leg.yaml, vary: {legs: }, keep: open('x')}", "unsafe-code", "only compute"),
    ("{robot: ../leg.yaml, vary: {legs: }, keep: lgs < 3}", "undefined-name", "'lgs'"),
    ("{robot: ../leg.yaml, vary: {legs: }, to: mjfc}", "bad-sweep", "did you mean 'mjcf'"),
    ("{robot: ../leg.yaml, models: 3}", "bad-sweep", "true or false"),
    ("{robot: ../leg.yaml, vary: [thigh]}", "bad-sweep", "names with values"),
    ("{robot: ../leg.yaml, vary: {}}", "bad-sweep", "nothing varies"),
    (f"{{robot: ../leg.yaml, seed: {2**63}}}", "bad-sweep", "from 0 to"),
    (f"{{robot: ../leg.yaml, samples: {2**32}}}", "bad-sweep", "from 1 to 2,147,483,648 variants"),
    ("{samples: 3}", "bad-sweep", "needs the key `robot`"),
    ("[robot]", "bad-sweep", "has keys such as"),
]


@pytest.mark.parametrize(("body", "code", "message"), WRONG)
def test_what_is_wrong_with_a_study_is_said_where_it_is(body: str, code: str, message: str) -> None:
    with pytest.raises(yamaro.YamaroError) as caught:
        plan_of(f"sweep: {body}\n")
    first = caught.value.diagnostics[0]
    assert first.code == code
    assert message in str(caught.value)
    assert str(caught.value).count("studies/study.yaml:1:") >= 1


def test_all_that_is_wrong_is_said_at_once() -> None:
    with pytest.raises(yamaro.YamaroError) as caught:
        plan_of("sweep: {smaples: 3, seed: -1}\nother: 3\n")
    codes = [each.code for each in caught.value.diagnostics]
    assert codes == ["bad-sweep", "unknown-key", "bad-sweep", "bad-sweep"]


def test_an_argument_without_a_default_has_to_be_given() -> None:
    Path("leg.yaml").write_text(LEG.replace("default: 0.3, unit: m, range: [0.1, 0.5]", "unit: m"))
    with pytest.raises(yamaro.YamaroError, match=r"missing-argument.*\n.*leg.yaml:3"):
        plan_of("sweep: {robot: ../leg.yaml, vary: {legs: }}")


def test_the_robot_has_to_be_there() -> None:
    with pytest.raises(UsageError, match=r"leg2\.yaml"):
        plan_of("sweep: {robot: ../leg2.yaml, samples: 3}")


def test_a_plan_can_be_written_down() -> None:
    from yamaro.tools.sweep.plan import data_of

    plan = plan_of("sweep: {robot: ../leg.yaml, vary: {legs: }, fixed: {thigh: 20cm}}")
    data = json.loads(json.dumps(data_of(plan, str(Path("runs").absolute()))))
    assert data["robot"] == "../leg.yaml"
    assert data["fixed"] == {"thigh": 0.2}
