"""MJCF, the format of MuJoCo, in the style of MuJoCo Menagerie.

Source: https://mujoco.readthedocs.io/en/stable/XMLreference.html.
"""

from __future__ import annotations

from .model import write

__all__ = ["write"]
