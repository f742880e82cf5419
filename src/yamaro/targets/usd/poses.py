"""Poses of prims."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pxr import Gf, UsdGeom

from ...model.pose import quaternion_from_rotation

if TYPE_CHECKING:
    from ...model.pose import Pose


def quaternion_of(pose: Pose) -> Gf.Quatd:
    """Return the rotation of a pose; Gf's own way through an angle is exact to 1e-5 only."""
    w, x, y, z = quaternion_from_rotation(pose.rotation)
    return Gf.Quatd(w, x, y, z)


def place(prim: UsdGeom.Xformable, pose: Pose, scale: tuple[float, ...] | None = None) -> None:
    """Put a prim at a pose in the one around it, and scale it."""
    xform = UsdGeom.Xformable(prim)
    xform.AddTranslateOp().Set(Gf.Vec3d(*pose.position))
    xform.AddOrientOp(UsdGeom.XformOp.PrecisionDouble).Set(quaternion_of(pose))
    if scale is not None:
        xform.AddScaleOp(UsdGeom.XformOp.PrecisionDouble).Set(Gf.Vec3d(*scale))
