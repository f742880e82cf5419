"""What a jailed process sees of its surroundings: Python's own folders, a few variables."""

from __future__ import annotations

import os
import sys

KEPT_VARIABLES = (
    "LANG LC_ALL LC_COLLATE LC_CTYPE LC_MESSAGES LC_NUMERIC LC_TIME TZ "
    "ROS_DISTRO ROS_VERSION ROS_PYTHON_VERSION ROS_PACKAGE_PATH "
    "AMENT_PREFIX_PATH COLCON_PREFIX_PATH CMAKE_PREFIX_PATH"
).split()
"""The environment variables a jail keeps: language, time zone, and where ROS packages are.

All others are hidden, since an environment holds passwords, and what a robot reads it can print.
"""

_SYSTEM_FOLDERS = (
    "/lib",
    "/lib64",
    "/usr/lib",
    "/usr/lib64",
    "/usr/local/lib",
    "/etc/ld.so.cache",
    "/usr/share/zoneinfo",
)
_PACKAGE_FOLDERS = ("site-packages", "dist-packages")


def python_folders() -> list[str]:
    """Return what importing modules reads: Python's folders, and the system's shared libraries.

    Of Python's path only what lies in Python's installation or is a folder of packages by its
    name. The rest came there by where the program was started, and may hold anything.
    """
    prefixes = {sys.prefix, sys.exec_prefix, sys.base_prefix, sys.base_exec_prefix}
    paths = [entry for entry in sys.path if _holds_packages(entry, prefixes)]
    paths += [os.path.join(prefix, "lib") for prefix in sorted(prefixes)]
    paths.append(os.path.abspath(__file__)[: -len("sandbox/jail/surroundings.py") - 1])
    found: list[str] = []
    for path in sorted([*paths, *_SYSTEM_FOLDERS]):  # a folder comes before what is in it
        if not any(covers(folder, path) for folder in found):
            found.append(path)
    return found


def _holds_packages(path: str, prefixes: set[str]) -> bool:
    if not os.path.isabs(path):
        return False
    is_inside = any(path != prefix and covers(prefix, path) for prefix in prefixes)
    return is_inside or os.path.basename(os.path.normpath(path)) in _PACKAGE_FOLDERS


def covers(folder: str, path: str) -> bool:
    """Return whether `path` is `folder` or lies below it; both are absolute."""
    return path == folder or path.startswith(folder.rstrip("/") + "/")
