"""Shapes worked out from all meshes that the links of a finished robot collide with."""

from __future__ import annotations

from fnmatch import fnmatchcase
from time import monotonic

from ..diagnostics import YamaroError, failure
from ..model.pose import Pose as ModelPose
from ..model.pose import rotation_from_rpy, rpy_from_rotation
from ..model.reading import read_robot
from ..model.shapes import Mesh
from ..xml.tree import Element, RobotNote
from ..xml.values import Numbers, format_value
from .fits import looks_of, note_of, pieces_to_write, worked_out
from .numbers import format_component

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Container, Sequence

    from ..fitting.fit import Placed, Wanted
    from ..model.link import Collision, Link, Visual
    from ..xml.tree import Node
    from .lowering import Lowering


class Refitting:
    """What is asked for of all meshes of a robot.

    Attributes:
        collision: what links collide with, or None to leave that as it is.
        triangles: the most triangles of a mesh that is seen; 0 leaves them as they are.
        links: patterns of the names of links, of those to leave out after a `!`; none for all.
    """

    __slots__ = ("collision", "links", "triangles")

    def __init__(
        self,
        collision: Wanted | None,
        *,
        triangles: int = 0,
        links: Sequence[str] = (),
    ) -> None:
        """Ask for it; see the class."""
        self.collision = collision
        self.triangles = triangles
        self.links = tuple(links)

    def has_link(self, name: str) -> bool:
        """Return whether shapes of a link are asked for."""
        left_out = [each[1:] for each in self.links if each.startswith("!")]
        if any(fnmatchcase(name, each) for each in left_out):
            return False
        named = [each for each in self.links if not each.startswith("!")]
        return not named or any(fnmatchcase(name, each) for each in named)


def refitted(
    lowering: Lowering,
    root: Element,
    notes: Sequence[Element],
    wanted: Refitting,
    *,
    on_work: Callable[[float], None] | None = None,
) -> tuple[Element, list[Element]]:
    """Return a robot whose links collide with shapes that are worked out, and its notes.

    A mesh that was itself worked out, as in a YAML file, stays as it is.

    Args:
        lowering: a run for the robot.
        root: the robot, without parts.
        notes: what else it has.
        wanted: what is asked for.
        on_work: is called with how far the work is, from 0 to 1.

    Raises:
        YamaroError: holds what is wrong with any of the meshes, or there is none.
    """
    robot = read_robot(root, notes=notes, recognizes=False)
    made_already = {
        (each.link, each.section, each.index + number)
        for each in robot.fits
        for number in range(each.count)
    }
    work: list[tuple[Link, str, int, Visual | Collision, Mesh]] = []
    for link in robot.links.values():
        if not wanted.has_link(link.name):
            continue
        sections: tuple[tuple[str, Sequence[Visual | Collision]], ...] = (
            ("collision", link.collisions),
            ("visual", link.visuals),
        )
        for section, shapes in sections:
            is_asked = wanted.collision if section == "collision" else wanted.triangles
            for index, shape in enumerate(shapes):
                is_new = (link.name, section, index) not in made_already
                if is_asked and is_new and isinstance(shape.shape, Mesh):
                    work.append((link, section, index, shape, shape.shape))
    if not work:
        raise _nothing(root, wanted, [*robot.links])
    replaced: dict[int, list[Element]] = {}
    counts: dict[tuple[str, str], dict[int, int]] = {}
    found: list[tuple[Link, str, int, RobotNote]] = []
    for number, (link, section, index, shape, mesh) in enumerate(work):
        if on_work is not None:
            on_work(number / len(work))
        began = monotonic()
        try:
            made, note = _refit(
                lowering, wanted, link, section, shape, mesh, materials=robot.materials
            )
        except YamaroError as error:
            lowering.absorb(error)
            continue
        replaced[id(shape.element)] = made
        counts.setdefault((link.name, section), {})[index] = len(made)
        note.attributes["seconds"] = str(round(monotonic() - began, 2))
        found.append((link, section, index, note))
    if on_work is not None:
        on_work(1.0)
    if lowering.errors:
        raise YamaroError(lowering.errors)
    children = [
        _with_sections(child, replaced)
        if isinstance(child, Element) and child.name == "link"
        else child
        for child in root.children
    ]
    kept = [each for note in notes for each in _moved(note, counts)]
    for link, section, index, note in found:
        before = counts[link.name, section]
        place = index + sum(count - 1 for other, count in before.items() if other < index)
        note.attributes = {
            "link": link.name, "section": section, "index": str(place), **note.attributes
        }  # fmt: skip
        kept.append(note)
    return root.with_children(children), kept


def _refit(
    lowering: Lowering,
    wanted: Refitting,
    link: Link,
    section: str,
    shape: Visual | Collision,
    mesh: Mesh,
    *,
    materials: Container[str],
) -> tuple[list[Element], RobotNote]:
    """Return the sections in place of one, and the note of what was worked out."""
    from ..fitting.fit import TRIANGLES, Wanted

    element, geometry = shape.element, mesh.element
    assert geometry is not None, "it was read"
    asked = Wanted(TRIANGLES, count=wanted.triangles)
    if section == "collision" and wanted.collision is not None:
        asked = wanted.collision
    span, trace = geometry.value_span("filename"), element.trace_within(link.trace)
    fit = worked_out(
        lowering, asked, word=mesh.filename, span=span, scale=mesh.scale, at=span,
        trace=trace,
    )  # fmt: skip
    rest = [
        child
        for child in element.children
        if not (isinstance(child, Element) and child.name in ("origin", "geometry"))
    ]
    name = format_value(element.attributes.get("name")).strip()
    sections = [] if fit.pieces else [element]
    lowering.link_name = link.name
    looks = looks_of(lowering, fit, geometry, rest, filename=mesh.filename, taken=materials)
    for number, piece in enumerate(pieces_to_write(lowering, fit)):
        look = looks[number] if looks else ()
        children = [*_placed(lowering, element, mesh, piece, shape.pose, asked), *rest, *look]
        made = element.with_children(children)
        if name and number:
            made.attributes = {**element.attributes, "name": f"{name}_{number + 1}"}
        sections.append(made)
    x, y, z = shape.pose.position
    note = note_of(
        asked, fit, span=element.span, place=span, trace=trace, count=len(sections),
        filename=mesh.filename, scale=Numbers.of(*mesh.scale),
        xyz=Numbers.of(x, y, z), rpy=Numbers.of(*rpy_from_rotation(shape.pose.rotation)),
    )  # fmt: skip
    return sections, note


def _placed(
    lowering: Lowering,
    element: Element,
    mesh: Mesh,
    piece: Placed | bytes,
    pose: ModelPose,
    asked: Wanted,
) -> list[Node]:
    """Return the `<origin>` and the `<geometry>` of a piece."""
    span, trace = element.span, element.trace
    if isinstance(piece, bytes):
        from .fits import filename_of

        filename = filename_of(lowering, asked, mesh.filename, piece)
        inner = Element("mesh", span, {"filename": filename}, [], trace)
        origins: list[Node] = [
            child
            for child in element.children
            if isinstance(child, Element) and child.name == "origin"
        ]
    else:
        pose = pose @ ModelPose(rotation_from_rpy(*piece.rpy), piece.xyz)
        sizes = piece.shape.size
        names = piece.shape.attributes
        rows = [Numbers.of(*sizes)] if len(names) == 1 else [Numbers.of(each) for each in sizes]
        attributes: dict[str, object] = dict(zip(names, rows, strict=True))
        inner = Element(piece.shape.kind, span, attributes, [], trace)
        place = {
            "xyz": _row(pose.position),
            "rpy": _row(rpy_from_rotation(pose.rotation)),
        }
        origins = [Element("origin", span, {**place}, [], trace)]
    return [*origins, Element("geometry", span, {}, [inner], trace)]


def _row(values: tuple[float, ...]) -> Numbers:
    return Numbers(tuple(map(format_component, values)), values)


def _with_sections(link: Element, replaced: dict[int, list[Element]]) -> Element:
    if not any(id(child) in replaced for child in link.children):
        return link
    children: list[Node] = []
    for child in link.children:
        children += replaced.get(id(child), [child])  # type: ignore[list-item]
    return link.with_children(children)


def _moved(note: Element, counts: dict[tuple[str, str], dict[int, int]]) -> list[Element]:
    """Return a note of a collision as notes of the sections that are in its place."""
    key = (format_value(note.attributes.get("link")), "collision")
    if note.name != "surface" or key not in counts:
        return [note]
    index = int(format_value(note.attributes.get("index")) or 0)
    own = counts[key]
    first = index + sum(count - 1 for other, count in own.items() if other < index)
    moved = []
    for number in range(own.get(index, 1)):
        attributes = {**note.attributes, "index": str(first + number)}
        moved.append(
            RobotNote("surface", note.span, attributes, note.children, note.trace, note.value_spans)
        )
    return [*moved]


def _nothing(root: Element, wanted: Refitting, links: Sequence[str]) -> YamaroError:
    if wanted.links:
        names = ", ".join(links[:8]) + (" …" if len(links) > 8 else "")
        message = f"no link of the names {', '.join(wanted.links)} collides with a mesh"
        hint = f"the links are {names}"
    else:
        message = "no link of this robot collides with a mesh"
        hint = (
            "there is nothing to fit; yamaro picture --show collision shows what it collides with"
        )
    return failure("nothing-to-fit", message, root.span, hint=hint)
