"""USD with physics (UsdPhysics), as Isaac Sim, Newton and Omniverse read it.

The bodies lie flat under the robot, each where it is while all joints are at 0. Angles are in
degrees, and most numbers of UsdPhysics have single precision, both as the format has it.

Source: the documentation of UsdPhysics, https://openusd.org/release/api/usd_physics_page_front.html.
"""

from __future__ import annotations

from ...diagnostics import failure

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.robot import Robot
    from ..output import Output, Wanted


def write(robot: Robot, wanted: Wanted) -> Output:
    """Return a robot in USD, as text.

    Raises:
        YamaroError: usd-core is not installed, or a mesh cannot be read.
    """
    try:
        from .model import written
    except ImportError:
        raise failure(
            "missing-extra",
            "USD needs the library usd-core",
            robot.span,
            hint="pip install 'yamaro[usd]'",
        ) from None
    return written(robot, wanted)
