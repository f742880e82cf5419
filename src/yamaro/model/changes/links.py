"""What differs between two links: mass, inertia, and the shapes that are seen and collide."""

from __future__ import annotations

from ..pose import multiply, transposed
from ..shapes import Mesh
from .context import Owner
from .elements import compare_rest
from .materials import compare_looks
from .signatures import pose_signature, shape_key

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...source import Span
    from ..link import Collision, Inertial, Link, Visual
    from ..shapes import Inertia, Shape
    from .context import Comparing, Place

MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
IN_PROPORTION = 1e-6
"""How far an inertia may be from that of the same body with another mass, as a part of it."""


def compare_links(one: Link, other: Link, comparing: Comparing) -> None:
    """Note in what two links differ; their names are another matter."""
    owner = Owner("link", one.name, new_name=other.name, places=(one.span, other.span))
    if one.inertial is not other.inertial:
        _compare_inertials(one.inertial, other.inertial, owner, comparing)
    for kind, rows in (
        ("visual", (one.visuals, other.visuals)),
        ("collision", (one.collisions, other.collisions)),
    ):
        if rows[0] is not rows[1]:
            _compare_shapes(kind, rows, owner, comparing)


# --- mass ---


def _compare_inertials(
    one: Inertial | None, other: Inertial | None, owner: Owner, comparing: Comparing
) -> None:
    if one is None or other is None:
        values = [None if each is None else each.mass for each in (one, other)]
        places = (_span_of(one), _span_of(other))
        comparing.change(owner, "inertial", *values, unit="kg", places=places)
        return
    places = (one.span, other.span)
    moments = (_along_link(one), _along_link(other))
    has_inertia = comparing.tolerance.same_row(*moments)
    is_scaled = not has_inertia and _is_scaled(one.mass, moments[0], other.mass, moments[1])
    remark = "the inertia in proportion" if is_scaled else ""
    comparing.number(
        owner,
        "mass",
        (one.mass, other.mass),
        unit="kg",
        remark=remark,
        places=(_place(one, "mass"), _place(other, "mass")),
    )
    comparing.row(
        owner,
        "center_of_mass",
        (one.pose.position, other.pose.position),
        unit="m",
        places=(one.pose.span or one.span, other.pose.span or other.span),
    )
    if not has_inertia and not is_scaled:
        before, after = (dict(zip(MOMENTS, row, strict=True)) for row in moments)
        differing = [name for name in MOMENTS if not _is_near(before, after, name, comparing)]
        comparing.change(
            owner,
            "inertia",
            {name: before[name] for name in differing},
            {name: after[name] for name in differing},
            unit="kg·m²",
            places=places,
        )


def _span_of(inertial: Inertial | None) -> Span | None:
    return None if inertial is None else inertial.span


def _place(inertial: Inertial, child: str) -> Span:
    element = inertial.inner(child)
    return inertial.span if element is None else element.value_span("value")


def _along_link(inertial: Inertial) -> Inertia:
    """Return the inertia about the centre of mass along the axes of the link: R·I·Rᵀ."""
    rotation = inertial.pose.rotation
    turned = multiply(multiply(rotation, inertial.matrix()), transposed(rotation))
    (ixx, ixy, ixz), (_, iyy, iyz), (_, _, izz) = turned
    return (ixx, ixy, ixz, iyy, iyz, izz)


def _is_scaled(mass: float, moments: Inertia, new_mass: float, new_moments: Inertia) -> bool:
    """Return whether an inertia is that of the same body with another mass."""
    if not mass or not new_mass:
        return False
    factor = new_mass / mass
    room = IN_PROPORTION * max(factor * max(map(abs, moments)), max(map(abs, new_moments)))
    return all(abs(a * factor - b) <= room for a, b in zip(moments, new_moments, strict=True))


def _is_near(
    before: dict[str, float], after: dict[str, float], name: str, comparing: Comparing
) -> bool:
    """Return whether one moment is equal, measured by the largest."""
    largest = max(map(abs, (*before.values(), *after.values())))
    return abs(before[name] - after[name]) <= comparing.tolerance.part * largest


# --- shapes ---


def _compare_shapes(
    kind: str,
    rows: tuple[Sequence[Visual | Collision], Sequence[Visual | Collision]],
    owner: Owner,
    comparing: Comparing,
) -> None:
    """Compare the visuals or the collisions of two links; their order has no meaning."""
    one, other = rows
    is_single = len(one) <= 1 and len(other) <= 1
    pairs, removed, added = _paired(one, other)

    for mine, theirs in pairs:
        numbers = (_number(mine, one), _number(theirs, other))
        label = kind if is_single else f"{kind}[{'→'.join(dict.fromkeys(numbers))}]"
        _compare_bodies(mine, theirs, label, owner, comparing)
    for bodies, row, is_new in ((removed, one, False), (added, other, True)):
        for body in bodies:
            label = kind if is_single else f"{kind}[{_number(body, row)}]"
            _one_sided(body, label, owner, comparing, is_new=is_new)


def _number(body: Visual | Collision, row: Sequence[Visual | Collision]) -> str:
    """Return which one a shape is of its link's, from 1."""
    return str(next(i for i, each in enumerate(row, 1) if each is body))


def _one_sided(
    body: Visual | Collision, what: str, owner: Owner, comparing: Comparing, *, is_new: bool
) -> None:
    """Note a shape that only one robot has."""
    text = shape_text(body.shape)
    values = (None, text) if is_new else (text, None)
    places: Place = (None, body.span) if is_new else (body.span, None)
    comparing.change(owner, what, *values, places=places)


def _paired(
    one: Sequence[Visual | Collision], other: Sequence[Visual | Collision]
) -> tuple[
    list[tuple[Visual | Collision, Visual | Collision]],
    list[Visual | Collision],
    list[Visual | Collision],
]:
    """Return which shape is which, what is only in the first row, and what only in the second."""
    pairs: list[tuple[Visual | Collision, Visual | Collision]] = []
    mine, others = list(one), list(other)
    for key in (_whole, _name, _content, _shape, _pose, _kind):
        if not mine or not others:
            break
        alike: dict[object, list[list[Visual | Collision]]] = {}
        for index, row in enumerate((mine, others)):
            for body in row:
                alike.setdefault(key(body), [[], []])[index].append(body)
        for found, theirs in alike.values():
            pairs += zip(found, theirs)  # noqa: B905 - those without a partner stay
        taken = {id(body) for pair in pairs for body in pair}
        mine = [body for body in mine if id(body) not in taken]
        others = [body for body in others if id(body) not in taken]
    pairs.sort(key=lambda pair: next(i for i, body in enumerate(one) if body is pair[0]))
    return pairs, mine, others


def _whole(body: Visual | Collision) -> object:
    material = getattr(body, "material", None)
    name = None if material is None else material.name
    return (body.name, name, _content(body))


def _name(body: Visual | Collision) -> object:
    return body.name or id(body)


def _content(body: Visual | Collision) -> object:
    return (shape_key(body.shape), pose_signature(body.pose))


def _shape(body: Visual | Collision) -> object:
    return id(body) if body.name else shape_key(body.shape)


def _pose(body: Visual | Collision) -> object:
    return id(body) if body.name else pose_signature(body.pose)


def _kind(body: Visual | Collision) -> object:
    """Return what any two shapes without names share: in the end they are matched in order."""
    return id(body) if body.name else None


def _compare_bodies(
    one: Visual | Collision,
    other: Visual | Collision,
    what: str,
    owner: Owner,
    comparing: Comparing,
) -> None:
    """Compare two visuals or collisions."""
    if one is other:
        return
    places = (one.span, other.span)
    comparing.text(owner, f"{what}.name", (one.name, other.name), places=places)
    comparing.pose(owner, f"{what}.origin", one.pose, other.pose, places)
    _compare_geometry(one.shape, other.shape, what, owner, comparing, places)
    compare_rest(one.element, other.element, what, owner, comparing)
    if hasattr(one, "material"):
        compare_looks(one, other, what, owner, comparing)  # type: ignore[arg-type]


def _compare_geometry(
    one: Shape | None,
    other: Shape | None,
    what: str,
    owner: Owner,
    comparing: Comparing,
    places: Place,
) -> None:
    if one is None or other is None or type(one) is not type(other):
        values = (shape_text(one), shape_text(other))
        comparing.text(owner, f"{what}.geometry", values, places=_spans(one, other, places))
        return
    places = _spans(one, other, places)
    if isinstance(one, Mesh) and isinstance(other, Mesh):
        assert one.element is not None and other.element is not None
        spans = (one.element.value_span("filename"), other.element.value_span("filename"))
        comparing.file(owner, f"{what}.mesh", (one.filename, other.filename), spans)
        comparing.row(owner, f"{what}.scale", (one.scale, other.scale), places=places)
        return
    if len(one.attributes) == 1 and len(one.size) > 1:
        name = one.attributes[0]
        comparing.row(owner, f"{what}.{name}", (one.size, other.size), unit="m", places=places)
        return
    for name, before, after in zip(one.attributes, one.size, other.size, strict=True):
        comparing.number(owner, f"{what}.{name}", (before, after), unit="m", places=places)


def _spans(one: Shape | None, other: Shape | None, places: Place) -> Place:
    return ((one and one.span) or places[0], (other and other.span) or places[1])


def shape_text(shape: Shape | None) -> str:
    """Return a shape in words, such as `box 0.4 0.3 0.2`."""
    if shape is None:
        return "no shape"
    if isinstance(shape, Mesh):
        return f"mesh {shape.filename}"
    return " ".join([shape.kind, *(f"{number:.6g}" for number in shape.size)])


def link_facts(link: Link) -> dict[str, object]:
    """Return what to say of a link that only one robot has."""
    facts: dict[str, object] = {}
    if link.inertial is not None:
        facts["mass"] = link.mass
    if link.visuals:
        facts["visuals"] = [shape_text(visual.shape) for visual in link.visuals]
    if link.collisions:
        facts["collisions"] = [shape_text(collision.shape) for collision in link.collisions]
    return facts
