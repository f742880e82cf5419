"""The model: calls what writes its parts, and puts them together."""

from __future__ import annotations

from ...diagnostics import YamaroError
from ...xml.tree import Element
from ..output import Output
from .actuators import add_actuators
from .assets import Looks
from .bodies import add_bodies, put_on_floor, sort_bodies
from .contacts import add_excludes
from .defaults import head
from .equalities import add_loops, add_mimics
from .geoms import add_geoms
from .keyframes import add_keyframes
from .leftovers import lose_leftovers
from .raw import add_raw
from .scene import scene
from .sensors import add_sensors
from .writing import Writing

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.robot import Robot
    from ..output import Wanted

SCENE = "scene.xml"
"""The file beside the document with a floor and a light."""


def write(robot: Robot, wanted: Wanted) -> Output:
    """Return a robot as MJCF, with the scene and the meshes that belong beside it.

    Raises:
        YamaroError: MuJoCo would refuse it, such as a mesh that is not there.
    """
    writing = Writing(robot, wanted)
    add_bodies(writing)
    add_geoms(writing, Looks(writing))
    add_actuators(writing)
    add_sensors(writing)
    put_on_floor(writing)
    add_excludes(writing)
    add_mimics(writing)
    add_loops(writing)
    raw = add_raw(writing)
    sort_bodies(writing)
    add_keyframes(writing, raw)
    lose_leftovers(writing)
    if writing.errors:
        raise YamaroError(writing.errors)
    root = Element("mujoco", robot.span, {"model": writing.model}, trace=robot.element.trace)
    root.children += head(writing)
    root.children += [each for each in writing.sections.values() if each.children]
    root.children += raw
    files = {SCENE: scene(writing, wanted.file_name or f"{wanted.name}.xml"), **writing.files}
    return Output(root, writing.losses, files)
