"""One build as it was asked for: main file, variables, options, permission to read."""

from __future__ import annotations

import os

from .diagnostics import Reporter, YamaroError, failure_of_all
from .files.loader import LoadError
from .files.mesh_files import COPY, RELATIVE, MeshFinder
from .files.packages import PackageFinder
from .options import UsageError
from .runtime.predefined import plain_data
from .source import (
    COMMAND_LINE,
    KEYWORD_ARGUMENT,
    STANDARD_INPUT,
    STANDARD_INPUT_NAME,
    Source,
    Span,
    holds_xml,
)
from .syntax.context import ParseContext
from .syntax.names import is_identifier, python_name
from .syntax.values import parse_inline
from .xml.values import format_value
from .yaml.nodes import PLAIN, ScalarNode

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from .diagnostics import Diagnostic
    from .files.readable import Reach
    from .fitting.fit import Fit
    from .options import Options
    from .policy import Policy
    from .runtime.files import Library
    from .targets.assets import Assets
    from .targets.mesh_paths import MeshPaths

    Run = Callable[[Callable[[], bytes]], bytes]


PACKAGE = "package://"
_OF_THIS_MACHINE = (
    "hidden-package", "large-mesh", "missing-extra", "missing-mesh-file", "unknown-package",
)  # fmt: skip
"""The codes of what depends on the files and packages that are installed."""


class Request:
    """A build that is asked for: its main file, its variables, and the reporter of its warnings.

    Attributes:
        source: the main file, as it was read.
        stem: the name of the robot, if the file does not name it.
        options: what was asked for.
        variables: the variables passed, by name.
        places: where the name of each of them is written.
        packages: finds packages.
        finder: finds the files of meshes.
        fits: the shapes that were worked out from meshes so far.
        reporter: takes the warnings.
        adjustment: which codes are allowed and denied.
        is_part: whether the robot of a main file in another format is to fit into others.
        file_name: what the file of the document is called: "" on standard output, None to call it
            like the robot.
    """

    __slots__ = (
        "_folder", "_paths", "_run", "adjustment", "file_name", "finder", "fits", "is_part",
        "options", "packages", "places", "reporter", "source", "stem", "variables",
    )  # fmt: skip

    def __init__(
        self, path: str, source: Source, options: Options, *, reach: Reach | None, run: Run
    ) -> None:
        """Ask for a build.

        Args:
            path: that of the main file.
            source: the main file, as it was read.
            options: what is asked for.
            reach: what may be read, or None for anything.
            run: runs what parses files that others wrote, in a jail if they are not trusted.

        Raises:
            UsageError: a `name:=value` is malformed, or there is no such way to name meshes.
        """
        self.source = source
        self.stem = stem_of(path)
        self.options = options
        self.variables, self.places = read_arguments(
            options.command_line, options.variables, is_xml=source.is_xml
        )
        self.packages = finder_for(path, reach, options.packages)
        start = folder_of(path)
        self.finder = MeshFinder(self.packages, reach, start=start)
        self.fits: dict[bytes, Fit] = {}
        self.reporter = Reporter()
        self.adjustment = options.adjustment
        self.is_part = False
        self.file_name: str | None = ""
        self._folder = start
        if options.output is not None:
            whole = os.path.abspath(options.output)
            self.file_name = os.path.basename(options.output) or None
            self._folder = whole if self.file_name is None else os.path.dirname(whole)
        self._run = run
        self._paths = None if options.meshes == RELATIVE else self._name_meshes()

    def _name_meshes(self) -> MeshPaths:
        from .targets.mesh_paths import MeshPaths

        options = self.options
        is_cached = options.policy.is_trusted  # others change nothing on the disk
        try:
            return MeshPaths(
                options.meshes, self._folder, self.finder, run=self._run, is_cached=is_cached
            )
        except ValueError as error:
            raise UsageError(str(error)) from None

    @property
    def paths(self) -> MeshPaths:
        """Return how the output names meshes, which is made for the few robots that have any."""
        if self._paths is None:
            self._paths = self._name_meshes()
        return self._paths

    @property
    def copies(self) -> Assets | None:
        """Return the copies of meshes beside the output, if it refers to such."""
        return self.paths.assets if self.options.meshes == COPY else None

    def allow(self, diagnostics: Sequence[Diagnostic]) -> None:
        """Turn what the command line allows into warnings, and mark what comments accept."""
        self.adjustment.allow(diagnostics)
        if diagnostics:
            from .allowances import accept

            accept(diagnostics)

    def looks_for(self, code: str) -> bool:
        """Return whether a finding with a code is reported here wherever there is one."""
        from .targets.table import TARGETS

        formats = self.options.target or ("urdf",)
        for target in TARGETS.values():
            if code in target.own_codes:
                return target.name in formats
        if code == "base-assumed":
            return any(TARGETS[name].is_simulator for name in formats)
        if code in _OF_THIS_MACHINE or ".srdf" in self.source.name.lower():
            return False
        return "-in-" not in code or code.partition("-in-")[2] in formats


def read_main(path: str, text: str | None, library: Library) -> Source:
    """Return the main file; `text`, if given, is what to take for its content.

    Raises:
        UsageError: it cannot be read.
        YamaroError: it may not be read, or is not text.
    """
    if text is not None:
        is_file = path != STANDARD_INPUT
        name = path if is_file else STANDARD_INPUT_NAME
        text = text.removeprefix("\ufeff")
        source = Source(text, name=name, path=os.path.abspath(path) if is_file else "")
        source.is_xml = holds_xml(path, text)
        return source
    if not path:
        raise UsageError("the file name is empty")
    try:
        return library.source(os.path.abspath(path), path)
    except LoadError as error:
        if error.hint is not None:
            raise refusal_of_main(path, error) from None
        raise UsageError(f"cannot read '{path}': {error}") from error


def main_path(path: str, packages: Mapping[str, str]) -> str:
    """Return the path of a main file, which may be named as `package://NAME/PATH`.

    Raises:
        UsageError: there is no such package.
    """
    if not path.startswith(PACKAGE):
        return path
    from .files.packages import package_hint

    finder = PackageFinder(given=packages)
    found = finder.resolve_uri(path, os.getcwd())
    if found is None:
        name = path.removeprefix(PACKAGE).partition("/")[0]
        raise UsageError(f"there is no package '{name}'; {package_hint(name)}")
    return found


def refusal_of_main(name: str, error: LoadError) -> YamaroError:
    """Return the error for a main file that is there, and is not to be read."""
    return failure_of_all(error.code, f"the file cannot be read: {error}", name, error.hint)


def folder_of(path: str) -> str:
    """Return the folder in which relative paths of a file start."""
    return os.getcwd() if path == STANDARD_INPUT else os.path.dirname(os.path.abspath(path))


def stem_of(path: str) -> str:
    """Return the name of a robot whose file does not name it."""
    if path == STANDARD_INPUT:
        return "robot"
    name = os.path.basename(path)
    stem = name.partition(".")[0]
    return stem or "robot"


def reach_of(path: str, policy: Policy, packages: Mapping[str, str]) -> Reach | None:
    """Return what a main file may read, or None for anything."""
    if policy.is_trusted:
        return None
    from .files.readable import Reach, roots_of

    allowed = [*policy.allowed_paths, *packages.values()]
    within = [] if policy.within is None else [policy.within, *allowed]
    return Reach(roots_of(os.path.abspath(path), allowed, PackageFinder()), within)


def finder_for(path: str, reach: Reach | None, given: Mapping[str, str]) -> PackageFinder:
    """Return what finds packages for a main file, also in a jail that only they can be read in."""
    finder = PackageFinder(given=given, reach=reach)
    if reach is not None:
        finder.around(os.path.dirname(os.path.abspath(path)))
    return finder


def read_arguments(
    command_line: Sequence[str], variables: Mapping[str, object], *, is_xml: bool
) -> tuple[dict[str, object], dict[str, Span]]:
    """Return the variables passed to the main file, and where each name is written.

    Args:
        command_line: variables as `name:=value`.
        variables: variables as Python objects; they replace those of the command line.
        is_xml: the main file is URDF or xacro, whose arguments are texts.

    Raises:
        UsageError: a `name:=value` is malformed.
    """
    if is_xml:
        values: dict[str, object] = {}
        places: dict[str, Span] = {}
        for argument in command_line:
            name, separator, value = argument.partition(":=")
            if not separator or not name:
                raise UsageError(f"'{argument}' is not of the form name:=value")
            values[name] = value
            places[name] = Span(Source(argument, name=COMMAND_LINE), 0, len(name))
        values.update({name: format_value(value) for name, value in variables.items()})
    else:
        values, places = read_command_line(command_line)
        values.update(variables)
    for name in variables:
        places[name] = Span(Source(f"{name}=…", name=KEYWORD_ARGUMENT), 0, len(name))
    return values, places


def read_command_line(arguments: Sequence[str]) -> tuple[dict[str, object], dict[str, Span]]:
    """Return the variables given as `name:=value`, and where each name stands."""
    values: dict[str, object] = {}
    places: dict[str, Span] = {}
    for argument in arguments:
        name, separator, _ = argument.partition(":=")
        if not separator or not is_identifier(name):
            raise UsageError(f"'{argument}' is not of the form name:=value")
        source = Source(argument, name=COMMAND_LINE)
        node = ScalarNode(argument, PLAIN, source, 0, len(argument))
        reporter = Reporter()
        try:
            context = ParseContext(reporter)
            start = len(name) + 2
            value = parse_inline(node, start, len(argument), context, is_literal=True)
            values[python_name(name)] = plain_data(value)
        except YamaroError as error:
            raise UsageError(f"'{argument}': {error.diagnostics[0].message}") from None
        places[python_name(name)] = Span(source, 0, len(name))
    return values, places
