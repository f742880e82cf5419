"""The model: calls what writes its parts, and puts them together."""

from __future__ import annotations

from ...diagnostics import YamaroError
from ...model.joint import FLOATING, PLANAR, SINGLE
from ...xml.tree import Element
from ...xml.values import format_value
from ..elements import element
from ..foreign_xml import RawXmlOf, foreign_losses, settings_in
from ..holding import cones, lost_of_joints, lost_sections, renamed_sensors
from ..output import FOLDER, Output
from ..table import TARGETS
from .assets import Looks
from .constraints import add_excludes, add_loops, add_mimics
from .control import add_actuators, add_keyframes
from .links import add_bodies, put_on_floor, sort_bodies
from .model import JOINTS, Writing, pose_attributes
from .scene import scene
from .sensors import add_sensors
from .shapes import add_geoms

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.robot import Robot
    from ...xml.tree import Element
    from ..elements import Attributes
    from ..output import Wanted
    from .model import Writing


def write(robot: Robot, wanted: Wanted) -> Output:
    """Return a robot as MJCF, with the scene and the meshes that belong beside it.

    Raises:
        YamaroError: MuJoCo would refuse it, such as a mesh that is not there.
    """
    writing = Writing(robot, wanted)
    add_bodies(writing)
    add_geoms(writing, Looks(writing))
    bounded = add_actuators(writing)
    add_sensors(writing)
    put_on_floor(writing)
    add_excludes(writing)
    add_mimics(writing)
    add_loops(writing)
    raw = add_raw(writing)
    sort_bodies(writing)
    add_keyframes(writing, raw)
    planes = (PLANAR, FLOATING)
    writing.losses += lost_of_joints(robot, "mjcf", has_dynamics=planes, bounded=bounded)
    writing.losses += renamed_sensors(robot)
    writing.losses += cones(robot)
    writing.losses += lost_sections(robot, controls=True)
    writing.losses += foreign_losses(robot)
    if writing.errors:
        raise YamaroError(writing.errors)
    sections = [each for each in writing.sections.values() if each.children]
    children = [*head(writing), *sections, *raw]
    root = element("mujoco", {"model": writing.model}, children=children, owner=robot.element)
    file_name = wanted.file_name or f"{wanted.name}.xml"
    files = {TARGETS["mjcf"].beside[0]: scene(writing, file_name), **writing.files}
    joints, parts = writing.motions, ("base", "single", "free")
    names = {
        "link": {writing.body_name(link): link for link in writing.plan.bodies},
        "joint": {name: joint for name, (joint, part) in joints.items() if part != "base"},
        "part": {name: part for name, (_, part) in joints.items() if part not in parts},
        "sensor": writing.measured,
    }
    return Output(root, writing.losses, files, names=names)


# --- the head of a model --------------------------------------------------------------------


SITE_SIZE = 0.005
STIFF: Attributes = {"solref": "0.004 1", "solimp": "0.99 0.999 0.001"}
"""How fast and how exactly equalities hold: as stiff as the time step of MuJoCo allows."""
VISUAL_GROUP, COLLISION_GROUP, SITE_GROUP = 2, 3, 4


def head(writing: Writing) -> list[Element]:
    """Return what comes before the sections: `compiler`, `option` and `default`.

    A shape has no mass of its own, since its link says what it has. A mesh is taken for a shell, as
    it may be too flat to enclose a volume.
    """
    classes, owner = writing.classes, writing.robot.element
    no_contact: Attributes = {"contype": 0, "conaffinity": 0, "group": VISUAL_GROUP, "density": 0}
    inner = {
        classes.visual: element("geom", no_contact),
        classes.collision: element("geom", {"group": COLLISION_GROUP, "density": 0}),
        classes.frame: element("site", {"group": SITE_GROUP, "size": SITE_SIZE}),
    }
    of_model = []
    if any(each.name == "mesh" for each in writing.sections["asset"].elements()):
        of_model.append(element("mesh", {"inertia": "shell"}))
    if writing.sections["equality"].children:
        of_model.append(element("equality", STIFF))
    of_model += [
        element("default", {"class": name}, children=[content]) for name, content in inner.items()
    ]
    model = element("default", {"class": classes.model}, children=of_model)
    folder = FOLDER if writing.files else None
    compiler: Attributes = {
        "angle": "radian",
        "meshdir": folder,
        "texturedir": folder,
        "autolimits": "true",
    }
    return [
        element("compiler", compiler, owner=owner),
        element("option", {"integrator": "implicitfast"}, owner=owner),
        element("default", children=[model], owner=owner),
    ]


# --- the XML that a file holds for MJCF -------------------------------------------------------


def add_raw(writing: Writing) -> list[Element]:
    """Append the XML for bodies and joints; return that for the model."""
    raw = RawXmlOf(writing.robot, "mjcf")
    for link in writing.plan.order:
        settings, rest = settings_in(raw.in_link(link.name))
        body = writing.body_of(link.name)
        if link.name in writing.plan.sites and rest:
            attributes = pose_attributes(writing.plan.poses[link.name])
            body.children.append(element("frame", attributes, children=rest, owner=link))
        else:
            body.children += rest
        _set(body, settings)
    for name, joint in writing.robot.joints.items():
        if joint.type in SINGLE and joint.child in writing.bodies:
            for each in writing.bodies[joint.child].elements():
                if each.name in JOINTS and each.attributes.get("name") == name:
                    settings, rest = settings_in(raw.in_joint(name))
                    _set(each, settings)
                    each.children += rest
                    break
    writing.losses += raw.left()
    return raw.robot


def _set(element: Element, settings: dict[str, Element]) -> None:
    """Set attributes that are given as elements."""
    if not settings:
        return
    places = {name: element.value_span(name) for name in element.attributes}
    for name, setting in settings.items():
        element.attributes[name] = format_value(setting.text()).strip()
        places[name] = setting.span
    element.value_spans = places
