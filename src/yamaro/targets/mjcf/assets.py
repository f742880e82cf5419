"""Assets: materials, textures, and meshes in the two formats that MuJoCo reads.

These are binary STL, and OBJ of one material.
"""

from __future__ import annotations

import os
from functools import partial
from math import hypot
from struct import Struct, iter_unpack

from ...diagnostics import YamaroError
from ...files.made import named_by_content
from ...meshes.encoding import obj_of, obj_of_triangles, stl_of
from ...meshes.formats import (
    NO_TRIANGLES,
    OBJ,
    STL,
    STL_HEADER_BYTES,
    MeshFileError,
    MissingLibraryError,
    is_binary_stl,
)
from ...model.convex import cross, dot, minus, outer_points
from ...sandbox.jail.protocol import pack, unpack
from ...xml.tree import Element
from ...xml.values import format_value
from ..elements import element
from ..mesh_contents import MeshContents
from ..output import FOLDER
from .blocks import changed
from .model import MATERIAL, MESH, TEXTURE, Writing

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from ...meshes.surfaces import Surface
    from ...model.link import Collision, Color, Link, Material, Visual
    from ...model.pose import Vector
    from ...model.shapes import Mesh
    from ...model.values import Written
    from ..elements import Attributes

    Read = Callable[[MeshContents, str], list["Part"]]


MOST_FACETS = 200_000
"""Triangles of an STL that MuJoCo reads."""
FLAT = 1e-6
"""What is nearer to a plane than this part of its size is in it."""
_MATERIAL_WORDS = (b"mtllib", b"usemtl")


class FlatMeshError(MeshFileError):
    """A mesh has no convex hull."""


class Part:
    """A file of a mesh, and how what is in it looks.

    Attributes:
        data: the file.
        ending: of its name.
        color: its colour, or None if the mesh says nothing of it.
        texture: a PNG, or None.
        is_mixed: whether the colour is the mean of those of its corners.
    """

    __slots__ = ("color", "data", "ending", "is_mixed", "texture")

    def __init__(self, data: bytes, ending: str) -> None:
        self.data = data
        self.ending = ending
        self.color: Color | None = None
        self.texture: bytes | None = None
        self.is_mixed = False


def visual_parts(contents: MeshContents, path: str) -> list[Part]:
    """Return a mesh to be seen, in a part for each colour and texture.

    Raises:
        MeshFileError, MissingLibraryError: see `MeshContents.surfaces_of`.
    """
    kept = _kept(contents, path)
    if kept is not None and not (
        kept.ending == ".obj" and any(word in kept.data for word in _MATERIAL_WORDS)
    ):
        return [kept]
    converted = contents.kept(path, "mjcf visual", lambda: _packed(_visual_parts(contents, path)))
    return _unpacked(converted)


def _visual_parts(contents: MeshContents, path: str) -> list[Part]:
    groups: dict[object, list[Surface]] = {}
    for surface in contents.surfaces_of(path):
        mixed = None if surface.point_colors is None else id(surface)
        key = (surface.color, None if surface.texture is None else id(surface.texture), mixed)
        groups.setdefault(key, []).append(surface)
    return [_part(surfaces) for surfaces in groups.values()]


def collision_part(contents: MeshContents, path: str) -> list[Part]:
    """Return a mesh to collide with, in one part.

    Raises:
        FlatMeshError: all its corners are in a plane, so that it has no convex hull.
        MeshFileError, MissingLibraryError: see `MeshContents.surfaces_of`.
    """
    (part,) = whole_part(contents, path)
    if is_flat(points_of(part)):
        raise FlatMeshError("all its corners are in a plane")
    return [part]


def _kept(contents: MeshContents, path: str) -> Part | None:
    """Return an STL or OBJ as it is, a text STL as binary one; None for other formats.

    MuJoCo takes no STL of more than `MOST_FACETS`, so that such a one becomes an OBJ.
    """
    kind = contents.format_of(path)
    data = contents.bytes_of(path)
    if kind == OBJ:
        return Part(data, ".obj")
    if kind != STL:
        return None
    count = int.from_bytes(data[80:84], "little") if is_binary_stl(data) else None
    if count is not None and 0 < count <= MOST_FACETS:
        return Part(data, ".stl")
    (part,) = _unpacked(contents.kept(path, "mjcf stl", lambda: _packed([_rewritten(data)])))
    return part


def _rewritten(data: bytes) -> Part:
    """Return an STL as binary one, or as OBJ if it has too many triangles."""
    from ...meshes.triangles import read_stl

    mesh = read_stl(data)
    if not mesh.triangles:
        raise MeshFileError(NO_TRIANGLES)
    if len(mesh.triangles) > MOST_FACETS:
        return Part(obj_of_triangles(mesh), ".obj")
    return Part(stl_of(mesh), ".stl")


def points_of(part: Part) -> Iterator[Vector]:
    """Yield the corners of a part, one after the other."""
    if part.ending == ".stl":
        for corners in iter_unpack("<12x9f2x", memoryview(part.data)[STL_HEADER_BYTES:]):
            x, y, z, *others = corners
            yield (x, y, z)
            yield (others[0], others[1], others[2])
            yield (others[3], others[4], others[5])
        return
    for line in part.data.splitlines():
        words = line.split()
        if len(words) >= 4 and words[0] == b"v":
            yield (float(words[1]), float(words[2]), float(words[3]))


def is_flat(points: Iterator[Vector]) -> bool:
    """Return whether all points are in one plane; of most meshes it looks at a few."""
    try:
        origin = next(points, None)
        if origin is None:
            return True
        first: Vector | None = None
        normal: Vector | None = None
        for point in points:
            way = minus(point, origin)
            size = hypot(*way)
            if first is None:
                first = way if size else None
            elif normal is None:
                across = cross(first, way)
                normal = across if hypot(*across) > FLAT * hypot(*first) * size else None
            elif abs(dot(normal, way)) > FLAT * hypot(*normal) * max(size, hypot(*first)):
                return False
    except ValueError:  # what is not a number is for MuJoCo to say
        return False
    return True


def whole_part(contents: MeshContents, path: str) -> list[Part]:
    """Return a mesh in one part, as it is to collide and to be seen.

    Raises:
        MeshFileError, MissingLibraryError: see `MeshContents.surfaces_of`.
    """
    part = _kept(contents, path)
    if part is None:
        part = Part(
            contents.kept(path, "mjcf collision", lambda: obj_of(contents.surfaces_of(path))),
            ".obj",
        )
    return [part]


def _part(surfaces: list[Surface]) -> Part:
    """Return surfaces that look the same."""
    first = surfaces[0]
    has_texture = first.texture is not None and first.texture_points is not None
    part = Part(obj_of(surfaces, has_texture=has_texture), ".obj")
    if has_texture:
        from ...meshes.encoding import encoded

        assert first.texture is not None
        part.texture = encoded(first.texture)
    elif first.point_colors is not None:
        mean = (first.point_colors.mean(axis=0) / 255).round(6).tolist()
        part.color = (mean[0], mean[1], mean[2], mean[3])
        part.is_mixed = bool((first.point_colors != first.point_colors[0]).any())
    elif first.color is not None:
        red, green, blue, alpha = first.color
        part.color = (round(red, 6), round(green, 6), round(blue, 6), round(alpha, 6))
    return part


# --- in the cache -------------------------------------------------------------------------------

_COLOR = Struct("<4d")


def _packed(parts: list[Part]) -> bytes:
    """Return parts as bytes."""
    return pack(
        [
            pack(
                [
                    part.data,
                    part.ending.encode(),
                    b"" if part.color is None else _COLOR.pack(*part.color),
                    part.texture or b"",
                    b"mixed" if part.is_mixed else b"",
                ]
            )
            for part in parts
        ]
    )


def _unpacked(data: bytes) -> list[Part]:
    """Return the parts that `_packed` made bytes of."""
    parts = []
    for each in unpack(data):
        content, ending, color, texture, mixed = unpack(each)
        part = Part(content, ending.decode())
        if color:
            red, green, blue, alpha = _COLOR.unpack(color)
            part.color = (red, green, blue, alpha)
        part.texture = texture or None
        part.is_mixed = bool(mixed)
        parts.append(part)
    return parts


# --- files of blocks ----------------------------------------------------------------------------

WITH_FILES = frozenset(("mesh", "texture", "hfield", "skin", "flexcomp"))
"""Elements of MJCF whose attributes `file`, `fileup` … name files."""


def with_files(writing: Writing, element: Element) -> Element:
    """Return an element of a block with the files that it names in the folder of assets.

    A relative path that leads nowhere stays: the file may be where the document will be.
    """
    children = [
        with_files(writing, each) if isinstance(each, Element) else each
        for each in element.children
    ]
    files: dict[str, object] = {}
    for name, value in element.attributes.items() if element.name in WITH_FILES else ():
        if name.startswith("file") and name != "filename":
            text = format_value(value).strip()
            contents = MeshContents(writing.wanted.paths)
            span = element.value_span(name)
            trace = element.trace_within(None)
            try:
                path = writing.wanted.paths.finder.resolve(text, span)
            except YamaroError as error:
                first = error.diagnostics[0]
                writing.fail(first.code, first.message, first.hint or "", span=span, trace=trace)
                continue
            if path is None and os.path.isabs(text):
                label = f"the file '{text}' of a <{element.name}>"
                writing.fail("missing-mesh", f"{label} is not found", "", span=span, trace=trace)
            elif path is not None:
                try:
                    files[name] = asset_file(writing, path, contents.bytes_of(path))
                except MeshFileError as error:
                    message = f"the file '{text}' of a <{element.name}> cannot be read: {error}"
                    writing.fail("bad-mesh", message, "", span=span, trace=trace)
    unchanged = all(one is other for one, other in zip(children, element.children, strict=True))
    if unchanged and not files:
        return element
    made = changed(element, {**element.attributes, **files})
    made.children = children
    return made


def asset_file(writing: Writing, path: str, data: bytes) -> str:
    """Put a file into the folder of assets, and return its name there."""
    stem, ending = os.path.splitext(os.path.basename(path))
    name = named_by_content(stem, ending, [data])
    writing.files.setdefault(f"{FOLDER}/{name}", data)
    return name


# --- assets -----------------------------------------------------------------------------------


MESH_HINT = "--meshes none leaves meshes out"


class Looks:
    """Gives the materials and meshes of shapes, each of which becomes an asset once."""

    __slots__ = (
        "_colors", "_contents", "_corners", "_materials", "_meshes", "_parts", "_textures",
        "_useless", "_writing",
    )  # fmt: skip

    def __init__(self, writing: Writing) -> None:
        self._writing = writing
        self._contents = MeshContents(writing.wanted.paths)
        self._materials: dict[str, str] = {}
        self._colors: dict[tuple[Color | None, str], str] = {}
        self._textures: dict[str, str] = {}
        self._parts: dict[tuple[str, Read], list[Part]] = {}
        self._corners: dict[str, list[Vector]] = {}
        self._useless: dict[tuple[str, Read], tuple[str, str]] = {}
        self._meshes: dict[tuple[str, Vector], str] = {}

    # --- materials ---

    def of_visual(self, link: Link, visual: Visual) -> Attributes:
        """Return the attribute of a geom that shows the material of a visual."""
        material = self._writing.robot.material_of(visual)
        if material is None or not material.is_defined:
            return {}
        if not material.name:
            if material.texture is None and material.color is not None:
                return {"rgba": _clipped(material.color)}
            return {"material": self._material(link, material, f"{link.name}_material")}
        if material.name not in self._materials:
            name = self._material(link, material, material.name)
            self._materials[material.name] = name
        return {"material": self._materials[material.name]}

    def _material(self, link: Link, material: Material, wanted: str) -> str:
        """Append a material of the robot, and return its name."""
        name = self._writing.names.fresh(MATERIAL, wanted)
        texture = None
        if material.texture is not None:
            texture = self._texture_of(link, material)
        rgba = _clipped(material.color) if material.color is not None else None
        attributes: Attributes = {"name": name, "texture": texture, "rgba": rgba}
        color = material.inner("color")
        places = {"rgba": color.value_span("rgba")} if color is not None else {}
        made = element("material", attributes, owner=link, part=material, places=places)
        self._writing.add("asset", made)
        return name

    def _texture_of(self, link: Link, material: Material) -> str | None:
        """Return the name of a material's texture, or None if there is no image."""
        element = material.inner("texture")
        assert element is not None
        assert material.texture is not None
        span = element.value_span("filename")
        path = self._contents.path_of(material.texture, span)
        try:
            if path is not None:
                data = self._contents.texture_of(path)
                return self._texture(data, _stem(path), link, material)
        except (MeshFileError, MissingLibraryError):
            pass
        what = "textures that are not found or cannot be read"
        label = f"'{material.texture}' of link '{link.name}'"
        self._writing.losses.lose(what, link, part=material, label=label, span=span)
        return None

    def _texture(self, data: bytes, stem: str, link: Link, part: Written) -> str:
        """Append a texture, and return its name."""
        file = self._file(stem, ".png", data)
        if file not in self._textures:
            name = self._textures[file] = self._writing.names.fresh(TEXTURE, stem)
            attributes: Attributes = {"name": name, "type": "2d", "file": file}
            self._writing.add("asset", element("texture", attributes, owner=link, part=part))
        return self._textures[file]

    def _own_look(self, part: Part, stem: str, link: Link, visual: Visual) -> Attributes:
        """Return the material that a mesh brings along; nothing if it has none."""
        if part.color is None and part.texture is None:
            return {}
        texture = None
        if part.texture is not None:
            texture = self._texture(part.texture, stem, link, visual)
        key = (part.color, texture or "")
        if key not in self._colors:
            name = self._colors[key] = self._writing.names.fresh(MATERIAL, f"{stem}_material")
            rgba = _clipped(part.color) if part.color is not None else None
            attributes: Attributes = {"name": name, "texture": texture, "rgba": rgba}
            self._writing.add("asset", element("material", attributes, owner=link, part=visual))
        return {"material": self._colors[key]}

    # --- meshes ---

    def visual_mesh(
        self, link: Link, visual: Visual, mesh: Mesh, look: Attributes
    ) -> list[Attributes]:
        """Return the attributes of the geoms that show a mesh: one for each of its materials."""
        if not self._writing.wanted.has_meshes:
            return []
        found: list[Attributes] = []
        has_own = False
        stem, label = _stem(mesh.filename), f"'{mesh.filename}' of link '{link.name}'"
        losses = self._writing.losses
        for part in self._read(link, visual, mesh, visual_parts):
            name = self._mesh(part, stem, mesh, link, visual)
            if part.is_mixed:
                what, how = "colours of mesh corners", "their mean"
                losses.approximate(what, link, part=visual, label=label, how=how)
            own = self._own_look(part, stem, link, visual)
            has_own |= bool(own)
            found.append({"type": "mesh", "mesh": name, **(own or look)})
        if has_own and look and visual.material is not None:
            what, span = "materials of meshes that bring their own", visual.material.span
            losses.lose(what, link, part=visual, label=label, span=span)
        return found

    def collision_mesh(self, link: Link, collision: Collision, mesh: Mesh) -> Attributes | None:
        """Return the attributes of the geom of a mesh that collides, or None for none."""
        if not self._writing.wanted.has_meshes:
            return None
        return self._one(link, collision, mesh, self._read(link, collision, mesh, collision_part))

    def whole_mesh(self, link: Link, visual: Visual, mesh: Mesh) -> Attributes | None:
        """Return the attributes of the one geom that shows a mesh, or None for none."""
        if not self._writing.wanted.has_meshes:
            return None
        return self._one(link, visual, mesh, self._read(link, visual, mesh, whole_part))

    def _one(
        self, link: Link, shape: Visual | Collision, mesh: Mesh, parts: list[Part]
    ) -> Attributes | None:
        if not parts:
            return None
        name = self._mesh(parts[0], _stem(mesh.filename), mesh, link, shape)
        return {"type": "mesh", "mesh": name}

    def corners_of(self, mesh: Mesh) -> list[Vector]:
        """Return the outer corners of a mesh that collides, at its size."""
        assert mesh.element is not None, "the robot was read from elements"
        path = self._contents.path_of(mesh.filename, mesh.element.value_span("filename"))
        assert path is not None, "it was read"
        if path not in self._corners:
            try:
                self._corners[path] = outer_points(points_of(self._parts[path, collision_part][0]))
            except (ValueError, OverflowError):  # what is not a number is for MuJoCo to say
                self._corners[path] = []
        a, b, c = mesh.scale
        return [(x * a, y * b, z * c) for x, y, z in self._corners[path]]

    def _mesh(
        self, part: Part, stem: str, mesh: Mesh, link: Link, shape: Visual | Collision
    ) -> str:
        """Append a mesh of a size, and return its name."""
        file = self._file(stem, part.ending, part.data)
        key = (file, mesh.scale)
        if key not in self._meshes:
            name = self._meshes[key] = self._writing.names.fresh(MESH, stem)
            places = {}
            if mesh.element is not None:
                places["scale"] = mesh.element.value_span("scale")
                places["file"] = mesh.element.value_span("filename")
            attributes: Attributes = {
                "name": name,
                "class": self._writing.classes.model,
                "file": file,
                "scale": mesh.scale if mesh.scale != (1.0, 1.0, 1.0) else None,
            }
            if self._writing.blocks.is_whole and is_flat(points_of(part)):
                attributes["inertia"] = "shell"
            made = element("mesh", attributes, owner=link, part=shape, places=places)
            self._writing.add("asset", made)
        return self._meshes[key]

    def _read(self, link: Link, owner: Visual | Collision, mesh: Mesh, read: Read) -> list[Part]:
        """Return what a mesh is made of, as a function above gives it; report why it is nothing."""
        assert mesh.element is not None, "the robot was read from elements"
        span = mesh.element.value_span("filename")
        fail = partial(self._writing.fail, span=span, trace=owner.trace_in(link))
        path = self._contents.path_of(mesh.filename, span)
        label = f"the mesh '{mesh.filename}' of the link '{link.name}'"
        if path is None:
            fail("missing-mesh", f"{label} is not found", MESH_HINT)
            return []
        key = (path, read)
        if key not in self._parts and key not in self._useless:
            try:
                self._parts[key] = read(self._contents, path)
            except MissingLibraryError as error:
                hint = f'run pip install "yamaro[mesh]"; {MESH_HINT}'
                fail("missing-extra", f"{label} needs the Python package '{error}'", hint)
            except FlatMeshError:
                self._useless[key] = ("flat meshes of collisions", "write a thin box")
            except MeshFileError as error:
                if str(error) == NO_TRIANGLES:
                    self._useless[key] = ("meshes without triangles", "")
                else:
                    fail("bad-mesh", f"{label} cannot be read: {error}", MESH_HINT)
        if key in self._useless:
            what, hint = self._useless[key]
            label = f"'{mesh.filename}' of link '{link.name}'"
            self._writing.losses.lose(what, link, part=owner, label=label, hint=hint)
        return self._parts.get(key, [])

    def _file(self, stem: str, ending: str, data: bytes) -> str:
        """Put a file beside the document, and return its name in the folder of assets."""
        name = named_by_content(stem, ending, [data])
        self._writing.files.setdefault(f"{FOLDER}/{name}", data)
        return name


def _stem(filename: str) -> str:
    return os.path.splitext(os.path.basename(filename.replace("\\", "/")))[0] or "mesh"


def _clipped(color: Color) -> Color:
    red, green, blue, alpha = (min(max(part, 0.0), 1.0) for part in color)
    return (red, green, blue, alpha)
