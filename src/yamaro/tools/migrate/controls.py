"""`<ros2_control>` of a finished source as the section `control` and `actuator` in the joints.

What the words make is compared with the robot by those who build the source: the values of limits,
which the words repeat, are not looked at here.
"""

from __future__ import annotations

from ...model.schema import COMMANDS
from ...xml.values import format_value
from ...yaml.nodes import type_plain
from .document import Body, Entry, Quoted

TYPE_CHECKING = False
if TYPE_CHECKING:
    pass

STATE = "initial"
"""The name of the state with the initial values."""


class _NoControl(Exception):
    """A block has something that the words do not make."""


class _Joint:
    """A joint in a block: its name, the commands that it takes, and its initial position."""

    __slots__ = ("commands", "initial", "name")

    def __init__(self, entry: Entry) -> None:
        self.name = _attributes(entry, "joint", ("name",))["name"]
        self.commands: list[str] = []
        self.initial = ""
        states: list[str] = []
        for child in _children(entry):
            if child.key.startswith("command_interface/"):
                self.commands.append(_attributes(child, "command_interface", ("name",))["name"])
                _refuse_unless(not states and set(_params(child)) in (set(), {"min", "max"}))
                continue
            states.append(_attributes(child, "state_interface", ("name",))["name"])
            values = _params(child)
            _refuse_unless(
                not values or (states == ["position"] and [*values] == ["initial_value"])
            )
            self.initial = values.get("initial_value", self.initial)
        wanted = ["position", "velocity", *["effort"] * ("effort" in self.commands)]
        _refuse_unless(states == wanted and bool(self.commands))
        _refuse_unless(all(command in COMMANDS for command in self.commands))


def use_control(sections: Body) -> bool:
    """Write the only block of a robot in words, and return whether that can be."""
    model = next((entry.value for entry in sections if entry.key == "model"), None)
    if not isinstance(model, Body) or all(entry.key != "robot" for entry in sections):
        return False
    blocks = [entry for entry in model if entry.key.strip("<").startswith("ros2_control/")]
    if len(blocks) != 1:
        return False
    states = Body(in_braces=True)
    joints: dict[str, tuple[str, Body]] = {}
    for part in model:
        if part.key == "part" and isinstance(part.value, Body):
            name = next((str(own.value) for own in part.value if own.key == "name"), "")
            first, space, _ = name.partition(" ")
            for own in part.value:
                if own.key == "joint" and isinstance(own.value, Body) and name:
                    joints[first if space else f"{name}_joint"] = first, own.value
    try:
        control = _control(blocks[0], joints, states)
    except _NoControl:
        return False
    model.entries.remove(blocks[0])
    if states:
        sections.add("states", Body([Entry(STATE, states)]))
    sections.append(control)
    return True


def _control(block: Entry, joints: dict[str, tuple[str, Body]], states: Body) -> Entry:
    """Return the section for a block; the joints in it get their actuators.

    Raises:
        _NoControl: the words do not make it.
    """
    given = _attributes(block, "ros2_control", ("name", "type"))
    hardware, *others = _children(block)
    _refuse_unless(hardware.key == "hardware" and given["type"] != "sensor")
    plugin, *params = _children(hardware)
    _refuse_unless(plugin.key == "plugin" and isinstance(plugin.value, str))
    values = _params(Entry("hardware", Body(params)))
    driven = [_Joint(entry) for entry in others]
    _refuse_unless(bool(driven) and all(joint.name in joints for joint in driven))
    control = Body()
    for name in ("name", "type"):
        if (name, given[name]) != ("type", "system"):
            control.add(name, Quoted(given[name]))
    control.add("plugin", plugin.value)
    if values:
        entries = [Entry(name, _spelled(value)) for name, value in values.items()]
        control.add("params", Body(entries, in_braces=True))
    for joint in driven:
        called, body = joints[joint.name]
        command = Entry("command", ", ".join(joint.commands))
        body.add("actuator", Body([command], in_braces=len(joint.commands) == 1))
        if joint.initial:
            states.add(called, joint.initial)
    if any(joint.initial for joint in driven):
        control.add("state", STATE)
    return Entry("control", control, block.comment)


# --- reading entries --------------------------------------------------------------------------


def _refuse_unless(holds: bool) -> None:
    if not holds:
        raise _NoControl


def _attributes(entry: Entry, name: str, wanted: tuple[str, ...]) -> dict[str, str]:
    """Return the attributes in the key of an element, which are these."""
    own, _, rest = entry.key.removeprefix("<").removesuffix(">").partition("/")
    pairs = dict(piece.partition("=")[::2] for piece in rest.split(", "))
    is_plain = not any(mark in rest for mark in "$'\"")
    _refuse_unless(own == name and tuple(pairs) == wanted and is_plain and not entry.ending)
    return pairs


def _children(entry: Entry) -> list[Entry]:
    """Return the entries in an element, which have no comments on them."""
    value = entry.value
    if value is None:
        return []
    if not isinstance(value, Body) or value.opening or value.remark:
        raise _NoControl
    _refuse_unless(not any(own.comment or own.ending for own in value) and bool(value))
    return value.entries


def _spelled(text: str) -> str:
    """Return a text so that its letters stay as they are."""
    value = type_plain(text)
    return text if isinstance(value, str) or format_value(value) == text else Quoted(text)


def _params(entry: Entry) -> dict[str, str]:
    """Return the parameters in an element, which has nothing else."""
    found: dict[str, str] = {}
    for own in _children(entry):
        name = _attributes(own, "param", ("name",))["name"]
        value = own.value or ""
        if not isinstance(value, str) or name in found or "$" in value or "\n" in value:
            raise _NoControl
        found[name] = value
    return found
