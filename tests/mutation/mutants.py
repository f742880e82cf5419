"""Makes the mutants of a module: mutmut says what to change, and this compiles what comes of it.

A mutant is one function or method with one change in it, as a code object. It takes the place of
the code of the living function, so nothing has to be imported anew, and no file is written.
"""

from __future__ import annotations
import __future__

import difflib
import gc
import importlib
import random
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from types import CodeType, FunctionType
from typing import Any

import libcst
from libcst.metadata import MetadataWrapper, ParentNodeProvider, PositionProvider
from mutmut.mutation.file_mutation import MutationVisitor, OuterFunctionProvider, deep_replace
from mutmut.mutation.mutators import mutation_operators
from mutmut.mutation.pragma_handling import get_ignored_lines

SOURCE = Path(__file__).parents[2] / "src" / "yamaro"
FLAGS = __future__.annotations.compiler_flag
COMPOUND = (libcst.BaseCompoundStatement, libcst.BaseSuite)


class Mutant:
    """A function with one change in it.

    Attributes:
        module: Such as `syntax/keys`.
        function: Its name, behind that of its class.
        lines: A test has to run one of these lines to notice anything.
        change: The lines without and with the change.
        is_default: The change is in the default of a parameter.
    """

    def __init__(
        self, module: str, function: str, lines: range, text: str, change: str, is_default: bool
    ) -> None:
        self.module = module
        self.function = function
        self.lines = lines
        self.change = change
        self.is_default = is_default
        self._text = text

    def apply(self) -> None:
        """Put the change into the function that this process runs.

        Raises:
            ValueError: it cannot take the place of the function's code.
        """
        module = importlib.import_module("yamaro." + self.module.replace("/", "."))
        code = compile(self._text, str(module.__file__), "exec", flags=FLAGS, dont_inherit=True)
        function = _living(vars(module), self.function)
        before, after = function.__code__, _code_of(code, self.function)
        function.__code__ = after
        _replace_inner(before, after)
        if self.is_default:
            names = dict(vars(module))
            exec(code, names)
            changed = _living(names, self.function)
            function.__defaults__ = changed.__defaults__
            function.__kwdefaults__ = changed.__kwdefaults__


def _replace_inner(before: CodeType, after: CodeType) -> None:
    """Replace the code of the functions that a function made when its module was imported."""
    old, new = ([c for c in code.co_consts if isinstance(c, CodeType)] for code in (before, after))
    for old_code, new_code in zip(old, new, strict=False):  # there may be a lambda less
        if old_code.co_name != new_code.co_name or old_code == new_code:
            continue
        gc.unfreeze()  # what is frozen cannot be found
        for living in gc.get_referrers(old_code):
            if isinstance(living, FunctionType):
                living.__code__ = new_code
        _replace_inner(old_code, new_code)


def path_of(module: str) -> Path:
    return SOURCE / f"{module}.py"


def modules_of(folder: str) -> list[str]:
    """Return the modules of a package."""
    paths = sorted((SOURCE / folder).glob("*.py"))
    return [f"{folder}/{path.stem}" for path in paths if path.stem != "__init__"]


def sample(mutants: list[Mutant], size: int, seed: int) -> list[Mutant]:
    """Return so many mutants by chance, the same each time; all of them if there are no more."""
    if len(mutants) <= size:
        return mutants
    chance = random.Random(f"{seed} {mutants[0].module}")
    return [mutants[i] for i in sorted(chance.sample(range(len(mutants)), size))]


def make_mutants(module: str) -> list[Mutant]:
    """Return all mutants of a module that Python can compile."""
    path = path_of(module)
    text = path.read_text(encoding="utf-8")
    wrapper = MetadataWrapper(libcst.parse_module(text))
    visitor = MutationVisitor(mutation_operators, get_ignored_lines(str(path), text, wrapper))
    wrapper.visit(visitor)
    outer = wrapper.resolve(OuterFunctionProvider)
    tree = Tree(
        wrapper.module, wrapper.resolve(ParentNodeProvider), wrapper.resolve(PositionProvider)
    )
    mutants: list[Mutant] = []
    seen: Counter[tuple[str, str]] = Counter()
    for mutation in visitor.mutations:
        function = outer.get(mutation.original_node)
        if not isinstance(function, libcst.FunctionDef):
            continue  # of a class or a module; it was run when that was imported
        changed = deep_replace(function, mutation.original_node, mutation.mutated_node)
        assert isinstance(changed, libcst.FunctionDef)
        code = tree.code_of(function, changed)
        try:
            compile(code, "mutant", "exec", flags=FLAGS, dont_inherit=True)
        except SyntaxError:
            continue
        name = tree.name_of(function)
        change = difference(tree.code_of(function, function), code)
        seen[name, change] += 1
        if seen[name, change] > 1:  # the same line stands there twice
            change += f" ({seen[name, change]})"
        lines = tree.lines_around(mutation.original_node, function)
        mutants.append(
            Mutant(module, name, lines or tree.lines_of(function), code, change, lines is None)
        )
    return mutants


class Tree:
    """The syntax tree of a module."""

    def __init__(
        self, module: libcst.Module, parents: Mapping[Any, Any], positions: Mapping[Any, Any]
    ) -> None:
        self._module = module
        self._parents = parents
        self._positions = positions

    def class_of(self, function: libcst.FunctionDef) -> libcst.ClassDef | None:
        node = self._parents[function]
        while not isinstance(node, libcst.Module):
            if isinstance(node, libcst.ClassDef):
                return node
            node = self._parents[node]
        return None

    def name_of(self, function: libcst.FunctionDef) -> str:
        name: str = function.name.value
        class_ = self.class_of(function)
        return f"{class_.name.value}.{name}" if class_ else name

    def code_of(self, function: libcst.FunctionDef, changed: libcst.FunctionDef) -> str:
        """Return a module of one function, or of a class with one, on the lines it stands on."""
        code: Any = changed.with_changes(leading_lines=())
        class_ = self.class_of(function)
        if class_ is not None:
            body = class_.body.with_changes(body=[code])
            code = class_.with_changes(
                body=body, bases=(), keywords=(), decorators=(), leading_lines=()
            )
        text: str = self._module.with_changes(header=(), body=[code], footer=()).code
        first_line: int = self._positions[function].start.line
        return "\n" * (first_line - (2 if class_ else 1)) + text

    def lines_around(self, node: libcst.CSTNode, function: libcst.FunctionDef) -> range | None:
        """Return the lines of the smallest statement around a node, or of the head it stands in.

        None if it stands in the head of the function itself.
        """
        while True:
            parent = self._parents[node]
            if parent is function and not isinstance(node, libcst.BaseSuite):
                return None
            if isinstance(node, libcst.BaseSmallStatement) or isinstance(parent, COMPOUND):
                position = self._positions[node]
                return range(position.start.line, position.end.line + 1)
            node = parent

    def lines_of(self, function: libcst.FunctionDef) -> range:
        """Return the lines of a function below its first."""
        position = self._positions[function]
        return range(position.start.line + 1, position.end.line + 1)


def difference(before: str, after: str) -> str:
    """Return the lines that differ, those before with `-` in front and those after with `+`."""
    lines = difflib.unified_diff(before.splitlines(), after.splitlines(), lineterm="", n=0)
    told = [
        line[0] + " " + line[1:].strip() for line in lines if line[:2] not in ("--", "++", "@@")
    ]
    return " ".join(told)


def _living(names: Mapping[str, Any], name: str) -> FunctionType:
    class_name, _, method = name.rpartition(".")
    found = vars(names[class_name])[method] if class_name else names[name]
    found = getattr(found, "__func__", found)
    assert isinstance(found, FunctionType)
    return found


def _code_of(code: CodeType, name: str) -> CodeType:
    """Return the code of a function that the code of a module makes."""
    for part in name.split("."):
        code = next(c for c in code.co_consts if isinstance(c, CodeType) and c.co_name == part)
    return code
