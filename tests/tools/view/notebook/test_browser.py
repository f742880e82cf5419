"""What a notebook shows, as a person uses it: in a browser, with nothing but the HTML."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import yamaro
from tests.tools.view.notebook.conftest import Browser
from tests.tools.view.test_page import reds, write_meshes
from tests.waiting import wait_for

PageOf = Callable[[Any], str]

FLAG = """\
robot: flag
model:
- material/name=red:
    color/rgba=0.9 0.05 0.05 1:
- part:
    name: pole
    link: {geometry: box, scale: 0.05 0.05 1, mass: 1, visual: , collision: }
- part:
    name: cloth
    joint:
      type: revolute
      parent: pole
      xyz: 0 0 0.4
      axis: z
      limit: {lower: -0.5, upper: 1.5, effort: 5, velocity: 2}
    link: {geometry: box, scale: 0.5 0.02 0.3, pivot: -0.25 0 0, mass: 0.1, visual: {material: red}}
states:
  open: {cloth_joint: 1.25}
"""
# What VS Code allows the output of notebooks, in which a frame takes part.
OF_VS_CODE = (
    "default-src 'none'; script-src 'unsafe-inline' 'unsafe-eval'; style-src 'unsafe-inline'; "
    "img-src https: data:; connect-src https:; child-src https: data:"
)


@pytest.fixture
def flag(tmp_path: Path) -> yamaro.Build:
    path = tmp_path / "flag.yaml"
    path.write_text(FLAG, encoding="utf-8")
    return yamaro.build(path)


def test_the_robot_is_drawn_and_its_sliders_move_it(
    flag: yamaro.Build, browser: Browser, page_of: PageOf
) -> None:
    browser.show(page_of(flag))
    before = browser.stage()
    assert reds(before) > 1000
    assert browser.run("document.querySelectorAll('#joints input[type=range]').length") == 1
    x, y = browser.middle_of("#joints input[type=range]")
    browser.drag(x, y, right=300)  # past its end
    assert browser.run("yamaro.robot.joints.get('cloth_joint').angle") == pytest.approx(1.5)
    assert (np.abs(browser.stage() - before).sum(axis=2) > 60).sum() > 1000
    browser.press("#joint-reset")
    assert browser.run("yamaro.robot.joints.get('cloth_joint').angle") == 0
    assert "2 links, 1 moving joint" in browser.run(
        "document.getElementById('summary').textContent"
    )


def test_named_states_move_the_joints(
    flag: yamaro.Build, browser: Browser, page_of: PageOf
) -> None:
    browser.show(page_of(flag))
    browser.run(
        "(() => { const s = document.getElementById('states'); s.value = 'open';"
        " s.dispatchEvent(new Event('change')); })()"
    )
    assert browser.run("yamaro.robot.joints.get('cloth_joint').angle") == pytest.approx(1.25)


def test_the_robot_is_shown_in_its_state_home(browser: Browser, page_of: PageOf) -> None:
    states = "  home: {cloth_joint: 0.75}\n  away: {}\n"
    browser.show(page_of(yamaro.build("flag.yaml", text=FLAG + states)))
    angle = "yamaro.robot.joints.get('cloth_joint').angle"
    assert browser.run(angle) == 0.75
    assert browser.run("document.getElementById('states').value") == "home"
    browser.run(
        "(() => { const s = document.getElementById('states'); s.value = 'away';"
        " s.dispatchEvent(new Event('change')); })()"
    )
    assert browser.run(angle) == 0


@pytest.mark.parametrize("policy", ["", OF_VS_CODE], ids=["plain", "as in VS Code"])
def test_the_frame_shows_it_as_a_robot_that_was_not_built(
    flag: yamaro.Build, browser: Browser, policy: str
) -> None:
    robot = yamaro.Robot.from_xml(flag.xml())
    head = f'<meta http-equiv="Content-Security-Policy" content="{policy}">' if policy else ""
    browser.show_html(f"<!doctype html><head>{head}</head><body>{robot._repr_html_()}</body>")
    browser.wait_for("document.querySelectorAll('iframe').length == 1")
    wait_for(lambda: reds(browser.picture()) > 1000)  # no script of this page sees into it


def test_all_formats_of_meshes_are_in_the_page(
    browser: Browser, page_of: PageOf, tmp_path: Path
) -> None:
    write_meshes(tmp_path)
    names = ("plain.stl", "plain.dae", "plain.obj", "plain.glb", "apart.gltf", "textured.obj",
             "textured.glb", "missing.stl")  # fmt: skip
    links = "".join(
        f'<link name="{name}"><visual><geometry><mesh filename="{name}"/></geometry></visual>'
        "</link>"
        f'<joint name="{name}" type="fixed"><parent link="root"/><child link="{name}"/>'
        f'<origin xyz="0 {number} 0"/></joint>'
        for number, name in enumerate(names)
    )
    path = tmp_path / "robot.urdf"
    path.write_text(f'<robot name="m"><link name="root"/>{links}</robot>', encoding="utf-8")
    browser.show(page_of(yamaro.Robot.from_urdf(path)))
    sizes = browser.run(
        "yamaro.robot.shapes.map(({link, group}) => [link, ...new yamaro.stage.Box3()"
        ".setFromObject(group).getSize(yamaro.stage.camera.position.clone()).toArray()])"
    )
    for name, *sides in sizes[:-1]:
        assert sides == pytest.approx([0.2, 0.4, 0.6], abs=1e-5), name
    assert len(sizes) == len(names)
    assert browser.run("document.getElementById('fault-list').textContent") == (
        "missing.stl: it was not found"
    )
    assert reds(browser.stage()) > 100  # the textures


def test_hostile_names_are_texts(browser: Browser, page_of: PageOf) -> None:
    names = ['</script><script>hacked=1</script>', '"><img src=x onerror=hacked=1>',
             "&quot;&lt;b&gt;", "${hacked=1}", "__proto__"]  # fmt: skip
    links = "".join(f'<link name="{_escaped(name)}"/>' for name in ["base", *names])
    joints = "".join(
        f'<joint name="{_escaped(name)}" type="continuous"><parent link="base"/>'
        f'<child link="{_escaped(name)}"/></joint>'
        for name in names
    )
    text = f'<robot name="{_escaped(names[0])}">{links}{joints}</robot>'
    browser.show(page_of(yamaro.Robot.from_xml(text)))
    shown = browser.run("[...document.querySelectorAll('#joints .name')].map(e => e.textContent)")
    assert sorted(shown) == sorted(names)
    assert browser.run("document.getElementById('name').textContent") == names[0]
    assert browser.run("typeof hacked") == "undefined"
    assert browser.run("document.images.length") == 0


def _escaped(name: str) -> str:
    return name.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")
