"""The files of a new package, made of the template beside this module; its name and picture."""

from __future__ import annotations

import keyword
import os
import re
import sys
from collections.abc import Iterator, Mapping

from ... import __version__
from ...api import build
from ...confined import Reader
from ...diagnostics import YamaroError
from ...files.loader import MemoryLoader
from ...picture.command import check_packages, draw
from ...picture.request import Request
from ...policy import Policy
from ...result import Build

PICTURE = "picture.png"
CONTROLLERS = "config/ros2_controllers.yaml"
"""What `--to controllers` makes of the robot."""

_TEMPLATE = os.path.join(os.path.dirname(__file__), "template")
_PICTURE_IN_README = f"![The robot]({PICTURE})\n\n"


def files_of(name: str, *, has_picture: bool) -> dict[str, str]:
    """Return the texts of a package's files, by their paths in its folder, which have `/`.

    Args:
        name: that of the package, and of its robot.
        has_picture: whether `picture.png` is there, for the README to show.
    """
    values = {
        "NAME": name,
        "DISTRIBUTION": name.replace("_", "-"),
        "YAMARO": __version__,
        "PICTURE": _PICTURE_IN_README if has_picture else "",
    }
    files = {}
    for path in _paths():
        with open(os.path.join(_TEMPLATE, *path.split("/")), encoding="utf-8") as file:
            text = file.read()
        for word, value in values.items():
            text = text.replace(f"@{word}@", value)
        path = path.replace("NAME", name).replace("dot-", ".")
        files[path.removesuffix(".in")] = text  # with it, tools would take the template for a file
    files[CONTROLLERS] = _built(name, os.path.abspath(name), files, target="controllers").xml()
    return files


def _built(name: str, folder: str, files: Mapping[str, str], *, target: str) -> Build:
    """Return the build of a package's robot, whose files are in memory, as if in a folder."""
    texts = {os.path.join(folder, *path.split("/")): text for path, text in files.items()}
    path = os.path.join(folder, *main_file(name).split("/"))
    return build(path, loader=MemoryLoader(texts), target=target)


def main_file(name: str) -> str:
    """Return the path of a package's robot."""
    return f"urdf/{name}.yaml"


def _paths() -> Iterator[str]:
    for folder, inner, names in os.walk(_TEMPLATE):
        inner.sort()
        for name in sorted(names):
            yield os.path.relpath(os.path.join(folder, name), _TEMPLATE).replace(os.sep, "/")


# --- what a new package may be called: by ROS, by Python, by pip and by Yamaro itself ---------


LONGEST = 64
_VALID = re.compile(r"[a-z][a-z0-9]*(_[a-z0-9]+)*")
_TAKEN = {"yamaro", "yamaro_ros"}
_MODULES = sys.stdlib_module_names | {"test"}


def fault_of_name(name: str) -> str | None:
    """Return what is wrong with the name of a package, and what to write, or None."""
    if not name:
        return "the name is empty"
    if len(name) > LONGEST:
        return f"it has more than {LONGEST} characters"
    if not _VALID.fullmatch(name) or len(name) < 2:
        rule = (
            "the names of ROS packages have lower-case letters, digits and single underscores, "
            "begin with a letter, and have at least two characters"
        )
        spaced = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name)
        near = re.sub(r"[^a-z0-9]+", "_", spaced.lower()).strip("_").lstrip("0123456789_")
        near = near if len(near) > 1 and fault_of_name(near) is None else ""
        return f"{rule}; for example '{near}'" if near else rule
    if name in _TAKEN:
        return "Yamaro itself has that name"
    if keyword.iskeyword(name):
        return f"it is a keyword of Python; for example '{name}_robot'"
    if name in _MODULES:
        return f"Python has a module of that name; for example '{name}_robot'"
    return None


# --- the picture of a new robot, if one can be drawn here -------------------------------------


def picture_of(name: str, folder: str) -> bytes | None:
    """Return the picture of a new package's robot, or None if nothing can be drawn here.

    Args:
        name: that of the package.
        folder: where it will be.
    """
    path = os.path.join(folder, *main_file(name).split("/"))
    request = Request(PICTURE, {}, {})
    try:
        check_packages(path)
        robot = _built(name, folder, files_of(name, has_picture=False), target="urdf")
        return draw(robot, path, request, Reader(Policy(), readable=[], name=path)).data
    except YamaroError:
        return None
