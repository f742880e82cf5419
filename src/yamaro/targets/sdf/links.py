"""Links of SDFormat: poses, mass and sensors."""

from __future__ import annotations

from ...model.schema import MOMENTS
from ..inertia import ROUNDING, written_moments
from ..output import APPROXIMATED, LOST, Loss
from ..sdf_sensors import details_of, times_of, type_of
from ..tags import Tag, given, row_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.extras import Sensor
    from ...model.link import Inertial, Link
    from ...model.pose import Pose
    from ..inertia import Principal

POINT_RADIUS = 1e-6
"""The radius, in metres, of the ball whose inertia a point mass gets."""
PLACEHOLDER = 1e-3
"""The mass, in kg, of a link that cannot have mass 0: see `inertial_of_nothing`."""


def pose_tag(pose: Pose | None, relative_to: str | None = None) -> list[Tag]:
    """Return a `<pose>`; none if it would change nothing."""
    numbers = numbers_of(pose) if pose is not None else ()
    is_zero = not any(numbers)
    if is_zero and relative_to is None:
        return []
    return [Tag("pose", () if is_zero else row_of(numbers), relative_to=relative_to)]


def numbers_of(pose: Pose) -> tuple[float, ...]:
    """Return x, y, z, roll, pitch, yaw, the angles as they are written if they are."""
    origin = pose.element
    if origin is not None and "quat_xyzw" not in origin.attributes:
        text = str(origin.attributes.get("rpy", "0 0 0"))
        try:
            roll, pitch, yaw = map(float, text.split())
        except ValueError:
            return (*pose.position, *pose.rpy)
        return (*pose.position, roll, pitch, yaw)
    return (*pose.position, *pose.rpy)


def inertial_tag(
    link: Link, inertial: Inertial, principal: Principal | None, losses: list[Loss]
) -> Tag:
    """Return the `<inertial>` of a link with mass.

    Args:
        link: the link.
        inertial: its mass and inertia as they are written.
        principal: the same along the principal axes, as a body can have it.
        losses: takes what is approximated.
    """
    inertia, pose = inertial.inertia, inertial.pose
    if principal is not None and (principal.is_changed or _is_tight(inertia, principal)):
        first, second, third = written_moments(principal.moments)
        inertia, pose = (first, 0.0, 0.0, second, 0.0, third), principal.pose
    if not any(inertia):
        moment = 2 / 5 * inertial.mass * POINT_RADIUS**2
        inertia = (moment, 0.0, 0.0, moment, 0.0, moment)
        losses.append(
            Loss(
                APPROXIMATED,
                "point masses",
                f"link '{link.name}'",
                inertial.span,
                trace=link.trace,
                how="balls with a radius of 1 µm",
            )
        )
    return Tag(
        "inertial",
        [*pose_tag(pose), Tag("mass", inertial.mass), _inertia_tag(inertia)],
        span=inertial.span,
        trace=link.trace,
    )


def _is_tight(inertia: tuple[float, ...], principal: Principal) -> bool:
    """Return whether rounding decides if a body can have an inertia with products.

    libsdformat refuses some that are just possible, such as those of flat bodies, because of how it
    works out the principal moments. It has nothing to work out where these are written.
    """
    _, xy, xz, _, yz, _ = inertia
    moments = principal.moments
    room = sum(moments) - 2 * max(moments)
    return any((xy, xz, yz)) and room < ROUNDING * max(moments)


def _inertia_tag(inertia: tuple[float, ...]) -> Tag:
    return Tag("inertia", given(*zip(MOMENTS, inertia, strict=True)))


def inertial_of_nothing(link: Link, losses: list[Loss]) -> Tag:
    """Return an `<inertial>` for a link without mass: without any, SDFormat takes it for 1 kg."""
    losses.append(
        Loss(
            APPROXIMATED,
            "links without mass",
            f"link '{link.name}'",
            link.span,
            trace=link.trace,
            how="links of 1 g",
            hint="give the link a mass",
        )
    )
    moment = 2 / 5 * PLACEHOLDER * 0.01**2
    return Tag(
        "inertial", [Tag("mass", PLACEHOLDER), _inertia_tag((moment, 0, 0, moment, 0, moment))]
    )


def sensor_tag(sensor: Sensor, *, frame: str | None, collisions: list[str], version: str) -> Tag:
    """Return a sensor of a link or joint.

    Args:
        sensor: the sensor.
        frame: the frame that it measures in, if it is not that of its link or joint.
        collisions: the names of its link's collisions.
        version: of SDFormat; 1.12 can name the frame of what is measured.
    """
    named = sensor.frame if version == "1.12" else None
    return Tag(
        "sensor",
        [
            *pose_tag(sensor.pose, frame),
            *times_of(sensor),
            *given(("frame_id", named)),
            *details_of(sensor, collisions, has_optical=version != "1.9"),
        ],
        span=sensor.span,
        trace=sensor.trace,
        name=sensor.name,
        type=type_of(sensor),
    )


def lost_collisions(sensor: Sensor, link: Link) -> Loss:
    """Return the loss of a contact sensor in a link that touches nothing."""
    return Loss(
        LOST,
        "contact sensors in links without collisions",
        f"sensor '{sensor.name}'",
        sensor.span,
        trace=sensor.trace,
        hint=f"give the link '{link.name}' a collision",
    )
