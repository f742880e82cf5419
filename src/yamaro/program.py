"""A file that can be converted again and again: in this process, or in a jail."""

from __future__ import annotations

import os
import sys

from .arguments import (
    UsageError,
    adjustment_of,
    explains_variables,
    merged_variables,
    read_arguments,
)
from .diagnostics import (
    WARNING,
    Adjustment,
    Reporter,
    YamaroError,
    YamaroWarning,
    failure_of_all,
)
from .files.loader import FileLoader, LoadError
from .files.mesh_files import COPY, NONE, RELATIVE, MeshFinder
from .main_file import finder_for, folder_of, reach_of, read_main, stem_of
from .pipeline import compile_request
from .policy import NO_JAIL, UNSAFE, Policy
from .request import RelativePaths, Request
from .runtime.collector import RareCollection
from .runtime.library import Library, rules_of
from .sandbox.deep_stack import run_on_deep_stack
from .source import Public

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence
    from typing import TypedDict, TypeVar

    from .diagnostics import Diagnostic
    from .files.loader import Loader
    from .files.packages import PackageFinder
    from .files.readable import Reach
    from .result import Build
    from .sandbox.outcome import Outcome
    from .source import Source
    from .targets.assets import Assets
    from .targets.mesh_paths import MeshPaths

    class Targets(TypedDict, total=False):
        """The arguments of `build` that say which formats are written, and how."""

        target: list[str]
        base: str | None
        repair_inertia: bool
        sdf_version: str | None
        meshes: str
        gazebo: bool
        partial: bool

    T = TypeVar("T")
    Say = Callable[[str], None]


class Program(Public):
    """A file that can be converted again and again, with other variables.

    It and the files it includes are read and parsed once, when they are first needed, as are the
    Python modules beside them; changes on the disk are not seen. All else starts again in each
    conversion. Conversions may run in several threads at once.
    """

    __slots__ = (
        "_adjustment",
        "_in_jail",
        "_library",
        "_packages",
        "_path",
        "_policy",
        "_reach",
        "_source",
        "_text",
    )
    _internal = frozenset(("compile", "parse", "request", "xml_and_warnings"))

    def __init__(
        self,
        path: str | os.PathLike[str],
        *,
        text: str | None = None,
        loader: Loader | None = None,
        policy: Policy | None = None,
        packages: Mapping[str, str] | None = None,
        allow: Iterable[str] = (),
        deny: Iterable[str] = (),
    ) -> None:
        """Name the main file; see `yamaro.build`.

        Raises:
            UsageError: `allow` or `deny` names a code that cannot be allowed or denied.
        """
        self._adjustment = adjustment_of(allow, deny)
        self._path = path = os.fspath(path)
        self._text = text
        self._policy = policy or Policy()
        self._packages = dict(packages or {})
        self._reach = self._reach_of(loader)
        self._library = Library(
            loader or FileLoader(self._policy.limits, self._reach), rules_of(self._policy)
        )
        self._source: Source | None = None
        self._in_jail: Program | None = None  # the same file, once safe mode has refused it

    def __repr__(self) -> str:
        return f"<Program {self._path!r}>"

    def _reach_of(self, loader: Loader | None) -> Reach | None:
        """Return what may be read: that of the loader, which packages that are named add to."""
        if isinstance(loader, FileLoader) and loader.reach and not self._policy.is_trusted:
            return loader.reach
        return reach_of(self._path, self._policy, self._packages)

    def parse(self) -> None:
        """Read and parse the main file.

        Raises:
            YamaroError: the file has errors.
            UsageError: it cannot be read.
        """
        source = self._main_file()
        reporter = Reporter()
        if not self._has_jail(source):
            self._run(lambda: self._parse(source, reporter), reporter, source)
            return

        def parse_there(program: Program, say: Say) -> Outcome:
            from .sandbox.outcome import Outcome

            program._parse(source, reporter)
            return Outcome(diagnostics=reporter.diagnostics)

        outcome = self._run_confined(
            parse_there, reporter, source, has_root=False, has_document=False
        )
        if outcome.has_errors:
            raise YamaroError(outcome.diagnostics)

    def _parse(self, source: Source, reporter: Reporter) -> None:
        if source.is_xml:
            from .runtime.xml_includes import read_included

            read_included(source, self._policy.limits)
        else:
            self._library.parse(source, reporter=reporter)

    def convert(
        self,
        /,
        *assignments: str,
        variables: Mapping[str, object] | None = None,
        **named: object,
    ) -> str:
        """Return the XML; see `yamaro.convert`.

        Raises:
            YamaroError: the input has errors.
            ValueError: an assignment is malformed.
        """
        return converted(self, assignments, merged_variables(variables, named))

    @explains_variables("variables={{'{name}': {value}}}")
    def build(
        self,
        *,
        command_line: Sequence[str] = (),
        variables: Mapping[str, object] | None = None,
        strict: bool = False,
        advice: bool = False,
        on_message: Callable[[str], None] | None = None,
        has_root: bool = True,
        output: str | os.PathLike[str] | None = None,
        meshes: str = RELATIVE,
        gazebo: bool = False,
        records: bool = False,
        target: str | Sequence[str] | None = None,
        base: str | None = None,
        repair_inertia: bool = False,
        sdf_version: str | None = None,
        on_progress: Callable[[float], None] | None = None,
        partial: bool = False,
    ) -> Build:
        """Compile the file; see `yamaro.build`.

        Raises:
            YamaroError: the input has errors; it holds them, and the warnings found before.
            UsageError: a `name:=value` is malformed, or the value of another argument.
        """
        request = self.request(
            command_line=command_line, variables=variables, strict=strict, advice=advice,
            output=output, meshes=meshes, gazebo=gazebo, records=records, target=target, base=base,
            repair_inertia=repair_inertia, sdf_version=sdf_version, on_progress=on_progress,
            partial=partial,
        )  # fmt: skip
        return self.compile(request, lambda build: build, say=on_message, has_root=has_root)

    def request(
        self,
        *,
        command_line: Sequence[str] = (),
        variables: Mapping[str, object] | None = None,
        strict: bool = False,
        advice: bool = False,
        output: str | os.PathLike[str] | None = None,
        meshes: str = RELATIVE,
        gazebo: bool = False,
        records: bool = False,
        target: str | Sequence[str] | None = None,
        base: str | None = None,
        repair_inertia: bool = False,
        sdf_version: str | None = None,
        on_progress: Callable[[float], None] | None = None,
        partial: bool = False,
    ) -> Request:
        """Return what `build` compiles with these arguments.

        Raises:
            UsageError: a `name:=value` is malformed, or the value of another argument.
        """
        request = self._request(
            command_line, variables, strict=strict, advice=advice, output=output, meshes=meshes,
            gazebo=gazebo, records=records,
        )  # fmt: skip
        if target is not None:
            from .emission import targets_of

            paths = request.paths
            paths = request.paths = paths.whole() if isinstance(paths, RelativePaths) else paths
            request.is_partial = partial
            request.targets = targets_of(
                target, paths, has_meshes=meshes != NONE, base=base,
                repairs_inertia=repair_inertia, sdf_version=sdf_version,
                output=None if output is None else os.fspath(output), progress=on_progress,
            )  # fmt: skip
        return request

    def xml_and_warnings(
        self, command_line: Sequence[str], variables: Mapping[str, object]
    ) -> tuple[str, list[Diagnostic]]:
        """Compile the file; return the XML and the warnings.

        Raises:
            YamaroError: the input has errors; it holds them, and the warnings found before.
            UsageError: a `name:=value` is malformed.
        """
        request = self._request(command_line, variables)
        return self.compile(request, lambda build: (build.xml(), build.warnings))

    def _request(
        self,
        command_line: Sequence[str],
        variables: Mapping[str, object] | None,
        *,
        strict: bool = False,
        advice: bool = False,
        output: str | os.PathLike[str] | None = None,
        meshes: str = RELATIVE,
        gazebo: bool = False,
        records: bool = False,
    ) -> Request:
        """Return what a build is asked for with; raise UsageError if it makes no sense."""
        source = self._main_file()
        values, places = read_arguments(command_line, variables or {}, is_xml=source.is_xml)
        packages = finder_for(self._path, self._reach, self._packages)
        adjustment = self._adjustment
        if strict:
            adjustment = Adjustment(adjustment.allowed, adjustment.denied, is_strict=True)
        return Request(
            source,
            stem=stem_of(self._path),
            variables=values,
            places=places,
            packages=packages,
            paths=self._mesh_paths(meshes, output, packages),
            reporter=Reporter(),
            adjustment=adjustment,
            has_advice=advice,
            has_gazebo=gazebo,
            records=records,
        )

    def compile(
        self,
        request: Request,
        take: Callable[[Build], T],
        *,
        say: Say | None = None,
        has_root: bool = False,
    ) -> T:
        """Compile the file, see `build`, and return what `take` takes of the result.

        What it does not take is freed in the thread that made it, whose core has it at hand. Out of
        a jail the tree comes only with `has_root`, since that takes time.
        """
        source, reporter = request.source, request.reporter
        say = say or _print_to_standard_error

        def compile_here() -> T:
            return take(self._compiled(request, say))

        try:
            if self._has_jail(source):
                result = take(self._compile_confined(request, say, has_root=has_root))
            else:
                result = self._run(compile_here, reporter, source)
        except YamaroError as error:
            from .allowances import accept, set_aside

            accept([each for each in error.diagnostics if each.severity == WARNING])
            error.accepted = set_aside(error.diagnostics)
            request.adjustment.deny(error.diagnostics)
            raise
        if request.adjustment.deny(reporter.diagnostics):
            raise YamaroError(reporter.diagnostics)
        return result

    def _compiled(self, request: Request, say: Say) -> Build:
        """Return what is built of a request, in this process."""
        if not request.targets:
            build = compile_request(request, self._library, self._policy, say)
        else:
            from .emission import compile_targets

            build = compile_targets(request, self._library, self._policy, say)
        if build.warnings or request.source.has_remarks:
            from .allowances import accept, report_unused, set_aside

            found = request.reporter
            accept(found.diagnostics)
            wants = request.wanted_advice()
            if wants is not None and wants("unused-allow"):
                report_unused(request.source, found, request.looks_for)
                accept(found.diagnostics)
            build.accepted = set_aside(found.diagnostics)
        return build

    def _compile_confined(self, request: Request, say: Say, *, has_root: bool) -> Build:
        """Return the build that came out of a jail.

        Raises:
            YamaroError: the input has errors.
        """
        from .confined import build_of_outcome, outcome_of_build

        def compile_there(program: Program, say: Say) -> Outcome:
            build = program._compiled(request, say)
            return outcome_of_build(build, has_root=has_root)

        reporter = request.reporter
        outcome = self._run_confined(compile_there, reporter, request.source, has_root=has_root)
        for line in outcome.messages:
            say(line)
        accepted: list[Diagnostic] = []
        if not outcome.has_errors and outcome.diagnostics:
            from .allowances import set_aside

            accepted = set_aside(outcome.diagnostics)
        for diagnostic in outcome.diagnostics:
            reporter.add(diagnostic)
        if outcome.has_errors:
            raise YamaroError(reporter.diagnostics)
        build = build_of_outcome(outcome, request, self._policy)
        build.accepted = accepted
        return build

    def _mesh_paths(
        self, mode: str, output: str | os.PathLike[str] | None, packages: PackageFinder
    ) -> MeshPaths | RelativePaths:
        """Return how the output names meshes; raise UsageError if it cannot as asked."""
        start = folder_of(self._path)
        folder = start if output is None else os.path.dirname(os.path.abspath(output))
        if output is not None and not os.path.basename(output):
            folder = os.path.abspath(output)
        finder = MeshFinder(packages, self._reach, start=start)
        if mode == COPY and output is None:
            raise UsageError(
                "'copy' needs an output file (-o FILE); the meshes are copied beside it"
            )

        def run(work: Callable[[], bytes]) -> bytes:
            from .confined import Reader

            if self._policy.is_confined:
                return work()
            return Reader(self._policy, readable=finder.roots, name=self._path).run(work)

        is_cached = self._policy.is_trusted  # others change nothing on the disk
        if mode == RELATIVE:
            return RelativePaths(folder, finder, run, is_cached=is_cached)
        from .targets.mesh_paths import MeshPaths

        assets: Assets | None = None
        if mode == COPY:
            from .targets.assets import Assets

            assets = Assets(finder, run)
        try:
            return MeshPaths(mode, folder, finder, assets, run=run, is_cached=is_cached)
        except ValueError as error:
            raise UsageError(str(error)) from None

    def _main_file(self) -> Source:
        if self._source is None:
            self._source = read_main(self._path, self._text, self._library)
        return self._source

    def _has_jail(self, source: Source) -> bool:
        """Return whether to run the file in a jail; raise YamaroError if that is asked in vain."""
        if self._policy.is_trusted:
            return False
        from .confined import has_jail

        return has_jail(self._policy, source.name)

    def _run(self, function: Callable[[], T], reporter: Reporter, source: Source) -> T:
        """Return what `function` returns; an error it raises holds the warnings as well."""

        def run() -> T:
            try:
                if self._policy.timeout is None:
                    return function()
                from .confined import run_in_time

                return run_in_time(function, self._policy, source.name)
            except MemoryError:
                hint = self._policy.limits.hint("memory")
                message = "there is not enough memory for this file"
                raise failure_of_all("limit-memory", message, source.name, hint) from None

        try:
            with RareCollection():
                return run_on_deep_stack(run)
        except YamaroError as error:
            raise YamaroError([*reporter.diagnostics, *error.diagnostics]) from None

    def _run_confined(
        self,
        work: Callable[[Program, Say], Outcome],
        reporter: Reporter,
        source: Source,
        *,
        has_root: bool,
        has_document: bool = True,
    ) -> Outcome:
        """Return the result of a conversion that is run in a jail, in safe mode if that will do."""

        def run(program: Program) -> Outcome:
            return program._confined(
                work, reporter, source, has_root=has_root, has_document=has_document
            )

        program = self._in_jail or self
        outcome = run(program)
        fallback = program._policy.fallback
        if fallback is None or not any(one.code == UNSAFE for one in outcome.diagnostics):
            return outcome
        program = Program(
            self._path, loader=self._library.loader, policy=fallback, packages=self._packages
        )
        try:
            in_jail = run(program)
        except YamaroError as error:
            if any(one.code == NO_JAIL for one in error.diagnostics):
                return outcome
            raise
        self._in_jail = program
        return in_jail

    def _confined(
        self,
        work: Callable[[Program, Say], Outcome],
        reporter: Reporter,
        source: Source,
        *,
        has_root: bool,
        has_document: bool,
    ) -> Outcome:
        """Return the result of a conversion that is run in a jail, under the policy of this one."""
        from .confined import run_confined
        from .sandbox.outcome import Outcome

        def work_there(say: Say) -> Outcome:
            try:
                return self._run(lambda: work(self, say), reporter, source)
            except YamaroError as error:
                return Outcome(diagnostics=error.diagnostics)

        assert self._reach is not None
        return run_confined(
            work_there,
            policy=self._policy,
            reach=self._reach,
            name=source.name,
            has_root=has_root,
            has_document=has_document,
        )


def converted(program: Program, assignments: Sequence[str], variables: Mapping[str, object]) -> str:
    """Return the XML; issue the warnings at the line that called our caller."""
    try:
        xml, found = program.xml_and_warnings(assignments, variables)
    except UsageError as error:
        raise as_built_in(error) from None
    if found:
        import warnings

        for diagnostic in found:
            warnings.warn(str(YamaroError([diagnostic])), YamaroWarning, stacklevel=3)
    return xml


def as_built_in(error: UsageError) -> Exception:
    """Return the exception of Python's own that says the same."""
    is_missing = isinstance(error.__cause__, LoadError)
    return FileNotFoundError(str(error)) if is_missing else ValueError(str(error))


def _print_to_standard_error(text: str) -> None:
    from .terminal import harmless

    print(harmless(text), file=sys.stderr)
