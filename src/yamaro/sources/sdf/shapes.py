"""Visuals and collisions of SDF: geometry, materials, surfaces."""

from __future__ import annotations

from ...model import making
from ...model.schema import SURFACE
from ...model.shapes import SIMPLE_SHAPES
from ...model.values import attribute_text, child_named, content, inside
from ...xml.tree import Element, RobotNote
from ...xml.values import Numbers
from .kept import check_words, kept_of, placed
from .values import text_span

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from ...model.pose import Pose
    from .kept import Held
    from .values import Reading

KINDS = {
    "box": ("size",),
    "cylinder": ("radius", "length"),
    "sphere": ("radius",),
    "capsule": ("radius", "length"),
}
"""The shapes that the model has, with the elements that hold their sizes."""
SURFACE_PATHS = {
    "friction": (("friction", "ode", "mu"), ("friction", "bullet", "friction")),
    "friction2": (("friction", "ode", "mu2"), ("friction", "bullet", "friction2")),
    "restitution": (("bounce", "restitution_coefficient"),),
    "stiffness": (("contact", "ode", "kp"),),
    "damping": (("contact", "ode", "kd"),),
}
"""Where a `<surface>` says what the model has, by the names of the model; the first counts."""
HELD_SURFACE: Held = {
    "friction": {"ode": {"mu": True, "mu2": True}},
    "bounce": {"restitution_coefficient": True},
    "contact": {"ode": {"kp": True, "kd": True}},
}
DEFAULT_MU2 = 1.0
"""What SDFormat has for `mu2` beside a `mu`."""
GAZEBO_COLORS = {
    "Grey": (0.7, 0.7, 0.7), "DarkGrey": (0.175, 0.175, 0.175), "White": (1.0, 1.0, 1.0),
    "FlatBlack": (0.1, 0.1, 0.1), "Black": (0.0, 0.0, 0.0), "Red": (1.0, 0.0, 0.0),
    "RedBright": (0.87, 0.26, 0.07), "Green": (0.0, 1.0, 0.0), "Blue": (0.0, 0.0, 1.0),
    "SkyBlue": (0.13, 0.44, 0.7), "Yellow": (1.0, 1.0, 0.0), "ZincYellow": (0.9725, 0.9529, 0.2078),
    "DarkYellow": (0.7, 0.7, 0.0), "Purple": (1.0, 0.0, 1.0), "Turquoise": (0.0, 1.0, 1.0),
    "Orange": (1.0, 0.5088, 0.0468), "Indigo": (0.33, 0.0, 0.5), "Gold": (0.8, 0.64869, 0.120759),
}  # fmt: skip
"""The diffuse colours of Gazebo's materials, `Gazebo/NAME`. Source: gazebo.material."""


class Shapes:
    """Reads the shapes of one link.

    Attributes:
        elements: the visuals and collisions in URDF.
        kept: what the model does not hold of them.
        notes: the surfaces of the collisions.
    """

    __slots__ = ("_colors", "_counts", "_link", "_names", "_reading", "elements", "kept", "notes")

    def __init__(self, reading: Reading, link: str, colors: dict[object, str]) -> None:
        """Begin with a link.

        Args:
            reading: reads the values.
            link: its name.
            colors: the names of the robot's materials, by what they are.
        """
        self._colors = colors
        self._reading = reading
        self._link = link
        self._names: set[str] = set()
        self._counts = 0
        self.elements: list[Element] = []
        self.kept: list[Element] = []
        self.notes: list[RobotNote] = []

    def add(self, section: Element, pose: Pose) -> None:
        """Read a `<visual>` or `<collision>` at a pose in its link."""
        reading, kind = self._reading, section.name
        check_words(reading, section)
        name = self._name(section)
        geometry = child_named(section, "geometry")
        if geometry is None:  # it is empty, and SDF has it again
            self.kept.append(placed(section, pose))
            return
        check_words(reading, geometry)
        shape, held = self._shape(geometry)
        if shape is None:
            self.kept.append(placed(section, pose))
            return
        place = reading.place(section.span, {"name": section.value_span("name")})
        children = [*origin(reading, pose, section), making.element("geometry", place, {}, [shape])]
        table: dict[str, bool | Held] = {
            "@name": True, "pose": True, "geometry": held,
        }  # fmt: skip
        if kind == "visual":
            material = child_named(section, "material")
            if material is not None:
                children += self._material(material, table)
        else:
            surface = child_named(section, "surface")
            if surface is not None:
                self._surface(surface, table)
            self._counts += 1
        self.elements.append(making.element(kind, place, {"name": name}, children))
        rest = kept_of(section, table, name=name)
        if rest is not None:
            self.kept.append(rest)

    def _name(self, section: Element) -> str:
        name = (attribute_text(section, "name") or "").strip() or f"{self._link}_{section.name}"
        found, count = f"{section.name}/{name}", 2
        while found in self._names:
            found, count = f"{section.name}/{name}_{count}", count + 1
        self._names.add(found)
        return found.partition("/")[2]

    # --- geometry ---

    def _shape(self, geometry: Element) -> tuple[Element | None, Held]:
        """Return the shape in URDF, and what it holds of the geometry; None for others."""
        for child in geometry.elements():
            if child.name in KINDS:
                check_words(self._reading, child)
                return self._simple(child), {child.name: dict.fromkeys(KINDS[child.name], True)}
            if child.name == "mesh":
                check_words(self._reading, child)
                return self._mesh(child), {"mesh": {"uri": True, "scale": True}}
        return None, {}

    def _simple(self, element: Element) -> Element | None:
        """Return a simple shape; sizes that are missing are those of SDFormat's default, 1."""
        reading, values, spans = self._reading, {}, {}
        for name in KINDS[element.name]:
            count = 3 if name == "size" else 1
            child = child_named(element, name)
            row: Numbers | None = None
            if child is not None and content(child):
                row = reading.spelled(child, count)
                spans[name] = text_span(child)
            else:
                reading.warn(
                    "sdf-assumed",
                    f"this <{element.name}> has no <{name}>; it is taken for 1, as SDFormat does",
                    element.span,
                    hint=f"write <{name}>{' '.join(['1'] * count)}</{name}>",
                )
            row = row or Numbers.of(*(1.0,) * count)
            if min(row.values) <= 0:
                reading.fail(
                    "bad-sdf",
                    f"the {name} of a {element.name} is greater than 0",
                    spans.get(name, element.span),
                )
                return None
            values[name] = row
        assert element.name in SIMPLE_SHAPES
        return making.element(element.name, reading.place(element.span, spans), values)

    def _mesh(self, element: Element) -> Element | None:
        reading, uri = self._reading, child_named(element, "uri")
        address = (content(uri) or "").strip()
        if uri is None or not address:
            reading.fail(
                "bad-sdf",
                f"a mesh of the link '{self._link}' has no <uri>",
                element.span,
                hint="write <uri>meshes/arm.stl</uri>",
            )
            return None
        spans = {"filename": text_span(uri)}
        scale = child_named(element, "scale")
        row = None
        if scale is not None and content(scale):
            row = reading.spelled(scale, 3)
            spans["scale"] = text_span(scale)
        if row is not None and set(row.values) == {1.0}:
            row = None
        place = reading.place(element.span, spans)
        return making.element("mesh", place, {"filename": address, "scale": row})

    # --- materials ---

    def _material(self, material: Element, table: dict[str, bool | Held]) -> list[Element]:
        """Return the material in URDF: the diffuse colour, and the texture of PBR."""
        reading = self._reading
        check_words(reading, material)
        held: dict[str, bool | Held] = {}
        colors: dict[str, tuple[float, ...]] = {}
        for name in ("diffuse", "ambient"):
            child = child_named(material, name)
            if child is not None and content(child):
                row = reading.row(child, (3, 4))
                if row is not None:
                    colors[name] = row if len(row) == 4 else (*row, 1.0)
        script = content(inside(material, "script", "name")) or ""
        known = GAZEBO_COLORS.get(script.removeprefix("Gazebo/"))
        color = colors.get("diffuse") or colors.get("ambient")
        if "diffuse" in colors:
            held["diffuse"] = True
            held["ambient"] = colors.get("ambient", color) == color
        if color is None and known is not None:
            color = (*known, 1.0)
        texture = inside(material, "pbr", "metal", "albedo_map")
        children: list[Element] = []
        if color is not None:
            source = child_named(material, "diffuse") or child_named(material, "ambient")
            span = text_span(source or child_named(material, "script") or material)
            row = tuple([min(max(each, 0.0), 1.0) for each in color])
            children.append(
                making.element("color", reading.place(span, {"rgba": span}), {"rgba": row})
            )
            if row != color:
                held.pop("diffuse", None)
        if texture is not None and content(texture):
            place = reading.place(texture.span, {"filename": text_span(texture)})
            children.append(making.element("texture", place, {"filename": content(texture)}))
            held["pbr"] = {"metal": {"albedo_map": True}}
        if not children:
            return []
        table["material"] = held
        place = reading.place(material.span)
        name = self._name_of((color, content(texture)))
        return [making.element("material", place, {"name": name}, children)]

    def _name_of(self, look: object) -> str:
        """Return the name of a material, which SDF has not: as `color` in YAML is named."""
        name = self._colors.get(look)
        if name is None:
            stem, count = f"{self._link}_color", 2
            name = stem
            while name in self._colors.values():
                name, count = f"{stem}_{count}", count + 1
            self._colors[look] = name
        return name

    # --- surfaces ---

    def _surface(self, surface: Element, table: dict[str, bool | Held]) -> None:
        """Note the surface of a collision."""
        reading = self._reading
        check_words(reading, surface)
        values: dict[str, object] = {"link": self._link, "index": str(self._counts)}
        spans = {}
        for name, paths in SURFACE_PATHS.items():
            found = next((each for path in paths if (each := inside(surface, *path))), None)
            row = reading.row(found, (1,)) if found is not None and content(found) else None
            if found is None or row is None or not 0 <= row[0] < 1e300:
                continue
            if name == "restitution" and row[0] > 1:
                continue
            values[name] = Numbers.of(row[0])
            spans[name] = text_span(found)
        if "friction" in values and "friction2" not in values:
            values["friction2"] = Numbers.of(DEFAULT_MU2)
        if not SURFACE.fields.keys().isdisjoint(values):
            place = reading.place(surface.span, spans)
            self.notes.append(
                RobotNote("surface", place.span, values, trace=place.trace, value_spans=spans)
            )
            table["surface"] = {
                "friction": {"ode": {"mu": "friction" in values, "mu2": "friction2" in values}},
                "bounce": {"restitution_coefficient": "restitution" in values},
                "contact": {"ode": {"kp": "stiffness" in values, "kd": "damping" in values}},
            }


def origin(reading: Reading, pose: Pose, owner: Element) -> list[Element]:
    """Return the `<origin>` of a pose, as it is written; none if nothing moves."""
    own = pose.element
    if own is not None:
        return [Element("origin", own.span, dict(own.attributes), trace=own.trace)]
    from .kept import clean

    values: Mapping[str, tuple[float, ...]] = {
        "xyz": tuple(map(clean, pose.position)), "rpy": tuple(map(clean, pose.rpy)),
    }  # fmt: skip
    given = {name: row for name, row in values.items() if any(row)}
    if not given:
        return []
    written = child_named(owner, "pose")
    span = owner.span if written is None else text_span(written)
    return [making.element("origin", reading.place(span), given)]
