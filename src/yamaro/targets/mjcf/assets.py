"""Materials, textures and meshes as assets of a model."""

from __future__ import annotations

import os
from functools import partial

from ...meshes.formats import NO_TRIANGLES, MeshFileError, MissingLibraryError
from ...model.convex import outer_points
from ..assets import FOLDER, named_by_content
from ..mesh_contents import MeshContents
from ..output import APPROXIMATED, LOST
from .meshes import FlatMeshError, collision_part, points_of, visual_parts
from .names import MATERIAL, MESH, TEXTURE
from .writing import Writing, made, row

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...diagnostics import Frame as Step
    from ...model.link import Collision, Color, Link, Material, Visual
    from ...model.pose import Vector
    from ...model.shapes import Mesh
    from ...model.values import Written
    from .meshes import Part

    Attributes = dict[str, str | None]

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
        self._parts: dict[tuple[str, bool], list[Part]] = {}
        self._corners: dict[str, list[Vector]] = {}
        self._useless: dict[tuple[str, bool], tuple[str, str]] = {}
        self._meshes: dict[tuple[str, Vector], str] = {}

    # --- materials ---

    def of_visual(self, link: Link, visual: Visual) -> Attributes:
        """Return the attribute of a geom that shows the material of a visual."""
        material = self._writing.robot.material_of(visual)
        if material is None or not material.is_defined:
            return {}
        if not material.name:
            if material.texture is None and material.color is not None:
                return {"rgba": row(_clipped(material.color))}
            return {"material": self._material(link, material, f"{link.name}_material")}
        if material.name not in self._materials:
            name = self._material(link, material, material.name)
            self._materials[material.name] = name
        return {"material": self._materials[material.name]}

    def _material(self, link: Link, material: Material, wanted: str) -> str:
        """Append a material of the robot, and return its name."""
        name = self._writing.names.fresh(MATERIAL, wanted)
        trace = material.trace_in(link)
        texture = None
        if material.texture is not None:
            texture = self._texture_of(link, material)
        rgba = row(_clipped(material.color)) if material.color is not None else None
        attributes = {"name": name, "texture": texture, "rgba": rgba}
        color = material.inner("color")
        places = {"rgba": color.value_span("rgba")} if color is not None else {}
        self._writing.add("asset", made("material", material, attributes, trace, places))
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
                return self._texture(data, _stem(path), material, material.trace_in(link))
        except (MeshFileError, MissingLibraryError):
            pass
        owner = f"'{material.texture}' of link '{link.name}'"
        what = "textures that are not found or cannot be read"
        self._writing.lose(LOST, what, owner, span, trace=material.trace_in(link))
        return None

    def _texture(self, data: bytes, stem: str, owner: Written, trace: Step | None) -> str:
        """Append a texture, and return its name."""
        file = self._file(stem, ".png", data)
        if file not in self._textures:
            name = self._textures[file] = self._writing.names.fresh(TEXTURE, stem)
            attributes = {"name": name, "type": "2d", "file": file}
            self._writing.add("asset", made("texture", owner, attributes, trace))
        return self._textures[file]

    def _own_look(self, part: Part, stem: str, owner: Written, trace: Step | None) -> Attributes:
        """Return the material that a mesh brings along; nothing if it has none."""
        if part.color is None and part.texture is None:
            return {}
        texture = None
        if part.texture is not None:
            texture = self._texture(part.texture, stem, owner, trace)
        key = (part.color, texture or "")
        if key not in self._colors:
            name = self._colors[key] = self._writing.names.fresh(MATERIAL, f"{stem}_material")
            rgba = row(_clipped(part.color)) if part.color is not None else None
            attributes = {"name": name, "texture": texture, "rgba": rgba}
            self._writing.add("asset", made("material", owner, attributes, trace))
        return {"material": self._colors[key]}

    # --- meshes ---

    def visual_mesh(
        self, link: Link, visual: Visual, mesh: Mesh, look: Attributes
    ) -> list[Attributes]:
        """Return the attributes of the geoms that show a mesh: one for each of its materials."""
        if not self._writing.wanted.has_meshes:
            return []
        trace = visual.trace_in(link)
        found = []
        has_own = False
        stem = _stem(mesh.filename)
        for part in self._read(link, visual, mesh, is_visual=True):
            name = self._mesh(part, stem, mesh, visual, trace)
            if part.is_mixed:
                owner, what = f"'{mesh.filename}' of link '{link.name}'", "colours of mesh corners"
                span, how = visual.span, "their mean"
                self._writing.lose(APPROXIMATED, what, owner, span, trace=trace, how=how)
            own = self._own_look(part, stem, visual, trace)
            has_own |= bool(own)
            found.append({"type": "mesh", "mesh": name, **(own or look)})
        if has_own and look and visual.material is not None:
            owner, span = f"'{mesh.filename}' of link '{link.name}'", visual.material.span
            what = "materials of meshes that bring their own"
            self._writing.lose(LOST, what, owner, span, trace=trace)
        return found

    def collision_mesh(self, link: Link, collision: Collision, mesh: Mesh) -> Attributes | None:
        """Return the attributes of the geom of a mesh that collides, or None for none."""
        if not self._writing.wanted.has_meshes:
            return None
        parts = self._read(link, collision, mesh, is_visual=False)
        if not parts:
            return None
        trace = collision.trace_in(link)
        name = self._mesh(parts[0], _stem(mesh.filename), mesh, collision, trace)
        return {"type": "mesh", "mesh": name}

    def corners_of(self, mesh: Mesh) -> list[Vector]:
        """Return the outer corners of a mesh that collides, at its size."""
        assert mesh.element is not None, "the robot was read from elements"
        path = self._contents.path_of(mesh.filename, mesh.element.value_span("filename"))
        assert path is not None, "it was read"
        if path not in self._corners:
            try:
                self._corners[path] = outer_points(points_of(self._parts[path, False][0]))
            except (ValueError, OverflowError):  # what is not a number is for MuJoCo to say
                self._corners[path] = []
        a, b, c = mesh.scale
        return [(x * a, y * b, z * c) for x, y, z in self._corners[path]]

    def _mesh(self, part: Part, stem: str, mesh: Mesh, owner: Written, trace: Step | None) -> str:
        """Append a mesh of a size, and return its name."""
        file = self._file(stem, part.ending, part.data)
        key = (file, mesh.scale)
        if key not in self._meshes:
            name = self._meshes[key] = self._writing.names.fresh(MESH, stem)
            scale = row(mesh.scale) if mesh.scale != (1.0, 1.0, 1.0) else None
            places = {}
            if mesh.element is not None:
                places = {each: mesh.element.value_span(each) for each in ("scale",)}
                places["file"] = mesh.element.value_span("filename")
            default = self._writing.classes.model
            attributes = {"name": name, "class": default, "file": file, "scale": scale}
            self._writing.add("asset", made("mesh", owner, attributes, trace, places))
        return self._meshes[key]

    def _read(
        self, link: Link, owner: Visual | Collision, mesh: Mesh, *, is_visual: bool
    ) -> list[Part]:
        """Return what a mesh is made of; report why there is nothing."""
        assert mesh.element is not None, "the robot was read from elements"
        span = mesh.element.value_span("filename")
        fail = partial(self._writing.fail, span=span, trace=owner.trace_in(link))
        path = self._contents.path_of(mesh.filename, span)
        label = f"the mesh '{mesh.filename}' of the link '{link.name}'"
        if path is None:
            fail("missing-mesh", f"{label} is not found", MESH_HINT)
            return []
        key = (path, is_visual)
        if key not in self._parts and key not in self._useless:
            try:
                read = visual_parts if is_visual else collision_part
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
            name = f"'{mesh.filename}' of link '{link.name}'"
            trace = owner.trace_in(link)
            self._writing.lose(LOST, what, name, owner.span, trace=trace, hint=hint)
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
