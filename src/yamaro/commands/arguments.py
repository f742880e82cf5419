"""The command line, split by hand: `argparse` takes longer to import than a small build takes."""

from __future__ import annotations

import os

from ..source import STANDARD_INPUT
from .command_table import BUILD, command_named, named_commands
from .reports import WrongUsage, goes_to_standard_output, near, quote

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from typing_extensions import Unpack

    from ..diagnostics import Adjustment
    from ..options import AllOptions, Options
    from ..policy import Policy
    from .command_table import Command
    from .option_table import Option


class Arguments:
    """The command line, taken apart.

    Attributes:
        command: the name of a command.
        words: what is neither an option nor a variable: the file, and with `why` the address.
        assignments: what has the form `name:=value`.
        options: the values of options by name, "" for those that have none.
        lists: all values of the options that may be given several times.
        output_path: where the output goes; `resolve_output` sets it.
    """

    __slots__ = ("assignments", "command", "lists", "options", "output_path", "words")

    def __init__(self) -> None:
        """Start with a plain build of nothing."""
        self.command = BUILD
        self.words: list[str] = []
        self.assignments: list[str] = []
        self.options: dict[str, str] = {}
        self.lists: dict[str, list[str]] = {}
        self.output_path = ""

    @property
    def known_command(self) -> Command:
        """The description of the command."""
        command = command_named(self.command)
        assert command is not None, self.command
        return command

    def has(self, option: str) -> bool:
        """Return whether an option is given."""
        return option in self.options

    def for_file(self, path: str) -> Arguments:
        """Return the same command line with one file."""
        other = Arguments()
        other.command, other.assignments = self.command, self.assignments
        other.options, other.lists = self.options, self.lists
        other.output_path, other.words = self.output_path, [path]
        return other

    def resolve_output(self) -> None:
        """Settle where the output goes before user code can change the working directory."""
        try:
            self.output_path = os.path.join(os.getcwd(), self.options.get("output", ""))
        except OSError:
            raise WrongUsage("the working directory no longer exists") from None


def parse_arguments(argv: Sequence[str]) -> Arguments:
    """Return what a command line asks for; raise WrongUsage if that is not clear."""
    arguments = Arguments()
    pending = list(reversed(argv))
    only_words = False
    while pending:
        word = pending.pop()
        if only_words or word == "-" or not word.startswith("-"):
            _add_word(arguments, word, is_plain=only_words)
        elif word == "--":
            only_words = True
        elif word.startswith("--"):
            from .option_table import all_spellings, option_spelled

            name, has_value, value = word.partition("=")
            option = option_spelled(name, arguments.command)
            if option is None:
                raise WrongUsage(f"unknown option {quote(name)}{near(name, all_spellings())}")
            if not option.value:
                if has_value:
                    raise WrongUsage(f"'{name}' takes no value")
                value = ""
            elif not has_value:
                value = _next_value(name, option, pending)
            _set_option(arguments, name, option, value)
        else:
            _add_short_options(arguments, word, pending)
        if arguments.has("version"):
            return arguments
        if arguments.has("help"):
            if pending:  # `yamaro --help check` is asked as well
                _add_word(arguments, pending.pop(), is_plain=False)
            return arguments
    if arguments.options:
        from .option_table import options_of

        options = {option.name: option for option in options_of(arguments.known_command)}
        for name in arguments.options:
            if name not in options:
                is_build = arguments.command == BUILD
                usage = "yamaro FILE" if is_build else f"yamaro {arguments.command}"
                raise WrongUsage(f"'--{name}' cannot be used with '{usage}'")
        for name, option in options.items():
            for other in option.excludes:
                if arguments.has(name) and arguments.has(other):
                    raise WrongUsage(f"'--{name}' and '--{other}' cannot be combined")
    if any(word.startswith("package://") for word in arguments.words):
        from ..options import UsageError
        from ..request import main_path

        packages = read_packages(arguments)
        try:
            arguments.words = [main_path(word, packages) for word in arguments.words]
        except UsageError as error:
            raise WrongUsage(str(error)) from None
    command = arguments.known_command
    if command.words and command.counts_words:
        check_words(arguments, command)
    return arguments


def _add_word(arguments: Arguments, word: str, *, is_plain: bool) -> None:
    name, assigns, _ = word.partition(":=")
    is_file = is_plain and os.path.lexists(word)  # as a pattern of the shell may give it
    if assigns and os.sep not in name and not is_file:
        arguments.assignments.append(word)
    elif (
        arguments.command == BUILD
        and not arguments.words
        and not is_plain
        and command_named(word) is not None
    ):
        arguments.command = word
    else:
        arguments.words.append(STANDARD_INPUT if word == "/dev/stdin" else word)


def _add_short_options(arguments: Arguments, word: str, pending: list[str]) -> None:
    """Add `-q`, `-qo FILE` or `-oFILE`."""
    from .option_table import option_spelled

    if len(word) > 2 and option_spelled("-" + word, arguments.command) is not None:
        raise WrongUsage(f"unknown option {quote(word)}; did you mean '-{word}'?")
    for position, letter in enumerate(word[1:], start=2):
        name = "-" + letter
        option = option_spelled(name, arguments.command)
        if option is None:
            raise WrongUsage(f"unknown option {quote(name)}")
        if option.value:
            value = word[position:] or _next_value(name, option, pending)
            _set_option(arguments, name, option, value)
            return
        _set_option(arguments, name, option, "")


def _next_value(name: str, option: Option, pending: list[str]) -> str:
    if not pending:
        from .option_table import with_formats

        raise WrongUsage(f"'{name}' needs {with_formats(option.wants)} after it")
    return pending.pop()


def _set_option(arguments: Arguments, name: str, option: Option, value: str) -> None:
    if option.is_repeatable:
        arguments.lists.setdefault(option.name, []).append(value)
    elif option.value and arguments.has(option.name):
        raise WrongUsage(f"'{name}' is given twice")
    if not value and option.completes == "files":
        raise WrongUsage(f"'{name}' needs {option.wants} after it")
    if option.choices and value not in option.choices:
        raise WrongUsage(f"'{name}' takes {option.wants}, not {quote(value)}")
    arguments.options[option.name] = value


def check_words(arguments: Arguments, command: Command) -> None:
    """Refuse a command line with too few words for its command, or too many."""
    words, name = arguments.words, command.name
    if not words:
        if name == BUILD:
            raise WrongUsage("missing FILE")
        aside = ""
        if os.path.isfile(name):
            aside = f"; to compile the file of that name, write './{name}'"
        raise WrongUsage(f"'yamaro {name}' needs {command.needs}{aside}")
    most = 2 if command.second else 1
    if len(words) < most:
        raise WrongUsage(f"'yamaro {name}' needs {command.second}")
    if len(words) > most and not command.takes_several:
        first, second = words[most - 1 : most + 1]
        if not os.path.exists(first) and (hint := near(first, named_commands())):
            raise WrongUsage(f"unknown command {quote(first)}{hint}")
        option, has_value, value = second.partition("=")
        hint = f"; to set a variable, write {quote(f'{option}:={value}')}" if has_value else ""
        raise WrongUsage(f"unexpected argument {quote(second)} after {quote(first)}{hint}")


# --- what options say about a build: policy, limits, packages ---------------------------------


MOST_SECONDS = 1e9
"""The longest time-out, some thirty years: what the system's clocks can count."""


def make_policy(arguments: Arguments, *, looks: bool = False) -> Policy:
    """Return how far the file is trusted.

    Args:
        arguments: the command line.
        looks: whether the file is only looked at, though the command runs others.

    Raises:
        WrongUsage: a limit or the time-out makes no sense.
    """
    from ..policy import JAIL, SAFE, TRUSTED, Policy

    modes = {"trust": TRUSTED, "jail": JAIL, "safe": SAFE}
    mode = next((modes[name] for name in modes if arguments.has(name)), None)
    looks = mode is None and (looks or arguments.known_command.looks)
    allowed = arguments.lists.get("allow-path", [])
    if allowed and not looks and mode in (None, TRUSTED):
        raise WrongUsage("'--allow-path' needs --jail or --safe")
    within = arguments.options.get("within")
    if within is not None and not looks and mode in (None, TRUSTED):
        raise WrongUsage("'--within' needs --jail or --safe")
    limits = dict(map(_read_limit, arguments.lists.get("limit", [])))
    timeout = None
    if (seconds := arguments.options.get("timeout")) is not None:
        try:
            timeout = float(seconds)
        except ValueError:
            timeout = 0.0
        if not 0 < timeout <= MOST_SECONDS:
            wanted = "a number of seconds greater than 0"
            raise WrongUsage(f"'--timeout' takes {wanted}, not {quote(seconds)}")
    try:
        if looks:
            return Policy.looking(
                limits=limits, timeout=timeout, allowed_paths=allowed, within=within
            )
        return Policy(
            mode or TRUSTED, limits=limits, timeout=timeout, allowed_paths=allowed, within=within
        )
    except ValueError as error:
        raise WrongUsage(f"{error}") from None


def read_adjustment(arguments: Arguments) -> Adjustment:
    """Return which messages are errors.

    Raises:
        WrongUsage: a code to allow or deny is unknown, or always an error.
    """
    from ..options import Options, UsageError

    lists = arguments.lists
    try:
        return Options(
            allow=lists.get("allow", ()), deny=lists.get("deny", ()), strict=arguments.has("strict")
        ).adjustment
    except UsageError as error:
        raise WrongUsage(str(error)) from None


def options_of(arguments: Arguments, **others: Unpack[AllOptions]) -> Options:
    """Return the options of a build of one file.

    Args:
        arguments: the command line.
        others: what the command itself asks for.

    Raises:
        WrongUsage: a value makes no sense, or options do not go together.
    """
    from ..options import Options, UsageError

    is_alone = arguments.command == "build" and goes_to_standard_output(arguments)
    wanted: AllOptions = {
        "packages": read_packages(arguments),
        "command_line": arguments.assignments,
        "strict": arguments.has("strict"),
        "allow": arguments.lists.get("allow", ()),
        "deny": arguments.lists.get("deny", ()),
        "output": output_of(arguments),
        "model": arguments.options.get("model"),
        "overlay": arguments.lists.get("overlay", ()),
        "alone": is_alone and not arguments.has("deps"),
    }
    wanted.update(targets_of(arguments))
    wanted.update(others)
    try:
        return Options(**wanted)
    except UsageError as error:
        raise WrongUsage(str(error)) from None


def _read_limit(text: str) -> tuple[str, int]:
    """Return name and number of a `--limit`; the number may be written 5000000 or 5_000_000."""
    from ..policy import limit_names

    name, has_value, value = text.partition("=")
    names = limit_names()
    if name not in names:
        hint = near(name, names) or "; the limits are " + ", ".join(names)
        raise WrongUsage(f"unknown limit {quote(name)}{hint}")
    try:
        return name.replace("-", "_"), int(value)
    except ValueError:
        example = f"'--limit {name}=1000'"
        wrong = f"not {quote(value)}" if has_value else f"as in {example}"
        raise WrongUsage(f"the limit '{name}' needs a whole number, {wrong}") from None


def read_packages(arguments: Arguments) -> dict[str, str]:
    """Return the folders that `--package` gives, by the names of the packages."""
    packages = {}
    for text in arguments.lists.get("package", []):
        name, separator, folder = text.partition(":=")
        if not (name and separator and folder):
            raise WrongUsage(f"'--package' takes NAME:=FOLDER, not {quote(text)}")
        if not os.path.isdir(folder):
            raise WrongUsage(
                f"the folder {quote(folder)} of the package {quote(name)} does not exist"
            )
        packages[name] = folder
    return packages


def output_of(arguments: Arguments) -> str | None:
    """Return the file that the XML is written to, None for standard output."""
    if not arguments.known_command.writes_document or goes_to_standard_output(arguments):
        return None
    if arguments.has("to") and not arguments.has("deps"):
        from .formats import path_for_build

        return path_for_build(arguments)
    return arguments.output_path


def targets_of(arguments: Arguments) -> AllOptions:
    """Return the options of a build that say which formats are written, and how.

    Raises:
        WrongUsage: a format is unknown, or options do not go together.
    """
    if (targets := arguments.known_command.targets) is not None:
        return targets(arguments)
    if arguments.has("to"):
        from .formats import targets_in

        return targets_in(arguments)
    for name in ("base", "repair-inertia", "sdf-version", "mujoco-version"):
        if arguments.has(name):
            raise WrongUsage(f"'--{name}' needs an output format, such as --to sdf")
    meshes = arguments.options.get("meshes", "relative")
    return {"meshes": meshes, "gazebo": arguments.has("gazebo")}
