"""Runs all that this folder measures and prints it as one table, and the machine it ran on.

Each script is a process of its own, so that none finds the memory that another used. The exit
status is 1 if a limit is missed.
"""

from __future__ import annotations

import argparse
import os
import platform
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

from measuring import HEADER

FOLDER = Path(__file__).parent
SCRIPTS = (
    "start",
    "legs",
    "linear",
    "flat",
    "sweep",
    "sweeps",
    "kept",
    "safety",
    "view",
    "playground",
    "model",
    "faults",
    "lsp",
)


def machine() -> str:
    """Return what the figures depend on: the machine and the versions."""
    return (
        f"{processor()}, {os.cpu_count()} cores, {memory()}{platform.system()}, "
        f"Python {platform.python_version()}, PyYAML {version('PyYAML')}, xacro {version('xacro')}"
    )


def processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    models = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return models[0] if models else platform.machine()


def memory() -> str:
    try:
        size = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError, OSError):  # not a POSIX system
        return ""
    return f"{size / 2**30:.0f} GB, "


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scripts", nargs="*", help=f"some of: {', '.join(SCRIPTS)}")
    parser.add_argument("--scale", default="1", help="how much of the work to do (default: 1)")
    parser.add_argument("--runs", default="5", help="runs of each (default: 5)")
    options = parser.parse_args()
    unknown = set(options.scripts) - set(SCRIPTS)
    if unknown:
        parser.error(f"there is no script {', '.join(sorted(unknown))}")
    print(f"{machine()}\n\n{HEADER}", flush=True)
    is_met = True
    for script in options.scripts or SCRIPTS:
        command = [sys.executable, str(FOLDER / f"{script}.py"), "--rows"]
        done = subprocess.run([*command, "--scale", options.scale, "--runs", options.runs])
        is_met = is_met and done.returncode == 0
    sys.exit(0 if is_met else 1)


if __name__ == "__main__":
    main()
