"""Robots of programs that stand in a test."""

from __future__ import annotations

import warnings

import yamaro


def convert_text(text: str, **files: str) -> str:
    """Return the URDF of a program; warnings are left out, errors are raised.

    `files` are others that it includes: `hand_yaml` is hand.yaml.
    """
    contents = {name.replace("_", "."): content for name, content in files.items()}
    paths = {f"/robots/{name}": content for name, content in contents.items()}
    loader = yamaro.MemoryLoader({"/robots/robot.yaml": text, **paths})
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", yamaro.YamaroWarning)
        return yamaro.load("/robots/robot.yaml", loader=loader).convert()
