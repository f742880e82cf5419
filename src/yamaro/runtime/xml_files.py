"""XML files in a program, as the main file or included: URDF, xacro, and other formats."""

from __future__ import annotations

import os

from ..diagnostics import Frame, Reporter, YamaroError, add_trace, did_you_mean, failure
from ..files.loader import LoadError
from ..source import Source, Span
from ..syntax.nodes import (
    IncludeNode,
)
from ..xml.reader import CData, read_xml
from ..xml.robot_names import rename
from ..xml.tree import Element, IncludedRobot, Text
from ..xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Any

    from ..policy import Limits
    from ..xml.tree import Node
    from .files import Files
    from .interpreter import Interpreter, Messages


def read_included(source: Source, limits: Limits) -> tuple[Element, bool]:
    """Return the root of an XML file, and whether the file is xacro's.

    It is if its name says so, if it has one of xacro's tags, or if it declares them and has one of
    xacro's expressions: many such files are called `.urdf`. The root of such a file is read
    exactly, as its expansion needs it.

    Raises:
        YamaroError: it is not XML.
    """
    if is_named_xacro(source):
        return read_xml(source, limits, exact=True).root, True
    root = read_xml(source, limits, exact="xacro:" in source.text).root
    return root, is_xacro(root)


def read_robot(interpreter: Interpreter, root: Element) -> Element:
    """Return the root of a URDF as it is, and of a robot in another format what it describes.

    Raises:
        YamaroError: the robot has errors.
    """
    if root.name == "robot" or interpreter.read_source is None:
        return root
    host = XacroHost(
        interpreter.files,
        interpreter.messages,
        interpreter.limits,
        main=root.span.source,
        has_environment=False,
    )
    foreign = [root.span.source]

    def read(path: str, span: Span) -> Source:
        source = host.read(path, span)
        foreign.append(source)
        return source

    robot = interpreter.read_source(root, read)
    if robot is None:
        return root
    interpreter.foreign += foreign
    interpreter.has_notes = interpreter.has_blocks = True
    return robot


def is_named_xacro(source: Source) -> bool:
    """Return whether the name of a file says that it is xacro's."""
    return source.path.lower().endswith(".xacro")


def is_xacro(root: Element) -> bool:
    """Return whether a document has xacro's tags, or declares them and has xacro's expressions."""
    declares = "xmlns:xacro" in root.attributes
    for element in root.iter():
        if element.name.startswith("xacro:"):
            return True
        if declares:
            values = [*map(str, element.attributes.values()), element.text()]
            if any("${" in value or "$(" in value for value in values):
                return True
    return False


def check_xml_include(node: IncludeNode, *, is_xacro: bool) -> None:
    """Check what an include of XML passes; xacro files have arguments of any name.

    Raises:
        YamaroError: it passes something else than a prefix, or wants a namespace.
    """
    for argument in node.arguments:
        if argument.name != "prefix" and not is_xacro:
            raise failure(
                "unknown-argument",
                f"an XML file does not accept the variable '{argument.name}'",
                argument.span,
                hint=did_you_mean(argument.name or "", ["prefix"])
                or "prefix: left_ renames its links and joints; an "
                "XML file accepts no other variables",
            )
    if node.namespace is not None and not is_xacro:
        raise failure(
            "bad-namespace",
            "an XML file has no functions or variables for a namespace",
            node.path_span,
            hint="remove 'namespace'",
        )


def xacro_in_safe_mode(span: Span) -> YamaroError:
    """Return the error for xacro where no jail confines its Python."""
    return failure(
        "unsafe-code",
        "xacro expressions are Python, which safe mode runs only in a jail",
        span,
        hint="this system has no jail; use --trust if you trust the source of the file",
    )


def xml_content(root: Element, prefix: object, frame: Frame, inner: Frame | None) -> list[Node]:
    """Return what stands under the root of an XML file, reached by an include.

    Args:
        root: the root.
        prefix: put in front of the names of links and joints, wherever they are named.
        frame: the include.
        inner: the trace of what is in the elements under the root.
    """
    text = format_value(prefix)
    if text:
        rename(root, text)
    _tidy(root, inner)
    for child in root.children:
        if isinstance(child, Element):
            child.trace = frame
    mark_included(root, text)
    return root.children


def mark_included(root: Element, prefix: str) -> None:
    """Note on what stands under a root that it is of one file, and the prefix of the include."""
    robot = IncludedRobot(prefix)
    for child in root.children:
        if isinstance(child, Element):
            child.body = robot


def tidy_root(root: Element, inner: Frame | None) -> Element:
    """Return the root of an XML file that is a document of its own."""
    _tidy(root, inner)
    root.trace = None
    return root


def declare_prefixes(root: Element, content: list[Node]) -> None:
    """Declare prefixes where they are used, as the root that declares them is left out."""
    declared = {
        name[6:]: value
        for name, value in root.attributes.items()
        if name.startswith("xmlns:") and name != "xmlns:xacro"
    }
    if not declared:
        return
    for element in content:
        if isinstance(element, Element):
            names = [name for each in element.iter() for name in (each.name, *each.attributes)]
            for prefix in [name.partition(":")[0] for name in names if ":" in name]:
                if prefix in declared:
                    element.attributes.setdefault(f"xmlns:{prefix}", declared[prefix])


def _tidy(root: Element, trace: Frame | None) -> None:
    """Leave out the white space between elements, and give them a trace.

    CDATA sections become plain text, which the writer knows.
    """
    for element in root.iter():
        element.trace = trace
        if element is root or element.elements():
            element.children = [
                child
                for child in element.children
                if not isinstance(child, Text) or format_value(child.value).strip()
            ]
        for index, child in enumerate(element.children):
            if type(child) is CData:
                element.children[index] = Text(child.value, child.span)


def include_xml(
    interpreter: Interpreter,
    node: IncludeNode,
    source: Source,
    passed: dict[str, Any],
    namespace: str | None,
    out: list[Node],
) -> None:
    """Add what an XML file contains: URDF as it is, or what a xacro file expands to.

    Args:
        interpreter: the conversion.
        node: the include.
        source: the file.
        passed: the variables passed to it.
        namespace: the namespace that was asked for.
        out: takes what it holds.

    Raises:
        YamaroError: the file has errors, or may not be passed this.
    """
    frame = interpreter.step("included", source.name, node.span, None)
    try:
        root, is_xacro = read_included(source, interpreter.limits)
    except YamaroError as error:
        add_trace(error, frame)
        raise
    check_xml_include(node, is_xacro=is_xacro)
    if is_xacro and interpreter.safety is not None and not interpreter.policy.is_confined:
        raise xacro_in_safe_mode(node.path_span)
    interpreter.enter(frame, node.path_span)
    try:
        if is_xacro:
            if node.own_prefix is not None:
                from ..xacro.symbol_table import ARGUMENT, definition_of
                from .argument_values import warn_of_own_prefix

                found = filter(None, map(definition_of, root.elements()))
                names = [each.name for each in found if each.kind == ARGUMENT]
                warn_of_own_prefix(node, node.own_prefix, names, source, interpreter.reporter)
            root = _expanded(interpreter, root, passed, node, namespace, frame)
            mark_included(root, "")
            content = root.children
        else:
            root = read_robot(interpreter, root)
            content = xml_content(root, passed.get("prefix"), frame, interpreter.inner_trace(frame))
        declare_prefixes(root, content)
        out += content
    except YamaroError as error:
        add_trace(error, frame)
        raise
    finally:
        interpreter.leave(frame)


def _expanded(
    interpreter: Interpreter,
    root: Element,
    passed: dict[str, Any],
    node: IncludeNode,
    namespace: str | None,
    frame: Frame,
) -> Element:
    """Return the root of what a xacro file expands to, given its own."""
    from ..xacro.expansion import expand

    source = root.span.source
    host = XacroHost(
        interpreter.files,
        interpreter.messages,
        interpreter.limits,
        main=source,
        has_environment=interpreter.safety is None,
    )
    arguments = {
        argument.name: interpreter.evaluator.text(
            format_value, passed[argument.name], argument.span
        )
        for argument in node.arguments
        if argument.name is not None
    }
    if node.namespace is not None:
        arguments["namespace"] = str(namespace)
    places = {each.name: each.span for each in node.arguments if each.name is not None}
    noted = None if interpreter.noted is None else interpreter.noted.of_xacro()
    return expand(
        source,
        host,
        arguments,
        interpreter.reporter,
        root=root,
        frame=frame,
        places=places,
        noted=noted,
    )


# --- what a xacro file may ask of its surroundings --------------------------------------------


class XacroHost:
    """Gives a xacro file what files of Yamaro get, under the same limits and from the same places.

    Attributes:
        limits: how much the expansion may use.
    """

    def __init__(
        self,
        files: Files,
        messages: Messages,
        limits: Limits,
        *,
        main: Source,
        has_environment: bool,
    ) -> None:
        """Serve the expansion of `main`; safe mode has no environment."""
        self.limits = limits
        self._files = files
        self._messages = messages
        self._main = main
        self._has_environment = has_environment

    def read(self, path: str, span: Span) -> Source:
        """Return the text of a file.

        Raises:
            YamaroError: it cannot be read.
        """
        absolute = os.path.abspath(path)
        try:
            return self._files.read_xml(absolute, self._shown(absolute), span)
        except LoadError as error:
            near = self._files.neighbours(absolute)
            raise failure(
                error.code,
                f"the file '{os.path.basename(path)}' cannot be read: {error}",
                span,
                hint=error.hint or did_you_mean(os.path.basename(absolute), near),
                notes=[f"searched for {absolute}"],
            ) from None

    def glob(self, pattern: str) -> list[str]:
        """Return the paths that a pattern of the shell matches."""
        from glob import glob

        return glob(pattern)

    def find_package(self, name: str, span: Span) -> str:
        """Return the folder of a ROS package.

        Raises:
            YamaroError: there is no such package.
        """
        start = os.path.dirname(span.source.path or self._main.path)
        folder = self._files.packages.find(name, start, span)
        if folder is None:
            raise self._files.unknown_package(name, span, start)
        return folder

    def environment(self, name: str) -> str | None:
        """Return a variable of the environment, or None if it is not set."""
        return os.environ.get(name) if self._has_environment else None

    def folder(self) -> str:
        """Return the current folder."""
        return os.getcwd()

    def say(self, text: str, span: Span) -> None:
        """Show a message."""
        self._messages.say(text)

    def _shown(self, path: str) -> str:
        """Return what a file is called in messages: as the main file is, where it lies near."""
        try:
            relative = os.path.relpath(path, os.path.dirname(self._main.path))
        except ValueError:  # on another drive
            return path
        if os.path.isabs(self._main.name) or relative.startswith(os.path.join("..", "..", "..")):
            return path
        return os.path.normpath(os.path.join(os.path.dirname(self._main.name), relative))


# --- URDF or xacro as the main file -----------------------------------------------------------


def run_xml_main(
    source: Source,
    interpreter: Interpreter,
    arguments: Mapping[str, str],
    places: Mapping[str, Span],
    reporter: Reporter,
) -> tuple[Element, bool]:
    """Return the root of a URDF as it is, or of what xacro makes of it; and whether it is xacro's.

    Args:
        source: the main file.
        interpreter: gives files, packages, limits, and how far the file is trusted.
        arguments: what is set of the arguments of a xacro file, as it is written.
        places: where those are set that were set on the command line.
        reporter: takes the warnings.

    Raises:
        YamaroError: the input has errors, or a xacro file is not trusted, and there is no jail.
    """
    files, limits, safety = interpreter.files, interpreter.limits, interpreter.safety
    try:
        files.note(source.path or source.name)
        root, is_xacro = read_included(source, limits)
        if not is_xacro:
            robot = read_robot(interpreter, root)
            if robot is root:
                tidy_root(root, interpreter.inner_trace(None))
            return robot, False
        if safety is not None and not interpreter.policy.is_confined:
            raise xacro_in_safe_mode(Span(source, root.span.start, root.span.end))
        from ..xacro.expansion import expand

        host = XacroHost(
            files, interpreter.messages, limits, main=source, has_environment=safety is None
        )
        noted = None if interpreter.noted is None else interpreter.noted.of_xacro()
        expanded = expand(source, host, arguments, reporter, root=root, places=places, noted=noted)
        return expanded, True
    finally:
        interpreter.messages.close()
        files.close()
