"""Checks what simulators read besides links and joints: `<gazebo>` and `<sensor>`.

What libsdformat refuses, ignores or reads in another way than it is written. What a plugin holds is
its own, apart from the elements in which the plugins that come with Gazebo name a link or joint.
"""

from __future__ import annotations

from ..model.sdf_schema import (
    ANY,
    AT_LEAST_ONE,
    CONTENTS,
    LENIENT,
    LIDARS,
    MATERIALS,
    NOT_NEGATIVE,
    OF_JOINTS,
    OF_LINKS,
    OF_MODELS,
    PLUGIN_JOINTS,
    PLUGIN_LINKS,
    POSITIVE,
    RANGES,
    SENSOR,
    SENSOR_TYPES,
    THREE,
    TRUTH,
    Value,
)
from ..model.values import attribute_text, child_named, content, content_span, inside
from .robot import is_fixed, near_name
from .values import (
    LENIENT_TRUTHS,
    TRUTHS,
    UniqueNames,
    check_order,
    check_required,
    check_spelling,
    check_value,
    children,
    is_near,
    named,
    numbers,
    report_word,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..model.sdf_schema import Table
    from ..xml.tree import Element
    from .context import CheckContext
    from .robot import Tree

READER = "libsdformat"
REFUSES = f"{READER} rejects the robot"
PRESERVED = ("preserveFixedJoint", "disableFixedJointLumping")
OFTEN = ("sensor", "plugin", "visual", "collision", "light", "material")
"""What may be several times in a block."""


def check_gazebo(blocks: Iterable[Element], tree: Tree, context: CheckContext) -> None:
    """Check the `<gazebo>` blocks of a robot; what they refer to is checked elsewhere."""
    blocks = list(blocks)
    kept = {  # fixed joints that libsdformat keeps
        (attribute_text(block, "reference") or "").strip()
        for block in blocks
        for child in block.elements()
        if child.name in PRESERVED and (content(child) or "").lower() in ("true", "yes", "1")
    }
    sensors: dict[str, UniqueNames] = {}
    for block in blocks:
        context.outermost = block
        misspelt = next((each for each in block.attributes if is_near(each, "reference")), None)
        if misspelt is not None:
            from ..fixes import respelling

            context.report(
                "unknown-attribute",
                f"'{misspelt}' of a block for Gazebo has no meaning",
                block,
                attribute=misspelt,
                is_of_name=True,
                hint="did you mean 'reference'?",
                fix=respelling(block.name_span(misspelt), misspelt, "reference"),
            )
            continue
        reference = (attribute_text(block, "reference") or "").strip()
        if reference and reference not in tree.links and reference not in tree.joints:
            continue  # reported as such
        where = f"for '{reference}'" if reference else "for the robot as a whole"
        table = _table_for(reference, tree)
        seen: set[str] = set()
        for child in block.elements():
            _check_entry(child, table, seen, where, context)
            if child.name == "sensor":
                names = sensors.setdefault(
                    reference, UniqueNames(f"sensors for '{reference}'", REFUSES)
                )
                names.add(child, context)
                _check_sensor(child, reference, tree, context)
            elif child.name == "plugin":
                _check_plugin(child, tree, context)
        if reference in tree.joints and reference not in tree.links and reference not in kept:
            said = [child for child in block.elements() if child.name not in PRESERVED]
            if is_fixed(tree.joints[reference]) and said:
                context.report(
                    "fixed-joint",
                    f"joint '{reference}' is fixed: Gazebo merges its two links, so that this "
                    "block has no effect",
                    block,
                    attribute="reference",
                    hint="add `preserveFixedJoint: true` to the block, or refer to a link",
                )
    context.outermost = None


def _table_for(reference: str, tree: Tree) -> Table:
    if not reference:
        return OF_MODELS
    table: Table = {}
    if reference in tree.links:
        table |= OF_LINKS
    if reference in tree.joints:
        table |= OF_JOINTS
    return table


def _check_entry(
    child: Element, table: Table, seen: set[str], where: str, context: CheckContext
) -> None:
    """Check an element directly in a block."""
    name = child.name
    rule = table.get(name)
    if rule is None:
        _check_unknown(child, table, where, context)
        return
    if name not in OFTEN and name in seen:
        context.report(
            "repeated-element",
            f"'{name}' {where} is given twice in this block; the last counts",
            child,
            hint="remove one of them",
        )
    seen.add(name)
    if name == "material":
        word = content(child) or ""
        own = word.removeprefix("Gazebo/")
        if own != word and own not in MATERIALS and "$" not in own:
            report_word(
                word,
                [f"Gazebo/{each}" for each in MATERIALS],
                f"the material {where}",
                child,
                content_span(child),
                context,
                result="which does not come with Gazebo",
            )
    elif name == "sensor":
        pass
    elif isinstance(rule, Value):
        truths = LENIENT_TRUTHS if name in LENIENT else TRUTHS
        check_value(child, rule, f"'{name}' {where}", context, truths=truths)
    else:
        check_table(child, rule, f"the {name} {where}", context)


def _check_unknown(child: Element, table: Table, where: str, context: CheckContext) -> None:
    """Report an element that has no meaning in this block but another, or is misspelt."""
    known = [*OF_LINKS, *OF_JOINTS, *OF_MODELS]
    if child.name in known and ":" not in child.name:
        holder = "a link" if child.name in OF_LINKS else "a joint"
        if child.name in OF_MODELS:
            holder = "the robot as a whole"
        if table is OF_MODELS or child.name in OF_LINKS:
            context.report(
                "unknown-element",
                f"'{child.name}' has no meaning {where}; libsdformat ignores it",
                child,
                hint="for the whole robot it is `self_collide`"
                if child.name == "selfCollide" and table is OF_MODELS
                else f"it belongs in a block for {holder}",
            )
        return
    check_spelling(child, known, where, READER, context)


def check_table(element: Element, table: Table, where: str, context: CheckContext) -> None:
    """Check what is in an element by the table of what it may hold; no deeper than the table."""
    for name, rule in table.items():
        if name.startswith("@") and isinstance(rule, Value) and name[1:] in element.attributes:
            check_value(element, rule, f"'{name[1:]}' of {where}", context, attribute=name[1:])
    found: dict[str, tuple[Element, str, float]] = {}
    for child in element.elements():
        inner = table.get(child.name)
        if inner is None:
            known = [each for each in table if not each.startswith("@")]
            check_spelling(child, known, f"in {where}", READER, context)
        elif isinstance(inner, Value):
            rule = inner
            own = f"'{child.name}' of {where}"
            if rule.kind == TRUTH and not content(child):
                continue  # an empty one takes its default
            row = check_value(child, rule, own, context)
            if len(row) == 1:
                found[child.name] = (child, own, row[0])
        else:
            check_table(child, inner, where, context)
    for lower, upper in RANGES:
        if lower in found and upper in found:
            check_order(found[lower], found[upper][2], upper, context)


# --- sensors and plugins ------------------------------------------------------------------------


def _check_sensor(sensor: Element, reference: str, tree: Tree, context: CheckContext) -> None:
    name = named(sensor)
    where = f"the sensor '{name}'" if name else "a sensor"
    check_required(sensor, ("name", "type"), where, REFUSES, context)
    kind = (attribute_text(sensor, "type") or "").strip()
    if kind and kind not in SENSOR_TYPES and "$" not in kind:
        report_word(
            kind,
            SENSOR_TYPES,
            f"the type of {where}",
            sensor,
            sensor.value_span("type"),
            context,
            result="which is not a type of sensor in SDFormat",
        )
    check_table(sensor, SENSOR, where, context)
    _check_contents(sensor, kind, where, context)
    for camera in children(sensor, "camera"):
        if kind == "multicamera":
            check_required(camera, ("name",), f"a camera of {where}", REFUSES, context)
    for plugin in children(sensor, "plugin"):
        _check_plugin(plugin, tree, context)
    if (
        reference in tree.joints
        and reference not in tree.links
        and kind not in ("", "force_torque")
    ):
        context.report(
            "unknown-reference",
            f"{where} is on '{reference}', which is a joint",
            sensor,
            hint="only force_torque sensors are on joints; refer to a link",
        )
    elif kind == "force_torque" and reference in tree.links and reference not in tree.joints:
        context.report(
            "unknown-reference",
            f"{where} is on '{reference}', which is a link, so it measures nothing",
            sensor,
            hint="a force_torque sensor is on a joint; refer to the joint",
        )


def _check_contents(sensor: Element, kind: str, where: str, context: CheckContext) -> None:
    """Report what a sensor measures nothing without, and what is for another type of sensor."""
    for child in sensor.elements():
        kinds = CONTENTS.get(child.name, ())
        if kinds and kind in SENSOR_TYPES and kind not in kinds and kind != "custom":
            context.report(
                "unknown-element",
                f"'{child.name}' has no meaning in {where}, whose type is {kind}",
                child,
                hint=f"it is for sensors of the type {kinds[0]}",
            )
    missing = None
    if kind in LIDARS:
        rays = child_named(sensor, "lidar") or child_named(sensor, "ray")
        if rays is None:
            missing = kind.removeprefix("gpu_")
        else:
            missing = next((n for n in ("scan", "range") if inside(rays, n) is None), None)
    elif kind == "contact" and not content(inside(sensor, "contact", "collision")):
        missing = "contact/collision"
    if missing is not None:
        context.report(
            "missing-element",
            f"{where} has no '{missing}', so it measures nothing",
            sensor,
            missing=missing,
            hint=f"add `{missing}`",
        )


def _check_plugin(plugin: Element, tree: Tree, context: CheckContext) -> None:
    """Check the attributes of a plugin, and the links and joints that it names."""
    name = named(plugin)
    where = f"the plugin '{name}'" if name else "a plugin"
    check_required(plugin, ("name", "filename"), where, REFUSES, context)
    for child in plugin.elements():
        if child.name in PLUGIN_JOINTS:
            kind, known, ending, code = "joint", tree.joints.keys(), "_joint", "unknown-joint"
        elif child.name in PLUGIN_LINKS:
            kind, known, ending, code = "link", tree.links.keys(), "_link", "unknown-reference"
        else:
            continue
        for word in (content(child) or "").replace(",", " ").split():
            own = word.rsplit("::", 1)[-1]
            if own in known or own == "world" or "$" in own:
                continue
            span = content_span(child)
            hint, fix = near_name(span, own, tree, ending, context)
            context.report(
                code,
                f"'{child.name}' of {where} names '{own}', which is not a {kind} of the robot",
                child,
                span=span,
                missing=own,
                hint=hint or f"refer to an existing {kind}",
                fix=fix,
            )


# --- the sensors of URDF ------------------------------------------------------------------------


def check_sensors(sensors: Iterable[Element], context: CheckContext) -> None:
    """Check the `<sensor>` elements in a robot, as the proposal of URDF for them has it."""
    names = UniqueNames("sensors", "readers keep one of them")
    for sensor in sensors:
        context.outermost = sensor
        name = named(sensor)
        where = f"the sensor '{name}'" if name else "a sensor"
        check_required(sensor, ("name",), where, "no reader can refer to it", context)
        names.add(sensor, context)
        if "update_rate" in sensor.attributes:
            own = f"'update_rate' of {where}"
            check_value(sensor, NOT_NEGATIVE, own, context, attribute="update_rate")
        parent = child_named(sensor, "parent")
        if parent is None:
            context.report(
                "missing-element",
                f"{where} has no 'parent', so it is nowhere",
                sensor,
                missing="parent",
                hint="add `parent/link=…:` with the link that it is on",
            )
        else:
            check_required(parent, ("link",), f"the parent of {where}", "it is nowhere", context)
        origin = child_named(sensor, "origin")
        for attribute in ("xyz", "rpy"):
            if origin is not None and attribute in origin.attributes:
                own = f"'{attribute}' of {where}"
                check_value(origin, THREE, own, context, attribute=attribute)
        _check_image(inside(sensor, "camera", "image"), where, context)
        for direction in ("horizontal", "vertical"):
            _check_ray(inside(sensor, "ray", direction), where, context)
    context.outermost = None


def _check_image(image: Element | None, where: str, context: CheckContext) -> None:
    if image is None:
        return
    check_required(image, ("width", "height"), f"the image of {where}", "it has no size", context)
    rules = {
        **dict.fromkeys(("width", "height"), AT_LEAST_ONE),
        **dict.fromkeys(("hfov", "far"), POSITIVE),
        "near": NOT_NEGATIVE,
    }
    _check_attributes(image, rules, ("near", "far"), where, context)


def _check_ray(ray: Element | None, where: str, context: CheckContext) -> None:
    if ray is None:
        return
    rules = {
        "samples": AT_LEAST_ONE,
        "resolution": POSITIVE,
        **dict.fromkeys(("min_angle", "max_angle"), ANY),
    }
    _check_attributes(ray, rules, ("min_angle", "max_angle"), where, context)


def _check_attributes(
    element: Element,
    rules: dict[str, Value],
    ends: tuple[str, str],
    where: str,
    context: CheckContext,
) -> None:
    """Check the attributes of an element, and that the first of two ends is not the greater."""
    for attribute, rule in rules.items():
        text = attribute_text(element, attribute)
        if text is not None and text.strip():
            check_value(element, rule, f"'{attribute}' of {where}", context, attribute=attribute)
    lower, upper = (numbers(attribute_text(element, end) or "") for end in ends)
    if lower and upper and lower[0] > upper[0]:
        context.report(
            "limit-order",
            f"'{ends[0]}' ({lower[0]:.6g}) of {where} is greater than '{ends[1]}' ({upper[0]:.6g})",
            element,
            attribute=ends[0],
            hint="swap the two",
        )
