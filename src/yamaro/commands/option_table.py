"""The table of options, and the help that is made of it.

To add an option, add an `Option` here, and read it with `arguments.has(…)`, `.options` or `.lists`
where it has an effect.
"""

from __future__ import annotations

from .command_table import BUILD, COMMANDS, named_commands
from .reports import WrongUsage, deliver, near, quote

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..streams import Streams
    from .arguments import Arguments
    from .command_table import Command


class Option:
    """An option.

    Attributes:
        name: the long form, without the dashes.
        short: the letter of its short form, or "".
        value: what is written after it, as the help shows it; "" for an option without a value.
        wants: what the value is, for messages.
        help: what it does; up to the first `;`, `:` or `(` also for shells.
        help_in: what it does in commands where that is something else.
        commands: the names of the commands that take it.
        is_repeatable: whether it may be given several times; `Arguments.lists` holds the values.
        choices: the values it can have; any if empty.
        completes: what a shell offers for the value: "files", "commands", or words with spaces in
            between; "limits", "views", "shown" and "codes" mean the words of those tables.
        excludes: names of the options that may not be given with it.
    """

    __slots__ = (
        "choices", "commands", "completes", "excludes", "help", "help_in", "is_repeatable", "name",
        "short", "value", "wants",
    )  # fmt: skip

    def __init__(
        self,
        name: str,
        help: str,
        commands: tuple[str, ...],
        *,
        short: str = "",
        value: str = "",
        wants: str = "",
        is_repeatable: bool = False,
        choices: tuple[str, ...] = (),
        completes: str = "",
        excludes: tuple[str, ...] = (),
        help_in: dict[str, str] | None = None,
    ) -> None:
        """Describe an option."""
        self.name = name
        self.short = short
        self.value = value
        self.wants = wants
        self.help = help
        self.commands = commands
        self.is_repeatable = is_repeatable
        self.choices = choices
        self.completes = completes or " ".join(choices)
        self.excludes = excludes
        self.help_in = help_in or {}

    @property
    def spellings(self) -> tuple[str, ...]:
        """Return how it is written on the command line, the short form first."""
        return (f"-{self.short}", f"--{self.name}") if self.short else (f"--{self.name}",)


# --- options that only `yamaro sweep` takes ---------------------------------------------------


SWEEP = ("sweep",)

SWEEP_OPTIONS = (
    Option("samples", "how many variants; a grid knows", SWEEP, value="N", wants="a whole number"),
    Option(
        "method",
        "how variants are chosen: latin (with --samples), grid (the default without), random "
        "or sobol",
        SWEEP,
        value="METHOD",
        wants="grid, random, latin or sobol",
        choices=("grid", "random", "latin", "sobol"),
    ),
    Option("seed", "seed of what is random; 0 by default", SWEEP, value="N", wants="a number"),
    Option(
        "keep",
        "reject variants that do not meet this condition, such as 'thigh + shank < 0.7'",
        SWEEP,
        value="CONDITION",
        wants="a Python expression",
        is_repeatable=True,
    ),
    Option(
        "metrics",
        "measure this of each variant, such as mass,reach or 'stable(5)'",
        SWEEP,
        value="NAMES",
        wants="names of metrics",
        is_repeatable=True,
    ),
    Option(
        "evaluate",
        "evaluate each variant with a Python function of yours",
        SWEEP,
        value="FILE.py:FUNCTION",
        wants="FILE.py:FUNCTION",
    ),
    Option("models", "keep the documents too, in tar files", SWEEP),
    Option(
        "engine",
        "where variants are built: local:8 (processes; the default, with all processors), "
        "dask://HOST:PORT, dask:8 (a cluster on this machine), ray://HOST:PORT or ray:8",
        SWEEP,
        value="ENGINE",
        wants="local:N, dask://HOST:PORT, dask:N, ray://HOST:PORT or ray:N",
        completes="local: dask:// dask: ray:// ray:",
    ),
    Option(
        "x",
        "with 'plot', the columns along x; by default the arguments that vary",
        SWEEP,
        value="COLUMNS",
        wants="names of columns",
        is_repeatable=True,
    ),
    Option(
        "y",
        "with 'plot', the columns along y; by default the results",
        SWEEP,
        value="COLUMNS",
        wants="names of columns",
        is_repeatable=True,
    ),
    Option(
        "metric",
        "with 'plot', colour the variants by this column, and draw the best, the median and "
        "the worst",
        SWEEP,
        value="COLUMN",
        wants="the name of a column",
    ),
    Option("minimize", "with 'plot', the variant with the least '--metric' is the best", SWEEP),
    Option("resume", "go on with the sweep in the folder, which was stopped", SWEEP),
)


# --- all options ------------------------------------------------------------------------------


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


# --- `yamaro help`, `yamaro COMMAND --help` ---------------------------------------------------


COLUMNS = 100
MARGIN = 24
"""Columns before what is said of an option."""
STATUS = "exit status: 0 success, 1 errors in the input or the output, 2 wrong usage"


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the help of the command that is named; return the exit status."""
    topics = arguments.words or [BUILD]
    if topics[0] not in COMMANDS:
        hint = (
            near(topics[0], named_commands()) or f"; the commands are {', '.join(named_commands())}"
        )
        raise WrongUsage(f"unknown command {quote(topics[0])}{hint}")
    if len(topics) > 1:
        raise WrongUsage(f"unexpected argument {quote(topics[1])} after {quote(topics[0])}")
    return deliver([help_of(topics[0])], arguments, streams)


def help_of(name: str) -> str:
    """Return the help of a command; that of `yamaro FILE` also lists the others."""
    command = COMMANDS[name]
    blocks = [_usage(command), _wrapped(command.about, 0)]
    if command.words:
        blocks.append([line for word, text in command.words for line in _row(word, text)])
    options = [line for option in options_of(name) for line in _option(option, command)]
    blocks.append(["options, in any order:", *options])
    if name == BUILD:
        others = [(other, COMMANDS[other].summary) for other in named_commands()]
        rows = [line for other, summary in others for line in _row(f"yamaro {other}", summary)]
        blocks.append(["other commands; see 'yamaro COMMAND --help':", *rows])
    if command.examples:
        blocks.append(["examples:", *(f"  {example}" for example in command.examples)])
    if name == BUILD:
        blocks.append([STATUS])
    return "\n\n".join("\n".join(block) for block in blocks) + "\n"


def _usage(command: Command) -> list[str]:
    name = "yamaro" if command.name == BUILD else f"yamaro {command.name}"
    lines = [f"{name} [options] {form}" for form in command.forms]
    if command.name in ("completion", "help", "lsp", "new"):  # their only options are those of all
        lines = [f"{name} {form}" for form in command.forms]
    return [("usage: " if number == 0 else "       ") + line for number, line in enumerate(lines)]


def _option(option: Option, command: Command) -> list[str]:
    text = option.help_in.get(command.name, option.help)
    if option.is_repeatable:
        text += "; may be repeated"
    if option.name == "safe" and command.looks:
        text += "; the default, with the jail for files that safe mode rejects"
    if option.name == "trust" and not command.looks:
        text += "; the default"
    head = f"-{option.short}, " if option.short else "    "
    head += f"--{option.name}" + (f" {option.value}" if option.value else "")
    return _row(head, text)


def _row(head: str, text: str) -> list[str]:
    """Return what is said of a word, to the right of it or, if it is long, below."""
    lines = _wrapped(text, MARGIN)
    if len(head) + 3 > MARGIN:
        return [f"  {head}", *lines]
    return [f"  {head} ".ljust(MARGIN) + lines[0].lstrip(), *lines[1:]]


def _wrapped(text: str, margin: int) -> list[str]:
    """Return text in lines that fit; `textwrap` would import `re`."""
    lines = [""]
    for word in text.split(" "):
        if len(lines[-1]) + 1 + len(word) > COLUMNS - margin:
            lines.append("")
        lines[-1] += f" {word}" if lines[-1] else word
    return [" " * margin + line for line in lines]
