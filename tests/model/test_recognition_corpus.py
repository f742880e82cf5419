"""What real robots say in `<gazebo>`, `<ros2_control>` and `<transmission>`, counted by XPath."""

from __future__ import annotations

import csv
from collections import Counter
from pathlib import Path

import pytest
from lxml import etree

from tests.effort import tried
from yamaro.model import Robot

CORPUS = Path(__file__).parents[3] / "shared" / "corpus"
pytestmark = pytest.mark.skipif(not CORPUS.exists(), reason="there is no corpus")

TYPES = {
    "imu": "imu",
    "ray": "lidar",
    "gpu_ray": "lidar",
    "gpu_lidar": "lidar",
    "camera": "camera",
    "depth": "depth_camera",
    "contact": "contact",
}
PLUGIN_SENSORS = {
    "force_torque": "libgazebo_ros_ft_sensor.so",
    "imu": "libhector_gazebo_ros_imu.so",
    "gps": "libhector_gazebo_ros_gps.so",
}
SURFACE = " or ".join(
    (
        *("mu1", "mu2", "kp", "kd"),
        *(f"collision/surface/friction/ode/{tag}" for tag in ("mu", "mu2")),
        *(f"collision/surface/contact/ode/{tag}" for tag in ("kp", "kd")),
    )
)
COMMANDED = " or ".join(f"@name='{name}'" for name in ("position", "velocity", "effort"))
INTERFACES = " or ".join(
    f"contains(., '{name}JointInterface')" for name in ("Position", "Velocity", "Effort")
)


def robots() -> list[str]:
    with (CORPUS / "urdf.tsv").open(encoding="utf-8") as file:
        paths = [f"src/{row['path']}" for row in csv.DictReader(file, delimiter="\t")]
    with (CORPUS / "xacro.tsv").open(encoding="utf-8") as file:
        rows = csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE)
        return paths + [row["expected"] for row in rows]


def sensors(root: etree._Element) -> Counter[str]:
    found: Counter[str] = Counter()
    home = "[../@reference = /robot/link/@name]"
    for sensor in root.xpath(f"gazebo/sensor{home}"):
        kind = sensor.get("type")
        if sensor.xpath("plugin[contains(@filename, 'gazebo_ros_range')]"):
            found["range"] += 1
        elif kind == "multicamera":
            found["camera"] += len(sensor.xpath("camera"))
        else:
            found[TYPES[kind]] += 1
    for kind, file in PLUGIN_SENSORS.items():
        found[kind] += int(root.xpath(f"count(gazebo/plugin[@filename='{file}'])"))
    found["imu"] += int(root.xpath("count(gazebo/plugin[@filename='libgazebo_ros_imu.so'])"))
    return +found


def driven(root: etree._Element) -> set[str]:
    free = root.xpath("joint[@type != 'fixed' and not(mimic)]/@name")
    names = root.xpath(f"ros2_control/joint[command_interface[{COMMANDED}]]/@name")
    names += root.xpath(f"transmission/joint[hardwareInterface[{INTERFACES}]]/@name")
    names += root.xpath(
        f"transmission[actuator/hardwareInterface[{INTERFACES}]]"
        "/joint[not(hardwareInterface[contains(., 'JointInterface')])]/@name"
    )
    names += root.xpath("transmission[contains(@type, 'pr2_mechanism_model/')]/joint/@name")
    return set(names) & set(free)


def surfaces(root: etree._Element) -> Counter[str]:
    links = set(root.xpath(f"gazebo[{SURFACE}]/@reference"))
    counts = {link.get("name"): len(link.xpath("collision")) for link in root.xpath("link")}
    return +Counter({link: counts.get(link, 0) for link in links})


@pytest.mark.parametrize("path", tried(robots(), str, quick=20, usual=4) if CORPUS.exists() else [])
def test_all_that_xpath_finds_is_recognized(path: str) -> None:
    root = etree.parse(CORPUS / path).getroot()
    robot = Robot.from_urdf(CORPUS / path)
    assert Counter(sensor.type for sensor in robot.sensors.values()) == sensors(root)
    assert set(robot.actuators) == driven(root)
    assert Counter(surface.link for surface in robot.surfaces) == surfaces(root)
    assert len(robot.controls) == len(root.xpath("ros2_control"))
