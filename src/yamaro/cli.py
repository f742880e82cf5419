"""The former place of the command, for the scripts of installations made before it moved."""

from __future__ import annotations

from .commands.main import main as main
