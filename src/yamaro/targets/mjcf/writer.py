"""The model: calls what writes its parts, and puts them together."""

from __future__ import annotations

from ...diagnostics import YamaroError
from ...model.joint import FLOATING, PLANAR
from ...model.values import attribute_text
from ...xml.tree import OF_ATTACHED, Element
from ..elements import element
from ..foreign_xml import foreign_losses
from ..holding import cones, lost_of_joints, lost_sections, renamed_sensors
from ..output import FOLDER, Output
from ..table import TARGETS
from ..translation import TIGHT
from .assets import Looks, with_files
from .blocks import (
    ACTUATORS,
    ANCHOR,
    OF_WHOLE,
    SINGLES,
    changed,
    drivers,
    join,
    merge,
    merged,
    names,
    set_from,
)
from .constraints import add_excludes, add_loops, add_mimics
from .control import add_actuators, leave_out_bounds
from .keyframes import add_keyframes
from .links import add_bodies, put_on_floor, sort_bodies
from .model import Writing, pose_attributes
from .scene import scene
from .sensors import add_sensors
from .shapes import add_geoms

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.link import Link
    from ...model.robot import Robot
    from ...xml.tree import Node
    from ..elements import Attributes
    from ..output import Wanted
    from .model import Writing


def write(robot: Robot, wanted: Wanted) -> Output:
    """Return a robot as MJCF, with the scene and the meshes that belong beside it.

    Raises:
        YamaroError: MuJoCo would refuse it, such as a mesh that is not there.
    """
    writing, top = modelled(robot, wanted)
    root = document(writing, top)
    file_name = wanted.file_name or f"{wanted.name}.xml"
    files = {TARGETS["mjcf"].beside[0]: scene(writing, file_name), **writing.files}
    return Output(root, writing.losses, files, names=writing.own_names())


def modelled(robot: Robot, wanted: Wanted) -> tuple[Writing, list[Element]]:
    """Return the sections of a robot's MJCF, and those besides, of which some are of blocks.

    Raises:
        YamaroError: MuJoCo would refuse the robot.
    """
    writing = Writing(robot, wanted)
    add_bodies(writing)
    add_geoms(writing, Looks(writing))
    bounded = add_actuators(writing)
    add_sensors(writing)
    if not writing.blocks.is_whole:
        put_on_floor(writing)
    add_excludes(writing)
    add_mimics(writing)
    add_loops(writing)
    top = merge_blocks(writing)
    if writing.blocks.is_whole:
        leave_out_bounds(writing)
    sort_bodies(writing)
    add_keyframes(writing)
    planes = (PLANAR, FLOATING)
    writing.losses += lost_of_joints(robot, "mjcf", has_dynamics=planes, bounded=bounded)
    writing.losses += renamed_sensors(robot)
    writing.losses += cones(robot)
    writing.losses += lost_sections(robot, controls=True)
    writing.losses += foreign_losses(robot)
    if writing.errors:
        raise YamaroError(writing.errors)
    return writing, top


def document(writing: Writing, top: list[Element]) -> Element:
    """Return the root of a document with its sections, and those besides."""
    sections = [*top, *(each for each in writing.sections.values() if each.children)]
    children = sorted(sections, key=lambda each: RANKS.get(each.name, len(RANKS)))
    owner = writing.robot.element
    return element("mujoco", {"model": writing.model}, children=children, owner=owner)


# --- the head of a model --------------------------------------------------------------------


SITE_SIZE = 0.005
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
    of_model, is_whole = [], writing.blocks.is_whole
    has_meshes = any(each.name == "mesh" for each in writing.sections["asset"].elements())
    if has_meshes and not is_whole:
        of_model.append(element("mesh", {"inertia": "shell"}))
    if writing.sections["equality"].children and not is_whole:
        of_model.append(element("equality", TIGHT))
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
    found = [
        element("compiler", compiler, owner=owner),
        element("default", children=[model], owner=owner),
    ]
    if not is_whole:
        found.append(element("option", {"integrator": "implicitfast"}, owner=owner))
    return found


# --- the XML that a file holds for MJCF -------------------------------------------------------

ORDER = (
    *("compiler", "option", "size", "visual", "statistic", "default", "custom", "extension"),
    *("asset", "worldbody", "deformable", "contact", "tendon", "equality", "actuator", "sensor"),
    "keyframe",
)  # fmt: skip
"""The usual order of the sections of a document."""
RANKS = {name: rank for rank, name in enumerate(ORDER)}


def merge_blocks(writing: Writing) -> list[Element]:
    """Merge the blocks of the file into what is written; return the sections besides ours."""
    blocks, plan = writing.blocks, writing.plan
    written: set[tuple[str, str]] = set()
    for link in plan.order:
        if link.name not in plan.passed:
            written.add(("link", link.name))
            _merge_link(writing, link)
    driving: list[Element] = []
    for name, elements in writing.joints.items():
        if elements:
            written.add(("joint", name))
        of_all = dict(blocks.settings("joint", name))
        if len(elements) == 1:
            of_all.pop(ANCHOR, None)  # which is worked out
        of_all.pop("name", None)
        rest = []
        for each in blocks.elements("joint", name):
            if each.name in ACTUATORS:
                own = {"joint": writing.joint_name(name), **each.attributes}
                if "name" in own:
                    own = {"name": own["name"], **own}
                driving.append(changed(each, own))
            else:
                rest.append(each)
        for each in elements:
            set_from(each, of_all)
            each.children += rest
    actuators = writing.sections["actuator"]
    actuators.children = merged(actuators.children, driving, drivers, orders=False)
    order = {writing.joint_name(name): at for at, name in enumerate(writing.robot.actuators)}
    actuators.children.sort(key=lambda each: order.get(_joint_of(each), len(order)))
    writing.losses += blocks.left(written)
    return _merge_sections(writing)


def _joint_of(actuator: Node) -> str:
    return (attribute_text(actuator, "joint") or "") if isinstance(actuator, Element) else ""


def _merge_link(writing: Writing, link: Link) -> None:
    blocks, plan = writing.blocks, writing.plan
    settings = blocks.settings("link", link.name)
    elements = [with_files(writing, each) for each in blocks.elements("link", link.name)]
    if not settings and not elements:
        return
    body = writing.body_of(link.name)
    is_site = link.name in plan.sites
    target = body
    if is_site:
        name = writing.site_name(link.name)
        sites = [each for each in body.elements() if each.name == "site"]
        target = next(each for each in sites if each.attributes["name"] == name)
    set_from(target, settings)
    if "mocap" in settings and plan.parent_and_pose(link)[0] is not None and not is_site:
        del target.attributes["mocap"]
        what, label = "'mocap' of bodies that are not in the world", f"link '{link.name}'"
        writing.losses.lose_xml(what, settings["mocap"], label=label, trace=None)
    if is_site and target.attributes["name"] == "":
        del target.attributes["name"]
    if is_site:
        known = {key for each in body.elements() for key in names(each)}
        new = [each for each in elements if known.isdisjoint(names(each))]
        if new:
            attributes = pose_attributes(plan.poses[link.name])
            body.children.append(element("frame", attributes, children=new, owner=link))
            elements = [each for each in elements if not known.isdisjoint(names(each))]
    elements = _for_each_piece(writing.robot, link, elements)
    for index, given in enumerate(elements):
        if _is_free(given):
            _rename_free(writing, body, given)
        free_name = writing.renamed_geoms.get((link.name, attribute_text(given, "name") or ""))
        if free_name is not None and given.name == "geom":
            elements[index] = changed(given, {**given.attributes, "name": free_name})
    body.children = merged(body.children, elements, _in_body, is_body=True)


def _for_each_piece(robot: Robot, link: Link, elements: list[Element]) -> list[Element]:
    """Return what blocks say of a link, of a geom that is several pieces for each of them."""
    pieces: dict[str, list[str]] = {}
    for fit in robot.fits:
        if fit.link == link.name and fit.section == "collision":
            first, *rest = link.collisions[fit.index : fit.index + fit.count]
            pieces[first.name] = [each.name for each in rest]
    found = []
    for given in elements:
        found.append(given)
        if given.name == "geom":
            others = pieces.get(attribute_text(given, "name") or "", ())
            found += [changed(given, {**given.attributes, "name": each}) for each in others]
    return found


def _is_free(joint: Element) -> bool:
    is_typed = joint.name == "joint" and attribute_text(joint, "type") == "free"
    return joint.name == "freejoint" or is_typed


def _in_body(element: Element) -> list[object]:
    """Return what an element in a body is known by: of some there is but one in a body."""
    if _is_free(element):
        return ["free"]
    return [element.name] if element.name == "inertial" else names(element)


def _rename_free(writing: Writing, body: Element, given: Element) -> None:
    """Let the free joint of a body have the word and the name that a block says."""
    for own in body.elements():
        if _is_free(own):
            old, new = attribute_text(own, "name"), attribute_text(given, "name")
            own.name = given.name
            if given.name == "joint":
                own.attributes["type"] = "free"
            if old in writing.motions and new is not None:
                writing.motions[new] = writing.motions.pop(old)


def _merge_sections(writing: Writing) -> list[Element]:
    """Merge the sections of blocks into ours; return our head, and those besides ours."""
    sections = [with_files(writing, each) for each in writing.blocks.sections]
    top = head(writing)
    attached: list[Element] = []
    said: dict[str, set[tuple[str, str]]] = {name: set() for name in SINGLES}
    for given in sections:
        own = writing.sections.get(given.name)
        if given.name == "keyframe":  # once it is known which joints there are
            continue
        if given.name in SINGLES:
            if given.body == OF_ATTACHED:
                attached.append(given)
                continue
            for each in (given, *given.elements()):
                tag = "" if each is given else each.name
                said[given.name].update((tag, name) for name in each.attributes)
            merge(_single(top, given), given)
        elif own is None:
            top.append(given)
        else:
            keys = drivers if given.name == "actuator" else names
            trace = given.trace_within(None)
            inner = [each.settled(trace) for each in given.elements()]
            own.children = merged(own.children, inner, keys)
    for given in attached:
        _join(writing, top, given, said[given.name])
    return top


def _single(top: list[Element], given: Element) -> Element:
    """Return the section of the document that is called as one of a block is."""
    own = next((each for each in top if each.name == given.name), None)
    if own is None:
        own = given.with_children([])
        own.attributes = {}
        top.append(own)
    return own


def _join(writing: Writing, top: list[Element], given: Element, said: set[tuple[str, str]]) -> None:
    """Take what an attached robot says of the simulation, and nothing else says differently."""
    what, trace = "settings of attached robots", given.trace_within(None)
    if given.name in OF_WHOLE:
        writing.losses.lose_xml(what, given, label=f"<{given.name}>", trace=trace)
        return
    for each, name in join(_single(top, given), given, said):
        label = f"'{name}' of <{each.name}>"
        writing.losses.lose_xml(what, each, label=label, trace=trace, field=name)
