"""Shapes of UsdGeom, with colours, and with what they collide with."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from pxr import Gf, Sdf, Usd, UsdGeom, UsdPhysics, UsdShade, Vt

from ...diagnostics import failure
from ...meshes.formats import MeshFileError, MissingLibraryError
from ...model.link import Collision
from ...model.shapes import Box, Capsule, Cylinder, Sphere
from ..losses import Losses
from ..mesh_contents import MeshContents
from .prims import place, set_values

if TYPE_CHECKING:
    from ...meshes.surfaces import Surface
    from ...model.extras import Surface as Friction
    from ...model.link import Link, Material, Visual
    from ...model.pose import Pose, Vector
    from ...model.robot import Robot
    from ...model.shapes import Mesh, SimpleShape
    from ..output import Wanted
    from .prims import Names

    Color = tuple[float, ...]

CONTACTS = (
    ("NewtonMaterialAPI", "newton", "contact"),
    ("PhysxMaterialAPI", "physxMaterial", "compliantContact"),
)
"""Where the stiffness and the damping of contacts are: schemas, their namespaces, and words."""


class ShapeWriter:
    """Makes the shapes of one robot.

    Attributes:
        losses: what USD cannot hold of them.
    """

    def __init__(
        self, stage: Usd.Stage, robot: Robot, wanted: Wanted, names: Names, root: str
    ) -> None:
        """Start.

        Args:
            stage: takes the shapes.
            robot: the robot.
            wanted: finds meshes.
            names: names prims.
            root: the path of the robot.
        """
        self._stage = stage
        self._robot = robot
        self._wanted = wanted
        self._names = names
        self._folder = names.new(root, "materials")
        self._root = root
        self._mesh_folder = ""
        self._meshes: dict[tuple[str, Vector, int], str] = {}
        self._looks: dict[tuple[str, Color], UsdShade.Material] = {}
        self._frictions: dict[tuple[float | None, ...], UsdShade.Material] = {}
        self._contents = MeshContents(wanted.paths)
        self._surfaces = {(each.link, each.index): each for each in robot.surfaces}
        self.losses = Losses()

    def add(self, link: Link, path: str) -> None:
        """Write the shapes of a link under its prim."""
        for index, collision in enumerate(link.collisions):
            surface = self._surfaces.get((link.name, index))
            name = collision.name or f"{link.name}_collision"
            for prim, _ in self._made(link, path, collision, name):
                UsdGeom.Imageable(prim).CreatePurposeAttr(UsdGeom.Tokens.guide)
                UsdPhysics.CollisionAPI.Apply(prim)
                if prim.IsA(UsdGeom.Mesh):
                    mesh = UsdPhysics.MeshCollisionAPI.Apply(prim)
                    mesh.CreateApproximationAttr("convexHull")
                if surface is not None:
                    self._bind_friction(prim, surface)
        for visual in link.visuals:
            name = visual.name or f"{link.name}_visual"
            material = self._robot.material_of(visual)
            color = material.color if material is not None else None
            if material is not None and material.texture is not None:
                inner = material.inner("texture")
                span = inner.value_span("filename") if inner is not None else material.span
                label = f"'{material.texture}' of link '{link.name}'"
                self.losses.lose("textures", link, label=label, span=span)
            for prim, own in self._made(link, path, visual, name):
                if color is not None and material is not None:
                    self._bind_look(prim, color, link, material)
                elif own is not None:
                    self._bind_look(prim, own, link)

    def _made(
        self, link: Link, path: str, item: Collision | Visual, name: str
    ) -> list[tuple[Usd.Prim, Color | None]]:
        """Return the prims of a shape, each with the colour that its mesh gives it."""
        shape, pose = item.shape, item.pose
        if shape is None:
            return []
        if isinstance(shape, (Box, Sphere, Cylinder, Capsule)):
            if min(shape.size) <= 0:
                what = "shapes with a size that is not positive"
                label = f"{shape.kind} of link '{link.name}'"
                self.losses.lose(what, link, part=item, label=label)
                return []
            return [(self._simple(shape, self._path(link, path, item, name), pose), None)]
        if not self._wanted.has_meshes:
            return []
        surfaces = self._surfaces_of(link, shape, item)
        return [
            (self._mesh(at, shape, index, surface, pose), surface.color)
            for index, surface in enumerate(surfaces)
            for at in [self._path(link, path, item, name, is_first=not index)]
        ]

    def _path(
        self, link: Link, path: str, item: Collision | Visual, name: str, *, is_first: bool = True
    ) -> str:
        """Return the path of a new shape; the name that a file gives it is that of its first."""
        found = self._names.new(path, name)
        new = found.rpartition("/")[2]
        if is_first and item.name and new != name:
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

    # --- meshes ---

    def _mesh(self, path: str, shape: Mesh, index: int, surface: Surface, pose: Pose) -> Usd.Prim:
        """Return a mesh; its triangles are in a class, which all shapes of one file share."""
        key = (shape.filename, shape.scale, index)
        if key not in self._meshes:
            if not self._meshes:
                self._mesh_folder = self._names.new(self._root, "meshes")
                self._stage.DefinePrim(self._mesh_folder, "Scope")
            stem = os.path.splitext(shape.filename.replace("\\", "/").rpartition("/")[2])[0]
            at = self._meshes[key] = self._names.new(self._mesh_folder, stem)
            import numpy as np

            mesh = UsdGeom.Mesh(self._stage.DefinePrim(at, "Mesh"))
            mesh.GetPrim().SetSpecifier(Sdf.SpecifierClass)
            corners = (surface.points * shape.scale).astype("float32")
            # Triangles of STL have corners of their own; those at one place become one point.
            points, indices = np.unique(corners, axis=0, return_inverse=True)
            triangles = indices.reshape(-1)[surface.triangles]
            x, y, z = shape.scale
            if x * y * z < 0:  # mirrored
                triangles = triangles[:, ::-1]
            mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points))
            mesh.CreateFaceVertexIndicesAttr(
                Vt.IntArray.FromNumpy(triangles.astype("int32").ravel())
            )
            mesh.CreateFaceVertexCountsAttr([3] * len(triangles))
            mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
            low, high = points.min(axis=0).tolist(), points.max(axis=0).tolist()
            mesh.CreateExtentAttr([Gf.Vec3f(*low), Gf.Vec3f(*high)])
        mesh = UsdGeom.Mesh.Define(self._stage, path)
        mesh.GetPrim().GetReferences().AddInternalReference(self._meshes[key])
        place(mesh, pose)
        return mesh.GetPrim()

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
        if isinstance(item, Collision):
            what, how = "meshes of collisions", "their convex hulls"
            self.losses.approximate(what, link, part=item, how=how)
        elif any(each.texture is not None for each in surfaces):
            self.losses.lose("textures", link, label=label, span=span)
        return surfaces

    # --- materials ---

    def _bind_look(
        self, prim: Usd.Prim, color: Color, link: Link, written: Material | None = None
    ) -> None:
        """Show a shape in a colour: that of a material of the robot, or its own."""
        name = written.name if written is not None else ""
        material = self._looks.get((name, color))
        if material is None:
            path = self._material_path("color") if written is None or not name else ""
            if not path and written is not None:
                self._stage.DefinePrim(self._folder, "Scope")
                path = self._names.told(self._folder, "material", name, link, written)
            material = UsdShade.Material.Define(self._stage, path)
            shader = UsdShade.Shader.Define(self._stage, f"{path}/surface")
            shader.CreateIdAttr("UsdPreviewSurface")
            red, green, blue, alpha = color
            kinds = Sdf.ValueTypeNames
            shader.CreateInput("diffuseColor", kinds.Color3f).Set(Gf.Vec3f(red, green, blue))
            shader.CreateInput("opacity", kinds.Float).Set(alpha)
            shader.CreateInput("roughness", kinds.Float).Set(0.5)
            output = shader.CreateOutput("surface", kinds.Token)
            material.CreateSurfaceOutput().ConnectToSource(output)
            self._looks[name, color] = material
        UsdShade.MaterialBindingAPI.Apply(prim).Bind(material)

    def _bind_friction(self, prim: Usd.Prim, surface: Friction) -> None:
        key = (surface.friction, surface.restitution, surface.stiffness, surface.damping)
        if any(value is not None for value in key):
            material = self._frictions.get(key)
            if material is None:
                path = self._material_path("surface")
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
            binding = UsdShade.MaterialBindingAPI.Apply(prim)
            binding.Bind(material, UsdShade.Tokens.weakerThanDescendants, "physics")
        if surface.friction2 not in (None, surface.friction):
            self.losses.lose("second coefficients of friction", surface, field="friction2")

    def _material_path(self, name: str) -> str:
        self._stage.DefinePrim(self._folder, "Scope")
        return self._names.new(self._folder, name)
