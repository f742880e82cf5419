"""The commands and their options, as tables.

Parsing, the help of each command and the completion of shells are made from them. To add an option,
add an `Option` to `OPTIONS`, and read it with `arguments.has(…)`, `.options` or `.lists` where it
has an effect.
"""

from __future__ import annotations

BUILD = "build"
"""The command that has no name on the command line: `yamaro FILE`."""

FILE_WORDS = (
    ("FILE", "a YAML file, a URDF (.urdf, .xml) or a xacro file (.xacro); - for YAML from a pipe"),
    (
        "name:=value",
        "set a variable, n:=3, sides:=[left, right], or an argument of xacro",
    ),
)
ADDRESS_WORD = ("ADDRESS", "elbow_joint/limit@upper, link:arm/visual[2], /gazebo[3] from the root")
ENDINGS = ("yaml", "yml", "urdf", "xacro")


class Command:
    """A command.

    Attributes:
        name: the word on the command line.
        forms: what may follow it, a usage line for each.
        summary: what it does, on a short line.
        about: what it does, as the head of its help.
        words: what the words of `forms` mean.
        looks: whether it only looks at a file, which is not trusted then by default.
        endings: of the files that are completed, without the dot.
        examples: command lines.
    """

    __slots__ = ("about", "endings", "examples", "forms", "looks", "name", "summary", "words")

    def __init__(
        self,
        name: str,
        forms: tuple[str, ...],
        summary: str,
        about: str,
        *,
        words: tuple[tuple[str, str], ...] = (),
        looks: bool = False,
        endings: tuple[str, ...] = (),
        examples: tuple[str, ...] = (),
    ) -> None:
        """Describe a command."""
        self.name = name
        self.forms = forms
        self.summary = summary
        self.about = about
        self.words = words
        self.looks = looks
        self.endings = endings
        self.examples = examples


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


COMMANDS = {
    command.name: command
    for command in (
        Command(
            BUILD,
            ("FILE [name:=value ...]",),
            "compile a robot",
            "Compile a robot description, in YAML or xacro, to URDF or any other XML.",
            words=FILE_WORDS,
            endings=ENDINGS,
            examples=(
                "yamaro robot.yaml > robot.urdf",
                "yamaro robot.yaml -o build/robot.urdf legs:=6 body_mass:=2.5",
                "yamaro robot.urdf.xacro -o robot.urdf use_sim:=true",
                "yamaro check robot.yaml && yamaro tree robot.yaml",
                "generate_robot | yamaro -",
            ),
        ),
        Command(
            "check",
            ("FILE [name:=value ...]",),
            "check a robot for errors and likely mistakes",
            "Report errors, warnings and likely mistakes, without writing XML. Exit with 1 if "
            "there are any findings.",
            words=FILE_WORDS,
            looks=True,
            endings=ENDINGS,
        ),
        Command(
            "tree",
            ("FILE [name:=value ...]",),
            "show links, joints and masses as a tree",
            "Show the links of a robot as a tree, with their masses and joints.",
            words=FILE_WORDS,
            looks=True,
            endings=ENDINGS,
        ),
        Command(
            "view",
            ("FILE [name:=value ...]",),
            "show the robot in the browser, updated at each save",
            "Show a robot in the browser, and update it whenever one of its files is saved. "
            "Press Ctrl-C to stop.",
            words=FILE_WORDS,
            looks=True,
            endings=ENDINGS,
        ),
        Command(
            "watch",
            ("FILE -o FILE [name:=value ...]",),
            "compile at each save, and report each build",
            "Compile a file now and whenever one of its input files is saved. Press Ctrl-C to "
            "stop.",
            words=FILE_WORDS,
            endings=ENDINGS,
            examples=("yamaro watch robot.yaml -o robot.urdf",),
        ),
        Command(
            "picture",
            ("FILE -o FILE.png [name:=value ...]",),
            "render the robot as a PNG, GIF or MP4",
            "Render an image or a film of a robot. Requires the Python packages of "
            "yamaro[picture], but no display or browser.",
            words=FILE_WORDS,
            looks=True,
            endings=ENDINGS,
            examples=(
                "yamaro picture robot.yaml -o robot.png",
                "yamaro picture robot.yaml -o sheet.png --view iso,front,left,top --size 400x300",
                "yamaro picture robot.urdf -o waving.gif --sweep shoulder,elbow",
            ),
        ),
        Command(
            "migrate",
            ("FILE [-o FILE]", "FILE -o FOLDER [name:=value ...]"),
            "convert URDF, xacro or other XML to YAML",
            "Convert a URDF, or other XML, to a YAML file; convert a xacro robot to a folder of "
            "YAML files, one for each xacro file. Then build the result, and report any "
            "difference.",
            words=(
                ("FILE", "the XML file, or - for standard input"),
                ("name:=value", "set a xacro argument for the comparison"),
            ),
            looks=True,
            endings=("urdf", "xacro", "xml"),
        ),
        Command(
            "args",
            ("FILE",),
            "list the arguments of a file without running it",
            "List what can be passed to a file as name:=value, with defaults, types and ranges, "
            "without running the file: its arguments, or else its variables, or those of xacro.",
            words=(FILE_WORDS[0],),
            looks=True,
            endings=ENDINGS,
        ),
        Command(
            "why",
            ("FILE ADDRESS [name:=value ...]",),
            "show where a value in the output comes from",
            "Show where in the YAML an element or attribute of the output comes from.",
            words=(
                FILE_WORDS[0],
                (
                    "ADDRESS",
                    "elbow_joint/limit@upper, link:arm/visual[2], /gazebo[3] from the root",
                ),
                FILE_WORDS[1],
            ),
            looks=True,
            endings=ENDINGS,
            examples=("yamaro why robot.yaml elbow_joint/limit@upper",),
        ),
        Command(
            "completion",
            ("bash|zsh|fish",),
            "print a completion script for a shell",
            "Print a script that lets a shell complete commands, options, files and variables.",
            examples=('eval "$(yamaro completion bash)"',),
        ),
        Command(
            "help",
            ("[COMMAND]",),
            "show the options of a command",
            "Show what a command does, and its options.",
        ),
    )
}

ALL = tuple(COMMANDS)
BUILDING = ("build", "check", "tree", "view", "watch", "picture", "why")
"""The commands that build a file of the user's."""
WORKING = (*BUILDING, "migrate")
"""The commands that run a file."""
READING = (*WORKING, "args")
"""The commands that read a file."""
PICTURE = ("picture",)
VIEW = ("view",)

OPTIONS = {
    option.name: option
    for option in (
        Option(
            "output",
            "write to FILE instead of standard output; after an error, FILE is not changed",
            ("build", "watch", "picture", "migrate"),
            short="o",
            value="FILE",
            wants="a file name",
            completes="files",
            help_in={
                "picture": ".png or .jpg; .gif or .mp4 for a film; - for a PNG on standard output",
                "migrate": "write to FILE instead of standard output; a xacro robot of several "
                "files needs a folder",
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
            ("args", "why"),
            help_in={"why": "write the answer as JSON"},
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
            "meshes",
            "how the XML refers to existing meshes and textures: relative to the output (the "
            "default), keep the paths as written, absolute, copy them to assets/ beside the "
            "output, package://NAME; none omits meshes",
            ("build", "watch"),
            value="HOW",
            wants="relative, keep, absolute, copy, package://NAME or none",
            completes="relative keep absolute copy package:// none",
        ),
        Option("gazebo", "also write sensors and surfaces of collisions for Gazebo", ("build",)),
        Option(
            "port",
            "serve the page at that port; by default at any free port",
            VIEW,
            value="N",
            wants="a number from 0 to 65535",
        ),
        Option("no-browser", "do not open a browser, only print the address of the page", VIEW),
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
            "joints",
            "positions of joints, in radians or metres",
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
        Option(
            "quiet",
            "show errors only: no warnings and no output of 'print'",
            READING,
            short="q",
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
            WORKING,
            value="SECONDS",
            wants="a number of seconds",
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
            READING,
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
            READING,
            value="WHEN",
            wants="auto, always or never",
            choices=("auto", "always", "never"),
        ),
        Option("help", "show this help", ALL, short="h"),
        Option("version", "show the version", ALL, short="V"),
    )
}

SPELLINGS = {spelling: option for option in OPTIONS.values() for spelling in option.spellings}
"""The options by what is written on the command line: `-o` and `--output`."""


def named_commands() -> list[str]:
    """Return the commands that have a word of their own."""
    return [name for name in COMMANDS if name != BUILD]


def options_of(command: str) -> list[Option]:
    """Return the options of a command, in the order of the table."""
    return [option for option in OPTIONS.values() if command in option.commands]
