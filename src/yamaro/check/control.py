"""Checks what controls a robot: `<ros2_control>`, and `<transmission>` of ros_control.

What ros2_control's parser refuses (component_parser.cpp and resource_manager.cpp of 2026), and what
ros_control's transmission_parser.cpp and the loaders of transmissions refuse, ends the program that
drives the robot, or leaves a joint without a drive.
"""

from __future__ import annotations

from ..model.joint import LIMITED
from ..model.sdf_schema import ANY, AT_LEAST_ONE, COUNT, TRUE_OR_FALSE
from ..model.values import attribute_text, child_named, content, content_span
from .context import shown
from .robot import is_fixed
from .values import (
    UniqueNames,
    check_order,
    check_required,
    check_spelling,
    check_value,
    children,
    is_near,
    named,
    report_word,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from ..model.joint import Joint
    from ..xml.tree import Element
    from .context import CheckContext
    from .robot import Tree

REFUSES = "ros2_control ends with an error"
KINDS = ("system", "actuator", "sensor")
PARTS = ("hardware", "joint", "sensor", "gpio", "transmission", "properties")
INTERFACES = ("command_interface", "state_interface")
INTERFACE_NAMES = ("position", "velocity", "effort", "acceleration", "jerk", "torque", "force")
PLUGINS = (
    *(f"{package}_components/GenericSystem" for package in ("mock", "fake")),
    *(f"gz_ros2_control/{name}" for name in ("GazeboSimSystem", "GazeboMimicSystem")),
    *("gazebo_ros2_control/GazeboSystem", "ign_ros2_control/IgnitionSystem"),
    *("mujoco_ros2_control/MujocoSystem", "topic_based_ros2_control/TopicBasedSystem"),
    *("dynamixel_hardware/DynamixelHardware", "ur_robot_driver/URPositionHardwareInterface"),
)
"""Hardware that many robots have: a name near to one of these is misspelt."""
ATTRIBUTES = {
    "ros2_control": ("name", "type", "rw_rate", "is_async", "thread_priority"),
    "joint": ("name", "mimic", "role"),
    "command_interface": ("name", "data_type", "size"),
    "state_interface": ("name", "data_type", "size"),
    "param": ("name",),
}
OF_INTERFACES = ("min", "max", "initial_value")
"""What an interface has as a `<param>`, and not as an attribute or element."""
DATA_TYPES = ("double", "bool", "float32", *(f"{u}int{n}" for u in ("", "u") for n in (8, 16, 32)))
COMPONENT_PARTS = (*INTERFACES, "param", "limits")
TRANSMISSIONS = {
    f"transmission_interface/{kind}Transmission": count
    for kind, count in (
        *(("Simple", 1), ("Differential", 2), ("FourBarLinkage", 2)),
        ("HalfDifferential", None),  # of PAL Robotics
    )
}
"""The known transmissions, and how many joints and actuators each has."""
PARTS_OF_TRANSMISSIONS = (
    *("type", "joint", "actuator", "mechanicalReduction", "leftActuator", "rightActuator"),
    *("flexJoint", "rollJoint", "gap_joint", "passive_joint", "robotNamespace"),
)
OF_TRANSMISSIONS = (
    *("hardwareInterface", "mechanicalReduction", "mechanical_reduction", "role", "offset"),
    *("compensator", "gap_joint", "passive_joint"),
)
"""What a joint or an actuator of a transmission can hold."""
HARDWARE = tuple(
    f"hardware_interface/{kind}Interface"
    for kind in (
        *("PositionJoint", "VelocityJoint", "EffortJoint", "JointState", "JointCommand"),
        *("PosVelJoint", "PosVelAccJoint", "JointMode"),
    )
)
TOLERANCE = 1e-6
"""How far beside its limits a joint may start, in m and rad."""


# --- ros2_control -------------------------------------------------------------------------------


def check_ros2_control(blocks: Iterable[Element], tree: Tree, context: CheckContext) -> None:
    """Check the `<ros2_control>` blocks; joints that do not exist are reported elsewhere."""
    names = UniqueNames("ros2_control blocks", REFUSES)
    commanded: set[str] = set()
    for block in blocks:
        context.outermost = block
        name = named(block)
        where = f"the ros2_control block '{name}'" if name else "a ros2_control block"
        check_required(block, ("name", "type"), where, REFUSES, context)
        names.add(block, context)
        kind = (attribute_text(block, "type") or "").strip()
        if kind and kind not in KINDS and "$" not in kind:
            report_word(
                kind, KINDS, f"the type of {where}", block, block.value_span("type"), context,
                result="so ros2_control loads nothing of it",
            )  # fmt: skip
        for attribute, rule in (
            ("rw_rate", COUNT),
            ("is_async", TRUE_OR_FALSE),
            ("thread_priority", AT_LEAST_ONE),
        ):
            if attribute in block.attributes:
                own = f"'{attribute}' of {where}"
                truths = ("true", "false")
                check_value(block, rule, own, context, attribute=attribute, truths=truths)
        _check_attributes(block, where, context)
        for child in block.elements():
            if child.name not in PARTS:
                hint, fix = context.near(child.name, PARTS, child.span)
                context.report(
                    "unknown-element",
                    f"'{child.name}' has no meaning in {where}; {REFUSES}",
                    child,
                    hint=hint or f"it can hold {', '.join(PARTS[:-1])}",
                    fix=fix,
                )
        _check_hardware(block, where, context)
        _check_components(block, kind, tree, commanded, context)
        declared = {named(each) for each in children(block, "joint")}
        for transmission in children(block, "transmission"):
            _check_own_transmission(transmission, declared, context)
    context.outermost = None


def _check_attributes(element: Element, where: str, context: CheckContext) -> None:
    """Report attributes that are misspelt, or that belong in a `<param>`."""
    known = ATTRIBUTES[element.name]
    for attribute in element.attributes:
        near = next((each for each in known if is_near(attribute, each)), None)
        is_param = attribute in OF_INTERFACES and "interface" in element.name
        if attribute in known or not (near or is_param):
            continue
        from ..fixes import respelling

        context.report(
            "unknown-attribute",
            f"'{attribute}' has no meaning in {where}; ros2_control ignores it",
            element,
            attribute=attribute,
            is_of_name=True,
            hint=f"did you mean '{near}'?"
            if near
            else f'write <param name="{attribute}">…</param> in it',
            fix=(near and respelling(element.name_span(attribute), attribute, near)) or None,
        )


def _check_hardware(block: Element, where: str, context: CheckContext) -> None:
    """Check that there is hardware, and that a plugin drives it."""
    found = list(children(block, "hardware"))
    if not found:
        context.report(
            "missing-element",
            f"{where} has no 'hardware', so nothing drives its joints",
            block,
            missing="hardware",
            hint="add `hardware:` with `plugin: mock_components/GenericSystem` in it",
        )
        return
    for again in found[1:]:
        context.report(
            "repeated-element",
            f"{where} has 'hardware' twice; the last counts",
            again,
            hint="remove one of them, or write a block for each",
        )
    for hardware in found:
        for child in hardware.elements():
            if child.name not in ("plugin", "param", "group"):
                hint, fix = context.near(child.name, ("plugin", "param", "group"), child.span)
                context.report(
                    "unknown-element",
                    f"'{child.name}' has no meaning in the hardware of {where}; ros2_control "
                    "ignores it",
                    child,
                    hint=hint or "it can hold plugin, group and param",
                    fix=fix,
                )
        for again in list(children(hardware, "plugin"))[1:]:
            context.report(
                "repeated-element",
                f"the hardware of {where} has 'plugin' twice; the first counts",
                again,
                hint="remove one of them, or write a block for each",
            )
        _check_plugin(hardware, f"the hardware of {where}", context)
        _check_params(hardware, f"the hardware of {where}", context)


def _check_plugin(holder: Element, where: str, context: CheckContext) -> str:
    """Return the plugin of hardware or a transmission, after a report if there is none."""
    plugin = child_named(holder, "plugin")
    name = content(plugin) or ""
    if plugin is None or not name:
        state = "has no 'plugin'" if plugin is None else "has an empty 'plugin'"
        context.report(
            "missing-element",
            f"{where} {state}; {REFUSES}",
            plugin or holder,
            missing="plugin",
            hint=f"write its class as text: <plugin>{named(plugin)}</plugin>"
            if plugin is not None and "/" in named(plugin)
            else "add `plugin: mock_components/GenericSystem`, or that of the hardware"
            if holder.name == "hardware"
            else "add `plugin: transmission_interface/SimpleTransmission`",
        )
    elif name.endswith((".so", ".dll", ".dylib")) or any(map(str.isspace, name)):
        context.report(
            "bad-value",
            f"the plugin of {where} is '{name}', which is not the name of a class",
            plugin,
            span=content_span(plugin),
            hint="write the name that the package exports, as in mock_components/GenericSystem",
        )
    elif holder.name == "hardware" and name not in PLUGINS:
        own = name.replace("::", "/")
        meant = [n for n in PLUGINS if n.endswith(f"/{own}") or n == own or is_near(own, n)]
        if meant:
            from ..fixes import respelling

            context.report(
                "unknown-type",
                f"the plugin of {where} is '{name}', which no package exports",
                plugin,
                span=content_span(plugin),
                hint=f"did you mean '{meant[0]}'?",
                fix=respelling(content_span(plugin), name, meant[0]),
            )
    return name


def _check_params(holder: Element, where: str, context: CheckContext) -> dict[str, Element]:
    """Return the parameters by name, after a report of those without one or with one that was."""
    found: dict[str, Element] = {}
    for param in children(holder, "param"):
        check_required(param, ("name",), f"a param of {where}", REFUSES, context)
        name = named(param)
        if name in found:
            context.report(
                "repeated-element",
                f"the param '{name}' of {where} is given twice; the last counts",
                param,
                attribute="name",
                hint="remove one of them",
            )
        if name:
            found[name] = param
    return found


def _check_components(
    block: Element, kind: str, tree: Tree, commanded: set[str], context: CheckContext
) -> None:
    """Check the joints, sensors and GPIOs of a block."""
    by_kind = {
        part: UniqueNames(f"{part}s in this block", REFUSES) for part in ("joint", "sensor", "gpio")
    }
    own_joints = {named(each) for each in children(block, "joint")}
    seen: set[str] = set()
    for part in block.elements():
        names = by_kind.get(part.name)
        if names is None:
            continue
        name = named(part)
        where = f"the {part.name} '{name}'" if name else f"a {part.name}"
        check_required(part, ("name",), f"{where} in ros2_control", REFUSES, context)
        names.add(part, context)
        is_again = f"{part.name} {name}" in seen
        seen.add(f"{part.name} {name}")
        is_unknown = part.name == "joint" and name not in tree.joints  # reported as such
        _check_component(part, where, kind, context, may_be_empty=is_unknown)
        if part.name != "gpio":
            _check_limits_switch(part, where, context)
        joint = tree.joints.get(name) if part.name == "joint" else None
        if joint is not None:
            _check_joint(part, joint, own_joints, tree, context)
        if is_again:
            continue  # the name alone is reported
        commands = set()
        for interface in children(part, "command_interface"):
            command = f"{name}/{named(interface)}"
            if name and named(interface) and command in commanded:
                context.report(
                    "repeated-name",
                    f"two ros2_control blocks command '{command}'; {REFUSES}",
                    interface,
                    attribute="name",
                    hint="command it in one of them",
                )
            commands.add(command)
        commanded |= commands


def _check_component(
    part: Element, where: str, kind: str, context: CheckContext, *, may_be_empty: bool
) -> None:
    params = _check_params(part, where, context)
    if "mimic" in params:  # which ROS 2 before Jazzy reads
        for key in ("multiplier", "offset"):
            if key in params:
                check_value(params[key], ANY, f"'{key}' of {where}", context)
    if part.name == "joint":
        _check_attributes(part, where, context)
    names = {
        interface: UniqueNames(f"{interface}s of {where}", REFUSES) for interface in INTERFACES
    }
    count = 0
    for child in part.elements():
        own = names.get(child.name)
        if own is None:
            count += check_spelling(child, COMPONENT_PARTS, f"of {where}", "ros2_control", context)
            continue
        count += 1
        own.add(child, context)
        _check_interface(child, part, where, context)
        if child.name == "command_interface" and "sensor" in (kind, part.name):
            is_block = kind == "sensor"
            place = " in a block for a sensor" if is_block else ", but cannot be commanded"
            context.report(
                "unknown-element",
                f"{where} has a command interface{place}; ros2_control ignores it",
                child,
                hint="write `type=system` on the block, or remove it"
                if is_block
                else "write a gpio in place of the sensor, or a state_interface",
            )
    if not count and not may_be_empty and (part.name != "joint" or not params):
        context.report(
            "missing-element",
            f"{where} has no interface in ros2_control, so nothing can command or read it",
            part,
            missing="state_interface",
            hint="add `state_interface/name=position:`",
        )


def _check_interface(interface: Element, part: Element, where: str, context: CheckContext) -> None:
    """Check the name and the parameters of an interface."""
    own = f"a {interface.name} of {where}"
    check_required(interface, ("name",), own, REFUSES, context)
    name = named(interface)
    near = next((known for known in INTERFACE_NAMES if is_near(name, known)), None)
    if part.name == "joint" and name and name not in INTERFACE_NAMES and near is not None:
        report_word(
            name, INTERFACE_NAMES, f"the name of {own}", interface, interface.value_span("name"),
            context, result="which no controller asks for",
        )  # fmt: skip
    own = f"the {interface.name} '{name}' of {where}" if name else own
    params = _check_params(interface, own, context)
    _check_attributes(interface, own, context)
    for child in interface.elements():
        if child.name not in ("param", "limits"):
            is_param = child.name in OF_INTERFACES
            context.report(
                "unknown-element",
                f"'{child.name}' has no meaning in {own}; ros2_control ignores it",
                child,
                hint=f'write <param name="{child.name}">…</param>'
                if is_param
                else "it can hold param and limits",
            )
    _check_limits_switch(interface, own, context)
    kind = (attribute_text(interface, "data_type") or "").strip()
    if kind not in DATA_TYPES and any(is_near(kind, each) for each in DATA_TYPES):
        report_word(
            kind, DATA_TYPES, f"'data_type' of {own}", interface,
            interface.value_span("data_type"), context, result="which ros2_control does not know",
        )  # fmt: skip
    if "size" in interface.attributes:
        check_value(interface, AT_LEAST_ONE, f"'size' of {own}", context, attribute="size")
    if (attribute_text(interface, "data_type") or "double") == "double":
        found: dict[str, tuple[Element, str, float]] = {}
        for key in ("min", "max", "initial_value"):
            param = params.get(key)
            if param is None or (key != "initial_value" and not content(param)):
                continue
            row = check_value(param, ANY, f"'{key}' of {own}", context)
            if row:
                found[key] = (param, f"'{key}' of {own}", row[0])
        if "min" in found and "max" in found:
            check_order(found["min"], found["max"][2], "max", context)


def _check_limits_switch(holder: Element, where: str, context: CheckContext) -> None:
    for limits in children(holder, "limits"):
        if check_required(limits, ("enable",), f"the limits of {where}", REFUSES, context):
            own = f"'enable' of {where}"
            truths = ("true", "false")
            check_value(limits, TRUE_OR_FALSE, own, context, attribute="enable", truths=truths)


def _check_joint(
    part: Element, joint: Joint, own_joints: set[str], tree: Tree, context: CheckContext
) -> None:
    """Check what ros2_control does with a joint against what the robot says of it."""
    if is_fixed(joint):
        _report_fixed(part, joint, "ros2_control rejects it", context)
        return
    commands = list(children(part, "command_interface"))
    switch = (attribute_text(part, "mimic") or "").strip().lower()
    if switch:
        own = f"'mimic' of the joint '{joint.name}'"
        truths = ("true", "false")
        check_value(part, TRUE_OR_FALSE, own, context, attribute="mimic", truths=truths)
    if switch == "true" and joint.mimic is None:
        context.report(
            "bad-value",
            f"joint '{joint.name}' has `mimic` in ros2_control, but mimics no joint of the "
            f"robot; {REFUSES}",
            part,
            attribute="mimic",
            hint="add a `mimic` to the joint of the robot, or remove this",
        )
    if joint.mimic is not None and switch != "false":
        if commands:
            context.report(
                "mimic-command",
                f"joint '{joint.name}' mimics '{joint.mimic.joint}', so it cannot be commanded; "
                f"{REFUSES}",
                commands[0],
                hint="remove its command interfaces, or write `mimic=false` on the joint here",
            )
        elif joint.mimic.joint in tree.joints and joint.mimic.joint not in own_joints:
            context.report(
                "unknown-joint",
                f"joint '{joint.name}' mimics '{joint.mimic.joint}', which is not in this block; "
                f"{REFUSES}",
                part,
                attribute="name",
                hint=f"add the joint '{joint.mimic.joint}' to the block",
            )
    limit = joint.limit
    if limit is None or joint.type not in LIMITED:
        return
    lower, upper = limit.number("lower") or 0.0, limit.number("upper") or 0.0
    for interface in children(part, "state_interface"):
        if named(interface) != "position":
            continue
        for param in children(interface, "param"):
            start = _number(content(param)) if named(param) == "initial_value" else None
            if start is None or lower - TOLERANCE <= start <= upper + TOLERANCE or lower > upper:
                continue
            context.report(
                "out-of-range",
                f"joint '{joint.name}' starts at {shown(start)}, outside of its limits "
                f"{shown(lower)} to {shown(upper)}",
                param,
                span=content_span(param),
                hint="start between 'lower' and 'upper'",
            )


def _number(text: str | None) -> float | None:
    try:
        return float(text or "")
    except ValueError:
        return None


def _report_fixed(part: Element, joint: Joint, result: str, context: CheckContext) -> None:
    context.report(
        "fixed-joint",
        f"joint '{joint.name}' is fixed, so it cannot be driven; {result}",
        part,
        attribute="name",
        hint="remove it here, or use a type that moves",
    )


def _check_own_transmission(
    transmission: Element, declared: set[str], context: CheckContext
) -> None:
    """Check a transmission in a `<ros2_control>` block."""
    name = named(transmission)
    where = f"the transmission '{name}'" if name else "a transmission"
    check_required(transmission, ("name",), where, REFUSES, context)
    kind = _check_plugin(transmission, where, context)
    _check_kind(kind, child_named(transmission, "plugin"), where, context)
    joints, actuators = (list(children(transmission, each)) for each in ("joint", "actuator"))
    for part in (*joints, *actuators):
        own = f"the {part.name} '{named(part)}' of {where}"
        check_required(part, ("name", "role"), own, REFUSES, context)
        if part.name == "joint" and named(part) and named(part) not in declared:
            hint, fix = context.near(named(part), declared, part.value_span("name"))
            context.report(
                "unknown-joint",
                f"{own} is not among the joints of its ros2_control block; {REFUSES}",
                part,
                attribute="name",
                hint=hint or "add the joint to the block",
                fix=fix,
            )
        _check_reductions(part, ("mechanical_reduction",), own, context)
        _check_offset(part, own, context)
        wrong = child_named(part, "mechanicalReduction")
        if wrong is not None and _number(content(wrong)) != 1:
            from ..fixes import respelling

            context.report(
                "unknown-element",
                f"'mechanicalReduction' of {own} has no meaning; ros2_control takes 1",
                wrong,
                hint="did you mean 'mechanical_reduction'?",
                fix=respelling(wrong.span, wrong.name, "mechanical_reduction"),
            )
    _check_counts(transmission, kind, joints, actuators, where, context)
    if TRANSMISSIONS.get(kind) == 2:
        given = ((attribute_text(each, "role"), each) for each in (*joints, *actuators))
        _check_roles([each for each in given if each[0]], where, context)


# --- transmissions ------------------------------------------------------------------------------


def check_transmissions(
    transmissions: Iterable[Element], tree: Tree, context: CheckContext
) -> None:
    """Check the transmissions of ros_control; joints that do not exist are reported elsewhere."""
    skips = "ros_control skips it"
    names: dict[tuple[str, ...], UniqueNames] = {}
    for transmission in transmissions:
        context.outermost = transmission
        name = named(transmission)
        where = f"the transmission '{name}'" if name else "a transmission"
        check_required(transmission, ("name",), where, skips, context)
        joints = list(children(transmission, "joint"))
        kind = child_named(transmission, "type")
        text = content(kind) or ""
        is_old = kind is None and attribute_text(transmission, "type")
        own_names = UniqueNames("transmissions", "ros_control keeps one of them")
        names.setdefault((text, *_interfaces(joints)), own_names).add(transmission, context)
        for joint in joints if text in TRANSMISSIONS else ():
            found = tree.joints.get(named(joint))
            if found is not None and is_fixed(found):
                _report_fixed(joint, found, "ros_control finds no such joint", context)
        _check_reductions(transmission, ("mechanicalReduction",), where, context)
        actuators = list(children(transmission, "actuator"))
        misspelt = [
            child
            for child in transmission.elements()
            if check_spelling(child, PARTS_OF_TRANSMISSIONS, f"of {where}", "ros_control", context)
        ]
        for part in (*joints, *actuators):
            own = f"the {part.name} '{named(part)}' of {where}"
            check_required(part, ("name",), own, skips, context)
            for child in part.elements():
                check_spelling(child, OF_TRANSMISSIONS, f"of {own}", "ros_control", context)
            _check_reductions(part, ("mechanicalReduction", "mechanical_reduction"), own, context)
            _check_offset(part, own, context)
        if is_old:
            continue
        if not text and not misspelt:
            context.report(
                "missing-element",
                f"{where} has {'no' if kind is None else 'an empty'} 'type'; {skips}",
                kind or transmission,
                missing="type",
                hint="add `type: transmission_interface/SimpleTransmission`",
            )
        _check_kind(text, kind, where, context)
        for joint in joints:
            _check_hardware_interfaces(joint, where, skips, context)
        if not misspelt:
            _check_counts(transmission, text, joints, actuators, where, context)
        if TRANSMISSIONS.get(text) == 2:
            parts = (*joints, *actuators)
            _check_roles([(content(child_named(p, "role")), p) for p in parts], where, context)
    context.outermost = None


def _interfaces(joints: Iterable[Element]) -> list[str]:
    """Return the interfaces of a transmission: for each of them it is another one."""
    found = (content(each) for joint in joints for each in children(joint, "hardwareInterface"))
    return sorted({each for each in found if each})


def _check_kind(text: str, element: Element | None, where: str, context: CheckContext) -> None:
    """Report a type of transmission that looks like one that is known."""
    if element is None or not text or text in TRANSMISSIONS or "$" in text:
        return
    full = f"transmission_interface/{text}"
    known = [each.removeprefix("transmission_interface/") for each in TRANSMISSIONS]
    if (
        text.startswith("transmission_interface/")
        or full in TRANSMISSIONS
        or any(is_near(text, each) for each in known)
    ):
        report_word(
            text, TRANSMISSIONS, f"the type of {where}", element, content_span(element), context,
            result="which is not a known transmission",
        )  # fmt: skip


def _check_reductions(
    part: Element, elements: Iterable[str], where: str, context: CheckContext
) -> None:
    """Report a reduction that is not a number, or zero, by which is divided."""
    for name in elements:
        for reduction in children(part, name):
            row = check_value(reduction, ANY, f"'{name}' of {where}", context)
            if row == (0.0,):
                context.report(
                    "out-of-range",
                    f"'{name}' of {where} is 0, by which is divided; it is not loaded",
                    reduction,
                    span=content_span(reduction),
                    hint="write 1 if there is no gear",
                )


def _check_offset(part: Element, where: str, context: CheckContext) -> None:
    for offset in children(part, "offset"):
        check_value(offset, ANY, f"'offset' of {where}", context)


def _check_hardware_interfaces(
    joint: Element, where: str, skips: str, context: CheckContext
) -> None:
    """Check that a joint of a transmission says through which interfaces it is driven."""
    own = f"the joint '{named(joint)}' of {where}"
    interfaces = [each for each in children(joint, "hardwareInterface") if content(each)]
    if not interfaces and not any(is_near(e.name, "hardwareInterface") for e in joint.elements()):
        context.report(
            "missing-element",
            f"{own} has no 'hardwareInterface'; {skips}",
            joint,
            missing="hardwareInterface",
            hint="add `hardwareInterface: hardware_interface/PositionJointInterface`",
        )
    known = {each: each for each in HARDWARE}
    known |= {each.removeprefix("hardware_interface/"): each for each in HARDWARE}
    for interface in interfaces:
        text = content(interface) or ""
        if text not in known and (
            text.startswith("hardware_interface/") or any(is_near(text, each) for each in known)
        ):
            report_word(
                text, known, f"the hardwareInterface of {own}", interface,
                content_span(interface), context, result="which ros_control does not know",
            )  # fmt: skip


def _check_counts(
    transmission: Element,
    kind: str,
    joints: Sequence[Element],
    actuators: Sequence[Element],
    where: str,
    context: CheckContext,
) -> None:
    """Report a transmission that has not the joints and actuators of its type."""
    count = TRANSMISSIONS.get(kind)
    for word, found in (("joint", joints), ("actuator", actuators)):
        names = UniqueNames(f"{word}s of {where}", "it is not loaded")
        for part in found:
            names.add(part, context)
        if not found:
            context.report(
                "missing-element",
                f"{where} has no '{word}', so it is not loaded",
                transmission,
                missing=word,
                hint=f"add `{word}/name=…:`",
            )
        elif count is not None and len(found) != count:
            context.report(
                "wrong-count",
                f"{where} has {len(found)} {word}{'s' if len(found) > 1 else ''}, but its type "
                f"has {count}",
                found[-1],
                attribute="name",
                hint="write a transmission for each joint" if count == 1 else "add the other",
            )


def _check_roles(
    roles: Iterable[tuple[str | None, Element]], where: str, context: CheckContext
) -> None:
    """Report roles in a transmission that are left out, unknown or given twice."""
    seen: set[str] = set()
    for role, part in roles:
        if role is None:
            context.report(
                "missing-element",
                f"the {part.name} '{named(part)}' of {where} has no 'role'; it is not loaded",
                part,
                missing="role",
                hint=f"add the role {part.name}1 or {part.name}2",
            )
        elif role in seen or not role.startswith(part.name):
            what = "which another has" if role in seen else f"which is not a role of {part.name}s"
            context.report(
                "bad-value",
                f"the role of the {part.name} '{named(part)}' of {where} is '{role}', {what}",
                part,
                missing="role",
                hint=f"the roles are {part.name}1 and {part.name}2",
            )
        seen.add(role or "")
