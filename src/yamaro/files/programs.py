"""Finds programs on PATH, and never in the working directory, where files may be untrusted.

Windows looks there first for a name without a folder, and so do other systems for an empty entry.
"""

from __future__ import annotations

import os


def find_program(name: str, path: str | None = None) -> str | None:
    """Return the path of a program, or None if there is none.

    Args:
        name: what it is called; a name with a folder is returned as it is.
        path: the folders to search, by default those of PATH; relative ones are passed over.
    """
    if os.path.dirname(name):
        return name
    endings = [""]
    if os.name == "nt":
        known = os.environ.get("PATHEXT", ".COM;.EXE;.BAT;.CMD").lower().split(os.pathsep)
        endings = endings if os.path.splitext(name)[1].lower() in known else known
    for folder in (os.environ.get("PATH", "") if path is None else path).split(os.pathsep):
        for ending in endings if os.path.isabs(folder) else ():
            found = os.path.join(folder, name + ending)
            if os.path.isfile(found) and os.access(found, os.X_OK):
                return found
    return None
