"""Compares two robots by meaning; see `Robot.changes`."""

from __future__ import annotations

from ..joint import FIXED, FLOATING, PRISMATIC
from ..pose import multiply, transposed
from ..quantities import unit_of
from ..schema import ELEMENTS, MOMENTS
from ..shapes import Mesh
from .change import ADDED, CHANGED, REMOVED, RENAMED, Change, Changes
from .context import DEFAULT, Comparing, Owner, Tolerance
from .extras import compare_extras, compare_other_elements, compare_rest, extras_held
from .matching import Matching, pose_signature, shape_key
from .motion import KINEMATIC, MotionComparison

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from ...source import Span
    from ..joint import Joint
    from ..link import Collision, Inertial, Link, Material, Visual
    from ..pose import Vector
    from ..robot import Robot
    from ..shapes import Inertia, Shape
    from .context import Comparing, Place, SameFile


def compare_robots(
    first: Robot,
    second: Robot,
    *,
    tolerance: float = DEFAULT,
    same_file: SameFile | None = None,
    has_extras: bool = True,
) -> Changes:
    """Return what changed from one robot to another.

    Args:
        first: the robot before.
        second: the robot after.
        tolerance: how far numbers may differ, as a part of the larger one; rotations in radians.
        same_file: says whether two mesh or texture files have the same content; by default they
            are compared by name.
        has_extras: whether both robots can hold what URDF has no elements for, such as sensors.
    """
    matching = Matching(first, second)
    comparing = Comparing(
        first, second, matching=matching, tolerance=Tolerance(tolerance), same_file=same_file
    )
    owner = Owner("robot", first.name, new_name=None, places=(first.span, second.span))
    comparing.text(owner, "name", (first.name, second.name))
    compare_materials(comparing)
    _compare_all("link", (first.links, second.links), matching.links, comparing)
    _compare_all("joint", (first.joints, second.joints), matching.joints, comparing)
    compare_other_elements(comparing)
    if has_extras:
        compare_extras(comparing)
    first, second = comparing.first, comparing.second
    motions = MotionComparison(comparing)
    causes: dict[str, Change] = {}
    for change in comparing.changes:
        is_kinematic = change.kind in (ADDED, REMOVED) or (
            change.kind == CHANGED and change.what.partition(".")[0] in KINEMATIC
        )
        if change.of == "joint" and is_kinematic:  # then links can be elsewhere
            causes.setdefault(change.name, change)
    for cause, moved in motions.moved_by(list(causes.values())):
        cause.moved = moved
    new = comparing.matching.links.get(motions.reference, "")
    skipped = [] if has_extras else [*extras_held(first), *extras_held(second)]
    return Changes(
        comparing.changes,
        motion=motions.motion(),
        mass=(first.mass, second.mass),
        center=(_center(first, motions.reference), _center(second, new)),
        links=comparing.matching.links,
        joints=comparing.matching.joints,
        skipped=skipped,
    )


def _compare_all(
    of: str,
    rows: tuple[Mapping[str, Link | Joint], Mapping[str, Link | Joint]],
    names: dict[str, str],
    comparing: Comparing,
) -> None:
    """Compare all links, or all joints: those that both robots have, and those that one has."""
    compare: Callable[..., None] = compare_links if of == "link" else compare_joints
    facts: Callable[..., object] = link_facts if of == "link" else joint_facts
    first, second = rows
    for name, one in first.items():
        if name not in names:
            comparing.add(of, name, is_new=False, value=facts(one), place=one.span)
            continue
        other = second[names[name]]
        if one.name != other.name:
            comparing.changes.append(
                Change(RENAMED, of, name, new_name=other.name, first=one.span, second=other.span)
            )
        if one.element is not other.element:
            compare(one, other, comparing)
            owner = Owner(of, one.name, new_name=other.name, places=(one.span, other.span))
            compare_rest(one.element, other.element, "", owner, comparing)
    known = set(names.values())
    for name, other in second.items():
        if name not in known:
            comparing.add(of, name, is_new=True, value=facts(other), place=other.span)


def _center(robot: Robot, reference: str) -> Vector | None:
    """Return the centre of mass in the frame of a link, with all joints at zero."""
    if not robot.mass:
        return None
    center = robot.center_of_mass()
    return robot.pose(reference).inverse().apply(center) if reference else center


# --- links ------------------------------------------------------------------------------------


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
        room = comparing.tolerance.part * max(map(abs, (*moments[0], *moments[1])))
        differing = [name for name in MOMENTS if not abs(before[name] - after[name]) <= room]
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
            text = shape_text(body.shape)
            values = (None, text) if is_new else (text, None)
            places: Place = (None, body.span) if is_new else (body.span, None)
            comparing.change(owner, label, *values, places=places)


def _number(body: Visual | Collision, row: Sequence[Visual | Collision]) -> str:
    """Return which one a shape is of its link's, from 1."""
    return str(next(i for i, each in enumerate(row, 1) if each is body))


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
    keys = {id(body): _keys(body) for body in (*one, *other)}
    for rank in range(6):
        if not mine or not others:
            break
        alike: dict[object, list[list[Visual | Collision]]] = {}
        for index, row in enumerate((mine, others)):
            for body in row:
                alike.setdefault(keys[id(body)][rank], [[], []])[index].append(body)
        for found, theirs in alike.values():
            pairs += zip(found, theirs)  # noqa: B905 - those without a partner stay
        taken = {id(body) for pair in pairs for body in pair}
        mine = [body for body in mine if id(body) not in taken]
        others = [body for body in others if id(body) not in taken]
    pairs.sort(key=lambda pair: next(i for i, body in enumerate(one) if body is pair[0]))
    return pairs, mine, others


def _keys(body: Visual | Collision) -> tuple[object, ...]:
    """Return what matches a shape, the surest first; at last those without a name in order."""
    shape, pose = shape_key(body.shape), pose_signature(body.pose)
    material = getattr(body, "material", None)
    whole = (body.name, None if material is None else material.name, shape, pose)
    if body.name:
        own = id(body)
        return (whole, body.name, (shape, pose), own, own, own)
    return (whole, id(body), (shape, pose), shape, pose, None)


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


# --- joints -----------------------------------------------------------------------------------


WITH_NUMBERS = ("limit", "dynamics", "safety_controller", "calibration")
"""The parts of a joint that are made of numbers."""


def compare_joints(one: Joint, other: Joint, comparing: Comparing) -> None:
    """Note in what two joints differ; their names are another matter."""
    owner = Owner("joint", one.name, new_name=other.name, places=(one.span, other.span))
    comparing.text(owner, "type", (one.type, other.type))
    comparing.named(owner, "parent", (one.parent, other.parent), comparing.link)
    comparing.named(owner, "child", (one.child, other.child), comparing.link)
    if one.origin is not other.origin:
        comparing.pose(owner, "origin", one.origin, other.origin, owner.places)
    if one.type not in (FIXED, FLOATING) and other.type not in (FIXED, FLOATING):
        opposite = tuple(-component for component in other.axis)
        is_opposite = comparing.tolerance.same_row(one.axis, opposite)
        comparing.row(
            owner,
            "axis",
            (one.axis, other.axis),
            remark="the opposite direction" if is_opposite else "",
            places=_places(one.inner("axis"), other.inner("axis")),
        )
    kind = PRISMATIC if PRISMATIC in (one.type, other.type) else one.type
    for part in WITH_NUMBERS:
        values = (getattr(one, part), getattr(other, part))
        if values[0] is values[1]:
            continue
        left_out = 0.0 if part == "dynamics" else None  # without a limit there is none
        for name, field in ELEMENTS[part].fields.items():
            before, after = (left_out if each is None else getattr(each, name) for each in values)
            places = [None if each is None else each.span_of(name) for each in values]
            comparing.number(
                owner,
                f"{part}.{name}",
                (before, after),
                unit=unit_of(field.kind, kind),
                places=(places[0], places[1]),
            )
    _compare_mimics(one, other, owner, comparing, unit=unit_of("position", kind))


def _places(one: object, other: object) -> Place:
    """Return where two elements are written."""
    return (getattr(one, "span", None), getattr(other, "span", None))


def _compare_mimics(
    one: Joint, other: Joint, owner: Owner, comparing: Comparing, *, unit: str
) -> None:
    first, second = one.mimic, other.mimic
    if first is second:
        return
    places = _places(first, second)
    if first is None or second is None:
        values = (first and first.joint, second and second.joint)
        factors = [
            f"{each.multiplier:g} times its position"
            + (f", plus {each.offset:g} {unit}" if each.offset else "")
            for each in (first, second)
            if each is not None and (each.multiplier != 1 or each.offset)
        ]
        remark = factors[0] if factors else ""
        comparing.change(owner, "mimic.joint", *values, remark=remark, places=places)
        return
    comparing.named(
        owner, "mimic.joint", (first.joint, second.joint), comparing.joint, places=places
    )
    comparing.number(
        owner, "mimic.multiplier", (first.multiplier, second.multiplier), places=places
    )
    comparing.number(owner, "mimic.offset", (first.offset, second.offset), unit=unit, places=places)


def joint_facts(joint: Joint) -> dict[str, object]:
    """Return what to say of a joint that only one robot has."""
    return {"type": joint.type, "parent": joint.parent, "child": joint.child}


# --- materials, and how visuals look ----------------------------------------------------------
# The name of a material that is made of a colour in a visual, `base_color`, means nothing: the
# colour is compared where it is used.


MADE = "_color"
"""How the name of a material ends that is made of a colour; see `robot/link.py`."""


def is_made_of_color(name: str, robot: Robot) -> bool:
    """Return whether a material has no name of its own: none, or that of a link's colour."""
    stem, ending, number = name.rpartition(MADE)
    is_numbered = not number or (number[0] == "_" and number[1:].isdigit())
    return not name or (bool(ending) and is_numbered and stem in robot.links)


def compare_materials(comparing: Comparing) -> None:
    """Note in what the definitions of materials differ."""
    first, second = _named(comparing.first), _named(comparing.second)
    removed = [name for name in first if name not in second]
    added = [name for name in second if name not in first]
    for name in removed.copy():
        twin = next((n for n in added if _look(first[name]) == _look(second[n])), None)
        if twin is not None:
            removed.remove(name)
            added.remove(twin)
            one, other = first[name], second[twin]
            comparing.changes.append(
                Change(RENAMED, "material", name, new_name=twin, first=one.span, second=other.span)
            )
    for name, material in first.items():
        if name in removed:
            comparing.add(
                "material", name, is_new=False, value=look_text(material), place=material.span
            )
        elif name in second:
            other = second[name]
            owner = Owner("material", name, new_name=None, places=(material.span, other.span))
            _compare_look(material, other, "", owner, comparing)
    for name in added:
        material = second[name]
        comparing.add("material", name, is_new=True, value=look_text(material), place=material.span)


def _named(robot: Robot) -> dict[str, Material]:
    return {
        name: material
        for name, material in robot.materials.items()
        if not is_made_of_color(name, robot)
    }


def compare_looks(
    one: Visual, other: Visual, what: str, owner: Owner, comparing: Comparing
) -> None:
    """Compare how two visuals look."""
    first, second = comparing.first.material_of(one), comparing.second.material_of(other)
    if first is second:
        return
    places = (
        one.material.span if one.material is not None else one.span,
        other.material.span if other.material is not None else other.span,
    )
    names = (first.name if first else "", second.name if second else "")
    is_made = (
        is_made_of_color(names[0], comparing.first),
        is_made_of_color(names[1], comparing.second),
    )
    if not any(is_made):
        is_renamed = any(  # which is noted with the materials
            change.kind == RENAMED and (change.name, change.new_name) == names
            for change in comparing.changes
            if change.of == "material"
        )
        if names[0] != names[1] and not is_renamed:
            remark = "with the same look" if _look(first) == _look(second) else ""
            comparing.change(owner, f"{what}.material", *names, remark=remark, places=places)
        return
    before, after = (
        look_text(material) if made else (material.name if material else None)
        for material, made in zip((first, second), is_made, strict=True)
    )
    if not all(is_made):
        comparing.change(owner, f"{what}.material", before, after, places=places)
        return
    _compare_look(first, second, f"{what}.", owner, comparing)


def _compare_look(
    one: Material | None, other: Material | None, what: str, owner: Owner, comparing: Comparing
) -> None:
    """Compare colours and textures."""
    colors = (one.color if one else None, other.color if other else None)
    comparing.row(owner, f"{what}color", colors)
    textures = (one.texture if one else None, other.texture if other else None)
    if textures[0] is not None and textures[1] is not None:
        assert one is not None and other is not None
        comparing.file(owner, f"{what}texture", (textures[0], textures[1]), (one.span, other.span))
    elif textures[0] != textures[1]:
        comparing.change(owner, f"{what}texture", *textures)


def _look(material: Material | None) -> object:
    return None if material is None else (material.color, material.texture)


def look_text(material: Material | None) -> object:
    """Return a colour and a texture, as they are shown."""
    if material is None:
        return None
    color = "" if material.color is None else " ".join(f"{c:.6g}" for c in material.color)
    return " ".join(text for text in (color, material.texture or "") if text) or None
