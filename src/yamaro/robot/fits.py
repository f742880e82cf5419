"""`fit`, `decompose`, `spheres` and `triangles`: shapes of a section worked out from its mesh.

Each piece becomes a `<collision>` or `<visual>` of its own. What there is to know of them is a note
beside the link.
"""

from __future__ import annotations

from ..diagnostics import failure
from ..model.schema import FITS, FITTING
from ..xml.tree import Element, RobotNote
from ..xml.values import Numbers, format_value
from .extras import read_field
from .fields import FIT_KEYS, LIGHTER_KEYS
from .notes import TRUTHS, one_of
from .numbers import format_component
from .pose import Pose, compose_poses, origin_element

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..fitting.fit import Fit, Placed, Wanted
    from ..meshes.cache import MeshCache
    from ..source import Span
    from ..xml.tree import Node
    from .fields import Fields
    from .geometry import Geometry
    from .lowering import Lowering


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
    fit = _worked_out(lowering, asked, geometry, wanted)
    made: list[Element] = []
    name = format_value(key.attributes.get("name")).strip()
    for number, piece in enumerate(fit.pieces):
        children: list[Node] = [*rest]
        shape, origin = _piece(lowering, asked, geometry, piece, pose, number)
        section = key.with_children(
            [shape, *children] if origin is None else [origin, shape, *children]
        )
        if name and number:
            section.attributes = {**key.attributes, "name": f"{name}_{number + 1}"}
        made.append(section)
    lowering.fits[id(key)] = key, _note(asked, geometry, wanted, fit, pose)
    return made


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
    number, _ = read_field(lowering, FITTING.fields[asked.name], asked)
    assert isinstance(number, Numbers)
    return Wanted(asked.name, count=int(number.values[0]), covers=covers)


# --- the result -------------------------------------------------------------------------------


def _worked_out(lowering: Lowering, asked: Element, geometry: Geometry, wanted: Wanted) -> Fit:
    """Return the shape; see `fitting.fit.work_out`.

    Raises:
        YamaroError: the mesh is missing or cannot be used, or a library is missing.
    """
    from ..fitting.fit import work_out
    from ..meshes.formats import MeshFileError, MissingLibraryError

    word, span, trace = geometry.word, geometry.span, asked.trace
    path = lowering.resolve_mesh(word, span)
    if path is None:
        raise failure(
            "missing-mesh",
            f"the mesh '{word}' is not found, but a shape is worked out from it",
            span,
            hint="a relative path starts at the folder of the file that contains it",
            notes=[f"'{asked.name}' is given at {asked.span.place()}"],
            trace=trace,
        )
    scale = geometry.scale.values if geometry.scale is not None else (1.0, 1.0, 1.0)
    fitter = lowering.fitter
    if fitter.on_work is not None:
        fitter.on_work(f"{wanted} of {word}")
    try:
        return work_out(
            path,
            scale,
            wanted,
            allows=lowering.may_read,
            cache=_cache() if fitter.is_cached else None,
        )
    except MeshFileError as error:
        raise failure(
            "bad-mesh",
            f"no shape can be worked out from the mesh '{word}': {error}",
            span,
            hint=f"repair the mesh, or write a shape in place of '{asked.name}', such as "
            "geometry: box",
            notes=[f"'{asked.name}' is given at {asked.span.place()}"],
            trace=trace,
        ) from error
    except MissingLibraryError as error:
        raise failure(
            "missing-extra",
            f"'{asked.name}' needs the Python package '{error}'",
            asked.span,
            hint='run pip install "yamaro[fit]"',
            trace=trace,
        ) from error


def _cache() -> MeshCache | None:
    import os

    from ..meshes.cache import MeshCache, cache_folder

    folder = cache_folder(os.environ)
    return None if folder is None else MeshCache(folder)


def _piece(
    lowering: Lowering,
    asked: Element,
    geometry: Geometry,
    piece: Placed | bytes,
    pose: Pose,
    number: int,
) -> tuple[Element, Element | None]:
    """Return the `<geometry>` and the `<origin>` of a piece."""
    span = asked.span
    spans: dict[str, Span]
    if isinstance(piece, bytes):
        make = lowering.fitter.make_mesh
        stem = geometry.word.replace("\\", "/").rpartition("/")[2].rpartition(".")[0] or "mesh"
        name = f"{stem}-{asked.name if asked.name != 'fit' else 'hull'}"
        filename = name if make is None else make(name, piece)
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


def _row(values: tuple[float, ...]) -> Numbers:
    return Numbers(tuple(map(format_component, values)), values)


def _note(asked: Element, geometry: Geometry, wanted: Wanted, fit: Fit, pose: Pose) -> RobotNote:
    """Return the note of what was worked out, without the name and the place of its link."""
    attributes: dict[str, object] = {
        "word": wanted.word,
        "kind": wanted.kind,
        "wanted": str(wanted.count),
        "cover": TRUTHS[0] if wanted.covers else TRUTHS[1],
        "count": str(len(fit.pieces)),
        "distance": Numbers.of(fit.distance),
        "excess": "" if fit.excess is None else Numbers.of(fit.excess),
        "size": Numbers.of(fit.size),
        "filename": geometry.word,
        "scale": geometry.scale or Numbers.of(1.0, 1.0, 1.0),
        "xyz": pose.xyz,
        "rpy": pose.rpy,
    }
    spans = dict.fromkeys(attributes, asked.span)
    spans["filename"] = geometry.span
    return RobotNote("fit", asked.span, attributes, [], asked.trace, spans)


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
