"""What of a joint or link has a short form in a part: geometry, poses, materials, inertials."""

from __future__ import annotations

from ...meshes.formats import mesh_ending
from ...model.compare import POSE, ZEROS, same_words
from ...model.mesh_integrals import MESH_ENDINGS
from ...model.shapes import COUNTS, SIMPLE_SHAPES
from ...model.values import values_of
from ...xml.tree import Element, Text
from ...xml.values import format_value
from .document import Body, Entry, without_expressions, words_of
from .pairing import has_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")

SIZES = {kind: shape.attributes for kind, shape in SIMPLE_SHAPES.items() if shape.since == "1.0"}


class NoPart(Exception):
    """A joint or link has something that no part gives."""


class Geometry:
    """A shape in its short form.

    Attributes:
        word: the word of the shape, or the name of a mesh file in the language's spelling.
        scale: its numbers, as one text; None for a mesh without one.
    """

    __slots__ = ("kind", "scale", "word")

    def __init__(self, kind: str, word: str, scale: str | None) -> None:
        """Hold them; `kind` is the name of the URDF element."""
        self.kind = kind
        self.word = word
        self.scale = scale

    def key(self) -> tuple[str, str | None]:
        """Return a value that is equal for equal geometries."""
        return self.word, self.scale

    def entries(self) -> list[Entry]:
        """Return the entries that say it."""
        entries = [Entry("geometry", self.word)]
        if self.scale is not None:
            entries.append(Entry("scale", self.scale))
        return entries

    def sizes(self) -> list[str]:
        """Return the numbers of the scale, each as a word."""
        return words_of(self.scale or "")


def pose_of(origin: Element | None, *, exact: bool) -> dict[str, str] | None:
    """Return `xyz` and `rpy` of an origin, zeros where it says nothing; None if that is not all.

    With `exact`, an origin that says nothing of one of them is not the same as zeros.
    """
    attributes = {} if origin is None else values_of(origin)
    if (origin is not None and origin.children) or attributes.keys() - set(POSE):
        return None
    if exact and len(attributes) < len(POSE):
        return None
    return dict.fromkeys(POSE, ZEROS) | attributes


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
    ) -> None:
        """Look at a link.

        Args:
            link: to look at.
            file_name: spells the names of mesh files.
            has_form: decides which of its sections have a short form.
            is_solid: decides whether an inertial has the inertia of a geometry.
            exact: whether an origin that is missing has to stay missing.
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
                self.sections[id(child)] = read_geometry(child, file_name)
                posed.append(child)
            elif child.name == "inertial" and self.inertial is None and has_form(child):
                self.inertial = child
                posed.append(child)
        self._choose_geometry()
        self._choose_pose(posed)

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

    def _choose_pose(self, posed: list[Element]) -> None:
        if len(posed) < 2:
            return
        origins = [optional_child(section, "origin") for section in posed]
        if self._exact and not any(origins):
            self.pose = CommonPose(None)
        first, *others = (pose_of(origin, exact=self._exact) for origin in origins)
        if first is None or any(pose != first for pose in others):
            return
        if not all(same_words(row, ZEROS) for row in first.values()):
            self.pose = CommonPose(origins[0])


def read_geometry(section: Element, file_name: Callable[[str], str]) -> Geometry | None:
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
    names = SIZES.get(shape.name)
    if names is None or sorted(attributes) != sorted(names):
        return None
    words = " ".join(attributes[name] for name in names)
    return Geometry(shape.name, shape.name, numbers_of(words, COUNTS[shape.name]))


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
            else _is_surely_named(values_of(child)["filename"])
        )
        for child in children
    )


def _is_surely_named(file: str) -> bool:
    """Return whether the name of a file cannot be empty, which a part refuses."""
    return bool(without_expressions(file).replace("$()", "").strip())


def material_entry(material: Element) -> Entry | None:
    """Return a material in short: its name, with its colour and texture; None for any other."""
    if not is_short_material(material):
        return None
    name = values_of(material)["name"]
    looks = [
        Entry(look.name, " ".join(words_of(format_value(value))))
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
