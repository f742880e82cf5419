"""The mass of a link as MJCF takes it: along the principal axes of its inertia."""

from __future__ import annotations

from ..inertia import written_moments
from .writing import Writing, made, number, pose_attributes, row

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.link import Link
    from ...source import Span
    from ...xml.tree import Element


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
    attributes = {
        "pos": pose["pos"] or "0 0 0",
        "quat": pose["quat"],
        "mass": number(principal.mass),
        "diaginertia": row(written_moments(principal.moments)),
    }
    return made("inertial", inertial, attributes, inertial.trace_in(link), places)
