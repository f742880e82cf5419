"""The features of a robot in USD.

Sources: https://openusd.org/release/api/usd_physics_page_front.html and, for what is in the
namespace `newton`, https://pypi.org/project/newton-usd-schemas/.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from math import degrees, isfinite, radians

from pxr import Sdf, Usd, UsdGeom, UsdPhysics, UsdShade

from .feature import Key

IN_RAYS = ("samples", "min_angle", "max_angle", "min", "max")
"""What the directions of rays and their ranges hold of Gazebo's sensors."""
ROUND = {"Sphere": ("radius",), "Cylinder": ("radius", "height"), "Capsule": ("radius", "height")}
"""The sizes of shapes, in the order in which URDF has them; a box is a scaled cube."""


def read(text: str, own: Mapping[str, str]) -> Iterator[Key]:
    """Yield the features of a USD, with the names in the robot.

    Args:
        text: the document.
        own: the names in the robot of what is called differently in it.
    """
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(text)
    stage = Usd.Stage.Open(layer)
    yield ("link", "world")  # is always there
    for prim in stage.Traverse():
        name = own.get(prim.GetName(), prim.GetName())
        if prim.IsA(UsdPhysics.Joint):
            yield from _joint(prim, name, own)
        elif prim.IsA(UsdShade.Material):
            yield ("material", "shape", name)
        elif prim.IsA(UsdGeom.Camera):
            yield ("sensor", name)
            for each in ("horizontal_fov", "near", "far", "pose", "always_on"):
                yield ("in sensor", name, each)
            if prim.HasAttribute("omni:sensor:tickRate"):
                yield ("in sensor", name, "update_rate")
        elif prim.GetTypeName() == "RenderProduct":
            (camera,) = prim.GetRelationship("camera").GetTargets()
            for each in ("width", "height"):
                yield ("in sensor", own.get(camera.name, camera.name), each)
        elif prim.GetTypeName().startswith("Isaac"):
            yield ("sensor", name)
            for each in ("pose", "always_on"):
                yield ("in sensor", name, each)
            if prim.HasAttribute("sensorPeriod"):
                yield ("in sensor", name, "update_rate")
            for key in IN_RAYS if prim.HasAttribute("rayDirections") else ():
                yield ("in sensor", name, key)
                yield ("in sensor", name, key)  # rays are in two directions
        elif prim.GetTypeName() == "NewtonActuator":  # in place of a drive
            (joint,) = prim.GetRelationship("newton:targets").GetTargets()
            yield ("actuated", own.get(joint.name, joint.name))
        elif prim.IsInstance() or (
            prim.IsA(UsdGeom.Gprim)
            and "NewtonSiteAPI" not in prim.GetPrimTypeInfo().GetAppliedAPISchemas()
        ):
            yield from _shape(prim)
            yield ("shape name", name)
        elif prim.IsA(UsdGeom.Xform) and prim != stage.GetDefaultPrim():
            yield ("link", name)
            if prim.HasAPI(UsdPhysics.MassAPI):
                yield ("mass", name, UsdPhysics.MassAPI(prim).GetMassAttr().Get())
    yield from _commands(stage, own)


def _commands(stage: Usd.Stage, own: Mapping[str, str]) -> Iterator[Key]:
    """Yield what joints can be commanded, by their drives or by actuators in place of these."""
    found = set()
    variants = stage.GetDefaultPrim().GetVariantSet("Newton")
    for chosen in variants.GetVariantNames() or [""]:
        if chosen:
            variants.SetVariantSelection(chosen)
        for prim in stage.Traverse():
            joint, gains = prim.GetName(), ("", "")
            if prim.GetTypeName() == "NewtonActuator":
                (path,) = prim.GetRelationship("newton:targets").GetTargets()
                joint, gains = path.name, ("newton:kp", "newton:kd")
                found.add((joint, "effort"))
            for axis in ("linear", "angular"):
                if prim.HasAPI(UsdPhysics.DriveAPI, axis):
                    before = f"drive:{axis}:physics"
                    gains = (f"{before}:stiffness", f"{before}:damping")
            for command, gain in zip(("position", "velocity"), gains, strict=True):
                if gain and prim.GetAttribute(gain).Get():
                    found |= {(joint, command), (joint, "effort")}
    yield from (("command", own.get(joint, joint), command) for joint, command in sorted(found))


def _joint(prim: Usd.Prim, name: str, own: Mapping[str, str]) -> Iterator[Key]:
    joint = UsdPhysics.Joint(prim)
    (child,) = joint.GetBody1Rel().GetTargets()
    if prim.IsA(UsdPhysics.FixedJoint):
        yield ("fixed", own.get(child.name, child.name))
        return
    is_linear = prim.IsA(UsdPhysics.PrismaticJoint)
    if not is_linear and not prim.IsA(UsdPhysics.RevoluteJoint):
        axes = [each for each in prim.GetAppliedSchemas() if each.startswith("PhysicsLimitAPI")]
        limits = [UsdPhysics.LimitAPI(prim, each.partition(":")[2]) for each in axes]
        held = [each for each in limits if each.GetLowAttr().Get() > each.GetHighAttr().Get()]
        yield ("joint", name, "planar" if len(held) == 3 else "floating")
        return
    lower, upper = (prim.GetAttribute(f"physics:{end}Limit").Get() for end in ("lower", "upper"))
    has_limits = isfinite(lower) or isfinite(upper)
    yield ("joint", name, "prismatic" if is_linear else "revolute")
    if not has_limits and not is_linear:
        yield ("joint", name, "continuous")
    if has_limits:
        ends = (lower, upper) if is_linear else (radians(lower), radians(upper))
        yield ("range", name, *ends)
    unit = 1.0 if is_linear else degrees(1)
    for key, attribute, factor in (
        ("damping", "newton:damping", unit),
        ("friction", "newton:friction", 1.0),
        ("velocity", "newton:velocityLimit", 1 / unit),
    ):
        value = prim.GetAttribute(attribute).Get()
        if value is not None:
            yield (key, name, value * factor)
    for leader in prim.GetRelationship("newton:mimicJoint").GetTargets():
        factor, offset = (prim.GetAttribute(f"newton:mimicCoef{each}").Get() for each in (1, 0))
        yield ("mimic", name, own.get(leader.name, leader.name), factor, offset / unit)
    axis = "linear" if is_linear else "angular"
    drive = UsdPhysics.DriveAPI(prim, axis)
    if not prim.HasAPI(UsdPhysics.DriveAPI, axis):
        return
    if drive.GetStiffnessAttr().Get() or drive.GetDampingAttr().Get():
        yield ("actuated", name)  # by its position or by its speed
    effort = drive.GetMaxForceAttr().Get()
    if isfinite(effort):
        yield ("effort", name, effort)


def _shape(prim: Usd.Prim) -> Iterator[Key]:
    meshes = list(Usd.PrimRange(prim, Usd.TraverseInstanceProxies()))[1:]
    inner = meshes[0] if prim.IsInstance() else prim
    kind = "collision" if inner.HasAPI(UsdPhysics.CollisionAPI) else "visual"
    name = prim.GetTypeName()
    scale = prim.GetAttribute("xformOp:scale").Get()
    shape = inner.GetParent().GetCustomDataByKey("shape") if prim.IsInstance() else None
    if name == "Cube":
        side = UsdGeom.Cube(prim).GetSizeAttr().Get()
        yield (kind, "box", *(side * each for each in scale))
    elif name in ROUND:
        yield (kind, name.lower(), *(prim.GetAttribute(each).Get() for each in ROUND[name]))
    elif shape:  # whose mesh has the size 1, or the radius 1
        length = inner.GetParent().GetCustomDataByKey("lengthOfRadius") or 0.0
        x, y, z = scale
        sizes = {"box": (x, y, z), "cylinder": (x, z), "sphere": (x,), "capsule": (x, length * x)}
        yield (kind, shape, *sizes[shape])
        low, high = inner.GetAttribute("extent").Get()
        extent = [(b - a) * s for a, b, s in zip(low, high, scale, strict=True)]
        radii = {"box": (x, y, z), "capsule": (2 * x, 2 * x, (length + 2) * x)}
        expected = radii.get(shape, (2 * x, 2 * x, 2 * x if shape == "sphere" else z))
        if any(abs(a - b) > 1e-6 * b for a, b in zip(extent, expected, strict=True)):
            yield (kind, shape, "of another size", *extent)
    else:
        yield (kind, "mesh")
    bound = UsdShade.MaterialBindingAPI(inner)
    look = bound.ComputeBoundMaterial()[0] if kind == "visual" else None
    if look:
        is_mesh = "mesh" if prim.IsInstance() and not shape else "shape"
        shader = UsdShade.Shader(look.ComputeSurfaceSource()[0])
        color, alpha = (shader.GetInput(each).Get() for each in ("diffuseColor", "opacity"))
        image = look.GetPrim().GetChild("texture")
        if image:
            color = image.GetAttribute("inputs:scale").Get()[:3]
            path = image.GetAttribute("inputs:file").Get().path
            name = re.sub(r"-[0-9a-f]{12}(?=\.)", "", path.rpartition("/")[2])  # by its content
            yield ("texture", is_mesh, name)
        if color is not None:
            yield ("color", is_mesh, *color, alpha)
    friction = bound.GetDirectBinding("physics").GetMaterial()
    if friction:
        prim = friction.GetPrim()
        value = UsdPhysics.MaterialAPI(prim).GetStaticFrictionAttr().Get()
        yield ("gazebo", "mu", value)
        yield ("gazebo", "mu2", value)
        for key, attribute in (("kp", "contactStiffness"), ("kd", "contactDamping")):
            if prim.HasAttribute(f"newton:{attribute}"):
                yield ("gazebo", key, prim.GetAttribute(f"newton:{attribute}").Get())
