"""What `--gazebo` writes, as SDFormat reads it."""

from __future__ import annotations

import os
import shutil
import subprocess
from xml.etree import ElementTree

import pytest

import yamaro
from tests.golden import CASES

CASE = CASES / "sensors" / "gazebo.yaml"
IGN = shutil.which("ign")


@pytest.fixture(scope="module")
def sdf(tmp_path_factory: pytest.TempPathFactory) -> ElementTree.Element:
    if IGN is None:
        pytest.skip("SDFormat is not installed")
    path = tmp_path_factory.mktemp("gazebo") / "lamp.urdf"
    path.write_text(yamaro.build(CASE, gazebo=True).xml())
    environment = {**os.environ, "HOME": str(path.parent)}
    done = subprocess.run(
        [IGN, "sdf", "-p", str(path)], capture_output=True, text=True, env=environment, check=True
    )
    assert "Error" not in done.stderr
    return ElementTree.fromstring(done.stdout)


def test_sdformat_finds_each_sensor_in_its_link_or_joint(sdf: ElementTree.Element) -> None:
    homes = {
        sensor.attrib["name"]: (home.tag, home.attrib["name"], sensor.attrib["type"])
        for home in sdf.iter()
        for sensor in home.findall("sensor")
    }
    base = ("link", "base_link")
    assert homes == {
        "imu": (*base, "imu"),
        "scan": (*base, "gpu_lidar"),
        "rows": (*base, "gpu_lidar"),
        "eye": (*base, "camera"),
        "depth": (*base, "depth_camera"),
        "fix": (*base, "navsat"),
        "bump": (*base, "contact"),
        "north": (*base, "magnetometer"),
        "near": (*base, "gpu_lidar"),
        "drive": ("joint", "rod_joint", "force_torque"),
        "wrist": ("joint", "tip_joint", "force_torque"),
    }


def test_sdformat_finds_the_surfaces(sdf: ElementTree.Element) -> None:
    def numbers(link: str) -> list[float | None]:
        surface = sdf.find(f".//link[@name='{link}']/collision/surface")
        assert surface is not None
        paths = ("friction/ode/mu", "friction/ode/mu2", "bounce/restitution_coefficient")
        texts = [surface.findtext(path) for path in (*paths, "contact/ode/kp", "contact/ode/kd")]
        return [None if text is None else float(text) for text in texts]

    assert numbers("base_link") == [0.8, 0.8, None, 1000, 10]
    assert numbers("rod_link") == [1, 0.5, 0.5, 1000, None]


def test_without_the_option_nothing_is_written_for_gazebo() -> None:
    assert "<gazebo" not in yamaro.build(CASE).xml()


def test_a_jail_writes_the_same() -> None:
    expected = yamaro.build(CASE, gazebo=True).xml()
    assert yamaro.build(CASE, gazebo=True, policy=yamaro.Policy("jail")).xml() == expected
