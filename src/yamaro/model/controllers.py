"""Controllers of ros2_control: which there are, the parameters that they take, those of a robot.

Sources: the files `*_parameters.yaml` of ros2_controllers and of controller_manager, from which
generate_parameter_library makes the code that reads the parameters, and their plugin files, in the
branches humble, jazzy, kilted and master of August 2026. The names are those of all of them.
"""

from __future__ import annotations

from ..xml.values import format_value
from .extras import Noted
from .schema import CONTROLLERS
from .values import attribute_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..xml.tree import Element

    Parameter = bool | int | float | str | list["Parameter"] | dict[str, "Parameter"]
    Parameters = dict[str, Parameter]

HUMBLE = "humble"
DISTROS = CONTROLLERS.fields["distro"].choices
"""The distributions of ROS 2 that controllers are written for."""
DEFAULT_DISTRO = str(CONTROLLERS.fields["distro"].default)
DEFAULT_RATE = 100
"""The rate of the controller manager in Hz that it has itself by default."""

INTEGER = frozenset(
    (
        *("update_rate", "thread_priority", "cpu_affinity", "velocity_rolling_window_size"),
        *("wheels_per_side", "power_supply_technology", "radiation_type"),
    )
)
"""The parameters that are whole numbers; all other numbers of these controllers are doubles."""
LENGTHS = frozenset(
    (
        *("wheel_separation", "wheel_radius", "wheels_radius", "wheelbase", "robot_radius"),
        *("traction_track_width", "steering_track_width", "traction_wheel_radius"),
        *("traction_wheels_radius", "sum_of_robot_center_projection_on_X_Y_axis"),
    )
)
"""Parameters that are lengths."""
TIMES = frozenset(("cmd_vel_timeout", "reference_timeout", "goal_time", "cmd_timeout"))
"""Parameters that are times in seconds."""
BY_JOINT = frozenset(("gains", "constraints"))
"""Parameters whose keys are names of joints, among others."""


class ControllerType:
    """A type of controller that is known.

    Attributes:
        word: what `type` calls it in short.
        plugin: the name of its class.
        older: that in Humble, if it is another one.
        joints: the parameter that lists its joints, or "" if it has none.
        named: the parameters that name joints besides, such as the left wheels.
        is_broadcaster: whether it only publishes, and commands nothing.
        sensor: the type of sensor that it publishes, or "".
        parameters: the names of its parameters, as far as the first dot.
        integers: those of them that are whole numbers besides `INTEGER`.
    """

    __slots__ = (
        "integers", "is_broadcaster", "joints", "named", "older", "parameters", "plugin", "sensor",
        "word",
    )  # fmt: skip

    def __init__(
        self,
        word: str,
        plugin: str,
        parameters: str,
        *,
        older: str = "",
        joints: str = "",
        named: str = "",
        sensor: str = "",
        is_broadcaster: bool = False,
        integers: str = "",
    ) -> None:
        """Describe a type; see the class."""
        self.word = word
        self.plugin = plugin
        self.older = older
        self.joints = joints
        self.named = tuple(named.split())
        self.sensor = sensor
        self.is_broadcaster = is_broadcaster or bool(sensor)
        self.parameters = (*parameters.split(), *((joints,) if joints else ()), *self.named)
        self.integers = INTEGER | set(integers.split())

    def plugin_in(self, distro: str) -> str:
        """Return the name of its class in a distribution."""
        return self.older if self.older and distro == HUMBLE else self.plugin


_FRAMES = "tf_frame_prefix_enable tf_frame_prefix odom_frame_id base_frame_id enable_odom_tf "
_COVARIANCES = "pose_covariance_diagonal twist_covariance_diagonal "
_STEERING = (
    f"{_FRAMES}{_COVARIANCES}reference_timeout open_loop velocity_rolling_window_size "
    "reduce_wheel_speed_until_steering_reached position_feedback front_steering use_stamped_vel "
    "wheelbase "
)
_STEERED = (
    "traction_joints_names steering_joints_names traction_joints_state_names "
    "steering_joints_state_names rear_wheels_names front_wheels_names rear_wheels_state_names "
    "front_wheels_state_names"
)
_CORNERS = [f"{end}_{side}" for end in ("front", "rear") for side in ("left", "right")]
_GROUP = "interface_name"

TYPES = {
    each.word: each
    for each in (
        ControllerType(
            "joint_state",
            "joint_state_broadcaster/JointStateBroadcaster",
            "use_local_topics interfaces map_interface_to_joint_state frame_id "
            "publish_dynamic_joint_states use_urdf_to_filter",
            named="joints extra_joints",
            is_broadcaster=True,
        ),
        ControllerType(
            "joint_trajectory",
            "joint_trajectory_controller/JointTrajectoryController",
            "command_interfaces state_interfaces allow_partial_joints_goal open_loop_control "
            "allow_integration_in_goal_trajectories state_publish_rate action_monitor_rate "
            "set_last_command_interface_value_as_state_on_activation interpolation_method "
            "allow_nonzero_velocity_at_trajectory_end cmd_timeout gains constraints speed_scaling "
            "interpolate_from_desired_state allow_trajectory_replacement positions_upsampling",
            joints="joints",
            named="command_joints",
        ),
        ControllerType(
            "forward_command",
            "forward_command_controller/ForwardCommandController",
            _GROUP,
            joints="joints",
        ),
        ControllerType(
            "multi_interface_forward_command",
            "forward_command_controller/MultiInterfaceForwardCommandController",
            "interface_names",
            named="joint",
        ),
        ControllerType(
            "gripper",
            "parallel_gripper_action_controller/GripperActionController",
            "action_monitor_rate goal_tolerance allow_stalling stall_velocity_threshold "
            "stall_timeout max_effort max_velocity max_effort_interface max_velocity_interface "
            "state_interfaces",
            older="position_controllers/GripperActionController",
            named="joint",
        ),
        ControllerType(
            "diff_drive",
            "diff_drive_controller/DiffDriveController",
            f"{_FRAMES}{_COVARIANCES}wheel_separation wheel_radius wheels_per_side open_loop "
            "wheel_separation_multiplier left_wheel_radius_multiplier position_feedback "
            "right_wheel_radius_multiplier cmd_vel_timeout publish_limited_velocity publish_rate "
            "velocity_rolling_window_size use_stamped_vel linear angular",
            named="left_wheel_names right_wheel_names",
        ),
        ControllerType(
            "mecanum_drive",
            "mecanum_drive_controller/MecanumDriveController",
            f"{_FRAMES}{_COVARIANCES}reference_timeout kinematics use_stamped_vel linear angular",
            named=" ".join(
                f"{corner}_wheel_{kind}_joint_name"
                for corner in _CORNERS
                for kind in ("command", "state")
            ),
        ),
        ControllerType(
            "omni_wheel_drive",
            "omni_wheel_drive_controller/OmniWheelDriveController",
            f"{_FRAMES}wheel_offset robot_radius wheel_radius diagonal_covariance open_loop "
            "position_feedback cmd_vel_timeout",
            named="wheel_names",
        ),
        ControllerType(
            "ackermann_steering",
            "ackermann_steering_controller/AckermannSteeringController",
            f"{_STEERING}front_wheel_track rear_wheel_track front_wheels_radius rear_wheels_radius "
            "steering_track_width traction_track_width traction_wheels_radius",
            named=_STEERED,
        ),
        ControllerType(
            "bicycle_steering",
            "bicycle_steering_controller/BicycleSteeringController",
            f"{_STEERING}front_wheel_radius rear_wheel_radius traction_wheel_radius",
            named=_STEERED,
        ),
        ControllerType(
            "tricycle_steering",
            "tricycle_steering_controller/TricycleSteeringController",
            f"{_STEERING}wheel_track front_wheels_radius rear_wheels_radius traction_track_width "
            "traction_wheels_radius",
            named=_STEERED,
        ),
        ControllerType(
            "tricycle",
            "tricycle_controller/TricycleController",
            f"{_FRAMES}{_COVARIANCES}wheelbase wheel_radius open_loop odom_only_twist "
            "cmd_vel_timeout publish_ackermann_command velocity_rolling_window_size traction "
            "steering use_stamped_vel",
            named="traction_joint_name steering_joint_name",
            integers="cmd_vel_timeout",
        ),
        ControllerType(
            "pid",
            "pid_controller/PidController",
            "command_interface reference_and_state_interfaces use_external_measured_states gains "
            "set_current_state_as_first_setpoint enable_feedforward",
            joints="dof_names",
            named="reference_and_state_dof_names",
        ),
        ControllerType(
            "admittance",
            "admittance_controller/AdmittanceController",
            "command_interfaces state_interfaces chainable_command_interfaces kinematics ft_sensor "
            "control fixed_world_frame gravity_compensation admittance robot_description "
            "enable_parameter_update_without_reactivation",
            joints="joints",
            named="command_joints",
        ),
        ControllerType(
            "gpio",
            "gpio_controllers/GpioCommandController",
            "gpios command_interfaces state_interfaces",
        ),
        ControllerType(
            "pose",
            "pose_broadcaster/PoseBroadcaster",
            "frame_id pose_name tf",
            is_broadcaster=True,
        ),
        ControllerType(
            "imu_sensor",
            "imu_sensor_broadcaster/IMUSensorBroadcaster",
            "sensor_name frame_id static_covariance_orientation static_covariance_angular_velocity "
            "static_covariance_linear_acceleration rotation_offset",
            sensor="imu",
        ),
        ControllerType(
            "force_torque_sensor",
            "force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster",
            "sensor_name frame_id interface_names offset multiplier sensor_filter_chain",
            sensor="force_torque",
        ),
        ControllerType(
            "gps_sensor",
            "gps_sensor_broadcaster/GPSSensorBroadcaster",
            "sensor_name frame_id static_position_covariance read_covariance_from_interface",
            is_broadcaster=True,
        ),
        ControllerType(
            "range_sensor",
            "range_sensor_broadcaster/RangeSensorBroadcaster",
            "sensor_name frame_id radiation_type field_of_view min_range max_range variance",
            is_broadcaster=True,
        ),
        ControllerType(
            "magnetometer",
            "magnetometer_broadcaster/MagnetometerBroadcaster",
            "sensor_name frame_id static_covariance",
            is_broadcaster=True,
        ),
    )
}
"""The types of controllers by their words."""

_PLUGINS = {
    **{plugin: each for each in TYPES.values() for plugin in (each.plugin, each.older) if plugin},
    "effort_controllers/GripperActionController": TYPES["gripper"],
}
_ENDINGS = ("_controller", "_broadcaster")

MANAGER = (
    *("update_rate", "enforce_command_limits", "handle_exceptions", "thread_priority"),
    *("cpu_affinity", "lock_memory", "use_sim_time", "hardware_components_initial_state"),
    *("defaults", "diagnostics", "shutdown_on_initial_state_failure", "overruns"),
)
"""The names of the parameters of the controller manager."""
OF_MANAGER = ("fallback_controllers", "params_file", "node_options_args", "is_async")
"""What is said of a controller to the manager beside its type."""
OF_ALL = ("use_sim_time", "update_rate", "is_async", "thread_priority", "lock_memory")
"""Parameters that each controller has, since it is a node."""


SOLVERS = {
    "kdl": "kdl_kinematics_plugin/KDLKinematicsPlugin",
    "lma": "lma_kinematics_plugin/LMAKinematicsPlugin",
    "trac_ik": "trac_ik_kinematics_plugin/TRAC_IKKinematicsPlugin",
    "pick_ik": "pick_ik/PickIkPlugin",
    "bio_ik": "bio_ik/BioIKKinematicsPlugin",
    "none": "none",
}
"""The solvers of inverse kinematics for MoveIt by their words: the classes of their plugins."""
SOLVER = "kinematics_solver"
SOLVER_KEYS = {
    "solver": SOLVER,
    "timeout": "kinematics_solver_timeout",
    "search_resolution": "kinematics_solver_search_resolution",
}
"""What MoveIt calls the parameters of a solver that have short names."""


def known_type(word: str) -> ControllerType | None:
    """Return the type that is meant by a word or by the name of a class, if it is known."""
    if "/" in word:
        return _PLUGINS.get(word)
    for ending in _ENDINGS:
        word = word.removesuffix(ending)
    return TYPES.get(word)


class Controller(Noted):
    """A controller that the section `controllers` names.

    Attributes:
        name: its name.
        type: the word or the class of its type, as it is written.
        joints: the names of the joints that it is given.
        group: the name of the group whose joints it takes, or None.
        parameters: the parameters that are given, by name: truth values, numbers, texts, lists and
            mappings of these.
    """

    __slots__ = ("group", "joints", "name", "parameters", "type")

    def __init__(self, element: Element) -> None:
        super().__init__(element)
        self.name = self._text("name")
        self.type = self._text("type")
        self.joints = self._named("joint", "joint")
        self.group: str | None = next(iter(self._named("robot-group", "name")), None)
        self.parameters = parameters_in(element)

    _internal = frozenset(("known",))

    @property
    def known(self) -> ControllerType | None:
        """Return what is known of its type, if anything is."""
        return known_type(self.type)


class ControllerManager(Noted):
    """What the section `controllers` says of the controller manager.

    Attributes:
        distro: the distribution of ROS 2 that the controllers are written for.
        parameters: the parameters of the manager that are given.
    """

    __slots__ = ("distro", "parameters")

    def __init__(self, element: Element) -> None:
        super().__init__(element)
        self.distro = attribute_text(element, "distro") or DEFAULT_DISTRO
        self.parameters = parameters_in(element)


# --- parameters in notes -------------------------------------------------------------------------
# A parameter is an element PARAMETER: its `refname` is its name, its `reference` its text, or
# `sensor` that of a sensor, so that the names of links, joints and sensors in them change with
# these. Its `kind` is bool, int, float, text, list or map.


PARAMETER = "parameter"


def parameters_in(element: Element) -> Parameters:
    """Return the parameters that an element of a note holds, by name."""
    return {
        format_value(each.attributes.get("refname")): _value_of(each)
        for each in element.elements()
        if each.name == PARAMETER
    }


def _value_of(element: Element) -> Parameter:
    """Return the value of an element; one that a jail gave may be wrong, and is a text then."""
    kind = attribute_text(element, "kind")
    if kind == "list":
        return [_value_of(each) for each in element.elements()]
    if kind == "map":
        return parameters_in(element)
    text = attribute_text(element, "reference") or attribute_text(element, "sensor") or ""
    try:
        if kind == "bool":
            return text == "true"
        if kind in ("int", "float"):
            return int(text) if kind == "int" else float(text)
    except ValueError:
        return text
    return text
