"""Blocks for one output format: XML for the link, joint or robot that they are in."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.targets.stub import write_with_stub
from yamaro import Policy, build
from yamaro.sandbox.jail import check_available
from yamaro.xml.writer import write

if TYPE_CHECKING:
    from yamaro.model.extras import RawXml
    from yamaro.result import Build


@pytest.fixture(autouse=True)
def _formats(monkeypatch: pytest.MonkeyPatch) -> None:
    write_with_stub(monkeypatch)


def put(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


def told(raw: RawXml) -> tuple[str, str]:
    home = f"link {raw.link}" if raw.link else f"joint {raw.joint}" if raw.joint else "robot"
    return home, " ".join(write(each).split("\n", 1)[1].strip() for each in raw.elements)


BODY = "geometry: sphere, radius: 1, mass: 1"
ARM = f"""\
robot: arm
functions:
  Site(name):
    mjcf:
    - site/name=$(name): {{size: 1}}
model:
- part: {{name: base, link: {{{BODY}}}}}
- part:
    name: arm
    joint:
      type: continuous
      parent: base
      mjcf: {{note/a=1: }}
      sdf: {{physics: {{provide_feedback: true}}}}
    link:
      {BODY.replace(", ", chr(10) + "      ")}
      Site: tip
      sdf: {{enable_wind: true}}
    mjcf: {{option/timestep=0.001: }}
- mjcf:
  - for i in range(2):
    - actuator:
        motor/joint=arm_joint, gear=$(i):
"""


MOTOR = '<actuator>\n  <motor joint="arm_joint" gear="{}"/>\n</actuator>'


def raw_of(built: Build, format: str) -> list[tuple[str, str]]:
    return [told(each) for each in built.robot.raw(format)]


def test_blocks_are_for_what_they_are_in(tmp_path: Path) -> None:
    path = put(tmp_path / "robot.yaml", ARM)
    built = build(path, target="mjcf", base="free", allow=["lost-in-mjcf"])
    assert sorted(raw_of(built, "mjcf")) == [
        ("joint arm_joint", '<note a="1"/>'),
        ("link arm_link", '<site name="tip">\n  <size>1</size>\n</site>'),
        ("robot", " ".join([MOTOR.format(0), MOTOR.format(1)])),
        ("robot", '<option timestep="0.001"/>'),
    ]
    assert not built.robot.raw("sdf")
    assert [each.code for each in built.warnings] == ["lost-in-mjcf"]  # no unknown elements
    sdf = build(path, target="sdf", allow=["lost-in-sdf"])
    assert [home for home, _ in raw_of(sdf, "sdf")] == ["joint arm_joint", "link arm_link"]
    assert not build(path).robot.raw("mjcf")


def test_a_block_knows_its_place_and_the_calls_that_led_there(tmp_path: Path) -> None:
    path = put(tmp_path / "robot.yaml", ARM)
    built = build(path, target="mjcf")
    site = next(each for each in built.robot.raw("mjcf") if each.link)
    assert site.span.location()[0] == 4
    assert site.elements[0].span.location()[0] == 5
    assert site.trace is not None
    assert (site.trace.kind, site.trace.name) == ("called", "Site")


def test_parts_in_a_block_of_the_model_are_parts(tmp_path: Path) -> None:
    text = f"""\
model:
- part: {{name: base, link: {{{BODY}}}}}
- mjcf:
  - part: {{name: extra, joint: {{type: fixed, parent: base}}}}
  - option/gravity=0:
  - loop: {{name: bar, type: ball, between: [base, extra]}}
"""
    path = put(tmp_path / "robot.yaml", text)
    built = build(path, target="mjcf")
    assert list(built.robot.links) == ["base_link", "extra_link"]
    assert list(built.robot.loops) == ["bar"]
    assert raw_of(built, "mjcf") == [("robot", '<option gravity="0"/>')]
    assert list(build(path).robot.links) == ["base_link"]


def test_an_attached_robot_has_its_prefix_in_blocks_too(tmp_path: Path) -> None:
    put(
        tmp_path / "gripper.yaml",
        f"""\
model:
- part:
    name: palm
    link: {{{BODY}, mjcf: {{site/name=grip: }}}}
- mjcf:
  - sensor:
      framepos/objtype=body, objname=palm_link, name=pose:
""",
    )
    text = f"""\
model:
- part: {{name: base, link: {{{BODY}}}}}
- attach: {{path: gripper.yaml, to: base, prefix: left_}}
- attach: {{path: gripper.yaml, to: base, prefix: right_}}
"""
    built = build(put(tmp_path / "robot.yaml", text), target="mjcf")
    assert [home for home, _ in raw_of(built, "mjcf")] == [
        "link left_palm_link",
        "robot",
        "link right_palm_link",
        "robot",
    ]
    assert 'objname="left_palm_link"' in raw_of(built, "mjcf")[1][1]


def test_blocks_are_mirrored_like_other_raw_xml(tmp_path: Path) -> None:
    text = f"""\
model:
- part: {{name: base, link: {{{BODY}}}}}
- mirror:
    rename: {{left: right}}
    body:
    - part:
        name: left_arm
        joint: {{type: continuous, parent: base, mjcf: {{note/joint=left_arm_joint: }}}}
        link: {{{BODY}, mjcf: {{site/pos=0 1 0: }}}}
"""
    built = build(put(tmp_path / "robot.yaml", text), target="mjcf", base="free")
    assert raw_of(built, "mjcf") == [
        ("joint left_arm_joint", '<note joint="left_arm_joint"/>'),
        ("link left_arm_link", '<site pos="0 1 0"/>'),
        ("joint right_arm_joint", '<note joint="right_arm_joint"/>'),
        ("link right_arm_link", '<site pos="0 1 0"/>'),
    ]
    assert [each.code for each in built.warnings] == ["mirror-raw", "lost-in-mjcf"]


@pytest.mark.skipif(check_available() is not None, reason="no jail here")
def test_blocks_come_out_of_a_jail(tmp_path: Path) -> None:
    path = put(tmp_path / "robot.yaml", ARM)
    free = build(path, target="mjcf")
    jailed = build(path, target="mjcf", policy=Policy("jail"))
    assert raw_of(jailed, "mjcf") == raw_of(free, "mjcf")


def test_a_urdf_run_has_the_same_bytes_as_before(tmp_path: Path) -> None:
    path = put(tmp_path / "robot.yaml", ARM)
    assert build(path, target=["mjcf", "urdf"]).outputs["urdf"].xml() == build(path).xml()
