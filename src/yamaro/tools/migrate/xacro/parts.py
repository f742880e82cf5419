"""Which joints and links of a xacro file are written as parts, and how.

What is in them may be statements of xacro: conditions, calls, blocks. They are in the part in
turn, where all that they make is the same as in an element. Where that is not known for
all arguments, the joint or link stays an element.
"""

from __future__ import annotations

from ....model.schema import JOINT_TYPES
from ....model.values import values_of
from ....xml.tree import Comment, Element, Text
from ....xml.values import format_value
from ..document import Body, Entry
from ..elements import ElementWriter, add_loose, comments_at_ends, note_comments
from ..pairing import has_text, pair
from ..part_forms import (
    MOMENTS,
    Geometry,
    NoPart,
    are_numbers,
    is_short_material,
    material_entry,
    pose_of,
    read_geometry,
)
from ..parts import PART_KEYS, SECTIONS, Names, PartWriter
from ..solids import are_equal
from .contents import UnknownContent

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from typing import Protocol

    from ....xml.tree import Node
    from ..elements import Endings
    from ..part_forms import LinkPlan
    from .contents import Contents, Counts
    from .inertia import SolidInertia, Solids
    from .macros import Macro

    Write = Callable[[Element, Body], None]

    class Host(Protocol):
        """Writes the file that a part is in."""

        def entry(self, element: Element, *, bracketed: bool = False) -> Entry:
            """Return an element that may hold statements."""

        def write_statement(
            self, node: Element, body: Body, place: Write, *, has_keys: bool
        ) -> None:
            """Write a statement, and the elements in it by `place`."""


WITHOUT_LIMIT = ("fixed", "continuous", "floating", "planar")
STRUCTURE = frozenset(("parent", "child", "geometry", "mass", "inertia"))
"""Elements without which there is no joint or section, and that are in it unchanged."""


class Step:
    """What becomes one entry or two: a node, or a link with the joint whose child it is."""

    __slots__ = ("is_joint_first", "joint", "node")

    def __init__(
        self, node: Node, joint: Element | None = None, *, is_joint_first: bool = True
    ) -> None:
        self.node = node
        self.joint = joint
        self.is_joint_first = is_joint_first


def in_steps(nodes: list[Node], endings: Endings, contents: Contents) -> Iterator[Step]:
    """Return nodes in order, links and joints together that make a part.

    Comments at the ends of lines, which `endings` has, stay with what they follow.

    A statement may make links and joints, or set what an expression reads, so that nothing is moved
    past one.
    """
    run: list[Node] = []
    for node in nodes:
        if isinstance(node, Element) and is_statement(node):
            yield from _stretches(run, endings, contents)
            yield Step(node)
            run = []
        else:
            run.append(node)
    yield from _stretches(run, endings, contents)


def _stretches(run: list[Node], endings: Endings, contents: Contents) -> Iterator[Step]:
    """Return nodes without statements among them, where links may set what is read after them."""
    setters = {
        id(node) for node in run if isinstance(node, Element) and contents.sets_variables(node)
    }
    names: set[str] | None = set()
    for node in run:
        if names is not None and id(node) in setters and isinstance(node, Element):
            names = _names_set_in(node, names, contents)
    others = [node for node in run if isinstance(node, Element) and id(node) not in setters]
    if not setters or (
        names is not None
        and all(contents.may_pass(node, names) for node in others if node.name != "link")
    ):
        yield from _paired(run, endings)
        return
    stretch: list[Node] = []
    for node in run:
        if id(node) in setters:
            yield from _paired(stretch, endings)
            yield Step(node)
            stretch = []
        else:
            stretch.append(node)
    yield from _paired(stretch, endings)


def _names_set_in(node: Element, names: set[str], contents: Contents) -> set[str] | None:
    """Return names and those that a link sets at its beginning; None if it sets them elsewhere."""
    if node.name != "link":
        return None
    try:
        return names | contents.first_setters(node)[1]
    except UnknownContent:
        return None


def _paired(run: list[Node], endings: Endings) -> Iterator[Step]:
    if not any(isinstance(node, Element) and node.name == "joint" for node in run):
        for node in run:
            yield Step(node)
        return
    items, loose = pair(run, endings)
    for item in items:
        for above in item.above:
            yield Step(above)
        yield Step(item.element, item.joint, is_joint_first=item.is_joint_first)
        for beside in item.beside:
            yield Step(beside)
    for below in loose:
        yield Step(below)


def stands_as_key(element: Element) -> bool:
    """Return whether an element says the same where it is read as a key of a part.

    Else it has to be in angle brackets there.
    """
    attributes = values_of(element)
    children = [child for child in element.children if not isinstance(child, Comment)]
    elements = element.elements()
    if has_text(element):
        return False
    match element.name:
        case "origin":
            return (
                sorted(attributes) == ["rpy", "xyz"]
                and not elements
                and all(are_numbers(row, 3) for row in attributes.values())
            )
        case "axis":
            return (
                list(attributes) == ["xyz"] and not elements and are_numbers(attributes["xyz"], 3)
            )
        case "material":
            return is_short_material(element) and bool(attributes["name"])
        case "inertial":
            names = [child.name for child in elements]
            return (
                not attributes
                and sorted(names) == ["inertia", "mass", "origin"]
                and all(map(stands_as_key, elements))
                and len(children) == len(elements)
            )
        case "mass" | "inertia":
            wanted = ("value",) if element.name == "mass" else MOMENTS
            return (
                sorted(attributes) == sorted(wanted)
                and not elements
                and all(are_numbers(value, 1) for value in attributes.values())
            )
    return element.name not in PART_KEYS


class XacroPartWriter(PartWriter):
    """Writes one part, in which statements may stand."""

    def __init__(
        self,
        host: Host,
        translate: Callable[[str], str],
        contents: Contents,
        solids: Solids,
        around: Macro | None,
        *,
        exact: bool,
        constants: Mapping[str, float],
    ) -> None:
        """Take what the part is in.

        Args:
            host: writes the file.
            translate: gives a text of xacro in the language's spelling.
            contents: knows what statements make.
            solids: the macros that give the inertia of a solid.
            around: the macro that the part is in.
            exact: whether an origin that is missing has to stay missing.
            constants: the numbers that names always have.
        """
        self._host = host
        self._translate = translate
        self._contents = contents
        self._solids = solids
        self._inertias: dict[int, SolidInertia] = {}
        self._around = around
        self._originals: dict[int, tuple[Element, Element]] = {}
        self._known: dict[int, Counts] = {}
        self._has_one_inertial = False
        elements = _PartElements(host, self._originals)
        super().__init__(
            elements, Names([]), material_entry, resolves=True, exact=exact, constants=constants
        )

    def entry(self, link: Element, joint: Element | None, *, joint_first: bool) -> Entry | None:
        """Return a joint and a link as a part, or None if they are more than a part can say."""
        link, self._inertias = self._solids.without_calls(link)
        try:
            own = self.spelled(link)
            above = self.spelled(joint) if joint is not None else None
            if above is not None:
                self._check_joint(above)
            part = self.part(own, above, joint_first=joint_first)
        except NoPart:
            return None
        self._solids.replaced |= {each.source.macro.name for each in self._inertias.values()}
        return part

    def write_piece(self, element: Element, out: Body) -> bool:
        """Write an element that is in parts only with their keys, and return whether it can be."""
        own = self.spelled(element)
        blank = super()._plan(Element("link", element.span))
        try:
            match own.name:
                case "origin" if pose_of(own, exact=self._exact) is not None:
                    note_pose(own, out, lambda: PartWriter._add_pose(self, own, own, out))
                case "inertial" if self._has_form(own):
                    out.append(self._inertial(own, blank))
                case "visual" | "collision" if self._has_form(own):
                    out.append(self._section(own, blank))
                case "axis" if stands_as_key(own):
                    out.add("axis", values_of(own)["xyz"])
                case "inertia" if stands_as_key(own):
                    moments = values_of(own)
                    out.add("inertia", " ".join(moments[name] for name in MOMENTS))
                case "limit" | "dynamics" | "safety_controller" if not own.children:
                    out.append(self._joint_entry_of(own, values_of(own), "$("))
                case "material":
                    out.append(self._section_child(own))
                case _:
                    return False
        except NoPart:
            return False
        return True

    def spelled(self, element: Element) -> Element:
        """Return a copy in the language's spelling, except for the statements in it."""
        children: list[Node] = []
        for child in element.children:
            if isinstance(child, Text):
                children.append(Text(self._translate(format_value(child.value)), child.span))
            elif isinstance(child, Element) and not is_statement(child):
                children.append(self.spelled(child))
            else:
                children.append(child)
        copy = element.with_children(children)
        copy.attributes = {
            name: self._translate(value) for name, value in values_of(element).items()
        }
        self._originals[id(copy)] = copy, element
        return copy

    # --- what statements make -------------------------------------------------------------------

    def _counts(self, owner: Element) -> Counts:
        """Return how many elements of each name are in an element."""
        if id(owner) not in self._known:
            try:
                if owner.name == "link":
                    self._contents.first_setters(self._originals[id(owner)][1])
                elif self._contents.sets_variables(owner):
                    raise NoPart  # what reads them may be written before them
                counts = self._contents.counts(owner.children, self._around)
            except UnknownContent:
                raise NoPart from None
            self._known[id(owner)] = counts
        return self._known[id(owner)]

    def _given(self, owner: Element) -> Counts:
        """Return how many of them come from statements."""
        statements = [child for child in owner.elements() if is_statement(child)]
        try:
            return self._contents.counts(statements, self._around)
        except UnknownContent:
            raise NoPart from None

    def _check_joint(self, joint: Element) -> None:
        """Refuse a joint that may lack a limit, or that statements give more than a part takes."""
        kind = format_value(joint.attributes.get("type"))
        counts = self._counts(joint)
        if "$(" not in kind and kind not in JOINT_TYPES:
            raise NoPart
        if kind not in WITHOUT_LIMIT and not counts.get("limit", (0, 0))[0]:
            raise NoPart  # it would be filled in
        if STRUCTURE & self._given(joint).keys() or _may_repeat(counts, "origin", "axis"):
            raise NoPart

    def _count_first(self, link: Element) -> int:
        return self._contents.first_setters(self._originals[id(link)][1])[0]

    def _write_all(self, owner: Element, body: Body, write: Write, of: range | None = None) -> None:
        def place(original: Element, out: Body) -> None:
            child = self.spelled(original)
            if child.name == "origin":
                self._add_given_origin(owner, child, out)
            else:
                write(child, out)

        original = self._originals[id(owner)][1]  # its texts show where lines end
        endings = comments_at_ends(original.children)
        for child in owner.children if of is None else [owner.children[each] for each in of]:
            if not isinstance(child, Element):
                add_loose(child, body, endings)
            elif is_statement(child):
                is_looks = owner.name != "visual" and "material" in self._made_by(child)
                self._host.write_statement(child, body, place, has_keys=not is_looks)
            else:
                write(child, body)

    def _made_by(self, statement: Element) -> Counts:
        """Return how many elements of each name a statement makes, if that is known."""
        try:
            return self._contents.counts([statement], self._around)
        except UnknownContent:
            return {}

    # --- poses ----------------------------------------------------------------------------------

    def _add_pose(self, owner: Element, origin: Element | None, body: Body) -> None:
        if origin is None and owner.name != "link" and self._is_origin_given(owner):
            return
        super()._add_pose(owner, origin, body)

    def _add_given_origin(self, owner: Element, origin: Element, out: Body) -> None:
        """Add an origin that is in a condition."""
        if not self._exact or self._is_origin_given(owner):
            super()._add_pose(owner, origin, out)
        else:
            bracketed = not stands_as_key(origin)
            out.append(self._elements.entry(origin, bracketed=bracketed))

    def _is_origin_given(self, owner: Element) -> bool:
        """Return whether statements give exactly one origin, whatever the arguments are."""
        return self._counts(owner).get("origin") == (1, 1)

    # --- joints and links -----------------------------------------------------------------------

    def _is_first(self, child: Element, owner: Element, seen: dict[str, Element]) -> bool:
        return not _may_repeat(self._counts(owner), child.name)

    def _has_form(self, section: Element) -> bool:
        if self._solid(section) is None and not super()._has_form(section):
            return False
        try:
            counts, given = self._counts(section), self._given(section)
        except NoPart:
            return False
        return not STRUCTURE & given.keys() and not _may_repeat(counts, "origin", "material")

    def _plan(self, link: Element) -> LinkPlan:
        counts, given = self._counts(link), self._given(link)
        self._has_one_inertial = not _may_repeat(counts, "inertial")
        plan = super()._plan(link)
        if not self._has_one_inertial and (plan.inertial is not None or "inertial" in given):
            raise NoPart
        if {"origin", "mass"} & given.keys():
            raise NoPart  # they are keys of a link
        sections = [child for child in link.elements() if child.name in SECTIONS]
        if set(SECTIONS) & given.keys() or any(map(self._may_be_placed, sections)):
            plan.pose = None
        return plan

    def _may_be_placed(self, section: Element) -> bool:
        """Return whether a statement in a section may give its origin."""
        return self._has_form(section) and "origin" in self._given(section)

    def _section(self, section: Element, plan: LinkPlan) -> Entry:
        is_shape = section.name in ("visual", "collision")
        if is_shape and id(section) not in plan.sections and self._has_form(section):
            plan.sections[id(section)] = read_geometry(section, self._elements.file_name)
        return super()._section(section, plan)

    def _is_short_inertial(self, inertial: Element, plan: LinkPlan) -> bool:
        if plan.inertial is not None or not self._has_one_inertial:
            return inertial is plan.inertial
        return self._has_form(inertial)

    # --- inertia --------------------------------------------------------------------------------

    def _solid(self, inertial: Element) -> Geometry | None:
        """Return the solid whose inertia a call gave, in the language's spelling."""
        original = self._originals[id(inertial)][1]
        inertia = self._inertias.get(id(original))
        if inertia is None:
            return None
        scale = " ".join(map(self._translate, inertia.sizes))
        return Geometry(inertia.kind, inertia.kind, scale)

    def _is_solid(self, inertial: Element, geometry: Geometry) -> bool:
        solid = self._solid(inertial)
        if solid is None:
            return super()._is_solid(inertial, geometry)
        return solid.kind == geometry.kind and are_equal(solid.sizes(), geometry.sizes())

    def _inertia(self, inertial: Element) -> list[Entry]:
        solid = self._solid(inertial)
        return super()._inertia(inertial) if solid is None else solid.entries()


class _PartElements(ElementWriter):
    """Writes elements in a part, by the file's writer if there are statements in them."""

    __slots__ = ("_host", "_originals")

    def __init__(self, host: Host, originals: dict[int, tuple[Element, Element]]) -> None:
        super().__init__(lambda file: file)
        self._host = host
        self._originals = originals

    def entry(self, element: Element, *, bracketed: bool = False) -> Entry:
        if any(map(is_statement, element.iter())):
            return self._host.entry(self._originals[id(element)][1], bracketed=bracketed)
        return super().entry(element, bracketed=bracketed)


def is_statement(element: Element) -> bool:
    """Return whether an element is one of xacro."""
    return element.name.startswith("xacro:")


def note_pose(origin: Element, out: Body, write: Callable[[], None]) -> None:
    """Write the keys of an origin below what is remarked at it."""
    known = len(out.entries)
    remark, out.remark = out.remark, ""
    write()
    if len(out.entries) > known:
        out.entries[known].comment = remark
        out.latest = out.entries[-1]
        note_comments(origin, out.entries[known])
    else:
        out.note(remark)


def _may_repeat(counts: Counts, *names: str) -> bool:
    return any(counts.get(name, (0, 0))[1] > 1 for name in names)
