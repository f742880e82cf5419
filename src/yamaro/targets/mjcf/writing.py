"""What the writer of MJCF carries along: the robot, the sections, the names and the losses."""

from __future__ import annotations

from ...diagnostics import Diagnostic
from ...model.pose import UNTURNED, quaternion_from_rotation
from ...xml.tree import Element
from ...xml.values import format_number
from ..inertia import Inertias
from ..output import Loss
from .names import BODY, JOINT, SITE, WORLD, Names
from .plan import Plan

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from ...diagnostics import Frame as Step
    from ...model.link import Collision, Link
    from ...model.pose import Pose, Vector
    from ...model.robot import Robot
    from ...model.values import Written
    from ...source import Span
    from ...xml.tree import ValueSpans
    from ..output import Wanted
    from .solids import Solid

MAIN = "main"
"""The name of the class that every model has."""
NOISE = 1e-16
"""What is smaller in a position or a quaternion comes from rounding."""
SECTIONS = ("asset", "worldbody", "contact", "equality", "actuator", "sensor", "keyframe")
"""The sections whose content is gathered, in the order of the document."""


class Classes:
    """The names of a model's default classes.

    Attributes:
        model: what holds for all of the model.
        visual, collision, frame: what holds for its visuals, collisions and frames.
    """

    __slots__ = ("collision", "frame", "model", "visual")

    def __init__(self, model: str) -> None:
        self.model = model if model != MAIN else f"{MAIN}_robot"
        self.visual = f"{model}_visual"
        self.collision = f"{model}_collision"
        self.frame = f"{model}_frame"


class Writing:
    """One run of the writer.

    Attributes:
        robot: the robot.
        wanted: what is asked for.
        model: the name of the model.
        classes: the default classes: of the model, of its visuals, collisions and frames.
        names: the names that are taken.
        plan: which links are bodies and which are sites.
        inertias: the masses of the links.
        bodies: the body of each link that is one, by the name of the link.
        sections: the sections of the document, by name.
        losses: what MJCF cannot hold.
        files: what belongs beside the document.
        errors: why there is no document.
        motions: of each joint in MJCF, by name, the joint that it is and which part of it; for the
            free joint of a root, that link and `base`.
        controls: the joint, the command and the gear of each actuator.
        collisions: what collides: the link, the collision, and of a mesh the outer corners.
        solids: the same at home, once it is worked out.
    """

    __slots__ = (
        "_body_names", "bodies", "classes", "collisions", "controls", "errors", "files", "inertias",
        "losses", "model", "motions", "names", "plan", "robot", "sections", "solids", "wanted",
    )  # fmt: skip

    def __init__(self, robot: Robot, wanted: Wanted) -> None:
        self.robot = robot
        self.wanted = wanted
        self.model = robot.name or wanted.name
        self.classes = Classes(self.model)
        self.controls: list[tuple[str, str, float]] = []
        self.collisions: list[tuple[Link, Collision, Sequence[Vector]]] = []
        self.solids: list[Solid] | None = None
        self.motions: dict[str, tuple[str, str]] = {}
        self.plan = Plan(robot, is_fixed=wanted.is_fixed)
        self.sections = {
            name: Element(name, robot.span, {}, trace=robot.element.trace) for name in SECTIONS
        }
        self.bodies: dict[str, Element] = {}
        self.inertias = Inertias(robot, is_fixed=wanted.is_fixed, repairs=wanted.repairs_inertia)
        self.losses: list[Loss] = list(self.inertias.losses)
        self.files: dict[str, bytes] = {}
        self.errors: list[Diagnostic] = list(self.inertias.errors)
        self.names = Names()
        self._body_names: dict[str, str] = {}
        plan = self.plan
        self.names.reserve(BODY, plan.bodies)
        self.names.reserve(SITE, plan.sites)
        self.names.reserve(JOINT, robot.joints)

    def add(self, section: str, element: Element) -> None:
        """Append an element to a section."""
        self.sections[section].children.append(element)

    def body_name(self, link: str) -> str:
        """Return the name of the body that a link is, or is part of."""
        carrier = self.plan.carriers[link]
        if carrier is None:
            return WORLD
        if carrier != WORLD:
            return carrier
        if carrier not in self._body_names:
            self._body_names[carrier] = self.names.fresh(BODY, f"{WORLD}_link")
        return self._body_names[carrier]

    def body_of(self, link: str) -> Element:
        """Return the body that a link is, or is part of."""
        carrier = self.plan.carriers[link]
        return self.sections["worldbody"] if carrier is None else self.bodies[carrier]

    def lose(
        self,
        kind: str,
        what: str,
        owner: str,
        span: Span,
        *,
        trace: Step | None = None,
        how: str = "",
        hint: str = "",
    ) -> None:
        """Note what MJCF cannot hold; see `Loss`."""
        self.losses.append(Loss(kind, what, owner, span, trace=trace, how=how, hint=hint))

    def fail(
        self, code: str, message: str, hint: str, *, span: Span, trace: Step | None = None
    ) -> None:
        """Note an error, once for each place."""
        if not any(each.code == code and each.span == span for each in self.errors):
            self.errors.append(Diagnostic(code, message, span, hint=hint, trace=trace))


class Places:
    """Where the values of an element's attributes are written, looked up when that is asked.

    Attributes:
        sources: what each attribute is made of: something that is written, and its attribute.
    """

    __slots__ = ("sources",)

    def __init__(self, sources: dict[str, tuple[Written, str]]) -> None:
        self.sources = sources

    def get(self, attribute: str) -> Span | None:
        """Return the place of an attribute's value; None for that of the element."""
        source = self.sources.get(attribute)
        return source[0].span_of(source[1]) if source is not None else None


def made(
    name: str,
    owner: Written,
    attributes: Mapping[str, str | None],
    trace: Step | None,
    places: ValueSpans | None = None,
) -> Element:
    """Return an element at the place of what it is made of.

    Args:
        name: of the element.
        owner: what it is made of.
        attributes: by name; those that are None are left out.
        trace: the calls and includes that led to the owner.
        places: where the values of attributes are written, if not where the owner is.
    """
    given = {key: value for key, value in attributes.items() if value is not None}
    return Element(name, owner.span, dict(given), trace=trace, value_spans=places)


def number(value: float) -> str:
    """Return a number as it is written: with 15 digits, and without a point if it is whole."""
    text = f"{value:.15g}"
    if "e" in text or text == "-0":
        return format_number(value).removesuffix(".0")
    return text


def row(values: Iterable[float]) -> str:
    """Return a row of numbers."""
    return " ".join(map(number, values))


def pose_attributes(pose: Pose) -> dict[str, str | None]:
    """Return `pos` and `quat` of a pose, each None if it changes nothing."""
    x, y, z = pose.position
    x, y, z = _quiet(x), _quiet(y), _quiet(z)
    return {
        "pos": row((x, y, z)) if x or y or z else None,
        "quat": quaternion_text(pose),
    }


def quaternion_text(pose: Pose) -> str | None:
    """Return the rotation of a pose as MJCF writes it, w first; None for no rotation."""
    if pose.rotation == UNTURNED:
        return None
    w, x, y, z = quaternion_from_rotation(pose.rotation)
    x, y, z = _quiet(x), _quiet(y), _quiet(z)
    return row((_quiet(w), x, y, z)) if x or y or z else None


def _quiet(value: float) -> float:
    return value if abs(value) > NOISE else 0.0
