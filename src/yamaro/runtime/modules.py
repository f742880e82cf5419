"""Imports Python modules for a file: those beside it first, loaded again for each conversion.

Modules beside the YAML file never enter `sys.modules` under their own name, so two robots may each
have their `helpers.py`, and a `random.py` beside a robot does no harm to anyone else's `random`.
While a conversion runs they are there under a private name, which dataclasses, for one, need.
"""

from __future__ import annotations

import builtins
import os
import sys

from ..diagnostics import InputFault, did_you_mean
from ..files.regular import open_regular
from ..syntax.nodes import ImportNode
from .expressions import run_module

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from types import CodeType, ModuleType
    from typing import Any

    from ..safe.runtime import SafeRuntime


class LocalModules:
    """The modules in one folder, for one conversion."""

    __slots__ = ("_codes", "_directory", "_modules", "_note", "_prefix")

    def __init__(
        self, directory: str, codes: dict[str, CodeType], note: Callable[[str], None]
    ) -> None:
        """Look for modules in a folder.

        Args:
            directory: the folder.
            codes: holds those compiled before, by their paths.
            note: takes the path of each file that is read.
        """
        self._directory = directory
        self._codes = codes
        self._modules: dict[str, ModuleType] = {}
        self._note = note
        self._prefix = f"_yamaro_{id(self):x}"

    def close(self) -> None:
        """Take the modules out of `sys.modules`."""
        for name in self._modules:
            sys.modules.pop(f"{self._prefix}.{name}", None)

    def find(self, name: str) -> str | None:
        """Return the file of a module beside the YAML file, or None."""
        if not self._directory:
            return None
        base = os.path.join(self._directory, *name.split("."))
        for path in (f"{base}.py", os.path.join(base, "__init__.py")):
            if os.path.isfile(path):
                return path
        return None

    def load(self, name: str) -> ModuleType:
        """Return the module `name`, which `find` has found, with its packages loaded first."""
        if name in self._modules:
            return self._modules[name]
        parent_name, _, child = name.rpartition(".")
        parent = self.load(parent_name) if parent_name else None
        path = self.find(name)
        if path is None:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
        module = type(sys)(name)
        is_package = os.path.basename(path) == "__init__.py"
        fields: dict[str, Any] = module.__dict__
        fields["__name__"] = f"{self._prefix}.{name}"
        fields["__file__"] = path
        fields["__package__"] = name if is_package else parent_name
        if is_package:
            fields["__path__"] = [os.path.dirname(path)]
        fields["__builtins__"] = {**vars(builtins), "__import__": self.import_hook}
        self._modules[name] = module
        sys.modules[fields["__name__"]] = module
        try:
            code = self._codes.get(path)
            if code is None:
                with open_regular(path) as file:
                    code = compile(file.read(), path, "exec", dont_inherit=True)
                self._codes[path] = code
            self._note(path)
            run_module(code, fields)
        except BaseException:
            del self._modules[name]
            sys.modules.pop(fields["__name__"], None)
            raise
        if parent is not None:
            setattr(parent, child, module)
        return module

    def import_hook(
        self,
        name: str,
        globals: Mapping[str, object] | None = None,
        locals: Mapping[str, object] | None = None,
        fromlist: Sequence[str] | None = (),
        level: int = 0,
    ) -> ModuleType:
        """Replace `__import__` in code that sees the modules beside the YAML file."""
        if level > 0:
            package = str((globals or {}).get("__package__") or "")
            parts = package.split(".")
            base = ".".join(parts[: len(parts) - level + 1])
            name = f"{base}.{name}" if base and name else base or name
        first = name.partition(".")[0]
        if level == 0 and self.find(first) is None:
            return __import__(name, globals, locals, fromlist or (), 0)
        module = self.load(name)
        for item in fromlist or ():
            if not hasattr(module, item) and self.find(f"{name}.{item}"):
                self.load(f"{name}.{item}")
        return module if fromlist else self.load(first)


def import_names(node: ImportNode, local: LocalModules) -> dict[str, Any]:
    """Return the names that an import of a file binds, with their values.

    Raises:
        InputFault: there is no such module, or it has no such name.
        Exception: whatever the module raises while it is loaded.
    """
    names = [name for name, _ in node.names] if node.names is not None else []
    fromlist = names or (["*"] if node.alias else [])
    try:
        module: Any = local.import_hook(node.module, None, None, fromlist, 0)
    except ModuleNotFoundError as error:
        if error.name is None or not f"{node.module}.".startswith(f"{error.name}."):
            raise
        raise InputFault(
            "unknown-module",
            f"the Python module '{error.name}' is not found",
            node.hint
            or "modules are searched for beside this file and among "
            "the installed modules; is it installed?",
        ) from None
    if node.names is None:
        if node.alias is not None:
            return {node.alias: module}
        return {node.module.partition(".")[0]: module}
    bound = {}
    for name, alias in node.names:
        if not hasattr(module, name):
            raise InputFault(
                "unknown-module",
                f"the module '{node.module}' has no '{name}'",
                did_you_mean(name, dir(module)),
            )
        bound[alias] = getattr(module, name)
    return bound


def import_safe_names(node: ImportNode, local: LocalModules, safety: SafeRuntime) -> dict[str, Any]:
    """Return the names that an import binds in safe mode, with substitutes for their values.

    Raises:
        InputFault: the module, or what is asked of it, is not allowed.
    """
    first, *inner = node.module.split(".")
    if local.find(first) is not None:
        raise safety.refusal_of_module(first, "it is Python code beside this file")
    whole = module = safety.module(first)
    for name in inner:
        module = safety.attribute(module, name)
    if node.names is None:
        return {first: whole} if node.alias is None else {node.alias: module}
    return {alias: safety.attribute(module, name) for name, alias in node.names}
