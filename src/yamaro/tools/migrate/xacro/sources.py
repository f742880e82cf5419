"""A robot in xacro as Yamaro sources: one for each of its files, in the same folders."""

from __future__ import annotations

from ....xacro.templates import guess_value
from ..controls import use_control
from ..document import Body
from ..writing import write_document
from .argument_section import declare_arguments, truths_declared
from .callees import Callees
from .contents import Contents
from .file import header_of, sections_of
from .inertia import Solids
from .layout import Layout
from .placing import Placing
from .program import XacroProgram
from .tidying import simplify_comparisons, tidy
from .writer import FileWriter

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Sequence

    from ....diagnostics import Diagnostic
    from ....model.compare import Difference
    from ....source import Span
    from ....xml.tree import Element


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

    def __init__(self, files: dict[str, str], main: str, root: Element) -> None:
        self.files = files
        self.main = main
        self.root = root
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
        self.layout: Layout

    @property
    def is_wrong(self) -> bool:
        """Return whether the sources do not make the robot with the arguments given."""
        return bool(self.faults or self.differences)


def migrate_program(
    program: XacroProgram,
    wanted: Collection[str] = (),
    *,
    with_section: bool = True,
    with_control: bool = True,
    borrows: bool = True,
) -> XacroMigration:
    """Return sources that make the same robot, for the arguments given at least.

    Args:
        program: the robot.
        wanted: the packages whose files become sources even if they could stay as they are.
        with_section: whether arguments are declared in a section, if that is possible.
        with_control: whether blocks for ros2_control are written in words, if that is possible.
        borrows: whether macros of other packages are called where they are, if they can be.
    """
    contents = Contents(program)
    layout = Layout(program, wanted, borrows=borrows)
    migration = XacroMigration({}, layout.outputs[program.main], program.result)
    migration.layout = layout
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
    _drop_functions(
        {program.macros[name].function for name in solids.replaced},
        [sections for sections, _ in written.values()],
    )
    sources = {output: sections for output, (sections, _) in written.items()}
    main = migration.main
    tidy(sources, main, program)
    migration.has_section = with_section and declare_arguments(sources, main, program)
    shown = program.shown_as_values()
    migration.texts = [
        name
        for name, argument in program.arguments.items()
        if name in shown
        and (not migration.has_section or isinstance(guess_value(argument.default), str))
    ]
    truths = truths_declared(sources, main) if migration.has_section else set()
    simplify_comparisons(sources.values(), truths)
    migration.has_control = with_control and use_control(sources[main])
    migration.origins = {path: name for path, name in layout.outputs.items() if name in sources}
    for output, sections in sources.items():
        migration.files[output] = write_document(sections, written[output][1])
    migration.files |= _data(program, layout) | layout.calling_files()
    migration.lost += _untried(program)
    return migration


def _data(program: XacroProgram, layout: Layout) -> dict[str, str]:
    """Return the data that is copied, by the paths of the copies."""
    copies = [(layout.output_of_data(path), text) for path, text in program.files.data.items()]
    return {copy: text for copy, text in copies if copy is not None}


def _untried(program: XacroProgram) -> Iterator[tuple[Span, str, str]]:
    """Return which arguments the robot was not expanded with, since there are too many."""
    span = program.roots[program.main].span
    for changed in program.files.untried:
        given = ", ".join(f"{name}:={value}" for name, value in changed.items())
        yield span, f"not tried with {given}", "migrate it with these as well"


def _drop_functions(names: set[str], files: list[Body]) -> None:
    """Leave out functions that were called, and are not any more, with the comments on them.

    Args:
        names: of the functions.
        files: the sections of all files.
    """
    for sections in files:
        for key in _keys_in(sections):
            names.discard(key.rpartition(".")[2])  # it may be in a namespace
            if key.startswith("$("):  # a call whose function is computed
                names -= {name for name in names if repr(name) in key}
    for sections in files:
        for section in [entry for entry in sections if entry.key == "functions"]:
            functions = section.value
            assert isinstance(functions, Body)
            _drop_entries(names, functions)
            if not functions:
                sections.entries.remove(section)
        if not sections:
            sections.add("model")


def _drop_entries(names: set[str], functions: Body) -> None:
    """Leave out functions; the terms of a licence above one are kept, above what comes next."""
    entries, last = functions.entries, functions.remark
    functions.entries, functions.remark = [], ""
    for entry in entries:
        if entry.key.partition("/")[0] not in names:
            functions.append(entry)
        elif any(word in entry.comment.lower() for word in _WORDS_OF_LICENCES):
            functions.note(entry.comment)
    functions.note(last)


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
