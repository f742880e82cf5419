"""Macros of other packages that are called where they are.

Only xacro can call a macro of xacro. So that the files of another package stay where they are, each
of its macros that the robot calls has a file of xacro among the sources: it includes the package's
file and calls the macro, with arguments of its own as the parameters. The sources include that.
"""

from __future__ import annotations

import os
from xml.sax.saxutils import quoteattr

from ....model.compare import POSE
from ....syntax.names import is_identifier
from ....xml.tree import Element
from ....xml.values import format_value
from ..document import Body, Entry

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection

    from .macros import Macro
    from .program import XacroProgram
    from .writer import FileWriter

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
        names = self._names()
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

    def _names(self) -> list[str]:
        """Return the arguments of the file that calls it."""
        poses = [
            f"{block.lstrip('*')}_{key}"
            for block, pose in zip(self.macro.blocks(), self._poses, strict=False)
            for key in pose
        ]
        return [*self._values, *poses, *self._arguments]

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
