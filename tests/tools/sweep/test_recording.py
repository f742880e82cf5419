"""Variants that are replayed, against builds of the same variants, byte for byte."""

from __future__ import annotations

import itertools
import math
import random
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import yamaro
from tests.consumers.oracles import require_module
from yamaro.commands.main import main
from yamaro.model.convex import Convex, overlapping
from yamaro.model.pose import ZERO, Pose, rotation_from_rpy
from yamaro.model.shapes import Box, Capsule, Cylinder, Sphere
from yamaro.options import Options
from yamaro.program import Program
from yamaro.tools.sweep.builder import Builder
from yamaro.tools.sweep.columns import Columns
from yamaro.tools.sweep.recording import Number, Tape, record
from yamaro.tools.sweep.study import planned, read_study
from yamaro.tools.sweep.table import Row

EXAMPLES = Path(__file__).parents[3] / "examples"

ROBOT = """\
robot: crane
import: [math, helpers]
arguments:
  length: {default: 300 mm, unit: mm, range: [100, 500]}
  load: {default: 2, range: [1, 4]}
  cross: {default: 0.001, range: [0, 0.002]}
  tilt: {default: 10 deg, unit: deg, range: [-20, 20]}
  gain: {default: 10, range: [5, 50]}
  slices: {type: integer, default: 3, range: [1, 3]}
variables:
  half: $(length / 2)
  text: 0 $(-half) $(max(length, 0.25))
model:
- part: {name: base, link: {geometry: box, size: 200mm 20cm $(half), mass: $(load)}}
- part:
    name: boom
    joint:
    - {type: revolute, parent: base, xyz: $(text), rpy: 0 $(tilt) 0.1, axis: y}
    - limit:
        {lower: -1, upper: "$(math.atan2(length, 1))", effort: "$(round(gain, 1))", velocity: 3}
    - dynamics: {damping: $(gain / 100), friction: $(gain ** 0.5 / 100)}
    - actuator: {command: position, frequency: $(gain / 10), armature: $(0.1 / slices)}
    link:
    - {geometry: cylinder, radius: $(helpers.thickness(load)), length: $(length)}
    - {visual: , collision: }
    - inertial:
        mass: $(sum([load / slices for i in range(slices)]))
        xyz: 0 0 $(half)
        inertia: 0.01 $(cross) 0 0.01 0 $(0.012 if load > 2 else 0.008)
- mirror:
    rename: {left: right}
    body:
    - part:
        name: left_claw
        joint: {type: fixed, parent: boom, xyz: 0 $(half) 0, rpy: $(tilt) 0 0}
        link: {geometry: sphere, radius: $(cross + 0.05), density: 900, visual: , collision: }
- gazebo/reference=left_claw_link: {mu1: $(1 / load), mu2: 0.5}
states: {home: {boom: $(-tilt)}}
"""
HELPERS = """\
from math import sqrt
def thickness(load):
    return sqrt(load) / 100
"""
XACRO = """\
<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="legs">
  <xacro:arg name="length" default="0.3"/>
  <xacro:arg name="load" default="1.5"/>
  <xacro:property name="l" value="$(arg length)"/>
  <link name="base"/>
  <xacro:macro name="leg" params="name y">
    <link name="${name}">
      <inertial>
        <mass value="$(arg load)"/>
        <inertia ixx="${l**2/12}" iyy="${l*l/12}" izz="0.001" ixy="0" ixz="0" iyz="0"/>
      </inertial>
      <collision>
        <origin xyz="0 0 ${-l/2}" rpy="0 ${sin(l)} 0"/>
        <geometry><box size="0.02 0.02 $(arg length)"/></geometry>
      </collision>
    </link>
    <joint name="hip_${name}" type="revolute">
      <parent link="base"/><child link="${name}"/>
      <origin xyz="0 ${y} 0"/><axis xyz="0 1 0"/>
      <limit lower="-1" upper="1" effort="$(arg load)" velocity="2"/>
    </joint>
  </xacro:macro>
  <xacro:leg name="left" y="${l}"/>
  <xacro:leg name="right" y="${-l}"/>
</robot>
"""
HARD = """\
robot: hard
arguments:
  length: {default: 0.3}
  yaw: {default: 10 deg, unit: deg}
  load: {default: 2}
  reach: {default: 0.7}
variables:
  most: $(min(max(reach, 0.4), 1.0))
model:
- part: {name: base, link: {geometry: cylinder, radius: $(length), length: 0.1, mass: $(load)}}
- for i in range(3):
  - part:
      name: leg$(i)
      joint:
      - {type: revolute, parent: base, axis: y, rpy: "0 0 $(2 * pi * i / 3 + yaw)"}
      - {xyz: $(length * cos(2 * pi * i / 3 + reach)) $(length * sin(2 * pi * i / 3 + reach)) 0}
      - limit: {lower: $(-most), upper: $(most if load > 2 else most / 2), effort: 9, velocity: 3}
      - actuator: {command: position, kp: $(10 * load), kd: 1}
      link:
      - {geometry: box, size: 0.05 0.05 $(length), pivot: 0 0 $(length / 2), collision: }
      - inertial:
          mass: $(load)
          xyz: 0 0 $(-length / 2)
          inertia: 0.01 $(0.001 * (load - 2)) 0 0.012 0 0.013
  - part:
      name: foot$(i)
      joint: {type: fixed, parent: leg$(i), xyz: 0 0 $(-length), rpy: $(yaw) 0 0}
      link: {geometry: sphere, radius: $(0.02 if reach < 0.7 else 0.03), mass: 0.1, collision: }
"""
RANGES: dict[str, dict[str, tuple[float, float]]] = {
    "robot.yaml": {
        "length": (100, 500), "load": (1, 4), "cross": (0, 0.002), "tilt": (-20, 20),
        "gain": (5, 50),
    },
    "legs.xacro": {"length": (0.2, 0.4), "load": (1, 2)},
}  # fmt: skip


@pytest.fixture(autouse=True)
def robot(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("robot.yaml").write_text(ROBOT)
    Path("helpers.py").write_text(HELPERS)
    Path("legs.xacro").write_text(XACRO)


def document(program: Program, arguments: dict[str, float]) -> str:
    return program.compile(
        program.options.changed(variables=arguments), lambda build: build.outputs["mjcf"].xml()
    )


def program_of(path: str | Path) -> Program:
    return Program(path, Options(target=["mjcf"], on_message=lambda _: None))


@pytest.mark.parametrize("path", RANGES)
def test_what_is_recorded_gives_the_documents_of_builds_or_none(path: str) -> None:
    program = program_of(path)
    chance = random.Random(5)
    ranges = RANGES[path]
    draws = [{name: chance.uniform(*ends) for name, ends in ranges.items()} for _ in range(30)]
    found = record(draws[0], list(ranges), lambda given: document(program, given))
    assert found is not None
    columns = Columns(found, [*zip(*(draw.values() for draw in draws), strict=True)])
    same = [
        "".join(columns.pieces(row)) == document(program, draws[row])
        for row in columns.good.nonzero()[0]
    ]
    assert all(same)
    assert len(same) > 5


def test_nothing_is_replaced_after_recording() -> None:
    program = program_of("robot.yaml")
    before = document(program, {"load": 1.1})
    record({"load": 1.1}, ["load"], lambda given: document(program, given))
    assert document(program, {"load": 1.1}) == before
    assert math.sin(0.5) == pytest.approx(0.479425538604203)


@pytest.mark.parametrize(
    "expression",
    [
        "{0.5: 1}.get(load, 2)",  # which other numbers would find
        "numpy.cos(load)",  # which no longer is that of the processor's vectors
        "struct.unpack('d', struct.pack('d', load))[0]",
    ],
)
def test_what_needs_plain_numbers_is_not_recorded(expression: str) -> None:
    Path("plain.yaml").write_text(
        "robot: plain\nimport: [numpy, struct]\narguments: {load: {default: 1.5}}\nmodel:\n"
        f'- part: {{name: a, link: {{geometry: sphere, radius: "$({expression})", mass: 1}}}}\n'
    )
    program = program_of("plain.yaml")
    document(program, {"load": 1.2})
    assert record({"load": 1.2}, ["load"], lambda given: document(program, given)) is None


def rows_of(path: str | Path, axes: dict[str, str], samples: int, *, first: int = 0) -> Builder:
    study = read_study(str(path), Options().policy.limits)
    study.samples = samples
    plan = planned(study, Options(), axes=axes)
    plan.formats, plan.is_batch, plan.is_recorded, plan.first = ["mjcf"], True, True, first
    return Builder(plan)


def test_most_variants_of_a_quadruped_are_replayed(monkeypatch: pytest.MonkeyPatch) -> None:
    require_module("mujoco")
    axes = {"thigh_length": "0.15..0.3", "calf_length": "0.15..0.3", "stand_height": "0.28..0.4"}
    builder = rows_of(EXAMPLES / "quadruped/quadruped.yaml", axes, 64)
    built: list[int] = []
    compare = Builder._compare

    def note(self: Builder, row: Row, build: yamaro.Build) -> None:
        built.append(row.index)
        compare(self, row, build)

    monkeypatch.setattr(Builder, "_compare", note)
    rows = [*builder.rows(0, 64)]
    assert {row.status for row in rows} == {"ok"}
    assert len(built) < 6


def run(*words: str) -> int:
    return main(["sweep", *words, "--engine", "local:1", "--batch", "out.npz"])


def arrays(path: str, names: Sequence[str]) -> tuple[np.ndarray, np.ndarray]:
    """Return the masses of a batch, and those of builds by MuJoCo."""
    mujoco = require_module("mujoco")
    batch = np.load("out.npz")
    built = []
    for row in range(len(batch["id"])):
        given = {name: float(batch[f"arguments/{name}"][row]) for name in names}
        build = yamaro.build(path, target="mjcf", variables=given, on_message=lambda _: None)
        built.append(mujoco.MjModel.from_xml_string(build.xml()).body_mass)
    return batch["body_mass"], np.array(built)


def test_what_recording_misses_is_seen_and_built(capsys: pytest.CaptureFixture[str]) -> None:
    Path("lost.yaml").write_text(
        "robot: lost\narguments: {load: {default: 0.2}}\nmodel:\n"
        "- part: {name: a, link: {geometry: sphere, radius: 1, mass: $(len(str(load)) / 4)}}\n"
    )  # the length of a text, which is by chance that of the mark for 0.25
    require_module("mujoco")
    assert run("lost.yaml", "load=0.25..0.75/25", "--method", "grid") == 0
    assert "all variants were built one by one" in capsys.readouterr().err
    found, built = arrays("lost.yaml", ["load"])
    np.testing.assert_array_equal(found, built)


def test_warnings_and_errors_of_some_variants_are_reported_with_their_arguments(
    capsys: pytest.CaptureFixture[str],
) -> None:
    Path("corner.yaml").write_text(
        "robot: corner\narguments: {load: {default: 1}}\nmodel:\n"
        "- part: {name: a, link: {geometry: sphere, radius: 1, mass: 1}}\n"
        "- part:\n    name: b\n"
        "    joint: {type: fixed, parent: a, rpy: 0 0 $(load)}\n"
        "    link: {geometry: sphere, radius: $(9 - load), mass: $(load)}\n"
    )
    require_module("mujoco")
    assert run("corner.yaml", "load=1..10/31", "--method", "grid") == 0
    message = capsys.readouterr().err
    assert "27 of 31 variants, 4 failed" in message
    assert "  4 × bad-size at corner.yaml:8:38\n      such as 27 (load:=9.1): a sphere" in message
    assert "9 × angle-too-large at corner.yaml:7:42\n      such as 18 (load:=6.4)" in message
    found, built = arrays("corner.yaml", ["load"])
    np.testing.assert_array_equal(found, built)


def test_variants_with_other_outcomes_are_replayed_apart(
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Loops with places that depend on numbers, conditions, limits that are met, moments, turns."""
    Path("hard.yaml").write_text(HARD)
    mujoco = require_module("mujoco")
    axes = {"length": (0.1, 0.5), "yaw": (-90, 90), "load": (0.5, 4), "reach": (0.2, 1.4)}
    words = [f"{name}={low}..{high}" for name, (low, high) in axes.items()]
    assert run("hard.yaml", *words, "--samples", "200") == 0
    assert "one by one" not in capsys.readouterr().err
    batch = np.load("out.npz")
    one = mujoco.MjModel.from_xml_path("out.xml")
    for row in range(3, 200, 20):
        given = {name: float(batch[f"arguments/{name}"][row]) for name in axes}
        build = yamaro.build("hard.yaml", target="mjcf", variables=given)
        alone = mujoco.MjModel.from_xml_string(build.xml())
        for name in dir(alone):
            value = getattr(alone, name)
            if name[0] != "_" and isinstance(value, np.ndarray):
                found = batch[name][row] if name in batch.files else getattr(one, name)
                np.testing.assert_allclose(found, value, rtol=0, atol=1e-12, err_msg=name)
        assert abs(batch["stat.extent"][row] - alone.stat.extent) < 1e-12


def may_touch(one: str, other: str) -> bool:
    return True


def test_what_overlaps_is_the_same_for_many_variants_at_once() -> None:
    chance = random.Random(11)
    kinds: tuple[Any, ...] = (
        Box(0.3, 0.2, 0.5),
        Cylinder(0.15, 0.4),
        Capsule(0.1, 0.3),
        Sphere(0.2),
    )
    outcomes = set()
    for one, other in itertools.product(kinds, repeat=2):
        turns = [rotation_from_rpy(*(chance.uniform(-3, 3) for _ in range(3))) for _ in range(2)]
        rows = [[chance.uniform(-0.4, 0.4) for _ in range(3)] for _ in range(100)]

        tape = Tape(3)
        recorded = [Number(tape, at, value) for at, value in enumerate(rows[0])]
        places: list[Any] = [tuple(recorded), *map(tuple, rows)]
        placed = [
            [Convex(Pose(turns[0], ZERO), one), Convex(Pose(turns[1], place), other)]
            for place in places
        ]
        tape.settle(overlapping, placed[0], ["a", "b"], may_touch)
        good = Columns(tape.recording(""), [*zip(*rows, strict=True)]).good
        expected = [bool(overlapping(each, ["a", "b"], may_touch)) for each in placed[1:]]
        assert good.tolist() == [each == expected[0] for each in expected]
        outcomes.update(expected)
    assert outcomes == {True, False}
