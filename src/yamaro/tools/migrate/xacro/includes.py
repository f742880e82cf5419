"""Includes of files that become sources, of files as they are, and of single macros of these."""

from __future__ import annotations

import os
from xml.sax.saxutils import quoteattr

from ....diagnostics import YamaroError
from ....model.compare import POSE
from ....syntax.names import is_identifier
from ....xacro.templates import Substitution, parse_template
from ....xml.tree import Element
from ....xml.values import format_value
from ..document import Body, Entry, literal
from .names import is_plain
from .python import CannotMigrate

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from ....source import Span
    from ....xacro.host import Host
    from .program import Macro, XacroProgram
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
        if isinstance(part, str) or (
            isinstance(part, Substitution)
            and (part.text == "cwd" or (part.text.startswith("find ") and "$" not in part.text))
        ):
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
    if paths and computed is not None and _is_pattern(filename):
        if not writer.program.files.is_constant(node):
            why = f"which files '{filename}' matches depends on arguments"
            writer.lose(node.span, why, f"the sources always include {_shortly(paths)}")
    elif paths and computed is not None:
        left = writer.program.files.left_behind(node)
        if left:
            why = f"'{filename}' may name files that are not migrated: {_shortly(left)}"
            known = f"migrated: {_shortly(paths)}"
            hint = f"{known}; any other file is an error when the sources are built"
            writer.lose(node.span, why, hint)
    folder = os.path.dirname(writer.output_of(writer.path))
    names = [literal(os.path.relpath(writer.output_of(path), folder)) for path in paths]
    if computed is None or _is_pattern(filename):
        for path, name in zip(paths, names, strict=True):
            macro, own = writer.here.macro, set[str]()
            if macro is not None and is_plain(node):
                own = writer.callees.passed_to(path, macro)
            if own:
                passed = [Entry(each, f"$({each})") for each in sorted(own)]
                body.add("include", Body([Entry("path", name), *passed], in_braces=True))
            else:
                body.add("include", _in_namespace(writer, node, path, name) or name)
        return
    name = _computed_name(writer, node, computed, dict(zip(paths, names, strict=True)))
    path = paths[0] if paths else ""
    body.add("include", _in_namespace(writer, node, path, name) or name)


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
    # the name may be relative to a macro's file, or to the one that calls it
    folders = map(os.path.dirname, [writer.path, *writer.program.roots])
    for base in dict.fromkeys(folders) if named else ():
        name = _name_from(writer, node, computed, named, base)
        if name:
            return name
    folder = writer.program.files.folder_meant(computed.start, node)
    if folder and not named and (computed.start or is_relative):
        likely = sources
        output = writer.layout.folder_of(folder)
        if not likely and output is not None:  # what a file in it would become, as those near do
            near = os.path.relpath(output, os.path.dirname(writer.output_of(writer.path)) or ".")
            likely = {os.path.join(folder, "x.xacro"): os.path.normpath(f"{near}/x.yaml")}
        name = computed.source(folder, likely, writer.translator.text)
        if name:
            return name
    python = writer.translator.joined(filename)
    if not named:
        why = f"which file '{filename}' means is not known"
        writer.lose(node.span, why, "the include is an error where it is reached")
        return f"$({python}).yaml"
    by_name = {name: sources[path] for name, path in named.items() if path in sources}
    found = [*writer.program.runs.packages.values(), _current_folder(writer)]
    starts = tuple(f"{known}/" for known in found if known)  # found wherever the sources are
    if any(os.path.isabs(name) and not name.startswith(starts) for name in by_name):
        why = f"which file '{filename}' means is computed"
        hint = "the sources know it by its path on this machine; any other is an error"
        writer.lose(node.span, why, hint)
    # the ending without which names of files are those of their sources, if one is
    ending = next(
        (
            ending
            for ending in (".xacro", ".urdf.xacro", ".urdf", ".xml")
            if all(
                name.endswith(ending)
                and name.removesuffix(ending) + ".yaml" == os.path.normpath(source)
                for name, source in by_name.items()
            )
        ),
        None,
    )
    if ending is not None and is_relative:
        python = python if python.isidentifier() else f"({python})"
        return f"$({python}.removesuffix({ending!r})).yaml"
    keys = [f"{_as_python(writer, name)}: {by_name[name]!r}" for name in by_name]
    term = f"({python})" if " if " in python or " or " in python else python
    return f"$({{{', '.join(keys)}}}.get({python}, {term} + '.yaml'))"


def _is_pattern(filename: str) -> bool:
    """Return whether a name means all files that it matches."""
    parts = [part for part in parse_template(filename).parts if isinstance(part, str)]
    return any(char in part for part in parts for char in "*?[")


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


# --- macros of other packages that are called where they are ----------------------------------
# Only xacro can call a macro of xacro. So that the files of another package stay where they are,
# each of its macros that the robot calls has a file of xacro among the sources: it includes the
# package's file and calls the macro, with arguments of its own as the parameters. The sources
# include that.


_AROUND = ("xacro:if", "xacro:unless", "xacro:macro")
"""Elements in which a call makes what is right in the robot."""


class Borrowed:
    """A macro of another package that is called where it is.

    Attributes:
        macro: the macro.
        path: of the file that is included for it.
        caller: the path of the first file that calls it.
        output: the path of the file that calls it, in the output folder.
    """

    def __init__(self, macro: Macro, path: str, calls: list[Element], arguments: list[str]) -> None:
        """Take what is called.

        Args:
            macro: the macro.
            path: of the file to include for it.
            calls: all calls of it.
            arguments: those that its files read.
        """
        self.macro = macro
        self.path = path
        self.caller = calls[0].span.source.path
        self.output = ""
        self._arguments = arguments
        self._values = [name for name in macro.values() if any(name in c.attributes for c in calls)]
        self._calls = calls
        self._poses = [list(child.attributes) for child in calls[0].elements()]

    def can_be_called(self, around: Collection[str], program: XacroProgram) -> bool:
        """Return whether an include can give all that the calls do, which is texts.

        Args:
            around: the names of the properties and parameters that its callers may see.
            program: the robot.
        """
        blocks = self.macro.blocks()
        # the arguments of the file that calls it
        poses = [
            f"{block.lstrip('*')}_{key}"
            for block, pose in zip(self.macro.blocks(), self._poses, strict=False)
            for key in pose
        ]
        names = [*self._values, *poses, *self._arguments]
        if any(block.startswith("**") for block in blocks):
            return False
        for call in self._calls:
            given = call.elements()
            values = [own for each in (call, *given) for own in each.attributes.values()]
            if not all(map(program.is_scalar, map(format_value, values))):
                return False
            if not call.attributes.keys() <= set(self.macro.values()) or len(given) != len(blocks):
                return False
            if any(child.name != "origin" or child.children for child in given):
                return False
            if [list(child.attributes) for child in given] != self._poses:
                return False
        if not all(set(pose) <= set(POSE) for pose in self._poses):
            return False
        if len(set(names)) < len(names) or not all(map(is_identifier, names)):
            return False
        return "path" not in names and all(
            self._can_be_left_out(name, around) for name in self.macro.values()
        )

    def _can_be_left_out(self, name: str, around: Collection[str]) -> bool:
        """Return whether a parameter has its value also in a call that does not give it."""
        own = next(own for own in self.macro.parameters if own.name == name)
        if all(name in call.attributes for call in self._calls):
            return True
        if own.is_forwarded:
            return name not in around and name not in self._values
        return name not in self._values or (own.default is not None and "$" not in own.default)

    def text(self, filename: str) -> str:
        """Return the file that calls it; `filename` includes the package's file."""
        lines = [
            '<?xml version="1.0"?>',
            f"<!-- calls the macro '{self.macro.name}' where it is -->",
            '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">',
            f"  <xacro:include filename={quoteattr(filename)}/>",
        ]
        for own in self.macro.parameters:
            if own.name in self._values and own.default is not None and not own.is_forwarded:
                default = own.default.strip("'\"")
                lines.append(f'  <xacro:arg name="{own.name}" default={quoteattr(default)}/>')
        given = "".join(f' {name}="$(arg {name})"' for name in self._values)
        head = f"  <xacro:{self.macro.name}{given}"
        poses = [
            "".join(f' {key}="$(arg {block.lstrip("*")}_{key})"' for key in pose)
            for block, pose in zip(self.macro.blocks(), self._poses, strict=True)
        ]
        lines.append(f"{head}>" if poses else f"{head}/>")
        lines += [f"    <origin{pose}/>" for pose in poses]
        lines += [f"  </xacro:{self.macro.name}>"] * bool(poses)
        return "".join(f"{line}\n" for line in [*lines, "</robot>"])

    def write_call(self, writer: FileWriter, node: Element, body: Body) -> None:
        """Write a call of it as an include of the file that calls it."""
        folder = os.path.dirname(writer.output_of(writer.path))
        path = os.path.relpath(self.output, folder or ".")
        include = Body([Entry("path", path)], in_braces=True)
        for name, value in node.attributes.items():
            include.add(name, writer.translator.value(format_value(value)))
        for block, child in zip(self.macro.blocks(), node.elements(), strict=True):
            for key, value in child.attributes.items():
                text = writer.translator.text(format_value(value))
                include.add(f"{block.lstrip('*')}_{key}", text)
        for name in self._arguments:
            include.add(name, f"$({writer.argument_name(name)})")
        body.add("include", include if len(include.entries) > 1 else path)


def calls_of(name: str, root: Element, *, is_plain: bool) -> list[Element] | None:
    """Return the calls of a macro in a file; None if they cannot become includes.

    Args:
        name: of the macro.
        root: the file.
        is_plain: whether each has to be right in the robot, not in a link or another element.
    """
    calls = []
    pending = [(child, True) for child in root.elements()]
    while pending:
        element, is_right_in = pending.pop(0)
        if element.name == f"xacro:{name}":
            if is_plain and not is_right_in:
                return None
            calls.append(element)
        elif element.name == "xacro:call":
            called = format_value(element.attributes.get("macro"))
            if "$" in called or called == name:
                return None
        is_right_in = is_right_in and element.name in _AROUND
        pending += [(child, is_right_in) for child in element.elements()]
    return calls
