"""A robot in xacro as Yamaro sources: one for each of its files, in the same folders."""

from __future__ import annotations

import os

from .document import Body, write_document
from .xacro_contents import Contents
from .xacro_file import header_of, sections_of
from .xacro_includes import source_name
from .xacro_inertia import Solids
from .xacro_placing import Placing
from .xacro_program import Program, common_folder
from .xacro_reach import Reach
from .xacro_writer import FileWriter

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from ...diagnostics import Diagnostic
    from ...source import Source, Span
    from ...xacro.host import Host
    from ...xmltree import Element
    from .compare import Difference


class XacroMigration:
    """The sources of a robot, and what became of it.

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
    """

    def __init__(self, files: dict[str, str], main: str, root: Element) -> None:
        """Hold the files."""
        self.files = files
        self.main = main
        self.root = root
        self.origins: dict[str, str] = {}
        self.differences: list[Difference] = []
        self.defaults = 0
        self.lost: list[tuple[Span, str, str]] = []
        self.is_compared_with_xacro = False
        self.faults: list[Diagnostic] = []


def migrate_xacro(
    source: Source, host: Host, arguments: Mapping[str, str], *, exact: bool = False
) -> XacroMigration:
    """Return sources that make the same robot, for these arguments at least.

    Raises:
        YamaroError: the robot cannot be expanded.
    """
    program = Program(source, host, arguments, exact=exact)
    folder = common_folder(list(program.roots))
    contents = Contents(program)
    outputs: dict[str, str] = {}
    for path in program.roots:
        outputs[path] = _output(os.path.relpath(path, folder), set(outputs.values()))
    migration = XacroMigration({}, outputs[source.path], program.result)
    migration.origins = outputs
    reach = Reach(program)
    placing = Placing(() if exact else contents.in_parts())
    is_settled = False
    while not is_settled:
        solids = Solids(program)
        written: dict[str, tuple[Body, str]] = {}
        migration.lost.clear()
        for path, output in outputs.items():
            writer = FileWriter(
                program, contents, solids, reach, placing, path, outputs.__getitem__
            )
            is_main = path == source.path
            header = header_of(writer, is_main=is_main)
            written[output] = sections_of(writer, is_main=is_main), header
            migration.lost += writer.lost
        is_settled = placing.settle()
    _drop_functions(
        {program.macros[name].function for name in solids.replaced},
        [sections for sections, _ in written.values()],
    )
    for output, (sections, header) in written.items():
        migration.files[output] = write_document(sections, header)
    for path, text in program.data.items():
        relative = os.path.relpath(path, folder)
        if not relative.startswith(".."):  # what lies elsewhere is found through its package
            migration.files[relative] = text
    return migration


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
    """Return all keys in a body, but for those of functions that are defined in it."""
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


def _output(path: str, taken: set[str]) -> str:
    unique, number = source_name(path), 2
    while unique in taken:
        unique, number = f"{source_name(path).removesuffix('.yaml')}_{number}.yaml", number + 1
    return unique
