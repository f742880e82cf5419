"""`fit`, `decompose`, `spheres` and `triangles`: shapes of a section worked out from its mesh.

Each piece becomes a `<collision>` or `<visual>` of its own. What there is to know of them is a note
beside the link.
"""

from __future__ import annotations

from ..diagnostics import failure
from ..model.schema import FITS, FITTING, MOST_SHAPES
from ..xml.tree import Element, RobotNote
from ..xml.values import Numbers, format_value
from .extras import read_field
from .fields import FIT_KEYS, LIGHTER_KEYS
from .geometry import where_it_may_be, wrong_size
from .material import material_of
from .notes import TRUTHS, one_of
from .numbers import format_component
from .pose import Pose, compose_poses, origin_element

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Container, Sequence

    from ..diagnostics import Frame
    from ..fitting.fit import Fit, Placed, Wanted
    from ..meshes.cache import MeshCache
    from ..source import Span
    from ..xml.tree import Node
    from .fields import Fields
    from .geometry import Geometry
    from .lowering import Lowering

KEPT = "kept"
"""What was made of a mesh that has few enough triangles."""


def fitted_sections(
    lowering: Lowering,
    key: Element,
    fields: Fields,
    geometry: Geometry | None,
    pose: Pose,
    rest: list[Node],
) -> list[Element]:
    """Return the sections that a `collision` or `visual` key asks to be worked out.

    Args:
        lowering: the run.
        key: the key.
        fields: the keys in it.
        geometry: its geometry; None for an element in angle brackets.
        pose: T_link_mesh.
        rest: what each section has besides origin and geometry.

    Raises:
        YamaroError: what it asks for makes no sense, or its mesh does not allow it.
    """
    asked = _asked(fields, key)
    if geometry is None or geometry.kind != "mesh" or fields.plain:
        kind = "in angle brackets" if geometry is None or fields.plain else f"a {geometry.kind}"
        raise failure(
            "fit-without-mesh",
            f"'{asked.name}' works a shape out from a mesh, and the geometry here is {kind}",
            asked.span,
            hint=f"remove '{asked.name}', or write geometry: meshes/arm.stl",
            trace=asked.trace,
        )
    wanted = _wanted(lowering, asked, fields)
    if geometry.scale is not None and 0 in geometry.scale.values:
        raise wrong_size(geometry, "shape")
    _show_progress(lowering)
    fit = worked_out(
        lowering,
        wanted,
        word=geometry.word,
        span=geometry.span,
        scale=geometry.scale.values if geometry.scale is not None else (1.0, 1.0, 1.0),
        at=asked.span,
        trace=asked.trace,
    )
    pieces = pieces_to_write(lowering, fit)
    placed = [_piece(lowering, asked, wanted, geometry, piece, pose) for piece in pieces]
    looks = looks_of(lowering, fit, asked, rest, filename=geometry.word)
    made: list[Element] = []
    name = format_value(key.attributes.get("name")).strip()
    for number, (shape, origin) in enumerate(
        placed or [(geometry.element, origin_element(pose, asked))]
    ):
        children: list[Node] = [shape, *rest, *(looks[number] if looks else ())]
        section = key.with_children(children if origin is None else [origin, *children])
        if name and number:
            section.attributes = {**key.attributes, "name": f"{name}_{number + 1}"}
        made.append(section)
    note = note_of(
        wanted,
        fit,
        span=asked.span,
        place=geometry.span,
        trace=asked.trace,
        count=len(made),
        filename=geometry.word,
        scale=geometry.scale or Numbers.of(1.0, 1.0, 1.0),
        xyz=pose.xyz,
        rpy=pose.rpy,
    )
    lowering.fits[id(key)] = key, note
    return made


def _show_progress(lowering: Lowering) -> None:
    """Show how many of the shapes that the robot asks for are worked out."""
    fitter = lowering.fitter
    if fitter.on_work is None or lowering.root is None:
        return
    if not fitter.total:
        names = FIT_KEYS | LIGHTER_KEYS
        fitter.total = sum(each.name in names for each in lowering.root.iter())
    fitter.on_work(min(len(lowering.fits) / max(fitter.total, 1), 0.99))


# --- what is asked for ------------------------------------------------------------------------


def _asked(fields: Fields, key: Element) -> Element:
    """Return the one key that asks for a shape.

    Raises:
        YamaroError: there are two, or only `cover`.
    """
    found = [each for name, each in fields.keys.items() if name in FIT_KEYS | LIGHTER_KEYS]
    if not found:
        cover = fields.keys["cover"]
        raise failure(
            "misplaced-key",
            "'cover' belongs to a shape that is worked out, and none is asked for here",
            cover.span,
            hint="write fit: capsule beside it, or remove it",
            trace=key.trace,
        )
    if len(found) > 1:
        raise failure(
            "given-twice",
            f"the shape is asked for twice, by '{found[0].name}' and by '{found[1].name}'",
            found[1].span,
            hint="remove one of the two; a link can have several collisions",
            notes=[f"'{found[0].name}' is given at {found[0].span.place()}"],
            trace=key.trace,
        )
    return found[0]


def _wanted(lowering: Lowering, asked: Element, fields: Fields) -> Wanted:
    from ..fitting.fit import Wanted

    cover = fields.keys.get("cover")
    covers = cover is not None and one_of(cover, TRUTHS) == "true"
    if asked.name == "fit":
        return Wanted("fit", kind=one_of(asked, FITS), covers=covers)
    number, span = read_field(lowering, FITTING.fields[asked.name], asked)
    assert isinstance(number, Numbers)
    count = int(number.values[0])
    if asked.name in FIT_KEYS and count > MOST_SHAPES:
        raise failure(
            "bad-number",
            f"'{asked.name}' takes at most {MOST_SHAPES}, and this is {count}",
            span,
            hint=f"write {asked.name}: {FITTING.fields[asked.name].example}",
            trace=asked.trace,
        )
    return Wanted(asked.name, count=count, covers=covers)


# --- the result -------------------------------------------------------------------------------


def worked_out(
    lowering: Lowering,
    wanted: Wanted,
    *,
    word: str,
    span: Span,
    scale: tuple[float, ...],
    at: Span,
    trace: Frame | None,
) -> Fit:
    """Return a shape for a mesh; see `fitting.fit.work_out`.

    Args:
        lowering: the run.
        wanted: what is asked for.
        word: the mesh file, as it is written.
        span: where it is written.
        scale: the factors of the mesh.
        at: where it is asked for.
        trace: the calls and includes that led there.

    Raises:
        YamaroError: the mesh is missing or cannot be used, or a library is missing.
    """
    from ..fitting.fit import work_out
    from ..meshes.formats import MeshFileError, MissingLibraryError

    notes = [] if at is span else [f"'{wanted.word}' is given at {at.place()}"]
    path = lowering.resolve_mesh(word, span)
    if path is None:
        raise failure(
            "missing-mesh",
            f"the mesh '{word}' is not found, but a shape is worked out from it",
            span,
            hint=where_it_may_be(lowering, word, span),
            notes=notes,
            trace=trace,
        )
    try:
        return work_out(
            path,
            scale,
            wanted,
            allows=lowering.may_read,
            cache=_cache() if lowering.fitter.is_cached else None,
            known=lowering.fitter.known,
        )
    except MeshFileError as error:
        raise failure(
            "bad-mesh",
            f"no shape can be worked out from the mesh '{word}': {error}",
            span,
            hint=f"repair the mesh, or write a shape in place of '{wanted.word}', such as "
            "geometry: box"
            if notes
            else "repair the mesh, or name the other links: --links 'arm_*'",
            notes=notes,
            trace=trace,
        ) from error
    except MissingLibraryError as error:
        raise failure(
            "missing-extra",
            f"'{wanted.word}' needs the Python package '{error}'",
            at,
            hint='run pip install "yamaro[fit]"',
            trace=trace,
        ) from error


def _cache() -> MeshCache | None:
    import os

    from ..meshes.cache import MeshCache, cache_folder

    folder = cache_folder(os.environ)
    return None if folder is None else MeshCache(folder)


def pieces_to_write(lowering: Lowering, fit: Fit) -> tuple[Placed | bytes, ...]:
    """Return the pieces as they are written: capsules are not in URDF 1.0."""
    pieces = fit.pieces
    if not lowering.has_capsule:
        split = _without_capsules(pieces)
        if split is not pieces:
            lowering.fitter.differs_in_urdf = True
            return split if lowering.fitter.is_for_urdf else pieces
    return pieces


def _without_capsules(pieces: tuple[Placed | bytes, ...]) -> tuple[Placed | bytes, ...]:
    """Return pieces with a cylinder and two spheres in place of each capsule.

    Only urdfdom from version 5.1 knows capsules, in robots of version 1.1; the readers of ROS 2
    before that, and pinocchio, drop the shape, so that nothing would collide.
    """
    from ..fitting.fit import Placed
    from ..model.pose import rotate, rotation_from_rpy
    from ..model.shapes import Capsule, Cylinder, Sphere

    found: list[Placed | bytes] = []
    for piece in pieces:
        if isinstance(piece, bytes) or not isinstance(piece.shape, Capsule):
            found.append(piece)
            continue
        radius, length = piece.shape.size
        found.append(Placed(Cylinder(radius, length), piece.xyz, piece.rpy))
        x, y, z = piece.xyz
        a, b, c = rotate(rotation_from_rpy(*piece.rpy), (0.0, 0.0, length / 2))
        ends = ((x + a, y + b, z + c), (x - a, y - b, z - c))
        found += [Placed(Sphere(radius), end, (0.0, 0.0, 0.0)) for end in ends]
    return pieces if len(found) == len(pieces) else tuple(found)


def _piece(
    lowering: Lowering,
    asked: Element,
    wanted: Wanted,
    geometry: Geometry,
    piece: Placed | bytes,
    pose: Pose,
) -> tuple[Element, Element | None]:
    """Return the `<geometry>` and the `<origin>` of a piece."""
    span = asked.span
    spans: dict[str, Span]
    if isinstance(piece, bytes):
        filename = filename_of(lowering, wanted, geometry.word, piece)
        spans = {"filename": span}
        shape = Element("mesh", span, {"filename": filename}, [], asked.trace, spans)
    else:
        inner = Pose(_row(piece.xyz), _row(piece.rpy), span, {"xyz": span, "rpy": span})
        pose = compose_poses(pose, inner)
        values = piece.shape.size
        names = piece.shape.attributes
        sizes = [Numbers.of(*values)] if len(names) == 1 else [Numbers.of(each) for each in values]
        spans = dict.fromkeys(names, span)
        attributes: dict[str, object] = dict(zip(names, sizes, strict=True))
        shape = Element(piece.shape.kind, span, attributes, [], asked.trace, spans)
    element = Element("geometry", span, {}, [shape], asked.trace)
    return element, origin_element(pose, asked)


def filename_of(lowering: Lowering, wanted: Wanted, mesh: str, piece: bytes) -> str:
    """Return the name of a piece that is a mesh, after that of the mesh file."""
    stem = mesh.replace("\\", "/").rpartition("/")[2].rpartition(".")[0] or "mesh"
    name = f"{stem}-{wanted.kind or wanted.word}"
    make = lowering.fitter.make_mesh
    return name if make is None else make(name, piece)


def looks_of(
    lowering: Lowering,
    fit: Fit,
    key: Element,
    rest: Sequence[Node],
    *,
    filename: str,
    taken: Container[str] = (),
) -> list[list[Element]]:
    """Return the `<material>` of each piece; none where the visual has one.

    Args:
        lowering: the run.
        fit: the result.
        key: where it is asked for.
        rest: what each visual has besides origin and geometry.
        filename: the mesh file.
        taken: names that materials have already.
    """
    if any(isinstance(each, Element) and each.name == "material" for each in rest):
        return []
    if fit.loses:
        lowering.report(
            "lost-colors",
            f"the {fit.loses} of the mesh '{filename}' cannot be kept with fewer triangles",
            key.span,
            hint="write a color in the visual, or leave this mesh as it is",
            trace=key.trace,
        )
    found: list[list[Element]] = []
    for color in fit.colors:
        rgba = None if color is None else Numbers.of(*color)
        written: dict[str, object] = {"rgba": rgba}
        element = Element("color", key.span, written, [], key.trace)
        found.append([] if color is None else [material_of(lowering, element, color, taken=taken)])
    return found


def _row(values: tuple[float, ...]) -> Numbers:
    return Numbers(tuple(map(format_component, values)), values)


def _made(wanted: Wanted, fit: Fit) -> str:
    """Return what was made, in a word."""
    if not fit.pieces:
        return KEPT
    first = fit.pieces[0]
    if wanted.word == "fit":
        return "hull" if isinstance(first, bytes) else first.shape.kind
    return {"decompose": "pieces", "spheres": "spheres"}.get(wanted.word, "mesh")


def note_of(
    wanted: Wanted,
    fit: Fit,
    *,
    span: Span,
    place: Span,
    trace: Frame | None,
    count: int,
    filename: str,
    scale: Numbers,
    xyz: Numbers,
    rpy: Numbers,
) -> RobotNote:
    """Return the note of what was worked out, without the name and the place of its link.

    Args:
        wanted: what was asked for.
        fit: the result.
        span: where it is asked for.
        place: where the mesh file is written.
        trace: the calls and includes that led there.
        count: of the sections that are made of it.
        filename: the mesh file.
        scale: its factors.
        xyz: T_link_mesh, with `rpy`.
        rpy: its rotation.
    """
    attributes: dict[str, object] = {
        "word": wanted.word,
        "kind": wanted.kind,
        "made": _made(wanted, fit),
        "wanted": str(wanted.count),
        "cover": TRUTHS[0] if wanted.covers else TRUTHS[1],
        "count": str(count),
        "distance": Numbers.of(fit.distance),
        "excess": "" if fit.excess is None else Numbers.of(fit.excess),
        "size": Numbers.of(fit.size),
        "filename": filename,
        "scale": scale,
        "xyz": xyz,
        "rpy": rpy,
    }
    spans = {**dict.fromkeys(attributes, span), "filename": place}
    return RobotNote("fit", span, attributes, [], trace, spans)


def note_fits(lowering: Lowering, link: Element, name: str, out: list[Node]) -> None:
    """Append the notes of the sections of a `link` key that were worked out."""
    numbers = {"visual": 0, "collision": 0}
    for child in link.children:
        if type(child) is not Element or child.name not in numbers:
            continue
        known = lowering.fits.get(id(child))
        count = 1
        if known is not None:
            note = known[1]
            count = int(str(note.attributes["count"]))
            attributes = {
                "link": name,
                "section": child.name,
                "index": str(numbers[child.name]),
                **note.attributes,
            }
            lowering.has_words = True
            trace = lowering.trace if note.inherits_trace() else note.trace
            out.append(RobotNote("fit", note.span, attributes, [], trace, note.value_spans))
        numbers[child.name] += count
