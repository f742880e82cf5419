"""The `geometry` and `scale` of a link or section: the shape, and its `<geometry>` element."""

from __future__ import annotations

from math import isfinite

from ..diagnostics import YamaroError, failure, suggest
from ..model.shapes import COUNTS, SIMPLE_SHAPES, SIZES, MeshSolid
from ..xml.tree import Element, Text
from ..xml.values import Numbers, format_value, is_number
from .fields import SIZE_KEYS, read_record, read_value, word_of
from .numbers import read_numbers, split_row

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..diagnostics import Diagnostic
    from ..meshes.triangles import TriangleMesh
    from ..model.inertia import SolidMoments
    from ..model.shapes import Solid
    from ..source import Span
    from .fields import Fields
    from .lowering import Lowering

SMALLEST_VOLUME = 1e-9
"""Part of the cube of a mesh's size below which its volume is only rounding."""


class Geometry:
    """A shape word with its scale, and the `<geometry>` that both make.

    Attributes:
        key: the `geometry` key.
        kind: `box`, `cylinder`, `sphere`, `capsule` or `mesh`.
        word: the shape or the mesh file as written.
        span: where the word is written.
        scale: the scale, or the sizes as one; None for a mesh without one.
        spans: where each of the shape's attributes is written; a scale is that of all.
        element: the `<geometry>` element.
    """

    __slots__ = ("element", "key", "kind", "scale", "span", "spans", "word")

    def __init__(
        self,
        key: Element,
        *,
        kind: str,
        word: str,
        span: Span,
        scale: Numbers | None,
        spans: dict[str, Span],
    ) -> None:
        """Hold a geometry and make its element."""
        self.key = key
        self.kind = kind
        self.word = word
        self.span = span
        self.scale = scale
        self.spans = spans
        attributes: dict[str, object]
        if kind == "mesh":
            attributes = {"filename": word}
            spans = {"filename": span, **spans}
            if scale is not None:
                attributes["scale"] = scale
        else:
            assert scale is not None
            names = SIZES[kind]
            sizes = scale.one_by_one() if len(names) > 1 else [scale]
            attributes = dict(zip(names, sizes, strict=True))
        shape = Element(kind, key.span, attributes, [], key.trace, spans)
        self.element = Element("geometry", key.span, {}, [shape], key.trace)

    @property
    def scale_span(self) -> Span:
        """Return where the scale is written, or the first of the sizes."""
        return next(iter(self.spans.values()), self.span)


class LinkGeometry:
    """The geometry and sizes written in a link, which its sections inherit when they use them."""

    __slots__ = ("_made", "fields", "is_used", "key", "sizes")

    def __init__(self, fields: Fields) -> None:
        """Hold the keys; they are read when a section first uses them."""
        self.fields = fields
        self.key = fields.keys.get("geometry")
        self.sizes = sizes_in(fields)
        self.is_used = False
        self._made: Geometry | None = None

    def geometry(self, lowering: Lowering) -> Geometry | None:
        """Return the link's own geometry, read once, or None if it has none.

        Raises:
            YamaroError: the geometry or its scale is faulty.
        """
        if self._made is None and self.key is not None:
            self.is_used = True
            self._made = read_geometry(lowering, self.key, self.sizes)
        return self._made


def sizes_in(fields: Fields) -> list[Element]:
    """Return the keys of a link or section that give its shape a size."""
    return [key for name, key in fields.keys.items() if name in SIZE_KEYS]


def section_geometry(lowering: Lowering, fields: Fields, link: LinkGeometry) -> Geometry | None:
    """Return the geometry a section has or inherits, or None if there is none.

    Geometry and sizes are inherited together: with its own geometry a section takes only its own
    sizes; with only sizes it is the link's shape in another size.

    Raises:
        YamaroError: the geometry or its sizes are faulty.
    """
    key = fields.keys.get("geometry")
    sizes = sizes_in(fields)
    if key is not None:
        return read_geometry(lowering, key, sizes, link_sizes=link.sizes)
    if not sizes or link.key is None:
        return link.geometry(lowering)
    link.is_used = True
    return read_geometry(lowering, link.key, sizes)


def read_geometry(
    lowering: Lowering,
    key: Element,
    sizes: list[Element],
    *,
    link_sizes: Sequence[Element] = (),
) -> Geometry:
    """Return the geometry of a `geometry` key and of `scale`, or of `radius`, `length` and `size`.

    Raises:
        YamaroError: a misspelt shape, URDF's own form of a geometry, or faulty sizes.
    """
    kind, word, span = _read_shape_word(lowering, key)
    scale = None
    spans: dict[str, Span] = {}
    first = sizes[0] if sizes else None
    if first is not None and first.name == "scale" and len(sizes) == 1:
        value, place = read_value(first)
        spans = dict.fromkeys(SIZES.get(kind, ("scale",)), place)
        name, count = f"scale of a {kind}", COUNTS.get(kind, 3)
        of_all = _scale_of_all(lowering, value, place, first) if kind == "mesh" else None
        scale = of_all or read_numbers(
            lowering, value, place, count=count, name=name, trace=first.trace
        )
    elif sizes:
        scale = _read_sizes(lowering, kind, sizes, spans)
    elif kind != "mesh":
        notes = []
        shape = SIMPLE_SHAPES[kind]
        if link_sizes:
            own = link_sizes[0]
            notes.append(
                f"the link's {own.name} at {own.span.place()} belongs to the link's own geometry"
            )
        raise failure(
            "missing-scale",
            f"the geometry '{word}' has no scale",
            key.span,
            hint=f"write it beside 'geometry', as scale: {shape.example} ({' '.join(shape.sizes)})",
            notes=notes,
            trace=key.trace,
        )
    if kind == "capsule" and not lowering.has_capsule:
        lowering.report(
            "capsule-needs-urdf-1.1",
            "the shape 'capsule' needs URDF 1.1, which this robot does not declare: urdfdom (ROS, "
            "RViz, MoveIt) and pinocchio ignore the shape, yourdfpy rejects it",
            span,
            hint="write robot/name=…, version=1.1: as the root, which urdfdom "
            "supports from version 5.1, or use a cylinder",
            trace=key.trace,
        )
    return Geometry(key, kind=kind, word=word, span=span, scale=scale, spans=spans)


def _scale_of_all(lowering: Lowering, value: object, place: Span, key: Element) -> Numbers | None:
    """Return the factors of a mesh if one number is given for all axes, else None.

    With a unit of length it says what the numbers in the file are in: `1mm` is 0.001.
    """
    is_one = len(split_row(value)) == 1 if isinstance(value, str) else is_number(value)
    if not is_one:
        return None
    one = read_numbers(
        lowering, value, place, count=1, name="scale of a mesh", trace=key.trace, kind="length"
    )
    return Numbers(one.words * 3, one.values * 3)


def _read_sizes(
    lowering: Lowering, kind: str, sizes: list[Element], spans: dict[str, Span]
) -> Numbers:
    """Return the numbers of `radius`, `length` or `size` as those of a scale; note their places."""
    given = {size.name: size for size in sizes}
    _check_sizes(kind, given)
    words: list[str] = []
    values: list[float] = []
    written: list[float] = []
    faults: list[Diagnostic] = []
    for name in SIZES[kind]:
        size = given[name]
        try:
            value, spans[name] = read_value(size)
            numbers = read_numbers(
                lowering,
                value,
                spans[name],
                count=COUNTS[kind] if len(given) == 1 else 1,
                name="size of a box" if name == "size" else name,
                trace=size.trace,
            )
        except YamaroError as error:
            faults += error.diagnostics
            continue
        words += numbers.words
        values += numbers.values
        written += numbers.written
    if faults:
        raise YamaroError(faults)
    return Numbers(tuple(words), tuple(values), tuple(written))


def _check_sizes(kind: str, given: dict[str, Element]) -> None:
    """Raise YamaroError unless each size of a shape is given, and no other."""
    wanted = SIZES.get(kind, ())
    first = next(iter(given.values()))
    for name, size in given.items():
        if "scale" in given and name != "scale":
            raise failure(
                "given-twice",
                f"the size is given twice, by 'scale' and by '{name}'",
                size.span,
                hint="remove one of the two",
                notes=(f"'scale' is given at {given['scale'].span.place()}",),
                trace=size.trace,
            )
        if name not in wanted and name != "scale":
            listed = " and ".join(f"'{each}'" for each in wanted)
            raise failure(
                "unknown-key",
                f"a {kind} has no '{name}'",
                size.span,
                hint=f"a {kind} has {listed}" if wanted else "a mesh is scaled by 'scale'",
                trace=size.trace,
            )
    for name in wanted:
        if name not in given:
            raise failure(
                "missing-scale",
                f"the geometry '{kind}' has no '{name}'",
                first.span,
                hint=f"write {name}: beside {first.name}:",
                trace=first.trace,
            )


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
    from ..model.inertia import MESH_ENDINGS

    if mesh_ending(word) in MESH_ENDINGS:
        return "mesh", word, span
    from ..fixes import respelling

    near = _OTHER_SHAPES.get(kind) or suggest(kind, COUNTS)
    shape, _, sizes = word.partition(" ")
    if near is not None:
        hint = f"did you mean '{near}'?"
    elif shape.lower() in COUNTS:
        hint = f"write geometry: {shape}, and scale: {sizes.strip()} beside it"
    elif kind == "mesh":
        hint = "write the mesh file itself, such as geometry: meshes/arm.stl"
    elif "." in word or "/" in word:
        endings = " ".join(f".{ending}" for ending in MESH_ENDINGS)
        hint = f"the extensions of mesh files are {endings}"
    else:
        shapes = ", ".join(SIMPLE_SHAPES)
        hint = f"the shapes are {shapes}, and mesh files such as meshes/arm.stl"
    raise failure(
        "unknown-shape",
        f"'{word}' is neither a shape nor a mesh file",
        span,
        hint=hint,
        trace=key.trace,
        fix=respelling(span, word, near, is_safe=True),
    )


_OTHER_SHAPES = {
    **dict.fromkeys(("cube", "cuboid", "rectangle"), "box"),
    "ball": "sphere",
    "tube": "cylinder",
}
"""What other formats and people call the shapes."""


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
        raise wrong_size(geometry, "inertia")
    return SIMPLE_SHAPES[geometry.kind](*values)


def _solid_mesh(lowering: Lowering, geometry: Geometry, scale: tuple[float, ...]) -> MeshSolid:
    path = lowering.resolve_mesh(geometry.word, geometry.span)
    if path is None:
        hint = where_it_may_be(lowering, geometry.word, geometry.span)
        raise failure(
            "missing-mesh",
            f"the mesh '{geometry.word}' is not found, but the inertia is computed from it",
            geometry.span,
            hint=f"{hint}; or write 'inertia' explicitly",
            trace=geometry.key.trace,
        )
    moments = lowering.moments.get(path)
    if moments is None:
        moments = lowering.moments[path] = _read_moments(lowering, geometry, path)
    x, y, z = scale
    scaled = moments.scaled((x, y, z))
    if scaled.volume == 0:
        raise wrong_size(geometry, "inertia")
    return MeshSolid(scaled)


def wrong_size(geometry: Geometry, lacks: str) -> YamaroError:
    """Return the error for what has no inertia or shape, since its size or a mesh's scale is 0."""
    assert geometry.scale is not None
    if geometry.kind == "mesh":
        word, hint = "scale", "no factor can be 0"
    else:
        word, hint = "size", "sizes are greater than 0, in metres"
    return failure(
        "bad-size",
        f"a {geometry.kind} of the {word} '{geometry.scale.text}' has no {lacks}",
        geometry.scale_span,
        hint=hint,
        trace=geometry.key.trace,
    )


def where_it_may_be(lowering: Lowering, word: str, span: Span) -> str:
    """Return the hint about a mesh that is not found."""
    scheme, _, rest = word.partition("://")
    if scheme in ("http", "https"):
        return "meshes are not downloaded: name a file"
    if scheme != "package" or lowering.package_fault is None:
        return "a relative path starts at the folder of the file that contains it"
    fault = lowering.package_fault(rest.partition("/")[0], span)
    return "the package exists, but does not contain this file" if fault is None else fault[0]


def _read_moments(lowering: Lowering, geometry: Geometry, path: str) -> SolidMoments:
    """Return the volume integrals of a mesh file, for scale 1."""
    from ..meshes.triangles import is_closed
    from ..model.inertia import solid_moments

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
