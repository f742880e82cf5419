"""`yamaro mcp FOLDER`: serves the robots of a folder over the Model Context Protocol."""

from __future__ import annotations

import os

from ...commands.arguments import make_policy, read_packages
from ...commands.command_table import Command
from ...commands.reports import WrongUsage, quote

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...commands.arguments import Arguments
    from ...streams import Streams

COMMAND = Command(
    "mcp",
    ("[FOLDER]",),
    "let programs build, check and draw the robots of a folder",
    "Serve the robots of a folder over the Model Context Protocol, on standard input and output, "
    "to assistants and other programs. Robots are not trusted, and nothing outside of the folder "
    "is read or written. Requires the Python packages of yamaro[mcp].",
    words=(("FOLDER", "where the robots are; the working directory by default"),),
    examples=("yamaro mcp robots", "yamaro mcp robots --allow-path /opt/ros/jazzy/share"),
    counts_words=False,
    place=14,
    options=("jail", "safe", "timeout", "allow-path", "limit", "package"),
    help_of={
        "safe": "allow files only to compute: no Python modules, no loops in `process`; the "
        "default",
        "jail": "allow files all of Python in a process that can read the folder, but cannot write "
        "files or reach the network (Linux only)",
        "allow-path": "allow reading a file or folder outside of FOLDER too",
    },
)


def run(arguments: Arguments, streams: Streams) -> int:
    """Serve until the program at the other end is gone; return the exit status."""
    if len(arguments.words) > 1 or arguments.assignments:
        extra = [*arguments.words[1:], *arguments.assignments][0]
        raise WrongUsage(f"unexpected argument {quote(extra)} after the folder")
    folder = os.path.realpath(arguments.words[0] if arguments.words else ".")
    if not os.path.isdir(folder):
        raise WrongUsage(f"{quote(arguments.words[0])} is not a folder")
    make_policy(arguments, looks=True)  # says what is wrong with an option now, not at each call
    packages = [
        f"{name}:={os.path.abspath(path)}" for name, path in read_packages(arguments).items()
    ]
    allowed = [os.path.abspath(path) for path in arguments.lists.get("allow-path", ())]
    options = ["--jail" if arguments.has("jail") else "--safe", "--within", folder]
    for name, values in (
        (
            "timeout",
            [arguments.options[name] for name in ("timeout",) if name in arguments.options],
        ),
        ("allow-path", allowed),
        ("limit", arguments.lists.get("limit", ())),
        ("package", packages),
    ):
        options += [f"--{name}={value}" for value in values]
    try:
        from .server import serve
    except ModuleNotFoundError as error:
        if error.name is None or error.name.partition(".")[0] not in ("mcp", "mcp_types", "anyio"):
            raise
        raise WrongUsage(
            "'yamaro mcp' needs the Python package mcp, version 2: pip install 'yamaro[mcp]'"
        ) from None
    streams.silence_libraries()
    return serve(folder, options, streams.result_descriptor())
