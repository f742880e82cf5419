"""Poses of prims."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pxr import Gf, UsdGeom

if TYPE_CHECKING:
    from ...model.pose import Pose


def quaternion_of(pose: Pose) -> Gf.Quatd:
    """Return the rotation of a pose."""
    # Gf multiplies rows by matrices: the transpose of ours.
    columns = list(zip(*pose.rotation, strict=True))
    quaternion = Gf.Matrix3d(*(value for column in columns for value in column)).ExtractRotation()
    return quaternion.GetQuat().GetNormalized()


def place(prim: UsdGeom.Xformable, pose: Pose, scale: tuple[float, ...] | None = None) -> None:
    """Put a prim at a pose in the one around it, and scale it."""
    xform = UsdGeom.Xformable(prim)
    xform.AddTranslateOp().Set(Gf.Vec3d(*pose.position))
    xform.AddOrientOp(UsdGeom.XformOp.PrecisionDouble).Set(quaternion_of(pose))
    if scale is not None:
        xform.AddScaleOp(UsdGeom.XformOp.PrecisionDouble).Set(Gf.Vec3d(*scale))
