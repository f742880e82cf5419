"""Sensors of USD: cameras with what they render, and the sensors of Isaac Sim.

Isaac Sim's own types are prims without a library: `IsaacImuSensor`, `IsaacContactSensor` and
`IsaacRaycastSensor`, which casts rays along x of its frame, or in the directions that it lists.
The rate of a camera is in Omniverse's `OmniSensorAPI`. Sources: isaacsim.robot.schema and the docs
of Isaac Sim 6.2, https://github.com/isaac-sim/IsaacSim.
"""

from __future__ import annotations

from math import cos, pi, sin, tan
from typing import TYPE_CHECKING

from pxr import Gf, Sdf, UsdGeom, UsdRender, Vt

from ...model.extras import Camera, Lidar, Ranger
from ...model.pose import IDENTITY, Pose, rotation_from_rpy
from ..holding import cones, lost_of_sensor, renamed_sensors
from ..losses import Losses
from .prims import place, place_by_name

if TYPE_CHECKING:
    from ...model.extras import Sensor
    from .prims import Writing

APERTURE = 20.955
"""The width of the sensor of a camera, in tenths of a unit: USD's default."""
VIEW = Pose(rotation_from_rpy(pi / 2, 0.0, -pi / 2))
"""T_frame_view: x is forward and z up in the frame; -z is forward and y up in USD."""
TYPES = {
    "imu": "IsaacImuSensor",
    "contact": "IsaacContactSensor",
    "lidar": "IsaacRaycastSensor",
    "range": "IsaacRaycastSensor",
}
"""The types of prims of Isaac Sim."""


class SensorWriter:
    """Makes the sensors of one robot.

    Attributes:
        losses: what USD cannot hold of them.
    """

    def __init__(self, writing: Writing) -> None:
        self._stage, self._robot = writing.stage, writing.robot
        self._bodies, self._paths = writing.bodies, writing.paths
        self._names, self._root = writing.names, writing.root
        self._renders = ""
        self.losses = Losses()

    def write(self) -> None:
        """Write all sensors; note those that no schema has, of which the frames stay."""
        self.losses += renamed_sensors(self._robot)
        for sensor in self._robot.sensors.values():
            home = self._paths.get(sensor.frame or "") or self._paths.get(sensor.link or "")
            details = sensor.details
            if home is None or not (isinstance(details, Camera) or sensor.type in TYPES):
                self.losses.lose(f"{sensor.type} sensors", sensor)
                continue
            path = self._names.told(home, "sensor", sensor.name, sensor)
            self.losses += lost_of_sensor(sensor, "usd")
            if isinstance(details, Camera):
                self._camera(path, sensor, details)
                continue
            self._of_isaac(path, sensor)
            if sensor.noise or sensor.noises:
                self.losses.lose("noise of sensors", sensor, field="noise")
        self.losses += cones(self._robot)

    def _camera(self, path: str, sensor: Sensor, details: Camera) -> None:
        camera = UsdGeom.Camera.Define(self._stage, path)
        place(camera, sensor.pose @ VIEW)
        width, height = details.size
        camera.CreateHorizontalApertureAttr(APERTURE)
        camera.CreateVerticalApertureAttr(APERTURE * height / width)
        camera.CreateFocalLengthAttr(APERTURE / (2 * tan(details.fov / 2)))
        camera.CreateClippingRangeAttr(Gf.Vec2f(*details.clip))
        if sensor.rate:
            prim = camera.GetPrim()
            prim.AddAppliedSchema("OmniSensorAPI")
            ticks = prim.CreateAttribute(
                "omni:sensor:tickRate", Sdf.ValueTypeNames.Float, custom=False
            )
            ticks.Set(sensor.rate)
        if not self._renders:
            self._renders = self._names.new(self._root, "renders")
            self._stage.DefinePrim(self._renders, "Scope")
        at = self._names.new(self._renders, path.rpartition("/")[2])
        product = UsdRender.Product.Define(self._stage, at)
        product.CreateCameraRel().SetTargets([Sdf.Path(path)])
        product.CreateResolutionAttr(Gf.Vec2i(width, height))
        is_depth = sensor.type == "depth_camera"
        image = UsdRender.Var.Define(self._stage, f"{at}/{'depth' if is_depth else 'color'}")
        image.CreateSourceNameAttr("depth" if is_depth else "Ci")
        image.CreateDataTypeAttr("float" if is_depth else "color3f")
        product.CreateOrderedVarsRel().SetTargets([image.GetPath()])

    def _of_isaac(self, path: str, sensor: Sensor) -> None:
        prim, kinds = self._stage.DefinePrim(path, TYPES[sensor.type]), Sdf.ValueTypeNames
        if sensor.pose != IDENTITY:
            place_by_name(prim, sensor.pose)
        if sensor.rate:
            period = prim.CreateAttribute("sensorPeriod", kinds.Float, custom=False)
            period.Set(1 / sensor.rate)
        if sensor.type == "contact":
            how = "what touches the whole body"
            self.losses.approximate("contact sensors", sensor, how=how)
            carrier = self._bodies.carriers.get(sensor.link or "")
            if carrier is not None:
                body = self._stage.GetPrimAtPath(self._paths[carrier])
                body.AddAppliedSchema("PhysxContactReportAPI")
        details = sensor.details
        if isinstance(details, (Lidar, Ranger)):
            ways = _ways(details) if isinstance(details, Lidar) else [(1.0, 0.0, 0.0)]
            least, most = details.range
            prim.CreateAttribute("minRange", kinds.Float, custom=False).Set(least)
            prim.CreateAttribute("maxRange", kinds.Float, custom=False).Set(most)
            prim.CreateAttribute("numRays", kinds.UInt, custom=False).Set(len(ways))
            starts = Vt.Vec3fArray(len(ways))
            prim.CreateAttribute("rayOrigins", kinds.Float3Array, custom=False).Set(starts)
            listed = Vt.Vec3fArray([Gf.Vec3f(*way) for way in ways])
            prim.CreateAttribute("rayDirections", kinds.Float3Array, custom=False).Set(listed)


def _ways(lidar: Lidar) -> list[tuple[float, float, float]]:
    """Return the directions of the rays of a lidar, row by row from the lowest.

    At the angle a about z, in a row at b above the horizontal, a ray goes along
    (cos(a)·cos(b), sin(a)·cos(b), sin(b)).
    """
    low, high = lidar.tilt_ends()
    rise = (high - low) / (lidar.rows - 1) if lidar.rows > 1 else 0.0
    first = lidar.ends()[0]
    found = []
    for level in range(lidar.rows):
        for ray in range(lidar.rays):
            a, b = first + ray * lidar.step, low + level * rise
            found.append((cos(a) * cos(b), sin(a) * cos(b), sin(b)))
    return found
