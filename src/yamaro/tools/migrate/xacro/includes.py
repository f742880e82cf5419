"""Includes, and which source a xacro file becomes, also where its name is computed."""

from __future__ import annotations

import os

from ....diagnostics import YamaroError
from ....syntax.names import is_identifier
from ....xacro.templates import Substitution, parse_template
from ....xml.tree import Element
from ....xml.values import format_value
from ..document import Body, Entry, literal
from .python import CannotMigrate

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ....source import Span
    from ....xacro.host import Host
    from .writer import FileWriter

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
    """

    def __init__(self, start: str, rest: str) -> None:
        self.start = start
        self.rest = rest

    def source(
        self, folder: str, sources: dict[str, str], translate: Callable[[str], str]
    ) -> str | None:
        """Return the name of the source, in the language's spelling, or None if it has none.

        Args:
            folder: what `start` means.
            sources: the names of sources that are known, by the paths of their xacro files.
            translate: writes a text of xacro.
        """
        if not self.rest.endswith(ENDINGS):
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
        return ComputedName(start, filename[len(start) :])
    return None


def folder_meant(start: str, base: str, host: Host, span: Span) -> str | None:
    """Return the folder that the start of a name means in a folder, or None if there is none."""
    folder = ""
    for part in parse_template(start).parts:
        if isinstance(part, str):
            folder += part
            continue
        if part.text == "cwd":
            folder += host.folder()
            continue
        try:
            folder += host.find_package(part.text.split()[1], span)
        except YamaroError:
            return None
    return os.path.normpath(os.path.join(base, folder))


def _is_constant(command: str) -> bool:
    return command == "cwd" or (command.startswith("find ") and "$" not in command)


def write_include(writer: FileWriter, node: Element, body: Body) -> None:
    """Write an include of a file as one of the source that it becomes, or of itself."""
    paths = writer.program.files.files_of(node)
    filename = format_value(node.attributes.get("filename"))
    computed = computed_name(filename)
    if computed is not None and len(paths) == 1 and writer.program.files.is_constant(node):
        computed = None
    if not paths and "optional" in node.attributes:
        raise CannotMigrate(f"the file '{filename}' is optional, and is not there")
    if not paths and computed is None:
        raise CannotMigrate(f"the file '{filename}' is not included for these arguments")
    theirs = [path for path in paths if path in writer.layout.theirs]
    if theirs:
        _write_theirs(writer, node, theirs, body)
        paths = [path for path in paths if path not in theirs]
        if not paths:
            return
    if paths and computed is not None:
        _tell_left_behind(writer, node, paths)
    folder = os.path.dirname(writer.output_of(writer.path))
    names = [literal(os.path.relpath(writer.output_of(path), folder)) for path in paths]
    if computed is None or _is_pattern(filename):
        for path, name in zip(paths, names, strict=True):
            body.add("include", _with_names(writer, node, path, name) or name)
        return
    name = _computed_name(writer, node, computed, dict(zip(paths, names, strict=True)))
    path = paths[0] if paths else ""
    body.add("include", _in_namespace(writer, node, path, name) or name)


def _tell_left_behind(writer: FileWriter, node: Element, paths: list[str]) -> None:
    """Warn of files that an include might mean as well, and that are not migrated."""
    filename = format_value(node.attributes["filename"])
    if _is_pattern(filename):
        if not writer.program.files.is_constant(node):
            why = f"which files '{filename}' matches depends on arguments"
            writer.lose(node.span, why, f"the sources always include {_shortly(paths)}")
        return
    left = writer.program.files.left_behind(node)
    if left:
        why = f"'{filename}' may name files that are not migrated: {_shortly(left)}"
        hint = f"migrated: {_shortly(paths)}; any other file is an error when the sources are built"
        writer.lose(node.span, why, hint)


def _shortly(paths: list[str]) -> str:
    """Return the names of files, of many only the first."""
    folder = os.path.commonpath([os.path.dirname(path) for path in paths])
    shown = [f"'{os.path.relpath(path, folder)}'" for path in paths[:4]]
    return ", ".join([*shown, *(["…"] if len(paths) > 4 else [])])


def _write_theirs(writer: FileWriter, node: Element, paths: list[str], body: Body) -> None:
    """Include files of other packages as they are, with the arguments that they read."""
    paths = [path for path in paths if not writer.layout.makes_nothing(path)]
    filename = format_value(node.attributes["filename"])
    names = ["$(find {})/{}".format(*writer.layout.theirs[path]) for path in paths]
    if paths and computed_name(filename) is not None and not _is_pattern(filename):
        names = [writer.translator.text(filename)]
    arguments = dict.fromkeys(own for path in paths for own in writer.layout.arguments_of(path))
    for name in names:
        if arguments:
            given = [Entry(own, f"$({writer.argument_name(own)})") for own in arguments]
            body.add("include", Body([Entry("path", name), *given], in_braces=True))
        else:
            body.add("include", name)


def _computed_name(
    writer: FileWriter, node: Element, computed: ComputedName, sources: dict[str, str]
) -> str:
    """Return the name of an included source that depends on arguments.

    Args:
        writer: writes the file in which it stands.
        node: the include.
        computed: its name in xacro.
        sources: the names of the sources that it may be, by the paths of their xacro files.
    """
    filename = computed.start + computed.rest
    named = writer.program.files.names_of(node)
    is_relative = not any(os.path.isabs(name) for name in named)
    for base in _bases(writer) if named else ():
        name = _name_from(writer, node, computed, named, base)
        if name:
            return name
    folder = writer.program.files.folder_meant(computed.start, node)
    if folder and not named and (computed.start or is_relative):
        likely = sources or _likely(writer, folder)
        name = computed.source(folder, likely, writer.translator.text)
        if name:
            return name
    python = writer.translator.joined(filename)
    if not named:
        why = f"which file '{filename}' means is not known"
        writer.lose(node.span, why, "the include is an error where it is reached")
        return f"$({python}).yaml"
    by_name = {name: sources[path] for name, path in named.items() if path in sources}
    if not all(_is_in_known_folder(writer, name) for name in by_name):
        why = f"which file '{filename}' means is computed"
        hint = "the sources know it by its path on this machine; any other is an error"
        writer.lose(node.span, why, hint)
    ending = _common_ending(by_name)
    if ending is not None and is_relative:
        python = python if python.isidentifier() else f"({python})"
        return f"$({python}.removesuffix({ending!r})).yaml"
    keys = [f"{_as_python(writer, name)}: {by_name[name]!r}" for name in by_name]
    return f"$({{{', '.join(keys)}}}.get({python}, {_in_sum(python)} + '.yaml'))"


def _is_pattern(filename: str) -> bool:
    """Return whether a name means all files that it matches."""
    parts = [part for part in parse_template(filename).parts if isinstance(part, str)]
    return any(char in part for part in parts for char in "*?[")


def _likely(writer: FileWriter, folder: str) -> dict[str, str]:
    """Return the source that a file in a folder would become, as those do that lie near."""
    output = writer.layout.folder_of(folder)
    if output is None:
        return {}
    name = os.path.relpath(output, os.path.dirname(writer.output_of(writer.path)) or ".")
    return {os.path.join(folder, "x.xacro"): os.path.normpath(os.path.join(name, "x.yaml"))}


def _bases(writer: FileWriter) -> list[str]:
    """Return the folders that the name of an included file may be relative to.

    In a macro that is the folder of the file that calls it.
    """
    folders = [writer.path, *writer.program.roots]
    return list(dict.fromkeys(map(os.path.dirname, folders)))


def _name_from(
    writer: FileWriter, node: Element, computed: ComputedName, named: dict[str, str], base: str
) -> str | None:
    """Return the name of an included source if it is that of the file with another ending.

    Args:
        writer: writes the file in which it stands.
        node: the include.
        computed: its name in xacro.
        named: the paths that it meant, by the names computed there.
        base: the folder that the names are relative to.
    """
    folder = writer.program.files.folder_meant(computed.start, node, base)
    output = writer.layout.folder_of(folder) if folder else None
    if folder is None or output is None or not computed.rest.endswith(ENDINGS):
        return None
    for name, path in named.items():
        if path not in writer.layout.outputs:
            continue
        rest = os.path.relpath(os.path.join(base, name), folder) if computed.start else name
        if os.path.normpath(os.path.join(base, name)) != path or writer.output_of(
            path
        ) != os.path.normpath(os.path.join(output, source_name(rest))):
            return None
    start = os.path.relpath(output, os.path.dirname(writer.output_of(writer.path)) or ".")
    rest = writer.translator.text(source_name(computed.rest))
    return rest if start == "." else f"{start}/{rest}"


def _common_ending(by_name: dict[str, str]) -> str | None:
    """Return the ending without which names of files are those of their sources, if one is."""
    for ending in (".xacro", ".urdf.xacro", ".urdf", ".xml"):
        if all(
            name.endswith(ending)
            and name.removesuffix(ending) + ".yaml" == os.path.normpath(source)
            for name, source in by_name.items()
        ):
            return ending
    return None


def _is_in_known_folder(writer: FileWriter, name: str) -> bool:
    """Return whether a file is named by a folder that is found wherever the sources are."""
    folders = [*writer.program.runs.packages.values(), _current_folder(writer)]
    return not os.path.isabs(name) or any(
        name.startswith(f"{folder}/") for folder in folders if folder
    )


def _current_folder(writer: FileWriter) -> str:
    """Return the current folder if names of files may begin with it; "" if not."""
    documents = writer.program.files.documents.values()
    is_named = any("$(cwd)" in document.root.span.source.text for document in documents)
    return os.getcwd() if is_named else ""


def _as_python(writer: FileWriter, name: str) -> str:
    """Return the name of a file as Python; a path in a package begins with where that is."""
    if not os.path.isabs(name):
        return repr(name)
    for package, folder in writer.program.runs.packages.items():
        if name.startswith(f"{folder}/"):
            return f"find({package!r}) + {name[len(folder) :]!r}"
    folder = _current_folder(writer)
    if not folder:
        return repr(name)
    return f"cwd + {name[len(folder) :]!r}" if name.startswith(f"{folder}/") else repr(name)


def _in_sum(python: str) -> str:
    """Return an expression as a part of a sum."""
    return python if " if " not in python and " or " not in python else f"({python})"


def is_plain(include: Element) -> bool:
    """Return whether an include names one file literally, and no namespace for it."""
    filename = format_value(include.attributes.get("filename"))
    return "ns" not in include.attributes and not any(mark in filename for mark in "$*?[")


def _with_names(writer: FileWriter, node: Element, path: str, file: str) -> Body | None:
    """Return what an include says that passes names, or puts them in a namespace, if it does."""
    macro = writer.here.macro
    names = writer.callees.passed_to(path, macro) if macro is not None and is_plain(node) else ()
    if not names:
        return _in_namespace(writer, node, path, file)
    passed = [Entry(name, f"$({name})") for name in sorted(names)]
    return Body([Entry("path", file), *passed], in_braces=True)


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
