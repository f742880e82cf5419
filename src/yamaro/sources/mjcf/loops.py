"""Equalities that hold two bodies or sites together: loops of the model.

They hold as the bodies are when all joints are at their references, as the document places them.
"""

from __future__ import annotations

from ...model import making
from ...model.making import Place
from ...model.pose import IDENTITY, UNTURNED, Pose, rotation_from_quaternion
from ...xml.tree import SAID
from .blocks import NAME
from .compiler import numbers, truth, vector

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...xml.tree import Element
    from .building import Builder
    from .tree import Thing

KINDS = {"connect": "ball", "weld": "fixed"}
"""The equalities, with the types of the joints that close loops."""
_SAID = frozenset(("site1", "site2", "body1", "body2", "anchor", "relpose", "active"))


def add_loop(builder: Builder, thing: Thing, element: Element) -> None:
    """Note a joint that closes a loop, if both ends are links, and no mocap body is one of them.

    Args:
        builder: the robot, with all links and frames.
        thing: the equality.
        element: what is kept of it, which gets the name of the loop.
    """
    if not truth(thing.given, "active", True):
        return
    ends = _sites(builder, thing) or _frames(builder, thing)
    if ends is None:
        return
    name = builder.fresh("loop", thing.name or f"{ends[0]}_{ends[1]}")
    element.attributes = {"name": name, **element.attributes}
    places = {"name": thing.name_span if thing.name else thing.span}
    for attribute, frame in zip(("frame_1", "frame_2"), ("1", "2"), strict=True):
        kind = "site" if f"site{frame}" in thing.given else "body"
        places[attribute] = thing.where(kind + frame)
    values = {"name": name, "type": KINDS[thing.kind], "of": NAME}
    values |= {"frame_1": ends[0], "frame_2": ends[1]}
    builder.rest.append(making.note("robot-loop", Place(thing.span, places), values))
    if thing.given.keys() <= _SAID:
        element.body = SAID


def _sites(builder: Builder, thing: Thing) -> tuple[str, str] | None:
    """Return the frames of the two sites that are held together."""
    first, second = thing.text("site1"), thing.text("site2")
    if first not in builder.sites or second not in builder.sites:
        return None
    return builder.sites[first][1], builder.sites[second][1]


def _frames(builder: Builder, thing: Thing) -> tuple[str, str] | None:
    """Return two frames, in the two bodies that are held together, where they meet."""
    poses = builder.initial_poses()
    one, other = thing.text("body1"), thing.text("body2") or builder.world.name
    if one not in poses or other not in poses:
        return None
    T_one_other = poses[one].inverse() @ poses[other]
    if thing.kind == "connect":
        at = Pose(UNTURNED, vector(thing.given, "anchor"))
        in_other = T_one_other.inverse() @ at
        # Any turn will do for a ball; the axes of the first body are those of both.
        ends = (one, at), (other, in_other)
    else:
        relative = numbers(thing.given, "relpose", 7)
        if relative is not None and any(relative[3:]):
            w, x, y, z = relative[3:]
            place = (relative[0], relative[1], relative[2])
            T_one_other = Pose(rotation_from_quaternion(x, y, z, w), place)
        ends = (one, T_one_other), (other, IDENTITY)
    stem = thing.name or f"{one}_{other}"
    names = []
    for number, (link, pose) in enumerate(ends, start=1):
        if pose is IDENTITY:
            names.append(link)
            continue
        name = builder.fresh("body", f"{stem}_{number}")
        builder.links.append(making.link(Place(thing.span), name))
        builder.add_fixed(thing, f"{name}_joint", link, name, pose)
        names.append(name)
    return names[0], names[1]
