"""Which links of a robot touch in Drake and in simulators that read USD: the same as in MuJoCo."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

import pytest

import yamaro
from tests.consumers.oracles import require_module

# Links in a row. The third one is turned into the first; between it and the fourth one there is a
# link without shapes, and the fifth is far from all.
TURNED = """\
robot: chain
base: fixed
model:
- part: {name: a, link: {geometry: box, size: 1 0.2 0.2, mass: 1, collision: }}
- part:
    name: b
    joint: {type: continuous, parent: a, xyz: 0.5 0 0, axis: z}
    link: {geometry: box, size: 0.1 0.1 0.1, mass: 1, collision: }
- part:
    name: c
    joint: {type: continuous, parent: b, xyz: 0.5 0 0, axis: z}
    link: {geometry: box, size: 0.4 0.2 0.2, mass: 1, collision: }
- part:
    name: bare
    joint: {type: continuous, parent: c, xyz: 0 0 0.5, axis: z}
    link: {geometry: sphere, radius: 0.1, mass: 1}
- part:
    name: d
    joint: {type: continuous, parent: bare, xyz: 0 0 0.5, axis: z}
    link: {geometry: sphere, radius: 0.1, mass: 1, collision: }
- part:
    name: e
    joint: {type: continuous, parent: d, xyz: 0 0 3, axis: z}
    link: {geometry: sphere, radius: 0.1, mass: 1, collision: }
states: {home: {b: 180deg}}
"""
KEEP = "collisions: {keep: [[c_link, a_link]]}\n"
CASES = [("", {("a", "c"), ("c", "d")}), (KEEP, {("c", "d")})]
"""What is added, and which links do not touch besides those that a joint connects."""
JOINED = {("a", "b"), ("b", "c"), ("d", "e")}


def built(text: str, target: str) -> yamaro.Build:
    build = yamaro.build("chain.yaml", text=text, target=target, on_message=print)
    lost = [each.owner for each in build.losses if "overlap at home" in each.what]
    assert lost == ([] if KEEP in text else ["links 'a_link' and 'c_link'"])
    return build


@pytest.mark.parametrize(("more", "apart"), CASES)
def test_drake_has_no_contacts_of_links_that_disturb(
    more: str, apart: set[tuple[str, str]]
) -> None:
    require_module("pydrake")
    from pydrake.multibody.parsing import Parser
    from pydrake.multibody.plant import AddMultibodyPlantSceneGraph
    from pydrake.systems.framework import DiagramBuilder

    build = built(TURNED + more, "sdf")
    builder = DiagramBuilder()
    plant, graph = AddMultibodyPlantSceneGraph(builder, 1e-3)
    Parser(plant).AddModelsFromString(build.xml(), "sdf")
    plant.Finalize()
    inspector = graph.model_inspector()
    shapes = {
        name: plant.GetCollisionGeometriesForBody(plant.GetBodyByName(f"{name}_link"))[0]
        for name in "abcde"
    }
    found = {
        (one, other)
        for one, other in combinations("abcde", 2)
        if inspector.CollisionFiltered(shapes[one], shapes[other])
    }
    assert found == apart | JOINED


@pytest.mark.parametrize(("more", "apart"), CASES)
def test_usd_says_which_links_do_not_touch(
    more: str, apart: set[tuple[str, str]], tmp_path: Path
) -> None:
    require_module("pxr")
    from pxr import Usd, UsdPhysics

    path = tmp_path / "chain.usda"
    path.write_text(built(TURNED + more, "usd").xml())
    stage = Usd.Stage.Open(str(path))
    found = {
        (prim.GetName()[0], target.name[0])
        for prim in stage.Traverse()
        if prim.HasAPI(UsdPhysics.FilteredPairsAPI)
        for target in UsdPhysics.FilteredPairsAPI(prim).GetFilteredPairsRel().GetTargets()
    }
    assert found == apart
