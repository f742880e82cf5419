"""Yamaro compiles YAML robot descriptions to URDF, or any other XML."""

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .compiler import Build as Build
    from .compiler import Program as Program
    from .compiler import UsageError as UsageError
    from .compiler import build as build
    from .compiler import convert as convert
    from .compiler import load as load
    from .diagnostics import Diagnostic as Diagnostic
    from .diagnostics import YamaroError as YamaroError
    from .diagnostics import YamaroWarning as YamaroWarning
    from .files.loader import FileLoader as FileLoader
    from .files.loader import LoadError as LoadError
    from .files.loader import MemoryLoader as MemoryLoader
    from .policy import Policy as Policy
    from .yaml.flexidict import FlexiDict as FlexiDict

__version__ = "0.1.0"
__all__ = [
    "Build",
    "Diagnostic",
    "FileLoader",
    "FlexiDict",
    "LoadError",
    "MemoryLoader",
    "Policy",
    "Program",
    "UsageError",
    "YamaroError",
    "YamaroWarning",
    "build",
    "convert",
    "load",
]

# Where each name comes from when it is first asked for: the command imports this package too, and
# `yamaro --version` or a completion in the shell needs none of them.
_MODULES = {
    "Build": "compiler",
    "Diagnostic": "diagnostics",
    "FileLoader": "files.loader",
    "FlexiDict": "yaml.flexidict",
    "LoadError": "files.loader",
    "MemoryLoader": "files.loader",
    "Policy": "policy",
    "Program": "compiler",
    "UsageError": "compiler",
    "YamaroError": "diagnostics",
    "YamaroWarning": "diagnostics",
    "build": "compiler",
    "convert": "compiler",
    "load": "compiler",
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
    return sorted({*globals(), *__all__})
