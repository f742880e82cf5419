"""Which joints and links of a xacro file are written as parts, and how.

What is in them may be statements of xacro: conditions, calls, blocks. They are in the part in
turn, where all that they make is the same as in an element. Where that is not known for
all arguments, the joint or link stays an element.
"""

from __future__ import annotations

from itertools import permutations

from ....model.schema import JOINT_TYPES, MOMENTS
from ....model.values import values_of
from ....xacro.faults import Fault
from ....xacro.templates import Expression, parse_template
from ....xml.tree import Comment, Element, Text
from ....xml.values import format_value
from ..document import Body, Entry
from ..elements import ElementWriter, add_loose, comments_at_ends, has_text, note_comments, pair
from ..formulas import SIZES, NotComputed, Sample, are_equal, is_inertia_of, key_of, samples
from ..parts import (
    PART_KEYS,
    SECTIONS,
    Geometry,
    NoPart,
    PartWriter,
    ShortNames,
    are_numbers,
    is_short_material,
    material_entry,
    pose_of,
    read_geometry,
)
from .contents import UnknownContent

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping
    from typing import Protocol

    from ....xml.tree import Node
    from ..elements import Endings
    from ..parts import LinkPlan
    from .contents import Contents, Counts
    from .program import Macro, XacroProgram
    from .statements import Surroundings

    Write = Callable[[Element, Body], None]

    class Host(Protocol):
        """Writes the file that a part is in, and knows the robot."""

        program: XacroProgram
        contents: Contents
        solids: Solids
        here: Surroundings

        def translate(self, text: str) -> str:
            """Return a text of xacro in the language's spelling."""

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

    def __init__(self, host: Host) -> None:
        """Stand where the file's writer stands."""
        self._host = host
        self._translate = host.translate
        self._contents = host.contents
        self._solids = host.solids
        self._inertias: dict[int, SolidInertia] = {}
        self._around = host.here.macro
        self._originals: dict[int, tuple[Element, Element]] = {}
        self._known: dict[int, Counts] = {}
        self._has_one_inertial = False
        elements = _PartElements(host, self._originals)
        super().__init__(
            elements,
            ShortNames([]),
            material_entry,
            resolves=True,
            exact=host.program.exact,
            constants=host.program.known_numbers,
        )

    def entry(self, link: Element, joint: Element | None, *, joint_first: bool) -> Entry | None:
        """Return a joint and a link as a part, or None if they are more than a part can say."""
        link, self._inertias = self._solids.without_calls(link)
        try:
            own = self.spelled(link)
            above = self.spelled(joint) if joint is not None else None
            if above is not None:
                # refused: it may lack a limit, or statements give it more than a part takes
                kind = format_value(above.attributes.get("type"))
                counts = self._counts(above)
                if "$(" not in kind and kind not in JOINT_TYPES:
                    raise NoPart
                if kind not in WITHOUT_LIMIT and not counts.get("limit", (0, 0))[0]:
                    raise NoPart  # it would be filled in
                if STRUCTURE & self._given(above).keys() or _may_repeat(counts, "origin", "axis"):
                    raise NoPart
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
        if set(SECTIONS) & given.keys() or any(  # a statement may give an origin
            self._has_form(section) and "origin" in self._given(section) for section in sections
        ):
            plan.pose = None
        return plan

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


# --- macros that compute the inertia of a solid, and what a call of one says in a part --------


class SolidMacro:
    """A macro that gives the inertia of a solid.

    Attributes:
        macro: the macro.
        kind: of the solid.
        mass, sizes: the parameters that are its mass and its sizes.
        inertial: the `<inertial>` that it gives, or None if it gives no more than `<inertia>`.
    """

    def __init__(
        self,
        macro: Macro,
        kind: str,
        mass: str,
        sizes: tuple[str, ...],
        inertial: Element | None,
    ) -> None:
        self.macro = macro
        self.kind = kind
        self.mass = mass
        self.sizes = sizes
        self.inertial = inertial

    def read(self, call: Element) -> SolidInertia | None:
        """Return what a call of it says, or None if that is not to be seen."""
        given = self._arguments(call)
        if given is None:
            return None
        children: list[Node] | None = []
        if self.inertial is not None:
            children = self._children(call, given)
        if children is None:
            return None
        sizes = [given[name] for name in self.sizes]
        return SolidInertia(self, given[self.mass], sizes, children)

    def _arguments(self, call: Element) -> dict[str, str] | None:
        """Return the texts that the parameters get: those of the call, or plain defaults."""
        given = values_of(call)
        for own in self.macro.parameters:
            if own.is_block or own.name in given:
                continue
            if own.is_forwarded or own.default is None or "$" in own.default:
                return None
            given[own.name] = own.default.strip("'")
        if set(given) != set(self.macro.values()):
            return None
        sample = samples()[0]
        try:
            numbers = [sample.number(given[name]) for name in (self.mass, *self.sizes)]
        except NotComputed:
            return None
        is_number = ["$" not in given[name] for name in (self.mass, *self.sizes)]
        if any(number <= 0 and plain for number, plain in zip(numbers, is_number, strict=True)):
            return None
        return given

    def _children(self, call: Element, given: Mapping[str, str]) -> list[Node] | None:
        """Return what is in the `<inertial>` beside the inertia, as the call makes it."""
        assert self.inertial is not None
        blocks = call.elements()
        children: list[Node] = []
        for child in self.inertial.elements():
            if child.name == "xacro:insert_block":
                if len(blocks) != 1 or len(self.macro.blocks()) != 1:
                    return None
                children.append(blocks[0])
            elif child.name == "inertia":
                continue
            else:
                texts = {key: _filled_in(text, given) for key, text in values_of(child).items()}
                attributes = {key: text for key, text in texts.items() if text is not None}
                if len(attributes) < len(texts) or child.elements():
                    return None
                children.append(Element(child.name, call.span, dict(attributes)))
        return children


class SolidInertia:
    """The inertia of a solid as a call gives it, in texts of xacro.

    Attributes:
        source: the macro that is called.
        mass: of the solid.
        sizes: its sizes.
        children: what is beside the inertia in the `<inertial>` that the call gives.
    """

    def __init__(
        self, source: SolidMacro, mass: str, sizes: list[str], children: list[Node]
    ) -> None:
        self.source = source
        self.mass = mass.strip()
        self.sizes = [size.strip() for size in sizes]
        self.children = children

    @property
    def kind(self) -> str:
        """The kind of the solid."""
        return self.source.kind


class Solids:
    """The macros of a robot that give the inertia of a solid."""

    def __init__(self, program: XacroProgram) -> None:
        """Look at all macros; one that is defined twice does not count."""
        self._macros: dict[str, SolidMacro] = {}
        names = [macro.name for macro in program.definitions.values()]
        for macro in program.definitions.values():
            found = solid_macro(macro) if names.count(macro.name) == 1 else None
            if found is not None:
                self._macros[macro.name] = found
        self.replaced: set[str] = set()

    def __bool__(self) -> bool:
        """Return whether there are any."""
        return bool(self._macros)

    def without_calls(self, link: Element) -> tuple[Element, dict[int, SolidInertia]]:
        """Return a link whose inertials have no inertia where a call of such a macro gives it.

        Returns:
            the link, and the inertia of each such inertial, by identity.
        """
        found: dict[int, SolidInertia] = {}
        if not self:
            return link, found
        children: list[Node] = []
        for child in link.children:
            made = self._inertial(child) if isinstance(child, Element) else None
            if made is None:
                children.append(child)
                continue
            inertial, inertia = made
            found[id(inertial)] = inertia
            children.append(inertial)
        return (link.with_children(children) if found else link), found

    def _inertial(self, node: Element) -> tuple[Element, SolidInertia] | None:
        if node.name != "inertial":
            inertia = self._read(node)
            if inertia is None or inertia.source.inertial is None:
                return None
            return Element("inertial", node.span, {}, inertia.children), inertia
        mass = next((child for child in node.elements() if child.name == "mass"), None)
        for child in node.elements():
            inertia = self._read(child)
            if inertia is None or inertia.source.inertial is not None or mass is None:
                continue
            if are_equal([values_of(mass).get("value", "")], [inertia.mass]):
                return node.with_children([n for n in node.children if n is not child]), inertia
        return None

    def _read(self, call: Element) -> SolidInertia | None:
        macro = self._macros.get(call.name.removeprefix("xacro:"))
        return macro.read(call) if macro is not None and call.name.startswith("xacro:") else None


def solid_macro(macro: Macro) -> SolidMacro | None:
    """Return what solid's inertia a macro gives, and by which parameters; None for any other."""
    # the one element that has nothing beside it but comments
    elements = [node for node in macro.element.children if isinstance(node, Element)]
    texts = [node for node in macro.element.children if not isinstance(node, (Element, Comment))]
    has_text = any(isinstance(t, Text) and format_value(t.value).strip() for t in texts)
    content = elements[0] if len(elements) == 1 and not has_text else None
    if content is None or (content.attributes and content.name == "inertial"):
        return None
    inertia, own_mass = content, None
    if content.name == "inertial":
        parts = {child.name: child for child in content.elements()}
        if len(parts) != len(content.elements()) or not {"mass", "inertia"} <= parts.keys():
            return None
        if parts.keys() - {"mass", "inertia", "origin", "xacro:insert_block"} or len(parts) > 3:
            return None
        text = values_of(parts["mass"]).get("value", "").strip()
        own_mass = text[2:-1].strip() if text.startswith("${") and text.endswith("}") else ""
        if own_mass not in macro.values():
            return None
        inertia = parts["inertia"]
    moments = values_of(inertia)
    if inertia.name != "inertia" or sorted(moments) != sorted(MOMENTS) or inertia.elements():
        return None
    found = _roles(macro, [moments[name] for name in MOMENTS], own_mass)
    if found is None:
        return None
    kind, mass, sizes = found
    return SolidMacro(macro, kind, mass, sizes, content if content is not inertia else None)


def _roles(
    macro: Macro, moments: list[str], own_mass: str | None
) -> tuple[str, str, tuple[str, ...]] | None:
    """Return the kind of solid, and which parameters are its mass and its sizes."""
    names = _read_by(moments, macro)
    if names is None:
        return None
    for kind, count in SIZES.items():
        if len(names) != count + 1:
            continue
        for mass, *sizes in permutations(names):
            if own_mass not in (None, mass):
                continue
            words = [f"${{{name}}}" for name in sizes]
            if is_inertia_of(kind, words, f"${{{mass}}}", moments):
                return kind, mass, tuple(sizes)
    return None


def _read_by(moments: Iterable[str], macro: Macro) -> list[str] | None:
    """Return the parameters that formulas read; None if they read anything else."""
    sample: Sample = samples()[0]
    try:
        for moment in moments:
            sample.number(moment)
    except NotComputed:
        return None
    keys = {key_of(name): name for name in macro.values() if name.isidentifier()}
    if not sample.values.keys() <= keys.keys():
        return None
    return [keys[key] for key in sample.values]


def _filled_in(text: str, given: Mapping[str, str]) -> str | None:
    """Return a text with arguments in place of parameters; None if it computes with any name."""
    pieces: list[str] = []
    try:
        parts = parse_template(text).parts
    except Fault:
        return None
    for part in parts:
        if isinstance(part, str):
            pieces.append(part)
        elif isinstance(part, Expression) and part.text.strip() in given:
            pieces.append(given[part.text.strip()])
        else:
            return None
    return "".join(pieces)
