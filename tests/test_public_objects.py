"""What people see of the objects that the package gives them: their names, and what they are."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest

import yamaro
from yamaro.yaml.nodes import FlexiDict

DOCS = Path(__file__).parents[1] / "docs"
ROBOT = """
robot: rover
arguments: {length: {default: 0.4, unit: m}}
base: free
model:
- material/name=red:
    color/rgba=1 0 0 1:
- part:
    name: base
    link:
      geometry: box
      scale: $(length) 0.2 0.1
      mass: 4
      visual: {material: red}
      collision: {surface: {friction: 0.8}}
      sensor/name=scan: {type: lidar, rate: 10, rays: 16}
      sensor/name=eye: {type: camera}
      sensor/name=near: {type: range}
      frame/name=tool0: {xyz: 0 0 1}
- part:
    name: head
    joint:
      type: revolute
      parent: base
      limit: {lower: -90deg, upper: 90deg, effort: 5, velocity: 3}
      dynamics: {damping: 1, friction: 1}
      safety_controller: {k_velocity: 1, soft_lower_limit: -1, soft_upper_limit: 1, k_position: 1}
      calibration: {rising: 0}
      actuator: {kp: 50}
    link: {geometry: sphere, scale: 0.1, mass: 1, visual: , collision: }
- part:
    name: ear
    joint:
      type: prismatic
      parent: head
      mimic: {joint: head, multiplier: 2}
      limit: {lower: -90mm, upper: 90mm, effort: 5, velocity: 3}
    link: {geometry: cylinder, scale: 0.1 0.2, mass: 1, visual: , collision: }
- print: hello
states: {home: {head: 0.5}}
groups: {neck: {chain: [base, head]}}
collisions: {samples: 100}
control: {plugin: some/System}
"""
PARTLY_PUBLIC = ("Span", "RecordedSpan", "ScalarNode", "Source", "Element", "Text", "Edit", "Fix")
"""Of these, the page says that only some attributes are public."""


def public_names(found: object) -> list[str]:
    return [name for name in dir(found) if not name.startswith("_")]


def reached(start: list[object]) -> Iterator[object]:
    """Yield objects of Yamaro's, and those that attributes, lists and mappings of them hold."""
    seen: set[int] = set()
    kept: list[object] = []  # so that no other object gets the identity of one that is gone
    while start:
        found = start.pop()
        kept.append(found)
        if id(found) in seen or len(seen) > 20_000:
            continue
        seen.add(id(found))
        if isinstance(found, (list, tuple, set)):
            start += found
        elif isinstance(found, FlexiDict):
            yield found
        elif isinstance(found, Mapping):
            start += found.values()
        elif type(found).__module__.startswith("yamaro"):
            yield found
            if type(found).__name__ in PARTLY_PUBLIC:
                continue
            values = (getattr(found, name) for name in public_names(found))
            start += [value for value in values if not callable(value)]


def objects(tmp_path: Path) -> list[object]:
    file = tmp_path / "rover.yaml"
    file.write_text(ROBOT, encoding="utf-8")
    build = yamaro.build(file, target="mjcf", on_message=print, advice=True)
    other = yamaro.build(file, variables={"length": 0.5}, on_message=print)
    given: list[object] = [
        build,
        build.outputs["mjcf"].losses,
        yamaro.load(file),
        build.robot.changes(other.robot),
        build.robot.differences(other.robot),
        build.robot.pose("tool0"),
        yamaro.Policy("safe", timeout=3, limits={"turns": 1000}),
        yamaro.FileLoader(),
        yamaro.MemoryLoader({"/a.yaml": ""}),
        yamaro.FlexiDict([("a", 1)]),
        yamaro.Sweep(tmp_path),
    ]
    (tmp_path / "wrong.yaml").write_text(ROBOT + "sates: {}\n", encoding="utf-8")
    try:
        yamaro.build(tmp_path / "wrong.yaml")
    except yamaro.YamaroError as error:
        given += [error.diagnostics, error]
    return given


def test_the_repr_of_each_public_object_says_what_it_is(tmp_path: Path) -> None:
    kinds = set()
    for found in reached(objects(tmp_path)):
        text = repr(found)
        name = type(found).__name__
        kinds.add(name)
        assert not re.search(r" object at 0x|\n", text), text
        assert name.lower() in text.lower() or isinstance(found, (str, yamaro.Diagnostic)), text
    assert {
        *("Build", "Robot", "Link", "Joint", "State", "Pose", "Program", "Diagnostic", "Limit"),
        *("Mimic", "Actuator", "Sensor", "Lidar", "Camera", "Ranger", "Group", "Control", "Base"),
        *(
            "Surface",
            "Frame",
            "Box",
            "Visual",
            "Material",
            "Loss",
            "Difference",
            "Change",
            "Motion",
        ),
        *("Policy", "Limits", "FileLoader", "MemoryLoader", "FlexiDict", "Sweep", "Element"),
    } <= kinds


def test_what_is_said_of_an_object_is_what_is_known_of_it(tmp_path: Path) -> None:
    file = tmp_path / "rover.yaml"
    file.write_text(ROBOT, encoding="utf-8")
    build = yamaro.build(file, on_message=print)
    robot = build.robot
    assert repr(build) == f"<Build of {file}: urdf>"
    assert repr(robot.states["home"]) == "<State 'home': {'head_joint': 0.5}>"
    limit = robot.joints["ear_joint"].limit
    assert repr(limit).startswith("<Limit lower=-0.09 upper=0.09 effort=5.0 velocity=3.0 at ")
    assert repr(limit).endswith("rover.yaml:37:7>")
    assert repr(yamaro.load(file)) == f"<Program {str(file)!r}>"
    assert repr(yamaro.Policy("safe", timeout=3)) == "<Policy mode='safe' timeout=3>"


def test_an_error_shows_what_is_wrong(tmp_path: Path) -> None:
    file = tmp_path / "wrong.yaml"
    file.write_text("launch:\n  a: $(1 +)\n  b: $(2 +)\n", encoding="utf-8")
    with pytest.raises(yamaro.YamaroError) as caught:
        yamaro.build(file)
    assert repr(caught.value).startswith(f"<YamaroError: <error[python-syntax] {file}:2:")
    assert repr(caught.value).endswith(" and 1 more>")


def test_dir_of_each_public_object_lists_what_the_docs_tell_of(tmp_path: Path) -> None:
    pages = [DOCS / name for name in ("api.md", "diff.md", "sweeps.md", "safety.md")]
    texts = [page.read_text(encoding="utf-8") for page in pages]
    told = set(re.findall(r"\w+", " ".join(texts).replace("-", "_")))
    inherited: dict[str, Any] = {"YamaroError": BaseException}
    unlisted = set()
    for found in reached(objects(tmp_path)):
        if type(found).__name__ in PARTLY_PUBLIC:
            continue
        own = set(public_names(found)) - set(dir(inherited.get(type(found).__name__, object)))
        unlisted |= {f"{type(found).__name__}.{name}" for name in own - told}
    assert sorted(unlisted) == []
