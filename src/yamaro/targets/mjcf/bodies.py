"""Bodies, their inertia and their joints; the sites of frames."""

from __future__ import annotations

from ...model.kinematics import link_poses
from ...xml.tree import Element
from ..output import LOST, RENAMED
from .inertials import inertial_of
from .joints import add_joints
from .names import JOINT, WORLD, stem_of
from .solids import heights_at
from .writing import Writing, made, number, pose_attributes, row

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.joint import Joint
    from ...model.link import Link
    from ...source import Span


def add_bodies(writing: Writing) -> None:
    """Append the body or site of each link, in the order from the roots to the leaves."""
    for link in writing.plan.order:
        name = link.name
        if link is writing.plan.world:
            _lose_mass_of_world(writing, link)
        elif writing.plan.carriers[name] == name:
            _add_body(writing, link)
        else:
            _add_site(writing, link)


def _add_body(writing: Writing, link: Link) -> None:
    """Append the body of a link, with its inertia and joint, to the body that it is in."""
    parent, pose = writing.plan.place_of(link)
    name = writing.body_name(link.name)
    if name != link.name:
        writing.lose(RENAMED, "links", f"link '{link.name}'", link.span, trace=link.trace, how=name)
    joint = writing.robot.parent_joint(link.name)
    is_outermost = parent is None
    attributes = {
        "name": name,
        **pose_attributes(pose),
        "childclass": writing.classes.model if is_outermost else None,
    }
    body = writing.bodies[link.name] = made(
        "body", link, attributes, link.trace, _Places(link, joint)
    )
    if joint is None and link.name not in writing.plan.static:
        free = writing.names.fresh(JOINT, f"{stem_of(link.name)}_free")
        writing.motions[free] = (link.name, "base")
        body.children.append(made("freejoint", link, {"name": free}, link.trace))
    inertial = inertial_of(writing, link)
    if inertial is not None:
        body.children.append(inertial)
    if joint is not None:
        add_joints(writing, joint, body)
    above = writing.sections["worldbody"] if parent is None else writing.bodies[parent]
    above.children.append(body)


def _add_site(writing: Writing, link: Link) -> None:
    """Append the site of an empty link on a fixed joint."""
    joint = writing.robot.parent_joint(link.name)
    assert joint is not None, "a root is a body"
    pose = writing.plan.poses[link.name]
    attributes = {
        "name": link.name,
        "class": writing.classes.frame,
        **pose_attributes(pose),
    }
    site = made("site", link, attributes, link.trace, _Places(link, joint))
    writing.body_of(link.name).children.append(site)


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


def _lose_mass_of_world(writing: Writing, link: Link) -> None:
    if link.mass:
        assert link.inertial is not None
        writing.lose(
            LOST,
            "masses of the world",
            f"{number(link.mass)} kg of the link '{WORLD}'",
            link.inertial.span,
            trace=link.trace,
            hint="give the link another name; a root named 'world' is the world of MJCF",
        )


def sort_bodies(writing: Writing) -> None:
    """Put what bodies hold in the usual order: what they are, shapes, sites, inner bodies."""
    for body in (writing.sections["worldbody"], *writing.bodies.values()):
        body.children.sort(key=_rank)


def put_on_floor(writing: Writing) -> None:
    """Put free roots where they stand on the floor with all joints at 0, as a model starts."""
    for link, height in heights_at(writing, link_poses(writing.robot)).items():
        body = writing.bodies[link]
        if height and writing.robot.parent_joint(link) is None:
            name = body.attributes.pop("name")
            body.attributes = {"name": name, "pos": row((0.0, 0.0, height)), **body.attributes}


_ORDER = ("freejoint", "inertial", "joint", "geom", "site", "frame", "camera", "body")
_RANKS = {name: rank for rank, name in enumerate(_ORDER)}


def _rank(node: object) -> int:
    return _RANKS.get(node.name, len(_ORDER)) if isinstance(node, Element) else len(_ORDER)
