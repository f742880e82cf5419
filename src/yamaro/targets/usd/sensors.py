"""Cameras of USD, and the sensors that it has no prims for."""

from __future__ import annotations

from math import pi, tan
from typing import TYPE_CHECKING

from pxr import Gf, UsdGeom

from ...model.extras import Camera
from ...model.pose import Pose, rotation_from_rpy
from ..holding import lost_of_sensor, renamed_sensors
from .prims import place

if TYPE_CHECKING:
    from pxr import Usd

    from ...model.robot import Robot
    from ..losses import Losses
    from .prims import Names

APERTURE = 20.955
"""The width of the sensor of a camera, in tenths of a unit: USD's default."""
VIEW = Pose(rotation_from_rpy(pi / 2, 0.0, -pi / 2))
"""T_frame_view: x is forward and z up in the frame; -z is forward and y up in USD."""


def add_cameras(
    stage: Usd.Stage, robot: Robot, paths: dict[str, str], names: Names, losses: Losses
) -> None:
    """Write the cameras of a robot; note the other sensors, of which the frames stay."""
    losses += renamed_sensors(robot)
    for sensor in robot.sensors.values():
        home = paths.get(sensor.frame or "") or paths.get(sensor.link or "")
        details = sensor.details
        if home is None or not isinstance(details, Camera):
            losses.lose(f"{sensor.type} sensors", sensor)
            continue
        path = names.told(home, "sensor", sensor.name, sensor)
        camera = UsdGeom.Camera.Define(stage, path)
        place(camera, sensor.pose @ VIEW)
        width, height = details.size
        camera.CreateHorizontalApertureAttr(APERTURE)
        camera.CreateVerticalApertureAttr(APERTURE * height / width)
        camera.CreateFocalLengthAttr(APERTURE / (2 * tan(details.fov / 2)))
        camera.CreateClippingRangeAttr(Gf.Vec2f(*details.clip))
        losses.lose("sizes of cameras in pixels", sensor, field="size")
        losses += lost_of_sensor(sensor, "usd")
