"""Blocks for one format in a visual, a collision and a frame; words and blocks by `$(…)`."""

from __future__ import annotations

import pytest

import yamaro
from yamaro.xml.tree import Element
from yamaro.xml.values import format_value

Said = tuple[str, dict[str, str], str, "list[Said]"]

CRANE = """
robot: crane
base: fixed
variables:
  rubber: {condim: 6, priority: 1, solimp: 0.015 1 0.031}
  grip: {friction: 0.8}
  servo: {command: velocity, kd: 2}
  extra: {armature: 0.02, frictionloss: 0.3}
  hit: {surface: {contact: {collide_bitmask: 3}}}
  upright: {xyz: 0 0 1}
model:
- part:
    name: base
    link:
      geometry: sphere
      scale: 0.1
      mass: 1
      visual/name=shell: {mjcf: {group: 1}, sdf: {transparency: 0.5}}
      collision/name=foot: {surface: $(grip), mjcf: $(rubber), sdf: $(hit)}
      frame/name=head: {xyz: 0 0 1, mjcf: {size: 0.02, group: 5}}
      frame/name=crown: $(upright)
- part:
    name: arm
    joint: {type: continuous, parent: base, actuator: $(servo), mjcf: $(extra)}
    link: {mass: 1, geometry: sphere, scale: 0.1}
"""


def what(element: Element) -> Said:
    """Return an element as nested tuples of texts."""
    attributes = {name: format_value(value) for name, value in element.attributes.items()}
    inner = [what(child) for child in element.elements()]
    return (element.name, attributes, element.text().strip(), inner)


def notes_for(target: str) -> list[Said]:
    """Return the notes of the crane, built for a format."""
    return [what(each) for each in yamaro.build("crane.yaml", text=CRANE, target=target).notes]


def test_blocks_in_sections_become_blocks_of_the_link() -> None:
    notes = notes_for("mjcf")
    visual: Said = ("geom", {"name": "shell", "group": "1"}, "", [])
    rubber = {"name": "foot", "condim": "6", "priority": "1", "solimp": "0.015 1 0.031"}
    home = {"format": "mjcf", "link": "base_link"}
    assert ("raw-block", home, "", [visual]) in notes
    assert ("raw-block", home, "", [("geom", rubber, "", [])]) in notes
    head: list[Said] = [("size", {}, "0.02", []), ("group", {}, "5", [])]
    assert ("raw-block", {"format": "mjcf", "link": "head"}, "", head) in notes


def test_blocks_for_sdf_are_in_the_element_of_the_section() -> None:
    notes = notes_for("sdf")
    home = {"format": "sdf", "link": "base_link"}
    seen: Said = ("visual", {"name": "shell"}, "", [("transparency", {}, "0.5", [])])
    assert ("raw-block", home, "", [seen]) in notes
    bits: Said = ("contact", {}, "", [("collide_bitmask", {}, "3", [])])
    hit: Said = ("collision", {"name": "foot"}, "", [("surface", {}, "", [bits])])
    assert ("raw-block", home, "", [hit]) in notes


def test_a_mapping_can_be_an_actuator_a_surface_a_frame_and_a_block() -> None:
    notes = notes_for("mjcf")
    actuator = {"joint": "arm_joint", "command": "velocity", "kd": "2"}
    assert ("actuator", actuator, "", []) in notes
    surface = {"link": "base_link", "index": "0", "friction": "0.8"}
    assert ("surface", surface, "", []) in notes
    extra: list[Said] = [("armature", {}, "0.02", []), ("frictionloss", {}, "0.3", [])]
    assert ("raw-block", {"format": "mjcf", "joint": "arm_joint"}, "", extra) in notes
    robot = yamaro.build("crane.yaml", text=CRANE).robot
    assert robot.joints["crown_joint"].origin.position == (0, 0, 1)


@pytest.mark.parametrize("word", ["actuator: 5", "surface: rough"])
def test_a_text_is_no_word(word: str) -> None:
    part = "joint: {type: continuous, parent: base, actuator: 5}"
    if word.startswith("surface"):
        part = "link: {geometry: sphere, scale: 1, collision: {surface: rough}}"
    text = f"robot: crane\nmodel:\n- part: {{name: base}}\n- part: {{name: arm, {part}}}\n"
    with pytest.raises(yamaro.YamaroError) as caught:
        yamaro.build("crane.yaml", text=text)
    assert {each.code for each in caught.value.diagnostics} == {"not-a-body"}


def test_blocks_of_one_section_are_one() -> None:
    text = CRANE.replace("mjcf: $(rubber)", "mjcf: {condim: 1}, Firm: ")
    text = text.replace("model:", "functions:\n  Firm():\n    mjcf: {priority: 2}\nmodel:")
    notes = yamaro.build("crane.yaml", text=text, target="mjcf").notes
    geoms = [what(each) for note in notes if note.name == "raw-block" for each in note.elements()]
    assert ("geom", {"name": "foot", "condim": "1", "priority": "2"}, "", []) in geoms
