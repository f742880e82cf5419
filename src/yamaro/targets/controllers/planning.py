"""Which controllers a robot has, and their parameters: those of its section, and the usual ones.

Beside what the section `controllers` says there are a broadcaster of joint states, a controller for
each group, or without groups for all joints, and a broadcaster for each sensor in the hardware.
"""

from __future__ import annotations

from ...diagnostics import WARNING, Diagnostic, YamaroError, did_you_mean
from ...model.controllers import DEFAULT_DISTRO, DEFAULT_RATE, OF_MANAGER, TYPES
from ..gains import EFFORT, POSITION, VELOCITY, Gains
from ..groups import joints_of
from ..losses import Losses
from .hardware import Hardware
from .rolling import ROLLING, add_sizes

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...model.controllers import Controller, ControllerType, Parameters
    from ...model.extras import Noted
    from ...model.robot import Robot
    from ...source import Span
    from ..output import Wanted

TRACKED = (POSITION, VELOCITY, "acceleration", EFFORT)
"""The commands that trajectories can be followed with."""
TRAJECTORY, FORWARD, GRIPPER = "joint_trajectory", "forward_command", "gripper"
JOINT_STATE = "joint_state"
SECTION_HINT = "add an entry to the section `controllers`, or a group"


class Planned:
    """A controller as it is written.

    Attributes:
        name: its name.
        plugin: the class of its plugin.
        word: the word for its type, "" if the type is not known.
        joints: the joints that it commands.
        parameters: its parameters; a value may have a `Remark`.
        of_manager: its parameters in the controller manager, besides its type.
        owner: what it is made of, or None.
    """

    __slots__ = ("joints", "name", "of_manager", "owner", "parameters", "plugin", "word")

    def __init__(
        self, name: str, plugin: str, known: ControllerType | None, owner: Noted | None = None
    ) -> None:
        """Begin without joints and parameters."""
        self.name = name
        self.plugin = plugin
        self.word = known.word if known is not None else ""
        self.joints: list[str] = []
        self.parameters: dict[str, object] = {}
        self.of_manager: Parameters = {}
        self.owner = owner


class Plan:
    """The controllers of a robot, worked out when it is made.

    Attributes:
        robot: the robot.
        hardware: the interfaces that there are.
        distro: the distribution of ROS 2.
        manager: the parameters of the controller manager.
        controllers: the controllers, in the order in which they are written.
        losses: what has no controller, or not all that one needs.
        warnings: what else there is to say.
    """

    __slots__ = (
        "_gains", "_taken", "_wanted", "controllers", "distro", "errors", "hardware", "losses",
        "manager", "robot", "warnings",
    )  # fmt: skip

    def __init__(self, robot: Robot, wanted: Wanted) -> None:
        """Work out the controllers.

        Raises:
            YamaroError: a controller of the section lacks what it needs.
        """
        self.robot = robot
        self.hardware = Hardware(robot)
        manager = robot.controller_manager
        self.distro = manager.distro if manager is not None else DEFAULT_DISTRO
        given: Parameters = {} if manager is None else manager.parameters
        self.manager: Parameters = {"update_rate": DEFAULT_RATE, **given}
        self.controllers: list[Planned] = []
        self.losses = Losses()
        self.warnings: list[Diagnostic] = []
        self.errors: list[Diagnostic] = []
        self._wanted = wanted
        self._gains: Gains | None = None
        self._taken: set[str] = set()
        if self.hardware.is_assumed:
            self._warn(
                "control-assumed",
                "no `control` says what drives the joints; all are taken to be driven as by their "
                "actuators",
                self.robot.span,
                "add a <ros2_control> element with the hardware and its joints"
                if self.robot.span.source.is_xml
                else "write control: {plugin: mock_components/GenericSystem}",
            )
        own = [self._given(controller) for controller in robot.controllers.values()]
        if not any(each.word == JOINT_STATE for each in own):
            self._add(TYPES[JOINT_STATE], "joint_state_broadcaster", None)
        self.controllers += own
        self._add_for_groups()
        self._add_for_the_rest()
        read = [each.parameters.get("sensor_name") for each in self.controllers]
        kinds = {each.sensor: each for each in TYPES.values() if each.sensor}
        for name, reading in self.hardware.sensors.items():
            if name in read or reading.type not in kinds:
                continue
            if not reading.frame:
                continue
            planned = self._add(kinds[reading.type], f"{name}_broadcaster", None)
            planned.parameters = {"sensor_name": name, "frame_id": reading.frame}
        if self.errors:
            raise YamaroError(self.errors)

    def _add(
        self, known: ControllerType, name: str, owner: Noted | None, joints: Sequence[str] = ()
    ) -> Planned:
        planned = Planned(name, known.plugin_in(self.distro), known, owner)
        planned.joints = [*joints]
        self._taken |= set(joints)
        self.controllers.append(planned)
        return planned

    # --- those of the section ---

    def _given(self, controller: Controller) -> Planned:
        known = controller.known
        plugin = controller.type
        if known is not None and "/" not in plugin:
            plugin = known.plugin_in(self.distro)
        planned = Planned(controller.name, plugin, known, controller)
        given: dict[str, object] = {**controller.parameters}
        planned.of_manager = {
            name: controller.parameters[name] for name in OF_MANAGER if name in given
        }
        for name in planned.of_manager:
            del given[name]
        for name in known.named if known is not None else ():
            if name.endswith("s") and isinstance(given.get(name), str):
                given[name] = [given[name]]
        planned.joints = [*controller.joints]
        if controller.group is not None:
            group = self.robot.groups.get(controller.group)
            members = joints_of(self.robot, group) if group is not None else []
            planned.joints = [name for name in members if name in self.hardware.commands]
        planned.parameters = given
        commanded = self._fill(planned, controller)
        planned.parameters = {**planned.parameters, **given}
        if known is None or not known.is_broadcaster:
            self._taken |= set(planned.joints)
        for joint, command in commanded:
            self._check_command(controller, joint, command)
        return planned

    def _fill(self, planned: Planned, controller: Controller) -> list[tuple[str, str]]:
        """Fill in what a controller needs and is not given; return what it commands."""
        given = planned.parameters
        if planned.word == TRAJECTORY:
            self._fill_trajectory(planned, given)
            joints = given.get("command_joints", given.get("joints", planned.joints))
            commands = planned.parameters.get("command_interfaces", [])
            if not planned.joints and "joints" not in given:
                self.refuse(controller, "no joints", "write joints: '*', or a group")
            return [(str(j), str(c)) for j in _list(joints) for c in _list(commands)]
        if planned.word == FORWARD:
            command = str(given.get("interface_name") or self._command_of(planned.joints))
            planned.parameters = {"joints": planned.joints, "interface_name": command}
            if not planned.joints:
                self.refuse(controller, "no joints", "write joints: '*', or a group")
            return [(joint, command) for joint in planned.joints]
        if planned.word == GRIPPER:
            if "joint" in given:
                planned.joints = [str(given["joint"])]
            if len(planned.joints) != 1:
                count = f"{len(planned.joints)} joints" if planned.joints else "no joint"
                hint = "it commands one joint, which others may follow: write joint: left_finger"
                self.refuse(controller, count, hint)
                return []
            planned.parameters = {"joint": planned.joints[0]}
            command = EFFORT if planned.plugin.startswith("effort") else POSITION
            return [(planned.joints[0], command)]
        if planned.word in ROLLING:
            return add_sizes(self, planned, controller, self._wanted.paths)
        known = controller.known
        if known is not None and known.sensor:
            self._fill_sensor(planned, controller, known.sensor)
        elif known is not None and known.joints:
            planned.parameters = {known.joints: planned.joints}
        elif known is None and planned.joints:
            planned.parameters = {"joints": planned.joints}
        return []

    def _fill_sensor(self, planned: Planned, controller: Controller, kind: str) -> None:
        """Fill in the sensor of a broadcaster, if there is one of its type, and its frame."""
        given = planned.parameters
        names = [name for name, each in self.hardware.sensors.items() if each.type == kind]
        name = given.get("sensor_name", names[0] if len(names) == 1 else None)
        if name is None and "interface_names" not in given:
            self.refuse(
                controller,
                "no sensor",
                f"write sensor_name: {names[0]}"
                if names
                else f"no `control` has a sensor of the type {kind}",
            )
        elif name is not None and name not in self.hardware.sensors and self.hardware.sensors:
            near = did_you_mean(str(name), self.hardware.sensors)
            self._warn(
                "controller-interface",
                f"'{controller.name}' reads the sensor '{name}', and no block of ros2_control "
                "has it",
                controller.span,
                near or f"the sensors are {', '.join(self.hardware.sensors)}",
                controller,
            )
        planned.parameters = {"sensor_name": name} if name is not None else {}
        reading = self.hardware.sensors.get(str(name))
        if reading is not None and reading.frame:
            planned.parameters["frame_id"] = reading.frame

    def refuse(self, controller: Controller, lack: str, hint: str) -> None:
        """Note that a controller lacks something."""
        self.errors.append(
            Diagnostic(
                "controller-value",
                f"the controller '{controller.name}' has {lack}",
                controller.span,
                hint=hint,
                trace=controller.trace,
            )
        )

    def warn(self, code: str, message: str, owner: Noted, hint: str) -> None:
        """Note a warning at a controller."""
        self._warn(code, message, owner.span, hint, owner)

    def _warn(
        self, code: str, message: str, span: Span, hint: str, owner: Noted | None = None
    ) -> None:
        trace = owner.trace if owner is not None else None
        self.warnings.append(
            Diagnostic(code, message, span, hint=hint, severity=WARNING, trace=trace)
        )

    def _check_command(self, controller: Controller, joint: str, command: str) -> None:
        commands = self.hardware.commands.get(joint, ())
        if command in commands or self.hardware.is_assumed:
            return
        takes = f"it takes {' and '.join(commands)}" if commands else "no block drives it"
        self._warn(
            "controller-interface",
            f"'{controller.name}' commands the {command} of '{joint}', and {takes}",
            controller.span,
            f"write actuator: {{command: [{', '.join((*commands, command))}]}} in the joint"
            if joint in self.robot.actuators or commands
            else "give the joint an actuator, or name it in `control`",
            controller,
        )

    # --- the usual ones ---

    def _command_of(self, joints: Sequence[str]) -> str:
        """Return the first command that all of some joints take; "" if there is none.

        Hardware has commands of its own, too: those that all controllers know come first.
        """
        commands = [self.hardware.commands.get(joint, (POSITION,)) for joint in joints]
        first = commands[0] if commands else ()
        common = [each for each in first if all(each in other for other in commands)]
        return next((each for each in common if each in TRACKED), (*common, "")[0])

    def _by_command(self, joints: Sequence[str]) -> dict[str, list[str]]:
        """Return joints by the command that they have in common, or else by that of each."""
        common = self._command_of(joints)
        if common:
            return {common: [*joints]}
        found: dict[str, list[str]] = {}
        for joint in joints:
            found.setdefault(self._command_of([joint]), []).append(joint)
        return found

    def _add_for_groups(self) -> None:
        """Add a controller for each group; of groups that overlap, the smallest have the joints."""
        driven = self.hardware.commands
        members = {
            name: [joint for joint in joints_of(self.robot, group) if joint in driven]
            for name, group in self.robot.groups.items()
        }
        left: dict[str, list[str]] = {}
        taken = set(self._taken)
        for name, joints in sorted(members.items(), key=lambda pair: len(pair[1])):
            left[name] = [joint for joint in joints if joint not in taken]
            taken |= set(joints)
        known = {each.name for each in self.controllers}
        for name, group in self.robot.groups.items():
            parts = self._by_command(left[name])
            for command, joints in parts.items():
                own = f"{name}_controller" if len(parts) == 1 else f"{name}_{command}_controller"
                if own in known:
                    continue
                is_gripper = group.is_end_effector and len(joints) == 1 and command == POSITION
                word = TRAJECTORY if command in TRACKED else FORWARD
                planned = self._add(TYPES[GRIPPER if is_gripper else word], own, group, joints)
                if is_gripper:
                    planned.parameters = {"joint": joints[0]}
                elif word == FORWARD:
                    planned.parameters = {"joints": joints, "interface_name": command}
                else:
                    self._fill_trajectory(planned, {"command_interfaces": [command]})

    def _add_for_the_rest(self) -> None:
        """Add controllers for joints that have none, if there are no groups; else report them."""
        rest = [joint for joint in self.hardware.commands if joint not in self._taken]
        if self.robot.groups:
            for joint in rest:
                what, owner = "joints without a controller", self.robot.joints[joint]
                self.losses.lose(what, owner, hint=SECTION_HINT)
            return
        known = {each.name for each in self.controllers}
        parts = self._by_command(rest) if rest else {}
        tracked = [each for each in parts if each in TRACKED and each != VELOCITY]
        for command, joints in parts.items():
            if command in tracked:
                name = "joint_trajectory_controller"
                name = name if len(tracked) == 1 else f"{command}_trajectory_controller"
            else:
                name = f"forward_{command}_controller"
            while name in known:
                name += "_2"
            if command in tracked:
                planned = self._add(TYPES[TRAJECTORY], name, None, joints)
                self._fill_trajectory(planned, {"command_interfaces": [command]})
            else:
                planned = self._add(TYPES[FORWARD], name, None, joints)
                planned.parameters = {"joints": joints, "interface_name": command}

    # --- trajectories ---

    def _fill_trajectory(self, planned: Planned, given: dict[str, object]) -> None:
        """Fill in joints, interfaces, and the gains that efforts and velocities need."""
        joints = [str(each) for each in _list(given.get("joints", planned.joints))]
        commands = [str(each) for each in _list(given.get("command_interfaces", []))]
        if not commands:
            common = self._command_of(joints)
            commands = [common] if common else []
            if joints and not common and planned.owner is not None:
                self._warn(
                    "controller-interface",
                    f"the joints of '{planned.name}' have no command in common",
                    planned.owner.span,
                    "write a controller for each command, with `joints`",
                    planned.owner,
                )
        planned.parameters = {
            "joints": joints,
            "command_interfaces": commands,
            "state_interfaces": [POSITION, VELOCITY],
        }
        if "gains" in given or "gains" in planned.parameters:
            return
        if commands == [EFFORT]:
            planned.parameters["gains"] = {joint: self._gains_of(joint) for joint in joints}
        elif commands == [VELOCITY]:
            planned.parameters["gains"] = {joint: {"ff_velocity_scale": 1.0} for joint in joints}
            for joint in joints:
                owner = self.robot.joints.get(joint)
                if owner is not None:
                    self.losses.approximate(
                        "trajectories of joints that are driven by velocity",
                        owner,
                        how="their velocity, without gains for the position",
                        hint=f"write gains: {{{joint}: {{p: 5.0, ff_velocity_scale: 1.0}}}} in the "
                        "controller",
                    )

    def _gains_of(self, name: str) -> dict[str, float]:
        """Return the gains of a joint that is driven by effort: its actuator's, or chosen ones."""
        actuator, joint = self.robot.actuators.get(name), self.robot.joints.get(name)
        if actuator is not None and actuator.kp is not None:
            return {"p": actuator.kp, "d": actuator.kd or 0.0}
        if joint is None:
            return {"p": 0.0}
        if self._gains is None:
            is_fixed = self._wanted.is_fixed
            self._gains = Gains(self.robot, is_fixed=is_fixed)
        stiffness = self._gains.of_position(joint)
        self.losses.approximate(
            "trajectories of joints that are driven by effort",
            joint,
            how="gains that are chosen by weight and inertia",
            hint="write kp and kd in the actuator",
        )
        return {"p": stiffness, "d": self._gains.damping(joint, stiffness)}


def _list(value: object) -> list[object]:
    return [*value] if isinstance(value, (list, tuple)) else [value]
