"""A joint and a link of URDF as a `part`, in its short forms wherever they say the same."""

from __future__ import annotations

from ...meshes.formats import mesh_ending
from ...model.compare import POSE, ZEROS, same_words
from ...model.inertia import MESH_ENDINGS
from ...model.schema import ELEMENTS, MOMENTS, RECORDS
from ...model.shapes import COUNTS, SIMPLE_SHAPES
from ...model.shapes import SIZES as ALL_SIZES
from ...model.values import values_of
from ...robot.fields import HOMES, PLACES
from ...robot.notes import JOINT_WORDS, LINK_WORDS
from ...syntax.names import RAW_BLOCKS
from ...xml.tree import Element, Text
from ...xml.values import format_value
from .document import RECORD_WIDTH, Body, Entry, joined, spaced, without_expressions, words_of
from .elements import ElementWriter, add_loose, comments_at_ends, has_text, name_of, note_comments
from .formulas import Degrees, is_inertia_of
from .spelling import QUATERNION

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence, Set


# --- geometry, poses, materials and inertials in short ----------------------------------------


SIZES = {kind: shape.attributes for kind, shape in SIMPLE_SHAPES.items() if shape.since == "1.0"}


class NoPart(Exception):
    """A joint or link has something that no part gives."""


LONGEST_ANGLE = 10
"""How long an angle may be that is written where the source has a quaternion."""
UNITS_OF_MESHES = {
    " ".join([factor] * 3): f"1{unit}" for factor, unit in (("0.001", "mm"), ("0.01", "cm"))
}
"""What a scale says of the unit of a mesh, in the spelling that the unit has in URDF."""


class Geometry:
    """A shape in its short form.

    Attributes:
        word: the word of the shape, or the name of a mesh file in the language's spelling.
        scale: its numbers, as one text; None for a mesh without one.
        has_named_sizes: whether the sizes of a shape have a key each, in place of `scale`.
    """

    __slots__ = ("has_named_sizes", "kind", "scale", "word")

    def __init__(
        self, kind: str, word: str, scale: str | None, *, has_named_sizes: bool = False
    ) -> None:
        """Hold them; `kind` is the name of the URDF element."""
        self.kind = kind
        self.word = word
        self.scale = scale
        self.has_named_sizes = has_named_sizes

    def key(self) -> tuple[str, str | None]:
        """Return a value that is equal for equal geometries."""
        return self.word, self.scale

    def entries(self) -> list[Entry]:
        """Return the entries that say it."""
        entries = [Entry("geometry", self.word)]
        if self.has_named_sizes and self.kind in ALL_SIZES:
            names = ALL_SIZES[self.kind]
            words = self.sizes()
            rows = [self.scale or ""] if len(names) < len(words) else words
            entries += [Entry(name, row) for name, row in zip(names, rows, strict=True)]
        elif self.scale is not None:
            unit = UNITS_OF_MESHES.get(self.scale) if self.kind == "mesh" else None
            entries.append(Entry("scale", unit or self.scale))
        return entries

    def sizes(self) -> list[str]:
        """Return the numbers of the scale, each as a word."""
        return words_of(self.scale or "")


def pose_of(origin: Element | None, *, exact: bool) -> dict[str, str] | None:
    """Return `xyz` and `rpy` of an origin, zeros where it says nothing; None if that is not all.

    The quaternion is there as well if the source has the rotation as one.

    With `exact`, an origin that says nothing of one of them is not the same as zeros.
    """
    attributes = {} if origin is None else values_of(origin)
    if (origin is not None and origin.children) or attributes.keys() - {*POSE, QUATERNION}:
        return None
    if exact and not set(POSE) <= attributes.keys():
        return None
    return dict.fromkeys(POSE, ZEROS) | attributes


def _is_same(one: Mapping[str, str], other: Mapping[str, str]) -> bool:
    return all(same_words(one[key], other[key]) for key in POSE)


class CommonPose:
    """The origin that all sections of a link have, or that none of them has."""

    def __init__(self, origin: Element | None) -> None:
        self.origin = origin


class LinkPlan:
    """What the sections of a link share, and so is in the link.

    Attributes:
        geometry: the geometry of the link, if there is one.
        pose: what all sections have for an origin.
        inertial: the inertial that is written in the short form.
        sections: the visuals and collisions in the short form, by identity, with their geometry;
            None where that has a form of its own.
        has_computed_inertia: whether the inertia is that of the geometry.
    """

    def __init__(
        self,
        link: Element,
        file_name: Callable[[str], str],
        has_form: Callable[[Element], bool],
        is_solid: Callable[[Element, Geometry], bool],
        *,
        exact: bool,
        sizes: Mapping[str, Sequence[str]] | None = None,
    ) -> None:
        """Look at a link.

        Args:
            link: to look at.
            file_name: spells the names of mesh files.
            has_form: decides which of its sections have a short form.
            is_solid: decides whether an inertial has the inertia of a geometry.
            exact: whether an origin that is missing has to stay missing.
            sizes: the shapes that may be named, each with its sizes, which have a key each then; by
                default those of URDF 1.0, with `scale`.
        """
        self._is_solid = is_solid
        self._exact = exact
        self.sections: dict[int, Geometry | None] = {}
        self.geometry: Geometry | None = None
        self.pose: CommonPose | None = None
        self.inertial: Element | None = None
        self.has_computed_inertia = False
        posed: list[Element] = []
        for child in link.elements():
            if child.name in ("visual", "collision") and has_form(child):
                self.sections[id(child)] = read_geometry(child, file_name, sizes)
                posed.append(child)
            elif child.name == "inertial" and self.inertial is None and has_form(child):
                self.inertial = child
                posed.append(child)
        self._choose_geometry()
        if len(posed) < 2:
            return
        origins = [optional_child(section, "origin") for section in posed]
        if self._exact and not any(origins):
            self.pose = CommonPose(None)
        first, *others = (pose_of(origin, exact=self._exact) for origin in origins)
        if first is None or not all(pose and _is_same(pose, first) for pose in others):
            return
        if not all(same_words(first[key], ZEROS) for key in POSE):
            said = (o for o in origins if o is not None and QUATERNION in o.attributes)
            self.pose = CommonPose(next(said, origins[0]))

    def _choose_geometry(self) -> None:
        counts: dict[tuple[str, str | None], int] = {}
        known: dict[tuple[str, str | None], Geometry] = {}
        for geometry in self.sections.values():
            if geometry is not None:
                known.setdefault(geometry.key(), geometry)
                counts[geometry.key()] = counts.get(geometry.key(), 0) + 1
        for key, geometry in known.items():
            if self.inertial is not None and self._is_solid(self.inertial, geometry):
                self.geometry = geometry
                self.has_computed_inertia = True
                return
            if counts[key] > 1 and (
                self.geometry is None or counts[key] > counts[self.geometry.key()]
            ):
                self.geometry = geometry


def read_geometry(
    section: Element,
    file_name: Callable[[str], str],
    sizes: Mapping[str, Sequence[str]] | None = None,
) -> Geometry | None:
    """Return the geometry of a visual or collision, or None if it has no short form."""
    geometry = child_named(section, "geometry")
    shapes = geometry.elements()
    if len(shapes) != 1 or has_text(geometry):
        return None
    shape = shapes[0]
    attributes = values_of(shape)
    if shape.children or geometry.attributes:
        return None
    if shape.name == "mesh":
        file = attributes.get("filename", "")
        if set(attributes) - {"filename", "scale"} or mesh_ending(file) not in MESH_ENDINGS:
            return None
        scale = attributes.get("scale")
        return Geometry("mesh", file_name(file), None if scale is None else numbers_of(scale, 3))
    names = (SIZES if sizes is None else sizes).get(shape.name)
    if names is None or sorted(attributes) != sorted(names):
        return None
    words = numbers_of(" ".join(attributes[name] for name in names), COUNTS[shape.name])
    return Geometry(shape.name, shape.name, words, has_named_sizes=sizes is not None)


def is_short_material(material: Element) -> bool:
    """Return whether a material is a name, at most with a colour and a texture."""
    attributes = values_of(material)
    if list(attributes) != ["name"] or has_text(material):
        return False
    if attributes["name"] and not is_word(attributes["name"]):
        return False
    children = [child for child in material.children if not isinstance(child, Text)]
    names = [child.name if isinstance(child, Element) else "" for child in children]
    if sorted(names) not in ([], ["color"], ["texture"], ["color", "texture"]):
        return False
    wanted = {"color": "rgba", "texture": "filename"}
    return all(
        isinstance(child, Element)
        and not child.children
        and list(values_of(child)) == [wanted[child.name]]
        and (
            are_numbers(values_of(child)["rgba"], 4)
            if child.name == "color"
            else bool(without_expressions(values_of(child)["filename"]).replace("$()", "").strip())
        )
        for child in children
    )


def material_entry(
    material: Element, file_name: Callable[[str], str] = lambda file: file
) -> Entry | None:
    """Return a material in short: its name, with its colour and texture; None for any other."""
    if not is_short_material(material):
        return None
    name = values_of(material)["name"]
    looks = [
        Entry(look.name, file_name(" ".join(words_of(format_value(value)))))
        for look in material.elements()
        for value in values_of(look).values()
    ]
    if not looks:
        return Entry("material", name) if name else None
    if not name:
        return Entry("material/name=", Body(looks, in_braces=True))
    return Entry("material", Body([Entry("name", name), *looks], in_braces=True))


def child_named(element: Element, name: str) -> Element:
    """Return the child of a name, which there is."""
    return next(child for child in element.elements() if child.name == name)


def optional_child(element: Element, name: str) -> Element | None:
    """Return the child of a name, or None."""
    return next((child for child in element.elements() if child.name == name), None)


def has_section_form(section: Element) -> bool:
    """Return whether a visual or collision has only a shape, and a pose at most."""
    return not has_text(section) and _once(section, ("geometry",), ("origin",))


def has_mass_form(inertial: Element) -> bool:
    """Return whether an inertial has a mass and six moments, and a pose at most."""
    if inertial.attributes or has_text(inertial):
        return False
    if not _once(inertial, ("mass", "inertia"), ("origin",)):
        return False
    mass, inertia = child_named(inertial, "mass"), child_named(inertial, "inertia")
    return (
        list(values_of(mass)) == ["value"]
        and sorted(values_of(inertia)) == sorted(MOMENTS)
        and not mass.children
        and not inertia.children
        and are_numbers(values_of(mass)["value"], 1)
        and all(are_numbers(values_of(inertia)[name], 1) for name in MOMENTS)
    )


def _once(element: Element, names: Iterable[str], optional: Iterable[str]) -> bool:
    found = [child.name for child in element.elements()]
    return all(found.count(name) == 1 for name in names) and all(
        found.count(name) <= 1 for name in optional
    )


def is_whole_limit(limit: dict[str, str], kind: str) -> bool:
    """Return whether a limit has all that would else be filled in."""
    has_range = (
        (kind not in ("revolute", "prismatic") and "$(" not in kind)
        or "lower" in limit
        or "upper" in limit
    )
    return has_range and "effort" in limit and "velocity" in limit


def numbers_of(text: str, count: int) -> str:
    """Return a text of `count` numbers with single spaces; raise NoPart if it is another."""
    if not are_numbers(text, count):
        raise NoPart
    return " ".join(words_of(text))


def are_numbers(text: str, count: int) -> bool:
    """Return whether a text is `count` numbers, as far as that is known of expressions."""
    words = words_of(text)
    if len(words) != count:
        return len(words) == 1 and words[0].startswith("$(")
    return all(map(_may_be_number, words))


def _may_be_number(word: str) -> bool:
    if "$(" in word:
        return True
    try:
        number = float(word)
    except ValueError:
        return False
    return number - number == 0


def checked_word(name: str) -> str:
    """Return a name that is one word; raise NoPart if it is not."""
    if not is_word(name):
        raise NoPart
    return name


def is_word(name: str) -> bool:
    """Return whether the language reads a name as one word."""
    return "," not in without_expressions(name) and words_of(name) == [name]


# --- parts ------------------------------------------------------------------------------------


SECTIONS = ("visual", "collision", "inertial")
PART_KEYS = frozenset().union(
    *(place.all_keys for place in PLACES), *HOMES.values(), LINK_WORDS, JOINT_WORDS, RAW_BLOCKS
)
"""Names that mean something in a part, or are reported there as misplaced."""


class ShortNames:
    """The names that parts may be called by in place of their links and joints."""

    __slots__ = ("joints", "links", "naming", "of_joints", "of_links")

    def __init__(
        self, elements: list[Element], naming: tuple[str, str] = ("*_joint", "*_link")
    ) -> None:
        """Take what a robot holds, and how joints and links are named after parts."""
        self.naming = naming
        self.links = {name_of(e) for e in elements if e.name == "link"}
        self.joints = {name_of(e) for e in elements if e.name == "joint"}
        self.of_links: dict[str, str] = {}
        self.of_joints: dict[str, str] = {}

    def add(self, link: Element, joint: Element | None) -> str | None:
        """Return what a part is called if one name gives both of its own, and remember it."""
        stem = self.stem(link, joint)
        if stem is None:
            return None
        if stem not in self.links:
            self.of_links[name_of(link)] = stem
        if joint is not None and stem not in self.joints:
            self.of_joints[name_of(joint)] = stem
        return stem

    def stem(self, link: Element, joint: Element | None) -> str | None:
        """Return the one name that gives a link and its joint theirs, or None."""
        of_joints, of_links = self.naming
        before, _, after = of_links.partition("*")
        name = name_of(link)
        stem = name[len(before) : len(name) - len(after)]
        if not stem or before + stem + after != name:
            return None
        is_own = joint is None or name_of(joint) == of_joints.replace("*", stem)
        return stem if is_own else None

    def remove(self, link: Element, joint: Element | None) -> None:
        """Forget what is not a part."""
        self.of_links.pop(name_of(link), None)
        if joint is not None:
            self.of_joints.pop(name_of(joint), None)


class PartWriter:
    """Writes parts of one robot."""

    def __init__(
        self,
        elements: ElementWriter,
        names: ShortNames,
        material: Callable[[Element], Entry | None],
        *,
        resolves: bool = False,
        exact: bool = False,
        constants: Mapping[str, float] | None = None,
    ) -> None:
        """Take what writes elements, the names, and what writes a material in short, or None.

        With `exact`, an origin, or a value of one, that is missing is kept missing. `constants`
        are the numbers that names in expressions always have.
        """
        self._degrees = Degrees(constants or {})
        self._elements = elements
        self._names = names
        self._material = material
        self._resolves = resolves
        self._exact = exact

    def part(self, link: Element, joint: Element | None, *, joint_first: bool) -> Entry:
        """Return a part, or a link that holds nothing as the element that it is.

        Raises:
            NoPart: it cannot be written as one.
        """
        has_odd_name = self._check_names(link, joint)
        words = self._words_of_link(link)
        is_empty = not link.elements() and not words
        if joint is None and is_empty:
            return self._elements.entry(link)
        body = Body(in_braces=is_empty)
        own_name = self._names.add(link, joint)
        link_key = "link"
        if own_name is not None:
            body.add("name", own_name)
        elif joint is None or has_odd_name:
            link_key = self._elements.key("link", {"name": name_of(link)})
        else:
            body.add("name", f"{name_of(joint)} {name_of(link)}")
        others = {key: value for key, value in values_of(link).items() if key != "name"}
        if others:
            if link_key != "link":
                others = {"name": name_of(link), **others}
            link_key = self._elements.key("link", others)
        entries = []
        if not is_empty or others or link_key != "link":
            inner = self._link(link) or Body()
            inner.entries += words
            entries.append(Entry(link_key, inner or None))
        if joint is not None:
            named = {"name": name_of(joint)} if has_odd_name else {}
            entries.insert(0 if joint_first else len(entries), self._joint_entry(joint, named))
        body.entries += entries
        part = Entry("part", body)
        if is_empty and not others:
            note_comments(link, part)
        return part

    def _check_names(self, link: Element, joint: Element | None) -> bool:
        """Return whether a name cannot be a word of the name of a part.

        Raises:
            NoPart: then it is not written as a part.
        """
        checked_word(name_of(link))
        if joint is not None and self._names.stem(link, joint) is None:
            checked_word(name_of(joint))
        return False

    def _words_of_link(self, link: Element) -> list[Entry]:
        """Return the words in a link that make no elements of it."""
        return []

    def _words_of_joint(self, joint: Element) -> list[Entry]:
        """Return the words in a joint that make no elements of it."""
        return []

    def _words_of_section(self, section: Element) -> list[Entry]:
        """Return the words in a visual or collision that make no elements of it."""
        return []

    def words_of_frame(self, link: Element) -> list[Entry] | None:
        """Return the words in a frame; None if its link has some that a frame cannot have."""
        return []

    def frame_entry(self, link: Element, entries: list[Entry]) -> Entry:
        """Return a frame for a link, with some entries."""
        return Entry(
            self.key_of("frame", {"name": name_of(link)}), Body(entries, in_braces=True) or None
        )

    def pose_entries(self, owner: Element, origin: Element | None) -> list[Entry] | None:
        """Return the entries that give an origin, or None if an element has to give it."""
        if pose_of(origin, exact=self._exact) is None:
            return None
        body = Body()
        try:
            PartWriter._add_pose(self, owner, origin, body)
        except NoPart:
            return None
        return body.entries

    def key_of(self, name: str, attributes: dict[str, str]) -> str:
        """Return the key of an element."""
        return self._elements.key(name, attributes)

    # --- joints ---------------------------------------------------------------------------------

    def _joint_entry(self, joint: Element, named: dict[str, str]) -> Entry:
        """Return the joint of a part; `named` is its name, if that of the part does not say it."""
        attributes = values_of(joint)
        kind = attributes.pop("type", None)
        attributes.pop("name")
        attributes = {**named, **attributes}
        if kind is None or has_text(joint):
            raise NoPart
        body = Body(in_braces=True)
        body.span = joint.span
        body.add("type", kind)
        rest = Body()
        seen: dict[str, Element] = {}
        remarks: dict[str, Entry] = {}

        def write(child: Element, out: Body) -> None:
            if child.name in ("parent", "child", "origin"):
                if child.name in seen:
                    raise NoPart
                seen[child.name] = child
                _take_remark(child, out, remarks)
            else:
                own = values_of(child)
                is_first = self._is_first(child, joint, seen)
                seen[child.name] = child
                if child.children or not own or not is_first:
                    out.append(self._element(child))
                else:
                    out.append(self._joint_entry_of(child, own, kind))

        self._write_all(joint, rest, write)
        parent, child = seen.get("parent"), seen.get("child")
        if parent is None or child is None or list(values_of(child)) != ["link"] or child.children:
            raise NoPart
        name = values_of(parent).get("link", "")
        is_plain = list(values_of(parent)) == ["link"] and not parent.children and is_word(name)
        if is_plain and (name in self._names.links or (self._resolves and name != "root_link")):
            body.add("parent", self._names.of_links.get(name, name))
        else:
            body.entries.append(self._elements.entry(parent, bracketed=True))
        self._add_pose(joint, seen.get("origin"), body)
        _add_remarks(remarks, body)
        body.extend(rest)
        body.entries += self._words_of_joint(joint)
        return Entry(self._elements.key("joint", attributes), body)

    def _joint_entry_of(self, child: Element, attributes: dict[str, str], kind: str) -> Entry:
        """Return what an element of a joint becomes that is the only one of its name."""
        if child.name == "axis" and list(attributes) == ["xyz"]:
            return Entry("axis", numbers_of(attributes["xyz"], 3))
        if child.name == "mimic" and "joint" in attributes:
            name = attributes["joint"]
            attributes["joint"] = self._names.of_joints.get(name, name)
            if list(attributes) == ["joint"]:
                return Entry("mimic", attributes["joint"])
        if child.name == "limit" and not is_whole_limit(attributes, kind):
            return self._element(child)
        # An attribute that URDF does not have would be a misspelt key.
        if child.name in RECORDS and attributes.keys() <= self._known_of(child.name):
            if not self._exact and child.name != "mimic":
                degrees = self._degrees
                attributes = {
                    key: degrees.of_attribute(key, value, kind) for key, value in attributes.items()
                }
            entries = [Entry(key, value) for key, value in attributes.items()]
            return Entry(child.name, Body(entries, in_braces=True, width=RECORD_WIDTH))
        return self._element(child)

    def _known_of(self, name: str) -> Set[str]:
        """Return the attributes of an element of a joint that are keys of the language."""
        return ELEMENTS[name].attributes.keys()

    # --- links ----------------------------------------------------------------------------------

    def _link(self, link: Element) -> Body | None:
        if has_text(link):
            raise NoPart
        plan = self._plan(link)
        body = Body()

        def write(child: Element, out: Body) -> None:
            if child.name == "inertial" and self._is_short_inertial(child, plan):
                out.append(self._inertial(child, plan))
            elif child.name in SECTIONS:
                out.append(self._section(child, plan))
            else:
                out.append(self._element(child))

        first = self._count_first(link)
        self._write_all(link, body, write, range(first))
        if plan.geometry is not None:
            body.entries += plan.geometry.entries()
        if plan.pose is not None:
            self._add_pose(link, plan.pose.origin, body)
        self._write_all(link, body, write, range(first, len(link.children)))
        return body or None

    def _count_first(self, link: Element) -> int:
        """Return how many children of a link are written before what its sections share."""
        return 0

    def _plan(self, link: Element) -> LinkPlan:
        return LinkPlan(
            link, self._elements.file_name, self._has_form, self._is_solid, exact=self._exact
        )

    def _has_form(self, section: Element) -> bool:
        """Return whether a section has what the short form of one says, each once."""
        if section.name == "inertial":
            return has_mass_form(section)
        return has_section_form(section)

    def _is_solid(self, inertial: Element, geometry: Geometry) -> bool:
        """Return whether an inertia is the one that a geometry has with its mass."""
        moments = values_of(child_named(inertial, "inertia"))
        mass = values_of(child_named(inertial, "mass"))["value"]
        rows = [moments[name] for name in MOMENTS]
        return is_inertia_of(geometry.kind, geometry.sizes(), mass, rows)

    def _inertia(self, inertial: Element) -> list[Entry]:
        """Return the entries that give an inertia."""
        moments = values_of(child_named(inertial, "inertia"))
        return [Entry("inertia", numbers_of(" ".join(moments[name] for name in MOMENTS), 6))]

    def _is_short_inertial(self, inertial: Element, plan: LinkPlan) -> bool:
        return inertial is plan.inertial

    def _section(self, section: Element, plan: LinkPlan) -> Entry:
        """Return a visual or collision, or the replacement of the second inertial of a link."""
        if id(section) not in plan.sections:
            return self._elements.entry(section, bracketed=True)
        own = plan.sections[id(section)]
        body = Body(in_braces=True)
        body.span = section.span
        if own is not None and (plan.geometry is None or own.key() != plan.geometry.key()):
            body.entries += own.entries()
        if plan.pose is None:
            self._add_pose(section, optional_child(section, "origin"), body)
        rest = Body()
        remarks: dict[str, Entry] = {}

        def write(child: Element, out: Body) -> None:
            if child.name not in ("geometry", "origin"):
                out.append(self._section_child(child))
                return
            if child.name == "geometry" and own is None:
                body.entries.append(self._elements.entry(child, bracketed=True))
                _take_remark(child.with_children([]), out, remarks)
            else:
                _take_remark(child, out, remarks)

        self._write_all(section, rest, write)
        _add_remarks(remarks, body)
        body.extend(rest)
        body.entries += self._words_of_section(section)
        if all(isinstance(entry.value, str) for entry in body):
            body.width = RECORD_WIDTH
        return Entry(self._elements.key(section.name, values_of(section)), body or None)

    def _section_child(self, child: Element) -> Entry:
        material = self._material(child) if child.name == "material" else None
        return material or self._element(child)

    def _inertial(self, inertial: Element, plan: LinkPlan) -> Entry:
        mass = values_of(child_named(inertial, "mass"))["value"]
        body = Body([Entry("mass", mass)], in_braces=True, width=RECORD_WIDTH)
        if not plan.has_computed_inertia:
            body.entries += self._inertia(inertial)
        if plan.pose is None:
            pose = Body()
            self._add_pose(inertial, optional_child(inertial, "origin"), pose)
            body.entries[1:1] = pose.entries
        remarks: dict[str, Entry] = {}

        def write(child: Element, out: Body) -> None:
            if child.name in ("origin", "mass", "inertia"):
                _take_remark(child, out, remarks)
            else:
                out.append(self._element(child))

        self._write_all(inertial, body, write)
        _add_remarks(remarks, body)
        if plan.has_computed_inertia and len(body.entries) == 1 and not body.remark:
            return body.entries[0]
        return Entry("inertial", body)

    # --- both -----------------------------------------------------------------------------------

    def _write_all(
        self,
        owner: Element,
        body: Body,
        write: Callable[[Element, Body], None],
        of: range | None = None,
    ) -> None:
        """Write each element in a joint, link or section by `write`, and what is beside them.

        With `of`, only its children at these places are written.
        """
        endings = comments_at_ends(owner.children)
        for child in owner.children if of is None else [owner.children[each] for each in of]:
            if isinstance(child, Element):
                write(child, body)
            else:
                add_loose(child, body, endings)

    def _is_first(self, child: Element, owner: Element, seen: dict[str, Element]) -> bool:
        """Return whether an element is not a second one of its name, for which there is no key."""
        return child.name not in seen

    def _element(self, element: Element) -> Entry:
        return self._elements.entry(element, bracketed=element.name in PART_KEYS)

    def _add_pose(self, owner: Element, origin: Element | None, body: Body) -> None:
        """Add the entries that give the origin of what has it, or say that there is none."""
        pose = pose_of(origin, exact=self._exact)
        if pose is not None:
            quat = pose.pop(QUATERNION, "")
            for name, row in pose.items():
                words = numbers_of(row, 3)
                if name == "rpy" and not self._exact:
                    words = self._degrees.row(words)
                is_long = max(map(len, words.split())) > LONGEST_ANGLE
                if name == "rpy" and quat and is_long and len(quat) < len(words):
                    body.add(QUATERNION, quat)
                elif not same_words(words, ZEROS):
                    body.add(name, words)
        elif origin is None:
            body.add("origin", "none")
        else:
            origin.attributes.pop(QUATERNION, None)
            body.entries.append(self._elements.entry(origin, bracketed=True))


_KEYS_OF = {
    "child": ("parent",),
    "geometry": ("scale", "geometry"),
    "origin": ("xyz", "rpy", "quat", "origin"),
}
"""The keys that an element becomes, where these are not its name."""


def _take_remark(child: Element, out: Body, remarks: dict[str, Entry]) -> None:
    """Take what is remarked at an element that is put in other words."""
    taken = remarks[child.name] = Entry(child.name, comment=out.remark)
    note_comments(child, taken)
    out.remark = ""
    out.latest = taken


def _add_remarks(remarks: dict[str, Entry], body: Body) -> None:
    """Put what was remarked at elements at the keys that they became, or else on top."""
    for name, remark in remarks.items():
        keys = _KEYS_OF.get(name, (name,))
        made = [own for own in body if own.key.strip("<>").partition("/")[0] in keys]
        if made:
            made[0].comment = joined(made[0].comment, remark.comment)
            made[-1].ending = spaced(made[-1].ending, remark.ending)
            continue
        homeless = joined(remark.comment, remark.ending)
        if body.entries:
            body.entries[0].comment = joined(body.entries[0].comment, homeless)
        else:
            body.note(homeless)


# --- empty links on fixed joints as frames of the part above: `frame/name=tool0: {xyz: …}` ----


class Frames:
    """Puts frames into the parts whose links they are in.

    A frame makes a joint and a link directly after those of its part. So it is one only if these
    are there: nothing that makes another joint or link is between.
    """

    __slots__ = ("_link", "_part")

    def __init__(self) -> None:
        """Start where there is no part."""
        self._part: Body | None = None
        self._link = ""

    def begin(self, part: Entry | None, link: str = "") -> None:
        """Note the part that was written last, and the name of its link; None for anything else."""
        self._part = None
        self._link = link
        if part is not None and part.key == "part" and isinstance(part.value, Body):
            self._part = part.value

    def take(self, link: Element, joint: Element | None, writer: PartWriter, around: Body) -> bool:
        """Put a link and its joint into the part as a frame, and return whether they are one.

        What is remarked next in the body `around` belongs to it.
        """
        if self._part is None or joint is None or not is_frame(link, joint, self._link):
            return False
        pose = writer.pose_entries(joint, optional_child(joint, "origin"))
        words = writer.words_of_frame(link)
        if pose is None or words is None:
            return False
        pose += words
        frame = writer.frame_entry(link, pose)
        note_comments(joint, frame)
        note_comments(link, frame)
        for child in joint.elements():
            note_comments(child, frame)
        holder = _link_of(self._part)
        holder.append(frame)
        frame.comment, around.remark = joined(around.remark, frame.comment), ""
        around.latest = frame
        return True


def is_frame(link: Element, joint: Element, parent: str) -> bool:
    """Return whether a link and its joint are what a frame in the link `parent` makes."""
    name = name_of(link)
    if link.elements() or has_text(link) or has_text(joint) or list(values_of(link)) != ["name"]:
        return False
    if values_of(joint) != {"name": f"{name}_joint", "type": "fixed"} or "," in name:
        return False
    names = sorted(child.name for child in joint.elements())
    if names not in (["child", "parent"], ["child", "origin", "parent"]):
        return False
    ends = {child.name: values_of(child) for child in joint.elements() if child.name != "origin"}
    return (
        name.split() == [name]
        and not any(child.elements() for child in joint.elements())
        and ends == {"parent": {"link": parent}, "child": {"link": name}}
    )


def _link_of(part: Body) -> Body:
    """Return the body of the link of a part, which is added if it has none."""
    part.in_braces = False
    for entry in part:
        if entry.key == "link" or entry.key.startswith("link/"):
            if entry.value is None:
                entry.value = Body()
            assert isinstance(entry.value, Body)
            entry.value.in_braces = False
            return entry.value
    part.entries.append(Entry("link", link := Body()))
    return link
