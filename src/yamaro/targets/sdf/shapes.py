"""Collisions and visuals of SDFormat: shapes, surfaces and materials."""

from __future__ import annotations

from ...model.shapes import Box, Capsule, Cylinder, Mesh, Sphere
from ...xml.tree import Element
from ..elements import UsedNames, element, given, settle
from .links import pose_of, row_of
from .sensors import surface_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ...model.link import Collision, Link, Visual
    from ...model.robot import Robot
    from ...model.shapes import Shape
    from ..losses import Losses
    from ..output import Wanted
    from .gazebo import GazeboBlocks
    from .links import Names


class Shapes:
    """Makes the shapes of a model's links.

    Attributes:
        losses: what SDFormat cannot hold of them.
        collisions: by the name of a link, what its collisions are called.
    """

    __slots__ = (
        "_blocks", "_nameless", "_names", "_robot", "_surfaces", "_used", "_wanted", "collisions",
        "losses",
    )  # fmt: skip

    def __init__(
        self,
        robot: Robot,
        wanted: Wanted,
        names: Names,
        blocks: GazeboBlocks,
        losses: Losses,
    ) -> None:
        self._robot = robot
        self._wanted = wanted
        self._names = names
        self._blocks = blocks
        self._surfaces = {(each.link, each.index): each for each in robot.surfaces}
        self._used = UsedNames()
        self._nameless: set[str] = set()
        self.losses = losses
        self.collisions: dict[str, list[str]] = {}

    def of(self, link: Link, body: str) -> list[Element]:
        """Return the collisions and visuals of a link, for the body that it is part of."""
        frame = None if link.name == body else self._names.links[link.name]
        found = []
        more = self._blocks.surfaces.get(link.name, [])
        for index, collision in enumerate(link.collisions):
            surface = self._surfaces.get((link.name, index))
            extra = [*self._blocks.collisions.get(link.name, ())]
            if surface is not None or more:  # by the words of YAML, and those of Gazebo
                extra.append(surface_of(surface, more))
            made = self._shape("collision", link, body, collision, frame, extra)
            if made is not None:
                found.append(made)
                self.collisions.setdefault(link.name, []).append(str(made.attributes["name"]))
        for visual in link.visuals:
            made = self._shape("visual", link, body, visual, frame, self._material(link, visual))
            if made is not None:
                found.append(made)
        return found

    def _shape(
        self,
        kind: str,
        link: Link,
        body: str,
        shape: Collision | Visual,
        frame: str | None,
        extra: Iterable[Element],
    ) -> Element | None:
        """Return a collision or visual, or None if there is nothing to write."""
        solid = shape.shape
        if solid is None or (isinstance(solid, Mesh) and not self._wanted.has_meshes):
            return None
        if not isinstance(solid, Mesh) and min(solid.size) <= 0:
            what = "shapes with a size that is not positive"
            label = f"{solid.kind} of link '{link.name}'"
            self.losses.lose(what, link, part=shape, label=label)
            return None
        wanted = shape.name or f"{link.name}_{kind}"
        name = self._used.fresh(f"{body}/{kind}", wanted)
        if shape.name and name != wanted:
            label = f"'{wanted}' of link '{link.name}'"
            self.losses.rename(f"{kind}s", link, part=shape, label=label, new=name)
        geometry = element("geometry", children=[self._geometry(solid, link)])
        content = [*pose_of(shape.pose, frame), geometry, *extra]
        for blob in self._blocks.blobs.get(link.name, ()):
            if blob.name == kind:
                inner = blob.elements()
                names = {each.name for each in inner} - {"plugin"}
                for index, each in enumerate(inner):
                    own = next((one for one in content if one.name == each.name == "surface"), None)
                    if own is not None:
                        settle([own], each.span, each.trace)
                        inner[index] = _merged(each, own)
                content = [*(each for each in content if each.name not in names), *inner]
        return element(kind, {"name": name}, children=content, owner=link, part=shape)

    def _geometry(self, shape: Shape, link: Link) -> Element:
        if isinstance(shape, Box):
            return element("box", children=given(("size", row_of(shape.size))))
        if isinstance(shape, Sphere):
            return element("sphere", children=given(("radius", shape.radius)))
        if isinstance(shape, (Cylinder, Capsule)):
            sizes = given(("radius", shape.radius), ("length", shape.length))
            return element(shape.kind, children=sizes)
        uri = self._wanted.paths.named(shape.filename, shape.span or link.span)
        scale = None if shape.scale == (1.0, 1.0, 1.0) else row_of(shape.scale)
        return element("mesh", children=given(("uri", uri), ("scale", scale)))

    def _material(self, link: Link, visual: Visual) -> list[Element]:
        """Return the colour and the texture of a visual; materials have no names in SDFormat."""
        material = self._robot.material_of(visual)
        if material is None or not material.is_defined:
            return []
        span, name = material.span_of("name"), material.name
        is_named = span.key() != material.span.key()  # and not made of a colour
        if name and is_named and name not in self._nameless:
            self._nameless.add(name)
            what, label = "names of materials", f"material '{name}'"
            self.losses.lose(what, link, part=material, label=label, field="name")
        parts = []
        if material.color is not None:
            color = row_of(material.color)
            parts += given(("ambient", color), ("diffuse", color))
        if material.texture is not None:
            inner = material.inner("texture")
            span = inner.value_span("filename") if inner is not None else material.span
            uri = self._wanted.paths.named(material.texture, span)
            metal = element("metal", children=given(("albedo_map", uri)))
            parts.append(element("pbr", children=[metal]))
        return [element("material", children=parts)]


def _merged(one: Element, other: Element) -> Element:
    """Return an element with what another one holds besides."""
    inner = {child.name: child for child in other.elements()}
    children = [
        _merged(child, inner[child.name])
        if isinstance(child, Element) and child.name in inner and inner[child.name].elements()
        else child
        for child in one.children
    ]
    names = {child.name for child in one.elements()}
    more = [child for name, child in inner.items() if name not in names]
    return one.with_children([*children, *more])
