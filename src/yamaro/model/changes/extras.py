"""Differences besides links, joints and materials: sensors, actuators, states, …; other XML.

What elements such as `<gazebo>` say of sensors and actuators is compared as XML; so is
`<ros2_control>`, which is made of `control`.
"""

from __future__ import annotations

from ...xml.robot_names import RobotNames
from ...xml.tree import Element, Text, unshared
from ...xml.values import format_value
from ..quantities import unit_of
from ..schema import ACTUATOR, COLLISIONS, ELEMENTS, LOOP, SENSOR, SENSORS, SURFACE
from ..values import attribute_text, values_of
from .context import Owner

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping, Sequence

    from ..extras import Actuator, Extras, Sensor, Surface
    from ..robot import Robot
    from ..schema import Thing
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
    _compare_named(
        "controller", first.controllers, second.controllers, _compare_controllers, comparing
    )
    _compare_named("loop", first.loops, second.loops, _compare_loops, comparing)
    places = (comparing.first.span, comparing.second.span)
    owner = Owner("robot", comparing.first.name, new_name=None, places=places)
    bases = [each.base and each.base.type for each in (first, second)]
    comparing.text(owner, "base", bases)
    managers = [each.controller_manager for each in (first, second)]
    settings = [each and {"distro": each.distro, **each.parameters} for each in managers]
    comparing.text(owner, "controllers", settings)
    one, other = first.collision_settings, second.collision_settings
    if one is None or other is None:
        if one is not other:
            comparing.change(owner, "collisions", _settings(one), _settings(other))
        return
    owner = Owner("collisions", "", new_name=None, places=(one.span, other.span))
    _compare_fields(one, other, COLLISIONS, owner, comparing, but=("keep",))
    kept = [" ".join(map(comparing.link, pair)) for pair in one.keep]
    comparing.text(owner, "keep", (kept, [" ".join(pair) for pair in other.keep]))


def extras_held(robot: Robot) -> list[str]:
    """Return what a robot has that URDF has no elements for, as phrases such as "2 sensors"."""
    noted = robot.noted()
    counts = {
        "sensor": len(noted.sensors),
        "actuator": len(noted.actuators),
        "surface": len(noted.surfaces),
        "state": len(noted.states),
        "group": len(noted.groups),
        "controller": len(noted.controllers),
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
    solvers = [getattr(each, "kinematics", None) or None for each in (one, other)]
    comparing.text(owner, "kinematics", solvers)


def _compare_controllers(one: object, other: object, owner: Owner, comparing: Comparing) -> None:
    comparing.text(owner, "type", [getattr(each, "type", None) for each in (one, other)])
    comparing.text(owner, "group", [getattr(each, "group", None) for each in (one, other)])
    joints = [comparing.joint(name) for name in getattr(one, "joints", ())]
    comparing.text(owner, "joints", (joints, [*getattr(other, "joints", ())]))
    first, second = (getattr(each, "parameters", {}) for each in (one, other))
    for name in dict.fromkeys((*first, *second)):
        before, after = first.get(name), second.get(name)
        values = [
            comparing.joint(each) if isinstance(each, str) else each for each in _list(before)
        ]
        if values != _list(after):
            comparing.change(owner, name, before, after)


def _list(value: object) -> list[object]:
    return [*value] if isinstance(value, list) else [value]


def _compare_loops(one: object, other: object, owner: Owner, comparing: Comparing) -> None:
    ends = [getattr(each, "between", ()) for each in (one, other)]
    first = [comparing.link(name) for name in ends[0]]
    comparing.text(owner, "between", (first, list(ends[1])))
    _compare_fields(one, other, LOOP, owner, comparing, but=("name", "between"))


def _settings(settings: object) -> object:
    if settings is None:
        return None
    return {name: getattr(settings, name) for name in COLLISIONS.numbers()}


# --- XML that the model does not hold ---------------------------------------------------------
# Elements are compared as trees. Children of other names may be in any order, and so may those of
# one name that are equal; names of links and joints that were renamed are those of the first robot.


MODELLED = {
    name: ({"name", "type"} if name == "joint" else {"name"}, ELEMENTS[name].children)
    for name in ("link", "joint", "visual", "collision")
}
"""The attributes and children of elements that the model holds, which are compared as such."""


def compare_other_elements(comparing: Comparing) -> None:
    """Note in what the elements of two robots differ that are not links, joints or materials."""
    root, other = comparing.first.element, comparing.second.element
    mine = _others(comparing.first)
    originals = _others(comparing.second)
    theirs = _with_first_names(originals, comparing)
    names = {id(each): _label(_key(own)) for each, own in zip(theirs, originals, strict=True)}
    owner = Owner("robot", comparing.first.name, new_name=None, places=(root.span, other.span))
    _compare_attributes(root, other, "", owner, comparing, apart={"name"})
    for key, (some, others) in _by_key(mine, theirs).items():
        pairs, removed, added = _paired(some, others, comparing)
        name = _label(key)
        for one, twin in pairs:
            new = names[id(twin)]
            own = Owner("element", name, new_name=new, places=(one.span, twin.span))
            _compare(one, twin, "", own, comparing)
        for element in removed:
            comparing.add("element", name, is_new=False, place=element.span)
        for element in added:
            comparing.add("element", names[id(element)], is_new=True, place=element.span)


def compare_rest(
    one: Element, other: Element, what: str, owner: Owner, comparing: Comparing
) -> None:
    """Note what differs in an element of URDF besides what the model holds of it."""
    if one is other:
        return
    attributes, children = MODELLED[one.name]
    _compare_attributes(one, other, what, owner, comparing, apart=attributes)
    mine = [child for child in one.elements() if child.name not in children]
    theirs = [child for child in other.elements() if child.name not in children]
    if mine or theirs:
        _compare_children(mine, _with_first_names(theirs, comparing), what, owner, comparing)


def _others(robot: Robot) -> list[Element]:
    """Return what is not in the model: links and joints that repeat a name are not."""
    known = {id(each.element) for each in (*robot.links.values(), *robot.joints.values())}
    return [
        child
        for child in robot.element.elements()
        if child.name != "material" and id(child) not in known
    ]


def _with_first_names(elements: list[Element], comparing: Comparing) -> list[Element]:
    """Return elements of the second robot, with the first names of what was renamed."""
    renamed = comparing.matching.renamed()
    if not renamed or not elements:
        return elements
    copies = [_copy(element) for element in elements]
    second, span = comparing.second, elements[0].span
    bodies = [Element("link", span, {"name": name}) for name in second.links]
    bodies += [Element("joint", span, {"name": name}) for name in second.joints]
    names = RobotNames(bodies)
    names.rename(copies, lambda name: renamed.get(name, name))
    return copies


def _copy(element: Element) -> Element:
    """Return a copy of a tree, with texts of its own, which may be changed."""
    copy = unshared(element)
    for each in copy.iter():
        each.children = [
            Text(child.value, child.span) if isinstance(child, Text) else child
            for child in each.children
        ]
    return copy


def _key(element: Element) -> tuple[str, str]:
    """Return the tag and the name of an element, or what it refers to."""
    for attribute in ("name", "reference"):
        name = attribute_text(element, attribute)
        if name is not None:
            return (element.name, name)
    return (element.name, "")


def _label(key: tuple[str, str]) -> str:
    tag, name = key
    return f"{tag} {name}" if name else tag


def _by_key(
    mine: Sequence[Element], theirs: Sequence[Element]
) -> dict[tuple[str, str], tuple[list[Element], list[Element]]]:
    found: dict[tuple[str, str], tuple[list[Element], list[Element]]] = {}
    for index, row in enumerate((mine, theirs)):
        for element in row:
            found.setdefault(_key(element), ([], []))[index].append(element)
    return found


# A tree may be deeper than Python 3.12 and 3.13 let functions written in C call each other. So
# where its levels call each other there is no `all`, no `next` and no generator in between.


def _paired(
    mine: list[Element], theirs: list[Element], comparing: Comparing
) -> tuple[list[tuple[Element, Element]], list[Element], list[Element]]:
    """Return the elements that differ, in order, and those that only one of the robots has."""
    left, others = [], list(theirs)
    for element in mine:
        for other in others:
            if _same(element, other, comparing):
                others.remove(other)
                break
        else:
            left.append(element)
    shared = min(len(left), len(others))
    pairs = list(zip(left[:shared], others[:shared], strict=True))
    return pairs, left[shared:], others[shared:]


def _same(one: Element, other: Element, comparing: Comparing) -> bool:
    """Return whether two trees are equal; their depth is limited where they are read.

    The answer is kept: without that, each level would ask those below it twice.
    """
    if one is other:
        return True
    key = (id(one), id(other))
    known = comparing.equal.get(key)
    if known is None:
        known = (_is_equal(one, other, comparing), one, other)
        comparing.equal[key] = known
    return known[0]


def _is_equal(one: Element, other: Element, comparing: Comparing) -> bool:
    first, second = values_of(one), values_of(other)
    if one.name != other.name or first.keys() != second.keys():
        return False
    same = comparing.tolerance.same_text
    if not all(same(value, second[name]) for name, value in first.items()):
        return False
    if not same(_text(one), _text(other)):
        return False
    mine, theirs = one.elements(), other.elements()
    if len(mine) != len(theirs):
        return False
    for each, twin in zip(mine, theirs, strict=True):
        if not _same(each, twin, comparing):
            break
    else:
        return True
    for some, others in _by_key(mine, theirs).values():
        pairs, removed, added = _paired(some, others, comparing)
        if pairs or removed or added:
            return False
    return True


def _compare(one: Element, other: Element, what: str, owner: Owner, comparing: Comparing) -> None:
    """Note in what two trees differ."""
    _compare_attributes(one, other, what, owner, comparing)
    texts = (_text(one), _text(other))
    if not comparing.tolerance.same_text(*texts):
        values = [" ".join(text.split()) or None for text in texts]
        comparing.change(owner, what, *values, places=(one.span, other.span))
    _compare_children(one.elements(), other.elements(), what, owner, comparing)


def _compare_children(
    mine: list[Element], theirs: list[Element], what: str, owner: Owner, comparing: Comparing
) -> None:
    for key, (some, others) in _by_key(mine, theirs).items():
        path = f"{what}/{_label(key)}" if what else _label(key)
        pairs, removed, added = _paired(some, others, comparing)
        for one, twin in pairs:
            _compare(one, twin, path, owner, comparing)
        for element in removed:
            comparing.change(owner, path, _summary(element), None, places=(element.span, None))
        for element in added:
            comparing.change(owner, path, None, _summary(element), places=(None, element.span))


def _compare_attributes(
    one: Element,
    other: Element,
    what: str,
    owner: Owner,
    comparing: Comparing,
    *,
    apart: set[str] = frozenset(),  # type: ignore[assignment]
) -> None:
    first, second = values_of(one), values_of(other)
    for name in dict.fromkeys((*first, *second)):
        if name in apart or name.startswith("xmlns"):
            continue
        values = (first.get(name), second.get(name))
        if values[0] is None or values[1] is None:
            is_same = False
        else:
            is_same = comparing.tolerance.same_text(values[0], values[1])
        if not is_same:
            places = (one.value_span(name), other.value_span(name))
            comparing.change(owner, f"{what}@{name}", *values, places=places)


def _text(element: Element) -> str:
    return " ".join(
        format_value(child.value) for child in element.children if isinstance(child, Text)
    ).strip()


def _summary(element: Element) -> str:
    """Return what an element that only one robot has holds, on a short line."""
    attributes = [f'{name}="{value}"' for name, value in values_of(element).items()]
    text = " ".join(_text(element).split())
    count = len(element.elements())
    inner = text or (f"… {count} inside" if count else "")
    tag = " ".join([element.name, *attributes])
    return f"<{tag}>{inner}" if inner else f"<{tag}/>"
