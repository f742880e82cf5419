"""A robot in xacro as Yamaro sources: one for each of its files, in the same folders."""

from __future__ import annotations

import os

from .compare import Difference, compare
from .document import write_document
from .xacro_program import Program, common_folder
from .xacro_writer import FileWriter

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from ...source import Source, Span
    from ...xacro.host import Host
    from ...xmltree import Element


class XacroMigration:
    """The sources of a robot, and what became of it.

    Attributes:
        files: the texts by their paths, relative to a folder.
        main: the path of the main file.
        root: what xacro makes of the robot.
        differences: in what the robot that the sources make differs from it.
        lost: what could not be carried over, with its place.
    """

    def __init__(self, files: dict[str, str], main: str, root: Element) -> None:
        """Hold the files."""
        self.files = files
        self.main = main
        self.root = root
        self.differences: list[Difference] = []
        self.lost: list[tuple[Span, str]] = []


def migrate_xacro(source: Source, host: Host, arguments: Mapping[str, str]) -> XacroMigration:
    """Return sources that make the same robot, for these arguments at least.

    Raises:
        YamaroError: the robot cannot be expanded.
    """
    program = Program(source, host, arguments)
    folder = common_folder(list(program.roots))
    outputs: dict[str, str] = {}
    for path in program.roots:
        outputs[path] = _output(os.path.relpath(path, folder), set(outputs.values()))
    migration = XacroMigration({}, outputs[source.path], program.result)
    for path, output in outputs.items():
        writer = FileWriter(program, path, outputs.__getitem__)
        sections = writer.sections(is_main=path == source.path)
        migration.files[output] = write_document(sections)
        migration.lost += writer.lost
    return migration


def check(migration: XacroMigration, build: Callable[[Mapping[str, str], str], Element]) -> None:
    """Build the sources and note in what the robot differs."""
    built = build(migration.files, migration.main)
    migration.differences = compare(migration.root, built)


def _output(path: str, taken: set[str]) -> str:
    stem = path
    for ending in (".xacro", ".urdf", ".xml"):
        stem = stem.removesuffix(ending)
    unique, number = f"{stem}.yaml", 2
    while unique in taken:
        unique, number = f"{stem}_{number}.yaml", number + 1
    return unique
