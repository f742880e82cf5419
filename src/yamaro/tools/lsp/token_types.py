"""The types of semantic tokens, in the order of their numbers."""

from __future__ import annotations

TYPES = ("variable", "parameter", "function", "namespace", "class")
MODIFIERS = ("declaration",)
