"""`yamaro new NAME`: makes a folder that is a package for pip and for colcon."""

from __future__ import annotations

import os
import re

from ...commands.command_table import Command
from ...commands.reports import DONE, INPUT_ERROR, WrongUsage, quote, show

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...commands.arguments import Arguments
    from ...streams import Streams

COMMAND = Command(
    "new",
    ("NAME", "NAME FILE.yaml"),
    "make a package of a robot, for pip and colcon",
    "Make a folder with a small robot to start from: a package for pip and for colcon, "
    "with a test, checks in CI, and a README with a picture. The last part of NAME is the "
    "name of the package. With a FILE, the package is of that robot: copies of all files that it "
    "is read from, and of its meshes, with a test, checks and a README.",
    words=(
        ("NAME", "the folder to make, such as rover_description; it must not exist"),
        ("FILE.yaml", "a robot in YAML, which is trusted; 'yamaro migrate' makes one of others"),
    ),
    examples=("yamaro new rover_description", "yamaro new src/lamp_description lamp.yaml"),
    needs="a NAME",
    counts_words=False,
    place=11,
)

NEXT = """\
{folder}: a robot, as a package for pip and for colcon{picture}

  cd {folder}
  pip install .
  yamaro view {main}
  yamaro test

README.md shows how to start it in RViz{others}"""
NO_PICTURE = """
the README has no picture yet: pip install 'yamaro[picture]', then
  yamaro picture {main} -o picture.png"""


def run(arguments: Arguments, streams: Streams) -> int:
    """Make the folder; return the exit status."""
    from ...diagnostics import YamaroError
    from ...output import write_folder
    from .package import PICTURE, OutsideError, fault_of_name, main_file

    folder, robot = _words(arguments.words)
    path = os.path.abspath(folder)
    name = os.path.basename(path) if folder else ""
    if arguments.assignments:
        raise WrongUsage("a new robot has no argument to set; change it in its file")
    fault = fault_of_name(name)
    if fault is not None:
        raise WrongUsage(f"a package cannot be called {quote(name)}: {fault}")
    if os.path.lexists(path):
        raise WrongUsage(f"{quote(folder)} exists; 'yamaro new' makes a new folder")
    try:
        files = _files(name, path) if robot is None else _files_of(name, robot, arguments, streams)
        write_folder(path, files)
    except YamaroError as error:
        show(error.diagnostics, arguments, streams)
        return INPUT_ERROR
    except OutsideError as error:
        streams.say(
            f"yamaro: error: {quote(robot or '')} is read from {quote(str(error))}, which its "
            "package would not have\n  move that file beside it, or into a ROS package"
        )
        return INPUT_ERROR
    except OSError as error:
        streams.say(f"yamaro: error: cannot make {quote(folder)}: {error.strerror or error}")
        return INPUT_ERROR
    main = main_file(name) if robot is None else f"urdf/{os.path.basename(robot)}"
    others = ", Gazebo and MuJoCo" if robot is None else ""
    remark = "" if PICTURE in files else NO_PICTURE.format(main=main)
    shown = folder.rstrip("/\\")
    streams.say(NEXT.format(folder=shown, main=main, picture=remark, others=others))
    return DONE


def _words(words: Sequence[str]) -> tuple[str, str | None]:
    """Return the folder to make, and the file of a robot that exists."""
    if not words:
        raise WrongUsage(f"'yamaro new' needs {COMMAND.needs}")
    if len(words) > 2:
        raise WrongUsage(f"unexpected argument {quote(words[2])} after {quote(words[1])}")
    if len(words) == 1:
        return words[0], None
    if os.path.splitext(words[1])[1] not in (".yaml", ".yml"):
        raise WrongUsage(
            f"'yamaro new' takes a robot in YAML, not {quote(words[1])}; 'yamaro migrate' makes one"
        )
    if not re.fullmatch(r"[A-Za-z0-9_][A-Za-z0-9_.-]*", os.path.basename(words[1])):
        raise WrongUsage(
            f"{quote(words[1])} cannot be in a package: its name has more than letters, digits, "
            "'_', '.' and '-'"
        )
    return words[0], words[1]


def _files(name: str, path: str) -> dict[str, bytes]:
    """Return the files of a package with a small robot."""
    from .package import PICTURE, files_of, picture_of

    picture = picture_of(name, path)
    texts = files_of(name, has_picture=picture is not None)
    files = {inner: text.encode() for inner, text in texts.items()}
    return files if picture is None else {**files, PICTURE: picture}


def _files_of(name: str, path: str, arguments: Arguments, streams: Streams) -> dict[str, bytes]:
    """Return the files of a package of a robot that exists."""
    from ...api import build
    from ...options import UsageError
    from .package import package_of

    try:
        built = build(path)
    except UsageError as error:
        raise WrongUsage(str(error)) from None
    if built.root_name != "robot":
        raise WrongUsage(f"{quote(path)} is not a robot, but a <{built.root_name}>")
    show(built.warnings, arguments, streams)
    return package_of(name, path, built)
