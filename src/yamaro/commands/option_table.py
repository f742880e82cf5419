"""The table of options.

To add an option, add an `Option` here, and read it with `arguments.has(…)`, `.options` or `.lists`
where it has an effect.
"""

from __future__ import annotations

from .command_table import COMMANDS
from .option import Option
from .sweep_options import SWEEP_OPTIONS

ALL = tuple(COMMANDS)
BUILDING = ("build", "check", "tree", "view", "watch", "picture", "why", "sweep")
"""The commands that build one file of the user's, and show its messages."""
WORKING = (*BUILDING, "migrate", "diff", "test")
"""The commands that run a file."""
READING = (*WORKING, "args")
"""The commands that read a file."""
WRITING = ("build", "check", "view", "watch")
"""The commands that write output formats, or say what these lose."""
PICTURE = ("picture",)
VIEW = ("view",)
DIFF = ("diff",)
TEST = ("test",)

OPTIONS = {
    option.name: option
    for option in (
        Option(
            "output",
            "write to FILE instead of standard output, or into a folder: out/; after an error, "
            "nothing is changed",
            ("build", "check", "watch", "picture", "migrate", "sweep"),
            short="o",
            value="FILE",
            wants="a file name",
            completes="files",
            help_in={
                "check": "write the report to FILE, and the messages to standard error as usual; "
                "needs --format json, sarif, github or junit",
                "picture": ".png or .jpg; .gif or .mp4 for a film; - for a PNG on standard output",
                "watch": "the file to write, or a folder: out/",
                "migrate": "write to FILE instead of standard output; a xacro robot of several "
                "files needs a folder",
                "sweep": "the folder of the sweep: runs/; with 'show' and 'plot', a file",
            },
        ),
        Option("force", "replace existing files", ("migrate",)),
        Option(
            "exact",
            "keep details without meaning, such as which origins are omitted, instead of writing "
            "the shorter form",
            ("migrate",),
        ),
        Option(
            "with",
            "also migrate the files of that package; by default only the files of the robot's own "
            "package and the files they depend on are migrated",
            ("migrate",),
            value="PACKAGE",
            wants="the name of a package",
            is_repeatable=True,
            excludes=("all",),
        ),
        Option("all", "migrate the files of all packages", ("migrate",), excludes=("with",)),
        Option(
            "json",
            "write a JSON Schema (2020-12) of the arguments",
            ("args", "why", "diff", "test"),
            help_in={
                "why": "write the answer as JSON",
                "diff": "write the changes as JSON",
                "test": "write the results as JSON",
            },
        ),
        Option(
            "format",
            "how to report: text (the default), json, sarif, github (annotations) or junit",
            ("check",),
            value="FORM",
            wants="text, json, sarif, github or junit",
            choices=("text", "json", "sarif", "github", "junit"),
        ),
        Option(
            "fix",
            "apply the fixes that are safe to the files, all or none, and check again",
            ("check",),
        ),
        Option("check", "change no file; exit with 1 if one is not formatted", ("fmt",)),
        Option(
            "diff", "change no file; show what would change, and exit with 1 if anything", ("fmt",)
        ),
        Option(
            "help-args",
            "list the arguments of the file and exit, as 'yamaro args' does",
            ("build",),
            excludes=("deps",),
        ),
        Option(
            "deps",
            "list the files read and the meshes used, one per line, instead of writing the XML",
            ("build",),
        ),
        Option(
            "depfile",
            "also write to FILE which files the output depends on, for make, Ninja and CMake",
            ("build",),
            value="FILE",
            wants="a file name",
            completes="files",
            excludes=("deps", "help-args"),
        ),
        Option(
            "meshes",
            "how the XML refers to existing meshes and textures: relative to the output (the "
            "default), keep the paths as written, absolute, copy them to assets/ beside the "
            "output, package://NAME, package:// for the package that each is in; none omits meshes",
            ("build", "watch"),
            value="HOW",
            wants="relative, keep, absolute, copy, package://NAME, package:// or none",
            completes="relative keep absolute copy package:// none",
        ),
        Option(
            "to",
            "write these output formats: urdf, sdf, mjcf, srdf, usd, separated by commas; several "
            "need a folder: -o FOLDER/",
            ("build", "check", "watch", "why", "sweep"),
            value="FORMATS",
            wants="urdf, sdf, mjcf, srdf or usd",
            is_repeatable=True,
            completes="urdf sdf mjcf srdf usd",
            help_in={
                "check": "also report what these output formats cannot hold: urdf, sdf, ...",
                "why": "look ADDRESS up in the document of that output format",
                "sweep": "build these output formats: urdf, sdf, mjcf, srdf, usd, separated by "
                "commas",
            },
        ),
        Option(
            "base",
            "fix the root of the robot in the world, or let it move freely; by default as the "
            "robot says",
            (*WRITING, "sweep"),
            value="HOW",
            wants="fixed or free",
            choices=("fixed", "free"),
            help_in={"view": "the same for downloads: fix the root, or let it move freely"},
        ),
        Option(
            "repair-inertia",
            "balance inertia that no body can have, instead of refusing it",
            (*WRITING, "sweep"),
            help_in={"view": "balance inertia that no body can have in downloads"},
        ),
        Option(
            "sdf-version",
            "version of SDF: 1.11 (the default), 1.9 or 1.12",
            (*WRITING, "sweep"),
            value="VERSION",
            wants="1.11, 1.9 or 1.12",
            choices=("1.11", "1.9", "1.12"),
            help_in={"view": "version of SDF in downloads: 1.11 (the default), 1.9 or 1.12"},
        ),
        Option(
            "gazebo",
            "also write sensors and surfaces of collisions for Gazebo",
            ("build", "watch"),
        ),
        Option(
            "a",
            "set a variable of the first file only",
            DIFF,
            value="name:=value",
            wants="name:=value",
            is_repeatable=True,
        ),
        Option(
            "b",
            "set a variable of the second file only",
            DIFF,
            value="name:=value",
            wants="name:=value",
            is_repeatable=True,
        ),
        Option(
            "tolerance",
            "how far numbers may differ, as a part of the larger one; 1e-9 by default",
            DIFF,
            value="N",
            wants="a number",
        ),
        Option("accept", "write the golden files that differ or are missing", TEST),
        Option(
            "only",
            "run only the cases with that text in 'FILE: NAME'",
            TEST,
            short="k",
            value="TEXT",
            wants="a text",
        ),
        Option(
            "junit",
            "also write the results to FILE in the format of JUnit",
            TEST,
            value="FILE",
            wants="a file name",
            completes="files",
        ),
        Option("stat", "only write how much changed", DIFF, excludes=("json",)),
        Option("exit-zero", "exit with 0 for robots that differ too", DIFF),
        Option(
            "git",
            "take the seven words that git gives a diff driver, in place of A and B",
            DIFF,
        ),
        Option(
            "port",
            "serve the page at that port; by default at any free port",
            VIEW,
            value="N",
            wants="a number from 0 to 65535",
        ),
        Option("no-browser", "do not open a browser, only print the address of the page", VIEW),
        Option("embed", "let editors show the page in a frame; their extensions pass it", VIEW),
        Option(
            "editor",
            "open files with that command: 'code -g {file}:{line}:{column}'; by default with "
            "VISUAL or EDITOR, if it opens a window",
            VIEW,
            value="COMMAND",
            wants="a command",
            completes="commands",
        ),
        Option(
            "size",
            "width and height of each view, in pixels; 800x600 by default",
            PICTURE,
            value="800x600",
            wants="WIDTHxHEIGHT",
        ),
        Option(
            "view",
            "viewing direction: iso (the default), front, back, left, right, top, bottom, or "
            "azimuth and elevation of the camera in degrees: 30,20; several are combined in one "
            "image",
            PICTURE,
            value="VIEW",
            wants="the name of a view, or azimuth,elevation",
            is_repeatable=True,
            completes="views",
        ),
        Option(
            "state",
            "named state in which the robot is shown; home by default, if it has one, or else "
            "zero: all joints at 0",
            PICTURE,
            value="NAME",
            wants="the name of a state",
        ),
        Option(
            "joints",
            "positions of joints, by their names or those of their parts, in radians, metres or "
            "another unit: elbow=45deg; on top of the state",
            PICTURE,
            value="NAME=POSITION,...",
            wants="NAME=POSITION",
            is_repeatable=True,
        ),
        Option(
            "show",
            "what to show: visual (the default), collision, inertia, frames, grid; separate "
            "several with commas",
            PICTURE,
            value="WHAT",
            wants="visual, collision, inertia, frames or grid",
            is_repeatable=True,
            completes="shown",
        ),
        Option(
            "transparent",
            "make the background transparent, except for the robot's shadow; .png and .gif",
            PICTURE,
        ),
        Option("turn", "make a film in which the camera circles the robot", PICTURE),
        Option(
            "sweep",
            "make a film in which joints move through their limits; names separated by commas, "
            "'all' for all at once, or 'each' for one after the other",
            PICTURE,
            value="JOINTS",
            wants="names of joints, all or each",
            completes="all each",
        ),
        Option("seconds", "length of a film", PICTURE, value="N", wants="a number of seconds"),
        Option(
            "frames-per-second",
            "frame rate of a film; 20 for a .gif and 25 for an .mp4 by default",
            PICTURE,
            value="N",
            wants="a number",
        ),
        *SWEEP_OPTIONS,
        Option(
            "quiet",
            "show errors only: no warnings and no output of 'print'",
            (*READING, "fmt"),
            short="q",
            help_in={"fmt": "do not name the files", "sweep": "show errors only: no summary"},
        ),
        Option(
            "verbose",
            "show each place of what an output format cannot hold, instead of a line for a kind",
            ("build", "check", "watch", "why"),
            short="v",
            excludes=("quiet",),
        ),
        Option("strict", "treat warnings as errors", BUILDING),
        Option(
            "allow",
            "treat messages with that code as warnings, also with --strict: unknown-material",
            BUILDING,
            value="CODE",
            wants="the code of a message",
            is_repeatable=True,
            completes="codes",
            help_in={
                "check": "show messages with that code, but do not fail because of them: "
                "zero-limit; a comment in the file, '# yamaro: allow zero-limit', accepts the "
                "findings of a line, or at the head of the file all, and hides them"
            },
        ),
        Option(
            "deny",
            "treat messages with that code as errors; also advice of 'yamaro check'",
            BUILDING,
            value="CODE",
            wants="the code of a message",
            is_repeatable=True,
            completes="codes",
        ),
        Option(
            "trust",
            "allow the file to do anything that Python can",
            READING,
            excludes=("jail", "safe"),
            help_in={"args": "read includes of xacro files from anywhere"},
        ),
        Option(
            "jail",
            "allow the file all of Python in a process that can read its folder and packages, but "
            "cannot write files or reach the network (Linux only)",
            WORKING,
            excludes=("trust", "safe"),
        ),
        Option(
            "safe",
            "allow the file only to compute: no Python modules, no loops in `process`",
            WORKING,
            excludes=("trust", "jail"),
        ),
        Option(
            "timeout",
            "stop after that time; with --jail and --safe, 60 by default",
            READING,
            value="SECONDS",
            wants="a number of seconds",
            help_in={"sweep": "end a variant that takes longer; 60 by default"},
        ),
        Option(
            "allow-path",
            "allow reading a file or folder with --jail and --safe",
            READING,
            value="PATH",
            wants="a file or folder",
            is_repeatable=True,
            completes="files",
        ),
        Option(
            "limit",
            "change a limit, such as turns=5000000",
            (*READING, "fmt"),
            value="NAME=N",
            wants="NAME=NUMBER",
            is_repeatable=True,
            completes="limits",
        ),
        Option(
            "package",
            "set the folder of a ROS package",
            READING,
            value="NAME:=FOLDER",
            wants="NAME:=FOLDER",
            is_repeatable=True,
        ),
        Option(
            "color",
            "colour messages: auto (the default), always or never",
            (*READING, "fmt"),
            value="WHEN",
            wants="auto, always or never",
            choices=("auto", "always", "never"),
        ),
        Option("stdio", "use standard input and output, as by default; editors pass it", ("lsp",)),
        Option("help", "show this help", ALL, short="h"),
        Option("version", "show the version", ALL, short="V"),
    )
}

SPELLINGS = {spelling: option for option in OPTIONS.values() for spelling in option.spellings}
"""The options by what is written on the command line: `-o` and `--output`."""


def options_of(command: str) -> list[Option]:
    """Return the options of a command, in the order of the table."""
    return [option for option in OPTIONS.values() if command in option.commands]
