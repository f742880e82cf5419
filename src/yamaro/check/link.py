"""Check of one link's values: mass, inertia, shapes, colours and poses."""

from __future__ import annotations

from math import fabs, hypot, tau

from ..diagnostics import WARNING
from ..model.schema import MOMENTS
from ..model.shapes import SHAPE_WORDS, SIMPLE_SHAPES, Capsule, Mesh
from ..model.values import attribute_text
from ..xml.tree import Element
from .context import LINKS, CheckContext, degrees_hint, label, shown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .context import Children

TRIANGLE_TOLERANCE = 1e-3
"""By how much, relative, two principal moments may fall short of the third: room for rounding."""

ANGLE_TOLERANCE = 1e-2
CAPSULE_CODE = "capsule-needs-urdf-1.1"
PLAIN_SHAPES = frozenset(kind for kind, shape in SIMPLE_SHAPES.items() if shape.since == "1.0")
"""Shapes of which only the sizes can be wrong."""


# --- mass and inertia -------------------------------------------------------------------------


def check_inertial(
    inertial: Element, children: Children, link: Element, context: CheckContext
) -> None:
    """Check the pose, the mass and the inertia of a link's inertial."""
    context.stage = LINKS
    check_pose(children.get("origin"), link, context)
    mass_element = children.get("mass")
    mass = context.numbers.number(mass_element, "value")
    if mass_element is not None and mass is not None and mass <= 0:
        hint = "give the mass in kilograms"
        if mass == 0:
            hint += ", or remove `inertial` if the link is only a frame"
        context.report(
            "bad-mass",
            f"the mass of {label(link)} is {shown(mass)}, but must be greater than 0",
            mass_element,
            attribute="value",
            hint=hint,
        )
        return
    inertia = children.get("inertia")
    if inertia is None:
        return
    texts = tuple([attribute_text(inertia, name) for name in MOMENTS])
    if texts in context.sound:
        return
    values = []
    for name in MOMENTS:
        number = context.numbers.number(inertia, name)
        if number is None:
            return
        values.append(number)
    ixx, ixy, ixz, iyy, iyz, izz = values
    moments = (ixx, iyy, izz)
    if ixy or ixz or iyz:
        from ..model.inertia import principal_axes

        moments, _ = principal_axes(((ixx, ixy, ixz), (ixy, iyy, iyz), (ixz, iyz, izz)))
    fault = _inertia_fault(moments)
    if fault is None:
        context.sound.add(texts)
        return
    spans = inertia.value_spans
    context.report(
        "bad-inertia",
        f"no body can have the inertia of {label(link)}: {fault}",
        inertia,
        attribute="ixx" if spans is not None and spans.get("ixx") else None,
        hint="in a part, omit `inertia` to compute it from the mass and the shape",
    )


def _inertia_fault(moments: tuple[float, float, float]) -> str | None:
    """Say why no body has these principal moments, in kg·m²; None if one can have."""
    negligible = 1e-12 * max(moments)
    low, middle, high = (0.0 if fabs(m) < negligible else m for m in sorted(moments))
    if low <= 0:
        if high == 0 and low == 0:
            return "all its entries are 0"
        numbers = _all_shown(low, middle, high)
        return f"its eigenvalues are {numbers}, and all three must be greater than 0"
    if low + middle < high * (1 - TRIANGLE_TOLERANCE):
        return (
            f"of its eigenvalues {_all_shown(low, middle, high)} the sum of the two smaller ones "
            "must not be less than the largest (the triangle inequality)"
        )
    return None


def _all_shown(low: float, middle: float, high: float) -> str:
    return f"{shown(low)}, {shown(middle)} and {shown(high)}"


# --- shapes -----------------------------------------------------------------------------------


def check_section(
    section: Element, children: Children, link: Element, context: CheckContext
) -> None:
    """Check the pose and the shape of a visual or collision."""
    context.stage = LINKS
    check_pose(children.get("origin"), link, context)
    geometry = children.get("geometry")
    if geometry is None:
        return
    if len(geometry.children) == 1:
        only = geometry.children[0]
        if isinstance(only, Element) and only.name in PLAIN_SHAPES:
            return
    shapes = [child for child in geometry.elements() if child.name in SHAPE_WORDS]
    where = f"a {section.name} of {label(link)}"
    if not shapes:
        if not geometry.elements():
            context.report(
                "missing-element",
                f"the geometry in {where} has no shape",
                geometry,
                hint=f"put one of {', '.join(SHAPE_WORDS)} in it",
            )
        return
    kinds = {shape.name for shape in shapes}
    if len(kinds) > 1:
        context.report(
            "several-shapes",
            f"the geometry in {where} has {len(shapes)} shapes; parsers read the first",
            shapes[1],
            hint=f"write a {section.name} for each shape",
        )
    if shapes[0].name == Mesh.kind:
        if 0.0 in context.numbers.row(shapes[0], "scale", 3):
            context.report(
                "bad-size",
                f"the scale of the mesh in {where} contains 0, which flattens it",
                shapes[0],
                attribute="scale",
                hint="write `1 1 1` for the mesh as it is, `0.001 0.001 0.001` if it is in "
                "millimetres",
                severity=WARNING,
            )
    elif (
        shapes[0].name == Capsule.kind
        and context.version < Capsule.since
        # A part with a capsule has been reported already.
        and all(known.code != CAPSULE_CODE for known in context.reporter.diagnostics)
    ):
        context.report(
            CAPSULE_CODE,
            f"the geometry in {where} is a capsule, which needs URDF 1.1",
            shapes[0],
            hint="write `version=1.1` on the robot, or use a "
            "cylinder: urdfdom ignores the shape in 1.0",
        )


# --- poses ------------------------------------------------------------------------------------


def check_pose(origin: Element | None, owner: Element, context: CheckContext) -> None:
    """Check the origin of a joint, visual, collision or inertial: one rotation, in radians."""
    if origin is None:
        return
    if "quat_xyzw" in origin.attributes and attribute_text(origin, "quat_xyzw") is not None:
        _check_quaternion(origin, owner, context)
    rpy = attribute_text(origin, "rpy")
    if rpy is not None and ("rpy", rpy) not in context.sound:
        for angle in context.numbers.row(origin, "rpy", 3):
            if fabs(angle) > tau + ANGLE_TOLERANCE:
                context.report(
                    "angle-too-large",
                    f"'rpy' in {label(owner)} contains {shown(angle)}, more than a full turn",
                    origin,
                    attribute="rpy",
                    hint=degrees_hint(angle, origin.value_span("rpy")),
                )
                return
        context.sound.add(("rpy", rpy))


def _check_quaternion(origin: Element, owner: Element, context: CheckContext) -> None:
    if attribute_text(origin, "rpy") is not None:
        context.report(
            "two-rotations",
            f"the origin in {label(owner)} has both 'rpy' and 'quat_xyzw'",
            origin,
            attribute="quat_xyzw",
            hint="keep one of them; parsers reject both",
        )
        return
    if context.version == "1.0":
        context.report(
            "needs-version",
            f"the origin in {label(owner)} has 'quat_xyzw', which URDF 1.0 ignores",
            origin,
            attribute="quat_xyzw",
            hint="write `version=1.1` on the robot, or give the rotation as rpy",
        )
        return
    numbers = context.numbers.row(origin, "quat_xyzw", 4)
    if numbers and fabs(hypot(*numbers) - 1) > ANGLE_TOLERANCE:
        context.report(
            "quaternion-not-unit",
            f"the quaternion in {label(owner)} has the length {shown(hypot(*numbers))} "
            "instead of 1",
            origin,
            attribute="quat_xyzw",
            hint="divide its four numbers by that length; 0 0 0 1 means no rotation",
        )
