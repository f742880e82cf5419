"""The table of options, and the help that is made of it.

To add an option, add an `Option` here, and read it with `arguments.has(…)`, `.options` or `.lists`
where it has an effect.
"""

from __future__ import annotations

from .command_table import BUILD, COMMANDS, all_commands, command_named, named_commands
from .reports import WrongUsage, deliver, near, quote

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..streams import Streams
    from .arguments import Arguments
    from .command_table import Command

BUILDING = (
    "quiet", "strict", "allow", "deny", "trust", "jail", "safe", "timeout", "allow-path", "within",
    "limit", "package", "color", "model", "overlay",
)  # fmt: skip
"""Those of commands that build one file of the user's, and show its messages."""
WORKING = (
    "quiet", "trust", "jail", "safe", "timeout", "allow-path", "within",
    "limit", "package", "color",
)  # fmt: skip
"""Those of commands that run files."""
WRITING = ("base", "repair-inertia", "sdf-version", "mujoco-version")
"""Those of commands that write output formats."""


class Option:
    """An option.

    Attributes:
        name: the long form, without the dashes.
        short: the letter of its short form, or "".
        value: what is written after it, as the help shows it; "" for an option without a value.
        wants: what the value is, for messages; see `with_formats`.
        help: what it does; up to the first `;`, `:` or `(` also for shells; see `with_formats`.
        help_in: what it does in commands where that is something else.
        commands: the names of the commands of the core that take it.
        is_repeatable: whether it may be given several times; `Arguments.lists` holds the values.
        choices: the values it can have; any if empty.
        completes: what a shell offers for the value: "files", "commands", or words with spaces in
            between; "limits", "codes" and "formats" mean the words of those tables.
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
        commands: tuple[str, ...] = (),
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


BOTH = (BUILD, "check")
READING = (*BOTH, "args")
"""The commands that read a file."""

OPTIONS = {
    option.name: option
    for option in (
        Option(
            "output",
            "write to FILE instead of standard output, or into a folder: out/; after an error, "
            "nothing is changed",
            BOTH,
            short="o",
            value="FILE",
            wants="a file name",
            completes="files",
            help_in={
                "check": "write the report to FILE, and the messages to standard error as usual; "
                "needs --format json, sarif, github or junit"
            },
        ),
        Option(
            "json",
            "write a JSON Schema (2020-12) of the arguments",
            ("args",),
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
        Option(
            "help-args",
            "list the arguments of the file and exit, as 'yamaro args' does",
            (BUILD,),
            excludes=("deps",),
        ),
        Option(
            "deps",
            "list the files read and the meshes used, one per line, instead of writing the XML",
            (BUILD,),
        ),
        Option(
            "depfile",
            "also write to FILE which files the output depends on, for make, Ninja and CMake",
            (BUILD,),
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
            (BUILD,),
            value="HOW",
            wants="relative, keep, absolute, copy, package://NAME, package:// or none",
            completes="relative keep absolute copy package:// none",
        ),
        Option(
            "to",
            "write these output formats: {formats}, separated by commas; several need a folder: "
            "-o FOLDER/",
            BOTH,
            value="FORMATS",
            wants="{formats or}",
            is_repeatable=True,
            completes="formats",
            help_in={"check": "also report what these output formats cannot hold: urdf, sdf, ..."},
        ),
        Option(
            "base",
            "fix the root of the robot in the world, or let it move freely; by default as the "
            "robot says",
            BOTH,
            value="HOW",
            wants="fixed or free",
            choices=("fixed", "free"),
        ),
        Option(
            "repair-inertia",
            "balance inertia that no body can have, instead of refusing it",
            BOTH,
        ),
        Option(
            "sdf-version",
            "version of SDF: 1.11 (the default), 1.9 or 1.12",
            BOTH,
            value="VERSION",
            wants="1.11, 1.9 or 1.12",
            choices=("1.11", "1.9", "1.12"),
        ),
        Option(
            "mujoco-version",
            "version of MuJoCo that reads MJCF: 3.3 or newer; by default the newest",
            BOTH,
            value="VERSION",
            wants="a version of MuJoCo, such as 3.3",
        ),
        Option(
            "model",
            "the model to read of an MJCF or SDF file that has several",
            BOTH,
            value="NAME",
            wants="the name of a model",
        ),
        Option(
            "overlay",
            "change values of the robot as an overlay or a calibration says; later ones win",
            BOTH,
            value="FILE",
            wants="the file of an overlay",
            is_repeatable=True,
            completes="files",
        ),
        Option(
            "gazebo",
            "also write sensors, surfaces, and in SDF what drives joints, for Gazebo",
            (BUILD,),
        ),
        Option(
            "quiet",
            "show errors only: no warnings and no output of 'print'",
            READING,
            short="q",
        ),
        Option(
            "verbose",
            "show each place of what an output format cannot hold, instead of a line for a kind",
            BOTH,
            short="v",
            excludes=("quiet",),
        ),
        Option("strict", "treat warnings as errors", BOTH),
        Option(
            "allow",
            "treat messages with that code as warnings, also with --strict: unknown-material",
            BOTH,
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
            BOTH,
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
            BOTH,
            excludes=("trust", "safe"),
        ),
        Option(
            "safe",
            "allow the file only to compute: no Python modules, no loops in `process`",
            BOTH,
            excludes=("trust", "jail"),
        ),
        Option(
            "timeout",
            "stop after that time; with --jail and --safe, 60 by default",
            READING,
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
            "within",
            "allow reading nothing outside of a folder but what --allow-path names, with --jail "
            "and --safe; no packages either",
            READING,
            value="FOLDER",
            wants="a folder",
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
        Option("help", "show this help", (), short="h"),
        Option("version", "show the version", (), short="V"),
    )
}

SPELLINGS = {spelling: option for option in OPTIONS.values() for spelling in option.spellings}
"""The options of this table by what is written on the command line: `-o` and `--output`."""


def options_of(command: Command) -> list[Option]:
    """Return the options of a command, in the order of its help."""
    found = [option for option in OPTIONS.values() if command.name in option.commands]
    found += [OPTIONS[each] if isinstance(each, str) else each for each in command.options]
    return [*found, OPTIONS["help"], OPTIONS["version"]]


def all_options() -> dict[str, Option]:
    """Return the options of all commands by name, those of tools after those of this table."""
    found = dict(OPTIONS)
    for command in all_commands().values():
        for option in options_of(command):
            found.setdefault(option.name, option)
    return found


def all_spellings() -> dict[str, Option]:
    """Return the options of all commands by what is written on the command line."""
    return {spelling: option for option in all_options().values() for spelling in option.spellings}


def option_spelled(spelling: str, command: str) -> Option | None:
    """Return the option that is written so, that of a command before those of others."""
    if command not in COMMANDS:
        found = command_named(command)
        for option in options_of(found) if found is not None else ():
            if spelling in option.spellings:
                return option
    return SPELLINGS.get(spelling) or all_spellings().get(spelling)


def with_formats(text: str) -> str:
    """Return what is said of an option, with the output formats in place of `{formats}`.

    The table of targets is loaded only when they are said.
    """
    if "{formats" not in text:
        return text
    from ..targets.table import TARGETS

    *most, last = TARGETS
    text = text.replace("{formats}", ", ".join(TARGETS))
    return text.replace("{formats or}", f"{', '.join(most)} or {last}")


# --- `yamaro help`, `yamaro COMMAND --help` ---------------------------------------------------


COLUMNS = 100
MARGIN = 24
"""Columns before what is said of an option."""
STATUS = "exit status: 0 success, 1 errors in the input or the output, 2 wrong usage"


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the help of the command that is named; return the exit status."""
    topics = arguments.words or [BUILD]
    if command_named(topics[0]) is None:
        hint = (
            near(topics[0], named_commands()) or f"; the commands are {', '.join(named_commands())}"
        )
        raise WrongUsage(f"unknown command {quote(topics[0])}{hint}")
    if len(topics) > 1:
        raise WrongUsage(f"unexpected argument {quote(topics[1])} after {quote(topics[0])}")
    return deliver([help_of(topics[0])], arguments, streams)


def usage_of(command: Command) -> list[str]:
    """Return the lines that say what may follow a command."""
    called = "yamaro" if command.name == BUILD else f"yamaro {command.name}"
    forms = " ".join(command.forms)
    has_more = any(f"--{option.name}" not in forms for option in options_of(command)[:-2])
    lines = [
        f"{called} {'[options] ' if has_more else ''}{form}".rstrip() for form in command.forms
    ]
    return [("usage: " if number == 0 else "       ") + line for number, line in enumerate(lines)]


def help_of(name: str) -> str:
    """Return the help of a command; that of `yamaro FILE` also lists the others."""
    command = command_named(name)
    assert command is not None, name
    blocks = [usage_of(command), _wrapped(command.about, 0)]
    if command.words:
        blocks.append([line for word, text in command.words for line in _row(word, text)])
    options = [line for option in options_of(command) for line in _option(option, command)]
    blocks.append(["options, in any order:", *options])
    if name == BUILD:
        rows = [
            line
            for other in all_commands().values()
            if other.name != BUILD
            for line in _row(f"yamaro {other.name}", other.summary)
        ]
        blocks.append(["other commands; see 'yamaro COMMAND --help':", *rows])
    if command.examples:
        blocks.append(["examples:", *(f"  {example}" for example in command.examples)])
    if name == BUILD:
        blocks.append([STATUS])
    return "\n\n".join("\n".join(block) for block in blocks) + "\n"


def _option(option: Option, command: Command) -> list[str]:
    text = command.help_of.get(option.name) or option.help_in.get(command.name, option.help)
    text = with_formats(text)
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
