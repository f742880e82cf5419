"""The `inertial` of a link: its mass, and its inertia as given or as the shape has it."""

from __future__ import annotations

from math import isfinite

from ..diagnostics import YamaroError, failure
from ..model.schema import MOMENTS
from ..xml.tree import Element
from ..xml.values import Numbers, remember
from .fields import Fields, read_record, refuse_misspelt
from .geometry import section_geometry, solid_shape
from .numbers import read_attribute, read_numbers
from .pose import NO_POSE, Pose, compose_poses, origin_element, pose_at, read_pose

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..diagnostics import Diagnostic
    from ..model.shapes import Solid
    from ..source import Span
    from ..xml.tree import Node
    from .geometry import Geometry, LinkGeometry
    from .lowering import Lowering


ZERO = Numbers.spelled(("0",))


class LinkMass:
    """The `mass` and `density` written in a link, which its `inertial` inherits."""

    __slots__ = ("density", "mass")

    def __init__(self, fields: Fields) -> None:
        self.mass = fields.keys.get("mass")
        self.density = fields.keys.get("density")

    def key(self) -> Element | None:
        """Return the key that gives the mass, or None."""
        return self.mass or self.density


def lower_inertial(
    lowering: Lowering,
    owner: Element,
    fields: Fields,
    *,
    link_pose: Pose,
    link_geometry: LinkGeometry,
    link_mass: LinkMass,
) -> Element:
    """Return `<inertial>` with origin, mass, inertia, and the rest as written.

    Args:
        lowering: the run.
        owner: the `inertial` key, or the `mass` or `density` key that replaces one.
        fields: the keys of the inertial.
        link_pose: the link's pose, in which the inertial's is given.
        link_geometry: the link's geometry.
        link_mass: the link's mass or density.

    Raises:
        YamaroError: no mass, no shape to compute the inertia from, or faulty numbers.
    """
    faults: list[Diagnostic] = []
    pose, mass, mass_element = NO_POSE, 0.0, None
    try:
        pose = compose_poses(link_pose, read_pose(lowering, fields))
    except YamaroError as error:
        faults += error.diagnostics
    body = _Body(lowering, owner, fields, link_geometry)
    try:
        mass_element, mass = _mass(lowering, owner, fields, link_mass, body)
    except YamaroError as error:
        faults += error.diagnostics
    inertia_key, inertia_element = fields.keys.get("inertia"), fields.plain.get("inertia")
    shape = None
    if inertia_element is None:
        try:
            if inertia_key is not None:
                inertia_element = _given_inertia(lowering, inertia_key)
            elif all(each.code != "missing-geometry" for each in faults):
                shape = body.shape("the inertia is computed from it")
        except YamaroError as error:
            faults += error.diagnostics
    if faults or mass_element is None:
        raise YamaroError(faults)
    if inertia_element is None:
        assert shape is not None, "there is no fault"
        pose = compose_poses(pose, pose_at(shape.center()))
        moments = shape.inertia(mass)
        if not all(map(isfinite, moments)):
            raise _too_large(owner)
        written = lowering.inertias.get(moments)
        if written is None:
            written = tuple([Numbers.of(value) if value else ZERO for value in moments])
            remember(lowering.inertias, moments, written)
        inertia_element = Element(
            "inertia", owner.span, dict(zip(MOMENTS, written, strict=True)), [], owner.trace
        )
    origin = fields.plain.get("origin") or origin_element(pose, owner)
    children: list[Node] = [] if origin is None else [origin]
    children += (mass_element, inertia_element)
    attributes = owner.attributes if owner.name == "inertial" else {}
    children += fields.rest
    spans = owner.value_spans if attributes else None
    return Element("inertial", owner.span, attributes, children, owner.trace, spans)


class _Body:
    """The shape of an inertial, worked out only when mass or inertia need it."""

    __slots__ = ("_shape", "fields", "geometry", "link_geometry", "lowering", "owner")

    def __init__(
        self, lowering: Lowering, owner: Element, fields: Fields, link_geometry: LinkGeometry
    ) -> None:
        self.lowering = lowering
        self.owner = owner
        self.fields = fields
        self.link_geometry = link_geometry
        self.geometry: Geometry | None = None
        self._shape: Solid | None = None

    def shape(self, reason: str) -> Solid:
        if self._shape is None:
            self.geometry = section_geometry(self.lowering, self.fields, self.link_geometry)
            if self.geometry is None:
                raise failure(
                    "missing-geometry",
                    f"this link has no geometry, and {reason}",
                    self.owner.span,
                    hint="give the link a geometry and a scale, or write inertial: "
                    "{mass: 1.0, inertia: ixx ixy ixz iyy iyz izz}",
                    trace=self.owner.trace,
                )
            self._shape = solid_shape(self.lowering, self.geometry)
        return self._shape


# --- mass -------------------------------------------------------------------------------------


def _mass(
    lowering: Lowering, owner: Element, fields: Fields, link_mass: LinkMass, body: _Body
) -> tuple[Element, float]:
    """Return `<mass>` and the mass in kilograms, from the inertial's keys or else the link's."""
    plain = fields.plain.get("mass")
    if plain is not None:
        value, span = plain.attributes.get("value"), plain.value_span("value")
        if value is None or "inertia" in fields.keys or "inertia" in fields.plain:
            return plain, 0.0
        return plain, _one(lowering, plain, value, span).values[0]
    own_mass, own_density = fields.keys.get("mass"), fields.keys.get("density")
    if own_mass is None and own_density is None:
        own_mass, own_density = link_mass.mass, link_mass.density
    if own_mass is not None and own_density is not None:
        raise failure(
            "given-twice",
            "both 'mass' and 'density' are given",
            own_density.span,
            hint="with a density, the mass is computed from the "
            "volume of the shape; keep one of the two",
            notes=(f"'mass' is given at {own_mass.span.place()}",),
            trace=own_density.trace,
        )
    if own_mass is not None:
        number, span = _number(lowering, own_mass)
        return _mass_element(own_mass, number, span), number.values[0]
    if own_density is not None:
        number, span = _number(lowering, own_density)
        mass = number.values[0] * body.shape("the mass is computed from it").volume()
        if not isfinite(mass):
            raise _too_large(own_density)
        return _mass_element(own_density, Numbers.of(mass), span), mass
    raise failure(
        "missing-mass",
        "this inertial has no mass",
        owner.span,
        hint="write mass: 1.0 (kg) or density: 1000 (kg/m³), in 'link' or in 'inertial'",
        trace=owner.trace,
    )


def _number(lowering: Lowering, key: Element) -> tuple[Numbers, Span]:
    """Return the one number of a key, and where it is written."""
    record = read_record(lowering, key, "value")
    refuse_misspelt(record, ("value",))
    if "value" not in record.values:
        raise failure(
            "empty-value",
            f"'{key.name}' is empty",
            key.span,
            hint=f"write {key.name}: 1.0",
            trace=key.trace,
        )
    span = record.span("value")
    return _one(lowering, key, record.values["value"], span), span


def _one(lowering: Lowering, key: Element, value: object, span: Span) -> Numbers:
    return read_numbers(lowering, value, span, count=1, name=key.name, trace=key.trace)


def _mass_element(key: Element, mass: Numbers, span: Span) -> Element:
    return Element("mass", key.span, {"value": mass}, [], key.trace, {"value": span})


# --- inertia ----------------------------------------------------------------------------------


def _given_inertia(lowering: Lowering, key: Element) -> Element:
    """Return `<inertia>` of six numbers, or of six attributes as people write them in URDF."""
    record = read_record(lowering, key, "row")
    value = record.values.pop("row", None)
    if value is not None:
        span = record.span("row")
        numbers = read_numbers(lowering, value, span, count=6, name="inertia", trace=key.trace)
        moments: dict[str, object] = dict(zip(MOMENTS, numbers.one_by_one(), strict=True))
        return Element(
            "inertia",
            key.span,
            attributes={**moments, **record.values},
            value_spans=dict.fromkeys(MOMENTS, span),
            trace=key.trace,
        )
    refuse_misspelt(record, MOMENTS)
    missing = [name for name in MOMENTS if name not in record.values]
    if missing:
        listed = ", ".join(f"'{name}'" for name in missing)
        raise failure(
            "wrong-count",
            f"'inertia' takes 6 numbers, but {listed} {'is' if len(missing) == 1 else 'are'} not "
            "given",
            key.span,
            hint=f"write inertia: {' '.join(MOMENTS)}, in kg·m²",
            trace=key.trace,
        )
    for name in MOMENTS:
        record.values[name] = read_attribute(lowering, record, name, count=1, name=name)
    return record.element()


def _too_large(key: Element) -> YamaroError:
    """Return the error that numbers are so large that mass or inertia overflow."""
    return failure(
        "bad-number",
        "the computed mass or inertia is too large for a number",
        key.span,
        hint="sizes are in metres, masses in kilograms, densities in kg/m³",
        trace=key.trace,
    )
