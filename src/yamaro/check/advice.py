"""Advice on a robot that is legal, but holds what is seldom meant: wrong units, outliers, traps.

Each of these is right in some good robot, so they are shown only to those who ask.
"""

from __future__ import annotations

from math import fabs, pi, remainder, sqrt

from ..model.joint import FIXED, FLOATING, REVOLUTE
from ..model.kinematics import base_of
from ..model.link import Inertial
from ..model.shapes import Mesh
from .center import advise_on_center
from .context import CheckContext, counted, label, shown
from .files import advise_on_addresses
from .leftovers import advise_on_leftovers
from .motion import advise_on_motion
from .tree import is_fixed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from ..diagnostics import Reporter
    from ..model.joint import Joint
    from ..model.link import Collision, Link, Visual
    from ..model.pose import Pose
    from ..model.robot import Robot
    from ..source import Span
    from ..xml.tree import Element
    from .tree import Tree

DENSEST = 25_000.0
"""kg/m³; osmium, the densest metal, has 22,590."""
LIGHTEST = 0.5
"""kg/m³; air has 1.2."""
HEAVIEST = 100_000.0
"""kg; more than any robot's link."""
WIDEST_GYRATION = 10.0
"""Metres; a radius of gyration beyond it belongs to a body of some 20 m."""
LARGEST_MESH = 10.0
"""Metres; a larger mesh is most often drawn in millimetres."""
GIMBAL_TOLERANCE = 1e-3
QUARTER_TOLERANCE = 5e-3
"""How far 1.57, 3.14 and 4.71 are from quarter turns, and some room."""
MOST_TURNS = 4 * pi
MOST_SLASHES = 3
"""Names with a slash; where there are more, it is meant."""


def check_advice(
    robot: Robot,
    tree: Tree,
    context: CheckContext,
    *,
    advice: Reporter,
    resolve_mesh: Callable[[str, Span], str | None] | None,
) -> None:
    """Report to `advice` what is legal but seldom meant."""
    told = CheckContext(robot.element, advice, version=context.version, numbers=context.numbers)
    links, joints = tree.links, tree.joints
    children = {joint.child for joint in joints.values()}
    sizes: dict[Mesh, float | None] = {}
    heavy = [name for name, link in links.items() if name not in children and link.inertial]
    heavy = heavy if heavy and _has_fixed_base(robot, tree) else []
    _advise_on_names([*links.values(), *joints.values()], told)
    for name, link in links.items():
        told.outermost = link.element
        if heavy and name == heavy[0]:
            _advise_on_root(link, told)
        _advise_on_mass(link, told)
        advise_on_center(link, told)
        for section in _sections(link):
            _advise_on_pose(section.pose, link.element, told)
            shape = None if isinstance(section, Inertial) else section.shape
            if resolve_mesh is not None and isinstance(shape, Mesh):
                _advise_on_mesh(shape, link, told, resolve_mesh, sizes)
    for joint in joints.values():
        told.outermost = joint.element
        _advise_on_pose(joint.origin, joint.element, told)
        _advise_on_limit(joint, told)
    told.outermost = None
    _advise_on_zero_limits(joints.values(), told)
    advise_on_motion(robot, tree, told)
    advise_on_addresses(context, told)
    if context.has_extensions:
        _advise_on_extensions(robot, tree, told)
    advise_on_leftovers(robot.element, told)
    told.flush()


def _advise_on_extensions(robot: Robot, tree: Tree, context: CheckContext) -> None:
    """Report what the programs refuse or ignore that read the extensions of URDF."""
    blocks: dict[str, list[Element]] = {}
    for element in robot.element.elements():
        blocks.setdefault(element.name, []).append(element)
    if "gazebo" in blocks or "sensor" in blocks:
        from .gazebo import check_gazebo, check_sensors

        check_gazebo(blocks.get("gazebo", ()), tree, context)
        check_sensors(blocks.get("sensor", ()), context)
    if "ros2_control" in blocks or "transmission" in blocks:
        from .control import check_ros2_control, check_transmissions

        check_ros2_control(blocks.get("ros2_control", ()), tree, context)
        check_transmissions(blocks.get("transmission", ()), tree, context)


def _sections(link: Link) -> Iterator[Inertial | Visual | Collision]:
    """Yield the inertial, visuals and collisions in the order written."""
    sections: list[Inertial | Visual | Collision] = [*link.visuals, *link.collisions]
    if link.inertial is not None:
        sections.append(link.inertial)
    by_element = {id(section.element): section for section in sections}
    for child in link.element.children:
        section = by_element.get(id(child))
        if section is not None:
            yield section


def _advise_on_names(named: list[Link | Joint], context: CheckContext) -> None:
    """Report, once, that names have slashes.

    Many names with one are those of a namespace, which robot_state_publisher and tf2 allow, unless
    it begins with the slash.
    """
    found = [each for each in named if "/" in each.name]
    if len(found) > MOST_SLASHES:
        found = [each for each in found if each.name.startswith("/")]
    for group in context.apart("slash-in-name", found, lambda each: (each.element, "name")):
        name, element = group[0].name, group[0].element
        more = len(group) - 1
        context.warn(
            "slash-in-name",
            f"the {element.name} name '{name}' has a '/' in it",
            element,
            attribute="name",
            hint="tools that use it for topics or files fail; use '_', and "
            "a frame_prefix for robot_state_publisher",
            notes=[f"{more} more name{'s have' if more > 1 else ' has'} one"] if more else (),
        )


# --- mass -------------------------------------------------------------------------------------


def _has_fixed_base(robot: Robot, tree: Tree) -> bool:
    """Return whether the root is fixed in the world, as far as the joints are sound."""
    joints = tree.joints.values()
    return all(j.child in tree.links for j in joints) and base_of(robot)[0] == FIXED


def _advise_on_root(link: Link, context: CheckContext) -> None:
    if link.inertial is None:
        return
    context.warn(
        "root-inertia",
        f"the root, {label(link.element)}, has an inertia, which KDL does not support",
        link.inertial.element,
        hint="robot_state_publisher warns of it; a root link without inertial, joined to this one "
        "by a fixed joint, avoids that",
    )


def _advise_on_mass(link: Link, context: CheckContext) -> None:
    inertial = link.inertial
    element = inertial.inner("mass") if inertial is not None else None
    mass = link.mass
    if inertial is None or element is None or mass <= 0:
        return
    if mass > HEAVIEST:
        context.warn(
            "odd-mass",
            f"{label(link.element)} weighs {shown(mass)} kg",
            element,
            attribute="value",
            hint="masses are in kilograms; was this in grams?",
        )
        return
    volume = _volume(link)
    density = mass / volume if volume else None
    if density is not None and not LIGHTEST <= density <= DENSEST:
        context.warn(
            "odd-density",
            f"{label(link.element)} has the density {shown(density)} kg/m³: {shown(mass)} kg in "
            f"{shown(volume)} m³",
            element,
            attribute="value",
            hint="check the units, kilograms and metres; water has 1000, steel 7850 kg/m³",
        )
    _advise_on_inertia(inertial, link, context)


def _advise_on_inertia(inertial: Inertial, link: Link, context: CheckContext) -> None:
    element = inertial.inner("inertia")
    if element is None:
        return
    ixx, _, _, iyy, _, izz = inertial.inertia
    gyration = sqrt(fabs(max(ixx, iyy, izz)) / inertial.mass)
    if gyration > WIDEST_GYRATION:
        context.warn(
            "odd-inertia",
            f"the inertia of {label(link.element)} is that of {shown(inertial.mass)} kg at a "
            f"distance of {shown(gyration)} m from its centre",
            element,
            hint="check the units, kg·m²; in a part, omit `inertia` to compute it",
        )


def _volume(link: Link) -> float:
    """Return the volume of the link's collisions, or visuals, in m³; 0 if a mesh is among them."""
    for sections in (link.collisions, link.visuals):
        shapes = [section.shape for section in sections]
        volumes = [
            shape.volume() for shape in shapes if shape is not None and not isinstance(shape, Mesh)
        ]
        if volumes and len(volumes) == len(shapes) and all(volumes):
            return sum(volumes)
    return 0.0


# --- joints and poses -------------------------------------------------------------------------


def _advise_on_limit(joint: Joint, context: CheckContext) -> None:
    limit = joint.limit
    if limit is None or is_fixed(joint) or joint.type == FLOATING:
        return
    for attribute in ("lower", "upper"):
        bound = limit.number(attribute)
        if joint.type == REVOLUTE and bound is not None and MOST_TURNS < fabs(bound) <= 720:
            context.warn(
                "angle-too-large",
                f"'{attribute}' of joint '{joint.name}' is {shown(bound)} radians, "
                f"{shown(fabs(bound) / (2 * pi))} turns",
                limit.element,
                attribute=attribute,
                hint=f"angles are in radians; for degrees write `$(radians({shown(bound)}))`",
            )
    if context.version == "1.2":
        return
    for attribute in ("acceleration", "deceleration", "jerk"):
        if limit.written(attribute) is not None:
            context.warn(
                "needs-version",
                f"'{attribute}' of joint '{joint.name}' is ignored before URDF 1.2",
                limit.element,
                attribute=attribute,
                hint="write `version=1.2` on the robot, if all "
                "programs that read it support URDF 1.2",
            )


def _advise_on_zero_limits(joints: Iterable[Joint], context: CheckContext) -> None:
    """Report, once, joints that are allowed no effort or no velocity."""
    found = [
        (joint, joint.limit, attributes)
        for joint in joints
        if joint.limit is not None and not is_fixed(joint) and joint.type != FLOATING
        and (attributes := [n for n in ("effort", "velocity") if joint.limit.number(n) == 0])
    ]  # fmt: skip
    for group in context.apart("zero-limit", found, lambda each: (each[1].element, each[2][0])):
        joint, limit, attributes = group[0]
        what = "limit" if len(attributes) == 1 else "limits"
        context.outermost = joint.element
        context.warn(
            "zero-limit",
            f"the {' and '.join(attributes)} {what} of joint '{joint.name}' "
            f"{'is' if len(attributes) == 1 else 'are'} 0, so it cannot be moved",
            limit.element,
            attribute=attributes[0],
            hint="planners and simulators use it literally; write the limit of the motor",
            notes=counted([each.name for each, *_ in group[1:]], "joint", "has such a limit"),
        )
        context.outermost = None


def _advise_on_pose(pose: Pose, owner: Element, context: CheckContext) -> None:
    origin = pose.element
    rpy = context.numbers.row(origin, "rpy", 3)
    if origin is None or not rpy:
        return
    roll, pitch, yaw = rpy
    if all(_is_quarter(angle) for angle in rpy):
        return  # as CAD and careful people write a turned part
    if fabs(fabs(pitch) - pi / 2) < GIMBAL_TOLERANCE and roll and yaw:
        context.warn(
            "gimbal-rpy",
            f"'rpy' in {label(owner)} has a pitch of a quarter turn, at "
            "which roll and yaw rotate about the same axis",
            origin,
            attribute="rpy",
            hint="combine both in the roll: tools may write it back with other numbers",
        )


def _is_quarter(angle: float) -> bool:
    """Return whether an angle is 0 or a number of quarter turns."""
    return fabs(remainder(angle, pi / 2)) < QUARTER_TOLERANCE


# --- meshes -----------------------------------------------------------------------------------


def _advise_on_mesh(
    mesh: Mesh,
    link: Link,
    context: CheckContext,
    resolve_mesh: Callable[[str, Span], str | None],
    sizes: dict[Mesh, float | None],
) -> None:
    element = mesh.element
    if element is None or not mesh.filename or mesh in sizes:
        return
    from ..meshes.triangles import mesh_extent

    path = resolve_mesh(mesh.filename, element.value_span("filename"))
    sizes[mesh] = size = None if path is None else mesh_extent(path, mesh.scale)
    if size is not None and size > LARGEST_MESH:
        context.warn(
            "large-mesh",
            f"the mesh '{mesh.filename}' of {label(link.element)} is {shown(size)} m in size",
            element,
            attribute="filename",
            hint="if it is in millimetres, write `scale=0.001 0.001 0.001`",
        )
