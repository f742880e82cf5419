"""URDF, which a robot is in as it is: what is added for Gazebo, and what URDF cannot hold."""

from __future__ import annotations

from ...diagnostics import Reporter
from ..gains import POSITION
from ..holding import cones, lost_fields, lost_sections, lost_values
from ..losses import Losses
from ..output import Output
from .gazebo import with_gazebo

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.robot import Robot
    from ..output import Wanted

REFLECTED = ("gear", "armature", "rotor_inertia")
GAINS = ("kp", "kd", "frequency", "damping_ratio")
"""The values of an actuator that transmissions hold: gains if both are given for a position."""
GAZEBO_HINT = "--gazebo also writes it for Gazebo"


def write(robot: Robot, wanted: Wanted) -> Output:
    """Return a robot as URDF, with meshes named as they are in the source.

    Loops are written beside it. What the robot says to Gazebo in elements of its own is written
    already, and so is not to be read.
    """
    reporter, root, losses = Reporter(), robot.element, Losses()
    if any(raw.format == "sdf" and raw.joint is not None for raw in robot.raw()):
        from ..translation import Translation
        from .chains import in_tree

        root = in_tree(root, Translation(robot, "urdf").chains, robot)
    files: dict[str, bytes] = {}
    loops = None
    if robot.loops:
        from .loops import Loops, name_beside

        loops = Loops(robot)
        root = loops.in_tree(root)
        files = {name_beside(wanted.file_name, robot): loops.file()}
    if wanted.has_gazebo:
        losses = cones(robot)
        root = with_gazebo(root, robot, reporter)
    output = Output(root, losses, files, warnings=reporter.diagnostics)
    if not wanted.is_named:
        return output
    if not wanted.has_gazebo:
        for sensor in robot.sensors.values():
            losses.approximate("sensors", sensor, how="their frames", hint=GAZEBO_HINT)
        for surface in robot.surfaces:
            losses.lose("surfaces", surface, hint=GAZEBO_HINT)
    for joint in robot.joints.values():
        if joint.dynamics is not None and joint.dynamics.armature:
            what = lost_fields("urdf", "dynamics")["armature"].what
            losses.lose(what, joint, part=joint.dynamics, field="armature")
    driven = {joint for control in robot.controls for joint in control.joints}
    geared = {
        joint for control in robot.controls for joint in control.joints if control.has_transmissions
    }
    for actuator in robot.actuators.values():
        if actuator.joint not in driven:
            losses.lose("actuators", actuator, hint="add a section `control`")
            continue
        held: tuple[str, ...] = REFLECTED if actuator.joint in geared else ()
        has_gains = actuator.kp is not None and actuator.kd is not None
        if held and has_gains and actuator.command == POSITION:
            held += GAINS
        losses += lost_values(actuator, "urdf", but=held)
    losses += lost_sections(robot, states=True)
    for loop in loops.open if loops is not None else ():
        losses.approximate("loops", loop, how="a file beside the tree")
    if robot.base is not None and robot.base.type == "free":
        losses.lose("free bases", robot.base, label=f"robot '{robot.name}'")
    return output
