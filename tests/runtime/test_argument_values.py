"""Arguments of a file that are passed from Python, in each mode of trust."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import yamaro
from tests.effort import examples
from yamaro.policy import Policy
from yamaro.sandbox import jail

ARM = """\
arguments:
  tilt: {default: 0, unit: deg, range: [-180, 180]}
  legs: {type: integer, default: 4, choices: [4, 6]}
  tag: {type: text, default: none}
  solid: true
  sides: []
  mesh: {type: path, default: a.stl}
  extra: null
out: $(tilt) $(legs) $(tag) $(solid) $(len(sides)) $(extra)
"""


def built(text: str, policy: Policy | None = None, **variables: Any) -> str:
    build = yamaro.build("robot.yaml", text=text, variables=variables, policy=policy)
    return build.xml().partition("<out>")[2].partition("</out>")[0]


def codes(text: str, policy: Policy | None = None, **variables: Any) -> list[str]:
    with pytest.raises(yamaro.YamaroError) as caught:
        built(text, policy, **variables)
    return [f"{each.code} {each.span.place()}" for each in caught.value.diagnostics]


def test_values_from_python_are_in_the_unit() -> None:
    assert built(ARM, tilt=180, legs=6.0, tag=7, sides=["a"]) == (
        "3.14159265358979 6 7 true 1 None"
    )
    assert built(ARM, tilt=np.float64(90), legs=np.int64(6), solid=np.bool_(False)) == (
        "1.5707963267949 6 none false 0 None"
    )
    assert built(ARM, sides=np.array([1, 2]), extra=(1, 2)) == "0.0 4 none true 2 1 2"


def test_what_is_wrong_with_values_from_python_is_told_together() -> None:
    place = "<keyword argument>:1:1"
    assert codes(ARM, tilt=181, legs=5, tag=[], solid=1, sides={}, colour=1, mesh=3.5) == [
        f"unknown-argument {place}",
        f"argument-range {place}",
        f"argument-choice {place}",
        f"argument-type {place}",
        f"argument-type {place}",
        f"argument-type {place}",
    ]
    assert codes(ARM, tilt=float("nan")) == [f"argument-type {place}"]
    assert codes(ARM, tilt="1e400") == [f"argument-type {place}"]
    assert codes(ARM, legs=10**5000) == [f"argument-choice {place}"]
    assert codes(ARM, tilt=10**5000) == [f"argument-type {place}"]


def test_a_path_is_relative_to_where_it_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "here").mkdir()
    (tmp_path / "robot").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    file = tmp_path / "robot" / "robot.yaml"
    file.write_text("arguments: {mesh: {type: path, default: a.stl}}\nout: $(mesh)\n")
    assert f"{tmp_path}/robot/a.stl" in yamaro.convert(file)
    assert f"{tmp_path}/here/b.stl" in yamaro.convert(file, mesh="b.stl")
    assert f"{tmp_path}/c.stl" in yamaro.convert(file, "mesh:=../c.stl")
    assert "<out>package://arm/d.stl</out>" in yamaro.convert(file, mesh="package://arm/d.stl")


@pytest.mark.parametrize("mode", ["safe", "jail"])
def test_arguments_are_read_in_safe_mode_and_in_the_jail(mode: Any, tmp_path: Path) -> None:
    if mode == "jail" and jail.check_available() is not None:
        pytest.skip("there is no jail")
    policy = Policy(mode)
    assert built(ARM, policy, tilt=90, tag="a") == "1.5707963267949 4 a true 0 None"
    assert codes(ARM, policy, tilt=181) == ["argument-range <keyword argument>:1:1"]
    computed = "import: numpy as np\narguments: {a: {type: number, default: $(np.pi)}}\nout: $(a)\n"
    assert built(computed, policy) == "3.14159265358979"
    assert codes("arguments: {a: $(open('x'))}\nout:\n", Policy("safe")) == [
        "unsafe-code robot.yaml:1:18"
    ]


@given(
    low=st.floats(-1e6, 1e6),
    span=st.floats(0, 1e6),
    share=st.floats(-0.5, 1.5),
    unit=st.sampled_from(["m", "mm", "in", "deg", "rpm"]),
)
@settings(max_examples=examples(100), deadline=None)
def test_a_number_is_taken_within_its_range_only(
    low: float, span: float, share: float, unit: str
) -> None:
    high = low + span
    value = low + share * span
    text = f"arguments: {{a: {{unit: {unit}, range: [{low!r}, {high!r}]}}}}\nout: $(a)\n"
    is_near = math.isclose(value, low, rel_tol=1e-12) or math.isclose(value, high, rel_tol=1e-12)
    if low <= value <= high:
        assert built(text, a=value)
    elif not is_near:
        assert codes(text, a=value) == ["argument-range <keyword argument>:1:1"]
