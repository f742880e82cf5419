"""Yamaro compiles YAML robot descriptions to URDF, or any other XML."""

from .compiler import Build as Build
from .compiler import build as build
from .compiler import convert as convert
from .diagnostics import Diagnostic as Diagnostic
from .diagnostics import YamaroError as YamaroError
from .diagnostics import YamaroWarning as YamaroWarning
from .syntax.flexidict import FlexiDict as FlexiDict

__version__ = "0.1.0"
__all__ = [
    "Build",
    "Diagnostic",
    "FlexiDict",
    "YamaroError",
    "YamaroWarning",
    "build",
    "convert",
]
