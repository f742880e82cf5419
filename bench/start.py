"""Measures how long the command takes to start, as whole processes."""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from legs import yamaro_command
from measuring import XACRO, YAMARO, Figure, Setting, main, run_in_turns

TINY = "model:\n  link/name=base:\n"
TINY_XACRO = """\
<robot name="tiny" xmlns:xacro="http://www.ros.org/wiki/xacro"><link name="base"/></robot>
"""


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
            "xacro, one link": [*XACRO, str(tiny_xacro)],
        }
        # The times are short, so that more of them are taken than of others.
        found = run_in_turns(commands, setting._replace(runs=4 * setting.runs))
    for name, seconds in found.items():
        yield Figure(name, seconds * 1e3, " ms")


if __name__ == "__main__":
    main(measure, __doc__)
