"""A robot in xacro as a folder of sources: read, written, built and compared."""

from __future__ import annotations

import os
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO

from ....diagnostics import WARNING, Diagnostic, YamaroError, did_you_mean, failure
from ....files.loader import FileLoader, LoadError, OverlayLoader
from ....files.packages import MOST_PLACES, PackageFinder
from ....model.compare import Difference, compare, count_defaults
from ....program import Program
from ....sandbox.deep_stack import run_on_deep_stack
from ....source import Source, Span
from ....xacro.templates import guess_value
from ....xml.reader import decode_xml, read_xml
from ..controls import use_control
from ..document import Body
from ..urdf import build_allowing, ignore
from ..writing import write_document
from .contents import Contents, Placing
from .layout import ALL, ASKED, Layout, Plan
from .names import Callees
from .parts import Solids
from .program import XacroProgram
from .tidying import declare_arguments, simplify_comparisons, tidy, truths_declared
from .writer import FileWriter, header_of, sections_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping, Sequence

    from ....diagnostics import Diagnostic
    from ....files.readable import Reach
    from ....model.compare import Difference
    from ....policy import Limits
    from ....result import Build
    from ....source import Span
    from ....xml.tree import Element
    from .robot_files import Run


# --- sources, one for each file, in the same folders ------------------------------------------


class XacroMigration:
    """The sources of a robot, and the outcome.

    Attributes:
        files: the texts by their paths, relative to a folder.
        main: the path of the main file.
        root: what xacro makes of the robot.
        differences: in what the robot that the sources make differs from it.
        defaults: how many origins, or values of origins, only the sources give.
        origins: the paths of the files by those of the xacro files they were made of.
        lost: what could not be carried over: its place, why, and a hint.
        is_compared_with_xacro: whether the package xacro made what it was compared with.
        faults: the errors of the sources, if they cannot be built.
        layout: which files became sources, and which stayed as they are.
        allowed: the codes to allow when they are built, since parsers refuse the robot.
        has_section: whether the main file has a section `arguments`.
        has_control: whether it has a section `control`.
        texts: the arguments that the sources write as they are given, and xacro as values.
    """

    def __init__(self, layout: Layout, main: str, root: Element) -> None:
        self.layout = layout
        self.main = main
        self.root = root
        self.files: dict[str, str] = {}
        self.origins: dict[str, str] = {}
        self.differences: list[Difference] = []
        self.defaults = 0
        self.lost: list[tuple[Span, str, str]] = []
        self.is_compared_with_xacro = False
        self.faults: list[Diagnostic] = []
        self.allowed: Sequence[str] = ()
        self.has_section = False
        self.has_control = False
        self.texts: list[str] = []

    @property
    def is_wrong(self) -> bool:
        """Return whether the sources do not make the robot with the arguments given."""
        return bool(self.faults or self.differences)


def migrate_program(program: XacroProgram, plan: Plan) -> XacroMigration:
    """Return sources that make the same robot, for the arguments given at least."""
    contents = Contents(program)
    layout = Layout(program, plan)
    migration = XacroMigration(layout, layout.outputs[program.main], program.result)
    callees = Callees(program, layout.theirs)
    placing = Placing(() if program.exact else contents.in_parts())
    is_settled = False
    while not is_settled:
        solids = Solids(program)
        written: dict[str, tuple[Body, str]] = {}
        migration.lost.clear()
        for path, output in layout.outputs.items():
            writer = FileWriter(program, contents, solids, callees, placing, path, layout)
            is_main = path == program.main
            header = header_of(writer, is_main=is_main)
            written[output] = sections_of(writer, is_main=is_main), header
            migration.lost += writer.lost
        is_settled = placing.settle()
    # leave out functions that were called, and are not any more, with the comments on them
    unused = {program.macros[name].function for name in solids.replaced}
    files = [sections for sections, _ in written.values()]
    for own in files:
        for key in _keys_in(own):
            unused.discard(key.rpartition(".")[2])  # it may be in a namespace
            if key.startswith("$("):  # a call whose function is computed
                unused -= {name for name in unused if repr(name) in key}
    for own in files:
        for section in [entry for entry in own if entry.key == "functions"]:
            functions = section.value
            assert isinstance(functions, Body)
            # the terms of a licence above one are kept, above what comes next
            entries, last = functions.entries, functions.remark
            functions.entries, functions.remark = [], ""
            for entry in entries:
                if entry.key.partition("/")[0] not in unused:
                    functions.append(entry)
                elif any(word in entry.comment.lower() for word in _WORDS_OF_LICENCES):
                    functions.note(entry.comment)
            functions.note(last)
            if not functions:
                own.entries.remove(section)
        if not own:
            own.add("model")
    sources = {output: sections for output, (sections, _) in written.items()}
    main = migration.main
    tidy(sources, main, program)
    migration.has_section = plan.has_section and declare_arguments(sources, main, program)
    shown = program.shown_as_values()
    migration.texts = [
        name
        for name, argument in program.arguments.items()
        if name in shown
        and (not migration.has_section or isinstance(guess_value(argument.default), str))
    ]
    truths = truths_declared(sources, main) if migration.has_section else set()
    simplify_comparisons(sources.values(), truths)
    migration.has_control = plan.has_control and use_control(sources[main])
    migration.origins = {path: name for path, name in layout.outputs.items() if name in sources}
    for output, sections in sources.items():
        migration.files[output] = write_document(sections, written[output][1])
    copies = [(layout.output_of_data(path), text) for path, text in program.files.data.items()]
    migration.files |= {
        copy: text for copy, text in copies if copy is not None
    } | layout.calling_files()
    span = program.roots[program.main].span
    for changed in program.files.untried:  # there were too many
        given = ", ".join(f"{name}:={value}" for name, value in changed.items())
        why = f"not tried with {given}"
        migration.lost.append((span, why, "migrate it with these as well"))
    return migration


_WORDS_OF_LICENCES = ("copyright", "license", "licence")


def _keys_in(body: Body) -> Iterator[str]:
    """Return all keys in a body, except those of functions that are defined in it."""
    for entry in body:
        if not isinstance(entry.value, Body):
            yield entry.key
        elif entry.key == "functions":
            for function in entry.value:
                assert isinstance(function.value, Body)
                yield from _keys_in(function.value)
        else:
            yield entry.key
            yield from _keys_in(entry.value)


# --- the comparison with what xacro makes -----------------------------------------------------


class DiskHost:
    """Gives a robot that is migrated its files and packages, and notes the packages."""

    def __init__(
        self,
        limits: Limits,
        packages: Mapping[str, str],
        *,
        finder: PackageFinder | None = None,
        reach: Reach | None = None,
    ) -> None:
        """Take folders of packages by name, before those that are found.

        Args:
            limits: how large the files may be.
            packages: the folders given.
            finder: finds the others.
            reach: where files may lie; anywhere if it is None.
        """
        self.limits = limits
        self._loader = FileLoader(limits, reach)
        self._packages = finder or PackageFinder(given=packages)
        self.found: dict[str, str] = dict(packages)

    def read(self, path: str, span: Span) -> Source:
        """Return the text of a file; raise YamaroError if it cannot be read."""
        absolute = os.path.abspath(path)
        try:
            return decode_xml(self._loader.read(absolute), name=_shown(absolute), path=absolute)
        except LoadError as error:
            near = did_you_mean(os.path.basename(absolute), self._loader.neighbours(absolute))
            raise failure(
                error.code,
                f"the file '{os.path.basename(path)}' cannot be included: {error}",
                span,
                hint=error.hint or near,
                notes=[f"searched for {absolute}"],
            ) from None

    def glob(self, pattern: str) -> list[str]:
        """Return the paths that a pattern of the shell matches."""
        from glob import glob

        return glob(pattern)

    def find_package(self, name: str, span: Span) -> str:
        """Return the folder of a package; raise YamaroError if there is none."""
        start = os.path.dirname(span.source.path)
        folder = self._packages.find(name, start, span)
        if folder is None:
            places = self._packages.looked_at(name, start)
            raise failure(
                "unknown-package",
                f"the package '{name}' is not found",
                span,
                hint=self._packages.hint_for(name, start),
                notes=[f"searched in {place}" for place in places[:MOST_PLACES]],
            )
        self.found[name] = folder
        return folder

    def environment(self, name: str) -> str | None:
        """Return a variable of the environment, or None if it is not set."""
        return os.environ.get(name)

    def folder(self) -> str:
        """Return the current folder."""
        return os.getcwd()

    def say(self, text: str, span: Span) -> None:
        """Take what the robot says, which the sources will say."""


def migrate_robot(
    source: Source,
    folder: str,
    *,
    arguments: Sequence[str],
    packages: Mapping[str, str],
    limits: Limits,
    exact: bool = False,
    wanted: Collection[str] = (),
    finder: PackageFinder | None = None,
    reach: Reach | None = None,
) -> XacroMigration:
    """Return the sources of a robot in xacro, compared with what xacro makes of it.

    Args:
        source: the main file.
        folder: where the sources are to be written, absolute.
        arguments: the arguments, as `name:=value`.
        packages: folders of packages by name.
        limits: how large the files may be.
        exact: whether an origin that is missing has to stay missing.
        wanted: packages whose files become sources, too; `ALL` means all.
        finder: finds ROS packages, the given ones among them.
        reach: where the files may lie; anywhere if it is None.

    Raises:
        YamaroError: the robot cannot be expanded.
    """
    host = DiskHost(limits, packages, finder=finder, reach=reach)
    given = dict(argument.split(":=", 1) for argument in arguments)

    def migrate() -> XacroMigration:
        program = XacroProgram(source, host, given, exact=exact)
        expected = expanded_by_xacro(source.path, given, host)
        judge = Judge(program, folder, host, expected or program.result)
        migration = judge.best(Plan(wanted))
        if migration.is_wrong and migration.has_control:
            migration = judge.best(Plan(wanted, has_control=False))
        if migration.is_wrong and migration.has_section:
            migration = judge.best(Plan(wanted, has_section=False, has_control=False))
        migration.is_compared_with_xacro = expected is not None
        return migration

    return run_on_deep_stack(migrate)


class Judge:
    """Compares what sources make, which are not written yet, with what xacro makes."""

    def __init__(
        self, program: XacroProgram, folder: str, host: DiskHost, expected: Element
    ) -> None:
        """Expect a robot of a program, whose sources are to be in a folder."""
        self._program = program
        self._folder = folder
        self._host = host
        self._expected = expected
        self._programs: dict[tuple[object, ...], Program] = {}

    def best(self, plan: Plan) -> XacroMigration:
        """Return the sources by a plan that make the robot, or the first ones if none do.

        They are compared for all arguments that the robot was expanded with.
        """
        program = self._program
        others = program.runs.done[1:]
        migration = first = self._tried(program, plan)
        if first.layout.borrowed and (
            first.is_wrong or any(self.differences_with(run, first) for run in others)
        ):
            plan = plan._replace(borrows=False)
            migration = first = self._tried(program, plan)
        if first.is_wrong and first.layout.theirs:
            migration = self._tried(program, plan._replace(wanted=(ALL,)))
        if migration.is_wrong and others:
            migration = self._tried(program.alone(), plan)
        if migration.is_wrong:
            migration = first
        if not migration.faults:
            for run in others:
                migration.differences += self.differences_with(run, migration)
        return migration

    def _tried(self, program: XacroProgram, plan: Plan) -> XacroMigration:
        """Return the sources of a robot, with their faults and differences."""
        migration = migrate_program(program, plan)
        try:
            built, migration.allowed = self._built(migration, program.given)
            migration.differences = compare(self._expected, built, exact=program.exact)
            migration.defaults = count_defaults(self._expected, built)
        except YamaroError as error:
            migration.faults = [each for each in error.diagnostics if each.severity != WARNING]
        return migration

    def differences_with(self, run: Run, migration: XacroMigration) -> list[Difference]:
        """Return in what the robot differs that sources make with other arguments."""
        shown = ", ".join(f"{name}:={value}" for name, value in run.changed.items())
        try:
            built, _ = self._built(migration, run.arguments)
        except YamaroError as error:
            why = f"it has an error: {error.diagnostics[0].message}"
            return [Difference((f"with {shown}",), why)]
        found = compare(run.result, built, exact=self._program.exact)
        return [Difference((f"with {shown}", *each.path), each.message) for each in found]

    def _built(
        self, migration: XacroMigration, arguments: Mapping[str, str]
    ) -> tuple[Element, list[str]]:
        """Return what the sources make, and the codes that have to be allowed for it."""
        given = [f"{name}:={value}" for name, value in arguments.items()]

        def build(codes: Sequence[str]) -> Build:
            key = (id(migration), *codes)
            if key not in self._programs:
                files = migration.files.items()
                texts = {os.path.join(self._folder, name): text for name, text in files}
                self._programs[key] = Program(
                    os.path.join(self._folder, migration.main),
                    loader=OverlayLoader(texts, FileLoader(self._host.limits)),
                    packages=self._host.found,
                    allow=codes,
                )
            return self._programs[key].build(command_line=given, on_message=ignore, meshes="keep")

        built, codes = build_allowing(build)
        return built.root, codes


def expanded_by_xacro(path: str, arguments: Mapping[str, str], host: DiskHost) -> Element | None:
    """Return what the package `xacro` makes of a robot; None if it is not there, or fails."""
    try:
        import xacro
        from xacro import substitution_args as substitution
    except ImportError:
        return None
    nowhere = Span(Source("", name="xacro", path=path), 0, 0)

    def find(name: str) -> str:
        return host.find_package(name, nowhere)

    known = substitution._eval_find, substitution._eval_dict["find"]
    substitution._eval_find = substitution._eval_dict["find"] = find
    try:
        with redirect_stderr(StringIO()), redirect_stdout(StringIO()):
            text = xacro.process_file(path, mappings=dict(arguments)).toxml()
        return read_xml(Source(text, name="xacro"), host.limits).root
    except Exception:
        return None
    finally:
        substitution._eval_find, substitution._eval_dict["find"] = known


def warnings_of(migration: XacroMigration) -> list[Diagnostic]:
    """Return what could not be carried over, as warnings at its places."""
    return [
        Diagnostic(
            "not-migrated",
            why,
            span,
            hint=hint,
            severity=WARNING,
        )
        for span, why, hint in migration.lost
    ]


def remarks_on(migration: XacroMigration) -> list[str]:
    """Return what is said besides the report: of other packages, and of texts of arguments."""
    layout = migration.layout
    brought: dict[str, list[str]] = {}
    for path in (path for path, reason in layout.brought.items() if reason != ASKED):
        brought.setdefault(layout.package_of(path)[0], []).append(path)
    lines = []
    for name, paths in brought.items():
        first = paths[0]
        relative = os.path.relpath(first, layout.package_of(first)[1])
        lines.append(
            f"migrated as well: {_counted(len(paths))} of the package '{name}'; "
            f"{relative}: {layout.brought[first]}"
        )
    left = [name for name, _ in layout.theirs.values()]
    lines += [
        f"included as {'it is' if left.count(name) == 1 else 'they are'}: "
        f"{_counted(left.count(name))} of the package '{name}'; --with {name} migrates "
        f"{'it' if left.count(name) == 1 else 'them'}"
        for name in dict.fromkeys(left)
    ]
    for name in migration.texts[:1]:
        others = migration.texts[1:]
        also = f"; so for {', '.join(others)}" if others else ""
        lists = "" if migration.has_section else "; [1, 2] is a text to xacro and a list to them"
        lines.append(
            f"with {name}:=true xacro writes True, and with {name}:=01 it writes 1; the sources "
            f"write the text as it is given{lists}{also}"
        )
    if not migration.is_compared_with_xacro:
        lines.append("compared with Yamaro's own expansion; with yamaro[xacro], with xacro's")
    return lines


def _counted(count: int) -> str:
    return f"{count} file{'' if count == 1 else 's'}"


def _shown(path: str) -> str:
    try:
        relative = os.path.relpath(path)
    except ValueError:  # on another drive
        return path
    return path if relative.startswith(os.path.join("..", "..")) else relative
