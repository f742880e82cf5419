"""A robot as prims of USD: bodies, frames and joints."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pxr import Gf, Sdf, Usd, UsdGeom, UsdPhysics, Vt

from ...diagnostics import YamaroError
from ...model.kinematics import link_poses
from ...model.pose import Pose
from ..contacts import filtered_pairs
from ..elements import element
from ..foreign_xml import foreign_losses
from ..holding import lost_sections
from ..inertia import Inertias, between_joints
from ..losses import RENAMED, Loss, Losses
from ..output import Output
from .control import ACTUATORS, VARIANTS
from .joints import JointWriter
from .prims import NEWTON_SCHEMAS, Names, Writing, element_of, place, place_by_name, quaternion_of
from .sensors import SensorWriter
from .shapes import ShapeWriter

if TYPE_CHECKING:
    from ...model.link import Inertial, Link
    from ...model.robot import Robot
    from ...xml.tree import Element
    from ..output import Wanted

POINT_RADIUS = 1e-6
"""The radius, in metres, of the ball whose inertia a point mass gets."""
SMALLEST = 1e-9
"""The least moment of inertia, as part of the greatest: USD takes none of 0."""
PLACEHOLDER = 1e-3
"""The mass, in kg, of a body without any, since USD takes 0 for a mass that is not given."""
SITE_RADIUS = 0.005
"""The radius, in metres, of the ball that shows a frame, which Newton's schema marks as a site."""

NAMED_POSES = "Named_Poses"
"""The scope that Isaac Sim has named poses in."""
ROBOT = {"asset_type": "robot", "category": "robot", "qcode": "Q11012"}
"""What each robot is: the code is that of robots in Wikidata."""


def write(robot: Robot, wanted: Wanted) -> Output:
    """Return a robot in USD, as text.

    Raises:
        YamaroError: a mesh cannot be read.
    """
    model = _Model(robot, wanted)
    model.fill()
    text = model.stage.GetRootLayer().ExportToString()
    name = model.root.rpartition("/")[2]
    root = element("usd", {"name": name}, children=model.elements, owner=robot.element)
    return Output(root, model.losses, model.files, text=text, names=model.names.names)


class _Model:
    """Makes the stage of one robot.

    Attributes:
        stage: the stage.
        root: the path of the robot's prim.
        elements: for each prim, an element at the place of what it is made of.
        files: the textures beside the document.
        losses: what USD cannot hold.
        names: names prims.
    """

    def __init__(self, robot: Robot, wanted: Wanted) -> None:
        self._robot = robot
        self._wanted = wanted
        self._poses = link_poses(robot)
        self._inertias = Inertias(
            robot,
            is_fixed=wanted.is_fixed,
            repairs=wanted.repairs_inertia,
            passed=between_joints(robot),
        )
        self.losses = Losses(self._inertias.losses)
        self.files: dict[str, bytes] = {}
        self.elements: list[Element] = []
        self.names = Names(self.losses)
        self.stage = Usd.Stage.CreateInMemory(".usda")
        UsdGeom.SetStageUpAxis(self.stage, UsdGeom.Tokens.z)
        UsdGeom.SetStageMetersPerUnit(self.stage, 1.0)
        UsdPhysics.SetStageKilogramsPerUnit(self.stage, 1.0)
        layer = self.stage.GetRootLayer()
        layer.documentation = ""
        layer.customLayerData = {"newton-usd-schemas": NEWTON_SCHEMAS}
        name = robot.name or wanted.name
        self.root = self.names.new("", name)
        self.names.new(self.root, NAMED_POSES)  # which no link can be called then
        new = self.root[1:]
        if new != name:
            span, label = robot.span_of("name"), f"robot '{name}'"
            self.losses.append(Loss(RENAMED, "robots", label, span, how=new))
        prim = UsdGeom.Xform.Define(self.stage, self.root).GetPrim()
        self.stage.SetDefaultPrim(prim)
        UsdPhysics.ArticulationRootAPI.Apply(prim)
        prim.AddAppliedSchema("NewtonArticulationRootAPI")
        collides = prim.CreateAttribute(
            "newton:selfCollisionEnabled", Sdf.ValueTypeNames.Bool, custom=False
        )
        collides.Set(True)
        self._writing = Writing(self.stage, robot, wanted, self.names, self.root)
        self._bodies, self._paths = self._writing.bodies, self._writing.paths
        self._shapes = ShapeWriter(self._writing)

    def fill(self) -> None:
        """Write everything; raise YamaroError if no body can have an inertia."""
        if self._inertias.errors:
            raise YamaroError(self._inertias.errors)
        robot, bodies = self._robot, self._bodies
        for link in bodies.order:
            if bodies.is_body(link.name):
                path = self.names.told(self.root, "link", link.name, link)
                self._paths[link.name] = path
                xform = UsdGeom.Xform.Define(self.stage, path)
                place(xform, self._poses[link.name])
                prim = xform.GetPrim()
                UsdPhysics.RigidBodyAPI.Apply(prim)
                self._set_mass(UsdPhysics.MassAPI.Apply(prim), link)
                self.elements.append(element_of(prim, link))
                self._shapes.add(link, path)
        for link in bodies.order:
            carrier = bodies.carriers[link.name]
            if carrier is not None and carrier != link.name:
                path = self.names.told(self._paths[carrier], "frame", link.name, link)
                self._paths[link.name] = path
                xform = UsdGeom.Xform.Define(self.stage, path)
                place(xform, self._bodies.poses[link.name])
                self.elements.append(element_of(xform.GetPrim(), link))
                site = UsdGeom.Sphere.Define(self.stage, self.names.new(path, "site"))
                site.CreateRadiusAttr(SITE_RADIUS)
                site.CreateExtentAttr([Gf.Vec3f(-SITE_RADIUS), Gf.Vec3f(SITE_RADIUS)])
                site.CreatePurposeAttr(UsdGeom.Tokens.guide)
                site.GetPrim().AddAppliedSchema("NewtonSiteAPI")
                self._shapes.add(link, path)
        joints = JointWriter(self._writing)
        joints.write()
        self.elements += joints.elements
        sensors = SensorWriter(self._writing)
        sensors.write()
        self.losses += sensors.losses
        for one, other, _ in filtered_pairs(robot, bodies, self._wanted, self.losses):
            prim = self.stage.GetPrimAtPath(self._paths[one])
            pairs = UsdPhysics.FilteredPairsAPI.Apply(prim).CreateFilteredPairsRel()
            pairs.AddTarget(self._paths[other])
        self.files = self._shapes.files
        self.losses += self._shapes.losses
        self.losses += joints.losses
        self._name_poses(joints)
        self.losses += lost_sections(robot, controls=True)
        self.losses += foreign_losses(robot)
        self._describe(joints)

    # --- what the robot is ---

    def _name_poses(self, joints: JointWriter) -> None:
        """Write the states of the robot as named poses of Isaac Sim's robot schema."""
        robot, kinds = self._robot, Sdf.ValueTypeNames
        folder = f"{self.root}/{NAMED_POSES}"
        written = []
        for state in robot.states.values():
            values = {
                name: joints.native(name, position)
                for name, position in state.positions.items()
                if joints.path_of(name)
            }
            if not values:
                self.losses.lose("states of joints that are not written", state)
                continue
            self.stage.DefinePrim(folder, "Scope")
            path = self.names.told(folder, "state", state.name, state)
            prim = self.stage.DefinePrim(path, "IsaacNamedPose")
            last = robot.joints[list(values)[-1]]
            end = self._bodies.carriers[last.child] or last.child
            start = next(link for link in self._bodies.order if self._bodies.is_body(link.name))
            ends = {"startLink": [self._paths[start.name]], "endLink": [self._paths[end]]}
            ends["joints"] = [joints.path_of(name) for name in values]
            for word, paths in ends.items():
                relation = prim.CreateRelationship(f"isaac:robot:pose:{word}", custom=False)
                relation.SetTargets(list(map(Sdf.Path, paths)))
            pose = link_poses(robot, state.positions)[end]
            place_by_name(prim, pose)
            for word, kind, value in (
                ("valid", kinds.Bool, True),
                ("jointValues", kinds.FloatArray, Vt.FloatArray(list(values.values()))),
                ("jointFixed", kinds.BoolArray, Vt.BoolArray([False] * len(values))),
            ):
                prim.CreateAttribute(f"isaac:robot:pose:{word}", kind, custom=False).Set(value)
            written.append(Sdf.Path(path))
            self.elements.append(element_of(prim, state))
        if written:
            root = self.stage.GetDefaultPrim()
            relation = root.CreateRelationship("isaac:robot:namedPoses", custom=False)
            relation.SetTargets(written)

    def _describe(self, joints: JointWriter) -> None:
        """Say what the robot consists of, for Isaac Sim, and what an asset says, for SimReady.

        Sources: the robot schema of Isaac Sim, https://docs.isaacsim.omniverse.nvidia.com, and
        SR.004 of https://nvidia.github.io/simready-foundation/.
        """
        links = [
            self.stage.GetPrimAtPath(self._paths[link.name])
            for link in self._bodies.order
            if self._bodies.is_body(link.name)
        ]
        root = self.stage.GetDefaultPrim()
        root.AddAppliedSchema("IsaacRobotAPI")
        for word, prims in (("Link", links), ("Joint", joints.prims)):
            for prim in prims:
                prim.AddAppliedSchema(f"Isaac{word}API")
            relation = root.CreateRelationship(f"isaac:physics:robot{word}s", custom=False)
            relation.SetTargets([prim.GetPath() for prim in prims])
        for kind, names in self.names.names.items():
            for path, name in names.items():
                prim = self.stage.GetPrimAtPath(path)
                if prim.GetName() != name:
                    prim.SetDisplayName(name)
                    if kind in ("link", "frame", "joint"):
                        text = Sdf.ValueTypeNames.String
                        prim.CreateAttribute("isaac:nameOverride", text, custom=False).Set(name)
        Usd.ModelAPI(root).SetKind("component")
        name = self._robot.name or self._wanted.name
        if root.GetName() != name:
            root.SetDisplayName(name)
        data: dict[str, object] = {"asset_name": name, **ROBOT}
        data["rigid_body_count"] = len(links)
        masses = [UsdPhysics.MassAPI(prim).GetMassAttr().Get() for prim in links]
        data["mass"] = sum(masses)
        for purposes in (["default", "render"], ["guide"]):
            cache = UsdGeom.BBoxCache(Usd.TimeCode.Default(), purposes, useExtentsHint=False)
            box = cache.ComputeWorldBound(root).ComputeAlignedRange()
            if not box.IsEmpty():
                data["asset_extents"] = Gf.Vec3f(*box.GetSize())
                break
        if joints.has_variants:
            variant = {"prim": self.root, "variantSetName": VARIANTS, "activateOption": ACTUATORS}
            data["Variants"] = {"Physics": {VARIANTS: variant}}
        layer = self.stage.GetRootLayer()
        layer.customLayerData = {**layer.customLayerData, "SimReady_Metadata": data}

    # --- mass ---

    def _set_mass(self, mass: UsdPhysics.MassAPI, link: Link) -> None:
        inertial = link.inertial
        if inertial is None or inertial.mass <= 0:
            self.losses.approximate("links without mass", link, how="links of 1 g")
            moment = 2 / 5 * PLACEHOLDER * 0.01**2
            mass.CreateMassAttr(PLACEHOLDER)
            mass.CreateDiagonalInertiaAttr(Gf.Vec3f(moment))
            mass.CreatePrincipalAxesAttr(Gf.Quatf(1.0))
            return
        moments, pose = self._principal(link, inertial)
        mass.CreateMassAttr(inertial.mass)
        mass.CreateCenterOfMassAttr(Gf.Vec3f(*inertial.pose.position))
        mass.CreateDiagonalInertiaAttr(Gf.Vec3f(*moments))
        mass.CreatePrincipalAxesAttr(Gf.Quatf(quaternion_of(pose)))
        # Newton takes the tensor, about the centre of mass and along the axes of the body, exactly.
        xx, xy, xz, yy, yz, zz = [
            sum(row[k] * moments[k] * other[k] for k in range(3))
            for i, row in enumerate(pose.rotation)
            for other in pose.rotation[i:]
        ]
        prim = mass.GetPrim()
        prim.AddAppliedSchema("NewtonMassAPI")
        tensor = prim.CreateAttribute(
            "newton:inertia", Sdf.ValueTypeNames.DoubleArray, custom=False
        )
        tensor.Set(Vt.DoubleArray([xx, yy, zz, xy, xz, yz]))

    def _principal(self, link: Link, inertial: Inertial) -> tuple[tuple[float, float, float], Pose]:
        """Return the principal moments, and T_link_axes."""
        if not any(inertial.inertia):
            how = "balls with a radius of 1 µm"
            self.losses.approximate("point masses", link, how=how)
            moment = 2 / 5 * inertial.mass * POINT_RADIUS**2
            return (moment, moment, moment), inertial.pose
        principal = self._inertias.by_link[link.name]
        first, second, third = moments = principal.moments
        least = SMALLEST * max(moments)
        if min(moments) < least:
            how = "a billionth of the greatest"
            self.losses.approximate("moments of inertia of 0", link, how=how)
            moments = (max(first, least), max(second, least), max(third, least))
        return moments, principal.pose
