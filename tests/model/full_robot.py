"""A robot that has all that the schema lists, made of the rows: change one value, and look.

Values are the examples of the rows, unless a robot needs another, as a joint that is followed has
to be there. `text` takes the values to change, and `ROWS` names all of them.
"""

from __future__ import annotations

from collections.abc import Mapping

from yamaro.model.schema import (
    ACTUATOR,
    COLLISIONS,
    CONTROL,
    CONTROLLER,
    CONTROLLERS,
    ELEMENTS,
    GROUP,
    LINK_SENSORS,
    LOOP,
    RECORDS,
    SENSOR,
    SENSORS,
    SURFACE,
    TEXT,
    WHOLE,
    Field,
    Thing,
)

Values = Mapping[tuple[str, str], str]

GIVEN: dict[tuple[str, str], str] = {
    ("robot", "name"): "full",
    ("joint", "type"): "revolute",
    ("actuator", "stall_torque"): "200",  # more than the effort limit, which bounds it then
    ("limit", "lower"): "-2",
    ("limit", "upper"): "2.5",
    ("mimic", "joint"): "elbow",
    ("material", "name"): "paint",
    ("texture", "filename"): "paint.png",
    ("mesh", "filename"): "tool.stl",
    ("mesh", "scale"): "1 1 1",
    ("actuator", "motor"): "unitree_5020",
    ("surface", "friction2"): "0.6",
    ("lidar", "rays"): "12",  # each is an element in MJCF
    ("lidar", "rows"): "2",
    ("loop", "name"): "bar",
    ("loop", "type"): "revolute",
    ("loop", "between"): "[tip, pin]",
    ("group", "chain"): "[base, fore]",
    ("group", "links"): "[tool]",
    ("group", "joints"): "[elbow]",
    ("group", "groups"): "[other]",
    ("group", "parent"): "fore",
    ("group", "end_effector"): "'true'",
    ("collisions", "keep"): "[[base, tool]]",
    ("controller", "type"): "joint_trajectory",
    ("controller", "joints"): "[elbow]",
    ("controller", "group"): "whole",
    ("control", "name"): "hardware",
    ("control", "plugin"): "vendor/Hardware",
    ("control", "joints"): "[elbow]",
    ("control", "sensors"): "[]",
    ("control", "params"): "{port: usb0}",
    ("control", "gpio"): "{led: {command: [on]}}",
    ("control", "transmissions"): "false",
    ("control", "state"): "home",
}
CHANGED: dict[tuple[str, str], str] = {
    ("robot", "name"): "another",
    ("joint", "type"): "continuous",
    ("axis", "xyz"): "0 1 0",
    ("origin", "quat_xyzw"): "",
    ("actuator", "motor"): "unitree_7520_22",
    ("mimic", "joint"): "shoulder",
    ("material", "name"): "varnish",
    ("texture", "filename"): "varnish.png",
    ("mesh", "filename"): "other.stl",
    ("mesh", "scale"): "1 2 1",
    ("loop", "name"): "rod",
    ("loop", "between"): "[tip, other_pin]",
    ("group", "chain"): "[base, tool]",
    ("group", "links"): "[fore]",
    ("group", "joints"): "[shoulder]",
    ("group", "groups"): "[third]",
    ("group", "parent"): "base",
    ("group", "end_effector"): "'false'",
    ("collisions", "keep"): "[[base, fore]]",
    ("group", "kinematics"): "lma",
    ("controller", "type"): "forward_command",
    ("controller", "joints"): "[shoulder]",
    ("controller", "group"): "third",
    ("control", "name"): "driver",
    ("control", "plugin"): "vendor/Driver",
    ("control", "joints"): "[elbow, shoulder]",
    ("control", "sensors"): "[imu_sensor]",
    ("control", "params"): "{port: usb1}",
    ("control", "gpio"): "{led: {command: [off]}}",
    ("control", "transmissions"): "true",
    ("control", "state"): "rest",
}
OF_OTHERS = frozenset(
    (
        *(("robot", "version"), ("link", "name"), ("link", "type"), ("joint", "name")),
        *(("visual", "name"), ("collision", "name"), ("parent", "link"), ("child", "link")),
        *(("origin", "quat_xyzw"), ("sensor", "type")),
    )
)
"""Values that make another robot altogether, or that only URDF in XML can say."""

SHOULDER = ("armature", "frequency", "damping_ratio")
"""The entries of an actuator that say what others of the elbow's say."""
ELBOW = tuple(name for name in ACTUATOR.fields if name not in (*SHOULDER, "motor"))

WORDS = (*(ACTUATOR, SURFACE, SENSOR, LOOP, GROUP, COLLISIONS, CONTROL, CONTROLLERS, CONTROLLER),)
"""What words say besides URDF."""

ROWS = [
    (thing.name, name)
    for thing in (
        *ELEMENTS.values(),
        *WORDS,
        *SENSORS.values(),
    )
    for name in thing.fields
    if (thing.name, name) not in OF_OTHERS
]
"""The names of thing and field of each value."""


def changed(row: tuple[str, str]) -> str:
    """Return another value of a field, near the one that it has."""
    known = CHANGED.get(row)
    if known is not None:
        return known
    field = field_of(row)
    if field.count == TEXT:
        choices = [each for each in field.choices if each != value_of(row, {})]
        return choices[0] if choices else f"{value_of(row, {})}2"
    factor = 2.0 if field.sign in (WHOLE, "whole, from 0") else 1.1
    numbers = [float(word) * factor or 0.001 for word in value_of(row, {}).split()]
    return " ".join(f"{number:.6g}" for number in numbers)


def field_of(row: tuple[str, str]) -> Field:
    """Return the field of a row."""
    thing, name = row
    return things()[thing].fields[name]


def things() -> dict[str, Thing]:
    """Return all things by name; a sensor's type, such as `range`, is one."""
    return {**{each.name: each for each in WORDS}, **SENSORS, **ELEMENTS}


def value_of(row: tuple[str, str], values: Values) -> str:
    """Return the value of a row: as it is to be changed, or as the robot needs it."""
    field = field_of(row)
    return values.get(row) or GIVEN.get(row) or field.example or field.choices[0]


def text(values: Values = {}) -> str:  # noqa: B006 - is not changed
    """Return the robot as YAML, with some values of its rows changed."""

    def fields(thing: Thing) -> str:
        return ", ".join(f"{n}: {value_of((thing.name, n), values)}" for n in thing.attributes)

    def driven(*names: str) -> str:
        return ", ".join(f"{n}: {value_of(('actuator', n), values)}" for n in names)

    def value(thing: str, name: str) -> str:
        return value_of((thing, name), values)

    records = "".join(
        f"      {name}: {{{fields(ELEMENTS[name])}}}\n"
        for name in RECORDS
        if name not in ("axis", "mimic")
    )
    inertia = " ".join(value("inertia", name) for name in ELEMENTS["inertia"].fields)
    sensors = "".join(
        f"      sensor/name={kind}_sensor: {{type: {kind}, {common(values)}{own(kind, values)}}}\n"
        for kind in LINK_SENSORS
    )
    shapes = "".join(
        f"    - visual: {{geometry: {kind}, {fields(ELEMENTS[kind])}, xyz: 0 0 {place}}}\n"
        for place, kind in enumerate(("box", "cylinder", "sphere", "capsule"), 1)
    )
    mesh = f"geometry: {value('mesh', 'filename')}, scale: {value('mesh', 'scale')}"
    manager = "".join(f"  {name}: {value('controllers', name)}\n" for name in CONTROLLERS.fields)
    return f"""\
robot: {value("robot", "name")}
base: fixed
states:
  home: {{elbow: 0.1}}
  rest: {{elbow: 0.3}}
groups:
  whole: {{chain: {value("group", "chain")}}}
  some: {{links: {value("group", "links")}, joints: {value("group", "joints")}}}
  both: {{groups: {value("group", "groups")}}}
  other: {{joints: [shoulder]}}
  third: {{joints: [elbow]}}
  hand:
    links: [tool]
    parent: {value("group", "parent")}
    end_effector: {value("group", "end_effector")}
    kinematics: {value("group", "kinematics")}
collisions: {{{fields(COLLISIONS)}}}
control: {{{fields(CONTROL)}}}
controllers:
{manager}\
  some_controller: {{type: {value("controller", "type")}, joints: {value("controller", "joints")}}}
  other_controller: {{type: joint_trajectory, group: {value("controller", "group")}}}
model:
- part:
    name: base
    link: {{geometry: box, size: 0.3 0.3 0.1, mass: 4}}
- part:
    name: shoulder upper
    joint:
      type: revolute
      parent: base
      axis: z
      limit: {{lower: -1, upper: 1, effort: 9, velocity: 3}}
      actuator: {{{driven(*SHOULDER)}}}
    link: {{geometry: box, size: 0.1 0.1 0.3, mass: 2}}
- part:
    name: elbow fore
    joint:
      type: {value("joint", "type")}
      parent: upper
      axis: {value("axis", "xyz")}
      xyz: {value("origin", "xyz")}
      rpy: {value("origin", "rpy")}
{records}\
      actuator: {{{driven(*ELBOW)}}}
      sensor/name=force_torque_sensor: {{type: force_torque, {common(values)}}}
    link:
    - inertial: {{mass: {value("mass", "value")}, inertia: {inertia}}}
    - visual:
        geometry: box
        size: 0.1 0.1 0.4
        material:
          name: {value("material", "name")}
          color: {value("color", "rgba")}
          texture: {value("texture", "filename")}
{shapes}\
    - visual: {{{mesh}}}
    - collision:
        geometry: box
        size: 0.1 0.1 0.4
        surface: {{{fields(SURFACE)}}}
    - frame/name=tip: {{xyz: 0 0 0.4}}
- part:
    name: spin disc
    joint: {{type: continuous, parent: base, axis: z, actuator: {{{driven("motor")}}}}}
    link: {{geometry: sphere, radius: 0.05, mass: 0.2}}
- part:
    name: finger tool
    joint:
      type: revolute
      parent: fore
      axis: y
      limit: {{lower: -9, upper: 9, effort: 9, velocity: 3}}
      dynamics: {{armature: {value("dynamics", "armature")}}}
      mimic: {{{fields(ELEMENTS["mimic"])}}}
    link:
      geometry: sphere
      radius: 0.05
      mass: 0.2
      frame/name=pin: {{xyz: 0 0 0.1}}
      frame/name=other_pin: {{xyz: 0 0 0.2}}
- part:
    name: mast mast
    joint: {{type: fixed, parent: base, xyz: 0.1 0 0.3}}
    link:
      geometry: sphere
      radius: 0.02
      mass: 0.1
{sensors}\
- loop: {{{fields(LOOP)}}}
"""


def common(values: Values) -> str:
    """Return what every sensor has, but its type."""
    return ", ".join(
        f"{name}: {value_of(('sensor', name), values)}" for name in SENSOR.fields if name != "type"
    )


def own(kind: str, values: Values) -> str:
    """Return what a type of sensor has of its own, after a comma."""
    return "".join(f", {n}: {value_of((kind, n), values)}" for n in SENSORS[kind].fields)
