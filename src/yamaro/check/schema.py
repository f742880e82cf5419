"""Check of each element against the URDF table: what is missing, unknown, repeated or malformed.

It is the one walk over all elements, and calls the checks of what their values mean.
"""

from __future__ import annotations

from ..diagnostics import ERROR, WARNING
from ..model.schema import (
    ANY,
    ELEMENTS,
    OF_1_2,
    ONCE,
    OPTIONAL_SINCE_1_2,
    OUTERMOST,
    POSITIVE,
    TEXT,
    Field,
    Thing,
)
from ..model.shapes import SHAPE_WORDS
from ..model.values import NOT_FINITE, SPACING, NumberFault
from ..xml.tree import Element, Memo
from ..xml.values import LONGEST_ROW_REMEMBERED, format_value, remember
from .context import JOINTS, SCHEMA, CheckContext, label, shown
from .joint import check_joint
from .link import check_inertial, check_pose, check_section

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from ..fixes import Fix
    from .context import Children

    ValueCheck = Callable[[Element, Children, Element, CheckContext], None]
    """Takes an element, its first child of each name, the link or joint it is in, the context."""


def _check_used_material(
    material: Element, children: Children, owner: Element, context: CheckContext
) -> None:
    from .material import check_used_material

    check_used_material(material, children, owner, context)


def _note_file(element: Element, children: Children, owner: Element, context: CheckContext) -> None:
    """Note a link or material with a mesh or texture in it, for `check_files` to look at.

    Of an element that is in several places one owner is enough: a file is reported once.
    """
    owners = context.file_owners
    if not owners or owners[-1] is not owner:
        owners.append(owner)


VALUE_CHECKS: dict[str, ValueCheck] = {
    "inertial": check_inertial,
    "visual": check_section,
    "collision": check_section,
    "joint": check_joint,
    "material": _check_used_material,
    "mesh": _note_file,
    "texture": _note_file,
}
"""What looks at the values of an element, by its name."""
LEAVES = frozenset(
    name
    for name, rule in ELEMENTS.items()
    if not rule.required_children and name not in VALUE_CHECKS
)
"""Elements of which, when they are empty, the attributes are all there is to check."""

REMEDIES = {
    "inertia": "add `inertia/ixx=0.01, ixy=0, ixz=0, iyy=0.01, iyz=0, izz=0.01:`; "
    "a part computes it from the mass and the shape",
    "mass": "add `mass/value=1.0:` in kilograms",
    "geometry": "add `geometry:` with `box/size=0.4 0.3 0.2:` or another shape in it",
    "parent": "add `parent/link=base:`",
    "child": "add `child/link=arm:`",
}
FORGIVEN = ("axis", "color", "inertial")
"""Elements that may lack something: at most one of urdfdom, pinocchio and MuJoCo rejects them."""
GAZEBO_ONLY = frozenset(
    ("gravity", "implicitSpringDamper", "kd", "kinematic", "kp", "mu", "mu1", "mu2")
) | {"provideFeedback", "selfCollide", "self_collide", "surface", "turnGravityOff"}
REPEATED_INERTIA = {"iyx": "ixy", "izx": "ixz", "izy": "iyz"}


def check_elements(root: Element, context: CheckContext) -> None:
    """Check every element that URDF defines; what others define is left alone."""
    _check_attributes(root, ELEMENTS["robot"], root, context)
    for child in root.children:
        if not isinstance(child, Element):
            continue
        context.outermost = child
        if child.name in ("link", "joint", "material"):
            if child.memo is not None:
                _check_alike(child, child.memo, child, context)
            else:
                _check_element(child, ELEMENTS[child.name], child, context)
            continue
        context.has_extensions = True
        if child.name not in OUTERMOST:
            from .outermost import check_outermost

            check_outermost(child, context)
    context.outermost = None


def _check_element(element: Element, rule: Thing, owner: Element, context: CheckContext) -> None:
    """Check an element and what is in it; the depth is bounded by the table."""
    _check_attributes(element, rule, owner, context)
    first: Children = {}  # of each name that may stand once
    names: set[str] = set()  # of all children, once one is unknown
    for child in element.children:
        if not isinstance(child, Element):
            continue
        name = child.name
        many = rule.children.get(name)
        if many is None:
            names = names or {each.name for each in element.elements()}
            _check_unknown_child(child, element, names, rule, owner, context)
            continue
        if many == ONCE:
            if name in first:
                _check_repeated(child, first[name], element, owner, context)
                continue
            first[name] = child
        if child.memo is not None:
            _check_alike(child, child.memo, owner, context)
        elif child.children or name not in LEAVES:
            _check_element(child, ELEMENTS[name], owner, context)
        else:
            _check_attributes(child, ELEMENTS[name], owner, context)
    for name in rule.required_children:
        if name not in first:
            context.report(
                "missing-element",
                f"{_holder(element, owner)} has no '{name}'",
                element,
                missing=name,
                hint=REMEDIES[name],
                severity=WARNING if element.name in FORGIVEN else ERROR,
            )
    check_values = VALUE_CHECKS.get(element.name)
    if check_values is not None:
        check_values(element, first, owner, context)
        context.stage = SCHEMA


def _check_alike(element: Element, memo: Memo, owner: Element, context: CheckContext) -> None:
    """Check an element that others are equal to: what they have in common once, if all is right.

    Where it is not, each of them is checked: what is found is reported with its number.
    """
    if memo.checked is not context:
        count = context.count
        _check_element(element, ELEMENTS[element.name], owner, context)
        if context.count == count:
            memo.checked = context
    elif memo.own:
        for child in element.children[: memo.own]:  # a parent, a child and an origin
            if isinstance(child, Element) and child.name == "origin":
                if child.memo is not None:
                    _check_alike(child, child.memo, owner, context)
                else:
                    _check_attributes(child, ELEMENTS["origin"], owner, context)
                context.stage = JOINTS
                check_pose(child, owner, context)
                context.stage = SCHEMA


def _severity_of(name: str, context: CheckContext) -> str:
    """Return how severe it is that an attribute's value is not what it should be.

    It is a warning if urdfdom and pinocchio do not read the attribute, so that only MuJoCo can
    reject the robot.
    """
    is_unread = (
        name == "reference_position"
        or (name == "quat_xyzw" and context.version == "1.0")
        or (name in OF_1_2 and context.version != "1.2")
    )
    return WARNING if is_unread else ERROR


# --- attributes -------------------------------------------------------------------------------


def _check_attributes(element: Element, rule: Thing, owner: Element, context: CheckContext) -> None:
    attributes, sound = element.attributes, context.sound_values
    known, is_row = rule.attributes, context.numbers.is_row
    for name, value in attributes.items():
        attribute_rule = known.get(name)
        if attribute_rule is None:
            _check_unknown_attribute(name, element, rule, owner, context)
        elif attribute_rule.count != TEXT:
            if type(value) is str:
                is_sound = value in sound.get(attribute_rule, ())
            else:
                is_sound = attribute_rule.sign == ANY and is_row(value, attribute_rule.count)
            if not is_sound:
                _check_numbers(name, attribute_rule, element, owner, context)
    for name in rule.required:
        if attributes.get(name) is None:
            _report_missing_attribute(name, element, owner, context)


def _check_numbers(
    name: str, rule: Field, element: Element, owner: Element, context: CheckContext
) -> None:
    value = element.attributes[name]
    if value is None:
        return
    found = context.numbers.of(value)
    if isinstance(found, NumberFault):
        text = format_value(value)
        where = f"'{name}' of '{element.name}' in {label(owner)}"
        if found.kind == SPACING:
            message = f"{where} has white space that urdfdom does not accept in a number"
            hint = (
                f"write `{' '.join(text.split())}`: single spaces between numbers, none at the end"
            )
        elif found.kind == NOT_FINITE:
            message = f"{where} holds '{found.item}', which is not a finite number"
            hint = "write a finite number; parsers reject NaN and infinities"
        else:
            message = f"{where} holds '{found.item}', which is not a number"
            hint = _hint_for_word(found.item, text)
        severity = _severity_of(name, context)
        context.report(
            "not-a-number", message, element, attribute=name, hint=hint, severity=severity
        )
        return
    if len(found) != rule.count:
        _report_count(len(found), format_value(value), name, rule, element, owner, context)
        return
    if rule.sign != ANY:
        for number in found:
            if number < 0 or (rule.sign == POSITIVE and number == 0):
                _report_sign(number, name, rule, element, owner, context)
                return
    if type(value) is str and len(value) <= LONGEST_ROW_REMEMBERED:
        remember(context.sound_values.setdefault(rule, {}), value, True)


def _hint_for_word(item: str, text: str) -> str:
    if "${" in text:
        return "write `$(…)` for an expression; `${…}` is xacro's"
    if "$(" in text:
        return "the expression was not evaluated: `$$(` is a literal `$(`"
    if "," in item:
        return "separate numbers by spaces, and write 1.5 for one and a half"
    return "write plain numbers such as 0.5 or 1e-3, separated by spaces"


def _report_count(
    count: int,
    text: str,
    name: str,
    rule: Field,
    element: Element,
    owner: Element,
    context: CheckContext,
) -> None:
    wanted = "1 number" if rule.count == 1 else f"{rule.count} numbers"
    found = f"{count}: '{text}'" if count else "none"
    hint = "write one number"
    if rule.count > 1:
        hint = f"write {rule.count} numbers: {rule.parts}"
    if name == "rgba" and count == 3:
        hint = f"add the opacity as the fourth number: {text} 1"
    context.report(
        "wrong-count",
        f"'{name}' of '{element.name}' in {label(owner)} needs {wanted}, but has {found}",
        element,
        attribute=name,
        hint=hint,
        severity=WARNING if element.name == "color" else _severity_of(name, context),
    )


def _report_sign(
    number: float,
    name: str,
    rule: Field,
    element: Element,
    owner: Element,
    context: CheckContext,
) -> None:
    where = f"'{name}' of '{element.name}' in {label(owner)}"
    if rule.sign == POSITIVE:
        context.report(
            "bad-size",
            f"{where} holds {shown(number)}, but a size must be greater than 0",
            element,
            attribute=name,
            hint="write the size in metres, or remove this geometry",
            severity=WARNING,
        )
        return
    # urdfdom refuses a negative acceleration, deceleration and jerk where it reads them.
    is_refused = context.version == "1.2" and name in OF_1_2
    from ..fixes import renumbering

    context.report(
        "negative-value",
        f"{where} is {shown(number)}, but cannot be negative",
        element,
        attribute=name,
        hint="write the value without a sign; it applies to both directions",
        fix=renumbering(element.value_span(name), f"{shown(-number)}"),
        severity=ERROR if is_refused else WARNING,
    )


def _report_missing_attribute(
    name: str, element: Element, owner: Element, context: CheckContext
) -> None:
    if name in OPTIONAL_SINCE_1_2 and context.version == "1.2":
        return
    if any(child.name == name for child in element.elements()):
        return  # The child is reported, with the attribute that it should be.
    text = element.text().strip()
    if text and len(ELEMENTS[element.name].required) == 1:
        hint = f"in URDF it is an attribute: `{element.name}/{name}={text}:`"
    elif element.name == "robot":
        hint = "name it: `robot: my_robot`"
    else:
        hint = (
            f"add it, as in `{element.name}/{name}={ELEMENTS[element.name].fields[name].example}:`"
        )
    subject = f"'{element.name}' in {label(owner)}"
    if element is owner:
        subject = label(owner) if name != "name" else f"a {element.name}"
    if element.name == "robot":
        subject = "the robot"
    context.report(
        "missing-attribute",
        f"{subject} has no '{name}'",
        element,
        missing=name,
        hint=hint,
        severity=WARNING if element.name in FORGIVEN else ERROR,
    )


def _check_unknown_attribute(
    name: str, element: Element, rule: Thing, owner: Element, context: CheckContext
) -> None:
    if ":" in name or name == "xmlns" or name in rule.extensions:
        return
    if element.attributes[name] is None or element.name == "robot":
        return
    if name in REPEATED_INERTIA and element.name == "inertia":
        hint = (
            f"remove it: the matrix is symmetric, and '{REPEATED_INERTIA[name]}' has the same value"
        )
        fix = None
    else:
        from ..diagnostics import meant

        absent = [known for known in rule.attributes if known not in element.attributes]
        near, fix = meant(name, absent, element.name_span(name))
        hint = near or _choices("attributes", element.name, rule.attributes)
    context.report(
        "unknown-attribute",
        f"URDF has no attribute '{name}' in {_holder(element, owner)}; parsers ignore it",
        element,
        attribute=name,
        is_of_name=True,
        hint=hint,
        fix=fix,
        alike=None if fix else f"{element.name} {name}",
    )


def _choices(kind: str, name: str, known: Collection[str]) -> str:
    if not known:
        return f"'{name}' has no {kind}; remove it"
    if len(known) == 1:
        return f"'{name}' accepts only '{next(iter(known))}'"
    return f"the {kind} of '{name}' are {', '.join(known)}"


def _holder(element: Element, owner: Element) -> str:
    """Return how to speak of an element that has something: 'inertial' of link 'arm'."""
    return label(owner) if element is owner else f"'{element.name}' of {label(owner)}"


# --- children ---------------------------------------------------------------------------------


def _check_repeated(
    child: Element, first: Element, element: Element, owner: Element, context: CheckContext
) -> None:
    context.report(
        "repeated-element",
        f"{_holder(element, owner)} has more than one '{child.name}'; parsers read the first",
        child,
        hint="keep one of them",
        notes=(f"the first is at {first.span.place()}",),
    )
    if child.name == "inertial":  # its values are reported as well
        children: Children = {}
        for inner in child.elements():
            children.setdefault(inner.name, inner)
        check_inertial(child, children, owner, context)
        context.stage = SCHEMA


def _check_unknown_child(
    child: Element,
    element: Element,
    names: set[str],
    rule: Thing,
    owner: Element,
    context: CheckContext,
) -> None:
    """Report an element that URDF does not have there; `names` are those of all beside it."""
    if ":" in child.name or child.name in rule.extensions:
        return
    if child.name == "material":
        _note_file(child, {}, owner, context)  # the files in it are looked for anyway
    if element.name == "geometry":
        message = f"'{child.name}' in {label(owner)} is not a shape that URDF has"
    else:
        message = (
            f"URDF has no element '{child.name}' in {_holder(element, owner)}; parsers ignore it"
        )
    is_needed = child.name in rule.required and element.attributes.get(child.name) is None
    if element.name == "geometry":
        is_needed = names.isdisjoint(SHAPE_WORDS)
    hint, fix = _hint_for_stray(child, element, names, rule)
    context.report(
        "unknown-element",
        message,
        child,
        hint=hint,
        fix=fix,
        alike=None if fix or is_needed else f"{element.name} {child.name}",
        severity=ERROR if is_needed else WARNING,
    )


def _hint_for_stray(
    child: Element, element: Element, present: set[str], rule: Thing
) -> tuple[str, Fix | None]:
    """Return what to write for an element that URDF does not have there, and perhaps the fix."""
    from ..diagnostics import meant

    name = child.name
    if name in rule.attributes:
        text = child.text().strip() or "…"
        return f"in URDF it is an attribute: `{element.name}/{name}={text}:`", None
    if name in GAZEBO_ONLY:
        return f"Gazebo reads '{name}' in a separate block, `gazebo/reference=my_link:`", None
    if name == "gazebo":
        return f"write it directly under the robot: `gazebo/reference=my_{element.name}:`", None
    words = [word for word, many in rule.children.items() if many != ONCE or word not in present]
    near, fix = meant(name, words, child.span)
    if near:
        return near, fix
    from .outermost import PARENTS

    if name in PARENTS:
        return f"'{name}' belongs in {PARENTS[name]}", None
    return _choices("elements", element.name, rule.children), None
