"""Cameras of USD, and the sensors that it has none for."""

from __future__ import annotations

from math import pi, tan
from typing import TYPE_CHECKING

from pxr import Gf, UsdGeom

from ...model.pose import Pose, rotation_from_rpy
from ...model.sensors import Camera
from ..output import LOST, Loss
from .poses import place

if TYPE_CHECKING:
    from pxr import Usd

    from ...model.robot import Robot
    from .names import Names

APERTURE = 20.955
"""The width of the sensor of a camera, in tenths of a unit: USD's default."""
VIEW = Pose(rotation_from_rpy(pi / 2, 0.0, -pi / 2))
"""T_frame_view: x is forward and z up in the frame; -z is forward and y up in USD."""


def add_cameras(
    stage: Usd.Stage, robot: Robot, paths: dict[str, str], names: Names, losses: list[Loss]
) -> None:
    """Write the cameras of a robot; note the other sensors, of which the frames stay."""
    for sensor in robot.sensors.values():
        home = paths.get(sensor.frame or "") or paths.get(sensor.link or "")
        details = sensor.details
        if home is None or not isinstance(details, Camera):
            owner = f"'{sensor.name}'"
            losses.append(
                Loss(LOST, f"{sensor.type} sensors", owner, sensor.span, trace=sensor.trace)
            )
            continue
        camera = UsdGeom.Camera.Define(stage, names.new(home, f"{sensor.name}_camera"))
        place(camera, sensor.pose @ VIEW)
        width, height = details.size
        camera.CreateHorizontalApertureAttr(APERTURE)
        camera.CreateVerticalApertureAttr(APERTURE * height / width)
        camera.CreateFocalLengthAttr(APERTURE / (2 * tan(details.fov / 2)))
        camera.CreateClippingRangeAttr(Gf.Vec2f(*details.clip))
        what = f"rates, sizes and noise of {sensor.type} sensors"
        losses.append(Loss(LOST, what, f"'{sensor.name}'", sensor.span, trace=sensor.trace))
