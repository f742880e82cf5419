"""Loops in URDF, which is a tree: joints that follow another exactly, and a file beside it."""

from __future__ import annotations

from ...diagnostics import ERROR, Diagnostic
from ...model.loops import closures, driven_joints, exact_mimics, size_of
from ...model.positions import home_positions
from ...xml.tree import Element
from ..elements import element
from ..output import MARK
from ..parameters import yaml_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.robot import Robot
    from ...xml.tree import Node

ENDING = ".loops.yaml"
"""Of the name of the file beside a URDF."""


class Loops:
    """What a URDF has instead of the loops of a robot.

    Attributes:
        open: the loops that a tree does not hold.
    """

    __slots__ = ("_held", "_home", "_mimics", "_robot", "open")

    def __init__(self, robot: Robot) -> None:
        """Find the joints that loops make follow others."""
        self._robot = robot
        self._home = home_positions(robot)
        self._mimics, self._held = exact_mimics(robot, self._home, driven_joints(robot))
        self.open = [loop for loop in robot.loops.values() if loop.name not in self._held]

    def in_tree(self, root: Element) -> Element:
        """Return the `<robot>` with a `<mimic>` in each joint that follows another exactly."""
        if not self._mimics:
            return root
        names = {id(self._robot.joints[name].element): name for name in self._mimics}
        children: list[Node] = []
        for child in root.children:
            name = names.get(id(child))
            if name is not None and isinstance(child, Element):
                loop, leader, multiplier, offset = self._mimics[name]
                values = {"multiplier": multiplier, "offset": offset}
                mimic = element("mimic", {"joint": leader, **values}, owner=loop)
                child = child.with_children([*child.children, mimic])
            children.append(child)
        return root.with_children(children)

    def file(self) -> bytes:
        """Return the file beside the URDF: the loops, and where they are closed."""
        loops = []
        for loop in self._robot.loops.values():
            entry: dict[str, object] = {
                "name": loop.name,
                "type": loop.type,
                "between": list(loop.between),
            }
            if loop.axis is not None and loop.type == "revolute":
                entry["axis"] = list(loop.axis)
            entry["exact"] = loop.name in self._held
            loops.append(entry)
        names = [
            joint.name
            for closure in closures(self._robot, size_of(self._robot, self._home))
            for joint in closure.joints
        ]
        content: dict[str, object] = {"robot": self._robot.name, "loops": loops}
        content["home"] = {name: self._home[name] for name in names}
        head = f"# {MARK}: the joints that close loops, which URDF does not hold\n"
        return (head + yaml_of(content)).encode()


def lost_loops(robot: Robot) -> list[Diagnostic]:
    """Return an error for each loop that is lost where nothing is written beside the URDF.

    Those that a block for another format says too are for that format.
    """
    return [
        Diagnostic(
            "lost-in-urdf",
            f"URDF cannot hold the loop '{loop.name}'",
            loop.span_of("name"),
            hint="-o robot.urdf writes it beside the URDF, in robot.loops.yaml; "
            "--allow lost-in-urdf writes the robot without it",
            severity=ERROR,
            trace=loop.trace,
        )
        for loop in Loops(robot).open
        if loop.written("of") is None
    ]


def name_beside(file_name: str, robot: Robot) -> str:
    """Return what the file beside a URDF is called."""
    stem = file_name.removesuffix(".urdf").removesuffix(".xml") or robot.name or "robot"
    return stem + ENDING
