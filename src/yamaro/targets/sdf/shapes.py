"""Collisions and visuals of SDFormat: shapes, surfaces and materials."""

from __future__ import annotations

from ...model.shapes import Box, Capsule, Cylinder, Mesh, Sphere
from ...xml.tree import Element
from ..output import LOST, RENAMED, Loss
from ..sdf_sensors import surface_of
from ..tags import Tag, given, row_of, unused
from .links import pose_tag

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ...model.link import Collision, Link, Visual
    from ...model.robot import Robot
    from ...model.shapes import Shape
    from ..output import Wanted
    from .gazebo_blocks import GazeboBlocks
    from .names import Names

    Content = list[Tag | Element]


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
        losses: list[Loss],
    ) -> None:
        self._robot = robot
        self._wanted = wanted
        self._names = names
        self._blocks = blocks
        self._surfaces = {(each.link, each.index): each for each in robot.surfaces}
        self._used: dict[str, set[str]] = {}
        self._nameless: set[str] = set()
        self.losses = losses
        self.collisions: dict[str, list[str]] = {}

    def of(self, link: Link, body: str) -> list[Tag]:
        """Return the collisions and visuals of a link, for the body that it is part of."""
        frame = None if link.name == body else self._names.links[link.name]
        tags = []
        for index, collision in enumerate(link.collisions):
            surface = self._surface(link.name, index)
            extra = [*self._blocks.collisions.get(link.name, ()), *surface]
            tag = self._shape("collision", link, body, collision, frame, extra)
            if tag is not None:
                tags.append(tag)
                self.collisions.setdefault(link.name, []).append(str(tag.attributes["name"]))
        for visual in link.visuals:
            tag = self._shape("visual", link, body, visual, frame, self._material(link, visual))
            if tag is not None:
                tags.append(tag)
        return tags

    def _surface(self, link: str, index: int) -> list[Tag]:
        """Return the surface of a collision, by the words of YAML and those of Gazebo."""
        surface = self._surfaces.get((link, index))
        more = self._blocks.surfaces.get(link, [])
        return [surface_of(surface, more)] if surface is not None or more else []

    def _shape(
        self,
        kind: str,
        link: Link,
        body: str,
        shape: Collision | Visual,
        frame: str | None,
        extra: Iterable[Tag],
    ) -> Tag | None:
        """Return a collision or visual, or None if there is nothing to write."""
        solid = shape.shape
        if solid is None or (isinstance(solid, Mesh) and not self._wanted.has_meshes):
            return None
        if not isinstance(solid, Mesh) and min(solid.size) <= 0:
            what = "shapes with a size that is not positive"
            owner = f"{solid.kind} of link '{link.name}'"
            self.losses.append(Loss(LOST, what, owner, shape.span, trace=link.trace))
            return None
        name = self._named(kind, link, body, shape)
        content: Content = [*pose_tag(shape.pose, frame)]
        content += [Tag("geometry", [self._geometry(solid, link)]), *extra]
        for blob in self._blocks.blobs.get(link.name, ()):
            if blob.name == kind:
                content = _with_blob(content, blob)
        return Tag(
            kind,
            content,
            span=shape.span,
            trace=link.trace,
            name=name,
        )

    def _named(self, kind: str, link: Link, body: str, shape: Collision | Visual) -> str:
        """Return a name that no other shape of the body has; note it if one is given."""
        wanted = shape.name or f"{link.name}_{kind}"
        name = unused(wanted, self._used.setdefault(f"{body}/{kind}", set()))
        if shape.name and name != wanted:
            trace = shape.trace_in(link)
            owner = f"'{wanted}' of link '{link.name}'"
            loss = Loss(RENAMED, f"{kind}s", owner, shape.span, trace=trace, how=name)
            self.losses.append(loss)
        return name

    def _geometry(self, shape: Shape, link: Link) -> Tag:
        if isinstance(shape, Box):
            return Tag("box", [Tag("size", row_of(shape.size))])
        if isinstance(shape, Sphere):
            return Tag("sphere", [Tag("radius", shape.radius)])
        if isinstance(shape, (Cylinder, Capsule)):
            return Tag(shape.kind, given(("radius", shape.radius), ("length", shape.length)))
        span = shape.span or link.span
        uri = self._wanted.paths.named(shape.filename, span)
        scale = [] if shape.scale == (1.0, 1.0, 1.0) else [Tag("scale", row_of(shape.scale))]
        return Tag("mesh", [Tag("uri", uri), *scale])

    def _material(self, link: Link, visual: Visual) -> list[Tag]:
        """Return the colour and the texture of a visual; materials have no names in SDFormat."""
        material = self._robot.material_of(visual)
        if material is None or not material.is_defined:
            return []
        span, name = material.span_of("name"), material.name
        is_named = span.key() != material.span.key()  # and not made of a colour
        if name and is_named and name not in self._nameless:
            self._nameless.add(name)
            what, owner, trace = "names of materials", f"material '{name}'", material.trace_in(link)
            self.losses.append(Loss(LOST, what, owner, span, trace=trace))
        parts = []
        if material.color is not None:
            color = row_of(material.color)
            parts += [Tag("ambient", color), Tag("diffuse", color)]
        if material.texture is not None:
            inner = material.inner("texture")
            span = inner.value_span("filename") if inner is not None else material.span
            uri = self._wanted.paths.named(material.texture, span)
            parts.append(Tag("pbr", [Tag("metal", [Tag("albedo_map", uri)])]))
        return [Tag("material", parts)]


def _with_blob(content: Content, blob: Element) -> Content:
    """Return the content of a shape with what Gazebo puts in its place."""
    given = list(blob.elements())
    names = {each.name for each in given} - {"plugin"}
    for index, each in enumerate(given):
        own = next((one for one in content if one.name == each.name == "surface"), None)
        if own is not None:
            whole = own if isinstance(own, Element) else own.made(each.span, each.trace)
            given[index] = _merged(each, whole)
    return [*(each for each in content if each.name not in names), *given]


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
