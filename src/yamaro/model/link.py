"""Links: mass and inertia, visuals, collisions, and the materials of visuals."""

from __future__ import annotations

from .values import ReadLater, Written

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..diagnostics import Frame as Step
    from ..xml.tree import Element
    from .pose import Pose, Rotation
    from .shapes import Inertia, Shape

Color = tuple[float, float, float, float]
"""Red, green, blue and alpha; right ones are from 0 to 1."""


class Inertial(Written):
    """The mass of a link, and how it is distributed.

    Attributes:
        mass: in kg.
        pose: T_link_inertial; its position is the centre of mass.
        inertia: ixx, ixy, ixz, iyy, iyz, izz about the centre of mass, along the axes of the pose,
            in kg·m².
    """

    __slots__ = ("inertia", "mass", "pose")

    def __init__(self, element: Element, *, mass: float, pose: Pose, inertia: Inertia) -> None:
        self.element = element
        self.mass = mass
        self.pose = pose
        self.inertia = inertia

    def matrix(self) -> Rotation:
        """Return the 3×3 inertia matrix about the centre of mass, as rows, in kg·m²."""
        ixx, ixy, ixz, iyy, iyz, izz = self.inertia
        return ((ixx, ixy, ixz), (ixy, iyy, iyz), (ixz, iyz, izz))


class Material(Written):
    """A material: a definition, or what a visual refers to by its name.

    Attributes:
        name: its name, or "".
        color: as written, or None if it has none.
        texture: the file of its texture as written, or None.
    """

    __slots__ = ("color", "name", "texture")

    def __init__(
        self, element: Element, *, name: str, color: Color | None, texture: str | None
    ) -> None:
        self.element = element
        self.name = name
        self.color = color
        self.texture = texture

    @property
    def is_defined(self) -> bool:
        """Return whether it says how the material looks."""
        return self.color is not None or self.texture is not None


class Collision(Written):
    """A shape that a link collides with.

    Attributes:
        name: its name, or "".
        pose: T_link_shape.
        shape: the shape, or None if there is none that is known.
    """

    __slots__ = ("name", "pose", "shape")

    def __init__(self, element: Element, *, name: str, pose: Pose, shape: Shape | None) -> None:
        self.element = element
        self.name = name
        self.pose = pose
        self.shape = shape


class Visual(Written):
    """A shape that is seen of a link.

    Attributes:
        name: its name, or "".
        pose: T_link_shape.
        shape: the shape, or None if there is none that is known.
        material: the material written in it, or None; `Robot.material_of` gives what that means.
    """

    __slots__ = ("material", "name", "pose", "shape")

    def __init__(
        self,
        element: Element,
        *,
        name: str,
        pose: Pose,
        shape: Shape | None,
        material: Material | None,
    ) -> None:
        self.element = element
        self.name = name
        self.pose = pose
        self.shape = shape
        self.material = material


class Link(ReadLater):
    """A link.

    Attributes:
        name: its name, or "".
        inertial: its mass and inertia, or None if it has none.
        visuals: what is seen of it, in order.
        collisions: what it collides with, in order.
        trace: the calls and includes that led to it, innermost first.
    """

    __slots__ = ("collisions", "inertial", "name", "trace", "visuals")

    name: str
    inertial: Inertial | None
    visuals: tuple[Visual, ...]
    collisions: tuple[Collision, ...]
    trace: Step | None

    def __init__(
        self,
        element: Element,
        *,
        name: str,
        trace: Step | None,
        read_rest: Callable[[Link], None],
    ) -> None:
        self.element = element
        self.name = name
        self.trace = trace
        self.read_rest = read_rest

    @property
    def mass(self) -> float:
        """Return its mass in kg; 0 without an inertial."""
        return self.inertial.mass if self.inertial is not None else 0.0

    @property
    def is_empty(self) -> bool:
        """Return whether it has neither mass nor shapes."""
        return self.inertial is None and not self.visuals and not self.collisions

    def __repr__(self) -> str:
        return f"<Link '{self.name}' at {self.span.place()}>"
