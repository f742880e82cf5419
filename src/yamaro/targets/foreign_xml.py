"""XML in a robot that is not URDF: for one output format, or of other programs."""

from __future__ import annotations

from ..model.recognition import SURFACE_TAGS
from ..model.schema import ELEMENTS
from ..model.values import attribute_text, content, numbers_in
from ..xml.tree import SAID, Element
from .losses import Losses
from .table import TARGETS
from .translation import Translation

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection

    from ..diagnostics import Frame as Step
    from ..model.extras import RawXml
    from ..model.robot import Robot

IN_SENSORS = frozenset(
    """
    update_rate updateRate topic pose optical_frame_id
    always_on type mean stddev samples min_angle max_angle min max horizontal_fov width height near
    far collision
    bodyName jointName linkName topicName updateRate updateRateHZ gaussianNoise xyzOffset rpyOffset
    """.split()
)
"""What the model of the robot reads of a sensor, or what holds in any simulator."""
FOR_LUMPING = frozenset(("preserveFixedJoint", "disableFixedJointLumping", "disableJointLumping"))
"""What is only about how Gazebo reads URDF."""


def foreign_losses(robot: Robot, *, taken: Collection[str] = ()) -> Losses:
    """Return the losses of a format that takes no XML of other programs.

    Sensors and surfaces in `<gazebo>` and actuators in `<transmission>` that the model of the robot
    has are left out, and so are `<ros2_control>` and the transmissions that were written with it
    from the same section: the writer knows what is lost of them.

    Args:
        robot: the robot.
        taken: names of elements under the robot that the format takes, or reports itself.
    """
    walk = _Walk(robot)
    root = robot.element
    above = root.trace_within(None)
    controls = {each.span.key() for each in root.elements() if each.name == "ros2_control"}
    for child in root.elements():
        trace = child.trace_within(above)
        if child.name in taken or child.name == "ros2_control":
            continue
        if child.name == "transmission" and child.span.key() in controls:
            continue
        if child.name in ("link", "joint", "material"):
            if not _is_plain(child):
                owner = f"{child.name} '{attribute_text(child, 'name') or ''}'"
                walk.check(child, owner, trace)
        elif child.name == "gazebo":
            walk.check_gazebo(child, trace)
        elif child.name == "transmission":
            walk.check_transmission(child, trace)
        else:
            walk.losses.lose_xml(f"<{child.name}> elements", child, label="the robot", trace=trace)
    for joint in robot.all_joints:  # that join nothing, or a link that has another joint already
        if robot.parent_joint(joint.child) is not joint:
            walk.losses.lose("joints outside of the tree", joint)
    return walk.losses


def _is_plain(element: Element) -> bool:
    """Return whether a link, joint or material has nothing but what URDF has."""
    rule = ELEMENTS[element.name]
    if not element.attributes.keys() <= rule.attributes.keys():
        return False
    known = rule.children
    for child in element.children:
        if isinstance(child, Element) and not (child.name in known and _is_plain(child)):
            return False
    return True


def is_surface(element: Element, robot: Robot, reference: str | None) -> bool:
    """Return whether an element in `<gazebo>` is part of the surface of a link that is read."""
    link = robot.links.get(reference or "")
    if element.name not in SURFACE_TAGS or link is None or not link.collisions:
        return False
    return len(numbers_in(content(element))) == 1


class _Walk:
    """Looks at the elements of one robot.

    Attributes:
        losses: what was found.
    """

    __slots__ = ("_actuators", "_robot", "_sensors", "_sound", "losses")

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._sensors = {each.span.key() for each in robot.sensors.values()}
        self._actuators: set[object] | None = None
        self._sound: set[int] = set()  # the identities of elements in which nothing is foreign
        self.losses = Losses()

    def check(self, element: Element, owner: str, trace: Step | None) -> None:
        """Note what URDF does not have in a link, joint or material."""
        if id(element) in self._sound:
            return
        before = len(self.losses)
        rule = ELEMENTS[element.name]
        for name in element.attributes:
            if name not in rule.attributes and element.attributes[name] is not None:
                what = f"attributes '{name}' of <{element.name}>"
                self.losses.lose_xml(what, element, label=owner, trace=trace, field=name)
        for child in element.elements():
            if child.name in rule.children:
                self.check(child, owner, child.trace_within(trace))
            else:
                self.losses.lose_xml(f"<{child.name}> elements", child, label=owner, trace=trace)
        if len(self.losses) == before:
            self._sound.add(id(element))

    def check_gazebo(self, gazebo: Element, trace: Step | None) -> None:
        """Note what the model of the robot does not have of a `<gazebo>`."""
        reference = attribute_text(gazebo, "reference")
        owner = "the robot" if reference is None else f"'{reference}'"
        for child in gazebo.elements():
            if child.name in FOR_LUMPING or is_surface(child, self._robot, reference):
                continue
            if child.name in ("sensor", "plugin"):
                inner = (each.span.key() for each in child.elements())  # cameras of a multicamera
                if not self._sensors.isdisjoint((child.span.key(), *inner)):
                    self._check_sensor(child, owner, trace)
                    continue
            what = f"Gazebo's <{child.name}> elements"
            self.losses.lose_xml(what, child, label=owner, trace=trace)

    def _check_sensor(self, element: Element, owner: str, trace: Step | None) -> None:
        """Note what a sensor says that the model of the robot does not have."""
        for child in element.elements():
            if child.name == "plugin":
                self.losses.lose_xml("Gazebo's <plugin> elements", child, label=owner, trace=trace)
            elif child.elements():
                self._check_sensor(child, owner, trace)
            elif child.name not in IN_SENSORS or (
                child.name == "mean" and any(numbers_in(content(child)))
            ):
                what, label = "details of Gazebo's sensors", f"<{child.name}> in {owner}"
                self.losses.lose_xml(what, child, label=label, trace=trace)

    def check_transmission(self, transmission: Element, trace: Step | None) -> None:
        """Note a transmission, or a joint of it, that gives the model no actuator.

        It may have another one, which wins.
        """
        if self._actuators is None:
            self._actuators = {each.span.key() for each in self._robot.actuators.values()}
        joints = [child for child in transmission.elements() if child.name == "joint"]
        idle = [each for each in joints if each.span.key() not in self._actuators]
        name = f"'{attribute_text(transmission, 'name') or ''}'"
        what = "transmissions that give no actuator"
        if len(idle) == len(joints):
            self.losses.lose_xml(what, transmission, label=name, trace=trace)
            return
        for joint in idle:
            owner = f"joint '{attribute_text(joint, 'name') or ''}' of {name}"
            self.losses.lose_xml(what, joint, label=owner, trace=trace)


# --- the XML that a file holds for one output format, by what it belongs to -------------------


class RawXmlOf:
    """The elements for a format.

    Attributes:
        robot: those for the robot as a whole.
    """

    __slots__ = ("_left", "robot")

    def __init__(self, robot: Robot, format: str) -> None:
        """Gather the elements for a format of a robot."""
        self._left: dict[tuple[str, str], list[RawXml]] = {}
        self.robot: list[Element] = []
        for raw in Translation(robot, format).blocks:
            if raw.link is not None:
                self._left.setdefault(("link", raw.link), []).append(raw)
            elif raw.joint is not None:
                self._left.setdefault(("joint", raw.joint), []).append(raw)
            else:
                self.robot += elements_of(raw)

    def in_link(self, name: str) -> list[Element]:
        """Return the elements for a link, once."""
        return self._taken("link", name)

    def in_joint(self, name: str) -> list[Element]:
        """Return the elements for a joint, once."""
        return self._taken("joint", name)

    def left(self) -> Losses:
        """Return the losses of elements that were not taken: what they are in is not written."""
        found = Losses()
        what, hint = "blocks in what is not an element", "write the block in another link or joint"
        for (kind, name), blocks in self._left.items():
            for raw in blocks:
                found.lose(what, raw, label=f"{kind} '{name}'", hint=hint)
        return found

    def _taken(self, kind: str, name: str) -> list[Element]:
        found = self._left.pop((kind, name), ())
        return [element for raw in found for element in elements_of(raw)]


def elements_of(raw: RawXml) -> list[Element]:
    """Return the elements of a block, each with the calls and includes that led to it."""
    return [each.settled(raw.trace) for each in raw.elements]


def lost_blocks(robot: Robot, format: str) -> Losses:
    """Return the losses of blocks for another format, which the robot was read from.

    What YAML says for another format is not run, so that it is in no robot.
    """
    translation = Translation(robot, format)
    found, taken = Losses(), translation.taken
    for raw in translation.screws:
        how = "a hinge and a slide with an equality"
        if format == "urdf":
            how = "a joint that turns and one that slides, which follows it"
        found.approximate("SDF's screw joints", raw, label=f"joint '{raw.joint}'", how=how)
    for raw in robot.raw():
        if raw.format == format:
            continue
        title = TARGETS[raw.format].title if raw.format in TARGETS else raw.format
        home = f"link '{raw.link}'" if raw.link is not None else f"joint '{raw.joint}'"
        label = home if raw.link is not None or raw.joint is not None else "the robot"
        is_typed = raw.joint is not None and any(
            each.name == "type" and id(each) not in taken for each in raw.elements
        )
        known: set[str] = set()  # what the model has of the link
        link = robot.links.get(raw.link or "")
        if link is not None:
            known = {each.name for each in link.visuals} | {each.name for each in link.collisions}
            known |= {joint.child for joint in robot.joints_below(link.name) if joint.is_fixed}
        for each in raw.elements:
            if id(each) in taken or (is_typed and each.name in _OF_TYPES):
                continue
            is_section = each.name in _SECTIONS and raw.format == "mjcf"
            inner = each.elements() if is_section else [each]
            for element in inner or ([each] if each.attributes else []):
                is_place = element.name == "pos" and raw.joint is not None
                if id(element) in taken or element.body == SAID or is_place:
                    continue
                if _says_nothing(element, each.name):
                    continue
                trace = element.trace_within(each.trace_within(raw.trace))
                name = attribute_text(element, "name")
                own = f"'{name}' in {label}" if name and label != "the robot" else ""
                label_of = own or (f"'{name}'" if name else label)
                what = _what(robot, raw, element, title, known)
                found.lose_xml(what, element, label=label_of, trace=trace)
    return found


_SECTIONS = frozenset(
    """asset worldbody contact equality tendon actuator sensor keyframe custom extension
    deformable""".split()
)
"""The elements of MJCF that only hold others."""
_OF_TYPES = frozenset(
    """pose axis axis2 thread_pitch screw_thread_pitch gearbox_ratio
    gearbox_reference_body""".split()
)
"""What a joint of SDF has because of a type that URDF has not."""
_STRUCTURE = frozenset(("ref",))
"""What the poses of joints say as well; in a joint, `pos` does so too."""


def _says_nothing(element: Element, section: str) -> bool:
    """Return whether an element of a block is only about how its writer writes the rest."""
    if element.attributes or element.elements():
        is_ordered = section in ("actuator", "geom", "site", "freejoint")
        is_named = element.attributes.keys() <= {"name", "joint"}
        return is_ordered and is_named and not element.elements()
    text = element.text().strip()
    is_unlimited = element.name.endswith("limited") and text == "false"
    return is_unlimited or element.name in _STRUCTURE or (element.name, text) == ("gravcomp", "0")


def _what(robot: Robot, raw: RawXml, element: Element, title: str, known: Collection[str]) -> str:
    """Return what an element of a block is called in losses, in the plural.

    `known` are the names of what the model has of the link that the block is in.
    """
    if element.text().strip() and not element.elements() and not element.attributes:
        if element.name == "type" and raw.joint is not None:  # a joint that is fixed in the model
            return f"{title}'s {element.text().strip()} joints"
        return f"{title}'s values of '{element.name}'"
    if element.name == "joint" and raw.link is not None:
        return f"{title}'s {attribute_text(element, 'type') or 'hinge'} joints"
    name = attribute_text(element, "name")
    is_detail = name in known or (raw.joint in robot.actuators and raw.joint is not None)
    is_detail |= element.name == "joint" and "joint1" in element.attributes
    is_detail |= element.name == "key" and name in robot.states
    is_detail |= element.name in ("sensor", "camera") and name in robot.sensors
    is_detail |= element.name == "axis" and raw.joint is not None
    word = f"{title}'s <{element.name}>"
    return f"details of {word}" if is_detail else f"{word} elements"


def settings_in(elements: list[Element]) -> tuple[dict[str, Element], list[Element]]:
    """Return the elements that are an attribute in a format without texts, and the others.

    An element with only a text in it, such as `<armature>0.01</armature>`, says the attribute
    `armature` of what it is in.
    """
    settings: dict[str, Element] = {}
    rest: list[Element] = []
    for element in elements:
        if element.text().strip() and not element.elements() and not element.attributes:
            settings[element.name] = element
        else:
            rest.append(element)
    return settings, rest
