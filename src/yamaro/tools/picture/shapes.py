"""The robot as it is drawn: numbers that no robot has left out, shapes with colour and file."""

from __future__ import annotations

from ...model.reading import read_robot
from ...model.shapes import Mesh

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection

    from ...diagnostics import Frame
    from ...files.mesh_files import MeshFinder
    from ...model.link import Collision, Color, Link, Visual
    from ...model.pose import Pose
    from ...model.robot import Robot
    from ...model.shapes import Shape
    from ...result import Build
    from ...source import Span

LARGEST = 1e9
"""The largest number that is taken for a measure: beyond it, sums of squares overflow."""


class DrawnShape:
    """A shape of a link.

    Attributes:
        link: its link.
        section: the visual or collision that it is in.
        shape: the shape.
        pose: T_link_shape.
        is_visual: whether it is seen, and not for collisions.
        color: red, green, blue, alpha from 0 to 1, or None where none is given.
        path: of a mesh, its file, or None if that is not found.
    """

    __slots__ = ("color", "is_visual", "link", "path", "pose", "section", "shape")

    def __init__(
        self, link: Link, section: Visual | Collision, shape: Shape, *, is_visual: bool
    ) -> None:
        self.link = link
        self.section = section
        self.shape = shape
        self.pose: Pose = section.pose
        self.is_visual = is_visual
        self.color: Color | None = None
        self.path: str | None = None

    @property
    def filename(self) -> str:
        """Return the file of a mesh as written; "" for another shape."""
        return self.shape.filename if isinstance(self.shape, Mesh) else ""

    @property
    def filename_span(self) -> Span:
        """Return where the file of a mesh is written."""
        assert self.shape.element is not None
        return self.shape.element.value_span("filename")

    @property
    def trace(self) -> Frame | None:
        """Return the calls and includes that led to it."""
        return self.section.trace_in(self.link)

    def is_shown(self, shows: Collection[str]) -> bool:
        """Return whether it is one of what is shown: visual or collision shapes."""
        return ("visual" if self.is_visual else "collision") in shows


def drawable_robot(build: Build) -> Robot:
    """Return the robot of a build, in which numbers too large to draw are left out."""
    return read_robot(build.robot_tree(), notes=build.notes, largest=LARGEST)


def shapes_of(robot: Robot, finder: MeshFinder) -> list[DrawnShape]:
    """Return the shapes of all links.

    Raises:
        YamaroError: a mesh lies where it may not be read.
    """
    found = []
    for link in robot.links.values():
        for visual in link.visuals:
            if visual.shape is not None:
                drawn = DrawnShape(link, visual, visual.shape, is_visual=True)
                drawn.color = _color_of(visual, robot)
                found.append(drawn)
        found += [
            DrawnShape(link, collision, collision.shape, is_visual=False)
            for collision in link.collisions
            if collision.shape is not None
        ]
    for drawn in found:
        if drawn.filename:
            drawn.path = finder.resolve(drawn.filename, drawn.filename_span)
    return found


def _color_of(visual: Visual, robot: Robot) -> Color | None:
    material = robot.material_of(visual)
    if material is None or material.color is None:
        return None
    red, green, blue, alpha = (min(max(part, 0.0), 1.0) for part in material.color)
    return (red, green, blue, alpha)
