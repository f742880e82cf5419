"""What a file says for MJCF alone, in blocks: values and elements, merged into what is written.

A block in a joint or link holds attributes of the joint, body or site that is written for it, as
elements with a text in them, and elements in it. One for the robot holds sections of the document.
Where it names what is written anyway, such as a geom or the actuator of a joint, its attributes are
set on that, and it keeps its place among what the block names; else it is added.
"""

from __future__ import annotations

from functools import partial

from ...model.values import attribute_text, numbers_in
from ...xml.mjcf_references import measured_bodies
from ...xml.tree import OF_ATTACHED, Element
from ...xml.values import format_value
from ..foreign_xml import elements_of, settings_in
from ..losses import Losses
from ..translation import Translation

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Container, Iterable, Sequence

    from ...model.extras import RawXml
    from ...model.robot import Robot
    from ...xml.tree import Node

    Keys = Callable[[Element], list[object]]

OF_BODIES = frozenset(("gravcomp", "mocap", "sleep"))
"""Attributes that only a body has: a link that says one is not a site."""
ANCHOR, REFERENCE = "pos", "ref"
"""Attributes of a joint: where it is in its body, and the position that counts as unmoved."""
ACTUATORS = frozenset(
    """
    general motor position velocity intvelocity damper cylinder muscle adhesion dcmotor plugin
    """.split()
)
"""The elements of the section `actuator`."""
SINGLES = frozenset(("compiler", "option", "size", "statistic", "visual"))
"""Sections that are there once, with elements that are there once in them."""
OF_WHOLE = frozenset(("statistic", "visual"))
"""Those which say how one robot is shown, and nothing of a robot around it."""
ENDS = frozenset(("joint1", "tendon1", "body1", "geom1", "site1", "flex"))
"""Attributes of equalities that say what they hold; without one, an equality is tuned only."""


class Blocks:
    """The blocks of a robot for MJCF.

    Attributes:
        sections: those of the document, in the order written.
    """

    __slots__ = ("_actuators", "_blocks", "_elements", "_inner", "_settings", "sections")

    def __init__(self, robot: Robot) -> None:
        self._blocks: dict[tuple[str, str], list[RawXml]] = {}
        self.sections: list[Element] = []
        for raw in Translation(robot, "mjcf").blocks:
            if raw.link is not None:
                self._blocks.setdefault(("link", raw.link), []).append(raw)
            elif raw.joint is not None:
                self._blocks.setdefault(("joint", raw.joint), []).append(raw)
            else:
                self.sections += elements_of(raw)
        self._settings: dict[tuple[str, str], dict[str, Element]] = {}
        self._elements: dict[tuple[str, str], list[Element]] = {}
        for home, blocks in self._blocks.items():
            found = [each for raw in blocks for each in elements_of(raw)]
            settings, rest = settings_in(found)
            nameless = [each for each in rest if each.name == "name"]
            self._settings[home] = settings | {each.name: each for each in nameless}
            self._elements[home] = [each for each in rest if each.name != "name"]
        self._inner: dict[str, list[Element]] = {}
        for section in self.sections:
            trace = section.trace_within(None)
            inner = [child.settled(trace) for child in section.elements()]
            self._inner.setdefault(section.name, []).extend(inner)
        self._actuators: dict[tuple[str, str], Element] = {}
        for (kind, name), elements in self._elements.items():
            for each in elements if kind == "joint" else ():
                if each.name in ACTUATORS:
                    self._actuators.setdefault((name, ""), each)
        for each in self._inner.get("actuator", ()):
            self._actuators.setdefault((attribute_text(each, "joint") or "", each.name), each)

    def left(self, written: Container[tuple[str, str]]) -> Losses:
        """Return the losses of blocks whose home is not written: a `link` or `joint`, by name."""
        found = Losses()
        what, hint = "blocks in what is not an element", "write the block in another link or joint"
        for home, blocks in self._blocks.items():
            if home not in written:
                for raw in blocks:
                    found.lose(what, raw, label=f"{home[0]} '{home[1]}'", hint=hint)
        return found

    def settings(self, kind: str, name: str) -> dict[str, Element]:
        """Return the attributes for a `link` or `joint`, as elements with a text."""
        return self._settings.get((kind, name), {})

    def elements(self, kind: str, name: str) -> list[Element]:
        """Return the elements for a `link` or `joint`."""
        return self._elements.get((kind, name), [])

    def text(self, kind: str, name: str, attribute: str) -> str | None:
        """Return an attribute for a `link` or `joint`, or None."""
        found = self.settings(kind, name).get(attribute)
        return None if found is None else format_value(found.text()).strip()

    def reference(self, joint: str) -> float:
        """Return the position of a joint that counts as unmoved."""
        said = self.text("joint", joint, REFERENCE)
        numbers = () if said is None else numbers_in(said)
        return numbers[0] if len(numbers) == 1 else 0.0

    def is_body(self, link: str) -> bool:
        """Return whether a block says of a link what only a body has."""
        has_mass = any(each.name == "inertial" for each in self.elements("link", link))
        return has_mass or not OF_BODIES.isdisjoint(self.settings("link", link))

    def is_aligned(self, link: str) -> bool:
        """Return whether MuJoCo aligns the frame of a free body with its principal axes."""
        free = (e for e in self.elements("link", link) if e.name in ("joint", "freejoint"))
        said = next((attribute_text(each, "align") for each in free), None)
        if said in ("true", "false"):
            return said == "true"
        compilers = (each for each in self.sections if each.name == "compiler")
        return any(attribute_text(each, "alignfree") == "true" for each in compilers)

    def measured_bodies(self) -> set[str]:
        """Return the bodies along the axes of whose inertia sensors measure."""
        found: set[str] = set()
        for each in self.in_section("sensor"):
            found |= measured_bodies(each.name, partial(attribute_text, each))
        return found

    def is_plain(self, link: str) -> bool:
        """Return whether no block says anything of a link."""
        return not self.settings("link", link) and not self.elements("link", link)

    def geoms(self, link: str) -> set[str]:
        """Return the names of the geoms that a block names in a link."""
        names = (attribute_text(e, "name") for e in self.elements("link", link) if e.name == "geom")
        return {name for name in names if name is not None}

    def has(self, section: str) -> bool:
        """Return whether a block has a section of the document."""
        return section in self._inner

    @property
    def is_whole(self) -> bool:
        """Return whether blocks say all that links do not: they have a section `contact`.

        Then nothing is chosen that the robot does not say. That of an attached robot does not say
        what touches those around it.
        """
        found = (each for each in self.sections if each.name == "contact")
        return any(each.body != OF_ATTACHED for each in found)

    def in_section(self, section: str) -> list[Element]:
        """Return the elements of a section, of all blocks that have it, in the order written."""
        return self._inner.get(section, [])

    def actuator_of(self, joint: str, word: str) -> Element | None:
        """Return the first actuator that the block of a joint gives it; None for none.

        Or one of the same word that a block of the robot gives it: there, others are further ones.
        """
        return self._actuators.get((joint, "")) or self._actuators.get((joint, word))

    def equality_of(self, name: str, ends: tuple[str, str] | None = None) -> bool:
        """Return whether a block has an equality of this name whole, or that of a follower.

        Args:
            name: the name.
            ends: the follower and its leader; the equality may be solved for the leader.
        """
        for each in self.in_section("equality"):
            if ends is not None and each.name == "joint":
                first, second = (attribute_text(each, key) for key in ("joint1", "joint2"))
                if first == ends[0] or (second, first) == ends:
                    return True
            elif attribute_text(each, "name") == name and not ENDS.isdisjoint(each.attributes):
                return True
        return False


def set_from(element: Element, settings: dict[str, Element]) -> None:
    """Set attributes that are given as elements with a text."""
    if not settings:
        return
    spans = {name: element.value_span(name) for name in element.attributes}
    for name, setting in settings.items():
        element.attributes[name] = format_value(setting.text()).strip()
        spans[name] = setting.span
    element.value_spans = spans


def merge(own: Element, given: Element) -> None:
    """Set the attributes that a block gives; add its elements, or set those of the same name."""
    spans = {name: own.value_span(name) for name in own.attributes}
    spans.update((name, given.value_span(name)) for name in given.attributes)
    own.attributes = {**own.attributes, **given.attributes}
    own.value_spans = spans
    if "sensorsize" in given.attributes:  # with the focal length, it is the angle of a camera
        own.attributes.pop("fovy", None)
    inner = {child.name: child for child in own.elements()}
    for child in given.elements():
        if own.name in SINGLES:
            known = inner.get(child.name)
            if known is None:
                known = inner[child.name] = changed(child, child.attributes)
                own.children.append(known)
            else:
                merge(known, child)
        else:
            own.children.append(child)


def join(own: Element, given: Element, said: set[tuple[str, str]]) -> list[tuple[Element, str]]:
    """Set the attributes that a block of an attached robot gives, unless others are said.

    Args:
        own: a section that is there once.
        given: what the block gives of it.
        said: the elements in the section and their attributes that are said; `given` adds to it.

    Returns:
        What is not set: the elements of the block, with the attribute of each.
    """
    refused = []
    for each in (given, *given.elements()):
        tag = "" if each is given else each.name
        inner = own if each is given else next((e for e in own.elements() if e.name == tag), None)
        if inner is None:
            inner = each.with_children([])
            inner.attributes = {}
            own.children.append(inner)
        attributes = {}
        for name, value in each.attributes.items():
            if (tag, name) not in said:
                attributes[name] = value
            elif format_value(inner.attributes.get(name)) != format_value(value):
                refused.append((each, name))
        said.update((tag, name) for name in attributes)
        taken = changed(each, attributes)
        taken.children = []
        merge(inner, taken)
    return refused


def merged(
    own: Iterable[Node],
    given: Sequence[Element],
    keys: Keys,
    *,
    orders: bool = True,
    is_body: bool = False,
) -> list[Node]:
    """Return elements that are written, with those of blocks merged into them or added.

    What blocks add follows what they name before it.

    Args:
        own: what is written.
        given: what blocks say.
        keys: returns what an element can be known by; a block's is known by the first.
        orders: whether what blocks name is in their order, at the places that this has among the
            others.
        is_body: whether that holds for the elements of each word alone: geoms, sites.
    """
    found = list(own)
    known: dict[object, list[Element]] = {}
    for node in found:
        if isinstance(node, Element):
            for key in keys(node):
                known.setdefault(key, []).append(node)
    taken: set[int] = set()
    named: list[Element] = []
    following: dict[int, list[Node]] = {}  # what is added, by the identity of what it follows
    before: list[Node] = []
    for each in given:
        alike = [node for key in keys(each)[:1] for node in known.get(key, ())]
        same = next((node for node in alike if id(node) not in taken), None)
        if same is not None:
            merge(same, each)
            taken.add(id(same))
            named.append(same)
        elif named:
            following.setdefault(id(named[-1]), []).append(each)
        else:
            before.append(each)
    if not named:
        return found + before
    ordered: list[Node] = []
    rows: dict[str, list[Element]] = {}
    for each in named:
        rows.setdefault(each.name if is_body else "", []).append(each)
    rest = {word: iter(row) for word, row in rows.items()}
    for node in found:
        if not isinstance(node, Element) or id(node) not in taken:
            ordered.append(node)
            continue
        here = next(rest[node.name if is_body else ""]) if orders else node
        ordered += [*before, here, *following.get(id(here), ())]
        before = []
    return ordered


def names(element: Element) -> list[object]:
    """Return what an element is known by: its word and name."""
    name = attribute_text(element, "name")
    return [] if name is None else [(element.name, name)]


def drivers(element: Element) -> list[object]:
    """Return what an actuator is known by: its word and joint, or its word and name."""
    joint = attribute_text(element, "joint")
    own: list[object] = [] if joint is None else [(element.name, "joint", joint)]
    return own + names(element)


def changed(element: Element, attributes: dict[str, object]) -> Element:
    """Return an element of a block with other attributes, which may be changed."""
    copy = element.with_children(list(element.children))
    copy.attributes = attributes
    copy.value_spans = {name: element.value_span(name) for name in element.attributes}
    return copy
