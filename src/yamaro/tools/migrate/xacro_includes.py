"""Includes, and which source a xacro file becomes, also where its name is computed."""

from __future__ import annotations

import os

from ...diagnostics import YamaroError
from ...syntax.names import is_identifier
from ...xacro.templates import Substitution, parse_template
from ...xmltree import Element, format_value
from .document import Body, Entry, literal
from .xacro_python import CannotMigrate

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ...source import Span
    from ...xacro.host import Host
    from .xacro_writer import FileWriter

ENDINGS = (".xacro", ".urdf", ".xml")


def source_name(path: str) -> str:
    """Return what the source is called that a xacro file becomes."""
    for ending in ENDINGS:
        path = path.removesuffix(ending)
    return f"{path}.yaml"


class ComputedName:
    """The name of a file that depends on arguments or properties.

    Attributes:
        start: what it begins with that is always the same, up to a slash.
        rest: what comes after that.
        may_be_anywhere: whether the name may be an absolute one.
    """

    def __init__(self, start: str, rest: str, *, may_be_anywhere: bool) -> None:
        """Hold them."""
        self.start = start
        self.rest = rest
        self.may_be_anywhere = may_be_anywhere

    def source(
        self, folder: str, sources: dict[str, str], translate: Callable[[str], str]
    ) -> str | None:
        """Return the name of the source, in the language's spelling, or None if it has none.

        Args:
            folder: what `start` means.
            sources: the names of sources that are known, by the paths of their xacro files.
            translate: writes a text of xacro.
        """
        if self.may_be_anywhere or not self.rest.endswith(ENDINGS):
            return None
        beginnings = set()
        for path, source in sources.items():
            own = source_name(os.path.relpath(path, folder))
            if own.startswith("..") or not f"/{source}".endswith(f"/{own}"):
                return None
            beginnings.add(source.removesuffix(own))
        if len(beginnings) != 1:
            return None
        return beginnings.pop() + translate(source_name(self.rest))


def computed_name(filename: str) -> ComputedName | None:
    """Return the name of a file that is not always the same; None for one that is."""
    for part in parse_template(filename).parts:
        if isinstance(part, str) or (isinstance(part, Substitution) and _is_constant(part.text)):
            continue
        start = filename[: filename.rfind("/", 0, part.start) + 1]
        return ComputedName(start, filename[len(start) :], may_be_anywhere=part.start == 0)
    return None


def folder_meant(start: str, includer: str, host: Host, span: Span) -> str | None:
    """Return the folder that the start of a name means in a file, or None if there is none."""
    folder = ""
    for part in parse_template(start).parts:
        if isinstance(part, str):
            folder += part
            continue
        try:
            folder += host.find_package(part.text.split()[1], span)
        except YamaroError:
            return None
    return os.path.normpath(os.path.join(os.path.dirname(includer), folder))


def _is_constant(command: str) -> bool:
    return command.startswith("find ") and "$" not in command


def write_include(writer: FileWriter, node: Element, body: Body) -> None:
    """Write an include of a file as one of the source that it becomes."""
    paths = writer.program.files_of(node)
    if not paths:
        name = format_value(node.attributes.get("filename"))
        raise CannotMigrate(f"the file '{name}' is not included for these arguments")
    folder = os.path.dirname(writer.output_of(writer.path))
    names = [literal(os.path.relpath(writer.output_of(path), folder)) for path in paths]
    computed = _computed_name(writer, node, dict(zip(paths, names, strict=True)))
    for path, name in [(paths[0], computed)] if computed else zip(paths, names, strict=True):
        body.add("include", _in_namespace(writer, node, path, name) or name)


def _computed_name(writer: FileWriter, node: Element, known: dict[str, str]) -> str | None:
    """Return the name of an included source if it depends on arguments, or None."""
    filename = format_value(node.attributes.get("filename"))
    computed = computed_name(filename)
    if computed is None:
        return None
    folder = writer.program.folder_meant(computed.start, node)
    name = folder and computed.source(folder, known, writer.translator.text)
    if not name and len(known) > 1 and not any(char in filename for char in "*?["):
        raise CannotMigrate(f"which file '{filename}' means is computed")
    return name or None


def _in_namespace(writer: FileWriter, node: Element, path: str, file: str) -> Body | None:
    """Return what an include says that puts a file's names in a namespace, if it does."""
    if "ns" not in node.attributes:
        return None
    name = format_value(node.attributes["ns"])
    if not is_identifier(name):
        raise CannotMigrate(f"the namespace '{name}' is computed, or no name")
    if path in writer.program.namespaces.mixed:
        raise CannotMigrate("the file is included without a namespace as well")
    return Body([Entry("path", file), Entry("namespace", name)], in_braces=True)
