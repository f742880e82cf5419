"""The mass of links: what `<inertial>` says, and what follows from collisions and their density."""

from __future__ import annotations

from math import pi

from ...diagnostics import YamaroError
from ...model import making
from ...model.pose import ZERO, Pose
from ...model.schema import MOMENTS
from ...model.shapes import SIMPLE_SHAPES
from ...model.values import attribute_text, child_named, content, inside
from ...xml.values import Numbers
from .kept import check_words, kept_of
from .shapes import origin
from .values import compose, text_span

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.shapes import Inertia
    from ...xml.tree import Element
    from .kept import Held
    from .values import Reading

WATER = 1000.0
"""The density, in kg/m³, that collisions have by default. Source: collision.sdf."""
HELD: Held = {
    "@auto": True,
    "pose": True,
    "mass": True,
    "inertia": dict.fromkeys(MOMENTS, True),
}
AUTOMATIC: Held = {**HELD, "density": True, "inertia": True}
DEFAULT: Inertia = (1.0, 0.0, 0.0, 1.0, 0.0, 1.0)
"""The inertia in kg·m² of a link that says none. Source: inertial.sdf."""


class Mass:
    """The mass of a link.

    Attributes:
        element: the `<inertial>` of URDF; None for a link without mass.
        kept: what the model does not hold of SDF's.
    """

    __slots__ = ("element", "kept")

    def __init__(self, element: Element | None, kept: Element | None) -> None:
        self.element = element
        self.kept = kept


def mass_of(
    reading: Reading, link: Element, collisions: list[tuple[Element, Pose]], *, is_static: bool
) -> Mass:
    """Return the mass of a link: by default 1 kg with 1 kg·m² about each axis, as in SDFormat.

    Args:
        reading: reads the values.
        link: the `<link>`.
        collisions: its collisions, with T_link_collision.
        is_static: whether its model never moves, so that nothing is worked out.
    """
    inertial = child_named(link, "inertial")
    if inertial is not None:
        check_words(reading, inertial)
        if (attribute_text(inertial, "auto") or "").lower() in ("true", "1") and not is_static:
            found = _automatic(reading, link, inertial, collisions)
            if found is not None:
                return Mass(found, kept_of(inertial, AUTOMATIC))
    mass = reading.number(inertial, "mass", 1.0)
    moments = child_named(inertial, "inertia") if inertial is not None else None
    if moments is not None:
        check_words(reading, moments)
    inertia = [
        reading.number(moments, name, default)
        for name, default in zip(MOMENTS, DEFAULT, strict=True)
    ]
    written = child_named(inertial, "pose") if inertial is not None else None
    if mass < 0:
        place = child_named(inertial, "mass") if inertial is not None else None
        reading.fail("bad-sdf", "a mass is not negative", text_span(place) if place else link.span)
    if mass == 0 and (moments is None or not any(inertia)):
        return Mass(None, None if inertial is None else kept_of(inertial, HELD))
    spans = {
        name: text_span(each)
        for name in MOMENTS
        if moments is not None and (each := child_named(moments, name)) is not None
    }
    owner = inertial if inertial is not None else link
    weight = child_named(inertial, "mass") if inertial is not None else None
    at_mass = {"value": text_span(weight)} if weight is not None else {}
    made = making.element(
        "inertial",
        reading.place(owner.span),
        {},
        [
            *(origin(reading, reading.pose(written), owner) if inertial is not None else []),
            making.element(
                "mass",
                reading.place(owner.span, at_mass),
                {"value": _as_written(inertial, "mass", mass)},
            ),
            making.element(
                "inertia",
                reading.place(moments.span if moments is not None else owner.span, spans),
                {
                    name: _as_written(moments, name, value)
                    for name, value in zip(MOMENTS, inertia, strict=True)
                },
            ),
        ],
    )
    return Mass(made, kept_of(inertial, HELD) if inertial is not None else None)


def _as_written(parent: Element | None, name: str, value: float) -> Numbers:
    """Return a number as the child that says it spells it, else as it is computed."""
    text = content(child_named(parent, name)) if parent is not None else None
    return Numbers.of(value) if text is None else Numbers((text,), (value,), (value,))


# --- from collisions ----------------------------------------------------------------------------


def _automatic(
    reading: Reading, link: Element, inertial: Element, collisions: list[tuple[Element, Pose]]
) -> Element | None:
    """Return the mass of the collisions by their volumes and densities; None if they have none.

    A collision has its own density, else that of the inertial, else that of water. Where the
    inertial says a mass, the densities only say how it is shared out.

    Source: the proposal "Automatic Calculation of SDFormat Link Inertia".
    """
    usual = reading.number(inertial, "density", WATER)
    parts: list[tuple[float, Pose, Inertia]] = []
    for collision, pose in collisions:
        density = reading.number(collision, "density", usual)
        made = _solid(reading, collision, density)
        if made is not None:
            mass, center, inertia = made
            parts.append((mass, compose(pose, Pose(position=center)), inertia))
    total = sum(mass for mass, _, _ in parts)
    if total <= 0:
        reading.fail(
            "bad-sdf",
            "the mass of this link is worked out from its collisions, and none has a volume",
            inertial.value_span("auto"),
            hint="give it a <collision> that is a shape or a closed mesh, or a <mass>",
        )
        return None
    wanted = reading.number(inertial, "mass", total)
    factor = wanted / total
    x0, y0, z0 = (
        sum(mass * pose.position[axis] for mass, pose, _ in parts) / total for axis in range(3)
    )
    moments = [0.0] * 6
    for mass, pose, inertia in parts:
        turned = _turned(inertia, pose)
        x, y, z = (a - b for a, b in zip(pose.position, (x0, y0, z0), strict=True))
        steiner = (y * y + z * z, -x * y, -x * z, x * x + z * z, -y * z, x * x + y * y)
        for index in range(6):
            moments[index] += factor * (turned[index] + mass * steiner[index])
    place = reading.place(inertial.span)
    pose = Pose(position=(x0, y0, z0))
    return making.element(
        "inertial",
        place,
        {},
        [
            *origin(reading, pose, inertial),
            making.element("mass", place, {"value": wanted}),
            making.element("inertia", place, dict(zip(MOMENTS, moments, strict=True))),
        ],
    )


def _turned(inertia: Inertia, pose: Pose) -> Inertia:
    """Return R·I·Rᵀ."""
    xx, xy, xz, yy, yz, zz = inertia
    full = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
    r = pose.rotation
    half = [[sum(r[i][k] * full[k][j] for k in range(3)) for j in range(3)] for i in range(3)]

    def entry(i: int, j: int) -> float:
        return sum(half[i][k] * r[j][k] for k in range(3))

    return (entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2))


def _solid(
    reading: Reading, collision: Element, density: float
) -> tuple[float, tuple[float, float, float], Inertia] | None:
    """Return mass, centre and inertia of a collision's shape; None for one without a volume."""
    geometry = child_named(collision, "geometry")
    for shape in geometry.elements() if geometry is not None else ():
        if shape.name in SIMPLE_SHAPES:
            kind = SIMPLE_SHAPES[shape.name]
            sizes = (
                list(reading.vector(shape, "size", (1.0, 1.0, 1.0)))
                if shape.name == "box"
                else [reading.number(shape, name, 1.0) for name in kind.sizes]
            )
            if min(sizes) <= 0:
                return None
            solid = kind(*sizes)
            mass = density * solid.volume()
            return mass, ZERO, solid.inertia(mass)
        if shape.name == "ellipsoid":
            return _ellipsoid(density, reading.vector(shape, "radii", (1.0, 1.0, 1.0)))
        if shape.name == "cone":
            radius, length = (reading.number(shape, name, 1.0) for name in ("radius", "length"))
            return _cone(density, radius, length)
        if shape.name == "mesh":
            return _mesh(reading, shape, density)
    return None


def _ellipsoid(
    density: float, radii: tuple[float, float, float]
) -> tuple[float, tuple[float, float, float], Inertia]:
    """Return mass 4/3·π·a·b·c·ρ, centre and the moments m/5·(b² + c²) and so on.

    Source: https://en.wikipedia.org/wiki/List_of_moments_of_inertia, "ellipsoid".
    """
    a, b, c = radii
    mass = density * 4 / 3 * pi * a * b * c
    return mass, ZERO, (mass / 5 * (b * b + c * c), 0, 0, mass / 5 * (a * a + c * c), 0,
                        mass / 5 * (a * a + b * b))  # fmt: skip


def _cone(
    density: float, radius: float, length: float
) -> tuple[float, tuple[float, float, float], Inertia]:
    """Return mass, centre and inertia of a cone along z, whose frame is halfway up.

    Its centre of mass is l/4 below that. About it: 3/10·m·r² along, 3/80·m·(4r² + l²) across.

    Source: https://en.wikipedia.org/wiki/List_of_moments_of_inertia, "solid cone", moved to the
    centre of mass.
    """
    mass = density * pi * radius * radius * length / 3
    across = 3 / 80 * mass * (4 * radius * radius + length * length)
    along = 3 / 10 * mass * radius * radius
    return mass, (0.0, 0.0, -length / 4), (across, 0, 0, across, 0, along)


def _mesh(
    reading: Reading, shape: Element, density: float
) -> tuple[float, tuple[float, float, float], Inertia] | None:
    """Return mass, centre and inertia of a mesh by its volume."""
    from ...meshes.formats import MeshFileError, MissingLibraryError
    from ...meshes.triangles import is_closed
    from ...model.inertia import solid_moments
    from ...model.shapes import MeshSolid

    uri = inside(shape, "uri")
    if uri is None or not content(uri):
        return None
    span = text_span(uri)
    scale = reading.vector(shape, "scale", (1.0, 1.0, 1.0))
    try:
        path = reading.host.find(content(uri) or "", span)
        if path is None:
            reading.fail(
                "bad-sdf",
                f"the mesh '{content(uri)}' is not found, and the mass of the link follows from it",
                span,
            )
            return None
        mesh = reading.host.mesh(path)
    except YamaroError as error:
        reading.errors += error.diagnostics
        return None
    except (MeshFileError, MissingLibraryError) as error:
        reading.fail("bad-sdf", f"the mesh '{content(uri)}' cannot be read: {error}", span)
        return None
    moments = solid_moments(mesh).scaled(scale) if is_closed(mesh) else None
    if moments is None or not moments.volume:
        reading.fail(
            "bad-sdf",
            f"the mesh '{content(uri)}' encloses no volume, which the mass of the link needs",
            span,
            hint="write the <mass> and the <inertia> of the link",
        )
        return None
    solid = MeshSolid(moments)
    mass = density * abs(moments.volume)
    return mass, solid.center(), solid.inertia(mass)
