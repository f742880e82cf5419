"""What the page in a notebook has to know about a robot besides its URDF."""

from __future__ import annotations

from ...model.joint import FIXED
from ..view.description import finite_positions
from .files import mesh_of, texture_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.link import Collision, Visual
    from ...model.robot import Robot
    from ...xml.tree import Element
    from .files import Json, PageFiles


def describe(robot: Robot, files: PageFiles) -> Json:
    """Return the files of its shapes, its named states, and a line about it.

    Where things are written is left out: a notebook is passed on to people who do not have the
    files, and paths say much about the machine.
    """
    links: Json = {
        name: {
            "visual": [_shape(visual, files) for visual in link.visuals],
            "collision": [_shape(collision, files) for collision in link.collisions],
        }
        for name, link in robot.links.items()
    }
    return {
        "links": links,
        "textures": _textures(robot, files),
        "states": {name: finite_positions(state.positions) for name, state in robot.states.items()},
        "summary": summary(robot),
    }


def _shape(section: Visual | Collision, files: PageFiles) -> Json:
    mesh, texture = mesh_of(section), texture_of(section)
    found: Json = {}
    if mesh is not None:
        found["mesh"] = files.of(mesh)
    if texture is not None:
        found["texture"] = _texture(texture, files)
    return found


def _textures(robot: Robot, files: PageFiles) -> Json:
    """Return the textures of materials by the materials' names."""
    found: Json = {}
    for name, material in robot.materials.items():
        texture = material.inner("texture")
        if texture is not None and (file := _texture(texture, files)):
            found[name] = file
    return found


def _texture(element: Element, files: PageFiles) -> Json | None:
    file = files.of(element)
    return None if "fault" in file else file


def summary(robot: Robot) -> str:
    """Return a line about a robot."""
    moving = sum(joint.type != FIXED for joint in robot.joints.values())
    words = [_counted(len(robot.links), "link"), _counted(moving, "moving joint")]
    if robot.mass > 0:
        words.append(f"{robot.mass:.4g} kg")
    return ", ".join(words)


def _counted(count: int, noun: str) -> str:
    return f"{count:,} {noun}{'' if count == 1 else 's'}"
