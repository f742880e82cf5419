"""Advice on a robot that is legal, but holds what is seldom meant: wrong units, outliers, traps.

Each of these is right in some good robot, so they are shown only to those who ask.
"""

from __future__ import annotations

from math import dist, fabs, pi, remainder, sqrt

from ..model.joint import CONTINUOUS, FIXED, FLOATING, LIMITED, PLANAR, REVOLUTE, SINGLE
from ..model.kinematics import base_of
from ..model.link import Inertial
from ..model.quantities import unit_of
from ..model.schema import ELEMENTS, OF_1_2, TEXT
from ..model.shapes import Mesh
from ..model.values import attribute_text, child_named
from ..xml.tree import Element, Text
from .context import CheckContext, counted, degrees_hint, is_attribute, label, shown
from .files import advise_on_addresses
from .robot import is_fixed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping

    from ..diagnostics import Reporter
    from ..model.extras import Actuator, Fitted
    from ..model.joint import Joint, Limit, Mimic
    from ..model.link import Collision, Link, Visual
    from ..model.pose import Pose, Vector
    from ..model.robot import Robot
    from ..source import Span
    from .robot import Tree

    Joints = Mapping[str, Joint]

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
FAR_FROM_MESH = 0.1
"""The greatest distance of a shape from its mesh, as a part of the mesh's size."""
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
    told = CheckContext(
        robot.element,
        advice,
        version=context.version,
        numbers=context.numbers,
        is_advice=True,
    )
    links, joints = tree.links, tree.joints
    children = {joint.child for joint in joints.values()}
    sizes: dict[Mesh, float | None] = {}
    heavy = [name for name, link in links.items() if name not in children and link.inertial]
    is_sound = all(joint.child in links for joint in joints.values())
    if heavy and not (is_sound and base_of(robot)[0] == FIXED):
        heavy = []
    _advise_on_names([*links.values(), *joints.values()], told)
    _advise_on_endings([*links.values(), *joints.values()], told)
    for name, link in links.items():
        told.outermost = link.element
        if heavy and name == heavy[0] and link.inertial is not None:
            told.report(
                "root-inertia",
                f"the root, {label(link.element)}, has an inertia, which KDL does not support",
                link.inertial.element,
                hint="robot_state_publisher warns of it; a root link without inertial, joined to "
                "this one by a fixed joint, avoids that",
            )
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
        _advise_on_motor(joint, robot.actuators.get(joint.name), told)
    for fitted in robot.fits:
        told.outermost = links[fitted.link].element if fitted.link in links else None
        _advise_on_fit(fitted, told)
    told.outermost = None
    _advise_on_zero_limits(joints.values(), told)
    _advise_on_axes(joints.values(), told)
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


def _advise_on_fit(fitted: Fitted, context: CheckContext) -> None:
    """Report a shape that is far from the mesh that it was worked out from."""
    if not fitted.distance > FAR_FROM_MESH * fitted.size:
        return
    others = [
        word
        for word in ("fit: best", "decompose: 8", "spheres: 24")
        if word.split(":")[0] != fitted.word or fitted.word == "fit" != fitted.kind
    ]
    context.report(
        "poor-fit",
        f"the {fitted.section} of link '{fitted.link}' is far from '{fitted.mesh}': "
        f"{fitted.quality()}",
        fitted.element,
        hint=f"try {', '.join(others[:-1])} or {others[-1]}, and look at it: yamaro picture "
        "--show visual,collision",
    )


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
        context.report(
            "slash-in-name",
            f"the {element.name} name '{name}' has a '/' in it",
            element,
            attribute="name",
            hint="tools that use it for topics or files fail; use '_', and "
            "a frame_prefix for robot_state_publisher",
            notes=[f"{more} more name{'s have' if more > 1 else ' has'} one"] if more else (),
        )


def _advise_on_endings(named: list[Link | Joint], context: CheckContext) -> None:
    """Report, once, names such as `arm_link_link`: the part has been called `arm_link`."""
    found = [each for each in named if each.name.endswith(("_link_link", "_joint_joint"))]
    for group in context.apart("doubled-ending", found, lambda each: (each.element, "name")):
        name, element = group[0].name, group[0].element
        whole = name.rpartition("_")[0]
        more = len(group) - 1
        context.report(
            "doubled-ending",
            f"the name of {element.name} '{name}' ends in '_{element.name}' twice",
            element,
            attribute="name",
            hint=f"name the part '{whole.rpartition('_')[0]}', to which the ending is added, or "
            f"write the whole name: `{element.name}/name={whole}:`",
            notes=[f"{more} more name{'s end' if more > 1 else ' ends'} so"] if more else (),
        )


# --- mass -------------------------------------------------------------------------------------


def _advise_on_mass(link: Link, context: CheckContext) -> None:
    inertial = link.inertial
    element = inertial.inner("mass") if inertial is not None else None
    mass = link.mass
    if inertial is None or element is None or mass <= 0:
        return
    if mass > HEAVIEST:
        context.report(
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
        context.report(
            "odd-density",
            f"{label(link.element)} has the density {shown(density)} kg/m³: {shown(mass)} kg in "
            f"{shown(volume)} m³",
            element,
            attribute="value",
            hint="check the units, kilograms and metres; water has 1000, steel 7850 kg/m³",
        )
    element = inertial.inner("inertia")
    if element is None:
        return
    ixx, _, _, iyy, _, izz = inertial.inertia
    gyration = sqrt(fabs(max(ixx, iyy, izz)) / inertial.mass)
    if gyration > WIDEST_GYRATION:
        context.report(
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
            context.report(
                "angle-too-large",
                f"'{attribute}' of joint '{joint.name}' is {shown(bound)} radians, "
                f"{shown(fabs(bound) / (2 * pi))} turns",
                limit.element,
                attribute=attribute,
                hint=degrees_hint(bound, limit.element.value_span(attribute)),
            )
    if context.version == "1.2":
        return
    for attribute in OF_1_2:
        if limit.written(attribute) is not None:
            context.report(
                "needs-version",
                f"'{attribute}' of joint '{joint.name}' is ignored before URDF 1.2",
                limit.element,
                attribute=attribute,
                hint="write `version=1.2` on the robot, if all "
                "programs that read it support URDF 1.2",
            )


def _advise_on_motor(joint: Joint, actuator: Actuator | None, context: CheckContext) -> None:
    """Report a joint whose effort limit its motor never reaches."""
    stall = actuator.stall_torque if actuator is not None else None
    limit = joint.limit
    if stall is None or limit is None or limit.effort is None or limit.effort <= stall:
        return
    unit = unit_of("effort", joint.type)
    context.report(
        "effort-above-stall",
        f"the effort limit of joint '{joint.name}' is {shown(limit.effort)} {unit}, and its motor "
        f"stalls at {shown(stall)} {unit}",
        limit.element,
        attribute="effort",
        hint="write the smaller of the two, or leave 'effort' out, which takes the stall torque",
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
        context.report(
            "zero-limit",
            f"the {' and '.join(attributes)} {what} of joint '{joint.name}' "
            f"{'is' if len(attributes) == 1 else 'are'} 0, so it cannot be moved",
            limit.element,
            attribute=attributes[0],
            hint="planners and simulators use it literally; write the limit of the motor",
            notes=counted([each.name for each, *_ in group[1:]], "joint", "has such a limit"),
        )
        context.outermost = None


def _advise_on_axes(joints: Iterable[Joint], context: CheckContext) -> None:
    """Report, once, joints that move about or along x because they have no axis."""
    found = [
        each for each in joints if each.type in SINGLE and child_named(each.element, "axis") is None
    ]
    for group in context.apart("missing-axis", found, lambda each: (each.element, None)):
        joint = group[0]
        context.outermost = joint.element
        context.report(
            "missing-axis",
            f"the {joint.type} joint '{joint.name}' has no axis, which means x: 1 0 0",
            joint.element,
            hint="write `axis/xyz=1 0 0:` to say so, or the axis that is meant"
            if joint.element.span.source.is_xml
            else "write axis: x to say so, or the axis that is meant",
            notes=counted([each.name for each in group[1:]], "joint", "has none"),
        )
        context.outermost = None


def _advise_on_pose(pose: Pose, owner: Element, context: CheckContext) -> None:
    origin = pose.element
    rpy = context.numbers.row(origin, "rpy", 3)
    if origin is None or not rpy:
        return
    roll, pitch, yaw = rpy
    if all(fabs(remainder(angle, pi / 2)) < QUARTER_TOLERANCE for angle in rpy):
        return  # as CAD and careful people write a turned part
    if fabs(fabs(pitch) - pi / 2) < GIMBAL_TOLERANCE and roll and yaw:
        context.report(
            "gimbal-rpy",
            f"'rpy' in {label(owner)} has a pitch of a quarter turn, at "
            "which roll and yaw rotate about the same axis",
            origin,
            attribute="rpy",
            hint="combine both in the roll: tools may write it back with other numbers",
        )


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
        is_key = not is_attribute(element.value_span("filename"))
        wanted = "scale: 1mm" if is_key else "scale=0.001 0.001 0.001"
        context.report(
            "large-mesh",
            f"the mesh '{mesh.filename}' of {label(link.element)} is {shown(size)} m in size",
            element,
            attribute="filename",
            hint=f"if it is in millimetres, write `{wanted}`",
        )


# --- the centre of mass -----------------------------------------------------------------------


LEAST_GAP = 0.3
"""Metres between the centre of mass and the shapes that are never reported."""


def advise_on_center(link: Link, context: CheckContext) -> None:
    """Report a centre of mass that lies far outside of the link's shapes.

    All readers take it, and simulators swing the link about a point in the air.
    """
    inertial = link.inertial
    if inertial is None or inertial.inner("mass") is None:
        return
    balls = _balls(link)
    if not balls:
        return
    center = inertial.pose.position
    gap = min(dist(center, middle) - radius for middle, radius in balls)
    largest = max(radius for _, radius in balls)
    if gap <= max(4 * largest, LEAST_GAP):
        return
    origin = inertial.pose.element
    context.report(
        "far-center",
        f"the centre of mass of {label(link.element)} is {shown(gap)} m away from its shapes",
        inertial.element if origin is None else origin,
        attribute=None if origin is None else "xyz",
        hint="check the units (metres) and the frame, which is that of the link",
    )


def _balls(link: Link) -> list[tuple[Vector, float]]:
    """Return the middles and radii of spheres around the collisions, or else the visuals.

    There are none if a mesh is among them.
    """
    for sections in (link.collisions, link.visuals):
        shapes = [(section.pose.position, section.shape) for section in sections]
        balls = [
            (middle, shape.radius_around())
            for middle, shape in shapes
            if shape is not None and not isinstance(shape, Mesh) and shape.radius_around() > 0
        ]
        if balls and len(balls) == len(sections):
            return balls
    return []


# --- how joints move, and what they move ------------------------------------------------------


ROUNDING = 1e-6
"""How far beside 0 a bound may be that is meant to be 0, in m and rad."""


SHARED = {
    "ignored-limit": (
        "has such a limit",
        "make it revolute if it has limits; a continuous joint rotates without limits",
    ),
    "zero-outside-limits": (
        "has such a range",
        (
            "most programs start with all joints at 0; write a state `home` with a position "
            "for it, or include 0 in the range with another origin"
        ),
    ),
    "soft-limit-outside": (
        "has such soft limits",
        "soft limits must be between 'lower' and 'upper'",
    ),
}
"""Faults of several joints that are reported once: what is said of the others, and the hint."""


def advise_on_motion(robot: Robot, tree: Tree, context: CheckContext) -> None:
    """Report limits that say something else than they seem to, and links without mass that move."""
    found: dict[str, list[_Found]] = {code: [] for code in SHARED}
    home = robot.states.get("home")
    for joint in tree.joints.values():
        context.outermost = joint.element
        limit, name = joint.limit, joint.name
        if limit is not None and joint.type == CONTINUOUS:  # it has no bounds: all ignore them
            bound = next((each for each in ("lower", "upper") if limit.number(each)), None)
            if bound is not None:
                message = f"joint '{name}' is continuous, so '{bound}' is ignored"
                found["ignored-limit"].append(_Found(joint, limit.element, bound, message))
        bounds = _advise_on_joint(joint, tree.joints, context)
        if bounds is None:
            continue
        lower, upper = bounds
        # Viewers, planners and simulators start with all joints at 0.
        start = home.positions.get(name) if home is not None else None
        is_placed = start is not None and lower - ROUNDING <= start <= upper + ROUNDING
        has_zero = lower - ROUNDING <= 0 <= upper + ROUNDING
        if joint.mimic is None and limit is not None and not is_placed and not has_zero:
            message = f"joint '{name}' goes from {shown(lower)} to {shown(upper)}, which excludes 0"
            bound = "lower" if lower > 0 else "upper"
            found["zero-outside-limits"].append(_Found(joint, limit.element, bound, message))
        safety = joint.safety_controller
        for bound in ("soft_lower_limit", "soft_upper_limit"):
            soft = safety.number(bound) if safety is not None else None
            if (
                safety is not None and soft and not lower <= soft <= upper
            ):  # then the safety controller never acts
                message = (
                    f"'{bound}' of joint '{name}' is {shown(soft)}, outside of its limits "
                    f"{shown(lower)} to {shown(upper)}"
                )
                found["soft-limit-outside"].append(_Found(joint, safety.element, bound, message))
    context.outermost = None
    for code, (others_have, hint) in SHARED.items():
        for group in context.apart(code, found[code], lambda each: (each.element, each.attribute)):
            first = group[0]
            names = dict.fromkeys(each.joint.name for each in group)
            context.outermost = first.joint.element
            context.report(
                code,
                first.message,
                first.element,
                attribute=first.attribute,
                hint=hint,
                notes=counted(list(names)[1:], "joint", others_have),
            )
            context.outermost = None
    _advise_on_massless(tree.links, tree.joints, context)


class _Found:
    """What one joint has of a fault that several may have."""

    __slots__ = ("attribute", "element", "joint", "message")

    def __init__(self, joint: Joint, element: Element, attribute: str, message: str) -> None:
        self.joint = joint
        self.element = element
        self.attribute = attribute
        self.message = message


def _advise_on_joint(
    joint: Joint, joints: Joints, context: CheckContext
) -> tuple[float, float] | None:
    """Report what is wrong with one joint; return its bounds if it has a range."""
    _advise_on_follower(joint, joints, context)
    limit = joint.limit
    if limit is None:
        return None
    if joint.type not in LIMITED:
        return None
    lower, upper = _bound(limit, "lower"), _bound(limit, "upper")
    if lower is None or upper is None or lower > upper:
        return None  # reported elsewhere
    written = limit.element.attributes
    if "lower" not in written and "upper" not in written:
        return None
    if lower == upper:
        context.report(
            "no-range",
            f"'lower' and 'upper' of joint '{joint.name}' are both {shown(lower)}, so it cannot "
            "move",
            limit.element,
            attribute="upper" if "upper" in written else "lower",
            hint="set a range, or make it fixed",
        )
        return None
    return lower, upper


def _advise_on_follower(joint: Joint, joints: Joints, context: CheckContext) -> None:
    """Report a joint that mimics one that moves, but cannot follow it.

    A hand that is fixed as a whole is fine.
    """
    mimic = joint.mimic
    master = joints.get(mimic.joint) if mimic is not None else None
    if mimic is None or master is None or is_fixed(master):
        return
    if is_fixed(joint):
        context.report(
            "fixed-mimic",
            f"joint '{joint.name}' mimics '{master.name}', but is fixed",
            mimic.element,
            attribute="joint",
            hint="use a type that moves, or remove the mimic",
        )
    elif mimic.number("multiplier") == 0:
        context.report(
            "fixed-mimic",
            f"joint '{joint.name}' mimics '{master.name}' with the multiplier 0, so it never moves",
            mimic.element,
            attribute="multiplier",
            hint="write the ratio of the two motions, or remove the mimic",
        )
    else:
        _advise_on_reach(joint, mimic, master, context)
    for each, other in ((joint, "it"), (master, f"'{master.name}'")):
        if each.type in (FLOATING, PLANAR):
            context.report(
                "mimic-type",
                f"joint '{joint.name}' cannot mimic '{master.name}': {other} is {each.type}",
                mimic.element,
                attribute="joint",
                hint="only joints that move along or about one axis follow each other",
            )


def _advise_on_reach(joint: Joint, mimic: Mimic, master: Joint, context: CheckContext) -> None:
    """Report a joint whose range leaves out all positions that it would follow to."""
    ranges = []
    for each in (joint, master):
        limit = each.limit if each.type in LIMITED else None
        lower, upper = (None if limit is None else _bound(limit, n) for n in ("lower", "upper"))
        if lower is None or upper is None or lower >= upper:
            return
        ranges.append((lower, upper))
    (lower, upper), ends = ranges
    factor = mimic.number("multiplier") if mimic.written("multiplier") is not None else 1.0
    offset = mimic.number("offset") if mimic.written("offset") is not None else 0.0
    if factor is None or offset is None:
        return
    least, most = sorted(factor * end + offset for end in ends)
    if min(upper, most) - max(lower, least) <= ROUNDING:
        context.report(
            "fixed-mimic",
            f"joint '{joint.name}' would follow '{master.name}' from {shown(least)} to "
            f"{shown(most)}, but its range is {shown(lower)} to {shown(upper)}, so it never moves",
            mimic.element,
            attribute="joint",
            hint="check the signs of multiplier, offset and limits",
        )


def _bound(limit: Limit, attribute: str) -> float | None:
    """Return a bound, which is 0 where it is left out; None if it is faulty."""
    return 0.0 if limit.written(attribute) is None else limit.number(attribute)


# --- links that move and weigh nothing --------------------------------------------------------


def _advise_on_massless(links: Mapping[str, Link], joints: Joints, context: CheckContext) -> None:
    """Report, once, links that a joint moves and that have no mass, with what is fixed to them.

    MuJoCo refuses such a robot, and Gazebo drops the link with all below it.
    """
    fixed_to = {joint.child: joint.parent for joint in joints.values() if is_fixed(joint)}
    heavy: set[str] = set()  # they, or what is rigidly fixed below them, have an inertial
    for name, link in links.items():
        above: str | None = name if link.inertial is not None else None
        while above is not None and above not in heavy:
            heavy.add(above)
            above = fixed_to.get(above)
    moved = [
        joint
        for joint in joints.values()
        if not is_fixed(joint) and joint.child in links and joint.child not in heavy
    ]
    code = "massless-moving"
    for group in context.apart(code, moved, lambda each: (links[each.child].element, "name")):
        joint = group[0]
        more = len(group) - 1
        context.report(
            code,
            f"link '{joint.child}' is moved by joint '{joint.name}', but has no mass",
            links[joint.child].element,
            attribute="name",
            hint="add a mass and a shape, or an inertial: without it, MuJoCo "
            "rejects the robot and Gazebo ignores the link",
            notes=[f"{more} more moving link{'s have' if more > 1 else ' has'} none"]
            if more
            else (),
        )


# --- expressions that nothing has evaluated ---------------------------------------------------


SUBSTITUTIONS = ("$(arg ", "$(find ", "$(env ", "$(optenv ", "$(eval ", "$(dirname", "$(anon ")


def advise_on_leftovers(root: Element, context: CheckContext) -> None:
    """Report, once, expressions of xacro that nothing has evaluated.

    Parsers take them for names and texts. In YAML they are reported where they are read.
    """
    found = list(_leftovers(root))
    for group in context.apart("leftover-expression", found, lambda each: each[:2]):
        element, attribute, text = group[0]
        more = len(group) - 1
        context.report(
            "leftover-expression",
            f"'{text.strip()}' was not evaluated",
            element,
            attribute=attribute,
            hint="only xacro evaluates it: rename the file to .xacro, or write its value",
            notes=[f"{more} more {'are' if more > 1 else 'is'} in the file"] if more else (),
        )


def _leftovers(root: Element) -> Iterator[tuple[Element, str | None, str]]:
    for element in root.iter():
        if not element.span.source.is_xml:
            continue
        for name in element.attributes:
            text = attribute_text(element, name)
            if text is not None and _is_leftover(text) and not _is_number(element.name, name):
                yield element, name, text
        for child in element.children:
            if isinstance(child, Text) and _is_leftover(str(child.value)):
                yield element, None, str(child.value)


def _is_leftover(text: str) -> bool:
    if "$" not in text:
        return False
    return ("${" in text and "}" in text) or any(word in text for word in SUBSTITUTIONS)


def _is_number(element: str, attribute: str) -> bool:
    """Return whether URDF reads numbers there, so that the check reports it anyway."""
    rule = ELEMENTS[element].attributes.get(attribute) if element in ELEMENTS else None
    return rule is not None and rule.count != TEXT
