"""What a URDF says for Gazebo, in `<gazebo>`, as the elements of SDFormat that mean the same.

Plugins and sensors are copied as they are written. What is left has no place in SDFormat, and is
lost.

Source: the conversion of URDF in SDFormat, parser_urdf.cc, and the specification of SDFormat.
"""

from __future__ import annotations

from ...model.values import attribute_text, content
from ...xml.tree import Element
from ..elements import element
from ..foreign_xml import FOR_LUMPING, is_surface
from ..losses import Losses

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Container

    from ...model.robot import Robot

MODEL_TAGS = {
    **{name: name for name in ("static", "self_collide", "allow_auto_disable", "enable_wind")},
    "selfCollide": "self_collide",
}
"""Elements without a reference, and what they are in a model."""
LINK_TAGS = {
    **{name: name for name in ("self_collide", "gravity", "kinematic", "enable_wind")},
    "selfCollide": "self_collide",
    "turnGravityOff": "gravity",
}
"""Elements of a link, and what they are there."""
COLLISION_TAGS = {"maxContacts": "max_contacts", "laserRetro": "laser_retro"}
"""Elements of a link, and what they are in each of its collisions."""
SURFACE_TAGS = {
    "fdir1": ("friction", "fdir1"),
    "minDepth": ("contact", "min_depth"),
    "maxVel": ("contact", "max_vel"),
}
"""Elements of a link, and where they are in the surface of its collisions."""
ODE_TAGS = {
    "implicitSpringDamper": "implicit_spring_damper",
    "cfmDamping": "cfm_damping",
    "fudgeFactor": "fudge_factor",
}
"""Elements of a joint, and what they are for the physics engine ODE."""
COPIED = frozenset(("plugin", "gripper"))
TRUE = frozenset(("1", "true"))


class GazeboBlocks:
    """What the `<gazebo>` elements of a robot say.

    Attributes:
        model: elements for the model.
        links: elements for links, by their names.
        joints: elements for joints, by their names.
        collisions: elements for each collision of a link, by the link's name.
        surfaces: elements for the surfaces of a link's collisions: `friction` or `contact`, with an
            element for ODE, by the link's name.
        blobs: contents for each `visual` or `collision` of a link, by the link's name.
        sensors: sensors as they are written, with the link or joint that they refer to.
        losses: what SDFormat has no place for.
    """

    __slots__ = (
        "_robot", "blobs", "collisions", "joints", "links", "losses", "model", "sensors",
        "surfaces",
    )  # fmt: skip

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self.model: list[Element] = []
        self.links: dict[str, list[Element]] = {}
        self.joints: dict[str, list[Element]] = {}
        self.collisions: dict[str, list[Element]] = {}
        self.surfaces: dict[str, list[tuple[str, Element]]] = {}
        self.blobs: dict[str, list[Element]] = {}
        self.sensors: list[tuple[str, Element]] = []
        self.losses = Losses()
        for block in robot.element.elements():
            if block.name == "gazebo":
                trace = block.trace_within(None)
                reference = attribute_text(block, "reference")
                for each in block.elements():
                    if reference is None:
                        taken = self._take_for_model(each)
                    elif reference in self._robot.links:
                        taken = self._take_for_link(each, reference)
                    elif reference in self._robot.joints:
                        taken = self._take_for_joint(each, reference)
                    else:
                        taken = False
                    is_read = is_surface(each, self._robot, reference)
                    if not taken and not is_read and each.name not in FOR_LUMPING:
                        owner = f"'{reference}'" if reference is not None else "the robot"
                        what = f"Gazebo's <{each.name}> elements"
                        self.losses.lose_xml(what, each, label=owner, trace=trace)

    def left(self, bodies: Collection[str]) -> Losses:
        """Return the losses of elements for links that are not bodies of their own."""
        found = Losses()
        for name, inner in self.links.items():
            for each in inner if name not in bodies else ():
                what, label = f"<{each.name}> of links that are frames", f"link '{name}'"
                found.lose_xml(what, each, label=label, trace=None)
        return found

    def copied_sensors(self) -> set[str]:
        """Return the names, in the model of the robot, of the sensors that are copied."""
        copied = set()
        for _, sensor in self.sensors:
            copied.add(sensor.span.key())
            copied.update(child.span.key() for child in sensor.elements())  # of a multicamera
        return {each.name for each in self._robot.sensors.values() if each.span.key() in copied}

    def _take_for_model(self, each: Element) -> bool:
        name = MODEL_TAGS.get(each.name)
        if name is not None:
            self.model.append(_flag(name, each))
        elif each.name in COPIED and (each.name != "plugin" or each.attributes.get("filename")):
            self.model.append(each)
        else:
            return False
        return True

    def _take_for_link(self, each: Element, link: str) -> bool:
        kind, owner = each.name, self._robot.links[link]
        is_of_collisions = kind in COLLISION_TAGS or kind in SURFACE_TAGS or kind == "collision"
        if (kind == "visual" and not owner.visuals) or (is_of_collisions and not owner.collisions):
            return False
        if kind == "sensor":
            self.sensors.append((link, each))
        elif kind in ("visual", "collision"):
            self.blobs.setdefault(link, []).append(each)
        elif kind in LINK_TAGS:
            flag = _flag(LINK_TAGS[kind], each, negated=kind == "turnGravityOff")
            _put(self.links.setdefault(link, []), flag)
        elif kind in COLLISION_TAGS:
            _put(self.collisions.setdefault(link, []), _same(COLLISION_TAGS[kind], each))
        elif kind in SURFACE_TAGS:
            section, name = SURFACE_TAGS[kind]
            found = self.surfaces.setdefault(link, [])
            found[:] = [pair for pair in found if pair[1].name != name]
            found.append((section, _same(name, each)))
        else:
            return False
        return True

    def _take_for_joint(self, each: Element, joint: str) -> bool:
        kind = each.name
        if kind == "sensor":
            self.sensors.append((joint, each))
        elif kind in ODE_TAGS:
            ode = element("ode", children=[_flag(ODE_TAGS[kind], each)])
            self.joints.setdefault(joint, []).append(ode)
        elif kind == "provideFeedback":
            self.joints.setdefault(joint, []).append(_flag("provide_feedback", each))
        else:
            return False
        return True

    def lose_without_home(self, bodies: Container[str]) -> None:
        """Note what is said of links that are frames, or of shapes that a link does not have."""
        links = self._robot.links
        lost = [(name, each) for name, inner in self.links.items() for each in inner
                if name not in bodies]  # fmt: skip
        without = {name for name, link in links.items() if not link.collisions}
        lost += [(name, each) for name, inner in self.collisions.items() for each in inner
                 if name in without]  # fmt: skip
        lost += [(name, each) for name, pairs in self.surfaces.items() for _, each in pairs
                 if name in without]  # fmt: skip
        for name, blobs in self.blobs.items():
            for blob in blobs:
                shapes = links[name].collisions if blob.name == "collision" else links[name].visuals
                if not shapes:
                    lost.append((name, blob))
        for name, each in lost:
            what, trace = f"Gazebo's <{each.name}> elements", links[name].trace
            self.losses.lose_xml(what, each, label=f"link '{name}'", trace=trace)


def _put(elements: list[Element], new: Element) -> None:
    """Add an element, in place of one of its name."""
    elements[:] = [each for each in elements if each.name != new.name]
    elements.append(new)


def physics_of(parts: list[Element]) -> list[Element]:
    """Return the `<physics>` of a joint: what is for ODE is in one element."""
    if not parts:
        return []
    ode = {each.name: each for part in parts if part.name == "ode" for each in part.elements()}
    rest = {part.name: part for part in parts if part.name != "ode"}  # what is said last counts
    of_ode = [element("ode", children=ode.values())] if ode else []
    return [element("physics", children=[*of_ode, *rest.values()])]


def _flag(name: str, origin: Element, *, negated: bool = False) -> Element:
    """Return an element that is true or false, or the number that is written."""
    text = (content(origin) or "").lower()
    if text in TRUE or text in ("0", "false", ""):
        text = "true" if (text in TRUE) != negated else "false"
    return element(name, text=text, owner=origin)


def _same(name: str, origin: Element) -> Element:
    return element(name, text=content(origin) or "", owner=origin)
