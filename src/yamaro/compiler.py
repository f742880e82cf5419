"""The pipeline: read → parse → evaluate → lower → check → write."""

from __future__ import annotations

import os
import sys

from .diagnostics import (
    INHERITED,
    Adjustment,
    Diagnostic,
    Reporter,
    YamaroError,
    YamaroWarning,
)
from .files.loader import FileLoader, LoadError
from .files.mesh_files import MeshFinder
from .files.packages import PackageFinder
from .policy import NO_JAIL, UNSAFE, Limits, Policy
from .runtime.collector import RareCollection
from .runtime.interpreter import Interpreter
from .runtime.library import Library, rules_of
from .runtime.predefined import plain_data
from .runtime.unread import warn_of_unread, warn_of_unread_includes
from .sandbox.deadline import TimeOver, run_within
from .sandbox.deep_stack import run_on_deep_stack
from .source import (
    COMMAND_LINE,
    KEYWORD_ARGUMENT,
    STANDARD_INPUT,
    STANDARD_INPUT_NAME,
    Source,
    Span,
)
from .syntax.context import ParseContext
from .syntax.includes import holds_xml
from .syntax.names import is_identifier, python_name
from .syntax.values import parse_inline
from .targets.mesh_paths import COPY, RELATIVE, MeshPaths
from .terminal import harmless
from .xml.tree import Element, format_value, unshared, write_pieces
from .yaml.nodes import PLAIN, ScalarNode

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
    from typing import TypeVar

    from .files.loader import Loader
    from .files.readable import Reach
    from .sandbox.transfer import Outcome
    from .targets.assets import Assets

    T = TypeVar("T")
    from .xml.tree import Shared


class UsageError(Exception):
    """The command was used wrongly: the main file is missing, or an argument is malformed."""


PIECES_IN_CHUNK = 10_000
"""Pieces of text, of some dozens of characters each, that are written at a time."""


class Build:
    """A finished robot or other document."""

    __slots__ = (
        "_find_assets",
        "_find_meshes",
        "_make_root",
        "_pieces",
        "_root",
        "files",
        "finder",
        "warnings",
    )

    def __init__(
        self,
        make_root: Callable[[], Element],
        find_meshes: Callable[[], list[str]],
        *,
        paths: MeshPaths,
        pieces: list[str],
        warnings: list[Diagnostic],
        files: list[str],
    ) -> None:
        """Hold the results of a build.

        Args:
            make_root: makes the finished tree, each element traced to its origin.
            find_meshes: gives the meshes referred to.
            paths: tells where the file of a mesh is, and how it is named.
            pieces: the document, in pieces.
            warnings: what was noticed, in order.
            files: the absolute path of every file read, in order.
        """
        self._make_root = make_root
        self._find_meshes = find_meshes
        self._root: Element | None = None
        self._pieces = pieces
        self._find_assets = paths.assets
        self.finder = paths.finder
        self.warnings = warnings
        self.files = files

    @property
    def meshes(self) -> list[str]:
        """Return the meshes referred to: absolute paths, or as written if not found."""
        return self._find_meshes()

    @property
    def assets(self) -> dict[str, bytes]:
        """Return what belongs beside the output with `meshes="copy"`, by paths relative to it.

        Raises:
            OSError: a mesh cannot be read any more.
        """
        return self._find_assets.of(self.meshes) if self._find_assets else {}

    @property
    def root(self) -> Element:
        """Return the root element; every element tells where in the YAML it was made."""
        if self._root is None:
            self._root = self._make_root()
        return self._root

    def xml(self) -> str:
        """Return the document as text."""
        if len(self._pieces) > 1:
            self._pieces = ["".join(self._pieces)]
        return self._pieces[0]

    def encoded(self) -> Iterator[bytes]:
        """Give the document in UTF-8, chunk by chunk: a long one is never in memory as a whole."""
        for start in range(0, len(self._pieces), PIECES_IN_CHUNK):
            yield "".join(self._pieces[start : start + PIECES_IN_CHUNK]).encode()


class Program:
    """A file that can be converted again and again, with other variables.

    It and the files it includes are read and parsed once, when they are first needed, as are the
    Python modules beside them; changes on the disk are not seen. All else begins anew in each
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
        self._reach = reach_of(path, self._policy, self._packages)
        self._library = Library(
            loader or FileLoader(self._policy.limits, self._reach), rules_of(self._policy)
        )
        self._source: Source | None = None
        self._in_jail: Program | None = None  # the same file, once safe mode has refused it

    def parse(self) -> None:
        """Read and parse the main file.

        Raises:
            YamaroError: the file has errors.
            UsageError: it cannot be read.
        """
        source = self._main_file()
        reporter = Reporter()

        if self._has_jail(source):

            def parse_there(program: Program, say: Callable[[str], None]) -> None:
                program._parse(source, reporter)

            outcome = self._run_confined(
                parse_there, reporter, source, has_root=False, has_document=False
            )
            if outcome.has_errors:
                raise YamaroError(outcome.diagnostics)
            return
        self._run(lambda: self._parse(source, reporter), reporter, source)

    def _parse(self, source: Source, reporter: Reporter) -> None:
        if source.is_xml:
            from .runtime.xml_includes import read_included

            read_included(source, self._policy.limits)
        else:
            self._library.parse(source, reporter=reporter)

    def convert(self, /, *assignments: str, **variables: object) -> str:
        """Return the XML; see `yamaro.convert`.

        Raises:
            YamaroError: the input has errors.
            ValueError: an assignment is malformed.
        """
        return _converted(self, assignments, variables)

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
    ) -> Build:
        """Compile the file; see `yamaro.build`.

        Raises:
            YamaroError: the input has errors; it holds them, and the warnings found before.
            UsageError: a `name:=value` or `meshes` is malformed.
        """
        return self._compile(
            command_line,
            variables or {},
            strict=strict,
            advice=advice,
            on_message=on_message,
            take=lambda build: build,
            has_root=has_root,
            output=output,
            meshes=meshes,
        )

    def _compile(
        self,
        command_line: Sequence[str],
        variables: Mapping[str, object],
        *,
        take: Callable[[Build], T],
        has_root: bool = False,
        strict: bool = False,
        advice: bool = False,
        on_message: Callable[[str], None] | None = None,
        output: str | os.PathLike[str] | None = None,
        meshes: str = RELATIVE,
    ) -> T:
        """Compile the file, see `build`, and return what `take` takes of the result.

        What it does not take is freed in the thread that made it, whose core has it at hand. Out of
        a jail the tree comes only with `has_root`, since that takes time.
        """
        evaluate = self._evaluation(command_line, variables)
        packages = finder_for(self._path, self._reach, self._packages)
        paths = self._mesh_paths(meshes, output, packages)
        source = self._main_file()
        reporter = Reporter()
        adjustment = self._adjustment
        if strict:
            adjustment = Adjustment(adjustment.allowed, adjustment.denied, is_strict=True)

        def compile_robot(program: Program, say: Callable[[str], None]) -> Build:
            interpreter = Interpreter(
                library=program._library,
                reporter=reporter,
                on_message=say,
                policy=program._policy,
                packages=packages,
            )
            evaluated = evaluate(source, interpreter, reporter)
            return _finish(
                evaluated, interpreter, reporter, advice=advice, adjustment=adjustment, paths=paths
            )

        say = on_message or _print_to_standard_error
        try:
            if self._has_jail(source):
                outcome = self._run_confined(compile_robot, reporter, source, has_root=has_root)
                for line in outcome.messages:
                    say(line)
                for diagnostic in outcome.diagnostics:
                    reporter.add(diagnostic)
                if outcome.has_errors:
                    raise YamaroError(reporter.diagnostics)
                if outcome.root is not None and outcome.root.name == "robot":  # as it was written
                    tree = paths.applied_to(outcome.root, {})
                    outcome.pieces = write_pieces(*tree, self._policy.limits)
                result = take(_build_of(outcome, paths))
            else:
                result = self._run(lambda: take(compile_robot(self, say)), reporter, source)
        except YamaroError as error:
            adjustment.deny(error.diagnostics)
            raise
        if adjustment.deny(reporter.diagnostics):
            raise YamaroError(reporter.diagnostics)
        return result

    def _mesh_paths(
        self, mode: str, output: str | os.PathLike[str] | None, packages: PackageFinder
    ) -> MeshPaths:
        """Return how the output names meshes; raise UsageError if it cannot as asked."""
        start = _folder_of(self._path)
        folder = start if output is None else _folder_of(os.fspath(output))
        finder = MeshFinder(packages, self._reach, start=start)
        if mode == COPY and output is None:
            raise UsageError("'copy' needs an output file (-o FILE): the meshes go beside it")
        try:
            return MeshPaths(mode, folder, finder, self._assets(finder) if mode == COPY else None)
        except ValueError as error:
            raise UsageError(str(error)) from None

    def _assets(self, finder: MeshFinder) -> Assets:
        """Return the copies of meshes, which are looked into in a jail if they are not trusted."""
        from .confined import Reader
        from .targets.assets import Assets

        def run(work: Callable[[], bytes]) -> bytes:
            if self._policy.is_confined:
                return work()
            return Reader(self._policy, readable=finder.roots, name=self._path).run(work)

        return Assets(finder, run)

    def _evaluation(
        self, command_line: Sequence[str], variables: Mapping[str, object]
    ) -> Callable[[Source, Interpreter, Reporter], Element]:
        """Return what evaluates the main file; raise UsageError if a `name:=value` is malformed."""
        if self._main_file().is_xml:
            arguments = _read_xacro_arguments(command_line, variables)

            def evaluate_xml(
                source: Source, interpreter: Interpreter, reporter: Reporter
            ) -> Element:
                from .runtime.xml_main import run_xml_main

                places = _places_of(command_line) | _places_of_keywords(variables)
                root, is_xacro = run_xml_main(source, interpreter, arguments, places, reporter)
                if not is_xacro:
                    warn_of_unread(places, interpreter.files, reporter)
                return root

            return evaluate_xml
        passed, places = read_command_line(command_line)
        passed.update(variables)
        places.update(_places_of_keywords(variables))

        def evaluate(source: Source, interpreter: Interpreter, reporter: Reporter) -> Element:
            evaluated = interpreter.run_main(
                source, stem=_stem(self._path), variables=passed, places=places
            )
            warn_of_unread(places, interpreter.files, reporter)
            warn_of_unread_includes(interpreter.passed.values(), interpreter.files, reporter)
            return evaluated

        return evaluate

    def _main_file(self) -> Source:
        if self._source is None:
            self._source = _read_main(self._path, self._text, self._library)
        return self._source

    def _has_jail(self, source: Source) -> bool:
        """Tell whether to run the file in a jail; raise YamaroError if that is asked in vain."""
        if self._policy.is_trusted:
            return False
        from .confined import has_jail

        return has_jail(self._policy, source.name)

    def _run(self, function: Callable[[], T], reporter: Reporter, source: Source) -> T:
        """Return what `function` returns; an error it raises holds the warnings as well."""

        def run() -> T:
            try:
                return run_within(self._policy.timeout, function)
            except TimeOver:
                from .confined import time_is_over

                raise time_is_over(source.name, self._policy) from None
            except MemoryError:
                from .confined import failure_of_all

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
        compile_robot: Callable[[Program, Callable[[str], None]], Build | None],
        reporter: Reporter,
        source: Source,
        *,
        has_root: bool,
        has_document: bool = True,
    ) -> Outcome:
        """Return what comes of a conversion that is run in a jail, in safe mode if that will do."""

        def run(program: Program) -> Outcome:
            return program._confined(
                compile_robot, reporter, source, has_root=has_root, has_document=has_document
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
        compile_robot: Callable[[Program, Callable[[str], None]], Build | None],
        reporter: Reporter,
        source: Source,
        *,
        has_root: bool,
        has_document: bool,
    ) -> Outcome:
        """Return what comes of a conversion that is run in a jail, under the policy of this one."""
        from .confined import run_confined
        from .sandbox.transfer import Outcome

        def work(say: Callable[[str], None]) -> Outcome:
            def run() -> Outcome:
                build = compile_robot(self, say)
                if build is None:
                    return Outcome(diagnostics=reporter.diagnostics)
                return Outcome(
                    diagnostics=build.warnings,
                    pieces=build._pieces,
                    files=build.files,
                    meshes=build.meshes,
                    root=build.root if has_root else None,
                )

            try:
                return self._run(run, reporter, source)
            except YamaroError as error:
                return Outcome(diagnostics=error.diagnostics)

        assert self._reach is not None
        return run_confined(
            work,
            policy=self._policy,
            readable=self._reach.roots,
            name=source.name,
            has_root=has_root,
            has_document=has_document,
        )


def build(
    path: str | os.PathLike[str],
    *,
    command_line: Sequence[str] = (),
    variables: Mapping[str, object] | None = None,
    text: str | None = None,
    strict: bool = False,
    advice: bool = False,
    on_message: Callable[[str], None] | None = None,
    loader: Loader | None = None,
    policy: Policy | None = None,
    packages: Mapping[str, str] | None = None,
    has_root: bool = True,
    output: str | os.PathLike[str] | None = None,
    meshes: str = RELATIVE,
    allow: Iterable[str] = (),
    deny: Iterable[str] = (),
) -> Build:
    """Compile a file.

    Args:
        path: the main file: YAML, or by its ending a URDF, a robot in xacro or other XML; "-" with
            `text` for a text that is in no file.
        command_line: variables as `name:=value`, the value in YAML.
        variables: variables as Python objects.
        text: what to compile in place of the content of `path`.
        strict: raise warnings as errors.
        advice: also warn of what is legal but seldom meant.
        on_message: takes each line that `print` and `process` print; standard error by default.
        loader: gives the text of files; the disk by default.
        policy: how far the file is trusted; in full by default.
        packages: folders of ROS packages by name, before those that are found.
        has_root: without, there may be no tree in the end, which spares taking it out of a jail.
        output: where the XML is to be written; relative paths of meshes start at its folder. By
            default at that of the main file.
        meshes: how the XML names meshes and textures that are there: "relative", "keep" (as they
            are written), "absolute", "copy" (the files of `Build.assets`, which are not written),
            "package://NAME", or "none", without shapes that are meshes.
        allow: codes of diagnostics that are warnings, also with `strict`.
        deny: codes of diagnostics that are errors.

    Raises:
        YamaroError: the input has errors; it holds them, and the warnings found before.
        UsageError: the main file cannot be read, a `name:=value` or `meshes` is malformed, or a
            code of `allow` or `deny` is unknown or always an error.
    """
    program = Program(
        path,
        text=text,
        loader=loader,
        policy=policy,
        packages=packages,
        allow=allow,
        deny=deny,
    )
    return program.build(
        command_line=command_line,
        variables=variables,
        strict=strict,
        advice=advice,
        on_message=on_message,
        has_root=has_root,
        output=output,
        meshes=meshes,
    )


def adjustment_of(
    allow: Iterable[str], deny: Iterable[str], *, is_strict: bool = False
) -> Adjustment:
    """Return which codes are allowed and denied; a lone text is one code.

    Raises:
        UsageError: a code is unknown, always an error, or both allowed and denied.
    """
    allowed = frozenset([allow] if isinstance(allow, str) else allow)
    denied = frozenset([deny] if isinstance(deny, str) else deny)
    if allowed or denied:
        from .codes import fault_of_codes

        fault = fault_of_codes(allowed, denied)
        if fault is not None:
            raise UsageError(fault)
    return Adjustment(allowed, denied, is_strict=is_strict)


def reach_of(path: str, policy: Policy, packages: Mapping[str, str]) -> Reach | None:
    """Return what a main file may read, or None for anything."""
    if policy.is_trusted:
        return None
    from .files.readable import Reach, roots_of

    allowed = [*policy.allowed_paths, *packages.values()]
    return Reach(roots_of(os.path.abspath(path), allowed, PackageFinder()))


def finder_for(path: str, reach: Reach | None, given: Mapping[str, str]) -> PackageFinder:
    """Return what finds packages for a main file, also in a jail that only they can be read in."""
    finder = PackageFinder(given=given)
    if reach is not None:
        finder.around(os.path.dirname(os.path.abspath(path)))
    return finder


def _build_of(outcome: Outcome, paths: MeshPaths) -> Build:
    """Return the build that came out of a jail."""

    def make_root() -> Element:
        assert outcome.root is not None, "only those who need the tree ask for it"
        return outcome.root

    return Build(
        make_root,
        lambda: outcome.meshes,
        paths=paths,
        pieces=outcome.pieces,
        warnings=outcome.diagnostics,
        files=outcome.files,
    )


def _finish(
    evaluated: Element,
    interpreter: Interpreter,
    reporter: Reporter,
    *,
    advice: bool,
    adjustment: Adjustment,
    paths: MeshPaths,
) -> Build:
    """Lower, check and write what was evaluated.

    An element that stands in several places cannot tell which calls led to each of them. So if
    there is something to tell about one, all is done again with an element for each place.

    Raises:
        YamaroError: lowering or the check found errors.
    """
    finder = paths.finder
    limits = interpreter.limits
    has_parts, shared = interpreter.has_parts, interpreter.builder.shared
    wanted = _wanted_advice(advice, adjustment)

    def complete(tree: Element, shared: Shared) -> _Completed:
        return _complete(
            tree,
            shared,
            paths,
            limits,
            has_parts=has_parts,
            is_yaml=interpreter.is_yaml,
            advice=wanted,
        )

    found = complete(evaluated, shared)
    if any(diagnostic.trace is INHERITED for diagnostic in found.diagnostics):
        if interpreter.has_frames:
            found = complete(unshared(evaluated), {})
        else:
            for diagnostic in found.diagnostics:
                diagnostic.trace = None
    finished = found.root
    if finished is not None:
        adjustment.allow(found.diagnostics)
    else:
        from .runtime.origins import add_origins

        for diagnostic in found.diagnostics:
            add_origins(diagnostic, interpreter.files, interpreter.places)
    if finished is None or adjustment.deny(found.diagnostics):
        raise YamaroError(found.diagnostics)
    for diagnostic in found.diagnostics:
        reporter.add(diagnostic)

    def make_root() -> Element:
        root = unshared(evaluated)
        if has_parts:
            from .robot.part import lower

            root = lower(
                root,
                reporter=Reporter(),
                resolve_mesh=finder.resolve,
                may_read=finder.allows,
                shared={},
            )
        return _put_together(root) if interpreter.is_yaml else root

    return Build(
        make_root,
        lambda: finder.referred_to(finished),
        paths=paths,
        pieces=found.pieces,
        warnings=reporter.diagnostics,
        files=list(interpreter.files.read),
    )


def _put_together(root: Element) -> Element:
    """Return a robot of several files, in which the names of materials do not clash."""
    if root.name != "robot" or not any(
        isinstance(child, Element) and (child.name == "material" or child.body is not None)
        for child in root.children
    ):
        return root
    from .robot.material_names import settle_materials

    return settle_materials(root)


def _wanted_advice(advice: bool, adjustment: Adjustment) -> Callable[[str], bool] | None:
    """Return what tells which codes of advice to report, or None if no advice is asked for."""
    if advice:
        return lambda code: True
    return adjustment.denied.__contains__ if adjustment.denied else None


class _Completed:
    """A document that is lowered, checked and written, or None with the errors that forbid it."""

    __slots__ = ("diagnostics", "pieces", "root")

    def __init__(
        self, root: Element | None, pieces: list[str], diagnostics: list[Diagnostic]
    ) -> None:
        self.root = root
        self.pieces = pieces
        self.diagnostics = diagnostics


def _complete(
    evaluated: Element,
    shared: Shared,
    paths: MeshPaths,
    limits: Limits,
    *,
    has_parts: bool,
    is_yaml: bool,
    advice: Callable[[str], bool] | None,
) -> _Completed:
    """Lower, check and write; of the advice, tell what has a code that `advice` wants."""
    reporter, finder = Reporter(), paths.finder
    try:
        root, has_files = evaluated, False
        if has_parts:
            from .robot.part import lower

            root = lower(
                root,
                reporter=reporter,
                resolve_mesh=finder.resolve,
                may_read=finder.allows,
                shared=shared,
            )
        if is_yaml:
            root = _put_together(root)
        if root.name == "robot":
            from .check.robot import check

            advisor = Reporter() if advice else None
            has_files = check(
                root,
                reporter=reporter,
                resolve_mesh=finder.resolve,
                places_searched=finder.places_searched,
                path_meant=finder.path_meant,
                advice=advisor,
                shared=shared,
            )
            for diagnostic in advisor.diagnostics if advisor else ():
                if advice is not None and advice(diagnostic.code):
                    reporter.add(diagnostic)
        elif root.span.source.is_xml:
            from .check.robot import check_format

            check_format(root, reporter)
        written = paths.applied_to(root, shared) if has_files else (root, shared)
        return _Completed(root, write_pieces(*written, limits), reporter.diagnostics)
    except YamaroError as error:
        return _Completed(None, [], [*reporter.diagnostics, *error.diagnostics])


def convert(
    path: str | os.PathLike[str],
    /,
    *assignments: str,
    allow: Iterable[str] = (),
    deny: Iterable[str] = (),
    **variables: object,
) -> str:
    """Compile a file and return the XML.

    What the file prints goes to standard error; warnings are issued as `YamaroWarning`.

    Args:
        path: the main file: YAML, a URDF or a robot in xacro.
        assignments: variables of the main file, or arguments of xacro, as on the command line:
            `"length:=2"`.
        allow: codes of diagnostics that are warnings.
        deny: codes of diagnostics that are errors.
        variables: the same as Python objects: `width=0.3`.

    Raises:
        YamaroError: the input has errors.
        OSError: the main file cannot be read.
        ValueError: an assignment is malformed.
    """
    if isinstance(variables.get("policy"), Policy):
        raise TypeError("convert() takes no policy: write load(path, policy=policy).convert(…)")
    try:
        program = Program(path, allow=allow, deny=deny)
    except UsageError as error:
        raise _as_built_in(error) from None
    return _converted(program, assignments, variables)


def load(
    path: str | os.PathLike[str],
    *,
    loader: Loader | None = None,
    policy: Policy | None = None,
    packages: Mapping[str, str] | None = None,
    allow: Iterable[str] = (),
    deny: Iterable[str] = (),
) -> Program:
    """Return a program that converts a file again and again.

    Args:
        path: the main file.
        loader: gives the text of files; the disk by default.
        policy: how far the file is trusted; in full by default.
        packages: folders of ROS packages by name, before those that are found.
        allow: codes of diagnostics that are warnings in all conversions.
        deny: codes of diagnostics that are errors in all conversions.

    Raises:
        YamaroError: the main file has errors, which are found without running it.
        OSError: the main file cannot be read.
        ValueError: a code of `allow` or `deny` is unknown or always an error.
    """
    import threading  # noqa: F401 - lets `deep_stack` keep its thread for the next conversion

    try:
        program = Program(
            path, loader=loader, policy=policy, packages=packages, allow=allow, deny=deny
        )
        program.parse()
    except UsageError as error:
        raise _as_built_in(error) from None
    return program


def _converted(
    program: Program, assignments: Sequence[str], variables: Mapping[str, object]
) -> str:
    """Return the XML; issue the warnings in the name of whoever called our caller."""
    try:
        xml, found = program._compile(assignments, variables, take=_xml_and_warnings)
    except UsageError as error:
        raise _as_built_in(error) from None
    if found:
        import warnings

        for diagnostic in found:
            warnings.warn(str(YamaroError([diagnostic])), YamaroWarning, stacklevel=3)
    return xml


def _xml_and_warnings(build: Build) -> tuple[str, list[Diagnostic]]:
    return build.xml(), build.warnings


def _as_built_in(error: UsageError) -> Exception:
    """Return the exception of Python's own that says the same."""
    is_missing = isinstance(error.__cause__, LoadError)
    return FileNotFoundError(str(error)) if is_missing else ValueError(str(error))


def _print_to_standard_error(text: str) -> None:
    print(harmless(text), file=sys.stderr)


def _folder_of(path: str) -> str:
    """Return the folder in which relative paths of a file start."""
    return os.getcwd() if path == STANDARD_INPUT else os.path.dirname(os.path.abspath(path))


def _stem(path: str) -> str:
    if path == STANDARD_INPUT:
        return "robot"
    name = os.path.basename(path)
    stem = name.partition(".")[0]
    return stem or "robot"


def _read_main(path: str, text: str | None, library: Library) -> Source:
    if text is not None:
        is_file = path != STANDARD_INPUT
        name = path if is_file else STANDARD_INPUT_NAME
        text = text.removeprefix("\ufeff")
        source = Source(text, name=name, path=os.path.abspath(path) if is_file else "")
        source.is_xml = holds_xml(path, text)
        return source
    try:
        return library.source(os.path.abspath(path), path)
    except LoadError as error:
        if error.hint is not None:
            raise refusal_of_main(path, error) from None
        raise UsageError(f"cannot read '{path}': {error}") from error


def refusal_of_main(name: str, error: LoadError) -> YamaroError:
    """Return the error for a main file that is there, and is not to be read."""
    from .confined import failure_of_all

    return failure_of_all(error.code, f"the file cannot be read: {error}", name, error.hint)


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


def _read_xacro_arguments(
    command_line: Sequence[str], variables: Mapping[str, object]
) -> dict[str, str]:
    """Return the arguments of a xacro file, which are texts."""
    values = {}
    for argument in command_line:
        name, separator, value = argument.partition(":=")
        if not separator or not name:
            raise UsageError(f"'{argument}' is not of the form name:=value")
        values[name] = value
    return values | {name: format_value(value) for name, value in variables.items()}


def _places_of(command_line: Sequence[str]) -> dict[str, Span]:
    """Return where the name of each `name:=value` stands."""
    places = {}
    for argument in command_line:
        name = argument.partition(":=")[0]
        places[name] = Span(Source(argument, name=COMMAND_LINE), 0, len(name))
    return places


def _places_of_keywords(variables: Iterable[str]) -> dict[str, Span]:
    """Return where the name of each variable passed from Python stands."""
    return {
        name: Span(Source(f"{name}=…", name=KEYWORD_ARGUMENT), 0, len(name)) for name in variables
    }
