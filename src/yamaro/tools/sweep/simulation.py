"""The MJCF of a variant, compiled by MuJoCo."""

from __future__ import annotations

from ...diagnostics import failure, failure_of_all

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ...result import Build

FORMAT = "mjcf"
SCENE = "scene.xml"
HINT = "pip install mujoco"


def compiled(build: Build, *, has_floor: bool = False, has_sensors: bool = True) -> Any:
    """Return the `mujoco.MjModel` of a robot.

    Args:
        build: its MJCF.
        has_floor: compile `scene.xml`, in which the robot is on a floor.
        has_sensors: keep the sensors; each of the hundreds of rays of a lidar is one.

    Raises:
        YamaroError: MuJoCo is not installed, or refuses the robot.
    """
    mujoco = import_mujoco()
    files = dict(build.assets)
    text = build.xml() if has_sensors else without_sensors(build.xml())
    if has_floor:
        scene = files.pop(SCENE).decode()
        files[_included(scene)] = text.encode()
        text = scene
    try:
        return mujoco.MjModel.from_xml_string(text, files)
    except ValueError as error:
        message = f"MuJoCo refuses the robot: {' '.join(str(error).split())}"
        raise failure("mujoco-refused", message, build.robot.span) from None


def without_sensors(mjcf: str) -> str:
    """Return an MJCF without its sensors, and without the sites that only sensors name."""
    from xml.etree import ElementTree

    root = ElementTree.fromstring(mjcf)
    freed: set[str | None] = set()
    for section in root.findall("sensor"):
        for each in section:
            freed.update(value for key, value in each.attrib.items() if key != "name")
        root.remove(section)
    for each in root.iter():
        if each.tag != "site":
            freed.difference_update(each.attrib.values())
    for around in list(root.iter()):
        for site in around.findall("site"):
            if site.get("name") in freed:
                around.remove(site)
    return ElementTree.tostring(root, encoding="unicode")


def import_mujoco() -> Any:
    """Return the module; raise YamaroError if it is not installed."""
    try:
        import mujoco
    except ImportError:
        message = "the evaluation needs the Python package 'mujoco', which is missing"
        raise failure_of_all("missing-extra", message, "<sweep>", HINT) from None
    return mujoco


def _included(scene: str) -> str:
    """Return the name of the file that a scene includes."""
    from xml.etree import ElementTree

    include = ElementTree.fromstring(scene).find("include")
    assert include is not None, "scenes are written with one"
    return include.attrib["file"]
