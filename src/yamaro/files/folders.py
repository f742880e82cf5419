"""Which files are in a folder and below it."""

from __future__ import annotations

import os

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

ROBOT_ENDINGS = (".urdf.yaml", ".urdf.yml", ".yamaro.yaml", ".yamaro.yml")
"""How the names of files end that are for Yamaro; other YAML files may be for anything."""
SKIPPED_FOLDERS = frozenset(("build", "install", "log", "node_modules", "__pycache__"))
"""Folders of what is built or installed. Hidden ones are skipped as well."""


def files_below(folder: str, endings: tuple[str, ...]) -> Iterator[str]:
    """Yield the files in a folder and below with these endings, in the order of their names."""
    for inner, folders, names in os.walk(folder):
        folders[:] = sorted(
            name for name in folders if name[0] != "." and name not in SKIPPED_FOLDERS
        )
        for name in sorted(names):
            path = os.path.normpath(os.path.join(inner, name))
            if name.endswith(endings) and os.path.isfile(path):  # no pipe, socket or device
                yield path
