"""Which files of a robot in xacro become sources, and where in the output folder these are.

The files of the main file's package, or those in no package if it is in none, become sources. Files
of other packages are included as they are, unless something in them has no meaning alone: a
macro that others call, a property that others read, and the other way round.
"""

from __future__ import annotations

import os

from ....files.packages import manifest_name
from ....syntax.names import is_identifier
from ....xml.tree import Element
from ....xml.values import format_value
from ..elements import walk
from .includes import computed_name, source_name
from .names import common_folder, used_in
from .program import XacroProgram

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Iterable

_WORDS = ("path", "namespace")
"""The words of an include, which are not arguments."""
ALL = "*"
"""Means every package."""
ASKED = "asked for"
"""Why files become sources whose packages were named."""


class Layout:
    """Where the sources of a robot are.

    Attributes:
        outputs: their paths in the output folder, by those of the xacro files.
        theirs: the files that stay as they are: package, and path in it.
        brought: the files of other packages that become sources anyway, with the reason.
    """

    def __init__(self, program: XacroProgram, wanted: Collection[str]) -> None:
        """Lay out a robot.

        Args:
            program: the robot.
            wanted: the packages whose files become sources as well, or ALL.
        """
        self._program = program
        self._packages: dict[str, tuple[str, str]] = {}
        self.theirs: dict[str, tuple[str, str]] = {}
        self.brought: dict[str, str] = {}
        self._own = self.package_of(program.main)
        self._in_macros = {
            id(element)
            for macro in program.definitions.values()
            for element in walk(macro.element)
            if element.name == "xacro:include"
        }
        foreign = {}
        for path in program.roots:
            package = self.package_of(path)
            if package != self._own and self._may_be_found(*package):
                foreign[path] = package
                if package[0] in wanted or ALL in wanted:
                    self.brought[path] = ASKED
        self._bring_coupled(foreign)
        for path, (name, folder) in foreign.items():
            if path not in self.brought:
                self.theirs[path] = name, os.path.relpath(path, folder)
        self._folder = common_folder([*self._own_files(), *self._own_data()])
        self.outputs: dict[str, str] = {}
        for path in program.roots:
            if path not in self.theirs:
                self.outputs[path] = self._output(path)

    def _own_files(self) -> list[str]:
        return [
            path
            for path in self._program.roots
            if path not in self.theirs and path not in self.brought
        ]

    def _own_data(self) -> list[str]:
        """Return the data that own files name by relative paths."""
        relative = self._program.runs.relative
        return [path for path in relative if self.package_of(path) == self._own]

    # --- packages -------------------------------------------------------------------------------

    def package_of(self, path: str) -> tuple[str, str]:
        """Return the name and the folder of the package that a file is in; two "" for none."""
        folder = os.path.dirname(path)
        if folder not in self._packages:
            self._packages[folder] = self._find_package(folder)
        return self._packages[folder]

    def _find_package(self, folder: str) -> tuple[str, str]:
        around = folder
        while True:
            name = manifest_name(around)
            if name:
                return name, around
            if os.path.dirname(around) == around:
                break
            around = os.path.dirname(around)
        known = self._program.runs.packages
        holding = [name for name, own in known.items() if f"{folder}/".startswith(f"{own}/")]
        name = max(holding, key=lambda name: len(known[name]), default="")
        return name, known.get(name, "")

    def _may_be_found(self, name: str, folder: str) -> bool:
        """Return whether an include can name a file by its package."""
        return bool(name) and self._program.files.finds(name) == folder

    # --- outputs --------------------------------------------------------------------------------

    def output_of_data(self, path: str) -> str | None:
        """Return where data is copied to; None if it is found through its package."""
        package = self.package_of(path)
        if package == self._own:
            relative = os.path.relpath(path, self._folder)
            return None if relative.startswith("..") else relative
        brought = {self.package_of(own) for own in self.brought}
        return self._in_package(path) if package in brought else None

    def folder_of(self, folder: str) -> str | None:
        """Return the folder of the output that a folder becomes; None for none."""
        pretended = os.path.join(folder, "x.xacro")
        package = self.package_of(pretended)
        if package == self._own:
            relative = os.path.relpath(folder, self._folder)
            return None if relative.startswith("..") else relative
        brought = {self.package_of(own) for own in self.brought}
        return os.path.dirname(self._in_package(pretended)) if package in brought else None

    def _output(self, path: str) -> str:
        if path in self.brought:
            relative = self._in_package(path)
        else:
            relative = os.path.relpath(path, self._folder)
        stem = source_name(relative).removesuffix(".yaml")
        taken = set(self.outputs.values()) | self._program.files.data.keys()
        unique, number = f"{stem}.yaml", 2
        if unique in taken:  # arm.urdf.xacro beside arm.xacro: they differ in the ending
            endings = os.path.basename(path)[len(os.path.basename(stem)) :].split(".")[1:]
            stem = "_".join([stem, *(endings[:-1] or endings)])
            unique = f"{stem}.yaml"
        while unique in taken:
            unique, number = f"{stem}_{number}.yaml", number + 1
        return unique

    def _in_package(self, path: str) -> str:
        name, folder = self.package_of(path)
        return os.path.join(name, os.path.relpath(path, folder))

    # --- what has to come along -----------------------------------------------------------------

    def _bring_coupled(self, foreign: Collection[str]) -> None:
        """Bring along the files of other packages that cannot be included alone."""
        names = {path: _Names(self._program, path) for path in self._program.roots}
        is_new = True
        while is_new:
            is_new = False
            migrated = [path for path in names if path not in foreign or path in self.brought]
            for path in migrated:
                for include in _includes_of(self._program.roots[path]):
                    for target in self._program.files.files_of(include):
                        if target in foreign and target not in self.brought:
                            reason = self._why_coupled(include, target, names)
                            if reason:
                                self.brought[target] = reason
                                is_new = True

    def _why_coupled(self, include: Element, path: str, names: dict[str, _Names]) -> str:
        """Return why a file cannot be included as it is where it is; "" if it can."""
        filename = format_value(include.attributes["filename"])
        if "ns" in include.attributes:
            return "it is included in a namespace"
        if computed_name(filename) is not None and not filename.startswith("$(find "):
            return "the name of the file is computed"
        inside = self._reached_from(path)
        within = _Names.of(names[own] for own in inside)
        without = _Names.of(own for other, own in names.items() if other not in inside)
        around = without.defined
        if id(include) in self._in_macros:
            around = around | without.parameters
        read = within.read - within.defined - within.parameters
        for what, one, other in (
            ("its macro '{}' is called", within.macros, without.calls),
            ("it calls the macro '{}'", without.macros, within.calls - within.macros),
            ("its block '{}' is inserted", within.blocks, without.inserted),
            ("it inserts the block '{}'", without.blocks, within.inserted - within.blocks),
            ("it reads the property '{}'", around, read),
            ("its property '{}' is read", within.defined, without.read),
        ):
            shared = sorted(one & other - self._program.constants(inside))
            if shared:
                return what.format(shared[0])
        if (within.has_computed_calls and without.macros) or (
            without.has_computed_calls and within.macros
        ):
            return "the macros that are called are computed"
        return self._why_arguments(within, without)

    def _why_arguments(self, within: _Names, without: _Names) -> str:
        for name in sorted(within.arguments):
            argument = self._program.arguments.get(name)
            if argument is None:
                return f"its argument '{name}' has no value"
            if not is_identifier(name) or name in _WORDS:
                return f"its argument '{name}' has a name that an include cannot pass"
            if name in within.declared and (len(argument.defaults) > 1 or argument.made_of):
                return f"the default of its argument '{name}' is made of other names"
            if name in within.declared - without.declared and name in without.arguments:
                return f"its argument '{name}' is read by others"
        return ""

    def _reached_from(self, path: str) -> set[str]:
        includes = _includes_of(self._program.roots[path])
        return {path} | self._program.namespaces.reached_by(includes)

    def arguments_of(self, path: str) -> list[str]:
        """Return the arguments that a file reads which stays as it is, and those it includes."""
        inside = self._reached_from(path)
        found = _Names.of(_Names(self._program, own) for own in inside)
        return [name for name in self._program.arguments if name in found.arguments]


_SETS = (
    "macros",
    "blocks",
    "defined",
    "parameters",
    "calls",
    "inserted",
    "read",
    "arguments",
    "declared",
)


class _Names:
    """The names that files define and use.

    Attributes:
        macros, blocks, defined: those of macros, blocks and values that they define.
        parameters: those of their macros.
        calls, inserted, read: those that they use.
        arguments, declared: the arguments that they read or declare, and declare.
        has_computed_calls: whether they call macros whose names are computed.
    """

    def __init__(self, program: XacroProgram, path: str) -> None:
        """Look at a file."""
        root = program.roots[path]
        self.macros: set[str] = set()
        self.blocks: set[str] = set()
        self.defined: set[str] = set()
        self.parameters: set[str] = set()
        self.calls: set[str] = set()
        self.inserted: set[str] = set()
        self.declared: set[str] = set()
        self.has_computed_calls = False
        self.read = used_in(root) | program.forwarded_in(root)
        self.arguments = program.arguments_read(root)
        for element in walk(root):
            name = format_value(element.attributes.get("name"))
            if element.name == "xacro:macro":
                self.macros.add(name.removeprefix("xacro:"))
                macro = program.definitions.get((path, element.span.start))
                if macro is not None:
                    self.parameters.update(macro.values())
                    self.blocks.update(own.lstrip("*") for own in macro.blocks())
            elif element.name == "xacro:property":
                is_block = "value" not in element.attributes and "default" not in element.attributes
                (self.blocks if is_block else self.defined).add(name)
            elif element.name == "xacro:arg":
                self.declared.add(name)
            elif element.name == "xacro:insert_block":
                self.inserted.add(name)
            elif element.name == "xacro:call":
                self.calls.add(format_value(element.attributes.get("macro")))
                self.has_computed_calls |= "$" in format_value(element.attributes.get("macro"))
            elif element.name.startswith("xacro:"):
                self.calls.add(element.name.removeprefix("xacro:"))
        self.arguments |= self.declared

    @classmethod
    def of(cls, several: Iterable[_Names]) -> _Names:
        """Return the names of several files together."""
        joined = cls.__new__(cls)
        known = list(several)
        for key in _SETS:
            setattr(joined, key, set().union(*(getattr(each, key) for each in known)))
        joined.has_computed_calls = any(each.has_computed_calls for each in known)
        return joined


def _includes_of(root: Element) -> list[Element]:
    return [
        element
        for element in walk(root)
        if element.name == "xacro:include" and "filename" in element.attributes
    ]
