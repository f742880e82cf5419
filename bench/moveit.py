"""Lets MoveIt's own builder read configurations that `yamaro --to moveit` has written.

    python bench/moveit.py UTILS PARAMETERS FOLDER…

UTILS is the folder moveit_configs_utils of a checkout of moveit2, PARAMETERS a checkout of
launch_param_builder; both are Python. What they import of ROS is replaced: a package is the folder
with its name, or moveit_configs_utils itself. Each FOLDER is a NAME_moveit_config. Its parameters
are built, and each has to have the type that MoveIt declares it with.
"""

from __future__ import annotations

import logging
import re
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

Json = dict[str, Any]


def stand_in(utils: Path, parameters: Path, packages: dict[str, Path]) -> None:
    """Put modules in the place of those of ROS."""

    def share(name: str) -> str:
        return str(packages[name])

    def module(name: str, **content: object) -> None:
        made = ModuleType(name)
        vars(made).update(content)
        sys.modules[name] = made

    packages["moveit_configs_utils"] = utils
    module("ament_index_python", get_package_share_directory=share)
    module("ament_index_python.packages", get_package_share_directory=share)
    for name in (
        *("launch", "launch.actions", "launch.conditions", "launch.launch_description_sources"),
        *("launch.substitutions", "launch.substitution", "launch.utilities", "launch_ros"),
        *("launch.some_substitutions_type", "launch_ros.actions", "srdfdom", "srdfdom.srdf"),
        *("launch_ros.parameter_descriptions", "launch.launch_context", "launch.frontend"),
    ):
        made = ModuleType(name)
        made.__getattr__ = lambda name: type(name, (), {})  # type: ignore[method-assign]
        sys.modules[name] = made
    module("moveit_configs_utils.substitutions", Xacro=object)
    sys.path[:0] = [str(utils), str(parameters)]


def faults(config: Json) -> list[str]:
    """Return what is wrong with the parameters of a configuration."""
    found = [
        f"{name} is not XML"
        for name in ("robot_description", "robot_description_semantic")
        if not str(config.get(name, "")).lstrip().startswith("<?xml")
    ]
    planning = config.get("robot_description_planning", {})
    for joint, limits in planning.get("joint_limits", {}).items():
        found += [
            f"joint_limits.{joint}.{name}: {value!r}"
            for name, value in limits.items()
            if type(value) is not (bool if name.startswith("has_") else float)
        ]
    cartesian = planning.get("cartesian_limits", {})
    found += [
        f"cartesian_limits.{name} is not a double"
        for name in ("max_trans_vel", "max_trans_acc", "max_trans_dec", "max_rot_vel")
        if type(cartesian.get(name)) is not float
    ]
    for group, solver in config.get("robot_description_kinematics", {}).items():
        if "/" not in solver.get("kinematics_solver", ""):
            found.append(f"kinematics.{group} has no solver")
    manager = config.get("moveit_simple_controller_manager", {})
    for name in manager.get("controller_names", ["?"]):
        own = manager.get(name, {})
        kinds = {"type": str, "action_ns": str, "default": bool, "joints": list}
        found += [f"{name}.{key}" for key, kind in kinds.items() if type(own.get(key)) is not kind]
    if config.get("default_planning_pipeline") != "ompl":
        found.append("there is no planner")
    return found


def name_of(folder: Path) -> str:
    """Return the name of the package that a folder is."""
    found = re.search("<name>(.*)</name>", (folder / "package.xml").read_text(encoding="utf-8"))
    return found[1] if found else folder.name


def main(utils: Path, parameters: Path, folders: list[Path]) -> int:
    """Build the configurations; return 1 if one has a fault."""
    names = {folder: name_of(folder) for folder in folders}
    packages: dict[str, Path] = {}
    stand_in(utils.resolve(), parameters.resolve(), packages)
    from moveit_configs_utils import MoveItConfigsBuilder

    said: list[str] = []
    handler = logging.Handler()
    handler.emit = lambda record: said.append(record.getMessage())  # type: ignore[method-assign]
    logging.getLogger().addHandler(handler)
    status = 0
    for folder in folders:
        said.clear()
        packages[names[folder]] = folder.resolve()
        stem = folder.name.removesuffix("_moveit_config")
        builder = MoveItConfigsBuilder(stem, package_name=names[folder])
        config = builder.to_moveit_configs().to_dict()
        found = [*faults(config), *said]
        status |= bool(found)
        print(
            f"{folder.name}: {len(config)} parameters, {'; '.join(found) or 'as MoveIt reads it'}"
        )
    return status


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    first, second, *rest = [Path(each) for each in sys.argv[1:]]
    sys.exit(main(first, second, rest))
