"""What options say about a build: how far its file is trusted, its limits, its packages."""

from __future__ import annotations

import os

from .command_table import BUILD, COMMANDS
from .usage import WrongUsage, near, quote

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ..diagnostics import Adjustment
    from ..options import AllOptions, Options
    from ..policy import Policy
    from .arguments import Arguments

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
    looks = mode is None and (looks or COMMANDS[arguments.command].looks)
    allowed = arguments.lists.get("allow-path", [])
    if allowed and not looks and mode in (None, TRUSTED):
        raise WrongUsage("'--allow-path' needs --jail or --safe")
    limits = dict(map(_read_limit, arguments.lists.get("limit", [])))
    timeout = _read_timeout(arguments)
    try:
        if looks:
            return Policy.looking(limits=limits, timeout=timeout, allowed_paths=allowed)
        return Policy(mode or TRUSTED, limits=limits, timeout=timeout, allowed_paths=allowed)
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

    wanted: AllOptions = {
        "packages": read_packages(arguments),
        "command_line": arguments.assignments,
        "strict": arguments.has("strict"),
        "allow": arguments.lists.get("allow", ()),
        "deny": arguments.lists.get("deny", ()),
        "output": output_of(arguments),
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


def _read_timeout(arguments: Arguments) -> float | None:
    text = arguments.options.get("timeout")
    if text is None:
        return None
    try:
        seconds = float(text)
    except ValueError:
        seconds = 0.0
    if not 0 < seconds <= MOST_SECONDS:
        raise WrongUsage(f"'--timeout' takes a number of seconds greater than 0, not {quote(text)}")
    return seconds


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
    from .delivery import goes_to_standard_output

    is_xml = arguments.command in (BUILD, "watch")
    if not is_xml or goes_to_standard_output(arguments):
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
    if arguments.has("to") or arguments.command == "why":
        from .formats import targets_in

        return {**targets_in(arguments), "gazebo": arguments.has("gazebo")}
    if arguments.command == "view":
        return {
            "base": arguments.options.get("base"),
            "repair_inertia": arguments.has("repair-inertia"),
            "sdf_version": arguments.options.get("sdf-version"),
        }
    for name in ("base", "repair-inertia", "sdf-version"):
        if arguments.has(name):
            raise WrongUsage(f"'--{name}' needs an output format, such as --to sdf")
    meshes = arguments.options.get("meshes", "relative")
    return {"meshes": meshes, "gazebo": arguments.has("gazebo")}
