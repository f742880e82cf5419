"""Shapes of UsdGeom, with colours, and with what they collide with."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from pxr import Gf, Sdf, Usd, UsdGeom, UsdPhysics, UsdShade, Vt

from ...diagnostics import failure
from ...files.made import named_by_content
from ...meshes.formats import MeshFileError, MissingLibraryError
from ...model.link import Collision
from ...model.shapes import Box, Capsule, Cylinder, Sphere
from ..losses import Losses
from ..mesh_contents import MeshContents
from ..output import FOLDER
from .meshes import Prototypes
from .prims import place, set_values

if TYPE_CHECKING:
    from collections.abc import Callable

    from ...meshes.surfaces import Surface
    from ...model.extras import Surface as Friction
    from ...model.link import Link, Material, Visual
    from ...model.pose import Pose
    from ...model.shapes import Mesh, SimpleShape
    from .prims import Writing

    Color = tuple[float, ...]
    Image = str

CONTACTS = (
    ("NewtonMaterialAPI", "newton", "contact"),
    ("PhysxMaterialAPI", "physxMaterial", "compliantContact"),
)
"""Where the stiffness and the damping of contacts are: schemas, their namespaces, and words."""


SIMPLE = (Box, Sphere, Cylinder, Capsule)
WHITE = (1.0, 1.0, 1.0, 1.0)
PLAIN = (0.5, 0.5, 0.5, 1.0)
"""The colour of what has none, as in MuJoCo."""
CORNERS = "corners"
"""In place of an image: the colours of the corners of a mesh."""


class ShapeWriter:
    """Makes the shapes of one robot.

    Attributes:
        files: the textures that are beside the document, by their paths.
        losses: what USD cannot hold of them.
    """

    def __init__(self, writing: Writing) -> None:
        self._stage, self._robot = writing.stage, writing.robot
        self._names, self._has_meshes = writing.names, writing.wanted.has_meshes
        self._folder = writing.names.new(writing.root, "materials")
        self._prototypes = Prototypes(writing)
        self._looks: dict[tuple[str, Color, Image | None], UsdShade.Material] = {}
        self._frictions: dict[tuple[float | None, ...], UsdShade.Material] = {}
        self._contents = MeshContents(writing.wanted.paths)
        self._surfaces = {(each.link, each.index): each for each in writing.robot.surfaces}
        self._images: dict[Image, bytes] = {}
        self.files: dict[str, bytes] = {}
        self.losses = Losses()

    def add(self, link: Link, path: str) -> None:
        """Write the shapes of a link under its prim."""
        for index, collision in enumerate(link.collisions):
            surface = self._surfaces.get((link.name, index))
            prim = self._collision(link, path, collision, surface)
            if prim is not None:
                UsdGeom.Imageable(prim).CreatePurposeAttr(UsdGeom.Tokens.guide)
        for visual in link.visuals:
            self._visual(link, path, visual)

    def _collision(
        self, link: Link, path: str, collision: Collision, surface: Friction | None
    ) -> Usd.Prim | None:
        shape, name = collision.shape, collision.name or f"{link.name}_collision"
        if shape is None or not self._is_written(link, collision):
            return None
        friction = self._friction(surface) if surface is not None else None

        def collide(prim: Usd.Prim) -> None:
            """Bind where the shape is: from an instance, physics takes no material."""
            UsdPhysics.CollisionAPI.Apply(prim)
            if friction is not None:
                binding = UsdShade.MaterialBindingAPI.Apply(prim)
                binding.Bind(friction, UsdShade.Tokens.weakerThanDescendants, "physics")

        def collide_as_hull(prim: Usd.Prim, surface: Surface) -> None:
            collide(prim)
            UsdPhysics.MeshCollisionAPI.Apply(prim).CreateApproximationAttr("convexHull")

        if isinstance(shape, SIMPLE):
            prim = self._simple(shape, self._path(link, path, collision, name), collision.pose)
            collide(prim)
            return prim
        surfaces = self._surfaces_of(link, shape, collision)
        if not surfaces:
            return None
        key = ("collision", str(friction.GetPath()) if friction is not None else "")
        stem = f"{_stem(shape)}_collision"
        kind = self._prototypes.of_mesh(shape, stem, surfaces, key=key, finish=collide_as_hull)
        prim = self._instance(self._path(link, path, collision, name), kind, collision.pose)
        at = collision.pose
        if any(each.shape == shape and each.pose == at for each in link.visuals):
            UsdGeom.Imageable(prim).MakeInvisible()  # even where guides are shown
        return prim

    def _visual(self, link: Link, path: str, visual: Visual) -> None:
        shape, name = visual.shape, visual.name or f"{link.name}_visual"
        if shape is None or not self._is_written(link, visual):
            return
        material = self._robot.material_of(visual)
        image = self._image_of(link, material) if material is not None else None
        color = material.color if material is not None else None
        scale, has_look = None, False
        if isinstance(shape, SIMPLE):
            kind, scale = self._prototypes.of_simple(shape, has_texture=image is not None)
        else:
            surfaces = self._surfaces_of(link, shape, visual)
            if not surfaces:
                return
            if image is not None and any(each.texture_points is None for each in surfaces):
                self._lose_texture(
                    link, material, "textures of meshes without coordinates for them"
                )
                image = None
            is_own = color is None and image is None
            has_look = is_own and all(each.has_look for each in surfaces)
            look = self._own_look(link, _stem(shape)) if is_own else _nothing
            key = ("own look" if is_own else "",)
            kind = self._prototypes.of_mesh(shape, _stem(shape), surfaces, key=key, finish=look)
        prim = self._instance(self._path(link, path, visual, name), kind, visual.pose, scale)
        if color is not None or image is not None:
            bound = self._look(color or WHITE, image, link, material)
            _bind(prim, bound, color or WHITE)
        elif not has_look:
            _bind(prim, self._look(PLAIN, None, link), PLAIN)

    def _is_written(self, link: Link, item: Collision | Visual) -> bool:
        """Return whether a shape can be; note if it cannot."""
        shape = item.shape
        if isinstance(shape, SIMPLE) and min(shape.size) <= 0:
            what = "shapes with a size that is not positive"
            label = f"{shape.kind} of link '{link.name}'"
            self.losses.lose(what, link, part=item, label=label)
            return False
        return isinstance(shape, SIMPLE) or self._has_meshes

    def _instance(
        self, path: str, prototype: str, pose: Pose, scale: tuple[float, ...] | None = None
    ) -> Usd.Prim:
        """Return a new instance of a prototype, whose meshes no instance can change."""
        xform = UsdGeom.Xform.Define(self._stage, path)
        prim = xform.GetPrim()
        prim.GetReferences().AddInternalReference(prototype)
        prim.SetInstanceable(True)
        place(xform, pose, scale)
        return prim

    def _path(self, link: Link, path: str, item: Collision | Visual, name: str) -> str:
        """Return the path of a new shape."""
        found = self._names.new(path, name)
        new = found.rpartition("/")[2]
        if item.name and new != name:
            kind = "collisions" if isinstance(item, Collision) else "visuals"
            label = f"'{name}' of link '{link.name}'"
            self.losses.rename(kind, link, part=item, label=label, new=new)
        return found

    def _simple(self, shape: SimpleShape, path: str, pose: Pose) -> Usd.Prim:
        if isinstance(shape, Box):
            cube = UsdGeom.Cube.Define(self._stage, path)
            cube.CreateSizeAttr(1.0)
            cube.CreateExtentAttr([Gf.Vec3f(-0.5), Gf.Vec3f(0.5)])
            place(cube, pose, shape.size)
            return cube.GetPrim()
        if isinstance(shape, Sphere):
            sphere = UsdGeom.Sphere.Define(self._stage, path)
            sphere.CreateRadiusAttr(shape.radius)
            sphere.CreateExtentAttr([Gf.Vec3f(-shape.radius), Gf.Vec3f(shape.radius)])
            place(sphere, pose)
            return sphere.GetPrim()
        kind = UsdGeom.Cylinder if isinstance(shape, Cylinder) else UsdGeom.Capsule
        round_shape = kind.Define(self._stage, path)
        round_shape.CreateRadiusAttr(shape.radius)
        round_shape.CreateHeightAttr(shape.length)
        round_shape.CreateAxisAttr("Z")
        ends = shape.length / 2 + (shape.radius if isinstance(shape, Capsule) else 0.0)
        corner = Gf.Vec3f(shape.radius, shape.radius, ends)
        round_shape.CreateExtentAttr([-corner, corner])
        place(round_shape, pose)
        return round_shape.GetPrim()

    def _surfaces_of(self, link: Link, shape: Mesh, item: Collision | Visual) -> list[Surface]:
        """Return the surfaces of a mesh; note what USD does not take of it."""
        span = shape.span or link.span
        path = self._contents.path_of(shape.filename, span)
        label = f"'{shape.filename}' of link '{link.name}'"
        if path is None:
            self.losses.lose("meshes that are not found", link, label=label, span=span)
            return []
        try:
            surfaces = self._contents.surfaces_of(path, is_kept=True)
        except (MeshFileError, MissingLibraryError) as error:
            raise failure("bad-mesh", f"'{shape.filename}': {error}", span) from None
        if isinstance(item, Collision) and not self._robot.is_convex(link, item):
            what, how = "meshes of collisions", "their convex hulls"
            self.losses.approximate(what, link, part=item, how=how)
        return surfaces

    # --- looks ---

    def _image_of(self, link: Link, material: Material) -> Image | None:
        """Return the texture of a material of the robot; None without one, or if it is lost."""
        if material.texture is None:
            return None
        inner = material.inner("texture")
        span = inner.value_span("filename") if inner is not None else material.span
        path = self._contents.path_of(material.texture, span)
        try:
            if path is not None:
                return self._image(self._contents.texture_of(path), _stem_of(material.texture))
        except (MeshFileError, MissingLibraryError):
            pass
        self._lose_texture(link, material, "textures that are not found or cannot be read")
        return None

    def _lose_texture(self, link: Link, material: Material | None, what: str) -> None:
        assert material is not None
        inner = material.inner("texture")
        span = inner.value_span("filename") if inner is not None else material.span
        label = f"'{material.texture}' of link '{link.name}'"
        self.losses.lose(what, link, label=label, span=span)

    def _image(self, data: bytes, stem: str) -> Image:
        """Return the path of an image, which is a file beside the document if a material has it."""
        path = f"./{FOLDER}/{named_by_content(stem, '.png', [data])}"
        self._images[path] = data
        return path

    def _own_look(self, link: Link, stem: str) -> Callable[[Usd.Prim, Surface], None]:
        """Return what gives a mesh the look of a surface: a texture, colours, or a colour."""

        def look(prim: Usd.Prim, surface: Surface) -> None:
            color = surface.color or WHITE
            if surface.texture is not None and surface.texture_points is not None:
                image = self._image(encoded(surface.texture), stem)
                _bind(prim, self._look(WHITE, image, link), WHITE)
            elif surface.point_colors is not None:
                _bind(prim, self._look(WHITE, CORNERS, link), None)
            elif surface.color is not None:
                _bind(prim, self._look(color, None, link), color)

        from ...meshes.encoding import encoded

        return look

    def _look(
        self, color: Color, image: Image | None, link: Link, written: Material | None = None
    ) -> UsdShade.Material:
        """Return a material: one of the robot, or one for a colour, a texture or both."""
        name = written.name if written is not None else ""
        known = self._looks.get((name, color, image))
        if known is not None:
            return known
        self._stage.DefinePrim(self._folder, "Scope")
        if written is not None and name:
            path = self._names.told(self._folder, "material", name, link, written)
        else:
            plain = {None: "color", CORNERS: "colors"}.get(image, "texture")
            path = self._names.new(self._folder, plain)
        material = UsdShade.Material.Define(self._stage, path)
        kinds = Sdf.ValueTypeNames
        shader = UsdShade.Shader.Define(self._stage, f"{path}/surface")
        shader.CreateIdAttr("UsdPreviewSurface")
        red, green, blue, alpha = color
        diffuse = shader.CreateInput("diffuseColor", kinds.Color3f)
        if image is None:
            diffuse.Set(Gf.Vec3f(red, green, blue))
        else:
            reader = UsdShade.Shader.Define(self._stage, f"{path}/reader")
            of_corners = image == CORNERS
            reader.CreateIdAttr(f"UsdPrimvarReader_float{3 if of_corners else 2}")
            word = "displayColor" if of_corners else "st"
            reader.CreateInput("varname", kinds.String).Set(word)
            source = reader.CreateOutput("result", kinds.Float3 if of_corners else kinds.Float2)
            if not of_corners:
                self.files[image.removeprefix("./")] = self._images[image]
                texture = UsdShade.Shader.Define(self._stage, f"{path}/texture")
                texture.CreateIdAttr("UsdUVTexture")
                texture.CreateInput("file", kinds.Asset).Set(image)
                texture.CreateInput("sourceColorSpace", kinds.Token).Set("sRGB")
                texture.CreateInput("wrapS", kinds.Token).Set("repeat")
                texture.CreateInput("wrapT", kinds.Token).Set("repeat")
                texture.CreateInput("scale", kinds.Float4).Set(Gf.Vec4f(red, green, blue, 1.0))
                texture.CreateInput("st", kinds.Float2).ConnectToSource(source)
                source = texture.CreateOutput("rgb", kinds.Float3)
            diffuse.ConnectToSource(source)
        shader.CreateInput("opacity", kinds.Float).Set(alpha)
        shader.CreateInput("roughness", kinds.Float).Set(0.5)
        material.CreateSurfaceOutput().ConnectToSource(shader.CreateOutput("surface", kinds.Token))
        self._looks[name, color, image] = material
        return material

    def _friction(self, surface: Friction) -> UsdShade.Material | None:
        """Return the material of how a collision touches others; None if nothing is said of it."""
        material = None
        key = (surface.friction, surface.restitution, surface.stiffness, surface.damping)
        if any(value is not None for value in key):
            material = self._frictions.get(key)
            if material is None:
                self._stage.DefinePrim(self._folder, "Scope")
                path = self._names.new(self._folder, "surface")
                material = self._frictions[key] = UsdShade.Material.Define(self._stage, path)
                physics = UsdPhysics.MaterialAPI.Apply(material.GetPrim())
                if surface.friction is not None:
                    physics.CreateStaticFrictionAttr(surface.friction)
                    physics.CreateDynamicFrictionAttr(surface.friction)
                if surface.restitution is not None:
                    physics.CreateRestitutionAttr(surface.restitution)
                for schema, namespace, word in CONTACTS:
                    values = {
                        f"{word}Stiffness": surface.stiffness, f"{word}Damping": surface.damping
                    }  # fmt: skip
                    set_values(material.GetPrim(), schema, namespace, values, keeps_zeros=True)
        if surface.friction2 not in (None, surface.friction):
            self.losses.lose("second coefficients of friction", surface, field="friction2")
        return material


def _bind(prim: Usd.Prim, material: UsdShade.Material, color: Color | None) -> None:
    """Show a prim in a material, and in its colour where no materials are shown."""
    UsdShade.MaterialBindingAPI.Apply(prim).Bind(material)
    if color is not None:
        kind = Sdf.ValueTypeNames.Color3fArray
        shown = UsdGeom.PrimvarsAPI(prim).CreatePrimvar("displayColor", kind)
        shown.Set(Vt.Vec3fArray([Gf.Vec3f(*(min(max(each, 0.0), 1.0) for each in color[:3]))]))


def _nothing(prim: Usd.Prim, surface: Surface) -> None:
    """Leave a mesh as it is."""


def _stem(shape: Mesh) -> str:
    return _stem_of(shape.filename)


def _stem_of(filename: str) -> str:
    """Return the name of a file without its folder and ending."""
    return os.path.splitext(filename.replace("\\", "/").rpartition("/")[2])[0]
