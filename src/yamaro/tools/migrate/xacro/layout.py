"""Which files of a robot in xacro become sources, and where in the output folder these are.

The files of the main file's package, or those in no package if it is in none, become sources. Files
of other packages are included as they are, unless something in them has no meaning alone: a
macro that others call with more than texts, a property that others read, and the other way round.
"""

from __future__ import annotations

import os
from collections.abc import Collection
from typing import NamedTuple

from ....files.packages import manifest_name
from ....syntax.names import is_identifier
from ....xacro.symbol_table import ARGUMENT, BLOCK, MACRO, definition_of, used_in
from ....xml.tree import Element
from ....xml.values import format_value
from ..elements import name_of
from .includes import Borrowed, calls_of, computed_name, source_name
from .names import common_folder
from .program import XacroProgram

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

_WORDS = ("path", "namespace")
"""The words of an include, which are not arguments."""
ALL = "*"
"""Means every package."""
ASKED = "asked for"
"""Why files become sources whose packages were named."""


class Plan(NamedTuple):
    """How sources are written: all at first, and less where they make another robot."""

    wanted: Collection[str] = ()
    """The packages whose files become sources even if they could stay as they are, or ALL."""
    has_section: bool = True
    """Whether arguments are declared in a section, if that is possible."""
    has_control: bool = True
    """Whether blocks for ros2_control are written in words, if that is possible."""
    borrows: bool = True
    """Whether macros of other packages are called where they are, if they can be."""


class Layout:
    """Where the sources of a robot are.

    Attributes:
        outputs: their paths in the output folder, by those of the xacro files.
        theirs: the files that stay as they are: package, and path in it.
        brought: the files of other packages that become sources anyway, with the reason.
        borrowed: the macros of other packages that are called where they are, by name.
    """

    def __init__(self, program: XacroProgram, plan: Plan) -> None:
        """Lay out a robot by a plan."""
        self._borrows = plan.borrows
        self.borrowed: dict[str, Borrowed] = {}
        self._program = program
        self._packages: dict[str, tuple[str, str]] = {}
        self.theirs: dict[str, tuple[str, str]] = {}
        self.brought: dict[str, str] = {}
        self._own = self.package_of(program.main)
        self._in_macros = {
            id(element)
            for macro in program.definitions.values()
            for element in macro.element.iter()
            if element.name == "xacro:include"
        }
        foreign = {}
        for path in program.roots:
            name, folder = package = self.package_of(path)
            if package != self._own and name and program.files.finds(name) == folder:
                foreign[path] = package
                if name in plan.wanted or ALL in plan.wanted:
                    self.brought[path] = ASKED
        # bring along the files of other packages that cannot be included alone
        names = {own: _NamesUsed(self._program, own) for own in self._program.roots}
        is_new = True
        while is_new:
            is_new = False
            migrated = [own for own in names if own not in foreign or own in self.brought]
            for own in migrated:
                for include in _includes_of(self._program.roots[own]):
                    for target in self._program.files.files_of(include):
                        if target in foreign and target not in self.brought:
                            reason = self._why_coupled(include, target, names)
                            if reason:
                                self.brought[target] = reason
                                is_new = True
        for path, (name, folder) in foreign.items():
            if path not in self.brought:
                self.theirs[path] = name, os.path.relpath(path, folder)
        own_files = [
            path for path in program.roots if path not in self.theirs and path not in self.brought
        ]
        own_data = [path for path in program.runs.relative if self.package_of(path) == self._own]
        self._folder = common_folder([*own_files, *own_data])
        self.outputs: dict[str, str] = {}
        for path in program.roots:
            if path not in self.theirs:
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
                self.outputs[path] = unique
        # give each macro that is called where it is the file that calls it
        self.borrowed = {
            name: each for name, each in self.borrowed.items() if each.path in self.theirs
        }
        for name, each in self.borrowed.items():
            folder = os.path.dirname(self.outputs[each.caller])
            each.output = os.path.join(folder, f"call_{name}.xacro")

    def calling_files(self) -> dict[str, str]:
        """Return the files that call macros of other packages, by their paths in the output."""
        return {
            each.output: each.text("$(find {})/{}".format(*self.theirs[each.path]))
            for each in self.borrowed.values()
        }

    def makes_nothing(self, path: str, but: str = "") -> bool:
        """Return whether a file, with those it includes, makes no elements `but` of one name."""
        return all(_only_defines(self._program.roots[own], but) for own in self._reached_from(path))

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

    def _in_package(self, path: str) -> str:
        name, folder = self.package_of(path)
        return os.path.join(name, os.path.relpath(path, folder))

    # --- what has to come along -----------------------------------------------------------------

    def _why_coupled(self, include: Element, path: str, names: dict[str, _NamesUsed]) -> str:
        """Return why a file cannot be included as it is where it is; "" if it can."""
        filename = format_value(include.attributes["filename"])
        if "ns" in include.attributes:
            return "it is included in a namespace"
        if computed_name(filename) is not None and not filename.startswith("$(find "):
            return "the name of the file is computed"
        inside = self._reached_from(path)
        within = _NamesUsed.of(names[own] for own in inside)
        without = _NamesUsed.of(own for other, own in names.items() if other not in inside)
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
            if one is within.macros:
                shared = [name for name in shared if not self._borrow(name, path, inside, without)]
            if shared:
                return what.format(shared[0])
        if (within.has_computed_calls and without.macros) or (
            without.has_computed_calls and within.macros
        ):
            return "the macros that are called are computed"
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

    def _borrow(self, name: str, path: str, inside: set[str], without: _NamesUsed) -> bool:
        """Return whether a macro of a file can be called where it is, and remember that."""
        defined = [own for own in self._program.definitions.values() if own.name == name]
        others = [root for own, root in self._program.roots.items() if own not in inside]
        is_plain = not self.makes_nothing(path)
        calls = [calls_of(name, root, is_plain=is_plain) for root in others]
        if not self._borrows or len(defined) != 1:
            return False
        if is_plain and not self.makes_nothing(path, but="material"):
            return False  # a material is left out where it is known
        if any(each is None for each in calls):
            return False
        found = Borrowed(
            defined[0],
            path,
            [call for each in calls for call in each or ()],
            self.arguments_of(path),
        )
        around = without.defined | without.parameters
        if not found.can_be_called(around, self._program):
            return False
        self.borrowed[name] = found
        return True

    def _reached_from(self, path: str) -> set[str]:
        includes = _includes_of(self._program.roots[path])
        return {path} | self._program.namespaces.reached_by(includes)

    def arguments_of(self, path: str) -> list[str]:
        """Return the arguments that a file reads which stays as it is, and those it includes."""
        inside = self._reached_from(path)
        found = _NamesUsed.of(_NamesUsed(self._program, own) for own in inside)
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


class _NamesUsed:
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
        for element in root.iter():
            own = definition_of(element)
            if own is not None:
                sets = {MACRO: self.macros, BLOCK: self.blocks, ARGUMENT: self.declared}
                sets.get(own.kind, self.defined).add(own.name)
                macro = program.definitions.get((path, element.span.start))
                if own.kind == MACRO and macro is not None:
                    self.parameters.update(macro.values())
                    self.blocks.update(each.lstrip("*") for each in macro.blocks())
            elif element.name == "xacro:call":
                self.calls.add(format_value(element.attributes.get("macro")))
                self.has_computed_calls |= "$" in format_value(element.attributes.get("macro"))
            elif element.name.startswith("xacro:"):
                self.calls.add(element.name.removeprefix("xacro:"))
        self.arguments |= self.declared
        self._find_inserted(root, set())

    def _find_inserted(self, root: Element, own: Collection[str]) -> None:
        """Find the blocks that are inserted where no macro around has a parameter for them."""
        for element in root.elements():
            name = name_of(element)
            if element.name == "xacro:insert_block" and name not in own:
                self.inserted.add(name)
            blocks = own
            found = definition_of(element)
            if found is not None and found.kind == MACRO:
                blocks = {each.name.lstrip("*") for each in found.parameters() if each.is_block}
            self._find_inserted(element, blocks)

    @classmethod
    def of(cls, several: Iterable[_NamesUsed]) -> _NamesUsed:
        """Return the names of several files together."""
        joined = cls.__new__(cls)
        known = list(several)
        for key in _SETS:
            setattr(joined, key, set().union(*(getattr(each, key) for each in known)))
        joined.has_computed_calls = any(each.has_computed_calls for each in known)
        return joined


def _only_defines(root: Element, but: str) -> bool:
    """Return whether a file has only definitions, includes and elements of one name."""
    return all(
        element.name in ("xacro:macro", "xacro:property", "xacro:include", "xacro:arg", but)
        or (element.name in ("xacro:if", "xacro:unless") and _only_defines(element, but))
        for element in root.elements()
    )


def _includes_of(root: Element) -> list[Element]:
    return [
        element
        for element in root.iter()
        if element.name == "xacro:include" and "filename" in element.attributes
    ]
