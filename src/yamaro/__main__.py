"""Runs the command as `python -m yamaro`."""

from __future__ import annotations

import os
import sys

# Python puts the working directory first on its path for `-m`, so that a file `math.py` beside a
# robot would be run in place of Python's own module. The script `yamaro` has no such entry.
try:
    unwanted = ("", os.getcwd())
except OSError:  # the folder is gone
    unwanted = ("", "")
if sys.path and sys.path[0] in unwanted:
    del sys.path[0]

from .commands.main import main

if __name__ == "__main__":
    sys.exit(main())
