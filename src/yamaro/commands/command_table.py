"""The table of commands.

To add a command, add a `Command` here and a module of its name with a function `run`.
"""

from __future__ import annotations


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
        takes_several: whether any number of files may follow.
    """

    __slots__ = (
        "about", "endings", "examples", "forms", "looks", "name", "summary", "takes_several",
        "words",
    )  # fmt: skip

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
        takes_several: bool = False,
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
        self.takes_several = takes_several


BUILD = "build"
"""The command that has no name on the command line: `yamaro FILE`."""

FILE_WORDS = (
    ("FILE", "a YAML file, a URDF (.urdf, .xml) or a xacro file (.xacro); - for YAML from a pipe"),
    (
        "name:=value",
        "set a variable, n:=3, sides:=[left, right], or an argument of xacro",
    ),
)
AXIS_HELP = (
    "thigh=0.2..0.4, thigh=0.2..0.4:0.05 in steps, legs=4,6, kp=log:10..500, gain=normal:1,0.05; "
    "by default all arguments with a range or choices"
)
ADDRESS_WORD = ("ADDRESS", "elbow_joint/limit@upper, link:arm/visual[2], /gazebo[3] from the root")
ENDINGS = ("yaml", "yml", "urdf", "xacro")

COMMANDS = {
    command.name: command
    for command in (
        Command(
            BUILD,
            ("FILE [name:=value ...]",),
            "compile a robot",
            "Compile a robot description, in YAML, URDF or xacro, to URDF or any other XML, or to "
            "the formats of simulators.",
            words=FILE_WORDS,
            endings=ENDINGS,
            examples=(
                "yamaro robot.yaml > robot.urdf",
                "yamaro robot.yaml -o build/robot.urdf legs:=6 body_mass:=2.5",
                "yamaro robot.urdf.xacro -o robot.urdf use_sim:=true",
                "yamaro robot.yaml --to mjcf -o robot.xml",
                "yamaro robot.urdf --to urdf,sdf,mjcf -o out/",
                "yamaro check robot.yaml && yamaro tree robot.yaml",
                "generate_robot | yamaro -",
            ),
        ),
        Command(
            "check",
            ("FILE... [name:=value ...]",),
            "check robots for errors and likely mistakes",
            "Report errors, warnings and likely mistakes, without writing XML. Exit with 1 if "
            "there are any findings.",
            words=FILE_WORDS,
            looks=True,
            endings=ENDINGS,
            examples=(
                "yamaro check robot.yaml",
                "yamaro check --fix robot.yaml leg.yaml",
                "yamaro check --format sarif -o yamaro.sarif *.urdf.yaml",
            ),
            takes_several=True,
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
            words=(FILE_WORDS[0], ADDRESS_WORD, FILE_WORDS[1]),
            looks=True,
            endings=ENDINGS,
            examples=("yamaro why robot.yaml elbow_joint/limit@upper",),
        ),
        Command(
            "diff",
            ("A B [name:=value ...]",),
            "show what changed from one robot to another, by meaning",
            "Compare two robots by meaning: links, joints, masses, limits, poses and all else. "
            "Exit with 0 if they mean the same, 1 if they differ, 2 for errors.",
            words=(
                ("A, B", "a YAML file, a URDF or a xacro file; or REV:path, the file in git"),
                ("name:=value", "set a variable of both"),
            ),
            looks=True,
            endings=ENDINGS,
            examples=(
                "yamaro diff HEAD:robot.yaml robot.yaml",
                "yamaro diff robot.yaml robot.yaml --a reach:=0.8 --b reach:=1.2",
                "git config diff.yamaro.command 'yamaro diff --git'",
            ),
        ),
        Command(
            "test",
            ("[FILE|FOLDER ...]",),
            "test robots against what is expected of them",
            "Run the test files (*.test.yaml) that are named, and those in folders and below; by "
            "default in the working directory. Exit with 0 if all cases pass, 1 if any fails.",
            words=(("FILE, FOLDER", "test files, and folders with test files"),),
            looks=True,
            endings=("test.yaml", "test.yml"),
            examples=("yamaro test", "yamaro test robots --junit results.xml"),
        ),
        Command(
            "new",
            ("NAME",),
            "make a package of a robot, for pip and colcon",
            "Make a folder with a small robot to start from: a package for pip and for colcon, "
            "with a test, checks in CI, and a README with a picture. The last part of NAME is the "
            "name of the package.",
            words=(("NAME", "the folder to make, such as rover_description; it must not exist"),),
            examples=("yamaro new rover_description", "yamaro new src/rover_description"),
        ),
        Command(
            "sweep",
            (
                "STUDY -o FOLDER",
                "FILE [name=AXIS ...] [name:=value ...] --samples N -o FOLDER",
                "show FOLDER NUMBER",
                "plot FOLDER [--metric NAME] -o FILE",
            ),
            "build many variants of a robot, and a table of them",
            "Build a robot with many values of its arguments, and write a table of them: the "
            "values, whether each variant could be built, and what was measured of it. See "
            "docs/sweeps.md.",
            words=(
                ("STUDY", "a YAML file with the key `sweep`"),
                FILE_WORDS[0],
                ("name=AXIS", AXIS_HELP),
                ("name:=value", "pass a value to all variants"),
                ("show", "build variant NUMBER of the sweep in FOLDER again"),
                ("plot", "draw the results of the sweep in FOLDER by its arguments"),
            ),
            endings=ENDINGS,
            examples=(
                "yamaro sweep leg.yaml thigh=0.2..0.4 legs=4,6 --samples 1000 -o runs/",
                "yamaro sweep study.yaml -o runs/ --engine dask://host:8786 --resume",
                "yamaro sweep show runs/ 4711 > variant.urdf",
                "yamaro sweep plot runs/ --metric mass --minimize -o plot.png",
            ),
            takes_several=True,
        ),
        Command(
            "lsp",
            ("[--stdio]",),
            "serve an editor: diagnostics, completion, hover, rename",
            "Run a language server on standard input and output. Editors start it; see "
            "docs/editors.md.",
        ),
        Command(
            "fmt",
            ("FILE|FOLDER...",),
            "format YAML files in one style",
            "Bring YAML files into one style: indentation, spaces and blank lines. Comments, "
            "order, quotes and numbers stay as they are written. The files are not run.",
            words=(
                ("FILE", "a YAML file; - formats standard input to standard output"),
                ("FOLDER", "formats the files *.urdf.yaml and *.yamaro.yaml in it and below"),
            ),
            looks=True,
            endings=("yaml", "yml"),
            examples=(
                "yamaro fmt robot.yaml leg.yaml",
                "yamaro fmt --check *.yaml",
                "yamaro fmt .",
            ),
            takes_several=True,
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


def named_commands() -> list[str]:
    """Return the commands that have a word of their own."""
    return [name for name in COMMANDS if name != BUILD]
