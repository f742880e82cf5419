"""What drives joints: drives of UsdPhysics, and actuators of Newton.

A drive has two gains and a greatest effort; PhysX bounds it by a torque-speed line as well. Newton
adds what a `NewtonActuator` computes, once a program steps it, to what the drive of the same joint
does. It alone has a torque-speed line, a delay, and gains for a joint that is commanded efforts. So
where both are needed, a variant set of the robot switches from the drives to such actuators. It is
called as SimReady calls the one that turns on what only Newton reads.
"""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING

from pxr import Sdf, Usd, UsdPhysics

from ...model.joint import PRISMATIC
from ..gains import EFFORT, POSITION, TIME_STEP, VELOCITY, Gains
from ..holding import lost_of_actuator, lost_values
from ..losses import Losses
from .prims import element_of, set_values

if TYPE_CHECKING:
    from ...model.extras import Actuator
    from ...model.joint import Joint
    from ...xml.tree import Element
    from .prims import Writing

VARIANTS, DRIVES, ACTUATORS = "Newton", "Disabled", "Enabled"
"""The variant set: with drives, and with actuators of Newton in their place. Source: RV.004 of
https://nvidia.github.io/simready-foundation/, whose default is `Disabled`."""
GAINS = {"kp": POSITION, "kd": VELOCITY}
"""The gains of an actuator of Newton, and the commands that they are for."""


class ControlWriter:
    """Makes what drives the joints of one robot.

    Attributes:
        elements: for each actuator that is a prim, an element at its place, by the joint's name.
        losses: what USD cannot hold.
    """

    def __init__(self, writing: Writing) -> None:
        self._stage, self._robot = writing.stage, writing.robot
        self._names, self._root = writing.names, writing.root
        is_fixed = writing.wanted.is_fixed
        self._chosen = Gains(writing.robot, is_fixed=is_fixed)
        self._folder = ""
        self._motors: dict[str, Usd.Prim] = {}
        self._apart: list[tuple[UsdPhysics.DriveAPI, Actuator, float, float, float | None]] = []
        self.elements: dict[str, Element] = {}
        self.losses = Losses()

    @property
    def has_variants(self) -> bool:
        """Whether an actuator needs the variant with actuators in place of drives."""
        return bool(self._apart)

    def lose(self, actuator: Actuator) -> None:
        """Note what USD does not hold of an actuator, whatever its joint is."""
        self.losses += lost_of_actuator(actuator, commands=_held(actuator), gains=GAINS)
        self.losses += lost_values(actuator, "usd")
        if actuator.delay:
            how = f"{_steps(actuator)} steps of {TIME_STEP * 1000:g} ms, for Newton"
            self.losses.approximate("delays of actuators", actuator, field="delay", how=how)
        if actuator.no_load_speed is not None and actuator.stall_torque is None:
            how = "a speed without effort beyond it, for PhysX"
            what = "no-load speeds of motors without a stall torque"
            self.losses.approximate(what, actuator, field="no_load_speed", how=how)

    def write(self, prim: UsdPhysics.RevoluteJoint, joint: Joint) -> None:
        """Write what drives a joint: gains of angular drives are per degree."""
        actuator = self._robot.actuators.get(joint.name)
        effort = joint.limit.effort if joint.limit is not None else None
        if actuator is not None and actuator.stall_torque is not None:
            stall = actuator.stall_torque
            effort = min(effort, stall) if effort is not None else stall
        if actuator is None and effort is None:
            return
        axis = "linear" if joint.type == PRISMATIC else "angular"
        drive = UsdPhysics.DriveAPI.Apply(prim.GetPrim(), axis)
        drive.CreateTypeAttr("force")
        if effort is not None:
            drive.CreateMaxForceAttr(effort)
        kp = kd = 0.0  # in SI; those that are not given are as in MJCF
        if actuator is not None and actuator.command == POSITION:
            kp = actuator.kp if actuator.kp is not None else self._chosen.of_position(joint)
            kd = actuator.kd if actuator.kd is not None else self._chosen.damping(joint, kp)
        elif actuator is not None and actuator.command == VELOCITY:
            kd = self._chosen.of_velocity(joint, actuator)
        if actuator is None:
            _set_gains(drive, kp, kd)
            return
        is_apart = _needs_actuator(actuator)
        if not is_apart or actuator.command == EFFORT:
            _set_gains(drive, kp, kd)
        if is_apart:
            self._apart.append((drive, actuator, kp, kd, effort))
        speed = actuator.no_load_speed
        unit = 1.0 if axis == "linear" else degrees(1)
        if speed is not None and actuator.command != EFFORT:
            slope = speed / actuator.stall_torque * unit if actuator.stall_torque else None
            values = {"maxActuatorVelocity": speed * unit, "speedEffortGradient": slope}
            name = "rivePerformanceEnvelope"
            set_values(prim.GetPrim(), f"PhysxD{name}API:{axis}", f"physxD{name}:{axis}", values)
        further = _held(actuator) & set(actuator.commands[1:])
        if POSITION in further:
            drive.CreateTargetPositionAttr(0.0)
        if VELOCITY in further:
            drive.CreateTargetVelocityAttr(0.0)
        if EFFORT in actuator.commands:
            self._motor(drive, actuator, effort)

    def finish(self) -> None:
        """Write the two variants, if the robot needs them."""
        if not self._apart:
            return
        root = self._stage.GetPrimAtPath(self._root)
        variants = root.GetVariantSets().AddVariantSet(VARIANTS)
        variants.AddVariant(DRIVES)
        variants.AddVariant(ACTUATORS)
        variants.SetVariantSelection(ACTUATORS)
        with variants.GetVariantEditContext():
            for drive, actuator, kp, kd, effort in self._apart:
                if actuator.command == EFFORT:
                    kp, kd = actuator.kp or 0.0, actuator.kd or 0.0
                else:
                    _set_gains(drive, 0.0, 0.0)
                    if actuator.command == VELOCITY and actuator.kd is not None:
                        kp = actuator.kp or 0.0
                known = self._motors.get(actuator.joint)
                motor = known or self._motor(drive, actuator, effort)
                gains = {"kp": kp, "kd": kd}
                set_values(motor, "NewtonPDControlAPI", "newton", gains)
                self._note(motor, actuator)
        variants.SetVariantSelection(DRIVES)
        with variants.GetVariantEditContext():
            for drive, actuator, kp, kd, _ in self._apart:
                if actuator.command != EFFORT:
                    _set_gains(drive, kp, kd)

    def _motor(
        self, drive: UsdPhysics.DriveAPI, actuator: Actuator, effort: float | None
    ) -> Usd.Prim:
        """Return an actuator of Newton without gains, which adds an effort to those of a joint."""
        if not self._folder:
            self._folder = self._names.new(self._root, "actuators")
        self._stage.DefinePrim(self._folder, "Scope")
        joint = drive.GetPrim()
        path = self._names.new(self._folder, joint.GetName())
        motor = self._motors[actuator.joint] = self._stage.DefinePrim(path, "NewtonActuator")
        motor.CreateRelationship("newton:targets", custom=False).SetTargets([joint.GetPath()])
        motor.AddAppliedSchema("NewtonPDControlAPI")
        stall, speed = actuator.stall_torque, actuator.no_load_speed
        if stall is not None and speed is not None:  # in radians
            line = {"saturationEffort": stall, "velocityLimit": speed, "maxMotorEffort": effort}
            set_values(motor, "NewtonDCMotorClampingAPI", "newton", line)
        elif effort is not None:
            set_values(motor, "NewtonMaxEffortClampingAPI", "newton", {"maxEffort": effort})
        if actuator.delay:
            motor.AddAppliedSchema("NewtonActuatorDelayAPI")
            steps = motor.CreateAttribute("newton:delaySteps", Sdf.ValueTypeNames.Int, custom=False)
            steps.Set(_steps(actuator))
        self._note(motor, actuator)
        return motor

    def _note(self, motor: Usd.Prim, actuator: Actuator) -> None:
        """Keep an element of an actuator, which has no name beside that of its joint."""
        fields = {name: name for name in ("kp", "kd")}
        fields |= {"saturationEffort": "stall_torque", "velocityLimit": "no_load_speed"}
        fields["delaySteps"] = "delay"
        places = {name: actuator.span_of(field) for name, field in fields.items()}
        self.elements[actuator.joint] = element_of(motor, actuator, places=places, is_named=False)


def _held(actuator: Actuator) -> set[str]:
    """Return the commands that a joint takes.

    A drive has a target for each of its gains, and any joint takes an effort besides.
    """
    held = {actuator.command, EFFORT, *(GAINS[name] for name in GAINS if getattr(actuator, name))}
    return held | {VELOCITY} if actuator.command == POSITION else held


def _needs_actuator(actuator: Actuator) -> bool:
    """Return whether a drive cannot hold all of an actuator, for Newton."""
    if actuator.command == EFFORT:
        return bool(actuator.kp or actuator.kd)
    has_line = actuator.stall_torque is not None and actuator.no_load_speed is not None
    has_two = actuator.command == VELOCITY and None not in (actuator.kp, actuator.kd)
    return bool(has_line or actuator.delay or has_two)


def _steps(actuator: Actuator) -> int:
    """Return a delay in steps."""
    return max(1, round((actuator.delay or 0.0) / TIME_STEP))


def _set_gains(drive: UsdPhysics.DriveAPI, kp: float, kd: float) -> None:
    """Give a drive gains, which are in SI units; those of an angular one are per degree."""
    unit = degrees(1) if drive.GetPrim().IsA(UsdPhysics.RevoluteJoint) else 1.0
    drive.CreateStiffnessAttr(kp / unit)
    drive.CreateDampingAttr(kd / unit)
