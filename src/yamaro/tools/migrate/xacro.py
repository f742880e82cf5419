"""A robot in xacro as Yamaro sources: one for each of its files, in the same folders."""

from __future__ import annotations

import os

from .document import write_document
from .xacro_contents import Contents
from .xacro_program import Program, common_folder
from .xacro_writer import FileWriter

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

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
        self.lost: list[tuple[Span, str, str]] = []
        self.is_compared_with_xacro = False
        self.faults: list[Diagnostic] = []


def migrate_xacro(source: Source, host: Host, arguments: Mapping[str, str]) -> XacroMigration:
    """Return sources that make the same robot, for these arguments at least.

    Raises:
        YamaroError: the robot cannot be expanded.
    """
    program = Program(source, host, arguments)
    folder = common_folder(list(program.roots))
    contents = Contents(program)
    outputs: dict[str, str] = {}
    for path in program.roots:
        outputs[path] = _output(os.path.relpath(path, folder), set(outputs.values()))
    migration = XacroMigration({}, outputs[source.path], program.result)
    migration.origins = outputs
    for path, output in outputs.items():
        writer = FileWriter(program, contents, path, outputs.__getitem__)
        is_main = path == source.path
        sections = writer.sections(is_main=is_main)
        migration.files[output] = write_document(sections, writer.header(is_main=is_main))
        migration.lost += writer.lost
    for path, text in program.data.items():
        relative = os.path.relpath(path, folder)
        if not relative.startswith(".."):  # what lies elsewhere is found through its package
            migration.files[relative] = text
    return migration


def _output(path: str, taken: set[str]) -> str:
    stem = path
    for ending in (".xacro", ".urdf", ".xml"):
        stem = stem.removesuffix(ending)
    unique, number = f"{stem}.yaml", 2
    while unique in taken:
        unique, number = f"{stem}_{number}.yaml", number + 1
    return unique
