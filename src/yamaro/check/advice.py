"""Advice on a robot that is legal, but holds what is seldom meant: wrong units, outliers, traps.

Each of these is right in some good robot, so they are shown only to those who ask.
"""

from __future__ import annotations

from math import fabs, pi, remainder, sqrt

from ..model.shapes import Box, Capsule, Cylinder, Sphere
from ..model.values import attribute_text, child_named
from ..xml.tree import Element
from .center import advise_on_center
from .context import CheckContext, label, shown
from .leftovers import advise_on_leftovers
from .motion import advise_on_motion

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from ..diagnostics import Reporter
    from ..model.shapes import Solid
    from ..source import Span
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


def check_advice(
    root: Element,
    tree: Tree,
    context: CheckContext,
    *,
    advice: Reporter,
    resolve_mesh: Callable[[str, Span], str | None] | None,
) -> None:
    """Report to `advice` what is legal but seldom meant."""
    told = CheckContext(root, advice, version=context.version)
    children = {
        attribute_text(child_named(joint, "child"), "link") for joint in tree.joints.values()
    }
    sizes: dict[tuple[str, str], float | None] = {}
    _advise_on_names(tree, told)
    for name, link in tree.links.items():
        told.outermost = link
        if name not in children:
            _advise_on_root(link, told)
        _advise_on_mass(link, told)
        advise_on_center(link, told)
        for section in _sections(link):
            _advise_on_pose(section, link, told)
            if resolve_mesh is not None:
                _advise_on_mesh(section, link, told, resolve_mesh, sizes)
    for joint in tree.joints.values():
        told.outermost = joint
        _advise_on_pose(joint, joint, told)
        _advise_on_limit(joint, told)
    told.outermost = None
    advise_on_motion(tree, told)
    advise_on_leftovers(root, told)
    told.flush()


def _sections(link: Element) -> Iterator[Element]:
    for child in link.children:
        if isinstance(child, Element) and child.name in ("visual", "collision", "inertial"):
            yield child


def _advise_on_names(tree: Tree, context: CheckContext) -> None:
    """Report, once, that names have slashes: where one has, most have."""
    elements = [*tree.links.items(), *tree.joints.items()]
    found = [(name, element) for name, element in elements if "/" in name]
    if not found:
        return
    name, element = found[0]
    more = len(found) - 1
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


def _advise_on_root(link: Element, context: CheckContext) -> None:
    inertial = child_named(link, "inertial")
    if inertial is None:
        return
    context.warn(
        "root-inertia",
        f"the root, {label(link)}, has an inertia, which KDL does not support",
        inertial,
        hint="robot_state_publisher warns of it; a root link without inertial, joined to this one "
        "by a fixed joint, avoids that",
    )


def _advise_on_mass(link: Element, context: CheckContext) -> None:
    inertial = child_named(link, "inertial")
    if inertial is None:
        return
    element = child_named(inertial, "mass")
    mass = context.number(element, "value")
    if element is None or mass is None or mass <= 0:
        return
    if mass > HEAVIEST:
        context.warn(
            "odd-mass",
            f"{label(link)} weighs {shown(mass)} kg",
            element,
            attribute="value",
            hint="masses are in kilograms; was this in grams?",
        )
        return
    volume = _volume(link, context)
    density = mass / volume if volume else None
    if density is not None and not LIGHTEST <= density <= DENSEST:
        context.warn(
            "odd-density",
            f"{label(link)} has the density {shown(density)} kg/m³: {shown(mass)} kg in "
            f"{shown(volume)} m³",
            element,
            attribute="value",
            hint="check the units, kilograms and metres; water has 1000, steel 7850 kg/m³",
        )
    _advise_on_inertia(inertial, mass, link, context)


def _advise_on_inertia(
    inertial: Element, mass: float, link: Element, context: CheckContext
) -> None:
    inertia = child_named(inertial, "inertia")
    moments = [context.number(inertia, name) for name in ("ixx", "iyy", "izz")]
    numbers = [moment for moment in moments if moment is not None]
    if inertia is None or len(numbers) < 3:
        return
    gyration = sqrt(fabs(max(numbers)) / mass)
    if gyration > WIDEST_GYRATION:
        context.warn(
            "odd-inertia",
            f"the inertia of {label(link)} is that of {shown(mass)} kg at a "
            f"distance of {shown(gyration)} m from its centre",
            inertia,
            hint="check the units, kg·m²; in a part, omit `inertia` to compute it",
        )


def _volume(link: Element, context: CheckContext) -> float:
    """Return the volume of the link's collisions, or visuals, in m³; 0 if a mesh is among them."""
    for name in ("collision", "visual"):
        sections = [section for section in _sections(link) if section.name == name]
        volumes = [_shape_volume(child_named(s, "geometry"), context) for s in sections]
        if volumes and all(volumes):
            return sum(volumes)
    return 0.0


def _shape_volume(geometry: Element | None, context: CheckContext) -> float:
    shapes = geometry.elements() if geometry is not None else []
    if len(shapes) != 1:
        return 0.0
    shape = shapes[0]
    solid = _solid_of(shape, context)
    return solid.volume() if solid is not None else 0.0


def _solid_of(shape: Element, context: CheckContext) -> Solid | None:
    """Return the solid that an element of a geometry describes; None for a mesh or a faulty one."""
    if shape.name == "box":
        size = context.numbers(shape, "size", 3)
        return Box(*size) if len(size) == 3 else None
    radius = context.number(shape, "radius") or 0.0
    length = context.number(shape, "length") or 0.0
    solids: dict[str, Solid] = {
        "sphere": Sphere(radius),
        "cylinder": Cylinder(radius, length),
        "capsule": Capsule(radius, length),
    }
    return solids.get(shape.name)


# --- joints and poses -------------------------------------------------------------------------


def _advise_on_limit(joint: Element, context: CheckContext) -> None:
    limit = child_named(joint, "limit")
    kind = attribute_text(joint, "type")
    if limit is None or kind in ("fixed", "floating"):
        return
    name = attribute_text(joint, "name")
    for attribute in ("effort", "velocity"):
        if context.number(limit, attribute) == 0:
            context.warn(
                "zero-limit",
                f"the {attribute} limit of joint '{name}' is 0, so it cannot be moved",
                limit,
                attribute=attribute,
                hint="planners and simulators use it literally; write the limit of the motor",
            )
    for attribute in ("lower", "upper"):
        bound = context.number(limit, attribute)
        if kind == "revolute" and bound is not None and MOST_TURNS < fabs(bound) <= 720:
            context.warn(
                "angle-too-large",
                f"'{attribute}' of joint '{name}' is {shown(bound)} radians, "
                f"{shown(fabs(bound) / (2 * pi))} turns",
                limit,
                attribute=attribute,
                hint=f"angles are in radians; for degrees write `$(radians({shown(bound)}))`",
            )
    if context.version == "1.2":
        return
    for attribute in ("acceleration", "deceleration", "jerk"):
        if attribute_text(limit, attribute) is not None:
            context.warn(
                "needs-version",
                f"'{attribute}' of joint '{name}' is ignored before URDF 1.2",
                limit,
                attribute=attribute,
                hint="write `version=1.2` on the robot, if all "
                "programs that read it support URDF 1.2",
            )


def _advise_on_pose(element: Element, owner: Element, context: CheckContext) -> None:
    origin = child_named(element, "origin")
    rpy = context.numbers(origin, "rpy", 3)
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
    """Tell whether an angle is 0 or a number of quarter turns."""
    return fabs(remainder(angle, pi / 2)) < QUARTER_TOLERANCE


# --- meshes -----------------------------------------------------------------------------------


def _advise_on_mesh(
    section: Element,
    link: Element,
    context: CheckContext,
    resolve_mesh: Callable[[str, Span], str | None],
    sizes: dict[tuple[str, str], float | None],
) -> None:
    geometry = child_named(section, "geometry")
    mesh = child_named(geometry, "mesh") if geometry is not None else None
    filename = attribute_text(mesh, "filename")
    if mesh is None or not filename:
        return
    key = (filename, attribute_text(mesh, "scale") or "")
    if key in sizes:
        return
    from ..meshes.triangles import stl_extent

    scale = context.numbers(mesh, "scale", 3) or (1.0, 1.0, 1.0)
    path = resolve_mesh(filename, mesh.value_span("filename"))
    sizes[key] = size = None if path is None else stl_extent(path, scale)
    if size is not None and size > LARGEST_MESH:
        context.warn(
            "large-mesh",
            f"the mesh '{filename}' of {label(link)} is {shown(size)} m in size",
            mesh,
            attribute="filename",
            hint="if it is in millimetres, write `scale=0.001 0.001 0.001`",
        )
