"""The `geometry` and `scale` of a link or section: the shape, and its `<geometry>` element."""

from __future__ import annotations

from math import isfinite

from ..diagnostics import failure, suggest
from ..model.shapes import COUNTS, SIMPLE_SHAPES, SIZES, MeshSolid
from ..xml.tree import Element, Text
from ..xml.values import format_value
from .fields import read_record, read_value, word_of
from .numbers import read_numbers

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..meshes.triangles import TriangleMesh
    from ..model.mesh_integrals import SolidMoments
    from ..model.shapes import Solid
    from ..source import Span
    from .fields import Fields
    from .lowering import Lowering
    from .numbers import Numbers

SMALLEST_VOLUME = 1e-9
"""Part of the cube of a mesh's size below which its volume is only rounding."""


class Geometry:
    """A shape word with its scale, and the `<geometry>` that both make.

    Attributes:
        key: the `geometry` key.
        kind: `box`, `cylinder`, `sphere`, `capsule` or `mesh`.
        word: the shape or the mesh file as written.
        span: where the word is written.
        scale: the scale; None for a mesh without one.
        scale_span: where the scale is written, if there is one.
        element: the `<geometry>` element.
    """

    __slots__ = ("element", "key", "kind", "scale", "scale_span", "span", "word")

    def __init__(
        self,
        key: Element,
        *,
        kind: str,
        word: str,
        span: Span,
        scale: Numbers | None,
        scale_span: Span,
    ) -> None:
        """Hold a geometry and make its element."""
        self.key = key
        self.kind = kind
        self.word = word
        self.span = span
        self.scale = scale
        self.scale_span = scale_span
        self.element = _element(self)


class LinkGeometry:
    """The geometry and scale written in a link, which its sections inherit when they use them."""

    __slots__ = ("_made", "fields", "is_used", "key", "scale_key")

    def __init__(self, fields: Fields) -> None:
        """Hold the keys; they are read when a section first uses them."""
        self.fields = fields
        self.key = fields.keys.get("geometry")
        self.scale_key = fields.keys.get("scale")
        self.is_used = False
        self._made: Geometry | None = None

    def geometry(self, lowering: Lowering) -> Geometry | None:
        """Return the link's own geometry, read once, or None if it has none.

        Raises:
            YamaroError: the geometry or its scale is faulty.
        """
        if self._made is None and self.key is not None:
            self.is_used = True
            self._made = read_geometry(lowering, self.key, self.scale_key)
        return self._made


def section_geometry(lowering: Lowering, fields: Fields, link: LinkGeometry) -> Geometry | None:
    """Return the geometry a section has or inherits, or None if there is none.

    Geometry and scale are inherited together: with its own geometry a section takes only its own
    scale; with only a scale it is the link's shape in another size.

    Raises:
        YamaroError: the geometry or its scale is faulty.
    """
    key = fields.keys.get("geometry")
    scale_key = fields.keys.get("scale")
    if key is not None:
        return read_geometry(lowering, key, scale_key, link_scale=link.scale_key)
    if scale_key is None or link.key is None:
        return link.geometry(lowering)
    link.is_used = True
    return read_geometry(lowering, link.key, scale_key)


def read_geometry(
    lowering: Lowering,
    key: Element,
    scale_key: Element | None,
    *,
    link_scale: Element | None = None,
) -> Geometry:
    """Return the geometry of a `geometry` key and a `scale` key.

    Raises:
        YamaroError: a misspelt shape, URDF's own form of a geometry, or a faulty scale.
    """
    kind, word, span = _read_shape_word(lowering, key)
    scale, scale_span = None, span
    if scale_key is not None:
        value, scale_span = read_value(scale_key)
        scale = read_numbers(
            lowering,
            value,
            scale_span,
            count=COUNTS.get(kind, 3),
            name=f"scale of a {kind}",
            trace=scale_key.trace,
        )
    elif kind != "mesh":
        notes = []
        if link_scale is not None:
            place = link_scale.span.place()
            notes.append(f"the link's scale at {place} belongs to the link's own geometry")
        raise failure(
            "missing-scale",
            f"the geometry '{word}' has no scale",
            key.span,
            hint=f"write it beside 'geometry', as {_scale_example(kind)}",
            notes=notes,
            trace=key.trace,
        )
    if kind == "capsule" and not lowering.has_capsule:
        _warn_of_capsule(lowering, key, span)
    return Geometry(key, kind=kind, word=word, span=span, scale=scale, scale_span=scale_span)


def _read_shape_word(lowering: Lowering, key: Element) -> tuple[str, str, Span]:
    """Return the kind of shape, the word as written, and its place."""
    children = key.children
    if len(children) != 1 or not isinstance(children[0], Text) or key.attributes:
        _refuse_urdf_form(lowering, key)
    value, span = read_value(key)
    word = word_of("geometry", value, span, owner=key)
    kind = word.lower()
    if kind in COUNTS:
        return kind, word, span
    from ..meshes.formats import mesh_ending
    from ..model.mesh_integrals import MESH_ENDINGS  # as below: most robots have no mesh

    if mesh_ending(word) in MESH_ENDINGS:
        return "mesh", word, span
    raise failure(
        "unknown-shape",
        f"'{word}' is neither a shape nor a mesh file",
        span,
        hint=_shape_hint(word),
        trace=key.trace,
    )


def _shape_hint(word: str) -> str:
    near = suggest(word.lower(), COUNTS)
    if near:
        return f"did you mean '{near}'?"
    if "." in word or "/" in word:
        from ..model.mesh_integrals import MESH_ENDINGS

        endings = " ".join(f".{ending}" for ending in MESH_ENDINGS)
        return f"the extensions of mesh files are {endings}"
    words = ", ".join(SIMPLE_SHAPES)
    return f"the shapes are {words}, and mesh files such as meshes/arm.stl"


def _scale_example(kind: str) -> str:
    """Return a scale to show for a simple shape, with what its numbers are."""
    shape = SIMPLE_SHAPES[kind]
    return f"scale: {shape.example} ({' '.join(shape.sizes)})"


def _refuse_urdf_form(lowering: Lowering, key: Element) -> None:
    """Raise an error for `geometry: {box/size=1 1 1: }` that shows the short form."""
    shapes = [c for c in key.children if isinstance(c, Element)]
    if not shapes:
        return
    shape = shapes[0]
    values = read_record(lowering, shape, None).values if type(shape) is Element else {}
    names = ("scale",) if shape.name == "mesh" else SIZES.get(shape.name, ())
    word = format_value(values.get("filename", "meshes/arm.stl"))
    short = f"geometry: {word if shape.name == 'mesh' else shape.name}"
    numbers = [format_value(values[name]) for name in names if name in values]
    if not names:
        short = "geometry: box and scale: 1 1 1"
    elif numbers:
        short += f" and scale: {' '.join(numbers)}"
    raise failure(
        "geometry-as-xml",
        f"'geometry' needs the name of a shape, not the element <{shape.name}>",
        shape.span,
        hint=f"write {short}, or <geometry>: for an XML element",
        trace=key.trace,
    )


def _warn_of_capsule(lowering: Lowering, key: Element, span: Span) -> None:
    lowering.warn(
        "capsule-needs-urdf-1.1",
        "the shape 'capsule' needs URDF 1.1, which this robot does not declare: urdfdom (ROS, "
        "RViz, MoveIt) and pinocchio ignore the shape, yourdfpy rejects it",
        span,
        hint="write robot/name=…, version=1.1: as the root, which urdfdom "
        "supports from version 5.1, or use a cylinder",
        trace=key.trace,
    )


def _element(geometry: Geometry) -> Element:
    """Return `<geometry>` with the shape in it."""
    key, scale, scale_span = geometry.key, geometry.scale, geometry.scale_span
    attributes: dict[str, object]
    if geometry.kind == "mesh":
        attributes = {"filename": geometry.word}
        spans = {"filename": geometry.span}
        if scale is not None:
            attributes["scale"] = scale.text
            spans["scale"] = scale_span
    else:
        assert scale is not None
        names = SIZES[geometry.kind]
        words = scale.words if len(names) > 1 else (scale.text,)
        attributes = dict(zip(names, words, strict=True))
        spans = dict.fromkeys(names, scale_span)
    shape = Element(geometry.kind, key.span, attributes, [], key.trace, spans)
    return Element("geometry", key.span, {}, [shape], key.trace)


# --- shapes for inertia -----------------------------------------------------------------------


def solid_shape(lowering: Lowering, geometry: Geometry) -> Solid:
    """Return the shape as a body with volume and inertia; a mesh is read from its file.

    Raises:
        YamaroError: sizes that are not positive, or a mesh that is missing or not closed.
    """
    values = geometry.scale.values if geometry.scale is not None else (1.0, 1.0, 1.0)
    if geometry.kind == "mesh":
        return _solid_mesh(lowering, geometry, values)
    if min(values) <= 0:
        assert geometry.scale is not None
        raise failure(
            "bad-size",
            f"a {geometry.kind} of the size '{geometry.scale.text}' has no inertia",
            geometry.scale_span,
            hint="sizes are greater than 0, in metres",
            trace=geometry.key.trace,
        )
    return SIMPLE_SHAPES[geometry.kind](*values)


def _solid_mesh(lowering: Lowering, geometry: Geometry, scale: tuple[float, ...]) -> MeshSolid:
    path = lowering.resolve_mesh(geometry.word, geometry.span)
    if path is None:
        raise failure(
            "missing-mesh",
            f"the mesh '{geometry.word}' is not found, but the inertia is computed from it",
            geometry.span,
            hint="a relative path starts at the folder of the file that "
            "contains it; or write 'inertia' explicitly",
            trace=geometry.key.trace,
        )
    moments = lowering.moments.get(path)
    if moments is None:
        moments = lowering.moments[path] = _read_moments(lowering, geometry, path)
    x, y, z = scale
    scaled = moments.scaled((x, y, z))
    if scaled.volume == 0:
        assert geometry.scale is not None
        raise failure(
            "bad-size",
            f"a mesh of the scale '{geometry.scale.text}' has no inertia",
            geometry.scale_span,
            hint="no factor can be 0",
            trace=geometry.key.trace,
        )
    return MeshSolid(scaled)


def _read_moments(lowering: Lowering, geometry: Geometry, path: str) -> SolidMoments:
    """Return the volume integrals of a mesh file, for scale 1."""
    from ..meshes.triangles import is_closed
    from ..model.mesh_integrals import solid_moments

    span, word, trace = geometry.span, geometry.word, geometry.key.trace
    mesh = _read_mesh(lowering, geometry, path)
    if is_closed(mesh):
        moments = solid_moments(mesh)
        size = max(max(axis) - min(axis) for axis in zip(*mesh.vertices, strict=True))
        if not isfinite(moments.volume + sum(moments.second)):
            raise failure(
                "bad-number",
                f"the mesh '{word}' is too large: its volume is not a number",
                span,
                hint="sizes are in metres; a mesh in other units needs its 'scale'",
                trace=trace,
            )
        if moments.volume > SMALLEST_VOLUME * size * size * size:
            return moments
        problem = "encloses no volume"
    else:
        problem = "is not closed, so it encloses no volume"
    raise failure(
        "open-mesh",
        f"the mesh '{word}' {problem}, but the inertia is computed from it",
        span,
        hint="write 'inertia' explicitly, or add a simple shape "
        "to 'inertial:', such as geometry: box "
        "and scale: 0.4 0.3 0.2",
        trace=trace,
    )


def _read_mesh(lowering: Lowering, geometry: Geometry, path: str) -> TriangleMesh:
    """Return the triangles of a mesh file.

    Raises:
        YamaroError: it cannot be read.
    """
    from ..meshes.formats import FORMAT_NAMES, MeshFileError, MissingLibraryError
    from ..meshes.triangles import read_mesh

    span, word, trace = geometry.span, geometry.word, geometry.key.trace
    try:
        return read_mesh(path, lowering.may_read)
    except MeshFileError as error:
        readable = " ".join(f".{ending}" for ending in FORMAT_NAMES)
        raise failure(
            "bad-mesh",
            f"the mesh '{word}' cannot be read: {error}",
            span,
            hint=f"write 'inertia' explicitly; it can be computed only from {readable}",
            trace=trace,
        ) from error
    except MissingLibraryError as error:
        raise failure(
            "missing-extra",
            f"reading the mesh '{word}' needs the Python package '{error}'",
            span,
            hint="run pip install \"yamaro[mesh]\", write 'inertia' explicitly, or "
            "use an .stl or .obj file, which need no package",
            trace=trace,
        ) from error
