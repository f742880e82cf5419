"""Builds robots for ROS, where a robot is a text that nodes on any machine read."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Iterable, Mapping, Sequence

import yamaro

MODES = {"trust": "trusted", "jail": "jail", "safe": "safe"}
"""How far a file may be trusted, by what is written in launch files."""
FORMATS = ("urdf", "sdf", "srdf")
"""The formats that need no files beside them."""
PACKAGES = "package://"
"""Meshes as `package://NAME/…`, or `file://…` outside of packages."""

Say = Callable[[str], None]


class RobotError(Exception):
    """A robot could not be built; the text shows each error with its file, line and hint."""


def policy_for(trust: str) -> yamaro.Policy:
    """Return how far a file is trusted.

    Raises:
        RobotError: there is no such mode.
    """
    if trust not in MODES:
        raise RobotError(f"trust is one of {', '.join(MODES)}, not '{trust}'")
    return yamaro.Policy(MODES[trust])


def split_words(text: str) -> list[str]:
    """Return the words of a part of a command line.

    Raises:
        RobotError: a quote is not closed.
    """
    try:
        return shlex.split(text)
    except ValueError as error:
        raise RobotError(f"the arguments cannot be split into words: {error}") from None


def build_robot(
    path: str,
    *,
    words: Sequence[str] = (),
    variables: Mapping[str, object] | None = None,
    trust: str = "trust",
    target: str = "urdf",
    meshes: str = PACKAGES,
    gazebo: bool = False,
    strict: bool = False,
    has_root: bool = False,
    warn: Say = print,
    inform: Say = print,
) -> yamaro.Build:
    """Build a robot.

    Args:
        path: the file: YAML, URDF or xacro.
        words: variables as `name:=value`, as on the command line.
        variables: variables as Python objects.
        trust: `trust`, `jail` or `safe`.
        target: `urdf`, `sdf` or `srdf`.
        meshes: how meshes are named; see `yamaro.build`.
        gazebo: also write the sensors and the surfaces of collisions for Gazebo.
        strict: warnings are errors.
        has_root: whether `Build.robot` is needed, which takes time in a jail.
        warn: takes each warning, as a text of several lines.
        inform: takes each line that the file prints.

    Raises:
        RobotError: there is no robot.
    """
    if target not in FORMATS:
        raise RobotError(f"the format is one of {', '.join(FORMATS)}, not '{target}'")
    policy = policy_for(trust)
    try:
        build = yamaro.build(
            path,
            command_line=words,
            variables=variables,
            policy=policy,
            meshes=meshes,
            gazebo=gazebo,
            strict=strict,
            has_root=has_root,
            target=None if target == "urdf" else target,
            on_message=inform,
        )
    except yamaro.YamaroError as error:
        tell_warnings(error.diagnostics, warn)
        raise RobotError(errors_in(error.diagnostics)) from None
    except yamaro.UsageError as error:
        raise RobotError(str(error)) from None
    except SystemExit as error:
        raise RobotError(f"Python code of {path} ended the program: {error!r}") from None
    tell_warnings(build.warnings, warn)
    return build


def tell_warnings(diagnostics: Iterable[yamaro.Diagnostic], warn: Say) -> None:
    """Pass on the warnings, if there are any."""
    found = [one for one in diagnostics if one.severity != "error"]
    if found:
        warn(str(yamaro.YamaroError(found)))


def errors_in(diagnostics: Iterable[yamaro.Diagnostic]) -> str:
    """Return the errors as text."""
    return str(yamaro.YamaroError(one for one in diagnostics if one.severity == "error"))
