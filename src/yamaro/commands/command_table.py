"""The commands: a table of those of the core, and the search for those of tools.

A tool is a folder in `tools/` that is called as its command. Its module `entry` has the `Command`,
as `COMMAND`, and a function `run`; nothing else knows of the tool.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from ..options import AllOptions
    from .arguments import Arguments
    from .option_table import Option


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
        needs: what is missing without a word: "a FILE".
        second: what is missing where there is only one word, of a command that takes two.
        counts_words: whether the number of words is checked before it runs.
        place: where it is in the help, among the others.
        options: of a command of a tool: its options, those that other commands have too by name.
        help_of: what such an option does here, by its name, if that is something else.
        writes_document: whether `-o` names the file of the document itself.
        targets: what its builds write, if that is not for `--to` to say.
    """

    __slots__ = (
        "about", "counts_words", "endings", "examples", "forms", "help_of", "looks", "name",
        "needs", "options", "place", "second", "summary", "takes_several", "targets", "words",
        "writes_document",
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
        needs: str = "a FILE",
        second: str = "",
        counts_words: bool = True,
        place: int = 0,
        options: tuple[str | Option, ...] = (),
        help_of: dict[str, str] | None = None,
        writes_document: bool = False,
        targets: Callable[[Arguments], AllOptions] | None = None,
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
        self.needs = needs
        self.second = second
        self.counts_words = counts_words
        self.place = place
        self.options = options
        self.help_of = help_of or {}
        self.writes_document = writes_document
        self.targets = targets


BUILD = "build"
"""The command that has no name on the command line: `yamaro FILE`."""

FILE_WORDS = (
    ("FILE", "a robot in YAML, URDF, xacro, MJCF or SDF; - for YAML from a pipe"),
    (
        "name:=value",
        "set a variable, n:=3, sides:=[left, right], or an argument of xacro",
    ),
)
ENDINGS = ("yaml", "yml", "urdf", "xacro", "sdf", "mjcf", "xml")

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
                "yamaro check robot.yaml && yamaro robot.yaml -o robot.urdf",
                "generate_robot | yamaro -",
            ),
            writes_document=True,
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
            place=1,
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
            place=7,
        ),
        Command(
            "completion",
            ("bash|zsh|fish",),
            "print a completion script for a shell",
            "Print a script that lets a shell complete commands, options, files and variables.",
            examples=('eval "$(yamaro completion bash)"',),
            place=15,
        ),
        Command(
            "help",
            ("[COMMAND]",),
            "show the options of a command",
            "Show what a command does, and its options.",
            place=16,
        ),
    )
}


def entry_of(name: str) -> Any:
    """Return the module `entry` of a tool, or None if there is no such tool."""
    if not name.isidentifier():
        return None
    from importlib import import_module

    module = f"yamaro.tools.{name}"
    try:
        return import_module(f"{module}.entry")
    except ModuleNotFoundError as error:
        if error.name not in (module, f"{module}.entry"):
            raise
        return None


def command_named(name: str) -> Command | None:
    """Return the command of a name, or None if there is none."""
    command = COMMANDS.get(name)
    if command is None:
        entry = entry_of(name)
        command = entry.COMMAND if entry is not None else None
    return command


def all_commands() -> dict[str, Command]:
    """Return the commands by name, those of all tools among them, in the order of the help."""
    from importlib import import_module
    from pkgutil import iter_modules

    found = list(COMMANDS.values())
    for module in iter_modules(import_module("yamaro.tools").__path__):
        entry = entry_of(module.name)
        if entry is not None:
            found.append(entry.COMMAND)
    return {command.name: command for command in sorted(found, key=lambda each: each.place)}


def named_commands() -> list[str]:
    """Return the commands that have a word of their own."""
    return [name for name in all_commands() if name != BUILD]
