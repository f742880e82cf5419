"""The files of a new package, made of the template beside this module; its name and picture."""

from __future__ import annotations

import keyword
import os
import re
import sys
from collections.abc import Iterator, Mapping, Sequence

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
_AROUND = os.path.join(os.path.dirname(__file__), "around")
"""What is around a robot that exists; files whose names begin with a dot are those of a new one."""
_PICTURE_IN_README = f"![The robot]({PICTURE})\n\n"


def files_of(name: str, *, has_picture: bool) -> dict[str, str]:
    """Return the texts of a package's files, by their paths in its folder, which have `/`.

    Args:
        name: that of the package, and of its robot.
        has_picture: whether `picture.png` is there, for the README to show.
    """
    values = {
        "NAME": name,
        "ROBOT": name,
        "DISTRIBUTION": name.replace("_", "-"),
        "YAMARO": __version__,
        "PICTURE": _PICTURE_IN_README if has_picture else "",
    }
    files = _filled(_TEMPLATE, values)
    files[CONTROLLERS] = _built(name, os.path.abspath(name), files, target="controllers").xml()
    return files


def files_around(
    name: str,
    robot: str,
    values: Mapping[str, str],
    *,
    requirements: Sequence[str] = (f"yamaro>={__version__}",),
    packages: Sequence[str] = (),
) -> dict[str, str]:
    """Return the texts of a package of a robot that exists, without the robot itself.

    Args:
        name: that of the package.
        robot: the name of the robot's file, without `.yaml`.
        values: what else is in the texts: `TITLE`, `LICENSE`, `MASS`, `LINKS`, `JOINTS`, `PICTURE`.
        requirements: what pip installs with it, Yamaro among them.
        packages: the ROS packages that it is read from as well.
    """
    known = {
        "NAME": name,
        "ROBOT": robot,
        "DISTRIBUTION": name.replace("_", "-"),
        "REQUIREMENTS": ", ".join(f'"{each}"' for each in requirements),
        "DEPENDENCIES": "".join(f"  <exec_depend>{each}</exec_depend>\n" for each in packages),
        "YAMARO": __version__,
        **values,
    }
    shared = {path: text for path, text in _filled(_TEMPLATE, known).items() if path[0] == "."}
    return {**shared, **_filled(_AROUND, known)}


def _filled(template: str, values: Mapping[str, str]) -> dict[str, str]:
    files = {}
    for path in _paths(template):
        with open(os.path.join(template, *path.split("/")), encoding="utf-8") as file:
            text = file.read()
        for word, value in values.items():
            text = text.replace(f"@{word}@", value)
        for word in ("NAME", "ROBOT"):
            path = path.replace(word, values[word])
        path = path.replace("dot-", ".")
        files[path.removesuffix(".in")] = text  # with it, tools would take the template for a file
    return files


def stem_of(path: str) -> str:
    """Return the name of a robot's file without `.yaml`."""
    return os.path.splitext(os.path.basename(path))[0]


class OutsideError(Exception):
    """A robot is read from a file that its package would not have."""


def package_of(name: str, path: str, build: Build) -> dict[str, bytes]:
    """Return the files of a package of a robot that exists, by their paths in its folder.

    The folder of the robot's file is `urdf` there, and what is around it stays where it is: a robot
    in `description/robot.yaml` with meshes in `meshes` has them in `meshes`.

    Args:
        name: that of the package.
        path: the robot's file.
        build: what was built of it.

    Raises:
        OutsideError: it is read from a file elsewhere that is not in a ROS package of its own.
        OSError: a file cannot be read.
    """
    here = os.path.dirname(os.path.abspath(path))
    files: dict[str, bytes] = {}
    packages: list[str] = []
    own_package = build.finder.package_around(os.path.abspath(path))
    for each in dict.fromkeys([*build.files, *filter(os.path.isabs, build.meshes)]):
        package = build.finder.package_around(each)
        if package is not None and package != own_package:
            packages.append(package[0])
            continue
        inner = os.path.normpath(os.path.join("urdf", os.path.relpath(each, here)))
        if inner.startswith(os.pardir):
            raise OutsideError(each)
        with open(each, "rb") as file:
            files[inner.replace(os.sep, "/")] = file.read()
    robot, has_picture = build.robot, True
    stem = stem_of(path)
    try:
        check_packages(path)
        request = Request(PICTURE, {}, {})
        files[PICTURE] = draw(build, path, request, Reader(Policy(), readable=[], name=path)).data
    except YamaroError:
        has_picture = False
    values = {
        "TITLE": f"The robot {stem}",
        "LICENSE": "TODO: license",
        "PICTURE": _PICTURE_IN_README if has_picture else "",
        "MASS": f"{robot.mass:.12g}",
        "LINKS": str(len(robot.links)),
        "JOINTS": str(len(robot.free_joints())),
    }
    texts = files_around(name, stem, values, packages=list(dict.fromkeys(packages)))
    return {inner: text.encode() for inner, text in texts.items()} | files


def _built(name: str, folder: str, files: Mapping[str, str], *, target: str) -> Build:
    """Return the build of a package's robot, whose files are in memory, as if in a folder."""
    texts = {os.path.join(folder, *path.split("/")): text for path, text in files.items()}
    path = os.path.join(folder, *main_file(name).split("/"))
    return build(path, loader=MemoryLoader(texts), target=target)


def main_file(name: str) -> str:
    """Return the path of a package's robot."""
    return f"urdf/{name}.yaml"


def _paths(template: str) -> Iterator[str]:
    for folder, inner, names in os.walk(template):
        inner.sort()
        for name in sorted(names):
            yield os.path.relpath(os.path.join(folder, name), template).replace(os.sep, "/")


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
