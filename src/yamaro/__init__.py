"""Yamaro compiles YAML robot descriptions to URDF, or any other XML."""

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .api import build as build
    from .api import convert as convert
    from .api import load as load
    from .diagnostics import Diagnostic as Diagnostic
    from .diagnostics import YamaroError as YamaroError
    from .diagnostics import YamaroWarning as YamaroWarning
    from .files.loader import FileLoader as FileLoader
    from .files.loader import LoadError as LoadError
    from .files.loader import MemoryLoader as MemoryLoader
    from .model.pose import Pose as Pose
    from .model.robot import Robot as Robot
    from .options import UsageError as UsageError
    from .policy import Policy as Policy
    from .program import Program as Program
    from .result import Build as Build
    from .tools.sweep.api import Sweep as Sweep
    from .tools.sweep.api import sweep as sweep
    from .tools.sweep.api import sweep_batch as sweep_batch
    from .yaml.nodes import FlexiDict as FlexiDict

__version__ = "1.0.0rc1"
__all__ = [
    "Build",
    "Diagnostic",
    "FileLoader",
    "FlexiDict",
    "LoadError",
    "MemoryLoader",
    "Policy",
    "Pose",
    "Program",
    "Robot",
    "Sweep",
    "UsageError",
    "YamaroError",
    "YamaroWarning",
    "build",
    "convert",
    "load",
    "sweep",
    "sweep_batch",
]

# Where each name comes from when it is first asked for: the command imports this package too, and
# `yamaro --version` or a completion in the shell needs none of them.
_MODULES = {
    "Build": "result",
    "Diagnostic": "diagnostics",
    "FileLoader": "files.loader",
    "FlexiDict": "yaml.nodes",
    "LoadError": "files.loader",
    "MemoryLoader": "files.loader",
    "Policy": "policy",
    "Pose": "model.pose",
    "Program": "program",
    "Robot": "model.robot",
    "Sweep": "tools.sweep.api",
    "UsageError": "options",
    "YamaroError": "diagnostics",
    "YamaroWarning": "diagnostics",
    "build": "api",
    "convert": "api",
    "load": "api",
    "sweep": "tools.sweep.api",
    "sweep_batch": "tools.sweep.api",
}


if not TYPE_CHECKING:  # for type checkers, only the names imported above are there

    def __getattr__(name: str) -> object:
        """Import a public name."""
        if name not in _MODULES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        from importlib import import_module

        value: object = getattr(import_module(f"{__name__}.{_MODULES[name]}"), name)
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    return sorted([*__all__, *(name for name in globals() if name[:2] == name[-2:] == "__")])
