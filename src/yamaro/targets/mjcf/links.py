"""Bodies, their inertia and their joints; the sites of frames."""

from __future__ import annotations

from ...model.kinematics import WORLD, link_poses
from ...model.pose import UNTURNED
from ...xml.tree import Element
from ..elements import element, number, row
from ..inertia import turned_moments, written_moments
from .blocks import ANCHOR
from .joints import add_joints
from .model import JOINT, Writing, pose_attributes, stem_of
from .scene import heights_at

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.joint import Joint
    from ...model.link import Link
    from ...source import Span
    from ..elements import Attributes


def add_bodies(writing: Writing) -> None:
    """Append the body or site of each link, in the order from the roots to the leaves."""
    for link in writing.plan.order:
        name = link.name
        if name in writing.plan.passed:
            above = writing.robot.parent_joint(name)
            if above is not None and writing.blocks.text("joint", above.name, ANCHOR) is None:
                what, how = "links without mass between two joints", "joints of one body"
                writing.losses.approximate(what, link, how=how)
            continue
        if link is writing.plan.world:
            if link.mass:
                writing.losses.lose(
                    "masses of the world",
                    link,
                    part=link.inertial,
                    label=f"{number(link.mass)} kg of the link '{WORLD}'",
                    hint="give the link another name; a root named 'world' is the world of MJCF",
                )
        elif writing.plan.carriers[name] == name:
            _add_body(writing, link)
        else:
            joint = writing.robot.parent_joint(link.name)
            assert joint is not None, "a root is a body"
            attributes: Attributes = {
                "name": writing.site_name(link.name),
                "class": writing.classes.frame,
                **pose_attributes(writing.plan.poses[link.name]),
            }
            site = element("site", attributes, owner=link, places=_Places(link, joint))
            writing.body_of(link.name).children.append(site)


def _add_body(writing: Writing, link: Link) -> None:
    """Append the body of a link, with its inertia and joint, to the body that it is in."""
    parent, pose = writing.plan.parent_and_pose(link)
    name = writing.body_name(link.name)
    if name != link.name and writing.blocks.text("link", link.name, "name") is None:
        writing.losses.rename("links", link, new=name)
    joint = writing.robot.parent_joint(link.name)
    attributes: Attributes = {
        "name": name,
        **pose_attributes(pose),
        "childclass": writing.classes.model if parent is None else None,
    }
    body = element("body", attributes, owner=link, places=_Places(link, joint))
    writing.bodies[link.name] = body
    if joint is None and link.name not in writing.plan.static:
        free = writing.names.fresh(JOINT, f"{stem_of(link.name)}_free")
        writing.motions[free] = (link.name, "base")
        body.children.append(element("freejoint", {"name": free}, owner=link))
    inertial = inertial_of(writing, link)
    if inertial is not None:
        body.children.append(inertial)
    for each, place in writing.plan.joints_of(link.name):
        add_joints(writing, each, body, place)
    above = writing.sections["worldbody"] if parent is None else writing.bodies[parent]
    above.children.append(body)


class _Places:
    """Where the name of a body is written, and its pose: in the joint above it."""

    __slots__ = ("_joint", "_link")

    def __init__(self, link: Link, joint: Joint | None) -> None:
        self._link = link
        self._joint = joint

    def get(self, attribute: str) -> Span | None:
        """Return the place of an attribute's value; None for that of the element."""
        if attribute == "name":
            return self._link.span_of("name")
        is_pose = attribute in ("pos", "quat") and self._joint is not None
        return self._joint.origin.span if is_pose and self._joint is not None else None


def sort_bodies(writing: Writing) -> None:
    """Put what bodies hold in the usual order: what they are, shapes, sites, inner bodies."""
    for body in (writing.sections["worldbody"], *writing.bodies.values()):
        body.children.sort(key=_rank)
        flexes = [each for each in body.elements() if each.name == "flexcomp"]
        for flex in flexes:  # their bodies are counted where the file has them among others
            place, index = flex.span, body.children.index(flex)
            for at, each in enumerate(body.children[:index]):
                is_body = isinstance(each, Element) and each.name == "body"
                same = is_body and each.span.source is place.source
                if same and each.span.start > place.start:
                    body.children.insert(at, body.children.pop(index))
                    break


def put_on_floor(writing: Writing) -> None:
    """Put free roots where they stand on the floor with all joints at 0, as a model starts."""
    for link, height in heights_at(writing, link_poses(writing.robot)).items():
        body = writing.bodies[link]
        if height and writing.robot.parent_joint(link) is None:
            name = body.attributes.pop("name")
            body.attributes = {"name": name, "pos": row((0.0, 0.0, height)), **body.attributes}


SAME = 1e-9
"""How far moments may be apart that are the same, as part of the greatest."""
_ORDER = ("freejoint", "inertial", "joint", "geom", "site", "frame", "camera", "body")
_RANKS = {name: rank for rank, name in enumerate(_ORDER)}


def _rank(node: object) -> int:
    return _RANKS.get(node.name, len(_ORDER)) if isinstance(node, Element) else len(_ORDER)


# --- the mass of a link as MJCF takes it: along the principal axes of its inertia -------------


def inertial_of(writing: Writing, link: Link) -> Element | None:
    """Return the `<inertial>` of a link, or None if it has neither mass nor inertia."""
    inertial, principal = link.inertial, writing.inertias.by_link.get(link.name)
    if inertial is None or principal is None:
        return None
    pose = pose_attributes(principal.pose)
    places: dict[str, Span] = {}
    mass, inertia, origin = (inertial.inner(name) for name in ("mass", "inertia", "origin"))
    if mass is not None:
        places["mass"] = mass.value_span("value")
    if inertia is not None:
        places["diaginertia"] = inertia.span
    if origin is not None:
        places |= {"pos": origin.value_span("xyz"), "quat": origin.value_span("rpy")}
    attributes: Attributes = {"pos": pose["pos"] or "0 0 0", "mass": principal.mass}
    _, ixy, ixz, _, iyz, _ = inertial.inertia
    is_turned = any((ixy, ixz, iyz))
    is_measured = is_turned and writing.body_name(link.name) in writing.inertias_measured
    a, b, c = sorted(principal.moments)
    if is_measured and min(b - a, c - b) <= SAME * c:  # any axes will do, and roundings decide
        what, how = "axes of equal moments of inertia that sensors measure along", "any of them"
        writing.losses.approximate(what, link, part=inertial, how=how)
    is_of_mjcf = is_turned and writing.blocks.is_whole
    if writing.blocks.is_aligned(link.name) or is_measured or is_of_mjcf:
        # MuJoCo turns the body, what sensors measure along, and where it takes a shape to be that
        # is within 1e-6 m of it, to principal axes in an order of its own.
        if inertial.pose.rotation == UNTURNED and not principal.is_changed:
            matrix = inertial.matrix()
        else:
            matrix = turned_moments(principal.moments, principal.pose.rotation)
        (xx, xy, xz), (_, yy, yz), (_, _, zz) = matrix
        attributes["fullinertia"] = (xx, yy, zz, xy, xz, yz)
    else:
        attributes = {
            "pos": attributes["pos"],
            "quat": pose["quat"],
            "mass": principal.mass,
            "diaginertia": written_moments(principal.moments),
        }
    return element("inertial", attributes, owner=link, part=inertial, places=places)
