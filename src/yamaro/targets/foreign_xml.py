"""XML of a robot that is not URDF: of other programs, or of nobody."""

from __future__ import annotations

from ..diagnostics import INHERITED
from ..model.urdf_schema import ELEMENTS
from ..model.values import attribute_text
from ..xml.tree import Element
from .output import LOST, Loss

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection

    from ..diagnostics import Frame as Step
    from ..model.robot import Robot

IN_THE_MODEL = frozenset(("transmission", "ros2_control"))
"""What the model of the robot reads, so that its writer says whether it is lost."""
SURFACE_TAGS = frozenset(("mu1", "mu2", "kp", "kd"))
FOR_LUMPING = frozenset(
    (
        "preserveFixedJoint",
        "disableFixedJointLumping",
        "disableJointLumping",
        "implicitSpringDamper",
    )
)
"""What is only about how Gazebo reads URDF."""


def foreign_losses(robot: Robot, *, taken: Collection[str] = ()) -> list[Loss]:
    """Return the losses of a format that takes no XML of other programs.

    Sensors and surfaces in `<gazebo>` that the model of the robot has are left out, and so are
    `<transmission>` and `<ros2_control>`: the writer knows what is lost of them.

    Args:
        robot: the robot.
        taken: names of elements under the robot that the format takes, or reports itself.
    """
    walk = _Walk(robot)
    root = robot.element
    above = None if root.trace is INHERITED else root.trace
    for child in root.elements():
        trace = above if child.trace is INHERITED else child.trace
        if child.name in taken or child.name in IN_THE_MODEL:
            continue
        if child.name in ("link", "joint", "material"):
            walk.check(child, f"{child.name} '{attribute_text(child, 'name') or ''}'", trace)
        elif child.name == "gazebo":
            walk.check_gazebo(child, trace)
        else:
            walk.lose(f"<{child.name}> elements", "the robot", child, trace)
    return walk.losses


class _Walk:
    """Looks at the elements of one robot.

    Attributes:
        losses: what was found.
    """

    __slots__ = ("_robot", "_sensors", "_sound", "losses")

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._sensors: set[object] | None = None
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
            if name not in rule.attributes and element.attributes[name] is not None:
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
            if child.name in FOR_LUMPING or (reference is not None and child.name in SURFACE_TAGS):
                continue
            if child.name in ("sensor", "plugin") and self._is_sensor(child):
                for plugin in child.elements():
                    if plugin.name == "plugin":
                        self.lose("Gazebo's <plugin>", owner, plugin, trace)
                continue
            self.lose(f"Gazebo's <{child.name}>", owner, child, trace)

    def _is_sensor(self, element: Element) -> bool:
        """Return whether the model has a sensor that is written there."""
        if self._sensors is None:
            self._sensors = {each.span.key() for each in self._robot.sensors.values()}
        inner = [child.span.key() for child in element.elements()]  # the cameras of a multicamera
        return not self._sensors.isdisjoint((element.span.key(), *inner))
