"""The folder of a MoveIt configuration: its files by their paths."""

from __future__ import annotations

from ...model.kinematics import WORLD
from ...xml.values import escaped_attribute, format_value
from ...xml.writer import write_pieces
from ..controllers.planning import Plan
from ..controllers.writer import text_of
from ..losses import RENAMED, Loss
from ..output import FOLDER, MARK, Output, marked
from ..parameters import yaml_of
from ..srdf.writer import write as write_srdf
from ..table import TARGETS, file_name_for
from .config import (
    CARTESIAN,
    initial_positions,
    joint_limits,
    kinematics,
    lacking_limits,
    moveit_controllers,
)
from .package import LAUNCHES, cmake_lists, launch_file, package_xml, rviz, setup_assistant

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from ...model.robot import Robot
    from ..output import Wanted

_COMMENT = "<!-- {} -->"


def write(robot: Robot, wanted: Wanted) -> Output:
    """Return the files of a package that MoveItConfigsBuilder reads.

    Raises:
        YamaroError: the SRDF cannot be written, or a controller lacks what it needs.
    """
    ending = TARGETS["moveit"].ending
    folder = wanted.file_name or file_name_for(robot.name, "moveit", wanted.name)
    stem = folder.removesuffix(ending)
    name = "".join(each if each.isascii() and each.isalnum() else "_" for each in folder.lower())
    package = name if name[:1].isalpha() else f"robot_{name}"
    plan = Plan(robot, wanted)
    semantic = write_srdf(robot, wanted)
    losses = [*semantic.losses, *plan.losses]
    if package != folder:
        losses.append(Loss(RENAMED, "names of packages", f"'{folder}'", robot.span, how=package))
    assert semantic.root is not None
    assets, urdf = _with_meshes(robot, wanted, package)
    documents: dict[str, Mapping[str, object]] = {
        ".setup_assistant": setup_assistant(stem, package),
        "config/initial_positions.yaml": initial_positions(robot),
        "config/joint_limits.yaml": joint_limits(robot),
        "config/kinematics.yaml": kinematics(robot),
        "config/moveit.rviz": rviz(_fixed_frame(robot)),
        "config/moveit_controllers.yaml": moveit_controllers(plan),
        "config/pilz_cartesian_limits.yaml": {"cartesian_limits": CARTESIAN},
    }
    texts = {name: f"# {MARK}\n{yaml_of(data)}" for name, data in documents.items()}
    texts["config/ros2_controllers.yaml"] = f"# {MARK}\n{text_of(plan)}"
    texts["package.xml"] = package_xml(
        package, robot.name or wanted.name, [each.plugin for each in plan.controllers]
    )
    texts["CMakeLists.txt"] = cmake_lists(package, has_assets=bool(assets))
    texts |= {f"launch/{name}.launch.py": launch_file(name, stem, package) for name in LAUNCHES}
    files = {name: text.encode() for name, text in texts.items()}
    srdf = "".join(write_pieces(semantic.root))
    for ending, text in (("urdf", urdf), ("srdf", srdf)):
        files[f"config/{stem}.{ending}"] = marked(
            text.replace("$(", "$$(").replace("${", "$${").encode(), _COMMENT
        )
    warnings = [*semantic.warnings, *plan.warnings, *lacking_limits(robot)]
    return Output(None, losses, files | assets, warnings=warnings)


def _fixed_frame(robot: Robot) -> str:
    """Return the frame in which MoveIt plans: that of the virtual joint, or else the root."""
    roots = robot.roots
    return WORLD if roots and roots[0].name != WORLD else roots[0].name if roots else WORLD


def _with_meshes(robot: Robot, wanted: Wanted, package: str) -> tuple[dict[str, bytes], str]:
    """Return the copies of meshes, and the URDF in which RViz and MoveIt find them.

    Both read the URDF from a parameter, so that a path that is relative to its file means nothing:
    copies are in the package, and what is not copied is named by its URI.
    """
    paths = wanted.paths
    root = paths.applied_to(robot.element)
    text = "".join(write_pieces(root))
    meshes = paths.finder.referred_to(robot.element)
    assets = paths.finder.made_among(meshes)
    if paths.assets is not None:
        assets |= paths.assets.of(meshes)
    for name in {
        format_value(each.attributes["filename"])
        for each in root.iter()
        if each.name in ("mesh", "texture") and "filename" in each.attributes
    }:
        uri = ""
        if name in assets and name.startswith(f"{FOLDER}/"):
            uri = f"package://{package}/{name}"
        elif "://" not in name:
            uri = _uri_of(robot, wanted, name)
        if uri:
            attribute = 'filename="{}"'
            text = text.replace(
                attribute.format(escaped_attribute(name)), attribute.format(escaped_attribute(uri))
            )
    return assets, text


def _uri_of(robot: Robot, wanted: Wanted, name: str) -> str:
    """Return the URI of the file that a path leads to, as it is written; "" if it is not there."""
    paths = wanted.paths
    for element in robot.element.iter():
        if element.name in ("mesh", "texture") and "filename" in element.attributes:
            written = format_value(element.attributes["filename"])
            span = element.value_span("filename")
            if paths.named(written, span) == name:
                path = paths.finder.reachable(written, span)
                if path is not None:
                    from pathlib import Path

                    return Path(path).as_uri()
    return ""
