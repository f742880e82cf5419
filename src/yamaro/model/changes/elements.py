"""What differs in XML that is not part of the model: Gazebo's, transmissions, ros2_control, ….

Elements are compared as trees. Children of other names may be in any order, and so may those of
one name that are equal; names of links and joints that were renamed are those of the first robot.
"""

from __future__ import annotations

from ...xml.robot_names import RobotNames
from ...xml.tree import Element, Text, unshared
from ...xml.values import format_value
from ..values import attribute_text, values_of
from .context import Owner

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..robot import Robot
    from .context import Comparing

MODELLED = {
    "link": ({"name"}, {"inertial", "visual", "collision"}),
    "joint": (
        {"name", "type"},
        {
            *("parent", "child", "origin", "axis", "limit", "mimic", "dynamics"),
            *("safety_controller", "calibration"),
        },
    ),
    "visual": ({"name"}, {"origin", "geometry", "material"}),
    "collision": ({"name"}, {"origin", "geometry"}),
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
    names = RobotNames([Element(kind, elements[0].span, {"name": name})
                        for kind, name in _bodies(comparing.second)])  # fmt: skip
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


def _bodies(robot: Robot) -> list[tuple[str, str]]:
    return [("link", name) for name in robot.links] + [("joint", name) for name in robot.joints]


# --- trees ---


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


def _paired(
    mine: list[Element], theirs: list[Element], comparing: Comparing
) -> tuple[list[tuple[Element, Element]], list[Element], list[Element]]:
    """Return the elements that differ, in order, and those that only one of the robots has."""
    left, others = [], list(theirs)
    for element in mine:
        twin = _twin(element, others, comparing)
        if twin is None:
            left.append(element)
        else:
            others.remove(twin)
    shared = min(len(left), len(others))
    pairs = list(zip(left[:shared], others[:shared], strict=True))
    return pairs, left[shared:], others[shared:]


# A tree may be deeper than Python 3.12 and 3.13 let functions written in C call each other. So
# where its levels call each other there is no `all`, no `next` and no generator in between.


def _twin(element: Element, others: list[Element], comparing: Comparing) -> Element | None:
    for other in others:
        if _same(element, other, comparing):
            return other
    return None


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
