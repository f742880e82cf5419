"""SDF that is read and written again: Drake has to see the same robot in both."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

import yamaro
from tests.sources.sdf.same_sdf import Same, lost_texts

pytestmark = pytest.mark.skipif(not find_spec("pydrake"), reason="needs Drake")

MASS = """<inertial><pose>0.01 0.02 0.03 0.1 0.2 0.3</pose><mass>1.5</mass><inertia><ixx>0.02</ixx>
<ixy>0.001</ixy><ixz>0.002</ixz><iyy>0.03</iyy><iyz>0.003</iyz><izz>0.04</izz></inertia></inertial>"""
LIMIT = "<limit><lower>-1</lower><upper>2</upper><effort>5</effort><velocity>3</velocity></limit>"
BASE = f'<link name="base"><pose>0.1 0 0 0 0 0.4</pose>{MASS}</link>'


def link(name: str, pose: str = "", more: str = "") -> str:
    return f'<link name="{name}">{pose}{MASS}{more}</link>'


def joint(
    name: str, kind: str, child: str, more: str = "", parent: str = "base", axis: str = "0 0 1"
) -> str:
    axes = f"<axis><xyz>{axis}</xyz>{LIMIT}</axis>" if kind != "fixed" else ""
    ends = f"<parent>{parent}</parent><child>{child}</child>"
    return f'<joint name="{name}" type="{kind}">{ends}{axes}{more}</joint>'


ARM = link("arm", "<pose>0 0.2 0.5 0.3 -0.2 0.1</pose>")
MODELS = {
    "a link without inertial": '<link name="base"/>',
    "at the link": BASE + ARM + joint("j", "revolute", "arm", axis="0 1 1"),
    "beside the link": BASE
    + ARM
    + joint("j", "revolute", "arm", "<pose>0.1 0.2 0.3 0.3 0.2 0.1</pose>"),
    "along its axis": BASE + ARM + joint("j", "revolute", "arm", "<pose>0 0 0.3 0 0 0</pose>"),
    "a slider beside the link": BASE
    + ARM
    + joint("j", "prismatic", "arm", "<pose>0.1 0.2 0.3 0.3 0.2 0.1</pose>"),
    "relative to the parent": BASE
    + '<link name="arm"><pose relative_to="j"/>'
    + MASS
    + "</link>"
    + joint("j", "revolute", "arm", '<pose relative_to="base">0 0 1 0.1 0 0</pose>'),
    "an axis of another frame": BASE
    + ARM
    + '<frame name="tilted" attached_to="base"><pose>0 0 0 0.4 0.5 0.6</pose></frame>'
    + '<joint name="j" type="continuous"><parent>base</parent><child>arm</child>'
    + '<axis><xyz expressed_in="tilted">0 1 0</xyz></axis></joint>',
    "quaternions and degrees": BASE
    + '<link name="arm"><pose rotation_format="quat_xyzw">0 0 1 0.5 0.5 -0.5 0.5</pose>'
    + MASS
    + '</link><frame name="f"><pose degrees="true">1 2 3 30 60 90</pose></frame>'
    + joint("j", "revolute", "arm"),
    "held in the world": BASE + ARM + joint("j", "revolute", "arm") + joint(
        "w", "fixed", "base", "<pose>0.1 0.2 0 0 0 0</pose>", parent="world"
    ),
    "a cart in the world": BASE + joint("w", "prismatic", "base", parent="world", axis="1 0 0"),
    "two trees": BASE + ARM + link("other", "<pose>1 2 3 0.1 0.2 0.3</pose>") + joint(
        "j", "revolute", "arm"
    ),
    "a joint the other way": BASE
    + ARM
    + link("last", "<pose>1 0 1 0 0 0.3</pose>")
    + joint("j", "revolute", "arm")
    + joint("k", "revolute", "arm", "<pose>0 0.3 0.1 0 0 0.2</pose>", parent="last", axis="1 1 0"),
    "ball": BASE + ARM + '<joint name="j" type="ball"><parent>base</parent><child>arm</child>'
    "<pose>0.1 0.2 0.3 0 0.3 0</pose></joint>",
    "universal": BASE + ARM + '<joint name="j" type="universal"><parent>base</parent>'
    '<child>arm</child><pose>0.1 0.2 0.3 0 0.3 0</pose><axis><xyz expressed_in="base">1 0 0</xyz>'
    '</axis><axis2><xyz expressed_in="base">0 1 0</xyz></axis2></joint>',
    "screw": BASE + ARM + '<joint name="j" type="screw"><parent>base</parent><child>arm</child>'
    "<screw_thread_pitch>0.3</screw_thread_pitch><axis><xyz>0 0 1</xyz></axis></joint>",
    "springs and damping": BASE + ARM + '<joint name="j" type="revolute"><parent>base</parent>'
    "<child>arm</child><axis><xyz>0 0 1</xyz><limit><lower>-2</lower><upper>1e16</upper></limit>"
    "<dynamics><damping>0.3</damping><friction>0.1</friction><spring_reference>0.2"
    "</spring_reference><spring_stiffness>4</spring_stiffness></dynamics></axis></joint>",
    "a nested model": BASE + '<model name="hand"><pose relative_to="base">0 0 1 0.2 0 0</pose>'
    + link("palm", "<pose>0 0 0.1 0 0.2 0</pose>")
    + '<frame name="grip" attached_to="palm"><pose>0 0 0.1 0 0 0</pose></frame></model>'
    + joint("j", "revolute", "hand::palm", axis="1 0 0"),
    "a nested model placed by a frame": BASE
    + '<model name="hand" placement_frame="grip"><pose relative_to="base">0 0 1 0.2 0 0</pose>'
    + link("palm", "<pose>0 0 0.1 0 0.2 0</pose>")
    + '<frame name="grip" attached_to="palm"><pose>0 0.3 0.1 0 0 1</pose></frame></model>'
    + joint("j", "fixed", "hand::grip"),
    "a rotor of Drake": BASE + ARM + joint(
        "j", "revolute", "arm",
        "<drake:rotor_inertia>0.02</drake:rotor_inertia><drake:gear_ratio>9</drake:gear_ratio>",
    ),
    "shapes": link("base", more="".join(
        f'<{kind} name="{kind}{number}"><pose>{number} 0 0 0 0.1 0</pose><geometry>{shape}'
        f"</geometry></{kind}>"
        for number, shape in enumerate((
            "<box><size>1 2 3</size></box>", "<sphere><radius>0.5</radius></sphere>",
            "<cylinder><radius>1</radius><length>2</length></cylinder>",
            "<capsule><radius>1</radius><length>2</length></capsule>",
            "<ellipsoid><radii>1 2 3</radii></ellipsoid>",
        ))
        for kind in ("visual", "collision")
    )),
}  # fmt: skip


def again(folder: Path, model: str, **options: Any) -> tuple[Path, Path]:
    source, written = folder / "robot.sdf", folder / "again.sdf"
    head = '<sdf version="1.11" xmlns:drake="http://drake.mit.edu"><model name="robot">'
    source.write_text(f"{head}{model}</model></sdf>", encoding="utf-8")
    build = yamaro.build(source, target="sdf", **options)
    written.write_text(build.xml(), encoding="utf-8")
    return source, written


@pytest.mark.parametrize("name", MODELS)
def test_a_model_is_the_same_after_it_was_read_and_written(name: str, tmp_path: Path) -> None:
    source, written = again(tmp_path, MODELS[name])
    assert Same(source, written).run() == []
    assert lost_texts(source, written, None) == []


def test_models_are_included_and_merged_with_names_and_poses_of_their_own(tmp_path: Path) -> None:
    folder = tmp_path / "hand"
    folder.mkdir()
    (folder / "model.config").write_text(
        '<model><sdf version="1.5">old.sdf</sdf><sdf version="1.9">hand.sdf</sdf></model>'
    )
    hand = link("palm", "<pose>0 0 0.1 0 0.2 0</pose>") + link("thumb", "<pose>0 1 0 0 0 0</pose>")
    hand += joint("bend", "revolute", "thumb", parent="palm", axis="1 1 0")
    (folder / "hand.sdf").write_text(
        f'<sdf version="1.9"><model name="hand"><pose>9 9 9 0 0 0</pose>{hand}</model></sdf>'
    )
    include = "<include{}><uri>hand</uri><name>{}</name><pose>{}</pose></include>"
    model = (
        BASE
        + include.format("", "left", "0 1 0 0.1 0.2 0.3")
        + include.format(' merge="true"', "right", "0 -1 0 0.1 0.2 0.3")
        + joint("j", "fixed", "left::palm")
        + joint("k", "fixed", "palm")
    )
    source, written = again(tmp_path, model)
    flat = tmp_path / "flat.sdf"  # as Drake has it, which finds files and no folders
    flat.write_text(source.read_text().replace("<uri>hand<", f"<uri>file://{folder}/hand.sdf<"))
    assert Same(flat, written).run() == []


@pytest.mark.parametrize("version", ["1.2", "1.3", "1.4"])
def test_axes_of_old_versions_are_in_the_frame_of_the_model(version: str, tmp_path: Path) -> None:
    source, written = tmp_path / "robot.sdf", tmp_path / "again.sdf"
    root = "gazebo" if version == "1.2" else "sdf"
    place = "<pose>0.1 0.2 0.3 0.3 0.2 0.1</pose>"
    model = BASE + ARM + joint("j", "revolute", "arm", place, axis="1 2 3")
    source.write_text(f'<{root} version="{version}"><model name="r">{model}</model></{root}>')
    written.write_text(yamaro.build(source, target="sdf").xml())
    assert Same(source, written).run() == []
    assert yamaro.Robot.from_sdf(source).name == "r"


def test_a_model_of_a_world_is_chosen_by_its_name(tmp_path: Path) -> None:
    source, written = tmp_path / "world.sdf", tmp_path / "again.sdf"
    source.write_text(
        f'<sdf version="1.11"><world name="w"><model name="first">{BASE}</model>'
        f'<model name="second"><pose>1 2 3 0 0 1</pose>{BASE}{ARM}{joint("j", "revolute", "arm")}'
        '</model><joint name="held" type="fixed"><parent>world</parent><child>second::base</child>'
        "</joint></world></sdf>"
    )
    written.write_text(yamaro.build(source, target="sdf", model="second").xml())
    assert Same(source, written, model="second").run() == []
