"""A file that can be converted again and again: in this process, or in a jail."""

from __future__ import annotations

import os
import sys

from .diagnostics import WARNING, Reporter, YamaroError, YamaroWarning, failure_of_all
from .files.loader import FileLoader, LoadError
from .options import OF_FILES, Options, UsageError, explains_variables, merged_variables
from .pipeline import run_pipeline
from .policy import NO_JAIL, UNSAFE
from .request import Request, main_path, reach_of, read_main
from .runtime.files import Library, rules_of
from .sandbox.deep_stack import run_on_deep_stack
from .sandbox.process import RareCollection
from .source import Public

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from typing import TypeVar

    from typing_extensions import Unpack

    from .diagnostics import Diagnostic
    from .files.readable import Reach
    from .options import AllOptions, BuildOptions
    from .result import Build
    from .sandbox.transfer import Outcome
    from .source import Source

    T = TypeVar("T")
    Say = Callable[[str], None]


class Program(Public):
    """A file that can be converted again and again, with other variables.

    It and the files it includes are read and parsed once, when they are first needed, as are the
    Python modules beside them; changes on the disk are not seen. All else starts again in each
    conversion. Conversions may run in several threads at once.

    Attributes:
        path: that of the main file.
        options: those of its builds, as far as a build has no others.
    """

    __slots__ = ("_in_jail", "_library", "_reach", "_source", "options", "path")
    _internal = frozenset(("compile", "options", "parse", "path"))

    def __init__(
        self,
        path: str | os.PathLike[str],
        options: Options | None = None,
        /,
        **keywords: Unpack[AllOptions],
    ) -> None:
        """Name the main file; see `yamaro.build`.

        Raises:
            UsageError: an option makes no sense, such as a code that cannot be allowed or denied.
        """
        self.options = options = options or Options(**keywords)
        self.path = path = main_path(os.fspath(path), options.packages or {})
        policy, loader = options.policy, options.loader
        self._reach: Reach | None
        if isinstance(loader, FileLoader) and loader.reach and not policy.is_trusted:
            self._reach = loader.reach  # which packages that are named add to
        else:
            self._reach = reach_of(path, policy, options.packages)
        loader = loader or FileLoader(policy.limits, self._reach)
        self._library = Library(loader, rules_of(policy))
        self._source: Source | None = None
        self._in_jail: Program | None = None  # the same file, once safe mode has refused it

    def __repr__(self) -> str:
        return f"<Program {self.path!r}>"

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
            from .sandbox.transfer import Outcome

            program._parse(source, reporter)
            return Outcome(diagnostics=reporter.diagnostics)

        outcome = self._run_confined(
            parse_there, reporter, source, has_root=False, has_document=False
        )
        if outcome.has_errors:
            raise YamaroError(outcome.diagnostics)

    def _parse(self, source: Source, reporter: Reporter) -> None:
        if source.is_xml:
            from .runtime.xml_files import read_included

            read_included(source, self.options.policy.limits)
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
    def build(self, **options: Unpack[BuildOptions]) -> Build:
        """Compile the file; see `yamaro.build`.

        Raises:
            YamaroError: the input has errors; it holds them, and the warnings found before.
            UsageError: a `name:=value` is malformed, or the value of another argument.
        """
        for name in OF_FILES:
            if name in options:
                raise TypeError(f"'{name}' holds for all builds of a program: pass it to load()")
        return self.compile(self.options.changed(**options), lambda build: build)

    def compile(self, options: Options, take: Callable[[Build], T]) -> T:
        """Compile the file, and return what `take` takes of the result.

        What it does not take is freed in the thread that made it, whose core has it at hand. Out of
        a jail the tree comes only with `has_root`, since that takes time.
        """
        source, policy = self._main_file(), self.options.policy
        if self._reach is not None:  # who names an overlay lets it be read
            named = [each for each in options.overlay if isinstance(each, str)]
            self._reach.also_allow([os.path.realpath(each) for each in named])

        def run_reader(work: Callable[[], bytes]) -> bytes:
            if policy.is_confined:
                return work()
            from .confined import Reader

            return Reader(policy, readable=request.finder.roots, name=self.path).run(work)

        request = Request(self.path, source, options, reach=self._reach, run=run_reader)
        say, reporter = options.on_message or _print_to_standard_error, request.reporter
        try:
            if self._has_jail(source):
                result = take(self._compile_confined(request, say))
            else:
                result = self._run(lambda: take(self._compiled(request, say)), reporter, source)
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
        build = run_pipeline(request, self._library, self.options.policy, say)
        if build.warnings or request.source.has_remarks:
            from .allowances import accept, report_unused, set_aside

            found = request.reporter
            accept(found.diagnostics)
            wants = request.options.wanted_advice()
            if wants is not None and wants("unused-allow"):
                report_unused(request.source, found, request.looks_for)
                accept(found.diagnostics)
            build.accepted = set_aside(found.diagnostics)
        return build

    def _compile_confined(self, request: Request, say: Say) -> Build:
        """Return the build that came out of a jail.

        Raises:
            YamaroError: the input has errors.
        """
        from .jailed_builds import build_of_outcome, outcome_of_build

        has_root = request.options.has_root

        def compile_there(program: Program, say: Say) -> Outcome:
            return outcome_of_build(program._compiled(request, say), has_root=has_root)

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
        build = build_of_outcome(outcome, request, self.options.policy)
        build.accepted = accepted
        return build

    def _main_file(self) -> Source:
        if self._source is None:
            self._source = read_main(self.path, self.options.text, self._library)
        return self._source

    def _has_jail(self, source: Source) -> bool:
        """Return whether to run the file in a jail; raise YamaroError if that is asked in vain."""
        if self.options.policy.is_trusted:
            return False
        from .confined import has_jail

        return has_jail(self.options.policy, source.name)

    def _run(self, function: Callable[[], T], reporter: Reporter, source: Source) -> T:
        """Return what `function` returns; an error it raises holds the warnings as well."""
        policy = self.options.policy

        def run() -> T:
            try:
                if policy.timeout is None:
                    return function()
                from .confined import run_in_time

                return run_in_time(function, policy, source.name)
            except MemoryError:
                hint = policy.limits.hint("memory")
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
        from .confined import run_confined
        from .sandbox.transfer import Outcome

        def run(program: Program) -> Outcome:
            def work_there(say: Say) -> Outcome:
                try:
                    return program._run(lambda: work(program, say), reporter, source)
                except YamaroError as error:
                    return Outcome(diagnostics=error.diagnostics)

            assert program._reach is not None
            return run_confined(
                work_there,
                policy=program.options.policy,
                reach=program._reach,
                name=source.name,
                has_root=has_root,
                has_document=has_document,
            )

        program = self._in_jail or self
        outcome = run(program)
        fallback = program.options.policy.fallback
        if fallback is None or not any(one.code == UNSAFE for one in outcome.diagnostics):
            return outcome
        options = self.options.changed(loader=self._library.loader, policy=fallback)
        program = Program(self.path, options)
        try:
            in_jail = run(program)
        except YamaroError as error:
            if any(one.code == NO_JAIL for one in error.diagnostics):
                return outcome
            raise
        self._in_jail = program
        return in_jail


def converted(program: Program, assignments: Sequence[str], variables: Mapping[str, object]) -> str:
    """Return the XML; issue the warnings at the line that called our caller."""
    found: list[Diagnostic]
    try:
        options = program.options.changed(
            command_line=assignments, variables=variables, has_root=False, alone=True
        )
        xml, found = program.compile(options, lambda build: (build.xml(), build.warnings))
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
