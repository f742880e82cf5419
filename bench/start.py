"""Measures how long the command takes to start, as whole processes."""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from legs import yamaro_command
from measuring import XACRO, YAMARO, Figure, Setting, main, run_in_turns

import yamaro

TINY = "model:\n  link/name=base:\n"
TINY_XACRO = """\
<robot name="tiny" xmlns:xacro="http://www.ros.org/wiki/xacro"><link name="base"/></robot>
"""

WITHOUT_BYTE_CODE = """
import sys
sys.path.insert(0, {folder!r})
from yamaro.commands.main import main
sys.exit(main())
"""


def without_byte_code(folder: str) -> list[str]:
    """Return the command that runs a copy of Yamaro which Python has to compile at each start.

    So it is where PYTHONDONTWRITEBYTECODE is set and the installer compiled nothing.
    """
    own = shutil.ignore_patterns("__pycache__")
    shutil.copytree(os.path.dirname(yamaro.__file__), Path(folder, "yamaro"), ignore=own)
    return [sys.executable, "-B", "-c", WITHOUT_BYTE_CODE.format(folder=folder)]


def measure(setting: Setting) -> Iterator[Figure]:
    with tempfile.TemporaryDirectory() as folder:
        tiny, tiny_xacro = Path(folder, "tiny.yaml"), Path(folder, "tiny.xacro")
        tiny.write_text(TINY)
        tiny_xacro.write_text(TINY_XACRO)
        commands = {
            "python -c pass": [sys.executable, "-c", "pass"],
            "yamaro --version": [*YAMARO, "--version"],
            "yamaro, one link": [*YAMARO, str(tiny)],
            "yamaro, legs 6": yamaro_command(6),
            "yamaro, one link, not byte-compiled": [*without_byte_code(folder), str(tiny)],
            "python -c 'import numpy'": [sys.executable, "-c", "import numpy"],
            "xacro, one link": [*XACRO, str(tiny_xacro)],
        }
        # The times are short, so that more of them are taken than of others.
        found = run_in_turns(commands, setting._replace(runs=4 * setting.runs))
    for name, seconds in found.items():
        yield Figure(name, seconds * 1e3, " ms")


if __name__ == "__main__":
    main(measure, __doc__)
