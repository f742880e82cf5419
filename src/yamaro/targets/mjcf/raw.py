"""The XML that a file holds for MJCF: in bodies, joints and the model."""

from __future__ import annotations

from ...model.joint import SINGLE
from ...xml.values import format_value
from ..raw_xml import RawXmlOf, settings_in
from .writing import Writing, made, pose_attributes

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...xml.tree import Element

_JOINTS = ("joint", "freejoint")


def add_raw(writing: Writing) -> list[Element]:
    """Append the XML for bodies and joints; return that for the model."""
    raw = RawXmlOf(writing.robot, "mjcf")
    for link in writing.plan.order:
        settings, rest = settings_in(raw.in_link(link.name))
        body = writing.body_of(link.name)
        if link.name in writing.plan.sites and rest:
            attributes = pose_attributes(writing.plan.poses[link.name])
            frame = made("frame", link, attributes, link.trace)
            frame.children += rest
            body.children.append(frame)
        else:
            body.children += rest
        _set(body, settings)
    for name, joint in writing.robot.joints.items():
        element = _joint_in(writing, joint.child, name) if joint.type in SINGLE else None
        if element is not None:
            settings, rest = settings_in(raw.in_joint(name))
            _set(element, settings)
            element.children += rest
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


def _joint_in(writing: Writing, link: str, name: str) -> Element | None:
    """Return the joint of a name in the body of a link."""
    if link not in writing.bodies:
        return None
    inner = writing.bodies[link].elements()
    return next(
        (each for each in inner if each.name in _JOINTS and each.attributes.get("name") == name),
        None,
    )
