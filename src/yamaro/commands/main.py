"""The command: reads its arguments, runs the command asked for, and gives its exit status.

Everything a plain conversion does not need is imported where it is used: start-up time is most of
what a conversion takes.
"""

from __future__ import annotations

import os
import sys

from ..streams import ProcessStreams, Streams
from .arguments import parse_arguments
from .conversion import ProgramEnded
from .reports import (
    INPUT_ERROR,
    INTERRUPTED,
    PIPE_CLOSED,
    WrongUsage,
    deliver,
    report_fault,
    report_usage,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from .arguments import Arguments

    Run = Callable[[Arguments, Streams], int]


OWN_FILES = 2
"""Descriptors that the command opens itself: duplicates of standard streams."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command and return its exit status.

    Args:
        argv: the arguments without the program's name. None takes those of the process, and
            treats the process as the command's own: its standard output is then kept apart from
            user code at the level of file descriptors, and for good.
    """
    if argv is not None:
        return _run_safely(argv, Streams)
    _leave_out_working_directory()
    import gc

    from ..sandbox.process import RareCollection

    with RareCollection():  # here and not only in `build`, for what is imported before
        status = _run_safely(sys.argv[1:], ProcessStreams)
        gc.freeze()  # all goes with the process: nothing in it need be looked through or freed
    return status


def _leave_out_working_directory() -> None:
    """Import nothing from the working directory because of an empty entry in PYTHONPATH.

    A script that sets up a shell often leaves one at the end, and a folder of unknown origin may
    hold a `json.py`.
    """
    folders = os.environ.get("PYTHONPATH", "").split(os.pathsep)
    if len(folders) < 2 or "" not in folders:
        return
    try:
        here = os.getcwd()
    except OSError:  # the folder is gone
        return
    if not {here, os.curdir} & set(folders):
        sys.path[:] = [path for path in sys.path if path not in ("", here)]


def run_script() -> int:
    """Run the command as all that the process does, and end that; the script `yamaro` calls this.

    Returns:
        The exit status, if something waits for the usual end of a process.
    """
    open_before = _open_descriptors()
    status = main()
    if _nothing_waits_for_the_end(open_before):
        os._exit(status)
    return status


def _open_descriptors() -> set[str]:
    """Return the descriptors of open files, among them the one of the list; empty if unknown."""
    try:
        return set(os.listdir("/proc/self/fd"))
    except OSError:
        return set()


def _nothing_waits_for_the_end(open_before: set[str]) -> bool:
    """Return whether the process may end here, which saves a small build a twentieth of its time.

    That is so if the script was not run by a program that goes on, such as a profiler, nothing is
    registered for the end of the process, no thread may have to be waited for, and no file is open
    that something written may still have to go to.
    """
    if sys._getframe(2).f_back is not None:
        return False
    if not sys.modules.keys().isdisjoint(("atexit", "threading")) or sys.flags.interactive:
        return False
    if sys.gettrace() is not None or sys.getprofile() is not None:
        return False
    if not open_before or len(_open_descriptors() - open_before) > OWN_FILES:
        return False
    try:
        for stream in (sys.__stdout__, sys.__stderr__):
            if stream is not None:
                stream.flush()
    except (OSError, ValueError):
        return False
    return True


def _run_safely(argv: Sequence[str], stream_class: type[Streams]) -> int:
    """Run the command and return its exit status, whatever is raised."""
    streams: Streams | None = None
    command = next((word for word in argv if not word.startswith("-")), "")
    try:
        arguments = parse_arguments(argv)
        command = arguments.command
        streams = stream_class(quiet=arguments.has("quiet"))
        streams.divert()
        if arguments.has("version"):
            from .. import __version__

            return deliver([f"yamaro {__version__}\n"], arguments, streams)
        if arguments.has("help"):
            from .option_table import help_of

            return deliver([help_of(arguments.command)], arguments, streams)
        return _command(arguments.command)(arguments, streams)
    except WrongUsage as error:
        return report_usage(str(error), command, streams)
    except ProgramEnded as error:
        (streams or Streams(quiet=False)).say(f"yamaro: error: {error}")
        return INPUT_ERROR
    except BrokenPipeError:
        return PIPE_CLOSED
    except KeyboardInterrupt:
        return INTERRUPTED
    except MemoryError:
        (streams or Streams(quiet=False)).say("yamaro: error: out of memory")
        return INPUT_ERROR
    except Exception as error:
        return report_fault(error, streams or Streams(quiet=False))
    finally:
        if streams is not None:
            streams.restore()


def _command(name: str) -> Run:
    """Return what runs a command; its module is imported for that, and no other."""
    if name == "build":
        from .build import run
    elif name == "check":
        from .check import run
    elif name == "args":
        from .args import run
    elif name == "completion":
        from .shells import run
    elif name == "help":
        from .option_table import run
    else:
        from .command_table import entry_of

        run = entry_of(name).run
    return run
