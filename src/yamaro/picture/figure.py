"""The figure of a robot: its shapes as bodies of polygons on a stage, and where they are."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkPolyDataNormals
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkCylinderSource, vtkSphereSource

from ..model.reading import read_robot
from ..model.shapes import Box, Capsule, Cylinder, Mesh, Sphere
from .request import FRAMES, GRID, INERTIA, LARGEST, VISUAL
from .stage import Shadow, make_cells, make_matrix, make_points, make_texture, surface_samples

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence

    from numpy.typing import NDArray
    from vtkmodules.vtkCommonDataModel import vtkPolyData
    from vtkmodules.vtkRenderingCore import vtkActor

    from ..diagnostics import Diagnostic, Frame
    from ..files.mesh_files import MeshFinder
    from ..meshes.surfaces import Surface
    from ..model.link import Collision, Inertial, Link, Visual
    from ..model.link import Color as RobotColor
    from ..model.pose import Pose
    from ..model.robot import Robot
    from ..model.shapes import Shape
    from ..result import Build
    from ..source import Span
    from .meshes import Meshes
    from .stage import Color, Stage

    Floats = NDArray[np.floating[Any]]


# --- bodies -----------------------------------------------------------------------------------


ROUND = 64
"""Corners of a circle."""

SHARP = 32.0
"""The angle in degrees from which an edge between two triangles is seen as one."""


def shape_body(shape: Shape) -> vtkPolyData:
    """Return the polygons of a shape that is not a mesh, in its own frame."""
    match shape:
        case Box():
            return box_body(shape.size)
        case Sphere():
            return sphere_body(shape.radius)
        case Cylinder():
            return cylinder_body(shape.radius, shape.length)
        case Capsule():
            return cylinder_body(shape.radius, shape.length, is_capsule=True)
        case _:
            raise AssertionError(shape.kind)


def box_body(size: Sequence[float]) -> vtkPolyData:
    """Return a box around the origin, with edges of these lengths in metres."""
    source = vtkCubeSource()
    source.SetXLength(size[0])
    source.SetYLength(size[1])
    source.SetZLength(size[2])
    return _output(source)


def sphere_body(radius: float) -> vtkPolyData:
    """Return a ball around the origin."""
    source = vtkSphereSource()
    source.SetRadius(radius)
    source.SetThetaResolution(ROUND)
    source.SetPhiResolution(ROUND // 2)
    return _output(source)


def cylinder_body(radius: float, length: float, *, is_capsule: bool = False) -> vtkPolyData:
    """Return a cylinder around the origin, along z; a capsule has half a ball at each end."""
    source = vtkCylinderSource()
    source.SetRadius(radius)
    source.SetHeight(length)
    source.SetResolution(ROUND)
    source.SetCapsuleCap(is_capsule)
    turn = vtkTransform()
    turn.RotateX(90)  # VTK's axis is y
    return _transformed(_output(source), turn)


def surface_body(surface: Surface, scale: Sequence[float]) -> vtkPolyData:
    """Return the polygons of a mesh's surface, scaled along its axes."""
    body = vtkPolyData()
    body.SetPoints(make_points(surface.points * scale))
    is_mirrored = scale[0] * scale[1] * scale[2] < 0
    triangles = surface.triangles[:, ::-1] if is_mirrored else surface.triangles
    body.SetPolys(make_cells(triangles))
    if surface.point_colors is not None:
        colors = numpy_to_vtk(np.ascontiguousarray(surface.point_colors), deep=True)
        body.GetPointData().SetScalars(colors)
    if surface.texture_points is None or surface.normals is None:
        return smoothed(body)
    places = numpy_to_vtk(np.ascontiguousarray(surface.texture_points, np.float32), deep=True)
    body.GetPointData().SetTCoords(places)
    directions = surface.normals / np.where(np.array(scale) == 0, 1, scale)
    directions /= np.maximum(np.linalg.norm(directions, axis=1, keepdims=True), 1e-12)
    body.GetPointData().SetNormals(numpy_to_vtk(np.ascontiguousarray(directions), deep=True))
    return body


def smoothed(body: vtkPolyData) -> vtkPolyData:
    """Return polygons with normals that make round what is round, and keep sharp edges sharp."""
    merge = vtkCleanPolyData()
    merge.SetInputData(body)
    merge.SetTolerance(1e-6)
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(merge.GetOutputPort())
    normals.SetFeatureAngle(SHARP)
    normals.ConsistencyOff()
    return _output(normals)


def inertia_box(inertial: Inertial) -> tuple[Floats, Floats] | None:
    """Return the box of even density that has the mass and moments of a link.

    With principal moments I₁ ≤ I₂ ≤ I₃ and edges a, b, c along their axes, I₁ = m/12·(b² + c²) and
    so on; so a² = 6/m·(I₂ + I₃ − I₁). A moment that no body can have gives an edge of 0.

    Returns:
        The edges in metres, and their directions as columns in the frame of the inertial; None
        without mass, or of a size that nothing has.
    """
    if not inertial.mass > 0:
        return None
    moments, axes = np.linalg.eigh(inertial.matrix())
    if np.linalg.det(axes) < 0:
        axes[:, 2] *= -1
    edges = np.sqrt(np.maximum(6 / inertial.mass * (moments.sum() - 2 * moments), 0))
    return (edges, axes) if edges.max() <= LARGEST else None


def axes_bodies(length: float) -> list[tuple[vtkPolyData, tuple[float, float, float]]]:
    """Return three arms along x, y and z with their colours, red, green and blue."""
    thickness = length / 16
    turns = ((90.0, 0.0, 1.0, 0.0), (-90.0, 1.0, 0.0, 0.0), None)
    colors = ((0.86, 0.16, 0.19), (0.18, 0.62, 0.24), (0.16, 0.36, 0.86))
    found = []
    for turn, color in zip(turns, colors, strict=True):
        transform = vtkTransform()
        if turn is not None:
            transform.RotateWXYZ(*turn)
        transform.Translate(0, 0, length / 2)
        found.append((_transformed(cylinder_body(thickness, length), transform), color))
    return found


def corners_of(body: vtkPolyData) -> Floats:
    """Return the points of a body, N×3."""
    if not body.GetNumberOfPoints():
        return np.zeros((0, 3))
    points: Floats = vtk_to_numpy(body.GetPoints().GetData()).astype(float)
    return points


def _transformed(body: vtkPolyData, transform: vtkTransform) -> vtkPolyData:
    move = vtkTransformPolyDataFilter()
    move.SetInputData(body)
    move.SetTransform(transform)
    return _output(move)


def _output(algorithm: Any) -> vtkPolyData:
    algorithm.Update()
    return algorithm.GetOutput()


# --- shapes -----------------------------------------------------------------------------------


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
        self.color: RobotColor | None = None
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


def _color_of(visual: Visual, robot: Robot) -> RobotColor | None:
    material = robot.material_of(visual)
    if material is None or material.color is None:
        return None
    red, green, blue, alpha = (min(max(part, 0.0), 1.0) for part in material.color)
    return (red, green, blue, alpha)


# --- figure -----------------------------------------------------------------------------------


PLAIN: Color = (0.74, 0.76, 0.79)
"""The colour of what has none."""
COLLIDING: Color = (0.93, 0.60, 0.22)
WEIGHING: Color = (0.50, 0.34, 0.80)
MISSING: Color = (0.90, 0.30, 0.25)
MISSING_EDGE = 0.06
"""The edge of the box in place of a mesh, as a part of the robot's size."""
BONES: Color = (0.30, 0.34, 0.40)

DIRECTIONS = np.array(
    [(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if x or y or z], float
)
"""To the middles of the faces and edges of a cube, and to its corners."""

SAMPLES = 60_000
"""Points on the surface of the robot that its shadow is made of."""


class Body:
    """One body on the stage.

    Attributes:
        actor: what VTK draws.
        link: the name of the link it moves with.
        T_link_body: its pose, 4×4.
        outline: its outermost points in its own frame, N×3.
        samples: points all over its surface, for its shadow; none if it has no shadow.
    """

    __slots__ = ("T_link_body", "actor", "link", "outline", "samples")

    def __init__(self, actor: vtkActor, link: str, T_link_body: Floats, outline: Floats) -> None:
        self.actor = actor
        self.link = link
        self.T_link_body = T_link_body
        self.outline = outline
        self.samples: Floats = np.zeros((0, 3))


class Figure:
    """A robot on a stage."""

    def __init__(
        self,
        robot: Robot,
        shapes: Sequence[DrawnShape],
        stage: Stage,
        shows: Collection[str],
        meshes: Meshes,
    ) -> None:
        """Put the robot on the stage; `set_positions` has to say where its joints are.

        Args:
            robot: the robot.
            shapes: those of its links.
            stage: the stage.
            shows: some of SHOWN.
            meshes: those of the robot.
        """
        self.robot = robot
        self._shapes = shapes
        self.stage = stage
        self._meshes = meshes
        self._bodies: list[Body] = []
        self._bones: vtkActor | None = None
        self._poses: dict[str, Floats] = {}
        self._has_bones = FRAMES in shows
        self._has_grid = GRID in shows
        self._build(shows)

    def _build(self, shows: Collection[str]) -> None:
        is_veiled = INERTIA in shows or FRAMES in shows
        opacity = {True: 0.35 if is_veiled else 1.0, False: 0.45 if VISUAL in shows else 1.0}
        missing = [
            shape
            for shape in self._shapes
            if shape.is_shown(shows) and not self._add_shape(shape, opacity[shape.is_visual])
        ]
        for link in self.robot.links.values():
            if INERTIA in shows and link.inertial is not None:
                self._add_inertia(link, link.inertial)
        self.set_positions({})
        # Links count even where there is nothing to see, and so do meshes that cannot be drawn.
        marks = [(shape.link.name, shape.pose.position) for shape in missing]
        around = [self.outline(), self._origins()]
        around += [_moved(np.array([position]), self._poses[name]) for name, position in marks]
        extent = float(np.ptp(np.concatenate(around), axis=0).max())
        size = extent if extent > 1e-6 else 1.0
        for shape in missing:
            edge = MISSING_EDGE * size
            T_link_body = np.array(shape.pose.matrix())
            body = self._add(shape.link, box_body((edge, edge, edge)), T_link_body, MISSING, 0.55)
            look = body.actor.GetProperty()
            look.EdgeVisibilityOn()
            look.SetEdgeColor(*MISSING)
            self._has_bones = True  # to show what is connected
        if FRAMES in shows:
            for link in self.robot.links.values():
                for body, color in axes_bodies(0.07 * size):
                    self._add(link, body, np.eye(4), color)
        self.set_positions({})
        # The samples of the shadow are spread over the bodies, by the size of their boxes.
        bodies = [body for body in self._bodies if len(body.outline)]
        sizes = [np.ptp(body.outline, axis=0) for body in bodies]
        areas: Floats = np.array([x * y + y * z + z * x for x, y, z in sizes])
        for body, share in zip(bodies, areas / max(areas.sum(), 1e-12), strict=True):
            polygons = body.actor.GetMapper().GetInput()
            triangles = _triangles_of(polygons)
            if len(triangles):
                count = int(SAMPLES * share) + 100
                body.samples = surface_samples(corners_of(polygons), triangles, count)
        self.stage.shade_corners(size)

    @property
    def warnings(self) -> list[Diagnostic]:
        """Return the warnings about meshes that cannot be drawn."""
        return self._meshes.warnings

    # --- bodies ---

    def _add(
        self, link: Link, body: vtkPolyData, T_link_body: Floats, color: Color, opacity: float = 1.0
    ) -> Body:
        actor = self.stage.add(body, color, opacity)
        added = Body(actor, link.name, T_link_body, outermost(corners_of(body)))
        self._bodies.append(added)
        return added

    def _add_shape(self, shape: DrawnShape, opacity: float) -> bool:
        """Add a shape, or return that it cannot be drawn."""
        link = shape.link
        if not isinstance(shape.shape, Mesh):
            color, alpha = _look_of(shape, shape.color)
            T_link_body = np.array(shape.pose.matrix())
            self._add(link, shape_body(shape.shape), T_link_body, color, alpha * opacity)
            return True
        surfaces = self._meshes.surfaces_of(shape)
        for surface in surfaces:
            is_own = shape.is_visual and surface.has_look  # before the robot's colours, as in RViz
            color, alpha = _look_of(shape, surface.color if is_own else shape.color)
            body = surface_body(surface, shape.shape.size)
            T_link_body = np.array(shape.pose.matrix())
            actor = self._add(shape.link, body, T_link_body, color, alpha * opacity).actor
            if not is_own:
                actor.GetMapper().ScalarVisibilityOff()
            elif surface.texture is not None:
                actor.GetProperty().SetColor(1, 1, 1)
                actor.SetTexture(make_texture(surface.texture[::-1]))
        return bool(surfaces)

    def _add_inertia(self, link: Link, inertial: Inertial) -> None:
        found = inertia_box(inertial)
        if found is None:
            return
        edges, axes = found
        T_link_body = np.array(inertial.pose.matrix())
        turned = T_link_body.copy()
        turned[:3, :3] = T_link_body[:3, :3] @ axes
        self._add(link, box_body(edges.tolist()), turned, WEIGHING, 0.45)
        ball = sphere_body(0.08 * max(float(edges.max()), 1e-3))
        self._add(link, ball, T_link_body, BONES)

    # --- positions ---

    def set_positions(self, positions: Mapping[str, float]) -> None:
        """Move the joints; those that are not named are at their rest position."""
        at_rest = {joint.name: joint.rest for joint in self.robot.free_joints()}
        poses = self.robot.poses({**at_rest, **positions})
        self._poses = {name: np.array(pose.matrix()) for name, pose in poses.items()}
        for body in self._bodies:
            body.actor.SetUserMatrix(make_matrix(self._poses[body.link] @ body.T_link_body))
        if self._has_bones:
            # Draw a line from each link to its children.
            if self._bones is not None:
                self.stage.remove(self._bones)
                self._bones = None
            pairs = [
                (self._poses[joint.parent][:3, 3], self._poses[joint.child][:3, 3])
                for joint in self.robot.joints.values()
                if joint.parent in self._poses and joint.child in self._poses
            ]
            if pairs:
                self._bones = self.stage.add_lines(np.array(pairs), BONES, 1.5)

    def outline(self) -> Floats:
        """Return the outermost points, which have to be in a picture, N×3."""
        found = [
            _moved(body.outline, self._poses[body.link] @ body.T_link_body) for body in self._bodies
        ]
        if self._has_bones or not any(map(len, found)):
            found.append(self._origins())
        return np.concatenate(found)

    def _origins(self) -> Floats:
        """Return the origins of all links, N×3; that of the world if there are none."""
        return np.array([pose[:3, 3] for pose in self._poses.values()] or np.zeros((1, 3)))

    def lay_floor(self, level: float, size: float) -> None:
        """Put a floor under the robot in its current pose, at a height in metres."""
        samples = [_moved(b.samples, self._poses[b.link] @ b.T_link_body) for b in self._bodies]
        if any(map(len, samples)):
            shadow = Shadow(np.concatenate(samples), level, size)
            self.stage.lay_floor(shadow, level, size=size, has_grid=self._has_grid)


def _look_of(shape: DrawnShape, given: Sequence[float] | None) -> tuple[Color, float]:
    """Return color and opacity of a shape, which may have been given some."""
    if given is None:
        return PLAIN if shape.is_visual else COLLIDING, 1.0
    red, green, blue, alpha = given
    return (red, green, blue), alpha


def _moved(points: Floats, T: Floats) -> Floats:
    moved: Floats = points @ T[:3, :3].T + T[:3, 3]
    return moved


def outermost(points: Floats) -> Floats:
    """Return those of some points that lie furthest out, in directions all around, N×3."""
    if not len(points):
        return points
    found = {int((points @ direction).argmax()) for direction in DIRECTIONS}
    return points[sorted(found)]


def _triangles_of(body: vtkPolyData) -> NDArray[np.integer[Any]]:
    """Return the triangles of a body; polygons are cut into fans."""
    cells = body.GetPolys()
    if not cells.GetNumberOfCells():
        return np.zeros((0, 3), int)
    offsets = vtk_to_numpy(cells.GetOffsetsArray())
    corners = vtk_to_numpy(cells.GetConnectivityArray())
    counts = np.diff(offsets)
    fans = []
    for step in range(1, counts.max() - 1):
        starts = offsets[:-1][counts > step + 1]
        fans.append(
            np.stack([corners[starts], corners[starts + step], corners[starts + step + 1]], 1)
        )
    return np.concatenate(fans) if fans else np.zeros((0, 3), int)
