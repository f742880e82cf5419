"""The command: reads its arguments, runs a build, and says on which stream what came of it.

Arguments are split by hand, and everything a plain conversion does not need is imported where it
is used: start-up time is most of what a conversion takes.
"""

from __future__ import annotations

import os
import sys

from .output import STANDARD_OUTPUT, ProcessStreams, Streams, is_input, write_file
from .source import STANDARD_INPUT, STANDARD_INPUT_NAME

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from .compiler import Build
    from .diagnostics import Diagnostic
    from .policy import Limits, Policy
    from .source import Source
    from .tools.picture.request import Request
    from .tools.rebuilding import Rebuilder

MOST_SECONDS = 1e9
"""The longest time-out, some thirty years: what the system's clocks can count."""

DONE = 0
INPUT_ERROR = 1
USAGE_ERROR = 2
INTERNAL_ERROR = 70  # EX_SOFTWARE of sysexits.h
INTERRUPTED = 130  # 128 + SIGINT, as shells count
PIPE_CLOSED = 141  # 128 + SIGPIPE

USAGE = "usage: yamaro [options] FILE [name:=value ...]   ('yamaro --help' tells more)"
HELP = """\
usage: yamaro [options] FILE [name:=value ...]

Compile a YAML robot description to URDF, or to any other XML, on standard output.

  FILE                  the YAML file, or - for standard input
  name:=value           set a variable of the file to a YAML value: n:=3, sides:=[left, right]

options, in any place:
  -o, --output FILE     write to FILE instead; it is replaced in one step if all went well,
                        and is left as it was otherwise
  -q, --quiet           show errors only: no warnings, nothing that is printed
      --strict          treat warnings as errors
      --deps            list the files read and the meshes used, one a line, instead of the XML
      --force           with migrate, replace a file that is there already
      --trust           let the file do whatever Python can; what `yamaro FILE` does by itself
      --jail            let it do so in a process that can read its own folder and packages, write
                        nothing, and reach no network (Linux only)
      --safe            let it do nothing but compute: no Python modules, no loops in `process`;
                        what `yamaro check`, `tree`, `view` and `picture` do by themselves
      --timeout SECONDS end it after that time (with --jail and --safe, 60 if none is given)
      --allow-path PATH with --jail and --safe, let it read a file or folder; may be given again
      --limit NAME=N    set how much it may use, such as turns=5000000; may be given again
      --package NAME:=FOLDER
                        say where a ROS package is that is not found; may be given again
      --color WHEN      colour messages: auto (the default), always or never
  -h, --help            show this help
  -V, --version         show the version

other commands:
  yamaro check FILE [name:=value ...]   look for errors, warnings and doubtful things; write nothing
  yamaro tree FILE [name:=value ...]    show links, joints and masses as a tree
  yamaro view FILE [name:=value ...]    show the robot in the browser: 'yamaro view --help'
  yamaro watch FILE -o FILE             compile again at each save, and say what came of it
  yamaro picture FILE -o FILE.png [name:=value ...]
                                        draw the robot; 'yamaro picture --help' tells more
  yamaro migrate FILE [-o FILE]         write a URDF, or other XML, as a YAML file of Yamaro
  yamaro migrate FILE -o FOLDER [name:=value ...]
                                        write a robot in xacro as YAML files, a file for each
  yamaro completion bash|zsh|fish       print a completion script for the shell

examples:
  yamaro robot.yaml > robot.urdf
  yamaro robot.yaml -o build/robot.urdf legs:=6 body_mass:=2.5
  yamaro check robot.yaml && yamaro tree robot.yaml
  generate_robot | yamaro -

exit status: 0 done, 1 errors in the input or nowhere to write, 2 wrong usage
"""

VIEW_HELP = """\
usage: yamaro view [options] FILE [name:=value ...]

Show a robot in the browser, and show it anew whenever one of its files is saved. Ctrl-C ends it.
FILE may also be a URDF or a xacro file.

options:
      --port N              serve the page at that port; by default at any that is free
      --no-browser          open no browser, only print the address of the page
      --editor COMMAND      open files with that command, as in 'code -g {file}:{line}:{column}';
                            by default with what VISUAL or EDITOR names, if that has a window
      --trust               let the file do whatever Python can

The other options of 'yamaro check' hold too: --jail, --package and the like ('yamaro --help').
"""
PICTURE_HELP = """\
usage: yamaro picture FILE -o FILE.png [options] [name:=value ...]

Draw a robot: YAML, URDF or xacro. Needs no display and no browser, but yamaro[picture].

  -o, --output FILE     .png or .jpg; .gif or .mp4 for a film; - for a PNG on standard output
      --size 800x600    width and height of each view in pixels
      --view VIEW       iso (the default), front, back, left, right, top, bottom, or azimuth and
                        elevation of the camera in degrees: 30,20; several make a sheet
      --joints NAME=POSITION,...
                        where joints stand, in radians or metres
      --show WHAT       visual (the default), collision, inertia, frames, grid; several with commas
      --transparent     nothing behind the robot but its shadow; .png and .gif
      --turn            a film: the camera goes around the robot
      --sweep JOINTS    a film: joints go through their limits; names with commas, all of them at
                        once with 'all', or one after the other with 'each'
      --seconds N       how long a film is
      --frames-per-second N
                        20 for a .gif and 25 for an .mp4, if it is not given

The options of 'yamaro check' hold too: --trust, --package and the like ('yamaro --help').

examples:
  yamaro picture robot.yaml -o robot.png
  yamaro picture robot.yaml -o sheet.png --view iso,front,left,top --size 400x300
  yamaro picture robot.urdf -o waving.gif --sweep shoulder,elbow --package my_robot:=../my_robot
"""

OPTIONS = {
    "-o": "output",
    "--output": "output",
    "-q": "quiet",
    "--quiet": "quiet",
    "--strict": "strict",
    "--deps": "deps",
    "--force": "force",
    "--trust": "trust",
    "--jail": "jail",
    "--safe": "safe",
    "--timeout": "timeout",
    "--allow-path": "allow-path",
    "--limit": "limit",
    "--package": "package",
    "--port": "port",
    "--no-browser": "no-browser",
    "--editor": "editor",
    "--size": "size",
    "--view": "view",
    "--joints": "joints",
    "--show": "show",
    "--transparent": "transparent",
    "--turn": "turn",
    "--sweep": "sweep",
    "--seconds": "seconds",
    "--frames-per-second": "frames-per-second",
    "--color": "color",
    "-h": "help",
    "--help": "help",
    "-V": "version",
    "--version": "version",
}
TAKES_VALUE = {
    "output": "a file name",
    "color": "auto, always or never",
    "timeout": "a number of seconds",
    "allow-path": "a file or folder",
    "limit": "NAME=NUMBER",
    "package": "NAME:=FOLDER",
    "port": "a number from 0 to 65535",
    "editor": "a command",
    "size": "WIDTHxHEIGHT",
    "view": "the name of a view, or azimuth,elevation",
    "joints": "NAME=POSITION",
    "show": "visual, collision, inertia, frames or grid",
    "sweep": "names of joints, all or each",
    "seconds": "a number of seconds",
    "frames-per-second": "a number",
}
TAKES_VALUES = ("allow-path", "limit", "package", "view", "joints", "show")
PICTURE_OPTIONS = (
    "size", "view", "joints", "show", "transparent", "turn", "sweep", "seconds",
    "frames-per-second",
)  # fmt: skip
MODE_OPTIONS = ("trust", "jail", "safe")
POLICY_OPTIONS = (*MODE_OPTIONS, "timeout", "allow-path", "limit", "package")
COLORS = ("auto", "always", "never")
COMMANDS = {
    "build": frozenset(("output", "quiet", "strict", "deps", "color", *POLICY_OPTIONS)),
    "check": frozenset(("quiet", "strict", "color", *POLICY_OPTIONS)),
    "tree": frozenset(("quiet", "strict", "color", *POLICY_OPTIONS)),
    "picture": frozenset(("output", "quiet", "strict", "color", *POLICY_OPTIONS, *PICTURE_OPTIONS)),
    "migrate": frozenset(("output", "quiet", "color", "limit", "force", "package")),
    "view": frozenset(
        ("quiet", "strict", "color", "port", "no-browser", "editor", *POLICY_OPTIONS)
    ),
    "watch": frozenset(("output", "quiet", "strict", "color", *POLICY_OPTIONS)),
    "completion": frozenset(),
}

LOOKING = ("check", "tree", "picture", "view")
"""The commands that look at robots of any source: URDF and xacro too."""


class Arguments:
    """What the command line asks for."""

    __slots__ = ("assignments", "command", "lists", "options", "output_path", "words")

    def __init__(self) -> None:
        """Start with a plain build of nothing."""
        self.command = "build"
        self.words: list[str] = []
        self.assignments: list[str] = []
        self.options: dict[str, str] = {}
        self.lists: dict[str, list[str]] = {}  # of the options that may be given several times
        self.output_path = ""

    def has(self, option: str) -> bool:
        """Tell whether an option is given."""
        return option in self.options

    def resolve_output(self) -> None:
        """Settle where the output goes before user code can change the working directory."""
        try:
            self.output_path = os.path.join(os.getcwd(), self.options.get("output", ""))
        except OSError:
            raise WrongUsage("the working directory does not exist any more") from None


class WrongUsage(Exception):
    """The command line cannot be understood; the text says why."""


class ProgramEnded(Exception):
    """User code called sys.exit, which must not pass for success."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command and return its exit status.

    Args:
        argv: the arguments without the program's name. None takes those of the process, and
            treats the process as the command's own: its standard output is then kept apart from
            user code at the level of file descriptors, and for good.
    """
    if argv is not None:
        return _run_safely(argv, Streams)
    import gc

    from .runtime.collector import RareCollection

    with RareCollection():  # here and not only in `build`, for what is imported before
        status = _run_safely(sys.argv[1:], ProcessStreams)
        gc.freeze()  # all goes with the process: nothing in it need be looked through or freed
    return status


def _run_safely(argv: Sequence[str], stream_class: type[Streams]) -> int:
    """Run the command and return its exit status, whatever is raised."""
    streams: Streams | None = None
    try:
        arguments = parse_arguments(argv)
        streams = stream_class(quiet=arguments.has("quiet"))
        return _run(arguments, streams)
    except WrongUsage as error:
        return _report_usage(str(error), streams)
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
        return _report_fault(error, streams or Streams(quiet=False))


# --- arguments --------------------------------------------------------------------------------


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
            _add_long_option(arguments, word, pending)
        else:
            _add_short_options(arguments, word, pending)
        if arguments.has("help") or arguments.has("version"):
            return arguments
    _check_arguments(arguments)
    return arguments


def _add_word(arguments: Arguments, word: str, *, is_plain: bool) -> None:
    name, assigns, _ = word.partition(":=")
    if assigns and os.sep not in name:
        arguments.assignments.append(word)
    elif arguments.command == "build" and not arguments.words and word in COMMANDS and not is_plain:
        arguments.command = word
    else:
        arguments.words.append(STANDARD_INPUT if word == "/dev/stdin" else word)


def _add_long_option(arguments: Arguments, word: str, pending: list[str]) -> None:
    name, has_value, value = word.partition("=")
    option = OPTIONS.get(name)
    if option is None:
        raise WrongUsage(f"there is no option {_quote(name)}{_near(name, OPTIONS)}")
    if option not in TAKES_VALUE:
        if has_value:
            raise WrongUsage(f"'{name}' takes no value")
        value = ""
    elif not has_value:
        value = _next_value(name, option, pending)
    _set_option(arguments, name, value)


def _add_short_options(arguments: Arguments, word: str, pending: list[str]) -> None:
    """Add `-q`, `-qo FILE` or `-oFILE`."""
    if "-" + word in OPTIONS:
        raise WrongUsage(f"there is no option {_quote(word)}; did you mean '-{word}'?")
    for position, letter in enumerate(word[1:], start=2):
        name = "-" + letter
        option = OPTIONS.get(name)
        if option is None:
            raise WrongUsage(f"there is no option {_quote(name)}")
        if option in TAKES_VALUE:
            _set_option(arguments, name, word[position:] or _next_value(name, option, pending))
            return
        _set_option(arguments, name, "")


def _next_value(name: str, option: str, pending: list[str]) -> str:
    if not pending:
        raise WrongUsage(f"'{name}' needs {TAKES_VALUE[option]} after it")
    return pending.pop()


def _set_option(arguments: Arguments, name: str, value: str) -> None:
    option = OPTIONS[name]
    if option in TAKES_VALUES:
        arguments.lists.setdefault(option, []).append(value)
    elif option in TAKES_VALUE and arguments.has(option):
        raise WrongUsage(f"'{name}' is given twice")
    if option in ("output", "allow-path") and not value:
        raise WrongUsage(f"'{name}' needs {TAKES_VALUE[option]} after it")
    if option == "color" and value not in COLORS:
        raise WrongUsage(f"'{name}' takes {TAKES_VALUE[option]}, not {_quote(value)}")
    arguments.options[option] = value


def _check_arguments(arguments: Arguments) -> None:
    command = arguments.command
    for option in arguments.options:
        if option not in COMMANDS[command]:
            usage = "yamaro FILE" if command == "build" else f"yamaro {command}"
            raise WrongUsage(f"'--{option}' has no meaning for '{usage}'")
    modes = [f"--{mode}" for mode in MODE_OPTIONS if arguments.has(mode)]
    if len(modes) > 1:
        raise WrongUsage(f"'{modes[0]}' and '{modes[1]}' exclude each other")
    if command == "completion":
        return
    if not arguments.words:
        raise WrongUsage(_missing_file(command))
    if len(arguments.words) > 1:
        raise WrongUsage(_second_file(*arguments.words[:2]))


def make_policy(arguments: Arguments) -> Policy:
    """Return how far the file is trusted; what only looks at files runs none of their Python.

    Raises:
        WrongUsage: a limit or the time-out makes no sense.
    """
    from .policy import JAIL, SAFE, TRUSTED, Policy

    modes = {"trust": TRUSTED, "jail": JAIL, "safe": SAFE}
    mode = TRUSTED if arguments.command in ("build", "watch") else SAFE
    mode = next((modes[name] for name in MODE_OPTIONS if arguments.has(name)), mode)
    allowed = arguments.lists.get("allow-path", [])
    if allowed and mode == TRUSTED:
        raise WrongUsage("'--allow-path' has a meaning with --jail and --safe only")
    limits = dict(map(_read_limit, arguments.lists.get("limit", [])))
    try:
        return Policy(mode, limits=limits, timeout=_read_timeout(arguments), allowed_paths=allowed)
    except ValueError as error:
        raise WrongUsage(f"{error}") from None


def _read_limit(text: str) -> tuple[str, int]:
    """Return name and number of a `--limit`; the number may be written 5000000 or 5_000_000."""
    from .policy import limit_names

    name, has_value, value = text.partition("=")
    names = limit_names()
    if name not in names:
        near = _near(name, dict.fromkeys(names, ""))
        raise WrongUsage(
            f"there is no limit {_quote(name)}{near or '; the limits are ' + ', '.join(names)}"
        )
    try:
        return name.replace("-", "_"), int(value)
    except ValueError:
        example = f"'--limit {name}=1000'"
        wrong = f"not {_quote(value)}" if has_value else f"as in {example}"
        raise WrongUsage(f"the limit '{name}' needs a whole number, {wrong}") from None


def _read_packages(arguments: Arguments) -> dict[str, str]:
    """Return the folders that `--package` gives, by the names of the packages."""
    packages = {}
    for text in arguments.lists.get("package", []):
        name, separator, folder = text.partition(":=")
        if not (name and separator and folder):
            raise WrongUsage(f"'--package' takes NAME:=FOLDER, not {_quote(text)}")
        if not os.path.isdir(folder):
            raise WrongUsage(
                f"the folder {_quote(folder)} of the package {_quote(name)} is not there"
            )
        packages[name] = folder
    return packages


def _read_timeout(arguments: Arguments) -> float | None:
    text = arguments.options.get("timeout")
    if text is None:
        return None
    try:
        seconds = float(text)
    except ValueError:
        seconds = 0.0
    if not 0 < seconds <= MOST_SECONDS:
        raise WrongUsage(f"'--timeout' takes a number of seconds above 0, not {_quote(text)}")
    return seconds


def _missing_file(command: str) -> str:
    if command == "build":
        return "no FILE is given"
    aside = f"; for a file of that name write './{command}'" if os.path.isfile(command) else ""
    return f"'yamaro {command}' needs a FILE{aside}"


def _second_file(first: str, second: str) -> str:
    if not os.path.exists(first) and (near := _near(first, COMMANDS)):
        return f"there is no command {_quote(first)}{near}"
    name, has_value, value = second.partition("=")
    hint = f"; variables are set like {_quote(f'{name}:={value}')}" if has_value else ""
    return f"{_quote(second)} is one FILE too many after {_quote(first)}{hint}"


def _near(word: str, candidates: dict[str, str] | dict[str, frozenset[str]]) -> str:
    from .diagnostics import did_you_mean

    hint = did_you_mean(word, [name for name in candidates if name != "build"])
    return f"; {hint}" if hint else ""


def _quote(text: str) -> str:
    from .terminal import shortened

    return f"'{shortened(text)}'"


# --- commands ---------------------------------------------------------------------------------


def _run(arguments: Arguments, streams: Streams) -> int:
    if arguments.has("help"):
        text = {"picture": PICTURE_HELP, "view": VIEW_HELP}.get(arguments.command, HELP)
        return _deliver([text.encode()], arguments, streams)
    if arguments.has("version"):
        from . import __version__

        return _deliver([f"yamaro {__version__}\n".encode()], arguments, streams)
    if arguments.command == "completion":
        return _deliver([_completion(arguments.words)], arguments, streams)
    if arguments.command == "migrate":
        return _migrate(arguments, streams)
    if arguments.command in ("view", "watch"):
        return _repeat(arguments, streams)
    return _run_on_file(arguments, streams)


def _run_on_file(arguments: Arguments, streams: Streams) -> int:
    """Build the file, say what there is to say, and write the result."""
    from .diagnostics import YamaroError

    arguments.resolve_output()
    _refuse_overwriting(arguments, lambda: arguments.words)
    policy = make_policy(arguments)
    try:
        if arguments.command == "picture":
            _picture_request(arguments)  # what is wrong with it shall not have to wait
        if streams.owns_process:
            _bound_process(arguments, streams, policy)
        build, chunks = _build(arguments, streams, policy)
    except YamaroError as error:
        _show(error.diagnostics, arguments, streams)
        return INPUT_ERROR
    streams.kept.append(build)
    _show(build.warnings, arguments, streams)
    if arguments.command == "check" and build.warnings:
        return INPUT_ERROR
    _refuse_overwriting(arguments, lambda: [*build.files, *build.meshes])
    return _deliver(chunks, arguments, streams)


def _migrate(arguments: Arguments, streams: Streams) -> int:
    """Write XML as a Yamaro source, and say whether it makes the same document."""
    from .compiler import UsageError
    from .diagnostics import YamaroError
    from .tools.migrate import command

    arguments.resolve_output()
    _refuse_overwriting(arguments, lambda: arguments.words)
    path = arguments.words[0]
    limits = make_policy(arguments).limits
    data = _read_bytes(path, limits.file + 1)
    try:
        source = command.read_file(path, limits, data)
        if command.is_xacro_file(source, limits):
            return _migrate_xacro(source, arguments, streams, limits)
        if arguments.assignments:
            raise WrongUsage(f"a URDF has no argument to set: {_quote(arguments.assignments[0])}")
        _refuse_replacing(arguments, [arguments.output_path])
        migration = command.migrate_source(source, limits)
    except YamaroError as error:
        _show(error.diagnostics, arguments, streams)
        return INPUT_ERROR
    except UsageError as error:
        raise WrongUsage(str(error)) from None
    status = _deliver([migration.text.encode()], arguments, streams)
    if not streams.quiet or migration.differences:
        streams.say(f"{_display_name(arguments)}: {command.report(migration)}")
    return status or (INPUT_ERROR if migration.differences else DONE)


def _migrate_xacro(source: Source, arguments: Arguments, streams: Streams, limits: Limits) -> int:
    """Write the files of a robot in xacro into a folder, and say whether it is the same."""
    from .tools.migrate import command, xacro_command

    folder = arguments.output_path
    if arguments.options.get("output", "-") in STANDARD_OUTPUT:
        raise WrongUsage("a robot in xacro becomes several files: give a folder, as in '-o robot/'")
    if os.path.isfile(folder):
        raise WrongUsage(f"{_quote(arguments.options['output'])} is a file, and a folder is needed")
    migration = xacro_command.migrate_robot(
        source,
        os.path.abspath(folder),
        arguments=arguments.assignments,
        packages=_read_packages(arguments),
        limits=limits,
    )
    paths = {os.path.join(folder, name): text for name, text in migration.files.items()}
    _refuse_replacing(arguments, list(paths))
    _show([*xacro_command.warnings_of(migration), *migration.faults], arguments, streams)
    for path, text in paths.items():
        try:
            write_file(path, [text.encode()])
        except OSError as error:
            reason = error.strerror or error
            streams.say(f"yamaro: error: cannot write {_quote(path)}: {reason}")
            return INPUT_ERROR
    count = f"{len(paths)} file{'s' if len(paths) > 1 else ''}"
    if migration.faults:
        streams.say(f"{_display_name(arguments)}: the sources ({count}) have errors; see above")
        return INPUT_ERROR
    if not streams.quiet or migration.differences:
        main = os.path.normpath(os.path.join(arguments.options["output"], migration.main))
        streams.say(f"{_display_name(arguments)}: {command.report(migration)}; {count}, {main}")
        if not migration.is_compared_with_xacro:
            streams.say("compared with Yamaro's own expansion; with yamaro[xacro], with xacro's")
    return INPUT_ERROR if migration.differences else DONE


def _refuse_replacing(arguments: Arguments, paths: Sequence[str]) -> None:
    """Refuse to replace files: what is migrated is changed by hand afterwards."""
    if arguments.has("force") or arguments.options.get("output", "-") in STANDARD_OUTPUT:
        return
    for path in paths:
        try:
            is_there = os.stat(path).st_mode & 0o170000 == 0o100000
        except OSError:
            continue
        if is_there:
            shown = os.path.relpath(path)
            raise WrongUsage(f"{_quote(shown)} is there already; --force replaces it")


def _repeat(arguments: Arguments, streams: Streams) -> int:
    """Build at each save until Ctrl-C, which is how these commands end."""
    import warnings

    from . import compiler

    arguments.resolve_output()
    if arguments.words[0] == STANDARD_INPUT:
        raise WrongUsage(f"'yamaro {arguments.command}' needs a FILE with a name, to see it change")
    policy = make_policy(arguments)
    if streams.owns_process:
        from . import process

        process.bound_memory(policy.limits.memory)
    run = _view if arguments.command == "view" else _watch
    try:
        with warnings.catch_warnings():
            if not sys.warnoptions:  # user code's warnings, unless asked for with -W
                warnings.simplefilter("ignore")
            run(arguments, streams, _rebuilder(arguments, streams, policy))
    except compiler.UsageError as error:
        raise WrongUsage(str(error)) from None
    except KeyboardInterrupt:
        return DONE
    finally:
        streams.restore()
    return DONE


def _rebuilder(arguments: Arguments, streams: Streams, policy: Policy) -> Rebuilder:
    from .tools.rebuilding import Rebuilder

    looks = arguments.command == "view"
    return Rebuilder(
        arguments.words[0],
        policy=policy,
        packages=_read_packages(arguments),
        command_line=arguments.assignments,
        on_message=_drop if streams.quiet else streams.say,
        strict=arguments.has("strict"),
        advice=looks,
        has_root=looks,
        takes_xml=arguments.command in LOOKING,
    )


def _view(arguments: Arguments, streams: Streams, rebuilder: Rebuilder) -> None:
    from .tools.view.command import ViewOptions, view

    def tell_url(url: str) -> None:
        streams.write_result([f"{url}\n".encode()])
        streams.divert()

    options = ViewOptions(
        port=_read_port(arguments),
        has_browser=not arguments.has("no-browser"),
        editor=arguments.options.get("editor"),
    )
    view(
        rebuilder,
        options,
        say=_drop if streams.quiet else streams.say,
        show=lambda turn: _show(turn.diagnostics, arguments, streams),
        tell_url=tell_url,
    )


def _read_port(arguments: Arguments) -> int:
    text = arguments.options.get("port", "0")
    if not (text.isascii() and text.isdigit() and int(text) <= 65535):
        raise WrongUsage(f"'--port' takes a number from 0 to 65535, not {_quote(text)}")
    return int(text)


def _watch(arguments: Arguments, streams: Streams, rebuilder: Rebuilder) -> None:
    from .tools.watch import watch

    if arguments.options.get("output", "-") in STANDARD_OUTPUT:
        raise WrongUsage("'yamaro watch' needs a file to write, as in '-o robot.urdf'")

    def write(build: Build) -> bool:
        _refuse_overwriting(arguments, lambda: [*build.files, *build.meshes])
        return _deliver(build.encoded(), arguments, streams) == DONE

    _refuse_overwriting(arguments, lambda: arguments.words)
    streams.divert()
    watch(
        rebuilder,
        write=write,
        output=arguments.options["output"],
        say=_drop if streams.quiet else streams.say,
        show=lambda turn: _show(turn.diagnostics, arguments, streams),
    )


def _bound_process(arguments: Arguments, streams: Streams, policy: Policy) -> None:
    """See to it that this process takes no more memory and time than it may."""
    from . import process
    from .confined import has_jail, time_is_over

    process.bound_memory(policy.limits.memory)
    name = _display_name(arguments)
    if policy.timeout is None or has_jail(policy, name):
        return

    def say_why() -> None:
        _show(time_is_over(name, policy).diagnostics, arguments, streams)

    process.end_after(policy.timeout, say_why)


def _deliver(chunks: Iterable[bytes], arguments: Arguments, streams: Streams) -> int:
    """Write the result to where it is wanted; a place that cannot be written to is an error."""
    output = arguments.options.get("output", "-")
    try:
        if output in STANDARD_OUTPUT:
            streams.write_result(chunks)
        else:
            write_file(arguments.output_path, chunks)
    except BrokenPipeError:
        raise
    except OSError as error:
        name = "to standard output" if output in STANDARD_OUTPUT else _quote(output)
        streams.say(f"yamaro: error: cannot write {name}: {error.strerror or error}")
        return INPUT_ERROR
    return DONE


def _build(arguments: Arguments, streams: Streams, policy: Policy) -> tuple[Build, Iterable[bytes]]:
    """Build the file, with standard output out of reach; return the build and what to write."""
    import warnings

    from . import compiler

    path = arguments.words[0]
    text = _read_pipe(path, policy.limits)
    streams.divert()
    try:
        with warnings.catch_warnings():
            if not sys.warnoptions:  # user code's warnings, unless asked for with -W
                warnings.simplefilter("ignore")
            build = compiler.build(
                path,
                text=text,
                policy=policy,
                packages=_read_packages(arguments),
                command_line=arguments.assignments,
                strict=arguments.has("strict"),
                on_message=_drop if streams.quiet else streams.say,
                advice=arguments.command == "check",
                has_root=arguments.command in ("tree", "picture"),
                takes_xml=arguments.command in LOOKING,
            )
            return build, _result(build, arguments, streams)
    except compiler.UsageError as error:
        raise WrongUsage(str(error)) from None
    except SystemExit as error:
        raise ProgramEnded(f"Python code of the file ended the program: {error!r}") from None
    finally:
        streams.restore()


def _result(build: Build, arguments: Arguments, streams: Streams) -> Iterable[bytes]:
    """Return what a successful build gives under the command and options asked for."""
    if arguments.command == "tree":
        return [_tree(build, arguments, streams)]
    if arguments.command == "picture":
        return [_picture(build, arguments, streams)]
    if arguments.has("deps"):
        names = dict.fromkeys(filter(os.path.isabs, build.files + build.meshes))
        return [os.fsencode(name) + b"\n" for name in names]
    if arguments.command == "check":
        return [] if streams.quiet else [f"{_display_name(arguments)}: ok\n".encode()]
    return build.encoded()


def _tree(build: Build, arguments: Arguments, streams: Streams) -> bytes:
    from .tools.tree import render_tree

    if build.root.name != "robot":
        raise WrongUsage(f"'yamaro tree' shows robots, and this is a <{build.root.name}>")
    encoding = streams.result_encoding()
    try:
        "└─├│…".encode(encoding)
        has_lines = True
    except (UnicodeEncodeError, LookupError):
        has_lines = False
    color = _has_color(arguments, is_terminal=streams.is_terminal(result=True))
    text = render_tree(build.root, ascii=not has_lines, color=color)
    return text.encode(encoding if has_lines else "ascii", "backslashreplace")


def _picture_request(arguments: Arguments) -> Request:
    """Return what to draw; raise WrongUsage if that makes no sense, YamaroError if it cannot be."""
    from .compiler import UsageError
    from .tools.picture.command import check_packages
    from .tools.picture.request import Request

    output = arguments.options.get("output")
    if output is None:
        raise WrongUsage("'yamaro picture' needs a file to write: -o robot.png")
    try:
        request = Request(output, arguments.options, arguments.lists)
    except UsageError as error:
        raise WrongUsage(str(error)) from None
    check_packages(_display_name(arguments), request)
    return request


def _picture(build: Build, arguments: Arguments, streams: Streams) -> bytes:
    from .diagnostics import ERROR, YamaroError
    from .tools.picture.command import draw

    if build.root.name != "robot":
        raise WrongUsage(f"'yamaro picture' draws robots, and this is a <{build.root.name}>")
    result = draw(build, _display_name(arguments), _picture_request(arguments))
    build.warnings.extend(result.warnings)
    if arguments.has("strict") and result.warnings:
        for warning in result.warnings:
            warning.severity = ERROR
        raise YamaroError(result.warnings)
    if not streams.quiet:
        for remark in result.remarks:
            streams.say(f"{_display_name(arguments)}: {remark}")
    return result.data


def _completion(words: list[str]) -> bytes:
    from .tools import completion

    if len(words) == 2 and words[0] == "variables":
        return completion.variable_lines(words[1]).encode("utf-8", "replace")
    if len(words) != 1 or words[0] not in completion.SHELLS:
        raise WrongUsage(f"'yamaro completion' needs a shell: {', '.join(completion.SHELLS)}")
    return completion.script(words[0]).encode()


def _refuse_overwriting(arguments: Arguments, inputs: Callable[[], Sequence[str]]) -> None:
    output = arguments.options.get("output", "-")
    if output not in STANDARD_OUTPUT and is_input(arguments.output_path, inputs()):
        raise WrongUsage(f"the output {_quote(output)} is one of the files that are compiled")


def _read_pipe(path: str, limits: Limits) -> str | None:
    """Return the text of standard input or of a named pipe, None for what can be read by name."""
    from .runtime.loader import LoadError, check_size, decode

    data = _read_bytes(path, limits.file + 1)
    if data is None:
        return None
    if path == STANDARD_INPUT:
        name, absolute = STANDARD_INPUT_NAME, ""
    else:
        name, absolute = path, os.path.abspath(path)
    try:
        check_size(len(data), limits)
    except LoadError as error:
        from .compiler import refusal_of_main

        raise refusal_of_main(name, error) from None
    return decode(data, name=name, path=absolute).text


def _read_bytes(path: str, most: int) -> bytes | None:
    """Return so many bytes of standard input or a named pipe, None for what can be read by name."""
    if path == STANDARD_INPUT:
        if sys.stdin is None:
            raise WrongUsage("standard input is closed")
        buffer = getattr(sys.stdin, "buffer", None)
        try:
            return sys.stdin.read(most).encode() if buffer is None else buffer.read(most)
        except OSError as error:
            raise WrongUsage(f"cannot read standard input: {error.strerror}") from None
    try:
        if os.stat(path).st_mode & 0o170000 != 0o010000:
            return None
        with open(path, "rb") as file:
            return file.read(most)
    except OSError:
        return None


# --- what is said -----------------------------------------------------------------------------


def _show(diagnostics: Sequence[Diagnostic], arguments: Arguments, streams: Streams) -> None:
    """Write diagnostics to standard error; a quiet build keeps its warnings to itself."""
    from .diagnostics import ERROR, render

    if streams.quiet and arguments.command != "check":
        diagnostics = [one for one in diagnostics if one.severity == ERROR]
    if not diagnostics:
        return
    color = _has_color(arguments, is_terminal=streams.is_terminal())
    streams.say("\n\n".join(render(one, color=color) for one in diagnostics))
    if arguments.command == "check":
        errors = sum(one.severity == ERROR for one in diagnostics)
        counts = [(errors, "error"), (len(diagnostics) - errors, "warning")]
        told = [f"{count} {word}{'s' if count > 1 else ''}" for count, word in counts if count]
        streams.say(f"\n{_display_name(arguments)}: {', '.join(told)}")


def _display_name(arguments: Arguments) -> str:
    from .terminal import printable

    path = arguments.words[0]
    return STANDARD_INPUT_NAME if path == STANDARD_INPUT else printable(path)


def _drop(message: str) -> None:
    """Take a message of a quiet run."""


def _has_color(arguments: Arguments, *, is_terminal: bool) -> bool:
    """Tell whether to colour: the option, then NO_COLOR, FORCE_COLOR, TERM, then the terminal."""
    when = arguments.options.get("color", "auto")
    if when != "auto":
        return when == "always"
    environ = os.environ
    if environ.get("NO_COLOR"):
        return False
    if environ.get("FORCE_COLOR"):
        return True
    return is_terminal and environ.get("TERM") != "dumb"


def _report_usage(message: str, streams: Streams | None) -> int:
    from .terminal import shortened

    (streams or Streams(quiet=False)).say(f"yamaro: error: {shortened(message)}\n{USAGE}")
    return USAGE_ERROR


def _report_fault(error: Exception, streams: Streams) -> int:
    """Tell a fault of Yamaro's apart from a fault of the input."""
    from .terminal import printable

    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    place = ""
    if trace is not None:
        place = f" ({os.path.basename(trace.tb_frame.f_code.co_filename)}:{trace.tb_lineno})"
    streams.say(
        f"yamaro: internal error: {type(error).__name__}: {printable(str(error))}{place}\n"
        "this is a fault in Yamaro, not in your file; please report it with what you ran"
    )
    if os.environ.get("YAMARO_TRACEBACK"):
        import traceback

        streams.say("".join(traceback.format_exception(error)).rstrip())
    return INTERNAL_ERROR
