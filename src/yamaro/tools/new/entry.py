"""`yamaro new NAME`: makes a folder that is a package for pip and for colcon."""

from __future__ import annotations

import os

from ...commands.command_table import Command
from ...commands.reports import DONE, INPUT_ERROR, WrongUsage, quote

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...commands.arguments import Arguments
    from ...streams import Streams

COMMAND = Command(
    "new",
    ("NAME",),
    "make a package of a robot, for pip and colcon",
    "Make a folder with a small robot to start from: a package for pip and for colcon, "
    "with a test, checks in CI, and a README with a picture. The last part of NAME is the "
    "name of the package.",
    words=(("NAME", "the folder to make, such as rover_description; it must not exist"),),
    examples=("yamaro new rover_description", "yamaro new src/rover_description"),
    needs="a NAME",
    place=11,
)

NEXT = """\
{folder}: a robot, as a package for pip and for colcon{picture}

  cd {folder}
  pip install .
  yamaro view {main}
  yamaro test

README.md shows how to start it in RViz, Gazebo and MuJoCo"""
NO_PICTURE = """
the README has no picture yet: pip install 'yamaro[picture]', then
  yamaro picture {main} -o picture.png"""


def run(arguments: Arguments, streams: Streams) -> int:
    """Make the folder; return the exit status."""
    from ...output import write_folder
    from .package import PICTURE, fault_of_name, files_of, main_file, picture_of

    (folder,) = arguments.words
    path = os.path.abspath(folder)
    name = os.path.basename(path) if folder else ""
    if arguments.assignments:
        raise WrongUsage("a new robot has no argument to set; change it in its file")
    fault = fault_of_name(name)
    if fault is not None:
        raise WrongUsage(f"a package cannot be called {quote(name)}: {fault}")
    if os.path.lexists(path):
        raise WrongUsage(f"{quote(folder)} exists; 'yamaro new' makes a new folder")
    picture = picture_of(name, path)
    files = {
        inner: text.encode()
        for inner, text in files_of(name, has_picture=picture is not None).items()
    }
    if picture is not None:
        files[PICTURE] = picture
    try:
        write_folder(path, files)
    except OSError as error:
        streams.say(f"yamaro: error: cannot make {quote(folder)}: {error.strerror or error}")
        return INPUT_ERROR
    main = main_file(name)
    remark = "" if picture is not None else NO_PICTURE.format(main=main)
    streams.say(NEXT.format(folder=folder.rstrip("/\\"), main=main, picture=remark))
    return DONE
