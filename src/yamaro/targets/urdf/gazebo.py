"""The `<gazebo>` elements of a robot's sensors and surfaces, as Gazebo (gz-sim) reads them in URDF.

Source: SDFormat 1.9 and its conversion of URDF, which moves what refers to a frame into its link.
"""

from __future__ import annotations

from ...diagnostics import Reporter
from ...model.joint import FIXED
from ...xml.tree import Element
from ..elements import element, given
from ..sdf.links import pose_of
from ..sdf.sensors import details_of, surface_of, times_of, type_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.extras import Surface
    from ...model.robot import Robot
    from ..elements import Attributes

CONTROL = "ros2_control"


def with_gazebo(root: Element, robot: Robot, reporter: Reporter) -> Element:
    """Return a robot with the elements of its sensors and surfaces, before `<ros2_control>`."""
    made = []
    for sensor in robot.sensors.values():
        attributes: Attributes = {"name": sensor.name, "type": type_of(sensor)}
        details = details_of(sensor, [f"{sensor.link}_collision"])
        named = given(("gz_frame_id", sensor.frame))
        inner = [*pose_of(sensor.pose), *times_of(sensor), *named, *details]
        content = [element("sensor", attributes, children=inner)]
        joint = robot.joints.get(sensor.joint or "")
        if joint is not None and joint.type == FIXED:
            content.insert(0, element("preserveFixedJoint", text="true"))
        # A contact sensor is of the link's shapes, wherever its frame is.
        place = sensor.link if sensor.type == "contact" else sensor.frame
        reference = sensor.joint or place or ""
        made.append(element("gazebo", {"reference": reference}, children=content, owner=sensor))
    made += _surfaces(robot, reporter)
    if not made:
        return root
    children = root.children
    end = len(children)
    while end:
        last = children[end - 1]
        if not isinstance(last, Element) or last.name != CONTROL:
            break
        end -= 1
    return root.with_children([*children[:end], *made, *children[end:]])


def _surfaces(robot: Robot, reporter: Reporter) -> list[Element]:
    """Return `<gazebo>` with the surface of each link: URDF has one for all of its collisions."""
    first: dict[str, Surface] = {}
    for surface in robot.surfaces:
        known = first.setdefault(surface.link, surface)
        if known.values() != surface.values():
            reporter.report(
                "several-surfaces",
                f"the collisions of the link '{surface.link}' have several surfaces, and Gazebo "
                "reads one for a link",
                surface.span,
                hint="give them the same surface, or move the collision to a link of its own",
                notes=(f"the one that is written is at {known.span.place()}",),
                trace=surface.trace,
            )
    made = []
    for link, surface in first.items():
        if surface.restitution is None:
            friction = given(("mu1", surface.friction), ("mu2", surface.friction2))
            content = [*friction, *given(("kp", surface.stiffness), ("kd", surface.damping))]
        else:  # it has no short form, and the short forms go astray beside the long one
            content = [element("collision", children=[surface_of(surface)])]
        made.append(element("gazebo", {"reference": link}, children=content, owner=surface))
    return made
