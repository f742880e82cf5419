"""Yamaro compiles YAML robot descriptions to URDF, or any other XML."""

from .compiler import Build as Build
from .compiler import UsageError as UsageError
from .compiler import build as build
from .compiler import convert as convert
from .diagnostics import Diagnostic as Diagnostic
from .diagnostics import YamaroError as YamaroError
from .diagnostics import YamaroWarning as YamaroWarning
from .runtime.loader import FileLoader as FileLoader
from .runtime.loader import LoadError as LoadError
from .runtime.loader import MemoryLoader as MemoryLoader
from .syntax.flexidict import FlexiDict as FlexiDict

__version__ = "0.1.0"
__all__ = [
    "Build",
    "Diagnostic",
    "FileLoader",
    "FlexiDict",
    "LoadError",
    "MemoryLoader",
    "UsageError",
    "YamaroError",
    "YamaroWarning",
    "build",
    "convert",
]
