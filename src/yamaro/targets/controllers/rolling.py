"""Controllers of robots on wheels: which wheel is where, and the sizes that they are not given."""

from __future__ import annotations

from ..gains import POSITION, VELOCITY
from ..parameters import Remark
from .wheels import Wheel, base_of, is_backward, radius_of, reach_of, separation_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from ...model.controllers import Controller
    from ..mesh_paths import MeshPaths
    from .planning import Plan, Planned

    Known = dict[str, object]

COMPUTED = "computed from the robot"
UNEQUAL = 1e-3
"""How far the radii of wheels may differ, as a part of them."""


class _Sizes:
    """Measures the wheels of one controller.

    Attributes:
        plan: the controllers of the robot.
        planned: the controller.
        made: the parameters that are worked out.
        paths: where meshes are.
    """

    __slots__ = ("_controller", "made", "paths", "plan", "planned")

    def __init__(
        self, plan: Plan, planned: Planned, controller: Controller, paths: MeshPaths
    ) -> None:
        self.plan = plan
        self._controller = controller
        self.paths = paths
        self.planned = planned
        self.made: Known = {}

    def wheels(self, joints: Sequence[str]) -> list[Wheel]:
        """Return the wheels of some joints; report those that turn backward."""
        robot = self.plan.robot
        found = [Wheel(robot, robot.joints[name], self.paths) for name in joints]
        for wheel in found:
            if is_backward(wheel):
                self.plan.warn(
                    "wheel-axis",
                    f"the wheel '{wheel.joint.name}' of '{self.planned.name}' turns backward: its "
                    "axis points to the right",
                    self._controller,
                    "let the axis point to the left: axis: y, turned back by `rpy` where needed",
                )
        return found

    def names(self, parameter: str) -> list[str]:
        """Return the joints that a parameter names."""
        value = self.planned.parameters.get(parameter, [])
        names = value if isinstance(value, list) else [value]
        return [str(name) for name in names if str(name) in self.plan.robot.joints]

    def has(self, path: str) -> bool:
        """Return whether a parameter is given; `.` is between the names of nested ones."""
        given: object = self.planned.parameters
        if isinstance(given, dict) and path in given:
            return True
        for name in path.split("."):
            if not isinstance(given, dict) or name not in given:
                return False
            given = given[name]
        return True

    def size(self, path: str, value: Callable[[], float | None], what: str) -> None:
        """Compute a size that is not given; report one that is not known."""
        if self.has(path):
            return
        found = value()
        if not found:
            hint = f"write {path.replace('.', ': {')}: 0.1{'}' * path.count('.')}"
            self.plan.refuse(self._controller, f"no `{path}`, and {what}", hint)
            return
        parts = path.split(".")
        into = self.made
        for part in parts[:-1]:
            inner = into.setdefault(part, {})
            assert isinstance(inner, dict)
            into = inner
        into[parts[-1]] = Remark(round(found, 12), COMPUTED)

    def radius(self, path: str, wheels: Sequence[Wheel]) -> None:
        """Compute the radius of wheels, which the controller takes to be equal."""
        self.size(path, lambda: radius_of(wheels), "no shape of all its wheels is round")
        known = [wheel.radius for wheel in wheels if wheel.radius is not None]
        if known and max(known) - min(known) > UNEQUAL * max(known) and not self.has(path):
            self.plan.losses.approximate(
                "wheels of different sizes",
                wheels[0].joint,
                how="their mean radius",
                hint="write the radius, or its multipliers, in the controller",
            )

    def base_frame(self) -> None:
        """Write which link the odometry is about: the root."""
        roots = self.plan.robot.roots
        if roots and not self.has("base_frame_id"):
            self.made["base_frame_id"] = roots[0].name

    def lack(self, what: str, hint: str) -> None:
        """Report that it is not said where wheels are."""
        self.plan.refuse(self._controller, what, hint)


def add_sizes(
    plan: Plan, planned: Planned, controller: Controller, paths: MeshPaths
) -> list[tuple[str, str]]:
    """Fill in what a controller of wheels needs; return the commands that it gives."""
    sizes = _Sizes(plan, planned, controller, paths)
    commanded = ROLLING[planned.word](sizes)
    planned.joints = [joint for joint, _ in commanded]
    sizes.base_frame()
    kept = planned.parameters
    for name, value in sizes.made.items():
        inner = kept.get(name)
        if isinstance(inner, dict) and isinstance(value, dict):
            kept[name] = {**value, **inner}
    planned.parameters = {**sizes.made, **kept}
    return commanded


def _two_wheels(sizes: _Sizes) -> list[tuple[str, str]]:
    """Fill in a diff_drive controller; wheels in `joints` are left where y is positive."""
    left, right = (sizes.names(f"{side}_wheel_names") for side in ("left", "right"))
    rest = [name for name in sizes.planned.joints if name not in (*left, *right)]
    for wheel in sizes.wheels(rest) if not (left and right) else ():
        (left if wheel.center[1] > 0 else right).append(wheel.joint.name)
    if not left or not right:
        hint = (
            "write left_wheel_names: [left_wheel] and right_wheel_names: [right_wheel], or joints"
        )
        sizes.lack("no wheels on both sides", hint)
        return []
    sizes.made |= {"left_wheel_names": left, "right_wheel_names": right}
    mine, others = sizes.wheels(left), sizes.wheels(right)
    sizes.size(
        "wheel_separation", lambda: separation_of(mine, others), "its wheels are in one plane"
    )
    sizes.radius("wheel_radius", [*mine, *others])
    return [(name, VELOCITY) for name in (*left, *right)]


def _mecanum(sizes: _Sizes) -> list[tuple[str, str]]:
    """Fill in a mecanum_drive controller; wheels in `joints` are where they are."""
    pattern = "{}_wheel_command_joint_name"
    corners = [f"{end}_{side}" for end in ("front", "rear") for side in ("left", "right")]
    found = {corner: sizes.names(pattern.format(corner)) for corner in corners}
    wheels = sizes.wheels(sizes.planned.joints)
    if not any(found.values()) and wheels:
        middle = sum(wheel.center[0] for wheel in wheels) / len(wheels)
        for wheel in wheels:
            end = "front" if wheel.center[0] > middle else "rear"
            side = "left" if wheel.center[1] > 0 else "right"
            found[f"{end}_{side}"].append(wheel.joint.name)
    if any(len(names) != 1 for names in found.values()):
        hint = "write joints: '*_wheel', with a wheel at each corner, or the four parameters"
        sizes.lack("no four wheels at corners", hint)
        return []
    sizes.made |= {pattern.format(corner): names[0] for corner, names in found.items()}
    at = {corner: sizes.wheels(names)[0] for corner, names in found.items()}
    sizes.radius("kinematics.wheels_radius", [*at.values()])
    left, right = ([at[f"{end}_{side}"] for end in ("front", "rear")] for side in ("left", "right"))
    front, rear = (
        [at[f"{end}_{side}"].center for side in ("left", "right")] for end in ("front", "rear")
    )
    sizes.size(
        "kinematics.sum_of_robot_center_projection_on_X_Y_axis",
        lambda: (base_of(front, rear) + separation_of(left, right)) / 2,
        "its wheels are at one point",
    )
    return [(names[0], VELOCITY) for names in found.values()]


def _omni(sizes: _Sizes) -> list[tuple[str, str]]:
    """Fill in an omni_wheel_drive controller."""
    names = sizes.names("wheel_names")
    wheels = [Wheel(sizes.plan.robot, sizes.plan.robot.joints[n], sizes.paths) for n in names]
    if not wheels:
        sizes.lack("no wheels", "write wheel_names: [first, second, third], anticlockwise")
        return []
    sizes.size("robot_radius", lambda: reach_of(wheels), "its wheels are in the middle")
    sizes.radius("wheel_radius", wheels)
    return [(name, VELOCITY) for name in names]


def _steered(sizes: _Sizes) -> list[tuple[str, str]]:
    """Fill in a controller whose wheels turn to the sides: wheelbase, tracks and radius."""
    word = sizes.planned.word
    one = word == "tricycle"
    traction = sizes.names("traction_joint_name" if one else "traction_joints_names")
    steering = sizes.names("steering_joint_name" if one else "steering_joints_names")
    if not traction or not steering:
        if sizes.has("rear_wheels_names") and sizes.has("front_wheels_names"):
            return []  # as in Humble
        ending = "joint_name: drive" if one else "joints_names: [left, right]"
        sizes.lack("no joints", f"write traction_{ending} and steering_…")
        return []
    driven = sizes.wheels(traction)
    robot = sizes.plan.robot
    poses = robot.poses()
    turned = [poses[robot.joints[name].child].position for name in steering]
    sizes.size(
        "wheelbase",
        lambda: base_of([wheel.center for wheel in driven], turned),
        "its axles are at one place",
    )
    radius = {"tricycle": "wheel_radius", "bicycle_steering": "traction_wheel_radius"}
    sizes.radius(radius.get(word, "traction_wheels_radius"), driven)
    if word in ("ackermann_steering", "tricycle_steering") and len(driven) == 2:
        track = abs(driven[0].center[1] - driven[1].center[1])
        sizes.size("traction_track_width", lambda: track, "its wheels are in one plane")
    if word == "ackermann_steering" and len(turned) == 2:
        width = abs(turned[0][1] - turned[1][1])
        sizes.size("steering_track_width", lambda: width, "its joints are in one plane")
    return [(name, VELOCITY) for name in traction] + [(name, POSITION) for name in steering]


ROLLING: dict[str, Callable[[_Sizes], list[tuple[str, str]]]] = {
    "diff_drive": _two_wheels,
    "mecanum_drive": _mecanum,
    "omni_wheel_drive": _omni,
    "ackermann_steering": _steered,
    "bicycle_steering": _steered,
    "tricycle_steering": _steered,
    "tricycle": _steered,
}
"""What fills in the controllers of wheels, by their words."""
