"""XML of a robot that is not URDF: of other programs, or of nobody."""

from __future__ import annotations

from ..diagnostics import INHERITED
from ..model.recognition import SURFACE_TAGS
from ..model.schema import ELEMENTS
from ..model.values import attribute_text, content, numbers_in
from ..xml.tree import Element
from .output import LOST, Loss

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection

    from ..diagnostics import Frame as Step
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


def foreign_losses(robot: Robot, *, taken: Collection[str] = ()) -> list[Loss]:
    """Return the losses of a format that takes no XML of other programs.

    Sensors and surfaces in `<gazebo>` and actuators in `<transmission>` that the model of the robot
    has are left out, and so is `<ros2_control>`: the writer knows what is lost of them.

    Args:
        robot: the robot.
        taken: names of elements under the robot that the format takes, or reports itself.
    """
    walk = _Walk(robot)
    root = robot.element
    above = None if root.trace is INHERITED else root.trace
    for child in root.elements():
        trace = above if child.trace is INHERITED else child.trace
        if child.name in taken or child.name == "ros2_control":
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
            walk.lose(f"<{child.name}> elements", "the robot", child, trace)
    walk.losses += _outside_of_the_tree(robot)
    return walk.losses


def _outside_of_the_tree(robot: Robot) -> list[Loss]:
    """Return the losses of joints that join nothing, or a link that has another joint already."""
    return [
        Loss(
            LOST,
            "joints outside of the tree",
            f"joint '{joint.name}'",
            joint.span,
            trace=joint.trace,
        )
        for joint in robot.all_joints
        if robot.parent_joint(joint.child) is not joint
    ]


def _is_plain(element: Element) -> bool:
    """Return whether a link, joint or material has nothing but what URDF has."""
    rule = ELEMENTS[element.name]
    if not element.attributes.keys() <= rule.fields.keys():
        return False
    known = rule.children
    for child in element.children:
        if isinstance(child, Element) and not (child.name in known and _is_plain(child)):
            return False
    return True


class _Walk:
    """Looks at the elements of one robot.

    Attributes:
        losses: what was found.
    """

    __slots__ = ("_actuators", "_robot", "_sensors", "_sound", "losses")

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._sensors: set[object] | None = None
        self._actuators: set[object] | None = None
        self._sound: set[int] = set()  # the identities of elements in which nothing is foreign
        self.losses: list[Loss] = []

    def lose(self, what: str, owner: str, element: Element, trace: Step | None) -> None:
        """Note a loss."""
        self.losses.append(Loss(LOST, what, owner, element.span, trace=trace))

    def check(self, element: Element, owner: str, trace: Step | None) -> None:
        """Note what URDF does not have in a link, joint or material."""
        if id(element) in self._sound:
            return
        before = len(self.losses)
        rule = ELEMENTS[element.name]
        for name in element.attributes:
            if name not in rule.fields and element.attributes[name] is not None:
                span = element.name_span(name)
                what = f"attributes '{name}' of <{element.name}>"
                self.losses.append(Loss(LOST, what, owner, span, trace=trace))
        for child in element.elements():
            if child.name in rule.children:
                self.check(child, owner, trace if child.trace is INHERITED else child.trace)
            else:
                self.lose(f"<{child.name}> elements", owner, child, trace)
        if len(self.losses) == before:
            self._sound.add(id(element))

    def check_gazebo(self, gazebo: Element, trace: Step | None) -> None:
        """Note what the model of the robot does not have of a `<gazebo>`."""
        reference = attribute_text(gazebo, "reference")
        owner = "the robot" if reference is None else f"'{reference}'"
        for child in gazebo.elements():
            if child.name in FOR_LUMPING or self._is_surface(child, reference):
                continue
            if child.name in ("sensor", "plugin") and self._is_sensor(child):
                self._check_sensor(child, owner, trace)
                continue
            self.lose(f"Gazebo's <{child.name}> elements", owner, child, trace)

    def _is_surface(self, element: Element, reference: str | None) -> bool:
        """Return whether the model has the surface that an element is part of."""
        link = self._robot.links.get(reference or "")
        if element.name not in SURFACE_TAGS or link is None or not link.collisions:
            return False
        return len(numbers_in(content(element))) == 1

    def _check_sensor(self, element: Element, owner: str, trace: Step | None) -> None:
        """Note what a sensor says that the model of the robot does not have."""
        for child in element.elements():
            if child.name == "plugin":
                self.lose("Gazebo's <plugin> elements", owner, child, trace)
            elif child.elements():
                self._check_sensor(child, owner, trace)
            elif child.name not in IN_SENSORS or (child.name == "mean" and _is_not_zero(child)):
                self.lose("details of Gazebo's sensors", f"<{child.name}> in {owner}", child, trace)

    def check_transmission(self, transmission: Element, trace: Step | None) -> None:
        """Note a transmission, or a joint of it, that gives the model no actuator.

        It may have another one, which wins.
        """
        if self._actuators is None:
            self._actuators = {each.span.key() for each in self._robot.actuators.values()}
        joints = [child for child in transmission.elements() if child.name == "joint"]
        idle = [each for each in joints if each.span.key() not in self._actuators]
        name = f"'{attribute_text(transmission, 'name') or ''}'"
        if len(idle) == len(joints):
            self.lose("transmissions that give no actuator", name, transmission, trace)
            return
        for joint in idle:
            owner = f"joint '{attribute_text(joint, 'name') or ''}' of {name}"
            self.lose("transmissions that give no actuator", owner, joint, trace)

    def _is_sensor(self, element: Element) -> bool:
        """Return whether the model has a sensor that is written there."""
        if self._sensors is None:
            self._sensors = {each.span.key() for each in self._robot.sensors.values()}
        inner = [child.span.key() for child in element.elements()]  # the cameras of a multicamera
        return not self._sensors.isdisjoint((element.span.key(), *inner))


def _is_not_zero(element: Element) -> bool:
    """Return whether the mean of a noise is one that no format but SDFormat has."""
    return any(numbers_in(content(element)))
