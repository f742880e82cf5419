"""What differs in what URDF has no elements for: sensors, actuators, states, groups, ….

What elements such as `<gazebo>` say of sensors and actuators is compared in `elements.py`; so is
`<ros2_control>`, which is made of `control`.
"""

from __future__ import annotations

from ..quantities import unit_of
from ..schema import ACTUATOR, COLLISIONS, LOOP, SENSOR, SENSORS, SURFACE
from .context import Owner

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping

    from ..extras import Actuator, Extras, Surface
    from ..robot import Robot
    from ..schema import Thing
    from ..sensors import Sensor
    from ..values import Written
    from .context import Comparing


def compare_extras(comparing: Comparing) -> None:
    """Note in what two robots differ besides links, joints and XML."""
    first, second = comparing.first.noted(), comparing.second.noted()
    _compare_named("sensor", first.sensors, second.sensors, _compare_sensors, comparing)
    _compare_named(
        "actuator",
        {comparing.joint(name): each for name, each in first.actuators.items()},
        second.actuators,
        _compare_actuators,
        comparing,
    )
    _compare_named(
        "surface",
        _surfaces(first, comparing.link),
        _surfaces(second, lambda name: name),
        _compare_surfaces,
        comparing,
    )
    _compare_named("state", first.states, second.states, _compare_states, comparing)
    _compare_named("group", first.groups, second.groups, _compare_groups, comparing)
    _compare_named("loop", first.loops, second.loops, _compare_loops, comparing)
    _compare_settings(first, second, comparing)


def extras_held(robot: Robot) -> list[str]:
    """Return what a robot has that URDF has no elements for, as phrases such as "2 sensors"."""
    noted = robot.noted()
    counts = {
        "sensor": len(noted.sensors),
        "actuator": len(noted.actuators),
        "surface": len(noted.surfaces),
        "state": len(noted.states),
        "group": len(noted.groups),
        "loop": len(noted.loops),
    }
    return [f"{n} {word}{'s' if n > 1 else ''}" for word, n in counts.items() if n]


def _compare_named(
    of: str,
    first: Mapping[str, Written],
    second: Mapping[str, Written],
    compare: Callable[..., None],
    comparing: Comparing,
) -> None:
    """Compare what has the same name, and note what only one robot has."""
    for name, one in first.items():
        other = second.get(name)
        if other is None:
            comparing.add(of, name, is_new=False, value=_fact(one), place=one.span)
        else:
            owner = Owner(of, name, new_name=None, places=(one.span, other.span))
            compare(one, other, owner, comparing)
    for name, other in second.items():
        if name not in first:
            comparing.add(of, name, is_new=True, value=_fact(other), place=other.span)


def _fact(thing: Written) -> object:
    """Return what to say of something that only one robot has."""
    return getattr(thing, "type", None) or getattr(thing, "command", None)


def _compare_fields(
    one: object,
    other: object,
    thing: Thing,
    owner: Owner,
    comparing: Comparing,
    *,
    but: Collection[str] = (),
    joint_type: str = "",
) -> None:
    """Compare the fields of two things, except for some that are compared otherwise."""
    for name, field in thing.fields.items():
        if name in but:
            continue
        before, after = getattr(one, name, None), getattr(other, name, None)
        unit = unit_of(field.kind, joint_type)
        if isinstance(before, tuple) and isinstance(after, tuple):
            comparing.row(owner, name, (before, after), unit=unit)
        elif isinstance(before, (int, float)) and isinstance(after, (int, float)):
            comparing.number(owner, name, (before, after), unit=unit)
        elif before != after:
            comparing.change(owner, name, before, after, unit=unit)


def _compare_sensors(one: Sensor, other: Sensor, owner: Owner, comparing: Comparing) -> None:
    comparing.text(owner, "type", (one.type, other.type))
    comparing.named(owner, "link", (one.link, other.link), comparing.link)
    comparing.named(owner, "joint", (one.joint, other.joint), comparing.joint)
    comparing.named(owner, "frame", (one.frame, other.frame), comparing.link)
    _compare_fields(one, other, SENSOR, owner, comparing, but=("type",))
    if one.type == other.type and one.details is not None:
        _compare_fields(one.details, other.details, SENSORS[one.type], owner, comparing)


def _compare_actuators(one: Actuator, other: Actuator, owner: Owner, comparing: Comparing) -> None:
    joint = comparing.first.joints.get(one.joint)
    kind = joint.type if joint is not None else ""
    _compare_fields(one, other, ACTUATOR, owner, comparing, joint_type=kind)
    comparing.text(owner, "commands", (one.commands, other.commands))


def _surfaces(extras: Extras, rename: Callable[[str], str]) -> dict[str, Surface]:
    """Return the surfaces by their collisions: `wheel/collision[1]`."""
    return {f"{rename(each.link)}/collision[{each.index + 1}]": each for each in extras.surfaces}


def _compare_surfaces(one: object, other: object, owner: Owner, comparing: Comparing) -> None:
    _compare_fields(one, other, SURFACE, owner, comparing)


def _compare_states(one: object, other: object, owner: Owner, comparing: Comparing) -> None:
    first = {comparing.joint(name): at for name, at in one.positions.items()}  # type: ignore[attr-defined]
    second: dict[str, float] = other.positions  # type: ignore[attr-defined]
    for name in dict.fromkeys((*first, *second)):
        places = (one.span_of(name), other.span_of(name))  # type: ignore[attr-defined]
        comparing.number(owner, name, (first.get(name), second.get(name)), places=places)


def _compare_groups(one: object, other: object, owner: Owner, comparing: Comparing) -> None:
    def members(group: object, name: str, rename: Callable[[str], str]) -> list[object]:
        return [
            rename(each) if isinstance(each, str) else " … ".join(map(rename, each))
            for each in getattr(group, name)
        ]

    def same(name: str) -> str:
        return name

    for what, rename in (
        ("chains", comparing.link),
        ("links", comparing.link),
        ("joints", comparing.joint),
        ("groups", same),
    ):
        comparing.text(owner, what, (members(one, what, rename), members(other, what, same)))
    parents = (getattr(one, "parent", None), getattr(other, "parent", None))
    comparing.named(owner, "parent", parents, comparing.link)
    ends = [bool(getattr(each, "is_end_effector", False)) for each in (one, other)]
    comparing.text(owner, "is_end_effector", ends)


def _compare_loops(one: object, other: object, owner: Owner, comparing: Comparing) -> None:
    ends = [getattr(each, "between", ()) for each in (one, other)]
    first = [comparing.link(name) for name in ends[0]]
    comparing.text(owner, "between", (first, list(ends[1])))
    _compare_fields(one, other, LOOP, owner, comparing, but=("name", "between"))


def _compare_settings(first: Extras, second: Extras, comparing: Comparing) -> None:
    """Compare how the robots are placed in the world, and how their collisions are found."""
    places = (comparing.first.span, comparing.second.span)
    owner = Owner("robot", comparing.first.name, new_name=None, places=places)
    bases = [each.base and each.base.type for each in (first, second)]
    comparing.text(owner, "base", bases)
    one, other = first.collision_settings, second.collision_settings
    if one is None or other is None:
        if one is not other:
            comparing.change(owner, "collisions", _settings(one), _settings(other))
        return
    owner = Owner("collisions", "", new_name=None, places=(one.span, other.span))
    _compare_fields(one, other, COLLISIONS, owner, comparing, but=("keep",))
    kept = [" ".join(map(comparing.link, pair)) for pair in one.keep]
    comparing.text(owner, "keep", (kept, [" ".join(pair) for pair in other.keep]))


def _settings(settings: object) -> object:
    if settings is None:
        return None
    return {name: getattr(settings, name) for name in COLLISIONS.numbers()}
