"""What ros2_control reads in a `<ros2_control>` block, as a table, and what is wrong with a URDF.

Sources, of ros2_control 4: `hardware_interface/src/component_parser.cpp`, which reads the blocks;
`resource_manager.cpp`, which refuses interfaces that are there twice; the schema that its pull
request 3461 proposes (`hardware_interface/schema/ros2_control.xsd`), for the order of elements.
Where the schema allows less than parser and manual, these count: parameters of a state interface
(`initial_value`) and of a sensor, and transmissions.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import NamedTuple

from lxml import etree

MANY = 1 << 30


class Rule(NamedTuple):
    """What an element has: its required attributes, its children with least and most, a text."""

    attributes: tuple[str, ...] = ()
    children: dict[str, tuple[int, int]] = {}
    has_text: bool = False


_INTERFACES = {"command_interface": (0, MANY), "state_interface": (0, MANY), "param": (0, MANY)}
_REDUCTION = {"mechanical_reduction": (0, 1), "offset": (0, 1)}
RULES = {
    "robot/ros2_control": Rule(
        ("name", "type"),
        {
            "hardware": (1, 1),
            **dict.fromkeys(("joint", "gpio", "sensor", "transmission"), (0, MANY)),
        },
    ),
    "ros2_control/hardware": Rule(
        children={"plugin": (1, 1), "group": (0, 1), "param": (0, MANY)},
    ),
    "hardware/plugin": Rule(has_text=True),
    "hardware/group": Rule(has_text=True),
    "ros2_control/joint": Rule(("name",), {**_INTERFACES, "limits": (0, 1)}),
    "ros2_control/gpio": Rule(("name",), _INTERFACES),
    "ros2_control/sensor": Rule(("name",), {"state_interface": (0, MANY), "param": (0, MANY)}),
    "ros2_control/transmission": Rule(
        ("name",),
        {"plugin": (1, 1), "actuator": (1, MANY), "joint": (1, MANY), "param": (0, MANY)},
    ),
    "transmission/plugin": Rule(has_text=True),
    "transmission/joint": Rule(("name", "role"), _REDUCTION),
    "transmission/actuator": Rule(("name", "role"), _REDUCTION),
    **{
        f"{owner}/{kind}_interface": Rule(("name",), {"param": (0, MANY), "limits": (0, 1)})
        for owner in ("joint", "gpio", "sensor")
        for kind in ("command", "state")
    },
    **{
        f"{owner}/param": Rule(("name",), has_text=True)
        for owner in ("hardware", "joint", "gpio", "sensor", "transmission")
    },
    **{f"{kind}_interface/param": Rule(("name",), has_text=True) for kind in ("command", "state")},
    **{
        f"{owner}/{tag}": Rule(has_text=True)
        for owner in ("joint", "actuator")
        for tag in _REDUCTION
    },
}
"""By the element around it and its own name."""
ORDER = ("command_interface", "state_interface")
TYPES = ("system", "actuator", "sensor")


def faults_of(robot: etree._Element) -> list[str]:
    """Return what ros2_control, or its schema, would find wrong in the blocks of a robot."""
    blocks = robot.findall("ros2_control")
    found = [fault for block in blocks for fault in _faults(robot, block)]
    for kind in ("command", "state"):
        keys = Counter(
            f"{owner.get('name')}/{each.get('name')}"
            for block in blocks
            for owner in block
            for each in owner.findall(f"{kind}_interface")
        )
        found += [f"{kind} interface {key} twice" for key, count in keys.items() if count > 1]
    names = Counter(block.get("name") for block in blocks)
    return found + [f"block {name} twice" for name, count in names.items() if count > 1]


def _faults(robot: etree._Element, block: etree._Element) -> Iterator[str]:
    yield from _by_rule(block, "robot/ros2_control")
    if block.get("type") not in TYPES:
        yield f"type {block.get('type')}"
    joints = {joint.get("name"): joint for joint in robot.findall("joint")}
    for joint in block.findall("joint"):
        name = joint.get("name")
        if name not in joints:
            yield f"joint {name} is not in the URDF"
        elif joints[name].get("type") == "fixed":
            yield f"joint {name} is fixed"
        elif joints[name].find("mimic") is not None and joint.find("command_interface") is not None:
            yield f"mimic joint {name} is commanded"
        for interface in joint.findall("command_interface"):
            yield from _limits(name, interface)
    own = {joint.get("name") for joint in block.findall("joint")}
    for joint in block.findall("transmission/joint"):
        if joint.get("name") not in own:
            yield f"transmission of {joint.get('name')}, which is not in the block"
        if float(joint.findtext("mechanical_reduction", "1")) == 0:
            yield f"mechanical_reduction of {joint.get('name')} is 0"
    if block.get("type") == "sensor" and block.find("joint/command_interface") is not None:
        yield "a sensor with commands"


def _by_rule(element: etree._Element, path: str) -> Iterator[str]:
    rule = RULES.get(path)
    if rule is None:
        yield f"{path} is unknown"
        return
    for name in rule.attributes:
        if not (element.get(name) or "").strip():
            yield f"{path} has no {name}"
    text = (element.text or "").strip()
    if bool(text) and not rule.has_text:
        yield f"{path} has text"
    children = [child for child in element if isinstance(child.tag, str)]
    counts = Counter(child.tag for child in children)
    for tag, (least, most) in rule.children.items():
        if not least <= counts[tag] <= most:
            yield f"{path} has {counts[tag]} {tag}"
    places = [ORDER.index(child.tag) for child in children if child.tag in ORDER]
    if places != sorted(places):
        yield f"{path}: the order of its interfaces"
    for child in children:
        if child.tag not in rule.children:
            yield f"{path} holds {child.tag}"
        elif child.tag != "limits":
            yield from _by_rule(child, f"{element.tag}/{child.tag}")


def _limits(joint: str, interface: etree._Element) -> Iterator[str]:
    """Yield limits that are no numbers, and those that say another velocity backwards."""
    values = {param.get("name"): param.text for param in interface.findall("param")}
    ends = []
    for name in ("min", "max"):
        if name in values:
            try:
                ends.append(float(values[name]))
            except (TypeError, ValueError):
                yield f"{name} of {joint}/{interface.get('name')} is {values[name]}"
    if len(ends) == 2 and ends[0] > ends[1]:
        yield f"{joint}/{interface.get('name')} from {ends[0]} to {ends[1]}"
